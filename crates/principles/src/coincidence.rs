//! `formulation.vakonomic-coincides`: the constrained extremum beside the equations of motion (T1 §4.1–4.3).
//!
//! The equations of the extremum, `D(∂L/∂v) − ∂L/∂q = Σ κ E[f] − Σ κ' ∂f/∂v`, have r constants κ(0) more than the equations
//! of motion. Two questions are kept apart: whether the two *systems* are equal, that is, the accelerations for all κ, and
//! whether every motion is *among* the extremals, that is, for some κ(t). The second is decided by [`Closure`].

use crate::stationarity::{every_motion, Closure};
use chetaev_mechanics::claims::formulation::{basis, derive, manifold, residuals, REFERENCE};
use chetaev_mechanics::claims::{Claim, Context, Finding, Formula, Group, Scope};
use chetaev_mechanics::formulations::{extremum_matrix, kappa_symbols};
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{simplify, Expr, Symbol, Verdict};

/// `formulation.vakonomic-coincides`.
#[derive(Clone, Copy, Debug)]
pub struct VakonomicCoincides;

/// The subject: every solution of each system solves the other one.
const SYSTEM: &str = "system";
/// The subject: every motion is an extremal.
const INCLUSION: &str = "inclusion";
/// The formulation.
const VAKONOMIC: &str = "vakonomic";

impl Claim for VakonomicCoincides {
    fn id(&self) -> &'static str {
        "formulation.vakonomic-coincides"
    }

    fn group(&self) -> Group {
        Group::Formulations
    }

    fn scope(&self) -> Scope {
        Scope::Components
    }

    fn title(&self) -> &'static str {
        "Motions are extremals of the action under the constraints"
    }

    fn explanation(&self) -> &'static str {
        "The equations of the constrained extremum (\"vakonomic\") make ∫(L + Σ κ f) dt stationary; they are not the equations of \
         motion in general. `system`: the accelerations of both agree for all multipliers κ at every admissible state, outside \
         the set where the extremum does not determine them. For constraints linear or affine in the velocities this is so \
         exactly where the constraints are integrable (Kerner). `inclusion`: every motion solves the equations of the extremum \
         with some κ(t). It demands Σ κ E[f]·δq = 0 for virtual δq and κ' = ρ − λ; these linear conditions are \
         differentiated along the motion until no new ones appear. `proved` says how many constants of κ(0) stay free, and κ \
         where it is unique; `refuted` comes with a state at which the conditions contradict each other. Inclusion is weaker \
         than equality: κ = 0 alone would need all reactions to vanish."
    }

    fn requires(&self, subject: Option<&str>) -> Vec<String> {
        let mut hypotheses = vec![
            "model.forces-absent",
            "model.accelerations-unique",
            "model.masses-of-time",
        ];
        if subject == Some(SYSTEM) {
            hypotheses.push("model.constrained-extremum-regular");
        }
        hypotheses.into_iter().map(String::from).collect()
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let subjects: &[&str] = if cx.terms.constraints.is_empty() {
            &[]
        } else {
            &[SYSTEM, INCLUSION]
        };
        subjects.iter().map(|s| Some((*s).to_string())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        match subject {
            _ if cx.terms.constraints.is_empty() => {
                let detail = "without constraints both are Lagrange's equations";
                Verdict::Proved(Proof::structural("everywhere", detail)).into()
            }
            Some(SYSTEM) => systems_agree(cx),
            Some(INCLUSION) => motions_are_extremals(cx),
            other => {
                let asked = other.unwrap_or("no subject");
                Verdict::undecided(format!("`{asked}` is neither `{SYSTEM}` nor `{INCLUSION}`"))
                    .into()
            }
        }
    }
}

/// Accelerations of both systems for all κ.
fn systems_agree(cx: &Context<'_>) -> Finding {
    let derived = derive(cx, REFERENCE).and_then(|a| Ok((a, derive(cx, VAKONOMIC)?)));
    let (routh, extremum) = match derived {
        Ok(pair) => pair,
        Err(problem) => return problem.into(),
    };
    let on = "on the constraint manifold for all κ outside the singular set of the bordered matrix";
    let differences = residuals(cx, &routh, &extremum);
    let name = "an acceleration of the extremum less that of the motion";
    let named: Vec<(String, Expr)> = differences
        .into_iter()
        .map(|difference| (name.to_string(), difference))
        .collect();
    let mut verdict = cx
        .prover
        .named_identity(cx.system, &named, &manifold(cx), on);
    let sentence = match &verdict {
        Verdict::Proved(_) => format!("the extremals are the motions, for {}", every_kappa(cx)),
        Verdict::Refuted(_) => "the extremals are other curves than the motions for some κ".into(),
        _ => "accelerations of the extremum against those of the motion".into(),
    };
    let sentence = format!("{sentence}{}", kerner(cx, &verdict));
    verdict.prefix(&sentence);
    verdict.into()
}

/// Determinants of larger matrices are not written out.
const LARGEST_DETERMINANT: usize = 8;

/// Longer equations are not printed in a sentence.
const LONGEST_EQUATION: usize = 200;

/// "every κ", less the set where the bordered matrix of the extremum (R5) is singular.
fn every_kappa(cx: &Context<'_>) -> String {
    let basis = basis(cx);
    let g = &cx.system.graph;
    let names = kappa_symbols(&basis);
    let symbols: Vec<Symbol> = names.iter().filter_map(|&e| g.as_symbol(e)).collect();
    let matrix = extremum_matrix(&basis);
    if !g.any_contains_any(&matrix.concat(), &symbols) {
        return "every κ".into();
    }
    match singular_set(cx, &matrix, &symbols) {
        None => "every κ off the singular set of [[W + Σ κ f_vv, fᵥᵀ], [fᵥ, 0]]".into(),
        Some(equations) if equations.is_empty() => "every κ".into(),
        Some(equations) => format!("every κ off the singular set {}", equations.join(" and ")),
    }
}

/// The equations with κ under which the determinant vanishes; `None` where they are too long to be read.
fn singular_set(cx: &Context<'_>, matrix: &[Vec<Expr>], symbols: &[Symbol]) -> Option<Vec<String>> {
    let g = &cx.system.graph;
    if matrix.len() > LARGEST_DETERMINANT {
        return None;
    }
    let solved: Vec<(Expr, Expr)> = manifold(cx)
        .solved
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    let value = g.substitute(determinant(g, matrix), &solved);
    let short = simplify::simplify(g, value, &simplify::Options::default());
    let equations = factors(g, short, symbols)?;
    let texts = equations
        .into_iter()
        .map(|(factor, _)| simplify::simplify(g, factor, &simplify::Options::default()))
        .map(|factor| format!("{} = 0", g.text(factor)));
    let texts: Vec<String> = texts.collect();
    let is_short = texts
        .iter()
        .all(|text| text.chars().count() <= LONGEST_EQUATION);
    is_short.then_some(texts)
}

/// What Kerner's theorem says: about linear and affine constraints only.
fn kerner(cx: &Context<'_>, verdict: &Verdict) -> String {
    let mut rows = cx.selection.rows.iter();
    let affine = rows.all(|&row| {
        cx.system.constraints[cx.terms.constraint_index[row]].is_affine_in_velocities()
    });
    match verdict {
        _ if !affine => {
            "; Kerner's theorem does not apply, since a constraint is nonlinear in the \
                         velocities"
                .into()
        }
        Verdict::Proved(_) => {
            "; by Kerner's theorem the constraints, which are linear or affine in the \
                               velocities, are completely integrable"
                .into()
        }
        Verdict::Refuted(_) => {
            "; by Kerner's theorem the constraints, which are linear or affine in the \
                                velocities, are not completely integrable"
                .into()
        }
        _ => String::new(),
    }
}

/// The closure, in words.
fn motions_are_extremals(cx: &Context<'_>) -> Finding {
    let closure = Closure::of(cx);
    let closure = match &*closure {
        Ok(closure) => closure,
        Err(problem) => return Verdict::from(problem).into(),
    };
    let mut verdict = closure.verdict.clone();
    let sentence = match &verdict {
        Verdict::Proved(_) => format!(
            "{} is an extremal for suitable κ; {}",
            every_motion(cx),
            free_constants(closure)
        ),
        Verdict::Refuted(_) => {
            "through this state runs a motion for which no κ satisfies the conditions".into()
        }
        _ => "conditions on κ along the motion".to_string(),
    };
    verdict.prefix(&sentence);
    Finding {
        formulas: formulas(cx, closure),
        verdict,
    }
}

fn free_constants(closure: &Closure) -> String {
    match closure.free {
        0 => "κ is unique".into(),
        1 => "1 constant of κ(0) is free".into(),
        free => format!("{free} constants of κ(0) are free"),
    }
}

fn formulas(cx: &Context<'_>, closure: &Closure) -> Vec<Formula> {
    let basis = basis(cx);
    let g = &cx.system.graph;
    let options = simplify::Options::default();
    let solved: Vec<(Expr, Expr)> = manifold(cx)
        .solved
        .iter()
        .map(|&(symbol, value)| (g.symbol_expr(symbol), value))
        .collect();
    closure
        .kappa
        .iter()
        .zip(kappa_symbols(&basis))
        .zip(basis.constraint_names())
        .filter_map(|((value, symbol), name)| {
            let restricted = g.substitute((*value)?, &solved);
            Some(Formula {
                caption: format!("multiplier κ of `{name}` in the extremum, along every motion"),
                left: Some(symbol),
                right: simplify::simplify(g, restricted, &options),
            })
        })
        .collect()
}
