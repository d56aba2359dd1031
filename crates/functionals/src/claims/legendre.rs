//! `functional.legendre`: stated constitutive functions are Legendre conjugates.

use super::{Claim, Context, Finding};
use crate::functional::Constitutive;
use chetaev_symbolic::Verdict;

/// `functional.legendre#B`.
pub(super) struct Legendre;

impl Claim for Legendre {
    fn id(&self) -> &'static str {
        "functional.legendre"
    }

    fn title(&self) -> &'static str {
        "Two constitutive functions are Legendre conjugates"
    }

    fn explanation(&self) -> &'static str {
        "For functions A(e) and B(s) stated by formulas: B'(A'(e)) = e and A(e) + B(A'(e)) = A'(e) e, and the same with A and B \
         exchanged, by exact arithmetic; or one of both ways so, and the other because the gradient inside is one-to-one, its Hessian \
         being definite everywhere. All other proofs use of the two functions nothing but this relation, and do not use it where it \
         is not proved. Where one of them has no formula, the relation is an assumption of the model and there is nothing to decide."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let stated = cx
            .functional()
            .functions
            .iter()
            .filter(|f| f.conjugate.is_some());
        stated.map(|f| Some(f.name.clone())).collect()
    }

    fn is_of_fields(&self) -> bool {
        false
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let functional = cx.functional();
        let space = &*functional.space;
        let own = functional
            .functions
            .iter()
            .find(|f| Some(f.name.as_str()) == subject);
        let Some(own) = own else {
            return Verdict::undecided("there is no such function").into();
        };
        let Some(other) = space.function_at(own.function).conjugate else {
            return Verdict::undecided("it has no conjugate").into();
        };
        let is_stated = |function: usize| {
            let mut all = functional.functions.iter();
            let is_own = |f: &&Constitutive| f.function == function;
            all.find(is_own)
                .is_some_and(|f| f.value.is_some() || f.gradient.is_some())
        };
        let name = |function: usize| space.function_at(function).name;
        match space.conjugation(own.function) {
            Some(verdict @ Verdict::NotApplicable { .. }) => verdict.into(),
            _ if space.determinant_of(own.function).is_some() => {
                computed(&name(other), &own.name, &own.name)
            }
            _ if space.determinant_of(other).is_some() => {
                computed(&own.name, &name(other), &own.name)
            }
            _ if !is_stated(other) => assumed(&name(other), &own.name),
            _ if !is_stated(own.function) => assumed(&own.name, &own.name),
            Some(verdict) => verdict.into(),
            None => Verdict::undecided(
                "the relation is assumed: one of the functions has a gradient and no value",
            )
            .into(),
        }
    }
}

fn assumed(without: &str, subject: &str) -> Finding {
    Verdict::not_applicable(
        format!("functional.legendre#{subject}"),
        format!("`{without}` has no formula, so the relation is assumed by the model"),
    )
    .into()
}

fn computed(without: &str, from: &str, subject: &str) -> Finding {
    Verdict::not_applicable(
        format!("functional.legendre#{subject}"),
        format!("`{without}` has no formula and is computed as the conjugate of `{from}`"),
    )
    .into()
}
