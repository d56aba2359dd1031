//! Ranks of small dense matrices, and signs of forms on the directions that constraints admit.

/// Whether a square matrix, row by row, has a small pivot.
pub(super) fn is_singular(matrix: &[f64], size: usize) -> bool {
    let rows = matrix.chunks(size).map(<[f64]>::to_vec).collect();
    rank_to(rows, 1e-7) < size
}

/// The rank of a matrix.
pub(super) fn rank(rows: Vec<Vec<f64>>) -> usize {
    rank_to(rows, 1e-10)
}

/// The number of pivots above `small` times the largest entry, by complete pivoting.
fn rank_to(mut rows: Vec<Vec<f64>>, small: f64) -> usize {
    let scale = rows.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let width = rows.first().map_or(0, Vec::len);
    let mut used = vec![false; width];
    let mut rank = 0;
    while rank < rows.len() {
        let mut best = (rank, 0, 0.0);
        for (i, row) in rows.iter().enumerate().skip(rank) {
            for (j, x) in row.iter().enumerate().filter(|(j, _)| !used[*j]) {
                if x.abs() > best.2 {
                    best = (i, j, x.abs());
                }
            }
        }
        let (i, j, size) = best;
        if size <= small * scale || size == 0.0 {
            break;
        }
        rows.swap(rank, i);
        used[j] = true;
        let (done, open) = rows.split_at_mut(rank + 1);
        let pivot = &done[rank];
        for row in open {
            let factor = row[j] / pivot[j];
            row.iter_mut()
                .zip(pivot)
                .for_each(|(a, b)| *a -= factor * b);
        }
        rank += 1;
    }
    rank
}

/// The signs of a form on the directions that the gradients annihilate, (13) of T2.
pub(super) fn kind(form: &[f64], gradient: &[f64], n: usize) -> Option<&'static str> {
    let basis = annihilated(gradient, n);
    let k = basis.len();
    let mut reduced: Vec<Vec<f64>> = vec![vec![0.0; k]; k];
    for (a, x) in basis.iter().enumerate() {
        for (b, y) in basis.iter().enumerate() {
            let entry = |i: usize| (0..n).map(|j| form[i * n + j] * y[j]).sum::<f64>();
            reduced[a][b] = (0..n).map(|i| x[i] * entry(i)).sum();
        }
    }
    let (mut positive, mut negative) = (0, 0);
    for s in 0..k {
        let pivot = reduced[s][s];
        if pivot > 0.0 {
            positive += 1;
        } else if pivot < 0.0 {
            negative += 1;
        }
        if pivot == 0.0 {
            return None;
        }
        let (done, open) = reduced.split_at_mut(s + 1);
        for row in open {
            let factor = row[s] / pivot;
            let known = done[s].iter();
            row.iter_mut()
                .zip(known)
                .for_each(|(a, b)| *a -= factor * b);
        }
    }
    Some(match (positive, negative) {
        (_, 0) => "minimum",
        (0, _) => "maximum",
        _ => "saddle",
    })
}

/// An orthonormal basis of the vectors that all rows annihilate.
fn annihilated(rows: &[f64], n: usize) -> Vec<Vec<f64>> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut units: Vec<Vec<f64>> = Vec::new();
    let push = |mut x: Vec<f64>, units: &mut Vec<Vec<f64>>| {
        let before = dot(&x, &x).sqrt();
        for unit in units.iter() {
            let along = dot(&x, unit);
            x.iter_mut().zip(unit).for_each(|(a, u)| *a -= along * u);
        }
        let length = dot(&x, &x).sqrt();
        let is_new = length > 1e-9 * before && length > 0.0;
        if is_new {
            x.iter_mut().for_each(|a| *a /= length);
            units.push(x);
        }
        is_new
    };
    for row in rows.chunks(n) {
        push(row.to_vec(), &mut units);
    }
    let kept = units.len();
    for i in 0..n {
        let mut unit = vec![0.0; n];
        unit[i] = 1.0;
        push(unit, &mut units);
    }
    units.split_off(kept)
}
