//! `witness.second-kind#…`: Zhu's principles along the computed motion, with Dq and Dp from the positions and momenta at the rows.
//!
//! The velocities of the rows are not taken for the derivatives of their positions: Dq is a difference of the eighth order of the
//! positions themselves, over the step of the quadrature, so that `Dq = v` is part of what is tested.

use super::claims::{elsewhere, vanishing};
use super::common::Common;
use super::neighbours::COORDINATES;
use super::refined::{worst, Refined, Rule, Span, Term};
use super::wave::Wave;
use super::{algebra, evidence, show, Figure};
use crate::method_order::corners;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group, Scope};
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::words::number;
use chetaev_principles::second_kind::Ends;
use chetaev_symbolic::Verdict;
use std::sync::Arc;

/// The statement at each time.
const DIFFERENTIAL: &str = "differential";

/// `witness.second-kind#STATEMENT`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WitnessOfSecondKind;

impl Claim for WitnessOfSecondKind {
    fn id(&self) -> &'static str {
        "witness.second-kind"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn scope(&self) -> Scope {
        Scope::Run
    }

    fn title(&self) -> &'static str {
        "Principles of the second kind along the computed motion"
    }

    fn explanation(&self) -> &'static str {
        "q and v are varied independently: random virtual δq, and δv of their own. Dq and Dp are differences of the positions and momenta at the rows of the motion, so that Dq = v is tested too. \
         `differential`: Σ (∂L/∂q + Q − Dp) δq + Σ (Dq − v) δp = 0 at every row, the largest over the sizes of its terms. With Z = L + Σ (Dq − v) p: `fixed`: ∫(δZ + Σ Q δq) dt = 0 with δq = 0 and δv = 0 at the ends; `half-fixed`: with δq = 0 alone; \
         `free`: less [Σ p δq] with nothing asked of the ends. Each goes to zero with the step, which is that of the differences too; `refuted` means that it does not. \
         Example: q = t², v = 2 t, L = v²/2 + 2 q: ∫(2 δq + v D(δq) + (Dq − v) δv) dt is [v δq] for all δq and δv: 2 for δq = t from 0 to 1. \
         With free ends that has to be subtracted."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        vec![proved_by(subject)]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if evidence(cx).is_none() || cx.terms.order != 1 || cx.system.n() > COORDINATES {
            return Vec::new();
        }
        let ends = Ends::ALL.into_iter().map(Ends::word);
        [DIFFERENTIAL]
            .into_iter()
            .chain(ends)
            .map(|word| Some(word.to_string()))
            .collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        if let Some(other) = elsewhere(cx) {
            return other;
        }
        if let Some(why) = bend(cx) {
            return Verdict::undecided(why).into();
        }
        let ends = Ends::of(subject);
        let proof = proved_by(subject);
        if !matches!(cx.finding(&proof).verdict, Verdict::Proved(_)) {
            let detail = "the principle is not proved of this system";
            return Verdict::not_applicable(proof, detail).into();
        }
        let found = Curve::new(cx).and_then(|curve| match ends {
            Some(ends) => curve.integral(ends),
            None => curve.differential(),
        });
        let name = words(ends);
        match found {
            Ok(found) => {
                let verdict = vanishing(&found, name, "first variation");
                show(
                    cx,
                    Figure::SecondKind,
                    (subject.unwrap_or(DIFFERENTIAL), name),
                    found,
                );
                verdict.into()
            }
            Err(why) => Verdict::undecided(why).into(),
        }
    }
}

/// The claim that proves what is witnessed.
fn proved_by(subject: Option<&str>) -> String {
    match Ends::of(subject) {
        Some(ends) => format!("second-kind.integral#{}", ends.word()),
        None => "second-kind.differential".into(),
    }
}

fn words(ends: Option<Ends>) -> &'static str {
    match ends {
        None => "the differential principle of the second kind",
        Some(Ends::Free) => "the principle of the second kind with free ends",
        Some(Ends::HalfFixed) => "the principle of the second kind with δq = 0 at the ends",
        Some(Ends::Fixed) => "the principle of the second kind with δq = 0 and δv = 0 at the ends",
    }
}

/// Coefficients of the difference of the eighth order at each of nine places.
fn differences() -> Vec<Vec<f64>> {
    (0..NODES).map(derivative_at).collect()
}

/// Places of a difference.
const NODES: usize = 9;

/// Why differences over rows give no rates along a motion, where its equations bend or jump on the way.
fn bend(cx: &Context<'_>) -> Option<String> {
    let evidence = evidence(cx)?;
    let corner = corners::first(cx.system, cx.terms, &evidence.binding, evidence.rows())?;
    let (text, t) = (&corner.text, number(corner.t));
    Some(format!(
        "{text} bends or jumps at t = {t}, where differences of rows give no rates"
    ))
}

/// The weights of the values at 0, 1, …, 8 in the derivative at one of them of the polynomial through all.
fn derivative_at(place: usize) -> Vec<f64> {
    let x = |j: usize| j as f64;
    // The barycentric weights 1/∏(x_j − x_m).
    let weight = |j: usize| -> f64 {
        let others = (0..NODES).filter(|&m| m != j);
        1.0 / others.map(|m| x(j) - x(m)).product::<f64>()
    };
    let mut row: Vec<f64> = (0..NODES)
        .map(|j| match j == place {
            true => 0.0,
            false => weight(j) / weight(place) / (x(place) - x(j)),
        })
        .collect();
    row[place] = -row.iter().sum::<f64>();
    row
}

/// A curve of the state space along the motion, with differences for its rates.
pub(super) struct Curve {
    common: Arc<Common>,
    differences: Vec<Vec<f64>>,
    /// Whether the end terms of free ends are left out, which is wrong: for tests.
    pub(super) without_ends: bool,
    /// What the velocities of the rows are multiplied by, which is wrong but for 1: for tests.
    pub(super) faster: f64,
}

/// What is differentiated along the rows: a list of numbers at each.
type Along<'a> = dyn Fn(usize) -> &'a [f64] + 'a;

impl Curve {
    pub(super) fn new(cx: &Context<'_>) -> Result<Curve, String> {
        Ok(Curve {
            common: Common::of(cx)?,
            differences: differences(),
            without_ends: false,
            faster: 1.0,
        })
    }

    fn span(&self) -> Result<Span, String> {
        let rows = 0..self.common.times().len();
        Span::new(self.common.times(), &rows, (Rule::Open, "there are rows"))
    }

    /// The derivative of numbers along the rows at one of them, by differences over so many rows.
    fn rate(&self, span: &Span, along: &Along<'_>, (row, stride): (usize, usize)) -> Vec<f64> {
        let steps = span.count / stride;
        let here = (row - span.first) / stride;
        let first = here.saturating_sub(NODES / 2).min(steps + 1 - NODES);
        let weights = &self.differences[here - first];
        let step = span.length() / steps as f64;
        let at = |j: usize| along(span.first + (first + j) * stride);
        (0..self.common.n)
            .map(|i| {
                let values = weights.iter().enumerate();
                values.map(|(j, w)| w * at(j)[i]).sum::<f64>() / step
            })
            .collect()
    }

    /// The variation at a row: δq, D(δq), δp of these and of δv.
    fn varied(&self, row: usize, of: &[(f64, f64)]) -> Option<[Vec<f64>; 3]> {
        let n = self.common.n;
        let (free, own) = of.split_at(n);
        let own = own.iter().enumerate();
        let own: Vec<f64> = own.map(|(i, w)| w.0 * self.common.speed(i)).collect();
        let (value, moved) = self.common.projected(row, free)?;
        let by_velocities = algebra::times(self.common.hessian(row), n, &own).into_iter();
        let by_positions = algebra::times(self.common.mixed(row), n, &value);
        let momenta = by_velocities.zip(by_positions).map(|(a, b)| a + b);
        Some([value, moved, momenta.collect()])
    }

    /// `Σ (Dq − v) δp`, and the sizes of its terms.
    fn lag(&self, row: usize, rate: &[f64], momenta: &[f64]) -> Term {
        let velocities = self.common.velocities(row);
        let mut sum = (0.0, 0.0);
        for i in 0..self.common.n {
            let v = self.faster * velocities[i];
            sum.0 += (rate[i] - v) * momenta[i];
            sum.1 += ((rate[i].abs() + v.abs()) * momenta[i]).abs();
        }
        sum
    }

    /// `Σ a b` of two groups of numbers, and the sizes of its terms.
    fn product(a: &[f64], b: &[f64]) -> Term {
        let pairs = a.iter().zip(b).map(|(a, b)| a * b);
        pairs.fold((0.0, 0.0), |sum, x| (sum.0 + x, sum.1 + x.abs()))
    }

    /// `∫(δZ + Σ Q δq) dt`, less `[Σ p δq]` with free ends.
    pub(super) fn integral(&self, ends: Ends) -> Result<Refined, String> {
        let (span, n) = (self.span()?, self.common.n);
        let positions = |row: usize| self.common.positions(row);
        worst(|generator| {
            let mut waves = waves(generator, n, ends != Ends::Free);
            waves.extend(self::waves(generator, n, ends == Ends::Fixed));
            let at = |(row, share): (usize, f64)| {
                let of: Vec<(f64, f64)> =
                    waves.iter().map(|w| w.at(share, span.length())).collect();
                self.varied(row, &of)
            };
            let varied: Option<Vec<_>> = span.rows().map(at).collect();
            let varied = varied.ok_or("the gradients of the constraints are dependent at a row")?;
            let terms = |stride: usize| -> Option<Vec<Term>> {
                let term = |(j, [value, moved, momenta]): (usize, &[Vec<f64>; 3])| {
                    if j % stride != 0 {
                        return (0.0, 0.0);
                    }
                    let row = span.first + j;
                    let rate = self.rate(&span, &positions, (row, stride));
                    let central = self.common.central(row, value, moved);
                    sum(&[central, self.lag(row, &rate, momenta)])
                };
                Some(varied.iter().enumerate().map(term).collect())
            };
            let last = varied.len() - 1;
            let end = |j: usize| Curve::product(self.common.momenta(span.first + j), &varied[j][0]);
            let ends = match ends == Ends::Free && !self.without_ends {
                true => (end(last).0 - end(0).0, end(last).1 + end(0).1),
                false => (0.0, 0.0),
            };
            span.integral(Rule::Open, terms, ends)
        })
    }

    /// The largest of `Σ (L_q + Q − Dp) δq + Σ (Dq − v) δp` at the rows, over the largest size of its terms.
    pub(super) fn differential(&self) -> Result<Refined, String> {
        let (span, n) = (self.span()?, self.common.n);
        let positions = |row: usize| self.common.positions(row);
        let momenta_at = |row: usize| self.common.momenta(row);
        worst(|generator| {
            let mut waves = waves(generator, n, false);
            waves.extend(self::waves(generator, n, false));
            let mut residuals = Vec::new();
            for stride in super::refined::STRIDES {
                let mut largest = (0.0_f64, 0.0_f64);
                for (row, share) in span.rows().step_by(stride) {
                    let of: Vec<(f64, f64)> =
                        waves.iter().map(|w| w.at(share, span.length())).collect();
                    let [value, _, momenta] = self
                        .varied(row, &of)
                        .ok_or("the gradients of the constraints are dependent at a row")?;
                    let rate = self.rate(&span, &positions, (row, stride));
                    let moved = self.rate(&span, &momenta_at, (row, stride));
                    let of_rate = Curve::product(&moved, &value);
                    let term = sum(&[
                        self.common.central(row, &value, &vec![0.0; n]),
                        (-of_rate.0, of_rate.1),
                        self.lag(row, &rate, &momenta),
                    ]);
                    if !term.0.is_finite() {
                        return Err("the principle has no value at a row".into());
                    }
                    largest = (largest.0.max(term.0.abs()), largest.1.max(term.1));
                }
                residuals.push(largest);
            }
            Ok(span.of_largest(&residuals))
        })
    }
}

fn sum(parts: &[Term]) -> Term {
    parts
        .iter()
        .fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1))
}

fn waves(generator: &mut Generator, count: usize, vanishing: bool) -> Vec<Wave> {
    (0..count)
        .map(|_| match vanishing {
            true => Wave::vanishing(generator),
            false => Wave::free(generator),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of degree eight are differentiated exactly at every place; t⁹ in the middle is not.
    #[test]
    fn differences_of_the_eighth_order() {
        for (place, weights) in differences().iter().enumerate() {
            for degree in 0..=8 {
                let values = (0..NODES).map(|j| (j as f64 - 4.0).powi(degree));
                let sum: f64 = values.zip(weights).map(|(x, w)| x * w).sum();
                let x = place as f64 - 4.0;
                let slope = match degree {
                    0 => 0.0,
                    _ => f64::from(degree) * x.powi(degree - 1),
                };
                assert!(
                    (sum - slope).abs() < 1e-8 * (1.0 + slope.abs()),
                    "{place} {degree}"
                );
            }
        }
    }
}
