//! Gauss's principle, and Udwadia's and Kalaba's formula (T1 §9.4).

use crate::formulations::common::{expect, Case, APPELL_HAMEL, DISC, PARTICLE, POLAR, SKATE};
use crate::formulations::nielsen::expect_different;
use crate::formulations::voronets::CUBIC;

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
    let least = case.object(&equations, "Z_motion");
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

/// A body about two turning axes with a product of inertia: in the angular velocities the matrix is [[A, D], [D, B]], so
/// that A B > D² decides, whatever the angles. In the velocities of the angles its entries are trigonometric.
const BODY: &str = r#"
coordinates = ["al", "be"]
parameters = { A = 3, B = 2, D = 1 }
define = { w1 = "al' cos(be) - be' sin(al)", w2 = "al' sin(be) + be' cos(al)" }
lagrangian = { T = "1/2 (A w1^2 + B w2^2) + D w1 w2" }
"#;

#[test]
fn moments_of_inertia_decide_for_angular_velocities() {
    let stated = format!("assumptions = [\"A > 0\", \"A B > D^2\"]\n{BODY}");
    let (word, detail) = Case::new(&stated).verdict(LEAST);
    assert_eq!(word, "proved", "{detail}");
    assert!(!detail.contains("values of the parameters"), "{detail}");
    let (word, detail) = Case::new(BODY).verdict(LEAST);
    assert_eq!(word, "proved", "{detail}");
    assert!(detail.contains("values of the parameters"), "{detail}");
    // D² = 9 > 6: negative along w1 = -w2, say.
    let impossible = BODY.replace("D = 1", "D = 3");
    expect(&Case::new(&impossible), LEAST, "refuted");
    // The order of the assumptions' sides is no matter; the sign of a moment is.
    let negative = BODY.replace("A = 3, B = 2", "A = -3, B = -2");
    expect(&Case::new(&negative), LEAST, "refuted");
}

/// -m c² √(1 - v²/c²) is convex for m > 0: W = γ m (1 + γ² v vᵀ/c²). With m < 0 it is concave.
#[test]
fn a_fast_particle_has_a_positive_mass_matrix() {
    let fast = "coordinates = [\"x\", \"y\", \"z\"]\nparameters = { m = {}, c = {}, F = {} }\n\
        lagrangian = { L = \"-m c^2 sqrt(1 - (x'^2 + y'^2 + z'^2)/c^2) + F y\" }\n\
        constraints = { rolling = \"z' = y x'\" }\n";
    let heavy = format!("assumptions = [\"m > 0\", \"c > 0\"]\n{fast}");
    expect(&Case::new(&heavy), LEAST, "proved");
    let negative = format!("assumptions = [\"m < 0\", \"c > 0\"]\n{fast}");
    let (word, detail) = Case::new(&negative).verdict(LEAST);
    assert_ne!(word, "proved", "{detail}");
    // φ'' < 0: √(1 + v²) is convex all the same, which this rule does not see; v⁴ - 2 v² is not.
    let dented = "coordinates = [\"x\", \"y\"]\nlagrangian = { L = \"(x'^2 + y'^2)^2 - 2 (x'^2 + y'^2)\" }\n";
    let (word, detail) = Case::new(dented).verdict(LEAST);
    assert_ne!(word, "proved", "{detail}");
}
