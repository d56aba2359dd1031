//! The syntax of the model file. Reading what is written here gives the same expression.
//!
//! Products are juxtaposed, with `*` only before a digit; denominators stand last, so that nothing follows them.

use super::document::{Definition, Document, Statement};
use super::formula::{Formula, Strength, Term};
use super::Parts;

impl Document {
    pub(crate) fn text_parts(&self) -> Parts {
        Parts {
            statements: self.statements.iter().map(statement).collect(),
            definitions: self.definitions.iter().flat_map(definition).collect(),
        }
    }

    /// The statements, one a line, then the definitions after a line "where".
    pub(crate) fn text(&self) -> String {
        let parts = self.text_parts();
        let mut out = parts.statements.join("\n");
        if !self.definitions.is_empty() {
            out.push_str("\nwhere");
        }
        for line in &parts.definitions {
            out.push_str("\n  ");
            out.push_str(line);
        }
        out
    }
}

fn statement(statement: &Statement) -> String {
    match statement {
        Statement::Expression(e) => formula(e),
        Statement::Equation(left, right) => format!("{} = {}", formula(left), formula(right)),
    }
}

fn definition(definition: &Definition) -> Vec<String> {
    match definition {
        Definition::Shared { name, value } => vec![format!("{name} = {}", formula(value))],
        Definition::System(system) => system
            .rows()
            .iter()
            .map(|(left, right)| format!("{} = {}", formula(left), formula(right)))
            .collect(),
    }
}

pub(crate) fn formula(e: &Formula) -> String {
    let mut out = String::new();
    write(e, &mut out);
    out
}

fn write(e: &Formula, out: &mut String) {
    match e {
        Formula::Integer(digits) => out.push_str(digits),
        Formula::Pi => out.push_str("pi"),
        Formula::Algebraic(own) => {
            let polynomial = formula(&Formula::polynomial(own));
            out.push_str(&format!("root({polynomial}, {})", own.to_f64()));
        }
        Formula::Symbol { name, order } => {
            out.push_str(name);
            out.extend(std::iter::repeat_n('\'', *order as usize));
        }
        // Not in a finished document.
        Formula::Reference(_) => out.push('_'),
        Formula::Sum(terms) => sum(terms, out),
        Formula::Negative(inner) => {
            out.push('-');
            group(inner, Strength::Product, out);
        }
        Formula::Product(factors) => product(factors, out),
        Formula::Fraction(top, bottom) => {
            group(top, Strength::Product, out);
            out.push('/');
            group(bottom, Strength::Power, out);
        }
        Formula::Power(base, exponent) => {
            group(base, Strength::Atom, out);
            out.push('^');
            group(exponent, Strength::Atom, out);
        }
        Formula::Root { index: 2, radicand } => call("sqrt", std::slice::from_ref(radicand), out),
        Formula::Root { index, radicand } => {
            group(radicand, Strength::Atom, out);
            out.push_str(&format!("^(1/{index})"));
        }
        Formula::Apply {
            function,
            arguments,
        } => call(function.name(), arguments, out),
        Formula::Matrix { columns, entries } => matrix(*columns, entries, out),
    }
}

/// Writes `e` in parentheses unless it holds together at least as tightly as `least`.
fn group(e: &Formula, least: Strength, out: &mut String) {
    let strength = match e {
        Formula::Root { index, .. } if *index != 2 => Strength::Power,
        other => other.strength(),
    };
    if strength >= least {
        write(e, out);
    } else {
        out.push('(');
        write(e, out);
        out.push(')');
    }
}

fn sum(terms: &[Term], out: &mut String) {
    for (place, term) in terms.iter().enumerate() {
        out.push_str(term.sign(place));
        group(&term.value, Strength::Product, out);
    }
}

fn product(factors: &[Formula], out: &mut String) {
    for (place, factor) in factors.iter().enumerate() {
        if place > 0 {
            out.push(if factor.begins_with_digit() { '*' } else { ' ' });
        }
        // Only a numeric fraction in front goes without parentheses: 1/2 m.
        let least = if place == 0 && factor.is_ratio() {
            Strength::Product
        } else {
            Strength::Power
        };
        group(factor, least, out);
    }
}

fn call<F: std::borrow::Borrow<Formula>>(name: &str, arguments: &[F], out: &mut String) {
    out.push_str(name);
    out.push('(');
    for (place, argument) in arguments.iter().enumerate() {
        if place > 0 {
            out.push_str(", ");
        }
        write(argument.borrow(), out);
    }
    out.push(')');
}

/// Matrices have no syntax in a model file; rows are separated by semicolons.
fn matrix(columns: usize, entries: &[Formula], out: &mut String) {
    out.push('[');
    for (place, entry) in entries.iter().enumerate() {
        if place > 0 {
            out.push_str(if place % columns.max(1) == 0 {
                "; "
            } else {
                ", "
            });
        }
        write(entry, out);
    }
    out.push(']');
}
