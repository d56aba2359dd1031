//! The spaces on which forms live.

use super::form::Form;
use chetaev_mechanics::characteristics::Direction;
use chetaev_mechanics::{Characteristics, System};
use chetaev_symbolic::{Expr, Graph};
use std::collections::BTreeMap;

/// J¹ with coordinates (t, q, v), or N with (t, q, η).
#[derive(Clone, Copy, Debug)]
pub enum Space<'a> {
    /// J¹, of dimension 2n + 1.
    Jet(&'a System),
    /// N in a chart, of dimension 1 + n + k.
    Constraint(&'a System, &'a Characteristics),
}

impl<'a> Space<'a> {
    /// The system.
    pub fn system(&self) -> &'a System {
        match self {
            Space::Jet(system) | Space::Constraint(system, _) => system,
        }
    }

    /// The graph of all coefficients.
    pub fn graph(&self) -> &'a Graph {
        &self.system().graph
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        let n = self.system().n();
        match self {
            Space::Jet(_) => 2 * n + 1,
            Space::Constraint(_, chart) => 1 + n + chart.k(),
        }
    }

    /// The derivatives of functions by the coordinates: one row for each function. Controls u(t) and masses with a law of their own
    /// move with the time.
    pub fn partials(&self, es: &[Expr]) -> Vec<Vec<Expr>> {
        let columns: Vec<Vec<Expr>> = (0..self.dimension())
            .map(|place| self.partial(es, place))
            .collect();
        (0..es.len())
            .map(|i| columns.iter().map(|column| column[i]).collect())
            .collect()
    }

    fn partial(&self, es: &[Expr], place: usize) -> Vec<Expr> {
        let (system, g) = (self.system(), self.graph());
        let n = system.n();
        match self {
            Space::Jet(_) => g.derive(es, &|s| {
                let own = system.coordinates.iter();
                let found = match place {
                    0 => return system.prescribed_rate(s),
                    p if p <= n => own.skip(p - 1).map(|c| c.q_symbol).next(),
                    p => own.skip(p - 1 - n).map(|c| c.v_symbol).next(),
                };
                (found == Some(s)).then(|| g.one())
            }),
            Space::Constraint(_, chart) => {
                let unit = |size: usize, one: Option<usize>| -> Vec<Expr> {
                    let entry = |i| if Some(i) == one { g.one() } else { g.zero() };
                    (0..size).map(entry).collect()
                };
                let direction = Direction {
                    time: if place == 0 { g.one() } else { g.zero() },
                    coordinates: unit(n, place.checked_sub(1).filter(|&i| i < n)),
                    parameters: unit(chart.k(), place.checked_sub(1 + n)),
                };
                chart.along(system, es, &direction)
            }
        }
    }

    /// A function as a form of degree zero.
    pub fn function(&self, e: Expr) -> Form {
        Form::new(0, BTreeMap::from([(Vec::new(), e)]), self.graph())
    }

    /// A 1-form by its components, one for each coordinate.
    pub fn one_form(&self, components: &[Expr]) -> Form {
        let terms = components.iter().enumerate();
        let terms = terms.map(|(place, &e)| (vec![place], e)).collect();
        Form::new(1, terms, self.graph())
    }

    /// The differential of a coordinate.
    pub fn differential(&self, place: usize) -> Form {
        let g = self.graph();
        Form::new(1, BTreeMap::from([(vec![place], g.one())]), g)
    }

    /// The form on N that a form on J¹ induces; itself on J¹.
    pub fn pulled_back(&self, form: &Form) -> Form {
        let Space::Constraint(system, chart) = self else {
            return form.clone();
        };
        let (g, n) = (self.graph(), system.n());
        let rates: Vec<Form> = self
            .partials(&chart.velocities)
            .iter()
            .map(|row| self.one_form(row))
            .collect();
        let mut sum = Form::new(form.degree(), BTreeMap::new(), g);
        for (places, &coefficient) in form.terms() {
            let restricted = chart.restrict(system, &[coefficient]);
            let mut part = self.function(restricted[0]);
            for &place in places {
                let factor = match place.checked_sub(1 + n) {
                    None => self.differential(place),
                    Some(velocity) => rates[velocity].clone(),
                };
                part = part.wedge(g, &factor);
            }
            sum = sum.plus(g, &part);
        }
        sum
    }
}
