//! First integrals that the author states, on all states or on a part of them, and functions for the search.

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::{parse_expression, parse_relation, Relation};
use chetaev_symbolic::Expr;

use super::declare::Instance;
use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Definition, IntegralCondition, IntegralForm};
use crate::raw::{Kind, Raw, Table};

/// The degrees in the velocities up to which a model may ask for integrals.
const SEARCH_DEGREES: std::ops::RangeInclusive<u32> = 2..=6;

/// What `[integrals]` states.
#[derive(Default)]
pub(crate) struct StatedIntegrals {
    pub(crate) integrals: Vec<Definition>,
    /// Where they hold on a part of the states only.
    pub(crate) conditions: Vec<IntegralCondition>,
    /// Forms with unknowns.
    pub(crate) forms: Vec<IntegralForm>,
}

impl Resolver {
    pub(crate) fn integrals(&mut self, root: &Table) -> StatedIntegrals {
        let mut stated = StatedIntegrals::default();
        let Some(table) = self.section(root, "integrals") else {
            return stated;
        };
        for (key, raw) in &table.entries {
            let mut description = String::new();
            let mut value = Some(raw);
            let (mut on, mut unknown) = (None, None);
            if let Kind::Table(table) = &raw.kind {
                self.known_keys(
                    table,
                    &["value", "on", "unknown", "description"],
                    "of an integral",
                );
                (on, unknown) = (table.get("on"), table.get("unknown"));
                description = self
                    .optional_text(table, "description")
                    .map_or_else(String::new, |text| text.content.trim().to_owned());
                value = table.get("value");
            }
            let Some(value) = value else {
                self.push(Diagnostic::error(
                    "missing-value",
                    raw.place,
                    "an integral needs its `value`",
                ));
                continue;
            };
            let Some(text) = self.expression_text(value, "an integral") else {
                continue;
            };
            if let Some(unknown) = unknown {
                stated
                    .forms
                    .extend(self.integral_form(key, &text, unknown, description));
                continue;
            }
            self.parse(&text, parse_expression);
            for Instance { name, bindings, .. } in self.own_names(key, "an integral") {
                if let Some(on) = on {
                    self.integral_on(on, &name, &bindings, &mut stated.conditions);
                }
                let expected = Expected::Anything;
                if let Some(value) =
                    self.expression(&text, &bindings, Context::jet("an integral"), expected)
                {
                    let (text, description) = (text.content.clone(), description.clone());
                    stated.integrals.push(Definition {
                        name,
                        value,
                        text,
                        description,
                        place: key.place,
                    });
                }
            }
        }
        stated
    }

    /// `on = ["theta = th", "theta' = 0"]`.
    fn integral_on(
        &mut self,
        raw: &Raw,
        integral: &str,
        bindings: &Bindings,
        conditions: &mut Vec<IntegralCondition>,
    ) {
        let context = Context::state("where an integral holds");
        let equations = self.equations_of_list(raw, "`on`", bindings, context);
        conditions.extend(
            equations
                .into_iter()
                .map(|(text, left, right)| IntegralCondition {
                    integral: integral.to_owned(),
                    left,
                    right,
                    text,
                }),
        );
    }

    /// The equations of an array of texts, with their sides.
    pub(crate) fn equations_of_list(
        &mut self,
        raw: &Raw,
        key: &'static str,
        bindings: &Bindings,
        context: Context,
    ) -> Vec<(String, Expr, Expr)> {
        let mut found = Vec::new();
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(raw, key, "an array of equations such as \"theta' = 0\"");
            return found;
        };
        for item in items {
            let Kind::Text(text) = &item.kind else {
                self.wrong_kind(item, "an equation", "a text such as \"theta' = 0\"");
                continue;
            };
            let parsed = self.parse(text, parse_relation);
            let is_equation = matches!(parsed.relations[..], [(Relation::Equal, _)]);
            // What cannot be read was said where it was parsed.
            if parsed.has_errors() {
                continue;
            }
            if !is_equation {
                let message = format!(
                    "every entry of {key} must be an equation such as \"theta' = 0\"; \"{}\" is none",
                    text.content
                );
                self.push(Diagnostic::error("wrong-kind", item.place, message));
                continue;
            }
            let sides: Vec<Option<Expr>> = parsed
                .sides
                .iter()
                .map(|side| self.lower(text, &parsed, *side, bindings, context))
                .collect();
            if let [Some(left), Some(right)] = sides[..] {
                found.push((text.content.clone(), left, right));
            }
        }
        found
    }

    /// `[search] functions = ["sqrt(1 + x^2)", …]`, and `degree = 3`.
    pub(crate) fn search(&mut self, root: &Table) -> (Vec<Definition>, Option<u32>) {
        let Some(table) = self.section(root, "search") else {
            return (Vec::new(), None);
        };
        self.known_keys(table, &["functions", "degree"], "of [search]");
        let degree = table.get("degree").and_then(|raw| self.search_degree(raw));
        let functions = table.get("functions");
        let functions = functions.map(|raw| self.search_functions(raw));
        (functions.unwrap_or_default(), degree)
    }

    /// The degree in the velocities up to which integrals are searched.
    fn search_degree(&mut self, raw: &Raw) -> Option<u32> {
        let degree = self.integer(raw, "`degree`")?;
        let known = u32::try_from(degree).ok();
        let known = known.filter(|degree| SEARCH_DEGREES.contains(degree));
        if known.is_none() {
            let (least, most) = SEARCH_DEGREES.into_inner();
            let message = format!("`degree` must be a number from {least} to {most}");
            let diagnostic = Diagnostic::error("out-of-range", raw.place, message);
            self.push(diagnostic.hint(
                "it is the degree in the velocities up to which first integrals are searched; up to 2 they always are",
            ));
        }
        known
    }

    fn search_functions(&mut self, raw: &Raw) -> Vec<Definition> {
        let mut functions = Vec::new();
        let Kind::Array(items) = &raw.kind else {
            let wanted = "an array of functions such as \"sqrt(1 + x^2)\"";
            self.wrong_kind(raw, "`functions`", wanted);
            return functions;
        };
        for item in items {
            let what = "a function for the search";
            let Some(text) = self.expression_text(item, what) else {
                continue;
            };
            self.parse(&text, parse_expression);
            let context = Context::position(what);
            if let Some(value) = self.expression(&text, &Vec::new(), context, Expected::Anything) {
                functions.push(Definition {
                    name: text.content.clone(),
                    value,
                    text: text.content.clone(),
                    description: String::new(),
                    place: item.place,
                });
            }
        }
        functions
    }
}
