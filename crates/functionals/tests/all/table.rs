//! The table of multi-level principles (T4 §3): every row has its claims proved.

use chetaev_functionals::{load, study, Loaded, Problem, Study};
use chetaev_model::{Files, Style};
use chetaev_symbolic::Verdict;
use std::path::PathBuf;

struct Disk;

impl Files for Disk {
    fn read(&self, path: &str) -> Result<String, String> {
        std::fs::read_to_string(path).map_err(|e| e.to_string())
    }
}

fn gallery() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../gallery/elasticity")
}

/// The text of a row's model.
pub(crate) fn row_text(row: &str) -> String {
    std::fs::read_to_string(gallery().join(row).join("model.toml")).unwrap()
}

/// A text read as if it were the model of a row.
pub(crate) fn read_text(row: &str, text: &str, set: &[(&str, &str)]) -> Loaded {
    let path = gallery().join(row).join("model.toml");
    load(&path.to_string_lossy(), text, &Disk, &owned(set))
}

fn owned(set: &[(&str, &str)]) -> Vec<(String, String)> {
    let pairs = set.iter();
    pairs.map(|(a, b)| (a.to_string(), b.to_string())).collect()
}

/// The same, which must have no errors.
pub(crate) fn loaded_text(row: &str, text: &str, set: &[(&str, &str)]) -> Problem {
    let loaded = read_text(row, text, set);
    match loaded.problem {
        Some(problem) => problem,
        None => panic!("{row}: {}", loaded.diagnostics.render(Style::Plain)),
    }
}

/// All claims about a text.
pub(crate) fn studied_text(row: &str, text: &str, set: &[(&str, &str)]) -> Study {
    let start = std::time::Instant::now();
    study(loaded_text(row, text, set), &|_| true, &|| {
        start.elapsed().as_secs_f64()
    })
}

/// All claims about a row.
pub(crate) fn studied(row: &str, set: &[(&str, &str)]) -> Study {
    studied_text(row, &row_text(row), set)
}

/// The files of the table with another energy in all of them.
struct WithEnergy(&'static str);

impl WithEnergy {
    fn of(&self, text: &str) -> String {
        text.replace("energy-abstract", self.0)
    }
}

impl Files for WithEnergy {
    fn read(&self, path: &str) -> Result<String, String> {
        Ok(self.of(&Disk.read(path)?))
    }
}

/// All claims about a row, where it and what it is compared with have this energy.
pub(crate) fn studied_with_energy(row: &str, energy: &'static str, set: &[(&str, &str)]) -> Study {
    let (path, files) = (gallery().join(row).join("model.toml"), WithEnergy(energy));
    let problem = load(
        &path.to_string_lossy(),
        &files.of(&row_text(row)),
        &files,
        &owned(set),
    )
    .problem;
    study(problem.unwrap(), &|_| true, &|| 0.0)
}

/// The verdict on a claim of a study.
pub(crate) fn decided<'s>(study: &'s Study, claim: &str) -> &'s Verdict {
    let found = study.verdicts.iter().find(|d| d.claim == claim);
    match found {
        Some(found) => &found.finding.verdict,
        None => panic!("nothing is said of {claim}"),
    }
}

/// The 26 rows.
pub(crate) const ROWS: &[&str] = &[
    "p4p", "p4c", "p4pb", "p4cb", "p3p", "p3c", "p3pb", "p3cb", "p3p1", "p3c1", "p3p0", "p3c0",
    "p2p", "p2c", "p2pb", "p2cb", "p2p0", "p2c0", "p2p1", "p2c1", "p1p", "p1c", "p0p", "p0c", "pp",
    "pc",
];

/// What a study of a row does not prove though it should.
pub(crate) fn unproved<'s>(row: &'s str, study: &'s Study) -> impl Iterator<Item = String> + 's {
    let wrong = study.verdicts.iter().filter(|decided| {
        let word = decided.finding.verdict.word();
        // Legendre's relation may be assumed, and most rows are principles of stationarity without Legendre's condition.
        let is_of_minima = ["functional.legendre", "functional.second-variation"];
        let is_assumed = is_of_minima.contains(&decided.claim) && word == "not-applicable";
        let is_stated = !decided.expected.is_empty() && decided.is_as_expected();
        word != "proved" && !is_assumed && !is_stated
    });
    wrong.map(move |decided| {
        let verdict = &decided.finding.verdict;
        let (id, word) = (decided.full_id(), verdict.word());
        format!("{row}: {id} is {word}: {}", verdict.detail())
    })
}

fn problems(set: &[(&str, &str)]) -> Vec<String> {
    let rows = ROWS.iter();
    rows.flat_map(|row| unproved(row, &studied(row, set)).collect::<Vec<_>>())
        .collect()
}

#[test]
fn every_row_is_proved_in_one_dimension() {
    let found = problems(&[("d", "1")]);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn every_row_is_proved_in_two_dimensions() {
    let found = problems(&[("d", "2")]);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn every_row_is_proved_in_three_dimensions() {
    let found = problems(&[("d", "3")]);
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn every_row_is_proved_for_small_displacements() {
    let found = problems(&[("d", "2"), ("nonlinear", "0")]);
    assert!(found.is_empty(), "{}", found.join("\n"));
}
