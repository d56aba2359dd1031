//! A model, and what can be asked of it.

use crate::annotations::{Checksum, Keywords, Tell};
use crate::compiled::Compiled;
use crate::linear::Linear;
use crate::outcome::Outcome;
use crate::sweep::{Sweep, Varied};
use crate::texts::{files_beside, not_written, text_at, with_overrides, Pairs};
use crate::{problem, waiting};
use chetaev::mechanics::{formulation, Context, Formulation, Prover, System, FORMULATIONS};
use chetaev::model::model::{ModelText, Precision};
use chetaev::model::{self, Diagnostics, Loaded, Sources, Style};
use chetaev::motion::double_double;
use chetaev::orbits::variational::Order;
use chetaev::study::board;
use chetaev::study::free::following;
use chetaev::study::start::{self, start_state};
use chetaev::study::steady::steady;
use chetaev::study::sweep::SweepOptions;
use chetaev::study::written::{self, NotWritten, Notation};
use chetaev::study::{
    beside, check, diagnostics, explanation, follow, registry, sensitivity, stability, study,
    ClaimSelection, StudyError, StudyOptions,
};
use chetaev::symbolic::print::{sympy_module, Document, Options, PythonSection};
use chetaev::symbolic::rational;
use pyo3::prelude::*;

/// A model that was read without errors.
#[pyclass(frozen, module = "chetaev.chetaev_native")]
pub(crate) struct Model {
    model: chetaev::model::Model,
    sources: Sources,
    warnings: Diagnostics,
}

/// How a motion is computed, and what is asked of it: the options of the command line.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Asked {
    claims: Option<String>,
    budget: Option<f64>,
    t_end: Option<String>,
    tolerance: Option<f64>,
    step: Option<String>,
    method: Option<String>,
    precision: Option<String>,
    formulation: Option<String>,
    project: bool,
    keep_integrals: bool,
    branch: Option<usize>,
    kappa: Pairs,
}

/// What is asked of linear equations.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct Linearized {
    about: Option<String>,
    speeds: Option<String>,
    outputs: Option<String>,
    symbolic: bool,
    numbers: bool,
    all: bool,
    over: Option<String>,
    at: Option<String>,
}

impl Model {
    fn of(py: Python<'_>, loaded: Loaded) -> PyResult<Model> {
        match loaded.into_result() {
            Ok((model, warnings)) => Ok(Model {
                sources: warnings.sources.clone(),
                model,
                warnings,
            }),
            Err(found) => Err(problem::of_model(py, &found)),
        }
    }

    fn place(&self) -> (&chetaev::model::Model, &Sources) {
        (&self.model, &self.sources)
    }

    fn system(&self, py: Python<'_>) -> PyResult<System> {
        System::from_model(&self.model)
            .map_err(|problem| problem::of_system(py, &problem, self.place()))
    }

    fn options(&self, py: Python<'_>, asked: &Asked) -> PyResult<StudyOptions> {
        let constant = |label: &str, text: &Option<String>| {
            let found = text.as_ref().map(|text| self.model.constant(label, text));
            let found = found.transpose();
            found.map_err(|found| problem::of_model(py, &found))
        };
        let t_end = constant("t_end", &asked.t_end)?;
        let step = constant("step", &asked.step)?;
        let precision = match asked.precision.as_deref() {
            None => None,
            Some(word) => {
                let mut known = Precision::WORDS.into_iter();
                let found = known.find(|(own, _)| *own == word).map(|(_, own)| own);
                Some(found.ok_or_else(|| {
                    let said =
                        format!("precision: `{word}` is neither `double` nor `double-double`");
                    problem::of_option(py, &said)
                })?)
            }
        };
        let usual = StudyOptions::default();
        Ok(StudyOptions {
            budget: asked.budget.unwrap_or(usual.budget),
            t_end: t_end.map(|(_, value)| value),
            t_end_exact: t_end.and_then(|(e, _)| double_double::number(&self.model.graph, e)),
            precision,
            tolerance: asked.tolerance,
            step: step.map(|(_, value)| value),
            method: asked.method.clone(),
            formulation: asked.formulation.clone(),
            project: asked.project,
            keep_integrals: asked.keep_integrals,
            branch: asked.branch,
            ..usual
        })
    }

    /// Initial values of the multipliers of the constrained extremum.
    fn kappa(&self, py: Python<'_>, asked: &Asked) -> PyResult<Vec<(String, f64)>> {
        let value = |(name, value): &(String, String)| {
            if !beside::is_multiplier(&self.model, name) {
                let said = format!("kappa: `{name}` is no multiplier of the extremum");
                return Err(problem::of_option(py, &said));
            }
            match self.model.constant_value("kappa", value) {
                Ok(value) => Ok((name.clone(), value)),
                Err(found) => Err(problem::of_model(py, &found)),
            }
        };
        asked.kappa.iter().map(value).collect()
    }

    /// A Python module with these expressions in SymPy.
    fn in_sympy(&self, texts: &[String], variables: &[String]) -> Result<String, Box<Diagnostics>> {
        let read = |text: &String| self.model.expression_in(text, variables);
        let read: Result<Vec<_>, _> = texts.iter().map(read).collect();
        let read = read.map_err(Box::new)?;
        let g = &self.model.graph;
        let moving = |symbol| {
            let name = g.symbol_name(symbol);
            self.model.varies(name)
                || self.model.mass_rate(name).is_some()
                || variables.iter().any(|own| own == name)
        };
        let moving: Vec<String> = g
            .symbols_in(&read)
            .into_iter()
            .filter(|&symbol| moving(symbol))
            .map(|symbol| g.symbol_name(symbol).to_owned())
            .collect();
        let document = Document::expressions(g, &read, &Options::default());
        let section = PythonSection {
            name: "found",
            title: "Expressions",
            groups: vec![("all", &document)],
        };
        Ok(sympy_module(&[section], &moving))
    }

    fn not_steady(&self, py: Python<'_>, problem: &stability::StabilityError) -> PyErr {
        match problem {
            stability::StabilityError::System(problem) => {
                problem::of_system(py, problem, self.place())
            }
            problem => problem::of_option(py, problem),
        }
    }

    fn not_followed(&self, py: Python<'_>, problem: follow::FollowError) -> PyErr {
        match problem {
            follow::FollowError::System(problem) => problem::of_system(py, &problem, self.place()),
            other => problem::of_option(py, &other),
        }
    }

    fn studied(
        &self,
        py: Python<'_>,
        options: StudyOptions,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Outcome> {
        let own = self.model.clone();
        let found = waiting::done(py, tell, |hooks| study(own, options, hooks))?;
        match found.result {
            Ok(study) => Ok(Outcome::new(study, found.interrupted)),
            Err(problem) => Err(problem::of_study(py, &problem, self.place())),
        }
    }

    /// Does something with the derived equations.
    fn with_equations(
        &self,
        py: Python<'_>,
        tell: Option<Tell<'_, '_>>,
        work: impl FnOnce(&Context<'_>, &dyn Fn(&str)) -> Result<String, NotWritten> + Send,
    ) -> PyResult<(String, Vec<String>)> {
        let system = self.system(py)?;
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("deriving", None);
            let (prepared, notes) = written::prepared(&self.model, &system)?;
            let known = registry();
            let (terms, selection) = (&prepared.terms, &prepared.selection);
            let cx = Context::new(&system, terms, selection, &known, Prover::default());
            let show = std::cell::RefCell::new(&mut hooks.progress);
            let text = work(&cx, &|what: &str| (show.borrow_mut())(what, None));
            Ok((text, notes))
        })?;
        let found = found.map_err(
            |problem: chetaev::mechanics::characteristics::CharacteristicsError| {
                problem::of_system(py, &problem, self.place())
            },
        );
        let (text, notes) = found?;
        let text = text.map_err(|problem| {
            let class = match problem {
                NotWritten::NotDerived(_) => "NotDerivedError",
                _ => "OptionError",
            };
            problem::named(py, class, (problem.to_string(), "[]".into()))
        })?;
        Ok((text, notes))
    }
}

#[pymethods]
impl Model {
    /// Reads a model file, with what it includes; `overrides` are names and values of parameters and sizes.
    #[staticmethod]
    #[pyo3(signature = (path, overrides: "list[tuple[str, str]]"))]
    fn from_file(py: Python<'_>, path: &str, overrides: Pairs) -> PyResult<Model> {
        let (text, files) = (text_at(path)?, files_beside(Some(path)));
        let loaded = waiting::whole(py, None, |_| model::load(path, &text, &*files, &overrides))?;
        Model::of(py, loaded)
    }

    /// Reads a model from its text. Files that it includes are looked for as if it stood at `path`; nothing is included without one.
    #[staticmethod]
    #[pyo3(signature = (text, path, overrides: "list[tuple[str, str]]"))]
    fn from_text(
        py: Python<'_>,
        text: &str,
        path: Option<&str>,
        overrides: Pairs,
    ) -> PyResult<Model> {
        let files = files_beside(path);
        let path = path.unwrap_or("model.toml");
        let loaded = waiting::whole(py, None, |_| model::load(path, text, &*files, &overrides))?;
        Model::of(py, loaded)
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
    ) -> PyResult<Model> {
        let text = ModelText {
            path,
            text,
            includes,
            overrides,
        };
        let loaded = waiting::whole(py, None, |_| model::reload(&text))?;
        Model::of(py, loaded)
    }

    /// Path, text, included files and overrides: enough to read the model again anywhere.
    fn texts(&self) -> (String, String, Pairs, Pairs) {
        let own = self.model.text.clone();
        (own.path, own.text, own.includes, own.overrides)
    }

    /// The model file with the values that were set written into it.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        let own = &self.model.text;
        let found = waiting::whole(py, None, |_| {
            with_overrides(own, |written| {
                let read = model::reload(written).model;
                read.is_some_and(|read| numbers(&read) == numbers(&self.model))
            })
        })?;
        found.ok_or_else(|| not_written(py, own))
    }

    /// The model with its bodies, joints and contacts written out as coordinates, energies and constraints.
    fn lowered(&self, py: Python<'_>) -> PyResult<String> {
        let own = &self.model.text;
        let files: std::collections::BTreeMap<String, String> =
            own.includes.iter().cloned().collect();
        waiting::whole(py, None, |_| {
            model::lowered(&own.path, &own.text, &files, &own.overrides)
        })?
        .map_err(|found| problem::of_model(py, &found))
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.model.name
    }

    /// Names of the coordinates.
    #[getter]
    fn coordinates(&self) -> Vec<&str> {
        let all = self.model.coordinates.iter();
        all.map(|c| c.name.as_str()).collect()
    }

    /// Names of the masses that are states: those whose law states their rate.
    #[getter]
    fn masses(&self) -> Vec<&str> {
        let all = self.model.masses.iter().map(|own| own.name.as_str());
        all.filter(|name| self.model.mass_rate(name).is_some())
            .collect()
    }

    /// Units as they are stated, by the names of coordinates, parameters and masses.
    #[getter]
    fn units(&self) -> Vec<(&str, &str)> {
        let own = &self.model;
        let coordinates = own.coordinates.iter().map(|own| (&own.name, &own.unit));
        let parameters = own.parameters.iter().map(|own| (&own.name, &own.unit));
        let masses = own.masses.iter().map(|own| (&own.name, &own.unit));
        coordinates
            .chain(parameters)
            .chain(masses)
            .filter_map(|(name, unit)| Some((name.as_str(), unit.as_ref()?.text.as_str())))
            .collect()
    }

    /// Factors by which numbers in units that are no SI base units become such, by the names of parameters.
    #[getter]
    fn factors(&self) -> Vec<(&str, f64)> {
        let own = self.model.parameters.iter();
        own.filter_map(|own| Some((own.name.as_str(), own.unit.as_ref()?)))
            .filter(|(_, unit)| !unit.is_coherent())
            .map(|(name, unit)| {
                (
                    name,
                    rational::to_f64(&unit.factor) * std::f64::consts::PI.powi(unit.pi),
                )
            })
            .collect()
    }

    /// Names of the parameters with the texts of their values, or `None`.
    #[getter]
    fn parameters(&self) -> Vec<(&str, Option<String>)> {
        let value =
            |p: &chetaev::model::model::Parameter| p.value.map(|e| self.model.graph.text(e));
        let all = self.model.parameters.iter();
        all.map(|p| (p.name.as_str(), value(p))).collect()
    }

    /// Names of the constraints.
    #[getter]
    fn constraints(&self) -> Vec<&str> {
        let all = self.model.constraints.iter();
        all.map(|c| c.name.as_str()).collect()
    }

    /// Warnings as they are printed; an empty text where there are none.
    fn warnings(&self) -> String {
        if self.warnings.list.is_empty() {
            String::new()
        } else {
            self.warnings.render(Style::Plain)
        }
    }

    /// A Python module whose list `found["all"]` has these expressions in SymPy; variables of a state that is not the model's may occur.
    #[pyo3(signature = (texts: "list[str]", variables: "list[str]"))]
    fn sympy(
        &self,
        py: Python<'_>,
        texts: Vec<String>,
        variables: Vec<String>,
    ) -> PyResult<String> {
        let found = waiting::whole(py, None, |_| self.in_sympy(&texts, &variables))?;
        found.map_err(|found| problem::of_model(py, &found))
    }

    /// Everything wrong or doubtful, as it is printed and as JSON; and whether there are errors.
    fn check(&self, py: Python<'_>) -> PyResult<(String, String, bool)> {
        let mut found = self.warnings.clone();
        found.list.extend(self.model.unused.iter().cloned());
        if let Err(problem) = waiting::whole(py, None, |hooks| check(&self.model, hooks))? {
            found.list.extend(diagnostics(&problem, &self.model));
        }
        let data = serde_json::to_string(&found.to_data()).unwrap_or_default();
        Ok((found.render(Style::Plain), data, found.has_errors()))
    }

    /// The equations of formulations in a notation, and notes: `derive`.
    #[pyo3(signature = (names: "list[str]", all, notation, tell=None))]
    fn derive(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        all: bool,
        notation: &str,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, Vec<String>)> {
        let notation = notation_named(py, notation)?;
        let asked = formulations(py, &names, all)?;
        self.with_equations(py, tell, |cx, show| {
            let mut told = |one: &'static dyn Formulation, found: Option<&Result<_, _>>| {
                if found.is_none() {
                    show(&format!("deriving and simplifying {}", one.card().name));
                }
            };
            written::equations(&self.model, cx, &asked, (notation, all), &mut told)
        })
    }

    /// The operations of the equations of formulations, a line for each, and notes: `derive --count`.
    #[pyo3(signature = (names: "list[str]", all, tell=None))]
    fn count(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        all: bool,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, Vec<String>)> {
        let asked = formulations(py, &names, all)?;
        self.with_equations(py, tell, |cx, show| {
            show("deriving and simplifying");
            written::counts(cx, &asked, all)
        })
    }

    /// The derivations of formulations step by step, and notes: `derive --steps`.
    #[pyo3(signature = (names: "list[str]", all, notation, tell=None))]
    fn steps(
        &self,
        py: Python<'_>,
        names: Vec<String>,
        all: bool,
        notation: &str,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, Vec<String>)> {
        let notation = notation_named(py, notation)?;
        let asked = formulations(py, &names, all)?;
        self.with_equations(py, tell, |cx, show| {
            show("deriving step by step");
            board::written(cx, &asked, (notation, all))
        })
    }

    /// Two formulations held against each other, and notes: `derive --compare`.
    #[pyo3(signature = (a, b, tell=None))]
    fn compare(
        &self,
        py: Python<'_>,
        a: &str,
        b: &str,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, Vec<String>)> {
        self.with_equations(py, tell, |cx, show| written::comparison(cx, (a, b), show))
    }

    /// Claims and motion: `study`.
    #[pyo3(signature = (asked, tell=None))]
    fn study(
        &self,
        py: Python<'_>,
        asked: Keywords<'_, '_>,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Outcome> {
        let asked: Asked = asked.extract()?;
        let claims = match &asked.claims {
            None => ClaimSelection::all(),
            Some(text) => ClaimSelection::parse(text, registry().claims()).map_err(|word| {
                let near = explanation::did_you_mean(&word, registry().claims());
                let said = format!("claims: `{word}` is neither a group nor a claim{near}");
                problem::of_option(py, &said)
            })?,
        };
        let options = StudyOptions {
            claims,
            ..self.options(py, &asked)?
        };
        self.studied(py, options, tell)
    }

    /// The motion alone: `simulate`.
    #[pyo3(signature = (asked, tell=None))]
    fn simulate(
        &self,
        py: Python<'_>,
        asked: Keywords<'_, '_>,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Outcome> {
        let options = StudyOptions {
            claims: ClaimSelection::of_motion(),
            ..self.options(py, &asked.extract()?)?
        };
        self.studied(py, options, tell)
    }

    /// What the variational principles state: `principles`.
    #[pyo3(signature = (asked, compare, tell=None))]
    fn principles(
        &self,
        py: Python<'_>,
        asked: Keywords<'_, '_>,
        compare: bool,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Outcome> {
        let asked: Asked = asked.extract()?;
        let kappa = self.kappa(py, &asked)?;
        let options = StudyOptions {
            claims: ClaimSelection::of_principles(compare),
            motion: compare,
            extremum: compare.then_some(kappa),
            ..self.options(py, &asked)?
        };
        self.studied(py, options, tell)
    }

    /// Many trajectories, ready to be computed: `sweep`.
    #[pyo3(signature = (asked, varied, tell=None))]
    fn sweep(
        &self,
        py: Python<'_>,
        asked: Keywords<'_, '_>,
        varied: Keywords<'_, '_>,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Sweep> {
        let varied: Varied = varied.extract()?;
        let options = SweepOptions {
            study: self.options(py, &asked.extract()?)?,
            samples: varied.samples,
        };
        let variations = varied.variations(&self.model);
        let variations = variations.map_err(|problem| problem.raised(py))?;
        let made = waiting::whole(py, tell, |hooks| {
            chetaev::study::sweep::Sweep::new(&self.model, variations, options, hooks)
        })?;
        made.map(Sweep::new)
            .map_err(|problem| problem::of_study(py, &problem, self.place()))
    }

    /// All steady motions in words and as JSON: `steady`.
    #[pyo3(signature = (symbolic, tell=None))]
    fn steady(
        &self,
        py: Python<'_>,
        symbolic: bool,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, String)> {
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("steady motions", None);
            steady(&self.model, symbolic).map_err(Box::new)
        })?;
        match found {
            Ok(found) => Ok((found.text(), found.json().to_string())),
            Err(problem) => Err(self.not_followed(py, *problem)),
        }
    }

    /// Steady motions or periodic orbits over a range of a parameter, in words, as JSON and as SVG: `follow`.
    #[pyo3(signature = (about, over, orbit, period, points, step, tell=None))]
    #[allow(
        clippy::too_many_arguments,
        reason = "the keywords of a method in Python"
    )]
    fn follow(
        &self,
        py: Python<'_>,
        about: Option<String>,
        over: Option<String>,
        orbit: bool,
        period: Option<String>,
        points: usize,
        step: f64,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, String, Option<String>)> {
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("following", None);
            let wanted = follow::Wanted {
                about: about.as_deref(),
                over: over.as_deref(),
                orbit,
                period: period.as_deref(),
                points: Some(points),
                step: Some(step),
            };
            follow::follow(&self.model, &wanted).map_err(Box::new)
        })?;
        match found {
            Ok(found) => Ok((found.text(), found.json().to_string(), found.picture())),
            Err(problem) => Err(self.not_followed(py, *problem)),
        }
    }

    /// Stability over two parameters, in words, as JSON and as SVG: `stability --over` with two.
    #[pyo3(signature = (over, about=None, at=None, tell=None))]
    fn stability_map(
        &self,
        py: Python<'_>,
        over: &str,
        about: Option<&str>,
        at: Option<&str>,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(String, String, String)> {
        let found = waiting::whole(py, tell, |hooks| {
            let what = "map of stability";
            (hooks.progress)(what, None);
            let wanted = stability::Wanted {
                about,
                at,
                over: Some(over),
                ..stability::Wanted::default()
            };
            let mut tell = |part| (hooks.progress)(what, Some(part));
            stability::map::map(&self.model, &wanted, &mut tell).map_err(Box::new)
        })?;
        match found {
            Ok(found) => Ok((found.text(), found.json().to_string(), found.picture())),
            Err(problem) => Err(self.not_steady(py, &problem)),
        }
    }

    /// Linear equations along the motion from the initial state, in words and as JSON: `linearize --along`.
    #[pyo3(signature = (tell=None))]
    fn along(&self, py: Python<'_>, tell: Option<Tell<'_, '_>>) -> PyResult<(String, String)> {
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("linear equations along the motion", None);
            sensitivity::along_motion(&self.model).map_err(Box::new)
        })?;
        match found {
            Ok(found) => Ok((found.text(), found.json().to_string())),
            Err(problem) => Err(self.not_followed(py, *problem)),
        }
    }

    /// Names of columns and rows of numbers: `simulate --sensitivity`.
    #[pyo3(signature = (by, second, times: "list[float]", project=false, tell=None))]
    fn sensitivity(
        &self,
        py: Python<'_>,
        by: &str,
        second: bool,
        times: Vec<f64>,
        project: bool,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<(Vec<String>, Vec<Vec<f64>>)> {
        let options = StudyOptions {
            project,
            ..StudyOptions::default()
        };
        let order = if second { Order::Second } else { Order::First };
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("sensitivities", None);
            sensitivity::sensitivity(&self.model, by, order, &times, &options).map_err(Box::new)
        })?;
        match found {
            Ok(found) => {
                let names = std::iter::once("t".to_owned()).chain(found.columns());
                let rows = found.rows.iter();
                let row = |(t, own): &(f64, Vec<f64>)| [vec![*t], own.clone()].concat();
                Ok((names.collect(), rows.map(row).collect()))
            }
            Err(problem) => Err(self.not_followed(py, *problem)),
        }
    }

    /// Linear equations about a steady motion and their stability: `linearize` and `stability`.
    #[pyo3(signature = (wanted, tell=None))]
    fn stability(
        &self,
        py: Python<'_>,
        wanted: Keywords<'_, '_>,
        tell: Option<Tell<'_, '_>>,
    ) -> PyResult<Linear> {
        let wanted: Linearized = wanted.extract()?;
        let found = waiting::whole(py, tell, |hooks| {
            (hooks.progress)("linear equations", None);
            stability::stability(
                &self.model,
                &stability::Wanted {
                    about: wanted.about.as_deref(),
                    speeds: wanted.speeds.as_deref(),
                    outputs: wanted.outputs.as_deref(),
                    symbolic: wanted.symbolic,
                    numbers: wanted.numbers,
                    all: wanted.all,
                    over: wanted.over.as_deref(),
                    at: wanted.at.as_deref(),
                    work: None,
                },
            )
            .map_err(Box::new)
        })?;
        match found {
            Ok(found) => Ok(Linear::new(found)),
            Err(problem) => Err(self.not_steady(py, &problem)),
        }
    }

    /// The time and the consistent state from which the motion starts: coordinates, masses with a law of their own, velocities.
    fn start(&self, py: Python<'_>) -> PyResult<(f64, Vec<f64>)> {
        let system = self.system(py)?;
        let found = waiting::whole(py, None, |_| {
            let prepared = start::prepared(&self.model, &system).map_err(StudyError::from)?;
            start_state(&self.model, &system, (&prepared.terms, &prepared.selection))
        })?;
        match found {
            Ok(found) => Ok((found.t, found.state.iter().map(|own| own.1).collect())),
            Err(problem) => Err(problem::of_study(py, &problem, self.place())),
        }
    }

    /// Parameters that follow from others, each with what it is in terms of free ones.
    #[getter]
    fn following(&self) -> Vec<(String, String)> {
        let g = &self.model.graph;
        let all = following(&self.model).into_iter();
        all.map(|(own, value)| (g.text(own), g.text(value)))
            .collect()
    }

    /// Initial values as they are stated: name, value, whether it is a guess.
    #[getter]
    fn initial(&self) -> Vec<(String, String, bool)> {
        let name = |&(at, order): &(usize, u32)| {
            let primes = "'".repeat(order as usize);
            format!("{}{primes}", self.model.coordinates[at].name)
        };
        let all = self.model.initial.values.iter();
        all.map(|(at, own)| (name(at), own.text.clone(), own.is_guess))
            .collect()
    }

    /// The equations of motion as functions of numbers.
    fn compile(&self, py: Python<'_>) -> PyResult<Compiled> {
        let system = self.system(py)?;
        let found = waiting::whole(py, None, |_| Compiled::new(&self.model, &system))?;
        match found {
            Ok(found) => Ok(found),
            Err(problem) => Err(problem::of_system(py, &problem, self.place())),
        }
    }
}

/// What values that are set can change of a model: sizes and with them names, parameters, initial data; in no order of the file.
fn numbers(model: &chetaev::model::Model) -> Vec<String> {
    let g = &model.graph;
    let coordinates = model.coordinates.iter().map(|own| own.name.clone());
    let parameters = model.parameters.iter().map(|own| {
        let value = own.definition.map(|value| g.text(value));
        format!("{} = {value:?}", own.name)
    });
    let initial = &model.initial;
    let values = initial.values.iter().map(|(at, own)| {
        let value = g.text(own.value);
        format!("{at:?} = {value}, {}", own.is_guess)
    });
    let extra = initial.extra.iter();
    let extra = extra.map(|own| format!("{} {} = {}", own.name, own.order, g.text(own.value)));
    let masses = model.masses.iter().map(|own| {
        let initial = model.initial_mass(&own.name).map(|value| g.text(value));
        format!("{} = {initial:?}", own.name)
    });
    let all = coordinates.chain(parameters).chain(values);
    let mut all: Vec<String> = all.chain(extra).chain(masses).collect();
    all.sort();
    all
}

/// Formulations by their names, or all of them.
fn formulations(
    py: Python<'_>,
    names: &[String],
    all: bool,
) -> PyResult<Vec<&'static dyn Formulation>> {
    if all {
        return Ok(FORMULATIONS.to_vec());
    }
    let known = |name: &String| {
        let found = formulation(name);
        found.ok_or_else(|| problem::of_option(py, &NotWritten::Unknown(name.clone())))
    };
    names.iter().map(known).collect()
}

/// Names and texts of the files of the checker, a program in Python that shares nothing with this one.
#[pyfunction]
pub(crate) fn checker() -> Vec<(&'static str, &'static str)> {
    chetaev::checker::FILES.to_vec()
}

/// What a claim or a formulation states, in words and as JSON; all claims without a name.
#[pyfunction]
#[pyo3(signature = (claim=None))]
pub(crate) fn explain(py: Python<'_>, claim: Option<&str>) -> PyResult<(String, String)> {
    let said = explanation::text(claim).map_err(|problem| problem::of_option(py, &problem))?;
    let data = explanation::data(claim).map_err(|problem| problem::of_option(py, &problem))?;
    Ok((said, data.to_string()))
}

/// Replays the verdicts of a record within a budget, and holds the files beside it against their checksums where a function from names to these
/// is given; the lines as JSON, and whether all agree.
#[pyfunction]
#[pyo3(signature = (record, budget, tell=None, checksum=None))]
pub(crate) fn verify(
    py: Python<'_>,
    record: &str,
    budget: f64,
    tell: Option<Tell<'_, '_>>,
    checksum: Option<Checksum<'_, '_>>,
) -> PyResult<(String, bool)> {
    use chetaev::study::verify::{agrees, files, read, verify, Verified, VerifyError};
    let wrong = |problem: VerifyError| problem::of_option(py, &problem);
    let record = read(record).map_err(wrong)?;
    let found = waiting::whole(py, tell, |hooks| verify(&record, budget, hooks))?;
    let mut lines = found.map_err(wrong)?;
    if let Some(checksum) = checksum {
        let mut failure = None;
        lines.extend(files(&record, &mut |name| {
            let found = checksum.call1((name,)).and_then(|own| own.extract());
            found.unwrap_or_else(|problem| {
                failure = Some(problem);
                None
            })
        }));
        if let Some(problem) = failure {
            return Err(problem);
        }
    }
    let data: Vec<serde_json::Value> = lines.iter().map(Verified::to_json).collect();
    Ok((serde_json::json!(data).to_string(), agrees(&lines)))
}

/// A model text from the description of a robot in URDF or MJCF, and what of it was not understood, by line.
#[pyfunction]
pub(crate) fn robot(
    py: Python<'_>,
    path: &str,
    text: &str,
) -> PyResult<(String, Vec<(u32, String)>)> {
    let found = chetaev::import::import(text);
    let found = found.map_err(|problem| problem::of_description(py, &problem, (path, text)))?;
    let notes = found.notes.into_iter();
    Ok((found.text, notes.map(|n| (n.line, n.message)).collect()))
}

/// The models that come with Chetaev as JSON; of one model, its texts by path.
#[pyfunction]
#[pyo3(signature = (name=None))]
pub(crate) fn gallery(py: Python<'_>, name: Option<&str>) -> PyResult<(String, Pairs, String)> {
    let Some(name) = name else {
        let all: Vec<serde_json::Value> = chetaev_gallery::models().map(|m| m.to_json()).collect();
        return Ok((
            serde_json::json!(all).to_string(),
            Vec::new(),
            String::new(),
        ));
    };
    let Some(entry) = chetaev_gallery::find(name) else {
        let said = format!("there is no model `{name}` in the gallery");
        return Err(problem::of_option(py, &said));
    };
    let texts = entry.copied().into_iter();
    let texts = texts.map(|(path, text)| (path, text.to_owned())).collect();
    Ok((
        entry.to_json().to_string(),
        texts,
        entry.readme().to_owned(),
    ))
}

fn notation_named(py: Python<'_>, name: &str) -> PyResult<Notation> {
    Notation::named(name).ok_or_else(|| {
        let said = format!("there is no notation `{name}`");
        problem::of_option(py, &said)
    })
}
