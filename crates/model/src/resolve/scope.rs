//! What names mean in an expression, depending on where it stands.

use std::cell::RefCell;

use chetaev_symbolic::syntax::{Resolution, Scope};
use chetaev_symbolic::Expr;

use super::advice::is_degree;
use super::define::{DefineKind, State};
use super::variation::DISPLACEMENT;
use super::{Resolver, GUESSED};
use crate::source::Place;

/// Highest derivative of a definition that is taken; its size grows with each.
const MOST_DERIVATIVES: u32 = 8;

/// What a declared name is.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(crate) enum NamedKind {
    Coordinate,
    Parameter,
    Control,
    Define(usize),
    /// A mass with a law of its own, by the number of the definition of its rate.
    Mass(usize),
    Size(i64),
    Characteristic,
}

impl NamedKind {
    pub(crate) fn word(self) -> &'static str {
        match self {
            NamedKind::Coordinate => "a coordinate",
            NamedKind::Parameter => "a parameter",
            NamedKind::Control => "a control",
            NamedKind::Define(_) => "a definition",
            NamedKind::Mass(_) => "a mass",
            NamedKind::Size(_) => "a size",
            NamedKind::Characteristic => "a parameter of the characteristics",
        }
    }
}

/// What stands before the name of a constraint where its multiplier is meant.
pub(crate) const MULTIPLIER: &str = "lambda_";

/// A declared name with the place of its declaration.
#[derive(Copy, Clone, Debug)]
pub(crate) struct Named {
    pub(crate) kind: NamedKind,
    pub(crate) place: Place,
}

/// What an expression is for, and what may occur in it.
#[derive(Copy, Clone, Debug)]
pub(crate) struct Context {
    /// For messages: "the kinetic energy".
    pub(crate) what: &'static str,
    /// Whether coordinates may occur, and up to which derivative.
    pub(crate) coordinates: Option<u32>,
    /// Whether the time and the controls may occur.
    pub(crate) time: bool,
    /// Whether parameters may occur.
    pub(crate) parameters: bool,
    /// Whether parameters of the characteristics may occur.
    pub(crate) characteristics: bool,
    /// Whether virtual displacements may occur.
    pub(crate) displacements: bool,
    /// Whether `lambda_NAME` may occur; that there is such a constraint is looked at afterwards.
    pub(crate) multipliers: bool,
    /// Whether masses with a law of their own may occur.
    pub(crate) masses: bool,
    /// Whether masses that are definitions stand as symbols too.
    pub(crate) masses_as_symbols: bool,
    /// Advice where something that varies occurs and may not; may be empty.
    pub(crate) hint: &'static str,
}

impl Context {
    /// A function of q, q' and t.
    pub(crate) const fn state(what: &'static str) -> Self {
        Context {
            what,
            coordinates: Some(1),
            time: true,
            parameters: true,
            characteristics: false,
            displacements: false,
            multipliers: false,
            masses: true,
            masses_as_symbols: false,
            hint: "",
        }
    }

    /// A function of t, q, q', q'' and the multipliers along a motion.
    pub(crate) const fn motion(what: &'static str) -> Self {
        Context {
            coordinates: Some(2),
            multipliers: true,
            hint: "only the time, coordinates with two derivatives, multipliers and parameters may occur there",
            ..Context::state(what)
        }
    }

    /// An equation of motion.
    pub(crate) const fn equation_of_motion(what: &'static str) -> Self {
        Context {
            hint: "only the time, coordinates with two derivatives, multipliers, unknowns of their own and parameters may occur there",
            ..Context::motion(what)
        }
    }

    /// A function of q and t.
    pub(crate) const fn position(what: &'static str) -> Self {
        Context {
            what,
            coordinates: Some(0),
            time: true,
            parameters: true,
            characteristics: false,
            displacements: false,
            multipliers: false,
            masses: false,
            masses_as_symbols: false,
            hint: "only coordinates, controls, parameters and the time may occur there",
        }
    }

    /// The same without masses that have a law of their own: they are states, and no part of the kinematics.
    pub(crate) const fn without_masses(self) -> Self {
        Context {
            masses: false,
            hint: "a mass with a law of its own is a state of the motion: the kinematics cannot depend on it",
            ..self
        }
    }

    /// The same with all named masses as symbols.
    pub(crate) const fn with_masses_as_symbols(self) -> Self {
        Context {
            masses_as_symbols: true,
            ..self
        }
    }

    /// A function of all derivatives.
    pub(crate) const fn jet(what: &'static str) -> Self {
        Context {
            what,
            coordinates: Some(u32::MAX),
            time: true,
            parameters: true,
            characteristics: false,
            displacements: false,
            multipliers: false,
            masses: true,
            masses_as_symbols: false,
            hint: "",
        }
    }

    /// The same up to derivatives of some order, with parameters of the characteristics.
    pub(crate) const fn with_characteristics(self, most: u32) -> Self {
        Context {
            coordinates: Some(most),
            characteristics: true,
            hint: "derivatives of lower order than those the characteristics parametrize may occur there",
            ..self
        }
    }

    /// The same with virtual displacements `delta_x` of the coordinates and their derivatives.
    pub(crate) const fn with_displacements(self) -> Self {
        Context {
            displacements: true,
            ..self
        }
    }

    /// A function of the time.
    pub(crate) const fn time(what: &'static str) -> Self {
        Context {
            what,
            coordinates: None,
            time: true,
            parameters: true,
            characteristics: false,
            displacements: false,
            multipliers: false,
            masses: false,
            masses_as_symbols: false,
            hint: "",
        }
    }

    /// A constant that may depend on the parameters.
    pub(crate) const fn constant(what: &'static str) -> Self {
        Context {
            what,
            coordinates: None,
            time: false,
            parameters: true,
            characteristics: false,
            displacements: false,
            multipliers: false,
            masses: false,
            masses_as_symbols: false,
            hint: "",
        }
    }

    /// A number known when the model is read.
    pub(crate) const fn number(what: &'static str) -> Self {
        Context {
            what,
            coordinates: None,
            time: false,
            parameters: false,
            characteristics: false,
            displacements: false,
            multipliers: false,
            masses: false,
            masses_as_symbols: false,
            hint: "",
        }
    }
}

/// A derivative of a definition, and what occurs in it.
#[derive(Clone, Debug)]
pub(crate) struct Contents {
    value: Expr,
    /// The highest derivative of a coordinate, with its symbol.
    highest: Option<(u32, String)>,
    /// A parameter.
    parameter: Option<String>,
    /// The time or a control.
    time: Option<String>,
    /// A mass with a law of its own.
    mass: Option<String>,
    /// A multiplier, and whether it is differentiated.
    multiplier: Option<(String, bool)>,
}

/// A context with the names of a model; remembers which definitions were wanted before they were known.
pub(crate) struct ModelScope<'r> {
    pub(crate) resolver: &'r Resolver,
    pub(crate) context: Context,
    pub(crate) wanted: RefCell<Vec<usize>>,
}

fn refused(code: &'static str, message: String, hint: impl Into<String>) -> Resolution {
    Resolution::Refused {
        code,
        message,
        hint: hint.into(),
    }
}

impl ModelScope<'_> {
    /// Whether this names the virtual displacement of a coordinate, where one may occur.
    fn is_displacement(&self, name: &str) -> bool {
        let coordinate = name.strip_prefix(DISPLACEMENT);
        self.context.displacements
            && coordinate.is_some_and(|name| {
                let known = self.resolver.names.get(name);
                known.is_some_and(|named| named.kind == NamedKind::Coordinate)
            })
    }

    fn varying(&self, name: &str, order: u32, word: &str) -> Resolution {
        let Context {
            what,
            coordinates,
            time,
            hint,
            ..
        } = self.context;
        let allowed = if word == "control" {
            time.then_some(u32::MAX)
        } else {
            coordinates
        };
        match allowed {
            None if time => refused(
                "not-of-time",
                format!(
                    "the {word} `{name}` may not occur in {what}, which is a function of the time"
                ),
                hint,
            ),
            None => refused(
                "not-constant",
                format!("the {word} `{name}` may not occur in {what}, which is constant"),
                hint,
            ),
            Some(most) if order > most => {
                let primes = "'".repeat(order as usize);
                refused(
                    "order-too-high",
                    format!("`{name}{primes}` may not occur in {what}"),
                    if hint.is_empty() {
                        "only first derivatives may occur there"
                    } else {
                        hint
                    },
                )
            }
            Some(_) => Resolution::Known(self.resolver.graph.symbol(name, order)),
        }
    }

    fn defined(&self, name: &str, number: usize, order: u32) -> Resolution {
        let resolver = self.resolver;
        let define = &resolver.defines[number];
        let Context {
            what,
            coordinates,
            hint,
            ..
        } = self.context;
        if define.kind == DefineKind::FrameVelocity && coordinates == Some(0) {
            let message = format!("`{name}` is a quasi-velocity and may not occur in {what}");
            return refused("not-allowed-here", message, hint);
        }
        let as_symbols = self.context.masses_as_symbols;
        if as_symbols && order == 0 && define.kind == DefineKind::Mass {
            return Resolution::Known(resolver.graph.symbol(name, 0));
        }
        let value = match define.state {
            State::Known(_) if as_symbols && define.by_masses.is_some() => {
                return self.defined_by_masses(define.by_masses, order);
            }
            State::Known(value) => value,
            State::Failed => return Resolution::Failed,
            State::Open => {
                self.wanted.borrow_mut().push(number);
                return Resolution::Failed;
            }
        };
        if order > MOST_DERIVATIVES {
            return refused(
                "order-too-high",
                format!("derivatives of a definition are taken up to order {MOST_DERIVATIVES}"),
                "",
            );
        }
        if order > 0 {
            if let Some(unknown) = self.unknown_rates(value) {
                return unknown;
            }
        }
        let contents = self.contents(number, value, order);
        match self.forbidden(&contents) {
            None => Resolution::Known(contents.value),
            Some(inner) => {
                let primes = "'".repeat(order as usize);
                let message =
                    format!("`{name}{primes}` contains `{inner}`, which may not occur in {what}");
                refused("not-allowed-here", message, hint)
            }
        }
    }

    /// A definition, or a derivative of it, with named masses as symbols; what may not occur was found before.
    fn defined_by_masses(&self, value: Option<Expr>, order: u32) -> Resolution {
        let derived = value
            .map(|value| (0..order).fold(value, |value, _| self.resolver.total_derivative(value)));
        derived.map_or(Resolution::Failed, Resolution::Known)
    }

    /// Where a derivative needs rates of masses that are not known yet, or never will be.
    fn unknown_rates(&self, value: Expr) -> Option<Resolution> {
        let resolver = self.resolver;
        let mut unknown = None;
        for law in resolver.laws_in(value) {
            match resolver.defines[law].state {
                State::Known(_) => {}
                State::Failed => unknown = Some(Resolution::Failed),
                State::Open => {
                    self.wanted.borrow_mut().push(law);
                    unknown = Some(Resolution::Failed);
                }
            }
        }
        unknown
    }

    /// A mass with a law of its own: a state, whose derivatives are those of its rate.
    fn mass(&self, name: &str, law: usize, order: u32) -> Resolution {
        let Context {
            what,
            hint,
            coordinates,
            masses,
            ..
        } = self.context;
        if let Some(lower) = order.checked_sub(1) {
            return self.defined(name, law, lower);
        }
        if masses {
            return Resolution::Known(self.resolver.graph.symbol(name, 0));
        }
        let message = match coordinates {
            None => format!("the mass `{name}` may not occur in {what}, which is constant"),
            Some(_) => {
                format!("the mass `{name}` has a law of its own and may not occur in {what}")
            }
        };
        refused("not-allowed-here", message, hint)
    }

    /// The derivative of a definition with an example of each kind of symbol in it. Both cost time in proportion to
    /// the definition, so they are kept.
    fn contents(&self, number: usize, value: Expr, order: u32) -> Contents {
        let resolver = self.resolver;
        if let Some(known) = resolver.contents.borrow().get(&(number, order)) {
            return known.clone();
        }
        let graph = &resolver.graph;
        let value = match order.checked_sub(1) {
            None => value,
            Some(lower) => {
                let lower = self.contents(number, value, lower).value;
                resolver.total_derivative(lower)
            }
        };
        let mut contents = Contents {
            value,
            highest: None,
            parameter: None,
            time: None,
            mass: None,
            multiplier: None,
        };
        for symbol in graph.symbols_in(&[value]) {
            let place = match resolver
                .names
                .get(graph.symbol_name(symbol))
                .map(|named| named.kind)
            {
                Some(NamedKind::Coordinate) => {
                    let order = graph.symbol_order(symbol);
                    if contents
                        .highest
                        .as_ref()
                        .is_none_or(|(highest, _)| order > *highest)
                    {
                        contents.highest = Some((order, graph.symbol_text(symbol)));
                    }
                    continue;
                }
                Some(NamedKind::Parameter) => &mut contents.parameter,
                Some(NamedKind::Mass(_)) => &mut contents.mass,
                None if graph.symbol_name(symbol).starts_with(MULTIPLIER) => {
                    let is_rate = graph.symbol_order(symbol) > 0;
                    contents.multiplier = Some((graph.symbol_text(symbol), is_rate));
                    continue;
                }
                _ => &mut contents.time,
            };
            place.get_or_insert_with(|| graph.symbol_text(symbol));
        }
        resolver
            .contents
            .borrow_mut()
            .insert((number, order), contents.clone());
        contents
    }

    /// π/180.
    fn degree(&self) -> Expr {
        let g = &self.resolver.graph;
        g.div(g.pi(), g.integer(180))
    }

    /// A symbol that may not occur here.
    fn forbidden(&self, contents: &Contents) -> Option<String> {
        let Context {
            coordinates,
            time,
            parameters,
            masses,
            ..
        } = self.context;
        let high = contents
            .highest
            .as_ref()
            .filter(|(order, _)| coordinates.is_none_or(|most| *order > most));
        let parameter = contents.parameter.as_ref().filter(|_| !parameters);
        let timely = contents.time.as_ref().filter(|_| !time);
        let mass = contents.mass.as_ref().filter(|_| !masses);
        let multiplier = contents.multiplier.as_ref();
        let multiplier = multiplier.filter(|(_, is_rate)| *is_rate || !self.context.multipliers);
        high.map(|(_, symbol)| symbol)
            .or(multiplier.map(|(symbol, _)| symbol))
            .or(parameter)
            .or(timely)
            .or(mass)
            .cloned()
    }
}

impl Scope for ModelScope<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        let resolver = self.resolver;
        if self.context.multipliers && order == 0 && name.starts_with(MULTIPLIER) {
            return Resolution::Known(resolver.graph.symbol(name, 0));
        }
        if name == "t" {
            return match (self.context.time, order) {
                (true, 0) => Resolution::Known(resolver.graph.symbol("t", 0)),
                (false, _) => refused(
                    "not-constant",
                    format!(
                        "the time `t` may not occur in {}, which is constant",
                        self.context.what
                    ),
                    self.context.hint,
                ),
                _ => refused(
                    "derivative-of-constant",
                    "the time `t` has no derivative".to_owned(),
                    "",
                ),
            };
        }
        if resolver.names.contains_key(name) && self.context.what != "an assumption" {
            resolver.used.borrow_mut().insert(name.to_owned());
        }
        match resolver.names.get(name).map(|named| named.kind) {
            None if self.is_displacement(name) => {
                Resolution::Known(resolver.graph.symbol(name, order))
            }
            None if resolver.unknowns.iter().any(|own| own == name) => match order {
                0 => Resolution::Known(resolver.graph.symbol(name, 0)),
                _ => refused(
                    "order-too-high",
                    format!("`{name}` is an unknown of these equations, which has no derivative there"),
                    "a quantity with a derivative is a function of the state: state it under [define]",
                ),
            },
            // Angles are in radians, and a number of degrees is one.
            None if is_degree(name) && order == 0 => Resolution::Known(self.degree()),
            None => Resolution::Unknown,
            Some(NamedKind::Coordinate) => self.varying(name, order, "coordinate"),
            Some(NamedKind::Control) => self.varying(name, order, "control"),
            Some(NamedKind::Define(number)) => self.defined(name, number, order),
            Some(NamedKind::Characteristic) if self.context.characteristics && order == 0 => {
                Resolution::Known(resolver.graph.symbol(name, 0))
            }
            Some(NamedKind::Characteristic) => refused(
                "not-allowed-here",
                format!("`{name}` is a parameter of the characteristics and may not occur in {}", self.context.what),
                "it occurs in the formulas of [characteristics] only, without primes",
            ),
            Some(NamedKind::Mass(law)) => self.mass(name, law, order),
            Some(NamedKind::Size(value)) if order == 0 => Resolution::Known(resolver.graph.integer(value)),
            Some(NamedKind::Size(_)) => {
                refused("derivative-of-constant", format!("`{name}` is a size, an integer, and has no derivative"), "")
            }
            Some(NamedKind::Parameter) if order > 0 => refused(
                "derivative-of-parameter",
                format!("`{name}` is a parameter, a constant, and has no derivative"),
                format!("if `{name}` varies with the time, state it under [controls]; if it is unknown, under coordinates"),
            ),
            Some(NamedKind::Parameter) if !self.context.parameters => {
                refused("not-a-number", format!("the parameter `{name}` may not occur in {}", self.context.what), "")
            }
            Some(NamedKind::Parameter) => Resolution::Known(resolver.graph.symbol(name, 0)),
        }
    }

    fn names(&self) -> Vec<String> {
        if self.resolver.diagnostics.len() >= GUESSED {
            return Vec::new();
        }
        let rank = |kind: NamedKind| match kind {
            NamedKind::Coordinate => 0,
            NamedKind::Parameter => 1,
            NamedKind::Define(_) | NamedKind::Mass(_) => 2,
            NamedKind::Control => 3,
            NamedKind::Size(_) => 4,
            NamedKind::Characteristic => 5,
        };
        let mut names: Vec<(u8, &String)> = self
            .resolver
            .names
            .iter()
            .map(|(name, named)| (rank(named.kind), name))
            .collect();
        names.sort();
        names.into_iter().map(|(_, name)| name.clone()).collect()
    }
}

impl Resolver {
    /// The highest derivative of a coordinate in an expression; none where no coordinate occurs.
    pub(crate) fn order_of(&self, value: Expr) -> Option<u32> {
        let is_coordinate = |name: &str| {
            matches!(
                self.names.get(name).map(|named| named.kind),
                Some(NamedKind::Coordinate)
            )
        };
        let symbols = self.graph.symbols_in(&[value]);
        symbols
            .into_iter()
            .filter(|symbol| is_coordinate(self.graph.symbol_name(*symbol)))
            .map(|symbol| self.graph.symbol_order(symbol))
            .max()
    }
}
