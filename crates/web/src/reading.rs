//! Texts as models.

use crate::refusal::Refusal;
use crate::shelf::beside;
use chetaev::functionals;
use chetaev::model::{self, Loaded, Model, Sources};

/// What a text states.
pub(crate) enum Read {
    /// A motion.
    Motion(Box<Loaded>),
    /// A functional of fields over space.
    Functional(Box<functionals::Loaded>),
}

/// Reads a text.
pub(crate) fn read(path: &str, text: &str) -> Read {
    let files = beside(path);
    let tables = model::tables(path, text, &files, &[], Sources::default());
    if tables.is_functional() {
        Read::Functional(Box::new(functionals::load(path, text, &files, &[])))
    } else {
        Read::Motion(Box::new(model::load(path, text, &files, &[])))
    }
}

/// The model of a text that states a motion.
///
/// # Errors
/// Its problems.
pub(crate) fn motion(path: &str, text: &str) -> Result<Model, Refusal> {
    let loaded = model::load(path, text, &beside(path), &[]);
    let (model, _) = loaded.into_result().map_err(Refusal::Model)?;
    Ok(model)
}

/// The same with the texts that it was read from, for what fields over space do not have.
///
/// # Errors
/// Its problems.
pub(crate) fn with_sources(path: &str, text: &str) -> Result<(Model, Sources), Refusal> {
    let Read::Motion(loaded) = read(path, text) else {
        return Err(Refusal::NoMotion);
    };
    let (model, said) = loaded.into_result().map_err(Refusal::Model)?;
    Ok((model, said.sources))
}
