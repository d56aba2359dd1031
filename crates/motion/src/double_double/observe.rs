//! Expressions in (t, q, v, a, λ) along a run in double-double.

use super::functions::PreciseFunctions;
use super::DoubleDouble;
use crate::functions::FunctionsError;
use crate::numeric::Binding;
use crate::observe::variables_of_rows;
use crate::run::Run;
use chetaev_mechanics::{MotionTerms, System};
use chetaev_symbolic::Expr;

/// One series per expression along the rows, of numbers where they have values; `None` for a run in doubles.
///
/// # Errors
/// [`FunctionsError`], for instance for a symbol that has no value along a run.
pub fn along(
    (system, terms, binding): (&System, &MotionTerms, &Binding),
    run: &Run,
    expressions: &[Expr],
) -> Result<Option<Vec<Vec<DoubleDouble>>>, FunctionsError> {
    let Some(precise) = &run.precise else {
        return Ok(None);
    };
    let variables = variables_of_rows(system, terms, binding, &run.own);
    let numbers = (binding, &precise.parameters[..]);
    let mut functions = PreciseFunctions::new(&system.graph, numbers, &variables, expressions)?;
    let mut series = vec![Vec::with_capacity(run.len()); expressions.len()];
    let rows = precise.rows.chunks(run.layout.len().max(1));
    for (&t, row) in precise.times.iter().zip(rows) {
        let none = DoubleDouble::from(f64::NAN);
        let values = functions.evaluate(t, &[row]).map(<[_]>::to_vec);
        let values = values.unwrap_or_else(|_| vec![none; expressions.len()]);
        for (series, value) in series.iter_mut().zip(values) {
            series.push(value);
        }
    }
    Ok(Some(series))
}
