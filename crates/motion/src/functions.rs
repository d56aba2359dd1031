//! Compiled functions of the state: the program of expressions, with parameter values set.

use crate::numeric::Binding;
use chetaev_compile::rounding::{rounding, Rounded};
use chetaev_compile::{
    backend, Backend, EvaluateFailure, Evaluator, LowerError, Lowering, VerifyError, Workspace,
};
use chetaev_integrate::EvaluationFailure;
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::ops::Range;
use std::sync::Arc;

/// Why expressions cannot be compiled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FunctionsError {
    /// The expressions cannot be lowered.
    #[error("the equations cannot be compiled: {0}")]
    Lower(#[from] LowerError),
    /// The program is not well formed.
    #[error("the compiled program is not well formed: {0}")]
    Verify(#[from] VerifyError),
    /// The mass matrix bordered by the constraints is singular identically.
    #[error(
        "the equations do not determine the accelerations: their matrix is singular identically"
    )]
    Singular,
    /// The parameters make a linear system singular.
    #[error("the parameter values make a linear system singular: {0}")]
    Prepare(#[from] EvaluateFailure),
}

/// Named groups of expressions as one numeric function of (t, state).
#[derive(Clone, Debug)]
pub struct Functions {
    /// Native code where the machine has it.
    backend: Arc<Backend>,
    workspace: Workspace,
    inputs: Vec<f64>,
    /// All values, those that are zero identically included.
    outputs: Vec<f64>,
    /// The values computed, and where each belongs: a large mass matrix is mostly zero.
    computed: Vec<f64>,
    places: Vec<usize>,
    groups: Vec<Range<usize>>,
    /// Values of the parameters.
    parameters: Vec<f64>,
    /// What became of the evaluation at `inputs`: several callers ask at one state.
    known: Option<Result<(), EvaluationFailure>>,
}

impl Functions {
    /// Compiles `groups` as functions of `variables`, the first of which is the time.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        g: &Graph,
        binding: &Binding,
        variables: &[Symbol],
        groups: &[(&str, Vec<Expr>)],
    ) -> Result<Functions, FunctionsError> {
        let (symbols, values): (Vec<Symbol>, Vec<f64>) = binding.parameters.iter().copied().unzip();
        let mut lowering = Lowering::new(g).variables(variables).parameters(&symbols);
        let mut ranges = Vec::with_capacity(groups.len());
        let mut places = Vec::new();
        let mut start = 0;
        for (name, values) in groups {
            let values = g.substitute_all(values, &binding.controls);
            let (here, present): (Vec<usize>, Vec<Expr>) = values
                .iter()
                .enumerate()
                .filter(|(_, &value)| !g.is_zero(value))
                .map(|(i, &value)| (start + i, value))
                .unzip();
            lowering = lowering.output(name, &present);
            places.extend(here);
            ranges.push(start..start + values.len());
            start += values.len();
        }
        let backend = backend(lowering.lower()?)?;
        let mut workspace = backend.workspace();
        backend.prepare(&values, &mut workspace)?;
        Ok(Functions {
            backend: Arc::new(backend),
            workspace,
            inputs: vec![0.0; variables.len()],
            outputs: vec![0.0; start],
            computed: vec![0.0; places.len()],
            places,
            groups: ranges,
            parameters: values,
            known: None,
        })
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`]; the functions then have no values until other parameters are set.
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.known = None;
        self.parameters.clear();
        self.parameters.extend_from_slice(values);
        Ok(self.backend.prepare(values, &mut self.workspace)?)
    }

    /// Evaluates all groups at time t and the state given in pieces, which together fill the variables after t.
    ///
    /// # Errors
    /// When a value is not finite or a linear system is singular.
    #[allow(clippy::needless_range_loop)]
    pub fn evaluate(&mut self, t: f64, pieces: &[&[f64]]) -> Result<(), EvaluationFailure> {
        let mut difference = self.inputs[0].to_bits() ^ t.to_bits();
        self.inputs[0] = t;
        let mut next = 1;
        for piece in pieces {
            let own = &mut self.inputs[next..];
            let count = piece.len().min(own.len());
            let (own, piece) = (&mut own[..count], &piece[..count]);
            // Over indices and without a branch: done several times in a step.
            for i in 0..count {
                difference |= own[i].to_bits() ^ piece[i].to_bits();
                own[i] = piece[i];
            }
            next += count;
        }
        match self.known {
            Some(known) if difference == 0 => known,
            _ => {
                let found = self.compute();
                self.known = Some(found);
                found
            }
        }
    }

    /// Evaluates at `inputs`.
    fn compute(&mut self) -> Result<(), EvaluationFailure> {
        let found = self
            .backend
            .evaluate(&self.inputs, &mut self.workspace, &mut self.computed);
        if let Err(problem) = found {
            // Those of an earlier state are not of this one; what is zero everywhere is zero here too.
            for &place in &self.places {
                self.outputs[place] = f64::NAN;
            }
            return Err(failure(problem));
        }
        let mut trace = 0.0;
        for (&place, &value) in self.places.iter().zip(&self.computed) {
            self.outputs[place] = value;
            trace += 0.0 * value;
        }
        // Zero where all are finite: what is not spreads.
        let infinite = match trace == 0.0 {
            true => None,
            false => self.computed.iter().position(|value| !value.is_finite()),
        };
        match infinite {
            Some(i) => Err(EvaluationFailure::NotFinite {
                component: self.places[i],
            }),
            None => Ok(()),
        }
    }

    /// Whether machine code runs.
    pub(crate) fn is_native(&self) -> bool {
        self.backend.is_native()
    }

    /// All values at the state of the last evaluation with bounds of what rounding leaves open in them; `None` where a linear system is
    /// singular.
    pub(crate) fn rounded(&self) -> Option<Vec<Rounded>> {
        let computed = rounding(self.backend.program(), &self.parameters, &self.inputs)?;
        let mut all = vec![Rounded::default(); self.outputs.len()];
        for (&place, value) in self.places.iter().zip(computed) {
            all[place] = value;
        }
        Some(all)
    }

    /// Where group number `index` is among all values.
    pub(crate) fn range(&self, index: usize) -> Range<usize> {
        self.groups[index].clone()
    }

    /// The values of group number `index` of the last evaluation.
    pub fn group(&self, index: usize) -> &[f64] {
        &self.outputs[self.groups[index].clone()]
    }
}

pub(crate) fn failure(failure: EvaluateFailure) -> EvaluationFailure {
    match failure {
        EvaluateFailure::Singular {
            pivot,
            value,
            threshold,
            ..
        } => EvaluationFailure::Singular {
            index: pivot,
            pivot: value,
            threshold,
        },
        EvaluateFailure::NotAnalytic {
            operation,
            argument,
        } => EvaluationFailure::NotAnalytic {
            operation,
            argument,
        },
        _ => EvaluationFailure::NotFinite { component: 0 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [[x, y], [y, x]] s = (1, 0) beside x and 0: where x = y nothing has a value but the zero, and elsewhere everything again,
    /// s = (x, −y)/(x² − y²).
    #[test]
    #[allow(clippy::unwrap_used, reason = "test code fails where it stands")]
    fn a_singular_state_leaves_no_traces() {
        let g = Graph::new();
        let [t, x, y] = ["t", "x", "y"].map(|name| g.intern_symbol(name, 0));
        let [a, b] = [x, y].map(|s| g.symbol_expr(s));
        let solved = g.solve(&[a, b, b, a], &[g.one(), g.zero()]).unwrap();
        let binding = Binding {
            parameters: Vec::new(),
            controls: Vec::new(),
            variables: vec![t, x, y],
        };
        let group = [solved[0], solved[1], g.zero(), a];
        let mut own =
            Functions::new(&g, &binding, &[t, x, y], &[("values", group.to_vec())]).unwrap();
        for _ in 0..2 {
            assert!(own.evaluate(0.0, &[&[1.0, 1.0]]).is_err());
            let found = own.group(0);
            assert!(
                found[0].is_nan() && found[1].is_nan() && found[2] == 0.0,
                "{found:?}"
            );
            assert!(own.evaluate(0.0, &[&[2.0, 1.0]]).is_ok());
            let right = [2.0 / 3.0, -1.0 / 3.0, 0.0, 2.0];
            let near = own
                .group(0)
                .iter()
                .zip(right)
                .all(|(a, b)| (a - b).abs() < 1e-15);
            assert!(near, "{:?}", own.group(0));
        }
    }
}
