//! Symmetries of the reduced system, moving directions and axes, integrals that hold on a part of the states, and what becomes of
//! the integrals that are found.
#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "test code fails where it stands"
)]

use chetaev::mechanics::{Context, Prepared, Prover, System};
use chetaev::model::{load, Model, NoFiles, Style};
use chetaev::study::{registry, study, ClaimSelection, Hooks, Study, StudyOptions};
use chetaev::symbolic::Verdict;
use chetaev_tests::studied::{gallery_path, loaded};

fn model(text: &str) -> Model {
    match load("model.toml", text, &NoFiles, &[]).into_result() {
        Ok((model, _)) => model,
        Err(problems) => panic!("{text}{}", problems.render(Style::Plain)),
    }
}

fn gallery(path: &str) -> Model {
    loaded(&gallery_path(path), &[])
        .model
        .expect("the model is right")
}

fn verdict(model: &Model, claim: &str) -> Verdict {
    let system = System::from_model(model).expect("a system");
    let prepared = Prepared::new(&system).expect("independent velocities");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    cx.finding(claim).verdict.clone()
}

fn says(model: &Model, claim: &str, word: &str, part: &str) {
    let found = verdict(model, claim);
    assert_eq!(found.word(), word, "{claim}: {}", found.detail());
    assert!(found.detail().contains(part), "{claim}: {}", found.detail());
}

/// How many subjects a claim has.
fn count(model: &Model, claim: &str) -> usize {
    let system = System::from_model(model).expect("a system");
    let prepared = Prepared::new(&system).expect("independent velocities");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    let claim = known.find(claim).expect("a claim");
    claim.subjects(&cx).into_iter().flatten().count()
}

/// T3 §8.4: ∂/∂φ is a symmetry with the gyroscopic extension of the reaction, and x' cos φ + y' sin φ is kept.
#[test]
fn the_sled_by_its_reduced_system() {
    let sled = gallery("skate-level/model.toml");
    says(
        &sled,
        "noether.reduced-symmetry#1",
        "proved",
        "x' cos(phi) + y' sin(phi)",
    );
    let incline = gallery("skate-incline/model.toml");
    says(
        &incline,
        "noether.reduced-symmetry#1",
        "refuted",
        "no extension",
    );
    // The rates of rolling are kept, their components are not.
    let disc = gallery("vertical-rolling-disc/model.toml");
    says(
        &disc,
        "noether.reduced-symmetry#1",
        "refuted",
        "no extension",
    );
}

const SKATE: &str = r#"
name = "skate of one particle"
coordinates = ["x", "y", "w"]
[particles.blade]
mass = 3
position = ["x", "y"]
FORCE
[lagrangian]
L = "3 (x'^2 + y'^2)/2 + 2 w'^2"
[constraints]
edge = "x' sin(w) - y' cos(w) = 0"
"#;

/// T3 §8.3: along the blade the momentum is kept on the level, on a slope it is not.
#[test]
fn momentum_along_the_blade() {
    let level = model(&SKATE.replace("FORCE", ""));
    assert_eq!(count(&level, "noether.moving-direction"), 1);
    says(
        &level,
        "noether.moving-direction#1",
        "proved",
        "(cos(w), sin(w))",
    );
    let slope = model(&SKATE.replace("FORCE", "force = [5, 0]"));
    says(&slope, "noether.moving-direction", "undecided", "none of");
}

/// Projectiles keep their horizontal momenta, and the moment of momentum about every axis through their centre of mass, as the
/// relative motion is uniform.
#[test]
fn two_projectiles() {
    let two = model(
        r#"
name = "two projectiles"
coordinates = ["x", "y", "z", "a", "b", "c"]
[particles.first]
mass = 1
position = ["x", "y", "z"]
force = [0, 0, -10]
[particles.second]
mass = 2
position = ["a", "b", "c"]
force = [0, 0, -20]
"#,
    );
    says(&two, "noether.moving-direction#1", "proved", "the x axis");
    says(&two, "noether.moving-direction#2", "proved", "the y axis");
    assert_eq!(count(&two, "noether.moving-direction"), 2);
    says(
        &two,
        "noether.moving-axis#1",
        "proved",
        "the centre of mass",
    );
}

/// In a plane there is one axis, and a central force keeps the moment about its centre.
#[test]
fn a_central_force() {
    let kepler = model(
        r#"
name = "central"
coordinates = ["x", "y"]
[particles.planet]
mass = 1
position = ["x", "y"]
force = ["-x (x^2 + y^2)", "-y (x^2 + y^2)"]
"#,
    );
    says(&kepler, "noether.moving-axis#1", "proved", "the origin");
    assert_eq!(count(&kepler, "noether.moving-axis"), 1);
    says(&kepler, "noether.moving-direction", "undecided", "none of");
}

/// A force along the line to the point (2, 3), in the plane, and one along the line to the axis through (2, 3) and across the ground
/// in space: the moment about that point or axis is kept, and no other.
#[test]
fn axes_through_any_point() {
    let plane = model(
        r#"
name = "attracted"
coordinates = ["x", "y"]
[particles.planet]
mass = 5
position = ["x", "y"]
force = ["-(x - 2)^3 - (x - 2) (y - 3)^2", "-(y - 3) ((x - 2)^2 + (y - 3)^2)"]
"#,
    );
    says(
        &plane,
        "noether.moving-axis#1",
        "proved",
        "5 (x - 2) y' - 5 (y - 3) x'",
    );
    says(
        &plane,
        "noether.moving-axis#1",
        "proved",
        "the point (2, 3)",
    );
    assert_eq!(count(&plane, "noether.moving-axis"), 1);
    let space = model(
        r#"
name = "falling past a line"
coordinates = ["x", "y", "z"]
[parameters]
a = 2
[particles.stone]
mass = 1
position = ["x", "y", "z"]
force = ["-(x - a) z^2", "-y z^2", "-10"]
"#,
    );
    says(
        &space,
        "noether.moving-axis#1",
        "proved",
        "the point (a, 0, 0)",
    );
    assert_eq!(count(&space, "noether.moving-axis"), 1);
    // With a cross wind there is no such axis.
    let wind = model(
        r#"
name = "in the wind"
coordinates = ["x", "y"]
[particles.stone]
mass = 1
position = ["x", "y"]
force = ["-(x - 2) + y^2", "-(y - 3)"]
"#,
    );
    assert_eq!(count(&wind, "noether.moving-axis"), 0);
    says(&wind, "noether.moving-axis", "undecided", "none of");
}

/// Steady motions: what is constant there only is an integral on an invariant part of the states.
#[test]
fn integrals_on_a_part_of_the_states() {
    let disc = gallery("falling-rolling-disc/steady.toml");
    says(&disc, "noether.inverse#lean", "conditional", "theta' = 0");
    let top = gallery("heavy-top/steady.toml");
    says(
        &top,
        "noether.inverse#precession_rate",
        "conditional",
        "stay there",
    );
    // The part must be invariant: a pendulum at rest at an angle does not stay there.
    let pendulum = |angle: &str| {
        model(&format!(
            "name = \"pendulum\"\ncoordinates = [\"u\"]\n[lagrangian]\nL = \"u'^2/2 + cos(u)\"\n[integrals]\nangle = {{ value = \"u\", on = [\"u = {angle}\", \"u' = 0\"] }}\n"
        ))
    };
    says(
        &pendulum("0"),
        "noether.inverse#angle",
        "conditional",
        "stay there",
    );
    says(
        &pendulum("pi"),
        "noether.inverse#angle",
        "conditional",
        "stay there",
    );
    says(
        &pendulum("1"),
        "noether.inverse#angle",
        "refuted",
        "which do not stay there",
    );
}

fn studied(model: &Model, claims: &[&str], keep: bool) -> Study {
    let options = StudyOptions {
        claims: ClaimSelection {
            words: claims.iter().map(|c| c.to_string()).collect(),
        },
        tolerance: Some(1e-5),
        keep_integrals: keep,
        ..StudyOptions::default()
    };
    with_options(model, options)
}

fn with_options(model: &Model, options: StudyOptions) -> Study {
    let mut hooks = Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| (),
    };
    study(model.clone(), options, &mut hooks).expect("a study")
}

/// Integrals that are found are followed along the motion, and kept to rounding where that is asked for.
#[test]
fn found_integrals_are_followed_and_kept() {
    let claims = ["motion", "noether.family", "noether.integral"];
    let top = gallery("heavy-top/model.toml");
    let largest = |keep: bool| {
        let study = studied(&top, &claims, keep);
        let motion = study.motion.as_ref().expect("a motion");
        let names: Vec<&str> = motion
            .found
            .others
            .iter()
            .map(|f| f.name.as_str())
            .collect();
        // The energy among the three is followed anyway.
        assert_eq!(names.len(), 2, "{names:?}");
        for name in names {
            let full = format!("motion.integral-drift#{name}");
            assert!(study.verdicts.iter().any(|d| d.full_id() == full), "{full}");
        }
        // At the ends of steps: rows between them are interpolated. The energy, then what the model states.
        let at_steps = &motion.evidence.run.followed[..4];
        let drifts = at_steps.iter().map(|d| d.drift.value / d.scale);
        drifts.fold(0.0, f64::max)
    };
    let (free, kept) = (largest(false), largest(true));
    assert!(free > 1e-9, "{free}");
    assert!(kept < 1e-13, "{kept}");
}

/// The energy among the integrals found is followed under its own number, and the families that were exhausted stand in lines of their own
/// below what was found.
#[test]
fn every_integral_found_has_its_drift_and_every_family_its_line() {
    let falling = model(
        "name = \"falling\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2 - y^3\"\n[initial]\nx = 1\n\"y'\" = 0.5\n",
    );
    let study = studied(
        &falling,
        &["motion", "noether.family", "noether.integral"],
        false,
    );
    let numbers = |claim: &str| -> Vec<&str> {
        let own = study.verdicts.iter().filter(|d| d.claim == claim);
        own.filter_map(|d| d.subject.as_deref()).collect()
    };
    let all = numbers("noether.integral");
    assert!(all.len() > 1, "{all:?}");
    assert_eq!(all, numbers("motion.integral-drift"));
    let energy = study.verdicts.iter().find(|d| {
        d.claim == "motion.integral-drift"
            && d.finding.verdict.detail().contains("motion.energy-drift")
    });
    let energy = &energy.expect("the energy").finding.verdict;
    assert_eq!(energy.word(), "numerical", "{}", energy.detail());
    // (1/2)² / 2 at the start.
    assert!(
        energy.detail().contains("0.125000 at the start"),
        "{}",
        energy.detail()
    );
    let text = chetaev::study::summary::summary(&study, chetaev::study::summary::Style::Plain);
    let said = text.lines().find(|line| line.contains("noether.family"));
    assert!(!said.expect("a line").contains("exhausted: "), "{text}");
    let lines = text
        .lines()
        .filter(|line| line.starts_with("    exhausted: "));
    assert!(lines.count() > 2, "{text}");
}

/// Keeping the integrals changes the run of Routh's equations and no other: whether the forms agree is asked of free runs.
#[test]
fn formulations_agree_with_kept_integrals() {
    let claims = ["motion.formulations-agree"];
    for path in ["heavy-top/model.toml", "skate-incline/model.toml"] {
        let study = studied(&gallery(path), &claims, true);
        let mut all = study.verdicts.iter();
        let found = all
            .find(|d| d.claim == claims[0])
            .expect("the claim is decided");
        let verdict = &found.finding.verdict;
        assert_eq!(verdict.word(), "numerical", "{path}: {}", verdict.detail());
    }
}

/// y'/x' and log x' have no value where the motion starts with x' = 0, and nothing of them is followed.
#[test]
fn integrals_without_a_value_at_the_start() {
    let plane = model(
        r#"
name = "plane"
coordinates = ["x", "y"]
lagrangian = "(x'^2 + y'^2)/2"
[initial]
x = 1
"y'" = 0.5
[integrals]
slope = "y'/x'"
logarithm = "log(x')"
moment = "x y' - y x'"
"#,
    );
    for keep in [false, true] {
        let study = studied(&plane, &["motion"], keep);
        for (name, word) in [
            ("slope", "not-applicable"),
            ("logarithm", "not-applicable"),
            ("moment", "numerical"),
        ] {
            let full = format!("motion.integral-drift#{name}");
            let found = study.verdicts.iter().find(|d| d.full_id() == full);
            let verdict = &found.expect("the claim is decided").finding.verdict;
            assert_eq!(verdict.word(), word, "{full}: {}", verdict.detail());
        }
        let text = chetaev::study::summary::summary(&study, chetaev::study::summary::Style::Plain);
        assert!(!text.contains("inf") && !text.contains("NaN"), "{text}");
    }
}

/// A parameter that the model states to be zero is put in before anything is asked: z' = k y x' with k = 0 is integrable, and
/// nothing leads off z = const.
#[test]
fn parameters_that_are_stated_zero() {
    let text = |k: u32| {
        format!(
            "name = \"k\"\ncoordinates = [\"x\", \"y\", \"z\"]\n[parameters]\nk = {k}\n[lagrangian]\n\
             T = \"1/2 (x'^2 + y'^2 + z'^2)\"\n[constraints]\nf = \"z' = k y x'\"\n"
        )
    };
    for (k, integrable, grows) in [(0, "proved", "refuted"), (1, "refuted", "proved")] {
        let study = studied(&model(&text(k)), &["model", "integrals"], false);
        for (claim, word) in [
            ("model.constraints-integrable#weak", integrable),
            ("distribution.growth", grows),
            ("noether.integral#1", "proved"),
        ] {
            let found = study.verdicts.iter().find(|d| d.full_id() == claim);
            let verdict = &found.expect("the claim is decided").finding.verdict;
            let detail = verdict.detail();
            assert_eq!(verdict.word(), word, "{claim} with k = {k}: {detail}");
            let says = detail.contains("for k = 0, as the model states it");
            assert_eq!(says, k == 0, "{claim} with k = {k}: {detail}");
        }
    }
}

/// Nothing is searched where no claim asks for it.
#[test]
fn a_motion_alone_searches_nothing() {
    let study = studied(&gallery("heavy-top/model.toml"), &["motion"], false);
    assert!(study.motion.expect("a motion").found.all().is_empty());
}

/// Runs over many turns at tolerance 10⁻⁶: at every step and row the integrals have their values to rounding, the constraints
/// hold, and nothing is left out. Without the option the energy is lost.
#[test]
fn integrals_are_kept_to_rounding_in_long_runs() {
    let kepler = model(
        "name = \"kepler\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2 + 2/sqrt(x^2 + y^2)\"\n[initial]\nx = 1\n\"y'\" = 0.5\n[integrals]\nmoment = \"x y' - y x'\"\n",
    );
    for (model, t_end) in [(kepler, 60.0), (gallery("skate-incline/model.toml"), 200.0)] {
        let drift = |keep: bool| {
            let study = long_run(&model, t_end, keep);
            let evidence = &study.motion.as_ref().expect("a motion").evidence;
            assert!(evidence.run.ending.finished);
            let said = study.notices.join("; ");
            assert!(!said.contains("first integral"), "{said}");
            let all = std::iter::once(&evidence.energy).chain(&evidence.integrals);
            let all = all.chain(&evidence.residuals);
            all.map(|f| f.drift.value / f.scale).fold(0.0, f64::max)
        };
        let (kept, free) = (drift(true), drift(false));
        assert!(kept < 100.0 * f64::EPSILON, "{kept}");
        assert!(free > 1e-7, "{free}");
    }
}

fn long_run(model: &Model, t_end: f64, keep: bool) -> Study {
    let options = StudyOptions {
        claims: ClaimSelection {
            words: vec!["motion".into()],
        },
        t_end: Some(t_end),
        tolerance: Some(1e-6),
        keep_integrals: keep,
        ..StudyOptions::default()
    };
    with_options(model, options)
}

/// A function with an acceleration is none of the state, and the claim says so.
#[test]
fn a_stated_integral_with_accelerations_is_answered() {
    let oscillator = model(
        "name = \"oscillator\"\ncoordinates = [\"x\"]\nlagrangian = \"x'^2/2 - x^2/2\"\n[integrals]\naccel = \"x'' + x\"\n",
    );
    says(
        &oscillator,
        "noether.inverse#accel",
        "not-applicable",
        "x''",
    );
}
