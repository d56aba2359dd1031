//! The characteristic polynomial det(λE − F), exact in the parameters that were left in.

use crate::linearization::Linearization;
use crate::steady::closed;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Graph};

/// Larger systems have no determinant by minors: 2ⁿ of them.
const LARGEST: usize = 14;

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
        let n = linear.variables.len();
        if n > LARGEST {
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
        let found: Vec<Expr> = found.into_iter().map(|e| closed(g, e)).collect();
        let vanishing = found.iter().take_while(|&&e| g.is_zero(e)).count();
        let zeros = vanishing.min(linear.family);
        Some(Characteristic {
            coefficients: found[vanishing.min(found.len())..].to_vec(),
            zeros,
            further_zeros: vanishing - zeros,
        })
    }

    /// The degree without the zeros that were split off.
    pub fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }
}
