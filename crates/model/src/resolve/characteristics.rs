//! Kinematic characteristics that the user states: formulas q^(m) = φ(t, q, …, P) for the derivatives of the order of the
//! constraints, with parameters P of their own.

use chetaev_symbolic::syntax::parse_expression;

use super::scope::{Context, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{CharacteristicFormulas, Constraint};
use crate::raw::{Kind, Table};
use crate::source::Place;

/// The key of the list of parameters.
const PARAMETERS: &str = "parameters";

impl Resolver {
    /// Declares the parameters P, which only the formulas of the section may contain.
    pub(crate) fn declare_characteristics(&mut self, root: &Table) {
        let Some(raw) = root.get("characteristics") else {
            return;
        };
        let Some(table) = self.section(root, "characteristics") else {
            return;
        };
        let Some(list) = table.get(PARAMETERS) else {
            let message = "characteristics need the names of their `parameters`";
            self.push(
                Diagnostic::error("missing-value", raw.place, message)
                    .hint("add them as in parameters = [\"P\", \"theta\"]"),
            );
            return;
        };
        let Kind::Array(items) = &list.kind else {
            self.wrong_kind(list, "`parameters`", "an array of names");
            return;
        };
        for item in items {
            let Kind::Text(text) = &item.kind else {
                self.wrong_kind(item, "a parameter of the characteristics", "a name");
                continue;
            };
            for instance in self.own_names(text, "a parameter of the characteristics") {
                let name = instance.name;
                if self.declare(text, &name, NamedKind::Characteristic) {
                    self.characteristic_parameters.push(name);
                }
            }
        }
    }

    /// The formulas, one for each coordinate.
    pub(crate) fn characteristics(
        &mut self,
        root: &Table,
        constraints: &[Constraint],
    ) -> Option<CharacteristicFormulas> {
        let place = root.get("characteristics")?.place;
        let table = root.get("characteristics")?.table()?;
        let order = constraints
            .iter()
            .map(|c| c.order)
            .max()
            .unwrap_or(1)
            .max(1);
        let mut formulas = vec![None; self.coordinates.len()];
        for (key, raw) in &table.entries {
            if key.content == PARAMETERS {
                continue;
            }
            let what = "a characteristic";
            let Some(text) = self.expression_text(raw, what) else {
                continue;
            };
            let parsed = self.parse(&text, parse_expression);
            for instance in self.instances(key, what, &[]) {
                let own = self
                    .coordinates
                    .iter()
                    .position(|c| c.name == instance.name);
                let Some(coordinate) = own.filter(|_| instance.order == order) else {
                    self.no_characteristic(key.place, &key.content, order);
                    break;
                };
                let context = Context::jet(what).with_characteristics(order - 1);
                if parsed.has_errors() {
                    continue;
                }
                formulas[coordinate] =
                    self.lower(&text, &parsed, parsed.root(), &instance.bindings, context);
            }
        }
        let missing: Vec<String> = self
            .coordinates
            .iter()
            .zip(&formulas)
            .filter(|(_, formula)| formula.is_none())
            .map(|(c, _)| format!("`{}{}`", c.name, "'".repeat(order as usize)))
            .collect();
        if !missing.is_empty() {
            let message = format!(
                "characteristics are stated for all coordinates; there is no formula for {}",
                missing.join(", ")
            );
            self.push(Diagnostic::error("missing-value", place, message));
            return None;
        }
        Some(CharacteristicFormulas {
            parameters: std::mem::take(&mut self.characteristic_parameters),
            order,
            formulas: formulas.into_iter().flatten().collect(),
            place,
        })
    }

    fn no_characteristic(&mut self, place: Place, key: &str, order: u32) {
        let primes = "'".repeat(order as usize);
        let message = format!(
            "`{key}` is no derivative of order {order} of a coordinate, and the characteristics parametrize those, the order of the constraints"
        );
        let example = self
            .coordinates
            .first()
            .map(|c| format!("{}{primes}", c.name));
        let mut diagnostic = Diagnostic::error("not-a-coordinate", place, message);
        if let Some(example) = example {
            diagnostic = diagnostic.hint(format!("write formulas such as \"{example}\" = …"));
        }
        self.push(diagnostic);
    }
}
