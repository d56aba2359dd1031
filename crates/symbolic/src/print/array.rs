//! Right sides of differential equations as functions of arrays, for Python with NumPy, MATLAB and Julia.

use super::document::{Definition, Document, LinearSystem, Statement};
use super::formula::{Formula, Strength, Term};
use super::sympy::KEYWORDS;
use super::Options;
use crate::graph::Graph;
use crate::node::{Expr, Function, Symbol};
use std::collections::{BTreeMap, BTreeSet};

/// A language that computes with arrays.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ArrayLanguage {
    /// Python 3 with NumPy: `rhs(t, y, p)`, as SciPy's `solve_ivp` takes it.
    Python,
    /// MATLAB and Octave: `dy = rhs(t, y, p)`, as `ode45` takes it.
    Matlab,
    /// Julia: `rhs!(dy, y, p, t)`, as DifferentialEquations.jl takes it.
    Julia,
}

/// `y' = f(t, y, p)`.
#[derive(Clone, Debug)]
pub struct ArrayFunction {
    /// The name of the function.
    pub name: String,
    /// What it computes: lines of a comment.
    pub documentation: Vec<String>,
    /// The entries of y.
    pub state: Vec<Symbol>,
    /// The entries of p.
    pub parameters: Vec<Symbol>,
    /// The entries of f.
    pub rates: Vec<Expr>,
}

/// The function as source text. Names of the model stand for the entries of `y` and `p`; what several entries share has a name.
pub fn array_function(g: &Graph, function: &ArrayFunction, language: ArrayLanguage) -> String {
    let options = Options {
        max_nodes: SHARED,
        ..Options::default()
    };
    let document = Document::expressions(g, &function.rates, &options);
    let mut taken = reserved();
    taken.insert(function.name.clone());
    let mut names = BTreeMap::new();
    for &symbol in function.state.iter().chain(&function.parameters) {
        let (name, order) = (g.symbol_name(symbol).to_owned(), g.symbol_order(symbol));
        let wanted = format!("{name}{}", ["", "_d", "_dd"][(order as usize).min(2)]);
        names.insert((name, order), free(&wanted, &mut taken));
    }
    for name in document.defined() {
        names.insert((name.to_owned(), 0), free(name, &mut taken));
    }
    let writer = Writer { language, names };
    let used: BTreeSet<Symbol> = g.symbols_in(&function.rates).into_iter().collect();
    writer.function(g, function, &document, &used)
}

/// Nodes for each entry from which parts get names.
const SHARED: u64 = 40;

/// Words that MATLAB, Octave or Julia reserve, beside those of Python, and names that the functions use themselves.
const RESERVED: [&str; 4] = [
    "t y p dy np pi e i j im float hcat vcat NaN nothing",
    // MATLAB, as `iskeyword` lists them.
    "break case catch classdef continue else elseif end for function global if otherwise parfor persistent return spmd switch try while",
    // Octave (GNU Octave, Reserved Words).
    "do end_try_catch end_unwind_protect endfor endfunction endif endparfor endswitch endwhile until unwind_protect unwind_protect_cleanup",
    // Julia (Essentials, Keywords).
    "baremodule begin break catch const continue do else elseif end export false finally for function global if import in isa let local \
     macro module quote return struct true try using where while",
];

/// What no name of a model may be called.
fn reserved() -> BTreeSet<String> {
    let words = RESERVED.iter().flat_map(|own| own.split_whitespace());
    words.chain(KEYWORDS).map(str::to_owned).collect()
}

fn free(name: &str, taken: &mut BTreeSet<String>) -> String {
    let clean = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let mut own: String = name.chars().map(clean).collect();
    // A name begins with a letter in all three languages.
    if !own.starts_with(|c: char| c.is_ascii_alphabetic()) {
        own.insert(0, 'x');
    }
    while !taken.insert(own.clone()) {
        own.push('_');
    }
    own
}

struct Writer {
    language: ArrayLanguage,
    names: BTreeMap<(String, u32), String>,
}

impl Writer {
    fn function(
        &self,
        g: &Graph,
        function: &ArrayFunction,
        document: &Document,
        used: &BTreeSet<Symbol>,
    ) -> String {
        use ArrayLanguage::*;
        let mut out = self.head(function);
        let indent = "    ";
        for (array, symbols) in [("y", &function.state), ("p", &function.parameters)] {
            for (at, symbol) in symbols.iter().enumerate().filter(|(_, s)| used.contains(s)) {
                let name = self.name(g.symbol_name(*symbol), g.symbol_order(*symbol));
                let entry = match self.language {
                    Python => format!("{array}[{at}]"),
                    Matlab => format!("{array}({})", at + 1),
                    Julia => format!("{array}[{}]", at + 1),
                };
                out.push_str(&format!("{indent}{name} = {entry}{}\n", self.end()));
            }
        }
        for definition in &document.definitions {
            for line in self.definition(definition) {
                out.push_str(&format!("{indent}{line}{}\n", self.end()));
            }
        }
        let rates = document.statements.iter().map(|statement| match statement {
            Statement::Expression(e) | Statement::Equation(e, _) => self.formula(e),
        });
        let rates: Vec<String> = rates.collect();
        match self.language {
            Python => {
                let lines: String = (rates.iter()).map(|r| format!("        {r},\n")).collect();
                out.push_str(&format!("    return np.array([\n{lines}    ])\n"));
            }
            Matlab => {
                let lines: String = (rates.iter()).map(|r| format!("        {r};\n")).collect();
                out.push_str(&format!("    dy = [\n{lines}    ];\nend\n"));
            }
            Julia => {
                for (at, rate) in rates.iter().enumerate() {
                    out.push_str(&format!("    dy[{}] = {rate}\n", at + 1));
                }
                out.push_str("    return nothing\nend\n");
            }
        }
        out
    }

    fn head(&self, function: &ArrayFunction) -> String {
        let name = &function.name;
        let lines = |before: &str| -> String {
            let all = function.documentation.iter();
            all.map(|line| format!("{before}{line}").trim_end().to_owned() + "\n")
                .collect()
        };
        match self.language {
            ArrayLanguage::Python => {
                let text = lines("    ");
                let text = text.trim().replace('\\', "\\\\").replace("\"\"\"", "'''");
                format!("def {name}(t, y, p):\n    \"\"\"{text}\n    \"\"\"\n")
            }
            ArrayLanguage::Matlab => {
                format!("function dy = {name}(t, y, p)\n{}", lines("    % "))
            }
            ArrayLanguage::Julia => {
                format!("{}function {name}!(dy, y, p, t)\n", lines("# "))
            }
        }
    }

    fn end(&self) -> &'static str {
        match self.language {
            ArrayLanguage::Matlab => ";",
            _ => "",
        }
    }

    fn name(&self, name: &str, order: u32) -> String {
        let known = self.names.get(&(name.to_owned(), order));
        known.cloned().unwrap_or_else(|| name.to_owned())
    }

    fn definition(&self, definition: &Definition) -> Vec<String> {
        match definition {
            Definition::Shared { name, value } => {
                vec![format!("{} = {}", self.name(name, 0), self.formula(value))]
            }
            Definition::System(system) => self.system(system),
        }
    }

    fn system(&self, system: &LinearSystem) -> Vec<String> {
        use ArrayLanguage::*;
        let unknowns: Vec<String> = system.unknowns.iter().map(|u| self.name(u, 0)).collect();
        let columns = unknowns.len().max(1);
        let (matrix, rhs) = (&system.matrix, &system.rhs);
        let row = |row: &[Formula], comma: &str| {
            let cells: Vec<String> = row.iter().map(|e| self.formula(e)).collect();
            cells.join(comma)
        };
        match self.language {
            Python => {
                let rows: Vec<String> = (matrix.chunks(columns))
                    .map(|r| format!("[{}]", row(r, ", ")))
                    .collect();
                vec![format!(
                    "{}, = np.linalg.solve(np.array([{}], dtype=float), np.array([{}], dtype=float))",
                    unknowns.join(", "),
                    rows.join(", "),
                    row(rhs, ", ")
                )]
            }
            Matlab | Julia => {
                // Cells of a row are apart by commas in MATLAB; Julia has `hcat` for them, as a space is no sign there.
                let rows: Vec<String> = (matrix.chunks(columns))
                    .map(|r| match self.language {
                        Julia => format!("hcat({})", row(r, ", ")),
                        _ => row(r, ", "),
                    })
                    .collect();
                let (solution, right) = match self.language {
                    Julia => (
                        format!("vcat({}) \\ vcat({})", rows.join(", "), row(rhs, ", ")),
                        ('[', ']'),
                    ),
                    _ => (
                        format!("[{}] \\ [{}]", rows.join("; "), row(rhs, "; ")),
                        ('(', ')'),
                    ),
                };
                let first = unknowns.first().map_or("x", String::as_str);
                let whole = format!("{first}_all");
                let mut lines = vec![format!("{whole} = {solution}")];
                for (at, unknown) in unknowns.iter().enumerate() {
                    let (open, close) = right;
                    lines.push(format!("{unknown} = {whole}{open}{}{close}", at + 1));
                }
                lines
            }
        }
    }

    fn formula(&self, e: &Formula) -> String {
        match e {
            // Integers beyond 15 digits do not fit the integers of these languages.
            Formula::Integer(digits) if digits.len() > 15 => format!("{digits}.0"),
            Formula::Integer(digits) => digits.clone(),
            Formula::Algebraic(own) => format!("({:?})", own.to_f64()),
            Formula::Pi => match self.language {
                ArrayLanguage::Python => "np.pi".into(),
                _ => "pi".into(),
            },
            Formula::Symbol { name, order } => self.name(name, *order),
            Formula::Reference(_) => "NaN".into(),
            Formula::Sum(terms) => self.sum(terms),
            Formula::Negative(inner) => format!("-{}", self.group(inner, Strength::Product)),
            Formula::Product(factors) => {
                let factors = factors.iter().map(|f| {
                    if f.is_ratio() {
                        format!("({})", self.formula(f))
                    } else {
                        self.group(f, Strength::Power)
                    }
                });
                factors.collect::<Vec<_>>().join("*")
            }
            Formula::Fraction(top, bottom) => format!(
                "{}/{}",
                self.group(top, Strength::Product),
                self.group(bottom, Strength::Power)
            ),
            Formula::Power(base, exponent) => {
                let sign = match self.language {
                    ArrayLanguage::Python => "**",
                    _ => "^",
                };
                let (base, exponent) = (
                    self.group(base, Strength::Atom),
                    self.group(exponent, Strength::Atom),
                );
                format!("{base}{sign}{exponent}")
            }
            Formula::Root { index: 2, radicand } => self.call("sqrt", &self.formula(radicand)),
            Formula::Root { index, radicand } => {
                let sign = match self.language {
                    ArrayLanguage::Python => "**",
                    _ => "^",
                };
                format!("({}){sign}(1/{index})", self.formula(radicand))
            }
            Formula::Apply {
                function,
                arguments,
            } => self.application(*function, arguments),
            Formula::Matrix { entries, .. } => {
                let all: Vec<String> = entries.iter().map(|e| self.formula(e)).collect();
                format!("[{}]", all.join(", "))
            }
        }
    }

    fn sum(&self, terms: &[Term]) -> String {
        let mut out = String::new();
        for (place, term) in terms.iter().enumerate() {
            out.push_str(term.sign(place));
            out.push_str(&self.group(&term.value, Strength::Product));
        }
        out
    }

    fn group(&self, e: &Formula, least: Strength) -> String {
        if e.strength() >= least {
            self.formula(e)
        } else {
            format!("({})", self.formula(e))
        }
    }

    fn call(&self, name: &str, arguments: &str) -> String {
        match self.language {
            ArrayLanguage::Python => format!("np.{name}({arguments})"),
            _ => format!("{name}({arguments})"),
        }
    }

    fn application(&self, function: Function, arguments: &[Formula]) -> String {
        use ArrayLanguage::*;
        let texts: Vec<String> = arguments.iter().map(|a| self.formula(a)).collect();
        let all = texts.join(", ");
        let reciprocal = |name: &str| format!("(1/{})", self.call(name, &all));
        match function {
            Function::Cot => reciprocal("tan"),
            Function::Sec => reciprocal("cos"),
            Function::Csc => reciprocal("sin"),
            Function::Atan2 => match self.language {
                Python => self.call("arctan2", &all),
                Matlab => self.call("atan2", &all),
                Julia => self.call("atan", &all),
            },
            other => {
                let name = other.name();
                let inverse = name.strip_prefix('a').filter(|_| {
                    use Function::*;
                    matches!(other, Asin | Acos | Atan | Asinh | Acosh | Atanh)
                });
                match (self.language, inverse) {
                    (Python, Some(rest)) => self.call(&format!("arc{rest}"), &all),
                    _ => self.call(name, &all),
                }
            }
        }
    }
}
