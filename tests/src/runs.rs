//! One model through the public interface, with what the command line would say and how it would exit.

use chetaev::mechanics::formulations::Routh;
use chetaev::model::model::Output;
use chetaev::model::{load, Diagnostics, Loaded, Model, NoFiles, Style};
use chetaev::motion::observe::Observer;
use chetaev::motion::{NumericSystem, Run, RunSettings, Subject, Watcher};
use chetaev::study::{study, ClaimSelection, Hooks, Study, StudyOptions};
use chetaev::symbolic::Verdict;
use std::time::Instant;

/// What is asked of a run.
#[derive(Clone, Debug, Default)]
pub struct Ask {
    /// Claims wanted; all when empty.
    pub claims: Vec<&'static str>,
    /// Times of the rows; those of the model when empty.
    pub times: Vec<f64>,
    /// End of the run; that of the model when none.
    pub t_end: Option<f64>,
    /// Tolerance; that of the model when none.
    pub tolerance: Option<f64>,
    /// Whether to estimate the global error.
    pub global_error: bool,
    /// The formulation integrated; Routh's when none.
    pub formulation: Option<&'static str>,
}

/// How a study ended, whether or not there was anything to study.
#[derive(Debug)]
pub struct Ended {
    /// Exit status of the command line.
    pub exit: u8,
    /// Diagnostics, error, notices and the reason of a stop.
    pub text: String,
    /// The study, when the input was good enough for one.
    pub study: Option<Study>,
}

impl Ended {
    /// The verdict on a claim, by its full id.
    ///
    /// # Panics
    /// When there is no study or no such verdict.
    pub fn verdict(&self, claim: &str) -> &Verdict {
        let study = self.study.as_ref();
        let study = study.unwrap_or_else(|| panic!("{}", self.text));
        let decided = study.verdicts.iter().find(|d| d.full_id() == claim);
        let decided = decided.unwrap_or_else(|| panic!("no verdict of {claim}"));
        &decided.finding.verdict
    }
}

/// Studies a model of one text.
pub fn ended_text(text: &str, ask: &Ask) -> Ended {
    ended(load("model.toml", text, &NoFiles, &[]), ask)
}

/// Studies a model that was read.
pub fn ended(loaded: Loaded, ask: &Ask) -> Ended {
    let (model, diagnostics) = match loaded.into_result() {
        Ok(pair) => pair,
        Err(diagnostics) => {
            return Ended {
                exit: 2,
                text: rendered(&diagnostics),
                study: None,
            }
        }
    };
    let mut text = rendered(&diagnostics);
    match studied(model, ask) {
        Ok(study) => {
            text.push_str(&study.notices.join("\n"));
            if let Some(motion) = &study.motion {
                text.push('\n');
                text.push_str(&motion.evidence.run.ending.reason);
            }
            Ended {
                exit: study.outcome.exit_status(),
                text,
                study: Some(study),
            }
        }
        Err(error) => Ended {
            exit: 2,
            text: format!("{text}{error}"),
            study: None,
        },
    }
}

fn rendered(diagnostics: &Diagnostics) -> String {
    if diagnostics.list.is_empty() {
        String::new()
    } else {
        format!("{}\n", diagnostics.render(Style::Plain))
    }
}

fn studied(mut model: Model, ask: &Ask) -> Result<Study, String> {
    if !ask.times.is_empty() {
        let times = ask.times.iter().map(|t| model.expression(&t.to_string()));
        let times: Result<Vec<_>, _> = times.collect();
        model.simulation.output = Some(Output::Times(times.map_err(|d| d.render(Style::Plain))?));
    }
    let began = Instant::now();
    let clock = || began.elapsed().as_secs_f64();
    let mut hooks = Hooks {
        clock: &clock,
        interrupt: None,
        progress: &mut |_, _| {},
    };
    let options = StudyOptions {
        claims: ClaimSelection {
            words: ask.claims.iter().map(|&w| w.to_owned()).collect(),
        },
        t_end: ask.t_end,
        tolerance: ask.tolerance,
        global_error: ask.global_error,
        formulation: ask.formulation.map(str::to_owned),
        ..StudyOptions::default()
    };
    study(model, options, &mut hooks).map_err(|e| e.to_string())
}

/// Values of an expression of the model along a run of its study; NaN where it has none.
///
/// # Errors
/// What is wrong with the expression.
pub fn along(study: &Study, run: &Run, expression: &str) -> Result<Vec<f64>, String> {
    let parsed = study
        .model
        .expression(expression)
        .map_err(|d| d.render(Style::Plain))?;
    let binding = &study.motion.as_ref().ok_or("no motion")?.binding;
    let (system, terms) = (&study.system, &study.prepared.terms);
    let mut observer = Observer::with_own(system, terms, binding, &run.own, &[parsed])
        .map_err(|e| e.to_string())?;
    Ok(observer.along(run).swap_remove(0))
}

/// The same motion again with other output times.
///
/// # Errors
/// Why it cannot be run.
pub fn again(study: &Study, times: Vec<f64>) -> Result<Run, String> {
    let motion = study.motion.as_ref().ok_or("no motion")?;
    let numeric = NumericSystem::new(&study.system, &study.prepared.terms, &motion.binding)
        .map_err(|e| e.to_string())?;
    let subject = Subject {
        system: &study.system,
        terms: &study.prepared.terms,
        selection: &study.prepared.selection,
        binding: &motion.binding,
        numeric: &numeric,
        start: &motion.start,
        factors: &[],
    };
    let settings = RunSettings {
        t_end: times.last().copied().unwrap_or(motion.settings.t_end),
        times,
        ..motion.settings.clone()
    };
    subject
        .by(&Routh, &settings, &mut Watcher::default())
        .map_err(|e| e.to_string())
}
