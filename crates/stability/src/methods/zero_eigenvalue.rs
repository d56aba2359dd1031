//! One zero eigenvalue, all others left of the axis: Lyapunov's first critical case (Lyapunov 1892, §§ 28–32; Malkin 1952, ch. IV).
//!
//! All equations but the critical one are solved along a curve; on the centre manifold the motion is `x' = c xᵐ + …`, with the first term of what is
//! left. It is unstable where m is even or c positive, and asymptotically stable where m is odd and c negative. Integrals with independent gradients
//! take their zeros out of the question: the theorem speaks of their levels, and what is asymptotically stable on one level stays stable beside it
//! (Malkin 1952, § 70, on perturbations that act constantly).

use crate::about::About;
use crate::branching::HIGHEST;
use crate::critical::{Critical, First};
use crate::question::Place;
use crate::real_roots::bounds_at;
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// One eigenvalue is zero, beside those of the levels of integrals.
pub(crate) struct ZeroEigenvalue;

/// `x' = c xᵐ + …`.
struct Single(Option<Critical>);

fn single(about: &About<'_>) -> Single {
    Single(Critical::of(about, 1))
}

impl Method for ZeroEigenvalue {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        let own = about.once(|| single(about));
        own.0.as_ref().map_or_else(Vec::new, Critical::functions)
    }

    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        if place != Place::OnAxis {
            return Answer::NotApplicable;
        }
        let found = about.once(|| single(about));
        let Some(own) = found.0.as_ref() else {
            return Answer::NotApplicable;
        };
        let g = about.graph();
        let Some(First { order: m, sign }) = own.first(about, at) else {
            return Answer::Open(format!(
                "one eigenvalue is zero{}, and on the centre manifold the motion has no term up to the order {HIGHEST}",
                own.levels
            ));
        };
        let theorem = format!(
            "by Lyapunov's theorem on one zero eigenvalue: all others lie left of the axis{}, and on the centre manifold the motion is x' = c x^{m} + ...",
            own.levels
        );
        let unstable = |why: &str| {
            Answer::Unstable(Instability {
                quantity: format!("c in x' = c x^{m} + ... on the centre manifold"),
                bounds: bounds_at(g, own.rate, about.question.over.zip(at)).unwrap_or_default(),
                why: format!("{theorem} with {why}: the motion is unstable"),
            })
        };
        match sign {
            Some(Ordering::Equal) | None => {
                Answer::Open("the first term on the centre manifold has no sign".into())
            }
            Some(_) if m % 2 == 0 => unstable("an even power"),
            Some(Ordering::Greater) => unstable("a positive c"),
            Some(Ordering::Less) => Answer::Stable(format!(
                "{theorem} with a negative c and an odd power, so that the motion is asymptotically stable{}",
                if own.levels.is_empty() { "" } else { " there, and stable" }
            )),
        }
    }
}
