//! First integrals: their search, their symmetries and generators (T3 §6–7).

pub mod ansatz;
pub mod claims;
pub mod embedded;
pub mod family;
pub mod found;
pub mod generator;
pub mod killing;
mod lift;
pub mod motion;
pub mod moving;
pub mod occurring;
pub mod reduced;
pub mod search;
