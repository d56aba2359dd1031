//! Every formulation of the equations of motion, one file each. Adding one is a file and a line in [`FORMULATIONS`].

pub mod boltzmann_hamel;
mod canonical;
mod canonical_reduced;
mod chaplygin;
pub mod gauss;
mod gibbs_appell;
mod inversion;
mod jacobi;
mod kane;
mod lagrange_dalembert;
mod lagrange_vector_field;
pub mod legendre;
mod maggi;
mod newton_euler;
mod nielsen;
mod parametric;
mod parametric_canonical;
mod poincare_chetaev;
pub mod reduced_form;
mod routh;
pub mod state_space;
mod state_space_canonical;
mod vakonomic;
mod volterra;
mod volterra_cartesian;
mod volterra_first;
mod volterra_second;
mod voronets;

pub use boltzmann_hamel::BoltzmannHamel;
pub use canonical::Canonical;
pub use canonical_reduced::{CanonicalReduced, ReducedBracket};
pub use chaplygin::{ignorable, Chaplygin};
pub use gauss::Gauss;
pub use gibbs_appell::GibbsAppell;
pub use jacobi::Jacobi;
pub use kane::Kane;
pub use lagrange_dalembert::LagrangeDalembert;
pub use lagrange_vector_field::LagrangeVectorField;
pub use maggi::Maggi;
pub use newton_euler::NewtonEuler;
pub use nielsen::{nielsen_left_sides, Nielsen};
pub use parametric::Parametric;
pub use parametric_canonical::ParametricCanonical;
pub use poincare_chetaev::PoincareChetaev;
pub use reduced_form::Reduced;
pub use routh::Routh;
pub use state_space::StateSpace;
pub use state_space_canonical::{reactions as reactions_by_momenta, StateSpaceCanonical};
pub use vakonomic::{extremum_matrix, kappa_symbols, Vakonomic};
pub(crate) use volterra::{potential_forces, stated_apart};
pub use volterra_cartesian::{VolterraFirstCartesian, VolterraSecondCartesian};
pub use volterra_first::VolterraFirst;
pub use volterra_second::VolterraSecond;
pub use voronets::Voronets;

pub(crate) use maggi::left_sides as maggi_left_sides;
pub(crate) use reduced_form::characteristics as reduced_characteristics;
pub(crate) use routh::solve as solved_with_multipliers;
pub(crate) use voronets::natural as natural_characteristics;

use crate::card::Card;
use crate::characteristics::{Characteristics, CharacteristicsError, Manifold, Selection};
use crate::equations::{Equation, Equations};
use crate::linear::dot;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::linear::SolveError;
use chetaev_symbolic::Expr;

/// Why a formulation gives no equations although its requirements hold.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DeriveError {
    /// The velocities cannot be parametrized.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// The linear system for the accelerations is structurally singular.
    #[error("the accelerations are not determined: {0}")]
    Singular(#[from] SolveError),
    /// The model does not state what this formulation is built from.
    #[error("the model does not state {0}")]
    NotStated(&'static str),
}

/// What all formulations start from: the system, its terms, and the selected rows and dependent velocities.
#[derive(Debug)]
pub struct Basis<'a> {
    /// The system.
    pub system: &'a System,
    /// Its terms.
    pub terms: &'a MotionTerms,
    /// Independent constraints and dependent velocities.
    pub selection: &'a Selection,
    /// Characteristics the caller insists on; `None` leaves the choice to the formulation.
    pub characteristics: Option<Characteristics>,
}

impl Basis<'_> {
    /// The characteristics the caller insists on, else the quasi-velocities of the model where they fit, else independent
    /// velocities.
    ///
    /// # Errors
    /// [`CharacteristicsError`].
    pub fn characteristics(&self) -> Result<Characteristics, CharacteristicsError> {
        if let Some(given) = &self.characteristics {
            return Ok(given.clone());
        }
        match Characteristics::quasi_velocities(self.system, self.terms, self.selection) {
            Some(Ok(quasi)) => Ok(quasi),
            _ => self.independent_velocities(),
        }
    }

    /// Kinematic characteristics: the formulas of the model where it states any, else as
    /// [`characteristics`](Basis::characteristics).
    ///
    /// # Errors
    /// [`CharacteristicsError`].
    pub fn kinematic_characteristics(&self) -> Result<Characteristics, CharacteristicsError> {
        if self.characteristics.is_none() {
            if let Some(stated) = Characteristics::stated(self.system, self.terms, self.selection) {
                return stated;
            }
        }
        self.characteristics()
    }

    /// Characteristics by independent velocities.
    ///
    /// # Errors
    /// [`CharacteristicsError`].
    pub fn independent_velocities(&self) -> Result<Characteristics, CharacteristicsError> {
        Characteristics::independent_velocities(self.system, self.terms, self.selection)
    }

    /// The constraints of the selected rows as functions of (q, v, t).
    pub fn constraints(&self) -> Vec<Expr> {
        let rows = self.selection.rows.iter();
        rows.map(|&row| self.terms.constraints[row]).collect()
    }

    /// The gradients ∂f/∂v of the selected rows.
    pub fn jacobian(&self) -> Vec<Vec<Expr>> {
        let rows = self.selection.rows.iter();
        rows.map(|&row| self.terms.jacobian[row].clone()).collect()
    }

    /// Indices in the system of the constraints of the selected rows.
    pub fn constraint_indices(&self) -> Vec<usize> {
        let rows = self.selection.rows.iter();
        rows.map(|&row| self.terms.constraint_index[row]).collect()
    }

    /// Names of the constraints of the selected rows.
    pub fn constraint_names(&self) -> Vec<&str> {
        let indices = self.constraint_indices().into_iter();
        indices
            .map(|l| self.system.constraints[l].name.as_str())
            .collect()
    }

    /// `lambda_NAME` of the selected rows.
    pub fn multiplier_names(&self) -> Vec<String> {
        let names = self.constraint_names().into_iter();
        names.map(|name| format!("lambda_{name}")).collect()
    }

    /// The symbols `lambda_NAME` of the selected rows.
    pub fn lambda_symbols(&self) -> Vec<Expr> {
        let names = self.multiplier_names().into_iter();
        names
            .map(|name| self.system.graph.symbol(&name, 0))
            .collect()
    }

    /// `w_i − Σ_l λ_l ∂f^l/∂q^i(m)` with the multipliers as symbols, length n: what vanishes by the equations of motion.
    pub fn balance(&self) -> Vec<Expr> {
        let sides = self.system.motion_left_sides().into_iter();
        sides
            .zip(self.reactions())
            .map(|(w, reaction)| self.system.graph.sub(w, reaction))
            .collect()
    }

    /// `Q_i + Σ_l λ_l ∂f^l/∂v^i` with the multipliers as symbols, length n.
    pub fn forces_with_reactions(&self) -> Vec<Expr> {
        let g = &self.system.graph;
        let forces = self.system.forces.iter().zip(self.reactions());
        forces.map(|(&q, reaction)| g.add(&[q, reaction])).collect()
    }

    /// `Σ_l λ_l ∂f^l/∂v^i` with the multipliers as symbols, length n.
    pub fn reactions(&self) -> Vec<Expr> {
        let (lambdas, jacobian) = (self.lambda_symbols(), self.jacobian());
        let column = |i: usize| jacobian.iter().map(move |row| &row[i]);
        (0..self.system.n())
            .map(|i| dot(&self.system.graph, &lambdas, column(i)))
            .collect()
    }

    /// The constraints of the selected rows in other variables, as equations `left = 0`.
    pub fn constraints_as(&self, lefts: &[Expr]) -> Vec<Equation> {
        let names = self.constraint_names().into_iter().zip(lefts);
        names
            .map(|(name, &left)| Equation {
                label: name.to_owned(),
                left,
                right: self.system.graph.zero(),
            })
            .collect()
    }

    /// The constraints as stated, as equations `left - right = 0`.
    pub fn constraint_equations(&self) -> Vec<Equation> {
        let zero = self.system.graph.zero();
        self.constraint_indices()
            .into_iter()
            .map(|l| &self.system.constraints[l])
            .map(|constraint| Equation {
                label: constraint.name.clone(),
                left: constraint.stated,
                right: zero,
            })
            .collect()
    }

    /// The kinematics `q' = φ(q, P, t)` of the coordinates whose velocity is no parameter, and implicit constraints.
    pub fn kinematics(&self, characteristics: &Characteristics) -> Vec<Equation> {
        let zero = self.system.graph.zero();
        let coordinates = characteristics.jets.iter();
        let explicit = coordinates
            .zip(&characteristics.velocities)
            .filter(|(c, phi)| c.v != **phi)
            .map(|(c, &phi)| Equation {
                label: c.name.clone(),
                left: c.v,
                right: phi,
            });
        let implicit = characteristics.implicit().map(|(f, _)| Equation {
            label: "constraint".into(),
            left: f,
            right: zero,
        });
        explicit.chain(implicit).collect()
    }
}

/// An identity that holds before any equation of motion is used.
#[derive(Clone, Debug)]
pub struct Identity {
    /// What is identical, in words and formulas.
    pub statement: String,
    /// What must vanish.
    pub residuals: Vec<Expr>,
    /// What ties the symbols in them.
    pub manifold: Manifold,
    /// Where it holds.
    pub on: &'static str,
}

/// One way of writing the equations of motion of a constrained system.
pub trait Formulation: Sync {
    /// What it is.
    fn card(&self) -> &'static Card;

    /// Derives the equations by the formulation's own rule.
    ///
    /// # Errors
    /// [`DeriveError`].
    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError>;

    /// The identities of `formulation.identity#NAME`, those the theory gives beyond equivalence; none by default.
    ///
    /// # Errors
    /// [`DeriveError`].
    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let _ = basis;
        Ok(Vec::new())
    }

    /// The lemmas and special cases of `formulation.identity#NAME-special`; none by default.
    ///
    /// # Errors
    /// [`DeriveError`].
    fn special_identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let _ = basis;
        Ok(Vec::new())
    }

    /// Why the equations equal those of another formulation by construction, for this system; `None` where the equality is a
    /// test of both.
    fn structural(&self, basis: &Basis<'_>) -> Option<&'static str> {
        let _ = basis;
        None
    }
}

/// The registry.
pub static FORMULATIONS: &[&dyn Formulation] = &[
    &Routh,
    &LagrangeDalembert,
    &NewtonEuler,
    &Maggi,
    &Reduced,
    &Voronets,
    &Chaplygin,
    &VolterraFirst,
    &VolterraSecond,
    &VolterraFirstCartesian,
    &VolterraSecondCartesian,
    &Nielsen,
    &GibbsAppell,
    &Kane,
    &Gauss,
    &PoincareChetaev,
    &BoltzmannHamel,
    &LagrangeVectorField,
    &Canonical,
    &CanonicalReduced,
    &StateSpace,
    &StateSpaceCanonical,
    &Parametric,
    &ParametricCanonical,
    &Jacobi,
    &Vakonomic,
];

/// The formulation called `name`.
pub fn formulation(name: &str) -> Option<&'static dyn Formulation> {
    FORMULATIONS.iter().copied().find(|f| f.card().name == name)
}

/// The name of a parameter as a subscript: `x'` is `x`.
pub(crate) fn bare(name: &str) -> &str {
    name.trim_end_matches('\'')
}
