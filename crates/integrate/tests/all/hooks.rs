//! The hooks of a mechanical system: projection, change of chart, rejection of a stage, halt.

#![allow(clippy::unwrap_used)]

use crate::common::distance;
use chetaev_integrate::{
    integrate, ChartChange, Control, EvaluationFailure, Event, HaltReason, Options, Output, Stop,
    System,
};

/// The unit circle q(s), parametrized by arc length, in two charts: the state is (coordinate, chart speed) with
/// coordinate x (chart 0) or y (chart 1) of a point that runs with angular velocity 1.
///
/// In chart 0: x' = −y, y = ±√(1−x²), singular at x = ±1; in chart 1: y' = x, x = ±√(1−y²). The pivot is the
/// eliminated coordinate, as the skate's cos φ or sin φ is.
struct Circle {
    chart: u32,
    /// Sign of the eliminated coordinate.
    sign: f64,
    /// Pivot when the chart was chosen.
    chosen: f64,
    /// Whether the chart may be changed after an accepted step, or only when a stage fails.
    at_step_ends: bool,
    /// Chart of every evaluation since the last accepted step.
    charts_in_step: Vec<u32>,
    /// Places where the system was asked for another chart.
    asked: Vec<f64>,
}

impl Circle {
    fn new(at_step_ends: bool) -> Circle {
        Circle {
            chart: 0,
            sign: 1.0,
            chosen: 1.0,
            at_step_ends,
            charts_in_step: Vec::new(),
            asked: Vec::new(),
        }
    }

    fn eliminated(&self, coordinate: f64) -> f64 {
        self.sign * (1.0 - coordinate * coordinate).max(0.0).sqrt()
    }

    /// (x, y) of the state.
    fn point(&self, state: &[f64]) -> (f64, f64) {
        let other = self.eliminated(state[0]);
        match self.chart {
            0 => (state[0], other),
            _ => (other, state[0]),
        }
    }

    fn switch(&mut self, y: &mut [f64]) -> Control {
        let old = y[0];
        let new = self.eliminated(old);
        let change = ChartChange {
            from: self.chart,
            to: 1 - self.chart,
            pivot_before: new.abs(),
            pivot_after: old.abs(),
        };
        if change.pivot_after < 3.0 * change.pivot_before {
            return Control::Continue;
        }
        (self.chart, self.sign, self.chosen) = (change.to, old.signum(), old.abs());
        y[0] = new;
        Control::ChartSwitched(change)
    }
}

impl System for Circle {
    fn dimension(&self) -> usize {
        1
    }

    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.charts_in_step.push(self.chart);
        let pivot = self.eliminated(y[0]);
        let ratio = pivot.abs() / self.chosen;
        if ratio < 1e-3 {
            return Err(EvaluationFailure::PivotDegraded { ratio });
        }
        dy[0] = if self.chart == 0 { -pivot } else { pivot };
        Ok(())
    }

    fn accepted(&mut self, _t: f64, y: &mut [f64]) -> Control {
        assert!(
            self.charts_in_step.windows(2).all(|w| w[0] == w[1]),
            "chart changed inside a step"
        );
        self.charts_in_step.clear();
        if self.at_step_ends && self.eliminated(y[0]).abs() < 0.1 * self.chosen {
            return self.switch(y);
        }
        Control::Continue
    }

    fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
        self.asked.push(t);
        self.charts_in_step.clear();
        self.switch(y)
    }

    fn output_dimension(&self) -> usize {
        2
    }

    fn output(&mut self, _t: f64, y: &[f64], row: &mut [f64]) -> Result<(), EvaluationFailure> {
        (row[0], row[1]) = self.point(y);
        Ok(())
    }
}

#[test]
fn charts_are_changed_between_steps() {
    for at_step_ends in [true, false] {
        let mut circle = Circle::new(at_step_ends);
        let options = Options::tolerance(1e-10).output(Output::Every(0.05));
        // x = cos t, y = sin t from t = π/2, in the chart of x, upper branch.
        let t0 = std::f64::consts::FRAC_PI_2;
        let run = integrate(&mut circle, (t0, t0 + 20.0), &[0.0], &mut [], options).unwrap();
        assert_eq!(run.stop, Stop::Finished);
        assert_eq!(run.width, 2);
        for (j, t) in run.times.iter().enumerate() {
            let error = distance(run.row(j), &[t.cos(), t.sin()]);
            assert!(error < 1e-7, "{error:e} at {t}");
        }
        // 20 radians contain thirteen quarter turns: one change for each, no chatter.
        let changes = run.chart_changes.len();
        assert!((10..=14).contains(&changes), "{changes}");
        assert_eq!(run.statistics.chart_switches, changes as u64);
        assert!(run
            .chart_changes
            .windows(2)
            .all(|w| w[0].0 < w[1].0 && w[0].1.to == w[1].1.from));
        if !at_step_ends {
            assert!(run.statistics.failed >= changes as u64);
            assert!(circle.asked.len() >= changes);
        }
    }
}

#[test]
fn without_another_chart_the_run_ends_at_the_singularity() {
    struct Stubborn(Circle);
    impl System for Stubborn {
        fn dimension(&self) -> usize {
            1
        }
        fn derivative(
            &mut self,
            t: f64,
            y: &[f64],
            dy: &mut [f64],
        ) -> Result<(), EvaluationFailure> {
            self.0.derivative(t, y, dy)
        }
    }
    let mut system = Stubborn(Circle::new(false));
    let run = integrate(
        &mut system,
        (0.0, 20.0),
        &[0.0],
        &mut [],
        Options::tolerance(1e-10),
    )
    .unwrap();
    match run.stop {
        Stop::Singular {
            t,
            failure: EvaluationFailure::PivotDegraded { .. },
        } => {
            // The pivot cos(t) falls to 1/1000 of its first value shortly before a quarter turn.
            assert!(
                (t - (std::f64::consts::FRAC_PI_2 - 1e-3)).abs() < 1e-8,
                "{t}"
            );
        }
        other => panic!("{other:?}"),
    }
    assert!(run.len() > 5);
}

/// Rotation of (x, y) with a slow drift off the circle that a projection removes; counts what it sees.
struct Drifting {
    project: bool,
    evaluations: u64,
    halt_at: f64,
}

impl System for Drifting {
    fn dimension(&self) -> usize {
        2
    }

    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) -> Result<(), EvaluationFailure> {
        self.evaluations += 1;
        // 10⁻³ is a model error that only the projection keeps away from the circle.
        (dy[0], dy[1]) = (-y[1] + 1e-3 * y[0], y[0] + 1e-3 * y[1]);
        Ok(())
    }

    fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
        if t >= self.halt_at {
            return Control::Stop(HaltReason::RankDrop {
                from: 2,
                to: 1,
                constraint: 5,
            });
        }
        if !self.project {
            return Control::Continue;
        }
        let r = y[0].hypot(y[1]);
        (y[0], y[1]) = (y[0] / r, y[1] / r);
        Control::StateModified
    }

    fn factorizations(&self) -> u64 {
        self.evaluations
    }
}

#[test]
fn projections_take_effect_at_step_ends_and_in_the_output() {
    let mut system = Drifting {
        project: true,
        evaluations: 0,
        halt_at: f64::INFINITY,
    };
    let run = integrate(
        &mut system,
        (0.0, 10.0),
        &[1.0, 0.0],
        &mut [],
        Options::tolerance(1e-9),
    )
    .unwrap();
    assert_eq!(run.stop, Stop::Finished);
    assert_eq!(run.statistics.modifications, run.statistics.steps);
    assert_eq!(run.statistics.evaluations, system.evaluations);
    assert_eq!(run.statistics.factorizations, system.evaluations);
    for j in 0..run.len() {
        assert!((run.row(j)[0].hypot(run.row(j)[1]) - 1.0).abs() < 4.0 * f64::EPSILON);
    }
    // The angle is not touched by the drift or its projection.
    assert!(distance(&run.state, &[10f64.cos(), 10f64.sin()]) < 1e-8);
    let mut system = Drifting {
        project: false,
        evaluations: 0,
        halt_at: f64::INFINITY,
    };
    let run = integrate(
        &mut system,
        (0.0, 10.0),
        &[1.0, 0.0],
        &mut [],
        Options::tolerance(1e-9),
    )
    .unwrap();
    assert!((run.state[0].hypot(run.state[1]) - 0.01f64.exp()).abs() < 1e-8);
}

#[test]
fn a_hook_can_end_the_run() {
    let mut system = Drifting {
        project: false,
        evaluations: 0,
        halt_at: 3.0,
    };
    let run = integrate(
        &mut system,
        (0.0, 10.0),
        &[1.0, 0.0],
        &mut [],
        Options::tolerance(1e-9),
    )
    .unwrap();
    let reason = HaltReason::RankDrop {
        from: 2,
        to: 1,
        constraint: 5,
    };
    assert_eq!(run.stop, Stop::Halted { t: run.t, reason });
    assert!(run.t >= 3.0 && run.t < 10.0);
    assert_eq!(run.times.last(), Some(&run.t));
}

#[test]
fn events_see_the_chart_of_their_step() {
    struct Seen(Circle);
    impl System for Seen {
        fn dimension(&self) -> usize {
            1
        }
        fn derivative(
            &mut self,
            t: f64,
            y: &[f64],
            dy: &mut [f64],
        ) -> Result<(), EvaluationFailure> {
            self.0.derivative(t, y, dy)
        }
        fn accepted(&mut self, t: f64, y: &mut [f64]) -> Control {
            self.0.accepted(t, y)
        }
        fn repivot(&mut self, t: f64, y: &mut [f64]) -> Control {
            self.0.repivot(t, y)
        }
        fn switching(
            &mut self,
            _index: usize,
            _t: f64,
            y: &[f64],
        ) -> Result<f64, EvaluationFailure> {
            let (x, y) = self.0.point(y);
            Ok(x - y)
        }
    }
    let t0 = std::f64::consts::FRAC_PI_2;
    let mut events = [Event::of_system(0)];
    let options = Options::tolerance(1e-11).output(Output::End);
    let run = integrate(
        &mut Seen(Circle::new(true)),
        (t0, t0 + 20.0),
        &[0.0],
        &mut events,
        options,
    )
    .unwrap();
    assert_eq!(run.stop, Stop::Finished);
    // cos t = sin t at t = π/4 + jπ.
    assert_eq!(run.events.len(), 6);
    for (j, event) in run.events.iter().enumerate() {
        let expected = std::f64::consts::PI * (j as f64 + 1.25);
        assert!(
            (event.t - expected).abs() < 1e-8,
            "{} for {expected}",
            event.t
        );
    }
}

#[test]
fn runs_are_reproducible_bit_by_bit() {
    let once = || {
        let options = Options::tolerance(1e-10).output(Output::Every(0.1));
        integrate(
            &mut Circle::new(true),
            (1.6, 15.0),
            &[-0.02],
            &mut [],
            options,
        )
        .unwrap()
    };
    assert_eq!(once(), once());
}

#[test]
fn a_system_that_keeps_changing_its_chart_in_vain_is_stopped() {
    struct Indecisive(u32);
    impl System for Indecisive {
        fn dimension(&self) -> usize {
            1
        }
        fn derivative(
            &mut self,
            t: f64,
            _y: &[f64],
            dy: &mut [f64],
        ) -> Result<(), EvaluationFailure> {
            dy[0] = 1.0;
            if t > 0.5 {
                return Err(EvaluationFailure::PivotDegraded { ratio: 1e-5 });
            }
            Ok(())
        }
        fn repivot(&mut self, _t: f64, _y: &mut [f64]) -> Control {
            self.0 += 1;
            Control::ChartSwitched(ChartChange {
                from: self.0 - 1,
                to: self.0,
                pivot_before: 1e-5,
                pivot_after: 1e-5,
            })
        }
    }
    let run = integrate(
        &mut Indecisive(0),
        (0.0, 1.0),
        &[0.0],
        &mut [],
        Options::tolerance(1e-9),
    )
    .unwrap();
    assert!(matches!(run.stop, Stop::Singular { .. }));
    assert!((run.t - 0.5).abs() < 1e-12);
    // At most one question for each starting point.
    assert!(run.statistics.chart_switches <= run.statistics.steps + 1);
}
