//! Variations of the velocity that the user states: for some of the velocities a linear differential operator on the virtual
//! displacements, `[variation.NAME]` with `x = "delta_x' - g/m delta_x"` for δx' = D(δx) − (g/m) δx.

use chetaev_symbolic::syntax::parse_expression;
use chetaev_symbolic::{Expr, Symbol};

use super::scope::Context;
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::Variation;
use crate::raw::{Kind, Table};
use crate::source::Place;
use crate::text::Text;

/// What stands before the name of a coordinate where its virtual displacement is meant.
pub(crate) const DISPLACEMENT: &str = "delta_";

/// Names of the classical operators, which a model cannot give to another one.
const CLASSICAL: [&str; 4] = ["zero", "hoelder", "suslov", "vujanovic"];

impl Resolver {
    /// Every operator that is stated.
    pub(crate) fn variations(&mut self, root: &Table) -> Vec<Variation> {
        let mut variations: Vec<Variation> = Vec::new();
        let Some(table) = self.section(root, "variation") else {
            return variations;
        };
        self.check_displacements(root);
        for (key, raw) in &table.entries {
            let Kind::Table(relations) = &raw.kind else {
                self.wrong_kind(
                    raw,
                    &format!("`variation.{}`", key.content),
                    "a table of formulas by coordinate",
                );
                continue;
            };
            if CLASSICAL.contains(&key.content.as_str()) {
                let message = format!("`{}` is a classical operator, which is always looked at; give yours another name", key.content);
                self.push(Diagnostic::error("duplicate-name", key.place, message));
                continue;
            }
            for instance in self.own_names(key, "a variation") {
                let relations = self.relations(relations);
                variations.push(Variation {
                    name: instance.name,
                    relations,
                    place: key.place,
                });
            }
        }
        variations
    }

    /// Displacements have names that nothing else may have.
    fn check_displacements(&mut self, root: &Table) {
        let place = root.get("variation").map(|raw| raw.place);
        let taken: Vec<String> = self
            .coordinates
            .iter()
            .map(|c| format!("{DISPLACEMENT}{}", c.name))
            .filter(|name| self.names.contains_key(name))
            .collect();
        for (name, place) in taken.iter().zip(place) {
            let message = format!(
                "`{name}` is declared, and in [variation] it stands for a virtual displacement"
            );
            self.push(
                Diagnostic::error("duplicate-name", place, message)
                    .hint("give the other one another name"),
            );
        }
    }

    /// The operators by coordinate; velocities without one keep a free variation.
    fn relations(&mut self, table: &Table) -> Vec<(usize, Expr)> {
        let what = "the variation of a velocity";
        let mut relations = Vec::new();
        for (key, raw) in &table.entries {
            let Some(text) = self.expression_text(raw, what) else {
                continue;
            };
            let parsed = self.parse(&text, parse_expression);
            for instance in self.instances(key, what, &[]) {
                let own = self
                    .coordinates
                    .iter()
                    .position(|c| c.name == instance.name);
                let Some(coordinate) = own.filter(|_| instance.order == 0) else {
                    self.no_variation(key);
                    break;
                };
                if parsed.has_errors() {
                    continue;
                }
                let context = Context::jet(what).with_displacements();
                let value = self.lower(&text, &parsed, parsed.root(), &instance.bindings, context);
                if let Some(value) = value {
                    if self.is_linear(value, text.place) {
                        relations.push((coordinate, value));
                    }
                }
            }
        }
        relations
    }

    fn no_variation(&mut self, key: &Text) {
        let message = format!(
            "`{}` is no coordinate; the variation of its velocity cannot be stated",
            key.content
        );
        let mut diagnostic = Diagnostic::error("not-a-coordinate", key.place, message);
        if let Some(c) = self.coordinates.first() {
            diagnostic = diagnostic.hint(format!(
                "write the name of a coordinate without a prime, as in {0} = \"{DISPLACEMENT}{0}'\" for δ{0}' = D(δ{0})",
                c.name
            ));
        }
        self.push(diagnostic);
    }

    /// Whether an operator is linear and homogeneous in the displacements and their derivatives.
    fn is_linear(&mut self, value: Expr, place: Place) -> bool {
        let graph = self.graph.clone();
        let is_displacement = |s: &Symbol| {
            let name = graph.symbol_name(*s).strip_prefix(DISPLACEMENT);
            name.is_some_and(|name| self.coordinates.iter().any(|c| c.name == name))
        };
        let symbols: Vec<Symbol> = graph
            .symbols_in(&[value])
            .into_iter()
            .filter(is_displacement)
            .collect();
        let slopes = graph.gradient(value, &symbols);
        let vanishing: Vec<(Expr, Expr)> = symbols
            .iter()
            .map(|&s| (graph.symbol_expr(s), graph.zero()))
            .collect();
        let rest = graph.substitute(value, &vanishing);
        if graph.any_contains_any(&slopes, &symbols) || !graph.is_zero(rest) {
            let message = "the variation of a velocity is linear in the virtual displacements and their derivatives, without other terms";
            self.push(
                Diagnostic::error("not-linear", place, message).hint(format!(
                    "as in \"a(q, q', t) {DISPLACEMENT}x + b(q, q', t) {DISPLACEMENT}x'\""
                )),
            );
            return false;
        }
        true
    }
}
