//! Consistent initial data (T5 §5.10): what is given is fixed, the rest is projected in the kinetic metric.

pub mod branches;
mod forms;
pub mod jets;
mod velocities;

use crate::accelerations::{Accelerations, SolveFailure};
use crate::chart::{self, Chart};
use crate::least_norm::{identity, least_step, norm};
use crate::nearest::{both, draw, perturb, Nearest, DRAWS};
use crate::numeric::NumericSystem;

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
}

impl Search<'_> {
    fn new<'a>(system: &'a mut NumericSystem, data: &'a InitialData) -> Search<'a> {
        Search {
            q: data.q.clone(),
            v: data.v.clone(),
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
        if self.search_positions(t, &movable)? {
            return Ok(());
        }
        let worst = self.position_violations()?;
        if !self.search_positions(t, &all)? {
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
            advice: advice(&nearest),
        })
    }

    /// Newton from the start, and where that fails from several starting points, of whose solutions the nearest is taken;
    /// leaves q as it was when none converges.
    fn search_positions(&mut self, t: f64, movable: &[usize]) -> Result<bool, InitialError> {
        if self.solve_positions(t, movable)? {
            return Ok(true);
        }
        let start = self.data.q.clone();
        let searched = both(movable, &self.system.constrained_positions);
        let mut generator = chetaev_mechanics::sample::Generator::new(5);
        let mut nearest = Nearest::default();
        for _ in 1..STARTS {
            self.q.clone_from(&start);
            perturb(&mut self.q, &searched, &mut generator);
            // A start outside the domain of a function is no reason to give up, unless it is the given one.
            if !self.solve_positions(t, movable).unwrap_or(false) {
                continue;
            }
            nearest.offer(&start, &self.q);
            if self.draw_positions_near(t, &start, movable)
                && self.solve_positions(t, movable).unwrap_or(false)
            {
                nearest.offer(&start, &self.q);
            }
        }
        let found = nearest.found.is_some();
        self.q = nearest.found.unwrap_or(start);
        Ok(found)
    }

    fn solve_positions(&mut self, t: f64, movable: &[usize]) -> Result<bool, InitialError> {
        self.newton_positions(t, movable)?;
        Ok(self.largest_position_residual()? <= tolerance(&self.q))
    }

    /// Moves q on the constraints towards the point nearest to `start`: half-way, again and again, to the point of the
    /// linearized constraints with the least change.
    fn draw_positions_near(&mut self, t: f64, start: &[f64], movable: &[usize]) -> bool {
        let n = self.system.n;
        for _ in 0..DRAWS {
            if self.evaluate_positions(t).is_err() {
                return false;
            }
            let gradient = self.system.position_gradient().to_vec();
            let residual = self.system.position_residual().to_vec();
            let metric = self.metric(t);
            draw(&mut self.q, start, (&gradient, &residual), |f| {
                least_step(&gradient, f, n, movable, &metric)
            });
        }
        true
    }

    fn newton_positions(&mut self, t: f64, movable: &[usize]) -> Result<(), InitialError> {
        let n = self.system.n;
        for _ in 0..50 {
            self.evaluate_positions(t)?;
            let residual = self.system.position_residual().to_vec();
            if residual
                .iter()
                .all(|x| x.abs() <= 1e-15 * (1.0 + largest(&self.q)))
            {
                return Ok(());
            }
            let gradient = self.system.position_gradient().to_vec();
            let metric = self.metric(t);
            let step = least_step(&gradient, &residual, n, movable, &metric);
            let size = largest(&step);
            for (x, dx) in self.q.iter_mut().zip(&step) {
                *x -= dx;
            }
            if size <= 4.0 * f64::EPSILON * (1.0 + largest(&self.q)) {
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

    fn largest_position_residual(&mut self) -> Result<f64, InitialError> {
        self.evaluate_positions(self.data.t)?;
        Ok(largest(self.system.position_residual()))
    }

    fn position_violations(&mut self) -> Result<(String, f64), InitialError> {
        self.evaluate_positions(self.data.t)?;
        let rows = self.system.holonomic.clone();
        Ok(self.violations(&rows, self.system.position_residual()))
    }

    fn violations(&self, rows: &[usize], residual: &[f64]) -> (String, f64) {
        let mut names = Vec::new();
        for (&row, &value) in rows.iter().zip(residual) {
            if value.abs() > 1e-9 {
                names.push(format!("constraint `{}`", self.system.constraints[row]));
            }
        }
        (names.join(" and "), largest(residual))
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
        self.check_gradients()?;
        let system = &*self.system;
        let chart = chart::choose(
            system.jacobian(),
            system.r,
            system.n,
            &system.mass_diagonal(),
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

    fn check_gradients(&self) -> Result<(), InitialError> {
        match self.vanishing_gradient() {
            None => Ok(()),
            Some(row) => Err(InitialError::VanishingGradient {
                name: self.system.constraints[row].clone(),
                hint: "; if it is a square such as (x' - y)^2 = 0, write the base alone: x' = y"
                    .to_string(),
            }),
        }
    }

    fn has_gradients(&self) -> bool {
        self.vanishing_gradient().is_none()
    }

    /// A row whose gradient vanishes at the state last evaluated.
    fn vanishing_gradient(&self) -> Option<usize> {
        let (system, n) = (&*self.system, self.system.n);
        let scale = largest(system.jacobian()).max(1e-3);
        (0..system.r).find(|&row| norm(&system.jacobian()[row * n..(row + 1) * n]) <= 1e-7 * scale)
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
        self.system
            .coordinates
            .iter()
            .zip(given.iter().zip(found))
            .filter(|(_, (a, b))| (*a - *b).abs() > 1e-13 * (1.0 + a.abs()))
            .map(|(name, (_, b))| (format!("{name}{prime}"), *b))
            .collect()
    }
}

fn advice(nearest: &str) -> String {
    if nearest.is_empty() {
        "give other initial data, or set `project = true`".to_string()
    } else {
        format!("the nearest consistent values are {nearest}; set `project = true` (or `--project`) to use them")
    }
}

fn tolerance(x: &[f64]) -> f64 {
    2e-12 * (1.0 + largest(x))
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

fn pivot_column(line: &[f64]) -> Option<usize> {
    (0..line.len()).max_by(|&i, &j| line[i].abs().total_cmp(&line[j].abs()))
}
