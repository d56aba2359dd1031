//! What densities and equations are divided by as they are written, also where it cancels: (1 − β)/(1 − β) is one for β ≠ 1 alone.

use super::{free_letters, parse_sides, Kind, Node};
use crate::functional::{Functional, Role};
use crate::tensors::Scope;
use chetaev_symbolic::{rational, Expr};
use std::collections::{BTreeMap, BTreeSet};

/// The denominators that have no free letters, those in definitions that are used too.
pub(crate) fn denominators(functional: &Functional) -> BTreeSet<Expr> {
    let stated = functional.equations.iter();
    let stated = stated.filter(|own| own.role != Role::Other);
    let sides = stated.filter_map(|own| {
        let (left, right) = parse_sides(&own.written, &functional.scope, &mut Vec::new())?;
        Some(std::iter::once(left).chain(right))
    });
    let on_pieces = functional.pieces.iter().filter_map(|own| own.tree.clone());
    let all = std::iter::once(functional.tree.clone()).chain(on_pieces);
    let mut walk = Walk {
        scope: &functional.scope,
        seen: BTreeSet::new(),
        found: BTreeSet::new(),
    };
    all.chain(sides.flatten()).for_each(|tree| walk.node(&tree));
    walk.found
}

struct Walk<'f> {
    scope: &'f Scope,
    /// Definitions that were looked at.
    seen: BTreeSet<String>,
    found: BTreeSet<Expr>,
}

impl Walk<'_> {
    fn node(&mut self, node: &Node) {
        match &node.kind {
            Kind::Number(_) => {}
            Kind::Atom(atom) => {
                let body = self.scope.definitions.get(&atom.name);
                if let Some((_, body)) = body.filter(|_| self.seen.insert(atom.name.clone())) {
                    self.node(body);
                }
                atom.argument.iter().for_each(|own| self.node(own));
            }
            Kind::Product(parts) => {
                for (divides, part) in parts {
                    self.node(part);
                    if *divides {
                        self.divided_by(part);
                    }
                }
            }
            Kind::Power(base, exponent) => {
                self.node(base);
                let g = &self.scope.space.graph;
                let value = self.value(exponent);
                if value
                    .and_then(|e| g.as_number(e))
                    .is_some_and(rational::is_negative)
                {
                    self.divided_by(base);
                }
            }
            Kind::Sum(parts) => parts.iter().for_each(|(_, part)| self.node(part)),
            Kind::Apply(_, arguments) => arguments.iter().for_each(|own| self.node(own)),
            Kind::Root(inner) | Kind::Derivative(inner, _) => self.node(inner),
        }
    }

    fn value(&self, node: &Node) -> Option<Expr> {
        let is_scalar = free_letters(node).is_empty();
        is_scalar.then(|| self.scope.value(node, &BTreeMap::new()))
    }

    fn divided_by(&mut self, node: &Node) {
        let value = self.value(node);
        let is_number = |e: &Expr| self.scope.space.graph.as_number(*e).is_some();
        self.found.extend(value.filter(|e| !is_number(e)));
    }
}
