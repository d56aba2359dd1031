//! The equations of the fields that are left where what is imposed is put in.

use super::equations::{boundary, euler, Shown};
use chetaev_functionals::claims::reduction::reduced;
use chetaev_functionals::variation::variation;
use chetaev_functionals::Functional;
use chetaev_symbolic::Expr;

/// What was put in, and what follows then.
pub(super) struct Substituted {
    /// Components with what stands for them.
    pub(super) values: Vec<(usize, Expr)>,
    /// The functional of the fields that are left.
    pub(super) functional: Functional,
    /// Its Euler equations.
    pub(super) euler: Vec<Shown>,
    /// Its conditions on pieces of the boundary.
    pub(super) boundary: Vec<(String, Vec<Shown>)>,
}

impl Substituted {
    /// `v = u,x`.
    pub(super) fn texts(&self) -> Vec<String> {
        let all = self.named().into_iter();
        all.map(|(name, value)| format!("{name} = {value}"))
            .collect()
    }

    /// `v` with `u,x`.
    pub(super) fn named(&self) -> Vec<(String, String)> {
        let space = &self.functional.space;
        let values = self.values.iter();
        let texts = values.map(|&(component, value)| {
            let name = space.component_at(component).name;
            (name, space.graph.text(value))
        });
        texts.collect()
    }

    /// `v` with `v - u,x`, which vanishes.
    pub(super) fn shown(&self) -> Vec<Shown> {
        let space = &self.functional.space;
        let values = self.values.iter();
        let shown = values.map(|&(component, value)| Shown {
            of: space.component_at(component).name,
            value: space.graph.sub(space.jet(component, &[]), value),
        });
        shown.collect()
    }
}

/// What follows where imposed equations are put in; nothing where none can be, or the variation is not derived.
pub(super) fn substituted(functional: &Functional) -> Option<Substituted> {
    let own = reduced(functional);
    if own.put_in.is_empty() {
        return None;
    }
    let variation = variation(&own.functional).ok()?;
    Some(Substituted {
        values: own.put_in,
        euler: euler(&own.functional, &variation),
        boundary: boundary(&own.functional, &variation),
        functional: own.functional,
    })
}
