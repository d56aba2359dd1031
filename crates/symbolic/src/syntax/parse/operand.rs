//! Where an operand is expected: numbers, names, functions, opening brackets.

use dashu_base::Signed;

use super::{Frame, FrameKind, Operator, Parser, State};
use crate::syntax::ast::{NamePart, Node, Relation};
use crate::syntax::diagnostic::Diagnostic;
use crate::syntax::functions::Builtin;
use crate::syntax::lexer::{Token, TokenKind};
use crate::syntax::span::Span;

impl Parser<'_> {
    pub(super) fn operand(&mut self) -> State {
        let Some(token) = self.token(0).cloned() else {
            let at = Span::empty(self.end_of_last());
            let message = match self
                .at
                .checked_sub(1)
                .and_then(|last| self.tokens.get(last))
            {
                Some(last) => format!(
                    "an expression is expected after `{}`",
                    last.span.text(self.source)
                ),
                None => "an expression is expected here".to_owned(),
            };
            self.error(Diagnostic::error(
                "missing-operand",
                self.last_span().unwrap_or(at),
                message,
            ));
            self.push(Node::Error, at);
            return State::Operator;
        };
        match token.kind {
            TokenKind::Number(value) => {
                self.at += 1;
                self.push(Node::Number(value), token.span);
                State::Operator
            }
            TokenKind::Name(name) => self.name(name, token.span),
            TokenKind::Minus => {
                self.at += 1;
                self.operators.push((Operator::Negate, token.span));
                State::Operand
            }
            TokenKind::Plus => {
                self.at += 1;
                State::Operand
            }
            TokenKind::Open => {
                self.at += 1;
                self.open(FrameKind::Group { after: None }, token.span);
                State::Operand
            }
            TokenKind::OpenBrace => {
                self.at += 1;
                self.stray_brace(token.span);
                self.open(FrameKind::Group { after: None }, token.span);
                State::Operand
            }
            TokenKind::Primes(_) => {
                self.at += 1;
                self.error(
                    Diagnostic::error(
                        "stray-prime",
                        token.span,
                        "a prime follows the name of a coordinate",
                    )
                    .hint("write x' for the derivative of x"),
                );
                State::Operand
            }
            _ => self.missing_operand(&token),
        }
    }

    pub(super) fn last_span(&self) -> Option<Span> {
        self.at
            .checked_sub(1)
            .and_then(|last| self.tokens.get(last))
            .map(|token| token.span)
    }

    pub(super) fn stray_brace(&mut self, span: Span) {
        self.error(
            Diagnostic::error(
                "stray-brace",
                span,
                "braces hold the index of a name, as in theta_{i}",
            )
            .hint("use parentheses to group")
            .suggest(span, "("),
        );
    }

    pub(super) fn missing_operand(&mut self, token: &Token) -> State {
        let empty_call = token.kind == TokenKind::Close
            && self
                .last_span()
                .is_some_and(|last| self.frames.last().is_some_and(|frame| frame.open == last))
            && matches!(self.frames.last(), Some(Frame { kind: FrameKind::Call { arguments, .. }, .. }) if arguments.is_empty());
        if empty_call {
            self.at += 1;
            self.close_call(Vec::new(), token.span);
            return State::Operator;
        }
        let found = token.span.text(self.source);
        let message = format!("an expression is expected before `{found}`");
        self.error(Diagnostic::error("missing-operand", token.span, message));
        self.push(Node::Error, Span::empty(token.span.start));
        State::Operator
    }

    pub(super) fn name(&mut self, name: String, span: Span) -> State {
        self.at += 1;
        if name == "sum" {
            return self.open_sum(span);
        }
        if let Some(function) = Builtin::of_name(&name) {
            return self.function(function, span);
        }
        self.name_parts(vec![NamePart::Text(name)], span)
    }

    /// Continues a name with what touches it: an index in braces, more letters after an index.
    pub(super) fn name_parts(&mut self, mut parts: Vec<NamePart>, mut span: Span) -> State {
        loop {
            let ends_with_underscore = match parts.last() {
                Some(NamePart::Text(text)) => text.ends_with('_'),
                _ => false,
            };
            let after_index = matches!(parts.last(), Some(NamePart::Index(_)));
            match self.token(0) {
                Some(Token {
                    kind: TokenKind::OpenBrace,
                    span: brace,
                }) if ends_with_underscore && brace.start == span.end => {
                    let brace = *brace;
                    self.at += 1;
                    self.open(FrameKind::Index { parts, name: span }, brace);
                    return State::Operand;
                }
                Some(Token {
                    kind: TokenKind::Name(more),
                    span: own,
                }) if after_index && own.start == span.end => {
                    span = span.to(*own);
                    parts.push(NamePart::Text(more.clone()));
                    self.at += 1;
                }
                _ => return self.finish_name(parts, span),
            }
        }
    }

    pub(super) fn finish_name(&mut self, parts: Vec<NamePart>, span: Span) -> State {
        let letters = span;
        let (order, span) = match self.token(0) {
            Some(Token {
                kind: TokenKind::Primes(count),
                span: own,
            }) => (*count, span.to(*own)),
            _ => (0, span),
        };
        if order > 0 {
            self.at += 1;
        }
        let before_parenthesis = self.next_is(0, &TokenKind::Open);
        self.push(
            Node::Name {
                parts,
                order,
                letters,
                before_parenthesis,
            },
            span,
        );
        State::Operator
    }

    pub(super) fn function(&mut self, function: Builtin, span: Span) -> State {
        if let Some(open) = self
            .token(0)
            .filter(|token| token.kind == TokenKind::Open)
            .map(|token| token.span)
        {
            self.at += 1;
            self.open(
                FrameKind::Call {
                    function,
                    name: span,
                    power: None,
                    arguments: Vec::new(),
                },
                open,
            );
            return State::Operand;
        }
        if self.next_is(0, &TokenKind::Caret) {
            if let (
                Some(Token {
                    kind: TokenKind::Number(power),
                    ..
                }),
                Some(Token {
                    kind: TokenKind::Open,
                    span: open,
                }),
            ) = (self.token(1), self.token(2))
            {
                if power.is_int() && power.is_positive() {
                    let (power, open) = (power.clone(), *open);
                    self.at += 3;
                    self.open(
                        FrameKind::Call {
                            function,
                            name: span,
                            power: Some(power),
                            arguments: Vec::new(),
                        },
                        open,
                    );
                    return State::Operand;
                }
            }
        }
        self.function_without_argument(function, span)
    }

    pub(super) fn function_without_argument(&mut self, function: Builtin, span: Span) -> State {
        let name = function.name();
        let base = Diagnostic::error(
            "function-without-argument",
            span,
            format!("the function `{name}` needs its argument in parentheses"),
        );
        let following = self.token(0).map(|token| (token.kind.clone(), token.span));
        let diagnostic = match following {
            Some((TokenKind::Name(_) | TokenKind::Number(_), argument)) => {
                let replacement = format!("{name}({})", argument.text(self.source));
                base.hint(format!("write `{replacement}`"))
                    .suggest(span.to(argument), replacement)
            }
            Some((TokenKind::Caret, _)) => {
                base.hint(format!("write ({name}(x))^n for a power of its value"))
            }
            Some((TokenKind::Primes(_), primes)) => {
                self.at += 1;
                let base = Diagnostic::error(
                    "derivative-of-function",
                    span.to(primes),
                    format!("`{name}` is a function and takes no prime"),
                );
                base.hint("primes are derivatives of coordinates with respect to the time")
            }
            _ => base.hint(format!(
                "`{name}` is reserved for the function; choose another name for a quantity"
            )),
        };
        self.error(diagnostic);
        self.push(Node::Error, span);
        State::Operator
    }

    pub(super) fn open_sum(&mut self, span: Span) -> State {
        let header = match (self.token(0), self.token(1), self.token(2)) {
            (
                Some(Token {
                    kind: TokenKind::Open,
                    span: open,
                }),
                Some(Token {
                    kind: TokenKind::Name(index),
                    ..
                }),
                Some(Token {
                    kind: TokenKind::Relation(Relation::Equal),
                    ..
                }),
            ) => Some((*open, index.clone())),
            _ => None,
        };
        if let Some((open, index)) = header {
            self.at += 3;
            self.open(
                FrameKind::Sum {
                    index,
                    name: span,
                    parts: Vec::new(),
                },
                open,
            );
            return State::Operand;
        }
        self.error(
            Diagnostic::error("malformed-sum", span, "`sum` needs an index and its range")
                .hint("write sum(i = 1..n, body); both ends are included"),
        );
        if let Some(open) = self
            .token(0)
            .filter(|token| token.kind == TokenKind::Open)
            .map(|token| token.span)
        {
            self.at += 1;
            self.open(FrameKind::Group { after: None }, open);
            if let Some(frame) = self.frames.last_mut() {
                frame.poisoned = true;
            }
            return State::Operand;
        }
        self.push(Node::Error, span);
        State::Operator
    }
}
