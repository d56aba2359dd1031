//! Models that are said to have the same motion: `[twin.NAME]` with `model`, `map` and `parameters`.

use chetaev_symbolic::syntax::names;
use chetaev_symbolic::Expr;

use super::formula::Expected;
use super::scope::{Context, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{MassLaw, Model, Parameter, Twin};
use crate::raw::{Kind, Table};
use crate::source::Place;
use crate::text::Text;

const KEYS: &[&str] = &["model", "map", "parameters", "description"];

impl Resolver {
    /// Every twin that is stated.
    pub(crate) fn twins(&mut self, root: &Table) -> Vec<Twin> {
        let mut all = Vec::new();
        let Some(table) = self.section(root, "twin") else {
            return all;
        };
        for (key, raw) in &table.entries {
            let Kind::Table(stated) = &raw.kind else {
                let wanted = "a table with `model` and `map`";
                self.wrong_kind(raw, &format!("`twin.{}`", key.content), wanted);
                continue;
            };
            self.known_keys(stated, KEYS, "of a twin");
            let Some(path) = self.optional_text(stated, "model") else {
                if stated.get("model").is_none() {
                    let message =
                        format!("`twin.{}` needs `model`, the other model file", key.content);
                    self.push(Diagnostic::error("missing-value", key.place, message));
                }
                continue;
            };
            // What is wrong with the other file was said where it was read.
            let Some(model) = self.others.get(&path.place).cloned().flatten() else {
                continue;
            };
            let description = self.prose(stated, "description");
            let map = self.map_of(stated, &model, key.place);
            let symbols = self.symbols_of(stated, &model, key.place);
            if let Some(mass) = model
                .masses
                .iter()
                .find(|m| matches!(m.law, MassLaw::Rate { .. }))
            {
                let message = format!(
                    "the mass `{}` of `{}` has a law of its own; such models are not compared",
                    mass.name, path.content
                );
                self.push(Diagnostic::error("not-allowed-here", key.place, message));
                continue;
            }
            let (Some(map), Some(symbols)) = (map, symbols) else {
                continue;
            };
            for instance in self.own_names(key, "a twin") {
                all.push(Twin {
                    name: instance.name,
                    model: Box::new(model.clone()),
                    map: map.clone(),
                    symbols: symbols.clone(),
                    description: description.clone(),
                    place: key.place,
                });
            }
        }
        all
    }

    /// The other's coordinates by ours: those of `map`, and those that are called the same here.
    fn map_of(&mut self, stated: &Table, other: &Model, place: Place) -> Option<Vec<Expr>> {
        let what = "a coordinate of the other model";
        let mut values: Vec<Option<Expr>> = vec![None; other.n()];
        let mut failed = false;
        if let Some(raw) = stated.get("map") {
            let Kind::Table(map) = &raw.kind else {
                self.wrong_kind(
                    raw,
                    "`map`",
                    "a table of formulas by coordinate of the other model",
                );
                return None;
            };
            for (key, raw) in &map.entries {
                let Some(text) = self.expression_text(raw, what) else {
                    failed = true;
                    continue;
                };
                for instance in self.instances(key, what, &[]) {
                    let Some(at) = other
                        .coordinate(&instance.name)
                        .filter(|_| instance.order == 0)
                    else {
                        self.no_coordinate_of(other, key, &instance.name);
                        failed = true;
                        break;
                    };
                    values[at] = self.expression(
                        &text,
                        &instance.bindings,
                        Context::position(what),
                        Expected::Anything,
                    );
                    failed |= values[at].is_none();
                }
            }
        }
        for (value, coordinate) in values.iter_mut().zip(&other.coordinates) {
            let own = self
                .coordinates
                .iter()
                .find(|own| own.name == coordinate.name);
            *value = value.or(own.map(|own| own.symbol));
        }
        let missing = other
            .coordinates
            .iter()
            .zip(&values)
            .filter(|(_, v)| v.is_none());
        let missing: Vec<String> = missing.map(|(c, _)| format!("`{}`", c.name)).collect();
        if !missing.is_empty() && !failed {
            let message = format!(
                "`map` does not say what {} of the other model is in the coordinates of this one",
                missing.join(", ")
            );
            self.push(Diagnostic::error("missing-value", place, message));
        }
        values.into_iter().collect()
    }

    fn no_coordinate_of(&mut self, other: &Model, key: &Text, name: &str) {
        let message = format!("the other model has no coordinate `{}`", key.content);
        let mut diagnostic = Diagnostic::error("not-a-coordinate", key.place, message);
        let known = other.coordinates.iter().map(|c| c.name.as_str());
        if let Some(near) = names::closest(name, known) {
            diagnostic = diagnostic.hint(format!("did you mean `{near}`?"));
        }
        self.push(diagnostic);
    }

    /// The other's parameters and controls by ours: those of `parameters`, those that are called the same here, else the values and
    /// laws of the other.
    fn symbols_of(
        &mut self,
        stated: &Table,
        other: &Model,
        place: Place,
    ) -> Option<Vec<(String, Expr)>> {
        let mut symbols: Vec<(String, Expr)> = Vec::new();
        let mut complete = self.stated_parameters(stated, other, &mut symbols);
        for parameter in &other.parameters {
            if symbols.iter().any(|(name, _)| *name == parameter.name) {
                continue;
            }
            match self.parameter_of(parameter, other, place) {
                Ok(Some(value)) => symbols.push((parameter.name.clone(), value)),
                Ok(None) => {}
                Err(diagnostic) => {
                    self.push(diagnostic);
                    complete = false;
                }
            }
        }
        for control in &other.controls {
            let own = self.names.get(&control.name).map(|named| named.kind);
            if own == Some(NamedKind::Control) {
                symbols.push((control.name.clone(), self.graph.symbol(&control.name, 0)));
            } else if control.law.is_none() {
                let message = format!("the control `{}` of the other model has no law, and this model has no such control", control.name);
                self.push(Diagnostic::error("missing-value", place, message));
                complete = false;
            }
        }
        complete.then_some(symbols)
    }

    /// What `parameters` says.
    fn stated_parameters(
        &mut self,
        stated: &Table,
        other: &Model,
        symbols: &mut Vec<(String, Expr)>,
    ) -> bool {
        let what = "a parameter of the other model";
        let Some(raw) = stated.get("parameters") else {
            return true;
        };
        let Kind::Table(table) = &raw.kind else {
            self.wrong_kind(
                raw,
                "`parameters`",
                "a table of values by parameter of the other model",
            );
            return false;
        };
        let mut complete = true;
        for (key, raw) in &table.entries {
            let name = names::normalized(&key.content);
            if !other.parameters.iter().any(|p| p.name == name) {
                let message = format!("the other model has no parameter `{}`", key.content);
                self.push(Diagnostic::error("unknown-parameter", key.place, message));
                complete = false;
                continue;
            }
            let text = self.expression_text(raw, what);
            let value = text.and_then(|text| {
                self.parse(&text, chetaev_symbolic::syntax::parse_expression);
                self.expression(
                    &text,
                    &Vec::new(),
                    Context::constant(what),
                    Expected::Anything,
                )
            });
            match value {
                Some(value) => symbols.push((name, value)),
                None => complete = false,
            }
        }
        complete
    }

    /// A parameter that `parameters` does not name; `None` where the other model's own value or definition stands for it.
    #[allow(
        clippy::result_large_err,
        reason = "a diagnostic is made once, and shown at once"
    )]
    fn parameter_of(
        &self,
        parameter: &Parameter,
        other: &Model,
        place: Place,
    ) -> Result<Option<Expr>, Diagnostic> {
        let name = &parameter.name;
        let own = self.parameters.iter().find(|own| own.name == *name);
        let number = |g: &chetaev_symbolic::Graph, value: Option<Expr>| {
            value.and_then(|value| g.evaluate_f64(&[value], &|_| None).ok()?.first().copied())
        };
        match own {
            Some(own) => {
                let (here, there) = (
                    number(&self.graph, own.value),
                    number(&other.graph, parameter.value),
                );
                match (here, there) {
                    (Some(here), Some(there))
                        if (here - there).abs() > 1e-12 * here.abs().max(there.abs()) =>
                    {
                        let message = format!(
                            "the parameter `{name}` is {here} here and {there} in the other model"
                        );
                        Err(Diagnostic::error("inconsistent", place, message)
                            .hint(format!("if it is the same quantity, give it the same value; else say what it is, as in parameters = {{ {name} = {there} }}")))
                    }
                    _ => Ok(Some(own.symbol)),
                }
            }
            None if parameter.definition.is_some() => Ok(None),
            None => {
                let message = format!("the parameter `{name}` of the other model has no value, and this model has no such parameter");
                Err(
                    Diagnostic::error("missing-value", place, message).hint(format!(
                        "say what it is in this model, as in parameters = {{ {name} = \"…\" }}"
                    )),
                )
            }
        }
    }
}
