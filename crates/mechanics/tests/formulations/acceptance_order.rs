//! Acceptance of theory 2 §2–§6: constraints of order m, their lifting, Maggi's and Volterra's equations on the jet of the
//! characteristics, and the worked examples E2–E8.

use crate::common::{expect, Case};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::claims::order::dimension;

/// E2: path of prescribed curvature.
const CURVATURE: &str = r#"
coordinates = ["x", "y"]
parameters = { m = {}, g = {}, gamma = {} }
assumptions = ["m > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2)", V = "m g y" }
constraints = { bend = "x' y'' - y' x'' = gamma (x'^2 + y'^2)^(3/2)" }
"#;

/// E3: acceleration of fixed magnitude.
const MAGNITUDE: &str = r#"
coordinates = ["x", "y"]
parameters = { m = {}, k = {}, alpha = {} }
assumptions = ["m > 0", "alpha > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2)", V = "1/2 k (x^2 + y^2)" }
constraints = { push = "x''^2 + y''^2 = alpha^2" }
"#;

/// E4: linear, of third order.
const THIRD: &str = r#"
coordinates = ["x", "y"]
parameters = { gamma = {} }
lagrangian = { T = "1/2 (x'^2 + y'^2)", V = "1/2 gamma (x^2 + y^2)" }
constraints = { sum = "x''' + y''' = 0" }
"#;

/// E4b: linear, of third order, with a gradient that contains velocities.
const REACTION: &str = r#"
coordinates = ["x", "y"]
lagrangian = { T = "1/2 (x'^2 + y'^2)" }
constraints = { c = "x' x''' + y' y''' = 0" }
"#;

/// E5: jerk of fixed magnitude.
const JERK: &str = r#"
coordinates = ["x", "y"]
parameters = { m = {}, j = {} }
assumptions = ["m > 0", "j > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2)" }
constraints = { jerk = "x'''^2 + y'''^2 = j^2" }
"#;

const NAMES: [&str; 3] = ["maggi", "volterra-first", "volterra-second"];

#[test]
fn all_forms_are_equivalent_on_the_worked_examples() {
    for text in [CURVATURE, MAGNITUDE, THIRD, REACTION, JERK] {
        let case = Case::new(text);
        for name in NAMES {
            expect(&case, &format!("formulation.equivalent#{name}"), "proved");
        }
        for name in &NAMES[1..] {
            expect(&case, &format!("formulation.identity#{name}"), "proved");
            expect(
                &case,
                &format!("formulation.identity#{name}-special"),
                "proved",
            );
        }
        for claim in ["order.lifting", "order.characteristics", "order.determined"] {
            expect(&case, claim, "proved");
        }
    }
}

#[test]
fn states_have_the_dimensions_of_the_theory() {
    for (text, expected) in [
        (CURVATURE, (4, 0)),
        (MAGNITUDE, (4, 0)),
        (THIRD, (5, 1)),
        (REACTION, (5, 1)),
        (JERK, (6, 2)),
    ] {
        let case = Case::new(text);
        let cx = case.context();
        let equations = derive(&cx, "routh").unwrap();
        assert_eq!(dimension(&cx, &equations), expected, "{text}");
    }
}
