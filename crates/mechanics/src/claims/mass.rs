//! Claims about masses that vary: on what they depend, and that the reactive forces are those of the particle law (T2 §1).

use super::{Claim, Context, Finding, Formula, Group};
use crate::characteristics::Manifold;
use crate::mass;
use crate::particles;
use crate::system::System;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `model.masses-free-of-velocity`.
#[derive(Clone, Copy, Debug)]
pub struct MassesFreeOfVelocity;

/// `model.masses-of-time`.
#[derive(Clone, Copy, Debug)]
pub struct MassesOfTime;

/// `mass.balance`.
#[derive(Clone, Copy, Debug)]
pub struct Balance;

/// Claims on the form of masses exist where a mass varies.
fn where_masses_vary(cx: &Context<'_>) -> Vec<Option<String>> {
    match mass::any_varies(cx.system) {
        true => vec![None],
        false => Vec::new(),
    }
}

/// A refutation by form: what is found where it may not be.
fn found(detail: String) -> Verdict {
    Verdict::Refuted(Counterexample {
        point: Vec::new(),
        quantity: "masses that depend on what they may not, at least".into(),
        residual: ("1".into(), "1".into()),
        detail,
    })
}

fn by_form(detail: &str) -> Verdict {
    Verdict::Proved(Proof::structural("everywhere", detail))
}

impl Claim for MassesFreeOfVelocity {
    fn id(&self) -> &'static str {
        "model.masses-free-of-velocity"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "No mass contains velocities"
    }

    fn explanation(&self) -> &'static str {
        "The masses of the particles are functions μ(t, q) and of masses with a law of their own. Then the reactive forces \
         Ψ_s = Σ { (R + μ' ξ')·∂ξ/∂q^s − ½ ξ'·ξ' ∂μ/∂q^s } contain no accelerations and stand beside the other forces in every \
         form of Lagrange's equations. Where a mass contains velocities, μ' contains accelerations, the matrix of inertia \
         Σ { μ Jᵀ J − Jᵀ u ∂μ/∂v } is in general not symmetric, and only the forms apply that are built from the particle law: \
         multipliers, Maggi, virtual displacements. The verdict is by form; a refutation names the particle and the velocity."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        where_masses_vary(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let verdict = match mass::with_velocity(cx.system) {
            None => by_form("no mass of a particle contains a velocity"),
            Some((particle, symbol)) => found(format!(
                "the mass of `{}` contains {}",
                particle.name,
                cx.system.graph.symbol_text(symbol)
            )),
        };
        verdict.into()
    }
}

impl Claim for MassesOfTime {
    fn id(&self) -> &'static str {
        "model.masses-of-time"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The masses are functions of the time alone"
    }

    fn explanation(&self) -> &'static str {
        "No mass, and no rate of a mass with a law of its own, contains coordinates or velocities: along every motion the \
         masses are the same functions of the time. The lemmas behind Volterra's equations in Cartesian coordinates need it, \
         and so does every action principle, in which masses are not varied. The verdict is by form; a refutation names the \
         mass and what it contains."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        where_masses_vary(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let verdict = match moving_mass(cx.system) {
            None => by_form("no mass and no rate of a mass contains coordinates or velocities"),
            Some(detail) => found(detail),
        };
        verdict.into()
    }
}

/// The first mass, or rate of a mass, that contains a coordinate or a velocity.
fn moving_mass(system: &System) -> Option<String> {
    let mut symbols: Vec<Symbol> = system.coordinate_symbols();
    symbols.extend(system.velocity_symbols());
    let first = |e: Expr| {
        let symbol = mass::first_symbol(system, e, &symbols)?;
        Some(system.graph.symbol_text(symbol))
    };
    let of_particle = system.particles.iter().find_map(|particle| {
        let symbol = first(particle.mass)?;
        Some(format!("the mass of `{}` contains {symbol}", particle.name))
    });
    of_particle.or_else(|| {
        system.masses.iter().find_map(|mass| {
            let symbol = first(mass.rate)?;
            Some(format!(
                "the rate of the mass `{}` contains {symbol}",
                mass.name
            ))
        })
    })
}

impl Claim for Balance {
    fn id(&self) -> &'static str {
        "mass.balance"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn title(&self) -> &'static str {
        "The reactive forces are those of the particle law"
    }

    fn explanation(&self) -> &'static str {
        "Lagrange's left sides minus the forces Q_s and the reactive forces Ψ_s, assembled from the laws of the masses and the \
         thrust, equal the particle law of Meshchersky in coordinates, Σ (μ ξ'' − X − R)·∂ξ/∂q^s, identically in time, \
         coordinates, velocities, accelerations and masses, before any equation of motion is used. The thrust is R = μ' u with \
         the velocity u of the matter relative to the particle; Ψ_s = Σ { (R + μ' ξ')·∂ξ/∂q^s − ½ ξ'·ξ' ∂μ/∂q^s + \
         D(½ ξ'·ξ' ∂μ/∂v^s) }. The term μ' ξ' is no force: it cancels what D(∂T/∂q') contains, and equations with R alone on the \
         right are wrong. It needs particles that carry the whole inertia."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.particles".into()]
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let g = &cx.system.graph;
        let thrust = cx.system.reactive_forces.iter().any(|&e| !g.is_zero(e));
        match thrust || mass::any_varies(cx.system) {
            true => vec![None],
            false => Vec::new(),
        }
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let (system, free) = (cx.system, Manifold::default());
        if system.particles.is_empty() {
            return particles::no_particles().into();
        }
        let on = "identically in t, q, v, a and the masses";
        Finding {
            verdict: cx
                .prover
                .identity(system, &balance_residuals(system), &free, on),
            formulas: reactive_formulas(system),
        }
    }
}

/// `𝓛_s[L] − Q_s − Ψ_s` minus the same by the particle law, length n.
pub fn balance_residuals(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let apart = mass::with_velocity(system).is_some();
    let lagrange = system.lagrange_left_sides().into_iter();
    lagrange
        .zip(mass::left_sides(system))
        .enumerate()
        .map(|(s, (left, law))| {
            // Ψ is contained in the forces where it has no accelerations.
            let reactive = if apart {
                system.reactive_forces[s]
            } else {
                g.zero()
            };
            g.add(&[left, g.neg(system.forces[s]), g.neg(reactive), g.neg(law)])
        })
        .collect()
}

/// Ψ_s, where it is short enough to read.
fn reactive_formulas(system: &System) -> Vec<Formula> {
    let g = &system.graph;
    let forces = system.coordinates.iter().zip(&system.reactive_forces);
    forces
        .filter(|(_, &force)| !g.is_zero(force))
        .map(|(c, &right)| Formula {
            caption: format!("reactive force along `{}`", c.name),
            left: Some(g.symbol(&format!("Psi_{}", c.name), 0)),
            right,
        })
        .collect()
}
