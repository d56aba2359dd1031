//! The native part of the Python package: models, what is computed of them, and compiled functions.
//!
//! Python code in `python/chetaev` is the face of it. What stands here returns plain data: texts, JSON, NumPy arrays.
//!
//! - `model`: a model read from texts, and every question asked of it; `outcome`: a study; `linear`: linear equations; `compiled`: its equations as a function, `address`: the same for callers that know C only; `sweep`: many trajectories; `functional`: a functional over space;
//! - `annotations`: what the stub says of functions and arrays; `waiting`: long work beside a thread that hears Ctrl-C and shows progress; `problem`: exceptions.

mod address;
mod annotations;
mod compiled;
mod functional;
mod linear;
mod model;
mod outcome;
mod problem;
mod program;
mod sweep;
mod texts;
mod waiting;

use pyo3::prelude::*;

/// What `chetaev` is made of; the package in `python/chetaev` is its face.
#[pymodule(gil_used = false)]
mod chetaev_native {
    #[pymodule_export]
    use crate::compiled::{Compiled, Function};
    #[pymodule_export]
    use crate::functional::Functional;
    #[pymodule_export]
    use crate::linear::Linear;
    #[pymodule_export]
    use crate::model::{checker, explain, gallery, robot, verify, Model};
    #[pymodule_export]
    use crate::outcome::Outcome;
    #[pymodule_export]
    use crate::sweep::Sweep;

    /// The version of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
