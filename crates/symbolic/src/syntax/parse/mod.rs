//! Tokens to a syntax tree, by operator precedence (Pratt 1973; the explicit stacks are Dijkstra's).
//!
//! The stacks hold what recursion would hold, so depth costs memory in proportion to the text and nothing else.

mod close;
mod operand;
mod operator;

use dashu_int::IBig;
use dashu_ratio::RBig;

use crate::syntax::ast::{NamePart, Node, NodeId, Relation, Tree};
use crate::syntax::diagnostic::Diagnostic;
use crate::syntax::functions::Builtin;
use crate::syntax::lexer::{tokens, Token, TokenKind};
use crate::syntax::span::Span;

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
}

/// The integer of a node, where it is one; a convenience for ranges.
pub fn integer_of(value: &RBig) -> Option<i64> {
    if !value.is_int() {
        return None;
    }
    let whole: IBig = value.numerator().clone();
    i64::try_from(whole).ok()
}
