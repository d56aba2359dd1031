//! What claims about constraints say of parameters: those that a model defines by others are put in before anything is decided; where
//! the numbers that it states for others are exceptional this is noticed.

use crate::integrability::on_its_own;
use chetaev_mechanics::prover::conditions_that_matter;
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

/// Notices the parameters in constraints at whose stated values `decide` says another thing than `general`.
pub(crate) fn notice(
    cx: &Context<'_>,
    general: &str,
    decide: impl Fn(&Context<'_>) -> Option<String>,
) {
    let system = cx.system;
    if cx.is_out_of_time() {
        return;
    }
    let differs = |values: &[(Expr, Expr)]| {
        let stated = system.with_constraints_for(values.to_vec());
        let said = stated.and_then(|stated| on_its_own(cx, &stated, &decide)?);
        said.is_some_and(|said| said != general)
    };
    let values = system.values_in_constraints();
    let exceptional = &cx.prover.exceptional;
    // What is exceptional where some values are put in is so of another system.
    let before = exceptional.take();
    let own = differs(&values)
        .then(|| conditions_that_matter(&system.graph, &values, |_| Vec::new(), differs));
    exceptional.take();
    exceptional.add(before);
    exceptional.add_stated(own.unwrap_or_default());
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
