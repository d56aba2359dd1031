//! The book says what the program says: pages and cards, sources, command lines with their output, names of tests, links.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev::mechanics::FORMULATIONS;
use chetaev::study::registry;
use chetaev_tests::places::root;
use chetaev_tests::program::run;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn book() -> PathBuf {
    root().join("docs/book")
}

/// Files below a folder with this ending, in order.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        let entries = std::fs::read_dir(&folder).expect("a folder of the repository");
        for path in entries.filter_map(Result::ok).map(|entry| entry.path()) {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn pages() -> Vec<(PathBuf, String)> {
    let of_book = files(&book(), "md").into_iter();
    of_book.map(|path| (path.clone(), read(&path))).collect()
}

fn page(name: &str) -> String {
    read(&book().join(format!("formulations/{name}.md")))
}

/// The text below a heading of the second level.
fn section<'a>(page: &'a str, heading: &str) -> Option<&'a str> {
    let below = page.split_once(&format!("\n## {heading}\n"))?.1;
    Some(below.split("\n## ").next().unwrap_or(below))
}

/// What stands between `open` and `close`, every time.
fn between<'a>(text: &'a str, open: &str, close: &str) -> Vec<&'a str> {
    let parts = text.split(open).skip(1);
    parts
        .filter_map(|part| Some(part.split_once(close)?.0))
        .collect()
}

#[test]
fn every_formulation_has_its_page() {
    let folder = files(&book().join("formulations"), "md");
    let pages: BTreeSet<&str> = folder
        .iter()
        .filter_map(|path| path.file_stem()?.to_str())
        .collect();
    let names: BTreeSet<&str> = FORMULATIONS.iter().map(|f| f.card().name).collect();
    assert_eq!(pages, names);
    for index in ["SUMMARY.md", "formulations.md"] {
        let text = read(&book().join(index));
        for name in &names {
            let link = format!("(formulations/{name}.md)");
            assert!(text.contains(&link), "{index} does not link {name}");
        }
    }
}

#[test]
fn pages_require_what_the_cards_require() {
    let registry = registry();
    for formulation in FORMULATIONS {
        let card = formulation.card();
        let page = page(card.name);
        let required = section(&page, "Requires").expect("a section on requirements");
        let named: BTreeSet<&str> = required
            .lines()
            .filter_map(|line| line.strip_prefix("- `")?.split('`').next())
            .collect();
        let expected: BTreeSet<&str> = card.requires.iter().copied().collect();
        assert_eq!(named, expected, "{}", card.name);
        assert!(named.iter().all(|id| registry.find(id).is_some()));
        let identity = section(&page, "Identity");
        assert_eq!(identity.is_some(), card.identity.is_some(), "{}", card.name);
        let claim = format!("`formulation.identity#{}`", card.name);
        assert!(identity.is_none_or(|text| text.contains(&claim)), "{claim}");
    }
}

/// Keys of the bibliography, with the other names of an entry.
fn bibliography() -> BTreeSet<String> {
    let text = read(&root().join("docs/references.bib"));
    let entries = text.lines().filter_map(|line| {
        let (_, key) = line.strip_prefix('@')?.split_once('{')?;
        Some(key.trim_end_matches(',').to_owned())
    });
    let others = text.lines().filter_map(|line| {
        let (field, names) = line.split_once('=')?;
        (field.trim() == "ids").then(|| names.trim().trim_matches(['{', '}', ',']).to_owned())
    });
    entries.chain(others).collect()
}

#[test]
fn every_source_is_in_the_bibliography() {
    let known = bibliography();
    for (path, text) in pages() {
        for key in between(&text, "[@", "]") {
            assert!(known.contains(key), "{}: {key}", path.display());
        }
    }
    for formulation in FORMULATIONS {
        let card = formulation.card();
        let page = page(card.name);
        let sources = section(&page, "Sources").expect("a section on sources");
        let named: BTreeSet<&str> = between(sources, "[@", "]").into_iter().collect();
        let expected: BTreeSet<&str> = card.sources.iter().map(|s| s.key).collect();
        assert_eq!(named, expected, "{}", card.name);
    }
}

/// Command lines of a page with the lines of output that follow them: after `$ ` in a fence, or indented by themselves.
fn commands(page: &str) -> Vec<(String, Vec<String>)> {
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    let mut is_fence = false;
    for line in page.lines() {
        if line.starts_with("```") {
            is_fence = line.starts_with("```console");
        } else if let Some(command) = line.strip_prefix("$ chetaev ") {
            found.push((command.into(), Vec::new()));
        } else if let Some(command) = line.strip_prefix("    chetaev ") {
            found.push((command.into(), Vec::new()));
        } else if let (true, Some((_, output))) = (is_fence, found.last_mut()) {
            output.push(line.into());
        }
    }
    found
}

/// Derivations and explanations of small systems; nothing that integrates, no system of a chosen size, and no model that a chapter
/// states, of which a test of the chapter runs the commands.
fn is_cheap(command: &str) -> bool {
    (command.starts_with("derive ") || command.starts_with("explain "))
        && !command.contains("--set")
        && !command.contains(" model.toml")
}

#[test]
fn command_lines_print_what_the_book_shows() {
    let mut printed: BTreeMap<String, String> = BTreeMap::new();
    for (path, text) in pages() {
        for (command, output) in commands(&text) {
            if !is_cheap(&command) {
                assert!(output.is_empty(), "{command}: output that is not tested");
                continue;
            }
            let out = printed.entry(command.clone()).or_insert_with(|| {
                let finished = run(&command.split_whitespace().collect::<Vec<_>>());
                assert_eq!(finished.status, Some(0), "{command}: {}", finished.both());
                finished.out
            });
            let mut rest = out.lines();
            for line in output.iter().filter(|line| *line != "…") {
                let place = path.display();
                assert!(
                    rest.any(|l| l.trim_end() == line.trim_end()),
                    "{place}: `{line}` is not printed there by\n{command}\n{out}"
                );
            }
        }
    }
    assert!(printed.len() > FORMULATIONS.len());
}

#[test]
fn tests_of_the_corrections_exist() {
    let page = read(&book().join("corrections.md"));
    let sources: Vec<String> = ["crates", "tests"]
        .iter()
        .flat_map(|folder| files(&root().join(folder), "rs"))
        .map(|path| read(&path))
        .collect();
    let corrections = page.split("\n### ").skip(1);
    let mut count = 0;
    for correction in corrections {
        let tests: Vec<&str> = correction
            .lines()
            .filter(|line| line.starts_with("- Test: "))
            .flat_map(|line| line.split('`').skip(1).step_by(2))
            .filter(|name| name.contains('_'))
            .collect();
        assert!(!tests.is_empty(), "no test of {correction}");
        for name in tests {
            let function = format!("#[test]\nfn {name}()");
            let exists = sources.iter().any(|text| text.contains(&function));
            assert!(exists, "no test {name}");
            count += 1;
        }
    }
    assert!(count >= 15, "{count}");
}

/// Anchors of the headings of a page.
fn anchors(page: &str) -> BTreeSet<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| line.trim_start_matches('#').trim().to_lowercase())
        .map(|title| {
            let kept = title
                .chars()
                .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

#[test]
fn links_resolve() {
    for (path, text) in pages() {
        for target in between(&text, "](", ")") {
            if target.starts_with("http") {
                continue;
            }
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let folder = path.parent().expect("a page is in a folder");
            let linked = if file.is_empty() {
                path.clone()
            } else {
                folder.join(file)
            };
            assert!(linked.is_file(), "{}: {target}", path.display());
            let has_anchor = anchor.is_empty() || anchors(&read(&linked)).contains(anchor);
            assert!(has_anchor, "{}: {target}", path.display());
        }
    }
}

/// Fenced blocks of a page with their language.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let parts: Vec<&str> = page.split("```").collect();
    let fenced = parts.iter().skip(1).step_by(2);
    fenced.filter_map(|part| part.split_once('\n')).collect()
}

/// The lines of a whole model with a line in the place of the one that has the same key.
fn replaced(model: &str, line: &str) -> String {
    let key = |line: &str| line.split_once(" = ").map(|(key, _)| key.to_owned());
    assert!(model.lines().any(|own| key(own) == key(line)), "{line}");
    let own = model
        .lines()
        .map(|own| if key(own) == key(line) { line } else { own });
    own.collect::<Vec<_>>().join("\n")
}

/// What stands on a page: whole models, fragments, and how many outputs of commands were compared.
#[derive(Default)]
struct Told {
    whole: Vec<String>,
    fragments: Vec<String>,
    outputs: usize,
}

/// Runs the commands of a page: every whole model, which begins with `first`, is written to `model.toml`, every single line is put into the model before it, in
/// the place of the one that has the same key, and what is printed stands beside it, line for line.
fn told(page: &str, first: &str, folder: &Path) -> Told {
    let model = folder.join("model.toml");
    let (mut told, mut last) = (Told::default(), None);
    for (language, text) in blocks(page) {
        match language {
            "toml" if text.starts_with(first) => {
                told.whole.push(text.to_owned());
                last = Some(text.to_owned());
            }
            "toml" if text.lines().count() == 1 => {
                let before = told.whole.last().expect("a model before it");
                last = Some(replaced(before, text.trim_end()));
            }
            "text" => {
                let text = text.strip_prefix("$ chetaev ").expect("a command");
                let (command, output) = text.split_once('\n').expect("its output");
                let own = last.as_ref().expect("a model before it");
                std::fs::write(&model, own).expect("a scratch file");
                let finished = chetaev_tests::program::run_in(
                    folder,
                    &command.split_whitespace().collect::<Vec<_>>(),
                );
                let all = finished.both();
                let mut printed = all.lines();
                for line in output.lines().filter(|line| *line != "…") {
                    assert!(
                        printed.any(|own| is_as_shown(own, line)),
                        "`{line}` is not printed there by {command}\n{all}"
                    );
                }
                told.outputs += 1;
            }
            "toml" => told.fragments.push(text.to_owned()),
            _ => {}
        }
    }
    told
}

/// Whether a line is the one shown, or begins with it where it is a verdict with its reasons or the rest is left out.
fn is_as_shown(line: &str, shown: &str) -> bool {
    let (line, shown) = (line.trim_end(), shown.trim_end());
    let begins = shown
        .strip_suffix(" …")
        .or(shown.ends_with(" proved").then_some(shown));
    line == shown || begins.is_some_and(|own| line.starts_with(own))
}

/// A picture of the book is the one that the program draws of the last model.
fn assert_drawn(folder: &Path, options: [&str; 4], stored: &Path) {
    let command = [&["plot", "model.toml", "--out", "own.svg"], &options[..]].concat();
    let drawn = chetaev_tests::program::run_in(folder, &command);
    assert_eq!(drawn.status, Some(0), "{}", drawn.both());
    let own = read(&folder.join("own.svg"));
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(stored, &own).expect("the picture of the book");
    }
    assert_eq!(own, read(stored), "UPDATE=1 draws the picture again");
}

/// The chapter of the first hour, with its picture.
#[test]
fn the_first_hour_goes_as_it_stands_there() {
    let page = read(&book().join("first-hour.md"));
    let folder = chetaev_tests::places::scratch("book-first-hour");
    let told = told(&page, "name = ", &folder);
    assert_eq!((told.whole.len(), told.outputs), (1, 7));
    let stored = book().join("first-hour/skate.svg");
    assert_drawn(&folder, ["--ghosts", "9", "--width", "640"], &stored);
}

/// The chapters that go through a task from its beginning to its end.
#[test]
fn tasks_of_the_book_are_solved_as_it_stands_there() {
    for (name, outputs) in [
        ("lecture", 3),
        ("robot", 2),
        ("conjecture", 4),
        ("paper", 2),
    ] {
        let page = read(&book().join(format!("tasks/{name}.md")));
        let folder = chetaev_tests::places::scratch(&format!("book-{name}"));
        let told = told(&page, "name = ", &folder);
        assert_eq!((told.whole.len(), told.outputs), (1, outputs), "{name}");
    }
}

/// The chapter for beginners: its models, what is printed of them, and its picture.
#[test]
fn the_wheel_of_the_book_has_the_equations_that_stand_beside_it() {
    let page = read(&book().join("from-a-wheel-to-its-equations.md"));
    let folder = chetaev_tests::places::scratch("book-wheel");
    let told = told(&page, "name = ", &folder);
    assert_eq!((told.whole.len(), told.outputs), (2, 5));
    let stored = book().join("from-a-wheel/leaning.svg");
    assert_drawn(&folder, ["--ghosts", "5", "--width", "640"], &stored);
}

/// The chapter on functionals.
#[test]
fn functionals_of_the_book_give_what_stands_beside_them() {
    let page = read(&book().join("functionals.md"));
    let folder = chetaev_tests::places::scratch("book-functionals");
    let told = told(&page, "kind = ", &folder);
    assert_eq!((told.whole.len(), told.outputs), (2, 7));
    // Fragments are those of models of the gallery.
    let gallery: Vec<String> = ["bar", "loaded-membrane"]
        .iter()
        .map(|name| read(&root().join(format!("gallery/fields/{name}/model.toml"))))
        .collect();
    for line in told.fragments.iter().flat_map(|text| text.lines()) {
        let line = line
            .trim_start_matches("fields = { ")
            .trim_end_matches(" }");
        let is_there = gallery.iter().any(|own| own.contains(line));
        assert!(is_there, "{line} is in no model of the gallery");
    }
}
