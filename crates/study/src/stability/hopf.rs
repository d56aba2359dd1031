//! Which orbits are born where a pair of eigenvalues passes the imaginary axis.

use super::Stability;
use chetaev_mechanics::Prepared;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::hopf::{first_lyapunov, FirstLyapunov};
use chetaev_orbits::Flow;
use chetaev_stability::hurwitz::{Boundary, Crossing};
use chetaev_stability::question::values_at;
use chetaev_stability::steady::numbers;
use chetaev_symbolic::Rational;

impl Stability {
    /// Why there is no first Lyapunov coefficient where a pair passes the axis.
    pub fn without_first_lyapunov(&self, boundary: &Boundary) -> Option<&'static str> {
        if boundary.crossing != Crossing::Pair || self.first_lyapunov(boundary).is_some() {
            return None;
        }
        Some(match self.question.linear.family {
            0 => "the first Lyapunov coefficient was not computed: the equations have no explicit form there, or a zero eigenvalue stands beside the pair",
            _ => "the first Lyapunov coefficient was not computed: the motion belongs to a family of steady motions, whose zero eigenvalue stands beside the pair, and it is defined without one only",
        })
    }

    /// The first Lyapunov coefficient at a boundary, in numbers; `None` where no pair passes there, and where a zero of the family stands beside
    /// the pair.
    pub fn first_lyapunov(&self, boundary: &Boundary) -> Option<FirstLyapunov> {
        let over = self.question.over?;
        if boundary.crossing != Crossing::Pair || self.question.linear.family > 0 {
            return None;
        }
        let middle = (&boundary.root.low + &boundary.root.high) / Rational::from(2);
        let system = &self.system;
        let Prepared { terms, selection } = Prepared::new(system).ok()?;
        let values = values_at(system, over, system.graph.number(middle.clone()));
        let rows = (&selection.rows[..], &values[..]);
        let point = numbers(&self.motion, system, &terms, rows).ok()?;
        let which = (Coordinates::NotIgnorable, &point[..]);
        let mut flow = Flow::of_system(system, &terms, &selection, which).ok()?;
        if let Some(place) = flow.place(over) {
            flow.parameters[place].1 = middle.to_f64().value();
        }
        let state = flow.state(&point).ok()?;
        let parameters: Vec<f64> = flow.parameters.iter().map(|own| own.1).collect();
        let slopes = flow.slopes(&state, &parameters)?;
        first_lyapunov(&flow, (&state, &parameters), &slopes)
    }
}
