//! Equations as functions for Python with NumPy, MATLAB and Julia, with the values of the model and a start.

use super::{NotWritten, Notation};
use crate::derivation::{Derivation, NotDerived};
use chetaev_mechanics::equations::StateVariable;
use chetaev_mechanics::System;
use chetaev_symbolic::print::{array_function, ArrayFunction, ArrayLanguage};
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// One function for each formulation: `rhs` where there is one, else `rhs_NAME`.
pub(super) fn source(
    system: &System,
    found: &[Result<Derivation, NotDerived>],
    notation: Notation,
) -> Result<String, NotWritten> {
    let language = match notation {
        Notation::Matlab => ArrayLanguage::Matlab,
        Notation::Julia => ArrayLanguage::Julia,
        _ => ArrayLanguage::Python,
    };
    let derived: Vec<&Derivation> = found.iter().flatten().collect();
    let laws = laws(system);
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
        let parameters = parameters(system);
        let rates = system.graph.substitute_all(&state.rates, &laws);
        let listed = |symbols: &[Symbol]| -> String {
            let texts: Vec<String> = symbols
                .iter()
                .map(|&s| system.graph.symbol_text(s))
                .collect();
            texts.join(", ")
        };
        let documentation = vec![
            format!("{}: {}.", system.name, one.card.title),
            String::new(),
            format!("y = ({})", listed(&state.symbols)),
            format!("p = ({})", listed(&parameters)),
        ];
        let function = ArrayFunction {
            name,
            documentation,
            state: state.symbols.clone(),
            parameters,
            rates,
        };
        let values = Values::of(system, one, &state);
        // MATLAB ends a file of functions with functions: its values are a comment before them.
        text.push_str(&values.text(system, &function, language));
        text.push_str(&array_function(&system.graph, &function, language));
        text.push('\n');
    }
    Ok(text.trim_end().to_owned() + "\n")
}

/// Parameters, and controls without a law, which stay as they are along a step.
fn parameters(system: &System) -> Vec<Symbol> {
    let g = &system.graph;
    let mut all: Vec<Symbol> = system
        .parameters
        .iter()
        .map(|p| g.intern_symbol(&p.name, 0))
        .collect();
    for control in system
        .controls
        .iter()
        .filter(|control| control.law.is_none())
    {
        all.extend((0..=2).map(|order| g.intern_symbol(&control.name, order)));
    }
    all
}

/// Controls with a law, and their derivatives.
fn laws(system: &System) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let mut laws = Vec::new();
    for control in &system.controls {
        let Some(law) = control.law else { continue };
        for order in 0..=2 {
            let rate = (0..order).fold(law, |e, _| g.total_derivative(e, &|_| false));
            laws.push((g.symbol(&control.name, order), rate));
        }
    }
    laws
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

/// Numbers of the model: `None` where it states none.
struct Values {
    parameters: Vec<Option<f64>>,
    start: Vec<Option<f64>>,
}

impl Values {
    fn of(system: &System, one: &Derivation, state: &State) -> Values {
        let g = &system.graph;
        let own = parameters(system);
        let number = |e: Expr, known: &BTreeMap<Symbol, f64>| {
            let found = g.evaluate_f64(&[e], &|s| known.get(&s).copied()).ok()?;
            found.first().copied().filter(|x| x.is_finite())
        };
        let mut known: BTreeMap<Symbol, f64> = BTreeMap::new();
        for p in &system.parameters {
            let value = p.value.and_then(|e| number(e, &BTreeMap::new()));
            known.extend(g.as_symbol(p.expr).zip(value));
        }
        let values = own.iter().map(|s| known.get(s).copied()).collect();
        for &(symbol, e) in &system.start {
            known.extend(number(e, &known).map(|value| (symbol, value)));
        }
        for c in &system.coordinates {
            known.entry(c.q_symbol).or_insert(0.0);
        }
        let speeds = speeds(system, one, &known).unwrap_or_default();
        known.extend(speeds);
        Values {
            parameters: values,
            start: state
                .symbols
                .iter()
                .map(|s| known.get(s).copied())
                .collect(),
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
        let y = list(
            "start",
            &self.start,
            &function.state,
            "The state at the start",
        );
        match language {
            ArrayLanguage::Python => format!("{p}{y}\n"),
            _ => format!("{p}{y}"),
        }
    }
}

/// The variables of the state at the start, nearest to the velocities that are stated: those that are not are free.
fn speeds(
    system: &System,
    one: &Derivation,
    known: &BTreeMap<Symbol, f64>,
) -> Option<Vec<(Symbol, f64)>> {
    let g = &system.graph;
    let equations = &one.equations;
    let variables: &[StateVariable] = &equations.variables;
    let symbols: Vec<Symbol> = variables.iter().map(|x| x.symbol).collect();
    let mut lookup = known.clone();
    lookup.insert(g.intern_symbol("t", 0), 0.0);
    lookup.extend(symbols.iter().map(|&s| (s, 0.0)));
    let value = |es: &[Expr]| {
        let values = g.evaluate_f64(es, &|s| lookup.get(&s).copied());
        values
            .ok()
            .filter(|values| values.iter().all(|x| x.is_finite()))
    };
    let slopes = g.jacobian(&equations.velocities, &symbols);
    if g.any_contains_any(&slopes.concat(), &symbols) {
        return None;
    }
    let rest = value(&equations.velocities)?;
    let k = symbols.len();
    let (mut matrix, mut right) = (vec![vec![0.0; k]; k], vec![0.0; k]);
    for ((c, row), rest) in system.coordinates.iter().zip(&slopes).zip(rest) {
        let Some(&given) = known.get(&c.v_symbol) else {
            continue;
        };
        let row = value(row)?;
        for i in 0..k {
            right[i] += row[i] * (given - rest);
            for j in 0..k {
                matrix[i][j] += row[i] * row[j];
            }
        }
    }
    Some(symbols.into_iter().zip(least(matrix, right)).collect())
}

/// A solution of a symmetric system that is not negative; what nothing determines is zero.
fn least(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let k = right.len();
    let size = matrix.iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
    let mut taken = vec![false; k];
    for _ in 0..k {
        let open = (0..k).filter(|&i| !taken[i]);
        let Some(pivot) = open.max_by(|&a, &b| matrix[a][a].total_cmp(&matrix[b][b])) else {
            break;
        };
        if matrix[pivot][pivot] <= 1e-12 * size {
            break;
        }
        taken[pivot] = true;
        let own = (matrix[pivot].clone(), right[pivot]);
        for i in (0..k).filter(|&i| i != pivot) {
            let factor = matrix[i][pivot] / own.0[pivot];
            for (entry, other) in matrix[i].iter_mut().zip(&own.0) {
                *entry -= factor * other;
            }
            right[i] -= factor * own.1;
        }
    }
    (0..k)
        .map(|i| {
            if taken[i] {
                right[i] / matrix[i][i]
            } else {
                0.0
            }
        })
        .collect()
}
