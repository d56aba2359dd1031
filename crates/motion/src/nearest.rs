//! Of several solutions of the constraints the one nearest to where the search began.

use crate::least_norm::norm;
use chetaev_mechanics::sample::Generator;

/// Steps towards the nearest solution.
pub(crate) const DRAWS: usize = 50;

/// The movable components that occur in the constraints: varying others would only make them differ from what is given.
pub(crate) fn both(movable: &[usize], occurring: &[bool]) -> Vec<usize> {
    movable.iter().copied().filter(|&i| occurring[i]).collect()
}

/// The solution nearest to a start.
#[derive(Default)]
pub(crate) struct Nearest {
    distance: f64,
    pub(crate) found: Option<Vec<f64>>,
}

impl Nearest {
    pub(crate) fn offer(&mut self, start: &[f64], x: &[f64]) {
        let distance = norm(&start.iter().zip(x).map(|(a, b)| a - b).collect::<Vec<_>>());
        // Equally near ones differ by rounding, which must not choose between them.
        if self.found.is_none() || distance < self.distance * (1.0 - 1e-9) {
            self.distance = distance;
            self.found = Some(x.to_vec());
        }
    }
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

/// Moves the movable components by up to one and their own size.
pub(crate) fn perturb(x: &mut [f64], movable: &[usize], generator: &mut Generator) {
    for &i in movable {
        x[i] += generator.between(-1.0, 1.0) * (1.0 + x[i].abs());
    }
}
