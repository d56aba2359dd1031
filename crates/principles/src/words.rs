//! Sentences and formulas that the claims of this crate share.

use chetaev_mechanics::claims::{Context, Formula};
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{simplify, Expr, Verdict};

/// Expressions of more nodes are not simplified for printing.
const LARGEST: usize = 300;
/// Longer formulas are not printed.
const LONGEST: u64 = 320;

/// An expression as a person writes it; `None` where that is too long to be read.
pub(crate) fn readable(cx: &Context<'_>, e: Expr) -> Option<Expr> {
    let g = &cx.system.graph;
    if g.reachable(&[e]).len() > LARGEST {
        return None;
    }
    let short = simplify::simplify(g, e, &simplify::Options::default());
    (simplify::length(g, short) <= LONGEST).then_some(short)
}

/// A formula, where it is short enough to be read.
pub(crate) fn formula(
    cx: &Context<'_>,
    caption: impl Into<String>,
    left: Option<Expr>,
    right: Expr,
) -> Option<Formula> {
    Some(Formula {
        caption: caption.into(),
        left,
        right: readable(cx, right)?,
    })
}

/// A conditional verdict from a proof of what holds on the subset and the refutation of the rest.
pub(crate) fn conditional(condition: String, proof: Proof, refutation: Verdict) -> Verdict {
    let counterexample = match refutation {
        Verdict::Refuted(found) => Some(found),
        Verdict::Conditional { counterexample, .. } => counterexample,
        _ => None,
    };
    Verdict::Conditional {
        condition,
        proof,
        counterexample,
    }
}

/// That a sentence is about general functions in the place of controls for which the model states no law, as its end: it holds with
/// every such function as far as it says what is, not as far as it says that nothing else is. z' = u x' is integrable for u' = 0.
pub(crate) fn for_general_controls(cx: &Context<'_>) -> String {
    let free = cx.system.controls.iter().filter(|u| u.law.is_none());
    let names: Vec<String> = free.map(|u| format!("{}(t)", u.name)).collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(
            ", for general {} (particular ones, as constant ones, may admit more)",
            listed(&names)
        ),
    }
}

/// "a", "a and b", "a, b and c".
pub(crate) fn listed<T: AsRef<str>>(items: &[T]) -> String {
    match items {
        [] => String::new(),
        [only] => only.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", first.join(", "), last.as_ref())
        }
    }
}
