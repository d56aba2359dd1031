//! A complete integral of the equation of Hamilton and Jacobi that the user states: `[complete_integral]` with `S`, the
//! parameters that are its constants, quadratures `S = … + ∫ g dq` by coordinate, and the values that the constants have on
//! motions, put in after S was differentiated by them.

use chetaev_symbolic::{Expr, Symbol};

use super::formula::Expected;
use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::CompleteIntegral;
use crate::raw::{Kind, Raw, Table};
use crate::text::Text;

/// What the section is called.
const SECTION: &str = "complete_integral";

impl Resolver {
    pub(crate) fn complete_integral(&mut self, root: &Table) -> Option<CompleteIntegral> {
        let raw = root.get(SECTION)?;
        let table = self.section(root, SECTION)?;
        let keys = ["S", "constants", "quadratures", "motion"];
        self.known_keys(table, &keys, "of [complete_integral]");
        let Some(stated) = table.get("S") else {
            let message = "a complete integral needs its `S`, a function of coordinates, constants and the time";
            self.push(Diagnostic::error("missing-value", raw.place, message));
            return None;
        };
        let constants = self.integration_constants(table, raw);
        let action = self.function(stated, "S", Context::position("a complete integral"))?;
        let quadratures = self.quadratures(table);
        let motion = self.values_on_motions(table, &constants);
        Some(CompleteIntegral {
            action,
            constants,
            quadratures,
            motion,
            place: raw.place,
        })
    }

    fn function(&mut self, raw: &Raw, what: &str, context: Context) -> Option<Expr> {
        let text = self.expression_text(raw, &format!("`{what}`"))?;
        self.expression(&text, &Vec::new(), context, Expected::Anything)
    }

    /// The parameters that are constants of integration.
    fn integration_constants(&mut self, table: &Table, section: &Raw) -> Vec<Symbol> {
        let wanted = "an array of names of parameters such as [\"E\", \"a\"]";
        let Some(raw) = table.get("constants") else {
            let message = "a complete integral needs its `constants`, names of parameters";
            self.push(Diagnostic::error("missing-value", section.place, message));
            return Vec::new();
        };
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(raw, "`constants`", wanted);
            return Vec::new();
        };
        let mut constants = Vec::new();
        for item in items {
            match &item.kind {
                Kind::Text(text) => constants.extend(self.parameter_called(text)),
                _ => self.wrong_kind(item, "a constant", "the name of a parameter"),
            }
        }
        constants
    }

    fn parameter_called(&mut self, text: &Text) -> Option<Symbol> {
        let found = self.parameters.iter().find(|p| p.name == text.content);
        let symbol = found.and_then(|p| self.graph.as_symbol(p.symbol));
        if symbol.is_none() {
            let message = format!(
                "`{}` is no parameter; the constants of a complete integral are declared there",
                text.content
            );
            self.push(
                Diagnostic::error("unknown-name", text.place, message)
                    .hint(format!("add `{} = {{}}` to [parameters]", text.content)),
            );
        }
        symbol
    }

    /// `quadratures = { x = "sqrt(2 (E - V(x)))" }`: functions of one coordinate and the constants.
    fn quadratures(&mut self, table: &Table) -> Vec<(usize, Expr)> {
        let Some(given) = self.section(table, "quadratures") else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for (key, raw) in &given.entries {
            let place = self.coordinates.iter().position(|c| c.name == key.content);
            let Some(place) = place else {
                let message = format!(
                    "`{}` is no coordinate; a quadrature is a function of one coordinate, integrated over it",
                    key.content
                );
                self.push(Diagnostic::error("not-a-coordinate", key.place, message));
                continue;
            };
            let context = Context::position("a quadrature");
            let Some(value) = self.function(raw, &key.content, context) else {
                continue;
            };
            let own = self.coordinates[place].symbol;
            let mut others: Vec<Symbol> = self
                .coordinates
                .iter()
                .filter(|c| c.symbol != own)
                .filter_map(|c| self.graph.as_symbol(c.symbol))
                .collect();
            others.push(self.graph.intern_symbol("t", 0));
            if self.graph.contains_any(value, &others) {
                let message = format!(
                    "the quadrature over `{}` contains another coordinate or the time",
                    key.content
                );
                self.push(Diagnostic::error("not-separated", raw.place, message));
                continue;
            }
            found.push((place, value));
        }
        found
    }

    /// `motion = { a = 0 }`: what the constants are on motions.
    fn values_on_motions(&mut self, table: &Table, constants: &[Symbol]) -> Vec<(Symbol, Expr)> {
        let Some(given) = self.section(table, "motion") else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for (key, raw) in &given.entries {
            let symbol = self.graph.intern_symbol(&key.content, 0);
            if !constants.contains(&symbol) {
                let message = format!("`{}` is none of the `constants`", key.content);
                self.push(Diagnostic::error("unknown-name", key.place, message));
                continue;
            }
            let context = Context::constant("a constant on motions");
            if let Some(value) = self.function(raw, &key.content, context) {
                found.push((symbol, value));
            }
        }
        found
    }
}
