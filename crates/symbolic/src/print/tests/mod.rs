//! What the tests share: reading text back.

mod display;
mod laws;
mod notation;
mod sharing;

use super::{Document, Format, Options};
use crate::graph::Graph;
use crate::node::Expr;
use crate::syntax::{lower, parse_equation, parse_expression, Resolution, Scope};
use std::collections::BTreeMap;

/// Every name is a symbol, apart from those given an expression.
struct Names<'a> {
    g: &'a Graph,
    defined: BTreeMap<String, Expr>,
}

impl Scope for Names<'_> {
    fn resolve(&self, name: &str, order: u32) -> Resolution {
        let defined = self.defined.get(name).filter(|_| order == 0).copied();
        Resolution::Known(defined.unwrap_or_else(|| self.g.symbol(name, order)))
    }

    fn names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// One side of an equation, or an expression, and not even a warning: what is printed has one reading.
fn read_side(g: &Graph, text: &str, side: usize, defined: &mut BTreeMap<String, Expr>) -> Expr {
    let parsed = if text.contains('=') {
        parse_equation(text)
    } else {
        parse_expression(text)
    };
    let scope = Names {
        g,
        defined: std::mem::take(defined),
    };
    let mut diagnostics = parsed.diagnostics.clone();
    let e = lower(
        g,
        &parsed.tree,
        parsed.sides[side],
        &scope,
        &[],
        &mut diagnostics,
    );
    *defined = scope.defined;
    assert!(diagnostics.is_empty(), "{text}\n{diagnostics:?}");
    e.unwrap()
}

fn read(g: &Graph, text: &str) -> Expr {
    read_side(g, text, 0, &mut BTreeMap::new())
}

/// Reads the definitions one after the other, then the statements.
fn read_document(g: &Graph, document: &Document) -> Vec<Expr> {
    let mut defined = BTreeMap::new();
    let parts = document.parts(Format::Text);
    for line in &parts.definitions {
        let (name, _) = line.split_once(" = ").unwrap();
        let value = read_side(g, line, 1, &mut defined);
        defined.insert(name.to_string(), value);
    }
    let statements = parts.statements.iter();
    statements
        .map(|text| read_side(g, text, 0, &mut defined))
        .collect()
}

fn options(coordinates: &[&str]) -> Options {
    Options {
        coordinates: coordinates.iter().map(|c| c.to_string()).collect(),
        ..Options::default()
    }
}
