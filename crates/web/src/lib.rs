//! What the playground in a browser calls: texts go in, texts, JSON and columns of numbers come out.
//!
//! The module runs in a worker of the page, without threads, files or a clock of its own; [`Listener`] hears what is found while it is found.
//! Work that is to stop is left by an exception of the host ([`chetaev::symbolic::meter::Escape`]), as nothing unwinds there.
//!
//! - `reading`: texts as models; `checking`: diagnostics, fixes and sliders; `outcome`: a study that is done; `questions`: steady motions, linear
//!   equations, stability, branches, all by one entry ([`ask`]);
//! - `refusal`: why there is no answer; `shelf`: the gallery as files; `host`: what the browser provides.

mod checking;
mod host;
mod outcome;
mod questions;
mod reading;
mod refusal;
mod shelf;

use chetaev::mechanics::{formulation, Context, Prover, System, FORMULATIONS};
use chetaev::model::kinds::{self, ObjectKind};
use chetaev::study::written::{self, Notation};
use chetaev::study::{
    functional, interruptible, registry, study_telling, ClaimSelection, Decided, Hooks,
    StudyOptions,
};
use host::seconds;
pub use host::Listener;
pub use outcome::Outcome;
pub use questions::Answer;
use reading::Read;
pub use refusal::Refusal;
use serde::Deserialize;
use serde_json::json;
use wasm_bindgen::prelude::*;

/// Sets up the module; the host calls it once.
#[wasm_bindgen]
pub fn begin() {
    host::begin();
}

/// The version of Chetaev.
#[wasm_bindgen]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").to_owned()
}

/// The models of the gallery as JSON: name, title, files.
#[wasm_bindgen]
pub fn gallery() -> String {
    shelf::list().to_string()
}

/// The text of a file of the gallery; empty where there is none.
#[wasm_bindgen(js_name = galleryText)]
pub fn gallery_text(folder: &str, file: &str) -> String {
    shelf::text(folder, file).unwrap_or_default().to_owned()
}

/// The forms of the equations of motion, the claims, the questions of [`ask`], and the kinds of solids, joints and contacts, as JSON, for
/// menus and completion.
#[wasm_bindgen]
pub fn vocabulary() -> String {
    let forms = FORMULATIONS.iter().map(|f| {
        let card = f.card();
        json!({"name": card.name, "title": card.title})
    });
    let known = registry();
    let claims = known
        .claims()
        .iter()
        .map(|claim| json!({"id": claim.id(), "group": claim.group().word()}));
    let objects = |own: Vec<ObjectKind>| {
        let told = own.into_iter().map(|kind| {
            json!({"word": kind.word, "says": kind.says, "keys": kind.keys, "usual": kind.usual})
        });
        told.collect::<Vec<_>>()
    };
    json!({
        "solids": objects(kinds::solids()),
        "joints": objects(kinds::joints()),
        "contacts": objects(kinds::contacts()),
        "forms": forms.collect::<Vec<_>>(),
        "claims": claims.collect::<Vec<_>>(),
        "questions": questions::vocabulary(),
    })
    .to_string()
}

/// Everything wrong or doubtful in a text as JSON, with names and sliders (see `checking`).
#[wasm_bindgen]
pub fn check(path: &str, text: &str) -> String {
    with_hooks(&mut |_, _| {}, |hooks| checking::checked(path, text, hooks)).to_string()
}

/// The equations in the forms named, apart by commas, in a notation of `chetaev derive --as`.
///
/// # Errors
/// What is wrong, in words.
#[wasm_bindgen]
pub fn derive(path: &str, text: &str, forms: &str, notation: &str) -> Result<String, Refusal> {
    let notation = Notation::named(notation).ok_or(Refusal::Absent("such notation"))?;
    if let Read::Functional(loaded) = reading::read(path, text) {
        let problem = loaded.problem.ok_or(Refusal::Functional)?;
        let format = notation.format().ok_or(Refusal::NoCode)?;
        return Ok(functional::derivation(&problem.functional, format)?);
    }
    let model = reading::motion(path, text)?;
    let system = System::from_model(&model)?;
    let names: Vec<&str> = forms
        .split(',')
        .map(str::trim)
        .filter(|n| !n.is_empty())
        .collect();
    let asked: Option<Vec<_>> = names.iter().map(|name| formulation(name)).collect();
    let asked = asked.ok_or(Refusal::Absent("such formulation"))?;
    let found = with_hooks(&mut |_, _| {}, |hooks| {
        interruptible(hooks, |_| {
            let (prepared, _) = written::prepared(&model, &system)?;
            let known = registry();
            let (terms, selection) = (&prepared.terms, &prepared.selection);
            let cx = Context::new(&system, terms, selection, &known, Prover::default());
            Ok::<_, Refusal>(written::equations(
                &model,
                &cx,
                &asked,
                (notation, false),
                &mut |_, _| {},
            )?)
        })
    });
    found.map_err(|_| Refusal::Stopped)?
}

/// What is asked of a study; what is left out is as in the model.
#[derive(Deserialize, Default)]
#[serde(default, deny_unknown_fields)]
struct Asked {
    /// Groups and ids of claims, apart by commas; all where it is left out.
    claims: Option<String>,
    /// Seconds of work for all claims.
    budget: Option<f64>,
    /// Whether the motion is left out.
    still: bool,
    /// Whether the run for the estimate of the error is left out.
    coarse: bool,
    /// Rows of the trajectory go up to this time.
    t_end: Option<f64>,
    /// Relative tolerance.
    tolerance: Option<f64>,
    /// The formulation that is integrated.
    formulation: Option<String>,
}

impl Asked {
    fn options(&self) -> Result<StudyOptions, Refusal> {
        let usual = StudyOptions::default();
        let claims = match self.claims.as_deref() {
            None => ClaimSelection::all(),
            // Nothing but equations.
            Some("none") => ClaimSelection {
                words: vec!["none".to_owned()],
            },
            Some("motion-only") => ClaimSelection::of_motion(),
            Some(text) => {
                ClaimSelection::parse(text, registry().claims()).map_err(Refusal::Claim)?
            }
        };
        Ok(StudyOptions {
            claims,
            budget: self.budget.unwrap_or(usual.budget),
            motion: !self.still,
            global_error: !self.coarse,
            t_end: self.t_end,
            tolerance: self.tolerance,
            formulation: self.formulation.clone(),
            ..usual
        })
    }
}

/// A study as the command makes it; `asked` is JSON. The listener hears `doing` (what is begun), `part` (which part of it is done) and
/// `decided` (a claim with its verdict, as JSON).
///
/// # Errors
/// What is wrong, in words.
#[wasm_bindgen]
pub fn study(path: &str, text: &str, asked: &str, listener: &Listener) -> Result<Outcome, Refusal> {
    let asked: Asked = serde_json::from_str(asked)?;
    if let Read::Functional(loaded) = reading::read(path, text) {
        let problem = loaded.problem.ok_or(Refusal::Functional)?;
        let wants = |_: &str| asked.claims.as_deref() != Some("none");
        return Ok(Outcome::of_functional(chetaev::functionals::study(
            problem, &wants, &seconds,
        )));
    }
    let model = reading::motion(path, text)?;
    let options = asked.options()?;
    let mut progress = |what: &str, part: Option<f64>| match part {
        None => listener.told("doing", what),
        Some(part) => listener.told("part", &format!("{part}")),
    };
    let own = model.clone();
    let found = with_hooks(&mut progress, |hooks| {
        study_telling(own, options, hooks, &mut |decided| {
            listener.told("decided", &said(decided))
        })
    });
    match found {
        Ok(study) => Ok(Outcome::of_motion(study)),
        Err(problem) => {
            let said = chetaev::study::diagnostics(&problem, &model);
            Err(Refusal::Study(
                said.into_iter().map(|d| d.message).collect(),
            ))
        }
    }
}

/// What `chetaev steady`, `linearize`, `stability` or `follow` answers; `asked` is JSON with their options. The listener hears `part` (which part
/// is done).
///
/// # Errors
/// What is wrong, in words.
#[wasm_bindgen]
pub fn ask(
    path: &str,
    text: &str,
    question: &str,
    asked: &str,
    listener: &Listener,
) -> Result<Answer, Refusal> {
    let mut tell = |part: f64| listener.told("part", &format!("{part}"));
    let found = with_hooks(&mut |_, _| {}, |hooks| {
        interruptible(hooks, |_| {
            questions::answered((path, text), (question, asked), &mut tell)
        })
    });
    found.map_err(|_| Refusal::Stopped)?
}

/// A claim with its verdict as JSON.
fn said(decided: &Decided) -> String {
    json!({
        "id": decided.full_id(),
        "group": decided.group,
        "title": decided.title,
        "verdict": decided.finding.verdict.word(),
        "detail": decided.finding.verdict.detail(),
    })
    .to_string()
}

/// With the clock of the host.
fn with_hooks<T>(
    progress: &mut dyn FnMut(&str, Option<f64>),
    work: impl FnOnce(&mut Hooks<'_>) -> T,
) -> T {
    work(&mut Hooks {
        clock: &seconds,
        interrupt: None,
        progress,
    })
}
