//! Common factors of the terms of sums, taken out before expressions are lowered: `a b x + a c` becomes `a (b x + c)`.
//!
//! Greedy, the scheme of Horner for several variables (Ceberio and Kreinovich 2004): the base that most terms have as a
//! factor is taken out with the least of its exponents, then the same is done within the bracket and with the terms left.
//! Values change by rounding alone.

use chetaev_symbolic::substitute::SolveCache;
use chetaev_symbolic::{rational, Expr, Graph, Node, Rational, Symbol};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BinaryHeap;

/// A term: its coefficient, and its factors as bases with exponents.
#[derive(Clone, Debug)]
struct Term {
    coefficient: Rational,
    factors: Vec<(Expr, Rational)>,
    /// What it was before anything was taken out: this expression with a number before it.
    whole: Option<(Expr, Rational)>,
}

/// A base, and whether its exponents are positive.
type Kind = (Expr, bool);

impl Term {
    /// `scale · e`
    fn of(graph: &Graph, e: Expr, scale: &Rational) -> Term {
        let whole = Some((e, scale.clone()));
        let (coefficient, factors) = match graph.node(e) {
            Node::Product {
                coefficient,
                factors,
            } => (rational::product(coefficient, scale), factors.to_vec()),
            _ => (scale.clone(), vec![e]),
        };
        let factors = factors.into_iter().map(|f| base_and_exponent(graph, f));
        Term {
            coefficient,
            factors: factors.collect(),
            whole,
        }
    }

    fn kinds(&self) -> impl Iterator<Item = Kind> + '_ {
        let kind = |(base, exponent): &(Expr, Rational)| (*base, !rational::is_negative(exponent));
        self.factors.iter().map(kind)
    }

    fn exponent(&self, base: Expr) -> Option<&Rational> {
        let found = self.factors.iter().find(|factor| factor.0 == base);
        found.map(|factor| &factor.1)
    }

    fn divide(&mut self, base: Expr, exponent: &Rational) {
        for own in self.factors.iter_mut().filter(|own| own.0 == base) {
            own.1 = &own.1 - exponent;
        }
        self.factors.retain(|own| !own.1.is_zero());
        self.whole = None;
    }

    fn expression(&self, graph: &Graph) -> Expr {
        if let Some((e, scale)) = &self.whole {
            return graph.scale(scale, *e);
        }
        let power =
            |(base, exponent): &(Expr, Rational)| graph.pow(*base, graph.number(exponent.clone()));
        let factors: Vec<Expr> = self.factors.iter().map(power).collect();
        graph.scale(&self.coefficient, graph.mul(&factors))
    }
}

fn base_and_exponent(graph: &Graph, e: Expr) -> (Expr, Rational) {
    if let Node::Power { base, exponent } = graph.node(e) {
        if let Some(number) = graph.as_number(*exponent) {
            return (*base, number.clone());
        }
    }
    (e, rational::integer(1))
}

/// Graphs with more nodes are left as they are: there it takes longer to look for factors than they save.
const LARGEST: usize = 20_000;

/// The expressions with the common factors of all sums below them taken out, where that costs no operation.
pub(crate) fn factored(
    graph: &Graph,
    roots: &[Expr],
    is_variable: &dyn Fn(Symbol) -> bool,
) -> Vec<Expr> {
    let nodes = graph.reachable(roots);
    if nodes.len() > LARGEST {
        return roots.to_vec();
    }
    let mut image: FxHashMap<Expr, Expr> = FxHashMap::default();
    let mut solved = SolveCache::default();
    let mut moving: FxHashSet<Expr> = FxHashSet::default();
    for e in nodes {
        let mut own = graph.as_symbol(e).is_some_and(is_variable);
        (graph.node(e)).for_each_child(|child| own |= moving.contains(&child));
        let mut child = |c: Expr| image.get(&c).copied().unwrap_or(c);
        let rebuilt = graph.rebuild(e, &mut child, &mut solved);
        let found = match graph.node(rebuilt) {
            Node::Sum { constant, terms } => {
                let moves = |e: Expr| moving.contains(&e);
                sum(graph, constant, terms, &moves).unwrap_or(rebuilt)
            }
            _ => rebuilt,
        };
        if own {
            moving.extend([e, found]);
        }
        if found != e {
            image.insert(e, found);
        }
    }
    let of = |e: &Expr| image.get(e).copied().unwrap_or(*e);
    roots.iter().map(of).collect()
}

/// The sum with its common factors taken out; `None` where there are none.
fn sum(
    graph: &Graph,
    constant: &Rational,
    terms: &[(Expr, Rational)],
    moves: &dyn Fn(Expr) -> bool,
) -> Option<Expr> {
    let of = |(e, scale): &(Expr, Rational)| Term::of(graph, *e, scale);
    let (mut parts, rest) = brackets(graph, terms.iter().map(of).collect(), moves);
    if parts.is_empty() {
        return None;
    }
    parts.extend(rest.iter().map(|term| term.expression(graph)));
    parts.push(graph.number(constant.clone()));
    Some(graph.add(&parts))
}

fn nested(graph: &Graph, terms: Vec<Term>, moves: &dyn Fn(Expr) -> bool) -> Expr {
    let (mut parts, rest) = brackets(graph, terms, moves);
    parts.extend(rest.iter().map(|term| term.expression(graph)));
    graph.add(&parts)
}

/// What is taken out of a sum, and the terms that are left.
fn brackets(
    graph: &Graph,
    mut terms: Vec<Term>,
    moves: &dyn Fn(Expr) -> bool,
) -> (Vec<Expr>, Vec<Term>) {
    let mut counts = Counts::of(&terms);
    let mut parts = Vec::new();
    while let Some(kind) = counts.most_frequent() {
        let has = |term: &Term| term.kinds().any(|own| own == kind);
        if saved(&terms, kind, moves) < 0 {
            continue;
        }
        let (inner, rest) = terms.into_iter().partition(has);
        terms = rest;
        counts.forget(&inner);
        parts.push(bracket(graph, kind.0, inner, moves));
    }
    (parts, terms)
}

/// How many operations are saved where a factor is taken out.
fn saved(terms: &[Term], kind: Kind, moves: &dyn Fn(Expr) -> bool) -> isize {
    let has = |term: &&Term| term.kinds().any(|own| own == kind);
    let (own, rest): (Vec<&Term>, Vec<&Term>) = terms.iter().partition(has);
    let shapes = |terms: &[&Term], without: Option<Expr>| -> Vec<Shape> {
        let shapes = terms.iter().map(|term| Shape::of(term, without, moves));
        shapes.collect()
    };
    let (whole, inner) = (shapes(&own, None), shapes(&own, Some(kind.0)));
    let starts = |shapes: &[Shape]| shapes.iter().any(Shape::starts);
    let started = starts(&whole) && !starts(&shapes(&rest, None));
    let before = Shape::costs(&whole) - isize::from(started);
    let has_constant = inner.iter().any(|shape| shape.changing == 0);
    let after = Shape::costs(&inner) + isize::from(has_constant) - isize::from(starts(&inner)) + 1;
    before - after
}

/// How many factors of a term change, and whether it has others.
struct Shape {
    changing: isize,
    has_constant: bool,
}

impl Shape {
    fn of(term: &Term, without: Option<Expr>, moves: &dyn Fn(Expr) -> bool) -> Shape {
        let factors = term.factors.iter().filter(|own| Some(own.0) != without);
        let (changing, constant): (Vec<_>, Vec<_>) = factors.partition(|own| moves(own.0));
        Shape {
            changing: changing.len() as isize,
            has_constant: !constant.is_empty() || !rational::abs(&term.coefficient).is_one(),
        }
    }

    /// Whether a sum may start with the term without an operation.
    fn starts(&self) -> bool {
        self.changing == 0 || self.changing == 1 && !self.has_constant
    }

    /// The products of all terms, the last of each fused with a sum, and a sum for each that is none; constants cost nothing.
    fn costs(shapes: &[Shape]) -> isize {
        let changing = shapes.iter().filter(|shape| shape.changing > 0);
        let cost = |own: &Shape| (own.changing + isize::from(own.has_constant) - 1).max(1);
        changing.map(cost).sum()
    }
}

/// Terms that all have powers of a base, of one sign, with the least power before a bracket.
fn bracket(graph: &Graph, base: Expr, mut terms: Vec<Term>, moves: &dyn Fn(Expr) -> bool) -> Expr {
    let exponents = terms.iter().filter_map(|term| term.exponent(base));
    let Some(least) = exponents.min_by_key(|x| rational::abs(x)).cloned() else {
        return graph.zero();
    };
    for term in &mut terms {
        term.divide(base, &least);
    }
    let power = graph.pow(base, graph.number(least));
    graph.mul(&[power, nested(graph, terms, moves)])
}

/// In how many terms each kind of factor occurs.
struct Counts {
    now: FxHashMap<Kind, usize>,
    /// With counts as they once were.
    heap: BinaryHeap<(usize, Kind)>,
}

impl Counts {
    fn of(terms: &[Term]) -> Counts {
        let mut now: FxHashMap<Kind, usize> = FxHashMap::default();
        for kind in terms.iter().flat_map(Term::kinds) {
            *now.entry(kind).or_default() += 1;
        }
        let several = now.iter().filter(|(_, &count)| count > 1);
        let heap = several.map(|(&kind, &count)| (count, kind)).collect();
        Counts { now, heap }
    }

    fn forget(&mut self, terms: &[Term]) {
        for kind in terms.iter().flat_map(Term::kinds) {
            if let Some(count) = self.now.get_mut(&kind) {
                *count = count.saturating_sub(1);
            }
        }
    }

    /// The kind that most terms have, two at least; among equals the one whose base was made last.
    fn most_frequent(&mut self) -> Option<Kind> {
        while let Some((count, kind)) = self.heap.pop() {
            let now = self.now.get(&kind).copied().unwrap_or(0);
            if now == count {
                return Some(kind);
            }
            if now > 1 {
                self.heap.push((now, kind));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_factors_are_taken_out() {
        let g = Graph::new();
        let [a, b, c, x] = ["a", "b", "c", "x"].map(|name| g.symbol(name, 0));
        let root = g.pow(x, g.number(rational::ratio(-1, 2).unwrap()));
        // a b x^(-1/2) + 2 a c x^(-3/2) + b
        let terms = [
            g.mul(&[a, b, root]),
            g.mul(&[g.integer(2), a, c, root, g.powi(x, -1)]),
            b,
        ];
        let found = factored(&g, &[g.add(&terms)], &|_| true)[0];
        let bracket = g.add(&[b, g.mul(&[g.integer(2), c, g.powi(x, -1)])]);
        assert_eq!(found, g.add(&[g.mul(&[a, root, bracket]), b]));
        // One fused operation as it stands, two with a bracket.
        let plain = g.add(&[g.mul(&[x, a]), a]);
        assert_eq!(factored(&g, &[plain], &|_| true), [plain]);
    }
}
