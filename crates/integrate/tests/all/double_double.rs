//! The Taylor method in double-double arithmetic on problems with closed forms.
#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use chetaev_double_double::DoubleDouble;
use chetaev_integrate::double_double::{
    integrate, PreciseEvent, PreciseOptions, PreciseSolution, PreciseSystem,
};
use chetaev_integrate::{Direction, EvaluationFailure, EventKind, IntegrateError, Stop};

const ZERO: DoubleDouble = DoubleDouble::ZERO;
const ONE: DoubleDouble = DoubleDouble::ONE;

fn number(x: f64) -> DoubleDouble {
    DoubleDouble::from(x)
}

/// The Kepler problem in the plane, with x y − c as its first switching function and y as the second.
struct Kepler;

/// Σ_{i=from..=j} a_i b_{j−i}
fn convolve(a: &[DoubleDouble], b: &[DoubleDouble], j: usize, from: usize) -> DoubleDouble {
    (from..=j).fold(ZERO, |sum, i| sum + a[i] * b[j - i])
}

impl PreciseSystem for Kepler {
    fn dimension(&self) -> usize {
        4
    }

    /// x'' = −x s, s = (x² + y²)^(−3/2), by the recurrence s' r² = −3/2 s (r²)'.
    fn expand(
        &mut self,
        _t: DoubleDouble,
        y: &[DoubleDouble],
        order: usize,
        coefficients: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure> {
        let mut own: [Vec<DoubleDouble>; 4] = std::array::from_fn(|i| vec![y[i]]);
        let (mut square, mut s) = (Vec::new(), Vec::new());
        for j in 0..order {
            square.push(convolve(&own[0], &own[0], j, 0) + convolve(&own[1], &own[1], j, 0));
            s.push(match j {
                0 => ONE / (square[0] * square[0].sqrt()),
                _ => {
                    let sum = (0..j).fold(ZERO, |sum, i| {
                        let weight = number(-1.5) * (j - i) as f64 - number(i as f64);
                        sum + weight * s[i] * square[j - i]
                    });
                    sum / (square[0] * j as f64)
                }
            });
            let per_order = number((j + 1) as f64);
            let next = [
                own[2][j] / per_order,
                own[3][j] / per_order,
                -convolve(&own[0], &s, j, 0) / per_order,
                -convolve(&own[1], &s, j, 0) / per_order,
            ];
            for (own, next) in own.iter_mut().zip(next) {
                own.push(next);
            }
        }
        for j in 0..=order {
            for i in 0..4 {
                coefficients[j * 4 + i] = own[i][j];
            }
        }
        Ok(())
    }

    fn switching(
        &mut self,
        index: usize,
        _t: DoubleDouble,
        y: &[DoubleDouble],
    ) -> Result<DoubleDouble, EvaluationFailure> {
        // At the apses the distance is extremal: x vx + y vy = 0. The second touches zero at the pericentre.
        match index {
            0 => Ok(y[0] * y[2] + y[1] * y[3]),
            _ => Ok(number(0.5) - (y[0] * y[0] + y[1] * y[1]).sqrt()),
        }
    }
}

const ECCENTRICITY: f64 = 0.5;

/// At the pericentre of an ellipse of axis 1: r = 1 − e, v = √((1 + e)/(1 − e)).
fn pericentre() -> [DoubleDouble; 4] {
    [number(0.5), ZERO, ZERO, number(3.0).sqrt()]
}

/// The state at eccentric anomaly E, and its time E − e sin E.
fn at(anomaly: DoubleDouble) -> (DoubleDouble, [DoubleDouble; 4]) {
    let e = number(ECCENTRICITY);
    let (sin, cos) = anomaly.sin_cos();
    let (b, rate) = ((ONE - e * e).sqrt(), ONE / (ONE - e * cos));
    let state = [cos - e, b * sin, -sin * rate, b * cos * rate];
    (anomaly - e * sin, state)
}

fn distance(a: &[DoubleDouble], b: &[DoubleDouble]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |m: f64, (&a, &b)| m.max((a - b).abs().high()))
}

fn run(end: DoubleDouble, tolerance: f64) -> PreciseSolution {
    let options = PreciseOptions::tolerance(tolerance);
    integrate(&mut Kepler, (ZERO, end), &pericentre(), &[], options).unwrap()
}

#[test]
fn kepler_ellipses_are_met_to_28_digits() {
    for anomaly in [1.0, 3.0, 12.0] {
        let (t, expected) = at(number(anomaly));
        let found = run(t, 1e-28);
        assert_eq!(found.stop, Stop::Finished);
        assert_eq!(found.t, t);
        let error = distance(&found.state, &expected);
        assert!(error < 1e-27, "{anomaly}: {error:e}");
    }
}

#[test]
fn errors_fall_with_the_tolerance() {
    let (t, expected) = at(number(7.0));
    for digits in (8..=28).step_by(4) {
        let tolerance = 10f64.powi(-digits);
        let found = run(t, tolerance);
        let error = distance(&found.state, &expected);
        assert!(error < 200.0 * tolerance, "{tolerance:e}: {error:e}");
        if digits < 28 {
            assert!(error > 1e-4 * tolerance, "{tolerance:e}: {error:e}");
        }
    }
}

#[test]
fn there_and_back() {
    let end = number(20.0);
    let there = run(end, 1e-28);
    let options = PreciseOptions::tolerance(1e-28);
    let back = integrate(&mut Kepler, (end, ZERO), &there.state, &[], options).unwrap();
    let error = distance(&back.state, &pericentre());
    assert!(error < 1e-26, "{error:e}");
}

#[test]
fn rows_lie_where_they_were_asked_for() {
    let anomalies = [0.0, 0.3, 0.31, 2.0, 5.0];
    let expected = anomalies.map(|e| at(number(e)));
    let options = PreciseOptions {
        times: expected.iter().map(|(t, _)| *t).collect(),
        ..PreciseOptions::tolerance(1e-28)
    };
    let end = expected[4].0;
    let found = integrate(&mut Kepler, (ZERO, end), &pericentre(), &[], options).unwrap();
    assert_eq!(found.times.len(), expected.len());
    for (row, (_, expected)) in found.rows.chunks(4).zip(&expected) {
        let error = distance(row, expected);
        assert!(error < 1e-27, "{error:e}");
    }
}

#[test]
fn steps_of_fixed_size_have_their_order() {
    let (t, expected) = at(number(1.0));
    let error = |h: f64| {
        let options = PreciseOptions {
            step: Some(h),
            ..PreciseOptions::tolerance(1e-12)
        };
        let found = integrate(&mut Kepler, (ZERO, t), &pericentre(), &[], options).unwrap();
        distance(&found.state, &expected)
    };
    // Ends of the span that the step does not divide leave the order as it is.
    let (coarse, fine) = (error(0.02), error(0.01));
    assert!(coarse / fine > 2f64.powi(12), "{coarse:e} {fine:e}");
}

#[test]
fn events_are_located_to_rounding() {
    let events = [
        PreciseEvent {
            direction: Direction::Down,
            stops: false,
        },
        PreciseEvent {
            direction: Direction::Both,
            stops: false,
        },
    ];
    let end = DoubleDouble::PI * 3.5;
    let options = PreciseOptions::tolerance(1e-28);
    let found = integrate(&mut Kepler, (ZERO, end), &pericentre(), &events, options).unwrap();
    // Distances are greatest at E = π, 3π, with t = E; they are 1/2 and no less at 2π, where the other function is touched.
    let apses: Vec<_> = found.events.iter().filter(|e| e.index == 0).collect();
    assert_eq!(apses.len(), 2);
    for (apsis, turns) in apses.iter().zip([1.0, 3.0]) {
        let error = (apsis.t - DoubleDouble::PI * turns).abs().high();
        assert!(error < 1e-27, "{error:e}");
        assert_eq!(apsis.kind, EventKind::Down);
    }
    let touched: Vec<_> = found.events.iter().filter(|e| e.index == 1).collect();
    assert!(touched
        .iter()
        .all(|e| (e.t - DoubleDouble::PI * 2.0).abs().high() < 1e-13));
    assert_eq!(touched.len(), 1, "{touched:?}");
}

#[test]
fn an_event_may_end_the_run() {
    let stops = [PreciseEvent {
        direction: Direction::Both,
        stops: true,
    }];
    let options = PreciseOptions {
        times: vec![number(1.0), number(5.0)],
        ..PreciseOptions::tolerance(1e-27)
    };
    let found = integrate(
        &mut Kepler,
        (ZERO, number(5.0)),
        &pericentre(),
        &stops,
        options,
    );
    let found = found.unwrap();
    assert!(matches!(found.stop, Stop::Event { index: 0, .. }));
    let error = (found.t - DoubleDouble::PI).abs().high();
    assert!(error < 1e-26, "{error:e}");
    // The row of the end stands behind those asked for.
    assert_eq!(found.times.len(), 2);
    assert_eq!(found.times[1], found.t);
    assert!(
        distance(
            &found.state,
            &[number(-1.5), ZERO, ZERO, -ONE / number(3.0).sqrt()]
        ) < 1e-26
    );
}

#[test]
fn questions_that_make_no_sense_are_refused() {
    let ask = |tolerance: f64, y: &[DoubleDouble]| {
        let options = PreciseOptions::tolerance(tolerance);
        integrate(&mut Kepler, (ZERO, ONE), y, &[], options).map(|_| ())
    };
    let refused = ask(1e-30, &pericentre());
    assert_eq!(
        refused,
        Err(IntegrateError::PreciseToleranceTooSmall { requested: 1e-30 })
    );
    assert!(ask(-1.0, &pericentre()).is_err());
    assert!(ask(f64::NAN, &pericentre()).is_err());
    assert!(ask(1e-20, &[ONE]).is_err());
    assert!(ask(1e-20, &[number(f64::NAN); 4]).is_err());
    let options = PreciseOptions {
        times: vec![number(0.5), number(0.2)],
        ..PreciseOptions::tolerance(1e-20)
    };
    assert!(integrate(&mut Kepler, (ZERO, ONE), &pericentre(), &[], options).is_err());
}

#[test]
fn a_collision_ends_the_run() {
    // From rest at distance 1 the fall takes π/(2 √2).
    let start = [ONE, ZERO, ZERO, ZERO];
    let options = PreciseOptions::tolerance(1e-20);
    let found = integrate(&mut Kepler, (ZERO, number(2.0)), &start, &[], options).unwrap();
    // A velocity grows without bound, as runs in doubles say too.
    let Stop::Divergence {
        singularity,
        component: 2,
        ..
    } = found.stop
    else {
        panic!("{:?}", found.stop);
    };
    let end = DoubleDouble::PI / number(8.0).sqrt();
    assert!((end.high() - singularity).abs() < 1e-12, "{:?}", found.stop);
    let error = found.t - end;
    assert!(error.abs().high() < 1e-9, "{:?} {error:?}", found.stop);
}

/// x'' = −x with the switching function x − 1 + e of one depth e.
struct Oscillator(DoubleDouble);

impl PreciseSystem for Oscillator {
    fn dimension(&self) -> usize {
        2
    }

    fn expand(
        &mut self,
        _t: DoubleDouble,
        y: &[DoubleDouble],
        order: usize,
        coefficients: &mut [DoubleDouble],
    ) -> Result<(), EvaluationFailure> {
        coefficients[..2].copy_from_slice(y);
        for j in 0..order {
            let per_order = number((j + 1) as f64);
            coefficients[2 * j + 2] = coefficients[2 * j + 1] / per_order;
            coefficients[2 * j + 3] = -coefficients[2 * j] / per_order;
        }
        Ok(())
    }

    fn switching(
        &mut self,
        _index: usize,
        _t: DoubleDouble,
        y: &[DoubleDouble],
    ) -> Result<DoubleDouble, EvaluationFailure> {
        Ok(y[0] - ONE + self.0)
    }
}

/// The zeros of cos t − 1 + e met until `end`.
fn dips(e: DoubleDouble, end: DoubleDouble, tolerance: f64) -> PreciseSolution {
    let events = [PreciseEvent {
        direction: Direction::Both,
        stops: false,
    }];
    let options = PreciseOptions::tolerance(tolerance);
    integrate(
        &mut Oscillator(e),
        (ZERO, end),
        &[ONE, ZERO],
        &events,
        options,
    )
    .unwrap()
}

/// Until t = 60 the cosine passes 1 − e once on its way down and twice about each of nine tops, at 2πk ± arccos(1 − e).
#[test]
fn two_zeros_close_together_are_both_found() {
    for digits in 1..=12 {
        let e = number(10f64.powi(-digits));
        let found = dips(e, number(60.0), 1e-25).events;
        let half_width = (ONE - e).acos();
        assert_eq!(found.len(), 19, "{e:?}");
        for (k, event) in found.iter().enumerate() {
            let (kind, sign) = match k % 2 {
                0 => (EventKind::Down, 1.0),
                _ => (EventKind::Up, -1.0),
            };
            let top = DoubleDouble::PI * 2.0 * number(k.div_ceil(2) as f64);
            let error = (event.t - top - half_width * sign).abs().high();
            assert_eq!(event.kind, kind);
            // The slope there is √(2 e).
            assert!(error * half_width.high() < 1e-22, "{e:?}: {error:e}");
        }
    }
}

/// A touch is one at every tolerance, and two crossings less deep than the tolerance are one.
#[test]
fn touches_are_judged_by_the_tolerance() {
    for tolerance in [1e-8, 1e-10, 1e-15, 1e-20, 1e-25, 1e-28] {
        for e in [ZERO, number(tolerance), -number(tolerance)] {
            let found = dips(e, number(60.0), tolerance).events;
            let touches = found.iter().filter(|e| e.kind == EventKind::Grazing);
            assert_eq!(touches.count(), 9, "{tolerance:e} {e:?}: {found:?}");
        }
        let deep = dips(number(1e3 * tolerance), number(60.0), tolerance).events;
        assert_eq!(deep.len(), 19, "{tolerance:e}");
        assert!(deep.iter().all(|e| e.kind != EventKind::Grazing));
        let apart = dips(-number(1e3 * tolerance), number(60.0), tolerance).events;
        assert!(apart.is_empty(), "{tolerance:e}: {apart:?}");
    }
}

/// A zero at the end of the run is met once, and one at the start is none.
#[test]
fn zeros_at_the_ends_of_the_span() {
    let quarter = DoubleDouble::PI * 0.5;
    for turns in [1.0, 5.0, 21.0] {
        let found = dips(ONE, quarter * turns, 1e-27).events;
        assert_eq!(found.len(), (turns as usize).div_ceil(2), "{found:?}");
    }
    assert!(dips(ZERO, ONE, 1e-27).events.is_empty());
}
