//! Motions of constraints that are products: on the component on which they start.
//!
//! `(y − x²)(y + x) = 0` holds on two curves, and a motion stays on the one on which it starts as long as its state lies on no other. So
//! it is computed with the factor that vanishes, whose gradient does not where the curves cross: no method and no tolerance takes
//! another branch. The multiplier of the constraint as stated is that of the factor over what the factor is multiplied by. Where a state
//! of the motion lies on another component too, both contain the motion so far, and it is not determined beyond: the other factor
//! is zero there, and with it its rate, where it is a function of the place alone (velocities are continuous).

use crate::chart::{self, Floor};
use crate::crossing::Crossing;
use crate::factors::{on_another, on_component, Factor, Other};
use crate::follow::magnitude;
use crate::functions::FunctionsError;
use crate::happening::EventWatched;
use crate::initial::{consistent_state, ConsistentState, InitialData};
use crate::numeric::{Binding, NumericSystem};
use crate::observe::Observer;
use crate::run::{add, Run, RunError, RunSettings, Subject, Watcher};
use crate::stop;
use chetaev_integrate::{Direction, Note};
use chetaev_mechanics::{words, Formulation, MotionTerms, Selection, System};
use chetaev_symbolic::factors::quotient;
use chetaev_symbolic::{rational, Expr, Graph, Symbol};
use std::collections::BTreeSet;

/// A factor below this part of its terms vanishes at a start.
const VANISHES: f64 = 1e-8;
/// One below this part of its largest value along the motion vanishes on the way.
const MET: f64 = 1e-6;
/// Where the rate of a factor is below this part of its largest value, the components touch.
const TOUCHING: f64 = 1e-4;
/// The part of the rest of a run in which a component that is left is not looked for.
const LEAVING: f64 = 1e-3;
/// So many events are looked for of each other component.
const LOOKS: usize = 2;
/// Rounding of a state, as a part of its natural size.
const ROUNDED: f64 = 1e-13;
/// So small a rate of a factor, over the length of the run, is that of a constant.
const CONSTANT: f64 = 1e-9;

/// A system on the component of its constraints on which a motion starts.
#[derive(Clone, Debug)]
pub struct Component {
    system: System,
    terms: MotionTerms,
    selection: Selection,
    numeric: NumericSystem,
    start: ConsistentState,
    factors: Vec<Factor>,
}

impl Component {
    /// That of a subject; `None` where no constraint is a product, where the start lies on more than one component, and for constraints of order
    /// two and more.
    pub fn of_start(subject: &Subject<'_>) -> Option<Component> {
        if subject.terms.order > 1 {
            return None;
        }
        let vanishes = |e: Expr| vanishes(subject, e);
        let (system, factors) = on_component(subject.system, &vanishes)?;
        let (terms, mut numeric) = numeric(&system, subject.binding)?;
        let start = subject.start;
        numeric.evaluate(start.t, &start.q, &start.v).ok()?;
        let chart = chart::choose(
            numeric.jacobian(),
            (numeric.r, numeric.n),
            &numeric.mass_diagonal(),
            Floor::Along(1.0),
        );
        let is_same = chart.rank() == start.chart.rank() && numeric.r == subject.numeric.r;
        let start = ConsistentState {
            chart,
            ..start.clone()
        };
        is_same.then(|| Component::new(system, (terms, numeric), start, factors))
    }

    fn new(
        system: System,
        (terms, numeric): (MotionTerms, NumericSystem),
        start: ConsistentState,
        factors: Vec<Factor>,
    ) -> Component {
        let selection = Selection {
            rows: start.chart.rows.clone(),
            dependent: start.chart.dependent.clone(),
        };
        Component {
            system,
            terms,
            selection,
            numeric,
            start,
            factors,
        }
    }

    /// A system on a component, from the last state of a run on.
    fn from_last(
        system: System,
        subject: &Subject<'_>,
        run: &Run,
        factors: Vec<Factor>,
    ) -> Option<Component> {
        let (terms, mut numeric) = numeric(&system, subject.binding)?;
        let row = run.row(run.len().checked_sub(1)?);
        // What is rounding beside the natural sizes is zero: else it would be taken for a size.
        let sizes = run.scales.iter();
        let state = row[..run.layout.v().end].iter().zip(sizes);
        let state = state.map(|(&x, size)| if x.abs() <= ROUNDED * size { 0.0 } else { x });
        let state: Vec<f64> = state.collect();
        let data = InitialData {
            t: *run.times.last()?,
            q: state.get(run.layout.positions())?.to_vec(),
            v: state.get(run.layout.v())?.to_vec(),
            q_fixed: vec![false; numeric.n],
            v_fixed: vec![false; numeric.n],
            project: true,
        };
        let start = consistent_state(&mut numeric, &data).ok()?;
        Some(Component::new(system, (terms, numeric), start, factors))
    }

    /// The subject on the component.
    pub fn subject<'a>(&'a self, binding: &'a Binding) -> Subject<'a> {
        Subject {
            system: &self.system,
            terms: &self.terms,
            selection: &self.selection,
            binding,
            numeric: &self.numeric,
            start: &self.start,
            factors: &self.factors,
        }
    }

    /// The system on it, with its terms and selection.
    pub fn into_system(self) -> (System, MotionTerms, Selection) {
        (self.system, self.terms, self.selection)
    }

    /// What is said of it: the component by constraint.
    pub fn in_words(&self) -> String {
        let g = &self.system.graph;
        let all = self.factors.iter().map(|own| {
            let name = &self.system.constraints[own.constraint].name;
            format!("{} = 0 of `{name}`", g.text(own.function))
        });
        all.collect::<Vec<String>>().join(" and ")
    }
}

fn numeric(system: &System, binding: &Binding) -> Option<(MotionTerms, NumericSystem)> {
    let terms = MotionTerms::new(system);
    let numeric = NumericSystem::new(system, &terms, binding).ok()?;
    Some((terms, numeric))
}

/// Whether a function vanishes at the start beside its terms.
fn vanishes(subject: &Subject<'_>, e: Expr) -> Option<bool> {
    let (system, start) = (subject.system, subject.start);
    let g = &system.graph;
    let e = g.substitute(system.defined(e), &subject.binding.controls);
    let variables = subject.binding.variables.iter().copied();
    let values = std::iter::once(start.t).chain(start.q.iter().chain(&start.v).copied());
    let known: Vec<(Symbol, f64)> = variables.zip(values).collect();
    let parameters = &subject.binding.parameters;
    let value = |s: Symbol| {
        let mut all = known.iter().chain(parameters);
        all.find(|own| own.0 == s).map(|own| own.1)
    };
    let both = g.evaluate_f64(&[e, magnitude(g, e)], &value).ok()?;
    Some(both[0].abs() <= VANISHES * both[1])
}

/// A component that is left: the number of the constraint, and the factor.
type Left = (usize, Expr);

/// Another component, and when the motion is met on it.
struct Watched<'f> {
    constraint: &'f str,
    factor: &'f Factor,
    other: &'f Other,
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
            let Some((t, place)) = met else { break };
            let subject = component.as_ref().map(|own| own.subject(self.binding));
            let subject = subject.as_ref().unwrap_or(self);
            let Some((next, left)) = subject.beyond(&run, place, chosen) else {
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
            met = match on.met_at_start(left) {
                Some(further) => {
                    run.crossings.push(crossing);
                    run.ending = stop::undetermined(on.reason(&on.others()[further], t), t);
                    Some((t, further))
                }
                None => on.leave(
                    formulation,
                    (&settings, left),
                    (&mut run, crossing),
                    watcher,
                )?,
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
        (settings, left): (&RunSettings, Left),
        (run, crossing): (&mut Run, Crossing),
        watcher: &mut Watcher<'_>,
    ) -> Result<Option<(f64, usize)>, RunError> {
        let span = settings.t_end - self.start.t;
        let near = self.start.t + LEAVING * span;
        let is_near = |x: f64| (x - near) * span <= 0.0;
        let mut first = settings.clone();
        first.t_end = near;
        first.times.retain(|&x| is_near(x));
        first.times.push(near);
        let (mut part, met) = self.up_to_meeting(formulation, (&first, Some(left)), watcher)?;
        if let Some(place) = self.stays_on_both(&part)? {
            let t = self.start.t;
            let reason = format!(
                "{}, and so do those that follow",
                self.reason(&self.others()[place], t)
            );
            run.ending = stop::undetermined(reason, t);
            return Ok(None);
        }
        let next = match part.ending.finished {
            true => self.again(&part),
            false => None,
        };
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
    fn met_at_start(&self, left: Left) -> Option<usize> {
        self.others().iter().position(|met| {
            let other = met.other;
            let is_left = (met.factor.constraint, other.function) == left;
            let lies_on = |e: Expr| vanishes(self, e) == Some(true);
            !is_left && lies_on(other.function) && (!other.is_of_place || lies_on(other.rate))
        })
    }

    /// Another component on which all states of a run lie.
    fn stays_on_both(&self, run: &Run) -> Result<Option<usize>, FunctionsError> {
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
        Ok((0..others.len()).find(is_zero))
    }

    /// Integrates on one component up to where it meets another one, so that the motion is not determined, if it does: the time, and the
    /// number of the other. One that is left is not looked for.
    fn up_to_meeting(
        &self,
        formulation: &'static dyn Formulation,
        (stated, left): (&RunSettings, Option<Left>),
        watcher: &mut Watcher<'_>,
    ) -> Result<(Run, Option<(f64, usize)>), RunError> {
        let others = self.others();
        let mut settings = stated.clone();
        self.state_on_factors(&mut settings.events);
        let own = settings.events.len();
        let span = settings.t_end - self.start.t;
        let others: Vec<Watched<'_>> = others
            .into_iter()
            .filter(|own| Some((own.factor.constraint, own.other.function)) != left)
            .collect();
        let looks = others
            .iter()
            .flat_map(|other| self.looks(other.other, span));
        settings.events.extend(looks);
        let mut run = self.integrated(formulation, &settings, watcher)?;
        let met = self.met(&others, &run, own)?;
        settings.events.truncate(own);
        if let Some((t, place)) = met.ended {
            settings.t_end = t;
            let is_asked = settings.times.contains(&t);
            settings
                .times
                .retain(|&x| if span < 0.0 { x > t } else { x < t });
            settings.times.push(t);
            run = self.integrated(formulation, &settings, watcher)?;
            run.ends_between = !is_asked;
            run.ending = stop::undetermined(self.reason(&others[place], t), t);
        }
        run.events.retain(|event| event.event < own);
        run.notes
            .retain(|note| event_of(note).is_none_or(|event| event < own));
        run.crossings
            .extend(self.passages(&met.passed, &others, span));
        let forward = if span < 0.0 { -1.0 } else { 1.0 };
        run.crossings
            .sort_by(|a, b| (forward * a.t).total_cmp(&(forward * b.t)));
        self.state_multipliers(&mut run)?;
        let of_all = |place: usize| {
            let met = (
                others[place].factor.constraint,
                others[place].other.function,
            );
            let mut all = self.others().into_iter();
            all.position(|own| (own.factor.constraint, own.other.function) == met)
        };
        let ended = met.ended.and_then(|(t, place)| Some((t, of_all(place)?)));
        Ok((run, ended))
    }

    /// Passages of other components: the rank falls by one for each constraint that meets one at a time.
    fn passages(
        &self,
        passed: &[(f64, usize)],
        others: &[Watched<'_>],
        span: f64,
    ) -> Vec<Crossing> {
        let rank = self.selection.rows.len();
        let mut found: Vec<(f64, BTreeSet<usize>)> = Vec::new();
        for &(t, place) in passed {
            let constraint = others[place].factor.constraint;
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
    fn beyond(&self, run: &Run, place: usize, function: Expr) -> Option<(Component, Left)> {
        let others = self.others();
        let met = others.get(place)?;
        let g = &self.system.graph;
        let moves = |s| self.system.moves(g.symbol_name(s)) || g.symbol_name(s) == "t";
        let is_same = |e: Expr| {
            let ratio = quotient(g, function, e);
            ratio.is_some_and(|ratio| g.is_free_of(ratio, &moves) && !g.is_zero(ratio))
        };
        let mut factors = self.factors.to_vec();
        let number = met.factor.constraint;
        let mut left = (number, met.other.function);
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

    fn others(&self) -> Vec<Watched<'_>> {
        let all = self.factors.iter().flat_map(|factor| {
            factor.others.iter().map(|other| Watched {
                constraint: &self.system.constraints[factor.constraint].name,
                factor,
                other,
            })
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
    fn met(&self, others: &[Watched<'_>], run: &Run, own: usize) -> Result<Met, FunctionsError> {
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
            if others[place].other.is_of_place && rate.0 > TOUCHING * rate.1 {
                found.passed.push((event.t, place));
                continue;
            }
            found.ended = Some((event.t, place));
            break;
        }
        Ok(found)
    }

    fn reason(&self, met: &Watched<'_>, t: f64) -> String {
        let g = &self.system.graph;
        let why = match met.other.is_of_place {
            true => "they touch, so that the velocity lies on both",
            false => "the velocity lies on both",
        };
        format!(
            "the components {} = 0 and {} = 0 of the constraint `{}` meet at t = {}: {why}; the motion beyond is not determined",
            g.text(met.factor.function),
            g.text(met.other.function),
            met.constraint,
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
    /// Times at which it passed, with the numbers of the components.
    passed: Vec<(f64, usize)>,
    /// The time at which it is not determined, and the number of the component met.
    ended: Option<(f64, usize)>,
}
