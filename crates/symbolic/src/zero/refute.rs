//! Verified counterexamples (T6 §6.4): rational independent data, dependent data enclosed with existence and uniqueness,
//! and a residual whose enclosure excludes zero.

use std::cell::OnceCell;
use std::cmp::Ordering;

use rustc_hash::FxHashMap;

use super::approach::Approach;
use super::assumptions::{as_pi_number, Assumptions};
use super::enclose::EncloseError;
use super::newton::System;
use crate::graph::Graph;
use crate::node::{Expr, Node, Symbol};
use crate::number::ball::{self, Ball, BallError, Precision};
use crate::number::random::Random;
use crate::rational::{self, Rational};
use crate::verdict::{Counterexample, PointValue};

/// What to look for a counterexample to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Claim<'a> {
    /// These are claimed to be zero.
    pub(super) residuals: &'a [Expr],
    /// On these constraints, each with the symbol it determines.
    pub(super) constraints: &'a [(Expr, Symbol)],
    /// Symbols already eliminated, with the expressions that replaced them: printed with the point.
    pub(super) solved: &'a [(Symbol, Expr)],
    /// Under these assumptions.
    pub(super) assumptions: &'a Assumptions,
}

/// What the search brought.
#[derive(Clone, Debug)]
pub(super) enum Search {
    /// A point where the claim fails.
    Found(Box<Counterexample>),
    /// At every point evaluated the residuals are zero to this precision; how many points, and the largest bound of a residual.
    Vanishing {
        points: u32,
        largest: f64,
        bits: usize,
    },
    /// No point could be evaluated.
    NoPoint,
}

/// Points tried.
const POINTS: u32 = 24;
/// So many times as many data are tried when points are hard to find.
const TRIES: u32 = 8;
/// Bits of the first evaluation at a point; they are increased as long as it is not decided.
const FIRST_PRECISION: usize = 96;
/// Evaluations at one point.
const MOST_PRECISIONS: u32 = 6;
/// A residual enclosed in a ball around zero of radius 2^−ENOUGH is taken to vanish at the point.
const ENOUGH: usize = 400;
/// Bits times nodes of one evaluation.
const MOST_BITS: usize = 600_000_000;
/// Bits of one evaluation in which functions other than roots occur: their series cost the square of them, and
/// `exp` of a large number in a residual that cancels would ask for as many bits as the number is large.
const MOST_BITS_OF_SERIES: usize = 24_000;
/// Evaluating less than this many nodes at every precision is cheap; beyond it fewer points are tried.
const CHEAP: usize = 20_000;
/// For less than this many nodes more points cost nothing that is noticed.
const TINY: usize = 300;
/// Numbers a person can check by hand.
const SMALL: [(i64, i64); 20] = [
    (1, 1),
    (2, 1),
    (3, 1),
    (1, 2),
    (-1, 1),
    (-2, 1),
    (3, 2),
    (2, 3),
    (1, 3),
    (5, 2),
    (-1, 2),
    (4, 1),
    (-3, 1),
    (5, 1),
    (1, 4),
    (3, 4),
    (-3, 2),
    (4, 3),
    (-1, 3),
    (7, 2),
];
/// Data that were led to constraints are rounded to multiples of 1/this.
const ROUNDED_TO: f64 = 1024.0;
/// What one point on constraints may mix: factors of numerators and of denominators of those numbers.
const MIXED: [(i64, i64); 5] = [(1, 1), (4, 1), (16, 1), (1, 16), (1, 128)];

/// Looks for a point where a residual is not zero.
pub(super) fn search(graph: &Graph, claim: &Claim<'_>, seed: u64) -> Search {
    let mut hunt = Hunt::new(graph, claim, seed);
    let points = match graph.reachable(claim.residuals).len() {
        nodes if nodes > CHEAP => POINTS / 6,
        nodes if nodes < TINY => 3 * POINTS,
        _ => POINTS,
    };
    let (mut vanishing, mut largest) = (0, 0.0_f64);
    // On a bounded variety many data have no real solution above them: those attempts are cheap and do not count.
    for attempt in 0..TRIES * points {
        if vanishing >= points {
            break;
        }
        // Where guesses alone bring nothing, every other point is led to the constraints.
        let led = !claim.constraints.is_empty()
            && vanishing == 0
            && attempt >= points
            && attempt % 2 == 1;
        match hunt.attempt(attempt, led) {
            Attempt::Found(counterexample) => return Search::Found(counterexample),
            Attempt::Vanishes(bound) => {
                vanishing += 1;
                largest = largest.max(bound);
            }
            Attempt::Unusable => {}
        }
    }
    match vanishing {
        0 => Search::NoPoint,
        points => Search::Vanishing {
            points,
            largest,
            bits: ENOUGH,
        },
    }
}

/// A point near a given one where constraints hold and the residual is not zero: the independent data are rounded, the dependent
/// ones enclosed.
pub(super) fn near(
    graph: &Graph,
    claim: &Claim<'_>,
    near: &dyn Fn(Symbol) -> Option<f64>,
) -> Option<Counterexample> {
    let hunt = Hunt::new(graph, claim, 0);
    let data = hunt.independent.iter().map(|&symbol| {
        let numerator = (near(symbol)? * ROUNDED_TO).round();
        let is_small = numerator.abs() < 1e15;
        is_small.then(|| (symbol, ratio(numerator as i64, ROUNDED_TO as i64)))
    });
    let data: Vec<(Symbol, Rational)> = data.collect::<Option<_>>()?;
    let dependent = claim.constraints.iter().map(|&(_, symbol)| near(symbol));
    match hunt.attempt_at(&data, &dependent.collect::<Option<Vec<f64>>>()?) {
        Attempt::Found(found) => Some(*found),
        _ => None,
    }
}

/// Is the square matrix regular at some point with small rational data? Verified by elimination in balls.
pub(super) fn is_regular_somewhere(
    graph: &Graph,
    matrix: &[Expr],
    assumptions: &Assumptions,
    precision: &Precision,
    seed: u64,
) -> bool {
    let claim = Claim {
        residuals: matrix,
        constraints: &[],
        solved: &[],
        assumptions,
    };
    let mut hunt = Hunt::new(graph, &claim, seed);
    let size = matrix.len().isqrt();
    (0..POINTS / 4).any(|attempt| {
        let data = hunt.data(attempt);
        let Some(point) = hunt.point(precision, &data, &[]) else {
            return false;
        };
        let Ok(values) = hunt.evaluate(precision, matrix, &point) else {
            return false;
        };
        hunt.assumptions_hold(precision, &point)
            && ball::solve(precision, size, values, &[]).is_ok()
    })
}

enum Attempt {
    Found(Box<Counterexample>),
    Vanishes(f64),
    Unusable,
}

struct Hunt<'a> {
    graph: &'a Graph,
    claim: &'a Claim<'a>,
    independent: Vec<Symbol>,
    system: System<'a>,
    /// Made where it is needed.
    approach: OnceCell<Option<Approach<'a>>>,
    random: Random,
    /// At most so many bits are used at a point.
    most_bits: usize,
}

impl<'a> Hunt<'a> {
    fn new(graph: &'a Graph, claim: &'a Claim<'a>, seed: u64) -> Self {
        let mut roots = claim.residuals.to_vec();
        roots.extend(claim.constraints.iter().map(|(f, _)| *f));
        roots.extend(
            claim
                .assumptions
                .list()
                .iter()
                .flat_map(|a| [a.left, a.right]),
        );
        // Of the eliminated symbols too, so that the whole point can be stated.
        roots.extend(claim.solved.iter().map(|(_, e)| *e));
        let dependent = |symbol: &Symbol| claim.constraints.iter().any(|(_, s)| s == symbol);
        let eliminated = |symbol: &Symbol| claim.solved.iter().any(|(s, _)| s == symbol);
        let mut independent = graph.symbols_in(&roots);
        independent.retain(|symbol| !dependent(symbol) && !eliminated(symbol));
        let nodes = graph.reachable(claim.residuals);
        let has_series = nodes
            .iter()
            .any(|&e| matches!(graph.node(e), Node::Apply { .. }));
        let of_series = match has_series {
            true => MOST_BITS_OF_SERIES,
            false => usize::MAX,
        };
        Self {
            graph,
            claim,
            independent,
            most_bits: of_series.min(MOST_BITS / nodes.len().max(1)),
            system: System::new(graph, claim.constraints),
            approach: OnceCell::new(),
            random: Random::stream(seed, 0xc0de),
        }
    }

    fn attempt(&mut self, attempt: u32, led: bool) -> Attempt {
        let mut data = self.data(attempt);
        let mut start: Vec<f64> = self
            .claim
            .constraints
            .iter()
            .map(|_| self.random.between(-40, 40) as f64 / 8.0 + 0.1)
            .collect();
        if led && !self.lead(&mut data, &mut start) {
            return Attempt::Unusable;
        }
        self.attempt_at(&data, &start)
    }

    /// At the solution of the constraints near `start`, for these independent data.
    fn attempt_at(&self, data: &[(Symbol, Rational)], start: &[f64]) -> Attempt {
        let mut bits = FIRST_PRECISION;
        let mut bound = None;
        for _ in 0..MOST_PRECISIONS {
            let precision = Precision::new(bits);
            let Some(point) = self.point(&precision, data, start) else {
                break;
            };
            if !self.assumptions_hold(&precision, &point) {
                break;
            }
            let mut wanted = 2 * bits + 64;
            match self.evaluate(&precision, self.claim.residuals, &point) {
                Ok(values) => {
                    if let Some(index) = values.iter().position(Ball::excludes_zero) {
                        let report = self.report(&precision, data, &point, index, &values[index]);
                        return Attempt::Found(Box::new(report));
                    }
                    let width = values
                        .iter()
                        .filter_map(|v| v.radius().log2_ceil())
                        .max()
                        .unwrap_or(i64::MIN);
                    if width < -(ENOUGH as i64) {
                        bound = Some(
                            values
                                .iter()
                                .map(|v| v.upper().to_f64().abs().max(v.lower().to_f64().abs()))
                                .fold(0.0, f64::max),
                        );
                        break;
                    }
                    // So many bits were lost; the same loss is expected again.
                    let lost = usize::try_from(width.saturating_add(bits as i64)).unwrap_or(0);
                    wanted = wanted.max(lost + ENOUGH + 32);
                }
                Err(EncloseError::Ball(BallError::Uncertain(_))) => {}
                Err(_) => break,
            }
            if wanted > self.most_bits {
                break;
            }
            bits = wanted;
        }
        bound.map_or(Attempt::Unusable, Attempt::Vanishes)
    }

    /// Moves independent data and the start of the dependent ones to the constraints; what is moved is rounded.
    fn lead(&self, data: &mut [(Symbol, Rational)], start: &mut [f64]) -> bool {
        let dependent = || self.claim.constraints.iter().map(|(_, symbol)| *symbol);
        let exact = data.iter().map(|(s, value)| (*s, rational::to_f64(value)));
        let mut point: FxHashMap<Symbol, f64> = exact
            .chain(dependent().zip(start.iter().copied()))
            .collect();
        let before = point.clone();
        let approach = (self.approach)
            .get_or_init(|| Approach::new(self.graph, self.claim.constraints))
            .as_ref();
        if !approach.is_some_and(|approach| approach.lead(&mut point)) {
            return false;
        }
        for (symbol, value) in data {
            if point[symbol] != before[symbol] {
                let numerator = (point[symbol] * ROUNDED_TO).round();
                if numerator.abs() > 1e15 {
                    return false;
                }
                *value = ratio(numerator as i64, ROUNDED_TO as i64);
            }
        }
        for (start, symbol) in start.iter_mut().zip(dependent()) {
            *start = point[&symbol];
        }
        true
    }

    fn data(&mut self, attempt: u32) -> Vec<(Symbol, Rational)> {
        self.independent
            .clone()
            .into_iter()
            .map(|symbol| (symbol, self.choose(symbol, attempt)))
            .collect()
    }

    /// A small rational number within the simple bounds of the symbol.
    fn choose(&mut self, symbol: Symbol, attempt: u32) -> Rational {
        let (low, high) = self.bounds(symbol);
        // Small data lie within bounded varieties, and in the neighbourhood of one are the corners of roots.
        let scale = match (self.claim.constraints.is_empty(), attempt % 3) {
            (true, _) | (false, 0) => 1,
            (false, shrink) => 1 << (1 + shrink + attempt % 5),
        };
        let inside =
            |value: f64| low.is_none_or(|low| low < value) && high.is_none_or(|high| value < high);
        if attempt % 4 == 3 {
            // Zeros make large graphs easy to enclose, where they are allowed.
            for value in [0, 1] {
                if inside(value as f64) && self.random.below(3) > 0 {
                    return ratio(value, 1);
                }
            }
        }
        // Later attempts reach further into the list.
        let reach = (4 + attempt as usize).min(SMALL.len());
        let wide = match (self.claim.constraints.is_empty(), attempt % 8) {
            (true, 5) => 512,
            (true, 6) => 32,
            _ => 1,
        };
        // On constraints some claims are false only far from the values at which most radicands are positive,
        // so that large and small data have to meet in one point.
        let (wide, scale) = match (self.claim.constraints.is_empty(), attempt % 9) {
            (false, 7 | 8) => MIXED[self.random.below(MIXED.len() as u64) as usize],
            _ => (wide, scale),
        };
        for _ in 0..16 {
            let (numerator, denominator) = SMALL[self.random.below(reach as u64) as usize];
            let numerator = numerator * wide;
            let denominator = denominator * scale;
            if inside(numerator as f64 / denominator as f64) {
                return ratio(numerator, denominator);
            }
        }
        let middle = match (low, high) {
            (Some(low), Some(high)) => low + (high - low) * (1 + self.random.below(7)) as f64 / 8.0,
            (Some(low), None) => low + self.random.between(1, 5) as f64 * step(low),
            (None, Some(high)) => high - self.random.between(1, 5) as f64 * step(high),
            (None, None) => 0.0,
        };
        // The coarsest dyadic fraction inside the bounds; in an interval of nanometres, or far from zero, a double as it is.
        for scale in [1.0, 2.0, 4.0, 8.0, 64.0, 1024.0, 1_048_576.0] {
            let numerator = (middle * scale).round();
            if inside(numerator / scale) && numerator.abs() < 1e15 {
                return ratio(numerator as i64, scale as i64);
            }
        }
        match rational::from_f64(middle) {
            Some(own) if inside(middle) => own,
            _ => Rational::ZERO,
        }
    }

    /// Bounds stated by assumptions that compare the symbol with a number or a multiple of π, for the choice only.
    fn bounds(&self, symbol: Symbol) -> (Option<f64>, Option<f64>) {
        let expression = self.graph.symbol_expr(symbol);
        let (mut low, mut high) = (None::<f64>, None::<f64>);
        for assumption in self.claim.assumptions.list() {
            let signs = assumption.relation.signs();
            for (side, bound, signs) in [
                (assumption.left, assumption.right, signs),
                (assumption.right, assumption.left, signs.negated()),
            ] {
                let Some((a, b)) = as_pi_number(self.graph, bound).filter(|_| side == expression)
                else {
                    continue;
                };
                let value = rational::to_f64(&a) + rational::to_f64(&b) * std::f64::consts::PI;
                if signs.is_nonnegative() {
                    low = Some(low.map_or(value, |x| x.max(value)));
                } else if signs.is_nonpositive() {
                    high = Some(high.map_or(value, |x| x.min(value)));
                }
            }
        }
        (low, high)
    }

    /// Balls for all symbols: the independent exact, the dependent with existence and uniqueness.
    fn point(
        &self,
        precision: &Precision,
        data: &[(Symbol, Rational)],
        start: &[f64],
    ) -> Option<FxHashMap<Symbol, Ball>> {
        let mut point: FxHashMap<Symbol, Ball> = data
            .iter()
            .map(|(symbol, value)| (*symbol, precision.rational(value)))
            .collect();
        if !self.claim.constraints.is_empty() {
            let roots =
                self.system
                    .solve(precision, &|symbol| point.get(&symbol).cloned(), start)?;
            point.extend(
                self.claim
                    .constraints
                    .iter()
                    .map(|(_, symbol)| *symbol)
                    .zip(roots),
            );
        }
        Some(point)
    }

    fn evaluate(
        &self,
        precision: &Precision,
        roots: &[Expr],
        point: &FxHashMap<Symbol, Ball>,
    ) -> Result<Vec<Ball>, EncloseError> {
        self.graph
            .enclose(roots, precision, &|symbol| point.get(&symbol).cloned())
    }

    fn assumptions_hold(&self, precision: &Precision, point: &FxHashMap<Symbol, Ball>) -> bool {
        self.claim.assumptions.list().iter().all(|assumption| {
            let difference = self.graph.sub(assumption.left, assumption.right);
            let Ok(values) = self.evaluate(precision, &[difference], point) else {
                return false;
            };
            values[0]
                .sign()
                .is_some_and(|sign: Ordering| assumption.relation.holds(sign))
        })
    }

    fn report(
        &self,
        precision: &Precision,
        data: &[(Symbol, Rational)],
        point: &FxHashMap<Symbol, Ball>,
        index: usize,
        residual: &Ball,
    ) -> Counterexample {
        let mut values: Vec<PointValue> = data
            .iter()
            .map(|(symbol, value)| PointValue {
                name: self.graph.symbol_text(*symbol),
                exact: Some(value.clone()),
                enclosure: None,
            })
            .collect();
        let enclosed = |symbol: Symbol, ball: &Ball| PointValue {
            name: self.graph.symbol_text(symbol),
            exact: None,
            enclosure: Some(ball.to_decimal_interval(12)),
        };
        values.extend(
            self.claim
                .constraints
                .iter()
                .filter_map(|(_, s)| point.get(s).map(|ball| enclosed(*s, ball))),
        );
        for (symbol, expression) in self.claim.solved {
            if let Ok(balls) = self.evaluate(precision, &[*expression], point) {
                values.push(enclosed(*symbol, &balls[0]));
            }
        }
        let quantity = match self.claim.residuals.len() {
            1 => "the residual".to_owned(),
            count => format!("residual {} of {count}", index + 1),
        };
        let (lower, upper) = residual.to_decimal_interval(10);
        let where_ = if lower == upper {
            format!("is {lower}")
        } else {
            format!("lies between {lower} and {upper}")
        };
        Counterexample {
            point: values,
            detail: format!(
                "{quantity} {where_}, not zero, at the point stated, in which variables that are not stated may have any value"
            ),
            quantity,
            residual: (lower, upper),
        }
    }
}

/// By how much one goes beyond a bound.
fn step(bound: f64) -> f64 {
    (bound.abs() / 8.0).max(1.0)
}

fn ratio(numerator: i64, denominator: i64) -> Rational {
    rational::ratio(numerator, denominator).unwrap_or(Rational::ZERO)
}
