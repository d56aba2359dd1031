//! Particular values of parameters. The cases are distinguished for general ones: a factor that contains parameters alone is taken
//! not to vanish. Where one does, more motions may make the action stationary.

use super::{Found, Leaf, Search};
use crate::stationarity::closed_form::short;
use crate::stationarity::motion::Motion;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::factors::{coefficients, factored, factors};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};

/// At most so many particular values are looked at.
const VALUES: usize = 6;
/// Longer conditions on parameters are not looked at.
const LONGEST: u64 = 40;

/// What particular values of parameters change.
#[derive(Clone, Debug, Default)]
pub(crate) struct Special {
    /// Particular values, and the further sets of motions there.
    pub(crate) found: Vec<(Values, Vec<Leaf>)>,
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

/// A parameter and its particular value, then the parameters that are defined by it and what they are there.
pub(crate) type Values = Vec<(Expr, Expr)>;

/// What the values show at which functions of parameters vanish that are taken not to, by a search `at` each of them.
pub(super) fn special(
    cx: &Context<'_>,
    motion: &Motion,
    general: &Found,
    at: impl Fn(Values) -> Found,
) -> Special {
    let g = &cx.system.graph;
    let mut special = Special::default();
    if !general.open.is_empty() {
        // Nothing is said of all motions.
        return special;
    }
    let regular = general.regular.iter();
    let mut conditions: Vec<Condition> = regular.flat_map(|&e| by_definitions(cx, e)).collect();
    conditions.sort_by_key(|condition| simplify::length(g, condition.vanishing));
    let mut known: Vec<Values> = Vec::new();
    for (place, condition) in conditions.iter().enumerate() {
        let values = match solved(cx, motion, condition) {
            Solved::At(values) if place < VALUES => values,
            // There is no motion to speak of.
            Solved::Singular => continue,
            _ => {
                special.open = true;
                continue;
            }
        };
        if known.contains(&values) {
            continue;
        }
        let found = at(values.clone());
        special.open |= !found.open.is_empty();
        let (further, open) = beyond(cx, motion, general, found.leaves);
        special.open |= open;
        if !further.is_empty() {
            special.found.push((values.clone(), further));
        }
        known.push(values);
    }
    special
}

/// The sets that those for general parameters do not contain, and whether one of these may leave out a part of such a set.
fn beyond(
    cx: &Context<'_>,
    motion: &Motion,
    general: &Found,
    leaves: Vec<Leaf>,
) -> (Vec<Leaf>, bool) {
    let search = Search::new(cx, motion, true);
    let (mut further, mut open) = (Vec::new(), false);
    for leaf in leaves {
        let mut large = general.leaves.iter();
        match large.find(|large| search.contains(large, &leaf)) {
            // Where the larger set has states left out the smaller one may contain some of them.
            Some(large) => {
                let known = |e: &Expr| leaf.nonzero.contains(e);
                open |= !large.nonzero.iter().all(known);
            }
            None => further.push(leaf),
        }
    }
    (further, open)
}

/// Where a function of parameters vanishes.
enum Solved {
    At(Values),
    /// Where the equations do not determine the motion, as without any mass.
    Singular,
    /// The function was not solved, or the motion has a pole there.
    Open,
}

/// The value of a parameter at which a function of parameters vanishes, where the assumptions of the model allow it.
fn solved(cx: &Context<'_>, motion: &Motion, condition: &Condition) -> Solved {
    let g = &cx.system.graph;
    let Some(values) = values(cx, condition) else {
        return Solved::Open;
    };
    if singular(cx, motion, &values) {
        return Solved::Singular;
    }
    let is_regular = |e: Expr| {
        factored(g, e).is_some_and(|parts| {
            parts
                .factors
                .iter()
                .all(|&(factor, power)| power > 0 || !g.is_zero(at_values(cx, factor, &values)))
        })
    };
    match motion.functions().into_iter().all(is_regular) {
        true => Solved::At(values),
        false => Solved::Open,
    }
}

/// A function of parameters that may vanish.
struct Condition {
    vanishing: Expr,
    /// Whether the parameters that others define were replaced, and move with these.
    of_base: bool,
}

/// The factors of a function of parameters, by those that no others define.
fn by_definitions(cx: &Context<'_>, e: Expr) -> Vec<Condition> {
    let (system, g) = (cx.system, &cx.system.graph);
    let base = short(g, system.with_definitions(e));
    // What vanishes by the definitions alone is looked at as if there were none: verdicts are those of all values.
    if base == e || g.is_zero(base) {
        let (vanishing, of_base) = (e, false);
        return vec![Condition { vanishing, of_base }];
    }
    let is_known = |e: Expr| known_sign(g, e, &assumptions(system)).is_nonzero();
    let list = factors(g, base, &g.symbols_in(&[base])).unwrap_or_else(|| vec![(base, 1)]);
    let list = list.into_iter().filter(|&(factor, _)| !is_known(factor));
    list.map(|(vanishing, _)| Condition {
        vanishing,
        of_base: true,
    })
    .collect()
}

/// The value of a parameter at which a function of parameters vanishes, with those that it defines.
fn values(cx: &Context<'_>, condition: &Condition) -> Option<Values> {
    let (system, g) = (cx.system, &cx.system.graph);
    let vanishing = condition.vanishing;
    if simplify::length(g, vanishing) > LONGEST {
        return None;
    }
    let symbols = g.symbols_in(&[vanishing]);
    let (symbol, value) = symbols.iter().rev().find_map(|&s| {
        let list = coefficients(g, vanishing, s)?;
        let &[c, b] = list.as_slice() else {
            return None;
        };
        let known = known_sign(g, b, &assumptions(system));
        let value = simplify::simplify(g, g.neg(g.div(c, b)), &simplify::Options::default());
        known.is_nonzero().then_some((s, value))
    })?;
    let own = (g.symbol_expr(symbol), value);
    let mut all = vec![own];
    let definitions = system.definitions.iter().filter(|_| condition.of_base);
    for &(parameter, definition) in definitions {
        let definition = system.with_definitions(definition);
        if g.contains_any(definition, &[symbol]) {
            all.push((parameter, at_values(cx, definition, &[own])));
        }
    }
    Some(all)
}

/// Whether the equations of motion do not determine the accelerations at particular values of parameters: W bordered by J is
/// singular at all states.
fn singular(cx: &Context<'_>, motion: &Motion, values: &[(Expr, Expr)]) -> bool {
    let (system, g) = (cx.system, &cx.system.graph);
    let jacobian = basis(cx).jacobian();
    let border = jacobian.len();
    let velocities = system.velocity_symbols();
    let mass = g.jacobian(&g.gradient(system.lagrangian, &velocities), &velocities);
    let there = |e: Expr| at_values(cx, motion.on_states(g, e), values);
    let upper = mass.iter().enumerate().map(|(i, row)| {
        let reactions = jacobian.iter().map(|row| &row[i]);
        row.iter().chain(reactions).map(|&e| there(e)).collect()
    });
    let lower = jacobian.iter().map(|row| {
        let zeros = vec![g.zero(); border];
        row.iter().map(|&e| there(e)).chain(zeros).collect()
    });
    let matrix: Vec<Vec<Expr>> = upper.chain(lower).collect();
    let what = "the mass matrix bordered by the constraints";
    let verdict = cx
        .prover
        .nonsingular(system, &matrix, &Manifold::default(), what);
    matches!(verdict, Verdict::Refuted(_))
}

fn at_values(cx: &Context<'_>, e: Expr, at: &[(Expr, Expr)]) -> Expr {
    let g = &cx.system.graph;
    simplify::simplify(g, g.substitute(e, at), &simplify::Options::default())
}
