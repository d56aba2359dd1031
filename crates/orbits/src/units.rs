//! Units in which the variables of a flow and their rates are of the size of one.
//!
//! What is small, how far a step goes, and when a residual vanishes are decided in absolute numbers; a system of atoms or of planets is one of
//! these sizes in units of its own. They are powers of two, so that nothing is rounded: those in which the matrix of the linear equations is
//! balanced (Parlett and Reinsch 1969), times the size of the state.

use crate::branch::{Branch, Kind, Point};
use crate::error::OrbitError;
use crate::flow::{Divisors, Flow};
use chetaev_stability::eigenvalues::balanced;
use chetaev_symbolic::{Expr, Rational};

/// Units of variables and of the time: a variable is its scale times a number, and a time is a number over the rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    /// Those of the variables.
    pub scale: Vec<f64>,
    /// One over that of the time.
    pub rate: f64,
}

impl Units {
    /// Those that a flow has as it stands.
    pub(crate) fn ones(n: usize) -> Units {
        Units {
            scale: vec![1.0; n],
            rate: 1.0,
        }
    }

    /// Those of a flow near a state. Angles stay as they are, and so does the time where it is explicit.
    pub fn of(flow: &Flow, state: &[f64]) -> Units {
        let n = flow.n();
        let parameters: Vec<f64> = flow.parameters.iter().map(|own| own.1).collect();
        let Some(slopes) = flow.slopes(state, &parameters) else {
            return Units::ones(n);
        };
        if n == 0 || !slopes.iter().all(|x| x.is_finite()) {
            return Units::ones(n);
        }
        let own = balanced(&slopes);
        let turning = (0..n).find(|&i| flow.is_turning[i]);
        let size = match turning {
            Some(i) => own.scale[i].recip(),
            None => {
                let sizes = state.iter().zip(&own.scale);
                sizes.map(|(x, d)| x.abs() / d).fold(0.0, f64::max)
            }
        };
        let size = power_of_two(size);
        let scale = |i: usize| {
            if flow.is_turning[i] {
                1.0
            } else {
                power_of_two(size * own.scale[i])
            }
        };
        let largest = own.matrix.amax() * own.unit;
        Units {
            scale: (0..n).map(scale).collect(),
            rate: if flow.is_autonomous() {
                power_of_two(largest)
            } else {
                1.0
            },
        }
    }

    /// A state in these units.
    pub fn packed(&self, state: &[f64]) -> Vec<f64> {
        state.iter().zip(&self.scale).map(|(x, s)| x / s).collect()
    }

    /// A curve that was found in these units, as it is; the unknowns of an orbit have its period last.
    pub fn restored(&self, branch: Branch, is_orbit: bool) -> Branch {
        let point = |own: Point| {
            let scales = self.scale.iter().copied().chain([self.rate.recip()]);
            let unknowns = own.unknowns.iter().zip(scales).map(|(x, s)| x * s);
            let mut spectrum = own.spectrum;
            if !is_orbit {
                spectrum.values.iter_mut().for_each(|l| *l *= self.rate);
                spectrum.errors.iter_mut().for_each(|e| *e *= self.rate);
            }
            Point {
                unknowns: unknowns.collect(),
                spectrum,
                ..own
            }
        };
        let special = branch.special.into_iter().map(|mut own| {
            if let Kind::Hopf { frequency, .. } = &mut own.kind {
                *frequency *= self.rate;
            }
            own.point = point(own.point);
            own
        });
        Branch {
            special: special.collect(),
            points: branch.points.into_iter().map(point).collect(),
            ..branch
        }
    }

    /// An error with times as they are.
    pub fn restored_error(&self, problem: OrbitError) -> OrbitError {
        match problem {
            OrbitError::NoReturn { end } => OrbitError::NoReturn {
                end: end / self.rate,
            },
            OrbitError::EndsEarly { t, end, stop } => OrbitError::EndsEarly {
                t: t / self.rate,
                end: end / self.rate,
                stop,
            },
            other => other,
        }
    }
}

impl Flow {
    /// The same in other units.
    pub fn in_units(&self, units: &Units) -> Flow {
        let g = &self.graph;
        let number = |x: f64| g.number(Rational::try_from(x).unwrap_or(Rational::ONE));
        let variables = self.variables.iter().zip(&units.scale);
        let variables = variables.map(|(&s, &scale)| (g.symbol_expr(s), scale));
        let time = (g.symbol_expr(self.time()), units.rate.recip());
        let put: Vec<(Expr, Expr)> = variables
            .chain([time])
            .filter(|own| own.1 != 1.0)
            .map(|(e, scale)| (e, g.mul(&[number(scale), e])))
            .collect();
        let in_units = |es: &[Expr]| g.substitute_all(es, &put);
        let over = |(e, scale): (Expr, f64)| g.mul(&[number(scale.recip()), e]);
        let rates = in_units(&self.rates).into_iter().zip(&units.scale);
        let definitions = self.definitions.iter().copied().zip(&units.scale);
        let rows = |rows: &[Vec<Expr>]| rows.iter().map(|row| in_units(row)).collect();
        let conserved = self.conserved.iter();
        let conserved = conserved.map(|(name, e)| (name.clone(), in_units(&[*e])[0]));
        Flow {
            rates: rates.map(|(e, s)| over((e, s * units.rate))).collect(),
            definitions: definitions.map(|(e, &s)| over((e, s))).collect(),
            velocities: in_units(&self.velocities),
            finite: in_units(&self.finite),
            conserved: conserved.collect(),
            divisors: Divisors {
                mass: rows(&self.divisors.mass),
                gradients: rows(&self.divisors.gradients),
                slopes: rows(&self.divisors.slopes),
            },
            units: units.clone(),
            ..self.clone()
        }
    }
}

/// The power of two at or below a positive number; 1 for what is none.
fn power_of_two(size: f64) -> f64 {
    let found = size.log2().floor().exp2();
    if found.is_normal() {
        found
    } else {
        1.0
    }
}
