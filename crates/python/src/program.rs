//! Expressions as machine code, with storage for one thread.

use chetaev::compile::{Backend, EvaluateFailure, Evaluator, Workspace};

/// Expressions as machine code.
pub(crate) struct Program {
    pub(crate) backend: Backend,
    /// Number of components of the state.
    pub(crate) width: usize,
    /// Shape of the values at one state.
    pub(crate) shape: Vec<usize>,
    /// Where the values that are not zero identically belong.
    pub(crate) places: Vec<usize>,
}

/// Storage of one thread.
pub(crate) struct Ready {
    pub(crate) workspace: Workspace,
    pub(crate) inputs: Vec<f64>,
    pub(crate) computed: Vec<f64>,
    pub(crate) values: Vec<f64>,
}

impl Program {
    /// Number of components of the state.
    pub(crate) fn width(&self) -> usize {
        self.width
    }

    /// Number of values at one state.
    pub(crate) fn size(&self) -> usize {
        self.shape.iter().product()
    }

    /// Storage for these values of the parameters.
    ///
    /// # Errors
    /// A matrix of parameters alone is singular.
    pub(crate) fn ready(&self, parameters: &[f64]) -> Result<Ready, EvaluateFailure> {
        let mut workspace = self.backend.workspace();
        self.backend.prepare(parameters, &mut workspace)?;
        Ok(Ready {
            workspace,
            inputs: vec![0.0; self.width + 1],
            computed: vec![0.0; self.places.len()],
            values: vec![0.0; self.size()],
        })
    }

    /// The values at a state; not a number where there are none.
    pub(crate) fn at<'a>(
        &self,
        ready: &'a mut Ready,
        t: f64,
        y: impl Iterator<Item = f64>,
    ) -> &'a [f64] {
        ready.inputs[0] = t;
        for (own, y) in ready.inputs[1..].iter_mut().zip(y) {
            *own = y;
        }
        let done = self
            .backend
            .evaluate(&ready.inputs, &mut ready.workspace, &mut ready.computed);
        if done.is_err() {
            ready.computed.fill(f64::NAN);
        }
        for (&place, &value) in self.places.iter().zip(&ready.computed) {
            ready.values[place] = value;
        }
        &ready.values
    }
}
