//! Any formulation with a term forgotten or of the wrong sign, wherever it stands in the rates of its state, is refuted.

use super::numbers::{differ, Size};
use super::rewrite::{all_places, slipped, Slip};
use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::formulation::{derive, REFERENCE};
use chetaev_mechanics::{Equations, FORMULATIONS};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::time::Instant;

/// Terms tried until one makes a difference: some cancel from both sides of a linear system, or vanish on the constraints.
const ATTEMPTS: usize = 8;

/// Every how many systems all formulations are tried.
const ALL_EVERY: u64 = 10;

/// Slips of one form that are tried where it is to be refuted.
const SEVERAL: usize = 4;

/// One forgotten term and one wrong sign, each in a random formulation that applies; now and then in every one.
pub(super) fn slips(subject: &Subject<'_>) -> Vec<Trial> {
    let applicable: Vec<&'static str> = FORMULATIONS
        .iter()
        .map(|f| f.card())
        .filter(|card| card.relation == Relation::Equivalent && card.name != REFERENCE)
        .map(|card| card.name)
        .filter(|name| {
            let found = subject
                .cx
                .finding(&format!("formulation.equivalent#{name}"));
            matches!(found.verdict, Verdict::Proved(_))
        })
        .collect();
    let mut random = Random::stream(subject.seed, 0x0051_1b5a);
    let mut trials = Vec::new();
    for slip in [Slip::Drop, Slip::Flip] {
        if subject.seed.is_multiple_of(ALL_EVERY) {
            let every = applicable.iter();
            trials
                .extend(every.filter_map(|name| one_of_several(subject, name, slip, &mut random)));
        } else if !applicable.is_empty() {
            let name = applicable[random.below(applicable.len() as u64) as usize];
            trials.extend(slip_in(subject, name, slip, &mut random));
        }
    }
    trials
}

/// Slips of one form, so that each form is tried: a wrong equation that is proved, else the first that is refuted.
fn one_of_several(
    subject: &Subject<'_>,
    name: &'static str,
    slip: Slip,
    random: &mut Random,
) -> Option<Trial> {
    let mut last = None;
    for _ in 0..SEVERAL {
        let trial = slip_in(subject, name, slip, random)?;
        // A root that a wrong sign leaves without real states is nowhere defined, and neither true nor false.
        if !matches!(
            trial.verdict,
            Verdict::Undecided { .. } | Verdict::Numerical(_)
        ) {
            return Some(trial);
        }
        last = Some(trial);
    }
    last
}

/// `None` when no slip that was tried changes the accelerations.
fn slip_in(
    subject: &Subject<'_>,
    name: &'static str,
    slip: Slip,
    random: &mut Random,
) -> Option<Trial> {
    let start = Instant::now();
    let system = subject.cx.system;
    let g = &system.graph;
    let right = derive(subject.cx, name).ok()?;
    let found = all_places(g, &right.rates());
    if found.is_empty() {
        return None;
    }
    let (wrong, term) = (0..ATTEMPTS).find_map(|_| {
        let place = found[random.below(found.len() as u64) as usize];
        let wrong = with_rates(subject, &right, &slipped(g, &right.rates(), place, slip));
        let accelerations = wrong.in_natural_state(system, &wrong.accelerations);
        let seen = differ(subject, &accelerations, &subject.routh.accelerations);
        (seen == Size::NotZero).then_some((wrong, place.term))
    })?;
    let verdict = subject.compared(&wrong);
    Some(Trial {
        kind: Kind::Mutant,
        formulation: name,
        law: match slip {
            Slip::Drop => "a forgotten term is found",
            Slip::Flip => "a wrong sign is found",
        },
        about: format!("the term {}", g.text(term)),
        expected: Expected::Refuted,
        verdict,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// The same state with other rates: the accelerations are the rates of the velocities along the flow.
fn with_rates(subject: &Subject<'_>, equations: &Equations, rates: &[Expr]) -> Equations {
    let system = subject.cx.system;
    let mut wrong = equations.clone();
    for (variable, &rate) in wrong.variables.iter_mut().zip(rates) {
        variable.rate = rate;
    }
    let known: Vec<(Symbol, Expr)> = wrong.variables.iter().map(|x| (x.symbol, x.rate)).collect();
    let (velocities, one) = (&wrong.velocities, system.graph.one());
    wrong.accelerations = derive_along(system, velocities, velocities, one, &known);
    wrong
}
