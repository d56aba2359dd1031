//! What tests of formulations with a state of their own share: mutants, and velocities that are derived.

use crate::formulations::common::Case;
use chetaev_mechanics::claims::formulation::{derive, equivalence, manifold};
use chetaev_mechanics::{Equations, Manifold};
use chetaev_symbolic::{Expr, Verdict};

/// A particle whose Lagrangian is not quadratic in the velocities, with a linear constraint.
pub const RELATIVISTIC: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { m = {}, c = {} }
assumptions = ["m > 0", "c > 0", "x'^2 + y'^2 + z'^2 < c^2"]
lagrangian = { L = "-m c^2 sqrt(1 - (x'^2 + y'^2 + z'^2)/c^2)" }
constraints = { plane = "z' = y x'" }
"#;

/// A Lagrangian of degree four whose Hessian depends on coordinates and time, a force, and a constraint nonlinear in the
/// velocities.
pub const QUARTIC: &str = r#"
coordinates = ["x", "y", "z"]
lagrangian = { L = "x'^4 + (1 + x^2) y'^4 + (1 + t^2) z'^2 x'^2 + y'^2 + z'^2 + t x y' - x z" }
forces = { y = "-x' y'^3" }
constraints = { c = "z' = x'^2 + y x y'" }
"#;

/// Explicit time, a force that is no gradient, a dense mass matrix, and an affine constraint with time in it.
pub const DRIVEN: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { m = {}, c = {} }
assumptions = ["m > 0"]
lagrangian = { L = "1/2 m (x'^2 + (1 + x^2 + t^2) y'^2 + z'^2) + 1/2 m x' y' + y x' - t y z' - x^2 z" }
forces = { x = "-c x' y", z = "sin(t) z'" }
constraints = { moving = "z' = y x' + t" }
"#;

/// The first-order system with other velocities or rates of the variables.
pub fn changed(
    case: &Case,
    equations: &Equations,
    change: impl FnOnce(&mut Vec<Expr>, &mut Vec<Expr>),
) -> Equations {
    let (mut velocities, mut rates) = (equations.velocities.clone(), equations.rates());
    change(&mut velocities, &mut rates);
    let mut variables = equations.variables.clone();
    for (variable, rate) in variables.iter_mut().zip(rates) {
        variable.rate = rate;
    }
    let mut other = Equations::in_state(equations.formulation, &case.system, variables, velocities);
    other.relations = equations.relations.clone();
    other
}

/// The word of the verdict that these equations have the accelerations of Routh's.
pub fn compared(case: &Case, equations: &Equations) -> &'static str {
    let cx = case.context();
    equivalence(&cx, &derive(&cx, "routh").unwrap(), equations).word()
}

/// Asserts that expressions of a formulation's state vanish on the constraint manifold.
#[track_caller]
pub fn assert_vanish(case: &Case, equations: &Equations, residuals: &[Expr]) {
    let cx = case.context();
    let natural = equations.in_natural_state(&case.system, residuals);
    let verdict = cx
        .prover
        .identity(&case.system, &natural, &manifold(&cx), "");
    assert!(matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
}

/// Asserts that q' of the state is v, and that every variable changes as its definition does along Routh's motion.
#[track_caller]
pub fn assert_state_follows_motion(case: &Case, name: &str) {
    let (system, g) = (&case.system, &case.system.graph);
    let (routh, equations) = (case.equations("routh"), case.equations(name));
    let mut residuals: Vec<Expr> = system
        .coordinates
        .iter()
        .zip(&equations.velocities)
        .map(|(c, &v)| g.sub(c.v, v))
        .collect();
    let motion: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .zip(&routh.accelerations)
        .map(|(c, &a)| (c.a, a))
        .collect();
    for variable in &equations.variables {
        if let Some(definition) = variable.definition {
            let rate = g.substitute(system.total_derivative(definition), &motion);
            residuals.push(g.sub(rate, variable.rate));
        }
    }
    assert_vanish(case, &equations, &residuals);
}

/// Whether an expression vanishes identically.
pub fn vanishes(case: &Case, residual: Expr) -> bool {
    let cx = case.context();
    let free = Manifold::default();
    let verdict = cx.prover.identity(&case.system, &[residual], &free, "");
    matches!(verdict, Verdict::Proved(_))
}
