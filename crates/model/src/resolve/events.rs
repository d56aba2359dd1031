//! Events along a motion: `[events.NAME]` with `when`, a function whose zeros are meant, `direction` and `action`.

use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::Expr;

use super::formula::Expected;
use super::scope::{Context, MULTIPLIER};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Constraint, EventStated, Zero};
use crate::raw::{Kind, Table};
use crate::text::Text;

impl Resolver {
    /// Every event that is stated, in the order of the file.
    pub(crate) fn events(&mut self, root: &Table, constraints: &[Constraint]) -> Vec<EventStated> {
        let mut events: Vec<EventStated> = Vec::new();
        let Some(table) = self.section(root, "events") else {
            return events;
        };
        for (key, raw) in &table.entries {
            let Kind::Table(stated) = &raw.kind else {
                let wanted = "a table with `when = \"…\"`";
                self.wrong_kind(raw, &format!("`events.{}`", key.content), wanted);
                continue;
            };
            const KEYS: &[&str] = &["when", "direction", "action", "description"];
            self.known_keys(stated, KEYS, "of an event");
            let zero = match self.word_of(stated, "direction", &["rising", "falling", "both"]) {
                Some("rising") => Zero::Rising,
                Some("falling") => Zero::Falling,
                _ => Zero::Both,
            };
            let stops = self.word_of(stated, "action", &["stop", "record"]) == Some("stop");
            let description = self.prose(stated, "description");
            let Some(when) = stated.get("when") else {
                let message = format!(
                    "the event `{}` needs `when`, an expression that is zero there",
                    key.content
                );
                self.push(Diagnostic::error("missing-value", key.place, message));
                continue;
            };
            let Some(text) = self.expression_text(when, "the function of an event") else {
                continue;
            };
            self.parse(&text, parse_expression);
            for instance in self.own_names(key, "an event") {
                let context = Context::motion("the function of an event");
                let expected = Expected::Anything;
                let Some(value) = self.expression(&text, &instance.bindings, context, expected)
                else {
                    continue;
                };
                if self.graph.symbols_in(&[value]).is_empty() {
                    let message =
                        "the function of an event is a number, which is zero never or always";
                    self.push(Diagnostic::error("constant-event", text.place, message));
                    continue;
                }
                if self.multipliers_exist(value, &text, constraints) {
                    events.push(EventStated {
                        name: instance.name,
                        value,
                        text: text.content.clone(),
                        zero,
                        stops,
                        description: description.clone(),
                        place: key.place,
                    });
                }
            }
        }
        events
    }

    /// Whether every multiplier that occurs is that of a constraint.
    fn multipliers_exist(&mut self, value: Expr, text: &Text, constraints: &[Constraint]) -> bool {
        let g = self.graph.clone();
        let symbols = g.symbols_in(&[value]);
        let mut unknown = symbols.iter().filter_map(|&symbol| {
            let name = g.symbol_name(symbol).strip_prefix(MULTIPLIER)?;
            let is_known = constraints.iter().any(|c| c.name == name);
            (!is_known).then_some(name)
        });
        let Some(name) = unknown.next() else {
            return true;
        };
        let message = format!("there is no constraint `{name}` with such a multiplier");
        self.push(Diagnostic::error("unknown-name", text.place, message));
        false
    }
}
