//! Moving frames, and the formulations in them (T3 §1–5).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use chetaev_mechanics::formulations::boltzmann_hamel::Embedding;
use chetaev_mechanics::{Basis, Frame};

const IN_FRAMES: [&str; 3] = [
    "poincare-chetaev",
    "boltzmann-hamel",
    "lagrange-vector-field",
];

/// The frame of the sled: u along the blade, w turning, s across.
const SLED: &str = r#"
[moving_frame.fields]
u = { x = "cos(phi)", y = "sin(phi)" }
w = { phi = 1 }
s = { x = "-sin(phi)", y = "cos(phi)" }
"#;

/// A rigid body by Euler's angles z, x, z, with the components of the angular velocity along the axes of the body.
const BODY: &str = r#"
coordinates = ["psi", "theta", "phi"]
parameters = { I_1 = {}, I_2 = {}, I_3 = {} }
assumptions = ["I_1 > 0", "I_2 > 0", "I_3 > 0", "sin(theta) > 0"]
lagrangian = { L = "1/2 (I_1 p^2 + I_2 q^2 + I_3 r^2)" }
[quasi_velocities]
p = "psi' sin(theta) sin(phi) + theta' cos(phi)"
q = "psi' sin(theta) cos(phi) - theta' sin(phi)"
r = "psi' cos(theta) + phi'"
"#;

fn with_basis(case: &Case, look: impl Fn(&Basis<'_>)) {
    let cx = case.context();
    look(&chetaev_mechanics::claims::formulation::basis(&cx));
}

fn coefficients(case: &Case) -> Vec<(usize, usize, usize, String)> {
    let mut found = Vec::new();
    let cx = case.context();
    let basis = chetaev_mechanics::claims::formulation::basis(&cx);
    let (frame, _) = Frame::adapted(basis.system, basis.terms, basis.selection).unwrap();
    let zero = case.system.graph.zero();
    for (w, s, u, c) in frame.structure_coefficients(basis.system) {
        if case.equal(c, zero) {
            continue;
        }
        let value = ["1", "-1"]
            .into_iter()
            .find(|v| case.equal(c, case.read(v)));
        found.push((w, s, u, value.unwrap_or("other").to_string()));
    }
    found
}

#[test]
fn forms_without_constraints_are_equivalent() {
    for text in [POLAR, BODY] {
        for name in IN_FRAMES {
            expect(
                &Case::new(text),
                &format!("formulation.equivalent#{name}"),
                "proved",
            );
        }
    }
}

#[test]
fn the_worked_systems_in_the_frames_that_are_chosen_for_them() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE] {
        let case = Case::new(text);
        for name in IN_FRAMES {
            expect(&case, &format!("formulation.equivalent#{name}"), "proved");
        }
        expect(&case, "formulation.identity#boltzmann-hamel", "proved");
        expect(
            &case,
            "formulation.identity#lagrange-vector-field",
            "proved",
        );
    }
}

/// `C^3_12 = C^1_23 = C^2_31 = 1` for the rotation group in body axes, up to the sign of the orientation (T3 §1).
#[test]
fn structure_coefficients_of_rotations() {
    let mut found = coefficients(&Case::new(BODY));
    found.sort();
    let signs: Vec<&str> = found.iter().map(|(.., c)| c.as_str()).collect();
    let places: Vec<_> = found.iter().map(|&(w, s, u, _)| (w, s, u)).collect();
    assert_eq!(places, [(1, 2, 3), (2, 1, 3), (3, 1, 2)]);
    assert_eq!(signs, ["1", "-1", "1"]);
}

/// `[X2,X1] = X3, [X2,X3] = -X1, [X1,X3] = 0` for the sled (T3 §1).
#[test]
fn structure_coefficients_of_the_sled() {
    let found = coefficients(&Case::new(&format!("{SKATE}{SLED}")));
    let expected = [(3, 1, 2, "-1".to_string()), (1, 2, 3, "-1".to_string())];
    assert_eq!(found, expected);
}

/// `I1 η1' = (I2 - I3) η2 η3` and cyclic (T3 §4, §8.6).
#[test]
fn euler_equations_of_a_free_body() {
    let case = Case::new(BODY);
    for name in IN_FRAMES {
        let equations = case.equations(name);
        let expected = [
            "(I_2 - I_3) q r/I_1",
            "(I_3 - I_1) r p/I_2",
            "(I_1 - I_2) p q/I_3",
        ];
        for (variable, text) in equations.variables.iter().zip(expected) {
            assert!(
                case.equal(variable.rate, case.read(text)),
                "{name} {}",
                variable.name
            );
        }
    }
}

/// `u' = G cos φ`, `w' = 0`, and nothing else remains in the adapted frame (T1 §1, T3 §8.4).
#[test]
fn the_skate_in_blade_speeds() {
    let case = Case::new(&format!("{SKATE}{SLED}"));
    let equations = case.equations("boltzmann-hamel");
    let names: Vec<&str> = equations
        .variables
        .iter()
        .map(|v| v.name.as_str())
        .collect();
    assert_eq!(names, ["u", "w"]);
    assert!(case.equal(equations.variables[0].rate, case.read("G cos(phi)")));
    assert!(case.equal(equations.variables[1].rate, case.read("0")));
    let full = case.equations("poincare-chetaev");
    let lambda = case.object(&full, "lambda_blade");
    let lambda = full.in_natural_state(&case.system, &[lambda])[0];
    let expected = case.read("-m (x' cos(phi) + y' sin(phi)) phi' - m G sin(phi)");
    assert!(case.equal_on_constraints(lambda, expected));
    for name in IN_FRAMES {
        expect(&case, &format!("formulation.equivalent#{name}"), "proved");
    }
}

/// Appell's example in the natural frame: C_1 = a η1/ρ, L_3 = m a ρ, K = G = 0 (T3 §8.5).
#[test]
fn embedding_of_the_machine_of_appell() {
    let case = Case::new(APPELL_HAMEL);
    with_basis(&case, |basis| {
        let embedding = Embedding::of(basis).unwrap();
        let terms = embedding.terms();
        let zero = case.system.graph.zero();
        let check = |value, text: &str| {
            assert!(case.equal_on_constraints(value, case.read(text)), "{text}");
        };
        check(embedding.slopes[0][0], "a x'/sqrt(x'^2 + y'^2)");
        check(embedding.slopes[0][1], "a y'/sqrt(x'^2 + y'^2)");
        check(terms.dependent_momenta[0], "m a sqrt(x'^2 + y'^2)");
        for e in terms.k.concat().into_iter().chain(terms.g.concat()) {
            assert!(case.equal_on_constraints(e, zero));
        }
    });
}

/// `(1+y²) η1' + y η1 η2 = 0`, `η2' = 0` in the frame X1 = ∂x + y ∂z, X2 = ∂y, X3 = ∂z with `[X1, X2] = -∂z` (T3 §8.2).
#[test]
fn the_particle_in_its_adapted_frame() {
    let frame = r#"
[moving_frame.fields]
h = { x = 1, z = "y" }
k = { y = 1 }
s = { z = 1 }
"#;
    let case = Case::new(&format!("{PARTICLE}{frame}"));
    assert_eq!(coefficients(&case), [(3, 1, 2, "-1".to_string())]);
    let equations = case.equations("boltzmann-hamel");
    assert!(case.equal(equations.variables[0].rate, case.read("-y h k/(1 + y^2)")));
    assert!(case.equal(equations.variables[1].rate, case.read("0")));
    // S4 in multiplier form: λ = x' y'/(1 + y²).
    let full = case.equations("lagrange-vector-field");
    let lambda = full.in_natural_state(&case.system, &[case.object(&full, "lambda_c")])[0];
    assert!(case.equal_on_constraints(lambda, case.read("x' y'/(1 + y^2)")));
}

/// A frame that turns with the time, on a plane that turns: the drift X_0 and the coefficients C_0 count.
#[test]
fn a_frame_that_moves_with_the_time() {
    let text = r#"
coordinates = ["x", "y", "phi"]
parameters = { m = {}, J = {}, Omega = {}, c = {} }
assumptions = ["m > 0", "J > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2", V = "c (x^2 + y^2)" }
forces = { x = "-3 x'", phi = "x y'" }
constraints = { blade = "(x' + Omega y) sin(phi) = (y' - Omega x) cos(phi) + 2 t" }
[moving_frame]
drift = { x = "-Omega y", y = "Omega x" }
[moving_frame.fields]
u = { x = "cos(phi + Omega t)", y = "sin(phi + Omega t)" }
w = { phi = "1 + t^2" }
s = { x = "-sin(phi + Omega t)", y = "cos(phi + Omega t)" }
"#;
    let case = Case::new(text);
    expect(&case, "model.frame-regular", "proved");
    for name in IN_FRAMES {
        expect(&case, &format!("formulation.equivalent#{name}"), "proved");
    }
    expect(&case, "formulation.identity#boltzmann-hamel", "proved");
    expect(
        &case,
        "formulation.identity#lagrange-vector-field",
        "proved",
    );
    assert!(coefficients(&case).iter().any(|&(_, s, ..)| s == 0));
}

/// A nonlinear constraint in a frame that is not natural stays implicit.
#[test]
fn a_nonlinear_constraint_in_a_frame() {
    let text = r#"
coordinates = ["x", "y", "z"]
parameters = { m = {}, g = {} }
assumptions = ["m > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2 + z'^2)", V = "m g z" }
constraints = { c = "z'^3 + z' = x' y'" }
[moving_frame.fields]
u = { x = 1, y = "x" }
w = { y = "1 + z^2" }
s = { z = 1, x = "y" }
"#;
    let case = Case::new(text);
    for name in IN_FRAMES.into_iter().chain(["maggi"]) {
        expect(&case, &format!("formulation.equivalent#{name}"), "proved");
    }
    expect(&case, "formulation.identity#boltzmann-hamel", "proved");
}

#[test]
fn a_singular_frame_is_refused_with_the_reason() {
    let text = format!(
        "{SKATE}[quasi_velocities]\nu = \"x' cos(phi) + y' sin(phi)\"\nw = \"x' + y'\"\ns = \"x' (1 + cos(phi)) + y' (1 + sin(phi))\"\n"
    );
    let case = Case::new(&text);
    expect(&case, "model.frame-regular", "refuted");
    expect(
        &case,
        "formulation.equivalent#poincare-chetaev",
        "not-applicable",
    );
}

/// k quasi-velocities that contain the velocity which the constraints would make dependent are completed by another one.
#[test]
fn stated_quasi_velocities_are_completed_by_what_they_leave_free() {
    let text = r#"
coordinates = ["x", "y"]
lagrangian = { L = "1/2 (x'^2 + 2 y'^2) - x y" }
constraints = { c = "x'^2 + y'^2 = 8 + 2 cos(x)" }
"#;
    for form in ["x' + 2 x", "y' (2 + x^2)", "x' + y'"] {
        let case = Case::new(&format!("{text}[quasi_velocities]\nu = \"{form}\"\n"));
        expect(&case, "model.frame-regular", "proved");
        for name in IN_FRAMES.into_iter().chain(["maggi"]) {
            expect(&case, &format!("formulation.equivalent#{name}"), "proved");
        }
    }
}

/// A name of the model may be that of a quasi-velocity made for a constraint; the equations are those with another name.
#[test]
fn quasi_velocities_of_constraints_are_kept_apart_from_names_of_the_model() {
    let skate = |angle: &str| {
        format!(
            r#"
coordinates = ["x", "y", "{angle}"]
parameters = {{ m = 2, J = 3 }}
lagrangian = {{ T = "1/2 m (x'^2 + y'^2) + 1/2 J {angle}'^2" }}
constraints = {{ b = "y' cos({angle}) = x' sin({angle})" }}
quasi_velocities = {{ u = "x' cos({angle}) + y' sin({angle})", w = "{angle}'" }}
"#
        )
    };
    for angle in ["phi", "eta_b"] {
        let case = Case::new(&skate(angle));
        for form in [
            "poincare-chetaev",
            "lagrange-vector-field",
            "boltzmann-hamel",
        ] {
            expect(&case, &format!("formulation.equivalent#{form}"), "proved");
        }
        expect(
            &case,
            "formulation.identity#lagrange-vector-field",
            "proved",
        );
    }
}
