//! The linear system as a primitive: one factorization at order 0, one solution per order above.

use super::recurrence::{Keep, Order};
use crate::program::Solve;
use crate::scalar::Scalar;

/// A linear system above order 0.
#[derive(Clone, Debug)]
pub(super) struct Linear {
    /// Index of the matrix, which is factorized at order 0.
    pub(super) matrix: usize,
    /// Registers of the right-hand side.
    pub(super) rhs: Vec<u32>,
    /// Row, series of an entry (forward) and of the unknown of its column (in reverse), for entries that vary.
    pub(super) entries: Vec<(u32, u32, u32)>,
    /// Registers of the unknowns, and where their series are stored.
    pub(super) out: Vec<(u32, Keep)>,
}

impl Linear {
    /// The system without its series, which are not known yet.
    pub(super) fn of(solve: &Solve, rhs: Vec<u32>) -> Linear {
        Linear {
            matrix: solve.matrix as usize,
            rhs,
            entries: Vec::new(),
            out: solve.out.iter().map(|r| (r.0, Keep::default())).collect(),
        }
    }

    /// The coefficients of order j of the unknowns; `solve` takes the number of a matrix, the right-hand side and the place of the
    /// solution.
    pub(super) fn run<S: Scalar>(
        &self,
        order: &mut Order<'_, S>,
        solve: &impl Fn(usize, &[S], &mut [S]),
        scratch: &mut [S],
    ) {
        let (b, x) = scratch.split_at_mut(self.rhs.len());
        for (b, &register) in b.iter_mut().zip(&self.rhs) {
            *b = order.now[register as usize];
        }
        for &(row, entry, unknown) in &self.entries {
            b[row as usize] -= order.below(entry, unknown);
        }
        let x = &mut x[..self.rhs.len()];
        solve(self.matrix, b, x);
        for (&(register, keep), &value) in self.out.iter().zip(&*x) {
            order.now[register as usize] = value;
            keep.store(order.series, order.j, value);
        }
    }
}
