//! The zero test of what the distinction of cases has found.

use super::roots::Root;
use super::{Leaf, Row};
use crate::stationarity::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Verdict};

/// Proves again, by the zero test, that a set is kept by the motion and that its κ satisfies (12) and (13) there; multipliers
/// that are not determined stay free.
pub(crate) fn confirmed(cx: &Context<'_>, motion: &Motion, leaf: &Leaf) -> Verdict {
    let g = &cx.system.graph;
    let mut residuals: Vec<Expr> = leaf
        .solved
        .iter()
        .filter_map(|&(symbol, value)| {
            let rate = motion.rate(g, g.as_symbol(symbol)?);
            Some(g.sub(rate, motion.along(cx, value)))
        })
        .collect();
    let implicit = leaf.implicit.iter();
    residuals.extend(implicit.map(|&(e, _)| motion.along(cx, e)));
    if let Some(rows) = &leaf.rows {
        residuals.extend(of_multipliers(cx, motion, rows));
    }
    let residuals = g.substitute_all(&residuals, &leaf.solved).into_iter();
    let root = |e, root: &Root| root.replaced(g, e);
    let residuals = residuals.map(|e| leaf.roots.iter().fold(e, root));
    let residuals: Vec<Expr> = residuals.collect();
    let on = "on the motions stated";
    let manifold = Manifold {
        solved: Vec::new(),
        implicit: leaf.implicit.clone(),
    };
    cx.prover.identity(cx.system, &residuals, &manifold, on)
}

/// (12), and (13) for the multipliers that the rows determine by those that stay free.
fn of_multipliers(cx: &Context<'_>, motion: &Motion, rows: &[(usize, Row)]) -> Vec<Expr> {
    let g = &cx.system.graph;
    let r = motion.multipliers.len();
    let pivot = |l: usize| {
        rows.iter()
            .find(|(column, _)| *column == l)
            .map(|(_, row)| row)
    };
    let mut kappa: Vec<Expr> = (0..r)
        .map(|l| match pivot(l) {
            Some(_) => g.zero(),
            None => g.symbol(&unused_name(cx.system, &format!("kappa_{}", l + 1)), 0),
        })
        .collect();
    for (column, row) in rows {
        kappa[*column] = g.sub(row.right, dot(g, &row.coefficients, &kappa));
    }
    let demanded: Vec<Expr> = (0..r)
        .map(|l| g.sub(dot(g, &motion.transport[l], &kappa), motion.multipliers[l]))
        .collect();
    let mut residuals: Vec<Expr> = motion
        .conditions
        .iter()
        .map(|row| dot(g, row, &kappa))
        .collect();
    for (column, row) in rows {
        // D of right − Σ coefficient κ, with the rates demanded of the free ones.
        let mut parts = vec![motion.along(cx, row.right), g.neg(demanded[*column])];
        for l in (0..r).filter(|&l| pivot(l).is_none()) {
            let moved = motion.along(cx, row.coefficients[l]);
            parts.push(g.neg(g.mul(&[moved, kappa[l]])));
            parts.push(g.neg(g.mul(&[row.coefficients[l], demanded[l]])));
        }
        residuals.push(g.add(&parts));
    }
    residuals
}
