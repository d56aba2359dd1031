//! From what a user states to a system.

use crate::system::{
    Assumption, CharacteristicFormulas, FrameFields, Particle, Relation, System, SystemError,
    SystemParts,
};
use chetaev_model::model::Model;
use chetaev_symbolic::syntax::Relation as Stated;
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
                })
                .collect(),
            assumptions: model.assumptions.iter().filter_map(assumption).collect(),
        };
        System::new(Arc::clone(&model.graph), parts)
    }
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
