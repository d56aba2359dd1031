//! Tractions that are varied as a whole: the normal times a stress.

use super::terms::{times, Calculus, Linear, Term};
use super::{Atom, Index, Kind, Node};
use crate::tensors::Scope;
use chetaev_symbolic::rational;
use chetaev_symbolic::syntax::Span;
use std::collections::BTreeSet;

/// A traction that is the normal times a stress, which may stand in the density with a derivative.
pub(super) struct Through {
    pub(super) traction: String,
    pub(super) stress: String,
    /// Which index of the stress belongs to the normal.
    at: usize,
}

pub(super) fn through(scope: &Scope, traction: &str) -> Option<Through> {
    let (letters, body) = scope.definitions.get(traction)?;
    let Kind::Product(factors) = &body.kind else {
        return None;
    };
    let [(false, one), (false, other)] = &factors[..] else {
        return None;
    };
    let (Kind::Atom(normal), Kind::Atom(stress)) = (&one.kind, &other.kind) else {
        return None;
    };
    let is_normal = normal.name == "n" && scope.definitions.contains_key(&stress.name);
    let at = stress
        .indices
        .iter()
        .position(|index| normal.indices.contains(index))?;
    let mut rest = stress.indices.clone();
    rest.remove(at);
    let wanted: Vec<Index> = letters.iter().map(|&l| Index::Letter(l)).collect();
    let is_plain = is_normal && stress.derivatives.is_empty() && rest == wanted;
    is_plain.then(|| Through {
        traction: traction.to_owned(),
        stress: stress.name.clone(),
        at,
    })
}

impl Through {
    /// What the derivative of the stress in the density leaves on the boundary.
    pub(super) fn flux(&self, calculus: &Calculus<'_>, inside: &[Term]) -> Option<Linear> {
        let mut found = Linear::new();
        for (term, mut occurrence) in calculus.linear(inside, &self.stress)? {
            match occurrence.derivatives[..] {
                [] => continue,
                [by] if occurrence.indices.get(self.at) == Some(&by) => {
                    occurrence.indices.remove(self.at);
                    occurrence.derivatives.clear();
                    found.push((term, occurrence));
                }
                _ => return None,
            }
        }
        Some(found)
    }

    /// The linear part in a field that is in the stress, after the derivative was moved off the stress.
    pub(super) fn rest(
        &self,
        calculus: &Calculus<'_>,
        inside: &[Term],
        (scope, whole): (&Scope, &BTreeSet<String>),
        field: &str,
    ) -> Option<Linear> {
        let of_stress = calculus.linear(inside, &self.stress)?;
        // Its letters are none of those that were made so far.
        let open = Calculus::following(scope, whole, calculus);
        let mut found = Linear::new();
        for (term, occurrence) in of_stress {
            let coefficients = match occurrence.derivatives[..] {
                [] => vec![term],
                [by] => {
                    let mut all = calculus.derived(&term, by)?;
                    for own in &mut all {
                        own.number = -own.number.clone();
                    }
                    all
                }
                _ => return None,
            };
            let stress = Term {
                number: rational::integer(1),
                factors: vec![Node {
                    kind: Kind::Atom(Atom {
                        name: self.stress.clone(),
                        primes: 0,
                        indices: occurrence.indices,
                        derivatives: Vec::new(),
                        argument: None,
                    }),
                    span: Span::new(0, 0),
                }],
            };
            let linear = open.linear(&[stress], field)?;
            calculus.follow(&open);
            for coefficient in &coefficients {
                let own = linear
                    .iter()
                    .map(|(term, o)| (times(coefficient, term), o.clone()));
                found.extend(own);
            }
        }
        Some(found)
    }
}

pub(super) fn normal(by: Index) -> Term {
    let kind = Kind::Atom(Atom {
        name: "n".into(),
        primes: 0,
        indices: vec![by],
        derivatives: Vec::new(),
        argument: None,
    });
    Term {
        number: rational::integer(1),
        factors: vec![Node {
            kind,
            span: Span::new(0, 0),
        }],
    }
}
