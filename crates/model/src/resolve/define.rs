//! Named sub-expressions, in any order; circles among them are found and named.

use std::rc::Rc;

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::{parse_expression, Parsed};
use chetaev_symbolic::Expr;

use super::formula::{Expected, Formula};
use super::scope::{Context, NamedKind};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::model::Definition;
use crate::raw::{Kind, Raw, Table};
use crate::source::Place;
use crate::text::Text;
use crate::units::Unit;

/// What is known of a definition's value.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(crate) enum State {
    Open,
    Known(Expr),
    Failed,
}

/// Where a named expression comes from.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(crate) enum DefineKind {
    /// `[define]`.
    Definition,
    /// `[quasi_velocities]`.
    QuasiVelocity,
    /// `[moving_frame.fields]`; the value follows from all fields together.
    FrameVelocity,
    /// A definition that only bodies, joints and contacts name.
    Object,
    /// A quantity in `[sensors]`.
    Sensor,
    /// A value in `[masses]`.
    Mass,
    /// A rate in `[masses]`; called like the derivative of its mass.
    MassRate,
}

impl DefineKind {
    fn word(self) -> &'static str {
        match self {
            DefineKind::Definition | DefineKind::Object => "a definition",
            DefineKind::Sensor => "a sensor",
            DefineKind::Mass => "a mass",
            DefineKind::MassRate => "the rate of a mass",
            _ => "a quasi-velocity",
        }
    }
}

/// A named expression while the model is being read.
#[derive(Clone, Debug)]
pub(crate) struct Define {
    pub(crate) name: String,
    pub(crate) kind: DefineKind,
    pub(crate) text: Text,
    pub(crate) parsed: Rc<Parsed>,
    pub(crate) bindings: Bindings,
    pub(crate) unit: Option<Unit>,
    pub(crate) description: String,
    pub(crate) place: Place,
    pub(crate) state: State,
    /// The value with all named masses as symbols, where masses are named by definitions.
    pub(crate) by_masses: Option<Expr>,
    /// Order in which it was resolved: after everything that it uses.
    pub(crate) rank: usize,
}

impl Define {
    /// Whether it is a quasi-velocity.
    pub(crate) fn is_quasi_velocity(&self) -> bool {
        matches!(
            self.kind,
            DefineKind::QuasiVelocity | DefineKind::FrameVelocity
        )
    }

    /// The public form, where it has a value.
    pub(crate) fn definition(&self) -> Option<Definition> {
        match self.state {
            State::Known(value) => Some(Definition {
                name: self.name.clone(),
                value,
                text: self.text.content.clone(),
                description: self.description.clone(),
                place: self.place,
            }),
            _ => None,
        }
    }
}

impl Resolver {
    pub(crate) fn declare_defines(&mut self, root: &Table) {
        for (section, kind) in [
            ("define", DefineKind::Definition),
            ("quasi_velocities", DefineKind::QuasiVelocity),
            ("sensors", DefineKind::Sensor),
        ] {
            let Some(table) = self.section(root, section) else {
                continue;
            };
            for (key, raw) in &table.entries {
                self.declare_define(key, raw, kind);
            }
        }
    }

    pub(crate) fn declare_define(&mut self, key: &Text, raw: &Raw, kind: DefineKind) {
        let what = kind.word();
        let mut unit = None;
        let mut description = String::new();
        let mut value = Some(raw);
        if let Kind::Table(table) = &raw.kind {
            if kind != DefineKind::Mass {
                self.known_keys(
                    table,
                    &["value", "unit", "description", "latex"],
                    &format!("of {what}"),
                );
                self.symbol(key, table);
            }
            (unit, description) = self.unit_and_description(table);
            value = table.get("value");
        }
        let Some(value) = value else {
            self.push(Diagnostic::error(
                "missing-value",
                raw.place,
                format!("{what} needs its `value`"),
            ));
            return;
        };
        let text = self.expression_text(value, what);
        let parsed = text.as_ref().map(|text| self.parse(text, parse_expression));
        for instance in self.instances(key, what, &[]) {
            if instance.order > 0 {
                let message = format!("`{}` has a prime and cannot name {what}", key.content);
                self.push(Diagnostic::error("bad-name", key.place, message));
                return;
            }
            let number = self.defines.len();
            if !self.declare(key, &instance.name, NamedKind::Define(number)) {
                continue;
            }
            let state = match &parsed {
                Some(parsed) if !parsed.has_errors() => State::Open,
                _ => State::Failed,
            };
            self.defines.push(Define {
                name: instance.name,
                kind,
                text: text.clone().unwrap_or_else(|| key.clone()),
                parsed: parsed
                    .clone()
                    .unwrap_or_else(|| Rc::new(parse_expression("0"))),
                bindings: instance.bindings,
                unit: unit.clone(),
                description: description.clone(),
                place: key.place,
                state,
                by_masses: None,
                rank: 0,
            });
        }
    }

    /// Gives every definition its value. A definition that needs others is put aside until they are known; the stack
    /// of those put aside is the chain of needs, so that a need inside the chain is a circle.
    pub(crate) fn resolve_defines(&mut self) {
        let mut rank = 0;
        for first in 0..self.defines.len() {
            let mut chain = vec![first];
            while let Some(&number) = chain.last() {
                if self.defines[number].state != State::Open {
                    chain.pop();
                    continue;
                }
                let wanted = self.resolve_define(number, &mut rank);
                if let Some(circular) = wanted.iter().find(|wanted| chain.contains(wanted)) {
                    let start = chain.iter().position(|own| own == circular).unwrap_or(0);
                    self.circle(&chain[start..]);
                    for own in chain.drain(start..) {
                        self.defines[own].state = State::Failed;
                    }
                    continue;
                }
                if !wanted.is_empty() {
                    // One at a time keeps the stack a chain; each is asked for at most once more.
                    chain.push(wanted[0]);
                }
            }
        }
    }

    /// Gives a definition its value, or says which others it needs first.
    fn resolve_define(&mut self, number: usize, rank: &mut usize) -> Vec<usize> {
        let Define {
            text,
            parsed,
            bindings,
            kind,
            ..
        } = self.defines[number].clone();
        let context = match kind {
            DefineKind::Definition | DefineKind::Object => Context::jet("a definition"),
            DefineKind::QuasiVelocity => Context::state("a quasi-velocity").without_masses(),
            DefineKind::Sensor => Context::motion("a sensor"),
            DefineKind::Mass => Context::state("a mass"),
            DefineKind::MassRate => Context::state("the rate of a mass"),
            DefineKind::FrameVelocity => return self.resolve_frame(rank),
        };
        let (value, wanted) = self.lower_wanting(&text, &parsed, parsed.root(), &bindings, context);
        if !wanted.is_empty() {
            return wanted;
        }
        *rank += 1;
        self.defines[number].rank = *rank;
        self.defines[number].state = value.map_or(State::Failed, State::Known);
        if value.is_some() {
            if self.has_named_values() {
                let context = context.with_masses_as_symbols();
                let root = parsed.root();
                self.defines[number].by_masses =
                    self.lower(&text, &parsed, root, &bindings, context);
            }
            let (expected, define) = self.expected_of_define(number, kind);
            self.formulas.push(Formula {
                text,
                parsed,
                bindings,
                expected,
                define,
            });
        }
        Vec::new()
    }

    /// The dimension of a rate is that of its mass over the time; that of a definition is its own.
    fn expected_of_define(&self, number: usize, kind: DefineKind) -> (Expected, Option<usize>) {
        let mass = self.masses.iter().find(|mass| mass.define == number);
        match (kind, mass) {
            (DefineKind::MassRate, Some(mass)) => (Expected::Quantity(mass.name.clone(), 1), None),
            _ => (Expected::Anything, Some(number)),
        }
    }

    fn circle(&mut self, members: &[usize]) {
        let names: Vec<String> = members
            .iter()
            .map(|at| format!("`{}`", self.defines[*at].name))
            .collect();
        let message = match names.as_slice() {
            [one] => format!("the definition of {one} needs {one} itself"),
            many => format!("the definitions of {} need each other", joined(many)),
        };
        let mut diagnostic = Diagnostic::error(
            "circular-definition",
            self.defines[members[0]].place,
            message,
        );
        for (at, name) in members.iter().zip(&names).skip(1) {
            diagnostic = diagnostic.related(
                self.defines[*at].place,
                format!("{name} belongs to the circle"),
            );
        }
        self.push(diagnostic);
    }
}

/// `a`, `a and b`, `a, b and c`.
pub(crate) fn joined(words: &[String]) -> String {
    match words {
        [] => String::new(),
        [one] => one.clone(),
        [all @ .., last] => format!("{} and {last}", all.join(", ")),
    }
}

/// Numbers ordered so that each comes after those it uses, and the circles that prevent this.
pub(crate) struct DependencyOrder {
    pub(crate) sorted: Vec<usize>,
    pub(crate) circles: Vec<Vec<usize>>,
}

/// Depth-first order with an explicit stack; the members of circles are left out of it.
pub(crate) fn dependency_order(uses: &[Vec<usize>]) -> DependencyOrder {
    #[derive(Copy, Clone, PartialEq)]
    enum Mark {
        New,
        OnPath,
        Done,
        Circular,
    }
    let mut marks = vec![Mark::New; uses.len()];
    let mut order = DependencyOrder {
        sorted: Vec::new(),
        circles: Vec::new(),
    };
    for first in 0..uses.len() {
        if marks[first] != Mark::New {
            continue;
        }
        let mut path = vec![(first, 0)];
        marks[first] = Mark::OnPath;
        while let Some((at, next)) = path.last_mut() {
            let at = *at;
            let Some(&used) = uses[at].get(*next) else {
                path.pop();
                if marks[at] == Mark::OnPath {
                    marks[at] = Mark::Done;
                    order.sorted.push(at);
                }
                continue;
            };
            *next += 1;
            match marks[used] {
                Mark::New => {
                    marks[used] = Mark::OnPath;
                    path.push((used, 0));
                }
                Mark::OnPath => {
                    let start = path.iter().position(|(own, _)| *own == used).unwrap_or(0);
                    let circle: Vec<usize> = path[start..].iter().map(|(own, _)| *own).collect();
                    for own in &circle {
                        marks[*own] = Mark::Circular;
                    }
                    order.circles.push(circle);
                }
                Mark::Done | Mark::Circular => {}
            }
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_puts_what_is_used_first_and_names_circles() {
        let order = dependency_order(&[vec![1, 2], vec![2], vec![], vec![4], vec![3], vec![5]]);
        assert_eq!(order.sorted, [2, 1, 0]);
        assert_eq!(order.circles, [vec![3, 4], vec![5]]);
        let long: Vec<Vec<usize>> = (0..100_000)
            .map(|i| if i + 1 < 100_000 { vec![i + 1] } else { vec![] })
            .collect();
        assert_eq!(dependency_order(&long).sorted.len(), 100_000);
    }
}
