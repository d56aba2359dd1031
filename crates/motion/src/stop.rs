//! Why a run ended, in mechanical terms.

use crate::chart::Chart;
use crate::multiplier_flow::StateKind;
use crate::numeric::NumericSystem;
use crate::watch::Watched;
use chetaev_integrate::{EvaluationFailure, HaltReason, Stop};
use chetaev_mechanics::words::{number, precise_number, quoted};

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Ending {
    /// Whether the end of the span was reached.
    pub finished: bool,
    /// Whether the user interrupted it.
    pub interrupted: bool,
    /// One sentence.
    pub reason: String,
    /// Time of the end, or the extrapolated time of the singularity.
    pub t: f64,
}

/// Names for messages.
#[derive(Clone, Debug)]
pub struct Names<'a> {
    /// Of the coordinates.
    pub coordinates: &'a [String],
    /// Of the constraint rows.
    pub constraints: &'a [String],
    /// Of the components of the state.
    pub state: Vec<String>,
    /// What the equations are solved for where that is no matter of the mass matrix.
    pub unknowns: Option<String>,
    /// The matrix of the equations, where it is not the mass matrix alone.
    pub matrix: Option<&'static str>,
}

/// Names of the components of the state of the multiplier form.
pub fn component_names(system: &NumericSystem, kind: StateKind, chart: &Chart) -> Vec<String> {
    let coordinates = &system.coordinates;
    let mut names = coordinates.clone();
    names.extend_from_slice(&system.masses);
    match kind {
        StateKind::Full => names.extend(coordinates.iter().map(|c| format!("{c}'"))),
        StateKind::Reduced => {
            names.extend(
                chart
                    .independent
                    .iter()
                    .map(|&i| format!("{}'", coordinates[i])),
            );
        }
    }
    names
}

/// The run met a point where a watched quantity vanishes.
pub fn vanished(what: &Watched, t: f64, constraints: &[String]) -> Ending {
    let at = precise_number(t);
    let reason = match what {
        Watched::Gradient { row } => format!(
            "the gradient of constraint `{}` by the velocities vanishes at t = {at}: the rank of the constraints falls and the motion beyond is not determined",
            constraints[*row]
        ),
        Watched::Mass { name } => {
            let at = number(t);
            format!("the mass of `{name}` reaches zero at t = {at}: there is nothing left to move")
        }
        Watched::Speed { particle } => format!(
            "the velocity of `{particle}` vanishes at t = {at}: the thrust against it has no direction there"
        ),
        Watched::Expression { text } => format!(
            "{text} vanishes at t = {at}: the equations are singular there{}",
            of_constraints(constraints)
        ),
        Watched::Regularity { matrix } => format!(
            "{matrix}, becomes singular at t = {at}: the equations do not determine the motion beyond{}",
            of_constraints(constraints)
        ),
        Watched::Structure { unknowns } => format!(
            "the equations no longer determine {unknowns} at t = {at}: the determinant of the system for them vanishes, so the structure changes and the motion beyond is not determined{}",
            of_constraints(constraints)
        ),
    };
    early(reason, t)
}

/// The motion is not determined beyond a place, for this reason.
pub(crate) fn undetermined(reason: String, t: f64) -> Ending {
    early(reason, t)
}

/// Zeros of one function repeat at every one of many very short steps.
pub(crate) fn crowd(what: &str, t: f64, count: u64) -> Ending {
    let at = precise_number(t);
    early(
        format!("{what} repeats without end near t = {at}, in {count} very short steps in a row: the motion grazes its zero or chatters across it, since a force jumps or is undetermined there; end the run at it (`action = \"stop\"` at a threshold above zero), smooth the force, for example by tanh(v/eps), or go on with the equations that hold beyond"),
        t,
    )
}

/// The motion sticks on the zero of a function under a sign.
pub(crate) fn stuck(text: &str, t: f64) -> Ending {
    let at = precise_number(t);
    early(
        format!("the motion sticks at t = {at}: {text} is zero there, and the force, which jumps with its sign, drives it back from both sides, so that no motion with either sign goes on; go on with {text} = 0 as a constraint, or smooth the jump, for example by tanh(v/eps)"),
        t,
    )
}

/// The run was to end at an event, and did.
pub fn happened(name: &str, t: f64) -> Ending {
    let at = precise_number(t);
    Ending {
        finished: true,
        interrupted: false,
        reason: format!("the event `{name}` ended the run at t = {at}"),
        t,
    }
}

fn of_constraints(constraints: &[String]) -> String {
    if constraints.is_empty() {
        return String::new();
    }
    format!(" (constraints {})", quoted(constraints))
}

fn early(reason: String, t: f64) -> Ending {
    Ending {
        finished: false,
        interrupted: false,
        reason,
        t,
    }
}

/// Translates the integrator's reason; `pivot` is the smallest pivot of the scaled constraint Jacobian at the end.
pub fn ending(stop: &Stop, names: &Names<'_>, pivot: f64) -> Ending {
    let component = |i: usize| {
        names
            .state
            .get(i)
            .cloned()
            .unwrap_or_else(|| format!("component {i}"))
    };
    let rank = if pivot < 1e-2 {
        format!(
            "; the constraints{} become dependent there: their rank drops (smallest pivot {pivot:.1e})",
            list(names.constraints)
        )
    } else {
        String::new()
    };
    let at = precise_number(match stop {
        Stop::Divergence { singularity, .. } => *singularity,
        Stop::Singular { t, .. }
        | Stop::StepTooSmall { t, .. }
        | Stop::NotFinite { t, .. }
        | Stop::StepLimit { t, .. }
        | Stop::Stiff { t, .. } => *t,
        _ => f64::NAN,
    });
    match stop {
        Stop::Finished => Ending {
            finished: true,
            interrupted: false,
            reason: "the end of the time span was reached".into(),
            t: f64::NAN,
        },
        Stop::Interrupted { t } => Ending {
            finished: false,
            interrupted: true,
            reason: format!("interrupted at t = {t}; what was computed is kept"),
            t: *t,
        },
        Stop::Event { t, .. } => Ending {
            finished: true,
            interrupted: false,
            reason: "the end of the time span was reached".into(),
            t: *t,
        },
        Stop::Singular {
            t,
            failure: EvaluationFailure::LeftConstraint { constraint },
        }
        | Stop::Halted {
            t,
            reason: HaltReason::LeftConstraint { constraint },
        } => early(left(*constraint, *t, names), *t),
        Stop::Singular { t, failure } => early(
            format!("singular state at t = {at}: {}{rank}", singular(failure, names)),
            *t,
        ),
        Stop::Halted { t, reason } => early(halted(reason, *t, names), *t),
        Stop::Divergence { singularity, component: i, .. } => early(
            format!(
                "singular state: the rate of {} grows without bound towards t = {at}{rank}",
                component(*i)
            ),
            *singularity,
        ),
        Stop::StepTooSmall { t, component: i, .. } => early(
            format!(
                "the tolerance cannot be met at t = {at}: the step became too small, the largest error is that of {}; the state is close to a singular one{rank}, or a force jumps there (sign, abs): then smooth the jump, for example by tanh(v/eps)",
                component(*i)
            ),
            *t,
        ),
        Stop::NotFinite { t, component: i } => early(
            format!("singular state at t = {at}: {} is not finite{rank}", component(*i)),
            *t,
        ),
        Stop::StepLimit { t, limit } => early(
            format!("the limit of {limit} steps was reached at t = {at}; raise `max_steps` or the tolerance; where a force jumps (sign, abs) the steps chatter across the jump and more of them do not help: smooth the jump, for example by tanh(v/eps)"),
            *t,
        ),
        Stop::Stiff { t, steps, steps_ahead } => early(
            format!(
                "the problem is stiff: after {steps} steps the run stands at t = {at}, and about {steps_ahead:.0} more would be needed by an explicit method; an implicit method is the right tool"
            ),
            *t,
        ),
        _ => early("the run ended early, by a condition that has no words here".to_owned(), f64::NAN),
    }
}

fn list(names: &[String]) -> String {
    let quoted: Vec<String> = names.iter().map(|n| format!(" `{n}`")).collect();
    quoted.join(",")
}

fn singular(failure: &EvaluationFailure, names: &Names<'_>) -> String {
    match failure {
        EvaluationFailure::Singular { .. } if names.unknowns.is_some() => format!(
            "the equations do not determine {} there, the determinant of the system for them vanishes and the structure changes",
            names.unknowns.as_deref().unwrap_or_default()
        ),
        EvaluationFailure::Singular { .. } if names.matrix.is_some() => {
            format!("{} is singular", names.matrix.unwrap_or_default())
        }
        EvaluationFailure::Singular { .. } => {
            "the mass matrix restricted to the constraints is singular".to_string()
        }
        EvaluationFailure::PivotDegraded { .. } => {
            "the dependent velocities cannot be solved from the constraints".to_string()
        }
        EvaluationFailure::NotFinite { .. } => {
            "the equations of motion have no finite value".to_string()
        }
        other => other.to_string(),
    }
}

fn left(constraint: usize, t: f64, names: &Names<'_>) -> String {
    let at = precise_number(t);
    format!(
        "the motion left the constraint `{}` at t = {at}: it has no continuation there, the two sides of the constraint jump apart (a branch of a root or of an angle ends, or a sign changes)",
        names.constraints.get(constraint).cloned().unwrap_or_default()
    )
}

fn halted(reason: &HaltReason, t: f64, names: &Names<'_>) -> String {
    let at = precise_number(t);
    let name = |i: usize| names.constraints.get(i).cloned().unwrap_or_default();
    match reason {
        HaltReason::RankDrop { from, to, constraint } => format!(
            "the constraint rank falls from {from} to {to} at t = {at}: the gradient of `{}` vanishes or becomes dependent",
            name(*constraint)
        ),
        HaltReason::Contradiction { constraint } => {
            format!("constraint `{}` contradicts the others at t = {at}", name(*constraint))
        }
        _ => format!("the run was halted at t = {at} by a condition of the program that runs it"),
    }
}
