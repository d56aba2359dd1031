//! The spectrum in parts: zeros, pairs that are mirror images of each other, and the rest.
//!
//! An irreducible polynomial with an imaginary zero shares it with its mirror image f(−λ), hence is its own: it is even, q(λ²), and all
//! others have no zero on the axis but where their determinants vanish. All zeros of an even polynomial lie on the axis and are simple exactly
//! where those of q are real, negative and simple, hence exactly where q(λ²) + λ q'(λ²) has all zeros left of the axis (Hermite 1856,
//! Biehler 1879). So one method decides all parts.

use crate::characteristic::Characteristic;
use crate::hurwitz::Deciding;
use chetaev_symbolic::factors::{coefficients, irreducible_factors};
use chetaev_symbolic::{Expr, Graph, Symbol};

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
