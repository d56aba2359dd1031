//! Meetings of the component of a motion with others: the motion passes, ends, or goes on along the one that is asked for.

use crate::component::{vanishes, Component};
use crate::crossing::Crossing;
use crate::factors::{on_another, Factor, Other};
use crate::follow::magnitude;
use crate::functions::FunctionsError;
use crate::happening::EventWatched;
use crate::observe::Observer;
use crate::run::{add, Run, RunError, RunSettings, Subject, Watcher};
use crate::stop;
use chetaev_integrate::{Direction, Note};
use chetaev_mechanics::{words, ConstraintKind, Formulation};
use chetaev_symbolic::factors::quotient;
use chetaev_symbolic::{rational, Expr, Graph};
use std::collections::BTreeSet;

/// One below this part of its largest value along the motion vanishes on the way.
const MET: f64 = 1e-6;
/// Where the rate of a factor is below this part of its largest value, the components touch.
const TOUCHING: f64 = 1e-4;
/// The part of the rest of a run in which a component that is left is not looked for.
const LEAVING: f64 = 1e-3;
/// So many events are looked for of each other component.
const LOOKS: usize = 2;
/// So small a rate of a factor, over the length of the run, is that of a constant.
const CONSTANT: f64 = 1e-9;
/// A factor below this part of its terms is zero all along.
const VANISHES: f64 = 1e-8;

/// Another component: the number of the constraint, and the factor that vanishes on it.
type Which = (usize, Expr);

/// A component beside that of the motion.
struct Beside<'f> {
    /// The factor that the motion keeps.
    factor: &'f Factor,
    other: &'f Other,
}

impl Beside<'_> {
    fn which(&self) -> Which {
        (self.factor.constraint, self.other.function)
    }
}

impl Subject<'_> {
    /// Integrates on the component on which the motion starts, and from one to another where that is asked for; in rows and events stand
    /// the multipliers of the constraints as stated.
    pub(crate) fn on_component(
        &self,
        formulation: &'static dyn Formulation,
        settings: &RunSettings,
        watcher: &mut Watcher<'_>,
    ) -> Result<Run, RunError> {
        let (mut run, mut met) = self.up_to_meeting(formulation, (settings, None), watcher)?;
        let mut settings = settings.clone();
        let mut component: Option<Component> = None;
        for (text, chosen) in settings.crossings.clone() {
            let Some((t, which)) = met else { break };
            let subject = component.as_ref().map(|own| own.subject(self.binding));
            let subject = subject.as_ref().unwrap_or(self);
            let Some((next, left)) = subject.beyond(&run, which, chosen) else {
                let reason = format!(
                    "{}; `crossings` names `{text}` for this place, which is none of the two",
                    run.ending.reason
                );
                run.ending = stop::undetermined(reason, t);
                break;
            };
            let is_later = |x: f64| if settings.t_end < t { x < t } else { x > t };
            settings.times.retain(|&x| is_later(x));
            let on = next.subject(self.binding);
            let rank = on.selection.rows.len();
            let crossing = Crossing {
                t,
                rank: (rank, rank.saturating_sub(1)),
                onto: Some(text),
            };
            met = if let Some(further) = on.met_at_start(left) {
                run.crossings.push(crossing);
                run.ending = stop::undetermined(on.reason(further, t), t);
                Some((t, further))
            } else {
                let going = (&mut run, crossing);
                on.leave(formulation, (&settings, left), going, watcher)?
            };
            component = Some(next);
        }
        Ok(run)
    }

    /// Goes on from a place where two components meet: at first without looking for the one that is left, then as ever. Where the motion
    /// meets another one again.
    fn leave(
        &self,
        formulation: &'static dyn Formulation,
        (settings, left): (&RunSettings, Which),
        (run, crossing): (&mut Run, Crossing),
        watcher: &mut Watcher<'_>,
    ) -> Result<Option<(f64, Which)>, RunError> {
        let span = settings.t_end - self.start.t;
        let near = self.start.t + LEAVING * span;
        let is_near = |x: f64| (x - near) * span <= 0.0;
        let mut first = settings.clone();
        first.t_end = near;
        first.times.retain(|&x| is_near(x));
        first.times.push(near);
        let (mut part, met) = self.up_to_meeting(formulation, (&first, Some(left)), watcher)?;
        if let Some(which) = self.stays_on_both(&part)? {
            let t = self.start.t;
            let reason = format!("{}, and so do those that follow", self.reason(which, t));
            run.ending = stop::undetermined(reason, t);
            return Ok(None);
        }
        let is_left = part.ending.finished;
        let next = is_left.then(|| self.again(&part)).flatten();
        part.ends_between |= !settings.times.contains(&near);
        run.crossings.push(crossing);
        run.go_on(part);
        let Some(next) = next else {
            return Ok(met);
        };
        let mut rest = settings.clone();
        rest.times.retain(|&x| !is_near(x));
        let on = next.subject(self.binding);
        let (part, met) = on.up_to_meeting(formulation, (&rest, None), watcher)?;
        run.go_on(part);
        Ok(met)
    }

    /// The component from the last state of a run on.
    fn again(&self, run: &Run) -> Option<Component> {
        Component::from_last(self.system.clone(), self, run, self.factors.to_vec())
    }

    /// Another component, than the one that is left, on which the start lies.
    fn met_at_start(&self, left: Which) -> Option<Which> {
        let lies_on = |e: Expr| vanishes(self, e) == Some(true);
        let is_met = |own: &Beside<'_>| {
            let other = own.other;
            lies_on(other.function) && (!other.is_of_place || lies_on(other.rate))
        };
        let mut all = self.others().into_iter();
        let found = all.find(|own| own.which() != left && is_met(own));
        found.map(|own| own.which())
    }

    /// Another component on which all states of a run lie.
    fn stays_on_both(&self, run: &Run) -> Result<Option<Which>, FunctionsError> {
        let (others, g) = (self.others(), &self.system.graph);
        let sizes = |e: Expr| [e, magnitude(g, self.system.defined(e))];
        let functions = others.iter().flat_map(|own| sizes(own.other.function));
        let functions: Vec<Expr> = functions.collect();
        let mut observer =
            Observer::with_own(self.system, self.terms, self.binding, &run.own, &functions)?;
        let rows: Vec<Vec<f64>> = (0..run.len())
            .map(|j| observer.at(run.times[j], run.row(j)))
            .collect();
        let is_zero = |place: &usize| {
            let mut all = rows.iter();
            all.all(|row| row[2 * place].abs() <= VANISHES * row[2 * place + 1])
        };
        let found = (0..others.len()).find(is_zero);
        Ok(found.map(|place| others[place].which()))
    }

    /// Integrates on one component up to where it meets another one, so that the motion is not determined, if it does: the time, and the other.
    /// One that is left is not looked for.
    fn up_to_meeting(
        &self,
        formulation: &'static dyn Formulation,
        (stated, left): (&RunSettings, Option<Which>),
        watcher: &mut Watcher<'_>,
    ) -> Result<(Run, Option<(f64, Which)>), RunError> {
        let mut others = self.others();
        others.retain(|own| Some(own.which()) != left);
        let mut settings = stated.clone();
        self.state_on_factors(&mut settings.events);
        let own = settings.events.len();
        let span = settings.t_end - self.start.t;
        let looks = others.iter().flat_map(|own| self.looks(own.other, span));
        settings.events.extend(looks);
        let mut run = self.integrated(formulation, &settings, watcher)?;
        let met = self.met(&others, &run, own)?;
        settings.events.truncate(own);
        if let Some((t, which)) = met.ended {
            let is_asked = settings.times.contains(&t);
            let is_before = |x: f64| if span < 0.0 { x > t } else { x < t };
            settings.t_end = t;
            settings.times.retain(|&x| is_before(x));
            settings.times.push(t);
            run = self.integrated(formulation, &settings, watcher)?;
            run.ends_between = !is_asked;
            run.ending = stop::undetermined(self.reason(which, t), t);
        }
        run.events.retain(|event| event.event < own);
        let is_own = |note: &Note| event_of(note).is_none_or(|event| event < own);
        run.notes.retain(is_own);
        let passed = self.passages(&met.passed, span);
        run.crossings.extend(passed);
        let forward = 1.0_f64.copysign(span);
        run.crossings
            .sort_by(|a, b| (forward * a.t).total_cmp(&(forward * b.t)));
        self.state_multipliers(&mut run)?;
        Ok((run, met.ended))
    }

    /// Passages of other components: the rank falls by one for each constraint that meets one at a time.
    fn passages(&self, passed: &[(f64, Which)], span: f64) -> Vec<Crossing> {
        let rank = self.selection.rows.len();
        let mut found: Vec<(f64, BTreeSet<usize>)> = Vec::new();
        for &(t, (constraint, _)) in passed {
            let is_same = |own: &&mut (f64, _)| (own.0 - t).abs() <= CONSTANT * span.abs();
            match found.iter_mut().find(is_same) {
                Some((_, all)) => {
                    all.insert(constraint);
                }
                None => found.push((t, BTreeSet::from([constraint]))),
            }
        }
        let crossing = |(t, all): (f64, BTreeSet<usize>)| Crossing {
            t,
            rank: (rank, rank.saturating_sub(all.len())),
            onto: None,
        };
        found.into_iter().map(crossing).collect()
    }

    /// The component on which a motion goes on from its last state, at which two meet: that on which this function vanishes. `None`
    /// where it is neither.
    fn beyond(&self, run: &Run, which: Which, function: Expr) -> Option<(Component, Which)> {
        let mut others = self.others().into_iter();
        let met = others.find(|own| own.which() == which)?;
        let g = &self.system.graph;
        let moves = |s| self.system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
        let is_same = |e: Expr| {
            let ratio = quotient(g, function, e);
            ratio.is_some_and(|ratio| g.is_free_of(ratio, &moves) && !g.is_zero(ratio))
        };
        let mut factors = self.factors.to_vec();
        let number = met.factor.constraint;
        let mut left = which;
        let system = if is_same(met.factor.function) {
            self.system.clone()
        } else if is_same(met.other.function) {
            let other = met.other.function;
            let (system, factor) = on_another(self.system, met.factor, other)?;
            let mut all = factors.iter_mut();
            let place = all.find(|own| own.constraint == number)?;
            *place = factor;
            left = (number, met.factor.function);
            system
        } else {
            return None;
        };
        let next = Component::from_last(system, self, run, factors)?;
        Some((next, left))
    }

    fn others(&self) -> Vec<Beside<'_>> {
        let all = self.factors.iter().flat_map(|factor| {
            let others = factor.others.iter();
            others.map(move |other| Beside { factor, other })
        });
        all.collect()
    }

    /// The events that a factor is zero, and that its square is least, as where components touch; where the factor is constant there are none.
    fn looks(&self, other: &Other, span: f64) -> [EventWatched; LOOKS] {
        let g = &self.system.graph;
        let slow = rational::from_f64(CONSTANT / span.abs().max(f64::MIN_POSITIVE));
        let shift = slow.map_or(g.zero(), |slow| g.mul(&[g.number(slow), other.function]));
        let look = |value: Expr, direction: Direction| EventWatched {
            name: format!("{} = 0", g.text(other.function)),
            value,
            direction,
            stops: false,
        };
        let slope = g.mul(&[other.function, g.sub(other.rate, shift)]);
        [
            look(other.function, Direction::Both),
            look(slope, Direction::Up),
        ]
    }

    /// Multipliers in events are those of the constraints as stated.
    fn state_on_factors(&self, events: &mut [EventWatched]) {
        let g = &self.system.graph;
        let stated = self.factors.iter().map(|factor| {
            let own = self.multiplier(factor, g);
            (own, g.div(own, factor.rest))
        });
        let stated: Vec<(Expr, Expr)> = stated.collect();
        for event in events {
            event.value = g.substitute(event.value, &stated);
        }
    }

    fn multiplier(&self, factor: &Factor, g: &Graph) -> Expr {
        let name = &self.system.constraints[factor.constraint].name;
        g.symbol(&format!("lambda_{name}"), 0)
    }

    /// Where the motion meets other components: it passes, or is not determined beyond.
    fn met(&self, others: &[Beside<'_>], run: &Run, own: usize) -> Result<Met, FunctionsError> {
        let functions = others.iter().flat_map(|o| [o.other.function, o.other.rate]);
        let functions: Vec<Expr> = functions.collect();
        let mut observer =
            Observer::with_own(self.system, self.terms, self.binding, &run.own, &functions)?;
        let mut largest = vec![0.0_f64; functions.len()];
        let rows = (0..run.len()).map(|j| (run.times[j], run.row(j)));
        let at_events = run.events.iter().map(|event| (event.t, &event.row[..]));
        for (t, row) in rows.chain(at_events) {
            let values = observer.at(t, row);
            let sizes = largest.iter_mut().zip(values);
            sizes.for_each(|(most, value)| *most = most.max(value.abs()));
        }
        let mut found = Met::default();
        for event in run.events.iter().filter(|event| event.event >= own) {
            let place = (event.event - own) / LOOKS;
            let values = observer.at(event.t, &event.row);
            let [value, rate] = [2 * place, 2 * place + 1].map(|k| (values[k].abs(), largest[k]));
            if value.0 > MET * value.1 {
                continue;
            }
            let which = others[place].which();
            if others[place].other.is_of_place && rate.0 > TOUCHING * rate.1 {
                found.passed.push((event.t, which));
                continue;
            }
            found.ended = Some((event.t, which));
            break;
        }
        Ok(found)
    }

    /// Why the motion is not determined beyond a time at which it lies on another component too.
    fn reason(&self, (constraint, other): Which, t: f64) -> String {
        let g = &self.system.graph;
        let own = &self.system.constraints[constraint];
        let mut factors = self.factors.iter();
        let kept = factors.find(|factor| factor.constraint == constraint);
        let why = if own.kind == ConstraintKind::Holonomic {
            "they touch, so that the velocity lies on both"
        } else {
            "the velocity lies on both"
        };
        format!(
            "the components {} = 0 and {} = 0 of the constraint `{}` meet at t = {}: {why}; the motion beyond is not determined",
            kept.map_or(String::new(), |factor| g.text(factor.function)),
            g.text(other),
            own.name,
            words::precise_number(t)
        )
    }

    /// Writes the multipliers of the constraints as stated into the rows.
    fn state_multipliers(&self, run: &mut Run) -> Result<(), FunctionsError> {
        let rests: Vec<Expr> = self.factors.iter().map(|factor| factor.rest).collect();
        let mut observer =
            Observer::with_own(self.system, self.terms, self.binding, &run.own, &rests)?;
        let of_constraint = |l: usize| self.terms.constraint_index.iter().position(|&own| own == l);
        let places = self.factors.iter().map(|f| of_constraint(f.constraint));
        let places: Vec<Option<usize>> = places.collect();
        let (width, lambda) = (run.layout.len(), run.layout.lambda());
        let mut state = |t: f64, row: &mut [f64]| {
            let rests = observer.at(t, row);
            for (place, rest) in places.iter().zip(rests) {
                if let Some(place) = place {
                    row[lambda.start + place] /= rest;
                }
            }
        };
        for (t, row) in run.times.iter().zip(run.rows.chunks_mut(width.max(1))) {
            state(*t, row);
        }
        for event in &mut run.events {
            state(event.t, &mut event.row);
        }
        Ok(())
    }
}

/// The number of the event that a note is about.
fn event_of(note: &Note) -> Option<usize> {
    match *note {
        Note::Grazing { event, .. }
        | Note::EventUnresolved { event, .. }
        | Note::EventUnknown { event, .. } => Some(event),
        _ => None,
    }
}

impl Run {
    /// Adds the motion from the last state on.
    fn go_on(&mut self, part: Run) {
        if self.ends_between {
            self.times.pop();
            self.rows.truncate(self.times.len() * self.layout.len());
        }
        self.times.extend(part.times);
        self.rows.extend(part.rows);
        self.events.extend(part.events);
        self.crossings.extend(part.crossings);
        self.chart_changes.extend(part.chart_changes);
        self.notes.extend(part.notes);
        add(&mut self.statistics, &part.statistics);
        (self.t, self.ending, self.ends_between) = (part.t, part.ending, part.ends_between);
        if let (Some(own), Some(further)) = (&mut self.drift, &part.drift) {
            own.go_on(further);
        }
        let further = part.followed.iter();
        let both = self.followed.iter_mut().zip(further);
        both.for_each(|(own, further)| own.go_on(further));
        self.kept = part.kept.or(self.kept.take());
    }
}

/// What became of the motion where it met other components.
#[derive(Default)]
struct Met {
    /// Times at which it passed, with the components.
    passed: Vec<(f64, Which)>,
    /// The time at which it is not determined, and the component met.
    ended: Option<(f64, Which)>,
}
