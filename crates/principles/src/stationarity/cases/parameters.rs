//! Particular values of parameters. The cases are distinguished for general ones: a factor that contains parameters alone is taken
//! not to vanish. Where one does, more motions may make the action stationary.

use super::{Found, Leaf, Search};
use crate::stationarity::motion::Motion;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::{coefficients, factored, factors};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Symbol};

/// At most so many particular values are looked at.
const VALUES: usize = 6;
/// Longer conditions on parameters are not looked at.
const LONGEST: u64 = 40;

/// What particular values of parameters change.
#[derive(Clone, Debug, Default)]
pub(crate) struct Special {
    /// A parameter with its particular value, and the further sets of motions there.
    pub(crate) found: Vec<((Expr, Expr), Vec<Leaf>)>,
    /// Whether there are others of which it is not known.
    pub(crate) open: bool,
}

impl Search<'_, '_> {
    /// Keeps in mind the factors of parameters alone of what is taken not to vanish for general parameters.
    pub(super) fn take_as_regular(&self, e: Expr) {
        let g = self.g;
        let mut parameters = g.symbols_in(&[e]);
        let time = g.intern_symbol("t", 0);
        // A control is no parameter: it takes its values at single times.
        let system = self.cx.system;
        let moves =
            |s: Symbol| self.state.contains(&s) || s == time || system.prescribed_rate(s).is_some();
        let (moving, fixed): (Vec<Symbol>, Vec<Symbol>) =
            parameters.into_iter().partition(|&s| moves(s));
        parameters = fixed;
        if parameters.is_empty() {
            return;
        }
        let list = factors(g, e, &parameters).unwrap_or_default();
        let mut regular = self.regular.borrow_mut();
        for (factor, _) in list {
            let is_known = known_sign(g, factor, &assumptions(self.cx.system)).is_nonzero();
            if !g.contains_any(factor, &moving) && !is_known && !regular.contains(&factor) {
                regular.push(factor);
            }
        }
    }
}

/// What the values show at which functions of parameters vanish that are taken not to, by a search `at` each of them.
pub(super) fn special(
    cx: &Context<'_>,
    motion: &Motion,
    general: &Found,
    at: impl Fn((Expr, Expr)) -> Found,
) -> Special {
    let g = &cx.system.graph;
    let mut special = Special::default();
    if !general.open.is_empty() {
        // Nothing is said of all motions.
        return special;
    }
    let mut conditions = general.regular.clone();
    conditions.sort_by_key(|&e| simplify::length(g, e));
    for (place, &condition) in conditions.iter().enumerate() {
        let value = solved(cx, motion, condition).filter(|_| place < VALUES);
        let Some(value) = value else {
            special.open = true;
            continue;
        };
        let found = at(value);
        special.open |= !found.open.is_empty();
        let search = Search::new(cx, motion, true);
        let mut further = Vec::new();
        for leaf in found.leaves {
            let mut large = general.leaves.iter();
            match large.find(|large| search.contains(large, &leaf)) {
                // Where the larger set has states left out the smaller one may contain some of them.
                Some(large) => {
                    let known = |e: &Expr| leaf.nonzero.contains(e);
                    special.open |= !large.nonzero.iter().all(known);
                }
                None => further.push(leaf),
            }
        }
        if !further.is_empty() {
            special.found.push((value, further));
        }
    }
    special
}

/// The value of a parameter at which a function of parameters vanishes, where the assumptions of the model allow it and the
/// motion has no pole there.
fn solved(cx: &Context<'_>, motion: &Motion, condition: Expr) -> Option<(Expr, Expr)> {
    let g = &cx.system.graph;
    if simplify::length(g, condition) > LONGEST {
        return None;
    }
    let symbols = g.symbols_in(&[condition]);
    let (symbol, value) = symbols.iter().rev().find_map(|&s| {
        let list = coefficients(g, condition, s)?;
        let &[c, b] = list.as_slice() else {
            return None;
        };
        let known = known_sign(g, b, &assumptions(cx.system));
        let value = simplify::simplify(g, g.neg(g.div(c, b)), &simplify::Options::default());
        known.is_nonzero().then_some((g.symbol_expr(s), value))
    })?;
    let is_regular = |e: Expr| {
        factored(g, e).is_some_and(|parts| {
            parts.factors.iter().all(|&(factor, power)| {
                power > 0 || !g.is_zero(at_value(cx, factor, (symbol, value)))
            })
        })
    };
    motion
        .functions()
        .into_iter()
        .all(is_regular)
        .then_some((symbol, value))
}

fn at_value(cx: &Context<'_>, e: Expr, at: (Expr, Expr)) -> Expr {
    let g = &cx.system.graph;
    simplify::simplify(g, g.substitute(e, &[at]), &simplify::Options::default())
}
