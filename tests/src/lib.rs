//! Helpers shared by the integration tests: the published cases, the gallery, the command line.
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "test code fails where it stands"
)]

pub mod cases;
pub mod checks;
pub mod citations;
pub mod extent;
pub mod functional;
pub mod lines;
pub mod literature;
pub mod pages;
pub mod places;
pub mod program;
pub mod rejections;
pub mod runs;
pub mod schema;
pub mod searched;
pub mod studied;
pub mod words;
