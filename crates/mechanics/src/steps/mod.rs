//! A derivation as it is written on a board: steps of a few formulas, each with what proves it.
//!
//! The steps of a formulation ([`steps`]) are plain data. What is proved of a formula is
//! reached on another way than the formula itself: momenta of the restricted Lagrangian by the chain rule, brackets by Nielsen's
//! identity, what is collected by Maggi's contraction and Maggi's by the restricted Lagrangian, multipliers by the bordered system.
//! Titles, general forms and reasons are words, and stand where the steps are printed.

mod lagrange;
mod on_constraints;

use crate::equations::NamedExpr;
use crate::formulations::{Basis, DeriveError};
use crate::Manifold;
use chetaev_symbolic::{Expr, Graph};

/// Writes a derivation; `None` for constraints of higher order and where a mass contains velocities.
type Write = fn(&Basis<'_>) -> Result<Option<Steps>, DeriveError>;

/// The formulations that are written step by step, by their names in the registry of formulations.
static WRITTEN: &[(&str, Write)] = &[
    ("routh", lagrange::with_multipliers),
    ("maggi", on_constraints::maggi),
    ("reduced", on_constraints::reduced),
    ("voronets", on_constraints::voronets),
    ("chaplygin", on_constraints::chaplygin),
];

/// The names of the formulations that are written step by step.
pub fn formulations() -> impl Iterator<Item = &'static str> {
    WRITTEN.iter().map(|(name, _)| *name)
}

/// The derivation of a formulation; `None` where none is written of this formulation, for constraints of higher order and where a
/// mass contains velocities.
///
/// # Errors
/// [`DeriveError`] where the accelerations are not determined.
pub fn steps(formulation: &str, basis: &Basis<'_>) -> Result<Option<Steps>, DeriveError> {
    match WRITTEN.iter().find(|(name, _)| *name == formulation) {
        Some((_, write)) => write(basis),
        None => Ok(None),
    }
}

/// What a step does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum StepKind {
    /// L as the model states it.
    Lagrangian,
    /// The forces Q_i that L does not contain.
    Forces,
    /// The constraints f = 0 as the model states them.
    Constraints,
    /// The quasi-velocities P as functions of (q, v, t).
    QuasiVelocities,
    /// The velocities on the constraints, q' = φ(t, q, P).
    AdmissibleVelocities,
    /// B_iσ = ∂φ^i/∂P_σ.
    VirtualDisplacements,
    /// ∂L/∂v^i.
    FullMomenta,
    /// D(∂L/∂v^i).
    FullRates,
    /// ∂L/∂q^i.
    FullSlopes,
    /// D(∂L/∂v^i) − ∂L/∂q^i − Q_i.
    LeftSides,
    /// The equations of all coordinates with the multipliers.
    WithMultipliers,
    /// D f = 0.
    ConstraintsDifferentiated,
    /// q'' and λ from the last two.
    SolvedForAll,
    /// L* = L on the constraints.
    RestrictedLagrangian,
    /// p_σ = ∂L*/∂P_σ.
    Momenta,
    /// D p_σ.
    Rates,
    /// ∂L*/∂π_σ.
    Slopes,
    /// θ_i = ∂L/∂v^i on the constraints.
    DependentMomenta,
    /// A^i_σ = D B_iσ − ∂φ^i/∂π_σ.
    Brackets,
    /// C_σ = Σ θ_i A^i_σ.
    CurvatureTerms,
    /// R_σ = Σ Q_i B_iσ.
    ForcesAlong,
    /// D p_σ − ∂L*/∂π_σ − C_σ = R_σ.
    Collected,
    /// Σ (D(∂L/∂v^i) − ∂L/∂q^i − Q_i) B_iσ = 0.
    Contracted,
    /// The same solved for few terms.
    Shortened,
    /// Σ_l λ_l ∂f^l/∂v^i = D(∂L/∂v^i) − ∂L/∂q^i − Q_i of as many coordinates as there are constraints.
    ReactionEquations,
    /// λ_l.
    Reactions,
}

impl StepKind {
    /// Whether its formulas are components, of which those that vanish are of no interest.
    pub fn is_of_components(self) -> bool {
        matches!(
            self,
            StepKind::VirtualDisplacements
                | StepKind::FullSlopes
                | StepKind::Slopes
                | StepKind::Brackets
                | StepKind::CurvatureTerms
                | StepKind::ForcesAlong
        )
    }
}

/// What proves a formula `left = right`.
#[derive(Clone, Debug)]
pub enum Ground {
    /// The model states it.
    Stated,
    /// The right side, found on another way.
    Value(Expr),
    /// `left − right`, found on another way.
    Difference(Expr),
    /// It holds with these values of rates, found on another way.
    With(Vec<(Expr, Expr)>),
}

impl Ground {
    /// What must vanish for `left = right` to be true; `None` for what is stated.
    pub fn residual(&self, g: &Graph, left: Expr, right: Expr) -> Option<Expr> {
        match self {
            Ground::Stated => None,
            Ground::Value(value) => Some(g.sub(right, *value)),
            Ground::Difference(difference) => Some(g.sub(g.sub(left, right), *difference)),
            Ground::With(rates) => Some(g.substitute(g.sub(left, right), rates)),
        }
    }
}

/// A formula of a step.
#[derive(Clone, Debug)]
pub struct StepFormula {
    /// Left side: a name, or the left side of an equation.
    pub left: Expr,
    /// Right side.
    pub right: Expr,
    /// What proves it.
    pub ground: Ground,
}

/// One step.
#[derive(Clone, Debug)]
pub struct Step {
    /// What it does.
    pub kind: StepKind,
    /// Its formulas.
    pub formulas: Vec<StepFormula>,
    /// What must vanish besides: the constraints for the velocities that are said to satisfy them.
    pub conditions: Vec<Expr>,
}

impl Step {
    /// Formulas that the model states.
    fn stated(kind: StepKind, pairs: Vec<(Expr, Expr)>) -> Step {
        let formula = |(left, right)| StepFormula {
            left,
            right,
            ground: Ground::Stated,
        };
        Step {
            kind,
            formulas: pairs.into_iter().map(formula).collect(),
            conditions: Vec::new(),
        }
    }

    /// Names with their values, and the values on another way.
    fn values(kind: StepKind, names: &[Expr], values: &[Expr], others: &[Expr]) -> Step {
        let sides = names.iter().zip(values).zip(others);
        let formula = |((&left, &right), &other)| StepFormula {
            left,
            right,
            ground: Ground::Value(other),
        };
        Step {
            kind,
            formulas: sides.map(formula).collect(),
            conditions: Vec::new(),
        }
    }

    fn with_conditions(mut self, conditions: Vec<Expr>) -> Step {
        self.conditions = conditions;
        self
    }
}

/// A derivation.
#[derive(Clone, Debug, Default)]
pub struct Steps {
    /// In the order in which they are written.
    pub steps: Vec<Step>,
    /// The names that are introduced, with their meanings.
    pub names: Vec<NamedExpr>,
    /// What ties the symbols in all of them.
    pub manifold: Manifold,
    /// The rates by which equations are collected.
    pub rates: Vec<Expr>,
    /// The velocities by which equations are collected.
    pub velocities: Vec<Expr>,
}

impl Steps {
    /// Adds a step, unless it is empty.
    fn push(&mut self, step: Step) {
        if !step.formulas.is_empty() {
            self.steps.push(step);
        }
    }

    /// Adds equations that hold with rates found before.
    #[must_use]
    pub(crate) fn with_equations(
        mut self,
        kind: StepKind,
        pairs: Vec<(Expr, Expr)>,
        rates: &[(Expr, Expr)],
    ) -> Steps {
        let formula = |(left, right)| StepFormula {
            left,
            right,
            ground: Ground::With(rates.to_vec()),
        };
        let formulas = pairs.into_iter().map(formula).collect();
        let conditions = Vec::new();
        self.push(Step {
            kind,
            formulas,
            conditions,
        });
        self
    }
}
