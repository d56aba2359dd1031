//! Circles of imports: a file is a module, every path in it that names a module is an edge, and a circle is a set of modules each
//! of which reaches all others (a strongly connected component; Tarjan 1972).

use super::source::{ModulePath, Modules};
use std::collections::{BTreeMap, BTreeSet};

/// Which paths are edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edges {
    /// Those that begin with `crate::` or `super::`.
    Outwards,
    /// Those that begin with the name of a module inside the own one as well.
    All,
}

/// The circles of a crate with more than one module, the largest first; modules as `a::b`.
pub(crate) fn circles(modules: &Modules, edges: Edges) -> Vec<Vec<String>> {
    let names: Vec<&ModulePath> = modules.keys().collect();
    let numbers: BTreeMap<&ModulePath, usize> = names.iter().copied().zip(0..).collect();
    let edges: Vec<BTreeSet<usize>> = modules
        .iter()
        .map(|(path, source)| {
            let mut named = paths(path, &source.code);
            if edges == Edges::All {
                named.extend(inwards(path, &source.code, modules));
            }
            let targets = named.iter().filter_map(|named| target(named, &numbers));
            targets.filter(|to| names[*to] != path).collect()
        })
        .collect();
    let mut found: Vec<Vec<String>> = components(&edges)
        .into_iter()
        .filter(|members| members.len() > 1)
        .map(|members| members.iter().map(|m| shown(names[*m])).collect())
        .collect();
    found.sort_by_key(|members| std::cmp::Reverse(members.len()));
    found
}

fn shown(path: &[String]) -> String {
    match path {
        [] => "crate".to_owned(),
        path => path.join("::"),
    }
}

/// The module that a path names, or in which the item lies that it names: the longest beginning that is a module.
fn target(named: &[String], numbers: &BTreeMap<&ModulePath, usize>) -> Option<usize> {
    (0..=named.len())
        .rev()
        .find_map(|length| numbers.get(&named[..length].to_vec()).copied())
}

/// Everything that the code of a module names from the root of the crate or from the modules around it.
fn paths(module: &[String], code: &str) -> Vec<ModulePath> {
    let tokens = tokens(code);
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let mut base: ModulePath = module.to_vec();
        let mut next = at;
        let starts = at == 0 || tokens[at - 1] != "::";
        match tokens[at] {
            "crate" if starts && tokens.get(at + 1) == Some(&"::") => {
                base.clear();
                next = at + 2;
            }
            "super" if starts => {
                while tokens.get(next) == Some(&"super") && tokens.get(next + 1) == Some(&"::") {
                    base.pop();
                    next += 2;
                }
            }
            _ => {}
        }
        if next > at {
            next = tree(&tokens, next, &base, &mut found);
        }
        at = next.max(at + 1);
    }
    found
}

/// Everything that the code of a module names by the modules inside it.
fn inwards(module: &[String], code: &str, modules: &Modules) -> Vec<ModulePath> {
    let tokens = tokens(code);
    let mut found = Vec::new();
    for at in 0..tokens.len() {
        let starts = at == 0 || tokens[at - 1] != "::" || tokens[at.saturating_sub(2)] == "self";
        if starts && tokens.get(at + 1) == Some(&"::") {
            let child: ModulePath = module.iter().cloned().chain([tokens[at].into()]).collect();
            if modules.contains_key(&child) {
                tree(&tokens, at, module, &mut found);
            }
        }
    }
    found
}

/// Reads `a::b::{c, d::e, *}` from a place on; returns the place behind it.
fn tree(tokens: &[&str], mut at: usize, base: &[String], found: &mut Vec<ModulePath>) -> usize {
    let mut path = base.to_vec();
    loop {
        match tokens.get(at) {
            Some(&"{") => {
                at += 1;
                while at < tokens.len() && tokens[at] != "}" {
                    at = tree(tokens, at, &path, found).max(at + 1);
                    while tokens.get(at) == Some(&"as") {
                        at += 2;
                    }
                    if tokens.get(at) == Some(&",") {
                        at += 1;
                    }
                }
                return at + 1;
            }
            Some(word) if word.starts_with(|c: char| c.is_alphabetic() || c == '_') => {
                if *word != "self" {
                    path.push((*word).to_owned());
                }
                at += 1;
            }
            _ => {
                found.push(path);
                return at;
            }
        }
        if tokens.get(at) == Some(&"::") {
            at += 1;
        } else {
            found.push(path);
            return at;
        }
    }
}

/// Words, `::` and single signs.
fn tokens(code: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = if rest.starts_with("::") {
            2
        } else if is_word(first) {
            rest.find(|c: char| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        if !first.is_whitespace() {
            found.push(&rest[..length]);
        }
        rest = &rest[length..];
    }
    found
}

/// Strongly connected components by Tarjan's algorithm.
fn components(edges: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let mut search = Search {
        edges,
        order: vec![None; edges.len()],
        lowest: vec![0; edges.len()],
        open: Vec::new(),
        is_open: vec![false; edges.len()],
        count: 0,
        found: Vec::new(),
    };
    for node in 0..edges.len() {
        if search.order[node].is_none() {
            search.visit(node);
        }
    }
    search.found
}

struct Search<'e> {
    edges: &'e [BTreeSet<usize>],
    order: Vec<Option<usize>>,
    lowest: Vec<usize>,
    open: Vec<usize>,
    is_open: Vec<bool>,
    count: usize,
    found: Vec<Vec<usize>>,
}

impl Search<'_> {
    fn visit(&mut self, node: usize) {
        let own = self.count;
        self.count += 1;
        self.order[node] = Some(own);
        self.lowest[node] = own;
        self.open.push(node);
        self.is_open[node] = true;
        let edges = self.edges;
        for &next in &edges[node] {
            match self.order[next] {
                None => {
                    self.visit(next);
                    self.lowest[node] = self.lowest[node].min(self.lowest[next]);
                }
                Some(order) if self.is_open[next] => {
                    self.lowest[node] = self.lowest[node].min(order);
                }
                Some(_) => {}
            }
        }
        if self.lowest[node] == own {
            self.close(node);
        }
    }

    /// Everything above the node is in its component.
    fn close(&mut self, node: usize) {
        let start = self.open.iter().rposition(|open| *open == node);
        let mut members = self.open.split_off(start.unwrap_or(0));
        for &member in &members {
            self.is_open[member] = false;
        }
        members.sort_unstable();
        self.found.push(members);
    }
}

#[cfg(test)]
mod tests {
    use super::super::source::read;
    use super::*;

    fn crate_of(files: &[(&str, &str)]) -> Modules {
        let module = |path: &str| -> ModulePath {
            path.split("::")
                .filter(|part| !part.is_empty())
                .map(str::to_owned)
                .collect()
        };
        files
            .iter()
            .map(|(path, text)| (module(path), read(text).0))
            .collect()
    }

    #[test]
    fn a_circle_is_found_and_a_chain_is_none() {
        let modules = crate_of(&[
            ("", "pub mod a; pub mod b; pub mod c;"),
            ("a", "use crate::b::{self, thing as other, inner::Deep};\n"),
            ("b", "fn f() -> crate::c::C { super::a::g() }\n"),
            ("b::inner", "use super::super::c; use super::Item;\n"),
            ("c", "// crate::a\nconst A: &str = \"crate::a\";\n"),
        ]);
        assert_eq!(circles(&modules, Edges::Outwards), [["a", "b", "b::inner"]]);
    }

    #[test]
    fn circles_that_touch_nowhere_are_two() {
        let modules = crate_of(&[
            ("a", "use crate::b;"),
            ("b", "use crate::a;"),
            ("c", "use crate::d; use crate::a;"),
            ("d", "use crate::{e}; "),
            ("e", "use super::c::x;"),
        ]);
        let found = circles(&modules, Edges::Outwards);
        assert_eq!(found, vec![vec!["c", "d", "e"], vec!["a", "b"]]);
    }

    #[test]
    fn a_module_and_those_inside_it_are_a_circle_where_the_names_inside_count() {
        let modules = crate_of(&[
            ("a", "mod b; pub use b::f; fn g() { self::c::h() }"),
            ("a::b", "use super::g;"),
            ("a::c", "use super::g;"),
        ]);
        assert!(circles(&modules, Edges::Outwards).is_empty());
        assert_eq!(circles(&modules, Edges::All), [["a", "a::b", "a::c"]]);
    }
}
