//! Integrals on parts of the states: on components of constraints that are products, on positions that satisfy holonomic
//! constraints, and where the model says so. Expected values are worked out by hand beside each case.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use crate::common::{expr, finding, system};
use chetaev_mechanics::system::{Assumption, Parameter, Relation};
use chetaev_mechanics::System;
use chetaev_symbolic::Verdict;

/// The system with integrals that it states, as `(value, conditions)`, named by their places.
fn stating(mut system: System, integrals: &[(&str, &[&str])]) -> System {
    let g = system.graph.clone();
    for (place, (value, conditions)) in integrals.iter().enumerate() {
        system.integrals.push((place.to_string(), expr(&g, value)));
        for text in *conditions {
            let (left, right) = text.split_once('=').expect("an equation");
            system.integral_conditions.push((
                place.to_string(),
                expr(&g, left),
                expr(&g, right),
                (*text).to_owned(),
            ));
        }
    }
    system
}

fn word(system: &System, full: &str) -> (&'static str, String) {
    let finding = finding(system, full);
    let condition = match &finding.verdict {
        Verdict::Conditional { condition, .. } => condition.clone(),
        Verdict::Refuted(found) => found
            .point
            .iter()
            .map(|p| format!("{} = {:?} {:?}; ", p.name, p.exact, p.enclosure))
            .collect(),
        other => other.detail().to_owned(),
    };
    (finding.verdict.word(), condition)
}

/// What is expected of each stated integral.
fn expect(system: &System, words: &[&str]) {
    for (place, expected) in words.iter().enumerate() {
        let (found, why) = word(system, &format!("noether.inverse#{place}"));
        assert_eq!(&found, expected, "integral {place}: {why}");
    }
}

/// `(z' - x')(z' - y') = 0`: z - y is kept where the second factor vanishes, z - x where the first does, and on both the reaction
/// has no part in the direction of the momentum of the velocity that does not occur in the factor.
#[test]
fn products_have_two_components() {
    let own = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - z",
        &[("f", "(z' - x')*(z' - y')")],
    );
    let own = stating(
        own,
        &[("z - y", &[]), ("z - x", &[]), ("x'", &[]), ("y'", &[])],
    );
    expect(
        &own,
        &["conditional", "conditional", "conditional", "conditional"],
    );
    for (place, factor) in ["y'", "x'", "y'", "x'"].iter().enumerate() {
        let (_, condition) = word(&own, &format!("noether.inverse#{place}"));
        assert!(
            condition.contains(factor) && condition.contains("z'"),
            "integral {place}: {condition}"
        );
    }
}

/// `(z' - y x')(y' - 1) = 0` has no velocity that occurs in both factors: what is said holds on one component, which is named.
#[test]
fn a_chart_of_one_component_speaks_of_it_alone() {
    let own = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2",
        &[("f", "(z' - y*x')*(y' - 1)")],
    );
    let own = stating(own, &[("y'", &[]), ("z - z", &[])]);
    let (found, condition) = word(&own, "noether.inverse#0");
    assert_eq!(found, "conditional", "{condition}");
    let named = condition.contains("= 0") && (condition.contains("y'") || condition.contains("z'"));
    assert!(named, "{condition}");
    let family = finding(&own, "noether.family");
    assert_eq!(family.verdict.word(), "conditional");
}

/// A pendulum in the plane: its moment of momentum is x y' - y x' on x² + y² = 1, with the square 2 (E - y).
#[test]
fn positions_satisfy_holonomic_constraints() {
    let own = system("x y", "(x'^2 + y'^2)/2 - y", &[("f", "x^2 + y^2 - 1")]);
    let values: &[(&str, &[&str])] = &[
        ("(x*y' - y*x')^2/2 + y", &[]),
        ("x'^2/y^2/2 + y", &[]),
        // Off by the square of the radius; on the circle the energy with another sign of y.
        ("(x*y' - y*x')^2/2 - y", &[]),
    ];
    let own = stating(own, values);
    expect(&own, &["proved", "proved", "refuted"]);
}

/// On the parabola the energy can be written with y for x²; on y = t² the function √y - t vanishes or is 2 |t|.
#[test]
fn holonomic_constraints_replace_coordinates() {
    let own = system("x y", "(x'^2 + y'^2)/2", &[("f", "y - x^2")]);
    let own = stating(own, &[("x'^2*(1 + 4*y)", &[]), ("x'^2*(1 + 2*y)", &[])]);
    expect(&own, &["proved", "refuted"]);
    let own = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2",
        &[("a", "z' - y*x'"), ("b", "y - 1")],
    );
    let own = stating(own, &[("z - x", &[]), ("z - 2*x", &[])]);
    expect(&own, &["proved", "refuted"]);
}

/// `x² = y²` are two lines: y - x is kept on one of them, x + y on the other.
#[test]
fn holonomic_products_have_components() {
    let own = system("x y", "(x'^2 + y'^2)/2 - x - y", &[("f", "x^2 - y^2")]);
    let own = stating(own, &[("y - x", &[]), ("x + y", &[])]);
    expect(&own, &["conditional", "conditional"]);
}

/// A blade along x' : y' = cos φ : sin φ, which stands across the slope at φ = π/2 and does not turn: x is kept, as x' = 0 there.
#[test]
fn constraints_are_solved_anew_on_a_part() {
    let blade = || {
        system(
            "x y phi",
            "(x'^2 + y'^2 + phi'^2)/2 + g*x",
            &[("b", "y'*cos(phi) - x'*sin(phi)")],
        )
    };
    let values: &[(&str, &[&str])] = &[
        ("x", &["phi = pi/2", "phi' = 0"]),
        ("y", &["phi = 0", "phi' = 0"]),
        ("y'", &["phi = pi/2", "phi' = 0"]),
        // Down the slope the blade is accelerated.
        ("x'", &["phi = 0", "phi' = 0"]),
        // φ is no constant for other rates of turning.
        ("x", &["phi = pi/2"]),
        // No state: the blade forbids y' = 1 at φ = 0, and φ has one value.
        ("x", &["x' = 0", "y' = 1", "phi = 0"]),
        ("x'", &["phi = 1", "phi = 2"]),
    ];
    expect(
        &stating(blade(), values),
        &[
            "conditional",
            "conditional",
            "conditional",
            "refuted",
            "refuted",
            "not-applicable",
            "not-applicable",
        ],
    );
    // On x = x' = 0 of a circle about the origin nothing moves, but where the constraint is singular.
    let circle = system("x y", "(x'^2 + y'^2)/2", &[("f", "x*x' + y*y'")]);
    let part: &[&str] = &["x = 0", "x' = 0"];
    let circle = stating(circle, &[("y", part), ("y'", part), ("y", &["x = 0"])]);
    expect(&circle, &["conditional", "conditional", "refuted"]);
}

/// `y' = x' tan φ` says nothing at φ = π/2: no state there is admissible, and none may refute.
#[test]
fn constraints_that_are_not_defined_refute_nothing() {
    let blade = system(
        "x y phi",
        "(x'^2 + y'^2 + phi'^2)/2",
        &[("b", "y' - x'*tan(phi)")],
    );
    let blade = stating(blade, &[("x", &["phi = pi/2", "phi' = 0"])]);
    expect(&blade, &["undecided"]);
}

/// Two springs and a coupling: `d/dt (x y' - y x') = (a - b) x y + c (y² - x²)`; the integral of frequencies 1 : 2 is one
/// where b = 4 a and c = 0. The condition names no values where a ratio suffices.
#[test]
fn conditions_are_ratios_where_these_suffice() {
    let conditions = |b: &str, integral: &str| {
        let lagrangian = "(x'^2 + y'^2 - a*x^2 - b*y^2)/2 - c*x*y";
        let mut own = stating(system("x y", lagrangian, &[]), &[(integral, &[])]);
        let g = own.graph.clone();
        for (name, value) in [("a", "1"), ("b", b), ("c", "0")] {
            own.parameters.push(Parameter {
                name: name.into(),
                expr: expr(&g, name),
                value: Some(expr(&g, value)),
            });
        }
        word(&own, "noether.inverse#0")
    };
    let found = conditions("1", "x*y' - y*x'");
    assert_eq!(found, ("conditional", "b = a, c = 0".into()));
    let found = conditions("4", "x'*(x*y' - y*x') + a*x^2*y");
    assert_eq!(found, ("conditional", "b = 4 a, c = 0".into()));
}

/// A function without real values keeps none; by the signs of its arguments, also of two together, as log v - log(-v), and by what
/// the model assumes of a parameter. What has values somewhere is decided as before, √(v - 100) too, and √(v - 10⁶), which has some but
/// at no state that is drawn, is left open.
#[test]
fn functions_that_are_defined_nowhere() {
    let mut free = stating(
        system("x y", "(x'^2 + y'^2)/2 + a", &[]),
        &[
            ("log(x') - log(-x')", &[]),
            ("log(-x'^2)", &[]),
            ("asin(2)", &[]),
            ("acos(x'^2 + 5)", &[]),
            ("sqrt(-a x'^2 - 1)", &[]),
            ("atanh(x') + acosh(x' - 1)", &[]),
            ("log(x') - log(-y')", &[]),
            ("asin(x') + acosh(1 + x'^2)", &[]),
            ("log(-x)", &[]),
            ("sqrt(x' - 100)", &[]),
            ("sqrt(x' - 1000000)", &[]),
        ],
    );
    let nowhere = ["not-applicable"; 6];
    let rest = ["proved", "proved", "refuted", "proved", "undecided"];
    let zero = free.graph.zero();
    free.assumptions.push(Assumption {
        left: zero,
        relation: Relation::Less,
        right: expr(&free.graph, "a"),
        text: "a > 0".into(),
    });
    expect(&free, &[&nowhere[..], &rest[..]].concat());
    let (_, why) = word(&free, "noether.inverse#0");
    assert!(
        why.contains("log(x') needs x' > 0") && why.contains("log(-x') needs -x' > 0"),
        "{why}"
    );
}

/// The system with values of its parameters.
fn with_values(mut system: System, values: &[(&str, &str)]) -> System {
    let g = system.graph.clone();
    for (name, value) in values {
        system.parameters.push(Parameter {
            name: (*name).into(),
            expr: expr(&g, name),
            value: Some(expr(&g, value)),
        });
    }
    system
}

/// Angles of two arguments jump once in a turn, whether the integral holds for all parameters or for those stated; with a second argument
/// that is positive they do not. The inverse tangent of a quotient jumps where its denominator vanishes.
#[test]
fn jumps_are_part_of_the_condition() {
    let spring = system("x", "(x'^2 - k*x^2)/2", &[]);
    let values: &[(&str, &[&str])] = &[
        ("atan2(2*x, x') - 2*t", &[]),
        ("atan2(sqrt(k)*x, x') - sqrt(k)*t", &[]),
        ("atan2(x'^2 + k*x^2, 1)", &[]),
        ("atan(2*x/x') - 2*t", &[]),
    ];
    let spring = with_values(stating(spring, values), &[("k", "4")]);
    expect(
        &spring,
        &["conditional", "conditional", "proved", "conditional"],
    );
    for (place, needs_value) in [(0, true), (1, false), (3, true)] {
        let (_, condition) = word(&spring, &format!("noether.inverse#{place}"));
        assert!(condition.contains("does not jump"), "{condition}");
        assert_eq!(condition.contains("k = 4"), needs_value, "{condition}");
    }
}

/// On x' = -y, y' = x the rate of x² + y² vanishes, but only for k = r³ do motions stay there: the second derivative,
/// 2 (x'² + y'² - k/r) = 2 (r² - k/r), does not vanish. With k/r³ for the square of the rate they stay. On a line through the centre
/// motions leave every point with a velocity, and the energy there is kept all the same: nothing is said of that.
#[test]
fn parts_that_motions_leave() {
    let kepler = system("x y", "(x'^2 + y'^2)/2 + k/sqrt(x^2 + y^2)", &[]);
    let turning: &[&str] = &[
        "x' = -y*sqrt(k)/(x^2 + y^2)^(3/4)",
        "y' = x*sqrt(k)/(x^2 + y^2)^(3/4)",
    ];
    let values: &[(&str, &[&str])] = &[
        ("x^2 + y^2", &["x' = -y", "y' = x"]),
        ("x^2 + y^2", turning),
        ("x'^2/2 - k/abs(x)", &["y = 0", "y' = 0", "x = 1"]),
    ];
    let kepler = stating(kepler, values);
    expect(&kepler, &["refuted", "conditional", "not-applicable"]);
    let finding = |place: usize| finding(&kepler, &format!("noether.inverse#{place}"));
    let left = finding(0).verdict.detail().to_owned();
    assert!(left.contains("its second derivative in time"), "{left}");
    // The generator is that of x² + y², which contains no velocity: nothing but a gauge.
    assert!(!finding(1).formulas.is_empty());
}

/// What is an integral under a condition has its field under the condition: of x y' - y x' for two equal springs χ = -∂G/∂v = (y, -x), and
/// on the component z' = x' of (z' - x') (z' - y') = 0 with V = 0, on positions that a circle allows, and on each side of a corner there is
/// one too.
#[test]
fn conditions_have_generators() {
    let springs = system("x y", "(x'^2 + y'^2 - a*x^2 - b*y^2)/2", &[]);
    let springs = stating(springs, &[("x*y' - y*x'", &[])]);
    let springs = with_values(springs, &[("a", "1"), ("b", "1")]);
    let found = finding(&springs, "noether.inverse#0");
    assert_eq!(found.verdict.word(), "conditional");
    let g = &springs.graph;
    let along: Vec<String> = found
        .formulas
        .iter()
        .filter(|f| f.caption.contains("component ξ"))
        .map(|f| g.text(f.right))
        .collect();
    assert_eq!(along, ["y", "-x"]);
    let product = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - z",
        &[("f", "(z' - x')*(z' - y')")],
    );
    let product = stating(product, &[("y'", &[])]);
    let circle = system("x y", "(x'^2 + y'^2)/2 - y", &[("f", "x^2 + y^2 - 1")]);
    let circle = stating(circle, &[("(x*y' - y*x')^2/2 + y", &[])]);
    let corner = system("x y", "(x'^2 + y'^2)/2", &[("f", "y' - abs(x')")]);
    let corner = stating(corner, &[("y - x", &[])]);
    for (system, expected) in [
        (product, "conditional"),
        (circle, "proved"),
        (corner, "conditional"),
    ] {
        let found = finding(&system, "noether.inverse#0");
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), expected, "{detail}");
        assert!(!found.formulas.is_empty(), "{detail}");
        assert!(!detail.contains("it vanishes on"), "{detail}");
    }
}

/// On y (1 + x²) = 0 there is y = 0 alone, where Z f = 2 x y' + 2 y x' vanishes for Z = ∂/∂x: off it nothing is admissible, and none of
/// its values refutes. On a sphere Z f = 2 x' changes, at points of the sphere.
#[test]
fn reduced_symmetries_are_asked_on_the_positions_that_are_allowed() {
    let line = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - y - z",
        &[("c", "y*(1 + x^2)")],
    );
    let found = finding(&line, "noether.reduced-symmetry#1").verdict.clone();
    assert_eq!(found.word(), "undecided", "{}", found.detail());
    assert!(
        found.detail().contains("keeps its value on motions"),
        "{}",
        found.detail()
    );
    let sphere = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2 - z",
        &[("c", "x^2 + y^2 + z^2 - 1")],
    );
    let found = finding(&sphere, "noether.reduced-symmetry#1")
        .verdict
        .clone();
    let Verdict::Refuted(found) = found else {
        panic!("{}", found.detail());
    };
    let at = |name: &str| {
        let value = found.point.iter().find(|p| p.name == name).expect("stated");
        match (&value.exact, &value.enclosure) {
            (Some(exact), _) => {
                let text = exact.to_string();
                let (n, d) = text.split_once('/').unwrap_or((&text, "1"));
                n.parse::<f64>().unwrap() / d.parse::<f64>().unwrap()
            }
            (_, Some((low, _))) => low.parse().unwrap(),
            _ => panic!("{value:?}"),
        }
    };
    let square: f64 = ["x", "y", "z"].iter().map(|name| at(name).powi(2)).sum();
    assert!((square - 1.0).abs() < 1e-9, "{:?}", found.point);
}
