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
        let all: Vec<&Decided> = all.collect();
        claims.extend(all.iter().map(|d| d.full_id()));
        sentences.extend(true_ones(&asked, &all));
        sentences.extend(all.iter().filter_map(|d| other(study, &asked, d)));
    }
    (!sentences.is_empty()).then_some(Found {
        subject: "stated",
        sentences,
        claims,
    })
}

/// What is true, and what is true on one condition, takes one line together.
fn true_ones(asked: &Asked, all: &[&Decided]) -> Vec<String> {
    let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
    for decided in all {
        let place = match &decided.finding.verdict {
            Verdict::Proved(_) => String::new(),
            Verdict::Conditional { .. } => format!(" where {}", condition(decided)),
            _ => continue,
        };
        let name = decided.subject.as_deref().unwrap_or_default();
        match groups.iter_mut().find(|group| group.0 == place) {
            Some(group) => group.1.push(name),
            None => groups.push((place, vec![name])),
        }
    }
    let words = |names: &[&str]| match names {
        [_] => asked.proved,
        _ => asked.all_proved,
    };
    let groups = groups.iter();
    let sentences =
        groups.map(|(place, names)| format!("{}: {}{place}", names.join(", "), words(names)));
    sentences.collect()
}

/// What is not true, with the reason; what is not decided is told with all else that is not.
fn other(study: &Study, asked: &Asked, decided: &Decided) -> Option<String> {
    let words = match &decided.finding.verdict {
        Verdict::Refuted(found) => {
            format!("{}: {}", asked.refuted, first(study, &found.detail))
        }
        Verdict::Numerical(_) => format!("{}, by numbers", asked.proved),
        Verdict::NotApplicable { detail, .. } => {
            format!("nothing to decide: {}", first(study, detail))
        }
        Verdict::Proved(_) | Verdict::Conditional { .. } | Verdict::Undecided { .. } => {
            return None
        }
    };
    Some(format!("{}: {words}", decided.subject.as_deref()?))
}
