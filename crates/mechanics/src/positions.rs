//! The set of positions: the finite constraints as exact data of a zero test.

use crate::characteristics::Manifold;
use crate::sample;
use crate::selection::{eliminate, Selection};
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// Coordinates that finite constraints determine.
#[derive(Clone, Debug, Default)]
pub struct Positions {
    /// Coordinates as functions of the others, where a constraint is affine in them with a number as coefficient.
    pub solved: Vec<(Symbol, Expr)>,
    /// Further constraints, each with a coordinate that it determines, in an order in which each contains those of the former alone; then
    /// those that determine some jointly, and those that hold besides, with a coordinate that another one determines.
    pub implicit: Vec<(Expr, Symbol)>,
    /// Whether all finite constraints are among them. What is proved of more positions than there are is true of these; what is
    /// refuted need not be.
    pub is_whole: bool,
}

/// The set of positions of a system.
pub fn of(system: &System, terms: &MotionTerms, selection: &Selection) -> Positions {
    let g = &system.graph;
    let stated = terms
        .constraint_index
        .iter()
        .map(|&l| &system.constraints[l]);
    let finite = stated.enumerate().filter(|(_, c)| c.order == 0);
    let (mut rows, mut rest): (Vec<usize>, Vec<Expr>) =
        finite.map(|(row, c)| (row, c.stated)).unzip();
    let is_finite = rows.len() == terms.constraints.len();
    let mut found = Positions {
        is_whole: true,
        ..Positions::default()
    };
    let symbols = system.coordinate_symbols();
    while let Some((index, symbol, value)) = solvable(system, &rest, &symbols) {
        rest.remove(index);
        rows.remove(index);
        let pair = [(g.symbol_expr(symbol), value)];
        let put_in = g.substitute_all(&rest, &pair);
        let pairs = rows.into_iter().zip(put_in);
        (rows, rest) = pairs.filter(|(_, e)| !g.is_zero(*e)).unzip();
        for (_, e) in &mut found.solved {
            *e = g.substitute(*e, &pair);
        }
        found.solved.push((symbol, value));
    }
    // One constraint is always in order; several may be coupled.
    let mut used: Vec<Symbol> = Vec::new();
    while let Some((index, symbol)) = triangular(system, &rest, &symbols, &used) {
        used.push(symbol);
        rows.remove(index);
        found.implicit.push((rest.remove(index), symbol));
    }
    let free: Vec<Symbol> = symbols.into_iter().filter(|s| !used.contains(s)).collect();
    // Where all constraints are finite the selection is one of positions.
    let chosen = is_finite.then(|| selected(system, selection, &rows, &free));
    let chosen = chosen
        .flatten()
        .or_else(|| sampled(system, terms, &rest, &free));
    match chosen.and_then(|chosen| jointly(&chosen, &rest)) {
        Some(pairs) => found.implicit.extend(pairs),
        None => found.is_whole = rest.is_empty(),
    }
    found
}

/// Constraints that are coupled, with the coordinates that they determine jointly; those that are not chosen hold besides.
fn jointly(chosen: &[(usize, Symbol)], rest: &[Expr]) -> Option<Vec<(Expr, Symbol)>> {
    let (_, first) = *chosen.first()?;
    let own = chosen.iter().map(|&(place, symbol)| (rest[place], symbol));
    let is_chosen = |place: usize| chosen.iter().any(|&(own, _)| own == place);
    let others = (0..rest.len()).filter(|&place| !is_chosen(place));
    Some(
        own.chain(others.map(|place| (rest[place], first)))
            .collect(),
    )
}

/// The constraints of a selection with their coordinates; `None` where a coordinate is taken already.
fn selected(
    system: &System,
    selection: &Selection,
    rows: &[usize],
    free: &[Symbol],
) -> Option<Vec<(usize, Symbol)>> {
    let pairs = selection.rows.iter().zip(&selection.dependent);
    let own = pairs.filter_map(|(row, &j)| {
        let place = rows.iter().position(|r| r == row)?;
        Some((place, system.coordinates.get(j)?.q_symbol))
    });
    let own: Vec<(usize, Symbol)> = own.collect();
    own.iter().all(|(_, s)| free.contains(s)).then_some(own)
}

/// Constraints and coordinates of a largest minor of the gradients at a position of the set, coordinates first that do not stand in angles.
fn sampled(
    system: &System,
    terms: &MotionTerms,
    rest: &[Expr],
    free: &[Symbol],
) -> Option<Vec<(usize, Symbol)>> {
    if rest.is_empty() {
        return None;
    }
    let g = &system.graph;
    let point = sample::admissible_point(system, terms, sample::SEED)?;
    let gradient = g.jacobian(rest, free).concat();
    let values = g
        .evaluate_f64(&gradient, &|s| point.get(&s).copied())
        .ok()?;
    let cost = |e: &Expr| free.iter().map(|&s| turns(g, *e, s)).collect();
    let chosen = eliminate(values, rest.iter().map(cost).collect(), free.len());
    let pairs = chosen.rows.iter().zip(&chosen.dependent);
    Some(pairs.map(|(&place, &j)| (place, free[j])).collect())
}

/// 0 for a symbol in which an expression is a polynomial, 1 for one that stands in angles.
fn turns(g: &Graph, e: Expr, symbol: Symbol) -> usize {
    let own = [symbol];
    let stands_in = |e: Expr| match g.node(e) {
        Node::Apply { arguments, .. } => g.any_contains_any(arguments, &own),
        _ => false,
    };
    usize::from(g.reachable(&[e]).into_iter().any(stands_in))
}

/// A constraint that is affine in a coordinate with a number as coefficient, with the coordinate and its value.
fn solvable(system: &System, rest: &[Expr], symbols: &[Symbol]) -> Option<(usize, Symbol, Expr)> {
    let g = &system.graph;
    rest.iter().enumerate().find_map(|(index, &f)| {
        symbols.iter().find_map(|&symbol| {
            let coefficient = g.diff(f, symbol);
            if g.is_zero(coefficient) || g.as_number(coefficient).is_none() {
                return None;
            }
            let others = g.substitute(f, &[(g.symbol_expr(symbol), g.zero())]);
            Some((index, symbol, g.neg(g.div(others, coefficient))))
        })
    })
}

/// A constraint with a coordinate that no other one contains, so that it can come last; found from the last to the first it would be the
/// other way round, so constraints are taken whose other coordinates are free or used already.
fn triangular(
    system: &System,
    rest: &[Expr],
    symbols: &[Symbol],
    used: &[Symbol],
) -> Option<(usize, Symbol)> {
    let g = &system.graph;
    rest.iter().enumerate().find_map(|(index, &f)| {
        let others: Vec<Expr> = rest
            .iter()
            .enumerate()
            .filter(|(i, _)| *i != index)
            .map(|(_, e)| *e)
            .collect();
        let is_own = |symbol: &&Symbol| {
            let own = [**symbol];
            !used.contains(symbol) && g.contains_any(f, &own) && !g.any_contains_any(&others, &own)
        };
        let symbol = symbols.iter().find(is_own)?;
        Some((index, *symbol))
    })
}

impl Positions {
    /// The manifold of velocities over these positions.
    pub fn joined(&self, manifold: &Manifold) -> Manifold {
        Manifold {
            solved: [&self.solved[..], &manifold.solved].concat(),
            implicit: [&self.implicit[..], &manifold.implicit].concat(),
        }
    }

    /// Expressions with the coordinates that are solved for put in.
    pub fn put_in(&self, system: &System, es: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let pairs: Vec<(Expr, Expr)> = self
            .solved
            .iter()
            .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
            .collect();
        g.substitute_all(es, &pairs)
    }
}
