//! Classical functionals: what they are stationary for, as the literature has it.

use crate::table::studied;

#[test]
fn classical_functionals_yield_their_equations() {
    for name in [
        "dirichlet",
        "minimal-surface",
        "beam",
        "plate",
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
