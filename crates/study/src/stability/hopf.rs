//! Which orbits are born where a pair of eigenvalues passes the imaginary axis.

use super::Stability;
use chetaev_mechanics::Prepared;
use chetaev_orbits::flow::Coordinates;
use chetaev_orbits::hopf::{first_lyapunov, FirstLyapunov, WithoutLyapunov};
use chetaev_orbits::Flow;
use chetaev_stability::hurwitz::{Boundary, Crossing};
use chetaev_stability::question::values_at;
use chetaev_stability::steady::numbers;
use chetaev_symbolic::{Rational, Symbol};

impl Stability {
    /// What is known of the first Lyapunov coefficient at a boundary, in numbers; `None` where no pair passes there.
    pub fn first_lyapunov(
        &self,
        boundary: &Boundary,
    ) -> Option<Result<FirstLyapunov, WithoutLyapunov>> {
        let over = self.question.over?;
        let is_pair = boundary.crossing == Crossing::Pair;
        is_pair.then(|| {
            let found = self.at_pair(over, boundary);
            found.unwrap_or(Err(WithoutLyapunov::NoDerivatives))
        })
    }

    fn at_pair(
        &self,
        over: Symbol,
        boundary: &Boundary,
    ) -> Option<Result<FirstLyapunov, WithoutLyapunov>> {
        let middle = (&boundary.root.low + &boundary.root.high) / Rational::from(2);
        let system = &self.system;
        let Prepared {
            terms, selection, ..
        } = Prepared::new(system).ok()?;
        let values = values_at(system, over, system.graph.number(middle.clone()));
        let rows = (&selection.rows[..], &values[..]);
        let point = numbers(&self.motion, system, &terms, rows).ok()?;
        let which = (Coordinates::NotIgnorable, &point[..]);
        let mut flow = Flow::of_system(system, &terms, &selection, which).ok()?;
        if let Some(place) = flow.place(over) {
            flow.parameters[place].1 = middle.to_f64().value();
        }
        let state = flow.state(&point).ok()?;
        let units = flow.units_near(&state);
        let (flow, state) = (flow.in_units(&units), units.packed(&state));
        let parameters: Vec<f64> = flow.parameters.iter().map(|own| own.1).collect();
        let slopes = flow.slopes(&state, &parameters)?;
        let about = (&slopes, self.question.linear.family);
        let found = first_lyapunov(&flow, (&state, &parameters), about);
        Some(found.map(|own| FirstLyapunov {
            frequency: own.frequency * units.rate,
            ..own
        }))
    }
}
