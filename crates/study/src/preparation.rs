//! What is done with a model before its claims and its motion: terms, independent constraints, and the start.

use crate::error::StudyError;
use crate::options::{Hooks, StudyOptions};
use crate::registry::registry;
use crate::start::{add_jets, asks_for_motion, check_rank, start_of_motion, NoMotion, Start};
use chetaev_mechanics::characteristics::{select, Selection};
use chetaev_mechanics::multiplicity::Multiplicity;
use chetaev_mechanics::sample::rank_near;
use chetaev_mechanics::{Context, MotionTerms, Prepared, Prover, System};
use chetaev_model::model::Model;
use chetaev_symbolic::Verdict;

/// The system, its terms with independent constraints, and the start of the motion or why there is none.
pub(crate) fn prepare(
    model: &Model,
    options: &StudyOptions,
    hooks: &mut Hooks<'_>,
) -> Result<(System, Prepared, Result<Start, NoMotion>), StudyError> {
    let system = System::from_model(model)?;
    check_initial_data(model, &system)?;
    (hooks.progress)("deriving", None);
    let terms = MotionTerms::new(&system);
    match with_motions(model, &system, &terms, options) {
        Ok((prepared, start)) => Ok((system, prepared, start)),
        Err(problem) if is_of_the_constraints(&problem) => {
            match Multiplicity::find(&system, &terms, &Prover::default()) {
                Some(own) => {
                    let degenerate = own.degenerate(&system);
                    let why = NoMotion::Constraints(degenerate.error());
                    let prepared = Prepared {
                        terms,
                        selection: Selection::none(),
                        degenerate: Some(degenerate),
                    };
                    Ok((system, prepared, Err(why)))
                }
                None => Err(problem),
            }
        }
        Err(problem) => Err(problem),
    }
}

/// Whether a motion cannot begin by the constraints and where they hold.
fn is_of_the_constraints(problem: &StudyError) -> bool {
    matches!(
        problem,
        StudyError::Initial(_) | StudyError::Characteristics(_) | StudyError::RankDeficient { .. }
    )
}

/// Independent constraints, and the start of the motion or why there is none.
fn with_motions(
    model: &Model,
    system: &System,
    terms: &MotionTerms,
    options: &StudyOptions,
) -> Result<(Prepared, Result<Start, NoMotion>), StudyError> {
    let start = start_of_motion(model, system, terms, options)?;
    let selection = match select(system, terms) {
        Ok(selection) => selection,
        Err(error) => match &start {
            Ok(found) if terms.order == 1 => found.selection(),
            _ => return Err(error.into()),
        },
    };
    let selection = on_component_of(system, terms, start.as_ref().ok(), selection);
    if let (Ok(start), 1) = (&start, terms.order) {
        check_rank(start, selection.rows.len())?;
    }
    let prepared = Prepared {
        terms: terms.clone(),
        selection,
        degenerate: None,
    };
    prepared.left_out(system)?;
    let mut start = start;
    if let (Ok(found), true) = (&mut start, prepared.terms.order > 1) {
        match add_jets(
            model,
            system,
            (&prepared.terms, &prepared.selection),
            found,
            options,
        ) {
            Err(StudyError::Jets(problem)) => {
                let problem = match undetermined(system, &prepared) {
                    Some(detail) => StudyError::Undetermined { detail },
                    None => StudyError::Jets(problem),
                };
                if asks_for_motion(model) {
                    return Err(problem);
                }
                start = Err(NoMotion::Undetermined(problem));
            }
            outcome => outcome?,
        }
    }
    Ok((prepared, start))
}

/// The selection on the component of the constraint set on which the motion begins, where the rank there is another than that of the
/// state that was sampled.
fn on_component_of(
    system: &System,
    terms: &MotionTerms,
    start: Option<&Start>,
    selection: Selection,
) -> Selection {
    let Some(start) = start.filter(|_| terms.order == 1) else {
        return selection;
    };
    let chart = &start.start.chart;
    if chart.rank() == selection.rows.len() {
        return selection;
    }
    let g = &system.graph;
    let known = start.binding.parameters.iter().copied();
    let moving = start.binding.variables.iter().copied();
    let values = [&[start.start.t][..], &start.start.q, &start.start.v].concat();
    let state = known.chain(moving.zip(values)).collect();
    let laws = |e| g.substitute_all(&[e], &start.binding.controls)[0];
    let is_plain = terms.jacobian.concat().into_iter().all(|e| laws(e) == e);
    match is_plain.then(|| rank_near(system, terms, &state)).flatten() {
        Some(rank) if rank == chart.rank() => start.selection(),
        _ => selection,
    }
}

/// Why constraints and equations of motion determine no derivatives of order m at any state, if that is so.
fn undetermined(system: &System, prepared: &Prepared) -> Option<String> {
    refuted(system, prepared, "order.determined")
}

/// Why the characteristics that the model states do not parametrize what the constraints admit, if that is so.
pub(crate) fn wrong_characteristics(system: &System, prepared: &Prepared) -> Option<String> {
    system.characteristics.as_ref()?;
    refuted(system, prepared, "order.characteristics")
}

fn refuted(system: &System, prepared: &Prepared, claim: &str) -> Option<String> {
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(system, terms, selection, &known, Prover::default());
    match &cx.finding(claim).verdict {
        Verdict::Refuted(counterexample) => Some(counterexample.detail.clone()),
        _ => None,
    }
}

/// Coordinates and velocities determine a system of first order; other initial data are refused, not passed over.
fn check_initial_data(model: &Model, system: &System) -> Result<(), StudyError> {
    if system.constraints.iter().any(|c| c.order > 1) {
        return Ok(());
    }
    match model.initial.values.keys().find(|(_, order)| *order > 1) {
        None => Ok(()),
        Some(&(i, order)) => Err(StudyError::UnusedInitialValue {
            name: format!(
                "{}{}",
                model.coordinates[i].name,
                "'".repeat(order as usize)
            ),
        }),
    }
}
