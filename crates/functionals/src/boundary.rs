//! Calculus at a curved piece of the boundary: the normal, the curvature, the distance.
//!
//! The distance s from the piece has the normal as its gradient, and the derivative of the normal is the curvature, a symmetric tensor in
//! the tangent plane: `s,i = n_i`, `n_i,j = curvature_ij`. A field that vanishes on the piece is s times another one, which is free; so
//! everything that follows for derivatives along the piece follows by the product rule (Hadamard's lemma).

use crate::space::{pairs, Component, Space};
use chetaev_symbolic::{Expr, Symbol};

/// The name of the curvature in statements.
pub const CURVATURE: &str = "curvature";

impl Space {
    /// The components of the outward normal.
    pub fn normal(&self) -> Vec<Expr> {
        let own = self.normals().iter();
        own.map(|&n| self.graph.symbol_expr(n)).collect()
    }

    /// Whether a symbol has a meaning on the boundary only: a component of the normal, or of the curvature.
    pub fn is_of_surface(&self, symbol: Symbol) -> bool {
        let is_curvature = |jet: crate::space::Jet| self.is_curvature(jet.component);
        self.normals().contains(&symbol) || self.as_jet(symbol).is_some_and(is_curvature)
    }

    /// Whether a component is one of those that the curvature is made of.
    pub fn is_curvature(&self, component: usize) -> bool {
        self.component_at(component).tensor == CURVATURE
    }

    /// `δ_ik − n_i n_k`.
    pub fn projector(&self, i: usize, k: usize) -> Expr {
        let g = &self.graph;
        let normal = self.normal();
        let unit = if i == k { g.one() } else { g.zero() };
        match (normal.get(i), normal.get(k)) {
            (Some(&a), Some(&b)) => g.sub(unit, g.mul(&[a, b])),
            _ => g.zero(),
        }
    }

    /// The derivative of the normal: the tangential part of a free symmetric tensor. On a line there is no tangent.
    pub fn curvature(&self, i: usize, k: usize) -> Expr {
        let g = &self.graph;
        let d = self.dimensions();
        if d == 1 {
            return g.zero();
        }
        let mut terms = Vec::new();
        for (a, b) in pairs(d) {
            let free = self.jet(self.curvature_component(a, b), &[]);
            terms.push(g.mul(&[self.projector(i, a), free, self.projector(b, k)]));
            if a != b {
                terms.push(g.mul(&[self.projector(i, b), free, self.projector(a, k)]));
            }
        }
        g.add(&terms)
    }

    pub(crate) fn curvature_at(&self, i: usize, axis: usize) -> Option<Expr> {
        (axis < self.dimensions()).then(|| self.curvature(i, axis))
    }

    fn curvature_component(&self, a: usize, b: usize) -> usize {
        self.component(Component {
            name: format!("{CURVATURE}_{}{}", a + 1, b + 1),
            tensor: CURVATURE.into(),
            multiplicity: if a == b { 1 } else { 2 },
            is_varied: false,
            is_of_boundary: true,
            constant_along: Vec::new(),
        })
    }

    /// Derivatives of the distance times `factor`, on the piece.
    pub fn of_distance_times(&self, factor: Expr, by: &[usize]) -> Expr {
        let g = &self.graph;
        let distance = self.distance();
        let whole = g.mul(&[g.symbol_expr(distance), factor]);
        let zero = g.zero();
        self.replace(self.totals(whole, by), &|symbol| {
            (symbol == distance).then_some(zero)
        })
    }

    /// The expression where the piece is plane: neither curvature nor derivatives of it.
    pub fn on_plane(&self, e: Expr) -> Expr {
        let zero = self.graph.zero();
        self.replace(e, &|symbol| {
            let jet = self.as_jet(symbol)?;
            self.is_curvature(jet.component).then_some(zero)
        })
    }

    /// Whether a derivative of the curvature occurs, which is not free: that of the second fundamental form is symmetric (Codazzi).
    pub fn has_curvature_derivatives(&self, e: Expr) -> bool {
        let mut jets = self.jets_in(&[e]).into_iter();
        jets.any(|jet| !jet.by.is_empty() && self.is_curvature(jet.component))
    }
}
