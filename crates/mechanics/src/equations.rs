//! What a formulation delivers: equations in its own notation, intermediate objects, and accelerations.

use crate::characteristics::Characteristics;
use chetaev_symbolic::Expr;

/// One equation, `left = right`.
#[derive(Clone, Debug)]
pub struct Equation {
    /// What it belongs to, for example the coordinate or the parameter.
    pub label: String,
    /// Left side.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
}

/// A named intermediate object, for example `lambda_blade` or an entry of B.
#[derive(Clone, Debug)]
pub struct NamedExpr {
    /// The name as printed.
    pub name: String,
    /// Its value.
    pub value: Expr,
    /// What it is, in a few words.
    pub meaning: String,
}

/// A group of equations with a heading.
#[derive(Clone, Debug)]
pub struct EquationGroup {
    /// Heading, for example "equations of motion".
    pub title: String,
    /// The equations.
    pub equations: Vec<Equation>,
}

/// The equations of motion in one formulation.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Name of the formulation in the registry.
    pub formulation: &'static str,
    /// The equations as the formulation states them.
    pub groups: Vec<EquationGroup>,
    /// Intermediate objects, printed with the equations.
    pub objects: Vec<NamedExpr>,
    /// The parametrization of the velocities it uses; `None` when it works on all of (q, v).
    pub characteristics: Option<Characteristics>,
    /// q'' as functions of (q, v, t), or of (q, P, t) with characteristics; length n.
    pub accelerations: Vec<Expr>,
    /// P' as functions of (q, P, t); empty without characteristics.
    pub rates: Vec<Expr>,
    /// Multipliers by index of their constraint in the system; empty where the formulation has none.
    pub multipliers: Vec<(usize, Expr)>,
}
