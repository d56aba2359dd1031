//! Linear solves worked out by elimination over the field.

use super::super::rational_function::RationalFunction;
use super::field::Field;
use super::Stop;

impl Field<'_> {
    /// `A⁻¹ b` for A row by row; the pivot of each column is its shortest non-zero entry.
    pub(super) fn solve(
        &self,
        matrix: &[RationalFunction],
        rhs: &[RationalFunction],
    ) -> Result<Vec<RationalFunction>, Stop> {
        let n = rhs.len();
        let mut rows: Vec<Vec<RationalFunction>> = (0..n)
            .map(|i| {
                let mut row = matrix[i * n..(i + 1) * n].to_vec();
                row.push(rhs[i].clone());
                row
            })
            .collect();
        let size = |f: &RationalFunction| f.numerator().len() + f.denominator().len();
        for k in 0..n {
            let candidates = (k..n).filter(|&i| !rows[i][k].is_zero());
            let pivot = candidates
                .min_by_key(|&i| size(&rows[i][k]))
                .ok_or(Stop::Undefined)?;
            rows.swap(k, pivot);
            let pivot_row = rows[k].clone();
            for row in rows.iter_mut().skip(k + 1).filter(|row| !row[k].is_zero()) {
                let factor = self.div(&row[k], &pivot_row[k])?;
                for j in k + 1..=n {
                    let change = self.mul(&factor, &pivot_row[j])?;
                    row[j] = self.sub(&row[j], &change)?;
                }
                row[k] = RationalFunction::zero();
            }
        }
        let mut solution = vec![RationalFunction::zero(); n];
        for k in (0..n).rev() {
            let mut value = rows[k][n].clone();
            for j in k + 1..n {
                value = self.sub(&value, &self.mul(&rows[k][j], &solution[j])?)?;
            }
            solution[k] = self.div(&value, &rows[k][k])?;
        }
        Ok(solution)
    }
}
