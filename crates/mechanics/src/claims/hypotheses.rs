//! Hypotheses of single formulations: absent forces, the form of the Lagrangian, and regularity of restricted and bordered
//! Hessians (T0 §5, T1 §5.4).

use super::{Claim, Context, Finding, Group};
use crate::characteristics::Manifold;
use crate::claims::formulation::manifold;
use crate::equations::unused_name;
use crate::formulations::extremum_matrix;
use crate::restricted::{regular_choice, restricted_hessian, RegularChoice};
use crate::system::System;
use crate::words::{counted, quoted};
use crate::Characteristics;
use chetaev_symbolic::verdict::{Counterexample, Proof};
use chetaev_symbolic::{Expr, Verdict};

/// Proves that named expressions vanish identically, structurally where they are zero by form.
fn vanish(
    cx: &Context<'_>,
    mut residuals: Vec<(String, Expr)>,
    on: &str,
    by_form: &str,
) -> Verdict {
    residuals.retain(|(_, e)| !cx.system.graph.is_zero(*e));
    if residuals.is_empty() {
        return Verdict::Proved(Proof::structural(on, by_form));
    }
    cx.prover
        .named_identity(cx.system, &residuals, &Manifold::default(), on)
}

/// `model.constraints-first-order`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintsFirstOrder;

impl Claim for ConstraintsFirstOrder {
    fn id(&self) -> &'static str {
        "model.constraints-first-order"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The constraints contain coordinates and velocities only"
    }

    fn explanation(&self) -> &'static str {
        "No constraint contains an acceleration or a higher derivative. Nearly all of the theory is made for such constraints; \
         those of order m ≥ 2 have equations with multipliers, Maggi's and Volterra's, and claims of their own (`order.…`). \
         Without a constraint of higher order the system would be another one, so what is made for the first order says \
         nothing of it."
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        match cx.terms.order > 1 {
            true => vec![None],
            false => Vec::new(),
        }
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let Some(constraint) = cx.system.constraints.iter().find(|c| c.order > 1) else {
            let detail = "no constraint contains a derivative of order two or more";
            return Verdict::Proved(Proof::structural("everywhere", detail)).into();
        };
        let order = constraint.order.to_string();
        Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "the highest derivative in a constraint".into(),
            residual: (order.clone(), order.clone()),
            detail: format!("the constraint `{}` is of order {order}", constraint.name),
        })
        .into()
    }
}

/// `model.forces-absent`.
#[derive(Clone, Copy, Debug)]
pub struct ForcesAbsent;

impl Claim for ForcesAbsent {
    fn id(&self) -> &'static str {
        "model.forces-absent"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "All active forces are in the Lagrangian"
    }

    fn explanation(&self) -> &'static str {
        "The generalized forces Q beside the Lagrangian, and the reactive forces of masses that vary, vanish identically in (q, v, t). Only then is there an action that could \
         be stationary, and an energy integral from the Lagrangian alone."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let by_form = "the model states no forces beside the Lagrangian";
        let names = cx
            .system
            .coordinates
            .iter()
            .map(|c| format!("Q_{}", c.name));
        let forces = names.zip(cx.system.all_forces()).collect();
        vanish(cx, forces, "identically in q, v, t", by_form).into()
    }
}

/// `model.lagrangian-autonomous`.
#[derive(Clone, Copy, Debug)]
pub struct LagrangianAutonomous;

impl Claim for LagrangianAutonomous {
    fn id(&self) -> &'static str {
        "model.lagrangian-autonomous"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The Lagrangian does not contain the time"
    }

    fn explanation(&self) -> &'static str {
        "∂L/∂t vanishes identically; controls u(t) count as explicit time."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let rate = cx.system.time_derivative(cx.system.lagrangian);
        let by_form = "the Lagrangian does not contain the time";
        let rate = vec![("∂L/∂t".to_owned(), rate)];
        vanish(cx, rate, "identically in q, v, t", by_form).into()
    }
}

/// `model.lagrangian-quadratic`.
#[derive(Clone, Copy, Debug)]
pub struct LagrangianQuadratic;

impl Claim for LagrangianQuadratic {
    fn id(&self) -> &'static str {
        "model.lagrangian-quadratic"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The Lagrangian is quadratic in the velocities"
    }

    fn explanation(&self) -> &'static str {
        "L = L₂ + L₁ + L₀ with parts homogeneous of degree 2, 1, 0 in the velocities: Taylor's expansion of second order around \
         any velocity w is exact, L(v) = L(w) + L_v(w)(v − w) + ½ (v − w) L_vv(w) (v − w) identically in q, v, w, t."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let (g, system) = (&cx.system.graph, cx.system);
        let symbols = system.velocity_symbols();
        if !g.any_contains_any(&cx.terms.mass_matrix.concat(), &symbols) && smooth(system) {
            let by_form = "no second derivative of L by velocities contains velocities";
            let proof = Proof::structural("identically in q, v, t", by_form);
            return Verdict::Proved(proof).into();
        }
        let name = "L(v) − L(w) − L_v(w)(v − w) − ½ (v − w) L_vv(w) (v − w)".to_owned();
        let residual = [(name, expansion_residual(cx))];
        let free = Manifold::default();
        let prover = &cx.prover;
        prover
            .named_identity(system, &residual, &free, "identically in q, v, t")
            .into()
    }
}

/// `model.lagrangian-even`.
#[derive(Clone, Copy, Debug)]
pub struct LagrangianEven;

impl Claim for LagrangianEven {
    fn id(&self) -> &'static str {
        "model.lagrangian-even"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The Lagrangian has the same value for opposite velocities"
    }

    fn explanation(&self) -> &'static str {
        "L(q, −v, t) = L(q, v, t): no gyroscopic terms, which are linear in the velocities, as a magnetic field, a rotating \
         frame or ignored coordinates bring them."
    }

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let (g, system) = (&cx.system.graph, cx.system);
        let opposite: Vec<(Expr, Expr)> = system
            .coordinates
            .iter()
            .map(|c| (c.v, g.neg(c.v)))
            .collect();
        let difference = g.sub(
            system.lagrangian,
            g.substitute(system.lagrangian, &opposite),
        );
        let difference = vec![("L(q, v, t) − L(q, −v, t)".to_owned(), difference)];
        let by_form = "the velocities stand in even powers only";
        vanish(cx, difference, "identically in q, v, t", by_form).into()
    }
}

/// Whether L has no corner: no absolute value or sign of velocities, which second derivatives do not see.
fn smooth(system: &System) -> bool {
    let g = &system.graph;
    let symbols = system.velocity_symbols();
    g.reachable(&[system.lagrangian]).into_iter().all(|e| {
        !matches!(g.node(e), chetaev_symbolic::Node::Apply { .. }) || !g.contains_any(e, &symbols)
    })
}

/// `L(v) − L(w) − L_v(w)(v − w) − ½ (v − w) L_vv(w) (v − w)`.
fn expansion_residual(cx: &Context<'_>) -> Expr {
    let (g, system) = (&cx.system.graph, cx.system);
    let symbols = system.velocity_symbols();
    let pairs: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .map(|c| {
            (
                c.v,
                g.symbol(&unused_name(system, &format!("w_{}", c.name)), 1),
            )
        })
        .collect();
    let mut functions = vec![system.lagrangian];
    functions.extend(g.gradient(system.lagrangian, &symbols));
    functions.extend(cx.terms.mass_matrix.concat());
    let at = g.substitute_all(&functions, &pairs);
    let n = system.n();
    let (first, second) = at[1..].split_at(n);
    let step: Vec<Expr> = pairs.iter().map(|&(v, w)| g.sub(v, w)).collect();
    let half = g.div(g.one(), g.integer(2));
    let mut parts = vec![system.lagrangian, g.neg(at[0])];
    for i in 0..n {
        parts.push(g.neg(g.mul(&[first[i], step[i]])));
        for j in 0..n {
            parts.push(g.neg(g.mul(&[half, step[i], second[i * n + j], step[j]])));
        }
    }
    g.add(&parts)
}

/// `model.restricted-hessian-regular`.
#[derive(Clone, Copy, Debug)]
pub struct RestrictedHessianRegular;

impl Claim for RestrictedHessianRegular {
    fn id(&self) -> &'static str {
        "model.restricted-hessian-regular"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The restricted Lagrangian is regular"
    }

    fn explanation(&self) -> &'static str {
        "The Hessian of the Lagrangian restricted to the constraint manifold, ∂²L̄/∂v∂v by the independent velocities, has a \
         determinant that is not identically zero, so independent velocities can be expressed by the momenta p̃ = ∂L̄/∂v. For \
         constraints linear in the velocities this is the restricted Hessian Bᵀ W B; for others it contains second derivatives of \
         the constraints, depends on which velocities are independent, and may be singular where the accelerations are unique: \
         v·v = c² with L = m v·v/2 − V(q). Where it is singular by the usual choice of independent velocities, others are tried; \
         the detail names them. Refuted means singular by every choice tried."
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        match regular_choice(cx.system, cx.terms, cx.selection) {
            Ok(choice) if choice.singular.is_empty() => chosen_hessian(cx, &choice).into(),
            Ok(choice) => singular_hessians(cx, &choice).into(),
            Err(problem) => Verdict::undecided(problem.to_string()).into(),
        }
    }
}

/// The verdict on ∂²L̄/∂v∂v by given independent velocities.
fn hessian_by(cx: &Context<'_>, characteristics: &Characteristics, what: &str) -> Verdict {
    let hessian = restricted_hessian(cx.system, characteristics);
    cx.prover
        .nonsingular(cx.system, &hessian, &characteristics.manifold, what)
}

const RESTRICTED: &str = "det ∂²L̄/∂v∂v of the restricted Lagrangian";

fn chosen_hessian(cx: &Context<'_>, choice: &RegularChoice) -> Verdict {
    if !choice.is_another {
        return hessian_by(cx, &choice.characteristics, RESTRICTED);
    }
    let names = choice.characteristics.parameters.iter();
    let names = quoted(names.map(|p| &p.name));
    let what = format!("{RESTRICTED} by {names}, chosen as the usual choice of independent velocities gives zero at a sampled state,");
    hessian_by(cx, &choice.characteristics, &what)
}

/// Where every choice is singular at a sampled state: refuted if every one is shown to be singular everywhere.
fn singular_hessians(cx: &Context<'_>, choice: &RegularChoice) -> Verdict {
    let usual = hessian_by(cx, &choice.characteristics, RESTRICTED);
    let Verdict::Refuted(mut found) = usual else {
        return usual;
    };
    for other in &choice.singular {
        let verdict = hessian_by(cx, other, RESTRICTED);
        if !matches!(verdict, Verdict::Refuted(_)) {
            let names = quoted(other.parameters.iter().map(|p| &p.name));
            return Verdict::undecided(format!(
                "{}; by {names} it is zero at a sampled state, but not shown to vanish identically",
                found.detail
            ));
        }
    }
    let others = counted(choice.singular.len(), "other choice", "other choices");
    found.detail.push_str(&format!(
        "; so it does by {others} of independent velocities"
    ));
    Verdict::Refuted(found)
}

/// `model.constrained-extremum-regular`.
#[derive(Clone, Copy, Debug)]
pub struct ConstrainedExtremumRegular;

impl Claim for ConstrainedExtremumRegular {
    fn id(&self) -> &'static str {
        "model.constrained-extremum-regular"
    }

    fn group(&self) -> Group {
        Group::Model
    }

    fn title(&self) -> &'static str {
        "The constrained extremum is an ordinary differential equation"
    }

    fn explanation(&self) -> &'static str {
        "The matrix W + Σ κ ∂²f/∂v∂v bordered by ∂f/∂v has a determinant that does not vanish identically on the constraint \
         manifold for free multipliers κ. Then the equations of the constrained extremum determine the accelerations and κ'. For \
         constraints nonlinear in the velocities the determinant depends on κ and vanishes on a set of its own."
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let basis = super::formulation::basis(cx);
        let matrix = extremum_matrix(&basis);
        let what = "the determinant of [[W + Σ κ f_vv, fᵥᵀ], [fᵥ, 0]]";
        cx.prover
            .nonsingular(cx.system, &matrix, &manifold(cx), what)
            .into()
    }
}
