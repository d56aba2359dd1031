//! Zeros of a switching function within one step, told apart by its Taylor series along the dense output (T5, events):
//! the variations of sign of its Bernstein coefficients bound the number of zeros, so that none is missed where the series is
//! the function.

use crate::dense::{Basis, DenseStep};
use crate::problem::{EvaluationFailure, Piece};
use crate::sampling::{refine_within, size_around, Samples};

/// Order of the series of a switching function.
pub(crate) const ORDER: usize = 24;

/// Places of a piece, on −1 … 1, at which the series must be the function.
const CHECKS: [f64; 6] = [-1.0, -0.81, -0.43, 0.43, 0.81, 1.0];

/// Part of the largest value by which the series may miss the function.
const CLOSE: f64 = 1e-9;

/// Values below this part of the largest ever seen are rounding.
const ROUNDING: f64 = 1e-13;

/// The step is halved so often where the series does not converge fast enough.
const MOST_HALVINGS: u32 = 9;

/// Pieces of one step; a function that needs more is sampled.
const MOST_PIECES: usize = 1024;

/// So many pieces are sampled, as kinks and poles are few; a function with more is sampled as a whole.
const MOST_SAMPLED: usize = 16;

/// Zeros closer than 2 to the power of this, in units of a piece, are looked at as one dip.
const CLOSEST: u32 = 30;

/// What is asked of a function: its series along a piece of the motion, written into the slice (false where it has none),
/// and its value at a scaled time.
pub(crate) trait Followed {
    /// Coefficients along the piece.
    fn series(&mut self, piece: Piece<'_>, series: &mut [f64]) -> bool;

    /// Value at θ.
    ///
    /// # Errors
    /// Why there is none.
    fn value(&mut self, theta: f64) -> Result<f64, EvaluationFailure>;
}

/// Working storage.
#[derive(Debug, Default)]
pub(crate) struct Isolator {
    /// The dense output as a polynomial in θ, by order.
    whole: Vec<f64>,
    /// The same on a piece.
    local: Vec<f64>,
}

impl Isolator {
    /// Writes into `places` scaled times between which the function has one zero at most, and such that every dip to less than
    /// `touch` has one of them near; pieces on which its series does not converge, as at a kink or beside a pole, are sampled. Says
    /// whether it was shown everywhere; `None` where it has no series, or needs too many pieces. `largest` is its largest magnitude
    /// before this step, `nodes` are its values in it.
    ///
    /// # Errors
    /// Where the function has no value.
    pub(crate) fn places(
        &mut self,
        dense: &DenseStep,
        (nodes, largest, touch): (&Samples, f64, f64),
        function: &mut impl Followed,
        places: &mut Vec<f64>,
    ) -> Result<Option<bool>, EvaluationFailure> {
        places.clear();
        monomial(dense, &mut self.whole);
        let mut series = [0.0; ORDER + 1];
        let mut left = vec![(0.0, 1.0, 0)];
        let (mut looked, mut sampled, mut is_shown) = (0, 0, true);
        while let Some((start, end, halvings)) = left.pop() {
            looked += 1;
            let (middle, half) = ((start + end) / 2.0, (end - start) / 2.0);
            shifted(
                &self.whole,
                dense.dimension,
                (middle, half),
                &mut self.local,
            );
            let piece = Piece {
                t: dense.start.plus(middle * dense.h).high,
                length: half * dense.h,
                dimension: dense.dimension,
                coefficients: &self.local,
            };
            if !function.series(piece, &mut series) {
                return Ok(None);
            }
            let largest = largest.max(size_around(nodes, (start, end)));
            if is_function(&series, largest, |s| function.value(middle + half * s))? {
                separate(&series, touch, (middle, half), places);
                continue;
            }
            if looked == MOST_PIECES {
                return Ok(None);
            }
            if halvings == MOST_HALVINGS {
                sampled += 1;
                if sampled > MOST_SAMPLED {
                    return Ok(None);
                }
                let value = |theta| function.value(theta);
                is_shown &= refine_within((start, end), largest, value, places)?;
                continue;
            }
            left.push((middle, end, halvings + 1));
            left.push((start, middle, halvings + 1));
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        Ok(Some(is_shown))
    }
}

/// The dense output in powers of θ, all components of one power side by side.
fn monomial(dense: &DenseStep, whole: &mut Vec<f64>) {
    let n = dense.dimension;
    whole.clear();
    if dense.basis == Basis::Monomial || n == 0 {
        whole.extend_from_slice(&dense.coefficients);
        return;
    }
    let degree = (dense.coefficients.len() / n).saturating_sub(1);
    whole.resize(dense.coefficients.len(), 0.0);
    whole[..n].copy_from_slice(&dense.coefficients[degree * n..]);
    for j in (0..degree).rev() {
        // By θ, or by 1 − θ; the polynomial so far is of degree `degree − 1 − j`.
        for k in (1..=degree - j).rev() {
            for i in 0..n {
                let below = whole[(k - 1) * n + i];
                let here = &mut whole[k * n + i];
                *here = if j % 2 == 1 { *here - below } else { below };
            }
        }
        let stated = &dense.coefficients[j * n..(j + 1) * n];
        for (constant, c) in whole.iter_mut().zip(stated) {
            let kept = if j % 2 == 1 { *constant } else { 0.0 };
            *constant = c + kept;
        }
    }
}

/// The polynomial in s, θ = middle + half s.
fn shifted(whole: &[f64], n: usize, (middle, half): (f64, f64), local: &mut Vec<f64>) {
    local.clear();
    local.extend_from_slice(whole);
    let orders = whole.len().checked_div(n).unwrap_or(0);
    for first in 0..orders {
        for k in (first..orders.saturating_sub(1)).rev() {
            for i in 0..n {
                local[k * n + i] += middle * local[(k + 1) * n + i];
            }
        }
    }
    let mut scale = 1.0;
    for row in local.chunks_mut(n.max(1)) {
        row.iter_mut().for_each(|c| *c *= scale);
        scale *= half;
    }
}

/// Whether the series has converged and is the function at the checks.
fn is_function(
    series: &[f64; ORDER + 1],
    largest: f64,
    mut value: impl FnMut(f64) -> Result<f64, EvaluationFailure>,
) -> Result<bool, EvaluationFailure> {
    let most = series.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    if !most.is_finite() {
        return Ok(false);
    }
    let allowed = (CLOSE * most).max(ROUNDING * largest);
    if series[ORDER - 1].abs() + series[ORDER].abs() > allowed {
        return Ok(false);
    }
    for s in CHECKS {
        let sum = series.iter().rev().fold(0.0, |sum, c| sum * s + c);
        if (sum - value(s)?).abs() > allowed {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Adds the places that tell the zeros of a series on −1 … 1 apart, and those near dips to less than `touch`.
fn separate(
    series: &[f64; ORDER + 1],
    touch: f64,
    (middle, half): (f64, f64),
    places: &mut Vec<f64>,
) {
    let noise = 8.0 * f64::EPSILON * series.iter().map(|c| c.abs()).sum::<f64>();
    // The two halves, both away from the middle: so no sum of the conversion cancels.
    for sign in [-1.0, 1.0] {
        let mut own = *series;
        own.iter_mut().skip(1).step_by(2).for_each(|c| *c *= sign);
        let mut left = vec![(0.0, 1.0, bernstein(&own), 0)];
        while let Some((start, end, polygon, halvings)) = left.pop() {
            let variations = variations(&polygon, noise);
            let between = (start + end) / 2.0;
            let small = if variations == 0 {
                noise.max(touch)
            } else {
                noise
            };
            let doubtful = polygon.iter().filter(|b| b.abs() <= small).count();
            if variations == 0 && doubtful == 0 {
                continue;
            }
            if variations == 1 || doubtful > ORDER || halvings == CLOSEST {
                let looked = [start, between, end].map(|s| middle + half * sign * s);
                places.extend(looked);
                continue;
            }
            let (first, second) = halved(&polygon);
            left.push((start, between, first, halvings + 1));
            left.push((between, end, second, halvings + 1));
        }
    }
}

/// Bernstein coefficients on 0 … 1: b_i = Σ_{j ≤ i} C(i, j)/C(p, j) c_j (Farouki and Rajan 1987, (6)).
fn bernstein(series: &[f64; ORDER + 1]) -> [f64; ORDER + 1] {
    std::array::from_fn(|i| {
        let (mut sum, mut weight) = (0.0, 1.0);
        for (j, c) in series.iter().enumerate().take(i + 1) {
            sum += weight * c;
            weight *= (i - j) as f64 / (ORDER - j).max(1) as f64;
        }
        sum
    })
}

/// Changes of sign, without what is rounding.
fn variations(polygon: &[f64; ORDER + 1], noise: f64) -> usize {
    let signs = polygon.iter().filter(|b| b.abs() > noise);
    let mut count = 0;
    let mut last = 0.0;
    for b in signs {
        count += usize::from(last * b.signum() < 0.0);
        last = b.signum();
    }
    count
}

/// The coefficients on both halves (de Casteljau).
fn halved(polygon: &[f64; ORDER + 1]) -> ([f64; ORDER + 1], [f64; ORDER + 1]) {
    let (mut first, mut second) = (*polygon, *polygon);
    for level in 1..=ORDER {
        for i in (level..=ORDER).rev() {
            first[i] = (first[i] + first[i - 1]) / 2.0;
        }
        for i in 0..=ORDER - level {
            second[i] = (second[i] + second[i + 1]) / 2.0;
        }
    }
    (first, second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compensated::Time;
    use crate::sampling::NODES;

    /// A function of one coordinate that moves by a polynomial, with a series that is known.
    struct Known<F, S> {
        value: F,
        series: S,
    }

    impl<F: Fn(f64) -> f64, S: Fn(Piece<'_>, &mut [f64])> Followed for Known<F, S> {
        fn series(&mut self, piece: Piece<'_>, series: &mut [f64]) -> bool {
            (self.series)(piece, series);
            true
        }

        fn value(&mut self, theta: f64) -> Result<f64, EvaluationFailure> {
            Ok((self.value)(theta))
        }
    }

    /// y = θ, by both bases.
    fn line(basis: Basis) -> DenseStep {
        DenseStep {
            start: Time::exact(0.0),
            h: 1.0,
            basis,
            dimension: 1,
            coefficients: vec![0.0, 1.0, 0.0, 0.0],
        }
    }

    /// Number of changes of sign between the places found, and whether the series showed the function.
    fn changes(
        value: impl Fn(f64) -> f64 + Copy,
        series: impl Fn(Piece<'_>, &mut [f64]),
    ) -> (usize, bool) {
        let (mut places, mut isolator) = (Vec::new(), Isolator::default());
        let shown = isolator
            .places(
                &line(Basis::Monomial),
                (&NODES.map(value), 0.0, 0.0),
                &mut Known { value, series },
                &mut places,
            )
            .unwrap_or(None)
            .unwrap_or(false);
        places.extend([0.0, 1.0]);
        places.sort_by(f64::total_cmp);
        let values: Vec<f64> = places.iter().map(|&x| value(x)).collect();
        (
            values.windows(2).filter(|p| p[0] * p[1] < 0.0).count(),
            shown,
        )
    }

    /// Coefficients of sin(w y + f) about the middle of the piece.
    fn sine(w: f64, f: f64) -> impl Fn(Piece<'_>, &mut [f64]) {
        move |piece, series| {
            let (start, rate) = (w * piece.coefficients[0] + f, w * piece.coefficients[1]);
            let mut factor = 1.0;
            for (j, c) in series.iter_mut().enumerate() {
                *c = factor * (start + j as f64 * std::f64::consts::FRAC_PI_2).sin();
                factor *= rate / (j + 1) as f64;
            }
        }
    }

    #[test]
    fn every_zero_of_an_oscillation_is_told_apart() {
        for w in [3.0, 50.0, 400.0, 1000.0] {
            let value = |x: f64| (w * x + 0.3).sin();
            let turns = ((w + 0.3) / std::f64::consts::PI).floor() as usize;
            assert_eq!(changes(value, sine(w, 0.3)), (turns, true), "{w}");
        }
        let (_, shown) = changes(|x: f64| (1e5 * x).sin(), sine(1e5, 0.0));
        assert!(!shown, "faster than it is followed");
    }

    /// Two zeros a distance of 2e-9 apart, between all places of a sampling.
    #[test]
    fn a_dip_is_found_however_narrow() {
        for (depth, zeros) in [(1e-6, 2), (1e-12, 2), (-1e-12, 0)] {
            let value = |x: f64| (x - 0.31234).powi(2) - depth;
            let series = |piece: Piece<'_>, series: &mut [f64]| {
                let (c, r) = (piece.coefficients[0] - 0.31234, piece.coefficients[1]);
                series.fill(0.0);
                series[..3].copy_from_slice(&[c * c - depth, 2.0 * c * r, r * r]);
            };
            assert_eq!(changes(value, series), (zeros, true), "{depth}");
        }
    }

    /// A polynomial in the alternating basis has the same values in powers.
    #[test]
    fn bases_agree() {
        let coefficients: Vec<f64> = (0..14).map(|k| ((k * k) as f64).sin()).collect();
        let dense = DenseStep {
            start: Time::exact(0.0),
            h: 0.5,
            basis: Basis::Alternating,
            dimension: 2,
            coefficients,
        };
        let (mut whole, mut local) = (Vec::new(), Vec::new());
        monomial(&dense, &mut whole);
        shifted(&whole, 2, (0.4, 0.1), &mut local);
        for s in [-1.0, -0.3, 0.0, 0.7] {
            let mut y = [0.0; 2];
            dense.at_theta(0.4 + 0.1 * s, &mut y);
            for i in 0..2 {
                let rows = local.chunks(2).rev();
                let sum = rows.fold(0.0, |sum, row| sum * s + row[i]);
                assert!((sum - y[i]).abs() < 1e-13, "{sum} {}", y[i]);
            }
        }
    }
}
