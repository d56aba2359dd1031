//! What is wrong with a text: where, what, and what to do about it.

use super::span::Span;

/// How bad it is.
#[derive(Copy, Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// Something worth knowing; nothing is wrong.
    Note,
    /// Read in one way although the writer may have meant another.
    Warning,
    /// The text has no meaning here.
    Error,
}

impl Severity {
    /// The word shown to a person: `error`, `warning` or `note`.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        }
    }
}

/// A replacement of a piece of text that would solve the problem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suggestion {
    /// The text to replace; an empty span inserts.
    pub span: Span,
    /// What to write there.
    pub replacement: String,
}

/// One problem in one text.
///
/// The message is lower case and without a final period; the spans are bytes of the text that was parsed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// A stable identifier such as `unknown-name`.
    pub code: &'static str,
    /// The offending text.
    pub span: Span,
    /// What is wrong, in one line.
    pub message: String,
    /// What is written under the offending text; may be empty.
    pub label: String,
    /// Other places that matter, with what to say about them.
    pub related: Vec<(Span, String)>,
    /// Advice, one sentence each.
    pub hints: Vec<String>,
    /// A replacement that would solve the problem.
    pub suggestion: Option<Suggestion>,
}

impl Diagnostic {
    /// An error with nothing but its message.
    pub fn error(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, span, message)
    }

    /// A warning with nothing but its message.
    pub fn warning(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, span, message)
    }

    /// A diagnostic with nothing but its message.
    pub fn new(
        severity: Severity,
        code: &'static str,
        span: Span,
        message: impl Into<String>,
    ) -> Self {
        Diagnostic {
            severity,
            code,
            span,
            message: message.into(),
            label: String::new(),
            related: Vec::new(),
            hints: Vec::new(),
            suggestion: None,
        }
    }

    /// Sets the words under the offending text.
    #[must_use]
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a sentence of advice.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    /// Adds another place that matters.
    #[must_use]
    pub fn related(mut self, span: Span, label: impl Into<String>) -> Self {
        self.related.push((span, label.into()));
        self
    }

    /// Sets the replacement that would solve the problem.
    #[must_use]
    pub fn suggest(mut self, span: Span, replacement: impl Into<String>) -> Self {
        self.suggestion = Some(Suggestion {
            span,
            replacement: replacement.into(),
        });
        self
    }

    /// Whether this makes the text meaningless.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}
