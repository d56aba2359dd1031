//! The claims with their evidence, for the page.

use crate::plain;
use crate::record::bound_text;
use crate::study::Decided;
use crate::typeset::Typesetter;
use chetaev_mechanics::Finding;
use chetaev_report::data::{Claim, Equation, Verdict as Word};
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::Verdict;

pub(crate) fn word(verdict: &str) -> Word {
    Word::ALL
        .into_iter()
        .find(|w| w.key() == verdict)
        .unwrap_or(Word::Undecided)
}

/// In place of a long formula of a claim.
const UNPRINTED: &str = "This formula is too long to be read.";

/// One claim.
pub(super) fn claim(decided: &Decided, set: &Typesetter<'_>) -> Claim {
    let finding: &Finding = &decided.finding;
    let written = |text: &str| plain::written(set.system(), text);
    let (told, how) = plain::told(finding.verdict.detail());
    let (_, lines) = plain::listed(finding.verdict.detail());
    let mut claim = Claim {
        lines: lines.iter().map(|line| written(line)).collect(),
        claim: decided.claim.into(),
        subject: decided.subject.clone(),
        title: Some(decided.title.into()),
        verdict: word(finding.verdict.word()),
        detail: written(&told),
        computed: (!how.is_empty()).then_some(how),
        requires: decided.requires.clone(),
        // Of several verdicts that the model accepts, the one found.
        expected: match decided.expected.first() {
            Some(_) if decided.is_as_expected() => Some(word(finding.verdict.word())),
            first => first.map(|w| word(w)),
        },
        seconds: Some(decided.seconds),
        formulas: finding
            .formulas
            .iter()
            .map(|f| {
                let short = set.simplified(&[f.right]).pop().unwrap_or(f.right);
                let printed = match f.left {
                    Some(left) => set.equation(left, short),
                    None => set.expression(short),
                };
                Equation {
                    caption: Some(f.caption.clone()),
                    omitted: printed.omitted.as_ref().map(|_| UNPRINTED.to_owned()),
                    ..printed
                }
            })
            .collect(),
        ..Claim::default()
    };
    evidence(&mut claim, &finding.verdict);
    claim.condition = claim.condition.map(|text| written(&text));
    claim.counterexample = claim.counterexample.map(|text| written(&text));
    claim
}

pub(crate) fn evidence(claim: &mut Claim, verdict: &Verdict) {
    match verdict {
        Verdict::Proved(proof) | Verdict::Conditional { proof, .. } => {
            claim.method = Some(proof.method.word().into());
            claim.on = Some(proof.on.clone());
            claim.error_bound = proof.error_bound_log2.map(bound_text);
            claim.samples = (proof.samples > 0).then_some(u64::from(proof.samples));
            claim.seed = proof.seed;
        }
        Verdict::Numerical(evidence) => {
            claim.on = Some(evidence.region.clone());
            claim.samples = Some(u64::from(evidence.samples));
            claim.residual = Some(format!("{:.2e}", evidence.residual));
            claim.seed = evidence.seed;
        }
        Verdict::Refuted(found) => claim.counterexample = Some(counterexample(found)),
        Verdict::NotApplicable { hypothesis, .. } => claim.condition = Some(hypothesis.clone()),
        Verdict::Undecided { .. } => {}
    }
    if let Verdict::Conditional {
        condition,
        counterexample: elsewhere,
        ..
    } = verdict
    {
        claim.condition = Some(condition.clone());
        claim.counterexample = elsewhere.as_ref().map(counterexample);
    }
}

/// What does not vanish, and where.
fn counterexample(found: &Counterexample) -> String {
    let point = chetaev_mechanics::words::point(found, |_| true);
    let at = match point.is_empty() {
        true => String::new(),
        false => format!("at {point}: "),
    };
    let (low, high) = &found.residual;
    format!("{at}{} in [{low}, {high}]", found.quantity)
}
