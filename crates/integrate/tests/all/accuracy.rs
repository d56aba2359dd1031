//! Order, tolerance and dense output measured on nonlinear problems with closed forms.

#![allow(clippy::unwrap_used)]

use crate::common::{distance, kepler, kepler_exact, particle, particle_exact};
use chetaev_integrate::methods::{DORMAND_PRINCE_853, METHODS, TSITOURAS_5};
use chetaev_integrate::{from_fn, integrate, Method, Options, Output, Stop, System};

/// Largest error at the step ends of a run with fixed steps.
fn fixed_error<const N: usize>(
    (mut system, y0): (impl System, [f64; N]),
    exact: fn(f64) -> [f64; N],
    (t_end, steps): (f64, u32),
    method: &'static dyn Method,
) -> f64 {
    let options = Options::fixed_step(method, t_end / f64::from(steps));
    let run = integrate(&mut system, (0.0, t_end), &y0, &mut [], options).unwrap();
    assert_eq!(run.stop, Stop::Finished);
    assert_eq!(run.statistics.steps, u64::from(steps));
    (0..run.len())
        .map(|j| distance(run.row(j), &exact(run.times[j])))
        .fold(0.0, f64::max)
}

/// The methods that need nothing but the right-hand side; the tests of the Taylor method are in `taylor.rs`.
fn plain_methods() -> impl Iterator<Item = &'static dyn Method> {
    METHODS
        .iter()
        .copied()
        .filter(|method| !method.card().needs_series)
}

#[test]
fn observed_order_at_step_ends() {
    for method in plain_methods() {
        let order = f64::from(method.card().order);
        let counts = if order > 6.0 { [100, 200] } else { [320, 640] };
        let kepler_errors =
            counts.map(|steps| fixed_error(kepler(), kepler_exact, (3.0, steps), method));
        let counts = if order > 6.0 { [20, 40] } else { [128, 256] };
        let particle_errors =
            counts.map(|steps| fixed_error(particle(), particle_exact, (4.0, steps), method));
        for errors in [kepler_errors, particle_errors] {
            let slope = (errors[0] / errors[1]).log2();
            assert!(
                (slope - order).abs() < 0.4,
                "{}: slope {slope} from {errors:?}",
                method.card().name
            );
        }
    }
}

/// Largest error at interior times of every step, with fixed steps.
fn dense_error(method: &'static dyn Method, steps: u32) -> f64 {
    let (mut system, y0) = kepler();
    let h = 3.0 / f64::from(steps);
    let times: Vec<f64> = (0..steps)
        .flat_map(|j| [0.21, 0.5, 0.77].map(|theta| h * (f64::from(j) + theta)))
        .collect();
    let options = Options::fixed_step(method, h).output(Output::Times(times));
    let run = integrate(&mut system, (0.0, 3.0), &y0, &mut [], options).unwrap();
    assert_eq!(run.len(), 3 * steps as usize);
    (0..run.len())
        .map(|j| distance(run.row(j), &kepler_exact(run.times[j])))
        .fold(0.0, f64::max)
}

#[test]
fn observed_order_of_dense_output() {
    for method in plain_methods() {
        let card = method.card();
        let coarse = if card.order > 6 { 40 } else { 320 };
        let errors = [coarse, 2 * coarse].map(|steps| dense_error(method, steps));
        let slope = (errors[0] / errors[1]).log2();
        // The error in the interior of a step is that of the step ends plus O(h^(dense order + 1)).
        let expected = f64::from(card.order.min(card.dense_order + 1));
        assert!(
            slope > expected - 0.5 && slope < expected + 1.0,
            "{}: slope {slope} from {errors:?}",
            card.name
        );
    }
}

#[test]
fn dense_output_is_continuous_with_its_derivative() {
    for method in [&DORMAND_PRINCE_853 as &'static dyn Method, &TSITOURAS_5] {
        let (mut system, y0) = kepler();
        let mut options = Options::tolerance(1e-8).method(method);
        options.keep_trajectory = true;
        let run = integrate(&mut system, (0.0, 10.0), &y0, &mut [], options).unwrap();
        let trajectory = run.trajectory.as_ref().unwrap();
        assert_eq!(trajectory.len() as u64, run.statistics.steps);
        let (mut at, mut before, mut after) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for j in 1..run.len() - 1 {
            let (t, d) = (run.times[j], 1e-7);
            trajectory.at(t, &mut at).unwrap();
            trajectory.at(t - d, &mut before).unwrap();
            trajectory.at(t + d, &mut after).unwrap();
            assert!(distance(&at, run.row(j)) < 1e-15 * 10.0);
            for i in 0..4 {
                let jump = (after[i] - at[i]) - (at[i] - before[i]);
                assert!(jump.abs() < 1e-11, "component {i} at {t}: {jump:e}");
            }
        }
        assert!(trajectory.at(10.1, &mut at).is_none());
        assert!(trajectory.at(-0.1, &mut at).is_none());
    }
}

#[test]
fn error_follows_the_tolerance() {
    for (method, tolerances) in [
        (
            &DORMAND_PRINCE_853 as &'static dyn Method,
            [1e-4, 1e-6, 1e-8, 1e-10, 1e-12],
        ),
        (&TSITOURAS_5, [1e-3, 1e-4, 1e-6, 1e-8, 1e-10]),
    ] {
        let mut last = f64::INFINITY;
        for tolerance in tolerances {
            let (mut system, y0) = kepler();
            let options = Options::tolerance(tolerance)
                .method(method)
                .output(Output::End);
            let run = integrate(&mut system, (0.0, 6.5), &y0, &mut [], options).unwrap();
            let error = distance(&run.state, &kepler_exact(6.5));
            assert!(error < last, "{tolerance:e}: {error:e} after {last:e}");
            assert!(
                (0.01..50.0).contains(&(error / tolerance)),
                "{} at {tolerance:e}: {error:e}",
                method.card().name
            );
            last = error;
        }
    }
}

#[test]
fn work_is_that_of_the_literature() {
    // Evaluations that SciPy 1.17 (solve_ivp, DOP853) needs for the same accuracy on the same problem.
    for (tolerance, evaluations, error) in [
        (1e-6, 3818, 8.4e-3),
        (1e-9, 8090, 6.8e-6),
        (1e-12, 14942, 5.3e-9),
    ] {
        let (mut system, y0) = kepler();
        let options = Options::tolerance(tolerance).output(Output::End);
        let run = integrate(&mut system, (0.0, 100.0), &y0, &mut [], options).unwrap();
        assert!(
            (run.statistics.evaluations as f64) < 1.15 * f64::from(evaluations),
            "{:?}",
            run.statistics
        );
        assert!(distance(&run.state[..2], &kepler_exact(100.0)[..2]) < 2.0 * error);
        assert!(
            run.statistics.rejected * 4 < run.statistics.steps,
            "{:?}",
            run.statistics
        );
    }
}

#[test]
fn published_kepler_positions() {
    // reference case kepler-ellipse
    let (mut system, y0) = kepler();
    let options = Options::tolerance(1e-11).output(Output::Times(vec![1.0, 3.0, 5.0]));
    let run = integrate(&mut system, (0.0, 6.5), &y0, &mut [], options).unwrap();
    let expected = [
        [-0.628948176826624, 0.799664730970039],
        [-1.59608300287016, 0.0707385106686625],
        [-0.883770779386257, -0.767113715592787],
    ];
    for (j, position) in expected.iter().enumerate() {
        assert!(distance(&run.row(j)[..2], position) < 1e-9);
    }
}

#[test]
fn backward_runs_return() {
    let (mut system, y0) = kepler();
    let there = integrate(
        &mut system,
        (0.0, 5.0),
        &y0,
        &mut [],
        Options::tolerance(1e-12),
    )
    .unwrap();
    let options = Options::tolerance(1e-12).output(Output::Every(1.0));
    let back = integrate(&mut system, (5.0, 0.0), &there.state, &mut [], options).unwrap();
    assert_eq!(back.stop, Stop::Finished);
    assert_eq!(back.times, [5.0, 4.0, 3.0, 2.0, 1.0, 0.0]);
    assert!(distance(&back.state, &y0) < 1e-10);
    for j in 0..back.len() {
        assert!(distance(back.row(j), &kepler_exact(back.times[j])) < 1e-9);
    }
}

/// Every method but the Taylor method, whose test is beside its others: there and back again, to the accuracy of the run.
#[test]
fn every_method_returns() {
    for method in plain_methods() {
        let card = method.card();
        let options = || match card.adaptive {
            true => Options::tolerance(1e-10).method(method),
            false => Options::fixed_step(method, 5e-4),
        };
        let (mut system, y0) = kepler();
        let there = integrate(&mut system, (0.0, 8.0), &y0, &mut [], options()).unwrap();
        // The largest error of a run forward as long as the way there and back, with as many passes of the pericentre.
        let on = integrate(&mut system, (0.0, 16.0), &y0, &mut [], options()).unwrap();
        let error = (0..on.len())
            .map(|j| distance(on.row(j), &kepler_exact(on.times[j])))
            .fold(0.0, f64::max);
        let back = integrate(&mut system, (8.0, 0.0), &there.state, &mut [], options()).unwrap();
        assert_eq!((back.stop, back.t), (Stop::Finished, 0.0), "{}", card.name);
        let gap = distance(&back.state, &y0);
        assert!(
            error < 1e-6 && gap < 3.0 * error,
            "{}: {gap:e} back, {error:e} on the way",
            card.name
        );
    }
}

#[test]
fn compensation_removes_the_growth_of_rounding() {
    // y = 1000 + sin t, with so many steps that rounding dominates by far.
    let error = |compensated: bool| {
        let mut system = from_fn(1, |t, _y: &[f64], dy: &mut [f64]| dy[0] = t.cos());
        let mut options = Options::fixed_step(&DORMAND_PRINCE_853, 1e-3).output(Output::End);
        options.compensated = compensated;
        let run = integrate(&mut system, (0.0, 200.0), &[1000.0], &mut [], options).unwrap();
        (run.state[0] - (1000.0 + 200f64.sin())).abs()
    };
    assert!(error(true) < 2e-13, "{:e}", error(true));
    assert!(error(false) > 2e-12, "{:e}", error(false));
}
