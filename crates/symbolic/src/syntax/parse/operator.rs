//! Where an operator is expected: operations by strength, implicit products.

use super::{FrameKind, Operand, Operator, Parser, State, MOST_DIAGNOSTICS};
use crate::syntax::ast::{Binary, Node, NodeId};
use crate::syntax::diagnostic::Diagnostic;
use crate::syntax::lexer::TokenKind;
use crate::syntax::span::Span;

impl Parser<'_> {
    pub(super) fn operator(&mut self) -> State {
        let Some(token) = self.token(0).cloned() else {
            return self.finish();
        };
        let span = token.span;
        match token.kind {
            TokenKind::Plus => self.binary(Operator::Add, span),
            TokenKind::Minus => self.binary(Operator::Subtract, span),
            TokenKind::Star => self.binary(Operator::Multiply, span),
            TokenKind::Slash => self.binary(Operator::Divide, span),
            TokenKind::Caret => self.binary(Operator::Power, span),
            TokenKind::Number(_) => self.number_after_operand(span),
            TokenKind::Name(_) => self.implicit_product(span),
            TokenKind::Open => self.group_after_operand(span),
            TokenKind::OpenBrace => {
                self.implicit_product(span);
                State::Operand
            }
            TokenKind::Close | TokenKind::CloseBrace => self.close(&token),
            TokenKind::Comma => self.comma(span),
            TokenKind::Dots => self.dots(span),
            TokenKind::Relation(relation) => self.relation(relation, span),
            TokenKind::Primes(_) => self.prime_after_operand(span),
        }
    }

    pub(super) fn binary(&mut self, operator: Operator, span: Span) -> State {
        self.at += 1;
        self.push_operator(operator, span);
        State::Operand
    }

    pub(super) fn implicit_product(&mut self, at: Span) -> State {
        self.push_operator(Operator::ImplicitMultiply, Span::empty(at.start));
        State::Operand
    }

    pub(super) fn number_after_operand(&mut self, span: Span) -> State {
        let number = span.text(self.source).to_owned();
        let before = self
            .operands
            .last()
            .map_or(Span::empty(0), |operand| operand.span);
        let between = Span::new(before.end, span.start).text(self.source);
        let diagnostic = Diagnostic::error(
            "number-after-factor",
            before.to(span),
            format!("the number `{number}` follows without an operator"),
        )
        .hint("write the number first in an implicit product, or `*`, `^` or `_` before it");
        // A sign without meaning in between, or a word of another language before it, says that something else was meant.
        let word = before.text(self.source);
        let is_plain = between.trim().is_empty() && !matches!(word, "else" | "then" | "if");
        self.error(if is_plain {
            let place = Span::new(before.end, span.end);
            diagnostic.suggest(place, format!("*{number}"))
        } else {
            diagnostic
        });
        self.implicit_product(span)
    }

    /// `a (x+1)`: a product, since `a` is not a function.
    pub(super) fn group_after_operand(&mut self, span: Span) -> State {
        let after = self
            .operands
            .last()
            .filter(|operand| !operand.grouped)
            .and_then(|operand| {
                let (name, order) = self.tree.plain_name(operand.node)?;
                let written = format!("{name}{}", "'".repeat(order as usize));
                Some((written, operand.span))
            });
        self.implicit_product(span);
        self.at += 1;
        self.open(FrameKind::Group { after }, span);
        State::Operand
    }

    pub(super) fn prime_after_operand(&mut self, span: Span) -> State {
        self.at += 1;
        let grouped = self.operands.last().is_some_and(|operand| operand.grouped);
        let raised = self
            .operators
            .last()
            .is_some_and(|(operator, _)| *operator == Operator::Power);
        let before = self.operands.last().map_or(span, |operand| operand.span);
        let base = Diagnostic::error(
            "stray-prime",
            before.to(span),
            "a prime follows the name of a coordinate, nothing else",
        );
        let diagnostic = if grouped {
            base.hint("differentiate the parenthesis yourself, or give it a name under [define] and prime that name")
        } else if raised {
            base.hint("the prime comes before the power: x'^2 is the square of the velocity")
        } else {
            base
        };
        self.error(diagnostic);
        State::Operator
    }

    pub(super) fn push_operator(&mut self, operator: Operator, span: Span) {
        let base = self.frames.last().map_or(0, |frame| frame.operators);
        while self.operators.len() > base {
            let Some((top, _)) = self.operators.last() else {
                break;
            };
            let binds = top.strength() > operator.strength()
                || (top.strength() == operator.strength() && operator != Operator::Power);
            if !binds {
                break;
            }
            self.reduce();
        }
        self.operators.push((operator, span));
    }

    pub(super) fn reduce(&mut self) {
        let Some((operator, span)) = self.operators.pop() else {
            return;
        };
        let Some(right) = self.operands.pop() else {
            return;
        };
        if operator == Operator::Negate {
            let span = span.to(right.span);
            self.push(Node::Negate(right.node), span);
            return;
        }
        let Some(left) = self.operands.pop() else {
            return;
        };
        if operator == Operator::ImplicitMultiply {
            self.warn_quotient_then_factor(left, right);
        }
        let operation = match operator {
            Operator::Add => Binary::Add,
            Operator::Subtract => Binary::Subtract,
            Operator::Divide => Binary::Divide,
            Operator::Power => Binary::Power,
            _ => Binary::Multiply,
        };
        self.push(
            Node::Binary {
                operation,
                left: left.node,
                right: right.node,
            },
            left.span.to(right.span),
        );
    }

    /// `a/b c` is (a/b)·c here, while some books mean a/(b c). A number below, as in `1/2 m`, is clear to everybody.
    pub(super) fn warn_quotient_then_factor(&mut self, left: Operand, right: Operand) {
        if left.grouped {
            return;
        }
        let Node::Binary {
            operation: Binary::Divide,
            left: above,
            right: below,
        } = *self.tree.node(left.node)
        else {
            return;
        };
        if matches!(self.tree.node(below), Node::Number(_)) {
            return;
        }
        if self.diagnostics.len() >= MOST_DIAGNOSTICS {
            return;
        }
        let whole = left.span.to(right.span);
        let diagnostic = Diagnostic::warning(
            "quotient-then-factor",
            whole,
            format!(
                "`{}` is read as ({}) * {}",
                clipped(whole.text(self.source)),
                clipped(left.span.text(self.source)),
                clipped(right.span.text(self.source))
            ),
        );
        let hint = match self.all_below(above, below, right) {
            Some(text) => format!("write `{text}` if the whole product is below the line"),
            None => "put what is below the line in parentheses, if it is the whole product".into(),
        };
        self.error(diagnostic.hint(hint));
    }

    /// `above/(below factor)` with the parentheses that it needs, if it is short and is read so.
    fn all_below(&self, above: NodeId, below: NodeId, factor: Operand) -> Option<String> {
        const LONGEST: usize = 120;
        let own = |node: NodeId| in_parentheses(self.source, self.tree.span(node));
        let (a, b, c) = (own(above), own(below), factor.span);
        if a.end - a.start + (b.end - b.start) + (c.end - c.start) > LONGEST {
            return None;
        }
        let [a, b, c] = [a, b, c].map(|span| span.text(self.source));
        let text = format!("{a}/({b} {c})");
        let read = super::parse_expression(&text);
        let root = read.root();
        let Node::Binary {
            operation: Binary::Divide,
            left,
            right,
        } = *read.tree.node(root)
        else {
            return None;
        };
        let Node::Binary {
            operation: Binary::Multiply,
            left: first,
            right: second,
        } = *read.tree.node(right)
        else {
            return None;
        };
        let is_meant = read.diagnostics.is_empty()
            && read.tree.means_same(left, &self.tree, above)
            && read.tree.means_same(first, &self.tree, below)
            && read.tree.means_same(second, &self.tree, factor.node);
        is_meant.then_some(text)
    }

    /// Reduces everything in the innermost frame and takes its value off the stack.
    pub(super) fn value(&mut self) -> Operand {
        let base = self.frames.last().map_or(0, |frame| frame.operators);
        while self.operators.len() > base {
            self.reduce();
        }
        let at = Span::empty(self.end_of_last());
        self.operands.pop().unwrap_or_else(|| Operand {
            node: self.tree.push(Node::Error, at),
            span: at,
            grouped: false,
        })
    }
}

/// The extent of a part with the parentheses right around it.
fn in_parentheses(source: &str, span: Span) -> Span {
    let mut span = span;
    loop {
        let before = source[..span.start].trim_end();
        let after = source[span.end..].trim_start();
        let (Some(_), Some(_)) = (before.strip_suffix('('), after.strip_prefix(')')) else {
            return span;
        };
        // The parenthesis of a call is not that of its argument.
        let head = before[..before.len() - 1].trim_end();
        if head.ends_with(|c: char| c.is_alphanumeric() || c == '_')
            && before.len() - 1 == head.len()
        {
            return span;
        }
        let end = source.len() - after.len() + 1;
        span = Span::new(before.len() - 1, end);
    }
}

/// A text that is short enough for a sentence.
fn clipped(text: &str) -> std::borrow::Cow<'_, str> {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        None => text.into(),
        Some((end, _)) => format!("{}…", &text[..end]).into(),
    }
}
