//! Small readers that several sections share.

use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw, Table};

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::names;
use chetaev_symbolic::Expr;

impl Resolver {
    /// A word out of a list; another one is reported with the nearest.
    pub(crate) fn word_of(
        &mut self,
        table: &Table,
        key: &str,
        words: &[&'static str],
    ) -> Option<&'static str> {
        let text = self.optional_text(table, key)?;
        let found = words.iter().copied().find(|word| *word == text.content);
        if found.is_none() {
            let message = format!("`{}` is no value of `{key}`", text.content);
            let mut diagnostic = Diagnostic::error("unknown-value", text.place, message);
            diagnostic = match names::closest(&text.content, words.iter().copied()) {
                Some(near) => diagnostic
                    .hint(format!("did you mean \"{near}\"?"))
                    .suggest(text.place, format!("\"{near}\"")),
                None => diagnostic.hint(format!("one of {}", words.join(", "))),
            };
            self.push(diagnostic);
        }
        found
    }

    /// A vector of expressions of a given length.
    pub(crate) fn vector(
        &mut self,
        raw: &Raw,
        length: usize,
        what: &'static str,
        bindings: &Bindings,
        context: Context,
    ) -> Option<Vec<Expr>> {
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(raw, what, &format!("an array of {length} expressions"));
            return None;
        };
        if items.len() != length {
            let message = format!("{what} has {length} components here, not {}", items.len());
            self.push(Diagnostic::error("wrong-length", raw.place, message));
            return None;
        }
        let mut components = Vec::with_capacity(length);
        for item in items {
            let text = self.expression_text(item, "a component")?;
            components.push(self.expression(&text, bindings, context, Expected::Anything));
        }
        components.into_iter().collect()
    }
}
