//! Replays the verdicts of a record from the embedded model (theory 6.6).

use crate::options::{ClaimSelection, Hooks, StudyOptions};
use crate::record::{self, Record, VerdictRecord};
use crate::study::{study, StudyError};
use chetaev_model::model::ModelText;

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

/// Replays every verdict of a record with other random choices and another parametrization.
///
/// # Errors
/// [`VerifyError`] when the record cannot be replayed at all; disagreements are in the result.
pub fn verify(record: &Record, hooks: &mut Hooks<'_>) -> Result<Vec<Verified>, VerifyError> {
    let text = ModelText {
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
    };
    let (model, _) = chetaev_model::reload(&text)
        .into_result()
        .map_err(|d| VerifyError::Model(d.render(chetaev_model::Style::Plain)))?;
    let recorded_seed = record.verdicts.iter().find_map(|v| v.seed).unwrap_or(0);
    let options = StudyOptions {
        claims: ClaimSelection {
            words: record.options.claims.clone(),
        },
        budget: record.options.budget.unwrap_or(60.0).max(60.0) * 2.0,
        t_end: record.options.t_end,
        tolerance: record.options.tolerance,
        method: record.options.method.clone(),
        formulation: record.options.formulation.clone(),
        project: record.options.project,
        seed: Some(recorded_seed ^ 0x5eed_0fa0_7e57_ab1e),
        replay: true,
        motion: record.trajectory.is_some(),
        ..StudyOptions::default()
    };
    let again = study(model, options, hooks)?;
    let replayed = record::record(&again, &[]);
    let mut lines: Vec<Verified> = record
        .verdicts
        .iter()
        .map(|v| compare(v, &replayed))
        .collect();
    lines.extend(missing(record, &replayed));
    lines.extend(trajectory(record, &replayed));
    Ok(lines)
}

fn full(verdict: &VerdictRecord) -> String {
    chetaev_mechanics::claims::full_id(&verdict.claim, verdict.subject.as_deref())
}

fn compare(recorded: &VerdictRecord, replayed: &Record) -> Verified {
    let claim = full(recorded);
    let found = replayed.verdicts.iter().find(|v| full(v) == claim);
    let replay = match found {
        None => Replay::Differs {
            found: "no such claim".into(),
            detail: "the embedded model has no claim of this id".into(),
        },
        Some(v) if v.verdict == recorded.verdict => numbers(recorded, v),
        Some(v) if v.verdict == "undecided" => Replay::Open {
            tried: v.detail.clone(),
        },
        Some(v) => Replay::Differs {
            found: v.verdict.clone(),
            detail: v.detail.clone(),
        },
    };
    Verified {
        claim,
        recorded: recorded.verdict.clone(),
        replay,
    }
}

/// A residual far below what the replay finds was not measured.
fn numbers(recorded: &VerdictRecord, found: &VerdictRecord) -> Replay {
    match (recorded.residual, found.residual) {
        (Some(a), Some(b)) if (a - b).abs() > 1e-9 + 0.5 * a.abs().max(b.abs()) => {
            Replay::Numbers {
                what: format!("residual {a:e} recorded, {b:e} found"),
            }
        }
        (None, Some(b)) => Replay::Numbers {
            what: format!("no residual recorded, {b:e} found"),
        },
        _ => Replay::Confirmed,
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

/// The final state again, to the accuracy of the run.
fn trajectory(record: &Record, replayed: &Record) -> Vec<Verified> {
    let (Some(a), Some(b)) = (&record.trajectory, &replayed.trajectory) else {
        return Vec::new();
    };
    let tolerance = (1e4 * a.tolerance).max(1e-9);
    let worst = a
        .last
        .iter()
        .zip(&b.last)
        .filter_map(|(x, y)| Some((x.value? - y.value?).abs() / (1.0 + x.value?.abs())))
        .fold(0.0, f64::max);
    let same = a.last.len() == b.last.len() && a.finished == b.finished && worst <= tolerance;
    vec![Verified {
        claim: "trajectory".into(),
        recorded: if a.finished {
            "finished".into()
        } else {
            "stopped".into()
        },
        replay: if same {
            Replay::Confirmed
        } else {
            Replay::Numbers {
                what: format!("the final states differ by {worst:e}"),
            }
        },
    }]
}

/// Whether every line is confirmed or open.
pub fn agrees(lines: &[Verified]) -> bool {
    lines
        .iter()
        .all(|l| matches!(l.replay, Replay::Confirmed | Replay::Open { .. }))
}
