//! Witnesses on motions of the gallery, and what they say of deliberate errors.

use super::least_action::{among_admissible, Action, Varied};
use super::operators::Imposed;
use super::other_time::{chaplygin, jacobi, parametric};
use super::refined::{worst, Refined, Rule, STRIDES};
use super::second_kind::Curve;
use super::wave::Wave;
use crate::registry::registry;
use crate::{study, ClaimSelection, Hooks, StudyOptions};
use chetaev_mechanics::{Context, Prover};
use chetaev_model::{load, Model, NoFiles};
use chetaev_principles::second_kind::Ends;
use chetaev_principles::universal_relation::operator;
use std::path::Path;

fn gallery(name: &str) -> Model {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
    let text = std::fs::read_to_string(folder.join(name).join("model.toml")).expect("the model");
    written(&text)
}

fn written(text: &str) -> Model {
    load("model.toml", text, &NoFiles, &[])
        .model
        .expect("a model")
}

/// Asks something of the computed motion of a model.
fn along<T>(model: Model, ask: impl FnOnce(&Context<'_>) -> T) -> T {
    let words = ["motion.constraint-drift", "witness.endpoints"];
    let options = StudyOptions {
        claims: ClaimSelection {
            words: words.map(String::from).to_vec(),
        },
        global_error: false,
        // The distance of the rows follows from the steps of the motion: close ones leave the quadrature little.
        tolerance: Some(1e-13),
        ..StudyOptions::default()
    };
    let clock = || 0.0;
    let mut progress = |_: &str, _: Option<f64>| {};
    let mut hooks = Hooks {
        clock: &clock,
        interrupt: None,
        progress: &mut progress,
    };
    let done = study(model, options, &mut hooks).expect("a study");
    let evidence = &done.motion.as_ref().expect("a motion").evidence;
    let known = registry();
    let (terms, selection) = (&done.prepared.terms, &done.prepared.selection);
    let cx = Context::new(&done.system, terms, selection, &known, Prover::default());
    ask(&cx.with(evidence.clone()))
}

/// It goes to zero, with the fourth order of the step or a higher one, from where it is small until rounding and the error of the
/// motion.
#[track_caller]
fn vanishes(found: &Result<Refined, String>, what: &str) {
    let found = found.as_ref().expect(what);
    assert!(found.residuals[0] < 4e-7, "{what}: {found:?}");
    // The longest steps, sixteen rows, need not have come to the limit.
    let clear = found.residuals[..STRIDES.len() - 1]
        .windows(2)
        .filter(|r| r[0] > 1e-8 && r[1] < 1e-5);
    for pair in clear {
        assert!(pair[1] > 12.0 * pair[0], "{what}: {found:?}");
    }
}

/// It does not go to zero, and does not change with the step.
#[track_caller]
fn stays(found: &Result<Refined, String>, what: &str) {
    let found = found.as_ref().expect(what);
    assert!(found.residuals[0] > 1e-3, "{what}: {found:?}");
    assert!(found.change < 0.1 * found.residuals[0], "{what}: {found:?}");
}

/// An action with random variations, after something was made wrong.
fn action(cx: &Context<'_>, action: Action, spoil: fn(&mut Varied)) -> Result<Refined, String> {
    let mut varied = Varied::new(cx, action)?;
    spoil(&mut varied);
    let span = varied.span()?;
    worst(|generator| {
        let waves: Vec<Wave> = (0..=cx.system.n())
            .map(|_| match action.rule() {
                Rule::Open => Wave::free(generator),
                Rule::Vanishing => Wave::vanishing(generator),
            })
            .collect();
        varied.integral(&span, &waves)
    })
}

/// Lagrange's and Jacobi's actions of curves beside motions of fixed energy, linear, nonlinear and gyroscopic; at the times of the
/// motion instead of its energy Lagrange's action changes, and with another energy Jacobi's.
#[test]
fn least_action_at_fixed_energy() {
    // Without forces and L₁ the times do not matter; the path is that of every energy there, and where it is a straight line.
    let systems = [
        ("skate-incline", [true, true]),
        ("vertical-rolling-disc", [false, false]),
        ("appell-hamel", [true, false]),
        ("chaplygin-sleigh", [false, false]),
        ("particle-y-dx", [false, false]),
        ("charged-particle", [true, true]),
    ];
    for (name, [by_times, by_energy]) in systems {
        along(gallery(name), |cx| {
            for which in [Action::Lagrange, Action::Jacobi] {
                let found = action(cx, which, |_| ());
                vanishes(&found, &format!("{name} {}", which.word()));
            }
            if by_times {
                let wrong = action(cx, Action::Lagrange, |varied| varied.keeps_times = true);
                stays(&wrong, name);
            }
            if by_energy {
                let wrong = action(cx, Action::Jacobi, |varied| varied.energy += 1.0);
                stays(&wrong, name);
            }
        });
    }
}

/// Among curves that satisfy the constraints both actions are stationary exactly where Hamilton's is (T1 §4.3, §5.3, §5.4): on all
/// motions of the disc, of Appell and Hamel's system and without constraints, not on those that turn of the skate and the particle.
#[test]
fn least_action_among_admissible_curves() {
    let systems = [
        ("vertical-rolling-disc", true),
        ("appell-hamel", true),
        ("charged-particle", true),
        ("skate-incline", false),
        ("chaplygin-sleigh", false),
        ("particle-y-dx", false),
    ];
    for (name, is_stationary) in systems {
        along(gallery(name), |cx| {
            for which in [Action::Lagrange, Action::Jacobi] {
                let found = among_admissible(cx, which).expect(name);
                let what = format!("{name} {}: {found:?}", which.word());
                match is_stationary {
                    true => assert!(found.change.max(found.error) < 1e-7, "{what}"),
                    false => assert!(found.change > 1e-3, "{what}"),
                }
                // Doubled steps change it by little.
                assert!(found.error < 1e-7 + 0.01 * found.change, "{what}");
            }
        });
    }
}

/// With times that vary: ends that move leave `[−H Δt + Σ p Δq]`, which has to be subtracted.
#[test]
fn actions_at_varied_times() {
    for name in [
        "skate-incline",
        "appell-hamel",
        "sand-cart",
        "moving-knife-edge",
    ] {
        along(gallery(name), |cx| {
            for which in [Action::Identity, Action::Parametric] {
                let found = action(cx, which, |_| ());
                vanishes(&found, &format!("{name} {}", which.word()));
            }
            let wrong = action(cx, Action::Identity, |varied| varied.without_ends = true);
            stays(&wrong, name);
        });
    }
}

/// Zhu's principles with each condition at the ends; free ends without their term, and velocities that are not those of the
/// motion, are refuted.
#[test]
fn principles_of_the_second_kind() {
    let systems = [
        "skate-incline",
        "vertical-rolling-disc",
        "appell-hamel",
        "chaplygin-sleigh",
        "sand-cart",
        "relativistic-particle",
    ];
    for name in systems {
        along(gallery(name), |cx| {
            let mut curve = Curve::new(cx).expect("a curve");
            vanishes(&curve.differential(), name);
            for ends in Ends::ALL {
                vanishes(&curve.integral(ends), &format!("{name} {}", ends.word()));
            }
            curve.without_ends = true;
            stays(&curve.integral(Ends::Free), name);
            vanishes(&curve.integral(Ends::HalfFixed), name);
            curve.faster = 1.1;
            stays(&curve.differential(), name);
            stays(&curve.integral(Ends::Fixed), name);
        });
    }
}

/// Each operator on all and on some velocities; without `Σ p (D(δq) − δv)` that with A = 0 is no principle.
#[test]
fn operators_do_not_matter() {
    let damped = written(
        "coordinates = [\"q\", \"s\"]\nlagrangian = \"(q'^2 + s'^2 - q^2 - 2 s^2)/2\"\n\
         forces = { q = \"-q'/5\", s = \"-s'/3\" }\n\
         [initial]\nq = 1\n\"q'\" = 0.3\ns = 0\n\"s'\" = 1\n\
         [variation.half]\nq = \"delta_q' + t delta_s\"\n\
         [simulation]\nt_end = 3\ntolerance = 1e-11\n",
    );
    let of = |cx: &Context<'_>, name: &str, bare: bool| {
        let operator = operator(cx, name).expect("derived").expect("an operator");
        let mut imposed = Imposed::new(cx, name, &operator).expect("a motion");
        imposed.bare = bare;
        (imposed.found(), imposed.spread)
    };
    for name in ["skate-incline", "vertical-rolling-disc", "appell-hamel"] {
        along(gallery(name), |cx| {
            for which in ["zero", "hoelder", "suslov"] {
                let (found, spread) = of(cx, which, false);
                vanishes(&found, &format!("{name} {which}"));
                assert!(spread < 1e-9, "{name} {which}: {spread}");
            }
            stays(&of(cx, "zero", true).0, name);
        });
    }
    along(damped, |cx| {
        for which in ["zero", "hoelder", "suslov", "vujanovic", "half"] {
            let (found, spread) = of(cx, which, false);
            vanishes(&found, which);
            assert!(spread < 1e-9, "{which}: {spread}");
        }
        stays(&of(cx, "zero", true).0, "zero");
    });
}

/// Chaplygin's, Jacobi's and the parametric equations integrated in τ; with t(τ) at another rate, or t'' left out of the
/// equations of the coordinates, they give other motions.
#[test]
fn equations_in_another_time() {
    for name in ["skate-incline", "skate-level", "particle-y-dx"] {
        along(gallery(name), |cx| {
            vanishes(&chaplygin(cx, 1.0), name);
            stays(&chaplygin(cx, 1.1), name);
        });
    }
    for name in [
        "skate-incline",
        "appell-hamel",
        "charged-particle",
        "vertical-rolling-disc",
    ] {
        along(gallery(name), |cx| {
            vanishes(&jacobi(cx, 1.0), name);
            stays(&jacobi(cx, 1.1), name);
        });
    }
    for name in [
        "skate-incline",
        "appell-hamel",
        "chaplygin-sleigh",
        "moving-knife-edge",
    ] {
        along(gallery(name), |cx| {
            vanishes(&parametric(cx, 1.0), name);
            stays(&parametric(cx, 0.0), name);
        });
    }
}
