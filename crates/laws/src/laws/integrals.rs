//! What a system is known to keep is found where it lies in a family that was searched, and nothing else is reported.
//!
//! Every integral reported is followed along a motion computed with forty digits from W, b, J, g as they are, without any of
//! the formulas that the search starts from.

use super::{precise, Expected, Kind, Sampled, Subject, Trial};
use chetaev_geometry::noether::family::Member;
use chetaev_geometry::noether::found::{found, Found};
use chetaev_geometry::noether::motion::{draw_with_points, Motion};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::Context;
use chetaev_symbolic::number::modular_matrix::null_space;
use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};
use std::time::Instant;

/// More points than unknowns.
const SURPLUS: usize = 8;

/// How many motions are followed.
const RUNS: usize = 2;

/// Tries what concerns the integrals that a system states.
///
/// # Errors
/// [`DeriveError`] where the accelerations could not be derived.
pub(crate) fn all(sampled: Sampled<'_>) -> Result<Vec<Trial>, DeriveError> {
    let subject = Subject::new(sampled)?;
    Ok(vec![
        conserved(&subject),
        exhausted(&subject),
        stated(&subject),
        spoilt(&subject),
    ])
}

fn trial(law: &'static str, expected: Expected, about: String, verdict: Verdict) -> Trial {
    Trial {
        kind: match expected {
            Expected::Refuted => Kind::Mutant,
            _ => Kind::Other,
        },
        formulation: "",
        law,
        about,
        expected,
        verdict,
        seconds: 0.0,
    }
}

fn conserved(subject: &Subject<'_>) -> Trial {
    let start = Instant::now();
    let (verdict, about) = match looked_at(subject) {
        Ok(about) => (Verdict::Proved(Proof::exact("", "")), about),
        Err(problem) => (Verdict::undecided(problem), String::new()),
    };
    let law = "known integrals are found, and no others but true ones";
    Trial {
        seconds: start.elapsed().as_secs_f64(),
        ..trial(law, Expected::Proved, about, verdict)
    }
}

/// The claim says in words which families were exhausted, how large each is, and what was found in each.
fn exhausted(subject: &Subject<'_>) -> Trial {
    let start = Instant::now();
    let found = found(subject.cx);
    let verdict = match found.as_ref() {
        Ok(found) => match said(found, &sentence(subject.cx)) {
            Ok(()) => Verdict::Proved(Proof::exact("", "")),
            Err(missing) => Verdict::undecided(missing),
        },
        Err(problem) => Verdict::undecided(problem.clone()),
    };
    let law = "the families that were exhausted are stated";
    Trial {
        seconds: start.elapsed().as_secs_f64(),
        ..trial(law, Expected::Proved, String::new(), verdict)
    }
}

/// What `noether.family` says, where it is proved.
fn sentence(cx: &Context<'_>) -> String {
    let finding = cx.finding("noether.family");
    match &finding.verdict {
        Verdict::Proved(proof) => proof.detail.clone(),
        other => format!("{}: {}", other.word(), other.detail()),
    }
}

/// Whether a sentence names each family with its size and the dimension found there.
fn said(found: &Found, sentence: &str) -> Result<(), String> {
    for searched in &found.families {
        let size = format!("({} functions", searched.family.members.len() - 1);
        let dimension = format!("dimension {}", searched.dimension);
        for part in ["exhausted", &searched.family.words, &size, &dimension] {
            if !sentence.contains(part) {
                return Err(format!("`{part}` is not said by: {sentence}"));
            }
        }
    }
    Ok(())
}

/// Whether X̄G = 0 for a function.
fn kept(subject: &Subject<'_>, value: Expr) -> Verdict {
    match Motion::of(subject.cx) {
        Ok(motion) => motion.is_integral(subject.cx, value),
        Err(problem) => Verdict::undecided(problem),
    }
}

fn known(subject: &Subject<'_>) -> Expr {
    let stated = subject.cx.system.integrals.first();
    stated.map_or(subject.cx.system.graph.zero(), |(_, value)| *value)
}

fn stated(subject: &Subject<'_>) -> Trial {
    let verdict = kept(subject, known(subject));
    trial(
        "known integrals are proved",
        Expected::Proved,
        String::new(),
        verdict,
    )
}

/// With the square of a coordinate the function is kept no more.
fn spoilt(subject: &Subject<'_>) -> Trial {
    let (system, g) = (subject.cx.system, &subject.cx.system.graph);
    let extra = g.powi(system.coordinates[0].q, 2);
    let verdict = kept(subject, g.add(&[known(subject), extra]));
    let about = format!("with {}", g.text(extra));
    trial(
        "another function is refuted",
        Expected::Refuted,
        about,
        verdict,
    )
}

/// Says of a known integral that a family contains it.
pub const CONTAINED: &str = "is in a family";

fn looked_at(subject: &Subject<'_>) -> Result<String, String> {
    let cx = subject.cx;
    let motion = Motion::of(cx)?;
    let found = found(cx);
    let found = found.as_ref().as_ref().map_err(Clone::clone)?;
    if found.open > 0 {
        return Err("an integral that was seen was not found".into());
    }
    let reported: Vec<Expr> = found.integrals.iter().map(|i| i.value).collect();
    let mut words = Vec::new();
    for (name, value) in &cx.system.integrals {
        let contained = is_contained(subject, &motion, found, *value)?;
        if contained && !is_function_of(subject, &motion, &reported, *value)? {
            return Err(format!("`{name}` is in a family and was not found"));
        }
        words.push(match contained {
            true => format!("`{name}` {CONTAINED}"),
            false => format!("`{name}` is in no family"),
        });
    }
    let stated = cx.system.integrals.iter().map(|(_, value)| *value);
    let all: Vec<Expr> = reported.iter().copied().chain(stated).collect();
    followed(subject, &all)?;
    words.push(format!("{} found", reported.len()));
    Ok(words.join(", "))
}

/// Whether a family contains the function: whether it is a combination of the members at points over a prime field.
fn is_contained(
    subject: &Subject<'_>,
    motion: &Motion<'_>,
    found: &Found,
    value: Expr,
) -> Result<bool, String> {
    for searched in &found.families {
        let family = &searched.family;
        let mut outputs: Vec<Expr> = family.letters.iter().map(|l| l.value).collect();
        outputs.push(value);
        let points = motion.points(&outputs)?;
        let none = "no points over a prime field";
        let mut random = Random::stream(subject.seed, 0x1a6);
        let draw = draw_with_points(&points, &mut random).ok_or(none)?;
        let field = &draw.field;
        let columns = family.members.len() + 1;
        let mut matrix = Vec::new();
        for _ in 0..columns + SURPLUS {
            let at = points.at(&draw, &mut random).ok_or(none)?;
            let member = |m: &Member| product(field, m, &at);
            let row: Option<Vec<Residue>> = family.members.iter().map(member).collect();
            matrix.extend(row.ok_or("a letter is zero")?);
            matrix.extend(at.last());
        }
        let space = null_space(field, columns, matrix);
        if space.vectors.iter().any(|(free, _)| *free == columns - 1) {
            return Ok(true);
        }
    }
    Ok(false)
}

fn product(field: &PrimeField, member: &Member, letters: &[Residue]) -> Option<Residue> {
    member.iter().try_fold(field.one(), |value, &(letter, e)| {
        let x = match e < 0 {
            true => field.inv(letters[letter])?,
            false => letters[letter],
        };
        let power = field.pow(x, u64::from(e.unsigned_abs()));
        Some(field.mul(value, power))
    })
}

/// Whether a function is one of those before it: the rank of the derivatives on the constraint manifold does not grow.
fn is_function_of(
    subject: &Subject<'_>,
    motion: &Motion<'_>,
    before: &[Expr],
    value: Expr,
) -> Result<bool, String> {
    let cx = subject.cx;
    let mut all = before.to_vec();
    all.push(value);
    let rank = cx
        .prover
        .rank(cx.system, &motion.gradients(&all), &motion.manifold);
    rank.map(|rank| rank.maximum <= before.len())
        .map_err(|problem| format!("the rank was not found: {}", problem.detail()))
}

/// Follows functions along the motions from some of the states.
fn followed(subject: &Subject<'_>, functions: &[Expr]) -> Result<(), String> {
    let mut runs = 0;
    for state in &subject.states {
        if runs < RUNS {
            runs += usize::from(precise::followed(subject.cx, state, functions)?);
        }
    }
    match runs {
        0 => Err("no motion could be computed".into()),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{generate, Family};
    use chetaev_mechanics::{Prepared, Prover, Registry};
    use chetaev_symbolic::rational::ratio;

    /// Looks at one of the systems that state an integral.
    fn look(seed: u64, ask: impl FnOnce(&Subject<'_>)) {
        let random = generate(Family::Symmetric, seed).unwrap();
        let prepared = Prepared::new(&random.system).unwrap();
        let registry = Registry::new(super::super::CLAIMS);
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let prover = Prover::default();
        let cx = Context::new(&random.system, terms, selection, &registry, prover);
        ask(&Subject::new(Sampled::new(&cx, seed).unwrap()).unwrap());
    }

    /// A function that changes in the fifteenth digit is no integral, although double precision would not tell.
    #[test]
    fn small_changes_along_a_motion_are_seen() {
        for seed in 0..3 {
            look(seed, |subject| {
                let g = &subject.cx.system.graph;
                let stated = known(subject);
                assert_eq!(followed(subject, &[stated]), Ok(()));
                let little = ratio(1, 1_000_000_000_000_000).unwrap();
                let wrong = g.scale(&little, subject.cx.system.coordinates[0].q);
                let problem = followed(subject, &[g.add(&[stated, wrong])]).unwrap_err();
                assert!(problem.contains("changes by"), "{problem}");
            });
        }
    }

    /// What no family was asked for is not said to be exhausted.
    #[test]
    fn a_sentence_without_its_families_is_found_wanting() {
        look(0, |subject| {
            let found = found(subject.cx);
            let found = found.as_ref().as_ref().unwrap();
            assert_eq!(said(found, &sentence(subject.cx)), Ok(()));
            assert!(said(found, "exhausted: nothing").is_err());
        });
    }
}
