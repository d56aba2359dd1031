//! Canonical equations with multipliers (T1 §3 (10)).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{
    assert_state_follows_motion, changed, compared, DRIVEN, QUARTIC, RELATIVISTIC,
};

#[test]
fn canonical_is_equivalent_to_routh() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR, DRIVEN, QUARTIC] {
        let case = Case::new(text);
        expect(&case, "formulation.equivalent#canonical", "proved");
        assert_state_follows_motion(&case, "canonical");
    }
}

/// S4: H = p·p/2 and λ = p_x p_y/(1 + y²).
#[test]
fn particle_in_closed_form() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("canonical");
    let hamiltonian = case.object(&equations, "H");
    assert!(case.equal(hamiltonian, case.read("(p_x^2 + p_y^2 + p_z^2)/2")));
    let lambda = case.object(&equations, "lambda_c");
    assert!(case.equal(lambda, case.read("p_x p_y/(1 + y^2)")));
    let names: Vec<&str> = equations
        .variables
        .iter()
        .map(|x| x.name.as_str())
        .collect();
    assert_eq!(names, ["p_x", "p_y", "p_z"]);
}

/// Two coupled velocities, and terms linear in them: H = ½ (p − a) W⁻¹ (p − a) − L₀.
#[test]
fn hamiltonian_with_linear_terms() {
    let case = Case::new(
        "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"x'^2 + x' y' + 1/2 y'^2 + y x' - x^2\" }",
    );
    let equations = case.equations("canonical");
    let expected = case.read("((p_x - y)^2 - 2 (p_x - y) p_y + 2 p_y^2)/2 + x^2");
    assert!(case.equal(case.object(&equations, "H"), expected));
    expect(&case, "formulation.equivalent#canonical", "proved");
}

/// L is a function of v·v: the scalar equation for it is solved, and H is closed.
#[test]
fn relativistic_particle() {
    let case = Case::new(RELATIVISTIC);
    for name in ["canonical", "parametric-canonical", "state-space-canonical"] {
        let equations = case.equations(name);
        assert!(equations.relations.is_empty(), "{name}");
        expect(&case, &format!("formulation.equivalent#{name}"), "proved");
        assert_state_follows_motion(&case, name);
    }
}

/// No closed inverse: the velocities stay tied to the momenta by p = ∂L/∂v.
#[test]
fn an_implicit_transform() {
    let case = Case::new(
        "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"1/2 x'^2 + 1/4 x'^4 + x' y' + y'^2 - x^2\" }",
    );
    let equations = case.equations("canonical");
    assert_eq!(equations.relations.len(), 2);
    expect(&case, "formulation.equivalent#canonical", "proved");
    assert_state_follows_motion(&case, "canonical");
}

/// A mutant: the sign of the reaction in one equation.
#[test]
fn a_reaction_of_the_wrong_sign_is_refuted() {
    for text in [SKATE, PARTICLE] {
        let case = Case::new(text);
        let equations = case.equations("canonical");
        let mutant = changed(&case, &equations, |_, rates| {
            rates[0] = case.system.graph.neg(rates[0]);
        });
        assert_eq!(compared(&case, &mutant), "refuted");
    }
}

/// A momentum takes another name where the model has one called like it.
#[test]
fn names_of_momenta_do_not_collide() {
    let case = Case::new(
        "coordinates = [\"x\"]\nparameters = { p_x = {} }\nlagrangian = { L = \"1/2 x'^2 - p_x x\" }",
    );
    assert_eq!(case.equations("canonical").variables[0].name, "p_x_");
    expect(&case, "formulation.equivalent#canonical", "proved");
}

/// Singular Lagrangians (T1 §7.2): the form does not apply, and says why.
#[test]
fn singular_lagrangians() {
    for lagrangian in ["x y' - x^2 y", "1/2 (x' + y')^2"] {
        let case = Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = {{ L = \"{lagrangian}\" }}"
        ));
        expect(&case, "model.hessian-regular", "refuted");
        for name in ["canonical", "state-space", "state-space-canonical"] {
            expect(
                &case,
                &format!("formulation.equivalent#{name}"),
                "not-applicable",
            );
        }
    }
}
