//! The linear equations along a motion, `δz' = A(t) δz`, with their transition matrix.

use crate::error::OrbitError;
use crate::flow::Flow;
use crate::subspace::{decomposed, kernel, nullity};
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
    /// Directions of δz(t₀) that finite constraints admit, an orthonormal basis as columns.
    pub admitted: DMatrix<f64>,
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
    let admitted = admitted(flow, start)?;
    let rows = motion.run(span, &from, output)?;
    let linear = |(t, own): (f64, Extended)| {
        slopes.evaluate(t, &[&own.state])?;
        Ok(Along {
            t,
            matrix: DMatrix::from_row_slice(n, n, slopes.group(0)),
            state: own.state,
            transition: own.first,
            admitted: admitted.clone(),
        })
    };
    rows.into_iter().map(linear).collect()
}

/// A gradient below this part of the largest depends on the others.
const DEPENDENT: f64 = 1e-9;

/// The directions along which finite constraints stay satisfied at a state.
fn admitted(flow: &Flow, state: &[f64]) -> Result<DMatrix<f64>, OrbitError> {
    let n = flow.n();
    let rows = flow.graph.jacobian(&flow.finite, &flow.variables).concat();
    let mut gradients = flow.functions(&[("gradients", rows)])?;
    gradients.evaluate(0.0, &[state])?;
    let matrix = DMatrix::from_row_slice(flow.finite.len(), n, gradients.group(0));
    let free = if matrix.is_empty() {
        n
    } else {
        nullity(&matrix, DEPENDENT)
    };
    if free == n {
        return Ok(DMatrix::identity(n, n));
    }
    kernel(&matrix, free).ok_or(OrbitError::NoEigenvalues)
}

impl Along {
    /// The rates `ln σ/(t − t₀)` at which the axes of a small ball of admissible states grow, descending: exponents of Lyapunov for a finite time.
    pub fn exponents(&self, t0: f64) -> Option<Vec<f64>> {
        let time = self.t - t0;
        let count = self.admitted.ncols();
        let found = decomposed(&(&self.transition * &self.admitted)).filter(|_| time != 0.0)?;
        Some(found.s.iter().take(count).map(|s| s.ln() / time).collect())
    }
}
