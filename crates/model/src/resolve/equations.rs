//! Equations that somebody states as the equations of motion: `[equations.NAME]` with `equations`, a table or an array of them,
//! and `unknowns` of their own.

use std::rc::Rc;

use chetaev_symbolic::syntax::{parse_equation, Parsed};
use chetaev_symbolic::Symbol;

use super::declare::all_bindings;
use super::formula::{Expected, Formula};
use super::scope::{Context, MULTIPLIER};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Constraint, StatedEquation, StatedEquations};
use crate::raw::{Kind, Raw, Table};
use crate::text::Text;

const KEYS: &[&str] = &["equations", "unknowns", "description", "source"];

impl Resolver {
    /// Every set of equations that is stated.
    pub(crate) fn stated_equations(
        &mut self,
        root: &Table,
        constraints: &[Constraint],
    ) -> Vec<StatedEquations> {
        let mut all: Vec<StatedEquations> = Vec::new();
        let Some(table) = self.section(root, "equations") else {
            return all;
        };
        for (key, raw) in &table.entries {
            let (equations, unknowns, description) = match &raw.kind {
                Kind::Array(_) => (Some(raw), Vec::new(), String::new()),
                Kind::Table(table) => {
                    self.known_keys(table, KEYS, "of a set of equations");
                    let unknowns = table.get("unknowns").map(|raw| self.own_unknowns(raw));
                    let description = self.prose(table, "description");
                    let source = self.prose(table, "source");
                    let words = [description, source].into_iter().filter(|w| !w.is_empty());
                    let words: Vec<String> = words.collect();
                    (
                        table.get("equations"),
                        unknowns.unwrap_or_default(),
                        words.join(" — "),
                    )
                }
                _ => {
                    let wanted = "an array of equations, or a table with `equations`";
                    self.wrong_kind(raw, &format!("`equations.{}`", key.content), wanted);
                    continue;
                }
            };
            let Some(equations) = equations else {
                let message = format!("`equations.{}` needs its `equations`", key.content);
                self.push(Diagnostic::error("missing-value", key.place, message));
                continue;
            };
            self.unknowns.clone_from(&unknowns);
            let equations = self.equations_of_motion(equations, constraints);
            self.unknowns.clear();
            let g = self.graph.clone();
            let unknowns: Vec<Symbol> = unknowns.iter().map(|u| g.intern_symbol(u, 0)).collect();
            for instance in self.own_names(key, "a set of equations") {
                all.push(StatedEquations {
                    name: instance.name,
                    unknowns: unknowns.clone(),
                    equations: equations.clone(),
                    description: description.clone(),
                    place: key.place,
                });
            }
        }
        all
    }

    /// Names that nothing else has.
    fn own_unknowns(&mut self, raw: &Raw) -> Vec<String> {
        let mut found = Vec::new();
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(raw, "`unknowns`", "an array of names such as \"N\"");
            return found;
        };
        for item in items {
            let Kind::Text(key) = &item.kind else {
                self.wrong_kind(item, "an unknown", "a text, its name");
                continue;
            };
            for instance in self.instances(key, "an unknown", &[]) {
                let name = instance.name;
                let problem = if instance.order > 0 {
                    Some(format!(
                        "`{}` has a prime; unknowns are stated without",
                        key.content
                    ))
                } else if let Some(named) = self.names.get(&name) {
                    let word = named.kind.word();
                    Some(format!(
                        "`{name}` is {word} already, and cannot be an unknown too"
                    ))
                } else if name.starts_with(MULTIPLIER) {
                    Some(format!("`{name}` is the multiplier of a constraint, which is an unknown anyway; give an unknown of your own another name"))
                } else {
                    None
                };
                match problem {
                    Some(message) => {
                        self.push(Diagnostic::error("declared-twice", key.place, message));
                    }
                    None => found.push(name),
                }
            }
        }
        found
    }

    fn equations_of_motion(
        &mut self,
        raw: &Raw,
        constraints: &[Constraint],
    ) -> Vec<StatedEquation> {
        let named: Vec<(Option<&Text>, &Raw)> = match &raw.kind {
            Kind::Array(items) => items.iter().map(|item| (None, item)).collect(),
            Kind::Table(table) => {
                let entries = table.entries.iter();
                entries.map(|(key, raw)| (Some(key), raw)).collect()
            }
            Kind::Text(_) => vec![(None, raw)],
            _ => {
                self.wrong_kind(raw, "`equations`", "an array or a table of equations");
                Vec::new()
            }
        };
        let mut found = Vec::new();
        for (number, (key, item)) in named.into_iter().enumerate() {
            let Kind::Text(text) = &item.kind else {
                self.wrong_kind(item, "an equation", "a text, `left = right`");
                continue;
            };
            let name = key.map_or_else(|| (number + 1).to_string(), |key| key.content.clone());
            let parsed = self.parse(text, parse_equation);
            if !parsed.has_errors() {
                self.equation_of_motion(&name, text, &parsed, constraints, &mut found);
            }
        }
        found
    }

    /// One equation, or one for each value of the indices in it.
    fn equation_of_motion(
        &mut self,
        name: &str,
        text: &Text,
        parsed: &Rc<Parsed>,
        constraints: &[Constraint],
        found: &mut Vec<StatedEquation>,
    ) {
        let indices = self.free_indices(parsed);
        if !self.is_small_family(&indices, text) {
            return;
        }
        let context = Context::equation_of_motion("an equation of motion");
        for bindings in all_bindings(&indices) {
            let mut side = |at: usize| {
                let side = *parsed.sides.get(at)?;
                self.lower(text, parsed, side, &bindings, context)
            };
            let (Some(left), Some(right)) = (side(0), side(1)) else {
                continue;
            };
            let difference = self.graph.sub(left, right);
            if !self.multipliers_exist(difference, text, constraints) {
                continue;
            }
            let values = bindings
                .iter()
                .map(|(index, value)| format!("{index} = {value}"));
            let values: Vec<String> = values.collect();
            let name = if values.is_empty() {
                name.to_owned()
            } else {
                format!("{name} ({})", values.join(", "))
            };
            self.formulas.push(Formula {
                text: text.clone(),
                parsed: Rc::clone(parsed),
                bindings,
                expected: Expected::EqualSides,
                define: None,
            });
            found.push(StatedEquation {
                name,
                left,
                right,
                text: text.content.clone(),
            });
        }
    }
}
