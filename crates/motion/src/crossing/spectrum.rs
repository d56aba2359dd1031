//! Eigenvalues and eigenvectors of small symmetric matrices by Jacobi's rotations (C. G. J. Jacobi, J. reine angew. Math. 30
//! (1846) 51): small eigenvalues come out with the accuracy of the entries, which elimination does not promise.

/// Eigenvalues in ascending order with their unit eigenvectors.
#[derive(Clone, Debug, Default)]
pub(super) struct Spectrum {
    pub(super) values: Vec<f64>,
    pub(super) vectors: Vec<Vec<f64>>,
}

/// Sweeps at most; each squares what is left beside the diagonal.
const SWEEPS: usize = 40;

impl Spectrum {
    /// Of a symmetric n × n matrix, row by row.
    pub(super) fn of(mut a: Vec<f64>, n: usize) -> Spectrum {
        let mut v = vec![0.0; n * n];
        (0..n).for_each(|i| v[i * n + i] = 1.0);
        // What is smaller does not show in the values.
        let floor = 1e-19 * (0..n).map(|i| a[i * n + i].abs()).sum::<f64>();
        for _ in 0..SWEEPS {
            let mut rotated = false;
            for p in 0..n {
                for q in p + 1..n {
                    rotated |= rotate(&mut a, &mut v, n, (p, q, floor));
                }
            }
            if !rotated {
                break;
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| a[i * n + i].total_cmp(&a[j * n + j]));
        Spectrum {
            values: order.iter().map(|&i| a[i * n + i]).collect(),
            vectors: order
                .iter()
                .map(|&i| (0..n).map(|k| v[k * n + i]).collect())
                .collect(),
        }
    }
}

/// Turns the coordinates p and q so that the entry between them vanishes; false where it is zero to rounding.
fn rotate(a: &mut [f64], v: &mut [f64], n: usize, (p, q, floor): (usize, usize, f64)) -> bool {
    let (app, aqq, apq) = (a[p * n + p], a[q * n + q], a[p * n + q]);
    if apq.is_nan() || apq.abs() <= floor {
        return false;
    }
    let theta = (aqq - app) / (2.0 * apq);
    let t = theta.signum() / (theta.abs() + libm::hypot(theta, 1.0));
    let t = if theta == 0.0 { 1.0 } else { t };
    let c = 1.0 / libm::hypot(t, 1.0);
    let s = t * c;
    for k in 0..n {
        let (x, y) = (a[k * n + p], a[k * n + q]);
        (a[k * n + p], a[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
    for k in 0..n {
        let (x, y) = (a[p * n + k], a[q * n + k]);
        (a[p * n + k], a[q * n + k]) = (c * x - s * y, s * x + c * y);
        let (x, y) = (v[k * n + p], v[k * n + q]);
        (v[k * n + p], v[k * n + q]) = (c * x - s * y, s * x + c * y);
    }
    (a[p * n + q], a[q * n + p]) = (0.0, 0.0);
    true
}

/// `A Aᵀ` of a matrix with rows of length n.
pub(super) fn gram(rows: &[f64], n: usize) -> Vec<f64> {
    let rows: Vec<&[f64]> = rows.chunks(n.max(1)).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    rows.iter()
        .flat_map(|a| rows.iter().map(|b| dot(a, b)))
        .collect()
}

/// `Aᵀ`, of a matrix with rows of length n.
pub(super) fn transposed(rows: &[f64], n: usize) -> Vec<f64> {
    let r = rows.len() / n.max(1);
    (0..n)
        .flat_map(|j| (0..r).map(move |i| rows[i * n + j]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second difference matrix has the eigenvalues 2 − 2 cos(kπ/(n + 1)).
    #[test]
    fn eigenvalues_of_second_differences() {
        let n = 5;
        let mut a = vec![0.0; n * n];
        for i in 0..n {
            a[i * n + i] = 2.0;
            if i + 1 < n {
                (a[i * n + i + 1], a[(i + 1) * n + i]) = (-1.0, -1.0);
            }
        }
        let found = Spectrum::of(a.clone(), n);
        for (k, value) in found.values.iter().enumerate() {
            let angle = (k + 1) as f64 * std::f64::consts::PI / (n + 1) as f64;
            assert!((value - (2.0 - 2.0 * angle.cos())).abs() < 1e-14);
            let x = &found.vectors[k];
            for i in 0..n {
                let image: f64 = (0..n).map(|j| a[i * n + j] * x[j]).sum();
                assert!((image - value * x[i]).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn a_null_vector_is_found_to_rounding() {
        let rows = [1.0, 2.0, 3.0, 2.0, 4.0, 6.0];
        let found = Spectrum::of(gram(&rows, 3), 2);
        assert!(found.values[0].abs() < 1e-14);
        let w = &found.vectors[0];
        assert!((w[0] + 2.0 * w[1]).abs() < 1e-14);
    }
}
