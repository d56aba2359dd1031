//! Constraints of order m ≥ 2: lifting to one order, the system of ordinary differential equations they determine, the
//! initial data it needs and the integrals it carries (T2 §2, §5).

pub mod determined;
pub mod lifting;
pub mod reduced;
pub(crate) mod structure;

use crate::system::System;
use chetaev_symbolic::Expr;

/// The highest derivative of a coordinate that occurs in `es`, by their form; `None` where no coordinate does.
pub fn highest_derivative(system: &System, es: &[Expr]) -> Option<u32> {
    let g = &system.graph;
    let symbols = g.symbols_in(es).into_iter();
    symbols
        .filter(|&s| system.coordinate_index(g.symbol_name(s)).is_some())
        .map(|s| g.symbol_order(s))
        .max()
}
