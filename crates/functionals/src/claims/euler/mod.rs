//! `functional.euler`: stationarity is equivalent to the stated equations.

mod comparison;
mod conditions;
mod exceptions;
mod extension;
mod plane;
mod propagation;
mod remarks;
mod separation;
mod squares;
mod sufficiency;

use self::comparison::Comparison;
use self::conditions::{in_words, open_factors, where_defined, where_nonzero, Needed};
use self::exceptions::holds_at_zero;
use self::plane::planes;
use self::separation::separated;
use self::sufficiency::insufficient;
use super::branches::{branches, Branch};
use super::reduction::{admitted, reduced, restricted};
use super::traces::{traces, Traces};
use super::{on_smoothness, Claim, Context, Finding};
use crate::functional::{Functional, Role};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Verdict};

/// `functional.euler#NAME`.
pub(super) struct Euler;

impl Claim for Euler {
    fn id(&self) -> &'static str {
        "functional.euler"
    }

    fn title(&self) -> &'static str {
        "The Euler equations and natural conditions are equivalent to the stated field equations and boundary conditions"
    }

    fn explanation(&self) -> &'static str {
        "The Euler equations and the natural conditions on each piece of the boundary are derived from the densities, and compared \
         with the equations that `yields` names, together with those that `imposed` names. Both systems are solved, one group of \
         equations after the other, for data, fields or their derivatives (a gradient B'(s) = e of a function with a Legendre \
         conjugate as s = A'(e)), and rules are differentiated as needed; then every equation of one system must vanish where the \
         other holds, both ways, inside and on each piece. Equations are compared at one place, by algebra and differentiation; what the equations of the \
         body carry along, at most in proportion to itself, is decided at an end (the theorem of uniqueness, Lipschitz 1876). Constitutive functions stay symbols with their derivatives, so that a proof holds for every \
         energy. What is solved for with a matrix that depends on the fields is named under \"on\": there the matrix must be \
         regular. Where a coefficient of the densities jumps or has a kink inside the body, conditions hold that are not derived, and the claim \
         is not applicable. Equations with a stated multiplier are added to the density with it before the variation. Others that are imposed inside leave \
         variations whose values on the boundary have to be arbitrary, else the natural conditions hold only taken together, and are not compared one by \
         one: that is decided on a line where the variations are polynomials, and for one definite equation (Lax and Milgram 1954), and is stated by the model elsewhere, \
         as `solvable`. A refutation shows a \
         jet at which one system holds and the other does not, where data can be chosen so that it is the jet of a solution (each equation of the body has \
         data of its own, or these are linear and each condition on the boundary has); else polynomials \
         that satisfy one system in the body and on its boundary, and not the other; where variations are restricted, polynomials that satisfy what is \
         imposed and stated, with a variation that keeps what is imposed and changes the functional. Where there are none the claim is undecided, as conditions at \
         several places may enforce together what none of them does (a beam without supports whose load is zero only moves rigidly)."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        vec![cx.own()]
    }

    fn differentiates(&self) -> bool {
        true
    }

    fn decide(&self, cx: &Context<'_>, _subject: Option<&str>) -> Finding {
        let functional = cx.functional();
        if functional.with_role(Role::Yielded).next().is_none() {
            let printed = match &cx.variation {
                Ok(_) => {
                    let said = on_smoothness(&cx.coefficients).map(|said| format!("; {said}"));
                    format!(
                        "so the Euler equations are only printed{}",
                        said.unwrap_or_default()
                    )
                }
                Err(problem) => format!("and the Euler equations are not derived: {problem}"),
            };
            return Verdict::not_applicable(
                "functional.euler",
                format!("the model states no field equations under `yields`, {printed}"),
            )
            .into();
        }
        let own = reduced(functional).functional;
        let verdict = match branches(&own) {
            // Where only one branch is possible its signs are known everywhere.
            Some(all) => match all.as_slice() {
                [only] => on_branch(&only.functional, &[]),
                all => on_branches(all),
            },
            None => on_branch(&own, &[]),
        };
        let Some(conditions) = where_defined(functional) else {
            return match verdict {
                Verdict::Proved(_) => Verdict::not_applicable(
                    "functional.euler",
                    "what is stated is defined nowhere: its roots, logarithms and denominators exclude each other",
                ),
                other => other,
            }
            .into();
        };
        let is_decided = matches!(verdict, Verdict::Proved(_) | Verdict::Refuted(_));
        let excluded = is_decided.then(|| vanishing_condition(functional, &conditions));
        if let Some(e) = excluded.flatten() {
            return Verdict::undecided(format!(
                "where the equations hold, {} vanishes, and there the densities have no derivatives or the equations no values",
                functional.space.graph.text(e)
            ))
            .into();
        }
        let Verdict::Proved(mut proof) = verdict else {
            return verdict.into();
        };
        if let Some(said) = cx.admission.of_redundant() {
            proof.detail.push_str(&format!(", with {said}"));
        }
        let said = in_words(functional, &conditions);
        proof.on.push_str(&said);
        proof.detail.push_str(&said);
        Verdict::Proved(proof).into()
    }
}

/// What a condition asks not to vanish although it does where the Euler equations hold, or the stated ones.
fn vanishing_condition(functional: &Functional, conditions: &[Needed]) -> Option<Expr> {
    if conditions.is_empty() {
        return None;
    }
    let own = admitted(functional).ok()?;
    let comparison = Comparison::new(functional, &own, &[], &[]);
    let all = conditions.iter().filter(|own| own.excludes_zero());
    let mut all = all.map(|own| own.of);
    all.find(|&e| comparison.derived.follows(&[e]) || comparison.stated().follows(&[e]))
}

/// The verdict where some expressions are known not to be negative.
fn on_branch(functional: &Functional, nonnegative: &[Expr]) -> Verdict {
    let own = match admitted(functional) {
        Ok(own) => own,
        Err(problem) => return Verdict::undecided(problem.to_string()),
    };
    if let Some(why) = restricted(functional, &own) {
        let refuted = nonnegative.is_empty().then(|| insufficient(functional));
        return refuted.flatten().unwrap_or_else(|| Verdict::undecided(why));
    }
    let traces = traces(functional, &own);
    if let Traces::Open(why) = traces {
        let inside = Comparison::new(functional, &own, &[], nonnegative);
        let refuted = inside.refuted_inside(&mut Vec::new());
        let is_general = nonnegative.is_empty();
        let refuted = refuted.or_else(|| is_general.then(|| insufficient(functional)).flatten());
        return refuted.unwrap_or_else(|| Verdict::undecided(why));
    }
    let planes = planes(functional, &own);
    let comparison = Comparison::new(functional, &own, &planes, nonnegative);
    if let Some(refuted) = comparison.refuted_where_plane() {
        return refuted;
    }
    let verdict = comparison.compared();
    if matches!(verdict, Verdict::Undecided { .. }) && nonnegative.is_empty() {
        return separated(functional, &own).unwrap_or(verdict);
    }
    let Verdict::Proved(mut proof) = verdict else {
        return verdict;
    };
    if let Traces::Where(condition) = traces {
        let said = format!(", where {condition}");
        proof.on.push_str(&said);
        proof.detail.push_str(&said);
    }
    let mut needed = comparison.nonzero.borrow().clone();
    for factor in comparison.nonzero.borrow().iter() {
        needed.remove(factor);
        if !holds_at_zero(functional, *factor, &needed) {
            needed.insert(*factor);
        }
    }
    let g = &functional.space.graph;
    // Conjugates that were computed are there only where the gradients are one-to-one.
    let computed = functional.space.determinants().into_iter();
    needed.extend(computed.flat_map(|e| open_factors(functional, e)));
    where_nonzero(
        Verdict::Proved(proof),
        &needed.iter().map(|&factor| g.text(factor)).collect(),
    )
}

/// The verdicts on all branches in one: true on some only, it is true where these are.
fn on_branches(all: &[Branch]) -> Verdict {
    let decided = all
        .iter()
        .map(|branch| on_branch(&branch.functional, &branch.nonnegative));
    let mut proved: Vec<(&str, Proof)> = Vec::new();
    let mut refuted: Option<Verdict> = None;
    let mut open: Option<Verdict> = None;
    for (branch, verdict) in all.iter().zip(decided) {
        match verdict {
            Verdict::Proved(proof) => proved.push((&branch.words, proof)),
            Verdict::Refuted(_) if refuted.is_none() => {
                refuted = Some(verdict.prefixed(&format!("where {}", branch.words)));
            }
            Verdict::Refuted(_) => {}
            other if open.is_none() => {
                open = Some(other.prefixed(&format!("where {}", branch.words)));
            }
            _ => {}
        }
    }
    let Some((words, mut proof)) = proved.first().cloned() else {
        return refuted
            .or(open)
            .unwrap_or_else(|| Verdict::undecided("there are no branches"));
    };
    match (refuted, open) {
        (None, Some(open)) => open,
        (Some(refuted), Some(_)) => refuted,
        (None, None) => {
            let joined = proved.into_iter().map(|(_, proof)| Verdict::Proved(proof));
            joined.fold(Verdict::Proved(proof), Verdict::and)
        }
        (Some(Verdict::Refuted(counterexample)), None) => {
            let each = proved.iter().map(|(words, _)| format!("({words})"));
            let condition = match &proved[..] {
                [_] => words.to_owned(),
                _ => each.collect::<Vec<_>>().join(" or "),
            };
            proof.detail = format!(
                "where {condition} {}; elsewhere not: {}",
                proof.detail, counterexample.detail
            );
            Verdict::Conditional {
                condition,
                proof,
                counterexample: Some(counterexample),
            }
        }
        (Some(other), None) => other,
    }
}
