//! Vectors and rotations over a graph in which every name of the lowered model is a symbol.
//!
//! Nothing is expanded here: what has a name enters other expressions by that name, so that the text and the graph that
//! is read from it grow in proportion to the number of bodies.

use std::collections::BTreeSet;

use chetaev_symbolic::{Expr, Graph, Rational};

/// Three components.
pub(crate) type Vector = [Expr; 3];

/// A turn about a coordinate axis by an angle, right-handed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turn {
    /// 0, 1 or 2.
    pub(crate) axis: usize,
    /// The angle.
    pub(crate) angle: Expr,
}

/// The graph of the lowering, with what is known of its symbols.
#[derive(Debug, Default)]
pub(crate) struct Algebra {
    pub(crate) graph: Graph,
    /// Names that change along a motion.
    pub(crate) varying: BTreeSet<String>,
}

impl Algebra {
    pub(crate) fn zero(&self) -> Vector {
        [self.graph.zero(); 3]
    }

    /// The unit vector along an axis.
    pub(crate) fn unit(&self, axis: usize) -> Vector {
        let mut unit = self.zero();
        unit[axis] = self.graph.one();
        unit
    }

    pub(crate) fn symbol(&self, name: &str) -> Expr {
        self.graph.symbol(name, 0)
    }

    pub(crate) fn plus(&self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|i| self.graph.add(&[a[i], b[i]]))
    }

    pub(crate) fn minus(&self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|i| self.graph.sub(a[i], b[i]))
    }

    pub(crate) fn times(&self, factor: Expr, a: Vector) -> Vector {
        a.map(|component| self.graph.mul(&[factor, component]))
    }

    pub(crate) fn dot(&self, a: Vector, b: Vector) -> Expr {
        let terms: Vec<Expr> = (0..3).map(|i| self.graph.mul(&[a[i], b[i]])).collect();
        self.graph.add(&terms)
    }

    pub(crate) fn cross(&self, a: Vector, b: Vector) -> Vector {
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let graph = &self.graph;
            graph.sub(graph.mul(&[a[j], b[k]]), graph.mul(&[a[k], b[j]]))
        })
    }

    /// The components before a turn of a vector that is given after it: v ↦ R v.
    pub(crate) fn before(&self, turn: Turn, v: Vector) -> Vector {
        let graph = &self.graph;
        let (cos, sin) = (graph.cos(turn.angle), graph.sin(turn.angle));
        let (i, j) = ((turn.axis + 1) % 3, (turn.axis + 2) % 3);
        let mut out = v;
        out[i] = graph.sub(graph.mul(&[cos, v[i]]), graph.mul(&[sin, v[j]]));
        out[j] = graph.add(&[graph.mul(&[sin, v[i]]), graph.mul(&[cos, v[j]])]);
        out
    }

    /// The components after a turn of a vector that is given before it: v ↦ Rᵀ v.
    pub(crate) fn after(&self, turn: Turn, v: Vector) -> Vector {
        let angle = self.graph.neg(turn.angle);
        self.before(Turn { angle, ..turn }, v)
    }

    /// The rate of an expression along a motion.
    pub(crate) fn rate(&self, e: Expr) -> Expr {
        let graph = &self.graph;
        let rate = |symbol| {
            let (name, order) = (graph.symbol_name(symbol), graph.symbol_order(symbol));
            match (name, order) {
                ("t", 0) => Some(graph.one()),
                _ if self.varying.contains(name) => Some(graph.symbol(name, order + 1)),
                _ => None,
            }
        };
        graph.derive(&[e], &rate).swap_remove(0)
    }

    /// Whether nothing that moves occurs.
    pub(crate) fn is_constant(&self, e: Expr) -> bool {
        let symbols = self.graph.symbols_in(&[e]);
        symbols.into_iter().all(|symbol| {
            let name = self.graph.symbol_name(symbol);
            name != "t" && !self.varying.contains(name)
        })
    }

    pub(crate) fn is_zero(&self, v: Vector) -> bool {
        v.iter().all(|component| self.graph.is_zero(*component))
    }

    /// Whether a vector points along a coordinate axis, or is zero.
    pub(crate) fn is_along(&self, v: Vector, axis: usize) -> bool {
        (0..3).all(|i| i == axis || self.graph.is_zero(v[i]))
    }

    /// a/b as a number.
    pub(crate) fn ratio(&self, a: i64, b: i64) -> Expr {
        self.graph.number(Rational::from(a) / Rational::from(b))
    }
}
