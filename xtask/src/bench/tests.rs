//! The page from a small record whose figures were chosen by hand.

use super::page::{page, plots, with_claims, MARKS};
use super::results::{median, Results, Row, Status};
use super::targets::targets;
use super::{name, parse, plan, wanted, workplace, Arguments};
use serde_json::json;

fn row(item: &str, system: &str, peer: &str, form: &str, variant: &str, seconds: &[f64]) -> Row {
    Row {
        item: item.into(),
        system: system.into(),
        peer: peer.into(),
        form: form.into(),
        variant: variant.into(),
        seconds: seconds.to_vec(),
        wall: seconds.to_vec(),
        deviation: Some(1e-15),
        ..Row::default()
    }
}

fn small() -> Results {
    let mut results = Results {
        date: "2026-01-02".into(),
        ..Results::default()
    };
    results.rows = vec![
        row(
            "rhs",
            "disc",
            "chetaev",
            "text",
            "kane",
            &[40e-9, 50e-9, 45e-9],
        ),
        row("rhs", "disc", "chetaev", "text", "kane batch", &[10e-9]),
        row("rhs", "disc", "gcc", "hand", "C", &[30e-9]),
        row("derive", "bicycle", "chetaev", "text", "flow", &[0.01]),
        Row {
            status: Status::Wrong,
            reason: "off by 4.5e0".into(),
            deviation: Some(4.5),
            ..row("derive", "bicycle", "sympy", "derived", "Kane", &[0.001])
        },
        row("derive", "bicycle", "casadi", "derived", "reduced", &[0.5]),
    ];
    results.rows[5].parts = json!({"derive": 0.02, "compile": 0.48});
    results
}

fn met(results: &Results, what: &str) -> Option<bool> {
    let all = targets(results);
    let found = all.iter().find(|target| target.what == what);
    assert!(found.is_some(), "{what}");
    found.and_then(|target| target.met)
}

#[test]
fn a_median_is_the_middle() {
    assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
    assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
    assert!(median(&[]).is_nan());
}

#[test]
fn a_row_that_loses_says_so() {
    let text = page(&small());
    // 45 ns against 30 ns; our batch is no right-hand side of one state, but our fastest.
    assert_eq!(
        met(&small(), "disc: right-hand side, over gcc's hand form"),
        Some(false)
    );
    assert!(
        text.contains(
            "| disc: right-hand side, over gcc's hand form | ≤ 1.00 | 1.50 | **not met** |"
        ),
        "{text}"
    );
    let mut slow = small();
    slow.rows.remove(1);
    let text = page(&slow);
    assert!(text.contains("- right-hand side, disc: gcc, hand, C is 1.50 times as fast as our fastest (30.0 ns, 45.0 ns)."), "{text}");
}

#[test]
fn a_wrong_answer_does_not_count() {
    let results = small();
    // Its millisecond would win.
    assert_eq!(
        met(&results, "bicycle: derivation and native code, over sympy"),
        None
    );
    let text = page(&results);
    assert!(text.contains("sympy: off by 4.5e0"), "{text}");
    assert!(text.contains("| derivation and native code | bicycle | – | sympy, derived, Kane | wrong | off by 4.5e0 |"), "{text}");
    assert!(!text.contains("1.00 ms"), "{text}");
}

#[test]
fn ratios_decide_targets() {
    let results = small();
    assert_eq!(
        met(&results, "bicycle: derivation and native code, over casadi"),
        Some(true)
    );
    assert_eq!(
        met(
            &results,
            "bicycle: derivation and native code, over casadi's derivation alone"
        ),
        Some(true)
    );
    assert_eq!(
        met(
            &results,
            "disc: right-hand side batched, over our own of one state"
        ),
        Some(true)
    );
    assert_eq!(met(&results, "snake-128: derivation and native code"), None);
}

#[test]
fn trajectories_are_compared_at_equal_errors() {
    let at =
        |peer: &str, form: &str, variant: &str, tolerance: f64, error: f64, seconds: f64| Row {
            tolerance: Some(tolerance),
            deviation: Some(error),
            ..row("trajectory", "disc", peer, form, variant, &[seconds])
        };
    let rows = vec![
        at("heyoka", "hand", "plain", 1e-9, 1e-8, 2.0),
        // Fast, but not as exact.
        at("chetaev", "text", "taylor", 1e-6, 1e-5, 0.1),
        at("chetaev", "text", "taylor", 1e-9, 2e-8, 3.0),
        at("chetaev", "text", "taylor", 1e-12, 1e-11, 5.0),
    ];
    let mut results = Results {
        rows,
        ..Results::default()
    };
    let what = "disc: trajectory at the error of heyoka's hand form at 1e-9";
    let found = |results: &Results| {
        let all = targets(results);
        let target = all.iter().find(|t| t.what == what);
        target.map(|t| (t.measured.clone(), t.met))
    };
    assert_eq!(found(&results), Some((Ok("1.50".into()), Some(false))));
    // Who never comes so close has not met the target.
    results.rows.retain(|row| row.tolerance != Some(1e-12));
    results.rows.retain(|row| row.deviation != Some(2e-8));
    assert_eq!(found(&results).and_then(|f| f.1), Some(false));
    results.rows.retain(|row| row.peer != "chetaev");
    assert_eq!(found(&results).and_then(|f| f.1), None);
}

#[test]
fn the_load_of_the_machine_is_said() {
    let mut results = small();
    results.quick = true;
    results.rows[0].load = [2.5, 3.5];
    let text = page(&results);
    assert!(text.contains("its load average was 0 to 3.50"), "{text}");
    assert!(text.contains("quick run"), "{text}");
}

#[test]
fn the_readme_gets_its_figures_between_marks() {
    let readme = format!("a\n{}\nold\n{}\nb\n", MARKS[0], MARKS[1]);
    let text = with_claims(&readme, &small()).unwrap_or_default();
    assert!(text.starts_with("a\n") && text.ends_with("\nb\n"), "{text}");
    assert!(!text.contains("old"), "{text}");
    assert!(text.contains("casadi takes 50.0 times as long"), "{text}");
    assert!(!text.contains("sympy"), "{text}");
    assert_eq!(with_claims("no marks", &small()), None);
}

#[test]
fn what_is_measured_is_not_measured_again() {
    let extent = plan::Extent {
        quick: true,
        peers: true,
    };
    let items = plan::items(extent);
    let item = items.iter().find(|item| name(item) == "rhs/disc");
    let Some(item) = item else {
        panic!("the disc has a right-hand side");
    };
    let asked = |words: &[&str]| -> Arguments {
        let words: Vec<String> = words.iter().map(|w| w.to_string()).collect();
        parse(&words).unwrap_or_default()
    };
    let left = wanted(item, &small(), &asked(&[]));
    assert_eq!(left.len(), item.participants.len() - 3);
    assert_eq!(
        wanted(item, &small(), &asked(&["--again"])).len(),
        item.participants.len()
    );
    let only = wanted(
        item,
        &Results::default(),
        &asked(&["--only", "rhs/disc/gcc"]),
    );
    assert_eq!(only.len(), 1);
    assert!(parse(&["--only".to_string()]).is_err());
    assert!(parse(&["--fast".to_string()]).is_err());
}

#[test]
fn without_peers_only_we_are_asked() {
    let extent = plan::Extent {
        quick: false,
        peers: false,
    };
    for item in plan::items(extent) {
        assert!(
            item.participants.iter().all(|p| p.peer == "chetaev"),
            "{item:?}"
        );
    }
}

/// The largest of what all rows took is compared; those that were not measured are told, and nothing is said where none was.
#[test]
fn rows_of_the_table_have_a_target() {
    let what = "2 rows of the table of elasticity at d = 3";
    let (wall, memory) = (
        format!("{what}: wall of the slowest"),
        format!("{what}: largest memory"),
    );
    assert!(targets(&small())
        .iter()
        .all(|own| !own.what.contains("table")));
    let of = |system: &str, seconds: f64, memory: f64| Row {
        parts: json!({"memory": memory}),
        ..row("table", system, "chetaev", "text", "study", &[seconds])
    };
    let mut results = small();
    results
        .rows
        .extend([of("p4p", 2.0, 4e8), of("pc", 9.0, 2e7)]);
    assert_eq!(met(&results, &wall), Some(true));
    assert_eq!(met(&results, &memory), Some(true));
    let slow = results.rows.len() - 1;
    results.rows[slow] = of("pc", 11.0, 6e8);
    assert_eq!(met(&results, &wall), Some(false));
    assert_eq!(met(&results, &memory), Some(false));
    results.rows[slow].status = Status::Failed;
    assert_eq!(met(&results, &wall), None);
}

#[test]
fn every_row_of_the_table_is_measured() {
    let folder = workplace::root().join("gallery/elasticity");
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let rows = entries.filter(|own| own.path().join("model.toml").is_file());
    let mut rows: Vec<String> = rows
        .map(|own| own.file_name().to_string_lossy().into_owned())
        .collect();
    let mut measured = plan::TABLE.to_vec();
    rows.sort_unstable();
    measured.sort_unstable();
    assert_eq!(rows, measured);
}

#[test]
fn keys_are_different() {
    let extent = plan::Extent {
        quick: false,
        peers: true,
    };
    let mut keys: Vec<String> = plan::items(extent)
        .iter()
        .flat_map(|item| {
            let key = |p: &plan::Participant| format!("{}/{p:?}", name(item));
            item.participants.iter().map(key).collect::<Vec<_>>()
        })
        .collect();
    let count = keys.len();
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), count);
}

/// The committed pages are those of the committed results.
#[test]
fn pages_agree_with_the_results() {
    let root = workplace::root();
    let results = match Results::read(&root.join("bench/results.json")) {
        Ok(results) => results,
        Err(problem) => panic!("{problem}"),
    };
    let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap_or_default();
    let advice = "run `cargo xtask bench --page`";
    let same = |file: &str, generated: Option<String>| {
        let (there, generated) = (read(file), generated.unwrap_or_default());
        let lines = there.lines().zip(generated.lines());
        let other = lines.into_iter().find(|(old, new)| old != new);
        assert_eq!(other, None, "{file}: {advice}");
        assert_eq!(there.len(), generated.len(), "{file}: {advice}");
    };
    same("docs/book/benchmark.md", Some(page(&results)));
    same("README.md", with_claims(&read("README.md"), &results));
    for (name, svg) in plots(&results) {
        same(&format!("docs/book/benchmark/{name}"), Some(svg));
    }
    let keys = results.rows.iter().map(Row::key);
    let mut keys: Vec<String> = keys.collect();
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), results.rows.len());
}

#[test]
fn results_survive_their_file() {
    let path = std::env::temp_dir().join(format!("chetaev-bench-{}.json", std::process::id()));
    let mut results = small();
    results.rows[0].curve = Some([vec![1.0, 2.0], vec![1e-16, 2e-16]]);
    results.rows[0].tolerance = Some(1e-15);
    let written = results.write(&path);
    assert_eq!(written, Ok(()));
    assert_eq!(Results::read(&path), Ok(results));
    let _ = std::fs::remove_file(&path);
}
