//! What the model states of itself, and whether it is so: the first thing that whoever stated it wants to know.

use super::{condition, first, Found};
use crate::study::{Decided, Study};
use chetaev_symbolic::Verdict;

/// A claim on something that the model states by a name, and what a name is of which it is proved.
struct Asked {
    claim: &'static str,
    proved: &'static str,
    refuted: &'static str,
}

const ASKED: [Asked; 4] = [
    Asked {
        claim: "equations.stated",
        proved: "the equations of motion",
        refuted: "not the equations of motion",
    },
    Asked {
        claim: "model.same-motion",
        proved: "the same motion",
        refuted: "not the same motion",
    },
    Asked {
        claim: "noether.inverse",
        proved: "a first integral",
        refuted: "no first integral",
    },
    Asked {
        claim: "noether.form",
        proved: "a form with a first integral",
        refuted: "a form without a first integral",
    },
];

/// Each equation, model, integral and form that the model states, with what it is.
pub(super) fn found(study: &Study) -> Option<Found> {
    let mut claims = Vec::new();
    let mut sentences = Vec::new();
    for asked in ASKED {
        let all = study.verdicts.iter();
        for decided in all.filter(|d| d.claim == asked.claim) {
            let Some(name) = decided.subject.as_deref() else {
                continue;
            };
            let Some(words) = words(study, &asked, decided) else {
                continue;
            };
            claims.push(decided.full_id());
            sentences.push(format!("{name}: {words}"));
        }
    }
    (!sentences.is_empty()).then_some(Found {
        subject: "stated",
        sentences,
        claims,
    })
}

/// What is not decided is told with all else that is not.
fn words(study: &Study, asked: &Asked, decided: &Decided) -> Option<String> {
    let Asked {
        proved, refuted, ..
    } = asked;
    Some(match &decided.finding.verdict {
        Verdict::Proved(_) => (*proved).to_owned(),
        Verdict::Conditional { .. } => format!("{proved} where {}", condition(decided)),
        Verdict::Refuted(found) => format!("{refuted}: {}", first(study, &found.detail)),
        Verdict::Numerical(_) => format!("{proved}, by numbers"),
        Verdict::NotApplicable { .. } => {
            format!(
                "nothing to decide: {}",
                first(study, decided.finding.verdict.detail())
            )
        }
        Verdict::Undecided { .. } => return None,
    })
}
