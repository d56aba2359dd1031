//! The error of the energy over many steps.

use crate::clock::Clock;
use crate::prepared::{words, Prepared, Source};
use crate::question::Question;
use crate::trajectory::settings;
use crate::Ready;
use chetaev::motion::functions::Functions;
use chetaev::motion::run::equal_times;
use chetaev::motion::{Run, Watcher};
use serde_json::{json, Value};

/// Steps from which the length of the others is estimated.
const PILOT: f64 = 2000.0;
/// At how many times the energy is computed.
const SAMPLES: u32 = 200;

/// A run of about `steps` steps; its measurement has the curve of the relative error of the energy.
///
/// # Errors
/// What is wrong with the model.
pub fn drift(question: &Question) -> Result<Ready, String> {
    let source = Source::of(&question.root, &question.system)?;
    let prepared = Prepared::new(&source, &question.start)?;
    let mut settings = settings(question);
    let mut energy = Functions::new(
        &prepared.system.graph,
        &prepared.binding,
        &prepared.binding.variables,
        &[("energy", vec![prepared.system.energy()])],
    )
    .map_err(words)?;
    let steps = question.steps as f64;
    let pilot = prepared.long_run(&settings)?;
    let per_time = pilot.statistics.steps as f64 / pilot.t;
    let more = (PILOT / per_time).max(question.t_end);
    settings.t_end = more;
    settings.times = vec![more];
    let pilot = prepared.long_run(&settings)?;
    settings.t_end = steps * pilot.t / pilot.statistics.steps as f64;
    settings.times = equal_times(0.0, settings.t_end, SAMPLES);
    Ok(Ready {
        answer: Value::Null,
        info: json!({}),
        measure: Box::new(move || {
            let clock = Clock::start();
            let run = prepared.long_run(&settings)?;
            let (seconds, wall) = clock.seconds();
            let made = run.statistics.steps as f64;
            let errors = errors(&run, &mut energy)?;
            let largest = errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
            let share = made / SAMPLES as f64;
            let at: Vec<f64> = (0..errors.len()).map(|j| j as f64 * share).collect();
            Ok(json!({
                "seconds": seconds / made,
                "wall": wall / made,
                "parts": {"largest": largest, "last": errors.last(), "time": run.t, "steps": made},
                "curve": [at, errors],
            }))
        }),
    })
}

impl Prepared {
    fn long_run(&self, settings: &chetaev::motion::RunSettings) -> Result<Run, String> {
        let run = self.subject().routh(settings, &mut Watcher::default());
        let run = run.map_err(words)?;
        match run.ending.finished && !run.is_empty() {
            true => Ok(run),
            false => Err(run.ending.reason),
        }
    }
}

/// Relative errors of the energy by row.
fn errors(run: &Run, energy: &mut Functions) -> Result<Vec<f64>, String> {
    let mut values = Vec::with_capacity(run.len());
    for j in 0..run.len() {
        let row = run.row(j);
        let (q, v) = (&row[run.layout.q()], &row[run.layout.v()]);
        energy.evaluate(run.times[j], &[q, v]).map_err(words)?;
        values.push(energy.group(0)[0]);
    }
    let first = values.first().copied().unwrap_or(1.0);
    Ok(values.iter().map(|e| (e - first) / first.abs()).collect())
}
