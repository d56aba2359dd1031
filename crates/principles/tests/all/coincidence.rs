//! The constrained extremum beside the motion: the table of T1 §4.3.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::{expr, finding, system, Text};
use chetaev_mechanics::claims::formulation::manifold;
use chetaev_mechanics::{Context, Prepared, Prover, Registry, System};
use chetaev_principles::stationarity::Closure;
use chetaev_symbolic::Verdict;

const fn text(
    coordinates: &'static str,
    lagrangian: &'static str,
    constraints: &'static [(&'static str, &'static str)],
) -> Text {
    Text {
        coordinates,
        lagrangian,
        forces: &[],
        constraints,
    }
}

const S1: Text = text(
    "x y phi",
    "m/2 (x'^2 + y'^2) + J/2 phi'^2 + m G x",
    &[("blade", "x' sin(phi) - y' cos(phi)")],
);
const S2: Text = text(
    "theta phi x y",
    "I/2 theta'^2 + J/2 phi'^2 + m/2 (x'^2 + y'^2)",
    &[
        ("rolling_x", "x' - R cos(phi) theta'"),
        ("rolling_y", "y' - R sin(phi) theta'"),
    ],
);
const S3: Text = text(
    "x y z",
    "m/2 (x'^2 + y'^2 + z'^2) - m g z",
    &[("cone", "z' - a sqrt(x'^2 + y'^2)")],
);
const S4: Text = text("x y z", "1/2 (x'^2 + y'^2 + z'^2)", &[("c", "z' - y x'")]);
const INTEGRABLE: Text = text(
    "x y z",
    "m/2 (x'^2 + y'^2 + z'^2) - m g z",
    &[("c", "z' - y x' - x y'")],
);

fn verdict(system: &System, subject: &str) -> Verdict {
    let full = format!("formulation.vakonomic-coincides#{subject}");
    finding(system, &full).verdict.clone()
}

#[track_caller]
fn expect(stated: &Text, of_system: &str, of_inclusion: &str) {
    let system = system(stated);
    let found = verdict(&system, "system");
    assert_eq!(found.word(), of_system, "{}", found.detail());
    let found = verdict(&system, "inclusion");
    assert_eq!(found.word(), of_inclusion, "{}", found.detail());
}

#[test]
fn table_of_coincidence() {
    expect(&S1, "refuted", "refuted");
    expect(&S2, "refuted", "proved");
    expect(&S3, "proved", "proved");
    expect(&S4, "refuted", "refuted");
    expect(&INTEGRABLE, "proved", "proved");
}

/// A proof holds off the set where the extremum is not determined (T1 §4.3: det = −m (1 + a²)(m − κ a/ρ) for S3), and the
/// sentence says so; for linear constraints there is no such set. For y' = x'² and L = x'²/2 the matrix holds 1 − 2κ.
#[test]
fn singular_sets_are_stated() {
    let bent = text("x y", "x'^2/2", &[("b", "y' - x'^2")]);
    for (stated, set) in [
        (&S3, "for every κ off the singular set"),
        (&S3, "a kappa_cone = 0;"),
        (&bent, "off the singular set 2 kappa_b - 1 = 0;"),
        (&INTEGRABLE, "the extremals are the motions, for every κ;"),
    ] {
        let found = verdict(&system(stated), "system");
        assert_eq!(found.word(), "proved", "{}", found.detail());
        assert!(found.detail().contains(set), "{}", found.detail());
    }
}

/// Where an inclusion holds is said once.
#[test]
fn the_place_of_an_inclusion_is_legible() {
    for stated in [&S2, &S3] {
        let Verdict::Proved(proof) = verdict(&system(stated), "inclusion") else {
            panic!("proved");
        };
        assert!(!proof.on.contains("everywhere and"), "{}", proof.on);
        assert_eq!(proof.on.matches("wherever").count(), 1, "{}", proof.on);
    }
}

/// The level skate, G = 0.
#[test]
fn level_skate() {
    let level = text(
        "x y phi",
        "m/2 (x'^2 + y'^2) + J/2 phi'^2",
        &[("blade", "x' sin(phi) - y' cos(phi)")],
    );
    expect(&level, "refuted", "refuted");
}

/// The closure with its context.
fn closed(stated: &Text, check: impl FnOnce(&Context<'_>, &Closure)) {
    let system = system(stated);
    let prepared = Prepared::new(&system).unwrap();
    let registry = Registry::new(&[]);
    let cx = Context::new(
        &system,
        &prepared.terms,
        &prepared.selection,
        &registry,
        Prover::default(),
    );
    check(&cx, &Closure::new(&cx).unwrap());
}

fn assert_kappa(stated: &Text, expected: &[&str]) {
    closed(stated, |cx, closure| {
        assert_eq!(closure.free, 0);
        let g = &cx.system.graph;
        for (value, text) in closure.kappa.iter().zip(expected) {
            let difference = [g.sub(value.unwrap(), expr(g, text))];
            let found = cx
                .prover
                .identity(cx.system, &difference, &manifold(cx), "");
            assert!(matches!(found, Verdict::Proved(_)), "{text}: {found:?}");
        }
    });
}

/// S2: κ = (−m x', −m y'), whatever the factor the constraints are written with: κ̂ = κ/h for f̂ = h f.
#[test]
fn multipliers_of_the_disc() {
    assert_kappa(&S2, &["-m x'", "-m y'"]);
    let rewritten = text(
        S2.coordinates,
        S2.lagrangian,
        &[
            ("rolling_x", "(2 + sin(phi)) (x' - R cos(phi) theta')"),
            ("rolling_y", "exp(x) (y' - R sin(phi) theta')"),
        ],
    );
    assert_kappa(&rewritten, &["-m x'/(2 + sin(phi))", "-m y' exp(-x)"]);
}

/// S3 and the integrable constraint: nothing is demanded of κ(0).
#[test]
fn free_constants() {
    for stated in [&S3, &INTEGRABLE] {
        closed(stated, |_, closure| {
            assert_eq!(closure.free, 1);
            assert!(closure.conditions.is_empty());
            assert_eq!(closure.kappa, [None]);
        });
    }
}

/// A disc and a particle on an integrable constraint in one system: two multipliers are determined, one constant is free.
#[test]
fn partly_free() {
    let both = text(
        "theta phi x y u v w",
        "I/2 theta'^2 + J/2 phi'^2 + m/2 (x'^2 + y'^2) + 1/2 (u'^2 + v'^2 + w'^2)",
        &[
            ("rolling_x", "x' - R cos(phi) theta'"),
            ("rolling_y", "y' - R sin(phi) theta'"),
            ("sheet", "w' - u v' - v u'"),
        ],
    );
    closed(&both, |_, closure| {
        assert!(matches!(closure.verdict, Verdict::Proved(_)));
        assert_eq!(closure.free, 1);
        assert_eq!(closure.conditions.len(), 2);
        let known: Vec<bool> = closure.kappa.iter().map(Option::is_some).collect();
        assert_eq!(known, [true, true, false]);
    });
}

/// The counterexample to the equality of systems names κ, and Kerner's theorem is quoted for linear constraints only.
#[test]
fn details() {
    let disc = system(&S2);
    let Verdict::Refuted(found) = verdict(&disc, "system") else {
        panic!("not refuted")
    };
    let names: Vec<&str> = found.point.iter().map(|p| p.name.as_str()).collect();
    assert!(
        names.iter().any(|name| name.starts_with("kappa_rolling")),
        "{names:?}"
    );
    assert!(found.detail.contains("not completely integrable"));
    let cone = verdict(&system(&S3), "system");
    assert!(cone.detail().contains("Kerner's theorem does not apply"));
    let particle = system(&S4);
    let Verdict::Refuted(found) = verdict(&particle, "inclusion") else {
        panic!("not refuted")
    };
    assert!(!found.point.is_empty());
    let value = |name: &str| {
        found
            .point
            .iter()
            .find(|p| p.name == name)
            .unwrap()
            .exact
            .clone()
    };
    // Straight motions, x' = 0 or y' = 0, are extremals.
    for name in ["x'", "y'"] {
        assert!(value(name).is_some_and(|v| v != chetaev_symbolic::Rational::from(0)));
    }
    let unique = verdict(&disc, "inclusion");
    assert!(
        unique.detail().contains("κ is unique"),
        "{}",
        unique.detail()
    );
}

/// κ of the disc is shown in closed form.
#[test]
fn formulas_of_the_disc() {
    let disc = system(&S2);
    let found = finding(&disc, "formulation.vakonomic-coincides#inclusion");
    assert_eq!(found.formulas.len(), 2);
    let g = &disc.graph;
    let expected = expr(g, "-m R cos(phi) theta'");
    assert_eq!(found.formulas[0].right, expected);
}

/// Forces beside the Lagrangian: there is no action.
#[test]
fn forces_leave_no_action() {
    let pushed = Text {
        forces: &[("x", "-x'")],
        ..S4
    };
    let pushed = system(&pushed);
    for subject in ["system", "inclusion"] {
        let found = verdict(&pushed, subject);
        let Verdict::NotApplicable { hypothesis, .. } = found else {
            panic!("{found:?}")
        };
        assert_eq!(hypothesis, "model.forces-absent");
    }
}
