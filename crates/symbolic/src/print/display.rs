//! Numbered equations of LaTeX whose lines fit on a page.
//!
//! TeX breaks no line of a display, and refuses one that is wider than six metres. A side that is too wide is broken before the signs between its terms,
//! then before its factors; a fraction with a wide numerator becomes a factor in front of it. Widths are estimated, in letters.

use super::document::{Definition, Document, Statement};
use super::formula::{Formula, Strength};
use super::latex::{function_name, Latex, LARGEST_MATRIX};
use super::names::{Piece as Part, TypesetName};
use crate::node::Function;

/// Letters of a line beside its number: ten points on a sheet of A4 with margins of 25 mm.
const COLUMN: f64 = 95.0;

/// A left side that leaves room for the right one beside it.
const BESIDE: f64 = COLUMN / 3.0;

/// Parentheses within parentheses are broken up to here.
const DEEPEST: u32 = 12;

/// What stands on one line: a part of a formula before which a line may be broken.
#[derive(Default)]
struct Piece {
    text: String,
    width: f64,
    /// What is written before it where it begins a line.
    opening: &'static str,
}

impl Piece {
    fn add(&mut self, text: &str, width: f64) {
        self.text.push_str(text);
        self.width += width;
    }
}

/// An equation with both sides in pieces; without a right side it is an expression.
struct Display {
    left: Vec<Piece>,
    right: Option<Vec<Piece>>,
}

impl Display {
    fn is_wide(&self) -> bool {
        self.right.is_none() || width_of(&self.left) > BESIDE
    }
}

fn width_of(pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.width).sum()
}

impl Document {
    /// The equations in environments of amsmath, each with a number, those that are defined below the word "where".
    pub fn latex_display(&self) -> String {
        let writer = Latex { document: self };
        let statements = self.statements.iter().map(|statement| match statement {
            Statement::Expression(e) => writer.display(e, None),
            Statement::Equation(left, right) => writer.display(left, Some(right)),
        });
        let mut text = environments(&statements.collect::<Vec<_>>());
        if !self.definitions.is_empty() {
            text.push_str("where\n");
            let definitions = self.definitions.iter();
            let all: Vec<Display> = definitions.flat_map(|d| writer.defined(d)).collect();
            text.push_str(&environments(&all));
        }
        text
    }
}

/// Wide equations stand by themselves, so that narrow ones stay aligned beside each other.
fn environments(all: &[Display]) -> String {
    let groups = all.chunk_by(|a, b| !a.is_wide() && !b.is_wide());
    groups.map(environment).collect()
}

fn environment(group: &[Display]) -> String {
    let beside = group.iter().map(|own| width_of(&own.left));
    let beside = beside.fold(0.0, f64::max);
    let equations: Vec<Vec<String>> = group.iter().map(|own| lines(own, beside)).collect();
    if let [only] = &equations[..] {
        if let [line] = &only[..] {
            let line = line.replacen('&', "", 1);
            return format!("\\begin{{equation}}\n{line}\n\\end{{equation}}\n");
        }
    }
    // The number stands at the last line of an equation.
    let numbered = equations.iter().map(|lines| lines.join(" \\notag \\\\\n"));
    let numbered: Vec<String> = numbered.collect();
    format!(
        "\\begin{{align}}\n{}\n\\end{{align}}\n",
        numbered.join(" \\\\\n")
    )
}

/// The lines of one equation, its left side beside the right one or above it.
fn lines(own: &Display, beside: f64) -> Vec<String> {
    let filled = |pieces: &[Piece], room: f64| filled(pieces, room - 4.0);
    let continued = |lines: Vec<String>| -> Vec<String> {
        let all = lines.into_iter().enumerate();
        all.map(|(place, line)| match place {
            0 => line,
            _ => format!("&\\qquad {line}"),
        })
        .collect()
    };
    match &own.right {
        Some(right) if !own.is_wide() => {
            let mut lines = continued(filled(right, COLUMN - beside));
            let left: String = own.left.iter().map(|piece| piece.text.as_str()).collect();
            lines[0] = format!("{left} &= {}", lines[0]);
            lines
        }
        right => {
            let mut lines = continued(filled(&own.left, COLUMN));
            lines[0] = format!("&{}", lines[0]);
            let Some(right) = right else {
                return lines;
            };
            let mut below = continued(filled(right, COLUMN));
            match &mut lines[..] {
                // A short right side goes on in the line.
                [only] if width_of(&own.left) + width_of(right) < COLUMN - 4.0 => {
                    only.push_str(&format!(" = {}", below[0]));
                }
                _ => {
                    below[0] = format!("&\\quad = {}", below[0]);
                    lines.extend(below);
                }
            }
            lines
        }
    }
}

/// As many pieces on each line as fit.
fn filled(pieces: &[Piece], room: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut taken = 0.0;
    for piece in pieces {
        if taken > 0.0 && taken + piece.width > room {
            lines.push(piece.opening.to_owned());
            taken = 0.0;
        }
        if let Some(last) = lines.last_mut() {
            last.push_str(&piece.text);
        }
        taken += piece.width;
    }
    lines
}

impl Latex<'_> {
    fn display(&self, left: &Formula, right: Option<&Formula>) -> Display {
        Display {
            left: self.pieces(left),
            right: right.map(|right| self.pieces(right)),
        }
    }

    fn defined(&self, definition: &Definition) -> Vec<Display> {
        match definition {
            Definition::Shared { name, value } => {
                vec![self.display(&Formula::symbol(name), Some(value))]
            }
            Definition::System(system) => {
                let rows = system.rows();
                let widest = rows
                    .iter()
                    .map(|(row, right)| self.width(row) + self.width(right));
                if system.unknowns.len() > LARGEST_MATRIX || widest.fold(0.0, f64::max) > BESIDE {
                    let rows = rows.iter();
                    return rows
                        .map(|(row, right)| self.display(row, Some(right)))
                        .collect();
                }
                let piece = Piece {
                    text: self.matrix_equation(system),
                    ..Piece::default()
                };
                vec![Display {
                    left: vec![piece],
                    right: None,
                }]
            }
        }
    }

    fn pieces(&self, e: &Formula) -> Vec<Piece> {
        let mut pieces = vec![Piece::default()];
        if self.width(e) <= BESIDE {
            pieces[0].add(&self.formula(e), self.width(e));
        } else {
            self.spread(e, 0, &mut pieces);
        }
        pieces
    }

    /// Appends a formula, with a new piece wherever a line may be broken.
    fn spread(&self, e: &Formula, depth: u32, out: &mut Vec<Piece>) {
        if self.width(e) <= BESIDE || depth > DEEPEST {
            return add(out, &self.formula(e), self.width(e));
        }
        match e {
            Formula::Sum(terms) => {
                for (place, term) in terms.iter().enumerate() {
                    if place > 0 {
                        out.push(Piece::default());
                    }
                    let sign = term.sign(place);
                    add(out, sign, if sign.is_empty() { 0.0 } else { 2.3 });
                    self.spread_group(&term.value, Strength::Product, depth, out);
                }
            }
            Formula::Negative(inner) => {
                add(out, "-", 1.5);
                self.spread_group(inner, Strength::Product, depth, out);
            }
            Formula::Product(factors) => self.spread_product(factors, depth, out),
            Formula::Fraction(top, bottom) if self.width(bottom) <= BESIDE => {
                let below = format!("\\frac{{1}}{{{}}} ", self.formula(bottom));
                add(out, &below, self.width(bottom) + 0.5);
                self.spread_group(top, Strength::Product, depth, out);
            }
            Formula::Fraction(top, bottom) => {
                self.spread_group(top, Strength::Product, depth, out);
                add(out, " ", 0.3);
                self.fenced(bottom, depth, "^{-1}", out);
            }
            Formula::Power(base, exponent) => {
                let mut raised = String::new();
                self.exponent(exponent, &mut raised);
                self.fenced(base, depth, &format!("^{{{raised}}}"), out);
            }
            Formula::Root { index, radicand } => {
                self.fenced(radicand, depth, &format!("^{{1/{index}}}"), out);
            }
            Formula::Apply {
                function,
                arguments,
            } if arguments.len() == 1 && !matches!(function, Function::Abs) => {
                add(out, function_name(*function), 2.6);
                self.fenced(&arguments[0], depth, "", out);
            }
            _ => add(out, &self.formula(e), self.width(e)),
        }
    }

    fn spread_product(&self, factors: &[Formula], depth: u32, out: &mut Vec<Piece>) {
        for (place, factor) in factors.iter().enumerate() {
            if self.width(factor) <= BESIDE {
                let mut text = String::new();
                self.factor(factors, place, &mut text);
                add(out, &text, self.width(factor) + 0.3);
                continue;
            }
            if place > 0 {
                add(out, " ", 0.3);
                out.push(Piece {
                    opening: "\\cdot ",
                    ..Piece::default()
                });
            }
            self.spread_group(factor, Strength::Power, depth, out);
        }
    }

    /// In parentheses where it holds together less tightly than it has to.
    fn spread_group(&self, e: &Formula, least: Strength, depth: u32, out: &mut Vec<Piece>) {
        if e.strength() >= least {
            self.spread(e, depth + 1, out);
        } else {
            self.fenced(e, depth, "", out);
        }
    }

    /// In parentheses whose size does not depend on what stands on the same line.
    fn fenced(&self, e: &Formula, depth: u32, after: &str, out: &mut Vec<Piece>) {
        let (open, close) = if e.is_tall() {
            ("\\Bigl(", "\\Bigr)")
        } else {
            ("(", ")")
        };
        add(out, open, 1.0);
        self.spread(e, depth + 1, out);
        add(out, close, 1.0);
        add(out, after, 1.0);
    }

    /// The width of a formula on one line, in letters.
    fn width(&self, e: &Formula) -> f64 {
        let sum = |all: &[Formula]| -> f64 { all.iter().map(|own| self.width(own) + 0.3).sum() };
        match e {
            Formula::Integer(digits) => digits.len() as f64,
            Formula::Pi | Formula::Reference(_) => 1.0,
            Formula::Algebraic(own) => 24.0 + self.width(&Formula::polynomial(own)),
            Formula::Symbol { name, order } => {
                symbol(&self.name(name)) + if *order > 3 { 2.0 } else { 0.0 }
            }
            Formula::Sum(terms) => {
                let signs = 2.3 * terms.len() as f64;
                signs
                    + terms
                        .iter()
                        .map(|term| self.width(&term.value))
                        .sum::<f64>()
            }
            // What is not an atom may have parentheses.
            Formula::Product(factors) => {
                let fences = factors
                    .iter()
                    .filter(|own| own.strength() < Strength::Power);
                sum(factors) + 1.6 * fences.count() as f64
            }
            Formula::Fraction(top, bottom) => self.width(top).max(self.width(bottom)) + 0.5,
            Formula::Negative(inner) => self.width(inner) + 1.5,
            Formula::Power(base, exponent) => self.width(base) + 0.7 * self.width(exponent) + 1.0,
            Formula::Root { radicand, .. } => self.width(radicand) + 1.8,
            Formula::Apply { arguments, .. } => sum(arguments) + 4.0,
            Formula::Matrix { columns, entries } => {
                let rows = entries.chunks((*columns).max(1));
                let widest = rows.map(|row| sum(row) + 2.0 * row.len() as f64);
                widest.fold(0.0, f64::max) + 2.0
            }
        }
    }
}

fn add(out: &mut [Piece], text: &str, width: f64) {
    if let Some(last) = out.last_mut() {
        last.add(text, width);
    }
}

/// A name with its indices, which are smaller.
fn symbol(name: &TypesetName) -> f64 {
    let part = |part: &Part| match part {
        Part::Digits(digits) => digits.len() as f64,
        Part::Word(word) => word.chars().count() as f64,
        Part::Primes(count) => *count as f64,
        Part::Stated(own) => 1.0 + own.latex().matches('_').count() as f64,
        _ => 1.2,
    };
    let raised = name.superscripts.iter().chain(&name.subscripts);
    let raised: f64 = raised.map(|own| 0.7 * (part(&own.piece) + 0.5)).sum();
    let argument = name.argument.as_ref().map_or(0.0, |own| symbol(own) + 2.0);
    part(&name.head) + raised + argument
}
