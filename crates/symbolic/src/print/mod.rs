//! Printers of expressions: the model file's own text, LaTeX, MathML, SymPy source, and a JSON tree.
//!
//! One layout decides the notation for all formats: fractions, signs, roots, the order of factors and terms. Large
//! expressions are printed with named intermediate results, so that the output stays in proportion to the graph; a
//! linear solve is printed as the system that it solves.
//!
//! Reading the text of an expression gives the expression again, wherever the expression is defined.

mod array;
mod code;
mod display;
mod document;
mod formula;
mod json;
mod latex;
mod layout;
mod mathml;
mod names;
mod operations;
mod order;
mod share;
mod symbol;
mod sympy;
mod text;

#[cfg(test)]
mod tests;

pub use array::{array_function, ArrayFunction, ArrayLanguage};
pub use code::{source_code, CodeError, CodeFunction, Language};
pub use document::Document;
pub use names::{as_stated, with_indices};
pub use operations::Operations;
pub use symbol::{StatedSymbol, SymbolError};
pub use sympy::{sympy_module, PythonSection};

use crate::graph::Graph;
use crate::node::Expr;
use document::{Builder, Name, Statement};
use order::Order;
use share::Plan;
use std::collections::BTreeMap;

/// A language to print in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// The syntax of the model file; see [`syntax`](crate::syntax). Algebraic numbers have none there, and are written as
    /// `root(x^5 - x - 1, 1.167…)`.
    Text,
    /// LaTeX for mathematical mode; needs the package amsmath.
    Latex,
    /// Presentation MathML within MathML Core (W3C 2025).
    Mathml,
    /// Python source for SymPy, imported as `sp`; what depends on the time is a `Function` of `t`, a derivative is
    /// `x.diff(t, 2)`.
    Sympy,
    /// Nested arrays with the operator first, such as `["Add","x",["Power","y",2]]`.
    Json,
}

/// How to print.
#[derive(Clone, Debug)]
pub struct Options {
    /// The coordinates in the order in which terms are to be written. Names with derivatives are taken for
    /// coordinates without being listed.
    pub coordinates: Vec<String>,
    /// The parameters in the order in which factors are to be written; others follow in alphabetic order, masses
    /// first.
    pub parameters: Vec<String>,
    /// Other names to typeset: `u_1` as `omega_1`, `A_z_x` as [`with_indices`] writes it, a symbol in LaTeX as
    /// [`as_stated`] does. Used by LaTeX and MathML, not by
    /// the languages that are read again.
    pub display: BTreeMap<String, String>,
    /// Number of nodes per expression from which repeated parts are given names.
    pub max_nodes: u64,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            coordinates: Vec::new(),
            parameters: Vec::new(),
            display: BTreeMap::new(),
            max_nodes: 600,
        }
    }
}

/// A document in one format, statement by statement.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Parts {
    /// One for each expression or equation, in the given order.
    pub statements: Vec<String>,
    /// The definitions of names that the statements use; each uses only names defined before it.
    pub definitions: Vec<String>,
}

/// Each prints with the default [`Options`]. A large expression comes with its intermediate results: in text, lines
/// after "where".
impl Graph {
    /// `e` in the syntax of the model file.
    pub fn text(&self, e: Expr) -> String {
        self.render(e, Format::Text)
    }

    /// `e` in LaTeX, for mathematical mode.
    pub fn latex(&self, e: Expr) -> String {
        self.render(e, Format::Latex)
    }

    /// `e` as a MathML `<math>` element.
    pub fn mathml(&self, e: Expr) -> String {
        self.render(e, Format::Mathml)
    }

    /// `e` as a Python expression for SymPy.
    pub fn sympy(&self, e: Expr) -> String {
        self.render(e, Format::Sympy)
    }

    /// `e` as a JSON tree.
    pub fn json(&self, e: Expr) -> String {
        self.render(e, Format::Json)
    }

    fn render(&self, e: Expr, format: Format) -> String {
        Document::expressions(self, &[e], &Options::default()).render(format)
    }
}

impl Document {
    /// Lays out expressions.
    pub fn expressions(g: &Graph, expressions: &[Expr], options: &Options) -> Document {
        lay_out(g, expressions, options, |builder| {
            let statement = |&e| Statement::Expression(builder.formula(|layout| layout.formula(e)));
            expressions.iter().map(statement).collect()
        })
    }

    /// Lays out equations `left = right`.
    pub fn equations(g: &Graph, equations: &[(Expr, Expr)], options: &Options) -> Document {
        let roots: Vec<Expr> = equations.iter().flat_map(|&(l, r)| [l, r]).collect();
        lay_out(g, &roots, options, |builder| {
            let statement = |&(left, right)| {
                let left = builder.formula(|layout| layout.formula(left));
                let right = builder.formula(|layout| layout.formula(right));
                Statement::Equation(left, right)
            };
            equations.iter().map(statement).collect()
        })
    }

    /// Lays out a matrix with `columns` columns, given row by row.
    pub fn matrix(g: &Graph, columns: usize, entries: &[Expr], options: &Options) -> Document {
        lay_out(g, entries, options, |builder| {
            let matrix = builder.formula(|layout| layout.matrix(columns, entries));
            vec![Statement::Expression(matrix)]
        })
    }

    /// The whole document as one text: the statements, then the definitions.
    pub fn render(&self, format: Format) -> String {
        match format {
            Format::Text => self.text(),
            Format::Latex => self.latex(),
            Format::Mathml => self.mathml(),
            Format::Sympy => self.sympy(),
            Format::Json => self.json(),
        }
    }

    /// Every statement and definition by itself.
    pub fn parts(&self, format: Format) -> Parts {
        match format {
            Format::Text => self.text_parts(),
            Format::Latex => self.latex_parts(),
            Format::Mathml => self.mathml_parts(),
            Format::Sympy => self.sympy_parts(),
            Format::Json => self.json_parts(),
        }
    }

    /// Number of definitions: zero where every statement is complete in itself.
    pub fn definition_count(&self) -> usize {
        self.definitions.len()
    }
}

fn lay_out(
    g: &Graph,
    roots: &[Expr],
    options: &Options,
    statements: impl FnOnce(&mut Builder<'_>) -> Vec<Statement>,
) -> Document {
    let budget = options.max_nodes.saturating_mul(roots.len() as u64);
    let plan = Plan::new(g, roots, budget);
    let order = Order::new(g, roots, options);
    let names = names_in(g, roots, options);
    let taken = names.iter().map(|name| name.name.as_str());
    let listed = options.parameters.iter().chain(&options.coordinates);
    let taken: Vec<&str> = taken.chain(listed.map(String::as_str)).collect();
    let mut builder = Builder::new(g, &plan, &order, &taken);
    let statements = statements(&mut builder);
    builder.finish(statements, names, options)
}

/// The names of the model that occur, in alphabetic order.
fn names_in(g: &Graph, roots: &[Expr], options: &Options) -> Vec<Name> {
    let mut names: Vec<Name> = Vec::new();
    for symbol in g.symbols_in(roots) {
        let name = g.symbol_name(symbol);
        let moves = g.symbol_order(symbol) > 0 || options.coordinates.iter().any(|c| c == name);
        match names.last_mut() {
            Some(last) if last.name == name => last.moves |= moves,
            _ => names.push(Name {
                name: name.to_string(),
                moves,
            }),
        }
    }
    names
}
