//! Admissible velocities without singular places: quasi-velocities P with `v = φ(q, P, t)` that needs no division by anything
//! that changes.
//!
//! Constraints are taken one by one. Where one has a velocity with a constant coefficient, it gives that velocity (a disc that
//! rolls: `x' = r ψ' cos φ`). Where it has two velocities with coefficients p, q and `p² + q²` constant, as the blade of a
//! skate, `x' sin φ = y' cos φ`, the speed u along it takes their place, `x' = u cos φ`, `y' = u sin φ`. Independent velocities
//! are singular wherever their chart ends; these quasi-velocities serve everywhere (Chaplygin 1911; Maruskin, Bloch 2011).

use crate::characteristics::Characteristics;
use crate::constraint::ConstraintKind;
use crate::elimination::{Dividing, Elimination, Writing};
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::{Expr, Function, Node, Symbol};

/// Larger systems are not looked at.
const LARGEST: usize = 40;

/// Characteristics by such quasi-velocities for the constraints of `rows`, each with the definition of P in the velocities;
/// `None` where none are found in this way.
pub fn regular(system: &System, terms: &MotionTerms, rows: &[usize]) -> Option<Characteristics> {
    regular_dividing(system, terms, rows, Dividing::Nonzero)
}

/// The same for values of parameters near those that are stated: what only contains parameters is divided by where it is not zero there, as
/// the distance between two hinges.
pub fn regular_as_stated(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
) -> Option<Characteristics> {
    regular_dividing(system, terms, rows, Dividing::NonzeroAsStated)
}

fn regular_dividing(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
    dividing: Dividing,
) -> Option<Characteristics> {
    let is_affine = rows.iter().all(|&row| terms.affine[row]);
    if terms.order != 1 || !is_affine || system.n() > LARGEST || !system.masses.is_empty() {
        return None;
    }
    let is_holonomic = |&row: &usize| {
        system.constraints[terms.constraint_index[row]].kind == ConstraintKind::Holonomic
    };
    if rows.iter().any(is_holonomic) {
        return None;
    }
    let size = |e: &Elimination<'_>| system.graph.reachable(&e.velocities).len();
    let found = [Writing::Coefficients, Writing::Stated]
        .into_iter()
        .filter_map(|writing| Elimination::of(system, terms, rows, (writing, dividing)));
    let Elimination {
        velocities, speeds, ..
    } = found.min_by_key(size)?;
    let is_regular = velocities
        .iter()
        .chain(speeds.iter().map(|p| &p.definition))
        .all(|&e| has_no_poles(system, e));
    is_regular.then(|| Characteristics::by_formulas(system, terms, rows, speeds, velocities))
}

/// Whether nothing is divided by that may vanish, but roots, whose radicands are assumed to be positive where they stand in a
/// constraint.
pub(crate) fn has_no_poles(system: &System, e: Expr) -> bool {
    let g = &system.graph;
    let is_parameter = |s: &Symbol| {
        system
            .parameters
            .iter()
            .any(|p| g.as_symbol(p.expr) == Some(*s))
    };
    let stays = |e: Expr| g.symbols_in(&[e]).iter().all(is_parameter);
    g.reachable(&[e]).into_iter().all(|own| match g.node(own) {
        Node::Power { base, exponent } => match g.as_number(*exponent) {
            Some(number) => {
                !chetaev_symbolic::rational::is_negative(number)
                    || g.as_integer(*exponent).is_none()
                    || stays(*base)
            }
            None => false,
        },
        Node::Apply { function, .. } => {
            matches!(function, Function::Sin | Function::Cos | Function::Exp)
        }
        Node::Solve { .. } | Node::Matrix { .. } => false,
        _ => true,
    })
}

/// What is divided by, but for constants: bases of negative powers, and cosines and sines below tangents and their kin.
pub(crate) fn denominators(system: &System, es: &[Expr]) -> Vec<Expr> {
    let g = &system.graph;
    let is_parameter = |s: &Symbol| {
        let mut own = system.parameters.iter();
        own.any(|p| g.as_symbol(p.expr) == Some(*s))
    };
    let es: Vec<Expr> = es
        .iter()
        .map(|&e| chetaev_symbolic::simplify::by_quotients(g, e))
        .collect();
    let below = g.reachable(&es).into_iter().filter_map(|e| {
        let (base, exponent) = g.base_exponent(e);
        let is_below = g
            .as_number(exponent)
            .is_some_and(chetaev_symbolic::rational::is_negative);
        (is_below && !g.symbols_in(&[base]).iter().all(is_parameter)).then_some(base)
    });
    below.collect()
}
