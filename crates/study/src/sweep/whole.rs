//! Trajectories whose equations depend on their start: each is a motion by itself, derived once and compiled each time.

use super::{times, with_values, Sweep};
use crate::error::StudyError;
use crate::start::{add_jets, check_rank, settings, start_of_motion};
use chetaev_ensemble::{Outcome, Work, Worker};
use chetaev_mechanics::System;
use chetaev_motion::{Component, ConsistentState, Run, RunSettings, Subject, Watcher};
use std::sync::atomic::AtomicBool;

/// The trajectories of a sweep, each from the model with its values written in.
pub(crate) struct Whole<'s>(pub(crate) &'s Sweep);

impl Work for Whole<'_> {
    fn worker(&self, _: usize) -> Box<dyn Worker + '_> {
        Box::new(Whole(self.0))
    }

    fn count(&self) -> u64 {
        self.0.count()
    }
}

impl Worker for Whole<'_> {
    fn work(
        &mut self,
        next: &dyn Fn() -> Option<u64>,
        done: &dyn Fn(u64, Outcome),
        interrupt: &AtomicBool,
    ) {
        let shape = self.0.shape();
        while let Some(index) = next() {
            let outcome = match self.run(index, interrupt) {
                Ok((run, ..)) if run.ending.interrupted => return,
                Ok((run, start, settings)) => Outcome::of(&run, &start, &settings, shape),
                Err(problem) => Outcome::not_started(shape, problem.to_string()),
            };
            done(index, outcome);
        }
    }
}

impl Whole<'_> {
    fn run(
        &self,
        index: u64,
        interrupt: &AtomicBool,
    ) -> Result<(Run, ConsistentState, RunSettings), StudyError> {
        let sweep = self.0;
        let options = &sweep.options.study;
        let model = with_values(&sweep.model, &sweep.variations, &sweep.values(index));
        let system = System::from_model(&model)?;
        let prepared = &sweep.prepared;
        let start = start_of_motion(&model, &system, &prepared.terms, options)?;
        let mut start = start.map_err(|why| StudyError::NoMotion {
            why: why.to_string(),
        })?;
        match prepared.terms.order {
            1 => check_rank(&start, prepared.selection.rows.len())?,
            _ => {
                let chosen = (&prepared.terms, &prepared.selection);
                add_jets(&model, &system, chosen, &mut start, options)?;
            }
        }
        let mut settings = settings(&model, &system, start.start.t, options)?;
        settings.times = times(start.start.t, settings.t_end, sweep.options.samples);
        settings.keep = sweep.settings.keep.clone();
        let subject = Subject {
            system: &system,
            terms: &prepared.terms,
            selection: &prepared.selection,
            binding: &start.binding,
            numeric: &start.numeric,
            start: &start.start,
            factors: &[],
        };
        let component = Component::of_start(&subject);
        let subject = component
            .as_ref()
            .map_or(subject, |own| own.subject(&start.binding));
        let mut watcher = Watcher {
            interrupt: Some(interrupt),
            progress: None,
        };
        let run = subject.by(sweep.formulation, &settings, &mut watcher)?;
        Ok((run, start.start, settings))
    }
}
