//! Canonical equations on the constraint manifold (T1 §9.1).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::states::{
    assert_state_follows_motion, changed, compared, vanishes, DRIVEN, QUARTIC, RELATIVISTIC,
};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::formulations::ReducedBracket;
use chetaev_symbolic::Expr;

const NAME: &str = "canonical-reduced";

#[test]
fn canonical_reduced_is_equivalent_to_routh() {
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
        expect(&case, "formulation.equivalent#canonical-reduced", "proved");
        assert_state_follows_motion(&case, NAME);
    }
}

/// S4 in closed form: H̃, θ, R and the rates of p̃.
#[test]
fn particle_in_closed_form() {
    let case = Case::new(PARTICLE);
    let equations = case.equations(NAME);
    let expected = [
        ("Htilde", "(ptilde_x^2/(1 + y^2) + ptilde_y^2)/2"),
        ("ptilde_x", "(1 + y^2) x'"),
        ("ptilde_y", "y'"),
        ("theta_z", "y ptilde_x/(1 + y^2)"),
        ("R_z_x_y", "1"),
        ("A_z_x", "ptilde_y"),
        ("A_z_y", "-ptilde_x/(1 + y^2)"),
    ];
    for (name, value) in expected {
        let found = case.object(&equations, name);
        assert!(case.equal(found, case.read(value)), "{name}");
    }
    let rates = equations.rates();
    assert!(case.equal(rates[0], case.read("y ptilde_x ptilde_y/(1 + y^2)")));
    assert!(case.equal(rates[1], case.read("0")));
    let z = case.read("y ptilde_x/(1 + y^2)");
    assert!(case.equal(equations.velocities[2], z));
}

/// The bracket of S4 is antisymmetric, gives the equations, and Jacobi's sum of (z, p̃_x, p̃_y) is −1/(1 + y²).
#[test]
fn bracket_and_jacobi_sum() {
    let case = Case::new(PARTICLE);
    let cx = case.context();
    let (system, g) = (&case.system, &case.system.graph);
    let bracket = ReducedBracket::new(&basis(&cx)).unwrap().unwrap();
    let sum = bracket.jacobi_sum(system, [2, 3, 4]);
    assert!(case.equal(sum, case.read("-1/(1 + y^2)")));
    let equations = case.equations(NAME);
    let rates: Vec<Expr> = equations
        .velocities
        .iter()
        .copied()
        .chain(equations.rates())
        .collect();
    for (a, &symbol) in bracket.variables.iter().enumerate() {
        let rate = bracket.of(system, g.symbol_expr(symbol), bracket.hamiltonian);
        assert!(case.equal(rate, rates[a]));
        for b in 0..bracket.variables.len() {
            let sum = g.add(&[bracket.table[a][b], bracket.table[b][a]]);
            assert!(vanishes(&case, sum));
        }
    }
}

/// An integrable constraint: R = 0, and Jacobi's identity holds.
#[test]
fn jacobi_identity_of_an_integrable_constraint() {
    let case = Case::new(&PARTICLE.replace("z' = y x'", "z' = y x' + x y'"));
    let cx = case.context();
    let bracket = ReducedBracket::new(&basis(&cx)).unwrap().unwrap();
    let size = bracket.variables.len();
    for a in 0..size {
        for b in a + 1..size {
            for c in b + 1..size {
                let sum = bracket.jacobi_sum(&case.system, [a, b, c]);
                assert!(vanishes(&case, sum));
            }
        }
    }
}

/// No bracket for constraints that are not linear and homogeneous.
#[test]
fn bracket_of_other_constraints() {
    for text in [APPELL_HAMEL, DRIVEN] {
        let case = Case::new(text);
        let cx = case.context();
        assert!(ReducedBracket::new(&basis(&cx)).unwrap().is_none());
    }
}

/// S3: Hess L̄ = m(1 + a²), and p̃' as printed there: −m g a v_s/ρ + m a ρ A_s.
#[test]
fn appell_hamel_in_closed_form() {
    let case = Case::new(APPELL_HAMEL);
    expect(&case, "model.restricted-hessian-regular", "proved");
    let equations = case.equations(NAME);
    let p = case.object(&equations, "ptilde_x");
    assert!(case.equal_on_constraints(p, case.read("m (1 + a^2) x'")));
    // v = p̃/(m (1 + a²)), so that A, which is homogeneous of degree zero, is the same function of p̃ and p̃'.
    let a_x = case.object(&equations, "A_z_x");
    let rates = "(ptilde_y ptilde_x' - ptilde_x ptilde_y')";
    let printed = format!("a ptilde_y {rates}/sqrt(ptilde_x^2 + ptilde_y^2)^3");
    assert!(case.equal(a_x, case.read(&printed)));
    let hamiltonian = case.object(&equations, "Htilde");
    let printed = "(ptilde_x^2 + ptilde_y^2)/(2 m (1 + a^2)) + m g z";
    assert!(case.equal(hamiltonian, case.read(printed)));
    // A vanishes on the motions, and p̃' = −m g a p̃/|p̃|.
    assert!(equations.relations.is_empty());
    for (variable, name) in equations.variables.iter().zip(["x", "y"]) {
        let printed = format!("-m g a ptilde_{name}/sqrt(ptilde_x^2 + ptilde_y^2)");
        assert!(case.equal(variable.rate, case.read(&printed)), "{name}");
    }
}

/// A relativistic particle on z' = y x': H̃ = c √(m²c² + p̃_x²/(1 + y²) + p̃_y²), the kinetic part of S4 under the root.
#[test]
fn relativistic_particle_in_closed_form() {
    let case = Case::new(RELATIVISTIC);
    let equations = case.equations(NAME);
    assert!(equations.relations.is_empty());
    let hamiltonian = case.object(&equations, "Htilde");
    let printed = "c sqrt(m^2 c^2 + ptilde_x^2/(1 + y^2) + ptilde_y^2)";
    assert!(case.equal(hamiltonian, case.read(printed)));
    expect(&case, "formulation.equivalent#canonical-reduced", "proved");
}

/// Isokinetic particle: accelerations are unique, but p̃ = 0 on the whole constraint manifold.
#[test]
fn isokinetic_particle_does_not_apply() {
    let case = Case::new(
        "coordinates = [\"x\", \"y\"]\nparameters = { m = {}, c = {} }\nassumptions = [\"m > 0\", \"c > 0\"]\n\
         lagrangian = { T = \"1/2 m (x'^2 + y'^2)\", V = \"x^2 y\" }\nconstraints = { speed = \"x'^2 + y'^2 = c^2\" }",
    );
    expect(&case, "model.accelerations-unique", "proved");
    expect(&case, "model.restricted-hessian-regular", "refuted");
    expect(
        &case,
        "formulation.equivalent#canonical-reduced",
        "not-applicable",
    );
    expect(&case, "formulation.equivalent#canonical", "proved");
}

/// z' = y x' + b: H̃ is an integral, the energy is H̃ + b θ and changes by b λ.
#[test]
fn reduced_hamiltonian_is_not_the_energy() {
    let text = "coordinates = [\"x\", \"y\", \"z\"]\nparameters = { b = {} }\n\
                lagrangian = { L = \"1/2 (x'^2 + y'^2 + z'^2)\" }\nconstraints = { c = \"z' = y x' + b\" }";
    let case = Case::new(text);
    let (system, g) = (&case.system, &case.system.graph);
    expect(&case, "formulation.equivalent#canonical-reduced", "proved");
    let equations = case.equations(NAME);
    let hamiltonian = case.object(&equations, "Htilde");
    let theta = case.object(&equations, "theta_z");
    let natural = equations.in_natural_state(system, &[hamiltonian, theta]);
    let energy = g.add(&[natural[0], g.mul(&[case.read("b"), natural[1]])]);
    assert!(case.equal_on_constraints(energy, system.energy()));
    let rates: Vec<_> = equations
        .variables
        .iter()
        .map(|x| (x.symbol, x.rate))
        .collect();
    let one = g.one();
    let rate = chetaev_mechanics::characteristics::derive_along(
        system,
        &[hamiltonian],
        &equations.velocities,
        one,
        &rates,
    );
    assert!(vanishes(&case, rate[0]));
}

/// The mutant in which θ comes from the restricted Lagrangian, where z' no longer occurs: p̃_x' = 0 for S4, a different motion.
#[test]
fn theta_of_the_restricted_lagrangian_is_refuted() {
    let case = Case::new(PARTICLE);
    let equations = case.equations(NAME);
    let mutant = changed(&case, &equations, |_, rates| {
        // −∂H̃/∂y alone, without the term θ A.
        rates[0] = case.read("0");
        rates[1] = case.read("y ptilde_x^2/(1 + y^2)^2");
    });
    assert_eq!(compared(&case, &mutant), "refuted");
}
