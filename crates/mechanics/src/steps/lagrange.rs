//! Lagrange's equations of all coordinates, with the multipliers where there are constraints.

use super::{Ground, Step, StepFormula, StepKind, Steps};
use crate::equations::{unused_name, Equation, NamedExpr};
use crate::formulations::{nielsen_left_sides, solved_with_multipliers, Basis, DeriveError};
use crate::mass;
use crate::system::System;
use chetaev_symbolic::Expr;

/// The steps of Routh's equations; `None` for constraints of higher order and where a mass contains velocities.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
pub(super) fn with_multipliers(basis: &Basis<'_>) -> Result<Option<Steps>, DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    if basis.terms.order > 1 || mass::with_velocity(system).is_some() {
        return Ok(None);
    }
    let mut steps = Steps {
        rates: system.coordinates.iter().map(|c| c.a).collect(),
        velocities: system.coordinates.iter().map(|c| c.v).collect(),
        ..Steps::default()
    };
    state(&mut steps, basis);
    parts_of_left_sides(&mut steps, system);
    let lefts = system.lagrange_left_sides();
    let rights = basis.forces_with_reactions();
    // Nielsen's form of the left sides, which differentiates L by the time first.
    let others = nielsen_left_sides(system, 1);
    let formula = |((&left, &right), &other)| StepFormula {
        left,
        right,
        ground: Ground::Difference(g.sub(other, right)),
    };
    let sides = lefts.iter().zip(&rights).zip(&others);
    steps.push(Step {
        kind: StepKind::WithMultipliers,
        formulas: sides.map(formula).collect(),
        conditions: Vec::new(),
    });
    solve(&mut steps, basis)?;
    Ok(Some(steps))
}

/// What the model states: L, forces, constraints.
pub(super) fn state(steps: &mut Steps, basis: &Basis<'_>) {
    let (system, g) = (basis.system, &basis.system.graph);
    let name = unused_name(system, "L");
    let lagrangian = (g.symbol(&name, 0), system.lagrangian);
    steps.push(Step::stated(StepKind::Lagrangian, vec![lagrangian]));
    let forces = system.coordinates.iter().zip(&system.forces);
    let forces = forces.filter(|(_, &force)| !g.is_zero(force));
    let forces = forces.map(|(c, &force)| (g.symbol(&format!("Q_{}", c.name), 0), force));
    steps.push(Step::stated(StepKind::Forces, forces.collect()));
    let pair = |e: Equation| (e.left, e.right);
    let constraints = basis.constraint_equations().into_iter().map(pair);
    steps.push(Step::stated(StepKind::Constraints, constraints.collect()));
}

/// ∂L/∂v, its rate and ∂L/∂q.
fn parts_of_left_sides(steps: &mut Steps, system: &System) {
    let g = &system.graph;
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let rates: Vec<Expr> = (momenta.iter())
        .map(|&p| system.total_derivative(p))
        .collect();
    // ∂(DL)/∂v = D(∂L/∂v) + ∂L/∂q, and ∂(DL)/∂a = ∂L/∂v.
    let rate = system.total_derivative(system.lagrangian);
    let tops: Vec<_> = system.coordinates.iter().map(|c| c.a_symbol).collect();
    let by_tops = g.gradient(rate, &tops);
    let nielsen = nielsen_left_sides(system, 1);
    let of_rates: Vec<Expr> = sums(g, &nielsen, &slopes);
    let of_slopes: Vec<Expr> = rates
        .iter()
        .zip(&nielsen)
        .map(|(&a, &b)| g.sub(a, b))
        .collect();
    let (names, of_names) = momenta_names(steps, system);
    let slope_names = slope_names(steps, system);
    steps.push(Step::values(
        StepKind::FullMomenta,
        &names,
        &momenta,
        &by_tops,
    ));
    steps.push(Step::values(
        StepKind::FullRates,
        &of_names,
        &rates,
        &of_rates,
    ));
    steps.push(Step::values(
        StepKind::FullSlopes,
        &slope_names,
        &slopes,
        &of_slopes,
    ));
}

fn sums(g: &chetaev_symbolic::Graph, a: &[Expr], b: &[Expr]) -> Vec<Expr> {
    a.iter().zip(b).map(|(&a, &b)| g.add(&[a, b])).collect()
}

/// p_i and p_i'.
fn momenta_names(steps: &mut Steps, system: &System) -> (Vec<Expr>, Vec<Expr>) {
    let g = &system.graph;
    let mut both = (Vec::new(), Vec::new());
    for c in &system.coordinates {
        let name = unused_name(system, &format!("p_{}", c.name));
        both.0.push(g.symbol(&name, 0));
        both.1.push(g.symbol(&name, 1));
        let own = NamedExpr::new(name, c.v, format!("∂L/∂{}'", c.name));
        steps.names.push(own.with_indices("p", &[], &[&c.name]));
    }
    both
}

/// L_i.
fn slope_names(steps: &mut Steps, system: &System) -> Vec<Expr> {
    let name = |c: &crate::system::Coordinate| {
        let name = unused_name(system, &format!("L_{}", c.name));
        let symbol = system.graph.symbol(&name, 0);
        let own = NamedExpr::new(name, c.q, format!("∂L/∂{}", c.name));
        steps.names.push(own.with_indices("L", &[], &[&c.name]));
        symbol
    };
    system.coordinates.iter().map(name).collect()
}

/// The constraints differentiated, accelerations and multipliers.
fn solve(steps: &mut Steps, basis: &Basis<'_>) -> Result<(), DeriveError> {
    let (system, g) = (basis.system, &basis.system.graph);
    let (accelerations, multipliers) = solved_with_multipliers(basis)?;
    let zero = g.zero();
    let rows = &basis.selection.rows;
    let differentiated = rows.iter().map(|&row| {
        let f = basis.terms.constraints[row];
        let slopes = basis.terms.jacobian[row].iter().zip(&system.coordinates);
        let along = slopes.map(|(&slope, c)| g.mul(&[slope, c.a]));
        let along = g.add(&along.collect::<Vec<_>>());
        StepFormula {
            left: system.total_derivative(f),
            right: zero,
            ground: Ground::Difference(g.sub(along, basis.terms.constraint_rate[row])),
        }
    });
    let differentiated: Vec<StepFormula> = differentiated.collect();
    let rates: Vec<Expr> = differentiated.iter().map(|f| f.left).collect();
    steps.push(Step {
        kind: StepKind::ConstraintsDifferentiated,
        formulas: differentiated,
        conditions: Vec::new(),
    });
    let names: Vec<Expr> = steps
        .rates
        .iter()
        .copied()
        .chain(basis.lambda_symbols())
        .collect();
    let values = [accelerations, multipliers].concat();
    let pairs: Vec<(Expr, Expr)> = names.iter().copied().zip(values.iter().copied()).collect();
    let conditions = g.substitute_all(&[basis.balance(), rates].concat(), &pairs);
    let solved = Step::values(StepKind::SolvedForAll, &names, &values, &values);
    steps.push(solved.with_conditions(conditions));
    Ok(())
}
