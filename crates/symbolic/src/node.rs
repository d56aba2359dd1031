//! The nodes of an expression graph.

use crate::number::algebraic::AlgebraicInteger;
use crate::rational::Rational;

/// A handle to an interned expression of one [`Graph`](crate::graph::Graph).
///
/// Children always have smaller handles than their parents, so ascending order is a topological order.
/// Two handles of one graph are equal exactly when the expressions are structurally equal.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Expr(pub(crate) u32);

impl Expr {
    /// Position in the graph; usable as an index into tables over all nodes.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A handle to a symbol: a name with an order of differentiation (`x`, `x'`, `x''`).
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Symbol(pub(crate) u32);

/// The elementary functions that are nodes of their own.
///
/// Square roots and reciprocals are powers; `ln` is [`Function::Log`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Cot,
    Sec,
    Csc,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Exp,
    Log,
    Abs,
    Sign,
}

impl Function {
    /// Whether it is a function of an angle: sine, cosine, and what is made of them.
    pub fn is_circular(self) -> bool {
        matches!(
            self,
            Function::Sin
                | Function::Cos
                | Function::Tan
                | Function::Cot
                | Function::Sec
                | Function::Csc
        )
    }

    /// Every function, in declaration order.
    pub const ALL: [Function; 20] = [
        Function::Sin,
        Function::Cos,
        Function::Tan,
        Function::Cot,
        Function::Sec,
        Function::Csc,
        Function::Asin,
        Function::Acos,
        Function::Atan,
        Function::Atan2,
        Function::Sinh,
        Function::Cosh,
        Function::Tanh,
        Function::Asinh,
        Function::Acosh,
        Function::Atanh,
        Function::Exp,
        Function::Log,
        Function::Abs,
        Function::Sign,
    ];

    /// The name in the text format, for example `asin`.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Cot => "cot",
            Function::Sec => "sec",
            Function::Csc => "csc",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Atan2 => "atan2",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Asinh => "asinh",
            Function::Acosh => "acosh",
            Function::Atanh => "atanh",
            Function::Exp => "exp",
            Function::Log => "log",
            Function::Abs => "abs",
            Function::Sign => "sign",
        }
    }

    /// The number of arguments.
    pub fn arity(self) -> usize {
        if self == Function::Atan2 {
            2
        } else {
            1
        }
    }
}

/// One node. Canonical form is established by the constructors of [`Graph`](crate::graph::Graph).
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// The constant π.
    Pi,
    /// A real zero of a monic polynomial with integers as coefficients.
    Algebraic(Box<AlgebraicInteger>),
    /// A symbol.
    Symbol(Symbol),
    /// `constant + Σ coefficient · term`; terms are neither numbers nor sums, and carry no coefficient of their own.
    Sum {
        /// The rational constant.
        constant: Rational,
        /// Pairs (term, non-zero coefficient) in canonical order.
        terms: Box<[(Expr, Rational)]>,
    },
    /// `coefficient · Π factor`; factors are neither numbers nor products, and equal bases are merged into powers.
    Product {
        /// The non-zero rational coefficient.
        coefficient: Rational,
        /// Factors in canonical order.
        factors: Box<[Expr]>,
    },
    /// `base ^ exponent`; `sqrt(x)` is `x^(1/2)`.
    Power {
        /// The base.
        base: Expr,
        /// The exponent, usually a number.
        exponent: Expr,
    },
    /// A function applied to its arguments.
    Apply {
        /// Which function.
        function: Function,
        /// As many arguments as [`Function::arity`] says.
        arguments: Box<[Expr]>,
    },
    /// A matrix, row by row; occurs only as the matrix of a [`Node::Solve`].
    Matrix {
        /// Number of rows.
        rows: u32,
        /// Number of columns.
        columns: u32,
        /// `rows · columns` entries, row by row.
        entries: Box<[Expr]>,
    },
    /// The vector `A⁻¹ b`, kept as one node: it is never expanded into formulas by itself.
    Solve {
        /// The square [`Node::Matrix`] A.
        matrix: Expr,
        /// The right-hand side b.
        rhs: Box<[Expr]>,
    },
    /// A component of a [`Node::Solve`].
    Entry {
        /// The solve.
        of: Expr,
        /// Zero-based component.
        index: u32,
    },
}

impl Node {
    /// Calls `visit` for every child, in order.
    pub fn for_each_child(&self, mut visit: impl FnMut(Expr)) {
        match self {
            Node::Number(_) | Node::Pi | Node::Algebraic(_) | Node::Symbol(_) => {}
            Node::Sum { terms, .. } => terms.iter().for_each(|(term, _)| visit(*term)),
            Node::Product { factors, .. } => factors.iter().for_each(|factor| visit(*factor)),
            Node::Power { base, exponent } => {
                visit(*base);
                visit(*exponent);
            }
            Node::Apply { arguments, .. } => arguments.iter().for_each(|a| visit(*a)),
            Node::Matrix { entries, .. } => entries.iter().for_each(|e| visit(*e)),
            Node::Solve { matrix, rhs } => {
                visit(*matrix);
                rhs.iter().for_each(|b| visit(*b));
            }
            Node::Entry { of, .. } => visit(*of),
        }
    }
}
