//! The record of a functional replayed from the texts in it.

use super::pace::studied;
use super::record::record;
use crate::options::Hooks;
use crate::record::{ConditionRecord, FunctionalRecord, Record, VerdictRecord};
use crate::verify::{Replay, Verified, VerifyError};
use chetaev_functionals::read::reload;
use chetaev_functionals::study::USUAL_BUDGET;
use chetaev_model::model::ModelText;
use chetaev_model::Style;

/// Studies the functional again, and compares every verdict, every equation and every condition. What the record asks for beyond `budget`
/// is left open.
///
/// # Errors
/// [`VerifyError::Model`] where the texts in the record have errors.
pub fn verify(
    recorded: &Record,
    text: &ModelText,
    budget: f64,
    hooks: &mut Hooks<'_>,
) -> Result<Vec<Verified>, VerifyError> {
    let loaded = reload(text);
    let Some(problem) = loaded.problem else {
        let said = loaded.diagnostics.render(Style::Plain);
        return Err(VerifyError::Model(said));
    };
    let words = &recorded.options.claims;
    let wants = |id: &str| {
        let is_asked = |w: &String| w == id || id.starts_with(&format!("{w}."));
        words.is_empty() || words.iter().any(is_asked)
    };
    let asked = recorded.options.budget.unwrap_or(USUAL_BUDGET);
    let study = studied(problem, &wants, asked.min(budget), hooks);
    let again = record(&study, words, &[]);
    let mut lines: Vec<Verified> = recorded
        .verdicts
        .iter()
        .map(|own| compared(own, &again.verdicts))
        .collect();
    for own in &again.verdicts {
        if find(own, &recorded.verdicts).is_none() {
            lines.push(line(
                &full_id(own),
                "absent",
                Replay::Differs {
                    found: own.verdict.clone(),
                    detail: "the record lacks this verdict".into(),
                },
            ));
        }
    }
    let (old, new) = (recorded.functional.as_ref(), again.functional.as_ref());
    lines.extend(equations(old, new));
    if recorded.model.flat != again.model.flat {
        let found = "another text".to_owned();
        let detail = "the lowered functional is not that of the texts".to_owned();
        let replay = Replay::Differs { found, detail };
        lines.push(line("functional: lowered text", "stated", replay));
    }
    Ok(lines)
}

fn full_id(own: &VerdictRecord) -> String {
    match &own.subject {
        Some(subject) => format!("{}#{subject}", own.claim),
        None => own.claim.clone(),
    }
}

fn find<'r>(wanted: &VerdictRecord, all: &'r [VerdictRecord]) -> Option<&'r VerdictRecord> {
    all.iter()
        .find(|own| own.claim == wanted.claim && own.subject == wanted.subject)
}

fn line(claim: &str, recorded: &str, replay: Replay) -> Verified {
    Verified {
        claim: claim.to_owned(),
        recorded: recorded.to_owned(),
        replay,
    }
}

fn compared(own: &VerdictRecord, all: &[VerdictRecord]) -> Verified {
    let replay = match find(own, all) {
        None => Replay::Differs {
            found: "nothing".into(),
            detail: "the functional has no such claim".into(),
        },
        Some(again) if again.verdict != own.verdict && own.is_stopped() => Replay::Remark {
            what: format!(
                "undecided in the record ({}); the replay finds {}",
                own.detail, again.verdict
            ),
        },
        Some(again) if again.verdict != own.verdict && again.verdict == "undecided" => {
            Replay::Open {
                tried: again.detail.clone(),
            }
        }
        Some(again) => match differing(own, again) {
            None => Replay::Confirmed,
            Some(what) => Replay::Differs {
                found: again.verdict.clone(),
                detail: format!("{what} of the replay: {}", again.detail),
            },
        },
    };
    line(&full_id(own), &own.verdict, replay)
}

/// What differs, beside the seconds.
fn differing(own: &VerdictRecord, again: &VerdictRecord) -> Option<&'static str> {
    let mut plain = again.clone();
    plain.seconds = own.seconds;
    if own.verdict != again.verdict {
        return Some("the verdict");
    }
    if own.detail != again.detail {
        return Some("the sentence");
    }
    if own.formulas != again.formulas {
        return Some("the formulas");
    }
    (*own != plain).then_some("the evidence")
}

fn equations(old: Option<&FunctionalRecord>, new: Option<&FunctionalRecord>) -> Vec<Verified> {
    let (Some(old), Some(new)) = (old, new) else {
        return vec![line(
            "functional",
            "absent",
            Replay::Differs {
                found: "a functional".into(),
                detail: "the record lacks it".into(),
            },
        )];
    };
    let outcome = |holds: bool, found: &str| {
        if holds {
            Replay::Confirmed
        } else {
            Replay::Differs {
                found: found.to_owned(),
                detail: "the record says otherwise".into(),
            }
        }
    };
    let told = |all: &[ConditionRecord]| format!("{} of them", all.len());
    let mut bare = (old.clone(), new.clone());
    for own in [&mut bare.0, &mut bare.1] {
        own.euler.clear();
        own.boundary.clear();
    }
    vec![
        line(
            "functional",
            &old.name,
            outcome(bare.0 == bare.1, &new.name),
        ),
        line(
            "functional: Euler equations",
            &told(&old.euler),
            outcome(old.euler == new.euler, &told(&new.euler)),
        ),
        line(
            "functional: conditions on the boundary",
            &told(&old.boundary),
            outcome(old.boundary == new.boundary, &told(&new.boundary)),
        ),
    ]
}
