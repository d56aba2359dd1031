//! Derivatives of a motion by its initial values and its parameters: variational equations of first and second order.
//!
//! With D_a the derivative along the direction (∂z/∂a, ȧ = 1), the rate of `S_a = ∂z/∂a` is `D_a f`, and that of `S_ab = ∂²z/∂a∂b` is `D_b D_a f`
//! with S_a moved by S_ab (Gronwall 1919). The extended system is one first-order system, integrated by Taylor series.

use crate::error::OrbitError;
use crate::flow::Flow;
use chetaev_integrate::methods::TAYLOR;
use chetaev_integrate::{integrate, EvaluationFailure, Options, Output, Stop, System};
use chetaev_motion::series::RateSeries;
use chetaev_symbolic::meter::spend;
use chetaev_symbolic::{Expr, Graph, Symbol};
use nalgebra::DMatrix;
use std::ops::ControlFlow;

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Column {
    /// The initial value of a variable, by its place.
    Initial(usize),
    /// A parameter.
    Parameter(Symbol),
}

/// Up to which order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// The motion alone.
    Motion,
    /// First derivatives.
    First,
    /// First and second derivatives.
    Second,
}

/// A motion together with its derivatives.
#[derive(Clone, Debug)]
pub struct Variational {
    /// The number of variables.
    n: usize,
    /// What is varied.
    pub columns: Vec<Column>,
    /// Pairs of columns, by which is differentiated twice.
    pub pairs: Vec<(usize, usize)>,
    parameters: Vec<f64>,
    series: RateSeries,
}

/// The extended state as a row: z, then S_a one after the other, then S_ab.
#[derive(Clone, Debug)]
pub struct Extended {
    /// z.
    pub state: Vec<f64>,
    /// S, n rows, a column for each of [`Variational::columns`].
    pub first: DMatrix<f64>,
    /// S_ab, n rows, a column for each of [`Variational::pairs`].
    pub second: DMatrix<f64>,
}

impl Extended {
    /// The start of a motion whose initial values are varied by themselves.
    pub fn start(state: &[f64], own: &Variational) -> Extended {
        let entry = |i: usize, c: usize| f64::from(u8::from(own.columns[c] == Column::Initial(i)));
        Extended {
            state: state.to_vec(),
            first: DMatrix::from_fn(own.n, own.first_columns(), entry),
            second: DMatrix::zeros(own.n, own.pairs.len()),
        }
    }

    /// All numbers, in the order of the state.
    pub(crate) fn row(&self) -> Vec<f64> {
        let matrices = self.first.iter().chain(self.second.iter());
        self.state.iter().chain(matrices).copied().collect()
    }
}

/// Relative tolerance of a run: the Taylor method goes down to the rounding of one operation.
const TOLERANCE: f64 = 1e-15;
/// What a step of one variable counts as: about two microseconds.
const UNITS_OF_A_STEP: u64 = 200;

impl Variational {
    /// The equations for the derivatives by `columns`.
    ///
    /// # Errors
    /// [`OrbitError::Functions`].
    pub fn new(flow: &Flow, columns: Vec<Column>, order: Order) -> Result<Variational, OrbitError> {
        let columns = if order == Order::Motion {
            Vec::new()
        } else {
            columns
        };
        let count = columns.len();
        let pairs: Vec<(usize, usize)> = match order {
            Order::Second => (0..count)
                .flat_map(|a| (a..count).map(move |b| (a, b)))
                .collect(),
            _ => Vec::new(),
        };
        let (variables, rates) = extended(flow, &columns, &pairs);
        let mut binding = flow.binding();
        binding.variables = [vec![flow.time()], variables].concat();
        let series = RateSeries::new(&flow.graph, &binding, &binding.variables, &rates)?;
        Ok(Variational {
            n: flow.n(),
            columns,
            pairs,
            parameters: flow.parameters.iter().map(|own| own.1).collect(),
            series,
        })
    }

    fn first_columns(&self) -> usize {
        self.columns.len()
    }

    /// Another value of a parameter, by its place in the flow.
    ///
    /// # Errors
    /// [`OrbitError::Functions`] where it makes a matrix singular.
    pub fn set(&mut self, place: usize, value: f64) -> Result<(), OrbitError> {
        self.parameters[place] = value;
        Ok(self.series.set_parameters(&self.parameters)?)
    }

    /// Rows at the times that `output` asks for.
    ///
    /// # Errors
    /// [`OrbitError::EndsEarly`].
    pub fn run(
        &mut self,
        span: (f64, f64),
        start: &Extended,
        output: Output,
    ) -> Result<Vec<(f64, Extended)>, OrbitError> {
        let (n, first, second) = (self.n, self.first_columns(), self.pairs.len());
        let width = n * (1 + first + second);
        // Whoever waits may stop it after a step.
        let mut count = |_| {
            spend(UNITS_OF_A_STEP * width as u64);
            ControlFlow::Continue(())
        };
        let options = Options {
            progress: Some(&mut count),
            ..Options::tolerance(TOLERANCE).method(&TAYLOR).output(output)
        };
        let run = integrate(self, span, &start.row(), &mut [], options)?;
        if run.stop != Stop::Finished {
            return Err(OrbitError::EndsEarly {
                t: run.t,
                end: span.1,
                stop: run.stop,
            });
        }
        let extended = |row: &[f64]| Extended {
            state: row[..n].to_vec(),
            first: DMatrix::from_column_slice(n, first, &row[n..n * (1 + first)]),
            second: DMatrix::from_column_slice(n, second, &row[n * (1 + first)..]),
        };
        let rows = run.rows.chunks_exact(width.max(1)).map(extended);
        Ok(run.times.iter().copied().zip(rows).collect())
    }

    /// The extended state at the end of a span.
    ///
    /// # Errors
    /// [`OrbitError::EndsEarly`].
    pub fn end(&mut self, span: (f64, f64), start: &Extended) -> Result<Extended, OrbitError> {
        let last = self.run(span, start, Output::End)?.pop();
        Ok(last.map_or_else(|| start.clone(), |(_, last)| last))
    }
}

/// The symbols of the derivatives of some quantities: for each column, and for each pair of columns.
#[derive(Clone, Debug)]
pub(crate) struct Symbols {
    pub(crate) first: Vec<Vec<Symbol>>,
    pub(crate) second: Vec<Vec<Symbol>>,
}

impl Symbols {
    /// Symbols for `n` quantities; no name of a model contains a space.
    pub(crate) fn new(
        g: &Graph,
        (what, n): (&str, usize),
        columns: usize,
        pairs: &[(usize, usize)],
    ) -> Symbols {
        let family = |name: String| -> Vec<Symbol> {
            (0..n)
                .map(|i| g.intern_symbol(&format!("{name} {i}"), 0))
                .collect()
        };
        let pairs = pairs.iter();
        Symbols {
            first: (0..columns)
                .map(|a| family(format!("{what} by {a}")))
                .collect(),
            second: pairs
                .map(|(a, b)| family(format!("{what} by {a} and {b}")))
                .collect(),
        }
    }
}

/// The first and second derivatives of functions of `quantities` and parameters: for each column, and then for each pair.
pub(crate) fn derivatives(
    g: &Graph,
    functions: &[Expr],
    (quantities, symbols): (&[Symbol], &Symbols),
    (columns, pairs): (&[Column], &[(usize, usize)]),
) -> (Vec<Vec<Expr>>, Vec<Vec<Expr>>) {
    let moved = |a: usize, s: Symbol| -> Option<Expr> {
        if columns[a] == Column::Parameter(s) {
            return Some(g.one());
        }
        let place = quantities.iter().position(|own| *own == s)?;
        Some(g.symbol_expr(symbols.first[a][place]))
    };
    let first: Vec<Vec<Expr>> = (0..columns.len())
        .map(|a| g.derive(functions, &|s| moved(a, s)))
        .collect();
    let of_pair = |(own, &(a, b)): (&Vec<Symbol>, &(usize, usize))| {
        let value = |s: Symbol| {
            let place = symbols.first[a].iter().position(|x| *x == s);
            let twice = place.map(|i| g.symbol_expr(own[i]));
            twice.or_else(|| moved(b, s))
        };
        g.derive(&first[a], &value)
    };
    let second = symbols.second.iter().zip(pairs).map(of_pair).collect();
    (first, second)
}

/// Variables and rates of the extended system.
fn extended(flow: &Flow, columns: &[Column], pairs: &[(usize, usize)]) -> (Vec<Symbol>, Vec<Expr>) {
    let g = &flow.graph;
    let symbols = Symbols::new(g, ("varied", flow.n()), columns.len(), pairs);
    let of = (&flow.variables[..], &symbols);
    let (first, second) = derivatives(g, &flow.rates, of, (columns, pairs));
    let rates = [flow.rates.clone(), first.concat(), second.concat()].concat();
    (variables(flow, &symbols), rates)
}

/// The variables of the extended system in the order of its state.
pub(crate) fn variables(flow: &Flow, symbols: &Symbols) -> Vec<Symbol> {
    let (first, second) = (symbols.first.concat(), symbols.second.concat());
    [flow.variables.clone(), first, second].concat()
}

impl System for Variational {
    fn dimension(&self) -> usize {
        self.n * (1 + self.columns.len() + self.pairs.len())
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        let mut both = vec![0.0; 2 * y.len()];
        self.series.expand(t, y, 1, &mut both)?;
        dy.copy_from_slice(&both[y.len()..]);
        Ok(())
    }

    fn has_series(&self) -> bool {
        true
    }

    fn expand(
        &mut self,
        t: f64,
        (y, _): (&[f64], &[f64]),
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        self.series.expand(t, y, order, coefficients)
    }
}
