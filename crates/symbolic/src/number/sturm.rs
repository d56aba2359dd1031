//! Real zeros of polynomials in one variable, counted by Sturm's theorem.
//!
//! A polynomial with n distinct zeros between two points that are none has n more changes of sign in its Sturm sequence at the left
//! point than at the right one (C. Sturm 1829).

use crate::meter;
use crate::rational::{self, Rational};
use std::cmp::Ordering;

/// Coefficients by ascending powers, the last of them not zero.
pub type Coefficients = Vec<Rational>;

/// Units of work for a product and a difference of rational numbers.
const STEP: u64 = 20;

/// The value at a place.
pub fn value(p: &[Rational], x: &Rational) -> Rational {
    let terms = p.iter().rev();
    terms.fold(Rational::ZERO, |sum, c| {
        rational::sum(&rational::product(&sum, x), c)
    })
}

/// Without leading zeros.
pub fn trimmed(mut p: Coefficients) -> Coefficients {
    while p.last().is_some_and(|c| *c == Rational::ZERO) {
        p.pop();
    }
    p
}

/// The derivative.
pub fn slope(p: &[Rational]) -> Coefficients {
    let own = p.iter().enumerate().skip(1);
    own.map(|(n, c)| rational::product(c, &rational::integer(n as i64)))
        .collect()
}

/// Quotient and remainder.
pub fn divided(p: &[Rational], by: &[Rational]) -> (Coefficients, Coefficients) {
    let mut rest = p.to_vec();
    let Some(leading) = by.last() else {
        return (Vec::new(), rest);
    };
    let mut quotient = vec![Rational::ZERO; (p.len() + 1).saturating_sub(by.len())];
    while rest.len() >= by.len() {
        let Some(last) = rest.last() else { break };
        let factor = last / leading;
        let shift = rest.len() - by.len();
        meter::spend(STEP * by.len() as u64);
        for (own, c) in rest[shift..].iter_mut().zip(by) {
            *own = &*own - &rational::product(&factor, c);
        }
        quotient[shift] = factor;
        rest.pop();
    }
    (quotient, trimmed(rest))
}

/// The same up to a positive factor, with small coefficients.
fn primitive(p: Coefficients) -> Coefficients {
    let content = rational::content(p.iter());
    if content == Rational::ZERO {
        return p;
    }
    let content = rational::abs(&content);
    p.iter().map(|c| c / &content).collect()
}

/// Sturm's sequence: a polynomial, its derivative, and the remainders with opposite signs.
pub fn sequence(p: &[Rational]) -> Vec<Coefficients> {
    let mut all = vec![primitive(p.to_vec()), primitive(slope(p))];
    while let [.., before, last] = &all[..] {
        if last.is_empty() {
            break;
        }
        let (_, rest) = divided(before, last);
        all.push(primitive(rest.iter().map(|c| -c).collect()));
    }
    all.retain(|own| !own.is_empty());
    all
}

/// How often the sign changes along a sequence at a place.
pub fn changes(sequence: &[Coefficients], x: &Rational) -> usize {
    let signs = sequence
        .iter()
        .map(|p| value(p, x).cmp(&Rational::ZERO))
        .filter(|s| *s != Ordering::Equal);
    let signs: Vec<Ordering> = signs.collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

/// How many zeros lie between two places that are none.
pub fn count(sequence: &[Coefficients], low: &Rational, high: &Rational) -> usize {
    let left = changes(sequence, low);
    left.saturating_sub(changes(sequence, high))
}
