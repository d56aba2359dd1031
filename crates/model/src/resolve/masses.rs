//! Named masses: definitions that count as masses, and masses with a law of their own, M' = Φ, which are states.

use std::rc::Rc;

use chetaev_symbolic::syntax::{parse_expression, Severity};
use chetaev_symbolic::{Expr, Symbol};

use super::declare::Instance;
use super::define::{Define, DefineKind, State};
use super::formula::Expected;
use super::scope::{Context, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::{Mass, MassLaw};
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;
use crate::units::Unit;

/// A named mass while the model is being read.
#[derive(Clone, Debug)]
pub(crate) struct MassStated {
    pub(crate) name: String,
    /// The definition of its value, or of its rate where it has a law of its own.
    pub(crate) define: usize,
    /// Whether the definition is that of its rate.
    pub(crate) has_law: bool,
    pub(crate) unit: Option<Unit>,
    pub(crate) place: Place,
    initial: Option<Text>,
    value: Option<Expr>,
    description: String,
}

/// The keys of a mass.
const KEYS: &[&str] = &["value", "rate", "initial", "unit", "description", "latex"];

impl Resolver {
    /// Declares the names of `[masses]`; values and rates follow with the definitions.
    pub(crate) fn declare_masses(&mut self, root: &Table) {
        let Some(table) = self.section(root, "masses") else {
            return;
        };
        for (key, raw) in &table.entries {
            let Kind::Table(table) = &raw.kind else {
                self.declare_named_mass(key, raw);
                continue;
            };
            self.known_keys(table, KEYS, "of a mass");
            self.symbol(key, table);
            self.check_law(key, table);
            match (table.get("rate"), table.get("value")) {
                (Some(rate), _) => self.declare_mass_with_law(key, raw, rate),
                (None, Some(_)) => self.declare_named_mass(key, raw),
                (None, None) => self.declare_unknown_mass(key),
            }
        }
    }

    /// A mass has a value, or a rate with its initial value.
    fn check_law(&mut self, key: &Text, table: &Table) {
        if let (Some(value), Some(rate)) = (table.get("value"), table.get("rate")) {
            let message = format!(
                "the mass `{}` is stated by its `value` or by its `rate`, not by both",
                key.content
            );
            let diagnostic = Diagnostic::error("stated-twice", rate.place, message);
            self.push(diagnostic.related(value.place, "the other statement"));
        } else if table.get("rate").is_some() && table.get("initial").is_none() {
            let message = format!(
                "the mass `{}` has a law of its own and needs its `initial` value",
                key.content
            );
            self.push(
                Diagnostic::error("missing-value", key.place, message)
                    .hint("add it to the same table, as in { rate = \"-k\", initial = 3 }"),
            );
        } else if let (Some(initial), None) = (table.get("initial"), table.get("rate")) {
            let message = format!(
                "the mass `{}` has no `rate`, so nothing begins at its `initial` value",
                key.content
            );
            self.push(
                Diagnostic::error("missing-value", initial.place, message)
                    .hint("state the law of its own by `rate`, or its `value` as a function"),
            );
        } else if table.get("value").or_else(|| table.get("rate")).is_none() {
            let message = format!(
                "the mass `{}` needs its `value`, or its `rate`",
                key.content
            );
            self.push(Diagnostic::error("missing-value", key.place, message));
        }
    }

    /// The name of a mass of which nothing is known gives no further diagnostics.
    fn declare_unknown_mass(&mut self, key: &Text) {
        for Instance { name, bindings, .. } in self.instances(key, "a mass", &[]) {
            let number = self.defines.len();
            if self.declare(key, &name, NamedKind::Define(number)) {
                self.defines.push(Define {
                    name,
                    kind: DefineKind::Mass,
                    text: key.clone(),
                    parsed: Rc::new(parse_expression("0")),
                    bindings,
                    unit: None,
                    description: String::new(),
                    place: key.place,
                    state: State::Failed,
                    by_masses: None,
                    rank: 0,
                });
            }
        }
    }

    /// A definition that counts as a mass.
    fn declare_named_mass(&mut self, key: &Text, raw: &Raw) {
        let first = self.defines.len();
        self.declare_define(key, raw, DefineKind::Mass);
        for number in first..self.defines.len() {
            let define = &self.defines[number];
            self.masses.push(MassStated {
                name: define.name.clone(),
                define: number,
                has_law: false,
                unit: define.unit.clone(),
                place: key.place,
                initial: None,
                value: None,
                description: define.description.clone(),
            });
        }
    }

    /// A mass that is a state: its rate is a definition called like its derivative.
    fn declare_mass_with_law(&mut self, key: &Text, raw: &Raw, rate: &Raw) {
        let Some(table) = raw.table() else { return };
        let before = self.diagnostics.len();
        let (unit, description) = self.unit_and_description(table);
        self.excuse_unit(key, before);
        let unit = self.coherent(unit, key.place, "a mass with a law of its own");
        let text = self.expression_text(rate, "the rate of a mass");
        let parsed = text.as_ref().map(|text| self.parse(text, parse_expression));
        let initial = table
            .get("initial")
            .and_then(|raw| self.expression_text(raw, "the initial value of a mass"));
        let sound = parsed.as_ref().is_some_and(|parsed| !parsed.has_errors());
        for Instance {
            name,
            order,
            bindings,
        } in self.instances(key, "a mass", &[])
        {
            let number = self.defines.len();
            if self.has_prime(key, order) || !self.declare(key, &name, NamedKind::Mass(number)) {
                continue;
            }
            self.defines.push(Define {
                name: format!("{name}'"),
                kind: DefineKind::MassRate,
                text: text.clone().unwrap_or_else(|| key.clone()),
                parsed: parsed
                    .clone()
                    .unwrap_or_else(|| Rc::new(parse_expression("0"))),
                bindings,
                unit: None,
                description: String::new(),
                place: key.place,
                state: if sound { State::Open } else { State::Failed },
                by_masses: None,
                rank: 0,
            });
            self.masses.push(MassStated {
                name,
                define: number,
                has_law: true,
                unit: unit.clone(),
                place: key.place,
                initial: initial.clone(),
                value: None,
                description: description.clone(),
            });
        }
    }

    fn has_prime(&mut self, key: &Text, order: u32) -> bool {
        if order > 0 {
            let message = format!(
                "`{}` is a derivative; masses are declared without primes",
                key.content
            );
            self.push(
                Diagnostic::error("bad-name", key.place, message)
                    .hint("the law of a mass is its `rate`"),
            );
        }
        order > 0
    }

    /// The initial values of masses with a law; values and rates are known already.
    pub(crate) fn resolve_masses(&mut self) {
        for at in 0..self.masses.len() {
            let Some(text) = self.masses[at].initial.clone() else {
                continue;
            };
            let bindings = self.defines[self.masses[at].define].bindings.clone();
            let expected = Expected::Quantity(self.masses[at].name.clone(), 0);
            let context = Context::constant("the initial value of a mass");
            let value = self.expression(&text, &bindings, context, expected);
            self.masses[at].value = value;
            self.positive_start(at, value, &text);
        }
    }

    /// A mass begins above zero, where it is known.
    fn positive_start(&mut self, at: usize, value: Option<Expr>, text: &Text) {
        let Some(value) = value.map(|value| self.with_parameters(value)) else {
            return;
        };
        let number = self.graph.evaluate_f64(&[value], &|_| None);
        if number.is_ok_and(|number| number[0] <= 0.0) {
            let message = format!(
                "the mass `{}` must begin with a positive value",
                self.masses[at].name
            );
            self.push(Diagnostic::error("not-positive", text.place, message));
        }
    }

    /// An expression with the values of the parameters.
    pub(crate) fn with_parameters(&self, e: Expr) -> Expr {
        let values: Vec<(Expr, Expr)> = self
            .parameters
            .iter()
            .filter_map(|parameter| Some((parameter.symbol, parameter.value?)))
            .collect();
        self.graph.substitute(e, &values)
    }

    /// The public form of those that have a value, or a rate.
    pub(crate) fn masses(&mut self) -> Vec<Mass> {
        let stated = std::mem::take(&mut self.masses);
        let mut masses = Vec::new();
        for mass in stated {
            let define = &self.defines[mass.define];
            let State::Known(known) = define.state else {
                continue;
            };
            let law = match (mass.has_law, mass.value) {
                (false, _) => MassLaw::Value(known),
                (true, Some(initial)) => MassLaw::Rate {
                    rate: known,
                    initial,
                },
                (true, None) => continue,
            };
            masses.push(Mass {
                symbol: self.graph.symbol(&mass.name, 0),
                name: mass.name,
                law,
                text: define.text.content.clone(),
                unit: mass.unit,
                description: mass.description,
                place: mass.place,
            });
        }
        masses
    }

    /// The definition of the rate of a mass with a law of its own.
    pub(crate) fn law_of(&self, symbol: Symbol) -> Option<usize> {
        if self.graph.symbol_order(symbol) > 0 {
            return None;
        }
        match self.names.get(self.graph.symbol_name(symbol))?.kind {
            NamedKind::Mass(number) => Some(number),
            _ => None,
        }
    }

    /// The definitions of rates that the derivatives of an expression need, in all orders.
    pub(crate) fn laws_in(&self, e: Expr) -> Vec<usize> {
        let mut found: Vec<usize> = Vec::new();
        let mut open = vec![e];
        while let Some(e) = open.pop() {
            for symbol in self.graph.symbols_in(&[e]) {
                let Some(law) = self.law_of(symbol).filter(|law| !found.contains(law)) else {
                    continue;
                };
                found.push(law);
                if let State::Known(rate) = self.defines[law].state {
                    open.push(rate);
                }
            }
        }
        found
    }

    /// The total derivative, in which a mass with a law changes by its rate; those that stand as symbols although they are
    /// definitions change by the derivative of their value.
    pub(crate) fn total_derivative(&self, e: Expr) -> Expr {
        let graph = &self.graph;
        let one = graph.one();
        let known = |number: usize| match self.defines[number].state {
            State::Known(value) => Some(value),
            _ => None,
        };
        let rate = |symbol: Symbol| {
            let (name, order) = (graph.symbol_name(symbol), graph.symbol_order(symbol));
            if name == "t" && order == 0 {
                return Some(one);
            }
            match self.names.get(name)?.kind {
                NamedKind::Mass(number) => known(number),
                NamedKind::Define(number) => Some(self.total_derivative(known(number)?)),
                NamedKind::Coordinate | NamedKind::Control => Some(graph.symbol(name, order + 1)),
                _ => None,
            }
        };
        graph.derive(&[e], &rate).swap_remove(0)
    }

    /// Whether there are definitions that count as masses.
    pub(crate) fn has_named_values(&self) -> bool {
        self.masses.iter().any(|mass| !mass.has_law)
    }

    /// The same expression with all named masses as symbols, also those that are definitions; it has been lowered before.
    pub(crate) fn by_masses(&mut self, raw: &Raw, context: Context) -> Option<Expr> {
        if self.masses.is_empty() {
            return None;
        }
        let text = raw.expression()?.clone();
        let parsed = parse_expression(&text.content);
        let is_error = |d: &chetaev_symbolic::syntax::Diagnostic| d.severity == Severity::Error;
        if parsed.diagnostics.iter().any(is_error) {
            return None;
        }
        let context = context.with_masses_as_symbols();
        self.lower(&text, &parsed, parsed.root(), &Vec::new(), context)
    }
}
