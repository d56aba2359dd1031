//! Exceptions: the classes are those of `chetaev.errors`.

use chetaev::import::ImportError;
use chetaev::integrate::IntegrateError;
use chetaev::model::{Diagnostic, Diagnostics, Model, Place, Sources, Style};
use chetaev::motion::RunError;
use chetaev::study::{diagnostics, placed, StudyError};
use chetaev::symbolic::syntax::Span;
use pyo3::prelude::*;

/// An exception of `chetaev.errors` by the name of its class.
pub(crate) fn named(py: Python<'_>, class: &str, arguments: (String, String)) -> PyErr {
    let made = py
        .import("chetaev.errors")
        .and_then(|module| module.getattr(class))
        .and_then(|class| class.call1(arguments));
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(problem) => problem,
    }
}

/// The problems of a model, as they are printed and as data.
pub(crate) fn of_model(py: Python<'_>, found: &Diagnostics) -> PyErr {
    let data = serde_json::to_string(&found.to_data()).unwrap_or_default();
    named(py, "ModelError", (found.render(Style::Plain), data))
}

/// A problem of the description of a robot, at its line.
pub(crate) fn of_description(
    py: Python<'_>,
    problem: &ImportError,
    (path, text): (&str, &str),
) -> PyErr {
    let mut sources = Sources::default();
    let source = sources.add(path, text);
    let line = problem.line().unwrap_or(1).max(1) as usize - 1;
    let first = text
        .split_inclusive('\n')
        .take(line)
        .map(str::len)
        .sum::<usize>();
    let own = text.lines().nth(line).unwrap_or_default();
    let start = first + own.len() - own.trim_start().len();
    let span = Span {
        start,
        end: first + own.trim_end().len().max(start - first),
    };
    let place = Place { source, span };
    let list = vec![Diagnostic::error("robot", place, problem.to_string())];
    of_model(py, &Diagnostics { sources, list })
}

/// A problem of the mechanics at the place of what it names.
pub(crate) fn of_system(
    py: Python<'_>,
    problem: &impl std::fmt::Display,
    (model, sources): (&Model, &Sources),
) -> PyErr {
    let list = vec![placed(&problem.to_string(), model)];
    of_model(
        py,
        &Diagnostics {
            sources: sources.clone(),
            list,
        },
    )
}

/// What is wrong with a keyword.
pub(crate) fn of_option(py: Python<'_>, problem: &impl std::fmt::Display) -> PyErr {
    named(py, "OptionError", (problem.to_string(), "[]".to_owned()))
}

/// What is wrong with a study: of a keyword where it comes from one, else at its place in the model.
pub(crate) fn of_study(
    py: Python<'_>,
    problem: &StudyError,
    (model, sources): (&Model, &Sources),
) -> PyErr {
    match problem {
        StudyError::Interrupted => pyo3::exceptions::PyKeyboardInterrupt::new_err(()),
        StudyError::Tolerance { .. }
        | StudyError::PreciseTolerance { .. }
        | StudyError::Step
        | StudyError::StepMissing { .. }
        | StudyError::PrecisionMethod { .. }
        | StudyError::UnknownFormulation { .. }
        | StudyError::Run(RunError::Integrate(IntegrateError::UnknownMethod { .. })) => {
            of_option(py, problem)
        }
        _ => of_model(
            py,
            &Diagnostics {
                sources: sources.clone(),
                list: diagnostics(problem, model),
            },
        ),
    }
}
