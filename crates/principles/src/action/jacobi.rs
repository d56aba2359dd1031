//! `action.jacobi`: Jacobi's principle of least action (T1 §5.4).
//!
//! `δ∫P dτ = 0`, `P = √(2(h + L₀)) √(2F) + L₁(q, q')`, δq virtual and zero at the ends, where `h + L₀ > 0` and `F = L₂(q, q') > 0`.
//! Decided are: the path equations in τ, changed back to t by `dτ/dt = √((h + L₀)/F)`, give the accelerations of the motion; their
//! contraction with q' vanishes identically, so that τ is free; and the conditions on κ in τ are those in t, so that the principle
//! is one of stationary action exactly where Hamilton's is.

use super::as_stationary;
use crate::words::{formula, listed};
use chetaev_mechanics::characteristics::Characteristics;
use chetaev_mechanics::claims::formulation::{basis, derive};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::{formulation, Equations, Manifold};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Verdict};

/// `action.jacobi`.
#[derive(Clone, Copy, Debug)]
pub struct Jacobi;

/// The formulation.
const JACOBI: &str = "jacobi";

impl Claim for Jacobi {
    fn id(&self) -> &'static str {
        "action.jacobi"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Least action in Jacobi's form"
    }

    fn explanation(&self) -> &'static str {
        "At fixed energy h the paths of the motions make ∫P dτ stationary in the sense of Hölder, P = √(2(h + L₀)) √(2F) + L₁(q, q'), F = L₂(q, q'), \
         for virtual δq that vanish at the ends; τ is any parameter, and gyroscopic terms L₁ enter linearly. It needs Q = 0, L free of the time and L = L₂ + L₁ + L₀, constraints homogeneous in the velocities and \
         free of the time, and h + L₀ > 0, F > 0 along the path. Decided are: the equations d/dτ(∂P/∂q') − ∂P/∂q = Σ μ ∂f/∂q' changed back to the time by dτ/dt = √((h + L₀)/F) \
         give the accelerations of the motion; their contraction with q' vanishes for every curve, so that τ is free; and Σ κ E[f]·δq taken with τ is that taken with t \
         times a factor, so that the principle is one of stationary action exactly where Hamilton's is. Since h + L₀ = L₂ along a motion, the form fails where L₂ = 0: with a positive kinetic energy at rest. There \
         the coefficient of q'' vanishes, the path ends on the boundary of the region h + L₀ > 0, and the motion that reaches it goes back. Example: a particle on a level plane \
         in a magnetic field, L = (x'² + y'²)/2 + (B/2)(x y' − y x'), runs round circles of radius √(2h)/B, one way only. \
         With h = 2 and B = 1 the radius is 2."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        let card = formulation(JACOBI).map(|f| f.card());
        let requires = card.map_or(&[][..], |card| card.requires);
        requires.iter().map(|id| (*id).to_string()).collect()
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let path = derive(cx, JACOBI)?;
    let back = cx.finding("formulation.equivalent#jacobi").verdict.clone();
    let on = "for every curve in τ";
    let free = Manifold::default();
    let homogeneous = [contraction(cx, &path)];
    let homogeneous = cx.prover.identity(cx.system, &homogeneous, &free, on);
    let mut verdict = back.and(homogeneous);
    if !cx.selection.rows.is_empty() {
        verdict = verdict.and(same_conditions(cx)?);
    }
    let sentence = match &verdict {
        Verdict::Proved(_) => format!(
            "paths of energy h satisfy δ∫P dτ = 0, and with dτ/dt = √((h + L₀)/F) its equations are those of the motion; {}; {}",
            as_stationary(cx, "Jacobi's principle"),
            fails(cx)
        ),
        _ => "paths of energy h and δ∫P dτ = 0".into(),
    };
    verdict.prefix(&sentence);
    let formulas: Vec<Option<Formula>> = vec![
        object(
            cx,
            &path,
            "integrand of Jacobi's principle",
            "the integrand P",
        ),
        formula(
            cx,
            "h + L₀, which must be positive",
            None,
            kinetic(cx, &path),
        ),
    ];
    Ok(Finding {
        verdict,
        formulas: formulas.into_iter().flatten().collect(),
    })
}

/// An object of the formulation by its meaning.
fn object(cx: &Context<'_>, path: &Equations, meaning: &str, caption: &str) -> Option<Formula> {
    let object = path.objects.iter().find(|o| o.meaning == meaning)?;
    formula(cx, caption, None, object.value)
}

/// `Σ q'ⁱ (d/dτ ∂P/∂q'ⁱ − ∂P/∂qⁱ)`.
pub(super) fn contraction(cx: &Context<'_>, path: &Equations) -> Expr {
    let g = &cx.system.graph;
    let equations = path.groups.first().map(|group| &group.equations);
    let lefts: Vec<Expr> = equations.into_iter().flatten().map(|e| e.left).collect();
    let rates = path.variables.iter().map(|x| &x.value);
    dot(g, &lefts, rates)
}

/// `h + L₀` with the symbol of h.
fn kinetic(cx: &Context<'_>, path: &Equations) -> Expr {
    let (system, g) = (cx.system, &cx.system.graph);
    let at_rest: Vec<(Expr, Expr)> = system.coordinates.iter().map(|c| (c.v, g.zero())).collect();
    let rest = g.substitute(system.lagrangian, &at_rest);
    let energy = path.variables.last().map_or(g.zero(), |x| x.value);
    g.add(&[energy, rest])
}

/// The degree of f in the velocities, which is homogeneous.
fn degree(cx: &Context<'_>, row: usize) -> Option<i64> {
    let (system, g) = (cx.system, &cx.system.graph);
    if system.constraints[cx.terms.constraint_index[row]].is_affine_in_velocities() {
        return Some(1);
    }
    let f = cx.terms.constraints[row];
    let velocities = system.coordinates.iter().map(|c| &c.v);
    let euler = dot(g, &cx.terms.jacobian[row], velocities);
    DEGREES.into_iter().find(|&d| {
        let scaled = ratio(d, 1).map_or(g.zero(), |d| g.scale(&d, f));
        let residual = [g.sub(euler, scaled)];
        let verdict = cx
            .prover
            .identity(system, &residual, &Manifold::default(), "");
        matches!(verdict, Verdict::Proved(_))
    })
}

/// Degrees that are tried.
const DEGREES: [i64; 6] = [1, 2, 3, 4, 0, -1];

/// With `dτ/dt = σ(t)` any positive function and f of degree d, `σ^d E^τ[f](q, dq/dτ)·B = E[f]·B`, where
/// `E^τ = ∂/∂q − d/dτ ∂/∂q'`: conditions on κ in τ are those in t. By Euler's theorem ∂f/∂q is of degree d and ∂f/∂v of degree
/// d − 1, so that at `dq/dτ = v/σ` they are `σ^(−d) ∂f/∂q` and `σ^(1−d) ∂f/∂v`.
fn same_conditions(cx: &Context<'_>) -> Result<Verdict, DeriveError> {
    let (system, g) = (cx.system, &cx.system.graph);
    let chart = basis(cx).independent_velocities()?;
    let name = unused_name(system, "sigma");
    let sigma = g.symbol(&name, 0);
    let moving = std::slice::from_ref(&name);
    let coordinates = system.coordinate_symbols();
    let mut residuals = Vec::new();
    for &row in &cx.selection.rows {
        let Some(degree) = degree(cx, row) else {
            let tried = "the degree of a constraint in the velocities was not found";
            return Ok(Verdict::undecided(tried));
        };
        let slopes = g.gradient(cx.terms.constraints[row], &coordinates);
        let scaled = |power: i64, e: Expr| g.mul(&[g.powi(sigma, power), e]);
        let difference: Vec<Expr> = slopes
            .iter()
            .zip(&cx.terms.jacobian[row])
            .map(|(&slope, &momentum)| {
                let moved = system.total_derivative_with(scaled(1 - degree, momentum), moving);
                let in_parameter = g.sub(scaled(-degree, slope), g.div(moved, sigma));
                let in_time = g.sub(slope, system.total_derivative(momentum));
                g.sub(scaled(degree, in_parameter), in_time)
            })
            .collect();
        residuals.extend(contracted(cx, &chart, &difference));
    }
    let on = "for all admissible curves and parameters";
    Ok(cx.prover.identity(system, &residuals, &chart.manifold, on))
}

fn contracted(cx: &Context<'_>, chart: &Characteristics, covector: &[Expr]) -> Vec<Expr> {
    let covector = chart.on_jet(cx.system, covector);
    chart.contract(cx.system, &covector)
}

/// Where the form fails, in words.
fn fails(cx: &Context<'_>) -> String {
    let positive = "formulation.gauss-least";
    let at = match &cx.finding(positive).verdict {
        Verdict::Proved(_) => "at rest only",
        _ => "where L₂(q, v) = 0",
    };
    let mut needed = vec!["h + L₀ > 0".to_string()];
    if at != "at rest only" {
        needed.push("F > 0".into());
    }
    format!(
        "it needs {} and fails {at}, as h + L₀ = L₂ along a motion",
        listed(&needed)
    )
}
