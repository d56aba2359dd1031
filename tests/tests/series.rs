//! Taylor coefficients of the motions of the gallery: machine code and interpreter agree.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "test code fails where it stands"
)]

use chetaev::compile::Taylor;
use chetaev::mechanics::{Prepared, System};
use chetaev::motion::{chart, Binding, NumericSystem};
use chetaev_tests::studied::{gallery_path, loaded, model_files};

/// The highest order compared.
const ORDER: usize = 24;
/// What may differ of a coefficient of order j, in units in the last place of the largest that a series of the radius found can
/// have there, times j. Measured: at most 22, for the rattleback; 7 for the others.
const ULPS: f64 = 64.0;

/// Coefficients of (q, v) by machine code and by the interpreter, at a state without any symmetry.
fn expansions(file: &str) -> Option<[Vec<f64>; 2]> {
    let (model, _) = loaded(&gallery_path(file), &[]).into_result().ok()?;
    let system = System::from_model(&model).ok()?;
    let prepared = Prepared::new(&system).ok()?;
    if prepared.terms.order > 1 {
        return None;
    }
    let binding = Binding::new(&system).ok()?;
    let mut numeric = NumericSystem::new(&system, &prepared.terms, &binding).ok()?;
    let spread = |i: usize, least: f64| least + 0.37 * ((i + 1) as f64).sin().abs();
    let q: Vec<f64> = (0..numeric.positions()).map(|i| spread(i, 0.4)).collect();
    let v: Vec<f64> = (0..numeric.n).map(|i| spread(i, 0.5)).collect();
    numeric.evaluate(0.3, &q, &v).ok()?;
    let chart = chart::choose(
        numeric.jacobian(),
        numeric.r,
        numeric.n,
        &numeric.mass_diagonal(),
    );
    let program = numeric.rates_program(&chart.rows).unwrap();
    let parameters: Vec<f64> = binding.parameters.iter().map(|own| own.1).collect();
    let state = [&[0.3][..], &q, &v].concat();
    let expand = |taylor: Taylor| {
        let mut workspace = taylor.workspace(ORDER);
        let mut coefficients = vec![0.0; (ORDER + 1) * (state.len() - 1)];
        taylor.prepare(&parameters, &mut workspace).unwrap();
        let outcome = taylor.expand(&state, ORDER, &mut workspace, &mut coefficients);
        outcome.map(|()| coefficients)
    };
    let native = Taylor::new(&program).unwrap();
    native.code_size()?;
    let found = [
        expand(native),
        expand(Taylor::interpreter(&program).unwrap()),
    ];
    match found {
        [Ok(native), Ok(interpreted)] => Some([native, interpreted]),
        [a, b] => {
            assert_eq!(a.is_err(), b.is_err(), "{file}: {a:?} {b:?}");
            None
        }
    }
}

/// The largest difference over all orders, each over the largest coefficient that a series of this radius can have there.
fn difference([native, interpreted]: &[Vec<f64>; 2]) -> f64 {
    let m = native.len() / (ORDER + 1);
    let largest = |j: usize| {
        let row = &interpreted[j * m..(j + 1) * m];
        row.iter()
            .fold(1e-300, |largest: f64, c| largest.max(c.abs()))
    };
    // The growth of the coefficients from one order to the next.
    let growth = (1..=ORDER).map(|j| (largest(j) / largest(0).max(1.0)).powf(1.0 / j as f64));
    let growth = growth.fold(0.0, f64::max);
    let mut worst: f64 = 0.0;
    for j in 1..=ORDER {
        let scale = largest(0).max(1.0) * growth.powi(j as i32) * j as f64;
        for k in 0..m {
            let gap = (native[j * m + k] - interpreted[j * m + k]).abs();
            worst = worst.max(gap / scale);
        }
    }
    worst / f64::EPSILON
}

#[test]
#[cfg(all(unix, target_arch = "x86_64"))]
fn back_ends_agree_on_the_series_of_every_model() {
    if !is_x86_feature_detected!("avx2") || !is_x86_feature_detected!("fma") {
        return;
    }
    let mut compared = 0;
    for file in model_files() {
        let Some(found) = expansions(&file) else {
            continue;
        };
        compared += 1;
        let ulps = difference(&found);
        assert!(ulps <= ULPS, "{file}: {ulps} units in the last place");
    }
    assert!(compared >= 20, "{compared} models compared");
}
