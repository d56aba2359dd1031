//! The computed motion of a record against the same motion again.

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
    Some(line(word, difference(a, b)))
}

fn line(recorded: &str, what: Option<String>) -> Verified {
    Verified {
        claim: "trajectory".into(),
        recorded: recorded.into(),
        replay: what.map_or(Replay::Confirmed, |what| Replay::Numbers { what }),
    }
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
        .or_else(|| sizes(&a.drifts, &b.drifts))
        .or_else(|| {
            let error = numbers(a.global_error, b.global_error)?;
            whole.then(|| format!("global_error {error}"))
        })
}

fn states(what: &str, a: &[NamedValue], b: &[NamedValue], tolerance: f64) -> Option<String> {
    if a.len() != b.len() || a.iter().zip(b).any(|(x, y)| x.name != y.name) {
        return Some(format!("`{what}` has other names than the replay"));
    }
    a.iter().zip(b).find_map(|(x, y)| match (x.value, y.value) {
        (None, None) => None,
        (Some(u), Some(v)) if (u - v).abs() <= tolerance * (1.0 + u.abs()) => None,
        (u, v) => Some(format!(
            "`{what}`: {} is {u:?}, the replay finds {v:?}",
            x.name
        )),
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
