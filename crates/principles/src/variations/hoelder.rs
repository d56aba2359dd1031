//! `variation.hoelder`: what varied curves do to the constraints.

use super::Displacements;
use crate::words::{conditional, for_general_controls, formula, listed, readable};
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::claims::{once_where, Claim, Context, Finding, Formula, Group};
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::linear::dot;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Verdict};

/// `variation.hoelder`.
#[derive(Clone, Copy, Debug)]
pub struct Hoelder;

impl Claim for Hoelder {
    fn id(&self) -> &'static str {
        "variation.hoelder"
    }

    fn group(&self) -> Group {
        Group::Principles
    }

    fn title(&self) -> &'static str {
        "Varied curves satisfy the constraints to first order (Hölder's rule)"
    }

    fn explanation(&self) -> &'static str {
        "Chetaev's condition Σ ∂f/∂v δq = 0 says what a virtual displacement δq is; what δv is has to be agreed upon. Hölder's rule \
         δv = D(δq) varies curves: then δf = Σ E[f] δq with Euler's operator E[f] = ∂f/∂q − D(∂f/∂v), and varied curves in general \
         violate the constraints, although δq obeys them. In solved form f = v_d − φ this is δf = Σ A δq, with the curvature \
         coefficients A = D(∂φ/∂v) − ∂φ/∂q − (∂φ/∂q_d)(∂φ/∂v). `proved`: δf = 0 for all virtual displacements at all \
         states and accelerations; so it is where the constraints are integrable. `conditional`: on the motions only, which \
         happens for constraints nonlinear in the velocities, or for some virtual displacements only, whose equations are \
         stated, with the states at which δf vanishes for all. `refuted`: for no displacement but zero. Example: a skate, f = x' sin φ − y' cos φ. Turn it by δφ while it moves with the speed \
         u along its blade, and let the blade's displacement δs grow with time along its direction: δf = u δφ − φ' δs. Unless these are in the \
         ratio of the actual velocities, the varied path is none a skate can take. \
         With u = 2 and φ' = 1 that is δf = 2 δφ − δs, zero for δs = 2 δφ only."
    }

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["model.accelerations-unique".into()]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        once_where(cx.terms.order <= 1)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        decide(cx).unwrap_or_else(Finding::from)
    }
}

fn decide(cx: &Context<'_>) -> Result<Finding, DeriveError> {
    if cx.selection.rows.is_empty() {
        let detail = "there are no constraints that a variation could violate";
        return Ok(Verdict::Proved(Proof::structural("everywhere", detail)).into());
    }
    let d = Displacements::new(cx)?;
    let varied = d.of_constraints(cx);
    let formulas = formulas(cx, &d, &varied);
    let identically = by_curvature(cx, &d, &varied).and(cx.prover.named_identity(
        cx.system,
        &named(cx, &d, &varied.concat()),
        d.manifold(),
        "at all admissible states, for all accelerations and virtual displacements",
    ));
    let mut finding = match identically {
        Verdict::Refuted(_) => not_identically(cx, &d, &varied, identically)?,
        mut other => {
            let sentence = match &other {
                Verdict::Proved(_) => "δf = 0 for every virtual displacement: varied curves satisfy the constraints to first order",
                _ => "δf = Σ E[f] δq for virtual displacements",
            };
            other.prefix(sentence);
            other.into()
        }
    };
    finding.formulas.splice(0..0, formulas);
    Ok(finding)
}

/// `Σ_m ∂f^l/∂v_m A^m_s = Σ_i E_i[f^l] B_is`: both ways to δf agree (T1 §9.6).
fn by_curvature(cx: &Context<'_>, d: &Displacements<'_>, varied: &[Vec<Expr>]) -> Verdict {
    let (system, g) = (cx.system, &cx.system.graph);
    let curvature = d.curvature();
    let mut residuals = Vec::new();
    for (row, varied) in basis(cx).jacobian().into_iter().zip(varied) {
        let dependent: Vec<Expr> = d.chart.dependent.iter().map(|&i| row[i]).collect();
        let dependent = d.chart.restrict(system, &dependent);
        for (s, &varied) in varied.iter().enumerate() {
            let column = curvature.iter().map(|a| &a[s]);
            residuals.push(g.sub(dot(g, &dependent, column), varied));
        }
    }
    let on = "at all admissible states, for all accelerations and virtual displacements";
    match cx.prover.identity(system, &residuals, d.manifold(), on) {
        Verdict::Refuted(_) => Verdict::undecided(
            "δf by Euler's operator and by the curvature coefficients were found to differ",
        ),
        other => other,
    }
}

/// On the motions, or for some displacements.
fn not_identically(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    varied: &[Vec<Expr>],
    identically: Verdict,
) -> Result<Finding, DeriveError> {
    let k = d.chart.k();
    let flat = varied.concat();
    if !d.has_accelerations(&flat) {
        return Ok(for_some_displacements(cx, d, varied, identically));
    }
    let flat = d.on_motion(cx, &flat)?;
    let rows: Vec<Vec<Expr>> = flat.chunks(k).map(<[Expr]>::to_vec).collect();
    let on = "on the motions, for all virtual displacements";
    let flat = named(cx, d, &flat);
    match cx.prover.named_identity(cx.system, &flat, d.manifold(), on) {
        Verdict::Proved(proof) => {
            let mut verdict = conditional("on the motions".into(), proof, identically);
            verdict.prefix("δf = 0 on every motion for every virtual displacement, although not for all accelerations: the reason is \
                 the equations of motion, not integrability",
            );
            Ok(verdict.into())
        }
        refuted @ Verdict::Refuted(_) => Ok(for_some_displacements(cx, d, &rows, refuted)),
        mut other => {
            other.prefix("δf on the motions");
            Ok(other.into())
        }
    }
}

/// The coefficients of δf with names, constraint after constraint.
fn named(cx: &Context<'_>, d: &Displacements<'_>, flat: &[Expr]) -> Vec<(String, Expr)> {
    let rows = cx.selection.rows.iter();
    let constraints = rows.map(|&row| &cx.system.constraints[cx.terms.constraint_index[row]].name);
    let names = constraints.flat_map(|f| {
        let independent = d.chart.independent.iter();
        independent.map(move |&i| {
            let name = &cx.system.coordinates[i].name;
            format!("the factor of δ{name} in δf of `{f}`")
        })
    });
    names.zip(flat.iter().copied()).collect()
}

/// The displacements for which δf vanishes, by the rank of its coefficients.
fn for_some_displacements(
    cx: &Context<'_>,
    d: &Displacements<'_>,
    rows: &[Vec<Expr>],
    mut refuted: Verdict,
) -> Finding {
    let k = d.chart.k();
    let rank = match cx.prover.rank(cx.system, rows, d.manifold()) {
        Ok(rank) if rank.minimum == rank.maximum => rank,
        _ => {
            refuted.prefix("δf does not vanish for all virtual displacements; for which it does was not decided");
            return refuted.into();
        }
    };
    if rank.maximum == k {
        let sentence = match k {
            1 => "the only virtual displacements, along one direction, violate the constraints: δf = 0 for none but zero",
            _ => "δf = 0 for no virtual displacement but zero, at almost every state",
        };
        refuted.prefix(&format!("{sentence}{}", for_general_controls(cx)));
        return refuted.into();
    }
    let equations = equations(cx, d, rows).map(|all| match all.len() {
        1 => all,
        _ => all.into_iter().map(bracketed).collect(),
    });
    let (condition, sentence) = match equations {
        Some(equations) => {
            let equations = listed(&equations);
            let of = match equations.contains(" or ") {
                true => "for displacements, or at states, with",
                false => "for displacements with",
            };
            let sentence = format!("varied curves violate the constraints, except {of} {equations}");
            (equations, sentence)
        }
        None => (
            format!("on {} of {k} dimensions of virtual displacements, those with Σ E[f] δq = 0", k - rank.maximum),
            format!("varied curves violate the constraints, except for {} of {k} dimensions of virtual displacements", k - rank.maximum),
        ),
    };
    let proof = match rank.at_least.and(rank.at_most) {
        Verdict::Proved(proof) => Proof {
            on: "at almost every admissible state".into(),
            ..proof
        },
        _ => Proof::exact("at almost every admissible state", "the rank of E[f] B"),
    };
    let controls = for_general_controls(cx);
    let mut verdict = conditional(format!("{condition}{controls}"), proof, refuted);
    verdict.prefix(&format!("{sentence}{controls}"));
    verdict.into()
}

/// "(a = 0 or b = 0)" among others.
fn bracketed(equation: String) -> String {
    match equation.contains(" or ") {
        true => format!("({equation})"),
        false => equation,
    }
}

/// A displacement form without the factors of states, and these: of `row = Π factors · form`, once for each row that has this form.
struct Direction {
    form: Expr,
    factors: Vec<Vec<Expr>>,
}

/// Where all rows `Σ_s c_s δ_s` vanish, "delta_x = 0 or y = 0" for rows that have a form in common and one of all their factors; `None`
/// where that is too long to be read.
fn equations(cx: &Context<'_>, d: &Displacements<'_>, rows: &[Vec<Expr>]) -> Option<Vec<String>> {
    let g = &cx.system.graph;
    let mut directions: Vec<Direction> = Vec::new();
    for row in rows {
        if row.iter().all(|&e| g.is_zero(e)) {
            continue;
        }
        let (form, factors) = direction(cx, d, row)?;
        let same = |e: Expr| e == form || e == g.neg(form);
        match directions.iter_mut().find(|known| same(known.form)) {
            Some(known) => known.factors.push(factors),
            None => directions.push(Direction {
                form,
                factors: vec![factors],
            }),
        }
    }
    let equations = directions.into_iter();
    equations
        .map(|direction| direction.equation(cx))
        .collect::<Option<_>>()
}

/// The form of a row, and the factors by which it vanishes for every displacement.
fn direction(cx: &Context<'_>, d: &Displacements<'_>, row: &[Expr]) -> Option<(Expr, Vec<Expr>)> {
    let (system, g) = (cx.system, &cx.system.graph);
    let form = readable(cx, dot(g, row, &d.free))?;
    let displacements = d.symbols();
    let mut symbols = displacements.clone();
    symbols.extend(system.coordinate_symbols());
    symbols.extend(system.velocity_symbols());
    let (own, common): (Vec<Expr>, Vec<Expr>) = factors(g, form, &symbols)?
        .into_iter()
        .map(|(factor, _)| factor)
        .partition(|&factor| g.contains_any(factor, &displacements));
    let without = match own.as_slice() {
        [factor] => readable(cx, *factor)?,
        _ => form,
    };
    let common = common.into_iter().filter(|&e| may_vanish(cx, e));
    Some((without, common.collect()))
}

fn may_vanish(cx: &Context<'_>, e: Expr) -> bool {
    let (g, stated) = (&cx.system.graph, assumptions(cx.system));
    let signs = [e, g.neg(e)].map(|e| known_sign(g, e, &stated));
    !signs.iter().any(|sign| sign.is_positive())
}

impl Direction {
    /// A factor of all rows vanishes, or those that the rows do not share all do.
    fn equation(&self, cx: &Context<'_>) -> Option<String> {
        let g = &cx.system.graph;
        let zero = |e: Expr| Some(format!("{} = 0", g.text(readable(cx, e)?)));
        let (first, others) = self.factors.split_first()?;
        let in_all = |e: &Expr| others.iter().all(|row| row.contains(e));
        let shared: Vec<Expr> = first.iter().copied().filter(in_all).collect();
        let mut all = vec![zero(self.form)?];
        for &e in &shared {
            all.extend(zero(e));
        }
        let rest = self.factors.iter().map(|row| {
            let own = row.iter().copied().filter(|e| !shared.contains(e));
            g.mul(&own.collect::<Vec<Expr>>())
        });
        let mut rest: Vec<Expr> = rest.collect();
        rest.sort_unstable();
        rest.dedup();
        let squares: Vec<Expr> = rest.iter().map(|&e| g.powi(e, 2)).collect();
        let together = readable(cx, g.add(&squares));
        let can = rest.iter().all(|&e| may_vanish(cx, e));
        if can && together.is_none_or(|e| may_vanish(cx, e)) {
            let texts: Option<Vec<String>> = rest.into_iter().map(zero).collect();
            all.push(listed(&texts?));
        }
        Some(all.join(" or "))
    }
}

/// δf, and the A^l_s that do not vanish.
fn formulas(cx: &Context<'_>, d: &Displacements<'_>, varied: &[Vec<Expr>]) -> Vec<Formula> {
    let (system, g) = (cx.system, &cx.system.graph);
    let basis = basis(cx);
    let mut found = Vec::new();
    for (name, row) in basis.constraint_names().into_iter().zip(varied) {
        let caption = format!("δf of `{name}` by Hölder's rule");
        found.extend(formula(cx, caption, None, dot(g, row, &d.free)));
    }
    for (&l, row) in d.chart.dependent.iter().zip(d.curvature()) {
        for (&s, value) in d.chart.independent.iter().zip(row) {
            let (l, s) = (&system.coordinates[l].name, &system.coordinates[s].name);
            let caption = format!("curvature coefficient of {l}' by δ{s}");
            let left = g.symbol(&format!("A_{l}_{s}"), 0);
            found.extend(formula(cx, caption, Some(left), value).filter(|f| !g.is_zero(f.right)));
        }
    }
    found
}
