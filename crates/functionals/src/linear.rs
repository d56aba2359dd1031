//! Linear equations with rational numbers and few entries in a row, solved by elimination.

use crate::ritz_base::STEP;
use chetaev_symbolic::{meter, rational, Rational};
use std::collections::{BTreeMap, BTreeSet};

/// A solution of equations `row x = right`, with small whole numbers, different ones, for the unknowns that they leave open; `None` where
/// there is none.
pub(crate) fn some_solution(
    unknowns: usize,
    rows: Vec<(BTreeMap<usize, Rational>, Rational)>,
) -> Option<Vec<Rational>> {
    let mut solved: BTreeMap<usize, (BTreeMap<usize, Rational>, Rational)> = BTreeMap::new();
    for (mut row, mut right) in rows {
        // Rows that lead with a smaller unknown contain larger ones only.
        while let Some((lead, entry)) = row.pop_first() {
            if entry == Rational::ZERO {
                continue;
            }
            let Some((known, own)) = solved.get(&lead) else {
                row.values_mut()
                    .for_each(|value| *value = value.clone() / &entry);
                solved.insert(lead, (std::mem::take(&mut row), right.clone() / &entry));
                right = Rational::ZERO;
                break;
            };
            meter::spend(STEP * (1 + known.len() as u64));
            for (&column, value) in known {
                let place = row.entry(column).or_insert(Rational::ZERO);
                *place -= rational::product(&entry, value);
            }
            right -= rational::product(&entry, own);
        }
        if right != Rational::ZERO {
            return None;
        }
    }
    let mut values = vec![Rational::ZERO; unknowns];
    let mut open = 0;
    for place in (0..unknowns).rev() {
        values[place] = match solved.get(&place) {
            Some((row, right)) => row.iter().fold(right.clone(), |mut sum, (&column, entry)| {
                sum -= rational::product(entry, &values[column]);
                sum
            }),
            None => {
                open += 1;
                rational::integer(open % 5 + 1)
            }
        };
    }
    Some(values)
}

/// `matrix x = right`.
pub(crate) struct System {
    rows: Vec<BTreeMap<usize, Rational>>,
    /// The right sides.
    pub(crate) right: Vec<Rational>,
}

/// A solution.
pub(crate) struct Solution {
    /// The unknowns.
    pub(crate) values: Vec<Rational>,
    /// Whether elimination in the order of the unknowns met positive pivots only: of a symmetric matrix, whether it is positive definite.
    pub(crate) is_definite: bool,
}

impl System {
    /// So many equations 0 = 0.
    pub(crate) fn new(unknowns: usize) -> System {
        System {
            rows: vec![BTreeMap::new(); unknowns],
            right: vec![Rational::ZERO; unknowns],
        }
    }

    /// Adds to an entry.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: &Rational) {
        meter::spend(STEP);
        let own = self.rows[row].entry(column).or_insert(Rational::ZERO);
        *own = rational::sum(own, value);
    }

    /// Adds to a right side.
    pub(crate) fn add_right(&mut self, row: usize, value: &Rational) {
        self.right[row] = rational::sum(&self.right[row], value);
    }

    /// The only solution.
    ///
    /// # Errors
    /// Numbers, not all zero, that the matrix takes to zero: there is no solution, or another one.
    pub(crate) fn solution(mut self) -> Result<Solution, Vec<Rational>> {
        let n = self.right.len();
        let mut columns = vec![BTreeSet::new(); n];
        for (r, row) in self.rows.iter_mut().enumerate() {
            row.retain(|_, value| *value != Rational::ZERO);
            for &c in row.keys() {
                columns[c].insert(r);
            }
        }
        let mut order = Vec::with_capacity(n);
        let mut is_definite = true;
        for k in 0..n {
            // A row that leads already has no entry to the left of its pivot, and is in no later column any more.
            let found = if columns[k].contains(&k) {
                Some(k)
            } else {
                columns[k].first().copied()
            };
            let Some(row) = found else {
                return Err(self.taken_to_zero(k, &order));
            };
            self.eliminate(row, k, &mut columns);
            is_definite &= row == k && !rational::is_negative(&self.rows[row][&k]);
            order.push(row);
        }
        let mut values = vec![Rational::ZERO; n];
        for (k, &row) in order.iter().enumerate().rev() {
            values[k] = self.leading(k, row, &values, self.right[row].clone());
        }
        Ok(Solution {
            values,
            is_definite,
        })
    }

    /// The vector with 1 for the first unknown that no row leads with, and zeros behind it.
    fn taken_to_zero(&self, free: usize, order: &[usize]) -> Vec<Rational> {
        let mut values = vec![Rational::ZERO; self.right.len()];
        values[free] = rational::integer(1);
        for (k, &row) in order.iter().enumerate().rev() {
            values[k] = self.leading(k, row, &values, Rational::ZERO);
        }
        values
    }

    /// The unknown that a row leads with, from those behind it.
    fn leading(&self, k: usize, row: usize, values: &[Rational], right: Rational) -> Rational {
        let mut sum = right;
        for (&c, entry) in self.rows[row].range(k + 1..) {
            meter::spend(STEP);
            sum -= rational::product(entry, &values[c]);
        }
        sum / &self.rows[row][&k]
    }

    /// Makes zero what stands in a column of the other rows, those that have led already left out.
    fn eliminate(&mut self, row: usize, k: usize, columns: &mut [BTreeSet<usize>]) {
        let leading = std::mem::take(&mut self.rows[row]);
        for c in leading.keys() {
            columns[*c].remove(&row);
        }
        let below = std::mem::take(&mut columns[k]);
        for r in below {
            let Some(first) = self.rows[r].remove(&k) else {
                continue;
            };
            let factor = first / &leading[&k];
            for (&c, value) in leading.range(k + 1..) {
                meter::spend(STEP);
                let term = rational::product(&factor, value);
                let own = self.rows[r].entry(c).or_insert(Rational::ZERO);
                *own = &*own - &term;
                if *own == Rational::ZERO {
                    self.rows[r].remove(&c);
                    columns[c].remove(&r);
                } else {
                    columns[c].insert(r);
                }
            }
            let term = rational::product(&factor, &self.right[row]);
            self.right[r] = &self.right[r] - &term;
        }
        self.rows[row] = leading;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn system(entries: &[&[i64]], right: &[i64]) -> System {
        let mut own = System::new(right.len());
        for (r, row) in entries.iter().enumerate() {
            for (c, &value) in row.iter().enumerate() {
                own.add(r, c, &rational::integer(value));
            }
            own.add_right(r, &rational::integer(right[r]));
        }
        own
    }

    fn values(solution: &Solution) -> Vec<i64> {
        let own = solution.values.iter().map(rational::to_i64);
        own.map(|n| n.unwrap_or(i64::MAX)).collect()
    }

    #[test]
    fn rows_are_exchanged_where_a_pivot_vanishes() {
        // The matrix is indefinite, though its pivots after the exchange are positive.
        let own = system(&[&[0, 1], &[1, 0]], &[2, 3]).solution();
        assert!(own.is_ok_and(|own| values(&own) == [3, 2] && !own.is_definite));
    }

    #[test]
    fn definite_indefinite_and_singular_matrices_are_told_apart() {
        let own = system(&[&[2, 1, 0], &[1, 2, 1], &[0, 1, 2]], &[4, 8, 8]).solution();
        assert!(own.is_ok_and(|own| values(&own) == [1, 2, 3] && own.is_definite));
        let own = system(&[&[1, 2], &[2, 1]], &[5, 4]).solution();
        assert!(own.is_ok_and(|own| values(&own) == [1, 2] && !own.is_definite));
        let own = system(&[&[1, 2], &[2, 4]], &[1, 2]).solution().err();
        let own = own.map(|own| own.iter().map(rational::to_i64).collect::<Vec<_>>());
        assert_eq!(own, Some(vec![Some(-2), Some(1)]));
    }
}
