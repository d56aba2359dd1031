//! Rational numbers from their classes modulo a prime.
//!
//! P. S. Wang, M. J. T. Guy and J. H. Davenport, "P-adic reconstruction of rational numbers", SIGSAM Bulletin 16 (1982).

use dashu_int::{IBig, UBig};

use super::prime_field::{PrimeField, Residue};
use crate::rational::Rational;

/// The rational number n/d of this class with |n| and d below the square root of p/2; there is at most one.
pub fn rational(field: &PrimeField, class: Residue) -> Option<Rational> {
    let p = i128::from(field.modulus());
    let limit = ((field.modulus() / 2) as f64).sqrt() as i128 - 1;
    let (mut r, mut next_r) = (p, i128::from(field.to_u64(class)));
    let (mut s, mut next_s) = (0_i128, 1_i128);
    while next_r > limit {
        let quotient = r / next_r;
        (r, next_r) = (next_r, r - quotient * next_r);
        (s, next_s) = (next_s, s - quotient * next_s);
    }
    if next_s == 0 || next_s.abs() > limit {
        return None;
    }
    let (numerator, denominator) = (next_r * next_s.signum(), next_s.unsigned_abs());
    Some(Rational::from_parts(
        IBig::from(numerator),
        UBig::from(denominator),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    #[test]
    fn small_fractions_come_back() {
        let field = PrimeField::new((1 << 61) - 1).unwrap();
        for (n, d) in [(0, 1), (1, 1), (-7, 3), (1_000_003, 999_983), (-1, 1 << 29)] {
            let number = ratio(n, d).unwrap();
            let class = field.from_rational(&number).unwrap();
            assert_eq!(rational(&field, class), Some(number));
        }
    }
}
