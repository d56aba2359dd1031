//! `chetaev explain`.

use super::error;
use crate::arguments::Explain as Arguments;
use crate::{terminal, DONE, INPUT};
use chetaev::functionals::{self, claims::CLAIMS};
use chetaev::mechanics::card::{Card, Relation};
use chetaev::mechanics::{formulation, Claim, Group, FORMULATIONS};
use chetaev::study::registry;
use chetaev::symbolic::syntax::names;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let known = registry();
    let Some(wanted) = &arguments.claim else {
        terminal::out(&if arguments.json {
            let own = known.claims().iter().map(|c| as_json(*c, c.id()));
            let all: Vec<_> = own
                .chain(CLAIMS.iter().map(|c| functional_as_json(*c)))
                .collect();
            text_of(&serde_json::json!(all))
        } else {
            format!("{}{}", list(known.claims()), functional_list())
        });
        return DONE;
    };
    let id = wanted.split('#').next().unwrap_or(wanted);
    let claim = known.find(id);
    if let Some(problem) = claim.and_then(|claim| unknown_subject(claim, wanted)) {
        error(problem);
        return INPUT;
    }
    match claim {
        Some(claim) if arguments.json => {
            terminal::out(&text_of(&as_json(claim, wanted)));
            DONE
        }
        Some(claim) => {
            terminal::out(&explained(claim, wanted));
            DONE
        }
        None => {
            if let Some(own) = CLAIMS.iter().find(|c| c.id() == id) {
                terminal::out(&if arguments.json {
                    text_of(&functional_as_json(*own))
                } else {
                    format!(
                        "{}\n{}\n\n{}\n",
                        own.id(),
                        own.title(),
                        wrapped(own.explanation())
                    )
                });
                return DONE;
            }
            if let Some(named) = formulation(id) {
                terminal::out(&format!("{}\n\n{}\n", id, described(named.card())));
                return DONE;
            }
            error(format!(
                "there is no claim `{id}`{}",
                did_you_mean(id, known.claims())
            ));
            INPUT
        }
    }
}

/// A formulation that does not exist after `#`.
fn unknown_subject(claim: &'static dyn Claim, wanted: &str) -> Option<String> {
    let (_, subject) = wanted.split_once('#')?;
    let known = formulation_subjects(claim);
    if known.is_empty() || known.contains(&subject) {
        return None;
    }
    let near = names::closest(subject, known.iter().copied());
    Some(format!(
        "`{}` has no subject `{subject}`{}",
        claim.id(),
        match (formulation(subject), near) {
            (Some(_), _) => format!("; `chetaev explain {subject}` prints its card"),
            (None, Some(near)) => format!("; did you mean `{near}`?"),
            (None, None) => String::new(),
        }
    ))
}

fn text_of(data: &serde_json::Value) -> String {
    format!(
        "{}\n",
        serde_json::to_string_pretty(data).unwrap_or_default()
    )
}

fn as_json(claim: &'static dyn Claim, wanted: &str) -> serde_json::Value {
    serde_json::json!({
        "id": claim.id(),
        "title": claim.title(),
        "group": claim.group().word(),
        "explanation": claim.explanation(),
        "requires": requirements(claim, wanted),
    })
}

fn functional_as_json(claim: &dyn functionals::claims::Claim) -> serde_json::Value {
    serde_json::json!({
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
pub(crate) fn did_you_mean(id: &str, claims: &[&'static dyn Claim]) -> String {
    nearest(
        id,
        claims
            .iter()
            .map(|c| c.id())
            .chain(CLAIMS.iter().map(|c| c.id())),
    )
}

/// The same among given ids.
pub(crate) fn nearest(id: &str, ids: impl Iterator<Item = &'static str> + Clone) -> String {
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
