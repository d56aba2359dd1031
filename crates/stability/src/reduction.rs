//! The smallest closed system of variables: the quasi-velocities, and the coordinates on which their rates depend.
//!
//! `M P' = b` in independent quasi-velocities P; coordinates on which M and b do not depend are ignorable, and a coordinate that is
//! not ignorable brings its own rate, which may depend on further ones. What is left out moves by quadratures.

use crate::linearization::LinearizationError;
use chetaev_mechanics::characteristics::Characteristics;
use chetaev_mechanics::mass;
use chetaev_mechanics::reduced_equations::ReducedEquations;
use chetaev_mechanics::regular::regular;
use chetaev_mechanics::{MotionTerms, Selection, System};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Verdict};

/// `M P' = b` with the rates of the coordinates that occur.
#[derive(Clone, Debug)]
pub struct ClosedSystem {
    /// The quasi-velocities P.
    pub characteristics: Characteristics,
    /// The coordinates that are not ignorable, ascending.
    pub coordinates: Vec<usize>,
    /// Their rates, functions of the variables.
    pub rates: Vec<Expr>,
    /// M and b.
    pub equations: ReducedEquations,
}

impl ClosedSystem {
    /// The closed system of a system of first order whose masses have no laws of their own.
    ///
    /// # Errors
    /// [`LinearizationError`] where there is none.
    pub fn new(
        system: &System,
        terms: &MotionTerms,
        selection: &Selection,
    ) -> Result<ClosedSystem, LinearizationError> {
        if terms.order > 1 {
            return Err(LinearizationError::OrderTooHigh { order: terms.order });
        }
        if !system.masses.is_empty() || mass::with_velocity(system).is_some() {
            return Err(LinearizationError::MassesMove);
        }
        let characteristics = match regular(system, terms, &selection.rows) {
            Some(found) => found,
            None => Characteristics::independent_velocities(system, terms, selection)?,
        };
        let equations = ReducedEquations::new(system, &characteristics)
            .unwrap_or_else(|| ReducedEquations::of_terms(system, terms, &characteristics));
        Ok(ClosedSystem::closed(system, characteristics, &equations))
    }

    fn closed(
        system: &System,
        characteristics: Characteristics,
        equations: &ReducedEquations,
    ) -> ClosedSystem {
        let g = &system.graph;
        let k = characteristics.k();
        let mut entries = equations.entries();
        let mut coordinates: Vec<usize> = Vec::new();
        while let Some(j) = (0..system.n()).find(|j| {
            !coordinates.contains(j)
                && g.any_contains_any(&entries, &[system.coordinates[*j].q_symbol])
        }) {
            match without(g, &entries, system.coordinates[j].q) {
                Some(free) => entries = free,
                None => {
                    coordinates.push(j);
                    entries.push(characteristics.velocities[j]);
                }
            }
        }
        let rates = entries.split_off(k * k + k);
        let force = entries.split_off(k * k);
        let mut places: Vec<usize> = (0..coordinates.len()).collect();
        places.sort_by_key(|&at| coordinates[at]);
        ClosedSystem {
            rates: places.iter().map(|&at| rates[at]).collect(),
            coordinates: places.iter().map(|&at| coordinates[at]).collect(),
            equations: ReducedEquations {
                mass: entries.chunks(k.max(1)).map(<[Expr]>::to_vec).collect(),
                force,
            },
            characteristics,
        }
    }

    /// The coordinates that are ignorable, ascending.
    pub fn ignorable(&self, system: &System) -> Vec<usize> {
        let all = 0..system.n();
        all.filter(|j| !self.coordinates.contains(j)).collect()
    }
}

/// The expressions with zero for a symbol on which they are proved not to depend.
fn without(g: &Graph, es: &[Expr], symbol: Expr) -> Option<Vec<Expr>> {
    let at_zero = g.substitute_all(es, &[(symbol, g.zero())]);
    let pairs = es.iter().zip(&at_zero);
    let differences: Vec<Expr> = pairs.map(|(&a, &b)| g.sub(a, b)).collect();
    let none = Assumptions::new();
    let test = ZeroTest::everywhere(&differences, &none);
    let options = chetaev_symbolic::zero::Options {
        exact: false,
        refute: false,
        ..test.options
    };
    let verdict = decide_zero(g, &ZeroTest { options, ..test });
    matches!(verdict, Verdict::Proved(_)).then_some(at_zero)
}
