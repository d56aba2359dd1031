//! What a computed motion tells: energy, integrals and constraints along it, and how two runs differ.

use crate::method_order::Orders;
use chetaev_geometry::noether::found::Found;
use chetaev_geometry::noether::letters::ENERGY;
use chetaev_mechanics::{MotionTerms, System};
use chetaev_model::model::Model;
use chetaev_motion::drift::Extreme;
use chetaev_motion::follow::magnitude;
use chetaev_motion::functions::FunctionsError;
use chetaev_motion::observe::Observer;
use chetaev_motion::{double_double, Binding, DoubleDouble, Run, RunError, RunSettings, Subject};
use chetaev_symbolic::Expr;
use std::ops::Sub;

/// A quantity followed along the run.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Name.
    pub name: String,
    /// Its expression in q, q', t and parameters.
    pub expression: Expr,
    /// Values at the rows.
    pub values: Vec<f64>,
    /// The same with all their digits, of a run in double-double arithmetic.
    pub precise: Option<Vec<DoubleDouble>>,
    /// Largest deviation from the initial value.
    pub drift: Extreme,
    /// Largest sum of the sizes of its terms along the run: by it deviations are measured.
    pub scale: f64,
}

/// Everything about a run that its claims look at.
#[derive(Clone, Debug)]
pub struct MotionEvidence {
    /// The trajectory.
    pub run: Run,
    /// The beginning of it at rows closer than its steps, for quadratures.
    pub dense: Option<Run>,
    /// The same motion by another formulation.
    pub comparison: Option<Run>,
    /// Estimated global error: largest difference to a run at a tenth of the tolerance, over the scale of each component.
    pub global_error: Option<f64>,
    /// Energy.
    pub energy: Followed,
    /// Its rate by the computed accelerations, of systems with few coordinates.
    pub energy_rate: Option<Followed>,
    /// Integrals stated by the model.
    pub integrals: Vec<Followed>,
    /// Values of the parameters.
    pub binding: Binding,
    /// Constraint residuals at the rows, by row of the terms.
    pub residuals: Vec<Followed>,
    /// Residuals of the holonomic constraints as stated.
    pub positions: Vec<Followed>,
    /// Largest difference of the two formulations over the scale of each component, with its time.
    pub disagreement: Option<Extreme>,
    /// Observed order.
    pub orders: Option<Orders>,
    /// Tolerance asked.
    pub tolerance: f64,
    /// Initial values that the model states beside coordinates and velocities: multipliers of the extremum, `kappa_NAME`.
    pub given: Vec<(String, f64)>,
    /// Data for `model.initial-state-admissible`: exact initial values where all are given exactly.
    pub exact_start: Option<Vec<(Expr, Expr)>>,
    /// Initial values as numbers, for messages.
    pub start: Vec<(String, f64)>,
    /// Largest constraint residual at the start.
    pub start_residual: f64,
}

impl MotionEvidence {
    /// Evaluates energy, integrals and constraints along the run and compares the runs.
    ///
    /// # Errors
    /// [`RunError`] when an integral contains something that has no value along a motion.
    pub fn new(
        model: &Model,
        subject: &Subject<'_>,
        run: Run,
        comparison: Option<Run>,
        finer: Option<Run>,
        orders: Option<Orders>,
        settings: &RunSettings,
    ) -> Result<MotionEvidence, RunError> {
        let system = subject.system;
        let mut kept = vec![system.energy()];
        kept.extend(model.integrals.iter().map(|i| i.value));
        kept.extend(subject.residuals());
        let kept = kept_names(model, subject).into_iter().zip(kept).collect();
        let rows = match subject.terms.order {
            1 => subject.terms.constraints.len(),
            _ => subject.vanishing().len(),
        };
        let constant = 1 + model.integrals.len();
        let parts = (system, subject.terms, subject.binding);
        let mut followed = follow(parts, &run, kept, constant)?;
        for (quantity, all) in followed.iter_mut().zip(&run.followed) {
            quantity.drift.record(all.drift.value, all.drift.t);
            quantity.scale = quantity.scale.max(all.scale);
        }
        let positions = followed.split_off(constant + rows);
        let mut residuals = followed.split_off(constant);
        if subject.terms.order > 1 {
            // All terms of a condition may vanish along a motion; what the run aims at is then absolute.
            residuals
                .iter_mut()
                .for_each(|r| r.scale = r.scale.max(1.0));
        }
        let integrals = followed.split_off(1);
        let energy = followed.swap_remove(0);
        let energy_rate = match system.n() <= RATE_COORDINATES {
            true => {
                let rate = system.total_derivative(system.energy());
                follow(parts, &run, vec![("dH/dt".into(), rate)], 0)?.pop()
            }
            false => None,
        };
        let start_residual = residuals
            .iter()
            .filter_map(|r| r.values.first())
            .fold(0.0, |m: f64, x| m.max(x.abs()));
        Ok(MotionEvidence {
            disagreement: comparison.as_ref().map(|other| difference(&run, other)),
            global_error: finer.as_ref().map(|other| difference(&run, other).value),
            tolerance: settings.tolerance,
            given: settings.own.clone(),
            exact_start: exact_start(model, subject),
            start: start_values(subject),
            start_residual,
            dense: None,
            energy,
            energy_rate,
            integrals,
            binding: subject.binding.clone(),
            residuals,
            positions,
            orders,
            comparison,
            run,
        })
    }
}

impl MotionEvidence {
    /// The rows for quadratures: those closer than the steps, where there are any.
    pub fn rows(&self) -> &Run {
        self.dense.as_ref().unwrap_or(&self.run)
    }

    /// Takes the difference of the two formulations from another run of the first, or says that there is none.
    pub(crate) fn compare_with(&mut self, first: Option<&Run>) {
        let both = first.zip(self.comparison.as_ref());
        self.disagreement = both.map(|(first, other)| difference(first, other));
    }
}

/// First integrals that a search found, along a run.
#[derive(Clone, Debug)]
pub struct FoundIntegrals(pub Vec<Followed>);

impl FoundIntegrals {
    /// Follows what was found along the rows; the energy, which is followed anyway, is left out.
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        evidence: &MotionEvidence,
        found: &Found,
    ) -> FoundIntegrals {
        let numbered = found.integrals.iter().enumerate();
        let quantities: Vec<(String, Expr)> = numbered
            .filter(|(_, integral)| integral.name.as_deref() != Some(ENERGY))
            .map(|(j, integral)| ((j + 1).to_string(), integral.value))
            .collect();
        let count = quantities.len();
        let parts = (system, terms, &evidence.binding);
        FoundIntegrals(follow(parts, &evidence.run, quantities, count).unwrap_or_default())
    }
}

/// The rate of the energy is looked at for systems of up to this many coordinates.
const RATE_COORDINATES: usize = 24;

/// The names of what a motion should keep: energy, integrals, and [`Subject::vanishing`].
fn kept_names(model: &Model, subject: &Subject<'_>) -> Vec<String> {
    std::iter::once("energy".to_string())
        .chain(model.integrals.iter().map(|i| i.name.clone()))
        .chain(subject.vanishing().into_iter().map(|(name, _)| name))
        .collect()
}

/// Values along the rows; of the first `constant` quantities the deviation from the start counts, of the others the value.
fn follow(
    (system, terms, binding): (&System, &MotionTerms, &Binding),
    run: &Run,
    quantities: Vec<(String, Expr)>,
    constant: usize,
) -> Result<Vec<Followed>, FunctionsError> {
    let g = &system.graph;
    let mut expressions: Vec<Expr> = quantities.iter().map(|(_, e)| *e).collect();
    let sizes: Vec<Expr> = expressions.iter().map(|&e| magnitude(g, e)).collect();
    let precise = double_double::along((system, terms, binding), run, &expressions)?;
    expressions.extend(sizes);
    let mut observer = Observer::with_own(system, terms, binding, &run.own, &expressions)?;
    let mut series = observer.along(run);
    // The state at which the equations became singular is recorded, but a residual may have no value there.
    let regular = run.regular();
    let sizes = series.split_off(quantities.len());
    let followed = quantities
        .into_iter()
        .zip(series.into_iter().zip(sizes))
        .enumerate()
        .map(|(i, ((name, expression), (values, sizes)))| {
            let precise = precise.as_ref().map(|all| all[i].clone());
            let changes = match &precise {
                Some(values) => changes(values, (i < constant, DoubleDouble::ZERO), |x| x.high()),
                None => changes(&values, (i < constant, 0.0), |x| x),
            };
            let rounded = precise
                .as_ref()
                .map(|all| all.iter().map(|x| x.high()).collect());
            Followed {
                name,
                expression,
                drift: deviation(&run.times[..regular], &changes),
                scale: sizes[..regular].iter().fold(0.0, |m: f64, x| m.max(*x)),
                values: rounded.unwrap_or(values),
                precise,
            }
        });
    Ok(followed.collect())
}

/// Values less the first one, or less zero.
fn changes<S: Copy + Sub<Output = S>>(
    values: &[S],
    (is_constant, zero): (bool, S),
    rounded: impl Fn(S) -> f64,
) -> Vec<f64> {
    let reference = values.first().copied().filter(|_| is_constant);
    let reference = reference.unwrap_or(zero);
    values.iter().map(|&x| rounded(x - reference)).collect()
}

fn deviation(times: &[f64], changes: &[f64]) -> Extreme {
    let mut drift = Extreme::default();
    for (&t, &change) in times.iter().zip(changes) {
        let known = if change.is_nan() {
            f64::INFINITY
        } else {
            change
        };
        drift.record(known, t);
    }
    drift
}

/// Largest difference of positions and velocities at common times, each component over 1 + its largest magnitude.
fn difference(a: &Run, b: &Run) -> Extreme {
    let width = a.layout.v().end;
    let rows = a.asked().min(b.asked());
    let mut largest = Extreme::default();
    let gap = |i: usize, j: usize| match (&a.precise, &b.precise) {
        (Some(x), Some(y)) => {
            let place = |run: &Run| j * run.layout.len() + i;
            (x.rows[place(a)] - y.rows[place(b)]).high()
        }
        _ => a.row(j)[i] - b.row(j)[i],
    };
    for i in 0..width {
        let scale = 1.0 + (0..rows).fold(0.0, |m: f64, j| m.max(a.row(j)[i].abs()));
        for j in (0..rows).filter(|&j| a.times[j] == b.times[j]) {
            largest.record(gap(i, j) / scale, a.times[j]);
        }
    }
    largest
}

fn exact_start(model: &Model, subject: &Subject<'_>) -> Option<Vec<(Expr, Expr)>> {
    let g = &model.graph;
    let values = subject.system.parameter_values();
    let mut exact = Vec::new();
    for (i, c) in subject.system.coordinates.iter().enumerate() {
        for (order, symbol, used) in [(0, c.q, subject.start.q[i]), (1, c.v, subject.start.v[i])] {
            let given = match model.initial.values.get(&(i, order)) {
                Some(given) => g.substitute(given.value, &values),
                None => g.zero(),
            };
            let stated = g.evaluate_f64(&[given], &|_| None).ok()?[0];
            if (stated - used).abs() > 1e-12 * (1.0 + used.abs()) {
                return None;
            }
            exact.push((symbol, given));
        }
    }
    let t = model
        .simulation
        .t_start
        .map_or(g.zero(), |t| g.substitute(t, &values));
    exact.push((g.symbol("t", 0), t));
    exact.extend(values);
    Some(exact)
}

fn start_values(subject: &Subject<'_>) -> Vec<(String, f64)> {
    let coordinates = &subject.system.coordinates;
    let q = coordinates
        .iter()
        .zip(&subject.start.q)
        .map(|(c, &x)| (c.name.clone(), x));
    let v = coordinates
        .iter()
        .zip(&subject.start.v)
        .map(|(c, &x)| (format!("{}'", c.name), x));
    let masses = subject.system.masses.iter().map(|m| m.name.clone());
    let masses = masses.zip(subject.start.q[coordinates.len()..].iter().copied());
    q.chain(masses).chain(v).collect()
}
