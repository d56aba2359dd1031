//! The methods, one file each. Adding one is a file and a line in [`METHODS`].

mod dormand_prince_853;
mod explicit_runge_kutta;
mod runge_kutta_4;
mod taylor;
mod tsitouras_5;

use crate::method::Method;

pub use dormand_prince_853::DORMAND_PRINCE_853;
pub use explicit_runge_kutta::{ErrorEstimate, ExplicitRungeKutta, Row, Tableau};
pub use runge_kutta_4::RUNGE_KUTTA_4;
pub use taylor::TAYLOR;
pub(crate) use taylor::{order_by, radius_of};
pub use tsitouras_5::TSITOURAS_5;

/// Every method, by preference.
pub static METHODS: &[&dyn Method] = &[&DORMAND_PRINCE_853, &TAYLOR, &TSITOURAS_5, &RUNGE_KUTTA_4];

/// The method to take for a tolerance where nothing else is known: order 5 above 10⁻⁶, order 8 from there on.
pub fn recommended(tolerance: f64) -> &'static dyn Method {
    if tolerance > 1e-6 {
        &TSITOURAS_5
    } else {
        &DORMAND_PRINCE_853
    }
}
