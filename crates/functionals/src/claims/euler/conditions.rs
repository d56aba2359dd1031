//! Where a proof holds: where roots, logarithms, denominators and inverse functions are defined, and what was divided by does not vanish.

use crate::elimination::factors_of;
use crate::functional::{Functional, Role};
use crate::notation::denominators;
use crate::smoothness::{guard_of, with_equality};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::zero::assumptions::{is_contradicted, is_implied, Relation, SignSet};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, Expr, Function, Node, Rational, Symbol, Verdict};
use std::collections::BTreeSet;

/// An expression and how it has to compare with zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Needed {
    /// The expression.
    pub(super) of: Expr,
    relation: Relation,
}

impl Needed {
    /// Whether it is not fulfilled at zero.
    pub(super) fn excludes_zero(&self) -> bool {
        is_contradicted(self.relation, SignSet::ZERO)
    }
}

/// Where the densities can be differentiated and the stated equations are defined: roots, logarithms and denominators say it. `None` where
/// what they ask for excludes itself.
pub(super) fn where_defined(functional: &Functional) -> Option<Vec<Needed>> {
    let stated = functional.equations.iter();
    let stated = stated.filter(|e| e.role != Role::Other);
    let stated: Vec<Expr> = stated.flat_map(|e| e.residuals.iter().copied()).collect();
    let mut densities: Vec<Expr> = vec![functional.density];
    densities.extend(functional.pieces.iter().map(|piece| piece.density));
    let mut all = conditions(functional, &densities, Need::Slope);
    all.extend(conditions(functional, &stated, Need::Value));
    let written = denominators(functional).into_iter();
    all.extend(written.flat_map(|e| not_zero(functional, e)));
    let g = &functional.space.graph;
    let mut needed = Vec::new();
    let mut together = functional.space.assumptions();
    for own in all {
        let sign = known_sign(g, own.of, &together);
        if is_contradicted(own.relation, sign) {
            return None;
        }
        if !is_implied(own.relation, sign) {
            together.assume(own.of, own.relation, g.zero());
            needed.push(own);
        }
    }
    Some(needed)
}

/// That the factors of a denominator in which fields or data occur do not vanish, also where it cancels.
fn not_zero(functional: &Functional, e: Expr) -> Vec<Needed> {
    let space = &*functional.space;
    let relation = Relation::NotEqual;
    let mut factors = factors_of(space, space.explicit(e));
    factors.retain(|&factor| !space.jets_in(&[factor]).is_empty());
    factors
        .into_iter()
        .map(|of| Needed { of, relation })
        .collect()
}

/// ", where …", or nothing.
pub(super) fn in_words(functional: &Functional, needed: &[Needed]) -> String {
    if needed.is_empty() {
        return String::new();
    }
    let g = &functional.space.graph;
    let text = |own: &Needed| format!("{} {} 0", g.text(own.of), own.relation.symbol());
    let texts: BTreeSet<String> = needed.iter().map(text).collect();
    let texts: Vec<String> = texts.into_iter().collect();
    format!(", where {}", texts.join(", "))
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
fn conditions(functional: &Functional, es: &[Expr], need: Need) -> Vec<Needed> {
    let g = &functional.space.graph;
    let is_smooth = need == Need::Slope;
    // |x|³ has derivatives at zero, where |x| has none.
    let is_smooth_power = |base: Expr, n: &Rational| {
        let jets = functional.space.jets_in(&[base]);
        // The coefficients of derivatives are differentiated once more.
        let order = if jets.iter().all(|jet| jet.by.is_empty()) {
            1
        } else {
            2
        };
        *n > rational::integer(order)
    };
    let smoothed: BTreeSet<Expr> = g
        .reachable(es)
        .into_iter()
        .filter_map(|e| match g.node(e) {
            Node::Power { base, exponent } => {
                let number = g.as_number(*exponent)?;
                is_smooth_power(*base, number).then_some(*base)
            }
            _ => None,
        })
        .collect();
    let condition = |e: Expr| {
        let (inner, relation) = match g.node(e) {
            Node::Power { base, exponent } => {
                let number = g.as_number(*exponent);
                let is_whole = number.and_then(rational::to_i64).is_some();
                let is_negative = number.is_some_and(rational::is_negative);
                let is_even_root =
                    number.is_none_or(|n| n.denominator().trailing_zeros() != Some(0));
                let is_smooth = is_smooth && !number.is_some_and(|n| is_smooth_power(*base, n));
                match (is_whole, is_even_root) {
                    (true, _) if is_negative => (*base, Relation::NotEqual),
                    (true, _) => return None,
                    (false, true) if is_smooth || is_negative => (*base, Relation::Greater),
                    (false, true) => (*base, Relation::GreaterOrEqual),
                    (false, false) if is_smooth || is_negative => (*base, Relation::NotEqual),
                    (false, false) => return None,
                }
            }
            Node::Apply { function, .. } => {
                let has_values = matches!(function, Function::Abs | Function::Sign);
                if has_values && (!is_smooth || smoothed.contains(&e)) {
                    return None;
                }
                let (inner, relation) = guard_of(g, e)?;
                // At the ends of where they are defined these have values, and no derivatives.
                let ends = [Function::Asin, Function::Acos, Function::Acosh];
                if !is_smooth && ends.contains(function) {
                    (inner, with_equality(relation))
                } else {
                    (inner, relation)
                }
            }
            _ => return None,
        };
        let sign = functional.space.sign(inner);
        let has_jets = !functional.space.jets_in(&[inner]).is_empty();
        (has_jets && !is_implied(relation, sign)).then_some(Needed {
            of: inner,
            relation,
        })
    };
    g.reachable(es).into_iter().filter_map(condition).collect()
}

/// The factors of an expression that have no known sign, each of which must not vanish so that it does not.
pub(super) fn open_factors(functional: &Functional, e: Expr) -> Vec<Expr> {
    let space = &*functional.space;
    let g = &space.graph;
    let symbols: Vec<Symbol> = space.symbols_in(&[e]).into_iter().collect();
    let factors = factors(g, e, &symbols).unwrap_or_else(|| vec![(e, 1)]);
    let is_open = |e: &Expr| g.as_number(*e).is_none() && !space.sign(*e).is_nonzero();
    factors
        .into_iter()
        .map(|(e, _)| e)
        .filter(is_open)
        .collect()
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
