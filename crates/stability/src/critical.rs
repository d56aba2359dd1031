//! The critical direction of a zero eigenvalue beside those of the levels of integrals: a simple one, or a chain of two.
//!
//! All equations but one are solved along a curve that begins in the direction of the null vector n; what is left begins with `c xᵐ`. For a simple zero that
//! is the motion on the centre manifold, `x' = c xᵐ + …`; for a chain `A g = n` it is `x' = y`, `y' = c xᵐ + …` where y = 0.

use crate::about::About;
use crate::branching::{Branching, Leading};
use crate::levels::Levels;
use crate::steady::{closed, kernel, solution, times};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// `c xᵐ`; no term where all that were looked at vanish.
pub(crate) struct Critical {
    /// On which levels, as it is read.
    pub(crate) levels: String,
    pub(crate) term: Option<Leading>,
    /// c.
    pub(crate) rate: Expr,
    /// What was divided by.
    pub(crate) nonzero: Vec<Expr>,
}

/// What the first term says.
pub(crate) struct First {
    /// m.
    pub(crate) order: usize,
    /// The sign of c, where it is known.
    pub(crate) sign: Option<Ordering>,
}

impl Critical {
    /// What must keep its sign.
    pub(crate) fn functions(&self) -> Vec<Expr> {
        [self.nonzero.clone(), vec![self.rate]].concat()
    }

    /// The first term with the sign of c, where nothing that was divided by vanishes at a value of the parameter.
    pub(crate) fn first(&self, about: &About<'_>, at: Option<&RBig>) -> Option<First> {
        let sign = |e: Expr| about.question.sign(about.graph(), e, at);
        let is_apart = |&e: &Expr| sign(e).is_some_and(|s| s != Ordering::Equal);
        let term = self.term.as_ref()?;
        self.nonzero.iter().all(is_apart).then(|| First {
            order: term.order,
            sign: sign(self.rate),
        })
    }

    /// The critical direction where zero has this multiplicity on the levels of integrals, one eigenvector there, and no imaginary pair beside it.
    pub(crate) fn of(about: &About<'_>, multiplicity: usize) -> Option<Critical> {
        let (g, own, question) = (about.graph(), &about.expansion, &about.question);
        let is_alone = question.spectrum.paired.is_none() && question.zeros() >= multiplicity;
        let is_explicit = own.own.characteristics.manifold.implicit.is_empty();
        if !is_alone || !is_explicit || !own.is_smooth() {
            return None;
        }
        let levels = Levels::of(own, about.integrals());
        let others = question.zeros() - multiplicity + own.reduction().dependent.len();
        if levels.jets.len() != others {
            return None;
        }
        let slopes = own.slopes();
        let jacobian = [slopes.clone(), levels.gradients()].concat();
        let n = slopes.len();
        let (vectors, mut nonzero) = kernel(g, &jacobian, n);
        let [direction] = vectors.as_slice() else {
            return None;
        };
        let masses = own.masses();
        // Where the motion goes that the last equation drives: n itself, or the vector that ends in it.
        let driven = match multiplicity {
            1 => direction.clone(),
            _ => {
                let silent = std::iter::repeat_n(g.zero(), others);
                let right = times(g, &masses, direction);
                let right: Vec<Expr> = right.into_iter().chain(silent).collect();
                let found = solution(g, (&jacobian, n), &right)?;
                nonzero.extend(found.divisors);
                found.values
            }
        };
        let transposed: Vec<Vec<Expr>> = (0..n)
            .map(|c| slopes.iter().map(|row| row[c]).collect())
            .collect();
        let (left, further) = kernel(g, &transposed, n);
        nonzero.extend(further);
        let momentum = times(g, &masses, &driven);
        let inertia = |w: &Vec<Expr>| times(g, std::slice::from_ref(w), &momentum)[0];
        let (weights, inertia) = left
            .iter()
            .map(|w| (w, inertia(w)))
            .find(|(_, inertia)| !g.is_zero(*inertia))?;
        nonzero.push(inertia);
        let term = leading(about, &levels, (&jacobian, direction, weights));
        let rate = term
            .as_ref()
            .map_or(g.zero(), |term| closed(g, g.div(term.coefficient, inertia)));
        nonzero.extend(term.iter().flat_map(|term| term.nonzero.clone()));
        Some(Critical {
            levels: levels.text(),
            term,
            rate,
            nonzero,
        })
    }
}

/// The first term of the equation that is left.
fn leading(
    about: &About<'_>,
    levels: &Levels,
    (jacobian, direction, weights): (&[Vec<Expr>], &[Expr], &[Expr]),
) -> Option<Leading> {
    let (g, own) = (about.graph(), &about.expansion);
    let moving = own.moving();
    let n = moving.len();
    let of_levels: Vec<Expr> = levels
        .jets
        .iter()
        .map(|jet| jet.value)
        .collect::<Option<_>>()?;
    let start = own.at(&of_levels);
    let equations = |deviations: &[Expr]| {
        let found = own.beside(&[moving.clone(), of_levels.clone()].concat(), deviations);
        let constant = std::iter::repeat_n(g.zero(), n).chain(start.iter().copied());
        let pairs = found.into_iter().zip(constant);
        pairs.map(|(a, b)| g.sub(a, b)).collect()
    };
    let silent = std::iter::repeat_n(g.zero(), levels.jets.len());
    let weights: Vec<Expr> = weights.iter().copied().chain(silent).collect();
    let branching = Branching {
        graph: g,
        equations: &equations,
        jacobian,
        direction,
        weights: &weights,
    };
    branching.leading()
}
