//! Rumyantsev's survey and what is copied from it, and one formula of Qiao.

use super::manifold::{on_manifold, Chart, OnManifold};
use crate::formulations::common::{expect, Case, APPELL_HAMEL, PARTICLE};
use crate::formulations::nielsen::expect_different;
use chetaev_symbolic::Expr;

/// Rumyantsev's survey: with the dot of ∂f/∂q' lost, the reaction works on virtual displacements, the equations contradict the
/// constraint, and the condition of the energy integral fails where the integral exists (S4).
#[test]
fn rumyantsev_lost_dots() {
    let case = Case::new(PARTICLE);
    let (g, system) = (&case.system.graph, &case.system);
    let f = system.constraints[0].f;
    let by_velocity = g.gradient(f, &system.velocity_symbols());
    let by_coordinate = g.gradient(f, &system.coordinate_symbols());
    let sum = |row: &[Expr], texts: [&str; 3]| {
        let parts = row.iter().zip(texts);
        let parts: Vec<Expr> = parts.map(|(&a, b)| g.mul(&[a, case.read(b)])).collect();
        g.add(&parts)
    };
    let displacement = ["1", "1", "y"];
    assert!(case.equal(sum(&by_velocity, displacement), g.zero()));
    expect_different(&case, sum(&by_coordinate, displacement), g.zero());
    let velocity = ["x'", "y'", "z'"];
    assert!(case.equal_on_constraints(sum(&by_velocity, velocity), g.zero()));
    expect_different(&case, sum(&by_coordinate, velocity), g.zero());
    // q'' = λ ∂f/∂q has z'' - y x'' = 0, but f = 0 demands z'' - y x'' = x'y'.
    let pushed = sum(&by_coordinate, ["-y", "0", "1"]);
    assert!(case.equal(pushed, g.zero()));
    let motion = case.equations("routh").accelerations;
    let demanded = g.sub(motion[2], g.mul(&[case.read("y"), motion[0]]));
    assert!(case.equal_on_constraints(demanded, case.read("x' y'")));
}

/// Rumyantsev's survey: Σ θ_l A^l_s = 0 holds on every motion of the machine of Appell and Hamel, but κ = -θ does not satisfy
/// κ' = -λ, while κ = m ρ/a does.
#[test]
fn rumyantsev_suslov_condition_beyond_chaplygin() {
    let text = format!("{APPELL_HAMEL}velocities = {{ independent = [\"x'\", \"y'\"] }}\n");
    on_manifold(&text, Chart::Natural, |n| {
        let theta = n.terms.dependent_momenta[0];
        n.equal(theta, "m a sqrt(x'^2 + y'^2)");
        for i in 0..2 {
            n.vanishes(n.moving(n.turning(i)[0]));
        }
        n.equal(n.reactions[0], "m g/(1 + a^2)");
        let g = &n.case.system.graph;
        n.fails(g.add(&[n.along(g.neg(theta)), n.reactions[0]]));
        let kappa = n.read("m sqrt(x'^2 + y'^2)/a");
        n.vanishes(g.add(&[n.along(kappa), n.reactions[0]]));
    });
}

/// Rumyantsev's survey: the momenta of the reduced canonical equations belong to the time τ, p_s = N P_s with dτ = N dt. S4 with
/// N = (1+y²)^(-1/2) and Ĥ = (p_x² + (1+y²) p_y²)/2; with P_s in their place the equations fail.
#[test]
fn rumyantsev_momenta_of_the_reduced_time() {
    let text = format!("{PARTICLE}velocities = {{ independent = [\"x'\", \"y'\"] }}\n");
    on_manifold(&text, Chart::Natural, |n| {
        let g = &n.case.system.graph;
        let reducer = n.read("1/sqrt(1 + y^2)");
        let rate = |e: Expr| g.div(n.along(e), reducer);
        let slope = |p_y: Expr| g.neg(g.mul(&[n.read("y"), p_y, p_y]));
        let [p_x, p_y] = [0, 1].map(|s| n.terms.momenta[s]);
        let [tau_x, tau_y] = [p_x, p_y].map(|p| g.mul(&[reducer, p]));
        n.vanishes(rate(tau_x));
        n.vanishes(g.sub(rate(tau_y), slope(tau_y)));
        n.vanishes(g.sub(rate(n.read("x")), tau_x));
        n.fails(rate(p_x));
        n.fails(g.sub(rate(p_y), slope(p_y)));
    });
}

/// Rumyantsev's survey: y' = t x' is homogeneous, so the energy is an integral, but Jacobi's form does not apply because the
/// constraint depends on the time.
#[test]
fn rumyantsev_jacobi_needs_scleronomic_constraints() {
    let text = r#"
coordinates = ["x", "y"]
lagrangian = { L = "1/2 (x'^2 + y'^2)" }
constraints = { c = "y' = t x'" }
"#;
    on_manifold(text, Chart::Natural, |n| {
        let energy = n.case.system.energy();
        let chart = &n.embedding.chart;
        n.vanishes(n.along(chart.restrict(&n.case.system, &[energy])[0]));
        expect(n.case, "model.constraints-homogeneous", "proved");
        expect(n.case, "model.constraints-scleronomic", "refuted");
        let (word, detail) = n.case.verdict("formulation.equivalent#jacobi");
        assert_eq!(word, "not-applicable");
        assert!(detail.contains("scleronomic"), "{detail}");
    });
}

/// A regular Hessian is neither enough for unique accelerations nor needed: the condition is that of the bordered matrix.
#[test]
fn rumyantsev_regular_hessian_is_not_the_condition() {
    let line = |lagrangian: &str, constraint: &str| {
        Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = {{ L = \"{lagrangian}\" }}\nconstraints = {{ c = \"{constraint}\" }}\n"
        ))
    };
    let light = line("1/2 (x'^2 - y'^2)", "x' = y'");
    expect(&light, "model.hessian-regular", "proved");
    expect(&light, "model.accelerations-unique", "refuted");
    let singular = line("1/2 x'^2", "y' = x x'");
    expect(&singular, "model.hessian-regular", "refuted");
    expect(&singular, "model.accelerations-unique", "proved");
    expect(&singular, "formulation.equivalent#maggi", "proved");
}

/// The Hessian of the restricted Lagrangian is not the restricted Hessian: equal for S4, different for S3; the isokinetic
/// particle has Hess L̄ = 0 and W̄ = m c²/(c² - x'²).
#[test]
fn rumyantsev_restricted_hessians_differ() {
    let hessian = |n: &OnManifold<'_>| -> Vec<Vec<Expr>> {
        n.terms.momenta.iter().map(|&p| n.by_speeds(p)).collect()
    };
    on_manifold(PARTICLE, Chart::Natural, |n| {
        for (a, b) in hessian(n).concat().into_iter().zip(n.mass.concat()) {
            n.vanishes(n.sub(a, b));
        }
    });
    let text = format!("{APPELL_HAMEL}velocities = {{ independent = [\"x'\", \"y'\"] }}\n");
    on_manifold(&text, Chart::Natural, |n| {
        n.equal(hessian(n)[0][0], "m (1 + a^2)");
        n.equal(n.mass[0][0], "m (1 + a^2) - m a^2 y'^2/(x'^2 + y'^2)");
        n.fails(n.sub(hessian(n)[0][0], n.mass[0][0]));
    });
    let isokinetic = r#"
coordinates = ["x", "y"]
parameters = { m = {}, c = {} }
assumptions = ["m > 0", "c > 0"]
lagrangian = { T = "1/2 m (x'^2 + y'^2)", V = "x^2 y" }
constraints = { speed = "y' = sqrt(c^2 - x'^2)" }
"#;
    on_manifold(isokinetic, Chart::Natural, |n| {
        n.vanishes(hessian(n)[0][0]);
        n.equal(n.mass[0][0], "m c^2/(c^2 - x'^2)");
        expect(
            n.case,
            "formulation.equivalent#canonical-reduced",
            "not-applicable",
        );
        expect(n.case, "formulation.equivalent#canonical", "proved");
    });
}

/// Rumyantsev's survey: for the same virtual displacement (a, b, y a) the integrands of Hölder, Voronets and Suslov are one
/// function on f = 0, each with its own rule for δv; no total derivative is between them. Without the curvature they differ (S4).
#[test]
fn rumyantsev_three_integrands_are_one() {
    let case = Case::new(&format!(
        "{PARTICLE}velocities = {{ independent = [\"x'\", \"y'\"] }}\n"
    ));
    let g = &case.system.graph;
    let equations = case.equations("voronets");
    let object = |name: &str| case.object(&equations, name);
    let curvature = g.add(&[
        g.mul(&[object("theta_z"), object("A_z_x"), case.read("a")]),
        g.mul(&[object("theta_z"), object("A_z_y"), case.read("b")]),
    ]);
    let of_hoelder = case.read("x' a' + y' b' + z' (y' a + y a')");
    let of_suslov = case.read("x' a' + y' b' + z' (x' b + y a')");
    let of_voronets = case.read("(1 + y^2) x' a' + y' b' + y x'^2 b + y x' (y' a - x' b)");
    assert!(case.equal_on_constraints(of_hoelder, g.add(&[of_suslov, curvature])));
    assert!(case.equal_on_constraints(of_hoelder, of_voronets));
    expect_different(&case, of_hoelder, of_suslov);
}

/// Qiao: a holonomic F(ξ) = 0 differentiated once is Σ ∂F/∂ξ_i ξ_i' = 0; with the printed coefficients ∂F/∂ξ_i' nothing is left
/// of it.
#[test]
fn qiao_differentiated_holonomic_constraint() {
    let case =
        Case::new("coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"1/2 (x'^2 + y'^2)\" }\n");
    let (g, system) = (&case.system.graph, &case.system);
    let thread = case.read("1/2 (x^2 + y^2 - 4)");
    let (q, v) = (system.coordinate_symbols(), system.velocity_symbols());
    let rate = system.total_derivative(thread);
    let linear = |symbols| {
        let slopes = g.gradient(thread, symbols);
        let parts = slopes.iter().zip(&system.coordinates);
        let parts: Vec<Expr> = parts.map(|(&a, c)| g.mul(&[a, c.v])).collect();
        g.add(&parts)
    };
    assert!(case.equal(rate, linear(&q)));
    expect_different(&case, rate, linear(&v));
}
