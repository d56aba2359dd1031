//! The characteristic polynomial det(λE − F), exact in the parameters that were left in.
//!
//! Of numbers it is made by primes, with n³ operations for each; entries with parameters or roots take the 2ⁿ minors of a determinant, since a
//! polynomial in many parameters has as many terms as make it useless long before.

use crate::linearization::Linearization;
use crate::steady::closed;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::number::characteristic_polynomial::characteristic_polynomial;
use chetaev_symbolic::{Expr, Graph, Rational};

/// Larger systems have no determinant by minors: 2ⁿ of them.
pub const LARGEST: usize = 14;

/// Larger systems have none in numbers either: the determinants that decide where its zeros lie take n⁴ operations with long integers.
pub const LARGEST_IN_NUMBERS: usize = 64;

/// A polynomial in λ.
#[derive(Clone, Debug)]
pub struct Characteristic {
    /// Its coefficients without the zeros that were split off, the constant first, the leading one last.
    pub coefficients: Vec<Expr>,
    /// How many zero eigenvalues were split off: those of the family of steady motions.
    pub zeros: usize,
    /// How many further eigenvalues are zero for all values of the parameters: none of them belongs to a family that was found.
    pub further_zeros: usize,
}

impl Characteristic {
    /// The characteristic polynomial of linear equations; `None` where they are too large for an exact one.
    pub fn of(g: &Graph, linear: &Linearization) -> Option<Characteristic> {
        let found = match in_numbers(g, linear) {
            Some(found) => found,
            None => by_minors(g, linear)?,
        };
        let vanishing = found.iter().take_while(|&&e| g.is_zero(e)).count();
        let zeros = vanishing.min(linear.family);
        Some(Characteristic {
            coefficients: found[vanishing.min(found.len())..].to_vec(),
            zeros,
            further_zeros: vanishing - zeros,
        })
    }

    /// The same at values of parameters, with the zeros that are so there alone.
    pub fn at(&self, g: &Graph, values: &[(Expr, Expr)]) -> Characteristic {
        let all = g.substitute_all(&self.coefficients, values).into_iter();
        let all: Vec<Expr> = all.map(|e| closed(g, e)).collect();
        let vanishing = all.iter().take_while(|&&e| g.is_zero(e)).count();
        Characteristic {
            coefficients: all[vanishing..].to_vec(),
            zeros: self.zeros,
            further_zeros: self.further_zeros + vanishing,
        }
    }

    /// The degree without the zeros that were split off.
    pub fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }
}

/// The coefficients where all entries are rational numbers and E is regular.
fn in_numbers(g: &Graph, linear: &Linearization) -> Option<Vec<Expr>> {
    if linear.variables.len() > LARGEST_IN_NUMBERS {
        return None;
    }
    let numbers = |rows: &[Vec<Expr>]| -> Option<Vec<Vec<Rational>>> {
        let row = |row: &Vec<Expr>| row.iter().map(|&e| g.as_number(e).cloned()).collect();
        rows.iter().map(row).collect()
    };
    let found = characteristic_polynomial(&numbers(&linear.left)?, &numbers(&linear.right)?)?;
    Some(found.into_iter().map(|c| g.number(c)).collect())
}

/// The coefficients by a determinant of expressions.
fn by_minors(g: &Graph, linear: &Linearization) -> Option<Vec<Expr>> {
    if linear.variables.len() > LARGEST {
        return None;
    }
    let symbol = g.intern_symbol("eigenvalue", 0);
    let lambda = g.symbol_expr(symbol);
    let entry = |(&left, &right): (&Expr, &Expr)| g.sub(g.mul(&[lambda, left]), right);
    let rows = linear.left.iter().zip(&linear.right);
    let matrix: Vec<Vec<Expr>> = rows
        .map(|(l, r)| l.iter().zip(r).map(entry).collect())
        .collect();
    let found = coefficients(g, determinant(g, &matrix), symbol)?;
    Some(found.into_iter().map(|e| closed(g, e)).collect())
}
