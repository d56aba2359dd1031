//! One trajectory, as `chetaev simulate` computes it.

use crate::clock::{per_unit, Clock};
use crate::prepared::{words, Prepared, Source};
use crate::question::Question;
use crate::Ready;
use chetaev::motion::{CompiledRouth, Run, RunSettings, Subject, Watcher};
use serde_json::json;

/// The settings of a run of which only the end is asked for.
pub(crate) fn settings(question: &Question) -> RunSettings {
    let (method, _) = parts(&question.variant);
    RunSettings {
        tolerance: question.tolerance,
        absolute_tolerance: question.tolerance,
        method: method.into(),
        times: vec![question.t_end],
        max_steps: 50_000_000,
        ..RunSettings::new(0.0, question.t_end)
    }
}

/// The method of a variant `taylor` or `taylor, boltzmann-hamel`, and its formulation.
fn parts(variant: &str) -> (&str, Option<&str>) {
    match variant.split_once(", ") {
        Some((method, formulation)) => (method, Some(formulation)),
        None => (variant, None),
    }
}

/// One trajectory from `start` to `t_end`; the answer is q at its end.
///
/// # Errors
/// What is wrong with the model, or why the run did not come to its end.
pub fn trajectory(question: &Question) -> Result<Ready, String> {
    let source = Source::of(&question.root, &question.system)?;
    let prepared = Prepared::new(&source, &question.start)?;
    let settings = settings(question);
    let formulation = match parts(&question.variant).1 {
        None => None,
        Some(name) => Some(
            chetaev::mechanics::formulation(name)
                .ok_or_else(|| format!("there is no formulation `{name}`"))?,
        ),
    };
    let clock = Clock::start();
    let mut compiled = prepared.subject().compile_routh(&settings).map_err(words)?;
    let mut once = move || match formulation {
        None => prepared.run(&mut compiled, &settings),
        Some(by) => {
            let run = prepared
                .subject()
                .by(by, &settings, &mut Watcher::default());
            finished(run.map_err(words)?)
        }
    };
    let run = once()?;
    let n = run.layout.q().len();
    let info = json!({
        "steps": run.statistics.steps,
        "rejected": run.statistics.rejected + run.statistics.failed,
        "first": clock.seconds().0,
    });
    Ok(Ready {
        answer: json!([run.row(run.len() - 1)[..n]]),
        info,
        measure: Box::new(move || per_unit(1.0, || once().map(|_| ()))),
    })
}

/// A run that came to its end.
fn finished(run: Run) -> Result<Run, String> {
    match run.ending.finished && !run.is_empty() {
        true => Ok(run),
        false => Err(run.ending.reason),
    }
}

impl Prepared {
    /// What a run needs to know of the system.
    pub fn subject(&self) -> Subject<'_> {
        Subject {
            system: &self.system,
            terms: &self.terms,
            selection: &self.selection,
            binding: &self.binding,
            numeric: &self.numeric,
            start: &self.start,
            factors: &[],
        }
    }

    /// Runs Routh's equations to the end.
    fn run(&self, compiled: &mut CompiledRouth, settings: &RunSettings) -> Result<Run, String> {
        let run = self
            .subject()
            .routh_by(compiled, settings, &mut Watcher::default());
        finished(run.map_err(words)?)
    }
}
