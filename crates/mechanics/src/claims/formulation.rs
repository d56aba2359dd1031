//! `formulation.equivalent#NAME`: the accelerations of a formulation equal those of the multiplier form; and
//! `formulation.identity#NAME`: what holds before any equation of motion is used.

use super::{order, roots, Claim, Context, Finding, Group};
use crate::card::Relation;
use crate::characteristics::{Characteristics, Manifold};
use crate::equations::{keep_names_apart, Equations, StateVariable};
use crate::formulations::{self, Basis, DeriveError, FORMULATIONS};
use crate::system::System;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// The claim of equivalence.
#[derive(Clone, Copy, Debug)]
pub struct Equivalent;

/// The claim of identity.
#[derive(Clone, Copy, Debug)]
pub struct Identities;

/// The formulation all others are compared with.
pub const REFERENCE: &str = "routh";

impl Claim for Equivalent {
    fn id(&self) -> &'static str {
        "formulation.equivalent"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "Equations of motion in another form are the same equations"
    }

    fn explanation(&self) -> &'static str {
        "The accelerations that this formulation gives equal those of Routh's equations with multipliers at every state \
         that satisfies the constraints. Each formulation is derived by its own rule from the Lagrangian, the forces and \
         the constraints, so the equality is a test of both. The difference is reduced to zero exactly, or shown to be \
         zero at random points of random prime fields with a stated bound on the probability of error; for constraints \
         nonlinear in the velocities the points are taken on the constraint manifold. `refuted` comes with a state at \
         which the two forms give different accelerations."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        requirements(subject)
    }

    fn subjects(&self, _: &Context<'_>) -> Vec<Option<String>> {
        FORMULATIONS
            .iter()
            .map(|f| f.card())
            .filter(|card| card.relation == Relation::Equivalent)
            .map(|card| Some(card.name.to_string()))
            .collect()
    }

    fn highest_order(&self, subject: Option<&str>) -> u32 {
        highest_order(subject)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let name = subject.unwrap_or(REFERENCE);
        let derived = derive(cx, REFERENCE).and_then(|a| Ok((a, derive(cx, name)?)));
        match derived {
            Ok((reference, other)) => {
                let verdict = match &other.on_characteristics {
                    Some((c, residuals))
                        if cx.terms.order > 1 || cx.system.characteristics.is_some() =>
                    {
                        order::equivalence(cx, c, residuals)
                    }
                    _ => equivalence(cx, &reference, &other),
                };
                by_construction(cx, name, verdict).into()
            }
            Err(problem) => underived(name, &problem).into(),
        }
    }
}

impl Claim for Identities {
    fn id(&self) -> &'static str {
        "formulation.identity"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "What holds identically, before any equation of motion is used"
    }

    fn explanation(&self) -> &'static str {
        "Some formulations are connected with others by more than equal accelerations: Volterra's left sides are Maggi's on the \
         whole jet (t, q, P, P'), the n + 1 parametric equations satisfy one identity, the contraction X ⌟ Ω of the Lagrange \
         vector field vanishes in every component, brackets of the embedded fields are given by structure coefficients. The \
         subjects `…-special` are the lemmas between the two forms of Volterra and their special cases. The difference of both sides is proved zero with all accelerations free."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        requirements(subject)
    }

    fn subjects(&self, _: &Context<'_>) -> Vec<Option<String>> {
        FORMULATIONS
            .iter()
            .map(|f| f.card())
            .filter(|card| card.identity.is_some())
            .flat_map(|card| {
                let special = card.name.starts_with("volterra");
                let own = std::iter::once(card.name.to_string());
                own.chain(special.then(|| format!("{}{SPECIAL}", card.name)))
            })
            .map(Some)
            .collect()
    }

    fn highest_order(&self, subject: Option<&str>) -> u32 {
        highest_order(subject)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let subject = subject.unwrap_or(REFERENCE);
        let name = formulation_of(subject);
        let Some(formulation) = formulations::formulation(name) else {
            return Verdict::undecided(format!("there is no formulation `{name}`")).into();
        };
        let identities = match subject == name {
            true => formulation.identities(&basis(cx)),
            false => formulation.special_identities(&basis(cx)),
        };
        match identities {
            Ok(identities) => identities
                .into_iter()
                .map(|identity| {
                    let (residuals, manifold) = (&identity.residuals, &identity.manifold);
                    let verdict = cx
                        .prover
                        .identity(cx.system, residuals, manifold, identity.on);
                    stated(verdict, &identity.statement)
                })
                .reduce(Verdict::and)
                .unwrap_or_else(|| Verdict::undecided(format!("`{name}` states no identity")))
                .into(),
            Err(problem) => underived(name, &problem).into(),
        }
    }
}

fn stated(verdict: Verdict, statement: &str) -> Verdict {
    match verdict {
        Verdict::Proved(mut proof) => {
            proof.detail = format!("{statement}: {}", proof.detail);
            Verdict::Proved(proof)
        }
        Verdict::Refuted(mut found) => {
            found.detail = format!("{statement} does not hold: {}", found.detail);
            Verdict::Refuted(found)
        }
        other => other,
    }
}

fn underived(name: &str, problem: &DeriveError) -> Verdict {
    Verdict::undecided(format!("`{name}` could not be derived: {problem}"))
}

/// What follows the name of a formulation where its lemmas and special cases are meant.
const SPECIAL: &str = "-special";

fn formulation_of(subject: &str) -> &str {
    subject.strip_suffix(SPECIAL).unwrap_or(subject)
}

fn requirements(subject: Option<&str>) -> Vec<String> {
    subject
        .map(formulation_of)
        .and_then(formulations::formulation)
        .map(|f| f.card().requires.iter().map(|id| id.to_string()).collect())
        .unwrap_or_default()
}

fn highest_order(subject: Option<&str>) -> u32 {
    subject
        .map(formulation_of)
        .and_then(formulations::formulation)
        .map_or(1, |f| f.card().highest_order)
}

/// Calls a proof structural where the formulation is built from the same parts as another one.
fn by_construction(cx: &Context<'_>, name: &str, verdict: Verdict) -> Verdict {
    let reason = formulations::formulation(name).and_then(|f| f.structural(&basis(cx)));
    match (verdict, reason) {
        (Verdict::Proved(proof), Some(reason)) => Verdict::Proved(Proof::structural(
            proof.on,
            format!("{reason}; confirmed: {}", proof.detail),
        )),
        (verdict, _) => verdict,
    }
}

/// What a formulation starts from, for the context's system.
pub fn basis<'a>(cx: &Context<'a>) -> Basis<'a> {
    Basis {
        system: cx.system,
        terms: cx.terms,
        selection: cx.selection,
        characteristics: None,
    }
}

/// Derives the equations of the formulation `name` for the context's system.
///
/// # Errors
/// [`DeriveError`]; an unknown name derives as the reference.
pub fn derive(cx: &Context<'_>, name: &str) -> Result<Equations, DeriveError> {
    let known = formulations::formulation(name).unwrap_or(&formulations::Routh);
    let mut equations = known.equations(&basis(cx))?;
    keep_names_apart(cx.system, &mut equations.objects);
    Ok(equations)
}

/// Proves or refutes that two sets of equations give the same accelerations on the constraint manifold.
pub fn equivalence(cx: &Context<'_>, reference: &Equations, other: &Equations) -> Verdict {
    let residuals = residuals(cx, reference, other);
    let on = if cx.terms.constraints.is_empty() {
        "everywhere outside the singular set of the mass matrix"
    } else {
        "on the constraint manifold outside the singular set of the linear systems"
    };
    let verdict = cx.prover.identity(cx.system, &residuals, &manifold(cx), on);
    if matches!(verdict, Verdict::Proved(_) | Verdict::Refuted(_)) {
        return verdict;
    }
    // Perhaps roots of the formulation's own state are those of the model, written otherwise.
    match roots::split(cx, &residuals) {
        split if split == residuals => verdict,
        split => cx.prover.identity(cx.system, &split, &manifold(cx), on),
    }
}

/// `a_other - a_reference` as functions of (q, v, t), and what of q' in either form is not v; all zero on the constraint
/// manifold.
pub fn residuals(cx: &Context<'_>, reference: &Equations, other: &Equations) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let natural = |equations: &Equations| {
        let mut functions = equations.in_natural_state(system, &equations.accelerations);
        functions.extend(equations.velocity_residuals(system));
        roots::identified(cx, &functions)
    };
    let reactions = both_multipliers(system, reference, other);
    let (mut other, mut reference) = (natural(other), natural(reference));
    let velocities: Vec<Expr> = [&mut other, &mut reference]
        .into_iter()
        .flat_map(|functions| functions.split_off(system.n()))
        .collect();
    let accelerations = other.into_iter().zip(reference);
    accelerations
        .chain(reactions)
        .map(|(a, b)| g.sub(a, b))
        .chain(velocities)
        .filter(|&residual| !g.is_zero(residual))
        .collect()
}

/// The multipliers of the same constraints in both forms, as functions of (q, v, t); of forms that have velocities and nothing else as
/// their state.
fn both_multipliers(
    system: &System,
    reference: &Equations,
    other: &Equations,
) -> Vec<(Expr, Expr)> {
    let is_plain = |x: &StateVariable| x.definition == Some(x.value);
    let mut variables = other.variables.iter().chain(&reference.variables);
    if !variables.all(is_plain) {
        return Vec::new();
    }
    let own = other.multipliers.iter();
    own.filter_map(|&(constraint, value)| {
        let mut all = reference.multipliers.iter();
        let (_, reference) = all.find(|(index, _)| *index == constraint)?;
        Some((other.in_natural_state(system, &[value])[0], *reference))
    })
    .collect()
}

/// The manifold of admissible velocities by independent velocities.
pub fn manifold(cx: &Context<'_>) -> Manifold {
    Characteristics::independent_velocities(cx.system, cx.terms, cx.selection)
        .map(|c| c.manifold)
        .unwrap_or_default()
}
