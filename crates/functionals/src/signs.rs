//! The sign of a function of one variable on a closed interval: exact for polynomials by Sturm's theorem, by enclosures for others.
//!
//! A function that is no polynomial is enclosed on parts of the interval, which are halved until each has a sign.

use crate::polynomial::Polynomial;
use crate::space::Space;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::number::sturm::{count, divided, sequence, trimmed, value, Coefficients};
use chetaev_symbolic::{rational, Expr, Rational};
use std::cmp::Ordering;

/// The sign of a function on a closed interval.
#[derive(Clone, Debug, PartialEq)]
pub enum Sign {
    /// It is positive everywhere.
    Positive,
    /// It is nowhere negative, and has zeros at the ends alone.
    PositiveInside,
    /// It is nowhere negative, and has zeros inside.
    Nonnegative,
    /// It vanishes identically.
    Zero,
    /// It is negative at this place inside.
    Negative(Rational),
    /// Not known.
    Open,
}

impl Sign {
    /// Whether it is nowhere negative.
    pub fn is_nonnegative(&self) -> bool {
        matches!(
            self,
            Sign::Positive | Sign::PositiveInside | Sign::Nonnegative | Sign::Zero
        )
    }
}

/// Most parts on which a function is enclosed.
const MOST_PARTS: usize = 4_000;

/// Bits of the enclosures.
const BITS: usize = 80;

/// The sign of an expression of the first independent variable between two rational ends.
pub fn on_interval(space: &Space, e: Expr, (lower, upper): (&Rational, &Rational)) -> Sign {
    if space.graph.is_zero(e) || space.vanish(&[e]) {
        return Sign::Zero;
    }
    match Polynomial::of(space, e).and_then(|own| own.in_one_variable()) {
        Some(own) => of_polynomial(own, lower, upper),
        None => enclosed(space, e, lower, upper),
    }
}

/// A value enclosed; `None` where it is not a number.
pub fn enclosure(space: &Space, e: Expr) -> Option<Ball> {
    let own = space.graph.enclose(&[e], &Precision::new(BITS), &|_| None);
    own.ok()?.into_iter().next()
}

fn sign(r: &Rational) -> i8 {
    match r.cmp(&Rational::ZERO) {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

fn middle(lower: &Rational, upper: &Rational) -> Rational {
    rational::sum(lower, upper) / rational::integer(2)
}

fn of_polynomial(p: Coefficients, lower: &Rational, upper: &Rational) -> Sign {
    // Zeros at the ends are divided out: they do not change the sign inside.
    let mut own = trimmed(p);
    let (mut is_zero_at_end, mut is_zero_inside) = (false, false);
    for (end, factor) in [(lower, 1), (upper, -1)] {
        while own.len() > 1 && value(&own, end) == Rational::ZERO {
            let line = [
                rational::product(&rational::integer(-factor), end),
                rational::integer(factor),
            ];
            own = divided(&own, &line).0;
            is_zero_at_end = true;
        }
    }
    let sequence = sequence(&own);
    let mut parts = vec![(lower.clone(), upper.clone())];
    while let Some((a, b)) = parts.pop() {
        for (x, other) in [(&a, &b), (&b, &a)] {
            if sign(&value(&own, x)) < 0 {
                // Negative at an end, and so beside it.
                return Sign::Negative(beside(&own, x, other));
            }
        }
        let count = count(&sequence, &a, &b);
        is_zero_inside |= count > 0;
        if count < 2 {
            continue;
        }
        // A middle that is no zero.
        let mut c = middle(&a, &b);
        while value(&own, &c) == Rational::ZERO {
            c = middle(&a, &c);
        }
        parts.push((a, c.clone()));
        parts.push((c, b));
    }
    if is_zero_inside {
        Sign::Nonnegative
    } else if is_zero_at_end {
        Sign::PositiveInside
    } else {
        Sign::Positive
    }
}

/// A place towards the other one at which a polynomial that is negative here still is.
fn beside(p: &[Rational], x: &Rational, other: &Rational) -> Rational {
    let mut c = middle(x, other);
    while sign(&value(p, &c)) >= 0 {
        c = middle(x, &c);
    }
    c
}

fn enclosed(space: &Space, e: Expr, lower: &Rational, upper: &Rational) -> Sign {
    let g = &space.graph;
    let precision = Precision::new(BITS);
    let variable = space.coordinates.first().and_then(|c| g.as_symbol(c.expr));
    let at = |x: Ball| {
        let own = g.enclose(&[e], &precision, &|s| {
            (Some(s) == variable).then(|| x.clone())
        });
        own.ok()?.first()?.sign()
    };
    let mut parts = vec![(lower.clone(), upper.clone())];
    let mut is_open = false;
    for _ in 0..MOST_PARTS {
        let Some((a, b)) = parts.pop() else {
            return if is_open { Sign::Open } else { Sign::Positive };
        };
        let c = middle(&a, &b);
        if at(precision.rational(&c)) == Some(Ordering::Less) {
            return Sign::Negative(c);
        }
        let whole = precision.union(&precision.rational(&a), &precision.rational(&b));
        match whole.ok().and_then(at) {
            Some(Ordering::Greater) => {}
            _ => {
                is_open |= rational::bit_length(&c) > 60;
                if !is_open {
                    parts.push((a, c.clone()));
                    parts.push((c, b));
                }
            }
        }
    }
    Sign::Open
}

#[cfg(test)]
mod tests {
    use super::{on_interval, Sign};
    use crate::space::Space;
    use chetaev_symbolic::rational::{integer, ratio};
    use chetaev_symbolic::{Expr, Function};

    #[test]
    fn polynomials_and_other_functions_have_signs() {
        let space = Space::new(&[("x".into(), "x".into(), false)]);
        let g = &space.graph;
        let x = space.coordinates[0].expr;
        let sign = |e: Expr| on_interval(&space, e, (&integer(0), &integer(2)));
        let shifted = |n: i64, d: i64| g.sub(x, g.number(ratio(n, d).unwrap()));
        assert_eq!(sign(g.add(&[g.powi(x, 2), g.one()])), Sign::Positive);
        assert_eq!(sign(x), Sign::PositiveInside);
        assert_eq!(sign(g.sub(g.integer(2), x)), Sign::PositiveInside);
        assert_eq!(sign(g.powi(shifted(1, 3), 2)), Sign::Nonnegative);
        // Two zeros a thousandth apart, which no sample finds.
        let narrow = g.mul(&[shifted(1, 3), shifted(334, 1001)]);
        assert!(matches!(sign(narrow), Sign::Negative(_)));
        assert!(matches!(sign(shifted(1, 1)), Sign::Negative(_)));
        let cosine = g.apply(Function::Cos, &[x]);
        assert_eq!(sign(g.add(&[cosine, g.integer(1)])), Sign::Positive);
        assert!(matches!(sign(cosine), Sign::Negative(_)));
        assert_eq!(sign(g.sub(x, x)), Sign::Zero);
    }
}
