//! Every formulation against the examples of the notes on the theory, one file for each.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    unreachable_pub,
    dead_code,
    reason = "test code fails where it stands, and not every file uses every helper"
)]

mod acceptance_canonical;
mod acceptance_embedding;
mod acceptance_frames;
mod acceptance_higher_order;
mod acceptance_mass;
mod acceptance_motion;
mod acceptance_order;
mod acceptance_state_space;
mod acceptance_support;
mod acceptance_variation;
mod acceptance_volterra;
mod acceptance_volterra_higher;
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
