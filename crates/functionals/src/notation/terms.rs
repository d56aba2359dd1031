//! Index notation as sums of products, and their linear parts in a field.

use super::{Atom, Index, Kind, Node};
use crate::tensors::Scope;
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::{rational, Function, Rational};
use std::cell::Cell;
use std::collections::BTreeSet;

/// Most terms of an expression written out.
const MOST_TERMS: usize = 400;

/// A product.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) number: Rational,
    pub(super) factors: Vec<Node>,
}

/// A variation of the field with its indices and derivatives.
#[derive(Clone, Debug)]
pub(super) struct Occurrence {
    pub(super) indices: Vec<Index>,
    pub(super) derivatives: Vec<Index>,
}

/// A coefficient with what it is the coefficient of.
pub(super) type Linear = Vec<(Term, Occurrence)>;

/// Reads names; letters that are made are in the private area of Unicode, so that no other letter is one of them.
pub(super) struct Calculus<'s> {
    scope: &'s Scope,
    /// Definitions that are varied as a whole.
    kept: &'s BTreeSet<String>,
    next: Cell<u32>,
}

const FIRST_MADE: u32 = 0xE000;

/// Whether a letter was made here.
pub(super) fn is_made(letter: char) -> bool {
    letter as u32 >= FIRST_MADE
}

impl<'s> Calculus<'s> {
    pub(super) fn new(scope: &'s Scope, kept: &'s BTreeSet<String>) -> Calculus<'s> {
        Calculus {
            scope,
            kept,
            next: Cell::new(FIRST_MADE),
        }
    }

    /// Another one whose letters are no letters of this one.
    pub(super) fn following(
        scope: &'s Scope,
        kept: &'s BTreeSet<String>,
        other: &Calculus<'_>,
    ) -> Calculus<'s> {
        let own = Calculus::new(scope, kept);
        own.follow(other);
        own
    }

    /// Makes letters that the other has not made.
    pub(super) fn follow(&self, other: &Calculus<'_>) {
        self.next.set(self.next.get().max(other.next.get()));
    }

    pub(super) fn fresh(&self) -> char {
        let next = self.next.get();
        self.next.set(next + 1);
        char::from_u32(next).unwrap_or('\u{f8ff}')
    }

    /// Written out; `None` where there is too much of it.
    pub(super) fn terms(&self, node: &Node) -> Option<Vec<Term>> {
        let unit = |factor: Node| Term {
            number: rational::integer(1),
            factors: vec![factor],
        };
        let found = match &node.kind {
            Kind::Number(value) => vec![Term {
                number: value.clone(),
                factors: Vec::new(),
            }],
            Kind::Atom(atom) => match self.scope.sizes.get(&atom.name) {
                Some(size) => vec![Term {
                    number: rational::integer(*size),
                    factors: Vec::new(),
                }],
                None => vec![unit(node.clone())],
            },
            Kind::Sum(parts) => {
                let mut found = Vec::new();
                for (minus, part) in parts {
                    for mut term in self.terms(&self.with_own_letters(part))? {
                        if *minus {
                            term.number = -term.number;
                        }
                        found.push(term);
                    }
                    if found.len() > MOST_TERMS {
                        return None;
                    }
                }
                found
            }
            Kind::Product(factors) => self.product(factors)?,
            Kind::Power(..) | Kind::Apply(..) | Kind::Root(_) => vec![unit(node.clone())],
            Kind::Derivative(inner, by) => {
                let mut found = self.terms(inner)?;
                for index in by {
                    found = self.all_derived(&found, *index)?;
                }
                found
            }
        };
        let found: Vec<Term> = found
            .into_iter()
            .filter(|term| term.number != Rational::ZERO)
            .collect();
        (found.len() <= MOST_TERMS).then_some(found)
    }

    fn product(&self, factors: &[(bool, Node)]) -> Option<Vec<Term>> {
        let mut found = vec![Term {
            number: rational::integer(1),
            factors: Vec::new(),
        }];
        for (divides, factor) in factors {
            let own = match (divides, &factor.kind) {
                (true, Kind::Number(value)) => vec![Term {
                    number: rational::powi(value, -1)?,
                    factors: Vec::new(),
                }],
                (true, _) => vec![Term {
                    number: rational::integer(1),
                    factors: vec![power(factor.clone(), -1)],
                }],
                (false, Kind::Sum(_)) if self.is_constant(factor) => vec![Term {
                    number: rational::integer(1),
                    factors: vec![factor.clone()],
                }],
                (false, Kind::Atom(_)) => self.terms(factor)?,
                (false, _) => self.terms(&self.with_own_letters(factor))?,
            };
            let mut longer = Vec::new();
            for term in &found {
                longer.extend(own.iter().map(|other| times(term, other)));
            }
            if longer.len() > MOST_TERMS {
                return None;
            }
            found = longer;
        }
        Some(found)
    }

    /// Whether only parameters without indices occur: such a factor stays as it is written.
    fn is_constant(&self, node: &Node) -> bool {
        match &node.kind {
            Kind::Number(_) => true,
            Kind::Atom(atom) => {
                let own = self.scope.tensors.get(&atom.name);
                let is_symbol = own.is_some_and(|t| t.rank == 0) && atom.derivatives.is_empty();
                is_symbol
                    && atom.argument.is_none()
                    && own.is_some_and(|t| self.scope.space.jets_in(&t.components).is_empty())
            }
            Kind::Sum(parts) | Kind::Product(parts) => {
                parts.iter().all(|(_, part)| self.is_constant(part))
            }
            _ => false,
        }
    }

    /// The letters that are summed over inside are made new ones, so that they are no other term's.
    fn with_own_letters(&self, node: &Node) -> Node {
        let free = super::free_letters(node);
        let mut all = Vec::new();
        letters(node, &mut all);
        let mut pairs: Vec<(char, char)> = Vec::new();
        for letter in all {
            let is_known = pairs.iter().any(|(own, _)| *own == letter);
            if !free.contains(&letter) && !is_known && !is_made(letter) {
                pairs.push((letter, self.fresh()));
            }
        }
        renamed(node, &pairs)
    }

    /// The linear part in the variation of a field; `None` for what is not treated.
    pub(super) fn linear(&self, terms: &[Term], field: &str) -> Option<Linear> {
        let mut found = Vec::new();
        chetaev_symbolic::meter::spend(terms.len() as u64);
        for term in terms {
            for (at, factor) in term.factors.iter().enumerate() {
                let mut others = term.clone();
                others.factors.remove(at);
                for (coefficient, occurrence) in self.linear_factor(factor, field)? {
                    found.push((times(&others, &coefficient), occurrence));
                }
            }
        }
        (found.len() <= MOST_TERMS).then_some(found)
    }

    fn linear_factor(&self, factor: &Node, field: &str) -> Option<Linear> {
        let one = |number: Rational, factors: Vec<Node>| Term { number, factors };
        match &factor.kind {
            Kind::Number(_) => Some(Vec::new()),
            Kind::Atom(atom) => self.linear_atom(atom, field),
            Kind::Sum(_) | Kind::Product(_) => self.linear(&self.terms(factor)?, field),
            Kind::Power(base, exponent) => {
                let inner = self.linear(&self.terms(base)?, field)?;
                if inner.is_empty() {
                    return Some(inner);
                }
                let n = integer_of(exponent)?;
                let mut factors = Vec::new();
                if n != 1 {
                    factors.push(power((**base).clone(), n - 1));
                }
                Some(scaled(&one(rational::integer(n), factors), inner))
            }
            Kind::Root(inner) => {
                let linear = self.linear(&self.terms(inner)?, field)?;
                let half = rational::ratio(1, 2)?;
                let below = one(half, vec![power(factor.clone(), -1)]);
                Some(scaled(&below, linear))
            }
            Kind::Apply(function, arguments) => {
                let [argument] = &arguments[..] else {
                    return None;
                };
                let linear = self.linear(&self.terms(argument)?, field)?;
                if linear.is_empty() {
                    return Some(linear);
                }
                let (sign, other) = match function {
                    Function::Sin => (1, Function::Cos),
                    Function::Cos => (-1, Function::Sin),
                    Function::Sinh => (1, Function::Cosh),
                    Function::Cosh => (1, Function::Sinh),
                    Function::Exp => (1, Function::Exp),
                    _ => return None,
                };
                let kind = Kind::Apply(other, arguments.clone());
                let span = factor.span;
                let slope = one(rational::integer(sign), vec![Node { kind, span }]);
                Some(scaled(&slope, linear))
            }
            Kind::Derivative(inner, by) => {
                let linear = self.linear(&self.terms(inner)?, field)?;
                self.linear_derived(linear, by)
            }
        }
    }

    fn linear_atom(&self, atom: &Atom, field: &str) -> Option<Linear> {
        if atom.name == field {
            let unit = Term {
                number: rational::integer(1),
                factors: Vec::new(),
            };
            let occurrence = Occurrence {
                indices: atom.indices.clone(),
                derivatives: atom.derivatives.clone(),
            };
            return Some(vec![(unit, occurrence)]);
        }
        if let Some(argument) = &atom.argument {
            return self.linear_application(atom, argument, field);
        }
        let Some((letters, body)) = self.scope.definitions.get(&atom.name) else {
            return Some(Vec::new());
        };
        if self.kept.contains(&atom.name) {
            return Some(Vec::new());
        }
        let body = self.with_own_letters(body);
        let at = places(&body, letters, &atom.indices);
        let linear = self.linear(&self.terms(&at)?, field)?;
        self.linear_derived(linear, &atom.derivatives)
    }

    fn linear_application(&self, atom: &Atom, argument: &Node, field: &str) -> Option<Linear> {
        let rank = {
            let function = self.scope.function_named(&atom.name)?;
            self.scope.space.function_at(function).rank
        };
        let slots: Vec<char> = (0..rank).map(|_| self.fresh()).collect();
        let inner = match &argument.kind {
            Kind::Atom(own) if own.indices.is_empty() && rank > 0 => Node {
                kind: Kind::Atom(Atom {
                    indices: slots.iter().map(|&l| Index::Letter(l)).collect(),
                    ..own.clone()
                }),
                span: argument.span,
            },
            _ => {
                let free = super::free_letters(argument);
                let pairs: Vec<(char, char)> =
                    free.into_iter().zip(slots.iter().copied()).collect();
                renamed(&self.with_own_letters(argument), &pairs)
            }
        };
        let linear = self.linear(&self.terms(&inner)?, field)?;
        if linear.is_empty() {
            return Some(linear);
        }
        if !atom.derivatives.is_empty() {
            return None;
        }
        let mut slope = atom.clone();
        slope.primes += 1;
        slope.indices.extend(slots.into_iter().map(Index::Letter));
        let slope = Term {
            number: rational::integer(1),
            factors: vec![Node {
                kind: Kind::Atom(slope),
                span: argument.span,
            }],
        };
        Some(scaled(&slope, linear))
    }

    fn linear_derived(&self, linear: Linear, by: &[Index]) -> Option<Linear> {
        let mut linear = linear;
        for index in by {
            let mut next = Vec::new();
            for (term, occurrence) in linear {
                for own in self.derived(&term, *index)? {
                    next.push((own, occurrence.clone()));
                }
                let mut further = occurrence;
                further.derivatives.push(*index);
                next.push((term, further));
            }
            linear = next;
        }
        Some(linear)
    }

    /// A product in which names that were kept are what their definitions say.
    pub(super) fn put_in(&self, term: &Term, names: &BTreeSet<String>) -> Option<Vec<Term>> {
        let mut found = vec![Term {
            number: term.number.clone(),
            factors: Vec::new(),
        }];
        for factor in &term.factors {
            let own = match &factor.kind {
                Kind::Atom(atom) if names.contains(&atom.name) => {
                    let (letters, body) = self.scope.definitions.get(&atom.name)?;
                    let body = places(&self.with_own_letters(body), letters, &atom.indices);
                    let mut own = self.terms(&body)?;
                    for index in &atom.derivatives {
                        own = self.all_derived(&own, *index)?;
                    }
                    own
                }
                _ => vec![Term {
                    number: rational::integer(1),
                    factors: vec![factor.clone()],
                }],
            };
            found = found
                .iter()
                .flat_map(|term| own.iter().map(move |other| times(term, other)))
                .collect();
        }
        Some(found)
    }

    fn all_derived(&self, terms: &[Term], by: Index) -> Option<Vec<Term>> {
        let mut found = Vec::new();
        for term in terms {
            found.extend(self.derived(term, by)?);
        }
        Some(found)
    }

    /// The derivative of a product; `None` where a factor is not a name.
    pub(super) fn derived(&self, term: &Term, by: Index) -> Option<Vec<Term>> {
        let mut found = Vec::new();
        for (at, factor) in term.factors.iter().enumerate() {
            let Kind::Atom(atom) = &factor.kind else {
                if self.is_constant(factor) {
                    continue;
                }
                return None;
            };
            if self.is_constant(factor) || matches!(atom.name.as_str(), "delta" | "epsilon") {
                continue;
            }
            let mut own = atom.clone();
            own.derivatives.push(by);
            let mut next = term.clone();
            next.factors[at].kind = Kind::Atom(own);
            found.push(next);
        }
        Some(found)
    }
}

fn scaled(factor: &Term, linear: Linear) -> Linear {
    let own = linear.into_iter();
    own.map(|(term, occurrence)| (times(factor, &term), occurrence))
        .collect()
}

pub(super) fn times(a: &Term, b: &Term) -> Term {
    let mut factors = a.factors.clone();
    factors.extend(b.factors.iter().cloned());
    Term {
        number: rational::product(&a.number, &b.number),
        factors,
    }
}

fn power(base: Node, n: i64) -> Node {
    let span = base.span;
    if n == 1 {
        return base;
    }
    Node {
        kind: Kind::Power(Box::new(base), Box::new(Node::number(n, span))),
        span,
    }
}

fn integer_of(node: &Node) -> Option<i64> {
    match &node.kind {
        Kind::Number(value) => rational::to_i64(value),
        Kind::Sum(parts) => match &parts[..] {
            [(true, one)] => Some(-integer_of(one)?),
            _ => None,
        },
        _ => None,
    }
}

/// All letters in the order of their occurrence, those of arguments of functions not among them.
pub(super) fn letters(node: &Node, found: &mut Vec<char>) {
    let mut of = |indices: &[Index]| {
        found.extend(indices.iter().filter_map(|index| match index {
            Index::Letter(letter) => Some(*letter),
            Index::Place(_) => None,
        }));
    };
    match &node.kind {
        Kind::Number(_) => {}
        Kind::Atom(atom) => {
            of(&atom.indices);
            of(&atom.derivatives);
        }
        Kind::Sum(parts) | Kind::Product(parts) => {
            parts.iter().for_each(|(_, part)| letters(part, found));
        }
        Kind::Power(base, exponent) => {
            letters(base, found);
            letters(exponent, found);
        }
        Kind::Apply(_, arguments) => arguments.iter().for_each(|a| letters(a, found)),
        Kind::Root(inner) => letters(inner, found),
        Kind::Derivative(inner, by) => {
            letters(inner, found);
            found.extend(by.iter().filter_map(|index| match index {
                Index::Letter(letter) => Some(*letter),
                Index::Place(_) => None,
            }));
        }
    }
}

/// Letters renamed, all at once.
pub(super) fn renamed(node: &Node, pairs: &[(char, char)]) -> Node {
    let map = |index: Index| match index {
        Index::Letter(letter) => {
            let known = pairs.iter().find(|(own, _)| *own == letter);
            Index::Letter(known.map_or(letter, |(_, new)| *new))
        }
        place => place,
    };
    mapped(node, &map)
}

/// The letters of a definition replaced by the indices at hand.
fn places(node: &Node, letters: &[char], indices: &[Index]) -> Node {
    let map = |index: Index| match index {
        Index::Letter(letter) => {
            let at = letters.iter().position(|own| *own == letter);
            at.and_then(|at| indices.get(at).copied()).unwrap_or(index)
        }
        place => place,
    };
    mapped(node, &map)
}

/// Every index replaced; those of arguments of functions are their own.
fn mapped(node: &Node, map: &dyn Fn(Index) -> Index) -> Node {
    let all = |indices: &[Index]| -> Vec<Index> { indices.iter().map(|&i| map(i)).collect() };
    let of = |node: &Node| Box::new(mapped(node, map));
    let parts = |parts: &[(bool, Node)]| -> Vec<(bool, Node)> {
        let own = parts.iter();
        own.map(|(sign, part)| (*sign, mapped(part, map))).collect()
    };
    let kind = match &node.kind {
        Kind::Number(value) => Kind::Number(value.clone()),
        Kind::Atom(atom) => Kind::Atom(Atom {
            indices: all(&atom.indices),
            derivatives: all(&atom.derivatives),
            ..atom.clone()
        }),
        Kind::Sum(own) => Kind::Sum(parts(own)),
        Kind::Product(own) => Kind::Product(parts(own)),
        Kind::Power(base, exponent) => Kind::Power(of(base), of(exponent)),
        Kind::Apply(function, arguments) => {
            let own = arguments.iter().map(|a| mapped(a, map));
            Kind::Apply(*function, own.collect())
        }
        Kind::Root(inner) => Kind::Root(of(inner)),
        Kind::Derivative(inner, by) => Kind::Derivative(of(inner), all(by)),
    };
    let span: Span = node.span;
    Node { kind, span }
}

/// All names that occur.
pub(super) fn names(node: &Node, found: &mut Vec<String>) {
    match &node.kind {
        Kind::Number(_) => {}
        Kind::Atom(atom) => {
            found.push(atom.name.clone());
            if let Some(argument) = &atom.argument {
                names(argument, found);
            }
        }
        Kind::Sum(parts) | Kind::Product(parts) => {
            parts.iter().for_each(|(_, part)| names(part, found));
        }
        Kind::Power(base, exponent) => {
            names(base, found);
            names(exponent, found);
        }
        Kind::Apply(_, arguments) => arguments.iter().for_each(|a| names(a, found)),
        Kind::Root(inner) | Kind::Derivative(inner, _) => names(inner, found),
    }
}

/// Letters for indices, the usual ones first; none is a coordinate.
pub(super) fn readable(scope: &Scope) -> impl Iterator<Item = char> + '_ {
    let is_coordinate = |letter: &char| {
        let mut all = scope.space.coordinates.iter();
        all.any(|c| c.name == letter.to_string() || c.suffix == letter.to_string())
    };
    let all = "ijklmnpqrsabcdefghotuvwxyz".chars();
    all.filter(move |letter| !is_coordinate(letter))
}
