//! Trajectories by Routh's equations, derived and compiled once.

use crate::outcome::{Outcome, Shape};
use crate::pool::{Work, Worker};
use chetaev_motion::{
    consistent_state, Binding, CompiledRouth, ConsistentState, InitialData, RouthCourse,
    RunSettings, SideBySide, Subject, Watcher,
};
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
    /// How many trajectories a thread computes in turns.
    places: usize,
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
            shape,
            places: compiled.abreast(),
            compiled,
        }
    }

    /// The same with so many trajectories in turns on each thread; each has the same bits whatever the number.
    #[must_use]
    pub fn in_turns(mut self, places: usize) -> Routh<'a, M> {
        self.places = places.clamp(1, self.compiled.abreast());
        self
    }
}

impl<M: Members> Work for Routh<'_, M> {
    fn worker(&self, most: usize) -> Box<dyn Worker + '_> {
        let mut compiled = self.compiled.clone();
        let place = |compiled| Place {
            compiled,
            is_set: false,
        };
        let others: Vec<CompiledRouth> = (1..self.places.min(most))
            .map(|_| compiled.copy())
            .collect();
        let mut places = vec![place(compiled)];
        places.extend(others.into_iter().map(place));
        Box::new(Thread {
            ensemble: self,
            places,
            side_by_side: SideBySide::default(),
        })
    }

    fn count(&self) -> u64 {
        self.members.count()
    }
}

/// One thread at work on as many trajectories as there are places, in turns: their series are made side by side.
struct Thread<'e, 'a, M> {
    ensemble: &'e Routh<'a, M>,
    places: Vec<Place>,
    side_by_side: SideBySide,
}

/// Where one trajectory at a time is computed.
struct Place {
    compiled: CompiledRouth,
    /// Whether other parameters than those of the binding are set.
    is_set: bool,
}

/// A trajectory on the way.
struct Trajectory<'o> {
    index: u64,
    start: ConsistentState,
    settings: RunSettings,
    course: RouthCourse<'o>,
}

impl<M: Members> Worker for Thread<'_, '_, M> {
    fn work(
        &mut self,
        next: &dyn Fn() -> Option<u64>,
        done: &dyn Fn(u64, Outcome),
        interrupt: &AtomicBool,
    ) {
        let shape = self.ensemble.shape;
        let mut running: Vec<Option<Trajectory<'_>>> = Vec::new();
        running.resize_with(self.places.len(), || None);
        loop {
            for (place, slot) in self.places.iter_mut().zip(&mut running) {
                while slot.is_none() {
                    let Some(index) = next() else { break };
                    match place.begin(self.ensemble, index, interrupt) {
                        Ok(trajectory) => *slot = Some(trajectory),
                        Err(reason) => done(index, Outcome::not_started(shape, reason)),
                    }
                }
            }
            if running.iter().all(Option::is_none) {
                return;
            }
            let pairs = running.iter_mut().zip(&mut self.places);
            self.side_by_side
                .look_ahead(pairs.map(|(slot, place)| match slot {
                    Some(trajectory) => Some((&mut trajectory.course, &mut place.compiled)),
                    None => None,
                }));
            for (place, slot) in self.places.iter_mut().zip(&mut running) {
                let Some(trajectory) = slot else { continue };
                let advanced = place.advance(self.ensemble, trajectory, interrupt);
                if matches!(advanced, Ok(true)) {
                    continue;
                }
                let Some(trajectory) = slot.take() else {
                    continue;
                };
                let index = trajectory.index;
                match advanced {
                    Err(reason) => done(index, Outcome::not_started(shape, reason)),
                    // What was interrupted has no outcome.
                    Ok(_) => {
                        if let Some(outcome) = place.finish(self.ensemble, trajectory) {
                            done(index, outcome);
                        }
                    }
                }
            }
        }
    }
}

impl Place {
    /// Begins a trajectory.
    fn begin<'o, M: Members>(
        &mut self,
        ensemble: &Routh<'_, M>,
        index: u64,
        interrupt: &'o AtomicBool,
    ) -> Result<Trajectory<'o>, String> {
        let member = ensemble.members.member(index)?;
        self.set(ensemble.subject.binding, member.parameters.as_deref())?;
        let start = consistent_state(self.compiled.numeric(), &member.data);
        let start = start.map_err(|problem| problem.to_string())?;
        ensemble.members.check(index, &start)?;
        let settings = member.settings;
        let subject = Subject {
            start: &start,
            ..ensemble.subject
        };
        let course = subject.begin_routh(&mut self.compiled, &settings, Some(interrupt));
        Ok(Trajectory {
            index,
            start,
            settings,
            course,
        })
    }

    /// Makes one step; false when the trajectory has ended.
    fn advance<M: Members>(
        &mut self,
        ensemble: &Routh<'_, M>,
        trajectory: &mut Trajectory<'_>,
        interrupt: &AtomicBool,
    ) -> Result<bool, String> {
        let subject = Subject {
            start: &trajectory.start,
            ..ensemble.subject
        };
        let mut watcher = Watcher {
            interrupt: Some(interrupt),
            progress: None,
        };
        let with = (&subject, &mut self.compiled);
        let course = &mut trajectory.course;
        let advanced = course.advance(with, &trajectory.settings, &mut watcher);
        advanced.map_err(|problem| problem.to_string())
    }

    /// What is kept of a trajectory that has ended; `None` when it was interrupted.
    fn finish<M: Members>(
        &mut self,
        ensemble: &Routh<'_, M>,
        trajectory: Trajectory<'_>,
    ) -> Option<Outcome> {
        let Trajectory {
            start,
            settings,
            course,
            ..
        } = trajectory;
        let subject = Subject {
            start: &start,
            ..ensemble.subject
        };
        let run = course.finish((&subject, &mut self.compiled), &settings);
        let outcome = Outcome::of(&run, &start, &settings, ensemble.shape);
        (!run.ending.interrupted).then_some(outcome)
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
