//! Values of parameters at which a factor vanishes that was divided by: what is claimed may hold there too.

use super::comparison::Comparison;
use crate::functional::Functional;
use crate::variation::variation;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::collections::BTreeSet;

/// Whether the claim holds also where a factor vanishes that was divided by: it is linear in a parameter, whose value is put in. Then only
/// what does not vanish because `known` do not may be divided by.
pub(super) fn holds_at_zero(functional: &Functional, factor: Expr, known: &BTreeSet<Expr>) -> bool {
    let Some(Zero { symbol, root }) = zero(functional, factor) else {
        return false;
    };
    let mut special = functional.clone();
    special.put(&|s| (s == symbol).then_some(root));
    let Ok(own) = variation(&special) else {
        return false;
    };
    let mut comparison = Comparison::new(&special, &own, &[], &[]);
    comparison.refutes = false;
    if !matches!(comparison.compared(), Verdict::Proved(_)) {
        return false;
    }
    let g = &functional.space.graph;
    let at_root = |e: &Expr| g.substitute(*e, &[(g.symbol_expr(symbol), root)]);
    let known: Vec<Expr> = known.iter().map(at_root).collect();
    let divided = comparison.nonzero.borrow();
    let mut divided = divided.iter();
    divided.all(|&other| known.iter().any(|&e| is_factor(functional, other, e)))
}

/// Whether one expression is a factor of another, so that it does not vanish where that does not.
fn is_factor(functional: &Functional, one: Expr, of: Expr) -> bool {
    let space = &*functional.space;
    let g = &space.graph;
    let symbols: Vec<Symbol> = space.symbols_in(&[of]).into_iter().collect();
    let factors = factors(g, of, &symbols).unwrap_or_else(|| vec![(of, 1)]);
    let mut factors = factors.into_iter();
    factors.any(|(own, _)| {
        let ratio = g.div(one, own);
        let is_number = g.as_number(ratio).is_some();
        is_number || space.vanish(&[g.sub(one, own)]) || space.vanish(&[g.add(&[one, own])])
    })
}

/// A value of a parameter.
struct Zero {
    symbol: Symbol,
    root: Expr,
}

/// The value of a parameter at which a factor vanishes that is linear in it, with a number before it.
fn zero(functional: &Functional, factor: Expr) -> Option<Zero> {
    let space = &*functional.space;
    let g = &space.graph;
    let is_parameter = |symbol: Symbol| {
        let mut own = functional.parameters.iter();
        own.any(|p| g.as_symbol(g.symbol(&p.name, 0)) == Some(symbol))
    };
    let one = g.one();
    let mut symbols = space.symbols_in(&[factor]).into_iter();
    symbols.find_map(|symbol| {
        let slope = space.derive(factor, &|s| (s == symbol).then_some(one));
        if !is_parameter(symbol) || g.as_number(slope).is_none_or(|n| n.is_zero()) {
            return None;
        }
        let rest = g.substitute(factor, &[(g.symbol_expr(symbol), g.zero())]);
        let root = g.neg(g.div(rest, slope));
        Some(Zero { symbol, root })
    })
}
