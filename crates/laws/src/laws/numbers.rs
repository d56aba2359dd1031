//! Values in double precision at admissible states: they decide, independently of every zero test, what a law expects.

use super::Subject;
use chetaev_mechanics::sample::{admissible_point, Generator, Point};
use chetaev_symbolic::{Expr, Symbol};

/// States looked at.
const STATES: u64 = 6;
/// Beyond this share of its scale a value is not zero.
const CLEARLY: f64 = 1e-6;
/// Below this share of its scale a value is rounding.
const ROUNDING: f64 = 1e-9;

/// What double precision says of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// Not zero at one state at least.
    NotZero,
    /// Zero to rounding at every state.
    Zero,
    /// Neither, or no state could be evaluated.
    Unclear,
}

/// Whether `left` and `right` differ at admissible states, relatively to their size and to `scale`.
pub(super) fn differ(subject: &Subject<'_>, left: &[Expr], right: &[Expr], scale: &[Expr]) -> Seen {
    let g = &subject.cx.system.graph;
    let all: Vec<Expr> = left.iter().chain(right).chain(scale).copied().collect();
    let (mut states, mut largest) = (0, 0.0_f64);
    for seed in 0..STATES {
        let Some(point) = state(subject, seed) else {
            continue;
        };
        let value = |s: Symbol| point.get(&s).copied();
        let Ok(values) = g.evaluate_f64(&all, &value) else {
            continue;
        };
        if !values.iter().all(|x| x.is_finite()) {
            continue;
        }
        states += 1;
        let (a, rest) = values.split_at(left.len());
        let (b, sizes) = rest.split_at(right.len());
        let size = sizes.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        for (x, y) in a.iter().zip(b) {
            largest = largest.max((x - y).abs() / (size + x.abs() + y.abs()));
        }
    }
    match states {
        0 => Seen::Unclear,
        _ if largest > CLEARLY => Seen::NotZero,
        _ if largest < ROUNDING => Seen::Zero,
        _ => Seen::Unclear,
    }
}

/// An admissible state with random accelerations.
fn state(subject: &Subject<'_>, seed: u64) -> Option<Point> {
    let cx = subject.cx;
    let mut point = admissible_point(cx.system, cx.terms, seed)?;
    let mut generator = Generator::new(seed);
    for c in &cx.system.coordinates {
        point.insert(c.a_symbol, generator.between(-1.0, 1.0));
    }
    let time = cx.system.graph.intern_symbol("t", 0);
    point.entry(time).or_insert(0.4);
    Some(point)
}
