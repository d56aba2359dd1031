//! Curves (q(t), p(t)) of phase space, on which q' is not yet ∂H/∂p, and their variations.

use crate::variations::delta_name;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::legendre::{Legendre, PhaseDirection};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::Expr;

/// Symbols of a curve in phase space and of its variation.
pub(crate) struct Phase {
    /// H and its derivatives.
    pub(crate) legendre: Legendre,
    /// The rates Dq of the curve.
    pub(crate) rates: Vec<Expr>,
    /// δq, D(δq) and δp.
    pub(crate) displacements: Vec<Expr>,
    pub(crate) moved_displacements: Vec<Expr>,
    pub(crate) momenta: Vec<Expr>,
}

impl Phase {
    pub(crate) fn new(cx: &Context<'_>) -> Result<Phase, DeriveError> {
        let (system, g) = (cx.system, &cx.system.graph);
        let legendre = Legendre::new(system)?;
        let n = system.n();
        let rates = system.coordinates.iter();
        let rates = rates.map(|c| g.symbol(&unused_name(system, &format!("Dq_{}", c.name)), 0));
        let delta = |order| (0..n).map(move |i| g.symbol(&delta_name(system, i), order));
        let momenta = legendre.momenta.iter();
        let momenta =
            momenta.map(|p| g.symbol(&unused_name(system, &format!("delta_{}", p.name)), 0));
        Ok(Phase {
            rates: rates.collect(),
            displacements: delta(0).collect(),
            moved_displacements: delta(1).collect(),
            momenta: momenta.collect(),
            legendre,
        })
    }

    /// `δ(Σ p Dq − H)` with all variations free.
    pub(crate) fn varied(&self, cx: &Context<'_>) -> Expr {
        let (system, g) = (cx.system, &cx.system.graph);
        let direction = PhaseDirection {
            time: g.zero(),
            coordinates: self.displacements.clone(),
            momenta: self.momenta.clone(),
        };
        let hamiltonian = [self.legendre.hamiltonian];
        let of_hamiltonian = self.legendre.along(system, &hamiltonian, &direction)[0];
        let values: Vec<Expr> = self.legendre.momenta.iter().map(|p| p.value).collect();
        g.add(&[
            dot(g, &self.momenta, &self.rates),
            dot(g, &values, &self.moved_displacements),
            g.neg(of_hamiltonian),
        ])
    }

    /// `Σ δp (Dq − ∂H/∂p)`.
    pub(crate) fn kinematic(&self, cx: &Context<'_>) -> Expr {
        let g = &cx.system.graph;
        let pairs = self.rates.iter().zip(&self.legendre.by_momenta);
        let lag: Vec<Expr> = pairs.map(|(&rate, &v)| g.sub(rate, v)).collect();
        dot(g, &self.momenta, &lag)
    }

    /// What ties p to v where the velocities stay implicit functions of the momenta.
    pub(crate) fn manifold(&self) -> Manifold {
        let momenta = self.legendre.momenta.iter();
        let solved = match self.legendre.is_explicit {
            true => Vec::new(),
            false => momenta.map(|p| (p.symbol, p.definition)).collect(),
        };
        Manifold {
            solved,
            implicit: Vec::new(),
        }
    }
}
