//! `hamilton-jacobi.applicable`: whether the generalized method of Hamilton and Jacobi integrates the motions; a complete integral
//! that the model states (`#stated`), and separation of variables in the coordinates given (`#separated`).

use super::complete::{verified, Checked};
use super::elementary::elementary;
use super::extremum::Extremum;
use super::separation;
use crate::stationarity::{every_motion, extremal_residuals, free_constant, Closure, NoneBut};
use crate::words::{formula, listed, readable};
use chetaev_mechanics::claims::formulation::{basis, manifold};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::formulations::{kappa_symbols, DeriveError};
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::system::CompleteIntegral;
use chetaev_mechanics::Manifold;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// `hamilton-jacobi.applicable`.
#[derive(Clone, Copy, Debug)]
pub struct Applicable;

/// The complete integral that the model states.
const STATED: &str = "stated";
/// Separation of variables.
const SEPARATED: &str = "separated";
/// Of systems with more coordinates no momenta are printed.
const MOST_SHOWN: usize = 6;
/// What it rests on.
const STATIONARY: &str = "hamilton.stationary";

impl Claim for Applicable {
    fn id(&self) -> &'static str {
        "hamilton-jacobi.applicable"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "The generalized method of Hamilton and Jacobi integrates the motions"
    }

    fn title_of(&self, subject: Option<&str>) -> &'static str {
        match subject {
            Some("separated") => {
                "The equation of Hamilton and Jacobi separates in these coordinates"
            }
            Some("stated") => {
                "The complete integral that the model states is one, and gives the motions"
            }
            _ => self.title(),
        }
    }

    fn explanation(&self) -> &'static str {
        "With multipliers κ of the constrained extremum, momenta π = p + Σ κ ∂f/∂v and H₁ = Σ π v − L, (v, κ) by π and f = 0, the extremals are the characteristics of \
         S_t + H₁(q, S_q, t) = 0. They are motions exactly where Hamilton's principle is one of stationary action (hamilton.stationary), with the κ found there: then δ∫(Σ π q' − H₁) dt = 0, \
         and along the motions π' = −∂H₁/∂q, which is computed. A complete integral has 2n constants, a motion 2n − r: \
         r of them are fixed by κ, after S was differentiated by them. `stated`: the S of [complete_integral] satisfies the equation, det ∂²S/∂q∂α does not vanish, ∂S/∂α is constant along q' = ∂H₁/∂π (Jacobi's theorem), and with the constants that the model gives \
         for motions these curves satisfy the equations of the nonholonomic motion. `separated`: the conditions of Levi-Civita on H₁ for S = −E t + Σ S_i(q_i) in these coordinates, for L and f free of the time; \
         where they hold and H₁ is even in the momenta of the coordinates it contains, or contains one coordinate only, S by one quadrature for each of these, verified as if it were stated; a constant alpha of such a coordinate is the square of its momentum \
         at a fixed position. Integrals of roots of polynomials up to the second degree are written out; the others are compared with the computed motion as numbers (witness.hamilton-jacobi). Example: a vertical rolling disc has κ = (−m x', −m y'), hence π_x = π_y = 0, and S is differentiated by these two constants before they are put to zero."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let mut hypotheses = vec![
            "model.forces-absent".to_string(),
            "model.accelerations-unique".into(),
            "model.masses-of-time".into(),
            "model.constrained-extremum-regular".into(),
        ];
        if subject.is_some() {
            hypotheses.push("hamilton-jacobi.applicable".into());
        }
        if subject == Some(SEPARATED) {
            hypotheses.push("model.lagrangian-autonomous".into());
            hypotheses.push("model.constraints-scleronomic".into());
        }
        hypotheses
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        if cx.terms.order > 1 {
            return vec![None];
        }
        let stated = cx.system.complete_integral.is_some();
        let of = [stated.then_some(STATED), Some(SEPARATED)];
        let subjects = of.into_iter().flatten().map(|s| Some(s.to_string()));
        std::iter::once(None).chain(subjects).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        match subject {
            None => applicable(cx).unwrap_or_else(Finding::from),
            Some(STATED) => stated(cx).unwrap_or_else(Finding::from),
            Some(SEPARATED) => separation::decide(cx).unwrap_or_else(Finding::from),
            Some(other) => {
                Verdict::undecided(format!("`{other}` is neither `{STATED}` nor `{SEPARATED}`"))
                    .into()
            }
        }
    }
}

fn applicable(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let stationary = cx.finding(STATIONARY);
    let mut verdict = stationary.verdict.clone();
    let mut formulas = stationary.formulas.clone();
    let sentence: String = match &verdict {
        Verdict::Proved(_) => {
            if let Some(characteristics) = characteristics(cx)? {
                verdict = verdict.and(characteristics);
            }
            format!("the method integrates {}: δ∫(Σ π q' − H₁) dt = 0 with π = p + Σ κ ∂f/∂v, and the motions are characteristics of S_t + H₁(q, S_q, t) = 0", every_motion(cx))
        }
        Verdict::Conditional { .. } => {
            "the method integrates those motions alone that make the action stationary; the other characteristics of S_t + H₁(q, S_q, t) = 0 are no motions".into()
        }
        Verdict::Refuted(_) => match NoneBut::refuted(cx) {
            NoneBut::Nothing => "the method integrates no motion: the characteristics of S_t + H₁(q, S_q, t) = 0 are no motions",
            NoneBut::Rest => "the method integrates no motion but rest: the other characteristics of S_t + H₁(q, S_q, t) = 0 are no motions",
            NoneBut::Open => "the method integrates almost no motion: almost no motion is a characteristic of S_t + H₁(q, S_q, t) = 0; the others were not followed",
        }
        .into(),
        _ => "whether the characteristics of S_t + H₁(q, S_q, t) = 0 are motions".into(),
    };
    formulas.extend(momenta_shown(cx));
    let (hamiltonian, without) = hamiltonian_shown(cx);
    formulas.extend(hamiltonian);
    verdict.prefix(&format!("{sentence}{without}"));
    Ok(Finding { verdict, formulas })
}

/// H₁(q, π, t), or H₁ by (q, v, κ) where it has no closed form; and why it is not written, as the end of a sentence.
fn hamiltonian_shown(cx: &Context<'_>) -> (Option<Formula>, String) {
    if let Some(extremum) = Extremum::new(cx) {
        let shown = formula(cx, "H₁(q, π, t)", None, extremum.hamiltonian);
        let without = match shown {
            Some(_) => String::new(),
            None => "; H₁(q, π, t) has a closed form, from linear equations for (v, κ), and is too long to be written here".into(),
        };
        return (shown, without);
    }
    let shown = implicit_hamiltonian(cx);
    let by = match shown {
        Some(_) => "H₁ is written by (q, v, κ) and not by (q, π, t)",
        None => "H₁ is not written by (q, π, t), and is too long to be written by (q, v, κ)",
    };
    let without = format!("; {by}: {}", implicit(cx));
    (shown, without)
}

/// Why (v, κ) are not had as functions of (q, π, t).
fn implicit(cx: &Context<'_>) -> String {
    let (g, speeds) = (&cx.system.graph, cx.system.velocity_symbols());
    let moves = |rows: &[Vec<Expr>]| g.any_contains_any(&rows.concat(), &speeds);
    let basis = basis(cx);
    let jacobian = basis.jacobian();
    let rows = basis.constraint_names().into_iter().zip(&jacobian);
    let nonlinear: Vec<String> = rows
        .filter(|(_, row)| g.any_contains_any(row, &speeds))
        .map(|(name, _)| format!("`{name}`"))
        .collect();
    let mut reasons = Vec::new();
    if moves(&cx.terms.mass_matrix) {
        reasons.push("L is not quadratic in the velocities".to_string());
    }
    if !nonlinear.is_empty() {
        let is = if nonlinear.len() == 1 { "is" } else { "are" };
        reasons.push(format!(
            "{} {is} nonlinear in the velocities",
            listed(&nonlinear)
        ));
    }
    match reasons.is_empty() {
        true => "the linear equations π = p + Σ κ ∂f/∂v, f = 0 were not solved for (v, κ)".into(),
        false => format!(
            "{}, so that π = p + Σ κ ∂f/∂v, f = 0 are nonlinear equations for (v, κ)",
            listed(&reasons)
        ),
    }
}

/// π by (q, v, κ), and along the motions where κ is known there for all of them.
fn momenta_shown(cx: &Context<'_>) -> Vec<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    if system.n() > MOST_SHOWN {
        return Vec::new();
    }
    let momenta = momenta_with(cx, &kappa_symbols(&basis(cx)));
    let names = super::extremum::names(system);
    let left: Vec<Expr> = names.iter().map(|name| g.symbol(name, 0)).collect();
    let pairs = left.iter().zip(&momenta);
    let caption = "momentum of the extremum, p + Σ κ ∂f/∂v";
    let mut shown: Vec<Formula> = pairs
        .filter_map(|(&left, &value)| formula(cx, caption, Some(left), value))
        .collect();
    if cx.selection.rows.is_empty() {
        return shown;
    }
    // Constants of κ(0) that are free stay: with zero the extremum may be singular.
    let along = multipliers(cx).map(|kappa| momenta_with(cx, &kappa));
    let solved = manifold(cx).solved.into_iter();
    let solved: Vec<(Expr, Expr)> = solved.map(|(s, e)| (g.symbol_expr(s), e)).collect();
    for (left, value) in left.into_iter().zip(along.unwrap_or_default()) {
        let caption = "the same along every motion, with its κ";
        let value = g.substitute(value, &solved);
        shown.extend(formula(cx, caption, Some(left), value));
    }
    shown
}

/// H₁ by (q, v, κ), where (v, κ) are not had in closed form.
fn implicit_hamiltonian(cx: &Context<'_>) -> Option<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    let momenta = momenta_with(cx, &kappa_symbols(&basis(cx)));
    let velocities: Vec<Expr> = system.coordinates.iter().map(|c| c.v).collect();
    let value = g.sub(dot(g, &momenta, &velocities), system.lagrangian);
    let caption = "H₁ = Σ π v − L by (q, v, κ), which are functions of (q, π, t) by π = p + Σ κ ∂f/∂v and f = 0 where the bordered matrix is regular";
    formula(cx, caption, None, value)
}

/// `p + Σ κ ∂f/∂v` with multipliers given, length n.
pub(super) fn momenta_with(cx: &Context<'_>, kappa: &[Expr]) -> Vec<Expr> {
    let (system, g) = (cx.system, &cx.system.graph);
    let jacobian = basis(cx).jacobian();
    let momenta = g.gradient(system.lagrangian, &system.velocity_symbols());
    let with =
        |(i, p): (usize, Expr)| g.add(&[p, dot(g, kappa, jacobian.iter().map(|row| &row[i]))]);
    momenta.into_iter().enumerate().map(with).collect()
}

/// Where κ is known for every motion: `D(p + Σ κ ∂f/∂v) = ∂L/∂q + Σ κ ∂f/∂q`, which is −∂H₁/∂q.
fn characteristics(cx: &Context<'_>) -> Result<Option<Verdict>, DeriveError> {
    let Some(kappa) = multipliers(cx) else {
        return Ok(None);
    };
    let residuals = extremal_residuals(cx, &kappa)?;
    let on = "on the constraint manifold, for almost every motion";
    let verdict = cx.prover.identity(cx.system, &residuals, &manifold(cx), on);
    Ok(Some(verdict))
}

/// κ of the selected constraints as functions of the state and constants, where `hamilton.stationary` knows all of them.
pub(super) fn multipliers(cx: &Context<'_>) -> Option<Vec<Expr>> {
    if cx.selection.rows.is_empty() {
        return Some(Vec::new());
    }
    let closure = Closure::of(cx);
    let closure = closure.as_ref().as_ref().ok()?;
    let stationary = cx.finding(STATIONARY);
    if !matches!(stationary.verdict, Verdict::Proved(_)) {
        return None;
    }
    let symbols = kappa_symbols(&basis(cx)).into_iter();
    symbols
        .enumerate()
        .map(|(l, symbol)| {
            let shown = stationary.formulas.iter().find(|f| f.left == Some(symbol));
            closure.kappa[l].or(shown.map(|f| f.right))
        })
        .collect()
}

/// `π = p + Σ κ ∂f/∂v` as functions of the state, with the κ of the motions, length n; `None` where κ is not known for all of them.
/// Free constants of κ(0), which belong to every motion with any value, are zero.
pub fn momenta_on_motions(cx: &Context<'_>) -> Option<Vec<Expr>> {
    let (system, g) = (cx.system, &cx.system.graph);
    let basis = basis(cx);
    let constants = basis.constraint_names().into_iter();
    let constants: Vec<(Expr, Expr)> = constants
        .map(|name| (free_constant(system, g, name), g.zero()))
        .collect();
    let kappa = g.substitute_all(&multipliers(cx)?, &constants);
    Some(momenta_with(cx, &kappa))
}

fn stated(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    let Some(integral) = &cx.system.complete_integral else {
        return Ok(Verdict::undecided("the model states no complete integral").into());
    };
    let Some(extremum) = Extremum::new(cx) else {
        return Ok(no_closed_form(cx).into());
    };
    checked(cx, &extremum, integral, "the S stated is")
}

/// What keeps H₁ from a closed form.
pub(super) fn no_closed_form(cx: &Context<'_>) -> Verdict {
    let (g, speeds) = (&cx.system.graph, cx.system.velocity_symbols());
    let moves = |rows: &[Vec<Expr>]| g.any_contains_any(&rows.concat(), &speeds);
    let hypothesis = match (moves(&cx.terms.mass_matrix), moves(&basis(cx).jacobian())) {
        (true, _) => "model.lagrangian-quadratic",
        (_, true) => "model.constraints-linear",
        _ => return Verdict::undecided(format!("H₁ is not had in closed form: {}", implicit(cx))),
    };
    Verdict::not_applicable(
        hypothesis,
        "H₁ is taken in closed form, where L is quadratic in the velocities and the constraints are affine in them; here (v, κ) are implicit functions of (q, π, t)",
    )
}

/// A complete integral through all its checks, in words.
pub(super) fn checked(
    cx: &Context<'_>,
    extremum: &Extremum,
    integral: &CompleteIntegral,
    what: &str,
) -> Result<Finding, DeriveError> {
    Ok(told(cx, integral, verified(cx, extremum, integral)?, what))
}

/// The checks of a complete integral in words.
pub(super) fn told(
    cx: &Context<'_>,
    integral: &CompleteIntegral,
    found: Checked,
    what: &str,
) -> Finding {
    let formulas = shown(cx, integral);
    let parts = [
        ("the equation S_t + H₁ = 0", &found.equation),
        ("det ∂²S/∂q∂α", &found.nondegenerate),
        ("Jacobi's theorem, ∂S/∂α along q' = ∂H₁/∂π", &found.theorem),
        ("the curves it gives and the motions", &found.motion),
    ];
    for (part, verdict) in parts {
        if !matches!(verdict, Verdict::Proved(_)) {
            let verdict = verdict.clone().prefixed(part);
            return Finding { verdict, formulas };
        }
    }
    let mut verdict = found
        .equation
        .and(found.nondegenerate)
        .and(found.theorem)
        .and(found.motion);
    let fixed = fixed(cx, integral);
    verdict.prefix(&format!(
        "{what} a complete integral of S_t + H₁ = 0, β = ∂S/∂α are constant along its curves, and{fixed} these are motions"
    ));
    if let Verdict::Proved(Proof { on, .. }) = &mut verdict {
        *on = "where S is defined and det ∂²S/∂q∂α does not vanish".into();
    }
    Finding { verdict, formulas }
}

/// " with a = 0 after differentiation".
pub(super) fn fixed(cx: &Context<'_>, integral: &CompleteIntegral) -> String {
    let g = &cx.system.graph;
    let values: Vec<String> = integral
        .motion
        .iter()
        .map(|&(symbol, value)| format!("{} = {}", g.symbol_text(symbol), g.text(value)))
        .collect();
    match values.is_empty() {
        true => String::new(),
        false => format!(" with {} put in after differentiation", values.join(", ")),
    }
}

/// S with a symbol for each quadrature, the quadratures, and what is constant by Jacobi's theorem.
pub(super) fn shown(cx: &Context<'_>, integral: &CompleteIntegral) -> Vec<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    let part = |i: usize| unused_name(system, &format!("S_{}", system.coordinates[i].name));
    let mut whole = vec![integral.action];
    let own = integral.quadratures.iter();
    whole.extend(own.map(|&(i, _)| g.symbol(&part(i), 0)));
    let mut formulas: Vec<Formula> = formula(
        cx,
        "S, each part S_q one integral over q",
        Some(g.symbol("S", 0)),
        g.add(&whole),
    )
    .into_iter()
    .collect();
    for &(i, value) in &integral.quadratures {
        let name = &system.coordinates[i].name;
        let right = readable(cx, value).unwrap_or(value);
        let own = g.symbol(&part(i), 0);
        let found = elementary(cx, value, system.coordinates[i].q_symbol);
        let kind = match found.is_empty() {
            true => "no elementary function for it was found in the family tried, and it stays an integral",
            false => "it is elementary",
        };
        formulas.push(Formula {
            caption: format!("S_{name} = ∫ g d{name} with this g; {kind}"),
            left: None,
            right,
        });
        for found in found {
            let positive = found.positive.iter();
            let positive: Vec<String> = positive.map(|&e| format!("{} > 0", g.text(e))).collect();
            let place = match positive.is_empty() {
                true => String::new(),
                false => format!(" where {}", listed(&positive)),
            };
            let caption =
                format!("S_{name} in closed form{place}; its derivative was proved to be g");
            formulas.extend(formula(cx, caption, Some(own), found.value));
        }
    }
    formulas.extend(constants_shown(cx, integral));
    formulas
}

/// β of each constant α: outside the integrals as a formula, the integrals in its caption.
fn constants_shown(cx: &Context<'_>, integral: &CompleteIntegral) -> Vec<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    let of = |&alpha: &Symbol| {
        let integrals = integral.quadratures.iter().filter_map(|&(i, value)| {
            let slope = g.diff(value, alpha);
            let text = || Some(g.text(readable(cx, slope)?));
            let name = &system.coordinates[i].name;
            let text = (!g.is_zero(slope)).then(text)?;
            Some(text.map_or(format!(" + ∫ ∂g/∂α d{name}"), |e| {
                format!(" + ∫ {e} d{name}")
            }))
        });
        let integrals: Vec<String> = integrals.collect();
        let caption = format!(
            "∂S/∂{}, constant along the curves (Jacobi): this{}",
            g.symbol_text(alpha),
            integrals.concat()
        );
        formula(cx, caption, None, g.diff(integral.action, alpha))
    };
    integral.constants.iter().filter_map(of).collect()
}

/// Nothing ties the symbols.
pub(super) fn free() -> Manifold {
    Manifold::default()
}
