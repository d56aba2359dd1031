//! Functions of (t, q, v, a, λ) along a motion whose series is known: their Taylor coefficients by the recurrences of the motion,
//! accelerations and multipliers by the solution of the equations, factorized once.

use crate::functions::FunctionsError;
use crate::numeric::NumericSystem;
use chetaev_compile::{Lowering, Taylor, TaylorWorkspace};
use chetaev_integrate::Piece;
use chetaev_symbolic::{Expr, Symbol};

/// One function.
#[derive(Clone, Debug)]
pub(crate) struct FunctionAlong {
    taylor: Taylor,
    workspace: TaylorWorkspace,
    /// t and the state, of one order.
    inputs: Vec<f64>,
}

impl FunctionAlong {
    /// `value` along motions of the system with the constraint rows `rows`.
    ///
    /// # Errors
    /// [`FunctionsError`], for instance for a variable that is no function of (t, q, v).
    pub(crate) fn new(
        numeric: &NumericSystem,
        rows: &[usize],
        value: Expr,
        order: usize,
    ) -> Result<FunctionAlong, FunctionsError> {
        let (system, binding, values) = numeric.stated();
        let g = &system.graph;
        let value = g.substitute_all(&[value], &binding.controls);
        let solved: Vec<Symbol> = system.coordinates.iter().map(|c| c.a_symbol).collect();
        let lambda = |name: &String| g.intern_symbol(&format!("lambda_{name}"), 0);
        let solved = [solved, numeric.constraints.iter().map(lambda).collect()].concat();
        let present = g.symbols_in(&value);
        let value = match solved.iter().any(|symbol| present.contains(symbol)) {
            false => value,
            true => {
                let symbols = solved.iter().map(|&symbol| g.symbol_expr(symbol));
                let pairs: Vec<(Expr, Expr)> = symbols.zip(numeric.reactions(rows)?).collect();
                g.substitute_all(&value, &pairs)
            }
        };
        // The formulas of the solution may contain controls too.
        let value = g.substitute_all(&value, &binding.controls);
        let (names, stated): (Vec<Symbol>, Vec<f64>) = binding.parameters.iter().copied().unzip();
        let lowering = Lowering::new(g)
            .variables(&binding.variables)
            .parameters(&names);
        let taylor = Taylor::new(&lowering.output("value", &value).lower()?)?;
        let mut workspace = taylor.workspace(order);
        taylor.prepare(values.unwrap_or(&stated), &mut workspace)?;
        Ok(FunctionAlong {
            taylor,
            workspace,
            inputs: vec![0.0; binding.variables.len()],
        })
    }

    /// Writes the coefficients along a piece of the motion in (q, v); false where there are none.
    pub(crate) fn expand(&mut self, piece: Piece<'_>, series: &mut [f64]) -> bool {
        let n = self.inputs.len() - 1;
        if piece.dimension != n || series.len() > self.workspace.capacity() + 1 {
            return false;
        }
        let mut rows = piece.coefficients.chunks_exact(n.max(1));
        for (order, coefficient) in series.iter_mut().enumerate() {
            self.inputs[0] = match order {
                0 => piece.t,
                1 => piece.length,
                _ => 0.0,
            };
            match rows.next() {
                Some(row) => self.inputs[1..].copy_from_slice(row),
                None => self.inputs[1..].fill(0.0),
            }
            let done = match order {
                0 => self.taylor.start(&self.inputs, &mut self.workspace),
                _ => self.taylor.advance(&self.inputs, &mut self.workspace),
            };
            if done.is_err() {
                return false;
            }
            *coefficient = self.taylor.output(0, &self.workspace);
        }
        true
    }
}
