//! Factorization and solution of small dense linear systems, for one state or a block of states.
//!
//! Both factorizations leave the same storage: L below the diagonal (its ones are not stored), the reciprocals of
//! the pivots on it, U above it, and a permutation; for L D Lᵀ, U = D Lᵀ and the permutation is the identity
//! (Golub and Van Loan 2013, sections 3.4 and 4.1). One routine therefore solves with either.

use crate::evaluate::PivotRange;
use crate::lanes::Word;
use crate::program::Factorization;

/// A pivot below this, times size · ε, times its uncertainty, counts as zero.
const SAFETY: f64 = 10.0;

/// Pivots of L U whose ratio is above this need no closer look: rounding leaves pivots near ε.
const UNSUSPICIOUS: f64 = 1e-8;

/// Why a matrix cannot be used in a state.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Fault {
    Singular {
        pivot: usize,
        value: f64,
        threshold: f64,
        range: PivotRange,
    },
    NotFinite,
}

/// Storage of one factorized matrix.
#[derive(Clone, Debug, Default)]
pub(crate) struct Factored<W> {
    size: usize,
    /// The matrix as given, row by row.
    given: Vec<W>,
    factors: Vec<W>,
    pivots: Vec<W>,
    /// Row i of the factors is row `rows[i · LANES + l]` of the matrix in state l.
    rows: Vec<u32>,
    /// By state.
    ranges: Vec<PivotRange>,
    /// One state, for falling back from L D Lᵀ to L U.
    lane: Lane,
}

#[derive(Clone, Debug, Default)]
struct Lane {
    factors: Vec<f64>,
    pivots: Vec<f64>,
    rows: Vec<u32>,
}

impl<W: Word> Factored<W> {
    pub(crate) fn new(size: usize) -> Factored<W> {
        let nothing = PivotRange {
            smallest: f64::NAN,
            largest: f64::NAN,
        };
        Factored {
            size,
            given: vec![W::default(); size * size],
            factors: vec![W::default(); size * size],
            pivots: vec![W::default(); size],
            rows: vec![0; size * W::LANES],
            ranges: vec![nothing; W::LANES],
            lane: Lane {
                factors: vec![0.0; size * size],
                pivots: vec![0.0; size],
                rows: vec![0; size],
            },
        }
    }

    /// Number of rows.
    #[cfg(all(unix, target_arch = "x86_64"))]
    pub(crate) fn size(&self) -> usize {
        self.size
    }

    /// The pivots of the last factorization in state l; NaN before the first.
    pub(crate) fn range(&self, l: usize) -> PivotRange {
        self.ranges[l]
    }

    /// Where the entries are written, row by row, before [`Factored::factorize`].
    pub(crate) fn given_mut(&mut self) -> &mut [W] {
        &mut self.given
    }

    /// Factorizes the matrix given; `report` hears of the states in which it cannot be used.
    pub(crate) fn factorize(
        &mut self,
        factorization: Factorization,
        mut report: impl FnMut(usize, Fault),
    ) {
        let n = self.size;
        self.factors.copy_from_slice(&self.given);
        match factorization {
            Factorization::Lu => lu(n, &mut self.factors, &mut self.pivots, &mut self.rows),
            Factorization::Ldlt => ldlt(n, &mut self.factors, &mut self.pivots, &mut self.rows),
        }
        for l in 0..W::LANES {
            self.ranges[l] = range(self.pivots.iter().map(|pivot| pivot.lane(l)));
            if factorization == Factorization::Ldlt {
                if self.is_definite(l) {
                    continue;
                }
                self.fall_back(l);
            }
            if let Some(fault) = self.fault(l) {
                report(l, fault);
            }
        }
    }

    /// Whether the pivots of L D Lᵀ are positive and none is negligible beside its terms, which add up to the entry of the diagonal.
    fn is_definite(&self, l: usize) -> bool {
        let n = self.size;
        let negligible = SAFETY * n as f64 * f64::EPSILON;
        let mut pivots = self.pivots.iter().enumerate();
        pivots.all(|(k, pivot)| {
            let (pivot, terms) = (pivot.lane(l), self.given[k * n + k].lane(l));
            pivot > negligible * terms && pivot > 0.0 && pivot.is_finite()
        })
    }

    /// Factorizes again with pivoting, in state l only.
    fn fall_back(&mut self, l: usize) {
        let lane = &mut self.lane;
        for (to, from) in lane.factors.iter_mut().zip(&self.given) {
            *to = from.lane(l);
        }
        lu(
            self.size,
            &mut lane.factors,
            &mut lane.pivots,
            &mut lane.rows,
        );
        for (to, &from) in self.factors.iter_mut().zip(&lane.factors) {
            to.set_lane(l, from);
        }
        for (to, &from) in self.pivots.iter_mut().zip(&lane.pivots) {
            to.set_lane(l, from);
        }
        for (i, &row) in lane.rows.iter().enumerate() {
            self.rows[i * W::LANES + l] = row;
        }
        self.ranges[l] = range(lane.pivots.iter().copied());
    }

    /// The fault of L U in state l: a pivot that may be zero for a matrix which rounding does not tell from the one given
    /// ([`uncertainty`]), whatever the units of rows and columns are.
    fn fault(&self, l: usize) -> Option<Fault> {
        let PivotRange { smallest, largest } = self.ranges[l];
        if smallest > UNSUSPICIOUS * largest && largest.is_finite() {
            return None;
        }
        let n = self.size;
        if (0..n * n).any(|i| !self.given[i].lane(l).is_finite()) {
            return Some(Fault::NotFinite);
        }
        let factor = |i: usize, j: usize| self.factors[i * n + j].lane(l);
        let pivot = |k: usize| self.pivots[k].lane(l);
        for k in 0..n {
            let value = pivot(k);
            let threshold = SAFETY * n as f64 * f64::EPSILON * uncertainty(k, factor, pivot);
            if value.abs() <= threshold {
                return Some(Fault::Singular {
                    pivot: k,
                    value,
                    threshold,
                    range: self.ranges[l],
                });
            }
            if !value.is_finite() {
                return Some(Fault::NotFinite);
            }
        }
        None
    }

    /// The factors of one state, row by row.
    #[cfg(all(unix, target_arch = "x86_64"))]
    pub(crate) fn factors(&self, l: usize) -> impl Iterator<Item = f64> + '_ {
        self.factors.iter().map(move |word| word.lane(l))
    }

    /// For each row of the factors its row in the matrix, in one state.
    #[cfg(all(unix, target_arch = "x86_64"))]
    pub(crate) fn rows(&self, l: usize) -> Vec<usize> {
        let rows = self.rows.iter().skip(l).step_by(W::LANES);
        rows.map(|&row| row as usize).collect()
    }

    /// Solves A x = b, where b is `rhs(i, l)`; x replaces the contents of `x`.
    pub(crate) fn solve(&self, rhs: impl Fn(usize, usize) -> f64, x: &mut [W]) {
        let n = self.size;
        for (i, x) in x.iter_mut().enumerate() {
            for l in 0..W::LANES {
                x.set_lane(l, rhs(self.rows[i * W::LANES + l] as usize, l));
            }
        }
        for i in 1..n {
            let (known, rest) = x.split_at_mut(i);
            for (lower, known) in self.factors[i * n..].iter().zip(&*known) {
                rest[0].update(lower, known, |x, a, b| x - a * b);
            }
        }
        for i in (0..n).rev() {
            let (rest, known) = x.split_at_mut(i + 1);
            let row = &self.factors[i * n + i..(i + 1) * n];
            for (upper, known) in row[1..].iter().zip(&*known) {
                rest[i].update(upper, known, |x, a, b| x - a * b);
            }
            rest[i].update(&row[0], &row[0], |x, reciprocal, _| x * reciprocal);
        }
    }
}

/// By how many units of rounding pivot k of L U is uncertain, to first order: L U belongs to a matrix that differs from the one given
/// by at most |L| |U| in each entry, in such units (Higham 2002, theorem 9.3), and an entry (i, j) moves the pivot by its product with
/// −A₂₁ A₁₁⁻¹ and −A₁₁⁻¹ A₁₂, which the factors give. A matrix with other units of rows and columns has the same quotient of
/// this and the pivot: largest entries of rows and columns would not do, as [[c, 0, b], [0, c, b], [b, b, 0]] with small c is well
/// determined, and c small beside b only by the units of the third row and column.
pub(crate) fn uncertainty(
    k: usize,
    factor: impl Fn(usize, usize) -> f64,
    pivot: impl Fn(usize) -> f64,
) -> f64 {
    let (mut by_row, mut by_column) = (vec![0.0; k + 1], vec![0.0; k + 1]);
    (by_row[k], by_column[k]) = (1.0, 1.0);
    for j in (0..k).rev() {
        let below = (j + 1..=k).map(|i| by_row[i] * factor(i, j));
        by_row[j] = -below.sum::<f64>();
        let right = (j + 1..=k).map(|i| factor(j, i) * by_column[i]);
        by_column[j] = -right.sum::<f64>() / pivot(j);
    }
    let term = |m: usize| -> f64 {
        let lower = (m + 1..=k).map(|i| (by_row[i] * factor(i, m)).abs());
        let upper = (m + 1..=k).map(|j| (factor(m, j) * by_column[j]).abs());
        let own = (pivot(m) * by_column[m]).abs();
        (by_row[m].abs() + lower.sum::<f64>()) * (own + upper.sum::<f64>())
    };
    (0..=k).map(term).sum()
}

pub(crate) fn range(pivots: impl Iterator<Item = f64>) -> PivotRange {
    let nothing = PivotRange {
        smallest: f64::INFINITY,
        largest: 0.0,
    };
    pivots.fold(nothing, |range, pivot| PivotRange {
        smallest: least(range.smallest, pivot.abs()),
        largest: if pivot.abs() > range.largest {
            pivot.abs()
        } else {
            range.largest
        },
    })
}

/// The lesser of two; NaN if either is.
fn least(a: f64, b: f64) -> f64 {
    if a.is_nan() || a < b {
        a
    } else {
        b
    }
}

/// P A = L U with partial pivoting, column after column.
fn lu<W: Word>(n: usize, factors: &mut [W], pivots: &mut [W], rows: &mut [u32]) {
    start_rows::<W>(rows);
    for k in 0..n {
        exchange_rows(n, k, factors, rows);
        eliminate(n, k, factors, pivots, |_| n);
    }
}

/// A = L D Lᵀ without pivoting; of the matrix, the diagonal and what is below it are read.
fn ldlt<W: Word>(n: usize, factors: &mut [W], pivots: &mut [W], rows: &mut [u32]) {
    start_rows::<W>(rows);
    for k in 0..n {
        for i in k + 1..n {
            factors[k * n + i] = factors[i * n + k];
        }
        eliminate(n, k, factors, pivots, |i| i + 1);
    }
}

fn start_rows<W: Word>(rows: &mut [u32]) {
    for (i, row) in rows.iter_mut().enumerate() {
        *row = (i / W::LANES) as u32;
    }
}

/// Subtracts multiples of row k from the rows i below, up to column `end(i)`.
fn eliminate<W: Word>(
    n: usize,
    k: usize,
    factors: &mut [W],
    pivots: &mut [W],
    end: impl Fn(usize) -> usize,
) {
    let (done, below) = factors.split_at_mut((k + 1) * n);
    let (pivot, pivot_row) = done[k * n + k..].split_at_mut(1);
    pivots[k] = pivot[0];
    let unit = W::splat(1.0);
    pivot[0].update(&unit, &unit, |pivot, one, _| one / pivot);
    for (i, row) in below.chunks_exact_mut(n).enumerate() {
        let (left, right) = row[..end(k + 1 + i)].split_at_mut(k + 1);
        left[k].update(&pivot[0], &unit, |a, reciprocal, _| a * reciprocal);
        for (a, u) in right.iter_mut().zip(&*pivot_row) {
            a.update(&left[k], u, |a, multiplier, u| a - multiplier * u);
        }
    }
}

/// Brings the largest entry of column k, at or below the diagonal, to the diagonal, in each state by itself.
fn exchange_rows<W: Word>(n: usize, k: usize, factors: &mut [W], rows: &mut [u32]) {
    for l in 0..W::LANES {
        let mut pivot = k;
        let mut largest = factors[k * n + k].lane(l).abs();
        for i in k + 1..n {
            let magnitude = factors[i * n + k].lane(l).abs();
            if magnitude > largest {
                (pivot, largest) = (i, magnitude);
            }
        }
        if pivot == k {
            continue;
        }
        let (upper, lower) = factors.split_at_mut(pivot * n);
        for (above, below) in upper[k * n..(k + 1) * n].iter_mut().zip(&mut lower[..n]) {
            let moved = above.lane(l);
            above.set_lane(l, below.lane(l));
            below.set_lane(l, moved);
        }
        rows.swap(k * W::LANES + l, pivot * W::LANES + l);
    }
}
