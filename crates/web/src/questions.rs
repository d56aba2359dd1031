//! Questions on steady motions: what `chetaev steady`, `linearize`, `stability` and `follow` answer, with their words, data and pictures.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use crate::reading;
use crate::refusal::Refusal;
use chetaev::model::model::Model;
use chetaev::model::{Diagnostics, Sources};
use chetaev::study::follow::{self, follow, FollowError};
use chetaev::study::placed;
use chetaev::study::stability::map::{Asked as Map, Course};
use chetaev::study::stability::{self, stability, StabilityError};
use chetaev::study::steady::steady;
use serde::Deserialize;
use serde_json::{json, Value};
use wasm_bindgen::prelude::*;

/// What is asked; what is left out is as in the command.
#[derive(Deserialize, Default)]
#[serde(default, deny_unknown_fields)]
struct Asked {
    about: Option<String>,
    over: Option<String>,
    at: Option<String>,
    symbolic: bool,
    orbit: bool,
    period: Option<String>,
    side: Option<usize>,
}

/// How it is answered; what is called hears which part is done.
type Answering = fn(&Model, &Asked, &mut dyn FnMut(f64)) -> Result<Answer, FollowError>;

/// A command whose answer is an [`Answer`].
struct Question {
    /// Its name.
    name: &'static str,
    title: &'static str,
    /// What it gives, and what it takes.
    gives: &'static str,
    /// The fields of [`Asked`] that it heeds.
    fields: &'static [&'static str],
    answer: Answering,
}

/// All of them, in the order of a menu.
const QUESTIONS: [Question; 4] = [
    Question {
        name: "steady",
        title: "Steady motions",
        gives: "All motions along which everything that matters is constant: exactly where the equations can be solved, else those near starts, in numbers.",
        fields: &["symbolic"],
        answer: of_steady,
    },
    Question {
        name: "linearize",
        title: "Linear equations",
        gives: "The exact linear equations about a motion: matrices, characteristic polynomial, eigenvalues and modes.",
        fields: &["about", "at", "symbolic"],
        answer: of_linearize,
    },
    Question {
        name: "stability",
        title: "Stability",
        gives: "Eigenvalues over a parameter, with the values where stability changes enclosed; over two parameters a map in numbers. A map of 100 steps takes seconds to a minute here; the command line has native code and all processors.",
        fields: &["about", "over", "side", "at"],
        answer: of_stability,
    },
    Question {
        name: "follow",
        title: "Follow in a parameter",
        gives: "Steady motions or periodic orbits over a parameter, in numbers, with folds, branch points and Hopf points. Periodic orbits take up to minutes here.",
        fields: &["about", "over", "orbit", "period"],
        answer: of_follow,
    },
];

/// Steps on a side of a map where none are asked for: one thread computes them.
const SIDE: usize = 100;

/// More are not computed in a browser.
const LARGEST: usize = 200;

/// The questions with their fields, as JSON.
pub(crate) fn vocabulary() -> Value {
    let row = |own: &Question| json!({"name": own.name, "title": own.title, "gives": own.gives, "fields": own.fields});
    QUESTIONS.iter().map(row).collect()
}

/// What was asked, answered.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Answer {
    text: String,
    picture: Option<String>,
    motions: Option<Vec<String>>,
    /// Contents by the ends of their names.
    files: Vec<(&'static str, Vec<u8>)>,
}

impl Answer {
    fn new(text: String, data: &Value, picture: Option<String>) -> Answer {
        let pretty = serde_json::to_string_pretty(data).unwrap_or_default();
        let files = [("txt", text.clone()), ("json", pretty)];
        let drawn = picture.iter().map(|own| ("svg", own.clone()));
        let files = files.into_iter().chain(drawn);
        Answer {
            files: files.map(|(end, own)| (end, own.into_bytes())).collect(),
            text,
            picture,
            motions: None,
        }
    }
}

#[wasm_bindgen]
impl Answer {
    /// The words of the command.
    pub fn text(&self) -> String {
        self.text.clone()
    }

    /// The picture as an SVG document; empty where there is none.
    pub fn picture(&self) -> String {
        self.picture.clone().unwrap_or_default()
    }

    /// Names of the motions that can be asked about, as JSON; `null` where none were sought.
    pub fn motions(&self) -> String {
        json!(self.motions).to_string()
    }

    /// Ends of the names of the files that can be had, as JSON.
    pub fn endings(&self) -> String {
        self.files
            .iter()
            .map(|own| own.0)
            .collect::<Value>()
            .to_string()
    }

    /// One of them.
    pub fn file(&self, at: usize) -> Vec<u8> {
        self.files
            .get(at)
            .map(|own| own.1.clone())
            .unwrap_or_default()
    }
}

/// Answers; `tell` hears which part is done.
///
/// # Errors
/// What is wrong, in words, at its place in the model where it is there.
pub(crate) fn answered(
    (path, text): (&str, &str),
    (name, asked): (&str, &str),
    tell: &mut dyn FnMut(f64),
) -> Result<Answer, Refusal> {
    let question = QUESTIONS.iter().find(|own| own.name == name);
    let question = question.ok_or(Refusal::Absent("such question"))?;
    let asked: Asked = serde_json::from_str(asked)?;
    let (model, sources) = reading::with_sources(path, text)?;
    (question.answer)(&model, &asked, tell).map_err(|problem| refusal(problem, &model, sources))
}

/// What is wrong with the model stands at its lines, as the commands say it.
fn refusal(problem: FollowError, model: &Model, sources: Sources) -> Refusal {
    match problem {
        FollowError::System(_) | FollowError::Which(StabilityError::System(_)) => {
            Refusal::Model(Diagnostics {
                sources,
                list: vec![placed(&problem.to_string(), model)],
            })
        }
        other => Refusal::Unanswered(in_page(&other.to_string())),
    }
}

/// What the commands say of their options, where a form has fields.
fn in_page(words: &str) -> String {
    let words = words.replace("--about ", "").replace("--at ", "");
    words.replace(
        "values of parameters of the model are set by --set",
        "parameters of the model have the values of its text",
    )
}

fn of_steady(model: &Model, asked: &Asked, _: &mut dyn FnMut(f64)) -> Result<Answer, FollowError> {
    let found = steady(model, asked.symbolic)?;
    let data = found.json();
    let all = data["motions"].as_array().into_iter().flatten();
    let known = all.filter(|own| own["closed_form"] == true);
    let names = known.filter_map(|own| Some(own["name"].as_str()?.to_owned()));
    Ok(Answer {
        motions: Some(names.collect()),
        ..Answer::new(found.text(), &data, None)
    })
}

fn of_linearize(
    model: &Model,
    asked: &Asked,
    _: &mut dyn FnMut(f64),
) -> Result<Answer, FollowError> {
    let found = stability(model, &asked.of_stability())?;
    let matrices = found.matrices();
    let mut answer = Answer::new(found.linear_text(), &found.json(), None);
    answer.files.push(("tex", found.latex().into_bytes()));
    answer
        .files
        .extend(matrices.to_npz().map(|own| ("npz", own)));
    answer.files.push(("mat", matrices.to_mat()));
    answer.files.push(("py", matrices.to_python().into_bytes()));
    Ok(answer)
}

fn of_stability(
    model: &Model,
    asked: &Asked,
    tell: &mut dyn FnMut(f64),
) -> Result<Answer, FollowError> {
    let wanted = asked.of_stability();
    if wanted.over.is_some_and(|text| text.contains(',')) {
        let side = asked.side.unwrap_or(SIDE).clamp(1, LARGEST);
        let threads = 1;
        let course = Course {
            side,
            threads,
            tell,
        };
        let found = Map::new(model, &wanted)?.map(course);
        return Ok(Answer::new(
            found.text(),
            &found.json(),
            Some(found.picture()),
        ));
    }
    let found = stability(model, &wanted)?;
    Ok(Answer::new(
        found.ranges_text(),
        &found.json(),
        found.picture(),
    ))
}

fn of_follow(model: &Model, asked: &Asked, _: &mut dyn FnMut(f64)) -> Result<Answer, FollowError> {
    let wanted = follow::Wanted {
        about: asked.about.as_deref(),
        over: asked.over.as_deref(),
        orbit: asked.orbit,
        period: asked.period.as_deref(),
        points: None,
        step: None,
    };
    let found = follow(model, &wanted)?;
    Ok(Answer::new(found.text(), &found.json(), found.picture()))
}

impl Asked {
    fn of_stability(&self) -> stability::Wanted<'_> {
        stability::Wanted {
            about: self.about.as_deref(),
            over: self.over.as_deref(),
            at: self.at.as_deref(),
            symbolic: self.symbolic,
            ..stability::Wanted::default()
        }
    }
}
