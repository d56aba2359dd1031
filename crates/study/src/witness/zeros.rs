//! Zeros of a function known at equal steps, with their multiplicities.

/// A least value below this part of those beside it is zero.
const TOUCHES: f64 = 0.02;
/// A last value below this part of the largest is zero.
const AT_END: f64 = 1e-7;
/// Points of the polynomial by which a function is replaced near a zero.
const POINTS: usize = 11;
/// Steps of bisection.
const HALVINGS: usize = 80;

/// Zeros of a function given at equal steps, each as often as its multiplicity, which is at most n: where the sign changes, and
/// where it touches zero. A zero of multiplicity m is one of the derivative m − 1, which is simple: it is located on the polynomial
/// through the values around it.
pub(crate) fn zeros(values: &[(f64, f64)], n: usize) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for j in 1..values.len() {
        let ((t0, a), (t1, b)) = (values[j - 1], values[j]);
        let crossing = (a * b < 0.0).then(|| t0 + (t1 - t0) * a / (a - b));
        let touching = values.get(j + 1).and_then(|&(_, c)| {
            let is_lowest = a * b > 0.0 && b * c > 0.0 && b.abs() <= a.abs() && b.abs() < c.abs();
            let (slope, curvature) = ((c - a) / 2.0, a - 2.0 * b + c);
            let least = b - slope * slope / (2.0 * curvature);
            let touches = is_lowest && least.abs() < TOUCHES * a.abs().max(c.abs());
            touches.then(|| t1 - slope / curvature * (t1 - t0))
        });
        let Some(near) = crossing.or(touching) else {
            continue;
        };
        let least = if crossing.is_some() { 1 } else { 2 };
        let times = multiplicity(values, j, near, least);
        let t = located(values, j, near, times).unwrap_or(near);
        found.extend(std::iter::repeat_n(t, times.min(n.max(least))));
    }
    found
}

/// Whether a function ends at a zero, as far as its values can tell.
pub(super) fn ends_at_zero(values: &[(f64, f64)]) -> bool {
    let largest = values.iter().fold(0.0_f64, |m, (_, x)| m.max(x.abs()));
    values
        .last()
        .is_some_and(|(_, x)| x.abs() < AT_END * largest)
}

/// |value| grows like the power of the distance that the multiplicity says; a crossing has an odd one, a touch an even one.
fn multiplicity(values: &[(f64, f64)], j: usize, t: f64, least: usize) -> usize {
    let after = |k: usize| values.get(j + k).or(values.last()).copied();
    let (Some((x, near)), Some((y, far))) = (after(2), after(4)) else {
        return least;
    };
    // Another crossing as near as that hides the power.
    let following = values.iter().skip(j).take(5);
    if following
        .clone()
        .zip(following.skip(1))
        .any(|(a, b)| a.1 * b.1 < 0.0)
    {
        return least;
    }
    let power = (far / near).abs().ln() / ((y - t) / (x - t)).abs().ln();
    match power.is_finite() {
        // The next number of the same parity.
        true => least + 2 * ((power - least as f64) / 2.0).round().max(0.0) as usize,
        false => least,
    }
}

/// The zero of the derivative `times − 1` nearest to a time, on the polynomial through the points around it.
fn located(values: &[(f64, f64)], j: usize, near: f64, times: usize) -> Option<f64> {
    let count = POINTS.min(values.len());
    let first = j.saturating_sub(count / 2).min(values.len() - count);
    let window = &values[first..first + count];
    let step = values[1].0 - values[0].0;
    let scaled: Vec<(f64, f64)> = window
        .iter()
        .map(|&(t, value)| ((t - near) / step, value))
        .collect();
    let mut coefficients = interpolated(&scaled);
    for _ in 1..times {
        coefficients = coefficients
            .iter()
            .enumerate()
            .skip(1)
            .map(|(power, c)| power as f64 * c)
            .collect();
    }
    let at = |x: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
    // Brackets about the first guess.
    let (mut low, mut high) = [0.25, 0.5, 1.0, 1.5]
        .into_iter()
        .map(|width: f64| (-width, width))
        .find(|&(low, high)| at(low) * at(high) <= 0.0)?;
    for _ in 0..HALVINGS {
        let middle = (low + high) / 2.0;
        match at(low) * at(middle) <= 0.0 {
            true => high = middle,
            false => low = middle,
        }
    }
    Some(near + step * (low + high) / 2.0)
}

/// Coefficients by powers of the polynomial through points, by Newton's divided differences.
fn interpolated(points: &[(f64, f64)]) -> Vec<f64> {
    let mut differences: Vec<f64> = points.iter().map(|(_, value)| *value).collect();
    for order in 1..points.len() {
        for i in (order..points.len()).rev() {
            let span = points[i].0 - points[i - order].0;
            differences[i] = (differences[i] - differences[i - 1]) / span;
        }
    }
    let mut coefficients: Vec<f64> = Vec::new();
    for (difference, (x, _)) in differences.iter().zip(points).rev() {
        // coefficients · (t − x) + difference.
        let mut next = vec![0.0; coefficients.len() + 1];
        for (power, c) in coefficients.iter().enumerate() {
            next[power + 1] += c;
            next[power] -= c * x;
        }
        next[0] += difference;
        coefficients = next;
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::{ends_at_zero, zeros};

    fn sampled(f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        (0..400)
            .map(|j| f64::from(j) * 0.01 + 0.2)
            .map(|t| (t, f(t)))
            .collect()
    }

    #[track_caller]
    fn near(found: &[f64], expected: &[f64], within: f64) {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        let mut pairs = found.iter().zip(expected);
        assert!(pairs.all(|(a, b)| (a - b).abs() < within), "{found:?}");
    }

    #[test]
    fn zeros_with_their_multiplicity() {
        let pi = std::f64::consts::PI;
        near(&zeros(&sampled(|t| t.sin()), 3), &[pi], 1e-12);
        near(&zeros(&sampled(|t| t.sin().powi(2)), 3), &[pi; 2], 1e-11);
        near(&zeros(&sampled(|t| t.sin().powi(3)), 3), &[pi; 3], 1e-9);
        near(&zeros(&sampled(|t| t.sin().powi(2) + 0.1), 3), &[], 0.0);
    }

    #[test]
    fn a_zero_at_the_end() {
        let end = 0.2 + 399.0 * 0.01;
        assert!(ends_at_zero(&sampled(|t| (t - end).sin())));
        assert!(ends_at_zero(&sampled(|t| (t - end).powi(2))));
        assert!(!ends_at_zero(&sampled(|t| (t - end - 1e-3).sin())));
    }

    /// Without symmetry about the zero: e^t (t − √2)^m, and m limited to n.
    #[test]
    fn zeros_of_a_function_without_symmetry() {
        let root = 2.0_f64.sqrt();
        for (m, within) in [(1, 1e-12), (2, 1e-11), (3, 1e-9)] {
            let found = zeros(&sampled(|t| t.exp() * (t - root).powi(m)), 3);
            near(&found, &vec![root; m as usize], within);
        }
        let found = zeros(&sampled(|t| (t - root).powi(3)), 2);
        assert_eq!(found.len(), 2);
    }

    /// Two simple zeros a step and a half apart are two.
    #[test]
    fn zeros_close_together() {
        let (a, b) = (1.503, 1.518);
        near(&zeros(&sampled(|t| (t - a) * (t - b)), 3), &[a, b], 1e-10);
    }
}
