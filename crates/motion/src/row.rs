//! The layout of an output row: q, v, a, λ.

use std::ops::Range;

/// Where what is in an output row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowLayout {
    n: usize,
    r: usize,
}

impl RowLayout {
    /// For n coordinates and r constraint rows.
    pub fn new(n: usize, r: usize) -> RowLayout {
        RowLayout { n, r }
    }

    /// Length of a row.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        3 * self.n + self.r
    }

    /// Coordinates.
    pub fn q(&self) -> Range<usize> {
        0..self.n
    }

    /// Velocities.
    pub fn v(&self) -> Range<usize> {
        self.n..2 * self.n
    }

    /// Accelerations.
    pub fn a(&self) -> Range<usize> {
        2 * self.n..3 * self.n
    }

    /// Multipliers by constraint row.
    pub fn lambda(&self) -> Range<usize> {
        3 * self.n..3 * self.n + self.r
    }

    /// Fills a row.
    pub fn write(&self, row: &mut [f64], q: &[f64], v: &[f64], a: &[f64], lambda: &[f64]) {
        row[self.q()].copy_from_slice(q);
        row[self.v()].copy_from_slice(v);
        row[self.a()].copy_from_slice(a);
        row[self.lambda()].copy_from_slice(lambda);
    }
}
