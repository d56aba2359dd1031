//! Points near constraints, in double precision, by Gauss–Newton steps in all symbols.
//!
//! Where independent data are guessed, few of them may have a real solution above them: `x' = 40 √(1 + y'²)` has one in y'
//! for x' ≥ 40 only. Steps of least length move the independent data as well.

use rustc_hash::FxHashMap;

use crate::graph::Graph;
use crate::node::{Expr, Symbol};

/// Steps before a start is given up.
const STEPS: usize = 60;
/// So often a step that does not help is halved.
const HALVINGS: i32 = 8;
/// What the constraints may be left at; the rest is for Newton's iteration in the dependent data.
const CLOSE: f64 = 1e-6;
/// Nodes of constraints for which this is done.
const LARGEST: usize = 1000;

/// Constraints with their gradients by all symbols in them.
#[derive(Debug)]
pub(super) struct Approach<'g> {
    graph: &'g Graph,
    symbols: Vec<Symbol>,
    /// The constraints, then their gradients, one after another.
    functions: Vec<Expr>,
    count: usize,
}

impl<'g> Approach<'g> {
    /// `None` for constraints that would take long.
    pub(super) fn new(graph: &'g Graph, constraints: &[(Expr, Symbol)]) -> Option<Self> {
        let mut functions: Vec<Expr> = constraints.iter().map(|(f, _)| *f).collect();
        (graph.reachable(&functions).len() < LARGEST).then_some(())?;
        let symbols = graph.symbols_in(&functions);
        let gradients: Vec<Expr> = (functions.iter())
            .flat_map(|&f| graph.gradient(f, &symbols))
            .collect();
        functions.extend(gradients);
        Some(Self {
            graph,
            symbols,
            functions,
            count: constraints.len(),
        })
    }

    /// Moves the point to the constraints; says whether it got there.
    pub(super) fn lead(&self, point: &mut FxHashMap<Symbol, f64>) -> bool {
        let Some(mut values) = self.values(point) else {
            return false;
        };
        for _ in 0..STEPS {
            if self.distance(&values) < CLOSE {
                return true;
            }
            // Across the ridge of a root steps go to and fro; along it they go without the symbol that leads across.
            let kept = std::iter::once(None).chain((0..self.symbols.len()).map(Some));
            let better = kept
                .filter_map(|without| self.step(point, &values, without))
                .min_by(|(_, a), (_, b)| self.distance(a).total_cmp(&self.distance(b)));
            let Some((next, found)) = better else {
                return false;
            };
            (*point, values) = (next, found);
        }
        false
    }

    /// The point after one step, shortened until it helps, and the values there.
    fn step(
        &self,
        point: &FxHashMap<Symbol, f64>,
        values: &[f64],
        without: Option<usize>,
    ) -> Option<(FxHashMap<Symbol, f64>, Vec<f64>)> {
        let (f, gradients) = values.split_at(self.count);
        let mut gradients = gradients.to_vec();
        for row in gradients.chunks_mut(self.symbols.len().max(1)) {
            row.iter_mut()
                .enumerate()
                .filter(|(column, _)| Some(*column) == without)
                .for_each(|(_, entry)| *entry = 0.0);
        }
        let step = least_solution(&gradients, f, self.symbols.len());
        (0..HALVINGS).find_map(|halving| {
            let mut next = point.clone();
            for (symbol, change) in self.symbols.iter().zip(&step) {
                *next.get_mut(symbol)? -= change * 0.5_f64.powi(halving);
            }
            let found = self.values(&next)?;
            (self.distance(&found) < self.distance(values)).then_some((next, found))
        })
    }

    fn values(&self, point: &FxHashMap<Symbol, f64>) -> Option<Vec<f64>> {
        let at = |symbol| point.get(&symbol).copied();
        let values = self.graph.evaluate_f64(&self.functions, &at).ok()?;
        values.iter().all(|x| x.is_finite()).then_some(values)
    }

    fn distance(&self, values: &[f64]) -> f64 {
        values[..self.count].iter().map(|f| f.abs()).sum()
    }
}

/// The shortest x with `rows · x = f`, by orthogonal directions; rows that depend on others are left out.
fn least_solution(rows: &[f64], f: &[f64], n: usize) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut units: Vec<Vec<f64>> = Vec::new();
    let mut solution = vec![0.0; n];
    for (row, &target) in rows.chunks(n.max(1)).zip(f) {
        // What is found so far lies in the span of the units, so that later parts leave earlier equations as they are.
        let mut direction = row.to_vec();
        for unit in &units {
            let along = dot(&direction, unit);
            for (d, u) in direction.iter_mut().zip(unit) {
                *d -= along * u;
            }
        }
        let length = dot(&direction, &direction).sqrt();
        if length <= 1e-10 * dot(row, row).sqrt() || length == 0.0 {
            continue;
        }
        let part = (target - dot(row, &solution)) / length;
        direction.iter_mut().for_each(|d| *d /= length);
        for (x, u) in solution.iter_mut().zip(&direction) {
            *x += part * u;
        }
        units.push(direction);
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_solution_is_the_shortest() {
        // x + y = 2 and x - y + z = 0: the solutions (1, 1, 0) + s (-1, 1, 2) are shortest at s = 0.
        let found = least_solution(&[1.0, 1.0, 0.0, 1.0, -1.0, 1.0], &[2.0, 0.0], 3);
        for (x, expected) in found.iter().zip([1.0, 1.0, 0.0]) {
            assert!((x - expected).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn independent_data_are_moved_to_where_solutions_are() {
        let g = Graph::new();
        let [x, y] = ["x", "y"].map(|name| g.symbol(name, 1));
        let root = g.sqrt(g.add(&[g.one(), g.powi(y, 2)]));
        let f = g.sub(x, g.mul(&[g.integer(40), root]));
        let [sx, sy] = ["x", "y"].map(|name| g.intern_symbol(name, 1));
        let mut point: FxHashMap<Symbol, f64> = [(sx, 1.0), (sy, -2.0)].into_iter().collect();
        let approach = Approach::new(&g, &[(f, sy)]).unwrap();
        assert!(approach.lead(&mut point));
        let (x, y) = (point[&sx], point[&sy]);
        assert!((x - 40.0 * (1.0 + y * y).sqrt()).abs() < 1e-6, "{x} {y}");
    }
}
