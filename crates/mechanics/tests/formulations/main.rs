//! Every formulation against the examples of the theory notes, one file for each.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    unreachable_pub,
    dead_code,
    reason = "test code fails where it stands, and not every file uses every helper"
)]

mod canonical;
mod chaplygin;
mod common;
mod frames;
mod lagrange_dalembert;
mod maggi;
mod state_space;
mod state_space_canonical;
mod states;
mod volterra;
mod volterra_cartesian;
mod voronets;
