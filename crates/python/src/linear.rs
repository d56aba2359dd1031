//! Linear equations about a steady motion, and their stability.

use chetaev::study::stability::Stability;
use pyo3::exceptions::PyOSError;
use pyo3::prelude::*;

/// The answer to `linearize` and `stability`.
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Linear {
    found: Stability,
}

impl Linear {
    pub(crate) fn new(found: Stability) -> Linear {
        Linear { found }
    }
}

#[pymethods]
impl Linear {
    /// All of it as JSON.
    fn json(&self) -> String {
        self.found.json().to_string()
    }

    /// Linear equations, polynomial and eigenvalues in words.
    fn equations(&self) -> String {
        self.found.linear_text()
    }

    /// Stability in words.
    fn ranges(&self) -> String {
        self.found.ranges_text()
    }

    /// Eigenvalues over the range as SVG; none without a range.
    fn picture(&self) -> Option<String> {
        self.found.picture()
    }

    /// The matrices in LaTeX.
    fn latex(&self) -> String {
        self.found.latex()
    }

    /// The matrices in numbers as a NumPy archive.
    fn npz(&self) -> PyResult<Vec<u8>> {
        let archive = self.found.matrices().to_npz();
        archive.map_err(|problem| PyOSError::new_err(problem.to_string()))
    }

    /// The matrices in numbers as a file of MATLAB.
    fn mat(&self) -> Vec<u8> {
        self.found.matrices().to_mat()
    }

    /// The matrices in numbers as a program for python-control.
    fn control(&self) -> String {
        self.found.matrices().to_python()
    }
}
