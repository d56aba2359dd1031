//! Chaplygin's equations (T1 §3).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, SKATE};

const CLAIM: &str = "formulation.equivalent#chaplygin";

#[test]
fn it_is_equivalent_to_routh_where_it_applies() {
    let level = SKATE.replace(", V = \"-m G x\"", "");
    let flat = APPELL_HAMEL.replace(", V = \"m g z\"", "");
    for text in [level.as_str(), DISC, PARTICLE, &flat] {
        expect(&Case::new(text), CLAIM, "proved");
    }
}

/// The dependent coordinates are those of the claim `model.chaplygin`, not the default choice: here x occurs in the constraint,
/// so that z must be dependent although the user wants its velocity independent.
#[test]
fn the_dependent_coordinates_are_those_that_occur_nowhere() {
    let text = r#"
coordinates = ["x", "y", "z"]
lagrangian = { L = "1/2 (x'^2 + y'^2 + z'^2)" }
constraints = { c = "z' = (y + x^2) x'" }
velocities = { independent = ["z'", "y'"] }
"#;
    let case = Case::new(text);
    expect(&case, "model.chaplygin", "proved");
    let names: Vec<String> = case
        .equations("chaplygin")
        .variables
        .iter()
        .map(|v| v.name.clone())
        .collect();
    assert_eq!(names, ["x'", "y'"]);
    expect(&case, CLAIM, "proved");
}

/// A factor that vanishes nowhere may contain the dependent coordinate: solved, z' = y x' is free of it.
#[test]
fn a_factor_of_the_constraint_is_no_dependence() {
    let text = r#"
coordinates = ["x", "y", "z"]
lagrangian = { L = "1/2 (x'^2 + y'^2 + z'^2) - x^2" }
constraints = { c = "(4 + z^2) (z' - y x') = 0" }
"#;
    let case = Case::new(text);
    let (word, detail) = case.verdict("model.chaplygin");
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("dependent coordinates z"), "{detail}");
    expect(&case, CLAIM, "proved");
    // x acts by the potential, z by no factor: no choice fits where z acts too.
    let text = text.replace("- x^2", "- x^2 - z");
    expect(&Case::new(&text), "model.chaplygin", "refuted");
}

/// z and x occur in L, and y in the constraint.
#[test]
fn it_says_why_it_does_not_apply() {
    let case = Case::new(&PARTICLE.replace("\"1/2 (x'^2", "\"-z - x + 1/2 (x'^2"));
    let (word, detail) = case.verdict(CLAIM);
    assert_eq!(word, "not-applicable", "{detail}");
    assert!(detail.contains("model.chaplygin"), "{detail}");
}

/// Either coordinate occurs nowhere; the claim names the one that the equations eliminate.
#[test]
fn the_claim_names_the_choice_of_the_equations() {
    let text = r#"
coordinates = ["x", "y", "z"]
lagrangian = { L = "1/2 (x'^2 + y'^2 + z'^2)" }
constraints = { c = "z' = (5 + y) x'" }
velocities = { independent = ["x'", "y'"] }
"#;
    let case = Case::new(text);
    let (word, detail) = case.verdict("model.chaplygin");
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("dependent coordinates z"), "{detail}");
}
