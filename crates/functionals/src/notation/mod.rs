//! Index notation as people write it: `s_ij (delta_kj + u_k,j)`, `A(e)`, `A'_ij(e)`, `(k u,i),i`.
//!
//! A name's last underscore separates its indices, a comma without spaces its derivatives. An index is a letter, a number from
//! 1, or, behind a comma, the name of a coordinate. Names of tensors of rank 0 have no indices. The tokens are those of
//! [`chetaev_symbolic::syntax`]; what tokens mean together is decided here, since a comma means something else there.

mod apart;
mod by_parts;
mod canonical;
mod denominators;
mod densities;
pub mod equations;
mod freedom;
mod indices;
mod parse;
mod print;
mod terms;
mod traction;

pub(crate) use denominators::denominators;
pub use indices::{check, free_letters};
pub use parse::{parse, parse_comparison, parse_sides};
pub use print::{written, written_equation};

use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::{Function, Rational};

/// An index of a component or of a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Index {
    /// A letter: free where it occurs once, summed over where it occurs twice.
    Letter(char),
    /// A place, from 0.
    Place(usize),
}

/// A name with everything that is written at it.
#[derive(Clone, Debug, PartialEq)]
pub struct Atom {
    /// The name without indices.
    pub name: String,
    /// Primes: how often a constitutive function is differentiated.
    pub primes: u32,
    /// Indices of the component.
    pub indices: Vec<Index>,
    /// Indices of derivatives.
    pub derivatives: Vec<Index>,
    /// The argument of a constitutive function.
    pub argument: Option<Box<Node>>,
}

/// What an expression is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// An exact number.
    Number(Rational),
    /// A component of a tensor, a parameter, a coordinate.
    Atom(Atom),
    /// A sum; `true` where a term is subtracted.
    Sum(Vec<(bool, Node)>),
    /// A product; `true` where a factor divides.
    Product(Vec<(bool, Node)>),
    /// A power of scalars.
    Power(Box<Node>, Box<Node>),
    /// An elementary function of scalars.
    Apply(Function, Vec<Node>),
    /// The square root of a scalar.
    Root(Box<Node>),
    /// The derivative of what stands in parentheses.
    Derivative(Box<Node>, Vec<Index>),
}

/// A piece of an expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it is.
    pub kind: Kind,
    /// Where it is written.
    pub span: Span,
}

/// What names mean, as far as reading needs it.
pub trait Names {
    /// Whether a scalar without free indices vanishes identically, as far as the values of names are known.
    fn is_zero(&self, _scalar: &Node) -> bool {
        false
    }
    /// The rank of a tensor of this name, 0 for scalars and parameters; `None` where there is no such name.
    fn rank(&self, name: &str) -> Option<usize>;
    /// Whether the name is a constitutive function, and the rank of its argument.
    fn function(&self, name: &str) -> Option<usize>;
    /// The place of a coordinate among all independent variables.
    fn coordinate(&self, name: &str) -> Option<usize>;
    /// The number of dimensions of space.
    fn dimensions(&self) -> usize;
    /// All names, for suggestions.
    fn all(&self) -> Vec<String>;
}
