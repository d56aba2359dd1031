//! Subsets of motions on which the action is stationary, with their multipliers.

use super::{assert_condition, assert_kappa, STATIONARY, SUSLOV};
use crate::common::worked::{text, CONE, DISC, LEVEL_SKATE, PARTICLE};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_symbolic::Verdict;

/// κ belongs to each subset: zero on both of S4.
#[test]
fn multipliers_on_subsets() {
    let system = system(&PARTICLE);
    let found = finding(&system, STATIONARY);
    assert_eq!(found.formulas.len(), 2);
    assert!(found.formulas.iter().all(|f| system.graph.is_zero(f.right)));
}

/// The knife edge whose constraint moves with the speed b glides across the line of fall where u = b sin φ: at φ = π/2 another
/// speed than at φ = −π/2, so that the equation cos φ = 0 would say too much.
#[test]
fn angles_with_different_signs_are_not_one_equation() {
    let moving = text(
        "x y phi",
        "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2 + m G x",
        &[("blade", "x' sin(phi) - (y' - b) cos(phi)")],
    );
    let condition = "phi' = 0 and sin(phi) = 0, or u_y = -b, phi' = 0 and phi = -pi/2 (mod 2 pi), or u_y = b, phi' = 0 and \
                     phi = pi/2 (mod 2 pi) (with x' = (u_y - b sin(phi)) cos(phi), y' = u_y sin(phi) + b cos(phi)^2)";
    assert_condition(&moving, STATIONARY, condition);
}

/// λ = (cos y − 1)(2 + sin y)/(1 + (2 + sin y)²) vanishes at y = 0 and not at y = π, where κ = 0 has no reaction to meet.
#[test]
fn a_zero_of_the_sine_may_be_one_only() {
    let slope = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - x (1 - cos(y))",
        &[("c", "z' - (2 + sin(y)) x'")],
    );
    let detail = finding(&system(&slope), STATIONARY)
        .verdict
        .detail()
        .to_string();
    assert!(detail.contains("y' = 0 and y = 0 (mod 2 pi)"), "{detail}");
    // Cases that were not followed are no statement.
    let stated = detail.split("; perhaps").next().unwrap();
    assert!(!stated.contains("sin(y) = 0"), "{detail}");
}

/// y' = t x' + 1: with x' = 0 the particle moves along y and needs no reaction.
#[test]
fn a_drift_is_no_rest() {
    let drift = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - t x' - 1")]);
    assert_condition(&drift, STATIONARY, "x' = 0");
}

/// z' = √(1 − x'² − y'²) has no slope where the root vanishes: nothing is said of states there.
#[test]
fn edges_of_roots_are_no_motions() {
    let sphere = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - z",
        &[("c", "z' - sqrt(1 - x'^2 - y'^2)")],
    );
    assert_condition(&sphere, STATIONARY, "x' = 0 and y' = 0");
}

/// Σ κ E[f] = 2 (κ_f + 2 κ_g) (…): the constants of κ_f and κ_g are tied, so that one remains; λ = 0, as z'' = −5 (x² + y²) λ_f = λ_f.
#[test]
fn tied_multipliers_have_no_constants_of_their_own() {
    let tied = text(
        "x y z w",
        "1/2 (x'^2 + y'^2 + z'^2 + w'^2)",
        &[("f", "z' - y x' + x y'"), ("g", "w' - 2 y x' + 2 x y'")],
    );
    let stated = system(&tied);
    let found = finding(&stated, STATIONARY);
    assert_eq!(found.verdict.word(), "proved");
    let detail = found.verdict.detail();
    assert!(detail.contains("1 constant of κ(0) is free"), "{detail}");
    let g = &stated.graph;
    let value = |name: &str| {
        let own = found
            .formulas
            .iter()
            .find(|f| f.left == Some(g.symbol(name, 0)));
        own.unwrap().right
    };
    let (f, of_g) = (value("kappa_f"), value("kappa_g"));
    assert!(
        g.is_zero(g.add(&[f, g.mul(&[g.integer(2), of_g])])),
        "{detail}"
    );
    assert_eq!(g.symbols_in(&[f, of_g]).len(), 1, "{detail}");
    let method = finding(&system(&tied), "hamilton-jacobi.applicable");
    assert_eq!(
        method.verdict.word(),
        "proved",
        "{}",
        method.verdict.detail()
    );
}

/// For z'² = x'² + y'² with a weight along x the motions with y' = 0 are stationary, which is not found: no sentence may say that none is.
#[test]
fn almost_none_is_not_none() {
    let cone = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - x",
        &[("c", "z'^2 - x'^2 - y'^2")],
    );
    let system = system(&cone);
    for id in [STATIONARY, "hamilton-jacobi.applicable", "action.lagrange"] {
        let found = finding(&system, id);
        let detail = found.verdict.detail();
        assert!(
            found.verdict.word() != "refuted" || detail.contains("almost no motion"),
            "{id}: {detail}"
        );
        assert!(!detail.contains("does not hold"), "{id}: {detail}");
        assert!(!detail.contains("does not apply"), "{id}: {detail}");
    }
    let rest = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - t x'")]);
    let found = finding(&crate::common::system(&rest), "hamilton-jacobi.applicable");
    assert!(
        found.verdict.detail().contains("no motion but rest"),
        "{}",
        found.verdict.detail()
    );
}

/// The values that the formulas of a set give a multiplier, each proved along the motions of the set: the symbols there are replaced.
#[track_caller]
fn assert_on_set(stated: &Text, set: &str, place: &[(&str, &str)], expected: &[(&str, &str)]) {
    let system = system(stated);
    let found = finding(&system, STATIONARY);
    let g = &system.graph;
    let there: Vec<_> = place
        .iter()
        .map(|(a, b)| (expr(g, a), expr(g, b)))
        .collect();
    for (name, value) in expected {
        let symbol = g.symbol(name, 0);
        let mut all = found.formulas.iter();
        let shown = all.find(|f| f.left == Some(symbol) && f.caption.ends_with(set));
        let captions: Vec<&String> = found.formulas.iter().map(|f| &f.caption).collect();
        let shown = shown.unwrap_or_else(|| panic!("{set}: {captions:?}"));
        let difference = g.sub(shown.right, expr(g, value));
        let difference = [g.substitute(difference, &there)];
        let verdict = with_context(&system, |cx| {
            let nowhere = chetaev_mechanics::Manifold::default();
            cx.prover.identity(&system, &difference, &nowhere, "")
        });
        assert_eq!(verdict.word(), "proved", "{name} = {}", g.text(shown.right));
    }
}

/// Multipliers that the conditions leave free. z' = y x' with w' = x y': Φ = 0 and (12) is κ_a = κ_b unless x' or y' vanishes, so where
/// x' = y' and x = y, which are constant velocities, κ' = −λ = −z'' = −y'². On the circle x'² + y'² = c² a fall along y has y'' = 0 and
/// 2 c λ = g. A skate at rest across the line of fall has λ cos φ = m g.
#[test]
fn free_multipliers_on_subsets() {
    let two = text(
        "x y z w",
        "1/2 (x'^2 + y'^2 + z'^2 + w'^2)",
        &[("a", "z' - y x'"), ("b", "w' - x y'")],
    );
    let both = [("kappa_a", "const_b - y y'"), ("kappa_b", "const_b - y y'")];
    assert_on_set(
        &two,
        "where x' = y' and x = y",
        &[("x'", "y'"), ("x", "y")],
        &both,
    );
    let opposite = [("kappa_a", "const_b + y y'"), ("kappa_b", "const_b + y y'")];
    let place = [("x'", "-y'"), ("x", "-y")];
    assert_on_set(&two, "where x' = -y' and x = -y", &place, &opposite);
    let circle = text(
        "x y",
        "1/2 m (x'^2 + y'^2) - m g y",
        &[("c", "x'^2 + y'^2 - 4")],
    );
    // y' t is y, up to a constant.
    let kappa = [("kappa_c", "const_c - m g y/8")];
    assert_on_set(&circle, "where y' = 2 and x' = 0", &[], &kappa);
    let skate = text(
        "x y phi",
        "1/2 m (x'^2 + y'^2) + 1/2 J phi'^2 - m g y",
        &[("c", "y' cos(phi) - x' sin(phi)")],
    );
    let kappa = [("kappa_c", "const_c - m g cos(phi) t")];
    let rest = "where u_x = 0, phi' = 0 and sin(phi) = 0";
    assert_on_set(&skate, rest, &[], &kappa);
}

/// κ of constraints that stay implicit, with a factor of its own, of two constraints that contain each other, and linear in the time.
/// The cone as a polynomial: κ of f is that of z' − aρ over 2 z', m z'/a² + C. z' = z y': (κ z)' = κ' z + κ z y' = −λ z = y''. Of
/// w' = z' + x x' the rate is that of κ_d, and D(κ_c − κ_d + z') = −g.
#[test]
fn multipliers_by_factors_and_by_both_constraints() {
    let cone = text(
        "x y z",
        "1/2 m (x'^2 + y'^2 + z'^2) - m g z",
        &[("cone", "z'^2 - a^2 (x'^2 + y'^2)")],
    );
    let kappa = [("kappa_cone", "m/(2 a^2) + const_cone/z'")];
    assert_kappa(&cone, &kappa, "every κ(0) serves");
    let exponential = text("x y z", "1/2 (x'^2 + y'^2 + z'^2)", &[("c", "z' - z y'")]);
    assert_kappa(
        &exponential,
        &[("kappa_c", "(y' + const_c)/z")],
        "every κ(0) serves",
    );
    let both = text(
        "x y z w",
        "1/2 (x'^2 + y'^2 + z'^2 + w'^2) - g z",
        &[("c", "z' - y x' - x y'"), ("d", "w' - z' - x x'")],
    );
    let kappa = [
        ("kappa_c", "const_c - z' - w' - g t"),
        ("kappa_d", "const_d - w'"),
    ];
    assert_kappa(&both, &kappa, "2 constants of κ(0) are free");
    // κ_d = C − y, and D(κ_c + y') = −1 − κ_d, where y'' = 1 and y = x'.
    let no_freedom = text(
        "x y",
        "1/2 (x'^2 + y'^2) - y",
        &[("c", "y' - t"), ("d", "x' - y")],
    );
    let kappa = [
        ("kappa_c", "const_c + x - 2 t - const_d t"),
        ("kappa_d", "const_d - y"),
    ];
    assert_kappa(&no_freedom, &kappa, "2 constants of κ(0) are free");
}

/// On a sphere with V = x, λ = (3 x − 2 E)/r² is no derivative of an elementary function: that none was found is said. And that κ is
/// not unique means that the motions are abnormal extremals; of the disc it is unique.
#[test]
fn what_is_not_found_is_said() {
    let sphere = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - x",
        &[("c", "x x' + y y' + z z'")],
    );
    let told = |stated: &Text| {
        finding(&system(stated), STATIONARY)
            .verdict
            .detail()
            .to_string()
    };
    let of_sphere = told(&sphere);
    assert!(
        of_sphere.contains("no closed form of kappa_c was found"),
        "{of_sphere}"
    );
    let abnormal = "abnormal extremal";
    assert!(of_sphere.contains(abnormal), "{of_sphere}");
    assert!(told(&CONE).contains(abnormal));
    assert!(!told(&DISC).contains(abnormal));
    assert!(!told(&LEVEL_SKATE).contains(abnormal));
}

/// x₁' y₂' = x₂' y₁' is solved for x₁' only where y₂' does not vanish, where motions with x₂' = 0 alone are not stationary: with the gradient
/// f_v = (y₂', −x₂', −y₁', x₁') the motion y₁'' = −g − λ x₂', y₂'' = −g + λ x₁' has λ v² = g (x₁' − x₂'), and E[f] = −D f_v is parallel to f_v
/// only where κ = 0, so λ = 0 and x₁' = x₂', whence y₁' = y₂' or x₁' = 0; or where it vanishes, on uniform motions: λ x₁' = g = −λ x₂' with
/// y₁' = y₂' = 0.
#[test]
fn solving_a_constraint_loses_no_velocity() {
    let lagrangian = "1/2 (x1'^2 + y1'^2 + x2'^2 + y2'^2) - g y1 - g y2";
    let stated = text("x1 y1 x2 y2", lagrangian, &[("c", "x1' y2' - x2' y1'")]);
    let expected =
        "y1' = y2' and x2' = x1', or y1' = 0, x2' = -x1' and y2' = 0, or x2' = 0 and x1' = 0";
    assert_condition(&stated, STATIONARY, expected);
    // κ' = −λ = −g/x₁'.
    let kappa = [("kappa_c", "const_c - g x1/x1'^2")];
    let uniform = "where y1' = 0, x2' = -x1' and y2' = 0";
    assert_on_set(&stated, uniform, &[], &kappa);
    // Suslov's terms, x₂' y₁' (y₂' x₂'' − x₂' y₂'')/y₂'³ and others, belong to x₁' as a function of the others: y₂' ≠ 0.
    let found = finding(&system(&stated), SUSLOV);
    let detail = found.verdict.detail();
    assert!(
        detail.contains("x2' = 0 and x1' = 0 (with y2' ≠ 0"),
        "{detail}"
    );
    assert!(!detail.contains("y2' = 0"), "{detail}");
}

/// z' = y ρ with ρ = √(x'² + y'²) and V = g z has λ (1 + y²) = g + y' ρ, and E[f] ∥ (−y', x') demands κ x' = 0. So x' = 0, or κ = 0 with λ = 0,
/// which the motion keeps: without a reaction x' and y' are constant. The sign of y' is that of the root's equation, not of its square.
#[test]
fn an_equation_with_a_root_is_followed() {
    let lagrangian = "1/2 (x'^2 + y'^2 + z'^2) - g z";
    let stated = text("x y z", lagrangian, &[("c", "z' - y sqrt(x'^2 + y'^2)")]);
    let expected = "x' = 0, or y' sqrt(x'^2 + y'^2) + g = 0";
    let found = finding(&system(&stated), STATIONARY);
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{}", found.verdict.detail())
    };
    let parts = |s: &str| -> Vec<String> {
        let text = s.replace(", or ", " or ");
        let mut parts: Vec<String> = text.split(" or ").map(String::from).collect();
        parts.sort();
        parts
    };
    assert_eq!(parts(condition), parts(expected), "{condition}");
    assert!(
        found.verdict.detail().contains("only where"),
        "{}",
        found.verdict.detail()
    );
    let free = "where y' sqrt(x'^2 + y'^2) + g = 0";
    assert_on_set(&stated, free, &[], &[("kappa_c", "0")]);
}

/// The equation of a set is not divided by what its motions pass through. θ A of z' = y x' − x y' is 2 (y x' − x y') (y', −x'), which
/// vanishes on the straight lines through the origin, of all directions. For f = |v − J q|² − 1 on the plane with v = (x', y'), J q = (y, −x), E[f] is
/// parallel to f_v where v·(v − J q) = −1, which with f = 0 is y x' − x y' = x² + y² − 2.
#[test]
fn sets_are_not_divided_by_what_may_vanish() {
    let particle = "1/2 (x'^2 + y'^2 + z'^2)";
    let lines = text("x y z", particle, &[("c", "z' - y x' + x y'")]);
    assert_condition(&lines, SUSLOV, "y x' - x y' = 0");
    let wheel = text("x y z", particle, &[("c", "(x' - y)^2 + (y' + x)^2 - 1")]);
    let rest = "y' = 0, x' = 0 and x^2 - 1 + y^2 = 0";
    let expected = format!("{rest}, or x y' - y x' + x^2 + y^2 - 2 = 0");
    assert_condition(&wheel, STATIONARY, &expected);
}

/// A skate on a turning platform, without slip relative to it, is stationary where it rests on it and keeps across the axis: along the heading
/// h = ψ + Ω t it is on the axis' perpendicular, x cos h + y sin h = 0, also when cos h = 0.
#[test]
fn sets_are_not_divided_by_functions_of_the_time() {
    let stated = text(
        "x y psi",
        "1/2 m (x'^2 + y'^2) + 1/2 J (psi' + Om)^2",
        &[(
            "c",
            "(y' - Om x) cos(psi + Om t) - (x' + Om y) sin(psi + Om t)",
        )],
    );
    let found = finding(&system(&stated), STATIONARY);
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{}", found.verdict.detail())
    };
    let set = "and x cos(Om t + psi) + y sin(Om t + psi) = 0";
    assert!(condition.contains(set), "{condition}");
    assert!(!condition.contains('≠'), "{condition}");
    assert!(found.verdict.detail().contains("only where"), "{condition}");
}

/// Cases that were not followed are named: z' = y x', w' = z x' leaves two.
#[test]
fn open_cases_are_named() {
    let chain = text(
        "x y z w",
        "1/2 (x'^2 + y'^2 + z'^2 + w'^2)",
        &[("c", "z' - y x'"), ("d", "w' - z x'")],
    );
    let found = finding(&system(&chain), STATIONARY);
    let detail = found.verdict.detail();
    let is_open = detail.contains("were not followed") || detail.contains("to be followed");
    assert!(
        !is_open || detail.contains("not followed: ") || detail.contains("too long"),
        "{detail}"
    );
}
