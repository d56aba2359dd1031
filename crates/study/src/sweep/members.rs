//! The trajectories of a sweep by Routh's equations: numbers alone.

use super::recipe::{Numbers, Recipe};
use super::vary::Target;
use super::{times, Sweep};
use crate::error::StudyError;
use crate::start::{check_assumption, of_start};
use chetaev_ensemble::{Member, Members};
use chetaev_motion::ConsistentState;
use chetaev_symbolic::Symbol;

/// What a target of the recipe gives.
#[derive(Clone, Copy, Debug)]
enum Use {
    Initial(usize, u32),
    Mass(usize),
    Start,
    End,
    Step,
}

/// The trajectories of a sweep.
#[derive(Debug)]
pub(crate) struct ModelMembers<'s> {
    sweep: &'s Sweep,
    recipe: &'s Recipe,
    uses: Vec<Use>,
    /// Symbols of all parameters, in the order of their values.
    symbols: Vec<Symbol>,
}

impl<'s> ModelMembers<'s> {
    pub(crate) fn new(sweep: &'s Sweep, recipe: &'s Recipe) -> ModelMembers<'s> {
        let masses = &sweep.model.masses;
        let own = masses
            .iter()
            .filter(|m| sweep.model.initial_mass(&m.name).is_some());
        let place = |name: &str| sweep.system.masses.iter().position(|m| m.name == name);
        let stated = sweep.stated.iter();
        let mut uses: Vec<Use> = stated.map(|&(i, order)| Use::Initial(i, order)).collect();
        uses.extend(own.map(|m| Use::Mass(place(&m.name).unwrap_or_default())));
        uses.extend([Use::Start, Use::End, Use::Step]);
        ModelMembers {
            sweep,
            recipe,
            uses,
            symbols: sweep
                .binding
                .parameters
                .iter()
                .map(|(symbol, _)| *symbol)
                .collect(),
        }
    }

    fn numbers(&self, values: &[f64]) -> Result<Numbers, String> {
        self.recipe.numbers(values).map_err(|at| {
            let name = &self.sweep.model.parameters[at].name;
            format!("the value of parameter `{name}` is not a finite number")
        })
    }
}

impl Members for ModelMembers<'_> {
    fn count(&self) -> u64 {
        self.sweep.count()
    }

    fn member(&self, index: u64) -> Result<Member, String> {
        let sweep = self.sweep;
        let values = sweep.values(index);
        let numbers = self.numbers(&values)?;
        let mut data = sweep.data.clone();
        let mut settings = sweep.settings.clone();
        for (place, value) in numbers.targets {
            let used = self.uses[place];
            let value = value.ok_or_else(|| self.no_value(used))?;
            match used {
                Use::Initial(i, 0) => data.q[i] = value,
                Use::Initial(i, _) => data.v[i] = value,
                Use::Mass(at) => data.q[sweep.system.n() + at] = value,
                Use::Start => data.t = value,
                Use::End if sweep.options.study.t_end.is_some() => {}
                Use::End => settings.t_end = value,
                Use::Step if sweep.options.study.step.is_some() => {}
                Use::Step if value > 0.0 => settings.step = Some(value),
                Use::Step => return Err(StudyError::Step.to_string()),
            }
        }
        for (variation, &value) in sweep.variations.list().iter().zip(&values) {
            match variation.target {
                Target::Initial(i, 0) => data.q[i] = value,
                Target::Initial(i, _) => data.v[i] = value,
                Target::Parameter(_) => {}
            }
        }
        if data.t != sweep.data.t && sweep.has_no_end() {
            settings.t_end = data.t + 10.0;
        }
        settings.times = times(data.t, settings.t_end, sweep.options.samples);
        Ok(Member {
            parameters: self.recipe.has_parameters().then_some(numbers.parameters),
            data,
            settings,
        })
    }

    fn check(&self, index: u64, start: &ConsistentState) -> Result<(), String> {
        let sweep = self.sweep;
        let generic = sweep.prepared.selection.rows.len();
        let rank = start.chart.rank();
        if rank < generic {
            let names = sweep
                .numeric
                .constraints
                .iter()
                .map(|name| format!("`{name}`"));
            let names: Vec<String> = names.collect();
            let problem = StudyError::RankDeficient {
                names: names.join(", "),
                rank,
                generic,
            };
            return Err(problem.to_string());
        }
        if sweep.system.assumptions.is_empty() {
            return Ok(());
        }
        let parameters = self.numbers(&sweep.values(index))?.parameters;
        self.check_assumptions(&parameters, start)
    }
}

impl ModelMembers<'_> {
    fn no_value(&self, used: Use) -> String {
        let model = &self.sweep.model;
        let name = match used {
            Use::Initial(i, order) => {
                format!(
                    "{}{}",
                    model.coordinates[i].name,
                    "'".repeat(order as usize)
                )
            }
            Use::Mass(at) => self.sweep.system.masses[at].name.clone(),
            Use::Start => "t_start".into(),
            Use::End => "t_end".into(),
            Use::Step => "step".into(),
        };
        StudyError::InitialValue { name }.to_string()
    }

    /// The values and the start lie where the model says that motions are.
    fn check_assumptions(&self, parameters: &[f64], start: &ConsistentState) -> Result<(), String> {
        let system = &self.sweep.system;
        let g = &system.graph;
        let value = |symbol: Symbol| {
            let own = self.symbols.iter().position(|&s| s == symbol);
            own.map(|at| parameters[at])
                .or_else(|| of_start(system, symbol, start))
        };
        for assumption in &system.assumptions {
            let sides = [assumption.left, assumption.right];
            check_assumption(g, assumption, &sides, &value)
                .map_err(|problem| problem.to_string())?;
        }
        Ok(())
    }
}
