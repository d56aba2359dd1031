//! LaTeX for mathematical mode. Needs amsmath (aligned, pmatrix, \operatorname, \dddot, \text).

use super::document::{Definition, Document, LinearSystem, Statement};
use super::formula::{Formula, Strength, Term};
use super::names::{typeset, Accent, Piece, Subscript, TypesetName};
use super::Parts;
use crate::node::Function;

/// Matrices up to this size are written as such; larger systems row by row.
pub(crate) const LARGEST_MATRIX: usize = 6;

impl Document {
    pub(crate) fn latex_parts(&self) -> Parts {
        let writer = Latex { document: self };
        Parts {
            statements: self
                .statements
                .iter()
                .map(|s| writer.statement(s, " = "))
                .collect(),
            definitions: self
                .definitions
                .iter()
                .flat_map(|d| writer.definition(d, " = "))
                .collect(),
        }
    }

    /// A single statement stands by itself; more are aligned at their equality signs.
    pub(crate) fn latex(&self) -> String {
        let writer = Latex { document: self };
        if let ([only], true) = (&self.statements[..], self.definitions.is_empty()) {
            return writer.statement(only, " = ");
        }
        let mut lines: Vec<String> = self
            .statements
            .iter()
            .map(|s| match s {
                Statement::Expression(_) => format!("&{}", writer.statement(s, "")),
                Statement::Equation(..) => writer.statement(s, " &= "),
            })
            .collect();
        if !self.definitions.is_empty() {
            lines.push("&\\text{where}".to_string());
        }
        let definitions = self.definitions.iter();
        lines.extend(definitions.flat_map(|d| writer.definition(d, " &= ")));
        format!(
            "\\begin{{aligned}}\n{}\n\\end{{aligned}}",
            lines.join(" \\\\\n")
        )
    }
}

pub(super) struct Latex<'a> {
    pub(super) document: &'a Document,
}

impl Latex<'_> {
    fn statement(&self, statement: &Statement, equals: &str) -> String {
        match statement {
            Statement::Expression(e) => self.formula(e),
            Statement::Equation(left, right) => self.equation(left, right, equals),
        }
    }

    fn equation(&self, left: &Formula, right: &Formula, equals: &str) -> String {
        format!("{}{equals}{}", self.formula(left), self.formula(right))
    }

    fn definition(&self, definition: &Definition, equals: &str) -> Vec<String> {
        match definition {
            Definition::Shared { name, value } => {
                vec![self.equation(&Formula::symbol(name), value, equals)]
            }
            Definition::System(system) if system.unknowns.len() <= LARGEST_MATRIX => {
                let mark = if equals.contains('&') { "&" } else { "" };
                vec![format!("{mark}{}", self.matrix_equation(system))]
            }
            Definition::System(system) => system
                .rows()
                .iter()
                .map(|(left, right)| self.equation(left, right, equals))
                .collect(),
        }
    }

    pub(super) fn matrix_equation(&self, system: &LinearSystem) -> String {
        let n = system.unknowns.len();
        let unknowns: Vec<Formula> = system.unknowns.iter().map(|u| Formula::symbol(u)).collect();
        let mut out = String::new();
        self.matrix(n, &system.matrix, &mut out);
        out.push(' ');
        self.matrix(1, &unknowns, &mut out);
        out.push_str(" = ");
        self.matrix(1, &system.rhs, &mut out);
        out
    }

    pub(super) fn formula(&self, e: &Formula) -> String {
        let mut out = String::new();
        self.write(e, &mut out);
        out
    }

    fn write(&self, e: &Formula, out: &mut String) {
        match e {
            Formula::Integer(digits) => out.push_str(digits),
            Formula::Pi => out.push_str("\\pi"),
            Formula::Algebraic(own) => {
                out.push_str("\\operatorname{root}(");
                self.write(&Formula::polynomial(own), out);
                out.push_str(&format!(", {})", own.to_f64()));
            }
            Formula::Symbol { name, order } => self.symbol(name, *order, out),
            Formula::Reference(_) => out.push_str("\\_"),
            Formula::Sum(terms) => self.sum(terms, out),
            Formula::Negative(inner) => {
                out.push('-');
                self.group(inner, Strength::Product, out);
            }
            Formula::Product(factors) => self.product(factors, out),
            Formula::Fraction(top, bottom) => {
                out.push_str("\\frac{");
                self.write(top, out);
                out.push_str("}{");
                self.write(bottom, out);
                out.push('}');
            }
            Formula::Power(base, exponent) => self.power(base, exponent, out),
            Formula::Root { index, radicand } => {
                out.push_str("\\sqrt");
                if *index != 2 {
                    out.push_str(&format!("[{index}]"));
                }
                out.push('{');
                self.write(radicand, out);
                out.push('}');
            }
            Formula::Apply {
                function,
                arguments,
            } => self.apply(*function, None, arguments, true, out),
            Formula::Matrix { columns, entries } => self.matrix(*columns, entries, out),
        }
    }

    pub(super) fn group(&self, e: &Formula, least: Strength, out: &mut String) {
        if strength(e) >= least {
            self.write(e, out);
        } else {
            self.parentheses(e, out);
        }
    }

    fn parentheses(&self, e: &Formula, out: &mut String) {
        let (open, close) = delimiters(e.is_tall());
        out.push_str(&format!("{open}("));
        self.write(e, out);
        out.push_str(&format!("{close})"));
    }

    /// A name as it is displayed.
    pub(super) fn name(&self, name: &str) -> TypesetName {
        typeset(self.document.display.get(name).map_or(name, String::as_str))
    }

    fn symbol(&self, name: &str, order: u32, out: &mut String) {
        self.typeset(&self.name(name), order, out);
    }

    fn typeset(&self, name: &TypesetName, order: u32, out: &mut String) {
        let head = piece(&name.head);
        let row = |indices: &[Subscript]| {
            let own: Vec<String> = indices.iter().map(subscript).collect();
            braced(&own.join(","))
        };
        match order {
            0 => out.push_str(&head),
            1..=3 => out.push_str(&format!("\\{}ot{{{head}}}", "d".repeat(order as usize))),
            _ => out.push_str(&format!("{head}^{{({order})}}")),
        }
        if !name.superscripts.is_empty() {
            out.push_str(&format!("^{}", row(&name.superscripts)));
        }
        if !name.subscripts.is_empty() {
            out.push_str(&format!("_{}", row(&name.subscripts)));
        }
        if let Some(argument) = &name.argument {
            out.push('(');
            self.typeset(argument, 0, out);
            out.push(')');
        }
    }

    fn sum(&self, terms: &[Term], out: &mut String) {
        for (place, term) in terms.iter().enumerate() {
            out.push_str(term.sign(place));
            self.group(&term.value, Strength::Product, out);
        }
    }

    fn product(&self, factors: &[Formula], out: &mut String) {
        for place in 0..factors.len() {
            self.factor(factors, place, out);
        }
    }

    /// One factor of a product, with the space or the dot before it.
    pub(super) fn factor(&self, factors: &[Formula], place: usize, out: &mut String) {
        let factor = &factors[place];
        if place > 0 {
            out.push_str(if factor.begins_with_digit() {
                " \\cdot "
            } else {
                " "
            });
        }
        let last = factors
            .get(place + 1)
            .is_none_or(|next| function_of(next).is_some());
        match function_of(factor) {
            Some((function, power, arguments)) => {
                self.apply(function, power, arguments, last, out);
            }
            None if factor.is_ratio() => self.write(factor, out),
            None => self.group(factor, Strength::Power, out),
        }
    }

    fn power(&self, base: &Formula, exponent: &Formula, out: &mut String) {
        if let Formula::Apply {
            function,
            arguments,
        } = base
        {
            if takes_power(*function) && exponent.is_integer() {
                return self.apply(*function, Some(exponent), arguments, true, out);
            }
        }
        match base {
            // A bracketed order of differentiation stands where the exponent would.
            Formula::Symbol { order: 4.., .. } => self.parentheses(base, out),
            Formula::Symbol { name, .. } if self.name(name).is_raised() => {
                self.parentheses(base, out);
            }
            _ => self.group(base, Strength::Atom, out),
        }
        let mut inner = String::new();
        self.exponent(exponent, &mut inner);
        out.push_str(&format!("^{}", braced(&inner)));
    }

    /// A fraction in an exponent is written on the line where it can be.
    pub(super) fn exponent(&self, e: &Formula, out: &mut String) {
        match e {
            Formula::Negative(inner) if inner.is_flat_fraction() => {
                out.push('-');
                self.exponent(inner, out);
            }
            Formula::Fraction(top, bottom) if e.is_flat_fraction() => {
                self.write(top, out);
                out.push('/');
                self.write(bottom, out);
            }
            _ => self.write(e, out),
        }
    }

    /// A function of a single sign goes without parentheses where nothing follows that could be taken for its
    /// argument (`bare`).
    fn apply(
        &self,
        function: Function,
        power: Option<&Formula>,
        arguments: &[Formula],
        bare: bool,
        out: &mut String,
    ) {
        match function {
            Function::Abs => return self.absolute(arguments, out),
            Function::Exp => {
                out.push_str("\\mathrm{e}^{");
                arguments.iter().for_each(|a| self.exponent(a, out));
                out.push('}');
                return;
            }
            _ => out.push_str(function_name(function)),
        }
        if let Some(power) = power {
            let mut inner = String::new();
            self.exponent(power, &mut inner);
            out.push_str(&format!("^{}", braced(&inner)));
        }
        if let ([Formula::Symbol { .. } | Formula::Pi | Formula::Integer(_)], true) =
            (arguments, bare)
        {
            out.push(' ');
            return self.write(&arguments[0], out);
        }
        let (open, close) = delimiters(arguments.iter().any(Formula::is_tall));
        out.push_str(&format!("{open}("));
        for (place, argument) in arguments.iter().enumerate() {
            if place > 0 {
                out.push_str(", ");
            }
            self.write(argument, out);
        }
        out.push_str(&format!("{close})"));
    }

    fn absolute(&self, arguments: &[Formula], out: &mut String) {
        out.push_str("\\left|");
        arguments.iter().for_each(|a| self.write(a, out));
        out.push_str("\\right|");
    }

    fn matrix(&self, columns: usize, entries: &[Formula], out: &mut String) {
        out.push_str("\\begin{pmatrix}");
        for (place, entry) in entries.iter().enumerate() {
            if place > 0 {
                out.push_str(if place % columns.max(1) == 0 {
                    " \\\\ "
                } else {
                    " & "
                });
            }
            self.write(entry, out);
        }
        out.push_str("\\end{pmatrix}");
    }
}

fn delimiters(tall: bool) -> (&'static str, &'static str) {
    if tall {
        ("\\left", "\\right")
    } else {
        ("", "")
    }
}

/// Typeset strength: an exponential is written as a power.
pub(crate) fn strength(e: &Formula) -> Strength {
    match e {
        Formula::Apply {
            function: Function::Exp,
            ..
        } => Strength::Power,
        Formula::Apply {
            function: Function::Abs,
            ..
        } => Strength::Atom,
        // sin x, in a power written without its own rule, needs parentheses.
        Formula::Apply { .. } => Strength::Power,
        other => other.strength(),
    }
}

/// Whether a power of the value may be written at the name, sin²x.
pub(crate) fn takes_power(function: Function) -> bool {
    use Function::*;
    matches!(
        function,
        Sin | Cos | Tan | Cot | Sec | Csc | Sinh | Cosh | Tanh | Log
    )
}

/// A named function, or a power written at its name.
pub(crate) fn function_of(e: &Formula) -> Option<(Function, Option<&Formula>, &[Formula])> {
    let (applied, power) = match e {
        Formula::Power(base, exponent) if exponent.is_integer() => (&**base, Some(&**exponent)),
        other => (other, None),
    };
    match applied {
        Formula::Apply {
            function,
            arguments,
        } if !matches!(function, Function::Abs | Function::Exp)
            && (power.is_none() || takes_power(*function)) =>
        {
            Some((*function, power, arguments))
        }
        _ => None,
    }
}

pub(super) fn function_name(function: Function) -> &'static str {
    use Function::*;
    match function {
        Sin => "\\sin",
        Cos => "\\cos",
        Tan => "\\tan",
        Cot => "\\cot",
        Sec => "\\sec",
        Csc => "\\csc",
        Asin => "\\arcsin",
        Acos => "\\arccos",
        Atan => "\\arctan",
        Atan2 => "\\operatorname{atan2}",
        Sinh => "\\sinh",
        Cosh => "\\cosh",
        Tanh => "\\tanh",
        Asinh => "\\operatorname{arsinh}",
        Acosh => "\\operatorname{arcosh}",
        Atanh => "\\operatorname{artanh}",
        Exp => "\\exp",
        Log => "\\ln",
        Abs => "\\operatorname{abs}",
        Sign => "\\operatorname{sgn}",
    }
}

/// One sign, or a group in braces.
fn braced(text: &str) -> String {
    if text.chars().count() == 1 {
        text.to_string()
    } else {
        format!("{{{text}}}")
    }
}

fn piece(piece: &Piece) -> String {
    match piece {
        Piece::Letter(letter) => escaped(&letter.to_string()),
        Piece::Digits(digits) => digits.clone(),
        Piece::Word(word) => format!("\\mathrm{{{}}}", escaped(word)),
        Piece::Accented(letter, accent) => {
            let letter = self::piece(letter);
            match accent {
                Accent::Tilde => format!("\\tilde{{{letter}}}"),
                Accent::Bar => format!("\\bar{{{letter}}}"),
                // In braces, so that an exponent is none of the star's.
                Accent::Star => format!("{{{letter}^{{*}}}}"),
            }
        }
        Piece::Derivative(letter) => format!("D{}", self::piece(letter)),
        Piece::Stated(own) => own.latex(),
        Piece::Indices(own) => escaped(own),
        Piece::Primes(count) => "\\prime".repeat(*count),
        Piece::Greek(name, _) => match name.as_str() {
            "phi" => "\\varphi".to_string(),
            "epsilon" => "\\varepsilon".to_string(),
            "omicron" => "o".to_string(),
            _ => format!("\\{name}"),
        },
    }
}

fn subscript(subscript: &Subscript) -> String {
    let own = piece(&subscript.piece);
    match &subscript.digits {
        Some(digits) => format!("{own}_{}", braced(digits)),
        None => own,
    }
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for sign in text.chars() {
        match sign {
            '\\' => out.push_str("\\backslash "),
            '^' => out.push_str("\\wedge "),
            '~' => out.push_str("\\sim "),
            '{' | '}' | '$' | '&' | '#' | '%' | '_' => {
                out.push('\\');
                out.push(sign);
            }
            _ => out.push(sign),
        }
    }
    out
}
