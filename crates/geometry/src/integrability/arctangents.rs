//! Arctangents among which functions are searched that constraints keep.

use super::integral::is_free;
use crate::noether::shown::readable;
use chetaev_mechanics::system::Coordinate;
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Function, Graph, Rational};

/// Larger denominators, in nodes, are not compared with those of arctangents.
const DENOMINATOR: usize = 60;

/// The arctangents whose derivatives have one of these denominators, `a (x - x₀)² + b (y - y₀)²` of two coordinates or
/// `a (x - x₀)² + b` of one; the angles on ellipses that holonomic constraints fix, also times these sums: areas.
pub(super) fn arctangents(cx: &Context<'_>, denominators: &[Expr]) -> Vec<Expr> {
    let g = &cx.system.graph;
    let small = |e: &&Expr| g.reachable(&[**e]).len() <= DENOMINATOR;
    let of_denominator = |&e: &Expr| {
        let Squares { squares, rest, .. } = Squares::of(cx, e);
        match squares[..] {
            [x, y] if g.is_zero(rest) => angle(g, x, y),
            [(a, x)] if is_free(cx, rest) && !g.is_zero(rest) => {
                let by = g.sqrt(g.div(a, rest));
                Some(g.apply(Function::Atan, &[g.mul(&[by, x])]))
            }
            _ => None,
        }
    };
    let small_ones = denominators.iter().filter(small);
    let mut found: Vec<Expr> = small_ones.filter_map(of_denominator).collect();
    for fixed in cx.system.fixed_functions().iter().filter(small) {
        let Squares { squares, sum, rest } = Squares::of(cx, *fixed);
        if let ([x, y], true) = (&squares[..], is_free(cx, rest)) {
            let of = |angle: Expr| [angle, g.mul(&[sum, angle])];
            let both = angle(g, *x, *y).into_iter().flat_map(of);
            let new: Vec<Expr> = both.filter(|e| !found.contains(e)).collect();
            found.extend(new);
        }
    }
    found
}

/// A sum of squares `Σ a (x - x₀)²` of coordinates, and the rest of a function.
struct Squares {
    /// a and x - x₀.
    squares: Vec<(Expr, Expr)>,
    sum: Expr,
    rest: Expr,
}

impl Squares {
    fn of(cx: &Context<'_>, e: Expr) -> Squares {
        let g = &cx.system.graph;
        let coordinates = cx.system.coordinates.iter();
        let occurring = coordinates.filter(|c| g.contains_any(e, &[c.q_symbol]));
        let square = |c: &Coordinate| {
            let slope = g.diff(e, c.q_symbol);
            let twice = readable(g, g.diff(slope, c.q_symbol));
            let start = g.substitute(slope, &[(c.q, g.zero())]);
            let is_square = !g.is_zero(twice) && is_free(cx, twice) && is_free(cx, start);
            let of = || {
                (
                    g.div(twice, g.integer(2)),
                    g.add(&[c.q, g.div(start, twice)]),
                )
            };
            is_square.then(of)
        };
        let squares: Vec<(Expr, Expr)> = occurring.filter_map(square).collect();
        let parts = squares.iter().map(|&(a, u)| g.mul(&[a, g.powi(u, 2)]));
        let sum = g.add(&parts.collect::<Vec<Expr>>());
        let rest = readable(g, g.sub(e, sum));
        Squares { squares, sum, rest }
    }
}

/// The angle whose derivative has the denominator `a x² + b y²`, from (a, x) and (b, y); none of numbers with different signs.
fn angle(g: &Graph, (a, x): (Expr, Expr), (b, y): (Expr, Expr)) -> Option<Expr> {
    let ratio = g.div(b, a);
    if g.as_number(ratio).is_some_and(|r| *r < Rational::ZERO) {
        return None;
    }
    let by = g.sqrt(ratio);
    Some(g.apply(Function::Atan2, &[g.mul(&[by, y]), x]))
}
