//! Checks every expression by dimension, where the model states units.
//!
//! A quantity without a unit, and the number 0, fit everywhere. Nothing is inferred: a parameter without a unit gives
//! a warning, and what contains it is not checked.

mod expected;

use std::cell::RefCell;
use std::collections::BTreeMap;

use chetaev_symbolic::syntax::ast::{Binary, Node, NodeId};
use chetaev_symbolic::syntax::lower::{expand_name, Bindings};
use chetaev_symbolic::syntax::{lower, Builtin, Span, Tree};
use chetaev_symbolic::Rational;

use crate::diagnostic::Diagnostic;
use crate::resolve::advice::is_degree;
use crate::resolve::formula::Formula;
use crate::resolve::scope::{Context, ModelScope, NamedKind};
use crate::resolve::Resolver;
use crate::source::Place;
use crate::text::Text;
use crate::units::{Dimension, Unit};
use expected::{Checked, Decided};

/// The dimension of an expression, or none where it fits everywhere.
type Kind = Option<Dimension>;

/// Whether the model states units; if so, reports every expression whose parts do not fit together.
pub(crate) fn check(resolver: &mut Resolver) -> bool {
    let coordinates = resolver
        .coordinates
        .iter()
        .map(|own| (&own.name, &own.unit, own.place, "coordinate"));
    let parameters = resolver
        .parameters
        .iter()
        .map(|own| (&own.name, &own.unit, own.place, "parameter"));
    let controls = resolver
        .controls
        .iter()
        .map(|own| (&own.name, &own.unit, own.place, "control"));
    let masses = resolver
        .masses
        .iter()
        .filter(|own| own.has_law)
        .map(|own| (&own.name, &own.unit, own.place, "mass"));
    let all: Vec<(String, bool, Place, &str)> = coordinates
        .chain(parameters)
        .chain(controls)
        .chain(masses)
        .map(|(name, unit, place, what)| (name.clone(), unit.is_some(), place, what))
        .collect();
    if !all.iter().any(|(_, stated, ..)| *stated)
        && resolver.defines.iter().all(|define| define.unit.is_none())
    {
        return false;
    }
    let mut missing: Vec<(String, Place, &str)> = Vec::new();
    for (name, stated, place, what) in all {
        let excused = resolver.without_blame.contains(&place);
        let is_known = missing.iter().any(|known| known.1 == place);
        if !(stated || excused || is_known) {
            missing.push((name, place, what));
        }
    }
    warn_of_missing(resolver, &missing);
    let formulas = std::mem::take(&mut resolver.formulas);
    let mut checker = Checker {
        defines: vec![None; resolver.defines.len()],
        energy: None,
        mass: None,
        length: None,
        speeds: BTreeMap::new(),
        found: Vec::new(),
        resolver,
    };
    for formula in &formulas {
        checker.formula(formula);
    }
    let Checker { found, .. } = checker;
    for diagnostic in found {
        resolver.push(diagnostic);
    }
    true
}

/// Names that are listed where many quantities have no unit.
const LISTED: usize = 12;

/// One warning of all quantities without a unit, at the first of them.
fn warn_of_missing(resolver: &mut Resolver, missing: &[(String, Place, &str)]) {
    let Some((name, place, what)) = missing.first() else {
        return;
    };
    let message = match missing.len() {
        1 => format!("the {what} `{name}` has no unit, while others have"),
        n => {
            let names = missing.iter().take(LISTED);
            let names: Vec<String> = names.map(|own| format!("`{}`", own.0)).collect();
            let rest = if n > LISTED { ", …" } else { "" };
            format!(
                "{n} quantities have no unit, while others have: {}{rest}",
                names.join(", ")
            )
        }
    };
    let hint = "what contains them is not checked; write unit = \"1\" for a pure number";
    resolver.push(Diagnostic::warning("missing-unit", *place, message).hint(hint));
}

struct Checker<'r> {
    resolver: &'r Resolver,
    /// What is known of the definitions; each is checked before it is used.
    defines: Vec<Kind>,
    /// The dimension of the Lagrangian.
    energy: Option<Decided>,
    /// The dimension of masses.
    mass: Option<Decided>,
    /// The dimension of lengths.
    length: Option<Decided>,
    /// Where the components of fields decided for their quasi-velocities, by number of the definition.
    speeds: BTreeMap<usize, Decided>,
    found: Vec<Diagnostic>,
}

/// What is known of one node.
#[derive(Clone, Default)]
struct Known {
    kind: Kind,
    /// Its value, where it is a number.
    value: Option<Rational>,
}

impl Checker<'_> {
    fn formula(&mut self, formula: &Formula) {
        let Formula {
            text,
            parsed,
            bindings,
            expected,
            define,
        } = formula;
        let tree = &parsed.tree;
        let bindings = self.with_sums(tree, bindings);
        let mut known: Vec<Known> = Vec::with_capacity(tree.len());
        let mut bare = true;
        for (id, node) in tree.iter() {
            let own = self.node(id, node, tree, text, &known, &bindings);
            bare &= !matches!(node, Node::Name { .. })
                || own.value.is_some()
                || tree.plain_name(id) == Some(("pi", 0));
            known.push(own);
        }
        let sides: Vec<(Kind, Place)> = parsed
            .sides
            .iter()
            .zip(&parsed.side_spans)
            .map(|(side, span)| (known[side.index()].kind.clone(), text.place_of(*span)))
            .collect();
        let (kind, place) = sides[0].clone();
        if let Some(number) = define {
            self.definition(*number, kind, place);
            return;
        }
        let checked = Checked {
            kind,
            place,
            bare,
            sides: &sides,
        };
        self.expectation(expected, &checked);
    }

    fn definition(&mut self, number: usize, kind: Kind, place: Place) {
        let define = &self.resolver.defines[number];
        let stated = define.unit.as_ref().map(|unit| unit.dimension.clone());
        if let (Some(stated), Some(kind)) = (&stated, &kind) {
            if kind != stated {
                // What uses it has its say only when this is settled.
                self.compare(
                    kind,
                    stated,
                    place,
                    &format!("`{}` is said to have the dimension", define.name),
                );
                return;
            }
        }
        self.defines[number] = stated.or(kind);
    }

    fn unit_of(&self, name: &str) -> Option<&Unit> {
        let resolver = self.resolver;
        let coordinate = resolver
            .coordinates
            .iter()
            .find(|own| own.name == name)
            .and_then(|own| own.unit.as_ref());
        let parameter = || {
            resolver
                .parameters
                .iter()
                .find(|own| own.name == name)
                .and_then(|own| own.unit.as_ref())
        };
        let control = || {
            resolver
                .controls
                .iter()
                .find(|own| own.name == name)
                .and_then(|own| own.unit.as_ref())
        };
        let mass = || {
            let named = resolver.masses.iter();
            let mut own = named.filter(|own| own.has_law && own.name == name);
            own.next().and_then(|own| own.unit.as_ref())
        };
        coordinate.or_else(parameter).or_else(control).or_else(mass)
    }

    /// The indices of sums get their first values: all terms of a sum have one dimension if the model makes sense.
    fn with_sums(&self, tree: &Tree, bindings: &Bindings) -> Bindings {
        let mut all = bindings.clone();
        let sums: Vec<(&String, NodeId)> = tree
            .iter()
            .filter_map(|(_, node)| match node {
                Node::Sum { index, from, .. } => Some((index, *from)),
                _ => None,
            })
            .collect();
        // Outer sums come later in the tree, and inner ranges may use their indices.
        for (index, from) in sums.into_iter().rev() {
            let first = lower(
                &self.resolver.graph,
                tree,
                from,
                &self.scope(),
                &all,
                &mut Vec::new(),
            );
            let first = first.and_then(|value| self.resolver.graph.as_integer(value));
            all.push((index.clone(), first.unwrap_or(1)));
        }
        all
    }

    fn scope(&self) -> ModelScope<'_> {
        ModelScope {
            resolver: self.resolver,
            context: Context::number("an index"),
            wanted: RefCell::new(Vec::new()),
        }
    }

    fn node(
        &mut self,
        id: NodeId,
        node: &Node,
        tree: &Tree,
        text: &Text,
        known: &[Known],
        bindings: &Bindings,
    ) -> Known {
        let of = |id: NodeId| known[id.index()].clone();
        let valued = |kind: Kind| Known { kind, value: None };
        match node {
            Node::Number(value) => Known {
                kind: (!value.is_zero()).then(Dimension::none),
                value: Some(value.clone()),
            },
            Node::Name { order, .. } => self.name(id, *order, tree, bindings),
            Node::Negate(operand) => {
                let own = of(*operand);
                Known {
                    value: own.value.map(|value| -value),
                    kind: own.kind,
                }
            }
            Node::Binary {
                operation,
                left,
                right,
            } => {
                let spans = (tree.span(*left), tree.span(*right));
                self.binary(*operation, of(*left), of(*right), spans, text)
            }
            Node::Call {
                function,
                arguments,
                power,
            } => {
                let kind = self.call(*function, arguments, tree, text, known);
                valued(match power {
                    Some(power) => kind.map(|kind| kind.power(power)),
                    None => kind,
                })
            }
            Node::Sum { body, .. } => valued(of(*body).kind),
            Node::Error => Known::default(),
        }
    }

    fn binary(
        &mut self,
        operation: Binary,
        a: Known,
        b: Known,
        spans: (Span, Span),
        text: &Text,
    ) -> Known {
        match operation {
            Binary::Add => Known {
                kind: self.sum(&a.kind, &b.kind, spans, text),
                value: both(a.value, b.value, |a, b| a + b),
            },
            Binary::Subtract => Known {
                kind: self.sum(&a.kind, &b.kind, spans, text),
                value: both(a.value, b.value, |a, b| a - b),
            },
            Binary::Multiply => Known {
                kind: both(a.kind, b.kind, |a, b| a.times(&b)),
                value: both(a.value, b.value, |a, b| a * b),
            },
            Binary::Divide => Known {
                kind: both(a.kind, b.kind, |a, b| a.over(&b)),
                value: both(a.value, b.value.filter(|value| !value.is_zero()), |a, b| {
                    a / b
                }),
            },
            Binary::Power => Known {
                kind: self.power(&a, &b, spans.1, text),
                value: None,
            },
        }
    }

    fn name(&self, id: NodeId, order: u32, tree: &Tree, bindings: &Bindings) -> Known {
        let resolver = self.resolver;
        let Some((name, _)) = expand_name(
            &resolver.graph,
            tree,
            id,
            &self.scope(),
            bindings,
            &mut Vec::new(),
        ) else {
            return Known::default();
        };
        let number = |value: i64| Known {
            kind: Some(Dimension::none()),
            value: Some(Rational::from(value)),
        };
        if let Some((_, value)) = bindings.iter().rev().find(|(index, _)| *index == name) {
            return number(*value);
        }
        let kind = match (
            name.as_str(),
            resolver.names.get(&name).map(|named| named.kind),
        ) {
            ("pi", _) => Some(Dimension::none()),
            ("t", _) => Some(Dimension::time()),
            (degree, None) if is_degree(degree) => Some(Dimension::none()),
            (_, Some(NamedKind::Size(value))) => return number(value),
            (_, Some(NamedKind::Define(number))) => self.defines.get(number).cloned().flatten(),
            _ => self.unit_of(&name).map(|unit| unit.dimension.clone()),
        };
        Known {
            kind: kind.map(|kind| over_time(kind, order)),
            value: None,
        }
    }

    fn sum(&mut self, a: &Kind, b: &Kind, spans: (Span, Span), text: &Text) -> Kind {
        let (Some(left), Some(right)) = (a, b) else {
            return a.clone().or_else(|| b.clone());
        };
        if left != right {
            let message = format!("terms of different dimension, {left} and {right}");
            let diagnostic =
                mismatch(text.place_of(spans.1), message).label(format!("this has {right}"));
            self.found
                .push(diagnostic.related(text.place_of(spans.0), format!("this has {left}")));
            return None;
        }
        a.clone()
    }

    fn power(&mut self, base: &Known, exponent: &Known, span: Span, text: &Text) -> Kind {
        if let Some(kind) = exponent.kind.as_ref().filter(|kind| !kind.is_none()) {
            let message =
                format!("an exponent is a pure number, and this has the dimension {kind}");
            self.found.push(mismatch(text.place_of(span), message));
            return None;
        }
        let kind = base.kind.as_ref()?;
        if kind.is_none() {
            return Some(kind.clone());
        }
        if let Some(value) = &exponent.value {
            return Some(kind.power(value));
        }
        let message = format!(
            "a quantity with the dimension {kind} is raised to a power that is not a number"
        );
        self.found.push(mismatch(text.place_of(span), message));
        None
    }

    fn call(
        &mut self,
        function: Builtin,
        arguments: &[NodeId],
        tree: &Tree,
        text: &Text,
        known: &[Known],
    ) -> Kind {
        let kinds: Vec<&Kind> = arguments
            .iter()
            .map(|argument| &known[argument.index()].kind)
            .collect();
        match function {
            Builtin::Sqrt => kinds[0]
                .as_ref()
                .map(|kind| kind.power(&(Rational::ONE / Rational::from(2)))),
            Builtin::Abs => kinds[0].clone(),
            Builtin::Sign => Some(Dimension::none()),
            Builtin::Atan2 => {
                let spans = (tree.span(arguments[0]), tree.span(arguments[1]));
                self.sum(kinds[0], kinds[1], spans, text);
                Some(Dimension::none())
            }
            _ => {
                if let Some(kind) = kinds[0].as_ref().filter(|kind| !kind.is_none()) {
                    let message = format!(
                        "the argument of `{}` is a pure number, and this has the dimension {kind}",
                        function.name()
                    );
                    let diagnostic = mismatch(text.place_of(tree.span(arguments[0])), message)
                        .label(format!("this has {kind}"));
                    self.found.push(diagnostic);
                }
                Some(Dimension::none())
            }
        }
    }
}

fn mismatch(place: Place, message: String) -> Diagnostic {
    Diagnostic::error("dimension-mismatch", place, message)
}

/// The dimension of the derivative of some order.
fn over_time(kind: Dimension, order: u32) -> Dimension {
    match order {
        0 => kind,
        _ => kind.over(&Dimension::time().power(&Rational::from(order))),
    }
}

fn both<T, U>(a: Option<T>, b: Option<T>, combine: impl FnOnce(T, T) -> U) -> Option<U> {
    Some(combine(a?, b?))
}
