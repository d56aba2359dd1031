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
        for line in &parts.definitions {
            out.push_str(line);
            out.push('\n');
        }
        out.push_str("statements = [\n");
        for line in &parts.statements {
            out.push_str(&format!("    {line},\n"));
        }
        out.push_str("]\n");
        out
    }

    /// A complete Python module: imports, declarations of all names, definitions, and a list called `statements`.
    pub fn sympy_script(&self) -> String {
        let writer = Sympy::new(self);
        let mut out = String::from("import sympy as sp\n\nt = sp.Symbol('t', real=True)\n");
        for name in self.names.iter().filter(|name| name.name != "t") {
            let (python, quoted) = (writer.name(&name.name), quoted(&name.name));
            out.push_str(&if name.moves {
                format!("{python} = sp.Function({quoted}, real=True)(t)\n")
            } else {
                format!("{python} = sp.Symbol({quoted}, real=True)\n")
            });
        }
        let parts = self.sympy_parts();
        for line in &parts.definitions {
            out.push_str(line);
            out.push('\n');
        }
        out.push_str("statements = [\n");
        for line in &parts.statements {
            out.push_str(&format!("    {line},\n"));
        }
        out.push_str("]\n");
        out
    }
}

struct Sympy {
    names: BTreeMap<String, String>,
}

impl Sympy {
    fn new(document: &Document) -> Sympy {
        let mut taken: BTreeSet<String> = ["sp", "t", "statements"].map(String::from).into();
        let mut names = BTreeMap::from([("t".to_string(), "t".to_string())]);
        let model = document.names.iter().map(|name| name.name.as_str());
        let defined = document.definitions.iter().flat_map(|d| match d {
            Definition::Shared { name, .. } => vec![name.as_str()],
            Definition::System(system) => system.unknowns.iter().map(String::as_str).collect(),
        });
        for name in model.chain(defined) {
            if names.contains_key(name) {
                continue;
            }
            let mut python = identifier(name);
            while !taken.insert(python.clone()) {
                python.push('_');
            }
            names.insert(name.to_string(), python);
        }
        Sympy { names }
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
                format!("sp.Eq({}, {})", self.formula(left), self.formula(right))
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
const KEYWORDS: [&str; 35] = [
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
