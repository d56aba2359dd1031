//! A system with the numbers of its motion, as the tests of this package run it.

use chetaev_mechanics::{Prepared, System};
use chetaev_motion::{consistent_state, Binding, InitialData, NumericSystem, Run, Subject};

/// What `work` makes of a system at a start that is given completely, at the time 0.
pub(crate) fn with_subject<R>(
    system: &System,
    (q, v): (&[f64], &[f64]),
    work: impl FnOnce(&Subject<'_>) -> R,
) -> R {
    let data = InitialData {
        t: 0.0,
        q: q.to_vec(),
        v: v.to_vec(),
        q_fixed: vec![true; q.len()],
        v_fixed: vec![true; v.len()],
        project: false,
    };
    with_data(system, &data, work)
}

/// What `work` makes of a system at the start by these data.
pub(crate) fn with_data<R>(
    system: &System,
    data: &InitialData,
    work: impl FnOnce(&Subject<'_>) -> R,
) -> R {
    let prepared = Prepared::new(system).unwrap();
    let binding = Binding::new(system).unwrap();
    let mut numeric = NumericSystem::new(system, &prepared.terms, &binding).unwrap();
    let start = consistent_state(&mut numeric, data).unwrap();
    work(&Subject {
        system,
        terms: &prepared.terms,
        selection: &prepared.selection,
        binding: &binding,
        numeric: &numeric,
        start: &start,
        factors: &[],
    })
}

/// The last row of a run.
pub(crate) fn last_row(run: &Run) -> &[f64] {
    let width = run.rows.len() / run.times.len();
    &run.rows[run.rows.len() - width..]
}
