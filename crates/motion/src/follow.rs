//! Quantities that should keep their initial values, followed at every accepted step: rows may lie far apart.

use crate::drift::Extreme;
use crate::functions::{Functions, FunctionsError};
use crate::numeric::Binding;
use chetaev_mechanics::System;
use chetaev_symbolic::{rational, Expr, Function, Graph, Node, Symbol};
use std::collections::BTreeMap;

/// What became of a quantity over a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Largest deviation from the value at the start; infinite where there was none.
    pub drift: Extreme,
    /// Largest sum of the sizes of its terms.
    pub scale: f64,
    /// The deviation before the last state.
    earlier: Extreme,
    /// The size of the terms before the last state.
    earlier_scale: f64,
}

impl Deviation {
    /// Takes a change of the quantity and the size of its terms at a time into account, and whether that state is a new one.
    pub(crate) fn record(&mut self, change: f64, size: f64, (t, is_new): (f64, bool)) {
        let known = if change.is_nan() {
            f64::INFINITY
        } else {
            change
        };
        if is_new {
            self.earlier = self.drift;
            self.earlier_scale = self.scale;
        }
        self.drift.record(known, t);
        self.scale = self.scale.max(size);
    }

    /// Adds the deviation of a run that began where this one ended: at most the sum of both.
    pub(crate) fn go_on(&mut self, further: &Deviation) {
        let sum = self.drift.value + further.drift.value;
        self.drift.record(sum, further.drift.t);
        self.scale = self.scale.max(further.scale);
    }

    /// The deviation over a run; `until_singular` leaves out the last state, at which the equations became singular and the
    /// quantity may have no value.
    pub(crate) fn finished(&self, until_singular: bool) -> Deviation {
        match until_singular {
            true => Deviation {
                drift: self.earlier,
                scale: self.earlier_scale,
                ..*self
            },
            false => *self,
        }
    }
}

/// Quantities in (t, q, v), compiled.
#[derive(Clone, Debug)]
pub struct Follow {
    functions: Functions,
    initial: Vec<f64>,
    /// The time of the state last recorded.
    last: Option<f64>,
    /// One per quantity, in order. Quantities that contain accelerations or multipliers are left at zero.
    pub deviations: Vec<Deviation>,
}

impl Follow {
    /// Compiles the quantities and takes their values at (t, q, v) for those to keep.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        system: &System,
        binding: &Binding,
        quantities: &[Expr],
        at: (f64, &[f64], &[f64]),
    ) -> Result<Follow, FunctionsError> {
        Follow::over(system, binding, &binding.variables, quantities, at)
    }

    /// The same over t and the variables of a state of any kind, given in two pieces where (q, v) are meant.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn over(
        system: &System,
        binding: &Binding,
        variables: &[Symbol],
        quantities: &[Expr],
        at: (f64, &[f64], &[f64]),
    ) -> Result<Follow, FunctionsError> {
        let mut follow = Follow::compile(system, binding, variables, quantities)?;
        follow.begin(at);
        Ok(follow)
    }

    /// The same without a start.
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub(crate) fn compile(
        system: &System,
        binding: &Binding,
        variables: &[Symbol],
        quantities: &[Expr],
    ) -> Result<Follow, FunctionsError> {
        let g = &system.graph;
        let values = known_values(g, binding, variables, quantities);
        let sizes = values.iter().map(|&e| magnitude(g, e)).collect();
        let groups = [("values", values), ("sizes", sizes)];
        Ok(Follow {
            functions: Functions::new(g, binding, variables, &groups)?,
            initial: Vec::new(),
            last: None,
            deviations: vec![Deviation::default(); quantities.len()],
        })
    }

    /// Takes the values at (t, q, v) for those to keep, and forgets everything recorded.
    pub(crate) fn begin(&mut self, (t, q, v): (f64, &[f64], &[f64])) {
        // A value that is not finite belongs to one quantity; the others are still wanted.
        let _ = self.functions.evaluate(t, &[q, v]);
        self.initial.clear();
        self.initial.extend_from_slice(self.functions.group(0));
        self.last = None;
        self.deviations.fill(Deviation::default());
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.functions.set_parameters(values)
    }

    /// What became of the quantities; `until_singular` leaves out the last state, at which the equations became singular
    /// and a quantity may have no value.
    pub(crate) fn finish(&self, until_singular: bool) -> Vec<Deviation> {
        let all = self.deviations.iter();
        all.map(|own| own.finished(until_singular)).collect()
    }

    /// Takes the values at (t, q, v) into account.
    pub fn record(&mut self, t: f64, q: &[f64], v: &[f64]) {
        let _ = self.functions.evaluate(t, &[q, v]);
        let is_new = self.last != Some(t);
        self.last = Some(t);
        let values = self.functions.group(0).iter().zip(&self.initial);
        for ((deviation, size), (value, initial)) in self
            .deviations
            .iter_mut()
            .zip(self.functions.group(1))
            .zip(values)
        {
            deviation.record(value - initial, *size, (t, is_new));
        }
    }
}

/// The quantities, with zero for those that contain other symbols than variables and parameters.
fn known_values(
    g: &Graph,
    binding: &Binding,
    variables: &[Symbol],
    quantities: &[Expr],
) -> Vec<Expr> {
    let known = |e: &Expr| {
        let bound = g.substitute(*e, &binding.controls);
        g.symbols_in(&[bound])
            .into_iter()
            .all(|s| variables.contains(&s) || binding.parameters.iter().any(|(p, _)| *p == s))
    };
    let values = quantities.iter();
    values
        .map(|e| if known(e) { *e } else { g.zero() })
        .collect()
}

/// The quantities as far as they are known at (t, q, v), then the sizes of their terms.
pub(crate) fn followed_values(
    system: &System,
    binding: &Binding,
    quantities: &[Expr],
) -> Vec<Expr> {
    let g = &system.graph;
    let values = known_values(g, binding, &binding.variables, quantities);
    let sizes: Vec<Expr> = values.iter().map(|&e| magnitude(g, e)).collect();
    [values, sizes].concat()
}

/// A function below this part of its terms vanishes at a start.
const VANISHES: f64 = 1e-8;

/// Whether a function vanishes beside its terms, at values of its symbols; `None` where it has no value.
pub fn vanishes(g: &Graph, e: Expr, value: &dyn Fn(Symbol) -> Option<f64>) -> Option<bool> {
    let both = g.evaluate_f64(&[e, magnitude(g, e)], &value).ok()?;
    Some(both[0].abs() <= VANISHES * both[1])
}

/// The expression with every term of every sum replaced by its absolute value: the size by which a difference of its values
/// is judged, which does not vanish where terms cancel. To the size of a function belongs what the size of its argument
/// changes in it: log(x/y) is judged by 1 where x = y.
pub fn magnitude(g: &Graph, e: Expr) -> Expr {
    let mut sizes: BTreeMap<Expr, Expr> = BTreeMap::new();
    let absolute = |part: Expr| g.apply(Function::Abs, &[part]);
    for part in g.reachable(&[e]) {
        let of = |child: &Expr| sizes.get(child).copied().unwrap_or(*child);
        let size = match g.node(part) {
            Node::Sum { constant, terms } => {
                let constant = g.number(rational::abs(constant));
                let terms = terms.iter().map(|(t, c)| g.scale(&rational::abs(c), of(t)));
                g.add(&std::iter::once(constant).chain(terms).collect::<Vec<_>>())
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let factors: Vec<Expr> = factors.iter().map(of).collect();
                g.scale(&rational::abs(coefficient), g.mul(&factors))
            }
            Node::Power { base, exponent } => match g.as_number(*exponent) {
                Some(power) if !rational::is_negative(power) => g.pow(of(base), *exponent),
                _ => absolute(part),
            },
            Node::Matrix { .. } | Node::Solve { .. } => part,
            Node::Apply {
                function,
                arguments,
            } => {
                let changes = arguments
                    .iter()
                    .enumerate()
                    .filter(|(_, argument)| {
                        matches!(g.node(**argument), Node::Sum { .. } | Node::Product { .. })
                    })
                    .map(|(i, argument)| {
                        let slope = slope(g, *function, arguments, i);
                        g.mul(&[absolute(slope), of(argument)])
                    });
                let all: Vec<Expr> = std::iter::once(absolute(part)).chain(changes).collect();
                g.add(&all)
            }
            Node::Entry { of: solve, index } => {
                let right = |b: &Expr| of(b);
                solution_size(g, *solve, *index as usize, &right).unwrap_or(absolute(part))
            }
            _ => absolute(part),
        };
        sizes.insert(part, size);
    }
    sizes.get(&e).copied().unwrap_or(e)
}

/// The size of a component of `x = A⁻¹ b`: Σ_j |(A⁻¹)_ij| times the sizes of the b_j; the row of A⁻¹ solves Aᵀ z = e_i.
fn solution_size(
    g: &Graph,
    solve: Expr,
    index: usize,
    size: &dyn Fn(&Expr) -> Expr,
) -> Option<Expr> {
    let Node::Solve { matrix, rhs } = g.node(solve) else {
        return None;
    };
    let Node::Matrix { entries, .. } = g.node(*matrix) else {
        return None;
    };
    let n = rhs.len();
    let transposed: Vec<Expr> = (0..n * n).map(|i| entries[(i % n) * n + i / n]).collect();
    let unit: Vec<Expr> = (0..n)
        .map(|i| if i == index { g.one() } else { g.zero() })
        .collect();
    let row = g.solve(&transposed, &unit).ok()?;
    let parts: Vec<Expr> = row
        .iter()
        .zip(rhs.iter())
        .map(|(&z, b)| g.mul(&[g.apply(Function::Abs, &[z]), size(b)]))
        .collect();
    Some(g.add(&parts))
}

/// ∂F/∂uᵢ of a function of the arguments u.
fn slope(g: &Graph, function: Function, arguments: &[Expr], i: usize) -> Expr {
    let names: Vec<Expr> = (0..arguments.len())
        .map(|j| g.symbol(&format!("argument_{j}"), 0))
        .collect();
    let Some(symbol) = g.as_symbol(names[i]) else {
        return g.zero();
    };
    let derivative = g.gradient(g.apply(function, &names), &[symbol])[0];
    let values: Vec<(Expr, Expr)> = names.into_iter().zip(arguments.iter().copied()).collect();
    g.substitute(derivative, &values)
}
