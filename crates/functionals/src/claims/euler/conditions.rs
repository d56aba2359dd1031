//! Where a proof holds: where roots, logarithms and denominators are defined, and what was divided by does not vanish.

use crate::functional::{Functional, Role};
use chetaev_symbolic::zero::assumptions::{is_contradicted, is_implied, Relation};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Function, Node, Verdict};
use std::collections::BTreeSet;

/// Where the densities can be differentiated and the stated equations are defined: roots, logarithms and denominators say it. `None` where
/// what they ask for excludes itself.
pub(super) fn where_defined(functional: &Functional) -> Option<String> {
    let stated = functional.equations.iter();
    let stated = stated.filter(|e| e.role != Role::Other);
    let stated: Vec<Expr> = stated.flat_map(|e| e.residuals.iter().copied()).collect();
    let mut densities: Vec<Expr> = vec![functional.density];
    densities.extend(functional.pieces.iter().map(|piece| piece.density));
    let mut all = conditions(functional, &densities, Need::Slope);
    all.extend(conditions(functional, &stated, Need::Value));
    let g = &functional.space.graph;
    let mut needed = Vec::new();
    let mut together = functional.space.assumptions();
    for &(left, relation) in &all {
        let right = g.zero();
        let sign = known_sign(g, left, &together);
        if is_contradicted(relation, sign) {
            return None;
        }
        if !is_implied(relation, sign) {
            together.assume(left, relation, right);
            needed.push((left, relation));
        }
    }
    if needed.is_empty() {
        return Some(String::new());
    }
    let texts = needed.iter();
    let texts = texts.map(|(e, relation)| format!("{} {} 0", g.text(*e), relation.symbol()));
    let texts: BTreeSet<String> = texts.collect();
    let texts: Vec<String> = texts.into_iter().collect();
    Some(format!(", where {}", texts.join(", ")))
}

/// What an expression is needed for.
#[derive(Clone, Copy, PartialEq)]
enum Need {
    /// It has to have a value.
    Value,
    /// It has to have derivatives.
    Slope,
}

/// Conditions under which expressions have values, or derivatives.
fn conditions(functional: &Functional, es: &[Expr], need: Need) -> Vec<(Expr, Relation)> {
    let g = &functional.space.graph;
    let is_smooth = need == Need::Slope;
    let condition = |e: Expr| {
        let (inner, relation) = match g.node(e) {
            Node::Power { base, exponent } => {
                let number = g.as_number(*exponent);
                let is_whole = number.and_then(rational::to_i64).is_some();
                let is_negative = number.is_some_and(rational::is_negative);
                let is_even_root =
                    number.is_none_or(|n| n.denominator().trailing_zeros() != Some(0));
                match (is_whole, is_even_root) {
                    (true, _) if is_negative => (*base, Relation::NotEqual),
                    (true, _) => return None,
                    (false, true) if is_smooth || is_negative => (*base, Relation::Greater),
                    (false, true) => (*base, Relation::GreaterOrEqual),
                    (false, false) if is_smooth || is_negative => (*base, Relation::NotEqual),
                    (false, false) => return None,
                }
            }
            Node::Apply {
                function,
                arguments,
            } => match function {
                Function::Log => (*arguments.first()?, Relation::Greater),
                Function::Abs if is_smooth => (*arguments.first()?, Relation::NotEqual),
                _ => return None,
            },
            _ => return None,
        };
        let sign = functional.space.sign(inner);
        let is_known = match relation {
            Relation::Greater => sign.is_positive(),
            Relation::GreaterOrEqual => sign.is_nonnegative(),
            _ => sign.is_nonzero(),
        };
        let has_jets = !functional.space.jets_in(&[inner]).is_empty();
        (has_jets && !is_known).then_some((inner, relation))
    };
    g.reachable(es).into_iter().filter_map(condition).collect()
}

/// A proof that divides by something without a value holds where that does not vanish.
pub(super) fn where_nonzero(verdict: Verdict, nonzero: &BTreeSet<String>) -> Verdict {
    match verdict {
        Verdict::Proved(mut proof) if !nonzero.is_empty() => {
            let all: Vec<String> = nonzero.iter().map(|e| format!("{e} ≠ 0")).collect();
            let said = format!(", where {}", all.join(" and "));
            proof.on.push_str(&said);
            proof.detail.push_str(&said);
            Verdict::Proved(proof)
        }
        other => other,
    }
}
