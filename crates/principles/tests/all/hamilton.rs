//! Hamilton's principle in four forms: the checks of T1 §3, exact.

#![allow(clippy::unwrap_used)] // a panic is how a test fails

use crate::common::worked::{text, CONE, DISC, INTEGRABLE, LEVEL_SKATE, PARTICLE, SKATE};
use crate::common::{expr, finding, system, with_context, Text};
use chetaev_principles::hamilton::{hoelder, holds_on_motions, local_equations, suslov, voronets};
use chetaev_principles::variations::{Displacements, Variation};
use chetaev_symbolic::Verdict;

const FORMS: [&str; 4] = ["hoelder", "voronets", "suslov", "helmholtz-poincare"];

#[track_caller]
fn assert_all(stated: &Text) {
    let system = system(stated);
    let further = [
        "central-identity",
        "forms-equivalent",
        "constants",
        "endpoints",
    ];
    for form in FORMS.iter().chain(&further) {
        let found = finding(&system, &format!("hamilton.{form}"));
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "proved", "{form}: {detail}");
    }
}

#[test]
fn worked_systems() {
    for stated in [&SKATE, &DISC, &CONE, &PARTICLE, &INTEGRABLE] {
        assert_all(stated);
    }
}

/// Affine, rheonomic, redundant, implicit, forced, relativistic, of one coordinate, unconstrained.
#[test]
fn further_systems() {
    let particle = "m/2 (x'^2 + y'^2 + z'^2) - m g z";
    for stated in [
        text("x y z", particle, &[("c", "z' - y x' - b")]),
        text("x y z", particle, &[("c", "z' - y x' - t y'")]),
        text(
            "x y z",
            particle,
            &[("c", "z' - y x'"), ("twice", "2 z' - 2 y x'")],
        ),
        text("x y z", particle, &[("c", "z'^3 + z' - x' y'")]),
        text("x y", "-m sqrt(1 - x'^2 - y'^2)", &[("c", "y' - x x'")]),
        text("q", "m/2 q'^2 - V cos(q) t", &[]),
        text("x y", "1/2 (x'^2 + y'^2) + x y' t", &[]),
    ] {
        assert_all(&stated);
    }
    let forced = Text {
        forces: &[("x", "-k x'"), ("z", "t y")],
        ..PARTICLE
    };
    assert_all(&forced);
}

/// The covector of a form on the jet of the chart.
#[track_caller]
fn assert_local(
    stated: &Text,
    form: fn(&Displacements<'_>) -> Variation,
    expected: &[(&str, &str)],
) {
    let system = system(stated);
    with_context(&system, |cx| {
        let g = &cx.system.graph;
        let d = Displacements::new(cx).unwrap();
        let local = local_equations(cx, &d, &form(&d));
        for &(name, value) in expected {
            let of = |&i: &usize| cx.system.coordinates[i].name == name;
            let s = d.chart.independent.iter().position(of).unwrap();
            let value = d.chart.on_jet(cx.system, &[expr(g, value)])[0];
            let verdict =
                cx.prover
                    .identity(cx.system, &[g.sub(local[s], value)], d.manifold(), "");
            assert_eq!(verdict.word(), "proved", "{name}: {}", verdict.detail());
        }
    });
}

/// S4: (1 + y²) x'' + y x'y' = 0 and y'' = 0 by all three, with the sign of `E[L]`.
#[test]
fn local_equations_of_the_particle() {
    for form in [hoelder::integrand, voronets::integrand, suslov::integrand] {
        let expected = [("x", "-(1 + y^2) x'' - y x' y'"), ("y", "-y''")];
        assert_local(&PARTICLE, form, &expected);
    }
}

/// S2: (I + m R²) θ'' = 0, J φ'' = 0.
#[test]
fn local_equations_of_the_disc() {
    for form in [hoelder::integrand, voronets::integrand, suslov::integrand] {
        let expected = [("theta", "-(I + m R^2) theta''"), ("phi", "-J phi''")];
        assert_local(&DISC, form, &expected);
    }
}

/// S4 without θ A: Lagrange's equations for L*, (1 + y²) x'' + 2 y x'y' = 0 and y'' − y x'² = 0, are no equations of motion.
#[test]
fn dropped_terms_are_refuted() {
    let expected = [("x", "-(1 + y^2) x'' - 2 y x' y'"), ("y", "-y'' + y x'^2")];
    assert_local(&PARTICLE, suslov::without_terms, &expected);
    let lagrange_of_restricted =
        |d: &Displacements<'_>| d.vary(&[d.restricted_lagrangian()]).swap_remove(0);
    assert_local(&PARTICLE, lagrange_of_restricted, &expected);
    for (stated, word) in [
        (&PARTICLE, "refuted"),
        (&LEVEL_SKATE, "refuted"),
        // Its terms cancel: θ A = 0 though A ≠ 0.
        (&DISC, "proved"),
        (&INTEGRABLE, "proved"),
    ] {
        let system = system(stated);
        with_context(&system, |cx| {
            let d = Displacements::new(cx).unwrap();
            let local = local_equations(cx, &d, &suslov::without_terms(&d));
            let verdict = holds_on_motions(cx, &d, &local).unwrap();
            assert_eq!(verdict.word(), word, "{}", verdict.detail());
        });
    }
}

/// A wrong sign of θ A is refuted with a state where x' y ≠ 0, as (1 + y²) x'' + 3 y x'y' is wrong there.
#[test]
fn a_wrong_sign_is_refuted_at_a_state() {
    let system = system(&PARTICLE);
    with_context(&system, |cx| {
        let d = Displacements::new(cx).unwrap();
        let wrong = d.difference(&suslov::without_terms(&d), &d.gyroscopic());
        let local = local_equations(cx, &d, &wrong);
        let Verdict::Refuted(found) = holds_on_motions(cx, &d, &local).unwrap() else {
            panic!("not refuted")
        };
        // What does not vanish is named, with its value and the state.
        let factor = "the factor of δx with the accelerations of the motion put in";
        assert!(found.quantity.starts_with(factor), "{}", found.quantity);
        assert!(found.detail.contains("does not vanish: it"));
        for name in ["y", "x'"] {
            let value = found.point.iter().find(|p| p.name == name).unwrap();
            assert_ne!(
                value.exact,
                Some(chetaev_symbolic::Rational::from(0)),
                "{name}"
            );
        }
    });
}

/// The form of Helmholtz and Poincaré needs H.
#[test]
fn without_a_hamiltonian() {
    let singular = system(&text("x y", "x'^2/2", &[("c", "y' - x x'")]));
    let found = finding(&singular, "hamilton.helmholtz-poincare");
    let Verdict::NotApplicable { hypothesis, .. } = &found.verdict else {
        panic!("{:?}", found.verdict)
    };
    assert_eq!(hypothesis, "model.hessian-regular");
    let found = finding(&singular, "hamilton.forms-equivalent");
    let detail = found.verdict.detail();
    assert_eq!(found.verdict.word(), "proved", "{detail}");
    assert!(detail.contains("no form of Helmholtz"), "{detail}");
}

/// The fourth integrand differs by Σ δp (Dq − ∂H/∂p), the others by 0.
#[test]
fn differences_are_printed() {
    let system = system(&PARTICLE);
    let found = finding(&system, "hamilton.forms-equivalent");
    let g = &system.graph;
    let shown: Vec<String> = found.formulas.iter().map(|f| g.text(f.right)).collect();
    assert_eq!(&shown[..2], ["0", "0"]);
    let expected = expr(
        g,
        "delta_p_x (Dq_x - p_x) + delta_p_y (Dq_y - p_y) + delta_p_z (Dq_z - p_z)",
    );
    let verdict = with_context(&system, |cx| {
        let difference = [g.sub(found.formulas[2].right, expected)];
        cx.prover
            .identity(&system, &difference, &Default::default(), "")
    });
    assert_eq!(verdict.word(), "proved", "{}", shown[2]);
}

/// 2n − r and 2n constants; k dimensions reached.
#[test]
fn constants_and_ends() {
    for (stated, own, of_extremum, reached) in [
        (&SKATE, "5 constants", "has 6", "2 dimensions"),
        (&DISC, "6 constants", "has 8", "2 dimensions"),
    ] {
        let system = system(stated);
        let found = finding(&system, "hamilton.constants");
        let detail = found.verdict.detail();
        assert!(
            detail.contains(own) && detail.contains(of_extremum),
            "{detail}"
        );
        let found = finding(&system, "hamilton.endpoints");
        assert!(found.verdict.detail().contains(reached));
    }
}

/// Kerner's theorem, for linear and affine constraints only.
#[test]
fn kerner() {
    let affine = text("x y z", "x'^2 + y'^2 + z'^2", &[("c", "z' - y x' - b")]);
    for (stated, says) in [
        (&SKATE, "not integrable"),
        (&DISC, "not integrable"),
        (&affine, "not integrable"),
        (&INTEGRABLE, "are integrable"),
    ] {
        let found = finding(&system(stated), "hamilton.kerner");
        let detail = found.verdict.detail();
        assert_eq!(found.verdict.word(), "proved", "{detail}");
        assert!(detail.contains(says), "{detail}");
    }
    let found = finding(&system(&CONE), "hamilton.kerner");
    assert_eq!(found.verdict.word(), "not-applicable");
}

/// A constraint on positions leaves one position less: the pendulum x² + y² = 1 has an angle and its rate. The sphere of a redundant pair
/// counts once.
#[test]
fn constants_of_held_positions() {
    let plane = "1/2 (x'^2 + y'^2) - y";
    let once = text("x y", plane, &[("c", "x^2 + y^2 - 1")]);
    let twice = text(
        "x y",
        plane,
        &[("c", "x^2 + y^2 - 1"), ("d", "2 x^2 + 2 y^2 - 2")],
    );
    for stated in [&once, &twice] {
        let found = finding(&system(stated), "hamilton.constants");
        let detail = found.verdict.detail();
        assert!(
            detail.contains("2 constants: 1 position, 1 velocity"),
            "{detail}"
        );
    }
}
