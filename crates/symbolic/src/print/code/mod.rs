//! Numeric source code: functions in C (C99 with `<math.h>`) and in Rust (the standard library alone) that compute
//! expressions in double precision.
//!
//! A function is straight-line code. What several expressions share is computed once, in a local variable; what is
//! short and used once stands where it is used. A linear solve is a call of one helper, Gaussian elimination with
//! partial pivoting, and a function tells its caller when it met a singular matrix.
//!
//! The result depends on the structure of the expressions alone. Its size and the time to write it are proportional
//! to the graph, up to the sorting of terms.

mod body;
mod comment;
mod expression;
mod function;
mod helpers;
mod language;
mod literal;
mod local;
mod names;
mod power;
mod term;

pub use language::Language;

use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use helpers::Helpers;
use names::Names;

/// One function to write: numbers in, numbers out, both in groups.
///
/// In C it is `int name(double t, const double q[2], …, double dv[2])`, which returns 0, or 1 where a linear system is
/// singular; in Rust `pub fn name(t: f64, q: &[f64; 2], …, dv: &mut [f64; 2]) -> Result<(), Singular>`. Outputs are
/// written last, and not at all if the function fails; in C an output may be the same array as an input.
#[derive(Clone, Debug)]
pub struct CodeFunction<'a> {
    /// Its name; what no identifier may contain is replaced by underscores.
    pub name: &'a str,
    /// The lines of the comment above: what is computed, and what the entries of the arrays are.
    pub documentation: Vec<String>,
    /// The independent variable, which is an argument of its own.
    pub time: Option<Symbol>,
    /// Names of the arrays that are read, each with the symbols that its entries stand for.
    pub inputs: Vec<(&'a str, Vec<Symbol>)>,
    /// Names of the arrays that are written, each with the expressions of its entries.
    pub outputs: Vec<(&'a str, Vec<Expr>)>,
}

/// Why no code can be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CodeError {
    /// An expression contains a symbol that no input gives.
    #[error("`{symbol}` occurs in the outputs of `{function}` but is none of its inputs")]
    SymbolWithoutInput {
        /// The function to be written.
        function: String,
        /// The symbol, with primes.
        symbol: String,
    },
    /// A function is applied to a number of arguments for which it is not defined.
    #[error(
        "`{applied}` of {arguments} arguments, in `{function}`, is no function of the language"
    )]
    UnknownFunction {
        /// The function to be written.
        function: String,
        /// Name of the function in the expression.
        applied: String,
        /// How many arguments it has there.
        arguments: usize,
    },
    /// A matrix, or the vector of all unknowns of a linear system, stands where a number is needed.
    #[error("an expression in `{function}` uses a matrix as if it were a number")]
    NotScalar {
        /// The function to be written.
        function: String,
    },
}

/// A source file with `functions`; `title` is the comment at its top.
///
/// The local variables have the names of the model where the language allows it: `x'` is `x_d`, `x''` is `x_dd`.
///
/// # Errors
/// [`CodeError`] for the first expression that cannot be written.
pub fn source_code(
    graph: &Graph,
    title: &[String],
    functions: &[CodeFunction<'_>],
    language: Language,
) -> Result<String, CodeError> {
    let mut helpers = Helpers::default();
    let mut names = Names::reserved();
    let mut bodies = Vec::with_capacity(functions.len());
    for function in functions {
        let name = names.free(function.name);
        bodies.push(function::written(
            graph,
            function,
            &name,
            language,
            &mut helpers,
        )?);
    }
    let mut out = comment::file(title, language);
    let helpers = helpers.text(language);
    // A file without title begins with its first line.
    out.push_str(helpers.trim_start_matches(if title.is_empty() { "\n" } else { "" }));
    for body in bodies {
        out.push('\n');
        out.push_str(&body);
    }
    Ok(out)
}
