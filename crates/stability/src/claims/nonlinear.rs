//! The motion itself is stable.

use crate::about::{About, Said, Statement};
use crate::hurwitz::Boundary;
use crate::methods::METHODS;
use crate::question::Place;
use crate::theorem::{Answer, Instability};
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;

/// `stability.nonlinear#j`: the motion itself is stable, not its linear equations alone.
#[derive(Clone, Copy, Debug)]
pub struct Nonlinear;

impl Statement for Nonlinear {
    fn id(&self) -> &'static str {
        "stability.nonlinear"
    }

    fn title(&self) -> &'static str {
        "The steady motion is stable in the sense of Lyapunov"
    }

    fn explanation(&self) -> &'static str {
        include_str!("nonlinear.md")
    }

    fn said(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Said {
        let mut open = Vec::new();
        for method in METHODS {
            match method.answer(about, place, at) {
                Answer::Stable(why) => return Said::Holds(why),
                Answer::Unstable(_) => return Said::Fails,
                Answer::Open(why) => open.push(why),
                Answer::NotApplicable => {}
            }
        }
        Said::Open(format!(
            "the linear equations decide nothing where eigenvalues lie on the axis, and {}",
            open.join("; ")
        ))
    }

    fn looks_at_boundaries(&self) -> bool {
        true
    }

    fn uses_integrals(&self) -> bool {
        true
    }

    fn is_witnessed(&self) -> bool {
        true
    }

    fn further(&self, about: &About<'_>) -> Vec<Expr> {
        // Where all eigenvalues lie left of the axis nothing else is needed.
        match about.question.place_of_left() {
            Place::Left => Vec::new(),
            _ => METHODS
                .iter()
                .flat_map(|own| own.functions(about))
                .collect(),
        }
    }

    fn at_boundary(&self, about: &About<'_>, boundary: &Boundary) -> Option<Said> {
        let mut answers = METHODS.iter().map(|own| own.at_boundary(about, boundary));
        answers.find_map(|own| match own {
            Answer::Stable(why) => Some(Said::Holds(why)),
            Answer::Unstable(_) => Some(Said::Fails),
            Answer::Open(_) | Answer::NotApplicable => None,
        })
    }

    fn counterexample(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Counterexample {
        let mut answers = METHODS.iter().map(|own| own.answer(about, place, at));
        let found = answers.find_map(|own| match own {
            Answer::Unstable(found) => Some(found),
            _ => None,
        });
        let Instability {
            quantity,
            bounds,
            why,
        } = found.unwrap_or_default();
        Counterexample {
            point: Vec::new(),
            quantity,
            residual: bounds,
            detail: why,
        }
    }
}
