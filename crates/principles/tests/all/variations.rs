//! Variations of the velocity: the list of T1 §2, exact.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{text, CONE, DISC, INTEGRABLE, LEVEL_SKATE, PARTICLE};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_mechanics::linear::dot;
use chetaev_principles::variations::Displacements;
use chetaev_symbolic::Verdict;

/// `δf = Σ expected_i δqⁱ` for virtual displacements and all accelerations.
#[track_caller]
fn assert_varied(stated: &Text, expected: &[&str]) {
    let system = system(stated);
    with_context(&system, |cx| {
        let g = &cx.system.graph;
        let d = Displacements::new(cx).unwrap();
        let covector: Vec<_> = expected.iter().map(|text| expr(g, text)).collect();
        let covector = d.chart.on_jet(cx.system, &covector);
        let expected = d.chart.contract(cx.system, &covector);
        let found = d.of_constraints(cx);
        let differences: Vec<_> = found[0]
            .iter()
            .zip(expected)
            .map(|(&a, b)| g.sub(a, b))
            .collect();
        let verdict = cx
            .prover
            .identity(cx.system, &differences, d.manifold(), "");
        assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
    });
}

/// S1: δf = −φ' δs + u δφ with δs = cos φ δx + sin φ δy.
#[test]
fn varied_skate() {
    let expected = [
        "-phi' cos(phi)",
        "-phi' sin(phi)",
        "x' cos(phi) + y' sin(phi)",
    ];
    assert_varied(&LEVEL_SKATE, &expected);
}

/// S3: E[f] = a ψ' (−sin ψ, cos ψ, 0), ψ the direction of (x', y').
#[test]
fn varied_cone() {
    let turn = "(x' y'' - y' x'')/(x'^2 + y'^2)^(3/2)";
    let x = format!("-a y' {turn}");
    let y = format!("a x' {turn}");
    assert_varied(&CONE, &[&x, &y, "0"]);
}

/// The coefficients A^l_s of (7), in the order of dependent and independent velocities of the chart.
#[track_caller]
fn assert_curvature(stated: &Text, expected: &[(&str, &str, &str)]) {
    let system = system(stated);
    with_context(&system, |cx| {
        let g = &cx.system.graph;
        let d = Displacements::new(cx).unwrap();
        let curvature = d.curvature();
        for &(dependent, independent, value) in expected {
            let place = |places: &[usize], name: &str| {
                places
                    .iter()
                    .position(|&i| cx.system.coordinates[i].name == name)
                    .unwrap()
            };
            let l = place(&d.chart.dependent, dependent);
            let s = place(&d.chart.independent, independent);
            let difference = [g.sub(curvature[l][s], expr(g, value))];
            let verdict = cx.prover.identity(cx.system, &difference, d.manifold(), "");
            assert_eq!(verdict.word(), "proved", "A_{dependent}_{independent}");
        }
    });
}

#[test]
fn curvature_coefficients() {
    assert_curvature(
        &DISC,
        &[
            ("x", "theta", "-R sin(phi) phi'"),
            ("x", "phi", "R sin(phi) theta'"),
            ("y", "theta", "R cos(phi) phi'"),
            ("y", "phi", "-R cos(phi) theta'"),
        ],
    );
    assert_curvature(&PARTICLE, &[("z", "x", "y'"), ("z", "y", "-x'")]);
    let cubed = "(x'^2 + y'^2)^(3/2)";
    let x = format!("a y' (y' x'' - x' y'')/{cubed}");
    let y = format!("a x' (x' y'' - y' x'')/{cubed}");
    assert_curvature(&CONE, &[("z", "x", &x), ("z", "y", &y)]);
}

/// Constraints homogeneous of degree one without the time: `Σ_s A^l_s v^s = 0`.
#[test]
fn the_actual_velocity_violates_nothing() {
    for stated in [&LEVEL_SKATE, &DISC, &CONE, &PARTICLE] {
        let system = system(stated);
        with_context(&system, |cx| {
            let g = &cx.system.graph;
            let d = Displacements::new(cx).unwrap();
            let speeds: Vec<_> = d.chart.parameters.iter().map(|p| p.value).collect();
            let sums: Vec<_> = d
                .curvature()
                .iter()
                .map(|row| dot(g, row, &speeds))
                .collect();
            let verdict = cx.prover.identity(cx.system, &sums, d.manifold(), "");
            assert_eq!(verdict.word(), "proved", "{}", verdict.detail());
        });
    }
}

#[track_caller]
fn assert_words(stated: &Text, hoelder: &str, says: &str, suslov: &str) {
    let system = system(stated);
    let found = finding(&system, "variation.hoelder");
    assert_eq!(found.verdict.word(), hoelder, "{}", found.verdict.detail());
    let detail = found.verdict.detail();
    assert!(detail.contains(says), "{detail}");
    let found = finding(&system, "variation.suslov");
    assert_eq!(found.verdict.word(), "proved", "{}", found.verdict.detail());
    let detail = found.verdict.detail();
    assert!(detail.contains(suslov), "{detail}");
}

/// Where δf vanishes: identically for integrable constraints, also behind a factor; on the motions of S3; for displacements
/// along the velocity on the others, with two independent velocities; with three of them, on a plane.
#[test]
fn where_varied_curves_are_admissible() {
    let curved = "A ≠ 0";
    let flat = "A = 0";
    assert_words(&INTEGRABLE, "proved", "every virtual displacement", flat);
    let behind_a_factor = text(
        "x y z",
        "x'^2 + y'^2 + z'^2",
        &[("c", "exp(x) (z' - y x' - x y')")],
    );
    assert_words(
        &behind_a_factor,
        "proved",
        "every virtual displacement",
        flat,
    );
    assert_words(&CONE, "conditional", "on every motion", curved);
    let says = "displacements with delta_x y' - delta_y x' = 0";
    assert_words(&PARTICLE, "conditional", says, curved);
    // Affine: δf = (y' δx − x' δy) still, but the actual velocity is no virtual displacement.
    let affine = text("x y z", "x'^2 + y'^2 + z'^2", &[("c", "z' - y x' - b")]);
    assert_words(&affine, "conditional", says, curved);
    // y' = t x': the constraint moves, and one displacement is left, which violates it.
    let moving = text("x y", "x'^2 + y'^2", &[("c", "y' - t x'")]);
    assert_words(&moving, "refuted", "for none but zero", curved);
    // Two constraints and four coordinates: the disc turns or rolls, in the ratio of its velocities.
    let says = "delta_phi theta' - delta_theta phi' = 0";
    assert_words(&DISC, "conditional", says, curved);
}

/// The whole condition, of constraints that violate each other's: δf of all of them vanishes. With z' = c₁(x, y) x' and w' = c₂(x, y) x' it
/// is ∂c/∂y (y' δx − x' δy) for each, so besides the ratio of the velocities only common zeros of both ∂c/∂y count: sine and cosine have none.
#[test]
fn constraints_are_kept_together() {
    let ratio = "delta_x y' - delta_y x' = 0";
    let and = |more: &str| format!("{ratio}{more}");
    for (first, second, expected) in [
        ("cos(y)", "sin(y)", and("")),
        ("x y", "y", and("")),
        ("sin(x) y", "cos(x) y", and("")),
        ("x y^2", "y^2", and(" or y = 0")),
        ("x y^2", "y^3", and(" or y = 0")),
        ("x y", "x^2 y", and(" or x = 0")),
        ("x y", "y^2", and(" or x = 0 and y = 0")),
    ] {
        let leak = |c: &str, v: &str| -> &'static str { format!("{v} - ({c}) x'").leak() };
        let pair = [("a", leak(first, "z'")), ("b", leak(second, "w'"))];
        let pair: &'static [(&str, &str)] = Box::leak(Box::new(pair));
        let stated = text("x y z w", "x'^2 + y'^2 + z'^2 + w'^2", pair);
        assert_hoelder(&stated, &expected);
    }
    assert_hoelder(&DISC, "delta_phi theta' - delta_theta phi' = 0");
    assert_hoelder(&PARTICLE, ratio);
}

#[track_caller]
fn assert_hoelder(stated: &Text, expected: &str) {
    let found = finding(&system(stated), "variation.hoelder");
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{}: {}", found.verdict.word(), found.verdict.detail())
    };
    let detail = found.verdict.detail();
    let turned = |s: &str| -> Vec<String> {
        let (ratio, rest) = s.split_once(" = 0").unwrap();
        let (a, b) = ratio.split_once(" - ").unwrap();
        vec![
            format!("{a} - {b} = 0{rest}"),
            format!("{b} - {a} = 0{rest}"),
        ]
    };
    assert!(turned(expected).contains(condition), "{condition}");
    assert!(detail.contains(condition), "{detail}");
}

/// Without constraints there is nothing to violate.
#[test]
fn no_constraints() {
    let free = system(&text("x", "x'^2", &[]));
    let found = finding(&free, "variation.hoelder");
    assert!(matches!(found.verdict, Verdict::Proved(_)));
}

/// z' = y² x' has δf = 2 y (y' δx − x' δy): zero for δx : δy = x' : y', and for every displacement where y = 0. z' = cos y x' likewise where
/// sin y = 0.
#[test]
fn states_at_which_every_varied_curve_is_admissible() {
    for (constraint, factor) in [
        ("z' - y^2 x'", " or y = 0"),
        ("z' - cos(y) x'", " or sin(y) = 0"),
    ] {
        let constraints: &'static [(&str, &str)] = Box::leak(Box::new([("c", constraint)]));
        let stated = text("x y z", "1/2 (x'^2 + y'^2 + z'^2)", constraints);
        let found = finding(&system(&stated), "variation.hoelder");
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "conditional", "{detail}");
        assert!(detail.contains(factor), "{detail}");
    }
    let found = finding(&system(&PARTICLE), "variation.hoelder");
    assert!(
        !found.verdict.detail().contains(" or "),
        "{}",
        found.verdict.detail()
    );
}

/// (z' − y x')(z' − x') = 0 has the integrable component z' = x': the sentence says on which component δf vanishes.
#[test]
fn a_product_of_constraints_names_its_component() {
    let product = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "(z' - y x') (z' - x')")],
    );
    for id in ["variation.hoelder", "hamilton.stationary-suslov"] {
        let found = finding(&system(&product), id);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "conditional", "{id}: {detail}");
        assert!(
            detail.contains("on the component x' - z' = 0"),
            "{id}: {detail}"
        );
    }
}
