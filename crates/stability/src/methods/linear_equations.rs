//! Equations that are linear themselves: what a motion beside the steady one differs by is a solution of the linear equations, however large it is.

use crate::about::About;
use crate::multiplicity::{defects, where_kernels_grow};
use crate::question::Place;
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;

/// The linear equations are the whole ones.
pub(crate) struct LinearEquations;

/// Whether they are.
struct IsLinear(bool);

impl Method for LinearEquations {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        if is_linear(about) {
            where_kernels_grow(about.graph(), &about.question)
        } else {
            Vec::new()
        }
    }

    fn answer(&self, about: &About<'_>, place: Place, _: Option<&RBig>) -> Answer {
        if place != Place::OnAxis || !is_linear(about) {
            return Answer::NotApplicable;
        }
        // Inside of an interval no kernel grows.
        let Some(list) = defects(about.graph(), &about.question, None) else {
            return Answer::NotApplicable;
        };
        let missing: usize = list.iter().map(|own| own.multiplicity - own.chains).sum();
        if missing == 0 {
            return Answer::Stable("the equations of motion are linear themselves: no eigenvalue lies right of the axis, and those on it have as many eigenvectors as their multiplicity".into());
        }
        Answer::Unstable(Instability {
            quantity: "the number of eigenvectors on the axis that are missing".into(),
            bounds: (missing.to_string(), missing.to_string()),
            why: "the equations of motion are linear themselves, and an eigenvalue on the axis has fewer eigenvectors than its multiplicity: motions that begin beside the steady one grow with a power of the time".into(),
        })
    }
}

/// Whether the rates of all variables are linear in them.
fn is_linear(about: &About<'_>) -> bool {
    about.once(|| IsLinear(has_linear_rates(about))).0
}

fn has_linear_rates(about: &About<'_>) -> bool {
    let (g, own) = (about.graph(), &about.expansion);
    let implicit = &own.own.characteristics.manifold.implicit;
    let is_open = own.finite().is_empty() && implicit.is_empty();
    let rates = own.own.equations.rates(g).filter(|_| is_open);
    rates.is_some_and(|rates| {
        let rates = [own.own.rates.clone(), rates].concat();
        let rates = g.substitute_all(&rates, &own.controls(&rates));
        let rates = g.substitute_all(&rates, &own.values);
        let variables = own.variables();
        let slopes = g.jacobian(&rates, &variables).concat();
        let changes = g.jacobian(&slopes, &variables).concat();
        changes.iter().all(|&e| g.is_zero(e))
    })
}
