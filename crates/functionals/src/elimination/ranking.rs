//! A ranking of jets in which every rule gives a jet by lower ones.
//!
//! A jet of the component c that is differentiated aᵢ times by the variable i has the weight w(c) + Σ λᵢ aᵢ with positive λᵢ. Where every
//! jet with a rule has a greater weight than all in its value, derivatives of rules keep that, rules end, and what the conditions of
//! integrability leave free is free (C. Riquier 1910; C. J. Rust, Rankings of partial derivatives, 1998). Weights solve linear inequalities;
//! they are found by the rule of the perceptron, which ends where there are any (F. Rosenblatt 1958, A. B. J. Novikoff 1962).

use super::{Rule, Solved};
use crate::space::{Jet, Space};
use std::collections::{BTreeMap, BTreeSet};

/// So many times weights are corrected before there are said to be none.
const MOST_CORRECTIONS: usize = 2_000;

/// Weights of components and of independent variables.
#[derive(Clone, Debug)]
pub(super) struct Ranking {
    components: BTreeMap<usize, i64>,
    variables: Vec<i64>,
}

/// A jet that has to be greater than others.
pub(super) type Above = (Jet, BTreeSet<Jet>);

impl Ranking {
    /// By the number of derivatives.
    pub(super) fn by_order(space: &Space) -> Ranking {
        Ranking {
            components: BTreeMap::new(),
            variables: vec![1; space.coordinates.len()],
        }
    }

    /// These weights corrected so that each jet is greater than those with it; `None` where none were found.
    pub(super) fn corrected(&self, all: &[Above]) -> Option<Ranking> {
        let mut own = self.clone();
        for _ in 0..MOST_CORRECTIONS {
            let violated = all.iter().find_map(|(jet, others)| {
                let is_wrong = |other: &&Jet| own.excess(jet, other) <= 0;
                Some((jet, others.iter().find(is_wrong)?))
            });
            let Some((jet, other)) = violated else {
                match own.variables.iter().position(|&weight| weight <= 0) {
                    Some(at) => own.variables[at] += 1,
                    None => return Some(own),
                }
                continue;
            };
            own.add(jet, 1);
            own.add(other, -1);
        }
        None
    }

    fn weight(&self, jet: &Jet) -> i64 {
        let own = self.components.get(&jet.component).copied().unwrap_or(0);
        let by = jet.by.iter().filter_map(|&axis| self.variables.get(axis));
        own + by.sum::<i64>()
    }

    fn excess(&self, jet: &Jet, other: &Jet) -> i64 {
        self.weight(jet) - self.weight(other)
    }

    fn add(&mut self, jet: &Jet, sign: i64) {
        *self.components.entry(jet.component).or_insert(0) += sign;
        for &axis in &jet.by {
            if let Some(own) = self.variables.get_mut(axis) {
                *own += sign;
            }
        }
    }
}

impl Solved<'_> {
    /// Whether all rules give jets by lower ones, so that nothing is hidden in them but their conditions of integrability.
    pub(super) fn is_ranked(&self) -> bool {
        self.ranking.is_some()
    }

    /// A ranking for the rules, and for more jets that are above others; `None` where none is known.
    pub(super) fn ranking_with(&self, more: Vec<Above>) -> Option<Ranking> {
        let known = self.ranking.as_ref()?;
        let asked = |rule: &Rule| (rule.jet.clone(), self.space.jets_in(&[rule.value]));
        let mut all = more;
        all.extend(self.rules.iter().map(asked));
        known.corrected(&all)
    }
}
