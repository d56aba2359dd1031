//! From what a user states to a system.

use crate::mass::NamedMasses;
use crate::system::{
    Assumption, CharacteristicFormulas, CompleteIntegral, FrameFields, IntegralForm, NameNote,
    Particle, Relation, StatedEquations, SteadyMotion, System, SystemError, SystemParts, Thrust,
    Twin, Unknown, VariationOperator,
};
use chetaev_model::model::{InitialValue, MassLaw, Model, SteadyStated, Thrust as StatedThrust};
use chetaev_model::units::Unit;
use chetaev_symbolic::syntax::Relation as Stated;
use std::collections::BTreeMap;
use std::sync::Arc;

impl System {
    /// The system a model states.
    ///
    /// # Errors
    /// [`SystemError`].
    pub fn from_model(model: &Model) -> Result<System, SystemError> {
        let name_of = |i: usize| model.coordinates[i].name.clone();
        let independent = model.independent.clone().unwrap_or_default();
        let parts = SystemParts {
            name: model.name.clone(),
            coordinates: model.coordinates.iter().map(|c| c.name.clone()).collect(),
            parameters: model
                .parameters
                .iter()
                .map(|p| (p.name.clone(), p.value))
                .collect(),
            controls: model
                .controls
                .iter()
                .map(|u| (u.name.clone(), u.law))
                .collect(),
            kinetic: model.kinetic,
            potential: model.potential,
            lagrangian: Some(model.lagrangian),
            forces: model
                .forces
                .iter()
                .map(|f| (name_of(f.coordinate), f.value))
                .collect(),
            rayleigh: model.rayleigh,
            constraints: model
                .constraints
                .iter()
                .map(|c| (c.name.clone(), c.f))
                .collect(),
            independent: independent.into_iter().map(name_of).collect(),
            quasi_velocities: model
                .quasi_velocities
                .iter()
                .map(|u| (u.name.clone(), u.value))
                .collect(),
            frame: model.frame.as_ref().map(|frame| FrameFields {
                fields: frame.fields.clone(),
                drift: frame.drift.clone(),
            }),
            start: (model.initial.values.iter())
                .map(|(&(i, order), given)| (name_of(i), order, given.value))
                .collect(),
            characteristics: model
                .characteristics
                .as_ref()
                .map(|c| CharacteristicFormulas {
                    parameters: c.parameters.clone(),
                    formulas: c.formulas.clone(),
                }),
            particles: model
                .particles
                .iter()
                .map(|p| Particle {
                    name: p.name.clone(),
                    mass: p.mass,
                    position: p.position.clone(),
                    force: p.force.clone(),
                    thrust: thrust(&p.thrust),
                })
                .collect(),
            mechanism: model.mechanism.clone(),
            masses: model
                .masses
                .iter()
                .filter_map(|m| Some((m.name.clone(), model.mass_rate(&m.name)?)))
                .collect(),
            mass_functions: model
                .masses
                .iter()
                .filter_map(|m| match m.law {
                    MassLaw::Value(value) => Some((m.name.clone(), value)),
                    MassLaw::Rate { .. } => None,
                })
                .collect(),
            reactive_forces: model
                .reactive_forces
                .iter()
                .flatten()
                .map(|f| (name_of(f.coordinate), f.value))
                .collect(),
            named_masses: named_masses(model),
            definitions: model
                .parameters
                .iter()
                .filter_map(|p| Some((p.name.clone(), p.definition?)))
                .filter(|(_, e)| !model.graph.symbols_in(&[*e]).is_empty())
                .collect(),
            angles: model
                .coordinates
                .iter()
                .filter(|c| c.unit.as_ref().is_some_and(|unit| unit.text == "rad"))
                .map(|c| c.name.clone())
                .collect(),
            integral_conditions: model
                .integral_conditions
                .iter()
                .map(|c| (c.integral.clone(), c.left, c.right, c.text.clone()))
                .collect(),
            search_functions: model.search.iter().map(|f| f.value).collect(),
            search_degree: model.search_degree,
            integrals: model
                .integrals
                .iter()
                .map(|i| (i.name.clone(), i.value))
                .collect(),
            integral_forms: model
                .integral_forms
                .iter()
                .map(|own| IntegralForm {
                    name: own.form.name.clone(),
                    value: own.form.value,
                    unknowns: own
                        .unknowns
                        .iter()
                        .map(|unknown| Unknown {
                            symbol: unknown.symbol,
                            arguments: unknown.arguments.clone(),
                        })
                        .collect(),
                })
                .collect(),
            variations: model
                .variations
                .iter()
                .map(|v| VariationOperator {
                    name: v.name.clone(),
                    relations: v.relations.clone(),
                })
                .collect(),
            complete_integral: model.complete_integral.as_ref().map(|s| CompleteIntegral {
                action: s.action,
                constants: s.constants.clone(),
                quadratures: s.quadratures.clone(),
                motion: s.motion.clone(),
            }),
            steady: model.steady.iter().map(|s| steady(model, s)).collect(),
            equations: model
                .equations
                .iter()
                .map(|set| StatedEquations {
                    name: set.name.clone(),
                    unknowns: set.unknowns.clone(),
                    equations: set
                        .equations
                        .iter()
                        .map(|e| (e.name.clone(), e.left, e.right))
                        .collect(),
                })
                .collect(),
            notes: notes(model),
            twins: model
                .twins
                .iter()
                .map(|twin| {
                    Ok(Twin {
                        name: twin.name.clone(),
                        system: Arc::new(System::from_model(&twin.model)?),
                        map: twin.map.clone(),
                        symbols: twin.symbols.clone(),
                    })
                })
                .collect::<Result<_, SystemError>>()?,
            assumptions: model.assumptions.iter().filter_map(assumption).collect(),
        };
        System::new(Arc::clone(&model.graph), parts)
    }
}

/// The places of values that are guesses.
fn guesses(values: &BTreeMap<(usize, u32), InitialValue>) -> Vec<(usize, u32)> {
    let guessed = values.iter().filter(|(_, own)| own.is_guess);
    guessed.map(|(place, _)| *place).collect()
}

fn steady(model: &Model, stated: &SteadyStated) -> SteadyMotion {
    let of = |order: u32| {
        let value = |i: usize| stated.values.get(&(i, order)).map(|given| given.value);
        (0..model.coordinates.len()).map(value).collect()
    };
    SteadyMotion {
        name: stated.name.clone(),
        positions: of(0),
        velocities: of(1),
        guesses: guesses(&stated.values),
        over: stated.over.and_then(|own| model.graph.as_symbol(own)),
    }
}

fn thrust(stated: &StatedThrust) -> Thrust {
    match stated {
        StatedThrust::Isotropic => Thrust::Isotropic,
        StatedThrust::RelativeVelocity(u) => Thrust::RelativeVelocity(u.clone()),
        StatedThrust::ExhaustSpeed(c) => Thrust::ExhaustSpeed(*c),
        StatedThrust::AbsoluteVelocity(w) => Thrust::AbsoluteVelocity(w.clone()),
        StatedThrust::Force(force) => Thrust::Force(force.clone()),
    }
}

/// The masses in a kinetic energy that is stated without particles and without reactive forces.
fn named_masses(model: &Model) -> Option<NamedMasses> {
    if model.reactive_forces.is_some() || !model.particles.is_empty() {
        return None;
    }
    let value = |law: &MassLaw, symbol| match law {
        MassLaw::Value(value) => *value,
        MassLaw::Rate { .. } => symbol,
    };
    let masses = model.masses.iter();
    Some(NamedMasses {
        inertia: model.inertia_by_masses?,
        is_kinetic: model.kinetic.is_some(),
        masses: masses
            .map(|m| (m.symbol, value(&m.law, m.symbol)))
            .collect(),
    })
}

/// An equality is no assumption on signs; it is left out.
fn assumption(stated: &chetaev_model::model::Assumption) -> Option<Assumption> {
    let (left, relation, right) = match stated.relation {
        Stated::Equal => return None,
        Stated::NotEqual => (stated.left, Relation::NotEqual, stated.right),
        Stated::Less => (stated.left, Relation::Less, stated.right),
        Stated::LessOrEqual => (stated.left, Relation::LessOrEqual, stated.right),
        Stated::Greater => (stated.right, Relation::Less, stated.left),
        Stated::GreaterOrEqual => (stated.right, Relation::LessOrEqual, stated.left),
    };
    Some(Assumption {
        left,
        relation,
        right,
        text: stated.text.clone(),
    })
}

/// Symbols, units and descriptions by name.
fn notes(model: &Model) -> BTreeMap<String, NameNote> {
    let text = |unit: &Option<Unit>| unit.as_ref().map_or_else(String::new, |u| u.text.clone());
    let coordinates = (model.coordinates.iter()).map(|c| (&c.name, text(&c.unit), &c.description));
    let parameters = (model.parameters.iter()).map(|p| (&p.name, text(&p.unit), &p.description));
    let controls = (model.controls.iter()).map(|u| (&u.name, text(&u.unit), &u.description));
    let defined = model.quasi_velocities.iter().chain(&model.defines);
    let defined = defined.map(|d| (&d.name, String::new(), &d.description));
    let all = coordinates.chain(parameters).chain(controls).chain(defined);
    let mut notes: BTreeMap<String, NameNote> = all
        .map(|(name, unit, description)| {
            let note = NameNote {
                latex: None,
                unit,
                description: description.clone(),
            };
            (name.clone(), note)
        })
        .collect();
    for (name, latex) in &model.symbols {
        notes.entry(name.clone()).or_default().latex = Some(latex.clone());
    }
    notes
}
