//! What the model expects of its verdicts and of the end of its motion.

use crate::error::{StudyError, UnknownClaim};
use crate::options::StudyOptions;
use crate::registry::registry;
use crate::start::number;
use crate::study::{Decided, Motion, Outcome};
use chetaev_mechanics::claims::{full_id, Registry};
use chetaev_model::model::Model;
use chetaev_symbolic::syntax::names;
use chetaev_symbolic::{Expr, Verdict};

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
    let agree = contradictions(verdicts).is_empty();
    if agree && verdicts.iter().all(Decided::is_as_expected) {
        Outcome::Done
    } else {
        Outcome::Unmet
    }
}

/// What the witness of a principle refutes along the motion: what is stated of the system and what is computed of its motion
/// cannot both be true, and neither is to be trusted. A witness is refuted only where the principle is stated of the motion.
pub(crate) fn contradictions(verdicts: &[Decided]) -> Vec<String> {
    let refuted = verdicts.iter().filter(|d| {
        d.claim.starts_with("witness.") && matches!(d.finding.verdict, Verdict::Refuted(_))
    });
    refuted
        .map(|d| {
            let full = d.full_id();
            format!("`{full}` contradicts what is proved: one of the two is wrong, the proof or the motion computed")
        })
        .collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use chetaev_mechanics::Group;
    use chetaev_symbolic::verdict::Counterexample;
    use std::sync::Arc;

    fn decided(claim: &'static str) -> Decided {
        let found = Counterexample {
            point: Vec::new(),
            quantity: "δ∫L dt".into(),
            residual: ("1".into(), "1".into()),
            detail: "it does not vanish".into(),
        };
        Decided {
            claim,
            subject: None,
            title: "",
            group: Group::Principles.word(),
            requires: Vec::new(),
            finding: Arc::new(Verdict::Refuted(found).into()),
            seconds: 0.0,
            expected: Vec::new(),
        }
    }

    /// A principle may be refuted of a system; its witness may not, as it is refuted only against what is stated.
    #[test]
    fn a_refuting_witness_is_a_contradiction() {
        let of = |claim| contradictions(&[decided(claim)]).len();
        assert_eq!(of("hamilton.stationary"), 0);
        assert_eq!(of("witness.stationary"), 1);
    }
}
