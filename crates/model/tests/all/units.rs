//! Units: values in SI base units, dimensions checked everywhere.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_model::{load, Loaded, NoFiles, Severity};

fn read(text: &str) -> Loaded {
    load("model.toml", text, &NoFiles, &[])
}

const PENDULUM: &str = r#"
[coordinates]
theta = { unit = "rad", description = "angle from the vertical" }
[parameters]
m = { value = 200, unit = "g" }
l = { value = 25, unit = "cm", range = [10, 50] }
g = { value = 9.81, unit = "m/s^2" }
c = { value = 0.01, unit = "N m s" }
start = { value = 30, unit = "deg" }
[define]
omega2 = { value = "g/l", unit = "1/s^2" }
[lagrangian]
T = "1/2 m l^2 theta'^2"
V = "m g l (1 - cos(theta))"
[forces]
theta = "-c theta' + 0"
rayleigh = "1/2 c theta'^2"
[initial]
theta = "start"
"theta'" = 0.5
[simulation]
t_end = "2 pi sqrt(l/g)"
[integrals]
energy = "theta'^2/2 + omega2 (1 - cos(theta))"
"#;

#[test]
fn values_are_in_si_base_units_exactly() {
    let (model, diagnostics) = read(PENDULUM)
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    assert!(diagnostics.list.is_empty(), "{diagnostics}");
    assert!(model.has_units);
    let g = &model.graph;
    let value = |name: &str| {
        model
            .parameters
            .iter()
            .find(|p| p.name == name)
            .unwrap()
            .value
            .unwrap()
    };
    assert_eq!(g.as_number(value("m")).unwrap().to_string(), "1/5");
    assert_eq!(g.as_number(value("l")).unwrap().to_string(), "1/4");
    assert_eq!(value("start"), g.div(g.pi(), g.integer(6)));
    let (low, high) = model.parameters[1].range.unwrap();
    assert_eq!(
        (
            g.as_number(low).unwrap().to_string(),
            g.as_number(high).unwrap().to_string()
        ),
        ("1/10".into(), "1/2".into())
    );
}

/// The message about a model that differs from the pendulum in one place.
fn changed(from: &str, to: &str) -> String {
    assert!(PENDULUM.contains(from));
    let loaded = read(&PENDULUM.replace(from, to));
    let errors = loaded
        .diagnostics
        .list
        .iter()
        .filter(|d| d.severity == Severity::Error)
        .count();
    assert!(
        errors == 1 && loaded.model.is_none(),
        "{}",
        loaded.diagnostics
    );
    loaded.diagnostics.to_string()
}

#[test]
fn mismatches_are_reported_with_both_dimensions() {
    let both = |message: String, a: &str, b: &str| {
        assert!(message.contains(a) && message.contains(b), "{message}")
    };
    both(changed("m g l (1", "m g (1"), "kg m^2/s^2", "kg m/s^2");
    both(
        changed("1/2 m l^2 theta'^2\"", "1/2 m l^2 theta'^2 + m l\""),
        "kg m^2/s^2",
        "kg m",
    );
    both(
        changed(
            "1 - cos(theta))\"\n[forces]",
            "1 - cos(l theta))\"\n[forces]",
        ),
        "`cos`",
        "dimension m",
    );
    both(
        changed("-c theta' + 0", "-c theta"),
        "kg m^2/s^2",
        "kg m^2/s",
    );
    both(
        changed("1/2 c theta'^2", "c theta'"),
        "kg m^2/s^3",
        "kg m^2/s^2",
    );
    both(
        changed("theta = \"start\"", "theta = \"g\""),
        "`theta`",
        "m/s^2",
    );
    both(changed("sqrt(l/g)", "sqrt(l g)"), "dimension s", "m/s");
    both(
        changed("unit = \"1/s^2\"", "unit = \"1/s\""),
        "1/s^2",
        "1/s",
    );
    both(changed("omega2 (1", "g (1"), "1/s^2", "m/s^2");
    both(
        changed("unit = \"cm\"", "unit = \"cn\""),
        "unknown unit `cn`",
        "did you mean",
    );
    both(
        changed(
            "value = 25, unit = \"cm\", range = [10, 50]",
            "value = \"g*1\", unit = \"cm\"",
        ),
        "SI base units",
        "`cm`",
    );
    both(
        changed("unit = \"rad\"", "unit = \"deg\""),
        "without prefix",
        "rad",
    );
}

#[test]
fn a_parameter_without_unit_gives_a_warning_and_no_inference() {
    let loaded = read(&PENDULUM.replace("m = { value = 200, unit = \"g\" }", "m = 0.2"));
    assert!(loaded.model.is_some(), "{}", loaded.diagnostics);
    let message = loaded.diagnostics.to_string();
    assert!(
        message.contains("the parameter `m` has no unit") && message.ends_with("1 warning"),
        "{message}"
    );
}

#[test]
fn constraints_compare_their_sides() {
    let text = |equation: &str| {
        format!("[coordinates]\nx = \"m\"\nphi = \"rad\"\n[parameters]\nR = {{ value = 1, unit = \"m\" }}\n[lagrangian]\nT = \"x'^2 + R^2 phi'^2\"\n[constraints]\nroll = \"{equation}\"\n")
    };
    assert!(read(&text("x' = R phi'")).model.is_some());
    assert!(read(&text("x' = 0")).model.is_some());
    assert!(read(&text("x' - R phi' = 0")).model.is_some());
    let message = read(&text("x' = phi'")).diagnostics.to_string();
    assert!(
        message.contains("m/s") && message.contains("1/s") && message.contains("model.toml:9:14"),
        "{message}"
    );
}

#[test]
fn a_model_without_units_is_not_checked() {
    let loaded =
        read("coordinates = [\"x\"]\nparameters = { m = 1 }\nlagrangian = \"m x'^2 + x + sin(m)\"");
    assert!(loaded.model.is_some_and(|model| !model.has_units));
}

#[test]
fn a_misspelt_unit_is_one_problem() {
    let text = "[coordinates]\nx = \"metre\"\ny = \"m\"\nz = \"km\"\n[parameters]\nm = { value = 1, unit = \"kgg\" }\n\
        k = 2\n[controls]\nu = { value = \"1\", unit = \"New\" }\n[lagrangian]\nT = \"y'^2\"\n";
    let loaded = read(text);
    let found: Vec<(&str, usize)> = loaded
        .diagnostics
        .list
        .iter()
        .zip(loaded.diagnostics.to_data())
        .map(|(d, data)| (d.code, data.at.line))
        .collect();
    assert_eq!(
        found,
        [
            ("unknown-unit", 2),
            ("incoherent-unit", 4),
            ("unknown-unit", 6),
            ("missing-unit", 7),
            ("unknown-unit", 9)
        ],
        "{}",
        loaded.diagnostics
    );
}

#[test]
fn what_has_no_unit_is_said_in_one_warning() {
    let text = "coordinates = [\"x\"]\nparameters = { m = \"250 g\", a = \"10 deg\", k = 3, c = 1 }\nlagrangian = \"m x'^2/2 - k x^2 cos(a) - c x\"\n";
    let loaded = read(text);
    assert!(loaded.model.is_some(), "{}", loaded.diagnostics);
    let found = loaded.diagnostics.list.iter();
    let found: Vec<(&str, &str)> = found.map(|d| (d.code, d.message.as_str())).collect();
    // The angle is a pure number, and needs no unit.
    let message = "3 quantities have no unit, while others have: `x`, `k`, `c`";
    assert_eq!(found, [("missing-unit", message)]);
}
