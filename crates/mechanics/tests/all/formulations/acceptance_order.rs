//! Acceptance of T2 §2–§6: constraints of order m, their lifting, Maggi's and Volterra's equations on the jet of the
//! characteristics, and the worked examples E2–E8.

use crate::formulations::common::{expect, Case};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::claims::order::dimension;
use chetaev_mechanics::{Manifold, Prover};
use chetaev_symbolic::Expr;

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

fn all_forms_are_proved(case: &Case) {
    for name in NAMES {
        expect(case, &format!("formulation.equivalent#{name}"), "proved");
    }
    for name in &NAMES[1..] {
        expect(case, &format!("formulation.identity#{name}"), "proved");
        let special = format!("formulation.identity#{name}-special");
        expect(case, &special, "proved");
    }
}

#[test]
fn all_forms_are_equivalent_on_the_worked_examples() {
    for text in [CURVATURE, MAGNITUDE, THIRD, REACTION, JERK] {
        let case = Case::new(text);
        all_forms_are_proved(&case);
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

/// E6 in two charts.
const RADIAL: &str = r#"
coordinates = ["x", "y"]
parameters = { m = {}, g = {} }
assumptions = ["m > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2)", V = "m g y" }
constraints = { across = "x x'' + y y'' = 0" }
"#;

const RADIAL_POLAR: &str = r#"
coordinates = ["r", "theta"]
parameters = { m = {}, g = {} }
assumptions = ["m > 0", "r > 0"]
lagrangian = { T = "1/2 m (r'^2 + r^2 theta'^2)", V = "m g r sin(theta)" }
constraints = { across = "r'' = r theta'^2" }
"#;

const ALL: [&str; 4] = ["routh", "maggi", "volterra-first", "volterra-second"];

/// The accelerations of all forms as functions of (q, v).
fn accelerations_are(case: &Case, expected: &[&str]) {
    for name in ALL {
        let found = case.equations(name).accelerations;
        for (a, text) in found.into_iter().zip(expected) {
            let difference = case.system.graph.sub(a, case.read(text));
            assert!(is_zero(case, difference), "{name}: {text}");
        }
    }
}

fn is_zero(case: &Case, e: Expr) -> bool {
    let prover = Prover::default();
    let verdict = prover.identity(&case.system, &[e], &Manifold::default(), "");
    verdict.word() == "proved"
}

#[test]
fn e2_the_curvature_turns_the_velocity_and_gravity_changes_its_size() {
    let case = Case::new(CURVATURE);
    for name in ALL {
        let a = case.equations(name).accelerations;
        let (x, y) = (case.read("x'"), case.read("y'"));
        let g = &case.system.graph;
        // v v' = -g y', and the constraint x' y'' - y' x'' = gamma v^3.
        let work = g.add(&[g.mul(&[x, a[0]]), g.mul(&[y, a[1]]), case.read("g y'")]);
        assert!(is_zero(&case, work), "{name}");
        let turn = g.add(&[
            g.mul(&[x, a[1]]),
            g.neg(g.mul(&[y, a[0]])),
            case.read("-gamma (x'^2 + y'^2)^(3/2)"),
        ]);
        assert!(is_zero(&case, turn), "{name}");
    }
}

#[test]
fn e6_two_charts_have_the_accelerations_of_the_theory() {
    let case = Case::new(RADIAL);
    accelerations_are(&case, &["g x y/(x^2 + y^2)", "-g x^2/(x^2 + y^2)"]);
    let case = Case::new(RADIAL_POLAR);
    let turning = "(-g r cos(theta) - 2 r r' theta')/r^2";
    accelerations_are(&case, &["r theta'^2", turning]);
}

/// The knife edge, replaced by its derivative of this order.
fn knife_edge(order: u32) -> Case {
    Case::new(&format!(
        r#"
coordinates = ["x", "y", "phi"]
lagrangian = {{ T = "1/2 (x'^2 + y'^2 + phi'^2)" }}
[constraints]
blade = {{ equation = "x' sin(phi) = y' cos(phi)", lifted = {order} }}
"#
    ))
}

#[test]
fn e7_the_knife_edge_keeps_its_accelerations_when_it_is_lifted() {
    // On x' sin(phi) = y' cos(phi), with x' = u cos(phi) and y' = u sin(phi): x'' = -phi' y', y'' = phi' x', phi'' = 0.
    for order in [1, 2] {
        let case = knife_edge(order);
        let g = &case.system.graph;
        let u = case.read("u");
        let on = [
            (case.read("x'"), g.mul(&[u, case.read("cos(phi)")])),
            (case.read("y'"), g.mul(&[u, case.read("sin(phi)")])),
        ];
        let expected = ["-phi' u sin(phi)", "phi' u cos(phi)", "0"];
        for (a, text) in case
            .equations("routh")
            .accelerations
            .into_iter()
            .zip(expected)
        {
            let difference = g.sub(g.substitute(a, &on), case.read(text));
            assert!(is_zero(&case, difference), "order {order}: {text}");
        }
    }
    for (order, expected) in [(2, (6, 0)), (3, (7, 1))] {
        let case = knife_edge(order);
        let cx = case.context();
        let equations = derive(&cx, "routh").unwrap();
        assert_eq!(dimension(&cx, &equations), expected);
    }
}

/// E8: a metric that depends on coordinates and time.
fn with_formulas(constraint: &str, formulas: [(&str, &str); 2]) -> Case {
    let [(one, first), (two, second)] = formulas;
    Case::new(&format!(
        r#"
coordinates = ["q1", "q2"]
parameters = {{ mu = {{}} }}
assumptions = ["mu > 0"]
lagrangian = {{ T = "1/2 mu (q1'^2 + (q1^2 + t) q2'^2 + q2 q1' q2')" }}
[constraints]
c = "{constraint}"
[characteristics]
parameters = ["P"]
"{one}" = "{first}"
"{two}" = "{second}"
"#
    ))
}

#[test]
fn e8_formulas_of_order_one_two_and_three_in_a_curved_chart() {
    for case in [
        with_formulas(
            "(q2' - q1) q2^2 = (q1' - t)^2",
            [("q1'", "P q2 + t"), ("q2'", "P^2 + q1")],
        ),
        with_formulas(
            "(q1'' - q1' q2) q2'^2 = q2''^2",
            [("q1''", "P^2 + q1' q2"), ("q2''", "P q2'")],
        ),
        with_formulas(
            "(q1''' - q2'' q1) q2'^2 = q2'''^2",
            [("q1'''", "P^2 + q2'' q1"), ("q2'''", "P q2'")],
        ),
    ] {
        expect(&case, "order.characteristics", "proved");
        all_forms_are_proved(&case);
    }
}

#[test]
fn by_characteristics_that_leave_the_constraint_nothing_is_derived() {
    let case = with_formulas(
        "(q1'' - q1' q2) q2'^2 = q2''^2",
        [("q1''", "P^2 + q1' q2"), ("q2''", "2 P q2'")],
    );
    expect(&case, "order.characteristics", "refuted");
    for name in ["maggi", "volterra-first", "volterra-second"] {
        let claim = format!("formulation.equivalent#{name}");
        expect(&case, &claim, "not-applicable");
    }
}

#[test]
fn what_is_made_for_the_first_order_says_nothing_of_higher_ones() {
    let case = Case::new(CURVATURE);
    expect(&case, "model.constraints-first-order", "refuted");
    for name in ["nielsen", "gauss", "canonical", "lagrange-vector-field"] {
        let claim = format!("formulation.equivalent#{name}");
        expect(&case, &claim, "not-applicable");
    }
}

#[test]
fn a_homogeneous_constraint_of_third_order_in_space_determines_no_motion() {
    // Third derivatives and their multiples satisfy it, and the equations of motion give a direction only.
    let case = Case::new(
        r#"
coordinates = ["x", "y", "z"]
lagrangian = { T = "1/2 (x'^2 + y'^2 + z'^2)" }
constraints = { cone = "x''' y''' = z'''^2" }
"#,
    );
    expect(&case, "order.determined", "refuted");
    expect(&case, "formulation.equivalent#maggi", "not-applicable");
}

#[test]
fn constraints_of_different_orders_are_brought_to_one() {
    // A knife edge beside an acceleration along a fixed law: orders one and two.
    let case = Case::new(
        r#"
coordinates = ["x", "y", "phi"]
lagrangian = { T = "1/2 (x'^2 + y'^2 + phi'^2)" }
[constraints]
blade = "x' sin(phi) = y' cos(phi)"
turn = "phi'' = x' phi'"
"#,
    );
    let cx = case.context();
    let equations = derive(&cx, "routh").unwrap();
    // Six variables and the blade as a condition on them.
    assert_eq!(dimension(&cx, &equations), (5, 0));
    let names: Vec<&str> = equations
        .conditions
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    assert_eq!(names, ["blade"]);
    expect(&case, "order.determined", "proved");
    for name in NAMES {
        expect(&case, &format!("formulation.equivalent#{name}"), "proved");
    }
}
