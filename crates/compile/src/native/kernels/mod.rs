//! Elementary functions as straight-line code without branches: polynomials, one for all arguments, and for the
//! few arguments they do not cover a guard that calls the library.

mod exponential;
mod logarithm;
mod trigonometric;

pub(crate) use exponential::exp;
pub(crate) use logarithm::log;
pub(crate) use trigonometric::sin_cos;

use super::assembler::{Bits, Predicate};
use super::code::{Builder, Value};

/// Adding this to a number below 2⁵¹ rounds it to an integer, which then stands in the low bits of the sum.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// The sign of a number: −1, 0 or 1; 0 for what is not a number.
pub(crate) fn sign(b: &mut Builder, x: Value) -> Value {
    let (zero, one, minus_one) = (b.constant(0.0), b.constant(1.0), b.constant(-1.0));
    let is_positive = b.compare(Predicate::Less, zero, x);
    let is_negative = b.compare(Predicate::Less, x, zero);
    let positive = b.bits(Bits::And, is_positive, one);
    let negative = b.bits(Bits::And, is_negative, minus_one);
    b.bits(Bits::Or, positive, negative)
}

/// `c[0] + x (c[1] + x (c[2] + …))`, in the order of Estrin, whose chain of dependent operations is short.
fn polynomial(b: &mut Builder, x: Value, coefficients: &[f64]) -> Value {
    let mut terms: Vec<Value> = coefficients.iter().map(|&c| b.constant(c)).collect();
    let mut power = x;
    while terms.len() > 1 {
        terms = terms
            .chunks(2)
            .map(|pair| match *pair {
                [low, high] => b.mul_add(power, high, low),
                _ => pair[0],
            })
            .collect();
        if terms.len() > 1 {
            power = b.mul(power, power);
        }
    }
    terms[0]
}
