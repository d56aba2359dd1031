//! First integrals: their search, their symmetries and generators (T3 §6–7).

mod algebraic;
pub mod ansatz;
mod automatic;
pub mod claims;
mod conjugate;
mod constants;
mod critical;
mod dependence;
mod eigenfunctions;
pub mod embedded;
pub mod family;
pub mod found;
pub mod generator;
pub mod killing;
pub mod letters;
mod lift;
mod lifting;
pub mod motion;
pub mod moving;
pub(crate) mod occurring;
mod plain;
mod powers;
pub mod reduced;
pub mod search;
mod shorter;
pub(crate) mod shown;
pub mod special;
