//! Verified solution of linear systems: Gaussian elimination carried out in balls.

use super::{Ball, BallError, Precision};

/// The solutions of A X = B, one column for each right-hand side.
///
/// `matrix` is row-major `size` × `size`; each of `right_hand_sides` has `size` entries. Every matrix and right-hand side in
/// the given balls has its solution in the result, because each step of the elimination encloses the exact step
/// for the same pivots. A pivot is the entry of largest midpoint that excludes 0.
///
/// # Errors
/// [`BallError::Uncertain`] when no pivot excludes 0: singular, or the precision is too low to tell.
pub fn solve(
    precision: &Precision,
    size: usize,
    mut matrix: Vec<Ball>,
    right_hand_sides: &[Vec<Ball>],
) -> Result<Vec<Vec<Ball>>, BallError> {
    let units = 20 + precision.bits() as u64 / 8;
    crate::meter::spend((size * size * size) as u64 * units);
    let mut columns = right_hand_sides.to_vec();
    for step in 0..size {
        let pivot = best_pivot(&matrix, size, step)
            .ok_or(BallError::Uncertain("the solution of a linear system"))?;
        for column in 0..size {
            matrix.swap(pivot * size + column, step * size + column);
        }
        columns.iter_mut().for_each(|rhs| rhs.swap(pivot, step));
        for row in step + 1..size {
            if matrix[row * size + step] == Ball::zero() {
                continue;
            }
            let factor = precision.div(&matrix[row * size + step], &matrix[step * size + step])?;
            for column in step + 1..size {
                let product = precision.mul(&factor, &matrix[step * size + column])?;
                matrix[row * size + column] =
                    precision.sub(&matrix[row * size + column], &product)?;
            }
            for rhs in &mut columns {
                rhs[row] = precision.sub(&rhs[row], &precision.mul(&factor, &rhs[step])?)?;
            }
        }
    }
    columns
        .into_iter()
        .map(|rhs| back_substitute(precision, size, &matrix, rhs))
        .collect()
}

fn best_pivot(matrix: &[Ball], size: usize, step: usize) -> Option<usize> {
    (step..size)
        .filter(|&row| matrix[row * size + step].excludes_zero())
        .max_by_key(|&row| matrix[row * size + step].midpoint().magnitude())
}

fn back_substitute(
    precision: &Precision,
    size: usize,
    upper: &[Ball],
    mut x: Vec<Ball>,
) -> Result<Vec<Ball>, BallError> {
    for row in (0..size).rev() {
        for column in row + 1..size {
            let product = precision.mul(&upper[row * size + column], &x[column])?;
            x[row] = precision.sub(&x[row], &product)?;
        }
        x[row] = precision.div(&x[row], &upper[row * size + row])?;
    }
    Ok(x)
}
