//! Quadratures over the rows of the motion, repeated with doubled steps.

use super::samples::LEAST;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::words::counted;
use std::ops::Range;

/// An integral that a principle says is zero, for the random variation at which it is largest.
#[derive(Clone, Debug)]
pub struct Refined {
    /// Steps of the quadrature, the smallest first.
    pub steps: Vec<f64>,
    /// `|∫ integrand dt − end terms|` over the sizes of the terms, for each.
    pub residuals: Vec<f64>,
    /// The difference of the two finest, on the same scale: what the quadrature leaves open.
    pub change: f64,
    /// The interval.
    pub interval: (f64, f64),
    /// How many variations were taken.
    pub variations: u32,
}

/// Beyond this part, and beyond what the quadrature leaves open, it is not zero.
pub(super) const CLEARLY: f64 = 1e-3;
/// Variations of each integral.
pub(super) const VARIATIONS: usize = 4;
/// Steps: so many times the distance of rows.
pub(super) const STRIDES: [usize; 5] = [1, 2, 4, 8, 16];
/// The seed of the variations.
pub(super) const SEED: u64 = 0x5eed_0d9a;
/// Gregory's coefficients of the differences at the ends, which make the trapezoidal rule one of the order 8 (Abramowitz and
/// Stegun 1964, 25.4.7).
const GREGORY: [f64; 6] = [
    1.0 / 12.0,
    1.0 / 24.0,
    19.0 / 720.0,
    3.0 / 160.0,
    863.0 / 60480.0,
    275.0 / 24192.0,
];
/// Fewer steps are too few for the differences at both ends.
const FEWEST: usize = 8;

/// A value and the sum of the sizes of its terms.
pub(super) type Term = (f64, f64);

/// What an integrand does at the ends of the interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// It vanishes there with its derivatives: the trapezoidal rule.
    Vanishing,
    /// It does not: the trapezoidal rule with Gregory's differences at the ends.
    Open,
}

impl Rule {
    /// Weights of so many steps, in units of a step.
    fn weights(self, steps: usize) -> Vec<f64> {
        let mut weights = vec![1.0; steps + 1];
        weights[0] = 0.5;
        weights[steps] = 0.5;
        if self == Rule::Vanishing {
            return weights;
        }
        for (k, coefficient) in (1_usize..).zip(GREGORY) {
            let mut binomial = 1.0;
            for j in 0..=k {
                let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
                weights[j] -= coefficient * sign * binomial;
                weights[steps - j] -= coefficient * sign * binomial;
                binomial *= (k - j) as f64 / (j + 1) as f64;
            }
        }
        weights
    }
}

/// The part of the rows that is integrated over: a multiple of all steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// Its first row.
    pub(super) first: usize,
    /// How many rows follow.
    pub(super) count: usize,
    /// The times of its ends.
    pub(super) interval: (f64, f64),
}

impl Span {
    /// The span in a range of rows.
    ///
    /// # Errors
    /// That it is too short, where `what` says what holds on it.
    pub(super) fn new(
        times: &[f64],
        rows: &Range<usize>,
        (rule, what): (Rule, &str),
    ) -> Result<Span, String> {
        let largest = STRIDES[STRIDES.len() - 1];
        let count = rows.len().saturating_sub(1) / largest * largest;
        let least = match rule {
            Rule::Vanishing => LEAST,
            Rule::Open => FEWEST * largest,
        };
        if count < least {
            return Err(match rows.len() {
                0 | 1 => format!("there is no part of the motion computed on which {what}"),
                _ => format!(
                    "the longest part of the motion computed on which {what} has {}; {least} are needed",
                    counted(rows.len() - 1, "step of the output", "steps of the output")
                ),
            });
        }
        Ok(Span {
            first: rows.start,
            count,
            interval: (times[rows.start], times[rows.start + count]),
        })
    }

    /// Its length in time.
    pub(super) fn length(&self) -> f64 {
        self.interval.1 - self.interval.0
    }

    /// Its rows with their shares of the interval.
    pub(super) fn rows(&self) -> impl Iterator<Item = (usize, f64)> {
        let (first, count) = (self.first, self.count);
        (0..=count).map(move |j| (first + j, j as f64 / count as f64))
    }

    /// The integral of one variation less its end terms: `terms` at all rows for the stride given, of which each stride-th
    /// counts.
    ///
    /// # Errors
    /// That some value is none.
    pub(super) fn integral(
        &self,
        rule: Rule,
        mut terms: impl FnMut(usize) -> Option<Vec<Term>>,
        ends: Term,
    ) -> Result<Refined, String> {
        let step = self.length() / self.count as f64;
        let mut sums = Vec::new();
        let mut scale = 0.0;
        for stride in STRIDES {
            let terms = terms(stride).ok_or("a variation has no value at a row")?;
            let weights = rule.weights(self.count / stride);
            let pairs = terms.iter().step_by(stride).zip(&weights);
            let sum: f64 = pairs.map(|(term, w)| term.0 * w).sum();
            sums.push(sum * step * stride as f64 - ends.0);
            if stride == 1 {
                let sizes: f64 = terms.iter().map(|term| term.1).sum();
                scale = sizes * step.abs() + ends.1;
            }
        }
        if scale.is_nan() || sums.iter().any(|sum| sum.is_nan()) {
            return Err("the integrand has no value at a row".into());
        }
        Ok(self.of_values(&sums, scale))
    }

    /// What belongs together of the largest values at the rows, each with the largest size of its terms, by stride.
    pub(super) fn of_largest(&self, largest: &[Term]) -> Refined {
        let values: Vec<f64> = largest.iter().map(|term| term.0).collect();
        self.of_values(&values, largest[0].1)
    }

    /// Values by stride over a scale.
    fn of_values(&self, values: &[f64], scale: f64) -> Refined {
        let over = |x: f64| if scale == 0.0 { 0.0 } else { x.abs() / scale };
        let step = self.length().abs() / self.count as f64;
        Refined {
            steps: STRIDES.iter().map(|&s| step * s as f64).collect(),
            residuals: values.iter().map(|&value| over(value)).collect(),
            change: over(values[0] - values[1]),
            interval: self.interval,
            variations: VARIATIONS as u32,
        }
    }
}

/// The largest of the integrals of several random variations.
///
/// # Errors
/// That of one of them.
pub(super) fn worst(
    mut of: impl FnMut(&mut Generator) -> Result<Refined, String>,
) -> Result<Refined, String> {
    let mut generator = Generator::new(SEED);
    let mut worst: Option<Refined> = None;
    for _ in 0..VARIATIONS {
        let found = of(&mut generator)?;
        let is_worse = |known: &Refined| found.residuals[0] > known.residuals[0];
        if worst.as_ref().is_none_or(is_worse) {
            worst = Some(found);
        }
    }
    worst.ok_or_else(|| "no variation was taken".into())
}

/// The longest range of rows with a property.
pub(super) fn longest(count: usize, holds: impl Fn(usize) -> bool) -> Range<usize> {
    let (mut best, mut start) = (0..1, 0);
    for row in 0..=count {
        if row == count || !holds(row) {
            if row - start > best.len() {
                best = start..row;
            }
            start = row + 1;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_stretch() {
        let holds = |row: usize| ![0, 4, 5].contains(&row);
        assert_eq!(longest(12, holds), 6..12);
        assert_eq!(longest(3, |_| true), 0..3);
        assert_eq!(longest(3, |_| false).len(), 1);
    }

    /// ∫₀¹ eᵗ dt = e − 1 by the rule with differences at the ends: of the order 8, so that doubled steps have 2⁸ times the error.
    #[test]
    fn the_rule_with_differences_is_of_order_eight() {
        let error = |steps: usize| {
            let at = |j: usize| (3.0 * j as f64 / steps as f64).exp();
            let weights = Rule::Open.weights(steps).into_iter().enumerate();
            let sum: f64 = weights.map(|(j, w)| w * at(j)).sum();
            (sum * 3.0 / steps as f64 - (3.0_f64.exp() - 1.0)).abs()
        };
        let ratio = error(16) / error(32);
        assert!((150.0..400.0).contains(&ratio), "{ratio}");
        assert!(error(128) < 1e-12);
    }

    /// End terms are subtracted: ∫₀¹ 2 t dt − [t²] = 0, and without them 1 is left.
    #[test]
    fn end_terms_are_subtracted() {
        let times: Vec<f64> = (0..=256).map(|j| f64::from(j) / 256.0).collect();
        let span = Span::new(&times, &(0..257), (Rule::Open, "")).expect("a span");
        let terms = |_: usize| Some(times.iter().map(|t| (2.0 * t, 2.0 * t)).collect());
        let with = span
            .integral(Rule::Open, terms, (1.0, 1.0))
            .expect("a value");
        assert!(with.residuals.iter().all(|r| *r < 1e-14), "{with:?}");
        let without = span
            .integral(Rule::Open, terms, (0.0, 0.0))
            .expect("a value");
        assert!(without.residuals[0] > 0.9, "{without:?}");
    }
}
