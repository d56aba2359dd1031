//! Display simplification: the same value, written as a textbook prints it.
//!
//! Candidates are made from the exact [normal form](crate::polynomial::normal_form): common factors cancelled and
//! pulled out, `sin² + cos²` used in whichever direction is shorter, small linear solves in closed form, tangents kept
//! where the user wrote them. The shortest candidate by [`length`] wins, the input among them, so the result is never
//! longer than the input; where the budget does not suffice, the input is returned. No sign is ever assumed.
//!
//! Every rewriting used is an identity of the normal form's field: the result equals the input wherever both are
//! defined.

mod arrange;
mod collect;
mod direction;
mod measure;
mod polynomial_view;

use rustc_hash::FxHashMap;

use crate::polynomial::normal_form::{self, normal_forms, Field};
use crate::polynomial::{Budget, RationalFunction};
use crate::substitute::SolveCache;
use crate::{Expr, Function, Graph, Node};
use arrange::Arranger;

pub use collect::{collect, collect_all};
pub use measure::length;
pub use polynomial_view::{
    homogeneity, homogeneous_parts, linear_form, HomogeneousPart, LinearForm,
};

/// What a simplification may spend and produce.
#[derive(Clone, Debug)]
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

/// The expression as a textbook would print it; never longer than the input by [`length`].
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
    simplify_all(g, &[e], options).pop().unwrap_or(e)
}

/// [`simplify`] for several expressions, which share the work on common solves.
pub fn simplify_all(g: &Graph, es: &[Expr], options: &Options) -> Vec<Expr> {
    if g.reachable(es).len() > options.max_nodes {
        return match es {
            [_] | [] => es.to_vec(),
            // Together too large; perhaps not each by itself.
            _ => es.iter().map(|&e| simplify(g, e, options)).collect(),
        };
    }
    let inner = simplify_arguments(g, es, options);
    let mut best: Vec<Expr> = es
        .iter()
        .zip(&inner)
        .map(|(&e, &i)| if length(g, i) < length(g, e) { i } else { e })
        .collect();
    for reading in readings(g, &inner, options) {
        let candidates = match read(g, &inner, &reading) {
            Some(candidates) => candidates,
            None if inner.len() > 1 => inner
                .iter()
                .map(|&e| read(g, &[e], &reading).and_then(|mut c| c.pop()).flatten())
                .collect(),
            None => continue,
        };
        for (place, candidate) in best.iter_mut().zip(candidates) {
            if let Some(candidate) = candidate {
                *place = better(g, *place, candidate, options);
            }
        }
    }
    best
}

/// The expression with its small linear solves in closed form, simplified; the input when a closed form would be longer
/// than [`Options::max_closed_form`].
pub fn expand_solve(g: &Graph, e: Expr, options: &Options) -> Expr {
    simplify(g, e, options)
}

/// Substitutes (solved dependent velocities, say) and simplifies.
pub fn eliminate(g: &Graph, e: Expr, solved: &[(Expr, Expr)], options: &Options) -> Expr {
    simplify(g, g.substitute(e, solved), options)
}

/// The shorter of two; a closed form replaces a solve when it is short enough, however short the solve's notation.
fn better(g: &Graph, old: Expr, new: Expr, options: &Options) -> Expr {
    let (old_length, new_length) = (length(g, old), length(g, new));
    let opens = contains_solve(g, old) && !contains_solve(g, new);
    let shorter = new_length < old_length || (new_length == old_length && old != new);
    if shorter && (!opens || new_length <= options.max_closed_form) {
        new
    } else {
        old
    }
}

fn contains_solve(g: &Graph, e: Expr) -> bool {
    g.reachable(&[e])
        .into_iter()
        .any(|n| matches!(g.node(n), Node::Solve { .. }))
}

/// The ways to read the expressions as rational functions, from the most literal on.
fn readings(g: &Graph, es: &[Expr], options: &Options) -> Vec<normal_form::Options> {
    let literal = normal_form::Options::display(options.budget);
    let mut order = 0;
    let mut angles = Vec::new();
    for e in g.reachable(es) {
        match g.node(e) {
            Node::Solve { rhs, .. } => order = order.max(rhs.len()),
            Node::Apply {
                function,
                arguments,
            } if is_circular(*function) => angles.push(arguments[0]),
            _ => {}
        }
    }
    angles.sort_unstable();
    angles.dedup();
    let mut readings = vec![literal.clone()];
    if order > 0 && order <= options.max_solve {
        readings.push(normal_form::Options {
            expand_solves: true,
            ..literal.clone()
        });
    }
    if angles.len() > 1 {
        let last = readings.last().cloned().unwrap_or(literal);
        readings.push(normal_form::Options {
            expand_angles: true,
            ..last
        });
    }
    readings
}

fn is_circular(function: Function) -> bool {
    use Function::*;
    matches!(function, Sin | Cos | Tan | Cot | Sec | Csc)
}

/// The best arrangement of each expression under one reading; `None` when the reading exceeds the budget.
fn read(g: &Graph, es: &[Expr], reading: &normal_form::Options) -> Option<Vec<Option<Expr>>> {
    let (field, values) = normal_forms(g, es, reading).ok()?;
    let arranger = Arranger::new(&field, Written::of(g, es));
    Some(
        values
            .iter()
            .map(|value| arranger.fraction(value))
            .collect(),
    )
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

/// The same expressions with simplified arguments of functions and bases of roots, innermost first.
fn simplify_arguments(g: &Graph, es: &[Expr], options: &Options) -> Vec<Expr> {
    let mut image: FxHashMap<Expr, Expr> = FxHashMap::default();
    let mut solved = SolveCache::default();
    for e in g.reachable(es) {
        let mut rebuilt = g.rebuild(e, &mut |c| image.get(&c).copied().unwrap_or(c), &mut solved);
        let inner = match g.node(rebuilt) {
            Node::Apply { arguments, .. } => arguments.first().copied(),
            Node::Power { base, exponent } if g.as_integer(*exponent).is_none() => Some(*base),
            _ => None,
        };
        if let Some(inner) = inner.filter(|&i| is_compound(g, i)) {
            let simple = simplify_flat(g, inner, options);
            if simple != inner {
                rebuilt = replace_argument(g, rebuilt, simple);
            }
        }
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
    let literal = normal_form::Options::display(options.budget);
    match read(g, &[e], &literal).and_then(|mut c| c.pop()).flatten() {
        Some(candidate) if length(g, candidate) < length(g, e) => candidate,
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
