//! Zhu's closed equations in (q, v) (T1 §7.2).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{
    assert_state_follows_motion, changed, compared, vanishes, DRIVEN, QUARTIC, RELATIVISTIC,
};

#[test]
fn state_space_is_equivalent_to_routh() {
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
        expect(&case, "formulation.equivalent#state-space", "proved");
        assert_state_follows_motion(&case, "state-space");
    }
}

/// (34) is δZ + Σ Q δq − D(Σ p δq) on arbitrary curves, and Dq = v is a result.
#[test]
fn differential_principle_and_kinematic_law() {
    for text in [PARTICLE, DRIVEN, POLAR, RELATIVISTIC] {
        expect(
            &Case::new(text),
            "formulation.identity#state-space",
            "proved",
        );
    }
}

/// S4: Z, and λ = v_x v_y/(1 + y²).
#[test]
fn particle_in_closed_form() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("state-space");
    let z = case.read("(x'^2 + y'^2 + z'^2)/2 + (Dq_x - x') x' + (Dq_y - y') y' + (Dq_z - z') z'");
    assert!(case.equal(case.object(&equations, "Z"), z));
    let lambda = case.object(&equations, "lambda_c");
    assert!(case.equal(lambda, case.read("x' y'/(1 + y^2)")));
}

/// Varying Z by v^j gives Σ_s W_js (Dq^s − v^s), the kinematic group as stated.
#[test]
fn variation_of_z_by_velocities() {
    let case = Case::new(DRIVEN);
    let g = &case.system.graph;
    let equations = case.equations("state-space");
    let z = case.object(&equations, "Z");
    for (j, c) in case.system.coordinates.iter().enumerate() {
        let stated = equations.groups[0].equations[j].left;
        assert!(vanishes(&case, g.sub(g.diff(z, c.v_symbol), stated)));
    }
}

/// A mutant: Dq = v taken with a wrong factor in one equation.
#[test]
fn a_wrong_kinematic_law_is_refuted() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("state-space");
    let mutant = changed(&case, &equations, |velocities, _| {
        velocities[0] = case.read("2 x'");
    });
    assert_eq!(compared(&case, &mutant), "refuted");
}

/// A bead of mass m at the angle a on a ring of radius R whose centre moves as c(t) = t²/2 upwards, under its weight, with a
/// magnetic term beside the particle.
const RHEONOMIC_BEAD: &str = r#"
coordinates = ["a", "b"]
parameters = { m = {}, R = {}, g = {} }
assumptions = ["m > 0", "R > 0"]
lagrangian = { L = "1/2 m ((R a' cos(a))^2 + (R a' sin(a) + t)^2 + b'^2) + a b'" }
[particles.bead]
mass = "m"
position = ["R sin(a)", "t^2/2 - R cos(a)", "b"]
force = ["0", "-m g", "0"]
"#;

/// (32) by hand: r = R (sin a, −cos a) + …, e = ∂r/∂a = R (cos a, sin a), u = e a' + t ŷ, Dr − u = e (Da − a'). The
/// coefficient of δa' is m R² (Da − a'); that of −δa is (m Du − F)·e − m (Dr − u)·∂u/∂a with ∂u/∂a ⟂ e.
#[test]
fn particles_are_stated_by_newton() {
    let case = Case::new(RHEONOMIC_BEAD);
    expect(&case, "formulation.equivalent#state-space", "proved");
    expect(&case, "formulation.identity#state-space", "proved");
    assert_state_follows_motion(&case, "state-space");
    let equations = case.equations("state-space");
    let stated = |group: usize| equations.groups[group].equations[0].left;
    assert!(case.equal(stated(0), case.read("m R^2 (Dq_a - a')")));
    // a b' beside the particle: −D(0) + b' = b', so that −δa has −b' − (Db − b'), which is −Db.
    let motion = "m R (R Dv_a + (1 + g) sin(a)) - Dq_b";
    assert!(case.equal(stated(1), case.read(motion)));
    let text = equations.groups[1].schema.unwrap().text;
    assert!(text.contains("m_a Du_a − F_a"), "{text}");
    // Without particles the statement is Lagrange's.
    let lagrange = Case::new(POLAR).equations("state-space");
    assert!(!lagrange.groups[1].schema.unwrap().text.contains("F_a"));
}
