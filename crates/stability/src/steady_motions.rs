//! Steady motions as plain data: all of a system, isolated ones and families.

use crate::steady_value::Value;
use chetaev_mechanics::SteadyMotion;
use chetaev_symbolic::Expr;

/// All steady motions.
#[derive(Clone, Debug)]
pub struct SteadySet {
    /// The variables that are constant: coordinates that are not ignorable, then quasi-velocities.
    pub variables: Vec<String>,
    /// The quasi-velocities as functions of the velocities, by name.
    pub speeds: Vec<(String, Expr)>,
    /// Coordinates that run uniformly, or stand.
    pub ignorable: Vec<String>,
    /// The motions: isolated ones first, then families by their dimension.
    pub found: Vec<Found>,
    /// Functions in denominators: where one vanishes the equations are not defined, and nothing is said.
    pub excluded: Vec<Expr>,
    /// Whether the gradients of the constraints are proved independent everywhere; else nothing is said where they are not.
    pub has_full_rank: bool,
}

/// An isolated steady motion, or a family of them.
#[derive(Clone, Debug)]
pub struct Found {
    /// Its number, as a name.
    pub name: String,
    /// The variables, in the order of [`SteadySet::variables`].
    pub values: Vec<Value>,
    /// Parameters of the family, each with the variable whose value it is.
    pub free: Vec<(Expr, usize)>,
    /// What must not be negative for the motion to be real.
    pub conditions: Vec<Expr>,
    /// Equations between the variables that are not solved.
    pub equations: Vec<Expr>,
    /// The motion, where all values have a closed form.
    pub motion: Option<SteadyMotion>,
    /// Whether a real motion of the family is known; isolated ones are real.
    pub is_real: bool,
    /// Whether the mass matrix is singular along it, as where angles are no coordinates: the equations determine no accelerations there.
    pub is_singular: bool,
    /// Whether nothing that the model assumes is proved not to hold along it.
    pub is_assumed: bool,
}

impl Found {
    /// The number of free parameters.
    pub fn dimension(&self) -> usize {
        self.free.len()
    }
}
