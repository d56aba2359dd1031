//! Every citation of a note resolves.
#![allow(clippy::expect_used, reason = "test code fails where it stands")]

use chetaev_tests::citations::{citations, has, notes, unresolved, written, Place};
use chetaev_tests::places::root;

#[test]
fn citations_of_the_theory_resolve() {
    assert_eq!(notes(&root()).expect("the theory").len(), 7);
    let (count, failures) = unresolved(&root()).expect("files that can be read");
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
    let notes = notes(&root()).expect("the theory");
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
    for path in written(&root()).expect("folders that can be read") {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let of_notes = path.starts_with(root().join("docs/theory"));
        for phrase in forbidden
            .iter()
            .filter(|phrase| !of_notes && text.contains(phrase.as_str()))
        {
            failures.push(format!("{}: {phrase}", path.display()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
