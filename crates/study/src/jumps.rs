//! Functions that jump along a motion, as an angle of two arguments does at its cut: what they keep, they keep between the jumps.

use chetaev_motion::Binding;
use chetaev_symbolic::{rational, Expr, Function, Graph, Node};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Sub;

/// A part of a function that jumps, and by how much it changes from one row to the next only where it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    /// The part.
    pub(crate) value: Expr,
    step: f64,
}

/// The jumps met along a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Jumps {
    /// The parts that jump.
    pub parts: Vec<Expr>,
    /// The time of the row before which the first was met.
    pub first: f64,
}

/// The parts of a function that may jump: signs, angles of two arguments, and inverse tangents of what has poles.
pub(crate) fn parts(g: &Graph, e: Expr) -> Vec<Part> {
    let has_pole = |e: &Expr| {
        g.reachable(&[*e])
            .into_iter()
            .any(|part| match g.node(part) {
                Node::Power { exponent, .. } => {
                    g.as_number(*exponent).is_some_and(rational::is_negative)
                }
                Node::Apply { function, .. } => matches!(
                    function,
                    Function::Tan | Function::Cot | Function::Sec | Function::Csc
                ),
                _ => false,
            })
    };
    let of = |part: Expr| {
        let Node::Apply {
            function,
            arguments,
        } = g.node(part)
        else {
            return None;
        };
        let step = match function {
            Function::Sign => 0.5,
            Function::Atan2 => PI,
            Function::Atan if arguments.iter().any(has_pole) => FRAC_PI_2,
            Function::Tanh if arguments.iter().any(has_pole) => 1.0,
            _ => return None,
        };
        Some(Part { value: part, step })
    };
    g.reachable(&[e]).into_iter().filter_map(of).collect()
}

/// The jumps of parts with these values at the rows, and the rows that they come before.
pub(crate) fn met(
    times: &[f64],
    parts: &[Part],
    values: &[Vec<f64>],
) -> Option<(Jumps, Vec<usize>)> {
    let jumps =
        |part: &Part, values: &[f64], j: usize| (values[j] - values[j - 1]).abs() > part.step;
    let own = || parts.iter().zip(values);
    let rows = (1..times.len()).filter(|&j| own().any(|(part, values)| jumps(part, values, j)));
    let rows: Vec<usize> = rows.collect();
    let jumping = own().filter(|(part, values)| rows.iter().any(|&j| jumps(part, values, j)));
    let jumps = Jumps {
        parts: jumping.map(|(part, _)| part.value).collect(),
        first: times[*rows.first()?],
    };
    Some((jumps, rows))
}

/// Changes from the first value without what changed across jumps before these rows.
pub(crate) fn between<S: Copy + Sub<Output = S>>(values: &[S], rows: &[usize]) -> Vec<S> {
    let mut changes: Vec<S> = Vec::with_capacity(values.len());
    let Some(mut reference) = values.first().copied() else {
        return changes;
    };
    for (j, &value) in values.iter().enumerate() {
        if let (true, Some(&last)) = (rows.contains(&j), changes.last()) {
            reference = value - last;
        }
        changes.push(value - reference);
    }
    changes
}

/// What a whole turn changes in a sum of angles of two arguments with constant factors and of terms without jumps.
pub(crate) fn turn(g: &Graph, binding: &Binding, e: Expr, parts: &[Part]) -> Option<f64> {
    let mut smallest: Option<f64> = None;
    let mut factors = Vec::new();
    for part in parts {
        if !matches!(
            g.node(part.value),
            Node::Apply {
                function: Function::Atan2,
                ..
            }
        ) {
            return None;
        }
        let factor = factor(g, binding, e, (part.value, parts))?.abs();
        smallest = Some(smallest.map_or(factor, |x| x.min(factor)));
        factors.push(factor);
    }
    let smallest = smallest.filter(|x| *x > 0.0)?;
    let is_whole = |x: &f64| (x / smallest - (x / smallest).round()).abs() < WHOLE;
    factors.iter().all(is_whole).then_some(TAU * smallest)
}

/// Quotients that differ by less from a whole number are one.
const WHOLE: f64 = 1e-12;

/// The number by which a part is multiplied in a sum whose other terms, and factors, are free of all parts.
fn factor(g: &Graph, binding: &Binding, e: Expr, (part, all): (Expr, &[Part])) -> Option<f64> {
    let name = g.symbol("angle", 0);
    let others = all.iter().filter(|own| own.value != part);
    let mut pairs: Vec<(Expr, Expr)> = others.map(|own| (own.value, g.zero())).collect();
    pairs.push((part, name));
    let slope = g.diff(g.substitute(e, &pairs), g.as_symbol(name)?);
    let number = |symbol| {
        let mut known = binding.parameters.iter();
        known.find(|(own, _)| *own == symbol).map(|(_, x)| *x)
    };
    g.evaluate_f64(&[slope], &number).ok()?.first().copied()
}

/// A change less whole turns.
pub(crate) fn without_turns(change: f64, turn: f64) -> f64 {
    change - turn * (change / turn).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_changes_across_a_jump_is_left_out() {
        assert_eq!(between(&[1.0, 1.5, -4.0, -3.0], &[2]), [0.0, 0.5, 0.5, 1.5]);
        assert_eq!(between(&[1.0, 3.0], &[]), [0.0, 2.0]);
        assert!((without_turns(4.0 * PI + 1e-3, TAU) - 1e-3).abs() < 1e-14);
    }

    #[test]
    fn jumps_are_told_from_changes() {
        let g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, 0));
        let angle = g.apply(Function::Atan2, &[y, x]);
        let own = parts(&g, g.add(&[angle, x]));
        let times = [0.0, 1.0, 2.0];
        let (jumps, rows) = met(&times, &own, &[vec![2.0, 3.0, -3.0]]).unwrap();
        assert_eq!(
            (jumps.parts, jumps.first, rows),
            (vec![angle], 2.0, vec![2])
        );
        assert!(met(&times, &own, &[vec![0.0, 1.0, 2.0]]).is_none());
        assert!(parts(&g, g.apply(Function::Atan, &[x])).is_empty());
    }

    #[test]
    fn a_turn_is_known_where_factors_are_constant() {
        let g = Graph::new();
        let [x, y, k] = ["x", "y", "k"].map(|name| g.symbol(name, 0));
        let binding = Binding {
            parameters: vec![(g.intern_symbol("k", 0), 2.0)],
            controls: Vec::new(),
            variables: Vec::new(),
        };
        let angle = |a, b| g.apply(Function::Atan2, &[a, b]);
        let (one, other) = (angle(y, x), angle(x, y));
        let of = |e: Expr| turn(&g, &binding, e, &parts(&g, e));
        assert_eq!(of(g.add(&[g.mul(&[k, one]), x])), Some(2.0 * TAU));
        assert_eq!(of(g.add(&[g.mul(&[k, one]), other])), Some(TAU));
        assert_eq!(of(g.mul(&[x, one])), None);
        assert_eq!(of(g.powi(one, 2)), None);
        assert_eq!(of(x), None);
    }
}
