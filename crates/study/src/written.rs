//! Equations of motion written out: for reading, as data, as code, and two formulations held against each other: `chetaev derive`.

mod arrays;
mod code;
mod comparison;
mod count;
pub(crate) mod latex;
mod numbers;
mod printed;

use crate::derivation::{derivation, Derivation, NotDerived, Readings};
use crate::start;
use crate::written::numbers::Numbers;
use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::{choice, Context, Formulation, Prepared, System};
use chetaev_model::Model;
use chetaev_symbolic::print::{CodeError, Format};

/// How equations are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// As in a model file.
    Text,
    /// LaTeX.
    Latex,
    /// MathML.
    Mathml,
    /// A Python module of SymPy equations.
    Sympy,
    /// JSON.
    Json,
    /// Functions in Rust.
    Rust,
    /// Functions in C.
    C,
    /// A function for Python with NumPy, as SciPy's `solve_ivp` takes it.
    Python,
    /// A function for MATLAB and Octave, as `ode45` takes it.
    Matlab,
    /// A function for Julia, as DifferentialEquations.jl takes it.
    Julia,
}

impl Notation {
    /// All notations with their words.
    pub const WORDS: [(&'static str, Notation); 10] = [
        ("text", Notation::Text),
        ("latex", Notation::Latex),
        ("mathml", Notation::Mathml),
        ("sympy", Notation::Sympy),
        ("json", Notation::Json),
        ("rust", Notation::Rust),
        ("c", Notation::C),
        ("python", Notation::Python),
        ("matlab", Notation::Matlab),
        ("julia", Notation::Julia),
    ];

    /// The format of single expressions; `None` where functions of a program are written.
    pub fn format(self) -> Option<Format> {
        match self {
            Notation::Text => Some(Format::Text),
            Notation::Latex => Some(Format::Latex),
            Notation::Mathml => Some(Format::Mathml),
            Notation::Sympy => Some(Format::Sympy),
            Notation::Json => Some(Format::Json),
            Notation::Rust
            | Notation::C
            | Notation::Python
            | Notation::Matlab
            | Notation::Julia => None,
        }
    }

    /// The notation of a word.
    pub fn named(word: &str) -> Option<Notation> {
        let mut known = Notation::WORDS.into_iter();
        known.find(|(own, _)| *own == word).map(|(_, own)| own)
    }

    /// Whether it is a programming language, in which the equations stand as they were derived.
    pub fn is_code(self) -> bool {
        matches!(self, Notation::Rust | Notation::C) || self.is_of_arrays()
    }

    /// Whether it is a language of arrays, in which one function is asked for.
    pub fn is_of_arrays(self) -> bool {
        matches!(self, Notation::Python | Notation::Matlab | Notation::Julia)
    }
}

/// Why nothing is written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NotWritten {
    /// A formulation that does not exist.
    #[error("there is no formulation `{0}`")]
    Unknown(String),
    /// A formulation that does not apply, or gives nothing.
    #[error(transparent)]
    NotDerived(#[from] NotDerived),
    /// A formulation that offers no steps.
    #[error("`{name}` is not written step by step here; {known}")]
    NoSteps {
        /// The formulation.
        name: &'static str,
        /// Those that offer steps, in a sentence.
        known: String,
    },
    /// A derivation in another notation.
    #[error("steps are written as text and latex: use `--as text` or `--as latex`")]
    StepsAsText,
    /// What has no code.
    #[error(transparent)]
    Code(CodeError),
}

/// Terms and selection, with what a reader of the equations must know about them: constraints that are left out, wishes that are not
/// heeded.
///
/// # Errors
/// [`CharacteristicsError`] where no admissible state is found.
pub fn prepared(
    model: &Model,
    system: &System,
) -> Result<(Prepared, Vec<String>), CharacteristicsError> {
    let prepared = start::prepared(model, system)?;
    let mut notes = Vec::new();
    if let Some(left_out) = prepared.left_out(system)? {
        notes.push(format!(
            "redundant constraints: {} left out, the others imply what they say",
            left_out.quoted()
        ));
    }
    notes.extend(choice::unheeded(
        system,
        &prepared.terms,
        &prepared.selection,
    ));
    Ok((prepared, notes))
}

/// What hears of a formulation before it is derived, and after, with what it gave.
pub type Told<'a> = &'a mut dyn FnMut(&'static dyn Formulation, Option<&Tried>);

/// A formulation derived, or why it is not.
pub type Tried = Result<Derivation, NotDerived>;

/// The equations of several formulations of the system of a model, one after the other; `told` hears of each before and after, with what it gave.
///
/// # Errors
/// [`NotWritten`]; with `all` formulations one that does not apply is an answer.
pub fn equations(
    model: &Model,
    cx: &Context<'_>,
    asked: &[&'static dyn Formulation],
    (notation, all): (Notation, bool),
    told: Told<'_>,
) -> Result<String, NotWritten> {
    let readings = Readings::default();
    let mut found = Vec::new();
    for formulation in asked {
        told(*formulation, None);
        let one = derivation(cx, *formulation, (!notation.is_code()).then_some(&readings));
        told(*formulation, Some(&one));
        match one {
            Err(problem) if !all => return Err(problem.into()),
            one => found.push(one),
        }
    }
    if notation.is_of_arrays() {
        arrays::source(&Numbers::of(model, cx), &found, notation)
    } else if notation.is_code() {
        code::source(&Numbers::of(model, cx), &found, notation)
    } else {
        Ok(printed::text(cx, &found, notation))
    }
}

/// The operations of the equations of several formulations as they are printed, one line for each.
///
/// # Errors
/// [`NotWritten`]; with `all` formulations one that does not apply is an answer.
pub fn counts(
    cx: &Context<'_>,
    asked: &[&'static dyn Formulation],
    all: bool,
) -> Result<String, NotWritten> {
    let readings = Readings::default();
    let mut text = String::new();
    for formulation in asked {
        match derivation(cx, *formulation, Some(&readings)) {
            Ok(one) => text.push_str(&count::line(cx.system, &one)),
            Err(problem) if !all => return Err(problem.into()),
            Err(problem) => text.push_str(&format!("{problem}\n")),
        }
    }
    Ok(text)
}

/// Differences of the equations of two formulations, and why they vanish or where they do not.
///
/// # Errors
/// [`NotWritten`].
pub fn comparison(
    cx: &Context<'_>,
    (a, b): (&str, &str),
    progress: &dyn Fn(&str),
) -> Result<String, NotWritten> {
    comparison::text(cx, a, b, progress)
}
