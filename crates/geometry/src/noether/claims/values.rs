//! Functions that are integrals for parameters as the model defines or states them, and not for independent ones.

use super::symmetry::{symmetry_for, with_symmetry, with_values};
use crate::noether::motion::Motion;
use chetaev_mechanics::claims::{Context, Finding};
use chetaev_symbolic::{Expr, Graph, Verdict};

/// Parameters replaced, in so many steps, as definitions may use each other; and how the model gives them.
struct Given<'g> {
    pairs: Vec<(Expr, Expr)>,
    steps: usize,
    verb: &'g str,
}

impl Given<'_> {
    fn resolved(&self, g: &Graph, e: Expr) -> Expr {
        (0..self.steps).fold(e, |e, _| g.substitute(e, &self.pairs))
    }

    fn with(&self, pairs: Vec<(Expr, Expr)>) -> Self {
        Given { pairs, ..*self }
    }
}

/// The verdict where it holds for parameters as the model defines them by others, and not for independent ones.
pub(super) fn by_definitions(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
) -> Option<Finding> {
    let definitions = &cx.system.definitions;
    let given = Given {
        pairs: definitions.clone(),
        steps: definitions.len(),
        verb: "defines",
    };
    let verdict = for_parameters(cx, motion, value, &given)?;
    Some(with_its_symmetry(cx, value, verdict, &given))
}

fn with_its_symmetry(
    cx: &Context<'_>,
    value: Expr,
    verdict: Verdict,
    given: &Given<'_>,
) -> Finding {
    let resolved = |e: Expr| given.resolved(&cx.system.graph, e);
    with_symmetry(verdict, symmetry_for(cx, value, &resolved))
}

/// The verdict where it holds for the values that the model states, and not for independent parameters.
pub(super) fn by_values(cx: &Context<'_>, motion: &Motion<'_>, value: Expr) -> Option<Finding> {
    let (g, parameters) = (&cx.system.graph, cx.system.parameters.iter());
    let stated = parameters.filter_map(|p| Some((p.expr, p.value?)));
    let mut needed = Given {
        pairs: stated
            .filter(|(_, value)| g.symbols_in(&[*value]).is_empty())
            .collect(),
        steps: 1,
        verb: "states",
    };
    let mut found = for_parameters(cx, motion, value, &needed)?;
    // The condition names no more than it takes.
    let mut place = 0;
    while needed.pairs.len() <= MOST_VALUES && place < needed.pairs.len() {
        let mut fewer = needed.pairs.clone();
        fewer.remove(place);
        let fewer = needed.with(fewer);
        match for_parameters(cx, motion, value, &fewer) {
            Some(verdict) => (found, needed) = (verdict, fewer),
            None => place += 1,
        }
    }
    let proportional = (0..needed.pairs.len()).filter(|_| needed.pairs.len() <= MOST_VALUES);
    let by_ratio = proportional
        .filter_map(|base| Some(needed.with(multiples(g, &needed.pairs, base)?)))
        .find_map(|given| Some((for_parameters(cx, motion, value, &given)?, given)));
    let (found, given) = by_ratio.unwrap_or((found, needed));
    Some(with_its_symmetry(cx, value, found, &given))
}

/// The values stated, those that do not vanish as multiples of one of them, which itself is left free.
fn multiples(g: &Graph, values: &[(Expr, Expr)], base: usize) -> Option<Vec<(Expr, Expr)>> {
    let (own, unit) = values[base];
    let number = |e: Expr| g.as_number(e).is_some() && !g.is_zero(e);
    let others = values.iter().enumerate().filter(|(i, _)| *i != base);
    let tied = others.map(|(_, &(parameter, value))| match number(value) {
        true => (parameter, g.mul(&[g.div(value, unit), own])),
        false => (parameter, value),
    });
    let tied: Vec<(Expr, Expr)> = tied.collect();
    (number(unit) && !tied.is_empty()).then_some(tied)
}

/// Of more parameters it is not asked which values are needed.
const MOST_VALUES: usize = 12;

/// The verdict where it holds once parameters are replaced.
fn for_parameters(
    cx: &Context<'_>,
    motion: &Motion<'_>,
    value: Expr,
    given: &Given<'_>,
) -> Option<Verdict> {
    let (system, g) = (cx.system, &cx.system.graph);
    if given.pairs.is_empty() {
        return None;
    }
    let general = *motion.derivatives(&[value]).first()?;
    let manifold = with_values(&motion.manifold, &|e| given.resolved(g, e));
    let verb = given.verb;
    let on = format!("on the constraint manifold, for parameters as the model {verb} them");
    let rate = given.resolved(g, general);
    let Verdict::Proved(mut proof) = cx.prover.identity(system, &[rate], &manifold, &on) else {
        return None;
    };
    // The constraints may give what occurs its value, as sqrt(x' y') by x' y' = c.
    let of_manifold = motion.manifold.solved.iter().map(|(_, e)| *e);
    let implicit = motion.manifold.implicit.iter().map(|(f, _)| *f);
    let all: Vec<Expr> = of_manifold
        .chain(implicit)
        .chain([general, value])
        .collect();
    let occurring = g.symbols_in(&all);
    let used = given
        .pairs
        .iter()
        .filter(|(symbol, _)| g.as_symbol(*symbol).is_some_and(|s| occurring.contains(&s)));
    let conditions: Vec<String> = used
        .map(|&(symbol, e)| format!("{} = {}", g.text(symbol), g.text(e)))
        .collect();
    proof.detail = format!(
        "it keeps its value on motions for parameters as the model {verb} them; {}",
        proof.detail
    );
    Some(Verdict::Conditional {
        condition: conditions.join(", "),
        proof,
        counterexample: None,
    })
}
