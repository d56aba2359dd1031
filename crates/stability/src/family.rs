//! The family of steady motions to which a steady motion belongs.

use crate::expansion::Expansion;
use crate::steady::{closed, kernel};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::System;
use chetaev_symbolic::factors::irreducible_factors;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol, Verdict};

impl Expansion<'_> {
    /// The dimension of the family of steady motions through this one, where it was proved: of straight lines, or of a manifold.
    pub(crate) fn family(&self, slopes: &[Vec<Expr>]) -> usize {
        let (straight, kernel) = self.straight_family(slopes);
        if straight < kernel {
            straight.max(self.curved_family(slopes))
        } else {
            straight
        }
    }

    /// The dimension of an affine space of steady motions through this one, and that of the kernel of the linear equations, which it cannot exceed:
    /// all of the kernel is tried, then one vector of its basis after the other.
    fn straight_family(&self, slopes: &[Vec<Expr>]) -> (usize, usize) {
        let g = self.graph();
        let mut rows = slopes.to_vec();
        rows.extend(self.finite_equations().into_iter().map(|(_, row)| row));
        let (vectors, _) = kernel(g, &rows, self.variables().len());
        if !self.own.characteristics.manifold.implicit.is_empty() {
            return (0, vectors.len());
        }
        let is_whole = self.is_steady_along(&vectors);
        if is_whole {
            return (vectors.len(), vectors.len());
        }
        let mut kept: Vec<Vec<Expr>> = Vec::new();
        for own in &vectors {
            kept.push(own.clone());
            if !self.is_steady_along(&kept) {
                kept.pop();
            }
        }
        (kept.len(), vectors.len())
    }

    /// Whether all motions whose variables differ by combinations of these vectors are steady and admissible.
    pub(crate) fn is_steady_along(&self, vectors: &[Vec<Expr>]) -> bool {
        let g = self.graph();
        let symbols: Vec<Expr> = self
            .variables()
            .into_iter()
            .map(|s| g.symbol_expr(s))
            .collect();
        let values = self.at(&symbols);
        let moved = |place: usize| {
            // No name of a model contains a space.
            let along = vectors
                .iter()
                .enumerate()
                .map(|(i, v)| g.mul(&[g.symbol(&format!("along {i}"), 0), v[place]]));
            let all: Vec<Expr> = std::iter::once(values[place]).chain(along).collect();
            g.add(&all)
        };
        let pairs: Vec<(Expr, Expr)> = symbols
            .iter()
            .enumerate()
            .map(|(place, &own)| (own, moved(place)))
            .collect();
        let moving = [
            self.own.rates.clone(),
            self.own.equations.force.clone(),
            self.finite(),
        ]
        .concat();
        let moving = g.substitute_all(&moving, &pairs);
        self.at(&moving).iter().all(|&e| g.is_zero(e))
    }

    /// The dimension of a manifold of steady motions.
    ///
    /// Equations with independent gradients at the motion are a manifold there (implicit function theorem); where the others vanish
    /// on the solutions of these, that manifold consists of steady motions. Its dimension is the number of variables less these equations.
    fn curved_family(&self, slopes: &[Vec<Expr>]) -> usize {
        let g = self.graph();
        let variables = self.variables();
        let mut equations: Vec<(Expr, Vec<Expr>)> = self.finite_equations();
        let moving = [self.own.rates.clone(), self.own.equations.force.clone()].concat();
        equations.extend(moving.iter().copied().zip(slopes.iter().cloned()));
        let values = |e: Expr| g.substitute(g.substitute(e, &self.controls(&[e])), &self.values);
        let mut equations: Vec<(Expr, Vec<Expr>)> = equations
            .into_iter()
            .map(|(e, row)| self.without_powers(values(e), row))
            .collect();
        equations.sort_by_key(|(e, _)| g.reachable(&[*e]).len());
        let rows: Vec<Vec<Expr>> = equations.iter().map(|(_, row)| row.clone()).collect();
        let pivots = independent_rows(g, &rows);
        let chosen: Vec<(Expr, Symbol)> = pivots
            .iter()
            .map(|&(row, column)| (equations[row].0, variables[column]))
            .collect();
        let is_chosen = |row: &usize| pivots.iter().any(|(own, _)| own == row);
        let others: Vec<Expr> = (0..equations.len())
            .filter(|row| !is_chosen(row))
            .map(|row| equations[row].0)
            .collect();
        // The theorem asks for slopes around the motion, not at it alone.
        let functions: Vec<Expr> = chosen.iter().map(|(e, _)| *e).collect();
        if self.flat(&functions, 1).had_corner {
            return 0;
        }
        let (chosen, others) = self.near(chosen, &others);
        let dimension = variables.len() - pivots.len();
        if dimension == 0 || vanish_on(self.system, &others, &chosen) {
            dimension
        } else {
            0
        }
    }

    /// An equation without slopes at the motion, with each of its factors once: a power has no slopes where it vanishes, and the same zeros.
    fn without_powers(&self, e: Expr, row: Vec<Expr>) -> (Expr, Vec<Expr>) {
        let (g, variables) = (self.graph(), self.variables());
        if g.is_zero(e) || row.iter().any(|&slope| !g.is_zero(slope)) {
            return (e, row);
        }
        let all = irreducible_factors(g, e, &variables).unwrap_or_default();
        if all.iter().all(|own| own.1 == 1) {
            return (e, row);
        }
        let once: Vec<Expr> = all.into_iter().map(|own| own.0).collect();
        let once = g.mul(&once);
        let slopes = self.at_rows(&g.jacobian(&[once], &variables)).remove(0);
        (once, slopes)
    }

    /// The same equations near the motion: variables that are zero are left out, and so are factors that do not vanish at the motion, as x of
    /// (x² + y² − 1) x.
    fn near(
        &self,
        chosen: Vec<(Expr, Symbol)>,
        others: &[Expr],
    ) -> (Vec<(Expr, Symbol)>, Vec<Expr>) {
        let (g, variables) = (self.graph(), self.variables());
        let is_zero = |own: &(Expr, Symbol)| own.0 == g.symbol_expr(own.1);
        let zeros: Vec<(Expr, Expr)> = chosen
            .iter()
            .filter(|own| is_zero(own))
            .map(|own| (own.0, g.zero()))
            .collect();
        let factor = |e: Expr| {
            let e = g.substitute(e, &zeros);
            let all = irreducible_factors(g, e, &variables).unwrap_or_default();
            let all: Vec<Expr> = all.into_iter().map(|own| own.0).collect();
            let at = self.at(&all);
            let here = all.iter().zip(at).filter(|own| g.is_zero(own.1));
            match here.collect::<Vec<_>>()[..] {
                [(&only, _)] => only,
                _ => e,
            }
        };
        let near = chosen.into_iter().map(|own| {
            if is_zero(&own) {
                own
            } else {
                (factor(own.0), own.1)
            }
        });
        (near.collect(), g.substitute_all(others, &zeros))
    }

    /// The finite constraints with their gradients by the variables at the motion.
    pub(crate) fn finite_equations(&self) -> Vec<(Expr, Vec<Expr>)> {
        let g = self.graph();
        let variables = self.variables();
        let finite = self.finite();
        let gradients = self.at_rows(&g.jacobian(&finite, &variables));
        finite.into_iter().zip(gradients).collect()
    }
}

/// The first rows that are independent of those before them, each with a column that it can be solved for.
pub(crate) fn independent_rows(g: &Graph, rows: &[Vec<Expr>]) -> Vec<(usize, usize)> {
    let mut kept: Vec<(usize, usize, Vec<Expr>)> = Vec::new();
    for (place, row) in rows.iter().enumerate() {
        let mut row = row.clone();
        for (_, column, by) in &kept {
            let factor = row[*column];
            if !g.is_zero(factor) {
                let less =
                    |(&own, &by): (&Expr, &Expr)| closed(g, g.sub(own, g.mul(&[factor, by])));
                row = row.iter().zip(by).map(less).collect();
            }
        }
        let nonzero = (0..row.len()).filter(|&c| !g.is_zero(row[c]));
        let cost = |&c: &usize| (g.as_number(row[c]).is_none(), g.reachable(&[row[c]]).len());
        if let Some(column) = nonzero.min_by_key(cost) {
            let pivot = row[column];
            let own = row.iter().map(|&e| closed(g, g.div(e, pivot))).collect();
            kept.push((place, column, own));
        }
    }
    kept.into_iter()
        .map(|(place, column, _)| (place, column))
        .collect()
}

/// Whether expressions are proved to vanish where equations hold, each given with the symbol that it determines.
///
/// An equation that is affine in its symbol with a number as coefficient is solved and put into all others first.
fn vanish_on(system: &System, es: &[Expr], equations: &[(Expr, Symbol)]) -> bool {
    let g = &system.graph;
    let (mut es, mut open) = (es.to_vec(), equations.to_vec());
    let solvable = |(e, symbol): &(Expr, Symbol)| {
        let slope = g.diff(*e, *symbol);
        let is_number = g.as_number(slope).is_some() && !g.is_zero(slope);
        is_number.then(|| {
            let own = g.symbol_expr(*symbol);
            (own, g.sub(own, g.div(*e, slope)))
        })
    };
    while let Some((place, solution)) = open
        .iter()
        .enumerate()
        .find_map(|(place, own)| Some((place, solvable(own)?)))
    {
        open.remove(place);
        let into = |e: Expr| g.substitute(e, &[solution]);
        es = es.into_iter().map(into).collect();
        open = open
            .into_iter()
            .map(|(e, symbol)| (into(e), symbol))
            .collect();
    }
    if es.iter().all(|&e| g.is_zero(e)) {
        return true;
    }
    let assumptions = assumptions(system);
    let test = ZeroTest {
        residuals: &es,
        solved: &[],
        implicit: &open,
        assumptions: &assumptions,
        options: chetaev_symbolic::zero::Options::default(),
    };
    matches!(decide_zero(g, &test), Verdict::Proved(_))
}
