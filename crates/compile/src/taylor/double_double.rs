//! The recurrences in double-double arithmetic, interpreted.

use super::build::Recurrences;
use super::recurrence::Order;
use super::Series;
use crate::double_double::{DoubleDouble, Values};
use crate::evaluate::EvaluateFailure;
use crate::interpret::check_length;
use crate::program::Program;
use crate::schedule::{self, Single};
use crate::verify::VerifyError;

/// The Taylor recurrences of a program in double-double arithmetic, with storage for its series: the coefficients of a motion
/// whose first variable is the time and whose outputs are the rates of the others, as [`Taylor::expand`](super::Taylor::expand)
/// has them in doubles.
///
/// ```
/// use chetaev_compile::double_double::DoubleDouble;
/// use chetaev_compile::{Lowering, PreciseTaylor};
/// use chetaev_symbolic::Graph;
///
/// // x' = x, x(0) = 1: x_[3] = 1/6.
/// let g = Graph::new();
/// let (t, x) = (g.intern_symbol("t", 0), g.intern_symbol("x", 0));
/// let program = Lowering::new(&g).variables(&[t, x]).output("rate", &[g.symbol_expr(x)]).lower()?;
/// let mut taylor = PreciseTaylor::new(&program)?;
/// taylor.prepare(&[])?;
/// let mut coefficients = [DoubleDouble::ZERO; 4];
/// taylor.expand(&[DoubleDouble::ZERO, DoubleDouble::ONE], 3, &mut coefficients)?;
/// let error = coefficients[3] * 6.0 - DoubleDouble::ONE;
/// assert!(error.abs().high() < 1e-31);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PreciseTaylor {
    recurrences: Recurrences,
    outputs: Vec<u32>,
    variables: std::ops::Range<usize>,
    values: Values,
    /// By register: the coefficient of the order last computed.
    now: Vec<DoubleDouble>,
    series: Series<DoubleDouble>,
    scratch: Vec<DoubleDouble>,
}

impl PreciseTaylor {
    /// The recurrences of `program`.
    ///
    /// # Errors
    /// [`VerifyError`] if the program is not well formed.
    pub fn new(program: &Program) -> Result<PreciseTaylor, VerifyError> {
        program.verify()?;
        let single = Single::of(&schedule::in_runs(program));
        let (recurrences, registers) = Recurrences::of(&single);
        let sizes = single.program.matrices.iter().map(|matrix| matrix.size);
        let scratch = 2 * sizes.max().unwrap_or(0);
        let layout = single.program.layout;
        let start = layout.constants + layout.parameters;
        Ok(PreciseTaylor {
            outputs: crate::double_double::outputs_of(&single),
            variables: start..start + layout.variables,
            values: Values::new(single, registers),
            now: vec![DoubleDouble::ZERO; registers],
            series: Series {
                values: Vec::new(),
                stride: 0,
            },
            scratch: vec![DoubleDouble::ZERO; scratch],
            recurrences,
        })
    }

    /// Sets the parameters; needed before the first series, also without parameters.
    ///
    /// # Errors
    /// [`EvaluateFailure`] for a wrong length, and for a singular matrix that depends on parameters only.
    pub fn prepare(&mut self, parameters: &[DoubleDouble]) -> Result<(), EvaluateFailure> {
        self.values.prepare(parameters)
    }

    /// Writes the coefficients of orders 0 to `order` through the state, one order after the other; `variables` are the time and
    /// the state.
    ///
    /// # Errors
    /// [`EvaluateFailure`]: a singular matrix, a wrong length, or [`NotAnalytic`](EvaluateFailure::NotAnalytic) where a function has
    /// no Taylor series.
    pub fn expand(
        &mut self,
        variables: &[DoubleDouble],
        order: usize,
        coefficients: &mut [DoubleDouble],
    ) -> Result<(), EvaluateFailure> {
        let m = self.outputs.len();
        check_length("outputs", self.variables.len(), m + 1)?;
        check_length("coefficients", (order + 1) * m, coefficients.len())?;
        self.start(variables, order)?;
        coefficients[..m].copy_from_slice(&variables[1..]);
        let mut inputs = variables.to_vec();
        for j in 1..=order {
            let per_order = DoubleDouble::from(j as f64);
            for (input, &register) in inputs[1..].iter_mut().zip(&self.outputs) {
                let is_over = j > 1 && self.recurrences.is_constant[register as usize];
                *input = match is_over {
                    true => DoubleDouble::ZERO,
                    false => self.now[register as usize] / per_order,
                };
            }
            coefficients[j * m..(j + 1) * m].copy_from_slice(&inputs[1..]);
            if j < order {
                inputs[0] = DoubleDouble::from(if j == 1 { 1.0 } else { 0.0 });
                self.advance(j, &inputs);
            }
        }
        Ok(())
    }

    /// Order 0.
    fn start(&mut self, variables: &[DoubleDouble], order: usize) -> Result<(), EvaluateFailure> {
        self.values.evaluate(variables)?;
        self.recurrences.seed(&mut self.values.file)?;
        self.now.copy_from_slice(&self.values.file);
        if self.series.stride < order + 1 {
            self.series = Series {
                values: vec![DoubleDouble::ZERO; self.recurrences.slots * (order + 1)],
                stride: order + 1,
            };
        }
        self.recurrences
            .keep_all(&self.values.file, &mut self.series);
        Ok(())
    }

    /// Order j, from that of the variables.
    fn advance(&mut self, j: usize, variables: &[DoubleDouble]) {
        self.now[self.variables.clone()].copy_from_slice(variables);
        let values = &self.values;
        let order = Order {
            j,
            zero: &values.file,
            now: &mut self.now,
            series: &mut self.series,
        };
        let solve = |matrix: usize, b: &[DoubleDouble], x: &mut [DoubleDouble]| {
            values.factored[matrix].solve(b, x);
        };
        self.recurrences.advance(order, &solve, &mut self.scratch);
    }
}
