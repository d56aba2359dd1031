//! Events along a motion: `[events.NAME]` with `when`, a function whose zeros are meant, `direction` and `action`.

use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, Options, ZeroTest};
use chetaev_symbolic::{Expr, Symbol, Verdict};

use super::define::{Define, DefineKind};
use super::formula::Expected;
use super::scope::{Context, MULTIPLIER};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Constraint, Definition, EventStated, Zero};
use crate::raw::{Kind, Table};
use crate::text::Text;

/// Operations spent on the question whether the function of an event ever changes.
const CONSTANT_BUDGET: u64 = 50_000_000;

impl Resolver {
    /// Whether a function has one value at all times and states, for any parameters: whether its values at two of them, each with
    /// symbols of its own, are proved to be equal.
    fn never_changes(&self, value: Expr) -> bool {
        let g = &self.graph;
        let fixed: Vec<Option<Symbol>> = (self.parameters.iter())
            .map(|p| g.as_symbol(p.symbol))
            .collect();
        let moving = g.symbols_in(&[value]).into_iter();
        let elsewhere: Vec<(Expr, Expr)> = moving
            .filter(|s| !fixed.contains(&Some(*s)))
            .enumerate()
            .map(|(i, s)| (g.symbol_expr(s), g.symbol(&format!("elsewhere_{i}"), 0)))
            .collect();
        if elsewhere.is_empty() {
            return true;
        }
        let residuals = [g.sub(value, g.substitute(value, &elsewhere))];
        let test = ZeroTest {
            residuals: &residuals,
            solved: &[],
            implicit: &[],
            assumptions: &Assumptions::new(),
            options: Options {
                budget: CONSTANT_BUDGET,
                refute: false,
                ..Options::default()
            },
        };
        matches!(decide_zero(g, &test), Verdict::Proved(_))
    }

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
                if self.never_changes(value) {
                    let message = "the function of an event is a number, or the same whatever the motion: it is zero never or always";
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

    /// The quantities that are measured along the motion.
    pub(crate) fn sensors(&mut self, constraints: &[Constraint]) -> Vec<Definition> {
        let own = self.defines.iter();
        let own: Vec<Define> = own
            .filter(|own| own.kind == DefineKind::Sensor)
            .cloned()
            .collect();
        let known = own.iter().filter_map(|own| {
            let sensor = own.definition()?;
            let is_known = self.multipliers_exist(sensor.value, &own.text, constraints);
            is_known.then_some(sensor)
        });
        known.collect()
    }

    /// Whether every multiplier that occurs is that of a constraint.
    pub(crate) fn multipliers_exist(
        &mut self,
        value: Expr,
        text: &Text,
        constraints: &[Constraint],
    ) -> bool {
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
