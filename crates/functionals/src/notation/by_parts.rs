//! The coefficient of a variation: derivatives are moved off it by parts, and what is left is written as short as it can be.

use super::canonical::{collected, sum_of};
use super::terms::{letters, renamed, Calculus, Linear, Occurrence, Term};
use super::{Atom, Index, Kind, Node};
use crate::tensors::{Scope, Shape, Tensor};
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::{rational, Expr};
use std::collections::BTreeMap;

/// The coefficient of the variation of a field, in its free letters; the symmetric part, where it is not symmetric itself and the field is.
pub(super) fn coefficient(
    calculus: &Calculus<'_>,
    linear: Linear,
    shape: Shape,
    (free, scope): (&[char], &Scope),
) -> Option<Node> {
    let groups = moved(calculus, linear, free)?;
    let value = sum_of_groups(calculus, groups.clone(), free, scope)?;
    match (shape, free) {
        (Shape::Symmetric, &[i, j]) if !is_symmetric(&value, free, scope) => {
            sum_of_groups(calculus, symmetrized(groups, (i, j))?, free, scope)
        }
        _ => Some(value),
    }
}

/// The same with letters that are made, so that those which a density is written with are none of the free ones.
fn apart(calculus: &Calculus<'_>, term: Term, mut own: Occurrence) -> (Term, Occurrence) {
    let mut all = Vec::new();
    for factor in &term.factors {
        letters(factor, &mut all);
    }
    let of_variation = own.indices.iter().chain(&own.derivatives);
    all.extend(of_variation.filter_map(|index| match index {
        Index::Letter(letter) => Some(*letter),
        Index::Place(_) => None,
    }));
    all.sort_unstable();
    all.dedup();
    let pairs: Vec<(char, char)> = all.into_iter().map(|l| (l, calculus.fresh())).collect();
    for index in own.indices.iter_mut().chain(&mut own.derivatives) {
        let Index::Letter(letter) = index else {
            continue;
        };
        if let Some((_, made)) = pairs.iter().find(|(known, _)| known == letter) {
            *letter = *made;
        }
    }
    let factors = term.factors.iter().map(|own| renamed(own, &pairs));
    let term = Term {
        factors: factors.collect(),
        number: term.number,
    };
    (term, own)
}

/// `(−1)^m coefficient` by α, for `Σ (−1)^m (coefficient),α`: derivatives are moved off the variation.
fn moved(calculus: &Calculus<'_>, linear: Linear, free: &[char]) -> Option<Groups> {
    let mut groups = Groups::new();
    let canonical: Vec<char> = (0..2).map(|_| calculus.fresh()).collect();
    for (term, occurrence) in linear {
        let mut pairs: Vec<(char, char)> = Vec::new();
        let (mut term, occurrence) = apart(calculus, term, occurrence);
        bind(&mut term, &occurrence.indices, free, &mut pairs)?;
        let mut key = Vec::new();
        for (at, index) in occurrence.derivatives.iter().enumerate() {
            key.push(match index {
                Index::Letter(letter) => match pairs.iter().find(|(own, _)| own == letter) {
                    Some((_, new)) => Index::Letter(*new),
                    None => {
                        let new = *canonical.get(at)?;
                        pairs.push((*letter, new));
                        Index::Letter(new)
                    }
                },
                place => *place,
            });
        }
        let factors = term
            .factors
            .iter()
            .map(|own| renamed(own, &pairs))
            .collect();
        let odd = key.len() % 2 == 1;
        let number = if odd {
            -term.number.clone()
        } else {
            term.number.clone()
        };
        key.sort_unstable();
        groups
            .entry(key)
            .or_default()
            .push(Term { number, factors });
    }
    Some(groups)
}

/// `Σ (terms),α`, written as short as it can be.
fn sum_of_groups(
    calculus: &Calculus<'_>,
    groups: Groups,
    free: &[char],
    scope: &Scope,
) -> Option<Node> {
    let groups = shortest(calculus, groups, free, scope)?;
    let mut parts: Vec<(bool, Node)> = Vec::new();
    for (key, terms) in groups {
        parts.extend(group(&key, terms, free, scope)?);
    }
    let span = Span::new(0, 0);
    match <[(bool, Node); 1]>::try_from(parts) {
        Ok([(false, only)]) => Some(only),
        Ok([only]) => Some(Node {
            kind: Kind::Sum(vec![only]),
            span,
        }),
        Err(parts) if parts.is_empty() => Some(Node::number(0, span)),
        Err(parts) => Some(Node {
            kind: Kind::Sum(parts),
            span,
        }),
    }
}

/// Terms by what they are differentiated by.
type Groups = BTreeMap<Vec<Index>, Vec<Term>>;

/// The groups as they are, with second derivatives as first ones of the derived terms, or with all derivatives carried out: the first of those
/// with the fewest terms.
fn shortest(
    calculus: &Calculus<'_>,
    groups: Groups,
    free: &[char],
    scope: &Scope,
) -> Option<Groups> {
    let mut best = (count(&groups, free, scope), groups);
    for kept in [1, 0] {
        let Some(other) = carried_out(calculus, &best.1, kept) else {
            break;
        };
        // Products with too many letters are not compared.
        let own = count(&other, free, scope);
        if own.is_some_and(|own| best.0.is_none_or(|least| own < least)) {
            best = (own, other);
        }
    }
    Some(best.1)
}

/// How many terms there are, equal ones together.
fn count(groups: &Groups, free: &[char], scope: &Scope) -> Option<usize> {
    let mut sum = 0;
    for (key, terms) in groups {
        let mut held = free.to_vec();
        held.extend(key.iter().filter_map(|index| match index {
            Index::Letter(letter) => Some(*letter),
            Index::Place(_) => None,
        }));
        sum += collected(terms.clone(), &held, scope)?.len();
    }
    Some(sum)
}

/// Derivatives of higher order than some are carried out.
fn carried_out(calculus: &Calculus<'_>, groups: &Groups, order: usize) -> Option<Groups> {
    let mut other = Groups::new();
    for (key, terms) in groups {
        let (outer, inner) = key.split_at(order.min(key.len()));
        let mut own = terms.clone();
        for &by in inner {
            let derived = own.iter().map(|term| calculus.derived(term, by));
            own = derived.collect::<Option<Vec<_>>>()?.concat();
        }
        other.entry(outer.to_vec()).or_default().extend(own);
    }
    Some(other)
}

/// What is differentiated by the same indices.
fn group(
    key: &[Index],
    terms: Vec<Term>,
    free: &[char],
    scope: &Scope,
) -> Option<Vec<(bool, Node)>> {
    let mut held: Vec<char> = free.to_vec();
    // The letters of the derivatives get names that can be read.
    let mut names = "ijlmpqrs".chars().filter(|letter| {
        !free.contains(letter)
            && scope
                .space
                .coordinates
                .iter()
                .all(|c| c.name != letter.to_string())
    });
    let mut pairs = Vec::new();
    for index in key {
        if let Index::Letter(letter) = index {
            if !free.contains(letter) && pairs.iter().all(|(own, _)| own != letter) {
                let new = names.next()?;
                pairs.push((*letter, new));
                held.push(new);
            }
        }
    }
    let named: Vec<Index> = key
        .iter()
        .map(|index| match index {
            Index::Letter(letter) => {
                let known = pairs.iter().find(|(own, _)| own == letter);
                Index::Letter(known.map_or(*letter, |(_, new)| *new))
            }
            place => *place,
        })
        .collect();
    let terms: Vec<Term> = terms
        .into_iter()
        .map(|term| Term {
            factors: term
                .factors
                .iter()
                .map(|own| renamed(own, &pairs))
                .collect(),
            number: term.number,
        })
        .collect();
    let terms = collected(terms, &held, scope)?;
    if key.is_empty() {
        let parts = sum_of(terms).map(|node| match node.kind {
            Kind::Sum(parts) => parts,
            _ => vec![(false, node)],
        });
        return Some(parts.unwrap_or_default());
    }
    // One sign for all, so that it stands before the parentheses.
    let is_minus = terms
        .first()
        .is_some_and(|t| rational::is_negative(&t.number));
    let terms = terms.into_iter().map(|term| Term {
        number: if is_minus {
            -term.number.clone()
        } else {
            term.number.clone()
        },
        factors: term.factors,
    });
    let Some(inner) = sum_of(terms.collect()) else {
        return Some(Vec::new());
    };
    Some(vec![(is_minus, differentiated(inner, named))])
}

fn differentiated(inner: Node, by: Vec<Index>) -> Node {
    let span = inner.span;
    match inner.kind {
        Kind::Atom(atom) => {
            let mut derivatives = atom.derivatives.clone();
            derivatives.extend(by);
            let kind = Kind::Atom(Atom {
                derivatives,
                ..atom
            });
            Node { kind, span }
        }
        kind => {
            let inner = Node { kind, span };
            Node {
                kind: Kind::Derivative(Box::new(inner), by),
                span,
            }
        }
    }
}

/// The indices of the variation become the free letters.
fn bind(
    term: &mut Term,
    indices: &[Index],
    free: &[char],
    pairs: &mut Vec<(char, char)>,
) -> Option<()> {
    for (index, &wanted) in indices.iter().zip(free) {
        let Index::Letter(letter) = index else {
            return None;
        };
        match pairs.iter().find(|(own, _)| own == letter) {
            Some(&(_, first)) => term.factors.push(unit(first, wanted)),
            None => pairs.push((*letter, wanted)),
        }
    }
    Some(())
}

fn unit(a: char, b: char) -> Node {
    let kind = Kind::Atom(Atom {
        name: "delta".into(),
        primes: 0,
        indices: vec![Index::Letter(a), Index::Letter(b)],
        derivatives: Vec::new(),
        argument: None,
    });
    Node {
        kind,
        span: Span::new(0, 0),
    }
}

/// Whether a coefficient with two free letters is symmetric in them.
fn is_symmetric(value: &Node, free: &[char], scope: &Scope) -> bool {
    let d = scope.space.dimensions();
    let all = Tensor {
        rank: 2,
        components: scope.components(value, free),
    };
    let g = &scope.space.graph;
    let pairs = (0..d).flat_map(|a| (a + 1..d).map(move |b| (a, b)));
    let differences: Option<Vec<Expr>> = pairs
        .map(|(a, b)| Some(g.sub(all.at(&[a, b], d)?, all.at(&[b, a], d)?)))
        .collect();
    differences.is_some_and(|own| own.iter().all(|&e| g.is_zero(e)) || scope.space.vanish(&own))
}

/// Half of each term, and half of it with the two letters exchanged.
fn symmetrized(groups: Groups, (i, j): (char, char)) -> Option<Groups> {
    let half = rational::ratio(1, 2)?;
    let pairs = [(i, j), (j, i)];
    let turned = |index: &Index| match *index {
        Index::Letter(letter) => {
            let known = pairs.iter().find(|(from, _)| *from == letter);
            Index::Letter(known.map_or(letter, |(_, to)| *to))
        }
        place => place,
    };
    let mut both = Groups::new();
    for (key, terms) in groups {
        let mut other: Vec<Index> = key.iter().map(turned).collect();
        other.sort_unstable();
        for mut term in terms {
            term.number = rational::product(&term.number, &half);
            let factors = term.factors.iter().map(|own| renamed(own, &pairs));
            let exchanged = Term {
                number: term.number.clone(),
                factors: factors.collect(),
            };
            both.entry(other.clone()).or_default().push(exchanged);
            both.entry(key.clone()).or_default().push(term);
        }
    }
    Some(both)
}

/// Letters for the free indices of a field.
pub(super) fn free_of(shape: Shape, scope: &Scope) -> Option<Vec<char>> {
    let is_coordinate = |letter: &char| {
        scope
            .space
            .coordinates
            .iter()
            .any(|c| c.name == letter.to_string())
    };
    let wanted = match shape.rank() {
        0 => "",
        1 => "klmpqrs",
        2 => "ijlmpqrs",
        _ => return None,
    };
    let usable: Vec<char> = wanted.chars().filter(|l| !is_coordinate(l)).collect();
    usable.get(..shape.rank()).map(<[char]>::to_vec)
}

/// The components of a coefficient in the order of those of the field.
pub(super) fn components(scope: &Scope, value: &Node, shape: Shape, free: &[char]) -> Vec<Expr> {
    let d = scope.space.dimensions();
    let all = Tensor {
        rank: free.len(),
        components: scope.components(value, free),
    };
    let own = shape.components(d).into_iter();
    own.filter_map(|(indices, _)| all.at(&indices, d)).collect()
}
