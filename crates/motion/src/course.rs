//! A run that is made step by step, so that several may go on in turns. A watched quantity that comes near zero ends a piece of
//! it, and the run where it is zero.

use crate::happening::{self, Passed, WithEvents};
use crate::multiplier_flow::STUCK;
use crate::run::{End, Looking, RunError, RunSettings, Subject, WatchedFlow, Watcher};
use crate::stop;
use crate::watch::Watched;
use chetaev_integrate::{Event, Expansion, HaltReason, Solution, Stepping, Stop};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// A run on the way, of a flow that is handed in at every step.
pub(crate) struct Course<'o> {
    watched: Vec<Watched>,
    /// Whether each of the watched quantities was looked at last where it is not zero.
    passed: Vec<Option<Passed>>,
    /// The pieces that have ended.
    pieces: Vec<Solution>,
    stepping: Option<Stepping<'o>>,
    events: Vec<Event<'static>>,
    /// Where the next piece begins.
    at: (f64, Vec<f64>),
    /// Storage for an output row.
    row: Vec<f64>,
    interrupt: Option<&'o AtomicBool>,
    end: Option<End>,
}

impl<'o> Course<'o> {
    /// A run from the state y at time t.
    pub(crate) fn new(
        watched: Vec<Watched>,
        at: (f64, Vec<f64>),
        interrupt: Option<&'o AtomicBool>,
    ) -> Course<'o> {
        Course {
            passed: vec![None; watched.len()],
            watched,
            pieces: Vec::new(),
            stepping: None,
            events: Vec::new(),
            at,
            row: Vec::new(),
            interrupt,
            end: None,
        }
    }

    /// The expansion with which the next step begins, where it is known.
    pub(crate) fn next_expansion(&mut self) -> Option<Expansion<'_>> {
        self.stepping.as_mut()?.next_expansion()
    }

    /// The integration on the way.
    pub(crate) fn stepping(&mut self) -> Option<&mut Stepping<'o>> {
        self.stepping.as_mut()
    }

    /// Makes one step, or begins a piece; false when the run has ended.
    ///
    /// # Errors
    /// [`RunError`] where a piece cannot begin.
    pub(crate) fn advance<F: WatchedFlow>(
        &mut self,
        (subject, flow): (&Subject<'_>, &mut F),
        settings: &RunSettings,
        (looking, watcher): (&mut Looking, &mut Watcher<'_>),
    ) -> Result<bool, RunError> {
        if self.end.is_some() {
            return Ok(false);
        }
        let own = self.watched.len();
        let absolute = match self.stepping {
            Some(_) => Vec::new(),
            None => looking.absolute(self.at.1.len()),
        };
        let mut with_events = WithEvents {
            flow: &mut *flow,
            own,
            observers: &mut looking.observers,
            values: &looking.values,
            row: &mut self.row,
            passed: &self.passed,
        };
        let stepping = match &mut self.stepping {
            Some(stepping) => stepping,
            none => {
                let (t, y) = (self.at.0, &self.at.1[..]);
                let scales = match looking.scales.len() == y.len() {
                    true => &looking.scales[..],
                    false => &[],
                };
                let measure = (absolute, scales);
                let options = subject.options(settings, t, measure, self.interrupt)?;
                self.events = happening::events(own, &settings.events);
                let (span, events) = ((t, settings.t_end), &mut self.events);
                let begun = Stepping::new(&with_events, span, y, events, options);
                none.insert(begun.map_err(|problem| subject.named(problem))?)
            }
        };
        let goes_on = stepping.advance(&mut with_events, &mut self.events);
        if goes_on && !is_broken(watcher, stepping) {
            return Ok(true);
        }
        let ended = self.stepping.take();
        let Some(solution) = ended.map(|stepping| stepping.finish(&mut with_events)) else {
            return Ok(false);
        };
        self.end = self.after(solution, (subject, flow), settings);
        Ok(self.end.is_none())
    }

    /// What follows the end of a piece; `None` for another piece.
    fn after<F: WatchedFlow>(
        &mut self,
        mut solution: Solution,
        (subject, flow): (&Subject<'_>, &mut F),
        settings: &RunSettings,
    ) -> Option<End> {
        let own = self.watched.len();
        let (t, stop) = (solution.t, solution.stop);
        self.at = (t, solution.state.clone());
        let y = &self.at.1[..];
        if let Stop::Halted {
            reason: HaltReason::LeftConstraint { .. },
            ..
        } = stop
        {
            keep_until(&mut solution, flow.settled());
        }
        self.pieces.push(solution);
        let vanished = |index: usize, t: f64| {
            stop::vanished(&self.watched[index], t, &subject.constraint_names())
        };
        match stop {
            Stop::Event { index, t } if index >= own => {
                let event = &settings.events[index - own];
                return Some(End::Happened(stop::happened(&event.name, t)));
            }
            Stop::Event { index, t } => {
                if flow.vanishes(index, t, y) {
                    return Some(End::Vanished(vanished(index, t)));
                }
                let forward = settings.t_end >= subject.start.t;
                self.passed[index] = Some(Passed::at(t, forward, self.passed[index]));
                if t != settings.t_end {
                    // Nothing ends here: the row is kept only where it was asked for.
                    if let Some(piece) = self.pieces.last_mut() {
                        if piece.times.last() == Some(&t) && !settings.times.contains(&t) {
                            forget_last(piece);
                        }
                    }
                    return None;
                }
            }
            Stop::Crowd { index, t, count } => {
                let what = match index.checked_sub(own) {
                    Some(event) => format!("the event `{}`", settings.events[event].name),
                    None => "a quantity whose vanishing makes the equations singular".to_owned(),
                };
                return Some(End::Vanished(stop::crowd(&what, t, count)));
            }
            Stop::Halted {
                t,
                reason: HaltReason::Custom(STUCK),
            } => {
                let text = flow.stuck().unwrap_or("what is under a sign");
                return Some(End::Vanished(stop::stuck(text, t)));
            }
            Stop::Halted {
                t,
                reason: HaltReason::Custom(index),
            } if (index as usize) < own => {
                // The last accepted state lies a little before a mass is lost.
                let index = index as usize;
                let lost = flow
                    .lost_mass((t, None), y)
                    .filter(|(own, _)| *own == index);
                let t = lost.map_or(t, |(_, t)| t);
                return Some(End::Vanished(vanished(index, t)));
            }
            _ => {}
        }
        let is_singular = !matches!(
            stop,
            Stop::Finished | Stop::Interrupted { .. } | Stop::Event { .. }
        );
        let at = match stop {
            Stop::Singular { t, .. } => Some(t),
            Stop::Divergence { singularity, .. } => Some(singularity),
            _ => None,
        };
        if let Some((index, t)) = flow.lost_mass((t, at), y).filter(|_| is_singular) {
            let names = &subject.numeric.constraints;
            return Some(End::Vanished(stop::vanished(
                &self.watched[index],
                t,
                names,
            )));
        }
        Some(End::Stopped(stop, t, y.to_vec()))
    }

    /// The pieces, how many quantities were watched, and why it ended; an interruption where it has not.
    pub(crate) fn finish(self) -> (Vec<Solution>, usize, End) {
        let (t, y) = self.at;
        let end = self
            .end
            .unwrap_or(End::Stopped(Stop::Interrupted { t }, t, y));
        (self.pieces, self.watched.len(), end)
    }
}

/// Whether the watcher wants no further step.
fn is_broken(watcher: &mut Watcher<'_>, stepping: &Stepping<'_>) -> bool {
    let progress = stepping.progress();
    match &mut watcher.progress {
        Some(report) if progress.steps > 0 => report(progress) == ControlFlow::Break(()),
        _ => false,
    }
}

/// Drops the rows after time t.
fn keep_until(solution: &mut Solution, t: f64) {
    while solution
        .times
        .last()
        .is_some_and(|&last| (last - t) * (solution.t - t).signum() > 0.0)
    {
        forget_last(solution);
    }
}

fn forget_last(solution: &mut Solution) {
    solution.times.pop();
    let rows = solution.times.len() * solution.width;
    solution.rows.truncate(rows);
}
