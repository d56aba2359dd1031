//! Which claims about a functional are asked for.

use crate::explanation::nearest;
use chetaev_functionals::claims::CLAIMS;

/// A word that names no claim about functionals.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{word}` is neither the group functional nor a claim about functionals{near}")]
pub struct UnknownClaim {
    /// As asked for.
    pub word: String,
    /// What may have been meant.
    pub near: String,
}

/// The words of a list with commas, each of which is the group `functional` or the id of a claim; none where all are asked for.
///
/// # Errors
/// A word that is neither.
pub fn selected(text: &str) -> Result<Vec<String>, UnknownClaim> {
    let words = text.split(',').map(str::trim).filter(|w| !w.is_empty());
    let words: Vec<String> = words.map(str::to_owned).collect();
    let ids = || CLAIMS.iter().map(|c| c.id());
    let unknown = words
        .iter()
        .find(|w| *w != "functional" && ids().all(|id| id != w.as_str()));
    match unknown {
        None => Ok(words),
        Some(word) => Err(UnknownClaim {
            word: word.clone(),
            near: nearest(word, ids()),
        }),
    }
}

/// Whether a claim is asked for by these words.
pub fn is_selected(words: &[String], id: &str) -> bool {
    let is_meant = |word: &String| word == id || id.starts_with(&format!("{word}."));
    words.is_empty() || words.iter().any(is_meant)
}
