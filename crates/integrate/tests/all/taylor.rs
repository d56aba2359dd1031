//! The Taylor method on systems whose coefficients are written by hand: closed forms, poles, polynomials, corners,
//! reversibility, long runs, and events on its dense output.

#![allow(clippy::unwrap_used)]

use crate::common::{distance, kepler_exact, ECC};
use chetaev_integrate::methods::{DORMAND_PRINCE_853, TAYLOR};
use chetaev_integrate::{
    from_fn, global_error, integrate, Direction, EvaluationFailure, Event, EventKind,
    IntegrateError, Method, Options, Output, Stop, System,
};

/// A system given by a function that writes x_[j+1] of the series `x[j][i]` known up to order j.
struct Recurrence<F> {
    n: usize,
    next: F,
    expansions: u64,
}

fn recurrence<F>(n: usize, next: F) -> Recurrence<F>
where
    F: FnMut(f64, &[Vec<f64>], &mut [f64]) -> Result<(), EvaluationFailure>,
{
    Recurrence {
        n,
        next,
        expansions: 0,
    }
}

impl<F> System for Recurrence<F>
where
    F: FnMut(f64, &[Vec<f64>], &mut [f64]) -> Result<(), EvaluationFailure>,
{
    fn dimension(&self) -> usize {
        self.n
    }

    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        (self.next)(t, &[y.to_vec()], dy)
    }

    fn has_series(&self) -> bool {
        true
    }

    fn expand(
        &mut self,
        t: f64,
        (y, _): (&[f64], &[f64]),
        order: usize,
        coefficients: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        self.expansions += u64::from(order > 1);
        let mut known = vec![y.to_vec()];
        for _ in 0..order {
            let mut next = vec![0.0; self.n];
            (self.next)(t, &known, &mut next)?;
            known.push(next);
        }
        coefficients.copy_from_slice(&known.concat());
        Ok(())
    }
}

/// Σ a_i b_(j−i) of two series.
fn product(a: &[f64], b: &[f64], j: usize) -> f64 {
    (0..=j).map(|i| a[i] * b[j - i]).sum()
}

/// The series of component i.
fn component(x: &[Vec<f64>], i: usize) -> Vec<f64> {
    x.iter().map(|row| row[i]).collect()
}

/// The series of x^c.
fn power(x: &[f64], c: f64) -> Vec<f64> {
    let mut w = vec![x[0].powf(c)];
    for j in 1..x.len() {
        let sum: f64 = (0..j)
            .map(|i| (c * (j - i) as f64 - i as f64) * x[j - i] * w[i])
            .sum();
        w.push(sum / (j as f64 * x[0]));
    }
    w
}

/// Kepler's problem of the other tests.
fn kepler() -> (impl System, [f64; 4]) {
    let system = recurrence(4, |_t, state, next| {
        let j = state.len() - 1;
        let [x, y] = [0, 1].map(|i| component(state, i));
        let squared: Vec<f64> = (0..=j)
            .map(|k| product(&x, &x, k) + product(&y, &y, k))
            .collect();
        let cubed = power(&squared, -1.5);
        let share = (j + 1) as f64;
        next[0] = state[j][2] / share;
        next[1] = state[j][3] / share;
        next[2] = -product(&x, &cubed, j) / share;
        next[3] = -product(&y, &cubed, j) / share;
        Ok(())
    });
    let speed = ((1.0 + ECC) / (1.0 - ECC)).sqrt();
    (system, [1.0 - ECC, 0.0, 0.0, speed])
}

fn taylor<'a>(tolerance: f64) -> Options<'a> {
    Options::tolerance(tolerance).method(&TAYLOR)
}

#[test]
fn kepler_to_round_off() {
    let (mut system, y0) = kepler();
    let run = integrate(&mut system, (0.0, 20.0), &y0, &mut [], taylor(1e-15)).unwrap();
    assert_eq!(run.stop, Stop::Finished);
    for j in 0..run.len() {
        let error = distance(run.row(j), &kepler_exact(run.times[j]));
        assert!(error < 1e-12, "{error:e} at {}", run.times[j]);
    }
    assert!(run.statistics.rejected == 0, "{:?}", run.statistics);
    // One expansion for each step, one for the start, and one evaluation at the end of each.
    assert_eq!(run.statistics.evaluations, 2 * run.statistics.steps);
}

#[test]
fn the_error_follows_the_tolerance() {
    let mut last = f64::INFINITY;
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let (mut system, y0) = kepler();
        let options = taylor(tolerance).output(Output::End);
        let run = integrate(&mut system, (0.0, 10.0), &y0, &mut [], options).unwrap();
        let error = distance(&run.state, &kepler_exact(10.0));
        assert!(
            error < 1e3 * tolerance && error < last,
            "{tolerance:e}: {error:e}"
        );
        last = error;
    }
}

#[test]
fn dense_output_is_as_good_as_the_steps() {
    let (mut system, y0) = kepler();
    let times: Vec<f64> = (0..=500).map(|j| f64::from(j) * 0.02).collect();
    let options = taylor(1e-15).output(Output::Times(times));
    let run = integrate(&mut system, (0.0, 10.0), &y0, &mut [], options).unwrap();
    assert_eq!(run.len(), 501);
    for j in 0..run.len() {
        let error = distance(run.row(j), &kepler_exact(run.times[j]));
        assert!(error < 1e-12, "{error:e} at {}", run.times[j]);
    }
}

#[test]
fn kept_polynomials_of_different_orders() {
    // Tolerances that are absolute near zero: the order grows where the state is small.
    let mut system = recurrence(1, |_t, x, next| {
        let j = x.len() - 1;
        next[0] = -3.0 * x[j][0] / (j + 1) as f64;
        Ok(())
    });
    let mut options = taylor(1e-6);
    options.error.atol = 1e-14;
    options.keep_trajectory = true;
    let run = integrate(&mut system, (0.0, 6.0), &[1.0], &mut [], options).unwrap();
    let trajectory = run.trajectory.as_ref().unwrap();
    for j in 0..=60 {
        let (t, mut y) = (0.1 * f64::from(j), [0.0]);
        trajectory.at(t.min(6.0), &mut y).unwrap();
        let exact = (-3.0 * t).exp();
        assert!((y[0] - exact).abs() < 1e-5 * exact, "{t}: {} {exact}", y[0]);
    }
}

/// x' = x² from x0: a pole at 1/x0.
fn pole() -> impl System {
    recurrence(1, |_t, state, next| {
        let (j, x) = (state.len() - 1, component(state, 0));
        next[0] = product(&x, &x, j) / (j + 1) as f64;
        Ok(())
    })
}

#[test]
fn the_first_step_is_a_fixed_part_of_the_radius_of_convergence() {
    // Coefficients x0^(j+1): the radius is 1/x0. At p = 24 the rule makes (1/x0) (e^(−2) w)^(1/24) exp(−0.7/23) of it,
    // w between 1e-15 and 2e-15: a part between 0.19 and 0.23.
    for x0 in [0.25, 1.0, 40.0] {
        let options = taylor(1e-15).output(Output::Steps);
        let run = integrate(&mut pole(), (0.0, 0.9 / x0), &[x0], &mut [], options).unwrap();
        let part = run.times[1] * x0;
        assert!(part > 0.19 && part < 0.23, "{part}");
        // Each step is the same part of what is left.
        let next = (run.times[2] - run.times[1]) / (1.0 / x0 - run.times[1]);
        assert!((next - part).abs() < 0.02, "{part} {next}");
        let exact = x0 / (1.0 - 0.9);
        assert!((run.state[0] / exact - 1.0).abs() < 1e-13);
    }
}

#[test]
fn a_pole_is_found_and_dated() {
    let run = integrate(&mut pole(), (0.0, 2.0), &[1.0], &mut [], taylor(1e-12)).unwrap();
    match run.stop {
        Stop::Divergence {
            singularity,
            component: 0,
            unbounded: true,
            ..
        } => assert!((singularity - 1.0).abs() < 1e-6, "{singularity}"),
        stop => panic!("{stop:?}"),
    }
}

#[test]
fn a_polynomial_is_one_step() {
    // Vertical throw: h = 2 + 10 t − 9.81 t²/2.
    let mut throw = recurrence(2, |_t, x, next| {
        let j = x.len() - 1;
        next[0] = x[j][1] / (j + 1) as f64;
        next[1] = if j == 0 { -9.81 } else { 0.0 };
        Ok(())
    });
    let run = integrate(&mut throw, (0.0, 3.0), &[2.0, 10.0], &mut [], taylor(1e-15)).unwrap();
    assert_eq!(run.statistics.steps, 1);
    assert!((run.state[0] - (32.0 - 9.81 * 4.5)).abs() < 1e-14);
    assert_eq!(run.state[1], 10.0 - 9.81 * 3.0);
    // With a limit of the step it takes as many as that demands.
    let mut options = taylor(1e-15);
    options.step = chetaev_integrate::StepSize::Adaptive {
        first: None,
        most: Some(0.5),
    };
    let run = integrate(&mut throw, (0.0, 3.0), &[2.0, 10.0], &mut [], options).unwrap();
    assert_eq!(run.statistics.steps, 6);
}

#[test]
fn a_motion_is_reversible() {
    let (mut system, y0) = kepler();
    let there = integrate(&mut system, (0.0, 7.0), &y0, &mut [], taylor(1e-15)).unwrap();
    let back = integrate(
        &mut system,
        (7.0, 0.0),
        &there.state,
        &mut [],
        taylor(1e-15),
    )
    .unwrap();
    assert_eq!(back.stop, Stop::Finished);
    assert!(distance(&back.state, &y0) < 1e-13, "{:?}", back.state);
}

#[test]
fn a_corner_that_no_coefficient_shows() {
    // x' = |t − 1/2|, on each side a polynomial.
    let mut corner = recurrence(1, |t, x, next| {
        let (j, side) = (x.len() - 1, (t - 0.5f64).signum());
        next[0] = match j {
            0 => side * (t - 0.5),
            1 => side / 2.0,
            _ => 0.0,
        };
        Ok(())
    });
    let run = integrate(&mut corner, (0.0, 2.0), &[0.0], &mut [], taylor(1e-10)).unwrap();
    assert!(
        (run.state[0] - (0.125 + 1.125)).abs() < 1e-8,
        "{:?}",
        run.state
    );
    assert!(run.statistics.rejected > 0);
}

#[test]
fn a_series_that_ends_stops_the_run_with_its_reason() {
    // x' = −1/(2 √…): the radicand reaches 0 at t = 1.
    let mut root = recurrence(1, |_t, state, next| {
        let (j, x) = (state.len() - 1, component(state, 0));
        if x[0] <= 0.0 {
            return Err(EvaluationFailure::NotAnalytic {
                operation: "sqrt",
                argument: x[0],
            });
        }
        next[0] = -0.5 * power(&x, -1.0)[j] / (j + 1) as f64;
        Ok(())
    });
    let run = integrate(&mut root, (0.0, 2.0), &[1.0], &mut [], taylor(1e-12)).unwrap();
    assert!((run.t - 1.0).abs() < 1e-6, "{:?}", run.stop);
    assert!(!matches!(run.stop, Stop::Finished | Stop::StepLimit { .. }));
    let run = integrate(&mut root, (0.0, 2.0), &[0.0], &mut [], taylor(1e-12)).unwrap();
    let failure = EvaluationFailure::NotAnalytic {
        operation: "sqrt",
        argument: 0.0,
    };
    assert_eq!(run.stop, Stop::Singular { t: 0.0, failure });
}

#[test]
fn a_system_without_coefficients_is_refused() {
    let mut plain = from_fn(1, |_t, y: &[f64], dy: &mut [f64]| dy[0] = y[0]);
    let refused = integrate(&mut plain, (0.0, 1.0), &[1.0], &mut [], taylor(1e-9));
    assert_eq!(refused, Err(IntegrateError::NoSeries { method: "taylor" }));
}

#[test]
fn tolerances_down_to_the_rounding() {
    let (mut system, y0) = kepler();
    let refuse = |options: Options<'_>, system: &mut dyn System| {
        integrate(system, (0.0, 1.0), &y0, &mut [], options).is_err()
    };
    assert!(refuse(taylor(1e-17), &mut system));
    assert!(!refuse(taylor(2.3e-16), &mut system));
    let strict = Options::tolerance(1e-15).method(&DORMAND_PRINCE_853);
    assert!(refuse(strict, &mut system));
}

#[test]
fn the_global_error_is_estimated() {
    let (mut system, y0) = kepler();
    let run = integrate(&mut system, (0.0, 10.0), &y0, &mut [], taylor(1e-8)).unwrap();
    let exact = distance(&run.state, &kepler_exact(10.0));
    let estimate = global_error(&mut system, (0.0, &y0), &run, taylor(1e-8)).unwrap();
    let found = estimate
        .components
        .iter()
        .map(|c| c.largest)
        .fold(0.0, f64::max);
    assert!(
        found > 0.3 * exact && found < 1e3 * exact,
        "{found:e} {exact:e}"
    );
}

/// θ'' = −sin θ beside a wheel that turns for ever, ψ' = 7: state (ψ, θ, ψ', θ').
fn wheel_and_pendulum() -> impl System {
    recurrence(4, |_t, state, next| {
        let (j, angle) = (state.len() - 1, component(state, 1));
        let (mut s, mut c) = (vec![angle[0].sin()], vec![angle[0].cos()]);
        for k in 1..=j {
            let sum = |g: &[f64]| -> f64 {
                (1..=k).map(|i| i as f64 * angle[i] * g[k - i]).sum::<f64>() / k as f64
            };
            let (sk, ck) = (sum(&c), -sum(&s));
            s.push(sk);
            c.push(ck);
        }
        let share = (j + 1) as f64;
        next[0] = state[j][2] / share;
        next[1] = state[j][3] / share;
        next[2] = 0.0;
        next[3] = -s[j] / share;
        Ok(())
    })
}

#[test]
fn an_angle_that_grows_does_not_loosen_the_control() {
    let energy = |y: &[f64]| 0.5 * y[3] * y[3] - y[1].cos();
    // From the angle 10⁹ a control by the largest component would allow errors of 10⁻⁶ in θ.
    let steps = [0.0, 1e9].map(|psi| {
        let y0 = [psi, 1.0, 7.0, 0.5];
        let mut options = taylor(1e-15).output(Output::End);
        options.error.absolute = vec![true, true, false, false];
        let mut system = wheel_and_pendulum();
        let run = integrate(&mut system, (0.0, 60.0), &y0, &mut [], options).unwrap();
        let drift = (energy(&run.state) - energy(&y0)).abs();
        assert!(drift < 2e-15, "{drift:e} from the angle {psi:e}");
        run.statistics.steps
    });
    assert_eq!(steps[0], steps[1]);
}

#[test]
fn a_long_run_drifts_by_rounding_only() {
    let energy = |y: &[f64]| 0.5 * y[3] * y[3] - y[1].cos();
    let y0 = [0.0, 1.0, 7.0, 0.5];
    let mut largest: f64 = 0.0;
    let mut options = taylor(1e-15).output(Output::Every(10.0));
    options.error.absolute = vec![true, true, false, false];
    let mut system = wheel_and_pendulum();
    let run = integrate(&mut system, (0.0, 5000.0), &y0, &mut [], options).unwrap();
    assert_eq!(run.stop, Stop::Finished);
    for j in 0..run.len() {
        largest = largest.max((energy(run.row(j)) - energy(&y0)).abs());
    }
    // √N ε for N steps, with a margin of four: rounding of one evaluation and no trend.
    let bound = 4.0 * (run.statistics.steps as f64).sqrt() * f64::EPSILON;
    assert!(
        largest < bound,
        "{largest:e} after {} steps",
        run.statistics.steps
    );
}

/// θ'' = −sin θ without allocations, for runs of many steps.
struct Pendulum {
    sin: [f64; 64],
    cos: [f64; 64],
}

impl System for Pendulum {
    fn dimension(&self) -> usize {
        2
    }

    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        (dy[0], dy[1]) = (y[1], -y[0].sin());
        Ok(())
    }

    fn has_series(&self) -> bool {
        true
    }

    fn expand(
        &mut self,
        _t: f64,
        (y, carry): (&[f64], &[f64]),
        order: usize,
        x: &mut [f64],
    ) -> Result<(), EvaluationFailure> {
        (x[0], x[1]) = (y[0], y[1]);
        // The sine and cosine of the sum of angle and carry.
        let (sin, cos) = y[0].sin_cos();
        self.sin[0] = sin + carry[0] * cos;
        self.cos[0] = cos - carry[0] * sin;
        for j in 0..order {
            let share = (j + 1) as f64;
            x[2 * j + 2] = x[2 * j + 1] / share;
            x[2 * j + 3] = -self.sin[j] / share;
            let (mut s, mut c) = (0.0, 0.0);
            for i in 1..=j + 1 {
                let rate = i as f64 * x[2 * i];
                s += rate * self.cos[j + 1 - i];
                c -= rate * self.sin[j + 1 - i];
            }
            (self.sin[j + 1], self.cos[j + 1]) = (s / share, c / share);
        }
        Ok(())
    }
}

/// A million steps: rounding adds up as a random walk, as √N, and not as N.
#[test]
fn a_million_steps_drift_as_a_random_walk() {
    let energy = |y: &[f64]| 0.5 * y[1] * y[1] - y[0].cos();
    let mut pendulum = Pendulum {
        sin: [0.0; 64],
        cos: [0.0; 64],
    };
    let y0 = [0.0, 1.5];
    // Order 15 with steps of a twentieth of the radius of convergence: (1/20)^15 is below rounding.
    let mut options = Options::fixed_step(&TAYLOR, 0.1).output(Output::Every(100.0));
    (options.error.rtol, options.error.atol) = (0.0, 1e-8);
    assert_eq!(TAYLOR.order(&options.error), 15);
    let run = integrate(&mut pendulum, (0.0, 1e5), &y0, &mut [], options).unwrap();
    assert_eq!(run.stop, Stop::Finished);
    let steps = run.statistics.steps as f64;
    assert!((steps - 1e6).abs() < 2.0, "{steps}");
    // A trend of a hundredth of a unit in the last place in each step would be ten times the bound at the end.
    let mut largest: f64 = 0.0;
    for j in 1..run.len() {
        largest = largest.max((energy(run.row(j)) - energy(&y0)).abs());
        let walked = steps * run.times[j] / run.t;
        let bound = f64::EPSILON * walked.sqrt();
        assert!(largest < bound, "{largest:e} after {walked} steps");
    }
}

/// With steps and order both fixed the error falls as h^p, for the orders 4, 5, 7 and 10 that these tolerances ask for.
#[test]
fn observed_order_of_fixed_steps() {
    for (tolerance, coarse) in [(0.5, 400), (1e-2, 800), (1e-3, 300), (1e-5, 100)] {
        let mut order = 0;
        let errors = [coarse, 2 * coarse].map(|steps: u32| {
            let (mut system, y0) = kepler();
            let mut options = Options::fixed_step(&TAYLOR, 3.0 / f64::from(steps));
            // Tolerances that do not depend on the state give one order for the whole run.
            (options.error.rtol, options.error.atol) = (0.0, tolerance);
            order = TAYLOR.order(&options.error);
            let run = integrate(&mut system, (0.0, 3.0), &y0, &mut [], options).unwrap();
            assert_eq!(run.statistics.steps, u64::from(steps));
            let rows = (0..run.len()).map(|j| distance(run.row(j), &kepler_exact(run.times[j])));
            rows.fold(0.0, f64::max)
        });
        let slope = (errors[0] / errors[1]).log2();
        assert!(errors[1] > 1e-15, "rounding hides the order {order}");
        assert!(
            (slope - f64::from(order)).abs() < 0.4,
            "order {order}: slope {slope} from {errors:?}"
        );
    }
}

#[test]
fn events_in_one_long_step() {
    // y = t in one step; two zeros close together, one at the end, one at the start that does not count.
    let clock = || {
        recurrence(1, |_t, x, next| {
            next[0] = if x.len() == 1 { 1.0 } else { 0.0 };
            Ok(())
        })
    };
    let mut events = [
        Event::new(|_t, y| (y[0] - 4.02) * (y[0] - 4.0)),
        Event::new(|_t, y| y[0] - 10.0),
        Event::new(|_t, y| y[0]),
        Event::new(|_t, y| (y[0] - 5.0).powi(2)),
        Event::new(|_t, y| (y[0] - 3.0).powi(3)).direction(Direction::Down),
    ];
    let options = taylor(1e-15).output(Output::End);
    let run = integrate(&mut clock(), (0.0, 10.0), &[0.0], &mut events, options).unwrap();
    assert_eq!(run.statistics.steps, 1);
    let found: Vec<(usize, EventKind)> = run.events.iter().map(|e| (e.index, e.kind)).collect();
    let expected = [
        (0, EventKind::Down),
        (0, EventKind::Up),
        (3, EventKind::Grazing),
        (1, EventKind::Up),
    ];
    assert_eq!(found, expected);
    for (event, t) in run.events.iter().zip([4.0, 4.02, 5.0, 10.0]) {
        let accuracy = if event.kind == EventKind::Grazing {
            1e-6
        } else {
            4e-15
        };
        assert!((event.t - t).abs() <= accuracy, "{event:?}");
    }
}

#[test]
fn a_period_by_its_event() {
    // The pendulum from rest at θ = 1: period 4 K(sin 1/2), by the arithmetic-geometric mean.
    let k = 0.5f64.sin();
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    for _ in 0..10 {
        (a, b) = ((a + b) / 2.0, (a * b).sqrt());
    }
    let period = 2.0 * std::f64::consts::PI / a;
    let mut events = [Event::new(|_t, y| y[3])
        .direction(Direction::Down)
        .terminal_after(2)];
    let options = taylor(1e-15).output(Output::End);
    let mut system = wheel_and_pendulum();
    let y0 = [0.0, 1.0, 0.0, 0.0];
    let run = integrate(&mut system, (0.0, 100.0), &y0, &mut events, options).unwrap();
    assert_eq!(run.stop, Stop::Event { t: run.t, index: 0 });
    assert!(
        (run.t - 2.0 * period).abs() < 1e-13,
        "{:e}",
        run.t - 2.0 * period
    );
}

/// Late on the clock the time has few digits behind the point: steps end where it is a float, so that the force is asked for at the
/// time at which it acts. x'' = cos t from rest is x = cos t₀ − cos t − (t − t₀) sin t₀.
#[test]
fn a_late_start_costs_nothing() {
    for start in [0.0, 1e5, 1e8] {
        let mut system = recurrence(2, |t, x: &[Vec<f64>], next: &mut [f64]| {
            let j = x.len() - 1;
            let quarter_turns = j as f64 * std::f64::consts::FRAC_PI_2;
            let factorial: f64 = (1..=j).map(|k| k as f64).product();
            next[0] = x[j][1] / (j + 1) as f64;
            next[1] = (t + 0.0)
                .cos()
                .mul_add(quarter_turns.cos(), -t.sin() * quarter_turns.sin())
                / factorial
                / (j + 1) as f64;
            Ok(())
        });
        let options = Options::tolerance(1e-14)
            .method(&TAYLOR)
            .output(Output::End);
        let run = integrate(
            &mut system,
            (start, start + 10.0),
            &[0.0, 0.0],
            &mut [],
            options,
        )
        .unwrap();
        let exact = start.cos() - (start + 10.0).cos() - 10.0 * start.sin();
        assert!((run.state[0] - exact).abs() < 1e-12, "{start}");
        assert!(run.statistics.rejected < 5, "{start}");
    }
}
