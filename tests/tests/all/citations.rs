//! Every citation of a note resolves: `T3 §8.5` is a heading of note 3, `T1 (42)` an equation of note 1, `T2 E1` a name there.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::places::root;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What is cited of a note.
#[derive(Debug, PartialEq)]
enum Place {
    /// A section by its number, `4.3`.
    Section(String),
    /// An equation by its number, `15b`.
    Equation(String),
    /// A system, an example or a capability by its name, `S4`.
    Name(String),
}

/// The notes by their numbers.
fn notes() -> BTreeMap<char, String> {
    let folder =
        std::fs::read_dir(root().join("docs/theory")).expect("the theory is in the repository");
    let numbered = folder.filter_map(Result::ok).filter_map(|entry| {
        let number = entry.file_name().to_str()?.chars().next()?;
        let text = std::fs::read_to_string(entry.path()).ok()?;
        number.is_ascii_digit().then_some((number, text))
    });
    numbered.collect()
}

/// Files below a folder that a person writes.
fn written(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for path in std::fs::read_dir(&folder)
            .expect("a folder")
            .filter_map(Result::ok)
            .map(|e| e.path())
        {
            let ending = path
                .extension()
                .and_then(|e| e.to_str())
                .unwrap_or_default();
            if path.is_dir() {
                open.push(path);
            } else if ["rs", "md", "toml", "py"].contains(&ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The citations `T1 §4.3, §5`, `T1 (7), (10)`, `T2 E1 and E5` of a text, each place by itself.
fn citations(text: &str) -> Vec<(char, Place)> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices('T') {
        let is_word_before = text[..at]
            .chars()
            .next_back()
            .is_some_and(|c| c.is_alphanumeric() || c == '_');
        let mut rest = text[at + 1..].chars();
        let Some(note) = rest.next().filter(|c| ('0'..='6').contains(c)) else {
            continue;
        };
        let rest = rest.as_str();
        if !is_word_before && (rest.starts_with(' ') || rest.starts_with(", §")) {
            found.extend(places(rest).into_iter().map(|place| (note, place)));
        }
    }
    found
}

/// The places that follow the name of a note, as far as they go.
fn places(mut rest: &str) -> Vec<Place> {
    let mut found = Vec::new();
    loop {
        let joined = [", and ", ", ", " and ", "–", "–§", " "]
            .into_iter()
            .filter_map(|joint| rest.strip_prefix(joint));
        let Some((place, after)) = joined.filter_map(one_place).next() else {
            return found;
        };
        found.push(place);
        rest = after;
    }
}

/// A place at the start of a text, with the text behind it.
fn one_place(text: &str) -> Option<(Place, &str)> {
    if let Some(after) = text.strip_prefix('(') {
        let (number, after) = after.split_once(')')?;
        let is_number = number.len() <= 4 && number.starts_with(|c: char| c.is_ascii_digit());
        return is_number.then(|| (Place::Equation(number.into()), after));
    }
    if text.starts_with('§') {
        let after = text.trim_start_matches('§');
        let end = after
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(after.len());
        let number = after[..end].trim_end_matches('.');
        return (!number.is_empty())
            .then(|| (Place::Section(number.into()), &after[number.len()..]));
    }
    let end = text
        .find(|c: char| !c.is_ascii_alphanumeric())
        .unwrap_or(text.len());
    let name = &text[..end];
    let digits = name.strip_prefix(['S', 'E', 'C'])?;
    let is_name = digits.starts_with(|c: char| c.is_ascii_digit()) && digits.len() <= 3;
    is_name.then(|| (Place::Name(name.into()), &text[end..]))
}

/// Whether a note has a place.
fn has(note: &str, place: &Place) -> bool {
    match place {
        Place::Section(number) => note.lines().any(|line| {
            let title = line.trim_start_matches(['#', '*', '-']).trim_start();
            let after = title.strip_prefix(number.as_str());
            line.starts_with(['#', '*']) && after.is_some_and(|rest| rest.starts_with([' ', '.']))
        }),
        Place::Equation(number) => {
            note.contains(&format!("({number})")) || note.contains(&format!("({number},"))
        }
        Place::Name(name) => note
            .split(|c: char| !c.is_ascii_alphanumeric())
            .any(|word| word == name),
    }
}

#[test]
fn citations_of_the_theory_resolve() {
    let notes = notes();
    assert_eq!(notes.len(), 7);
    let mut failures = Vec::new();
    let mut count = 0;
    for folder in ["crates", "tests", "gallery", "docs", "xtask", "bench"] {
        for path in written(&root().join(folder)) {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            for (note, place) in citations(&text) {
                count += 1;
                if !has(&notes[&note], &place) {
                    failures.push(format!("{}: T{note} {place:?}", path.display()));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(count > 300, "only {count} citations were recognised");
}

#[test]
fn citations_are_recognised_and_a_wrong_one_is_seen() {
    let found =
        citations("as T3 §8.5, §6 and T1 (7), (10); T2 E1, with T1 of another kind, XT1 (3)");
    let expected = [
        ('3', Place::Section("8.5".into())),
        ('3', Place::Section("6".into())),
        ('1', Place::Equation("7".into())),
        ('1', Place::Equation("10".into())),
        ('2', Place::Name("E1".into())),
    ];
    assert_eq!(found, expected);
    let notes = notes();
    assert!(!has(&notes[&'1'], &Place::Section("77.1".into())));
    assert!(!has(&notes[&'1'], &Place::Equation("999".into())));
    assert!(!has(&notes[&'1'], &Place::Name("S9".into())));
}

/// Where a note is meant it is cited by its name, so that the test above sees it.
#[test]
fn nothing_is_cited_that_is_not_here() {
    let forbidden = [
        ["theory", " note"].concat(),
        ["theory", " 5."].concat(),
        ["theory", " 6."].concat(),
    ];
    let mut failures = Vec::new();
    for folder in ["crates", "tests", "gallery", "docs", "xtask", "bench"] {
        for path in written(&root().join(folder)) {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let of_notes = path.starts_with(root().join("docs/theory"));
            for phrase in forbidden
                .iter()
                .filter(|phrase| !of_notes && text.contains(phrase.as_str()))
            {
                failures.push(format!("{}: {phrase}", path.display()));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
