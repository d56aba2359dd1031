//! Zeros of a polynomial in one variable as exact numbers: by roots up to the second degree, beyond it as algebraic numbers.

use crate::steady::closed;
use crate::steady_value::precision;
use chetaev_symbolic::factors::{coefficients, irreducible_factors};
use chetaev_symbolic::number::algebraic::zero_between;
use chetaev_symbolic::number::ball::Ball;
use chetaev_symbolic::{rational, Expr, Graph, Rational};
use dashu_int::IBig;

/// What is known of the zeros of a polynomial before any of them is enclosed.
#[derive(Debug, Default)]
pub(crate) struct ExactZeros {
    /// Zeros of factors of the first and the second degree.
    closed: Vec<Expr>,
    /// Factors of higher degree, their coefficients with the constant first.
    higher: Vec<Vec<IBig>>,
}

impl ExactZeros {
    /// The zeros of the polynomial with these coefficients, the constant first. Of higher degree only those with rational coefficients are known.
    pub(crate) fn of(g: &Graph, polynomial: &[Expr]) -> ExactZeros {
        let forms = |own: &[Expr]| -> Vec<Expr> {
            let all = closed_forms(g, own).into_iter();
            all.map(|(e, _)| e).collect()
        };
        if polynomial.len() <= 3 {
            return ExactZeros {
                closed: forms(polynomial),
                higher: Vec::new(),
            };
        }
        let mut found = ExactZeros::default();
        for factor in rational_factors(g, polynomial).unwrap_or_default() {
            if factor.len() > 3 {
                found.higher.push(integers(&factor));
            } else {
                let list: Vec<Expr> = factor.into_iter().map(|c| g.number(c)).collect();
                found.closed.extend(forms(&list));
            }
        }
        found
    }

    /// The one in a ball that holds exactly one zero.
    pub(crate) fn at(&self, g: &Graph, ball: &Ball) -> Option<Expr> {
        let enclosed = |e: Expr| g.enclose(&[e], &precision(), &|_| None).ok()?.pop();
        let meets = |e: &&Expr| enclosed(**e).is_some_and(|own| own.overlaps(ball));
        if let Some(&form) = self.closed.iter().find(meets) {
            return Some(form);
        }
        let (low, high) = (ball.lower().to_rational()?, ball.upper().to_rational()?);
        let mut higher = self.higher.iter();
        let (number, divisor) = higher.find_map(|own| zero_between(own, &low, &high))?;
        let part = Rational::from(1) / Rational::from(divisor);
        Some(g.scale(&part, g.algebraic(number)))
    }
}

/// The irreducible factors of a polynomial with rational coefficients; `None` where one is none.
fn rational_factors(g: &Graph, polynomial: &[Expr]) -> Option<Vec<Vec<Rational>>> {
    // No name of a model contains a space.
    let symbol = g.intern_symbol("zero of a polynomial", 0);
    let x = g.symbol_expr(symbol);
    let terms = polynomial.iter().enumerate();
    let term = |(n, &c): (usize, &Expr)| g.mul(&[closed(g, c), g.powi(x, n as i64)]);
    let whole = g.add(&terms.map(term).collect::<Vec<_>>());
    let parts = irreducible_factors(g, whole, &[symbol])?;
    let numbers = |(part, _): (Expr, u32)| -> Option<Vec<Rational>> {
        let list = coefficients(g, part, symbol)?.into_iter();
        list.map(|c| g.as_number(c).cloned()).collect()
    };
    parts.into_iter().map(numbers).collect()
}

/// The same polynomial up to a factor, with integers as coefficients.
fn integers(polynomial: &[Rational]) -> Vec<IBig> {
    let content = rational::content(polynomial.iter());
    let own = polynomial.iter().map(|c| c / &content);
    own.map(|c| c.numerator().clone()).collect()
}

/// The zeros of a linear or quadratic polynomial in closed form, its coefficients given with the constant first, each with what must not be
/// negative for it to be real. Of two the one with the positive root is first.
pub(crate) fn closed_forms(g: &Graph, coefficients: &[Expr]) -> Vec<(Expr, Option<Expr>)> {
    match *coefficients {
        [b, a] => vec![(closed(g, g.neg(g.div(b, a))), None)],
        [c, b, a] => {
            let product = g.mul(&[g.integer(4), a, c]);
            let discriminant = closed(g, g.sub(g.powi(b, 2), product));
            let root = g.sqrt(discriminant);
            let below = g.mul(&[g.integer(2), a]);
            let of = |root: Expr| closed(g, g.div(g.sub(root, b), below));
            [root, g.neg(root)]
                .map(|root| (of(root), Some(discriminant)))
                .to_vec()
        }
        _ => Vec::new(),
    }
}
