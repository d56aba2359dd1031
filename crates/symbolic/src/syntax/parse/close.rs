//! Closing brackets, and what separates: commas, ranges, comparisons, the end.

use super::{Frame, FrameKind, Operand, Parser, Separators, State};
use crate::syntax::ast::{NamePart, Node, Relation};
use crate::syntax::diagnostic::Diagnostic;
use crate::syntax::functions::Builtin;
use crate::syntax::lexer::{Token, TokenKind};
use crate::syntax::span::Span;
use crate::syntax::unknown::{advice, not_a_function};

impl Parser<'_> {
    pub(super) fn close(&mut self, token: &Token) -> State {
        let brace = token.kind == TokenKind::CloseBrace;
        let fits = match self.frames.last() {
            Some(Frame {
                kind: FrameKind::Index { .. },
                ..
            }) => brace,
            Some(Frame {
                kind: FrameKind::Group { .. },
                open,
                ..
            }) => brace == (open.text(self.source) == "{"),
            Some(Frame {
                kind: FrameKind::Top,
                ..
            })
            | None => false,
            _ => !brace,
        };
        self.at += 1;
        if !fits {
            let sign = token.span.text(self.source).to_owned();
            let (code, message) = match self.frames.last() {
                Some(Frame {
                    kind: FrameKind::Top,
                    ..
                })
                | None => (
                    "unbalanced-parenthesis",
                    format!("this `{sign}` closes nothing"),
                ),
                _ => (
                    "unbalanced-parenthesis",
                    format!("this `{sign}` does not close what was opened last"),
                ),
            };
            let mut diagnostic = Diagnostic::error(code, token.span, message);
            if let Some(frame) = self
                .frames
                .last()
                .filter(|frame| !matches!(frame.kind, FrameKind::Top))
            {
                diagnostic = diagnostic.related(frame.open, "opened here");
            } else {
                diagnostic = diagnostic.hint(format!(
                    "leave out the `{sign}`, or open a parenthesis before"
                ));
            }
            self.error(diagnostic);
            return State::Operator;
        }
        let value = self.value();
        self.close_frame(value, token.span)
    }

    pub(super) fn close_frame(&mut self, value: Operand, close: Span) -> State {
        match self
            .frames
            .last_mut()
            .map(|frame| std::mem::replace(&mut frame.kind, FrameKind::Top))
        {
            Some(FrameKind::Call {
                function,
                name,
                power,
                mut arguments,
            }) => {
                arguments.push(value);
                if let Some(frame) = self.frames.last_mut() {
                    frame.kind = FrameKind::Call {
                        function,
                        name,
                        power,
                        arguments: Vec::new(),
                    };
                }
                self.close_call(arguments, close);
                State::Operator
            }
            Some(FrameKind::Sum {
                index,
                name,
                mut parts,
            }) => {
                parts.push(value);
                self.close_sum(index, name, &parts, close);
                State::Operator
            }
            Some(FrameKind::Index { mut parts, name }) => {
                parts.push(NamePart::Index(value.node));
                self.frames.pop();
                self.name_parts(parts, name.to(close))
            }
            Some(FrameKind::Group { after }) => {
                self.close_group(after, value, close);
                State::Operator
            }
            _ => State::Operator,
        }
    }

    pub(super) fn close_group(
        &mut self,
        after: Option<(String, Span)>,
        value: Operand,
        close: Span,
    ) {
        let Some(frame) = self.frames.pop() else {
            return;
        };
        let span = frame.open.to(close);
        if frame.poisoned {
            self.push(Node::Error, span);
            return;
        }
        if let Some((name, own)) = after {
            let is_time = self.tree.plain_name(value.node) == Some(("t", 0)) && !value.grouped;
            if is_time && own.end == frame.open.start {
                let message = format!("`{name}(t)` is read as the product {name}*t");
                self.error(
                    Diagnostic::warning("name-applied-to-time", own.to(close), message)
                        .hint(format!("write `{name}`: coordinates and controls depend on the time without saying so"))
                        .suggest(own.to(close), name),
                );
            }
        }
        self.operands.push(Operand {
            node: value.node,
            span,
            grouped: true,
        });
    }

    pub(super) fn close_call(&mut self, arguments: Vec<Operand>, close: Span) {
        let Some(frame) = self.frames.pop() else {
            return;
        };
        let FrameKind::Call {
            function,
            name,
            power,
            ..
        } = frame.kind
        else {
            return;
        };
        let span = name.to(close);
        let arity = function.arity();
        if arguments.len() != arity && !frame.poisoned {
            let wanted = if arity == 1 {
                "one argument".to_owned()
            } else {
                format!("{arity} arguments")
            };
            let message = format!(
                "`{}` takes {wanted}, not {}",
                function.name(),
                arguments.len()
            );
            let extra = match arguments.get(arity) {
                Some(first) => first
                    .span
                    .to(arguments.last().map_or(first.span, |last| last.span)),
                None => span,
            };
            let label = if arguments.len() > arity {
                "too many"
            } else {
                "too few"
            };
            let mut diagnostic = Diagnostic::error("wrong-arity", extra, message).label(label);
            if function == Builtin::Atan && arguments.len() == 2 {
                diagnostic = diagnostic
                    .hint("atan2(y, x) is the angle of the point (x, y)")
                    .suggest(name, "atan2");
            } else if function == Builtin::Log && arguments.len() == 2 {
                diagnostic = diagnostic.hint("write log(x)/log(b) for the logarithm to the base b");
            }
            self.error(diagnostic);
            self.push(Node::Error, span);
        } else if frame.poisoned || arguments.len() != arity {
            self.push(Node::Error, span);
        } else {
            let arguments = arguments.iter().map(|operand| operand.node).collect();
            self.push(
                Node::Call {
                    function,
                    arguments,
                    power,
                },
                span,
            );
        }
    }

    pub(super) fn close_sum(&mut self, index: String, name: Span, parts: &[Operand], close: Span) {
        let poisoned = self.frames.pop().is_none_or(|frame| frame.poisoned);
        let span = name.to(close);
        if let ([from, to, body], false) = (parts, poisoned) {
            self.push(
                Node::Sum {
                    index,
                    from: from.node,
                    to: to.node,
                    body: body.node,
                },
                span,
            );
            return;
        }
        if !poisoned {
            self.error(
                Diagnostic::error("malformed-sum", span, "`sum` needs a range and a body")
                    .hint("write sum(i = 1..n, body)"),
            );
        }
        self.push(Node::Error, span);
    }

    pub(super) fn comma(&mut self, span: Span) -> State {
        let value = self.value();
        self.at += 1;
        match self.frames.last_mut().map(|frame| &mut frame.kind) {
            Some(FrameKind::Call { arguments, .. }) => arguments.push(value),
            Some(FrameKind::Sum { parts, .. }) if parts.len() == 1 => parts.push(value),
            Some(FrameKind::Index { parts, .. }) => {
                parts.push(NamePart::Index(value.node));
                parts.push(NamePart::Text("_".to_owned()));
            }
            _ => self.stray_comma(span, value),
        }
        State::Operand
    }

    pub(super) fn stray_comma(&mut self, span: Span, before: Operand) {
        let base = Diagnostic::error(
            "stray-comma",
            span,
            "a comma separates the arguments of a function, and there is none here",
        );
        let called = match self.frames.last() {
            Some(Frame {
                kind:
                    FrameKind::Group {
                        after: Some((name, _)),
                    },
                ..
            }) => Some(name.clone()),
            _ => None,
        };
        let number_before = matches!(self.tree.node(before.node), Node::Number(_));
        let number_after = matches!(
            self.token(0),
            Some(Token {
                kind: TokenKind::Number(_),
                ..
            })
        );
        let in_sum = matches!(
            self.frames.last(),
            Some(Frame {
                kind: FrameKind::Sum { .. },
                ..
            })
        );
        let diagnostic = match called {
            Some(name) if advice(&name).is_some() => {
                let own = self.frames.last().map_or(span, |frame| match &frame.kind {
                    FrameKind::Group {
                        after: Some((_, own)),
                    } => *own,
                    _ => span,
                });
                not_a_function(&name, own)
            }
            _ if in_sum => {
                Diagnostic::error("malformed-sum", span, "`sum` needs a range and a body")
                    .hint("write sum(i = 1..n, body)")
            }
            Some(name) => base.hint(format!("`{name}` is not a function")),
            None if number_before && number_after => base
                .hint("the decimal sign is a point: 0.5")
                .suggest(span, "."),
            None => base,
        };
        let poisoned = self.frames.last().is_some_and(|frame| frame.poisoned);
        if !poisoned {
            self.error(diagnostic);
        }
        if let Some(frame) = self.frames.last_mut() {
            frame.poisoned = true;
        }
    }

    pub(super) fn dots(&mut self, span: Span) -> State {
        let value = self.value();
        self.at += 1;
        match self.frames.last_mut() {
            Some(Frame {
                kind: FrameKind::Sum { parts, .. },
                ..
            }) if parts.is_empty() => parts.push(value),
            Some(Frame {
                kind: FrameKind::Top,
                ..
            }) if self.separators == Separators::Dots => {
                self.sides.push(value.node);
                self.side_spans.push(value.span);
            }
            frame => {
                if let Some(frame) = frame {
                    frame.poisoned = true;
                }
                self.error(
                    Diagnostic::error("stray-range", span, "a range has no place here")
                        .hint("ranges belong in sums: sum(i = 1..n, body)"),
                );
            }
        }
        State::Operand
    }

    pub(super) fn relation(&mut self, relation: Relation, span: Span) -> State {
        let value = self.value();
        self.at += 1;
        let top = matches!(
            self.frames.last(),
            Some(Frame {
                kind: FrameKind::Top,
                ..
            })
        );
        if top && self.separators == Separators::Relations {
            self.push_side(value);
            self.relations.push((relation, span));
            return State::Operand;
        }
        if let Some(frame) = self.frames.last_mut() {
            frame.poisoned = true;
        }
        let called = match self.frames.last().map(|frame| &frame.kind) {
            Some(FrameKind::Group {
                after: Some((name, own)),
            }) if advice(name).is_some() => Some((name.clone(), *own)),
            _ => None,
        };
        if let Some((name, own)) = called {
            self.error(not_a_function(&name, own));
            return State::Operand;
        }
        let mut diagnostic = Diagnostic::error(
            "unexpected-relation",
            span,
            format!("`{}` has no place inside an expression", relation.sign()),
        );
        if let Some(frame) = self.frames.last().filter(|_| !top) {
            diagnostic = diagnostic.related(frame.open, "this parenthesis is still open");
        }
        self.error(diagnostic);
        State::Operand
    }

    pub(super) fn push_side(&mut self, value: Operand) {
        let poisoned = self
            .frames
            .last_mut()
            .is_some_and(|frame| std::mem::take(&mut frame.poisoned));
        let node = if poisoned {
            self.tree.push(Node::Error, value.span)
        } else {
            value.node
        };
        self.sides.push(node);
        self.side_spans.push(value.span);
    }

    pub(super) fn finish(&mut self) -> State {
        let end = Span::empty(self.end_of_last());
        let unclosed: Vec<Span> = self
            .frames
            .iter()
            .filter(|frame| !matches!(frame.kind, FrameKind::Top))
            .map(|frame| frame.open)
            .collect();
        if let Some(last) = unclosed.last() {
            let message = match unclosed.len() {
                1 => format!(
                    "this `{}` is never closed: a parenthesis is missing",
                    last.text(self.source)
                ),
                count => format!("{count} parentheses are never closed"),
            };
            let sign = if last.text(self.source) == "{" {
                "}"
            } else {
                ")"
            };
            let mut diagnostic = Diagnostic::error("unbalanced-parenthesis", *last, message)
                .label("opened here")
                .hint(format!("add `{sign}` where it ends"));
            for open in unclosed.iter().rev().skip(1).take(3) {
                diagnostic = diagnostic.related(*open, "and here");
            }
            if unclosed.len() == 1 {
                diagnostic = diagnostic.suggest(end, sign);
            }
            self.error(diagnostic);
        }
        for _ in &unclosed {
            let value = self.value();
            if let Some(frame) = self.frames.last_mut() {
                frame.poisoned = true;
            }
            self.close_frame(value, end);
        }
        let value = self.value();
        self.push_side(value);
        State::Done
    }
}
