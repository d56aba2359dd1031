//! Between double-double and exact numbers, and to decimals.

use chetaev_double_double::DoubleDouble;
use chetaev_symbolic::{rational, Rational};

/// The sum of two doubles next to a rational number.
pub fn from_rational(value: &Rational) -> DoubleDouble {
    let high = rational::to_f64(value);
    match Rational::try_from(high) {
        Ok(exact) => DoubleDouble::new(high, rational::to_f64(&(value.clone() - exact))),
        Err(_) => DoubleDouble::from(high),
    }
}

/// The exact value; `None` for what is no number.
pub fn to_rational(value: DoubleDouble) -> Option<Rational> {
    let high = Rational::try_from(value.high()).ok()?;
    Some(high + Rational::try_from(value.low()).ok()?)
}

/// The value with so many significant decimals, rounded half up, in the notation `1.25e-3`; `NaN` for what is no number.
pub fn decimal(value: DoubleDouble, digits: usize) -> String {
    let Some(exact) = to_rational(value) else {
        return "NaN".into();
    };
    if exact.is_zero() {
        return "0".into();
    }
    let sign = if rational::is_negative(&exact) {
        "-"
    } else {
        ""
    };
    let size = rational::abs(&exact);
    let mut exponent = rational::to_f64(&size).log10().floor() as i64;
    loop {
        let text = digits_of(&size, digits as i64 - 1 - exponent);
        // The logarithm may be one off next to a power of ten, and rounding may reach the next one.
        match text.len().cmp(&digits.max(1)) {
            std::cmp::Ordering::Greater => exponent += 1,
            std::cmp::Ordering::Less => exponent -= 1,
            std::cmp::Ordering::Equal => return sign.to_owned() + &notation(&text, exponent),
        }
    }
}

/// The digits of `size · 10^shift` rounded to a whole number.
fn digits_of(size: &Rational, shift: i64) -> String {
    let ten = rational::integer(10);
    let half = Rational::ONE / rational::integer(2);
    let power = rational::powi(&ten, shift).unwrap_or(Rational::ONE);
    (size.clone() * power + half).floor().to_string()
}

/// `d.ddd` times a power of ten, without zeros at its end.
fn notation(digits: &str, exponent: i64) -> String {
    let (first, rest) = digits.split_at(1);
    let rest = rest.trim_end_matches('0');
    let point = if rest.is_empty() { "" } else { "." };
    match exponent {
        0 => format!("{first}{point}{rest}"),
        _ => format!("{first}{point}{rest}e{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tenth_has_its_digits() {
        let tenth = from_rational(&(Rational::ONE / rational::integer(10)));
        assert_eq!(decimal(tenth, 31), "1e-1");
        let third = from_rational(&(Rational::ONE / rational::integer(-3)));
        assert_eq!(decimal(third, 30), format!("-3.{}e-1", "3".repeat(29)));
        assert_eq!(decimal(DoubleDouble::ZERO, 32), "0");
        assert_eq!(decimal(DoubleDouble::from(f64::NAN), 32), "NaN");
        assert_eq!(
            decimal(DoubleDouble::from(0.1), 22),
            "1.000000000000000055511e-1"
        );
        assert_eq!(decimal(DoubleDouble::from(999.96), 4), "1e3");
        assert_eq!(decimal(DoubleDouble::from(1e300), 3), "1e300");
        // π = 3.1415926535 8979323846 2643383279 5028…
        assert_eq!(
            decimal(DoubleDouble::PI, 31),
            "3.14159265358979323846264338328"
        );
    }
}
