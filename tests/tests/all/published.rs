//! The published cases through the public interface, by one adapter: Routh's and Maggi's equations, closed forms, values,
//! invariants, identities, events, stops and claims, with the tolerances of the file.

use chetaev_tests::cases::Published;
use chetaev_tests::checks::failures;
use chetaev_tests::rejections;
use chetaev_tests::words::in_parallel;

/// Cases and checks that this version does not cover: exactly these, by name, so that nothing is left out silently.
/// The reasons are those of `cases::NOT_COVERED`.
const LEFT_OUT: &[&str] = &[
    "double-pendulum: hanging equilibrium: frequencies sqrt((g/l)(2 -+ sqrt 2))",
    "sleeping-top: spin 6, above the critical one: stable",
    "sleeping-top: spin 3, below it: unstable",
    "sleeping-top: critical spin sqrt(4 A m g l)/C",
    "bead-on-rotating-hoop: critical rate sqrt(g/R) at which the lowest position loses stability",
    "bead-on-rotating-hoop: small oscillations about it: frequency W sin(theta_eq)",
    "nonholonomic-particle: invariant measure of the reduced flow in (y, x', y'): density sqrt(1+y^2), divergence zero",
    "rolling-disk-steady: upright straight rolling is stable above sqrt(A m g r/(Cc (Cc+m r^2))); thin disk: sqrt(g/(3 r))",
    "rolling-disk-steady: upright spinning about the vertical is stable above sqrt(m g r/(A+m r^2)); thin disk: sqrt(4 g/(5 r))",
    "rattleback-kane-levinson: vertical spin w3 = 5: tilt motion (stable only if all real parts are negative)",
    "rattleback-kane-levinson: vertical spin w3 = -5: tilt motion (stable only if all real parts are negative)",
    "chaplygin-ball: invariant measure of the reduced flow in (theta, psi, theta', phi', psi'): density sin(theta)^2 sqrt(1 - D gamma.(I+D)^-1 gamma), D = m r^2 (Chaplygin's density times the Jacobian of the Euler angles); divergence zero",
    "whipple-bicycle-linear: mass matrix M of (lean rate, steer rate)",
    "whipple-bicycle-linear: damping matrix at 1 m/s: C1",
    "whipple-bicycle-linear: stiffness matrix at rest: g K0",
    "whipple-bicycle-linear: stiffness matrix at 1 m/s: g K0 + K2",
    "whipple-bicycle-linear: eigenvalues at 0 m/s",
    "whipple-bicycle-linear: eigenvalues at 1 m/s",
    "whipple-bicycle-linear: eigenvalues at 2 m/s",
    "whipple-bicycle-linear: eigenvalues at 3 m/s",
    "whipple-bicycle-linear: eigenvalues at 4 m/s",
    "whipple-bicycle-linear: eigenvalues at 5 m/s",
    "whipple-bicycle-linear: eigenvalues at 6 m/s",
    "whipple-bicycle-linear: eigenvalues at 7 m/s",
    "whipple-bicycle-linear: eigenvalues at 8 m/s",
    "whipple-bicycle-linear: eigenvalues at 9 m/s",
    "whipple-bicycle-linear: eigenvalues at 10 m/s",
    "whipple-bicycle-linear: weave speed (complex pair crosses zero), m/s",
    "whipple-bicycle-linear: capsize speed, m/s",
];

#[test]
fn every_covered_case_is_as_published() {
    let published = Published::read();
    let only = std::env::var("CASE").unwrap_or_default();
    let cases = published.with_particles();
    let covered: Vec<_> = cases
        .iter()
        .filter(|case| case.not_covered().is_none() && case.statement.id.contains(&only))
        .collect();
    let failures: Vec<String> = in_parallel(&covered, |case| {
        let began = std::time::Instant::now();
        let failures = failures(case);
        println!(
            "{:8.2} s  {}",
            began.elapsed().as_secs_f64(),
            case.statement.id
        );
        failures
    })
    .into_iter()
    .flatten()
    .map(|f| format!("{}\n    {}", f.check, f.found))
    .collect();
    assert!(
        failures.is_empty(),
        "{} failures\n{}",
        failures.len(),
        failures.join("\n")
    );
}

#[test]
fn what_is_left_out_is_listed_by_name() {
    let published = Published::read();
    let mut left_out = Vec::new();
    for case in &published.cases {
        let id = &case.statement.id;
        if let Some(why) = case.not_covered() {
            left_out.push(format!("{id}: {why}"));
            continue;
        }
        for check in case
            .checks
            .iter()
            .filter(|check| check.not_covered().is_some())
        {
            left_out.push(format!("{id}: {}", check.title));
        }
    }
    assert_eq!(left_out, LEFT_OUT);
}

#[test]
fn every_rejection_is_as_published() {
    let published = Published::read();
    let failures: Vec<String> = in_parallel(&published.rejections, |rejection| {
        let found = rejections::check(rejection);
        found
            .err()
            .map(|found| format!("{}: {found}", rejection.statement.id))
    })
    .into_iter()
    .flatten()
    .collect();
    assert!(
        failures.is_empty(),
        "{} failures\n{}",
        failures.len(),
        failures.join("\n")
    );
}
