//! Studies of functionals for people and programs: the summary, the record and the report.

mod derivation;
mod equations;
mod flat;
mod pace;
mod page;
mod pictures;
mod record;
mod selection;
mod substitution;
mod summary;
mod table;
mod typesetting;
mod verification;

pub use derivation::derivation;
pub use pace::studied;
pub use page::page;
pub use record::record;
pub use selection::{is_selected, selected, UnknownClaim};
pub use summary::summary;
pub use verification::verify;
