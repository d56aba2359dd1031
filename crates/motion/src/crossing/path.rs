//! A piece of a motion in the smallest number of variables: coordinates and velocities that the constraints leave free, the
//! others by the constraints at every node.
//!
//! Where two sheets of the constraint set cross, the rank of the constraints falls on a thin set, and nowhere else on either sheet. The
//! motion on a sheet is as smooth there as anywhere: its equations in free variables have removable singularities alone.
//! Collocation at nodes away from the place of the crossing follows it across; the nodes of an even number lie symmetric about the
//! middle, and none in it.

use super::nodes::{lagrange, lagrange_slopes, Nodes};
use crate::accelerations::Accelerations;
use crate::chart::{self, Chart, Floor};
use crate::dense::Lu;
use crate::numeric::{Completion, NumericSystem};

/// Time, positions (coordinates, and masses with a law of their own) and velocities.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) t: f64,
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
}

/// A piece of the motion: states and accelerations at both ends and at the nodes between.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    pub(crate) start: f64,
    pub(crate) length: f64,
    places: Vec<f64>,
    /// (q, v, a) at the places.
    values: Vec<Vec<f64>>,
    positions: usize,
    n: usize,
}

/// Stages of the collocation, and of the one that tells its error.
const STAGES: usize = 8;
const FEWER: usize = 6;
/// Iterations of a collocation; each wins a factor of the step times the slope of the rates.
const MOST: usize = 80;
/// Newton steps for the dependent coordinates.
const NEWTON: usize = 12;
/// By so much the polynomials through the nodes may miss the start, relative to the largest value: what jumps to another sheet
/// between two nodes misses it by far more.
const SMOOTH: f64 = 1e-6;

/// Which coordinates and velocities follow from the others.
struct Charts {
    positions: Chart,
    velocities: Chart,
    /// Positions that are free.
    free: Vec<usize>,
}

/// What one collocation gives.
struct Collocated {
    /// (q, v, a) at the nodes.
    nodes: Vec<Vec<f64>>,
    /// (q, v, a) at the end.
    end: Vec<f64>,
}

impl Path {
    /// From a state over the time `length`, to within `accuracy` relative to the largest values; `None` where that is not reached, or where
    /// it is not smooth.
    pub(crate) fn new(
        system: &mut NumericSystem,
        from: &State,
        length: f64,
        accuracy: f64,
    ) -> Option<Path> {
        let charts = Charts::at(system, from)?;
        let mut solver = Solver {
            system,
            charts,
            accelerations: Accelerations::default(),
            completion: Completion::default(),
        };
        let first = solver.full(from)?;
        let found = solver.collocated(from, &first, length, STAGES)?;
        let rough = solver.collocated(from, &first, length, FEWER)?;
        let (n, positions) = (solver.system.n, solver.system.positions());
        let state = positions + n;
        let size = largest(&found.end[..state]).max(largest(&first[..state]));
        let apart = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            pairs.fold(0.0, |m: f64, (x, y)| m.max((x - y).abs()))
        };
        if apart(&found.end[..state], &rough.end[..state]) > accuracy * size {
            return None;
        }
        let nodes = Nodes::gauss(STAGES);
        let extrapolated = combined(&lagrange(&nodes.places, 0.0), &found.nodes);
        if apart(&extrapolated[..state], &first[..state]) > SMOOTH * size {
            return None;
        }
        let places = [&[0.0], &nodes.places[..], &[1.0]].concat();
        let values = [vec![first], found.nodes, vec![found.end]].concat();
        Some(Path {
            start: from.t,
            length,
            places,
            values,
            positions,
            n,
        })
    }

    /// The state at the part `theta` of the way.
    pub(crate) fn at(&self, theta: f64) -> State {
        let values = combined(&lagrange(&self.places, theta), &self.values);
        self.state(theta, &values)
    }

    /// The accelerations there, as the velocities change.
    pub(crate) fn accelerations(&self, theta: f64) -> Vec<f64> {
        let slopes = combined(&lagrange_slopes(&self.places, theta), &self.values);
        let v = &slopes[self.positions..self.positions + self.n];
        v.iter().map(|v| v / self.length).collect()
    }

    /// How far the polynomial through the nodes alone is from that through the ends too: about the error between nodes.
    pub(crate) fn uncertainty(&self, theta: f64) -> f64 {
        let last = self.places.len() - 1;
        let inner = &self.values[1..last];
        let rough = combined(&lagrange(&self.places[1..last], theta), inner);
        let state = self.at(theta);
        let pairs = state.q.iter().zip(&rough);
        pairs.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
    }

    /// The state at the end.
    pub(crate) fn end(&self) -> State {
        let last = self.values.last().cloned().unwrap_or_default();
        self.state(1.0, &last)
    }

    fn state(&self, theta: f64, values: &[f64]) -> State {
        State {
            t: self.start + theta * self.length,
            q: values[..self.positions].to_vec(),
            v: values[self.positions..self.positions + self.n].to_vec(),
        }
    }
}

fn combined(weights: &[f64], values: &[Vec<f64>]) -> Vec<f64> {
    let mut sum = vec![0.0; values.first().map_or(0, Vec::len)];
    for (w, value) in weights.iter().zip(values) {
        sum.iter_mut().zip(value).for_each(|(s, x)| *s += w * x);
    }
    sum
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m: f64, x| m.max(x.abs()))
}

impl Charts {
    fn at(system: &mut NumericSystem, at: &State) -> Option<Charts> {
        system.evaluate(at.t, &at.q, &at.v).ok()?;
        let (r, n, diagonal) = (system.r, system.n, system.mass_diagonal());
        let velocities = chart::choose(system.jacobian(), (r, n), &diagonal, Floor::Along(1.0));
        system.evaluate_positions(at.t, &at.q, &at.v).ok()?;
        let own = system.holonomic.len();
        let positions = chart::choose(
            system.position_gradient(),
            (own, n),
            &diagonal,
            Floor::Along(1.0),
        );
        let is_free = |i: &usize| !positions.dependent.contains(i);
        Some(Charts {
            free: (0..system.positions()).filter(is_free).collect(),
            velocities,
            positions,
        })
    }
}

struct Solver<'s> {
    system: &'s mut NumericSystem,
    charts: Charts,
    accelerations: Accelerations,
    completion: Completion,
}

impl Solver<'_> {
    /// (q, v, a) at a state that satisfies the constraints.
    fn full(&mut self, at: &State) -> Option<Vec<f64>> {
        self.system.evaluate(at.t, &at.q, &at.v).ok()?;
        let solved = self
            .accelerations
            .solve(self.system, &self.charts.velocities);
        solved.ok()?;
        let all = [&at.q[..], &at.v, &self.accelerations.a].concat();
        all.iter().all(|x| x.is_finite()).then_some(all)
    }

    /// The same where the dependent coordinates and velocities are only guessed.
    fn completed(&mut self, mut at: State) -> Option<Vec<f64>> {
        self.complete_positions(&mut at)?;
        let chart = &self.charts.velocities;
        if self.system.is_affine() {
            self.system
                .complete_velocities(at.t, &at.q, &mut at.v, chart, &mut self.completion)
                .ok()?
        } else {
            self.newton_velocities(&mut at)?
        }
        self.full(&at)
    }

    fn complete_positions(&mut self, at: &mut State) -> Option<()> {
        let chart = &self.charts.positions;
        let (n, size) = (self.system.n, chart.rows.len());
        if size == 0 {
            return Some(());
        }
        let mut lu = Lu::default();
        for _ in 0..NEWTON {
            self.system.evaluate_positions(at.t, &at.q, &at.v).ok()?;
            let gradient = self.system.position_gradient();
            let residual = self.system.position_residual();
            let (block, mut step) = block(chart, (gradient, residual), n);
            lu.factor(size, &block).ok()?;
            lu.solve(&mut step);
            for (&d, dx) in chart.dependent.iter().zip(&step) {
                at.q[d] -= dx;
            }
            if largest(&step) <= 4.0 * f64::EPSILON * largest(&at.q) {
                return Some(());
            }
        }
        // Where the block is nearly singular rounding keeps the steps from that size.
        (largest(self.system.position_residual()) <= 1e-13 * (1.0 + largest(&at.q))).then_some(())
    }

    fn newton_velocities(&mut self, at: &mut State) -> Option<()> {
        let chart = &self.charts.velocities;
        let (n, size) = (self.system.n, chart.rows.len());
        let mut lu = Lu::default();
        for _ in 0..NEWTON {
            self.system.evaluate(at.t, &at.q, &at.v).ok()?;
            let of = (self.system.jacobian(), self.system.residual());
            let (block, mut step) = block(chart, of, n);
            lu.factor(size, &block).ok()?;
            lu.solve(&mut step);
            for (&d, dx) in chart.dependent.iter().zip(&step) {
                at.v[d] -= dx;
            }
            if largest(&step) <= 4.0 * f64::EPSILON * largest(&at.v) {
                return Some(());
            }
        }
        (largest(self.system.residual()) <= 1e-12 * (1.0 + largest(&at.v))).then_some(())
    }

    /// The rates of the free positions and of the independent velocities.
    fn rates(&mut self, t: f64, full: &[f64]) -> Option<Vec<f64>> {
        let positions = self.system.positions();
        let (q, rest) = full.split_at(positions);
        let (v, a) = rest.split_at(self.system.n);
        let mut of_q = vec![0.0; positions];
        self.system.position_rates(t, q, v, &mut of_q).ok()?;
        let free = self.charts.free.iter().map(|&i| of_q[i]);
        let own = self.charts.velocities.independent.iter().map(|&i| a[i]);
        Some(free.chain(own).collect())
    }

    /// The free variables of (q, v).
    fn packed(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let free = self.charts.free.iter().map(|&i| q[i]);
        let own = self.charts.velocities.independent.iter().map(|&i| v[i]);
        free.chain(own).collect()
    }

    fn unpacked(&self, t: f64, y: &[f64], guess: &[f64]) -> State {
        let positions = self.system.positions();
        let mut q = guess[..positions].to_vec();
        let mut v = guess[positions..positions + self.system.n].to_vec();
        let (free, own) = y.split_at(self.charts.free.len());
        for (&i, &x) in self.charts.free.iter().zip(free) {
            q[i] = x;
        }
        for (&i, &x) in self.charts.velocities.independent.iter().zip(own) {
            v[i] = x;
        }
        State { t, q, v }
    }

    /// Fixed points of the collocation equations, begun where the accelerations are constant.
    fn collocated(
        &mut self,
        from: &State,
        first: &[f64],
        h: f64,
        stages: usize,
    ) -> Option<Collocated> {
        let nodes = Nodes::gauss(stages);
        let y0 = self.packed(&from.q, &from.v);
        let mut known: Vec<Vec<f64>> = Vec::new();
        let mut rates: Vec<Vec<f64>> = Vec::new();
        for &c in &nodes.places {
            let guess = self.with_constant_accelerations(from, first, c * h)?;
            let full = self.completed(guess)?;
            rates.push(self.rates(from.t + c * h, &full)?);
            known.push(full);
        }
        let (mut before, mut converged) = (f64::INFINITY, false);
        for _ in 0..MOST {
            let mut change: f64 = 0.0;
            let former = rates.clone();
            for (j, (&c, row)) in nodes.places.iter().zip(&nodes.coefficients).enumerate() {
                let y = advanced(&y0, h, row, &former);
                let at = self.unpacked(from.t + c * h, &y, &known[j]);
                let full = self.completed(at)?;
                let state = full.iter().zip(&known[j]).take(from.q.len() + from.v.len());
                change = state.fold(change, |m, (x, y)| m.max((x - y).abs()));
                rates[j] = self.rates(from.t + c * h, &full)?;
                known[j] = full;
            }
            let size = known.iter().fold(1e-300, |m: f64, x| m.max(largest(x)));
            let small = change <= 1e-13 * size;
            // Rounding, of which nothing is left to win.
            if change <= 4.0 * f64::EPSILON * size || small && change >= 0.5 * before {
                converged = true;
                break;
            }
            if !change.is_finite() {
                return None;
            }
            before = change;
        }
        if !converged {
            return None;
        }
        let y = advanced(&y0, h, &nodes.weights, &rates);
        let guess = combined(&lagrange(&nodes.places, 1.0), &known);
        let at = self.unpacked(from.t + h, &y, &guess);
        let end = self.completed(at)?;
        Some(Collocated { nodes: known, end })
    }

    fn with_constant_accelerations(
        &mut self,
        from: &State,
        first: &[f64],
        tau: f64,
    ) -> Option<State> {
        let n = self.system.n;
        let positions = self.system.positions();
        let a = &first[positions + n..];
        let mut rates = vec![0.0; positions];
        let (q, v) = (&from.q, &from.v);
        self.system.position_rates(from.t, q, v, &mut rates).ok()?;
        let bent = |i: usize| {
            a.get(i)
                .filter(|_| i < n)
                .map_or(0.0, |a| 0.5 * a * tau * tau)
        };
        Some(State {
            t: from.t + tau,
            q: (0..positions)
                .map(|i| from.q[i] + tau * rates[i] + bent(i))
                .collect(),
            v: (0..n).map(|i| from.v[i] + tau * a[i]).collect(),
        })
    }
}

fn advanced(y0: &[f64], h: f64, weights: &[f64], rates: &[Vec<f64>]) -> Vec<f64> {
    let mut y = y0.to_vec();
    for (w, rate) in weights.iter().zip(rates) {
        y.iter_mut().zip(rate).for_each(|(y, f)| *y += h * w * f);
    }
    y
}

/// The entries of the rows of a chart in its dependent columns, with their residuals.
fn block(chart: &Chart, (matrix, residual): (&[f64], &[f64]), n: usize) -> (Vec<f64>, Vec<f64>) {
    let entries = chart.rows.iter().flat_map(|&row| {
        let own = &matrix[row * n..(row + 1) * n];
        chart.dependent.iter().map(move |&d| own[d])
    });
    let right = chart.rows.iter().map(|&row| residual[row]);
    (entries.collect(), right.collect())
}
