//! Euler equations and natural conditions in index notation.
//!
//! They are derived from the densities as they are written, by the rules of index notation alone, and shown only where their components are
//! proved to be those of the first variation. A definition on the boundary that contains the normal, such as the traction, is varied as
//! a whole: the conditions then are the coefficients of δP_k and δu_k (T4 §4). The gradient of an energy, `s_ij = A'_ij(D)`, is varied as a
//! whole where its coefficient vanishes identically. Multipliers of imposed equations are varied by nothing, and put in at the end.

use super::canonical::{collected, sum_of};
use super::freedom::{Freedom, Varied};
use super::terms::{letters, renamed, times, Calculus, Linear, Occurrence, Term};
use super::{free_letters, parse, parse_sides, Atom, Index, Kind, Node};
use crate::functional::{Equation, Field, Functional, Piece, Role};
use crate::read::on_side;
use crate::space::Jet;
use crate::tensors::{Scope, Shape, Tensor};
use crate::variation::{piece_form, vanishes_on, Form, Variation};
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::{rational, Expr};
use std::collections::{BTreeMap, BTreeSet};

/// A coefficient in index notation; it vanishes.
#[derive(Clone, Debug)]
pub struct Indexed {
    /// What it is the coefficient of: `u_k`.
    pub of: String,
    /// The coefficient.
    pub value: Node,
    /// Whether it is known to vanish only where its variation takes all values, as that of a traction of which a matrix of moduli decides.
    pub is_in_general: bool,
}

/// The densities with the terms of multipliers, in the names of the functional and of its multipliers.
struct Densities {
    scope: Scope,
    inside: Node,
    /// For each name, the terms of the density in which it stands, also in definitions that stand there.
    places: BTreeMap<String, Vec<usize>>,
    pieces: BTreeMap<String, Node>,
    multipliers: BTreeSet<String>,
}

impl Densities {
    fn of(functional: &Functional) -> Option<Densities> {
        let mut own = Densities {
            scope: functional.scope.clone(),
            inside: functional.tree.clone(),
            places: BTreeMap::new(),
            pieces: BTreeMap::new(),
            multipliers: BTreeSet::new(),
        };
        for piece in &functional.pieces {
            let tree = piece.tree.iter().cloned();
            own.pieces
                .extend(tree.map(|tree| (piece.name.clone(), tree)));
        }
        for equation in functional.with_role(Role::Imposed) {
            if let Some((written, _)) = &equation.multiplier {
                own.add(equation, written)?;
            }
        }
        let terms = own.terms().into_iter().enumerate();
        let named: Vec<(usize, Vec<String>)> =
            terms.map(|(at, term)| (at, own.named(&term.1))).collect();
        for (at, names) in named {
            for name in names {
                own.places.entry(name).or_default().push(at);
            }
        }
        Some(own)
    }

    /// The density as a sum.
    fn terms(&self) -> Vec<(bool, Node)> {
        match &self.inside.kind {
            Kind::Sum(terms) => terms.clone(),
            _ => vec![(false, self.inside.clone())],
        }
    }

    /// The part of the density in which some names stand: what else is in it has no variation by them.
    fn about(&self, names: &[&str]) -> Node {
        let places = names.iter().filter_map(|name| self.places.get(*name));
        let places: BTreeSet<usize> = places.flatten().copied().collect();
        let kind = match &self.inside.kind {
            Kind::Sum(terms) => {
                let own = places.into_iter().filter_map(|at| terms.get(at));
                Kind::Sum(own.cloned().collect())
            }
            _ if places.is_empty() => Kind::Sum(Vec::new()),
            kind => kind.clone(),
        };
        let span = self.inside.span;
        Node { kind, span }
    }

    /// All names in an expression, and in the definitions of these.
    fn named(&self, node: &Node) -> Vec<String> {
        let mut named = Vec::new();
        super::terms::names(node, &mut named);
        named.sort_unstable();
        named.dedup();
        let mut all: Vec<String> = named.clone();
        while let Some(name) = named.pop() {
            let mut further = Vec::new();
            if let Some((_, body)) = self.scope.definitions.get(&name) {
                super::terms::names(body, &mut further);
            }
            further.retain(|own| !all.contains(own));
            further.sort_unstable();
            further.dedup();
            all.extend(further.iter().cloned());
            named.extend(further);
        }
        all
    }

    /// Adds `λ (left − right)`.
    fn add(&mut self, equation: &Equation, written: &str) -> Option<()> {
        let mut problems = Vec::new();
        let (left, right) = parse_sides(&equation.written, &self.scope, &mut problems)?;
        let value = parse(written, &self.scope, &mut problems)?;
        let mut letters = free_letters(&value);
        letters.sort_unstable();
        let name = format!("multiplier_{}", equation.label);
        let span = Span::new(0, 0);
        let node = |kind: Kind| Node { kind, span };
        let multiplier = node(Kind::Atom(Atom {
            name: name.clone(),
            primes: 0,
            indices: letters.iter().map(|&l| Index::Letter(l)).collect(),
            derivatives: Vec::new(),
            argument: None,
        }));
        let mut sides = vec![(false, left)];
        sides.extend(right.map(|right| (true, right)));
        let residual = node(Kind::Sum(sides));
        let term = node(Kind::Product(vec![(false, multiplier), (false, residual)]));
        let components = self.scope.components(&value, &letters);
        let rank = letters.len();
        self.scope
            .tensors
            .insert(name.clone(), Tensor { rank, components });
        self.scope
            .definitions
            .insert(name.clone(), (letters, value));
        self.multipliers.insert(name);
        let zero = Node::number(0, span);
        let place = match &equation.on {
            None => &mut self.inside,
            Some(on) => self.pieces.entry(on.clone()).or_insert(zero),
        };
        *place = node(Kind::Sum(vec![(false, place.clone()), (false, term)]));
        Some(())
    }

    /// Gradients of energies that may be varied as a whole, as the coefficient of their variation vanishes identically.
    fn settled(&self) -> BTreeSet<String> {
        let all = self.scope.definitions.keys().cloned();
        let all = all.filter(|name| self.places.contains_key(name));
        let own = all.filter(|name| self.is_gradient(name));
        let own: BTreeSet<String> = own.collect();
        own.into_iter()
            .filter(|name| self.is_settled(name).unwrap_or(false))
            .collect()
    }

    /// Whether a name is defined as the gradient of a function with a Legendre conjugate.
    fn is_gradient(&self, name: &str) -> bool {
        let Some((_, body)) = self.scope.definitions.get(name) else {
            return false;
        };
        let Kind::Atom(atom) = &body.kind else {
            return false;
        };
        let function = self.scope.function_named(&atom.name);
        let is_conjugate =
            function.is_some_and(|at| self.scope.space.function_at(at).conjugate.is_some());
        atom.primes == 1 && atom.derivatives.is_empty() && is_conjugate
    }

    fn is_settled(&self, name: &str) -> Option<bool> {
        let mut kept = self.multipliers.clone();
        kept.insert(name.to_owned());
        let calculus = Calculus::new(&self.scope, &kept);
        let linear = calculus.linear(&calculus.terms(&self.about(&[name]))?, name)?;
        let shape = match self.scope.tensors.get(name)?.rank {
            0 => Shape::Scalar,
            1 => Shape::Vector,
            _ if self.scope.is_symmetric(name) => Shape::Symmetric,
            _ => Shape::Matrix,
        };
        let free = free_of(shape, &self.scope)?;
        let value = coefficient(&calculus, linear, shape, (&free, &self.scope))?;
        let own = components(&self.scope, &value, shape, &free);
        Some(self.scope.space.vanish(&own))
    }

    /// Multipliers replaced by what is stated for them.
    fn put_in(&self, calculus: &Calculus<'_>, linear: Linear) -> Option<Linear> {
        let mut found = Linear::new();
        for (term, occurrence) in linear {
            let own = calculus.put_in(&term, &self.multipliers)?;
            found.extend(own.into_iter().map(|term| (term, occurrence.clone())));
        }
        Some(found)
    }
}

/// The Euler equations of all fields, `None` in the place of one that index notation has no short form for.
pub fn euler(functional: &Functional, variation: &Variation) -> Vec<Option<Indexed>> {
    let fields = functional.interior();
    let Some(densities) = Densities::of(functional) else {
        return fields.map(|_| None).collect();
    };
    let mut kept = densities.settled();
    kept.extend(densities.multipliers.iter().cloned());
    fields
        .map(|field| equation(functional, variation, field, (&densities, &kept)))
        .collect()
}

fn equation(
    functional: &Functional,
    variation: &Variation,
    field: &Field,
    (densities, kept): (&Densities, &BTreeSet<String>),
) -> Option<Indexed> {
    let scope = &densities.scope;
    let calculus = Calculus::new(scope, kept);
    let terms = calculus.terms(&densities.about(&[&field.name]))?;
    let linear = calculus.linear(&terms, &field.name)?;
    let linear = densities.put_in(&calculus, linear)?;
    let free = free_of(field.shape, scope)?;
    let value = coefficient(&calculus, linear, field.shape, (&free, scope))?;
    let own = components(scope, &value, field.shape, &free);
    let all = field.components.iter().zip(own).all(|(component, value)| {
        let known = variation.euler.iter().find(|(c, _)| c == component);
        known.is_some_and(|(_, known)| agree(functional, value, *known))
    });
    all.then(|| Indexed {
        of: name_of(&field.name, &free),
        value,
        is_in_general: false,
    })
}

fn agree(functional: &Functional, a: Expr, b: Expr) -> bool {
    let space = &*functional.space;
    let difference = space.graph.sub(a, b);
    space.graph.is_zero(difference) || space.vanish(&[difference])
}

/// Letters for the free indices of a field.
fn free_of(shape: Shape, scope: &Scope) -> Option<Vec<char>> {
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

fn name_of(name: &str, free: &[char]) -> String {
    match free {
        [] => name.to_owned(),
        _ => format!("{name}_{}", free.iter().collect::<String>()),
    }
}

/// The coefficient of the variation of a field, in its free letters; the symmetric part, where it is not symmetric itself and the field is.
fn coefficient(
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

/// The components of a coefficient in the order of those of the field.
fn components(scope: &Scope, value: &Node, shape: Shape, free: &[char]) -> Vec<Expr> {
    let d = scope.space.dimensions();
    let all = Tensor {
        rank: free.len(),
        components: scope.components(value, free),
    };
    let own = shape.components(d).into_iter();
    own.filter_map(|(indices, _)| all.at(&indices, d)).collect()
}

/// The natural conditions on a piece; `None` where the densities have no short form there.
pub fn natural(functional: &Functional, piece: &Piece) -> Option<Vec<Indexed>> {
    let densities = Densities::of(functional)?;
    let settled = densities.settled();
    conditions_on(functional, piece, &densities, settled)
        .or_else(|| conditions_on(functional, piece, &densities, BTreeSet::new()))
}

fn conditions_on(
    functional: &Functional,
    piece: &Piece,
    densities: &Densities,
    mut whole: BTreeSet<String>,
) -> Option<Vec<Indexed>> {
    let scope = &densities.scope;
    whole.extend(densities.multipliers.iter().cloned());
    let mut kept = varied_as_a_whole(functional, densities.pieces.get(&piece.name), scope);
    let through: Vec<Through> = kept
        .iter()
        .filter_map(|name| through(scope, name))
        .collect();
    let tractions = kept.clone();
    kept.extend(through.iter().map(|own| own.stress.clone()));
    kept.extend(whole.iter().cloned());
    let calculus = Calculus::new(scope, &kept);
    let inside_about = |name: &str| {
        let stresses = through.iter().map(|own| own.stress.as_str());
        let names: Vec<&str> = stresses.chain([name]).collect();
        calculus.terms(&densities.about(&names))
    };
    let outside = match densities.pieces.get(&piece.name) {
        Some(tree) => calculus.terms(tree)?,
        None => Vec::new(),
    };
    let mut found = Vec::new();
    // What is shown, and has to be varied independently.
    let (mut wholes, mut shown) = (Vec::new(), Vec::new());
    let mut coefficients: Vec<(String, Shape, Vec<Expr>)> = Vec::new();
    for name in &tractions {
        let (letters, _) = scope.definitions.get(name)?;
        let shape = match letters.len() {
            0 => Shape::Scalar,
            1 => Shape::Vector,
            _ => Shape::Matrix,
        };
        let mut linear = calculus.linear(&outside, name)?;
        let inside = inside_about(name)?;
        for own in through.iter().filter(|own| own.traction == *name) {
            linear.extend(own.flux(&calculus, &inside)?);
        }
        let linear = densities.put_in(&calculus, linear)?;
        let (indexed, own) = condition(&calculus, linear, name, shape, scope)?;
        let vanishes = own.iter().all(|&e| {
            let e = on_side(scope, &piece.side, e);
            scope.space.graph.is_zero(e) || scope.space.vanish(&[e])
        });
        if !vanishes {
            wholes.extend(&scope.tensors.get(name)?.components);
            found.extend(indexed);
        }
        coefficients.push((name.clone(), shape, own));
    }
    let tractions = found.len();
    let here = functional
        .fields
        .iter()
        .filter(|f| f.on.as_ref().is_none_or(|on| *on == piece.name));
    for field in here {
        let mut linear = Linear::new();
        if field.on.is_none() {
            let inside = inside_about(&field.name)?;
            let mut all = calculus.linear(&inside, &field.name)?;
            for own in &through {
                all.extend(own.rest(&calculus, &inside, (scope, &whole), &field.name)?);
            }
            for (term, mut occurrence) in all {
                match occurrence.derivatives[..] {
                    [] => continue,
                    [Index::Place(at)] if at >= scope.space.dimensions() => continue,
                    [by] => {
                        occurrence.derivatives.clear();
                        linear.push((times(&normal(by), &term), occurrence));
                    }
                    _ => return None,
                }
            }
        }
        linear.extend(calculus.linear(&outside, &field.name)?);
        let linear = densities.put_in(&calculus, linear)?;
        let (indexed, own) = condition(&calculus, linear, &field.name, field.shape, scope)?;
        let is_fixed = field
            .components
            .iter()
            .any(|&c| piece.fixed.contains(&(c, false)));
        let vanishes = own.iter().all(|&e| {
            let e = on_side(scope, &piece.side, e);
            scope.space.graph.is_zero(e) || scope.space.vanish(&[e])
        });
        if !is_fixed && !vanishes {
            shown.extend(field.components.iter().filter(|_| field.on.is_none()));
            found.extend(indexed);
        }
        coefficients.push((field.name.clone(), field.shape, own));
    }
    if !is_first_variation(functional, piece, scope, &coefficients) {
        return None;
    }
    match Varied::new(functional, piece, &wholes, shown).freedom() {
        Freedom::Everywhere => {}
        Freedom::InGeneral => found[..tractions]
            .iter_mut()
            .for_each(|own| own.is_in_general = true),
        Freedom::Unknown => return None,
    }
    Some(found)
}

/// A traction that is the normal times a stress, which may stand in the density with a derivative.
struct Through {
    traction: String,
    stress: String,
    /// Which index of the stress belongs to the normal.
    at: usize,
}

fn through(scope: &Scope, traction: &str) -> Option<Through> {
    let (letters, body) = scope.definitions.get(traction)?;
    let Kind::Product(factors) = &body.kind else {
        return None;
    };
    let [(false, one), (false, other)] = &factors[..] else {
        return None;
    };
    let (Kind::Atom(normal), Kind::Atom(stress)) = (&one.kind, &other.kind) else {
        return None;
    };
    let is_normal = normal.name == "n" && scope.definitions.contains_key(&stress.name);
    let at = stress
        .indices
        .iter()
        .position(|index| normal.indices.contains(index))?;
    let mut rest = stress.indices.clone();
    rest.remove(at);
    let wanted: Vec<Index> = letters.iter().map(|&l| Index::Letter(l)).collect();
    let is_plain = is_normal && stress.derivatives.is_empty() && rest == wanted;
    is_plain.then(|| Through {
        traction: traction.to_owned(),
        stress: stress.name.clone(),
        at,
    })
}

impl Through {
    /// What the derivative of the stress in the density leaves on the boundary.
    fn flux(&self, calculus: &Calculus<'_>, inside: &[Term]) -> Option<Linear> {
        let mut found = Linear::new();
        for (term, mut occurrence) in calculus.linear(inside, &self.stress)? {
            match occurrence.derivatives[..] {
                [] => continue,
                [by] if occurrence.indices.get(self.at) == Some(&by) => {
                    occurrence.indices.remove(self.at);
                    occurrence.derivatives.clear();
                    found.push((term, occurrence));
                }
                _ => return None,
            }
        }
        Some(found)
    }

    /// The linear part in a field that is in the stress, after the derivative was moved off the stress.
    fn rest(
        &self,
        calculus: &Calculus<'_>,
        inside: &[Term],
        (scope, whole): (&Scope, &BTreeSet<String>),
        field: &str,
    ) -> Option<Linear> {
        let of_stress = calculus.linear(inside, &self.stress)?;
        // Its letters are none of those that were made so far.
        let open = Calculus::following(scope, whole, calculus);
        let mut found = Linear::new();
        for (term, occurrence) in of_stress {
            let coefficients = match occurrence.derivatives[..] {
                [] => vec![term],
                [by] => {
                    let mut all = calculus.derived(&term, by)?;
                    for own in &mut all {
                        own.number = -own.number.clone();
                    }
                    all
                }
                _ => return None,
            };
            let stress = Term {
                number: rational::integer(1),
                factors: vec![Node {
                    kind: Kind::Atom(Atom {
                        name: self.stress.clone(),
                        primes: 0,
                        indices: occurrence.indices,
                        derivatives: Vec::new(),
                        argument: None,
                    }),
                    span: Span::new(0, 0),
                }],
            };
            let linear = open.linear(&[stress], field)?;
            calculus.follow(&open);
            for coefficient in &coefficients {
                let own = linear
                    .iter()
                    .map(|(term, o)| (times(coefficient, term), o.clone()));
                found.extend(own);
            }
        }
        Some(found)
    }
}

fn normal(by: Index) -> Term {
    let kind = Kind::Atom(Atom {
        name: "n".into(),
        primes: 0,
        indices: vec![by],
        derivatives: Vec::new(),
        argument: None,
    });
    Term {
        number: rational::integer(1),
        factors: vec![Node {
            kind,
            span: Span::new(0, 0),
        }],
    }
}

/// The coefficient with its components; derivatives of the variation have no place here.
fn condition(
    calculus: &Calculus<'_>,
    linear: Linear,
    name: &str,
    shape: Shape,
    scope: &Scope,
) -> Option<(Option<Indexed>, Vec<Expr>)> {
    if linear
        .iter()
        .any(|(_, occurrence)| !occurrence.derivatives.is_empty())
    {
        return None;
    }
    let free = free_of(shape, scope)?;
    let is_empty = linear.is_empty();
    let value = coefficient(calculus, linear, shape, (&free, scope))?;
    let own = components(scope, &value, shape, &free);
    let of = name_of(name, &free);
    let indexed = Indexed {
        of,
        value,
        is_in_general: false,
    };
    Some(((!is_empty).then_some(indexed), own))
}

/// Definitions in the density of a piece that contain the normal and a field that is varied.
fn varied_as_a_whole(
    functional: &Functional,
    density: Option<&Node>,
    scope: &Scope,
) -> BTreeSet<String> {
    let mut named = Vec::new();
    if let Some(tree) = density {
        super::terms::names(tree, &mut named);
    }
    let varied: BTreeSet<usize> = functional
        .interior()
        .flat_map(|f| f.components.clone())
        .collect();
    let normal = scope.space.normals();
    let own = named.into_iter().filter(|name| {
        let Some(tensor) = scope
            .tensors
            .get(name)
            .filter(|_| scope.definitions.contains_key(name))
        else {
            return false;
        };
        let symbols = scope.space.symbols_in(&tensor.components);
        let jets = scope.space.jets_in(&tensor.components);
        symbols.iter().any(|s| normal.contains(s))
            && jets.iter().any(|j| varied.contains(&j.component))
    });
    own.collect()
}

/// Whether `Σ c δ(…)` has the coefficients of the first variation on the piece.
fn is_first_variation(
    functional: &Functional,
    piece: &Piece,
    scope: &Scope,
    coefficients: &[(String, Shape, Vec<Expr>)],
) -> bool {
    let space = &*functional.space;
    let g = &space.graph;
    let Some(form) = piece_form(functional, &piece.name) else {
        return false;
    };
    let d = space.dimensions();
    let mut wanted: BTreeMap<Jet, Vec<Expr>> = form
        .into_iter()
        .map(|(jet, value)| (jet, vec![g.neg(value)]))
        .collect();
    for (name, shape, values) in coefficients {
        let Some(tensor) = scope.tensors.get(name) else {
            return false;
        };
        for ((indices, multiplicity), &value) in shape.components(d).iter().zip(values) {
            let Some(own) = tensor.at(indices, d) else {
                return false;
            };
            let own = on_side(scope, &piece.side, own);
            for jet in space.jets_in(&[own]) {
                let slope = space.partial(own, &jet);
                let term = g.mul(&[
                    g.integer(*multiplicity),
                    on_side(scope, &piece.side, value),
                    slope,
                ]);
                let is_varied = functional
                    .fields
                    .iter()
                    .any(|f| f.components.contains(&jet.component));
                if is_varied {
                    wanted.entry(jet).or_default().push(term);
                }
            }
        }
    }
    let sums = wanted.into_iter().map(|(jet, terms)| (jet, g.add(&terms)));
    let rest: Form = sums
        .filter(|(_, e)| !g.is_zero(*e) && !space.vanish(&[*e]))
        .collect();
    // Terms with second derivatives can be moved off the variation in two ways, which differ by a divergence along the piece.
    rest.is_empty() || vanishes_on(functional, piece, &rest)
}
