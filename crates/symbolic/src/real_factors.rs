//! Factors of a function on whose zero sets it vanishes for real values of some symbols, called velocities here.
//!
//! `z'³ − y³ x'³` is `(z' − y x')` times a form that vanishes where `z' − y x'` does and nowhere else; `z'/x' − y` is `z' − y x'` where
//! x' ≠ 0.

use crate::factors::{coefficients, factored, irreducible_factors};
use crate::one_to_one::innermost;
use crate::zero::assumptions::Assumptions;
use crate::zero::known_sign;
use crate::{Expr, Function, Graph, Node, Rational, Symbol};

/// What a function vanishes by.
#[derive(Clone, Debug, Default)]
pub struct RealFactors {
    /// It vanishes where one of these does and no denominator vanishes.
    pub factors: Vec<Expr>,
    /// Denominators in which velocities occur and which may vanish.
    pub denominators: Vec<Expr>,
}

/// The factors in which velocities occur, without those that vanish nowhere but where another one does.
pub fn real_factors(g: &Graph, f: Expr, velocities: &[Symbol], known: &Assumptions) -> RealFactors {
    let Some(parts) = factored(g, f) else {
        return RealFactors::default();
    };
    let moves = |e: &Expr| g.contains_any(*e, velocities);
    let below = parts.factors.iter().filter(|(_, n)| *n < 0);
    let never_zero = |e: &Expr| known_sign(g, *e, known).is_nonzero();
    let below = below.map(|(e, _)| *e).filter(moves);
    let denominators = below.filter(|e| !never_zero(e)).collect();
    let above = irreducible_factors(g, f, velocities).unwrap_or_default();
    let above = above.into_iter().map(|(e, _)| e);
    let above = above.filter(|e| !never_zero(e));
    let all = above.flat_map(|e| match over_root(g, e, velocities, known) {
        Some(pair) => pair.to_vec(),
        None => vec![e],
    });
    let all: Vec<Expr> = all.collect();
    let is_needed = |&e: &Expr| {
        let mut others = all.iter().filter(|&&other| other != e);
        let is_empty = zeros(g, e, velocities, known).is_some_and(|zeros| zeros.squares.is_empty());
        !is_empty && !others.any(|&other| vanishes_only_with(g, e, other, velocities, known))
    };
    RealFactors {
        factors: all.iter().copied().filter(is_needed).collect(),
        denominators,
    }
}

/// The two linear factors of `a s² + b s + c` where a vanishes nowhere and `b² - 4 a c` is a positive number times the square of a form in the
/// other velocities: `y' - √3 x'` and `y' + √3 x'` of `y'² - 3 x'²`. Roots of parameters would be letters of every search that follows.
fn over_root(g: &Graph, e: Expr, velocities: &[Symbol], known: &Assumptions) -> Option<[Expr; 2]> {
    velocities.iter().find_map(|&symbol| {
        let list = coefficients(g, e, symbol)?;
        let &[c, b, a] = list.as_slice() else {
            return None;
        };
        if g.contains_any(a, velocities) || !known_sign(g, a, known).is_nonzero() {
            return None;
        }
        let four = g.mul(&[g.integer(4), a, c]);
        let parts = factored(g, g.sub(g.mul(&[b, b]), four))?;
        let is_square = parts.factors.iter().all(|(_, n)| n % 2 == 0);
        if !is_square || parts.coefficient <= Rational::ZERO {
            return None;
        }
        let halves = parts.factors.iter().map(|&(f, n)| g.powi(f, n / 2));
        let form = g.mul(&halves.collect::<Vec<Expr>>());
        let by = g.mul(&[g.integer(2), a]);
        let middle = g.add(&[g.symbol_expr(symbol), g.div(b, by)]);
        let root = g.sqrt(g.number(parts.coefficient));
        let aside = g.div(g.mul(&[root, form]), by);
        Some([g.sub(middle, aside), g.add(&[middle, aside])])
    })
}

/// The real zeros of `a s² + b s + c` with `a ≠ 0` and `4 a c − b²` nowhere negative: `2 a s + b = 0` where these all vanish of which
/// `4 a c − b²` is a product.
struct Zeros {
    symbol: Symbol,
    a: Expr,
    b: Expr,
    /// Factors of `4 a c − b²` that may vanish; without any there are no zeros.
    squares: Vec<Expr>,
}

/// The zeros of a quadratic polynomial in a velocity that changes its sign nowhere.
fn zeros(g: &Graph, e: Expr, velocities: &[Symbol], known: &Assumptions) -> Option<Zeros> {
    velocities.iter().find_map(|&symbol| {
        let list = coefficients(g, e, symbol)?;
        let &[c, b, a] = list.as_slice() else {
            return None;
        };
        if !known_sign(g, a, known).is_nonzero() {
            return None;
        }
        let four = g.mul(&[g.integer(4), a, c]);
        let parts = factored(g, g.sub(four, g.mul(&[b, b])))?;
        if parts.coefficient <= Rational::from(0) {
            return None;
        }
        let sign = |f: Expr| known_sign(g, f, known);
        let mut factors = parts.factors.iter();
        if factors.any(|&(f, n)| n < 0 || (n % 2 != 0 && !sign(f).is_nonnegative())) {
            return None;
        }
        let may_vanish = parts.factors.iter().map(|(f, _)| *f);
        let squares = may_vanish.filter(|&f| !sign(f).is_nonzero()).collect();
        Some(Zeros {
            symbol,
            a,
            b,
            squares,
        })
    })
}

/// Functions that vanish together exactly where one does, for real values of some symbols, and are simpler: the base of a power, the argument of
/// an absolute value or of a function that takes its value once, what stands in a sum of squares. `None` where there are none.
pub fn zero_set(g: &Graph, f: Expr, symbols: &[Symbol], known: &Assumptions) -> Option<Vec<Expr>> {
    let inner = match g.node(innermost(g, f)) {
        Node::Apply {
            function: Function::Abs,
            arguments,
        } => arguments[0],
        _ => innermost(g, f),
    };
    let all = irreducible_factors(g, inner, symbols)?;
    let may_vanish = |e: Expr| !known_sign(g, e, known).is_nonzero();
    let own: Vec<Expr> = all.iter().map(|&(e, _)| e).collect();
    let own: Vec<Expr> = own.into_iter().filter(|&e| may_vanish(e)).collect();
    let &[only] = &own[..] else {
        return None;
    };
    let is_same = inner == f && matches!(all[..], [(_, 1)]);
    let parts = zeros(g, only, symbols, known).and_then(|zeros| {
        let [square] = zeros.squares[..] else {
            return None;
        };
        let root = g.symbol_expr(zeros.symbol);
        let slope = g.add(&[g.mul(&[g.integer(2), zeros.a, root]), zeros.b]);
        let rest = zero_set(g, square, symbols, known).unwrap_or_else(|| vec![square]);
        Some([vec![slope], rest].concat())
    });
    match parts {
        Some(parts) => Some(parts),
        None => (!is_same).then(|| vec![only]),
    }
}

/// Whether a factor that changes its sign nowhere vanishes only where another one, linear in the same velocity, does.
fn vanishes_only_with(
    g: &Graph,
    e: Expr,
    other: Expr,
    velocities: &[Symbol],
    known: &Assumptions,
) -> bool {
    let within = || -> Option<bool> {
        let zeros = zeros(g, e, velocities, known)?;
        let list = coefficients(g, other, zeros.symbol)?;
        let &[last, first] = list.as_slice() else {
            return None;
        };
        // 2 a (first s + last) at s = −b/(2 a).
        let value = g.sub(
            g.mul(&[g.integer(2), zeros.a, last]),
            g.mul(&[first, zeros.b]),
        );
        let value = factored(g, value)?;
        if value.coefficient == Rational::from(0) {
            return Some(true);
        }
        let divides = |d: &Expr| {
            let mut factors = value.factors.iter();
            factors.any(|(f, n)| *n > 0 && (f == d || *f == g.neg(*d)))
        };
        Some(!zeros.squares.is_empty() && zeros.squares.iter().all(divides))
    };
    within().unwrap_or(false)
}
