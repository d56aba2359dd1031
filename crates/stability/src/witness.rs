//! What runs beside a motion say where theory decides nothing: a layer that knows trajectories makes them.

use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};

/// Says in words, without a full stop, what became of motions that begin near a steady one; `None` where none was computed.
pub type PerturbedRuns = fn(&System, &MotionTerms, &Selection, &SteadyMotion) -> Option<String>;

/// Data of a context by which claims get a witness.
#[derive(Clone, Copy, Debug)]
pub struct RunsBeside(pub PerturbedRuns);
