//! From a model file to functionals, with every problem at its place.

mod assumptions;
mod declare;
mod family;
mod functions;
mod living;
mod names;
mod relations;
mod ritz;
mod solutions;
mod statements;
mod symmetry;
mod vocabulary;

use self::names::written_out;
use crate::functional::{Functional, Problem};
use crate::notation::{check, free_letters, parse, parse_sides, Node};
use crate::space::Space;
use crate::tensors::Scope;
use chetaev_model::model::ModelText;
use chetaev_model::raw::{Kind, Raw, Table};
use chetaev_model::{tables, Diagnostic, Diagnostics, Files, Place, Sources, Text};
use chetaev_symbolic::syntax::names::closest;
use chetaev_symbolic::syntax::Span;
use chetaev_symbolic::Expr;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

pub(crate) use statements::on_side;

/// What reading gives: the problem where it has no error, and everything there is to say about it.
#[derive(Debug)]
pub struct Loaded {
    /// What the file states; none where there is an error.
    pub problem: Option<Problem>,
    /// Errors and warnings with their texts.
    pub diagnostics: Diagnostics,
}

/// Keys of a model file of a functional.
const KEYS: &[&str] = &[
    "kind",
    "name",
    "level",
    "description",
    "history",
    "source",
    "sizes",
    "assumptions",
    "domain",
    "fields",
    "data",
    "parameters",
    "functions",
    "define",
    "density",
    "boundary",
    "equations",
    "imposed",
    "solvable",
    "yields",
    "multipliers",
    "duality",
    "descent",
    "degenerations",
    "solutions",
    "family",
    "symmetries",
    "ritz",
    "expect",
];

/// Reads a functional; `overrides` change sizes and parameters. Files that it names are read through `files`.
pub fn load(path: &str, text: &str, files: &dyn Files, overrides: &[(String, String)]) -> Loaded {
    let tables = tables(path, text, files, overrides, Sources::default());
    let mut reader = Reader {
        files,
        sources: tables.sources,
        problems: tables.diagnostics,
        text: tables.text,
        overrides: tables.overrides,
        used: Vec::new(),
        puts_in_values: false,
    };
    let place = Place {
        source: tables.source,
        span: Span::new(0, text.len().min(1)),
    };
    let problem = match tables.table.map(written_out) {
        Some(table) => {
            let mut problem = reader.problem(&table, place);
            reader.unused_overrides();
            if let Some(own) = problem.as_mut().filter(|own| own.has_values()) {
                own.valued = reader.with_values(&table, place).map(Box::new);
            }
            problem
        }
        None => None,
    };
    let mut diagnostics = Diagnostics {
        sources: reader.sources,
        list: Vec::new(),
    };
    for diagnostic in reader.problems {
        diagnostics.push(diagnostic);
    }
    diagnostics.sort();
    Loaded {
        problem: problem.filter(|_| !diagnostics.has_errors()),
        diagnostics,
    }
}

/// Reads a functional again from the texts that were kept.
pub fn reload(text: &ModelText) -> Loaded {
    let files: BTreeMap<String, String> = text.includes.iter().cloned().collect();
    load(&text.path, &text.text, &files, &text.overrides)
}

struct Reader<'f> {
    files: &'f dyn Files,
    sources: Sources,
    problems: Vec<Diagnostic>,
    text: ModelText,
    overrides: Vec<(Text, Text)>,
    used: Vec<String>,
    /// Whether scalar parameters are their values, where these are stated.
    puts_in_values: bool,
}

impl Reader<'_> {
    /// The problem with the values that are stated for parameters; what is wrong with these alone is added.
    fn with_values(&mut self, table: &Table, place: Place) -> Option<Problem> {
        let told = std::mem::take(&mut self.problems);
        self.puts_in_values = true;
        let problem = self.problem(table, place);
        let own = std::mem::replace(&mut self.problems, told);
        let errors = own.into_iter();
        let errors: Vec<Diagnostic> = errors
            .filter(|d| d.severity == chetaev_model::Severity::Error)
            .collect();
        self.problems.extend(errors);
        problem
    }

    fn problem(&mut self, table: &Table, place: Place) -> Option<Problem> {
        let functional = self.functional(table, place, None)?;
        let relations = self.relations(table, &functional);
        let solutions = self.solutions(table, &functional);
        let family = self.family(table);
        let ritz = self.ritz(table, &functional);
        let expected = self.expected(table);
        Some(Problem {
            functional,
            relations,
            solutions,
            ritz,
            family,
            text: self.text.clone(),
            expected,
            valued: None,
        })
    }

    /// A functional on its own space, or on that of another one.
    fn functional(
        &mut self,
        table: &Table,
        place: Place,
        space: Option<&Rc<Space>>,
    ) -> Option<Functional> {
        let before = self.problems.len();
        self.known_keys(table, KEYS, "a functional");
        let sizes = self.sizes(table);
        let space = match space {
            Some(space) => {
                self.same_domain(table, &sizes, space)?;
                Rc::clone(space)
            }
            None => Rc::new(self.space(table, place, &sizes)?),
        };
        let scope = Scope {
            space,
            tensors: BTreeMap::new(),
            sizes,
            definitions: BTreeMap::new(),
            shapes: BTreeMap::new(),
            functions: BTreeMap::new(),
            any: BTreeSet::new(),
        };
        let read = self.stated(table, place, scope);
        let errors = self.problems[before..].iter();
        let failed = errors
            .filter(|d| d.severity == chetaev_model::Severity::Error)
            .count();
        read.filter(|_| failed == 0)
    }

    fn push(&mut self, diagnostic: Diagnostic) {
        self.problems.push(diagnostic);
    }

    fn known_keys(&mut self, table: &Table, known: &[&str], of: &str) {
        for (key, _) in &table.entries {
            if known.contains(&key.content.as_str()) {
                continue;
            }
            let message = format!("`{}` is not a key of {of}", key.content);
            let diagnostic = Diagnostic::error("unknown-key", key.place, message);
            self.push(match closest(&key.content, known.iter().copied()) {
                Some(near) => diagnostic
                    .hint(format!("did you mean `{near}`?"))
                    .suggest(key.place, near),
                None => diagnostic.hint(format!("one of {}", known.join(", "))),
            });
        }
    }

    fn section<'t>(&mut self, table: &'t Table, key: &str) -> Option<&'t Table> {
        let raw = table.get(key)?;
        match raw.table() {
            Some(own) => Some(own),
            None => {
                self.wrong_kind(raw, key, "a table");
                None
            }
        }
    }

    fn wrong_kind(&mut self, raw: &Raw, what: &str, wanted: &str) {
        let message = format!("`{what}` must be {wanted}, not {}", raw.kind.word());
        self.push(Diagnostic::error("wrong-kind", raw.place, message));
    }

    fn text_of(&mut self, raw: &Raw, what: &str) -> Option<Text> {
        match raw.expression() {
            Some(text) => Some(text.clone()),
            None => {
                self.wrong_kind(raw, what, "a text");
                None
            }
        }
    }

    fn optional(&mut self, table: &Table, key: &str) -> Option<Text> {
        let raw = table.get(key)?;
        self.text_of(raw, key)
    }

    /// Texts of an array, or one text.
    fn texts(&mut self, raw: &Raw, what: &str) -> Vec<Text> {
        match &raw.kind {
            Kind::Array(items) => items
                .iter()
                .filter_map(|item| self.text_of(item, what))
                .collect(),
            _ => self.text_of(raw, what).into_iter().collect(),
        }
    }

    fn described(&mut self, raw: &Raw, main: &str) -> (Option<Text>, String) {
        match &raw.kind {
            Kind::Table(table) => {
                let description = self.optional(table, "description");
                let main = self.optional(table, main);
                (main, description.map_or(String::new(), |d| d.content))
            }
            _ => (self.text_of(raw, main), String::new()),
        }
    }

    /// Reads an expression with the given free letters, or whatever letters it has.
    fn node(&mut self, scope: &Scope, text: &Text, letters: Option<&[char]>) -> Option<Node> {
        let mut found = Vec::new();
        let node = parse(&text.content, scope, &mut found);
        if let (Some(node), true) = (&node, found.is_empty()) {
            match letters {
                Some(letters) => check(node, letters, scope, &mut found),
                None => check(node, &free_letters(node), scope, &mut found),
            }
        }
        self.add(text, &found).then_some(node).flatten()
    }

    /// Adds what was found in a text; whether it has no error.
    fn add(&mut self, text: &Text, found: &[chetaev_symbolic::syntax::Diagnostic]) -> bool {
        let placed = found.iter().map(|d| Diagnostic::of_expression(d, text));
        self.problems.extend(placed);
        found.iter().all(|d| !d.is_error())
    }

    fn scalar(&mut self, scope: &Scope, text: &Text) -> Option<Expr> {
        Some(self.scalar_tree(scope, text)?.1)
    }

    /// The same with the expression as it is written.
    fn scalar_tree(&mut self, scope: &Scope, text: &Text) -> Option<(Node, Expr)> {
        let node = self.node(scope, text, Some(&[]))?;
        let mut found = Vec::new();
        symmetry::check(scope, &node, &mut found);
        if !self.add(text, &found) {
            return None;
        }
        let value = scope.value(&node, &BTreeMap::new());
        self.is_real(scope, &[value], text).then_some((node, value))
    }

    /// Whether no part of expressions is a number that does not exist, such as `log(0)` or `sqrt(-1)`; else it is said.
    fn is_real(&mut self, scope: &Scope, es: &[Expr], text: &Text) -> bool {
        let g = &scope.space.graph;
        let is_number = |e: &Expr| g.symbols_in(&[*e]).is_empty();
        let mut numbers = g.reachable(es).into_iter().filter(is_number);
        let own = numbers.find(|&e| crate::signs::enclosure(&scope.space, e).is_none());
        if let Some(own) = own {
            let message = format!("`{}` is no real number", g.text(own));
            self.push(Diagnostic::error("bad-value", text.place, message));
        }
        own.is_none()
    }

    /// The components of left minus right with their free letters.
    fn residuals(&mut self, scope: &Scope, text: &Text) -> Option<(Vec<Expr>, Vec<char>)> {
        let mut found = Vec::new();
        let sides = parse_sides(&text.content, scope, &mut found);
        let mut letters = Vec::new();
        if let (Some((left, right)), true) = (&sides, found.is_empty()) {
            letters = free_letters(left);
            check(left, &letters, scope, &mut found);
            if let (Some(right), true) = (right, found.is_empty()) {
                let is_zero = matches!(&right.kind, crate::notation::Kind::Number(n) if *n == chetaev_symbolic::Rational::ZERO);
                if !is_zero {
                    check(right, &letters, scope, &mut found);
                }
            }
        }
        if let Some((left, right)) = &sides {
            symmetry::check(scope, left, &mut found);
            right
                .iter()
                .for_each(|right| symmetry::check(scope, right, &mut found));
        }
        if !self.add(text, &found) {
            return None;
        }
        let (left, right) = sides?;
        let g = &scope.space.graph;
        let left = scope.components(&left, &letters);
        let right = match right {
            Some(right) => scope.components(&right, &letters),
            None => vec![g.zero(); left.len()],
        };
        let differences = left.iter().zip(right).map(|(&l, r)| g.sub(l, r));
        let differences: Vec<Expr> = differences.collect();
        self.is_real(scope, &differences, text)
            .then_some((differences, letters))
    }

    fn unused_overrides(&mut self) {
        for (name, _) in self.overrides.clone() {
            if self.used.contains(&name.content) {
                continue;
            }
            let message = format!("`{}` is neither a parameter nor a size", name.content);
            self.push(Diagnostic::error("unknown-name", name.place, message));
        }
    }

    /// The value that is laid over a parameter or size.
    fn override_of(&mut self, name: &str) -> Option<Text> {
        let found = self.overrides.iter().find(|(own, _)| own.content == name)?;
        let value = found.1.clone();
        self.used.push(name.to_owned());
        Some(value)
    }
}
