//! `formulation.equivalent#NAME`: the accelerations of a formulation equal those of the multiplier form.

use super::{Claim, Context, Finding, Group};
use crate::characteristics::Manifold;
use crate::equations::Equations;
use crate::formulations::{self, Basis, DeriveError, FORMULATIONS};
use chetaev_symbolic::{Expr, Verdict};

/// The claim.
#[derive(Clone, Copy, Debug)]
pub struct Equivalent;

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
        subject
            .and_then(formulations::formulation)
            .map(|f| f.card().requires.iter().map(|id| id.to_string()).collect())
            .unwrap_or_default()
    }

    fn subjects(&self, _: &Context<'_>) -> Vec<Option<String>> {
        FORMULATIONS
            .iter()
            .map(|f| f.card().name)
            .filter(|name| *name != REFERENCE)
            .map(|name| Some(name.to_string()))
            .collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let name = subject.unwrap_or(REFERENCE);
        let derived = derive(cx, REFERENCE).and_then(|a| Ok((a, derive(cx, name)?)));
        match derived {
            Ok((reference, other)) => equivalence(cx, &reference, &other).into(),
            Err(problem) => {
                Verdict::undecided(format!("`{name}` could not be derived: {problem}")).into()
            }
        }
    }
}

/// Derives the equations of the formulation `name` for the context's system.
///
/// # Errors
/// [`DeriveError`]; an unknown name derives as the reference.
pub fn derive(cx: &Context<'_>, name: &str) -> Result<Equations, DeriveError> {
    let basis = Basis {
        system: cx.system,
        terms: cx.terms,
        selection: cx.selection,
        characteristics: None,
    };
    formulations::formulation(name)
        .unwrap_or(&formulations::Routh)
        .equations(&basis)
}

/// Proves or refutes that two sets of equations give the same accelerations on the constraint manifold.
pub fn equivalence(cx: &Context<'_>, reference: &Equations, other: &Equations) -> Verdict {
    let residuals = residuals(cx, reference, other);
    let manifold = other
        .characteristics
        .as_ref()
        .or(reference.characteristics.as_ref())
        .map(|c| c.manifold.clone())
        .unwrap_or_default();
    let on = if cx.terms.constraints.is_empty() {
        "everywhere outside the singular set of the mass matrix"
    } else {
        "on the constraint manifold outside the singular set of the linear systems"
    };
    cx.prover.identity(cx.system, &residuals, &manifold, on)
}

/// `a_other - a_reference` as functions of the other form's variables.
pub fn residuals(cx: &Context<'_>, reference: &Equations, other: &Equations) -> Vec<Expr> {
    let g = &cx.system.graph;
    let restricted = match &other.characteristics {
        Some(characteristics) => characteristics.restrict(cx.system, &reference.accelerations),
        None => reference.accelerations.clone(),
    };
    other
        .accelerations
        .iter()
        .zip(restricted)
        .map(|(&a, b)| g.sub(a, b))
        .filter(|&residual| !g.is_zero(residual))
        .collect()
}

/// The manifold of admissible velocities by independent velocities, for claims that have no parametrization of their own.
pub fn manifold(cx: &Context<'_>) -> Manifold {
    crate::characteristics::Characteristics::independent_velocities(
        cx.system,
        cx.terms,
        cx.selection,
    )
    .map(|c| c.manifold)
    .unwrap_or_default()
}
