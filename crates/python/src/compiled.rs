//! Equations of motion as functions over NumPy arrays.

use crate::address::{Data, Door};
use crate::annotations::{ArrayLike, Doubles, Target, Vector};
use crate::program::{Program, Ready};
use crate::texts::Pairs;
use crate::{problem, waiting};
use chetaev::compile::{backend, BlockEvaluator, EvaluateFailure, Lanes, Lowering, LANES};
use chetaev::mechanics::characteristics::CharacteristicsError;
use chetaev::mechanics::{Prepared, System};
use chetaev::model::model::ModelText;
use chetaev::model::Model;
use chetaev::motion::functions::FunctionsError;
use chetaev::motion::{Binding, NumericError};
use chetaev::study::free::following;
use chetaev::study::start;
use chetaev::symbolic::{Expr, Graph};
use numpy::ndarray::{Axis, Slice};
use numpy::{
    BorrowError, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::type_object::PyTypeInfo;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Why there are no functions.
#[derive(Debug, thiserror::Error)]
pub(crate) enum NotCompiled {
    /// No admissible state.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// Something has no number.
    #[error(transparent)]
    Numeric(#[from] NumericError),
    /// The expressions have no program.
    #[error(transparent)]
    Functions(#[from] FunctionsError),
    /// The state of such a system is more than positions and velocities.
    #[error("the constraint `{constraint}` is of order {order}: the state is more than positions and velocities; `simulate` computes the motion")]
    HigherOrder {
        /// One of the highest order.
        constraint: String,
        /// m.
        order: u32,
    },
}

/// The equations of motion of a system with the values of its parameters, compiled when they are first asked for. The state y is
/// (coordinates, masses with a law of their own, velocities).
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Compiled {
    system: System,
    prepared: Prepared,
    binding: Binding,
    /// Accelerations, then the multipliers of the independent constraints.
    unknowns: Vec<Expr>,
    /// What the model defines by names, as functions of the state.
    definitions: Vec<(String, Expr)>,
    origin: Arc<Origin>,
    known: [OnceLock<Arc<Program>>; WHAT.len()],
}

/// Where functions come from: enough to make them again anywhere.
pub(crate) struct Origin {
    /// The model.
    pub(crate) text: ModelText,
    /// Names of the components of the state.
    pub(crate) state: Vec<String>,
}

/// What can be asked for.
const WHAT: [&str; 6] = [
    "rates",
    "jacobian",
    "mass",
    "reactions",
    "residuals",
    "definitions",
];

impl Compiled {
    /// The functions of the system of a model. Of what the model defines by names, that is taken which the state determines; parameters
    /// that follow from others are computed from these.
    pub(crate) fn new(model: &Model, system: &System) -> Result<Compiled, NotCompiled> {
        let g = &system.graph;
        let defined = model.defines.iter().chain(&model.sensors);
        let defined: Vec<_> = defined.map(|own| (own.name.clone(), own.value)).collect();
        let prepared = start::prepared(model, system)?;
        let higher = system.constraints.iter().filter(|own| own.order > 1);
        if let Some(highest) = higher.max_by_key(|own| own.order) {
            return Err(NotCompiled::HigherOrder {
                constraint: highest.name.clone(),
                order: highest.order,
            });
        }
        let binding = Binding::new(system)?.with_following(g, &following(model));
        let origin = Origin {
            text: model.text.clone(),
            state: binding.variables[1..]
                .iter()
                .map(|&s| g.symbol_text(s))
                .collect(),
        };
        let unknowns = unknowns(system, &prepared)?;
        Ok(Compiled {
            definitions: determined(system, (&prepared, &binding), &unknowns, defined),
            unknowns,
            system: system.clone(),
            prepared,
            binding,
            origin: Arc::new(origin),
            known: Default::default(),
        })
    }

    /// v, rates of masses, accelerations.
    fn rates(&self) -> Vec<Expr> {
        let g = &self.system.graph;
        let velocities = self.system.velocity_symbols().into_iter();
        let velocities = velocities.map(|v| g.symbol_expr(v));
        let masses = self.system.masses.iter().map(|m| m.rate);
        let accelerations = self.unknowns.iter().take(self.system.n()).copied();
        velocities.chain(masses).chain(accelerations).collect()
    }

    /// Values and their shape.
    fn expressions(&self, what: usize) -> (Vec<Expr>, Vec<usize>) {
        let (g, n) = (&self.system.graph, self.system.n());
        let terms = &self.prepared.terms;
        let lawful = |es: &[Expr]| g.substitute_all(es, &self.binding.controls);
        match WHAT[what] {
            "rates" => {
                let rates = lawful(&self.rates());
                let count = rates.len();
                (rates, vec![count])
            }
            "jacobian" => {
                let rates = lawful(&self.rates());
                let count = rates.len();
                let rows = g.jacobian(&rates, &self.binding.variables[1..]);
                (rows.concat(), vec![count, count])
            }
            "mass" => (lawful(&terms.mass_matrix.concat()), vec![n, n]),
            "reactions" => {
                let mut all = vec![g.zero(); terms.constraints.len()];
                for (&row, &value) in self.prepared.selection.rows.iter().zip(&self.unknowns[n..]) {
                    all[row] = value;
                }
                let count = all.len();
                (lawful(&all), vec![count])
            }
            "definitions" => {
                let all: Vec<Expr> = self.definitions.iter().map(|own| own.1).collect();
                let count = all.len();
                (all, vec![count])
            }
            _ => (lawful(&terms.constraints), vec![terms.constraints.len()]),
        }
    }

    fn program(&self, what: usize) -> Result<Arc<Program>, FunctionsError> {
        if let Some(known) = self.known[what].get() {
            return Ok(known.clone());
        }
        let (values, shape) = self.expressions(what);
        let made = program(&self.system.graph, &self.binding, &values, shape)?;
        Ok(self.known[what].get_or_init(|| Arc::new(made)).clone())
    }
}

/// The solution of `M a − Jᵀ λ = b`, `J a = g` with the independent rows of J (T2 §4).
fn unknowns(system: &System, prepared: &Prepared) -> Result<Vec<Expr>, FunctionsError> {
    let (g, n, terms) = (&system.graph, system.n(), &prepared.terms);
    let rows = &prepared.selection.rows;
    let size = n + rows.len();
    let mut matrix = vec![g.zero(); size * size];
    for (i, row) in terms.mass_matrix.iter().enumerate() {
        matrix[i * size..i * size + n].copy_from_slice(row);
    }
    for (l, &row) in rows.iter().enumerate() {
        for (i, &entry) in terms.jacobian[row].iter().enumerate() {
            matrix[(n + l) * size + i] = entry;
            matrix[i * size + n + l] = g.neg(entry);
        }
    }
    let rates = rows.iter().map(|&row| terms.constraint_rate[row]);
    let right: Vec<Expr> = terms.force.iter().copied().chain(rates).collect();
    g.solve(&matrix, &right)
        .map_err(|_| FunctionsError::Singular)
}

/// The definitions that are functions of (t, q, v) once accelerations and multipliers are those of the motion.
fn determined(
    system: &System,
    (prepared, binding): (&Prepared, &Binding),
    unknowns: &[Expr],
    defined: Vec<(String, Expr)>,
) -> Vec<(String, Expr)> {
    let g = &system.graph;
    let accelerations = system.coordinates.iter().map(|c| g.symbol_expr(c.a_symbol));
    let rows = prepared.selection.rows.iter();
    let multipliers = rows.map(|&row| {
        let constraint = &system.constraints[prepared.terms.constraint_index[row]];
        g.symbol(&format!("lambda_{}", constraint.name), 0)
    });
    let known: Vec<(Expr, Expr)> = accelerations
        .chain(multipliers)
        .zip(unknowns.iter().copied())
        .collect();
    let parameters = binding.parameters.iter().map(|own| own.0);
    let given: Vec<_> = binding
        .variables
        .iter()
        .copied()
        .chain(parameters)
        .collect();
    let value = |(name, value): (String, Expr)| {
        let value = g.substitute(g.substitute(value, &known), &binding.controls);
        let is_given = g.symbols_in(&[value]).iter().all(|own| given.contains(own));
        is_given.then_some((name, value))
    };
    defined.into_iter().filter_map(value).collect()
}

fn program(
    g: &Graph,
    binding: &Binding,
    values: &[Expr],
    shape: Vec<usize>,
) -> Result<Program, FunctionsError> {
    let present = values.iter().enumerate().filter(|(_, &e)| !g.is_zero(e));
    let (places, values): (Vec<usize>, Vec<Expr>) = present.map(|(i, &e)| (i, e)).unzip();
    let symbols: Vec<_> = binding.parameters.iter().map(|own| own.0).collect();
    let lowering = Lowering::new(g)
        .variables(&binding.variables)
        .parameters(&symbols)
        .output("values", &values);
    Ok(Program {
        backend: backend(lowering.lower()?)?,
        width: binding.variables.len() - 1,
        shape,
        places,
    })
}

#[pymethods]
impl Compiled {
    /// Names of the components of the state: coordinates, masses with a law of their own, velocities.
    #[getter]
    fn state(&self) -> Vec<String> {
        self.origin.state.clone()
    }

    /// Names of the constraints, one for each component of reactions and residuals.
    #[getter]
    fn constraints(&self) -> Vec<&str> {
        let all = self.prepared.terms.constraint_index.iter();
        all.map(|&l| self.system.constraints[l].name.as_str())
            .collect()
    }

    /// Names of what the model defines, one for each component of the definitions.
    #[getter]
    fn definitions(&self) -> Vec<&str> {
        self.definitions.iter().map(|own| own.0.as_str()).collect()
    }

    /// Names and values of the free parameters.
    #[getter]
    fn parameters(&self) -> Vec<(String, f64)> {
        let g = &self.system.graph;
        let all = self.binding.parameters.iter();
        all.map(|&(s, value)| (g.symbol_text(s), value)).collect()
    }

    /// One of the functions, with these values of the parameters, in their order.
    #[pyo3(signature = (what, parameters: "list[float] | None" = None))]
    fn function(
        &self,
        py: Python<'_>,
        what: &str,
        parameters: Option<Vec<f64>>,
    ) -> PyResult<Function> {
        let Some(what) = WHAT.iter().position(|own| *own == what) else {
            return Err(PyValueError::new_err(format!(
                "there is no function `{what}`"
            )));
        };
        let program = waiting::whole(py, None, |_| self.program(what))?
            .map_err(|problem| problem::of_option(py, &problem))?;
        let usual = || self.binding.parameters.iter().map(|own| own.1).collect();
        let parameters = parameters.unwrap_or_else(usual);
        let ready = program
            .ready(&parameters)
            .map_err(|problem| problem::of_option(py, &problem))?;
        let function = Function {
            program,
            parameters,
            ready: Mutex::new(vec![ready]),
            door: OnceLock::new(),
            data: PyOnceLock::new(),
            origin: self.origin.clone(),
            what,
        };
        Ok(function)
    }
}

/// A compiled function f(t, y, out=None).
///
/// Parameters
/// ----------
/// t : float
///     The time.
/// y : array of shape (n,), or (…, n) for many states at once
///     States.
/// out : array of doubles of the shape of the result, optional
///     Where the values are written.
///
/// Returns
/// -------
/// array
///     The values; where the equations have no solution they are not finite: not a number, or infinite where a number is divided by zero.
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Function {
    program: Arc<Program>,
    parameters: Vec<f64>,
    /// Storage that no thread uses at present.
    ready: Mutex<Vec<Ready>>,
    /// How other programs call it, once one was asked for.
    door: OnceLock<Arc<Door>>,
    /// What they hand over.
    data: PyOnceLock<Py<PyArray1<f64>>>,
    origin: Arc<Origin>,
    what: usize,
}

/// What a function is made again from: a model, which function, its parameters.
type Again = ((String, String, Pairs, Pairs), &'static str, Vec<f64>);

/// So many states are computed one by one: a block takes the time of several.
const FEW: usize = 4;

impl Function {
    /// Does something with storage that no other thread uses meanwhile.
    fn with_ready<T>(&self, work: impl FnOnce(&mut Ready) -> T) -> Result<T, EvaluateFailure> {
        let known = self.free().pop();
        let mut ready = match known {
            Some(ready) => ready,
            None => self.program.ready(&self.parameters)?,
        };
        let done = work(&mut ready);
        self.free().push(ready);
        Ok(done)
    }

    fn free(&self) -> std::sync::MutexGuard<'_, Vec<Ready>> {
        self.ready.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// One state.
    fn one<'py>(
        &self,
        t: f64,
        y: &PyReadonlyArray1<'py, f64>,
        write: impl FnOnce(&[f64]) -> PyResult<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let program = &self.program;
        let done = self.with_ready(|ready| match y.as_slice() {
            Ok(y) => write(program.at(ready, t, y.iter().copied())),
            Err(_) => write(program.at(ready, t, y.as_array().iter().copied())),
        });
        done.map_err(|problem| PyValueError::new_err(problem.to_string()))?
    }

    /// Many states; `values` has a row for each.
    fn many(
        &self,
        t: numpy::ndarray::ArrayView1<'_, f64>,
        y: numpy::ndarray::ArrayView2<'_, f64>,
        values: &mut [f64],
    ) -> Result<(), EvaluateFailure> {
        let (size, count) = (self.program.size(), y.nrows());
        let time = |j: usize| t[if t.len() == 1 { 0 } else { j }];
        if size == 0 {
            return Ok(());
        }
        if count < FEW {
            return self.with_ready(|ready| {
                for (j, row) in values.chunks_exact_mut(size).enumerate() {
                    let state = y.row(j);
                    row.copy_from_slice(self.program.at(ready, time(j), state.iter().copied()));
                }
            });
        }
        let own = &self.program.backend;
        let mut workspace = own.block_workspace();
        let parameters: Vec<Lanes> = self.parameters.iter().map(|&p| Lanes::splat(p)).collect();
        own.prepare_block(&parameters, &mut workspace)?;
        let mut inputs = vec![Lanes::default(); self.program.width + 1];
        let mut computed = vec![Lanes::default(); self.program.places.len()];
        for first in (0..count).step_by(LANES) {
            let last = (first + LANES).min(count) - 1;
            let at = |lane: usize| (first + lane).min(last);
            inputs[0] = Lanes::from_fn(|lane| time(at(lane)));
            for lane in 0..LANES {
                let state = y.row(at(lane));
                for (input, &y) in inputs[1..].iter_mut().zip(state) {
                    input.as_mut_slice()[lane] = y;
                }
            }
            own.evaluate_block(1, &inputs, &mut workspace, &mut computed)?;
            let rows = &mut values[first * size..(last + 1) * size];
            for (&place, column) in self.program.places.iter().zip(&computed) {
                for (row, &value) in rows.chunks_exact_mut(size).zip(column.as_slice()) {
                    row[place] = value;
                }
            }
            for &(lane, _) in workspace.failures() {
                if first + lane <= last {
                    rows[lane * size..(lane + 1) * size].fill(f64::NAN);
                }
            }
        }
        Ok(())
    }

    /// How other programs call this function.
    fn door(&self) -> &Arc<Door> {
        self.door
            .get_or_init(|| Arc::new(Door::new(self.program.clone(), &self.parameters)))
    }

    /// What is no vector of doubles: sequences, other numbers, batches.
    fn general<'py>(
        &self,
        py: Python<'py>,
        (t, y): (&Bound<'py, PyAny>, &Bound<'py, PyAny>),
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let numpy = py.import("numpy")?;
        let y = doubles(&numpy, "y", &array(&numpy, y)?)?;
        let t = doubles(&numpy, "t", t)?;
        let mut shape: Vec<usize> = y.getattr("shape")?.extract()?;
        let last = shape.pop();
        if last != Some(self.program.width) {
            return Err(PyValueError::new_err(format!(
                "the last axis of y has the {} components of the state, not {}",
                self.program.width,
                last.map_or("none".to_owned(), |own| own.to_string())
            )));
        }
        let count: usize = shape.iter().product();
        let rows = match shape.len() {
            1 => y.clone(),
            _ => y.call_method1("reshape", ((count, self.program.width),))?,
        };
        let t = match t.getattr("ndim")?.extract::<usize>()? {
            0 => t.call_method1("reshape", (1,))?,
            _ => {
                let given = t.getattr("shape")?.repr()?;
                let wide = numpy.call_method1("broadcast_to", (t, shape.clone()));
                let wide = wide.map_err(|_| {
                    PyValueError::new_err(format!(
                        "t is one time, or one for each state: its shape is {given}, and that of the states {shape:?}"
                    ))
                })?;
                wide.call_method1("reshape", (count,))?
            }
        };
        let whole: Vec<usize> = shape.iter().chain(&self.program.shape).copied().collect();
        let target = match out {
            // By NumPy's own function, which says that there is no memory.
            None => {
                let zeros = numpy.call_method1("zeros", (&whole,))?;
                zeros.cast::<PyArrayDyn<f64>>()?.clone()
            }
            Some(out) => {
                let out = array(&numpy, out)?;
                let out = out
                    .cast::<PyArrayDyn<f64>>()
                    .map_err(|_| PyTypeError::new_err("out is an array of doubles (float64)"))?;
                if out.shape() != whole {
                    return Err(PyValueError::new_err(format!(
                        "out is an array of shape {whole:?}, not {:?}",
                        out.shape()
                    )));
                }
                if !out.is_c_contiguous() {
                    return Err(PyValueError::new_err(
                        "out is no contiguous array: its numbers do not lie one after the other",
                    ));
                }
                out.clone()
            }
        };
        let y: PyReadonlyArray2<'_, f64> = rows.extract()?;
        let t: PyReadonlyArray1<'_, f64> = t.extract()?;
        let mut write = target.try_readwrite().map_err(|why| not_written(&why))?;
        let values = write
            .as_slice_mut()
            .map_err(|problem| PyValueError::new_err(problem.to_string()))?;
        if out.is_some() && self.program.places.len() < self.program.size() {
            values.fill(0.0);
        }
        let (t, y, size) = (t.as_array(), y.as_array(), self.program.size().max(1));
        // Signals are heard between pieces, each of which takes a moment.
        let piece = (PIECE / size).next_multiple_of(LANES);
        for (number, values) in values.chunks_mut(piece * size).enumerate() {
            let (first, last) = (number * piece, (number * piece + piece).min(count));
            let y = y.slice_axis(Axis(0), Slice::from(first..last));
            let t = match t.len() {
                1 => t,
                _ => t.slice_axis(Axis(0), Slice::from(first..last)),
            };
            let done = py.detach(|| self.many(t, y, values));
            done.map_err(|problem| PyValueError::new_err(problem.to_string()))?;
            py.check_signals()?;
        }
        Ok(out.cloned().unwrap_or_else(|| target.into_any()))
    }
}

/// So many values are computed before signals are looked at.
const PIECE: usize = 1 << 20;

/// An array of doubles in its place, copied where it has other numbers or does not lie as doubles do. What has more than real numbers is
/// refused: nothing of it is dropped.
fn doubles<'py>(
    numpy: &Bound<'py, PyModule>,
    name: &str,
    value: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let masked = numpy.getattr("ma")?.call_method1("is_masked", (value,))?;
    if masked.is_truthy()? {
        return Err(PyTypeError::new_err(format!(
            "{name} is a masked array: there is no value where it is masked; fill or compress it first"
        )));
    }
    let given = numpy.call_method1("asarray", (value,))?;
    let kind: String = given.getattr("dtype")?.getattr("kind")?.extract()?;
    match kind.as_str() {
        "b" | "i" | "u" | "f" => numpy.call_method1("require", (given, "f8", "A")),
        "c" => Err(PyTypeError::new_err(format!(
            "{name} is complex, and states are real: derivatives by the state are exact in `jac`, and need no complex step"
        ))),
        "O" => floats(numpy, &given),
        _ => Err(PyTypeError::new_err(format!(
            "{name} has elements of the kind {}, and states are numbers",
            given.getattr("dtype")?.str()?
        ))),
    }
}

/// An array of objects, each of which is a number: `None` is none.
fn floats<'py>(
    numpy: &Bound<'py, PyModule>,
    given: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let flat: Vec<f64> = given.call_method0("ravel")?.extract()?;
    let shape = given.getattr("shape")?;
    numpy
        .call_method1("asarray", (flat, "f8"))?
        .call_method1("reshape", (shape,))
}

/// Why values cannot be written into an array.
fn not_written(why: &BorrowError) -> PyErr {
    let said = match why {
        BorrowError::AlreadyBorrowed => {
            "out shares memory with y, or is written by another thread: values would be written over what they are computed from"
        }
        BorrowError::NotWriteable => "out is read-only",
        _ => "out cannot be written",
    };
    PyValueError::new_err(said)
}

/// Whether an array is one of NumPy itself, no subclass, and its doubles lie where doubles may lie.
fn is_plain(y: &Bound<'_, PyArray1<f64>>) -> bool {
    let word = size_of::<f64>();
    y.get_type().is(PyUntypedArray::type_object(y.py()))
        && (y.data() as usize).is_multiple_of(word)
        && y.strides().iter().all(|own| own % word as isize == 0)
}

/// What is no array of NumPy and offers its memory by DLPack, as an array of the same memory.
fn array<'py>(
    numpy: &Bound<'py, PyModule>,
    value: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let is_known = value.cast::<PyUntypedArray>().is_ok();
    if !is_known && value.hasattr("__dlpack__")? {
        return numpy.call_method1("from_dlpack", (value,));
    }
    Ok(value.clone())
}

impl Function {
    /// The values at one state, or at many.
    fn call<'py>(
        &self,
        py: Python<'py>,
        (t, y): (&Bound<'py, PyAny>, &Bound<'py, PyAny>),
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let single = y.cast::<PyArray1<f64>>().ok();
        let single =
            single.filter(|y| y.len() == self.program.width && self.program.shape.len() == 1);
        let single = single.filter(|y| is_plain(y));
        let (Some(single), Ok(time)) = (single, t.extract::<f64>()) else {
            return self.general(py, (t, y), out);
        };
        let y = single
            .try_readonly()
            .map_err(|problem| PyValueError::new_err(problem.to_string()))?;
        match out.map(|out| out.cast::<PyArray1<f64>>()) {
            None => self.one(time, &y, |values| {
                Ok(PyArray1::from_slice(py, values).into_any())
            }),
            Some(Ok(target)) if target.len() == self.program.size() => {
                self.one(time, &y, |values| {
                    let mut write = target.try_readwrite().map_err(|why| not_written(&why))?;
                    let own = write
                        .as_slice_mut()
                        .map_err(|problem| PyValueError::new_err(problem.to_string()))?;
                    own.copy_from_slice(values);
                    Ok(target.clone().into_any())
                })
            }
            Some(_) => Err(PyTypeError::new_err(format!(
                "out is a vector of {} doubles (float64)",
                self.program.size()
            ))),
        }
    }
}

#[pymethods]
impl Function {
    #[pyo3(signature = (t, y, out=None))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        t: ArrayLike<'_, 'py>,
        y: ArrayLike<'_, 'py>,
        out: Option<Target<'_, 'py>>,
    ) -> PyResult<Doubles<'py>> {
        self.call(py, (&t, &y), out.as_deref()).map(Doubles)
    }

    /// Where the function `void f(double t, double *y, double *values, double *data)` is, for callers that know C only: Numba,
    /// numbalsoda, SUNDIALS. `data` is that of this object.
    #[getter]
    fn address(&self) -> usize {
        self.door().address()
    }

    /// What such a caller hands over as `data`: which function is meant, then the parameters in their order. It is one array, in which the parameters
    /// may be changed: for all calls by the address that hand it over, and not for calls of this object. It serves as long as it lives itself; by a
    /// copy of it the values are not a number once it and this object are gone.
    #[getter]
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Vector<'py>> {
        let made = || Ok(Data::array(py, self.door().clone(), &self.parameters)?.unbind());
        let found: PyResult<&Py<PyArray1<f64>>> = self.data.get_or_try_init(py, made);
        Ok(Vector(found?.bind(py).clone()))
    }

    /// The function at `address` as `ctypes` has it.
    #[getter]
    fn ctypes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let ctypes = py.import("ctypes")?;
        let (double, pointer) = (ctypes.getattr("c_double")?, ctypes.getattr("c_void_p")?);
        let arguments = (py.None(), double, &pointer, &pointer, &pointer);
        let signature = ctypes.call_method1("CFUNCTYPE", arguments)?;
        signature.call1((self.address(),))
    }

    fn __repr__(&self) -> String {
        let shape: Vec<String> = self.program.shape.iter().map(usize::to_string).collect();
        format!(
            "<f(t, y, out=None): {} of shape (…, {}), y = ({})>",
            WHAT[self.what],
            shape.join(", "),
            self.origin.state.join(", ")
        )
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Again)> {
        let own = self.origin.text.clone();
        let again = py.import("chetaev.compiled")?.getattr("function")?;
        let text = (own.path, own.text, own.includes, own.overrides);
        Ok((again, (text, WHAT[self.what], self.parameters.clone())))
    }

    /// Whether machine code runs.
    #[getter]
    fn is_native(&self) -> bool {
        self.program.backend.is_native()
    }
}
