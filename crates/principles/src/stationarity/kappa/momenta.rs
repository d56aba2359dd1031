//! Multipliers as combinations of momenta and coordinates: the coefficients are seen in double precision, and the result is exact.

use super::{Place, LONGEST};
use crate::stationarity::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::sample::Generator;
use chetaev_symbolic::{simplify, Expr, Graph, Rational, Symbol};

/// More functions are not combined.
const MOST: usize = 16;
/// The seed of the states at which coefficients are seen.
const SEED: u64 = 0x5eed_0c0e;
/// Pivots below this part of the largest entry are zero.
const ZERO: f64 = 1e-9;
/// Coefficients are halves of whole numbers, to this accuracy.
const WHOLE: f64 = 1e-6;

/// `Σ c_i f_i + R t` with the rate given, where the f_i are the momenta and the coordinates, c_i small numbers, and R does not move.
pub(super) fn of_momenta(
    (cx, motion, place): (&Context<'_>, &Motion, &Place),
    rate: Expr,
) -> Option<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let is_long = simplify::length(g, rate) > LONGEST;
    if is_long || !motion.implicit.is_empty() || 2 * system.n() > MOST {
        return None;
    }
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let coordinates = system.coordinates.iter().map(|c| c.q);
    let functions = momenta.into_iter().chain(coordinates);
    let functions: Vec<Expr> = functions
        .map(|e| place.restricted(g, motion.on_states(g, e)))
        .collect();
    let rates: Vec<Expr> = functions
        .iter()
        .map(|&e| place.simple(g, place.restricted(g, motion.along(cx, e))))
        .collect();
    let coefficients = seen((g, place), rate, &rates)?;
    let combined = |of: &[Expr]| {
        let terms = coefficients.iter().zip(of);
        g.add(&terms.map(|(c, &e)| g.scale(c, e)).collect::<Vec<Expr>>())
    };
    let rest = place.simple(g, g.sub(rate, combined(&rates)));
    let time = g.symbol("t", 0);
    place
        .rests(g, rest)
        .then(|| g.add(&[combined(&functions), g.mul(&[rest, time])]))
}

/// c with `rate = Σ c_i rates_i + c`, as far as that is seen at some states; `None` where there are none that are halves of whole numbers.
fn seen((g, place): (&Graph, &Place), rate: Expr, rates: &[Expr]) -> Option<Vec<Rational>> {
    let unknowns = rates.len() + 1;
    let mut all = rates.to_vec();
    all.push(g.one());
    all.push(rate);
    let symbols: Vec<Symbol> = g.symbols_in(&all);
    let mut generator = Generator::new(SEED);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    // Parameters are the same at all states: R may be any function of them.
    let parameters: Vec<f64> = symbols
        .iter()
        .map(|_| generator.between(0.3, 1.3))
        .collect();
    for _ in 0..2 * unknowns {
        let state: Vec<f64> = symbols
            .iter()
            .zip(&parameters)
            .map(|(s, &fixed)| match place.moving.contains(s) {
                true => generator.between(0.3, 1.3),
                false => fixed,
            })
            .collect();
        let value = |s: Symbol| symbols.iter().position(|&own| own == s).map(|i| state[i]);
        rows.push(g.evaluate_f64(&all, &value).ok()?);
    }
    let values = eliminated(rows, unknowns)?;
    let whole = |x: &f64| -> Option<Rational> {
        let twice = (2.0 * x).round();
        let near = (2.0 * x - twice).abs() <= WHOLE && twice.abs() <= 16.0;
        near.then(|| Rational::from(twice as i64) / Rational::from(2))
    };
    values[..rates.len()].iter().map(whole).collect()
}

/// A solution of linear equations with the right sides in the last column, with zero for what is free; `None` where they contradict each
/// other.
fn eliminated(mut rows: Vec<Vec<f64>>, unknowns: usize) -> Option<Vec<f64>> {
    let entries = rows.iter().flatten();
    let largest = entries.fold(0.0_f64, |m, x| m.max(x.abs()));
    if !largest.is_finite() {
        return None;
    }
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..unknowns {
        let step = pivots.len();
        let size = |&i: &usize| rows[i][column].abs();
        let best = (step..rows.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
        let Some(best) = best.filter(|i| size(i) > ZERO * largest) else {
            continue;
        };
        rows.swap(step, best);
        let pivot = rows[step].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / pivot[column];
            if i != step {
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(x, p)| *x -= factor * p);
            }
        }
        pivots.push(column);
    }
    let contradicts = |row: &Vec<f64>| row[unknowns].abs() > WHOLE * largest;
    if rows[pivots.len()..].iter().any(contradicts) {
        return None;
    }
    let mut values = vec![0.0; unknowns];
    for (row, &column) in rows.iter().zip(&pivots) {
        values[column] = row[unknowns] / row[column];
    }
    Some(values)
}
