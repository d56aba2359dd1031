//! Nielsen's equations and Tsenov's (T1 §9.5, T3 (12)).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::voronets::CUBIC;
use chetaev_mechanics::formulations::nielsen_left_sides;
use chetaev_symbolic::Expr;

const CLAIM: &str = "formulation.equivalent#nielsen";

/// Asserts that two expressions are refuted to be equal on the constraints.
#[track_caller]
pub fn expect_different(case: &Case, a: Expr, b: Expr) {
    let cx = case.context();
    let manifold = chetaev_mechanics::claims::formulation::manifold(&cx);
    let difference = [case.system.graph.sub(a, b)];
    let verdict = cx.prover.identity(&case.system, &difference, &manifold, "");
    assert!(
        matches!(verdict.word(), "refuted" | "conditional"),
        "{verdict:?}"
    );
}

#[test]
fn it_is_equivalent_to_routh() {
    let moving =
        format!("{SKATE}[quasi_velocities]\nu = \"x' cos(phi) + y' sin(phi)\"\nw = \"phi' + t\"\n");
    let affine = PARTICLE.replace("z' = y x'", "z' = y x' + t y' + x");
    let texts = [
        SKATE,
        DISC,
        APPELL_HAMEL,
        PARTICLE,
        POLAR,
        CUBIC,
        &moving,
        &affine,
    ];
    for text in texts {
        expect(&Case::new(text), CLAIM, "proved");
    }
}

#[test]
fn nielsen_and_tsenov_are_lagrange_identically() {
    let time = "lagrangian = { L = \"x^2 x'^3 y' + sin(t x) y'^2 + exp(y) x'\" }\ncoordinates = [\"x\", \"y\"]\n";
    for text in [SKATE, APPELL_HAMEL, POLAR, time] {
        expect(&Case::new(text), "formulation.identity#nielsen", "proved");
    }
}

/// The general form for orders 1 to 4, with a T that depends on q, v and t (T1 (52)); with m in the place of m + 1 it is
/// wrong.
#[test]
fn the_forms_of_order_one_to_four() {
    let case = Case::new("lagrangian = { L = \"1/2 (1 + x^2 + t y) x'^2 + x y x' y' + t^2 y'^2\" }\ncoordinates = [\"x\", \"y\"]\n");
    let lagrange = case.system.lagrange_left_sides();
    for order in 1..=4 {
        for (&a, &b) in nielsen_left_sides(&case.system, order)
            .iter()
            .zip(&lagrange)
        {
            assert!(case.equal(a, b), "order {order}");
        }
    }
    let g = &case.system.graph;
    let x = &case.system.coordinates[0];
    let rate = case.system.total_derivative(case.system.lagrangian);
    let slope = g.diff(case.system.lagrangian, x.q_symbol);
    let once = g.sub(g.diff(rate, x.v_symbol), slope);
    expect_different(&case, once, lagrange[0]);
}

/// Polar: D T = m (r'r'' + r r'θ'² + r² θ'θ''), and ∂(D T)/∂r' - 2 ∂T/∂r = m (r'' - r θ'²). With the accelerations of the free
/// motion put in before the differentiation, the r equation shows -2 m r θ'² instead of 0.
#[test]
fn accelerations_are_frozen() {
    let case = Case::new(POLAR);
    let g = &case.system.graph;
    let rate = case.system.total_derivative(case.system.lagrangian);
    let stated = case.read("m (r' r'' + r r' theta'^2 + r^2 theta' theta'')");
    assert!(case.equal(rate, stated));
    let equations = case.equations("nielsen");
    let reduced = &equations.groups[1].equations[0];
    let left = g.sub(reduced.left, reduced.right);
    assert!(case.equal(left, case.read("m (r'' - r theta'^2)")));
    let motion: Vec<(Expr, Expr)> = case
        .system
        .coordinates
        .iter()
        .zip(&equations.accelerations)
        .map(|(c, &a)| (c.a, a))
        .collect();
    let r = &case.system.coordinates[0];
    let slope = g.mul(&[g.integer(2), g.diff(case.system.lagrangian, r.q_symbol)]);
    let mutant = g.sub(g.diff(g.substitute(rate, &motion), r.v_symbol), slope);
    assert!(case.equal(mutant, case.read("-2 m r theta'^2")));
    expect_different(&case, mutant, g.zero());
}

/// S4: (1 + y²) x'' + y x'y' = 0, y'' = 0, with θ = y x' from the full L.
#[test]
fn the_particle_of_the_notes() {
    let text = format!("{PARTICLE}velocities = {{ independent = [\"x'\", \"y'\"] }}\n");
    let case = Case::new(&text);
    let g = &case.system.graph;
    let equations = case.equations("nielsen");
    let expected = ["(1 + y^2) x'' + y x' y'", "y''"];
    for (equation, text) in equations.groups[1].equations.iter().zip(expected) {
        let difference = g.sub(equation.left, equation.right);
        assert!(case.equal(difference, case.read(text)), "{text}");
    }
    for (name, text) in [("p_z", "y x'"), ("A_z_x", "y'"), ("A_z_y", "-x'")] {
        assert!(
            case.equal(case.object(&equations, name), case.read(text)),
            "{name}"
        );
    }
    // Without the curvature terms the x equation is Lagrange's for L* alone.
    let alone = equations.groups[1].equations[0].left;
    expect_different(&case, alone, case.read(expected[0]));
}
