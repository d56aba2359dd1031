//! Moving frames: the quasi-velocities that follow from the fields, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused, same, vanishes};
use chetaev_model::{load, Model, NoFiles};
/// The fields and the quasi-velocities give back the velocity: v = X_0 + Σ η^s X_s.
fn give_the_velocity(model: &Model) {
    let (g, frame) = (&model.graph, model.frame.as_ref().unwrap());
    for i in 0..model.n() {
        let mut terms = vec![frame.drift[i], g.neg(model.jet(i, 1))];
        for (field, speed) in frame.fields.iter().zip(&model.quasi_velocities) {
            terms.push(g.mul(&[field[i], speed.value]));
        }
        vanishes(model, g.add(&terms));
    }
}

const SKATE: &str = r#"
coordinates = ["x", "y", "phi"]
parameters = { Omega = 2 }
[define]
c = "cos(phi)"
twice = "2 u"
[lagrangian]
T = "(u^2 + s^2 + w^2)/2"
[constraints]
blade = "s = 0"
[moving_frame]
drift = { x = "Omega y", y = "-Omega x" }
[moving_frame.fields]
u = { x = "c", y = "sin(phi)" }
w = { phi = 1 }
s = { x = "-sin(phi)", y = "c" }
"#;

#[test]
fn an_orthonormal_frame_gives_projections_of_the_velocity() {
    let model = model(SKATE);
    let names: Vec<&str> = model
        .quasi_velocities
        .iter()
        .map(|q| q.name.as_str())
        .collect();
    assert_eq!(names, ["u", "w", "s"]);
    let speed = |s: usize| model.quasi_velocities[s].value;
    same(
        &model,
        speed(0),
        "(x' - Omega y) cos(phi) + (y' + Omega x) sin(phi)",
    );
    assert_eq!(speed(1), model.jet(2, 1));
    same(
        &model,
        speed(2),
        "-(x' - Omega y) sin(phi) + (y' + Omega x) cos(phi)",
    );
    same(&model, model.defines[1].value, "2 u");
    same(
        &model,
        model.lagrangian,
        "((x' - Omega y)^2 + (y' + Omega x)^2 + phi'^2)/2",
    );
    same(&model, model.constraints[0].f, "s");
    give_the_velocity(&model);
    let (g, frame) = (&model.graph, model.frame.as_ref().unwrap());
    assert_eq!(frame.fields[1], [g.zero(), g.zero(), g.one()]);
    assert_eq!(frame.fields[0][0], g.cos(model.jet(2, 0)));
    assert_eq!(frame.drift[2], g.zero());
    assert_eq!(model.sources.text(model.quasi_velocities[2].place), "s");
}

#[test]
fn a_general_frame_with_time_and_controls_gives_back_the_velocity() {
    let model = model(
        "coordinates = [\"x\", \"y\", \"z\"]\nparameters = [\"a\"]\ncontrols = { k = {} }\nlagrangian = \"u_1^2 + x'^2 + y'^2 + z'^2\"\n\
         [moving_frame]\ndrift = { z = \"k' + t x\" }\n[moving_frame.fields]\n\
         u_1 = { x = \"1 + y^2\", y = \"x z\", z = \"a\" }\nu_2 = { x = \"t\", y = \"exp(x)\", z = \"k\" }\nu_3 = { x = \"sin(y)\", y = 2, z = \"x + z\" }\n",
    );
    give_the_velocity(&model);
    // Quasi-velocities can be differentiated like other names.
    let rate = model.expression("u_1'").unwrap();
    assert_eq!(
        rate,
        model.total_derivative(model.quasi_velocities[0].value)
    );
}

#[test]
fn families_of_fields_fix_the_index_of_their_name() {
    let model = model(
        "coordinates = [\"q_{i}\"]\nlagrangian = \"sum(i = 1..n, u_{i}^2)\"\n[sizes]\nn = 3\n[indices]\ni = \"1..n\"\nk = \"2..n\"\n\
         [moving_frame]\ndrift = { \"q_{k}\" = \"k\" }\n[moving_frame.fields]\n\"u_{i}\" = { \"q_{i}\" = \"1/i\" }\n",
    );
    for (s, written) in ["q_1'", "2 (q_2' - 2)", "3 (q_3' - 3)"]
        .into_iter()
        .enumerate()
    {
        same(&model, model.quasi_velocities[s].value, written);
    }
    give_the_velocity(&model);
}

#[test]
fn a_warning_in_a_field_leaves_the_frame_as_it_is() {
    let text = SKATE.replace("w = { phi = 1 }", "w = { phi = \"1/2 Omega/Omega y/y\" }");
    let loaded = load("model.toml", &text, &NoFiles, &[]);
    assert!(!loaded.diagnostics.list.is_empty());
    let model = loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
    same(&model, model.quasi_velocities[1].value, "2 phi'");
    assert!(model.frame.is_some());
}

#[test]
fn a_frame_has_as_many_fields_as_coordinates() {
    let missing = SKATE.replace("w = { phi = 1 }\n", "").replace(" + w^2", "");
    let words = [
        "for 3 coordinates there are 2 fields",
        "[quasi_velocities]",
        "model.toml:15:1",
    ];
    refused(&missing, 1, &words);
    refused(
        &format!("{SKATE}z = {{ x = 1 }}\n"),
        1,
        &["for 3 coordinates there are 4 fields"],
    );
    refused(
        "coordinates = [\"x\"]\nlagrangian = \"x'^2\"\n[moving_frame]\n",
        1,
        &["a frame needs its `fields`", "[moving_frame.fields]"],
    );
}

#[test]
fn fields_that_do_not_span_the_velocities_are_named() {
    let with = |s: &str| SKATE.replace("s = { x = \"-sin(phi)\", y = \"c\" }", s);
    refused(
        &with("s = {}"),
        1,
        &["the field `s` vanishes", "model.toml:16:1"],
    );
    refused(
        &with("s = { x = \"c - cos(phi)\" }"),
        1,
        &["the field `s` vanishes"],
    );
    refused(
        &with("s = { x = \"2 c\", y = \"sin(2 phi)/c\" }"),
        1,
        &[
            "the field `s` depends on the others",
            "rank of their components is 2, and 3 is needed",
        ],
    );
    refused(
        &SKATE.replace("w = { phi = 1 }", "w = { x = \"y\" }"),
        1,
        &["none of the fields `u`, `w` and `s` moves the coordinate `phi`"],
    );
}

#[test]
fn fields_are_functions_of_coordinates_and_time() {
    let words = [
        "`x'` may not occur in the drift of a frame",
        "`u` is a quasi-velocity and may not occur in a field of a frame",
        "`phi'` may not occur in a field of a frame",
        "there is no coordinate `psi`",
        "unknown name `cc`",
        "`x'` has a prime, and a field has components along the coordinates",
    ];
    let text = SKATE
        .replace("\"Omega y\"", "\"Omega y + x'\"")
        .replace("w = { phi = 1 }", "w = { phi = \"u\", psi = 1 }")
        .replace("x = \"-sin(phi)\"", "x = \"-sin(phi')\"")
        .replace("u = { x = \"c\"", "u = { x = \"cc\", \"x'\" = 2");
    refused(&text, words.len(), &words);
    let circle = SKATE.replace("c = \"cos(phi)\"", "c = \"cos(phi) + s\"");
    refused(&circle, 1, &["need each other", "belongs to the circle"]);
}

#[test]
fn statements_that_exclude_each_other_or_are_no_fields() {
    let both = format!("{SKATE}[quasi_velocities]\nv = \"x'\"\n");
    let words = [
        "by [quasi_velocities] or by [moving_frame], not by both",
        "the other statement",
    ];
    refused(&both, 1, &words);
    let direct = SKATE.replace("[moving_frame.fields]\n", "");
    refused(
        &direct,
        1,
        &[
            "`u` is no key of [moving_frame]",
            "fields stand under [moving_frame.fields]",
        ],
    );
    refused(
        &SKATE.replace("{ phi = 1 }", "\"phi'\""),
        1,
        &["a field must be a table of components"],
    );
    refused(
        &SKATE.replace("u = { x", "\"u'\" = { x"),
        3,
        &["`u'` has a prime"],
    );
    refused(
        &SKATE.replace("w = {", "x = {").replace(" + w^2", ""),
        1,
        &["`x` is a coordinate already"],
    );
}

const WITH_UNITS: &str = r#"
[coordinates]
x = "m"
y = "m"
phi = "rad"
[parameters]
m = { value = 1, unit = "kg" }
R = { value = 2, unit = "m" }
Omega = { value = 3, unit = "1/s" }
[lagrangian]
T = "m/2 (u^2 + s^2) + m/2 R^2 w^2"
[moving_frame]
drift = { x = "Omega y", y = 0 }
[moving_frame.fields]
u = { x = "cos(phi)", y = "sin(phi)" }
w = { phi = 1, x = "R" }
s = { x = "-sin(phi)", y = "cos(phi)" }
"#;

#[test]
fn units_of_fields_are_checked() {
    assert!(model(WITH_UNITS).has_units);
    let changed = |from: &str, to: &str, words: &[&str]| {
        assert!(WITH_UNITS.contains(from));
        refused(&WITH_UNITS.replace(from, to), 1, words);
    };
    changed(
        "w = { phi = 1, x = \"R\" }",
        "w = { phi = 1, x = 2 }",
        &[
            "the components of a field give `w` different dimensions, 1/s and m/s",
            "this makes it m/s",
        ],
    );
    changed(
        "\"Omega y\"",
        "\"y\"",
        &["`x'` has the dimension m/s, and this has m"],
    );
    changed("R^2 w^2", "w^2", &["terms of different dimension"]);
}
