//! Parameters: their values closed over each other, their ranges, and the assumptions about them.

use std::cmp::Ordering;
use std::sync::Arc;

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::{Expr, Rational};

use super::advice::{is_degree, names_a_degree};
use super::define::{dependency_order, joined};
use super::formula::Expected;
use super::scope::{Context, NamedKind};
use super::{Resolver, Stated};
use crate::diagnostic::Diagnostic;
use crate::model::{Assumption, Parameter};
use crate::raw::{Kind, Raw, Table};
use crate::text::Text;
use crate::units::{quantity, Unit};
use chetaev_symbolic::syntax::Relation;

impl Resolver {
    pub(crate) fn declare_parameters(&mut self, root: &Table) {
        let Some(raw) = root.get("parameters") else {
            return;
        };
        match &raw.kind {
            Kind::Array(items) => {
                for item in items {
                    match &item.kind {
                        Kind::Text(name) => self.declare_parameter(name, None),
                        _ => self.wrong_kind(item, "a parameter without value", "a text, its name"),
                    }
                }
            }
            Kind::Table(table) => {
                for (key, raw) in &table.entries {
                    self.declare_parameter(key, Some(raw));
                }
            }
            _ => self.wrong_kind(raw, "`parameters`", "a table, or an array of names"),
        }
    }

    fn declare_parameter(&mut self, key: &Text, raw: Option<&Raw>) {
        let mut unit = None;
        let mut description = String::new();
        let mut value = raw;
        let mut range = None;
        if let Some(Raw {
            kind: Kind::Table(table),
            ..
        }) = raw
        {
            self.known_keys(
                table,
                &["value", "unit", "range", "description", "latex"],
                "of a parameter",
            );
            self.symbol(key, table);
            let before = self.diagnostics.len();
            (unit, description) = self.unit_and_description(table);
            self.excuse_unit(key, before);
            value = table.get("value");
            range = table.get("range");
        }
        let text = value.and_then(|value| self.expression_text(value, "the value of a parameter"));
        for instance in self.instances(key, "a parameter", &[]) {
            if instance.order > 0 {
                let message = format!(
                    "`{}` is a derivative; a parameter is a constant and has none",
                    key.content
                );
                self.push(Diagnostic::error("bad-name", key.place, message));
                return;
            }
            if !self.declare(key, &instance.name, NamedKind::Parameter) {
                continue;
            }
            let symbol = self.graph.symbol(&instance.name, 0);
            self.parameters.push(Parameter {
                name: instance.name.clone(),
                symbol,
                definition: None,
                value: None,
                range: None,
                unit: unit.clone(),
                description: description.clone(),
                place: key.place,
            });
            self.stated.push(Stated {
                value: text.clone(),
                range: range.cloned(),
                bindings: instance.bindings,
            });
        }
    }

    /// Lowers the values of all parameters, then replaces parameters in them, in an order that has no circles.
    pub(crate) fn resolve_parameters(&mut self) {
        for at in 0..self.parameters.len() {
            let (name, unit) = (
                self.parameters[at].name.clone(),
                self.parameters[at].unit.clone(),
            );
            let stated = self.stated[at].clone();
            let (text, bindings) = match self.take_override(&name) {
                Some(text) => (Some(text), Vec::new()),
                None => (stated.value, stated.bindings.clone()),
            };
            let (text, unit) = self.measured(text, unit);
            if self.parameters[at].unit.is_none() {
                self.parameters[at].unit.clone_from(&unit);
            }
            if let Some(text) = text {
                let context = Context::constant("the value of a parameter");
                let expected = Expected::Quantity(name.clone(), 0);
                self.check_degrees(at, &text, unit.as_ref());
                let value = self.expression(&text, &bindings, context, expected);
                self.parameters[at].definition =
                    value.map(|value| self.in_base_units(value, unit.as_ref()));
            }
            if let Some(range) = stated.range {
                self.parameters[at].range = self.parameter_range(&range, &stated.bindings, at);
            }
        }
        self.close_parameters();
        self.check_ranges();
    }

    /// The number of `8 kg` with its unit, unless the model has something of this name: it is a product then, as everywhere. What has a unit of its own
    /// keeps to its dimension.
    fn measured(
        &mut self,
        text: Option<Text>,
        stated: Option<Unit>,
    ) -> (Option<Text>, Option<Unit>) {
        let Some((own, number, unit)) = text.as_ref().and_then(|own| {
            let (number, unit, read) = quantity(&own.content)?;
            let mut words = unit.split(|sign: char| !(sign.is_alphanumeric() || sign == '_'));
            let is_a_unit = words.all(|word| !self.names.contains_key(word) && !is_degree(word));
            is_a_unit.then_some((own, number, read))
        }) else {
            return (text, stated);
        };
        if let Some(stated) = stated.filter(|stated| stated.dimension != unit.dimension) {
            let message = format!(
                "the value is in `{}` and its unit is stated as `{}`",
                unit.text, stated.text
            );
            let place = own.place;
            self.push(Diagnostic::error("wrong-dimension", place, message));
            return (None, Some(stated));
        }
        let at = own.content.find(number).unwrap_or(0);
        (Some(own.part(at, number)), Some(unit))
    }

    /// A number of degrees is in radians already, takes no other unit, and needs none.
    fn check_degrees(&mut self, at: usize, text: &Text, unit: Option<&Unit>) {
        let is_declared = |name: &str| self.names.contains_key(name);
        if !names_a_degree(&text.content)
            || ["deg", "degree", "degrees"].into_iter().any(is_declared)
        {
            return;
        }
        match unit {
            None => self.without_blame.push(self.parameters[at].place),
            Some(unit) if unit.text == "rad" => {}
            Some(unit) => {
                let message = format!(
                    "the value is in degrees and its unit is stated as `{}`",
                    unit.text
                );
                let hint =
                    "write value = 30, unit = \"deg\", or the text \"30 deg\" without a unit";
                self.push(Diagnostic::error("unit-twice", text.place, message).hint(hint));
            }
        }
    }

    fn parameter_range(
        &mut self,
        raw: &Raw,
        bindings: &Bindings,
        at: usize,
    ) -> Option<(Expr, Expr)> {
        let (name, unit) = (
            self.parameters[at].name.clone(),
            self.parameters[at].unit.clone(),
        );
        let Kind::Array(items) = &raw.kind else {
            self.wrong_kind(raw, "`range`", "an array of two ends");
            return None;
        };
        let [low, high] = items.as_slice() else {
            self.push(Diagnostic::error(
                "wrong-kind",
                raw.place,
                "`range` must have two ends, the lower one first",
            ));
            return None;
        };
        let mut ends = Vec::new();
        for end in [low, high] {
            let text = self.expression_text(end, "the end of a range")?;
            self.check_degrees(at, &text, unit.as_ref());
            let expected = Expected::Quantity(name.clone(), 0);
            let value = self.expression(
                &text,
                bindings,
                Context::number("the range of a parameter"),
                expected,
            )?;
            ends.push(self.in_base_units(value, unit.as_ref()));
        }
        let values: Vec<Option<f64>> = ends.iter().map(|end| self.constant_f64(*end)).collect();
        if let [Some(low), Some(high)] = values.as_slice() {
            if low > high {
                self.push(Diagnostic::error(
                    "empty-range",
                    raw.place,
                    "the lower end of the range comes first",
                ));
                return None;
            }
        }
        Some((ends[0], ends[1]))
    }

    /// The value of an expression without symbols, to the precision of a double; used for comparisons only.
    pub(crate) fn constant_f64(&self, value: Expr) -> Option<f64> {
        let values = self.graph.evaluate_f64(&[value], &|_| None).ok()?;
        values.first().copied().filter(|value| value.is_finite())
    }

    /// Numbers for expressions of parameters, if all have values.
    pub(crate) fn known_values(&self, expressions: &[Expr]) -> Option<Vec<f64>> {
        let closed = self
            .graph
            .substitute_all(expressions, &self.parameter_values());
        closed
            .into_iter()
            .map(|value| self.constant_f64(value))
            .collect()
    }

    /// Symbols of the parameters that have values, with these.
    fn parameter_values(&self) -> Vec<(Expr, Expr)> {
        self.parameters
            .iter()
            .filter_map(|parameter| Some((parameter.symbol, parameter.value?)))
            .collect()
    }

    fn close_parameters(&mut self) {
        let graph = Arc::clone(&self.graph);
        let uses: Vec<Vec<usize>> = self
            .parameters
            .iter()
            .map(|parameter| self.parameters_used(parameter))
            .collect();
        let order = dependency_order(&uses);
        for circle in &order.circles {
            self.report_circle(circle);
        }
        for at in order.sorted {
            let Some(definition) = self.parameters[at].definition else {
                continue;
            };
            let known: Option<Vec<(Expr, Expr)>> = uses[at]
                .iter()
                .map(|used| Some((self.parameters[*used].symbol, self.parameters[*used].value?)))
                .collect();
            self.parameters[at].value = known.map(|known| graph.substitute(definition, &known));
        }
    }

    fn parameters_used(&self, parameter: &Parameter) -> Vec<usize> {
        let Some(definition) = parameter.definition else {
            return Vec::new();
        };
        let symbols = self.graph.symbols_in(&[definition]);
        symbols
            .into_iter()
            .filter_map(|symbol| {
                self.parameters
                    .iter()
                    .position(|other| other.name == self.graph.symbol_name(symbol))
            })
            .collect()
    }

    fn report_circle(&mut self, circle: &[usize]) {
        let names: Vec<String> = circle
            .iter()
            .map(|at| format!("`{}`", self.parameters[*at].name))
            .collect();
        let first = self.parameters[circle[0]].place;
        let message = if circle.len() == 1 {
            format!("the parameter {} is defined by itself", names[0])
        } else {
            format!(
                "the parameters {} are defined by each other",
                joined(&names)
            )
        };
        let mut diagnostic = Diagnostic::error("circular-definition", first, message);
        for at in circle.iter().skip(1) {
            diagnostic = diagnostic.related(self.parameters[*at].place, "and this one");
        }
        self.push(diagnostic);
    }

    /// Warns of values outside their own ranges.
    fn check_ranges(&mut self) {
        for at in 0..self.parameters.len() {
            let parameter = &self.parameters[at];
            let (Some(value), Some((low, high))) = (parameter.value, parameter.range) else {
                continue;
            };
            let of = |e| self.constant_f64(e);
            let (Some(value), Some(low), Some(high)) = (of(value), of(low), of(high)) else {
                continue;
            };
            if value < low || value > high {
                let message = format!("the value of `{}` lies outside its range", parameter.name);
                let place = parameter.place;
                self.push(Diagnostic::warning("outside-range", place, message));
            }
        }
    }

    /// Reports assumptions that the values of the parameters contradict: what is proved under them says nothing then.
    pub(crate) fn check_assumptions(&mut self, assumptions: &[Assumption]) {
        let known = self.parameter_values();
        for assumption in assumptions {
            let sides = self
                .graph
                .substitute_all(&[assumption.left, assumption.right], &known);
            let difference = self.graph.sub(sides[0], sides[1]);
            let Some(order) = self.sign_of(difference, &sides) else {
                continue;
            };
            let holds = match assumption.relation {
                Relation::Equal => order.is_eq(),
                Relation::NotEqual => order.is_ne(),
                Relation::Less => order.is_lt(),
                Relation::LessOrEqual => order.is_le(),
                Relation::Greater => order.is_gt(),
                Relation::GreaterOrEqual => order.is_ge(),
            };
            if !holds {
                let message = format!(
                    "the assumption `{}` does not hold for the values of the parameters",
                    assumption.text
                );
                let of = |e: Expr| {
                    self.constant_f64(e)
                        .map_or_else(String::new, |value| value.to_string())
                };
                let label = format!("{} and {}", of(sides[0]), of(sides[1]));
                self.push(
                    Diagnostic::error("assumption-violated", assumption.place, message)
                        .label(label),
                );
            }
        }
        self.check_bounds(assumptions, &known);
    }

    /// Reports bounds on one symbol that no number meets: everything could be proved under them.
    fn check_bounds(&mut self, assumptions: &[Assumption], known: &[(Expr, Expr)]) {
        let mut lower: Vec<(Expr, Bound)> = Vec::new();
        let mut upper: Vec<(Expr, Bound)> = Vec::new();
        for (at, assumption) in assumptions.iter().enumerate() {
            let sides = self
                .graph
                .substitute_all(&[assumption.left, assumption.right], known);
            let (symbol, value, relation) =
                match (self.constant_f64(sides[0]), self.constant_f64(sides[1])) {
                    (None, Some(value)) => (sides[0], value, assumption.relation),
                    (Some(value), None) => (sides[1], value, mirrored(assumption.relation)),
                    _ => continue,
                };
            let is_strict = matches!(relation, Relation::Less | Relation::Greater);
            let bound = Bound {
                value,
                is_strict,
                at,
            };
            if matches!(
                relation,
                Relation::Greater | Relation::GreaterOrEqual | Relation::Equal
            ) {
                lower.push((symbol, bound));
            }
            if matches!(
                relation,
                Relation::Less | Relation::LessOrEqual | Relation::Equal
            ) {
                upper.push((symbol, bound));
            }
        }
        let empty = lower.iter().find_map(|(symbol, low)| {
            upper
                .iter()
                .filter(|(other, _)| other == symbol)
                .find(|(_, high)| {
                    low.value > high.value
                        || low.value == high.value && (low.is_strict || high.is_strict)
                })
                .map(|(_, high)| (low.at.min(high.at), low.at.max(high.at)))
        });
        if let Some((first, second)) = empty {
            let [first, second] = [first, second].map(|at| &assumptions[at]);
            let message = format!(
                "no number meets both `{}` and `{}`",
                first.text, second.text
            );
            let diagnostic = Diagnostic::error("contradictory-assumptions", second.place, message)
                .related(first.place, "assumed here");
            self.push(diagnostic);
        }
    }

    /// The sign of a difference without symbols: exact for rational numbers, and not decided for other numbers that
    /// cannot be told from zero in double precision.
    fn sign_of(&self, difference: Expr, sides: &[Expr]) -> Option<Ordering> {
        if let Some(number) = self.graph.as_number(difference) {
            return Some(number.cmp(&Rational::ZERO));
        }
        let scale: f64 = sides
            .iter()
            .map(|side| self.constant_f64(*side).map(f64::abs))
            .sum::<Option<f64>>()?;
        let value = self.constant_f64(difference)?;
        (value.abs() > 1e-9 * scale).then(|| value.total_cmp(&0.0))
    }
}

/// One end of the range that assumptions leave to an expression.
#[derive(Clone, Copy)]
struct Bound {
    value: f64,
    is_strict: bool,
    /// Number of the assumption.
    at: usize,
}

/// The relation with its sides exchanged.
fn mirrored(relation: Relation) -> Relation {
    match relation {
        Relation::Less => Relation::Greater,
        Relation::LessOrEqual => Relation::GreaterOrEqual,
        Relation::Greater => Relation::Less,
        Relation::GreaterOrEqual => Relation::LessOrEqual,
        same => same,
    }
}
