//! States of rest and steady rotations anywhere, at which the divergence does not vanish.
//!
//! Angles on which nothing depends are left out; where the rest of the motion stands still, its closure is a torus of such angles, and a
//! smooth positive density is bounded there. As the divergence is constant on it, it has to vanish. The states are found by Newton's
//! iteration in double precision and proved to exist by its interval form, for the values that the model states of its parameters.

use super::angles::closed_angles;
use super::excluded::{rest, vanishes};
use super::Flow;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::sample::Generator;
use chetaev_mechanics::Context;
use chetaev_symbolic::zero::assumptions::{Assumptions, Relation};
use chetaev_symbolic::zero::{decide_zero, refuted_near, Options, ZeroTest};
use chetaev_symbolic::{Expr, Function, Graph, Node, Symbol, Verdict};
use std::collections::BTreeMap;

/// Starts of the iteration, its steps, and where the starts begin to be drawn.
const STARTS: usize = 24;
const STEPS: usize = 40;
const SEED: u64 = 0x72_65_73_74;

/// Larger systems, in nodes of their derivatives, are not looked at.
const NODES: usize = 20_000;

/// Field operations to see that equations follow from others, and how often that is asked.
const ROOM: u64 = 20_000_000;
const QUESTIONS: usize = 3;

/// Equations are met to this, and pivots and divergences below these are taken for zero.
const MET: f64 = 1e-11;
const PIVOT: f64 = 1e-6;
const TINY: f64 = 1e-7;

/// Equations of states that are looked for, at the values of the parameters.
struct Sought {
    equations: Vec<Expr>,
    unknowns: Vec<Symbol>,
    divergence: Expr,
    /// What the states are.
    sentence: String,
    /// Of which system they are, where it has parameters.
    valued: &'static str,
}

type Point = BTreeMap<Symbol, f64>;

/// A refutation by such a state.
pub(super) fn refuted(cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
    if flow.chart.implicit().next().is_some() {
        return None;
    }
    let turning: Vec<usize> = closed_angles(cx)
        .into_iter()
        .filter(|&j| is_left_out(cx, flow, j))
        .collect();
    let at_rest = at_rest(cx, flow, &turning).and_then(|sought| sought.refuted(cx, flow));
    at_rest.or_else(|| steady(cx, flow, &turning).refuted(cx, flow))
}

/// Whether neither rates nor the divergence depend on a coordinate.
fn is_left_out(cx: &Context<'_>, flow: &Flow<'_>, j: usize) -> bool {
    let (g, own) = (&cx.system.graph, cx.system.coordinates[j].q_symbol);
    let all = flow.field().into_iter().chain([flow.divergence]);
    let mut with = all.filter(|&e| g.contains_any(e, &[own]));
    with.all(|e| vanishes(cx, g.diff(e, own)))
}

/// States without velocities, where these keep all coordinates.
fn at_rest(cx: &Context<'_>, flow: &Flow<'_>, turning: &[usize]) -> Option<Sought> {
    let (system, g) = (cx.system, &cx.system.graph);
    let state = rest(flow, system);
    let velocities = g.substitute_all(&flow.chart.velocities, &state);
    if !velocities.into_iter().all(|e| vanishes(cx, e)) {
        return None;
    }
    let mut sought = steady(cx, flow, turning);
    let own = flow.symbols();
    sought.unknowns.retain(|s| !own.contains(s));
    let equations = g.substitute_all(&sought.equations, &state).into_iter();
    sought.equations = equations.filter(|&e| !vanishes(cx, e)).collect();
    // Of what cancels at rest nothing is seen there: whether it is smooth is asked of the motion nearby.
    let is_smooth = smooth_where(g, &flow.field()).into_iter();
    let mut at_rest = is_smooth.map(|e| g.substitute(e, &state));
    let corner = at_rest.any(|e| g.is_zero(e));
    sought.divergence = g.substitute(sought.divergence, &state);
    sought.sentence = "the system may stay at rest at the place stated".into();
    (!corner && !sought.equations.is_empty()).then_some(sought)
}

/// States that are kept but for angles that are left out.
fn steady(cx: &Context<'_>, flow: &Flow<'_>, turning: &[usize]) -> Sought {
    let (system, g) = (cx.system, &cx.system.graph);
    let places = (0..system.n()).filter(|j| !turning.contains(j));
    let mut equations: Vec<Expr> = places.clone().map(|j| flow.chart.velocities[j]).collect();
    equations.extend(&flow.rates);
    equations.extend(flow.masses.iter().map(|(_, rate)| *rate));
    let mut unknowns: Vec<Symbol> = places.map(|j| system.coordinates[j].q_symbol).collect();
    unknowns.extend(flow.symbols());
    unknowns.extend(flow.masses.iter().map(|(mass, _)| *mass));
    let values = system.parameter_values();
    let mut equations = g.substitute_all(&equations, &values);
    equations.retain(|&e| !g.is_zero(e));
    let names = turning.iter().map(|&j| system.coordinates[j].name.as_str());
    let names: Vec<&str> = names.collect();
    let sentence = match names.is_empty() {
        true => "the motion does not leave the state stated".to_owned(),
        false => format!(
            "the motion is steady at the state stated, where at most {} turns",
            names.join(", ")
        ),
    };
    Sought {
        equations,
        unknowns,
        divergence: g.substitute(flow.divergence, &values),
        sentence,
        valued: match values.is_empty() {
            true => "",
            false => ", for the values of the parameters that the model states",
        },
    }
}

/// What must not vanish where expressions are smooth, besides what they are divided by.
fn smooth_where(g: &Graph, es: &[Expr]) -> Vec<Expr> {
    let one = g.one();
    let conditions = g.reachable(es).into_iter().filter_map(|e| match g.node(e) {
        Node::Power { base, exponent } => {
            let is_whole = g.as_integer(*exponent).is_some_and(|n| n >= 0);
            let is_number = g.as_number(*base).is_some();
            (!is_whole && !is_number).then_some(*base)
        }
        Node::Apply {
            function,
            arguments,
        } => match function {
            Function::Sign | Function::Abs | Function::Atan2 => Some(arguments[0]),
            Function::Asin | Function::Acos | Function::Acosh => {
                Some(g.sub(one, g.powi(arguments[0], 2)))
            }
            _ => None,
        },
        _ => None,
    });
    conditions.collect()
}

impl Sought {
    fn refuted(&self, cx: &Context<'_>, flow: &Flow<'_>) -> Option<Verdict> {
        let g = &cx.system.graph;
        let own: Vec<Symbol> = self.unknowns.clone();
        let jacobian: Vec<Expr> = self
            .equations
            .iter()
            .flat_map(|&e| g.gradient(e, &own))
            .collect();
        let all = [&self.equations[..], &jacobian, &[self.divergence]].concat();
        if self.unknowns.is_empty() || g.reachable(&all).len() > NODES {
            return None;
        }
        let conditions = self.conditions(cx, flow);
        let mut asked: Vec<Vec<(usize, usize)>> = Vec::new();
        let mut generator = Generator::new(SEED);
        (0..STARTS).find_map(|start| {
            if cx.is_out_of_time() {
                return None;
            }
            let mut point = self.start(cx, start, &mut generator);
            let slopes = self.solve(g, &all, &mut point)?;
            let divergence = *values(g, &[self.divergence], &point)?.first()?;
            let pivots = pivots(&slopes, self.equations.len(), self.unknowns.len());
            let fails = divergence.abs() < TINY || asked.contains(&pivots);
            if fails || asked.len() > QUESTIONS || !self.others_follow(cx, &pivots) {
                asked.extend((!fails).then_some(pivots));
                return None;
            }
            let found = self.verified(g, &conditions, &pivots, &point)?;
            flow.refuted_as_stated.set(true);
            Some(found)
        })
    }

    /// The assumptions of the model, at the values of the parameters, and that the motion is smooth and masses have not vanished.
    fn conditions(&self, cx: &Context<'_>, flow: &Flow<'_>) -> Assumptions {
        let (system, g) = (cx.system, &cx.system.graph);
        let values = system.parameter_values();
        let mut list = Assumptions::new();
        for a in assumptions(system).list() {
            let [left, right] = [a.left, a.right].map(|e| g.substitute(e, &values));
            list.assume(left, a.relation, right);
        }
        let mut smooth = smooth_where(g, &flow.field());
        if !flow.symbols().iter().any(|s| self.unknowns.contains(s)) {
            smooth = g.substitute_all(&smooth, &rest(flow, system));
        }
        // A mass that has vanished has no motion.
        let masses = flow.masses.iter().map(|(mass, _)| g.symbol_expr(*mass));
        for e in smooth.into_iter().chain(masses) {
            list.assume(g.substitute(e, &values), Relation::NotEqual, g.zero());
        }
        list
    }

    /// Values to begin with: zeros first, then ever larger ones. What is not sought keeps its value.
    fn start(&self, cx: &Context<'_>, number: usize, generator: &mut Generator) -> Point {
        let (system, g) = (cx.system, &cx.system.graph);
        let all = [&self.equations[..], &[self.divergence]].concat();
        let assumed = system.assumptions.iter().flat_map(|a| [a.left, a.right]);
        let symbols = g.symbols_in(&all.into_iter().chain(assumed).collect::<Vec<Expr>>());
        let reach = [0.0, 1.0, 3.0, 10.0][number.div_ceil(8)];
        let others = symbols.into_iter().filter(|s| !self.unknowns.contains(s));
        let mut point: Point = others.map(|s| (s, generator.between(0.5, 2.0))).collect();
        for &s in &self.unknowns {
            point.insert(s, generator.between(-1.0, 1.0) * reach);
        }
        point
    }

    /// Leads a point to a solution by steps of least length; the slopes there.
    fn solve(&self, g: &Graph, all: &[Expr], point: &mut Point) -> Option<Vec<f64>> {
        let (rows, columns) = (self.equations.len(), self.unknowns.len());
        for _ in 0..STEPS {
            let found = values(g, all, point)?;
            let (residuals, slopes) = (&found[..rows], &found[rows..rows + rows * columns]);
            if residuals.iter().all(|r| r.abs() < MET) {
                return Some(slopes.to_vec());
            }
            let step = least_step(residuals, slopes, columns)?;
            for (symbol, by) in self.unknowns.iter().zip(step) {
                point.entry(*symbol).and_modify(|x| *x -= by);
            }
        }
        None
    }

    /// Whether the equations without a pivot hold wherever those with one do; asked with little room, as most do not.
    fn others_follow(&self, cx: &Context<'_>, pivots: &[(usize, usize)]) -> bool {
        let is_taken = |i: &usize| pivots.iter().any(|(row, _)| row == i);
        let others = (0..self.equations.len()).filter(|i| !is_taken(i));
        let others: Vec<Expr> = others.map(|i| self.equations[i]).collect();
        let test = ZeroTest {
            residuals: &others,
            solved: &[],
            implicit: &self.pairs(pivots),
            assumptions: &Assumptions::new(),
            options: Options {
                seed: cx.prover.points_seed(),
                budget: ROOM,
                refute: false,
                ..Options::default()
            },
        };
        let follow = || decide_zero(&cx.system.graph, &test);
        others.is_empty() || matches!(follow(), Verdict::Proved(_))
    }

    fn pairs(&self, pivots: &[(usize, usize)]) -> Vec<(Expr, Symbol)> {
        let pair = |&(row, column): &(usize, usize)| (self.equations[row], self.unknowns[column]);
        pivots.iter().map(pair).collect()
    }

    fn verified(
        &self,
        g: &Graph,
        conditions: &Assumptions,
        pivots: &[(usize, usize)],
        point: &Point,
    ) -> Option<Verdict> {
        let pairs = self.pairs(pivots);
        let near = |s: Symbol| point.get(&s).copied();
        let mut found = refuted_near(g, self.divergence, &pairs, conditions, &near)?;
        "the divergence of the motion".clone_into(&mut found.quantity);
        let (low, high) = &found.residual;
        let size = match low == high {
            true => format!("is {low}"),
            false => format!("lies between {low} and {high}"),
        };
        found.detail = format!(
            "{}, and the divergence of the motion, which would have to vanish there, {size}: no smooth positive density free of the time exists{}; where numbers are enclosed one state between them is proved to exist by the interval Newton operator",
            self.sentence, self.valued
        );
        Some(Verdict::Refuted(found))
    }
}

fn values(g: &Graph, es: &[Expr], point: &Point) -> Option<Vec<f64>> {
    let found = g.evaluate_f64(es, &|s| point.get(&s).copied()).ok()?;
    found.iter().all(|v| v.is_finite()).then_some(found)
}

/// `Jᵀ (J Jᵀ + ε)⁻¹ F`.
fn least_step(residuals: &[f64], slopes: &[f64], columns: usize) -> Option<Vec<f64>> {
    let rows = residuals.len();
    let row = |i: usize| &slopes[i * columns..(i + 1) * columns];
    let product = |i: usize, j: usize| row(i).iter().zip(row(j)).map(|(a, b)| a * b).sum::<f64>();
    let size = (0..rows).map(|i| product(i, i)).fold(0.0, f64::max);
    let mut matrix: Vec<Vec<f64>> = (0..rows)
        .map(|i| {
            let shift = |j: usize| if i == j { 1e-13 * size } else { 0.0 };
            let mut line: Vec<f64> = (0..rows).map(|j| product(i, j) + shift(j)).collect();
            line.push(residuals[i]);
            line
        })
        .collect();
    for i in 0..rows {
        let pivot = (i..rows).max_by(|&a, &b| matrix[a][i].abs().total_cmp(&matrix[b][i].abs()))?;
        matrix.swap(i, pivot);
        let line = matrix[i].clone();
        if line[i] == 0.0 {
            return None;
        }
        for (_, other) in matrix.iter_mut().enumerate().filter(|(j, _)| *j != i) {
            let factor = other[i] / line[i];
            other
                .iter_mut()
                .zip(&line)
                .for_each(|(a, b)| *a -= factor * b);
        }
    }
    let multipliers: Vec<f64> = (0..rows).map(|i| matrix[i][rows] / matrix[i][i]).collect();
    let step = (0..columns).map(|c| (0..rows).map(|i| row(i)[c] * multipliers[i]).sum());
    Some(step.collect())
}

/// Independent rows of a matrix with columns in which they are regular, largest pivots first.
fn pivots(slopes: &[f64], rows: usize, columns: usize) -> Vec<(usize, usize)> {
    let mut matrix: Vec<Vec<f64>> = slopes.chunks(columns).map(<[f64]>::to_vec).collect();
    let mut found: Vec<(usize, usize)> = Vec::new();
    while found.len() < rows.min(columns) {
        let free = (0..rows).filter(|i| !found.iter().any(|(row, _)| row == i));
        let entries = free.flat_map(|i| (0..columns).map(move |c| (i, c)));
        let size = |&(i, c): &(usize, usize)| matrix[i][c].abs();
        let Some((i, c)) = entries.max_by(|a, b| size(a).total_cmp(&size(b))) else {
            break;
        };
        if size(&(i, c)) < PIVOT {
            break;
        }
        let line = matrix[i].clone();
        found.push((i, c));
        for (j, other) in matrix.iter_mut().enumerate() {
            if !found.iter().any(|(row, _)| *row == j) {
                let factor = other[c] / line[c];
                other
                    .iter_mut()
                    .zip(&line)
                    .for_each(|(a, b)| *a -= factor * b);
            }
        }
    }
    found
}
