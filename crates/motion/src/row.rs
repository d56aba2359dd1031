//! The layout of an output row: q, masses with a law of their own, v, a, λ, and the variables that belong to the formulation alone.

use std::ops::Range;

/// Where what is in an output row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowLayout {
    n: usize,
    masses: usize,
    r: usize,
    own: usize,
}

impl RowLayout {
    /// For n coordinates and r constraint rows.
    pub fn new(n: usize, r: usize) -> RowLayout {
        RowLayout {
            n,
            masses: 0,
            r,
            own: 0,
        }
    }

    /// With so many masses that have a law of their own.
    #[must_use]
    pub fn with_masses(self, masses: usize) -> RowLayout {
        RowLayout { masses, ..self }
    }

    /// With so many variables that are no velocities, such as momenta or the multipliers κ of an extremum.
    #[must_use]
    pub fn with_own(self, own: usize) -> RowLayout {
        RowLayout { own, ..self }
    }

    /// Length of a row.
    #[allow(clippy::len_without_is_empty)]
    pub fn len(&self) -> usize {
        3 * self.n + self.masses + self.r + self.own
    }

    /// Coordinates.
    pub fn q(&self) -> Range<usize> {
        0..self.n
    }

    /// Masses with a law of their own.
    pub fn masses(&self) -> Range<usize> {
        self.n..self.positions().end
    }

    /// Coordinates and masses, the part of the state that is no velocity.
    pub fn positions(&self) -> Range<usize> {
        0..self.n + self.masses
    }

    /// Velocities.
    pub fn v(&self) -> Range<usize> {
        let start = self.positions().end;
        start..start + self.n
    }

    /// Accelerations.
    pub fn a(&self) -> Range<usize> {
        let start = self.v().end;
        start..start + self.n
    }

    /// Multipliers by constraint row.
    pub fn lambda(&self) -> Range<usize> {
        let start = self.a().end;
        start..start + self.r
    }

    /// Variables of the formulation alone.
    pub fn own(&self) -> Range<usize> {
        self.lambda().end..self.len()
    }

    /// Fills a row; q with the masses behind it.
    pub fn write(&self, row: &mut [f64], q: &[f64], v: &[f64], a: &[f64], lambda: &[f64]) {
        row[self.positions()].copy_from_slice(q);
        row[self.v()].copy_from_slice(v);
        row[self.a()].copy_from_slice(a);
        row[self.lambda()].copy_from_slice(lambda);
    }
}
