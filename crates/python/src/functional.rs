//! A functional of fields over space, and what can be asked of it.

use crate::annotations::Tell;
use crate::texts::{files_beside, not_written, text_at, with_overrides, Pairs};
use crate::{problem, waiting};
use chetaev::functionals::read::reload;
use chetaev::functionals::study::USUAL_BUDGET as BUDGET;
use chetaev::functionals::{self, Problem};
use chetaev::model::model::ModelText;
use chetaev::model::{self, Diagnostics, Files, Sources, Style};
use chetaev::study::functional::{
    derivation, is_selected, page, record, selected, studied, summary,
};
use chetaev::study::summary::Style as SummaryStyle;
use chetaev::study::written::Notation;
use pyo3::prelude::*;

/// Name, kind, piece of the boundary or `None`, description.
type FieldOf = (String, String, Option<String>, String);

/// A functional that was read without errors. Its texts are kept, and are read again for every question: what was read belongs to one
/// thread.
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Functional {
    text: ModelText,
    warnings: String,
    known: Known,
}

/// What a functional states, in words.
#[derive(PartialEq)]
struct Known {
    name: String,
    level: Option<String>,
    dimensions: usize,
    fields: Vec<FieldOf>,
    parameters: Vec<(String, Option<String>)>,
}

/// The words of a study.
struct Studied {
    record: String,
    summary: String,
    page: String,
    is_as_expected: bool,
}

fn known(problem: &Problem) -> Known {
    let own = &problem.functional;
    let g = &own.space.graph;
    let field = |field: &functionals::functional::Field| {
        let kind = field.shape.word().to_owned();
        (
            field.name.clone(),
            kind,
            field.on.clone(),
            field.description.clone(),
        )
    };
    Known {
        name: own.name.clone(),
        level: own.level.clone(),
        dimensions: own.space.dimensions(),
        fields: own.fields.iter().map(field).collect(),
        parameters: own
            .parameters
            .iter()
            .map(|p| (p.name.clone(), p.value.map(|value| g.text(value))))
            .collect(),
    }
}

impl Functional {
    /// Reads a text that states a functional.
    fn load(
        py: Python<'_>,
        (path, text): (&str, &str),
        files: &(dyn Files + Sync),
        overrides: &[(String, String)],
    ) -> PyResult<Functional> {
        let read = waiting::whole(py, None, |_| {
            let tables = model::tables(path, text, files, &[], Sources::default());
            if tables.table.is_some() && !tables.is_functional() {
                return Err(NotRead::Motion);
            }
            let loaded = functionals::load(path, text, files, overrides);
            let diagnostics = loaded.diagnostics;
            let Some(problem) = loaded.problem else {
                return Err(NotRead::Wrong(Box::new(diagnostics)));
            };
            let is_said = !diagnostics.list.is_empty();
            let warnings = is_said.then(|| diagnostics.render(Style::Plain));
            Ok(Functional {
                known: known(&problem),
                text: problem.text,
                warnings: warnings.unwrap_or_default(),
            })
        })?;
        read.map_err(|problem| match problem {
            NotRead::Wrong(found) => problem::of_model(py, &found),
            NotRead::Motion => {
                let said = format!(
                    "{path} states a motion: chetaev.System reads it; a functional has kind = \"functional\""
                );
                problem::named(py, "ModelError", (said, "[]".to_owned()))
            }
        })
    }
}

/// Why a text states no functional.
enum NotRead {
    /// It states a motion.
    Motion,
    /// What is wrong with it.
    Wrong(Box<Diagnostics>),
}

/// Why there are no equations.
enum NotDerived {
    /// The text is not read any more.
    Read(Box<Diagnostics>),
    /// They cannot be derived.
    Derived(String),
}

#[pymethods]
impl Functional {
    /// Reads a model file, with what it includes; `overrides` are names and values of parameters and sizes.
    #[staticmethod]
    #[pyo3(signature = (path, overrides: "list[tuple[str, str]]"))]
    fn from_file(py: Python<'_>, path: &str, overrides: Pairs) -> PyResult<Functional> {
        let text = text_at(path)?;
        Functional::load(py, (path, &text), &*files_beside(Some(path)), &overrides)
    }

    /// Reads a model from its text. Files that it includes are looked for as if it stood at `path`; nothing is included without one.
    #[staticmethod]
    #[pyo3(signature = (text, path, overrides: "list[tuple[str, str]]"))]
    fn from_text(
        py: Python<'_>,
        text: &str,
        path: Option<&str>,
        overrides: Pairs,
    ) -> PyResult<Functional> {
        let files = files_beside(path);
        Functional::load(
            py,
            (path.unwrap_or("model.toml"), text),
            &*files,
            &overrides,
        )
    }

    /// Reads a model again from what `texts` gave.
    #[staticmethod]
    #[pyo3(signature = (path, text, includes: "list[tuple[str, str]]", overrides: "list[tuple[str, str]]"))]
    fn from_texts(
        py: Python<'_>,
        path: String,
        text: String,
        includes: Pairs,
        overrides: Pairs,
    ) -> PyResult<Functional> {
        let files: std::collections::BTreeMap<String, String> = includes.into_iter().collect();
        Functional::load(py, (&path, &text), &files, &overrides)
    }

    /// Path, text, included files and overrides: enough to read the model again anywhere.
    fn texts(&self) -> (String, String, Pairs, Pairs) {
        let own = self.text.clone();
        (own.path, own.text, own.includes, own.overrides)
    }

    /// The model file with the values that were set written into it.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        let found = waiting::whole(py, None, |_| {
            with_overrides(&self.text, |written| {
                let read = reload(written).problem;
                read.is_some_and(|read| known(&read) == self.known)
            })
        })?;
        found.ok_or_else(|| not_written(py, &self.text))
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.known.name
    }

    /// Its level in a hierarchy, as written.
    #[getter]
    fn level(&self) -> Option<&str> {
        self.known.level.as_deref()
    }

    /// The number of dimensions of space.
    #[getter]
    fn dimensions(&self) -> usize {
        self.known.dimensions
    }

    /// Name, kind, piece of the boundary or `None`, and description of each field that is varied.
    #[getter]
    fn fields(&self) -> Vec<FieldOf> {
        self.known.fields.clone()
    }

    /// Names of the parameters with the texts of their values, or `None`.
    #[getter]
    fn parameters(&self) -> Vec<(String, Option<String>)> {
        self.known.parameters.clone()
    }

    /// Warnings as they are printed; an empty text where there are none.
    fn warnings(&self) -> &str {
        &self.warnings
    }

    /// Everything wrong or doubtful, as it is printed and as JSON; and whether there are errors.
    fn check(&self, py: Python<'_>) -> PyResult<(String, String, bool)> {
        let found = waiting::whole(py, None, |_| reload(&self.text).diagnostics)?;
        let data = serde_json::to_string(&found.to_data()).unwrap_or_default();
        Ok((found.render(Style::Plain), data, found.has_errors()))
    }

    /// Euler equations and conditions on the boundary in a notation: `derive`.
    fn derive(&self, py: Python<'_>, notation: &str) -> PyResult<String> {
        let format = Notation::named(notation).and_then(|own| own.format());
        let Some(format) = format else {
            let said = format!(
                "there is no notation `{notation}` of field equations: text, latex, mathml, sympy or json"
            );
            return Err(problem::of_option(py, &said));
        };
        let found = waiting::whole(py, None, |_| {
            // What was read when the functional was made is read again.
            let loaded = reload(&self.text);
            let Some(problem) = loaded.problem else {
                return Err(NotDerived::Read(Box::new(loaded.diagnostics)));
            };
            let found = derivation(&problem.functional, format);
            found.map_err(|why| NotDerived::Derived(why.to_string()))
        })?;
        found.map_err(|why| match why {
            NotDerived::Read(found) => problem::of_model(py, &found),
            NotDerived::Derived(said) => problem::named(py, "NotDerivedError", (said, "[]".into())),
        })
    }

    /// Claims with their verdicts: the record as JSON, the summary, the report, and whether everything is as the model expects.
    #[pyo3(signature = (claims, tell=None))]
    fn study(
        &self,
        py: Python<'_>,
        claims: &str,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, String, String, bool)> {
        let words =
            selected(claims).map_err(|why| problem::of_option(py, &format!("claims: {why}")))?;
        let text = &self.text;
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("deciding", None);
            let problem = reload(text).problem?;
            let study = studied(problem, &|id| is_selected(&words, id), BUDGET, hooks);
            Some(Studied {
                record: serde_json::to_string(&record(&study, &words, &[])).unwrap_or_default(),
                summary: summary(&study, SummaryStyle::Plain),
                page: page(&study, None),
                is_as_expected: study.is_as_expected(),
            })
        })?;
        let Some(own) = found else {
            return Err(problem::of_model(py, &reload(text).diagnostics));
        };
        Ok((own.record, own.summary, own.page, own.is_as_expected))
    }
}
