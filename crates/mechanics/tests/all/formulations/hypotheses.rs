//! Hypotheses of single formulations as claims of their own.

use crate::formulations::common::{expect, Case, APPELL_HAMEL, PARTICLE, POLAR};

fn line(lagrangian: &str) -> Case {
    Case::new(&format!(
        "coordinates = [\"x\"]\nparameters = {{ m = {{}}, c = {{}} }}\nlagrangian = {{ L = \"{lagrangian}\" }}"
    ))
}

#[test]
fn forces() {
    expect(&Case::new(PARTICLE), "model.forces-absent", "proved");
    let cancelling = "forces = { x = \"sin(y)^2 + cos(y)^2 - 1\" }\n";
    let case = Case::new(&format!("{PARTICLE}{cancelling}"));
    expect(&case, "model.forces-absent", "proved");
    let case = Case::new(&format!("{PARTICLE}forces = {{ x = \"-y'\" }}\n"));
    expect(&case, "model.forces-absent", "refuted");
}

#[test]
fn explicit_time() {
    expect(&line("1/2 m x'^2"), "model.lagrangian-autonomous", "proved");
    expect(
        &line("1/2 m x'^2 - t x"),
        "model.lagrangian-autonomous",
        "refuted",
    );
}

/// A magnetic field is odd in the velocities; how the same function is written makes no difference.
#[test]
fn even_lagrangians() {
    for lagrangian in [
        "1/2 m x'^2 - x^4",
        "(x' + x)^2 - 2 x x'",
        "abs(x')",
        "x'^3/x'",
    ] {
        expect(&line(lagrangian), "model.lagrangian-even", "proved");
    }
    for lagrangian in ["1/2 m x'^2 + x x'", "x'^3", "x' abs(x')"] {
        expect(&line(lagrangian), "model.lagrangian-even", "refuted");
    }
}

/// Degree two in the velocities, however it is written; a corner is not quadratic although its second derivative vanishes.
#[test]
fn quadratic_lagrangians() {
    for lagrangian in [
        "1/2 m x'^2 + x x' - x^4",
        "(x'^2 - x^2)^2/(x'^2 - x^2)",
        "x'",
    ] {
        expect(&line(lagrangian), "model.lagrangian-quadratic", "proved");
    }
    for lagrangian in [
        "x'^3",
        "1/2 m x'^2 + abs(x')",
        "sqrt(1 + x'^2)",
        "x' abs(x')",
    ] {
        expect(&line(lagrangian), "model.lagrangian-quadratic", "refuted");
    }
    expect(&Case::new(POLAR), "model.lagrangian-quadratic", "proved");
}

/// R4 is not R2: the quadric x'² + y'² = c², and a Lagrangian that is singular on the constraint only.
#[test]
fn restricted_hessians() {
    for text in [PARTICLE, APPELL_HAMEL, POLAR] {
        expect(
            &Case::new(text),
            "model.restricted-hessian-regular",
            "proved",
        );
    }
    let degenerate = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"1/2 (x'^2 - y'^2)\" }\nconstraints = { c = \"x' = y'\" }";
    expect(
        &Case::new(degenerate),
        "model.restricted-hessian-regular",
        "refuted",
    );
}

/// cosh of a velocity that a nonlinear constraint determines: prime fields do not know whether it is related to the others,
/// a real point at which the determinant is not zero does.
#[test]
fn regular_with_exponentials_of_dependent_velocities() {
    let text = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"1/2 (x'^2 + y'^2) + cosh(x') + cosh(y')\" }\n\
                constraints = { c = \"y'^2 = (2 + x^2) (x'^2 + 1)\" }";
    expect(&Case::new(text), "model.accelerations-unique", "proved");
}

/// L̄ = y'/2 has no momentum by y', and L̄ = x'²/2 has one by x': whichever of them the constraint is usually solved for.
#[test]
fn restricted_hessians_by_other_velocities() {
    for (lagrangian, constraint) in [
        ("1/2 (1 + x^2) x'^2 - y", "y' = (2 + sin(y)) x'^2"),
        ("1/2 (1 + y^2) y'^2 - x", "x' = (2 + sin(x)) y'^2"),
        (
            "1/2 (1 + x^2) x'^2 - y",
            "(2 + sin(y)) x'^2 - 4 x' - y' = 0",
        ),
        ("1/2 (x' - y')^2 - y", "x' + y' = (2 + y^2) (x' - y')^2"),
    ] {
        for wanted in ["x", "y"] {
            let case = Case::new(&format!(
                "coordinates = [\"x\", \"y\"]\nvelocities = {{ independent = [\"{wanted}'\"] }}\nlagrangian = {{ L = \"{lagrangian}\" }}\nconstraints = {{ c = \"{constraint}\" }}"
            ));
            expect(&case, "model.restricted-hessian-regular", "proved");
            expect(&case, "formulation.equivalent#canonical-reduced", "proved");
        }
    }
}

/// R5 where L alone is singular in every direction: the curvature of the constraint makes the problem regular.
#[test]
fn constrained_extrema() {
    let text = |constraint: &str| {
        format!("coordinates = [\"x\", \"y\"]\nlagrangian = {{ L = \"y\" }}\nconstraints = {{ c = \"{constraint}\" }}")
    };
    let curved = Case::new(&text("y' = x'^2"));
    expect(&curved, "model.constrained-extremum-regular", "proved");
    expect(&curved, "model.accelerations-unique", "refuted");
    let flat = Case::new(&text("y' = x x'"));
    expect(&flat, "model.constrained-extremum-regular", "refuted");
}

/// A mass whose stated value is zero: W = diag(m, m, M) is singular for this system, whatever it is for others. Bordered by
/// the constraint it is regular all the same.
#[test]
fn a_mass_that_is_zero_as_stated() {
    let text = |mass: &str| {
        format!(
            "coordinates = [\"x\", \"y\", \"z\"]\nparameters = {{ m = 2, M = {mass} }}\n\
             lagrangian = {{ T = \"m/2 (x'^2 + y'^2) + M/2 z'^2\", V = \"x + z\" }}\n\
             constraints = {{ a = \"z' = y x'\" }}\n"
        )
    };
    for mass in ["0", "1", "{}"] {
        let case = Case::new(&text(mass));
        let regular = if mass == "0" { "refuted" } else { "proved" };
        expect(&case, "model.hessian-regular", regular);
        expect(&case, "model.accelerations-unique", "proved");
        let applies = if mass == "0" {
            "not-applicable"
        } else {
            "proved"
        };
        expect(&case, "formulation.equivalent#canonical", applies);
        // Gauss's function then has no α; it is stationary without it.
        expect(&case, "formulation.equivalent#gauss", "proved");
        let gauss = case.equations("gauss");
        let has_free = gauss.objects.iter().any(|o| o.name.starts_with("alpha"));
        assert_eq!(has_free, mass != "0");
    }
}

/// F = ½ vᵀ W v on the admissible velocities: positive, nowhere positive, of both signs.
#[test]
fn jacobis_metric_has_a_sign() {
    let plane = |lagrangian: &str, constraint: &str| {
        Case::new(&format!(
            "coordinates = [\"x\", \"y\"]\nlagrangian = {{ L = \"{lagrangian}\" }}\nconstraints = {{ c = \"{constraint}\" }}\n"
        ))
    };
    let claim = "model.metric-positive";
    let jacobi = "formulation.equivalent#jacobi";
    // ½ (1 - 4) x'², ½ (1 - ¼) x'²: the constraint decides.
    let below = plane("(x'^2 - y'^2)/2 - x^2", "y' = 2 x'");
    expect(&below, claim, "refuted");
    expect(&below, jacobi, "not-applicable");
    let above = plane("(x'^2 - y'^2)/2 - x^2", "y' = x'/2");
    expect(&above, claim, "proved");
    expect(&above, jacobi, "proved");
    // Without assumptions the values of the parameters decide.
    let valued = |mass: &str| {
        Case::new(&format!(
            "coordinates = [\"x\"]\nparameters = {{ m = {mass} }}\nlagrangian = {{ T = \"m x'^2/2\", V = \"x\" }}\n"
        ))
    };
    expect(&valued("2"), claim, "proved");
    expect(&valued("{}"), claim, "conditional");
    // ½ (1 - x²) x'².
    let both = plane("(x'^2 - y'^2)/2", "y' = x x'");
    expect(&both, claim, "conditional");
    expect(&both, jacobi, "proved");
}

/// Forms with products of velocities, by Sylvester's criterion: `x'² - x'y' + y'²` has the minors 2 and 3, with `y'z' + 2 z'²` beside it
/// the determinant 10; with `z'² - 3 x'z'` in its place the form is negative at (1, 0, 1). On `z' = (x' + y')/4` the form
/// `x'² - x'y' + 3 y'² - z'²` of both signs has the matrix `(15 -9; -9 47)/8`.
#[test]
fn forms_with_products_are_decided_by_minors() {
    let space = |lagrangian: &str, more: &str| {
        Case::new(&format!(
            "coordinates = [\"x\", \"y\", \"z\"]\nparameters = {{ a = 1, b = 3 }}\nlagrangian = \"{lagrangian}\"\n{more}"
        ))
    };
    let tied = "constraints = { c = \"z' = (x' + y')/4\" }\n";
    for (lagrangian, more, word) in [
        ("x'^2 - x' y' + y'^2 + y' z' + 2 z'^2", "", "proved"),
        (
            "x'^2 - x' y' + y'^2 + y' z' + z'^2 - 3 x' z'",
            "",
            "conditional",
        ),
        ("(1 + y^2) (x'^2 - x' y' + y'^2 + z'^2)", "", "proved"),
        ("a x'^2 - a x' y' + b y'^2 - z'^2", tied, "proved"),
        ("a x'^2 - a x' y' + b y'^2 - z'^2", "", "conditional"),
    ] {
        let (found, detail) = space(lagrangian, more).verdict("model.metric-positive");
        assert_eq!(found, word, "{lagrangian}: {detail}");
        assert_eq!(detail.contains("Sylvester"), word == "proved", "{detail}");
    }
}

/// W is diag(1, −1): on y' = x' the bordered determinant vanishes, on y' = 2 x' it is 3. The accelerations are unique there.
#[test]
fn a_matrix_that_is_singular_on_one_component_is_not_singular_on_all() {
    let case = Case::new(
        r#"
coordinates = ["x", "y"]
lagrangian = "(x'^2 - y'^2)/2 - x^2"
constraints = { a = "(y' - x') (y' - 2 x') = 0" }
"#,
    );
    expect(&case, "model.accelerations-unique", "conditional");
    let (word, detail) = case.verdict("formulation.equivalent#maggi");
    assert_ne!(word, "not-applicable", "{detail}");
    let one = Case::new(
        r#"
coordinates = ["x", "y"]
lagrangian = "(x'^2 - y'^2)/2 - x^2"
constraints = { a = "y' = x'" }
"#,
    );
    expect(&one, "model.accelerations-unique", "refuted");
}

/// F = ½ (m − k cos²x/4) x'² takes both signs for general m and k; for m = 2 and k = 1 it is nowhere negative, and nobody
/// knows an inequality to prove it by.
#[test]
fn stated_values_decide_the_sign_of_the_metric() {
    let text = r#"
coordinates = ["x", "y"]
parameters = { m = 2, k = 1 }
lagrangian = "1/2 m x'^2 - 1/2 k y'^2"
constraints = { a = "y' = x' cos(x)/2" }
"#;
    let of = |text: &str| Case::new(text).verdict("model.metric-positive");
    let (word, detail) = of(text);
    assert!(["numerical", "proved"].contains(&word), "{word}: {detail}");
    assert!(
        detail.contains("for the values of the parameters"),
        "{detail}"
    );
    let (word, detail) = of(&text.replace("k = 1", "k = 100"));
    assert_eq!(word, "conditional", "{detail}");
}
