//! Operators for the variations of velocities: what they are read as, and what is refused.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use crate::common::{model, refused};

const OSCILLATOR: &str = r#"
coordinates = ["x", "y"]
parameters = { m = 2, h = 0.5 }
lagrangian = { T = "1/2 m (x'^2 + y'^2)" }
"#;

#[test]
fn operators_are_linear_in_displacements_and_their_derivatives() {
    let text = format!(
        "{OSCILLATOR}[variation.mine]\nx = \"delta_x' - h y' delta_y + t delta_x'''\"\n[variation.none]\n"
    );
    let model = model(&text);
    let names: Vec<&str> = model.variations.iter().map(|v| v.name.as_str()).collect();
    assert_eq!(names, ["mine", "none"]);
    assert!(model.variations[1].relations.is_empty());
    let [(coordinate, value)] = model.variations[0].relations[..] else {
        panic!("{:?}", model.variations[0]);
    };
    assert_eq!(coordinate, 0);
    let g = &model.graph;
    let third = g.diff(value, g.intern_symbol("delta_x", 3));
    assert_eq!(third, model.time);
    let first = g.diff(value, g.intern_symbol("delta_x", 1));
    assert!(g.is_one(first));
}

/// Each slip by its code.
#[test]
fn slips_are_named() {
    for (section, code) in [
        ("[variation.a]\nx = \"delta_x^2\"", "not-linear"),
        ("[variation.a]\nx = \"delta_x + 1\"", "not-linear"),
        ("[variation.a]\nx = \"m\"", "not-linear"),
        ("[variation.a]\nz = \"delta_x\"", "not-a-coordinate"),
        ("[variation.a]\n\"x'\" = \"delta_x\"", "not-a-coordinate"),
        ("[variation.a]\nx = \"delta_z\"", "unknown-name"),
        ("[variation.hoelder]\nx = \"delta_x'\"", "duplicate-name"),
        ("[variation]\na = 3", "wrong-kind"),
    ] {
        refused(&format!("{OSCILLATOR}{section}\n"), 1, &[code]);
    }
    // A name of the model that a displacement would have.
    let taken = OSCILLATOR.replace("h = 0.5", "delta_y = 0.5");
    refused(
        &format!("{taken}[variation.a]\nx = \"delta_x\"\n"),
        1,
        &["duplicate-name", "delta_y"],
    );
    // Displacements occur there only.
    let elsewhere = OSCILLATOR.replace("1/2 m", "1/2 m delta_x");
    refused(&elsewhere, 1, &["unknown-name"]);
}
