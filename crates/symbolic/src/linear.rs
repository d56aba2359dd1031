//! Linear systems over expressions: the structured solve.

use crate::graph::Graph;
use crate::node::Expr;
use std::collections::BTreeMap;

/// Why a linear system cannot be a solve node.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SolveError {
    /// The matrix has not `n²` entries for `n` right-hand sides.
    #[error("a system with {rhs} right-hand sides needs a square matrix, found {entries} entries")]
    Shape {
        /// Entries given.
        entries: usize,
        /// Right-hand sides given.
        rhs: usize,
    },
    /// A row or column is identically zero.
    #[error("the matrix is structurally singular: row or column {index} has no entry")]
    StructurallySingular {
        /// Zero-based row or column.
        index: usize,
    },
}

type Row = BTreeMap<usize, Expr>;

struct Elimination<'g> {
    g: &'g Graph,
    rows: Vec<Option<(Row, Expr)>>,
    solution: Vec<Option<Expr>>,
    /// Columns whose value follows from a row once everything else is known.
    deferred: Vec<(usize, Row, Expr)>,
}

impl Graph {
    /// The components of `A⁻¹ b` for a square matrix given row by row.
    ///
    /// Rows and columns with a single entry are eliminated on the way (a unit pivot vanishes); what remains is one
    /// solve node, never an expanded inverse.
    ///
    /// # Errors
    /// [`SolveError`] for a wrong shape or a structurally singular matrix.
    pub fn solve(&self, entries: &[Expr], rhs: &[Expr]) -> Result<Vec<Expr>, SolveError> {
        let n = rhs.len();
        if entries.len() != n * n {
            return Err(SolveError::Shape {
                entries: entries.len(),
                rhs: n,
            });
        }
        let rows = (0..n)
            .map(|i| {
                let row: Row = (0..n)
                    .filter(|&j| !self.is_zero(entries[i * n + j]))
                    .map(|j| (j, entries[i * n + j]))
                    .collect();
                Some((row, rhs[i]))
            })
            .collect();
        let mut elimination = Elimination {
            g: self,
            rows,
            solution: vec![None; n],
            deferred: Vec::new(),
        };
        elimination.run()?;
        Ok(elimination
            .solution
            .into_iter()
            .map(|x| x.unwrap_or_else(|| self.zero()))
            .collect())
    }
}

impl Elimination<'_> {
    fn run(&mut self) -> Result<(), SolveError> {
        while self.eliminate_row()? || self.eliminate_column() {}
        self.solve_core()?;
        while let Some((column, row, rhs)) = self.deferred.pop() {
            let g = self.g;
            let mut parts = vec![rhs];
            let mut pivot = g.one();
            for (j, a) in row {
                if j == column {
                    pivot = a;
                } else if let Some(x) = self.solution[j] {
                    parts.push(g.neg(g.mul(&[a, x])));
                }
            }
            self.solution[column] = Some(g.div(g.add(&parts), pivot));
        }
        Ok(())
    }

    /// A row with one entry gives its unknown at once.
    fn eliminate_row(&mut self) -> Result<bool, SolveError> {
        for i in 0..self.rows.len() {
            let Some((row, rhs)) = &self.rows[i] else {
                continue;
            };
            if row.is_empty() {
                return Err(SolveError::StructurallySingular { index: i });
            }
            if row.len() > 1 {
                continue;
            }
            let Some((&column, &a)) = row.iter().next() else {
                continue;
            };
            let x = self.g.div(*rhs, a);
            self.rows[i] = None;
            self.solution[column] = Some(x);
            for other in self.rows.iter_mut().flatten() {
                if let Some(b) = other.0.remove(&column) {
                    other.1 = self.g.sub(other.1, self.g.mul(&[b, x]));
                }
            }
            return Ok(true);
        }
        Ok(false)
    }

    /// A column with one entry defers its unknown to back-substitution.
    fn eliminate_column(&mut self) -> bool {
        let n = self.rows.len();
        let mut uses: Vec<(usize, usize)> = vec![(0, 0); n];
        for (i, row) in self.rows.iter().enumerate() {
            if let Some((row, _)) = row {
                for &j in row.keys() {
                    uses[j] = (uses[j].0 + 1, i);
                }
            }
        }
        let Some(column) = (0..n).find(|&j| uses[j].0 == 1) else {
            return false;
        };
        if let Some((row, rhs)) = self.rows[uses[column].1].take() {
            self.deferred.push((column, row, rhs));
        }
        true
    }

    fn solve_core(&mut self) -> Result<(), SolveError> {
        let g = self.g;
        let rows: Vec<(Row, Expr)> = self.rows.iter_mut().filter_map(Option::take).collect();
        if rows.is_empty() {
            return Ok(());
        }
        let mut columns: Vec<usize> = rows
            .iter()
            .flat_map(|(row, _)| row.keys().copied())
            .collect();
        columns.sort_unstable();
        columns.dedup();
        if columns.len() != rows.len() {
            let index = columns.first().copied().unwrap_or(0);
            return Err(SolveError::StructurallySingular { index });
        }
        let rhs: Vec<Expr> = rows.iter().map(|(_, b)| *b).collect();
        let values = if rhs.iter().all(|&b| g.is_zero(b)) {
            vec![g.zero(); rhs.len()]
        } else {
            let entries: Vec<Expr> = rows
                .iter()
                .flat_map(|(row, _)| {
                    columns
                        .iter()
                        .map(|j| row.get(j).copied().unwrap_or_else(|| g.zero()))
                })
                .collect();
            let shape = SolveError::Shape {
                entries: entries.len(),
                rhs: rhs.len(),
            };
            let matrix = g.matrix(rhs.len(), rhs.len(), &entries).ok_or(shape)?;
            g.solve_entries(matrix, &rhs)
        };
        for (column, value) in columns.into_iter().zip(values) {
            self.solution[column] = Some(value);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_pivots_vanish() {
        let g = Graph::new();
        let (a, b, c) = (g.symbol("a", 0), g.symbol("b", 0), g.symbol("c", 0));
        let x = g.solve(&[g.one(), g.zero(), a, g.one()], &[b, c]).unwrap();
        assert_eq!(x, vec![b, g.sub(c, g.mul(&[a, b]))]);
    }

    #[test]
    fn a_zero_row_is_refused() {
        let g = Graph::new();
        let a = g.symbol("a", 0);
        let z = g.zero();
        assert!(g.solve(&[a, a, z, z], &[a, a]).is_err());
    }
}
