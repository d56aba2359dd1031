//! Values in double precision at sampled states: they decide, independently of every zero test, what a law expects.

use super::digits::share_of_difference;
use super::Sampled;
use chetaev_mechanics::sample::{admissible_point, Generator, Point};
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Symbol};

/// States looked at.
const STATES: u64 = 6;
/// Beyond this share of its scale a value is not zero.
const CLEARLY: f64 = 1e-6;
/// Below this share of its scale a value is rounding.
const ROUNDING: f64 = 1e-9;
/// Beyond this share a value is not zero where rounding is none; below its square it is zero.
const PRECISELY: f64 = 1e-20;
/// A row of a matrix below it is zero: the coefficients of random systems are of the size of one.
const NOTHING: f64 = 1e-11;

/// What double precision says of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Size {
    /// Not zero at one state at least.
    NotZero,
    /// Zero to rounding at every state.
    Zero,
    /// Neither, or no state could be evaluated.
    Unclear,
}

impl Size {
    /// From the shares of differences that were evaluated with some 150 digits.
    fn of_shares(shares: &[f64]) -> Size {
        match shares.iter().copied().reduce(f64::max) {
            Some(share) if share > PRECISELY => Size::NotZero,
            Some(share) if share < PRECISELY * PRECISELY => Size::Zero,
            _ => Size::Unclear,
        }
    }

    /// From values with their scales.
    pub(super) fn of(values: impl IntoIterator<Item = (f64, f64)>) -> Size {
        let mut largest: Option<f64> = None;
        for (value, scale) in values {
            largest = Some(largest.unwrap_or(0.0).max((value / scale).abs()));
        }
        match largest {
            Some(share) if share > CLEARLY => Size::NotZero,
            Some(share) if share < ROUNDING => Size::Zero,
            _ => Size::Unclear,
        }
    }
}

/// What double precision says of the rank of a square matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rank {
    /// Nonsingular.
    Full,
    /// Singular to rounding.
    Short,
    /// Neither.
    Unclear,
}

/// Elimination with complete pivoting on rows of equal size.
pub(super) fn rank(mut a: Vec<f64>, n: usize) -> Rank {
    for row in a.chunks_mut(n.max(1)) {
        let size = row.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if size < NOTHING {
            row.fill(0.0);
        } else {
            row.iter_mut().for_each(|x| *x /= size);
        }
    }
    let mut least = 1.0_f64;
    for step in 0..n {
        let open = (step..n).flat_map(|i| (step..n).map(move |j| (i, j)));
        let pivot = open.max_by(|a_, b_| {
            let size = |p: &(usize, usize)| a[p.0 * n + p.1].abs();
            size(a_).total_cmp(&size(b_))
        });
        let Some((row, column)) = pivot else { break };
        for j in 0..n {
            a.swap(step * n + j, row * n + j);
        }
        for i in 0..n {
            a.swap(i * n + step, i * n + column);
        }
        let value = a[step * n + step];
        least = least.min(value.abs());
        if value.abs() < ROUNDING {
            break;
        }
        for i in step + 1..n {
            let factor = a[i * n + step] / value;
            for j in step..n {
                let change = factor * a[step * n + j];
                a[i * n + j] -= change;
            }
        }
    }
    match least {
        least if least > CLEARLY => Rank::Full,
        least if least < ROUNDING * 1e-2 => Rank::Short,
        _ => Rank::Unclear,
    }
}

/// Admissible states with random accelerations and a time.
pub(super) fn states(cx: &Context<'_>) -> Vec<Point> {
    (0..STATES).filter_map(|seed| state(cx, seed)).collect()
}

fn state(cx: &Context<'_>, seed: u64) -> Option<Point> {
    let mut point = admissible_point(cx.system, cx.terms, seed)?;
    let mut generator = Generator::new(seed);
    let g = &cx.system.graph;
    for c in &cx.system.coordinates {
        point.insert(c.a_symbol, generator.between(-1.0, 1.0));
        for symbol in [c.q_symbol, c.v_symbol] {
            let value = generator.between(-1.0, 1.0);
            point.entry(symbol).or_insert(value);
        }
    }
    for parameter in &cx.system.parameters {
        let value = parameter
            .value
            .and_then(|e| g.evaluate_f64(&[e], &|_| None).ok());
        if let (Some(symbol), Some(value)) = (g.as_symbol(parameter.expr), value) {
            point.entry(symbol).or_insert(value[0]);
        }
    }
    for mass in &cx.system.masses {
        point.entry(mass.symbol).or_insert(1.2);
    }
    point.entry(g.intern_symbol("t", 0)).or_insert(0.4);
    Some(point)
}

/// The same states with other velocities, which satisfy no constraint.
pub(super) fn freed(cx: &Context<'_>, states: &[Point]) -> Vec<Point> {
    let mut generator = Generator::new(0xf4ee);
    let shifted = |state: &Point| {
        let shifts: Vec<(Symbol, f64)> = cx
            .system
            .coordinates
            .iter()
            .map(|c| (c.v_symbol, generator.between(-0.5, 0.5)))
            .collect();
        moved(state, &shifts)
    };
    states.iter().map(shifted).collect()
}

/// A state with some values shifted.
pub(super) fn moved(state: &Point, shifts: &[(Symbol, f64)]) -> Point {
    let mut state = state.clone();
    for &(symbol, shift) in shifts {
        state.entry(symbol).and_modify(|x| *x += shift);
    }
    state
}

/// Values at the states where all are defined and finite.
pub(super) fn values(subject: &Sampled<'_>, es: &[Expr], states: &[Point]) -> Vec<Vec<f64>> {
    let g = &subject.cx.system.graph;
    states
        .iter()
        .filter_map(|point| g.evaluate_f64(es, &|s: Symbol| point.get(&s).copied()).ok())
        .filter(|values| values.iter().all(|x| x.is_finite()))
        .collect()
}

/// Values beyond this say nothing of the equations of a system with parameters and states of size one.
const BEYOND: f64 = 1e9;

/// Whether `left` and `right` differ at admissible states, relatively to their size.
pub(super) fn differ(subject: &Sampled<'_>, left: &[Expr], right: &[Expr]) -> Size {
    let seen = differ_at(subject, left, right, &subject.states);
    if seen != Size::Unclear {
        return seen;
    }
    // Terms that cancel to many digits: more digits tell.
    let states = subject.states.iter();
    let shares: Vec<f64> = states
        .filter_map(|state| share_of_difference(subject, left, right, state))
        .collect();
    Size::of_shares(&shares)
}

fn differ_at(subject: &Sampled<'_>, left: &[Expr], right: &[Expr], states: &[Point]) -> Size {
    let all: Vec<Expr> = left.iter().chain(right).copied().collect();
    let values = values(subject, &all, states);
    Size::of(values.iter().flat_map(|values| {
        let (a, b) = values.split_at(left.len());
        let compared = a.iter().zip(b);
        compared
            .map(|(x, y)| (x - y, 1.0 + x.abs() + y.abs()))
            // A denominator that vanishes identically is rounding here, and its quotient no value.
            .filter(|(_, scale)| *scale < BEYOND)
    }))
}
