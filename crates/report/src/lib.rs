//! Renders plain data as one self-contained HTML page, and its moving picture as files; knows no mechanics.
//!
//! [`data`] says what a page can hold, [`render`] writes it; [`picture`] draws the moving picture as SVG, PNG and GIF. The page is one file without a
//! request to anything outside: style, script, formulas and numbers are in it, and its content
//! security policy forbids the rest. Every word a reader sees is either in the data or in the
//! table of its [`Language`].
//!
//! ```
//! use chetaev_report::{data::Report, render};
//!
//! let report = Report { title: "Skate <level>".into(), ..Report::default() };
//! assert!(render(&report).contains("<h1>Skate &lt;level&gt;</h1>"));
//! ```

mod breaking;
mod claims;
pub mod data;
mod digest;
mod equations;
mod figure;
mod html;
mod maps;
mod mathml;
mod motion;
mod number;
mod page;
mod payload;
pub mod picture;
mod prose;
mod scene;
mod source;
mod system;
mod tables;
mod thinning;
mod words;

pub use data::Report;
pub use html::escaped;
pub use words::Language;

/// The page in English.
#[must_use]
pub fn render(report: &Report) -> String {
    render_in(report, Language::English)
}

/// The page, its own words in the given language; the words of the data stay as they are.
#[must_use]
pub fn render_in(report: &Report, language: Language) -> String {
    page::page(report, language.words())
}
