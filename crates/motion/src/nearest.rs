//! Of several solutions of the constraints the one nearest to where the search began.

use chetaev_mechanics::sample::Generator;

/// Steps towards the nearest solution.
pub(crate) const DRAWS: usize = 50;

/// The movable components that occur in the constraints: varying others would only make them differ from what is given.
pub(crate) fn both(movable: &[usize], occurring: &[bool]) -> Vec<usize> {
    movable.iter().copied().filter(|&i| occurring[i]).collect()
}

/// The solution nearest to a start, among those offered, by the kinetic metric at the start.
pub(crate) struct Nearest<'a> {
    start: &'a [f64],
    metric: &'a [f64],
    distance: f64,
    pub(crate) found: Option<Vec<f64>>,
}

impl<'a> Nearest<'a> {
    pub(crate) fn to(start: &'a [f64], metric: &'a [f64]) -> Nearest<'a> {
        Nearest {
            start,
            metric,
            distance: f64::INFINITY,
            found: None,
        }
    }

    pub(crate) fn offer(&mut self, x: &[f64]) {
        let away: Vec<f64> = x.iter().zip(self.start).map(|(a, b)| a - b).collect();
        let distance = length(&away, self.metric);
        // Equally near ones differ by rounding, which must not choose between them.
        if self.found.is_none() || distance < self.distance * (1.0 - 1e-9) {
            self.distance = distance;
            self.found = Some(x.to_vec());
        }
    }
}

/// `sqrt(xᵀ M x)`, with the masses for x behind the coordinates left out.
fn length(x: &[f64], metric: &[f64]) -> f64 {
    let n = metric.len().isqrt();
    let rows = metric.chunks(n.max(1)).zip(x);
    let of_row = |row: &[f64]| row.iter().zip(x).map(|(m, x)| m * x).sum::<f64>();
    let square: f64 = rows.map(|(row, x)| x * of_row(row)).sum();
    square.max(0.0).sqrt()
}

/// Half-way from x to the solution of `f + J (y - x) = 0` with the least change from `start`.
pub(crate) fn draw(
    x: &mut [f64],
    start: &[f64],
    (jacobian, f): (&[f64], &[f64]),
    least: impl Fn(&[f64]) -> Vec<f64>,
) {
    let away: Vec<f64> = x.iter().zip(start).map(|(a, b)| a - b).collect();
    let wanted: Vec<f64> = jacobian
        .chunks(x.len())
        .zip(f)
        .map(|(row, f)| row.iter().zip(&away).map(|(j, d)| j * d).sum::<f64>() - f)
        .collect();
    for ((x, start), step) in x.iter_mut().zip(start).zip(least(&wanted)) {
        *x = (*x + start + step) / 2.0;
    }
}

/// Moves the movable components by up to their reach and their own size.
pub(crate) fn perturb(x: &mut [f64], movable: &[usize], reach: &[f64], generator: &mut Generator) {
    for &i in movable {
        x[i] += generator.between(-1.0, 1.0) * (reach[i] + x[i].abs());
    }
}

/// How far from x solutions are looked for: by the size of x and of the first step towards them, the same for all components in the metric
/// of the masses on the diagonal.
pub(crate) fn reach(x: &[f64], step: &[f64], metric: &[f64]) -> Vec<f64> {
    let n = metric.len().isqrt();
    let root = |i: usize| match metric[i * n + i].abs().sqrt() {
        root if root > 0.0 && root.is_finite() => root,
        _ => 1.0,
    };
    let sizes = (0..n).map(|i| root(i) * x[i].abs().max(step[i].abs()));
    let largest = sizes.fold(0.0, f64::max);
    if largest > 0.0 && largest.is_finite() {
        (0..n).map(|i| largest / root(i)).collect()
    } else {
        vec![1.0; n]
    }
}
