//! One function: its name and arguments, and what it needs to be well-formed.

use super::body::Body;
use super::comment;
use super::expression::Writer;
use super::helpers::Helpers;
use super::language::Language;
use super::local::Locals;
use super::names::{wished, Names};
use super::term::{list, push_wrapped};
use super::{CodeError, CodeFunction};
use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use rustc_hash::FxHashMap;

/// The source text of `function` under the given name.
pub(super) fn written(
    g: &Graph,
    function: &CodeFunction<'_>,
    name: &str,
    language: Language,
    helpers: &mut Helpers,
) -> Result<String, CodeError> {
    let outputs: Vec<Expr> = function.outputs.iter().flat_map(|o| o.1.clone()).collect();
    let locals = Locals::new(g, &outputs, function.name)?;
    let arguments = Arguments::new(g, function);
    if let Some(missing) = g
        .symbols_in(&outputs)
        .into_iter()
        .find(|symbol| !arguments.symbols.contains_key(symbol))
    {
        return Err(CodeError::SymbolWithoutInput {
            function: function.name.to_string(),
            symbol: g.symbol_text(missing),
        });
    }
    let writer = Writer {
        locals: &locals,
        language,
        helpers,
        symbols: arguments.symbols,
        names: FxHashMap::default(),
    };
    let mut body = Body::new(writer, arguments.names);
    let head = Head {
        name,
        time: arguments.time,
        inputs: arguments.inputs,
        outputs: arguments.outputs,
    };
    body.inputs(function, &head);
    body.locals();
    body.outputs(function, &head);
    let is_snake_case = head
        .names()
        .chain(body.names_given())
        .all(|name| !name.contains("__") && !name.contains(|c: char| c.is_uppercase()));
    let mut out = comment::function(&function.documentation, language);
    if language == Language::Rust && !is_snake_case {
        out.push_str("#[allow(non_snake_case)]\n");
    }
    head.write(language, &mut out);
    out.push_str(body.text());
    out.push_str(match language {
        Language::C => "    return 0;\n}\n",
        Language::Rust => "    Ok(())\n}\n",
    });
    Ok(out)
}

/// The arguments and the symbols that they give, all with names of their own.
struct Arguments {
    names: Names,
    symbols: FxHashMap<Symbol, String>,
    /// Name and length of each array.
    inputs: Vec<(String, usize)>,
    outputs: Vec<(String, usize)>,
    time: Option<String>,
}

impl Arguments {
    fn new(g: &Graph, function: &CodeFunction<'_>) -> Arguments {
        let mut names = Names::reserved();
        let inputs = function.inputs.iter();
        let inputs = inputs.map(|(name, symbols)| (names.free(name), symbols.len()));
        let inputs = inputs.collect();
        let outputs = function.outputs.iter();
        let outputs = outputs.map(|(name, entries)| (names.free(name), entries.len()));
        let outputs = outputs.collect();
        let time = function.time.map(|t| names.free(&wished(g, t)));
        let mut symbols = FxHashMap::default();
        if let (Some(t), Some(name)) = (function.time, &time) {
            symbols.insert(t, name.clone());
        }
        // A name of the model goes before the name of a derivative.
        let mut all: Vec<Symbol> = function.inputs.iter().flat_map(|i| i.1.clone()).collect();
        all.sort_by_key(|&symbol| g.symbol_order(symbol) > 0);
        for symbol in all {
            symbols
                .entry(symbol)
                .or_insert_with(|| names.free(&wished(g, symbol)));
        }
        Arguments {
            names,
            symbols,
            inputs,
            outputs,
            time,
        }
    }
}

/// The arguments of a function under the names that they have in it.
pub(super) struct Head<'a> {
    name: &'a str,
    pub(super) time: Option<String>,
    /// Name and length of each array.
    pub(super) inputs: Vec<(String, usize)>,
    pub(super) outputs: Vec<(String, usize)>,
}

impl Head<'_> {
    fn names(&self) -> impl Iterator<Item = &str> {
        let arrays = self.inputs.iter().chain(&self.outputs);
        std::iter::once(self.name)
            .chain(self.time.as_deref())
            .chain(arrays.map(|(name, _)| name.as_str()))
    }

    fn write(&self, language: Language, out: &mut String) {
        let time = self.time.as_ref().map(|t| match language {
            Language::C => format!("double {t}"),
            Language::Rust => format!("{t}: f64"),
        });
        let inputs = self.inputs.iter().map(|(name, length)| match language {
            Language::C if *length == 0 => format!("const double *{name}"),
            Language::C => format!("const double {name}[{length}]"),
            Language::Rust => format!("{name}: &[f64; {length}]"),
        });
        let outputs = self.outputs.iter().map(|(name, length)| match language {
            Language::C if *length == 0 => format!("double *{name}"),
            Language::C => format!("double {name}[{length}]"),
            Language::Rust => format!("{name}: &mut [f64; {length}]"),
        });
        let arguments: Vec<String> = time.into_iter().chain(inputs).chain(outputs).collect();
        let name = self.name;
        let text = match language {
            Language::C if arguments.is_empty() => format!("int {name}(void)\n{{"),
            Language::C => format!("int {name}({})\n{{", list(&arguments)),
            Language::Rust => format!(
                "pub fn {name}({}) -> Result<(), Singular> {{",
                list(&arguments)
            ),
        };
        push_wrapped(&text, 0, out);
    }
}
