//! What was found of a system, in sentences for a person, with the claims that say more.

mod integrals;
mod statements;
mod steady;

pub(crate) use steady::rounded;

use crate::plain;
use crate::study::{Decided, Study};
use chetaev_mechanics::constraint::{Constraint, ConstraintKind};
use chetaev_mechanics::words::counted;
use chetaev_symbolic::Verdict;

/// What was found about a subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// A word: `energy`, `measure`.
    pub subject: &'static str,
    /// Sentences without a subject, each for a line of its own.
    pub sentences: Vec<String>,
    /// Ids of the claims that say more.
    pub claims: Vec<String>,
}

impl Found {
    fn new(subject: &'static str, sentence: String, decided: &[&Decided]) -> Found {
        Found {
            subject,
            sentences: vec![sentence],
            claims: decided.iter().map(|d| d.full_id()).collect(),
        }
    }
}

/// All that was found, in the order of a lecture.
pub fn found(study: &Study) -> Vec<Found> {
    let mut all = Vec::new();
    all.extend(values(study));
    all.extend(statements::found(study));
    all.extend(constraints(study));
    all.extend(order(study));
    all.extend(energy(study));
    all.extend(integrals::found(study));
    all.extend(measure(study));
    all.extend(quadratures(study));
    all.extend(action(study));
    all.extend(multiplier(study));
    all.extend(steady::sets(study));
    all.extend(steady::found(study));
    all.extend(formulations(study));
    all.extend(undecided(study));
    all
}

/// The verdict on a claim, where it was decided.
fn verdict<'a>(study: &'a Study, claim: &str, subject: Option<&str>) -> Option<&'a Decided> {
    let mut all = study.verdicts.iter();
    all.find(|d| d.claim == claim && d.subject.as_deref() == subject)
}

/// Characters of a sentence, after which no further part of a detail is added.
const LONG: usize = 170;

/// A detail without what is said of every claim alike and without how it was computed, as far as two lines have room.
fn lead(study: &Study, detail: &str) -> String {
    let (told, _) = plain::told(detail);
    let is_general = |part: &str| part.ends_with("as the model states it");
    let mut parts = told.split("; ").filter(|part| !is_general(part));
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        if text.chars().count() + part.chars().count() + 2 > LONG {
            break;
        }
        text.push_str("; ");
        text.push_str(part);
    }
    plain::written(&study.system, &shortened(&text, 2 * LONG))
}

/// The first words of a text that has more characters than these.
fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let kept: String = text.chars().take(most).collect();
    let end = kept.rfind(' ').unwrap_or(kept.len());
    format!("{} …", &kept[..end])
}

/// The first part of a detail.
fn first(study: &Study, detail: &str) -> String {
    let all = lead(study, detail);
    match all.split_once("; ") {
        Some((first, _)) => first.to_owned(),
        None => all,
    }
}

/// Where a claim holds that holds somewhere.
fn condition(decided: &Decided) -> &str {
    match &decided.finding.verdict {
        Verdict::Conditional { condition, .. } => condition,
        _ => "",
    }
}

/// The parameters that the model states to be zero: claims are decided of the system without them, and its equations are printed with them.
fn values(study: &Study) -> Option<Found> {
    let g = &study.system.graph;
    let zeros = study.system.stated_zeros().into_iter();
    let zeros = zeros.filter(|&(_, value)| g.is_zero(value));
    let texts: Vec<String> = zeros
        .map(|(parameter, _)| format!("{} = 0", g.text(parameter)))
        .collect();
    let sentence = format!(
        "all that follows is said for {}, as the model states",
        texts.join(" and ")
    );
    (!texts.is_empty()).then(|| Found::new("parameters", sentence, &[]))
}

fn constraints(study: &Study) -> Option<Found> {
    let decided = verdict(study, "model.constraints-integrable", Some("weak"))?;
    if study.system.constraints.is_empty() {
        return None;
    }
    let growth = verdict(study, "distribution.growth", None);
    let reach = growth.filter(|d| matches!(d.finding.verdict.word(), "proved" | "refuted"));
    let reach = reach.map(|d| format!("; {}", first(study, d.finding.verdict.detail())));
    let sentence = match &decided.finding.verdict {
        Verdict::Refuted(_) => format!("nonholonomic{}", reach.unwrap_or_default()),
        Verdict::Proved(_) if study.system.constraints.iter().all(is_holonomic) => return None,
        Verdict::Proved(_) => "integrable: the system is holonomic".into(),
        Verdict::Conditional { .. } => {
            format!("nonholonomic, except where {}", condition(decided))
        }
        _ => return None,
    };
    let claims: Vec<&Decided> = Some(decided).into_iter().chain(growth).collect();
    Some(Found::new("constraints", sentence, &claims))
}

fn is_holonomic(constraint: &Constraint) -> bool {
    constraint.kind == ConstraintKind::Holonomic
}

/// What constraints on accelerations and higher derivatives leave to the motion.
fn order(study: &Study) -> Option<Found> {
    let decided = verdict(study, "order.determined", None)?;
    let Verdict::Proved(_) = &decided.finding.verdict else {
        return None;
    };
    let order = study.prepared.terms.order;
    let sentence = format!(
        "of order {order}: with the equations of motion they determine the derivatives of this order"
    );
    Some(Found::new("constraints", sentence, &[decided]))
}

fn energy(study: &Study) -> Option<Found> {
    let decided = verdict(study, "energy.integral", None)?;
    let sentence = match &decided.finding.verdict {
        Verdict::Proved(_) => "conserved".into(),
        Verdict::Conditional { .. } => format!("conserved only where {}", condition(decided)),
        Verdict::Refuted(found) => {
            let told = first(study, &found.detail);
            told.replace("the energy is not conserved", "not conserved")
        }
        _ => return None,
    };
    Some(Found::new("energy", sentence, &[decided]))
}

fn measure(study: &Study) -> Option<Found> {
    let decided = verdict(study, "measure.invariant", None)?;
    let sentence = match &decided.finding.verdict {
        Verdict::Proved(proof) => first(study, &proof.detail),
        Verdict::Conditional { .. } => {
            format!("an invariant measure where {}", condition(decided))
        }
        Verdict::Refuted(_) => "no smooth measure is invariant".into(),
        _ => return None,
    };
    Some(Found::new("measure", sentence, &[decided]))
}

fn quadratures(study: &Study) -> Option<Found> {
    let decided = verdict(study, "liouville.integrable", None)?;
    let sentence = match &decided.finding.verdict {
        Verdict::Proved(proof) => {
            format!("solved by quadratures: {}", first(study, &proof.detail))
        }
        Verdict::Conditional { .. } => {
            format!("solved by quadratures where {}", condition(decided))
        }
        Verdict::Undecided { tried } => {
            // What is missing for arbitrary values too is missing for those stated.
            let for_those_stated = tried.split("; for arbitrary values ").next();
            let parts = for_those_stated.unwrap_or_default().split("; ");
            let missing =
                parts.filter(|part| part.ends_with("missing") || part.contains("measure"));
            let missing: Vec<&str> = missing.collect();
            if missing.is_empty() {
                format!("not decided: {}", first(study, tried))
            } else {
                format!("not decided: {}", shortened(&missing.join("; "), LONG))
            }
        }
        _ => return None,
    };
    Some(Found::new("integration", sentence, &[decided]))
}

/// Where the action is stationary, which is a question where there are constraints.
fn action(study: &Study) -> Option<Found> {
    let decided = verdict(study, "hamilton.stationary", None)?;
    if study.system.constraints.is_empty() {
        return None;
    }
    let sentence = match &decided.finding.verdict {
        Verdict::Proved(_) => "stationary on every motion, among admissible curves".into(),
        Verdict::Conditional { condition, .. } => {
            format!(
                "stationary only on motions where {}",
                shortened(condition, LONG)
            )
        }
        Verdict::Refuted(found) => {
            let told = first(study, &found.detail);
            let (sentence, _) = told.split_once(": ").unwrap_or((&told, ""));
            sentence.to_owned()
        }
        _ => return None,
    };
    Some(Found::new("action", sentence, &[decided]))
}

/// Chaplygin's multiplier, where there is one.
fn multiplier(study: &Study) -> Option<Found> {
    let decided = verdict(study, "chaplygin.multiplier", None)?;
    if study.system.constraints.is_empty() {
        return None;
    }
    let Verdict::Proved(proof) = &decided.finding.verdict else {
        return None;
    };
    Some(Found::new(
        "other time",
        first(study, &proof.detail),
        &[decided],
    ))
}

/// How many forms of the equations are the same.
fn formulations(study: &Study) -> Option<Found> {
    let forms = study.verdicts.iter();
    let forms: Vec<&Decided> = forms
        .filter(|d| d.claim == "formulation.equivalent")
        .collect();
    let of = |word: &str| {
        let own = forms.iter().filter(|d| d.finding.verdict.word() == word);
        own.copied().collect::<Vec<&Decided>>()
    };
    let mut parts = Vec::new();
    let proved = of("proved").len();
    if proved > 0 {
        let words = counted(proved, "form", "forms");
        parts.push(format!("{words} of the equations of motion proved equal"));
    }
    for word in ["numerical", "conditional", "refuted", "undecided"] {
        let names: Vec<&str> = of(word)
            .iter()
            .filter_map(|d| d.subject.as_deref())
            .collect();
        if !names.is_empty() {
            parts.push(format!("{word}: {}", names.join(", ")));
        }
    }
    (!parts.is_empty()).then(|| Found {
        subject: "formulations",
        sentences: vec![parts.join("; ")],
        claims: vec!["formulation.equivalent".into()],
    })
}

/// Claims that were not decided are named, the first of them with their reasons.
const REASONS: usize = 3;

/// Characters of a reason.
const REASON: usize = 110;

/// Claims of which it is told elsewhere that they were not decided.
const TOLD: [&str; 2] = ["formulation.equivalent", "liouville.integrable"];

fn undecided(study: &Study) -> Option<Found> {
    let open = study.verdicts.iter();
    let open: Vec<&Decided> = open
        .filter(|d| matches!(d.finding.verdict, Verdict::Undecided { .. }))
        .filter(|d| !TOLD.contains(&d.claim))
        .collect();
    if open.is_empty() {
        return None;
    }
    let mut sentences: Vec<String> = open
        .iter()
        .take(REASONS)
        .map(|d| {
            let reason = first(study, d.finding.verdict.detail());
            format!("{}: {}", d.full_id(), shortened(&reason, REASON))
        })
        .collect();
    if open.len() > REASONS {
        let rest: Vec<String> = open[REASONS..].iter().map(|d| d.full_id()).collect();
        sentences.push(shortened(&format!("also {}", rest.join(", ")), LONG));
    }
    Some(Found {
        subject: "undecided",
        sentences,
        claims: open.iter().map(|d| d.full_id()).collect(),
    })
}
