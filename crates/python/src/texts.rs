//! The texts of a model file: from the disk, with what it may include.

use crate::problem;
use chetaev::disk::{text_of, Disk};
use chetaev::model::model::ModelText;
use chetaev::model::{with_values, Files, NoFiles};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;
use std::path::Path;

/// Names with their values, as they are written.
pub(crate) type Pairs = Vec<(String, String)>;

/// The text of the file at a path.
///
/// # Errors
/// `OSError`.
pub(crate) fn text_at(path: &str) -> PyResult<String> {
    text_of(Path::new(path), false)
        .map_err(|why| PyOSError::new_err(format!("{path} cannot be read: {why}")))
}

/// What a text may include that stands at a path, or would; nothing without one.
pub(crate) fn files_beside(path: Option<&str>) -> Box<dyn Files + Sync> {
    match path {
        Some(path) => Box::new(Disk::beside(Path::new(path))),
        None => Box::new(NoFiles),
    }
}

/// The text of a model with its overrides written in, where that says the same; `None` where it cannot.
pub(crate) fn with_overrides(
    text: &ModelText,
    is_same: impl Fn(&ModelText) -> bool,
) -> Option<String> {
    if text.overrides.is_empty() {
        return Some(text.text.clone());
    }
    let read = |own: String| ModelText {
        text: own,
        overrides: Vec::new(),
        ..text.clone()
    };
    let texts = with_values(&text.text, &text.overrides).into_iter();
    let found = texts.map(read).find(is_same);
    found.map(|own| own.text)
}

/// That a value which was set has no place in the text.
pub(crate) fn not_written(py: Python<'_>, text: &ModelText) -> PyErr {
    let names: Vec<String> = text
        .overrides
        .iter()
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    let said = format!(
        "the values that were set, of {}, cannot all be written into the text of the model: it has no place for one of a family alone, nor for one that \
         other files take too; pickle keeps them",
        names.join(", ")
    );
    problem::named(py, "ModelError", (said, "[]".to_owned()))
}
