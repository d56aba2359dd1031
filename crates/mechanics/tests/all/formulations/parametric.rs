//! Extended configuration space (T1 §6.3).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{
    assert_state_follows_motion, changed, compared, vanishes, DRIVEN, QUARTIC, RELATIVISTIC,
};
use chetaev_symbolic::Expr;

#[test]
fn parametric_is_equivalent_to_routh() {
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
        expect(&case, "formulation.equivalent#parametric", "proved");
        assert_state_follows_motion(&case, "parametric");
    }
}

/// One identity among the n + 1 equations, for arbitrary curves and μ.
#[test]
fn identity_among_the_equations() {
    for text in [SKATE, APPELL_HAMEL, PARTICLE, POLAR, DRIVEN, RELATIVISTIC] {
        expect(
            &Case::new(text),
            "formulation.identity#parametric",
            "proved",
        );
    }
}

/// S4: Λ, F, and the momentum of t is minus the energy.
#[test]
fn particle_in_closed_form() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("parametric");
    let lambda = case.object(&equations, "Lambda");
    assert!(case.equal(lambda, case.read("(w_x^2 + w_y^2 + w_z^2)/(2 w_t)")));
    let f = case.object(&equations, "F_c");
    assert!(case.equal(f, case.read("(w_z - y w_x)/w_t")));
    assert_eq!(equations.groups[0].equations.len(), 4);
    // At τ = t the first three equations are Routh's.
    let g = &case.system.graph;
    let at_time: Vec<(Expr, Expr)> = ["x", "y", "z"]
        .iter()
        .flat_map(|c| {
            [
                (case.read(&format!("w_{c}")), case.read(&format!("{c}'"))),
                (case.read(&format!("w_{c}'")), case.read(&format!("{c}''"))),
            ]
        })
        .chain([
            (case.read("w_t"), g.one()),
            (case.read("w_t'"), g.zero()),
            (case.read("mu_c"), case.read("lambda_c")),
        ])
        .collect();
    let routh = case.equations("routh");
    for (own, other) in equations.groups[0]
        .equations
        .iter()
        .zip(&routh.groups[0].equations)
    {
        assert!(case.equal(g.substitute(own.left, &at_time), other.left));
        assert!(case.equal(g.substitute(own.right, &at_time), other.right));
    }
}

/// μ = t'² λ with λ at the velocity q'/t', for any speed of the parameter; μ = λ is refuted.
#[test]
fn multipliers_scale_with_the_square_of_the_parameter() {
    let case = Case::new(PARTICLE);
    let g = &case.system.graph;
    let equations = case.equations("parametric");
    let mu = case.object(&equations, "mu_c");
    let on_set = |e: Expr| g.substitute(e, &[(case.read("w_z"), case.read("y w_x"))]);
    // λ = x' y'/(1 + y²) of Routh's equations.
    let lambda = case.read("(w_x/w_t) (w_y/w_t)/(1 + y^2)");
    let scaled = g.mul(&[case.read("w_t^2"), lambda]);
    assert!(vanishes(&case, on_set(g.sub(mu, scaled))));
    assert!(!vanishes(&case, on_set(g.sub(mu, lambda))));
    assert!(vanishes(
        &case,
        on_set(g.sub(equations.multipliers[0].1, lambda))
    ));
}

/// The mutant that takes μ = λ where the parameter runs at half the speed of time.
#[test]
fn multipliers_without_the_square_are_refuted() {
    let case = Case::new(PARTICLE);
    let mut equations = case.equations("parametric");
    for variable in &mut equations.variables {
        // τ = 2 t: q'(τ) = v/2, t' = 1/2.
        let half = case.read("1/2");
        variable.definition = variable
            .definition
            .map(|e| case.system.graph.mul(&[half, e]));
    }
    assert_eq!(compared(&case, &equations), "proved");
    // λ in place of μ = t'² λ: the reaction in x is −y μ/t'.
    let mutant = changed(&case, &equations, |_, rates| {
        rates[0] = case.read("-y (w_x/w_t) (w_y/w_t)/(1 + y^2)/w_t");
    });
    assert_eq!(compared(&case, &mutant), "refuted");
}
