//! Simultaneous substitution.

use crate::graph::Graph;
use crate::node::{Expr, Node, Symbol};
use rustc_hash::FxHashMap;

impl Graph {
    /// Replaces every occurrence of the keys (any expressions, all at once) by their values.
    pub fn substitute(&self, e: Expr, replacements: &[(Expr, Expr)]) -> Expr {
        self.substitute_all(&[e], replacements).swap_remove(0)
    }

    /// [`substitute`](Graph::substitute) in several expressions, shared parts rebuilt once.
    pub fn substitute_all(&self, roots: &[Expr], replacements: &[(Expr, Expr)]) -> Vec<Expr> {
        let mut image: FxHashMap<Expr, Expr> = FxHashMap::default();
        let keys: FxHashMap<Expr, Expr> = replacements.iter().copied().collect();
        let mut solved = SolveCache::default();
        for e in self.reachable(roots) {
            let value = match keys.get(&e) {
                Some(&value) => value,
                None => {
                    let mut child = |c: Expr| image.get(&c).copied().unwrap_or(c);
                    self.rebuild(e, &mut child, &mut solved)
                }
            };
            if value != e {
                image.insert(e, value);
            }
        }
        roots
            .iter()
            .map(|r| image.get(r).copied().unwrap_or(*r))
            .collect()
    }

    /// Expressions of another graph in this one, each symbol replaced by what `symbol` gives for it.
    pub fn copied(
        &self,
        other: &Graph,
        roots: &[Expr],
        symbol: &mut dyn FnMut(Symbol) -> Expr,
    ) -> Vec<Expr> {
        let mut image: FxHashMap<Expr, Expr> = FxHashMap::default();
        let mut solutions: FxHashMap<Expr, Vec<Expr>> = FxHashMap::default();
        for e in other.reachable(roots) {
            let of = |e: &Expr| image.get(e).copied().unwrap_or_else(|| self.zero());
            if let Some(value) = self.made(other.node(e), &mut |c| of(&c)) {
                image.insert(e, value);
                continue;
            }
            let value = match other.node(e) {
                Node::Symbol(own) => symbol(*own),
                // Its entries make the solution anew.
                Node::Matrix { .. } => continue,
                Node::Solve { matrix, rhs } => {
                    let Node::Matrix { entries, .. } = other.node(*matrix) else {
                        continue;
                    };
                    let entries: Vec<Expr> = entries.iter().map(of).collect();
                    let rhs: Vec<Expr> = rhs.iter().map(of).collect();
                    let found = self.solve(&entries, &rhs).unwrap_or_else(|_| {
                        let size = rhs.len();
                        match self.matrix(size, size, &entries) {
                            Some(matrix) => self.solve_entries(matrix, &rhs),
                            None => rhs,
                        }
                    });
                    solutions.insert(e, found);
                    continue;
                }
                Node::Entry { of: solve, index } => {
                    let found = solutions.get(solve);
                    let found = found.and_then(|all| all.get(*index as usize));
                    found.copied().unwrap_or_else(|| self.zero())
                }
                _ => continue,
            };
            image.insert(e, value);
        }
        let of = |r: &Expr| image.get(r).copied().unwrap_or_else(|| self.zero());
        roots.iter().map(of).collect()
    }

    /// The node with its children replaced through `child`, in canonical form; the node itself when none changes.
    ///
    /// Components of one solve share their rebuilding through `solved`, which belongs to one substitution.
    pub fn rebuild(
        &self,
        e: Expr,
        child: &mut dyn FnMut(Expr) -> Expr,
        solved: &mut SolveCache,
    ) -> Expr {
        if let Node::Entry { of, index } = self.node(e) {
            return self.rebuild_entry(e, *of, *index, child, solved);
        }
        let mut changed = false;
        self.node(e).for_each_child(|c| changed |= child(c) != c);
        if !changed {
            return e;
        }
        if let Some(made) = self.made(self.node(e), child) {
            return made;
        }
        match self.node(e) {
            Node::Matrix {
                rows,
                columns,
                entries,
            } => {
                let entries: Vec<Expr> = entries.iter().map(|&a| child(a)).collect();
                self.matrix(*rows as usize, *columns as usize, &entries)
                    .unwrap_or(e)
            }
            // A solve is rebuilt by its entries, which may come out simpler than a solve node.
            _ => e,
        }
    }

    /// A node with its children through `child`, in canonical form; `None` for symbols and for linear systems.
    fn made(&self, node: &Node, child: &mut dyn FnMut(Expr) -> Expr) -> Option<Expr> {
        Some(match node {
            Node::Number(value) => self.number(value.clone()),
            Node::Pi => self.pi(),
            Node::Algebraic(own) => self.algebraic((**own).clone()),
            Node::Sum { constant, terms } => {
                let mut parts: Vec<Expr> = terms
                    .iter()
                    .map(|(t, c)| self.scale(c, child(*t)))
                    .collect();
                parts.push(self.number(constant.clone()));
                self.add(&parts)
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let mut parts: Vec<Expr> = factors.iter().map(|&f| child(f)).collect();
                parts.push(self.number(coefficient.clone()));
                self.mul(&parts)
            }
            Node::Power { base, exponent } => self.pow(child(*base), child(*exponent)),
            Node::Apply {
                function,
                arguments,
            } => {
                let arguments: Vec<Expr> = arguments.iter().map(|&a| child(a)).collect();
                self.apply(*function, &arguments)
            }
            Node::Symbol(_) | Node::Matrix { .. } | Node::Solve { .. } | Node::Entry { .. } => {
                return None
            }
        })
    }

    fn rebuild_entry(
        &self,
        e: Expr,
        of: Expr,
        index: u32,
        child: &mut dyn FnMut(Expr) -> Expr,
        solved: &mut SolveCache,
    ) -> Expr {
        let Node::Solve { matrix, rhs } = self.node(of) else {
            return e;
        };
        let new_matrix = child(*matrix);
        let values = solved
            .0
            .entry(of)
            .or_insert_with(|| self.rebuild_solve(*matrix, rhs, new_matrix, child));
        match values {
            Some(values) => values.get(index as usize).copied().unwrap_or(e),
            None => e,
        }
    }

    /// The solution with everything replaced; `None` when nothing changes.
    fn rebuild_solve(
        &self,
        matrix: Expr,
        rhs: &[Expr],
        new_matrix: Expr,
        child: &mut dyn FnMut(Expr) -> Expr,
    ) -> Option<Vec<Expr>> {
        let new_rhs: Vec<Expr> = rhs.iter().map(|&b| child(b)).collect();
        if new_matrix == matrix && new_rhs[..] == rhs[..] {
            return None;
        }
        let Node::Matrix { entries, .. } = self.node(new_matrix) else {
            return None;
        };
        // A matrix that became structurally singular stays a solve: evaluating it reports the singularity.
        let values = self.solve(entries, &new_rhs);
        Some(values.unwrap_or_else(|_| self.solve_entries(new_matrix, &new_rhs)))
    }
}

/// Solves already rebuilt in one substitution; `None` for those that do not change.
#[derive(Default)]
pub struct SolveCache(FxHashMap<Expr, Option<Vec<Expr>>>);

#[cfg(test)]
mod tests {
    use crate::Graph;

    #[test]
    fn substitution_is_simultaneous() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x", 0), g.symbol("y", 0));
        let e = g.add(&[x, g.mul(&[g.integer(2), y])]);
        let swapped = g.substitute(e, &[(x, y), (y, x)]);
        assert_eq!(swapped, g.add(&[y, g.mul(&[g.integer(2), x])]));
    }

    #[test]
    fn another_graph_is_copied_with_its_solves() {
        let (g, other) = (Graph::new(), Graph::new());
        let [a, b, c, d, u, v] = ["a", "b", "c", "d", "u", "v"].map(|n| other.symbol(n, 0));
        let x = other.solve(&[a, b, c, d], &[u, other.sin(v)]).unwrap();
        // Symbols of this graph have other handles.
        let [w, v, u, d, c, b, a] = ["w", "v", "u", "d", "c", "b", "a"].map(|n| g.symbol(n, 0));
        let expected = g.solve(&[a, b, c, w], &[u, g.sin(v)]).unwrap();
        let copied = g.copied(&other, &x, &mut |s| match other.symbol_name(s) {
            "d" => w,
            name => g.symbol(name, other.symbol_order(s)),
        });
        assert_eq!(copied, expected);
        assert_ne!(copied[0], d);
    }

    #[test]
    fn solves_are_rebuilt() {
        let g = Graph::new();
        let [a, b, c, d, u, v] = ["a", "b", "c", "d", "u", "v"].map(|n| g.symbol(n, 0));
        let x = g.solve(&[a, b, c, d], &[u, v]).unwrap();
        let direct = g.solve(&[a, b, c, a], &[u, v]).unwrap();
        assert_eq!(g.substitute(x[1], &[(d, a)]), direct[1]);
        let triangular = g.substitute(x[0], &[(b, g.zero())]);
        assert_eq!(triangular, g.div(u, a));
    }
}
