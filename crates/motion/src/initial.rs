//! Consistent initial data (T5 §5.10): what is given is fixed, the rest is projected in the kinetic metric.

pub mod branches;
mod forms;
pub mod jets;
mod velocities;

use crate::accelerations::{Accelerations, SolveFailure};
use crate::chart::{self, Chart, Floor};
use crate::least_norm::{identity, least_step_of, DEPENDENT, DEPENDENT_BY_ROUNDING};
use crate::nearest::{both, draw, perturb, reach, Nearest, DRAWS};
use crate::numeric::{NumericSystem, RoundedConstraints};
use chetaev_compile::rounding::Rounded;

/// Given and free initial data of the coordinates and velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialData {
    /// Start time.
    pub t: f64,
    /// Values or first guesses of q, length n, and behind them those of the masses with a law of their own.
    pub q: Vec<f64>,
    /// Values or first guesses of v, length n.
    pub v: Vec<f64>,
    /// Whether qᵢ is given, hence fixed.
    pub q_fixed: Vec<bool>,
    /// Whether vᵢ is given, hence fixed.
    pub v_fixed: Vec<bool>,
    /// Whether a state that does not satisfy the constraints may be moved, given data included.
    pub project: bool,
}

/// A state that satisfies the constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct ConsistentState {
    /// Start time.
    pub t: f64,
    /// q, length n, and behind it the masses with a law of their own.
    pub q: Vec<f64>,
    /// v, length n.
    pub v: Vec<f64>,
    /// Names of what was changed from its given value or completed, with the value found.
    pub completed: Vec<(String, f64)>,
    /// The chart at the start.
    pub chart: Chart,
    /// Constraints that follow from the others at the start.
    pub redundant: Vec<String>,
    /// What is known beyond coordinates and velocities, for constraints of order two and more.
    pub jets: Option<jets::JetStart>,
}

/// Why the initial data cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InitialError {
    /// A function has no finite value there.
    #[error("the initial state is singular: {what} has no finite value there{hint}")]
    NotFinite {
        /// What.
        what: String,
        /// A likely reason.
        hint: String,
    },
    /// Given data violate a constraint.
    #[error("the initial {kind} violates {constraint}: its residual is {residual:.3e}; {advice}")]
    Inconsistent {
        /// "position" or "velocity".
        kind: &'static str,
        /// Constraints with their residuals.
        constraint: String,
        /// The largest residual.
        residual: f64,
        /// The nearest consistent state.
        advice: String,
    },
    /// Constraints contradict each other.
    #[error("constraints {names} contradict each other at the initial position: they are inconsistent, no velocity satisfies them all ({combination})")]
    Contradiction {
        /// The constraints.
        names: String,
        /// The combination that contradicts.
        combination: String,
    },
    /// No real velocity found for nonlinear constraints.
    #[error("no real velocity satisfies {names} at the initial position: the best of {starts} searches leaves the residual {residual:.3e}")]
    NoRealVelocity {
        /// The constraints.
        names: String,
        /// The residual left.
        residual: f64,
        /// Number of starting points.
        starts: usize,
    },
    /// No position found for holonomic constraints.
    #[error("no position satisfies {names}: they contradict each other, or the best of {starts} searches missed it; it leaves the residual {residual:.3e}")]
    NoPosition {
        /// The constraints.
        names: String,
        /// The residual left.
        residual: f64,
        /// Number of starting points.
        starts: usize,
    },
    /// A gradient vanishes.
    #[error("the gradient of constraint `{name}` by the velocities vanishes at the initial state: its rank is 0 there, so it is singular and determines no reaction{hint}")]
    VanishingGradient {
        /// The constraint.
        name: String,
        /// Advice.
        hint: String,
    },
    /// Accelerations are not determined.
    #[error("the accelerations are not determined at the initial state: the mass matrix restricted to the velocities that the constraints admit is singular, a velocity along {direction} has no inertia (zero mass, a degenerate Lagrangian, or coordinates that are singular at this position)")]
    NoInertia {
        /// Coordinate names.
        direction: String,
    },
}

const STARTS: usize = 12;
/// Of more data than these it is not said which cannot hold.
const MOST_NAMED: usize = 4;

/// Completes and checks initial data.
///
/// # Errors
/// [`InitialError`], which names constraints and coordinates.
pub fn consistent_state(
    system: &mut NumericSystem,
    data: &InitialData,
) -> Result<ConsistentState, InitialError> {
    let mut search = Search::new(system, data);
    search.positions()?;
    search.velocities()?;
    search.finish()
}

struct Search<'a> {
    system: &'a mut NumericSystem,
    data: &'a InitialData,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Which rows count as dependent on others ([`least_step_of`]).
    dependent: f64,
}

/// Residuals within so many bounds of their rounding are as small as they become.
const EXACT: f64 = 4.0;
/// Residuals within so many satisfy a constraint: 2e-12 of its terms, what Newton's method leaves where gradients nearly depend.
const SATISFIED: f64 = 16_384.0;
/// A gradient all of whose entries are below this part of their terms vanishes at a state that was searched for.
const VANISHED: f64 = 1e-7;

impl Search<'_> {
    fn new<'a>(system: &'a mut NumericSystem, data: &'a InitialData) -> Search<'a> {
        Search {
            q: data.q.clone(),
            v: data.v.clone(),
            dependent: DEPENDENT,
            system,
            data,
        }
    }

    fn movable(&self, fixed: &[bool]) -> Vec<usize> {
        (0..self.system.n)
            .filter(|&i| self.data.project || !fixed[i])
            .collect()
    }

    fn not_finite(&self, what: &str) -> InitialError {
        let names: Vec<String> = self
            .system
            .constraints
            .iter()
            .map(|name| format!("`{name}`"))
            .collect();
        let hint = if names.is_empty() {
            "; a denominator or the argument of a root or logarithm is zero there".to_string()
        } else {
            format!(
                "; a denominator is zero there, or a constraint ({}) is not differentiable",
                names.join(", ")
            )
        };
        InitialError::NotFinite {
            what: what.to_string(),
            hint,
        }
    }

    /// Moves free coordinates until φ(q) = 0.
    fn positions(&mut self) -> Result<(), InitialError> {
        if self.system.holonomic.is_empty() {
            return Ok(());
        }
        let given = self.q.clone();
        let movable = self.movable(&self.data.q_fixed);
        let all: Vec<usize> = (0..self.system.n).collect();
        let t = self.data.t;
        let is_found = if self.moves_data(&self.data.q_fixed) {
            self.nearest_positions(t, &movable)?
        } else {
            self.search_positions(t, &movable)?
        };
        if is_found {
            return Ok(());
        }
        let worst = self.position_violations()?;
        let cannot_hold = self.wrong_positions(t, &movable);
        if !self.nearest_positions(t, &all)? {
            return Err(InitialError::NoPosition {
                names: worst.0,
                residual: worst.1,
                starts: STARTS,
            });
        }
        let nearest = self.describe(&given, &self.q.clone(), "");
        Err(InitialError::Inconsistent {
            kind: "position",
            constraint: worst.0,
            residual: worst.1,
            advice: advice(&nearest, &cannot_hold, self.system.is_flat),
        })
    }

    /// Whether data that are given are moved by a projection.
    fn moves_data(&self, fixed: &[bool]) -> bool {
        self.data.project && fixed.contains(&true)
    }

    /// Given coordinates of which each may be the wrong one: with it free the others can hold.
    fn wrong_positions(&mut self, t: f64, movable: &[usize]) -> Vec<String> {
        let mut wrong = Vec::new();
        for i in (0..self.system.n).filter(|i| !movable.contains(i)) {
            if wrong.len() == MOST_NAMED || !self.system.constrained_positions[i] {
                continue;
            }
            self.q.clone_from(&self.data.q);
            let with: Vec<usize> = movable.iter().copied().chain([i]).collect();
            if self.solve_positions(t, &with).unwrap_or(false) {
                wrong.push(self.system.coordinates[i].clone());
            }
        }
        self.q.clone_from(&self.data.q);
        wrong
    }

    /// Newton from the start, and where that fails from several starting points, of whose solutions the nearest is taken;
    /// leaves q as it was when none converges.
    fn search_positions(&mut self, t: f64, movable: &[usize]) -> Result<bool, InitialError> {
        if self.solve_positions(t, movable)? {
            Ok(true)
        } else {
            self.nearest_positions(t, movable)
        }
    }

    /// The nearest of the solutions that several starting points lead to, each moved to where the distance is least; leaves q as it was when
    /// none is found.
    fn nearest_positions(&mut self, t: f64, movable: &[usize]) -> Result<bool, InitialError> {
        let start = self.data.q.clone();
        self.q.clone_from(&start);
        let searched = both(movable, &self.system.constrained_positions);
        let mut generator = chetaev_mechanics::sample::Generator::new(5);
        self.evaluate_positions(t)?;
        let metric = self.metric(t);
        let of = (
            self.system.position_gradient(),
            self.system.position_residual(),
        );
        let step = least_step_of(of, self.system.n, movable, &metric, self.dependent);
        let reach = reach(&start, &step, &metric);
        let mut nearest = Nearest::to(&start, &metric);
        let starts = if self.system.is_flat { 1 } else { STARTS };
        for count in 0..starts {
            self.q.clone_from(&start);
            if count > 0 {
                perturb(&mut self.q, &searched, &reach, &mut generator);
            }
            // A start outside the domain of a function is no reason to give up, unless it is the given one.
            if !self.solve_positions(t, movable).unwrap_or(false) {
                continue;
            }
            nearest.offer(&self.q);
            if self.draw_positions_near(t, (&start, &metric), movable)
                && self.solve_positions(t, movable).unwrap_or(false)
            {
                nearest.offer(&self.q);
            }
        }
        let found = nearest.found.clone();
        let is_found = found.is_some();
        self.q = found.unwrap_or(start);
        Ok(is_found)
    }

    fn solve_positions(&mut self, t: f64, movable: &[usize]) -> Result<bool, InitialError> {
        self.newton_positions(t, movable)?;
        self.evaluate_positions(t)?;
        Ok(self.system.rounded_positions().are_met(SATISFIED))
    }

    /// Moves q on the constraints towards the point nearest to `start`: half-way, again and again, to the point of the
    /// linearized constraints with the least change.
    fn draw_positions_near(
        &mut self,
        t: f64,
        (start, metric): (&[f64], &[f64]),
        movable: &[usize],
    ) -> bool {
        let n = self.system.n;
        for _ in 0..DRAWS {
            if self.evaluate_positions(t).is_err() {
                return false;
            }
            let gradient = self.system.position_gradient().to_vec();
            let residual = self.system.position_residual().to_vec();
            draw(&mut self.q, start, (&gradient, &residual), |f| {
                least_step_of((&gradient, f), n, movable, metric, self.dependent)
            });
        }
        true
    }

    fn newton_positions(&mut self, t: f64, movable: &[usize]) -> Result<(), InitialError> {
        let n = self.system.n;
        for _ in 0..50 {
            self.evaluate_positions(t)?;
            if self.system.rounded_positions().are_met(EXACT) {
                return Ok(());
            }
            let gradient = self.system.position_gradient().to_vec();
            let residual = self.system.position_residual().to_vec();
            let metric = self.metric(t);
            let of = (&gradient[..], &residual[..]);
            let step = least_step_of(of, n, movable, &metric, self.dependent);
            let mut moved = false;
            for (x, dx) in self.q.iter_mut().zip(&step) {
                moved |= dx.abs() > 4.0 * f64::EPSILON * x.abs();
                *x -= dx;
            }
            if !moved {
                return Ok(());
            }
        }
        Ok(())
    }

    fn evaluate_positions(&mut self, t: f64) -> Result<(), InitialError> {
        let (q, v) = (self.q.clone(), self.v.clone());
        self.system
            .evaluate_positions(t, &q, &v)
            .map_err(|_| self.not_finite("a holonomic constraint"))
    }

    fn position_violations(&mut self) -> Result<(String, f64), InitialError> {
        self.evaluate_positions(self.data.t)?;
        let rows = self.system.holonomic.clone();
        Ok(self.violations(&rows, &self.system.rounded_positions()))
    }

    /// The constraints that are not satisfied, and the largest residual of these.
    fn violations(&self, rows: &[usize], at: &RoundedConstraints) -> (String, f64) {
        let residuals = rows.iter().zip(&at.residual);
        let violated: Vec<(usize, Rounded)> = residuals
            .filter(|(_, f)| !f.is_zero(SATISFIED))
            .map(|(&row, &f)| (row, f))
            .collect();
        let names: Vec<String> = violated
            .iter()
            .map(|(row, _)| format!("constraint `{}`", self.system.constraints[*row]))
            .collect();
        let values: Vec<f64> = violated.iter().map(|(_, f)| f.value).collect();
        (names.join(" and "), largest(&values))
    }

    /// The diagonal of M as a metric; 1 where it is not positive.
    fn metric(&mut self, t: f64) -> Vec<f64> {
        let (q, v) = (self.q.clone(), self.v.clone());
        let n = self.system.n;
        match self.system.evaluate(t, &q, &v) {
            Ok(()) => self.system.metric(),
            Err(_) => identity(n),
        }
    }

    fn evaluate(&mut self) -> Result<(), InitialError> {
        let (q, v) = (self.q.clone(), self.v.clone());
        self.system
            .evaluate(self.data.t, &q, &v)
            .map_err(|_| self.not_finite("a term of the equations of motion"))
    }

    /// Ranks, inertia, and the list of what was completed.
    fn finish(mut self) -> Result<ConsistentState, InitialError> {
        self.evaluate()?;
        let rounded = self.system.rounded();
        self.check_gradients(&rounded)?;
        let system = &*self.system;
        let chart = chart::choose(
            system.jacobian(),
            (system.r, system.n),
            &system.mass_diagonal(),
            Floor::Rounding(&rounded.gradient),
        );
        self.check_inertia(&chart)?;
        let mut completed = self.describe_values(&self.data.q, &self.q, "");
        completed.extend(self.describe_values(&self.data.v, &self.v, "'"));
        let redundant = (0..self.system.r)
            .filter(|row| !chart.rows.contains(row))
            .map(|row| self.system.constraints[row].clone())
            .collect();
        Ok(ConsistentState {
            t: self.data.t,
            q: self.q,
            v: self.v,
            completed,
            chart,
            redundant,
            jets: None,
        })
    }

    fn check_gradients(&self, at: &RoundedConstraints) -> Result<(), InitialError> {
        match self.vanishing_gradient(at) {
            None => Ok(()),
            Some(row) => Err(InitialError::VanishingGradient {
                name: self.system.constraints[row].clone(),
                hint: "; if it is a square such as (x' - y)^2 = 0, write the base alone: x' = y"
                    .to_string(),
            }),
        }
    }

    fn has_gradients(&self) -> bool {
        self.vanishing_gradient(&self.system.rounded()).is_none()
    }

    /// A row whose gradient vanishes at the state last evaluated.
    fn vanishing_gradient(&self, at: &RoundedConstraints) -> Option<usize> {
        let (gradient, n) = (&at.gradient, self.system.n);
        // What was searched for at a singular place is known to half the digits; data are exact, as the place of a tether in an orbit.
        let is_given = |row: usize| {
            self.q == self.data.q && (self.system.affine[row] || self.v == self.data.v)
        };
        let vanishes = |row: usize, x: &Rounded| {
            x.is_zero(EXACT) || !is_given(row) && x.value.abs() <= VANISHED * x.size()
        };
        (0..self.system.r).find(|&row| {
            let mut entries = gradient[row * n..(row + 1) * n].iter();
            entries.all(|x| vanishes(row, x))
        })
    }

    fn check_inertia(&self, chart: &Chart) -> Result<(), InitialError> {
        if self.system.is_part {
            return Ok(());
        }
        let mut accelerations = Accelerations::default();
        match accelerations.solve(self.system, chart) {
            Ok(()) => Ok(()),
            Err(SolveFailure::Chart(_)) => {
                Err(self.not_finite("the solution for the dependent velocities"))
            }
            Err(SolveFailure::Inertia(_)) => {
                let direction = accelerations.inertia_null_vector(chart, self.system.n);
                Err(InitialError::NoInertia {
                    direction: self.direction_in_words(direction),
                })
            }
        }
    }

    fn direction_in_words(&self, direction: Option<Vec<f64>>) -> String {
        let names = &self.system.coordinates;
        let Some(direction) = direction else {
            return "some velocity".to_string();
        };
        let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
        let parts = direction.iter().zip(&names);
        let parts = parts.filter(|(x, _)| x.abs() > 1e-9);
        let parts: Vec<(f64, &str)> = parts.map(|(&x, name)| (x, &name[..])).collect();
        velocities::sum_in_words(&parts)
    }

    fn describe(&self, given: &[f64], found: &[f64], prime: &str) -> String {
        let parts: Vec<String> = self
            .describe_values(given, found, prime)
            .into_iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect();
        parts.join(", ")
    }

    fn describe_values(&self, given: &[f64], found: &[f64], prime: &str) -> Vec<(String, f64)> {
        let masses = self.system.mass_diagonal().into_iter();
        let size = masses
            .zip(found)
            .fold(0.0, |m: f64, (mass, x)| m.max(mass.abs().sqrt() * x.abs()));
        self.system
            .coordinates
            .iter()
            .zip(given.iter().zip(found))
            .zip(self.system.mass_diagonal())
            .filter(|((_, (a, b)), mass)| (*a - *b).abs() * mass.abs().sqrt() > 1e-13 * size)
            .map(|(known, _)| known)
            .map(|(name, (_, b))| (format!("{name}{prime}"), *b))
            .collect()
    }
}

/// What to do about data that contradict the constraints: which of them cannot hold, and what is near.
fn advice(nearest: &str, cannot_hold: &[String], is_proved: bool) -> String {
    let wrong = match cannot_hold {
        [] => String::new(),
        [one] => format!("`{one}` cannot have the value given beside the other data; "),
        several => {
            let names: Vec<String> = several.iter().map(|name| format!("`{name}`")).collect();
            let names = names.join(" or ");
            format!("one of the data given cannot hold, {names}: state it as `{{ guess = … }}`, near which it is searched for; ")
        }
    };
    let what = match (nearest.is_empty(), is_proved) {
        (true, _) => return format!("{wrong}give other initial data, or set `project = true`"),
        (_, true) => "the nearest consistent values, in the kinetic metric, are".to_owned(),
        (_, false) => format!("the nearest consistent values found (a local minimum of the distance in the kinetic metric, the best of {STARTS} starts) are"),
    };
    format!("{wrong}{what} {nearest}; set `project = true` (or `--project`) to use them")
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m: f64, v| {
        if v.is_nan() {
            f64::INFINITY
        } else {
            m.max(v.abs())
        }
    })
}
