//! The motion that the model names is admissible and steady.

use crate::about::about;
use crate::admissible_values::AdmissibleValues;
use crate::evidence::motions;
use crate::problem::LinearizationError;
use crate::question::Question;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::System;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::Verdict;

/// `steady.stated#j`: the motion that the model names is admissible and steady.
#[derive(Clone, Copy, Debug)]
pub struct Stated;

impl Claim for Stated {
    fn id(&self) -> &'static str {
        "steady.stated"
    }

    fn group(&self) -> Group {
        Group::Stability
    }

    fn title(&self) -> &'static str {
        "The motion is admissible, and everything that the equations of motion depend on is constant along it"
    }

    fn explanation(&self) -> &'static str {
        include_str!("stated.md")
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        motions(cx)
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        match about(cx, subject) {
            Some(Ok(own))
                if own.question.is_mass_singular()
                    && own.expansion.has_regular_mass_somewhere() =>
            {
                Verdict::undecided(SINGULAR).into()
            }
            Some(Ok(own)) => {
                let question = &own.question;
                let proof = Proof::exact(on(question), steadiness(question));
                let real = |symbol| {
                    let motion = &own.expansion.found;
                    AdmissibleValues::reality(cx.system, motion, symbol).restriction(own.graph())
                };
                match question.over.and_then(real) {
                    None => Verdict::Proved(proof),
                    Some(condition) => Verdict::Conditional {
                        condition,
                        proof,
                        counterexample: None,
                    },
                }
                .into()
            }
            Some(Err(problem)) => refused(cx.system, problem).into(),
            None => Verdict::undecided("the model names no such steady motion").into(),
        }
    }
}

/// What is said where the coordinates are none.
const SINGULAR: &str = "the mass matrix is singular at the motion and not beside it, as where angles or a radius are no coordinates: the equations \
    determine no accelerations there, and that all rates vanish satisfies them without being a motion; state the motion in other coordinates";

/// For which values of the parameters.
fn on(question: &Question) -> &'static str {
    match question.over {
        Some(_) => "for all values of the parameter of the motion for which it and the equations are defined, the others as stated",
        None => "for the values of the parameters that are stated",
    }
}

/// What was found of a steady motion.
fn steadiness(question: &Question) -> String {
    let linear = &question.linear;
    let family = match linear.family {
        0 => String::new(),
        1 => "; it belongs to a family of dimension 1".into(),
        n => format!("; it belongs to a family of dimension {n}"),
    };
    let ignorable = match linear.ignorable.as_slice() {
        [] => String::new(),
        names => format!("; nothing depends on {}", names.join(", ")),
    };
    format!(
        "all constraints hold, and the rates of {} vanish{ignorable}{family}",
        linear.names.join(", ")
    )
}

/// Whether the time stands in L.
fn has_time(system: &System) -> bool {
    let g = &system.graph;
    g.contains_any(system.lagrangian, &[g.intern_symbol("t", 0)])
}

/// What a motion that is not admissible or not steady comes to.
pub(super) fn refused(system: &System, problem: LinearizationError) -> Verdict {
    let sentence = problem.to_string();
    match problem {
        LinearizationError::NotAdmissible {
            enclosure: Some(residual),
            constraint,
            ..
        } => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: format!("the constraint {constraint}, left side minus right side"),
            residual,
            detail: sentence,
        }),
        LinearizationError::NotAssumed {
            assumption,
            enclosure,
            ..
        } => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: format!("what is assumed, {assumption}: left side minus right side"),
            // Where neither side is larger the difference is zero.
            residual: enclosure.unwrap_or_else(|| ("0".into(), "0".into())),
            detail: sentence,
        }),
        LinearizationError::NotSteady {
            enclosure: Some(residual),
            quantity,
            ..
        } => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: format!("what changes {quantity}"),
            residual,
            detail: sentence,
        }),
        LinearizationError::OrderTooHigh { .. } => {
            Verdict::not_applicable("model.constraints-first-order", sentence)
        }
        // The time may stand in forces alone, so that no claim on L or on constraints says it.
        LinearizationError::NotAutonomous if has_time(system) => {
            Verdict::not_applicable("model.lagrangian-autonomous", sentence)
        }
        _ => Verdict::undecided(sentence),
    }
}
