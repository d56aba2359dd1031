//! The claims about first integrals (catalogue of claims, §6), one file each.

mod contraction;
mod controls;
mod domain;
mod embedded;
pub(super) mod family;
mod form;
mod integral;
mod inverse;
mod killing;
mod moving;
mod narrowed;
mod parts;
mod reduced;
mod states;
mod structure;
mod symmetry;
mod trivial;
mod values;

pub use contraction::Contraction;
pub use domain::corners_of_motions;
pub use embedded::EmbeddedField;
pub use family::{FamilySearched, ID as FAMILY};
pub use form::IntegralOfForm;
pub use integral::{symmetry_named, FirstIntegral};
pub use inverse::Inverse;
pub use killing::Killing;
pub use moving::{MovingAxis, MovingDirection};
pub use reduced::ReducedSymmetry;
pub use structure::Structure;

use super::embedded::Embedded;
use super::found::found;
use super::generator::Generator;
use super::search::Integral;
use crate::noether::letters::ENERGY;
use crate::noether::motion::Motion;
use crate::noether::shown::readable;
use crate::noether::written::in_quasi_velocities;
use chetaev_mechanics::claims::{full_id, Claim, Finding, Formula};
use chetaev_mechanics::Context;
use chetaev_symbolic::simplify::length;
use chetaev_symbolic::{Expr, Verdict};

/// What all claims about first integrals require.
fn requirements() -> Vec<String> {
    vec![
        "model.accelerations-unique".into(),
        "model.frame-regular".into(),
        "model.masses-free-of-velocity".into(),
    ]
}

/// The longest component of a generator that is shown.
const SHOWN: u64 = 200;

/// The numbers of the integrals found, as subjects.
fn subjects(cx: &Context<'_>) -> Vec<Option<String>> {
    let obstacle = cx
        .registry()
        .find("noether.family")
        .is_none_or(|claim| cx.obstacle(claim, None).is_some());
    if obstacle {
        return Vec::new();
    }
    match &*found(cx) {
        Ok(found) => (1..=found.integrals.len())
            .map(|j| Some(j.to_string()))
            .collect(),
        Err(_) => Vec::new(),
    }
}

/// The integral of a subject.
///
/// # Errors
/// A sentence that says why there is none.
fn integral(cx: &Context<'_>, subject: Option<&str>) -> Result<Integral, String> {
    let found = found(cx);
    let found = match &*found {
        Ok(found) => found,
        Err(why) => return Err(why.clone()),
    };
    let number = subject.and_then(|s| s.parse::<usize>().ok()).unwrap_or(0);
    let integral = number.checked_sub(1).and_then(|i| found.integrals.get(i));
    integral
        .cloned()
        .ok_or_else(|| format!("{} first integrals were found", found.integrals.len()))
}

/// What a claim says of the integral of a subject.
fn of_subject(
    cx: &Context<'_>,
    subject: Option<&str>,
    decide: impl Fn(&Context<'_>, &Integral) -> Finding,
) -> Finding {
    match integral(cx, subject) {
        Ok(integral) => decide(cx, &integral),
        Err(why) => Verdict::undecided(why).into(),
    }
}

/// The same on another part of the states, of which the integral may be none.
fn of_subject_there(
    (cx, there): (&Context<'_>, &Context<'_>),
    (claim, subject): (&dyn Claim, Option<&str>),
    decide: impl Fn(&Context<'_>, &Integral) -> Finding,
) -> Finding {
    if let Some(obstacle) = there.obstacle(claim, subject) {
        return obstacle.into();
    }
    let own = match (integral(cx, subject), Motion::of(there)) {
        (Ok(own), Ok(motion)) => Integral {
            verdict: motion.is_integral(there, own.value),
            ..own
        },
        (Err(why), _) | (_, Err(why)) => return Verdict::undecided(why).into(),
    };
    match &own.verdict {
        Verdict::Proved(_) => decide(there, &own),
        other => Verdict::clone(other).into(),
    }
}

/// The finding of a claim whose subjects are numbers on another part of the states: of the one with the same formulas there.
fn the_same_there(
    (cx, there): (&Context<'_>, &Context<'_>),
    (claim, subject): (&dyn Claim, Option<&str>),
) -> Finding {
    let find = |cx: &Context<'_>, subject: Option<&str>| {
        Finding::clone(&cx.finding(&full_id(claim.id(), subject)))
    };
    let formulas = |finding: &Finding| -> Vec<Expr> {
        finding
            .formulas
            .iter()
            .map(|formula| formula.right)
            .collect()
    };
    let own = formulas(&find(cx, subject));
    let mut others = claim.subjects(there).into_iter();
    let others = others.find_map(|other| {
        let other = find(there, other.as_deref());
        (formulas(&other) == own).then_some(other)
    });
    others.unwrap_or_else(|| Verdict::undecided("it is not among what was found there").into())
}

/// An integral with its generator: δ = 1 for the energy, δ = 0 for the others.
///
/// # Errors
/// A sentence that says why there is none.
fn generator<'a>(
    cx: &Context<'a>,
    integral: &Integral,
) -> Result<(Embedded<'a>, Generator), String> {
    let n = Embedded::of(cx)?;
    let g = &cx.system.graph;
    let delta = match integral.name.as_deref() {
        Some(ENERGY) => g.one(),
        _ => g.zero(),
    };
    let generator = Generator::of(&n, integral.value, delta)
        .map_err(|problem| format!("the generator was not found: {problem}"))?;
    Ok((n, generator))
}

/// The claim that what is stated holds for the generator of an integral found: its residuals vanish on N.
fn of_generator(
    cx: &Context<'_>,
    integral: &Integral,
    statement: &str,
    residuals: impl Fn(&Generator, &Embedded<'_>) -> Vec<Expr>,
) -> Finding {
    let (n, generator) = match generator(cx, integral) {
        Ok(found) => found,
        Err(why) => return Verdict::undecided(why).into(),
    };
    let g = &cx.system.graph;
    let sentence = format!("{statement} for the integral {}", g.text(integral.shown));
    let verdict = on_manifold(cx, &n, &residuals(&generator, &n));
    verdict.prefixed(&sentence).into()
}

/// The components of the generator and the gauge, as formulas.
fn generator_formulas(cx: &Context<'_>, n: &Embedded<'_>, generator: &Generator) -> Vec<Formula> {
    let g = &n.system.graph;
    let speeds = &n.embedding.chart.parameters;
    let mut stated: Vec<(String, Expr)> = vec![(
        "the symmetry: how it shifts the time, δ".into(),
        generator.delta,
    )];
    for (speed, &xi) in speeds.iter().zip(&generator.xi) {
        let caption = format!(
            "the symmetry: its component ξ along the displacement that {} measures",
            speed.name
        );
        stated.push((caption, xi));
    }
    for (speed, &zeta) in speeds.iter().zip(&generator.zeta) {
        stated.push((
            format!("the symmetry: how it changes {}, ζ", speed.name),
            zeta,
        ));
    }
    stated.push(("the gauge function of the symmetry".into(), generator.gauge));
    let values: Vec<Expr> = stated.iter().map(|(_, e)| *e).collect();
    let values: Vec<Expr> = values.iter().map(|&e| readable(g, e)).collect();
    let values = in_quasi_velocities(cx, &values);
    stated
        .into_iter()
        .zip(values)
        .filter(|(_, value)| length(g, *value) <= SHOWN)
        .map(|((caption, _), right)| Formula {
            caption,
            left: None,
            right,
        })
        .collect()
}

/// Decides that residuals vanish on N, in its chart (t, q, η).
fn on_manifold(cx: &Context<'_>, n: &Embedded<'_>, residuals: &[Expr]) -> Verdict {
    let g = &cx.system.graph;
    let mut residuals: Vec<Expr> = residuals
        .iter()
        .copied()
        .filter(|&e| !g.is_zero(e))
        .collect();
    if residuals.is_empty() {
        residuals.push(g.zero());
    }
    cx.prover.identity(
        cx.system,
        &residuals,
        n.manifold(),
        "on the constraint manifold",
    )
}
