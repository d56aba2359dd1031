//! Problems with closed forms, shared by the tests.
#![allow(clippy::unwrap_used)]

use chetaev_integrate::{from_fn, System};

/// Eccentricity of the Kepler ellipse.
pub(crate) const ECC: f64 = 0.6;

/// Plane Kepler problem x'' = −x/r³, state (x, y, x', y'); μ = 1, semi-major axis 1, from the pericenter.
pub(crate) fn kepler() -> (impl System, [f64; 4]) {
    let system = from_fn(4, |_t, y: &[f64], dy: &mut [f64]| {
        let r2 = y[0] * y[0] + y[1] * y[1];
        let r3 = r2 * r2.sqrt();
        dy[0] = y[2];
        dy[1] = y[3];
        dy[2] = -y[0] / r3;
        dy[3] = -y[1] / r3;
    });
    (
        system,
        [1.0 - ECC, 0.0, 0.0, ((1.0 + ECC) / (1.0 - ECC)).sqrt()],
    )
}

/// The exact state at time t by Kepler's equation E − e sin E = t (Goldstein, Poole, Safko 2002, ch. 3).
pub(crate) fn kepler_exact(t: f64) -> [f64; 4] {
    let mut anomaly = t;
    for _ in 0..60 {
        anomaly -= (anomaly - ECC * anomaly.sin() - t) / (1.0 - ECC * anomaly.cos());
    }
    let (s, c) = anomaly.sin_cos();
    let b = (1.0 - ECC * ECC).sqrt();
    let rate = 1.0 / (1.0 - ECC * c);
    [c - ECC, b * s, -s * rate, b * c * rate]
}

/// The nonholonomic particle z' = y x', reduced: x'' = −y x' y'/(1+y²), y'' = 0, with x'(0) = y'(0) = 1 from the
/// origin: y = t, x = asinh t, z = √(1+t²) − 1 (Rosenberg 1977; Pars 1965). State (x, y, z, x', y').
pub(crate) fn particle() -> (impl System, [f64; 5]) {
    let system = from_fn(5, |_t, y: &[f64], dy: &mut [f64]| {
        dy[0] = y[3];
        dy[1] = y[4];
        dy[2] = y[1] * y[3];
        dy[3] = -y[1] * y[3] * y[4] / (1.0 + y[1] * y[1]);
        dy[4] = 0.0;
    });
    (system, [0.0, 0.0, 0.0, 1.0, 1.0])
}

/// The exact state at time t.
pub(crate) fn particle_exact(t: f64) -> [f64; 5] {
    let root = (1.0 + t * t).sqrt();
    [t.asinh(), t, root - 1.0, 1.0 / root, 1.0]
}

/// Largest difference of two states.
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}
