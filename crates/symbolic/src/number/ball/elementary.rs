//! π, ln 2, exp, log, sin, cos and atan of balls, by argument reduction and Taylor series in balls.

use std::cell::RefCell;
use std::cmp::Ordering;
use std::thread::LocalKey;

use dashu_int::IBig;
use rustc_hash::FxHashMap;

use super::{Ball, BallError, BallResult, Magnitude, Precision};

/// Extra bits carried inside a function.
const GUARD: usize = 24;
/// Constants are computed to multiples of so many bits.
const STEP: usize = 128;

thread_local! {
    static PI: RefCell<FxHashMap<usize, Ball>> = RefCell::default();
    static LN2: RefCell<FxHashMap<usize, Ball>> = RefCell::default();
}

impl Precision {
    /// The same with more bits, for use inside a function.
    fn guarded(&self, extra: usize) -> Self {
        Self::new(self.bits() + extra)
    }

    /// π, by Machin's formula 16 atan(1/5) − 4 atan(1/239).
    pub fn pi(&self) -> BallResult {
        self.constant(&PI, |inner| {
            let first = inner.reciprocal_series(5, -1)?.shift(4);
            let second = inner.reciprocal_series(239, -1)?.shift(2);
            inner.sub(&first, &second)
        })
    }

    /// ln 2 = 18 atanh(1/26) − 2 atanh(1/4801) + 8 atanh(1/8749).
    pub fn ln2(&self) -> BallResult {
        self.constant(&LN2, |inner| {
            let first = inner.mul(&Ball::integer(18), &inner.reciprocal_series(26, 1)?)?;
            let second = inner.reciprocal_series(4801, 1)?.shift(1);
            let third = inner.reciprocal_series(8749, 1)?.shift(3);
            inner.add(&inner.sub(&first, &second)?, &third)
        })
    }

    /// A constant to these bits, from one that is known to more. How many these are depends on the bits asked for alone, so that
    /// a value does not depend on what was asked before.
    fn constant(
        &self,
        known: &'static LocalKey<RefCell<FxHashMap<usize, Ball>>>,
        compute: impl Fn(&Precision) -> BallResult,
    ) -> BallResult {
        let bits = (self.bits() + GUARD).next_multiple_of(STEP);
        if let Some(value) = known.with_borrow(|known| known.get(&bits).cloned()) {
            return Ok(value.rounded(self.bits()));
        }
        let value = compute(&Precision::new(bits))?;
        known.with_borrow_mut(|known| known.insert(bits, value.clone()));
        Ok(value.rounded(self.bits()))
    }

    /// Σ sign^k / ((2k+1) n^(2k+1)): atan(1/n) for sign −1, atanh(1/n) for sign 1.
    fn reciprocal_series(&self, n: i64, sign: i64) -> BallResult {
        let square = Ball::integer(n * n * sign);
        let mut power = self.div(&Ball::integer(1), &Ball::integer(n))?;
        let mut sum = power.clone();
        let mut k = 1;
        loop {
            power = self.div(&power, &square)?;
            sum = self.add(&sum, &self.div(&power, &Ball::integer(2 * k + 1))?)?;
            k += 1;
            if self.negligible(&power, 0) {
                // The rest is below |power|·Σ n^(−2j) ≤ |power|.
                return Ok(sum.widened(power.magnitude()));
            }
        }
    }

    /// Is |x| below 2^(scale − bits − 2)?
    fn negligible(&self, x: &Ball, scale: i64) -> bool {
        x.log2_ceil()
            .is_none_or(|size| size < scale - self.bits() as i64 - 2)
    }

    /// e^x.
    pub fn exp(&self, x: &Ball) -> BallResult {
        let size = x.log2_ceil().unwrap_or(-1).max(0);
        if size > 40 {
            return Err(BallError::TooLarge("an exponential"));
        }
        let halvings = 6 + (self.bits() as f64).sqrt() as i64 / 2;
        let inner = self.guarded(GUARD + size as usize + 2 * halvings as usize);
        let center = x.midpoint();
        let (multiple, rest) = inner.reduce(&center, &inner.ln2()?)?;
        let small = rest.shift(-halvings);
        let mut value = inner.exp_series(&small)?;
        for _ in 0..halvings {
            value = inner.mul(&value, &value)?;
        }
        let shift = i64::try_from(&multiple).map_err(|_| BallError::TooLarge("an exponential"))?;
        let value = value.shift(shift);
        let value = if x.is_exact() {
            value
        } else {
            inner.scale_by_exp(&value, x.radius())?
        };
        value.rounded(self.bits()).checked("an exponential")
    }

    /// e^x·[e^{−r}, e^r], within |e^x|(e^r − 1) of e^x.
    fn scale_by_exp(&self, value: &Ball, radius: Magnitude) -> BallResult {
        // e^r − 1 ≤ 2r for r ≤ 1.
        if radius <= Magnitude::power_of_two(0) {
            let error = value.magnitude().times(radius.shift(1));
            return Ok(value.clone().widened(error));
        }
        // e^r ≤ 2^(2⌈r⌉)
        let bound = radius
            .log2_ceil()
            .filter(|&size| size < 40)
            .ok_or(BallError::TooLarge("an exponential"))?;
        let error = value.magnitude().shift(2_i64 << bound);
        Ok(value.clone().widened(error))
    }

    /// Σ x^k/k! for |x| ≤ 1/2.
    fn exp_series(&self, x: &Ball) -> BallResult {
        let (mut term, mut sum) = (Ball::integer(1), Ball::integer(1));
        let mut k = 1;
        loop {
            term = self.div(&self.mul(&term, x)?, &Ball::integer(k))?;
            sum = self.add(&sum, &term)?;
            k += 1;
            if self.negligible(&term, 0) {
                // The rest is below |term|·Σ 2^(−j) ≤ |term|.
                return Ok(sum.widened(term.magnitude()));
            }
        }
    }

    /// The nearest integer n to x/unit, and x − n·unit.
    fn reduce(&self, x: &Ball, unit: &Ball) -> Result<(IBig, Ball), BallError> {
        let ratio = self.div(x, unit)?;
        let multiple = nearest_integer(&ratio)?;
        if multiple == IBig::ZERO {
            return Ok((multiple, x.clone()));
        }
        let rest = self.sub(x, &self.mul(unit, &Ball::dyadic(multiple.clone(), 0))?)?;
        Ok((multiple, rest))
    }

    /// The natural logarithm.
    pub fn log(&self, x: &Ball) -> BallResult {
        match x.sign() {
            Some(Ordering::Greater) => {}
            Some(_) => {
                return Err(BallError::Undefined(
                    "a logarithm of a number that is not positive",
                ))
            }
            None if x.upper().sign() == Some(Ordering::Greater) => {
                return Err(BallError::Uncertain("a logarithm"))
            }
            None => {
                return Err(BallError::Undefined(
                    "a logarithm of a number that is not positive",
                ))
            }
        }
        let roots = 4 + (self.bits() as f64).sqrt() as i64 / 4;
        let inner = self.guarded(GUARD + 64 + roots as usize);
        let center = x.midpoint();
        // x₀ = m·2^k with m in [1/2, 1], log x₀ = 2^roots log(m^(1/2^roots)) + k ln 2
        let exponent = center.log2_ceil().unwrap_or(0);
        let mut reduced = center.shift(-exponent);
        for _ in 0..roots {
            reduced = inner.sqrt(&reduced)?;
        }
        let one = Ball::integer(1);
        let ratio = inner.div(&inner.sub(&reduced, &one)?, &inner.add(&reduced, &one)?)?;
        let log = inner.odd_series(&ratio, 1)?.shift(1 + roots);
        let log = inner.add(&log, &inner.mul(&Ball::integer(exponent), &inner.ln2()?)?)?;
        // |log x − log x₀| ≤ r / min x
        let error = x
            .radius()
            .times(super::arithmetic::reciprocal_bound(&x.lower()));
        log.widened(if x.is_exact() { Magnitude::ZERO } else { error })
            .rounded(self.bits())
            .checked("a logarithm")
    }

    /// Σ sign^k x^(2k+1)/(2k+1) for |x| ≤ 1/2: atanh for sign 1, atan for sign −1.
    fn odd_series(&self, x: &Ball, sign: i64) -> BallResult {
        let Some(size) = x.log2_ceil() else {
            return Ok(Ball::zero());
        };
        let square = self.mul(&self.mul(x, x)?, &Ball::integer(sign))?;
        let (mut power, mut sum) = (x.clone(), x.clone());
        let mut k = 1;
        loop {
            power = self.mul(&power, &square)?;
            sum = self.add(&sum, &self.div(&power, &Ball::integer(2 * k + 1))?)?;
            k += 1;
            if self.negligible(&power, size) {
                return Ok(sum.widened(power.magnitude()));
            }
        }
    }

    /// sin x and cos x.
    pub fn sin_cos(&self, x: &Ball) -> Result<(Ball, Ball), BallError> {
        let whole = Ball::zero().widened(Magnitude::power_of_two(0));
        if x.radius() > Magnitude::power_of_two(2) {
            return Ok((whole.clone(), whole));
        }
        let center = x.midpoint();
        let size = center.log2_ceil().unwrap_or(0).max(0);
        if size > 1 << 20 {
            return Err(BallError::TooLarge("the argument of a sine or cosine"));
        }
        let inner = self.guarded(GUARD + size as usize);
        let quarter = inner.pi()?.shift(-1);
        let (multiple, rest) = inner.reduce(&center, &quarter)?;
        let sine = inner.trigonometric_series(&rest, 1)?;
        let cosine = inner.trigonometric_series(&rest, 0)?;
        let quadrant =
            u8::try_from(&(((multiple % IBig::from(4)) + IBig::from(4)) % IBig::from(4)))
                .unwrap_or(0);
        let (sine, cosine) = match quadrant {
            0 => (sine, cosine),
            1 => (cosine, sine.neg()),
            2 => (sine.neg(), cosine.neg()),
            _ => (cosine.neg(), sine),
        };
        // Both have Lipschitz constant 1.
        let finish = |value: Ball| value.widened(x.radius()).rounded(self.bits());
        Ok((finish(sine), finish(cosine)))
    }

    /// Σ (−1)^j x^k/k! over k = first, first + 2, …, for |x| ≤ 1: the sine for first = 1, the cosine for 0.
    fn trigonometric_series(&self, x: &Ball, first: i64) -> BallResult {
        let square = self.mul(x, x)?.neg();
        let mut term = if first == 1 {
            x.clone()
        } else {
            Ball::integer(1)
        };
        let Some(size) = term.log2_ceil() else {
            return Ok(term);
        };
        let mut sum = term.clone();
        let mut k = first;
        loop {
            term = self.div(
                &self.mul(&term, &square)?,
                &Ball::integer((k + 1) * (k + 2)),
            )?;
            sum = self.add(&sum, &term)?;
            k += 2;
            if self.negligible(&term, size) {
                // Each further term is at most half of the one before.
                return Ok(sum.widened(term.magnitude()));
            }
        }
    }

    /// sin x.
    pub fn sin(&self, x: &Ball) -> BallResult {
        Ok(self.sin_cos(x)?.0)
    }

    /// cos x.
    pub fn cos(&self, x: &Ball) -> BallResult {
        Ok(self.sin_cos(x)?.1)
    }

    /// atan x, in (−π/2, π/2).
    pub fn atan(&self, x: &Ball) -> BallResult {
        let halvings = 4;
        let inner = self.guarded(GUARD + 8);
        let center = x.midpoint();
        let large = center.log2_ceil().is_some_and(|size| size > 1);
        let mut reduced = if large {
            inner.div(&Ball::integer(1), &center)?
        } else {
            center.clone()
        };
        for _ in 0..halvings {
            // atan y = 2 atan(y / (1 + √(1 + y²)))
            let square = inner.add(&Ball::integer(1), &inner.mul(&reduced, &reduced)?)?;
            reduced = inner.div(
                &reduced,
                &inner.add(&Ball::integer(1), &inner.sqrt(&square)?)?,
            )?;
        }
        let mut angle = inner.odd_series(&reduced, -1)?.shift(halvings);
        if large {
            let quarter = inner.pi()?.shift(-1);
            let quarter = if center.sign() == Some(Ordering::Less) {
                quarter.neg()
            } else {
                quarter
            };
            angle = inner.sub(&quarter, &angle)?;
        }
        // Lipschitz constant 1; and no atan leaves (−2, 2).
        let angle = angle.widened(x.radius()).rounded(self.bits());
        if angle.radius() > Magnitude::power_of_two(1) {
            return Ok(Ball::zero().widened(Magnitude::power_of_two(1)));
        }
        Ok(angle)
    }
}

/// An integer within 1 of the midpoint.
fn nearest_integer(x: &Ball) -> Result<IBig, BallError> {
    let exponent = x.exponent;
    if exponent >= 0 {
        let shift = usize::try_from(exponent)
            .ok()
            .filter(|&shift| shift <= 1 << 22);
        return shift
            .map(|shift| &x.mantissa << shift)
            .ok_or(BallError::TooLarge("an argument"));
    }
    if exponent < -(1 << 30) {
        return Ok(IBig::ZERO);
    }
    let shift = exponent.unsigned_abs() as usize;
    let half = IBig::from(1) << (shift - 1);
    Ok((&x.mantissa + half) >> shift)
}
