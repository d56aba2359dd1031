//! Problems of a model, each at its place in one of the texts.

use std::collections::HashSet;
use std::fmt;

use chetaev_symbolic::syntax::{self, Severity};

use crate::render::{self, Style};
use crate::source::{Place, Sources};
use crate::text::Text;

/// One problem. The message is lower case and without a final period.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// A stable identifier such as `unknown-name`.
    pub code: &'static str,
    /// The offending text.
    pub place: Place,
    /// What is wrong, in one line.
    pub message: String,
    /// What is written under the offending text; may be empty.
    pub label: String,
    /// Other places that matter, with what to say about them.
    pub related: Vec<(Place, String)>,
    /// Advice, one sentence each.
    pub hints: Vec<String>,
    /// A replacement that would solve the problem.
    pub suggestion: Option<Suggestion>,
}

/// A replacement of a piece of text that would solve a problem.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Suggestion {
    /// The text to replace.
    pub place: Place,
    /// What to write there.
    pub replacement: String,
}

impl Diagnostic {
    /// An error with nothing but its message.
    pub fn error(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Error, code, place, message)
    }

    /// A warning with nothing but its message.
    pub fn warning(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, code, place, message)
    }

    /// A diagnostic with nothing but its message.
    pub fn new(
        severity: Severity,
        code: &'static str,
        place: Place,
        message: impl Into<String>,
    ) -> Self {
        Diagnostic {
            severity,
            code,
            place,
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
    pub fn related(mut self, place: Place, label: impl Into<String>) -> Self {
        self.related.push((place, label.into()));
        self
    }

    /// Sets the replacement that would solve the problem.
    #[must_use]
    pub fn suggest(mut self, place: Place, replacement: impl Into<String>) -> Self {
        self.suggestion = Some(Suggestion {
            place,
            replacement: replacement.into(),
        });
        self
    }

    /// The diagnostic of an expression, placed in the file that the expression stands in.
    pub fn of_expression(diagnostic: &syntax::Diagnostic, text: &Text) -> Self {
        Diagnostic {
            severity: diagnostic.severity,
            code: diagnostic.code,
            place: text.place_of(diagnostic.span),
            message: diagnostic.message.clone(),
            label: diagnostic.label.clone(),
            related: diagnostic
                .related
                .iter()
                .map(|(span, words)| (text.place_of(*span), words.clone()))
                .collect(),
            hints: diagnostic.hints.clone(),
            suggestion: diagnostic.suggestion.as_ref().map(|suggestion| Suggestion {
                place: text.place_of(suggestion.span),
                replacement: suggestion.replacement.clone(),
            }),
        }
    }
}

/// Which problems were found already.
#[derive(Clone, Debug, Default)]
pub(crate) struct Known(HashSet<Diagnostic>);

impl Known {
    /// Whether a problem was not found before; it is from then on.
    pub(crate) fn is_new(&mut self, diagnostic: &Diagnostic) -> bool {
        !self.0.contains(diagnostic) && self.0.insert(diagnostic.clone())
    }
}

/// All problems of a model with the texts they are about. As an error it shows every problem.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The texts.
    pub sources: Sources,
    /// The problems, in the order of their places.
    pub list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Whether the model cannot be used.
    pub fn has_errors(&self) -> bool {
        self.list
            .iter()
            .any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// Adds a problem unless the same one is there.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        if !self.list.contains(&diagnostic) {
            self.list.push(diagnostic);
        }
    }

    /// The problems without those that are there twice.
    pub(crate) fn once(sources: Sources, all: Vec<Diagnostic>) -> Diagnostics {
        let mut known = Known::default();
        let mut list = Vec::with_capacity(all.len());
        for diagnostic in all {
            if known.is_new(&diagnostic) {
                list.push(diagnostic);
            }
        }
        Diagnostics { sources, list }
    }

    /// Sorts by place, errors before warnings at one place.
    pub fn sort(&mut self) {
        self.list.sort_by(|a, b| {
            a.place
                .cmp(&b.place)
                .then(b.severity.cmp(&a.severity))
                .then(a.code.cmp(b.code))
        });
    }

    /// The text shown to a person: every problem with its line underlined.
    pub fn render(&self, style: Style) -> String {
        render::all(self, style)
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(Style::Plain))
    }
}

impl std::error::Error for Diagnostics {}
