//! Checks every expression by dimension, where the model states units.
//!
//! A quantity without a unit, and the number 0, fit everywhere. Nothing is inferred: a parameter without a unit gives
//! a warning, and what contains it is not checked.

use std::cell::RefCell;

use chetaev_symbolic::syntax::ast::{Binary, Node, NodeId};
use chetaev_symbolic::syntax::lower::{expand_name, Bindings};
use chetaev_symbolic::syntax::{lower, Builtin, Span, Tree};
use chetaev_symbolic::Rational;

use crate::diagnostic::Diagnostic;
use crate::resolve::formula::{Expected, Formula};
use crate::resolve::scope::{Context, ModelScope, NamedKind};
use crate::resolve::Resolver;
use crate::source::Place;
use crate::text::Text;
use crate::units::{Dimension, Unit};

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
    let all: Vec<(String, bool, Place, &str)> = coordinates
        .chain(parameters)
        .chain(controls)
        .map(|(name, unit, place, what)| (name.clone(), unit.is_some(), place, what))
        .collect();
    if !all.iter().any(|(_, stated, ..)| *stated)
        && resolver.defines.iter().all(|define| define.unit.is_none())
    {
        return false;
    }
    let mut warned: Vec<Place> = Vec::new();
    for (name, stated, place, what) in all {
        if stated || warned.contains(&place) {
            continue;
        }
        warned.push(place);
        let message = format!("the {what} `{name}` has no unit, while others have");
        let hint = "what contains it is not checked; write unit = \"1\" for a pure number";
        resolver.push(Diagnostic::warning("missing-unit", place, message).hint(hint));
    }
    let formulas = std::mem::take(&mut resolver.formulas);
    let mut checker = Checker {
        defines: vec![None; resolver.defines.len()],
        energy: None,
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

struct Checker<'r> {
    resolver: &'r Resolver,
    /// What is known of the definitions; each is checked before it is used.
    defines: Vec<Kind>,
    /// The dimension of the Lagrangian, and where it was found.
    energy: Option<(Dimension, Place)>,
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
        self.expectation(expected, kind, place, bare, &sides);
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

    fn expectation(
        &mut self,
        expected: &Expected,
        kind: Kind,
        place: Place,
        bare: bool,
        sides: &[(Kind, Place)],
    ) {
        match expected {
            Expected::Anything => {}
            Expected::EqualSides => self.equal_sides(sides),
            Expected::Quantity(name, order) => {
                let Some(unit) = self.unit_of(name).cloned() else {
                    return;
                };
                if bare {
                    return;
                }
                if *order == 0 && !unit.is_coherent() {
                    let message = format!(
                        "a value computed from other quantities is in SI base units, not in `{}`",
                        unit.text
                    );
                    self.found
                        .push(
                            Diagnostic::error("incoherent-unit", place, message).hint(format!(
                                "state the unit of `{name}` as \"{}\"",
                                unit.dimension
                            )),
                        );
                    return;
                }
                let wanted = over_time(unit.dimension, *order);
                let primes = "'".repeat(*order as usize);
                self.compare_kind(
                    &kind,
                    &wanted,
                    place,
                    &format!("`{name}{primes}` has the dimension"),
                );
            }
            Expected::Energy => {
                let Some(own) = kind else { return };
                match self.energy.clone() {
                    None => self.energy = Some((own, place)),
                    Some((energy, first)) if own != energy => {
                        let message = format!("this has the dimension {own}, and the rest of the Lagrangian has {energy}");
                        self.found.push(
                            mismatch(place, message).related(first, format!("this has {energy}")),
                        );
                    }
                    Some(_) => {}
                }
            }
            Expected::Force(coordinate) => {
                let (Some((energy, _)), Some(unit)) =
                    (self.energy.clone(), self.unit_of(coordinate))
                else {
                    return;
                };
                let wanted = energy.over(&unit.dimension);
                self.compare_kind(
                    &kind,
                    &wanted,
                    place,
                    &format!("the force on `{coordinate}` has the dimension of L/{coordinate},"),
                );
            }
            Expected::Power => {
                let Some((energy, _)) = self.energy.clone() else {
                    return;
                };
                let wanted = energy.over(&Dimension::time());
                self.compare_kind(
                    &kind,
                    &wanted,
                    place,
                    "Rayleigh's function has the dimension of L/t,",
                );
            }
            Expected::Time if !bare => {
                self.compare_kind(&kind, &Dimension::time(), place, "a time has the dimension")
            }
            Expected::Number if !bare => self.compare_kind(
                &kind,
                &Dimension::none(),
                place,
                "a pure number has the dimension",
            ),
            Expected::Time | Expected::Number => {}
        }
    }

    fn equal_sides(&mut self, sides: &[(Kind, Place)]) {
        let mut known = sides
            .iter()
            .filter_map(|(kind, place)| Some((kind.as_ref()?, *place)));
        let Some((first, first_place)) = known.next() else {
            return;
        };
        if let Some((other, place)) = known.find(|(kind, _)| *kind != first) {
            let message = format!("one side has the dimension {first}, the other {other}");
            self.found.push(
                mismatch(place, message)
                    .label(format!("this has {other}"))
                    .related(first_place, format!("this has {first}")),
            );
        }
    }

    fn compare_kind(&mut self, kind: &Kind, wanted: &Dimension, place: Place, words: &str) {
        if let Some(kind) = kind {
            self.compare(kind, wanted, place, words);
        }
    }

    fn compare(&mut self, kind: &Dimension, wanted: &Dimension, place: Place, words: &str) {
        if kind != wanted {
            self.found.push(
                mismatch(place, format!("{words} {wanted}, and this has {kind}"))
                    .label(format!("this has {kind}")),
            );
        }
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
        coordinate.or_else(parameter).or_else(control)
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
        let pure = Some(Dimension::none());
        match node {
            Node::Number(value) => {
                let kind = if value.is_zero() { None } else { pure };
                Known {
                    kind,
                    value: Some(value.clone()),
                }
            }
            Node::Name { order, .. } => self.name(id, *order, tree, bindings),
            Node::Negate(operand) => {
                let own = of(*operand);
                Known {
                    value: own.value.map(|value| -value),
                    kind: own.kind,
                }
            }
            Node::Binary {
                operation: operation @ (Binary::Add | Binary::Subtract),
                left,
                right,
            } => {
                let (a, b) = (of(*left), of(*right));
                let spans = (tree.span(*left), tree.span(*right));
                let kind = self.sum(&a.kind, &b.kind, spans, text);
                let value = both(a.value, b.value, |a, b| {
                    if *operation == Binary::Add {
                        a + b
                    } else {
                        a - b
                    }
                });
                Known { kind, value }
            }
            Node::Binary {
                operation: Binary::Multiply,
                left,
                right,
            } => {
                let (a, b) = (of(*left), of(*right));
                Known {
                    kind: both(a.kind, b.kind, |a, b| a.times(&b)),
                    value: both(a.value, b.value, |a, b| a * b),
                }
            }
            Node::Binary {
                operation: Binary::Divide,
                left,
                right,
            } => {
                let (a, b) = (of(*left), of(*right));
                let value = both(a.value, b.value.filter(|value| !value.is_zero()), |a, b| {
                    a / b
                });
                Known {
                    kind: both(a.kind, b.kind, |a, b| a.over(&b)),
                    value,
                }
            }
            Node::Binary {
                operation: Binary::Power,
                left,
                right,
            } => {
                let kind = self.power(&of(*left), &of(*right), tree.span(*right), text);
                Known { kind, value: None }
            }
            Node::Call {
                function,
                arguments,
                power,
            } => {
                let kind = self.call(*function, arguments, tree, text, known);
                let raised = |kind: Dimension| {
                    power
                        .as_ref()
                        .map_or(kind.clone(), |power| kind.power(power))
                };
                Known {
                    kind: kind.map(raised),
                    value: None,
                }
            }
            Node::Sum { body, .. } => Known {
                kind: of(*body).kind,
                value: None,
            },
            Node::Error => Known::default(),
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
    kind.over(&Dimension::time().power(&Rational::from(order)))
}

fn both<T, U>(a: Option<T>, b: Option<T>, combine: impl FnOnce(T, T) -> U) -> Option<U> {
    Some(combine(a?, b?))
}
