//! Extended phase space (T1 §6.4).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{
    assert_state_follows_motion, vanishes, DRIVEN, QUARTIC, RELATIVISTIC,
};

#[test]
fn parametric_canonical_is_equivalent_to_routh() {
    for text in [
        SKATE,
        DISC,
        APPELL_HAMEL,
        PARTICLE,
        POLAR,
        DRIVEN,
        QUARTIC,
        RELATIVISTIC,
    ] {
        let case = Case::new(text);
        expect(
            &case,
            "formulation.equivalent#parametric-canonical",
            "proved",
        );
        // Among the variables is p_t, which has to change as −H does along the motion.
        assert_state_follows_motion(&case, "parametric-canonical");
    }
}

/// DK = 0 for arbitrary μ, also for constraints that are not homogeneous in the velocities, and with forces.
#[test]
fn relation_of_the_momenta_is_kept() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, DRIVEN, RELATIVISTIC] {
        expect(
            &Case::new(text),
            "formulation.identity#parametric-canonical",
            "proved",
        );
    }
}

#[test]
fn particle_in_closed_form() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("parametric-canonical");
    let k = case.object(&equations, "K");
    assert!(case.equal(k, case.read("p_t + (p_x^2 + p_y^2 + p_z^2)/2")));
    let names: Vec<&str> = equations
        .variables
        .iter()
        .map(|x| x.name.as_str())
        .collect();
    assert_eq!(names, ["p_x", "p_y", "p_z", "p_t"]);
    // p_t' = −μ Σ v ∂f/∂v = −μ (p_z − y p_x): zero on the constraint only.
    let right = equations.groups[0].equations.last().unwrap().right;
    assert!(case.equal(right, case.read("-mu_c (p_z - y p_x)")));
}

/// A mutant: without its reaction p_t would keep its value, but K would not on an affine constraint.
#[test]
fn the_reaction_of_time_is_needed() {
    let case = Case::new(DRIVEN);
    let g = &case.system.graph;
    let equations = case.equations("parametric-canonical");
    let right = equations.groups[0].equations.last().unwrap().right;
    let without = g.substitute(right, &[(case.read("mu_moving"), g.zero())]);
    assert!(!vanishes(&case, g.sub(right, without)));
}
