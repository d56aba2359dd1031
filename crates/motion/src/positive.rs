//! Quantities that are positive whatever the angles in them.
//!
//! A sum of products of squares of sines and cosines is, in each s = sin² u, a polynomial of degree one; over the cube 0 ≤ s ≤ 1 such
//! a polynomial takes its least and its largest value at corners, where every angle is at a whole number of quarter turns. So the
//! corners, which are functions of the parameters alone, say whether it vanishes anywhere. That angles are taken to be
//! independent of each other makes the bound no less true.

use chetaev_symbolic::{rational, Expr, Function, Graph, Node, Rational, Symbol};

/// Quantities with more angles are not looked at: there are as many corners as their power of two.
const MOST: usize = 4;

/// A term of a sum: what depends on parameters alone, times squares of sines (`true`) and cosines of angles.
struct Term {
    constant: Expr,
    squares: Vec<(Expr, bool)>,
}

/// Values at the corners, as functions of the parameters: where all of them are positive, so is `value` at every state. `None` where
/// it is not of the kind.
pub(crate) fn corners(g: &Graph, value: Expr, moves: &dyn Fn(Symbol) -> bool) -> Option<Vec<Expr>> {
    let mut terms = Vec::new();
    let mut may_leave_out = true;
    for (part, coefficient) in parts(g, value) {
        match term(g, part, &coefficient, moves) {
            Some(own) => {
                may_leave_out &= is_square(g, part, &coefficient);
                terms.push(own);
            }
            // A square that is left out makes the rest no larger.
            None if is_square(g, part, &coefficient) => {}
            None => return None,
        }
    }
    let angles = angles(&terms);
    // The squares of one angle are enough where all else is squares too.
    let alone = angles.iter().find_map(|&angle| {
        let own = terms.iter().filter(|term| {
            !term.squares.is_empty() && term.squares.iter().all(|&(other, _)| other == angle)
        });
        let found = at_corners(g, &own.collect::<Vec<_>>(), &[angle]);
        found.iter().all(|&e| !g.is_zero(e)).then_some(found)
    });
    match alone.filter(|_| may_leave_out) {
        Some(found) => Some(found),
        None if angles.len() <= MOST => {
            let all: Vec<&Term> = terms.iter().collect();
            Some(at_corners(g, &all, &angles))
        }
        None => None,
    }
}

/// The angles, each once.
fn angles(terms: &[Term]) -> Vec<Expr> {
    let mut found = Vec::new();
    for &(angle, _) in terms.iter().flat_map(|term| &term.squares) {
        if !found.contains(&angle) {
            found.push(angle);
        }
    }
    found
}

/// The sum of the terms where each angle is at a quarter turn or at none.
fn at_corners(g: &Graph, terms: &[&Term], angles: &[Expr]) -> Vec<Expr> {
    let corner = |corner: usize| {
        let is_there = |&(angle, is_sine): &(Expr, bool)| {
            let place = angles.iter().position(|&own| own == angle);
            place.is_some_and(|place| (corner >> place & 1 == 1) == is_sine)
        };
        let here = terms
            .iter()
            .filter(|term| term.squares.iter().all(is_there));
        g.add(&here.map(|term| term.constant).collect::<Vec<_>>())
    };
    (0..1 << angles.len()).map(corner).collect()
}

/// The terms of a sum with their coefficients.
fn parts(g: &Graph, value: Expr) -> Vec<(Expr, Rational)> {
    let one = rational::integer(1);
    match g.node(value) {
        Node::Sum { constant, terms } => {
            let constant = (!constant.is_zero()).then(|| (g.number(constant.clone()), one));
            terms.iter().cloned().chain(constant).collect()
        }
        _ => vec![(value, one)],
    }
}

/// The factors of a product as bases with exponents, and its coefficient.
fn factors(g: &Graph, part: Expr) -> (Rational, Vec<(Expr, Rational)>) {
    let (coefficient, factors) = match g.node(part) {
        Node::Product {
            coefficient,
            factors,
        } => (coefficient.clone(), factors.to_vec()),
        Node::Number(number) => (number.clone(), Vec::new()),
        _ => (rational::integer(1), vec![part]),
    };
    let power = |factor: Expr| match g.node(factor) {
        Node::Power { base, exponent } => match g.as_number(*exponent) {
            Some(number) => (*base, number.clone()),
            None => (factor, rational::integer(1)),
        },
        _ => (factor, rational::integer(1)),
    };
    (coefficient, factors.into_iter().map(power).collect())
}

fn term(
    g: &Graph,
    part: Expr,
    coefficient: &Rational,
    moves: &dyn Fn(Symbol) -> bool,
) -> Option<Term> {
    let (own, factors) = factors(g, part);
    let mut constants = vec![g.number(own * coefficient)];
    let mut squares: Vec<(Expr, bool)> = Vec::new();
    for (base, exponent) in factors {
        if g.is_free_of(base, moves) {
            constants.push(g.pow(base, g.number(exponent)));
            continue;
        }
        let (angle, is_sine) = match g.node(base) {
            Node::Apply {
                function: Function::Sin,
                arguments,
            } => (arguments[0], true),
            Node::Apply {
                function: Function::Cos,
                arguments,
            } => (arguments[0], false),
            _ => return None,
        };
        // The product of both squares of an angle would be of degree two.
        let is_new = squares.iter().all(|&(other, _)| other != angle);
        if exponent != rational::integer(2) || !is_new {
            return None;
        }
        squares.push((angle, is_sine));
    }
    let constant = g.mul(&constants);
    Some(Term { constant, squares })
}

/// Whether a term is a product of even powers that is nowhere negative.
fn is_square(g: &Graph, part: Expr, coefficient: &Rational) -> bool {
    let (own, factors) = factors(g, part);
    let is_even = |exponent: &Rational| (exponent / rational::integer(2)).is_int();
    !rational::is_negative(&(own * coefficient))
        && factors.iter().all(|(_, exponent)| is_even(exponent))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a quantity in the angles u, v and the coordinate x with the parameters a, b, c, with numbers for these.
    fn found(of: impl Fn(&Graph, [Expr; 6]) -> Expr) -> Option<Vec<f64>> {
        let g = Graph::new();
        let symbols = ["u", "v", "x", "a", "b", "c"].map(|name| g.intern_symbol(name, 0));
        let value = of(&g, symbols.map(|s| g.symbol_expr(s)));
        let corners = corners(&g, value, &|s| symbols[..3].contains(&s))?;
        let numbers = |s: Symbol| {
            let place = symbols.iter().position(|&own| own == s)?;
            [2.0, 3.0, 5.0].get(place.checked_sub(3)?).copied()
        };
        let mut values = g.evaluate_f64(&corners, &numbers).unwrap();
        values.sort_by(f64::total_cmp);
        Some(values)
    }

    fn square(g: &Graph, factors: &[Expr]) -> Expr {
        g.powi(g.mul(factors), 2)
    }

    /// The support function of an ellipsoid, squared, is least along its shortest axis.
    #[test]
    fn the_height_of_an_ellipsoid() {
        let values = found(|g, [u, v, _, a, b, c]| {
            g.add(&[
                square(g, &[a, g.cos(u), g.sin(v)]),
                square(g, &[b, g.sin(u)]),
                square(g, &[c, g.cos(u), g.cos(v)]),
            ])
        });
        assert_eq!(values, Some(vec![4.0, 9.0, 9.0, 25.0]));
    }

    /// The gradient of the constraint of a blade, whatever else is in it.
    #[test]
    fn the_squares_of_one_angle_are_enough() {
        let values = found(|g, [u, v, x, a, b, _]| {
            let other = g.add(&[g.mul(&[a, g.sin(v)]), g.mul(&[b, x])]);
            let squares = [
                g.powi(other, 2),
                square(g, &[a, g.sin(u)]),
                square(g, &[b, g.cos(u)]),
                square(g, &[x, g.cos(v)]),
            ];
            g.add(&squares)
        });
        assert_eq!(values, Some(vec![4.0, 9.0]));
    }

    #[test]
    fn what_may_vanish_has_no_positive_corners() {
        let cosine = |g: &Graph, [u, ..]: [Expr; 6]| g.sub(g.one(), g.powi(g.sin(u), 2));
        assert!(found(cosine).is_none_or(|values| values.contains(&0.0)));
        // Without the fourth power, which is a square, −a sin² u is left.
        let fourth = |g: &Graph, [u, _, _, a, ..]: [Expr; 6]| {
            g.sub(g.powi(g.sin(u), 4), g.mul(&[a, g.powi(g.sin(u), 2)]))
        };
        assert_eq!(found(fourth), Some(vec![-2.0, 0.0]));
        // 1 + a sin² u − b sin² u, negative at a quarter turn for these numbers.
        let difference = |g: &Graph, [u, _, _, a, b, _]: [Expr; 6]| {
            let square = g.powi(g.sin(u), 2);
            g.add(&[g.one(), g.mul(&[a, square]), g.neg(g.mul(&[b, b, square]))])
        };
        assert_eq!(found(difference), Some(vec![-6.0, 1.0]));
    }

    #[test]
    fn others_are_left_alone() {
        let linear = |g: &Graph, [u, _, x, ..]: [Expr; 6]| g.add(&[x, g.powi(g.sin(u), 2)]);
        assert_eq!(found(linear), None);
        let odd = |g: &Graph, [u, ..]: [Expr; 6]| g.add(&[g.integer(3), g.sin(u)]);
        assert_eq!(found(odd), None);
        let fourth = |g: &Graph, [u, _, _, a, ..]: [Expr; 6]| {
            g.sub(g.mul(&[a, g.powi(g.sin(u), 2)]), g.powi(g.sin(u), 4))
        };
        assert_eq!(found(fourth), None);
        // A square that is left out may not be one with the other sign.
        let less = |g: &Graph, [u, _, x, ..]: [Expr; 6]| {
            let squares = g.add(&[g.powi(g.sin(u), 2), g.powi(g.cos(u), 2)]);
            g.sub(squares, g.powi(x, 2))
        };
        assert_eq!(found(less), None);
        // Squares of one angle are not enough where other terms are negative.
        let mixed = |g: &Graph, [u, v, ..]: [Expr; 6]| {
            let terms = [
                g.scale(&rational::integer(3), g.powi(g.sin(u), 2)),
                g.scale(&rational::integer(3), g.powi(g.cos(u), 2)),
                g.scale(&rational::integer(-7), g.powi(g.sin(v), 2)),
            ];
            g.add(&terms)
        };
        assert!(found(mixed).is_none_or(|values| values.contains(&-4.0)));
    }
}
