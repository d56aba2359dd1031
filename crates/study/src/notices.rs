//! What a reader must know beside the verdicts.

use crate::kept::{shortened, Kept, LONGEST};
use crate::options::StudyOptions;
use crate::start::{holds, Start};
use crate::study::{keeps, Motion};
use crate::witness::{determinant, gram, zeros};
use chetaev_integrate::Note;
use chetaev_mechanics::claims::formulation::REFERENCE;
use chetaev_mechanics::redundancy::Reactions;
use chetaev_mechanics::words;
use chetaev_mechanics::words::quoted;
use chetaev_mechanics::{choice, Prepared, System};
use chetaev_model::model::{MassLaw, Model};
use chetaev_motion::crossing::Crossing;
use chetaev_motion::initial::branches::describe;
use chetaev_motion::keep::Missed;
use chetaev_motion::observe::Observer;
use chetaev_symbolic::Expr;

/// Holonomic constraints, velocities not used as asked, redundant constraints, completed initial data.
pub(crate) fn notices(
    model: &Model,
    system: &System,
    prepared: &Prepared,
    start: Option<&Start>,
    options: &StudyOptions,
) -> Vec<String> {
    let mut notices = holonomic(model, system);
    notices.extend(choice::unheeded(
        system,
        &prepared.terms,
        &prepared.selection,
    ));
    notices.extend(isotropic(model, system));
    notices.extend(mass_in_potential(model));
    if let Some(start) = start {
        notices.extend(unused_beyond(start));
        notices.extend(redundant(system, prepared, start));
        notices.extend(completed(start));
        notices.extend(branches(system, start));
        notices.extend(unused_branch(model, start, options));
    }
    notices
}

/// Events whose function was not followed everywhere.
pub(crate) fn events_not_followed(model: &Model, motion: &Motion) -> Vec<String> {
    let mut said = Vec::new();
    for note in &motion.evidence.run.notes {
        let (event, t, what) = match *note {
            Note::EventUnknown { t, event, .. } => (event, t, "has no value in a step"),
            Note::EventUnresolved { t, event } => (
                event,
                t,
                "runs faster than thousands of samples of one step show, or consists of rounding, in a step",
            ),
            _ => continue,
        };
        let Some(event) = model.events.get(event) else {
            continue;
        };
        let sentence = format!(
            "the function of event `{}` {what} that begins at t = {t:.6}; zeros may have been missed there",
            event.name
        );
        if !said.contains(&sentence) {
            said.push(sentence);
        }
    }
    said
}

/// That stability, not accuracy, limited the steps.
pub(crate) fn stiffness(motion: &Motion) -> Option<String> {
    let notes = &motion.evidence.run.notes;
    notes.iter().find_map(|note| match *note {
        Note::Stiff { t, steps_ahead, .. } => Some(format!(
            "the problem looks stiff from t = {t:.4} on (about {steps_ahead:.0} more steps); an implicit method would need far fewer"
        )),
        _ => None,
    })
}

/// Integrals that were to be kept along the run and were not, with the first time.
pub(crate) fn integrals_not_kept(
    model: &Model,
    motion: &Motion,
    options: &StudyOptions,
) -> Vec<String> {
    let (run, integrals) = (&motion.evidence.run, &motion.settings.keep);
    match keeps(model, options) {
        false => return Vec::new(),
        true if integrals.is_empty() => {
            return vec!["no first integrals were found that could be kept".into()]
        }
        true => (),
    }
    let Some(kept) = &run.kept else {
        return vec![format!(
            "first integrals are kept in Routh's equations only; those of `{}` are integrated without projection",
            run.formulation
        )];
    };
    let mut said = Vec::new();
    let at = |missed: &Missed| {
        let first = missed.first?;
        let (count, steps) = (missed.count, kept.steps);
        Some(format!(
            "after {count} of {steps} steps, first at t = {first:.6}"
        ))
    };
    if let Some(when) = at(&kept.failed) {
        said.push(format!(
            "no state near the one integrated has the values of the first integrals {when}; the run goes on from the state integrated"
        ));
    }
    let each = Kept::of(motion);
    let each = each.iter().flat_map(Kept::integrals);
    for (missed, (_, integral, _)) in kept.left_out.iter().zip(each) {
        let Some(when) = at(missed) else { continue };
        said.push(format!(
            "the first integral {} could not be kept together with the others {when}",
            shortened(&model.graph, integral.shown)
        ));
    }
    if let Some(first) = kept.between.first {
        said.push(format!(
            "states within steps do not have the values of all first integrals to keep, first at t = {first:.6}"
        ));
    }
    said
}

/// Constraints that contain no velocities.
fn holonomic(model: &Model, system: &System) -> Vec<String> {
    let mut notices = Vec::new();
    for constraint in &system.constraints {
        if constraint.order == 0 {
            let text = model.graph.text(constraint.stated);
            let what = match text.chars().count() <= LONGEST {
                true => text,
                false => "it".into(),
            };
            notices.push(format!(
                "constraint `{}` contains no velocities: it is taken as holonomic, {what} is kept on the initial level and differentiated once for the reaction",
                constraint.name,
            ));
        }
    }
    notices
}

/// A stated kinetic energy with masses that vary, of which nothing more is said.
fn isotropic(model: &Model, system: &System) -> Option<String> {
    let g = &system.graph;
    let computed = model.inertia_by_masses.is_some()
        && model.particles.is_empty()
        && model.reactive_forces.is_none()
        && system.reactive_forces.iter().any(|&e| !g.is_zero(e));
    computed.then(|| {
        "the masses in the kinetic energy change isotropically: what leaves or arrives has the velocity of its body and pushes nothing; state [reactive_forces] where that is not meant".to_owned()
    })
}

/// A potential with a mass that depends on the coordinates: its gradient is not the force on that mass.
fn mass_in_potential(model: &Model) -> Option<String> {
    let (g, potential) = (&model.graph, model.potential?);
    let coordinates: Vec<Expr> = model.coordinates.iter().map(|c| c.symbol).collect();
    let moves = |e: Expr| {
        let symbols = g.symbols_in(&[e]);
        symbols
            .into_iter()
            .any(|s| coordinates.contains(&g.symbol(g.symbol_name(s), 0)))
    };
    let named = model.masses.iter().find_map(|mass| match mass.law {
        MassLaw::Value(value) if moves(value) && g.reachable(&[potential]).contains(&value) => {
            Some(&mass.name)
        }
        _ => None,
    })?;
    Some(format!(
        "the potential contains the mass `{named}`, which depends on the coordinates: its gradient contains the slope of the mass, which is no force on it; state the force on the particle where that is not meant"
    ))
}

/// Initial values of multipliers that the state determines: all of them but those of the constrained extremum, where it is computed or
/// the index of the motion with them was.
pub(crate) fn unused_multipliers(
    model: &Model,
    prepared: &Prepared,
    options: &StudyOptions,
    motion: Option<&Motion>,
) -> Option<String> {
    if prepared.terms.order != 1 {
        return None;
    }
    let formulation = options.formulation.as_deref().unwrap_or(REFERENCE);
    let conjugate = motion.and_then(|motion| motion.witness.conjugate.as_ref());
    let with_index = conjugate.is_some_and(|found| !found.given.is_empty());
    let extremum = formulation == "vakonomic" || options.extremum.is_some() || with_index;
    let is_used = |name: &str| extremum && name.starts_with("kappa_");
    let names: Vec<String> = model
        .initial
        .extra
        .iter()
        .filter(|own| own.order > 0 || !is_used(&own.name))
        .map(|own| format!("`{}{}`", own.name, "'".repeat(own.order as usize)))
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "initial values not used: {}; {}",
            names.join(", "),
            match extremum {
                true => "the constrained extremum has the multipliers κ of the constraints and no others",
                false => "the state determines the multipliers in every formulation but `vakonomic`, which takes κ, as does `witness.index` where κ is not unique",
            }
        )
    })
}

/// Initial values of multipliers under constraints of higher order that the other data determine.
fn unused_beyond(start: &Start) -> Option<String> {
    let unused = &start.start.jets.as_ref()?.unused;
    (!unused.is_empty()).then(|| {
        format!(
            "initial values not used: {}; the other initial data determine them",
            quoted(unused)
        )
    })
}

/// Constraints that depend on the others where the motion begins.
fn redundant(system: &System, prepared: &Prepared, start: &Start) -> Option<String> {
    let names = &start.start.redundant;
    if names.is_empty() {
        return None;
    }
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let reactions = Reactions::of(system, terms, selection);
    let single: Vec<String> = (reactions.undetermined.iter())
        .map(|&row| {
            format!(
                "lambda_{}",
                system.constraints[terms.constraint_index[row]].name
            )
        })
        .collect();
    let texts = reactions.texts(system).into_iter().map(|(text, _)| text);
    let texts: Vec<String> = texts.collect();
    let what = if texts.is_empty() {
        "combinations of them are".to_owned()
    } else {
        format!(
            "{} {}",
            texts.join(", "),
            if texts.len() == 1 { "is" } else { "are" }
        )
    };
    Some(format!(
        "redundant constraints: {} depend{} on the others at the initial state (rank {} of {}); motion and reactions are unique, the single multipliers {} are not determined, and are not given; {what} determined",
        quoted(names),
        if names.len() == 1 { "s" } else { "" },
        start.start.chart.rank(),
        start.numeric.r,
        single.join(", "),
    ))
}

/// Initial data that the constraints determine.
fn completed(start: &Start) -> Option<String> {
    let jets = start.start.jets.iter().flat_map(|jets| &jets.completed);
    let free: Vec<String> = start
        .start
        .completed
        .iter()
        .chain(jets)
        .map(|(name, value)| format!("{name} = {value}"))
        .collect();
    let how = if start.data.project {
        "projected on"
    } else {
        "completed from"
    };
    (!free.is_empty()).then(|| format!("initial data {how} the constraints: {}", free.join(", ")))
}

/// The branches of the motion where the constraints are nonlinear in the highest derivatives.
fn branches(system: &System, start: &Start) -> Option<String> {
    let jets = start.start.jets.as_ref()?;
    if jets.branches.len() < 2 {
        return None;
    }
    let each = jets.branches.iter().enumerate();
    let listed: Vec<String> = each.map(|(i, b)| describe(system, i, b)).collect();
    Some(format!(
        "the constraints admit {} branches of the motion at the start, of which number {} is followed: {}",
        listed.len(),
        jets.taken + 1,
        listed.join(" | ")
    ))
}

/// A branch that is asked for where there is one motion only.
fn unused_branch(model: &Model, start: &Start, options: &StudyOptions) -> Option<String> {
    let wanted = options.branch.or(model.initial.branch)?;
    let (found, taken) = match &start.start.jets {
        Some(jets) => (jets.branches.len(), jets.taken + 1),
        None => (0, 0),
    };
    if found < 2 {
        return Some(format!(
            "branch {wanted} is asked for and not used: the constraints admit one motion from the initial data"
        ));
    }
    (taken != wanted).then(|| {
        format!("branch {wanted} is asked for and not used: the derivatives given lie on branch {taken}")
    })
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
    let own = &motion.evidence.run.own;
    let observer = Observer::with_own(system, &prepared.terms, &motion.binding, own, &differences);
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
                "the motion leaves the assumption `{}` at t = {}: what is proved under it says nothing of the motion from there on",
                assumption.text,
                words::number(run.times[j])
            ))
        })
        .collect()
}

/// Masses that are negative where the motion begins; those that vanish later stop it, and those with a law of their own
/// begin above zero.
pub(crate) fn negative_masses(
    system: &System,
    prepared: &Prepared,
    motion: &Motion,
) -> Option<String> {
    let named = system.mass_functions.iter();
    let named = named.map(|(name, value)| (format!("`{name}`"), *value));
    let particles = system.particles.iter();
    let masses: Vec<(String, Expr)> = named
        .chain(particles.map(|p| (format!("the mass of `{}`", p.name), p.mass)))
        .collect();
    let values: Vec<Expr> = masses.iter().map(|(_, value)| *value).collect();
    let run = &motion.evidence.run;
    let observer = Observer::with_own(system, &prepared.terms, &motion.binding, &run.own, &values);
    let series = observer.ok()?.along(run);
    let negative: Vec<String> = masses
        .iter()
        .zip(series)
        .filter_map(|((name, _), values)| {
            let first = values.first().filter(|m| **m < 0.0)?;
            Some(format!("{name} = {first}"))
        })
        .collect();
    (!negative.is_empty()).then(|| {
        format!(
            "negative at the start: {}; a body of negative mass is accelerated against the force",
            negative.join(", ")
        )
    })
}

/// More constraints are not looked at.
const MOST_CONSTRAINTS: usize = 8;
/// At most so many times are written.
const MOST_TIMES: usize = 4;

/// Times at which gradients of the constraints become dependent along the motion although it goes on: the squared volume of the
/// gradients, each of unit length, touches zero. Where one gradient vanishes the run has stopped.
pub(crate) fn rank_falls(system: &System, prepared: &Prepared, motion: &Motion) -> Option<String> {
    let (rows, n) = (&prepared.selection.rows, system.n());
    let r = rows.len();
    if let Some(said) = crossings(&motion.evidence.run.crossings) {
        return Some(said);
    }
    if prepared.terms.order != 1 || !(2..=MOST_CONSTRAINTS).contains(&r) {
        return None;
    }
    let gradients = rows.iter().flat_map(|&row| &prepared.terms.jacobian[row]);
    let gradients: Vec<Expr> = gradients.copied().collect();
    let run = &motion.evidence.run;
    let binding = &motion.binding;
    let mut observer =
        Observer::with_own(system, &prepared.terms, binding, &run.own, &gradients).ok()?;
    let values = (0..run.asked()).map(|j| {
        let entries = observer.at(run.times[j], run.row(j));
        let volume = squared_volume(&entries, (r, n));
        volume.is_finite().then_some((run.times[j], volume))
    });
    let values: Vec<(f64, f64)> = values.collect::<Option<_>>()?;
    let mut times = zeros(&values, 2);
    times.dedup();
    let shown: Vec<String> = times
        .iter()
        .take(MOST_TIMES)
        .map(|t| format!("{t:.6}"))
        .collect();
    let more = if times.len() > MOST_TIMES {
        ", …"
    } else {
        ""
    };
    (!times.is_empty()).then(|| {
        format!(
            "the rank of the constraints falls at t = {}{more}: there the gradients of {r} constraints are dependent, and the constraints admit more velocities than elsewhere; the motion computed is the one that passes smoothly, and is not the only one",
            shown.join(", ")
        )
    })
}

/// On which component of constraints that are products the motion was computed.
pub(crate) fn component(motion: &Motion) -> Option<String> {
    let on = motion.component.as_ref()?;
    Some(format!(
        "the motion starts on the component {on}, and on no other: it is computed there, and the multipliers are those of the constraints as stated"
    ))
}

/// Places at which the rank falls and the motion went on: along the one branch that contains its velocity, or as the model asks.
fn crossings(crossings: &[Crossing]) -> Option<String> {
    let passed = |c: &&Crossing| c.onto.is_none();
    let passed: Vec<&Crossing> = crossings.iter().filter(passed).collect();
    let mut said = Vec::new();
    if let Some(first) = passed.first() {
        let shown = passed.iter().take(MOST_TIMES);
        let shown: Vec<String> = shown.map(|c| words::precise_number(c.t)).collect();
        let more = if passed.len() > MOST_TIMES {
            format!(", … ({} times)", passed.len())
        } else {
            String::new()
        };
        let (from, to) = first.rank;
        said.push(format!(
            "the rank of the constraints falls at t = {}{more}, from {from} to {to}: branches of the constraint set meet there; exactly one branch of the tangent cone contains the velocity, and simply, and the motion goes on along it, with the velocity unchanged",
            shown.join(", ")
        ));
    }
    let chosen = crossings
        .iter()
        .filter_map(|c| Some((c.t, c.onto.as_ref()?)));
    said.extend(chosen.take(MOST_TIMES).map(|(t, onto)| {
        let at = words::precise_number(t);
        format!(
            "at t = {at} two components of a constraint contain the velocity, and the motion is not determined: it goes on along {onto}, as `crossings` says"
        )
    }));
    (!said.is_empty()).then(|| said.join("; "))
}

/// Entries of `crossings` for which the motion met no place.
pub(crate) fn unused_crossings(motion: &Motion) -> Option<String> {
    let taken = motion.evidence.run.crossings.iter();
    let taken = taken.filter(|c| c.onto.is_some()).count();
    let stated = &motion.settings.crossings;
    let unused: Vec<String> = stated
        .iter()
        .skip(taken)
        .map(|(text, _)| format!("`{text}`"))
        .collect();
    (!unused.is_empty()).then(|| {
        format!(
            "{} of `crossings` was not needed: the motion goes on from {} at which it is not determined",
            unused.join(", "),
            words::counted(taken, "place", "places")
        )
    })
}

/// The squared volume of r rows of n numbers, each over its length.
fn squared_volume(entries: &[f64], (r, n): (usize, usize)) -> f64 {
    let unit = entries.chunks(n).flat_map(|row| {
        let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        row.iter().map(move |x| x / length)
    });
    let unit: Vec<f64> = unit.collect();
    determinant(r, &gram(&unit, r, n))
}
