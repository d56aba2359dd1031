//! Functions of one parameter in which square roots stand, and functions without them that vanish wherever they do.
//!
//! With one root taken out, `e = E + O √B`. The norm `E² − B O²` is the product of e and its conjugate `E − O √B`: it vanishes where e does, and
//! contains one root fewer. Where the norm vanishes, e does if its conjugate does not, or if B vanishes too.

use crate::steady::closed;
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::rational::to_i64;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// A function with one of its square roots taken out.
pub(crate) struct Norm {
    /// e, or what has the same zeros where it is defined.
    pub(crate) function: Expr,
    /// `E − O √B`.
    pub(crate) conjugate: Expr,
    /// B.
    pub(crate) radicand: Expr,
    /// `E² − B O²`.
    pub(crate) value: Expr,
}

impl Norm {
    /// The norm over the outermost square root of a function of a symbol; `None` where there is none, the function is no fraction of polynomials in
    /// it, or the norm vanishes everywhere.
    pub(crate) fn of(g: &Graph, e: Expr, symbol: Symbol) -> Option<Norm> {
        let powers = halves(g, e, symbol);
        // Children are made before what contains them.
        let radicand = powers.iter().max_by_key(|own| own.0)?.1;
        // No name of a model contains a space.
        let root = g.intern_symbol("square root", 0);
        let r = g.symbol_expr(root);
        let of_root = powers.iter().filter(|own| own.1 == radicand);
        let put: Vec<(Expr, Expr)> = of_root.map(|&(e, _, n)| (e, g.powi(r, n))).collect();
        let list = coefficients(g, g.substitute(e, &put), root)?;
        let part = |from: usize| {
            let own = list.iter().skip(from).step_by(2).enumerate();
            let terms = own.map(|(n, &c)| g.mul(&[c, g.powi(radicand, n as i64)]));
            g.add(&terms.collect::<Vec<_>>())
        };
        let (even, odd) = (part(0), part(1));
        let times = g.mul(&[
            odd,
            g.pow(radicand, g.number(Rational::ONE / Rational::from(2))),
        ]);
        let squares = [g.powi(even, 2), g.neg(g.mul(&[radicand, g.powi(odd, 2)]))];
        let value = closed(g, g.add(&squares));
        (!g.is_zero(value)).then(|| Norm {
            function: g.add(&[even, times]),
            conjugate: g.sub(even, times),
            radicand,
            value,
        })
    }
}

/// Powers with half a whole number as exponent, of functions of a symbol, absolute values among them: each with its base and twice the exponent.
fn halves(g: &Graph, e: Expr, symbol: Symbol) -> Vec<(Expr, Expr, i64)> {
    let half = |part: Expr| match g.node(part) {
        Node::Power { base, exponent } if g.contains_any(*base, &[symbol]) => {
            let exponent = g.as_number(*exponent)?;
            let twice = exponent * Rational::from(2);
            let is_half = !exponent.denominator().is_one() && twice.denominator().is_one();
            Some((part, *base, to_i64(&twice).filter(|_| is_half)?))
        }
        // |B| is the root of B².
        Node::Apply {
            function: Function::Abs,
            arguments,
        } if g.any_contains_any(arguments, &[symbol]) => {
            Some((part, g.powi(*arguments.first()?, 2), 1))
        }
        _ => None,
    };
    g.reachable(&[e]).into_iter().filter_map(half).collect()
}
