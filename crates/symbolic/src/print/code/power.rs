//! Powers with a fixed exponent, as multiplications and square roots.

use crate::graph::Graph;
use crate::node::Expr;
use crate::rational;

/// Greatest exponent that is written as a chain of multiplications.
pub(super) const LONGEST_CHAIN: u32 = 4;

/// Greatest whole exponent that is computed by multiplication at all.
const LARGEST_WHOLE: u32 = 64;

/// The power `base^whole · √base`, or its reciprocal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct PowerForm {
    pub(super) whole: u32,
    pub(super) has_root: bool,
    pub(super) is_inverse: bool,
}

impl PowerForm {
    /// The form for an exponent; `None` where the power is left to the library.
    pub(super) fn new(g: &Graph, exponent: Expr) -> Option<PowerForm> {
        let exponent = g.as_number(exponent)?;
        let is_inverse = rational::is_negative(exponent);
        let magnitude = rational::abs(exponent);
        let numerator = u32::try_from(magnitude.numerator()).ok()?;
        let denominator = u32::try_from(magnitude.denominator()).ok()?;
        let (whole, has_root) = match denominator {
            1 if numerator <= LARGEST_WHOLE => (numerator, false),
            2 if numerator / 2 < LONGEST_CHAIN => (numerator / 2, true),
            _ => return None,
        };
        Some(PowerForm {
            whole,
            has_root,
            is_inverse,
        })
    }

    pub(super) fn is_square_root(self) -> bool {
        self.whole == 0 && self.has_root && !self.is_inverse
    }

    /// How often the base is written.
    pub(super) fn uses_of_base(self) -> u32 {
        let factors = match self.whole {
            0..=LONGEST_CHAIN => self.whole,
            _ => 1,
        };
        factors + u32::from(self.has_root)
    }
}
