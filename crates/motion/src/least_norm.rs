//! Steps of least kinetic norm onto linearized constraints.

use crate::dense::Lu;

/// Euclidean length.
pub(crate) fn norm(x: &[f64]) -> f64 {
    x.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The n × n identity, row by row.
pub(crate) fn identity(n: usize) -> Vec<f64> {
    let mut matrix = vec![0.0; n * n];
    for i in 0..n {
        matrix[i * n + i] = 1.0;
    }
    matrix
}

/// The step x of the movable components with `J x = f` (in the least-squares sense where rows depend) and least
/// `xᵀ M x`; the metric falls back to the identity where M is not positive definite on the movable components.
pub(crate) fn least_step(
    jacobian: &[f64],
    f: &[f64],
    n: usize,
    movable: &[usize],
    metric: &[f64],
) -> Vec<f64> {
    least_step_of((jacobian, f), n, movable, metric, DEPENDENT)
}

/// Rows of which no more than this part is independent of those before them are taken to depend on them: next to the states at
/// which rows depend they do not quite.
pub(crate) const DEPENDENT: f64 = 1e-10;
/// The same where that has not helped: what rounding leaves of a row that depends.
pub(crate) const DEPENDENT_BY_ROUNDING: f64 = 1e-14;

/// The same, where rows of which no more than the part `least` is independent of those before them are left out.
pub(crate) fn least_step_of(
    (jacobian, f): (&[f64], &[f64]),
    n: usize,
    movable: &[usize],
    metric: &[f64],
    least: f64,
) -> Vec<f64> {
    let m = movable.len();
    let mut step = vec![0.0; n];
    if m == 0 || f.is_empty() {
        return step;
    }
    let factor = root(metric, n, movable);
    // With x = L⁻ᵀ y the norm is Euclidean.
    let mut basis: Vec<(Vec<f64>, f64)> = Vec::new();
    for (row, &target) in jacobian.chunks(n).zip(f) {
        let mut direction = dual(row, movable, &factor);
        let original = norm(&direction);
        let mut value = target;
        for (unit, component) in &basis {
            let along: f64 = direction.iter().zip(unit).map(|(a, b)| a * b).sum();
            direction
                .iter_mut()
                .zip(unit)
                .for_each(|(a, b)| *a -= along * b);
            value -= along * component;
        }
        let length = norm(&direction);
        if length > least * original && length > 0.0 {
            direction.iter_mut().for_each(|x| *x /= length);
            basis.push((direction, value / length));
        }
    }
    let mut y = vec![0.0; m];
    for (unit, component) in basis {
        y.iter_mut()
            .zip(unit)
            .for_each(|(a, u)| *a += component * u);
    }
    backward(&factor, &mut y);
    for (&i, &x) in movable.iter().zip(&y) {
        step[i] = x;
    }
    step
}

/// L with `L Lᵀ` the metric of the movable components, or the identity where that is not positive definite.
fn root(metric: &[f64], n: usize, movable: &[usize]) -> Vec<f64> {
    let m = movable.len();
    let mut sub: Vec<f64> = Vec::with_capacity(m * m);
    for &i in movable {
        sub.extend(movable.iter().map(|&j| metric[i * n + j]));
    }
    cholesky(&sub, m).unwrap_or_else(|| identity(m))
}

/// A row of `J L⁻ᵀ`, by forward substitution.
fn dual(row: &[f64], movable: &[usize], factor: &[f64]) -> Vec<f64> {
    let mut direction: Vec<f64> = movable.iter().map(|&i| row[i]).collect();
    forward(factor, &mut direction);
    direction
}

/// The rows after the `first` ones of a matrix with n columns in an order in which each is the one of the rest that depends
/// least on those before it in the movable columns; rows of which no more than the part `least` is independent of them are left
/// out.
pub(crate) fn independent(
    rows: &[f64],
    (n, first): (usize, usize),
    movable: &[usize],
    metric: &[f64],
    least: f64,
) -> Vec<usize> {
    let factor = root(metric, n, movable);
    let mut rests: Vec<Vec<f64>> = rows
        .chunks(n.max(1))
        .map(|row| dual(row, movable, &factor))
        .collect();
    let lengths: Vec<f64> = rests.iter().map(|rest| norm(rest)).collect();
    let part = |rests: &[Vec<f64>], i: usize| norm(&rests[i]) / lengths[i].max(f64::MIN_POSITIVE);
    for i in 0..first.min(rests.len()) {
        if part(&rests, i) > least {
            take_out(&mut rests, i);
        }
    }
    let mut open: Vec<usize> = (first..rests.len()).collect();
    let mut order = Vec::new();
    while let Some(place) =
        (0..open.len()).max_by(|&a, &b| part(&rests, open[a]).total_cmp(&part(&rests, open[b])))
    {
        let next = open.remove(place);
        // What is not a number comes first and is left out.
        match part(&rests, next) > least {
            true => take_out(&mut rests, next),
            false => continue,
        }
        order.push(next);
    }
    order
}

/// Takes the direction of row i out of all rows.
fn take_out(rests: &mut [Vec<f64>], i: usize) {
    let length = norm(&rests[i]);
    let unit: Vec<f64> = rests[i].iter().map(|x| x / length).collect();
    for rest in rests {
        let along: f64 = rest.iter().zip(&unit).map(|(a, b)| a * b).sum();
        rest.iter_mut()
            .zip(&unit)
            .for_each(|(a, b)| *a -= along * b);
    }
}

/// L with `L Lᵀ = A`; `None` when A is not safely positive definite.
fn cholesky(a: &[f64], m: usize) -> Option<Vec<f64>> {
    let mut l = vec![0.0; m * m];
    for i in 0..m {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| l[i * m + k] * l[j * m + k]).sum();
            let value = a[i * m + j] - sum;
            if i == j {
                if value.is_nan() || value <= 1e-12 * a[i * m + i].abs() {
                    return None;
                }
                l[i * m + i] = value.sqrt();
            } else {
                l[i * m + j] = value / l[j * m + j];
            }
        }
    }
    Some(l)
}

/// `x ← L⁻¹ x`.
fn forward(l: &[f64], x: &mut [f64]) {
    let m = x.len();
    for i in 0..m {
        let sum: f64 = (0..i).map(|j| l[i * m + j] * x[j]).sum();
        x[i] = (x[i] - sum) / l[i * m + i];
    }
}

/// `x ← L⁻ᵀ x`.
fn backward(l: &[f64], x: &mut [f64]) {
    let m = x.len();
    for i in (0..m).rev() {
        let sum: f64 = (i + 1..m).map(|j| l[j * m + i] * x[j]).sum();
        x[i] = (x[i] - sum) / l[i * m + i];
    }
}

/// `x` with least `|A x - f|`, A row by row with `size` columns, by the normal equations; of several the shortest. `all` are the columns that count.
pub fn least_squares(a: &[f64], f: &[f64], size: usize, all: &[usize]) -> Vec<f64> {
    let mut normal = vec![0.0; size * size];
    let mut right = vec![0.0; size];
    for (row, &value) in a.chunks(size.max(1)).zip(f) {
        for &i in all {
            right[i] += row[i] * value;
            for &j in all {
                normal[i * size + j] += row[i] * row[j];
            }
        }
    }
    let mut lu = Lu::default();
    match lu.factor(size, &normal) {
        Ok(()) => lu.solve(&mut right),
        Err(_) => return least_step(a, f, size, all, &identity(size)),
    }
    right
}
