//! Quantities whose vanishing makes the equations of motion singular: gradients of constraints, masses, radicands, denominators.
//!
//! An integrator can step across such a point without noticing (pursuit at the moment of capture). Each watched quantity
//! is non-negative; a local minimum along the motion that is zero to the accuracy of the run stops it.

use crate::functions::{Functions, FunctionsError};
use crate::numeric::Binding;
use crate::positive::corners;
use crate::sticking::Sticking;
use chetaev_integrate::EvaluationFailure;
use chetaev_mechanics::equations::RegularMatrix;
use chetaev_mechanics::system::Thrust;
use chetaev_mechanics::terms::freeze_accelerations;
use chetaev_mechanics::{mass, particles, MotionTerms, System};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{rational, Expr, Node, Symbol};

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
    /// The squared determinant of a matrix on which the equations depend.
    Regularity {
        /// What matrix.
        matrix: String,
    },
    /// The squared determinant of the equations for these unknowns.
    Structure {
        /// Their names.
        unknowns: String,
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
    /// How many numbers say whether each quantity is positive everywhere ([`corners`]); none where it may vanish.
    corners: Vec<usize>,
    /// Whether all are, with the present parameters: then nothing is watched.
    is_idle: bool,
    /// Functions under a sign in the forces, on whose zeros the motion may stick.
    pub(crate) sticking: Option<Sticking>,
}

/// Only the neighbourhood of zero is looked at: values below this fraction of the largest seen.
const NEAR: f64 = 1e-2;
/// A minimum below this fraction of the largest value counts as zero; the quantities are squares of lengths.
const ZERO: f64 = 1e-12;
/// The same for the square of a determinant.
const ZERO_DETERMINANT: f64 = 1e-22;
/// Rates below this, relative to the largest value, count as none.
const FLAT: f64 = 1e-12;
/// A mass that would be zero this soon, relative to the time, has ended the run.
const SOON: f64 = 1e-3;
const MOST: usize = 12;

impl Watch {
    /// Collects what can vanish in the Lagrangian and the constraints of `system`. Where `rank` independent constraints imply others,
    /// no single gradient says where the rank falls, and none is watched: the rank of all is followed.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        binding: &Binding,
        rank: usize,
    ) -> Result<Watch, FunctionsError> {
        let g = &system.graph;
        let mut found: Vec<(Watched, Expr)> = Vec::new();
        let are_independent = rank == terms.constraints.len();
        // Where sheets of finite constraints cross, the motion may go on: their rank is followed too.
        let is_finite = |row: usize| system.constraints[terms.constraint_index[row]].order == 0;
        let gradients = terms.jacobian.iter().enumerate();
        for (row, gradient) in gradients.filter(|(row, _)| are_independent && !is_finite(*row)) {
            // A gradient with a number among its entries vanishes nowhere.
            let is_number = |&e: &Expr| g.as_number(e).is_some() && !g.is_zero(e);
            if gradient.iter().any(is_number) {
                continue;
            }
            let squares: Vec<Expr> = gradient.iter().map(|&e| g.powi(e, 2)).collect();
            found.push((Watched::Gradient { row }, g.add(&squares)));
        }
        found.extend(masses_and_speeds(system));
        found.retain(|(_, value)| {
            !g.is_free_of(*value, &|s| {
                system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t"
            })
        });
        found.extend(vanishing_parts(system, &terms.constraints));
        found.truncate(MOST);
        let is_parameter = |s| binding.parameters.iter().any(|own| own.0 == s);
        let bounds = |value| corners(g, value, &|s| !is_parameter(s)).unwrap_or_default();
        let bounds: Vec<Vec<Expr>> = found.iter().map(|own| bounds(own.1)).collect();
        let values: Vec<Expr> = found.iter().map(|(_, value)| *value).collect();
        let drift = freeze_accelerations(system, &values);
        let slopes = g.jacobian(&values, &system.velocity_symbols()).concat();
        let corners = bounds.iter().map(Vec::len).collect();
        let groups = [
            ("value", values),
            ("drift", drift),
            ("slope", slopes),
            ("corner", bounds.concat()),
        ];
        Ok(Watch {
            reference: vec![0.0; found.len()],
            quantities: found.into_iter().map(|(what, _)| what).collect(),
            functions: Functions::new(g, binding, &binding.variables, &groups)?,
            n: system.n(),
            corners,
            is_idle: false,
            sticking: Sticking::new(system, terms, binding)?,
        })
    }

    /// What [`new`](Watch::new) watches and a determinant, as functions of t and the variables of a state.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn with_determinant(
        (system, terms): (&System, &MotionTerms),
        binding: &Binding,
        variables: &[Symbol],
        regular: &RegularMatrix,
    ) -> Result<Watch, FunctionsError> {
        let g = &system.graph;
        let matrix = regular.name.to_owned();
        let square = g.powi(determinant(g, &regular.rows), 2);
        let mut found = vec![(Watched::Regularity { matrix }, square)];
        found.extend(masses_and_speeds(system));
        found.extend(vanishing_parts(system, &terms.constraints));
        Watch::of_state(system, binding, variables, found)
    }

    /// Quantities as functions of t and the variables of a state of any kind; where (q, v, a) are meant below, the state in
    /// two pieces and the rates of all its variables are given.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn of_state(
        system: &System,
        binding: &Binding,
        variables: &[Symbol],
        mut found: Vec<(Watched, Expr)>,
    ) -> Result<Watch, FunctionsError> {
        let g = &system.graph;
        found.truncate(MOST);
        let values: Vec<Expr> = found.iter().map(|(_, value)| *value).collect();
        let state = &variables[1..];
        let drift = g.derive(&values, &|s| match state.contains(&s) {
            true => None,
            false => system.prescribed_rate(s),
        });
        let slopes = g.jacobian(&values, state).concat();
        let groups = [("value", values), ("drift", drift), ("slope", slopes)];
        Ok(Watch {
            reference: vec![0.0; found.len()],
            quantities: found.into_iter().map(|(what, _)| what).collect(),
            functions: Functions::new(g, binding, variables, &groups)?,
            n: state.len(),
            corners: Vec::new(),
            is_idle: false,
            sticking: None,
        })
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        if let Some(sticking) = &mut self.sticking {
            sticking.set_parameters(values)?;
        }
        self.functions.set_parameters(values)
    }

    /// Forgets the values seen, for a run from (t, q, v).
    pub(crate) fn begin(&mut self, t: f64, q: &[f64], v: &[f64]) {
        self.reference.fill(0.0);
        if let Some(sticking) = &mut self.sticking {
            sticking.begin(t, q, v);
        }
        self.is_idle = false;
        self.record(t, q, v);
        self.is_idle = !self.quantities.is_empty() && self.are_positive(t, q, v);
    }

    /// Whether no quantity comes near zero at any state, with the present parameters.
    fn are_positive(&mut self, t: f64, q: &[f64], v: &[f64]) -> bool {
        if self.corners.is_empty() || self.functions.evaluate(t, &[q, v]).is_err() {
            return false;
        }
        let mut rest = self.functions.group(3);
        self.corners.iter().all(|&count| {
            let (own, others) = rest.split_at(count);
            rest = others;
            let least = own.iter().copied().fold(f64::INFINITY, f64::min);
            let largest = own.iter().copied().fold(0.0, f64::max);
            count > 0 && least > ZERO * largest
        })
    }

    /// The quantities to be watched in a run, after [`begin`](Watch::begin): none where none can vanish.
    pub(crate) fn wanted(&self) -> Vec<Watched> {
        match self.is_idle {
            true => Vec::new(),
            false => self.quantities.clone(),
        }
    }

    /// Takes the values at (t, q, v) into account as ordinary ones.
    pub fn record(&mut self, t: f64, q: &[f64], v: &[f64]) {
        let is_watched = !self.quantities.is_empty() && !self.is_idle;
        if is_watched && self.functions.evaluate(t, &[q, v]).is_ok() {
            for (reference, &value) in self.reference.iter_mut().zip(self.functions.group(0)) {
                *reference = reference.max(value.abs());
            }
        }
    }

    /// The first quantity that is zero at the last recorded state.
    pub fn vanished(&self) -> Option<usize> {
        if self.is_idle {
            return None;
        }
        let values = self.functions.group(0).iter().zip(&self.reference);
        values
            .enumerate()
            .position(|(index, (value, reference))| value.abs() <= self.zero(index) * reference)
    }

    /// What counts as zero: lengths that vanish are seen squared, determinants may vanish as a product of several.
    fn zero(&self, index: usize) -> f64 {
        match self.quantities[index] {
            Watched::Structure { .. } => ZERO_DETERMINANT,
            _ => ZERO,
        }
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
            let left = -2.0 * values[index] / (drift[index] + along);
            let left = if left.is_finite() { left } else { 0.0 };
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
            Ok(()) => {
                self.functions.group(0)[index].abs() <= self.zero(index) * self.reference[index]
            }
            Err(_) => true,
        }
    }
}

/// What can vanish in constraints and in the Lagrangian, and moves.
pub(crate) fn vanishing_parts(system: &System, constraints: &[Expr]) -> Vec<(Watched, Expr)> {
    let g = &system.graph;
    let mut roots = constraints.to_vec();
    roots.push(system.lagrangian);
    let parts = g.reachable(&roots).into_iter();
    // Forces are not differentiated: only what they divide by matters.
    let in_forces = g.reachable(&system.forces).into_iter();
    let divided = in_forces.filter(|e| match g.node(*e) {
        Node::Power { exponent, .. } => g.as_number(*exponent).is_some_and(rational::is_negative),
        _ => false,
    });
    let mut parts: Vec<Expr> = parts.chain(divided).collect();
    let mut seen = std::collections::BTreeSet::new();
    parts.retain(|e| seen.insert(*e));
    let parts = parts.into_iter();
    let moving = |value: &Expr| {
        !g.is_free_of(*value, &|s| {
            system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t"
        })
    };
    parts
        .filter_map(|e| vanishing_part(system, e))
        .filter(moving)
        .map(|value| {
            (
                Watched::Expression {
                    text: g.text(value),
                },
                value,
            )
        })
        .collect()
}

/// The squares of the masses that vary, and of the velocities of particles with thrust against them.
pub(crate) fn masses_and_speeds(system: &System) -> Vec<(Watched, Expr)> {
    masses(system).into_iter().chain(speeds(system)).collect()
}

/// The squares of the masses that vary, each once.
fn masses(system: &System) -> Vec<(Watched, Expr)> {
    let g = &system.graph;
    let of_particles = system.particles.iter().map(|p| (&p.name, p.mass));
    let own = system.masses.iter().map(|m| (&m.name, m.expr));
    let named = system
        .mass_functions
        .iter()
        .map(|(name, value)| (name, *value));
    let mut seen: Vec<Expr> = Vec::new();
    let mut found = Vec::new();
    for (name, value) in own.chain(of_particles).chain(named) {
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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

    use super::*;
    use chetaev_mechanics::SystemParts;
    use chetaev_symbolic::Graph;
    use std::sync::Arc;

    /// The watch on a x' sin φ = b y' cos φ, whose gradient is (a sin φ, −b cos φ, 0).
    fn blade() -> Watch {
        let g = Arc::new(Graph::new());
        let [phi, a, b] = ["phi", "a", "b"].map(|name| g.symbol(name, 0));
        let [vx, vy, w] = ["x", "y", "phi"].map(|name| g.symbol(name, 1));
        let squares: Vec<Expr> = [vx, vy, w].iter().map(|&v| g.powi(v, 2)).collect();
        let blade = g.sub(g.mul(&[a, vx, g.sin(phi)]), g.mul(&[b, vy, g.cos(phi)]));
        let number = |n| Some(g.integer(n));
        let parts = SystemParts {
            coordinates: ["x", "y", "phi"].map(String::from).to_vec(),
            parameters: vec![("a".into(), number(2)), ("b".into(), number(3))],
            lagrangian: Some(g.div(g.add(&squares), g.integer(2))),
            constraints: vec![("blade".into(), blade)],
            ..SystemParts::default()
        };
        let system = System::new(g, parts).unwrap();
        let binding = Binding::new(&system).unwrap();
        Watch::new(
            &system,
            &MotionTerms::new(&system),
            &binding,
            system.constraints.len(),
        )
        .unwrap()
    }

    #[test]
    fn what_vanishes_nowhere_is_not_watched() {
        let mut watch = blade();
        let whole = vec![Watched::Gradient { row: 0 }];
        assert_eq!(watch.quantities, whole);
        let (q, v) = ([0.0; 3], [1.0, 0.0, 0.5]);
        watch.begin(0.0, &q, &v);
        assert_eq!((watch.wanted(), watch.vanished()), (Vec::new(), None));
        // Without b the gradient vanishes at φ = 0; a small b is rounding beside a.
        for b in [0.0, 1e-8] {
            watch.set_parameters(&[2.0, b]).unwrap();
            watch.begin(0.0, &[0.0, 0.0, 1.0], &v);
            assert_eq!((watch.wanted(), watch.vanished()), (whole.clone(), None));
            watch.record(0.1, &q, &v);
            assert_eq!(watch.vanished(), Some(0), "b = {b}");
        }
        watch.set_parameters(&[2.0, -0.1]).unwrap();
        watch.begin(0.0, &q, &v);
        assert_eq!(watch.wanted(), Vec::new());
    }
}
