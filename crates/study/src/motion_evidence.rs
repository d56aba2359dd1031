//! What a computed motion tells: energy, integrals and constraints along it, and how two runs differ.

use crate::jumps::{self, Jumps};
use crate::method_order::Orders;
use chetaev_geometry::noether::letters::ENERGY;
use chetaev_geometry::noether::search::Integral;
use chetaev_mechanics::{MotionTerms, System};
use chetaev_model::model::Model;
use chetaev_motion::drift::Extreme;
use chetaev_motion::follow::magnitude;
use chetaev_motion::functions::FunctionsError;
use chetaev_motion::keep::KeptReport;
use chetaev_motion::observe::Observer;
use chetaev_motion::{double_double, Binding, DoubleDouble, Run, RunError, RunSettings, Subject};
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::collections::BTreeMap;
use std::ops::Range;

/// A quantity followed along the run.
#[derive(Clone, Debug)]
pub struct Followed {
    /// Name.
    pub name: String,
    /// Its expression in q, q', t and parameters.
    pub expression: Expr,
    /// The same as a person writes it.
    pub shown: Expr,
    /// Values at the rows.
    pub values: Vec<f64>,
    /// Deviations from the start at the rows, without jumps; the values themselves of what should vanish.
    pub changes: Vec<f64>,
    /// The jumps along the run, as of an angle at its cut.
    pub jumps: Option<Jumps>,
    /// Whether it was followed at the ends of steps too, not at rows alone.
    pub at_steps: bool,
    /// After how many steps a projection gave it its value; `None` where none does.
    pub kept: Option<u64>,
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
    /// Why a second run tells no error, if it does not.
    pub unknown_error: Option<String>,
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
    /// Largest differences of the run and of the other formulation to a run at a sharper tolerance.
    pub losses: Option<(f64, f64)>,
    /// Observed order.
    pub orders: Option<Orders>,
    /// Tolerance asked.
    pub tolerance: f64,
    /// The step, where it is fixed.
    pub step: Option<f64>,
    /// What was found before the run, to be kept along it.
    pub searched: Searched,
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
        for (i, quantity) in followed.iter_mut().enumerate() {
            let all = run.followed.get(i).filter(|_| quantity.at_steps);
            quantity.at_steps = all.is_some();
            if let Some(all) = all {
                quantity.drift.record(all.drift.value, all.drift.t);
                quantity.scale = quantity.scale.max(all.scale);
            }
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
            losses: finer
                .as_ref()
                .zip(comparison.as_ref())
                .map(|(finer, other)| {
                    (
                        difference(finer, &run).value,
                        difference(finer, other).value,
                    )
                }),
            unknown_error: finer.as_ref().and_then(|other| not_comparable(&run, other)),
            global_error: finer
                .as_ref()
                .filter(|other| not_comparable(&run, other).is_none())
                .map(|other| difference(&run, other).value),
            tolerance: settings.tolerance,
            step: settings.step,
            searched: Searched::default(),
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

/// Ends as near as this, relative to the time, are one place.
const SAME_END: f64 = 1e-6;

/// Why the second run is another motion, or ended elsewhere, so that the difference of both is no error.
fn not_comparable(run: &Run, other: &Run) -> Option<String> {
    // Runs that end at the same place, each to its tolerance, are the same motion up to there.
    let is_same_end = run.ending.finished == other.ending.finished
        && (run.t - other.t).abs() <= SAME_END * run.t.abs().max(1.0);
    if other.asked() < run.asked() && !is_same_end {
        return Some(format!(
            "the second, sharper run ended earlier: {}",
            other.ending.reason
        ));
    }
    if other.crossings.len() != run.crossings.len() {
        return Some(format!(
            "the rank of the constraints falls {} times in one run and {} times in the sharper one",
            run.crossings.len(),
            other.crossings.len()
        ));
    }
    None
}

impl MotionEvidence {
    /// After how many steps the projection gave an integral its value; `None` where it is none to keep.
    fn steps_kept(&self, value: Expr) -> Option<u64> {
        let place = self.searched.to_keep.iter().position(|&own| own == value)?;
        kept_steps(self.run.kept.as_ref()?, place..place + 1)
    }

    /// The rows for quadratures: those closer than the steps, where there are any.
    pub fn rows(&self) -> &Run {
        self.dense.as_ref().unwrap_or(&self.run)
    }

    /// Says what was found before the run, to be kept along it.
    pub(crate) fn keep(&mut self, searched: Searched) {
        self.searched = searched;
        let Some(report) = self.run.kept.clone() else {
            return;
        };
        let Searched {
            to_keep, functions, ..
        } = &self.searched;
        let all = std::iter::once(&mut self.energy).chain(&mut self.integrals);
        for own in all {
            let place = to_keep.iter().position(|&value| value == own.expression);
            own.kept = match place {
                Some(place) => kept_steps(&report, place..place + 1),
                None if functions.contains(&own.expression) => {
                    kept_steps(&report, 0..to_keep.len())
                }
                None => None,
            };
        }
    }

    /// Takes the difference of the two formulations from another run of the first, or says that there is none.
    pub(crate) fn compare_with(&mut self, first: Option<&Run>) {
        let both = first.zip(self.comparison.as_ref());
        self.disagreement = both.map(|(first, other)| difference(first, other));
    }
}

/// After how many steps integrals have their values by the projection; `None` after none.
fn kept_steps(report: &KeptReport, places: Range<usize>) -> Option<u64> {
    let left_out = report.left_out.get(places)?.iter();
    let missed = report.failed.count + left_out.map(|missed| missed.count).max().unwrap_or(0);
    report.steps.checked_sub(missed).filter(|&steps| steps > 0)
}

/// First integrals that were found before a run, to be kept along it.
#[derive(Clone, Debug, Default)]
pub struct Searched {
    /// All of them, in the order of their numbers.
    pub integrals: Vec<Integral>,
    /// The values of those that a projection can keep.
    pub to_keep: Vec<Expr>,
    /// The energy and stated integrals, as far as they are functions of these.
    pub functions: Vec<Expr>,
}

/// First integrals that a search found, along a run, by their numbers.
#[derive(Clone, Debug, Default)]
pub struct FoundIntegrals {
    /// All but the energy.
    pub others: Vec<Followed>,
    /// The energy, where it is among them: it is followed anyway.
    pub energy: Option<Followed>,
}

impl FoundIntegrals {
    /// Follows what was found along the rows.
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        evidence: &MotionEvidence,
        found: &[Integral],
    ) -> FoundIntegrals {
        let is_energy = |integral: &Integral| integral.name.as_deref() == Some(ENERGY);
        let numbered = || (1..).map(|j: usize| j.to_string()).zip(found);
        let others = numbered().filter(|(_, integral)| !is_energy(integral));
        let quantities: Vec<(String, Expr)> = others
            .clone()
            .map(|(name, integral)| (name, integral.value))
            .collect();
        let count = quantities.len();
        let parts = (system, terms, &evidence.binding);
        let mut followed = follow(parts, &evidence.run, quantities, count).unwrap_or_default();
        for (own, (_, integral)) in followed.iter_mut().zip(others) {
            own.shown = integral.shown;
            own.at_steps = false;
            own.kept = evidence.steps_kept(integral.value);
        }
        let energy = numbered().find(|(_, integral)| is_energy(integral));
        FoundIntegrals {
            others: followed,
            energy: energy.map(|(name, integral)| Followed {
                name,
                shown: integral.shown,
                ..evidence.energy.clone()
            }),
        }
    }

    /// All in the order of their numbers.
    pub fn all(&self) -> Vec<&Followed> {
        let mut all: Vec<&Followed> = self.others.iter().chain(&self.energy).collect();
        all.sort_by_key(|own| own.name.parse::<usize>().unwrap_or(usize::MAX));
        all
    }
}

impl MotionEvidence {
    /// What rounding of the state, or an error of the tolerance asked, changes in a quantity, which may be more than the size of its terms,
    /// as of z where all motions have z = 0 and constraints hold to rounding, or of a quotient near 0/0: its slopes by coordinates and by velocities at the start, or at the time `t` of its largest
    /// deviation, each times the largest of these along the run. `None` where it has no slopes there.
    pub(crate) fn rounding_of(&self, g: &Graph, quantity: Expr, t: f64) -> Option<f64> {
        let layout = &self.run.layout;
        let (positions, velocities) = self.state()?;
        let symbols = [positions, velocities].map(|own| g.gradient(self.bound(g, quantity), own));
        let largest = |range: Range<usize>| {
            let rows = (0..self.run.regular()).flat_map(|j| &self.run.row(j)[range.clone()]);
            rows.fold(0.0, |m: f64, x| m.max(x.abs()))
        };
        let reach = [layout.positions(), layout.v()].map(largest);
        let there = self.run.times.partition_point(|&own| own < t);
        let at = |j: usize| -> Option<f64> {
            let values = self.values_at(j)?;
            let parts = symbols.iter().zip(reach).map(|(gradient, reach)| {
                let found = g.evaluate_f64(gradient, &|s| values.get(&s).copied());
                Some(found.ok()?.iter().map(|x| x.abs()).sum::<f64>() * reach)
            });
            parts.sum()
        };
        let rows = [0, there.min(self.run.regular().checked_sub(1)?)];
        let all = rows.into_iter().filter_map(at).fold(0.0, f64::max);
        let error = (ROUNDINGS * f64::EPSILON).max(self.tolerance.min(1e-6));
        Some(error * all).filter(|x| x.is_finite())
    }

    /// Whether a function of the state does not keep its sign along the rows; `None` where it has no value.
    pub(crate) fn changes_sign(&self, g: &Graph, e: Expr) -> Option<bool> {
        let e = [self.bound(g, e)];
        let mut all = Vec::new();
        for j in 0..self.run.regular() {
            let values = self.values_at(j)?;
            all.push(g.evaluate_f64(&e, &|s| values.get(&s).copied()).ok()?[0]);
        }
        let largest = all.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let sign = |value: &f64| {
            if value.abs() <= MET * largest {
                0.0
            } else {
                value.signum()
            }
        };
        let signs: Vec<f64> = all.iter().map(sign).collect();
        Some(signs.iter().any(|&sign| sign == 0.0 || sign != signs[0]))
    }

    fn bound(&self, g: &Graph, e: Expr) -> Expr {
        g.substitute(e, &self.binding.controls)
    }

    /// Symbols of the positions and of the velocities.
    fn state(&self) -> Option<(&[Symbol], &[Symbol])> {
        let state = self.binding.variables.get(1..)?;
        state.split_at_checked(self.run.layout.positions().len())
    }

    /// The state at a row, with the parameters.
    fn values_at(&self, j: usize) -> Option<BTreeMap<Symbol, f64>> {
        let (layout, row) = (&self.run.layout, self.run.row(j));
        let (positions, velocities) = self.state()?;
        let of_state = positions.iter().zip(&row[layout.positions()]);
        let of_state = of_state.chain(velocities.iter().zip(&row[layout.v()]));
        let of_state = of_state.map(|(s, x)| (*s, *x));
        let time = [(*self.binding.variables.first()?, *self.run.times.get(j)?)];
        let all = of_state.chain(self.binding.parameters.iter().copied());
        Some(all.chain(time).collect())
    }
}

/// What is so near to zero along a run, beside its largest value, has met it.
const MET: f64 = 1e-9;

/// So many roundings of the state are no drift.
const ROUNDINGS: f64 = 64.0;

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
    let jumping = quantities[..constant].iter();
    let mut parts: Vec<Vec<jumps::Part>> = jumping.map(|(_, e)| jumps::parts(g, *e)).collect();
    parts.resize(quantities.len(), Vec::new());
    let precise = double_double::along((system, terms, binding), run, &expressions)?;
    expressions.extend(sizes);
    expressions.extend(parts.iter().flatten().map(|part| part.value));
    let mut observer = Observer::with_own(system, terms, binding, &run.own, &expressions)?;
    let mut series = observer.along(run);
    // The state at which the equations became singular is recorded, but a residual may have no value there.
    let regular = run.regular();
    let mut of_parts = series.split_off(2 * quantities.len()).into_iter();
    let sizes = series.split_off(quantities.len());
    let followed = quantities
        .into_iter()
        .zip(series.into_iter().zip(sizes))
        .enumerate()
        .map(|(i, ((name, expression), (values, sizes)))| {
            let of_parts: Vec<Vec<f64>> = of_parts.by_ref().take(parts[i].len()).collect();
            let scale = sizes[..regular].iter().fold(0.0, |m: f64, x| m.max(*x));
            let turn = jumps::turn(g, binding, expression, &parts[i]);
            // Whole turns that are small beside the terms would hide a drift.
            let turn = turn.filter(|turn| *turn > LEAST_TURN * scale);
            let met = jumps::met(&run.times[..regular], &parts[i], &of_parts);
            let precise = precise.as_ref().map(|all| all[i].clone());
            let values = precise.as_ref().map_or(values, |all| rounded(all));
            let rows = met.as_ref().map_or(&[][..], |(_, rows)| rows);
            let changes = match i < constant {
                true => from_start((&values, precise.as_deref()), turn, rows),
                false => values.clone(),
            };
            Followed {
                name,
                expression,
                shown: expression,
                drift: deviation(&run.times[..regular], &changes),
                changes,
                scale,
                values,
                precise,
                // What is measured at the ends of steps knows nothing of jumps.
                at_steps: turn.is_none() && met.is_none(),
                jumps: met.map(|(jumps, _)| jumps),
                kept: None,
            }
        });
    Ok(followed.collect())
}

/// Whole turns are left out where one is more than this part of the size of the terms.
const LEAST_TURN: f64 = 1e-2;

/// Values less the first one, without whole turns or without what changes across the jumps before these rows.
fn from_start(
    (values, precise): (&[f64], Option<&[DoubleDouble]>),
    turn: Option<f64>,
    rows: &[usize],
) -> Vec<f64> {
    match (precise, turn) {
        (Some(values), _) => rounded(&jumps::between(values, rows)),
        (None, Some(turn)) => jumps::between(values, &[])
            .into_iter()
            .map(|change| jumps::without_turns(change, turn))
            .collect(),
        (None, None) => jumps::between(values, rows),
    }
}

fn rounded(values: &[DoubleDouble]) -> Vec<f64> {
    values.iter().map(|x| x.high()).collect()
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

/// Largest difference of positions and velocities at common times, each component over its natural size and its largest magnitude.
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
        let size = a.scales.get(i).copied().unwrap_or(1.0);
        let scale = size + (0..rows).fold(0.0, |m: f64, j| m.max(a.row(j)[i].abs()));
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
            if (stated - used).abs() > 1e-12 * used.abs().max(stated.abs()) {
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
