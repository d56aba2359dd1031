//! The dependent data of constraints at a point: existence and uniqueness by the interval Newton operator.
//!
//! For F: ℝ^r → ℝ^r and a box X around m, N(X) = m − J(X)^{−1} F(m). If N(X) lies in the interior of X, F has exactly
//! one zero in X, and it lies in N(X) (A. Neumaier, *Interval Methods for Systems of Equations*, 1990, Theorem 5.1.7).

use crate::graph::Graph;
use crate::node::{Expr, Symbol};
use crate::number::ball::{self, Ball, Magnitude, Precision};

/// Steps of Newton's iteration before a start is given up.
const STEPS: usize = 60;

/// A system of constraints for as many dependent symbols.
#[derive(Debug)]
pub(super) struct System<'g> {
    graph: &'g Graph,
    constraints: Vec<Expr>,
    unknowns: Vec<Symbol>,
    /// Row by row, ∂f_i/∂x_j.
    jacobian: Vec<Expr>,
}

impl<'g> System<'g> {
    /// The system f_i = 0 for the symbols.
    pub(super) fn new(graph: &'g Graph, constraints: &[(Expr, Symbol)]) -> Self {
        let unknowns: Vec<Symbol> = constraints.iter().map(|(_, symbol)| *symbol).collect();
        let constraints: Vec<Expr> = constraints.iter().map(|(f, _)| *f).collect();
        let jacobian = constraints
            .iter()
            .flat_map(|f| graph.gradient(*f, &unknowns))
            .collect();
        Self {
            graph,
            constraints,
            unknowns,
            jacobian,
        }
    }

    /// A box of balls that contains exactly one solution, near the solution Newton's iteration finds from `start`.
    pub(super) fn solve(
        &self,
        precision: &Precision,
        data: &dyn Fn(Symbol) -> Option<Ball>,
        start: &[f64],
    ) -> Option<Vec<Ball>> {
        let mut center: Vec<Ball> = start
            .iter()
            .map(|x| Ball::from_f64(*x))
            .collect::<Option<_>>()?;
        let goal = -(precision.bits() as i64) / 2;
        for _ in 0..STEPS {
            let step = self.step(precision, data, &center, &center)?;
            let size = step
                .iter()
                .map(|s| s.midpoint().log2_ceil().unwrap_or(i64::MIN))
                .max()?;
            if size > 60 {
                return None;
            }
            center = self.minus(precision, &center, &step)?;
            if size < goal {
                return self.verify(precision, data, &center, size);
            }
        }
        None
    }

    /// Applies the Newton operator to boxes around `center`, the first a little wider than the last step.
    fn verify(
        &self,
        precision: &Precision,
        data: &dyn Fn(Symbol) -> Option<Ball>,
        center: &[Ball],
        last_step: i64,
    ) -> Option<Vec<Ball>> {
        let floor = -(precision.bits() as i64) + 16;
        for widening in [4, 12, 24] {
            let radius = Magnitude::power_of_two(last_step.max(floor) + widening);
            let wide: Vec<Ball> = center.iter().map(|c| c.clone().widened(radius)).collect();
            let Some(step) = self.step(precision, data, center, &wide) else {
                continue;
            };
            let exact: Option<Vec<Ball>> = center
                .iter()
                .zip(&step)
                .map(|(c, s)| precision.sub(c, s).ok())
                .collect();
            let image = exact?;
            if image
                .iter()
                .zip(&wide)
                .all(|(inner, outer)| outer.contains_in_interior(inner))
            {
                return Some(image);
            }
        }
        None
    }

    /// J(box)^{−1} F(center).
    fn step(
        &self,
        precision: &Precision,
        data: &dyn Fn(Symbol) -> Option<Ball>,
        center: &[Ball],
        region: &[Ball],
    ) -> Option<Vec<Ball>> {
        let at = |values: &[Ball]| {
            let values = values.to_vec();
            move |symbol: Symbol| match self.unknowns.iter().position(|&unknown| unknown == symbol)
            {
                Some(index) => values.get(index).cloned(),
                None => data(symbol),
            }
        };
        let values = self
            .graph
            .enclose(&self.constraints, precision, &at(center))
            .ok()?;
        let jacobian = self
            .graph
            .enclose(&self.jacobian, precision, &at(region))
            .ok()?;
        ball::solve(precision, self.unknowns.len(), jacobian, &[values])
            .ok()?
            .pop()
    }

    /// The midpoints of center − step.
    fn minus(&self, precision: &Precision, center: &[Ball], step: &[Ball]) -> Option<Vec<Ball>> {
        center
            .iter()
            .zip(step)
            .map(|(c, s)| precision.sub(c, s).ok().map(|x| x.midpoint()))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_real_root_of_a_cubic_is_enclosed() {
        // z'^3 + z' − x'y' has one real root; for x' = 2, y' = 5 it is 2.
        let g = Graph::new();
        let [x, y, z] = ["x", "y", "z"].map(|name| g.symbol(name, 1));
        let f = g.add(&[g.powi(z, 3), z, g.neg(g.mul(&[x, y]))]);
        let unknown = g.intern_symbol("z", 1);
        let system = System::new(&g, &[(f, unknown)]);
        let precision = Precision::new(200);
        let data = |symbol: Symbol| {
            Some(Ball::integer(if g.symbol_name(symbol) == "x" {
                2
            } else {
                5
            }))
        };
        let root = system.solve(&precision, &data, &[1.0]).unwrap();
        assert!(root[0].contains(&Ball::integer(2)));
        assert!(root[0].radius() < Magnitude::power_of_two(-80));
    }

    #[test]
    fn no_root_and_double_roots_are_not_certified() {
        let g = Graph::new();
        let (x, unknown) = (g.symbol("x", 0), g.intern_symbol("x", 0));
        let precision = Precision::new(128);
        for f in [g.add(&[g.powi(x, 2), g.one()]), g.powi(x, 2)] {
            let system = System::new(&g, &[(f, unknown)]);
            for start in [0.5, -3.0, 10.0] {
                assert!(system.solve(&precision, &|_| None, &[start]).is_none());
            }
        }
    }
}
