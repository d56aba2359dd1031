//! Constraints and their classification.

use crate::system::{System, SystemError};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::one_to_one::innermost;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// What kind of constraint, by how it is written (T1 §0).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConstraintKind {
    /// `g(q, t) = 0`.
    Holonomic,
    /// Linear and homogeneous in the velocities.
    Linear,
    /// Linear in the velocities with a term free of them.
    Affine,
    /// Nonlinear in the velocities.
    Nonlinear,
    /// Contains accelerations or higher derivatives.
    HigherOrder,
}

impl ConstraintKind {
    /// The word used in output.
    pub fn word(self) -> &'static str {
        match self {
            ConstraintKind::Holonomic => "holonomic",
            ConstraintKind::Linear => "linear",
            ConstraintKind::Affine => "affine",
            ConstraintKind::Nonlinear => "nonlinear",
            ConstraintKind::HigherOrder => "higher-order",
        }
    }
}

/// A constraint of a system, `stated = left - right`.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// The name in the model; the multiplier is `lambda_NAME`.
    pub name: String,
    /// left - right as written.
    pub stated: Expr,
    /// The constraint on the velocities: `stated` itself, or `D stated` for a holonomic one.
    pub f: Expr,
    /// The highest derivative that occurs in `stated`.
    pub order: u32,
    /// Classification by form.
    pub kind: ConstraintKind,
    /// Whether the time (or a control) occurs explicitly.
    pub rheonomic: bool,
    /// Whether ∂f/∂v is free of the velocities.
    pub gradient_constant: bool,
}

impl System {
    /// The system with another function in the place of that which a constraint keeps at zero; `None` where it is of another order.
    pub fn with_constraint(&self, number: usize, function: Expr) -> Option<System> {
        let (mut system, stated) = (self.clone(), self.constraints.get(number)?);
        let own = Constraint::classify(self, stated.name.clone(), function).ok()?;
        if own.order != stated.order {
            return None;
        }
        system.constraints[number] = own;
        Some(system)
    }
}

impl Constraint {
    /// Classifies `stated = 0` in `system`.
    ///
    /// # Errors
    /// [`SystemError::NoCoordinateInConstraint`].
    pub(crate) fn classify(
        system: &System,
        name: String,
        stated: Expr,
    ) -> Result<Constraint, SystemError> {
        let g = &system.graph;
        let order = g
            .symbols_in(&[stated])
            .into_iter()
            .filter(|&s| system.coordinate_index(g.symbol_name(s)).is_some())
            .map(|s| g.symbol_order(s))
            .max();
        let Some(order) = order else {
            return Err(SystemError::NoCoordinateInConstraint { name });
        };
        let f = if order == 0 {
            system.total_derivative(stated)
        } else {
            stated
        };
        let (kind, gradient_constant) = match order {
            0 => (ConstraintKind::Holonomic, true),
            1 => kind_in_velocities(system, f),
            _ => (ConstraintKind::HigherOrder, false),
        };
        match kind {
            ConstraintKind::Nonlinear => {
                refuse_repeated_factor(system, &name, f, &system.velocity_symbols())?;
            }
            ConstraintKind::Holonomic => {
                refuse_repeated_factor(system, &name, stated, &system.coordinate_symbols())?;
            }
            _ => {}
        }
        Ok(Constraint {
            rheonomic: system.is_rheonomic(stated),
            name,
            stated,
            f,
            order,
            kind,
            gradient_constant,
        })
    }

    /// Whether f is linear or affine in the velocities.
    pub fn is_affine_in_velocities(&self) -> bool {
        matches!(
            self.kind,
            ConstraintKind::Holonomic | ConstraintKind::Linear | ConstraintKind::Affine
        )
    }
}

/// Where a factor of f that is repeated vanishes, f holds and ∂f/∂v = 0: the constraint is then no condition on
/// variations, and nothing that is said of the other factors holds there.
fn refuse_repeated_factor(
    system: &System,
    name: &str,
    f: Expr,
    symbols: &[Symbol],
) -> Result<(), SystemError> {
    let g = &system.graph;
    let inner = innermost(g, f);
    let list = match root_of_square(g, inner) {
        Some(root) => vec![(root, 2)],
        None => factors(g, inner, symbols).unwrap_or_default(),
    };
    match list.iter().find(|(_, power)| *power > 1) {
        None => Ok(()),
        Some(&(factor, power)) => Err(SystemError::RepeatedFactor {
            name: name.to_string(),
            factor: g.text(factor),
            power: match power {
                2 => "square".into(),
                3 => "cube".into(),
                power => format!("{power}th power"),
            },
        }),
    }
}

/// Functions that take their largest or least value, which are squares: 1 − cos u = 2 sin²(u/2), cosh u − 1 = 2 sinh²(u/2).
fn root_of_square(g: &Graph, e: Expr) -> Option<Expr> {
    let Node::Sum { constant, terms } = g.node(e) else {
        return None;
    };
    let [(term, weight)] = &**terms else {
        return None;
    };
    let Node::Apply {
        function,
        arguments,
    } = g.node(*term)
    else {
        return None;
    };
    let half = g.div(*arguments.first()?, g.integer(2));
    let eighth_turn = g.div(g.pi(), g.integer(4));
    let value = -constant.clone() / weight.clone();
    let is = |number: i64| value == Rational::from(number);
    match function {
        Function::Cosh if is(1) => Some(g.apply(Function::Sinh, &[half])),
        Function::Cos if is(1) => Some(g.sin(half)),
        Function::Cos if is(-1) => Some(g.cos(half)),
        Function::Sin if is(1) => Some(g.sin(g.sub(half, eighth_turn))),
        Function::Sin if is(-1) => Some(g.sin(g.add(&[half, eighth_turn]))),
        _ => None,
    }
}

/// Structural classification: a gradient free of velocities means affine.
///
/// A form that hides its linearity (`(x'^2 - x'^2) + x'`) is caught by canonical sums; one that hides it deeper counts
/// as nonlinear, which is safe: the nonlinear theory contains the linear one.
fn kind_in_velocities(system: &System, f: Expr) -> (ConstraintKind, bool) {
    let g = &system.graph;
    let velocities = system.velocity_symbols();
    let gradient = g.gradient(f, &velocities);
    let linear = !g.any_contains_any(&gradient, &velocities);
    if !linear {
        return (ConstraintKind::Nonlinear, false);
    }
    let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
    if g.is_zero(g.substitute(f, &at_rest)) {
        (ConstraintKind::Linear, true)
    } else {
        (ConstraintKind::Affine, true)
    }
}
