//! Exact numbers as literals of double precision.

use super::language::Language;
use crate::rational::{self, Rational};
use dashu_int::UBig;

/// Numerators and denominators below this are written as they are.
const LARGEST_PART: u64 = 10_000_000;

/// A positive number as source code; either has the nearest double for its value.
pub(super) enum Literal {
    /// One literal.
    Whole(String),
    /// Numerator and denominator, of which both are doubles.
    Quotient(String, String),
}

/// The magnitude of `value` as source code.
pub(super) fn magnitude(value: &Rational, language: Language) -> Literal {
    let value = rational::abs(value);
    let small = |part: Option<u64>| part.filter(|&part| part < LARGEST_PART);
    let numerator = small(u64::try_from(value.numerator()).ok());
    let denominator = small(u64::try_from(value.denominator()).ok());
    match (numerator, denominator) {
        (Some(p), Some(q)) if !has_finite_decimals(value.denominator()) => {
            Literal::Quotient(format!("{p}.0"), format!("{q}.0"))
        }
        _ => Literal::Whole(nearest(&value, language)),
    }
}

/// The shortest decimal that is read as the nearest double: 17 digits at most.
fn nearest(value: &Rational, language: Language) -> String {
    let double = rational::to_f64(value);
    if double.is_finite() {
        format!("{double:?}")
    } else {
        language.infinity().to_string()
    }
}

fn has_finite_decimals(denominator: &UBig) -> bool {
    let Ok(mut rest) = u64::try_from(denominator) else {
        return false;
    };
    for prime in [2, 5] {
        while rest > 1 && rest % prime == 0 {
            rest /= prime;
        }
    }
    rest == 1
}
