//! The densities from which equations in index notation are derived: with the terms of multipliers, and with what is varied as a whole in them.

use super::by_parts::{coefficient, components, free_of};
use super::terms::{names, Calculus, Linear};
use super::{free_letters, parse, parse_sides, Atom, Index, Kind, Node};
use crate::functional::{Equation, Functional, Role};
use crate::tensors::{Scope, Shape, Tensor};
use chetaev_symbolic::syntax::Span;
use std::collections::{BTreeMap, BTreeSet};

/// The densities with the terms of multipliers, in the names of the functional and of its multipliers.
pub(super) struct Densities {
    pub(super) scope: Scope,
    inside: Node,
    /// For each name, the terms of the density in which it stands, also in definitions that stand there.
    places: BTreeMap<String, Vec<usize>>,
    pub(super) pieces: BTreeMap<String, Node>,
    pub(super) multipliers: BTreeSet<String>,
}

impl Densities {
    pub(super) fn of(functional: &Functional) -> Option<Densities> {
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
    pub(super) fn about(&self, names: &[&str]) -> Node {
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
        names(node, &mut named);
        named.sort_unstable();
        named.dedup();
        let mut all: Vec<String> = named.clone();
        while let Some(name) = named.pop() {
            let mut further = Vec::new();
            if let Some((_, body)) = self.scope.definitions.get(&name) {
                names(body, &mut further);
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
    pub(super) fn settled(&self) -> BTreeSet<String> {
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
    pub(super) fn put_in(&self, calculus: &Calculus<'_>, linear: Linear) -> Option<Linear> {
        let mut found = Linear::new();
        for (term, occurrence) in linear {
            let own = calculus.put_in(&term, &self.multipliers)?;
            found.extend(own.into_iter().map(|term| (term, occurrence.clone())));
        }
        Some(found)
    }
}
