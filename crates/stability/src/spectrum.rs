//! The spectrum in parts: zeros, pairs that are mirror images of each other, and the rest.
//!
//! An irreducible polynomial with an imaginary zero shares it with its mirror image f(−λ), hence is its own: it is even, q(λ²), and all
//! others have no zero on the axis but where their determinants vanish. All zeros of an even polynomial lie on the axis and are simple exactly
//! where those of q are real, negative and simple, hence exactly where q(λ²) + λ q'(λ²) has all zeros left of the axis (Hermite 1856,
//! Biehler 1879). So one method decides all parts.

use crate::characteristic::Characteristic;
use crate::hurwitz::Deciding;
use crate::steady::closed;
use chetaev_symbolic::factors::{coefficients, irreducible_factors};
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// A polynomial in λ, its coefficients with the constant first.
pub type Polynomial = Vec<Expr>;

/// The factors of a characteristic polynomial without its zeros at 0.
#[derive(Clone, Debug, Default)]
pub struct Spectrum {
    /// Irreducible factors as far as they were found, with their multiplicities.
    pub factors: Vec<(Polynomial, u32)>,
    /// The product of the even ones, each once.
    pub paired: Option<Polynomial>,
}

impl Spectrum {
    /// The factors of a characteristic polynomial.
    pub fn of(g: &Graph, polynomial: &Characteristic) -> Spectrum {
        let symbol = g.intern_symbol("eigenvalue", 0);
        let whole = expression(g, symbol, &polynomial.coefficients);
        let list = irreducible_factors(g, whole, &[symbol]);
        let list = list.and_then(|list| {
            let read = |(e, power): (Expr, u32)| Some((coefficients(g, e, symbol)?, power));
            list.into_iter().map(read).collect()
        });
        let factors: Vec<(Polynomial, u32)> = match list {
            Some(list) => list,
            None if polynomial.degree() == 0 => Vec::new(),
            None => vec![(polynomial.coefficients.clone(), 1)],
        };
        let factors: Vec<(Polynomial, u32)> = factors
            .into_iter()
            .flat_map(|(f, power)| {
                let parts = in_mirror_parts(g, f).into_iter();
                parts.map(move |own| (own, power))
            })
            .collect();
        let even = factors.iter().filter(|(f, _)| is_even(g, f));
        let even: Vec<Expr> = even.map(|(f, _)| expression(g, symbol, f)).collect();
        let paired = match even.as_slice() {
            [] => None,
            even => coefficients(g, g.mul(even), symbol),
        };
        Spectrum { factors, paired }
    }

    /// The polynomials that decide where the eigenvalues lie.
    pub fn deciding(&self, g: &Graph) -> Vec<Deciding> {
        let plain = self.factors.iter().filter(|(f, _)| !is_even(g, f));
        let plain = plain.map(|(f, _)| Deciding {
            coefficients: f.clone(),
            is_paired: false,
        });
        let paired = self.paired.iter().map(|own| Deciding {
            coefficients: of_pairs(g, own),
            is_paired: true,
        });
        plain.chain(paired).collect()
    }
}

/// A polynomial as the part that is its own mirror image and the rest. With f(λ) = e(λ²) + λ o(λ²) that part is the greatest common divisor of e and
/// o, by Euclid's algorithm with the zero test. An irreducible polynomial has none; where functions of parameters stand in the coefficients, as
/// roots and sines do, not every factor is found as one of polynomials.
fn in_mirror_parts(g: &Graph, own: Polynomial) -> Vec<Polynomial> {
    let is_plain = own.iter().all(|&e| is_rational(g, e));
    if is_plain || is_even(g, &own) {
        return vec![own];
    }
    let part = |from: usize| trimmed(g, own.iter().skip(from).step_by(2).copied().collect());
    let common = common_divisor(g, part(0), part(1));
    if common.len() < 2 {
        return vec![own];
    }
    // q(λ²).
    let zero = g.zero();
    let mut mirror: Polynomial = common.into_iter().flat_map(|e| [e, zero]).collect();
    mirror.pop();
    let (rest, _) = divided(g, &own, &mirror);
    if rest.len() < 2 {
        return vec![mirror];
    }
    vec![mirror, rest]
}

/// Whether an expression is a fraction of polynomials with rational coefficients.
fn is_rational(g: &Graph, e: Expr) -> bool {
    let parts = g.reachable(&[e]);
    parts.into_iter().all(|part| match g.node(part) {
        Node::Number(_) | Node::Symbol(_) | Node::Sum { .. } | Node::Product { .. } => true,
        Node::Power { exponent, .. } => g.as_integer(*exponent).is_some(),
        _ => false,
    })
}

/// Without leading coefficients that vanish.
fn trimmed(g: &Graph, mut own: Polynomial) -> Polynomial {
    while own.last().is_some_and(|&e| g.is_zero(e)) {
        own.pop();
    }
    own
}

/// The greatest common divisor with the leading coefficient 1.
fn common_divisor(g: &Graph, mut one: Polynomial, mut other: Polynomial) -> Polynomial {
    while !other.is_empty() {
        let (_, rest) = divided(g, &one, &other);
        (one, other) = (other, rest);
    }
    let Some(&leading) = one.last() else {
        return one;
    };
    one.into_iter()
        .map(|e| closed(g, g.div(e, leading)))
        .collect()
}

/// Quotient and rest of polynomials.
fn divided(g: &Graph, one: &[Expr], by: &[Expr]) -> (Polynomial, Polynomial) {
    let Some(&leading) = by.last() else {
        return (Vec::new(), one.to_vec());
    };
    let mut rest = one.to_vec();
    let mut quotient = vec![g.zero(); (one.len() + 1).saturating_sub(by.len())];
    while rest.len() >= by.len() {
        let Some(highest) = rest.pop() else {
            break;
        };
        let factor = closed(g, g.div(highest, leading));
        let shift = rest.len() + 1 - by.len();
        quotient[shift] = factor;
        for (k, &e) in by.iter().enumerate().take(by.len() - 1) {
            let own = g.sub(rest[shift + k], g.mul(&[factor, e]));
            rest[shift + k] = closed(g, own);
        }
    }
    (quotient, trimmed(g, rest))
}

/// Whether only even powers occur.
pub fn is_even(g: &Graph, polynomial: &[Expr]) -> bool {
    let mut odd = polynomial.iter().skip(1).step_by(2);
    odd.all(|&e| g.is_zero(e))
}

/// A polynomial with these coefficients.
pub fn expression(g: &Graph, symbol: Symbol, polynomial: &[Expr]) -> Expr {
    let power = |(n, &e): (usize, &Expr)| g.mul(&[e, g.powi(g.symbol_expr(symbol), n as i64)]);
    let terms: Vec<Expr> = polynomial.iter().enumerate().map(power).collect();
    g.add(&terms)
}

/// q(λ²) + λ q'(λ²) for q(λ²).
fn of_pairs(g: &Graph, own: &[Expr]) -> Polynomial {
    let even: Vec<Expr> = own.iter().step_by(2).copied().collect();
    let slope = |i: usize| g.mul(&[g.integer(i as i64 + 1), even[i + 1]]);
    let mut found = Vec::new();
    for (i, &e) in even.iter().enumerate() {
        found.push(e);
        if i + 1 < even.len() {
            found.push(slope(i));
        }
    }
    found
}
