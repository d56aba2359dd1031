//! `hamilton.central-identity`: the identity behind all forms, with its end terms.

use super::{holds_on_motions, requirements};
use crate::variations::{delta_name, Displacements, Rule};
use crate::words::formula;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::{Expr, Verdict};

/// `hamilton.central-identity`.
#[derive(Clone, Copy, Debug)]
pub struct CentralIdentity;

impl Claim for CentralIdentity {
    fn id(&self) -> &'static str {
        "hamilton.central-identity"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The central identity, with the ends free"
    }

    fn explanation(&self) -> &'static str {
        "D(Σ p δq) = δL + Σ Q δq + Σ p (D(δq) − δv) on every motion, for every virtual displacement and any δv whatever: it is \
         d'Alembert's principle with Σ p D(δq) added on both sides, and δv cancels in it. Integrated, ∫(δL + Σ Q δq + Σ p (D(δq) − δv)) dt = \
         [Σ p δq] between the ends (Rumyantsev's (1.6)); every form of Hamilton's principle is this with some choice of δv and \
         δq = 0 at the ends. Decided are two things: that the difference of both sides is Σ (E[L] + Q) δq for arbitrary \
         symbols δq, D(δq), δv, and that this vanishes for virtual δq on the motions. \
         Example: free fall, L = v²/2 − 10 q: on the right −10 δq + v δv + v (D(δq) − δv) = −10 δq + v D(δq), on \
         the left D(v δq), which is the same where v' = −10."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        requirements()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let identity = cx.prover.identity(
        cx.system,
        &[residual(cx)],
        &Manifold::default(),
        "for all curves, all δq and all δv",
    );
    let d = Displacements::new(cx)?;
    let integrand = d.of_lagrangian(Rule::Hoelder);
    let local = super::local_equations(cx, &d, &integrand);
    let mut verdict = identity.and(holds_on_motions(cx, &d, &local)?);
    if matches!(verdict, Verdict::Proved(_)) {
        verdict.prefix("∫(δL + Σ Q δq + Σ p (D(δq) − δv)) dt = [Σ p δq] on every motion for virtual δq, whatever δv is",
        );
    }
    let ends = dot(&cx.system.graph, &integrand.rate, &d.free);
    Ok(Finding {
        verdict,
        formulas: formula(cx, "end term Σ p δq, by the independent δ", None, ends)
            .into_iter()
            .collect(),
    })
}

/// `D(Σ p δq) − δL − Σ Q δq − Σ p (D(δq) − δv) + Σ (E[L] + Q) δq` on the full jet, δq, D(δq), δv as symbols.
fn residual(cx: &Context<'_>) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let n = system.n();
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let slopes = g.gradient(system.lagrangian, &system.coordinate_symbols());
    let delta = |order: u32| -> Vec<Expr> {
        (0..n)
            .map(|i| g.symbol(&delta_name(system, i), order))
            .collect()
    };
    let (dq, ddq) = (delta(0), delta(1));
    let dv: Vec<Expr> = system
        .coordinates
        .iter()
        .map(|c| g.symbol(&unused_name(system, &format!("delta_v_{}", c.name)), 0))
        .collect();
    let moved: Vec<Expr> = momenta
        .iter()
        .map(|&p| system.total_derivative(p))
        .collect();
    let lefts = system.lagrange_left_sides();
    g.add(&[
        dot(g, &moved, &dq),
        dot(g, &momenta, &ddq),
        g.neg(dot(g, &slopes, &dq)),
        g.neg(dot(g, &momenta, &dv)),
        g.neg(dot(g, &momenta, &ddq)),
        dot(g, &momenta, &dv),
        g.neg(dot(g, &lefts, &dq)),
    ])
}
