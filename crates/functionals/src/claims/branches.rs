//! Branches of roots and absolute values: on each of them what is under them has one sign, and the functional has none of them.

use crate::functional::Functional;
use chetaev_symbolic::{rational, Expr, Function, Node};
use std::collections::BTreeSet;

/// Most expressions whose signs are told apart.
const MOST: usize = 4;

/// A functional where some expressions have one sign each.
#[derive(Debug)]
pub(super) struct Branch {
    /// The functional without the roots and absolute values.
    pub functional: Functional,
    /// What is not negative on it.
    pub nonnegative: Vec<Expr>,
    /// The same in words.
    pub words: String,
}

/// A root or an absolute value: the expression, what it is the absolute value of, and the power of that.
struct Root {
    whole: Expr,
    of: Expr,
    power: Expr,
    factor: Expr,
}

/// The branches of a functional; none where nothing is to be told apart, or where there are too many.
pub(super) fn branches(functional: &Functional) -> Option<Vec<Branch>> {
    let g = &functional.space.graph;
    let mut all: Vec<Expr> = vec![functional.density];
    all.extend(functional.pieces.iter().map(|piece| piece.density));
    let residuals = functional.equations.iter();
    all.extend(residuals.flat_map(|e| e.residuals.iter().copied()));
    let roots: Vec<Root> = g
        .reachable(&all)
        .into_iter()
        .filter_map(|e| root(functional, e))
        .collect();
    let of: BTreeSet<Expr> = roots.iter().map(|root| root.of).collect();
    let of: Vec<Expr> = of.into_iter().collect();
    if of.is_empty() || of.len() > MOST {
        return None;
    }
    let branch = |signs: usize| {
        let is_positive = |at: usize| signs >> at & 1 == 0;
        let signed = |at: usize| {
            if is_positive(at) {
                of[at]
            } else {
                g.neg(of[at])
            }
        };
        let pairs: Vec<(Expr, Expr)> = roots
            .iter()
            .filter_map(|root| {
                let at = of.iter().position(|&own| own == root.of)?;
                Some((
                    root.whole,
                    g.mul(&[root.factor, g.pow(signed(at), root.power)]),
                ))
            })
            .collect();
        let words: Vec<String> = (0..of.len())
            .map(|at| {
                let relation = if is_positive(at) { ">=" } else { "<=" };
                format!("{} {relation} 0", g.text(of[at]))
            })
            .collect();
        Branch {
            functional: replaced(functional, &pairs),
            nonnegative: (0..of.len()).map(signed).collect(),
            words: words.join(" and "),
        }
    };
    // Where what is under a root has one sign anyway, the other branch is empty.
    let is_possible = |signs: &usize| {
        (0..of.len()).all(|at| {
            let sign = functional.space.sign(of[at]);
            if signs >> at & 1 == 0 {
                sign.is_nonnegative() || !sign.is_nonpositive()
            } else {
                !sign.is_nonnegative()
            }
        })
    };
    let all = (0..1usize << of.len()).filter(is_possible);
    Some(all.map(branch).collect())
}

/// `|y|`, or `(c y²)^p` with a power p that is no whole number.
fn root(functional: &Functional, e: Expr) -> Option<Root> {
    let g = &functional.space.graph;
    let has_jets = |e: Expr| !functional.space.jets_in(&[e]).is_empty();
    match g.node(e) {
        Node::Apply {
            function: Function::Abs,
            arguments,
        } => {
            let of = *arguments.first()?;
            has_jets(of).then_some(Root {
                whole: e,
                of,
                power: g.one(),
                factor: g.one(),
            })
        }
        Node::Power { base, exponent } => {
            let power = g.as_number(*exponent)?;
            if rational::to_i64(power).is_some() || !has_jets(*base) {
                return None;
            }
            let (coefficient, factors) = match g.node(*base) {
                Node::Product {
                    coefficient,
                    factors,
                } => (coefficient.clone(), factors.to_vec()),
                _ => (rational::integer(1), vec![*base]),
            };
            if rational::is_negative(&coefficient) {
                return None;
            }
            let half = |&factor: &Expr| match g.node(factor) {
                Node::Power { base, exponent } => {
                    let n = rational::to_i64(g.as_number(*exponent)?)?;
                    (n % 2 == 0).then(|| g.powi(*base, n / 2))
                }
                _ => None,
            };
            let halves: Option<Vec<Expr>> = factors.iter().map(half).collect();
            Some(Root {
                whole: e,
                of: g.mul(&halves?),
                power: g.mul(&[g.integer(2), *exponent]),
                factor: g.pow(g.number(coefficient), *exponent),
            })
        }
        _ => None,
    }
}

fn replaced(functional: &Functional, pairs: &[(Expr, Expr)]) -> Functional {
    let g = &functional.space.graph;
    let mut own = functional.clone();
    own.density = g.substitute(own.density, pairs);
    for piece in &mut own.pieces {
        piece.density = g.substitute(piece.density, pairs);
    }
    for equation in &mut own.equations {
        for e in &mut equation.residuals {
            *e = g.substitute(*e, pairs);
        }
    }
    own
}
