//! First integrals kept by projection: where it works, where it cannot, and what it costs in accuracy.

#![allow(clippy::unwrap_used, reason = "test code fails where it stands")]

use crate::common::with_subject;
use chetaev_mechanics::{System, SystemParts};
use chetaev_motion::keep::KeptReport;
use chetaev_motion::{Run, RunSettings, Watcher};
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Function, Graph};
use std::sync::Arc;

/// (x, y, x', y').
type Plane = [Expr; 4];

/// A particle of unit mass in the field of r²/2, from (1, 0) with the velocity (0, 1): it goes round the unit circle.
fn circle(
    quantities: impl Fn(&Graph, &Plane, Expr) -> Vec<Expr>,
    change: impl Fn(&mut RunSettings),
) -> Run {
    let g = Arc::new(Graph::new());
    let half = g.number(ratio(1, 2).unwrap());
    let plane = [("x", 0), ("y", 0), ("x", 1), ("y", 1)].map(|(name, order)| g.symbol(name, order));
    let [x, y, vx, vy] = plane;
    let squares = |a: Expr, b: Expr| g.mul(&[half, g.add(&[g.powi(a, 2), g.powi(b, 2)])]);
    let (kinetic, potential) = (squares(vx, vy), squares(x, y));
    let parts = SystemParts {
        coordinates: ["x", "y"].map(String::from).to_vec(),
        lagrangian: Some(g.sub(kinetic, potential)),
        ..SystemParts::default()
    };
    let keep = quantities(&g, &plane, g.add(&[kinetic, potential]));
    let system = System::new(g.clone(), parts).unwrap();
    let mut settings = RunSettings::new(0.0, 10.0);
    settings.keep = keep;
    change(&mut settings);
    with_subject(&system, (&[1.0, 0.0], &[0.0, 1.0]), |subject| {
        subject.routh(&settings, &mut Watcher::default()).unwrap()
    })
}

fn report(run: &Run) -> &KeptReport {
    run.kept.as_ref().unwrap()
}

/// The angle atan2(y, x) - t is an integral but at its cut: there it is left out, and the energy is kept all the same.
#[test]
fn an_integral_with_a_cut_is_left_out_behind_it() {
    let angle = |g: &Graph, plane: &Plane, energy: Expr| {
        let angle = g.apply(Function::Atan2, &[plane[1], plane[0]]);
        vec![energy, g.sub(angle, g.symbol("t", 0))]
    };
    let run = circle(angle, |settings| settings.tolerance = 1e-6);
    let report = report(&run);
    let cut = report.left_out[1].first.unwrap();
    assert!((std::f64::consts::PI..3.9).contains(&cut), "{report:?}");
    assert_eq!(report.left_out[0].count, 0);
    assert_eq!(report.failed.count, 0);
    for j in 0..run.len() {
        let row = run.row(j);
        let energy: f64 = row[..4].iter().map(|x| x * x / 2.0).sum();
        assert!((energy - 1.0).abs() < 1e-14, "{energy} in row {j}");
        // On the angle the state is only brought back before the cut.
        if run.times[j] < 3.0 {
            let angle = row[1].atan2(row[0]) - run.times[j];
            assert!(angle.abs() < 1e-14, "{angle} in row {j}");
        }
    }
}

/// Once a particle has left its x nothing near has that any more: the report says so for every later step and row.
#[test]
fn what_cannot_be_kept_is_counted_from_the_first_time() {
    let kept = circle(|_, plane, _| vec![plane[0]], |_| ());
    let free = circle(|_, _, _| Vec::new(), |_| ());
    let report = report(&kept);
    assert!(report.failed.count > report.steps / 2, "{report:?}");
    assert!(report.failed.first.unwrap() < 1.0 && report.between.count > 400);
    assert!(free.kept.is_none());
}

/// Twice the same integral is one.
#[test]
fn dependent_integrals_ask_for_nothing() {
    let twice = |g: &Graph, _: &Plane, energy: Expr| vec![energy, g.powi(energy, 2)];
    let run = circle(twice, |settings| settings.tolerance = 1e-6);
    let report = report(&run);
    assert_eq!(report.failed.count + report.between.count, 0, "{report:?}");
    assert!(report.left_out.iter().all(|missed| missed.count == 0));
}

/// The classical method keeps its order four.
#[test]
fn projection_keeps_the_order() {
    let momentum = |g: &Graph, plane: &Plane, energy: Expr| {
        let [x, y, vx, vy] = *plane;
        vec![energy, g.sub(g.mul(&[x, vy]), g.mul(&[y, vx]))]
    };
    let error = |h: f64| {
        let run = circle(momentum, |settings| {
            settings.method = "runge-kutta-4".into();
            settings.step = Some(h);
            settings.times = vec![10.0];
        });
        assert_eq!(report(&run).failed.count, 0);
        let (x, y) = (run.row(0)[0], run.row(0)[1]);
        (x - 10f64.cos()).hypot(y - 10f64.sin())
    };
    let order = (error(0.1) / error(0.05)).log2();
    assert!((3.7..4.5).contains(&order), "{order}");
}

/// A mass with a law of its own stands among the coordinates and goes its own way: only coordinates and velocities are moved, and so
/// the energy of the pendulum that it makes is kept, with the mass as a factor that changes.
#[test]
fn masses_with_a_law_of_their_own_are_not_moved() {
    let g = Arc::new(Graph::new());
    let [x, v, m] = [("x", 0), ("x", 1), ("m", 0)].map(|(name, order)| g.symbol(name, order));
    let half = g.number(ratio(1, 2).unwrap());
    let energy = g.mul(&[half, g.add(&[g.powi(v, 2), g.powi(x, 2)])]);
    let parts = SystemParts {
        coordinates: vec!["x".into()],
        lagrangian: Some(g.mul(&[half, m, g.sub(g.powi(v, 2), g.powi(x, 2))])),
        // What leaves has the velocity of its body.
        reactive_forces: vec![("x".into(), g.mul(&[g.number(ratio(-1, 5).unwrap()), m, v]))],
        masses: vec![("m".into(), g.mul(&[g.number(ratio(-1, 5).unwrap()), m]))],
        ..SystemParts::default()
    };
    let system = System::new(g.clone(), parts).unwrap();
    let mut settings = RunSettings::new(0.0, 10.0);
    settings.tolerance = 1e-6;
    settings.keep = vec![energy];
    let run = with_subject(&system, (&[1.0, 2.0], &[0.0]), |subject| {
        subject.routh(&settings, &mut Watcher::default()).unwrap()
    });
    let report = report(&run);
    assert_eq!(
        report.failed.count + report.left_out[0].count,
        0,
        "{report:?}"
    );
    assert!(report.moved > report.steps / 2, "{report:?}");
    let largest = report.largest.value;
    assert!((1e-12..1e-5).contains(&largest), "{report:?}");
    for (j, &t) in run.times.iter().enumerate() {
        let [x, m, v] = [0, 1, 2].map(|i| run.row(j)[i]);
        assert!(((x * x + v * v) / 2.0 - 0.5).abs() < 1e-15, "t = {t}");
        // 2 e^(-t/5) to the tolerance of the run, not to that of the projection.
        assert!((m - 2.0 * (-t / 5.0).exp()).abs() < 1e-5, "{m} at t = {t}");
    }
}
