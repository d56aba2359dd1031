//! The linear equations along a motion, `δz' = A(t) δz`, with their transition matrix.

use crate::error::OrbitError;
use crate::flow::Flow;
use crate::subspace::decomposed;
use crate::variational::{Column, Extended, Order, Variational};
use chetaev_integrate::Output;
use nalgebra::DMatrix;

/// The linear equations at one time.
#[derive(Clone, Debug)]
pub struct Along {
    /// The time.
    pub t: f64,
    /// z.
    pub state: Vec<f64>,
    /// A = ∂f/∂z.
    pub matrix: DMatrix<f64>,
    /// Φ = ∂z(t)/∂z(t₀).
    pub transition: DMatrix<f64>,
}

/// The linear equations along the motion through a state, at the times that `output` asks for.
///
/// # Errors
/// [`OrbitError::EndsEarly`].
pub fn along(
    flow: &Flow,
    start: &[f64],
    span: (f64, f64),
    output: Output,
) -> Result<Vec<Along>, OrbitError> {
    let n = flow.n();
    let columns = (0..n).map(Column::Initial).collect();
    let mut motion = Variational::new(flow, columns, Order::First)?;
    let slopes = flow.graph.jacobian(&flow.rates, &flow.variables).concat();
    let mut slopes = flow.functions(&[("slopes", slopes)])?;
    let from = Extended::start(start, &motion);
    let rows = motion.run(span, &from, output)?;
    let linear = |(t, own): (f64, Extended)| {
        slopes.evaluate(t, &[&own.state])?;
        Ok(Along {
            t,
            matrix: DMatrix::from_row_slice(n, n, slopes.group(0)),
            state: own.state,
            transition: own.first,
        })
    };
    rows.into_iter().map(linear).collect()
}

impl Along {
    /// The rates `ln σ/(t − t₀)` at which the axes of a small ball grow, descending: exponents of Lyapunov for a finite time.
    pub fn exponents(&self, t0: f64) -> Option<Vec<f64>> {
        let time = self.t - t0;
        let found = decomposed(&self.transition).filter(|_| time != 0.0)?;
        Some(found.s.iter().map(|s| s.ln() / time).collect())
    }
}
