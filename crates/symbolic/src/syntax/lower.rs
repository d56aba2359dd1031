//! Syntax tree to expressions of the graph: names are resolved, sums expanded, numbers folded.
//!
//! An explicit stack of tasks stands in for recursion, so that depth costs memory only.

use crate::graph::Graph;
use crate::node::{Expr, Function};
use crate::rational::{is_negative, to_i64};

use super::ast::{Binary, NamePart, Node, NodeId, Tree};
use super::diagnostic::Diagnostic;
use super::functions::Builtin;
use super::span::Span;
use super::unknown::unknown_name;

/// Most terms of one `sum`, and most steps of one expression. What is larger is a slip of the pen, and would fill
/// the memory before anybody could say so.
const MOST_TERMS: i64 = 100_000;
/// After so many problems of one kind of slip the rest is not looked at.
const MOST_DIAGNOSTICS: usize = 200;
const MOST_STEPS: usize = 1_000_000;

/// What a name stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Resolution {
    /// This expression, the derivative already taken.
    Known(Expr),
    /// Nothing; the nearest names are suggested.
    Unknown,
    /// Something that has no such derivative, or may not be used here.
    Refused {
        /// Stable identifier of the diagnostic.
        code: &'static str,
        /// What is wrong.
        message: String,
        /// What to do about it; may be empty.
        hint: String,
    },
    /// Something that could not be understood itself; a diagnostic has been given at its own place.
    Failed,
}

/// The meaning of names.
pub trait Scope {
    /// What `name` differentiated `order` times with respect to the time stands for.
    fn resolve(&self, name: &str, order: u32) -> Resolution;

    /// Every name that [`Scope::resolve`] knows, the likeliest first; used for suggestions only.
    fn names(&self) -> Vec<String>;
}

/// Integer values of indices.
pub type Bindings = Vec<(String, i64)>;

/// Turns a node of a syntax tree into an expression.
///
/// `None` where a part has no meaning; the reasons are added to `diagnostics`, all of them at once. Parts that the
/// parser could not read give no second diagnostic.
pub fn lower(
    graph: &Graph,
    tree: &Tree,
    root: NodeId,
    scope: &dyn Scope,
    bindings: &[(String, i64)],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Expr> {
    let mut machine = Machine {
        graph,
        tree,
        scope,
        bindings: bindings.to_vec(),
        tasks: vec![Task::Enter(root)],
        values: Vec::new(),
        failed: false,
        diagnostics,
    };
    machine.run();
    if machine.failed {
        return None;
    }
    machine.values.pop()
}

/// The name that a node is, indices evaluated, with its order of differentiation; `None` where it is no name.
pub fn expand_name(
    graph: &Graph,
    tree: &Tree,
    node: NodeId,
    scope: &dyn Scope,
    bindings: &[(String, i64)],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(String, u32)> {
    let Node::Name { parts, order, .. } = tree.node(node) else {
        return None;
    };
    let mut name = String::new();
    for part in parts {
        match part {
            NamePart::Text(text) => name.push_str(text),
            NamePart::Index(index) => {
                let value = lower(graph, tree, *index, scope, bindings, diagnostics)?;
                let value = graph.as_number(value).and_then(to_i64);
                let Some(value) = value.filter(|value| *value >= 0) else {
                    diagnostics.push(index_error(tree.span(*index)));
                    return None;
                };
                name.push_str(&value.to_string());
            }
        }
    }
    Some((name, *order))
}

fn index_error(span: Span) -> Diagnostic {
    Diagnostic::error(
        "bad-index",
        span,
        "the index of a name must be an integer that is not negative, known from the sizes",
    )
}

enum Task {
    Enter(NodeId),
    Negate,
    /// The number of summands and which are subtracted.
    Add(Vec<bool>),
    /// For each factor, the place of a divisor or none.
    Multiply(Vec<Option<Span>>),
    Power(Span),
    Call(NodeId),
    Name(NodeId),
    Range(NodeId),
    Bind(String, i64),
    Unbind,
}

struct Machine<'a> {
    graph: &'a Graph,
    tree: &'a Tree,
    scope: &'a dyn Scope,
    bindings: Bindings,
    tasks: Vec<Task>,
    values: Vec<Expr>,
    failed: bool,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Machine<'_> {
    fn run(&mut self) {
        let mut steps = 0usize;
        while let Some(task) = self.tasks.pop() {
            steps += 1;
            if self.diagnostics.len() >= MOST_DIAGNOSTICS {
                // What follows would say the same again.
                self.failed = true;
                return;
            }
            if steps > MOST_STEPS {
                let whole = Span::empty(0);
                self.fail(Diagnostic::error(
                    "too-large",
                    whole,
                    "the sums of this expression have too many terms",
                ));
                return;
            }
            match task {
                Task::Enter(node) => self.enter(node),
                Task::Negate => {
                    let value = self.pop();
                    self.values.push(self.graph.neg(value));
                }
                Task::Add(signs) => self.add(&signs),
                Task::Multiply(divisors) => self.multiply(&divisors),
                Task::Power(span) => self.power(span),
                Task::Call(node) => self.call(node),
                Task::Name(node) => self.indexed_name(node),
                Task::Range(node) => self.range(node),
                Task::Bind(index, value) => self.bindings.push((index, value)),
                Task::Unbind => {
                    self.bindings.pop();
                }
            }
        }
    }

    fn pop(&mut self) -> Expr {
        self.values.pop().unwrap_or_else(|| self.graph.zero())
    }

    fn pop_many(&mut self, count: usize) -> Vec<Expr> {
        let from = self.values.len().saturating_sub(count);
        self.values.split_off(from)
    }

    /// Reports a problem once and goes on with a stand-in, so that the rest is looked at too. The stand-in is 1,
    /// which causes no problem of its own.
    fn fail(&mut self, diagnostic: Diagnostic) {
        self.failed = true;
        if !self.diagnostics.contains(&diagnostic) {
            self.diagnostics.push(diagnostic);
        }
    }

    fn fail_value(&mut self) {
        self.failed = true;
        self.values.push(self.graph.one());
    }

    fn enter(&mut self, id: NodeId) {
        let tree = self.tree;
        match tree.node(id) {
            Node::Number(value) => self.values.push(self.graph.number(value.clone())),
            Node::Name { parts, .. } => {
                self.tasks.push(Task::Name(id));
                let indices = parts.iter().filter_map(|part| match part {
                    NamePart::Index(index) => Some(Task::Enter(*index)),
                    NamePart::Text(_) => None,
                });
                self.tasks.extend(indices.rev());
            }
            Node::Negate(operand) => {
                self.tasks.push(Task::Negate);
                self.tasks.push(Task::Enter(*operand));
            }
            Node::Binary {
                operation: Binary::Power,
                left,
                right,
            } => {
                self.tasks.push(Task::Power(tree.span(id)));
                self.tasks.push(Task::Enter(*right));
                self.tasks.push(Task::Enter(*left));
            }
            Node::Binary {
                operation: Binary::Add | Binary::Subtract,
                ..
            } => self.enter_sum(id),
            Node::Binary { .. } => self.enter_product(id),
            Node::Call { arguments, .. } => {
                self.tasks.push(Task::Call(id));
                self.tasks.extend(
                    arguments
                        .iter()
                        .rev()
                        .map(|argument| Task::Enter(*argument)),
                );
            }
            Node::Sum { from, to, .. } => {
                self.tasks.push(Task::Range(id));
                self.tasks.push(Task::Enter(*to));
                self.tasks.push(Task::Enter(*from));
            }
            Node::Error => self.fail_value(),
        }
    }

    /// A chain of sums is one n-ary sum: adding one by one would copy the growing sum each time.
    fn enter_sum(&mut self, id: NodeId) {
        let mut signs = Vec::new();
        let mut operands = Vec::new();
        let mut at = id;
        while let Node::Binary {
            operation: operation @ (Binary::Add | Binary::Subtract),
            left,
            right,
        } = *self.tree.node(at)
        {
            signs.push(operation == Binary::Subtract);
            operands.push(right);
            at = left;
        }
        signs.push(false);
        operands.push(at);
        signs.reverse();
        self.tasks.push(Task::Add(signs));
        self.tasks.extend(operands.into_iter().map(Task::Enter));
    }

    fn enter_product(&mut self, id: NodeId) {
        let mut divisors = Vec::new();
        let mut operands = Vec::new();
        let mut at = id;
        while let Node::Binary {
            operation: operation @ (Binary::Multiply | Binary::Divide),
            left,
            right,
        } = *self.tree.node(at)
        {
            divisors.push((operation == Binary::Divide).then(|| self.tree.span(right)));
            operands.push(right);
            at = left;
        }
        divisors.push(None);
        operands.push(at);
        divisors.reverse();
        self.tasks.push(Task::Multiply(divisors));
        self.tasks.extend(operands.into_iter().map(Task::Enter));
    }

    fn add(&mut self, signs: &[bool]) {
        let mut values = self.pop_many(signs.len());
        for (value, subtracted) in values.iter_mut().zip(signs) {
            if *subtracted {
                *value = self.graph.neg(*value);
            }
        }
        self.values.push(self.graph.add(&values));
    }

    fn multiply(&mut self, divisors: &[Option<Span>]) {
        let mut values = self.pop_many(divisors.len());
        for (value, divisor) in values.iter_mut().zip(divisors) {
            if let Some(span) = divisor {
                if self.graph.is_zero(*value) {
                    self.fail(
                        Diagnostic::error("division-by-zero", *span, "division by zero")
                            .label("this is zero"),
                    );
                    *value = self.graph.one();
                }
                *value = self.graph.powi(*value, -1);
            }
        }
        self.values.push(self.graph.mul(&values));
    }

    fn power(&mut self, span: Span) {
        let exponent = self.pop();
        let base = self.pop();
        if let Some(value) = self.graph.as_number(exponent) {
            if self.graph.is_zero(base) && is_negative(value) {
                self.fail(Diagnostic::error(
                    "division-by-zero",
                    span,
                    "a negative power of zero",
                ));
                return self.fail_value();
            }
            if !value.is_int() && self.graph.as_number(base).is_some_and(is_negative) {
                self.fail(Diagnostic::error(
                    "not-real",
                    span,
                    "a fractional power of a negative number is not real",
                ));
                return self.fail_value();
            }
        }
        self.values.push(self.graph.pow(base, exponent));
    }

    fn call(&mut self, id: NodeId) {
        let Node::Call {
            function,
            arguments,
            power,
        } = self.tree.node(id)
        else {
            return;
        };
        let values = self.pop_many(arguments.len());
        let negative = values
            .first()
            .and_then(|value| self.graph.as_number(*value))
            .is_some_and(is_negative);
        let zero = values
            .first()
            .is_some_and(|value| self.graph.is_zero(*value));
        if (negative && *function == Builtin::Sqrt)
            || ((negative || zero) && *function == Builtin::Log)
        {
            let (span, name) = (self.tree.span(id), function.name());
            let of = if zero { "zero" } else { "a negative number" };
            self.fail(Diagnostic::error(
                "not-real",
                span,
                format!("`{name}` of {of} is not real"),
            ));
            return self.fail_value();
        }
        let value = match graph_function(*function) {
            Some(function) => self.graph.apply(function, &values),
            None => self.graph.sqrt(values[0]),
        };
        let value = match power {
            Some(power) => self.graph.pow(value, self.graph.number(power.clone())),
            None => value,
        };
        self.values.push(value);
    }

    fn indexed_name(&mut self, id: NodeId) {
        let Node::Name {
            parts,
            order,
            letters,
            before_parenthesis,
        } = self.tree.node(id)
        else {
            return;
        };
        let indices = parts
            .iter()
            .filter(|part| matches!(part, NamePart::Index(_)))
            .count();
        let mut values = self.pop_many(indices).into_iter();
        let mut name = String::new();
        for part in parts {
            match part {
                NamePart::Text(text) => name.push_str(text),
                NamePart::Index(index) => {
                    let value = values
                        .next()
                        .and_then(|value| self.graph.as_number(value))
                        .and_then(to_i64);
                    match value.filter(|value| *value >= 0) {
                        Some(value) => name.push_str(&value.to_string()),
                        None if self.failed => return self.fail_value(),
                        None => {
                            self.fail(index_error(self.tree.span(*index)));
                            return self.fail_value();
                        }
                    }
                }
            }
        }
        self.name(
            &name,
            *order,
            *before_parenthesis,
            self.tree.span(id),
            *letters,
        );
    }

    fn name(
        &mut self,
        name: &str,
        order: u32,
        before_parenthesis: bool,
        span: Span,
        letters: Span,
    ) {
        if let Some((_, value)) = self.bindings.iter().rev().find(|(index, _)| index == name) {
            let value = self.graph.integer(*value);
            if order == 0 {
                return self.values.push(value);
            }
            let message = format!("`{name}` is an index, an integer, and has no derivative");
            self.fail(Diagnostic::error("derivative-of-constant", span, message));
            return self.fail_value();
        }
        if name == "pi" {
            if order == 0 {
                return self.values.push(self.graph.pi());
            }
            self.fail(Diagnostic::error(
                "derivative-of-constant",
                span,
                "`pi` is a constant and has no derivative",
            ));
            return self.fail_value();
        }
        match self.scope.resolve(name, order) {
            Resolution::Known(value) => self.values.push(value),
            Resolution::Unknown => {
                let diagnostic = unknown_name(
                    name,
                    before_parenthesis,
                    letters,
                    self.scope,
                    &self.bindings,
                );
                self.fail(diagnostic);
                self.fail_value();
            }
            Resolution::Refused {
                code,
                message,
                hint,
            } => {
                let mut diagnostic = Diagnostic::error(code, span, message);
                if !hint.is_empty() {
                    diagnostic = diagnostic.hint(hint);
                }
                self.fail(diagnostic);
                self.fail_value();
            }
            Resolution::Failed => self.fail_value(),
        }
    }

    fn range(&mut self, id: NodeId) {
        let Node::Sum {
            index,
            from,
            to,
            body,
        } = self.tree.node(id)
        else {
            return;
        };
        let to_value = self.pop();
        let from_value = self.pop();
        let integer = |value: Expr| self.graph.as_number(value).and_then(to_i64);
        let (Some(first), Some(last)) = (integer(from_value), integer(to_value)) else {
            if !self.failed {
                let wrong = if integer(from_value).is_none() {
                    *from
                } else {
                    *to
                };
                self.fail(
                    Diagnostic::error(
                        "bad-range",
                        self.tree.span(wrong),
                        "the ends of a sum must be integers known from the sizes",
                    )
                    .hint("state sizes under [sizes], as in n = 3"),
                );
            }
            return self.fail_value();
        };
        if last.saturating_sub(first) >= MOST_TERMS {
            let message = format!("this sum has more than {MOST_TERMS} terms");
            self.fail(Diagnostic::error("too-large", self.tree.span(id), message));
            return self.fail_value();
        }
        let count =
            usize::try_from(last.saturating_sub(first).saturating_add(1).max(0)).unwrap_or(0);
        self.tasks.push(Task::Add(vec![false; count]));
        for value in (first..=last).rev() {
            self.tasks.push(Task::Unbind);
            self.tasks.push(Task::Enter(*body));
            self.tasks.push(Task::Bind(index.clone(), value));
        }
    }
}

/// The function of the graph; none for the square root, which is a power there.
fn graph_function(function: Builtin) -> Option<Function> {
    Some(match function {
        Builtin::Sin => Function::Sin,
        Builtin::Cos => Function::Cos,
        Builtin::Tan => Function::Tan,
        Builtin::Cot => Function::Cot,
        Builtin::Sec => Function::Sec,
        Builtin::Csc => Function::Csc,
        Builtin::Asin => Function::Asin,
        Builtin::Acos => Function::Acos,
        Builtin::Atan => Function::Atan,
        Builtin::Atan2 => Function::Atan2,
        Builtin::Sinh => Function::Sinh,
        Builtin::Cosh => Function::Cosh,
        Builtin::Tanh => Function::Tanh,
        Builtin::Asinh => Function::Asinh,
        Builtin::Acosh => Function::Acosh,
        Builtin::Atanh => Function::Atanh,
        Builtin::Exp => Function::Exp,
        Builtin::Log => Function::Log,
        Builtin::Abs => Function::Abs,
        Builtin::Sign => Function::Sign,
        Builtin::Sqrt => return None,
    })
}
