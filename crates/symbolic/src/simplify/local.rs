//! Rules for single sums, for what is too large to be read as polynomials: entries of linear systems that are stated.
//!
//! Two terms with the same cofactor meet in an addition theorem, and terms that differ in one symbol only are grouped:
//! `M_1 d sin(a)^2 + M_1 d cos(a)^2 + M_2 d` becomes `(M_1 + M_2) d`. Each rule costs time in proportion to the sum.

use rustc_hash::{FxHashMap, FxHashSet};

use super::measure::Lengths;
use super::{simplify, Options};
use crate::substitute::SolveCache;
use crate::{Expr, Function, Graph, Node, Rational};

/// The same expressions with shorter matrices and right sides of their linear systems.
pub(super) fn shorten_systems(g: &Graph, es: &[Expr], options: &Options) -> Vec<Expr> {
    let nodes = g.reachable(es);
    let mut stated = Vec::new();
    let mut right_sides = Vec::new();
    for &e in &nodes {
        if let Node::Solve { matrix, rhs } = g.node(e) {
            stated.push(*matrix);
            stated.extend(rhs.iter().copied());
            right_sides.extend(rhs.iter().copied());
        }
    }
    if stated.is_empty() {
        return es.to_vec();
    }
    let inside: FxHashSet<Expr> = g.reachable(&stated).into_iter().collect();
    let mut image: FxHashMap<Expr, Expr> = FxHashMap::default();
    let mut lengths = Lengths::written();
    if g.reachable(&right_sides).len() <= options.max_nodes / 4 {
        for e in right_sides {
            let short = right_side(g, e, options);
            if short != e && lengths.of(g, short) < lengths.of(g, e) {
                image.insert(e, short);
            }
        }
    }
    rebuilt(g, es, &nodes, image, |e| inside.contains(&e))
}

/// The same expressions with each sum shortened by itself: two terms with the same cofactor meet in an addition theorem,
/// `d sin(a)^2 + d cos(a)^2` becomes `d`. Takes time in proportion to the graph.
pub(super) fn shorten(g: &Graph, es: &[Expr]) -> Vec<Expr> {
    rebuilt(g, es, &g.reachable(es), FxHashMap::default(), |_| true)
}

fn rebuilt(
    g: &Graph,
    es: &[Expr],
    nodes: &[Expr],
    mut image: FxHashMap<Expr, Expr>,
    may_change: impl Fn(Expr) -> bool,
) -> Vec<Expr> {
    let mut solved = SolveCache::default();
    let mut lengths = Lengths::written();
    for &e in nodes {
        if image.contains_key(&e) {
            continue;
        }
        let mut new = g.rebuild(e, &mut |c| image.get(&c).copied().unwrap_or(c), &mut solved);
        if may_change(e) && matches!(g.node(new), Node::Sum { .. }) {
            let short = shorter_sum(g, new);
            if short != new && lengths.of(g, short) < lengths.of(g, new) {
                new = short;
            }
        }
        if new != e {
            image.insert(e, new);
        }
    }
    es.iter()
        .map(|e| image.get(e).copied().unwrap_or(*e))
        .collect()
}

/// A right side of a stated system is read like an equation of its own, unless it contains systems itself. Where they are
/// too large together nobody reads them term by term.
fn right_side(g: &Graph, e: Expr, options: &Options) -> Expr {
    let is_plain = |&e: &Expr| !matches!(g.node(e), Node::Solve { .. });
    if g.reachable(&[e]).iter().all(is_plain) {
        simplify(g, e, options)
    } else {
        e
    }
}

/// A term of a sum: coefficient and factors.
type Term = (Rational, Vec<Expr>);

fn terms_of(g: &Graph, e: Expr) -> Option<(Rational, Vec<Term>)> {
    let Node::Sum { constant, terms } = g.node(e) else {
        return None;
    };
    let split = |(term, coefficient): &(Expr, Rational)| match g.node(*term) {
        Node::Product { factors, .. } => (coefficient.clone(), factors.to_vec()),
        _ => (coefficient.clone(), vec![*term]),
    };
    Some((constant.clone(), terms.iter().map(split).collect()))
}

fn expression(g: &Graph, (coefficient, factors): &Term) -> Expr {
    let mut all = factors.clone();
    all.push(g.number(coefficient.clone()));
    g.mul(&all)
}

fn shorter_sum(g: &Graph, e: Expr) -> Expr {
    let contracted = contract(g, e);
    group(g, contracted)
}

/// The two circular functions in a term.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Kind {
    /// Both sines, or both cosines.
    Even,
    /// A sine and a cosine.
    Odd,
}

/// A term as `coefficient · cofactor · f(a) h(b)`, f and h sines or cosines, a before b in canonical order.
struct Circular {
    kind: Kind,
    first_is_sine: bool,
    a: Expr,
    b: Expr,
    cofactor: Vec<Expr>,
}

fn circular(g: &Graph, e: Expr) -> Option<(bool, Expr)> {
    match g.node(e) {
        Node::Apply {
            function: function @ (Function::Sin | Function::Cos),
            arguments,
        } => Some((*function == Function::Sin, arguments[0])),
        _ => None,
    }
}

fn circular_pair(g: &Graph, factors: &[Expr]) -> Option<Circular> {
    let mut found: Vec<(bool, Expr)> = Vec::new();
    let mut cofactor = Vec::new();
    for &factor in factors {
        let times = match g.node(factor) {
            Node::Power { base, exponent } if g.as_integer(*exponent) == Some(2) => {
                circular(g, *base).map(|c| (c, 2))
            }
            _ => circular(g, factor).map(|c| (c, 1)),
        };
        match times {
            Some((c, count)) => found.extend(std::iter::repeat_n(c, count)),
            None => cofactor.push(factor),
        }
    }
    let [mut first, mut second] = found[..] else {
        return None;
    };
    if g.compare(first.1, second.1).is_gt() {
        std::mem::swap(&mut first, &mut second);
    }
    Some(Circular {
        kind: if first.0 == second.0 {
            Kind::Even
        } else {
            Kind::Odd
        },
        first_is_sine: first.0,
        a: first.1,
        b: second.1,
        cofactor,
    })
}

/// What two terms of an addition theorem share: the cofactor, both angles, and the kind.
type Meeting = (Vec<Expr>, Expr, Expr, Kind);

/// Addition theorems between two terms with the same cofactor.
fn contract(g: &Graph, e: Expr) -> Expr {
    let Some((constant, terms)) = terms_of(g, e) else {
        return e;
    };
    let mut waiting: FxHashMap<Meeting, (usize, bool)> = FxHashMap::default();
    let mut parts: Vec<Option<Expr>> = terms.iter().map(|t| Some(expression(g, t))).collect();
    let mut changed = false;
    for (i, (coefficient, factors)) in terms.iter().enumerate() {
        let Some(pair) = circular_pair(g, factors) else {
            continue;
        };
        let key = (pair.cofactor.clone(), pair.a, pair.b, pair.kind);
        let Some(&(other, other_is_sine)) = waiting.get(&key) else {
            waiting.insert(key, (i, pair.first_is_sine));
            continue;
        };
        if other_is_sine == pair.first_is_sine {
            continue;
        }
        let (sine, cosine) = if pair.first_is_sine {
            (coefficient, &terms[other].0)
        } else {
            (&terms[other].0, coefficient)
        };
        if let Some(value) = addition(g, &pair, sine, cosine) {
            waiting.remove(&key);
            let mut product = pair.cofactor;
            product.push(value);
            parts[i] = Some(g.mul(&product));
            parts[other] = None;
            changed = true;
        }
    }
    if !changed {
        return e;
    }
    let mut sum: Vec<Expr> = parts.into_iter().flatten().collect();
    sum.push(g.number(constant));
    g.add(&sum)
}

/// `p f(a) h(b) + q …`, where p belongs to the term with `sin(a)` and q to that with `cos(a)`; `None` unless p = ±q.
fn addition(g: &Graph, pair: &Circular, p: &Rational, q: &Rational) -> Option<Expr> {
    let (same, opposite) = (p == q, *p == -q.clone());
    let (sum, difference) = (g.add(&[pair.a, pair.b]), g.sub(pair.a, pair.b));
    let value = match (pair.kind, same, opposite) {
        (Kind::Even, true, _) => g.cos(difference),
        (Kind::Even, _, true) => g.cos(sum),
        (Kind::Odd, true, _) => g.sin(sum),
        (Kind::Odd, _, true) => g.sin(difference),
        _ => return None,
    };
    // cos a cos b - sin a sin b has the sign of its cosines, sin a cos b - cos a sin b that of its sine of a.
    let sign = if pair.kind == Kind::Even { q } else { p };
    Some(g.scale(sign, value))
}

/// The common factors of terms, with the number of each term and the symbol in which it differs.
type Group = (Vec<Expr>, Vec<(usize, Expr)>);

/// Terms that differ in one symbol only, put together: the largest groups first.
fn group(g: &Graph, e: Expr) -> Expr {
    let Some((constant, terms)) = terms_of(g, e) else {
        return e;
    };
    let mut groups: FxHashMap<Vec<Expr>, Vec<(usize, Expr)>> = FxHashMap::default();
    for (i, (_, factors)) in terms.iter().enumerate() {
        for (place, &factor) in factors.iter().enumerate() {
            if factors.len() > 1 && g.as_symbol(factor).is_some() {
                let mut rest = factors.clone();
                rest.remove(place);
                groups.entry(rest).or_default().push((i, factor));
            }
        }
    }
    let mut groups: Vec<Group> = groups
        .into_iter()
        .filter(|(_, members)| members.len() > 1)
        .collect();
    // By size, then by structure: the choice must not depend on how the graph came about.
    let digests = |es: &[Expr]| es.iter().map(|&e| g.digest(e)).collect::<Vec<u128>>();
    groups.sort_by_cached_key(|(rest, members)| (usize::MAX - members.len(), digests(rest)));
    let mut open: Vec<bool> = vec![true; terms.len()];
    let mut sum = vec![g.number(constant)];
    for (rest, members) in groups {
        let members: Vec<(usize, Expr)> = members.into_iter().filter(|m| open[m.0]).collect();
        if members.len() < 2 {
            continue;
        }
        let inner: Vec<Expr> = members
            .iter()
            .map(|&(i, factor)| g.scale(&terms[i].0, factor))
            .collect();
        members.iter().for_each(|m| open[m.0] = false);
        let mut product = rest;
        product.push(g.add(&inner));
        sum.push(g.mul(&product));
    }
    sum.extend(
        terms
            .iter()
            .zip(&open)
            .filter(|(_, &open)| open)
            .map(|(term, _)| expression(g, term)),
    );
    g.add(&sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x and y are written through the rule and must keep their values.
    #[test]
    fn sums_are_shortened_and_keep_their_values() {
        let g = Graph::new();
        let [m, n, d, a, b] = ["m", "n", "d", "a", "b"].map(|s| g.symbol(s, 0));
        let (sa, ca, sb, cb) = (g.sin(a), g.cos(a), g.sin(b), g.cos(b));
        let product = |fs: &[Expr]| g.mul(fs);
        let sums = [
            (
                vec![product(&[m, sa, sb]), product(&[m, ca, cb])],
                g.mul(&[m, g.cos(g.sub(a, b))]),
            ),
            (
                vec![product(&[m, ca, cb]), g.neg(product(&[m, sa, sb]))],
                g.mul(&[m, g.cos(g.add(&[a, b]))]),
            ),
            (
                vec![product(&[d, sa, cb]), product(&[d, ca, sb])],
                g.mul(&[d, g.sin(g.add(&[a, b]))]),
            ),
            (
                vec![product(&[d, ca, sb]), g.neg(product(&[d, sa, cb]))],
                g.mul(&[d, g.sin(g.sub(b, a))]),
            ),
            (vec![product(&[d, sa, sa]), product(&[d, ca, ca])], d),
            (
                vec![product(&[m, d, sa]), product(&[n, d, sa]), product(&[m, n])],
                g.add(&[g.mul(&[g.add(&[m, n]), d, sa]), g.mul(&[m, n])]),
            ),
        ];
        for (terms, expected) in sums {
            assert_eq!(shorter_sum(&g, g.add(&terms)), expected);
        }
        let kept = g.add(&[product(&[m, sa, sb]), g.mul(&[g.integer(2), m, ca, cb])]);
        assert_eq!(contract(&g, kept), kept);
    }

    #[test]
    fn the_entries_of_a_system_are_shortened() {
        let g = Graph::new();
        let [a, d, u, v, p, q] = ["a", "d", "u", "v", "p", "q"].map(|s| g.symbol(s, 0));
        let long = g.add(&[
            g.mul(&[d, g.powi(g.sin(a), 2)]),
            g.mul(&[d, g.powi(g.cos(a), 2)]),
        ]);
        let x = g.solve(&[long, u, v, p], &[q, a]).unwrap();
        let short = g.solve(&[d, u, v, p], &[q, a]).unwrap();
        assert_eq!(shorten_systems(&g, &x, &Options::default()), short);
    }
}
