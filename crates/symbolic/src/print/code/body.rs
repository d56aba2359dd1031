//! The statements of a function: the inputs by name, the local variables, the outputs.

use super::expression::{signed, Writer};
use super::function::Head;
use super::language::Language;
use super::local::LONGEST_STATEMENT;
use super::names::Names;
use super::term::{list, product, push_wrapped, quotient, sum, Text};
use super::CodeFunction;
use crate::node::{Expr, Node, Symbol};
use crate::rational;
use rustc_hash::FxHashSet;

/// How many names of each kind have been given.
#[derive(Default)]
struct Counts {
    values: usize,
    matrices: usize,
    solutions: usize,
}

/// The statements of a function.
pub(super) struct Body<'a> {
    writer: Writer<'a>,
    names: Names,
    counts: Counts,
    /// Name of the array in which matrices are eliminated.
    work: String,
    /// All names of local variables, in the order in which they were given.
    given: Vec<String>,
    out: String,
}

impl<'a> Body<'a> {
    /// No statements yet; `names` are those of the arguments and symbols.
    pub(super) fn new(writer: Writer<'a>, names: Names) -> Body<'a> {
        Body {
            writer,
            names,
            counts: Counts::default(),
            work: String::new(),
            given: Vec::new(),
            out: String::new(),
        }
    }

    /// The statements so far.
    pub(super) fn text(&self) -> &str {
        &self.out
    }

    /// The names of local variables that are defined so far.
    pub(super) fn names_given(&self) -> impl Iterator<Item = &str> {
        self.given.iter().map(String::as_str)
    }

    fn statement(&mut self, text: &str) {
        push_wrapped(&format!("{text};"), 4, &mut self.out);
    }

    fn define(&mut self, name: &str, value: &str) {
        let definition = self.writer.language.definition(name, value);
        self.statement(&definition);
        self.given.push(name.to_string());
    }

    /// Gives the entries that are used the names of the model.
    pub(super) fn inputs(&mut self, function: &CodeFunction<'_>, head: &Head<'_>) {
        let locals = self.writer.locals;
        let sequence = locals.sequence.iter();
        let used: FxHashSet<Symbol> = sequence.filter_map(|&e| locals.g.as_symbol(e)).collect();
        let mut defined: FxHashSet<Symbol> = function.time.into_iter().collect();
        let mut ignored: Vec<String> = Vec::new();
        if function.time.is_some_and(|t| !used.contains(&t)) {
            ignored.extend(head.time.clone());
        }
        for ((array, _), (_, symbols)) in head.inputs.iter().zip(&function.inputs) {
            let mut is_read = false;
            for (place, symbol) in symbols.iter().enumerate() {
                if used.contains(symbol) && defined.insert(*symbol) {
                    let name = self.writer.symbols[symbol].clone();
                    self.define(&name, &format!("{array}[{place}]"));
                    is_read = true;
                }
            }
            if !is_read {
                ignored.push(array.clone());
            }
        }
        let empty = head.outputs.iter().filter(|(_, length)| *length == 0);
        ignored.extend(empty.map(|(name, _)| name.clone()));
        for name in ignored {
            let statement = self.writer.language.ignored(&name);
            self.statement(&statement);
        }
    }

    /// Room for the elimination of the largest matrix.
    fn work_array(&mut self) {
        let locals = self.writer.locals;
        let sizes = locals.sequence.iter().map(|&e| match locals.g.node(e) {
            Node::Matrix { entries, .. } => entries.len(),
            _ => 0,
        });
        let size = sizes.max().unwrap_or(0);
        if size == 0 {
            return;
        }
        self.writer.helpers.solve = true;
        let work = self.names.free("work");
        self.statement(&match self.writer.language {
            Language::C => format!("double {work}[{size}]"),
            Language::Rust => format!("let mut {work} = [0.0; {size}]"),
        });
        self.work = work;
    }

    /// The statements that compute the local variables.
    pub(super) fn locals(&mut self) {
        self.work_array();
        let locals = self.writer.locals;
        for &e in &locals.sequence {
            self.local(e);
        }
    }

    /// The statements that compute `e`, if it is a local variable.
    fn local(&mut self, e: Expr) {
        if !self.writer.locals.is_local(e) {
            return;
        }
        match self.writer.locals.g.node(e) {
            Node::Matrix {
                columns, entries, ..
            } => self.matrix(e, *columns as usize, entries),
            Node::Solve { matrix, rhs } => self.solve(e, *matrix, rhs),
            _ => {
                let value = self.in_parts(e);
                let name = self.name(e);
                self.define(&name, &value.text);
                self.writer.names.insert(e, name);
            }
        }
    }

    /// `sin_phi` for the sine of a symbol, otherwise the next number.
    fn name(&mut self, e: Expr) -> String {
        if let Node::Apply {
            function,
            arguments,
        } = self.writer.locals.g.node(e)
        {
            if let [x] = arguments[..] {
                if let Some(symbol) = self.writer.locals.g.as_symbol(x) {
                    let argument = &self.writer.symbols[&symbol];
                    return self.names.free(&format!("{}_{argument}", function.name()));
                }
            }
        }
        self.names.numbered("w", &mut self.counts.values)
    }
    /// The text that computes `e`; a long sum or product is computed in several statements.
    fn in_parts(&mut self, e: Expr) -> Text {
        match self.writer.locals.g.node(e) {
            Node::Sum { constant, terms } if terms.len() >= LONGEST_STATEMENT => {
                let terms = self.writer.terms(constant, terms);
                let parts = self.chain(terms, sum, |text| (false, text));
                sum(&parts)
            }
            Node::Product {
                coefficient,
                factors,
            } if factors.len() > LONGEST_STATEMENT => {
                let sorted = self.writer.locals.sorted_factors(factors);
                let (above, below) = self.writer.fraction(coefficient, &sorted);
                let above = self.chain(above, product, |text| text);
                let below = self.chain(below, product, |text| text);
                signed((rational::is_negative(coefficient), quotient(&above, &below)))
            }
            _ => self.writer.written_out(e),
        }
    }

    /// Defines partial results until the rest fits in one statement; the rest begins with the last of them.
    fn chain<T>(
        &mut self,
        parts: Vec<T>,
        joined: impl Fn(&[T]) -> Text,
        part: impl Fn(Text) -> T,
    ) -> Vec<T> {
        let mut rest: Vec<T> = Vec::with_capacity(LONGEST_STATEMENT + 1);
        for next in parts {
            if rest.len() == LONGEST_STATEMENT {
                let name = self.names.numbered("w", &mut self.counts.values);
                self.define(&name, &joined(&rest).text);
                rest.clear();
                rest.push(part(Text::atom(name)));
            }
            rest.push(next);
        }
        rest
    }

    fn matrix(&mut self, e: Expr, columns: usize, entries: &[Expr]) {
        let name = self.names.numbered("matrix", &mut self.counts.matrices);
        let length = entries.len();
        let (open, close) = match self.writer.language {
            Language::C => (format!("const double {name}[{length}] = {{"), "};"),
            Language::Rust => (format!("let {name}: [f64; {length}] = ["), "];"),
        };
        push_wrapped(&open, 4, &mut self.out);
        for row in entries.chunks(columns.max(1)) {
            let row: Vec<String> = row.iter().map(|&a| self.writer.value(a).text).collect();
            push_wrapped(&format!("{},", list(&row)), 8, &mut self.out);
        }
        push_wrapped(close, 4, &mut self.out);
        self.writer.names.insert(e, name);
    }

    fn solve(&mut self, e: Expr, matrix: Expr, rhs: &[Expr]) {
        let name = self.names.numbered("solution", &mut self.counts.solutions);
        let n = rhs.len();
        let entries: Vec<String> = rhs.iter().map(|&b| self.writer.value(b).text).collect();
        let entries = list(&entries);
        let matrix = self.writer.value(matrix).text;
        let work = &self.work;
        let (definition, call) = match self.writer.language {
            Language::C => (
                format!("double {name}[{n}] = {{{entries}}}"),
                format!("if (chetaev_solve({n}, {matrix}, {work}, {name}) != 0) {{\n        return 1;\n    }}"),
            ),
            Language::Rust => {
                let size = n * n;
                (
                    format!("let mut {name}: [f64; {n}] = [{entries}]"),
                    format!("chetaev_solve(&{matrix}, &mut {work}[..{size}], &mut {name})?;"),
                )
            }
        };
        self.statement(&definition);
        push_wrapped(&call, 4, &mut self.out);
        self.writer.names.insert(e, name);
    }

    /// Writes the results, after everything has been read.
    pub(super) fn outputs(&mut self, function: &CodeFunction<'_>, head: &Head<'_>) {
        for ((array, _), (_, entries)) in head.outputs.iter().zip(&function.outputs) {
            for (place, &e) in entries.iter().enumerate() {
                let value = self.writer.value(e);
                self.statement(&format!("{array}[{place}] = {}", value.text));
            }
        }
    }
}
