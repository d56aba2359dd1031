//! Expressions as JSON: nested arrays with the operator first, in the manner of MathJSON.
//!
//! Names are strings and integers are numbers. `["Derivative","x",2]` is x''; functions go by their names in the
//! model file with a capital: `["Sin","phi"]`.

use super::document::{Definition, Document, Statement};
use super::formula::Formula;
use super::Parts;

impl Document {
    pub(crate) fn json_parts(&self) -> Parts {
        Parts {
            statements: self.statements.iter().map(statement).collect(),
            definitions: self.definitions.iter().flat_map(definition).collect(),
        }
    }

    /// A single complete expression stands by itself; otherwise an object with `statements` and `definitions`.
    pub(crate) fn json(&self) -> String {
        let parts = self.json_parts();
        if let ([only], true) = (&parts.statements[..], self.definitions.is_empty()) {
            return only.clone();
        }
        format!(
            "{{\"statements\":[{}],\"definitions\":[{}]}}",
            parts.statements.join(","),
            parts.definitions.join(",")
        )
    }
}

fn statement(statement: &Statement) -> String {
    match statement {
        Statement::Expression(e) => formula(e),
        Statement::Equation(left, right) => call("Equal", [formula(left), formula(right)]),
    }
}

fn definition(definition: &Definition) -> Vec<String> {
    match definition {
        Definition::Shared { name, value } => vec![call("Assign", [string(name), formula(value)])],
        Definition::System(system) => system
            .rows()
            .iter()
            .map(|(left, right)| call("Equal", [formula(left), formula(right)]))
            .collect(),
    }
}

fn formula(e: &Formula) -> String {
    match e {
        Formula::Integer(digits) => digits.clone(),
        Formula::Pi => string("Pi"),
        Formula::Algebraic(own) => call(
            "AlgebraicRoot",
            [formula(&Formula::polynomial(own)), own.place().to_string()],
        ),
        Formula::Symbol { name, order: 0 } => string(name),
        Formula::Symbol { name, order } => call("Derivative", [string(name), order.to_string()]),
        Formula::Reference(_) => string("_"),
        Formula::Sum(terms) => call(
            "Add",
            terms.iter().map(|term| match term.negative {
                true => call("Negate", [formula(&term.value)]),
                false => formula(&term.value),
            }),
        ),
        Formula::Product(factors) => call("Multiply", factors.iter().map(formula)),
        Formula::Fraction(top, bottom) if e.is_ratio() => {
            call("Rational", [formula(top), formula(bottom)])
        }
        Formula::Fraction(top, bottom) => call("Divide", [formula(top), formula(bottom)]),
        Formula::Negative(inner) => call("Negate", [formula(inner)]),
        Formula::Power(base, exponent) => call("Power", [formula(base), formula(exponent)]),
        Formula::Root { index: 2, radicand } => call("Sqrt", [formula(radicand)]),
        Formula::Root { index, radicand } => call("Root", [formula(radicand), index.to_string()]),
        Formula::Apply {
            function,
            arguments,
        } => call(&capitalised(function.name()), arguments.iter().map(formula)),
        Formula::Matrix { columns, entries } => call(
            "Matrix",
            entries
                .chunks((*columns).max(1))
                .map(|row| call("List", row.iter().map(formula))),
        ),
    }
}

fn call(head: &str, arguments: impl IntoIterator<Item = String>) -> String {
    let mut out = format!("[\"{head}\"");
    for argument in arguments {
        out.push(',');
        out.push_str(&argument);
    }
    out.push(']');
    out
}

fn capitalised(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

fn string(text: &str) -> String {
    let mut out = String::from("\"");
    for sign in text.chars() {
        match sign {
            '"' | '\\' => {
                out.push('\\');
                out.push(sign);
            }
            sign if (sign as u32) < 0x20 => out.push_str(&format!("\\u{:04x}", sign as u32)),
            sign => out.push(sign),
        }
    }
    out.push('"');
    out
}
