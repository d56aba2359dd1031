//! Why a question has no answer.

use chetaev::mechanics::characteristics::CharacteristicsError;
use chetaev::mechanics::SystemError;
use chetaev::study::written::NotWritten;
use wasm_bindgen::JsValue;

/// Why a question has no answer, in words for the page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// The text states no model.
    #[error("{0}")]
    Model(chetaev::model::Diagnostics),
    /// The functional has errors, which the check tells.
    #[error("the model has errors")]
    Functional,
    /// The system cannot be set up.
    #[error(transparent)]
    System(#[from] SystemError),
    /// No admissible state.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// There are no such equations.
    #[error(transparent)]
    Written(#[from] NotWritten),
    /// Orders of derivatives without conditions on the boundary.
    #[error(transparent)]
    Variation(#[from] chetaev::functionals::variation::VariationError),
    /// A form or a notation that there is not.
    #[error("there is no {0}")]
    Absent(&'static str),
    /// Code of a functional.
    #[error("code is made of equations of motion; a functional has field equations")]
    NoCode,
    /// A functional, of which motions are asked.
    #[error(
        "steady motions are those of equations of motion; this model states fields over space"
    )]
    NoMotion,
    /// A question on steady motions has no answer, in the words of the command.
    #[error("{0}")]
    Unanswered(String),
    /// What is asked cannot be read.
    #[error(transparent)]
    Question(#[from] serde_json::Error),
    /// A claim that there is not.
    #[error("`{0}` is neither a group nor a claim")]
    Claim(String),
    /// What the study finds wrong with the model.
    #[error("{}", .0.join("\n"))]
    Study(Vec<String>),
    /// The work was stopped.
    #[error("it was stopped")]
    Stopped,
}

impl From<Refusal> for JsValue {
    fn from(refusal: Refusal) -> JsValue {
        JsValue::from_str(&refusal.to_string())
    }
}
