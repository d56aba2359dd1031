//! Constraints with roots, solved jointly: where the radicands depend on few linear combinations of the velocities, those
//! combinations are the free data, and the constraints are affine in the rest.
//!
//! Let Q be the radicands, polynomials of degree two in the symbols v, and N(q) a basis of the directions along which no
//! Q changes, with the symbols y among v as coordinates of these directions. Then v = w + N y with w_y = 0 is a linear
//! change of the symbols, Q(v) = Q(w), and constraints that are affine beside their roots become A(w) y = b(w). Every
//! point of the constraints outside of det A = 0 has exactly one such w, and every w gives one point: the residuals vanish
//! on the constraints if and only if they vanish as functions of w.

use super::assumptions::Assumptions;
use super::eliminate::eliminate;
use crate::graph::Graph;
use crate::matrix::null_space;
use crate::node::{Expr, Node, Symbol};

/// The residuals as functions of the free data w, which keep the names of the symbols v; `None` where the constraints are
/// not of this form.
pub(super) fn straightened(
    graph: &Graph,
    residuals: &[Expr],
    implicit: &[(Expr, Symbol)],
    solved: &[(Symbol, Expr)],
    assumptions: &Assumptions,
) -> Option<Vec<Expr>> {
    if implicit.is_empty() {
        return None;
    }
    let mut all = residuals.to_vec();
    all.extend(implicit.iter().map(|(f, _)| *f));
    let all = eliminate(graph, solved, &all).ok()?;
    let (residuals, constraints) = all.split_at(residuals.len());
    let symbols = columns(graph, constraints, implicit);
    let stated = assumptions.list().iter().flat_map(|a| [a.left, a.right]);
    // What is assumed of v does not hold for w.
    if graph.any_contains_any(&stated.collect::<Vec<Expr>>(), &symbols) {
        return None;
    }
    let radicands = radicands(graph, &all, &symbols);
    let dependent: Vec<Symbol> = implicit.iter().map(|(_, symbol)| *symbol).collect();
    // Otherwise each constraint can be solved for its own symbol.
    if !graph.any_contains_any(&radicands, &dependent) {
        return None;
    }
    let directions = unchanging(graph, &radicands, &symbols)?;
    let used = directions.len().checked_sub(implicit.len())?;
    let change = Change {
        graph,
        symbols: &symbols,
        radicands: &radicands,
        directions: &directions[used..],
    };
    change.solve(constraints, residuals)
}

/// The symbols of the order of the dependent ones, these last.
fn columns(graph: &Graph, constraints: &[Expr], implicit: &[(Expr, Symbol)]) -> Vec<Symbol> {
    let is_dependent = |s: Symbol| implicit.iter().any(|(_, symbol)| *symbol == s);
    let orders: Vec<u32> = implicit
        .iter()
        .map(|(_, symbol)| graph.symbol_order(*symbol))
        .collect();
    let mut symbols = graph.symbols_in(constraints);
    symbols.retain(|&s| orders.contains(&graph.symbol_order(s)));
    symbols.sort_by_key(|&s| is_dependent(s));
    symbols
}

/// The bases of fractional powers that contain one of the symbols.
fn radicands(graph: &Graph, es: &[Expr], symbols: &[Symbol]) -> Vec<Expr> {
    let mut found = Vec::new();
    for e in graph.reachable(es) {
        if let Node::Power { base, exponent } = graph.node(e) {
            let is_root = graph.as_number(*exponent).is_some_and(|r| !r.is_int());
            if is_root && graph.contains_any(*base, symbols) && !found.contains(base) {
                found.push(*base);
            }
        }
    }
    found
}

/// Directions along which no radicand changes, each with a one at its own symbol, where the others have zero, those of late
/// symbols last; `None` where a radicand has not degree two or the kernel is not found.
fn unchanging(graph: &Graph, radicands: &[Expr], symbols: &[Symbol]) -> Option<Vec<Vec<Expr>>> {
    let at_zero: Vec<(Expr, Expr)> = symbols
        .iter()
        .map(|&s| (graph.symbol_expr(s), graph.zero()))
        .collect();
    let mut rows = Vec::new();
    for &radicand in radicands {
        let gradient = graph.gradient(radicand, symbols);
        let second = graph.jacobian(&gradient, symbols);
        if graph.any_contains_any(&second.concat(), symbols) {
            return None;
        }
        rows.push(graph.substitute_all(&gradient, &at_zero));
        rows.extend(second);
    }
    rows.retain(|row| row.iter().any(|&e| !graph.is_zero(e)));
    null_space(graph, &rows, symbols.len()).ok()
}

struct Change<'a> {
    graph: &'a Graph,
    symbols: &'a [Symbol],
    radicands: &'a [Expr],
    /// Columns of N.
    directions: &'a [Vec<Expr>],
}

impl Change<'_> {
    /// The residuals at the point of the constraints over w.
    fn solve(&self, constraints: &[Expr], residuals: &[Expr]) -> Option<Vec<Expr>> {
        let g = self.graph;
        let y = self.own_symbols()?;
        // The symbols y stand for themselves in the constraints until they are solved for.
        let unknown: Vec<Expr> = y.iter().map(|&s| g.symbol_expr(s)).collect();
        let f = g.substitute_all(constraints, &self.pairs(&y, &unknown));
        let matrix = g.jacobian(&f, &y).concat();
        if g.any_contains_any(&matrix, &y) {
            return None;
        }
        let at_zero: Vec<(Expr, Expr)> = unknown.iter().map(|&e| (e, g.zero())).collect();
        let rest = g.substitute_all(&f, &at_zero);
        let right: Vec<Expr> = rest.into_iter().map(|e| g.neg(e)).collect();
        let values = g.solve(&matrix, &right).ok()?;
        Some(g.substitute_all(residuals, &self.pairs(&y, &values)))
    }

    /// The symbol of each direction: the last one whose component is one where all other directions have zero.
    fn own_symbols(&self) -> Option<Vec<Symbol>> {
        let g = self.graph;
        let own = |number: usize| {
            (0..self.symbols.len()).rev().find(|&i| {
                let entries = self.directions.iter().enumerate();
                entries.into_iter().all(|(other, direction)| {
                    let wanted = if other == number { g.one() } else { g.zero() };
                    direction[i] == wanted
                })
            })
        };
        (0..self.directions.len())
            .map(|number| own(number).map(|i| self.symbols[i]))
            .collect()
    }

    /// What replaces the symbols, v = w + N y, and the radicands, which are those at w.
    fn pairs(&self, y: &[Symbol], values: &[Expr]) -> Vec<(Expr, Expr)> {
        let g = self.graph;
        let without: Vec<(Expr, Expr)> = y.iter().map(|&s| (g.symbol_expr(s), g.zero())).collect();
        let fixed = g.substitute_all(self.radicands, &without);
        let mut pairs: Vec<(Expr, Expr)> = self.radicands.iter().copied().zip(fixed).collect();
        for (i, &symbol) in self.symbols.iter().enumerate() {
            let mut parts = Vec::new();
            if !y.contains(&symbol) {
                parts.push(g.symbol_expr(symbol));
            }
            for (direction, &value) in self.directions.iter().zip(values) {
                parts.push(g.mul(&[direction[i], value]));
            }
            pairs.push((g.symbol_expr(symbol), g.add(&parts)));
        }
        pairs
    }
}
