//! One file for each command; each returns its exit status.

pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod derive;
pub(crate) mod explain;
pub(crate) mod follow;
mod functional;
pub(crate) mod gallery;
pub(crate) mod import;
pub(crate) mod new;
pub(crate) mod plot;
pub(crate) mod principles;
pub(crate) mod simulate;
pub(crate) mod stability;
pub(crate) mod study;
pub(crate) mod sweep;
pub(crate) mod verify;

use crate::arguments::{self, MotionArguments};
use crate::progress::ProgressLine;
use crate::{files, terminal, INPUT, STOPPED};
use chetaev::integrate::IntegrateError;
use chetaev::model::{Model, Precision};
use chetaev::motion::{double_double, RunError};
use chetaev::study::{diagnostics, interruptible, Hooks, StudyError, StudyOptions};
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by Ctrl-C; a run then ends after its present step and keeps what it has.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Listens to Ctrl-C.
fn listen() {
    // Commands within commands listen once.
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(listen_once);
}

fn listen_once() {
    // Where the handler cannot be installed, Ctrl-C ends the program at once.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
}

/// Whether Ctrl-C was pressed.
fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Runs a command of which nothing is kept when it is interrupted.
pub(crate) fn as_a_whole(work: impl FnOnce() -> u8) -> u8 {
    listen();
    let began = std::time::Instant::now();
    let clock = || began.elapsed().as_secs_f64();
    let mut hooks = Hooks {
        clock: &clock,
        interrupt: Some(&INTERRUPTED),
        progress: &mut |_, _| {},
    };
    interruptible(&mut hooks, |_| work()).unwrap_or_else(|_| {
        error("interrupted");
        STOPPED
    })
}

/// Runs `work` with a progress line.
fn with_progress<T>(work: impl FnOnce(&ProgressLine) -> T) -> T {
    work(&ProgressLine::new())
}

/// Runs `work` with a clock, a progress line and Ctrl-C.
fn with_hooks<T>(work: impl FnOnce(&mut Hooks<'_>) -> T) -> T {
    listen();
    with_progress(|line| {
        let began = std::time::Instant::now();
        let clock = || began.elapsed().as_secs_f64();
        let mut show = |what: &str, fraction: Option<f64>| line.show(what, fraction);
        work(&mut Hooks {
            clock: &clock,
            interrupt: Some(&INTERRUPTED),
            progress: &mut show,
        })
    })
}

/// Options that come from the motion arguments; prints what is wrong with them.
fn options(motion: &MotionArguments, model: &Model) -> Option<StudyOptions> {
    let number = |flag: &str, text: &Option<String>| match text {
        None => Ok(None),
        Some(text) => model.constant_value(flag, text).map(Some),
    };
    let exact = |flag: &str, text: &Option<String>| match text {
        None => Ok(None),
        Some(text) => model.constant(flag, text).map(Some),
    };
    match (
        exact("--t-end", &motion.t_end),
        number("--step", &motion.step),
    ) {
        (Ok(t_end), Ok(step)) => Some(StudyOptions {
            t_end: t_end.map(|(_, value)| value),
            t_end_exact: t_end.and_then(|(e, _)| double_double::number(&model.graph, e)),
            precision: motion.precision.map(|precision| match precision {
                arguments::Precision::Double => Precision::Double,
                arguments::Precision::DoubleDouble => Precision::DoubleDouble,
            }),
            tolerance: motion.tolerance,
            step,
            method: motion.method.clone(),
            formulation: motion.formulation.clone(),
            project: motion.project,
            keep_integrals: motion.keep_integrals,
            branch: motion.branch,
            ..StudyOptions::default()
        }),
        (t_end, step) => {
            for problems in [t_end.err(), step.err()].into_iter().flatten() {
                files::report(&problems);
            }
            None
        }
    }
}

/// Prints what is wrong with a study: of an option where it comes from one, else at its place in the model.
fn refuse(problem: &StudyError, motion: &MotionArguments, read: &files::Read) -> u8 {
    if *problem == StudyError::Interrupted {
        error(problem);
        return STOPPED;
    }
    match of_option(problem, motion) {
        Some(option) => error(format!("{option}: {problem}")),
        None => read.refuse_all(diagnostics(problem, &read.model)),
    }
    INPUT
}

/// The option that a problem comes from, with its value.
fn of_option(problem: &StudyError, motion: &MotionArguments) -> Option<String> {
    let method = || {
        motion
            .method
            .as_ref()
            .map(|name| format!("--method {name}"))
    };
    let is_precise = motion.precision == Some(arguments::Precision::DoubleDouble);
    let precision = || is_precise.then(|| "--precision double-double".to_owned());
    match problem {
        StudyError::Tolerance { tolerance, .. }
        | StudyError::PreciseTolerance { tolerance, .. } => {
            let given = motion.tolerance.filter(|given| given == tolerance);
            given.map(|given| format!("--tolerance {given}"))
        }
        StudyError::Step => motion.step.as_ref().map(|text| format!("--step {text}")),
        StudyError::StepMissing { .. }
        | StudyError::Run(RunError::Integrate(IntegrateError::UnknownMethod { .. })) => method(),
        StudyError::PrecisionMethod { .. } => method().or_else(precision),
        StudyError::PreciseSweep => precision(),
        _ => None,
    }
}

/// Prints an error in the common form.
pub(crate) fn error(message: impl std::fmt::Display) {
    let label = if terminal::error_colours() {
        "\u{1b}[1;31merror\u{1b}[0m"
    } else {
        "error"
    };
    terminal::err(&format!("{label}: {message}"));
}
