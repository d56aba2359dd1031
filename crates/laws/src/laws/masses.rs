//! The reactive forces are those of the particle law, and the classical wrong ones are not.

use super::numbers::{differ, Size};
use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::claims::mass::balance_residuals;
use chetaev_mechanics::{mass, particles, Manifold, System};
use chetaev_symbolic::{Expr, Verdict};

/// `mass.balance`, where a mass varies or a thrust is stated.
pub(super) fn balance(subject: &Subject<'_>) -> Option<Trial> {
    let system = subject.cx.system;
    mass::any_varies(system).then(|| {
        let verdict = subject.cx.finding("mass.balance").verdict.clone();
        trial(
            Kind::Other,
            "the reactive forces are those of the particle law",
            verdict,
        )
    })
}

/// The thrust R alone on the right, μ' ξ' forgotten.
pub(super) fn thrust_alone(subject: &Subject<'_>) -> Option<Trial> {
    let system = subject.cx.system;
    if system.particles.is_empty() {
        return None;
    }
    let g = &system.graph;
    let right = balance_residuals(system);
    let wrong: Vec<Expr> = right
        .iter()
        .zip(carried(system))
        .map(|(&e, carried)| g.add(&[e, carried]))
        .collect();
    if differ(subject, &wrong, &right) != Size::NotZero {
        return None;
    }
    let cx = subject.cx;
    let verdict = cx.prover.identity(system, &wrong, &Manifold::default(), "");
    Some(trial(
        Kind::Mutant,
        "the thrust alone on the right is found",
        verdict,
    ))
}

/// `Σ μ' ξ'·∂ξ/∂q^s`.
fn carried(system: &System) -> Vec<Expr> {
    let g = &system.graph;
    let mut sums = vec![Vec::new(); system.n()];
    for particle in &system.particles {
        let rate = system.total_derivative(particle.mass);
        let slopes = g.jacobian(&particle.position, &system.coordinate_symbols());
        for (own, row) in particles::velocity(system, particle).iter().zip(slopes) {
            for (sum, slope) in sums.iter_mut().zip(row) {
                sum.push(g.mul(&[rate, *own, slope]));
            }
        }
    }
    sums.iter().map(|parts| g.add(parts)).collect()
}

fn trial(kind: Kind, law: &'static str, verdict: Verdict) -> Trial {
    Trial {
        kind,
        law,
        formulation: "",
        about: String::new(),
        expected: match kind {
            Kind::Mutant => Expected::Refuted,
            _ => Expected::Proved,
        },
        verdict,
        seconds: 0.0,
    }
}
