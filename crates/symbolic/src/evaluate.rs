//! Numeric evaluation in double precision: the plain reference, one pass over the graph.

use crate::graph::Graph;
use crate::node::{Expr, Function, Node, Symbol};
use crate::number::ball::Precision;
use crate::rational;
use rustc_hash::{FxHashMap, FxHashSet};

/// Bits of the enclosures of algebraic numbers.
const BITS: usize = 256;

/// Why an expression has no double value at a point.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EvaluateError {
    /// A symbol was given no value.
    #[error("no value for `{0}`")]
    Unbound(String),
    /// A linear solve met a singular matrix.
    #[error("a linear system is singular at this point")]
    Singular,
}

impl Graph {
    /// Values of `roots` in double precision; `point` gives the symbols. Undefined operations give NaN or infinity.
    ///
    /// # Errors
    /// [`EvaluateError`] for an unbound symbol or a singular solve.
    pub fn evaluate_f64(
        &self,
        roots: &[Expr],
        point: &dyn Fn(Symbol) -> Option<f64>,
    ) -> Result<Vec<f64>, EvaluateError> {
        let mut scalar: FxHashMap<Expr, f64> = FxHashMap::default();
        let mut vector: FxHashMap<Expr, Vec<f64>> = FxHashMap::default();
        let parts = self.reachable(roots);
        let enclosed = self.algebraic_sums(&parts);
        for e in parts {
            let value = match self.node(e) {
                Node::Matrix { entries, .. } => {
                    vector.insert(e, entries.iter().map(|a| scalar[a]).collect());
                    continue;
                }
                Node::Solve { matrix, rhs } => {
                    let mut a = vector[matrix].clone();
                    let mut b: Vec<f64> = rhs.iter().map(|b| scalar[b]).collect();
                    crate::meter::spend((a.len() * b.len()) as u64 / 8);
                    if !solve_dense(&mut a, &mut b) {
                        return Err(EvaluateError::Singular);
                    }
                    vector.insert(e, b);
                    continue;
                }
                Node::Entry { of, index } => vector[of][*index as usize],
                Node::Symbol(symbol) => point(*symbol)
                    .ok_or_else(|| EvaluateError::Unbound(self.symbol_text(*symbol)))?,
                node => match enclosed.get(&e) {
                    Some(value) => *value,
                    None => evaluate_node(node, &scalar),
                },
            };
            scalar.insert(e, value);
        }
        Ok(roots.iter().map(|r| scalar[r]).collect())
    }

    /// The sums of algebraic numbers among these, enclosed and rounded: where powers with long coefficients cancel, double precision has no digit left.
    fn algebraic_sums(&self, parts: &[Expr]) -> FxHashMap<Expr, f64> {
        let mut algebraic: FxHashSet<Expr> = FxHashSet::default();
        let mut sums = Vec::new();
        for &e in parts {
            let node = self.node(e);
            let mut is_own = matches!(node, Node::Algebraic(_));
            node.for_each_child(|child| is_own |= algebraic.contains(&child));
            if is_own {
                algebraic.insert(e);
            }
            if is_own && matches!(node, Node::Sum { .. }) && self.symbols_in(&[e]).is_empty() {
                sums.push(e);
            }
        }
        let precision = Precision::new(BITS);
        let value = |e: Expr| {
            let found = self.enclose(&[e], &precision, &|_| None).ok()?;
            Some((e, found.first()?.to_f64()))
        };
        sums.into_iter().filter_map(value).collect()
    }

    /// `e^x`.
    pub fn exp(&self, x: Expr) -> Expr {
        self.apply(Function::Exp, &[x])
    }
}

fn evaluate_node(node: &Node, scalar: &FxHashMap<Expr, f64>) -> f64 {
    match node {
        Node::Number(value) => rational::to_f64(value),
        Node::Pi => std::f64::consts::PI,
        Node::Algebraic(own) => own.to_f64(),
        Node::Sum { constant, terms } => {
            let start = rational::to_f64(constant);
            terms
                .iter()
                .fold(start, |sum, (t, c)| sum + rational::to_f64(c) * scalar[t])
        }
        Node::Product {
            coefficient,
            factors,
        } => {
            let start = rational::to_f64(coefficient);
            factors.iter().fold(start, |product, f| product * scalar[f])
        }
        Node::Power { base, exponent } => power(scalar[base], scalar[exponent]),
        Node::Apply {
            function,
            arguments,
        } => match arguments[..] {
            [y, x] => libm::atan2(scalar[&y], scalar[&x]),
            [x] => apply(*function, scalar[&x]),
            _ => f64::NAN,
        },
        _ => f64::NAN,
    }
}

/// `base ^ exponent` as the compiled program computes it: integer powers by multiplication, halves by square roots.
pub fn power(base: f64, exponent: f64) -> f64 {
    if exponent == exponent.trunc() && exponent.abs() <= 64.0 {
        base.powi(exponent as i32)
    } else if exponent == 0.5 {
        base.sqrt()
    } else if exponent == -0.5 {
        1.0 / base.sqrt()
    } else {
        libm::pow(base, exponent)
    }
}

/// A function of one argument in double precision, with the same bits on every platform.
pub fn apply(function: Function, x: f64) -> f64 {
    use Function::*;
    match function {
        Sin => libm::sin(x),
        Cos => libm::cos(x),
        Tan => libm::tan(x),
        Cot => 1.0 / libm::tan(x),
        Sec => 1.0 / libm::cos(x),
        Csc => 1.0 / libm::sin(x),
        Asin => libm::asin(x),
        Acos => libm::acos(x),
        Atan => libm::atan(x),
        Sinh => libm::sinh(x),
        Cosh => libm::cosh(x),
        Tanh => libm::tanh(x),
        Asinh => libm::asinh(x),
        Acosh => libm::acosh(x),
        Atanh => libm::atanh(x),
        Exp => libm::exp(x),
        Log => libm::log(x),
        Abs => x.abs(),
        Sign => {
            if x > 0.0 {
                1.0
            } else if x < 0.0 {
                -1.0
            } else {
                0.0
            }
        }
        Atan2 => f64::NAN,
    }
}

/// Solves `A x = b` in place by partial pivoting; `false` when a pivot vanishes.
fn solve_dense(a: &mut [f64], b: &mut [f64]) -> bool {
    let n = b.len();
    for k in 0..n {
        let mut pivot = k;
        for i in k + 1..n {
            if a[i * n + k].abs() > a[pivot * n + k].abs() {
                pivot = i;
            }
        }
        if a[pivot * n + k] == 0.0 {
            return false;
        }
        if pivot != k {
            for j in 0..n {
                a.swap(k * n + j, pivot * n + j);
            }
            b.swap(k, pivot);
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / a[k * n + k];
            if factor != 0.0 {
                for j in k..n {
                    a[i * n + j] -= factor * a[k * n + j];
                }
                b[i] -= factor * b[k];
            }
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|j| a[k * n + j] * b[j]).sum();
        b[k] = (b[k] - sum) / a[k * n + k];
    }
    true
}
