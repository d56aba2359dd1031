//! What the variational principles say of a random system: no verdict contradicts another one, integrable constraints leave every
//! motion stationary, and wrong principles are refuted.

use super::hypotheses::{seen, Seen};
use super::numbers::Size;
use super::reduced::curvature_and_terms;
use super::{extremals, sets};
use super::{Expected, Kind, Subject, Trial};
use chetaev_mechanics::claims::formulation::{derive, manifold};
use chetaev_mechanics::claims::full_id;
use chetaev_principles::hamilton::{holds_on_motions, local_equations, suslov};
use chetaev_principles::second_kind::{Ends, StateCurve};
use chetaev_principles::stationarity::Closure;
use chetaev_principles::variations::Displacements;
use chetaev_symbolic::verdict::Proof;
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::time::Instant;

/// Claims that hold of every system whose hypotheses hold.
const TRUE: [(&str, Option<&str>); 18] = [
    ("hamilton.hoelder", None),
    ("hamilton.voronets", None),
    ("hamilton.suslov", None),
    ("hamilton.helmholtz-poincare", None),
    ("hamilton.central-identity", None),
    ("hamilton.forms-equivalent", None),
    ("hamilton.endpoints", None),
    ("action.identity", None),
    ("action.parametric", None),
    ("variation.suslov", None),
    ("second-kind.differential", None),
    ("second-kind.identity", None),
    ("second-kind.integral", Some("free")),
    ("second-kind.integral", Some("half-fixed")),
    ("second-kind.canonical", Some("fixed")),
    ("universal-relation", Some("zero")),
    ("universal-relation", Some("suslov")),
    ("universal-relation", Some("hoelder")),
];

/// So many of them for each system; the seeds take turns.
const TAKEN: usize = 4;

/// Every trial.
pub(super) fn all(subject: &Subject<'_>) -> Vec<Trial> {
    let first = subject.seed as usize * TAKEN;
    let taken = (first..first + TAKEN).map(|i| TRUE[i % TRUE.len()]);
    let mut trials: Vec<Trial> = taken
        .filter_map(|(id, of)| holds(subject, id, of))
        .collect();
    trials.extend(timed(|| without_contradiction(subject)));
    trials.extend(timed(|| integrable(subject)));
    trials.extend(timed(|| extremal(subject)));
    if applies(subject, STATIONARY, None) {
        trials.extend(timed(|| extremals::integrated(subject)));
        trials.extend(timed(|| sets::drawn(subject)));
        trials.extend(timed(|| sets::beside(subject)));
    }
    trials.extend(timed(|| terms_dropped(subject)));
    trials.extend(timed(|| ends_left_open(subject)));
    trials
}

fn timed(law: impl FnOnce() -> Option<Trial>) -> Option<Trial> {
    let start = Instant::now();
    let trial = law()?;
    let seconds = start.elapsed().as_secs_f64();
    Some(Trial { seconds, ..trial })
}

fn trial(law: &'static str, about: &str, expected: Expected, verdict: Verdict) -> Trial {
    Trial {
        kind: match expected {
            Expected::Refuted => Kind::Mutant,
            _ => Kind::Other,
        },
        law,
        formulation: "",
        about: about.to_string(),
        expected,
        verdict,
        seconds: 0.0,
    }
}

/// Whether all hypotheses of a claim are seen to hold.
fn applies(subject: &Subject<'_>, id: &str, of: Option<&str>) -> bool {
    let claim = subject.cx.registry().find(id);
    claim.is_some_and(|claim| {
        let requires = claim.requires(of);
        requires.iter().all(|id| seen(subject, id) == Seen::Holds)
    })
}

fn holds(subject: &Subject<'_>, id: &'static str, of: Option<&str>) -> Option<Trial> {
    let regular = seen(subject, "model.hessian-regular") == Seen::Holds;
    if !applies(subject, id, of) || !regular {
        return None;
    }
    timed(|| {
        let full = full_id(id, of);
        let verdict = subject.cx.finding(&full).verdict.clone();
        Some(trial(
            "a principle that gives the motion",
            &full,
            Expected::Proved,
            verdict,
        ))
    })
}

const STATIONARY: &str = "hamilton.stationary";

/// `hamilton.stationary`, inclusion and equality of systems agree: stationary exactly where every motion is an extremal, and
/// where the systems are one, every motion is.
fn without_contradiction(subject: &Subject<'_>) -> Option<Trial> {
    if !applies(subject, STATIONARY, None) || subject.natural.dependent.is_empty() {
        return None;
    }
    let word = |id: &str| subject.cx.finding(id).verdict.word();
    let stationary = word(STATIONARY);
    let inclusion = word("formulation.vakonomic-coincides#inclusion");
    let systems = word("formulation.vakonomic-coincides#system");
    let flat = word("variation.hoelder");
    let agrees = (stationary == "proved") == (inclusion == "proved")
        && (stationary != "undecided")
        && (systems != "proved" || inclusion == "proved")
        && (flat != "proved" || stationary == "proved");
    let words = format!(
        "stationary {stationary}, inclusion {inclusion}, one system {systems}, δf = 0 {flat}"
    );
    let verdict = match agrees {
        true => Verdict::Proved(Proof::structural("for these verdicts", words)),
        false => Verdict::undecided(words),
    };
    Some(trial(
        "no verdict contradicts another",
        "",
        Expected::Proved,
        verdict,
    ))
}

/// Where the curvature of the constraints vanishes, every motion is stationary.
fn integrable(subject: &Subject<'_>) -> Option<Trial> {
    if !applies(subject, STATIONARY, None) || subject.natural.dependent.is_empty() {
        return None;
    }
    let (curvature, _) = curvature_and_terms(subject)?;
    if curvature != Size::Zero {
        return None;
    }
    let verdict = subject.cx.finding(STATIONARY).verdict.clone();
    let varied = subject.cx.finding("variation.hoelder").verdict.clone();
    Some(trial(
        "integrable constraints leave every motion stationary",
        "",
        Expected::Proved,
        verdict.and(varied),
    ))
}

/// Where κ is unique, the motion solves the equations of the extremum with it.
fn extremal(subject: &Subject<'_>) -> Option<Trial> {
    let (cx, system) = (subject.cx, subject.cx.system);
    let g = &system.graph;
    if !applies(subject, STATIONARY, None) || cx.finding(STATIONARY).verdict.word() != "proved" {
        return None;
    }
    let closure = Closure::of(cx);
    let closure = closure.as_ref().as_ref().ok()?;
    let kappa: Vec<Expr> = closure.kappa.iter().copied().collect::<Option<_>>()?;
    let extremum = derive(cx, "vakonomic").ok()?;
    let stated = &extremum.groups.first()?.equations;
    let motion: Vec<(Expr, Expr)> = system
        .coordinates
        .iter()
        .map(|c| c.a)
        .zip(subject.routh.accelerations.iter().copied())
        .collect();
    let symbols: Vec<Symbol> = extremum
        .variables
        .iter()
        .filter(|x| x.name.starts_with("kappa_"))
        .map(|x| x.symbol)
        .collect();
    let mut pairs = motion.clone();
    for (&symbol, &value) in symbols.iter().zip(&kappa) {
        let moved = g.substitute(system.total_derivative(value), &motion);
        pairs.push((g.symbol_expr(symbol), value));
        pairs.push((g.symbol(g.symbol_name(symbol), 1), moved));
    }
    let residuals: Vec<Expr> = stated.iter().map(|e| g.sub(e.left, e.right)).collect();
    let residuals = g.substitute_all(&residuals, &pairs);
    let verdict = cx.prover.identity(system, &residuals, &manifold(cx), "");
    Some(trial(
        "the motion is an extremal with its κ",
        "",
        Expected::Proved,
        verdict,
    ))
}

/// Suslov's form without Σ θ A is wrong, unless this vanishes along the motion.
fn terms_dropped(subject: &Subject<'_>) -> Option<Trial> {
    let lagrangian = chetaev_mechanics::mass::with_velocity(subject.cx.system).is_none();
    if subject.natural.dependent.is_empty() || !lagrangian {
        return None;
    }
    let (_, terms) = curvature_and_terms(subject)?;
    let (expected, about) = match terms {
        Size::Zero => (Expected::Proved, "Σ θ A vanishes"),
        Size::NotZero => (Expected::Refuted, "Σ θ A is missing"),
        Size::Unclear => return None,
    };
    let d = Displacements::new(subject.cx).ok()?;
    let local = local_equations(subject.cx, &d, &suslov::without_terms(&d));
    let verdict = holds_on_motions(subject.cx, &d, &local).ok()?;
    Some(trial(
        "Suslov's form without its terms",
        about,
        expected,
        verdict,
    ))
}

/// Free ends without the end term Σ p δq.
fn ends_left_open(subject: &Subject<'_>) -> Option<Trial> {
    if !applies(subject, "second-kind.integral", Some("free")) {
        return None;
    }
    let cx = subject.cx;
    let curve = StateCurve::new(cx);
    let varied = curve.vary(cx, curve.density(cx));
    let left = curve.end_terms(cx, &varied, Ends::Free, false);
    let free = chetaev_mechanics::Manifold::default();
    let verdict = cx.prover.identity(cx.system, &left, &free, "");
    Some(trial(
        "free ends without the end term",
        "Σ p δq is left",
        Expected::Refuted,
        verdict,
    ))
}
