//! What the model expects of its verdicts and of the end of its motion.

use crate::error::{StudyError, UnknownClaim};
use crate::options::StudyOptions;
use crate::registry::registry;
use crate::start::number;
use crate::study::{Decided, Motion, Outcome};
use chetaev_mechanics::claims::{full_id, Registry};
use chetaev_model::model::Model;
use chetaev_symbolic::syntax::names;
use chetaev_symbolic::Expr;

/// Every claim of which the model expects something exists.
pub(crate) fn check_expectations(model: &Model, known: &Registry) -> Result<(), StudyError> {
    let ids = || known.claims().iter().map(|c| c.id());
    let claims: Vec<UnknownClaim> = model
        .expect
        .verdicts
        .iter()
        .filter(|e| ids().all(|id| id != e.claim))
        .map(|e| UnknownClaim {
            near: names::closest(&e.claim, ids()),
            claim: e.claim.clone(),
            place: e.place,
        })
        .collect();
    match claims.is_empty() {
        true => Ok(()),
        false => Err(StudyError::UnknownClaims { claims }),
    }
}

pub(crate) fn expected(model: &Model, claim: &str, subject: Option<&str>) -> Vec<String> {
    let stated = |of: Option<&str>| -> Vec<String> {
        let verdicts = model.expect.verdicts.iter();
        verdicts
            .filter(|e| e.claim == claim && e.subject.as_deref() == of)
            .flat_map(|e| e.verdicts.iter().cloned())
            .collect()
    };
    // What is said of one subject goes before what is said of all.
    let own = subject.map_or(Vec::new(), |s| stated(Some(s)));
    if own.is_empty() {
        stated(None)
    } else {
        own
    }
}

pub(crate) fn outcome(model: &Model, verdicts: &[Decided], motion: Option<&Motion>) -> Outcome {
    if let Some(motion) = motion {
        let ending = &motion.evidence.run.ending;
        if !ending.finished && !stop_is_expected(model, motion) {
            return Outcome::Stopped;
        }
        let awaited = model.expect.stop.is_some() && ending.finished;
        if awaited {
            return Outcome::Unmet;
        }
    }
    if verdicts.iter().all(Decided::is_as_expected) {
        Outcome::Done
    } else {
        Outcome::Unmet
    }
}

/// Expectations about a subject that the claim does not have for this system: they can never be met.
pub(crate) fn unmatched(
    model: &Model,
    verdicts: &[Decided],
    options: &StudyOptions,
) -> Vec<String> {
    let known = registry();
    let expected = model.expect.verdicts.iter().filter_map(|expected| {
        let full = full_id(&expected.claim, Some(expected.subject.as_deref()?));
        let claim = known.find(&expected.claim)?;
        let of_claim: Vec<&Decided> = verdicts
            .iter()
            .filter(|d| d.claim == expected.claim)
            .collect();
        let is_decided = of_claim.iter().any(|d| d.subject == expected.subject);
        if is_decided || of_claim.is_empty() || !options.claims.wants(claim, &full) {
            return None;
        }
        let subjects: Vec<&str> = of_claim
            .iter()
            .filter_map(|d| d.subject.as_deref())
            .collect();
        Some(format!(
            "[expect] names `{full}`, which this system does not have; of this claim it has: {}",
            subjects.join(", ")
        ))
    });
    expected.collect()
}

/// Whether the model declares the stop that happened.
pub(crate) fn stop_is_expected(model: &Model, motion: &Motion) -> bool {
    let ending = &motion.evidence.run.ending;
    let Some(stop) = &model.expect.stop else {
        return false;
    };
    if ending.finished || ending.interrupted {
        return false;
    }
    let values: Vec<(Expr, Expr)> = model.parameter_values();
    let near = match stop.at.and_then(|t| number(&model.graph, t, &values)) {
        Some(at) => (ending.t - at).abs() <= 1e-2 * (1.0 + at.abs()),
        None => true,
    };
    near && ending.reason.contains(&stop.reason)
}
