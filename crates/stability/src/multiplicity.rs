//! Whether eigenvalues on the axis are semisimple, so that linear motions stay bounded: kernels of exact matrices.

use crate::question::Question;
use crate::real_roots::sign_of;
use crate::spectrum::{is_even, Polynomial};
use crate::steady::{closed, echelon};
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::{Expr, Graph};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// An eigenvalue with fewer eigenvectors than its multiplicity.
#[derive(Clone, Debug)]
pub struct Defect {
    /// The factor of the characteristic polynomial that vanishes there; `None` for the eigenvalue zero.
    pub factor: Option<Polynomial>,
    /// How often the factor occurs.
    pub multiplicity: usize,
    /// The dimension of its kernel, divided by its degree.
    pub chains: usize,
}

/// The eigenvalues on the axis that are not semisimple, at a value of the parameter that was left in, if one was and one is given.
/// `None` where a rank was not decided.
///
/// Without a value the answer holds for general values of the parameter. An eigenvalue that is semisimple there is so wherever its
/// multiplicity is the same, since kernels can only grow; one that is not may be so at zeros of a minor of the matrix.
pub fn defects(g: &Graph, question: &Question, at: Option<&RBig>) -> Option<Vec<Defect>> {
    let ranks = ranks(g, question, at)?;
    let mut found = Vec::new();
    for own in ranks {
        own.is_sure(g).then_some(())?;
        found.extend(own.defect());
    }
    Some(found)
}

/// Functions of the parameter that was left in: only where one of them vanishes an eigenvalue that is not semisimple for general values may
/// be so. Each is a minor of the matrix whose kernel is asked for, of its rank.
pub(crate) fn where_kernels_grow(g: &Graph, question: &Question) -> Vec<Expr> {
    let ranks = ranks(g, question, None).unwrap_or_default();
    let defective = ranks.iter().filter(|own| own.defect().is_some());
    defective.map(|own| closed(g, g.mul(&own.pivots))).collect()
}

/// The eigenvectors of an eigenvalue on the axis.
struct Kernel {
    /// As in [`Defect`].
    factor: Option<Polynomial>,
    multiplicity: usize,
    chains: usize,
    /// What an elimination divided by.
    pivots: Vec<Expr>,
}

impl Kernel {
    fn new(
        g: &Graph,
        (factor, multiplicity): (Option<&Polynomial>, usize),
        matrix: &[Vec<Expr>],
    ) -> Kernel {
        let columns = matrix.first().map_or(0, Vec::len);
        let pivots = echelon(g, &mut matrix.to_vec(), columns).values;
        let degree = factor.map_or(1, |own| own.len() - 1);
        Kernel {
            factor: factor.cloned(),
            multiplicity,
            chains: (matrix.len() - pivots.len()) / degree,
            pivots,
        }
    }

    /// Whether no pivot that is a number may be zero.
    fn is_sure(&self, g: &Graph) -> bool {
        let is_number = |&&e: &&Expr| g.symbols_in(&[e]).is_empty();
        let mut numbers = self.pivots.iter().filter(is_number);
        numbers.all(|&e| sign_of(g, e).is_some_and(|s| s != Ordering::Equal))
    }

    fn defect(&self) -> Option<Defect> {
        (self.chains < self.multiplicity).then(|| Defect {
            factor: self.factor.clone(),
            multiplicity: self.multiplicity,
            chains: self.chains,
        })
    }
}

/// The kernels of all eigenvalues on the axis that may have fewer eigenvectors than their multiplicity. `None` where the masses have no inverse.
fn ranks(g: &Graph, question: &Question, at: Option<&RBig>) -> Option<Vec<Kernel>> {
    let value_of = question.over.zip(at);
    let pairs = value_of.map(|(symbol, at)| (g.symbol_expr(symbol), g.number(at.clone())));
    let pairs: Vec<(Expr, Expr)> = pairs.into_iter().collect();
    let put = |rows: &[Vec<Expr>]| -> Vec<Vec<Expr>> {
        let row = |row: &Vec<Expr>| {
            let row = g.substitute_all(row, &pairs);
            row.into_iter().map(|e| closed(g, e)).collect()
        };
        rows.iter().map(row).collect()
    };
    let (left, right) = (put(&question.linear.left), put(&question.linear.right));
    let mut found = Vec::new();
    let zeros = question.zeros();
    if zeros > question.linear.family {
        found.push(Kernel::new(g, (None, zeros), &right));
    }
    let factors = question.spectrum.factors.iter();
    let repeated = factors.filter(|(f, power)| *power > 1 && is_even(g, f));
    let repeated: Vec<_> = repeated.collect();
    if repeated.is_empty() {
        return Some(found);
    }
    let matrix = product(g, &inverse(g, &left).ok()?, &right);
    for (factor, power) in repeated {
        let own = (Some(factor), *power as usize);
        found.push(Kernel::new(g, own, &value(g, factor, &matrix)));
    }
    Some(found)
}

/// The product of two matrices, entries in their normal forms.
pub(crate) fn product(g: &Graph, a: &[Vec<Expr>], b: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let columns = b.first().map_or(0, Vec::len);
    let entry = |row: &Vec<Expr>, c: usize| {
        let terms = row.iter().zip(b).map(|(&x, line)| g.mul(&[x, line[c]]));
        closed(g, g.add(&terms.collect::<Vec<_>>()))
    };
    let row = |row: &Vec<Expr>| (0..columns).map(|c| entry(row, c)).collect();
    a.iter().map(row).collect()
}

/// A polynomial of a matrix, by Horner's rule.
fn value(g: &Graph, polynomial: &[Expr], matrix: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let n = matrix.len();
    let mut found = vec![vec![g.zero(); n]; n];
    for &coefficient in polynomial.iter().rev() {
        found = product(g, &found, matrix);
        for (at, row) in found.iter_mut().enumerate() {
            row[at] = closed(g, g.add(&[row[at], coefficient]));
        }
    }
    found
}
