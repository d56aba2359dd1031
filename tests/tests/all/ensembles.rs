//! Sweeps: every trajectory is that of a single run, bit for bit, whatever the threads; closed forms over ranges of parameters.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::ensemble::{pool, Outcome, StopCode};
use chetaev::model::{load, Model, NoFiles};
use chetaev::study::sweep::together::{Together, Variations};
use chetaev::study::sweep::vary::{rows, Variation};
use chetaev::study::sweep::{Sweep, SweepOptions};
use chetaev::study::{study, ClaimSelection, Hooks, StudyOptions};
use chetaev_tests::places::{root, scratch};
use chetaev_tests::program::{run, text};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

pub(crate) const SLEIGH: &str = "gallery/chaplygin-sleigh/model.toml";

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
pub(crate) const PENDULUM: &str = "name = \"pendulum\"\ncoordinates = [\"theta\"]\nlagrangian = \"l^2 theta'^2/2 + G l cos(theta)\"\n[parameters]\nl = 2\nG = 9.81\n[initial]\ntheta = 0.5\n[simulation]\nt_end = 6\ntolerance = 1e-12\n[events.bottom]\nwhen = \"theta\"\n";

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
