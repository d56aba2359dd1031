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
/// multiplicity is the same, since kernels can only grow.
pub fn defects(g: &Graph, question: &Question, at: Option<&RBig>) -> Option<Vec<Defect>> {
    let put = |rows: &[Vec<Expr>]| -> Vec<Vec<Expr>> {
        let value = question.over.zip(at);
        let pairs: Vec<(Expr, Expr)> = value
            .map(|(symbol, at)| (g.symbol_expr(symbol), g.number(at.clone())))
            .into_iter()
            .collect();
        let row = |row: &Vec<Expr>| {
            let row = g.substitute_all(row, &pairs);
            row.into_iter().map(|e| closed(g, e)).collect()
        };
        rows.iter().map(row).collect()
    };
    let (left, right) = (put(&question.linear.left), put(&question.linear.right));
    let n = left.len();
    let mut found = Vec::new();
    let zeros = question.zeros();
    if zeros > question.linear.family {
        let chains = n - rank(g, &right)?;
        if chains < zeros {
            found.push(Defect {
                factor: None,
                multiplicity: zeros,
                chains,
            });
        }
    }
    let repeated = question.spectrum.factors.iter();
    let repeated: Vec<_> = repeated
        .filter(|(f, power)| *power > 1 && is_even(g, f))
        .collect();
    if repeated.is_empty() {
        return Some(found);
    }
    let matrix = product(g, &inverse(g, &left).ok()?, &right);
    for (factor, power) in repeated {
        let degree = factor.len() - 1;
        let kernel = n - rank(g, &value(g, factor, &matrix))?;
        if kernel < degree * *power as usize {
            found.push(Defect {
                factor: Some(factor.clone()),
                multiplicity: *power as usize,
                chains: kernel / degree,
            });
        }
    }
    Some(found)
}

/// The rank of a matrix of closed expressions; `None` where an entry by which was divided may be zero.
fn rank(g: &Graph, rows: &[Vec<Expr>]) -> Option<usize> {
    let columns = rows.first().map_or(0, Vec::len);
    let mut rows = rows.to_vec();
    let pivots = echelon(g, &mut rows, columns);
    let is_sure = pivots.values.iter().all(|&pivot| {
        let is_number = g.symbols_in(&[pivot]).is_empty();
        !is_number || sign_of(g, pivot).is_some_and(|s| s != Ordering::Equal)
    });
    is_sure.then_some(pivots.columns.len())
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
