//! The accelerations by quasi-velocities without singular places, with which motions are computed, are those of Routh's equations.

use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::{reduced_equations, Equations};

/// The trial; `None` where there are no such quasi-velocities.
pub(super) fn accelerations(subject: &Subject<'_>) -> Option<Trial> {
    let cx = subject.cx;
    let rows = &cx.selection.rows;
    let direct = Equations {
        accelerations: reduced_equations::accelerations(cx.system, cx.terms, rows)?,
        ..subject.routh.clone()
    };
    Some(Trial {
        kind: Kind::Other,
        law: "accelerations by quasi-velocities without singular places",
        formulation: "",
        about: String::new(),
        expected: Expected::Proved,
        verdict: subject.compared(&direct),
        seconds: 0.0,
    })
}
