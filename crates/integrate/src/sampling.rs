//! Where a switching function is looked at inside one step: at fixed places, and closer where these do not show how it
//! runs.

/// Distance from the ends of a step (in units of its length) at which the slope of a switching function is sampled.
pub(crate) const NEAR: f64 = 1e-5;

/// Places in an interval at which the polynomial through the eighths is checked; no oscillation is in step with both.
const CHECKS: [f64; 2] = [0.0573, 0.6847];

/// Scaled times at which switching functions are sampled: the eighths, beside the ends, and the checks.
pub(crate) const NODES: [f64; 13] = [
    0.0,
    NEAR,
    CHECKS[0],
    0.125,
    0.25,
    0.375,
    0.5,
    0.625,
    CHECKS[1],
    0.75,
    0.875,
    1.0 - NEAR,
    1.0,
];

/// Values at the nodes.
pub(crate) type Samples = [f64; NODES.len()];

/// Part of the largest value by which the polynomial may miss the checks.
const CLOSE: f64 = 1e-3;

/// Values below this part of the largest ever seen are rounding.
const ROUNDING: f64 = 1e-13;

/// Shortest interval that is divided, in units of the step: a jump is looked at as closely as this.
const SHORTEST: f64 = 1.0 / 4096.0;

/// A branch beside a kink is at most so many times as steep as it is between the samples next to it.
const KINK: f64 = 1.5;

/// A function is so many times as large at a tenth of the distance to a pole: that of order 1/3 is twice as large, at a jump it stays.
const POLE: f64 = 1.5;

/// Further values in one step; a function that needs more is not followed.
const MOST: usize = 8192;

/// Beginning and distance of the places that tell rounding from a fast oscillation.
const NOISE: (f64, f64) = (0.4321, 1e-6);

/// An interval with the values at its ends, quarters and middle.
struct Interval {
    start: f64,
    length: f64,
    quarters: [f64; 5],
}

/// Writes places and values in ascending order into `points`: the nodes, and more where the polynomial of degree eight
/// through the eighths of an interval misses the function at the checks. Says whether the function is shown by them.
///
/// # Errors
/// The first failure of `value`.
pub(crate) fn refine<E>(
    points: &mut Vec<(f64, f64)>,
    nodes: &Samples,
    largest: f64,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<bool, E> {
    points.clear();
    points.extend(NODES.into_iter().zip(nodes.iter().copied()));
    let [a, _, first, b, c, d, e, f, second, g, h, _, i] = *nodes;
    let eighths = [a, b, c, d, e, f, g, h, i];
    let floor = ROUNDING * largest;
    if is_shown(&eighths, [first, second], floor) {
        return Ok(true);
    }
    if is_noise(&eighths, &mut value)? {
        return Ok(false);
    }
    let mut left = Vec::from(halves(0.0, 1.0, &eighths));
    let mut spent = 0;
    while let Some(interval) = left.pop() {
        let Interval { start, length, .. } = interval;
        let mut at = |fraction: f64| {
            let theta = start + fraction * length;
            let found = value(theta)?;
            points.push((theta, found));
            Ok(found)
        };
        let mut eighths = [0.0; 9];
        for (k, eighth) in eighths.iter_mut().enumerate() {
            *eighth = match k % 2 {
                0 => interval.quarters[k / 2],
                _ => at(k as f64 / 8.0)?,
            };
        }
        let checks = [at(CHECKS[0])?, at(CHECKS[1])?];
        spent += 6;
        if is_shown(&eighths, checks, floor) || length <= SHORTEST {
            continue;
        }
        if spent >= MOST {
            points.sort_by(|x, y| x.0.total_cmp(&y.0));
            return Ok(false);
        }
        left.extend(halves(start, length, &eighths));
    }
    points.sort_by(|x, y| x.0.total_cmp(&y.0));
    Ok(true)
}

/// Appends to `places` those at which [`refine`] looks at an interval of the step; says whether the function is shown by them.
///
/// # Errors
/// The first failure of `value`.
pub(crate) fn refine_within<E>(
    (start, end): (f64, f64),
    largest: f64,
    mut value: impl FnMut(f64) -> Result<f64, E>,
    places: &mut Vec<f64>,
) -> Result<bool, E> {
    let mut at = |place: f64| value(start + (end - start) * place);
    let mut nodes = [0.0; NODES.len()];
    for (value, place) in nodes.iter_mut().zip(NODES) {
        *value = at(place)?;
    }
    let mut points = Vec::new();
    let is_shown = refine(&mut points, &nodes, largest, at)?;
    places.extend(
        points
            .iter()
            .map(|(place, _)| start + (end - start) * place),
    );
    Ok(is_shown)
}

/// Writes the nodes and further places, none given twice, with their values in ascending order into `points`; `largest` is the
/// largest magnitude of the function before this step.
///
/// # Errors
/// The first failure of `value`.
pub(crate) fn at_places<E>(
    points: &mut Vec<(f64, f64)>,
    nodes: &Samples,
    (places, largest): (&[f64], f64),
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(), E> {
    points.clear();
    points.extend(NODES.into_iter().zip(nodes.iter().copied()));
    for &place in places.iter().filter(|place| !NODES.contains(place)) {
        let found = value(place)?;
        // The sign of what is nothing but rounding says nothing.
        let size = largest.max(size_around(nodes, (place, place)));
        if found.abs() > 64.0 * f64::EPSILON * size {
            points.push((place, found));
        }
    }
    points.sort_by(|x, y| x.0.total_cmp(&y.0));
    Ok(())
}

/// The two halves of an interval with these values at its eighths, the first one last, to be taken first.
fn halves(start: f64, length: f64, eighths: &[f64; 9]) -> [Interval; 2] {
    let half = |from: usize| Interval {
        start: start + length * from as f64 / 8.0,
        length: length / 2.0,
        quarters: std::array::from_fn(|k| eighths[from + k]),
    };
    [half(4), half(0)]
}

/// Whether the polynomial through values at the eighths meets the values at the checks.
fn is_shown(eighths: &[f64; 9], checks: [f64; 2], floor: f64) -> bool {
    let largest = eighths.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let allowed = CLOSE * largest.max(checks[0].abs()).max(checks[1].abs()).max(floor);
    let mut both = CHECKS.into_iter().zip(checks);
    both.all(|(place, value)| (interpolated(eighths, place) - value).abs() <= allowed)
}

/// The polynomial through values at the eighths, by the barycentric formula (J.-P. Berrut, L. N. Trefethen 2004, SIAM Review
/// 46, 501–517, (4.2) and (5.1)).
fn interpolated(eighths: &[f64; 9], place: f64) -> f64 {
    const WEIGHTS: [f64; 9] = [1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0, 1.0];
    let (mut above, mut below) = (0.0, 0.0);
    for (k, (value, weight)) in eighths.iter().zip(WEIGHTS).enumerate() {
        let part = weight / (place - k as f64 / 8.0);
        above += part * value;
        below += part;
    }
    above / below
}

/// Whether values at three places close together have nothing to do with each other.
fn is_noise<E>(
    eighths: &[f64; 9],
    value: &mut impl FnMut(f64) -> Result<f64, E>,
) -> Result<bool, E> {
    let (start, apart) = NOISE;
    let [a, b, c] = [
        value(start)?,
        value(start + apart)?,
        value(start + 2.0 * apart)?,
    ];
    let largest = eighths.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    Ok((a - 2.0 * b + c).abs() > 0.05 * largest)
}

/// Whether three samples on one side have their least magnitude in the middle, and the function may come near zero between them:
/// by the parabola through them, or by a kink, where the branch on either side runs on as it does between two samples.
pub(crate) fn dips(points: &[(f64, f64)], side: f64) -> bool {
    let [a, b, c] = [points[0].1 * side, points[1].1 * side, points[2].1 * side];
    let x = [points[0].0, points[1].0, points[2].0];
    // One comparison is strict, so that two equal samples make one dip and not two.
    if b < 0.0 || b > a || b >= c || a == 0.0 {
        return false;
    }
    let left = (a - b) / (x[1] - x[0]);
    let right = (c - b) / (x[2] - x[1]);
    let kink = (left * (x[2] - x[1])).max(right * (x[1] - x[0]));
    b - KINK * kink <= 0.5 * b
}

/// Part of the largest value early in a step below which values at its start are nothing but rounding, and the places that are
/// early: a function that grows by orders of magnitude along the step is large at its end alone.
const EARLY: usize = 3;

/// The largest magnitude at the beginning of ascending places of a step.
pub(crate) fn early_size(points: &[(f64, f64)]) -> f64 {
    let most = NODES[EARLY];
    let early = points.iter().take_while(|(place, _)| *place <= most);
    early.fold(0.0, |largest, (_, value)| largest.max(value.abs()))
}

/// The largest magnitude at the nodes around an interval.
pub(crate) fn size_around(nodes: &Samples, (start, end): (f64, f64)) -> f64 {
    let first = NODES
        .partition_point(|&node| node <= start)
        .saturating_sub(1);
    let last = NODES
        .partition_point(|&node| node < end)
        .min(NODES.len() - 1);
    let around = &nodes[first..=last.max(first)];
    around
        .iter()
        .fold(0.0, |largest, value| largest.max(value.abs()))
}

/// Whether a change of sign is a pole: on both sides the function is larger closer to it. The value at a place beside it; where
/// there is none, it is infinite.
pub(crate) fn is_pole(theta: f64, apart: f64, mut value: impl FnMut(f64) -> f64) -> bool {
    [-apart, apart].into_iter().all(|apart| {
        let [close, far] = [apart, 10.0 * apart].map(|apart| value(theta + apart).abs());
        close > POLE * far
    })
}

/// Whether a function with these values at the end of the step and at a distance before it vanishes within `slack` of the
/// end, which is the end of the run.
pub(crate) fn ends_on_zero(end: f64, (distance, before): (f64, f64), slack: f64) -> bool {
    let fall = before - end;
    end == 0.0 && before != 0.0
        || end * before > 0.0 && (end / fall) * distance <= slack && end / fall >= 0.0
}

/// Whether a zero at the end of the run, with these values at once and twice a small distance before it, is a touch.
pub(crate) fn ends_on_touch([once, twice]: [f64; 2]) -> bool {
    once * twice > 0.0 && twice.abs() > 3.0 * once.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Places, how often the function was asked beyond the nodes, and whether it is shown.
    fn looked(f: impl Fn(f64) -> f64) -> (Vec<(f64, f64)>, usize, bool) {
        let (mut points, mut calls) = (Vec::new(), 0);
        let shown = refine(&mut points, &NODES.map(&f), 1.0, |x| {
            calls += 1;
            Ok::<f64, Infallible>(f(x))
        });
        let ascending = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        assert!(ascending, "places ascend, none twice");
        assert!(points.iter().all(|&(x, y)| y == f(x)));
        (points, calls, shown.unwrap())
    }

    /// A polynomial of degree eight is met wherever it is looked at.
    #[test]
    fn interpolation_is_exact_for_degree_eight() {
        let f = |x: f64| (0..=8).fold(0.0, |sum, k| sum * x + f64::from(k - 3));
        let eighths = std::array::from_fn(|k| f(k as f64 / 8.0));
        for place in CHECKS {
            let found = interpolated(&eighths, place);
            assert!((found - f(place)).abs() < 1e-12, "{found}");
        }
    }

    #[test]
    fn smooth_functions_cost_nothing_more() {
        let smooth: [fn(f64) -> f64; 4] = [
            |x| (3.0 * x).sin(),
            |x| (x - 0.3).powi(2),
            |x| x.exp() - 2.0,
            |_| 0.0,
        ];
        for f in smooth {
            let (points, calls, shown) = looked(f);
            assert!(shown && calls == 0 && points.len() == NODES.len());
        }
    }

    /// An oscillation is followed: between two of its zeros lie several places, also where the eighths of the step are in
    /// step with it.
    #[test]
    fn fast_oscillations_are_followed() {
        for frequency in [60.0, 2000.0, 16.0 * std::f64::consts::PI, 1999.0 * 8.0] {
            let f = |x: f64| (frequency * x + 0.3).sin();
            let (points, _, shown) = looked(f);
            let changes = points.windows(2).filter(|p| p[0].1 * p[1].1 < 0.0).count();
            let turns = |x: f64| ((frequency * x + 0.3) / std::f64::consts::PI).floor();
            assert_eq!(shown, frequency < 1e4, "{frequency}");
            assert!(!shown || changes == turns(1.0) as usize, "{frequency}");
        }
    }

    #[test]
    fn jumps_and_rounding_do_not_take_for_ever() {
        let (_, calls, shown) = looked(|x| if x < 0.337 { -1.0 } else { 1.0 });
        assert!(shown && calls < 200, "{calls}");
        // A function of nothing but rounding.
        let (_, calls, shown) = looked(|x| ((1e9 * x).sin() * 1e5).fract() * 1e-17);
        assert!(!shown || calls == 0, "{calls}");
    }
}
