//! No eigenvalue lies right of the axis, and those on it are semisimple.

use crate::about::{About, Said, Statement};
use crate::evidence::{counted, unstable};
use crate::multiplicity::{defects, where_kernels_grow, Defect};
use crate::question::Place;
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;

/// `stability.linear#j`: none lies right of the axis, and those on it are semisimple.
#[derive(Clone, Copy, Debug)]
pub struct Linear;

/// What a bounded linear motion does not say.
const NO_MORE: &str = "of the nonlinear motion that says nothing by itself";

impl Statement for Linear {
    fn id(&self) -> &'static str {
        "stability.linear"
    }

    fn title(&self) -> &'static str {
        "All solutions of the linear equations about the steady motion stay bounded"
    }

    fn explanation(&self) -> &'static str {
        include_str!("linear.md")
    }

    fn said(&self, about: &About<'_>, place: Place, _: Option<&RBig>) -> Said {
        match place {
            Place::Left if about.question.linear.family > 0 => Said::Holds("all eigenvalues but the zeros of the family lie left of the axis, and these have as many eigenvectors as the family has dimensions".into()),
            Place::Left => Said::Holds("all eigenvalues lie left of the axis".into()),
            Place::Right => Said::Fails,
            Place::NotLeft => Said::Open("a Hurwitz determinant vanishes: eigenvalues lie on the axis, or are mirror images of each other".into()),
            // Inside of an interval multiplicities do not change, and no kernel grows, so that what is said of general values is so throughout.
            Place::OnAxis => match defects(about.graph(), &about.question, None) {
                Some(list) if list.is_empty() => Said::Holds(format!("no eigenvalue lies right of the axis, and those on it have as many eigenvectors as their multiplicity; {NO_MORE}")),
                Some(_) => Said::Fails,
                None => Said::Open("the rank of an exact matrix was not decided".into()),
            },
        }
    }

    fn further(&self, about: &About<'_>) -> Vec<Expr> {
        match about.question.place_of_left() {
            Place::OnAxis => where_kernels_grow(about.graph(), &about.question),
            _ => Vec::new(),
        }
    }

    fn looks_at_boundaries(&self) -> bool {
        true
    }

    fn counterexample(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Counterexample {
        if place == Place::Right {
            return unstable(about, at);
        }
        let list = defects(about.graph(), &about.question, at).unwrap_or_default();
        let chain = |own: &Defect| match own.factor {
            None => format!(
                "the eigenvalue 0 has multiplicity {} and {} eigenvectors",
                own.multiplicity, own.chains
            ),
            Some(_) => format!(
                "an imaginary pair has multiplicity {} and {} eigenvectors",
                own.multiplicity, own.chains
            ),
        };
        let chains: Vec<String> = list.iter().map(chain).collect();
        let missing = list.iter().map(|own| own.multiplicity - own.chains).sum();
        counted(
            "the number of eigenvectors on the axis that are missing",
            missing,
            format!(
                "{}: solutions of the linear equations grow as a power of the time, and {NO_MORE}",
                chains.join(", ")
            ),
        )
    }
}
