//! Action at varied times: the identity behind the principles of least action, and these principles in the forms of Lagrange,
//! of Jacobi, and with a parameter (T1 §5, §6.3, §6.4; Rumyantsev 1982).
//!
//! An asynchronous variation compares a state at t with one at `t + Δt`: `Δq = δq + v Δt`, `Δv = D(Δq) − v D(Δt)`, and for every
//! function `Δg = δg + (Dg) Δt`. Δt is any function of the time; [`Asynchronous`] has its symbols.

mod identity;
mod jacobi;
mod lagrange;
mod parametric;

pub use identity::Identity;
pub use jacobi::Jacobi;
pub use lagrange::Lagrange;
pub use parametric::Parametric;

use crate::stationarity::{every_motion, of_parameters, NoneBut};
use crate::variations::delta_name;
use crate::words::for_general_controls;
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::System;
use chetaev_symbolic::{Expr, Verdict};

/// The symbols of an asynchronous variation. What varies freely is δq, or Δq where `is_total`.
pub struct Asynchronous<'a> {
    system: &'a System,
    /// δq of each coordinate, or Δq.
    pub displacements: Vec<Expr>,
    /// Δt.
    pub time: Expr,
    /// D(Δt).
    pub time_rate: Expr,
    /// Names that move with the time.
    moving: Vec<String>,
    is_total: bool,
}

impl<'a> Asynchronous<'a> {
    /// With free δq.
    pub fn new(system: &'a System) -> Asynchronous<'a> {
        let names = (0..system.n()).map(|i| delta_name(system, i));
        Asynchronous::named(system, names.collect(), false)
    }

    /// With free Δq, as Lagrange's principle has it.
    pub fn total(system: &'a System) -> Asynchronous<'a> {
        let names = system.coordinates.iter();
        let names = names.map(|c| unused_name(system, &format!("Delta_{}", c.name)));
        Asynchronous::named(system, names.collect(), true)
    }

    fn named(system: &'a System, mut moving: Vec<String>, is_total: bool) -> Asynchronous<'a> {
        let g = &system.graph;
        let displacements = moving.iter().map(|name| g.symbol(name, 0)).collect();
        let time = unused_name(system, "Delta_t");
        moving.push(time.clone());
        Asynchronous {
            system,
            displacements,
            time: g.symbol(&time, 0),
            time_rate: g.symbol(&time, 1),
            moving,
            is_total,
        }
    }

    /// D on the jets of the curve and of the variation.
    pub fn derivative(&self, e: Expr) -> Expr {
        self.system.total_derivative_with(e, &self.moving)
    }

    /// Δq, length n.
    pub fn coordinates(&self) -> Vec<Expr> {
        let g = &self.system.graph;
        let pairs = self.displacements.iter().zip(&self.system.coordinates);
        pairs
            .map(|(&d, c)| match self.is_total {
                true => d,
                false => g.add(&[d, g.mul(&[c.v, self.time])]),
            })
            .collect()
    }

    /// `Δv = D(Δq) − v D(Δt)`, length n.
    pub fn velocities(&self) -> Vec<Expr> {
        let g = &self.system.graph;
        let pairs = self.coordinates().into_iter().zip(&self.system.coordinates);
        pairs
            .map(|(moved, c)| g.sub(self.derivative(moved), g.mul(&[c.v, self.time_rate])))
            .collect()
    }

    /// Δe of a function of (q, v, t); controls and masses with a law of their own change with the time.
    pub fn vary(&self, e: Expr) -> Expr {
        let (system, g) = (self.system, &self.system.graph);
        let slopes = g.gradient(e, &system.coordinate_symbols());
        let momenta = g.gradient(e, &system.velocity_symbols());
        g.add(&[
            dot(g, &slopes, &self.coordinates()),
            dot(g, &momenta, &self.velocities()),
            g.mul(&[system.time_derivative(e), self.time]),
        ])
    }
}

/// What `hamilton.stationary` says of a principle of least action, whose conditions on κ are the same.
fn as_stationary(cx: &Context<'_>, which: &str) -> String {
    if cx.selection.rows.is_empty() {
        return format!("without constraints {which} is one of stationary action");
    }
    let id = "hamilton.stationary";
    // With multipliers s - 1 of the energy and κ the extremals at fixed energy satisfy 2 T s' = κ ∂f/∂t: only where ∂f/∂t = 0 is
    // s constant, and κ that of Hamilton's principle.
    let g = &cx.system.graph;
    let changes = |&l: &usize| !g.is_zero(cx.system.time_derivative(cx.terms.constraints[l]));
    if cx.selection.rows.iter().any(changes) {
        return format!(
            "where {which} is one of stationary action is open: the constraints contain the time, so that the extremals at fixed energy \
             are others than those of Hamilton's principle, and `{id}` does not tell"
        );
    }
    let verdict = &cx.finding(id).verdict;
    let (general, particular) = of_parameters(cx);
    let controls = for_general_controls(cx);
    match verdict {
        Verdict::Proved(_) => {
            format!("{which} is one of stationary action among admissible curves for {}, as Hamilton's is (`{id}`)", every_motion(cx))
        }
        Verdict::Conditional { condition, .. } => format!(
            "{which} is one of stationary action among admissible curves exactly where Hamilton's is (`{id}`){general}: {condition}{particular}"
        ),
        Verdict::Refuted(_) => match NoneBut::refuted(cx) {
            NoneBut::Nothing => format!(
                "{which} is one of stationary action among admissible curves for no motion{general}{controls}, as Hamilton's is for none (`{id}`){particular}"
            ),
            NoneBut::Rest => format!(
                "{which} is one of stationary action among admissible curves for no motion but rest{general}{controls}, as Hamilton's (`{id}`){particular}"
            ),
            NoneBut::Open => format!(
                "{which} is one of stationary action among admissible curves for almost no motion, as Hamilton's; the others were not followed (`{id}`){particular}"
            ),
        },
        other => format!(
            "where {which} is one of stationary action is open, as `{id}` is {}",
            other.word()
        ),
    }
}
