//! Forms of first integrals with unknown constants and functions: `{ value = "a x'^2 + h(x)", unknown = ["a", "h(x)"] }`.

use super::scope::{Context, Named, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Definition, IntegralForm, Unknown};
use crate::raw::{Kind, Raw};
use crate::text::Text;
use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::Expr;

impl Resolver {
    /// The form under a key; `None` where something is wrong with it, which is reported.
    pub(crate) fn integral_form(
        &mut self,
        key: &Text,
        text: &Text,
        unknown: &Raw,
        description: String,
    ) -> Option<IntegralForm> {
        let Kind::Array(items) = &unknown.kind else {
            self.wrong_kind(
                unknown,
                "`unknown`",
                "an array of names such as [\"a\", \"h(x)\"]",
            );
            return None;
        };
        let unknowns: Vec<Unknown> = items
            .iter()
            .map(|item| self.unknown(item))
            .collect::<Option<_>>()?;
        let functions = unknowns
            .iter()
            .filter(|unknown| !unknown.arguments.is_empty());
        let content = functions.fold(text.content.clone(), |content, unknown| {
            let arguments = unknown.arguments.iter().map(|&e| self.graph.text(e));
            let arguments: Vec<String> = arguments.collect();
            without_arguments(&content, &unknown.name, &arguments.join(","))
        });
        let short = text.with_content(content);
        // The unknowns are names in this expression alone.
        for unknown in &unknowns {
            let named = Named {
                kind: NamedKind::Parameter,
                place: key.place,
            };
            self.names.insert(unknown.name.clone(), named);
        }
        let parsed = self.parse(&short, parse_expression);
        let context = Context::state("the form of an integral");
        let value = self.lower(&short, &parsed, parsed.root(), &Vec::new(), context);
        for unknown in &unknowns {
            self.names.remove(&unknown.name);
        }
        let value = value.filter(|_| !parsed.has_errors())?;
        Some(IntegralForm {
            form: Definition {
                name: key.content.clone(),
                value,
                text: text.content.clone(),
                description,
                place: key.place,
            },
            unknowns,
        })
    }

    /// `a`, or `h(x, t)`.
    fn unknown(&mut self, item: &Raw) -> Option<Unknown> {
        let wanted = "a name such as \"a\", or a function such as \"h(x)\"";
        let Kind::Text(text) = &item.kind else {
            self.wrong_kind(item, "an unknown", wanted);
            return None;
        };
        let (name, arguments) = match text.content.split_once('(') {
            None => (text.content.trim(), ""),
            Some((name, rest)) => (name.trim(), rest.trim_end().strip_suffix(')')?),
        };
        let is_name = name.chars().all(|c| c.is_alphanumeric() || c == '_')
            && name.starts_with(char::is_alphabetic);
        if !is_name {
            self.wrong_kind(item, "an unknown", wanted);
            return None;
        }
        if self.names.contains_key(name) || name == "t" || name == "pi" {
            let message = format!("the unknown `{name}` has the name of something else");
            self.push(Diagnostic::error("name-taken", item.place, message));
            return None;
        }
        let arguments = arguments
            .split(',')
            .map(str::trim)
            .filter(|a| !a.is_empty());
        let arguments: Vec<&str> = arguments.collect();
        let arguments: Vec<Expr> = arguments
            .into_iter()
            .map(|argument| self.argument(item, argument))
            .collect::<Option<_>>()?;
        Some(Unknown {
            name: name.to_owned(),
            symbol: self.graph.symbol(name, 0),
            arguments,
        })
    }

    /// A coordinate, or the time.
    fn argument(&mut self, item: &Raw, name: &str) -> Option<Expr> {
        let named = self.names.get(name).map(|named| named.kind);
        if name == "t" || named == Some(NamedKind::Coordinate) {
            return Some(self.graph.symbol(name, 0));
        }
        let message = format!(
            "`{name}` is no coordinate and not the time: an unknown function depends on these"
        );
        self.push(Diagnostic::error("unknown-argument", item.place, message));
        None
    }
}

/// The text with blanks in the place of these arguments in parentheses after a name: `h(x)` stands for the unknown `h`. Other
/// arguments are left, and read as factors would be a mistake that the names in them show.
fn without_arguments(text: &str, name: &str, arguments: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    for (start, _) in text.match_indices(name) {
        let end = start + name.len();
        let before = text[..start].chars().next_back();
        if is_part(before) || is_part(text[end..].chars().next()) {
            continue;
        }
        let rest = text[end..].trim_start();
        let Some(close) = rest.find(')').filter(|_| rest.starts_with('(')) else {
            continue;
        };
        let own: String = rest[1..close].split_whitespace().collect();
        if own != arguments {
            continue;
        }
        let open = text.len() - rest.len();
        bytes[open..=open + close].fill(b' ');
    }
    // Blanks took the place of whole characters only.
    String::from_utf8(bytes).unwrap_or_else(|_| text.to_owned())
}
