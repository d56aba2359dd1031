//! All claims about one model file.

use crate::claims::{Claim, Context, Finding, CLAIMS};
use crate::functional::Problem;
use crate::variation::{variation, Variation, VariationError};
use chetaev_model::decision::full_id;
use chetaev_symbolic::syntax::names::closest;
use chetaev_symbolic::Verdict;

/// A claim about a functional with its verdict.
pub type Decided = chetaev_model::decision::Decided<Finding>;

/// The word of the group that all claims of this crate are of.
pub const GROUP: &str = "functional";

/// A functional with everything that is known about it.
#[derive(Debug)]
pub struct Study {
    /// What the file states.
    pub problem: Problem,
    /// The first variation.
    pub variation: Result<Variation, VariationError>,
    /// Verdicts.
    pub verdicts: Vec<Decided>,
    /// What a reader must know.
    pub notices: Vec<String>,
}

impl Study {
    /// Whether everything that the model expects is met.
    pub fn is_as_expected(&self) -> bool {
        self.verdicts.iter().all(Decided::is_as_expected) && self.unmatched().is_empty()
    }

    /// Expectations that no claim meets.
    fn unmatched(&self) -> Vec<String> {
        let ids: Vec<&str> = CLAIMS.iter().map(|c| c.id()).collect();
        let mut found = Vec::new();
        for (name, _) in &self.problem.expected {
            let is_there = self
                .verdicts
                .iter()
                .any(|d| d.full_id() == *name || d.claim == *name);
            if !is_there {
                let id = name.split('#').next().unwrap_or(name);
                let near = if ids.contains(&id) {
                    String::new()
                } else {
                    closest(id, ids.iter().copied())
                        .map_or(String::new(), |near| format!("; did you mean `{near}`?"))
                };
                found.push(format!(
                    "[expect] names `{name}`, which is not claimed of this functional{near}"
                ));
            }
        }
        found
    }
}

/// Decides every claim that `wants` accepts by its id; `clock` gives seconds.
pub fn study(problem: Problem, wants: &dyn Fn(&str) -> bool, clock: &dyn Fn() -> f64) -> Study {
    let (verdicts, variation) = {
        let cx = Context::new(problem.of_claims());
        let mut verdicts = Vec::new();
        for claim in CLAIMS.iter().filter(|claim| wants(claim.id())) {
            for subject in claim.subjects(&cx) {
                verdicts.push(decided(*claim, &cx, subject, clock));
            }
        }
        let written = problem.valued.is_some();
        let variation = if written {
            variation(&problem.functional)
        } else {
            cx.variation
        };
        (verdicts, variation)
    };
    let mut study = Study {
        problem,
        variation,
        verdicts,
        notices: Vec::new(),
    };
    study.notices = study.unmatched();
    study
}

fn decided(
    claim: &'static dyn Claim,
    cx: &Context<'_>,
    subject: Option<String>,
    clock: &dyn Fn() -> f64,
) -> Decided {
    let start = clock();
    let finding = claim.decide(cx, subject.as_deref());
    let full = full_id(claim.id(), subject.as_deref());
    let expected = cx.problem.expected.iter();
    let own = expected.clone().find(|(name, _)| *name == full);
    let of_all = own.or_else(|| {
        cx.problem
            .expected
            .iter()
            .find(|(name, _)| name == claim.id())
    });
    // What a file expects of general parameters it does not expect of values laid over them.
    let is_of_others = !cx.problem.text.overrides.is_empty()
        && matches!(finding.verdict, Verdict::NotApplicable { .. });
    let of_all = of_all.filter(|_| !is_of_others);
    Decided {
        claim: claim.id(),
        subject,
        title: claim.title(),
        group: GROUP,
        requires: Vec::new(),
        finding,
        seconds: clock() - start,
        expected: of_all.map_or(Vec::new(), |(_, words)| words.clone()),
    }
}
