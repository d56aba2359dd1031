//! Taylor series of the motion: the coefficients of a state whose rates are expressions.

use crate::functions::{failure, FunctionsError};
use crate::numeric::Binding;
use chetaev_compile::{Lowering, Taylor, TaylorWorkspace};
use chetaev_integrate::EvaluationFailure;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// The rates of a state (z₁, …, z_m), functions of (t, z), by their Taylor recurrences.
#[derive(Clone, Debug)]
pub(crate) struct RateSeries {
    taylor: Taylor,
    workspace: TaylorWorkspace,
    parameters: Vec<f64>,
    /// t and the state: the coefficients of one order.
    inputs: Vec<f64>,
}

impl RateSeries {
    /// The recurrences of `rates` over `variables`, the first of which is the time and the others the state.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn new(
        g: &Graph,
        binding: &Binding,
        variables: &[Symbol],
        rates: &[Expr],
    ) -> Result<RateSeries, FunctionsError> {
        let (symbols, parameters): (Vec<Symbol>, Vec<f64>) =
            binding.parameters.iter().copied().unzip();
        let program = Lowering::new(g)
            .variables(variables)
            .parameters(&symbols)
            .output("rates", &g.substitute_all(rates, &binding.controls))
            .lower()?;
        let taylor = Taylor::new(&program)?;
        let mut series = RateSeries {
            workspace: taylor.workspace(0),
            inputs: vec![0.0; variables.len()],
            taylor,
            parameters,
        };
        series.make_room(24)?;
        Ok(series)
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.parameters.clear();
        self.parameters.extend_from_slice(values);
        Ok(self.taylor.prepare(values, &mut self.workspace)?)
    }

    fn make_room(&mut self, order: usize) -> Result<(), FunctionsError> {
        self.workspace = self.taylor.workspace(order);
        Ok(self.taylor.prepare(&self.parameters, &mut self.workspace)?)
    }

    /// Writes z_[0], …, z_[order] through (t, z), one after the other.
    ///
    /// # Errors
    /// Why the rates have no Taylor series there.
    pub(crate) fn expand(
        &mut self,
        t: f64,
        z: &[f64],
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        if order > self.workspace.capacity() && self.make_room(order).is_err() {
            return Err(EvaluationFailure::NoSeries);
        }
        let m = z.len();
        coefficients[..m].copy_from_slice(z);
        for j in 0..order {
            self.inputs[0] = match j {
                0 => t,
                1 => 1.0,
                _ => 0.0,
            };
            let (known, next) = coefficients[j * m..].split_at_mut(m);
            self.inputs[1..].copy_from_slice(known);
            let step = match j {
                0 => self.taylor.start(&self.inputs, &mut self.workspace),
                _ => self.taylor.advance(&self.inputs, &mut self.workspace),
            };
            step.map_err(failure)?;
            let share = (j + 1) as f64;
            for (k, next) in next[..m].iter_mut().enumerate() {
                *next = self.taylor.output(k, &self.workspace) / share;
            }
        }
        Ok(())
    }
}
