//! The computed motion of a record against the same motion again.

use super::texts::{self, Agreement};
use super::{numbers, Replay, Verified};
use crate::record::{NamedValue, Record, TrajectoryRecord};

/// One line on the motion; none when the record has none.
pub(super) fn compare(record: &Record, replayed: &Record) -> Option<Verified> {
    let (a, b) = match (&record.trajectory, &replayed.trajectory) {
        (Some(a), Some(b)) => (a, b),
        (None, None) => return None,
        (Some(_), None) => return Some(line("recorded", Some("the replay has no motion".into()))),
        (None, Some(_)) => return Some(line("nothing", Some("the motion is left out".into()))),
    };
    let word = if a.finished { "finished" } else { "stopped" };
    let mut verified = line(word, difference(a, b));
    if verified.replay == Replay::Confirmed {
        let version = (record.chetaev != replayed.chetaev).then_some(record.chetaev.as_str());
        verified.replay = statistics(a, b, version);
    }
    Some(verified)
}

fn line(recorded: &str, what: Option<String>) -> Verified {
    Verified {
        claim: "trajectory".into(),
        recorded: recorded.into(),
        replay: what.map_or(Replay::Confirmed, |what| Replay::Numbers { what }),
    }
}

/// How the integrator got there. On one machine the replay takes the same steps. Elementary functions that round otherwise
/// may cost or save a few, and another version may choose its steps by other rules: then it is only remarked.
fn statistics(a: &TrajectoryRecord, b: &TrajectoryRecord, version: Option<&str>) -> Replay {
    let Some((what, in_reach)) = reason(a, b).or_else(|| counts(a, b)) else {
        return Replay::Confirmed;
    };
    match version {
        Some(version) => Replay::Remark {
            what: format!("written by version {version}: {what}"),
        },
        None if !in_reach => Replay::Numbers { what },
        // The replay ends where the run was interrupted, with a step cut to that length.
        None if a.is_interrupted() => Replay::Confirmed,
        None => Replay::Remark {
            what: format!("{what}; another machine may take a few steps more or less"),
        },
    }
}

/// Another reason for the end.
fn reason(a: &TrajectoryRecord, b: &TrajectoryRecord) -> Option<(String, bool)> {
    let differs = texts::compare(&a.reason, &b.reason, 1e-6) == Agreement::Other;
    (differs && !a.is_interrupted())
        .then(|| ("`reason` is not what the replay finds".to_owned(), false))
}

/// The first count that differs, and whether all differ by no more than a few steps.
fn counts(a: &TrajectoryRecord, b: &TrajectoryRecord) -> Option<(String, bool)> {
    let few = few(a.steps.max(b.steps));
    let all = [
        ("steps", a.steps, b.steps, few),
        ("rejected", a.rejected, b.rejected, few),
        ("evaluations", a.evaluations, b.evaluations, 20 * few),
        ("chart_switches", a.chart_switches, b.chart_switches, 1),
    ];
    let (name, x, y, _) = all.iter().find(|(_, x, y, _)| x != y)?;
    let in_reach = all.iter().all(|(_, x, y, most)| x.abs_diff(*y) <= *most);
    Some((format!("`{name}` is {x}, the replay finds {y}"), in_reach))
}

/// Steps that differently rounded functions may cost or save: a fiftieth, and three of a short run.
fn few(steps: u64) -> u64 {
    (steps / 50).max(3)
}

fn difference(a: &TrajectoryRecord, b: &TrajectoryRecord) -> Option<String> {
    let whole = !a.is_interrupted();
    let near = |x: f64, y: f64| (x - y).abs() <= 1e-6 * (1.0 + x.abs());
    let stated = [
        ("formulation", a.formulation != b.formulation),
        ("method", a.method != b.method),
        ("tolerance", a.tolerance != b.tolerance),
        ("t_start", a.t_start != b.t_start),
        ("t_end", whole && a.t_end != b.t_end),
        ("t", !near(a.t, b.t)),
        ("finished", whole && a.finished != b.finished),
        ("rows", whole && a.rows != b.rows),
        (
            "stop_time",
            whole
                && a.stop_time
                    .map(|t| near(t, b.stop_time.unwrap_or(f64::NAN)))
                    == Some(false),
        ),
    ];
    if let Some((name, _)) = stated.iter().find(|(_, changed)| *changed) {
        return Some(format!("`{name}` is not what the replay finds"));
    }
    let accuracy = (1e4 * a.tolerance).max(1e-9);
    states("initial", &a.initial, &b.initial, 1e-12)
        .or_else(|| states("final", &a.last, &b.last, accuracy))
        .or_else(|| events(a, b, accuracy).filter(|_| whole))
        .or_else(|| sizes(&a.drifts, &b.drifts))
        .or_else(|| kept(a, b).filter(|_| whole))
        .or_else(|| {
            let error = numbers(a.global_error, b.global_error)?;
            whole.then(|| format!("global_error {error}"))
        })
}

/// The first event that the replay does not find.
fn events(a: &TrajectoryRecord, b: &TrajectoryRecord, tolerance: f64) -> Option<String> {
    if a.events.len() != b.events.len() {
        let (x, y) = (a.events.len(), b.events.len());
        return Some(format!("`events` has {x} entries, the replay finds {y}"));
    }
    a.events.iter().zip(&b.events).find_map(|(x, y)| {
        let near = (x.t - y.t).abs() <= tolerance * (1.0 + x.t.abs());
        // A function that only touches zero does so at a place known to the root of the rounding.
        let touches = x.zero == "grazing";
        if x.event != y.event || x.zero != y.zero || !(near || touches) {
            return Some(format!(
                "`events`: {} at t = {}, the replay finds {} at t = {}",
                x.event, x.t, y.event, y.t
            ));
        }
        states("events", &x.state, &y.state, tolerance).filter(|_| !touches)
    })
}

/// What of the projection is not what the replay finds: which integrals it kept, and how far it moved the state. How often depends
/// on rounding.
fn kept(a: &TrajectoryRecord, b: &TrajectoryRecord) -> Option<String> {
    let integrals = |of: &TrajectoryRecord| -> Option<Vec<(String, String)>> {
        let all = of.kept.as_ref()?.integrals.iter();
        Some(
            all.map(|i| (i.integral.clone(), i.formula.clone()))
                .collect(),
        )
    };
    if integrals(a) != integrals(b) {
        return Some("`kept` has other integrals than the replay".into());
    }
    let largest = |of: &TrajectoryRecord| Some(of.kept.as_ref()?.largest_change);
    Some(format!(
        "`kept`: largest_change {}",
        numbers(largest(a), largest(b))?
    ))
}

fn states(what: &str, a: &[NamedValue], b: &[NamedValue], tolerance: f64) -> Option<String> {
    if a.len() != b.len() || a.iter().zip(b).any(|(x, y)| x.name != y.name) {
        return Some(format!("`{what}` has other names than the replay"));
    }
    a.iter().zip(b).find_map(|(x, y)| match (x.value, y.value) {
        (None, None) => None,
        (Some(u), Some(v)) if (u - v).abs() <= tolerance * (1.0 + u.abs()) => None,
        (u, v) => {
            let word = |x: Option<f64>| x.map_or("no number".to_owned(), |x| x.to_string());
            Some(format!(
                "`{what}`: {} is {}, the replay finds {}",
                x.name,
                word(u),
                word(v)
            ))
        }
    })
}

fn sizes(a: &[NamedValue], b: &[NamedValue]) -> Option<String> {
    if a.len() != b.len() || a.iter().zip(b).any(|(x, y)| x.name != y.name) {
        return Some("`drifts` has other names than the replay".into());
    }
    a.iter().zip(b).find_map(|(x, y)| {
        Some(format!(
            "drift of {}: {}",
            x.name,
            numbers(x.value, y.value)?
        ))
    })
}
