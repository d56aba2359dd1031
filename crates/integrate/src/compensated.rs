//! Compensated sums for the state and the time of long runs.
//!
//! A number is carried as an unevaluated sum high + low with |low| at most half an ulp of high, so that the
//! rounding of N additions of small increments does not accumulate. Source: Knuth 1969 (two-sum); Kahan 1965;
//! Neumaier 1974; Hairer, Lubich, Wanner 2006, VIII.5. Rust never contracts or reassociates these operations.

/// The sum a + b rounded, and its rounding error, exactly: a + b = sum + error.
#[inline]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_virtual = sum - a;
    let a_virtual = sum - b_virtual;
    (sum, (a - a_virtual) + (b - b_virtual))
}

/// A time as the sum of a float and a small correction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// The time rounded to a float; this is what functions of the system receive.
    pub high: f64,
    /// What is lost by the rounding.
    pub low: f64,
}

impl Time {
    /// A time that is exactly the float `t`.
    pub fn exact(t: f64) -> Time {
        Time { high: t, low: 0.0 }
    }

    /// The time later by h.
    #[must_use]
    pub fn plus(self, h: f64) -> Time {
        let (sum, error) = two_sum(self.high, h);
        let (high, low) = two_sum(sum, error + self.low);
        Time { high, low }
    }

    /// A length next to h after which the time is a float: the system is asked at floats only.
    pub fn to_float(self, h: f64) -> f64 {
        let length = self.until(self.plus(h).high);
        match length * h > 0.0 {
            true => length,
            false => h,
        }
    }

    /// The time from `self` until the float `t`.
    pub fn until(self, t: f64) -> f64 {
        (t - self.high) - self.low
    }
}

/// Adds `increment` to `y + carry` into `y_new + carry_new`, componentwise. Without compensation the carry stays
/// zero and the sum is the plain one.
pub(crate) fn add_increment(
    compensated: bool,
    (y, carry): (&[f64], &[f64]),
    increment: &[f64],
    (y_new, carry_new): (&mut [f64], &mut [f64]),
) {
    for i in 0..y.len() {
        let (sum, error) = two_sum(y[i], increment[i] + carry[i]);
        y_new[i] = sum;
        // An overflowed sum has a meaningless error term; the caller finds the sum itself not finite.
        carry_new[i] = if compensated { error } else { 0.0 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sum_is_exact() {
        let (sum, error) = two_sum(1.0, 2f64.powi(-60));
        assert_eq!((sum, error), (1.0, 2f64.powi(-60)));
        let (sum, error) = two_sum(2f64.powi(-60), 1.0);
        assert_eq!((sum, error), (1.0, 2f64.powi(-60)));
    }

    #[test]
    fn a_million_tenths_are_a_hundred_thousand() {
        let mut t = Time::exact(0.0);
        let mut y = [0.0];
        let mut carry = [0.0];
        let mut plain = 0.0;
        for _ in 0..1_000_000 {
            t = t.plus(0.1);
            plain += 0.1;
            let (y0, carry0) = (y, carry);
            add_increment(true, (&y0, &carry0), &[0.1], (&mut y, &mut carry));
        }
        // fl(0.1) exceeds 1/10 by about 5.55e-18, hence 5.6e-12 over the sum, less than an ulp of 1e5.
        assert_eq!(t.high, 100_000.0);
        assert_eq!(y[0], 100_000.0);
        assert!((plain - 100_000.0_f64).abs() > 1e-7);
    }
}
