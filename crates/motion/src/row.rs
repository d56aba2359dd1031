//! The layout of an output row: q, v, a, λ, and the variables that belong to the formulation alone.

use std::ops::Range;

/// Where what is in an output row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowLayout {
    n: usize,
    r: usize,
    own: usize,
}

impl RowLayout {
    /// For n coordinates and r constraint rows.
    pub fn new(n: usize, r: usize) -> RowLayout {
        RowLayout { n, r, own: 0 }
    }

    /// With so many variables that are no velocities, such as momenta or the multipliers κ of an extremum.
    #[must_use]
    pub fn with_own(self, own: usize) -> RowLayout {
        RowLayout { own, ..self }
    }

    /// Length of a row.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        3 * self.n + self.r + self.own
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

    /// Variables of the formulation alone.
    pub fn own(&self) -> Range<usize> {
        self.lambda().end..self.len()
    }

    /// Fills a row.
    pub fn write(&self, row: &mut [f64], q: &[f64], v: &[f64], a: &[f64], lambda: &[f64]) {
        row[self.q()].copy_from_slice(q);
        row[self.v()].copy_from_slice(v);
        row[self.a()].copy_from_slice(a);
        row[self.lambda()].copy_from_slice(lambda);
    }
}
