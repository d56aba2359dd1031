//! Motions with forty digits, along which what is reported as an integral must keep its value.
//!
//! Power series in the time of `[[W, -Jᵀ], [J, 0]] (q'', λ) = (b, g)` with W, b, J, g as they are. Nothing of the search has a part in
//! it: neither its accelerations, which are formulas, nor its zero tests, nor prime fields; and a change in the twentieth digit is
//! seen, which rounding of double precision would hide.

use super::series::{over, Series};
use chetaev_mechanics::sample::Point;
use chetaev_mechanics::Context;
use chetaev_symbolic::number::ball::{solve, Ball, Precision};
use chetaev_symbolic::{Expr, Graph, Node, Symbol};

/// Bits of all numbers.
const BITS: usize = 176;

/// The order of the series.
const ORDER: usize = 26;

/// What a step leaves out has about the size 2^LEFT_OUT.
const LEFT_OUT: f64 = -96.0;

/// Of its size, an integral changes by less than 2^DRIFT.
const DRIFT: i64 = -70;

/// How many steps are made at most.
const STEPS: usize = 5;

/// How long motions are followed, unless they become fast: many run away in finite time.
const DURATION: f64 = 0.6;

/// Where a coordinate or velocity has so many times the size that it may have at first, a motion is not followed further.
const FAST: f64 = 30.0;

/// A motion of a system, of known parameters.
pub(super) struct Motion<'a> {
    g: &'a Graph,
    n: usize,
    r: usize,
    precision: Precision,
    /// Coordinates, velocities, the time.
    moving: Vec<Symbol>,
    point: Point,
    /// W, b, J, g.
    terms: Series,
    /// f, one for each independent constraint.
    constraints: Series,
}

impl<'a> Motion<'a> {
    /// The motion of the context's system from near a state; `None` where it contains functions that have no series here.
    pub(super) fn of(cx: &Context<'a>, start: &Point) -> Option<Motion<'a>> {
        let (system, terms, g) = (cx.system, cx.terms, &cx.system.graph);
        let rows = &cx.selection.rows;
        let mut outputs = terms.mass_matrix.concat();
        outputs.extend(&terms.force);
        rows.iter()
            .for_each(|&l| outputs.extend(&terms.jacobian[l]));
        outputs.extend(rows.iter().map(|&l| terms.constraint_rate[l]));
        let constraints: Vec<Expr> = rows.iter().map(|&l| terms.constraints[l]).collect();
        let coordinates = system.coordinates.iter();
        let mut moving: Vec<Symbol> = coordinates.clone().map(|c| c.q_symbol).collect();
        moving.extend(coordinates.map(|c| c.v_symbol));
        moving.push(g.intern_symbol("t", 0));
        let precision = Precision::new(BITS);
        let made = |es: &[Expr]| expressions(g, es, &precision, &moving, start);
        Some(Motion {
            terms: made(&outputs)?,
            constraints: made(&constraints)?,
            g,
            n: system.n(),
            r: rows.len(),
            precision: precision.clone(),
            point: start.clone(),
            moving: moving.clone(),
        })
    }

    /// Values of functions at the start and after each step: fewer than three where the motion is not defined or becomes fast at
    /// once.
    pub(super) fn along(&mut self, functions: &[Expr]) -> Option<Vec<Vec<Ball>>> {
        let mut values = expressions(
            self.g,
            functions,
            &self.precision,
            &self.moving,
            &self.point,
        )?;
        let mut state = self.start()?;
        let fast = state
            .iter()
            .fold(FAST, |fast, x| fast.max(FAST * x.to_f64().abs()));
        let end = state[2 * self.n].to_f64() + DURATION;
        let mut rows = vec![value_of(&mut values, &state)?];
        for _ in 0..STEPS {
            let Some(next) = self.step(&state) else { break };
            let size = next[..2 * self.n].iter();
            if size.fold(0.0_f64, |size, x| size.max(x.to_f64().abs())) > fast {
                break;
            }
            match value_of(&mut values, &next) {
                Some(row) => rows.push(row),
                None => break,
            }
            if next[2 * self.n].to_f64() > end {
                break;
            }
            state = next;
        }
        Some(rows)
    }

    /// The state in double precision, its velocities brought to the constraints by the least change.
    fn start(&mut self) -> Option<Vec<Ball>> {
        let value = |s: &Symbol| Ball::from_f64(self.point.get(s).copied().unwrap_or(0.0));
        let mut state: Vec<Ball> = self.moving.iter().map(value).collect::<Option<_>>()?;
        // Each round doubles the digits.
        for _ in 0..4 {
            let defect = value_of(&mut self.constraints, &state)?;
            let jacobian = self.jacobian(&state)?;
            let change = self.least(&jacobian, &defect)?;
            for (x, d) in state[self.n..].iter_mut().zip(change) {
                *x = self.precision.sub(x, &d).ok()?.midpoint();
            }
        }
        let defect = value_of(&mut self.constraints, &state)?;
        let is_small = |x: &Ball| x.log2_ceil().is_none_or(|e| e < 20 - BITS as i64);
        defect.iter().all(is_small).then_some(state)
    }

    fn jacobian(&mut self, state: &[Ball]) -> Option<Vec<Ball>> {
        let (n, r) = (self.n, self.r);
        let all = value_of(&mut self.terms, state)?;
        Some(all[n * n + n..n * n + n + r * n].to_vec())
    }

    /// Jᵀ (J Jᵀ)⁻¹ d.
    fn least(&self, jacobian: &[Ball], defect: &[Ball]) -> Option<Vec<Ball>> {
        let (n, r, p) = (self.n, self.r, &self.precision);
        let row = |l: usize| &jacobian[l * n..(l + 1) * n];
        let mut gram = Vec::with_capacity(r * r);
        for a in 0..r {
            for b in 0..r {
                gram.push(dot(p, row(a), row(b))?);
            }
        }
        let factors = solve(p, r, gram, &[defect.to_vec()]).ok()?.pop()?;
        let column = |i: usize| (0..r).map(move |l| jacobian[l * n + i].clone());
        (0..n)
            .map(|i| dot(p, &column(i).collect::<Vec<Ball>>(), &factors))
            .collect()
    }

    /// The state a step later.
    fn step(&mut self, state: &[Ball]) -> Option<Vec<Ball>> {
        let (n, p) = (self.n, self.precision.clone());
        let mut series: Vec<Vec<Ball>> = state.iter().map(|x| vec![x.clone()]).collect();
        self.terms.clear();
        let mut matrices: Vec<Vec<Ball>> = Vec::new();
        let mut solutions: Vec<Vec<Ball>> = Vec::new();
        let mut inverse = Vec::new();
        for order in 0..ORDER {
            let terms = self.terms.next(&series)?;
            let (matrix, mut right) = self.bordered(&terms);
            if order == 0 {
                inverse = self.inverse(&matrix)?;
            }
            matrices.push(matrix);
            // A₀ x_k = b_k - Σ_{j ≥ 1} A_j x_{k-j}.
            let size = right.len();
            for (row, b) in right.iter_mut().enumerate() {
                for j in 1..=order {
                    let entries = &matrices[j][row * size..(row + 1) * size];
                    let product = dot(&p, entries, &solutions[order - j])?;
                    *b = p.sub(b, &product).ok()?.midpoint();
                }
            }
            let rows = inverse.chunks(size);
            let solution: Vec<Ball> = rows
                .map(|row| dot(&p, row, &right))
                .collect::<Option<_>>()?;
            for i in 0..n {
                let rate = over(&p, &series[n + i][order], order + 1)?;
                series[i].push(rate);
                series[n + i].push(over(&p, &solution[i], order + 1)?);
            }
            series[2 * n].push(Ball::integer(i64::from(order == 0)));
            solutions.push(solution);
        }
        let step = Ball::from_f64(length(&series[..2 * n]))?;
        series.iter().map(|row| horner(&p, row, &step)).collect()
    }

    /// The bordered matrix and its right side, of coefficients of W, b, J, g.
    fn bordered(&self, terms: &[Ball]) -> (Vec<Ball>, Vec<Ball>) {
        let (n, r) = (self.n, self.r);
        let (mass, rest) = terms.split_at(n * n);
        let (force, rest) = rest.split_at(n);
        let (jacobian, rate) = rest.split_at(r * n);
        let mut matrix = Vec::with_capacity((n + r) * (n + r));
        for i in 0..n {
            matrix.extend_from_slice(&mass[i * n..(i + 1) * n]);
            matrix.extend((0..r).map(|l| jacobian[l * n + i].neg()));
        }
        for l in 0..r {
            matrix.extend_from_slice(&jacobian[l * n..(l + 1) * n]);
            matrix.extend(vec![Ball::zero(); r]);
        }
        (matrix, [force, rate].concat())
    }

    /// Row by row.
    fn inverse(&self, matrix: &[Ball]) -> Option<Vec<Ball>> {
        let size = self.n + self.r;
        let unit = |j: usize| (0..size).map(move |i| Ball::integer(i64::from(i == j)));
        let units: Vec<Vec<Ball>> = (0..size).map(|j| unit(j).collect()).collect();
        let columns = solve(&self.precision, size, matrix.to_vec(), &units).ok()?;
        let entry = |i: usize, j: usize| columns[j][i].midpoint();
        Some(
            (0..size)
                .flat_map(|i| (0..size).map(move |j| (i, j)))
                .map(|(i, j)| entry(i, j))
                .collect(),
        )
    }
}

fn expressions(
    g: &Graph,
    es: &[Expr],
    precision: &Precision,
    moving: &[Symbol],
    start: &Point,
) -> Option<Series> {
    let place = |s: Symbol| moving.iter().position(|&own| own == s);
    let fixed = |s: Symbol| start.get(&s).copied().and_then(Ball::from_f64);
    Series::of(g, es, precision, &place, &fixed)
}

/// Values at a state.
fn value_of(series: &mut Series, state: &[Ball]) -> Option<Vec<Ball>> {
    let given: Vec<Vec<Ball>> = state.iter().map(|x| vec![x.clone()]).collect();
    series.clear();
    series.next(&given)
}

fn dot(p: &Precision, a: &[Ball], b: &[Ball]) -> Option<Ball> {
    let mut sum = Ball::zero();
    for (x, y) in a.iter().zip(b) {
        sum = p.add(&sum, &p.mul(x, y).ok()?.midpoint()).ok()?.midpoint();
    }
    Some(sum)
}

fn horner(p: &Precision, row: &[Ball], step: &Ball) -> Option<Ball> {
    let start = Ball::zero();
    row.iter().rev().try_fold(start, |sum, c| {
        let product = p.mul(&sum, step).ok()?.midpoint();
        Some(p.add(&product, c).ok()?.midpoint())
    })
}

/// The step for which the last two coefficients are as small as asked for.
fn length(series: &[Vec<Ball>]) -> f64 {
    let mut least = DURATION;
    for order in [ORDER - 1, ORDER] {
        let sizes = series.iter().filter_map(|row| row[order].log2_ceil());
        if let Some(size) = sizes.max() {
            least = least.min(((LEFT_OUT - size as f64) / order as f64).exp2());
        }
    }
    least
}

/// The parts of a sum, whose sizes are the scale of rounding.
fn parts(g: &Graph, e: Expr) -> Vec<Expr> {
    match g.node(e) {
        Node::Sum { terms, .. } => terms.iter().map(|(part, c)| g.scale(c, *part)).collect(),
        _ => vec![e],
    }
}

/// Follows functions along a motion; whether it could be followed.
///
/// # Errors
/// A sentence that names a function that does not keep its value.
pub(super) fn followed(
    cx: &Context<'_>,
    start: &Point,
    functions: &[Expr],
) -> Result<bool, String> {
    let g = &cx.system.graph;
    let split: Vec<Vec<Expr>> = functions.iter().map(|&e| parts(g, e)).collect();
    let motion = Motion::of(cx, start);
    let rows = motion.and_then(|mut motion| motion.along(&split.concat()));
    let Some(rows) = rows.filter(|rows| rows.len() > 2) else {
        return Ok(false);
    };
    let p = Precision::new(BITS);
    let mut place = 0;
    for (&function, parts) in functions.iter().zip(&split) {
        let own = place..place + parts.len();
        place = own.end;
        let total = |row: &Vec<Ball>| {
            let mut parts = row[own.clone()].iter();
            parts.try_fold(Ball::zero(), |sum, x| p.add(&sum, x))
        };
        let totals: Result<Vec<Ball>, _> = rows.iter().map(total).collect();
        let totals = totals.map_err(|problem| problem.to_string())?;
        let sizes = rows.iter().flat_map(|row| &row[own.clone()]);
        let scale = sizes.filter_map(Ball::log2_ceil).fold(0, i64::max);
        for value in &totals[1..] {
            let change = p.sub(value, &totals[0]).map_err(|e| e.to_string())?;
            if change.log2_ceil().is_some_and(|e| e > scale + DRIFT) {
                let text = g.text(function);
                let change = change.to_f64();
                return Err(format!("{text} changes by {change:e} along a motion"));
            }
        }
    }
    Ok(true)
}
