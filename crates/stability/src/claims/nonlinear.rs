//! The motion itself is stable.

use crate::decision::{About, Said, Statement};
use crate::evidence::unstable;
use crate::isolation::Root;
use crate::question::Place;
use crate::real_roots::sign_over;
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
        let (g, question) = (about.graph(), &about.question);
        if place == Place::Right {
            return Said::Fails;
        }
        if place == Place::Left {
            return Said::Holds(by_eigenvalues(question.linear.family));
        }
        let sign = |e: Expr| question.sign(g, e, at);
        let mut bundles = about.bundles().iter();
        match bundles.find(|own| own.is_definite(&sign)) {
            Some(own) => Said::Holds(format!("by integrals as a Lyapunov function (Routh, Chetaev): with {}, whose first variation vanishes, the second is definite where no integral changes, by Sylvester's criterion", own.text)),
            None => Said::Open(format!(
                "the linear equations decide nothing where eigenvalues lie on the axis, and {}",
                match about.bundles() {
                    [] => "no combination of integrals that were found has a vanishing first variation".to_owned(),
                    [own] => format!("the second variation of the only combination of integrals without a first one is not definite: {}", own.text),
                    list => format!("none of {} combinations of integrals without a first variation has a definite second one", list.len()),
                }
            )),
        }
    }

    fn is_witnessed(&self) -> bool {
        true
    }

    fn further(&self, about: &About<'_>) -> Vec<Expr> {
        // Where all eigenvalues lie left of the axis integrals are not needed.
        match about.question.place(true) {
            Place::Left => Vec::new(),
            _ => about
                .bundles()
                .iter()
                .flat_map(|own| own.functions().collect::<Vec<_>>())
                .collect(),
        }
    }

    fn holds_throughout(&self, about: &About<'_>, root: &Root) -> bool {
        let Some(symbol) = about.question.over else {
            return false;
        };
        // The value is a zero of some function of some combination, perhaps of none that is needed.
        let sign = |e: Expr| sign_over(about.graph(), e, symbol, root);
        about.bundles().iter().any(|own| own.is_definite(&sign))
    }

    fn counterexample(&self, about: &About<'_>, _: Place, at: Option<&RBig>) -> Counterexample {
        unstable(about, at)
    }
}

/// What follows where all transversal eigenvalues lie left of the axis.
fn by_eigenvalues(family: usize) -> String {
    match family {
        0 => "by Lyapunov's first method: all eigenvalues lie left of the axis, and the motion is asymptotically stable".into(),
        n => format!("by the theorem of Lyapunov and Malkin: all eigenvalues but the {n} of the family of steady motions lie left of the axis, so that the motion is stable and its neighbours tend to members of the family"),
    }
}
