//! The texts of a model file: from the disk, with what it may include.

use chetaev::disk::{text_of, Disk};
use chetaev::model::{Files, NoFiles};
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
