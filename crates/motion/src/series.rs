//! Taylor series of the motion: the coefficients of a state whose rates are expressions.

use crate::functions::{failure, FunctionsError};
use crate::numeric::Binding;
use chetaev_compile::{Lowering, Program, Taylor, TaylorWorkspace};
use chetaev_integrate::EvaluationFailure;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// The program of rates over the time and a state.
///
/// # Errors
/// [`FunctionsError`].
pub(crate) fn program(
    g: &Graph,
    binding: &Binding,
    variables: &[Symbol],
    rates: &[Expr],
) -> Result<Program, FunctionsError> {
    let symbols: Vec<Symbol> = binding.parameters.iter().map(|own| own.0).collect();
    let lowering = Lowering::new(g).variables(variables).parameters(&symbols);
    let lowering = lowering.output("rates", &g.substitute_all(rates, &binding.controls));
    Ok(lowering.lower()?)
}

/// What one order of a series costs, in sums: a convolution as many as a series of usual order has.
///
/// # Errors
/// [`FunctionsError`].
pub(crate) fn cost(program: &Program) -> Result<usize, FunctionsError> {
    let (convolutions, others) = Taylor::interpreter(program)?.counts();
    Ok(12 * convolutions + others)
}

/// The rates of a state (z₁, …, z_m), functions of (t, z), by their Taylor recurrences.
#[derive(Clone, Debug)]
pub(crate) struct RateSeries {
    taylor: Taylor,
    workspace: TaylorWorkspace,
    parameters: Vec<f64>,
    /// t and the state.
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
        let parameters = binding.parameters.iter().map(|&(_, value)| value).collect();
        RateSeries::of(&program(g, binding, variables, rates)?, parameters)
    }

    /// The recurrences of a program of rates, with values of its parameters.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn of(
        program: &Program,
        parameters: Vec<f64>,
    ) -> Result<RateSeries, FunctionsError> {
        let taylor = Taylor::new(program)?;
        let mut series = RateSeries {
            workspace: taylor.workspace(0),
            inputs: vec![0.0; program.variables.len()],
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
        self.inputs[0] = t;
        self.inputs[1..].copy_from_slice(z);
        let coefficients = &mut coefficients[..(order + 1) * z.len()];
        let workspace = &mut self.workspace;
        self.taylor
            .expand(&self.inputs, order, workspace, coefficients)
            .map_err(failure)
    }
}
