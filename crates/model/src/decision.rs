//! A claim with its verdict, held against what the model file expects of it.

use chetaev_symbolic::Verdict;
use std::sync::Arc;

/// What is found of a claim: a verdict, with whatever is shown beside it.
pub trait Found {
    /// The verdict.
    fn verdict(&self) -> &Verdict;
}

impl<F: Found> Found for Arc<F> {
    fn verdict(&self) -> &Verdict {
        F::verdict(self)
    }
}

/// A claim with its verdict.
#[derive(Clone, Debug)]
pub struct Decided<F> {
    /// Id without subject.
    pub claim: &'static str,
    /// Subject.
    pub subject: Option<String>,
    /// Title for people.
    pub title: &'static str,
    /// The word of its group.
    pub group: &'static str,
    /// Hypotheses.
    pub requires: Vec<String>,
    /// Verdict and formulas.
    pub finding: F,
    /// Seconds spent.
    pub seconds: f64,
    /// Verdicts that the model accepts, if it expects any.
    pub expected: Vec<String>,
}

impl<F> Decided<F> {
    /// `id#subject`.
    pub fn full_id(&self) -> String {
        full_id(self.claim, self.subject.as_deref())
    }
}

impl<F: Found> Decided<F> {
    /// Whether the model's expectation is met; true where it has none.
    pub fn is_as_expected(&self) -> bool {
        let word = self.finding.verdict().word();
        self.expected.is_empty() || self.expected.iter().any(|own| own == word)
    }
}

/// `id#subject`, or `id`.
pub fn full_id(id: &str, subject: Option<&str>) -> String {
    match subject {
        Some(subject) => format!("{id}#{subject}"),
        None => id.to_owned(),
    }
}
