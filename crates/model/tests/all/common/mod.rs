//! What the tests of the model file share.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_model::{load, Model, NoFiles};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Verdict};

/// The model of a text without any problem.
#[track_caller]
pub(crate) fn model(text: &str) -> Model {
    let (model, diagnostics) = load("model.toml", text, &NoFiles, &[])
        .into_result()
        .unwrap_or_else(|problems| panic!("{problems}"));
    assert!(diagnostics.list.is_empty(), "{diagnostics}");
    model
}

/// The text is refused with so many errors, and the message contains each of the words.
#[track_caller]
pub(crate) fn refused(text: &str, errors: usize, words: &[&str]) {
    let loaded = load("model.toml", text, &NoFiles, &[]);
    let message = loaded.diagnostics.to_string();
    assert!(loaded.model.is_none(), "accepted: {text}");
    assert_eq!(loaded.diagnostics.list.len(), errors, "{message}");
    for word in words {
        assert!(message.contains(word), "`{word}` is missing in\n{message}");
    }
}

/// The value is zero everywhere.
#[track_caller]
pub(crate) fn vanishes(model: &Model, value: Expr) {
    let g = &model.graph;
    let verdict = decide_zero(g, &ZeroTest::everywhere(&[value], &Assumptions::new()));
    let text = g.text(value);
    assert!(matches!(verdict, Verdict::Proved(_)), "{text}: {verdict:?}");
}

/// The value is the function that is written.
#[track_caller]
pub(crate) fn same(model: &Model, value: Expr, written: &str) {
    let written = model.expression(written).unwrap();
    vanishes(model, model.graph.sub(value, written));
}
