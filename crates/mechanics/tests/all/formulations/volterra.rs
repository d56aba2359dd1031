//! Volterra's equations in generalized coordinates (T2 §§3–4 with m = 1).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::voronets::CUBIC;

/// Example E8 for m = 1 with constant mass: a metric that depends on q and t, and q1' = P q2 + t, q2' = P² + q1.
const E8: &str = r#"
coordinates = ["q1", "q2"]
parameters = { mu = {} }
assumptions = ["mu > 0", "q2 > 0"]
lagrangian = { T = "1/2 mu (q1'^2 + (q1^2 + t) q2'^2 + q2 q1' q2')" }
constraints = { c = "q2' = ((q1' - t)/q2)^2 + q1" }
[quasi_velocities]
P = "(q1' - t)/q2"
"#;

/// An affine constraint with time, a metric that depends on q and t, a potential and forces that depend on the time.
const MOVING_METRIC: &str = r#"
coordinates = ["x", "y"]
parameters = { mu = {} }
assumptions = ["mu > 0"]
lagrangian = { T = "1/2 mu ((1 + t^2 + y^2) x'^2 + 2 x y x' y' + (2 + x^2 + x^2 y^2) y'^2)", V = "x y t" }
forces = { x = "-x' y", y = "t" }
constraints = { c = "y' = t x + y x'" }
"#;

#[test]
fn both_forms_are_equivalent_to_routh() {
    for text in [
        SKATE,
        DISC,
        APPELL_HAMEL,
        PARTICLE,
        POLAR,
        CUBIC,
        MOVING_METRIC,
        E8,
    ] {
        let case = Case::new(text);
        for form in ["first", "second"] {
            expect(
                &case,
                &format!("formulation.equivalent#volterra-{form}"),
                "proved",
            );
        }
    }
}

/// Volterra minus Maggi vanishes before any equation of motion is used, and so do the lemmas (3.16) and (3.26): also in
/// moving frames, for implicit constraints, and for a Lagrangian that is not quadratic.
#[test]
fn both_forms_are_maggi_identically() {
    let adapted =
        format!("{SKATE}[quasi_velocities]\nu = \"x' cos(phi) + y' sin(phi)\"\nw = \"phi' + t\"\n");
    let quartic = PARTICLE.replace("x'^2 + y'^2", "x'^4 + y'^2 x'^2 + y'^2");
    let texts = [
        SKATE,
        DISC,
        APPELL_HAMEL,
        POLAR,
        CUBIC,
        MOVING_METRIC,
        E8,
        &adapted,
        &quartic,
    ];
    for text in texts {
        let case = Case::new(text);
        for form in ["first", "second"] {
            expect(
                &case,
                &format!("formulation.identity#volterra-{form}"),
                "proved",
            );
        }
    }
}

/// The intermediate objects on S4 with P = x', y': T̃ = ((1 + y²) x'² + y'²)/2.
#[test]
fn the_particle_of_the_notes() {
    let case = Case::new(&format!(
        "{PARTICLE}velocities = {{ independent = [\"x'\", \"y'\"] }}\n"
    ));
    let equations = case.equations("volterra-second");
    let expected = [
        ("Ttilde", "((1 + y^2) x'^2 + y'^2)/2"),
        ("p_z", "y x'"),
        ("B_z_x", "y"),
    ];
    for (name, text) in expected {
        assert!(
            case.equal(case.object(&equations, name), case.read(text)),
            "{name}"
        );
    }
    let left = equations.groups[0].equations[0].left;
    assert!(case.equal(left, case.read("(1 + y^2) x'' + y x' y'")));
}

/// Without constraints and with P = v, both forms are Lagrange's left sides (T2 §4, end of the special cases).
#[test]
fn without_constraints_they_are_lagrange() {
    let case = Case::new(POLAR);
    for form in ["volterra-first", "volterra-second"] {
        let equations = case.equations(form);
        let motion = &equations.groups[0].equations;
        for (equation, text) in motion
            .iter()
            .zip(["m r'' - m r theta'^2", "m r^2 theta'' + 2 m r r' theta'"])
        {
            let difference = case.system.graph.sub(equation.left, equation.right);
            assert!(case.equal(difference, case.read(text)), "{form}: {text}");
        }
    }
}

/// The first form copied from Cartesian coordinates into a curved chart, `D ∂T̃/∂P - Σ p D B`, is not Maggi's left side: the
/// defect is Σ ∂T/∂q^s B_s, for E8 `μ q1 q2 v2² + μ P v1 v2`.
#[test]
fn the_shortened_formula_is_refuted() {
    let case = Case::new(E8);
    let cx = case.context();
    let g = &case.system.graph;
    let c = chetaev_mechanics::claims::formulation::basis(&cx)
        .characteristics()
        .unwrap();
    assert_eq!(c.parameters[0].name, "P");
    let slopes = g.gradient(case.system.lagrangian, &case.system.coordinate_symbols());
    let lost = c.contract(&case.system, &c.restrict(&case.system, &slopes))[0];
    let first = case.equations("volterra-first").groups[0].equations[0].left;
    let maggi = case.equations("maggi").groups[0].equations[0].left;
    let shortened = g.add(&[first, lost]);
    let residual = |e| cx.prover.identity(&case.system, &[e], &c.manifold, "");
    assert_eq!(residual(g.sub(first, maggi)).word(), "proved");
    assert_eq!(residual(g.sub(shortened, maggi)).word(), "refuted");
    let defect = case.read("mu q1 q2 q2'^2 + mu P (P q2 + t) q2'");
    let defect = c.restrict(&case.system, &[defect])[0];
    let difference = g.add(&[shortened, g.neg(maggi), g.neg(defect)]);
    assert_eq!(residual(difference).word(), "proved");
}

/// Where the model does not state T and V apart, or V contains velocities, the Lagrangian stands in their place.
#[test]
fn forces_and_kinetic_energy() {
    let apart = Case::new(SKATE);
    let equations = apart.equations("volterra-first");
    let names: Vec<&str> = equations.objects.iter().map(|o| o.name.as_str()).collect();
    assert!(names.iter().any(|n| n.starts_with("Etilde_")), "{names:?}");
    let whole = SKATE
        .replace("T = ", "L = ")
        .replace(", V = \"-m G x\"", "")
        .replace("phi'^2\"", "phi'^2 + m G x\"");
    let whole = Case::new(&whole);
    let objects = whole.equations("volterra-first").objects;
    assert!(objects[0].meaning.starts_with("Lagrangian"));
    let magnetic =
        "lagrangian = { T = \"1/2 (x'^2 + y'^2)\", V = \"x y'\" }\ncoordinates = [\"x\", \"y\"]\n";
    let magnetic = Case::new(magnetic);
    assert!(magnetic.equations("volterra-first").objects[0]
        .meaning
        .starts_with("Lagrangian"));
    expect(&magnetic, "formulation.equivalent#volterra-first", "proved");
}
