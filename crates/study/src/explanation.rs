//! What a claim or a formulation states and how it is decided, in words and as data: `chetaev explain`.

use crate::registry::registry;
use chetaev_functionals::claims::{Claim as FunctionalClaim, CLAIMS};
use chetaev_mechanics::card::{Card, Relation};
use chetaev_mechanics::{formulation, Claim, Group, FORMULATIONS};
use chetaev_symbolic::syntax::names;
use serde_json::{json, Value};

/// A name that nothing has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Unexplained {
    /// There is no such claim.
    #[error("there is no claim `{id}`{near}")]
    Unknown {
        /// As asked for.
        id: String,
        /// What may have been meant.
        near: String,
    },
    /// The claim is not about that formulation.
    #[error("`{claim}` has no subject `{subject}`{near}")]
    Subject {
        /// The claim.
        claim: &'static str,
        /// As asked for.
        subject: String,
        /// What may have been meant.
        near: String,
    },
}

/// What can be explained.
enum Known {
    Of(&'static dyn Claim),
    OfFunctionals(&'static dyn FunctionalClaim),
    Formulation(&'static Card),
}

/// What a name stands for: a claim, with a subject after `#` or without, or a formulation.
fn known(wanted: &str) -> Result<Known, Unexplained> {
    let id = wanted.split('#').next().unwrap_or(wanted);
    let registry = registry();
    if let Some(claim) = registry.find(id) {
        return match unknown_subject(claim, wanted) {
            Some(problem) => Err(problem),
            None => Ok(Known::Of(claim)),
        };
    }
    let of_functionals = CLAIMS.iter().find(|c| c.id() == id);
    let found = of_functionals.map(|own| Known::OfFunctionals(*own));
    let found = found.or_else(|| Some(Known::Formulation(formulation(id)?.card())));
    found.ok_or_else(|| Unexplained::Unknown {
        id: id.to_owned(),
        near: did_you_mean(id, registry.claims()),
    })
}

/// The explanation of a claim or a formulation in words; the list of all claims without a name.
///
/// # Errors
/// [`Unexplained`].
pub fn text(wanted: Option<&str>) -> Result<String, Unexplained> {
    let Some(wanted) = wanted else {
        return Ok(format!(
            "{}{}",
            list(registry().claims()),
            functional_list()
        ));
    };
    Ok(match known(wanted)? {
        Known::Of(claim) => explained(claim, wanted),
        Known::OfFunctionals(own) => format!(
            "{}\n{}\n\n{}\n",
            own.id(),
            own.title(),
            wrapped(own.explanation())
        ),
        Known::Formulation(card) => format!("{}\n\n{}\n", card.name, described(card)),
    })
}

/// The same as data: id, title, group, explanation and requirements; a list of all claims without a name. A formulation has
/// its statement as explanation.
///
/// # Errors
/// [`Unexplained`].
pub fn data(wanted: Option<&str>) -> Result<Value, Unexplained> {
    let Some(wanted) = wanted else {
        let registry = registry();
        let own = registry.claims().iter().map(|c| as_json(*c, c.id()));
        let all: Vec<Value> = own
            .chain(CLAIMS.iter().map(|c| functional_as_json(*c)))
            .collect();
        return Ok(json!(all));
    };
    Ok(match known(wanted)? {
        Known::Of(claim) => as_json(claim, wanted),
        Known::OfFunctionals(own) => functional_as_json(own),
        Known::Formulation(card) => json!({
            "id": card.name,
            "title": card.title,
            "group": "formulation",
            "explanation": card.statement,
            "requires": card.requires,
        }),
    })
}

/// A formulation that does not exist after `#`.
fn unknown_subject(claim: &'static dyn Claim, wanted: &str) -> Option<Unexplained> {
    let (_, subject) = wanted.split_once('#')?;
    let known = formulation_subjects(claim);
    if known.is_empty() || known.contains(&subject) {
        return None;
    }
    let near = names::closest(subject, known.iter().copied());
    Some(Unexplained::Subject {
        claim: claim.id(),
        subject: subject.to_owned(),
        near: match (formulation(subject), near) {
            (Some(_), _) => format!("; `chetaev explain {subject}` prints its card"),
            (None, Some(near)) => format!("; did you mean `{near}`?"),
            (None, None) => String::new(),
        },
    })
}

fn as_json(claim: &'static dyn Claim, wanted: &str) -> Value {
    json!({
        "id": claim.id(),
        "title": claim.title(),
        "group": claim.group().word(),
        "explanation": claim.explanation(),
        "requires": requirements(claim, wanted),
    })
}

fn functional_as_json(claim: &dyn FunctionalClaim) -> Value {
    json!({
        "id": claim.id(),
        "title": claim.title(),
        "group": "functional",
        "explanation": claim.explanation(),
        "requires": [],
    })
}

/// The claims about functionals of fields over space.
fn functional_list() -> String {
    let width = CLAIMS.iter().map(|c| c.id().len()).max().unwrap_or(0);
    let lines: Vec<String> = CLAIMS
        .iter()
        .map(|c| format!("  {:<width$} {}\n", c.id(), c.title()))
        .collect();
    format!("functional\n{}", lines.concat())
}

fn list(claims: &[&'static dyn Claim]) -> String {
    let mut text = String::new();
    for group in Group::ALL {
        let of_group: Vec<_> = claims.iter().filter(|c| c.group() == group).collect();
        if of_group.is_empty() {
            continue;
        }
        text.push_str(&format!("{}\n", group.word()));
        let width = of_group.iter().map(|c| c.id().len()).max().unwrap_or(0);
        for claim in of_group {
            text.push_str(&format!("  {:<width$} {}\n", claim.id(), claim.title()));
        }
    }
    text
}

fn explained(claim: &'static dyn Claim, wanted: &str) -> String {
    let mut text = format!(
        "{}\n{}\n\n{}\n",
        claim.id(),
        claim.title_of(wanted.split_once('#').map(|(_, subject)| subject)),
        wrapped(claim.explanation())
    );
    if let Some(card) = card(wanted) {
        text.push_str(&format!("\n{}\n", described(card)));
    }
    let requires = requirements(claim, wanted);
    if !requires.is_empty() {
        text.push_str(&format!("\nRequires: {}\n", requires.join(", ")));
    }
    let subjects = formulation_subjects(claim);
    if !subjects.is_empty() && !wanted.contains('#') {
        text.push_str(&format!(
            "\n{}\n",
            wrapped(&format!("Subjects: {}.", subjects.join(", ")))
        ));
    }
    text
}

/// The card of the formulation after `#`.
fn card(wanted: &str) -> Option<&'static Card> {
    let (_, subject) = wanted.split_once('#')?;
    Some(formulation(subject)?.card())
}

/// What a formulation is and where it comes from.
fn described(card: &Card) -> String {
    let sources: Vec<String> = card
        .sources
        .iter()
        .map(|s| format!("{} {}", s.key, s.place).trim_end().to_string())
        .collect();
    let mut text = format!("{}\n{}\n", card.title, wrapped(card.statement));
    if let Some(identity) = card.identity {
        text.push_str(&wrapped(&format!("Identity: {identity}.")));
        text.push('\n');
    }
    text.push_str(&wrapped(&format!("Principle: {}.", card.principle.words())));
    text.push('\n');
    text.push_str(&wrapped(&format!("Unknowns: {}.", card.unknowns)));
    text.push_str(&format!("\nSources: {}", sources.join("; ")));
    text
}

/// The formulations that the claim is about.
fn formulation_subjects(claim: &'static dyn Claim) -> Vec<&'static str> {
    let cards = FORMULATIONS.iter().map(|f| f.card());
    match claim.id() {
        "formulation.equivalent" => cards
            .filter(|card| card.relation == Relation::Equivalent)
            .map(|card| card.name)
            .collect(),
        "formulation.identity" => cards
            .filter(|card| card.identity.is_some())
            .map(|card| card.name)
            .collect(),
        _ => Vec::new(),
    }
}

/// The hypotheses of a claim, for the subject after `#` or the usual one.
fn requirements(claim: &'static dyn Claim, wanted: &str) -> Vec<String> {
    let subject = wanted
        .split_once('#')
        .map(|(_, s)| s)
        .or(Some("maggi").filter(|_| claim.id() == "formulation.equivalent"));
    claim.requires(subject)
}

/// Lines of at most 88 characters.
fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].chars().count() + word.chars().count() >= 88 {
            lines.push(word.to_string());
        } else {
            if !lines[last].is_empty() {
                lines[last].push(' ');
            }
            lines[last].push_str(word);
        }
    }
    lines.join("\n")
}

/// "; did you mean …?" for a claim that does not exist: the nearest by spelling, else those with the same last word.
pub fn did_you_mean(id: &str, claims: &[&'static dyn Claim]) -> String {
    nearest(
        id,
        claims
            .iter()
            .map(|c| c.id())
            .chain(CLAIMS.iter().map(|c| c.id())),
    )
}

/// The same among given ids.
pub fn nearest(id: &str, ids: impl Iterator<Item = &'static str> + Clone) -> String {
    let ids = || ids.clone();
    let last = |id: &'static str| id.rsplit('.').next().unwrap_or(id);
    let tail = id.rsplit('.').next().unwrap_or(id);
    let close: Vec<&str> = match names::closest(id, ids()) {
        Some(near) => vec![near],
        None => {
            let near = names::closest(tail, ids().map(last));
            ids()
                .filter(|known| {
                    Some(last(known)) == near || (tail.len() > 3 && known.contains(tail))
                })
                .collect()
        }
    };
    if close.is_empty() {
        "; `chetaev explain` lists them".into()
    } else {
        format!("; did you mean {}?", close.join(" or "))
    }
}
