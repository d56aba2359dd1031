//! Tokens to a syntax tree, by operator precedence (Pratt 1973; the explicit stacks are Dijkstra's).
//!
//! The stacks hold what recursion would hold, so depth costs memory in proportion to the text and nothing else.

use dashu_base::Signed;
use dashu_int::IBig;
use dashu_ratio::RBig;

use super::ast::{Binary, NamePart, Node, NodeId, Relation, Tree};
use super::diagnostic::Diagnostic;
use super::functions::Builtin;
use super::lexer::{tokens, Token, TokenKind};
use super::span::Span;

/// More problems than this in one expression are not worth a person's time, and are left out.
const MOST_DIAGNOSTICS: usize = 20;

/// What a text was read as.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The nodes.
    pub tree: Tree,
    /// The sides of the equation or comparison; a single one for an expression. Never empty.
    pub sides: Vec<NodeId>,
    /// The signs between the sides.
    pub relations: Vec<(Relation, Span)>,
    /// The whole extent of each side, parentheses included.
    pub side_spans: Vec<Span>,
    /// What is wrong or doubtful.
    pub diagnostics: Vec<Diagnostic>,
}

impl Parsed {
    /// The first side: the expression itself where there is no relation.
    pub fn root(&self) -> NodeId {
        self.sides[0]
    }

    /// Whether a part could not be read.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(Diagnostic::is_error)
    }
}

/// Reads an expression, such as `1/2 m x'^2`. An equation is an error.
pub fn parse_expression(source: &str) -> Parsed {
    let mut parsed = parse(source, Separators::Relations);
    if let Some((relation, span)) = parsed.relations.first() {
        let message = format!(
            "an expression is expected here, without `{}`",
            relation.sign()
        );
        parsed
            .diagnostics
            .push(Diagnostic::error("unexpected-relation", *span, message));
    }
    parsed
}

/// Reads an equation `left = right`. The two sides are `sides[0]` and `sides[1]` where there is no error.
pub fn parse_equation(source: &str) -> Parsed {
    let mut parsed = parse(source, Separators::Relations);
    let whole = Span::new(0, source.len());
    match parsed.relations.as_slice() {
        [] if parsed.has_errors() => {}
        [] => parsed.diagnostics.push(
            Diagnostic::error(
                "missing-equals",
                whole,
                "an equation `left = right` is expected",
            )
            .hint("add `= 0` if the expression vanishes")
            .suggest(Span::empty(source.len()), " = 0"),
        ),
        [(Relation::Equal, _)] => {}
        [(Relation::Equal, _), (_, second), ..] => parsed.diagnostics.push(
            Diagnostic::error("second-equals", *second, "an equation has one `=`")
                .hint("write one equation for each"),
        ),
        [(relation, span), ..] => parsed.diagnostics.push(Diagnostic::error(
            "inequality",
            *span,
            format!(
                "an equation `left = right` is expected, not an inequality with `{}`",
                relation.sign()
            ),
        )),
    }
    parsed
}

/// Reads a comparison or a chain of them, such as `0 < theta < pi`.
pub fn parse_relation(source: &str) -> Parsed {
    let mut parsed = parse(source, Separators::Relations);
    if parsed.relations.is_empty() && !parsed.has_errors() {
        let whole = Span::new(0, source.len());
        parsed.diagnostics.push(
            Diagnostic::error("missing-relation", whole, "a comparison is expected")
                .hint("for example `m > 0` or `0 < theta < pi`"),
        );
    }
    parsed
}

/// Reads a range `first..last` of integers. The ends are `sides[0]` and `sides[1]` where there is no error.
pub fn parse_range(source: &str) -> Parsed {
    let mut parsed = parse(source, Separators::Dots);
    if parsed.sides.len() != 2 && !parsed.has_errors() {
        let whole = Span::new(0, source.len());
        parsed.diagnostics.push(
            Diagnostic::error("missing-range", whole, "a range of integers is expected")
                .hint("for example `1..n`; both ends are included"),
        );
    }
    parsed
}

#[derive(Copy, Clone, PartialEq, Eq)]
enum Separators {
    Relations,
    Dots,
}

fn parse(source: &str, separators: Separators) -> Parsed {
    let (tokens, diagnostics) = tokens(source);
    let mut parser = Parser {
        source,
        tokens,
        at: 0,
        separators,
        tree: Tree::default(),
        diagnostics,
        operands: Vec::new(),
        operators: Vec::new(),
        frames: vec![Frame {
            kind: FrameKind::Top,
            open: Span::empty(0),
            operators: 0,
            poisoned: false,
        }],
        sides: Vec::new(),
        side_spans: Vec::new(),
        relations: Vec::new(),
    };
    if parser.tokens.is_empty() {
        let whole = Span::new(0, source.len());
        if parser.diagnostics.is_empty() {
            parser.error(Diagnostic::error(
                "empty-expression",
                whole,
                "an expression is expected here, and there is none",
            ));
        }
        let root = parser.tree.push(Node::Error, whole);
        parser.sides.push(root);
        parser.side_spans.push(whole);
    } else {
        parser.run();
    }
    parser.diagnostics.truncate(MOST_DIAGNOSTICS);
    parser.diagnostics.sort_by_key(|diagnostic| diagnostic.span);
    Parsed {
        tree: parser.tree,
        sides: parser.sides,
        relations: parser.relations,
        side_spans: parser.side_spans,
        diagnostics: parser.diagnostics,
    }
}

/// A value on the stack: the node, its extent with parentheses, and whether it stands in parentheses.
#[derive(Copy, Clone)]
struct Operand {
    node: NodeId,
    span: Span,
    grouped: bool,
}

#[derive(Copy, Clone, PartialEq, Eq)]
enum Operator {
    Add,
    Subtract,
    Multiply,
    ImplicitMultiply,
    Divide,
    Negate,
    Power,
}

impl Operator {
    fn strength(self) -> u8 {
        match self {
            Operator::Add | Operator::Subtract => 1,
            Operator::Multiply | Operator::ImplicitMultiply | Operator::Divide => 2,
            Operator::Negate => 3,
            Operator::Power => 4,
        }
    }
}

enum FrameKind {
    /// The text itself.
    Top,
    /// Parentheses; the name before them, if a function may have been meant.
    Group { after: Option<(String, Span)> },
    /// The arguments of a function.
    Call {
        function: Builtin,
        name: Span,
        power: Option<RBig>,
        arguments: Vec<Operand>,
    },
    /// `sum(index = from..to, body)`: the parts read so far.
    Sum {
        index: String,
        name: Span,
        parts: Vec<Operand>,
    },
    /// The index of a name.
    Index { parts: Vec<NamePart>, name: Span },
}

struct Frame {
    kind: FrameKind,
    open: Span,
    /// Height of the stack of operators when the frame was opened.
    operators: usize,
    /// Whether a diagnostic was given that leaves the content without meaning.
    poisoned: bool,
}

#[derive(PartialEq, Eq)]
enum State {
    Operand,
    Operator,
    Done,
}

struct Parser<'s> {
    source: &'s str,
    tokens: Vec<Token>,
    at: usize,
    separators: Separators,
    tree: Tree,
    diagnostics: Vec<Diagnostic>,
    operands: Vec<Operand>,
    operators: Vec<(Operator, Span)>,
    frames: Vec<Frame>,
    sides: Vec<NodeId>,
    side_spans: Vec<Span>,
    relations: Vec<(Relation, Span)>,
}

impl Parser<'_> {
    fn run(&mut self) {
        let mut state = State::Operand;
        while state != State::Done {
            state = match state {
                State::Operand => self.operand(),
                _ => self.operator(),
            };
        }
    }

    fn error(&mut self, diagnostic: Diagnostic) {
        if self.diagnostics.len() < MOST_DIAGNOSTICS {
            self.diagnostics.push(diagnostic);
        }
    }

    fn token(&self, ahead: usize) -> Option<&Token> {
        self.tokens.get(self.at + ahead)
    }

    fn next_is(&self, ahead: usize, kind: &TokenKind) -> bool {
        self.token(ahead).is_some_and(|token| token.kind == *kind)
    }

    /// The place after the last token that was read.
    fn end_of_last(&self) -> usize {
        self.at
            .checked_sub(1)
            .and_then(|last| self.tokens.get(last))
            .map_or(0, |token| token.span.end)
    }

    fn push(&mut self, node: Node, span: Span) {
        let node = self.tree.push(node, span);
        self.operands.push(Operand {
            node,
            span,
            grouped: false,
        });
    }

    fn open(&mut self, kind: FrameKind, open: Span) {
        self.frames.push(Frame {
            kind,
            open,
            operators: self.operators.len(),
            poisoned: false,
        });
    }

    // ---- where an operand is expected

    fn operand(&mut self) -> State {
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

    fn last_span(&self) -> Option<Span> {
        self.at
            .checked_sub(1)
            .and_then(|last| self.tokens.get(last))
            .map(|token| token.span)
    }

    fn stray_brace(&mut self, span: Span) {
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

    fn missing_operand(&mut self, token: &Token) -> State {
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

    fn name(&mut self, name: String, span: Span) -> State {
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
    fn name_parts(&mut self, mut parts: Vec<NamePart>, mut span: Span) -> State {
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

    fn finish_name(&mut self, parts: Vec<NamePart>, span: Span) -> State {
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

    fn function(&mut self, function: Builtin, span: Span) -> State {
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

    fn function_without_argument(&mut self, function: Builtin, span: Span) -> State {
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

    fn open_sum(&mut self, span: Span) -> State {
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

    // ---- where an operator is expected

    fn operator(&mut self) -> State {
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

    fn binary(&mut self, operator: Operator, span: Span) -> State {
        self.at += 1;
        self.push_operator(operator, span);
        State::Operand
    }

    fn implicit_product(&mut self, at: Span) -> State {
        self.push_operator(Operator::ImplicitMultiply, Span::empty(at.start));
        State::Operand
    }

    fn number_after_operand(&mut self, span: Span) -> State {
        let number = span.text(self.source).to_owned();
        let before = self
            .operands
            .last()
            .map_or(Span::empty(0), |operand| operand.span);
        self.error(
            Diagnostic::error(
                "number-after-factor",
                before.to(span),
                format!("the number `{number}` follows without an operator"),
            )
            .hint("write the number first in an implicit product, or `*`, `^` or `_` before it")
            .suggest(Span::new(before.end, span.end), format!("*{number}")),
        );
        self.implicit_product(span)
    }

    /// `a (x+1)`: a product, since `a` is not a function.
    fn group_after_operand(&mut self, span: Span) -> State {
        let after = self
            .operands
            .last()
            .filter(|operand| !operand.grouped)
            .and_then(|operand| {
                let (name, order) = self.tree.plain_name(operand.node)?;
                (order == 0).then(|| (name.to_owned(), operand.span))
            });
        self.implicit_product(span);
        self.at += 1;
        self.open(FrameKind::Group { after }, span);
        State::Operand
    }

    fn prime_after_operand(&mut self, span: Span) -> State {
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

    fn push_operator(&mut self, operator: Operator, span: Span) {
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

    fn reduce(&mut self) {
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
    fn warn_quotient_then_factor(&mut self, left: Operand, right: Operand) {
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
        let text = |span: Span| span.text(self.source).to_owned();
        let (below, factor) = (text(self.tree.span(below)), text(right.span));
        let whole = left.span.to(right.span);
        let diagnostic = Diagnostic::warning(
            "quotient-then-factor",
            whole,
            format!(
                "`{}` is read as ({}) * {factor}",
                text(whole),
                text(left.span)
            ),
        )
        .hint(format!(
            "write `{}/({below} {factor})` if the whole product is below the line",
            text(self.tree.span(above))
        ));
        self.error(diagnostic);
    }

    /// Reduces everything in the innermost frame and takes its value off the stack.
    fn value(&mut self) -> Operand {
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

    // ---- closing and separating

    fn close(&mut self, token: &Token) -> State {
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

    fn close_frame(&mut self, value: Operand, close: Span) -> State {
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

    fn close_group(&mut self, after: Option<(String, Span)>, value: Operand, close: Span) {
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

    fn close_call(&mut self, arguments: Vec<Operand>, close: Span) {
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

    fn close_sum(&mut self, index: String, name: Span, parts: &[Operand], close: Span) {
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

    fn comma(&mut self, span: Span) -> State {
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

    fn stray_comma(&mut self, span: Span, before: Operand) {
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

    fn dots(&mut self, span: Span) -> State {
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

    fn relation(&mut self, relation: Relation, span: Span) -> State {
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

    fn push_side(&mut self, value: Operand) {
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

    fn finish(&mut self) -> State {
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

/// The integer of a node, where it is one; a convenience for ranges.
pub fn integer_of(value: &RBig) -> Option<i64> {
    if !value.is_int() {
        return None;
    }
    let whole: IBig = value.numerator().clone();
    i64::try_from(whole).ok()
}
