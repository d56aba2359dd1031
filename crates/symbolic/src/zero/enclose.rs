//! Evaluation of expressions in balls: arbitrary precision with verified bounds.

use crate::meter;
use rustc_hash::FxHashMap;
use thiserror::Error;

use crate::graph::Graph;
use crate::node::{Expr, Function, Node, Symbol};
use crate::number::ball::{self, Ball, BallError, BallResult, Precision};

/// Why an expression has no enclosure at a point.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum EncloseError {
    /// A symbol was given no value.
    #[error("no value for `{0}`")]
    Unbound(String),
    /// An operation has no enclosure: undefined there, or undecided at this precision.
    #[error(transparent)]
    Ball(#[from] BallError),
    /// A node is malformed: a function with a wrong number of arguments, a solve without matrix.
    #[error("a malformed expression")]
    Malformed,
}

impl Graph {
    /// Enclosures of `roots` with midpoints of `precision`; `point` gives the symbols.
    ///
    /// Each returned ball contains the exact value for every choice of symbols in their balls. Costs one pass over the graph.
    ///
    /// # Errors
    /// [`EncloseError`]; [`BallError::Undefined`] says that the expression is not defined at the point.
    pub fn enclose(
        &self,
        roots: &[Expr],
        precision: &Precision,
        point: &dyn Fn(Symbol) -> Option<Ball>,
    ) -> Result<Vec<Ball>, EncloseError> {
        let mut evaluation = Evaluation {
            graph: self,
            precision,
            scalars: FxHashMap::default(),
            vectors: FxHashMap::default(),
        };
        // A node costs the more the more bits it has.
        let units = 20 + precision.bits() as u64 / 8;
        for e in self.reachable(roots) {
            meter::spend(units);
            if let Node::Solve { matrix, rhs } = self.node(e) {
                let solution = evaluation.solve(*matrix, rhs)?;
                evaluation.vectors.insert(e, solution);
            } else if !matches!(self.node(e), Node::Matrix { .. }) {
                let value = evaluation.scalar(e, point)?;
                evaluation.scalars.insert(e, value);
            }
        }
        roots
            .iter()
            .map(|root| evaluation.get(*root).cloned())
            .collect()
    }
}

struct Evaluation<'g> {
    graph: &'g Graph,
    precision: &'g Precision,
    scalars: FxHashMap<Expr, Ball>,
    vectors: FxHashMap<Expr, Vec<Ball>>,
}

impl Evaluation<'_> {
    fn get(&self, e: Expr) -> Result<&Ball, EncloseError> {
        self.scalars.get(&e).ok_or(EncloseError::Malformed)
    }

    fn scalar(
        &self,
        e: Expr,
        point: &dyn Fn(Symbol) -> Option<Ball>,
    ) -> Result<Ball, EncloseError> {
        let precision = self.precision;
        Ok(match self.graph.node(e) {
            Node::Number(value) => precision.rational(value),
            Node::Pi => precision.pi()?,
            Node::Algebraic(own) => own.enclose(precision)?,
            Node::Symbol(symbol) => point(*symbol)
                .ok_or_else(|| EncloseError::Unbound(self.graph.symbol_text(*symbol)))?,
            Node::Sum { constant, terms } => {
                let mut sum = precision.rational(constant);
                for (term, coefficient) in terms {
                    let part = precision.mul(self.get(*term)?, &precision.rational(coefficient))?;
                    sum = precision.add(&sum, &part)?;
                }
                sum
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let mut product = precision.rational(coefficient);
                for factor in factors {
                    product = precision.mul(&product, self.get(*factor)?)?;
                }
                product
            }
            Node::Power { base, exponent } => match self.graph.as_number(*exponent) {
                Some(number) => precision.pow_rational(self.get(*base)?, number)?,
                None => precision.pow(self.get(*base)?, self.get(*exponent)?)?,
            },
            Node::Apply {
                function,
                arguments,
            } => {
                let values = arguments
                    .iter()
                    .map(|a| self.get(*a))
                    .collect::<Result<Vec<_>, _>>()?;
                self.apply(*function, &values)?
            }
            Node::Entry { of, index } => {
                let vector = self.vectors.get(of).ok_or(EncloseError::Malformed)?;
                vector
                    .get(*index as usize)
                    .cloned()
                    .ok_or(EncloseError::Malformed)?
            }
            Node::Matrix { .. } | Node::Solve { .. } => return Err(EncloseError::Malformed),
        })
    }

    fn apply(&self, function: Function, arguments: &[&Ball]) -> Result<Ball, EncloseError> {
        let p = self.precision;
        if let (Function::Atan2, [y, x]) = (function, arguments) {
            return Ok(p.atan2(y, x)?);
        }
        let [x] = arguments else {
            return Err(EncloseError::Malformed);
        };
        let one = Ball::integer(1);
        let value: BallResult = match function {
            Function::Sin => p.sin(x),
            Function::Cos => p.cos(x),
            Function::Tan => p.tan(x),
            Function::Cot => p.sin_cos(x).and_then(|(s, c)| p.div(&c, &s)),
            Function::Sec => p.cos(x).and_then(|c| p.div(&one, &c)),
            Function::Csc => p.sin(x).and_then(|s| p.div(&one, &s)),
            Function::Asin => p.asin(x),
            Function::Acos => p.acos(x),
            Function::Atan => p.atan(x),
            Function::Atan2 => return Err(EncloseError::Malformed),
            Function::Sinh => p.sinh(x),
            Function::Cosh => p.cosh(x),
            Function::Tanh => p.tanh(x),
            Function::Asinh => p.asinh(x),
            Function::Acosh => p.acosh(x),
            Function::Atanh => p.atanh(x),
            Function::Exp => p.exp(x),
            Function::Log => p.log(x),
            Function::Abs => Ok(p.abs(x)),
            Function::Sign => p.signum(x),
        };
        Ok(value?)
    }

    fn solve(&self, matrix: Expr, rhs: &[Expr]) -> Result<Vec<Ball>, EncloseError> {
        let Node::Matrix { rows, entries, .. } = self.graph.node(matrix) else {
            return Err(EncloseError::Malformed);
        };
        let collect = |es: &[Expr]| {
            es.iter()
                .map(|e| self.get(*e).cloned())
                .collect::<Result<Vec<_>, _>>()
        };
        let size = *rows as usize;
        if entries.len() != size * size || rhs.len() != size {
            return Err(EncloseError::Malformed);
        }
        let (entries, rhs) = (collect(entries)?, collect(rhs)?);
        let mut columns = ball::solve(self.precision, size, entries, &[rhs])?;
        columns.pop().ok_or(EncloseError::Malformed)
    }
}
