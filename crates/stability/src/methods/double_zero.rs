//! Two zero eigenvalues with one eigenvector, all others left of the axis (Lyapunov 1893; Andreev 1958).
//!
//! On the centre manifold the motion is `x' = y`, `y' = c xᵐ + …` where y = 0. Where m is even the equilibrium has a cusp or is a saddle and node in one, and where
//! m is odd and c positive it is a saddle (Dumortier, Llibre, Artés 2006, theorem 3.5): unstable. Where m is odd and c negative further terms decide.

use crate::about::About;
use crate::critical::{Critical, First};
use crate::question::Place;
use crate::real_roots::bounds_at;
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// A chain of two zero eigenvalues, beside those of the levels of integrals.
pub(crate) struct DoubleZero;

/// `x' = y`, `y' = c xᵐ + …`.
struct Chain(Option<Critical>);

fn chain(about: &About<'_>) -> Chain {
    Chain(Critical::of(about, 2))
}

impl Method for DoubleZero {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        let own = about.once(|| chain(about));
        own.0.as_ref().map_or_else(Vec::new, Critical::functions)
    }

    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        if place != Place::OnAxis {
            return Answer::NotApplicable;
        }
        let found = about.once(|| chain(about));
        let Some(own) = found.0.as_ref() else {
            return Answer::NotApplicable;
        };
        let g = about.graph();
        let Some(First { order: m, sign }) = own.first(about, at) else {
            return Answer::NotApplicable;
        };
        match sign {
            Some(Ordering::Greater) => {}
            Some(Ordering::Less) if m % 2 == 0 => {}
            Some(Ordering::Less) => {
                return Answer::Open(format!("two eigenvalues are zero with one eigenvector{}, and on the centre manifold the motion is x' = y, y' = c x^{m} + ... with a negative c and an odd power, where further terms decide", own.levels));
            }
            Some(Ordering::Equal) | None => return Answer::NotApplicable,
        }
        let shape = if m % 2 == 0 {
            "an even power"
        } else {
            "a positive c"
        };
        Answer::Unstable(Instability {
            quantity: format!("c in x' = y, y' = c x^{m} + ... on the centre manifold"),
            bounds: bounds_at(g, own.rate, about.question.over.zip(at)).unwrap_or_default(),
            why: format!("by the theorem of Lyapunov and Andreev on two zero eigenvalues with one eigenvector: all others lie left of the axis{}, and on the centre manifold the motion is x' = y, y' = c x^{m} + ... with {shape}: the motion is unstable", own.levels),
        })
    }
}
