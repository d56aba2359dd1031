//! Many trajectories of one model: `sweep`.

use crate::annotations::{Column, Numbers, Tell};
use crate::texts::Pairs;
use crate::{problem, waiting};
use chetaev::ensemble::pool::{self, Batch};
use chetaev::ensemble::{Kind, Outcome};
use chetaev::model::model::Model;
use chetaev::model::Diagnostics;
use chetaev::store::{self, Ended, NotKept, Opened};
use chetaev::study::sweep::together::{Together, VariationError, Variations};
use chetaev::study::sweep::vary::{rows, Variation};
use chetaev::study::sweep::Sweep as Prepared;
use chetaev::study::Hooks;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// What varies.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Varied {
    vary: Pairs,
    initial: Pairs,
    rows: Option<String>,
    zip: bool,
    count: Option<u64>,
    seed: u64,
    pub(crate) samples: u32,
}

/// Why nothing varies as it was asked for.
pub(crate) enum NotVaried {
    Texts(Box<Diagnostics>),
    Together(VariationError),
}

impl NotVaried {
    pub(crate) fn raised(&self, py: Python<'_>) -> PyErr {
        match self {
            NotVaried::Texts(found) => problem::of_model(py, found),
            NotVaried::Together(problem) => problem::of_option(py, problem),
        }
    }
}

impl Varied {
    /// Reads ranges and rows.
    pub(crate) fn variations(&self, model: &Model) -> Result<Variations, NotVaried> {
        let texts = |found: Diagnostics| NotVaried::Texts(Box::new(found));
        let mut ranges = Vec::new();
        for (label, is_initial, own) in [
            ("vary", false, &self.vary),
            ("initial", true, &self.initial),
        ] {
            for (name, range) in own {
                let text = format!("{name}={range}");
                ranges.push(Variation::parse(model, (label, &text), is_initial).map_err(texts)?);
            }
        }
        let listed = match &self.rows {
            Some(text) => rows(model, "rows", text).map_err(texts)?,
            None => Vec::new(),
        };
        let together = Together {
            zip: self.zip,
            count: self.count,
            seed: self.seed,
        };
        Variations::new(listed, ranges, together).map_err(NotVaried::Together)
    }
}

/// A sweep that is derived and compiled.
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Sweep {
    prepared: Prepared,
}

impl Sweep {
    pub(crate) fn new(prepared: Prepared) -> Sweep {
        Sweep { prepared }
    }

    /// Computes trajectories until all are there, one failed and that ends it, or an interrupt.
    fn rows(
        &self,
        (first, last): (u64, u64),
        (threads, ends_at_failure): (usize, bool),
        hooks: &mut Hooks<'_>,
    ) -> Vec<(u64, Vec<f64>, Outcome)> {
        let own = &self.prepared;
        let mut rows = Vec::new();
        let never = AtomicBool::new(false);
        let interrupt = hooks.interrupt.unwrap_or(&never);
        let sink = |batch: Batch| {
            let failed = batch.iter().any(|(_, outcome)| outcome.stop.is_failure());
            let batch = batch.into_iter();
            rows.extend(batch.map(|(index, outcome)| (index, own.values(index), outcome)));
            let done = rows.len() as f64 / (last - first).max(1) as f64;
            (hooks.progress)("computing trajectories", Some(done));
            if failed && ends_at_failure {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let wanted = first..last;
        let wanted = std::slice::from_ref(&wanted);
        pool::run(&*own.work(), (wanted, threads), interrupt, sink);
        rows.sort_by_key(|(index, ..)| *index);
        rows
    }
}

/// Numbers of trajectories, the columns, the failures with their reasons.
type Arrays<'py> = (Numbers<'py>, Vec<Column<'py>>, Vec<(u64, String)>);

/// How many trajectories a folder had before, what is to be said of it, what it has of a sweep that is not complete, and whether Ctrl-C ended it.
type Kept<'py> = (u64, Option<String>, Option<Arrays<'py>>, bool);

/// Numbers of trajectories, the columns, the failures with their reasons, and whether Ctrl-C ended it.
type Computed<'py> = (Numbers<'py>, Vec<Column<'py>>, Vec<(u64, String)>, bool);

#[pymethods]
impl Sweep {
    /// Number of trajectories.
    #[getter]
    fn count(&self) -> u64 {
        self.prepared.count()
    }

    /// Names of the columns.
    #[getter]
    fn columns(&self) -> Vec<&str> {
        let all = self.prepared.columns().list.iter();
        all.map(|column| column.name.as_str()).collect()
    }

    /// Names of the events of the model.
    #[getter]
    fn events(&self) -> Vec<&str> {
        self.prepared.events()
    }

    /// What makes this sweep another than others.
    fn description(&self) -> Vec<(&'static str, String)> {
        self.prepared.description()
    }

    /// Computes the trajectories with the numbers first to last, without the last.
    #[pyo3(signature = (first, last, threads=None, stop_on_failure=false, tell=None))]
    fn compute<'py>(
        &self,
        py: Python<'py>,
        first: u64,
        last: u64,
        threads: Option<usize>,
        stop_on_failure: bool,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Computed<'py>> {
        let threads = threads.unwrap_or_else(all_threads);
        let last = last.min(self.prepared.count());
        let found = waiting::done(py, tell, |hooks| {
            let rows = self.rows((first, last), (threads, stop_on_failure), hooks);
            let count = rows.len();
            (self.prepared.columns().encode(&rows), count)
        })?;
        let (bytes, count) = found.result;
        let (indices, arrays, failures) = self.decoded(py, count, &bytes)?;
        Ok((indices, arrays, failures, found.interrupted))
    }

    /// The sweep in a folder as the command keeps it: what is there is taken over, and what is missing computed.
    #[pyo3(signature = (folder, threads=None, stop_on_failure=false, tell=None))]
    fn keep<'py>(
        &self,
        py: Python<'py>,
        folder: PathBuf,
        threads: Option<usize>,
        stop_on_failure: bool,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Kept<'py>> {
        let with = (threads.unwrap_or_else(all_threads), stop_on_failure);
        let found = waiting::done(py, tell, |hooks| self.kept(&folder, with, hooks))?;
        let kept = found.result;
        let kept = kept.map_err(|problem| problem::of_option(py, &problem))?;
        let part = match kept.part {
            Some((count, bytes)) => Some(self.decoded(py, count, &bytes)?),
            None => None,
        };
        Ok((kept.taken, kept.note, part, found.interrupted))
    }
}

/// What was done in a folder.
struct InFolder {
    /// How many trajectories were there before.
    taken: u64,
    /// What is to be said.
    note: Option<String>,
    /// What is there of a sweep that is not complete: how many trajectories, and one batch of them.
    part: Option<(usize, Vec<u8>)>,
}

fn all_threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get)
}

impl Sweep {
    fn kept(
        &self,
        folder: &Path,
        with: (usize, bool),
        hooks: &mut Hooks<'_>,
    ) -> Result<InFolder, NotKept> {
        let own = &self.prepared;
        let mut store = match store::open(folder, own)? {
            Opened::Begun(store) => store,
            Opened::Complete(_) => {
                return Ok(InFolder {
                    taken: own.count(),
                    note: None,
                    part: None,
                })
            }
        };
        let mut found = InFolder {
            taken: store.written(),
            note: store.note().map(str::to_owned),
            part: None,
        };
        let never = AtomicBool::new(false);
        let interrupt = hooks.interrupt.unwrap_or(&never);
        let is_over = with.1 && store.failure().is_some();
        let ended = if is_over {
            Ended::Interrupted
        } else {
            store.compute(own, with, interrupt, &mut |written, _| {
                let done = written as f64 / own.count().max(1) as f64;
                (hooks.progress)("computing trajectories", Some(done));
            })?
        };
        if ended == Ended::Complete {
            store.finish()?;
        } else {
            found.part = Some(store.batches()?);
            store.leave()?;
        }
        Ok(found)
    }

    /// A batch as arrays: numbers of the trajectories, columns, failures.
    fn decoded<'py>(&self, py: Python<'py>, count: usize, bytes: &[u8]) -> PyResult<Arrays<'py>> {
        let columns = self.prepared.columns();
        let mut arrays = Vec::with_capacity(columns.list.len());
        for (at, column) in columns.list.iter().enumerate() {
            let words = bytes[columns.range(at, count)].as_chunks::<8>().0.iter();
            let array = match column.kind {
                Kind::Float => {
                    let all: Vec<f64> = words.map(|word| f64::from_le_bytes(*word)).collect();
                    shaped(PyArray1::from_vec(py, all), count, column.samples)?
                }
                Kind::Integer => {
                    let all: Vec<i64> = words.map(|word| i64::from_le_bytes(*word)).collect();
                    PyArray1::from_vec(py, all).into_any()
                }
            };
            arrays.push(Column(array));
        }
        let indices = chetaev::ensemble::Columns::indices(count, bytes);
        let indices = Numbers(PyArray1::from_vec(py, indices));
        Ok((indices, arrays, columns.failures(count, bytes)))
    }
}

/// One number for each trajectory, or a row of samples.
fn shaped<'py>(
    all: Bound<'py, PyArray1<f64>>,
    count: usize,
    samples: Option<usize>,
) -> PyResult<Bound<'py, PyAny>> {
    match samples {
        Some(samples) => Ok(all.reshape([count, samples])?.into_any()),
        None => Ok(all.into_any()),
    }
}
