//! What C and Rust write differently inside an expression.

use super::term::{Strength, Text};
use crate::node::Function;

/// A language of numeric source code.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Language {
    /// C99; needs the library of `<math.h>`.
    C,
    /// Rust, any edition; needs the standard library.
    Rust,
}

impl Language {
    /// `name` of `argument`, and of `more` where it has several arguments.
    pub(super) fn call(self, name: &str, argument: &Text, more: Option<&str>) -> Text {
        let (comma, rest) = more.map_or(("", ""), |rest| (", ", rest));
        let text = match self {
            Language::C => format!("{name}({}{comma}{rest})", argument.text),
            // A literal has no type of its own that a method could be looked up in.
            Language::Rust if argument.is_literal => {
                format!("f64::{name}({}{comma}{rest})", argument.text)
            }
            Language::Rust => format!("{}.{name}({rest})", argument.grouped(Strength::Atom)),
        };
        Text::atom(text)
    }

    pub(super) fn square_root(self, argument: &Text) -> Text {
        self.call("sqrt", argument, None)
    }

    /// `base ^ exponent` in general.
    pub(super) fn power(self, base: &Text, exponent: &str) -> Text {
        let name = match self {
            Language::C => "pow",
            Language::Rust => "powf",
        };
        self.call(name, base, Some(exponent))
    }

    /// The name of a function that the language has, `None` for those that it has not.
    pub(super) fn function(self, function: Function) -> Option<&'static str> {
        use Function::*;
        match (self, function) {
            (_, Cot | Sec | Csc | Sign) => None,
            (Language::C, Abs) => Some("fabs"),
            (Language::Rust, Log) => Some("ln"),
            (_, other) => Some(other.name()),
        }
    }

    /// A number beyond the range of double precision.
    pub(super) fn infinity(self) -> &'static str {
        match self {
            Language::C => "HUGE_VAL",
            Language::Rust => "f64::INFINITY",
        }
    }

    /// The definition of a local variable, without the semicolon.
    pub(super) fn definition(self, name: &str, value: &str) -> String {
        match self {
            Language::C => format!("const double {name} = {value}"),
            Language::Rust => format!("let {name} = {value}"),
        }
    }

    /// A statement that uses an argument without effect, so that no compiler warns of it.
    pub(super) fn ignored(self, name: &str) -> String {
        match self {
            Language::C => format!("(void){name}"),
            Language::Rust => format!("let _ = {name}"),
        }
    }
}
