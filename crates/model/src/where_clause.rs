//! Expressions as they are printed: what is long has names for its parts, whose definitions stand below a line `where`.
//!
//! A definition is `name = value`, or a row of a linear system in names that its rows determine together. Each uses only names
//! that are defined above it.

use chetaev_symbolic::syntax::{lower, parse_equation, Parsed, Resolution, Scope, Span};
use chetaev_symbolic::{Expr, Graph};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::source::{Place, Sources};
use crate::text::Text;

/// The text before a line `where`, and the definitions after it, each in one line; `None` where there is no such line.
pub(crate) fn split(text: &str) -> Option<(String, Vec<String>)> {
    let lines: Vec<&str> = text.lines().collect();
    let at = lines.iter().position(|line| line.trim() == "where")?;
    let mut definitions: Vec<String> = Vec::new();
    for line in lines
        .iter()
        .skip(at + 1)
        .filter(|line| !line.trim().is_empty())
    {
        match definitions.last_mut() {
            // A line without an equals sign goes on with what stands above it.
            Some(last) if !line.contains('=') => *last = format!("{last} {}", line.trim()),
            _ => definitions.push(line.trim().to_owned()),
        }
    }
    Some((lines[..at].join(" "), definitions))
}

/// The names of a scope, and those that are defined below `where`.
pub(crate) struct Defined<'s> {
    graph: &'s Graph,
    scope: &'s dyn Scope,
    values: BTreeMap<String, Expr>,
    /// The rows of a system that is not complete yet.
    rows: Vec<(Expr, Expr)>,
    /// The names that these rows are to determine.
    unknowns: RefCell<BTreeSet<String>>,
    /// Whether a name that nothing is called is such an unknown.
    is_left: bool,
}

impl Scope for Defined<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        if let (Some(value), 0) = (self.values.get(name), order) {
            return Resolution::Known(*value);
        }
        match self.scope.resolve(name, order) {
            Resolution::Unknown if order == 0 && self.is_left => {
                self.unknowns.borrow_mut().insert(name.to_owned());
                Resolution::Known(self.graph.symbol(name, 0))
            }
            found => found,
        }
    }

    fn names(&self) -> Vec<String> {
        let mut names = self.scope.names();
        names.extend(self.values.keys().cloned());
        names
    }
}

impl<'s> Defined<'s> {
    /// Reads definitions.
    ///
    /// # Errors
    /// Everything that is wrong with the first of them that cannot be read.
    pub(crate) fn new(
        graph: &'s Graph,
        scope: &'s dyn Scope,
        definitions: &[String],
    ) -> Result<Defined<'s>, Diagnostics> {
        let mut own = Defined {
            graph,
            scope,
            values: BTreeMap::new(),
            rows: Vec::new(),
            unknowns: RefCell::default(),
            is_left: false,
        };
        for line in definitions {
            own.define(line)?;
        }
        if own.rows.is_empty() {
            return Ok(own);
        }
        Err(own.undetermined(definitions.last().map_or("", String::as_str)))
    }

    fn define(&mut self, line: &str) -> Result<(), Diagnostics> {
        let parsed = parse_equation(line);
        let right = self.side(line, &parsed, 1)?;
        let (left, _) = line.split_once('=').unwrap_or((line, ""));
        let name = left.trim();
        let is_name = name
            .chars()
            .all(|sign| sign.is_alphanumeric() || sign == '_');
        if self.rows.is_empty() && is_name {
            self.values.insert(name.to_owned(), right);
            return Ok(());
        }
        self.is_left = true;
        let left = self.side(line, &parsed, 0);
        self.is_left = false;
        self.rows.push((left?, right));
        if self.rows.len() < self.unknowns.borrow().len() {
            return Ok(());
        }
        self.solve(line)
    }

    fn side(&self, line: &str, parsed: &Parsed, side: usize) -> Result<Expr, Diagnostics> {
        let mut sources = Sources::default();
        let source = sources.add("expression", line);
        let located = Text::verbatim(line, source, 0);
        let mut found = parsed.diagnostics.clone();
        let root = parsed.sides.get(side).copied().unwrap_or(parsed.root());
        let value = lower(self.graph, &parsed.tree, root, self, &[], &mut found);
        let list = found
            .iter()
            .map(|own| Diagnostic::of_expression(own, &located));
        let diagnostics = Diagnostics {
            list: list.collect(),
            sources,
        };
        match value {
            Some(value) if !diagnostics.has_errors() => Ok(value),
            _ => Err(diagnostics),
        }
    }

    /// The unknowns of as many rows, as one linear system.
    fn solve(&mut self, line: &str) -> Result<(), Diagnostics> {
        let g = self.graph;
        let names: Vec<String> = self.unknowns.take().into_iter().collect();
        let symbols: Vec<_> = names.iter().map(|name| g.intern_symbol(name, 0)).collect();
        let rows = std::mem::take(&mut self.rows);
        let lefts: Vec<Expr> = rows.iter().map(|(left, _)| *left).collect();
        let entries: Vec<Expr> = g.jacobian(&lefts, &symbols).concat();
        let none: Vec<(Expr, Expr)> = names
            .iter()
            .map(|name| (g.symbol(name, 0), g.zero()))
            .collect();
        let constants = g.substitute_all(&lefts, &none);
        let rhs: Vec<Expr> = rows
            .iter()
            .zip(constants)
            .map(|((_, right), constant)| g.sub(*right, constant))
            .collect();
        let is_linear = !g
            .symbols_in(&entries)
            .iter()
            .any(|symbol| symbols.contains(symbol));
        match g.solve(&entries, &rhs) {
            Ok(solution) if is_linear && !names.is_empty() => {
                self.values.extend(names.into_iter().zip(solution));
                Ok(())
            }
            _ => Err(self.undetermined(line)),
        }
    }

    fn undetermined(&self, line: &str) -> Diagnostics {
        let mut sources = Sources::default();
        let source = sources.add("expression", line);
        let place = Place {
            source,
            span: Span::new(0, line.len()),
        };
        let message = "the rows below `where` are no linear system that determines its unknowns";
        Diagnostics {
            list: vec![Diagnostic::error("not-a-system", place, message.to_owned())],
            sources,
        }
    }
}
