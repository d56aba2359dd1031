//! Accelerations as expressions: the solution of
//!
//! ```text
//! M a − Jᵀ λ = b,   J a = g
//! ```
//!
//! as one linear system of the graph; with velocities eliminated that a constraint gives without a division. There with
//! `a_d = a* + B a_i` the system is `Bᵀ M B a_i − J'ᵀ λ' = Bᵀ (b − M a*)` for the velocities and constraints that are left
//! (T5 §5.1 (2)), and what was written with sines and cosines of a heading often does not depend on it any more.

use crate::functions::FunctionsError;
use chetaev_symbolic::simplify::{simplify_all, Options};
use chetaev_symbolic::{Expr, Graph};

/// The equations that determine the accelerations.
pub(crate) struct Bordered<'a> {
    pub(crate) g: &'a Graph,
    /// M, by rows.
    pub(crate) mass: Vec<Vec<Expr>>,
    /// b.
    pub(crate) force: Vec<Expr>,
    /// Independent rows of J.
    pub(crate) jacobian: Vec<Vec<Expr>>,
    /// g of these rows.
    pub(crate) rate: Vec<Expr>,
}

/// A velocity that one constraint alone gives, with a number for its coefficient.
struct Pivot {
    row: usize,
    column: usize,
    /// B of this velocity over the velocities left, and a*.
    slope: Vec<Expr>,
    free: Expr,
}

/// Matrices with more rows are left as they are.
const LARGEST: usize = 12;

impl Bordered<'_> {
    /// The accelerations, as they are stated.
    pub(crate) fn solve(&self) -> Result<Vec<Expr>, FunctionsError> {
        let mut unknowns = self.unknowns()?;
        unknowns.truncate(self.force.len());
        Ok(unknowns)
    }

    /// The accelerations and the multipliers, as they are stated.
    pub(crate) fn unknowns(&self) -> Result<Vec<Expr>, FunctionsError> {
        let (g, n) = (self.g, self.force.len());
        let size = n + self.rate.len();
        let mut matrix = vec![g.zero(); size * size];
        for (i, row) in self.mass.iter().enumerate() {
            matrix[i * size..i * size + n].copy_from_slice(row);
        }
        for (l, row) in self.jacobian.iter().enumerate() {
            for (i, &entry) in row.iter().enumerate() {
                matrix[(n + l) * size + i] = entry;
                matrix[i * size + n + l] = g.neg(entry);
            }
        }
        let right = [&self.force[..], &self.rate].concat();
        g.solve(&matrix, &right)
            .map_err(|_| FunctionsError::Singular)
    }

    /// The same with all velocities eliminated that can be; `None` where there are none, or the system is large.
    pub(crate) fn eliminated(&self) -> Option<Result<Vec<Expr>, FunctionsError>> {
        let (g, n) = (self.g, self.force.len());
        let (pivots, left) = self.pivots();
        if pivots.is_empty() || left.len() > LARGEST {
            return None;
        }
        let rows: Vec<usize> = (0..self.rate.len())
            .filter(|&row| pivots.iter().all(|pivot| pivot.row != row))
            .collect();
        let reduced = Bordered {
            g,
            mass: self.reduced_mass(&pivots, &left),
            force: self.reduced_force(&pivots, &left),
            jacobian: rows
                .iter()
                .map(|&row| left.iter().map(|&i| self.jacobian[row][i]).collect())
                .collect(),
            rate: rows.iter().map(|&row| self.rate[row]).collect(),
        };
        let own = match reduced.simplified().solve() {
            Ok(own) => own,
            Err(problem) => return Some(Err(problem)),
        };
        let mut all = vec![g.zero(); n];
        for (&i, &a) in left.iter().zip(&own) {
            all[i] = a;
        }
        for pivot in &pivots {
            let terms = pivot.slope.iter().zip(&own).map(|(&b, &a)| g.mul(&[b, a]));
            let mut terms: Vec<Expr> = terms.collect();
            terms.push(pivot.free);
            all[pivot.column] = g.add(&terms);
        }
        Some(Ok(all))
    }

    /// Velocities to eliminate, and those left.
    fn pivots(&self) -> (Vec<Pivot>, Vec<usize>) {
        let (g, n) = (self.g, self.force.len());
        let mut columns: Vec<(usize, usize)> = Vec::new();
        for row in 0..self.rate.len() {
            let is_alone = |column: usize| {
                let others = (0..self.rate.len()).filter(|&other| other != row);
                let entry = self.jacobian[row][column];
                g.as_number(entry).is_some_and(|_| !g.is_zero(entry))
                    && others
                        .into_iter()
                        .all(|other| g.is_zero(self.jacobian[other][column]))
            };
            let found = (0..n).find(|&column| is_alone(column));
            columns.extend(found.map(|column| (row, column)));
        }
        let left: Vec<usize> = (0..n)
            .filter(|column| columns.iter().all(|own| own.1 != *column))
            .collect();
        let pivot = |&(row, column): &(usize, usize)| {
            let entry = self.jacobian[row][column];
            let over = |e: Expr| g.div(e, entry);
            Pivot {
                row,
                column,
                slope: left
                    .iter()
                    .map(|&i| g.neg(over(self.jacobian[row][i])))
                    .collect(),
                free: over(self.rate[row]),
            }
        };
        (columns.iter().map(pivot).collect(), left)
    }

    /// Bᵀ M B
    fn reduced_mass(&self, pivots: &[Pivot], left: &[usize]) -> Vec<Vec<Expr>> {
        let g = self.g;
        // M B, in all rows.
        let half: Vec<Vec<Expr>> = self
            .mass
            .iter()
            .map(|row| {
                let entry = |(sigma, &i): (usize, &usize)| {
                    let terms = pivots
                        .iter()
                        .map(|pivot| g.mul(&[row[pivot.column], pivot.slope[sigma]]));
                    g.add(&terms.chain([row[i]]).collect::<Vec<_>>())
                };
                left.iter().enumerate().map(entry).collect()
            })
            .collect();
        left.iter()
            .enumerate()
            .map(|(sigma, &i)| {
                let entry = |tau: usize| {
                    let terms = pivots
                        .iter()
                        .map(|pivot| g.mul(&[pivot.slope[sigma], half[pivot.column][tau]]));
                    g.add(&terms.chain([half[i][tau]]).collect::<Vec<_>>())
                };
                (0..left.len()).map(entry).collect()
            })
            .collect()
    }

    /// Bᵀ (b − M a*)
    fn reduced_force(&self, pivots: &[Pivot], left: &[usize]) -> Vec<Expr> {
        let g = self.g;
        let rest: Vec<Expr> = self
            .mass
            .iter()
            .zip(&self.force)
            .map(|(row, &force)| {
                let terms = pivots
                    .iter()
                    .map(|pivot| g.neg(g.mul(&[row[pivot.column], pivot.free])));
                g.add(&terms.chain([force]).collect::<Vec<_>>())
            })
            .collect();
        let entry = |(sigma, &i): (usize, &usize)| {
            let terms = pivots
                .iter()
                .map(|pivot| g.mul(&[pivot.slope[sigma], rest[pivot.column]]));
            g.add(&terms.chain([rest[i]]).collect::<Vec<_>>())
        };
        left.iter().enumerate().map(entry).collect()
    }

    /// The same with shorter entries.
    fn simplified(mut self) -> Self {
        let n = self.force.len();
        let all = [self.mass.concat(), self.force].concat();
        let shorter = simplify_all(self.g, &all, &Options::default());
        self.mass = shorter[..n * n]
            .chunks(n.max(1))
            .map(<[Expr]>::to_vec)
            .collect();
        self.force = shorter[n * n..].to_vec();
        self
    }
}
