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
/// By how much more the back ends may differ than the interpreter differs from itself where every number of the state is
/// changed by its own rounding: a sum of many rounded products stands against one rounded number each. Measured: at most 2.1,
/// for the rattleback, whose coefficients are the least well conditioned.
const TIMES: f64 = 8.0;

/// Coefficients of (q, v) at a state without any symmetry: by machine code, by the interpreter, and by the interpreter where
/// every number of the state is changed by its rounding, up or down.
fn expansions(file: &str) -> Option<[Vec<f64>; 3]> {
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
    let changed: Vec<f64> = state
        .iter()
        .zip([1.0, -1.0, -1.0].iter().cycle())
        .map(|(x, sign)| x * (1.0 + sign * f64::EPSILON))
        .collect();
    let expand = |taylor: &Taylor, state: &[f64]| {
        let mut workspace = taylor.workspace(ORDER);
        let mut coefficients = vec![0.0; (ORDER + 1) * (state.len() - 1)];
        taylor.prepare(&parameters, &mut workspace).unwrap();
        let outcome = taylor.expand(state, ORDER, &mut workspace, &mut coefficients);
        outcome.map(|()| coefficients)
    };
    let native = Taylor::new(&program).unwrap();
    native.code_size()?;
    let interpreter = Taylor::interpreter(&program).unwrap();
    let found = [
        expand(&native, &state),
        expand(&interpreter, &state),
        expand(&interpreter, &changed),
    ];
    match found {
        [Ok(native), Ok(interpreted), Ok(changed)] => Some([native, interpreted, changed]),
        [a, b, _] => {
            assert_eq!(a.is_err(), b.is_err(), "{file}: {a:?} {b:?}");
            None
        }
    }
}

/// The largest difference over all orders, each over the largest coefficient that a series of this radius can have there.
fn difference(other: &[f64], interpreted: &[f64]) -> f64 {
    let m = interpreted.len() / (ORDER + 1);
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
            let gap = (other[j * m + k] - interpreted[j * m + k]).abs();
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
        let Some([native, interpreted, changed]) = expansions(&file) else {
            continue;
        };
        compared += 1;
        let between = difference(&native, &interpreted);
        let by_rounding = difference(&changed, &interpreted).max(1.0);
        assert!(
            between <= TIMES * by_rounding,
            "{file}: {between} units in the last place, {by_rounding} by a rounding of the state"
        );
    }
    assert!(compared >= 20, "{compared} models compared");
}
