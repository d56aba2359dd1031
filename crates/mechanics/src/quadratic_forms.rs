//! The signs of quadratic forms in the velocities.
//!
//! The kinetic energy is looked at in the linear forms of the velocities with which it is written.
//! A body's energy is stated by angular velocities, `½ (A ω₁² + B ω₂²) + D ω₁ ω₂`. In the ω its coefficients are moments of
//! inertia, whose minors the assumptions of a model speak of; in the velocities they are long trigonometric expressions.
//! The Lagrangian of a fast particle, `−m c² √(1 − v²/c²)`, is a function φ of such a form N, and
//! `W = φ' ∂²N/∂v∂v + φ'' ∂N/∂v ∂N/∂v ᵀ`.

use crate::characteristics::Manifold;
use crate::prover::{assumptions, Prover};
use crate::system::System;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::rational::to_i64;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Graph, Node, Verdict};
use rustc_hash::FxHashMap;

/// More linear forms that are coupled with each other are not tried.
const LARGEST_BLOCK: usize = 6;

/// Whether `e ≥ 0` on the manifold, as the identity `|e| = e`.
pub(crate) fn nonnegative(
    system: &System,
    prover: &Prover,
    manifold: &Manifold,
    e: Expr,
    on: &str,
) -> Verdict {
    let g = &system.graph;
    prover.identity(system, &[g.sub(g.abs(e), e)], manifold, on)
}

/// How many linear forms there are, where the form is positive in them by its leading minors (Sylvester's criterion), block
/// by block of those that are coupled; `None` where that is not seen.
pub(crate) fn positive_in_linear_forms(system: &System, kinetic: Expr) -> Option<usize> {
    let g = &system.graph;
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let (written, variables, _) = in_linear_forms(g, kinetic, &velocities)?;
    let symbols: Vec<_> = variables.iter().filter_map(|&e| g.as_symbol(e)).collect();
    let momenta = g.gradient(written, &symbols);
    let matrix = g.jacobian(&momenta, &symbols);
    is_nonnegative_by_minors(system, &matrix).then_some(variables.len())
}

/// Whether a symmetric matrix is nowhere negative by its leading minors (Sylvester's criterion), block by block of coupled rows.
pub(crate) fn is_nonnegative_by_minors(system: &System, matrix: &[Vec<Expr>]) -> bool {
    let every = blocks(&system.graph, matrix);
    every.iter().all(|block| is_positive(system, matrix, block))
}

/// Whether the Lagrangian is a function φ of one quadratic form N in the velocities, with `φ' ∂²N/∂v∂v` nowhere negative and
/// `φ'' ≥ 0`.
pub(crate) fn is_convex_in_one_form(system: &System) -> bool {
    let (g, assumptions) = (&system.graph, assumptions(system));
    let velocities = system.velocity_symbols();
    let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
    let form = g.symbol("form of the velocities", 0);
    let Some(symbol) = g.as_symbol(form) else {
        return false;
    };
    let sums = g.reachable(&[system.lagrangian]).into_iter();
    sums.filter(|&e| matches!(g.node(e), Node::Sum { .. }))
        .any(|sum| {
            let function = g.substitute(system.lagrangian, &[(sum, form)]);
            if g.contains_any(function, &velocities) {
                return false;
            }
            let slope = g.gradient(function, &[symbol])[0];
            let curvature = g.gradient(slope, &[symbol])[0];
            let squares = g.sub(sum, g.substitute(sum, &at_rest));
            let (rises, sign) = (known_sign(g, slope, &assumptions), |e| {
                positive_in_linear_forms(system, e).is_some()
            });
            known_sign(g, curvature, &assumptions).is_nonnegative()
                && (rises.is_nonnegative() && sign(squares)
                    || rises.is_nonpositive() && sign(g.neg(squares)))
        })
}

/// The part of an expression that is homogeneous of a degree in the velocities, as it is written, and the rest.
pub(crate) fn terms_of_degree(system: &System, e: Expr, degree_asked: u32) -> (Expr, Expr) {
    let g = &system.graph;
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let degrees = degrees(g, e, &velocities);
    let is_asked = |e: Expr| degrees.get(&e).copied().flatten() == Some(degree_asked);
    if is_asked(e) {
        return (e, g.zero());
    }
    let Node::Sum { terms, .. } = g.node(e) else {
        return (g.zero(), e);
    };
    let own: Vec<Expr> = terms
        .iter()
        .filter(|(term, _)| is_asked(*term))
        .map(|(term, factor)| g.scale(factor, *term))
        .collect();
    let own = g.add(&own);
    (own, g.sub(e, own))
}

/// The expression with a new symbol for every composed linear form, all symbols in which it is then quadratic, and what they
/// stand for.
pub(crate) fn in_linear_forms(
    g: &Graph,
    kinetic: Expr,
    velocities: &[Expr],
) -> Option<(Expr, Vec<Expr>, Vec<Expr>)> {
    let degrees = degrees(g, kinetic, velocities);
    let is_form =
        |e: &Expr| degrees.get(e) == Some(&Some(1)) && matches!(g.node(*e), Node::Sum { .. });
    let forms: Vec<Expr> = (g.reachable(&[kinetic]).into_iter())
        .filter(is_form)
        .collect();
    if degrees.get(&kinetic) != Some(&Some(2)) {
        return None;
    }
    // No name of a model contains a space.
    let symbols = (0..forms.len()).map(|i| g.symbol(&format!("linear form {i}"), 0));
    let pairs: Vec<(Expr, Expr)> = forms.iter().copied().zip(symbols).collect();
    let written = g.substitute(kinetic, &pairs);
    let occurring = g.reachable(&[written]);
    let all = pairs.iter().map(|&(form, symbol)| (symbol, form));
    let all = all.chain(velocities.iter().map(|&v| (v, v)));
    let (symbols, forms) = all.filter(|(e, _)| occurring.contains(e)).unzip();
    Some((written, symbols, forms))
}

/// The degrees of an expression and of all that it is made of.
fn degrees(g: &Graph, e: Expr, velocities: &[Expr]) -> FxHashMap<Expr, Option<u32>> {
    let mut degrees: FxHashMap<Expr, Option<u32>> = FxHashMap::default();
    for e in g.reachable(&[e]) {
        let own = match velocities.contains(&e) {
            true => Some(1),
            false => degree(g, e, &degrees),
        };
        degrees.insert(e, own);
    }
    degrees
}

/// The degree of a homogeneous polynomial in the velocities; `None` for anything else.
fn degree(g: &Graph, e: Expr, degrees: &FxHashMap<Expr, Option<u32>>) -> Option<u32> {
    let of = |child: Expr| degrees.get(&child).copied().flatten();
    match g.node(e) {
        Node::Sum { constant, terms } => {
            let (first, _) = terms.first()?;
            let degree = of(*first)?;
            let same = terms.iter().all(|(term, _)| of(*term) == Some(degree));
            let constant = g.number(constant.clone());
            (same && (degree == 0 || g.is_zero(constant))).then_some(degree)
        }
        Node::Product { factors, .. } => factors
            .iter()
            .try_fold(0_u32, |sum, &factor| Some(sum + of(factor)?)),
        Node::Power { base, exponent } => match (of(*base)?, g.as_number(*exponent)) {
            (0, _) => (of(*exponent)? == 0).then_some(0),
            (degree, Some(number)) => {
                let times = u32::try_from(to_i64(number)?).ok()?;
                degree.checked_mul(times)
            }
            _ => None,
        },
        _ => {
            let mut free = true;
            g.node(e)
                .for_each_child(|child| free &= of(child) == Some(0));
            free.then_some(0)
        }
    }
}

/// Indices of rows that are coupled with each other by entries that are not zero.
fn blocks(g: &Graph, matrix: &[Vec<Expr>]) -> Vec<Vec<usize>> {
    let mut left: Vec<usize> = (0..matrix.len()).collect();
    let mut blocks = Vec::new();
    while let Some(first) = left.pop() {
        let mut block = vec![first];
        let mut next = 0;
        while next < block.len() {
            let row = block[next];
            let (coupled, apart) = left
                .into_iter()
                .partition(|&j| !g.is_zero(matrix[row][j]) || !g.is_zero(matrix[j][row]));
            block.extend::<Vec<usize>>(coupled);
            left = apart;
            next += 1;
        }
        block.sort_unstable();
        blocks.push(block);
    }
    blocks
}

/// A block of one row may vanish; of a larger one all leading minors are positive, from the front or from the back.
fn is_positive(system: &System, matrix: &[Vec<Expr>], block: &[usize]) -> bool {
    let backwards: Vec<usize> = block.iter().rev().copied().collect();
    has_positive_minors(system, matrix, block) || has_positive_minors(system, matrix, &backwards)
}

fn has_positive_minors(system: &System, matrix: &[Vec<Expr>], block: &[usize]) -> bool {
    let (g, assumptions) = (&system.graph, assumptions(system));
    let sign = |e: Expr| known_sign(g, e, &assumptions);
    if let [only] = block {
        return sign(matrix[*only][*only]).is_nonnegative();
    }
    block.len() <= LARGEST_BLOCK
        && (1..=block.len()).all(|size| {
            let rows = block[..size].iter();
            let minor: Vec<Vec<Expr>> = rows
                .map(|&i| block[..size].iter().map(|&j| matrix[i][j]).collect())
                .collect();
            sign(determinant(g, &minor)).is_positive()
        })
}
