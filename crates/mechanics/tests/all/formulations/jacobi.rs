//! Jacobi's principle (T1 §5.4).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{assert_state_follows_motion, changed, compared};
use chetaev_symbolic::Expr;

const FIELD: &str = r#"
coordinates = ["x", "y"]
parameters = { B = {} }
assumptions = ["B > 0"]
lagrangian = { L = "1/2 (x'^2 + y'^2) + B/2 (x y' - y x')" }
"#;

const FALL: &str = r#"
coordinates = ["x", "y"]
parameters = { g = {} }
lagrangian = { L = "1/2 (x'^2 + y'^2) - g y" }
"#;

#[test]
fn jacobi_is_equivalent_to_routh() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR, FIELD, FALL] {
        let case = Case::new(text);
        expect(&case, "formulation.equivalent#jacobi", "proved");
        assert_state_follows_motion(&case, "jacobi");
    }
}

/// Left sides minus right sides of the equations of motion at a path given by its coordinates and their derivatives by τ.
fn residuals(case: &Case, at: &[(&str, &str)]) -> Vec<Expr> {
    let g = &case.system.graph;
    let pairs: Vec<(Expr, Expr)> = at
        .iter()
        .map(|(s, e)| (case.read(s), case.read(e)))
        .collect();
    let equations = case.equations("jacobi");
    equations.groups[0]
        .equations
        .iter()
        .map(|e| g.substitute(g.sub(e.left, e.right), &pairs))
        .collect()
}

fn satisfied(case: &Case, at: &[(&str, &str)]) -> bool {
    let zero = case.system.graph.zero();
    residuals(case, at).into_iter().all(|e| case.equal(e, zero))
}

/// S4 with h = 1, τ = y, x = asinh τ, z = √(1 + τ²) − 1: μ = (1 + τ²)^(−3/2).
#[test]
fn particle_along_its_path() {
    let case = Case::new(PARTICLE);
    let path = [
        ("h", "1"),
        ("y", "s"),
        ("w_x", "1/sqrt(1 + s^2)"),
        ("w_y", "1"),
        ("w_z", "s/sqrt(1 + s^2)"),
        ("w_x'", "-s/sqrt(1 + s^2)^3"),
        ("w_y'", "0"),
        ("w_z'", "1/sqrt(1 + s^2)^3"),
    ];
    let with = |mu: &'static str| -> Vec<(&str, &str)> {
        path.iter().copied().chain([("mu_c", mu)]).collect()
    };
    assert!(satisfied(&case, &with("1/sqrt(1 + s^2)^3")));
    assert!(!satisfied(&case, &with("1/sqrt(1 + s^2)")));
}

/// A charge in a field B > 0 turns clockwise on circles of radius √(2h)/B; the other sense and another radius fail.
#[test]
fn circles_in_a_field() {
    let case = Case::new(FIELD);
    let circle = |field: &str, energy: &str, r: &str, sense: &str| -> bool {
        let path = [
            ("B", field.to_string()),
            ("h", energy.to_string()),
            ("x", format!("({r}) cos(s)")),
            ("y", format!("-({sense}) ({r}) sin(s)")),
            ("w_x", format!("-({r}) sin(s)")),
            ("w_y", format!("-({sense}) ({r}) cos(s)")),
            ("w_x'", format!("-({r}) cos(s)")),
            ("w_y'", format!("({sense}) ({r}) sin(s)")),
        ];
        let path: Vec<(&str, &str)> = path.iter().map(|(s, e)| (*s, e.as_str())).collect();
        satisfied(&case, &path)
    };
    for (field, energy, radius) in [("1", "1/2", "1"), ("3", "2", "2/3"), ("2", "8", "2")] {
        assert!(circle(field, energy, radius, "1"), "{radius}");
        assert!(!circle(field, energy, radius, "-1"), "{radius}");
        assert!(!circle(field, energy, "1/2", "1"), "{radius}");
    }
}

/// The parabola x = u s, y = −g s²/2 of a fall with h = u²/2.
#[test]
fn parabola_of_a_fall() {
    let case = Case::new(FALL);
    let parabola = |y: &str, w_y: &str, a_y: &str| {
        satisfied(
            &case,
            &[
                ("h", "u^2/2"),
                ("y", y),
                ("w_x", "u"),
                ("w_y", w_y),
                ("w_x'", "0"),
                ("w_y'", a_y),
            ],
        )
    };
    assert!(parabola("-g s^2/2", "-g s", "-g"));
    assert!(!parabola("-g s^2", "-2 g s", "-2 g"));
}

/// Each hypothesis that fails is named.
#[test]
fn hypotheses_by_name() {
    let particle = |addition: &str, from: &str, to: &str| {
        Case::new(&format!("{}{addition}", PARTICLE.replace(from, to)))
    };
    let cases = [
        (
            particle("forces = { x = \"-x'\" }\n", "", ""),
            "model.forces-absent",
        ),
        (
            particle("", "z'^2)\"", "z'^2) - t x\""),
            "model.lagrangian-autonomous",
        ),
        (
            particle("", "z'^2)\"", "z'^2) + x'^4\""),
            "model.lagrangian-quadratic",
        ),
        (
            particle("", "= y x'", "= y x' + 1"),
            "model.constraints-homogeneous",
        ),
        (
            particle("", "= y x'", "= t x'"),
            "model.constraints-scleronomic",
        ),
    ];
    for (case, hypothesis) in &cases {
        expect(case, hypothesis, "refuted");
        expect(case, "formulation.equivalent#jacobi", "not-applicable");
    }
}

/// A mutant: time along the path by dτ/dt = √(h + L₀), without the factor of the arc length.
#[test]
fn a_wrong_speed_is_refuted() {
    let case = Case::new(FALL);
    let equations = case.equations("jacobi");
    let g = &case.system.graph;
    let root = g.sqrt(case.read("1/2"));
    let mutant = changed(&case, &equations, |velocities, rates| {
        for e in velocities.iter_mut().chain(rates) {
            *e = g.mul(&[root, *e]);
        }
    });
    assert_eq!(compared(&case, &mutant), "refuted");
}

/// The radicand of a homogeneous constraint in arc-length rates is that of the model over 2F: a quotient of radicands.
#[test]
fn roots_of_quotients_are_quotients_of_roots() {
    for constraints in [
        "c = \"5 sqrt(y'^2 + z'^2) + x' = 0\"",
        "c = \"5 sqrt(y'^2 + z'^2) + x' = 0\", d = \"w' = z z'\"",
    ] {
        let text = format!(
            r#"
coordinates = ["x", "y", "z", "w"]
lagrangian = {{ L = "1/2 (x'^2 + (3 + x^2) y'^2 + 2 z'^2 + w'^2 + x' y') + x" }}
constraints = {{ {constraints} }}
"#
        );
        expect(&Case::new(&text), "formulation.equivalent#jacobi", "proved");
    }
}
