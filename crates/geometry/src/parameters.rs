//! What claims about constraints say of parameters: those that a model defines by others are put in before anything is decided; for the
//! numbers that it states the question is asked once more, and an answer that differs from the general one is said beside it.

use crate::integrability::on_its_own;
use chetaev_mechanics::{Context, Finding};
use chetaev_symbolic::{Expr, Graph, Verdict};

/// Longer values are not printed, in signs.
const SHOWN: usize = 60;

/// `decide` with the definitions of parameters put in; what is decided says so. Where the assumptions leave one side of the corners of the
/// constraints only, absolute values and signs are written without.
pub(crate) fn with_definitions(
    cx: &Context<'_>,
    decide: impl Fn(&Context<'_>) -> Finding,
) -> Finding {
    let system = cx.system;
    let decide = |cx: &Context<'_>| {
        let own = match &cx.system.sides()[..] {
            [only] => on_its_own(cx, &only.system, &decide),
            _ => None,
        };
        own.unwrap_or_else(|| decide(cx))
    };
    let pairs = system.definitions_in_constraints();
    let resolved = system.with_constraints_for(pairs.clone());
    let own = resolved.and_then(|resolved| on_its_own(cx, &resolved, decide));
    match own {
        Some(mut finding) => {
            let put_in = equations(&system.graph, &pairs);
            let sentence = format!("with {put_in}, as the model defines it");
            if !matches!(finding.verdict, Verdict::NotApplicable { .. }) {
                finding.verdict.prefix(&sentence);
            }
            finding
        }
        None => decide(cx),
    }
}

/// What `decide` says in the place of `general` where the parameters have the values that the model states, where these make a
/// difference: a sentence.
pub(crate) fn where_stated(
    cx: &Context<'_>,
    general: &str,
    decide: impl Fn(&Context<'_>) -> Option<String>,
) -> Option<String> {
    let system = cx.system;
    let pairs = system.values_in_constraints();
    if cx.is_out_of_time() {
        return None;
    }
    let stated = system.with_constraints_for(pairs.clone())?;
    let said = on_its_own(cx, &stated, decide)??;
    let equations = equations(&system.graph, &pairs);
    (said != general).then(|| {
        format!("this is for general values of the parameters: for {equations}, as the model states, {said}")
    })
}

/// `a = 1 and b = 2`.
fn equations(g: &Graph, pairs: &[(Expr, Expr)]) -> String {
    let own = pairs.iter().map(|&(parameter, value)| {
        let text = g.text(value);
        match text.chars().count() <= SHOWN {
            true => format!("{} = {text}", g.text(parameter)),
            false => format!("{} by its definition", g.text(parameter)),
        }
    });
    own.collect::<Vec<String>>().join(" and ")
}
