//! Replacing the symbols that a system determines exactly.

use rustc_hash::FxHashSet;

use super::assumptions::Assumptions;
use crate::graph::Graph;
use crate::node::{Expr, Symbol};

/// Replaces the solved symbols in `roots`, in an order in which each replacement is complete.
///
/// # Errors
/// A sentence when the solved symbols depend on each other in a circle.
pub(super) fn eliminate(
    graph: &Graph,
    solved: &[(Symbol, Expr)],
    roots: &[Expr],
) -> Result<Vec<Expr>, String> {
    let all: FxHashSet<Symbol> = solved.iter().map(|(symbol, _)| *symbol).collect();
    let mut rest: Vec<(Symbol, Expr, FxHashSet<Symbol>)> = solved
        .iter()
        .map(|(symbol, e)| {
            let used = graph
                .symbols_in(&[*e])
                .into_iter()
                .filter(|s| all.contains(s))
                .collect();
            (*symbol, *e, used)
        })
        .collect();
    let mut roots = roots.to_vec();
    while !rest.is_empty() {
        // Symbols that no other replacement uses are replaced first, all at once.
        let used: FxHashSet<Symbol> = rest
            .iter()
            .flat_map(|(_, _, used)| used.iter().copied())
            .collect();
        let (ready, later): (Vec<_>, Vec<_>) = rest
            .into_iter()
            .partition(|(symbol, ..)| !used.contains(symbol));
        if ready.is_empty() {
            return Err("the solved symbols depend on each other in a circle".to_owned());
        }
        let replacements: Vec<(Expr, Expr)> = ready
            .into_iter()
            .map(|(symbol, e, _)| (graph.symbol_expr(symbol), e))
            .collect();
        roots = graph.substitute_all(&roots, &replacements);
        rest = later;
    }
    Ok(roots)
}

/// A question after the elimination.
#[derive(Clone, Debug)]
pub(super) struct Eliminated {
    pub(super) roots: Vec<Expr>,
    /// Each contains, of the symbols that others determine, only those determined before it, where such an order exists.
    pub(super) implicit: Vec<(Expr, Symbol)>,
    pub(super) assumptions: Assumptions,
    /// What was replaced: the solved symbols, and those of affine constraints that stood in the way of an order.
    pub(super) solved: Vec<(Symbol, Expr)>,
}

/// Replaces the solved symbols in everything a question consists of.
pub(super) fn eliminate_all(
    graph: &Graph,
    solved: &[(Symbol, Expr)],
    roots: &[Expr],
    implicit: &[(Expr, Symbol)],
    assumptions: &Assumptions,
) -> Result<Eliminated, String> {
    let (mut solved, mut implicit) = (solved.to_vec(), implicit.to_vec());
    loop {
        let mut result = replaced(graph, solved.clone(), roots, &implicit, assumptions)?;
        let unordered = in_triangular_order(graph, &mut result.implicit);
        // What two constraints name is left to both of them.
        let named = |symbol: Symbol| result.implicit.iter().filter(|(_, s)| *s == symbol).count();
        let affine = (unordered..result.implicit.len())
            .filter(|&i| named(result.implicit[i].1) == 1)
            .find_map(|i| Some((i, affine_solution(graph, result.implicit[i])?)));
        let Some((index, solution)) = affine else {
            return Ok(result);
        };
        let (_, symbol) = result.implicit.remove(index);
        solved.push((symbol, solution));
        implicit = result.implicit;
    }
}

fn replaced(
    graph: &Graph,
    solved: Vec<(Symbol, Expr)>,
    roots: &[Expr],
    implicit: &[(Expr, Symbol)],
    assumptions: &Assumptions,
) -> Result<Eliminated, String> {
    let mut everything = roots.to_vec();
    everything.extend(implicit.iter().map(|(f, _)| *f));
    everything.extend(assumptions.list().iter().flat_map(|a| [a.left, a.right]));
    let mut everything = eliminate(graph, &solved, &everything)?.into_iter();
    let roots = everything.by_ref().take(roots.len()).collect();
    let constraints: Vec<Expr> = everything.by_ref().take(implicit.len()).collect();
    let implicit = constraints
        .into_iter()
        .zip(implicit)
        .map(|(f, (_, symbol))| (f, *symbol))
        .collect();
    let mut kept = Assumptions::new();
    for assumption in assumptions.list() {
        if let (Some(left), Some(right)) = (everything.next(), everything.next()) {
            kept.assume(left, assumption.relation, right);
        }
    }
    Ok(Eliminated {
        roots,
        implicit,
        assumptions: kept,
        solved,
    })
}

/// Puts first the constraints that contain, of the symbols that others determine, only those determined before; returns how
/// many could be ordered so.
fn in_triangular_order(graph: &Graph, implicit: &mut Vec<(Expr, Symbol)>) -> usize {
    let mut rest = std::mem::take(implicit);
    while let Some(next) = (0..rest.len()).find(|&i| {
        let others: Vec<Symbol> = (0..rest.len())
            .filter(|&j| j != i)
            .map(|j| rest[j].1)
            .collect();
        !graph.contains_any(rest[i].0, &others)
    }) {
        implicit.push(rest.remove(next));
    }
    let ordered = implicit.len();
    implicit.extend(rest);
    ordered
}

/// The symbol of an affine constraint by the others, where its coefficient is not zero.
fn affine_solution(graph: &Graph, (f, symbol): (Expr, Symbol)) -> Option<Expr> {
    let coefficient = graph.diff(f, symbol);
    if graph.is_zero(coefficient) || graph.contains_any(coefficient, &[symbol]) {
        return None;
    }
    let rest = graph.substitute(f, &[(graph.symbol_expr(symbol), graph.zero())]);
    Some(graph.neg(graph.div(rest, coefficient)))
}
