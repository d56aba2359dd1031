//! Particles: what they are read as, the kinetic energy they give, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused, same};
use chetaev_model::{load, NoFiles};
use std::collections::BTreeMap;

const PENDULUM: &str = r#"
coordinates = ["theta"]
parameters = { m = 1, l = 0.5, g = 9.81 }
[particles.bob]
mass = "m"
position = ["l sin(theta)", "-l cos(theta)"]
force = ["0", "-m g"]
description = "a bob"
"#;

#[test]
fn the_kinetic_energy_is_that_of_the_particles() {
    let model = model(PENDULUM);
    assert!(model.kinetic_from_particles && model.potential.is_none());
    same(&model, model.kinetic.unwrap(), "1/2 m l^2 theta'^2");
    assert_eq!(model.kinetic, Some(model.lagrangian));
    let bob = &model.particles[0];
    assert_eq!(
        (bob.name.as_str(), bob.description.as_str()),
        ("bob", "a bob")
    );
    assert_eq!(model.sources.text(bob.place), "bob");
    let g = &model.graph;
    assert_eq!(bob.mass, g.symbol("m", 0));
    assert_eq!(bob.position[0], model.expression("l sin(theta)").unwrap());
    assert_eq!(bob.force, [g.zero(), model.expression("-m g").unwrap()]);
    // The forces of particles are not those of coordinates.
    assert!(model.forces.is_empty());
}

#[test]
fn a_potential_beside_particles_is_subtracted() {
    let text = PENDULUM.replace("force = [\"0\", \"-m g\"]\n", "")
        + "[lagrangian]\nV = \"-m g l cos(theta)\"\n";
    let model = model(&text);
    assert!(model.kinetic_from_particles);
    same(
        &model,
        model.lagrangian,
        "1/2 m l^2 theta'^2 + m g l cos(theta)",
    );
    assert_eq!(model.particles[0].force, [model.graph.zero(); 2]);
}

#[test]
fn stated_energies_are_taken_as_they_are() {
    for (stated, lagrangian, kinetic) in [
        (
            "[lagrangian]\nT = \"7 theta'^2\"\nV = \"g\"\n",
            "7 theta'^2 - g",
            Some("7 theta'^2"),
        ),
        ("[lagrangian]\nL = \"7 theta'^2\"\n", "7 theta'^2", None),
    ] {
        let model = model(&format!("{PENDULUM}{stated}"));
        assert!(!model.kinetic_from_particles);
        assert_eq!(model.particles.len(), 1);
        assert_eq!(model.lagrangian, model.expression(lagrangian).unwrap());
        let kinetic = kinetic.map(|kinetic| model.expression(kinetic).unwrap());
        assert_eq!(model.kinetic, kinetic);
    }
}

#[test]
fn positions_move_with_the_time_and_with_controls() {
    let model = model(
        "coordinates = [\"x\"]\nparameters = [\"m\"]\ncontrols = { u = \"sin(t)\" }\n[define]\np = \"x u\"\n\
         [particles.a]\nmass = \"2 m\"\nposition = [\"p + t^2\"]\nforce = [\"p' + u'\"]\n",
    );
    same(&model, model.lagrangian, "m (x' u + x u' + 2 t)^2");
    same(&model, model.particles[0].force[0], "x' u + x u' + u'");
}

const CHAIN: &str = r#"
coordinates = ["x", "theta_{i}"]
parameters = { l = 2 }
[sizes]
n = 2
[indices]
i = "1..n"
[particles.cart]
mass = 3
position = ["x"]
[particles."link_{i}"]
mass = "1/i"
position = ["x + sum(j = 1..i, l sin(theta_{j}))", "-sum(j = 1..i, l cos(theta_{j}))"]
force = [0, "-i"]
"#;

#[test]
fn families_of_particles_are_expanded() {
    let model = model(CHAIN);
    let names: Vec<&str> = model.particles.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["cart", "link_1", "link_2"]);
    let g = &model.graph;
    assert_eq!(
        g.as_number(model.particles[2].mass).unwrap().to_string(),
        "1/2"
    );
    assert_eq!(model.particles[2].force[1], g.integer(-2));
    // Two links with masses 1 and 1/2 below a cart of mass 3, by hand.
    same(
        &model,
        model.lagrangian,
        "3/2 x'^2 + 1/2 (x'^2 + 2 l x' theta_1' cos(theta_1) + l^2 theta_1'^2) \
         + 1/4 (x'^2 + 2 l x' (theta_1' cos(theta_1) + theta_2' cos(theta_2)) \
         + l^2 (theta_1'^2 + theta_2'^2 + 2 theta_1' theta_2' cos(theta_1 - theta_2)))",
    );
}

#[test]
fn an_included_particle_can_be_changed_key_by_key() {
    let files = BTreeMap::from([("base.toml".to_owned(), PENDULUM.to_owned())]);
    let over = "include = \"base.toml\"\n[particles.bob]\nmass = \"4 m\"\n";
    let loaded = load("model.toml", over, &files, &[]);
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    same(&model, model.lagrangian, "2 m l^2 theta'^2");
    assert_eq!(model.particles[0].force.len(), 2);
    let set = [("m".to_owned(), "0".to_owned())];
    let massless = load("model.toml", over, &files, &set)
        .diagnostics
        .to_string();
    assert!(
        massless.contains("the mass of the particle `bob` is zero"),
        "{massless}"
    );
}

#[test]
fn a_mass_may_vary_but_is_not_zero() {
    for (mass, same_as) in [
        ("m theta", "1/2 m theta l^2 theta'^2"),
        ("m t theta'", "1/2 m t theta' l^2 theta'^2"),
        ("m s'", "m theta' l^2 theta'^2"),
    ] {
        let text = PENDULUM.replace("mass = \"m\"", &format!("mass = \"{mass}\""))
            + "[define]\ns = \"2 theta\"\n";
        let model = model(&text);
        same(&model, model.lagrangian, same_as);
    }
    for (mass, words) in [
        ("m - 1", "the mass of the particle `bob` is zero"),
        ("0", "the mass of the particle `bob` is zero"),
        (
            "m theta''",
            "`theta''` may not occur in the mass of a particle",
        ),
        (
            "m s''",
            "`s''` contains `theta''`, which may not occur in the mass of a particle",
        ),
    ] {
        let text = PENDULUM.replace("mass = \"m\"", &format!("mass = \"{mass}\""))
            + "[define]\ns = \"2 theta\"\n";
        refused(&text, 1, &[words, "model.toml:5:"]);
    }
    let negative = PENDULUM.replace("mass = \"m\"", "mass = \"-m\"");
    let loaded = load("model.toml", &negative, &NoFiles, &[]);
    assert!(loaded.model.is_some());
    assert!(loaded.diagnostics.to_string().contains("is negative"));
}

#[test]
fn positions_have_no_velocities_and_forces_no_accelerations() {
    let text = PENDULUM
        .replace("l sin(theta)", "l sin(theta')")
        .replace("\"0\"", "\"theta''\"");
    let words = [
        "`theta'` may not occur in the position of a particle",
        "only coordinates, controls, parameters and the time",
        "model.toml:6:20",
        "`theta''` may not occur in the force on a particle",
        "model.toml:7:11",
    ];
    refused(&text, 2, &words);
}

#[test]
fn every_problem_of_a_particle_is_reported_at_once() {
    let text = r#"
coordinates = ["x"]
[particles.a]
mas = 1
position = ["x", "y", "x", "x"]
[particles.b]
mass = "x"
position = "x"
force = []
[particles.c]
mass = "q"
position = ["z", "x'"]
force = ["x", "x", "x''"]
"#;
    let words = [
        "`mas` is no key of a particle",
        "did you mean `mass`?",
        "the particle `a` needs its `mass`",
        "has 1 to 3 components, not 4",
        "must be an array of 1 to 3 expressions, not a text",
        "position = [\"x\"]",
        "has 1 to 3 components, not 0",
        "unknown name `q`",
        "unknown name `z`",
        "`x'` may not occur in the position",
        "as many components as its position, 2, not 3",
        "`x''` may not occur in the force",
    ];
    refused(text, 10, &words);
    let twice = format!("{CHAIN}[particles.link_2]\nmass = 1\nposition = [\"x\"]\n");
    refused(
        &twice,
        1,
        &["two particles are called `link_2`", "first here"],
    );
    refused(
        "coordinates = [\"x\"]\nparticles = [1]\n",
        2,
        &["`particles` must be a table"],
    );
}

#[test]
fn a_model_without_lagrangian_is_told_of_particles() {
    let words = ["the model has no Lagrangian", "or state [particles]"];
    refused("coordinates = [\"x\"]\n", 1, &words);
    refused("coordinates = [\"x\"]\n[particles]\n", 1, &words);
    refused(
        "coordinates = [\"x\"]\n[particle.a]\n",
        2,
        &["did you mean `particles`?"],
    );
}

const WITH_UNITS: &str = r#"
[coordinates]
x = "m"
theta = "rad"
[parameters]
m = { value = 1, unit = "kg" }
l = { value = 50, unit = "cm" }
g = { value = 9.81, unit = "m/s^2" }
[particles.cart]
mass = "2 m"
position = ["x"]
[particles.bob]
mass = "m"
position = ["x + l sin(theta)", "-l cos(theta)"]
force = [0, "-m g"]
[lagrangian]
V = "m g l"
[forces]
theta = "m g l"
"#;

#[test]
fn units_of_particles_are_checked() {
    assert!(model(WITH_UNITS).has_units);
    model(&WITH_UNITS.replace("mass = \"2 m\"", "mass = 2"));
    let changed = |from: &str, to: &str, words: &[&str]| {
        assert!(WITH_UNITS.contains(from));
        refused(&WITH_UNITS.replace(from, to), 1, words);
    };
    changed(
        "mass = \"m\"",
        "mass = \"l\"",
        &[
            "this mass has the dimension m, and another one has kg",
            "model.toml:13:9",
        ],
    );
    changed(
        "\"-l cos(theta)\"]",
        "\"-cos(theta)\"]",
        &[
            "this length has the dimension 1, and another one has m",
            "model.toml:14:34",
        ],
    );
    changed(
        "x + l sin",
        "x + sin",
        &["terms of different dimension, m and 1"],
    );
    changed(
        "\"-m g\"]",
        "\"-g\"]",
        &["the force on a particle has the dimension kg m/s^2, and this has m/s^2"],
    );
    changed(
        "V = \"m g l\"",
        "V = \"m g\"",
        &[
            "this has the dimension kg m/s^2, and the rest of the Lagrangian has kg m^2/s^2",
            "the kinetic energy of the particles has kg m^2/s^2",
        ],
    );
    changed(
        "theta = \"m g l\"",
        "theta = \"m g\"",
        &["the force on `theta` has the dimension of L/theta, kg m^2/s^2"],
    );
}
