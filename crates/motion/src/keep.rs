//! First integrals whose values a run keeps: after each step the state is moved onto constraints and integrals by the least change.
//!
//! The change of (q, v) is the least one in the norm of the kinetic metric in both parts, by Gauss–Newton steps; integrals that
//! depend on others and on the constraints at the state ask for nothing.

use crate::functions::{Functions, FunctionsError};
use crate::least_norm::least_step;
use crate::numeric::Binding;
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Symbol};

/// At most so many steps towards the level set.
const STEPS: usize = 6;

/// A residual below it, of the size at the start, is rounding.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A state whose change is larger, of its size, is left as it is: the level set lies elsewhere.
const FAR: f64 = 1e-3;

/// Integrals with their values at the start, beside what vanishes.
#[derive(Clone, Debug)]
pub struct Keep {
    functions: Functions,
    n: usize,
    /// How many of the quantities vanish.
    vanishing: usize,
    /// Values to keep: zero for what vanishes.
    targets: Vec<f64>,
}

impl Keep {
    /// Compiles `vanishing` and `integrals`, functions of (t, q, v).
    ///
    /// # Errors
    /// [`FunctionsError`].
    pub fn new(
        system: &System,
        binding: &Binding,
        (vanishing, integrals): (&[Expr], &[Expr]),
    ) -> Result<Keep, FunctionsError> {
        let g = &system.graph;
        let all = [vanishing, integrals].concat();
        let coordinates = system.coordinates.iter();
        let symbols: Vec<Symbol> = coordinates
            .clone()
            .map(|c| c.q_symbol)
            .chain(coordinates.map(|c| c.v_symbol))
            .collect();
        let slopes = g.jacobian(&all, &symbols).concat();
        let groups = [("values", all), ("slopes", slopes)];
        Ok(Keep {
            functions: Functions::new(g, binding, &binding.variables, &groups)?,
            n: system.n(),
            vanishing: vanishing.len(),
            targets: Vec::new(),
        })
    }

    /// Takes the values of the integrals at (t, q, v) for those to keep.
    pub fn begin(&mut self, (t, q, v): (f64, &[f64], &[f64])) {
        let known = self.functions.evaluate(t, &[q, v]).is_ok();
        let values = self.functions.group(0)[self.vanishing..].iter();
        self.targets.clear();
        self.targets.resize(self.vanishing, 0.0);
        let target = |&x: &f64| if known { x } else { f64::NAN };
        self.targets.extend(values.map(target));
    }

    /// Sets other values of the parameters, in the order of the binding.
    ///
    /// # Errors
    /// [`FunctionsError::Prepare`].
    pub(crate) fn set_parameters(&mut self, values: &[f64]) -> Result<(), FunctionsError> {
        self.functions.set_parameters(values)
    }

    /// Moves the state; says whether it changed. Without a value, or far from the level set, it stays.
    pub fn bring_back(&mut self, t: f64, q: &mut [f64], v: &mut [f64], metric: &[f64]) -> bool {
        let n = self.n;
        let (mut x, mut y) = (q.to_vec(), v.to_vec());
        let both = doubled(metric, n);
        let movable: Vec<usize> = (0..2 * n).collect();
        let mut changed = false;
        for _ in 0..STEPS {
            if self.functions.evaluate(t, &[&x, &y]).is_err() {
                return false;
            }
            let values = self.functions.group(0).iter().zip(&self.targets);
            let missing: Vec<f64> = values.map(|(value, target)| value - target).collect();
            if missing.iter().any(|f| !f.is_finite()) {
                return false;
            }
            let is_rounding =
                |(f, target): (&f64, &f64)| f.abs() <= ROUNDING * (1.0 + target.abs());
            if missing.iter().zip(&self.targets).all(is_rounding) {
                break;
            }
            let slopes = self.functions.group(1);
            let step = least_step(slopes, &missing, 2 * n, &movable, &both);
            let state = x[..n].iter_mut().chain(y.iter_mut());
            state.zip(&step).for_each(|(x, dx)| *x -= dx);
            changed = true;
        }
        let near = |old: &[f64], new: &[f64]| {
            let mut pairs = old.iter().zip(new);
            pairs.all(|(a, b)| (a - b).abs() <= FAR * (1.0 + a.abs()))
        };
        if !changed || !near(q, &x) || !near(v, &y) {
            return false;
        }
        q.copy_from_slice(&x);
        v.copy_from_slice(&y);
        true
    }
}

/// The metric for coordinates and velocities, block by block.
fn doubled(metric: &[f64], n: usize) -> Vec<f64> {
    let mut both = vec![0.0; 4 * n * n];
    for i in 0..n {
        for j in 0..n {
            let value = metric[i * n + j];
            both[i * 2 * n + j] = value;
            both[(n + i) * 2 * n + n + j] = value;
        }
    }
    both
}
