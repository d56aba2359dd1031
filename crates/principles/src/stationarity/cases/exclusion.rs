//! Sets without states: those on which an assumption of the model fails, or a root has no real value.
//!
//! Signs are those that hold for all parameters; where an expression contains nothing but parameters, those at the values that the
//! model states.

use super::{Case, Leaf, Search};
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::system::Relation;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::number::ball::Precision;
use chetaev_symbolic::zero::assumptions::SignSet;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Node, Verdict};
use std::cmp::Ordering;

/// Bits of an enclosure.
const BITS: usize = 160;

impl Search<'_, '_> {
    /// Whether a set has no states.
    pub(super) fn is_excluded(&self, leaf: &Leaf) -> bool {
        let case = Case {
            solved: leaf.solved.clone(),
            implicit: leaf.implicit.clone(),
            roots: leaf.roots.clone(),
            ..Case::default()
        };
        self.violates_assumptions(&case) || self.has_no_real_root(leaf)
    }

    fn violates_assumptions(&self, case: &Case) -> bool {
        let system = self.cx.system;
        system.assumptions.iter().any(|assumption| {
            let difference = self.g.sub(assumption.left, assumption.right);
            let own = self.on(case, self.motion.on_states(self.g, difference));
            match (assumption.relation, self.sign_on(own)) {
                (Relation::Less, Some(sign)) => sign != Ordering::Less,
                (Relation::LessOrEqual, Some(sign)) => sign == Ordering::Greater,
                (Relation::NotEqual, Some(sign)) => sign == Ordering::Equal,
                (_, None) => false,
            }
        })
    }

    /// Whether a root in the equations has a negative number below it.
    fn has_no_real_root(&self, leaf: &Leaf) -> bool {
        let values: Vec<Expr> = leaf.solved.iter().map(|(_, value)| *value).collect();
        let is_negative = |e: Expr| self.sign_on(e) == Some(Ordering::Less);
        self.g
            .reachable(&values)
            .into_iter()
            .any(|e| match self.g.node(e) {
                Node::Power { base, exponent } => {
                    self.g.as_integer(*exponent).is_none() && is_negative(*base)
                }
                _ => false,
            })
    }

    /// Whether an expression does not vanish on a set: it is among what does not by which the set was found, or has a sign there.
    pub(super) fn vanishes_nowhere_on(&self, leaf: &Leaf, e: Expr) -> bool {
        let sign = || self.sign_on(self.g.substitute(e, &leaf.solved));
        leaf.nonzero.contains(&e) || sign().is_some_and(|sign| sign != Ordering::Equal)
    }

    /// Whether an expression of parameters alone, which may contain roots of roots, is zero.
    pub(super) fn is_zero_constant(&self, e: Expr) -> bool {
        if self.g.contains_any(e, &self.state)
            || self.sign_on(e).is_some_and(|s| s != Ordering::Equal)
        {
            return false;
        }
        let nowhere = Manifold::default();
        let verdict = self.cx.prover.identity(self.cx.system, &[e], &nowhere, "");
        matches!(verdict, Verdict::Proved(_))
    }

    /// The one sign that an expression has, as far as it is known.
    fn sign_on(&self, e: Expr) -> Option<Ordering> {
        let system = self.cx.system;
        if let Some(sign) = only(known_sign(self.g, e, &assumptions(system))) {
            return Some(sign);
        }
        let stated = self.g.substitute(e, &system.parameter_values());
        let found = self.g.enclose(&[stated], &Precision::new(BITS), &|_| None);
        found.ok()?.first()?.sign()
    }
}

fn only(sign: SignSet) -> Option<Ordering> {
    match (
        sign.is_nonzero(),
        sign.is_nonnegative(),
        sign.is_nonpositive(),
    ) {
        (true, true, false) => Some(Ordering::Greater),
        (true, false, true) => Some(Ordering::Less),
        (false, true, true) => Some(Ordering::Equal),
        _ => None,
    }
}
