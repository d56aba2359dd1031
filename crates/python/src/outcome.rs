//! A study with its motion.

use crate::annotations::{Matrix, Tell, Vector};
use crate::{problem, waiting};
use chetaev::study::picture::{self, Scene, View};
use chetaev::study::table::Table;
use chetaev::study::{page, record, story, summary, Study};
use chetaev::symbolic::meter::spend;
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

/// Claims with their verdicts, and the motion.
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Outcome {
    study: Study,
    table: Option<Table>,
    interrupted: bool,
}

impl Outcome {
    pub(crate) fn new(study: Study, interrupted: bool) -> Outcome {
        Outcome {
            table: study
                .motion
                .as_ref()
                .map(|motion| Table::new(&study, motion)),
            study,
            interrupted,
        }
    }
}

#[pymethods]
impl Outcome {
    /// Whether Ctrl-C ended it.
    #[getter]
    fn interrupted(&self) -> bool {
        self.interrupted
    }

    /// The exit status that the command line would have.
    #[getter]
    fn status(&self) -> u8 {
        self.study.outcome.exit_status()
    }

    /// What a reader must know.
    #[getter]
    fn notices(&self) -> Vec<String> {
        self.study.notices.clone()
    }

    /// Whether there is a motion.
    #[getter]
    fn has_motion(&self) -> bool {
        self.study.motion.is_some()
    }

    /// The record of a study as JSON; `files` lie beside it.
    #[pyo3(signature = (files: "list[str]"))]
    fn record(&self, files: Vec<String>) -> String {
        serde_json::to_string(&record::record(&self.study, &files)).unwrap_or_default()
    }

    /// The record of the motion as JSON.
    #[pyo3(signature = (files: "list[str]"))]
    fn run(&self, files: Vec<String>) -> String {
        record::run(&self.study, &files).to_string()
    }

    /// The summary for a terminal.
    fn summary(&self) -> String {
        summary::summary(&self.study, summary::Style::Plain)
    }

    /// What the variational principles say.
    fn story(&self) -> String {
        story::story(&self.study, summary::Style::Plain)
    }

    /// The report, one HTML page.
    #[pyo3(signature = (files: "list[str]"))]
    fn page(&self, py: Python<'_>, files: Vec<String>) -> PyResult<String> {
        waiting::whole(py, None, |_| page::page(&self.study, None, &files))
    }

    /// Names of the columns, and the columns as the rows of one array.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<(Vec<String>, Matrix<'py>)> {
        let table = self.table()?;
        let array = PyArray2::from_vec2(py, &table.columns)
            .map_err(|problem| PyValueError::new_err(problem.to_string()))?;
        Ok((table.names.clone(), Matrix(array)))
    }

    /// What the doubles of the columns leave out, of a run in double-double arithmetic.
    fn low<'py>(&self, py: Python<'py>) -> PyResult<Vec<Vector<'py>>> {
        let columns = self.table()?.precise.iter();
        let low = columns.map(|column| {
            let low: Vec<f64> = column.iter().map(|x| x.low()).collect();
            Vector(PyArray1::from_vec(py, low))
        });
        Ok(low.collect())
    }

    /// The trajectory as CSV.
    fn csv(&self) -> PyResult<String> {
        Ok(self.table()?.to_csv())
    }

    /// The trajectory as a NumPy archive.
    fn npz(&self) -> PyResult<Vec<u8>> {
        let archive = self.table()?.to_npz();
        archive.map_err(|problem| PyOSError::new_err(problem.to_string()))
    }

    /// The description of the picture, `scene.json`.
    fn scene(&self) -> PyResult<String> {
        Ok(picture::to_json(&self.drawn()?))
    }

    /// A picture at a time, the end where there is none, with the bodies at so many earlier times: `svg` or `png`.
    fn picture(
        &self,
        py: Python<'_>,
        format: &str,
        at: Option<f64>,
        ghosts: usize,
        size: (u32, u32),
    ) -> PyResult<Vec<u8>> {
        let (scene, time) = (self.drawn()?, at);
        let view = View {
            width: size.0,
            height: size.1,
            time,
            ghosts,
        };
        let drawn = waiting::whole(py, None, |_| match format {
            "png" => picture::png(&scene, &view),
            _ => picture::svg(&scene, &view).map(String::into_bytes),
        })?;
        drawn.map_err(|problem| PyValueError::new_err(problem.to_string()))
    }

    /// The moving picture as a GIF of so many seconds.
    #[pyo3(signature = (seconds, size, tell=None))]
    fn film(
        &self,
        py: Python<'_>,
        seconds: Option<f64>,
        size: (u32, u32),
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Vec<u8>> {
        let scene = self.drawn()?;
        let view = View {
            width: size.0,
            height: size.1,
            ..View::default()
        };
        let length = match (scene.times.first(), scene.times.last()) {
            (Some(first), Some(last)) => (last - first).abs().clamp(2.0, 20.0),
            _ => 2.0,
        };
        let seconds = seconds.unwrap_or(length);
        let drawn = waiting::whole(py, tell, |hooks| {
            picture::film(&scene, &view, seconds, &mut |part| {
                (hooks.progress)("drawing", Some(part));
                spend(UNITS_OF_A_FRAME);
            })
        })?;
        drawn.map_err(|problem| PyValueError::new_err(problem.to_string()))
    }

    /// The events met as CSV; `None` where the model states none.
    fn events(&self) -> Option<String> {
        let motion = self.study.motion.as_ref()?;
        Table::events(&self.study, motion)
    }
}

/// A frame counts as a moment, after which it is looked whether somebody interrupted.
const UNITS_OF_A_FRAME: u64 = 1_000_000;

impl Outcome {
    fn drawn(&self) -> PyResult<Scene> {
        picture::scene(&self.study).ok_or_else(|| {
            let said = if self.study.notices.is_empty() {
                "no motion was computed, so that there is nothing to draw".to_owned()
            } else {
                self.study.notices.join("\n")
            };
            Python::attach(|py| problem::of_option(py, &said))
        })
    }

    fn table(&self) -> PyResult<&Table> {
        let said = || self.study.notices.join("\n");
        self.table
            .as_ref()
            .ok_or_else(|| Python::attach(|py| problem::of_option(py, &said())))
    }
}
