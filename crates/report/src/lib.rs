//! Renders plain data as one self-contained HTML page; knows no mechanics.

pub mod data;
mod number;
mod scene;

pub use data::Report;

/// The page: one HTML file that makes no request to anything outside itself.
#[must_use]
pub fn render(report: &Report) -> String {
    report.title.clone()
}
