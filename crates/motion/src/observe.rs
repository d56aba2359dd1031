//! Expressions in (t, q, v, a, λ) evaluated along a run.

use crate::functions::{Functions, FunctionsError};
use crate::numeric::Binding;
use crate::run::Run;
use chetaev_mechanics::{MotionTerms, System};
use chetaev_symbolic::{Expr, Graph, Symbol};

/// The symbol of a name with primes.
pub(crate) fn symbol_called(g: &Graph, name: &str) -> Symbol {
    let bare = name.trim_end_matches('\'');
    g.intern_symbol(bare, (name.len() - bare.len()) as u32)
}

/// The time, and what stands in an output row.
pub(crate) fn variables_of_rows(
    system: &System,
    terms: &MotionTerms,
    binding: &Binding,
    own: &[String],
) -> Vec<Symbol> {
    let g = &system.graph;
    let mut variables: Vec<Symbol> = binding.variables.clone();
    variables.extend(system.coordinates.iter().map(|c| c.a_symbol));
    let rows = terms.constraint_index.iter();
    variables.extend(
        rows.map(|&l| g.intern_symbol(&format!("lambda_{}", system.constraints[l].name), 0)),
    );
    variables.extend(own.iter().map(|name| symbol_called(g, name)));
    variables
}

/// Expressions compiled as functions of an output row.
#[derive(Clone, Debug)]
pub struct Observer {
    functions: Functions,
    count: usize,
}

impl Observer {
    /// Compiles expressions in t, q, q', q'', `lambda_NAME` and parameters.
    ///
    /// # Errors
    /// [`FunctionsError`], for instance for a symbol that is none of these.
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        binding: &Binding,
        expressions: &[Expr],
    ) -> Result<Observer, FunctionsError> {
        Observer::with_own(system, terms, binding, &[], expressions)
    }

    /// The same for rows that end with variables of the formulation alone, which may occur in the expressions.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn with_own(
        system: &System,
        terms: &MotionTerms,
        binding: &Binding,
        own: &[String],
        expressions: &[Expr],
    ) -> Result<Observer, FunctionsError> {
        let g = &system.graph;
        let variables = variables_of_rows(system, terms, binding, own);
        Ok(Observer {
            functions: Functions::new(g, binding, &variables, &[("values", expressions.to_vec())])?,
            count: expressions.len(),
        })
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.functions.set_parameters(values)
    }

    /// Values at one row; NaN where a value is not finite.
    pub fn at(&mut self, t: f64, row: &[f64]) -> Vec<f64> {
        // A value that is not finite belongs to one expression; the others are still wanted.
        let _ = self.functions.evaluate(t, &[row]);
        self.functions.group(0).to_vec()
    }

    /// The value of the first expression at one row.
    pub(crate) fn value(&mut self, t: f64, row: &[f64]) -> f64 {
        let _ = self.functions.evaluate(t, &[row]);
        self.functions.group(0).first().copied().unwrap_or(f64::NAN)
    }

    /// One series per expression along a run.
    pub fn along(&mut self, run: &Run) -> Vec<Vec<f64>> {
        let mut series = vec![Vec::with_capacity(run.len()); self.count];
        for (j, &t) in run.times.iter().enumerate() {
            for (values, value) in series.iter_mut().zip(self.at(t, run.row(j))) {
                values.push(value);
            }
        }
        series
    }
}
