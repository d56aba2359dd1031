//! Steady motions as plain data: all of a system, isolated ones and families.

use crate::steady_value::Value;
use chetaev_mechanics::SteadyMotion;
use chetaev_symbolic::{Expr, Graph};

/// Signs of a function that is written.
const LONGEST: usize = 200;

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
    /// Functions in denominators: where one vanishes no choice of independent velocities that was tried serves, and nothing is said.
    pub excluded: Vec<Expr>,
    /// Functions at whose zeros what the model states has no value, so that there are no states of the system.
    pub poles: Vec<Expr>,
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
    /// The motion, where all values are exact: in closed form, or algebraic numbers.
    pub motion: Option<SteadyMotion>,
    /// Whether a real motion of the family is known; isolated ones are real.
    pub is_real: bool,
    /// Whether the mass matrix is singular along it, as where angles are no coordinates: the equations determine no accelerations there.
    pub is_singular: bool,
    /// Whether nothing that the model assumes is proved not to hold along it.
    pub is_assumed: bool,
}

impl SteadySet {
    /// Whether all motions are among those found: nothing is said of no state of the system.
    pub fn is_complete(&self) -> bool {
        self.excluded.is_empty() && self.has_full_rank
    }

    /// Of which states nothing is said, a clause for each kind.
    pub fn left_out(&self, g: &Graph) -> Vec<String> {
        let undefined = "the equations are not defined there";
        let unseen = "the independent velocities that were tried do not serve there";
        let poles = self.poles.iter().map(|e| (e, undefined));
        let excluded = self.excluded.iter().map(|e| (e, unseen));
        let mut all: Vec<String> = poles
            .chain(excluded)
            .map(|(&e, why)| match g.text(e) {
                text if text.len() <= LONGEST => {
                    format!("nothing is said where {text} vanishes: {why}")
                }
                text => format!(
                    "nothing is said where a function of {} signs vanishes, by which was divided",
                    text.len()
                ),
            })
            .collect();
        if !self.has_full_rank {
            all.push("nothing is said of states at which the gradients of the constraints depend on each other".into());
        }
        all
    }

    /// What is known of one of the motions, in words and formulas: values, equations, conditions.
    pub fn parts(&self, g: &Graph, own: &Found) -> Vec<String> {
        let values = self.variables.iter().zip(&own.values).enumerate();
        let values = values.filter_map(|(at, (name, value))| match value {
            Value::Number {
                exact: Some(e),
                ball,
            } if !g.holds_algebraic(*e) => Some(number(g, name, *e, ball.to_f64())),
            Value::Number { ball, .. } => {
                let (low, high) = ball.to_decimal_interval(16);
                Some(format!("{name} in [{low}, {high}]"))
            }
            Value::Function(e) if own.free.iter().any(|(_, free)| *free == at) => {
                Some(format!("{name} = {}, free", g.text(*e)))
            }
            Value::Function(e) => Some(format!("{name} = {}", g.text(*e))),
            Value::Tied => None,
        });
        let mut parts: Vec<String> = values.collect();
        parts.extend(own.equations.iter().map(|&e| format!("{} = 0", g.text(e))));
        let needed = own.conditions.iter();
        parts.extend(needed.map(|&e| format!("where {} >= 0", g.text(e))));
        if !own.is_real {
            parts.push("no real motion of this family was found at the places tried".into());
        }
        if own.is_singular {
            parts.push(
                "the mass matrix is singular there, and the equations determine no accelerations"
                    .into(),
            );
        }
        if !own.is_assumed {
            parts.push("outside of what the model assumes".into());
        }
        parts
    }
}

/// `theta = acos(109/200) = 0.99439…`; a rational number as it is.
fn number(g: &Graph, name: &str, exact: Expr, value: f64) -> String {
    let text = g.text(exact);
    if g.as_number(exact).is_some_and(|r| r.is_int()) {
        format!("{name} = {text}")
    } else {
        format!("{name} = {text} = {value:.12}")
    }
}

impl Found {
    /// The number of free parameters.
    pub fn dimension(&self) -> usize {
        self.free.len()
    }
}
