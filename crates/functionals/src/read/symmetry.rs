//! Arguments of functions of a symmetric tensor must be symmetric.

use crate::notation::{free_letters, Atom, Kind, Node};
use crate::tensors::{tuples, Scope};
use chetaev_symbolic::syntax::Diagnostic;

/// Adds a problem for every argument that is not symmetric.
pub(super) fn check(scope: &Scope, node: &Node, problems: &mut Vec<Diagnostic>) {
    match &node.kind {
        Kind::Number(_) => {}
        Kind::Atom(atom) => argument(scope, atom, problems),
        Kind::Sum(parts) | Kind::Product(parts) => {
            parts
                .iter()
                .for_each(|(_, part)| check(scope, part, problems));
        }
        Kind::Power(base, exponent) => {
            check(scope, base, problems);
            check(scope, exponent, problems);
        }
        Kind::Apply(_, arguments) => arguments.iter().for_each(|a| check(scope, a, problems)),
        Kind::Root(inner) | Kind::Derivative(inner, _) => check(scope, inner, problems),
    }
}

fn argument(scope: &Scope, atom: &Atom, problems: &mut Vec<Diagnostic>) {
    let function = scope.function_named(&atom.name);
    let (Some(node), Some(function)) = (&atom.argument, function) else {
        return;
    };
    check(scope, node, problems);
    if scope.space.function_at(function).rank != 2 || !problems.is_empty() {
        return;
    }
    let d = scope.space.dimensions();
    let g = &scope.space.graph;
    let letters = free_letters(node);
    let at = |i: usize, j: usize| match &node.kind {
        Kind::Atom(own) if own.indices.is_empty() => scope.tensors.get(&own.name)?.at(&[i, j], d),
        _ => {
            let places = letters.iter().copied().zip([i, j]).collect();
            Some(scope.value(node, &places))
        }
    };
    for tuple in tuples(2, d) {
        let (Some(one), Some(other)) = (at(tuple[0], tuple[1]), at(tuple[1], tuple[0])) else {
            continue;
        };
        let difference = g.sub(one, other);
        if tuple[0] < tuple[1] && !g.is_zero(difference) && !scope.space.vanish(&[difference]) {
            let message = format!(
                "the argument of `{}` is not symmetric: its components {}{} and {}{} differ",
                atom.name,
                tuple[0] + 1,
                tuple[1] + 1,
                tuple[1] + 1,
                tuple[0] + 1
            );
            problems.push(
                Diagnostic::error("not-symmetric", node.span, message)
                    .hint("the symmetric part of T is (T_ij + T_ji)/2"),
            );
            return;
        }
    }
}
