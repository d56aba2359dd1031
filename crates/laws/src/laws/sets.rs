//! States drawn from the sets that `hamilton.stationary` prints: from there the motion and the extremal with the κ(0) printed are
//! one curve, both integrated in double precision. Where the sets are called the only ones, no motion from elsewhere is an extremal: states
//! are drawn off the sets, many of their entries zero, so that other sets and what the equations are divided by are met.

use super::extremals::{Curves, ONE, TWO};
use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::sample::{Generator, Point};
use chetaev_principles::stationarity::{StationarySet, StationarySets};
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// States drawn from each set.
const DRAWN: u64 = 3;
/// Larger values are the neighbourhood of a pole.
const LARGEST: f64 = 20.0;
/// A state is admissible where the constraints are smaller than this.
const ADMISSIBLE: f64 = 1e-9;

/// The trial, where states could be drawn and the curves are clearly one or clearly two.
pub(super) fn drawn(subject: &Subject<'_>) -> Option<Trial> {
    if !subject.cx.system.masses.is_empty() {
        return None;
    }
    from_sets(subject, &StationarySets::of(subject.cx)?)
}

pub(super) fn from_sets(subject: &Subject<'_>, sets: &StationarySets) -> Option<Trial> {
    let curves = Curves::new(subject)?;
    let all = sets.sets.iter().filter_map(|set| {
        let states = (0..DRAWN).filter_map(|draw| state(subject, sets, set, draw));
        let gaps = states.filter_map(|(state, kappa)| curves.gap(&state, &kappa));
        let clear = gaps.filter(|gap| !(ONE..=TWO).contains(gap));
        Some((clear.reduce(f64::max)?, set))
    });
    let (gap, set) = all.max_by(|(a, _), (b, _)| a.total_cmp(b))?;
    let g = &subject.cx.system.graph;
    let equations = set.solved.iter();
    let equations: Vec<String> = equations
        .map(|&(symbol, value)| format!("{} = {}", g.symbol_text(symbol), g.text(value)))
        .collect();
    let place = equations.join(", ");
    let detail = format!("where {place} the curves are {gap:.1e} apart");
    let law = "motion and extremal are one curve from the states printed";
    Some(trial(law, gap < ONE, gap, detail))
}

/// What the distance of motions and extremals tells of a law on their states.
fn trial(law: &'static str, holds: bool, gap: f64, detail: String) -> Trial {
    let verdict = match holds {
        true => Verdict::Proved(Proof::structural("at the states drawn", detail)),
        false => Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "distance of motion and extremal".into(),
            residual: (format!("{gap:e}"), format!("{gap:e}")),
            detail,
        }),
    };
    Trial {
        kind: Kind::Other,
        law,
        formulation: "",
        about: String::new(),
        expected: Expected::Proved,
        verdict,
        seconds: 0.0,
    }
}

/// States drawn beside the sets.
const BESIDE: u64 = 24;
/// Curves of a motion off the sets that are nearer are one.
const SAME: f64 = 1e-11;
/// A state is on a set where what vanishes there is smaller than this.
const ON: f64 = 1e-9;

/// The trial that motions off the sets are no extremals, where the sets are called the only ones.
pub(super) fn beside(subject: &Subject<'_>) -> Option<Trial> {
    if !subject.cx.system.masses.is_empty() {
        return None;
    }
    off_sets(subject, &StationarySets::of(subject.cx)?)
}

pub(super) fn off_sets(subject: &Subject<'_>, sets: &StationarySets) -> Option<Trial> {
    if !sets.complete {
        return None;
    }
    let curves = Curves::new(subject)?;
    let states = (0..BESIDE).filter_map(|draw| off(subject, sets, draw));
    let gaps = states.filter_map(|state| Some((curves.nearest_gap(subject, &state)?, state)));
    let (gap, state) = gaps.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
    let g = &subject.cx.system.graph;
    let place = state
        .iter()
        .map(|(&s, x)| format!("{} = {x}", g.symbol_text(s)));
    let mut place: Vec<String> = place.collect();
    place.sort();
    let detail = format!("at {} the curves are {gap:.1e} apart", place.join(", "));
    let law = "motion and extremal are two curves from states off the sets printed";
    Some(trial(law, gap > SAME, gap, detail))
}

/// An admissible state on none of the sets; `None` where the one drawn is on one.
fn off(subject: &Subject<'_>, sets: &StationarySets, draw: u64) -> Option<Point> {
    let system = subject.cx.system;
    let mut random = Generator::new(subject.seed.wrapping_mul(BESIDE).wrapping_add(draw));
    let mut point = subject.states.first()?.clone();
    let coordinates = system.coordinates.iter();
    for symbol in coordinates
        .map(|c| c.q_symbol)
        .chain(sets.speeds.iter().copied())
    {
        let value = match random.next_u64() % 4 {
            0 => 0.0,
            1 => 0.5,
            // Small motions deviate by high powers of what is small.
            2 => random.between(0.4, 1.0),
            _ => random.between(-1.0, -0.4),
        };
        point.insert(symbol, value);
    }
    let velocities = at(subject, &sets.velocities, &point)?;
    let coordinates = system.coordinates.iter();
    point.extend(coordinates.map(|c| c.v_symbol).zip(velocities));
    let constraints: Vec<Expr> = system.constraints.iter().map(|c| c.f).collect();
    let admissible = at(subject, &constraints, &point)?;
    let is_on = |set: &Vec<Expr>| {
        // What has no value there is no equation of this state.
        let values = at(subject, set, &point);
        values.is_some_and(|values| values.iter().all(|f| f.abs() < ON))
    };
    let is_off = !sets.vanishing.iter().any(is_on);
    (is_off && admissible.iter().all(|f| f.abs() <= ADMISSIBLE)).then_some(point)
}

/// A state of the set with κ(0); `None` where it is near a pole or not defined.
fn state(
    subject: &Subject<'_>,
    sets: &StationarySets,
    set: &StationarySet,
    draw: u64,
) -> Option<(Point, Vec<f64>)> {
    let system = subject.cx.system;
    let mut random = Generator::new(subject.seed.wrapping_mul(DRAWN).wrapping_add(draw));
    let mut point = subject.states.first()?.clone();
    let coordinates = system.coordinates.iter();
    for symbol in coordinates
        .map(|c| c.q_symbol)
        .chain(sets.speeds.iter().copied())
    {
        point.insert(symbol, random.between(-1.0, 1.0));
    }
    let (symbols, values): (Vec<Symbol>, Vec<Expr>) = set.solved.iter().copied().unzip();
    let values = at(subject, &values, &point)?;
    point.extend(symbols.into_iter().zip(values));
    let velocities = at(subject, &sets.velocities, &point)?;
    let coordinates = system.coordinates.iter();
    point.extend(coordinates.map(|c| c.v_symbol).zip(velocities));
    let constraints: Vec<Expr> = system.constraints.iter().map(|c| c.f).collect();
    let violated = |f: &f64| f.abs() > ADMISSIBLE;
    if at(subject, &constraints, &point)?.iter().any(violated) {
        return None;
    }
    let kappa = multipliers(subject, set, &point, &mut random)?;
    Some((point, kappa))
}

/// κ(0): the free multipliers at random, the others by the conditions.
fn multipliers(
    subject: &Subject<'_>,
    set: &StationarySet,
    point: &Point,
    random: &mut Generator,
) -> Option<Vec<f64>> {
    let r = subject.cx.selection.rows.len();
    let mut kappa: Vec<f64> = (0..r)
        .map(|l| match set.pivots.contains(&l) {
            true => 0.0,
            false => random.between(-1.0, 1.0),
        })
        .collect();
    let free = kappa.clone();
    for (condition, &pivot) in set.conditions.iter().zip(&set.pivots) {
        let coefficients = at(subject, &condition.coefficients, point)?;
        let right = at(subject, &[condition.right], point)?[0];
        let known: f64 = coefficients.iter().zip(&free).map(|(c, k)| c * k).sum();
        kappa[pivot] = right - known;
    }
    Some(kappa)
}

/// Values that are defined and not large.
fn at(subject: &Subject<'_>, es: &[Expr], point: &Point) -> Option<Vec<f64>> {
    let value = |s: Symbol| point.get(&s).copied();
    let values = subject.cx.system.graph.evaluate_f64(es, &value).ok()?;
    values.iter().all(|x| x.abs() < LARGEST).then_some(values)
}
