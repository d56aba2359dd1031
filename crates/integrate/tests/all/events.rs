//! Events: located to round-off, none missed that the dense output shows, none counted twice.

#![allow(clippy::unwrap_used)]

use chetaev_integrate::methods::{DORMAND_PRINCE_853, TSITOURAS_5};
use chetaev_integrate::{
    from_fn, integrate, Direction, EvaluationFailure, Event, EventKind, Method, Note, Options,
    Output, Solution, Stop, System,
};

const AMPLITUDE: f64 = 2.0;
const FREQUENCY_SQUARED: f64 = 9.81 / 0.8;

/// Plane pendulum of reference case pendulum-large-swing.
fn pendulum() -> impl System {
    from_fn(2, |_t, y: &[f64], dy: &mut [f64]| {
        dy[0] = y[1];
        dy[1] = -FREQUENCY_SQUARED * y[0].sin();
    })
}

/// Period 4 √(l/g) K(k), k = sin(amplitude/2), with K by the arithmetic-geometric mean.
fn pendulum_period() -> f64 {
    let k = (AMPLITUDE / 2.0).sin();
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..10 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    2.0 * std::f64::consts::PI / a / FREQUENCY_SQUARED.sqrt()
}

/// y' = 1 from 0, so that switching functions of y are functions of time, in one step where `h` is the span.
fn clock(span: (f64, f64), h: f64, events: &mut [Event<'_>]) -> Solution {
    let direction = (span.1 - span.0).signum();
    let mut system = from_fn(1, |_t, _y: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    let options = Options::fixed_step(&DORMAND_PRINCE_853, h).output(Output::End);
    let run = integrate(&mut system, span, &[span.0], events, options).unwrap();
    assert!(direction * (run.t - span.0) >= 0.0);
    run
}

fn times(run: &Solution) -> Vec<f64> {
    run.events.iter().map(|e| e.t).collect()
}

fn assert_times(run: &Solution, expected: &[f64]) {
    let found = times(run);
    assert_eq!(found.len(), expected.len(), "{:?}", run.events);
    for (a, b) in found.iter().zip(expected) {
        assert!(
            (a - b).abs() <= 8.0 * f64::EPSILON * b.abs().max(1.0),
            "{found:?}"
        );
    }
}

#[test]
fn pendulum_period_by_a_terminal_event() {
    let period = pendulum_period();
    assert!((period - 2.38442745896814).abs() < 1e-13); // reference case
    for (method, tolerance) in [
        (&DORMAND_PRINCE_853 as &'static dyn Method, 1e-12),
        (&TSITOURAS_5, 1e-12),
    ] {
        let mut events = [Event::new(|_t, y| y[1])
            .direction(Direction::Down)
            .terminal()];
        let options = Options::tolerance(tolerance).method(method);
        let run = integrate(
            &mut pendulum(),
            (0.0, 4.0),
            &[AMPLITUDE, 0.0],
            &mut events,
            options,
        )
        .unwrap();
        assert_eq!(run.stop, Stop::Event { t: run.t, index: 0 });
        assert!((run.t - period).abs() < 1e-10, "{:e}", run.t - period);
        assert!((run.state[0] - AMPLITUDE).abs() < 1e-10);
        // The state is that of a step to the event, not of the interpolation.
        assert!(run.state[1].abs() < 1e-14, "{:e}", run.state[1]);
        assert_eq!(run.times.last(), Some(&run.t));
        assert_eq!(run.row(run.len() - 1), run.state);
        assert_eq!(run.events[0].row, run.state);
    }
}

#[test]
fn many_periods_are_counted() {
    let period = pendulum_period();
    let mut events = [
        Event::new(|_t, y| y[1]).direction(Direction::Down),
        Event::new(|_t, y| y[0]).direction(Direction::Up),
        Event::new(|_t, y| y[1])
            .direction(Direction::Down)
            .terminal_after(7),
    ];
    let options = Options::tolerance(1e-12).output(Output::End);
    let run = integrate(
        &mut pendulum(),
        (0.0, 100.0),
        &[AMPLITUDE, 0.0],
        &mut events,
        options,
    )
    .unwrap();
    assert_eq!(run.stop, Stop::Event { t: run.t, index: 2 });
    let of = |index: usize| {
        run.events
            .iter()
            .filter(move |e| e.index == index)
            .map(|e| e.t)
            .collect::<Vec<_>>()
    };
    let expect = |offset: f64| (1..=7).map(move |j| (f64::from(j) - offset) * period);
    for (index, offset) in [(0, 0.0), (1, 0.25), (2, 0.0)] {
        let found = of(index);
        assert_eq!(found.len(), 7);
        for (a, b) in found.iter().zip(expect(offset)) {
            assert!((a - b).abs() < 1e-9, "event {index}: {a} for {b}");
        }
    }
    assert!(run.events.windows(2).all(|pair| pair[0].t <= pair[1].t));
}

#[test]
fn zeros_at_the_ends_of_the_span() {
    // At the start: not counted, whatever the side on which the function goes on.
    assert_times(
        &clock((1.0, 2.0), 0.1, &mut [Event::new(|t, _| t - 1.0)]),
        &[],
    );
    assert_times(
        &clock((1.0, 2.0), 0.1, &mut [Event::new(|t, _| (t - 1.0).powi(2))]),
        &[],
    );
    // At the end: counted once.
    assert_times(
        &clock((1.0, 2.0), 0.1, &mut [Event::new(|t, _| t - 2.0)]),
        &[2.0],
    );
    assert_times(
        &clock((0.0, 0.3), 0.1, &mut [Event::new(|_, y| y[0] - 0.3)]),
        &[0.3],
    );
    let run = clock(
        (1.0, 2.0),
        0.1,
        &mut [Event::new(|t, _| t - 2.0).terminal()],
    );
    assert_eq!(run.stop, Stop::Event { t: 2.0, index: 0 });
    let run = clock(
        (1.0, 2.0),
        0.1,
        &mut [Event::new(|t, _| 2.0 - t).direction(Direction::Up)],
    );
    assert_times(&run, &[]);
}

#[test]
fn zeros_at_step_ends_are_counted_once() {
    let run = clock(
        (0.0, 3.0),
        0.5,
        &mut [Event::new(|t, _| (t - 1.0) * (t - 2.0))],
    );
    assert_times(&run, &[1.0, 2.0]);
    assert_eq!(run.events[0].kind, EventKind::Down);
    assert_eq!(run.events[1].kind, EventKind::Up);
    for h in [0.1, 0.3, 1.0 / 7.0] {
        let run = clock((0.0, 3.0), h, &mut [Event::new(|_, y| y[0] - 0.3)]);
        assert_times(&run, &[0.3]);
    }
}

#[test]
fn two_zeros_in_one_long_step() {
    // Far apart, close together, at both ends of one sampling interval, near the ends of the step.
    for (a, b) in [
        (0.2, 0.7),
        (0.41, 0.42),
        (0.26, 0.37),
        (0.4, 0.4001),
        (0.001, 0.01),
        (0.99, 0.999),
        (2e-6, 0.9),
    ] {
        let run = clock(
            (0.0, 1.0),
            1.0,
            &mut [Event::new(move |t, _| (t - a) * (t - b))],
        );
        assert_eq!(run.statistics.steps, 1);
        assert_times(&run, &[a, b]);
    }
}

#[test]
fn directions_follow_the_run() {
    let crossing = |t: f64, _: &[f64]| (t - 0.3) * (t - 0.6);
    let run = clock(
        (0.0, 1.0),
        0.25,
        &mut [Event::new(crossing).direction(Direction::Up)],
    );
    assert_times(&run, &[0.6]);
    let mut system = from_fn(1, |_t, _y: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    let options = Options::tolerance(1e-9).output(Output::End);
    let mut events = [Event::new(crossing).direction(Direction::Up)];
    let run = integrate(&mut system, (1.0, 0.0), &[1.0], &mut events, options).unwrap();
    assert_times(&run, &[0.3]);
}

#[test]
fn grazing_is_noted_and_does_not_stop() {
    let run = clock(
        (0.0, 1.0),
        0.3,
        &mut [Event::new(|t, _| (t - 0.5).powi(2)).terminal()],
    );
    assert_eq!(run.stop, Stop::Finished);
    assert_eq!(run.events.len(), 1);
    assert_eq!(run.events[0].kind, EventKind::Grazing);
    assert!((run.events[0].t - 0.5).abs() < 1e-7);
    assert!(matches!(run.notes[..], [Note::Grazing { event: 0, .. }]));
    // A function that stays away from zero, however close for its own size, does not graze.
    let run = clock(
        (0.0, 1.0),
        0.3,
        &mut [Event::new(|t, _| (t - 0.5).powi(2) + 1e-5)],
    );
    assert!(run.events.is_empty() && run.notes.is_empty());
    // A cubic crosses, though its slope vanishes there.
    let run = clock(
        (0.0, 1.0),
        0.3,
        &mut [Event::new(|t, _| (t - 0.47).powi(3)).terminal()],
    );
    assert!((run.t - 0.47).abs() < 1e-5 && matches!(run.stop, Stop::Event { .. }));
}

#[test]
fn rows_after_a_terminal_event_are_not_recorded() {
    let mut system = from_fn(1, |_t, _y: &[f64], dy: &mut [f64]| dy[0] = 1.0);
    let options = Options::tolerance(1e-9).output(Output::Every(0.25));
    let mut events = [Event::new(|_, y| y[0] - 0.6).terminal()];
    let run = integrate(&mut system, (0.0, 1.0), &[0.0], &mut events, options).unwrap();
    assert_eq!(run.times[..3], [0.0, 0.25, 0.5]);
    assert_eq!(run.times.len(), 4);
    assert!((run.t - 0.6).abs() < 1e-15 && run.times[3] == run.t);
}

/// Free fall with a contact force as switching function of the system.
struct Contact {
    fails_after: f64,
}

impl System for Contact {
    fn dimension(&self) -> usize {
        2
    }

    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        dy[0] = y[1];
        dy[1] = -1.0;
        Ok(())
    }

    fn switching(&mut self, index: usize, t: f64, y: &[f64]) -> Result<f64, EvaluationFailure> {
        assert_eq!(index, 3);
        if t > self.fails_after {
            return Err(EvaluationFailure::Domain { operation: 7 });
        }
        Ok(y[0] + 0.5)
    }
}

#[test]
fn switching_functions_of_the_system() {
    let options = || Options::tolerance(1e-12).output(Output::End);
    let mut contact = Contact {
        fails_after: f64::INFINITY,
    };
    let mut events = [Event::of_system(3).terminal()];
    let run = integrate(
        &mut contact,
        (0.0, 5.0),
        &[0.0, 0.0],
        &mut events,
        options(),
    )
    .unwrap();
    assert!((run.t - 1.0).abs() < 1e-14);
    let mut contact = Contact { fails_after: 0.5 };
    let run = integrate(
        &mut contact,
        (0.0, 5.0),
        &[0.0, 0.0],
        &mut events,
        options(),
    )
    .unwrap();
    assert_eq!(run.stop, Stop::Finished);
    let unknown = |note: &Note| {
        matches!(
            note,
            Note::EventUnknown {
                event: 0,
                failure: EvaluationFailure::Domain { operation: 7 },
                ..
            }
        )
    };
    assert_eq!(run.notes.iter().filter(|n| unknown(n)).count(), 1);
}

/// Three hundred oscillations in one step: as many crossings as the sine has zeros, each in its place. A function that
/// cannot be followed is said to be one.
#[test]
fn oscillations_faster_than_the_steps_are_followed() {
    let run = clock(
        (0.0, 1.0),
        1.0,
        &mut [Event::new(|t, _| (2000.0 * t).sin())],
    );
    assert_eq!(run.statistics.steps, 1);
    let expected: Vec<f64> = (1..=636)
        .map(|k| f64::from(k) * std::f64::consts::PI / 2000.0)
        .collect();
    assert_times(&run, &expected);
    assert!(run.notes.is_empty(), "{:?}", run.notes);
    let run = clock((0.0, 1.0), 0.5, &mut [Event::new(|t, _| (2e5 * t).sin())]);
    assert!(matches!(
        run.notes[..],
        [Note::EventUnresolved { event: 0, .. }]
    ));
}

/// The kinds of the events of one function.
fn kinds(run: &Solution) -> Vec<EventKind> {
    run.events.iter().map(|e| e.kind).collect()
}

/// Where a function bends sharply towards zero, its zeros and touches count as those of smooth ones.
#[test]
fn kinks_are_looked_at() {
    for h in [0.31, 1.0] {
        let mut two = [Event::new(|t, _| (t - 0.337).abs() - 1e-6)];
        assert_times(&clock((0.0, 1.0), h, &mut two), &[0.336_999, 0.337_001]);
        let mut capture = [Event::new(|t, _| {
            ((t - 0.337f64).powi(2) + 1e-12).sqrt() - 1e-5
        })];
        let apart = (1e-10f64 - 1e-12).sqrt();
        assert_times(
            &clock((0.0, 1.0), h, &mut capture),
            &[0.337 - apart, 0.337 + apart],
        );
        let run = clock((0.0, 1.0), h, &mut [Event::new(|t, _| (t - 0.337).abs())]);
        assert_eq!(kinds(&run), [EventKind::Grazing]);
        assert!((run.events[0].t - 0.337).abs() < 1e-8);
    }
}

/// A touch just where a step ends is one, and one at the end of the run is no crossing.
#[test]
fn touches_at_the_ends_of_steps() {
    let run = clock(
        (0.0, 1.0),
        0.125,
        &mut [Event::new(|t, _| (t - 0.5).powi(2))],
    );
    assert_eq!(kinds(&run), [EventKind::Grazing]);
    assert!((run.events[0].t - 0.5).abs() < 1e-6);
    let run = clock(
        (0.0, 1.0),
        0.125,
        &mut [Event::new(|t, _| (t - 0.5).powi(4))],
    );
    assert_eq!(kinds(&run), [EventKind::Grazing]);
    let run = clock((0.0, 1.0), 0.1, &mut [Event::new(|t, _| (t - 1.0).powi(2))]);
    assert_eq!(kinds(&run), [EventKind::Grazing]);
    for h in [0.1, 0.01, 0.3] {
        let run = clock((0.0, 1.0), h, &mut [Event::new(|_, y| y[0] - 1.0)]);
        assert_eq!(kinds(&run), [EventKind::Up], "{h}");
    }
}

/// Zeros early in a step in which the function grows by many orders of magnitude.
#[test]
fn growth_hides_no_zero() {
    let mut events = [
        Event::new(|t, _| t.exp() - 2.0),
        Event::new(|t, _| t.powi(12) - 1.0),
        Event::new(|t, _| t.cosh() - 1.5),
    ];
    let run = clock((0.0, 60.0), 60.0, &mut events);
    // ln 2, arcosh 1.5 and 1.
    assert_times(&run, &[2f64.ln(), 1.5f64.acosh(), 1.0]);
}

#[test]
fn a_pole_is_no_zero() {
    // Also where a step ends.
    for h in [0.25, 0.1] {
        let mut pole = [Event::new(|t, _| 1.0 / (t - 0.3)).terminal()];
        let run = clock((0.0, 1.0), h, &mut pole);
        assert_eq!((run.events.len(), run.stop), (0, Stop::Finished), "{h}");
    }
    let half_turn = std::f64::consts::FRAC_PI_2;
    let mut both = [Event::new(|t, _| (half_turn * (t + 1.0)).tan())];
    let run = clock((0.5, 3.5), 0.7, &mut both);
    assert_eq!(kinds(&run), [EventKind::Up; 2]);
    assert!(times(&run)
        .iter()
        .zip([1.0, 3.0])
        .all(|(a, b)| (a - b).abs() < 1e-14));
}

/// Newton's correction means nothing at a jump.
#[test]
fn jumps_are_located() {
    for method in [&DORMAND_PRINCE_853 as &'static dyn Method, &TSITOURAS_5] {
        let mut events = [Event::new(|_, y| (y[0] - 0.3).signum())];
        let mut system = from_fn(1, |_t, _y: &[f64], dy: &mut [f64]| dy[0] = 1.0);
        let options = Options::tolerance(1e-10).method(method);
        let run = integrate(&mut system, (0.0, 1.0), &[0.0], &mut events, options).unwrap();
        assert_times(&run, &[0.3]);
    }
}

/// What happens at the time at which the run is stopped is recorded, in whatever order it is stated.
#[test]
fn events_at_the_end_do_not_depend_on_their_order() {
    for stop_first in [true, false] {
        let stop = || Event::new(|_, y: &[f64]| y[0] - 0.4).terminal();
        let other = || Event::new(|_, y: &[f64]| 2.0 * (y[0] - 0.4));
        let mut events = match stop_first {
            true => [stop(), other()],
            false => [other(), stop()],
        };
        let run = clock((0.0, 1.0), 0.25, &mut events);
        assert_times(&run, &[0.4, 0.4]);
        assert!(matches!(run.stop, Stop::Event { .. }));
    }
}
