//! Expressions: parsed once, lowered for each value of their indices, kept for the check of dimensions.

use std::cell::RefCell;
use std::rc::Rc;

use chetaev_symbolic::syntax::lower::Bindings;
use chetaev_symbolic::syntax::{self, lower, NodeId, Parsed};
use chetaev_symbolic::{Expr, Rational};

use super::advice::improved;
use super::scope::{Context, ModelScope};
use super::Resolver;
use crate::diagnostic::Diagnostic;
use crate::raw::{Kind, Raw};
use crate::text::Text;

/// What the dimension of an expression must be.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expected {
    /// Any dimension, as long as its own sums are of one kind.
    Anything,
    /// The same dimension on all sides of the relation.
    EqualSides,
    /// That of the named quantity's derivative of this order, where a bare number stands for a value in its unit.
    Quantity(String, u32),
    /// That of the Lagrangian.
    Energy,
    /// That of the Lagrangian divided by a coordinate.
    Force(String),
    /// That of the Lagrangian divided by the time.
    Power,
    /// That of masses: the first one decides for the others.
    Mass,
    /// That of lengths: the first one decides for the others; with the masses and the time it decides for the energy.
    Length,
    /// That of a mass times a length over the square of the time.
    ForceOnParticle,
    /// That of a length over the time.
    VelocityOfParticle,
    /// That of the coordinate's velocity over that of the quasi-velocity, which the first component decides.
    FieldComponent {
        /// The quasi-velocity, by its number among the definitions.
        define: usize,
        /// The coordinate.
        coordinate: String,
    },
    /// That of the time, where a bare number stands for seconds.
    Time,
    /// A pure number.
    Number,
}

/// An expression with all that is needed to look at it again.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    pub(crate) text: Text,
    pub(crate) parsed: Rc<Parsed>,
    pub(crate) bindings: Bindings,
    pub(crate) expected: Expected,
    /// The definition that this is, by number.
    pub(crate) define: Option<usize>,
}

/// Suggestions of so many problems of one text are tried.
const CHECKED: usize = 20;

/// What may be done about a name that nothing is called.
pub(crate) const UNDECLARED: &str = "state a constant under [parameters], as in m = 1, what moves under coordinates, and an abbreviation under [define]";

/// The diagnostic with its suggestion only where the text with it carried out `is_good`.
fn checked(
    diagnostic: &syntax::Diagnostic,
    text: &Text,
    is_good: impl FnOnce(&str) -> bool,
) -> syntax::Diagnostic {
    let mut diagnostic = diagnostic.clone();
    let Some(suggestion) = &diagnostic.suggestion else {
        return diagnostic;
    };
    let (span, content) = (suggestion.span, &text.content);
    let parts = (content.get(..span.start), content.get(span.end..));
    let good = match parts {
        (Some(before), Some(after)) => {
            is_good(&format!("{before}{}{after}", suggestion.replacement))
        }
        _ => false,
    };
    if !good {
        // The sentence that goes with it would mislead as much.
        diagnostic.suggestion = None;
        diagnostic
            .hints
            .retain(|hint| !hint.starts_with("did you mean") && !hint.starts_with("write `"));
    }
    diagnostic
}

impl Resolver {
    /// Parses a text and reports what is wrong with it.
    pub(crate) fn parse(&mut self, text: &Text, parser: fn(&str) -> Parsed) -> Rc<Parsed> {
        let parsed = parser(&text.content);
        let errors = |parsed: &Parsed| parsed.diagnostics.iter().filter(|d| d.is_error()).count();
        let known = |name: &str| self.names.contains_key(name);
        let of_others = (parsed.diagnostics.iter()).map(|d| improved(d, &text.content, &known));
        let found: Vec<syntax::Diagnostic> = of_others.collect();
        for diagnostic in &found {
            let diagnostic = checked(diagnostic, text, |written| {
                let again = parser(written);
                errors(&again) < errors(&parsed) || !diagnostic.is_error() && !again.has_errors()
            });
            self.push(Diagnostic::of_expression(&diagnostic, text));
        }
        Rc::new(parsed)
    }

    /// Lowers one side, reporting what is wrong; also returns the definitions that were wanted too early.
    pub(crate) fn lower_wanting(
        &mut self,
        text: &Text,
        parsed: &Parsed,
        side: NodeId,
        bindings: &Bindings,
        context: Context,
    ) -> (Option<Expr>, Vec<usize>) {
        let mut found = Vec::new();
        let scope = ModelScope {
            resolver: self,
            context,
            wanted: RefCell::new(Vec::new()),
        };
        let value = lower(
            &self.graph,
            &parsed.tree,
            side,
            &scope,
            bindings,
            &mut found,
        );
        let wanted = scope.wanted.into_inner();
        if wanted.is_empty() {
            let place = parsed.sides.iter().position(|own| *own == side);
            let before = found.len();
            let known = |name: &str| self.names.contains_key(name);
            let of_others = found.iter().map(|d| improved(d, &text.content, &known));
            let found: Vec<syntax::Diagnostic> = of_others.collect();
            let diagnostics: Vec<_> = found
                .iter()
                .take(CHECKED)
                .map(|diagnostic| {
                    checked(diagnostic, text, |written| {
                        self.reads_better(written, place, bindings, context, before)
                    })
                })
                .chain(found.iter().skip(CHECKED).cloned())
                .collect();
            for diagnostic in &diagnostics {
                let mut own = Diagnostic::of_expression(diagnostic, text);
                if own.code == "unknown-name" && own.hints.is_empty() {
                    own = own.hint(UNDECLARED);
                }
                self.push(own);
            }
        }
        (value, wanted)
    }

    /// Whether a text with a suggestion carried out is read, and has fewer problems.
    fn reads_better(
        &self,
        written: &str,
        place: Option<usize>,
        bindings: &Bindings,
        context: Context,
        before: usize,
    ) -> bool {
        let again = chetaev_symbolic::syntax::parse_relation(written);
        let is_single = again.relations.is_empty();
        let errors = again.diagnostics.iter().filter(|d| d.is_error());
        // A single expression is no comparison, which is no matter here.
        if errors
            .filter(|d| !is_single || d.code != "missing-relation")
            .count()
            > 0
        {
            return false;
        }
        let Some(&side) = place.and_then(|place| again.sides.get(place)) else {
            return false;
        };
        let scope = ModelScope {
            resolver: self,
            context,
            wanted: RefCell::new(Vec::new()),
        };
        let mut found = Vec::new();
        let _ = lower(&self.graph, &again.tree, side, &scope, bindings, &mut found);
        found.len() < before
    }

    /// Lowers one side, reporting what is wrong.
    pub(crate) fn lower(
        &mut self,
        text: &Text,
        parsed: &Parsed,
        side: NodeId,
        bindings: &Bindings,
        context: Context,
    ) -> Option<Expr> {
        self.lower_wanting(text, parsed, side, bindings, context).0
    }

    /// Parses and lowers an expression.
    pub(crate) fn expression(
        &mut self,
        text: &Text,
        bindings: &Bindings,
        context: Context,
        expected: Expected,
    ) -> Option<Expr> {
        let parsed = self.parse(text, chetaev_symbolic::syntax::parse_expression);
        let value = self.lower(text, &parsed, parsed.root(), bindings, context);
        if value.is_some() && !parsed.has_errors() {
            self.formulas.push(Formula {
                text: text.clone(),
                parsed,
                bindings: bindings.clone(),
                expected,
                define: None,
            });
            return value;
        }
        None
    }

    /// The expression that a value is; a value of another kind is reported.
    pub(crate) fn expression_text(&mut self, raw: &Raw, what: &str) -> Option<Text> {
        let text = raw.expression().cloned();
        if text.is_none() {
            let message = format!("{what} must be an expression, not {}", raw.kind.word());
            let diagnostic = Diagnostic::error("wrong-kind", raw.place, message);
            self.push(match raw.kind {
                Kind::Array(_) => diagnostic
                    .hint("there are no tables of numbers: write a formula that fits them"),
                _ => diagnostic,
            });
        }
        text
    }

    /// An exact number, possibly stated by an expression such as `1/3` or `2^-40`.
    pub(crate) fn rational(&mut self, raw: &Raw, what: &'static str) -> Option<Rational> {
        let text = self.expression_text(raw, what)?;
        let value = self.expression(&text, &Vec::new(), Context::number(what), Expected::Number)?;
        let number = self.graph.as_number(value).cloned();
        if number.is_none() {
            self.push(Diagnostic::error(
                "not-a-number",
                raw.place,
                format!("{what} must be a rational number"),
            ));
        }
        number
    }

    /// An integer.
    pub(crate) fn integer(&mut self, raw: &Raw, what: &'static str) -> Option<i64> {
        let number = self.rational(raw, what)?;
        let whole = chetaev_symbolic::syntax::parse::integer_of(&number);
        if whole.is_none() {
            self.push(Diagnostic::error(
                "not-an-integer",
                raw.place,
                format!("{what} must be an integer"),
            ));
        }
        whole
    }
}
