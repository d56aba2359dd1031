//! Principles of the second kind (T1 §7; Zhu 1998): q and v are varied independently, and `Dq = v` comes out.
//!
//! A curve (q(t), v(t)) of the state space has rates Dq, Dv of its own. With `Z = L + Σ (Dq − v) ∂L/∂v` (T1 (35)) the pointwise
//! identity `Σ (L_q + Q − D L_v) δq + Σ (Dq − v) δL_v = δZ + Σ Q δq − D(Σ L_v δq)` turns the differential principle into integral
//! ones with three kinds of end conditions.

mod canonical;
mod differential;
mod identity;
mod integral;
mod newton;

pub use canonical::Canonical;
pub use differential::Differential;
pub use identity::PointwiseIdentity;
pub use integral::Integral;
pub use newton::DifferentialNewton;

use crate::variations::delta_name;
use chetaev_mechanics::characteristics::derive_along;
use chetaev_mechanics::claims::formulation::{basis, derive, manifold, REFERENCE};
use chetaev_mechanics::claims::Context;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::state_space::{second_kind_density, StateJet};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// What is asked of the variations at the ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// Nothing; the end term `Σ ∂L/∂v δq` is subtracted.
    Free,
    /// δq = 0.
    HalfFixed,
    /// δq = 0 and δv = 0 (or δp = 0).
    Fixed,
}

impl Ends {
    /// All three.
    pub const ALL: [Ends; 3] = [Ends::Free, Ends::HalfFixed, Ends::Fixed];

    /// The subject of the claims.
    pub fn word(self) -> &'static str {
        match self {
            Ends::Free => "free",
            Ends::HalfFixed => "half-fixed",
            Ends::Fixed => "fixed",
        }
    }

    /// The conditions with this subject.
    pub fn of(subject: Option<&str>) -> Option<Ends> {
        Ends::ALL
            .into_iter()
            .find(|ends| Some(ends.word()) == subject)
    }
}

/// A curve of the state space with its variation.
#[derive(Debug)]
pub struct StateCurve {
    /// Dq, Dv.
    jet: StateJet,
    /// δq, D(δq), δv.
    displacements: Vec<Expr>,
    moved_displacements: Vec<Expr>,
    velocities: Vec<Expr>,
}

/// `Σ a δq + b D(δq) + c δv`.
#[derive(Clone, Debug)]
pub struct StateVariation {
    /// a, length n.
    pub by_displacements: Vec<Expr>,
    /// b, length n.
    pub by_moved: Vec<Expr>,
    /// c, length n.
    pub by_velocities: Vec<Expr>,
}

impl StateCurve {
    /// The curves of the context's system.
    pub fn new(cx: &Context<'_>) -> StateCurve {
        let (system, g) = (cx.system, &cx.system.graph);
        let delta = |order: u32| -> Vec<Expr> {
            let places = 0..system.n();
            places
                .map(|i| g.symbol(&delta_name(system, i), order))
                .collect()
        };
        let velocities = system.coordinates.iter();
        let velocities = velocities
            .map(|c| g.symbol(&unused_name(system, &format!("delta_v_{}", c.name)), 0))
            .collect();
        StateCurve {
            jet: StateJet::new(system),
            displacements: delta(0),
            moved_displacements: delta(1),
            velocities,
        }
    }

    /// `Z = L + Σ (Dq − v) ∂L/∂v` (T1 (35)).
    pub fn density(&self, cx: &Context<'_>) -> Expr {
        second_kind_density(cx.system, &self.jet)
    }

    /// The variation of a function of (q, v, Dq, t).
    pub fn vary(&self, cx: &Context<'_>, e: Expr) -> StateVariation {
        let (system, g) = (cx.system, &cx.system.graph);
        let pairs = |symbols: &[Expr], rates: &[Expr]| -> Vec<(Symbol, Expr)> {
            let symbols = symbols.iter().filter_map(|&e| g.as_symbol(e));
            symbols.zip(rates.iter().copied()).collect()
        };
        let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
        let mut varied = pairs(&velocities, &self.velocities);
        varied.extend(pairs(&self.jet.coordinates, &self.moved_displacements));
        let zero = g.zero();
        let varied = derive_along(system, &[e], &self.displacements, zero, &varied)[0];
        let by = |symbols: &[Expr]| {
            let symbols: Vec<Symbol> = symbols.iter().filter_map(|&e| g.as_symbol(e)).collect();
            g.gradient(varied, &symbols)
        };
        StateVariation {
            by_displacements: by(&self.displacements),
            by_moved: by(&self.moved_displacements),
            by_velocities: by(&self.velocities),
        }
    }

    /// What multiplies δq when the integral of a form is integrated by parts, the work of the forces included.
    pub fn reduced(&self, cx: &Context<'_>, form: &StateVariation) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let moved = self.jet.derive(system, &form.by_moved);
        form.by_displacements
            .iter()
            .zip(moved)
            .zip(&system.forces)
            .map(|((&e, moved), &force)| g.add(&[e, g.neg(moved), force]))
            .collect()
    }

    /// `W (Dq − v)`, what multiplies δv by T1 (34).
    pub fn kinematic(&self, cx: &Context<'_>) -> Vec<Expr> {
        let lag = self.lag(cx);
        let rows = cx.terms.mass_matrix.iter();
        rows.map(|row| dot(&cx.system.graph, row, &lag)).collect()
    }

    /// What multiplies δq by T1 (34): `∂L/∂q + Q − D(∂L/∂v) + Σ_s (Dq^s − v^s) ∂²L/∂v^s∂q`, of which the last terms vanish with
    /// Dq = v.
    pub fn dynamic(&self, cx: &Context<'_>) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
        let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let moved = self.jet.derive(system, &momenta);
        let mixed = self.mixed(cx).into_iter().enumerate();
        mixed
            .map(|(i, mixed)| g.add(&[slopes[i], system.forces[i], g.neg(moved[i]), mixed]))
            .collect()
    }

    /// `Σ_s (Dq^s − v^s) ∂²L/∂v^s∂q`.
    fn mixed(&self, cx: &Context<'_>) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let (lag, mixed) = (
            self.lag(cx),
            g.jacobian(&momenta, &system.coordinate_symbols()),
        );
        let columns = 0..system.n();
        columns
            .map(|i| dot(g, &lag, mixed.iter().map(|row| &row[i])))
            .collect()
    }

    /// Dq − v.
    fn lag(&self, cx: &Context<'_>) -> Vec<Expr> {
        let pairs = self.jet.coordinates.iter().zip(&cx.system.coordinates);
        pairs
            .map(|(&rate, c)| cx.system.graph.sub(rate, c.v))
            .collect()
    }

    /// Whether a covector vanishes for virtual δq with Dq = v and the accelerations of Routh's equations.
    ///
    /// # Errors
    /// [`DeriveError`].
    pub fn on_motion(&self, cx: &Context<'_>, covector: &[Expr]) -> Result<Verdict, DeriveError> {
        let (system, g) = (cx.system, &cx.system.graph);
        let routh = derive(cx, REFERENCE)?;
        let velocities = system.coordinates.iter().map(|c| c.v);
        let mut rates: Vec<(Expr, Expr)> = self
            .jet
            .coordinates
            .iter()
            .copied()
            .zip(velocities)
            .collect();
        let accelerations = self.jet.velocities.iter().copied();
        rates.extend(accelerations.zip(routh.accelerations));
        let covector = g.substitute_all(covector, &rates);
        let chart = basis(cx).independent_velocities()?;
        let residuals: Vec<Expr> = (0..chart.k())
            .map(|s| dot(g, &covector, &chart.column(s)))
            .collect();
        let on = "on every motion, outside the singular set of the linear systems";
        Ok(cx.prover.identity(system, &residuals, &manifold(cx), on))
    }

    /// What is left at the ends, by coordinate: `∂Z/∂(Dq) − ∂L/∂v` where the end term is subtracted, `∂Z/∂(Dq)` where nothing
    /// is asked of the ends and nothing subtracted, and nothing where δq = 0 there. D(δv) does not occur.
    pub fn end_terms(
        &self,
        cx: &Context<'_>,
        form: &StateVariation,
        ends: Ends,
        subtracted: bool,
    ) -> Vec<Expr> {
        let (system, g) = (cx.system, &cx.system.graph);
        if ends != Ends::Free {
            return Vec::new();
        }
        let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
        let pairs = form.by_moved.iter().zip(momenta);
        pairs
            .map(|(&e, p)| if subtracted { g.sub(e, p) } else { e })
            .collect()
    }
}

/// What of `Dq = v` follows where the Hessian is singular, `W Dq = W v` as equations.
fn kinematics_that_follow(cx: &Context<'_>, curve: &StateCurve) -> String {
    let g = &cx.system.graph;
    let velocities: Vec<Expr> = cx.system.coordinates.iter().map(|c| c.v).collect();
    let side = |row: &[Expr], with: &[Expr]| {
        let sum = dot(g, row, with);
        g.text(crate::words::readable(cx, sum).unwrap_or(sum))
    };
    let rows = cx.terms.mass_matrix.iter();
    let mut texts: Vec<String> = rows
        .filter(|row| row.iter().any(|&e| !g.is_zero(e)))
        .map(|row| {
            format!(
                "{} = {}",
                side(row, &curve.jet.coordinates),
                side(row, &velocities)
            )
        })
        .collect();
    texts.dedup();
    match texts.is_empty() {
        true => "nothing of Dq = v follows, the kinematics is not determined".into(),
        false => format!("of Dq = v only {} follows", crate::words::listed(&texts)),
    }
}

/// The identities that the formulation in state space states, those whose statement begins as given.
fn identities(
    cx: &Context<'_>,
    begins: &[&str],
) -> Result<Vec<chetaev_mechanics::Identity>, DeriveError> {
    let state_space = chetaev_mechanics::formulation("state-space");
    let state_space = state_space.ok_or(DeriveError::NotStated("the formulation"))?;
    let all = state_space.identities(&basis(cx))?;
    let chosen = all.into_iter();
    Ok(chosen
        .filter(|identity| begins.iter().any(|b| identity.statement.starts_with(b)))
        .collect())
}

/// The verdict on identities.
fn decided(cx: &Context<'_>, identities: &[chetaev_mechanics::Identity]) -> Option<Verdict> {
    let verdicts = identities.iter().map(|identity| {
        let (residuals, manifold) = (&identity.residuals, &identity.manifold);
        cx.prover
            .identity(cx.system, residuals, manifold, identity.on)
    });
    verdicts.reduce(Verdict::and)
}

/// The differences of two lists.
fn differences(cx: &Context<'_>, a: &[Expr], b: &[Expr]) -> Vec<Expr> {
    let pairs = a.iter().zip(b);
    pairs.map(|(&a, &b)| cx.system.graph.sub(a, b)).collect()
}

const FREE: &str = "for all curves (q(t), v(t)) and all variations";

/// An identity without constraints on its symbols.
fn everywhere(cx: &Context<'_>, residuals: &[Expr]) -> Verdict {
    cx.prover
        .identity(cx.system, residuals, &Manifold::default(), FREE)
}

/// What all principles of the second kind require.
fn requirements() -> Vec<String> {
    vec![
        "model.accelerations-unique".into(),
        "model.masses-free-of-velocity".into(),
    ]
}
