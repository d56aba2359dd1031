//! The consistent start, and the way back on the constraints: Newton's method with residuals in double-double.
//!
//! Steps are solved for in doubles: each shrinks the residual by some thirteen digits, until its own rounding is met.

use super::flow::Constraints;
use super::{rounded, DoubleDouble, Precise};
use crate::least_norm::{identity, least_step};
use crate::numeric::NumericSystem;
use crate::ConsistentState;

/// What rounding leaves of a residual, as a part of the state.
pub(super) const ROUNDED: f64 = 64.0 * DoubleDouble::EPSILON;
/// Steps of Newton at most.
const MOST: usize = 8;
/// Given values that the start in doubles has moved by more than this were projected.
const KEPT: f64 = 1e-12;

/// Positions and velocities.
pub(super) type State = (Vec<DoubleDouble>, Vec<DoubleDouble>);

/// The state next to the start in doubles that has the values given and satisfies the constraints. Where data that are given
/// contradict the constraints by less than doubles show, all of them are moved.
pub(super) fn start(
    numeric: &mut NumericSystem,
    constraints: &mut Constraints,
    at: &ConsistentState,
    precise: &Precise,
) -> State {
    let exact = |given: &[Option<DoubleDouble>], used: &[f64]| {
        let kept = |(given, used): (&Option<DoubleDouble>, &f64)| {
            given.filter(|x| (x.high() - used).abs() <= KEPT * (1.0 + used.abs()))
        };
        given.iter().zip(used).map(kept).collect::<Vec<_>>()
    };
    let fill = |exact: &[Option<DoubleDouble>], used: &[f64]| {
        let pairs = exact.iter().zip(used);
        pairs
            .map(|(exact, &used)| exact.unwrap_or(DoubleDouble::from(used)))
            .collect::<Vec<_>>()
    };
    let (q, v) = (exact(&precise.q, &at.q), exact(&precise.v, &at.v));
    let mut state = (fill(&q, &at.q), fill(&v, &at.v));
    let free = |exact: &[Option<DoubleDouble>]| {
        let open = |&i: &usize| exact[i].is_none();
        (0..numeric.n).filter(open).collect::<Vec<_>>()
    };
    let free = (free(&q), free(&v));
    let mut newton = Newton {
        numeric,
        constraints,
        t: precise.t_start,
    };
    newton.positions(&mut state, &free.0, ROUNDED);
    newton.positions(&mut state, &newton.all(), ROUNDED);
    newton.velocities(&mut state, &free.1, ROUNDED);
    newton.velocities(&mut state, &newton.all(), ROUNDED);
    state
}

/// Newton's method on the constraints at a time.
pub(super) struct Newton<'s> {
    pub(super) numeric: &'s mut NumericSystem,
    pub(super) constraints: &'s mut Constraints,
    pub(super) t: DoubleDouble,
}

impl Newton<'_> {
    pub(super) fn all(&self) -> Vec<usize> {
        (0..self.numeric.n).collect()
    }

    /// Moves positions until the holonomic constraints hold to rounding; nothing is moved where they hold up to the bound, a part
    /// of the positions. Whether anything was moved.
    pub(super) fn positions(&mut self, state: &mut State, movable: &[usize], bound: f64) -> bool {
        if self.numeric.holonomic.is_empty() || movable.is_empty() {
            return false;
        }
        let residual =
            |newton: &mut Self, state: &State| newton.constraints.positions(newton.t, state);
        let direction = |newton: &mut Self, state: &State, residual: &[f64]| {
            let (t, q, v) = newton.doubles(state);
            let metric = newton.metric(t, &q, &v);
            newton.numeric.evaluate_positions(t, &q, &v).ok()?;
            let gradient = newton.numeric.position_gradient();
            Some(least_step(
                gradient,
                residual,
                newton.numeric.n,
                movable,
                &metric,
            ))
        };
        self.search(state, bound, (residual, direction), |state| &mut state.0)
    }

    /// The same for velocities and the constraints on them.
    pub(super) fn velocities(&mut self, state: &mut State, movable: &[usize], bound: f64) -> bool {
        if self.numeric.r == 0 || movable.is_empty() {
            return false;
        }
        let residual =
            |newton: &mut Self, state: &State| newton.constraints.velocities(newton.t, state);
        let direction = |newton: &mut Self, state: &State, residual: &[f64]| {
            let (t, q, v) = newton.doubles(state);
            newton.numeric.evaluate(t, &q, &v).ok()?;
            let (metric, jacobian) = (newton.numeric.metric(), newton.numeric.jacobian());
            Some(least_step(
                jacobian,
                residual,
                newton.numeric.n,
                movable,
                &metric,
            ))
        };
        self.search(state, bound, (residual, direction), |state| &mut state.1)
    }

    fn search(
        &mut self,
        state: &mut State,
        mut bound: f64,
        (residual, direction): (
            impl Fn(&mut Self, &State) -> Option<Vec<f64>>,
            impl Fn(&mut Self, &State, &[f64]) -> Option<Vec<f64>>,
        ),
        part: impl Fn(&mut State) -> &mut Vec<DoubleDouble>,
    ) -> bool {
        let mut changed = false;
        let mut least = f64::INFINITY;
        for _ in 0..MOST {
            let Some(found) = residual(self, state) else {
                break;
            };
            let size = found.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            let scale = part(state)
                .iter()
                .fold(1e-300, |m: f64, x| m.max(x.high().abs()));
            // What no longer shrinks is rounding, or out of reach of what may be moved.
            if size <= bound * scale || size >= 0.5 * least {
                break;
            }
            let Some(step) = direction(self, state, &found) else {
                break;
            };
            for (x, dx) in part(state).iter_mut().zip(step) {
                *x -= DoubleDouble::from(dx);
            }
            (changed, bound, least) = (true, ROUNDED, size);
        }
        changed
    }

    fn doubles(&self, state: &State) -> (f64, Vec<f64>, Vec<f64>) {
        (self.t.high(), rounded(&state.0), rounded(&state.1))
    }

    fn metric(&mut self, t: f64, q: &[f64], v: &[f64]) -> Vec<f64> {
        match self.numeric.evaluate(t, q, v) {
            Ok(()) => self.numeric.metric(),
            Err(_) => identity(self.numeric.n),
        }
    }
}
