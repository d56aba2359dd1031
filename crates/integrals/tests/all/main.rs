//! The tests of this crate, as one program.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

mod common;
mod literature;
