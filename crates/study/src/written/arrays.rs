//! Equations as functions for Python with NumPy, MATLAB and Julia, with the values of the model and a start.

use super::numbers::Numbers;
use super::{NotWritten, Notation};
use crate::derivation::{Derivation, NotDerived};
use chetaev_mechanics::System;
use chetaev_symbolic::print::{array_function, ArrayFunction, ArrayLanguage};
use chetaev_symbolic::{Expr, Symbol};

/// One function for each formulation: `rhs` where there is one, else `rhs_NAME`.
pub(super) fn source(
    numbers: &Numbers<'_>,
    found: &[Result<Derivation, NotDerived>],
    notation: Notation,
) -> Result<String, NotWritten> {
    let language = match notation {
        Notation::Matlab => ArrayLanguage::Matlab,
        Notation::Julia => ArrayLanguage::Julia,
        _ => ArrayLanguage::Python,
    };
    let derived: Vec<&Derivation> = found.iter().flatten().collect();
    let (system, laws) = (numbers.system, numbers.laws());
    let mut text = match language {
        ArrayLanguage::Python => "import numpy as np\n\n".to_owned(),
        _ => String::new(),
    };
    for one in &derived {
        let name = match derived.len() {
            1 => "rhs".to_owned(),
            _ => format!("rhs_{}", one.card.name.replace('-', "_")),
        };
        let state = State::of(system, one);
        let parameters = [numbers.parameters.clone(), numbers.controls()].concat();
        let rates = system.graph.substitute_all(&state.rates, &laws);
        let listed = |symbols: &[Symbol]| -> String {
            let texts: Vec<String> = symbols
                .iter()
                .map(|&s| system.graph.symbol_text(s))
                .collect();
            texts.join(", ")
        };
        let mut documentation = vec![
            format!("{}: {}.", system.name, one.card.title),
            String::new(),
            format!("y = ({})", listed(&state.symbols)),
            format!("p = ({})", listed(&parameters)),
        ];
        documentation.extend(numbers.said_to_follow(&state.rates));
        let function = ArrayFunction {
            name,
            documentation,
            state: state.symbols.clone(),
            parameters,
            rates,
        };
        let values = Values::of(numbers, one, &function);
        // MATLAB ends a file of functions with functions: its values are a comment before them.
        text.push_str(&values.text(system, &function, language));
        text.push_str(&array_function(&system.graph, &function, language));
        text.push('\n');
    }
    Ok(text.trim_end().to_owned() + "\n")
}

/// The entries of y and their rates: coordinates, variables, masses with a law of their own.
struct State {
    symbols: Vec<Symbol>,
    rates: Vec<Expr>,
}

impl State {
    fn of(system: &System, one: &Derivation) -> State {
        let equations = &one.equations;
        let mut symbols = system.coordinate_symbols();
        symbols.extend(equations.variables.iter().map(|x| x.symbol));
        symbols.extend(equations.masses.iter().map(|(symbol, _)| *symbol));
        let mut rates = equations.velocities.clone();
        rates.extend(equations.rates());
        rates.extend(equations.masses.iter().map(|(_, rate)| *rate));
        State { symbols, rates }
    }
}

/// Values of the parameters of a function, and its state at the start: `None` where there is none.
struct Values {
    parameters: Vec<Option<f64>>,
    start: Vec<Option<f64>>,
    /// Why it is not known.
    no_start: Option<String>,
}

impl Values {
    fn of(numbers: &Numbers<'_>, one: &Derivation, function: &ArrayFunction) -> Values {
        let values = |symbols: &[Symbol]| -> Vec<Option<f64>> {
            symbols.iter().map(|&s| numbers.value(s)).collect()
        };
        let mut start = values(&function.state);
        let first = numbers.system.n();
        for (own, value) in start[first..].iter_mut().zip(numbers.variables(one)) {
            *own = value;
        }
        Values {
            parameters: values(&function.parameters),
            start,
            no_start: numbers.no_start.clone(),
        }
    }

    fn text(&self, system: &System, function: &ArrayFunction, language: ArrayLanguage) -> String {
        let g = &system.graph;
        let number = |x: &Option<f64>| match (x, language) {
            (Some(x), _) => format!("{x:?}"),
            (None, ArrayLanguage::Python) => "np.nan".to_owned(),
            (None, _) => "NaN".to_owned(),
        };
        let suffix = function.name.trim_start_matches("rhs");
        let list = |name: &str, values: &[Option<f64>], symbols: &[Symbol], meaning: &str| {
            let all: Vec<String> = values.iter().map(number).collect();
            let named: Vec<String> = symbols.iter().map(|&s| g.symbol_text(s)).collect();
            let (all, named) = (all.join(", "), named.join(", "));
            match language {
                ArrayLanguage::Python => {
                    format!("#: {meaning}: {named}.\n{name}{suffix} = np.array([{all}])\n\n")
                }
                ArrayLanguage::Matlab => {
                    format!("% {meaning}: {named}.\n% {name}{suffix} = [{all}];\n")
                }
                ArrayLanguage::Julia => {
                    format!("# {meaning}: {named}.\n{name}{suffix} = Float64[{all}]\n")
                }
            }
        };
        let p = list(
            "parameters",
            &self.parameters,
            &function.parameters,
            "Values of the parameters",
        );
        let meaning = match &self.no_start {
            None => "The state at the start".to_owned(),
            Some(why) => format!(
                "The state at the start is not known ({})",
                why.replace('\n', " ")
            ),
        };
        let y = list("start", &self.start, &function.state, &meaning);
        match language {
            ArrayLanguage::Python => format!("{p}{y}\n"),
            _ => format!("{p}{y}"),
        }
    }
}
