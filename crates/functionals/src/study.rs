//! All claims about one model file.

use crate::claims::{Claim, Context, Finding, CLAIMS};
use crate::functional::Problem;
use crate::ritz::Approximation;
use crate::variation::{variation, Variation, VariationError};
use chetaev_model::decision::full_id;
use chetaev_symbolic::meter::{within, Stopped, Work, UNITS_PER_SECOND};
use chetaev_symbolic::syntax::names::closest;
use chetaev_symbolic::Verdict;
use std::sync::Arc;

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
    /// What Ritz's method found, by degree.
    pub approximations: Vec<Approximation>,
    /// What a reader must know.
    pub notices: Vec<String>,
    /// The work that the claims could do, in seconds by [`UNITS_PER_SECOND`].
    pub budget: f64,
    /// Whether somebody ended it before all claims were decided.
    pub is_interrupted: bool,
}

/// How much work the claims may do, and what is told of it.
pub struct Pace<'a> {
    /// The work of all claims together, in seconds by [`UNITS_PER_SECOND`].
    pub budget: f64,
    /// The same work, which somebody else may stop.
    pub work: Arc<Work>,
    /// Seconds since some moment.
    pub clock: &'a dyn Fn() -> f64,
    /// Hears which claim is being decided.
    pub progress: &'a mut dyn FnMut(&str),
}

/// Seconds for all claims together, where nothing else is asked for.
pub const USUAL_BUDGET: f64 = 60.0;

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

/// Decides every claim that `wants` accepts by its id, within the usual budget; `clock` gives seconds.
pub fn study(problem: Problem, wants: &dyn Fn(&str) -> bool, clock: &dyn Fn() -> f64) -> Study {
    let work = Work::of_seconds(USUAL_BUDGET);
    let pace = Pace {
        budget: USUAL_BUDGET,
        work,
        clock,
        progress: &mut |_| {},
    };
    study_at(problem, wants, pace)
}

/// The same at a pace: what is left when the work is spent, or stopped, is undecided and says so.
pub fn study_at(mut problem: Problem, wants: &dyn Fn(&str) -> bool, pace: Pace<'_>) -> Study {
    // Of claims that nobody asks for nothing is expected.
    problem.expected.retain(|(name, _)| {
        let id = name.split('#').next().unwrap_or(name);
        wants(id) || CLAIMS.iter().all(|claim| claim.id() != id)
    });
    let (verdicts, variation, approximations) = {
        (pace.progress)("the first variation");
        let cx = Context::new(problem.of_claims());
        let mut verdicts = Vec::new();
        for claim in CLAIMS.iter().filter(|claim| wants(claim.id())) {
            for subject in claim.subjects(&cx) {
                (pace.progress)(&full_id(claim.id(), subject.as_deref()));
                verdicts.push(decided(*claim, &cx, subject, &pace));
            }
        }
        let written = problem.valued.is_some();
        let variation = if written {
            variation(&problem.functional)
        } else {
            cx.variation
        };
        (verdicts, variation, cx.approximations.into_inner())
    };
    let mut study = Study {
        problem,
        variation,
        verdicts,
        approximations,
        notices: Vec::new(),
        budget: pace.budget,
        is_interrupted: pace.work.stopped() == Some(Stopped::Interrupted),
    };
    study.notices = study.unmatched();
    study
}

/// What is known of a claim that was stopped.
fn stopped_verdict(stopped: Stopped, budget: f64) -> Verdict {
    Verdict::undecided(match stopped {
        Stopped::Spent => format!(
            "the work of the budget was spent ({budget} s at {UNITS_PER_SECOND:e} units per second); a larger --budget decides more"
        ),
        Stopped::Late => format!(
            "time: the claims took far more than the {budget} s of their budget on this machine"
        ),
        Stopped::Interrupted => "interrupted before this claim was decided".to_owned(),
    })
}

fn decided(
    claim: &'static dyn Claim,
    cx: &Context<'_>,
    subject: Option<String>,
    pace: &Pace<'_>,
) -> Decided {
    let start = (pace.clock)();
    let found = within(&pace.work, || {
        crate::claims::decided(claim, cx, subject.as_deref())
    });
    let finding = found.unwrap_or_else(|why| stopped_verdict(why, pace.budget).into());
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
        seconds: (pace.clock)() - start,
        expected: of_all.map_or(Vec::new(), |(_, words)| words.clone()),
    }
}
