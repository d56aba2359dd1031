//! Every way a run can end or be refused, with the partial trajectory kept.

#![allow(clippy::unwrap_used)]

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::common::{distance, kepler, kepler_exact};
use chetaev_integrate::methods::{DORMAND_PRINCE_853, METHODS, RUNGE_KUTTA_4, TSITOURAS_5};
use chetaev_integrate::{
    from_fn, global_error, integrate, method, try_from_fn, EvaluationFailure, IntegrateError,
    Method, Note, Options, Output, Solution, StepSize, StiffnessPolicy, Stop,
};

fn run(
    f: impl FnMut(f64, &[f64], &mut [f64]),
    span: (f64, f64),
    y0: &[f64],
    options: Options<'_>,
) -> Solution {
    integrate(&mut from_fn(y0.len(), f), span, y0, &mut [], options).unwrap()
}

#[test]
fn an_empty_span_is_finished_at_once() {
    let options = Options::tolerance(1e-9);
    let solution = run(
        |_, _, _| panic!("no evaluation is needed"),
        (2.0, 2.0),
        &[1.0],
        options,
    );
    assert_eq!(solution.stop, Stop::Finished);
    assert_eq!(
        (solution.times.as_slice(), solution.row(0)),
        (&[2.0][..], &[1.0][..])
    );
    for (output, rows) in [
        (Output::End, 1),
        (Output::Every(0.1), 1),
        (Output::Times(vec![2.0]), 1),
        (Output::Times(vec![]), 0),
    ] {
        let options = Options::tolerance(1e-9).output(output);
        assert_eq!(
            run(|_, _, dy| dy[0] = 1.0, (2.0, 2.0), &[1.0], options).len(),
            rows
        );
    }
}

#[test]
fn a_pole_is_located() {
    // y' = y², y(0) = 1: y = 1/(1−t), beside a harmless component.
    for method in [&DORMAND_PRINCE_853 as &'static dyn Method, &TSITOURAS_5] {
        let f = |_t: f64, y: &[f64], dy: &mut [f64]| (dy[0], dy[1]) = (1.0, y[1] * y[1]);
        let options = Options::tolerance(1e-10).method(method);
        let solution = run(f, (0.0, 2.0), &[0.0, 1.0], options);
        match solution.stop {
            Stop::Divergence {
                t,
                singularity,
                component,
                unbounded,
            } => {
                assert!((singularity - 1.0).abs() < 1e-8 && (t - 1.0).abs() < 1e-8);
                assert!(component == 1 && unbounded);
                assert_eq!(t, solution.t);
            }
            other => panic!("{other:?}"),
        }
        assert!(solution.statistics.steps < 2000);
        let j = solution.times.partition_point(|t| *t < 0.9);
        assert!((solution.row(j)[1] * (1.0 - solution.times[j]) - 1.0).abs() < 1e-7);
        assert_eq!(solution.times.last(), Some(&solution.t));
    }
}

#[test]
fn a_pole_at_time_zero_and_one_in_the_past() {
    let solution = run(
        |_, y, dy| dy[0] = y[0] * y[0],
        (-1.0, 1.0),
        &[1.0],
        Options::tolerance(1e-9),
    );
    assert!(
        matches!(solution.stop, Stop::Divergence { singularity, .. } if singularity.abs() < 1e-7)
    );
    let solution = run(
        |_, y, dy| dy[0] = -y[0] * y[0],
        (0.0, -2.0),
        &[1.0],
        Options::tolerance(1e-9),
    );
    assert!(
        matches!(solution.stop, Stop::Divergence { singularity, .. } if (singularity + 1.0).abs() < 1e-7)
    );
}

#[test]
fn a_bounded_state_with_unbounded_derivative() {
    // y' = −1/(2y): y = √(1−t); afterwards there is no solution.
    let solution = run(
        |_, y, dy| dy[0] = -0.5 / y[0],
        (0.0, 2.0),
        &[1.0],
        Options::tolerance(1e-9),
    );
    match solution.stop {
        Stop::Divergence {
            singularity,
            unbounded,
            ..
        } => {
            assert!((singularity - 1.0).abs() < 1e-7, "{singularity}");
            assert!(!unbounded);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_evaluation_that_fails_from_some_time_on() {
    let failure = EvaluationFailure::Singular {
        index: 2,
        pivot: 0.0,
        threshold: 1e-12,
    };
    let mut system = try_from_fn(1, |t, _y: &[f64], dy: &mut [f64]| {
        dy[0] = 1.0;
        if t > 0.7 {
            Err(failure)
        } else {
            Ok(())
        }
    });
    let solution = integrate(
        &mut system,
        (0.0, 1.0),
        &[0.0],
        &mut [],
        Options::tolerance(1e-9),
    )
    .unwrap();
    assert_eq!(
        solution.stop,
        Stop::Singular {
            t: solution.t,
            failure
        }
    );
    assert!((solution.t - 0.7).abs() < 1e-12 && solution.t <= 0.7);
    assert!((solution.state[0] - solution.t).abs() < 1e-14);
    assert!(solution.statistics.failed > 5);
    // At the initial state there is nothing to keep but that state.
    let solution = integrate(
        &mut system,
        (0.8, 1.0),
        &[0.0],
        &mut [],
        Options::tolerance(1e-9),
    )
    .unwrap();
    assert_eq!(solution.stop, Stop::Singular { t: 0.8, failure });
    assert_eq!(solution.times, [0.8]);
}

#[test]
fn values_that_are_not_finite() {
    let f = |t: f64, _y: &[f64], dy: &mut [f64]| {
        (dy[0], dy[1]) = (1.0, if t > 0.5 { f64::NAN } else { 0.0 })
    };
    let solution = run(f, (0.0, 1.0), &[0.0, 0.0], Options::tolerance(1e-9));
    assert_eq!(
        solution.stop,
        Stop::NotFinite {
            t: solution.t,
            component: 1
        }
    );
    assert!((solution.t - 0.5).abs() < 1e-12);
    let solution = run(
        |_, _, dy| dy[0] = f64::INFINITY,
        (0.0, 1.0),
        &[0.0],
        Options::tolerance(1e-9),
    );
    assert_eq!(
        solution.stop,
        Stop::NotFinite {
            t: 0.0,
            component: 0
        }
    );
}

#[test]
fn a_discontinuous_right_hand_side_is_passed_or_named() {
    // Coulomb friction without an event: sliding on y = 0 makes the step tiny, but the run ends by itself.
    let mut options = Options::tolerance(1e-9);
    options.step_limit = 5_000;
    let solution = run(
        |t, _, dy| dy[0] = if t < 0.3 { 1.0 } else { -1.0 },
        (0.0, 1.0),
        &[0.0],
        options,
    );
    assert_eq!(solution.stop, Stop::Finished);
    // One step straddles the jump; its error is not that of a smooth problem.
    assert!((solution.state[0] + 0.4).abs() < 1e-7);
}

#[test]
fn a_tolerance_out_of_reach_is_named() {
    // An amplitude and frequency at which no step that time resolves meets the tolerance.
    let f = |t: f64, _y: &[f64], dy: &mut [f64]| (dy[0], dy[1]) = (0.0, 1e20 * (1e18 * t).sin());
    let solution = run(f, (1.0, 2.0), &[0.0, 0.0], Options::tolerance(1e-9));
    assert!(
        matches!(
            solution.stop,
            Stop::StepTooSmall {
                t: 1.0,
                component: 1,
                ..
            }
        ),
        "{:?}",
        solution.stop
    );
}

#[test]
fn oscillating_components_are_not_blamed_for_a_singularity() {
    // The harmonic oscillator returns to its start when the other component reaches its pole at 2π.
    let pole = std::f64::consts::TAU;
    let f = move |t: f64, y: &[f64], dy: &mut [f64]| {
        (dy[0], dy[1]) = (y[1], -y[0]);
        dy[2] = (pole - t).powi(-2);
    };
    let solution = run(f, (0.0, 10.0), &[0.0, 1.0, 0.0], Options::tolerance(1e-9));
    match solution.stop {
        Stop::Divergence {
            singularity,
            component: 2,
            unbounded: true,
            ..
        } => {
            assert!((singularity - pole).abs() < 1e-7);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_system_without_components_only_passes_the_time() {
    let solution = run(|_, _, _| (), (0.0, 1.0), &[], Options::tolerance(1e-9));
    assert_eq!((solution.stop, solution.t), (Stop::Finished, 1.0));
}

#[test]
fn limits_and_interruptions_keep_what_there_is() {
    let mut options = Options::tolerance(1e-9);
    options.step_limit = 5;
    let solution = run(|_, y, dy| dy[0] = -y[0], (0.0, 1e3), &[1.0], options);
    assert_eq!(
        solution.stop,
        Stop::StepLimit {
            t: solution.t,
            limit: 5
        }
    );
    assert_eq!((solution.len(), solution.statistics.steps), (6, 5));

    let flag = AtomicBool::new(false);
    let mut options = Options::tolerance(1e-9);
    options.interrupt = Some(&flag);
    let f = |t: f64, y: &[f64], dy: &mut [f64]| {
        dy[0] = -y[0];
        flag.store(t > 3.0, Ordering::Relaxed);
    };
    let solution = run(f, (0.0, 1e3), &[1.0], options);
    assert_eq!(solution.stop, Stop::Interrupted { t: solution.t });
    assert!(solution.t > 1.0 && solution.t < 10.0);

    let mut seen = Vec::new();
    let mut callback = |p: chetaev_integrate::Progress| {
        seen.push(p.t);
        assert_eq!((p.t_start, p.t_end), (0.0, 1e3));
        if p.steps == 3 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let mut options = Options::tolerance(1e-9);
    options.progress = Some(&mut callback);
    let solution = run(|_, y, dy| dy[0] = -y[0], (0.0, 1e3), &[1.0], options);
    assert_eq!(solution.stop, Stop::Interrupted { t: solution.t });
    assert_eq!(seen, solution.times[1..]);
}

/// y' = −10⁶ (y − cos t), the stiff test of Hairer & Wanner 1996, IV.1.
fn stiff(t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = -1e6 * (y[0] - t.cos());
}

#[test]
fn stiffness_is_noticed_and_bounded() {
    for method in [&DORMAND_PRINCE_853 as &'static dyn Method, &TSITOURAS_5] {
        let mut options = Options::tolerance(1e-6).method(method).output(Output::End);
        options.stiffness = StiffnessPolicy::StopAfter(1000);
        let solution = run(stiff, (0.0, 1.0), &[1.0], options);
        assert!(
            matches!(solution.stop, Stop::Stiff { steps: 1000.., steps_ahead, .. } if steps_ahead > 1e4)
        );
        assert!(
            solution.statistics.steps < 1100,
            "{}",
            solution.statistics.steps
        );
        match solution.notes[..] {
            [Note::Stiff { stability, h, .. }] => {
                let bound = if method.card().order == 8 { 6.1 } else { 3.3 };
                let eigenvalue = stability * bound / h;
                assert!((eigenvalue / 1e6 - 1.0).abs() < 0.1, "{eigenvalue:e}");
            }
            ref other => panic!("{other:?}"),
        }
        // The partial trajectory is right.
        assert!((solution.state[0] - solution.t.cos()).abs() < 1e-5);
    }
    // With a note only, the run goes on.
    let mut options = Options::tolerance(1e-6).output(Output::End);
    options.stiffness = StiffnessPolicy::Note;
    let solution = run(stiff, (0.0, 0.01), &[1.0], options);
    assert_eq!(solution.stop, Stop::Finished);
    assert_eq!(solution.notes.len(), 1);
}

#[test]
fn ordinary_motion_is_not_called_stiff() {
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let (mut system, y0) = kepler();
        let solution = integrate(
            &mut system,
            (0.0, 100.0),
            &y0,
            &mut [],
            Options::tolerance(tolerance),
        )
        .unwrap();
        assert!(
            solution.notes.is_empty(),
            "{tolerance:e}: {:?}",
            solution.notes
        );
    }
}

#[test]
fn unusable_questions_are_refused() {
    let refuse = |y0: &[f64], span: (f64, f64), options: Options<'_>| {
        let mut system = from_fn(2, |_t, _y: &[f64], _dy: &mut [f64]| panic!("evaluated"));
        integrate(&mut system, span, y0, &mut [], options).unwrap_err()
    };
    let y = [1.0, 2.0];
    let span = (0.0, 1.0);
    let ok = || Options::tolerance(1e-9);
    assert!(matches!(
        refuse(&[1.0], span, ok()),
        IntegrateError::Dimension {
            expected: 2,
            found: 1,
            ..
        }
    ));
    assert!(matches!(
        refuse(&[1.0, f64::NAN], span, ok()),
        IntegrateError::InitialNotFinite { component: 1 }
    ));
    assert!(matches!(
        refuse(&y, (0.0, f64::INFINITY), ok()),
        IntegrateError::InvalidSpan { .. }
    ));
    match refuse(&y, span, Options::tolerance(1e-15)) {
        IntegrateError::ToleranceTooSmall {
            method,
            requested,
            attainable,
            ..
        } => {
            assert_eq!((method, requested), ("dormand-prince-853", 1e-15));
            assert_eq!(attainable, 100.0 * f64::EPSILON);
        }
        other => panic!("{other:?}"),
    }
    for tolerance in [0.0, -1.0, f64::NAN] {
        let error = refuse(&y, span, Options::tolerance(tolerance));
        assert!(
            matches!(error, IntegrateError::InvalidTolerance { component: 0, .. }),
            "{error:?}"
        );
    }
    let mut options = ok();
    options.error.atol_of = vec![1e-9];
    assert!(matches!(
        refuse(&y, span, options),
        IntegrateError::Dimension { .. }
    ));
    // A cyclic component is controlled by its absolute tolerance, which must be resolved at its size.
    let mut options = ok();
    options.error.absolute = vec![false, true];
    options.error.atol_of = vec![1e-9, 1e-20];
    assert!(matches!(
        refuse(&y, span, options),
        IntegrateError::ToleranceTooSmall { component: 1, .. }
    ));
    let options = ok().method(&RUNGE_KUTTA_4);
    assert!(matches!(
        refuse(&y, span, options),
        IntegrateError::FixedStepRequired { .. }
    ));
    assert!(matches!(
        refuse(&y, span, Options::fixed_step(&RUNGE_KUTTA_4, -0.1)),
        IntegrateError::InvalidInterval { .. }
    ));
    assert!(matches!(
        refuse(&y, span, ok().output(Output::Times(vec![2.0]))),
        IntegrateError::InvalidOutputTime { index: 0, .. }
    ));
}

#[test]
fn methods_are_found_by_name() {
    for m in METHODS {
        assert_eq!(method(m.card().name).unwrap().card(), m.card());
    }
    let error = method("dopri").err().unwrap().to_string();
    assert!(
        error.contains("`dopri`") && error.contains("tsitouras-5"),
        "{error}"
    );
}

#[test]
fn cyclic_components_do_not_loosen_the_control() {
    // An angle that has grown to 10⁶, where a relative control allows errors of 10⁻³.
    let error = |absolute: bool| {
        let mut options = Options::tolerance(1e-9).output(Output::End);
        options.error.absolute = vec![absolute];
        let solution = run(
            |t, _, dy| dy[0] = (50.0 * t).cos(),
            (0.0, 10.0),
            &[1e6],
            options,
        );
        (solution.state[0] - 1e6 - 500f64.sin() / 50.0).abs()
    };
    assert!(error(true) < 1e-8, "{:e}", error(true));
    assert!(error(false) > 1e-6, "{:e}", error(false));
}

#[test]
fn step_limits_are_obeyed() {
    let mut options = Options::tolerance(1e-6);
    options.step = StepSize::Adaptive {
        first: Some(1e-3),
        most: Some(0.25),
    };
    let solution = run(|_, _, dy| dy[0] = 1.0, (0.0, 10.0), &[0.0], options);
    assert!((solution.times[1] - 1e-3).abs() < 1e-18);
    let longest = solution
        .times
        .windows(2)
        .map(|p| p[1] - p[0])
        .fold(0.0, f64::max);
    assert!(longest <= 0.25 * 1.02, "{longest}");
}

#[test]
fn the_global_error_is_estimated() {
    for tolerance in [1e-6, 1e-9, 1e-13] {
        let (mut system, y0) = kepler();
        let options = || Options::tolerance(tolerance).output(Output::Every(0.5));
        let solution = integrate(&mut system, (0.0, 20.0), &y0, &mut [], options()).unwrap();
        let estimate = global_error(&mut system, (0.0, &y0), &solution, options()).unwrap();
        assert_eq!(
            (estimate.stop, estimate.rows, estimate.until),
            (Stop::Finished, 41, 20.0)
        );
        let actual = (0..solution.len())
            .map(|j| distance(solution.row(j), &kepler_exact(solution.times[j])))
            .fold(0.0, f64::max);
        let ratio = estimate
            .components
            .iter()
            .map(|c| c.largest)
            .fold(0.0, f64::max)
            / actual;
        assert!(
            (0.5..2.5).contains(&ratio),
            "{tolerance:e}: estimate/actual = {ratio}"
        );
        assert!(estimate.largest_scaled() <= ratio * actual);
    }
    let (mut system, y0) = kepler();
    let options = || Options::fixed_step(&RUNGE_KUTTA_4, 0.005).output(Output::Every(0.5));
    let solution = integrate(&mut system, (0.0, 3.0), &y0, &mut [], options()).unwrap();
    let estimate = global_error(&mut system, (0.0, &y0), &solution, options()).unwrap();
    let actual = distance(&solution.state, &kepler_exact(3.0));
    let estimated = estimate
        .components
        .iter()
        .map(|c| c.largest)
        .fold(0.0, f64::max);
    assert!(
        (0.9..1.5).contains(&(estimated / actual)),
        "{estimated:e} for {actual:e}"
    );
}

/// y' = -sign(y) ends at y = 0 at t = 1 and cannot leave it: the steps become as short as the tolerance and stay so. The run
/// says that it does not get on.
#[test]
fn a_run_that_only_creeps_ends() {
    let mut system = from_fn(1, |_t, y: &[f64], dy: &mut [f64]| {
        dy[0] = if y[0] > 0.0 { -1.0 } else { 1.0 }
    });
    let options = Options::tolerance(1e-13).output(Output::End);
    let run = integrate(&mut system, (0.0, 2.0), &[1.0], &mut [], options).unwrap();
    assert!(
        matches!(run.stop, Stop::StepTooSmall { .. }),
        "{:?}",
        run.stop
    );
    assert!((run.t - 1.0).abs() < 1e-5, "{}", run.t);
}
