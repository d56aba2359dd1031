//! Kane's equations.
//!
//! `F_σ + F*_σ = 0` with generalized speeds P, partial velocities `∂r_a'/∂P_σ`, active forces
//! `F_σ = Σ_a (F_a + R_a) · ∂r_a'/∂P_σ` (R_a: thrust where masses vary) and inertia forces
//! `F*_σ = -Σ_a m_a r_a'' · ∂r_a'/∂P_σ` (T1 (49)); for bodies also `M · ∂ω/∂P_σ` and `-(J ω' + ω × Jω) · ∂ω/∂P_σ`. Where the model states no particles that carry the whole inertia,
//! `F_σ = Σ_i (Q_i - ∂V/∂q^i) ∂v^i/∂P_σ`, `F*_σ = -Σ_i E_i[T] ∂v^i/∂P_σ`; where it states no T and V apart, L stands for T.

use super::{bare, potential_forces, stated_apart, Basis, DeriveError, Formulation};
use crate::bodies::{self, cross, dot, image, plus};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::mass;
use crate::order::determined::in_characteristics;
use crate::particles;
use crate::system::System;
use chetaev_model::mechanism::{Body, Mechanism, Vector};
use chetaev_symbolic::{Expr, Graph};

/// Kane's equations.
#[derive(Clone, Copy, Debug)]
pub struct Kane;

static CARD: Card = Card {
    name: "kane",
    title: "Kane's equations",
    statement: "Active forces and inertia forces along the partial velocities of the generalized speeds balance.",
    principle: Principle::Jourdain,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "rates of the k generalized speeds",
    highest_order: 1,
    sources: &[Source { key: "kane-levinson1985", place: "ch. 6" }],
};

const SCHEMA: Schema = Schema {
    text: "F_σ + F*_σ = 0,  F_σ = Σ_a (F_a + R_a)·∂r_a'/∂P_σ,  F*_σ = −Σ_a m_a r_a''·∂r_a'/∂P_σ",
    latex: r"F_\sigma + F^*_\sigma = 0, \quad F_\sigma = \sum_a (F_a + R_a) \cdot \frac{\partial \dot r_a}{\partial P_\sigma}, \quad F^*_\sigma = -\sum_a m_a \ddot r_a \cdot \frac{\partial \dot r_a}{\partial P_\sigma}",
};

/// From bodies.
const SCHEMA_OF_BODIES: Schema = Schema {
    text: "F_σ + F*_σ = 0,  F_σ = Σ_b (F_b·∂v_b/∂P_σ + M_b·∂ω_b/∂P_σ),  F*_σ = −Σ_b (m_b v_b'·∂v_b/∂P_σ + (J_b ω_b' + ω_b×J_b ω_b)·∂ω_b/∂P_σ)",
    latex: r"F_\sigma + F^*_\sigma = 0, \quad F_\sigma = \sum_b \Bigl(F_b \cdot \frac{\partial v_b}{\partial P_\sigma} + M_b \cdot \frac{\partial \omega_b}{\partial P_\sigma}\Bigr), \quad F^*_\sigma = -\sum_b \Bigl(m_b \dot v_b \cdot \frac{\partial v_b}{\partial P_\sigma} + (J_b \dot\omega_b + \omega_b \times J_b \omega_b) \cdot \frac{\partial \omega_b}{\partial P_\sigma}\Bigr)",
};

/// Without particles, from T and V.
const SCHEMA_OF_T: Schema = Schema {
    text: "F_σ + F*_σ = 0,  F_σ = Σ_i ( Q_i − ∂V/∂q^i ) ∂v^i/∂P_σ,  F*_σ = −Σ_i ( D(∂T/∂v^i) − ∂T/∂q^i ) ∂v^i/∂P_σ",
    latex: r"F_\sigma + F^*_\sigma = 0, \quad F_\sigma = \sum_i \Bigl(Q_i - \frac{\partial V}{\partial q^i}\Bigr) \frac{\partial \dot q^i}{\partial P_\sigma}, \quad F^*_\sigma = -\sum_i \Bigl(\frac{d}{dt}\frac{\partial T}{\partial \dot q^i} - \frac{\partial T}{\partial q^i}\Bigr) \frac{\partial \dot q^i}{\partial P_\sigma}",
};

/// Without particles and without T and V, from L alone.
const SCHEMA_OF_L: Schema = Schema {
    text:
        "F_σ + F*_σ = 0,  F_σ = Σ_i Q_i ∂v^i/∂P_σ,  F*_σ = −Σ_i ( D(∂L/∂v^i) − ∂L/∂q^i ) ∂v^i/∂P_σ",
    latex: r"F_\sigma + F^*_\sigma = 0, \quad F_\sigma = \sum_i Q_i \frac{\partial \dot q^i}{\partial P_\sigma}, \quad F^*_\sigma = -\sum_i \Bigl(\frac{d}{dt}\frac{\partial L}{\partial \dot q^i} - \frac{\partial L}{\partial q^i}\Bigr) \frac{\partial \dot q^i}{\partial P_\sigma}",
};

impl Formulation for Kane {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, characteristics) = (basis.system, basis.kinematic_characteristics()?);
        let g = &system.graph;
        let own = &characteristics;
        let (balance, schema) = match bodies::sufficient(system) {
            Some(mechanism) => (from_bodies(system, mechanism, own), SCHEMA_OF_BODIES),
            None if particles::suffice(system) => (from_particles(system, own), SCHEMA),
            None => (
                from_lagrangian(system, own),
                match stated_apart(system) {
                    Some(_) => SCHEMA_OF_T,
                    None => SCHEMA_OF_L,
                },
            ),
        };
        let motion: Vec<Equation> = characteristics
            .parameters
            .iter()
            .zip(balance.active.iter().zip(&balance.inertia))
            .map(|(p, (&active, &inertia))| Equation {
                label: p.name.clone(),
                left: g.add(&[active, inertia]),
                right: g.zero(),
            })
            .collect();
        Ok(
            in_characteristics(CARD.name, basis, &characteristics, &swapped(&motion))?
                .with_group("equations of motion", Some(schema), motion)
                .with_group("kinematics", None, basis.kinematics(&characteristics))
                .with_objects(balance.objects(&characteristics)),
        )
    }

    fn structural(&self, basis: &Basis<'_>) -> Option<&'static str> {
        let is_own = |system| particles::suffice(system) || bodies::sufficient(system).is_some();
        (!is_own(basis.system)).then_some(
            "active and inertia forces are built from the Lagrangian, as no particles that carry the whole inertia are stated: their sum is Lagrange's left sides contracted with the basis of virtual displacements, as in Maggi's equations",
        )
    }
}

/// The same equations with their sides exchanged: what is moved then has the sign of Maggi's left sides.
fn swapped(motion: &[Equation]) -> Vec<Equation> {
    let exchanged = |e: &Equation| Equation {
        label: e.label.clone(),
        left: e.right,
        right: e.left,
    };
    motion.iter().map(exchanged).collect()
}

/// Active and inertia forces along the generalized speeds, and the partial velocities.
struct Balance {
    active: Vec<Expr>,
    inertia: Vec<Expr>,
    partial: Vec<NamedExpr>,
}

impl Balance {
    fn objects(self, c: &Characteristics) -> Vec<NamedExpr> {
        let mut objects = self.partial;
        for (p, (active, inertia)) in c
            .parameters
            .iter()
            .zip(self.active.into_iter().zip(self.inertia))
        {
            let (sigma, name) = (bare(&p.name), &p.name);
            objects.push(NamedExpr::new(
                format!("F_{sigma}"),
                active,
                format!("active force along {name}"),
            ));
            objects.push(NamedExpr::new(
                format!("Fstar_{sigma}"),
                inertia,
                format!("inertia force along {name}"),
            ));
        }
        objects
    }
}

/// Terms of the forces along each generalized speed, while they are collected.
struct Parts {
    active: Vec<Vec<Expr>>,
    inertia: Vec<Vec<Expr>>,
    partial: Vec<NamedExpr>,
}

impl Parts {
    /// With these active forces along the speeds.
    fn new(active: Vec<Expr>) -> Parts {
        Parts {
            inertia: vec![Vec::new(); active.len()],
            active: active.into_iter().map(|force| vec![force]).collect(),
            partial: Vec::new(),
        }
    }

    fn summed(self, g: &Graph) -> Balance {
        let sums = |parts: Vec<Vec<Expr>>| parts.iter().map(|parts| g.add(parts)).collect();
        Balance {
            active: sums(self.active),
            inertia: sums(self.inertia),
            partial: self.partial,
        }
    }

    fn add_particles(&mut self, system: &System, c: &Characteristics) {
        let g = &system.graph;
        for particle in &system.particles {
            let velocity = c.restrict(system, &particles::velocity(system, particle));
            let slopes = c.by_parameters(system, &velocity);
            let accelerations = c.total_derivative(system, &velocity);
            let applied = c.restrict(system, &mass::force_with_thrust(system, particle));
            for (component, row) in slopes.iter().enumerate() {
                let mass_times = g.mul(&[particle.mass, accelerations[component]]);
                for (sigma, &slope) in row
                    .iter()
                    .enumerate()
                    .filter(|(_, &slope)| !g.is_zero(slope))
                {
                    self.active[sigma].push(g.mul(&[applied[component], slope]));
                    self.inertia[sigma].push(g.neg(g.mul(&[mass_times, slope])));
                    let p = &c.parameters[sigma].name;
                    self.partial.push(NamedExpr::new(
                        format!("V_{}_{}_{}", particle.name, component + 1, bare(p)),
                        slope,
                        format!(
                            "component {} of the partial velocity of `{}` along {p}",
                            component + 1,
                            particle.name
                        ),
                    ));
                }
            }
        }
    }

    fn add_body(&mut self, system: &System, c: &Characteristics, body: &Body) {
        let g = &system.graph;
        let own = bodies::velocities(system, body);
        let restricted = |v: Vector| vector(&c.restrict(system, &v));
        let changed = |v: Vector| vector(&c.total_derivative(system, &v));
        let (velocity, omega) = (restricted(own.center), restricted(own.omega));
        let momentum = changed(velocity).map(|e| g.mul(&[body.mass, e]));
        let moment = image(g, &body.inertia, omega);
        let turned = cross(g, restricted(own.turning), moment);
        let moment = plus(g, image(g, &body.inertia, changed(omega)), turned);
        let weight = restricted(body.weight);
        let slopes = c.by_parameters(system, &velocity);
        let turns = c.by_parameters(system, &omega);
        for (sigma, p) in c.parameters.iter().enumerate() {
            let slope = std::array::from_fn(|i| slopes[i][sigma]);
            let turn = std::array::from_fn(|i| turns[i][sigma]);
            self.active[sigma].push(dot(g, weight, slope));
            let inertia = g.add(&[dot(g, momentum, slope), dot(g, moment, turn)]);
            self.inertia[sigma].push(g.neg(inertia));
            let both = [
                ("V", slope, "partial velocity"),
                ("W", turn, "partial angular velocity"),
            ];
            for (letter, partial, what) in both {
                self.name_partial(g, [letter, &body.name, bare(&p.name)], partial, what);
            }
        }
    }

    fn name_partial(&mut self, g: &Graph, names: [&str; 3], partial: Vector, what: &str) {
        let [letter, body, speed] = names;
        for (component, value) in partial.into_iter().enumerate() {
            if !g.is_zero(value) {
                self.partial.push(NamedExpr::new(
                    format!("{letter}_{body}_{}_{speed}", component + 1),
                    value,
                    format!(
                        "component {} of the {what} of `{body}` along {speed}",
                        component + 1
                    ),
                ));
            }
        }
    }
}

fn from_particles(system: &System, c: &Characteristics) -> Balance {
    let further = c.restrict(system, &particles::further_forces(system));
    let mut parts = Parts::new(c.contract(system, &further));
    parts.add_particles(system, c);
    parts.summed(&system.graph)
}

/// From the partial velocities of the centres of mass along the axes of the ground, and the partial angular velocities along those of
/// the bodies.
fn from_bodies(system: &System, mechanism: &Mechanism, c: &Characteristics) -> Balance {
    let further = c.restrict(system, &bodies::further_forces(system, mechanism));
    let mut parts = Parts::new(c.contract(system, &further));
    for body in &mechanism.bodies {
        parts.add_body(system, c, body);
    }
    parts.add_particles(system, c);
    parts.summed(&system.graph)
}

/// Three components.
fn vector(es: &[Expr]) -> Vector {
    std::array::from_fn(|i| es[i])
}

fn from_lagrangian(system: &System, c: &Characteristics) -> Balance {
    let g = &system.graph;
    let potential = potential_forces(system);
    let with_potential = |es: &[Expr]| -> Vec<Expr> {
        let pairs = es.iter().zip(&potential);
        pairs.map(|(&e, &force)| g.add(&[e, force])).collect()
    };
    let left = c.on_jet(system, &with_potential(&system.lagrange_left_sides()));
    let forces = c.restrict(system, &with_potential(&system.forces));
    let inertia = c
        .contract(system, &left)
        .into_iter()
        .map(|e| g.neg(e))
        .collect();
    Balance {
        active: c.contract(system, &forces),
        inertia,
        partial: super::maggi::virtual_basis(system, c),
    }
}
