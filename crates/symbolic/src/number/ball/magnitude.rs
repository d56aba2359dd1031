//! Upper bounds: non-negative numbers m·2^e with a short mantissa, every operation rounded up.

use std::cmp::Ordering;

use dashu_base::BitTest;
use dashu_int::{IBig, UBig};

/// An upper bound for a non-negative number. 0 is exact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Magnitude {
    /// Zero, or of exactly [`BITS`] bits.
    mantissa: u64,
    exponent: i64,
}

/// Bits of a mantissa: products of two fit in 64 bits.
const BITS: u32 = 30;

impl Magnitude {
    /// The bound 0.
    pub const ZERO: Self = Self {
        mantissa: 0,
        exponent: 0,
    };

    /// 2^exponent.
    pub fn power_of_two(exponent: i64) -> Self {
        Self::round_up(1, exponent)
    }

    /// A bound for |mantissa|·2^exponent.
    pub fn of(mantissa: &IBig, exponent: i64) -> Self {
        let (_, magnitude) = mantissa.clone().into_parts();
        Self::of_natural(&magnitude, exponent)
    }

    /// A bound for mantissa·2^exponent.
    pub fn of_natural(mantissa: &UBig, exponent: i64) -> Self {
        let excess = mantissa.bit_len().saturating_sub(62);
        let top = u64::try_from(&(mantissa >> excess)).unwrap_or(u64::MAX >> 2);
        let round = u64::from(excess > 0);
        Self::round_up(top + round, exponent.saturating_add(excess as i64))
    }

    /// Is the bound 0?
    pub fn is_zero(self) -> bool {
        self.mantissa == 0
    }

    /// a + b or slightly more.
    pub fn plus(self, other: Self) -> Self {
        let (large, small) = if self.cmp(&other) == Ordering::Less {
            (other, self)
        } else {
            (self, other)
        };
        if small.is_zero() {
            return large;
        }
        let shift = (large.exponent - small.exponent).clamp(0, 63) as u32;
        let aligned = (small.mantissa >> shift) + 1;
        Self::round_up(large.mantissa + aligned, large.exponent)
    }

    /// a·b or slightly more.
    pub fn times(self, other: Self) -> Self {
        Self::round_up(
            self.mantissa * other.mantissa,
            self.exponent.saturating_add(other.exponent),
        )
    }

    /// a/b or slightly more, where `other` is taken as exact; `None` for b = 0.
    pub fn over(self, other: Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        let quotient = (self.mantissa << BITS) / other.mantissa + 1;
        if self.is_zero() {
            return Some(Self::ZERO);
        }
        Some(Self::round_up(
            quotient,
            self.exponent
                .saturating_sub(other.exponent)
                .saturating_sub(i64::from(BITS)),
        ))
    }

    /// a·2^shift.
    pub fn shift(self, shift: i64) -> Self {
        if self.is_zero() {
            self
        } else {
            Self {
                exponent: self.exponent.saturating_add(shift),
                ..self
            }
        }
    }

    /// The least e with bound ≤ 2^e; `None` for 0.
    pub fn log2_ceil(self) -> Option<i64> {
        (!self.is_zero()).then(|| self.exponent.saturating_add(i64::from(BITS)))
    }

    /// Mantissa and exponent of the bound, as an exact dyadic number.
    pub fn parts(self) -> (IBig, i64) {
        (IBig::from(self.mantissa), self.exponent)
    }

    fn round_up(mantissa: u64, exponent: i64) -> Self {
        if mantissa == 0 {
            return Self::ZERO;
        }
        let length = 64 - mantissa.leading_zeros();
        if length <= BITS {
            let shift = BITS - length;
            return Self {
                mantissa: mantissa << shift,
                exponent: exponent.saturating_sub(i64::from(shift)),
            };
        }
        let shift = length - BITS;
        let rounded = (mantissa >> shift) + u64::from(mantissa.trailing_zeros() < shift);
        let exponent = exponent.saturating_add(i64::from(shift));
        if rounded >> BITS == 0 {
            Self {
                mantissa: rounded,
                exponent,
            }
        } else {
            Self {
                mantissa: rounded >> 1,
                exponent: exponent.saturating_add(1),
            }
        }
    }
}

impl PartialOrd for Magnitude {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Magnitude {
    fn cmp(&self, other: &Self) -> Ordering {
        // Mantissas of non-zero bounds have one length, so exponents decide first.
        match (self.is_zero(), other.is_zero()) {
            (true, true) => Ordering::Equal,
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
            (false, false) => (self.exponent, self.mantissa).cmp(&(other.exponent, other.mantissa)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::random::Random;
    use dashu_ratio::RBig;

    fn exact(bound: Magnitude) -> RBig {
        let two = RBig::from(2);
        RBig::from(bound.mantissa) * two.pow(bound.exponent as isize)
    }

    #[test]
    fn bounds_are_above_and_close() {
        let mut random = Random::new(4);
        let close = RBig::from_parts_signed(IBig::from(1_000_001), IBig::from(1_000_000));
        for _ in 0..500 {
            let (a, b) = (
                IBig::from(random.next_u64() | 1),
                IBig::from(random.next_u64() | 1),
            );
            let (i, j) = (random.between(-60, 60), random.between(-60, 60));
            let (x, y) = (Magnitude::of(&a, i), Magnitude::of(&b, j));
            let (u, v) = (exact(x), exact(y));
            assert!(u >= RBig::from(a.clone()) * RBig::from(2).pow(i as isize));
            for (bound, value) in [
                (x.plus(y), &u + &v),
                (x.times(y), &u * &v),
                (x.over(y).unwrap(), &u / &v),
            ] {
                let bound = exact(bound);
                assert!(bound >= value && bound <= value * &close);
            }
            assert_eq!(x.cmp(&y), u.cmp(&v));
        }
        assert_eq!(Magnitude::ZERO.plus(Magnitude::ZERO), Magnitude::ZERO);
        assert_eq!(Magnitude::power_of_two(3).over(Magnitude::ZERO), None);
    }
}
