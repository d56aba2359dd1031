//! A refutation is looked at again: the stated state must be found admissible and the equations different there, in double
//! precision or, where that loses every digit, in many more.

use super::digits::{reaches, scientific, State};
use super::Subject;
use chetaev_mechanics::Equations;
use chetaev_symbolic::rational::to_f64;
use chetaev_symbolic::verdict::{Counterexample, PointValue, Verdict};
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// Dependent data are printed to twelve digits.
const TOLERANCE: f64 = 1e-7;
/// For variables on which the difference does not depend.
const ANY: f64 = 0.7;

/// The verdict; a refutation that does not stand is `undecided`, which fails the law.
pub(super) fn looked_at_again(
    subject: &Subject<'_>,
    wrong: &Equations,
    verdict: Verdict,
) -> Verdict {
    let slip = match &verdict {
        Verdict::Refuted(counterexample) => slip(subject, wrong, counterexample),
        _ => None,
    };
    match slip {
        Some(slip) => Verdict::undecided(format!("the counterexample does not stand: {slip}")),
        None => verdict,
    }
}

/// What is wrong with a counterexample, in double precision and, as that may lose every digit, in many more.
fn slip(
    subject: &Subject<'_>,
    wrong: &Equations,
    counterexample: &Counterexample,
) -> Option<String> {
    let Some(stated) = scientific(&counterexample.residual.0) else {
        return Some("its residual is no number".to_string());
    };
    let system = subject.cx.system;
    let wrong = wrong.in_natural_state(system, &wrong.accelerations);
    let slip = slip_in_doubles(subject, &wrong, counterexample)?;
    let state = State {
        subject,
        point: &counterexample.point,
        other: ANY,
    };
    let largest = state.largest_difference(&subject.routh.accelerations, &wrong);
    let stands = largest.is_some_and(|largest| reaches(largest, stated, 0.999));
    (!stands).then_some(slip)
}

/// What double precision finds wrong with a counterexample.
fn slip_in_doubles(
    subject: &Subject<'_>,
    wrong: &[Expr],
    counterexample: &Counterexample,
) -> Option<String> {
    let point: BTreeMap<&str, f64> = counterexample
        .point
        .iter()
        .filter_map(|value| Some((value.name.as_str(), number(value)?)))
        .collect();
    let system = subject.cx.system;
    let g = &system.graph;
    let f = &subject.cx.terms.constraints;
    let all: Vec<Expr> = f
        .iter()
        .chain(&subject.routh.accelerations)
        .chain(wrong)
        .copied()
        .collect();
    let value = |s: Symbol| Some(point.get(&*g.symbol_text(s)).copied().unwrap_or(ANY));
    let values = match g.evaluate_f64(&all, &value) {
        Ok(values) => values,
        Err(problem) => return Some(problem.to_string()),
    };
    let (f, accelerations) = values.split_at(f.len());
    let speed = point.values().fold(1.0_f64, |m, x| m.max(x.abs()));
    if let Some(f) = f.iter().find(|f| f.abs() > TOLERANCE * speed.powi(4)) {
        return Some(format!("a constraint is {f} at it"));
    }
    if !accelerations.iter().all(|a| a.is_finite()) {
        return Some("the accelerations have no value in double precision".to_string());
    }
    let (right, wrong) = accelerations.split_at(system.n());
    let size = accelerations.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
    let largest = right
        .iter()
        .zip(wrong)
        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    let stated = &counterexample.residual.0;
    // A number beyond double precision is infinite, and nothing comes near it.
    let size_stated = stated.parse::<f64>().map_or(f64::INFINITY, f64::abs);
    let enough = 0.999 * size_stated - TOLERANCE * size;
    (largest < enough).then(|| format!("the accelerations differ by {largest}, not by {stated}"))
}

/// An exact value, or the lower end of an enclosure.
fn number(value: &PointValue) -> Option<f64> {
    match (&value.exact, &value.enclosure) {
        (Some(exact), _) => Some(to_f64(exact)),
        (None, Some((lower, _))) => lower.parse().ok(),
        (None, None) => None,
    }
}
