//! Classical functionals: what they are stationary for, as the literature has it.

use crate::table::studied;

#[test]
fn classical_functionals_yield_their_equations() {
    for name in [
        "dirichlet",
        "minimal-surface",
        "beam",
        "plate",
        "large-deflection",
        "string",
        "membrane",
    ] {
        let study = studied(&format!("../fields/{name}"), &[]);
        let euler = study
            .verdicts
            .iter()
            .find(|d| d.claim == "functional.euler")
            .unwrap();
        assert_eq!(
            euler.finding.verdict.word(),
            "proved",
            "{name}: {}",
            euler.finding.verdict.detail()
        );
    }
}

#[test]
fn every_functional_of_the_gallery_is_as_its_file_expects() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../gallery/fields");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let study = studied(&format!("../fields/{name}"), &[]);
        let wrong: Vec<String> = study
            .verdicts
            .iter()
            .filter(|d| !d.is_as_expected())
            .map(|d| format!("{}: {}", d.full_id(), d.finding.verdict.detail()))
            .collect();
        assert!(
            wrong.is_empty() && study.is_as_expected(),
            "{name}: {wrong:?} {:?}",
            study.notices
        );
        count += 1;
    }
    assert!(count >= 14);
}
