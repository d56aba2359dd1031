//! Maggi's equations.
//!
//! `Σ_s ( D(∂L/∂v^s) - ∂L/∂q^s - Q_s ) ∂v^s/∂P_σ = 0`, σ = 1..k, for a parametrization `v = φ(q, P, t)` of the
//! admissible velocities (T2 (7) with m = 1). With `a = Dφ` they are k linear equations for P'.

use super::{Basis, DeriveError, Formulation};
use crate::card::{Card, Principle, Source};
use crate::characteristics::Characteristics;
use crate::equations::{Equation, EquationGroup, Equations, NamedExpr};
use chetaev_symbolic::Expr;

/// Maggi's equations for independent velocities or the user's quasi-velocities.
#[derive(Clone, Copy, Debug)]
pub struct Maggi;

static CARD: Card = Card {
    name: "maggi",
    title: "Maggi's equations",
    statement: "Lagrange's left sides contracted with a basis of virtual displacements: as many equations as degrees of freedom in velocity, without multipliers.",
    principle: Principle::DalembertLagrangeChetaev,
    requires: &["model.accelerations-unique"],
    unknowns: "rates of the k kinematic parameters",
    sources: &[
        Source { key: "maggi1896", place: "§§ 1–5" },
        Source { key: "qiao-volterra", place: "(6)–(7)" },
    ],
};

impl Formulation for Maggi {
    fn card(&self) -> &'static Card {
        &CARD
    }

    fn equations(&self, basis: &Basis<'_>) -> Result<Equations, DeriveError> {
        let characteristics = choose(basis)?;
        let projected = Projection::new(basis, &characteristics);
        let rates = projected.rates(basis, &characteristics)?;
        let g = &basis.system.graph;
        let substitution: Vec<(Expr, Expr)> = characteristics
            .parameters
            .iter()
            .zip(&rates)
            .map(|(p, &rate)| (p.rate, rate))
            .collect();
        let accelerations = g.substitute_all(&characteristics.accelerations, &substitution);
        Ok(Equations {
            formulation: CARD.name,
            groups: projected.groups(basis, &characteristics),
            objects: objects(basis, &characteristics),
            accelerations,
            rates,
            multipliers: Vec::new(),
            characteristics: Some(characteristics),
        })
    }
}

fn choose(basis: &Basis<'_>) -> Result<Characteristics, DeriveError> {
    if let Some(given) = &basis.characteristics {
        return Ok(given.clone());
    }
    let (system, terms, selection) = (basis.system, basis.terms, basis.selection);
    if let Some(Ok(quasi)) = Characteristics::quasi_velocities(system, terms, selection) {
        return Ok(quasi);
    }
    Ok(Characteristics::independent_velocities(
        system, terms, selection,
    )?)
}

/// Lagrange's left sides minus forces, on the jet (q, P, P', t), and their contraction with B.
struct Projection {
    equations: Vec<Expr>,
}

impl Projection {
    fn new(basis: &Basis<'_>, characteristics: &Characteristics) -> Projection {
        let system = basis.system;
        let g = &system.graph;
        let residuals: Vec<Expr> = system
            .lagrange_left_sides()
            .into_iter()
            .zip(&system.forces)
            .map(|(left, &force)| g.sub(left, force))
            .collect();
        let mut jet: Vec<(Expr, Expr)> = Vec::new();
        for (i, c) in system.coordinates.iter().enumerate() {
            jet.push((c.v, characteristics.velocities[i]));
            jet.push((c.a, characteristics.accelerations[i]));
        }
        let on_jet = g.substitute_all(&residuals, &jet);
        let equations = (0..characteristics.k())
            .map(|sigma| {
                let parts: Vec<Expr> = on_jet
                    .iter()
                    .zip(&characteristics.basis)
                    .filter(|(_, row)| !g.is_zero(row[sigma]))
                    .map(|(w, row)| g.mul(&[*w, row[sigma]]))
                    .collect();
                g.add(&parts)
            })
            .collect();
        Projection { equations }
    }

    /// P' from the k equations, linear in P': the matrix is `Bᵀ W B`.
    fn rates(
        &self,
        basis: &Basis<'_>,
        characteristics: &Characteristics,
    ) -> Result<Vec<Expr>, DeriveError> {
        let g = &basis.system.graph;
        let symbols: Vec<_> = characteristics
            .parameters
            .iter()
            .map(|p| p.rate_symbol)
            .collect();
        let matrix = g.jacobian(&self.equations, &symbols).concat();
        let at_zero: Vec<(Expr, Expr)> = characteristics
            .parameters
            .iter()
            .map(|p| (p.rate, g.zero()))
            .collect();
        let rhs: Vec<Expr> = g
            .substitute_all(&self.equations, &at_zero)
            .into_iter()
            .map(|e| g.neg(e))
            .collect();
        Ok(g.solve(&matrix, &rhs)?)
    }

    fn groups(&self, basis: &Basis<'_>, characteristics: &Characteristics) -> Vec<EquationGroup> {
        let g = &basis.system.graph;
        let motion = characteristics
            .parameters
            .iter()
            .zip(&self.equations)
            .map(|(p, &e)| Equation {
                label: p.name.clone(),
                left: e,
                right: g.zero(),
            })
            .collect();
        let kinematics = basis
            .system
            .coordinates
            .iter()
            .zip(&characteristics.velocities)
            .filter(|(c, phi)| c.v != **phi)
            .map(|(c, &phi)| Equation {
                label: c.name.clone(),
                left: c.v,
                right: phi,
            })
            .chain(
                characteristics
                    .manifold
                    .implicit
                    .iter()
                    .map(|(f, _)| Equation {
                        label: "constraint".into(),
                        left: *f,
                        right: g.zero(),
                    }),
            )
            .collect();
        vec![
            EquationGroup {
                title: "equations of motion".into(),
                equations: motion,
            },
            EquationGroup {
                title: "kinematics".into(),
                equations: kinematics,
            },
        ]
    }
}

fn objects(basis: &Basis<'_>, characteristics: &Characteristics) -> Vec<NamedExpr> {
    let mut objects = Vec::new();
    for (c, row) in basis.system.coordinates.iter().zip(&characteristics.basis) {
        for (p, &value) in characteristics.parameters.iter().zip(row) {
            if !basis.system.graph.is_zero(value) {
                objects.push(NamedExpr {
                    name: format!("B[{}, {}]", c.name, p.name),
                    value,
                    meaning: format!("∂{}'/∂({})", c.name, p.name),
                });
            }
        }
    }
    objects
}
