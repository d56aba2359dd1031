//! Exact rational numbers: the coefficients of every expression.

use dashu_base::{Abs, Signed, UnsignedAbs};
use dashu_int::{IBig, UBig};

/// An exact rational number in lowest terms.
pub type Rational = dashu_ratio::RBig;

/// The rational `numerator / denominator`; `None` when the denominator is zero.
pub fn ratio(numerator: i64, denominator: i64) -> Option<Rational> {
    if denominator == 0 {
        return None;
    }
    Some(Rational::from_parts_signed(
        IBig::from(numerator),
        IBig::from(denominator),
    ))
}

/// The integer `value` as a rational.
pub fn integer(value: i64) -> Rational {
    Rational::from(IBig::from(value))
}

/// `a b`. Most coefficients are one or integers: there is no common factor to be looked for.
pub fn product(a: &Rational, b: &Rational) -> Rational {
    if a.is_one() {
        b.clone()
    } else if b.is_one() {
        a.clone()
    } else if a.is_int() && b.is_int() {
        Rational::from(a.numerator() * b.numerator())
    } else {
        a * b
    }
}

/// `a + b`, as [`product`].
pub fn sum(a: &Rational, b: &Rational) -> Rational {
    if a.is_zero() {
        b.clone()
    } else if b.is_zero() {
        a.clone()
    } else if a.is_int() && b.is_int() {
        Rational::from(a.numerator() + b.numerator())
    } else {
        a + b
    }
}

/// The number that a double is, exactly; `None` where it is none.
pub fn from_f64(value: f64) -> Option<Rational> {
    Rational::try_from(value).ok()
}

/// Whether `r < 0`.
pub fn is_negative(r: &Rational) -> bool {
    r.is_negative() && !r.is_zero()
}

/// The value as `i64` when it is an integer that fits.
pub fn to_i64(r: &Rational) -> Option<i64> {
    if r.is_int() {
        i64::try_from(r.numerator()).ok()
    } else {
        None
    }
}

/// The nearest double.
pub fn to_f64(r: &Rational) -> f64 {
    r.to_f64().value()
}

/// `r^n` for any integer `n`; `None` for `0^n` with `n < 0` and for results beyond a million bits.
pub fn powi(r: &Rational, n: i64) -> Option<Rational> {
    if n == 0 {
        return Some(Rational::ONE);
    }
    if r.is_zero() {
        return if n > 0 { Some(Rational::ZERO) } else { None };
    }
    let magnitude = usize::try_from(n.unsigned_abs()).ok()?;
    let bits = bit_length(r);
    if bits > 1 && bits.saturating_mul(magnitude) > 1_000_000 {
        return None;
    }
    let (numerator, denominator) = r.clone().into_parts();
    let numerator = numerator.pow(magnitude);
    let denominator = denominator.pow(magnitude);
    Some(if n > 0 {
        Rational::from_parts(numerator, denominator)
    } else {
        Rational::from_parts_signed(IBig::from(denominator), numerator)
    })
}

/// The larger bit length of numerator and denominator.
pub fn bit_length(r: &Rational) -> usize {
    use dashu_base::BitTest;
    r.numerator().bit_len().max(r.denominator().bit_len())
}

/// The exact `n`-th root of a non-negative rational when it is rational.
pub fn exact_root(r: &Rational, n: u32) -> Option<Rational> {
    if is_negative(r) || n == 0 {
        return None;
    }
    let numerator = exact_integer_root(&r.numerator().clone().unsigned_abs(), n)?;
    let denominator = exact_integer_root(r.denominator(), n)?;
    Some(Rational::from_parts(IBig::from(numerator), denominator))
}

fn exact_integer_root(value: &UBig, n: u32) -> Option<UBig> {
    let root = value.nth_root(n as usize);
    if root.pow(n as usize) == *value {
        Some(root)
    } else {
        None
    }
}

/// Splits an integer into small prime powers and a cofactor without prime factor below 1000.
pub(crate) fn small_factors(value: &UBig) -> (Vec<(u32, u32)>, UBig) {
    let mut rest = value.clone();
    let mut factors = Vec::new();
    if rest.is_zero() {
        return (factors, rest);
    }
    let mut p = 2u32;
    while p < 1000 && !rest.is_one() {
        let divisor = UBig::from(p);
        let mut exponent = 0;
        while (&rest % &divisor).is_zero() {
            rest /= &divisor;
            exponent += 1;
        }
        if exponent > 0 {
            factors.push((p, exponent));
        }
        p += if p == 2 { 1 } else { 2 };
    }
    (factors, rest)
}

/// The positive content of a set of rationals: gcd of numerators over lcm of denominators; zero for none.
pub fn content<'a>(values: impl Iterator<Item = &'a Rational>) -> Rational {
    use dashu_base::Gcd;
    let mut numerator = UBig::ZERO;
    let mut denominator = UBig::ONE;
    for value in values {
        if !numerator.is_one() {
            let magnitude = value.numerator().clone().unsigned_abs();
            numerator = if numerator.is_zero() {
                magnitude
            } else if magnitude.is_zero() {
                numerator
            } else {
                (&numerator).gcd(&magnitude)
            };
        }
        if !value.is_int() {
            let shared = (&denominator).gcd(value.denominator());
            denominator *= value.denominator() / shared;
        }
    }
    Rational::from_parts(IBig::from(numerator), denominator)
}

/// The absolute value.
pub fn abs(r: &Rational) -> Rational {
    r.clone().abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_exact_or_absent() {
        assert_eq!(exact_root(&ratio(9, 4).unwrap(), 2), ratio(3, 2));
        assert_eq!(exact_root(&ratio(2, 1).unwrap(), 2), None);
        assert_eq!(exact_root(&ratio(-8, 1).unwrap(), 3), None);
    }

    #[test]
    fn sums_and_products_take_no_short_way_to_another_value() {
        let values = [(0, 1), (1, 1), (-1, 1), (7, 1), (1, 2), (-7, 6), (6, 35)];
        let values = values.map(|(n, d)| ratio(n, d).unwrap());
        for a in &values {
            for b in &values {
                assert_eq!(product(a, b), a * b);
                assert_eq!(sum(a, b), a + b);
            }
        }
    }

    #[test]
    fn content_divides_all() {
        let values = [ratio(4, 3).unwrap(), ratio(-10, 9).unwrap()];
        assert_eq!(Some(content(values.iter())), ratio(2, 9));
    }

    #[test]
    fn zero_has_no_negative_power() {
        assert_eq!(powi(&Rational::ZERO, -1), None);
        assert_eq!(powi(&ratio(-2, 3).unwrap(), -3), ratio(-27, 8));
    }
}
