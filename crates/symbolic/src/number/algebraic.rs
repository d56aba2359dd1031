//! Real algebraic integers: real zeros of monic polynomials with integers as coefficients, exact by polynomial and place.
//!
//! A real zero of any polynomial with rational coefficients is one of these divided by a natural number: where
//! `aₙ xⁿ + … + a₀ = 0` the number `d x` is integral for suitable divisors d of `aₙ`. Zeros are told apart by Sturm's theorem and
//! enclosed to any precision by Newton's method in balls: for x in a ball X in which p' has no zero, the zero lies in
//! `m − p(m)/p'(X)`, m being its middle (R. E. Moore, Interval Analysis, 1966).

use super::ball::{Ball, BallError, BallResult, Precision};
use super::sturm::{changes, count, sequence, slope, value};
use crate::rational::Rational;
use dashu_int::IBig;
use std::cmp::Ordering;

/// A real zero of a monic polynomial with integers as coefficients.
#[derive(Clone, Debug)]
pub struct AlgebraicInteger {
    /// The constant first, without the leading one.
    coefficients: Box<[IBig]>,
    /// How many real zeros are smaller.
    place: usize,
    /// An interval with this zero alone, in which the derivative has none.
    low: Rational,
    high: Rational,
}

// A number is the same however closely it is enclosed.
impl PartialEq for AlgebraicInteger {
    fn eq(&self, other: &AlgebraicInteger) -> bool {
        self.place == other.place && self.coefficients == other.coefficients
    }
}

impl Eq for AlgebraicInteger {}

/// Bits of the enclosure that is kept, in parts of the number.
const BITS: usize = 72;

/// Halvings of an interval before it is given up.
const HALVINGS: usize = 4_000;

/// Newton's steps at most: each doubles the number of bits.
const STEPS: usize = 40;

/// Real zeros of polynomials of higher degrees are not looked at.
const LARGEST: usize = 64;

/// A zero of a polynomial with integers as coefficients, the constant first and the last one not zero, as an algebraic integer divided by
/// a natural number. `None` where not exactly one zero lies between the two places, or the degree is not between 3 and 64: zeros of lower
/// degree have closed forms.
pub fn zero_between(
    polynomial: &[IBig],
    low: &Rational,
    high: &Rational,
) -> Option<(AlgebraicInteger, IBig)> {
    let degree = polynomial.len().checked_sub(1)?;
    if !(3..=LARGEST).contains(&degree) {
        return None;
    }
    let (monic, divisor) = integral(polynomial);
    let scale = Rational::from(divisor.clone());
    let (low, high) = (low * &scale, high * &scale);
    let own = AlgebraicInteger::new(monic, low, high)?;
    Some((own, divisor))
}

/// The polynomial of d x without its leading coefficient, which is one, and d: a divisor of the leading coefficient, as small as its small
/// primes allow.
fn integral(polynomial: &[IBig]) -> (Vec<IBig>, IBig) {
    let degree = polynomial.len() - 1;
    let is_negative = polynomial[degree] < IBig::ZERO;
    let sign = if is_negative {
        IBig::NEG_ONE
    } else {
        IBig::ONE
    };
    let leading = &polynomial[degree] * &sign;
    let below = &polynomial[..degree];
    // d^(n−k) a_k / a_n.
    let scaled = |d: &IBig| -> Option<Vec<IBig>> {
        let own = below.iter().enumerate().map(|(k, a)| {
            let above = d.pow(degree - k) * a * &sign;
            (&above % &leading == IBig::ZERO).then(|| above / &leading)
        });
        own.collect()
    };
    let mut divisor = leading.clone();
    let mut found = scaled(&divisor).unwrap_or_default();
    let magnitude = dashu_base::UnsignedAbs::unsigned_abs(leading.clone());
    for (prime, _) in crate::rational::small_factors(&magnitude).0 {
        let prime = IBig::from(prime);
        while &divisor % &prime == IBig::ZERO {
            let smaller = &divisor / &prime;
            let Some(own) = scaled(&smaller) else { break };
            (divisor, found) = (smaller, own);
        }
    }
    (found, divisor)
}

impl AlgebraicInteger {
    fn new(coefficients: Vec<IBig>, low: Rational, high: Rational) -> Option<AlgebraicInteger> {
        let mut own = AlgebraicInteger {
            coefficients: coefficients.into(),
            place: 0,
            low,
            high,
        };
        let p = own.rational();
        let sequence = sequence(&p);
        let sign = |at: &Rational| value(&p, at).cmp(&Rational::ZERO);
        let (left, right) = (sign(&own.low), sign(&own.high));
        // Zeros at the ends are told apart by nothing; those of even order change no sign.
        if left == right || left == Ordering::Equal || right == Ordering::Equal {
            return None;
        }
        if count(&sequence, &own.low, &own.high) != 1 {
            return None;
        }
        for _ in 0..HALVINGS {
            if own.is_narrow() {
                // At −∞ the signs of a sequence are those far beyond all zeros (Cauchy 1829).
                let sizes = own.coefficients.iter().map(|c| c * c);
                let beyond = sizes.fold(IBig::ONE + IBig::ONE, |sum, c| sum + c);
                let first = Rational::from(-beyond);
                own.place = changes(&sequence, &first) - changes(&sequence, &own.low);
                return Some(own);
            }
            let middle = (&own.low + &own.high) / Rational::from(2);
            match sign(&middle) {
                // A rational zero is no algebraic number of higher degree.
                Ordering::Equal => return None,
                side if side == left => own.low = middle,
                _ => own.high = middle,
            }
        }
        None
    }

    /// The coefficients, the constant first and the leading one, which is one, last.
    pub fn polynomial(&self) -> Vec<IBig> {
        let own = self.coefficients.iter().cloned();
        own.chain([IBig::ONE]).collect()
    }

    fn rational(&self) -> Vec<Rational> {
        self.polynomial().into_iter().map(Rational::from).collect()
    }

    /// The degree of the polynomial.
    pub fn degree(&self) -> usize {
        self.coefficients.len()
    }

    /// How many real zeros of the polynomial are smaller.
    pub fn place(&self) -> usize {
        self.place
    }

    /// A rational interval that holds the number, and no other zero of the polynomial.
    pub fn bounds(&self) -> (&Rational, &Rational) {
        (&self.low, &self.high)
    }

    /// The sign: the interval that is kept holds zero in none of its points.
    pub fn sign(&self) -> Ordering {
        self.low.cmp(&Rational::ZERO)
    }

    /// Whether the interval is small against the number, on one side of zero, and free of zeros of the derivative.
    fn is_narrow(&self) -> bool {
        let (low, high) = (&self.low, &self.high);
        let size = |x: &Rational| x.clone().max(-x.clone());
        let smallest = size(low).min(size(high));
        let is_on_one_side = (*low > Rational::ZERO) == (*high > Rational::ZERO);
        let is_small = (high - low) * Rational::from(IBig::ONE << BITS) < smallest;
        is_on_one_side && is_small && {
            let precision = Precision::new(2 * BITS);
            let over = self.kept(&precision);
            over.and_then(|over| self.slope(&precision, &over))
                .is_ok_and(|slope| slope.excludes_zero())
        }
    }

    fn kept(&self, precision: &Precision) -> BallResult {
        precision.union(
            &precision.rational(&self.low),
            &precision.rational(&self.high),
        )
    }

    fn slope(&self, precision: &Precision, x: &Ball) -> BallResult {
        horner(precision, &slope(&self.rational()), x)
    }

    /// The number to a precision.
    ///
    /// # Errors
    /// [`BallError`], where it is too large.
    pub fn enclose(&self, precision: &Precision) -> BallResult {
        // Further bits, as values near a zero cancel.
        let room = 2 * BITS + 16 * self.degree();
        let fine = Precision::new(precision.bits() + room);
        let mut best = self.kept(&fine)?;
        for _ in 0..STEPS {
            let middle = best.midpoint();
            let slope = self.slope(&fine, &best)?;
            let own = horner(&fine, &self.rational(), &middle)?;
            let next = fine.sub(&middle, &fine.div(&own, &slope)?)?;
            let size = |ball: &Ball| ball.radius().log2_ceil();
            let is_better = match (size(&next), size(&best)) {
                (Some(next), Some(best)) => next < best,
                (next, _) => next.is_none(),
            };
            if !is_better {
                break;
            }
            best = next;
        }
        Ok(best)
    }

    /// A rational number beside it, within 2^-n of itself for n bits and few more.
    pub fn near(&self, bits: usize) -> Rational {
        let ball = self.enclose(&Precision::new(bits));
        let own = ball.ok().and_then(|ball| ball.to_rational());
        own.unwrap_or_else(|| (&self.low + &self.high) / Rational::from(2))
    }

    /// The number in double precision.
    pub fn to_f64(&self) -> f64 {
        let middle = (&self.low + &self.high) / Rational::from(2);
        crate::rational::to_f64(&middle)
    }
}

/// The value of a polynomial.
fn horner(precision: &Precision, p: &[Rational], x: &Ball) -> Result<Ball, BallError> {
    let mut sum = Ball::zero();
    for c in p.iter().rev() {
        sum = precision.add(&precision.mul(&sum, x)?, &precision.rational(c))?;
    }
    Ok(sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{integer, ratio};

    fn zero(polynomial: &[i64], low: i64, high: i64) -> Option<(AlgebraicInteger, IBig)> {
        let list: Vec<IBig> = polynomial.iter().map(|&c| IBig::from(c)).collect();
        zero_between(&list, &integer(low), &integer(high))
    }

    /// x⁵ − x − 1 has one real zero, 1.1673039782614186… (OEIS A160155).
    #[test]
    fn a_zero_is_enclosed_to_any_precision() {
        let (own, divisor) = zero(&[-1, -1, 0, 0, 0, 1], 1, 2).expect("a zero");
        assert_eq!((divisor, own.place(), own.degree()), (IBig::ONE, 0, 5));
        assert!((own.to_f64() - 1.167_303_978_261_418_6).abs() < 1e-15);
        let precision = Precision::new(400);
        let ball = own.enclose(&precision).expect("enclosed");
        assert!(ball.radius().log2_ceil().is_some_and(|bits| bits < -390));
        let (low, high) = ball.to_decimal_interval(20);
        let expected = ["1.1673039782614186842", "1.1673039782614186843"];
        assert_eq!([low, high], expected);
    }

    /// 8 x³ − 6 x − 1 vanishes at cos 20°, cos 140° and cos 260° (Viète); 2 x is integral. Between −2 and 0 there are two of them.
    #[test]
    fn zeros_of_polynomials_that_are_not_monic_are_divided() {
        let list = [-1, -6, 0, 8].map(IBig::from);
        let half = ratio(-1, 2).expect("a number");
        for (place, low, high, degrees) in [
            (0, integer(-1), half.clone(), 140_f64),
            (1, half, integer(0), 260.0),
            (2, integer(0), integer(1), 20.0),
        ] {
            let (own, divisor) = zero_between(&list, &low, &high).expect("a zero");
            assert_eq!((divisor, own.place()), (IBig::from(2), place));
            let expected = degrees.to_radians().cos();
            assert!((own.to_f64() / 2.0 - expected).abs() < 1e-15);
        }
        assert_eq!(zero(&[-1, -6, 0, 8], -2, 0), None);
    }

    #[test]
    fn what_has_a_closed_form_or_no_single_zero_is_none() {
        assert_eq!(zero(&[-2, 0, 1], 0, 2), None);
        assert_eq!(zero(&[-8, 0, 0, 1], 1, 3), None);
        assert_eq!(zero(&[1, 0, 0, 0, 1], -2, 2), None);
    }
}
