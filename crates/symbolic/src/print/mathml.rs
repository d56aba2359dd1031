//! Presentation MathML within MathML Core (W3C 2025), as browsers draw it.

use super::document::{Definition, Document, LinearSystem, Statement};
use super::formula::{Formula, Strength, Term};
use super::latex::{function_of, strength, takes_power, LARGEST_MATRIX};
use super::names::{typeset, Accent, Piece, Subscript, TypesetName};
use super::Parts;
use crate::node::Function;

const TIMES: &str = "<mo>&#x2062;</mo>";
const APPLY: &str = "<mo>&#x2061;</mo>";
const DOT_OPEN: &str = "<mo lspace=\"0\" rspace=\"0\" stretchy=\"false\">";
const THIN_SPACE: &str = "<mspace width=\"0.1667em\"></mspace>";

impl Document {
    pub(crate) fn mathml_parts(&self) -> Parts {
        let writer = Mathml { document: self };
        Parts {
            statements: self
                .statements
                .iter()
                .map(|s| math(&writer.statement(s)))
                .collect(),
            definitions: self
                .definitions
                .iter()
                .flat_map(|d| writer.definition(d))
                .map(|row| math(&row.concat()))
                .collect(),
        }
    }

    /// A single statement stands by itself; more are the rows of a table.
    pub(crate) fn mathml(&self) -> String {
        let writer = Mathml { document: self };
        if let ([only], true) = (&self.statements[..], self.definitions.is_empty()) {
            return math(&writer.statement(only));
        }
        let mut rows: Vec<Vec<String>> = self.statements.iter().map(|s| writer.cells(s)).collect();
        if !self.definitions.is_empty() {
            rows.push(vec!["<mtext>where</mtext>".to_string()]);
        }
        rows.extend(self.definitions.iter().flat_map(|d| writer.definition(d)));
        math(&table(&rows))
    }
}

/// Rows of one cell, or of the left side, the sign of equality and the right side.
fn table(rows: &[Vec<String>]) -> String {
    let mut out = String::from("<mtable displaystyle=\"true\" columnalign=\"right center left\">");
    for row in rows {
        out.push_str("<mtr>");
        match &row[..] {
            [only] => out.push_str(&format!("<mtd columnspan=\"3\">{only}</mtd>")),
            cells => cells
                .iter()
                .for_each(|cell| out.push_str(&format!("<mtd>{cell}</mtd>"))),
        }
        out.push_str("</mtr>");
    }
    out.push_str("</mtable>");
    out
}

fn math(content: &str) -> String {
    format!("<math xmlns=\"http://www.w3.org/1998/Math/MathML\">{content}</math>")
}

fn row(content: &str) -> String {
    format!("<mrow>{content}</mrow>")
}

fn operator(sign: &str) -> String {
    format!("<mo>{sign}</mo>")
}

struct Mathml<'a> {
    document: &'a Document,
}

impl Mathml<'_> {
    fn cells(&self, statement: &Statement) -> Vec<String> {
        match statement {
            Statement::Expression(e) => vec![self.formula(e)],
            Statement::Equation(left, right) => self.equation(left, right),
        }
    }

    fn statement(&self, statement: &Statement) -> String {
        let cells = self.cells(statement);
        match &cells[..] {
            [only] => only.clone(),
            _ => row(&cells.concat()),
        }
    }

    fn equation(&self, left: &Formula, right: &Formula) -> Vec<String> {
        vec![self.formula(left), operator("="), self.formula(right)]
    }

    fn definition(&self, definition: &Definition) -> Vec<Vec<String>> {
        match definition {
            Definition::Shared { name, value } => {
                vec![self.equation(&Formula::symbol(name), value)]
            }
            Definition::System(system) if system.unknowns.len() <= LARGEST_MATRIX => {
                vec![self.matrix_equation(system)]
            }
            Definition::System(system) => system
                .rows()
                .iter()
                .map(|(left, right)| self.equation(left, right))
                .collect(),
        }
    }

    fn matrix_equation(&self, system: &LinearSystem) -> Vec<String> {
        let n = system.unknowns.len();
        let unknowns: Vec<Formula> = system.unknowns.iter().map(|u| Formula::symbol(u)).collect();
        let left = self.matrix(n, &system.matrix) + TIMES + &self.matrix(1, &unknowns);
        vec![row(&format!(
            "{left}{}{}",
            operator("="),
            self.matrix(1, &system.rhs)
        ))]
    }

    /// Exactly one element.
    fn formula(&self, e: &Formula) -> String {
        match e {
            Formula::Integer(digits) => format!("<mn>{digits}</mn>"),
            Formula::Pi => "<mi>π</mi>".to_string(),
            Formula::Algebraic(own) => row(&format!(
                "<mi>root</mi>{}{}{}<mn>{}</mn>{}",
                operator("("),
                self.formula(&Formula::polynomial(own)),
                operator(","),
                own.to_f64(),
                operator(")")
            )),
            Formula::Symbol { name, order } => self.symbol(name, *order, None),
            Formula::Reference(_) => "<mi>_</mi>".to_string(),
            Formula::Sum(terms) => self.sum(terms),
            Formula::Negative(inner) => {
                row(&(operator("−") + &self.group(inner, Strength::Product)))
            }
            Formula::Product(factors) => self.product(factors),
            Formula::Fraction(top, bottom) => format!(
                "<mfrac>{}{}</mfrac>",
                self.formula(top),
                self.formula(bottom)
            ),
            Formula::Power(base, exponent) => self.power(base, exponent),
            Formula::Root { index: 2, radicand } => {
                format!("<msqrt>{}</msqrt>", self.formula(radicand))
            }
            Formula::Root { index, radicand } => {
                format!("<mroot>{}<mn>{index}</mn></mroot>", self.formula(radicand))
            }
            Formula::Apply {
                function,
                arguments,
            } => self.apply(*function, None, arguments, true),
            Formula::Matrix { columns, entries } => self.matrix(*columns, entries),
        }
    }

    fn group(&self, e: &Formula, least: Strength) -> String {
        if strength(e) >= least {
            self.formula(e)
        } else {
            parentheses(&self.formula(e))
        }
    }

    /// A name as it is displayed.
    fn name(&self, name: &str) -> TypesetName {
        typeset(self.document.display.get(name).map_or(name, String::as_str))
    }

    /// A symbol, raised to a power if one is given: sub- and superscripts share their base.
    fn symbol(&self, name: &str, order: u32, exponent: Option<&str>) -> String {
        self.typeset(&self.name(name), order, exponent)
    }

    fn typeset(&self, name: &TypesetName, order: u32, exponent: Option<&str>) -> String {
        let letter = piece(&name.head);
        let head = match accent(order) {
            // Without `accent`: as an accent the dot touches the letter in fonts that have no MATH table.
            Some(sign) => format!("<mover>{letter}{DOT_OPEN}{sign}</mo></mover>"),
            None => letter,
        };
        let order = (order > 3).then(|| row(&format!("<mo>(</mo><mn>{order}</mn><mo>)</mo>")));
        let upper = indices(&name.superscripts);
        let above = order.as_deref().or(upper.as_deref()).or(exponent);
        let own = match (indices(&name.subscripts), above) {
            (None, None) => head,
            (Some(below), None) => format!("<msub>{head}{below}</msub>"),
            (None, Some(above)) => format!("<msup>{head}{above}</msup>"),
            (Some(below), Some(above)) => format!("<msubsup>{head}{below}{above}</msubsup>"),
        };
        match &name.argument {
            Some(argument) => {
                let inner = self.typeset(argument, 0, None);
                row(&format!("{own}{}", parentheses(&inner)))
            }
            None => own,
        }
    }

    fn sum(&self, terms: &[Term]) -> String {
        let mut out = String::new();
        for (place, term) in terms.iter().enumerate() {
            match (place, term.negative) {
                (0, false) => {}
                (_, true) => out.push_str(&operator("−")),
                (_, false) => out.push_str(&operator("+")),
            }
            out.push_str(&self.group(&term.value, Strength::Product));
        }
        row(&out)
    }

    fn product(&self, factors: &[Formula]) -> String {
        let mut out = String::new();
        for (place, factor) in factors.iter().enumerate() {
            if place > 0 {
                let times = if factor.begins_with_digit() {
                    "<mo>⋅</mo>"
                } else {
                    TIMES
                };
                out.push_str(times);
                if is_wordy(factor) || is_wordy(&factors[place - 1]) {
                    out.push_str(THIN_SPACE);
                }
            }
            let last = factors
                .get(place + 1)
                .is_none_or(|next| function_of(next).is_some());
            out.push_str(&match function_of(factor) {
                Some((function, power, arguments)) => self.apply(function, power, arguments, last),
                None if factor.is_ratio() => self.formula(factor),
                None => self.group(factor, Strength::Power),
            });
        }
        row(&out)
    }

    fn power(&self, base: &Formula, exponent: &Formula) -> String {
        let above = self.exponent(exponent);
        match base {
            Formula::Apply {
                function,
                arguments,
            } if takes_power(*function) && exponent.is_integer() => {
                self.apply(*function, Some(exponent), arguments, true)
            }
            Formula::Symbol {
                name,
                order: order @ 0..=3,
            } if !self.name(name).is_raised() => self.symbol(name, *order, Some(&above)),
            Formula::Symbol { .. } => {
                format!("<msup>{}{above}</msup>", parentheses(&self.formula(base)))
            }
            _ => format!("<msup>{}{above}</msup>", self.group(base, Strength::Atom)),
        }
    }

    /// A fraction in an exponent is written on the line where it can be.
    fn exponent(&self, e: &Formula) -> String {
        match e {
            Formula::Negative(inner) if inner.is_flat_fraction() => {
                row(&(operator("−") + &self.exponent(inner)))
            }
            Formula::Fraction(top, bottom) if e.is_flat_fraction() => {
                row(&(self.formula(top) + "<mo>/</mo>" + &self.formula(bottom)))
            }
            _ => self.formula(e),
        }
    }

    /// See the same function of [`latex`](super::latex).
    fn apply(
        &self,
        function: Function,
        power: Option<&Formula>,
        arguments: &[Formula],
        bare: bool,
    ) -> String {
        let written: Vec<String> = arguments.iter().map(|a| self.formula(a)).collect();
        let name = match function {
            Function::Abs => {
                let inner = written.concat();
                return row(&format!(
                    "<mo form=\"prefix\">|</mo>{inner}<mo form=\"postfix\">|</mo>"
                ));
            }
            Function::Exp => {
                let exponent: String = arguments.iter().map(|a| self.exponent(a)).collect();
                return format!("<msup><mi mathvariant=\"normal\">e</mi>{exponent}</msup>");
            }
            _ => format!("<mi>{}</mi>", function_name(function)),
        };
        let name = match power {
            Some(power) => format!("<msup>{name}{}</msup>", self.exponent(power)),
            None => name,
        };
        if let ([Formula::Symbol { .. } | Formula::Pi | Formula::Integer(_)], true) =
            (arguments, bare)
        {
            return row(&format!("{name}{APPLY}{THIN_SPACE}{}", written.concat()));
        }
        let inner = written.join("<mo separator=\"true\">,</mo>");
        row(&format!("{name}{APPLY}{}", parentheses(&inner)))
    }

    fn matrix(&self, columns: usize, entries: &[Formula]) -> String {
        let mut out = String::from("<mtable>");
        for line in entries.chunks(columns.max(1)) {
            out.push_str("<mtr>");
            for entry in line {
                out.push_str(&format!("<mtd>{}</mtd>", self.formula(entry)));
            }
            out.push_str("</mtr>");
        }
        out.push_str("</mtable>");
        parentheses(&out)
    }
}

fn parentheses(content: &str) -> String {
    row(&format!("<mo>(</mo>{content}<mo>)</mo>"))
}

/// Whether it is set in upright words, which need space around them in a product.
fn is_wordy(e: &Formula) -> bool {
    match e {
        Formula::Apply { function, .. } => !matches!(function, Function::Abs | Function::Exp),
        Formula::Power(base, _) => is_wordy(base),
        Formula::Symbol { name, .. } => {
            let name = typeset(name);
            matches!(name.head, Piece::Word(_)) || !name.subscripts.is_empty()
        }
        _ => false,
    }
}

fn accent(order: u32) -> Option<&'static str> {
    match order {
        1 => Some("\u{2d9}"),
        2 => Some("\u{a8}"),
        3 => Some("\u{20db}"),
        _ => None,
    }
}

fn function_name(function: Function) -> &'static str {
    use Function::*;
    match function {
        Asin => "arcsin",
        Acos => "arccos",
        Atan => "arctan",
        Asinh => "arsinh",
        Acosh => "arcosh",
        Atanh => "artanh",
        Log => "ln",
        Sign => "sgn",
        other => other.name(),
    }
}

fn piece(piece: &Piece) -> String {
    match piece {
        Piece::Letter(letter) => format!("<mi>{}</mi>", escaped(&letter.to_string())),
        Piece::Greek(_, sign) => format!("<mi>{sign}</mi>"),
        Piece::Word(word) => format!("<mi>{}</mi>", escaped(word)),
        Piece::Digits(digits) => format!("<mn>{digits}</mn>"),
        Piece::Indices(own) => row(&own.chars().map(index).collect::<String>()),
        Piece::Primes(count) => {
            format!("<mo lspace=\"0\" rspace=\"0\">{}</mo>", "′".repeat(*count))
        }
        Piece::Stated(own) => own.mathml(),
        Piece::Derivative(letter) => row(&format!("<mi>D</mi>{}", self::piece(letter))),
        Piece::Accented(letter, accent) => {
            let letter = self::piece(letter);
            match accent {
                Accent::Tilde => format!("<mover>{letter}<mo>~</mo></mover>"),
                Accent::Bar => format!("<mover>{letter}<mo>¯</mo></mover>"),
                Accent::Star => format!("<msup>{letter}<mo>*</mo></msup>"),
            }
        }
    }
}

/// One sign of indices with derivatives.
fn index(sign: char) -> String {
    match sign {
        ',' => "<mo lspace=\"0\" rspace=\"0\">,</mo>".to_owned(),
        '0'..='9' => format!("<mn>{sign}</mn>"),
        _ => format!("<mi>{}</mi>", escaped(&sign.to_string())),
    }
}

/// Indices side by side; `None` where there are none.
fn indices(indices: &[Subscript]) -> Option<String> {
    let own: Vec<String> = indices.iter().map(subscript).collect();
    match &own[..] {
        [] => None,
        [only] => Some(only.clone()),
        many => Some(row(&many.join("<mo separator=\"true\">,</mo>"))),
    }
}

fn subscript(subscript: &Subscript) -> String {
    let own = piece(&subscript.piece);
    match &subscript.digits {
        Some(digits) => format!("<msub>{own}<mn>{digits}</mn></msub>"),
        None => own,
    }
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for sign in text.chars() {
        match sign {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            _ => out.push(sign),
        }
    }
    out
}
