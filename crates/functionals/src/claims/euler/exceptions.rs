//! Values of parameters at which a factor vanishes that was divided by: what is claimed may hold there too.

use super::comparison::Comparison;
use crate::functional::{Functional, Parameter};
use crate::variation::variation;
use chetaev_symbolic::{Expr, Verdict};
use std::collections::BTreeSet;

/// Whether the claim holds also where a factor that was divided by vanishes: it is linear in a parameter, whose value is put in. Then only
/// what else is known not to vanish may be divided by.
pub(super) fn holds_at_zero(functional: &Functional, factor: Expr, known: &BTreeSet<Expr>) -> bool {
    let Some(special) = at_zero(functional, factor) else {
        return false;
    };
    let Ok(own) = variation(&special) else {
        return false;
    };
    let mut comparison = Comparison::new(&special, &own, &[], &[]);
    comparison.refutes = false;
    let is_proved = matches!(comparison.compared(), Verdict::Proved(_));
    let divided = comparison.nonzero.borrow();
    let mut others = divided.iter();
    is_proved && others.all(|other| *other != factor && known.contains(other))
}

/// The functional where a factor vanishes that is linear in the one parameter in it, with numbers.
fn at_zero(functional: &Functional, factor: Expr) -> Option<Functional> {
    let space = &*functional.space;
    let g = &space.graph;
    let symbols: Vec<_> = space.symbols_in(&[factor]).into_iter().collect();
    let &[symbol] = &symbols[..] else { return None };
    let is_parameter = |p: &Parameter| g.as_symbol(g.symbol(&p.name, 0)) == Some(symbol);
    if !functional.parameters.iter().any(is_parameter) {
        return None;
    }
    let one = g.one();
    let slope = space.derive(factor, &|s| (s == symbol).then_some(one));
    g.as_number(slope)?;
    let rest = g.substitute(factor, &[(g.symbol_expr(symbol), g.zero())]);
    let root = g.neg(g.div(rest, slope));
    g.as_number(root)?;
    let mut own = functional.clone();
    own.put(&|s| (s == symbol).then_some(root));
    Some(own)
}
