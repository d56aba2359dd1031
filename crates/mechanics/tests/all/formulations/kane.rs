//! Kane's equations (T1 §9.3).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::gibbs_appell::{
    expect_in_polar_velocities, BEAD, PAIR_S1, PARTICLE_POLAR, PARTICLE_S3, PARTICLE_S4,
};
use crate::formulations::nielsen::expect_different;
use crate::formulations::voronets::CUBIC;
use chetaev_symbolic::verdict::Method;
use chetaev_symbolic::{Expr, Verdict};

const CLAIM: &str = "formulation.equivalent#kane";

#[test]
fn it_is_equivalent_to_routh() {
    let from_particles = [PARTICLE_S4, PAIR_S1, PARTICLE_S3, PARTICLE_POLAR, BEAD];
    let from_lagrangian = [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR, CUBIC];
    let texts = from_particles.iter().map(|t| (t, false));
    for (text, structural) in texts.chain(from_lagrangian.iter().map(|t| (t, true))) {
        let case = Case::new(text);
        match &case.finding(CLAIM).verdict {
            Verdict::Proved(proof) => {
                assert_eq!(proof.method == Method::Structural, structural, "{text}");
            }
            other => panic!("{other:?}"),
        }
    }
}

/// S1 with u, w: F = (m G cos φ, 0), F* = (-m u', -J w').
#[test]
fn the_skate_of_the_notes() {
    let case = Case::new(PAIR_S1);
    let equations = case.equations("kane");
    let expected = [
        ("F_u", "m G cos(phi)"),
        ("F_w", "0"),
        ("Fstar_u", "-m u'"),
        ("Fstar_w", "-m b^2 w'"),
        ("V_left_1_u", "cos(phi)"),
        ("V_left_1_w", "-b cos(phi)"),
    ];
    for (name, text) in expected {
        assert!(
            case.equal(case.object(&equations, name), case.read(text)),
            "{name}"
        );
    }
}

/// The same skate with T and V stated in place of particles: gravity is an active force all the same, and S of Gibbs and
/// Appell does not contain it.
#[test]
fn a_potential_is_an_active_force() {
    let stated = "coordinates = [\"x\", \"y\", \"phi\"]\nparameters = { m = {}, J = {}, G = {} }\n\
        lagrangian = { T = \"m/2 (x'^2 + y'^2) + J/2 phi'^2\", V = \"-m G x\" }\n\
        constraints = { blade = \"x' sin(phi) - y' cos(phi) = 0\" }\n\
        [quasi_velocities]\nu = \"x' cos(phi) + y' sin(phi)\"\nw = \"phi'\"\n";
    let case = Case::new(stated);
    let kane = case.equations("kane");
    let expected = [
        ("F_u", "m G cos(phi)"),
        ("F_w", "0"),
        ("Fstar_u", "-m u'"),
        ("Fstar_w", "-J w'"),
    ];
    for (name, text) in expected {
        assert!(
            case.equal(case.object(&kane, name), case.read(text)),
            "{name}"
        );
    }
    let appell = case.equations("gibbs-appell");
    for (name, text) in [("S", "m/2 u'^2 + J/2 w'^2"), ("Pi_u", "m G cos(phi)")] {
        assert!(
            case.equal(case.object(&appell, name), case.read(text)),
            "{name}"
        );
    }
    for claim in [CLAIM, "formulation.equivalent#gibbs-appell"] {
        expect(&case, claim, "proved");
    }
}

/// S3 in the parameters ρ, ψ of the cone: m (1 + a²) ρ' = -m g a, m ρ² ψ' = 0 (T1 §9.3).
#[test]
fn appells_cone_in_stated_characteristics() {
    let cone = "coordinates = [\"x\", \"y\", \"z\"]\nparameters = { m = {}, g = {}, a = {} }\n\
        assumptions = [\"a > 0\", \"rho > 0\"]\n\
        lagrangian = { T = \"m/2 (x'^2 + y'^2 + z'^2)\", V = \"m g z\" }\n\
        constraints = { cone = \"z' = a sqrt(x'^2 + y'^2)\" }\n\
        [characteristics]\nparameters = [\"rho\", \"psi\"]\n\
        \"x'\" = \"rho cos(psi)\"\n\"y'\" = \"rho sin(psi)\"\n\"z'\" = \"a rho\"\n";
    let case = Case::new(cone);
    let kane = case.equations("kane");
    let expected = [
        ("F_rho", "-m g a"),
        ("F_psi", "0"),
        ("Fstar_rho", "-m (1 + a^2) rho'"),
        ("Fstar_psi", "-m rho^2 psi'"),
    ];
    for (name, text) in expected {
        assert!(
            case.equal(case.object(&kane, name), case.read(text)),
            "{name}"
        );
    }
    let appell = case.equations("gibbs-appell");
    let energy = case.read("m/2 ((1 + a^2) rho'^2 + rho^2 psi'^2)");
    assert!(case.equal(case.object(&appell, "S"), energy));
    for claim in [CLAIM, "formulation.equivalent#gibbs-appell"] {
        expect(&case, claim, "proved");
    }
}

/// S2 with u1 = θ', u2 = φ': F* = (-(I + m R²) u1', -J u2').
#[test]
fn the_disc_of_the_notes() {
    let case = Case::new(&format!(
        "{DISC}[quasi_velocities]\nu1 = \"theta'\"\nu2 = \"phi'\"\n"
    ));
    let equations = case.equations("kane");
    for (name, text) in [("Fstar_u1", "-(I + m R^2) u1'"), ("Fstar_u2", "-J u2'")] {
        assert!(
            case.equal(case.object(&equations, name), case.read(text)),
            "{name}"
        );
    }
}

/// For nonlinear constraints the partial velocities depend on the speeds: S3 has ∂z'/∂x' = a x'/ρ. Along ρ and ψ of the
/// velocity the balance is -m g a - m (1 + a²) ρ' and -m ρ² ψ'.
#[test]
fn the_machine_of_appell_and_hamel() {
    let case = Case::new(PARTICLE_S3);
    let g = &case.system.graph;
    let equations = case.equations("kane");
    let partial = case.object(&equations, "V_p_3_x");
    assert!(case.equal_on_constraints(partial, case.read("a x'/sqrt(x'^2 + y'^2)")));
    let sum: Vec<Expr> = equations.groups[0]
        .equations
        .iter()
        .map(|e| e.left)
        .collect();
    let along = |x: &str, y: &str| {
        g.add(&[
            g.mul(&[case.read(x), sum[0]]),
            g.mul(&[case.read(y), sum[1]]),
        ])
    };
    let radial = along("cos(psi)", "sin(psi)");
    expect_in_polar_velocities(&case, radial, "-m g a - m (1 + a^2) rho'");
    let across = along("-rho sin(psi)", "rho cos(psi)");
    expect_in_polar_velocities(&case, across, "-m rho^2 psi'");
}

/// Inertia forces without the turning of the partial velocities, m r'' · ∂r'/∂θ' with r'' = 0 at θ'' = 0, miss 2 m r r'θ'.
#[test]
fn a_dropped_term_is_refuted() {
    let case = Case::new(PARTICLE_POLAR);
    let equations = case.equations("kane");
    let inertia = case.object(&equations, "Fstar_theta");
    assert!(case.equal(inertia, case.read("-m r^2 theta'' - 2 m r r' theta'")));
    expect_different(&case, inertia, case.read("-m r^2 theta''"));
    expect(&case, CLAIM, "proved");
}
