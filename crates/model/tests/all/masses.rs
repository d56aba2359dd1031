//! Named masses, masses with a law of their own, and thrust: what they are read as, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused, same, vanishes};
use chetaev_model::model::{MassLaw, Thrust};
use chetaev_model::{load, ModelBuilder, NoFiles};
const ROCKET: &str = r#"
coordinates = ["x", "y"]
parameters = { k = 0.1, c = 20 }
[masses]
M = { rate = "-k M", initial = "2 k" }
S = "3 + x^2"
[particles.rocket]
mass = "M + S"
position = ["x", "y"]
thrust = { exhaust_speed = "c" }
[integrals]
momentum = "M x' + M' t"
"#;

#[test]
fn masses_are_names_with_derivatives() {
    let model = model(ROCKET);
    let names: Vec<&str> = model.masses.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["M", "S"]);
    let MassLaw::Rate { rate, initial } = &model.masses[0].law else {
        panic!("{:?}", model.masses[0]);
    };
    same(&model, *rate, "-k M");
    same(&model, *initial, "2 k");
    assert!(matches!(model.masses[1].law, MassLaw::Value(_)));
    // A definition stands with its value; a mass with a law is a symbol, and its derivatives are those of its law.
    same(&model, model.particles[0].mass, "M + 3 + x^2");
    same(&model, model.integrals[0].value, "M x' - k M t");
    same(&model, model.expression("M''").unwrap(), "k^2 M");
    same(&model, model.expression("S'").unwrap(), "2 x x'");
    assert!(matches!(model.particles[0].thrust, Thrust::ExhaustSpeed(_)));
}

#[test]
fn laws_may_need_each_other_but_not_in_a_circle() {
    let chained = ROCKET.replace(
        "S = \"3 + x^2\"",
        "S = \"3 + x^2\"\nA = { rate = \"2 B' + A\", initial = 1 }\nB = { rate = \"M' x' - A\", initial = 1 }",
    );
    let chained = model(&chained);
    let rate = chained.mass_rate("A").unwrap();
    same(&chained, rate, "2 (-k M x' - A) + A");
    let circle = ROCKET.replace(
        "S = \"3 + x^2\"",
        "S = 3\nA = { rate = \"2 B'\", initial = 1 }\nB = { rate = \"A'\", initial = 1 }",
    );
    refused(
        &circle,
        1,
        &["the definitions of `A'` and `B'` need each other"],
    );
}

#[test]
fn all_thrusts_are_read() {
    let with = |thrust: &str| {
        let text = ROCKET.replace("{ exhaust_speed = \"c\" }", thrust);
        model(&text).particles[0].thrust.clone()
    };
    assert_eq!(with("\"isotropic\""), Thrust::Isotropic);
    assert!(
        matches!(with("{ relative_velocity = [\"c\", 0] }"), Thrust::RelativeVelocity(u) if u.len() == 2)
    );
    assert!(matches!(
        with("{ absolute_velocity = [0, \"x'\"] }"),
        Thrust::AbsoluteVelocity(_)
    ));
    assert!(matches!(
        with("{ force = [0, \"M c t\"] }"),
        Thrust::Force(_)
    ));
    let left_out = ROCKET.replace("thrust = { exhaust_speed = \"c\" }\n", "");
    assert_eq!(model(&left_out).particles[0].thrust, Thrust::Isotropic);
}

#[test]
fn what_is_wrong_is_said_at_its_place() {
    let changed = |from: &str, to: &str, words: &[&str]| {
        assert!(ROCKET.contains(from), "{from}");
        refused(&ROCKET.replace(from, to), 1, words);
    };
    let thrust = "{ exhaust_speed = \"c\" }";
    changed(
        thrust,
        "{ exhaust_speed = \"c\", force = [0, 0] }",
        &[
            "the thrust is stated twice, by `exhaust_speed` and by `force`",
            "model.toml:10:33",
            "leave one",
        ],
    );
    changed(
        thrust,
        "{ relative_velocity = [\"c\"] }",
        &[
            "as many components as its position, 2, not 1",
            "model.toml:10:32",
        ],
    );
    changed(
        thrust,
        "{ speed = \"c\" }",
        &["`speed` is no key of a thrust"],
    );
    changed(
        thrust,
        "{}",
        &["the thrust of a particle is empty", "exhaust_speed"],
    );
    changed(
        thrust,
        "\"isotrop\"",
        &["is \"isotropic\", or a table with one key"],
    );
    changed(
        thrust,
        "{ exhaust_speed = \"x''\" }",
        &["`x''` may not occur in a velocity of matter"],
    );
    changed(
        ", initial = \"2 k\"",
        "",
        &[
            "`M` has a law of its own and needs its `initial` value",
            "model.toml:5:1",
        ],
    );
    changed(
        "rate = \"-k M\", ",
        "",
        &["has no `rate`", "state the law of its own"],
    );
    changed(
        "rate = \"-k M\"",
        "rate = \"-k M\", value = 3",
        &["by its `value` or by its `rate`, not by both"],
    );
    changed(
        "-k M\"",
        "-k M x''\"",
        &[
            "`x''` may not occur in the rate of a mass",
            "model.toml:5:20",
        ],
    );
    changed(
        "\"2 k\"",
        "\"2 k x\"",
        &["the coordinate `x` may not occur in the initial value of a mass"],
    );
    changed(
        "\"2 k\"",
        "\"-k\"",
        &["the mass `M` must begin with a positive value"],
    );
    changed(
        "S = \"3 + x^2\"",
        "S = \"3 + x^2\"\nx = { rate = \"t\", initial = 1 }",
        &["`x` is a coordinate already, and cannot name a mass too"],
    );
    changed(
        "[\"x\", \"y\"]\nthrust",
        "[\"x M\", \"y\"]\nthrust",
        &["the mass `M` has a law of its own and may not occur in the position"],
    );
    changed(
        "[integrals]",
        "[constraints]\nc = \"M x' = y'\"\n[integrals]",
        &[
            "may not occur in a constraint",
            "the kinematics cannot depend on it",
        ],
    );
    changed(
        "[integrals]",
        "[quasi_velocities]\nu = \"M x'\"\n[integrals]",
        &["may not occur in a quasi-velocity"],
    );
    changed(
        "k = 0.1",
        "k = \"M\"",
        &["the mass `M` may not occur in the value of a parameter, which is constant"],
    );
}

#[test]
fn a_thrust_that_has_no_effect_is_noticed() {
    let text = ROCKET.replace("M + S", "2 k");
    let loaded = load("model.toml", &text, &NoFiles, &[]);
    assert!(loaded.model.is_some());
    let message = loaded.diagnostics.to_string();
    assert!(message.contains("its thrust has no effect"), "{message}");
    // A stated force acts whatever the mass does.
    model(&text.replace("{ exhaust_speed = \"c\" }", "{ force = [1, 0] }"));
}

#[test]
fn families_of_masses_and_thrust() {
    let text = r#"
coordinates = ["x_{i}"]
[sizes]
n = 3
[indices]
i = "1..n"
[masses]
"M_{i}" = { rate = "-M_{i}/i", initial = "i" }
[particles."car_{i}"]
mass = "M_{i}"
position = ["x_{i}"]
thrust = { relative_velocity = ["-i"] }
"#;
    let model = model(text);
    assert_eq!(model.masses.len(), 3);
    same(&model, model.mass_rate("M_2").unwrap(), "-M_2/2");
    same(&model, model.initial_mass("M_3").unwrap(), "3");
    let Thrust::RelativeVelocity(u) = &model.particles[2].thrust else {
        panic!()
    };
    same(&model, u[0], "-3");
}

const WITH_UNITS: &str = r#"
[coordinates]
x = "m"
[parameters]
k = { value = 2, unit = "kg/s" }
c = { value = 3, unit = "km/s" }
[masses]
M = { rate = "-k", initial = 3, unit = "kg" }
S = { value = "M + k t", unit = "kg" }
[particles.a]
mass = "S"
position = ["x"]
thrust = { relative_velocity = ["-c"] }
"#;

#[test]
fn units_of_masses_and_thrust_are_checked() {
    assert!(model(WITH_UNITS).has_units);
    let changed = |from: &str, to: &str, words: &[&str]| {
        assert!(WITH_UNITS.contains(from), "{from}");
        refused(&WITH_UNITS.replace(from, to), 1, words);
    };
    changed(
        "rate = \"-k\"",
        "rate = \"-k t\"",
        &["`M'` has the dimension kg/s, and this has kg"],
    );
    changed(
        "M + k t",
        "M + k",
        &["terms of different dimension, kg and kg/s"],
    );
    changed(
        "[\"-c\"]",
        "[\"-c t\"]",
        &["a velocity of matter has the dimension m/s, and this has m"],
    );
    changed(
        "{ relative_velocity = [\"-c\"] }",
        "{ force = [\"-c\"] }",
        &["the force on a particle has the dimension kg m/s^2, and this has m/s"],
    );
    changed(
        "initial = 3, unit = \"kg\"",
        "initial = 3, unit = \"g\"",
        &["without prefix, not in `g`", "state it in kg"],
    );
}

/// T with named masses as symbols, through definitions and their derivatives.
#[test]
fn a_stated_energy_is_kept_by_its_masses() {
    let model = model(
        r#"
coordinates = ["x"]
masses = { M = "3 - t" }
define = { I = "M x^2", p = "I'" }
lagrangian = { T = "1/2 I x'^2 + p x'" }
"#,
    );
    let by_masses = model.inertia_by_masses.unwrap();
    let g = &model.graph;
    let expected = g.mul(&[
        g.symbol("M", 0),
        model.expression("x^2 x'^2/2 + 2 x x'^2").unwrap(),
    ]);
    let expected = g.add(&[expected, model.expression("-x^2 x'").unwrap()]);
    vanishes(&model, g.sub(by_masses, expected));
    same(
        &model,
        model.kinetic.unwrap(),
        "(3 - t) (x^2 x'^2/2 + 2 x x'^2) - x^2 x'",
    );
}

#[test]
fn the_builder_states_masses() {
    let built = ModelBuilder::new("rocket")
        .coordinates(["x"])
        .mass("S", "3 - t")
        .mass_with_law("M", "-M", "2")
        .particle("a", "S + M", ["x"])
        .particle_thrust("a", "{ absolute_velocity = [0] }")
        .particle("b", "M", ["2 x"])
        .particle_thrust("b", "isotropic")
        .build();
    let model = built
        .model
        .unwrap_or_else(|| panic!("{}", built.diagnostics));
    assert!(matches!(
        model.particles[0].thrust,
        Thrust::AbsoluteVelocity(_)
    ));
    let stated = ModelBuilder::new("t")
        .coordinates(["x"])
        .mass("S", "3 - t")
        .kinetic("1/2 S x'^2")
        .reactive_force("x", "x'")
        .build();
    let model = stated
        .model
        .unwrap_or_else(|| panic!("{}", stated.diagnostics));
    assert_eq!(model.reactive_forces.map(|forces| forces.len()), Some(1));
}
