//! Constraints that are products on each other: `x'² = y'² + z'²` with `x' = y' + z'`.

use crate::sample::{self, Generator};
use crate::selection::Selection;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// A function where others, affine in the velocities, vanish: these are solved for some of the symbols, one after the other. With
/// `x' = y' + z'` the cone `x'² = y'² + z'²` is the product `2 y' z'`. `None` where there are none, or one cannot be solved.
pub(super) fn on_affine(g: &Graph, f: Expr, affine: &[Expr], symbols: &[Symbol]) -> Option<Expr> {
    if affine.is_empty() || !g.contains_any(f, symbols) {
        return None;
    }
    let mut solved: Vec<(Expr, Expr)> = Vec::new();
    for &e in affine {
        // What was solved before may contain what is solved now.
        let e = g.substitute(e, &solved);
        let gradient = g.gradient(e, symbols);
        let mut values = Generator::new(0x00c0_5e1f);
        let at = g.symbols_in(&gradient);
        let at: Vec<(Symbol, f64)> = at.iter().map(|&s| (s, values.between(0.3, 1.7))).collect();
        let value = |s: Symbol| at.iter().find(|(own, _)| *own == s).map(|(_, x)| *x);
        let numbers = g.evaluate_f64(&gradient, &value).ok()?;
        let usable = (0..symbols.len()).filter(|&j| numbers[j].abs() > 1e-9);
        let j = usable.min_by_key(|&j| g.reachable(&[gradient[j]]).len())?;
        let symbol = g.symbol_expr(symbols[j]);
        let rest = g.substitute(e, &[(symbol, g.zero())]);
        let own = (symbol, g.neg(g.div(rest, gradient[j])));
        for (_, other) in &mut solved {
            *other = g.substitute(*other, &[own]);
        }
        solved.push(own);
    }
    Some(g.substitute(f, &solved))
}

/// Places at which components are looked for that no equation shows.
const PLACES: u64 = 16;

/// What the independent velocities of a selection describe, where constraints are products without a factor to be seen, several of
/// them together or with roots: at some states the constraints are independent, but not to be solved for these velocities, although the
/// states were drawn at random.
pub(super) fn covered_by_choice(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
) -> Option<String> {
    let (g, n) = (&system.graph, terms.jets.len());
    let velocities: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    let rows = selection.rows.iter().map(|&row| &terms.jacobian[row]);
    let rows: Vec<Vec<Expr>> = rows.cloned().collect();
    let nonlinear = rows
        .iter()
        .filter(|row| g.any_contains_any(row, &velocities));
    if nonlinear.count() == 0 || terms.order > 1 {
        return None;
    }
    let entries = rows.concat();
    let is_elsewhere = |number: u64| {
        let point = sample::admissible_point(system, terms, 0x00c0_4e5e ^ number)?;
        let values = g.evaluate_f64(&entries, &|s| point.get(&s).copied()).ok()?;
        let rows: Vec<Vec<f64>> = values.chunks(n).map(sample::scaled).collect();
        let chosen = rows.iter();
        let chosen = chosen.map(|row| selection.dependent.iter().map(|&j| row[j]).collect());
        let chosen = sample::least_pivot(chosen.collect());
        Some(chosen < 1e-9 && sample::least_pivot(rows) > 1e-4)
    };
    let mut places = (0..PLACES).filter_map(is_elsewhere);
    places.any(|elsewhere| elsewhere).then(|| {
        let symbols = selection.dependent.iter().map(|&j| velocities[j]);
        let texts: Vec<String> = symbols.map(|s| g.symbol_text(s)).collect();
        let verb = if texts.len() == 1 {
            "follows"
        } else {
            "follow"
        };
        format!("{} {verb} from the other velocities", texts.join(", "))
    })
}
