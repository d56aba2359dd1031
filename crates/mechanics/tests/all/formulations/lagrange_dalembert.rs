//! The principle of d'Alembert and Lagrange (T1 §§0–1).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};

const CLAIM: &str = "formulation.equivalent#lagrange-dalembert";

#[test]
fn it_is_equivalent_to_routh() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR] {
        expect(&Case::new(text), CLAIM, "proved");
    }
}

/// S4: the displacement with δx = 1 has δz = y, and the accelerations are x'' = -y x'y'/(1 + y²), y'' = 0.
#[test]
fn the_particle_of_the_notes() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("lagrange-dalembert");
    let delta = case.object(&equations, "delta_z_x");
    assert!(case.equal(delta, case.read("y")));
    let expected = ["-y x' y'/(1 + y^2)", "0"];
    for (&a, text) in equations.accelerations.iter().zip(expected) {
        assert!(case.equal_on_constraints(a, case.read(text)), "{text}");
    }
}

/// f_v times every displacement is zero, whatever the state: also for a constraint nonlinear in the velocities, where the
/// displacements depend on them.
#[test]
fn displacements_are_annihilated_by_the_constraint_gradients() {
    let case = Case::new(APPELL_HAMEL);
    let equations = case.equations("lagrange-dalembert");
    let (x, y) = (
        case.object(&equations, "delta_z_x"),
        case.object(&equations, "delta_z_y"),
    );
    assert!(case.equal(x, case.read("a x'/sqrt(x'^2 + y'^2)")));
    assert!(case.equal(y, case.read("a y'/sqrt(x'^2 + y'^2)")));
    assert!(!case.equal(x, case.read("-a x'/sqrt(x'^2 + y'^2)")));
}
