//! The rings a program is run in.

use dashu_int::IBig;

use crate::number::modular_matrix::{self, Factorization};
use crate::number::prime_field::{PrimeField, Residue};

/// Why there is no square root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoSquareRoot {
    /// The radicand is a non-square.
    NonSquare,
    /// It is zero: an exceptional point that shows nothing.
    Exceptional,
}

/// A commutative algebra over a prime field, with what an evaluation needs.
pub(super) trait Ring {
    /// An element.
    type Element: Clone;
    /// A factorized matrix.
    type Factors;

    /// The prime field below.
    fn field(&self) -> &PrimeField;
    /// A scalar.
    fn scalar(&self, value: Residue) -> Self::Element;
    /// sum + factor·x.
    fn add_scaled(&self, sum: &mut Self::Element, x: &Self::Element, factor: Residue);
    /// a·b.
    fn mul(&self, a: &Self::Element, b: &Self::Element) -> Self::Element;
    /// 1/a, if a is a unit.
    fn invert(&self, a: &Self::Element) -> Option<Self::Element>;
    /// Is it 0?
    fn is_zero(&self, a: &Self::Element) -> bool;
    /// A square root of `a` for the radical of this number.
    fn square_root(&self, a: &Self::Element, radical: u32) -> Result<Self::Element, NoSquareRoot>;
    /// The q-th root.
    fn odd_root(&self, a: &Self::Element, degree: u64) -> Option<Self::Element>;
    /// Prepares a row-major matrix for solving; `None` if no pivot is a unit.
    fn factorize(&self, size: usize, matrix: Vec<Self::Element>) -> Option<Self::Factors>;
    /// Solves with a prepared matrix.
    fn solve(&self, factors: &Self::Factors, rhs: &[Self::Element]) -> Vec<Self::Element>;

    /// a^n; `None` for a negative power of what is no unit.
    fn power(&self, a: &Self::Element, exponent: &IBig) -> Option<Self::Element> {
        use dashu_base::{BitTest, Sign};
        let (sign, natural) = exponent.clone().into_parts();
        let base = if sign == Sign::Negative {
            self.invert(a)?
        } else {
            a.clone()
        };
        let mut result = self.scalar(self.field().one());
        for bit in (0..natural.bit_len()).rev() {
            result = self.mul(&result, &result);
            if natural.bit(bit) {
                result = self.mul(&result, &base);
            }
        }
        Some(result)
    }
}

/// The prime field itself; roots get the signs chosen in advance.
#[derive(Clone, Debug)]
pub(super) struct Scalars<'a> {
    /// The field.
    pub(super) field: PrimeField,
    /// For each radical: the root of which sign?
    pub(super) negative: &'a [bool],
}

impl Ring for Scalars<'_> {
    type Element = Residue;
    type Factors = Factorization;

    fn field(&self) -> &PrimeField {
        &self.field
    }

    fn scalar(&self, value: Residue) -> Residue {
        value
    }

    fn add_scaled(&self, sum: &mut Residue, x: &Residue, factor: Residue) {
        *sum = self.field.add(*sum, self.field.mul(*x, factor));
    }

    fn mul(&self, a: &Residue, b: &Residue) -> Residue {
        self.field.mul(*a, *b)
    }

    fn invert(&self, a: &Residue) -> Option<Residue> {
        self.field.inv(*a)
    }

    fn is_zero(&self, a: &Residue) -> bool {
        a.is_zero()
    }

    fn square_root(&self, a: &Residue, radical: u32) -> Result<Residue, NoSquareRoot> {
        if a.is_zero() {
            return Err(NoSquareRoot::Exceptional);
        }
        let root = self.field.sqrt(*a).ok_or(NoSquareRoot::NonSquare)?;
        let negative = self
            .negative
            .get(radical as usize)
            .copied()
            .unwrap_or(false);
        Ok(if negative { self.field.neg(root) } else { root })
    }

    fn odd_root(&self, a: &Residue, degree: u64) -> Option<Residue> {
        self.field.unique_root(*a, degree)
    }

    fn factorize(&self, size: usize, matrix: Vec<Residue>) -> Option<Factorization> {
        modular_matrix::factorize(&self.field, size, matrix)
    }

    fn solve(&self, factors: &Factorization, rhs: &[Residue]) -> Vec<Residue> {
        factors.solve(&self.field, rhs)
    }

    fn power(&self, a: &Residue, exponent: &IBig) -> Option<Residue> {
        self.field.pow_integer(*a, exponent)
    }
}
