//! Zhu's closed equations in (q, p) (T1 §7.3).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{
    assert_state_follows_motion, changed, compared, DRIVEN, QUARTIC, RELATIVISTIC,
};

const COUPLED: &str = r#"
coordinates = ["x", "y"]
lagrangian = { L = "1/2 (2 x'^2 + 2 x' y' + y'^2)" }
constraints = { c = "y' = x x'" }
"#;

#[test]
fn state_space_canonical_is_equivalent_to_routh() {
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
            "formulation.equivalent#state-space-canonical",
            "proved",
        );
        assert_state_follows_motion(&case, "state-space-canonical");
    }
}

/// H, u and the product ∂u/∂p H_pp⁻¹ = (−x, 1) of the example with a coupled mass matrix.
#[test]
fn coupled_mass_matrix() {
    let case = Case::new(COUPLED);
    let equations = case.equations("state-space-canonical");
    let h = case.object(&equations, "H");
    assert!(case.equal(h, case.read("(p_x^2 - 2 p_x p_y + 2 p_y^2)/2")));
    let last = equations.groups.last().unwrap();
    let u = case.read("2 p_y - p_x - x (p_x - p_y)");
    assert!(case.equal(last.equations[0].left, u));
    let motion = &equations.groups[0].equations;
    let right = |label: &str| motion.iter().find(|e| e.label == label).unwrap().right;
    assert!(case.equal(right("p_x"), case.read("-x lambda_c")));
    assert!(case.equal(right("p_y"), case.read("lambda_c")));
    expect(
        &case,
        "formulation.equivalent#state-space-canonical",
        "proved",
    );
}

/// The mistake of leaving out H_pp⁻¹: λ still keeps u = 0, but the motion is another one.
#[test]
fn gradients_by_momenta_alone_are_refuted() {
    let case = Case::new(COUPLED);
    let equations = case.equations("state-space-canonical");
    let lambda = "(p_x - p_y)^2/((1 + x)^2 + (2 + x)^2)";
    let mutant = changed(&case, &equations, |_, rates| {
        rates[0] = case.read(&format!("-(1 + x) {lambda}"));
        rates[1] = case.read(&format!("(2 + x) {lambda}"));
    });
    assert_eq!(compared(&case, &mutant), "refuted");
}
