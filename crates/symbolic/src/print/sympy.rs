//! Python source for SymPy, imported as `sp`, so that no name of a model hides one of SymPy.
//!
//! What depends on the time is `x = sp.Function('x', real=True)(t)` and its derivatives are `x.diff(t, 2)`; numbers
//! are exact. Names that Python reserves get an underscore: `lambda_`.

use super::document::{Definition, Document, LinearSystem, Statement};
use super::formula::{Formula, Strength};
use super::Parts;
use crate::node::Function;
use std::collections::{BTreeMap, BTreeSet};

/// Longer chains of operators exhaust the recursion of Python's compiler.
const LONGEST_CHAIN: usize = 100;

impl Document {
    pub(crate) fn sympy_parts(&self) -> Parts {
        let writer = Sympy::new(self);
        Parts {
            statements: self
                .statements
                .iter()
                .map(|s| writer.statement(s))
                .collect(),
            definitions: self
                .definitions
                .iter()
                .map(|d| writer.definition(d))
                .collect(),
        }
    }

    /// A single expression stands by itself; otherwise assignments and a list called `statements`.
    pub(crate) fn sympy(&self) -> String {
        let parts = self.sympy_parts();
        if let ([only], true) = (&parts.statements[..], self.definitions.is_empty()) {
            return only.clone();
        }
        let mut out = String::new();
        Sympy::new(self).assignment(self, "statements", &mut out);
        out
    }

    /// A complete Python module: imports, declarations of all names, definitions, and a list called `statements`.
    pub fn sympy_script(&self) -> String {
        let names = PythonNames::new(&[self], &[], &["statements"]);
        let mut out = names.heading();
        names.writer(self).assignment(self, "statements", &mut out);
        out
    }
}

/// One part of a Python module: a dictionary called `name` of lists of statements by their headings.
#[derive(Clone, Debug)]
pub struct PythonSection<'a> {
    /// Name of the dictionary; no other may be given the same.
    pub name: &'a str,
    /// A comment above it.
    pub title: &'a str,
    /// Headings, which become the keys, with what stands below them.
    pub groups: Vec<(&'a str, &'a Document)>,
}

/// A complete Python module: the import of SymPy, the declaration of every name once, and a dictionary for each section.
///
/// `moving` lists names that depend on the time even where no derivative of them is printed. A linear system that a group
/// needs is stated, not solved, under the heading of the group with ": linear systems"; solving it in symbols could
/// take SymPy for ever.
pub fn sympy_module(sections: &[PythonSection<'_>], moving: &[String]) -> String {
    let documents: Vec<&Document> = sections
        .iter()
        .flat_map(|section| section.groups.iter().map(|(_, document)| *document))
        .collect();
    let own: Vec<&str> = sections.iter().map(|section| section.name).collect();
    let names = PythonNames::new(&documents, moving, &own);
    let mut unknowns = names.taken.clone();
    let mut out = names.heading();
    for section in sections {
        let name = identifier(section.name);
        out.push_str(&format!("\n{}{name} = {{}}\n", comment(section.title)));
        for (heading, document) in &section.groups {
            let writer = names.writer_in(&name, document, &mut unknowns);
            out.push_str(&comment(heading));
            let systems = writer.definitions(document, &mut out);
            let statements = document.statements.iter().map(|s| writer.statement(s));
            push_list(
                &format!("{name}[{}]", quoted(heading)),
                statements.collect(),
                &mut out,
            );
            if !systems.is_empty() {
                let key = quoted(&format!("{heading}: linear systems"));
                push_list(&format!("{name}[{key}]"), systems, &mut out);
            }
        }
    }
    out
}

/// The names of the model in a module, the same in all of its documents.
struct PythonNames {
    /// Names of the model with their Python names, and whether they depend on the time; in alphabetic order.
    declared: BTreeMap<String, (String, bool)>,
    /// Python names that no definition may take.
    taken: BTreeSet<String>,
}

impl PythonNames {
    fn new(documents: &[&Document], moving: &[String], reserved: &[&str]) -> PythonNames {
        let mut moves: BTreeMap<&str, bool> = BTreeMap::new();
        for name in documents.iter().flat_map(|document| &document.names) {
            *moves.entry(&name.name).or_default() |= name.moves || moving.contains(&name.name);
        }
        let mut taken: BTreeSet<String> = ["sp", "t"].map(String::from).into();
        taken.extend(reserved.iter().map(|name| identifier(name)));
        let mut declared = BTreeMap::from([("t".to_string(), ("t".to_string(), false))]);
        for (name, moves) in moves {
            if name != "t" {
                declared.insert(name.to_string(), (free(name, &mut taken), moves));
            }
        }
        PythonNames { declared, taken }
    }

    /// The import and the declarations.
    fn heading(&self) -> String {
        let mut out = String::from("import sympy as sp\n\nt = sp.Symbol('t', real=True)\n");
        for (name, (python, moves)) in &self.declared {
            let quoted = quoted(name);
            match (name.as_str(), moves) {
                ("t", _) => {}
                (_, true) => {
                    out.push_str(&format!("{python} = sp.Function({quoted}, real=True)(t)\n"))
                }
                (_, false) => out.push_str(&format!("{python} = sp.Symbol({quoted}, real=True)\n")),
            }
        }
        out
    }

    /// The definitions of a document have names of their own: one document may define what another declares.
    fn writer(&self, document: &Document) -> Sympy {
        let mut names: BTreeMap<String, String> = self
            .declared
            .iter()
            .map(|(name, (python, _))| (name.clone(), python.clone()))
            .collect();
        let mut taken = self.taken.clone();
        for name in document.defined() {
            names.insert(name.to_string(), free(name, &mut taken));
        }
        Sympy { names }
    }

    /// The same, where the unknowns of linear systems stay symbols: their names are those of a section and used once.
    fn writer_in(
        &self,
        section: &str,
        document: &Document,
        unknowns: &mut BTreeSet<String>,
    ) -> Sympy {
        let mut writer = self.writer(document);
        for definition in &document.definitions {
            if let Definition::System(system) = definition {
                for name in &system.unknowns {
                    let own = free(&format!("{section}_{name}"), unknowns);
                    writer.names.insert(name.clone(), own);
                }
            }
        }
        writer
    }
}

/// A list of one line for each entry.
fn push_list(name: &str, entries: Vec<String>, out: &mut String) {
    out.push_str(&format!("{name} = [\n"));
    for entry in entries {
        out.push_str(&format!("    {entry},\n"));
    }
    out.push_str("]\n");
}

/// A Python name that is not taken yet; it then is.
fn free(name: &str, taken: &mut BTreeSet<String>) -> String {
    let mut python = identifier(name);
    while !taken.insert(python.clone()) {
        python.push('_');
    }
    python
}

/// A line of Python that says something to a person.
fn comment(text: &str) -> String {
    let line: String = text
        .chars()
        .map(|sign| if sign.is_control() { ' ' } else { sign })
        .collect();
    format!("# {line}\n")
}

struct Sympy {
    names: BTreeMap<String, String>,
}

impl Sympy {
    fn new(document: &Document) -> Sympy {
        PythonNames::new(&[document], &[], &["statements"]).writer(document)
    }

    /// Definitions, then the statements as a list under a name.
    fn assignment(&self, document: &Document, list: &str, out: &mut String) {
        for definition in &document.definitions {
            out.push_str(&self.definition(definition));
            out.push('\n');
        }
        let statements = document.statements.iter().map(|s| self.statement(s));
        push_list(list, statements.collect(), out);
    }

    /// Writes the definitions, the unknowns of linear systems as symbols, and returns the equations of these.
    fn definitions(&self, document: &Document, out: &mut String) -> Vec<String> {
        let mut equations = Vec::new();
        for definition in &document.definitions {
            let Definition::System(system) = definition else {
                out.push_str(&format!("{}\n", self.definition(definition)));
                continue;
            };
            for unknown in &system.unknowns {
                let name = self.name(unknown);
                out.push_str(&format!(
                    "{name} = sp.Symbol({}, real=True)\n",
                    quoted(&name)
                ));
            }
            equations.extend(system.rows().iter().map(|(left, right)| {
                format!(
                    "sp.Eq({}, {}, evaluate=False)",
                    self.formula(left),
                    self.formula(right)
                )
            }));
        }
        equations
    }

    fn name(&self, name: &str) -> String {
        self.names
            .get(name)
            .cloned()
            .unwrap_or_else(|| identifier(name))
    }

    fn statement(&self, statement: &Statement) -> String {
        match statement {
            Statement::Expression(e) => self.formula(e),
            Statement::Equation(left, right) => {
                format!(
                    "sp.Eq({}, {}, evaluate=False)",
                    self.formula(left),
                    self.formula(right)
                )
            }
        }
    }

    fn definition(&self, definition: &Definition) -> String {
        match definition {
            Definition::Shared { name, value } => {
                format!("{} = {}", self.name(name), self.formula(value))
            }
            Definition::System(system) => self.system(system),
        }
    }

    fn system(&self, system: &LinearSystem) -> String {
        let unknowns: Vec<String> = system.unknowns.iter().map(|u| self.name(u)).collect();
        format!(
            "[{}] = {}.LUsolve({})",
            unknowns.join(", "),
            self.matrix(system.unknowns.len(), &system.matrix),
            self.matrix(1, &system.rhs)
        )
    }

    fn formula(&self, e: &Formula) -> String {
        match e {
            Formula::Integer(digits) => digits.clone(),
            Formula::Pi => "sp.pi".to_string(),
            // Real zeros come first there, in ascending order.
            Formula::Algebraic(own) => {
                let list = own.polynomial();
                let list: Vec<String> = list.iter().rev().map(ToString::to_string).collect();
                let list = list.join(", ");
                format!(
                    "sp.CRootOf(sp.Poly([{list}], sp.Dummy('x')), {})",
                    own.place()
                )
            }
            Formula::Symbol { name, order: 0 } => self.name(name),
            Formula::Symbol { name, order: 1 } => format!("{}.diff(t)", self.name(name)),
            Formula::Symbol { name, order } => format!("{}.diff(t, {order})", self.name(name)),
            Formula::Reference(_) => "_".to_string(),
            Formula::Sum(terms) => {
                let terms = terms
                    .iter()
                    .map(|t| (t.negative, self.group(&t.value, Strength::Product)));
                sum(terms.collect())
            }
            Formula::Negative(inner) => format!("-{}", self.group(inner, Strength::Product)),
            Formula::Product(factors) => {
                let factors = factors.iter().map(|f| self.group(f, Strength::Power));
                product(&factors.collect::<Vec<_>>())
            }
            Formula::Fraction(..) if e.is_ratio() => self.ratio(e),
            Formula::Fraction(top, bottom) => {
                let top = match **bottom {
                    // Python would divide integers inexactly.
                    Formula::Integer(_) if top.is_integer() => self.exact(top),
                    _ => self.group(top, Strength::Product),
                };
                format!("{top}/{}", self.group(bottom, Strength::Power))
            }
            Formula::Power(base, exponent) => {
                let base = match **base {
                    Formula::Integer(_) => self.exact(base),
                    _ => self.group(base, Strength::Atom),
                };
                format!("{base}**{}", self.group(exponent, Strength::Atom))
            }
            Formula::Root { index: 2, radicand } => format!("sp.sqrt({})", self.formula(radicand)),
            Formula::Root { index, radicand } => {
                format!("sp.root({}, {index})", self.formula(radicand))
            }
            Formula::Apply {
                function,
                arguments,
            } => {
                let arguments: Vec<String> = arguments.iter().map(|a| self.formula(a)).collect();
                format!("sp.{}({})", function_name(*function), arguments.join(", "))
            }
            Formula::Matrix { columns, entries } => self.matrix(*columns, entries),
        }
    }

    fn exact(&self, e: &Formula) -> String {
        format!("sp.Integer({})", self.formula(e))
    }

    fn ratio(&self, e: &Formula) -> String {
        match e {
            Formula::Fraction(top, bottom) => {
                format!(
                    "sp.Rational({}, {})",
                    self.formula(top),
                    self.formula(bottom)
                )
            }
            other => self.formula(other),
        }
    }

    fn group(&self, e: &Formula, least: Strength) -> String {
        // A ratio is written as a call.
        if e.strength() >= least || e.is_ratio() {
            self.formula(e)
        } else {
            format!("({})", self.formula(e))
        }
    }

    fn matrix(&self, columns: usize, entries: &[Formula]) -> String {
        let rows: Vec<String> = entries
            .chunks(columns.max(1))
            .map(|row| {
                let cells: Vec<String> = row.iter().map(|e| self.formula(e)).collect();
                format!("[{}]", cells.join(", "))
            })
            .collect();
        format!("sp.Matrix([{}])", rows.join(", "))
    }
}

fn sum(terms: Vec<(bool, String)>) -> String {
    if terms.len() > LONGEST_CHAIN {
        let signed = |(negative, term): (bool, String)| match negative {
            true => format!("-{term}"),
            false => term,
        };
        let terms: Vec<String> = terms.into_iter().map(signed).collect();
        return format!("sp.Add({})", terms.join(", "));
    }
    let mut out = String::new();
    for (place, (negative, term)) in terms.into_iter().enumerate() {
        out.push_str(match (place, negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        out.push_str(&term);
    }
    out
}

fn product(factors: &[String]) -> String {
    if factors.len() > LONGEST_CHAIN {
        format!("sp.Mul({})", factors.join(", "))
    } else {
        factors.join("*")
    }
}

fn function_name(function: Function) -> &'static str {
    match function {
        Function::Abs => "Abs",
        other => other.name(),
    }
}

/// Words that Python reserves (3.13, keyword.kwlist).
pub(super) const KEYWORDS: [&str; 35] = [
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue",
    "def", "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import",
    "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "return", "try", "while",
    "with", "yield",
];

fn identifier(name: &str) -> String {
    let mut out: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    if out.is_empty() || out.starts_with(|c: char| c.is_ascii_digit()) {
        out.insert(0, '_');
    }
    if KEYWORDS.contains(&out.as_str()) {
        out.push('_');
    }
    out
}

/// A Python string.
fn quoted(text: &str) -> String {
    let mut out = String::from("'");
    for sign in text.chars() {
        match sign {
            '\'' | '\\' => {
                out.push('\\');
                out.push(sign);
            }
            sign if sign.is_control() => out.push(' '),
            sign => out.push(sign),
        }
    }
    out.push('\'');
    out
}
