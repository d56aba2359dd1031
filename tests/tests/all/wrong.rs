//! The models that are wrong on purpose: each is refused with exit status 2 and the words of its first line, at its place, and
//! leaves nothing behind.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places;
use chetaev_tests::program::{run, text, Finished};
use chetaev_tests::words::{in_parallel, missing};
use std::path::{Path, PathBuf};

/// What the first line of a file promises.
struct Promise {
    path: PathBuf,
    name: String,
    exit: i32,
    words: Vec<String>,
}

fn promises() -> Vec<Promise> {
    places::wrong().into_iter().map(promise).collect()
}

/// `# expect: exit 2; message contains: a, b|c`.
fn promise(path: PathBuf) -> Promise {
    let source = std::fs::read_to_string(&path).expect("the file can be read");
    let line = source.lines().next().unwrap_or("");
    let (exit, words) = line
        .strip_prefix("# expect: exit ")
        .and_then(|rest| rest.split_once("; message contains: "))
        .unwrap_or_else(|| panic!("{}: the first line is `{line}`", path.display()));
    Promise {
        name: path
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .into_owned(),
        exit: exit.parse().expect("an exit status"),
        words: words.split(", ").map(str::to_owned).collect(),
        path,
    }
}

/// File names in the tables of `gallery/wrong/README.md` below a heading.
fn listed(heading: &str) -> Vec<String> {
    let readme = places::root().join("gallery/wrong/README.md");
    let readme = std::fs::read_to_string(readme).expect("a README");
    let (_, section) = readme.split_once(heading).expect("the heading");
    let section = section.split("\n## ").next().unwrap_or(section);
    section
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split('`').next())
        .map(str::to_owned)
        .collect()
}

fn model(promise: &Promise) -> String {
    format!("gallery/wrong/{}.toml", promise.name)
}

/// What does not agree with the promise.
fn broken(promise: &Promise, command: &str, finished: &Finished) -> Vec<String> {
    let mut found = Vec::new();
    if finished.status != Some(promise.exit) {
        found.push(format!(
            "exit {:?} instead of {}",
            finished.status, promise.exit
        ));
    }
    let absent = missing(&finished.err, promise.words.iter().map(String::as_str));
    if !absent.is_empty() {
        found.push(format!("does not say {absent:?}"));
    }
    if finished.panicked() {
        found.push("panics".into());
    }
    found
        .into_iter()
        .map(|f| format!("{command} {}: {f}\n{}", promise.name, finished.both()))
        .collect()
}

fn none(failures: Vec<Vec<String>>) {
    let failures = failures.concat();
    assert!(
        failures.is_empty(),
        "{} failures\n{}",
        failures.len(),
        failures.join("\n")
    );
}

#[test]
fn every_file_is_described_once() {
    let mut described = listed("## Mistakes in the text");
    described.extend(listed("## Mistakes in the mechanics"));
    described.sort();
    let present: Vec<String> = promises().into_iter().map(|p| p.name).collect();
    assert_eq!(described, present);
}

#[test]
fn study_refuses_each_with_its_words_and_writes_nothing() {
    let scratch = places::scratch("wrong");
    none(in_parallel(&promises(), |promise| {
        let out = scratch.join(&promise.name);
        let finished = run(&["study", &model(promise), "--out", text(&out)]);
        let mut found = broken(promise, "study", &finished);
        if out.exists() {
            found.push(format!("study {} leaves {}", promise.name, out.display()));
        }
        found
    }));
}

#[test]
fn simulate_refuses_each_with_its_words_and_writes_nothing() {
    let scratch = places::scratch("wrong-simulate");
    none(in_parallel(&promises(), |promise| {
        let out = scratch.join(&promise.name);
        let finished = run(&["simulate", &model(promise), "--out", text(&out)]);
        let mut found = broken(promise, "simulate", &finished);
        if out.exists() {
            found.push(format!(
                "simulate {} leaves {}",
                promise.name,
                out.display()
            ));
        }
        found
    }));
}

#[test]
fn check_and_derive_refuse_mistakes_in_the_text() {
    let in_text = listed("## Mistakes in the text");
    let promises: Vec<Promise> = promises()
        .into_iter()
        .filter(|p| in_text.contains(&p.name))
        .collect();
    assert!(promises.len() > 10);
    none(in_parallel(&promises, |promise| {
        ["check", "derive"]
            .iter()
            .flat_map(|command| broken(promise, command, &run(&[command, &model(promise)])))
            .collect()
    }));
}

#[test]
fn every_mistake_in_the_text_is_underlined_at_its_place() {
    let in_text = listed("## Mistakes in the text");
    none(in_parallel(&promises(), |promise| {
        if !in_text.contains(&promise.name) {
            return Vec::new();
        }
        let finished = run(&["check", &model(promise)]);
        match underlined(&finished.err, &promise.path) {
            Ok(0) => vec![format!("{}: no diagnostic\n{}", promise.name, finished.err)],
            Ok(_) => Vec::new(),
            Err(problem) => vec![format!("{}: {problem}\n{}", promise.name, finished.err)],
        }
    }));
}

/// Number of diagnostics, each of which shows its line as it is in the file with carets below the column named.
fn underlined(rendered: &str, path: &Path) -> Result<usize, String> {
    let source = std::fs::read_to_string(path).map_err(|e| e.to_string())?;
    let lines: Vec<&str> = source.lines().collect();
    let mut count = 0;
    for block in rendered
        .split("\nerror[")
        .map(|b| b.trim_start_matches("error["))
    {
        let Some((_, rest)) = block.split_once("--> ") else {
            return Err(format!("no place in `{block}`"));
        };
        let (place, rest) = rest.split_once('\n').ok_or("nothing below the place")?;
        let mut parts = place.trim().rsplitn(3, ':');
        let mut number = || {
            parts
                .next()
                .and_then(|p| p.parse::<usize>().ok())
                .ok_or("no number in the place")
        };
        let (column, line) = (number()?, number()?);
        if !parts
            .next()
            .is_some_and(|file| path.ends_with(file.rsplit('/').next().unwrap_or(file)))
        {
            return Err(format!("another file in `{place}`"));
        }
        let stated = lines.get(line.wrapping_sub(1)).ok_or("no such line")?;
        let mut shown = rest.lines().skip(1);
        let quoted = shown
            .next()
            .and_then(|l| l.split_once("| "))
            .ok_or("the line is not shown")?
            .1;
        let carets = shown
            .next()
            .and_then(|l| l.split_once("| "))
            .ok_or("nothing is underlined")?
            .1;
        if quoted != *stated {
            return Err(format!("line {line} is shown as `{quoted}`"));
        }
        if carets.chars().position(|c| c == '^') != Some(column - 1) {
            return Err(format!("the carets `{carets}` are not at column {column}"));
        }
        count += 1;
    }
    Ok(count)
}

#[test]
fn the_underlining_is_really_looked_at() {
    let path = places::root().join("gallery/wrong/unknown-name.toml");
    let rendered = run(&["check", "gallery/wrong/unknown-name.toml"]).err;
    assert_eq!(underlined(&rendered, &path), Ok(1));
    assert!(underlined(&rendered.replace("8:24", "8:23"), &path).is_err());
    assert!(underlined(&rendered.replace(":8:", ":9:"), &path).is_err());
    assert!(underlined(&rendered.replace("^^^^", "    "), &path).is_err());
}

#[test]
fn diagnostics_are_data_as_well() {
    let data = run(&["check", "gallery/wrong/several-errors.toml", "--json"]).json();
    let places: Vec<(u64, u64, String)> = data
        .as_array()
        .expect("a list")
        .iter()
        .map(|d| {
            (
                d["at"]["line"].as_u64().unwrap_or(0),
                d["at"]["column"].as_u64().unwrap_or(0),
                d["code"].to_string(),
            )
        })
        .collect();
    let expected = [
        (8, 24, "\"unknown-name\""),
        (9, 8, "\"unknown-name\""),
        (9, 25, "\"wrong-arity\""),
        (12, 19, "\"unknown-name\""),
        (15, 6, "\"not-constant\""),
    ];
    assert_eq!(
        places,
        expected.map(|(l, c, code)| (l, c, code.to_string()))
    );
}
