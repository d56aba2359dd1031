//! The variational principles of gallery models as `chetaev principles` tells them, and integrals over computed motions as a
//! witness.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::model::{load, Model, NoFiles};
use chetaev::study::witness::Form;
use chetaev::study::{study, ClaimSelection, Hooks, Study, StudyOptions};
use chetaev::symbolic::Verdict;
use chetaev_tests::places::scratch;
use chetaev_tests::program::{run, text};
use chetaev_tests::runs::{ended_text, Ask};
use chetaev_tests::studied::{gallery_path, loaded};
use chetaev_tests::words::in_parallel;

fn model(name: &str, set: &[(&str, &str)]) -> Model {
    let loaded = loaded(&gallery_path(&format!("{name}/model.toml")), set);
    loaded.model.expect("the model is right")
}

fn studied(model: Model, words: &[&str], change: impl FnOnce(&mut StudyOptions)) -> Study {
    let words = words.iter().map(|w| (*w).to_string()).collect();
    let mut options = StudyOptions {
        claims: ClaimSelection { words },
        global_error: false,
        ..StudyOptions::default()
    };
    change(&mut options);
    let clock = || 0.0;
    let mut progress = |_: &str, _: Option<f64>| {};
    let mut hooks = Hooks {
        clock: &clock,
        interrupt: None,
        progress: &mut progress,
    };
    study(model, options, &mut hooks).expect("a study")
}

const WITNESS: [&str; 5] = [
    "witness.first-variation",
    "witness.stationary",
    "witness.endpoints",
    "witness.index",
    "motion.constraint-drift",
];

fn detail<'s>(study: &'s Study, full: &str) -> (&'static str, &'s str) {
    let decided = study.verdicts.iter().find(|d| d.full_id() == full);
    let verdict = &decided
        .unwrap_or_else(|| panic!("no {full}"))
        .finding
        .verdict;
    (verdict.word(), verdict.detail())
}

/// Each form vanishes along motions, with at least the fourth order of the step until rounding; the action of admissible
/// neighbours as `hamilton.stationary` says.
#[test]
fn integrals_over_motions() {
    let systems = [
        ("skate-incline", "not stationary"),
        ("skate-level", "not stationary"),
        ("particle-y-dx", "not stationary"),
        ("vertical-rolling-disc", "the action is stationary"),
        ("appell-hamel", "the action is stationary"),
        ("chaplygin-sleigh", "not stationary"),
        ("charged-particle", "the action is stationary"),
    ];
    in_parallel(&systems, |&(name, says)| {
        let study = studied(model(name, &[]), &WITNESS, |_| ());
        let motion = study.motion.as_ref().expect("a motion");
        assert!(!motion.witness.first.is_empty(), "{name}");
        for found in &motion.witness.first {
            let (word, told) = detail(
                &study,
                &format!("witness.first-variation#{}", found.form.word()),
            );
            assert_eq!(word, "numerical", "{name}: {told}");
            assert!(found.refined.residuals[0] < 1e-8, "{name}: {found:?}");
            let clear = found.refined.residuals.windows(2).filter(|r| r[0] > 1e-9);
            for pair in clear {
                assert!(pair[1] > 16.0 * pair[0], "{name}: {found:?}");
            }
        }
        let (word, told) = detail(&study, "witness.stationary");
        assert_eq!(word, "numerical", "{name}: {told}");
        assert!(
            told.starts_with(says) || told.contains(says),
            "{name}: {told}"
        );
    });
}

/// Of the extremum, which is no motion, nothing is said.
#[test]
fn a_curve_that_is_no_motion() {
    let file = gallery_path("skate-incline/model.toml");
    let text = std::fs::read_to_string(file).expect("the model");
    let text = text.replace("[simulation]", "kappa_blade = 0\n\n[simulation]");
    let skate = load("skate.toml", &text, &NoFiles, &[]).model;
    let study = studied(skate.expect("a model"), &WITNESS, |options| {
        options.formulation = Some("vakonomic".into());
    });
    // The claims do not speak of another system.
    let (word, _) = detail(&study, "witness.first-variation#hoelder");
    assert_eq!(word, "not-applicable");
}

const OSCILLATOR: &str = r#"
name = "oscillator"
coordinates = ["q"]
parameters = { w = 2 }
lagrangian = { T = "1/2 q'^2", V = "1/2 w^2 q^2" }
initial = { q = 1, "q'" = 0 }
simulation = { t_end = 5, output = 600, tolerance = 1e-11 }
"#;

/// T1 §4.4: L = (v² − w² q²)/2 has conjugate times π/w, 2π/w, …; the free particle has none.
#[test]
fn conjugate_times_of_an_oscillator() {
    let of = |text: &str| {
        let model = load("oscillator.toml", text, &NoFiles, &[]).model;
        studied(model.expect("a model"), &WITNESS, |_| ())
    };
    let study = of(OSCILLATOR);
    let motion = study.motion.as_ref().expect("a motion");
    let found = motion.witness.conjugate.as_ref().expect("conjugate times");
    let expected: Vec<f64> = (1..=3)
        .map(|k| f64::from(k) * std::f64::consts::PI / 2.0)
        .collect();
    assert_eq!(found.times.len(), 3, "{found:?}");
    for (a, b) in found.times.iter().zip(expected) {
        assert!((a - b).abs() < 1e-8, "{found:?}");
    }
    let (_, told) = detail(&study, "witness.index");
    assert!(told.contains("index 3"), "{told}");
    let free = of(&OSCILLATOR.replace("w = 2", "w = 0"));
    let (_, told) = detail(&free, "witness.index");
    assert!(told.contains("no conjugate time"), "{told}");
    // Focal times of the motions from one point are the same: t = 5 is none, and t = 3π/2 is one.
    let (_, told) = detail(&study, "witness.endpoints");
    assert!(told.contains("rank 1 "), "{told}");
    let focal = of(&OSCILLATOR.replace("t_end = 5", "t_end = \"3 pi/2\""));
    let (_, told) = detail(&focal, "witness.endpoints");
    assert!(told.contains("rank less than 1"), "{told}");
}

/// Frequencies 1 and 2, also in coordinates turned by 45°: at t = π/2 the faster one is back, whatever the coordinates.
#[test]
fn focal_times_do_not_depend_on_coordinates() {
    let end = |potential: &str| {
        let text = OSCILLATOR
            .replace("[\"q\"]", "[\"q\", \"s\"]")
            .replace("1/2 q'^2", "1/2 (q'^2 + s'^2)")
            .replace("1/2 w^2 q^2", potential)
            .replace("\"q'\" = 0", "\"q'\" = 0, s = 1/2, \"s'\" = 0")
            .replace("t_end = 5", "t_end = \"pi/2\"");
        let text = text.replace("s = 1/2", "s = 0.5");
        let model = load("oscillators.toml", &text, &NoFiles, &[]).model;
        let study = studied(model.expect("a model"), &WITNESS, |_| ());
        detail(&study, "witness.endpoints").1.to_string()
    };
    let straight = end("1/2 (q^2 + w^2 s^2)");
    assert!(straight.contains("rank less than 2"), "{straight}");
    let turned = end("1/4 ((q + s)^2 + w^2 (q - s)^2)");
    assert!(turned.contains("rank less than 2"), "{turned}");
}

/// Great circles of the unit sphere meet again after half a turn, whether the sphere is stated by a rate or not at all; and motions
/// x' = 0 beside z' = y x' with V = y²/2 are oscillations with κ = 0.
#[test]
fn conjugate_times_on_a_leaf_and_on_a_set() {
    let of = |potential: &str, constraint: &str, initial: &str| {
        let text = format!(
            "coordinates = [\"x\", \"y\", \"z\"]\n\
             lagrangian = \"1/2 (x'^2 + y'^2 + z'^2){potential}\"\n\
             constraints = {{ c = \"{constraint}\" }}\n\
             initial = {{ {initial} }}\n\
             simulation = {{ t_end = 4, output = 600, tolerance = 1e-11 }}\n"
        );
        let model = load("leaf.toml", &text, &NoFiles, &[]).model;
        let study = studied(model.expect("a model"), &WITNESS, |_| ());
        let found = study
            .motion
            .as_ref()
            .and_then(|m| m.witness.conjugate.clone());
        let times = found.expect("conjugate times").times;
        assert_eq!(times.len(), 1, "{times:?}");
        assert!((times[0] - std::f64::consts::PI).abs() < 1e-6, "{times:?}");
        detail(&study, "witness.index").1.to_string()
    };
    let sphere = "x x' + y y' + z z' = 0";
    let start = "x = 1, y = 0, z = 0, \"x'\" = 0, \"y'\" = 1, \"z'\" = 0";
    let told = of("", sphere, start);
    assert!(told.starts_with("among the curves on the leaf"), "{told}");
    let start = "x = 0, y = 1, z = 0, \"x'\" = 0, \"y'\" = 0";
    let told = of(" - 1/2 y^2", "z' = y x'", start);
    assert!(
        told.starts_with("on the set of stationary motions"),
        "{told}"
    );
}

/// The rolling disc is a minimum on a short interval, and its index is stated with its unique κ.
#[test]
fn the_index_of_the_disc() {
    let study = studied(model("vertical-rolling-disc", &[]), &WITNESS, |_| ());
    let (word, told) = detail(&study, "witness.index");
    assert_eq!(word, "numerical", "{told}");
    // Of Appell and Hamel's system κ is not unique.
    let study = studied(model("appell-hamel", &[]), &WITNESS, |_| ());
    let (word, told) = detail(&study, "witness.index");
    assert_eq!(word, "undecided", "{told}");
    assert!(told.contains("not unique"), "{told}");
}

fn made_up(text: &str) -> Model {
    let loaded = load("model.toml", text, &NoFiles, &[]).into_result();
    loaded.unwrap_or_else(|_| panic!("{text}")).0
}

/// Appell and Hamel's system with a stated κ(0) = m s/ρ + C (T1 §4.4): across the motion BᵀF_vv B is −C ρ/s, so that C < 0 gives a
/// weak minimum and C > 0 negative directions on every interval, which prove nothing, since κ may be changed without the curve.
#[test]
fn the_index_of_a_stated_multiplier() {
    let of = |kappa: &str| {
        let text = format!(
            "coordinates = [\"x\", \"y\", \"z\"]\nparameters = {{ m = 2, a = 0.5, g = 3 }}\n\
             lagrangian = \"1/2 m (x'^2 + y'^2 + z'^2) - m g z\"\n\
             constraints = {{ cone = \"z' = a sqrt(x'^2 + y'^2)\" }}\n\
             [initial]\nx = 0\ny = 0\nz = 0\n\"x'\" = 3\n\"y'\" = 4\n{kappa}\n\
             [simulation]\nt_end = 1\noutput = 600\ntolerance = 1e-11\n"
        );
        studied(made_up(&text), &WITNESS, |_| ())
    };
    // m s/a = 20.
    let least = of("kappa_cone = 19");
    let (word, told) = detail(&least, "witness.index");
    assert_eq!(word, "numerical", "{told}");
    for part in [
        "with kappa_cone(0) = 19 as stated",
        "weak minimum, its index 0",
        "abnormal: 1 independent variation of κ moves no coordinate",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let unused = least.notices.iter().any(|said| said.contains("kappa_cone"));
    assert!(!unused, "{:?}", least.notices);
    let other = of("kappa_cone = 21");
    let (word, told) = detail(&other, "witness.index");
    assert_eq!(word, "numerical", "{told}");
    for part in ["F_vv is not positive", "of the curve that says nothing"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let none = of("");
    let (word, told) = detail(&none, "witness.index");
    assert_eq!(word, "undecided", "{told}");
    assert!(told.contains("state kappa_cone under [initial]"), "{told}");
}

/// A skate that glides straight, u φ' = 0: the set is given by the speed u and the angle; κ = 0, and the action is a minimum. With κ(0) = 1
/// the motion is no extremal, and where κ is unique what is stated is not used.
#[test]
fn the_index_on_a_set_given_by_a_speed() {
    for (start, set) in [
        ("u = 0", "\"phi'\" = 1"),
        ("phi' = 0", "\"x'\" = 1\n\"phi'\" = 0"),
    ] {
        let text = format!(
            "coordinates = [\"x\", \"y\", \"phi\"]\nlagrangian = \"1/2 (x'^2 + y'^2 + phi'^2)\"\n\
             constraints = {{ blade = \"x' sin(phi) = y' cos(phi)\" }}\n\
             [initial]\nx = 0\ny = 0\nphi = 0.3\n{set}\nkappa_blade = 1\n\
             [simulation]\nt_end = 2\noutput = 600\ntolerance = 1e-11\n"
        );
        let study = studied(made_up(&text), &WITNESS, |_| ());
        let (word, told) = detail(&study, "witness.index");
        assert_eq!(word, "numerical", "{start}: {told}");
        assert!(
            told.starts_with("on the set of stationary motions"),
            "{told}"
        );
        assert!(told.contains("index 0"), "{start}: {told}");
        assert!(!told.contains("abnormal"), "{start}: {told}");
        let unused = study
            .notices
            .iter()
            .any(|said| said.contains("kappa_blade"));
        assert!(unused, "{:?}", study.notices);
    }
}

/// Witnesses speak of the system of the principles: of the component on which the motion starts, and with the law of a control. With
/// y' = 2 x' and V = 9 x²/2 the motion is an oscillation with (1 + 4) x'' = −9 x, and conjugate times are π √5/3, 2π √5/3, ….
#[test]
fn witnesses_speak_of_the_system_of_the_principles() {
    let with = |coordinates: &str, rest: &str| {
        let text = format!(
            "coordinates = {coordinates}\n{rest}\n[simulation]\nt_end = 4\noutput = 600\ntolerance = 1e-11\n"
        );
        studied(
            made_up(&text),
            &["principles", "motion.constraint-drift"],
            |_| (),
        )
    };
    let control = with(
        "[\"x\", \"y\"]",
        "controls = { u = \"2\" }\nlagrangian = \"1/2 (x'^2 + y'^2) - 9/2 x^2\"\nconstraints = { c = \"y' = u x'\" }\n\
         initial = { x = 0, y = 0, \"x'\" = 1 }",
    );
    let (word, told) = detail(&control, "witness.index");
    assert_eq!(word, "numerical", "{told}");
    assert!(
        told.starts_with("for u = 2, as the model states it"),
        "{told}"
    );
    let found = control
        .motion
        .as_ref()
        .and_then(|m| m.witness.conjugate.clone());
    let times = found.expect("conjugate times").times;
    assert_eq!(times.len(), 1, "{times:?}");
    let expected = std::f64::consts::PI * 5.0_f64.sqrt() / 3.0;
    assert!((times[0] - expected).abs() < 1e-6, "{times:?}");
    let product = with(
        "[\"x\", \"y\", \"z\"]",
        "lagrangian = \"1/2 (x'^2 + y'^2 + z'^2) - z\"\nconstraints = { c = \"(z' - y x') (z' - 2 x' - 2 y') = 0\" }\n\
         initial = { x = 0, y = 0.4, z = 0, \"x'\" = 1, \"y'\" = 0.5, \"z'\" = 3 }",
    );
    let (word, told) = detail(&product, "witness.index");
    assert_eq!(word, "numerical", "{told}");
    assert!(told.starts_with("on the component"), "{told}");
    assert!(told.contains("no conjugate time"), "{told}");
    for principle in ["identity", "lagrange", "jacobi", "parametric"] {
        let (word, told) = detail(&product, &format!("witness.action#{principle}"));
        assert_eq!(word, "numerical", "{principle}: {told}");
    }
    let (word, told) = detail(&product, "witness.hamilton-jacobi#separated");
    assert_eq!(word, "numerical", "{told}");
}

/// A disc in a magnetic field that rolls straight on: of almost every motion is proved what is not so of this one, and the witness, which
/// sees that, contradicts nothing. No index is stated for a κ that is not determined.
#[test]
fn a_motion_on_which_conditions_lose_their_rank() {
    let text = "coordinates = [\"th\", \"ph\", \"x\", \"y\"]\nparameters = { B = 0.4, m = 2 }\n\
                lagrangian = \"1/2 (th'^2 + ph'^2) + 1/2 m (x'^2 + y'^2) + B (x y' - y x')/2\"\n\
                constraints = { c = \"x' = cos(ph) th'\", d = \"y' = sin(ph) th'\" }\n\
                [initial]\n\"th'\" = 1\n\"ph'\" = 0\n[simulation]\nt_end = 1.5\noutput = 300\n";
    let words = [&WITNESS[..], &["witness.action-stationary"]].concat();
    let study = studied(made_up(text), &words, |_| ());
    let (word, told) = detail(&study, "witness.stationary");
    assert_eq!(word, "numerical", "{told}");
    assert!(
        told.contains("a lower rank than on others, the action is not stationary"),
        "{told}"
    );
    assert_eq!(study.outcome.exit_status(), 0, "{:?}", study.notices);
    let (word, told) = detail(&study, "witness.index");
    assert_eq!(word, "undecided", "{told}");
    // One that turns is an extremal.
    let turning = text.replace("\"ph'\" = 0", "\"ph'\" = 0.7");
    let study = studied(made_up(&turning), &words, |_| ());
    let (_, told) = detail(&study, "witness.stationary");
    assert!(told.starts_with("the action is stationary"), "{told}");
}

/// z' = y x' and x w' + z' = y x' + x y', which is w' = y' but where x = 0. With y = t the motion has x = 1 − arsinh t, and passes x = 0 at
/// t = sinh 1, which is said.
#[test]
fn a_rank_that_falls_on_the_way_is_said() {
    let text = "coordinates = [\"x\", \"y\", \"z\", \"w\"]\nlagrangian = \"1/2 (x'^2 + y'^2 + z'^2 + w'^2)\"\n\
                constraints = { c = \"z' = y x'\", d = \"x w' + z' = y x' + x y'\" }\n\
                [initial]\nx = 1\ny = 0\n\"x'\" = -1\n\"y'\" = 1\n[simulation]\nt_end = 2\n";
    let words = ["motion.constraint-drift"];
    let study = studied(made_up(text), &words, |_| ());
    let said = format!(
        "the rank of the constraints falls at t = {:.5}",
        1.0_f64.sinh()
    );
    assert!(
        study.notices.iter().any(|n| n.starts_with(&said)),
        "{:?}",
        study.notices
    );
    let before = studied(
        made_up(&text.replace("t_end = 2", "t_end = 1")),
        &words,
        |_| (),
    );
    assert!(
        before
            .notices
            .iter()
            .all(|n| !n.contains("rank of the constraints falls")),
        "{:?}",
        before.notices
    );
}

/// A blade that points along y all the time: x' and φ' are no independent velocities there, and y' and φ' take their place.
#[test]
fn forms_in_velocities_that_are_independent() {
    let text = "coordinates = [\"x\", \"y\", \"phi\"]\nlagrangian = \"1/2 (x'^2 + y'^2 + phi'^2) - 2 y\"\n\
                constraints = { blade = \"x' sin(phi) = y' cos(phi)\" }\n\
                [initial]\nx = 0\ny = 0\nphi = \"pi/2\"\n\"x'\" = 0\n\"y'\" = 1\n\"phi'\" = 0\n\
                [simulation]\nt_end = 2\noutput = 600\ntolerance = 1e-11\n";
    let study = studied(made_up(text), &WITNESS, |_| ());
    // φ' = 0 with cos φ = 0 is one of the sets, at every half turn.
    let (word, told) = detail(&study, "witness.index");
    assert_eq!(word, "numerical", "{told}");
    for form in ["voronets", "suslov"] {
        let (word, told) = detail(&study, &format!("witness.first-variation#{form}"));
        assert_eq!(word, "numerical", "{form}: {told}");
    }
}

/// The skate on an incline stays between two contour lines; the extremum slides down by about g t²/2 at first and on.
#[test]
fn the_skate_and_the_extremum() {
    let words = ["hamilton.stationary", "motion.constraint-drift"];
    let compared = |kappa: Vec<(String, f64)>| {
        studied(model("skate-incline", &[]), &words, |options| {
            options.extremum = Some(kappa);
        })
    };
    let study = compared(Vec::new());
    let motion = study.motion.as_ref().expect("a motion");
    let beside = motion.extremum().expect("an extremum");
    assert!(!beside.is_of_motion);
    let end = beside.run.row(beside.run.len() - 1)[0];
    let own = &motion.evidence.run;
    let farthest = (0..own.len()).map(|j| own.row(j)[0]).fold(0.0, f64::max);
    // gs/(2 W²) with gs = 4, W = 1.3.
    assert!(farthest < 4.0 / (2.0 * 1.69) + 1e-9, "{farthest}");
    assert!(end > 5.0 * farthest, "{end}");
    // Another κ(0), another extremal.
    let other = compared(vec![("kappa_blade".into(), 0.5)]);
    let other = other.motion.as_ref().and_then(|m| m.extremum().cloned());
    let other = other.expect("an extremum");
    assert!((other.run.row(other.run.len() - 1)[0] - end).abs() > 1e-3);
    // A name that is none.
    let wrong = compared(vec![("kappa_blad".into(), 0.5)]);
    let problem = wrong.motion.as_ref().and_then(|m| m.beside.clone());
    let problem = problem.expect("asked for").expect_err("a wrong name");
    assert!(problem.contains("kappa_blade"), "{problem}");
}

/// A κ(0) that the model states is used where the extremum is computed, and said to be without use elsewhere.
#[test]
fn stated_multipliers_have_their_use() {
    let text = "name = \"k\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\n\
                c = \"z' = y x'\"\n[initial]\n\"x'\" = 1\n\"y'\" = 1\nkappa_c = 2\n[simulation]\nt_end = 1\n";
    for compare in [false, true] {
        let loaded = load("model.toml", text, &NoFiles, &[]).into_result();
        let (stated, _) = loaded.unwrap_or_else(|_| panic!("{text}"));
        let study = studied(stated, &["motion.constraint-drift"], |options| {
            options.extremum = compare.then(Vec::new);
        });
        let unused = study.notices.iter().any(|said| said.contains("`kappa_c`"));
        assert_eq!(unused, !compare, "{:?}", study.notices);
    }
}

/// What is conditional has its counterexample on the page, as what is refuted has.
#[test]
fn conditional_claims_show_their_counterexample() {
    let study = studied(
        model("particle-y-dx", &[]),
        &["hamilton.stationary"],
        |_| (),
    );
    let found = &study.verdicts[0].finding.verdict;
    let Verdict::Conditional {
        counterexample: Some(found),
        ..
    } = found
    else {
        panic!("{found:?}")
    };
    let (low, _) = &found.residual;
    let html = chetaev::study::page::page(&study, None, &[]);
    assert!(html.contains(low.as_str()), "{low}");
}

/// Every motion of the disc is an extremal with the κ found: the curves are one.
#[test]
fn the_disc_is_an_extremal() {
    let words = ["motion.constraint-drift"];
    let study = studied(model("vertical-rolling-disc", &[]), &words, |options| {
        options.extremum = Some(Vec::new());
    });
    let motion = study.motion.as_ref().expect("a motion");
    let beside = motion.extremum().expect("an extremum");
    assert!(beside.is_of_motion, "{:?}", beside.kappa);
    assert!(beside.agree(motion.settings.tolerance), "{:?}", beside.gaps);
    assert!(beside.gaps.iter().all(|gap| gap.largest().1 < 1e-7));
}

#[test]
fn the_command_tells_a_story() {
    let told = run(&["principles", "gallery/particle-y-dx/model.toml", "--all"]);
    assert_eq!(told.status, Some(0), "{}", told.both());
    for words in [
        "Is the action stationary?",
        "conditional hamilton.stationary",
        "x' = 0 or y' = 0",
        "proved action.lagrange",
        "proved action.jacobi",
        "proved action.parametric",
        "conditional hamilton-jacobi.applicable",
    ] {
        assert!(told.out.contains(words), "{words}\n{}", told.out);
    }
    assert!(!told.out.contains("witness"), "{}", told.out);
    let folder = scratch("principles-compare");
    let arguments = [
        "principles",
        "gallery/skate-incline/model.toml",
        "--compare",
        "--all",
        "--out",
        text(&folder),
    ];
    let told = run(&arguments);
    assert_eq!(told.status, Some(0), "{}", told.both());
    for words in [
        "kappa_blade(0) = 0",
        "numerical witness.stationary",
        "The curves part. The largest differences are 14.94 m in y",
        "no κ(0) makes it an extremum",
    ] {
        assert!(
            unwrapped(&told.out).contains(words),
            "{words}\n{}",
            told.out
        );
    }
    let page = std::fs::read_to_string(folder.join("report.html")).expect("a report");
    for words in [
        "constrained extremum",
        "x, extremum",
        "First variations along the motion",
        "id=\"comparison\"",
        "Distance in x, y over the time",
        "Multiplier of blade at the start",
    ] {
        assert!(page.contains(words), "{words}");
    }
    for (given, words) in [
        ("kappa_blade", "NAME=VALUE"),
        ("kappa_wheel=1", "these are kappa_blade"),
    ] {
        let wrong = [&arguments[..], &["--kappa", given]].concat();
        let refused = run(&wrong);
        assert_eq!(refused.status, Some(2), "{}", refused.both());
        assert!(refused.err.contains(words), "{}", refused.err);
    }
}

/// The disc with a complete integral in its file.
#[test]
fn a_complete_integral_in_a_model() {
    let file = gallery_path("vertical-rolling-disc/model.toml");
    let text = std::fs::read_to_string(file).expect("the model");
    let constants = "E = 1\nax = 0\nay = 0\nat = 1\n\n[lagrangian]";
    let text = text.replace("\n[lagrangian]", &format!("\n{constants}"));
    let stated = r#"
[complete_integral]
S = "-E t + ax x + ay y + at theta"
constants = ["E", "ax", "ay", "at"]
quadratures = { phi = "sqrt(2 J (E - (at + R (ax cos(phi) + ay sin(phi)))^2/(2 (I + m R^2))))" }
motion = { ax = 0, ay = 0 }
"#;
    let of = |stated: &str| {
        let text = format!("{text}{stated}");
        let loaded = load("disc.toml", &text, &NoFiles, &[]);
        let words = ["hamilton-jacobi.applicable"];
        let model = loaded
            .model
            .unwrap_or_else(|| panic!("{}", loaded.diagnostics));
        studied(model, &words, |_| ())
    };
    let study = of(stated);
    let (word, told) = detail(&study, "hamilton-jacobi.applicable#stated");
    assert_eq!(word, "proved", "{told}");
    assert!(told.contains("ax = 0, ay = 0"), "{told}");
    let without = of(&stated.replace("motion = { ax = 0, ay = 0 }", ""));
    let (word, told) = detail(&without, "hamilton-jacobi.applicable#stated");
    assert_eq!(word, "refuted", "{told}");
    let wrong = of(&stated.replace("(I + m R^2)", "(I - m R^2)"));
    let (word, told) = detail(&wrong, "hamilton-jacobi.applicable#stated");
    assert_eq!(word, "refuted", "{told}");
    assert!(told.contains("the equation"), "{told}");
}

/// Kepler's problem in space, oblique; the elliptic motion passes several turning points of r and θ.
const KEPLER: &str = r#"
name = "kepler"
coordinates = ["r", "theta", "phi"]
parameters = { k = 1 }
assumptions = ["r > 0", "0 < theta < pi"]
lagrangian = { T = "1/2 (r'^2 + r^2 theta'^2 + r^2 sin(theta)^2 phi'^2)", V = "-k/r" }
initial = { r = 1, theta = 1.2, "r'" = 0.3, "theta'" = 0.4, "phi'" = 0.7 }
simulation = { t_end = 4, output = 400, tolerance = 1e-11 }
"#;

/// Two springs, one of the fourth degree, whose quadrature is elliptic.
const SPRINGS: &str = r#"
name = "springs"
coordinates = ["x", "y"]
lagrangian = { T = "1/2 (x'^2 + y'^2)", V = "x^2 + y^4" }
initial = { x = 0.2, y = 0.1, "x'" = 1, "y'" = -1.5 }
simulation = { t_end = 3, output = 300, tolerance = 1e-11 }
"#;

/// Jacobi's theorem in numbers: ∂S/∂α of the separated S, by one-dimensional quadratures, is constant along motions computed from
/// Routh's equations; for a free system, and for the rolling disc with the two constants that are zero on motions.
#[test]
fn quadratures_along_motions() {
    let words = [
        "witness.hamilton-jacobi",
        "hamilton-jacobi.applicable",
        "motion.constraint-drift",
    ];
    let written = |text: &str| load("test.toml", text, &NoFiles, &[]).model;
    let models = [
        written(KEPLER).expect("a model"),
        written(SPRINGS).expect("a model"),
        model("vertical-rolling-disc", &[]),
    ];
    for model in models {
        let name = model.name.clone();
        let study = studied(model, &words, |_| ());
        let (word, told) = detail(&study, "hamilton-jacobi.applicable#separated");
        assert_eq!(word, "proved", "{name}: {told}");
        let found = study
            .verdicts
            .iter()
            .find(|d| d.full_id() == "witness.hamilton-jacobi#separated")
            .expect("a witness");
        match &found.finding.verdict {
            Verdict::Numerical(evidence) => {
                assert!(
                    evidence.residual < 1e-8,
                    "{name}: {}",
                    evidence.why_no_proof
                );
                assert!(evidence.samples >= 20, "{name}: {}", evidence.samples);
            }
            other => panic!("{name}: {} {}", other.word(), other.detail()),
        }
    }
    // Of the gallery: what separates is met by the motion, the rest is not applicable.
    for name in [
        "heavy-top",
        "charged-particle",
        "double-pendulum",
        "rigid-body",
        "redundant-constraints",
        "appell-hamel",
        "particle-y-dx",
    ] {
        let study = studied(model(name, &[]), &words, |_| ());
        let (word, told) = detail(&study, "witness.hamilton-jacobi#separated");
        let is_right = ["numerical", "not-applicable"].contains(&word);
        assert!(is_right, "{name}: {word} {told}");
    }
    // What does not separate has no quadratures.
    let coupled = SPRINGS.replace("x^2 + y^4", "x^2 + y^4 + x^2 y^2");
    let study = studied(written(&coupled).expect("a model"), &words, |_| ());
    let (word, _) = detail(&study, "witness.hamilton-jacobi#separated");
    assert_eq!(word, "not-applicable");
}

/// Roots that are no momenta as they are written: with a negative mass the positive root belongs to the negative momentum. A free constant of
/// κ(0) stands in no number. With a term linear in the velocity the roots are no opposites, and meet where the momentum does not vanish.
#[test]
fn quadratures_by_the_right_root() {
    let models = [
        r#"L = "-(q'^2 - q^2)/2""#,
        r#"L = "-q'^2/2 - q""#,
        r#"L = "q'^2/2 + q q' - q""#,
    ];
    for lagrangian in models {
        for start in ["1", "-1"] {
            let stated = format!(
                "coordinates = [\"q\"]\n[lagrangian]\n{lagrangian}\n[initial]\nq = 1\n\"q'\" = {start}\n[simulation]\nt_end = 2\noutput = 200\n"
            );
            met(&stated);
        }
    }
    let stated = "coordinates = [\"x\", \"y\"]\nconstraints = [\"y' = x x'\"]\n[lagrangian]\nL = \"(x'^2 + y'^2)/2 - x^2/2\"\n\
                  [initial]\nx = 1\n[simulation]\nt_end = 6\noutput = 300\n";
    let model = load("test.toml", stated, &NoFiles, &[]).model;
    let words = ["witness.hamilton-jacobi", "motion.constraint-drift"];
    let study = studied(model.expect("a model"), &words, |_| ());
    let (word, told) = detail(&study, "witness.hamilton-jacobi#separated");
    assert_ne!(word, "refuted", "{told}");
    assert!(!told.contains("compiled"), "{told}");
}

/// The quadratures of a model meet its motion.
#[track_caller]
fn met(stated: &str) {
    let model = load("test.toml", stated, &NoFiles, &[]).model;
    let words = ["witness.hamilton-jacobi", "motion.constraint-drift"];
    let study = studied(model.expect("a model"), &words, |_| ());
    let (word, told) = detail(&study, "witness.hamilton-jacobi#separated");
    assert_eq!(word, "numerical", "{stated}: {told}");
}

/// As many constraints as coordinates: nothing can be varied, and no quotient of zeros is a number.
#[test]
fn nothing_varies_where_nothing_is_free() {
    let stated = "coordinates = [\"x\", \"y\"]\nconstraints = [\"y' = x'\", \"x' = 1\"]\n[lagrangian]\nL = \"(x'^2 + y'^2)/2\"\n[simulation]\nt_end = 5\n";
    let model = load("test.toml", stated, &NoFiles, &[]).model;
    let study = studied(model.expect("a model"), &WITNESS, |_| ());
    for form in Form::ALL {
        let (word, told) = detail(&study, &format!("witness.first-variation#{}", form.word()));
        assert_eq!(word, "proved", "{told}");
    }
    assert_eq!(detail(&study, "witness.stationary").0, "proved");
}

/// `(z' − x') (z' − y x') = 0` from a start on the second component is told of that component, also where no motion is computed: there
/// motions with x' = 0 or y' = 0 are stationary, on the first, which is integrable, all are.
#[test]
fn the_component_of_the_start_without_a_motion() {
    let lagrangian =
        "coordinates = [\"x\", \"y\", \"z\"]\n[lagrangian]\nL = \"(x'^2 + y'^2 + z'^2)/2\"";
    let constraint = "[constraints]\nc = \"(z' - x')*(z' - y*x') = 0\"";
    let start = |z: u32| format!("[initial]\ny = 2\n\"x'\" = 3\n\"y'\" = 1\n\"z'\" = {z}");
    for (z, word) in [(6, "x' = 0 or y' = 0"), (3, "every motion")] {
        let text = format!("{lagrangian}\n{constraint}\n{}", start(z));
        let model = load("product.toml", &text, &NoFiles, &[]).model;
        let model = model.expect("the model is right");
        let study = studied(model, &["hamilton.stationary"], |options| {
            options.motion = false;
        });
        assert!(study.motion.is_none());
        let (_, told) = detail(&study, "hamilton.stationary");
        assert!(told.contains(word), "z' = {z}: {told}");
    }
}

/// All forms have a witness, and words of their own.
#[test]
fn forms_have_words() {
    let mut words: Vec<&str> = Form::ALL.iter().map(|f| f.word()).collect();
    words.sort_unstable();
    words.dedup();
    assert_eq!(words.len(), 4);
}

/// Lines joined, as they are read.
fn unwrapped(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Each form says what stands under the integral for this system, what is substituted, and what follows; nothing is said
/// about how zeros were tested.
#[test]
fn the_forms_are_written_out() {
    let told = run(&["principles", "gallery/particle-y-dx/model.toml", "--all"]);
    let read = unwrapped(&told.out);
    for words in [
        "the statement is ∫δL dt = 0 with δv = D(δq); here δL: m (x' D(δx) + y' D(δy) + z' D(δz))",
        "Chetaev's condition substitutes δz: δz = y δx",
        "L*, the Lagrangian with z' eliminated: 1/2 m ((y^2 + 1) x'^2 + y'^2)",
        "θ of z', the momentum ∂L/∂z' of the full L: m y x'",
        "δz' − δφ of varied curves, with z' = φ on the motion: δx y' - δy x'",
        "the statement is ∫(δL* + Σ θ (δv − δφ)) dt = 0",
        "the statement is ∫(δL + Σ θ A δq) dt = 0 with δf = 0",
        "the factor of δx must vanish: -m (y^2 x'' + x'' + y x' y') = 0",
        "the factor of δy must vanish: -m y'' = 0",
        "δp_x is free, so: Dq_x = p_x/m",
        "the factor of δx must vanish: p_x' + y p_z' = 0",
        "Elsewhere it fails, as at x' = 2, y = 1, y' = 3, z' ≈ 2, m = 17/10: Σ θ A of δx = m y x' y' is about 10.2, not 0.",
        "The equation of Hamilton and Jacobi separates in these coordinates",
    ] {
        assert!(read.contains(words), "{words}\n{}", told.out);
    }
    for words in ["prime field", "canonical form", "residual 1", "delta_"] {
        assert!(!read.contains(words), "{words}\n{}", told.out);
    }
}

/// Without constraints there are no multipliers to name, and equal curves are not farthest apart somewhere.
#[test]
fn curves_that_agree() {
    for (name, words) in [
        ("double-pendulum", "There are no constraints"),
        ("vertical-rolling-disc", "kappa_along_x(0) = -2.4, kappa_along_y(0) = 0. With these values every motion is an extremum."),
    ] {
        let folder = scratch(&format!("agree-{name}"));
        let file = format!("gallery/{name}/model.toml");
        let told = run(&["principles", &file, "--compare", "--out", text(&folder)]);
        let read = unwrapped(&told.out);
        assert!(read.contains(words), "{}", told.out);
        assert!(read.contains("The curves agree") && !read.contains("with ,"), "{}", told.out);
    }
}

/// A witness asked for alone brings the motion that it needs.
#[test]
fn a_witness_alone() {
    let folder = scratch("witness-alone");
    let told = run(&[
        "study",
        "gallery/vertical-rolling-disc/model.toml",
        "--claims",
        "witness.index",
        "--out",
        text(&folder),
    ]);
    assert!(
        told.out.contains("witness.index") && told.out.contains("no conjugate time"),
        "{}",
        told.both()
    );
}

/// What is explained is explained by numbers, or is a statement about all systems.
#[test]
fn explanations_have_examples() {
    let registry = chetaev::study::registry();
    for claim in registry.claims() {
        let is_of_principles = claim.group() == chetaev::mechanics::Group::Principles;
        if is_of_principles {
            assert!(claim.explanation().contains("Example"), "{}", claim.id());
        }
    }
}

/// Over an interval without length nothing is compared, and a multiplier has one initial value.
#[test]
fn nothing_to_compare_and_too_much_given() {
    let skate = "gallery/skate-incline/model.toml";
    let folder = scratch("principles-no-interval");
    let arguments = ["principles", skate, "--compare", "--t-end", "0", "--out"];
    let told = run(&[&arguments[..], &[text(&folder)]].concat());
    let said = unwrapped(&told.out);
    assert!(
        said.contains("The interval of time has no length"),
        "{said}"
    );
    assert!(!said.contains("The curves agree"), "{said}");
    let twice = ["--kappa", "kappa_blade=0.5", "--kappa", "kappa_blade=1"];
    let told = run(&[&["principles", skate, "--compare"][..], &twice].concat());
    assert_eq!(told.status, Some(2), "{}", told.both());
    assert!(told.err.contains("given twice"), "{}", told.both());
}

/// Where a velocity appears under a root too, what must vanish on a part of the states may lead back to itself: it is named as left
/// open, and the search ends.
#[test]
fn a_condition_that_leads_back_to_itself_is_left() {
    let ended = ended_text(
        r#"
assumptions = ["m_1 > 0", "m_2 > 0"]
coordinates = ["q_1", "q_2"]
[parameters]
m_1 = "3/2"
m_2 = "5/3"
[lagrangian]
L = "5 (15 q_2^2 q_1' + 2 q_2')^2/216 + 1/2 m_1 q_1'^2 + 1/2 m_2 q_2'^2 - 4 q_2 q_1' + 3 q_1^2/2 + 1"
[constraints]
c_1 = "2/3 sqrt(3) sqrt(2) sqrt(6 q_2'^2 + 9 q_1^4 + 4) + q_1' = 0"
"#,
        &Ask {
            claims: vec!["hamilton.stationary"],
            ..Ask::default()
        },
    );
    let verdict = ended.verdict("hamilton.stationary");
    // q_1' is nowhere zero, so that no motion stays on q_1 = 0, the only set on which the search had a chance.
    assert!(!matches!(verdict, Verdict::Proved(_)), "{verdict:?}");
}
