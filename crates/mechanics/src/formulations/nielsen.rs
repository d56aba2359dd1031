//! Nielsen's equations, in the coordinates with multipliers and on the constraint manifold without.
//!
//! `∂(D L)/∂v^i - 2 ∂L/∂q^i = Q_i + Σ λ_l ∂f^l/∂v^i` (T1 (52) with m = 1), and
//! `∂(D L̄)/∂P_σ - 2 ∂L̄/∂π_σ - Σ_i p_i ( D B_iσ - ∂φ^i/∂π_σ ) = Σ_i Q_i B_iσ`, which in the natural frame is T1 (53), in a
//! moving one T3 (12) with the brackets in coordinates. `D L̄` is differentiated with the rates P' frozen: with the
//! accelerations of the motion put in before, the form is wrong.

use super::volterra::quasi_slopes;
use super::{bare, Basis, DeriveError, Formulation, Identity};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::{Characteristics, Manifold};
use crate::curvature::brackets;
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::linear::dot;
use crate::system::System;
use chetaev_symbolic::{Expr, Symbol};

/// Nielsen's equations.
#[derive(Clone, Copy, Debug)]
pub struct Nielsen;

static CARD: Card = Card {
    name: "nielsen",
    title: "Nielsen's equations",
    statement: "The rate of the Lagrangian, differentiated by the velocities with the accelerations frozen, in the place of the rates of the momenta.",
    principle: Principle::DalembertLagrangeChetaev,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.masses-free-of-velocity"],
    identity: Some("Nielsen's and Tsenov's left sides are Lagrange's on the whole jet"),
    unknowns: "rates of the k kinematic parameters",
    highest_order: 1,
    sources: &[
        Source { key: "nielsen1935", place: "part on Lagrange's equations" },
        Source { key: "tzenoff1924", place: "§ 1" },
        Source { key: "zhao", place: "the form without multipliers, with the corrected bracket" },
    ],
};

const COORDINATES: Schema = Schema {
    text: "∂(D L)/∂v^i − 2 ∂L/∂q^i = Q_i + Σ_l λ_l ∂f^l/∂v^i",
    latex: r"\frac{\partial \dot L}{\partial \dot q^i} - 2 \frac{\partial L}{\partial q^i} = Q_i + \sum_l \lambda_l \frac{\partial f^l}{\partial \dot q^i}",
};

const REDUCED: Schema = Schema {
    text: "∂(D L*)/∂P_σ − 2 ∂L*/∂π_σ = Σ_i p_i A^i_σ + Σ_i Q_i ∂v^i/∂P_σ",
    latex: r"\frac{\partial \dot L^*}{\partial P_\sigma} - 2 \frac{\partial L^*}{\partial \pi_\sigma} = \sum_i p_i A^i_\sigma + \sum_i Q_i \frac{\partial \dot q^i}{\partial P_\sigma}",
};

impl Formulation for Nielsen {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, characteristics) = (basis.system, basis.characteristics()?);
        let reduced = Reduced::new(system, &characteristics);
        let motion = reduced.equations(system, &characteristics);
        let rates = characteristics.rates_of(system, &motion)?;
        Ok(
            Equations::in_characteristics(CARD.name, system, &characteristics, &rates)
                .with_group(
                    "equations with multipliers",
                    Some(COORDINATES),
                    in_coordinates(basis),
                )
                .with_group(
                    "equations on the constraint manifold",
                    Some(REDUCED),
                    motion,
                )
                .with_group("kinematics", None, basis.kinematics(&characteristics))
                .with_objects(reduced.objects(system, &characteristics)),
        )
    }

    fn identities(&self, basis: &Basis<'_>) -> Result<Vec<Identity>, DeriveError> {
        let g = &basis.system.graph;
        let lagrange = basis.system.lagrange_left_sides();
        let of_order = |order: u32, statement: &str| Identity {
            statement: statement.into(),
            residuals: nielsen_left_sides(basis.system, order)
                .into_iter()
                .zip(&lagrange)
                .map(|(left, &right)| g.sub(left, right))
                .collect(),
            manifold: Manifold::default(),
            on: "identically on the jet (t, q, v, a, a')",
        };
        Ok(vec![
            of_order(1, "∂(D L)/∂v^i − 2 ∂L/∂q^i = D p_i − ∂L/∂q^i (Nielsen)"),
            of_order(
                2,
                "( ∂(D² L)/∂a^i − 3 ∂L/∂q^i )/2 = D p_i − ∂L/∂q^i (Tsenov)",
            ),
        ])
    }
}

/// `( ∂(D^m L)/∂q^i(m) - (m + 1) ∂L/∂q^i )/m` for m ≥ 1 with all derivatives of q independent, length n: Lagrange's left sides
/// in Nielsen's form (m = 1), in Tsenov's (m = 2) and further ones (T1 (52)). Order 0 counts as 1.
pub fn nielsen_left_sides(system: &System, order: u32) -> Vec<Expr> {
    let g = &system.graph;
    let m = order.max(1);
    let mut rate = system.lagrangian;
    for _ in 0..m {
        // A mass with a law of its own is a function of the time here: its rates are not differentiated by those of q.
        rate = g.total_derivative(rate, &|name| system.moves(name));
    }
    let top: Vec<Symbol> = system
        .coordinates
        .iter()
        .map(|c| g.intern_symbol(&c.name, m))
        .collect();
    let factor = g.integer(i64::from(m) + 1);
    let slopes = g.substitute_all(&g.gradient(rate, &top), &mass_derivatives(system, m));
    slopes
        .into_iter()
        .zip(g.gradient(system.lagrangian, &system.coordinate_symbols()))
        .map(|(slope, force)| {
            let numerator = g.sub(slope, g.mul(&[factor, force]));
            g.div(numerator, g.integer(i64::from(m)))
        })
        .collect()
}

/// M', M'', … up to the order m with what they are by the laws of the masses.
fn mass_derivatives(system: &System, m: u32) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let mut pairs = Vec::new();
    for mass in &system.masses {
        let mut value = mass.expr;
        for order in 1..=m {
            value = system.total_derivative(value);
            pairs.push((g.symbol(&mass.name, order), value));
        }
    }
    pairs
}

fn in_coordinates(basis: &Basis<'_>) -> Vec<Equation> {
    let system = basis.system;
    let lefts = nielsen_left_sides(system, 1);
    Equation::of_coordinates(system, lefts, basis.forces_with_reactions())
}

/// The parts of the form on the constraint manifold.
struct Reduced {
    /// L*, as a function of (t, q, P).
    lagrangian: Expr,
    /// D L* on the jet (t, q, P, P').
    rate: Expr,
    /// p_i of the full Lagrangian, restricted; length n.
    momenta: Vec<Expr>,
    /// D B_iσ - ∂φ^i/∂π_σ, n × k.
    brackets: Vec<Vec<Expr>>,
}

impl Reduced {
    fn new(system: &System, c: &Characteristics) -> Reduced {
        let g = &system.graph;
        let mut functions = vec![system.lagrangian];
        functions.extend(g.gradient(system.lagrangian, &system.velocity_symbols()));
        let mut restricted = c.restrict(system, &functions);
        let momenta = restricted.split_off(1);
        let rates = c.total_derivative(system, &restricted);
        Reduced {
            lagrangian: restricted[0],
            rate: rates[0],
            momenta,
            brackets: brackets(system, c),
        }
    }

    fn equations(&self, system: &System, c: &Characteristics) -> Vec<Equation> {
        let g = &system.graph;
        let slopes = c.by_parameters(system, &[self.rate]).concat();
        let held = self.by_mass_rates(system, c);
        let along = c.by_quasi_coordinates(system, &[self.lagrangian]).concat();
        let forces = c.restrict(system, &system.forces);
        let work = c.contract(system, &forces);
        let two = g.integer(2);
        c.parameters
            .iter()
            .enumerate()
            .map(|(sigma, p)| {
                let mut right = vec![work[sigma]];
                for (&momentum, row) in self.momenta.iter().zip(&self.brackets) {
                    if !g.is_zero(row[sigma]) {
                        right.push(g.mul(&[momentum, row[sigma]]));
                    }
                }
                Equation {
                    label: p.name.clone(),
                    left: g.add(&[
                        slopes[sigma],
                        g.neg(held[sigma]),
                        g.neg(g.mul(&[two, along[sigma]])),
                    ]),
                    right: g.add(&right),
                }
            })
            .collect()
    }

    /// `Σ_a ∂L*/∂M_a ∂M_a'/∂P_σ`: what D L* depends on the parameters through the rates of masses, which are functions of the
    /// time for the rule of Nielsen.
    fn by_mass_rates(&self, system: &System, c: &Characteristics) -> Vec<Expr> {
        let g = &system.graph;
        let (symbols, rates): (Vec<Symbol>, Vec<Expr>) =
            system.mass_rates(&c.velocities).into_iter().unzip();
        let slopes = g.gradient(self.lagrangian, &symbols);
        let rows = c.by_parameters(system, &rates);
        (0..c.k())
            .map(|sigma| dot(g, &slopes, rows.iter().map(|row| &row[sigma])))
            .collect()
    }

    fn objects(&self, system: &System, c: &Characteristics) -> Vec<NamedExpr> {
        let g = &system.graph;
        let mut objects = vec![
            NamedExpr::new(
                "Lstar",
                self.lagrangian,
                "Lagrangian on the constraint manifold",
            ),
            NamedExpr::new(
                "DLstar",
                self.rate,
                "its total derivative, with free rates of the parameters",
            ),
        ];
        let of = ("Lstar", "L*");
        objects.extend(quasi_slopes(system, c, of, self.lagrangian));
        let coordinates = system.coordinates.iter().zip(&self.momenta);
        for ((coordinate, &momentum), row) in coordinates.zip(&self.brackets) {
            let name = &coordinate.name;
            if row.iter().all(|&e| g.is_zero(e)) {
                continue;
            }
            let meaning = format!("∂L/∂{name}' of the full Lagrangian, restricted");
            objects.push(NamedExpr::new(format!("p_{name}"), momentum, meaning));
            for (p, &value) in c.parameters.iter().zip(row) {
                if !g.is_zero(value) {
                    let sigma = bare(&p.name);
                    let meaning = format!("curvature: D(∂{name}'/∂({})) − ∂{name}'/∂π", p.name);
                    let object = NamedExpr::new(format!("A_{name}_{sigma}"), value, meaning);
                    objects.push(object.with_indices("A", &[name], &[sigma]));
                }
            }
        }
        objects
    }
}
