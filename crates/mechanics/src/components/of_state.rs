//! The component of constraints that are products on which a state lies.

use crate::constraint::{Constraint, ConstraintKind};
use crate::prover::assumptions;
use crate::system::System;
use chetaev_symbolic::factors::{irreducible_factors, quotient};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::Expr;

/// A constraint that is a product, with the one factor that vanishes at a state.
#[derive(Clone, Debug)]
pub struct Factor {
    /// Number of the constraint.
    pub constraint: usize,
    /// The factor that vanishes.
    pub function: Expr,
    /// What it was multiplied by: the multiplier of the factor is that of the constraint times this.
    pub rest: Expr,
    /// The other factors that may vanish.
    pub others: Vec<Other>,
}

/// A factor that does not vanish at a state.
#[derive(Clone, Debug)]
pub struct Other {
    /// The factor.
    pub function: Expr,
    /// Its rate along a motion.
    pub rate: Expr,
    /// Whether it is a function of the place alone: then a state lies on its component only where its rate vanishes too.
    pub is_of_place: bool,
}

impl System {
    /// The system on the component of its constraints on which a state lies, with what was replaced; `vanishes` says of a function
    /// whether it does at the state. `None` where no constraint is a product, and where a state lies on more than one component.
    pub fn on_component_of(
        &self,
        vanishes: &dyn Fn(Expr) -> Option<bool>,
    ) -> Option<(System, Vec<Factor>)> {
        let all = 0..self.constraints.len();
        let products = all.filter_map(|l| Some((l, self.factors_apart(&self.constraints[l])?)));
        let (mut system, mut found) = (self.clone(), Vec::new());
        for (l, all) in products {
            let factor = self.factor_of(l, &all, vanishes)?;
            system = system.with_factor(&factor)?;
            found.push(factor);
        }
        (!found.is_empty()).then_some((system, found))
    }

    /// The system with a factor in the place of its constraint; `None` where it is of another order.
    fn with_factor(&self, factor: &Factor) -> Option<System> {
        let (mut system, stated) = (self.clone(), &self.constraints[factor.constraint]);
        let own = Constraint::classify(self, stated.name.clone(), factor.function).ok()?;
        if own.order != stated.order {
            return None;
        }
        system.constraints[factor.constraint] = own;
        Some(system)
    }

    /// The system, which is on a component of a constraint, on the component of another factor of it, with that factor.
    pub fn on_other_component(&self, factor: &Factor, function: Expr) -> Option<(System, Factor)> {
        let g = &self.graph;
        let is_taken = |other: &&Other| other.function == function;
        let taken = factor.others.iter().find(is_taken)?;
        let left = Other {
            function: factor.function,
            rate: self.total_derivative(factor.function),
            is_of_place: taken.is_of_place,
        };
        let rest = factor.others.iter().filter(|other| !is_taken(other));
        let own = Factor {
            constraint: factor.constraint,
            function,
            rest: quotient(g, g.mul(&[factor.rest, factor.function]), function)?,
            others: rest.cloned().chain([left]).collect(),
        };
        Some((self.with_factor(&own)?, own))
    }

    /// Whether some constraint is a product, of which a motion keeps one factor at zero.
    pub fn has_components(&self) -> bool {
        let mut all = self.constraints.iter();
        all.any(|c| self.factors_apart(c).is_some())
    }

    /// The simple factors of a constraint that may vanish, where they are not the whole of it.
    fn factors_apart(&self, constraint: &Constraint) -> Option<Vec<Expr>> {
        let g = &self.graph;
        let (function, symbols) = match constraint.kind {
            ConstraintKind::Holonomic => (constraint.stated, self.coordinate_symbols()),
            ConstraintKind::Nonlinear => (constraint.f, self.velocity_symbols()),
            _ => return None,
        };
        let all = irreducible_factors(g, function, &symbols)?;
        if all.len() < 2 || all.iter().any(|(_, power)| *power > 1) {
            return None;
        }
        let known = assumptions(self);
        let may_vanish = |e: &Expr| !known_sign(g, *e, &known).is_nonzero();
        Some(all.into_iter().map(|(e, _)| e).filter(may_vanish).collect())
    }

    fn factor_of(
        &self,
        constraint: usize,
        all: &[Expr],
        vanishes: &dyn Fn(Expr) -> Option<bool>,
    ) -> Option<Factor> {
        let own = &self.constraints[constraint];
        let is_of_place = own.kind == ConstraintKind::Holonomic;
        // A state lies on the component of a function of the place where its rate vanishes too.
        let contains =
            |e: Expr| Some(vanishes(e)? && (!is_of_place || vanishes(self.total_derivative(e))?));
        let here = all.iter().map(|&e| contains(e));
        let here: Vec<bool> = here.collect::<Option<_>>()?;
        let place = here.iter().position(|is_here| *is_here)?;
        if here.iter().filter(|is_here| **is_here).count() > 1 {
            return None;
        }
        let function = all[place];
        let stated = if is_of_place { own.stated } else { own.f };
        let others = all.iter().filter(|&&e| e != function);
        let others = others.map(|&function| Other {
            function,
            rate: self.total_derivative(function),
            is_of_place,
        });
        Some(Factor {
            constraint,
            function,
            rest: quotient(&self.graph, stated, function)?,
            others: others.collect(),
        })
    }
}
