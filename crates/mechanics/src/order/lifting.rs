//! Lifting: a constraint of lower order in the place of its total derivative.
//!
//! `D f` has the gradient by the highest derivatives that f has, so that the equations of motion do not change when a constraint
//! is replaced by its total derivative; only more initial states are admissible (T2 §2). What was lifted stays a condition on
//! the initial state and is an integral of the motion.

use crate::constraint::Constraint;
use crate::system::System;
use chetaev_symbolic::Expr;

/// A constraint, or one of its derivatives, of lower order than that to which the constraints were lifted.
#[derive(Clone, Debug)]
pub struct Condition {
    /// The index of the constraint in the system.
    pub constraint: usize,
    /// How often it is differentiated.
    pub derivatives: u32,
    /// The highest derivative of a coordinate in it.
    pub order: u32,
    /// What must vanish.
    pub value: Expr,
}

/// The constraint as a condition on the derivatives of order m: `D^(m - order) f`.
pub fn lifted(system: &System, constraint: &Constraint, order: u32) -> Expr {
    derivative(
        system,
        constraint.stated,
        order - constraint.order.min(order),
    )
}

/// `D^times e`.
pub fn derivative(system: &System, e: Expr, times: u32) -> Expr {
    (0..times).fold(e, |e, _| system.total_derivative(e))
}

/// What lifting to the order m leaves as conditions on a state: `f, D f, …` of orders below m.
pub fn conditions(system: &System, order: u32) -> Vec<Condition> {
    let mut found = Vec::new();
    for (index, constraint) in system.constraints.iter().enumerate() {
        let mut value = constraint.stated;
        for derivatives in 0..order.saturating_sub(constraint.order) {
            found.push(Condition {
                constraint: index,
                derivatives,
                order: constraint.order + derivatives,
                value,
            });
            value = system.total_derivative(value);
        }
    }
    found
}
