//! `chetaev explain`.

use super::error;
use crate::arguments::Explain as Arguments;
use crate::{terminal, DONE, INPUT};
use chetaev::mechanics::{Claim, Group};
use chetaev::study::registry;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let known = registry();
    let Some(wanted) = &arguments.claim else {
        terminal::out(&list(known.claims()));
        return DONE;
    };
    let id = wanted.split('#').next().unwrap_or(wanted);
    match known.find(id) {
        Some(claim) => {
            terminal::out(&explained(claim, wanted));
            DONE
        }
        None => {
            error(format!(
                "there is no claim `{id}`{}",
                nearest(id, known.claims())
            ));
            INPUT
        }
    }
}

fn list(claims: &[&'static dyn Claim]) -> String {
    let mut text = String::new();
    for group in Group::ALL {
        let of_group: Vec<_> = claims.iter().filter(|c| c.group() == group).collect();
        if of_group.is_empty() {
            continue;
        }
        text.push_str(&format!("{}\n", group.word()));
        for claim in of_group {
            text.push_str(&format!("  {:<34} {}\n", claim.id(), claim.title()));
        }
    }
    text
}

fn explained(claim: &'static dyn Claim, wanted: &str) -> String {
    let mut text = format!(
        "{}\n{}\n\n{}\n",
        claim.id(),
        claim.title(),
        wrapped(claim.explanation())
    );
    let subject = wanted
        .split_once('#')
        .map(|(_, s)| s)
        .or(Some("maggi").filter(|_| claim.id() == "formulation.equivalent"));
    let requires = claim.requires(subject);
    if !requires.is_empty() {
        text.push_str(&format!("\nRequires: {}\n", requires.join(", ")));
    }
    text
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

fn nearest(id: &str, claims: &[&'static dyn Claim]) -> String {
    let tail = id.rsplit('.').next().unwrap_or(id);
    let close: Vec<&str> = claims
        .iter()
        .map(|c| c.id())
        .filter(|known| {
            known.contains(tail) || tail.len() > 3 && known.contains(&tail[..tail.len() - 1])
        })
        .collect();
    if close.is_empty() {
        "; `chetaev explain` lists them".into()
    } else {
        format!("; did you mean {}?", close.join(" or "))
    }
}
