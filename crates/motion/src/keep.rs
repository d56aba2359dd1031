//! First integrals whose values a run keeps: after each step the state is moved onto constraints and integrals by the least change.
//!
//! The standard projection of E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section IV.4 (algorithm
//! 4.2): the change of (q, v) is the least one in the norm of the kinetic metric in both parts, by Gauss–Newton steps.
//! It is made only where these converge, and to a place that is near for the step. Otherwise integrals are taken up one
//! after another, the most independent first, and those that prevent it are left out at this state; what is left out is
//! counted. Masses with a law of their own stand among the coordinates and are not moved.

use crate::drift::Extreme;
use crate::follow::magnitude;
use crate::functions::{Functions, FunctionsError};
use crate::least_norm::{independent, least_step, norm};
use crate::numeric::Binding;
use chetaev_integrate::EvaluationFailure;
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Symbol};

/// At most so many steps towards the level set.
const STEPS: usize = 12;

/// A residual below it, of the size of its terms, is rounding.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Where steps get no shorter, residuals up to so many times [`ROUNDING`] are rounding, of inner terms and of the state.
const NOISE: f64 = 16.0;

/// Each step is shorter by this factor than the one before it, or there is no solution near by (P. Deuflhard, Newton Methods
/// for Nonlinear Problems, section 3.1).
const CONTRACTION: f64 = 0.5;

/// A gradient of which no larger part is independent of the others determines nothing.
const DEPENDENT: f64 = 1e-8;

/// The level set lies elsewhere where the change is larger, of the size of each component …
const FAR: f64 = 1e-3;

/// … and than this part of the way made since the last state that was brought back.
const PART_OF_STEP: f64 = 0.25;

/// States at which something was not kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Missed {
    /// How many.
    pub count: u64,
    /// The time of the first.
    pub first: Option<f64>,
}

impl Missed {
    fn record(&mut self, t: f64) {
        self.count += 1;
        self.first = self.first.or(Some(t));
    }
}

/// What became of the integrals that a run was to keep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct KeptReport {
    /// Steps after which the state was looked at.
    pub steps: u64,
    /// Steps after which the state stayed as integrated: nothing near by has the values to keep.
    pub failed: Missed,
    /// For each integral the steps after which it did not have its value while others were brought back.
    pub left_out: Vec<Missed>,
    /// States within steps, for rows and events, where not all integrals have their values.
    pub between: Missed,
    /// Steps after which the state was moved.
    pub moved: u64,
    /// The largest change of a coordinate or velocity after a step, over 1 + its size.
    pub largest: Extreme,
}

/// Functions of one kind with their slopes and sizes.
#[derive(Clone, Debug)]
struct Quantities {
    functions: Functions,
    /// The values to keep, where they are known.
    targets: Vec<Option<f64>>,
}

impl Quantities {
    fn new(system: &System, binding: &Binding, values: &[Expr]) -> Result<Self, FunctionsError> {
        let g = &system.graph;
        let masses = system.masses.iter().map(|m| m.symbol);
        let positions = system.coordinate_symbols().into_iter().chain(masses);
        let symbols: Vec<Symbol> = positions.chain(system.velocity_symbols()).collect();
        let slopes = g.jacobian(values, &symbols).concat();
        let sizes = values.iter().map(|&e| magnitude(g, e)).collect();
        let groups = [
            ("values", values.to_vec()),
            ("slopes", slopes),
            ("sizes", sizes),
        ];
        Ok(Quantities {
            functions: Functions::new(g, binding, &binding.variables, &groups)?,
            targets: vec![Some(0.0); values.len()],
        })
    }

    fn evaluate(&mut self, t: f64, x: &[f64]) -> Result<(), EvaluationFailure> {
        self.functions.evaluate(t, &[x])
    }

    /// What is left of quantity `row`.
    fn left(&self, row: usize, x: &[f64]) -> Option<Left> {
        let target = self.targets[row]?;
        let value = self.functions.group(0)[row] - target;
        let size = self.functions.group(2)[row].abs() + target.abs();
        let slopes = &self.functions.group(1)[row * x.len()..(row + 1) * x.len()];
        let of_state: f64 = slopes.iter().zip(x).map(|(s, x)| (s * x).abs()).sum();
        let units = |size: f64| value.abs() / (ROUNDING * size).max(f64::MIN_POSITIVE);
        Some(Left {
            value,
            units: units(size),
            with_state: units(size + of_state),
        })
    }
}

/// What is left of a quantity.
struct Left {
    value: f64,
    /// In units of the rounding of its terms.
    units: f64,
    /// In units of that and of what the rounding of the state changes in it.
    with_state: f64,
}

/// Integrals with their values at the start, beside what vanishes.
#[derive(Clone, Debug)]
pub struct Keep {
    /// What vanishes, then each integral by itself: where one has no value the others are kept.
    quantities: Vec<Quantities>,
    n: usize,
    /// The places of coordinates and velocities in (q, v): between them masses have theirs.
    movable: Vec<usize>,
    /// (q, v) at the end of the last step.
    before: Vec<f64>,
    report: KeptReport,
}

/// A state that was found, with the integrals that have their values there.
struct Found {
    x: Vec<f64>,
    kept: Vec<usize>,
}

/// Constraints and integrals at a state: the slopes of those that are sought, what is left of them, and the most of it in
/// units of rounding, without and with that of the state.
#[derive(Default)]
struct Rest {
    slopes: Vec<f64>,
    left: Vec<f64>,
    worst: f64,
    with_state: f64,
}

impl Keep {
    /// Compiles `vanishing` and `integrals`, functions of (t, q, v).
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        system: &System,
        binding: &Binding,
        (vanishing, integrals): (&[Expr], &[Expr]),
    ) -> Result<Keep, FunctionsError> {
        let each = integrals.iter().map(std::slice::from_ref);
        let quantities: Result<Vec<Quantities>, FunctionsError> = std::iter::once(vanishing)
            .chain(each)
            .map(|values| Quantities::new(system, binding, values))
            .collect();
        let n = system.n();
        let velocities = n + system.masses.len();
        Ok(Keep {
            quantities: quantities?,
            n,
            movable: (0..n).chain(velocities..velocities + n).collect(),
            before: Vec::new(),
            report: KeptReport::default(),
        })
    }

    /// Takes the values of the integrals at (t, q, v) for those to keep, and forgets what was counted.
    pub fn begin(&mut self, (t, q, v): (f64, &[f64], &[f64])) {
        self.before = [q, v].concat();
        self.report = KeptReport {
            left_out: vec![Missed::default(); self.quantities.len() - 1],
            ..KeptReport::default()
        };
        for own in &mut self.quantities[1..] {
            let known = own.evaluate(t, &self.before).is_ok();
            own.targets[0] = known.then(|| own.functions.group(0)[0]);
        }
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        let mut own = self.quantities.iter_mut();
        own.try_for_each(|own| own.functions.set_parameters(values))
    }

    /// What was counted since the start.
    pub fn report(&self) -> &KeptReport {
        &self.report
    }

    /// Moves the state at the end of a step; says whether it changed.
    pub fn bring_back(&mut self, t: f64, q: &mut [f64], v: &mut [f64], metric: &[f64]) -> bool {
        self.report.steps += 1;
        let start = [&*q, &*v].concat();
        let found = self.project(t, &start, metric);
        let missing = self.missing(t, &found);
        let integrals = self.quantities.len() - 1;
        match missing.len() == integrals && integrals > 0 {
            true => self.report.failed.record(t),
            false => (missing.iter()).for_each(|&i| self.report.left_out[i].record(t)),
        }
        self.before.clone_from(&found.x);
        let is_moved = set(q, v, &start, &found.x);
        self.report.moved += u64::from(is_moved);
        for (a, b) in start.iter().zip(&found.x) {
            self.report.largest.record((b - a) / (1.0 + a.abs()), t);
        }
        is_moved
    }

    /// Moves a state within a step; says whether it changed.
    pub fn bring_between(&mut self, t: f64, q: &mut [f64], v: &mut [f64], metric: &[f64]) -> bool {
        let start = [&*q, &*v].concat();
        let found = self.project(t, &start, metric);
        if !self.missing(t, &found).is_empty() {
            self.report.between.record(t);
        }
        set(q, v, &start, &found.x)
    }

    /// The integrals that do not have their values at the state found.
    fn missing(&mut self, t: f64, found: &Found) -> Vec<usize> {
        let integrals = self.quantities.iter_mut().skip(1).enumerate();
        integrals
            .filter(|(i, _)| !found.kept.contains(i))
            .filter_map(|(i, own)| {
                let known = own.evaluate(t, &found.x).is_ok();
                let left = own.left(0, &found.x).filter(|_| known);
                left.is_none_or(|left| left.with_state > NOISE).then_some(i)
            })
            .collect()
    }

    /// The nearest state with the constraints and all integrals, or with as many as there are near by.
    fn project(&mut self, t: f64, start: &[f64], metric: &[f64]) -> Found {
        let both = self.doubled(metric, start.len());
        let all: Vec<usize> = (0..self.quantities.len() - 1).collect();
        if self.rest(t, start, &all).is_some_and(|r| r.worst <= 1.0) {
            let (x, kept) = (start.to_vec(), all);
            return Found { x, kept };
        }
        let order = self.most_independent_first(t, start, &both);
        if let Some(x) = self.newton(t, start, &order, &both) {
            return Found { x, kept: order };
        }
        let Some(mut x) = self.newton(t, start, &[], &both) else {
            let (x, kept) = (start.to_vec(), Vec::new());
            return Found { x, kept };
        };
        let mut kept = Vec::new();
        for integral in order {
            kept.push(integral);
            match self.newton(t, start, &kept, &both) {
                Some(better) => x = better,
                None => {
                    kept.pop();
                }
            }
        }
        Found { x, kept }
    }

    /// The integrals that have values and slopes at the state, the most independent ones first; those that depend on others
    /// and on the constraints are left out.
    fn most_independent_first(&mut self, t: f64, x: &[f64], metric: &[f64]) -> Vec<usize> {
        if self.quantities[0].evaluate(t, x).is_err() {
            return Vec::new();
        }
        let mut slopes = self.quantities[0].functions.group(1).to_vec();
        let mut known = Vec::new();
        for (i, own) in self.quantities.iter_mut().skip(1).enumerate() {
            if own.targets[0].is_some() && own.evaluate(t, x).is_ok() {
                known.push(i);
                slopes.extend_from_slice(own.functions.group(1));
            }
        }
        let first = self.quantities[0].targets.len();
        let order = independent(&slopes, (x.len(), first), &self.movable, metric, DEPENDENT);
        order.into_iter().map(|row| known[row - first]).collect()
    }

    /// The constraints and some of the integrals at a state; `None` where one of them has no value.
    fn rest(&mut self, t: f64, x: &[f64], integrals: &[usize]) -> Option<Rest> {
        let mut rest = Rest::default();
        for place in std::iter::once(0).chain(integrals.iter().map(|i| i + 1)) {
            let own = &mut self.quantities[place];
            own.evaluate(t, x).ok()?;
            rest.slopes.extend_from_slice(own.functions.group(1));
            for row in 0..own.targets.len() {
                let left = own.left(row, x)?;
                // A component that is large may not be moved by so little, and others must not be moved for it.
                rest.left
                    .push(if left.units <= 1.0 { 0.0 } else { left.value });
                rest.worst = rest.worst.max(left.units);
                rest.with_state = rest.with_state.max(left.with_state);
            }
        }
        rest.worst.is_finite().then_some(rest)
    }

    /// The state near `start` with the constraints and some of the integrals, where the steps towards it converge.
    fn newton(
        &mut self,
        t: f64,
        start: &[f64],
        integrals: &[usize],
        metric: &[f64],
    ) -> Option<Vec<f64>> {
        let size = start.len();
        let mut x = start.to_vec();
        let mut last = f64::INFINITY;
        let mut best = (f64::INFINITY, f64::INFINITY, x.clone());
        for _ in 0..STEPS {
            let rest = self.rest(t, &x, integrals)?;
            if rest.worst < best.0 {
                best = (rest.worst, rest.with_state, x.clone());
            }
            if rest.worst <= 1.0 {
                return Some(x);
            }
            let step = least_step(&rest.slopes, &rest.left, size, &self.movable, metric);
            let length = norm(&step);
            if length > CONTRACTION * last || length.is_nan() {
                return (best.1 <= NOISE).then_some(best.2);
            }
            x.iter_mut().zip(&step).for_each(|(x, dx)| *x -= dx);
            last = length;
            if !self.is_near(start, &x) {
                return None;
            }
        }
        None
    }

    /// Whether a change is one that a step in error makes necessary: across a cut of an angle, say, it is not.
    fn is_near(&self, start: &[f64], x: &[f64]) -> bool {
        let difference = |a: &[f64]| -> Vec<f64> {
            let places = self.movable.iter();
            places.map(|&i| start[i] - a[i]).collect()
        };
        let mut pairs = start.iter().zip(x);
        pairs.all(|(a, b)| (a - b).abs() <= FAR * (1.0 + a.abs()))
            || norm(&difference(x)) <= PART_OF_STEP * norm(&difference(&self.before))
    }

    /// The metric for coordinates and velocities, block by block, in a matrix of all places of the state.
    fn doubled(&self, metric: &[f64], size: usize) -> Vec<f64> {
        let (positions, velocities) = self.movable.split_at(self.n);
        let mut both = vec![0.0; size * size];
        for block in [positions, velocities] {
            for (i, &row) in block.iter().enumerate() {
                for (j, &column) in block.iter().enumerate() {
                    both[row * size + column] = metric[i * self.n + j];
                }
            }
        }
        both
    }
}

/// Writes a state; says whether it is another one.
fn set(q: &mut [f64], v: &mut [f64], start: &[f64], x: &[f64]) -> bool {
    let (positions, velocities) = x.split_at(q.len());
    q.copy_from_slice(positions);
    v.copy_from_slice(velocities);
    start != x
}
