//! What is asked of a study, and what it may use from outside.

use chetaev_mechanics::claims::Decided;
use chetaev_mechanics::{Claim, Group};
use chetaev_model::model::Precision;
use chetaev_motion::DoubleDouble;
use std::sync::atomic::AtomicBool;

/// Which claims are wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClaimSelection {
    /// Groups and ids; empty for everything.
    pub words: Vec<String>,
}

impl ClaimSelection {
    /// Everything.
    pub fn all() -> ClaimSelection {
        ClaimSelection::default()
    }

    /// What a motion alone is asked for: its drift.
    pub fn of_motion() -> ClaimSelection {
        ClaimSelection {
            words: ["motion.constraint-drift", "motion.integral-drift"]
                .map(String::from)
                .to_vec(),
        }
    }

    /// What the story of the principles tells; with the constrained extremum beside the motion where they are compared.
    pub fn of_principles(compared: bool) -> ClaimSelection {
        let mut words = [
            "principles",
            "formulation.vakonomic-coincides",
            "model.hessian-regular",
        ]
        .map(String::from)
        .to_vec();
        if compared {
            words.push("motion.constraint-drift".into());
        }
        ClaimSelection { words }
    }

    /// Reads `model,formulations,energy.integral`.
    ///
    /// # Errors
    /// The first word that is neither a group nor an id of `known`.
    pub fn parse(text: &str, known: &[&'static dyn Claim]) -> Result<ClaimSelection, String> {
        let words: Vec<String> = text
            .split(',')
            .map(|w| w.trim().to_string())
            .filter(|w| !w.is_empty())
            .collect();
        for word in &words {
            let id = word.split('#').next().unwrap_or(word);
            let is_group = Group::ALL.iter().any(|g| g.word() == word);
            if !is_group && !known.iter().any(|c| c.id() == id) {
                return Err(word.clone());
            }
        }
        Ok(ClaimSelection { words })
    }

    /// Whether the claim `full` of `claim` is wanted.
    pub fn wants(&self, claim: &dyn Claim, full: &str) -> bool {
        self.words.is_empty()
            || self
                .words
                .iter()
                .any(|word| word == claim.group().word() || word == claim.id() || word == full)
    }

    /// What was asked of subjects that the claims do not have for this system.
    pub(crate) fn without_subject(&self, verdicts: &[Decided]) -> Vec<String> {
        let asked = self.words.iter().filter(|word| word.contains('#'));
        asked
            .filter(|word| !verdicts.iter().any(|d| d.full_id() == **word))
            .map(|word| format!("`{word}` was asked for, and this system has no such claim"))
            .collect()
    }

    /// Whether a witness is asked for by its id: it needs a motion, which the group of principles alone does not.
    pub(crate) fn names_witness(&self) -> bool {
        self.words.iter().any(|word| word.starts_with("witness."))
    }

    /// Witnesses asked for by their ids that there are none of.
    pub(crate) fn without_witness(&self, verdicts: &[Decided]) -> Vec<String> {
        let ids = self
            .words
            .iter()
            .filter(|word| word.starts_with("witness.") && !word.contains('#'));
        ids.filter(|id| !verdicts.iter().any(|d| d.claim == **id))
            .map(|id| format!("`{id}` was asked for; it needs a computed motion of constraints of order one, and a small system"))
            .collect()
    }

    /// Whether any subject of a claim may be wanted.
    pub fn wants_claim(&self, claim: &dyn Claim) -> bool {
        self.words.is_empty()
            || self.words.iter().any(|word| {
                let id = word.split('#').next().unwrap_or(word);
                word == claim.group().word() || id == claim.id()
            })
    }

    /// Whether any claim of `group` may be wanted.
    pub fn wants_group(&self, group: Group, known: &[&'static dyn Claim]) -> bool {
        self.words.is_empty()
            || self.words.iter().any(|word| {
                let id = word.split('#').next().unwrap_or(word);
                word == group.word() || known.iter().any(|c| c.id() == id && c.group() == group)
            })
    }
}

/// Options of a study; `None` leaves the choice to the model, and where the model is silent, to the program.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyOptions {
    /// Which claims.
    pub claims: ClaimSelection,
    /// Work for all claims together, in seconds by [`UNITS_PER_SECOND`](chetaev_symbolic::meter::UNITS_PER_SECOND).
    pub budget: f64,
    /// Seconds for which searches choose what they look at, where it is not the budget: a replay with more time looks at the same.
    pub searches_for: Option<f64>,
    /// End of the run.
    pub t_end: Option<f64>,
    /// The same with all its digits, for a run in double-double arithmetic; where it is missing, `t_end` is exact.
    pub t_end_exact: Option<DoubleDouble>,
    /// Relative tolerance.
    pub tolerance: Option<f64>,
    /// Fixed step, for methods without an error estimate.
    pub step: Option<f64>,
    /// Name of the method.
    pub method: Option<String>,
    /// The arithmetic of the motion.
    pub precision: Option<Precision>,
    /// Formulation that is integrated for the trajectory.
    pub formulation: Option<String>,
    /// Whether inadmissible initial data are projected.
    pub project: bool,
    /// Whether the first integrals found are kept by projection, beside what the model says.
    pub keep_integrals: bool,
    /// Branch of the motion that is followed, counted from 1.
    pub branch: Option<usize>,
    /// Seed of the random choices in proofs.
    pub seed: Option<u64>,
    /// Replay proofs with another parametrization.
    pub replay: bool,
    /// Whether to estimate the global error by a second run.
    pub global_error: bool,
    /// Whether to compute the motion at all.
    pub motion: bool,
    /// Whether the constrained extremum is computed beside the motion, and initial values of its multipliers `kappa_NAME`; those
    /// that are not given are what the model states, else what `hamilton.stationary` finds for every motion, else zero.
    pub extremum: Option<Vec<(String, f64)>>,
}

/// Seconds for all claims together, where nothing else is asked for.
const USUAL_BUDGET: f64 = 60.0;

impl StudyOptions {
    /// How much work searches may do, as a multiple of the usual.
    pub(crate) fn work(&self) -> f64 {
        self.searches_for.unwrap_or(self.budget) / USUAL_BUDGET
    }
}

impl Default for StudyOptions {
    fn default() -> StudyOptions {
        StudyOptions {
            claims: ClaimSelection::all(),
            budget: USUAL_BUDGET,
            searches_for: None,
            t_end: None,
            t_end_exact: None,
            tolerance: None,
            step: None,
            method: None,
            precision: None,
            formulation: None,
            project: false,
            keep_integrals: false,
            branch: None,
            seed: None,
            replay: false,
            global_error: true,
            motion: true,
            extremum: None,
        }
    }
}

/// Clock, interruption and progress.
pub struct Hooks<'a> {
    /// Seconds since some moment.
    pub clock: &'a (dyn Fn() -> f64 + Sync),
    /// When it becomes true, the study ends soon and keeps what it has.
    pub interrupt: Option<&'a AtomicBool>,
    /// What is being done, and how much of it in [0, 1] where known.
    pub progress: &'a mut dyn FnMut(&str, Option<f64>),
}

impl std::fmt::Debug for Hooks<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Hooks")
    }
}
