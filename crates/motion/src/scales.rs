//! The natural size of each coordinate and velocity, from the data of a start: powers of two, so that a model in other units has the
//! same steps, to the bit.
//!
//! Velocities are compared by the kinetic energy of the start, or the work that the forces there can do; coordinates by what their
//! velocities cover in the shortest time that the data name. A coordinate in the argument of a sine or an exponential has no
//! dimension, and its size is one.

use crate::accelerations::Accelerations;
use crate::initial::ConsistentState;
use crate::numeric::NumericSystem;
use chetaev_mechanics::{MotionTerms, System};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol};
use std::collections::BTreeSet;

/// Natural sizes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scales {
    /// Of the coordinates, and behind them the masses with a law of their own.
    pub positions: Vec<f64>,
    /// Of the velocities.
    pub velocities: Vec<f64>,
}

/// Velocities count as no smaller than this part of what the whole kinetic energy would give them.
const LEAST: f64 = 0.25;

impl Scales {
    /// The sizes at the start of a run that ends at `t_end`, with the parameters of `numeric`; all one where the equations have no value there.
    pub fn new(start: &ConsistentState, numeric: &NumericSystem, t_end: f64) -> Scales {
        let mut numeric = numeric.clone();
        let n = numeric.n;
        let ones = Scales {
            positions: vec![1.0; start.q.len()],
            velocities: vec![1.0; n],
        };
        if numeric.evaluate(start.t, &start.q, &start.v).is_err() {
            return ones;
        }
        let masses: Vec<f64> = numeric.mass_diagonal().iter().map(|m| m.abs()).collect();
        let is_angle = numeric.angles.clone();
        let span = (t_end - start.t).abs();
        let q = &start.q[..n];
        let length = |i: usize| if is_angle[i] { 1.0 } else { q[i].abs() };
        let kinetic = |v: &[f64]| v.iter().zip(&masses).map(|(v, m)| m * v * v).sum::<f64>();
        let work = |i: usize| numeric.force()[i].abs() * length(i);
        let mut energy = kinetic(&start.v).max((0..n).map(work).fold(0.0, f64::max));
        if energy == 0.0 {
            let mut accelerations = Accelerations::default();
            if accelerations.solve(&numeric, &start.chart).is_ok() {
                energy = kinetic(&accelerations.a) * span * span;
            }
        }
        // By the metric all coordinates, and all velocities, become numbers of one kind.
        let root = |i: usize| masses[i].sqrt();
        let speed = energy.sqrt();
        let times = (0..n).map(|i| root(i) * length(i) / speed);
        let longest = times.filter(|t| t.is_finite()).fold(0.0, f64::max);
        let time = if longest > 0.0 {
            longest.min(span)
        } else {
            span
        };
        let mut scales = ones;
        for i in 0..n {
            let by_energy = speed / root(i);
            let known = if by_energy.is_finite() {
                by_energy
            } else {
                0.0
            };
            let own = start.v[i].abs().max(LEAST * known);
            scales.positions[i] = if is_angle[i] {
                1.0
            } else {
                power(q[i].abs().max(own * time))
            };
            scales.velocities[i] = if own > 0.0 {
                power(own)
            } else {
                power(scales.positions[i] / span)
            };
        }
        for (scale, mass) in scales.positions[n..].iter_mut().zip(&start.q[n..]) {
            *scale = power(mass.abs());
        }
        scales
    }

    /// Of a state of coordinates and velocities.
    pub(crate) fn of_state(&self) -> Vec<f64> {
        [&self.positions[..], &self.velocities].concat()
    }
}

/// The power of two nearest to a positive number by ratio; one for what is none.
pub(crate) fn power(x: f64) -> f64 {
    if !(x.is_finite() && x >= f64::MIN_POSITIVE) {
        return 1.0;
    }
    // The exponent alone, and one more from the square root of two on.
    let exponent = f64::from_bits(x.to_bits() & 0x7FF0_0000_0000_0000);
    if x / exponent >= std::f64::consts::SQRT_2 {
        2.0 * exponent
    } else {
        exponent
    }
}

/// Coordinates that stand in the argument of a function that has no dimension, by themselves or with a number.
pub(crate) fn angles(system: &System, terms: &MotionTerms) -> Vec<bool> {
    let g = &system.graph;
    let mut roots = terms.mass_matrix.concat();
    roots.extend(terms.jacobian.concat());
    roots.extend(&terms.force);
    roots.extend(&terms.constraints);
    roots.push(system.lagrangian);
    let found = arguments(g, &roots);
    let coordinates = system.coordinate_symbols();
    coordinates.iter().map(|q| found.contains(q)).collect()
}

/// Symbols that are an argument, or a term of one with a number before it.
fn arguments(g: &Graph, roots: &[Expr]) -> BTreeSet<Symbol> {
    use Function::{Abs, Atan2, Log, Sign};
    let mut found = BTreeSet::new();
    for part in g.reachable(roots) {
        let Node::Apply {
            function,
            arguments,
        } = g.node(part)
        else {
            continue;
        };
        // Of lengths too.
        if matches!(function, Abs | Sign | Atan2 | Log) {
            continue;
        }
        for argument in arguments.iter() {
            match g.node(*argument) {
                Node::Sum { terms, .. } => {
                    found.extend(terms.iter().filter_map(|(term, _)| g.as_symbol(*term)))
                }
                Node::Product { factors, .. } if factors.len() == 1 => {
                    found.extend(g.as_symbol(factors[0]));
                }
                _ => found.extend(g.as_symbol(*argument)),
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_power_of_two() {
        for (x, wanted) in [
            (1.0, 1.0),
            (1.4, 1.0),
            (1.5, 2.0),
            (3.0, 4.0),
            (0.3, 0.25),
            (0.0, 1.0),
        ] {
            assert_eq!(power(x), wanted, "{x}");
            // In other units the same one.
            assert!(x == 0.0 || power(x * 2f64.powi(-500)) == wanted * 2f64.powi(-500));
        }
    }
}
