//! Deliberate slips in an equation.

use chetaev_symbolic::rational::integer;
use chetaev_symbolic::{Expr, Graph, Node, Rational};

/// A slip of the pen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slip {
    /// A term is forgotten.
    Drop,
    /// A term has the wrong sign.
    Flip,
}

/// A term of a sum inside an equation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    sum: Expr,
    pub(super) term: Expr,
}

/// The terms of an equation: those of the sum itself and of sums that are factors of its terms.
pub(super) fn places(g: &Graph, equation: Expr) -> Vec<Place> {
    let mut found = Vec::new();
    let mut open = vec![(equation, 0)];
    while let Some((e, depth)) = open.pop() {
        match g.node(e) {
            Node::Sum { terms, .. } => {
                for (base, coefficient) in terms {
                    let term = g.scale(coefficient, *base);
                    found.push(Place { sum: e, term });
                    if depth < 2 {
                        open.push((*base, depth + 1));
                    }
                }
            }
            Node::Product { factors, .. } => open.extend(factors.iter().map(|&f| (f, depth))),
            _ => {}
        }
    }
    found
}

/// The terms of every sum in the expressions, entries of matrices and arguments of functions included.
pub(super) fn all_places(g: &Graph, es: &[Expr]) -> Vec<Place> {
    let mut found = Vec::new();
    for e in g.reachable(es) {
        if let Node::Sum { terms, .. } = g.node(e) {
            found.extend(terms.iter().map(|(base, coefficient)| Place {
                sum: e,
                term: g.scale(coefficient, *base),
            }));
        }
    }
    found
}

/// The expressions with the slip, made wherever the sum occurs in them.
pub(super) fn slipped(g: &Graph, es: &[Expr], place: Place, slip: Slip) -> Vec<Expr> {
    let times: Rational = match slip {
        Slip::Drop => integer(1),
        Slip::Flip => integer(2),
    };
    let wrong = g.sub(place.sum, g.scale(&times, place.term));
    g.substitute_all(es, &[(place.sum, wrong)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_dropped_and_flipped() {
        let g = Graph::new();
        let [x, y, z] = ["x", "y", "z"].map(|name| g.symbol(name, 0));
        let e = g.add(&[x, g.mul(&[y, g.add(&[x, z])])]);
        let found = places(&g, e);
        assert_eq!(found.len(), 4);
        let inner = found.iter().find(|p| p.term == z).unwrap();
        let expected = g.add(&[x, g.mul(&[y, x])]);
        assert_eq!(slipped(&g, &[e], *inner, Slip::Drop), [expected]);
        let expected = g.add(&[x, g.mul(&[y, g.sub(x, z)])]);
        assert_eq!(slipped(&g, &[e], *inner, Slip::Flip), [expected]);
    }
}
