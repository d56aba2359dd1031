//! A constrained system, the registry of claims, and the equations of motion that follow.

pub mod card;
pub mod characteristics;
pub mod choice;
pub mod claims;
pub mod components;
pub mod constraint;
pub mod curvature;
pub mod equations;
pub mod formulations;
pub mod frame;
mod from_model;
pub mod linear;
pub mod mass;
pub mod order;
pub mod particles;
pub mod prover;
mod quadratic_forms;
mod radicals;
pub mod redundancy;
mod restricted;
pub mod sample;
pub mod selection;
mod stated;
pub mod system;
pub mod terms;
pub mod words;

pub use characteristics::{Characteristics, Manifold, Selection};
pub use claims::{Claim, Context, Finding, Formula, Group, Prepared, Registry};
pub use constraint::{Constraint, ConstraintKind};
pub use equations::Equations;
pub use formulations::{formulation, Basis, Formulation, Identity, FORMULATIONS};
pub use frame::Frame;
pub use prover::Prover;
pub use redundancy::LeftOut;
pub use system::{System, SystemError, SystemParts};
pub use terms::MotionTerms;
