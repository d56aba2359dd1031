//! The tangent cone at a place where the rank falls, and what it says of the motion.

use super::spectrum::{gram, transposed, Spectrum};
use super::{Crossing, Passage, Path, State, Track, Undetermined};
use chetaev_mechanics::words;

/// Squares of singular values below this count as zero at the place of a crossing, which is known to about a root of
/// the rounding.
const VANISHED: f64 = 1e-9;
/// Part of the path by which the gradients are moved to find their rate.
const STEP: f64 = 8e-3;
/// The rate of the vanishing singular values, as a part of that of the gradients, below which branches touch.
const TOUCHING: f64 = 1e-3;
/// A residual that is rounding, relative to the largest coordinate.
const ROUNDED: f64 = 64.0 * f64::EPSILON;
/// Velocities below this part of the largest on the way are none.
const REST: f64 = 1e-7;

/// Null spaces of the gradients: W of their combinations, K of the velocities, in the scales of the track.
struct Null {
    combinations: Vec<Vec<f64>>,
    directions: Vec<Vec<f64>>,
}

struct Slope {
    least: f64,
    size: f64,
}

impl Track {
    /// What the cone at the place `theta` of the last path says.
    pub(super) fn judged(&mut self, paths: Vec<Path>, theta: f64) -> Passage {
        let Some(path) = paths.last() else {
            return Passage::Unknown;
        };
        let at = path.at(theta);
        let Some(null) = self.null(&at) else {
            return Passage::Unknown;
        };
        if !self.lies_on_the_set(&at, &null, path.uncertainty(theta)) {
            // The sheets only come close: the motion turns from one direction into another between two nodes.
            self.is_quiet = true;
            return Passage::Unknown;
        }
        let (vanished, rank) = (
            null.combinations.len() - (self.system.r - self.rank),
            self.rank,
        );
        let mut slope = |step: f64| {
            let sides = [-step, step].map(|step| path.at(theta + step));
            let (before, after) = (self.scaled(&sides[0])?, self.scaled(&sides[1])?);
            let rate = before.iter().zip(&after).map(|(a, b)| (b - a) / step);
            Some(self.slope(&rate.collect::<Vec<f64>>(), &null))
        };
        let (Some(wide), Some(narrow)) = (slope(STEP), slope(0.25 * STEP)) else {
            return Passage::Unknown;
        };
        // Where branches touch the slope is zero, and what is seen of it is due to the step.
        if narrow.least > TOUCHING * TOUCHING * narrow.size && narrow.least > 0.5 * wide.least {
            let crossing = Crossing {
                t: at.t,
                rank: (rank, rank - vanished),
                onto: None,
            };
            return Passage::Passed {
                crossing: Some(crossing),
                paths,
            };
        }
        let why = self.undetermined(&at, &null, path);
        Passage::Ended { paths, why }
    }

    /// The motion cannot be followed on one sheet; `at` is the last state reached.
    pub(super) fn stuck(&mut self, at: &State, paths: Vec<Path>) -> Passage {
        let small = self
            .measure_at(at)
            .is_some_and(|m| m <= 1e-7 * self.largest);
        if !small {
            return Passage::Unknown;
        }
        let why = Undetermined {
            t: at.t,
            reason: self.in_words(
                at,
                "the motion cannot be followed on one of the branches that meet there",
            ),
        };
        Passage::Ended { paths, why }
    }

    fn null(&mut self, at: &State) -> Option<Null> {
        let rows = self.scaled(at)?;
        let (n, r) = (self.system.n, self.system.r);
        let of_rows = Spectrum::of(gram(&rows, n), r);
        // Rows are measured by their largest lengths.
        let missing = of_rows.values.iter().filter(|x| **x <= VANISHED).count();
        if r - missing >= self.rank {
            return None;
        }
        let of_columns = Spectrum::of(gram(&transposed(&rows, n), r), n);
        Some(Null {
            combinations: of_rows.vectors[..missing].to_vec(),
            directions: of_columns.vectors[..n - (r - missing)].to_vec(),
        })
    }

    /// Whether the finite constraints hold at the place to second order in what is not known of it, as they do if the sheets meet.
    fn lies_on_the_set(&mut self, at: &State, null: &Null, uncertainty: f64) -> bool {
        let system = &mut self.system;
        if system.evaluate_positions(at.t, &at.q, &at.v).is_err() {
            return false;
        }
        let residual = system.position_residual();
        let size = at.q.iter().fold(1e-300, |m: f64, q| m.max(q.abs()));
        null.combinations.iter().all(|w| {
            let own = system.holonomic.iter().zip(residual);
            let lengths = &self.lengths;
            let terms = own.map(|(&row, f)| w[row] * f / lengths[row].max(f64::MIN_POSITIVE));
            let rounding = ROUNDED * size.max(1.0);
            terms.sum::<f64>().abs() <= rounding + 16.0 * uncertainty * uncertainty / size
        })
    }

    /// The squares of the singular values of `Wᵀ J' K` that must not vanish, by the least of them, beside the square of J'.
    fn slope(&self, rate: &[f64], null: &Null) -> Slope {
        let n = self.system.n;
        let image = |w: &Vec<f64>| -> Vec<f64> {
            let mut sum = vec![0.0; n];
            for (weight, row) in w.iter().zip(rate.chunks(n)) {
                sum.iter_mut().zip(row).for_each(|(s, x)| *s += weight * x);
            }
            let along = |u: &Vec<f64>| u.iter().zip(&sum).map(|(u, s)| u * s).sum::<f64>();
            null.directions.iter().map(along).collect()
        };
        let size: f64 = rate.iter().map(|x| x * x).sum();
        let rows: Vec<f64> = null.combinations.iter().flat_map(image).collect();
        let (count, width) = (null.combinations.len(), null.directions.len());
        let values = Spectrum::of(gram(&rows, width), count).values;
        // As many as always vanish may do so here too.
        let always = self.system.r - self.rank;
        let least = values.get(always).copied().unwrap_or(f64::INFINITY);
        Slope { least, size }
    }

    fn undetermined(&mut self, at: &State, null: &Null, path: &Path) -> Undetermined {
        let speed = |state: &State| state.v.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let usual = speed(&path.at(0.0));
        let why = if speed(at) <= REST * usual {
            "the motion comes to rest there, and every branch contains the velocity zero"
        } else {
            "they touch, so that the velocity lies on more than one of them"
        };
        let branches = self.branches(at, null);
        let mut reason = self.in_words(at, why);
        if !branches.is_empty() {
            reason.push_str(&format!(
                "; the branches have the directions {}",
                branches.join(" and ")
            ));
        }
        Undetermined { t: at.t, reason }
    }

    fn in_words(&self, at: &State, why: &str) -> String {
        let names: Vec<String> = self
            .system
            .constraints
            .iter()
            .map(|c| format!("`{c}`"))
            .collect();
        format!(
            "the rank of the constraints {} falls at t = {}, where branches of the constraint set meet: {why}; the motion beyond is not determined",
            names.join(", "),
            words::precise_number(at.t)
        )
    }

    /// The directions of two lines, where the cone of finite constraints is a pair of them: the zeros of the quadratic form Σ w ∂²φ(u, u).
    fn branches(&mut self, at: &State, null: &Null) -> Vec<String> {
        let n = self.system.n;
        let always = self.system.r - self.rank;
        let [u, v] = &null.directions[..] else {
            return Vec::new();
        };
        if always > 0 || null.combinations.len() != 1 {
            return Vec::new();
        }
        let is_finite = |row: usize| self.system.holonomic.contains(&row);
        let in_velocities =
            (0..self.system.r).any(|row| !is_finite(row) && null.combinations[0][row].abs() > 1e-9);
        let still = self.system.evaluate(at.t, &at.q, &vec![0.0; n]);
        if in_velocities || still.is_err() || self.system.rate().iter().any(|g| *g != 0.0) {
            return Vec::new();
        }
        let w = null.combinations[0].clone();
        let directions = [u.clone(), v.clone()].map(|u| self.unscaled(&u));
        let mut form = |s: f64, c: f64| {
            let speeds: Vec<f64> = (0..n)
                .map(|i| s * directions[0][i] + c * directions[1][i])
                .collect();
            self.system.evaluate(at.t, &at.q, &speeds).ok()?;
            let rates = self.system.rate().iter().zip(&w).zip(&self.lengths);
            Some(
                -rates
                    .map(|((g, w), l)| g * w / l.max(f64::MIN_POSITIVE))
                    .sum::<f64>(),
            )
        };
        let (Some(a), Some(c), Some(sum)) = (form(1.0, 0.0), form(0.0, 1.0), form(1.0, 1.0)) else {
            return Vec::new();
        };
        let b = 0.5 * (sum - a - c);
        let root = b * b - a * c;
        if root < 0.0 {
            return Vec::new();
        }
        let root = root.sqrt();
        // a s² + 2 b s c' + c c'² = 0.
        let lines = if b >= 0.0 {
            [(-(b + root), a), (c, -(b + root))]
        } else {
            [(root - b, a), (c, root - b)]
        };
        let name = |(s, c): (f64, f64)| {
            let x: Vec<f64> = (0..n)
                .map(|i| s * directions[0][i] + c * directions[1][i])
                .collect();
            self.direction_in_words(&x)
        };
        lines.map(name).to_vec()
    }

    fn unscaled(&self, direction: &[f64]) -> Vec<f64> {
        let (mass, n) = (self.system.mass(), self.system.n);
        let scale = |j: usize| crate::chart::scale(mass[j * n + j]);
        direction
            .iter()
            .enumerate()
            .map(|(j, u)| u / scale(j))
            .collect()
    }

    fn direction_in_words(&self, x: &[f64]) -> String {
        let largest = x
            .iter()
            .fold(1e-300, |m: f64, x| if x.abs() > m.abs() { *x } else { m });
        let parts = self.system.coordinates.iter().zip(x);
        let parts: Vec<String> = parts
            .map(|(name, x)| {
                let part = (1e4 * x / largest).round() / 1e4;
                format!("{name}' = {}", if part == 0.0 { 0.0 } else { part })
            })
            .collect();
        format!("({})", parts.join(", "))
    }
}
