//! The equations of Gibbs and Appell.
//!
//! `∂S/∂P'_σ = Π_σ` with the acceleration energy `S = ½ Σ_a m_a r_a''·r_a''` on the jet (t, q, P, P') and
//! `Π_σ = Σ_a (F_a + R_a) · ∂r_a''/∂P'_σ`, R_a the thrust where masses vary (T1 (48)). The particles of a rigid body have together
//! `½∫a² dm = ½ m v'·v' + ½ ω'·Jω' + ω'·(ω × Jω)` and terms free of accelerations (P. Appell, Traité de mécanique rationnelle II, 1911,
//! no. 466). Where the model states no particles
//! that carry the whole inertia, `S = ½ aᵀ W a + aᵀ c`, `c_i = E_i[T]` at a = 0, and `Π_σ` contains `-∂V/∂q`; where it states
//! no T and V apart, L stands for T. This is the same combination as Maggi's.

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
use chetaev_symbolic::{Expr, Symbol};

/// The equations of Gibbs and Appell.
#[derive(Clone, Copy, Debug)]
pub struct GibbsAppell;

static CARD: Card = Card {
    name: "gibbs-appell",
    title: "Gibbs–Appell equations",
    statement: "The derivatives of the acceleration energy by the independent accelerations are the forces along them.",
    principle: Principle::Gauss,
    relation: Relation::Equivalent,
    requires: &["model.accelerations-unique", "model.masses-free-of-velocity"],
    identity: None,
    unknowns: "rates of the k kinematic parameters",
    highest_order: 1,
    sources: &[
        Source { key: "gibbs1879", place: "the formula with accelerations" },
        Source { key: "appell1900b", place: "§§ 1–4" },
    ],
};

const SCHEMA: Schema = Schema {
    text: "∂S/∂P'_σ = Π_σ,  S = ½ Σ_a m_a r_a''·r_a'',  Π_σ = Σ_a (F_a + R_a)·∂r_a''/∂P'_σ",
    latex: r"\frac{\partial S}{\partial \dot P_\sigma} = \Pi_\sigma, \quad S = \tfrac12 \sum_a m_a \ddot r_a \cdot \ddot r_a, \quad \Pi_\sigma = \sum_a (F_a + R_a) \cdot \frac{\partial \ddot r_a}{\partial \dot P_\sigma}",
};

/// From bodies.
const SCHEMA_OF_BODIES: Schema = Schema {
    text: "∂S/∂P'_σ = Π_σ,  S = Σ_b ( ½ m v'·v' + ½ ω'·Jω' + ω'·(ω × Jω) ),  Π_σ = Σ_b ( F·∂v'/∂P'_σ + M·∂ω'/∂P'_σ )",
    latex: r"\frac{\partial S}{\partial \dot P_\sigma} = \Pi_\sigma, \quad S = \sum_b \Bigl(\tfrac12 m \dot v \cdot \dot v + \tfrac12 \dot\omega \cdot J \dot\omega + \dot\omega \cdot (\omega \times J \omega)\Bigr), \quad \Pi_\sigma = \sum_b \Bigl(F \cdot \frac{\partial \dot v}{\partial \dot P_\sigma} + M \cdot \frac{\partial \dot\omega}{\partial \dot P_\sigma}\Bigr)",
};

/// Without particles, from T and V.
const SCHEMA_OF_T: Schema = Schema {
    text: "∂S/∂P'_σ = Π_σ,  S = ½ Σ_ij T_{v^i v^j} a^i a^j + Σ_i c_i a^i,  c_i = D(∂T/∂v^i)|_{a=0} − ∂T/∂q^i,  Π_σ = Σ_i ( Q_i − ∂V/∂q^i ) ∂v^i/∂P_σ",
    latex: r"\frac{\partial S}{\partial \dot P_\sigma} = \Pi_\sigma, \quad S = \tfrac12 \sum_{ij} \frac{\partial^2 T}{\partial \dot q^i \partial \dot q^j} \ddot q^i \ddot q^j + \sum_i c_i \ddot q^i, \quad \Pi_\sigma = \sum_i \Bigl(Q_i - \frac{\partial V}{\partial q^i}\Bigr) \frac{\partial \dot q^i}{\partial P_\sigma}",
};

/// Without particles and without T and V, from L alone.
const SCHEMA_OF_L: Schema = Schema {
    text: "∂S/∂P'_σ = Π_σ,  S = ½ Σ_ij L_{v^i v^j} a^i a^j + Σ_i c_i a^i,  c_i = D(∂L/∂v^i)|_{a=0} − ∂L/∂q^i,  Π_σ = Σ_i Q_i ∂v^i/∂P_σ",
    latex: r"\frac{\partial S}{\partial \dot P_\sigma} = \Pi_\sigma, \quad S = \tfrac12 \sum_{ij} \frac{\partial^2 L}{\partial \dot q^i \partial \dot q^j} \ddot q^i \ddot q^j + \sum_i c_i \ddot q^i, \quad \Pi_\sigma = \sum_i Q_i \frac{\partial \dot q^i}{\partial P_\sigma}",
};

impl Formulation for GibbsAppell {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let (system, characteristics) = (basis.system, basis.kinematic_characteristics()?);
        let g = &system.graph;
        let own = &characteristics;
        let (energy, schema) = match bodies::sufficient(system) {
            Some(mechanism) => (from_bodies(system, mechanism, own), SCHEMA_OF_BODIES),
            None if particles::suffice(system) => (from_particles(system, own), SCHEMA),
            None => (
                from_lagrangian(basis, own),
                match stated_apart(system) {
                    Some(_) => SCHEMA_OF_T,
                    None => SCHEMA_OF_L,
                },
            ),
        };
        let symbols: Vec<Symbol> = characteristics
            .parameters
            .iter()
            .map(|p| p.rate_symbol)
            .collect();
        let motion: Vec<Equation> = g
            .gradient(energy.value, &symbols)
            .into_iter()
            .zip(&energy.forces)
            .zip(&characteristics.parameters)
            .map(|((left, &right), p)| Equation {
                label: p.name.clone(),
                left,
                right,
            })
            .collect();
        Ok(
            in_characteristics(CARD.name, basis, &characteristics, &motion)?
                .with_group("equations of motion", Some(schema), motion)
                .with_group("kinematics", None, basis.kinematics(&characteristics))
                .with_objects(energy.objects(system, &characteristics)),
        )
    }

    fn structural(&self, basis: &Basis<'_>) -> Option<&'static str> {
        let is_own = |system| particles::suffice(system) || bodies::sufficient(system).is_some();
        (!is_own(basis.system)).then_some(
            "the acceleration energy is built from the Lagrangian, as no particles that carry the whole inertia are stated: its derivatives are Lagrange's left sides contracted with the basis of virtual displacements, as in Maggi's equations",
        )
    }
}

/// The acceleration energy on the jet, without terms free of P', and the forces Π_σ.
struct AccelerationEnergy {
    value: Expr,
    forces: Vec<Expr>,
    meaning: &'static str,
}

impl AccelerationEnergy {
    fn objects(&self, system: &System, c: &Characteristics) -> Vec<NamedExpr> {
        let mut objects = vec![NamedExpr::new("S", self.value, self.meaning)];
        for (p, &force) in c.parameters.iter().zip(&self.forces) {
            if !system.graph.is_zero(force) {
                let meaning = format!("force along the rate of {}", p.name);
                objects.push(NamedExpr::new(
                    format!("Pi_{}", bare(&p.name)),
                    force,
                    meaning,
                ));
            }
        }
        objects
    }
}

/// Energies and forces along each parameter, while they are collected.
struct Parts {
    energy: Vec<Expr>,
    forces: Vec<Vec<Expr>>,
}

impl Parts {
    /// With these forces along the parameters.
    fn new(forces: Vec<Expr>) -> Parts {
        Parts {
            energy: Vec::new(),
            forces: forces.into_iter().map(|force| vec![force]).collect(),
        }
    }

    fn summed(&self, system: &System, meaning: &'static str) -> AccelerationEnergy {
        let g = &system.graph;
        AccelerationEnergy {
            value: g.add(&self.energy),
            forces: self.forces.iter().map(|parts| g.add(parts)).collect(),
            meaning,
        }
    }

    fn act(&mut self, system: &System, force: Expr, row: &[Expr]) {
        for (parts, &slope) in self.forces.iter_mut().zip(row) {
            parts.push(system.graph.mul(&[force, slope]));
        }
    }

    /// `r'' = R_σ P'_σ + r*`: S without terms free of P' is `½ Σ m ( w·w + 2 w·r* )`, w = R P'.
    fn add_particles(&mut self, system: &System, c: &Characteristics) {
        let g = &system.graph;
        for particle in &system.particles {
            let velocity = particles::velocity(system, particle);
            let accelerations = Accelerations::of(system, c, &velocity);
            let applied = c.restrict(system, &mass::force_with_thrust(system, particle));
            let parts = accelerations.partial.iter().zip(&accelerations.offsets);
            for ((row, &offset), force) in parts.zip(applied) {
                let own = without_constant(system, c, row, offset);
                self.energy.push(g.mul(&[particle.mass, own]));
                self.act(system, force, row);
            }
        }
    }

    /// `½ m v'² + ½ ω'·Jω' + ω'·(ω × Jω)` without terms free of P'. In the axes of the body, which turn with Ω,
    /// `ω' = ω̊ + Ω × ω`.
    fn add_body(&mut self, system: &System, c: &Characteristics, body: &Body) {
        let g = &system.graph;
        let own = bodies::velocities(system, body);
        let moved = Accelerations::of(system, c, &own.center);
        let weight = c.restrict(system, &body.weight);
        for ((row, &offset), force) in moved.partial.iter().zip(&moved.offsets).zip(weight) {
            let square = without_constant(system, c, row, offset);
            self.energy.push(g.mul(&[body.mass, square]));
            self.act(system, force, row);
        }
        let turned = Accelerations::of(system, c, &own.omega);
        let restricted = |v: Vector| vector(&c.restrict(system, &v));
        let (omega, turning) = (restricted(own.omega), restricted(own.turning));
        let steady = plus(g, vector(&turned.offsets), cross(g, turning, omega));
        let w: Vector = std::array::from_fn(|i| turned.along(system, c, i));
        let half = g.div(g.one(), g.integer(2));
        let square = g.mul(&[half, dot(g, w, image(g, &body.inertia, w))]);
        let moment = cross(g, omega, image(g, &body.inertia, omega));
        let linear = dot(g, w, plus(g, image(g, &body.inertia, steady), moment));
        self.energy.extend([square, linear]);
    }
}

/// Accelerations on the jet, `R_σ P'_σ + r*`.
struct Accelerations {
    partial: Vec<Vec<Expr>>,
    offsets: Vec<Expr>,
}

impl Accelerations {
    /// The rates of velocities.
    fn of(system: &System, c: &Characteristics, velocities: &[Expr]) -> Accelerations {
        let g = &system.graph;
        let symbols: Vec<Symbol> = c.parameters.iter().map(|p| p.rate_symbol).collect();
        let at_rest: Vec<(Expr, Expr)> = c.parameters.iter().map(|p| (p.rate, g.zero())).collect();
        let rates = velocities.iter().map(|&v| system.total_derivative(v));
        let all = c.on_jet(system, &rates.collect::<Vec<_>>());
        Accelerations {
            partial: g.jacobian(&all, &symbols),
            offsets: g.substitute_all(&all, &at_rest),
        }
    }

    /// `R_σ P'_σ` of a component.
    fn along(&self, system: &System, c: &Characteristics, component: usize) -> Expr {
        let g = &system.graph;
        let row = self.partial[component].iter().zip(&c.parameters);
        let parts: Vec<Expr> = row.map(|(&slope, p)| g.mul(&[slope, p.rate])).collect();
        g.add(&parts)
    }
}

/// Three components.
fn vector(es: &[Expr]) -> Vector {
    std::array::from_fn(|i| es[i])
}

fn from_particles(system: &System, c: &Characteristics) -> AccelerationEnergy {
    let further = c.restrict(system, &particles::further_forces(system));
    let mut parts = Parts::new(c.contract(system, &further));
    parts.add_particles(system, c);
    parts.summed(
        system,
        "acceleration energy of the particles, without terms free of the rates of the parameters",
    )
}

fn from_bodies(system: &System, mechanism: &Mechanism, c: &Characteristics) -> AccelerationEnergy {
    let further = c.restrict(system, &bodies::further_forces(system, mechanism));
    let mut parts = Parts::new(c.contract(system, &further));
    for body in &mechanism.bodies {
        parts.add_body(system, c, body);
    }
    parts.add_particles(system, c);
    parts.summed(
        system,
        "acceleration energy of the bodies, without terms free of the rates of the parameters",
    )
}

/// `½ w² + w r*` for `w = Σ_σ R_σ P'_σ`.
fn without_constant(system: &System, c: &Characteristics, row: &[Expr], offset: Expr) -> Expr {
    let g = &system.graph;
    let parts: Vec<Expr> = row
        .iter()
        .zip(&c.parameters)
        .map(|(&slope, p)| g.mul(&[slope, p.rate]))
        .collect();
    let moved = g.add(&parts);
    let square = g.div(g.mul(&[moved, moved]), g.integer(2));
    g.add(&[square, g.mul(&[moved, offset])])
}

/// `½ wᵀ W w + wᵀ ( W a* + c )` for `a = w + a*`, w = B P'.
fn from_lagrangian(basis: &Basis<'_>, characteristics: &Characteristics) -> AccelerationEnergy {
    let (system, terms, c) = (basis.system, basis.terms, characteristics);
    let (g, n) = (&system.graph, system.n());
    let mut functions = terms.mass_matrix.concat();
    let potential = potential_forces(system);
    let active = system.forces.iter().zip(potential);
    functions.extend(active.map(|(&force, slope)| g.add(&[force, slope])));
    functions.extend(&terms.force);
    let restricted = c.restrict(system, &functions);
    let (matrix, rest) = restricted.split_at(n * n);
    let (forces, right) = rest.split_at(n);
    let moved: Vec<Expr> = c
        .accelerations
        .iter()
        .zip(&c.acceleration_offset)
        .map(|(&a, &offset)| g.sub(a, offset))
        .collect();
    let mut energy = Vec::new();
    for i in (0..n).filter(|&i| !g.is_zero(moved[i])) {
        let mut slope = vec![forces[i], g.neg(right[i])];
        for j in 0..n {
            let entry = matrix[i * n + j];
            if !g.is_zero(entry) {
                let half = g.div(moved[j], g.integer(2));
                slope.push(g.mul(&[entry, g.add(&[half, c.acceleration_offset[j]])]));
            }
        }
        energy.push(g.mul(&[moved[i], g.add(&slope)]));
    }
    AccelerationEnergy {
        value: g.add(&energy),
        forces: c.contract(system, forces),
        meaning: "½ aᵀ W a + aᵀ c, without terms free of the rates of the parameters",
    }
}
