//! Every formulation against the examples of the theory notes, one file for each.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    unreachable_pub,
    dead_code,
    reason = "test code fails where it stands, and not every file uses every helper"
)]

mod canonical;
mod canonical_reduced;
mod chaplygin;
mod common;
mod corrections;
mod frames;
mod gauss;
mod gibbs_appell;
mod hypotheses;
mod jacobi;
mod kane;
mod lagrange_dalembert;
mod maggi;
mod nielsen;
mod parametric;
mod parametric_canonical;
mod particles;
mod state_space;
mod state_space_canonical;
mod states;
mod vakonomic;
mod volterra;
mod volterra_cartesian;
mod voronets;
