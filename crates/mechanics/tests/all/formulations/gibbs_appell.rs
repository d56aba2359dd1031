//! The equations of Gibbs and Appell (T1 §9.2).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::nielsen::expect_different;
use crate::formulations::voronets::CUBIC;
use chetaev_symbolic::verdict::Method;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Verdict};

const CLAIM: &str = "formulation.equivalent#gibbs-appell";

/// S4 as a particle.
pub const PARTICLE_S4: &str = r#"
coordinates = ["x", "y", "z"]
velocities = { independent = ["x'", "y'"] }
constraints = { c = "z' = y x'" }
[particles.p]
mass = "1"
position = ["x", "y", "z"]
"#;

/// S1 as two particles on a line across the blade: mass m, moment of inertia J = m b².
pub const PAIR_S1: &str = r#"
coordinates = ["x", "y", "phi"]
parameters = { m = {}, b = {}, G = {} }
assumptions = ["m > 0", "b > 0"]
constraints = { blade = "x' sin(phi) = y' cos(phi)" }
[quasi_velocities]
u = "x' cos(phi) + y' sin(phi)"
w = "phi'"
[particles.left]
mass = "m/2"
position = ["x - b sin(phi)", "y + b cos(phi)"]
force = ["m G/2", "0"]
[particles.right]
mass = "m/2"
position = ["x + b sin(phi)", "y - b cos(phi)"]
force = ["m G/2", "0"]
"#;

/// S3 as a particle.
pub const PARTICLE_S3: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { m = {}, g = {}, a = {} }
assumptions = ["m > 0", "a > 0"]
velocities = { independent = ["x'", "y'"] }
constraints = { cone = "z' = a sqrt(x'^2 + y'^2)" }
[particles.p]
mass = "m"
position = ["x", "y", "z"]
force = ["0", "0", "-m g"]
"#;

/// A particle in the plane in polar coordinates.
pub const PARTICLE_POLAR: &str = r#"
coordinates = ["r", "theta"]
parameters = { m = {} }
assumptions = ["m > 0", "r > 0"]
[particles.p]
mass = "m"
position = ["r cos(theta)", "r sin(theta)"]
"#;

/// A bead on a hoop that turns, pulled by gravity as a potential, damped by a generalized force: positions with explicit
/// time.
pub const BEAD: &str = r#"
coordinates = ["theta"]
parameters = { m = {}, R = {}, g = {}, W = {}, c = {} }
assumptions = ["m > 0", "R > 0"]
lagrangian = { V = "-m g R cos(theta)" }
forces = { theta = "-c theta'" }
[particles.bead]
mass = "m"
position = ["R sin(theta) cos(W t)", "R sin(theta) sin(W t)", "-R cos(theta)"]
"#;

#[test]
fn from_particles_it_is_equivalent_to_routh() {
    for text in [PARTICLE_S4, PAIR_S1, PARTICLE_S3, PARTICLE_POLAR, BEAD] {
        let case = Case::new(text);
        let finding = case.finding(CLAIM);
        match &finding.verdict {
            Verdict::Proved(proof) => assert_ne!(proof.method, Method::Structural, "{text}"),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn from_the_lagrangian_it_is_maggi_by_construction() {
    let rotor = PARTICLE_S4.replace(
        "velocities",
        "lagrangian = { T = \"1/2 (x'^2 + y'^2 + 2 z'^2)\" }\nvelocities",
    );
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR, CUBIC, &rotor] {
        let case = Case::new(text);
        let finding = case.finding(CLAIM);
        match &finding.verdict {
            Verdict::Proved(proof) => assert_eq!(proof.method, Method::Structural, "{text}"),
            other => panic!("{other:?}"),
        }
    }
}

/// The acceleration energies of the notes, without terms free of the rates.
#[test]
fn the_acceleration_energies_of_the_notes() {
    let cases = [
        (PARTICLE_S4, "(x''^2 + y''^2 + (y x'')^2 + 2 y x'' x' y')/2"),
        (PAIR_S1, "m u'^2/2 + m b^2 w'^2/2"),
        (
            PARTICLE_POLAR,
            "m (r''^2 - 2 r'' r theta'^2 + r^2 theta''^2 + 4 r r' theta' theta'')/2",
        ),
    ];
    for (text, expected) in cases {
        let case = Case::new(text);
        let energy = case.object(&case.equations("gibbs-appell"), "S");
        assert!(case.equal(energy, case.read(expected)), "{expected}");
    }
}

/// S1: m u' = m G cos φ, m b² w' = 0. S4: (1 + y²) x'' + y x'y' = 0. The bead: m R² θ'' = m R² W² sin θ cos θ - m g R sin θ - c θ'.
#[test]
fn the_equations_of_the_notes() {
    let cases = [
        (PAIR_S1, vec!["m u' - m G cos(phi)", "m b^2 w'"]),
        (PARTICLE_S4, vec!["(1 + y^2) x'' + y x' y'", "y''"]),
        (
            BEAD,
            vec!["m R^2 theta'' - m R^2 W^2 sin(theta) cos(theta) + m g R sin(theta) + c theta'"],
        ),
    ];
    for (text, expected) in cases {
        let case = Case::new(text);
        let g = &case.system.graph;
        for (equation, text) in case.equations("gibbs-appell").groups[0]
            .equations
            .iter()
            .zip(expected)
        {
            let difference = g.sub(equation.left, equation.right);
            assert!(case.equal(difference, case.read(text)), "{text}");
        }
    }
}

/// A function of S3 for a velocity (ρ cos ψ, ρ sin ψ, a ρ), ρ > 0, equals another.
#[track_caller]
pub fn expect_in_polar_velocities(case: &Case, value: Expr, expected: &str) {
    let g = &case.system.graph;
    let pairs = [
        ("x'", "rho cos(psi)"),
        ("y'", "rho sin(psi)"),
        ("z'", "a rho"),
        ("x''", "rho' cos(psi) - rho psi' sin(psi)"),
        ("y''", "rho' sin(psi) + rho psi' cos(psi)"),
    ]
    .map(|(from, to)| (case.read(from), case.read(to)));
    let residual = [g.sub(g.substitute(value, &pairs), case.read(expected))];
    let mut assumptions = Assumptions::new();
    assumptions.positive(g, case.read("rho"));
    let verdict = decide_zero(g, &ZeroTest::everywhere(&residual, &assumptions));
    assert_eq!(verdict.word(), "proved", "{expected}: {}", verdict.detail());
}

/// S3: S = m ((1 + a²) ρ'² + ρ² ψ'²)/2, with right sides -m g a along ρ and 0 along ψ.
#[test]
fn the_machine_of_appell_and_hamel() {
    let case = Case::new(PARTICLE_S3);
    let g = &case.system.graph;
    let equations = case.equations("gibbs-appell");
    let energy = case.object(&equations, "S");
    expect_in_polar_velocities(&case, energy, "m ((1 + a^2) rho'^2 + rho^2 psi'^2)/2");
    let right: Vec<Expr> = equations.groups[0]
        .equations
        .iter()
        .map(|e| e.right)
        .collect();
    let along = |x: &str, y: &str| {
        g.add(&[
            g.mul(&[case.read(x), right[0]]),
            g.mul(&[case.read(y), right[1]]),
        ])
    };
    expect_in_polar_velocities(&case, along("cos(psi)", "sin(psi)"), "-m g a");
    expect_in_polar_velocities(&case, along("-rho sin(psi)", "rho cos(psi)"), "0");
}

/// Dropping the offset a* (here x'y') loses the curvature of the constraint: (1 + y²) x'' = 0. ½ aᵀ W a alone loses the
/// terms linear in the accelerations in curved coordinates: m r'' = 0.
#[test]
fn the_classical_mistakes_are_refuted() {
    let case = Case::new(PARTICLE_S4);
    let left = case.equations("gibbs-appell").groups[0].equations[0].left;
    expect_different(&case, left, case.read("(1 + y^2) x''"));
    for text in [POLAR, PARTICLE_POLAR] {
        let case = Case::new(text);
        let left = case.equations("gibbs-appell").groups[0].equations[0].left;
        assert!(case.equal(left, case.read("m r'' - m r theta'^2")));
        expect_different(&case, left, case.read("m r''"));
    }
}

/// Kane and Gibbs–Appell apply without particles too.
#[test]
fn kane_and_gibbs_need_no_particles() {
    for name in ["gibbs-appell", "kane"] {
        expect(
            &Case::new(SKATE),
            &format!("formulation.equivalent#{name}"),
            "proved",
        );
    }
}
