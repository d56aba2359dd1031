//! Citations of the theory, which is in notes: `T3 §8.5` is a heading of note 3, `T1 (42)` an equation of note 1, `T2 E1` a name there.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What is cited of a note.
#[derive(Debug, PartialEq)]
pub enum Place {
    /// A section by its number, `4.3`.
    Section(String),
    /// An equation by its number, `15b`.
    Equation(String),
    /// A system, an example or a capability by its name, `S4`.
    Name(String),
}

/// The notes of a repository by their numbers.
///
/// # Errors
/// The theory is not there.
pub fn notes(root: &Path) -> std::io::Result<BTreeMap<char, String>> {
    let folder = std::fs::read_dir(root.join("docs/theory"))?;
    let numbered = folder.filter_map(Result::ok).filter_map(|entry| {
        let number = entry.file_name().to_str()?.chars().next()?;
        let text = std::fs::read_to_string(entry.path()).ok()?;
        number.is_ascii_digit().then_some((number, text))
    });
    Ok(numbered.collect())
}

/// Folders of a repository in which theory is cited.
const FOLDERS: [&str; 6] = ["crates", "tests", "gallery", "docs", "xtask", "bench"];

/// All files of a repository that a person writes and that may cite theory, in order.
///
/// # Errors
/// A folder cannot be read.
pub fn written(root: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut open: Vec<PathBuf> = FOLDERS.iter().map(|name| root.join(name)).collect();
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder)? {
            let path = entry?.path();
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
    Ok(found)
}

/// How many citations the files of a repository have, and those that resolve to nothing, with the file.
///
/// # Errors
/// A file cannot be read.
pub fn unresolved(root: &Path) -> std::io::Result<(usize, Vec<String>)> {
    let notes = notes(root)?;
    let (mut count, mut failures) = (0, Vec::new());
    for path in written(root)? {
        let text = std::fs::read_to_string(&path)?;
        for (note, place) in citations(&text) {
            count += 1;
            if !notes.get(&note).is_some_and(|text| has(text, &place)) {
                failures.push(format!("{}: T{note} {place:?}", path.display()));
            }
        }
    }
    Ok((count, failures))
}

/// The citations `T1 §4.3, §5`, `T1 (7), (10)`, `T2 E1 and E5` of a text, each place by itself.
pub fn citations(text: &str) -> Vec<(char, Place)> {
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
pub fn has(note: &str, place: &Place) -> bool {
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
