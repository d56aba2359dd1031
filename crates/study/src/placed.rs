//! Problems of the mechanics shown where the model states what they name.

use crate::error::StudyError;
use chetaev_integrate::IntegrateError;
use chetaev_model::model::Model;
use chetaev_model::{Diagnostic, Place};
use chetaev_motion::RunError;

/// What is wrong with the input of a study: one diagnostic for each mistake, at its place.
pub fn diagnostics(problem: &StudyError, model: &Model) -> Vec<Diagnostic> {
    let StudyError::UnknownClaims { claims } = problem else {
        let stated = keys(problem)
            .iter()
            .find_map(|key| model.simulation.place(key));
        return vec![match stated {
            Some(place) => Diagnostic::error("mechanics", place, problem.to_string()),
            None => placed(&problem.to_string(), model),
        }];
    };
    claims
        .iter()
        .map(|unknown| {
            let message = format!("there is no claim `{}`", unknown.claim);
            let hint = match unknown.near {
                Some(near) => format!("did you mean `{near}`?"),
                None => "`chetaev explain` lists all claims".to_owned(),
            };
            Diagnostic::error("unknown-claim", unknown.place, message).hint(hint)
        })
        .collect()
}

/// The keys of `[simulation]` that a problem may come from; the first one that is stated is where it stands.
fn keys(problem: &StudyError) -> &'static [&'static str] {
    match problem {
        StudyError::Tolerance { .. } | StudyError::PreciseTolerance { .. } => &["tolerance"],
        StudyError::AbsoluteTolerance | StudyError::Run(RunError::Tolerance { .. }) => {
            &["absolute_tolerance", "tolerance"]
        }
        StudyError::PrecisionMethod { .. } => &["method", "precision"],
        StudyError::PreciseSweep => &["precision"],
        StudyError::KeptOnComponents { .. } => &["keep_integrals"],
        StudyError::Step => &["step"],
        StudyError::StepMissing { .. }
        | StudyError::Run(RunError::Integrate(IntegrateError::UnknownMethod { .. })) => &["method"],
        StudyError::TooManyRows { .. }
        | StudyError::OutputTime { .. }
        | StudyError::OutputOrder
        | StudyError::OutputStep => &["output"],
        _ => &[],
    }
}

/// A diagnostic at the places of the constraints, parameters, controls, masses, initial values and coordinates that `problem`
/// names in quotes (`` `roll` ``); where it names none, at the initial data or at the beginning of the file.
pub fn placed(problem: &str, model: &Model) -> Diagnostic {
    let mut places: Vec<Place> = Vec::new();
    for name in problem.split('`').skip(1).step_by(2) {
        if let Some(place) = place_of(name, model) {
            if !places.contains(&place) {
                places.push(place);
            }
        }
    }
    let mut places = places.into_iter();
    let first = places
        .next()
        .or_else(|| model.initial.values.values().map(|given| given.place).min())
        .unwrap_or_default();
    places.fold(
        Diagnostic::error("mechanics", first, problem),
        |diagnostic, place| diagnostic.related(place, "and here"),
    )
}

fn place_of(name: &str, model: &Model) -> Option<Place> {
    let base = name.trim_end_matches('\'');
    let order = u32::try_from(name.len() - base.len()).ok()?;
    let coordinate = model.coordinates.iter().position(|c| c.name == base);
    let constraint = model.constraints.iter().find(|c| c.name == name);
    let parameter = model.parameters.iter().find(|p| p.name == name);
    let control = model.controls.iter().find(|u| u.name == name);
    let mass = model.masses.iter().find(|m| m.name == name);
    let assumption = model.assumptions.iter().find(|a| a.text == name);
    constraint
        .map(|c| c.place)
        .or_else(|| parameter.map(|p| p.place))
        .or_else(|| control.map(|u| u.place))
        .or_else(|| mass.map(|m| m.place))
        .or_else(|| assumption.map(|a| a.place))
        .or_else(|| {
            let given = model.initial.values.get(&(coordinate?, order));
            given.map(|value| value.place)
        })
        .or_else(|| Some(model.coordinates[coordinate?].place))
}
