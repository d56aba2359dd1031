//! The numbers of a run in double-double arithmetic, from what the model states exactly.

use crate::error::StudyError;
use crate::options::StudyOptions;
use chetaev_mechanics::System;
use chetaev_model::model::{Model, Output, Precision};
use chetaev_motion::double_double::number;
use chetaev_motion::{DoubleDouble, Precise, RunSettings};
use chetaev_symbolic::Expr;

/// Whether double-double arithmetic is asked for: by the options, else by the model.
pub(crate) fn is_asked(model: &Model, options: &StudyOptions) -> bool {
    options.precision.or(model.simulation.precision) == Some(Precision::DoubleDouble)
}

/// Everything that the run takes from the model, rounded once.
pub(crate) fn precise(
    model: &Model,
    system: &System,
    options: &StudyOptions,
    settings: &RunSettings,
) -> Result<Precise, StudyError> {
    let reader = Reader {
        model,
        values: system.parameter_values(),
    };
    let simulation = &model.simulation;
    let t_start = match simulation.t_start {
        Some(t) => reader.value(t, "t_start")?,
        None => DoubleDouble::ZERO,
    };
    let t_end = match (options.t_end, options.t_end_exact, simulation.t_end) {
        (Some(_), Some(exact), _) => exact,
        (None, _, Some(t)) => reader.value(t, "t_end")?,
        _ => DoubleDouble::from(settings.t_end),
    };
    let parameters = system
        .parameters
        .iter()
        .map(|parameter| match parameter.value {
            Some(value) => reader.value(value, &parameter.name),
            None => Err(missing(&parameter.name)),
        });
    let (q, v) = reader.initial(system)?;
    Ok(Precise {
        parameters: parameters.collect::<Result<_, _>>()?,
        times: reader.times(settings, (t_start, t_end))?,
        t_start,
        t_end,
        q,
        v,
    })
}

fn missing(name: &str) -> StudyError {
    StudyError::MissingValues {
        names: format!("`{name}`"),
    }
}

/// Values as the run takes them, where they are given.
type Given = Vec<Option<DoubleDouble>>;

struct Reader<'m> {
    model: &'m Model,
    values: Vec<(Expr, Expr)>,
}

impl Reader<'_> {
    fn value(&self, e: Expr, name: &str) -> Result<DoubleDouble, StudyError> {
        let g = &self.model.graph;
        number(g, g.substitute(e, &self.values)).ok_or_else(|| missing(name))
    }

    /// Coordinates with the masses behind them, and velocities.
    fn initial(&self, system: &System) -> Result<(Given, Given), StudyError> {
        let given = |order: u32| {
            let places = 0..system.n();
            let values = places.map(|i| match self.model.initial.values.get(&(i, order)) {
                Some(given) if !given.is_guess => self.value(given.value, &given.text).map(Some),
                _ => Ok(None),
            });
            values.collect::<Result<Given, StudyError>>()
        };
        let mut q = given(0)?;
        for mass in &system.masses {
            q.push(match self.model.initial_mass(&mass.name) {
                Some(value) => Some(self.value(value, &mass.name)?),
                None => None,
            });
        }
        Ok((q, given(1)?))
    }

    /// The times of the rows, of which the settings have the nearest doubles.
    fn times(
        &self,
        settings: &RunSettings,
        (start, end): (DoubleDouble, DoubleDouble),
    ) -> Result<Vec<DoubleDouble>, StudyError> {
        let count = settings.times.len();
        let whole = |j: usize| DoubleDouble::from(j as f64);
        match &self.model.simulation.output {
            Some(Output::Times(times)) => {
                let times = times.iter().map(|&t| self.value(t, "output"));
                times.collect()
            }
            Some(Output::Step(step)) => {
                let size = self.value(*step, "output")?;
                let step = if end < start { -size } else { size };
                let times = (0..count).map(|j| start + step * whole(j));
                // The last may lie beyond the end by its rounding.
                let clamped = times.map(|t| match (end < start, t < end) {
                    (true, true) | (false, false) => end,
                    _ => t,
                });
                Ok(clamped.collect())
            }
            _ if count < 2 => Ok(vec![start; count]),
            _ => {
                let part = (end - start) / whole(count - 1);
                let mut times: Vec<_> = (0..count).map(|j| start + part * whole(j)).collect();
                if let Some(last) = times.last_mut() {
                    *last = end;
                }
                Ok(times)
            }
        }
    }
}
