//! Trajectories by Routh's equations, derived and compiled once.

use crate::outcome::{Outcome, Shape};
use crate::pool::{Work, Worker};
use chetaev_motion::{
    consistent_state, Binding, CompiledRouth, ConsistentState, InitialData, RunSettings, Subject,
    Watcher,
};
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// What one trajectory begins with.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Values of the parameters in the order of the binding; `None` for those of the binding.
    pub parameters: Option<Vec<f64>>,
    /// Given and free initial data.
    pub data: InitialData,
    /// How it is run. Method, variables, events, and what is followed and kept are those of the ensemble.
    pub settings: RunSettings,
}

/// The trajectories of an ensemble.
pub trait Members: Sync {
    /// How many.
    fn count(&self) -> u64;

    /// What trajectory `index` begins with.
    ///
    /// # Errors
    /// Why it cannot begin, in words.
    fn member(&self, index: u64) -> Result<Member, String>;

    /// Whether trajectory `index` may begin at its state.
    ///
    /// # Errors
    /// Why not, in words.
    fn check(&self, index: u64, start: &ConsistentState) -> Result<(), String>;
}

/// An ensemble integrated by Routh's equations.
#[derive(Debug)]
pub struct Routh<'a, M> {
    members: M,
    subject: Subject<'a>,
    compiled: CompiledRouth,
    shape: Shape,
}

impl<'a, M: Members> Routh<'a, M> {
    /// Trajectories of the system of `subject`, whose start does not matter, from what was compiled.
    pub fn new(
        members: M,
        subject: Subject<'a>,
        compiled: CompiledRouth,
        shape: Shape,
    ) -> Routh<'a, M> {
        Routh {
            members,
            subject,
            compiled,
            shape,
        }
    }
}

impl<M: Members> Work for Routh<'_, M> {
    fn worker(&self) -> Box<dyn Worker + '_> {
        Box::new(Thread {
            ensemble: self,
            compiled: self.compiled.clone(),
            is_set: false,
        })
    }

    fn count(&self) -> u64 {
        self.members.count()
    }
}

/// One thread at work.
struct Thread<'e, 'a, M> {
    ensemble: &'e Routh<'a, M>,
    compiled: CompiledRouth,
    /// Whether other parameters than those of the binding are set.
    is_set: bool,
}

impl<M: Members> Worker for Thread<'_, '_, M> {
    fn block(&mut self, range: Range<u64>, interrupt: &AtomicBool) -> Option<Vec<Outcome>> {
        let mut outcomes = Vec::with_capacity((range.end - range.start) as usize);
        for index in range {
            let outcome = match self.outcome(index, interrupt) {
                Ok(outcome) => outcome?,
                Err(reason) => Outcome::not_started(self.ensemble.shape, reason),
            };
            outcomes.push(outcome);
        }
        Some(outcomes)
    }
}

impl<M: Members> Thread<'_, '_, M> {
    /// One trajectory; `None` when it was interrupted.
    fn outcome(&mut self, index: u64, interrupt: &AtomicBool) -> Result<Option<Outcome>, String> {
        let Routh {
            members,
            subject,
            shape,
            ..
        } = self.ensemble;
        let member = members.member(index)?;
        self.set(subject.binding, member.parameters.as_deref())?;
        let start = consistent_state(self.compiled.numeric(), &member.data);
        let start = start.map_err(|problem| problem.to_string())?;
        members.check(index, &start)?;
        let subject = Subject {
            start: &start,
            ..*subject
        };
        let mut watcher = Watcher {
            interrupt: Some(interrupt),
            progress: None,
        };
        let settings = &member.settings;
        let run = subject
            .routh_by(&mut self.compiled, settings, &mut watcher)
            .map_err(|problem| problem.to_string())?;
        if run.ending.interrupted {
            return Ok(None);
        }
        Ok(Some(Outcome::of(&run, &start, settings, *shape)))
    }

    /// Sets the parameters of a member.
    fn set(&mut self, binding: &Binding, parameters: Option<&[f64]>) -> Result<(), String> {
        let values = match parameters {
            Some(values) => values.to_vec(),
            None if self.is_set => binding.parameters.iter().map(|(_, value)| *value).collect(),
            None => return Ok(()),
        };
        self.is_set = true;
        let set = self.compiled.set_parameters(&values);
        set.map_err(|problem| problem.to_string())
    }
}
