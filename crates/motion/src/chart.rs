//! Which velocities are independent, chosen by conditioning at a state, and when to choose again (T5 §5.2).

use chetaev_compile::rounding::Rounded;

/// A choice of independent constraints and dependent velocities.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Independent constraint rows.
    pub rows: Vec<usize>,
    /// Dependent velocities, one per row.
    pub dependent: Vec<usize>,
    /// Independent velocities.
    pub independent: Vec<usize>,
    /// Smallest pivot of the scaled Jacobian when the chart was chosen.
    pub pivot: f64,
    /// Last accepted pivot over first rejected one; infinite when none was rejected.
    pub gap: f64,
}

/// What a pivot of the scaled Jacobian is compared with.
#[derive(Clone, Copy, Debug)]
pub enum Floor<'a> {
    /// The rounding of each entry of the Jacobian, row by row, and what elimination makes of it: at a state of its own.
    Rounding(&'a [Rounded]),
    /// The smallest pivot where a chart was chosen: along a motion a pivot vanishes beside what it was.
    Along(f64),
}

/// The part of its former value, times the number of rows or columns, below which a pivot counts as zero along a motion.
const LOST: f64 = 1e-10;

/// So many bounds of the rounding of a pivot count as zero: the data themselves are rounded numbers, mostly of fewer digits.
const ROUNDINGS: f64 = 16.0;

/// A chart is replaced when its pivot fell below this fraction of its value at the time of choice (T5 §5.2).
pub(crate) const DEGRADED: f64 = 0.1;

/// Where the pivot falls below this fraction of its value at the last accepted state, a step of independent velocities is
/// rejected: the errors of the others, which nobody measures, are larger by its inverse. Below [`DEGRADED`], so that steps may
/// end where the chart is replaced.
pub(crate) const BLIND: f64 = 0.05;

/// A new chart must be better by this factor, or charts would chatter.
pub(crate) const HYSTERESIS: f64 = 3.0;

/// Chooses a chart by Gaussian elimination with complete pivoting on the scaled Jacobian: rows to unit length (zero
/// rows stay zero), column j divided by `sqrt(|M_jj|)`. Which pivots count as zero says the floor.
pub fn choose(
    jacobian: &[f64],
    (r, n): (usize, usize),
    mass_diagonal: &[f64],
    floor: Floor<'_>,
) -> Chart {
    let (mut a, factors) = scaled(jacobian, r, n, mass_diagonal);
    let mut errors = match floor {
        Floor::Rounding(entries) => entries
            .iter()
            .zip(&factors)
            .map(|(e, s)| e.error * s)
            .collect(),
        Floor::Along(_) => Vec::new(),
    };
    let least = match floor {
        Floor::Rounding(_) => 0.0,
        Floor::Along(pivot) => LOST * pivot.min(1.0),
    };
    let mut rows: Vec<usize> = (0..r).collect();
    let mut columns: Vec<usize> = (0..n).collect();
    let found = pivots(&mut a, (&mut errors, least), &mut rows, &mut columns);
    chart_of(&found, &rows, &columns)
}

/// What elimination meets.
struct Pivots {
    rank: usize,
    smallest: f64,
    /// The first pivot that counts as zero, or 0.
    rejected: f64,
}

/// Gaussian elimination with complete pivoting on r rows and n columns, which it orders by pivots. `errors` are bounds of the
/// errors of the entries, or empty; pivots up to `least` of the largest, per row or column, count as zero, and so does rounding.
fn pivots(
    a: &mut [f64],
    (errors, least): (&mut [f64], f64),
    rows: &mut [usize],
    columns: &mut [usize],
) -> Pivots {
    let (r, n) = (rows.len(), columns.len());
    let least = n.max(r) as f64 * least.max(4.0 * f64::EPSILON);
    let mut largest: f64 = 0.0;
    let mut smallest = f64::INFINITY;
    let mut rejected: f64 = 0.0;
    let mut rank = 0;
    while rank < r.min(n) {
        let (i, j, value) = largest_entry(a, rows, columns, rank, n);
        largest = largest.max(value);
        let place = rows[i] * n + columns[j];
        let floor = match errors.get(place) {
            Some(error) => ROUNDINGS * error,
            None => least * largest,
        };
        if value.is_nan() || value <= floor || value == 0.0 {
            rejected = value;
            break;
        }
        smallest = smallest.min(value);
        rows.swap(rank, i);
        columns.swap(rank, j);
        let (pivot_row, pivot_column) = (rows[rank] * n, columns[rank]);
        let pivot = a[pivot_row + pivot_column];
        for &o in &rows[rank + 1..] {
            let row = o * n;
            let factor = a[row + pivot_column] / pivot;
            if !errors.is_empty() {
                let brought = errors[row + pivot_column]
                    + factor.abs() * errors[pivot_row + pivot_column]
                    + f64::EPSILON * a[row + pivot_column].abs();
                for &c in &columns[rank..] {
                    errors[row + c] += factor.abs() * errors[pivot_row + c]
                        + (brought / pivot.abs() + f64::EPSILON * factor.abs())
                            * a[pivot_row + c].abs();
                }
            }
            if factor != 0.0 {
                for &c in &columns[rank..] {
                    a[row + c] -= factor * a[pivot_row + c];
                }
            }
        }
        rank += 1;
    }
    Pivots {
        rank,
        smallest,
        rejected,
    }
}

fn chart_of(found: &Pivots, rows: &[usize], columns: &[usize]) -> Chart {
    let &Pivots {
        rank,
        smallest,
        rejected,
    } = found;
    let mut independent = columns[rank..].to_vec();
    independent.sort_unstable();
    let (rows, dependent) = sorted_pairs(&rows[..rank], &columns[..rank]);
    Chart {
        rows,
        dependent,
        independent,
        pivot: if rank == 0 { 1.0 } else { smallest },
        gap: if rejected > 0.0 {
            smallest / rejected
        } else {
            f64::INFINITY
        },
    }
}

/// Charts up to this size are looked at without allocating, which is done at every step.
const SMALL: usize = 6;

/// The smallest pivot that elimination meets in the columns of an existing chart: the cheap indicator of its quality.
/// `weight` is the diagonal of the mass matrix; rows of the Jacobian have length n.
pub fn quality(chart: &Chart, jacobian: &[f64], n: usize, weight: impl Fn(usize) -> f64) -> f64 {
    let size = chart.rows.len();
    if size > SMALL {
        let (mut block, mut order) = (vec![0.0; size * size], vec![0; 2 * size]);
        return least_pivot(chart, jacobian, n, weight, (&mut block, &mut order));
    }
    let (mut block, mut order) = ([0.0; SMALL * SMALL], [0; 2 * SMALL]);
    let space = (&mut block[..size * size], &mut order[..2 * size]);
    least_pivot(chart, jacobian, n, weight, space)
}

/// The same, in space for a block of the size of the chart and for its rows and columns; 0 where the rank is less.
#[allow(clippy::needless_range_loop)] // Done at every step: iterators are not always inlined.
fn least_pivot(
    chart: &Chart,
    jacobian: &[f64],
    n: usize,
    weight: impl Fn(usize) -> f64,
    (block, order): (&mut [f64], &mut [usize]),
) -> f64 {
    let size = chart.rows.len();
    for l in 0..size {
        let row = &jacobian[chart.rows[l] * n..][..n];
        // One root for an entry of the block, none for the others.
        let mut square = 0.0;
        for j in 0..n {
            if row[j] != 0.0 {
                square += row[j] * row[j] / heaviness(weight(j));
            }
        }
        for k in 0..size {
            let d = chart.dependent[k];
            if row[d] == 0.0 {
                block[l * size + k] = 0.0;
                continue;
            }
            let own = row[d] * row[d] / heaviness(weight(d));
            let part = if square > 0.0 { own / square } else { own };
            block[l * size + k] = part.sqrt().copysign(row[d]);
        }
    }
    match *block {
        // Zero for what is not a number.
        [single] => return single.abs().max(0.0),
        [a, b, c, d] => return least_of_two([[a, b], [c, d]]),
        _ => {}
    }
    let (rows, columns) = order.split_at_mut(size);
    rows.iter_mut().enumerate().for_each(|(i, row)| *row = i);
    columns.copy_from_slice(rows);
    let found = pivots(block, (&mut [], 0.0), rows, columns);
    match found.rank == size {
        true if size == 0 => 1.0,
        true => found.smallest,
        false => 0.0,
    }
}

/// The smaller pivot of two rows and columns.
fn least_of_two([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let largest = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
    let other = (a * d - b * c).abs() / largest;
    if other > 8.0 * f64::EPSILON * largest {
        other.min(largest)
    } else {
        0.0
    }
}

/// The square of what a column of the Jacobian is divided by.
pub(crate) fn heaviness(mass: f64) -> f64 {
    if mass != 0.0 && mass.is_finite() {
        // The squares of what is divided by it must not overflow: a rank would be lost that is there.
        mass.abs().clamp(1e-100, 1e100)
    } else {
        1.0
    }
}

/// What a column of the Jacobian is divided by.
pub(crate) fn scale(mass: f64) -> f64 {
    heaviness(mass).sqrt()
}

impl Chart {
    /// The rank found.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }
}

fn sorted_pairs(rows: &[usize], columns: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let mut pairs: Vec<(usize, usize)> =
        rows.iter().copied().zip(columns.iter().copied()).collect();
    pairs.sort_unstable();
    pairs.into_iter().unzip()
}

/// The scaled Jacobian, and what each entry was multiplied by.
fn scaled(jacobian: &[f64], r: usize, n: usize, mass_diagonal: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let mut a = jacobian.to_vec();
    let mut factors = vec![1.0; a.len()];
    let rows = a.chunks_mut(n.max(1)).zip(factors.chunks_mut(n.max(1)));
    for (row, factors) in rows.take(r) {
        for ((entry, factor), &mass) in row.iter_mut().zip(&mut *factors).zip(mass_diagonal) {
            *factor = 1.0 / scale(mass);
            *entry /= scale(mass);
        }
        let length = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            row.iter_mut().for_each(|x| *x /= length);
            factors.iter_mut().for_each(|x| *x /= length);
        }
    }
    (a, factors)
}

fn largest_entry(
    a: &[f64],
    rows: &[usize],
    columns: &[usize],
    rank: usize,
    n: usize,
) -> (usize, usize, f64) {
    let mut best = (rank, rank, -1.0);
    for (i, &row) in rows.iter().enumerate().skip(rank) {
        for (j, &column) in columns.iter().enumerate().skip(rank) {
            let value = a[row * n + column].abs();
            // A relative margin keeps the choice stable against rounding: ties go to the first.
            if value > best.2 * (1.0 + 1e-9) {
                best = (i, j, value);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_and_independent_velocities() {
        let jacobian = [1.0, 0.0, -0.3, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, -0.3, 0.0];
        let chart = choose(&jacobian, (3, 4), &[1.0; 4], Floor::Along(1.0));
        assert_eq!(chart.rank(), 2);
        assert_eq!(chart.independent.len(), 2);
    }

    #[test]
    fn the_choice_does_not_depend_on_row_scaling() {
        let jacobian = [0.3, -0.8, 0.1, 0.5, 0.2, 0.9];
        let chart = choose(&jacobian, (2, 3), &[1.0; 3], Floor::Along(1.0));
        let rescaled: Vec<f64> = jacobian
            .iter()
            .enumerate()
            .map(|(i, x)| if i < 3 { x * 1e6 } else { x * 1e-6 })
            .collect();
        let other = choose(&rescaled, (2, 3), &[1.0; 3], Floor::Along(1.0));
        assert_eq!(chart.dependent, other.dependent);
        assert!((chart.pivot - other.pivot).abs() < 1e-12);
    }

    /// A mass on the way to zero is no reason to take a constraint for vanished.
    #[test]
    fn the_rank_does_not_depend_on_tiny_masses() {
        for mass in [1e-300, 1e-310, 5e-324, 0.0, 1e300] {
            let (jacobian, diagonal) = ([-1e-3, 1.0], [mass, 2.0]);
            let chart = choose(&jacobian, (1, 2), &diagonal, Floor::Along(1.0));
            assert_eq!(chart.rank(), 1, "{mass:e}");
            assert!(
                quality(&chart, &jacobian, 2, |i| diagonal[i]) > 0.5,
                "{mass:e}"
            );
        }
    }

    #[test]
    fn a_turning_gradient_degrades_its_chart() {
        let at = |angle: f64| [angle.sin(), -angle.cos(), 0.0];
        let chart = choose(&at(0.0), (1, 3), &[1.0; 3], Floor::Along(1.0));
        assert_eq!(chart.dependent, vec![1]);
        assert!(quality(&chart, &at(1.5), 3, |_| 1.0) < 0.1);
    }
}
