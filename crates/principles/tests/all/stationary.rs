//! Stationary action: the table of T1 §4.3, with κ and the subsets of motions in closed form.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

mod subsets;

use crate::common::worked::{text, CONE, DISC, INTEGRABLE, LEVEL_SKATE, PARTICLE, SKATE};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::components::Stratum;
use chetaev_mechanics::system::Parameter;
use chetaev_mechanics::System;
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

/// An integrable constraint behind a factor, with a potential: E_z[f] = −e^x x', so D(e^x κ) = −e^x λ = −(z'' + g).
#[test]
fn multipliers_of_an_integrable_constraint_with_a_factor() {
    let lagrangian = "1/2 (x'^2 + y'^2 + z'^2) - g z + B (x y' - y x')";
    let stated = text("x y z", lagrangian, &[("c", "exp(x) (z' - y x' - x y')")]);
    let kappa = [("kappa_c", "(const_c - z' - g t) exp(-x)")];
    assert_kappa(&stated, &kappa, "every κ(0) serves");
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

/// The first component of constraints that are products or functions of simpler ones.
fn first(whole: &System) -> Stratum {
    whole.components().swap_remove(0)
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
        let contains_start = |on: &Stratum| {
            let value = |s: chetaev_symbolic::Symbol| at(&g.symbol_text(s));
            let values = g.evaluate_f64(&on.equations, &value).unwrap();
            values.iter().all(|x| x.abs() < 1e-12)
        };
        let mut all = whole.components().into_iter();
        let on = all.find(contains_start).unwrap();
        assert_eq!(on.condition.is_some(), one_of_several, "{f}");
        let found = finding(&on.system, STATIONARY);
        let (Verdict::Conditional { condition: a, .. }, Verdict::Conditional { condition: b, .. }) =
            (&found.verdict, &own.verdict)
        else {
            panic!("{f}: {}", found.verdict.detail())
        };
        assert_eq!(a, b, "{f}");
    }
    assert!(system(&PARTICLE).components().is_empty());
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
        let on = first(&whole);
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
        let on = first(&whole);
        let found = finding(&on.system, STATIONARY);
        let Verdict::Conditional { condition, .. } = &found.verdict else {
            panic!("{f}: {}", found.verdict.detail())
        };
        assert_eq!(condition, "y' = 0", "{f}");
    }
    let over = system(&text("x y z", particle, &[("c", "(z' - y x')/(1 + x'^2)")]));
    assert!(!first(&over).sentence.contains('≠'));
    // A blade: y' cos z = x' sin z, with the speed u = x' cos z + y' sin z > 0. It is stationary where u z' = 0, here where z' = 0.
    let blade = system(&text("x y z", particle, &[("c", "atan2(y', x') - z")]));
    let on = first(&blade);
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
    assert!(first(&product).condition.is_some());
    // x' = y' = 0 is not on z' = x'.
    let apart = system(&text(
        "x y z",
        particle,
        &[("c", "(z' - x') (x'^2 + y'^2)")],
    ));
    assert!(first(&apart).condition.is_some());
    let quotient = system(&text("x y z", particle, &[("c", "z' - x'^2/y'")]));
    assert!(quotient.components().is_empty());
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
