//! Sweeps: every trajectory is that of a single run, bit for bit, whatever the threads; nothing is lost when the process is
//! killed; closed forms over ranges of parameters.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::ensemble::{pool, Outcome, StopCode};
use chetaev::model::{load, Model, NoFiles};
use chetaev::study::sweep::together::{Together, Variations};
use chetaev::study::sweep::vary::{rows, Variation};
use chetaev::study::sweep::{Sweep, SweepOptions};
use chetaev::study::{study, ClaimSelection, Hooks, StudyOptions};
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{command, ok, run, text};
use std::collections::BTreeMap;
use std::io::Read;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

const SLEIGH: &str = "gallery/chaplygin-sleigh/model.toml";

fn with_hooks<T>(work: impl FnOnce(&mut Hooks<'_>) -> T) -> T {
    work(&mut Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| {},
    })
}

fn read(path: &str, set: &[(&str, &str)]) -> Model {
    let content = std::fs::read_to_string(root().join(path)).expect("a gallery model");
    of_text(&content, set)
}

fn of_text(content: &str, set: &[(&str, &str)]) -> Model {
    let set: Vec<(String, String)> = set
        .iter()
        .map(|(n, v)| (n.to_string(), v.to_string()))
        .collect();
    let loaded = load("model.toml", content, &NoFiles, &set);
    loaded
        .model
        .unwrap_or_else(|| panic!("{}", loaded.diagnostics))
}

/// Variations of parameters and of initial values.
fn varied(model: &Model, vary: &[&str], initial: &[&str], together: Together) -> Variations {
    let parse = |label: &'static str, is_initial: bool| {
        move |text: &&str| {
            Variation::parse(model, (label, text), is_initial).unwrap_or_else(|d| panic!("{d}"))
        }
    };
    let ranges = vary.iter().map(parse("--vary", false));
    let ranges = ranges
        .chain(initial.iter().map(parse("--initial", true)))
        .collect();
    Variations::new(Vec::new(), ranges, together).expect("variations that go together")
}

fn sweep(model: &Model, variations: Variations, options: SweepOptions) -> Sweep {
    with_hooks(|hooks| Sweep::new(model, variations, options, hooks)).expect("a sweep")
}

/// All outcomes, in order; `size` trajectories are computed together, then the next ones.
fn outcomes(sweep: &Sweep, size: u64, threads: usize) -> Vec<Outcome> {
    let mut found: BTreeMap<u64, Outcome> = BTreeMap::new();
    let interrupt = AtomicBool::new(false);
    let work = sweep.work();
    for first in (0..sweep.count()).step_by(size as usize) {
        let wanted = first..(first + size).min(sweep.count());
        pool::run(
            &*work,
            (std::slice::from_ref(&wanted), threads),
            &interrupt,
            |batch| {
                found.extend(batch);
                ControlFlow::Continue(())
            },
        );
    }
    assert_eq!(found.len() as u64, sweep.count());
    found.into_values().collect()
}

/// Start and end by a study of the model alone, with steps.
fn single(model: Model, options: &StudyOptions) -> (Vec<f64>, Vec<f64>, u64) {
    let options = StudyOptions {
        claims: ClaimSelection {
            words: vec!["motion.constraint-drift".into()],
        },
        global_error: false,
        ..options.clone()
    };
    let study = with_hooks(|hooks| study(model, options, hooks)).expect("a study");
    let motion = study.motion.as_ref().expect("a motion");
    let run = &motion.evidence.run;
    let start = [&motion.start.q[..], &motion.start.v[..]].concat();
    let end = run.row(run.len() - 1)[..run.layout.v().end].to_vec();
    (start, end, run.statistics.steps)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

fn bits_of(outcome: &Outcome) -> Vec<u64> {
    let mut all = bits(
        &[
            &outcome.start[..],
            &outcome.end,
            &outcome.drift,
            &outcome.samples,
        ]
        .concat(),
    );
    all.extend(bits(&[outcome.t, outcome.t_stop, outcome.constraint_drift]));
    all.extend([
        outcome.steps,
        outcome.rejected,
        outcome.stop.number() as u64,
    ]);
    all.extend(
        outcome
            .events
            .iter()
            .flat_map(|e| [e.count, e.first.to_bits()]),
    );
    all
}

#[test]
fn a_trajectory_of_a_sweep_has_the_bits_of_a_run_by_itself() {
    // Parameters of which others and initial values are made, with roots and functions of angles.
    let cases: [(&str, [&str; 2], &str, &str); 3] = [
        (
            SLEIGH,
            ["a=0.1:0.45:3", "W=1:4:log:2"],
            "6",
            "dormand-prince-853",
        ),
        (
            "gallery/falling-rolling-disc/model.toml",
            ["lean=0.1:0.3:2", "r=0.2,1/3"],
            "0.7",
            "dop853",
        ),
        (SLEIGH, ["a=0.1,0.3", "J=0.2:0.7:2"], "3", "taylor"),
    ];
    for (path, vary, t_end, method) in cases {
        let study = StudyOptions {
            t_end: t_end.parse().ok(),
            method: Some(method.into()),
            ..StudyOptions::default()
        };
        let model = read(path, &[]);
        let variations = varied(&model, &vary, &[], Together::default());
        let names: Vec<String> = variations.list().iter().map(|v| v.name.clone()).collect();
        let options = SweepOptions {
            study: study.clone(),
            samples: 0,
        };
        let sweep = sweep(&model, variations, options);
        assert!(sweep.is_compiled_once());
        for (index, outcome) in outcomes(&sweep, 8, 2).iter().enumerate() {
            let values: Vec<String> = sweep
                .values(index as u64)
                .iter()
                .map(f64::to_string)
                .collect();
            let set: Vec<(&str, &str)> = names
                .iter()
                .map(String::as_str)
                .zip(values.iter().map(String::as_str))
                .collect();
            let (start, end, steps) = single(read(path, &set), &study);
            assert_eq!(bits(&outcome.start), bits(&start), "{path} {set:?}");
            assert_eq!(bits(&outcome.end), bits(&end), "{path} {set:?}");
            assert_eq!(outcome.steps, steps, "{path} {set:?}");
            assert_eq!(outcome.stop, StopCode::End);
        }
    }
}

#[test]
fn other_formulations_and_orders_have_those_bits_too() {
    let study = StudyOptions {
        t_end: Some(1.0),
        ..StudyOptions::default()
    };
    let maggi = StudyOptions {
        formulation: Some("maggi".into()),
        ..study.clone()
    };
    for (path, name, study) in [
        (SLEIGH, "a", maggi),
        ("gallery/fixed-acceleration/model.toml", "", study),
    ] {
        let model = read(path, &[]);
        let name = match name {
            "" => model.parameters.first().expect("a parameter").name.clone(),
            name => name.to_owned(),
        };
        let base = model
            .parameters
            .iter()
            .find(|p| p.name == name)
            .and_then(|p| p.value);
        let base = base
            .and_then(|v| model.graph.evaluate_f64(&[v], &|_| None).ok())
            .expect("a value")[0];
        let range = format!("{name}={base}:{}:2", base * 1.125);
        let variations = varied(&model, &[&range], &[], Together::default());
        let sweep = sweep(
            &model,
            variations,
            SweepOptions {
                study: study.clone(),
                samples: 0,
            },
        );
        assert!(!sweep.is_compiled_once());
        for (index, outcome) in outcomes(&sweep, 1, 2).iter().enumerate() {
            let value = sweep.values(index as u64)[0].to_string();
            let (start, end, _) = single(read(path, &[(&name, &value)]), &study);
            assert_eq!(bits(&outcome.start), bits(&start), "{path} {value}");
            assert_eq!(bits(&outcome.end), bits(&end), "{path} {value}");
        }
    }
}

/// A pendulum that begins at rest, with an event at the bottom.
const PENDULUM: &str = "name = \"pendulum\"\ncoordinates = [\"theta\"]\nlagrangian = \"l^2 theta'^2/2 + G l cos(theta)\"\n[parameters]\nl = 2\nG = 9.81\n[initial]\ntheta = 0.5\n[simulation]\nt_end = 6\ntolerance = 1e-12\n[events.bottom]\nwhen = \"theta\"\n";

#[test]
fn threads_and_companions_do_not_change_a_bit() {
    let model = of_text(PENDULUM, &[]);
    let variations = varied(
        &model,
        &["l=1:3:5"],
        &["theta=0.1:3:7"],
        Together::default(),
    );
    let options = SweepOptions {
        study: StudyOptions::default(),
        samples: 4,
    };
    let sweep = sweep(&model, variations, options);
    let reference: Vec<Vec<u64>> = outcomes(&sweep, 1, 1).iter().map(bits_of).collect();
    assert_eq!(reference.len(), 35);
    for (size, threads) in [(35, 1), (4, 2), (3, 3), (2, 5)] {
        let found: Vec<Vec<u64>> = outcomes(&sweep, size, threads)
            .iter()
            .map(bits_of)
            .collect();
        assert_eq!(found, reference, "{size} {threads}");
    }
}

/// Their series are made four at a time. Pendulums of different length end at different times at the bottom, one without length
/// cannot begin: the others do not notice, and a trajectory that is computed by itself has no company.
#[test]
fn trajectories_side_by_side_do_not_see_each_other() {
    let text = format!("{PENDULUM}action = \"stop\"\n");
    let model = of_text(&text, &[]);
    let variations = varied(
        &model,
        &["l=0,0.5,1,3"],
        &["theta=0.1:3:7"],
        Together::default(),
    );
    let study = StudyOptions {
        method: Some("taylor".into()),
        ..StudyOptions::default()
    };
    let options = SweepOptions {
        study: study.clone(),
        samples: 3,
    };
    let sweep = sweep(&model, variations, options);
    assert!(sweep.is_compiled_once());
    let found = outcomes(&sweep, 28, 1);
    let reference: Vec<Vec<u64>> = found.iter().map(bits_of).collect();
    for (size, threads) in [(1, 1), (3, 2), (5, 1)] {
        let again: Vec<Vec<u64>> = outcomes(&sweep, size, threads)
            .iter()
            .map(bits_of)
            .collect();
        assert_eq!(again, reference, "{size} {threads}");
    }
    let mut steps = Vec::new();
    for (index, outcome) in found.iter().enumerate() {
        let values = sweep.values(index as u64);
        if values[0] == 0.0 {
            assert!(outcome.stop.is_failure(), "{outcome:?}");
            continue;
        }
        let (l, theta) = (values[0], values[1]);
        let quarter = (l / 9.81).sqrt() * complete_elliptic((theta / 2.0).sin());
        assert_eq!(outcome.stop, StopCode::Event(0));
        assert!(
            (outcome.t - quarter).abs() < 1e-11,
            "{l} {theta}: {}",
            outcome.t
        );
        steps.push(outcome.steps);
    }
    steps.sort_unstable();
    assert!(steps.len() == 21 && steps[0] < steps[20], "{steps:?}");
}

/// Discs without events: rows lie inside steps, some trajectories end where a disc lies flat, and orders and step sizes differ. Threads and companions do not change a bit, nor does asking for more rows change the end.
#[test]
fn discs_side_by_side_have_the_bits_of_each() {
    let model = read("gallery/falling-rolling-disc/model.toml", &[]);
    let ranges = ["lean=0.05:1.4:4", "r=0.2,1/3"];
    let study = StudyOptions {
        method: Some("taylor".into()),
        t_end: Some(3.0),
        ..StudyOptions::default()
    };
    let ends: Vec<Vec<Vec<u64>>> = [0, 5]
        .iter()
        .map(|&samples| {
            let variations = varied(&model, &ranges, &[], Together::default());
            let options = SweepOptions {
                study: study.clone(),
                samples,
            };
            let sweep = sweep(&model, variations, options);
            assert!(sweep.is_compiled_once());
            let found = outcomes(&sweep, 8, 1);
            let reference: Vec<Vec<u64>> = found.iter().map(bits_of).collect();
            for (size, threads) in [(1, 1), (3, 2)] {
                let again = outcomes(&sweep, size, threads);
                let again: Vec<Vec<u64>> = again.iter().map(bits_of).collect();
                assert_eq!(again, reference, "{samples} {size} {threads}");
            }
            found.iter().map(|outcome| bits(&outcome.end)).collect()
        })
        .collect();
    assert_eq!(ends[0].len(), 8);
    assert_eq!(ends[0], ends[1]);
}

/// The complete elliptic integral K by the arithmetic-geometric mean of Gauss: K(k) = π/(2 agm(1, √(1 − k²))).
fn complete_elliptic(k: f64) -> f64 {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..12 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    std::f64::consts::FRAC_PI_2 / a
}

#[test]
fn pendulums_pass_the_bottom_after_a_quarter_of_their_periods() {
    let model = of_text(PENDULUM, &[]);
    let variations = varied(
        &model,
        &["l=0.5:4:log:4"],
        &["theta=0.05:3:6"],
        Together::default(),
    );
    let sweep = sweep(&model, variations, SweepOptions::default());
    for (index, outcome) in outcomes(&sweep, 5, 2).iter().enumerate() {
        let values = sweep.values(index as u64);
        let (l, theta) = (values[0], values[1]);
        let quarter = (l / 9.81).sqrt() * complete_elliptic((theta / 2.0).sin());
        let seen = outcome.events[0];
        assert!(
            (seen.first - quarter).abs() < 1e-9,
            "{l} {theta}: {} {quarter}",
            seen.first
        );
        // Every half period once more, until t = 6.
        assert_eq!(
            seen.count as f64,
            ((6.0 / quarter + 1.0) / 2.0).floor(),
            "{l} {theta}"
        );
        assert!(outcome.drift[0] < 1e-9 * (1.0 + l * l), "{outcome:?}");
        assert_eq!(outcome.start, [theta, 0.0]);
    }
}

#[test]
fn sleighs_turn_as_their_closed_form_says() {
    // phi' = W/cosh(k t), forward speed V tanh(k t) (Chaplygin 1911; Neimark, Fufaev, ch. II); m = 1.5, J = 0.4.
    let model = read(SLEIGH, &[]);
    let variations = varied(
        &model,
        &["a=-0.4:0.5:4", "W=0.5:3:3"],
        &[],
        Together::default(),
    );
    let options = SweepOptions {
        study: StudyOptions {
            t_end: Some(7.0),
            ..StudyOptions::default()
        },
        samples: 8,
    };
    let sweep = sweep(&model, variations, options);
    for (index, outcome) in outcomes(&sweep, 3, 2).iter().enumerate() {
        let values = sweep.values(index as u64);
        let (a, w) = (values[0], values[1]);
        let inertia: f64 = 0.4 + 1.5 * a * a;
        let speed = w * (inertia / 1.5).sqrt();
        let k = 1.5 * a * speed / inertia;
        assert_eq!(outcome.samples.len(), 8 * 7);
        for (j, row) in outcome.samples.chunks_exact(7).enumerate() {
            let t = row[0];
            assert!((t - j as f64).abs() < 1e-12);
            let forward = row[4] * row[3].cos() + row[5] * row[3].sin();
            assert!(
                (row[6] - w / (k * t).cosh()).abs() < 1e-8,
                "{a} {w} {t}: {row:?}"
            );
            assert!(
                (forward - speed * (k * t).tanh()).abs() < 1e-8,
                "{a} {w} {t}: {row:?}"
            );
        }
        assert_eq!(bits(&outcome.samples[50..]), bits(&outcome.end));
    }
}

#[test]
fn ranges_make_products_and_are_walked_together() {
    let model = read(SLEIGH, &[]);
    let all = |v: &Variations| -> Vec<Vec<f64>> { (0..v.count()).map(|i| v.values(i)).collect() };
    let product = varied(
        &model,
        &["a=0.1:0.5:5", "W=1,2"],
        &["x=3"],
        Together::default(),
    );
    let expected: Vec<Vec<f64>> = [0.1, 0.2, 0.3, 0.4, 0.5]
        .iter()
        .flat_map(|&a| [vec![a, 1.0, 3.0], vec![a, 2.0, 3.0]])
        .collect();
    assert_eq!(all(&product), expected);
    let zip = Together {
        zip: true,
        ..Together::default()
    };
    let zipped = varied(&model, &["a=0.1:0.5:5", "W=1:16:log:5"], &[], zip);
    let values = all(&zipped);
    assert_eq!(values.len(), 5);
    for (j, row) in values.iter().enumerate() {
        assert!((row[1] - 2f64.powi(j as i32)).abs() < 1e-12, "{row:?}");
    }
    let random = |seed: u64| {
        let together = Together {
            count: Some(500),
            seed,
            ..Together::default()
        };
        all(&varied(
            &model,
            &["a=2:4:uniform", "W=2:4:uniform"],
            &["phi=0,1"],
            together,
        ))
    };
    let drawn = random(7);
    assert_eq!(drawn.len(), 1000);
    assert_eq!(drawn, random(7));
    assert_ne!(drawn, random(8));
    for place in 0..2 {
        let own: Vec<f64> = drawn[..500].iter().map(|row| row[place]).collect();
        let mean = own.iter().sum::<f64>() / 500.0;
        // The mean of 500 has the deviation 2/√(12·500) = 0.026.
        assert!(
            (mean - 3.0).abs() < 0.11 && own.iter().all(|x| (2.0..4.0).contains(x)),
            "{mean}"
        );
    }
    assert!(drawn.iter().all(|row| row[0] != row[1]));
    let table = "# cases\na, x'\n0.1, 1\n\n 0.2,-2.5e-3\n";
    let list = rows(&model, "cases.csv", table).expect("rows");
    let of_rows = Variations::new(list, Vec::new(), Together::default()).expect("a sweep");
    assert_eq!(all(&of_rows), [[0.1, 1.0], [0.2, -2.5e-3]]);
    // The same behind a byte order mark.
    let list = rows(&model, "cases.csv", &format!("\u{feff}{table}")).expect("rows");
    let of_rows = Variations::new(list, Vec::new(), Together::default()).expect("a sweep");
    assert_eq!(all(&of_rows), [[0.1, 1.0], [0.2, -2.5e-3]]);
}

/// The logarithms of the middles are the means of those of the ends, also where product and quotient of the ends are out of range.
#[test]
fn logarithmic_ranges_span_all_numbers() {
    let model = read(SLEIGH, &[]);
    for (range, middle) in [
        ("1e-200:1e-190", 1e-195),
        ("1e-300:1e300", 1.0),
        ("1e300:1e-300", 1.0),
        ("-1e300:-1e-300", -1.0),
        ("-1e200:-1e210", -1e205),
        ("1e-3:1e5", 10.0),
    ] {
        let text = format!("a={range}:log:3");
        let range = varied(&model, &[&text], &[], Together::default());
        let found = range.values(1)[0];
        assert!(
            ((found - middle) / middle).abs() < 1e-12,
            "{text}: {found:e}"
        );
    }
    for text in ["a=-1:1:log:3", "a=0:1:log:3", "a=1:0:log:3"] {
        assert!(
            Variation::parse(&model, ("--vary", text), false).is_err(),
            "{text}"
        );
    }
}

#[test]
fn mistakes_are_shown_at_their_place() {
    let cases: &[(&[&str], &[&str])] = &[
        (
            &["--vary", "aa=1:2:3"],
            &["no parameter `aa`", "--vary:1:1"],
        ),
        (&["--vary", "Wx=1:2:3"], &["no parameter `Wx`", "W=1:2:3"]),
        (
            &["--vary", "x=1:2:3"],
            &["`x` is a coordinate", "--initial"],
        ),
        (&["--initial", "a=1:2:3"], &["`a` is a parameter", "--vary"]),
        (&["--initial", "phj'=1:2:3"], &["phj", "phi'"]),
        (
            &["--vary", "a=1:2:zz:3"],
            &["no kind of range `zz`", "--vary:1:7"],
        ),
        (&["--vary", "a=1:2:0"], &["whole number", "--vary:1:7"]),
        (&["--vary", "a=1:q:4"], &["`q`", "--vary:1:5"]),
        (&["--vary", "a=0:2:log:4"], &["logarithmic"]),
        (&["--vary", "a=1:2"], &["this is no range"]),
        (&["--vary", "a"], &["no `=`"]),
        (&["--vary", "a=1:2:3", "--vary", "a=1"], &["varied twice"]),
        (
            &["--vary", "a=1:2:3", "--vary", "W=1,2", "--zip"],
            &["same number", "`a` has 3", "`W` has 2"],
        ),
        (&["--vary", "a=1:2:uniform"], &["--count"]),
        (&["--vary", "a=1:2:5", "--count", "4"], &["--count"]),
        (
            &["--vary", "a=1:2:uniform", "--count", "0"],
            &["--count is 0", "`a`"],
        ),
        (
            &["--vary", "a=1:2:5", "--set", "a=5"],
            &["`a` is varied", "--set"],
        ),
        (
            &["--vary", "a=1:2:5", "--tolerance", "-1e-5"],
            &["error: --tolerance -0.00001: ", "out of range"],
        ),
        (
            &["--vary", "a=1:2:5", "--tolerance", "5"],
            &["error: --tolerance 5: ", "out of range"],
        ),
        (
            &["--vary", "a=1:2:5", "--seed", "-1"],
            &["invalid value '-1' for '--seed <N>'"],
        ),
        (
            &["--vary", "a=1:2:5", "--method", "eular"],
            &["error: --method eular: ", "no method `eular`"],
        ),
        (
            &["--vary", "a=1:2:5", "--method", "rk4"],
            &["error: --method rk4: ", "fixed step"],
        ),
        (
            &["--vary", "a=1:2:5", "--step", "-1"],
            &["error: --step -1: ", "positive"],
        ),
        (
            &["--vary", "a=1:2:5", "--precision", "double-double"],
            &["error: --precision double-double: "],
        ),
        (&[], &["nothing varies"]),
        (
            &["--rows", "no-such-file.csv"],
            &["no-such-file.csv cannot be read"],
        ),
        // A dependent velocity that no trajectory admits.
        (&["--initial", "y'=1:2:3"], &["violates", "blade"]),
    ];
    let folder = scratch("sweep-mistakes");
    for (arguments, words) in cases {
        let out = folder.join("out");
        let all = [&["sweep", SLEIGH, "--out", text(&out)], *arguments].concat();
        let finished = run(&all);
        assert_eq!(
            finished.status,
            Some(2),
            "{arguments:?}: {}",
            finished.both()
        );
        for word in *words {
            assert!(
                finished.err.contains(word),
                "{arguments:?}: {word}: {}",
                finished.both()
            );
        }
        assert!(!out.exists(), "{arguments:?}");
    }
    let rows = folder.join("rows.csv");
    for (content, word) in [
        ("a,W\n1,2,3\n", "rows.csv:2:1"),
        ("a,W\n1,two\n", "rows.csv:2:3"),
        ("a,zz\n1,2\n", "`zz`"),
        ("", "no rows"),
    ] {
        std::fs::write(&rows, content).expect("a scratch file");
        let finished = run(&["sweep", SLEIGH, "--rows", text(&rows)]);
        assert_eq!(finished.status, Some(2), "{}", finished.both());
        assert!(finished.err.contains(word), "{word}: {}", finished.err);
    }
}

/// The columns of an archive, as numbers with their shapes.
fn archive(path: &Path) -> BTreeMap<String, (Vec<u64>, Vec<f64>)> {
    let file = std::fs::File::open(path).expect("an archive");
    let mut archive = zip::ZipArchive::new(file).expect("a ZIP archive");
    let mut columns = BTreeMap::new();
    for index in 0..archive.len() {
        let mut stored = archive.by_index(index).expect("a member");
        let name = stored
            .name()
            .expect("a name")
            .trim_end_matches(".npy")
            .to_owned();
        let mut bytes = Vec::new();
        stored.read_to_end(&mut bytes).expect("its bytes");
        let array = npyz::NpyFile::new(&bytes[..]).expect("an array");
        let shape = array.shape().to_vec();
        let is_float = array.dtype().descr().contains("f8");
        let values = match is_float {
            true => array.into_vec::<f64>().expect("doubles"),
            false => array
                .into_vec::<i64>()
                .expect("integers")
                .iter()
                .map(|&x| x as f64)
                .collect(),
        };
        columns.insert(name, (shape, values));
    }
    columns
}

/// Beside a coordinate `x_d` the array of the velocity `x'` has another name, in every archive.
#[test]
fn no_two_quantities_share_an_array() {
    let folder = scratch("same-names");
    let path = folder.join("model.toml");
    // Free motions: x moves with 2, x_d with 3; the energy is 13/2, the coordinate `energy` rests at 7.
    let model = "coordinates = [\"x\", \"x_d\", \"energy\"]\nlagrangian = \"(x'^2 + x_d'^2 + energy'^2)/2\"\n[initial]\nx = 0\nx_d = 5\nenergy = 7\n\"x'\" = 2\n\"x_d'\" = 3\n\"energy'\" = 0\n[simulation]\nt_end = 1\noutput = 2\n";
    std::fs::write(&path, model).expect("a scratch file");
    let at_end = |name: &str, quantity: &str| {
        let columns = archive(&folder.join(name));
        let found = columns
            .get(quantity)
            .and_then(|(_, values)| values.last().copied());
        found.unwrap_or_else(|| panic!("{quantity} among {:?}", columns.keys()))
    };
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-9, "{found}, not {expected}")
    };
    ok(&["simulate", text(&path), "--out", text(&folder)]);
    near(at_end("trajectory.npz", "x_d"), 8.0);
    near(at_end("trajectory.npz", "x_d_2"), 2.0);
    near(at_end("trajectory.npz", "x_d_d"), 3.0);
    near(at_end("trajectory.npz", "energy"), 7.0);
    near(at_end("trajectory.npz", "energy_2"), 6.5);
    ok(&[
        "sweep",
        text(&path),
        "--initial",
        "x'=1,4",
        "--out",
        text(&folder),
    ]);
    near(at_end("sweep.npz", "vary_x_d_2"), 4.0);
    near(at_end("sweep.npz", "end_x_d_2"), 4.0);
    near(at_end("sweep.npz", "end_x_d"), 8.0);
}

#[test]
fn an_archive_holds_all_columns_and_the_reasons_of_failures() {
    let folder = scratch("sweep-archive");
    let model = folder.join("model.toml");
    // A root that becomes singular at x = 1, unless the motion is slow; an event that ends the run.
    let content = "name = \"falling\"\ncoordinates = [\"x\"]\nassumptions = [\"m > 0\"]\n[parameters]\nm = 1\n[lagrangian]\nT = \"1/2 m x'^2\"\nV = \"-sqrt(1 - x)\"\n[initial]\nx = 0\n\"x'\" = 2\n[simulation]\nt_end = 2\n[events.left]\nwhen = \"x + 1\"\naction = \"stop\"\n";
    std::fs::write(&model, content).expect("a scratch file");
    let out = folder.join("out");
    let rows = folder.join("rows.csv");
    std::fs::write(&rows, "m,x'\n1,0\n1,2\n-1,0\n1,-2\n4,0.5\n").expect("a scratch file");
    let arguments = [
        "sweep",
        text(&model),
        "--rows",
        text(&rows),
        "--samples",
        "3",
        "--out",
        text(&out),
        "--json",
    ];
    let said = ok(&arguments).json();
    let count = |key: &str| said[key].as_u64();
    assert_eq!(count("trajectories"), Some(5));
    assert_eq!(
        (count("ended_early"), count("not_started")),
        (Some(1), Some(1))
    );
    assert_eq!(said["events"]["left"].as_u64(), Some(1));
    let columns = archive(&out.join("sweep.npz"));
    let names: Vec<&str> = said["columns"]
        .as_array()
        .expect("names")
        .iter()
        .filter_map(|n| n.as_str())
        .collect();
    assert_eq!(names.len(), columns.len());
    let column = |name: &str| &columns[name].1;
    assert_eq!(*column("vary_x_d"), [0.0, 2.0, 0.0, -2.0, 0.5]);
    assert_eq!(*column("stop"), [0.0, 1.0, 2.0, 10.0, 0.0]);
    assert_eq!(columns["sample_x"].0, [5, 3]);
    assert_eq!(column("sample_t")[..3], [0.0, 1.0, 2.0]);
    assert_eq!(
        column("sample_x")[2].to_bits(),
        column("end_x")[0].to_bits()
    );
    assert!(
        (column("end_x")[3] + 1.0).abs() < 1e-12 && column("t_stop")[3] == column("first_left")[3]
    );
    assert!(column("sample_x")[5].is_nan() && column("end_x")[2].is_nan());
    assert_eq!(*column("count_left"), [0.0, 0.0, 0.0, 1.0, 0.0]);
    let failures = std::fs::read_to_string(out.join("failures.csv")).expect("the reasons");
    let lines: Vec<&str> = failures.lines().collect();
    assert_eq!(lines.len(), 3, "{failures}");
    assert!(
        lines[1].starts_with("1,") && lines[1].contains("singular"),
        "{failures}"
    );
    assert!(
        lines[2].starts_with("2,") && lines[2].contains("m > 0"),
        "{failures}"
    );
    // Nothing is left of the blocks, and the same command computes nothing.
    assert!(!out.join("sweep.data").exists() && !out.join("sweep.journal").exists());
    assert!(ok(&arguments).err.contains("is complete"));
    let other = run(&[
        "sweep",
        text(&model),
        "--rows",
        text(&rows),
        "--tolerance",
        "1e-7",
        "--out",
        text(&out),
    ]);
    assert_eq!(other.status, Some(2), "{}", other.both());
    assert!(
        other.err.contains("another sweep") && other.err.contains("tolerance (1e-10"),
        "{}",
        other.err
    );
    let early = folder.join("early");
    let sweep = |more: &[&str]| {
        let own = ["sweep", text(&model), "--rows", text(&rows)];
        run(&[&own[..], &["--out", text(&early)], more].concat())
    };
    let whole = |again: &str| {
        let stopped = sweep(&["--stop-on-failure"]);
        assert_eq!(stopped.status, Some(3), "{again}: {}", stopped.both());
        let word = "trajectory 1 (m = 1, x' = 2): ";
        assert!(stopped.err.contains(word), "{again}: {}", stopped.err);
        assert!(stopped.err.contains("singular"), "{again}: {}", stopped.err);
    };
    whole("at first");
    assert!(!early.join("sweep.npz").exists());
    whole("where it is stored");
    assert!(!early.join("sweep.npz").exists());
    assert_eq!(sweep(&[]).status, Some(0));
    whole("in a sweep that is complete");
}

/// Which threads take trajectories of an ensemble.
struct Seen<'a>(
    &'a dyn pool::Work,
    std::sync::Mutex<Vec<std::thread::ThreadId>>,
);

struct SeenThread<'a>(&'a Seen<'a>, Box<dyn pool::Worker + 'a>);

impl pool::Work for Seen<'_> {
    fn worker(&self, most: usize) -> Box<dyn pool::Worker + '_> {
        Box::new(SeenThread(self, self.0.worker(most)))
    }

    fn count(&self) -> u64 {
        self.0.count()
    }
}

impl pool::Worker for SeenThread<'_> {
    fn work(
        &mut self,
        next: &dyn Fn() -> Option<u64>,
        done: &dyn Fn(u64, Outcome),
        interrupt: &AtomicBool,
    ) {
        let SeenThread(seen, worker) = self;
        let next = || {
            let own = std::thread::current().id();
            next().inspect(|_| seen.1.lock().expect("a list").push(own))
        };
        worker.work(&next, done, interrupt);
    }
}

/// By the method `taylor` a thread has four trajectories under way, if the others have some too.
#[test]
fn few_long_trajectories_are_those_of_all_threads() {
    let model = of_text(PENDULUM, &[]);
    for method in ["taylor", "dormand-prince-853"] {
        let study = StudyOptions {
            t_end: Some(3000.0),
            method: Some(method.into()),
            ..StudyOptions::default()
        };
        let variations = varied(&model, &["l=1:2:8"], &[], Together::default());
        let sweep = sweep(&model, variations, SweepOptions { study, samples: 0 });
        let work = sweep.work();
        let seen = Seen(&*work, std::sync::Mutex::default());
        let (nobody, mut found) = (AtomicBool::new(false), 0);
        let all = 0..8;
        let wanted = std::slice::from_ref(&all);
        pool::run(&seen, (wanted, 4), &nobody, |batch| {
            found += batch.len();
            ControlFlow::Continue(())
        });
        assert_eq!(found, 8);
        let taken = seen.1.into_inner().expect("a list");
        let mut threads = Vec::new();
        for thread in taken {
            if !threads.contains(&thread) {
                threads.push(thread);
            }
        }
        assert_eq!(threads.len(), 4, "{method}");
    }
}

/// A sweep of some seconds.
fn long(out: &Path, threads: &str) -> Vec<String> {
    let arguments = [
        "sweep",
        SLEIGH,
        "--vary",
        "a=0.1:0.5:40",
        "--vary",
        "W=1:4:100",
        "--t-end",
        "60",
        "--samples",
        "3",
        "--threads",
        threads,
    ];
    let mut all: Vec<String> = arguments.map(String::from).to_vec();
    all.extend(["--out".into(), text(out).into()]);
    all
}

/// The whole lines of a journal.
fn journal(out: &Path) -> Vec<u8> {
    let mut bytes = std::fs::read(out.join("sweep.journal")).unwrap_or_default();
    let whole = bytes
        .iter()
        .rposition(|&b| b == b'\n')
        .map_or(0, |at| at + 1);
    bytes.truncate(whole);
    bytes
}

#[test]
fn a_sweep_that_is_killed_goes_on_and_ends_with_the_same_bits() {
    let folder = scratch("sweep-killed");
    let whole: PathBuf = folder.join("whole");
    let list = long(&whole, "1");
    let began = Instant::now();
    ok(&list.iter().map(String::as_str).collect::<Vec<_>>());
    let took = began.elapsed();
    let out = folder.join("killed");
    let list = long(&out, "2");
    let arguments: Vec<&str> = list.iter().map(String::as_str).collect();
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    let (mut kills, mut kept) = (0, Vec::new());
    while kills < 5 {
        let mut child = command(&root(), &arguments)
            .spawn()
            .expect("the program starts");
        let lines = kept.iter().filter(|&&b| b == b'\n').count();
        // Some batches more, and then a random moment.
        let waiting = Instant::now();
        while journal(&out).iter().filter(|&&b| b == b'\n').count() <= lines {
            let is_over =
                out.join("sweep.npz").exists() || waiting.elapsed() > Duration::from_secs(60);
            if is_over || child.try_wait().expect("a process").is_some() {
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let moment = took.as_micros() as u64 / 100;
        std::thread::sleep(Duration::from_micros((random >> 33) % moment.max(1)));
        child.kill().expect("a process");
        child.wait().expect("a process");
        kills += 1;
        if out.join("sweep.npz").exists() {
            break;
        }
        // Batches are on the disk as they end, what was there before still is, and none was computed twice.
        let now = journal(&out);
        assert!(now.starts_with(&kept), "kill {kills}");
        assert!(now.len() > kept.len() || kills > 1, "kill {kills}");
        assert!(!out.join("sweep.npz").exists());
        kept = now;
    }
    assert!(kills >= 2, "{kills}");
    let last = ok(&arguments).both();
    assert!(
        last.contains("were computed before") || last.contains("is complete"),
        "{last}"
    );
    for name in ["sweep.npz", "failures.csv"] {
        let of = |folder: &Path| std::fs::read(folder.join(name)).expect("a result");
        assert!(of(&whole) == of(&out), "{name} differs");
    }
}

/// Waits until something holds.
fn wait_for(what: &str, mut holds: impl FnMut() -> bool) {
    let waiting = Instant::now();
    while !holds() {
        assert!(waiting.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// How many trajectories a journal says are written.
fn stored(out: &Path) -> u64 {
    let lines = String::from_utf8(journal(out)).expect("a journal");
    let counts = lines.lines().filter_map(|line| line.split(' ').next());
    counts.map(|n| n.parse::<u64>().expect("a number")).sum()
}

#[test]
fn a_folder_is_for_one_process_at_a_time() {
    let out = scratch("sweep-twice").join("out");
    let list = long(&out, "1");
    let arguments: Vec<&str> = list.iter().map(String::as_str).collect();
    let mut first = command(&root(), &arguments)
        .spawn()
        .expect("the program starts");
    wait_for("a batch is written", || stored(&out) > 0);
    let second = run(&arguments);
    let still_runs = first.try_wait().expect("a process").is_none();
    // A killed process holds nothing.
    first.kill().expect("a process");
    first.wait().expect("a process");
    assert!(still_runs, "the first process ended too early");
    assert_eq!(second.status, Some(2), "{}", second.both());
    for word in ["another process", text(&out), "--out"] {
        assert!(second.err.contains(word), "{word}: {}", second.err);
    }
    let third = ok(&arguments);
    assert!(third.err.contains("computed before"), "{}", third.err);
}

#[test]
fn bytes_that_change_while_a_sweep_runs_do_not_get_into_its_results() {
    let folder = scratch("sweep-damaged");
    let whole = folder.join("whole");
    let list = long(&whole, "2");
    ok(&list.iter().map(String::as_str).collect::<Vec<_>>());
    let out = folder.join("out");
    let list = long(&out, "1");
    let arguments: Vec<&str> = list.iter().map(String::as_str).collect();
    let child = command(&root(), &arguments)
        .spawn()
        .expect("the program starts");
    wait_for("a batch is written", || stored(&out) > 0);
    let before = journal(&out);
    let line = String::from_utf8(before).expect("a journal");
    let count: usize = line
        .split(' ')
        .next()
        .and_then(|n| n.parse().ok())
        .expect("a number");
    // A bit of the first number of the first column, behind the numbers of the trajectories.
    let data = out.join("sweep.data");
    let flip = || -> std::io::Result<()> {
        use std::io::{Seek, SeekFrom, Write};
        let mut options = std::fs::OpenOptions::new();
        let mut file = options.read(true).write(true).open(&data)?;
        let mut byte = [0];
        file.seek(SeekFrom::Start(8 * count as u64))?;
        file.read_exact(&mut byte)?;
        file.seek(SeekFrom::Start(8 * count as u64))?;
        file.write_all(&[byte[0] ^ 1])
    };
    flip().expect("a file of data");
    let finished = child.wait_with_output().expect("a process");
    let said = String::from_utf8_lossy(&finished.stderr);
    assert_eq!(finished.status.code(), Some(2), "{said}");
    assert!(said.contains("damaged") && said.contains("again"), "{said}");
    assert!(!out.join("sweep.npz").exists());
    // Only what was damaged is computed again.
    let again = ok(&arguments);
    let kept = format!("{} of 4000 trajectories", 4000 - count);
    assert!(again.err.contains(&kept), "{kept}: {}", again.err);
    let bytes = |folder: &Path| std::fs::read(folder.join("sweep.npz")).expect("a result");
    assert!(bytes(&whole) == bytes(&out));
}

/// Seven short trajectories, and one that does not end as long as anyone waits: what has ended is not lost with it.
#[cfg(unix)]
#[test]
fn what_has_ended_is_kept_while_others_are_under_way() {
    let folder = scratch("sweep-slow");
    let model = folder.join("model.toml");
    let content = PENDULUM.replace(
        "tolerance = 1e-12",
        "tolerance = 1e-12\nmax_steps = 1000000000",
    );
    let (content, _) = content.split_once("[events").expect("an event");
    std::fs::write(&model, content).expect("a scratch file");
    for method in ["taylor", "dormand-prince-853"] {
        let out = folder.join(method);
        let ranges = ["--vary", "G=9,1e18,3,4,5,6,7,8", "--threads", "2"];
        let own = [
            "sweep",
            text(&model),
            "--method",
            method,
            "--out",
            text(&out),
        ];
        let arguments = [&own[..], &ranges[..]].concat();
        let start = || {
            command(&root(), &arguments)
                .spawn()
                .expect("the program starts")
        };
        let mut killed = start();
        wait_for("seven trajectories are written", || stored(&out) == 7);
        killed.kill().expect("a process");
        killed.wait().expect("a process");
        let before = journal(&out);
        let interrupted = start();
        // Long enough for the program to listen and to be at work.
        std::thread::sleep(Duration::from_secs(3));
        let sent = std::process::Command::new("kill")
            .args(["-INT", &interrupted.id().to_string()])
            .status();
        assert!(sent.expect("kill").success());
        let finished = interrupted.wait_with_output().expect("a process");
        let said = String::from_utf8_lossy(&finished.stderr);
        assert_eq!(finished.status.code(), Some(3), "{method}: {said}");
        for word in [
            "7 of 8 trajectories were computed before",
            "7 of 8 trajectories are kept",
        ] {
            assert!(said.contains(word), "{method}: {word}: {said}");
        }
        assert_eq!(journal(&out), before, "{method}: nothing is computed twice");
    }
}

#[test]
fn a_torn_journal_and_a_changed_block_are_computed_again() {
    let folder = scratch("sweep-torn");
    let list = |out: &Path| {
        let arguments = [
            "sweep",
            SLEIGH,
            "--vary",
            "a=0.1:0.5:40",
            "--t-end",
            "2",
            "--out",
        ];
        let mut all: Vec<String> = arguments.map(String::from).to_vec();
        all.push(text(out).into());
        all
    };
    let run_list = |list: &[String], more: &[&str]| {
        let arguments: Vec<&str> = list
            .iter()
            .map(String::as_str)
            .chain(more.iter().copied())
            .collect();
        run(&arguments)
    };
    let whole = folder.join("whole");
    assert_eq!(run_list(&list(&whole), &[]).status, Some(0));
    let bytes = std::fs::read(whole.join("sweep.npz")).expect("a result");
    let record = std::fs::read(whole.join("sweep.json")).expect("a record");
    for spoil in 0..3 {
        let out = folder.join(format!("torn-{spoil}"));
        std::fs::create_dir_all(&out).expect("a scratch folder");
        std::fs::write(out.join("sweep.json"), &record).expect("a scratch file");
        let (data, journal) = match spoil {
            0 => (b"no block".to_vec(), b"0 0 8 00".to_vec()),
            1 => (
                Vec::new(),
                chetaev::ensemble::Record::new(2, 0, b"lost bytes")
                    .line()
                    .into_bytes(),
            ),
            _ => (
                b"other bytes".to_vec(),
                chetaev::ensemble::Record::new(0, 0, b"those bytes")
                    .line()
                    .into_bytes(),
            ),
        };
        std::fs::write(out.join("sweep.data"), data).expect("a scratch file");
        std::fs::write(out.join("sweep.journal"), journal).expect("a scratch file");
        let finished = run_list(&list(&out), &[]);
        assert_eq!(finished.status, Some(0), "{}", finished.both());
        assert!(
            !finished.err.contains("computed before"),
            "{}",
            finished.err
        );
        assert!(
            std::fs::read(out.join("sweep.npz")).expect("a result") == bytes,
            "{spoil}"
        );
    }
    // Results without a record of what they are.
    let unknown = folder.join("unknown");
    std::fs::create_dir_all(&unknown).expect("a scratch folder");
    std::fs::write(unknown.join("sweep.npz"), b"").expect("a scratch file");
    let refused = run_list(&list(&unknown), &[]);
    assert_eq!(refused.status, Some(2), "{}", refused.both());
    assert!(refused.err.contains("sweep.json"), "{}", refused.err);
}
