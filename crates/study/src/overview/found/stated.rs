//! What the model states of itself, and whether it is so: the first thing that whoever stated it wants to know.

use super::{condition, first, Found};
use crate::study::{Decided, Study};
use chetaev_symbolic::Verdict;

/// A claim on something that the model states by a name, and what a name is of which it is proved, or several are.
struct Asked {
    claim: &'static str,
    proved: &'static str,
    all_proved: &'static str,
    refuted: &'static str,
}

const ASKED: [Asked; 4] = [
    Asked {
        claim: "equations.stated",
        proved: "the equations of motion",
        all_proved: "each the equations of motion",
        refuted: "not the equations of motion",
    },
    Asked {
        claim: "model.same-motion",
        proved: "the same motion",
        all_proved: "each the same motion",
        refuted: "not the same motion",
    },
    Asked {
        claim: "noether.inverse",
        proved: "a first integral",
        all_proved: "first integrals",
        refuted: "no first integral",
    },
    Asked {
        claim: "noether.form",
        proved: "a form with a first integral",
        all_proved: "forms with first integrals",
        refuted: "a form without a first integral",
    },
];

/// Each equation, model, integral and form that the model states, with what it is.
pub(super) fn found(study: &Study) -> Option<Found> {
    let mut claims = Vec::new();
    let mut sentences = Vec::new();
    for asked in ASKED {
        let all = study.verdicts.iter();
        let all = all.filter(|d| d.claim == asked.claim && d.subject.is_some());
        let (proved, others): (Vec<&Decided>, Vec<&Decided>) =
            all.partition(|d| matches!(d.finding.verdict, Verdict::Proved(_)));
        claims.extend(proved.iter().chain(&others).map(|d| d.full_id()));
        sentences.extend(together(&asked, &proved));
        sentences.extend(others.iter().filter_map(|d| alone(study, &asked, d)));
    }
    (!sentences.is_empty()).then_some(Found {
        subject: "stated",
        sentences,
        claims,
    })
}

/// What merely holds takes one line.
fn together(asked: &Asked, proved: &[&Decided]) -> Option<String> {
    let names: Vec<&str> = (proved.iter())
        .filter_map(|d| d.subject.as_deref())
        .collect();
    match names.len() {
        0 => None,
        1 => Some(format!("{}: {}", names[0], asked.proved)),
        _ => Some(format!("{}: {}", names.join(", "), asked.all_proved)),
    }
}

/// What does not hold, or not everywhere, with the reason; what is not decided is told with all else that is not.
fn alone(study: &Study, asked: &Asked, decided: &Decided) -> Option<String> {
    let words = match &decided.finding.verdict {
        Verdict::Conditional { .. } => format!("{} where {}", asked.proved, condition(decided)),
        Verdict::Refuted(found) => {
            format!("{}: {}", asked.refuted, first(study, &found.detail))
        }
        Verdict::Numerical(_) => format!("{}, by numbers", asked.proved),
        Verdict::NotApplicable { detail, .. } => {
            format!("nothing to decide: {}", first(study, detail))
        }
        Verdict::Proved(_) | Verdict::Undecided { .. } => return None,
    };
    Some(format!("{}: {words}", decided.subject.as_deref()?))
}
