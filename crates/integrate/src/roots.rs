//! Zeros and minima of a function of one variable on an interval.

/// A zero of `f` between a and b, where f(a) = fa and f(b) = fb have opposite signs, to within `accuracy`.
///
/// Inverse quadratic interpolation guarded by bisection; never more than a small multiple of the evaluations of
/// plain bisection. Source: Chandrupatla 1997, Adv. Eng. Softw. 28, 145–149.
///
/// # Errors
/// The first failure of `f`.
pub(crate) fn bracketed_zero<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    (a, fa): (f64, f64),
    (b, fb): (f64, f64),
    accuracy: f64,
) -> Result<f64, E> {
    // The zero lies between the newest point `x1` and the opposite point `x2`; `x3` is the point before.
    let (mut x1, mut f1, mut x2, mut f2) = (b, fb, a, fa);
    let mut fraction = 0.5;
    for _ in 0..200 {
        let x = x1 + fraction * (x2 - x1);
        let fx = f(x)?;
        let (x3, f3);
        if (fx > 0.0) == (f1 > 0.0) {
            (x3, f3) = (x1, f1);
        } else {
            (x3, f3) = (x2, f2);
            (x2, f2) = (x1, f1);
        }
        (x1, f1) = (x, fx);
        let (best, smallest) = if f2.abs() < f1.abs() {
            (x2, f2)
        } else {
            (x1, f1)
        };
        let least = accuracy / (x2 - x1).abs();
        if smallest == 0.0 || least > 0.5 {
            return Ok(best);
        }
        let xi = (x1 - x2) / (x3 - x2);
        let phi = (f1 - f2) / (f3 - f2);
        let interpolate = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
        fraction = if interpolate {
            f1 / (f2 - f1) * f3 / (f2 - f3)
                + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2)
        } else {
            0.5
        };
        fraction = fraction.clamp(least, 1.0 - least);
    }
    Ok(x1)
}

/// The place and value of a minimum of `f` between a and b, by golden sections; `f` is unimodal there. The place is
/// found to about the square root of the rounding, which is all that the values determine.
///
/// # Errors
/// The first failure of `f`.
pub(crate) fn minimum<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    mut a: f64,
    mut b: f64,
) -> Result<(f64, f64), E> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut left, mut right) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut f_left, mut f_right) = (f(left)?, f(right)?);
    for _ in 0..40 {
        if f_left <= f_right {
            (b, right, f_right) = (right, left, f_left);
            left = b - GOLDEN * (b - a);
            f_left = f(left)?;
        } else {
            (a, left, f_left) = (left, right, f_right);
            right = a + GOLDEN * (b - a);
            f_right = f(right)?;
        }
    }
    Ok(if f_left <= f_right {
        (left, f_left)
    } else {
        (right, f_right)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    fn zero(f: fn(f64) -> f64, a: f64, b: f64) -> (f64, u32) {
        let mut calls = 0;
        let root = bracketed_zero(
            |x| {
                calls += 1;
                Ok::<f64, Infallible>(f(x))
            },
            (a, f(a)),
            (b, f(b)),
            1e-15,
        );
        (root.unwrap(), calls)
    }

    #[test]
    fn zeros_are_found_to_round_off() {
        let (x, calls) = zero(|x| x.cos() - x, 0.0, 1.0);
        assert!((x - 0.739_085_133_215_160_6).abs() < 2e-15, "{x}");
        assert!(calls < 12, "{calls}");
        // A triple root, where interpolation is useless: bisection bounds the work.
        let (x, calls) = zero(|x| (x - 0.3).powi(3), 0.0, 1.0);
        assert!((x - 0.3).abs() < 1e-15);
        assert!(calls < 170, "{calls}");
        let (x, _) = zero(|x| if x < 0.7 { -1.0 } else { 1.0 }, 0.0, 1.0);
        assert!((x - 0.7).abs() < 2e-15);
        assert_eq!(zero(|x| x - 0.5, 0.0, 1.0).0, 0.5);
    }

    #[test]
    fn minima_are_found() {
        let f = |x: f64| Ok::<f64, Infallible>((x - 0.3).powi(2) + 2.0);
        let (x, value) = minimum(f, 0.0, 1.0).unwrap();
        assert!((x - 0.3).abs() < 3e-8 && (value - 2.0).abs() < 1e-15);
    }
}
