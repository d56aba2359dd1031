//! Units in which the variables of a flow and their rates are of the size of one.
//!
//! What is small, how far a step goes, and when a residual vanishes are decided in absolute numbers; a system of atoms or of planets is one of
//! these sizes in units of its own. They are powers of two, so that nothing is rounded: those in which the matrix of the linear equations is
//! balanced (Parlett and Reinsch 1969), times the size of the state.

use crate::error::OrbitError;

/// Units of variables and of the time: a variable is its scale times a number, and a time is a number over the rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Units {
    /// Those of the variables.
    pub scale: Vec<f64>,
    /// One over that of the time.
    pub rate: f64,
}

impl Units {
    /// Those that a flow has as it stands.
    pub(crate) fn ones(n: usize) -> Units {
        Units {
            scale: vec![1.0; n],
            rate: 1.0,
        }
    }

    /// A state in these units.
    pub fn packed(&self, state: &[f64]) -> Vec<f64> {
        state.iter().zip(&self.scale).map(|(x, s)| x / s).collect()
    }

    /// A state that is given in these units.
    pub fn unpacked(&self, state: &[f64]) -> Vec<f64> {
        state.iter().zip(&self.scale).map(|(x, s)| x * s).collect()
    }

    /// An error with times as they are.
    pub fn restored_error(&self, problem: OrbitError) -> OrbitError {
        match problem {
            OrbitError::NoReturn { end } => OrbitError::NoReturn {
                end: end / self.rate,
            },
            OrbitError::EndsEarly { t, end, stop } => OrbitError::EndsEarly {
                t: t / self.rate,
                end: end / self.rate,
                stop,
            },
            other => other,
        }
    }
}
