//! Volterra's equations in Cartesian coordinates (T2 §§2–4 with m = 1).

use crate::formulations::common::{expect, Case, PARTICLE};

/// The pendulum of T2 §2: Cartesian coordinates, the thread as a constraint, a frame with ξ' = -P η, η' = P ξ.
const PENDULUM: &str = r#"
coordinates = ["xi", "eta"]
parameters = { mu = {}, g = {}, l = {} }
assumptions = ["mu > 0", "l > 0"]
constraints = { thread = "1/2 (xi^2 + eta^2 - l^2) = 0" }
[quasi_velocities]
P = "(xi eta' - eta xi')/(xi^2 + eta^2)"
[particles.bob]
mass = "mu"
position = ["xi", "eta"]
force = ["0", "-mu g"]
"#;

/// Two particles with different masses and a constraint between them.
const PAIR: &str = r#"
coordinates = ["x", "y", "z", "w"]
parameters = { m = {}, M = {}, c = {} }
assumptions = ["m > 0", "M > 0"]
lagrangian = { V = "c x z^2" }
forces = { w = "-w'" }
constraints = { link = "z' = y x' + t w'" }
[particles.first]
mass = "m"
position = ["x", "y"]
force = ["-y'", "x'"]
[particles.second]
mass = "M"
position = ["z", "w"]
"#;

const FORMS: [&str; 2] = ["volterra-first-cartesian", "volterra-second-cartesian"];

#[test]
fn they_are_equivalent_to_routh_and_maggi_identically() {
    for text in [PENDULUM, PAIR] {
        let case = Case::new(text);
        expect(&case, "model.particles", "proved");
        expect(&case, "model.cartesian-coordinates", "proved");
        for form in FORMS {
            expect(&case, &format!("formulation.equivalent#{form}"), "proved");
            expect(&case, &format!("formulation.identity#{form}"), "proved");
        }
    }
}

/// μ [ (ξ² + η²) P' + g ξ ] = 0 in both forms, before ξ² + η² = l² is used.
#[test]
fn the_pendulum_of_the_notes() {
    let case = Case::new(PENDULUM);
    for form in FORMS {
        let equations = case.equations(form);
        let equation = &equations.groups[0].equations[0];
        let difference = case.system.graph.sub(equation.left, equation.right);
        let expected = case.read("mu ((xi^2 + eta^2) P' + g xi)");
        assert!(case.equal(difference, expected), "{form}");
    }
}

/// Positions given by other coordinates: not applicable, and the reason names the component.
#[test]
fn curved_coordinates_are_refused() {
    let polar = r#"
coordinates = ["r", "theta"]
parameters = { m = {} }
[particles.p]
mass = "m"
position = ["r cos(theta)", "r sin(theta)"]
"#;
    let case = Case::new(polar);
    expect(&case, "model.particles", "proved");
    let (word, detail) = case.verdict("model.cartesian-coordinates");
    assert_eq!(word, "refuted");
    assert!(detail.contains("is no coordinate"), "{detail}");
    for form in FORMS {
        expect(
            &case,
            &format!("formulation.equivalent#{form}"),
            "not-applicable",
        );
    }
}

#[test]
fn a_model_without_particles_says_so() {
    let case = Case::new(PARTICLE);
    for form in FORMS {
        let (word, detail) = case.verdict(&format!("formulation.equivalent#{form}"));
        assert_eq!(word, "not-applicable");
        assert!(detail.contains("the model states no particles"), "{detail}");
    }
}

/// Inertia beside the particles, or a coordinate twice: refuted.
#[test]
fn the_particles_must_carry_the_whole_inertia_once() {
    let with_rotor = PENDULUM.replace(
        "constraints =",
        "lagrangian = { T = \"1/2 mu (xi'^2 + eta'^2) + xi'^2\" }\nconstraints =",
    );
    expect(&Case::new(&with_rotor), "model.particles", "refuted");
    let twice = PAIR.replace("position = [\"z\", \"w\"]", "position = [\"z\", \"x\"]");
    let case = Case::new(&twice);
    let (word, detail) = case.verdict("model.cartesian-coordinates");
    assert_eq!(word, "refuted");
    assert!(detail.contains("`x` occurs"), "{detail}");
}
