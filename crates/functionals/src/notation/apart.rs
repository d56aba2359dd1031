//! Letters that are summed over, renamed so that no index stands more than twice in a printed term.
//!
//! Letters summed over inside parentheses are their own, and so are those of the argument of a function: `((u_k,i u_k,i) u_k,i),i` is read
//! as it is meant. A reader of a page sees one index four times. The same expression is printed with other letters.

use super::terms::{letters, readable, renamed};
use super::{free_letters, Index, Kind, Node};
use crate::tensors::Scope;
use std::collections::BTreeSet;

/// The same expression, in which every letter that is summed over is no other letter of its term.
pub(super) fn apart(node: &Node, scope: &Scope) -> Node {
    let mut taken: BTreeSet<char> = free_letters(node).into_iter().collect();
    Renaming { scope }.node(node, &mut taken)
}

struct Renaming<'s> {
    scope: &'s Scope,
}

impl Renaming<'_> {
    /// `taken` holds the letters around, free ones of the node among them; those of the node are added.
    fn node(&self, node: &Node, taken: &mut BTreeSet<char>) -> Node {
        match &node.kind {
            Kind::Number(_) => node.clone(),
            Kind::Atom(_) => {
                let node = self.bound_here(node, &visible(node), taken);
                self.argument(&node, taken)
            }
            Kind::Product(factors) => {
                let all = factors.iter().flat_map(|(_, factor)| free_letters(factor));
                let node = self.bound_here(node, &all.collect::<Vec<_>>(), taken);
                let Kind::Product(factors) = &node.kind else {
                    return node;
                };
                let own = factors.iter();
                let own = own.map(|(divides, factor)| (*divides, self.node(factor, taken)));
                let kind = Kind::Product(own.collect());
                with(&node, kind)
            }
            Kind::Sum(terms) => {
                let around = taken.clone();
                let own = terms.iter().map(|(minus, term)| {
                    let mut own = around.clone();
                    let term = self.node(term, &mut own);
                    taken.extend(own);
                    (*minus, term)
                });
                let kind = Kind::Sum(own.collect());
                with(node, kind)
            }
            Kind::Power(base, exponent) => {
                let base = Box::new(self.node(base, taken));
                with(
                    node,
                    Kind::Power(base, Box::new(self.node(exponent, taken))),
                )
            }
            Kind::Apply(function, arguments) => {
                let own = arguments.iter().map(|a| self.node(a, taken));
                with(node, Kind::Apply(*function, own.collect()))
            }
            Kind::Root(inner) => with(node, Kind::Root(Box::new(self.node(inner, taken)))),
            Kind::Derivative(inner, by) => {
                let mut seen = free_letters(inner);
                seen.extend(by.iter().filter_map(letter_of));
                let node = self.bound_here(node, &seen, taken);
                let Kind::Derivative(inner, by) = &node.kind else {
                    return node;
                };
                let inner = Box::new(self.node(inner, taken));
                with(&node, Kind::Derivative(inner, by.clone()))
            }
        }
    }

    /// What is summed over at the node itself gets letters that are not taken, and takes them.
    fn bound_here(&self, node: &Node, seen: &[char], taken: &mut BTreeSet<char>) -> Node {
        let twice = |letter: &char| seen.iter().filter(|own| *own == letter).count() == 2;
        let bound: BTreeSet<char> = seen.iter().copied().filter(twice).collect();
        let mut node = node.clone();
        for letter in bound {
            if taken.insert(letter) {
                continue;
            }
            if let Some(new) = self.unused(&node, taken) {
                node = renamed(&node, &[(letter, new)]);
                taken.insert(new);
            }
        }
        node
    }

    /// The letters of the argument of a function are its own: its slots in their order.
    fn argument(&self, node: &Node, taken: &mut BTreeSet<char>) -> Node {
        let Kind::Atom(atom) = &node.kind else {
            return node.clone();
        };
        let Some(argument) = &atom.argument else {
            return node.clone();
        };
        let mut argument = (**argument).clone();
        for letter in free_letters(&argument) {
            if taken.insert(letter) {
                continue;
            }
            if let Some(new) = self.unused(&argument, taken) {
                argument = renamed(&argument, &[(letter, new)]);
                taken.insert(new);
            }
        }
        let mut atom = atom.clone();
        atom.argument = Some(Box::new(self.node(&argument, taken)));
        with(node, Kind::Atom(atom))
    }

    /// A letter that is no coordinate, not taken, and not in the node.
    fn unused(&self, node: &Node, taken: &BTreeSet<char>) -> Option<char> {
        let mut own = Vec::new();
        letters(node, &mut own);
        readable(self.scope).find(|letter| !taken.contains(letter) && !own.contains(letter))
    }
}

fn with(node: &Node, kind: Kind) -> Node {
    let span = node.span;
    Node { kind, span }
}

/// The letters of a name with its derivatives.
fn visible(node: &Node) -> Vec<char> {
    let Kind::Atom(atom) = &node.kind else {
        return Vec::new();
    };
    let all = atom.indices.iter().chain(&atom.derivatives);
    all.filter_map(letter_of).collect()
}

fn letter_of(index: &Index) -> Option<char> {
    match index {
        Index::Letter(letter) => Some(*letter),
        Index::Place(_) => None,
    }
}
