//! Gauss's principle, and Udwadia's and Kalaba's formula (theory 1 §9.4).

use crate::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::nielsen::expect_different;
use crate::voronets::CUBIC;

const CLAIM: &str = "formulation.equivalent#gauss";
const LEAST: &str = "formulation.gauss-least";

/// An indefinite mass matrix: the motion makes Z a maximum on the constraint.
const INDEFINITE: &str = r#"
coordinates = ["x", "y"]
lagrangian = { L = "1/2 (x'^2 - y'^2) - x^4" }
constraints = { c = "y' = 2 x'" }
"#;

/// A singular mass matrix made regular by the constraint.
const SINGULAR: &str = r#"
coordinates = ["x", "y"]
lagrangian = { L = "1/2 x'^2 - y^2" }
constraints = { c = "y' = x x'" }
"#;

#[test]
fn it_is_equivalent_to_routh() {
    for text in [
        SKATE,
        DISC,
        APPELL_HAMEL,
        PARTICLE,
        POLAR,
        CUBIC,
        INDEFINITE,
        SINGULAR,
    ] {
        expect(&Case::new(text), CLAIM, "proved");
    }
}

/// The multipliers are Routh's, in both branches.
#[test]
fn the_multipliers_are_those_of_routh() {
    for text in [SKATE, DISC, APPELL_HAMEL, SINGULAR] {
        let case = Case::new(text);
        let (gauss, routh) = (case.equations("gauss"), case.equations("routh"));
        assert_eq!(gauss.multipliers.len(), routh.multipliers.len());
        for ((l, a), (m, b)) in gauss.multipliers.iter().zip(&routh.multipliers) {
            assert!(l == m && case.equal_on_constraints(*a, *b), "{text}");
        }
    }
}

/// S4: α = 0, and the least value is (x'y')²/(2 (1 + y²)).
#[test]
fn the_particle_of_the_notes() {
    let case = Case::new(PARTICLE);
    let equations = case.equations("gauss");
    assert!(case.equal(case.object(&equations, "alpha_x"), case.read("0")));
    let z = case.object(&equations, "Z");
    assert!(case.equal(z, case.read("(x''^2 + y''^2 + z''^2)/2")));
    let least = case.object(&equations, "Zmotion");
    let expected = case.read("(x' y')^2/(2 (1 + y^2))");
    assert!(case.equal_on_constraints(least, expected));
    // It is Z at the accelerations of the motion.
    let g = &case.system.graph;
    let motion: Vec<_> = case
        .system
        .coordinates
        .iter()
        .zip(&equations.accelerations)
        .map(|(c, &a)| (c.a, a))
        .collect();
    assert!(case.equal_on_constraints(g.substitute(z, &motion), expected));
    expect_different(&case, equations.accelerations[0], g.zero());
}

#[test]
fn positive_masses_make_it_least() {
    for text in [SKATE, DISC, APPELL_HAMEL, PARTICLE, POLAR, CUBIC, SINGULAR] {
        expect(&Case::new(text), LEAST, "proved");
    }
    // A form that is no sum of squares as stated: x'² + x'y' + y'², positive by its pivots.
    let mixed = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"x'^2 + x' y' + y'^2\" }\n";
    expect(&Case::new(mixed), LEAST, "proved");
}

/// Where the sign depends on parameters, assumptions decide, else their values in the model.
#[test]
fn parameters_decide() {
    let coupled = "coordinates = [\"x\", \"y\"]\nparameters = { a = {}, b = {} }\n\
        lagrangian = { T = \"1/2 a x'^2 + b x' y' + 1/2 b y'^2\" }\n";
    let bounded = format!("{coupled}assumptions = [\"b > 0\", \"b < a\"]\n");
    expect(&Case::new(&bounded), LEAST, "proved");
    let valued = coupled.replace("a = {}, b = {}", "a = 3, b = 2");
    let (word, detail) = Case::new(&valued).verdict(LEAST);
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("values of the parameters"), "{detail}");
    let reversed = coupled.replace("a = {}, b = {}", "a = 2, b = 3");
    expect(&Case::new(&reversed), LEAST, "refuted");
}

/// Z restricted has the second derivative 1 - 4 = -3, and the equation is still -3 x'' = -V'(x).
#[test]
fn an_indefinite_mass_matrix_makes_it_stationary_only() {
    let case = Case::new(INDEFINITE);
    expect(&case, LEAST, "refuted");
    let acceleration = case.equations("gauss").accelerations[0];
    assert!(case.equal_on_constraints(acceleration, case.read("4 x^3/3")));
    let finding = case.finding(LEAST);
    assert_eq!(
        finding.formulas.len(),
        2,
        "a component of the direction for each coordinate"
    );
    let hyperbolic = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"x' y'\" }\n";
    expect(&Case::new(hyperbolic), LEAST, "refuted");
    // Positive for some states, negative for others.
    let varying = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"1/2 x x'^2 + 1/2 y'^2\" }\n";
    expect(&Case::new(varying), LEAST, "refuted");
}
