//! Voronets' equations, and Chaplygin's, which are theirs without the terms of the dependent coordinates.
//!
//! `D(∂L*/∂v^s) - ∂L*/∂q^s - Σ_m ∂L*/∂q^{k+m} ∂φ^m/∂v^s = Σ_l θ_l A^l_s + Q_s + Σ_m Q_{k+m} ∂φ^m/∂v^s` (T1 (9)).
//! The momenta θ_l of the dependent velocities are those of the full Lagrangian, restricted afterwards.

use super::{bare, Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Characteristics;
use crate::curvature::curvature;
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// Voronets' equations.
#[derive(Clone, Copy, Debug)]
pub struct Voronets;

static CARD: Card = Card {
    name: "voronets",
    title: "Voronets' equations",
    statement: "Lagrange's equations of the independent coordinates for the restricted Lagrangian, with the curvature of the constraints on the right.",
    principle: Principle::Hamilton,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "accelerations of the k independent coordinates",
    highest_order: 1,
    sources: &[
        Source { key: "voronets1901", place: "§§ 1–3" },
        Source { key: "rumyantsev1982", place: "Hamilton's principle in the form of Voronets; T1 (7) and (9)" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "D(∂L*/∂v^s) − ∂L*/∂q^s − Σ_m ∂L*/∂q^{k+m} ∂φ^m/∂v^s = Σ_l θ_l A^l_s + Q_s + Σ_m Q_{k+m} ∂φ^m/∂v^s",
    latex: r"\frac{d}{dt}\frac{\partial L^*}{\partial \dot q^s} - \frac{\partial L^*}{\partial q^s} - \sum_m \frac{\partial L^*}{\partial q^{k+m}} \frac{\partial \varphi^m}{\partial \dot q^s} = \sum_l \theta_l A^l_s + Q_s + \sum_m Q_{k+m} \frac{\partial \varphi^m}{\partial \dot q^s}",
};

impl Formulation for Voronets {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let characteristics = natural(basis)?;
        let restricted = Restricted::new(basis.system, &characteristics);
        let slopes = characteristics.by_quasi_coordinates(basis.system, &[restricted.lagrangian]);
        restricted.equations(
            (CARD.name, SCHEMA),
            basis,
            &characteristics,
            &slopes.concat(),
        )
    }
}

/// Characteristics by independent velocities: those the caller insists on where they are of this kind, else those of the
/// selection.
pub(crate) fn natural(basis: &Basis<'_>) -> Result<Characteristics, DeriveError> {
    match &basis.characteristics {
        Some(given) if given.frame.is_natural(basis.system) => Ok(given.clone()),
        _ => Ok(basis.independent_velocities()?),
    }
}

/// What the equations of Voronets, Chaplygin and Nielsen are made of, in the natural frame.
pub(crate) struct Restricted {
    /// L*, the Lagrangian with the dependent velocities eliminated.
    pub(crate) lagrangian: Expr,
    /// θ_l: the momenta of the dependent velocities from the full L, restricted afterwards; in the order of `dependent`.
    pub(crate) momenta: Vec<Expr>,
    /// A^l_s, r × k.
    pub(crate) curvature: Vec<Vec<Expr>>,
}

impl Restricted {
    pub(crate) fn new(system: &System, characteristics: &Characteristics) -> Restricted {
        let dependent: Vec<Symbol> = characteristics
            .dependent
            .iter()
            .map(|&d| system.coordinates[d].v_symbol)
            .collect();
        let mut functions = vec![system.lagrangian];
        functions.extend(system.graph.gradient(system.lagrangian, &dependent));
        let mut restricted = characteristics.restrict(system, &functions);
        let momenta = restricted.split_off(1);
        Restricted {
            lagrangian: restricted[0],
            momenta,
            curvature: curvature(system, characteristics),
        }
    }

    /// The equations whose left sides are `D(∂L*/∂v^s)` minus the slopes.
    pub(crate) fn equations(
        &self,
        (name, schema): (&'static str, Schema),
        basis: &Basis<'_>,
        characteristics: &Characteristics,
        slopes: &[Expr],
    ) -> Result<Equations, DeriveError> {
        let (system, g) = (basis.system, &basis.system.graph);
        let momenta = characteristics.by_parameters(system, &[self.lagrangian]);
        let rates = characteristics.total_derivative(system, &momenta.concat());
        let left = rates.iter().zip(slopes).map(|(&a, &b)| g.sub(a, b));
        let right = self.right_sides(system, characteristics);
        let motion: Vec<Equation> = left
            .zip(right)
            .zip(&characteristics.parameters)
            .map(|((left, right), p)| Equation {
                label: bare(&p.name).to_string(),
                left,
                right,
            })
            .collect();
        let rates = characteristics.rates_of(system, &motion)?;
        Ok(
            Equations::in_characteristics(name, system, characteristics, &rates)
                .with_group("equations of motion", Some(schema), motion)
                .with_group("kinematics", None, basis.kinematics(characteristics))
                .with_objects(self.objects(system, characteristics)),
        )
    }

    /// `Σ_l θ_l A^l_s + Q_s + Σ_m Q_{k+m} ∂φ^m/∂v^s`, s = 1..k.
    pub(crate) fn right_sides(
        &self,
        system: &System,
        characteristics: &Characteristics,
    ) -> Vec<Expr> {
        let g = &system.graph;
        let forces = characteristics.restrict(system, &system.forces);
        let work = characteristics.contract(system, &forces);
        let mut right = work;
        for (s, right) in right.iter_mut().enumerate() {
            let mut parts = vec![*right];
            for (&theta, row) in self.momenta.iter().zip(&self.curvature) {
                parts.push(g.mul(&[theta, row[s]]));
            }
            *right = g.add(&parts);
        }
        right
    }

    /// L*, θ_l, and the A^l_s that do not vanish.
    pub(crate) fn objects(
        &self,
        system: &System,
        characteristics: &Characteristics,
    ) -> Vec<NamedExpr> {
        let name = |d: usize| system.coordinates[d].name.as_str();
        let mut objects = vec![NamedExpr::new(
            "Lstar",
            self.lagrangian,
            "Lagrangian with the dependent velocities eliminated",
        )];
        for (&d, &theta) in characteristics.dependent.iter().zip(&self.momenta) {
            let meaning = format!("∂L/∂{}' of the full Lagrangian, restricted", name(d));
            objects.push(NamedExpr::new(format!("theta_{}", name(d)), theta, meaning));
        }
        for (&d, row) in characteristics.dependent.iter().zip(&self.curvature) {
            for (p, &value) in characteristics.parameters.iter().zip(row) {
                if !system.graph.is_zero(value) {
                    let (l, s) = (name(d), bare(&p.name));
                    let meaning = format!("curvature coefficient of {l}' by δ{s}");
                    let object = NamedExpr::new(format!("A_{l}_{s}"), value, meaning);
                    objects.push(object.with_indices("A", &[l], &[s]));
                }
            }
        }
        objects
    }
}
