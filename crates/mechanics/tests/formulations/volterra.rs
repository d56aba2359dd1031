//! Volterra's equations in generalized coordinates (theory 2 §§3–4 with m = 1).

use crate::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::voronets::CUBIC;

/// The kinematics of example E8 for m = 1, with a metric that depends on q and t, and constant mass.
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

/// Without constraints and with P = v, both forms are Lagrange's left sides (theory 2 §4, end of the special cases).
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
