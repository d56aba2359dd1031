//! Chaplygin's reducing multiplier: the checks of T1 §6.2.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{text, DISC, PARTICLE};
use crate::common::{expr, finding, system, Text};

const ID: &str = "chaplygin.multiplier";

#[track_caller]
fn assert_multiplier(stated: &Text, expected: &str) {
    let system = system(stated);
    let found = finding(&system, ID);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    let caption = "the reducing multiplier N";
    let shown = found
        .formulas
        .iter()
        .find(|f| f.caption == caption)
        .unwrap();
    let g = &system.graph;
    // N is unique up to a constant factor.
    let ratio = g.div(shown.right, expr(g, expected));
    for c in &system.coordinates {
        let slope = g.diff(ratio, c.q_symbol);
        let value = crate::common::with_context(&system, |cx| {
            cx.prover
                .identity(&system, &[slope], &Default::default(), "")
        });
        assert_eq!(
            value.word(),
            "proved",
            "{} for {expected}",
            g.text(shown.right)
        );
    }
}

/// S4: (1 + y²)^(−1/2).
#[test]
fn particle() {
    assert_multiplier(&PARTICLE, "1/sqrt(1 + y^2)");
}

/// θ = e^(y²) x' and G₁₁ = 4 e^(2y²): ∂ln N/∂y = −2y e^(2y²)/(4 e^(2y²)) = −y/2, which no power of a polynomial has.
#[test]
fn exponential() {
    let stated = text(
        "x y z",
        "1/2 (3 exp(2 y^2) x'^2 + y'^2 + z'^2)",
        &[("c", "z' - exp(y^2) x'")],
    );
    assert_multiplier(&stated, "exp(-y^2/4)");
}

/// y' = x x' leaves one velocity, and (1 + x²) x'' + x x'² = 0 is Lagrange's equation of L* = (1 + x²) x'²/2; without constraints
/// L* = L.
#[test]
fn nothing_to_reduce() {
    let line = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - x x'")]);
    let free = text("x y", "1/2 (x'^2 + y'^2) - x^2 y", &[]);
    for stated in [&line, &free] {
        let found = finding(&system(stated), ID);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "proved", "{detail}");
        assert!(detail.starts_with("N = 1"), "{detail}");
    }
    let circle = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "x'^2 + y'^2 - 1")]);
    let nonlinear = finding(&system(&circle), ID);
    assert_eq!(nonlinear.verdict.word(), "not-applicable");
}

/// S1 with y' = tan φ x': cos φ; by the other velocity, sin φ. Also for a force function of x and φ.
#[test]
fn skate() {
    let by_x = text(
        "x y phi",
        "m/2 (x'^2 + y'^2) + J/2 phi'^2 - V x^2 cos(phi)",
        &[("blade", "y' - tan(phi) x'")],
    );
    assert_multiplier(&by_x, "cos(phi)");
    let by_y = text(
        "x y phi",
        "m/2 (x'^2 + y'^2) + J/2 phi'^2 - V y",
        &[("blade", "x' - y' cos(phi)/sin(phi)")],
    );
    assert_multiplier(&by_y, "sin(phi)");
}

/// S2: θ A = 0, so the equations are Hamilton's as they stand.
#[test]
fn disc() {
    assert_multiplier(&DISC, "1");
}

/// z' = y x' with the weight along z: now x is the coordinate that occurs nowhere, x' = z'/y, and ∂ln N/∂y = 1/(y (1 + y²)),
/// so N = y/√(1 + y²), a product of two powers.
#[test]
fn heavy_particle() {
    let heavy = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - g z",
        &[("c", "z' - y x'")],
    );
    assert_multiplier(&heavy, "y/sqrt(1 + y^2)");
}

/// A sleigh whose centre of mass is off the contact has none.
#[test]
fn sleigh() {
    let sleigh = text(
        "x y phi",
        "m/2 ((x' - a sin(phi) phi')^2 + (y' + a cos(phi) phi')^2) + J/2 phi'^2",
        &[("blade", "y' - tan(phi) x'")],
    );
    let found = finding(&system(&sleigh), ID);
    assert_eq!(
        found.verdict.word(),
        "refuted",
        "{}",
        found.verdict.detail()
    );
}

/// A force function of a dependent coordinate, or an affine constraint: hypotheses fail.
#[test]
fn hypotheses() {
    let heavy = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - g z",
        &[("c", "z' - (x + y) x'")],
    );
    let affine = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - y x' - b")],
    );
    for stated in [heavy, affine] {
        let found = finding(&system(&stated), ID);
        assert_eq!(
            found.verdict.word(),
            "not-applicable",
            "{}",
            found.verdict.detail()
        );
    }
}

/// Three areas swept by a point of unit mass move three masses m. With `S_s,uw = −2 m (q_s δ_uw − q_u δ_sw)` and
/// `G = (1 + m q²) δ − m q qᵀ` the condition `S_s,uw = φ_s G_uw − φ_u G_sw` holds with `φ_s = −2 m q_s/(1 + m q²)`, whatever the force
/// function is: N = 1/(1 + m q²). With one mass it is the case of two velocities, with the same N.
#[test]
fn three_velocities() {
    let areas = text(
        "x y z a b c",
        "1/2 (x'^2 + y'^2 + z'^2) + m/2 (a'^2 + b'^2 + c'^2) - V x^2 y - z",
        &[
            ("area_a", "a' - y z' + z y'"),
            ("area_b", "b' - z x' + x z'"),
            ("area_c", "c' - x y' + y x'"),
        ],
    );
    assert_multiplier(&areas, "1/(1 + m (x^2 + y^2 + z^2))");
    let area = text(
        "x y c",
        "1/2 (x'^2 + y'^2) + m/2 c'^2",
        &[("area_c", "c' - x y' + y x'")],
    );
    assert_multiplier(&area, "1/(1 + m (x^2 + y^2))");
}

/// θ A = 0 of the rolling disc, whatever moves beside it: N = 1.
#[test]
fn disc_with_a_neighbour() {
    let disc = text(
        "theta phi s x y",
        "I/2 theta'^2 + J/2 phi'^2 + s'^2/2 - k/2 (s - phi)^2 + m/2 (x'^2 + y'^2)",
        &[
            ("rolling_x", "x' - R cos(phi) theta'"),
            ("rolling_y", "y' - R sin(phi) theta'"),
        ],
    );
    assert_multiplier(&disc, "1");
}

/// Unequal masses, or a coordinate w that moves freely beside z' = y x': the condition on the gyroscopic terms fails. By hand, of the
/// second: `S_y,xx = −y` and `S_x,yx = y` alone are not zero, so (s, u, w) = (w, x, x) demands φ_w = 0, (y, w, w) demands φ_y = 0,
/// and (y, x, x) then −y = 0.
#[test]
fn three_velocities_without_a_multiplier() {
    let unequal = text(
        "x y z a b c",
        "1/2 (x'^2 + y'^2 + z'^2) + m/2 (a'^2 + b'^2) + M/2 c'^2",
        &[
            ("area_a", "a' - y z' + z y'"),
            ("area_b", "b' - z x' + x z'"),
            ("area_c", "c' - x y' + y x'"),
        ],
    );
    let beside = text(
        "x y w z",
        "1/2 (x'^2 + y'^2 + w'^2 + z'^2)",
        &[("c", "z' - y x'")],
    );
    for stated in [unequal, beside] {
        let found = finding(&system(&stated), ID);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "refuted", "{detail}");
        assert!(detail.contains("gyroscopic"), "{detail}");
    }
}

/// N as it is printed, at a position: a real positive number there, and the conditions that are said.
#[track_caller]
fn assert_positive(stated: &Text, at: &[(&str, f64)], says: &str) {
    let system = system(stated);
    let found = finding(&system, ID);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains(says), "{detail}");
    let caption = "the reducing multiplier N";
    let shown = found.formulas.iter().find(|f| f.caption == caption);
    let g = &system.graph;
    let value = |s| {
        let name = g.symbol_text(s);
        at.iter().find(|(own, _)| *own == name).map(|(_, x)| *x)
    };
    let number = g.evaluate_f64(&[shown.unwrap().right], &value).unwrap()[0];
    assert!(number > 0.0, "{number}: {detail}");
}

/// By (27), with z' = a(y) x' and L = (x'² + y'² + ε z'²)/2: ∂ln N/∂y = −ε a a'/(1 + ε a²), N = |1 + ε a²|^(−1/2). At y = 0, where a model
/// without initial data begins, it must be real.
#[test]
fn real_branches() {
    let sine = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - sin(y) x'")],
    );
    assert_multiplier(&sine, "1/sqrt(1 + sin(y)^2)");
    assert_positive(&sine, &[("y", 0.0)], "N = 1/sqrt(1 + sin(y)^2) makes");
    let root = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - sqrt(1 - y^2) x'")],
    );
    assert_positive(&root, &[("y", 0.0)], "where 2 - y^2 > 0");
    let indefinite = text("x y z", "1/2 (x'^2 + y'^2 - z'^2)", &[("c", "z' - y x'")]);
    assert_positive(&indefinite, &[("y", 0.0)], "> 0");
    // N = y/√(1 + y²) has a zero, and is needed positive.
    let inverse = text("x y z", "1/2 (x'^2 + y'^2 + z'^2)", &[("c", "z' - x'/y")]);
    assert_positive(&inverse, &[("y", 1.0)], "where y ≠ 0");
}

/// a' = x'/(1 − y): a = 1/(1 − y), 1 + a² = (y² − 2y + 2)/(1 − y)², so N = (y − 1)/√(y² − 2y + 2) by the formula above. The denominator of
/// ∂ln N/∂y is the product (y − 1)(y² − 2y + 2), which is not given in factors.
#[test]
fn products_of_factors_in_one_denominator() {
    let inverse = text(
        "x y a",
        "1/2 (x'^2 + y'^2 + a'^2)",
        &[("c", "a' - x'/(1 - y)")],
    );
    assert_multiplier(&inverse, "(y - 1)/sqrt(y^2 - 2 y + 2)");
}
