//! What constraints keep: functions of position and time whose values no admissible motion changes. Known ones by hand; what is found is a
//! function of a known one where the gradients are parallel.

#![allow(clippy::unwrap_used, clippy::panic)] // a panic is how a test fails

use crate::common::{anywhere, asked, expr, finding, in_space, system, values};
use chetaev_mechanics::claims::Finding;
use chetaev_mechanics::system::{Assumption, Parameter, Relation};
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Verdict};

/// What is kept is named where constraints are products, on each component, or functions of exact ones; and arctangents are.
#[test]
fn what_constraints_keep_is_named() {
    let unit = "(x'^2 + y'^2 + z'^2)/2";
    for (constraint, expected) in [
        (
            "(x*x' + y*y')^2 + x*x' + y*y'",
            &["(x^2 + y^2)/2", "(x^2 + y^2)/2 + t"][..],
        ),
        ("exp(x*x' + y*y') - 1", &["x^2 + y^2"]),
        ("z' - (x*y' - y*x')/(x^2 + y^2)", &["z - atan2(y, x)"]),
        (
            "z' - (x*y' - (y - 1)*x')/(x^2 + (y - 1)^2)",
            &["z - atan2(y - 1, x)"],
        ),
        ("z' - x'/(1 + a^2*x^2)", &["a*z - atan(a*x)"]),
        (
            "z' - a*x'/(4*x^2 + 9) + y*y'",
            &["6*z + 3*y^2 - a*atan(2*x/3)"],
        ),
        (
            "z'*(4*x^2 + 9*y^2) - x*y' + y*x'",
            &["6*z - atan2(3*y, 2*x)"],
        ),
    ] {
        let own = system("x y z", unit, &[("f", constraint)]);
        let found = finding(&own, "model.constraints-integrable#weak");
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "proved", "{constraint}: {detail}");
        let g = &own.graph;
        let kept: Vec<Expr> = found.formulas.iter().map(|f| f.right).collect();
        assert_eq!(kept.len(), expected.len(), "{constraint}: {detail}");
        // One is a function of the other where their gradients are parallel: at a few points.
        for known in expected.iter().map(|text| expr(g, text)) {
            let parallel = |e: &&Expr| (0..4).all(|seed| crossed(&own, **e, known, seed) < 1e-10);
            assert!(kept.iter().any(|e| parallel(&e)), "{constraint}: {detail}");
        }
    }
}

/// |x'| = y' keeps y - x while x' > 0 and y + x while x' < 0, and nothing over both: going there and back leads from (0, 0) to (0, 2).
#[test]
fn constraints_with_corners_are_integrable_on_each_side() {
    let unit = "(x'^2 + y'^2 + z'^2)/2";
    for constraint in ["y' - abs(x')", "y' - sqrt(x'^2)"] {
        let own = system("x y z", unit, &[("f", constraint)]);
        let found = finding(&own, "model.constraints-integrable#weak");
        let Verdict::Conditional { condition, .. } = &found.verdict else {
            panic!("{constraint}: {}", found.verdict.detail());
        };
        assert!(
            condition.contains("≠ 0, on each side by itself"),
            "{condition}"
        );
        let detail = found.verdict.detail();
        let sides = ["where x' > 0: y - x", "where x' < 0: x + y"];
        assert!(sides.iter().all(|side| detail.contains(side)), "{detail}");
    }
}

/// y/x is kept where √(x² + y²)/x is.
#[test]
fn what_is_kept_is_shown_without_roots() {
    let constraints = [
        ("a", "x*y' - y*x'"),
        ("b", "z' - (x*x' + y*y')/sqrt(x^2 + y^2)"),
    ];
    let own = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &constraints);
    let found = finding(&own, "model.constraints-integrable#weak");
    let mut shown: Vec<String> = found
        .formulas
        .iter()
        .map(|f| own.graph.text(f.right))
        .collect();
    shown.sort();
    assert_eq!(shown, ["sqrt(x^2 + y^2) - z", "y/x"]);
}

/// A root of what vanishes nowhere has no corner: (z' - x x') √(1 + x'²) = 0 keeps z - x²/2 at all states.
#[test]
fn a_root_that_vanishes_nowhere_is_no_corner() {
    let constraint = "(z' - x*x')*sqrt(1 + x'^2)";
    let own = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &[("f", constraint)]);
    let found = finding(&own, "model.constraints-integrable#weak");
    assert_eq!(found.verdict.word(), "proved", "{}", found.verdict.detail());
}

/// x' = y, y' = x, z' = x y keep three functions of (t, q): x² - 2 z, y² - 2 z and (x + y) e^(-t). Whatever is not found is counted.
#[test]
fn functions_that_were_not_found_are_counted() {
    let constraints = [("a", "x' - y"), ("b", "y' - x"), ("c", "z' - x*y")];
    let own = system("x y z", "(x'^2 + y'^2 + z'^2)/2", &constraints);
    let found = finding(&own, "model.constraints-integrable#weak");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    let missing = 3 - found.formulas.len();
    let said = detail.contains(&format!("and {missing} more, not found"));
    assert_eq!(said, missing > 0, "{detail}");
}

/// A product of which one factor is integrable: on its component x² + y² + z² is kept, on the other nothing is.
#[test]
fn what_one_component_keeps_is_named() {
    let product = system(
        "x y z",
        "(x'^2 + y'^2 + z'^2)/2",
        &[("f", "(z' - y*x')*(x*x' + y*y' + z*z')")],
    );
    let found = finding(&product, "model.constraints-integrable#weak");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "conditional", "{detail}");
    let g = &product.graph;
    let sphere = expr(g, "x^2 + y^2 + z^2");
    let kept = found.formulas.iter().filter(|f| f.caption.contains("keep"));
    let kept: Vec<Expr> = kept.map(|f| f.right).collect();
    assert_eq!(kept.len(), 1, "{detail}");
    assert!(
        (0..4).all(|seed| crossed(&product, kept[0], sphere, seed) < 1e-10),
        "{detail}"
    );
}

/// The largest 2 × 2 minor of the gradients by (t, x, y, z) of two functions somewhere.
fn crossed(system: &System, a: Expr, b: Expr, seed: u64) -> f64 {
    let g = &system.graph;
    let places = ["t", "x", "y", "z"].map(|q| g.intern_symbol(q, 0));
    let slopes: Vec<Expr> = [a, b]
        .iter()
        .flat_map(|&e| places.map(|s| g.diff(e, s)))
        .collect();
    let point = anywhere(g, &[&slopes[..], &[a, b]].concat(), seed);
    let at = values(g, &slopes, &point);
    let (first, second) = at.split_at(places.len());
    assert!(first.iter().any(|s| s.abs() > 1e-6) && second.iter().any(|s| s.abs() > 1e-6));
    let mut largest: f64 = 0.0;
    for i in 0..places.len() {
        for j in 0..i {
            largest = largest.max((first[i] * second[j] - first[j] * second[i]).abs());
        }
    }
    largest
}

const WEAK: &str = "model.constraints-integrable#weak";
const GROWTH: &str = "distribution.growth";

/// `a` and `b` with these values, and the second defined by the first where that is wanted.
fn with_parameters(mut own: System, values: [i64; 2], is_defined: bool) -> System {
    let g = own.graph.clone();
    let names = ["a", "b"].into_iter().zip(values);
    own.parameters = names
        .map(|(name, value)| Parameter {
            name: name.into(),
            expr: g.symbol(name, 0),
            value: Some(g.integer(value)),
        })
        .collect();
    if is_defined {
        own.definitions = vec![(g.symbol("b", 0), g.symbol("a", 0))];
    }
    own
}

/// Whether what is kept is a function of each known one alone, and there are no more.
fn keeps(own: &System, found: &Finding, known: &[&str]) -> bool {
    let kept = found.formulas.iter().filter(|f| f.caption.contains("keep"));
    let kept: Vec<Expr> = kept.map(|f| f.right).collect();
    let parallel = |e: Expr, known: Expr| (0..4).all(|seed| crossed(own, e, known, seed) < 1e-8);
    let mut known = known.iter().map(|text| expr(&own.graph, text));
    kept.len() == known.len() && known.all(|known| kept.iter().any(|&e| parallel(e, known)))
}

/// z' = a y x' + b x y' keeps z - a x y where b is a; with dz - a y dx - b x dy the only component of Frobenius' condition is a - b.
#[test]
fn definitions_of_parameters_count_and_stated_values_are_said() {
    let stated = in_space(&[("c", "z' - a*y*x' - b*x*y'")]);
    let defined = with_parameters(stated.clone(), [1, 1], true);
    let found = finding(&defined, WEAK);
    assert_eq!(found.verdict.word(), "proved", "{}", found.verdict.detail());
    assert!(found.verdict.detail().contains("with b = a"));
    assert!(keeps(&defined, &found, &["z - a*x*y"]));
    let growth = finding(&defined, GROWTH);
    assert_eq!(growth.verdict.word(), "refuted");
    assert!(growth.verdict.detail().contains("growth vector is (2) "));

    let equal = with_parameters(stated.clone(), [1, 1], false);
    for (claim, word, says) in [
        (WEAK, "a = b", "integrable"),
        (GROWTH, "a ≠ b", "the growth vector is (2)"),
    ] {
        let found = asked(&equal, claim);
        let detail = found.verdict.detail();
        let Verdict::Conditional { condition, .. } = &found.verdict else {
            panic!("{}: {detail}", found.verdict.word())
        };
        assert_eq!(condition, word);
        assert!(
            detail.starts_with("for a = b, as the model states: "),
            "{detail}"
        );
        assert!(detail.contains(says), "{detail}");
        let other = asked(&with_parameters(stated.clone(), [1, 2], false), claim);
        assert!(!other.verdict.detail().contains("as the model states"));
    }
}

/// z' = (y + |y|)² x' is z' = 0 where y < 0, and z' = 4 y² x' elsewhere: brackets add a direction there alone.
#[test]
fn what_vanishes_on_one_side_generates_nothing_there() {
    let own = in_space(&[("c", "z' - (y + abs(y))^2*x'")]);
    let found = finding(&own, GROWTH);
    let detail = found.verdict.detail();
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{detail}");
    };
    assert_eq!(condition, "y > 0");
    assert!(
        detail.contains("where y > 0: the growth vector is (2, 3)"),
        "{detail}"
    );
    assert!(
        detail.contains("where y < 0: the growth vector is (2) "),
        "{detail}"
    );
    let weak = finding(&own, WEAK);
    let detail = weak.verdict.detail();
    assert_eq!(weak.verdict.word(), "refuted", "{detail}");
    assert!(detail.contains("integrable where y < 0"), "{detail}");
    assert!(keeps(&own, &weak, &["z"]), "{detail}");
}

/// With y > 0 the constraint z' = (y - |y|) x' is z' = 0.
#[test]
fn assumptions_choose_the_side() {
    let mut own = in_space(&[("c", "z' - (y - abs(y))*x'")]);
    let g = own.graph.clone();
    own.assumptions.push(Assumption {
        left: g.zero(),
        relation: Relation::Less,
        right: g.symbol("y", 0),
        text: "y > 0".into(),
    });
    let found = finding(&own, WEAK);
    assert_eq!(found.verdict.word(), "proved", "{}", found.verdict.detail());
    assert!(keeps(&own, &found, &["z"]));
    let growth = finding(&own, GROWTH);
    let detail = growth.verdict.detail();
    assert!(detail.contains("growth vector is (2) "), "{detail}");
}

/// z' = sign(y) x' keeps z - x where y > 0 and z + x where y < 0; a loop through y = 0, to the right above and back below, adds to z.
#[test]
fn signs_of_the_place_are_corners() {
    for constraint in ["z' - sign(y)*x'", "z' - y/sqrt(y^2)*x'"] {
        let own = in_space(&[("c", constraint)]);
        let found = finding(&own, WEAK);
        let detail = found.verdict.detail();
        let Verdict::Conditional { condition, .. } = &found.verdict else {
            panic!("{constraint}: {detail}");
        };
        assert_eq!(condition, "y ≠ 0, on each side by itself");
        assert!(keeps(&own, &found, &["z - x", "z + x"]), "{detail}");
        let growth = finding(&own, GROWTH);
        let detail = growth.verdict.detail();
        assert!(
            detail.contains("paths from one side to another may join more"),
            "{detail}"
        );
    }
}

/// z' = y x' with u' = v v' in disguise; two equal velocities that are not constant; x y' + y x' = 0 as a combination.
#[test]
fn what_constraints_keep_that_are_not_integrable_is_named() {
    for (coordinates, constraints, expected) in [
        (
            "x y z u v",
            &[("a", "z' - y*x'"), ("b", "u' - v*v' - z' + y*x'")][..],
            "u - v^2/2",
        ),
        ("x y z", &[("a", "x' - y"), ("b", "z' - y")], "x - z"),
        (
            "x y z u",
            &[
                ("a", "x*y' + y*x' + sin(z)*(z'*x - u')"),
                ("b", "u' - z'*x - exp(u)*(x*y' + y*x')"),
            ],
            "x*y",
        ),
    ] {
        let squares = coordinates.split_whitespace().map(|q| format!("{q}'^2/2"));
        let energy = squares.collect::<Vec<String>>().join(" + ");
        let own = system(coordinates, &energy, constraints);
        let found = finding(&own, WEAK);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "refuted", "{detail}");
        assert!(
            detail.contains("1 function is kept in spite of it"),
            "{detail}"
        );
        let g = &own.graph;
        let kept = found.formulas.iter().filter(|f| f.caption.contains("keep"));
        let kept: Vec<Expr> = kept.map(|f| f.right).collect();
        assert_eq!(kept.len(), 1, "{detail}");
        // Its gradient is parallel to that of the known one.
        let places = own.coordinate_symbols();
        let slopes = [kept[0], expr(g, expected)].map(|e| g.gradient(e, &places));
        let at = values(g, &slopes.concat(), &anywhere(g, &slopes.concat(), 3));
        let (a, b) = at.split_at(places.len());
        let minors = (0..a.len()).flat_map(|i| (0..i).map(move |j| a[i] * b[j] - a[j] * b[i]));
        assert!(minors.into_iter().all(|m| m.abs() < 1e-9), "{detail}");
    }
}

/// Exact, linear and separable forms, and such on the leaves of what is kept already; each by hand.
#[test]
fn quadratures_find_what_exact_linear_and_separable_constraints_keep() {
    for (constraints, known) in [
        (
            &[("c", "x*x' + y*y' - 1 - t")][..],
            &["x^2 + y^2 - (1 + t)^2"][..],
        ),
        (&[("c", "y' - b - k*y")], &["(y + b/k)*exp(-k*t)"]),
        (&[("c", "y' - (x + y)*x'")], &["(x + y + 1)*exp(-x)"]),
        (&[("c", "y' - y^2*x'")], &["1/y + x"]),
        (
            &[("c", "cos(z)*z' - exp(x)*y^2*x' - 2*y*exp(x)*y'")],
            &["sin(z) - y^2*exp(x)"],
        ),
        (&[("c", "z' - x^2*y^3*(3*y*x' + 4*x*y')")], &["z - x^3*y^4"]),
        (
            &[("c", "z' - cosh(x)*y' - y*sinh(x)*x'")],
            &["z - y*cosh(x)"],
        ),
        (&[("c", "z' - tanh(x)*x'")], &["z - log(cosh(x))"]),
        (
            &[("c", "z' - cos(x)^4*x'")],
            &["z - 3*x/8 - sin(2*x)/4 - sin(4*x)/32"],
        ),
        (
            &[("a", "x' - l*cos(z)*y'"), ("b", "z'")],
            &["z", "x - l*y*cos(z)"],
        ),
        (&[("a", "y'"), ("b", "z' - y*x'")], &["y", "z - x*y"]),
    ] {
        let own = in_space(constraints);
        let found = finding(&own, WEAK);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "proved", "{detail}");
        // With two the second is known up to functions of the first; here it is found as it stands.
        assert!(keeps(&own, &found, known), "{constraints:?}: {detail}");
    }
}

/// Whether the functions kept are as many as the known ones, and functions of these: the gradients of all have no higher rank.
fn spans(own: &System, found: &Finding, known: &[&str]) -> bool {
    let g = &own.graph;
    let kept = found.formulas.iter().filter(|f| f.caption.contains("keep"));
    let mut all: Vec<Expr> = kept.map(|f| f.right).collect();
    let count = all.len();
    all.extend(known.iter().map(|text| expr(g, text)));
    let mut places = vec![g.intern_symbol("t", 0)];
    places.extend(own.coordinate_symbols());
    let slopes: Vec<Expr> = all.iter().flat_map(|&e| g.gradient(e, &places)).collect();
    let real = |seed: u64| {
        let point = anywhere(g, &[&slopes[..], &all[..]].concat(), seed);
        let at = g.evaluate_f64(&slopes, &|s| point.get(&s).copied()).ok()?;
        at.iter().all(|v| v.is_finite()).then_some(at)
    };
    let points: Vec<Vec<f64>> = (0..60).filter_map(real).take(4).collect();
    let has_rank = |at: &Vec<f64>| {
        let rows: Vec<Vec<f64>> = at.chunks(places.len()).map(<[f64]>::to_vec).collect();
        rank(&rows) == count && rank(&rows[count..]) == count
    };
    count == known.len() && points.len() == 4 && points.iter().all(has_rank)
}

/// The number of independent rows.
fn rank(rows: &[Vec<f64>]) -> usize {
    let mut used: Vec<Vec<f64>> = Vec::new();
    for row in rows {
        let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let whole = length(row);
        let mut row: Vec<f64> = row.iter().map(|x| x / whole).collect();
        for unit in used.iter().chain(&used) {
            let along: f64 = row.iter().zip(unit).map(|(a, b)| a * b).sum();
            row.iter_mut().zip(unit).for_each(|(a, b)| *a -= along * b);
        }
        let rest = length(&row);
        if rest > 1e-7 {
            row.iter_mut().for_each(|x| *x /= rest);
            used.push(row);
        }
    }
    used.len()
}

/// Unit masses with any coordinates under constraints, and what they keep.
fn assert_keeps(coordinates: &str, constraints: &[(&str, &str)], known: &[&str]) {
    let squares = coordinates.split_whitespace().map(|q| format!("{q}'^2/2"));
    let energy = squares.collect::<Vec<String>>().join(" + ");
    let own = system(coordinates, &energy, constraints);
    let found = finding(&own, WEAK);
    let detail = found.verdict.detail();
    assert!(spans(&own, &found, known), "{constraints:?}: {detail}");
}

/// Each by hand: of one of the forms on the right the derivative of the left vanishes.
#[test]
fn one_constraint_by_an_antiderivative() {
    for (constraint, known) in [
        ("y' - exp(x - y)*x'", "exp(y) - exp(x)"),
        (
            "z' - log(x)*x' - cos(y)*y*y'",
            "x*log(x) - x + y*sin(y) + cos(y) - z",
        ),
        ("z'*sqrt(1 - x^2) - x'", "asin(x) - z"),
        ("z' - x'/sqrt(4 - x^2)", "asin(x/2) - z"),
        ("z' - sqrt(1 - z^2)*x'", "asin(z) - x"),
        ("z' - x'/sqrt(a^2 + x^2)", "log(x + sqrt(a^2 + x^2)) - z"),
        ("z' - x'/cos(x)", "log(1/cos(x) + tan(x)) - z"),
        (
            "z' - x'/cos(x)^3",
            "sin(x)/cos(x)^2 + log(1/cos(x) + tan(x)) - 2*z",
        ),
        ("z' - x'/sinh(x)", "log(tanh(x/2)) - z"),
        ("z' - y*x^(y - 1)*x' - x^y*log(x)*y'", "x^y - z"),
        ("z' - x^4*x'/(1 + x^2)", "x^3/3 - x + atan(x) - z"),
        ("z' - exp(x)/(1 + exp(2*x))*x'", "atan(exp(x)) - z"),
        ("z' - sqrt(x)/(1 + x)*x'", "2*sqrt(x) - 2*atan(sqrt(x)) - z"),
        ("z' - asin(x)*x'", "x*asin(x) + sqrt(1 - x^2) - z"),
        ("z' - x*x'/(x^4 + 1)", "atan(x^2) - 2*z"),
        (
            "z' - (x'*y - x*y')/(x^2 + x*y + y^2)",
            "3*z - 2*sqrt(3)*atan((2*x + y)/(sqrt(3)*y))",
        ),
        ("z' - x'*cos(log(x))", "x*(sin(log(x)) + cos(log(x))) - 2*z"),
        ("z' - x'/(x^2*(x + 1))", "-1/x - log(x) + log(x + 1) - z"),
    ] {
        assert_keeps("x y z", &[("c", constraint)], &[known]);
    }
}

/// Bernoulli's equation in a power of y, homogeneous ones in u = y/x, functions of a linear combination of x and y, and one with the weights
/// two and one; each by hand.
#[test]
fn one_constraint_by_a_substitution() {
    for (constraint, known) in [
        ("y' - x'*y/x - y^2*x'", "x/y + x^2/2"),
        ("y' - x'*y/x - y^3*x'", "x^2/y^2 + 2*x^3/3"),
        ("x'*y^2 + x*y*y' - x^2*y'", "2/(x*y) - 1/y^2"),
        ("y' - (x + y)^2*x'", "atan(x + y) - x"),
        ("y' - (a*x + y)^2*x'", "atan((a*x + y)/sqrt(a)) - sqrt(a)*x"),
        ("(x + y)*x' - (x - y)*y'", "atan2(y, x) - log(x^2 + y^2)/2"),
        ("y'*(x + y^2) - y*x'", "x/y - y"),
        ("y' - cos(x + y)*x'", "tan((x + y)/2) - x"),
        ("y' - (y/x + tan(y/x))*x'", "sin(y/x)/x"),
        ("y' - (x^2 + y^2)/(x*y)*x'", "y^2/x^2 - 2*log(x)"),
        ("y' - cos(y)^2*(x + tan(y))*x'", "(tan(y) + x + 1)*exp(-x)"),
    ] {
        assert_keeps("x y z", &[("c", constraint)], &[known]);
    }
}

/// Eigenvectors c of a system w' = A w with A of constants: c·w exp(-λ s), and for a pair of complex ones the angle.
#[test]
fn linear_systems_along_one_parameter() {
    let turning = ["x^2 + y^2", "atan2(y, x) - z"];
    assert_keeps("x y z", &[("a", "x' + y*z'"), ("b", "y' - x*z'")], &turning);
    let turning = ["x^2 + y^2", "atan2(y, x) - w*t"];
    assert_keeps("x y", &[("a", "x' + w*y"), ("b", "y' - w*x")], &turning);
    let boost = ["x^2 - y^2", "(x + y)*exp(-z)"];
    assert_keeps("x y z", &[("a", "x' - y*z'"), ("b", "y' - x*z'")], &boost);
    // A spring whatever its constant, and a system of which one form needs the solution of the others.
    let spring = ["k*x^2 + y^2", "atan2(y, sqrt(k)*x) + sqrt(k)*t"];
    assert_keeps("x y", &[("a", "x' - y"), ("b", "y' + k*x")], &spring);
    let spiral = ["(x^2 + y^2)*exp(-2*a*z)", "atan2(y, x) + b*z"];
    let forms = [("a", "x' - (a*x + b*y)*z'"), ("b", "y' - (a*y - b*x)*z'")];
    assert_keeps("x y z", &forms, &spiral);
    let three = ["x^2 + y^2", "atan2(y, x) - z", "u - y^2/2"];
    let third = ("c", "u' - x*y*z'");
    let forms = [("a", "x' + y*z'"), ("b", "y' - x*z'"), third];
    assert_keeps("x y z u", &forms, &three);
    let cycle = [("a", "y' - z*w'"), ("b", "x' - y*w'"), ("c", "z' - x*w'")];
    let u = "(2*x - y - z)";
    // The roots of 1: a real one, and the pair -1/2 ± i √3/2.
    let cyclic = [
        "(x + y + z)*exp(-w)".to_owned(),
        format!("({u}^2 + 3*(y - z)^2)*exp(w)"),
        format!("atan2(sqrt(3)*(y - z), {u}) + sqrt(3)/2*w"),
    ];
    let cyclic: Vec<&str> = cyclic.iter().map(String::as_str).collect();
    assert_keeps("x y z w", &cycle, &cyclic);
}

/// A sub-system that is integrable by itself contributes what it keeps.
#[test]
fn sub_systems_contribute() {
    let rolling = [("c", "x' - R*th'"), ("d", "s' - x'*cos(th)")];
    assert_keeps("x th s", &rolling, &["x - R*th", "s - R*sin(th)"]);
    // y' = exp(x²) x' has no elementary integral.
    let partly = [("a", "z' - x^2*x'"), ("b", "y' - exp(x^2)*x'")];
    let own = in_space(&partly);
    let found = finding(&own, WEAK);
    assert!(keeps(&own, &found, &["z - x^3/3"]));
    let detail = found.verdict.detail();
    assert!(
        detail.contains("and 1 more, not found among the functions that occur, their logarithms"),
        "{detail}"
    );
}

/// What is shown is the plainest function of what is kept: without functions, powers, constant terms and factors around it.
#[test]
fn what_is_kept_is_shown_bare() {
    let place = "(R*cos(a)*a')^2 + (R*sin(a)*a')^2 + h^2*b'^2";
    let angles = system("a b", place, &[("c", "b' - a'")]);
    let mut positive = in_space(&[("c", "z' - x' - (a - sqrt(a^2))*(x*y' + y*x')")]);
    let g = positive.graph.clone();
    positive.assumptions.push(Assumption {
        left: g.zero(),
        relation: Relation::Less,
        right: g.symbol("a", 0),
        text: "a > 0".into(),
    });
    let others = [
        (positive, "z - x"),
        (angles, "a - b"),
        (
            in_space(&[("c", "z' - (tan(x) - sin(x)/cos(x))*y' - x'")]),
            "x - z",
        ),
        (
            in_space(&[("c", "sqrt(1 + x^2 + y^2)*(x*x' + y*y')")]),
            "x^2 + y^2",
        ),
    ];
    for (own, shown) in others {
        let found = finding(&own, WEAK);
        let kept = found.formulas.iter().filter(|f| f.caption.contains("keep"));
        let kept: Vec<String> = kept.map(|f| own.graph.text(f.right)).collect();
        assert_eq!(kept, [shown], "{}", found.verdict.detail());
    }
}

/// With the time as a variable there is one dimension more than coordinates: y' = t x' and z' = t has the fields of full rank on x, y, t, and
/// keeps 2 z - t².
#[test]
fn growth_on_space_and_time_states_the_dimension() {
    let own = in_space(&[("a", "y' - t*x'"), ("b", "z' - t")]);
    let found = finding(&own, GROWTH);
    let detail = found.verdict.detail();
    assert!(
        detail.contains("(2, 3), of 4 dimensions, 3 coordinates and the time: 1 function"),
        "{detail}"
    );
}

/// Quadratic forms in two velocities whose discriminant is a positive number are products over its root: each component keeps a function.
#[test]
fn quadratic_constraints_factor_over_roots() {
    for (constraint, known) in [
        ("z'^2 - 2*x'^2", ["z - sqrt(2)*x", "z + sqrt(2)*x"]),
        (
            "y'^2 - 2*x'*y' - x'^2",
            ["y - (1 + sqrt(2))*x", "y - (1 - sqrt(2))*x"],
        ),
        ("y'^2 - 3*x'^2", ["y - sqrt(3)*x", "y + sqrt(3)*x"]),
    ] {
        let own = with_parameters(in_space(&[("c", constraint)]), [3, 1], false);
        let found = finding(&own, WEAK);
        let detail = found.verdict.detail();
        assert!(keeps(&own, &found, &known), "{constraint}: {detail}");
    }
}
