//! A sweep: one model, thousands of starts and values of parameters.
//!
//! The model is derived and its equations compiled once; what varies is an input of the compiled program. A trajectory has
//! the bits of a run by itself, with the same values written in the model.

mod members;
pub(crate) mod recipe;
pub mod together;
pub mod vary;
mod whole;

use crate::derivation::check_applies;
use crate::error::StudyError;
use crate::expectations::check_expectations;
use crate::options::{Hooks, StudyOptions};
use crate::preparation::prepare;
use crate::registry::registry;
use crate::start::{initial_data, settings};
use crate::study::{components_are_apart, keeps, kept, movable};
use chetaev_ensemble::columns::Names;
use chetaev_ensemble::outcome::Shape;
use chetaev_ensemble::{Columns, Routh, Work};
use chetaev_mechanics::claims::formulation::REFERENCE;
use chetaev_mechanics::{formulation, Context, Formulation, Prepared, Prover, System};
use chetaev_model::model::{InitialValue, Model};
use chetaev_motion::factors::has_components;
use chetaev_motion::run::equal_times;
use chetaev_motion::{
    Binding, CompiledRouth, ConsistentState, InitialData, NumericSystem, RunError, RunSettings,
    Subject,
};
use chetaev_symbolic::{Expr, Symbol};
use members::ModelMembers;
use recipe::Recipe;
use together::Variations;
use vary::{decimal, Target};
use whole::Whole;

/// What is asked of a sweep beside what varies; as for one motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepOptions {
    /// End, tolerance, step, method, formulation, projection, kept integrals, branch; the rest is not used.
    pub study: StudyOptions,
    /// How many states of each trajectory are kept, at equal intervals with both ends; none for 0.
    pub samples: u32,
}

/// A sweep that is ready to run.
pub struct Sweep {
    pub(crate) model: Model,
    pub(crate) system: System,
    pub(crate) prepared: Prepared,
    pub(crate) variations: Variations,
    pub(crate) options: SweepOptions,
    pub(crate) formulation: &'static dyn Formulation,
    /// Of the values in the model, or of the first trajectory that can begin.
    pub(crate) binding: Binding,
    pub(crate) numeric: NumericSystem,
    pub(crate) start: ConsistentState,
    pub(crate) data: InitialData,
    pub(crate) settings: RunSettings,
    compiled: Option<CompiledRouth>,
    recipe: Option<Recipe>,
    columns: Columns,
    /// Initial values that the model states itself, whether they vary or not.
    pub(crate) stated: Vec<(usize, u32)>,
}

impl std::fmt::Debug for Sweep {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Sweep({} × {})", self.model.name, self.count())
    }
}

/// How many trajectories are tried before a sweep is refused because none of them can begin.
const TRIED: u64 = 5;

impl Sweep {
    /// Derives and compiles.
    ///
    /// # Errors
    /// What is wrong with the model, or with the first trajectory where none of several can begin.
    pub fn new(
        model: &Model,
        variations: Variations,
        options: SweepOptions,
        hooks: &mut Hooks<'_>,
    ) -> Result<Sweep, StudyError> {
        let count = variations.count();
        let mut first: Option<StudyError> = None;
        for tried in 0..TRIED.min(count) {
            // The ends and what lies between: a range may begin where nothing moves.
            let index = match TRIED.min(count) {
                1 => 0,
                all => (count - 1) / (all - 1) * tried,
            };
            let values = variations.values(index);
            let with = with_values(model, &variations, &values);
            match Sweep::of(with, model, variations.clone(), options.clone(), hooks) {
                Ok(sweep) => return Ok(sweep),
                Err(problem) => first = first.or(Some(problem)),
            }
        }
        // There is at least one trajectory, so there is a problem.
        Err(first.unwrap_or(StudyError::Step))
    }

    fn of(
        base: Model,
        stated: &Model,
        variations: Variations,
        options: SweepOptions,
        hooks: &mut Hooks<'_>,
    ) -> Result<Sweep, StudyError> {
        check_expectations(&base, &registry())?;
        let (system, prepared, start) = prepare(&base, &options.study, hooks)?;
        prepared.has_motions()?;
        let start = start.map_err(|why| StudyError::NoMotion {
            why: why.to_string(),
        })?;
        let mut settings = settings(&base, &system, start.start.t, &options.study)?;
        let method = chetaev_integrate::method(&settings.method).map_err(RunError::from)?;
        if !method.card().adaptive && settings.step.is_none() {
            return Err(StudyError::StepMissing {
                method: settings.method,
            });
        }
        if settings.precise.is_some() {
            return Err(StudyError::PreciseSweep);
        }
        settings.times = times(start.start.t, settings.t_end, options.samples);
        let name = options.study.formulation.as_deref().unwrap_or(REFERENCE);
        let Some(formulation) = formulation(name) else {
            return Err(StudyError::UnknownFormulation {
                name: name.into(),
                known: crate::study::known_formulations(),
            });
        };
        let known = registry();
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&system, terms, selection, &known, Prover::default());
        check_applies(&cx, formulation.card())?;
        drop(cx);
        settings.keep = to_keep(&base, (&system, &prepared), &options.study, hooks)?;
        let columns = columns(&base, &system, &variations, options.samples);
        let mut sweep = Sweep {
            data: initial_data(&base, &system, &options.study)?,
            recipe: Recipe::new(stated, &variations, &targets(stated)),
            model: base,
            system,
            prepared,
            variations,
            options,
            formulation,
            binding: start.binding,
            numeric: start.numeric,
            start: start.start,
            settings,
            compiled: None,
            columns,
            stated: stated.initial.values.keys().copied().collect(),
        };
        // On components of constraints each run has equations of its own.
        let is_routh = formulation.card().name == REFERENCE && !has_components(&sweep.system);
        if is_routh && sweep.prepared.terms.order == 1 && sweep.recipe.is_some() {
            sweep.compiled = Some(sweep.subject().compile_routh(&sweep.settings)?);
        }
        Ok(sweep)
    }

    /// The trajectories, ready for [`chetaev_ensemble::pool::run`].
    pub fn work(&self) -> Box<dyn Work + '_> {
        match (&self.compiled, &self.recipe) {
            (Some(compiled), Some(recipe)) => {
                let members = ModelMembers::new(self, recipe);
                let compiled = compiled.clone();
                Box::new(Routh::new(members, self.subject(), compiled, self.shape()))
            }
            _ => Box::new(Whole(self)),
        }
    }

    /// Whether the equations are compiled once; they are compiled for each trajectory where they depend on its start: other
    /// formulations than Routh's, and constraints of order two and more.
    pub fn is_compiled_once(&self) -> bool {
        self.compiled.is_some() && self.recipe.is_some()
    }

    /// Number of trajectories.
    pub fn count(&self) -> u64 {
        self.variations.count()
    }

    /// The values of trajectory `index`, in the order of the variations.
    pub fn values(&self, index: u64) -> Vec<f64> {
        self.variations.values(index)
    }

    /// What varies.
    pub fn variations(&self) -> &Variations {
        &self.variations
    }

    /// The columns of the results.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// Names of the events, by number.
    pub fn events(&self) -> Vec<&str> {
        self.settings
            .events
            .iter()
            .map(|e| e.name.as_str())
            .collect()
    }

    /// Whether neither the options nor the model say when runs end.
    pub(crate) fn has_no_end(&self) -> bool {
        self.options.study.t_end.is_none() && self.model.simulation.t_end.is_none()
    }

    pub(crate) fn shape(&self) -> Shape {
        self.columns.shape()
    }

    fn subject(&self) -> Subject<'_> {
        Subject {
            system: &self.system,
            terms: &self.prepared.terms,
            selection: &self.prepared.selection,
            binding: &self.binding,
            numeric: &self.numeric,
            start: &self.start,
            factors: &[],
        }
    }

    /// What makes this sweep another than others: two with the same description have the same results, bit for bit, on one
    /// machine.
    pub fn description(&self) -> Vec<(&'static str, String)> {
        let text = &self.model.text;
        let settings = &self.settings;
        let study = &self.options.study;
        vec![
            ("version", env!("CARGO_PKG_VERSION").into()),
            ("model", text.text.clone()),
            ("includes", pairs(&text.includes, "\n")),
            ("overrides", pairs(&text.overrides, "=")),
            ("variations", self.variations.describe()),
            ("end of the run", given(study.t_end)),
            (
                "tolerance",
                format!("{:e} {:e}", settings.tolerance, settings.absolute_tolerance),
            ),
            ("step", given(settings.step)),
            ("method", settings.method.clone()),
            ("formulation", self.formulation.card().name.into()),
            ("project", format!("{}", study.project)),
            ("keep-integrals", format!("{}", settings.keep.len())),
            ("branch", given(study.branch)),
            ("samples", self.options.samples.to_string()),
            ("native code", format!("{}", self.numeric.is_native())),
        ]
    }
}

/// Pairs one after another.
fn pairs(list: &[(String, String)], between: &str) -> String {
    let all = list.iter().map(|(a, b)| format!("{a}{between}{b}"));
    all.collect::<Vec<String>>().join("; ")
}

/// What was given, or that nothing was.
fn given(value: Option<impl std::fmt::Display>) -> String {
    value.map_or_else(|| "as the model says".to_owned(), |value| value.to_string())
}

/// The integrals to keep on every trajectory, where that is asked for.
fn to_keep(
    base: &Model,
    (system, prepared): (&System, &Prepared),
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Result<Vec<Expr>, StudyError> {
    if !keeps(base, options) {
        return Ok(Vec::new());
    }
    if components_are_apart(system, prepared) {
        return Err(StudyError::KeptOnComponents {
            constraints: system.constraints_apart(),
        });
    }
    // Of the same states by simpler equations.
    let simpler = system.components().into_iter().next();
    let simpler = simpler.filter(|on| on.condition.is_none());
    let simpler = simpler.and_then(|on| Some((Prepared::new(&on.system).ok()?, on.system)));
    let (system, prepared) = simpler
        .as_ref()
        .map_or((system, prepared), |(prepared, system)| (system, prepared));
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &known, Prover::default());
    let searched = kept(base, &cx, options, hooks);
    Ok(movable(system, &searched))
}

/// The times at which states are kept: equally far apart, or the end alone.
pub(crate) fn times(t_start: f64, t_end: f64, samples: u32) -> Vec<f64> {
    match samples {
        0 | 1 => vec![t_end],
        samples if t_start == t_end => vec![t_end; samples as usize],
        samples => equal_times(t_start, t_end, samples - 1),
    }
}

/// The expressions of parameters of which the data of a motion are made: initial values, in the order of the model; initial
/// masses; start, end and step.
pub(crate) fn targets(model: &Model) -> Vec<Expr> {
    let simulation = &model.simulation;
    let masses = model
        .masses
        .iter()
        .filter_map(|m| model.initial_mass(&m.name));
    let times = [simulation.t_start, simulation.t_end, simulation.step];
    let values = model.initial.values.values().map(|given| given.value);
    // What is not stated is a number, so that the places stay.
    let zero = model.graph.zero();
    let times = times.into_iter().map(|time| time.unwrap_or(zero));
    values.chain(masses).chain(times).collect()
}

fn columns(model: &Model, system: &System, variations: &Variations, samples: u32) -> Columns {
    let varied: Vec<String> = variations.list().iter().map(|v| v.name.clone()).collect();
    let coordinates = || model.coordinates.iter();
    let state: Vec<String> = coordinates()
        .map(|c| c.name.clone())
        .chain(system.masses.iter().map(|m| m.name.clone()))
        .chain(coordinates().map(|c| format!("{}'", c.name)))
        .collect();
    let integrals = model
        .integrals
        .iter()
        .map(|i| format!("integral_{}", i.name));
    let kept: Vec<String> = std::iter::once("energy".to_owned())
        .chain(integrals)
        .collect();
    let events: Vec<String> = model.events.iter().map(|e| e.name.clone()).collect();
    Columns::new(Names {
        varied: &varied,
        state: &state,
        kept: &kept,
        events: &events,
        samples: samples as usize,
    })
}

/// The model with the values of one trajectory written in.
pub(crate) fn with_values(model: &Model, variations: &Variations, values: &[f64]) -> Model {
    let mut with = model.clone();
    let g = model.graph.clone();
    let mut moving: Vec<Symbol> = Vec::new();
    for (variation, &value) in variations.list().iter().zip(values) {
        let number = decimal(value).map_or_else(|| g.zero(), |value| g.number(value));
        match variation.target {
            Target::Parameter(at) => {
                let parameter = &mut with.parameters[at];
                let scale = parameter
                    .unit
                    .as_ref()
                    .map_or_else(|| g.one(), |u| recipe::unit_of(&g, u));
                parameter.definition = Some(g.mul(&[number, scale]));
                parameter.value = parameter.definition;
                moving.extend(g.as_symbol(parameter.symbol));
            }
            Target::Initial(at, order) => {
                let stated = with.initial.values.get(&(at, order));
                let given = InitialValue {
                    value: number,
                    text: format!("{value}"),
                    is_guess: stated.is_some_and(|given| given.is_guess),
                    place: stated.map_or(with.coordinates[at].place, |given| given.place),
                };
                with.initial.values.insert((at, order), given);
            }
        }
    }
    for at in recipe::following(model, &mut moving) {
        let known = with.parameter_values();
        let known: Vec<(Expr, Expr)> = known
            .into_iter()
            .filter(|(symbol, _)| *symbol != with.parameters[at].symbol)
            .collect();
        let definition = with.parameters[at].definition;
        with.parameters[at].value = definition.map(|definition| g.substitute(definition, &known));
    }
    with
}
