//! The claims about formulations for every model of the gallery, the verdicts that the theory expects of named systems, and
//! each formulation integrated by itself.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev::mechanics::card::Relation;
use chetaev::mechanics::{Context, Prepared, Prover, System, FORMULATIONS};
use chetaev::study::{registry, Study};
use chetaev::symbolic::Verdict;
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text};
use chetaev_tests::runs::{along, ended, ended_text, Ask, Ended};
use chetaev_tests::studied::{gallery_path, loaded, model_files};
use chetaev_tests::words::{in_parallel, none};

/// Where a formulation does not apply: its names, the models (`*` all others), the hypothesis that fails, and why.
const NOT_APPLICABLE: &[(&[&str], &[&str], &str)] = &[
    // Of the models stated by particles the pendulums in angles have no Cartesian coordinates, and two particles share that of
    // the cart.
    (
        &["volterra-first-cartesian", "volterra-second-cartesian"],
        &[
            "leaking-pendulum/model.toml",
            "pendulum-particle/model.toml",
            "sand-cart/model.toml",
        ],
        "model.cartesian-coordinates",
    ),
    // The drop grows with the way it falls.
    (
        &["volterra-first-cartesian", "volterra-second-cartesian"],
        &["raindrop/model.toml"],
        "model.masses-of-time",
    ),
    (
        &["volterra-first-cartesian", "volterra-second-cartesian"],
        &["*"],
        "model.particles",
    ),
    // Whoever states a Lagrangian states no bodies.
    (&["newton-euler"], &["*"], "model.bodies"),
    // Chaplygin needs as many coordinates that occur neither in L nor in the constraints as there are constraints, with
    // velocities that can be the dependent ones. Upright cylinder: only the spin psi is absent. Rotating platform: x and y
    // are in the blade's equation. Floor y' = b t: y is in V, x' cannot be dependent. Rod: x and y are in the constraint.
    // Turntable: x and y are in the speed of the table, only the spin is absent. Bicycle: the contact of the front wheel
    // ties lean, pitch and steer, and all three occur. Trailers: only the place of the car is absent, and every axle is a
    // constraint.
    (
        &["chaplygin"],
        &[
            "ball-in-cylinder/model.toml",
            "moving-frame/model.toml",
            "moving-knife-edge/lift.toml",
            "pendulum-particle/cartesian.toml",
            "sphere-on-turntable/model.toml",
            "trailer/model-8.toml",
            "trailer/model.toml",
            "whipple-bicycle/general.toml",
            "whipple-bicycle/model.toml",
        ],
        "model.chaplygin",
    ),
    // p·v = m v·v = m c²: the restricted Lagrangian contains no velocities.
    (
        &["canonical-reduced"],
        &["isokinetic-particle/model.toml"],
        "model.restricted-hessian-regular",
    ),
    // J1: the support of the pendulum shakes.
    (
        &["jacobi"],
        &["kapitza-pendulum/model.toml"],
        "model.lagrangian-autonomous",
    ),
    // J1: the weight of particles is a force, the sliding top and the governor are rubbed, and the driven board has a
    // torque.
    (
        &["jacobi"],
        &[
            "leaking-pendulum/model.toml",
            "pendulum-particle/model.toml",
            "pendulum-particle/cartesian.toml",
            "raindrop/model.toml",
            "rocket-on-appells-constraint/burnt-out.toml",
            "rocket-on-appells-constraint/model.toml",
            "sand-cart/model.toml",
            "snakeboard/driven.toml",
            "tippe-top/model.toml",
            "watt-governor/model.toml",
        ],
        "model.forces-absent",
    ),
    // J3: the Lagrangian of relativity is a root.
    (
        &["jacobi"],
        &["relativistic-particle/model.toml"],
        "model.lagrangian-quadratic",
    ),
    // J4: constraints with a moving part, and v·v = c².
    (
        &["jacobi"],
        &[
            "isokinetic-particle/model.toml",
            "moving-frame/model.toml",
            "moving-knife-edge/lift.toml",
            "moving-knife-edge/model.toml",
            "sphere-on-turntable/model.toml",
        ],
        "model.constraints-homogeneous",
    ),
];

/// The models with constraints of order two and three, of which most formulations say nothing.
const HIGHER_ORDER: &[&str] = &[
    "fixed-acceleration/circle.toml",
    "fixed-acceleration/model.toml",
    "fixed-jerk/model.toml",
    "fixed-jerk/stop.toml",
    "knife-edge-order-2/model.toml",
    "knife-edge-order-3/model.toml",
    "prescribed-curvature/model.toml",
    "radial-acceleration/model.toml",
    "radial-acceleration-polar/model.toml",
    "third-order-linear/model.toml",
];

/// The models that are stated by particles in their own coordinates, with masses of the time alone.
const CARTESIAN: &[&str] = &[
    "pendulum-particle/cartesian.toml",
    "rocket-on-appells-constraint/burnt-out.toml",
    "rocket-on-appells-constraint/model.toml",
    "fixed-acceleration/circle.toml",
    "fixed-acceleration/model.toml",
    "fixed-jerk/model.toml",
    "fixed-jerk/stop.toml",
    "prescribed-curvature/model.toml",
    "radial-acceleration/model.toml",
    "third-order-linear/model.toml",
];

/// The hypothesis that fails for a formulation of a model.
fn failing(name: &str, file: &str) -> Option<&'static str> {
    let any_order = name == "routh" || name == "maggi" || name.starts_with("volterra");
    if HIGHER_ORDER.contains(&file) && !any_order {
        return Some("model.constraints-first-order");
    }
    if name.ends_with("-cartesian") && CARTESIAN.contains(&file) {
        return None;
    }
    NOT_APPLICABLE
        .iter()
        .find(|(names, files, _)| {
            names.contains(&name) && (files.contains(&file) || files.contains(&"*"))
        })
        .map(|(_, _, hypothesis)| *hypothesis)
}

/// What is not as the table says of one model.
fn differences(file: &str) -> Vec<String> {
    let model = loaded(&gallery_path(file), &[])
        .model
        .expect("the gallery is right");
    let system = System::from_model(&model).expect("the gallery is regular");
    let prepared = Prepared::new(&system).expect("the gallery is regular");
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    let mut found = Vec::new();
    for card in FORMULATIONS.iter().map(|f| f.card()) {
        let mut claims = Vec::new();
        if card.relation == Relation::Equivalent {
            claims.push(format!("formulation.equivalent#{}", card.name));
        }
        if card.identity.is_some() {
            claims.push(format!("formulation.identity#{}", card.name));
        }
        for claim in claims {
            let verdict = cx.finding(&claim).verdict.clone();
            let right = match (&verdict, failing(card.name, file)) {
                (Verdict::Proved(_), None) => true,
                (Verdict::NotApplicable { hypothesis, .. }, Some(known)) => hypothesis == known,
                _ => false,
            };
            if !right {
                let (word, detail) = (verdict.word(), verdict.detail());
                found.push(format!("{file}: {claim} is {word}: {detail}"));
            }
        }
    }
    found
}

/// Nothing is refuted, undecided or numerical, and what does not apply fails for the reason of the table.
#[test]
fn every_formulation_is_proved_or_does_not_apply_for_a_known_reason() {
    let files = model_files();
    none(in_parallel(&files, |file| differences(file)).concat());
}

#[test]
fn the_table_names_models_and_formulations_that_exist() {
    let files = model_files();
    for (names, models, _) in NOT_APPLICABLE {
        for name in *names {
            assert!(
                FORMULATIONS.iter().any(|f| f.card().name == *name),
                "{name}"
            );
        }
        for model in models.iter().filter(|m| **m != "*") {
            assert!(files.iter().any(|f| f == model), "{model}");
        }
    }
}

fn claimed(model: &str) -> Ended {
    let ask = Ask {
        claims: vec!["model", "formulations", "energy.integral"],
        ..Ask::default()
    };
    match model.contains('\n') {
        true => ended_text(model, &ask),
        false => ended(loaded(&gallery_path(model), &[]), &ask),
    }
}

const INTEGRABLE: &str =
    "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n\
    constraints = [\"z' = y x' + x y'\"]\n[initial]\nx = 1\ny = 1\n";
const BRANCH: &str = "coordinates = [\"x\", \"y\"]\nlagrangian = \"(x'^2 + y'^2)/2\"\n\
    constraints = [\"(x x' + y y')^2 + x x' + y y' = 0\"]\n[initial]\nx = 1\n\"y'\" = 1\n";

const PARTICLE: &str =
    "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n\
    constraints = { c = \"z' = y x'\" }\n";

const WEAK: &str = "model.constraints-integrable#weak";
const STRONG: &str = "model.constraints-integrable#strong";
const LINEAR: &str = "model.constraints-linear";
const HOMOGENEOUS: &str = "model.constraints-homogeneous";
const SYSTEM: &str = "formulation.vakonomic-coincides#system";
const INCLUSION: &str = "formulation.vakonomic-coincides#inclusion";
const ENERGY: &str = "energy.integral";

/// The expected verdicts of the catalogue of claims, as far as they concern model and formulations, with what follows from
/// Kerner's theorem (rumyantsev1982): the extremals of linear constraints are the motions just when these are integrable.
const EXPECTED: &[(&str, &[(&str, &str)])] = &[
    (
        "skate-level/model.toml",
        &[
            (WEAK, "refuted"),
            (LINEAR, "proved"),
            (HOMOGENEOUS, "proved"),
            (ENERGY, "proved"),
            (SYSTEM, "refuted"),
            (INCLUSION, "refuted"),
        ],
    ),
    (
        "skate-incline/model.toml",
        &[
            (WEAK, "refuted"),
            (SYSTEM, "refuted"),
            (INCLUSION, "refuted"),
        ],
    ),
    (
        "vertical-rolling-disc/model.toml",
        &[
            (WEAK, "refuted"),
            (SYSTEM, "refuted"),
            (INCLUSION, "proved"),
        ],
    ),
    // The same coin with its constraints stated twice.
    (
        "redundant-constraints/model.toml",
        &[
            (WEAK, "refuted"),
            (SYSTEM, "refuted"),
            (INCLUSION, "proved"),
        ],
    ),
    (
        "appell-hamel/model.toml",
        &[
            (LINEAR, "refuted"),
            (HOMOGENEOUS, "proved"),
            (WEAK, "refuted"),
            (STRONG, "refuted"),
            (ENERGY, "proved"),
            (SYSTEM, "proved"),
            (INCLUSION, "proved"),
        ],
    ),
    (
        "particle-y-dx/model.toml",
        &[
            (WEAK, "refuted"),
            (STRONG, "refuted"),
            (SYSTEM, "refuted"),
            (INCLUSION, "refuted"),
        ],
    ),
    (
        INTEGRABLE,
        &[
            (WEAK, "proved"),
            (STRONG, "proved"),
            (SYSTEM, "proved"),
            (INCLUSION, "proved"),
        ],
    ),
    (BRANCH, &[(STRONG, "refuted"), (WEAK, "proved")]),
    // y' = b t: integrable, but no virtual displacement goes along the motion.
    (
        "moving-knife-edge/lift.toml",
        &[
            (HOMOGENEOUS, "refuted"),
            (WEAK, "proved"),
            (ENERGY, "refuted"),
            (SYSTEM, "proved"),
            (INCLUSION, "proved"),
        ],
    ),
];

#[test]
fn verdicts_are_those_that_the_theory_expects() {
    none(
        in_parallel(EXPECTED, |(model, claims)| {
            let ended = claimed(model);
            claims
                .iter()
                .filter(|(claim, word)| ended.verdict(claim).word() != *word)
                .map(|(claim, word)| {
                    let verdict = ended.verdict(claim);
                    format!(
                        "{model}: {claim} is {}, not {word}: {}",
                        verdict.word(),
                        verdict.detail()
                    )
                })
                .collect::<Vec<_>>()
        })
        .concat(),
    );
}

/// The extremals of the weight are its motions only off κ = m s/ρ, where the bordered matrix degenerates.
#[test]
fn the_coincidence_of_appell_and_hamel_excepts_the_singular_set() {
    let ended = claimed("appell-hamel/model.toml");
    let Verdict::Proved(proof) = ended.verdict(SYSTEM) else {
        panic!("proved");
    };
    assert!(
        proof.on.contains("singular set of the bordered matrix"),
        "{}",
        proof.on
    );
    assert!(proof.detail.contains("Kerner"), "{}", proof.detail);
}

/// The square of a constraint has no gradient where it holds.
#[test]
fn the_square_of_a_constraint_is_named_as_such() {
    let squared = "coordinates = [\"x\", \"y\", \"z\"]\nlagrangian = \"(x'^2 + y'^2 + z'^2)/2\"\n\
        constraints = [\"(z' - y x')^2 = 0\"]\n";
    let ended = claimed(squared);
    assert_eq!(ended.exit, 2);
    assert!(ended.text.contains("square"), "{}", ended.text);
}

/// Models whose motion each formulation has to find, with the end of the run.
const MOVED: &[(&str, f64)] = &[
    ("chaplygin-sleigh/model.toml", 3.0),
    ("appell-hamel/model.toml", 0.8),
    // The tangent of the heading is infinite at t = 1.21, which is another test.
    ("skate-incline/model.toml", 1.1),
    ("sphere-on-turntable/model.toml", 2.0),
    (CARTESIAN[0], 1.0),
    ("rocket-on-appells-constraint/model.toml", 1.0),
    ("leaking-pendulum/model.toml", 1.0),
];

fn moved(file: &str, name: Option<&'static str>, t_end: f64) -> Ended {
    let ask = Ask {
        claims: vec!["motion.formulations-agree"],
        t_end: Some(t_end),
        tolerance: Some(1e-11),
        formulation: name,
        ..Ask::default()
    };
    ended(loaded(&gallery_path(file), &[]), &ask)
}

/// Coordinates and velocities at the rows of a study.
fn states(study: &Study) -> Vec<Vec<f64>> {
    let run = &study.motion.as_ref().expect("a motion").evidence.run;
    let names = study.model.coordinates.iter().map(|c| c.name.clone());
    names
        .flat_map(|q| [q.clone(), format!("{q}'")])
        .map(|e| along(study, run, &e).unwrap_or_else(|e| panic!("{e}")))
        .collect()
}

/// The largest difference over the scale of its component. On the turntable the angles come near their pole, |sin θ| = 0.06,
/// where their rates are large and errors grow with them.
fn apart(left: &Study, right: &Study) -> f64 {
    let (left, right) = (states(left), states(right));
    let of_component = |(a, b): (&Vec<f64>, &Vec<f64>)| {
        assert!(a.len() == b.len() && a.len() > 20);
        let scale = a.iter().fold(1.0, |m: f64, x| m.max(x.abs()));
        let differences = a.iter().zip(b).map(|(x, y)| (x - y).abs() / scale);
        differences.fold(
            0.0,
            |m: f64, d| if d.is_nan() { f64::INFINITY } else { m.max(d) },
        )
    };
    left.iter()
        .zip(&right)
        .map(of_component)
        .fold(0.0, f64::max)
}

/// What is not as Routh's equations move the model.
fn other_motions(&(file, t_end): &(&str, f64)) -> Vec<String> {
    let routh = moved(file, None, t_end).study.expect("the gallery moves");
    let mut found = Vec::new();
    for card in FORMULATIONS.iter().map(|f| f.card()) {
        if card.relation != Relation::Equivalent || failing(card.name, file).is_some() {
            continue;
        }
        let ended = moved(file, Some(card.name), t_end);
        let name = card.name;
        let Some(study) = &ended.study else {
            found.push(format!("{file}: {name}: {}", ended.text));
            continue;
        };
        let run = &study.motion.as_ref().expect("a motion").evidence.run;
        let verdict = ended.verdict("motion.formulations-agree");
        if run.formulation != name || !run.ending.finished {
            found.push(format!(
                "{file}: {name}: {} {}",
                run.formulation, run.ending.reason
            ));
            continue;
        }
        if verdict.word() != "numerical" || !verdict.detail().contains(name) {
            found.push(format!("{file}: {name}: {}", verdict.detail()));
        }
        let difference = apart(&routh, study);
        if difference > 1e-7 {
            found.push(format!("{file}: {name} is off by {difference:e}"));
        }
    }
    found
}

#[test]
fn each_formulation_integrated_by_itself_gives_the_same_motion() {
    none(in_parallel(MOVED, other_motions).concat());
}

fn header(formulation: &str, model: &str, rest: &[&str]) -> Vec<String> {
    let out = scratch(&format!("formulations-{formulation}"));
    let arguments = [
        "simulate",
        model,
        "--formulation",
        formulation,
        "--out",
        text(&out),
    ];
    let finished = run(&[&arguments, rest].concat());
    assert_eq!(finished.status, Some(0), "{}", finished.both());
    let rows = std::fs::read_to_string(out.join("trajectory.csv")).expect("a trajectory");
    let line = rows.lines().next().unwrap_or("");
    line.split(',').map(str::to_owned).collect()
}

/// The weight with κ(0) = m s/ρ + C, which is a motion for every C but zero.
fn with_kappa(constant: &str) -> String {
    let folder = scratch(&format!("formulations-kappa-{}", constant.len()));
    let path = folder.join("model.toml");
    let gallery = root().join("gallery/appell-hamel/model.toml");
    // A model includes what is below its own folder.
    std::fs::copy(&gallery, folder.join("base.toml")).expect("a copy");
    let content = format!("include = \"base.toml\"\nname = \"weight\"\n[initial]\nkappa_cone = \"m s0/rho{constant}\"\n");
    std::fs::write(&path, content).expect("a scratch file");
    text(&path).to_owned()
}

#[test]
fn variables_of_a_formulation_are_in_the_trajectory() {
    let sleigh = "gallery/chaplygin-sleigh/model.toml";
    let canonical = header("canonical", sleigh, &["--t-end", "1"]);
    for name in ["p_x", "p_y", "p_phi", "lambda_blade", "x'"] {
        assert!(canonical.iter().any(|c| c == name), "{name}: {canonical:?}");
    }
    let folder = scratch("formulations-own-variables");
    let path = folder.join("model.toml");
    let particle = format!("{PARTICLE}[initial]\n\"x'\" = 1\nkappa_c = 0.5\n");
    std::fs::write(&path, particle).expect("a scratch file");
    let extremal = header("vakonomic", text(&path), &["--t-end", "1"]);
    assert!(extremal.iter().any(|c| c == "kappa_c"), "{extremal:?}");
}

#[test]
fn an_extremum_asks_for_its_multiplier() {
    let out = scratch("formulations-no-kappa");
    let finished = run(&[
        "simulate",
        "gallery/chaplygin-sleigh/model.toml",
        "--formulation",
        "vakonomic",
        "--out",
        text(&out),
    ]);
    assert_eq!(finished.status, Some(2), "{}", finished.both());
    for word in ["kappa_blade", "[initial]"] {
        assert!(finished.err.contains(word), "{}", finished.err);
    }
}

/// κ = m s/ρ + C with C ≠ 0 gives the motion; on the singular set C = 0 the extremals are not determined, and it is said.
#[test]
fn the_extremals_of_the_weight_are_its_motions() {
    let ask = |formulation| Ask {
        claims: vec!["motion.constraint-drift"],
        t_end: Some(0.8),
        formulation,
        ..Ask::default()
    };
    let path = with_kappa(" - 2 m s0/rho");
    let study = |formulation| {
        ended(loaded(path.as_ref(), &[]), &ask(formulation))
            .study
            .expect("a study")
    };
    let (extremal, motion) = (study(Some("vakonomic")), study(None));
    assert!(apart(&extremal, &motion) < 1e-8);
    let run = &extremal.motion.as_ref().expect("a motion").evidence.run;
    let kappa =
        along(&extremal, run, "kappa_cone - m s/rho + 2 m s0/rho").expect("its own variable");
    assert!(kappa.iter().all(|k| k.abs() < 1e-8), "{kappa:?}");
    let path = with_kappa("");
    let ended = ended(loaded(path.as_ref(), &[]), &ask(Some("vakonomic")));
    assert_eq!(ended.exit, 2, "{}", ended.text);
    for word in ["singular", "R5", "kappa_cone"] {
        assert!(ended.text.contains(word), "{}", ended.text);
    }
}

/// y' = x'² with L = x'²/2 + y: R5 is 1 − 2κ, and κ' = 1. On κ = 1/2 no run begins, and one that comes there ends, each with
/// the name of the matrix.
#[test]
fn the_regularity_of_the_extremum_is_watched() {
    let folder = scratch("formulations-r5");
    for (kappa, status) in [("1/2", 2), ("9/20", 3)] {
        let path = folder.join("model.toml");
        let model = format!("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2/2 + y\"\nconstraints = {{ b = \"y' = x'^2\" }}\n[initial]\n\"x'\" = 1\nkappa_b = \"{kappa}\"\n");
        std::fs::write(&path, model).expect("a scratch file");
        let (model, out) = (text(&path), folder.join("out"));
        let finished = run(&[
            "simulate",
            model,
            "--formulation",
            "vakonomic",
            "--t-end",
            "1",
            "--out",
            text(&out),
        ]);
        assert_eq!(finished.status, Some(status), "{}", finished.both());
        let both = finished.both();
        let said = both.split_whitespace().collect::<Vec<_>>().join(" ");
        for words in ["W + Σ κ ∂²f/∂v∂v bordered by ∂f/∂v", "R5"] {
            assert!(said.contains(words), "{said}");
        }
    }
}

/// A form that does not apply says at which point which quantity does not vanish.
#[test]
fn what_fails_is_named_with_its_point() {
    let folder = scratch("formulations-evidence");
    let path = folder.join("model.toml");
    for (model, formulation, wanted) in [
        ("coordinates = [\"x\"]\nlagrangian = \"x'^2/2\"\nforces = { x = \"-2 x'\" }\n", "jacobi", "Q_x = -2 x' does not vanish: it is"),
        ("coordinates = [\"x\"]\nlagrangian = \"x'^2/2 + t x\"\n", "jacobi", "∂L/∂t = x does not vanish: it is"),
        ("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2/2 + y'^2/2 + x'^4\"\n", "jacobi", "does not vanish: it"),
        ("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2/2 + y'^2/2\"\nconstraints = { b = \"y' = x' + 1\" }\n", "jacobi", "of `b` = "),
        ("coordinates = [\"x\", \"y\"]\nlagrangian = \"x'^2/2 + y'^2/2 - x^2 - y^2\"\nconstraints = { b = \"y' = x'\" }\n", "chaplygin", "∂L/∂x = -2 x does not vanish: it is"),
    ] {
        std::fs::write(&path, model).expect("a scratch file");
        let finished = run(&["derive", text(&path), "--formulation", formulation]);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(finished.err.contains(wanted), "{wanted}: {}", finished.err);
        assert!(!finished.err.contains("at the point stated"), "{}", finished.err);
        let has_place = [" at ", " everywhere"].iter().any(|at| finished.err.contains(at));
        assert!(has_place, "{}", finished.err);
    }
}

/// Chaplygin's equations of the skate in x and φ contain tan φ, and no other chart is allowed, since L contains x: near φ = π/2
/// accuracy is lost, and the run says how much.
#[test]
fn a_chart_that_becomes_singular_costs_accuracy_and_that_is_said() {
    let ask = Ask {
        claims: vec!["motion"],
        t_end: Some(3.0),
        global_error: true,
        formulation: Some("chaplygin"),
        // An absolute tolerance is in natural sizes, here of some metres: this asks for what 1e-11 m would.
        tolerance: Some(1e-12),
        ..Ask::default()
    };
    let ended = ended(loaded(&gallery_path("skate-incline/model.toml"), &[]), &ask);
    let study = ended.study.as_ref().expect("a study");
    let evidence = &study.motion.as_ref().expect("a motion").evidence;
    let heading = along(study, &evidence.run, "phi").expect("phi");
    assert!(
        heading.last().is_some_and(|phi| *phi > 2.0),
        "π/2 is passed"
    );
    // The closed form of the gallery: y = gs/(2 W²) (W t - sin(W t) cos(W t)).
    let y = along(
        study,
        &evidence.run,
        "y - gs/(2 W^2) (phi - sin(phi) cos(phi))",
    )
    .expect("y");
    let x = along(study, &evidence.run, "x - gs/(2 W^2) sin(phi)^2").expect("x");
    let error = x.iter().chain(&y).fold(0.0, |m: f64, d| m.max(d.abs()));
    let estimated = evidence.global_error.expect("an estimate");
    let said = ended.verdict("motion.energy-drift").word() == "refuted" || estimated < 1e-8;
    assert!(said, "the energy is off, and the claim says so");
    assert!(
        error < 100.0 * estimated.max(1e-11),
        "{error:e} against {estimated:e}"
    );
}
