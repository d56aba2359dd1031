//! Derivatives: derivations given by their values on symbols, gradients, Hessians, the total time derivative.

use crate::graph::Graph;
use crate::node::{Expr, Function, Node, Symbol};
use crate::rational::{self, Rational};
use rustc_hash::{FxHashMap, FxHashSet};

/// Products of more varying factors than this are differentiated by halves.
const MOST_VARYING: usize = 16;

impl Graph {
    /// The partial derivative `∂e/∂symbol`.
    pub fn diff(&self, e: Expr, symbol: Symbol) -> Expr {
        let one = self.one();
        self.derive(&[e], &|s| (s == symbol).then_some(one))
            .swap_remove(0)
    }

    /// The row of partial derivatives by several symbols.
    pub fn gradient(&self, e: Expr, symbols: &[Symbol]) -> Vec<Expr> {
        self.jacobian(&[e], symbols).swap_remove(0)
    }

    /// `∂eᵢ/∂symbolⱼ`, one row per expression.
    ///
    /// Each column costs time in proportion to what depends on its symbol, not to the whole graph.
    pub fn jacobian(&self, es: &[Expr], symbols: &[Symbol]) -> Vec<Vec<Expr>> {
        let one = self.one();
        let dependents = Dependents::below(self, es);
        let columns: Vec<Vec<Expr>> = symbols
            .iter()
            .map(|&symbol| {
                let nodes = dependents.of(self.symbol_expr(symbol));
                self.derive_in_order(&nodes, es, &|s| (s == symbol).then_some(one))
            })
            .collect();
        (0..es.len())
            .map(|i| columns.iter().map(|column| column[i]).collect())
            .collect()
    }

    /// The total derivative along a derivation: `Σ (∂e/∂s) · value(s)`; `None` stands for value zero.
    ///
    /// Linear solves are differentiated as solves with the same matrix: `A x' = b' - A' x`.
    pub fn derive(&self, es: &[Expr], value: &dyn Fn(Symbol) -> Option<Expr>) -> Vec<Expr> {
        self.derive_in_order(&self.reachable(es), es, value)
    }

    /// [`derive`](Graph::derive) where all that has a rate is among `nodes`, children before parents.
    fn derive_in_order(
        &self,
        nodes: &[Expr],
        es: &[Expr],
        value: &dyn Fn(Symbol) -> Option<Expr>,
    ) -> Vec<Expr> {
        let mut scalar: FxHashMap<Expr, Expr> = FxHashMap::default();
        let mut vector: FxHashMap<Expr, Vec<Expr>> = FxHashMap::default();
        for &e in nodes {
            match self.node(e) {
                Node::Matrix { entries, .. } => {
                    if entries.iter().any(|a| scalar.contains_key(a)) {
                        let rates = entries.iter().map(|a| self.rate(&scalar, *a)).collect();
                        vector.insert(e, rates);
                    }
                }
                Node::Solve { matrix, rhs } => {
                    if let Some(rates) = self.derive_solve(e, *matrix, rhs, &scalar, &vector) {
                        vector.insert(e, rates);
                    }
                }
                Node::Entry { of, index } => {
                    if let Some(rates) = vector.get(of) {
                        self.insert_rate(&mut scalar, e, rates[*index as usize]);
                    }
                }
                Node::Symbol(symbol) => {
                    if let Some(rate) = value(*symbol) {
                        self.insert_rate(&mut scalar, e, rate);
                    }
                }
                _ => {
                    if let Some(rate) = self.derive_node(e, &scalar) {
                        self.insert_rate(&mut scalar, e, rate);
                    }
                }
            }
        }
        es.iter().map(|e| self.rate(&scalar, *e)).collect()
    }

    fn rate(&self, scalar: &FxHashMap<Expr, Expr>, e: Expr) -> Expr {
        scalar.get(&e).copied().unwrap_or_else(|| self.zero())
    }

    fn insert_rate(&self, scalar: &mut FxHashMap<Expr, Expr>, e: Expr, rate: Expr) {
        if !self.is_zero(rate) {
            scalar.insert(e, rate);
        }
    }

    fn derive_solve(
        &self,
        solve: Expr,
        matrix: Expr,
        rhs: &[Expr],
        scalar: &FxHashMap<Expr, Expr>,
        vector: &FxHashMap<Expr, Vec<Expr>>,
    ) -> Option<Vec<Expr>> {
        let matrix_rates = vector.get(&matrix);
        if matrix_rates.is_none() && !rhs.iter().any(|b| scalar.contains_key(b)) {
            return None;
        }
        let n = rhs.len();
        let x: Vec<Expr> = (0..n as u32)
            .map(|index| self.intern(Node::Entry { of: solve, index }))
            .collect();
        let new_rhs: Vec<Expr> = (0..n)
            .map(|i| {
                let mut parts = vec![self.rate(scalar, rhs[i])];
                if let Some(rates) = matrix_rates {
                    for j in 0..n {
                        let a = rates[i * n + j];
                        if !self.is_zero(a) {
                            parts.push(self.neg(self.mul(&[a, x[j]])));
                        }
                    }
                }
                self.add(&parts)
            })
            .collect();
        if new_rhs.iter().all(|&b| self.is_zero(b)) {
            return None;
        }
        Some(self.solve_entries(matrix, &new_rhs))
    }

    fn derive_node(&self, e: Expr, scalar: &FxHashMap<Expr, Expr>) -> Option<Expr> {
        match self.node(e) {
            Node::Sum { terms, .. } => {
                let parts: Vec<Expr> = terms
                    .iter()
                    .filter_map(|(t, c)| scalar.get(t).map(|&d| self.scale(c, d)))
                    .collect();
                (!parts.is_empty()).then(|| self.add(&parts))
            }
            Node::Product {
                coefficient,
                factors,
            } => self.derive_product(coefficient, factors, scalar),
            Node::Power { base, exponent } => self.derive_power(e, *base, *exponent, scalar),
            Node::Apply {
                function: Function::Atan2,
                arguments,
            } => {
                let [y, x] = arguments[..] else { return None };
                if !scalar.contains_key(&y) && !scalar.contains_key(&x) {
                    return None;
                }
                let (dy, dx) = (self.rate(scalar, y), self.rate(scalar, x));
                let top = self.sub(self.mul(&[x, dy]), self.mul(&[y, dx]));
                let bottom = self.add(&[self.powi(x, 2), self.powi(y, 2)]);
                Some(self.div(top, bottom))
            }
            Node::Apply {
                function,
                arguments,
            } => {
                let x = *arguments.first()?;
                let dx = *scalar.get(&x)?;
                let slope = self.slope(*function, x, e)?;
                Some(self.mul(&[slope, dx]))
            }
            _ => None,
        }
    }

    fn derive_product(
        &self,
        coefficient: &Rational,
        factors: &[Expr],
        scalar: &FxHashMap<Expr, Expr>,
    ) -> Option<Expr> {
        if factors.iter().filter(|f| scalar.contains_key(f)).count() > MOST_VARYING {
            return self.derive_halves(coefficient, factors, scalar);
        }
        let mut parts = Vec::new();
        for (i, factor) in factors.iter().enumerate() {
            let Some(&rate) = scalar.get(factor) else {
                continue;
            };
            let mut product: Vec<Expr> = factors.to_vec();
            product[i] = rate;
            product.push(self.number(coefficient.clone()));
            parts.push(self.mul(&product));
        }
        (!parts.is_empty()).then(|| self.add(&parts))
    }

    /// `(A B)' = A' B + A B'` with the halves A and B: a product of k factors would become k products of k factors, and
    /// definitions nested in each other would grow with the cube of their number.
    fn derive_halves(
        &self,
        coefficient: &Rational,
        factors: &[Expr],
        scalar: &FxHashMap<Expr, Expr>,
    ) -> Option<Expr> {
        let (first, second) = factors.split_at(factors.len() / 2);
        let mut parts = Vec::with_capacity(2);
        for (half, other) in [(first, second), (second, first)] {
            if let Some(rate) = self.derive_product(&Rational::ONE, half, scalar) {
                let mut product = other.to_vec();
                product.push(rate);
                product.push(self.number(coefficient.clone()));
                parts.push(self.mul(&product));
            }
        }
        (!parts.is_empty()).then(|| self.add(&parts))
    }

    fn derive_power(
        &self,
        e: Expr,
        base: Expr,
        exponent: Expr,
        scalar: &FxHashMap<Expr, Expr>,
    ) -> Option<Expr> {
        let mut parts = Vec::new();
        if let Some(&rate) = scalar.get(&base) {
            let lowered = self.pow(base, self.sub(exponent, self.one()));
            parts.push(self.mul(&[exponent, lowered, rate]));
        }
        if let Some(&rate) = scalar.get(&exponent) {
            parts.push(self.mul(&[e, self.apply(Function::Log, &[base]), rate]));
        }
        (!parts.is_empty()).then(|| self.add(&parts))
    }

    /// `f'(x)`, written with `e = f(x)` where that is shorter.
    fn slope(&self, function: Function, x: Expr, e: Expr) -> Option<Expr> {
        use Function::*;
        let one = self.one();
        let square = |a: Expr| self.powi(a, 2);
        Some(match function {
            Sin => self.cos(x),
            Cos => self.neg(self.sin(x)),
            Tan => self.add(&[one, square(e)]),
            Cot => self.neg(self.add(&[one, square(e)])),
            Sec => self.mul(&[e, self.apply(Tan, &[x])]),
            Csc => self.neg(self.mul(&[e, self.apply(Cot, &[x])])),
            Asin => self.powi(self.sqrt(self.sub(one, square(x))), -1),
            Acos => self.neg(self.powi(self.sqrt(self.sub(one, square(x))), -1)),
            Atan => self.powi(self.add(&[one, square(x)]), -1),
            Sinh => self.apply(Cosh, &[x]),
            Cosh => self.apply(Sinh, &[x]),
            Tanh => self.sub(one, square(e)),
            Asinh => self.powi(self.sqrt(self.add(&[one, square(x)])), -1),
            Acosh => {
                let minus = self.sqrt(self.sub(x, one));
                let plus = self.sqrt(self.add(&[x, one]));
                self.powi(self.mul(&[minus, plus]), -1)
            }
            Atanh => self.powi(self.sub(one, square(x)), -1),
            Exp => e,
            Log => self.powi(x, -1),
            Abs => self.apply(Sign, &[x]),
            Sign => self.zero(),
            Atan2 => return None,
        })
    }

    /// The total time derivative along the jets: `∂/∂t + Σ s^(j+1) ∂/∂s^(j)` for the symbols whose name `moves` accepts.
    ///
    /// The symbol named `t` of order 0 is the time.
    pub fn total_derivative(&self, e: Expr, moves: &dyn Fn(&str) -> bool) -> Expr {
        let one = self.one();
        self.derive(&[e], &|s| {
            let (name, order) = (self.symbol_name(s), self.symbol_order(s));
            if name == "t" && order == 0 {
                Some(one)
            } else if moves(name) {
                Some(self.symbol(name, order + 1))
            } else {
                None
            }
        })
        .swap_remove(0)
    }

    /// Whether `e` is structurally free of every symbol `s` that `occurs` accepts.
    pub fn is_free_of(&self, e: Expr, occurs: &dyn Fn(Symbol) -> bool) -> bool {
        !self
            .reachable(&[e])
            .into_iter()
            .any(|n| self.as_symbol(n).is_some_and(occurs))
    }

    /// Whether any of `symbols` occurs in any of `es`, in one pass over all.
    pub fn any_contains_any(&self, es: &[Expr], symbols: &[Symbol]) -> bool {
        let wanted: FxHashSet<Symbol> = symbols.iter().copied().collect();
        self.reachable(es)
            .into_iter()
            .any(|n| self.as_symbol(n).is_some_and(|s| wanted.contains(&s)))
    }

    /// The number `r` when `e` is `r`; convenience over [`Graph::as_number`] for small integers.
    pub fn as_integer(&self, e: Expr) -> Option<i64> {
        self.as_number(e).and_then(rational::to_i64)
    }
}

/// Which nodes depend on which, for derivatives by many symbols.
struct Dependents {
    /// Ascending: children before parents.
    nodes: Vec<Expr>,
    /// The parents of node i are `parents[start[i]..start[i + 1]]`, by place.
    start: Vec<u32>,
    parents: Vec<u32>,
}

impl Dependents {
    fn below(g: &Graph, roots: &[Expr]) -> Dependents {
        let nodes = g.reachable(roots);
        let place = |e: Expr| nodes.binary_search(&e).unwrap_or_default();
        let mut edges: Vec<(u32, u32)> = Vec::new();
        for (i, &e) in nodes.iter().enumerate() {
            g.node(e)
                .for_each_child(|child| edges.push((place(child) as u32, i as u32)));
        }
        edges.sort_unstable();
        edges.dedup();
        let mut start = vec![0u32; nodes.len() + 1];
        for &(child, _) in &edges {
            start[child as usize + 1] += 1;
        }
        for i in 0..nodes.len() {
            start[i + 1] += start[i];
        }
        Dependents {
            nodes,
            start,
            parents: edges.into_iter().map(|(_, parent)| parent).collect(),
        }
    }

    /// `e` and all that depends on it, children before parents; empty where it does not occur.
    fn of(&self, e: Expr) -> Vec<Expr> {
        let Ok(first) = self.nodes.binary_search(&e) else {
            return Vec::new();
        };
        let mut seen = FxHashSet::default();
        seen.insert(first as u32);
        let mut found = vec![first as u32];
        let mut next = 0;
        while let Some(&i) = found.get(next) {
            next += 1;
            let above = self.start[i as usize] as usize..self.start[i as usize + 1] as usize;
            for &parent in &self.parents[above] {
                if seen.insert(parent) {
                    found.push(parent);
                }
            }
        }
        found.sort_unstable();
        found.into_iter().map(|i| self.nodes[i as usize]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn symbol(g: &Graph, name: &str) -> (Expr, Symbol) {
        (g.symbol(name, 0), g.intern_symbol(name, 0))
    }

    #[test]
    fn elementary_slopes_agree_with_differences() {
        let g = Graph::new();
        let (x, s) = symbol(&g, "x");
        for function in Function::ALL {
            if matches!(function, Function::Atan2 | Function::Sign) {
                continue;
            }
            // acosh needs x > 1, the other inverse functions |x| < 1.
            let at = if function == Function::Acosh {
                1.7
            } else {
                0.6
            };
            let f = g.apply(function, &[x]);
            let slope = g.diff(f, s);
            let value = |e: Expr, at: f64| g.evaluate_f64(&[e], &|_| Some(at)).unwrap()[0];
            let h = 1e-5;
            let difference = (value(f, at + h) - value(f, at - h)) / (2.0 * h);
            assert!(
                (value(slope, at) - difference).abs() < 1e-8,
                "{function:?}: {} against {difference}",
                value(slope, at)
            );
        }
    }

    #[test]
    fn powers_with_symbolic_exponents() {
        let g = Graph::new();
        let (x, s) = symbol(&g, "x");
        let e = g.pow(x, x);
        let expected = g.mul(&[e, g.add(&[g.one(), g.apply(Function::Log, &[x])])]);
        let values = g
            .evaluate_f64(&[g.diff(e, s), expected], &|_| Some(1.3))
            .unwrap();
        assert!((values[0] - values[1]).abs() < 1e-14);
    }

    #[test]
    fn total_derivative_walks_the_jet() {
        let g = Graph::new();
        let (q, v, a) = (g.symbol("q", 0), g.symbol("q", 1), g.symbol("q", 2));
        let t = g.symbol("t", 0);
        let e = g.mul(&[t, q, v]);
        let rate = g.total_derivative(e, &|name| name == "q");
        let expected = g.add(&[g.mul(&[q, v]), g.mul(&[t, g.powi(v, 2)]), g.mul(&[t, q, a])]);
        assert_eq!(rate, expected);
    }

    #[test]
    fn a_solve_is_differentiated_as_a_solve() {
        let g = Graph::new();
        let (x, s) = symbol(&g, "x");
        let y = g.symbol("y", 0);
        let solution = g
            .solve(&[g.sin(x), y, x, g.exp(x)], &[g.powi(x, 2), g.one()])
            .unwrap();
        let slope = g.diff(solution[1], s);
        let value = |e: Expr, at: f64| {
            let point = |symbol: Symbol| Some(if symbol == s { at } else { 0.3 });
            g.evaluate_f64(&[e], &point).unwrap()[0]
        };
        let h = 1e-5;
        let difference = (value(solution[1], 0.8 + h) - value(solution[1], 0.8 - h)) / (2.0 * h);
        assert!((value(slope, 0.8) - difference).abs() < 1e-7);
    }
}
