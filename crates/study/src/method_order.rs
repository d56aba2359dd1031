//! The observed order of a method on a model: a piece of the motion by fixed steps of decreasing size.

use crate::options::Hooks;
use chetaev_motion::{Run, RunSettings, StateKind, Subject};

/// Observed order of convergence at fixed steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    /// Step sizes.
    pub steps: Vec<f64>,
    /// Largest error at the end of the interval for each.
    pub errors: Vec<f64>,
    /// Slope of the errors that lie above round-off; none where fewer than three do or they do not fall regularly.
    pub observed: Option<f64>,
    /// Largest difference of the slopes between neighbouring step sizes.
    pub spread: f64,
    /// Nominal order.
    pub nominal: f64,
}

/// Numbers of steps over the piece; the last gives the reference.
const COUNTS: [u32; 6] = [4, 6, 8, 12, 16, 40];
/// Slopes that differ by more do not show an order.
const REGULAR: f64 = 2.5;
/// Pieces tried, each shorter than the one before.
const PIECES: i32 = 20;

/// Fixed steps of decreasing size over a short piece at the start of the run, against a finer one. The piece is shortened
/// until the errors fall regularly above round-off. All velocities are integrated, so that charts do not matter.
pub(crate) fn observed_order(
    subject: &Subject<'_>,
    settings: &RunSettings,
    run: &Run,
    hooks: &mut Hooks<'_>,
) -> Option<Orders> {
    let nominal =
        chetaev_integrate::method(&settings.method).map_or(8.0, |m| f64::from(m.card().order));
    let span = run.t - subject.start.t;
    if span == 0.0 || !span.is_finite() {
        return None;
    }
    let average = span / run.statistics.steps.max(1) as f64;
    let mut best: Option<Orders> = None;
    for piece in 0..PIECES {
        (hooks.progress)("measuring the order of the method", None);
        let longest = (64.0 * average).abs().min(span.abs());
        let length = longest * span.signum() * 0.75f64.powi(piece);
        let fixed = RunSettings {
            t_end: subject.start.t + length,
            times: vec![subject.start.t + length],
            state: StateKind::Full,
            ..settings.clone()
        };
        let finals: Option<Vec<Vec<f64>>> = COUNTS
            .iter()
            .map(|&count| subject.routh_fixed(&fixed, (length / f64::from(count)).abs()))
            .collect();
        let Some(finals) = finals else { continue };
        let found = orders(&finals, length, nominal);
        if best.as_ref().is_none_or(|b| found.spread < b.spread) {
            best = Some(found);
        }
        if best.as_ref().is_some_and(|b| b.spread < 0.7) {
            break;
        }
    }
    best
}

fn orders(finals: &[Vec<f64>], length: f64, nominal: f64) -> Orders {
    let reference = &finals[finals.len() - 1];
    let mut steps = Vec::new();
    let mut errors = Vec::new();
    for (result, &count) in finals.iter().zip(&COUNTS).take(finals.len() - 1) {
        let error = result
            .iter()
            .zip(reference)
            .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs() / (1.0 + b.abs())));
        steps.push((length / f64::from(count)).abs());
        errors.push(error);
    }
    let logs: Vec<(f64, f64)> = steps
        .iter()
        .zip(&errors)
        .filter(|(_, &error)| error > 2e-13 && error < 1e-2)
        .map(|(h, error)| (h.ln(), error.ln()))
        .collect();
    let slopes: Vec<f64> = logs
        .windows(2)
        .map(|w| (w[0].1 - w[1].1) / (w[0].0 - w[1].0))
        .collect();
    // From the coarsest steps on, as far as the errors fall regularly: beyond is the rounding of the equations themselves.
    let regular = slopes
        .iter()
        .take_while(|&&slope| (slope - slopes[0]).abs() <= REGULAR)
        .count();
    let (slopes, logs) = (&slopes[..regular], &logs[..logs.len().min(regular + 1)]);
    let extreme = |start: f64, pick: fn(f64, f64) -> f64| slopes.iter().copied().fold(start, pick);
    let spread = match regular {
        0 | 1 => f64::INFINITY,
        _ => extreme(f64::NEG_INFINITY, f64::max) - extreme(f64::INFINITY, f64::min),
    };
    Orders {
        // The finest steps are nearest to the limit in which the order is defined.
        observed: (spread <= REGULAR).then(|| slope(&logs[logs.len().saturating_sub(3)..])),
        steps,
        errors,
        spread,
        nominal,
    }
}

/// The slope of the straight line of least squares.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (mx, my) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (mut xy, mut xx) = (0.0, 0.0);
    for (x, y) in points {
        xy += (x - mx) * (y - my);
        xx += (x - mx) * (x - mx);
    }
    xy / xx
}
