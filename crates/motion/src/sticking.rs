//! Where the sign of a function decides a force and both sides drive the motion back to its zero: it sticks there (A. F. Filippov 1988,
//! Differential Equations with Discontinuous Righthand Sides, § 4), and steps would chatter across it without end.

use crate::functions::{Functions, FunctionsError};
use crate::numeric::Binding;
use chetaev_mechanics::terms::freeze_accelerations;
use chetaev_mechanics::{MotionTerms, System};
use chetaev_symbolic::{Expr, Function, Node};

/// The reason of a halt where the motion sticks on a zero of what is under a sign.
pub(crate) const STUCK: u32 = u32::MAX;

/// Functions under a sign in the forces, with their rates.
#[derive(Clone, Debug)]
pub(crate) struct Sticking {
    functions: Functions,
    n: usize,
    seen: Vec<Seen>,
    /// As printed.
    texts: Vec<String>,
    found: Option<usize>,
}

/// What was seen of a function.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    value: f64,
    rate: f64,
    largest: f64,
    /// How often in a row it was driven back across zero.
    returns: u32,
}

/// A function is near zero below this part of its largest value.
const NEAR: f64 = 1e-3;
/// So often in a row steps near zero are driven back before the motion is said to stick: an oscillation about zero of a size that the
/// tolerance resolves turns between.
const RETURNS: u32 = 12;

impl Sticking {
    /// The functions of the state under a sign, or between the two sides of an absolute value that is differentiated, in the forces; `None` where there are none.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn new(
        system: &System,
        terms: &MotionTerms,
        binding: &Binding,
    ) -> Result<Option<Sticking>, FunctionsError> {
        let g = &system.graph;
        let moving = |e: &Expr| !g.is_free_of(*e, &|s| system.moves(g.symbol_name(s)));
        let mut values: Vec<Expr> = Vec::new();
        for part in g.reachable(&terms.force) {
            let Node::Apply {
                function: Function::Sign,
                arguments,
            } = g.node(part)
            else {
                continue;
            };
            values.extend(arguments.iter().filter(|e| moving(e)));
        }
        values.dedup();
        if values.is_empty() {
            return Ok(None);
        }
        let texts = values.iter().map(|&e| g.text(e)).collect();
        let drift = freeze_accelerations(system, &values);
        let slopes = g.jacobian(&values, &system.velocity_symbols()).concat();
        let groups = [
            ("value", values.clone()),
            ("drift", drift),
            ("slope", slopes),
        ];
        Ok(Some(Sticking {
            functions: Functions::new(g, binding, &binding.variables, &groups)?,
            n: system.n(),
            seen: vec![Seen::default(); values.len()],
            texts,
            found: None,
        }))
    }

    /// Forgets what was seen, for another run.
    pub(crate) fn begin(&mut self) {
        self.seen.fill(Seen::default());
        self.found = None;
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.functions.set_parameters(values)
    }

    /// Takes an accepted state with its accelerations into account; true where the motion sticks.
    pub(crate) fn look(&mut self, t: f64, (q, v, a): (&[f64], &[f64], &[f64])) -> bool {
        if self.functions.evaluate(t, &[q, v]).is_err() {
            return false;
        }
        for (index, seen) in self.seen.iter_mut().enumerate() {
            let slopes = &self.functions.group(2)[index * self.n..(index + 1) * self.n];
            let along: f64 = slopes.iter().zip(a).map(|(s, a)| s * a).sum();
            let rate = self.functions.group(1)[index] + along;
            let value = self.functions.group(0)[index];
            seen.largest = seen.largest.max(value.abs());
            // Both sides drive back, near zero, although the rate is none there.
            let is_driven = value * rate <= 0.0 && value.abs() <= NEAR * seen.largest;
            let jumps = rate * seen.rate < 0.0 || value * seen.value < 0.0;
            seen.returns = match (is_driven, jumps) {
                (true, true) => seen.returns + 1,
                (true, false) => seen.returns,
                (false, _) => 0,
            };
            (seen.value, seen.rate) = (value, rate);
            if seen.returns >= RETURNS && self.found.is_none() {
                self.found = Some(index);
            }
        }
        self.found.is_some()
    }

    /// The function on whose zero the motion sticks.
    pub(crate) fn text(&self) -> Option<&str> {
        self.found.map(|index| &self.texts[index][..])
    }
}
