//! Voronets' equations and the curvature of constraints (T1 §§2–3).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use chetaev_mechanics::curvature::curvature;
use chetaev_mechanics::{Characteristics, Selection};
use chetaev_symbolic::Expr;

const CLAIM: &str = "formulation.equivalent#voronets";

/// An implicit constraint with one real root (T1 §9.6).
pub const CUBIC: &str = r#"
coordinates = ["x", "y", "z"]
parameters = { m = {}, g = {} }
assumptions = ["m > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2 + z'^2)", V = "m g z" }
constraints = { c = "z'^3 + z' = x' y'" }
"#;

#[test]
fn it_is_equivalent_to_routh() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR, CUBIC] {
        expect(&Case::new(text), CLAIM, "proved");
    }
}

/// Curvature coefficients for dependent velocities given by name.
fn table(case: &Case, dependent: &[usize], rows: &[usize]) -> Vec<Vec<Expr>> {
    let cx = case.context();
    let selection = Selection {
        rows: rows.to_vec(),
        dependent: dependent.to_vec(),
    };
    let c = Characteristics::independent_velocities(cx.system, cx.terms, &selection).unwrap();
    curvature(cx.system, &c)
}

#[test]
fn the_curvature_tables_of_the_notes() {
    // S1 with independent x, φ.
    let case = Case::new(SKATE);
    let a = table(&case, &[1], &[0]);
    let expected = ["phi'/cos(phi)^2", "-x'/cos(phi)^2"];
    for (s, text) in expected.iter().enumerate() {
        assert!(case.equal(a[0][s], case.read(text)), "{text}");
    }
    // S2.
    let case = Case::new(DISC);
    let a = table(&case, &[2, 3], &[0, 1]);
    let expected = [
        ["-R sin(phi) phi'", "R sin(phi) theta'"],
        ["R cos(phi) phi'", "-R cos(phi) theta'"],
    ];
    for (l, row) in expected.iter().enumerate() {
        for (s, text) in row.iter().enumerate() {
            assert!(case.equal(a[l][s], case.read(text)), "{text}");
        }
    }
    // S3, nonlinear: accelerations occur.
    let case = Case::new(APPELL_HAMEL);
    let a = table(&case, &[2], &[0]);
    let rho = "sqrt(x'^2 + y'^2)^3";
    let expected = [
        format!("a y' (y' x'' - x' y'')/{rho}"),
        format!("a x' (x' y'' - y' x'')/{rho}"),
    ];
    for (s, text) in expected.iter().enumerate() {
        assert!(
            case.equal_on_constraints(a[0][s], case.read(text)),
            "{text}"
        );
    }
    // S4.
    let case = Case::new(PARTICLE);
    let a = table(&case, &[2], &[0]);
    assert!(case.equal(a[0][0], case.read("y'")) && case.equal(a[0][1], case.read("-x'")));
}

/// Integrable: z' = y x' + x y' has A = 0, also when multiplied by a function.
#[test]
fn an_integrable_constraint_has_no_curvature() {
    for constraint in ["z' = y x' + x y'", "exp(x) (z' - y x' - x y') = 0"] {
        let text = PARTICLE.replace("z' = y x'", constraint);
        let case = Case::new(&text);
        let zero = case.read("0");
        for a in table(&case, &[2], &[0]).concat() {
            assert!(case.equal(a, zero), "{constraint}");
        }
    }
}

/// For constraints homogeneous of degree 1 without time, Σ A^l_s v^s = 0.
#[test]
fn the_curvature_contracted_with_the_velocities_vanishes() {
    let cases = [
        (SKATE, vec![1], vec![0]),
        (DISC, vec![2, 3], vec![0, 1]),
        (APPELL_HAMEL, vec![2], vec![0]),
        (PARTICLE, vec![2], vec![0]),
    ];
    for (text, dependent, rows) in cases {
        let case = Case::new(text);
        let g = &case.system.graph;
        let independent: Vec<usize> = (0..case.system.n())
            .filter(|i| !dependent.contains(i))
            .collect();
        for row in table(&case, &dependent, &rows) {
            let parts: Vec<Expr> = row
                .iter()
                .zip(&independent)
                .map(|(&a, &i)| g.mul(&[a, case.system.coordinates[i].v]))
                .collect();
            assert!(case.equal_on_constraints(g.add(&parts), g.zero()));
        }
    }
}

/// S4: (1 + y²) x'' + 2 y x'y' = y x'y' and y'' - y x'² = -y x'². The x equation without its right side, Lagrange's for L*
/// alone, is the classical error.
#[test]
fn the_particle_of_the_notes() {
    let case = Case::new(&format!(
        "{PARTICLE}velocities = {{ independent = [\"x'\", \"y'\"] }}\n"
    ));
    let g = &case.system.graph;
    let equations = case.equations("voronets");
    let motion = &equations.groups[0].equations;
    let stated = [
        ("(1 + y^2) x'' + 2 y x' y'", "y x' y'"),
        ("y'' - y x'^2", "-y x' x'"),
    ];
    for (equation, (left, right)) in motion.iter().zip(stated) {
        assert!(case.equal(equation.left, case.read(left)), "{left}");
        assert!(case.equal(equation.right, case.read(right)), "{right}");
    }
    assert!(case.equal(case.object(&equations, "theta_z"), case.read("y x'")));
    // Lagrange's equations for L* alone give x'' = -2 y x'y'/(1 + y²).
    let wrong = case.read("-2 y x' y'/(1 + y^2)");
    assert!(!case.equal_on_constraints(equations.accelerations[0], wrong));
    // Momenta from L*, which does not contain z', would be zero.
    assert!(!g.is_zero(case.object(&equations, "theta_z")));
}

/// S1 on a level plane: m sec²φ x'' + 2 m sec²φ tan φ x'φ' minus the curvature term m tan φ x' sec²φ φ', and J φ'' = 0.
#[test]
fn the_skate_of_the_notes() {
    let case = Case::new(SKATE);
    let cx = case.context();
    let selection = Selection {
        rows: vec![0],
        dependent: vec![1],
    };
    let c = Characteristics::independent_velocities(cx.system, cx.terms, &selection).unwrap();
    let mut basis = chetaev_mechanics::claims::formulation::basis(&cx);
    basis.characteristics = Some(c);
    let voronets = chetaev_mechanics::formulation("voronets").unwrap();
    let equations = voronets.equations(&basis).unwrap();
    let theta = case.object(&equations, "theta_y");
    assert!(case.equal(theta, case.read("m x' sin(phi)/cos(phi)")));
    let g = &case.system.graph;
    let of = |i: usize| {
        let equation = &equations.groups[0].equations[i];
        g.sub(equation.left, equation.right)
    };
    let x = "m x''/cos(phi)^2 + m sin(phi) x' phi'/cos(phi)^3 - m G";
    assert!(case.equal(of(0), case.read(x)));
    assert!(case.equal(of(1), case.read("J phi''")));
}

/// Explicit time and a control in the constraint.
#[test]
fn a_moving_blade() {
    let text = SKATE.replace(
        "x' sin(phi) = y' cos(phi)",
        "(x' - t y) sin(phi) = (y' - u) cos(phi)",
    ) + "[controls]\nu = \"sin(t)\"\n";
    for name in [
        "voronets",
        "lagrange-dalembert",
        "volterra-first",
        "volterra-second",
    ] {
        expect(
            &Case::new(&text),
            &format!("formulation.equivalent#{name}"),
            "proved",
        );
    }
}
