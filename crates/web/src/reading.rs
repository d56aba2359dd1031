//! Texts as models.

use crate::shelf::Shelf;
use chetaev::functionals;
use chetaev::model::{self, Loaded, Model, Sources, Style};

/// What a text states.
pub(crate) enum Read {
    /// A motion.
    Motion(Box<Loaded>),
    /// A functional of fields over space.
    Functional(Box<functionals::Loaded>),
}

/// Reads a text.
pub(crate) fn read(path: &str, text: &str) -> Read {
    let tables = model::tables(path, text, &Shelf, &[], Sources::default());
    match tables.is_functional() {
        true => Read::Functional(Box::new(functionals::load(path, text, &Shelf, &[]))),
        false => Read::Motion(Box::new(model::load(path, text, &Shelf, &[]))),
    }
}

/// The model of a text that states a motion.
///
/// # Errors
/// Its problems, as they are printed.
pub(crate) fn motion(path: &str, text: &str) -> Result<Model, String> {
    let loaded = model::load(path, text, &Shelf, &[]);
    let read = loaded
        .into_result()
        .map_err(|found| found.render(Style::Plain))?;
    Ok(read.0)
}
