//! The equations of Gibbs and Appell.
//!
//! `∂S/∂P'_σ = Π_σ` with the acceleration energy `S = ½ Σ_a m_a r_a''·r_a''` on the jet (t, q, P, P') and
//! `Π_σ = Σ_a (F_a + R_a) · ∂r_a''/∂P'_σ`, R_a the thrust where masses vary (T1 (48)). Where the model states no particles
//! that carry the whole inertia, `S = ½ aᵀ W a + aᵀ c`, `c_i = E_i[T]` at a = 0, and `Π_σ` contains `-∂V/∂q`; where it states
//! no T and V apart, L stands for T. This is the same combination as Maggi's.

use super::{bare, potential_forces, stated_apart, Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Relation, Source};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, Equations, NamedExpr, Schema};
use crate::mass;
use crate::order::determined::in_characteristics;
use crate::particles;
use crate::system::System;
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
        let (energy, schema) = match particles::suffice(system) {
            true => (from_particles(system, &characteristics), SCHEMA),
            false => (
                from_lagrangian(basis, &characteristics),
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
        (!particles::suffice(basis.system)).then_some(
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

/// `r'' = R_σ P'_σ + r*`: S without terms free of P' is `½ Σ m ( w·w + 2 w·r* )`, w = R P'.
fn from_particles(system: &System, c: &Characteristics) -> AccelerationEnergy {
    let g = &system.graph;
    let symbols: Vec<Symbol> = c.parameters.iter().map(|p| p.rate_symbol).collect();
    let at_rest: Vec<(Expr, Expr)> = c.parameters.iter().map(|p| (p.rate, g.zero())).collect();
    let mut energy = Vec::new();
    let further = c.restrict(system, &particles::further_forces(system));
    let further = c.contract(system, &further);
    let mut forces: Vec<Vec<Expr>> = further.into_iter().map(|force| vec![force]).collect();
    for particle in &system.particles {
        let accelerations: Vec<Expr> = particles::velocity(system, particle)
            .into_iter()
            .map(|rate| system.total_derivative(rate))
            .collect();
        let accelerations = c.on_jet(system, &accelerations);
        let partial = g.jacobian(&accelerations, &symbols);
        let offsets = g.substitute_all(&accelerations, &at_rest);
        let applied = c.restrict(system, &mass::force_with_thrust(system, particle));
        for ((row, offset), force) in partial.iter().zip(offsets).zip(applied) {
            energy.push(g.mul(&[particle.mass, without_constant(system, c, row, offset)]));
            for (parts, &slope) in forces.iter_mut().zip(row) {
                parts.push(g.mul(&[force, slope]));
            }
        }
    }
    AccelerationEnergy {
        value: g.add(&energy),
        forces: forces.iter().map(|parts| g.add(parts)).collect(),
        meaning: "acceleration energy of the particles, without terms free of the rates of the parameters",
    }
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
