//! A run that is made step by step, so that several may go on in turns. A watched quantity that comes near zero ends a piece of
//! it, and the run where it is zero.

use crate::crossing::{self, Crossing, Passage, Path, State};
use crate::happening::{self, Passed, WithEvents};
use crate::run::{End, Looking, RunError, RunSettings, Subject, WatchedFlow, Watcher};
use crate::sticking::STUCK;
use crate::stop;
use crate::watch::Watched;
use chetaev_integrate::{
    Direction, Event, EventKind, EventRecord, Expansion, HaltReason, Output, Solution, Stepping,
    Stop,
};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// What a run gave.
pub(crate) struct Pieces {
    /// The pieces that have ended.
    pub(crate) solutions: Vec<Solution>,
    /// How many quantities were watched.
    pub(crate) watched: usize,
    /// Where the rank fell on the way.
    pub(crate) crossings: Vec<Crossing>,
}

/// A run on the way, of a flow that is handed in at every step.
pub(crate) struct Course<'o> {
    watched: Vec<Watched>,
    /// Whether each of the watched quantities was looked at last where it is not zero.
    passed: Vec<Option<Passed>>,
    /// The pieces that have ended.
    pieces: Vec<Solution>,
    crossings: Vec<Crossing>,
    stepping: Option<Stepping<'o>>,
    events: Vec<Event<'static>>,
    /// Where the run begins.
    begun: f64,
    /// Where the next piece begins.
    at: (f64, Vec<f64>),
    /// Storage for an output row.
    row: Vec<f64>,
    interrupt: Option<&'o AtomicBool>,
    /// On the way to a zero on which the motion sticks.
    approach: Option<Approach>,
    end: Option<End>,
}

/// The approach to a zero on which the motion sticks, from one side: each piece ends before it.
#[derive(Clone, Copy, Debug)]
struct Approach {
    /// The end of the piece.
    until: f64,
    /// How many pieces there were.
    pieces: u32,
}

/// So much of the way to the zero is gone in one piece.
const PIECE: f64 = 0.875;
/// An eighth is left after each piece: more of them than digits are not made.
const MOST_PIECES: u32 = 24;

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
            crossings: Vec::new(),
            begun: at.0,
            stepping: None,
            events: Vec::new(),
            at,
            row: Vec::new(),
            interrupt,
            approach: None,
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
                let scales = if looking.scales.len() == y.len() {
                    &looking.scales[..]
                } else {
                    &[]
                };
                let measure = (absolute, scales);
                let mut options = subject.options(settings, t, measure, self.interrupt)?;
                self.events = happening::events(own, &settings.events);
                let until = self.approach.map_or(settings.t_end, |own| own.until);
                if let Output::Times(times) = &mut options.output {
                    times.retain(|&own| (until - own) * (until - t) >= 0.0);
                }
                let (span, events) = ((t, until), &mut self.events);
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
        self.end = self.after(solution, (subject, flow), settings, looking);
        Ok(self.end.is_none())
    }

    /// What follows the end of a piece; `None` for another piece.
    fn after<F: WatchedFlow>(
        &mut self,
        mut solution: Solution,
        (subject, flow): (&Subject<'_>, &mut F),
        settings: &RunSettings,
        looking: &mut Looking,
    ) -> Option<End> {
        let own = self.watched.len();
        let (t, stop) = (solution.t, solution.stop);
        let is_met = matches!(
            stop,
            Stop::Halted {
                reason: HaltReason::Custom(crossing::MET),
                ..
            }
        );
        let falls = match is_met {
            true => flow.seems_to_fall(),
            false if fails(&stop) => flow.track().and_then(|track| track.ahead()),
            false => None,
        };
        if let Some(guess) = falls {
            let passed = self.pass(&mut solution, flow, guess, (settings, looking));
            if let Some(end) = passed {
                self.pieces.push(solution);
                return end;
            }
        }
        if is_met {
            // Nothing is met: the run goes on from here.
            self.at = (t, solution.state.clone());
            forget_unasked(&mut solution, settings);
            self.pieces.push(solution);
            return None;
        }
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
        let is_stuck = matches!(
            stop,
            Stop::Halted {
                reason: HaltReason::Custom(STUCK),
                ..
            }
        );
        let is_piece =
            self.approach.is_some() && matches!(stop, Stop::Finished | Stop::StepTooSmall { .. });
        if is_stuck || is_piece {
            return self.approach(flow, stop, settings);
        }
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
                    self.go_on(settings);
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

    /// Goes back before the zero on which the motion sticks and up to it from that side alone, until the time to it is rounding; what follows a
    /// piece of this.
    fn approach<F: WatchedFlow>(
        &mut self,
        flow: &mut F,
        stop: Stop,
        settings: &RunSettings,
    ) -> Option<End> {
        let is_beyond = matches!(stop, Stop::Halted { .. });
        let is_at_end = matches!(stop, Stop::StepTooSmall { .. });
        let pieces = self.approach.map_or(0, |own| own.pieces);
        let mut rest = flow.sticking().and_then(|own| own.rest()).unwrap_or(0.0);
        let before = flow.sticking().filter(|_| is_beyond);
        if let Some(before) = before.and_then(|own| own.before()) {
            // A piece that goes beyond the zero after all is halved.
            rest = before.rest * 0.5_f64.powi(pieces.min(1) as i32);
            let is_later = |t: f64| (t - before.t) * (settings.t_end - before.t) > 0.0;
            for piece in &mut self.pieces {
                leave_out(piece, &is_later);
            }
            self.at = (before.t, before.y);
        } else if is_beyond {
            rest = 0.0;
        }
        let t = self.at.0;
        let is_rounding =
            is_at_end || rest.abs() <= 1e-3 * settings.tolerance * (t - self.begun).abs();
        if is_rounding || pieces >= MOST_PIECES || !rest.is_finite() {
            let text = flow.sticking().and_then(|own| own.text());
            let text = text.unwrap_or("what is under a sign");
            return Some(End::Vanished(stop::stuck(text, t + rest)));
        }
        if !is_beyond {
            self.go_on(settings);
        }
        self.approach = Some(Approach {
            until: t + PIECE * rest,
            pieces: pieces + 1,
        });
        None
    }

    /// Nothing ends where the last piece did: its row is kept only where it was asked for.
    fn go_on(&mut self, settings: &RunSettings) {
        if let Some(piece) = self.pieces.last_mut() {
            forget_unasked(piece, settings);
        }
    }

    /// Follows the motion past a place where the rank seems to fall; what follows then, or `None` where nothing was found out.
    fn pass<F: WatchedFlow>(
        &mut self,
        solution: &mut Solution,
        flow: &mut F,
        guess: f64,
        (settings, looking): (&RunSettings, &mut Looking),
    ) -> Option<Option<End>> {
        let accuracy = settings.tolerance.clamp(3e-12, 1e-8);
        let (from, passage) = flow.track()?.pass(guess, accuracy);
        let (paths, crossing, why) = match passage {
            Passage::Unknown => return None,
            Passage::Passed { paths, crossing } => (paths, crossing, None),
            Passage::Ended { paths, why } => (paths, None, Some(why)),
        };
        flow.forget_step();
        let forward = settings.t_end >= from;
        let is_later = |a: f64, b: f64| if forward { a > b } else { a < b };
        for piece in self.pieces.iter_mut().chain([&mut *solution]) {
            leave_out(piece, &|t| is_later(t, from));
        }
        self.crossings
            .retain(|crossing| !is_later(crossing.t, from));
        let last = paths.last().map_or(from, |path| path.end().t);
        let end = why.as_ref().map_or(last, |why| why.t);
        let until = if is_later(end, settings.t_end) {
            settings.t_end
        } else {
            end
        };
        let mut along = Along {
            paths: &paths,
            flow,
        };
        let stopped = self.events_on(solution, &mut along, (from, until), (settings, looking));
        let until = stopped.as_ref().map_or(until, |(t, _)| *t);
        let mut times: Vec<f64> = settings
            .times
            .iter()
            .copied()
            .filter(|&t| is_later(t, from) && !is_later(t, until))
            .collect();
        if (stopped.is_some() || why.is_some()) && times.last() != Some(&until) {
            times.push(until);
        }
        for t in times {
            if let Some(row) = along.row(t) {
                solution.times.push(t);
                solution.rows.extend(row);
            }
        }
        self.crossings
            .extend(crossing.filter(|crossing| !is_later(crossing.t, until)));
        let state = along.state(until).unwrap_or(State {
            t: from,
            q: Vec::new(),
            v: Vec::new(),
        });
        solution.t = until;
        if let Some((_, ending)) = stopped {
            return Some(Some(End::Happened(ending)));
        }
        if let Some(why) = why.filter(|why| !is_later(why.t, until)) {
            return Some(Some(End::Vanished(stop::undetermined(why.reason, why.t))));
        }
        let y = flow.enter(&state)?;
        solution.state.clone_from(&y);
        self.at = (until, y.clone());
        Some((until == settings.t_end).then_some(End::Stopped(Stop::Finished, until, y)))
    }

    /// Events of the model on the way: the zeros of their functions between places close to each other. The one that ends the run.
    fn events_on<F: WatchedFlow>(
        &self,
        solution: &mut Solution,
        along: &mut Along<'_, F>,
        (from, until): (f64, f64),
        (settings, looking): (&RunSettings, &mut Looking),
    ) -> Option<(f64, stop::Ending)> {
        const PARTS: usize = 64;
        let own = self.watched.len();
        let mut ended: Option<(f64, stop::Ending)> = None;
        for (k, observer) in looking.observers.iter_mut().enumerate() {
            let event = &settings.events[k];
            let mut value = |t: f64, along: &mut Along<'_, F>| {
                along.row(t).map_or(f64::NAN, |row| observer.value(t, &row))
            };
            let time = |i: usize| from + (until - from) * i as f64 / PARTS as f64;
            let mut before = value(from, along);
            for i in 1..=PARTS {
                let after = value(time(i), along);
                let rises = before < 0.0 && after >= 0.0;
                let falls = before > 0.0 && after <= 0.0;
                let counts = match event.direction {
                    Direction::Up => rises,
                    Direction::Down => falls,
                    _ => rises || falls,
                };
                if counts {
                    let (mut low, mut high) = (time(i - 1), time(i));
                    for _ in 0..60 {
                        let middle = 0.5 * (low + high);
                        if (value(middle, along) > 0.0) == (before > 0.0) {
                            low = middle
                        } else {
                            high = middle
                        }
                    }
                    solution.events.push(EventRecord {
                        t: high,
                        index: own + k,
                        kind: if rises {
                            EventKind::Up
                        } else {
                            EventKind::Down
                        },
                        row: along.row(high).unwrap_or_default(),
                    });
                    let is_first = ended
                        .as_ref()
                        .is_none_or(|(t, _)| (high - t) * (until - from) < 0.0);
                    if event.stops && is_first {
                        ended = Some((high, stop::happened(&event.name, high)));
                    }
                }
                before = after;
            }
        }
        let end = ended.as_ref().map_or(until, |(t, _)| *t);
        solution
            .events
            .retain(|event| (event.t - end) * (until - from) <= 0.0);
        solution
            .events
            .sort_by(|a, b| ((a.t - b.t) * (until - from)).total_cmp(&0.0));
        ended
    }

    /// The pieces, and why it ended; an interruption where it has not.
    pub(crate) fn finish(self) -> (Pieces, End) {
        let (t, y) = self.at;
        let end = self
            .end
            .unwrap_or(End::Stopped(Stop::Interrupted { t }, t, y));
        let pieces = Pieces {
            solutions: self.pieces,
            watched: self.watched.len(),
            crossings: self.crossings,
        };
        (pieces, end)
    }
}

/// The motion along paths, as a flow sees it.
struct Along<'p, F> {
    paths: &'p [Path],
    flow: &'p mut F,
}

impl<F: WatchedFlow> Along<'_, F> {
    fn path(&self, t: f64) -> Option<(&Path, f64)> {
        let mut parts = self
            .paths
            .iter()
            .map(|path| (path, (t - path.start) / path.length));
        let within = |(_, theta): &(&Path, f64)| (-1e-9..=1.0 + 1e-9).contains(theta);
        parts.rfind(within)
    }

    fn state(&self, t: f64) -> Option<State> {
        let (path, theta) = self.path(t)?;
        let state = if theta >= 1.0 {
            path.end()
        } else {
            path.at(theta)
        };
        Some(State { t, ..state })
    }

    fn row(&mut self, t: f64) -> Option<Vec<f64>> {
        let (path, theta) = self.path(t)?;
        let (state, a) = (self.state(t)?, path.accelerations(theta));
        let lambda = self.flow.track()?.reactions(&state);
        self.flow.row_of(&state, &a, &lambda)
    }
}

/// Whether the integrator could not go on.
fn fails(stop: &Stop) -> bool {
    matches!(
        stop,
        Stop::Singular { .. }
            | Stop::Divergence { .. }
            | Stop::StepTooSmall { .. }
            | Stop::NotFinite { .. }
            | Stop::Halted {
                reason: HaltReason::RankDrop { .. },
                ..
            }
    )
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

/// Leaves out the rows and events of some times at the end of a piece.
fn leave_out(piece: &mut Solution, is_later: &dyn Fn(f64) -> bool) {
    while piece.times.last().is_some_and(|&t| is_later(t)) {
        forget_last(piece);
    }
    piece.events.retain(|event| !is_later(event.t));
}

/// Forgets the row at the end of a piece, where nobody asked for it.
fn forget_unasked(piece: &mut Solution, settings: &RunSettings) {
    if piece.times.last() == Some(&piece.t) && !settings.times.contains(&piece.t) {
        forget_last(piece);
    }
}

fn forget_last(solution: &mut Solution) {
    solution.times.pop();
    let rows = solution.times.len() * solution.width;
    solution.rows.truncate(rows);
}
