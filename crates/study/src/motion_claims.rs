//! Claims about the motion computed (catalogue of claims, §8) and the initial state.
//!
//! A drift is a number, not a proof: these verdicts are `numerical` with the largest residual found, or `refuted` with the
//! time at which the bound was exceeded.

use crate::kept::LONGEST;
use crate::method_order::Orders;
use crate::motion_evidence::{Followed, FoundIntegrals, MotionEvidence};
use chetaev_geometry::noether::claims::corners_of_motions;
use chetaev_geometry::noether::found::if_searched;
use chetaev_mechanics::card::Relation;
use chetaev_mechanics::claims::formulation::{derive, REFERENCE};
use chetaev_mechanics::claims::order::dimension;
use chetaev_mechanics::claims::{Claim, Context, Finding, Group};
use chetaev_mechanics::formulation;
use chetaev_mechanics::words;
use chetaev_mechanics::Manifold;
use chetaev_motion::drift::Extreme;
use chetaev_motion::run::Run;
use chetaev_symbolic::verdict::{Counterexample, Evidence, PointValue, Proof};
use chetaev_symbolic::{Expr, Verdict};
use std::sync::Arc;

/// The claims of this module.
pub static CLAIMS: &[&dyn Claim] = &[
    &InitialStateAdmissible,
    &ConstraintDrift,
    &EnergyDrift,
    &IntegralDrift,
    &FormulationsAgree,
    &MethodOrder,
];

fn evidence(cx: &Context<'_>) -> Option<Arc<MotionEvidence>> {
    cx.extension::<MotionEvidence>()
}

fn subject_if_motion(cx: &Context<'_>) -> Vec<Option<String>> {
    if evidence(cx).is_some() {
        vec![None]
    } else {
        Vec::new()
    }
}

/// A motion of the constrained extremum is one of another system, of which neither the integrals of this one nor its other
/// formulations say anything.
pub(crate) fn of_another_system(evidence: &MotionEvidence) -> Option<Finding> {
    let card = formulation(evidence.run.formulation)?.card();
    (card.relation == Relation::Coincidence).then(|| {
        let detail = format!(
            "the motion computed is one of `{}`: {}",
            card.name, card.statement
        );
        Verdict::not_applicable("formulation.vakonomic-coincides#system", detail).into()
    })
}

fn no_motion() -> Finding {
    Verdict::undecided("no motion was computed").into()
}

/// A drift against its bound; `beyond` are words about the end of the motion.
fn drift_verdict(
    (what, beyond): (&str, &str),
    drift: &Extreme,
    bound: f64,
    samples: u32,
    evidence: &MotionEvidence,
) -> Verdict {
    let sentence = words_of_drift((what, beyond), drift, (bound, samples), evidence);
    if drift.value <= bound {
        Verdict::Numerical(Evidence {
            samples,
            region: "along the computed motion".into(),
            digits: if evidence.run.precise.is_some() {
                31
            } else {
                16
            },
            residual: drift.value,
            seed: None,
            why_no_proof: sentence,
        })
    } else {
        Verdict::Refuted(Counterexample {
            point: vec![PointValue {
                name: "t".into(),
                exact: None,
                enclosure: Some((format!("{}", drift.t), format!("{}", drift.t))),
            }],
            quantity: what.into(),
            residual: (format!("{:e}", drift.value), format!("{:e}", drift.value)),
            detail: sentence,
        })
    }
}

/// How far a quantity went, and how far it may.
fn words_of_drift(
    (what, beyond): (&str, &str),
    drift: &Extreme,
    (bound, samples): (f64, u32),
    evidence: &MotionEvidence,
) -> String {
    let tolerance = evidence.tolerance;
    format!(
        "largest drift of {what}: {:.2e} at t = {} over {samples} states, tolerance asked {tolerance:e}, bound {bound:.1e}{beyond}",
        drift.value, words::number(drift.t)
    )
}

/// What is said where quantities have no finite value at the state at which the equations became singular, which is left out.
fn without_value<'a>(
    evidence: &MotionEvidence,
    mut followed: impl Iterator<Item = &'a Followed>,
) -> String {
    let run = &evidence.run;
    let end = run.regular()..run.len();
    let has_none = |own: &Followed| own.values[end.clone()].iter().any(|x| !x.is_finite());
    match followed.any(has_none) {
        true => format!(
            "; without a finite value at the end, t = {}, where the equations become singular",
            words::number(run.t)
        ),
        false => String::new(),
    }
}

/// Accumulated error may exceed the local tolerance; a thousand times it, on the scale of the quantity, may not. However
/// loose the tolerance, what changes by more than a thousandth of its size is not kept.
fn bound(evidence: &MotionEvidence, scale: f64) -> f64 {
    let rounding = match evidence.run.precise {
        Some(_) => 1e-26,
        None => ROUNDING,
    };
    (1e3 * evidence.tolerance).clamp(rounding, KEPT) * scale
}

/// What long runs in doubles gather of rounding.
const ROUNDING: f64 = 1e-11;

/// The largest change, relative to the size of its terms, of a quantity that counts as kept.
const KEPT: f64 = 1e-3;

/// Beyond this difference, relative to the largest values, two runs no longer follow the same motion.
const LOST: f64 = 1e-2;

macro_rules! describe {
    ($id:expr, $group:expr, $title:literal, $explanation:literal) => {
        fn id(&self) -> &'static str {
            $id
        }
        fn group(&self) -> Group {
            $group
        }
        fn title(&self) -> &'static str {
            $title
        }
        fn explanation(&self) -> &'static str {
            $explanation
        }
    };
}

/// `model.initial-state-admissible`.
#[derive(Clone, Copy, Debug)]
pub struct InitialStateAdmissible;

impl Claim for InitialStateAdmissible {
    describe!(
        "model.initial-state-admissible",
        Group::Model,
        "The initial state satisfies the constraints",
        "The initial coordinates and velocities satisfy every constraint. Data that the model gives are fixed; the rest is \
         found by projection in the kinetic metric and reported. Where all data are exact the constraints are evaluated \
         exactly. A first-order system needs n coordinates and n - r independent velocities."
    );

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subject_if_motion(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let Some(evidence) = evidence(cx) else {
            return no_motion();
        };
        if cx.terms.order > 1 {
            return of_higher_order(cx, &evidence).into();
        }
        let (n, r) = (cx.system.n(), cx.selection.rows.len());
        let needed = needed_data(n, n - r);
        if cx.system.constraints.is_empty() {
            return Verdict::Proved(Proof::structural(
                "at the initial state",
                format!("no constraints; {needed}"),
            ))
            .into();
        }
        if let Some(exact) = &evidence.exact_start {
            let mut stated: Vec<Expr> = cx.terms.constraints.clone();
            stated.extend(
                cx.system
                    .constraints
                    .iter()
                    .filter(|c| c.order == 0)
                    .map(|c| c.stated),
            );
            let residuals = cx.system.graph.substitute_all(&stated, exact);
            let verdict = cx.prover.identity(
                cx.system,
                &residuals,
                &Manifold::default(),
                "at the initial state",
            );
            if let Verdict::Proved(mut proof) = verdict {
                proof.detail =
                    format!("the given initial data satisfy every constraint exactly; {needed}");
                return Verdict::Proved(proof).into();
            }
        }
        let why = "the initial data are rounded or were completed by projection";
        at_start(&evidence, why, &format!("; {needed}")).into()
    }
}

/// The start under constraints of order two and more: the residuals of all conditions, and how many data they leave.
fn of_higher_order(cx: &Context<'_>, evidence: &MotionEvidence) -> Verdict {
    let needed = derive(cx, REFERENCE).map_or(String::new(), |equations| {
        let (dimension, beyond) = dimension(cx, &equations);
        let further = match beyond {
            0 => String::new(),
            beyond => format!(", {beyond} of them beyond coordinates and velocities"),
        };
        format!("; {dimension} data are needed{further}")
    });
    let why = "the conditions on the initial data are evaluated in double precision";
    at_start(evidence, why, &needed)
}

/// The largest residual at the start.
fn at_start(evidence: &MotionEvidence, why: &str, needed: &str) -> Verdict {
    let residual = evidence.start_residual;
    Verdict::Numerical(Evidence {
        samples: 1,
        region: "the initial state".into(),
        digits: 16,
        residual,
        seed: None,
        why_no_proof: format!("{why}; largest residual {residual:.1e}{needed}"),
    })
}

/// The data that determine a motion, in words.
fn needed_data(n: usize, k: usize) -> String {
    let coordinates = if n == 1 { "coordinate" } else { "coordinates" };
    let velocities = if k == 1 { "velocity" } else { "velocities" };
    format!("{n} {coordinates} and {k} independent {velocities} are needed")
}

/// `motion.constraint-drift`.
#[derive(Clone, Copy, Debug)]
pub struct ConstraintDrift;

impl Claim for ConstraintDrift {
    describe!(
        "motion.constraint-drift",
        Group::Motion,
        "The computed motion keeps the constraints",
        "The largest residual of any constraint at the accepted steps, before projection, and at the output times, against \
         the tolerance asked: a thousand times it, and at most a thousandth, of the size of the terms of the constraint. In \
         the reduced state the velocity constraints hold by construction up to rounding."
    );

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subject_if_motion(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let Some(evidence) = evidence(cx) else {
            return no_motion();
        };
        if evidence.residuals.is_empty() {
            let proof = Proof::structural("along the motion", "the system has no constraints");
            return Verdict::Proved(proof).into();
        }
        let (worst, bound) = worst_residual(cx, &evidence);
        let mut samples = evidence.run.len() as u32;
        if let Some(drift) = &evidence.run.drift {
            samples += drift.steps as u32;
        }
        let all = evidence.residuals.iter().chain(&evidence.positions);
        let what = ("the constraints", &without_value(&evidence, all)[..]);
        drift_verdict(what, &worst, bound, samples, &evidence).into()
    }
}

/// The residual that is largest against its own bound, and the bound: positions and velocities have different sizes.
fn worst_residual(cx: &Context<'_>, evidence: &MotionEvidence) -> (Extreme, f64) {
    let rows = |of: &[Followed], steps: &[Extreme]| {
        of.iter()
            .enumerate()
            .map(|(i, followed)| {
                let mut worst = followed.drift;
                if let Some(step) = steps.get(i) {
                    worst.record(step.value, step.t);
                }
                (worst, bound_of(cx, evidence, (followed, worst)))
            })
            .collect::<Vec<_>>()
    };
    let drift = evidence.run.drift.as_ref();
    let mut found = rows(&evidence.residuals, drift.map_or(&[], |d| &d.velocity));
    found.extend(rows(
        &evidence.positions,
        drift.map_or(&[], |d| &d.position),
    ));
    let against = |(worst, bound): &(Extreme, f64)| worst.value / bound.max(f64::MIN_POSITIVE);
    found
        .into_iter()
        .max_by(|a, b| against(a).total_cmp(&against(b)))
        .unwrap_or_default()
}

/// `motion.energy-drift`.
#[derive(Clone, Copy, Debug)]
pub struct EnergyDrift;

impl Claim for EnergyDrift {
    describe!(
        "motion.energy-drift",
        Group::Motion,
        "The computed motion keeps the energy",
        "Where the energy is an integral (`energy.integral`), its largest deviation from the initial value along the \
         computed motion, at the output times and at every step, against a thousand times the tolerance asked, and at most \
         a thousandth, of the size of its terms. Where `energy.integral` is conditional and the motion is not where its \
         condition holds, there is nothing to keep."
    );

    fn requires(&self, _: Option<&str>) -> Vec<String> {
        vec!["energy.integral".into()]
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subject_if_motion(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let Some(evidence) = evidence(cx) else {
            return no_motion();
        };
        if let Some(other) = of_another_system(&evidence) {
            return other;
        }
        if let Some(elsewhere) = elsewhere(cx, &evidence) {
            return elsewhere.into();
        }
        followed_verdict(cx, &evidence, &evidence.energy, "the energy").into()
    }
}

/// Where the energy is an integral only on a part of the states, and this motion is not on it, nothing is to be kept.
fn elsewhere(cx: &Context<'_>, evidence: &MotionEvidence) -> Option<Verdict> {
    let integral = "energy.integral";
    let finding = cx.finding(integral);
    let Verdict::Conditional { condition, .. } = &finding.verdict else {
        return None;
    };
    let Some(rate) = &evidence.energy_rate else {
        let tried = format!("`{integral}` holds where {condition} only; whether this motion is there was not tested");
        return Some(Verdict::undecided(tried));
    };
    let Extreme { value, t } = rate.drift;
    (value > NO_RATE * rate.scale).then(|| {
        let detail = format!(
            "`{integral}` is conditional: it holds where {condition}, and this motion is elsewhere (|dH/dt| = {value:.3e} at t = {t:.6})"
        );
        Verdict::not_applicable(integral, detail)
    })
}

/// A rate of the energy below this, relative to the size of its terms, is rounding and the error of the states.
const NO_RATE: f64 = 1e-6;

fn followed_verdict(
    cx: &Context<'_>,
    evidence: &MotionEvidence,
    followed: &Followed,
    what: &str,
) -> Verdict {
    // Rows, and the ends of all steps.
    let steps = match followed.at_steps {
        true => evidence.run.statistics.steps as u32,
        false => 0,
    };
    let samples = evidence.run.len() as u32 + steps;
    let bound = bound_of(cx, evidence, (followed, followed.drift));
    let beyond = without_value(evidence, std::iter::once(followed));
    let what = format!("{what}{}", without_jumps(cx, followed));
    let verdict = drift_verdict((&what, &beyond), &followed.drift, bound, samples, evidence);
    with_projection(verdict, evidence, followed)
}

/// The bound of a drift. Where it is exceeded what an error of the state changes counts too: terms may all vanish along a motion, as those of
/// a constraint that is met exactly.
fn bound_of(
    cx: &Context<'_>,
    evidence: &MotionEvidence,
    (followed, drift): (&Followed, Extreme),
) -> f64 {
    let bound = bound(evidence, followed.scale);
    if drift.value <= bound || evidence.run.precise.is_some() {
        return bound;
    }
    let rounding = evidence.rounding_of(&cx.system.graph, followed.expression, drift.t);
    bound.max(rounding.unwrap_or(0.0))
}

/// What is left out of a drift, in words.
fn without_jumps(cx: &Context<'_>, followed: &Followed) -> String {
    let Some(jumps) = &followed.jumps else {
        return String::new();
    };
    let parts = jumps.parts.iter().map(|&e| cx.system.graph.text(e));
    let parts: Vec<String> = parts.collect();
    format!(
        " between the jumps of {} (the first before t = {})",
        parts.join(" and "),
        words::number(jumps.first)
    )
}

/// A value that a projection enforces is no evidence, and the verdict says so.
fn with_projection(verdict: Verdict, evidence: &MotionEvidence, followed: &Followed) -> Verdict {
    let report = evidence.run.kept.as_ref();
    let (Some(report), Some(kept)) = (report, followed.kept) else {
        return verdict;
    };
    let steps = match report.steps - kept.min(report.steps) {
        0 => "after each step".to_owned(),
        _ => format!("after {kept} of {} steps", report.steps),
    };
    match verdict {
        Verdict::Numerical(_) => verdict.prefixed(&format!(
            "its value was kept by projection {steps}, so that it is no evidence"
        )),
        _ => verdict.prefixed(&format!("a projection kept its value {steps}")),
    }
}

/// `motion.integral-drift#NAME`.
#[derive(Clone, Copy, Debug)]
pub struct IntegralDrift;

impl Claim for IntegralDrift {
    describe!(
        "motion.integral-drift",
        Group::Motion,
        "The computed motion keeps an integral",
        "The largest deviation of an integral from its initial value, along the computed motion: of those that the model \
         states, by their names, and of those that the search found, by their numbers (`noether.integral`), the energy among them with its own number too. \
         That the quantity is an integral is not proved here: a drift within the tolerance is evidence, a larger one \
         refutes the statement or the accuracy. Where a projection keeps the value (`keep_integrals`), its drift says nothing, \
         and the sentence says so. Of a function that jumps, as an angle of two arguments at its cut, the change between the \
         jumps counts, and that less whole turns in a sum of angles."
    );

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        let Some(evidence) = evidence(cx) else {
            return Vec::new();
        };
        let found = found_along(cx);
        let found = found.iter().flat_map(|found| found.all());
        let all = evidence.integrals.iter().chain(found);
        all.map(|f| Some(f.name.clone())).collect()
    }

    fn decide(&self, cx: &Context<'_>, subject: Option<&str>) -> Finding {
        let Some(evidence) = evidence(cx) else {
            return no_motion();
        };
        if let Some(other) = of_another_system(&evidence) {
            return other;
        }
        let named = |i: &&Followed| Some(i.name.as_str()) == subject;
        let decided = |followed: &Followed, what: &str, claim: &str| {
            let verdict = no_value(followed, what)
                .unwrap_or_else(|| followed_verdict(cx, &evidence, followed, what));
            let claim = format!("{claim}#{}", followed.name);
            where_it_holds(cx, &claim, followed.expression, verdict)
        };
        if let Some(found) = found_along(cx) {
            if let Some(followed) = found.all().into_iter().find(|own| named(own)) {
                let what = words_of_found(cx, (&found, followed));
                return decided(followed, &what, "noether.integral").into();
            }
        }
        match evidence.integrals.iter().find(named) {
            Some(followed) => {
                let what = format!("`{}`", followed.name);
                decided(followed, &what, "noether.inverse").into()
            }
            None => Verdict::undecided("no such integral is stated").into(),
        }
    }
}

/// Where an integral has no value, as x'/y' at y' = 0, there is nothing to keep.
fn no_value(followed: &Followed, what: &str) -> Option<Verdict> {
    let starts = followed.values.first().is_some_and(|x| x.is_finite());
    match (starts, followed.drift.value.is_finite()) {
        (true, true) => None,
        (false, _) => Some(Verdict::not_applicable(
            "the integral has a value at the start",
            format!("{what} has no finite value at the start"),
        )),
        (true, false) => Some(Verdict::not_applicable(
            "the integral has a value along the motion",
            format!(
                "{what} has no finite value at t = {}",
                words::number(followed.drift.t)
            ),
        )),
    }
}

/// A found integral that is one on a component of the constraints need not be one of a motion on another, nor a stated one across
/// its jumps, or off the part with which it is stated, nor any where the motion meets a corner of the constraints.
fn where_it_holds(cx: &Context<'_>, claim: &str, value: Expr, verdict: Verdict) -> Verdict {
    let Verdict::Refuted(found) = &verdict else {
        return verdict;
    };
    match &cx.finding(claim).verdict {
        Verdict::Conditional { condition, .. } => {
            let detail = format!(
                "`{claim}` is conditional: it holds where {condition}, and this motion is elsewhere ({})",
                found.detail
            );
            Verdict::not_applicable(claim, detail)
        }
        Verdict::Proved(_) => match corner_met(cx, value) {
            Some(corner) => {
                let detail = format!(
                    "`{claim}` holds while {corner} keeps its sign, which it does not along this motion ({})",
                    found.detail
                );
                Verdict::not_applicable(claim, detail)
            }
            None => verdict,
        },
        _ => verdict,
    }
}

/// A function at whose zeros motions may jump or end that does not keep its sign along the run.
fn corner_met(cx: &Context<'_>, value: Expr) -> Option<String> {
    let (evidence, g) = (evidence(cx)?, &cx.system.graph);
    let corners = corners_of_motions(cx, value).into_iter();
    let mut met = corners.filter(|&e| evidence.changes_sign(g, e) == Some(true));
    met.next().map(|e| g.text(e))
}

/// What a search has found, along the run: nothing where neither a claim has searched yet nor the run itself, to keep it.
fn found_along(cx: &Context<'_>) -> Option<Arc<FoundIntegrals>> {
    let evidence = evidence(cx)?;
    let searched = if_searched(cx);
    let found = match searched.as_deref() {
        Some(Ok(found)) => &found.integrals,
        _ if evidence.searched.integrals.is_empty() => return None,
        _ => &evidence.searched.integrals,
    };
    Some(cx.shared(|cx| FoundIntegrals::new(cx.system, cx.terms, &evidence, found)))
}

/// The integral with its value at the start.
fn words_of_found(cx: &Context<'_>, (found, followed): (&FoundIntegrals, &Followed)) -> String {
    let text = cx.system.graph.text(followed.shown);
    let formula = match text.chars().count() <= LONGEST {
        true => format!(", {text}"),
        false => String::new(),
    };
    let start = followed.values.first().copied().unwrap_or(0.0);
    let energy = found.energy.as_ref();
    let known = match energy.is_some_and(|energy| energy.name == followed.name) {
        true => ", the energy as in `motion.energy-drift`",
        false => "",
    };
    format!(
        "first integral {}{formula} ({start:.6} at the start){known}",
        followed.name
    )
}

/// `motion.formulations-agree`.
#[derive(Clone, Copy, Debug)]
pub struct FormulationsAgree;

impl Claim for FormulationsAgree {
    describe!(
        "motion.formulations-agree",
        Group::Motion,
        "Two formulations, integrated independently, give the same motion",
        "The trajectory of Routh's equations (all velocities or the independent ones, the linear system solved numerically \
         at each state) and that of another formulation (its own equations in its own state, derived and compiled; Maggi's, \
         or the one chosen with --formulation) are computed separately; the largest difference of coordinates and velocities is compared with the tolerance and the estimated \
         global error. Of forms that are proved equal (`formulation.equivalent`) a larger difference refutes nothing: it says how much \
         accuracy was lost, and by which."
    );

    fn highest_order(&self, _: Option<&str>) -> u32 {
        u32::MAX
    }

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subject_if_motion(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let Some(evidence) = evidence(cx) else {
            return no_motion();
        };
        if let Some(other) = of_another_system(&evidence) {
            return other;
        }
        let (Some(other), Some(gap)) = (&evidence.comparison, &evidence.disagreement) else {
            return Verdict::undecided("the second formulation could not be integrated").into();
        };
        let early = |run: &Run| run.asked() < 2;
        match (early(&evidence.run), early(other)) {
            (true, true) => {
                return Verdict::undecided("both runs ended before the first output time").into()
            }
            (true, false) => return ended_first(&evidence.run, other),
            (false, true) => return ended_first(other, &evidence.run),
            (false, false) => {}
        }
        if other.asked() < evidence.run.asked() {
            return ended_first(other, &evidence.run);
        }
        if let Some(why) = &evidence.unknown_error {
            return Verdict::undecided(why.clone()).into();
        }
        let error = evidence.global_error.unwrap_or(0.0);
        if error > LOST {
            let why = match evidence.step {
                Some(step) => format!(
                    ", by a second run at half the step: the step {step} may be too long, or the motion amplifies errors so much that runs cannot be compared; take a shorter step, or shorten the span"
                ),
                None => ": the motion amplifies errors so much that runs cannot be compared; shorten the span or tighten the tolerance".into(),
            };
            let tried = format!(
                "the estimated global error is {error:.1e}{why} (largest difference of the two formulations: {:.1e})",
                gap.value
            );
            return Verdict::undecided(tried).into();
        }
        let allowed =
            // The other run is one in doubles.
            bound(&evidence, 1.0).max(ROUNDING).max(100.0 * error) * growth(&evidence.run, gap.t);
        let allowed = allowed.min(LOST);
        let what = format!(
            "difference of `{}` and `{}`",
            evidence.run.formulation, other.formulation
        );
        if gap.value > allowed {
            if let Some(lost) = of_equal_forms(cx, (&evidence, other), gap) {
                return lost.into();
            }
        }
        drift_verdict(
            (&what, ""),
            gap,
            allowed,
            evidence.run.len() as u32,
            &evidence,
        )
        .into()
    }
}

/// What numbers say of two forms that are proved to be the same equations: how much accuracy was lost, and by which of them.
fn of_equal_forms(
    cx: &Context<'_>,
    (evidence, other): (&MotionEvidence, &Run),
    gap: &Extreme,
) -> Option<Verdict> {
    let forms = [evidence.run.formulation, other.formulation];
    let is_proved = |name: &str| {
        name == REFERENCE
            || matches!(
                cx.finding(&format!("formulation.equivalent#{name}"))
                    .verdict,
                Verdict::Proved(_)
            )
    };
    if !forms.iter().all(|name| is_proved(name)) {
        return None;
    }
    let whose = match evidence.losses {
        Some((own, others)) => {
            let (name, lost, less) = if own > others {
                (forms[0], own, others)
            } else {
                (forms[1], others, own)
            };
            format!("; beside a run at a sharper tolerance `{name}` is off by {lost:.1e}, the other by {less:.1e}")
        }
        None => String::new(),
    };
    let sentence = format!(
        "`{}` and `{}` are proved to be the same equations, so this is a statement on accuracy: the two computed motions differ by {:.2e} at t = {}, more than the tolerance asked, {:e}, lets expect{whose}; a sharper tolerance brings them together",
        forms[0], forms[1], gap.value, words::number(gap.t), evidence.tolerance
    );
    Some(Verdict::Numerical(Evidence {
        samples: evidence.run.len() as u32,
        region: "along the computed motion".into(),
        digits: 16,
        residual: gap.value,
        seed: None,
        why_no_proof: sentence,
    }))
}

/// Where a run ends early, at a singular state, what it computes depends on the time left: an error of the time counts by its
/// share in that.
fn growth(run: &Run, t: f64) -> f64 {
    let (Some(first), false) = (run.times.first(), run.ending.finished) else {
        return 1.0;
    };
    let (span, left) = ((run.t - first).abs(), (run.t - t).abs());
    match left > 0.0 {
        true => span / left,
        false => 1.0,
    }
}

fn ended_first(first: &Run, later: &Run) -> Finding {
    let tried = format!(
        "the run of `{}` ended before that of `{}`: {}",
        first.formulation, later.formulation, first.ending.reason
    );
    Verdict::undecided(tried).into()
}

/// The claim that repeats pieces of the motion, which is asked for only where it is wanted.
pub(crate) const METHOD_ORDER: &str = "motion.method-order";

/// `motion.method-order`.
#[derive(Clone, Copy, Debug)]
pub struct MethodOrder;

impl Claim for MethodOrder {
    describe!(
        METHOD_ORDER,
        Group::Motion,
        "The method shows its order on this model",
        "Pieces of the motion are repeated with fixed steps of decreasing size; the slope of the error against the step, where \
         neighbouring slopes agree, is the observed order. Where the motion crosses a corner of its equations (an absolute \
         value, a sign, the cut of an angle) the piece across the corner is measured: an order clearly below the nominal \
         one over many halvings refutes the claim. Of smooth equations the nominal order is the limit, so a piece that does \
         not show it decides nothing."
    );

    fn subjects(&self, cx: &Context<'_>) -> Vec<Option<String>> {
        subject_if_motion(cx)
    }

    fn decide(&self, cx: &Context<'_>, _: Option<&str>) -> Finding {
        let Some(evidence) = evidence(cx) else {
            return no_motion();
        };
        if evidence.run.precise.is_some() {
            let tried = "the order is measured in double precision, and this motion was computed in double-double";
            return Verdict::undecided(tried).into();
        }
        let Some(orders) = &evidence.orders else {
            return Verdict::undecided(
                "the piece of motion with fixed steps could not be computed",
            )
            .into();
        };
        order_verdict(orders).into()
    }
}

fn order_verdict(orders: &Orders) -> Verdict {
    let (from, to) = orders.stretch;
    let place = format!("from t = {} to {}", words::number(from), words::number(to));
    let at_corner = orders.corner.as_ref().map_or(String::new(), |corner| {
        format!(
            "; the equations are not smooth there: {} bends or jumps at t = {}",
            corner.text,
            words::number(corner.t)
        )
    });
    let Some(observed) = orders.observed else {
        return Verdict::undecided(format!(
            "between the steps that are too large and those whose errors are round-off no range was found in which the errors fall regularly ({} pieces of the motion tried): it is too simple or too short for the order to show{at_corner}",
            orders.tried
        ));
    };
    let sentence = format!(
        "observed order {observed:.2}, nominal {}, {place}{at_corner}",
        orders.nominal
    );
    if orders.falls_short() {
        let residual = format!("{:.2}", orders.nominal - observed);
        return Verdict::Refuted(Counterexample {
            point: Vec::new(),
            quantity: "nominal minus observed order".into(),
            residual: (residual.clone(), residual),
            detail: sentence,
        });
    }
    if !orders.is_shown() {
        let why = match orders.corner {
            Some(_) => ": the errors fall too irregularly across it for a verdict".into(),
            None => format!(
                ": none of {} pieces of the motion shows the nominal order, and nothing in the equations says that it cannot be reached",
                orders.tried
            ),
        };
        return Verdict::undecided(format!("{sentence}{why}"));
    }
    Verdict::Numerical(Evidence {
        samples: orders.steps.len() as u32,
        region: format!(
            "steps {:.2e} to {:.2e}",
            orders.steps.first().copied().unwrap_or(0.0),
            orders.steps.last().copied().unwrap_or(0.0)
        ),
        digits: 16,
        residual: (observed - orders.nominal).abs(),
        seed: None,
        why_no_proof: sentence,
    })
}
