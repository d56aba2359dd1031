//! Groups of expressions as functions of (t, state) in double-double arithmetic.

use crate::functions::{failure, FunctionsError};
use crate::numeric::Binding;
use chetaev_compile::double_double::DoubleDouble;
use chetaev_compile::{Lowering, PreciseProgram};
use chetaev_integrate::EvaluationFailure;
use chetaev_symbolic::{Expr, Graph, Symbol};

/// Compiled expressions with values of the parameters.
#[derive(Clone, Debug)]
pub(super) struct PreciseFunctions {
    program: PreciseProgram,
    inputs: Vec<DoubleDouble>,
    values: Vec<DoubleDouble>,
}

impl PreciseFunctions {
    /// Compiles expressions as functions of `variables`, the first of which is the time.
    pub(super) fn new(
        g: &Graph,
        (binding, parameters): (&Binding, &[DoubleDouble]),
        variables: &[Symbol],
        expressions: &[Expr],
    ) -> Result<PreciseFunctions, FunctionsError> {
        let symbols: Vec<Symbol> = binding.parameters.iter().map(|own| own.0).collect();
        let lowering = Lowering::new(g).variables(variables).parameters(&symbols);
        let bound = g.substitute_all(expressions, &binding.controls);
        let mut program = PreciseProgram::new(&lowering.output("values", &bound).lower()?)?;
        program.prepare(parameters)?;
        Ok(PreciseFunctions {
            program,
            inputs: Vec::with_capacity(variables.len()),
            values: vec![DoubleDouble::from(f64::NAN); expressions.len()],
        })
    }

    /// The values at time t and the state given in pieces; those that do not exist are not numbers.
    ///
    /// # Errors
    /// When a linear system is singular; the values are those of before.
    pub(super) fn evaluate(
        &mut self,
        t: DoubleDouble,
        pieces: &[&[DoubleDouble]],
    ) -> Result<&[DoubleDouble], EvaluationFailure> {
        self.inputs.clear();
        self.inputs.push(t);
        for piece in pieces {
            self.inputs.extend_from_slice(piece);
        }
        let values = self.program.evaluate(&self.inputs).map_err(failure)?;
        self.values.copy_from_slice(values);
        Ok(&self.values)
    }
}
