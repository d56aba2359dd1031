//! What a reader must know beside the verdicts.

use crate::start::{holds, Start};
use crate::study::Motion;
use chetaev_mechanics::{Prepared, System};
use chetaev_model::model::Model;
use chetaev_motion::observe::Observer;
use chetaev_symbolic::Expr;

/// Holonomic constraints, redundant ones, completed initial data.
pub(crate) fn notices(model: &Model, system: &System, start: Option<&Start>) -> Vec<String> {
    let mut notices = Vec::new();
    for constraint in &system.constraints {
        if constraint.order == 0 {
            notices.push(format!(
                "constraint `{}` contains no velocities: it is taken as holonomic, {} is kept on the initial level and differentiated once for the reaction",
                constraint.name,
                model.graph.text(constraint.stated)
            ));
        }
    }
    let Some(start) = start else { return notices };
    if !start.start.redundant.is_empty() {
        let names: Vec<String> = start
            .start
            .redundant
            .iter()
            .map(|n| format!("`{n}`"))
            .collect();
        notices.push(format!(
            "redundant constraints: {} depend{} on the others at the initial state (rank {} of {}); motion and reactions are unique, the single multipliers are not, and those of the constraints left out are given as zero",
            names.join(", "),
            if names.len() == 1 { "s" } else { "" },
            start.start.chart.rank(),
            start.numeric.r,
        ));
    }
    let free: Vec<String> = start
        .start
        .completed
        .iter()
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    if !free.is_empty() {
        let how = if start.data.project {
            "projected on"
        } else {
            "completed from"
        };
        notices.push(format!(
            "initial data {how} the constraints: {}",
            free.join(", ")
        ));
    }
    notices
}

/// Assumptions that the motion leaves: what was proved under them says nothing of the motion from there on.
pub(crate) fn left_assumptions(
    system: &System,
    prepared: &Prepared,
    motion: &Motion,
) -> Vec<String> {
    let g = &system.graph;
    let differences: Vec<Expr> = system
        .assumptions
        .iter()
        .map(|a| g.sub(a.right, a.left))
        .collect();
    let observer = Observer::new(system, &prepared.terms, &motion.binding, &differences);
    let Ok(mut observer) = observer else {
        return Vec::new();
    };
    let run = &motion.evidence.run;
    let series = observer.along(run);
    system
        .assumptions
        .iter()
        .zip(series)
        .filter_map(|(assumption, values)| {
            let j = values.iter().position(|&d| !holds(assumption.relation, d))?;
            Some(format!(
                "the motion leaves the assumption `{}` at t = {:.6}: what is proved under it says nothing of the motion from there on",
                assumption.text, run.times[j]
            ))
        })
        .collect()
}
