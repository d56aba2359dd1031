//! Formulas for people: simplified, collected and printed in the notations of the outputs.

use chetaev_mechanics::equations::{Equation, Equations, NamedExpr};
use chetaev_mechanics::{Manifold, Prover, System};
use chetaev_report::data::{Definition, Equation as Printed, Formula};
use chetaev_symbolic::print::{as_stated, Document, Format, Options, Parts};
use chetaev_symbolic::simplify;
use chetaev_symbolic::syntax::names::greek_letter;
use chetaev_symbolic::{Expr, Graph, Verdict};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;

/// Printing options of a system: its coordinates, quasi-velocities and parameters in the order of the model. Where a
/// quasi-velocity stands in a product does not depend on whether its rate occurs beside it.
pub fn print_options(system: &System) -> Options {
    let coordinates = system.coordinates.iter().map(|c| c.name.clone());
    let quasi_velocities = system.quasi_velocities.iter().map(|u| u.name.clone());
    Options {
        coordinates: coordinates.chain(quasi_velocities).collect(),
        parameters: system.parameters.iter().map(|p| p.name.clone()).collect(),
        display: symbols(system),
        ..Options::default()
    }
}

/// The same for objects of a formulation, with upper and lower indices where their source has both.
pub fn print_options_with(system: &System, objects: &[NamedExpr]) -> Options {
    let typeset = objects
        .iter()
        .filter_map(|o| Some((o.name.clone(), o.typeset.clone()?)));
    let mut options = print_options(system);
    options.display.extend(typeset);
    options
}

/// The symbols that the model states in LaTeX.
fn symbols(system: &System) -> BTreeMap<String, String> {
    let stated = system.notes.iter();
    stated
        .filter_map(|(name, note)| Some((name.clone(), as_stated(note.latex.as_ref()?))))
        .collect()
}

/// Accelerations first, then velocities: the groups by which equations of motion are collected.
fn groups(system: &System, equations: Option<&Equations>) -> (Vec<Expr>, Vec<Expr>) {
    let mut rates: Vec<Expr> = system.coordinates.iter().map(|c| c.a).collect();
    let mut velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let g = &system.graph;
    for variable in equations.iter().flat_map(|e| &e.variables) {
        // Independent velocities are coordinates' velocities; quasi-velocities and momenta are new names.
        if !velocities.contains(&variable.value) {
            let (name, order) = (
                g.symbol_name(variable.symbol),
                g.symbol_order(variable.symbol),
            );
            rates.push(g.symbol(name, order + 1));
            velocities.push(variable.value);
        }
    }
    (rates, velocities)
}

/// Of formulas with more signs than this only short parts are worked on: to try all of them takes minutes for the equations
/// of a bicycle, which nobody reads as formulas.
const SHORT: u64 = 30_000;

/// How hard to try to make expressions short.
fn effort(g: &Graph, es: &[Expr]) -> simplify::Options {
    let usual = simplify::Options::default();
    let signs = es
        .iter()
        .fold(0u64, |sum, &e| sum.saturating_add(simplify::length(g, e)));
    match signs <= SHORT {
        true => usual,
        false => simplify::Options {
            max_nodes: usual.max_nodes / 20,
            ..usual
        },
    }
}

/// Both sides of equations simplified and collected by accelerations. What is printed is proved equal to what was derived;
/// where that fails, what was derived is printed as it is.
pub fn readable(system: &System, derived: &Equations, equations: &[Equation]) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let (rates, velocities) = groups(system, Some(derived));
    equations
        .iter()
        .map(|e| {
            let options = effort(g, &[e.left, e.right]);
            let left = simplify::collect(g, e.left, &[&rates, &velocities], &options);
            let right = simplify::simplify(g, e.right, &options);
            (
                faithful(system, e.left, left),
                faithful(system, e.right, right),
            )
        })
        .collect()
}

/// Expressions simplified for people, each proved equal to the original or left as it was.
pub fn simplified(system: &System, es: &[Expr]) -> Vec<Expr> {
    let short = simplify::simplify_all(&system.graph, es, &effort(&system.graph, es));
    es.iter()
        .zip(short)
        .map(|(&e, short)| faithful(system, e, short))
        .collect()
}

fn faithful(system: &System, original: Expr, readable: Expr) -> Expr {
    let g = &system.graph;
    if original == readable {
        return readable;
    }
    let difference = g.sub(original, readable);
    // Points of prime fields: a normal form of a linear system that is only stated would take longer than the page.
    let prover = Prover {
        replay: true,
        ..Prover::default()
    };
    let verdict = prover.identity(system, &[difference], &Manifold::default(), "");
    match verdict {
        Verdict::Proved(_) => readable,
        _ => original,
    }
}

/// More signs than these in one formula are no longer read.
const LEGIBLE: u64 = 4_000;

/// Longer formulas of no more parts than this are set with the names of those that they share.
const SHARED: usize = 1_500;

/// Equations of more parts than this are left to a command, however many of them they share.
const LARGEST: usize = 4_000;

/// Formulas up to this length are set where there is no room left, too: announcing them would take as long.
const ALWAYS_SET: u64 = 120;

/// Whether a formula is short enough for a page.
pub fn is_legible(g: &Graph, e: Expr) -> bool {
    simplify::length(g, e) <= LEGIBLE
}

/// What the formulas of one page may take: a page that nobody could load would be no report.
#[derive(Clone, Copy, Debug)]
struct Room {
    /// Bytes of all formulas in all notations.
    bytes: usize,
    /// Signs of all expressions handed to the simplification, whose cost grows faster than their length.
    signs: u64,
}

const PAGE: Room = Room {
    bytes: 1_200_000,
    signs: 60_000,
};

/// Sets the formulas of one page in MathML, LaTeX and text, as long as there is room; then announces them.
pub struct Typesetter<'a> {
    system: &'a System,
    options: Options,
    room: Cell<Room>,
    /// Lengths already measured, of all parts too: formulas of a large system share most of what they consist of.
    lengths: RefCell<simplify::Lengths>,
}

impl<'a> Typesetter<'a> {
    /// For the page of a system.
    pub fn new(system: &'a System) -> Typesetter<'a> {
        Typesetter {
            system,
            options: print_options(system),
            room: Cell::new(PAGE),
            lengths: RefCell::default(),
        }
    }

    /// The system.
    pub fn system(&self) -> &'a System {
        self.system
    }

    /// The graph of the system.
    pub fn graph(&self) -> &'a Graph {
        &self.system.graph
    }

    /// The total length of expressions.
    pub(crate) fn signs(&self, es: &[Expr]) -> u64 {
        let mut lengths = self.lengths.borrow_mut();
        let of = |sum: u64, &e: &Expr| sum.saturating_add(lengths.of(self.graph(), e));
        es.iter().fold(0, of)
    }

    /// Whether a formula is short enough for a page.
    pub fn is_legible(&self, e: Expr) -> bool {
        self.signs(&[e]) <= LEGIBLE
    }

    /// Whether expressions of this total length may still be simplified; takes the room if so.
    fn may_simplify(&self, es: &[Expr]) -> bool {
        let signs = self.signs(es);
        let room = self.room.get();
        // A formula several times too long may become legible, one far beyond that will not.
        let is_promising =
            signs <= 4 * LEGIBLE.saturating_mul(es.len() as u64) && signs <= room.signs;
        if is_promising {
            self.room.set(Room {
                signs: room.signs - signs,
                ..room
            });
        }
        is_promising
    }

    /// [`readable`], for what has a chance to become legible; the rest is left as it was derived.
    pub fn readable(&self, derived: &Equations, equations: &[Equation]) -> Vec<(Expr, Expr)> {
        equations
            .iter()
            .flat_map(|e| {
                if self.may_simplify(&[e.left, e.right]) {
                    readable(self.system, derived, std::slice::from_ref(e))
                } else {
                    vec![(e.left, e.right)]
                }
            })
            .collect()
    }

    /// [`simplified`], for what has a chance to become legible; the rest is left as it was derived.
    pub fn simplified(&self, es: &[Expr]) -> Vec<Expr> {
        if self.may_simplify(es) {
            return simplified(self.system, es);
        }
        es.iter()
            .flat_map(|&e| {
                if self.may_simplify(&[e]) {
                    simplified(self.system, &[e])
                } else {
                    vec![e]
                }
            })
            .collect()
    }

    /// One equation with the definitions of names it needs; one that is too long to read is only announced.
    pub fn equation(&self, left: Expr, right: Expr) -> Printed {
        let g = self.graph();
        self.set(&[left, right], || {
            Document::equations(g, &[(left, right)], &self.options)
        })
    }

    /// An intermediate object and its value, with the indices of its source.
    pub fn object(&self, object: &NamedExpr, value: Expr) -> Printed {
        let g = self.graph();
        let options = Options {
            display: print_options_with(self.system, std::slice::from_ref(object)).display,
            ..self.options.clone()
        };
        let name = g.symbol(&object.name, 0);
        self.set(&[name, value], || {
            Document::equations(g, &[(name, value)], &options)
        })
    }

    /// Several equations with the definitions that they share; each that is too long to read is only announced.
    pub fn equations(&self, equations: &[(Expr, Expr)]) -> (Vec<Printed>, Vec<Definition>) {
        let room = self.room.get();
        let is_long = equations
            .iter()
            .any(|&(l, r)| self.signs(&[l, r]) > LEGIBLE);
        if is_long || room.bytes == 0 {
            let alone = equations.iter().map(|&(l, r)| self.equation(l, r));
            return (alone.collect(), Vec::new());
        }
        self.shared(equations).unwrap_or_default()
    }

    /// Equations in their own printing, each with the definitions of names it needs.
    pub fn equations_with(&self, equations: &[(Expr, Expr)], options: &Options) -> Vec<Printed> {
        let g = self.graph();
        let one = |&(left, right): &(Expr, Expr)| {
            self.set(&[left, right], || {
                Document::equations(g, &[(left, right)], options)
            })
        };
        equations.iter().map(one).collect()
    }

    /// Equations that are too long to be read one by one, with the definitions of the parts that they share; `None` where nobody
    /// would read even these.
    pub fn shared(&self, equations: &[(Expr, Expr)]) -> Option<(Vec<Printed>, Vec<Definition>)> {
        let g = self.graph();
        let sides: Vec<Expr> = equations.iter().flat_map(|&(l, r)| [l, r]).collect();
        let room = self.room.get();
        if room.bytes == 0 || g.reachable(&sides).len() > LARGEST {
            return None;
        }
        let document = Document::equations(g, equations, &self.options);
        let (statements, definitions) = parts(&document);
        let of_definitions = definitions.iter().map(|d| bytes(&d.formula));
        let taken = statements.iter().map(bytes).chain(of_definitions).sum();
        self.room.set(Room {
            bytes: room.bytes.saturating_sub(taken),
            ..room
        });
        let printed = statements.into_iter().map(|formula| Printed {
            formula,
            ..Printed::default()
        });
        Some((printed.collect(), definitions))
    }

    /// One expression, likewise.
    pub fn expression(&self, e: Expr) -> Printed {
        self.set(&[e], || {
            Document::expressions(self.graph(), &[e], &self.options)
        })
    }

    /// A short expression within a line; without MathML where there is no room left.
    pub fn inline(&self, e: Expr) -> Formula {
        let printed = self.expression(e);
        match printed.omitted {
            Some(_) => Formula {
                text: "…".into(),
                ..Formula::default()
            },
            None => printed.formula,
        }
    }

    /// A name with as many primes as it has derivatives, as a formula.
    pub fn name(&self, name: &str) -> Formula {
        let g = self.graph();
        let (bare, order) = split(name);
        let symbol = g.symbol(bare, order);
        printed(&Document::expressions(g, &[symbol], &self.options)).formula
    }

    fn set(&self, es: &[Expr], document: impl FnOnce() -> Document) -> Printed {
        let signs = self.signs(es);
        let room = self.room.get();
        let is_short = signs <= LEGIBLE || self.graph().reachable(es).len() <= SHARED;
        if !is_short || (room.bytes == 0 && signs > ALWAYS_SET) {
            return announced(signs);
        }
        let printed = printed(&document());
        let bytes = size(&printed);
        self.room.set(Room {
            bytes: room.bytes.saturating_sub(bytes),
            ..room
        });
        printed
    }
}

/// Bytes of an equation on the page.
fn size(printed: &Printed) -> usize {
    let definitions = printed.definitions.iter().map(|d| bytes(&d.formula));
    bytes(&printed.formula) + definitions.sum::<usize>()
}

fn bytes(formula: &Formula) -> usize {
    let notations = [&formula.mathml, &formula.latex];
    let marked: usize = notations.into_iter().flatten().map(String::len).sum();
    marked + formula.text.len()
}

/// What stands on a page in place of a formula that nobody would read.
fn announced(signs: u64) -> Printed {
    let length = length_in_words(signs);
    Printed {
        omitted: Some(format!(
            "An expression of {length}, which `chetaev derive` prints."
        )),
        ..Printed::default()
    }
}

/// "about 5000 characters".
pub(crate) fn length_in_words(signs: u64) -> String {
    match signs > 1_000_000 {
        true => "more than a million characters".into(),
        false => format!("about {signs} characters"),
    }
}

/// `phi''` is `phi` with two derivatives.
fn split(name: &str) -> (&str, u32) {
    let bare = name.trim_end_matches('\'');
    (bare, (name.len() - bare.len()) as u32)
}

/// A name in letters: `theta_1'` is "θ̇_{1}", where `_{…}` stands for a subscript.
pub fn letters(name: &str) -> String {
    let (bare, order) = split(name);
    let mut parts = bare.split('_').filter(|part| !part.is_empty());
    let Some(first) = parts.next() else {
        return name.to_owned();
    };
    let stem = first.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, digits) = match stem {
        "" => (first, ""),
        stem => (stem, &first[stem.len()..]),
    };
    let sign = |part: &str| greek_letter(part).map_or_else(|| part.to_owned(), String::from);
    let mut out = sign(stem);
    let is_letter = out.chars().count() == 1;
    match (order, is_letter) {
        (0, _) => {}
        (1, true) => out.push('\u{307}'),
        (2, true) => out.push('\u{308}'),
        _ => out.push_str(&"′".repeat(order as usize)),
    }
    let below: Vec<String> = Some(digits)
        .filter(|d| !d.is_empty())
        .into_iter()
        .chain(parts)
        .map(sign)
        .collect();
    if below.is_empty() {
        out
    } else {
        format!("{out}_{{{}}}", below.join(" "))
    }
}

/// A formula in one line as it is read: its names in [`letters`], whole powers raised.
pub fn in_line(text: &str) -> String {
    let is_sign = |c: char| c.is_alphanumeric() || c == '_' || c == '\'';
    let mut out = String::new();
    let text = text.replace(">=", "≥").replace("<=", "≤");
    let mut rest = text.as_str();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            c if is_sign(c) => rest.find(|c| !is_sign(c)).unwrap_or(rest.len()),
            '^' => 1 + rest[1..].chars().take_while(char::is_ascii_digit).count(),
            c => c.len_utf8(),
        };
        let (part, after) = rest.split_at(length);
        match first {
            '^' if length > 1 => out.extend(part.chars().filter_map(superscript)),
            c if c.is_alphabetic() || c == '_' => out.push_str(&letters(part)),
            _ => out.push_str(part),
        }
        rest = after;
    }
    out
}

fn superscript(digit: char) -> Option<char> {
    "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit.to_digit(10)? as usize)
}

fn printed(document: &Document) -> Printed {
    let (mut statements, definitions) = parts(document);
    Printed {
        formula: statements.pop().unwrap_or_default(),
        definitions,
        ..Printed::default()
    }
}

/// Statements and definitions in every notation. A linear system is one definition of several lines.
fn parts(document: &Document) -> (Vec<Formula>, Vec<Definition>) {
    let [mathml, latex, text] =
        [Format::Mathml, Format::Latex, Format::Text].map(|f| document.parts(f));
    let formula = |i: usize, of: fn(&Parts) -> &Vec<String>| Formula {
        mathml: of(&mathml).get(i).cloned(),
        text: of(&text).get(i).cloned().unwrap_or_default(),
        latex: of(&latex).get(i).cloned(),
    };
    let statements = (0..mathml.statements.len())
        .map(|i| formula(i, |p| &p.statements))
        .collect();
    let definitions = (0..mathml.definitions.len())
        .map(|i| Definition {
            formula: formula(i, |p| &p.definitions),
            text: None,
        })
        .collect();
    (statements, definitions)
}

#[cfg(test)]
mod tests {
    use super::{in_line, letters};

    #[test]
    fn formulas_in_a_line_are_written_in_letters() {
        for (text, expected) in [
            ("m r^2 phi'", "m r² φ\u{307}"),
            ("x_1'^12 - 2 k^a", "x\u{307}_{1}¹² - 2 k^a"),
            ("sin(theta) + 1/2", "sin(θ) + 1/2"),
            ("ψ^-1", "ψ^-1"),
        ] {
            assert_eq!(in_line(text), expected);
        }
    }

    #[test]
    fn names_are_written_in_letters_with_dots_and_subscripts() {
        for (name, expected) in [
            ("x", "x"),
            ("phi", "φ"),
            ("phi'", "φ\u{307}"),
            ("theta_1''", "θ\u{308}_{1}"),
            ("theta1", "θ_{1}"),
            ("lambda_blade", "λ_{blade}"),
            ("lambda_roll_x", "λ_{roll x}"),
            ("W_phi", "W_{φ}"),
            ("angle'", "angle′"),
            ("_", "_"),
        ] {
            assert_eq!(letters(name), expected);
        }
    }
}
