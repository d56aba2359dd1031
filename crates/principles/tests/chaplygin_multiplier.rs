//! Chaplygin's reducing multiplier: the checks of theory 1 §6.2.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

mod common;

use common::worked::{text, DISC, PARTICLE};
use common::{expr, finding, system, Text};

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
        let value = common::with_context(&system, |cx| {
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
