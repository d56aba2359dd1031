//! The remaining elementary functions of balls, composed of the basic ones.

use std::cmp::Ordering;

use dashu_base::{BitTest, Sign};
use dashu_ratio::RBig;

use super::{Ball, BallError, BallResult, Magnitude, Precision};

impl Precision {
    /// tan x.
    pub fn tan(&self, x: &Ball) -> BallResult {
        let (sine, cosine) = self.sin_cos(x)?;
        self.div(&sine, &cosine)
    }

    /// asin x for −1 ≤ x ≤ 1.
    pub fn asin(&self, x: &Ball) -> BallResult {
        let one = Ball::integer(1);
        if x.is_exact()
            && (*x == one || x.neg() == one || self.abs(x).exact_cmp(&one) == Ordering::Equal)
        {
            let quarter = self.pi()?.shift(-1);
            return Ok(if x.sign() == Some(Ordering::Less) {
                quarter.neg()
            } else {
                quarter
            });
        }
        self.require_within_one(x, "an arc sine")?;
        // 1 − x² as (1 − x)(1 + x), without cancellation.
        let inner = Self::new(self.bits() + 8);
        let square = inner.mul(&inner.sub(&one, x)?, &inner.add(&one, x)?)?;
        let ratio = inner.div(x, &inner.sqrt(&square)?)?;
        Ok(inner.atan(&ratio)?.rounded(self.bits()))
    }

    /// acos x = π/2 − asin x for −1 ≤ x ≤ 1.
    pub fn acos(&self, x: &Ball) -> BallResult {
        self.sub(&self.pi()?.shift(-1), &self.asin(x)?)
    }

    fn require_within_one(&self, x: &Ball, what: &'static str) -> Result<(), BallError> {
        let room = self.sub(&Ball::integer(1), &self.abs(x))?;
        match room.sign() {
            Some(Ordering::Greater) => Ok(()),
            Some(Ordering::Less) => Err(BallError::Undefined(what)),
            _ => Err(BallError::Uncertain(what)),
        }
    }

    /// atan2(y, x): the angle of the point (x, y), in (−π, π]; undefined at the origin.
    pub fn atan2(&self, y: &Ball, x: &Ball) -> BallResult {
        let pi = self.pi()?;
        match (y.sign(), x.sign()) {
            (Some(Ordering::Equal), Some(Ordering::Equal)) => {
                Err(BallError::Undefined("the angle of the origin"))
            }
            (_, Some(Ordering::Greater)) => self.atan(&self.div(y, x)?),
            // Away from the negative x axis: π/2 − atan(x/y) above it, −π/2 − atan(x/y) below.
            (Some(Ordering::Greater), _) => self.sub(&pi.shift(-1), &self.atan(&self.div(x, y)?)?),
            (Some(Ordering::Less), _) => {
                self.sub(&pi.shift(-1).neg(), &self.atan(&self.div(x, y)?)?)
            }
            (Some(Ordering::Equal), Some(Ordering::Less)) => Ok(pi),
            _ => Err(BallError::Uncertain("an angle")),
        }
    }

    /// sinh x = (e^x − e^{−x})/2.
    pub fn sinh(&self, x: &Ball) -> BallResult {
        let (inner, (up, down)) = self.exponential_pair(x)?;
        Ok(inner.sub(&up, &down)?.shift(-1).rounded(self.bits()))
    }

    /// cosh x = (e^x + e^{−x})/2.
    pub fn cosh(&self, x: &Ball) -> BallResult {
        let (inner, (up, down)) = self.exponential_pair(x)?;
        Ok(inner.add(&up, &down)?.shift(-1).rounded(self.bits()))
    }

    /// tanh x = 1 − 2/(e^{2x} + 1).
    pub fn tanh(&self, x: &Ball) -> BallResult {
        if x.sign() == Some(Ordering::Equal) {
            return Ok(Ball::zero());
        }
        if x.radius() > Magnitude::power_of_two(4) {
            return Ok(Ball::zero().widened(Magnitude::power_of_two(0)));
        }
        if x.midpoint().log2_ceil().is_some_and(|size| size > 30) {
            let limit = Ball::integer(if x.sign() == Some(Ordering::Less) {
                -1
            } else {
                1
            });
            return Ok(limit.widened(Magnitude::power_of_two(-(1 << 29))));
        }
        let inner = self.cancelling(x);
        let one = Ball::integer(1);
        let double = inner.exp(&x.shift(1))?;
        let part = inner.div(&Ball::integer(2), &inner.add(&double, &one)?)?;
        Ok(inner.sub(&one, &part)?.rounded(self.bits()))
    }

    fn exponential_pair(&self, x: &Ball) -> Result<(Self, (Ball, Ball)), BallError> {
        let inner = self.cancelling(x);
        let up = inner.exp(x)?;
        let down = inner.exp(&x.neg())?;
        Ok((inner, (up, down)))
    }

    /// More bits, as many as the size of a small x makes cancel.
    fn cancelling(&self, x: &Ball) -> Self {
        let lost = x
            .midpoint()
            .log2_ceil()
            .map_or(0, |size| (-size).clamp(0, 4096));
        Self::new(self.bits() + lost as usize + 8)
    }

    /// asinh x = ± log(|x| + √(x² + 1)).
    pub fn asinh(&self, x: &Ball) -> BallResult {
        let inner = self.cancelling(x);
        let negative = x.midpoint().sign() == Some(Ordering::Less);
        let center = if negative {
            x.midpoint().neg()
        } else {
            x.midpoint()
        };
        let root = inner.sqrt(&inner.add(&inner.mul(&center, &center)?, &Ball::integer(1))?)?;
        let value = inner.log(&inner.add(&center, &root)?)?;
        let value = if negative { value.neg() } else { value };
        // Lipschitz constant 1.
        Ok(value.widened(x.radius()).rounded(self.bits()))
    }

    /// acosh x = log(x + √(x² − 1)) for x ≥ 1.
    pub fn acosh(&self, x: &Ball) -> BallResult {
        let one = Ball::integer(1);
        let above = self.sub(x, &one)?;
        match above.sign() {
            Some(Ordering::Equal) => return Ok(Ball::zero()),
            Some(Ordering::Less) => {
                return Err(BallError::Undefined("an inverse hyperbolic cosine below 1"))
            }
            None => return Err(BallError::Uncertain("an inverse hyperbolic cosine")),
            Some(Ordering::Greater) => {}
        }
        let inner = Self::new(self.bits() + 16);
        let square = inner.mul(&above, &inner.add(x, &one)?)?;
        Ok(inner
            .log(&inner.add(x, &inner.sqrt(&square)?)?)?
            .rounded(self.bits()))
    }

    /// atanh x = ½ log((1 + x)/(1 − x)) for −1 < x < 1.
    pub fn atanh(&self, x: &Ball) -> BallResult {
        let one = Ball::integer(1);
        if x.is_exact() && self.abs(x).exact_cmp(&one) == Ordering::Equal {
            return Err(BallError::Undefined("an inverse hyperbolic tangent at ±1"));
        }
        self.require_within_one(x, "an inverse hyperbolic tangent")?;
        let inner = self.cancelling(x);
        let ratio = inner.div(&inner.add(&one, x)?, &inner.sub(&one, x)?)?;
        Ok(inner.log(&ratio)?.shift(-1).rounded(self.bits()))
    }

    /// The sign of x: −1, 0 or 1.
    pub fn signum(&self, x: &Ball) -> BallResult {
        x.sign()
            .map(|sign| Ball::integer(sign as i64))
            .ok_or(BallError::Uncertain("a sign"))
    }

    /// x^r for a rational r. A non-integer power needs x > 0 (or x = 0 with r > 0).
    pub fn pow_rational(&self, x: &Ball, exponent: &RBig) -> BallResult {
        if exponent.is_int() {
            return self.powi(x, exponent.numerator());
        }
        match x.sign() {
            Some(Ordering::Equal) if exponent.sign() == Sign::Positive => return Ok(Ball::zero()),
            Some(Ordering::Equal) => return Err(BallError::Undefined("a negative power of zero")),
            Some(Ordering::Less) => {
                return Err(BallError::Undefined(
                    "a fractional power of a negative number",
                ))
            }
            _ => {}
        }
        let twos = exponent.denominator().trailing_zeros().unwrap_or(0);
        if exponent.denominator().bit_len() == twos + 1 && twos <= 8 {
            // A power with denominator 2^twos is exact where square roots are.
            let inner = Self::new(self.bits() + 8);
            let root = (0..twos).try_fold(x.clone(), |root, _| inner.sqrt(&root))?;
            return Ok(inner
                .powi(&root, exponent.numerator())?
                .rounded(self.bits()));
        }
        self.pow(x, &self.rational(exponent))
    }

    /// x^y = e^{y log x} for x > 0.
    pub fn pow(&self, x: &Ball, y: &Ball) -> BallResult {
        let extra = y.log2_ceil().unwrap_or(0).clamp(0, 64) as usize + 16;
        let inner = Self::new(self.bits() + extra);
        let exponent = inner.mul(y, &inner.log(x)?)?;
        Ok(inner.exp(&exponent)?.rounded(self.bits()))
    }
}
