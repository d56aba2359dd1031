//! All integration tests of this package in one program, so that the package is linked once.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

mod admission;
mod assumptions;
mod bar;
mod branches;
mod classical;
mod conditions;
mod conjugates;
mod curved;
mod degenerations;
mod dependence;
mod energies;
mod examples;
mod half_known;
mod indexed;
mod inserted;
mod levels;
mod methods;
mod mutants;
mod names;
mod noether;
mod pieces;
mod places;
mod printed;
mod projector;
mod propagation;
mod reference;
mod relations;
mod restrictions;
mod second_variation;
mod singular;
mod smoothness;
mod squares;
mod strata;
mod table;
mod traces;
mod values;
mod wholes;
mod witnesses;

#[path = "../../../../tests/src/extent.rs"]
#[allow(
    dead_code,
    unreachable_pub,
    reason = "public where the tests of the workspace are"
)]
mod extent;
