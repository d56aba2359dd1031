//! Stationary action: the table of T1 §4.3, with κ and the subsets of motions in closed form.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{text, CONE, DISC, INTEGRABLE, LEVEL_SKATE, PARTICLE, SKATE};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::system::Parameter;
use chetaev_symbolic::Verdict;

/// The condition of a conditional verdict, and that every case was followed.
#[track_caller]
fn assert_condition(stated: &Text, id: &str, expected: &str) {
    let found = finding(&system(stated), id);
    let Verdict::Conditional {
        condition,
        counterexample,
        ..
    } = &found.verdict
    else {
        panic!("{}: {}", found.verdict.word(), found.verdict.detail())
    };
    assert_eq!(condition, expected);
    assert!(counterexample.is_some());
    assert!(
        found.verdict.detail().contains("only where"),
        "{}",
        found.verdict.detail()
    );
}

const STATIONARY: &str = "hamilton.stationary";
const SUSLOV: &str = "hamilton.stationary-suslov";

/// S1: straight glide or pure spin on a level plane; on an incline along the line of fall, or at rest across it. Speeds without poles are made up,
/// as x' sin φ = y' cos φ gives x' or y' as the other one over a sine or cosine.
#[test]
fn skates() {
    let with = " (with x' = u_y cos(phi), y' = u_y sin(phi))";
    let level = format!("u_y = 0 or phi' = 0{with}");
    assert_condition(&LEVEL_SKATE, STATIONARY, &level);
    let incline = format!("phi' = 0 and sin(phi) = 0, or u_y = 0, phi' = 0 and cos(phi) = 0{with}");
    assert_condition(&SKATE, STATIONARY, &incline);
}

/// S4: x' = 0 or y' = 0; θ A = y x' (y', −x').
#[test]
fn particle() {
    assert_condition(&PARTICLE, STATIONARY, "x' = 0 or y' = 0");
    assert_condition(&PARTICLE, SUSLOV, "y' = 0 and y = 0, or x' = 0");
}

/// z' = a y x' + b x y' has A = a − b, and λ is (a + b) x'y' over 1 + a² y² + b² x²: for a = b the constraint is integrable, for a = −b
/// there is no reaction, and κ = 0 serves every motion.
#[test]
fn particular_parameters() {
    let stated = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - a y x' - b x y'")],
    );
    assert_condition(&stated, STATIONARY, "x' = 0 or y' = 0");
    let found = finding(&system(&stated), STATIONARY);
    let detail = found.verdict.detail();
    assert!(
        detail.contains("where b = a, every motion does"),
        "{detail}"
    );
    assert!(
        detail.contains("where b = -a, every motion does"),
        "{detail}"
    );
    // With a = 2 and b = a the motions of the model are all stationary, and the verdict on general a and b says so.
    let mut own = system(&stated);
    for name in ["a", "b"] {
        own.parameters.push(Parameter {
            name: name.into(),
            expr: expr(&own.graph, name),
            value: Some(expr(&own.graph, "2")),
        });
    }
    let found = finding(&own, STATIONARY);
    let detail = found.verdict.detail();
    let says = "where b = a, as by the values of the model, every motion does";
    assert!(detail.contains(says), "{detail}");
    assert!(detail.contains("where b = -a, every motion"), "{detail}");
}

/// A body with the masses m and M = m: without them there are no motions to speak of, and with b = k a of a slope the values are
/// those of k.
#[test]
fn parameters_that_others_define() {
    let massive = text(
        "x y z",
        "1/2 m (x'^2 + y'^2) + 1/2 M z'^2",
        &[("c", "z' - y x'")],
    );
    let free = finding(&system(&massive), STATIONARY);
    // By themselves: the mass M alone needs no reaction.
    assert!(free
        .verdict
        .detail()
        .contains("where M = 0, every motion does"));
    let defined = |text: &Text, name: &str, value: &str| {
        let mut own = system(text);
        own.definitions = vec![(expr(&own.graph, name), expr(&own.graph, value))];
        finding(&own, STATIONARY).verdict.detail().to_string()
    };
    let detail = defined(&massive, "M", "m");
    assert!(detail.contains("only where x' = 0 or y' = 0"), "{detail}");
    assert!(!detail.contains("every motion does"), "{detail}");
    let slope = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - a y x' - b x y'")],
    );
    let detail = defined(&slope, "b", "k a");
    for says in [
        "where k = 1, every",
        "where k = -1, every",
        "where a = 0, every",
    ] {
        assert!(detail.contains(says), "{detail}");
    }
}

/// z' = h x', h = u + 2 sin u, has A = h' = 1 + 2 cos u, which vanishes at angles that are not looked up: u is constant there, so that
/// u' = 0, and these motions are among those found.
#[test]
fn a_function_of_one_coordinate_that_vanishes() {
    let stated = text(
        "x u z",
        "1/2 (x'^2 + u'^2 + z'^2)",
        &[("c", "z' - (u + 2 sin(u)) x'")],
    );
    let found = finding(&system(&stated), STATIONARY);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "conditional", "{detail}");
    assert!(detail.contains("only where x' = 0 or u' = 0"), "{detail}");
}

/// With a shift of the constraint, z' = y x' + b: λ = x'y'/(1 + y²) as before, and κ = 0 for the same motions.
#[test]
fn affine_particle() {
    let affine = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2)",
        &[("c", "z' - y x' - b")],
    );
    assert_condition(&affine, STATIONARY, "x' = 0 or y' = 0");
}

/// y' = t x' with L = (x'² + y'²)/2: E[f]·δq = −δx x-component … = δx only, so κ = 0, and λ = x'/(1 + t²) = 0 leaves rest.
#[test]
fn rheonomic_constraint() {
    let moving = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y' - t x'")]);
    let found = finding(&system(&moving), STATIONARY);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "refuted", "{detail}");
    assert!(detail.contains("except rest where x' = 0"), "{detail}");
}

/// cosh of both velocities, which a cubic constraint relates: with a = 3x'² + 1 and b = 3y'² + 1 the motion is x'' = b s,
/// y'' = −a s, where s ((1 + cosh x') b² + cosh y' a²) = −b does not vanish. E[f]·δq = 0 demands κ s (x' b² + y' a²) = 0, whence κ = 0, and
/// λ = −cosh y' a s/b is not zero. No motion is stationary.
#[test]
fn functions_of_velocities_that_no_formula_relates() {
    let cubic = text(
        "x y",
        "x'^2/2 + cosh(x') + cosh(y') - x",
        &[("c", "x'^3 + x' + y'^3 + y' - 3")],
    );
    let found = finding(&system(&cubic), STATIONARY);
    assert_eq!(
        found.verdict.word(),
        "refuted",
        "{}",
        found.verdict.detail()
    );
    let inclusion = finding(&system(&cubic), "formulation.vakonomic-coincides#inclusion");
    assert_eq!(
        inclusion.verdict.word(),
        "refuted",
        "{}",
        inclusion.verdict.detail()
    );
}

/// κ by name, in closed form.
#[track_caller]
fn assert_kappa(stated: &Text, expected: &[(&str, &str)], says: &str) {
    let system = system(stated);
    let found = finding(&system, STATIONARY);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains(says), "{detail}");
    let g = &system.graph;
    for (name, value) in expected {
        let symbol = g.symbol(name, 0);
        let shown = found
            .formulas
            .iter()
            .find(|f| f.left == Some(symbol))
            .unwrap();
        let difference = [g.sub(shown.right, expr(g, value))];
        let verdict = with_context(&system, |cx| {
            cx.prover.identity(&system, &difference, &manifold(cx), "")
        });
        assert_eq!(verdict.word(), "proved", "{name} = {}", g.text(shown.right));
    }
}

#[test]
fn multipliers_in_closed_form() {
    let disc = [("kappa_rolling_x", "-m x'"), ("kappa_rolling_y", "-m y'")];
    assert_kappa(&DISC, &disc, "κ is unique");
    let cone = [("kappa_cone", "m sqrt(x'^2 + y'^2)/a + const_cone")];
    assert_kappa(&CONE, &cone, "every κ(0) serves");
    // On z' = x', w' = z x' with a plane potential: λ_g = 0 and κ_f' = −x' κ_g − λ_f, where λ_f = −m x''; u_w is x'.
    let chain = text(
        "x y z w",
        "1/2 m (x'^2 + y'^2 + (1 + z^2) z'^2)",
        &[("f", "z' - x'"), ("g", "w' - z x'")],
    );
    let both = [
        ("kappa_f", "const_f - const_g x + m u_w"),
        ("kappa_g", "const_g"),
    ];
    assert_kappa(&chain, &both, "2 constants of κ(0) are free");
    // The multiplier of μ f is that of f over μ; m x'' = −μ λ.
    let scaled = text(
        "x y z",
        "1/2 m (x'^2 + y'^2 + z'^2) - m g z",
        &[("c", "exp(y) (z' - x')")],
    );
    let kappa = [("kappa_c", "(const_c + m x') exp(-y)")];
    assert_kappa(&scaled, &kappa, "every κ(0) serves");
    // κ' = −λ with D(κ + m z') = −m g.
    let integrable = [("kappa_c", "-m z' - m g t + const_c")];
    assert_kappa(&INTEGRABLE, &integrable, "every κ(0) serves");
}

/// θ A vanishes identically for S2, on the motions of S3, not for S1.
#[test]
fn suslovs_condition() {
    for (stated, word, says) in [
        (&DISC, "proved", "identically"),
        (&CONE, "proved", "on every motion"),
        (&INTEGRABLE, "proved", "identically"),
    ] {
        let found = finding(&system(stated), SUSLOV);
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), word, "{detail}");
        assert!(detail.contains(says), "{detail}");
    }
    let found = finding(&system(&LEVEL_SKATE), SUSLOV);
    assert_eq!(found.verdict.word(), "conditional");
}

/// Without an action, and without constraints.
#[test]
fn hypotheses() {
    let pushed = Text {
        forces: &[("x", "-x'")],
        ..PARTICLE
    };
    for id in [STATIONARY, SUSLOV] {
        let found = finding(&system(&pushed), id);
        let Verdict::NotApplicable { hypothesis, .. } = &found.verdict else {
            panic!("{:?}", found.verdict)
        };
        assert_eq!(hypothesis, "model.forces-absent");
    }
    let found = finding(&system(&text("x", "x'^2 - x^2", &[])), STATIONARY);
    assert_eq!(found.verdict.word(), "proved");
}

/// The constraint written with a factor, with the sides exchanged, or redundantly: the same motions.
#[test]
fn rewritten_constraints() {
    let particle = "1/2 (x'^2 + y'^2 + z'^2)";
    for constraints in [
        &[("c", "(1 + x^2) (y x' - z')")][..],
        &[("c", "z' - y x'"), ("twice", "2 z' - 2 y x'")][..],
    ] {
        let rewritten = Text {
            constraints,
            ..text("x y z", particle, &[])
        };
        assert_condition(&rewritten, STATIONARY, "x' = 0 or y' = 0");
    }
}

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

/// θ A = 0 at rest whatever the position, where nothing else asks for a position: z' = y x' with L + y z' has
/// θ = z' + y, so θ A = (z' + y)(y', −x'), which vanishes at rest for every y. By hand: λ = 0 at rest, so that rest is a motion.
#[test]
fn rest_satisfies_suslovs_condition() {
    let gyroscopic = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) + y z'",
        &[("c", "z' - y x'")],
    );
    let found = finding(&system(&gyroscopic), SUSLOV);
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{}: {}", found.verdict.word(), found.verdict.detail())
    };
    assert!(
        condition.contains("x' = 0 and y' = 0"),
        "{condition}: {}",
        found.verdict.detail()
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

/// An integrable constraint behind a factor, with a potential: E_z[f] = −e^x x', so D(e^x κ) = −e^x λ = −(z'' + g).
#[test]
fn multipliers_of_an_integrable_constraint_with_a_factor() {
    let lagrangian = "1/2 (x'^2 + y'^2 + z'^2) - g z + B (x y' - y x')";
    let stated = text("x y z", lagrangian, &[("c", "exp(x) (z' - y x' - x y')")]);
    let kappa = [("kappa_c", "(const_c - z' - g t) exp(-x)")];
    assert_kappa(&stated, &kappa, "every κ(0) serves");
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

/// On the cone z'² = x'² + y'² with V = x motions along ± the slope alone are stationary, as for z' = √(x'² + y'²), where it is
/// y' = 0: a constraint that stays implicit in z' has both signs of z'.
#[test]
fn a_cone_that_stays_implicit() {
    let lagrangian = "1/2 (x'^2 + y'^2 + z'^2) - x";
    let stated = text("x y z", lagrangian, &[("c", "z'^2 - x'^2 - y'^2")]);
    // z' = x' and z' = -x' are both branches of the constraint.
    let both = "y' = 0";
    assert_condition(&stated, STATIONARY, both);
    // Suslov's terms are those of x' as a function of y' and z', which has no slopes where x' = 0.
    let with = "(with x' ≠ 0, as the constraints are solved for the dependent velocities)";
    assert_condition(&stated, SUSLOV, &format!("{both} {with}"));
}

/// What is said on a component of a product, and of exp(z' − y x') = 1, is what is said of z' = y x' itself.
#[test]
fn components_have_their_own_answer() {
    let lagrangian = "1/2 (x'^2 + y'^2 + z'^2)";
    let at = |name: &str| match name {
        "y" => Some(2.0),
        "x'" => Some(3.0),
        "z'" => Some(6.0),
        _ => None,
    };
    let own = finding(&system(&PARTICLE), STATIONARY);
    for (f, one_of_several) in [
        ("z'^2 - y^2 x'^2", true),
        ("(z' - x') (z' - y x')", true),
        ("exp(z' - y x') - 1", false),
    ] {
        let constraints = [("c", f)];
        let stated = Text {
            coordinates: "x y z",
            lagrangian,
            forces: &[],
            constraints: Box::leak(Box::new(constraints)),
        };
        let whole = system(&stated);
        let g = &whole.graph;
        let on = whole.on_component(|list| {
            let value = |s: chetaev_symbolic::Symbol| at(&g.symbol_text(s));
            g.evaluate_f64(list, &value).ok()
        });
        let on = on.unwrap();
        assert_eq!(on.condition.is_some(), one_of_several, "{f}");
        let found = finding(&on.system, STATIONARY);
        let (Verdict::Conditional { condition: a, .. }, Verdict::Conditional { condition: b, .. }) =
            (&found.verdict, &own.verdict)
        else {
            panic!("{f}: {}", found.verdict.detail())
        };
        assert_eq!(a, b, "{f}");
    }
    assert!(system(&PARTICLE).on_component(|_| None).is_none());
}

/// What is said of a constraint is said of h f with a factor h that vanishes nowhere, or where f does only: of z' = y x' divided by x', multiplied by
/// 1 + x'² or by a definite form, cubed, and of a blade whose angle is an arc tangent. Kerner's theorem is about the set, too.
#[test]
fn factors_that_change_nothing() {
    const KERNER: &str = "hamilton.kerner";
    const MULTIPLIER: &str = "chaplygin.multiplier";
    let particle = "1/2 (x'^2 + y'^2 + z'^2)";
    let both = "x' = 0 or y' = 0";
    for (f, condition, kerner) in [
        ("(1 + x'^2) (z' - y x')", both, "proved"),
        ("exp(x') (z' - y x')", both, "proved"),
        ("z'^3 - y^3 x'^3", both, "proved"),
        ("8 z'^3 + 27 y^3 x'^3", both, "proved"),
        ("(z' - y x') (x'^2 + z'^2)", both, "proved"),
        ("z'/x' - y", "y' = 0", "proved"),
        ("z'/(y x') - 1", "y' = 0", "proved"),
        (
            "atan(z'/x') - y",
            "y' = 0 (with x' = u_z cos(y), z' = u_z sin(y))",
            "proved",
        ),
    ] {
        let constraints: &'static [(&str, &str)] = Box::leak(Box::new([("c", f)]));
        let whole = system(&text("x y z", particle, constraints));
        let on = whole
            .on_component(|_| None)
            .unwrap_or_else(|| panic!("{f}"));
        assert!(on.condition.is_none(), "{f}: {:?}", on.condition);
        assert_eq!(finding(&on.system, KERNER).verdict.word(), kerner, "{f}");
        assert_eq!(
            finding(&on.system, MULTIPLIER).verdict.word(),
            "proved",
            "{f}"
        );
        let found = finding(&on.system, STATIONARY);
        let Verdict::Conditional { condition: own, .. } = &found.verdict else {
            panic!("{f}: {} {}", found.verdict.word(), found.verdict.detail())
        };
        assert_eq!(own, condition, "{f}");
    }
    // z' = F(y) with κ = 0 and λ = F' y': y' = 0, whatever F is. No denominator that has a sign is named.
    for f in [
        "log(z') - y",
        "exp(z') - y",
        "asinh(z') - y",
        "tanh(z') - y",
        "asin(z') - y",
    ] {
        let constraints: &'static [(&str, &str)] = Box::leak(Box::new([("c", f)]));
        let whole = system(&text("x y z", particle, constraints));
        let on = whole
            .on_component(|_| None)
            .unwrap_or_else(|| panic!("{f}"));
        let found = finding(&on.system, STATIONARY);
        let Verdict::Conditional { condition, .. } = &found.verdict else {
            panic!("{f}: {}", found.verdict.detail())
        };
        assert_eq!(condition, "y' = 0", "{f}");
    }
    let over = system(&text("x y z", particle, &[("c", "(z' - y x')/(1 + x'^2)")]));
    assert!(!over.on_component(|_| None).unwrap().sentence.contains('≠'));
    // A blade: y' cos z = x' sin z, with the speed u = x' cos z + y' sin z > 0. It is stationary where u z' = 0, here where z' = 0.
    let blade = system(&text("x y z", particle, &[("c", "atan2(y', x') - z")]));
    let on = blade.on_component(|_| None).unwrap();
    assert!(
        on.sentence.contains("where -pi < z and z < pi and 0 < "),
        "{}",
        on.sentence
    );
    let found = finding(&on.system, STATIONARY);
    let Verdict::Conditional {
        condition,
        counterexample,
        ..
    } = &found.verdict
    else {
        panic!("{}", found.verdict.detail())
    };
    assert!(condition.starts_with("z' = 0"), "{condition}");
    let point = &counterexample.as_ref().unwrap().point;
    let value = |name: &str| -> f64 {
        let own = point.iter().find(|p| p.name == name).unwrap();
        let text = own.enclosure.as_ref().map(|e| e.0.clone());
        text.unwrap_or_else(|| own.exact.as_ref().unwrap().to_string())
            .split('/')
            .map(|part| part.parse::<f64>().unwrap())
            .reduce(|a, b| a / b)
            .unwrap()
    };
    let (x, y, z) = (value("x'"), value("y'"), value("z"));
    assert!(
        y.atan2(x) - z < 1e-6 && z - y.atan2(x) < 1e-6,
        "{x} {y} {z}"
    );
    assert_eq!(finding(&on.system, KERNER).verdict.word(), "proved");
    // Two real factors are two components; x'² + y² z'² + 1 vanishes nowhere.
    let product = system(&text("x y z", particle, &[("c", "z'^3 - y^2 x'^2 z'")]));
    assert!(product.on_component(|_| None).unwrap().condition.is_some());
    // x' = y' = 0 is not on z' = x'.
    let apart = system(&text(
        "x y z",
        particle,
        &[("c", "(z' - x') (x'^2 + y'^2)")],
    ));
    assert!(apart.on_component(|_| None).unwrap().condition.is_some());
    let quotient = system(&text("x y z", particle, &[("c", "z' - x'^2/y'")]));
    assert!(quotient.on_component(|_| None).is_none());
}

/// A refutation says which function would have to vanish, with κ and λ: of S4 with V = 0 κ = 0, λ = x' y'/(1 + y²), and λ y' must vanish, up to its sign.
#[test]
fn a_refutation_names_its_condition() {
    let found = finding(&system(&PARTICLE), STATIONARY);
    let Verdict::Conditional { counterexample, .. } = &found.verdict else {
        panic!("{}", found.verdict.detail())
    };
    let found = counterexample.as_ref().unwrap();
    let quantity = &found.quantity;
    assert!(quantity.starts_with("-x' y'^2/(y^2 + 1), "), "{quantity}");
    assert!(
        quantity.contains("kappa_c = 0 and the reaction λ of `c` = x' y'/(y^2 + 1)"),
        "{quantity}"
    );
    let value = |name: &str| {
        let own = found.point.iter().find(|p| p.name == name).unwrap();
        own.exact
            .as_ref()
            .unwrap()
            .to_string()
            .parse::<f64>()
            .unwrap()
    };
    let (x, y, v) = (value("x'"), value("y"), value("y'"));
    let expected = -x * v * v / (1.0 + y * y);
    let (low, high): (f64, f64) = (
        found.residual.0.parse().unwrap(),
        found.residual.1.parse().unwrap(),
    );
    assert!(
        low - 1e-9 <= expected && expected <= high + 1e-9,
        "{low} {expected} {high}"
    );
}

/// What must not vanish is said once: of y x'² + x y'² = 1 with V = 0 λ is a multiple of x' y' (x' + y').
#[test]
fn what_must_not_vanish_is_said_once() {
    let stated = text("x y", "1/2 (x'^2 + y'^2)", &[("c", "y x'^2 + x y'^2 - 1")]);
    let found = finding(&system(&stated), STATIONARY);
    let Verdict::Conditional { condition, .. } = &found.verdict else {
        panic!("{}", found.verdict.detail())
    };
    for set in condition.split(", or ") {
        let texts: Vec<&str> = set.split(" and ").flat_map(|s| s.split(", ")).collect();
        let unequal = texts.iter().filter(|s| s.contains('≠'));
        let mut sorted: Vec<&&str> = unequal.clone().collect();
        sorted.sort();
        sorted.dedup();
        assert_eq!(sorted.len(), unequal.count(), "{condition}");
    }
    assert!(
        condition.contains("y' = -x', x = 1/x'^2 - y and x' ≠ 0"),
        "{condition}"
    );
}

/// A vertical disc in a magnetic field, with the force B (y', −x') on the point of contact: κ = −th' (m + B/ph') (cos ph, sin ph) has a pole
/// where ph' = 0. There the disc rolls straight on, the reaction λ = B th' (−sin ph, cos ph) would have to be −κ' while κ stays along
/// (cos ph, sin ph): of these motions only rest makes the action stationary. Without the field κ has no pole, and every motion does.
#[test]
fn motions_on_which_conditions_lose_their_rank() {
    let with = |lagrangian: &'static str| Text {
        coordinates: "th ph x y",
        lagrangian,
        forces: &[],
        constraints: &[("c", "x' - cos(ph) th'"), ("d", "y' - sin(ph) th'")],
    };
    let field = with("1/2 (th'^2 + ph'^2) + 1/2 m (x'^2 + y'^2) + B/2 (x y' - y x')");
    let system_in_field = system(&field);
    let found = finding(&system_in_field, STATIONARY);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(
        detail.starts_with("every motion with ph' ≠ 0 makes the action stationary"),
        "{detail}"
    );
    assert!(
        detail.contains("of the others only rest where") && detail.contains("th' = 0"),
        "{detail}"
    );
    let method = finding(&system_in_field, "hamilton-jacobi.applicable");
    assert!(
        method
            .verdict
            .detail()
            .starts_with("the method integrates every motion with ph' ≠ 0"),
        "{}",
        method.verdict.detail()
    );
    let none = with("1/2 (th'^2 + ph'^2) + 1/2 m (x'^2 + y'^2)");
    let found = finding(&system(&none), STATIONARY);
    let detail = found.verdict.detail();
    assert!(
        detail.starts_with("every motion makes the action stationary"),
        "{detail}"
    );
}

/// z'³ = x'³ + y'³ is symmetric in x and y, and Σ θ A vanishes where x' = 0 and where y' = 0; solved for one of these velocities it has no
/// value where that vanishes, which is said.
#[test]
fn where_suslovs_terms_have_no_value() {
    let cube = text(
        "x y z",
        "1/2 (x'^2 + y'^2 + z'^2) - z",
        &[("c", "z'^3 - x'^3 - y'^3")],
    );
    let found = finding(&system(&cube), SUSLOV);
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "conditional", "{detail}");
    assert!(
        detail.contains("as the constraints are solved for the dependent velocities"),
        "{detail}"
    );
}
