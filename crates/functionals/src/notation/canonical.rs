//! Equal products are written the same way: names of summed letters, order of indices of symmetric tensors, order of factors.

use super::terms::{letters, readable, renamed, Term};
use super::{print::spelled, Atom, Index, Kind, Node};
use crate::tensors::{Scope, Shape};
use chetaev_symbolic::print::Format;
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::{rational, Rational};

/// Most letters that are summed over in one product: all their orders are tried.
const MOST_LETTERS: usize = 6;

/// The sum of products, equal ones together; `None` where a product has too many letters.
pub(super) fn collected(terms: Vec<Term>, free: &[char], scope: &Scope) -> Option<Vec<Term>> {
    let mut found: Vec<(String, Term)> = Vec::new();
    for term in terms {
        let (key, term) = canonical(term, free, scope)?;
        match found.iter_mut().find(|(own, _)| *own == key) {
            Some((_, own)) => own.number = rational::sum(&own.number, &term.number),
            None => found.push((key, term)),
        }
    }
    let kept = found.into_iter().map(|(_, term)| term);
    Some(kept.filter(|t| t.number != Rational::ZERO).collect())
}

fn canonical(term: Term, free: &[char], scope: &Scope) -> Option<(String, Term)> {
    let term = contracted(term, free);
    let mut dummies: Vec<char> = Vec::new();
    for factor in &term.factors {
        let mut own = Vec::new();
        letters(factor, &mut own);
        for letter in own {
            if !free.contains(&letter) && !dummies.contains(&letter) {
                dummies.push(letter);
            }
        }
    }
    if dummies.len() > MOST_LETTERS {
        return None;
    }
    let names = unused(free, scope);
    let mut best: Option<(String, Term)> = None;
    for order in orders(dummies.len()) {
        let pairs: Vec<(char, char)> = dummies
            .iter()
            .zip(order)
            .filter_map(|(&letter, at)| Some((letter, *names.get(at)?)))
            .collect();
        let mut factors: Vec<(u8, String, Node)> = term
            .factors
            .iter()
            .map(|factor| {
                let node = sorted(&renamed(factor, &pairs), scope);
                (
                    rank_of(&node, scope),
                    spelled(&node, scope, Format::Text),
                    node,
                )
            })
            .collect();
        factors.sort_by(|a, b| (a.0, &a.1).cmp(&(b.0, &b.1)));
        let key: Vec<String> = factors.iter().map(|(_, text, _)| text.clone()).collect();
        let key = key.join(" ");
        if best.as_ref().is_none_or(|(own, _)| key < *own) {
            let factors = factors.into_iter().map(|(_, _, node)| node).collect();
            let number = term.number.clone();
            best = Some((key, Term { number, factors }));
        }
    }
    best
}

/// Unit tensors with a summed letter are carried out.
fn contracted(mut term: Term, free: &[char]) -> Term {
    loop {
        let found = term.factors.iter().enumerate().find_map(|(at, factor)| {
            let Kind::Atom(atom) = &factor.kind else {
                return None;
            };
            let ("delta", [Index::Letter(a), Index::Letter(b)]) =
                (atom.name.as_str(), &atom.indices[..])
            else {
                return None;
            };
            let (from, to) = match (free.contains(a), free.contains(b)) {
                (_, false) if a != b => (*b, *a),
                (false, _) if a != b => (*a, *b),
                _ => return None,
            };
            Some((at, from, to))
        });
        let Some((at, from, to)) = found else {
            return term;
        };
        term.factors.remove(at);
        for factor in &mut term.factors {
            *factor = renamed(factor, &[(from, to)]);
        }
    }
}

/// Parameters first, then data and the normal, then fields.
fn rank_of(node: &Node, scope: &Scope) -> u8 {
    match &node.kind {
        Kind::Atom(atom) if atom.name == "n" => 1,
        Kind::Atom(atom) => match scope.tensors.get(&atom.name) {
            _ if atom.argument.is_some() => 3,
            Some(tensor) if scope.space.jets_in(&tensor.components).is_empty() => 0,
            _ if atom.derivatives.is_empty() => 2,
            _ => 4,
        },
        Kind::Sum(_) => 0,
        Kind::Power(base, _) => rank_of(base, scope),
        _ => 3,
    }
}

/// Indices of symmetric tensors, and of derivatives, in order.
fn sorted(node: &Node, scope: &Scope) -> Node {
    let Kind::Atom(atom) = &node.kind else {
        return node.clone();
    };
    let mut own = atom.clone();
    own.derivatives.sort_unstable();
    let pairs = match scope.shapes.get(&own.name) {
        Some(Shape::Symmetric) => 1,
        Some(Shape::Elastic | Shape::Minor) => 2,
        _ if own.name == "delta" || scope.is_symmetric(&own.name) => 1,
        _ if own.argument.is_some() && own.indices.len() == 2 * own.primes as usize => own.primes,
        _ => 0,
    };
    for pair in own.indices.chunks_mut(2).take(pairs as usize) {
        pair.sort_unstable();
    }
    let is_elastic = scope.shapes.get(&own.name) == Some(&Shape::Elastic);
    if is_elastic && own.indices.len() == 4 && own.indices[2..] < own.indices[..2] {
        own.indices.rotate_left(2);
    }
    Node {
        kind: Kind::Atom(Atom { ..own }),
        span: node.span,
    }
}

/// Letters that are no coordinates and not used.
fn unused(free: &[char], scope: &Scope) -> Vec<char> {
    let all = readable(scope);
    all.filter(|letter| !free.contains(letter)).collect()
}

/// All orders of 0, …, n − 1.
fn orders(n: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..n {
        all = all
            .into_iter()
            .flat_map(|order: Vec<usize>| {
                let next: Vec<usize> = (0..n).filter(|i| !order.contains(i)).collect();
                next.into_iter().map(move |i| {
                    let mut longer = order.clone();
                    longer.push(i);
                    longer
                })
            })
            .collect();
    }
    all
}

/// The sum as one expression; `None` where nothing is left.
pub(super) fn sum_of(terms: Vec<Term>) -> Option<Node> {
    let span = Span::new(0, 0);
    let node = |kind: Kind| Node { kind, span };
    let mut parts: Vec<(bool, Node)> = Vec::new();
    let (minus, plus): (Vec<Term>, Vec<Term>) = terms
        .into_iter()
        .partition(|term| rational::is_negative(&term.number));
    for term in plus.into_iter().chain(minus) {
        let is_minus = rational::is_negative(&term.number);
        let number = rational::abs(&term.number);
        let mut factors: Vec<(bool, Node)> =
            term.factors.into_iter().map(|own| (false, own)).collect();
        if factors.is_empty() || number != rational::integer(1) {
            factors.insert(0, (false, node(Kind::Number(number))));
        }
        let own = match <[(bool, Node); 1]>::try_from(factors) {
            Ok([(_, only)]) => only,
            Err(many) => node(Kind::Product(many)),
        };
        parts.push((is_minus, own));
    }
    match <[(bool, Node); 1]>::try_from(parts) {
        Ok([(false, only)]) => Some(only),
        Ok([only]) => Some(node(Kind::Sum(vec![only]))),
        Err(parts) if parts.is_empty() => None,
        Err(parts) => Some(node(Kind::Sum(parts))),
    }
}
