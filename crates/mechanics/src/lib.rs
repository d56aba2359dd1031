//! A constrained system, the registry of claims, and the equations of motion that follow.
//!
//! - The system: [`system`], [`constraint`], [`particles`], [`bodies`], [`mass`] (masses that vary, thrust), [`order`] (constraints of order m);
//! - what is derived once: [`terms`] (`W, b, J, g`, and the accelerations with multipliers that they determine), [`selection`] (independent constraints and velocities), [`frame`],
//!   [`characteristics`], [`curvature`], [`linear`];
//! - the forms of the equations: [`formulations`], one file each, which deliver [`equations`] with a [`card`], and their derivation in [`steps`];
//! - claims: [`claims`] (registry, context, the claims of model, hypotheses and formulations), [`prover`] (the bridge to zero tests);
//! - the set where all constraints hold: [`positions`] (what finite ones determine);
//! - constraints that are special: [`redundancy`] (they follow from others, or contradict them), [`multiplicity`] (their gradients are dependent
//!   wherever they hold), [`components`] (they are products);
//! - for computing and reading: [`regular`] (quasi-velocities without singular places), [`speeds`] (those a person would choose),
//!   [`reduced_equations`], [`choice`];
//! - [`sample`]: states for heuristic choices, evidence only where a verdict says `numerical`.

pub mod bodies;
pub mod card;
pub mod characteristics;
pub mod choice;
pub mod claims;
pub mod components;
pub mod constraint;
pub mod counterexample;
pub mod curvature;
mod elimination;
pub mod equations;
pub mod formulations;
pub mod frame;
mod from_model;
pub mod linear;
pub mod mass;
pub mod memo;
pub mod multiplicity;
mod names;
pub mod order;
pub mod particles;
pub mod positions;
pub mod prover;
mod quadratic_forms;
mod radicals;
pub mod reduced_equations;
pub mod redundancy;
pub mod regular;
mod restricted;
pub mod sample;
pub mod selection;
pub mod speeds;
mod stated;
pub mod steps;
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
pub use system::{SteadyMotion, System, SystemError, SystemParts};
pub use terms::MotionTerms;
