//! The equations of the fields that are left where what is imposed is put in.

use super::equations::{boundary, euler, Shown};
use chetaev_functionals::claims::reduction::reduced;
use chetaev_functionals::variation::variation;
use chetaev_functionals::Functional;

/// What was put in, and what follows then.
pub(super) struct Substituted {
    /// `v = u,x`.
    pub(super) values: Vec<String>,
    /// The functional of the fields that are left.
    pub(super) functional: Functional,
    /// Its Euler equations.
    pub(super) euler: Vec<Shown>,
    /// Its conditions on pieces of the boundary.
    pub(super) boundary: Vec<(String, Vec<Shown>)>,
}

/// What follows where imposed equations are put in; nothing where none can be, or the variation is not derived.
pub(super) fn substituted(functional: &Functional) -> Option<Substituted> {
    let own = reduced(functional);
    if own.put_in.is_empty() {
        return None;
    }
    let space = &own.functional.space;
    let said = |(component, value): &(usize, _)| {
        format!(
            "{} = {}",
            space.component_at(*component).name,
            space.graph.text(*value)
        )
    };
    let values = own.put_in.iter().map(said).collect();
    let variation = variation(&own.functional).ok()?;
    Some(Substituted {
        values,
        euler: euler(&own.functional, &variation),
        boundary: boundary(&own.functional, &variation),
        functional: own.functional,
    })
}
