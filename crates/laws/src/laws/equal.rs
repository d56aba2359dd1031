//! All formulations are the same equations, where their hypotheses hold; where one fails, it is named.

use super::hypotheses::{seen, Seen};
use super::{Expected, Kind, Sampled, Trial};
use chetaev_mechanics::card::{Card, Relation};
use chetaev_mechanics::claims::formulation::{derive, equivalence, REFERENCE};
use chetaev_mechanics::FORMULATIONS;
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::Verdict;
use std::collections::BTreeMap;
use std::time::Instant;

/// Pairs compared without the reference.
const PAIRS: usize = 2;

/// The verdict on every formulation and every identity.
pub(super) fn formulations(subject: &Sampled<'_>) -> Vec<Trial> {
    let mut known = BTreeMap::new();
    let mut trials = Vec::new();
    for formulation in FORMULATIONS {
        let card = formulation.card();
        if card.relation == Relation::Equivalent {
            trials.push(claimed(subject, card, Kind::Formulation, &mut known));
        }
        if card.relation != Relation::Coincidence && card.identity.is_some() {
            trials.push(claimed(subject, card, Kind::Identity, &mut known));
        }
    }
    trials
}

fn claimed(
    subject: &Sampled<'_>,
    card: &'static Card,
    kind: Kind,
    known: &mut BTreeMap<&'static str, Seen>,
) -> Trial {
    let (law, id) = match kind {
        Kind::Identity => ("its identity holds", "formulation.identity"),
        _ => (
            "its accelerations are those of Routh's equations",
            "formulation.equivalent",
        ),
    };
    let start = Instant::now();
    let verdict = subject
        .cx
        .finding(&format!("{id}#{}", card.name))
        .verdict
        .clone();
    let seconds = start.elapsed().as_secs_f64();
    for &id in card.requires {
        known.entry(id).or_insert_with(|| seen(subject, id));
    }
    let fails = |id: &str| known.get(id) == Some(&Seen::Fails);
    let failing = card.requires.iter().find(|id| fails(id));
    let unclear = card
        .requires
        .iter()
        .find(|id| known.get(*id) == Some(&Seen::Unclear));
    let (expected, about) = match (failing, unclear, &verdict) {
        (Some(id), ..) => (
            Expected::NotApplicable,
            format!("`{id}` fails at sampled states"),
        ),
        // What double precision cannot tell is left to the claim.
        (None, Some(id), Verdict::NotApplicable { .. }) => (
            Expected::NotApplicable,
            format!("`{id}` cannot be told from samples"),
        ),
        _ => (Expected::Proved, String::new()),
    };
    let verdict = match verdict {
        Verdict::NotApplicable { hypothesis, detail }
            if known.get(&*hypothesis) == Some(&Seen::Holds) =>
        {
            Verdict::undecided(format!(
                "`{hypothesis}` holds at sampled states, but: {detail}"
            ))
        }
        other => other,
    };
    Trial {
        kind,
        law,
        formulation: card.name,
        about,
        expected,
        verdict,
        seconds,
    }
}

/// Pairs of formulations, compared with each other.
pub(super) fn pairs(subject: &Sampled<'_>) -> Vec<Trial> {
    let applicable: Vec<&'static str> = FORMULATIONS
        .iter()
        .map(|f| f.card())
        .filter(|card| card.relation == Relation::Equivalent && card.name != REFERENCE)
        .map(|card| card.name)
        .filter(|name| {
            let found = subject
                .cx
                .finding(&format!("formulation.equivalent#{name}"));
            matches!(found.verdict, Verdict::Proved(_))
        })
        .collect();
    let mut random = Random::stream(subject.seed, 0x9a1f);
    let mut pick = || {
        applicable
            .get(random.below(applicable.len().max(1) as u64) as usize)
            .copied()
    };
    let chosen = (0..PAIRS)
        .filter_map(|_| Some((pick()?, pick()?)))
        .filter(|(a, b)| a != b);
    let chosen: Vec<_> = chosen.collect();
    chosen
        .into_iter()
        .map(|(a, b)| pair(subject, a, b))
        .collect()
}

fn pair(subject: &Sampled<'_>, a: &'static str, b: &'static str) -> Trial {
    let start = Instant::now();
    let derived = derive(subject.cx, a).and_then(|x| Ok((x, derive(subject.cx, b)?)));
    let verdict = match derived {
        Ok((x, y)) => equivalence(subject.cx, &x, &y),
        Err(problem) => Verdict::undecided(problem.to_string()),
    };
    Trial {
        kind: Kind::Pair,
        law: "two formulations have the same accelerations",
        formulation: a,
        about: format!("{a} and {b}"),
        expected: Expected::Proved,
        verdict,
        seconds: start.elapsed().as_secs_f64(),
    }
}
