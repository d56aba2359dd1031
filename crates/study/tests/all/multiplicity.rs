//! A system whose constraints hold with multiplicity has one verdict, and no motion.
#![allow(clippy::unwrap_used)] // a panic is how a test fails

use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_model::{load, Model, NoFiles};
use chetaev_study::stated_equations::stated_equations;
use chetaev_study::summary::{summary, Style};
use chetaev_study::{
    check, study, ClaimSelection, Hooks, Outcome, Study, StudyError, StudyOptions,
};

/// A ball in a tube of its own radius touches it along a circle.
const TUBE: &str = r#"
name = "ball in a tube"
coordinates = ["x", "y", "z"]
[lagrangian]
L = "1/2 (x'^2 + y'^2 + z'^2) - z"
[constraints]
ball = "x^2 + y^2 + z^2 = 1"
tube = "x^2 + y^2 = 1"
[initial]
x = 1
"y'" = 1
[simulation]
t_end = 1
"#;

fn model(text: &str) -> Model {
    load("model.toml", text, &NoFiles, &[])
        .into_result()
        .unwrap()
        .0
}

fn with_hooks<R>(run: impl FnOnce(&mut Hooks<'_>) -> R) -> R {
    run(&mut Hooks {
        clock: &|| 0.0,
        interrupt: None,
        progress: &mut |_, _| (),
    })
}

fn studied(claims: ClaimSelection) -> Result<Study, StudyError> {
    let options = StudyOptions {
        claims,
        ..StudyOptions::default()
    };
    with_hooks(|hooks| study(model(TUBE), options, hooks))
}

#[track_caller]
fn refused(outcome: Result<(), StudyError>) {
    let Err(StudyError::Characteristics(CharacteristicsError::Multiplicity { sentence })) = outcome
    else {
        panic!("{outcome:?}");
    };
    assert!(sentence.contains("z = 0"), "{sentence}");
}

/// The set is the circle x² + y² = 1, z = 0, of codimension two; both gradients are (2 x, 2 y, 0) on it.
#[test]
fn a_study_refutes_independence_and_says_nothing_else() {
    let study = studied(ClaimSelection::default()).unwrap();
    for decided in &study.verdicts {
        let expected = match decided.claim {
            "model.constraints-independent" => "refuted",
            _ => "not-applicable",
        };
        let verdict = &decided.finding.verdict;
        assert_eq!(verdict.word(), expected, "{}", decided.full_id());
        assert!(
            verdict.detail().contains("x^2 - 1 + y^2 = 0, z = 0"),
            "{verdict:?}"
        );
    }
    assert!(study.verdicts.len() > 20);
    assert!(study.motion.is_none());
    // A motion was asked for.
    assert_eq!(study.outcome, Outcome::Unmet);
    assert!(stated_equations(&study).is_empty());
    let text = summary(&study, Style::Plain);
    assert!(!text.contains("x''"), "{text}");
}

#[test]
fn what_asks_for_a_motion_is_refused() {
    refused(studied(ClaimSelection::of_motion()).map(|_| ()));
    refused(with_hooks(|hooks| check(&model(TUBE), hooks)));
}
