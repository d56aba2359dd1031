//! Derivation with native code, and the right-hand side, one state at a time or many.

use crate::clock::{per_unit, Clock};
use crate::prepared::{words, Prepared, Source};
use crate::question::Question;
use crate::Ready;
use chetaev::compile::{
    backend, Backend, BlockEvaluator, Evaluator, Lanes, Lowering, Workspace, LANES,
};
use chetaev::integrate::System as Flow;
use chetaev::mechanics::reduced_equations::reduced;
use chetaev::mechanics::Equations;
use chetaev::motion::accelerations::Accelerations;
use chetaev::motion::functions::Functions;
use chetaev::motion::multiplier_flow::MultiplierFlow;
use chetaev::motion::watch::Watch;
use chetaev::motion::StateKind;
use chetaev::symbolic::{Expr, Symbol};
use serde_json::{json, Value};

/// The right-hand side of the product's own flow.
pub const FLOW: &str = "flow";

/// The equations behind the flow: rates in quasi-velocities without singular places.
pub const REDUCED: &str = "reduced";

/// From the text to the first accelerations by compiled code, everything anew each time.
///
/// # Errors
/// What is wrong with the model.
pub fn derive(question: &Question) -> Result<Ready, String> {
    let source = Source::of(&question.root, &question.system)?;
    let question = question.clone();
    Ok(Ready {
        answer: Value::Null,
        info: json!({}),
        measure: Box::new(move || {
            let state = question.states.first().ok_or("no state is given")?;
            let clock = Clock::start();
            let (answer, derived) = first(&source, &question.variant, state, &clock)?;
            let (seconds, wall) = clock.seconds();
            Ok(json!({
                "seconds": seconds,
                "wall": wall,
                "parts": {"derive": derived, "compile": seconds - derived},
                "answer": [answer],
            }))
        }),
    })
}

/// The first accelerations, and after how many seconds the equations were derived.
fn first(
    source: &Source,
    variant: &str,
    state: &[f64],
    clock: &Clock,
) -> Result<(Vec<f64>, f64), String> {
    if variant != FLOW {
        let prepared = Prepared::new(source, state)?;
        let form = Form::of(&prepared, variant)?;
        let derived = clock.seconds().0;
        let mut program = Program::new(&prepared, &form)?;
        return Ok((program.accelerations(state)?, derived));
    }
    // The flow's functions are compiled where the terms are made, so that both are one part.
    let mut prepared = Prepared::new(source, state)?;
    let derived = clock.seconds().0;
    let mut solver = Accelerations::default();
    Ok((solve(&mut prepared, &mut solver, state)?, derived))
}

fn solve(
    prepared: &mut Prepared,
    solver: &mut Accelerations,
    state: &[f64],
) -> Result<Vec<f64>, String> {
    let (q, v) = state.split_at(prepared.numeric.n);
    prepared.numeric.evaluate(0.0, q, v).map_err(words)?;
    let chart = &prepared.start.chart;
    solver
        .solve(&prepared.numeric, chart)
        .map_err(|problem| format!("{problem:?}"))?;
    Ok(solver.a.clone())
}

/// The right-hand side in the state of a formulation, or of the flow.
///
/// # Errors
/// What is wrong with the model, or why the formulation gives no equations.
pub fn right_hand_side(question: &Question) -> Result<Ready, String> {
    let source = Source::of(&question.root, &question.system)?;
    let start = question.states.first().ok_or("no state is given")?;
    let prepared = Prepared::new(&source, start)?;
    match question.variant.as_str() {
        FLOW => of_flow(question, prepared),
        name => {
            let form = Form::of(&prepared, name)?;
            of_program(question, &Program::new(&prepared, &form)?)
        }
    }
}

/// How many states a measurement goes through.
const COUNT: usize = 1024;

/// States close to those given, so that no two are the same.
fn many(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let row = |i: usize| {
        let factor = 1.0 + 1e-9 * i as f64;
        rows[i % rows.len()].iter().map(|x| x * factor).collect()
    };
    (0..COUNT).map(row).collect()
}

fn of_flow(question: &Question, mut prepared: Prepared) -> Result<Ready, String> {
    let mut solver = Accelerations::default();
    let answer: Result<Vec<Vec<f64>>, String> = question
        .states
        .iter()
        .map(|state| solve(&mut prepared, &mut solver, state))
        .collect();
    let watch = Watch::new(
        &prepared.system,
        &prepared.terms,
        &prepared.binding,
        prepared.selection.rows.len(),
    )
    .map_err(words)?;
    let info = json!({"native": prepared.numeric.is_native()});
    let (n, start) = (prepared.numeric.n, prepared.start);
    let mut flow = MultiplierFlow::new(prepared.numeric, &start, StateKind::Full, watch);
    let states: Vec<Vec<f64>> = question
        .states
        .iter()
        .map(|state| flow.pack(&state[..n], &state[n..]))
        .collect();
    let states = many(&states);
    let mut rates = vec![0.0; flow.dimension()];
    Ok(Ready {
        answer: json!(answer?),
        info,
        measure: Box::new(move || {
            per_unit(COUNT as f64, || {
                for state in &states {
                    flow.derivative(0.0, state, &mut rates).map_err(words)?;
                }
                Ok(())
            })
        }),
    })
}

fn of_program(question: &Question, program: &Program) -> Result<Ready, String> {
    let mut program = program.clone();
    let mut answer = Vec::new();
    let mut inputs = Vec::new();
    for state in &question.states {
        answer.push(program.accelerations(state)?);
        inputs.push(program.inputs(state)?);
    }
    let info = json!({
        "native": program.rates.is_native(),
        "instructions": program.rates.program().body.len(),
    });
    let states = many(&inputs);
    let measure: Box<dyn FnMut() -> Result<Value, String>> = match question.batch {
        false => Box::new(move || program.time_scalar(&states)),
        true => Box::new(move || program.time_blocks(&states)),
    };
    Ok(Ready {
        answer: json!(answer),
        info,
        measure,
    })
}

/// A form of the equations of motion, as functions of (t, q, variables).
struct Form {
    /// The variables, each with its value as a function of (t, q, v).
    variables: Vec<(Symbol, Expr)>,
    /// The rates of the coordinates.
    velocities: Vec<Expr>,
    /// The rates of the variables.
    rates: Vec<Expr>,
    /// q''.
    accelerations: Vec<Expr>,
}

impl Form {
    fn of(prepared: &Prepared, name: &str) -> Result<Form, String> {
        match name {
            REDUCED => Form::reduced(prepared),
            _ => Ok(Form::of_formulation(prepared, &prepared.equations(name)?)),
        }
    }

    fn of_formulation(prepared: &Prepared, equations: &Equations) -> Form {
        let zero = prepared.system.graph.zero();
        let variables = equations.variables.iter();
        Form {
            variables: variables
                .map(|x| (x.symbol, x.definition.unwrap_or(zero)))
                .collect(),
            velocities: equations.velocities.clone(),
            rates: equations.rates(),
            accelerations: equations.accelerations.clone(),
        }
    }

    fn reduced(prepared: &Prepared) -> Result<Form, String> {
        let rows = &prepared.selection.rows;
        let found = reduced(&prepared.system, &prepared.terms, rows);
        let found = found.ok_or("no quasi-velocities without singular places were found")?;
        let speeds = found.characteristics.parameters.iter();
        Ok(Form {
            variables: speeds.map(|p| (p.symbol, p.definition)).collect(),
            velocities: found.characteristics.velocities,
            rates: found.rates,
            accelerations: found.accelerations,
        })
    }
}

/// Equations as native code.
#[derive(Clone)]
struct Program {
    n: usize,
    /// (t, q, variables) → the rates of the state.
    rates: std::sync::Arc<Backend>,
    /// The same → q''.
    accelerations: Functions,
    /// (t, q, v) → variables.
    definitions: Functions,
    parameters: Vec<f64>,
}

impl Program {
    fn new(prepared: &Prepared, form: &Form) -> Result<Program, String> {
        let (g, binding) = (&prepared.system.graph, &prepared.binding);
        let mut variables: Vec<Symbol> = vec![g.intern_symbol("t", 0)];
        variables.extend(prepared.system.coordinate_symbols());
        variables.extend(form.variables.iter().map(|x| x.0));
        let rates = [&form.velocities[..], &form.rates].concat();
        let (symbols, parameters): (Vec<Symbol>, Vec<f64>) =
            binding.parameters.iter().copied().unzip();
        let program = Lowering::new(g)
            .variables(&variables)
            .parameters(&symbols)
            .output("rates", &rates)
            .lower()
            .map_err(words)?;
        let definitions: Vec<Expr> = form.variables.iter().map(|x| x.1).collect();
        let accelerations = [("accelerations", form.accelerations.clone())];
        let definitions = [("variables", definitions)];
        Ok(Program {
            n: prepared.numeric.n,
            rates: std::sync::Arc::new(backend(program).map_err(words)?),
            accelerations: Functions::new(g, binding, &variables, &accelerations).map_err(words)?,
            definitions: Functions::new(g, binding, &binding.variables, &definitions)
                .map_err(words)?,
            parameters,
        })
    }

    /// (t, q, variables) of a state (q, v).
    fn inputs(&mut self, state: &[f64]) -> Result<Vec<f64>, String> {
        let (q, v) = state.split_at(self.n);
        self.definitions.evaluate(0.0, &[q, v]).map_err(words)?;
        let mut inputs = vec![0.0];
        inputs.extend_from_slice(q);
        inputs.extend_from_slice(self.definitions.group(0));
        Ok(inputs)
    }

    fn accelerations(&mut self, state: &[f64]) -> Result<Vec<f64>, String> {
        let inputs = self.inputs(state)?;
        let evaluated = self.accelerations.evaluate(0.0, &[&inputs[1..]]);
        evaluated.map_err(words)?;
        Ok(self.accelerations.group(0).to_vec())
    }

    fn time_scalar(&self, states: &[Vec<f64>]) -> Result<Value, String> {
        let mut workspace: Workspace = self.rates.workspace();
        self.rates
            .prepare(&self.parameters, &mut workspace)
            .map_err(words)?;
        let mut out = vec![0.0; self.rates.program().output_count()];
        per_unit(states.len() as f64, || {
            for state in states {
                self.rates
                    .evaluate(state, &mut workspace, &mut out)
                    .map_err(words)?;
            }
            Ok(())
        })
    }

    fn time_blocks(&self, states: &[Vec<f64>]) -> Result<Value, String> {
        let mut workspace = self.rates.block_workspace();
        let parameters: Vec<Lanes> = self.parameters.iter().map(|&p| Lanes::splat(p)).collect();
        self.rates
            .prepare_block(&parameters, &mut workspace)
            .map_err(words)?;
        let width = states.first().map_or(0, Vec::len);
        let block = |rows: &[Vec<f64>]| -> Vec<Lanes> {
            let column = |i: usize| Lanes::from_fn(|l| rows[l % rows.len()][i]);
            (0..width).map(column).collect()
        };
        let blocks: Vec<Vec<Lanes>> = states.chunks(LANES).map(block).collect();
        let mut out = vec![Lanes::default(); self.rates.program().output_count()];
        let groups = self.rates.program().outputs.len();
        per_unit((blocks.len() * LANES) as f64, || {
            for block in &blocks {
                self.rates
                    .evaluate_block(groups, block, &mut workspace, &mut out)
                    .map_err(words)?;
            }
            match workspace.failures().is_empty() {
                true => Ok(()),
                false => Err("a state of the block has no accelerations".into()),
            }
        })
    }
}
