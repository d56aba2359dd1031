//! A separated complete integral against the computed motion: `∂S/∂α = β` stays constant.
//!
//! The constants α are taken from the state where the stretch begins. Then `∂S/∂α_j = ∂action/∂α_j + Σ_e ∫ ∂g_e/∂α_j dq_e` is formed by
//! Gauss's quadrature over each coordinate between its values at the rows; nothing but positions and times enters. A momentum
//! that is the other root than that written is taken by it; a stretch ends before any of them vanishes, since ∂g/∂α has poles there.

use super::algebra::solved;
use super::evidence;
use super::samples::Samples;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::system::CompleteIntegral;
use chetaev_mechanics::Context;
use chetaev_principles::hamilton_jacobi::{momenta_on_motions, separated, verified, Extremum};
use chetaev_symbolic::evaluate::EvaluateError;
use chetaev_symbolic::{Expr, Graph, Node, Symbol, Verdict};

/// More coordinates are too many.
pub(super) const COORDINATES: usize = 8;
/// Fewer rows show nothing.
const FEWEST: usize = 8;
/// At most so many rows are taken.
const MOST: usize = 160;
/// A momentum below this part of its largest value is near a turning point.
const TURNING: f64 = 0.05;
/// Steps of Gauss and Newton for the constants.
const STEPS: usize = 60;
/// A momentum that the constants give to within this part is met.
const MET: f64 = 1e-9;
/// Steps below this part of the constants move them no more.
const STILL: f64 = 1e-12;
/// What is added to the normal equations against directions that are free.
const RIDGE: f64 = 1e-14;
/// Abscissas and weights of Gauss's rule on (−1, 1), the positive half (Abramowitz and Stegun 1964, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// β along a stretch of the motion.
#[derive(Clone, Debug)]
pub struct Quadratures {
    /// Constants with their values.
    pub constants: Vec<(String, f64)>,
    /// The largest `|β(t) − β(t₀)|` over the sizes of its terms.
    pub residual: f64,
    /// How much of it the rule of the quadrature and the error of the motion leave open.
    pub open: f64,
    /// How many rows were compared.
    pub rows: u32,
    /// The stretch.
    pub interval: (f64, f64),
}

/// Why quadratures are not compared with a motion.
#[derive(Clone, Debug)]
pub(super) enum Unmet {
    /// There are no quadratures.
    NoIntegral,
    /// The curves of the quadratures are no motions.
    NoMotion,
    /// The numbers were not found.
    Failed(NotCompared),
}

/// Why β has no numbers along a motion.
#[derive(Clone, Debug, thiserror::Error)]
pub(super) enum NotCompared {
    /// There are no rows at equal steps, for this reason.
    #[error("{0}")]
    Samples(String),
    /// The momenta need κ.
    #[error("κ is not known for the motions")]
    Kappa,
    /// There is no motion.
    #[error("no motion was computed")]
    Motion,
    /// There is no stretch without a turning point.
    #[error("some momentum of a quadrature vanishes at most rows of the motion")]
    Turning,
    /// There is no stretch on which one root is the momentum.
    #[error("the two roots for a momentum meet at most rows of the motion")]
    Meeting,
    /// A function cannot be evaluated.
    #[error(transparent)]
    Evaluation(#[from] EvaluateError),
    /// A value is not finite.
    #[error("a quadrature has no value along the motion")]
    Value,
    /// The equations for the constants were not solved.
    #[error("the constants of the motion were not found")]
    Constants,
}

/// The complete integral of a subject of `hamilton-jacobi.applicable`.
fn integral_of(cx: &Context<'_>, subject: &str) -> Result<CompleteIntegral, Unmet> {
    if subject == "stated" {
        return cx.system.complete_integral.clone().ok_or(Unmet::NoIntegral);
    }
    let extremum = Extremum::new(cx).ok_or(Unmet::NoIntegral)?;
    let integral = separated(cx, &extremum).ok_or(Unmet::NoIntegral)?;
    // Where the action is not stationary the equation may separate, and its curves are no motions.
    let found = verified(cx, &extremum, &integral);
    match found.map(|found| found.motion) {
        Ok(Verdict::Proved(_)) => Ok(integral),
        Ok(_) => Err(Unmet::NoMotion),
        Err(_) => Err(Unmet::NoIntegral),
    }
}

/// Compares the integral of a subject with the motion.
///
/// # Errors
/// [`Unmet`], in words.
pub(super) fn of(cx: &Context<'_>, subject: &str) -> Result<Quadratures, Unmet> {
    let integral = integral_of(cx, subject)?;
    let comparison = Comparison::new(cx, &integral).map_err(Unmet::Failed)?;
    let stretch = comparison.stretch().map_err(Unmet::Failed)?;
    comparison.compare(&stretch).map_err(Unmet::Failed)
}

/// A root of a quadratic equation with the other sign of its square roots in which constants occur.
fn opposite_root(g: &Graph, e: Expr, constants: &[Symbol]) -> Expr {
    let half = g.div(g.one(), g.integer(2));
    let is_root =
        |e: &Expr| matches!(g.node(*e), Node::Power { exponent, .. } if *exponent == half);
    let all = g.reachable(&[e]).into_iter().filter(is_root);
    let roots = all.filter(|&root| g.contains_any(root, constants));
    let negated: Vec<(Expr, Expr)> = roots.map(|root| (root, g.neg(root))).collect();
    g.substitute(e, &negated)
}

/// What vanishes where a momentum is one of two roots `a ± b`, polynomial in what b² is: `b² − (momentum − a)²`.
fn either_root(g: &Graph, [root, other]: [Expr; 2], momentum: Expr) -> Expr {
    if root == other {
        return g.sub(root, momentum);
    }
    let half = |e: Expr| g.div(e, g.integer(2));
    let (middle, apart) = (half(g.add(&[root, other])), half(g.sub(root, other)));
    let off = g.sub(momentum, middle);
    g.sub(g.mul(&[apart, apart]), g.mul(&[off, off]))
}

struct Comparison<'b> {
    g: &'b Graph,
    integral: &'b CompleteIntegral,
    samples: Samples,
    /// The coordinates of the quadratures, their symbols, and the integrands: both roots of the equation for a momentum.
    own: Vec<(usize, Symbol, [Expr; 2])>,
    parameters: Vec<(Symbol, f64)>,
    coordinates: Vec<Symbol>,
    time: Symbol,
    /// Symbols for the momenta.
    momenta: Vec<Symbol>,
}

/// A stretch of rows, with the signs of the momenta by quadrature.
struct Stretch {
    first: usize,
    last: usize,
    signs: Vec<f64>,
}

impl<'b> Comparison<'b> {
    fn new(cx: &'b Context<'_>, integral: &'b CompleteIntegral) -> Result<Self, NotCompared> {
        let (system, g) = (cx.system, &cx.system.graph);
        let momenta = momenta_on_motions(cx).ok_or(NotCompared::Kappa)?;
        let positions: Vec<Expr> = system.coordinates.iter().map(|c| c.q).collect();
        let samples = Samples::new(cx, &[&positions, &momenta]).map_err(NotCompared::Samples)?;
        let evidence = evidence(cx).ok_or(NotCompared::Motion)?;
        let own = integral.quadratures.iter();
        Ok(Comparison {
            g,
            integral,
            samples,
            own: own
                .map(|&(i, e)| {
                    let other = opposite_root(g, e, &integral.constants);
                    (i, system.coordinates[i].q_symbol, [e, other])
                })
                .collect(),
            parameters: evidence.binding.parameters.clone(),
            coordinates: system.coordinate_symbols(),
            time: g.intern_symbol("t", 0),
            momenta: system
                .coordinates
                .iter()
                .map(|c| g.intern_symbol(&unused_name(system, &format!("momentum_{}", c.name)), 0))
                .collect(),
        })
    }

    fn compare(&self, stretch: &Stretch) -> Result<Quadratures, NotCompared> {
        let constants = self.constants(stretch.first)?;
        let (first, last) = self.between_meetings(stretch, &constants)?;
        let stride = (last - first).div_ceil(MOST);
        let rows: Vec<usize> = (first..=last).step_by(stride).collect();
        let residual = self.change(&rows, &constants, 1)?;
        // The constants of the same motion at the other end differ by its error alone.
        let again = self.constants(last)?;
        let others = [
            self.change(&rows, &constants, 2)?,
            self.change(&rows, &again, 1)?,
        ];
        let open = others.iter().map(|x| (x - residual).abs());
        let names = self.integral.constants.iter();
        let times = &self.samples.times;
        Ok(Quadratures {
            constants: names
                .map(|&s| self.g.symbol_text(s))
                .zip(constants)
                .collect(),
            residual,
            open: open.fold(0.0, f64::max),
            rows: rows.len() as u32,
            interval: (times[rows[0]], times[rows[rows.len() - 1]]),
        })
    }

    /// The largest `|β(t) − β(t₀)|` over the sizes of its terms, with a rule of Gauss on so many equal parts between two rows.
    fn change(&self, rows: &[usize], constants: &[f64], parts: u32) -> Result<f64, NotCompared> {
        let outside = self
            .g
            .gradient(self.integral.action, &self.integral.constants);
        let integrands: Vec<Vec<Expr>> = self
            .roots(rows[0], constants)?
            .iter()
            .map(|&e| self.g.gradient(e, &self.integral.constants))
            .collect();
        let start = self.at_row(&outside, rows[0], constants)?;
        let count = constants.len();
        let (mut sums, mut sizes) = (vec![0.0; count], vec![0.0_f64; count]);
        let mut residual = 0.0_f64;
        for pair in rows.windows(2) {
            for (place, integrand) in integrands.iter().enumerate() {
                let part =
                    self.between(integrand, place, (pair[0], pair[1]), (constants, parts))?;
                for (j, value) in part.into_iter().enumerate() {
                    sums[j] += value;
                    sizes[j] += value.abs();
                }
            }
            let now = self.at_row(&outside, pair[1], constants)?;
            for j in 0..count {
                let size = sizes[j] + now[j].abs() + start[j].abs();
                if size > 0.0 {
                    residual = residual.max((now[j] - start[j] + sums[j]).abs() / size);
                }
            }
        }
        Ok(residual)
    }

    /// The longest part of a stretch on which no two roots for a momentum meet. Where they are opposites they do so where it vanishes.
    fn between_meetings(
        &self,
        stretch: &Stretch,
        constants: &[f64],
    ) -> Result<(usize, usize), NotCompared> {
        let g = self.g;
        let middles = self.own.iter().filter_map(|&(i, symbol, [root, other])| {
            let middle = g.div(g.add(&[root, other]), g.integer(2));
            let outside = g.diff(self.integral.action, symbol);
            (root != other && !g.is_zero(middle)).then(|| (i, g.add(&[outside, middle])))
        });
        let middles: Vec<(usize, Expr)> = middles.collect();
        let (mut first, mut last) = (stretch.first, stretch.last);
        for (i, middle) in middles {
            let off = |row: usize| -> Result<f64, NotCompared> {
                Ok(self.samples.at(1, row)[i] - self.at_row(&[middle], row, constants)?[0])
            };
            let offs: Vec<f64> = (first..=last).map(off).collect::<Result<_, _>>()?;
            let largest = offs.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let is_same = |a: &f64, b: &f64| {
                a.signum() == b.signum() && a.abs().min(b.abs()) > TURNING * largest
            };
            let runs = offs.chunk_by(is_same).scan(first, |at, run| {
                let start = *at;
                *at += run.len();
                Some((start, start + run.len() - 1))
            });
            let longest = runs.max_by_key(|(start, end)| end - start);
            (first, last) = longest.unwrap_or((first, first));
        }
        if last - first >= FEWEST {
            Ok((first, last))
        } else {
            Err(NotCompared::Meeting)
        }
    }

    /// The roots that are the momenta at a row. The one written need not be: with `L = −q'²/2` it is negative.
    fn roots(&self, row: usize, constants: &[f64]) -> Result<Vec<Expr>, NotCompared> {
        let of = |&(i, symbol, [root, other]): &(usize, Symbol, [Expr; 2])| {
            let outside = self.g.diff(self.integral.action, symbol);
            let values = self.at_row(&[root, other, outside], row, constants)?;
            let momentum = self.samples.at(1, row)[i] - values[2];
            let is_first = (momentum - values[0]).abs() <= (momentum - values[1]).abs();
            Ok(if is_first { root } else { other })
        };
        self.own.iter().map(of).collect()
    }

    /// The longest stretch on which no momentum that is found by a quadrature comes near zero.
    fn stretch(&self) -> Result<Stretch, NotCompared> {
        let rows = self.samples.times.len();
        let momentum = |place: usize, row: usize| self.samples.at(1, row)[self.own[place].0];
        let sizes: Vec<f64> = (0..self.own.len())
            .map(|place| (0..rows).fold(0.0, |m: f64, row| m.max(momentum(place, row).abs())))
            .collect();
        let signs = |row: usize| -> Option<Vec<f64>> {
            let of = |place: usize| {
                let p = momentum(place, row);
                (p.abs() > TURNING * sizes[place]).then_some(p.signum())
            };
            (0..self.own.len()).map(of).collect()
        };
        let mut best: Option<Stretch> = None;
        let mut open: Option<Stretch> = None;
        for row in 0..rows {
            let here = signs(row);
            open = match (open.take(), here) {
                (Some(stretch), Some(signs)) if stretch.signs == signs => Some(Stretch {
                    last: row,
                    ..stretch
                }),
                (_, Some(signs)) => Some(Stretch {
                    first: row,
                    last: row,
                    signs,
                }),
                (_, None) => None,
            };
            if let Some(found) = &open {
                let length = |s: &Stretch| s.last - s.first;
                if best.as_ref().is_none_or(|b| length(found) > length(b)) {
                    best = Some(Stretch {
                        signs: found.signs.clone(),
                        ..*found
                    });
                }
            }
        }
        match best {
            Some(stretch) if stretch.last - stretch.first >= FEWEST => Ok(stretch),
            _ => Err(NotCompared::Turning),
        }
    }

    fn value<'c>(
        &'c self,
        row: usize,
        constants: &'c [f64],
        moved: &'c [(Symbol, f64)],
    ) -> impl Fn(Symbol) -> Option<f64> + 'c {
        move |s: Symbol| {
            let place = |list: &[Symbol]| list.iter().position(|&own| own == s);
            if let Some((_, x)) = moved.iter().find(|(own, _)| *own == s) {
                return Some(*x);
            }
            if s == self.time {
                return Some(self.samples.times[row]);
            }
            let position = place(&self.coordinates).map(|i| self.samples.at(0, row)[i]);
            let constant = || place(&self.integral.constants).map(|j| constants[j]);
            let known = self.parameters.iter().find(|(own, _)| *own == s);
            position.or_else(constant).or(known.map(|(_, x)| *x))
        }
    }

    fn at_row(&self, es: &[Expr], row: usize, constants: &[f64]) -> Result<Vec<f64>, NotCompared> {
        self.finite(es, &self.value(row, constants, &[]))
    }

    fn finite(
        &self,
        es: &[Expr],
        value: &dyn Fn(Symbol) -> Option<f64>,
    ) -> Result<Vec<f64>, NotCompared> {
        let values = self.g.evaluate_f64(es, value);
        let values = values?;
        if values.iter().all(|x| x.is_finite()) {
            Ok(values)
        } else {
            Err(NotCompared::Value)
        }
    }

    /// `∫ ∂g/∂α dq` over one coordinate from its value at a row to that at another, on so many equal parts.
    fn between(
        &self,
        integrand: &[Expr],
        place: usize,
        (from, to): (usize, usize),
        (constants, parts): (&[f64], u32),
    ) -> Result<Vec<f64>, NotCompared> {
        let (i, symbol, _) = self.own[place];
        let (a, b) = (self.samples.at(0, from)[i], self.samples.at(0, to)[i]);
        let half = (b - a) / 2.0 / f64::from(parts);
        let mut sums = vec![0.0; integrand.len()];
        for part in 0..parts {
            let middle = a + half * f64::from(2 * part + 1);
            for (x, weight) in GAUSS.iter().flat_map(|&(x, w)| [(x, w), (-x, w)]) {
                let at = [(symbol, middle + half * x)];
                let values = self.finite(integrand, &self.value(from, constants, &at))?;
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += half * weight * value;
                }
            }
        }
        Ok(sums)
    }

    /// The constants that give the momenta at a row: one of the roots g_e is `π_e − ∂action/∂q_e`, and `∂action/∂q = π` for the others, by
    /// steps of Gauss and Newton. Those that motions fix stay at their values.
    fn constants(&self, row: usize) -> Result<Vec<f64>, NotCompared> {
        let g = self.g;
        let slopes = g.gradient(self.integral.action, &self.coordinates);
        let momenta = self.samples.at(1, row);
        let residuals: Vec<Expr> = (0..self.coordinates.len())
            .map(|i| {
                let left = g.sub(g.symbol_expr(self.momenta[i]), slopes[i]);
                let own = self.own.iter().find(|(own, _, _)| *own == i);
                own.map_or(left, |&(_, _, roots)| either_root(g, roots, left))
            })
            .collect();
        let fixed: Vec<(Expr, Expr)> = self
            .integral
            .motion
            .iter()
            .map(|&(s, value)| (g.symbol_expr(s), value))
            .collect();
        let residuals = g.substitute_all(&residuals, &fixed);
        let is_fixed = |s: &Symbol| self.integral.motion.iter().any(|(own, _)| own == s);
        let all = self.integral.constants.iter().enumerate();
        let free: Vec<(usize, Symbol)> = all
            .filter(|(_, s)| !is_fixed(s))
            .map(|(j, &s)| (j, s))
            .collect();
        let symbols: Vec<Symbol> = free.iter().map(|&(_, s)| s).collect();
        let slopes = g.jacobian(&residuals, &symbols).concat();
        let known: Vec<(Symbol, f64)> = self
            .momenta
            .iter()
            .copied()
            .zip(momenta.iter().copied())
            .collect();
        let sizes = self.sizes();
        let system = ConstantEquations {
            slopes: &slopes,
            residuals: &residuals,
            free: &free,
            known: &known,
            row,
            sizes: &sizes,
        };
        let natural = self.natural(&system);
        let found = [0.0, 1.0, 10.0, 100.0].into_iter().find_map(|guess| {
            let start = natural.iter().map(|size| guess * size).collect();
            self.met(&system, start)
        });
        let mut constants = found.ok_or(NotCompared::Constants)?;
        for &(s, value) in &self.integral.motion {
            let at = self.at_row(&[value], row, &constants)?[0];
            if let Some(j) = self.integral.constants.iter().position(|&own| own == s) {
                constants[j] = at;
            }
        }
        Ok(constants)
    }

    /// What the residuals are measured by: the largest values of their momenta along the motion, squared for two roots.
    fn sizes(&self) -> Vec<f64> {
        let rows = self.samples.times.len();
        let largest = |i: usize| {
            let values = (0..rows).map(|row| self.samples.at(1, row)[i].abs());
            values.fold(0.0, f64::max)
        };
        let of_all = (0..self.coordinates.len()).map(largest).fold(0.0, f64::max);
        let of = |i: usize| {
            // What is rounding beside the others has no size of its own.
            let own = largest(i);
            let own = if own > 1e-13 * of_all { own } else { of_all };
            let has_two = |(at, _, [a, b]): &(usize, Symbol, [Expr; 2])| *at == i && a != b;
            if own == 0.0 {
                1.0
            } else if self.own.iter().any(has_two) {
                own * own
            } else {
                own
            }
        };
        (0..self.coordinates.len()).map(of).collect()
    }

    /// Changes of the constants that move the residuals by about their sizes, where all constants are zero.
    fn natural(&self, system: &ConstantEquations<'_>) -> Vec<f64> {
        let zeros = vec![0.0; self.integral.constants.len()];
        let mut natural = vec![1.0; zeros.len()];
        if let Some((_, rows)) = self.linearized(system, &zeros) {
            let lengths = column_lengths(&rows, system.free.len());
            for (&(j, _), length) in system.free.iter().zip(lengths) {
                natural[j] = 1.0 / length;
            }
        }
        natural
    }

    /// The residuals over their sizes and their slopes by the free constants; `None` where they have no value.
    fn linearized(
        &self,
        system: &ConstantEquations<'_>,
        constants: &[f64],
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        let value = self.value(system.row, constants, system.known);
        let mut left = self.finite(system.residuals, &value).ok()?;
        let mut rows = self.finite(system.slopes, &value).ok()?;
        let width = system.free.len().max(1);
        for ((x, row), size) in left
            .iter_mut()
            .zip(rows.chunks_mut(width))
            .zip(system.sizes)
        {
            *x /= size;
            row.iter_mut().for_each(|slope| *slope /= size);
        }
        Some((left, rows))
    }

    /// Steps of Gauss and Newton from a guess, in residuals over their sizes and constants over what moves these by one.
    fn met(&self, system: &ConstantEquations<'_>, mut constants: Vec<f64>) -> Option<Vec<f64>> {
        let k = system.free.len();
        for _ in 0..STEPS {
            let (left, mut rows) = self.linearized(system, &constants)?;
            if left.iter().all(|x| x.abs() <= MET) {
                return Some(constants);
            }
            let lengths = column_lengths(&rows, k);
            let mut normal = vec![0.0; k * k];
            let mut right = vec![0.0; k];
            for (row, x) in rows.chunks_mut(k).zip(&left) {
                row.iter_mut().zip(&lengths).for_each(|(s, l)| *s /= l);
                for i in 0..k {
                    right[i] -= row[i] * x;
                    for j in 0..k {
                        normal[i * k + j] += row[i] * row[j];
                    }
                }
            }
            (0..k).for_each(|i| normal[i * k + i] += RIDGE * k as f64);
            let step = solved(k, &normal, &right)?;
            let mut is_still = true;
            for ((&(j, _), step), length) in system.free.iter().zip(step).zip(&lengths) {
                let step = step / length;
                constants[j] += step;
                is_still &= step.abs() <= STILL * constants[j].abs();
            }
            // A momentum that is rounding alone has no size of its own.
            if is_still {
                return Some(constants);
            }
        }
        None
    }
}

/// The equations for the constants of a motion at a row.
struct ConstantEquations<'s> {
    residuals: &'s [Expr],
    /// Their slopes by the free constants, row after row.
    slopes: &'s [Expr],
    /// The constants sought, with their places among all.
    free: &'s [(usize, Symbol)],
    /// The momenta with their values.
    known: &'s [(Symbol, f64)],
    row: usize,
    /// What the residuals are measured by.
    sizes: &'s [f64],
}

/// The lengths of the columns of a matrix with rows of this width; one for a column of zeros.
fn column_lengths(rows: &[f64], width: usize) -> Vec<f64> {
    let length = |j: usize| {
        let squares = rows.iter().skip(j).step_by(width.max(1)).map(|x| x * x);
        let length = squares.sum::<f64>().sqrt();
        if length > 0.0 && length.is_finite() {
            length
        } else {
            1.0
        }
    };
    (0..width).map(length).collect()
}
