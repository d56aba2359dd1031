//! Display simplification: the same value, written as a textbook prints it.
//!
//! Candidates are made from the exact [normal form](crate::polynomial::normal_form): common factors cancelled and
//! pulled out, `sin² + cos²` used in whichever direction is shorter, small linear solves in closed form, tangents kept
//! where the user wrote them. The shortest candidate by [`length`] wins, the input among them, so the result is never
//! longer than the input, unless it replaces a linear solve; where the budget does not suffice, the input is returned.
//! No sign is ever assumed.
//!
//! Every rewriting used is an identity of the normal form's field: the result equals the input wherever both are
//! defined.

mod arrange;
mod collect;
mod contract;
mod direction;
mod local;
mod measure;
mod polynomial_view;
mod quotients;
mod roots;
mod squares;

use rustc_hash::FxHashMap;

use crate::polynomial::normal_form::{normal_forms, Field, Options as Reading};
use crate::polynomial::{Budget, RationalFunction};
use crate::substitute::SolveCache;
use crate::{Expr, Function, Graph, Node};
use arrange::Arranger;

pub use collect::{collect, collect_all};
use local::{shorten, shorten_systems};
use measure::written_length;
pub use measure::{length, Lengths};
pub use polynomial_view::{
    homogeneity, homogeneous_parts, linear_form, HomogeneousPart, LinearForm,
};
pub use quotients::{as_quotient, by_quotients};
pub use squares::by_square;

/// What a simplification may spend and produce.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Options {
    /// Limits of the polynomials and of the work, for each call.
    pub budget: Budget,
    /// Expressions with more nodes than this are returned as they are.
    pub max_nodes: usize,
    /// Largest order of a linear solve to be worked out in closed form; 0 for none.
    pub max_solve: usize,
    /// Longest closed form of a linear solve, by [`length`]; what would be longer stays a solve.
    pub max_closed_form: u64,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            budget: Budget::DISPLAY,
            max_nodes: 2_000,
            max_solve: 8,
            max_closed_form: 240,
        }
    }
}

/// The expression as a textbook would print it; never longer than the input by [`length`], unless the input contains
/// linear solves that have a closed form within [`Options::max_closed_form`].
///
/// ```
/// use chetaev_symbolic::simplify::{simplify, Options};
/// use chetaev_symbolic::Graph;
/// let g = Graph::new();
/// let (m, x) = (g.symbol("m", 0), g.symbol("x", 0));
/// let squares = g.add(&[g.powi(g.sin(x), 2), g.powi(g.cos(x), 2)]);
/// assert_eq!(simplify(&g, g.mul(&[m, squares]), &Options::default()), m);
/// ```
pub fn simplify(g: &Graph, e: Expr, options: &Options) -> Expr {
    if let Some(known) = g.known_simplified(e, options) {
        return known;
    }
    let simple = simplify_all(g, &[e], options).pop().unwrap_or(e);
    g.keep_simplified(e, options, simple);
    simple
}

/// [`simplify`] for several expressions, which share the work on common solves.
pub fn simplify_all(g: &Graph, es: &[Expr], options: &Options) -> Vec<Expr> {
    if is_too_large(g, es, options) {
        // Together too large; perhaps not each by itself.
        let stated = shorten(g, &shorten_systems(g, es, options));
        return match es {
            [_] | [] => stated,
            _ => es
                .iter()
                .zip(stated)
                .map(|(&e, stated)| match is_too_large(g, &[e], options) {
                    true => stated,
                    false => simplify(g, e, options),
                })
                .collect(),
        };
    }
    let inner = simplify_arguments(g, es, options);
    let mut best: Vec<Expr> = es.to_vec();
    let mut offer = |candidates: Option<Vec<Option<Expr>>>, ties: bool| {
        for (place, candidate) in best.iter_mut().zip(candidates.unwrap_or_default()) {
            if let Some(candidate) = candidate {
                *place = better(g, *place, candidate, ties, options);
            }
        }
    };
    offer(Some(inner.iter().map(|&e| Some(e)).collect()), false);
    let found = Found::in_expressions(g, &inner);
    let literal = Reading::display(options.budget);
    // At equal length the arranged form is preferred to an accidental one.
    offer(read_each(g, &inner, &literal), true);
    let expand_solves = found.largest_solve > 0 && found.largest_solve <= options.max_solve;
    if expand_solves {
        offer(
            read(
                g,
                &inner,
                &Reading {
                    expand_solves,
                    ..literal.clone()
                },
            ),
            false,
        );
    }
    for base_angles in orders_of_angles(g, &found.angles, &literal) {
        let reading = Reading {
            expand_solves,
            expand_angles: true,
            base_angles,
            ..literal.clone()
        };
        offer(read(g, &inner, &reading), false);
    }
    for place in &mut best {
        for candidate in roots::over_roots(g, *place, options) {
            *place = better(g, *place, candidate, false, options);
        }
    }
    if found.largest_solve > 0 {
        best = shorten_systems(g, &best, options);
    }
    best
}

fn is_too_large(g: &Graph, es: &[Expr], options: &Options) -> bool {
    g.reachable(es).len() > options.max_nodes || is_hopeless(g, es)
}

/// The simplified expression without linear solves; `None` when a closed form would be longer than
/// [`Options::max_closed_form`] or beyond the budget, so that the solve is better stated as the system it is.
pub fn closed_form(g: &Graph, e: Expr, options: &Options) -> Option<Expr> {
    let simple = simplify(g, e, options);
    (!contains_solve(g, simple)).then_some(simple)
}

/// Substitutes (solved dependent velocities, say) and simplifies.
pub fn eliminate(g: &Graph, e: Expr, solved: &[(Expr, Expr)], options: &Options) -> Expr {
    simplify(g, g.substitute(e, solved), options)
}

/// The shorter of two; a closed form replaces a solve whenever it is short enough, since a solve takes several lines to
/// state. `ties` says whether the new one wins at equal length.
fn better(g: &Graph, old: Expr, new: Expr, ties: bool, options: &Options) -> Expr {
    let (old_length, new_length) = (written_length(g, old), written_length(g, new));
    let takes_new = if contains_solve(g, old) && !contains_solve(g, new) {
        new_length <= options.max_closed_form
    } else {
        new_length < old_length || (ties && new_length == old_length)
    };
    if takes_new {
        new
    } else {
        old
    }
}

/// A tree so much larger than its graph that no rewriting makes it legible; it is printed with names for its parts.
fn is_hopeless(g: &Graph, es: &[Expr]) -> bool {
    const MOST_SIGNS: u64 = 1_000_000;
    let mut lengths = measure::Lengths::written();
    es.iter().any(|&e| lengths.of(g, e) > MOST_SIGNS)
}

fn contains_solve(g: &Graph, e: Expr) -> bool {
    g.reachable(&[e])
        .into_iter()
        .any(|n| matches!(g.node(n), Node::Solve { .. }))
}

/// What the expressions contain that can be read in more than one way.
struct Found {
    largest_solve: usize,
    /// Different arguments of circular functions, in canonical order.
    angles: Vec<Expr>,
}

impl Found {
    fn in_expressions(g: &Graph, es: &[Expr]) -> Found {
        let mut found = Found {
            largest_solve: 0,
            angles: Vec::new(),
        };
        for e in g.reachable(es) {
            match g.node(e) {
                Node::Solve { rhs, .. } => found.largest_solve = found.largest_solve.max(rhs.len()),
                Node::Apply {
                    function,
                    arguments,
                } if is_circular(*function) => found.angles.push(arguments[0]),
                _ => {}
            }
        }
        // Single symbols first, then by structure: the order must not depend on how the graph came about.
        found.add_parts_of_angles(g);
        let key = |e: Expr| {
            g.as_symbol(e)
                .map_or((1, String::new()), |s| (0, g.symbol_text(s)))
        };
        found
            .angles
            .sort_by(|&a, &b| key(a).cmp(&key(b)).then_with(|| g.compare(a, b)));
        found.angles.dedup();
        found
    }
}

impl Found {
    /// Symbols that occur in sums of angles are angles worth expanding in, even where they do not occur alone.
    fn add_parts_of_angles(&mut self, g: &Graph) {
        let mut distinct = self.angles.clone();
        distinct.sort_unstable();
        distinct.dedup();
        if distinct.len() < 2 {
            return;
        }
        for angle in distinct {
            if let Node::Sum { terms, .. } = g.node(angle) {
                self.angles.extend(
                    terms
                        .iter()
                        .map(|(term, _)| *term)
                        .filter(|&t| g.as_symbol(t).is_some()),
                );
            }
        }
    }
}

/// Orders of base angles to try for expansion by the addition theorems; none when no angle is a combination of others.
fn orders_of_angles(g: &Graph, angles: &[Expr], literal: &Reading) -> Vec<Vec<Expr>> {
    const MOST_ANGLES: usize = 6;
    if angles.len() < 2 || angles.len() > MOST_ANGLES {
        return Vec::new();
    }
    let reading = Reading {
        expand_angles: true,
        base_angles: angles.to_vec(),
        ..literal.clone()
    };
    let dependent = normal_forms(g, &[], &reading)
        .is_ok_and(|(field, _)| field.base_angle_count() < angles.len());
    if !dependent {
        return Vec::new();
    }
    let rotated = |k: usize| [&angles[k..], &angles[..k]].concat();
    (0..angles.len()).map(rotated).collect()
}

fn is_circular(function: Function) -> bool {
    use Function::*;
    matches!(function, Sin | Cos | Tan | Cot | Sec | Csc)
}

/// The best arrangement of each expression under one reading; `None` when the reading exceeds the budget.
fn read(g: &Graph, es: &[Expr], reading: &Reading) -> Option<Vec<Option<Expr>>> {
    let (fields, values) = Fields::read(g, es, reading)?;
    if fields.plain.divides_angles() {
        return None;
    }
    let arrangers = Arrangers::new(&fields, Written::of(g, es));
    Some(
        values
            .iter()
            .map(|value| arrangers.fraction(value))
            .collect(),
    )
}

/// The same field twice, so that addition theorems have a budget of their own and cannot make anything worse.
pub(crate) struct Fields<'g> {
    plain: Field<'g>,
    contracting: Option<Field<'g>>,
}

impl<'g> Fields<'g> {
    fn read(
        g: &'g Graph,
        es: &[Expr],
        reading: &Reading,
    ) -> Option<(Fields<'g>, Vec<RationalFunction>)> {
        let (plain, values) = normal_forms(g, es, reading).ok()?;
        let contracting = if plain.base_angle_count() > 1 {
            normal_forms(g, es, reading).ok().map(|(field, _)| field)
        } else {
            None
        };
        Some((Fields { plain, contracting }, values))
    }

    /// With one budget for both, where reading is the greater part of the work.
    fn read_once(
        g: &'g Graph,
        e: Expr,
        reading: &Reading,
    ) -> Option<(Fields<'g>, Vec<RationalFunction>)> {
        let (plain, values) = normal_forms(g, &[e], reading).ok()?;
        let contracting = (plain.base_angle_count() > 1).then(|| plain.clone());
        Some((Fields { plain, contracting }, values))
    }
}

/// Arrangements with and without addition theorems; the shorter one is taken.
struct Arrangers<'a, 'g> {
    g: &'g Graph,
    plain: Option<Arranger<'a, 'g>>,
    contracting: Option<Arranger<'a, 'g>>,
}

impl<'a, 'g> Arrangers<'a, 'g> {
    fn new(fields: &'a Fields<'g>, written: Written) -> Arrangers<'a, 'g> {
        let contracting = fields.contracting.as_ref();
        Arrangers {
            g: fields.plain.graph(),
            plain: Some(Arranger::new(&fields.plain, written)),
            contracting: contracting.map(|field| Arranger::contracting(field, written)),
        }
    }

    /// One way only, where the expressions are large.
    fn quick(fields: &'a Fields<'g>, written: Written) -> Arrangers<'a, 'g> {
        let both = Arrangers::new(fields, written);
        Arrangers {
            plain: both.plain.filter(|_| both.contracting.is_none()),
            ..both
        }
    }

    fn fraction(&self, f: &RationalFunction) -> Option<Expr> {
        self.fraction_times(f, self.g.one())
    }

    fn fraction_times(&self, f: &RationalFunction, factor: Expr) -> Option<Expr> {
        let ways = [&self.plain, &self.contracting];
        let arranged = ways
            .into_iter()
            .flatten()
            .filter_map(|arranger| arranger.fraction_times(f, factor));
        arranged.min_by_key(|&e| written_length(self.g, e))
    }
}

/// [`read`], one by one where all together exceed the budget.
fn read_each(g: &Graph, es: &[Expr], reading: &Reading) -> Option<Vec<Option<Expr>>> {
    let together = read(g, es, reading);
    if together.is_some() || es.len() < 2 {
        return together;
    }
    Some(es.iter().map(|&e| read(g, &[e], reading)?.pop()?).collect())
}

/// Which of the derived circular functions the user wrote; only these are offered.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Written {
    tangent: bool,
    secant: bool,
}

impl Written {
    pub(crate) fn of(g: &Graph, es: &[Expr]) -> Written {
        let mut written = Written::default();
        for e in g.reachable(es) {
            match g.node(e) {
                Node::Apply {
                    function: Function::Tan | Function::Cot,
                    ..
                } => written.tangent = true,
                Node::Apply {
                    function: Function::Sec | Function::Csc,
                    ..
                } => written.secant = true,
                _ => {}
            }
        }
        written
    }
}

/// Arguments of functions with more signs than these are left alone.
const LONGEST_ARGUMENT: u64 = 2_000;

/// The same expressions with simplified arguments of functions and bases of roots, innermost first.
fn simplify_arguments(g: &Graph, es: &[Expr], options: &Options) -> Vec<Expr> {
    let mut image: FxHashMap<Expr, Expr> = FxHashMap::default();
    let mut solved = SolveCache::default();
    let mut lengths = measure::Lengths::written();
    for e in g.reachable(es) {
        let mut rebuilt = g.rebuild(e, &mut |c| image.get(&c).copied().unwrap_or(c), &mut solved);
        let inner = match g.node(rebuilt) {
            Node::Apply { arguments, .. } => arguments.first().copied(),
            Node::Power { base, exponent } if g.as_integer(*exponent).is_none() => Some(*base),
            _ => None,
        };
        let short = |&i: &Expr| is_compound(g, i) && lengths.of(g, i) <= LONGEST_ARGUMENT;
        if let Some(inner) = inner.filter(short) {
            let simple = simplify_flat(g, inner, options);
            if simple != inner {
                rebuilt = replace_argument(g, rebuilt, simple);
            }
        }
        rebuilt = roots::outside_root(g, rebuilt);
        if rebuilt != e {
            image.insert(e, rebuilt);
        }
    }
    es.iter()
        .map(|e| image.get(e).copied().unwrap_or(*e))
        .collect()
}

fn is_compound(g: &Graph, e: Expr) -> bool {
    matches!(g.node(e), Node::Sum { .. } | Node::Product { .. })
}

fn replace_argument(g: &Graph, e: Expr, argument: Expr) -> Expr {
    match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } if arguments.len() == 1 => g.apply(*function, &[argument]),
        Node::Power { exponent, .. } => g.pow(argument, *exponent),
        _ => e,
    }
}

/// One literal reading; arguments inside have been simplified before.
fn simplify_flat(g: &Graph, e: Expr, options: &Options) -> Expr {
    let literal = Reading::display(options.budget);
    match read(g, &[e], &literal).and_then(|mut c| c.pop()).flatten() {
        Some(candidate) if written_length(g, candidate) < written_length(g, e) => candidate,
        _ => e,
    }
}

/// The shortest arrangement of a value of a field, for other modules of the crate.
pub(crate) fn arranged(
    field: &Field<'_>,
    written: Written,
    value: &RationalFunction,
) -> Option<Expr> {
    Arranger::new(field, written).fraction(value)
}

#[cfg(test)]
mod tests;
