//! Random smooth functions of the time.

use chetaev_mechanics::sample::Generator;
use std::f64::consts::PI;

/// Harmonics of a random function.
const HARMONICS: usize = 3;
/// The function and its first derivatives vanish at the ends to this order.
const ORDER: i32 = 6;

/// `w(s) Σ (a cos kπs + b sin kπs)`, s from 0 to 1 over the interval, with `w = sin⁶ πs` where it vanishes at the ends, else 1.
#[derive(Clone, Debug)]
pub(super) struct Wave {
    coefficients: Vec<(f64, f64)>,
    vanishes: bool,
}

impl Wave {
    /// A function that vanishes at the ends.
    pub(super) fn vanishing(generator: &mut Generator) -> Wave {
        Wave::new(generator, true)
    }

    /// A function that does not.
    pub(super) fn free(generator: &mut Generator) -> Wave {
        Wave::new(generator, false)
    }

    fn new(generator: &mut Generator, vanishes: bool) -> Wave {
        let mut next = || generator.between(-1.0, 1.0);
        Wave {
            coefficients: (0..HARMONICS).map(|_| (next(), next())).collect(),
            vanishes,
        }
    }

    /// Value and derivative by the time at the share s of an interval of this length.
    pub(super) fn at(&self, s: f64, length: f64) -> (f64, f64) {
        let (mut value, mut slope) = (0.0, 0.0);
        for (k, &(a, b)) in self.coefficients.iter().enumerate() {
            let rate = (k + 1) as f64 * PI;
            let (sin, cos) = (rate * s).sin_cos();
            value += a * cos + b * sin;
            slope += rate * (b * cos - a * sin);
        }
        if self.vanishes {
            let (sin, cos) = (PI * s).sin_cos();
            let window = sin.powi(ORDER);
            let moved = f64::from(ORDER) * PI * cos * sin.powi(ORDER - 1);
            slope = window * slope + moved * value;
            value *= window;
        }
        (value, slope / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_derivatives_and_ends_vanish() {
        let mut generator = Generator::new(5);
        for wave in [Wave::vanishing(&mut generator), Wave::free(&mut generator)] {
            let (h, length) = (1e-6, 2.5);
            for j in 1..10 {
                let s = f64::from(j) / 10.0;
                let difference = (wave.at(s + h, length).0 - wave.at(s - h, length).0) / (2.0 * h);
                assert!((difference / length - wave.at(s, length).1).abs() < 1e-7);
            }
            assert_eq!(wave.vanishes, wave.at(0.0, length).0 == 0.0);
        }
    }
}
