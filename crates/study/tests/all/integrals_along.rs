//! First integrals along a motion: kept by projection, shown with what they are, and followed across their jumps.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev_model::{load, NoFiles};
use chetaev_report::data::{Report, SeriesGroup};
use chetaev_study::page::report;
use chetaev_study::record::{record, TrajectoryRecord};
use chetaev_study::summary::{summary, Style};
use chetaev_study::sweep::together::{Together, Variations};
use chetaev_study::sweep::vary::Variation;
use chetaev_study::sweep::{Sweep, SweepOptions};
use chetaev_study::{study, ClaimSelection, Hooks, Study, StudyOptions};
use chetaev_symbolic::Verdict;

fn studied(text: &str, claims: &[&str], change: impl Fn(&mut StudyOptions)) -> Study {
    let (model, _) = load("model.toml", text, &NoFiles, &[])
        .into_result()
        .expect("a model");
    let mut options = StudyOptions {
        claims: ClaimSelection {
            words: claims.iter().map(|&word| word.to_owned()).collect(),
        },
        ..StudyOptions::default()
    };
    change(&mut options);
    let mut hooks = Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| (),
    };
    study(model, options, &mut hooks).expect("a study")
}

fn verdict<'a>(study: &'a Study, claim: &str) -> &'a Verdict {
    let found = study.verdicts.iter().find(|d| d.full_id() == claim);
    &found
        .unwrap_or_else(|| panic!("no verdict of {claim}"))
        .finding
        .verdict
}

fn page(study: &Study) -> Report {
    report(study, None, &[])
}

fn trajectory(study: &Study) -> TrajectoryRecord {
    record(study, &[]).trajectory.expect("a motion")
}

fn keeping(options: &mut StudyOptions) {
    options.keep_integrals = true;
}

const LEAK: &str = "name = \"leak\"\ncoordinates = [\"z\"]\nmasses = { m = { rate = \"-m/5\", initial = 1 } }\nlagrangian = { T = \"1/2 m z'^2\" }\ninitial = { \"z'\" = 1 }\n[simulation]\nt_end = 2\n";

const KEPLER: &str = "name = \"kepler\"\ncoordinates = [\"r\", \"phi\"]\n[parameters]\nm = 1\nk = 1\n[lagrangian]\nT = \"1/2 m (r'^2 + r^2 phi'^2)\"\nV = \"-k/r\"\n[initial]\nr = 1\n\"phi'\" = 1.2\n[simulation]\nt_end = 5\n";

const OSCILLATOR: &str = "name = \"oscillator\"\ncoordinates = [\"x\"]\nlagrangian = \"x'^2/2 - x^2/2\"\n[initial]\nx = 1\n[simulation]\nt_end = 20\n";

/// Masses with a law of their own are not moved, and an integral of the time and the mass alone is none that can be kept.
#[test]
fn integrals_are_kept_beside_masses_with_a_law_of_their_own() {
    let study = studied(LEAK, &["motion"], keeping);
    let kept = trajectory(&study).kept.expect("what was kept");
    let formulas: Vec<&str> = kept.integrals.iter().map(|i| i.formula.as_str()).collect();
    assert_eq!(formulas, ["z'", "t z' - z"]);
    let said = study.notices.join("; ");
    assert!(!said.contains("first integral"), "{said}");
    let all = study.verdicts.iter();
    let of_mass = all.filter(|d| d.finding.verdict.detail().contains("log(m)"));
    let of_mass: Vec<_> = of_mass.collect();
    assert_eq!(of_mass.len(), 1);
    assert!(!of_mass[0]
        .finding
        .verdict
        .detail()
        .contains("by projection"));
}

/// x' y' = 0 from x' = 1/1000, y' = 0: on the component of the start y and x' keep their values, on the other one x and y'. The exact motion is
/// x = t/1000, z = t; a projection on the integrals of the other component would hold x at 0.
#[test]
fn integrals_are_kept_on_the_component_of_the_start() {
    let text = "name = \"apart\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\nc = \"x' y' = 0\"\n[initial]\n\"x'\" = \"1/1000\"\n\"z'\" = 1\n[simulation]\nt_end = 30\ntolerance = 1e-4\n";
    let study = studied(text, &["motion", "noether.family"], keeping);
    let kept = trajectory(&study).kept.expect("what was kept");
    let formulas: Vec<&str> = kept.integrals.iter().map(|i| i.formula.as_str()).collect();
    assert!(
        formulas.contains(&"y") && formulas.contains(&"x'"),
        "{formulas:?}"
    );
    assert!(!formulas.contains(&"x"), "{formulas:?}");
    let evidence = &study.motion.as_ref().expect("a motion").evidence;
    let width = evidence.run.rows.len() / evidence.run.times.len();
    let last = evidence.run.rows.chunks(width).last().expect("rows");
    assert!((last[0] - 0.03).abs() < 1e-12, "{last:?}");
    // The families are searched on both components, and what is said of each is true: three functions, and two with the time.
    let Verdict::Proved(proof) = verdict(&study, "noether.family") else {
        panic!("{:?}", verdict(&study, "noether.family"));
    };
    for part in [
        "where x' = 0: 5 functionally",
        "where y' = 0: 5 functionally",
    ] {
        assert!(proof.detail.contains(part), "{}", proof.detail);
    }
}

/// exp(z' − y x') = 1 and z'³ = y³ x'³ are z' = y x', whose integrals y' and x' √(1 + y²) and whose density √(1 + y²) are known; they are
/// kept along the motion, and with them z' − y x'.
#[test]
fn constraints_that_are_functions_of_a_simpler_one_have_its_integrals() {
    for c in ["exp(z' - y x') = 1", "z'^3 = y^3 x'^3"] {
        let text = format!("name = \"curved\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\nc = \"{c}\"\n[initial]\ny = 1\n\"x'\" = 1\n\"y'\" = \"1/2\"\n\"z'\" = 1\n[simulation]\nt_end = 2\n");
        let study = studied(&text, &["motion", "integrals"], keeping);
        let kept = trajectory(&study).kept.expect("what was kept");
        let formulas: Vec<&str> = kept.integrals.iter().map(|i| i.formula.as_str()).collect();
        assert!(
            formulas.contains(&"y'") && formulas.contains(&"x' sqrt(1 + y^2)"),
            "{formulas:?}"
        );
        for (claim, said) in [
            ("noether.integral#1", "y' keeps its value"),
            ("measure.invariant", "N = sqrt(1 + y^2)"),
            ("liouville.integrable", "2 independent integrals"),
        ] {
            let verdict = verdict(&study, claim);
            assert_eq!(verdict.word(), "proved", "{claim}: {}", verdict.detail());
            let detail = verdict.detail();
            assert!(
                detail.contains("with `c` written as y x' - z' = 0"),
                "{detail}"
            );
            assert!(detail.contains(said), "{detail}");
        }
    }
}

/// What was kept is said by the record, the summary, the report and by each verdict on a drift, which is no evidence then; also of the
/// energy and of stated integrals that are functions of what was kept. Nothing is said where nothing was kept.
#[test]
fn what_was_kept_by_projection_is_said() {
    let stated = format!("{KEPLER}[integrals]\nareal = \"r^2 phi'/2\"\n");
    let study = studied(&stated, &["motion"], keeping);
    let said = "its value was kept by projection after each step, so that it is no evidence";
    for claim in [
        "energy-drift",
        "integral-drift#areal",
        "integral-drift#1",
        "integral-drift#2",
    ] {
        let verdict = verdict(&study, &format!("motion.{claim}"));
        assert_eq!(verdict.word(), "numerical");
        assert!(
            verdict.detail().starts_with(said),
            "{claim}: {}",
            verdict.detail()
        );
    }
    let steps = trajectory(&study).steps;
    let kept = trajectory(&study).kept.expect("what was kept");
    assert!(kept.integrals.iter().all(|i| i.steps == steps), "{kept:?}");
    assert_eq!(kept.integrals[0].formula, "r^2 phi'");
    assert!(kept.moved > steps / 2 && kept.moved <= steps, "{kept:?}");
    assert!((1e-14..1e-8).contains(&kept.largest_change), "{kept:?}");
    let text = summary(&study, Style::Plain);
    let line =
        format!("kept by projection after {steps} of {steps} steps: first integral 1, r^2 phi'\n");
    assert!(text.contains(&line), "{text}");
    let page = page(&study).trajectory.expect("a motion");
    assert!(page.conserved.iter().all(|own| own.is_enforced));
    let mut facts = page.statistics.iter();
    let fact = facts.find(|fact| fact.label.contains("kept by projection"));
    assert_eq!(fact.expect("a fact").value, "1, 2, 3");
    let free = studied(&stated, &["motion"], |_| ());
    assert!(trajectory(&free).kept.is_none());
    let text = summary(&free, Style::Plain);
    assert!(!text.contains("by projection"), "{text}");
}

/// Each integral found stands in the report with its formula as it is shown, its symmetry, its value at the start and its drift, and
/// with a curve of its values.
#[test]
fn integrals_found_are_shown_with_what_they_are() {
    let study = studied(
        KEPLER,
        &["motion", "noether.family", "noether.integral"],
        |_| (),
    );
    let page = page(&study).trajectory.expect("a motion");
    let of = |number: &str| {
        let mut all = page.conserved.iter();
        all.find(|own| own.name == number).expect("an integral")
    };
    let (momentum, energy) = (of("1"), of("2"));
    assert_eq!(momentum.formula.text, "r^2 phi'");
    assert!(momentum.formula.mathml.is_some());
    assert_eq!(
        momentum.origin.as_deref(),
        Some("the symmetry under shifts of phi")
    );
    assert_eq!(
        energy.origin.as_deref(),
        Some("the symmetry under shifts of time")
    );
    assert!((momentum.start - 1.2).abs() < 1e-15);
    assert_eq!(momentum.claim.as_deref(), Some("noether.integral#1"));
    assert_eq!(energy.drift.as_deref(), Some("drift of energy"));
    let series = |name: &str| {
        let mut all = page.series.iter();
        all.find(|series| series.name == name).expect("a series")
    };
    let values = series("first integral 1");
    assert_eq!(values.group, SeriesGroup::Integrals);
    assert_eq!(values.label.as_deref(), Some("1: r² φ\u{307}"));
    assert!(values.values.iter().all(|x| (x - 1.2).abs() < 1e-8));
    let drift = series(momentum.drift.as_deref().expect("a drift"));
    assert_eq!(drift.label, values.label);
    assert!(drift.tolerance.is_some());
    // The sentence of the drift has the same form of the integral as the search.
    let detail = verdict(&study, "motion.integral-drift#2").detail();
    let shown = "first integral 2, 1/2 m (r'^2 + r^2 phi'^2) - k/r (-0.280000 at the start)";
    assert!(detail.contains(shown), "{detail}");
}

/// An angle jumps at its cut, by whole turns which are no drift; other functions are followed between the jumps, and what changes
/// there is refuted.
#[test]
fn jumps_of_stated_integrals_are_no_drift() {
    let stated = format!(
        "{OSCILLATOR}[integrals]\nphase = \"atan2(x', x) + t\"\nproduct = \"(x^2 + x'^2) (atan2(x', x) + t)\"\nwrong = \"atan2(x', x) + 2 t\"\nsquare = \"x^2 sign(x)^2\"\n"
    );
    let study = studied(&stated, &["motion"], |_| ());
    for (name, word, jumping) in [
        ("phase", "numerical", "atan2(x', x)"),
        ("product", "numerical", "atan2(x', x)"),
        ("wrong", "refuted", "atan2(x', x)"),
        ("square", "refuted", "sign(x)"),
    ] {
        let verdict = verdict(&study, &format!("motion.integral-drift#{name}"));
        let detail = verdict.detail();
        assert_eq!(verdict.word(), word, "{name}: {detail}");
        let said = format!("`{name}` between the jumps of {jumping} (the first before t = ");
        assert!(detail.contains(&said), "{detail}");
    }
    let drifts = trajectory(&study).drifts;
    let phase = drifts.iter().find(|own| own.name == "integral phase");
    assert!(phase.unwrap().value.unwrap() < 1e-8);
    let page = page(&study).trajectory.expect("a motion");
    let mut series = page.series.iter();
    let phase = series.find(|series| series.name == "drift of integral phase");
    assert!(phase.unwrap().values.iter().all(|x| *x < 1e-8));
}

/// Rows far apart hide how often an angle jumped between them; whole turns are left out all the same.
#[test]
fn turns_between_sparse_rows_are_left_out() {
    let stated = OSCILLATOR.replace("t_end = 20", "t_end = 60\noutput = 7");
    let stated = format!("{stated}[integrals]\nphase = \"2 atan2(x', x) + 2 t\"\n");
    let study = studied(&stated, &["motion"], |_| ());
    let verdict = verdict(&study, "motion.integral-drift#phase");
    assert_eq!(verdict.word(), "numerical", "{}", verdict.detail());
}

/// A step that is too long is not put down to the motion alone.
#[test]
fn a_step_that_is_too_long_is_named() {
    let study = studied(KEPLER, &["motion"], |options| {
        options.method = Some("runge-kutta-4".into());
        options.step = Some(2.5);
    });
    let verdict = verdict(&study, "motion.formulations-agree");
    assert_eq!(verdict.word(), "undecided");
    let detail = verdict.detail();
    assert!(detail.contains("the step 2.5 may be too long"), "{detail}");
    assert!(detail.contains("a second run at half the step"), "{detail}");
}

/// What a claim rests on has a verdict of its own in a study of all claims, on masses where these vary.
#[test]
fn hypotheses_have_verdicts() {
    for (text, varies) in [(OSCILLATOR, false), (LEAK, true)] {
        let study = studied(text, &["model", "integrals"], |_| ());
        let of_masses = "model.masses-free-of-velocity".to_owned();
        for decided in &study.verdicts {
            if decided.claim == "noether.integral" {
                assert_eq!(decided.requires.contains(&of_masses), varies);
            }
            for hypothesis in &decided.requires {
                let known = |d: &chetaev_study::Decided| {
                    d.full_id() == *hypothesis || d.claim == hypothesis
                };
                assert!(
                    study.verdicts.iter().any(known),
                    "{hypothesis} of {}",
                    decided.full_id()
                );
            }
        }
    }
}

/// What stands apart: on x y = 0 the particle that starts on y = 0 is free in the plane of x and z (by hand); (x'² + y'² - 1)(x'² + y'² - 4) = 0 with the
/// potential x²/2 keeps y' exp(-x²/8) at speed 2 alone, as y'' = x x' y'/4 there. Integrals that the model states for a part, or for its
/// values, hold there, and their drift elsewhere says nothing.
#[test]
fn integrals_of_components_parts_and_values() {
    let product = "name = \"crossed\"\ncoordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n[constraints]\nh = \"x y = 0\"\n[initial]\nx = 1\n\"x'\" = 1\n\"z'\" = 1\n[simulation]\nt_end = 1\n";
    let study = studied(product, &["motion", "integrals"], keeping);
    let kept = trajectory(&study).kept.expect("what was kept");
    let formulas: Vec<&str> = kept.integrals.iter().map(|i| i.formula.as_str()).collect();
    assert_eq!(formulas, ["x'", "z'", "x z' - z x'", "t x' - x"]);
    let Verdict::Proved(proof) = verdict(&study, "noether.family") else {
        panic!("{:?}", verdict(&study, "noether.family"));
    };
    for part in ["where x = 0: 4 functionally", "where y = 0: 4 functionally"] {
        assert!(proof.detail.contains(part), "{}", proof.detail);
    }
    // So it is where a parameter is stated to be zero, for which the search has a system of its own.
    let weightless = product
        .replace("^2)/2\"", "^2)/2 - g z\"")
        .replace("[constraints]", "[parameters]\ng = 0\n[constraints]");
    let study = studied(&weightless, &["motion", "integrals"], keeping);
    let kept = trajectory(&study).kept.expect("what was kept");
    let of_weightless: Vec<&str> = kept.integrals.iter().map(|i| i.formula.as_str()).collect();
    assert_eq!(of_weightless, formulas);

    let cones = "name = \"speeds\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2 - x^2/2\"\n[constraints]\nc = \"(x'^2 + y'^2 - 1) (x'^2 + y'^2 - 4) = 0\"\n[integrals]\nG = \"y' exp(-x^2/8)\"\n[initial]\nx = \"1/2\"\n\"x'\" = \"6/5\"\n\"y'\" = \"8/5\"\n[simulation]\nt_end = 1\n";
    let study = studied(cones, &["motion", "noether.inverse"], |_| ());
    let Verdict::Conditional { condition, .. } = verdict(&study, "noether.inverse#G") else {
        panic!("{:?}", verdict(&study, "noether.inverse#G"));
    };
    assert!(condition.contains("- 4"), "{condition}");

    let saddle = "name = \"saddle\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2 + k x^2/2\"\n[parameters]\nk = 1\n[integrals]\nout = { value = \"x exp(-t)\", on = [\"x' = x\"] }\nin = { value = \"y'\", on = [\"x = 0\", \"x' = 0\"] }\n[initial]\nx = 1\n\"y'\" = 1\n[simulation]\nt_end = 1\n";
    let study = studied(saddle, &["motion", "noether.inverse"], |_| ());
    let Verdict::Conditional { condition, .. } = verdict(&study, "noether.inverse#out") else {
        panic!("{:?}", verdict(&study, "noether.inverse#out"));
    };
    assert!(
        condition.contains("k = 1") && condition.contains("x' = x"),
        "{condition}"
    );
    assert_eq!(
        verdict(&study, "motion.integral-drift#out").word(),
        "not-applicable"
    );
}

/// Trajectories of a sweep may start on different components: what is kept on one would lead another away.
#[test]
fn no_integrals_are_kept_over_components() {
    for constraint in ["x y = 0", "x' y' = 0"] {
        let text = format!("name = \"crossed\"\ncoordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n[constraints]\nh = \"{constraint}\"\n[initial]\nx = 1\n\"x'\" = 1\n[simulation]\nt_end = 1\n");
        let (model, _) = load("model.toml", &text, &NoFiles, &[])
            .into_result()
            .expect("a model");
        let range = Variation::parse(&model, ("--initial", "x=1:2:3"), true).expect("a range");
        let variations = Variations::new(Vec::new(), vec![range], Together::default());
        let mut options = SweepOptions::default();
        keeping(&mut options.study);
        let mut hooks = Hooks {
            clock: &|| 0.0,
            interrupt: None,
            progress: &mut |_, _| (),
        };
        let sweep = Sweep::new(&model, variations.expect("a range"), options, &mut hooks);
        let refused = sweep.err().unwrap_or_else(|| panic!("{constraint}: kept"));
        assert!(
            refused
                .to_string()
                .contains("`h` holds on several components"),
            "{refused}"
        );
    }
}
