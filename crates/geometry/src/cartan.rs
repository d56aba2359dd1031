//! Fields and Cartan forms on the jet space J¹ with coordinates (t, q, v), in the natural basis {dt, dq, dv}.
//!
//! The Cartan form of a function f on J¹ is the one 1-form with `Θ(f) - f dt` in the span of the contact forms
//! `θ^s = dq^s - v^s dt` and `dΘ(f)` in their ideal (T3 (3) in the natural frame):
//!
//! `Θ(f) = f dt + (∂f/∂v^s) θ^s = (f - f_v·v) dt + f_v·dq`.
//!
//! It has no dv part, so its exterior derivative on two fields is
//!
//! `dΘ(f)(U, V) = U(θ₀) Vᵗ - V(θ₀) Uᵗ + Σ_s [ U(J_s) V^{q_s} - V(J_s) U^{q_s} ]`, `θ₀ = f - J·v`, `J = f_v`,
//!
//! in which the components of U and V are not differentiated: the form is a tensor.

use crate::exterior::{Form, Space};
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Symbol};
use std::collections::BTreeMap;

/// A field on J¹ by its components in {∂/∂t, ∂/∂q, ∂/∂v}.
#[derive(Clone, Debug)]
pub struct JetField {
    /// How it is called in output, for example `Y_x`.
    pub name: String,
    /// The component along ∂/∂t.
    pub t: Expr,
    /// The components along ∂/∂q, length n.
    pub q: Vec<Expr>,
    /// The components along ∂/∂v, length n.
    pub v: Vec<Expr>,
}

impl JetField {
    /// The zero field of `system`, to be filled in.
    pub fn zero(system: &System, name: impl Into<String>) -> JetField {
        let zero = system.graph.zero();
        JetField {
            name: name.into(),
            t: zero,
            q: vec![zero; system.n()],
            v: vec![zero; system.n()],
        }
    }

    /// The derivatives of functions on J¹ along the field; controls u(t) and masses with a law of their own move with the
    /// time.
    pub fn derivatives(&self, system: &System, functions: &[Expr]) -> Vec<Expr> {
        let g = &system.graph;
        let mut component: BTreeMap<Symbol, Expr> = BTreeMap::new();
        for (i, c) in system.coordinates.iter().enumerate() {
            component.insert(c.q_symbol, self.q[i]);
            component.insert(c.v_symbol, self.v[i]);
        }
        g.derive(functions, &|s| {
            let value = match component.get(&s) {
                Some(&value) => value,
                None => g.mul(&[self.t, system.prescribed_rate(s)?]),
            };
            (!g.is_zero(value)).then_some(value)
        })
    }
}

/// The Cartan form `θ₀ dt + Σ J_s dq^s` of a function on J¹.
#[derive(Clone, Debug)]
pub struct CartanForm {
    /// `θ₀ = f - f_v·v`.
    pub dt: Expr,
    /// `J = f_v`, length n.
    pub dq: Vec<Expr>,
}

impl CartanForm {
    /// Θ(f).
    pub fn of(system: &System, f: Expr) -> CartanForm {
        let g = &system.graph;
        let velocities = system.velocity_symbols();
        let dq = g.gradient(f, &velocities);
        let dt = if dq.iter().any(|&df| g.contains_any(df, &velocities)) {
            let products = system
                .coordinates
                .iter()
                .zip(&dq)
                .map(|(c, &df)| g.neg(g.mul(&[df, c.v])));
            g.add(&std::iter::once(f).chain(products).collect::<Vec<_>>())
        } else {
            // f is affine in the velocities, so f - f_v·v is its value at v = 0, free of velocities as it is written.
            let at_rest: Vec<(Expr, Expr)> =
                system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
            g.substitute(f, &at_rest)
        };
        CartanForm { dt, dq }
    }

    /// As a form on J¹.
    pub fn form(&self, space: &Space<'_>) -> Form {
        let n = self.dq.len();
        let mut components = vec![self.dt];
        components.extend(&self.dq);
        components.extend((0..n).map(|_| space.graph().zero()));
        space.one_form(&components)
    }

    /// The contraction Θ(U).
    pub fn contract(&self, system: &System, field: &JetField) -> Expr {
        let g = &system.graph;
        let mut parts = vec![g.mul(&[self.dt, field.t])];
        parts.extend(self.dq.iter().zip(&field.q).map(|(&a, &b)| g.mul(&[a, b])));
        g.add(&parts)
    }

    /// The derivatives of the coefficients along a field: what [`exterior_derivative`] needs of it.
    pub fn rate(&self, system: &System, field: &JetField) -> CartanForm {
        let mut coefficients = self.dq.clone();
        coefficients.push(self.dt);
        let mut dq = field.derivatives(system, &coefficients);
        let dt = dq.pop().unwrap_or(self.dt);
        CartanForm { dt, dq }
    }
}

/// dΘ(U, V) from the fields and the derivatives of the coefficients of Θ along them.
pub fn exterior_derivative(
    system: &System,
    (u, along_u): (&JetField, &CartanForm),
    (v, along_v): (&JetField, &CartanForm),
) -> Expr {
    let g = &system.graph;
    // Components are mostly zero; a product with zero would cost as much as any other.
    let term = |a: Expr, b: Expr| (!g.is_zero(a) && !g.is_zero(b)).then(|| g.mul(&[a, b]));
    let mut parts = Vec::new();
    parts.extend(term(along_u.dt, v.t));
    parts.extend(term(along_v.dt, u.t).map(|e| g.neg(e)));
    for s in 0..system.n() {
        parts.extend(term(along_u.dq[s], v.q[s]));
        parts.extend(term(along_v.dq[s], u.q[s]).map(|e| g.neg(e)));
    }
    g.add(&parts)
}
