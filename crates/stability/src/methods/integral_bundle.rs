//! Integrals as a Lyapunov function: bundles with a definite second variation (Routh 1877, Lyapunov 1892, Chetaev 1946; [`bundle`](crate::bundle)).

use crate::about::About;
use crate::bundle::Bundle;
use crate::question::Place;
use crate::real_roots::sign_over;
use crate::theorem::{Answer, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;

/// A combination of integrals has no first variation and a definite second one.
pub(crate) struct IntegralBundle;

impl Method for IntegralBundle {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        let bundles = about.bundles().iter();
        bundles.flat_map(Bundle::functions).collect()
    }

    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        if place == Place::Right {
            return Answer::NotApplicable;
        }
        let sign = |e: Expr| about.question.sign(about.graph(), e, at);
        let mut bundles = about.bundles().iter();
        match bundles.find(|own| own.is_definite(&sign)) {
            Some(own) => stable(own),
            None => Answer::Open(match about.bundles() {
                [] => "no combination of integrals that were found has a vanishing first variation".to_owned(),
                [own] => format!("the second variation of the only combination of integrals without a first one is not definite: {}", own.text),
                list => format!("none of {} combinations of integrals without a first variation has a definite second one", list.len()),
            }),
        }
    }

    fn at_boundary(&self, about: &About<'_>, boundary: &crate::hurwitz::Boundary) -> Answer {
        let Some(symbol) = about.question.over else {
            return Answer::NotApplicable;
        };
        // The value is a zero of some function of some combination, perhaps of none that is needed.
        let sign = |e: Expr| sign_over(about.graph(), e, symbol, &boundary.root);
        let mut bundles = about.bundles().iter();
        bundles
            .find(|own| own.is_definite(&sign))
            .map_or(Answer::NotApplicable, stable)
    }
}

fn stable(own: &Bundle) -> Answer {
    Answer::Stable(format!("by integrals as a Lyapunov function (Routh, Chetaev): with {}, whose first variation vanishes, the second is definite where no integral changes, by Sylvester's criterion", own.text))
}
