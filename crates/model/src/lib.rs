//! What a user states: the model file, its diagnostics and units, and a builder with the same content.
//!
//! [`load`] reads a TOML text (the format is documented in `docs/model-file.md`) into a [`Model`], plain data on one
//! expression graph, and reports every problem of the text at once, each at its place. The crate touches no files:
//! included ones come through [`Files`]. Mechanics is elsewhere: here a constraint is an expression with a name.

mod bodies;
mod builder;
pub mod decision;
mod diagnostic;
mod dimension;
pub mod drawing;
mod expression;
mod format;
mod load;
pub mod mechanism;
pub mod model;
mod overrides;
pub mod raw;
mod render;
mod resolve;
mod source;
mod text;
mod toml;
pub mod units;
mod where_clause;

pub use bodies::kinds;
pub use builder::ModelBuilder;
pub use chetaev_symbolic::syntax::{Relation, Severity};
pub use diagnostic::{Diagnostic, Diagnostics, Suggestion};
pub use format::FORMAT;
pub use load::{load, lowered, reload, tables, Loaded, Tables, FUNCTIONAL};
pub use model::{Model, Precision};
pub use overrides::with_values;
pub use render::{DiagnosticData, PlaceData, RelatedData, Style, SuggestionData};
pub use resolve::name_of_path;
pub use source::{joined, Files, LineColumn, NoFiles, Place, Source, SourceId, Sources};
pub use text::Text;
