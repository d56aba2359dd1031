//! The cases in which a sine or cosine of an angle vanishes, and how they are written when all of them are found.
//!
//! `cos φ = 0` at φ = π/2 and at φ = −π/2: what else holds there may differ by signs, `u = b` and `u = −b`. The equation is
//! written where what else holds is the same, and the angle where it is not.

use super::{Leaf, Search};
use crate::stationarity::closed_form::short;
use crate::stationarity::motion::Motion;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::System;
use chetaev_symbolic::{rational, Expr, Function, Graph, Node, Symbol};

/// At most so many values of one angle.
pub(super) const VALUES: i64 = 8;

/// An angle at which a function vanishes.
#[derive(Clone, Debug)]
pub(super) struct Angle {
    /// The coordinate.
    pub(super) symbol: Expr,
    /// Its sine or cosine.
    pub(super) factor: Expr,
    /// The motion does not change when this multiple of 2π is added to the coordinate, and all zeros in it are cases; `None`
    /// where some are not.
    pub(super) period: Option<i64>,
    /// How many values were looked at.
    pub(super) of: usize,
    /// Whether all of them give the same.
    pub(super) whole: bool,
}

impl Search<'_, '_> {
    /// The values of an angle at which its sine or cosine vanishes.
    pub(super) fn as_angle(&self, factor: Expr) -> Option<(Angle, Vec<Expr>)> {
        let g = self.g;
        let Node::Apply {
            function,
            arguments,
        } = g.node(factor)
        else {
            return None;
        };
        let first = match function {
            Function::Sin => g.zero(),
            Function::Cos => g.div(g.pi(), g.integer(2)),
            _ => return None,
        };
        let angle = *arguments.first()?;
        let symbols = g.symbols_in(&[angle]);
        let own = *symbols.iter().find(|s| self.state.contains(s))?;
        let slope = g.diff(angle, own);
        let number = g.as_number(slope)?;
        let symbol = g.symbol_expr(own);
        let rest = g.sub(angle, g.mul(&[slope, symbol]));
        let period = period(self.cx.system, self.motion, own);
        let zeros = period.and_then(|period| {
            let zeros = rational::to_i64(&(rational::abs(number) * rational::integer(2 * period)))?;
            (zeros <= VALUES).then_some(zeros)
        });
        let count = zeros.unwrap_or(2);
        // 0, π, −π, 2π, …, and π/2, −π/2, 3π/2, …
        let sign = if *function == Function::Sin { 1 } else { -1 };
        let multiples = (0..count).map(|m| sign * if m % 2 == 0 { -(m / 2) } else { (m + 1) / 2 });
        let values = multiples.map(|m| {
            let at = g.add(&[first, g.mul(&[g.integer(m), g.pi()])]);
            short(g, g.div(g.sub(at, rest), slope))
        });
        let angle = Angle {
            symbol,
            factor,
            period: zeros.and(period),
            of: count as usize,
            whole: false,
        };
        Some((angle, values.collect()))
    }
}

/// The least d for which the motion has the period 2πd in a coordinate, which then stands in sines, cosines and tangents only.
pub(super) fn period(system: &System, motion: &Motion, symbol: Symbol) -> Option<i64> {
    let g = &system.graph;
    let all = motion.functions();
    let mut period = 1;
    let mut turned: Vec<(Expr, Expr)> = Vec::new();
    for e in g.reachable(&all) {
        let Node::Apply {
            function: Function::Sin | Function::Cos | Function::Tan,
            arguments,
        } = g.node(e)
        else {
            continue;
        };
        if !g.contains_any(e, &[symbol]) {
            continue;
        }
        let slope = g.as_number(g.diff(arguments[0], symbol))?;
        let denominator = i64::try_from(slope.denominator()).ok()?;
        period = lcm(period, denominator);
        let name = unused_name(system, &format!("turned_{}", turned.len()));
        turned.push((e, g.symbol(&name, 0)));
    }
    let rest = g.substitute_all(&all, &turned);
    (!g.any_contains_any(&rest, &[symbol])).then_some(period)
}

fn lcm(a: i64, b: i64) -> i64 {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    a / x * b
}

impl Leaf {
    /// The equation of an angle as long as other values may give something else.
    pub(super) fn written(g: &Graph, angle: Option<&Angle>, symbol: Expr, value: Expr) -> String {
        let (symbol, value) = (g.text(symbol), g.text(value));
        match angle.and_then(|angle| angle.period) {
            None => format!("{symbol} = {value}"),
            Some(1) => format!("{symbol} = {value} (mod 2 pi)"),
            Some(d) => format!("{symbol} = {value} (mod {} pi)", 2 * d),
        }
    }

    /// Whether all but the value of an angle is the same.
    fn differs_by(&self, g: &Graph, other: &Leaf, symbol: Expr) -> bool {
        let whole = |leaf: &Leaf, s: Expr| leaf.angles.iter().any(|a| a.whole && a.symbol == s);
        let rest = |leaf: &Leaf| -> Vec<(Expr, Option<Expr>)> {
            let pairs = leaf.solved.iter().filter(|(s, _)| *s != symbol);
            let mut pairs: Vec<_> = pairs
                .map(|&(s, value)| (s, (!whole(leaf, s)).then_some(value)))
                .collect();
            pairs.sort_by_key(|(s, _)| g.text(*s));
            pairs
        };
        rest(self) == rest(other)
            && self.implicit == other.implicit
            && self.kappa == other.kappa
            && self.nonzero == other.nonzero
            && self.at_rest == other.at_rest
    }
}

/// Sets that all values of an angle give become one, with the equation of the angle.
pub(crate) fn joined(g: &Graph, mut leaves: Vec<Leaf>) -> Vec<Leaf> {
    while let Some((first, place, others)) = joinable(g, &leaves) {
        let leaf = &mut leaves[first];
        let angle = &mut leaf.angles[place];
        angle.whole = true;
        let angle = angle.clone();
        let value = leaf.solved.iter().find(|(s, _)| *s == angle.symbol);
        if let Some(&(symbol, value)) = value {
            let before = Leaf::written(g, Some(&angle), symbol, value);
            let after = format!("{} = 0", g.text(angle.factor));
            for equation in leaf.equations.iter_mut().filter(|e| **e == before) {
                equation.clone_from(&after);
            }
        }
        let mut place = 0..;
        leaves.retain(|_| place.next().is_some_and(|i| !others.contains(&i)));
    }
    leaves
}

/// A set with the place of its angle, and those with the other values.
fn joinable(g: &Graph, leaves: &[Leaf]) -> Option<(usize, usize, Vec<usize>)> {
    leaves.iter().enumerate().find_map(|(first, leaf)| {
        let open = leaf.angles.iter().enumerate().filter(|(_, a)| !a.whole);
        open.filter(|(_, a)| a.period.is_some())
            .find_map(|(place, angle)| {
                let is_other = |other: &Leaf| {
                    let same = |a: &Angle| {
                        !a.whole && a.symbol == angle.symbol && a.factor == angle.factor
                    };
                    other.angles.iter().any(same) && leaf.differs_by(g, other, angle.symbol)
                };
                let others = leaves
                    .iter()
                    .enumerate()
                    .filter(|(i, other)| *i != first && is_other(other));
                let others: Vec<usize> = others.map(|(i, _)| i).collect();
                (others.len() + 1 == angle.of).then_some((first, place, others))
            })
    })
}
