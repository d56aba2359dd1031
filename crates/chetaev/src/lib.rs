//! The workbench for analytical mechanics with nonholonomic constraints.
//!
//! ```
//! use chetaev::model::ModelBuilder;
//! use chetaev::study::{study, Hooks, StudyOptions};
//!
//! let loaded = ModelBuilder::new("particle")
//!     .coordinates(["x", "y", "z"])
//!     .parameter("m", "1.7")
//!     .kinetic("1/2 m (x'^2 + y'^2 + z'^2)")
//!     .constraint("rolling", "z' = y x'")
//!     .initial("y", "0.4")
//!     .initial("x'", "0.8")
//!     .initial("y'", "1.1")
//!     .end("2")
//!     .build();
//! let (model, _) = loaded.into_result().map_err(|d| d.render(chetaev::model::Style::Plain))?;
//! let mut hooks = Hooks { clock: &|| 0.0, interrupt: None, progress: &mut |_, _| {} };
//! let result = study(model, StudyOptions::default(), &mut hooks).map_err(|e| e.to_string())?;
//! let maggi = result.verdicts.iter().find(|d| d.full_id() == "formulation.equivalent#maggi");
//! assert_eq!(maggi.map(|d| d.finding.verdict.word()), Some("proved"));
//! # Ok::<(), String>(())
//! ```

pub mod checker;
pub mod disk;
pub mod files;
pub mod store;

pub use chetaev_compile as compile;
pub use chetaev_ensemble as ensemble;
pub use chetaev_functionals as functionals;
pub use chetaev_geometry as geometry;
pub use chetaev_import as import;
pub use chetaev_integrals as integrals;
pub use chetaev_integrate as integrate;
pub use chetaev_mechanics as mechanics;
pub use chetaev_model as model;
pub use chetaev_motion as motion;
pub use chetaev_orbits as orbits;
pub use chetaev_principles as principles;
pub use chetaev_stability as stability;
pub use chetaev_study as study;
pub use chetaev_symbolic as symbolic;
