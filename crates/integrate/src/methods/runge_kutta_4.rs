//! The classical Runge–Kutta method of order 4, with fixed steps and Hermite dense output of order 3.
//!
//! Source: Kutta 1901; Hairer, Nørsett, Wanner 1993, II.1, table 1.2.

use super::explicit_runge_kutta::{ErrorEstimate, ExplicitRungeKutta, Tableau};
use crate::method::MethodCard;

/// The classical method of order 4; it has no error estimate.
pub static RUNGE_KUTTA_4: ExplicitRungeKutta = ExplicitRungeKutta {
    card: MethodCard {
        name: "runge-kutta-4",
        title: "classical Runge–Kutta method of order 4, fixed steps",
        order: 4,
        dense_order: 3,
        adaptive: false,
        least_tolerance: 0.0,
        needs_series: false,
        source: "Kutta 1901; Hairer, Nørsett, Wanner 1993, II.1",
    },
    tableau: Tableau {
        c: &[0.0, 0.5, 0.5, 1.0, 1.0],
        a: &[&[], &[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
        b: &[
            (0, 1.0 / 6.0),
            (1, 1.0 / 3.0),
            (2, 1.0 / 3.0),
            (3, 1.0 / 6.0),
        ],
        error: ErrorEstimate::None,
        q: 5.0,
        extra: &[],
        dense: &[],
        stability_bound: 2.78,
    },
};
