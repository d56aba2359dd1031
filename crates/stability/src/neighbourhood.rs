//! The equations beside a motion, beyond their linear part.

use crate::bundle::minors;
use crate::expansion::Expansion;
use crate::real_roots::sign_of;
use crate::steady::{at_point, closed};
use chetaev_mechanics::constraint::ConstraintKind;
use chetaev_symbolic::node::{Function, Node};
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::cmp::Ordering;

impl Expansion<'_> {
    /// What vanishes at steady motions: the rates of the coordinates that are not ignorable, then b of `M P' = b`.
    pub(crate) fn moving(&self) -> Vec<Expr> {
        [self.own.rates.clone(), self.own.equations.force.clone()].concat()
    }

    /// M of `M z' = (rates, b)` for all variables, at the motion.
    pub(crate) fn masses(&self) -> Vec<Vec<Expr>> {
        let g = self.graph();
        let count = self.own.coordinates.len();
        let n = count + self.own.characteristics.k();
        let mut found = vec![vec![g.zero(); n]; n];
        for (at, row) in found.iter_mut().enumerate() {
            match at.checked_sub(count) {
                None => row[at] = g.one(),
                Some(speed) => {
                    row[count..].copy_from_slice(&self.at(&self.own.equations.mass[speed]));
                }
            }
        }
        found
    }

    /// The values of the variables at the motion.
    pub(crate) fn values_of_variables(&self) -> Vec<Expr> {
        let g = self.graph();
        let variables = self.variables().into_iter();
        self.at(&variables.map(|s| g.symbol_expr(s)).collect::<Vec<_>>())
    }

    /// Functions of the variables where these differ from those of the motion by `deviations`.
    pub(crate) fn beside(&self, es: &[Expr], deviations: &[Expr]) -> Vec<Expr> {
        let g = self.graph();
        let es = g.substitute_all(es, &self.controls(es));
        let places = self.variables().into_iter();
        let values = self.values_of_variables();
        let moved: Vec<(Expr, Expr)> = places
            .zip(values.iter().zip(deviations))
            .map(|(s, (&value, &by))| (g.symbol_expr(s), g.add(&[value, by])))
            .collect();
        let es = g.substitute_all(&es, &moved);
        g.substitute_all(&es, &self.values)
    }

    /// Whether the equations have derivatives of all orders at the motion.
    pub(crate) fn is_smooth(&self) -> bool {
        let g = self.graph();
        let variables = self.variables();
        let all = [self.moving(), self.own.equations.mass.concat()].concat();
        let all = g.substitute_all(&all, &self.controls(&all));
        let nodes = g.reachable(&all).into_iter();
        let mut changing = nodes.filter(|&e| g.contains_any(e, &variables));
        changing.all(|e| match g.node(e) {
            Node::Power { base, exponent } => {
                g.as_integer(*exponent).is_some()
                    || self.is_positive(*base) && !g.contains_any(*exponent, &variables)
            }
            Node::Apply {
                function,
                arguments,
            } => self.is_smooth_there(*function, arguments),
            _ => true,
        })
    }

    fn is_smooth_there(&self, function: Function, arguments: &[Expr]) -> bool {
        let g = self.graph();
        let Some(&x) = arguments.first() else {
            return true;
        };
        let square = g.powi(x, 2);
        match function {
            Function::Abs | Function::Sign => self.is_positive(square),
            Function::Asin | Function::Acos | Function::Atanh => {
                self.is_positive(g.sub(g.one(), square))
            }
            Function::Acosh => self.is_positive(g.sub(x, g.one())),
            Function::Atan2 => false,
            _ => true,
        }
    }

    /// Whether the system is natural, with a positive kinetic energy, forces of a potential and finite constraints only, and the motion rest.
    pub(crate) fn is_natural_at_rest(&self) -> bool {
        let (g, system) = (self.graph(), self.system);
        let velocities: Vec<Symbol> = system.velocity_symbols();
        let momenta = g.gradient(system.lagrangian, &velocities);
        let inertia = g.jacobian(&momenta, &velocities).concat();
        let at_rest: Vec<(Expr, Expr)> =
            system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
        let mut rows = self.selection.rows.iter();
        let speeds = &self.own.equations.mass;
        let mass: Vec<Vec<Expr>> = speeds.iter().map(|row| self.at(row)).collect();
        let is_positive = |e: Expr| sign_of(g, e) == Some(Ordering::Greater);
        let all_velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let mut applied = system.forces.iter().chain(&system.reactive_forces);
        applied.all(|&e| g.is_zero(e))
            && system.rayleigh.is_none()
            && system.mass_functions.is_empty()
            && !g.any_contains_any(&inertia, &velocities)
            && g.substitute_all(&momenta, &at_rest)
                .iter()
                .all(|&e| g.is_zero(closed(g, e)))
            && rows.all(|&row| {
                system.constraints[self.terms.constraint_index[row]].kind
                    == ConstraintKind::Holonomic
            })
            && self.at(&all_velocities).iter().all(|&e| g.is_zero(e))
            && minors(g, &mass).into_iter().all(is_positive)
    }

    fn is_positive(&self, e: Expr) -> bool {
        sign_of(self.graph(), self.at(&[e])[0]) == Some(Ordering::Greater)
    }
}

/// The coefficient of `step` to the power `order` in Taylor's expansion at zero.
pub(crate) fn coefficients_at(g: &Graph, es: &[Expr], step: Symbol, order: usize) -> Vec<Expr> {
    let mut found = es.to_vec();
    let mut factorial = 1_i64;
    for times in 1..=order {
        found = g.derive(&found, &|s| (s == step).then(|| g.one()));
        factorial *= times as i64;
    }
    let nowhere = [(g.symbol_expr(step), g.zero())];
    let values = at_point(g, &found, &[&nowhere]);
    let divided = |e: Expr| closed(g, g.div(e, g.integer(factorial)));
    values.into_iter().map(divided).collect()
}
