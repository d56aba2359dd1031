//! Quantities whose vanishing makes the equations of motion singular: gradients of constraints, masses, radicands, denominators.
//!
//! An integrator can step across such a point without noticing (pursuit at the moment of capture). Each watched quantity
//! is non-negative; a local minimum along the motion that is zero to the accuracy of the run stops it.

use crate::functions::{Functions, FunctionsError};
use crate::numeric::Binding;
use chetaev_integrate::EvaluationFailure;
use chetaev_mechanics::system::Thrust;
use chetaev_mechanics::terms::freeze_accelerations;
use chetaev_mechanics::{mass, particles, MotionTerms, System};
use chetaev_symbolic::{rational, Expr, Node};

/// What vanishes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Watched {
    /// The squared length of the velocity gradient of constraint row `row`.
    Gradient {
        /// The row.
        row: usize,
    },
    /// The square of a mass.
    Mass {
        /// Of the particle, or of the mass with a law of its own.
        name: String,
    },
    /// The squared velocity of a particle with thrust against it.
    Speed {
        /// The particle.
        particle: String,
    },
    /// The argument of a root, or the square of a denominator.
    Expression {
        /// As printed.
        text: String,
    },
}

/// Watched quantities of a system, compiled.
#[derive(Clone, Debug)]
pub struct Watch {
    /// What they are.
    pub quantities: Vec<Watched>,
    functions: Functions,
    reference: Vec<f64>,
    n: usize,
}

/// Only the neighbourhood of zero is looked at: values below this fraction of the largest seen.
const NEAR: f64 = 1e-2;
/// A minimum below this fraction of the largest value counts as zero; the quantities are squares of lengths.
const ZERO: f64 = 1e-12;
/// Rates below this, relative to the largest value, count as none.
const FLAT: f64 = 1e-12;
/// A mass that would be zero this soon, relative to the time, has ended the run.
const SOON: f64 = 1e-3;
const MOST: usize = 12;

impl Watch {
    /// Collects what can vanish in the Lagrangian and the constraints of `system`.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        binding: &Binding,
    ) -> Result<Watch, FunctionsError> {
        let g = &system.graph;
        let mut found: Vec<(Watched, Expr)> = Vec::new();
        for (row, gradient) in terms.jacobian.iter().enumerate() {
            let squares: Vec<Expr> = gradient.iter().map(|&e| g.powi(e, 2)).collect();
            found.push((Watched::Gradient { row }, g.add(&squares)));
        }
        found.extend(masses(system));
        found.extend(speeds(system));
        let mut roots = terms.constraints.clone();
        roots.push(system.lagrangian);
        for e in g.reachable(&roots) {
            if let Some(value) = vanishing_part(system, e) {
                let text = g.text(value);
                found.push((Watched::Expression { text }, value));
            }
        }
        found.retain(|(_, value)| {
            !g.is_free_of(*value, &|s| {
                system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t"
            })
        });
        found.truncate(MOST);
        let values: Vec<Expr> = found.iter().map(|(_, value)| *value).collect();
        let drift = freeze_accelerations(system, &values);
        let slopes = g.jacobian(&values, &system.velocity_symbols()).concat();
        let groups = [("value", values), ("drift", drift), ("slope", slopes)];
        Ok(Watch {
            reference: vec![0.0; found.len()],
            quantities: found.into_iter().map(|(what, _)| what).collect(),
            functions: Functions::new(g, binding, &binding.variables, &groups)?,
            n: system.n(),
        })
    }

    /// Takes the values at (t, q, v) into account as ordinary ones.
    pub fn record(&mut self, t: f64, q: &[f64], v: &[f64]) {
        if self.functions.evaluate(t, &[q, v]).is_ok() {
            for (reference, &value) in self.reference.iter_mut().zip(self.functions.group(0)) {
                *reference = reference.max(value.abs());
            }
        }
    }

    /// The first quantity that is zero at the last recorded state.
    pub fn vanished(&self) -> Option<usize> {
        self.functions
            .group(0)
            .iter()
            .zip(&self.reference)
            .position(|(value, reference)| value.abs() <= ZERO * reference)
    }

    /// The rate of quantity `index`, which rises through zero at its minima.
    ///
    /// # Errors
    /// When a value is not finite.
    pub fn switching(
        &mut self,
        index: usize,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &[f64],
    ) -> Result<f64, EvaluationFailure> {
        self.functions.evaluate(t, &[q, v])?;
        let reference = self.reference[index].max(f64::MIN_POSITIVE);
        let slope = &self.functions.group(2)[index * self.n..(index + 1) * self.n];
        let along: f64 = slope.iter().zip(a).map(|(s, a)| s * a).sum();
        let rate = (self.functions.group(1)[index] + along) / reference;
        // The rate of a constant is rounding: its zeros are none.
        Ok(if rate.abs() < FLAT { -FLAT } else { rate })
    }

    /// The mass that a run lost whose last state is (t, q, v), with the time at which it reaches zero at its present rate: soon,
    /// or at the time `singular` where the equations have no value. The velocities may grow without bound before the mass is
    /// zero to rounding, and a long step may end where it is zero.
    pub fn lost_mass(
        &mut self,
        (t, singular): (f64, Option<f64>),
        q: &[f64],
        v: &[f64],
        a: &[f64],
    ) -> Option<(usize, f64)> {
        self.functions.evaluate(t, &[q, v]).ok()?;
        let (values, drift, slopes) = (
            self.functions.group(0),
            self.functions.group(1),
            self.functions.group(2),
        );
        let masses = self.quantities.iter().enumerate();
        let mut lost = masses.filter_map(|(index, what)| {
            let small = values[index] <= NEAR * self.reference[index];
            if !matches!(what, Watched::Mass { .. }) {
                return None;
            }
            let slope = &slopes[index * self.n..(index + 1) * self.n];
            let along: f64 = slope.iter().zip(a).map(|(s, a)| s * a).sum();
            // The square of a mass has twice the relative rate of the mass; where it is zero it has none.
            let left = match values[index] <= ZERO * self.reference[index] {
                true => 0.0,
                false => -2.0 * values[index] / (drift[index] + along),
            };
            let soon = |gap: f64, at: f64| gap.abs() <= SOON * (1.0 + at.abs());
            let there = singular.is_some_and(|at| soon(t + left - at, at));
            (there || small && soon(left, t)).then_some((index, t + left))
        });
        lost.next()
    }

    /// Whether quantity `index` is small enough at (t, q, v) for its minimum to be looked at closely.
    pub fn is_near(&mut self, index: usize, t: f64, q: &[f64], v: &[f64]) -> bool {
        match self.functions.evaluate(t, &[q, v]) {
            Ok(()) => self.functions.group(0)[index].abs() <= NEAR * self.reference[index],
            Err(_) => true,
        }
    }

    /// Whether quantity `index` is zero at (t, q, v), measured by its size along the run.
    pub fn vanishes(&mut self, index: usize, t: f64, q: &[f64], v: &[f64]) -> bool {
        match self.functions.evaluate(t, &[q, v]) {
            Ok(()) => self.functions.group(0)[index].abs() <= ZERO * self.reference[index],
            Err(_) => true,
        }
    }
}

/// The squares of the masses that vary, each once.
fn masses(system: &System) -> Vec<(Watched, Expr)> {
    let g = &system.graph;
    let of_particles = system.particles.iter().map(|p| (&p.name, p.mass));
    let own = system.masses.iter().map(|m| (&m.name, m.expr));
    let mut seen: Vec<Expr> = Vec::new();
    let mut found = Vec::new();
    for (name, value) in own.chain(of_particles) {
        if !mass::varies(system, value) || seen.contains(&value) {
            continue;
        }
        seen.push(value);
        let name = name.clone();
        found.push((Watched::Mass { name }, g.powi(value, 2)));
    }
    found
}

/// The squared velocities of the particles with thrust against them.
fn speeds(system: &System) -> Vec<(Watched, Expr)> {
    let g = &system.graph;
    let driven = system
        .particles
        .iter()
        .filter(|p| matches!(p.thrust, Thrust::ExhaustSpeed(_)) && mass::varies(system, p.mass));
    driven
        .map(|p| {
            let components = particles::velocity(system, p).into_iter();
            let squares: Vec<Expr> = components.map(|e| g.powi(e, 2)).collect();
            let particle = p.name.clone();
            (Watched::Speed { particle }, g.add(&squares))
        })
        .collect()
}

/// The base of a root; the square of the base of a negative power.
fn vanishing_part(system: &System, e: Expr) -> Option<Expr> {
    let g = &system.graph;
    let Node::Power { base, exponent } = g.node(e) else {
        return None;
    };
    let exponent = g.as_number(*exponent)?;
    if g.as_number(*base).is_some() {
        return None;
    }
    if !exponent.is_int() {
        return Some(*base);
    }
    rational::is_negative(exponent).then(|| g.powi(*base, 2))
}
