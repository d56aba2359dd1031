//! What particles give to a system (T1 §9.2, T2 §2).

use crate::formulations::common::{expect, Case, PARTICLE};
use crate::formulations::gibbs_appell::{BEAD, PARTICLE_POLAR};
use chetaev_mechanics::particles;
use chetaev_mechanics::system::{Particle, Thrust};
use chetaev_mechanics::{System, SystemParts};
use std::sync::Arc;

/// Terms linear in the velocities beside the particles are forces: L = T + x y' acts as (y', -x').
#[test]
fn a_magnetic_term_is_a_force_beside_the_particles() {
    let text = r#"
coordinates = ["x", "y"]
parameters = { m = {} }
assumptions = ["m > 0"]
lagrangian = { L = "1/2 m (x'^2 + y'^2) + x y'" }
forces = { x = "-x" }
[particles.p]
mass = "m"
position = ["x", "y"]
force = ["0", "-1"]
"#;
    let case = Case::new(text);
    expect(&case, "model.particles", "proved");
    let further = particles::further_forces(&case.system);
    assert!(case.equal(further[0], case.read("y' - x")));
    assert!(case.equal(further[1], case.read("-x'")));
    let applied = particles::applied_forces(&case.system);
    assert!(case.equal(applied[1], case.read("-1")));
    for name in [
        "gibbs-appell",
        "kane",
        "volterra-first-cartesian",
        "volterra-second-cartesian",
    ] {
        expect(&case, &format!("formulation.equivalent#{name}"), "proved");
    }
}

#[test]
fn the_kinetic_energy_of_a_moving_place() {
    let case = Case::new(BEAD);
    let expected = case.read("m R^2 (theta'^2 + W^2 sin(theta)^2)/2");
    assert!(case.equal(particles::kinetic_energy(&case.system), expected));
}

/// A T that differs from that of the particles by an identity of sines and cosines only.
#[test]
fn a_stated_energy_may_be_written_otherwise() {
    let text = PARTICLE_POLAR.replace(
        "[particles.p]",
        "lagrangian = { T = \"1/2 m (r'^2 + r^2 theta'^2)\" }\n[particles.p]",
    );
    let case = Case::new(&text);
    expect(&case, "model.particles", "proved");
    expect(&case, "formulation.equivalent#kane", "proved");
    let heavier = text.replace("1/2 m (r'^2", "m (r'^2");
    let (word, detail) = Case::new(&heavier).verdict("model.particles");
    assert_eq!(word, "refuted", "{detail}");
}

/// Without particles nothing is said of Cartesian coordinates, and the claims asked for say why.
#[test]
fn without_particles_the_claims_are_not_applicable() {
    let case = Case::new(PARTICLE);
    let cx = case.context();
    // Formulations built from particles name this claim as the hypothesis that fails, so every study states it.
    for (id, stated) in [("model.particles", 1), ("model.cartesian-coordinates", 0)] {
        let claim = cx.registry().find(id).unwrap();
        assert_eq!(claim.subjects(&cx).len(), stated);
        let (word, detail) = case.verdict(id);
        assert_eq!(word, "not-applicable");
        assert!(detail.contains("the model states no particles"), "{detail}");
    }
}

/// The masses by coordinate, from parts without a model file.
#[test]
fn masses_of_cartesian_coordinates() {
    let graph = Arc::new(chetaev_symbolic::Graph::new());
    let g = &*graph;
    let (x, y) = (g.symbol("x", 0), g.symbol("y", 0));
    let particle = |name: &str, mass: i64, place| Particle {
        name: name.into(),
        mass: g.integer(mass),
        position: vec![place],
        force: vec![g.zero()],
        thrust: Thrust::default(),
    };
    let parts = SystemParts {
        coordinates: vec!["x".into(), "y".into()],
        lagrangian: Some(g.powi(g.symbol("x", 1), 2)),
        particles: vec![particle("b", 3, y), particle("a", 2, x)],
        ..SystemParts::default()
    };
    let system = System::new(graph.clone(), parts).unwrap();
    let masses = particles::coordinate_masses(&system).unwrap();
    assert_eq!(masses, [g.integer(2), g.integer(3)]);
}
