//! Equations as functions in C and Rust.

use super::numbers::Numbers;
use super::{NotWritten, Notation};
use crate::derivation::{Derivation, NotDerived};
use chetaev_mechanics::System;
use chetaev_symbolic::print::{source_code, CodeFunction, Language};
use chetaev_symbolic::{Expr, Symbol};

/// For each formulation the rates of its state, its state from coordinates and velocities, and its multipliers.
pub(super) fn source(
    numbers: &Numbers<'_>,
    found: &[Result<Derivation, NotDerived>],
    notation: Notation,
) -> Result<String, NotWritten> {
    let language = match notation {
        Notation::Rust => Language::Rust,
        _ => Language::C,
    };
    let names: Vec<[String; 3]> = found
        .iter()
        .flatten()
        .map(|d| d.card.name.replace('-', "_"))
        .map(|name| ["rates", "state", "multipliers"].map(|what| format!("{name}_{what}")))
        .collect();
    let system = numbers.system;
    let context = Inputs::new(numbers);
    let mut functions = Vec::new();
    for (derivation, names) in found.iter().flatten().zip(&names) {
        functions.extend(context.functions(numbers, derivation, names));
    }
    let title = [format!("Equations of motion of {}.", system.name)];
    source_code(&system.graph, &title, &functions, language).map_err(NotWritten::Code)
}

/// What all functions take.
struct Inputs {
    time: Symbol,
    coordinates: Vec<Symbol>,
    /// Masses with a law of their own.
    masses: Vec<Symbol>,
    velocities: Vec<Symbol>,
    parameters: Vec<Symbol>,
    /// Controls without a law, with their derivatives up to the second.
    controls: Vec<Symbol>,
    /// Laws of the others, and what parameters that follow from others are.
    laws: Vec<(Expr, Expr)>,
}

impl Inputs {
    fn new(numbers: &Numbers<'_>) -> Inputs {
        let (system, g) = (numbers.system, &numbers.system.graph);
        Inputs {
            time: g.intern_symbol("t", 0),
            coordinates: system.coordinate_symbols(),
            masses: system.masses.iter().map(|m| m.symbol).collect(),
            velocities: system.velocity_symbols(),
            parameters: numbers.parameters.clone(),
            controls: numbers.controls(),
            laws: numbers.laws(),
        }
    }

    /// Parameters and controls that the model describes, with their places in the arrays.
    fn described(&self, system: &System) -> Vec<String> {
        let g = &system.graph;
        let arrays = [("p", &self.parameters), ("u", &self.controls)];
        let entries = arrays.into_iter().flat_map(|(array, symbols)| {
            symbols
                .iter()
                .enumerate()
                .map(move |(at, &symbol)| (array, at, symbol))
        });
        let line = |(array, at, symbol): (&str, usize, Symbol)| {
            let note = system.notes.get(g.symbol_name(symbol))?;
            let parts = [note.description.as_str(), note.unit.as_str()];
            let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
            let is_value = g.symbol_order(symbol) == 0 && !parts.is_empty();
            // A line ends a comment of C nowhere but where it is meant to.
            let words = parts.join(", ").replace("*/", "* /").replace('\n', " ");
            is_value.then(|| format!("  {array}[{at}] = {}: {words}", g.symbol_text(symbol)))
        };
        entries.filter_map(line).collect()
    }

    /// Where the motion of the model starts, and the values of its parameters.
    fn start(&self, numbers: &Numbers<'_>, derivation: &Derivation) -> Vec<String> {
        let written = |name: &str, values: Vec<Option<f64>>| {
            let number = |x: &Option<f64>| x.map_or("?".to_owned(), |x| format!("{x:?}"));
            let all: Vec<String> = values.iter().map(number).collect();
            let line = format!("{name} = ({})", all.join(", "));
            (!all.is_empty()).then_some(line)
        };
        let values = |own: &[Symbol]| own.iter().map(|&s| numbers.value(s)).collect();
        let arrays = [
            ("q", values(&self.coordinates)),
            ("z", numbers.variables(derivation)),
            ("m", values(&self.masses)),
            ("p", values(&self.parameters)),
        ];
        let lines = arrays
            .into_iter()
            .filter_map(|(name, own)| written(name, own));
        let lines: Vec<String> = lines.collect();
        let said = match &numbers.no_start {
            None => String::new(),
            Some(why) => format!(
                " (no state is known: {})",
                why.replace("*/", "* /").replace('\n', " ")
            ),
        };
        vec![format!(
            "In the model, at the start{said}: {}",
            lines.join(", ")
        )]
    }

    fn functions<'a>(
        &self,
        numbers: &Numbers<'_>,
        derivation: &Derivation,
        names: &'a [String; 3],
    ) -> Vec<CodeFunction<'a>> {
        let system = numbers.system;
        let equations = &derivation.equations;
        let g = &system.graph;
        let lawful = |es: Vec<Expr>| g.substitute_all(&es, &self.laws);
        let state: Vec<Symbol> = equations.variables.iter().map(|x| x.symbol).collect();
        let listed = |symbols: &[Symbol]| -> String {
            let texts: Vec<String> = symbols.iter().map(|&s| g.symbol_text(s)).collect();
            texts.join(", ")
        };
        let mut arrays = vec![
            "t: the time".to_owned(),
            format!("q = ({}), coordinates", listed(&self.coordinates)),
            format!("z = ({}), the state beside them", listed(&state)),
            format!("p = ({}), parameters", listed(&self.parameters)),
        ];
        arrays.extend(self.described(system));
        if !self.masses.is_empty() {
            arrays.push(format!(
                "m = ({}), masses with a law of their own",
                listed(&self.masses)
            ));
        }
        if !self.controls.is_empty() {
            arrays.push(format!(
                "u = ({}), controls without a law and their derivatives",
                listed(&self.controls)
            ));
        }
        let rates = [equations.velocities.clone(), equations.rates()].concat();
        arrays.extend(numbers.said_to_follow(&rates));
        let start = self.start(numbers, derivation);
        let about = |what: &str, results: &[&str]| -> Vec<String> {
            let mut lines = vec![format!("{}: {what}", derivation.card.title)];
            lines.extend(arrays.iter().cloned());
            lines.extend(results.iter().map(|&line| line.to_owned()));
            lines
        };
        let inputs = |second: (&'a str, Vec<Symbol>)| {
            let mut inputs = vec![("q", self.coordinates.clone()), second];
            if !self.masses.is_empty() {
                inputs.push(("m", self.masses.clone()));
            }
            inputs.push(("p", self.parameters.clone()));
            if !self.controls.is_empty() {
                inputs.push(("u", self.controls.clone()));
            }
            inputs
        };
        let function =
            |name: &'a str, (what, results): (&str, &[&str]), inputs, outputs| CodeFunction {
                name,
                documentation: about(what, results),
                time: Some(self.time),
                inputs,
                outputs,
            };
        let velocities = format!("v = ({}), velocities", listed(&self.velocities));
        let named = (equations.multipliers.iter()).map(|(l, _)| &system.constraints[*l].name);
        let named: Vec<String> = named.map(|name| format!("lambda_{name}")).collect();
        let multipliers = format!("lambda = ({}), multipliers", named.join(", "));
        let mut rates = vec![
            ("dq", lawful(equations.velocities.clone())),
            ("dz", lawful(equations.rates())),
        ];
        let mut state_in_words = "the rates of the state (q, z).";
        let mut results = vec!["dq: the rates of q", "dz: the rates of z"];
        if !self.masses.is_empty() {
            let laws = equations.masses.iter().map(|(_, rate)| *rate);
            rates.push(("dm", lawful(laws.collect())));
            state_in_words = "the rates of the state (q, z, m).";
            results.push("dm: the rates of m");
        }
        let mut functions = vec![function(
            &names[0],
            (state_in_words, &results),
            inputs(("z", state.clone())),
            rates,
        )];
        functions[0].documentation.extend(start);
        let definitions: Option<Vec<Expr>> =
            equations.variables.iter().map(|x| x.definition).collect();
        if let Some(definitions) = definitions {
            functions.push(function(
                &names[1],
                (
                    "the variables z of coordinates and velocities.",
                    &[
                        &velocities,
                        "z, the result: the state beside the coordinates",
                    ],
                ),
                inputs(("v", self.velocities.clone())),
                vec![("z", lawful(definitions))],
            ));
        }
        if !equations.multipliers.is_empty() {
            let values = equations
                .multipliers
                .iter()
                .map(|(_, value)| *value)
                .collect();
            functions.push(function(
                &names[2],
                ("the multipliers of the constraints.", &[&multipliers]),
                inputs(("z", state)),
                vec![("lambda", lawful(values))],
            ));
        }
        functions
    }
}
