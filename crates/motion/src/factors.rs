//! The component of constraints that are products on which a state lies.

use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::{Constraint, ConstraintKind, System};
use chetaev_symbolic::factors::{irreducible_factors, quotient};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::Expr;

/// A constraint that is a product, with the one factor that vanishes at a state.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Number of the constraint.
    pub constraint: usize,
    /// The factor that vanishes.
    pub function: Expr,
    /// What it was multiplied by: the multiplier of the factor is that of the constraint times this.
    pub rest: Expr,
    /// The other factors that may vanish.
    pub others: Vec<Other>,
}

/// A factor that does not vanish at a state.
#[derive(Clone, Debug)]
pub struct Other {
    /// The factor.
    pub function: Expr,
    /// Its rate along a motion.
    pub rate: Expr,
    /// Whether it is a function of the place alone: then a state lies on its component only where its rate vanishes too.
    pub is_of_place: bool,
}

/// The system on the component of its constraints on which a state lies, with what was replaced; `vanishes` says of a function whether it
/// does at the state. `None` where no constraint is a product, and where a state lies on more than one component.
pub(crate) fn on_component(
    system: &System,
    vanishes: &dyn Fn(Expr) -> Option<bool>,
) -> Option<(System, Vec<Factor>)> {
    let (mut on, mut found) = (system.clone(), Vec::new());
    for number in 0..system.constraints.len() {
        let Some(all) = factors_of(system, number) else {
            continue;
        };
        let factor = vanishing(system, (number, &all), vanishes)?;
        on = on.with_constraint(number, factor.function)?;
        found.push(factor);
    }
    (!found.is_empty()).then_some((on, found))
}

/// A system that is on a component of a constraint, on the component of another factor of it, with that factor.
pub(crate) fn on_another(
    system: &System,
    factor: &Factor,
    function: Expr,
) -> Option<(System, Factor)> {
    let g = &system.graph;
    let is_taken = |other: &&Other| other.function == function;
    let taken = factor.others.iter().find(is_taken)?;
    let left = Other {
        function: factor.function,
        rate: system.total_derivative(factor.function),
        is_of_place: taken.is_of_place,
    };
    let rest = factor.others.iter().filter(|other| !is_taken(other));
    let own = Factor {
        constraint: factor.constraint,
        function,
        rest: quotient(g, g.mul(&[factor.rest, factor.function]), function)?,
        others: rest.cloned().chain([left]).collect(),
    };
    Some((system.with_constraint(factor.constraint, function)?, own))
}

/// Whether some constraint is a product, of which a motion keeps one factor at zero.
pub fn has_components(system: &System) -> bool {
    let mut all = 0..system.constraints.len();
    all.any(|number| factors_of(system, number).is_some())
}

/// The simple factors of a constraint that may vanish, where they are not the whole of it.
fn factors_of(system: &System, number: usize) -> Option<Vec<Expr>> {
    let (g, constraint) = (&system.graph, &system.constraints[number]);
    let symbols = match constraint.kind {
        ConstraintKind::Holonomic => system.coordinate_symbols(),
        ConstraintKind::Nonlinear => system.velocity_symbols(),
        _ => return None,
    };
    let all = irreducible_factors(g, stated(constraint), &symbols)?;
    if all.len() < 2 || all.iter().any(|(_, power)| *power > 1) {
        return None;
    }
    let known = assumptions(system);
    let may_vanish = |e: &Expr| !known_sign(g, *e, &known).is_nonzero();
    Some(all.into_iter().map(|(e, _)| e).filter(may_vanish).collect())
}

fn stated(constraint: &Constraint) -> Expr {
    match constraint.kind {
        ConstraintKind::Holonomic => constraint.stated,
        _ => constraint.f,
    }
}

/// The only one of some factors on whose component the state lies.
fn vanishing(
    system: &System,
    (number, all): (usize, &[Expr]),
    vanishes: &dyn Fn(Expr) -> Option<bool>,
) -> Option<Factor> {
    let constraint = &system.constraints[number];
    let is_of_place = constraint.kind == ConstraintKind::Holonomic;
    // A state lies on the component of a function of the place where its rate vanishes too.
    let contains =
        |e: Expr| Some(vanishes(e)? && (!is_of_place || vanishes(system.total_derivative(e))?));
    let here = all.iter().map(|&e| contains(e));
    let here: Vec<bool> = here.collect::<Option<_>>()?;
    let place = here.iter().position(|is_here| *is_here)?;
    if here.iter().filter(|is_here| **is_here).count() > 1 {
        return None;
    }
    let function = all[place];
    let others = all.iter().filter(|&&e| e != function);
    let others = others.map(|&function| Other {
        function,
        rate: system.total_derivative(function),
        is_of_place,
    });
    Some(Factor {
        constraint: number,
        function,
        rest: quotient(&system.graph, stated(constraint), function)?,
        others: others.collect(),
    })
}
