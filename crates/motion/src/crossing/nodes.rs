//! Gauss's nodes with the weights of collocation, and interpolation through given places.

/// Collocation at Gauss's nodes (J. Kuntzmann, 1961; J. C. Butcher, Math. Comp. 18 (1964) 50): of order 2s, symmetric; for even s no node
/// lies in the middle.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    /// Places in (0, 1), ascending.
    pub(super) places: Vec<f64>,
    /// Weights of the whole interval.
    pub(super) weights: Vec<f64>,
    /// `a[j][l] = ∫_0^{c_j} ℓ_l`.
    pub(super) coefficients: Vec<Vec<f64>>,
}

impl Nodes {
    pub(super) fn gauss(s: usize) -> Nodes {
        let (mut places, mut weights) = (Vec::new(), Vec::new());
        for k in (0..s).rev() {
            let guess = libm::cos(std::f64::consts::PI * (k as f64 + 0.75) / (s as f64 + 0.5));
            let (x, slope) = root(s, guess);
            places.push(0.5 * (1.0 + x));
            weights.push(1.0 / ((1.0 - x * x) * slope * slope));
        }
        let integral = |end: f64, l: usize| -> f64 {
            let parts = places.iter().zip(&weights);
            parts
                .map(|(&c, &w)| end * w * lagrange(&places, end * c)[l])
                .sum()
        };
        let coefficients = places
            .iter()
            .map(|&c| (0..s).map(|l| integral(c, l)).collect())
            .collect();
        Nodes {
            places,
            weights,
            coefficients,
        }
    }
}

/// A zero of Legendre's polynomial of degree s near `x`, with the slope there.
fn root(s: usize, mut x: f64) -> (f64, f64) {
    let mut slope = 1.0;
    for _ in 0..100 {
        let (mut before, mut value) = (1.0, x);
        for k in 2..=s {
            let k = k as f64;
            (before, value) = (
                value,
                ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
            );
        }
        slope = s as f64 * (x * value - before) / (x * x - 1.0);
        let change = value / slope;
        x -= change;
        if change.abs() <= 2.0 * f64::EPSILON {
            break;
        }
    }
    (x, slope)
}

/// The values at x of Lagrange's polynomials of these places.
pub(super) fn lagrange(places: &[f64], x: f64) -> Vec<f64> {
    let one = |l: usize| {
        let others = places.iter().enumerate().filter(|&(m, _)| m != l);
        others
            .map(|(_, &c)| (x - c) / (places[l] - c))
            .product::<f64>()
    };
    (0..places.len()).map(one).collect()
}

/// The slopes at x of Lagrange's polynomials of these places.
pub(super) fn lagrange_slopes(places: &[f64], x: f64) -> Vec<f64> {
    let one = |l: usize| {
        let others = || (0..places.len()).filter(move |&m| m != l);
        let term = |k: usize| {
            let rest = others().filter(|&m| m != k);
            let product: f64 = rest
                .map(|m| (x - places[m]) / (places[l] - places[m]))
                .product();
            product / (places[l] - places[k])
        };
        others().map(term).sum::<f64>()
    };
    (0..places.len()).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly() {
        for s in [2, 6, 8] {
            let nodes = Nodes::gauss(s);
            for power in 0..2 * s {
                let power = power as i32;
                let parts = nodes.places.iter().zip(&nodes.weights);
                let sum: f64 = parts.map(|(c, w)| w * c.powi(power)).sum();
                assert!(
                    (sum - 1.0 / f64::from(power + 1)).abs() < 1e-15,
                    "{s} {power}"
                );
            }
            for (c, row) in nodes.places.iter().zip(&nodes.coefficients) {
                let sum: f64 = row
                    .iter()
                    .zip(&nodes.places)
                    .map(|(a, c)| a * c.powi(1))
                    .sum();
                assert!((sum - c * c / 2.0).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_cubic_is_interpolated_with_its_slope() {
        let places = [0.0, 0.3, 0.5, 1.0];
        let f = |x: f64| 1.0 - x + 2.0 * x.powi(3);
        let at =
            |weights: Vec<f64>| -> f64 { weights.iter().zip(places).map(|(w, c)| w * f(c)).sum() };
        assert!((at(lagrange(&places, 0.7)) - f(0.7)).abs() < 1e-14);
        let slope = -1.0 + 6.0 * 0.49;
        assert!((at(lagrange_slopes(&places, 0.7)) - slope).abs() < 1e-13);
    }
}
