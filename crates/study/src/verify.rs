//! Replays the verdicts of a record from the embedded model (T6 §6.6).

mod files;
mod notices;
mod texts;
mod trajectory;

pub use files::files;

use crate::error::StudyError;
use crate::options::{ClaimSelection, Hooks, StudyOptions};
use crate::record::{self, Record, VerdictRecord};
use crate::stated_equations::{is_decided, EQUIVALENCE};
use crate::study::study;
use chetaev_model::model::{Model, ModelText};

/// What the replay says of one verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Replay {
    /// The same verdict again, by other random choices.
    Confirmed,
    /// Another verdict.
    Differs {
        /// The word found by the replay.
        found: String,
        /// Why.
        detail: String,
    },
    /// The replay could not decide within its budget.
    Open {
        /// What was tried.
        tried: String,
    },
    /// A statement about numbers that was tampered with or differs beyond its size.
    Numbers {
        /// What differs.
        what: String,
    },
    /// Not the same, but as another machine or another version may have it: neither agreement nor contradiction.
    Remark {
        /// What differs.
        what: String,
    },
}

/// One line of a verification.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verified {
    /// `id#subject`.
    pub claim: String,
    /// The recorded word.
    pub recorded: String,
    /// What the replay says.
    pub replay: Replay,
}

impl Replay {
    /// What it says in a word, and the details.
    pub fn words(&self) -> (&'static str, String) {
        match self {
            Replay::Confirmed => ("confirmed", String::new()),
            Replay::Open { tried } => ("open", tried.clone()),
            Replay::Differs { found, detail } => {
                ("DISAGREES", format!("replay finds {found}: {detail}"))
            }
            Replay::Numbers { what } => ("DISAGREES", what.clone()),
            Replay::Remark { what } => ("remark", what.clone()),
        }
    }
}

impl Verified {
    /// The line as data.
    pub fn to_json(&self) -> serde_json::Value {
        let (result, detail) = self.replay.words();
        serde_json::json!({"claim": self.claim, "recorded": self.recorded, "result": result, "detail": detail})
    }
}

/// Why a record cannot be replayed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// Not JSON of the expected shape.
    #[error("this is no study record: {0}")]
    Json(String),
    /// Another schema.
    #[error("the record has schema `{found}`, this program reads `{expected}`", expected = record::SCHEMA)]
    Schema {
        /// Found.
        found: String,
    },
    /// The embedded model has errors.
    #[error("the embedded model cannot be read:\n{0}")]
    Model(String),
    /// The study cannot be repeated.
    #[error(transparent)]
    Study(#[from] StudyError),
}

/// Reads a record.
///
/// # Errors
/// [`VerifyError`].
pub fn read(text: &str) -> Result<Record, VerifyError> {
    let value: serde_json::Value =
        serde_json::from_str(text).map_err(|e| VerifyError::Json(e.to_string()))?;
    let schema = value.get("schema").and_then(|s| s.as_str()).unwrap_or("");
    if schema != record::SCHEMA {
        return Err(VerifyError::Schema {
            found: schema.into(),
        });
    }
    serde_json::from_value(value).map_err(|e| VerifyError::Json(e.to_string()))
}

/// Replays every verdict of a record twice: by the same random choices, which must give the same evidence, and by others
/// with another parametrization, which must not contradict it. `budget` is the work allowed for each replay, in seconds of the budget of
/// a study: what a record asks for beyond it is left open.
///
/// # Errors
/// [`VerifyError`] when the record cannot be replayed at all; disagreements are in the result.
pub fn verify(
    record: &Record,
    budget: f64,
    hooks: &mut Hooks<'_>,
) -> Result<Vec<Verified>, VerifyError> {
    if record.functional.is_some() {
        return crate::functional::verify(record, &texts(record), budget, hooks);
    }
    // Variations along the motion have a seed of their own.
    let of_proofs = |v: &&VerdictRecord| !v.claim.starts_with("witness.");
    let recorded_seed = record
        .verdicts
        .iter()
        .filter(of_proofs)
        .find_map(|v| v.seed);
    let same = study(
        model(record)?,
        options(record, budget, recorded_seed, false),
        hooks,
    )?;
    let same = record::record(&same, &[]);
    let other_seed = recorded_seed.unwrap_or(0) ^ 0x5eed_0fa0_7e57_ab1e;
    let mut independent = options(record, budget, Some(other_seed), true);
    independent.motion = false;
    let other = study(model(record)?, independent, hooks)?;
    let other = record::record(&other, &[]);
    let mut lines: Vec<Verified> = record
        .verdicts
        .iter()
        .map(|v| compare(v, record, &same, &other))
        .map(|line| within_budget(line, record, budget))
        .collect();
    lines.extend(missing(record, &same));
    lines.extend(lowered(record, &same));
    lines.extend(trajectory::compare(record, &same));
    lines.extend(notices::compare(record, &same));
    Ok(lines)
}

/// Where the record asks for more work than the verifier allows, searches look at less here, and find less.
fn within_budget(line: Verified, record: &Record, budget: f64) -> Verified {
    let asked = record.options.budget.unwrap_or(60.0);
    match line.replay {
        Replay::Differs { found, .. } if asked > budget && found != line.recorded => Verified {
            replay: Replay::Open {
                tried: format!("the record asks for a budget of {asked} s, and {budget} s are allowed here; with less work the verdict is {found}"),
            },
            ..line
        },
        _ => line,
    }
}

/// What the record says of the lowered model and of the equations, and not the replay. A record of another version may have neither.
fn lowered(record: &Record, same: &Record) -> Vec<Verified> {
    if record.chetaev != same.chetaev {
        return Vec::new();
    }
    // A replay has more time, and may decide what the record leaves open.
    let open = |name: &str| {
        let mut decided = record
            .verdicts
            .iter()
            .filter(|v| v.claim == EQUIVALENCE && is_decided(&v.verdict));
        !decided.any(|v| v.subject.as_deref() == Some(name))
    };
    let asked = same.equations.iter().filter(|e| !open(&e.formulation));
    let parts = [
        ("model.flat", record.model.flat != same.model.flat),
        ("equations", !record.equations.iter().eq(asked)),
    ];
    let changed = parts.into_iter().filter(|(_, changed)| *changed);
    changed
        .map(|(name, _)| Verified {
            claim: name.into(),
            recorded: "as stated".into(),
            replay: Replay::Numbers {
                what: format!("`{name}` is not what the replay finds"),
            },
        })
        .collect()
}

/// The texts in a record.
fn texts(record: &Record) -> ModelText {
    ModelText {
        path: record.model.path.clone(),
        text: record.model.text.clone(),
        includes: record
            .model
            .includes
            .iter()
            .map(|f| (f.path.clone(), f.text.clone()))
            .collect(),
        overrides: record
            .model
            .overrides
            .iter()
            .map(|o| (o.name.clone(), o.value.clone()))
            .collect(),
    }
}

fn model(record: &Record) -> Result<Model, VerifyError> {
    let text = texts(record);
    let (model, _) = chetaev_model::reload(&text)
        .into_result()
        .map_err(|d| VerifyError::Model(d.render(chetaev_model::Style::Plain)))?;
    Ok(model)
}

fn options(record: &Record, budget: f64, seed: Option<u64>, replay: bool) -> StudyOptions {
    let asked = &record.options;
    // Twice the work, since other claims may have done parts of it before; never more than the verifier allows.
    let asked_budget = asked.budget.unwrap_or(60.0);
    let own = (asked_budget.max(60.0) * 2.0).min(budget);
    let interrupted = record.trajectory.as_ref().filter(|t| t.is_interrupted());
    StudyOptions {
        claims: ClaimSelection {
            words: asked.claims.clone(),
        },
        budget: own,
        searches_for: Some(asked_budget.min(budget)),
        t_end: interrupted.map(|t| t.t).or(asked.t_end),
        tolerance: asked.tolerance,
        step: asked.step,
        method: asked.method.clone(),
        precision: asked.precision(),
        formulation: asked.formulation.clone(),
        project: asked.project,
        keep_integrals: asked.keep_integrals,
        branch: asked.branch,
        seed,
        replay,
        motion: record.trajectory.is_some(),
        ..StudyOptions::default()
    }
}

fn full(verdict: &VerdictRecord) -> String {
    chetaev_mechanics::claims::full_id(&verdict.claim, verdict.subject.as_deref())
}

fn find<'r>(record: &'r Record, claim: &str) -> Option<&'r VerdictRecord> {
    record.verdicts.iter().find(|v| full(v) == claim)
}

fn compare(recorded: &VerdictRecord, record: &Record, same: &Record, other: &Record) -> Verified {
    let claim = full(recorded);
    let times = record.verdicts.iter().filter(|v| full(v) == claim).count();
    let replay = match find(same, &claim) {
        None => differs(
            "no such claim",
            "the embedded model has no claim of this id",
        ),
        Some(_) if times > 1 => {
            differs("one verdict", "the record states this claim more than once")
        }
        // How far a study came in its time is a matter of the machine.
        Some(v) if v.verdict != recorded.verdict && recorded.is_stopped() => Replay::Remark {
            what: format!(
                "undecided in the record ({}); the replay finds {}",
                recorded.detail, v.verdict
            ),
        },
        Some(v) if v.verdict != recorded.verdict && v.verdict == "undecided" => Replay::Open {
            tried: v.detail.clone(),
        },
        Some(v) if v.verdict != recorded.verdict => differs(&v.verdict, &v.detail),
        Some(v) => match (
            evidence(recorded, v, record.chetaev == same.chetaev),
            find(other, &claim),
        ) {
            (Some(what), _) => Replay::Numbers { what },
            (None, Some(w)) if contradicts(&recorded.verdict, &w.verdict) => {
                differs(&w.verdict, &w.detail)
            }
            _ => Replay::Confirmed,
        },
    };
    Verified {
        claim,
        recorded: recorded.verdict.clone(),
        replay,
    }
}

fn differs(found: &str, detail: &str) -> Replay {
    Replay::Differs {
        found: found.into(),
        detail: detail.into(),
    }
}

/// Whether two verdicts cannot both be right. A weaker one does not contradict: other random choices may decide less.
fn contradicts(recorded: &str, found: &str) -> bool {
    let known = |word: &str| matches!(word, "proved" | "refuted" | "conditional");
    let open = |word: &str| matches!(word, "numerical" | "undecided" | "not-applicable");
    recorded != found
        && known(found)
        && !(open(recorded) && recorded != "numerical")
        && !(recorded == "numerical" && found == "proved")
}

/// What of the evidence is not what the same choices give again. Texts are compared for the version that wrote them.
fn evidence(recorded: &VerdictRecord, found: &VerdictRecord, same_version: bool) -> Option<String> {
    if let Some(what) = numbers(recorded.residual, found.residual) {
        return Some(format!("residual {what}"));
    }
    let fields = [
        ("method", recorded.method != found.method),
        ("on", recorded.on != found.on),
        ("error_bound", recorded.error_bound != found.error_bound),
        ("samples", recorded.samples != found.samples),
        ("seed", recorded.seed != found.seed),
        ("condition", recorded.condition != found.condition),
        ("formulas", recorded.formulas != found.formulas),
        ("expected", recorded.expected != found.expected),
        // Measured numbers stand in the sentence of a numerical verdict.
        (
            "detail",
            recorded.residual.is_none()
                && !is_measured(recorded)
                && recorded.detail != found.detail,
        ),
        (
            "counterexample",
            if is_measured(recorded) {
                recorded.counterexample.is_some() != found.counterexample.is_some()
            } else {
                recorded.counterexample != found.counterexample
            },
        ),
    ];
    let (name, _) = fields
        .iter()
        .find(|(_, changed)| *changed && same_version)?;
    Some(format!("`{name}` is not what the replay finds"))
}

/// Verdicts on a motion are about floating-point numbers, which may differ in their last digits between machines.
fn is_measured(verdict: &VerdictRecord) -> bool {
    verdict.claim.starts_with("motion.")
}

/// Two measured numbers agree within a factor of ten, or are both rounding.
fn numbers(recorded: Option<f64>, found: Option<f64>) -> Option<String> {
    match (recorded, found) {
        (None, None) => None,
        (Some(a), Some(b)) => {
            let (a, b) = (a.abs(), b.abs());
            let agree = a.max(b) <= 1e-14 || (a <= 10.0 * b && b <= 10.0 * a);
            (!agree).then(|| format!("{a:e} recorded, {b:e} found"))
        }
        (a, b) => {
            let word = |x: Option<f64>| x.map_or("none".to_owned(), |x| format!("{x:e}"));
            Some(format!("{} recorded, {} found", word(a), word(b)))
        }
    }
}

/// Verdicts that the record leaves out.
fn missing(record: &Record, replayed: &Record) -> Vec<Verified> {
    replayed
        .verdicts
        .iter()
        .filter(|v| !record.verdicts.iter().any(|w| full(w) == full(v)))
        .map(|v| Verified {
            claim: full(v),
            recorded: "nothing".into(),
            replay: Replay::Differs {
                found: v.verdict.clone(),
                detail: "the record leaves this claim out".into(),
            },
        })
        .collect()
}

/// Whether no line disagrees: each is confirmed, open or remarked on.
pub fn agrees(lines: &[Verified]) -> bool {
    lines
        .iter()
        .all(|l| !matches!(l.replay, Replay::Differs { .. } | Replay::Numbers { .. }))
}
