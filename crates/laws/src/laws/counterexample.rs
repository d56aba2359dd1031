//! A refutation is looked at again: double precision must find the stated state admissible and the equations different there.

use super::Subject;
use chetaev_mechanics::Equations;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::rational::to_f64;
use chetaev_symbolic::verdict::{Counterexample, PointValue, Verdict};
use chetaev_symbolic::zero::enclose::EncloseError;
use chetaev_symbolic::{Expr, Graph, Symbol};
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

/// What is wrong with a counterexample.
fn slip(
    subject: &Subject<'_>,
    wrong: &Equations,
    counterexample: &Counterexample,
) -> Option<String> {
    let point: BTreeMap<&str, f64> = counterexample
        .point
        .iter()
        .filter_map(|value| Some((value.name.as_str(), number(value)?)))
        .collect();
    let Some(stated) = counterexample.residual.0.parse::<f64>().ok() else {
        return Some("its residual is no number".to_string());
    };
    let system = subject.cx.system;
    let g = &system.graph;
    let f = &subject.cx.terms.constraints;
    let all: Vec<Expr> = f
        .iter()
        .chain(&subject.routh.accelerations)
        .chain(&wrong.in_natural_state(system, &wrong.accelerations))
        .copied()
        .collect();
    let value = |s: Symbol| Some(point.get(&*g.symbol_text(s)).copied().unwrap_or(ANY));
    let values = match values(g, &all, &value) {
        Ok(values) => values,
        Err(problem) => return Some(problem.to_string()),
    };
    let (f, accelerations) = values.split_at(f.len());
    let speed = point.values().fold(1.0_f64, |m, x| m.max(x.abs()));
    if let Some(f) = f.iter().find(|f| f.abs() > TOLERANCE * speed.powi(4)) {
        return Some(format!("a constraint is {f} at it"));
    }
    let (right, wrong) = accelerations.split_at(system.n());
    let size = accelerations.iter().fold(1.0_f64, |m, a| m.max(a.abs()));
    let largest = right
        .iter()
        .zip(wrong)
        .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    let enough = 0.999 * stated.abs() - TOLERANCE * size;
    (largest < enough).then(|| format!("the accelerations differ by {largest}, not by {stated}"))
}

/// In double precision, or in many more digits where a pivot vanishes by its rounding: cosh(40) beside 1.
fn values(
    g: &Graph,
    es: &[Expr],
    value: &dyn Fn(Symbol) -> Option<f64>,
) -> Result<Vec<f64>, EncloseError> {
    const BITS: usize = 512;
    if let Ok(values) = g.evaluate_f64(es, value) {
        return Ok(values);
    }
    let balls = g.enclose(es, &Precision::new(BITS), &|s| Ball::from_f64(value(s)?))?;
    Ok(balls.iter().map(Ball::to_f64).collect())
}

/// An exact value, or the lower end of an enclosure.
fn number(value: &PointValue) -> Option<f64> {
    match (&value.exact, &value.enclosure) {
        (Some(exact), _) => Some(to_f64(exact)),
        (None, Some((lower, _))) => lower.parse().ok(),
        (None, None) => None,
    }
}
