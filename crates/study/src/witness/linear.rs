//! Variational equations along the computed motion: the positions that motions from one point reach, and the conjugate times of
//! the constrained extremum.

use super::algebra::{determinant, gram, null_space, solved};
use super::kappa::{multipliers, Kappa};
use super::samples::{Samples, LEAST};
use super::zeros::{ends_at_zero, zeros};
use chetaev_mechanics::claims::formulation::{basis, derive, REFERENCE};
use chetaev_mechanics::Context;
use chetaev_symbolic::{Expr, Symbol, Verdict};

/// More coordinates are too many.
pub(super) const COORDINATES: usize = 8;
/// Larger expressions, in nodes, are not compiled.
const LARGEST: usize = 30_000;
/// Steps of four rows at the start that are passed over.
const EARLY: usize = 8;
/// A volume below this part of that of the lengths counts as zero.
const FLAT: f64 = 1e-6;
/// Squared lengths below this part of the largest are none.
const NOTHING: f64 = 1e-24;

/// The positions that motions from the start reach at later times, to first order.
#[derive(Clone, Debug)]
pub struct Reach {
    /// n − r, the dimension for small times.
    pub dimension: usize,
    /// The least share of positions in the derivatives of (q, v) by the k admissible initial velocities, and when.
    pub least: (f64, f64),
    /// That at the end.
    pub at_end: f64,
    /// The interval.
    pub interval: (f64, f64),
}

/// Conjugate times of the extremum that the motion is.
#[derive(Clone, Debug)]
pub struct Conjugate {
    /// Whether `B^T F_vv B` is positive definite along the motion; if not, where it fails.
    pub legendre: Result<(), f64>,
    /// Conjugate times after the start and before the end, in order.
    pub times: Vec<f64>,
    /// Whether the end is one, to the accuracy of the values.
    pub at_end: bool,
    /// The interval.
    pub interval: (f64, f64),
    /// The determinant whose zeros conjugate times are, with its time; of any scale.
    pub determinants: Vec<(f64, f64)>,
    /// How many independent κ leave every coordinate where it is: of an abnormal extremal.
    pub abnormal: usize,
    /// κ(0) by name, where κ is that of the κ(0) stated.
    pub given: Vec<(String, f64)>,
}

/// The result, computed once.
pub(super) struct FoundConjugate(pub(super) Result<Conjugate, String>);

/// Conjugate times are looked for along a motion with κ, or on the leaf of integrable constraints.
pub(super) fn on_leaf(cx: &Context<'_>) -> bool {
    let rows = cx.selection.rows.iter();
    let mut constraints = rows.map(|&row| &cx.system.constraints[cx.terms.constraint_index[row]]);
    let integrable = cx.finding("model.constraints-integrable#weak");
    !cx.selection.rows.is_empty()
        && constraints.all(|c| c.gradient_constant)
        && matches!(integrable.verdict, Verdict::Proved(_))
}

fn small(cx: &Context<'_>, es: &[Expr]) -> Result<(), String> {
    match cx.system.graph.reachable(es).len() > LARGEST {
        true => Err("the variational equations are too large".into()),
        false => Ok(()),
    }
}

/// y' at a row.
type Rate<'a> = dyn Fn(usize, &[f64]) -> Option<Vec<f64>> + 'a;

/// One step of the rule of Runge and Kutta for `y' = rate(row, y)`, of the length h, over rows twice `stride` apart.
fn step(rate: &Rate<'_>, (row, stride): (usize, usize), h: f64, y: &[f64]) -> Option<Vec<f64>> {
    let moved =
        |k: &[f64], by: f64| -> Vec<f64> { y.iter().zip(k).map(|(x, k)| x + by * k).collect() };
    let k1 = rate(row, y)?;
    let k2 = rate(row + stride, &moved(&k1, h / 2.0))?;
    let k3 = rate(row + stride, &moved(&k2, h / 2.0))?;
    let k4 = rate(row + 2 * stride, &moved(&k3, h))?;
    let next = (0..y.len()).map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    let next: Vec<f64> = next.collect();
    next.iter().all(|x| x.is_finite()).then_some(next)
}

/// A step of the length h over four rows: two of half the length and one, extrapolated, so that the error is of the order h⁶.
fn extrapolated(rate: &Rate<'_>, row: usize, h: f64, y: &[f64]) -> Option<Vec<f64>> {
    let half = step(rate, (row, 1), h / 2.0, y)?;
    let fine = step(rate, (row + 2, 1), h / 2.0, &half)?;
    let coarse = step(rate, (row, 2), h, y)?;
    let pairs = fine.iter().zip(coarse);
    Some(pairs.map(|(a, b)| a + (a - b) / 15.0).collect())
}

/// `δv' = a_q δq + a_v δv`, `δq(t₀) = 0`, δv(t₀) in the directions that the constraints admit.
pub(super) fn reach(cx: &Context<'_>) -> Result<Reach, String> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let routh = derive(cx, REFERENCE).map_err(|problem| problem.to_string())?;
    let by = |symbols: &[Symbol]| g.jacobian(&routh.accelerations, symbols).concat();
    small(cx, &routh.accelerations)?;
    let by_coordinates = by(&system.coordinate_symbols());
    let by_velocities = by(&system.velocity_symbols());
    small(
        cx,
        &[by_coordinates.clone(), by_velocities.clone()].concat(),
    )?;
    let jacobian = basis(cx).jacobian().concat();
    let samples = Samples::new(cx, &[&by_coordinates, &by_velocities, &jacobian])?;
    let r = cx.selection.rows.len();
    let starts = null_space(samples.at(2, 0), r, n, 1e-12);
    let rate = |row: usize, y: &[f64]| {
        let (position, velocity) = y.split_at(n);
        let moved = super::algebra::times(samples.at(0, row), n, position)
            .into_iter()
            .zip(super::algebra::times(samples.at(1, row), n, velocity));
        Some(
            velocity
                .iter()
                .copied()
                .chain(moved.map(|(a, b)| a + b))
                .collect(),
        )
    };
    let mut states: Vec<Vec<f64>> = starts
        .iter()
        .map(|v| vec![0.0; n].into_iter().chain(v.iter().copied()).collect())
        .collect();
    let count = samples.intervals(2);
    let (t0, t1) = (samples.times[0], samples.times[count]);
    let h = 2.0 * (t1 - t0) / count as f64;
    let mut found = Reach {
        dimension: states.len(),
        least: (f64::INFINITY, t1),
        at_end: 0.0,
        interval: (t0, t1),
    };
    let mut sizes = (0.0, 0.0);
    for row in (0..count).step_by(2) {
        for y in &mut states {
            *y = step(&rate, (row, 1), h, y)
                .ok_or("the variational equations have no value at a row")?;
        }
        let share = share_of_positions(&states, n, &mut sizes);
        if share < found.least.0 {
            found.least = (share, samples.times[row + 2]);
        }
        found.at_end = share;
    }
    Ok(found)
}

/// `√(2^k det Q / det (Q + τ² V))` for the Gram matrices Q and V of positions and velocities, τ the largest length of positions
/// over that of velocities so far: about 1 for small times, zero where some initial velocity moves no position, whatever the
/// basis of initial velocities.
fn share_of_positions(states: &[Vec<f64>], n: usize, sizes: &mut (f64, f64)) -> f64 {
    let k = states.len();
    let part = |range: std::ops::Range<usize>| {
        let rows: Vec<f64> = states
            .iter()
            .flat_map(|y| y[range.clone()].to_vec())
            .collect();
        gram(&rows, k, n)
    };
    let (positions, velocities) = (part(0..n), part(n..2 * n));
    let size = |gram: &[f64]| (0..k).map(|i| gram[i * k + i]).fold(0.0_f64, f64::max);
    sizes.0 = sizes.0.max(size(&positions));
    sizes.1 = sizes.1.max(size(&velocities));
    let weight = sizes.0 / sizes.1;
    let pairs = positions.iter().zip(&velocities);
    let both: Vec<f64> = pairs.map(|(q, v)| q + weight * v).collect();
    let whole = determinant(k, &both);
    match whole > 0.0 {
        true => (2.0_f64.powi(k as i32) * determinant(k, &positions) / whole)
            .max(0.0)
            .sqrt(),
        false => 0.0,
    }
}

/// Whether a volume of [`Reach`] is that of dependent directions.
pub(super) fn is_flat(volume: f64) -> bool {
    volume < FLAT
}

/// The conjugate times of the computed motion.
pub(super) fn conjugate(cx: &Context<'_>) -> Result<Conjugate, String> {
    cx.shared(|cx| {
        FoundConjugate(match on_leaf(cx) {
            true => along_leaf(cx),
            false => compute(cx),
        })
    })
    .0
    .clone()
}

/// Second derivatives of `F = L + Σ κ f` with κ frozen, F_vv, F_vq, F_qq, then f_v and f_q, by row.
fn second_derivatives(cx: &Context<'_>, kappa: &Kappa) -> Result<Samples, String> {
    let (system, g) = (cx.system, &cx.system.graph);
    let basis = basis(cx);
    let constraints = basis.constraints();
    let (q, v) = (system.coordinate_symbols(), system.velocity_symbols());
    let of = |e: Expr| -> [Vec<Expr>; 3] {
        let (by_q, by_v) = (g.gradient(e, &q), g.gradient(e, &v));
        [
            g.jacobian(&by_v, &v).concat(),
            g.jacobian(&by_v, &q).concat(),
            g.jacobian(&by_q, &q).concat(),
        ]
    };
    let mut parts: Vec<Vec<Expr>> = of(system.lagrangian).to_vec();
    parts.push(basis.jacobian().concat());
    parts.push(g.jacobian(&constraints, &q).concat());
    let first = parts.len();
    for &f in &constraints {
        parts.extend(of(f));
    }
    small(cx, &parts.concat())?;
    let groups: Vec<&[Expr]> = parts.iter().map(Vec::as_slice).collect();
    let mut samples = Samples::new(cx, &groups)?;
    for l in 0..constraints.len() {
        for place in 0..3 {
            samples.add(place, first + 3 * l + place, &|row| kappa.at(row)[l]);
        }
    }
    Ok(samples)
}

/// The linearized extremum in (η, ζ): `F_vv η' + fᵥᵀ δκ = ζ − F_vq η`, `fᵥ η' = −f_q η`, `ζ' = F_qv η' + F_qq η + f_qᵀ δκ`. η starts
/// at zero with every ζ; a conjugate time is one at which the n values of η are dependent. Solutions with η = 0 and δκ ≠ 0 are those
/// of an abnormal extremal: they do not count, and the ζ of each is a normal of all η.
fn compute(cx: &Context<'_>) -> Result<Conjugate, String> {
    let n = cx.system.n();
    let kappa = multipliers(cx)?;
    let samples = second_derivatives(cx, &kappa)?;
    let r = cx.selection.rows.len();
    let rate = |row: usize, y: &[f64]| linearized(&samples, (n, r), row, y);
    let starting = |directions: &[Vec<f64>]| -> Vec<Vec<f64>> {
        let zeta = directions.iter();
        zeta.map(|zeta| [vec![0.0; n], zeta.clone()].concat())
            .collect()
    };
    let unit = |j: usize| (0..n).map(|i| f64::from(u8::from(i == j))).collect();
    let mut states = starting(&(0..n).map(unit).collect::<Vec<Vec<f64>>>());
    let all = |_: usize, states: &[Vec<f64>]| positions(states, n);
    let (mut found, gram) = followed(&samples, (n, r), (&rate, &all), &mut states)?;
    let abnormal = abnormal(&gram, n);
    if !abnormal.is_empty() {
        let normal = null_space(&abnormal.concat(), abnormal.len(), n, 1e-12);
        let count = normal.len();
        let mut states = starting(&[normal, abnormal.clone()].concat());
        let beside = |_: usize, states: &[Vec<f64>]| {
            let mut rows = positions(&states[..count], n);
            rows.extend(states[count..].iter().flat_map(|y| y[n..].to_vec()));
            rows
        };
        found = followed(&samples, (n, r), (&rate, &beside), &mut states)?.0;
    }
    Ok(Conjugate {
        abnormal: abnormal.len(),
        given: kappa.given,
        ..found
    })
}

/// The first n components of vectors of 2n, one after the other.
fn positions(states: &[Vec<f64>], n: usize) -> Vec<f64> {
    states.iter().flat_map(|y| y[..n].to_vec()).collect()
}

/// Combinations of variations that move no coordinate at any time, by the sum of their Gram matrices.
fn abnormal(gram: &[f64], n: usize) -> Vec<Vec<f64>> {
    let largest = (0..n).fold(0.0_f64, |m, i| m.max(gram[i * n + i]));
    // Lengths of different units are compared with themselves.
    let length = |i: usize| match gram[i * n + i] > NOTHING * largest {
        true => gram[i * n + i].sqrt(),
        false => largest.sqrt(),
    };
    let scaled: Vec<f64> = (0..n * n)
        .map(|place| gram[place] / (length(place / n) * length(place % n)))
        .collect();
    let found = null_space(&scaled, n, n, FLAT * FLAT);
    let unscaled = |vector: Vec<f64>| (0..n).map(|i| vector[i] / length(i)).collect();
    found.into_iter().map(unscaled).collect()
}

/// Motions that start beside the computed one from its position, on the leaf of integrable constraints affine in the velocities: there
/// the motions are the extremals of L, and κ takes no part. With k variations of the position that satisfy `f_v η = 0` a conjugate
/// time is one at which they, beside the r gradients f_v, are dependent.
fn along_leaf(cx: &Context<'_>) -> Result<Conjugate, String> {
    let (system, g, n) = (cx.system, &cx.system.graph, cx.system.n());
    let routh = derive(cx, REFERENCE).map_err(|problem| problem.to_string())?;
    let by = |symbols: &[Symbol]| g.jacobian(&routh.accelerations, symbols).concat();
    let parts = [
        cx.terms.mass_matrix.concat(),
        by(&system.coordinate_symbols()),
        by(&system.velocity_symbols()),
        basis(cx).jacobian().concat(),
    ];
    small(cx, &parts.concat())?;
    let groups: Vec<&[Expr]> = parts.iter().map(Vec::as_slice).collect();
    let samples = Samples::new(cx, &groups)?;
    let r = cx.selection.rows.len();
    let rate = |row: usize, y: &[f64]| {
        let (position, velocity) = y.split_at(n);
        let by_position = super::algebra::times(samples.at(1, row), n, position);
        let by_velocity = super::algebra::times(samples.at(2, row), n, velocity);
        let moved = by_position.into_iter().zip(by_velocity).map(|(a, b)| a + b);
        Some(velocity.iter().copied().chain(moved).collect())
    };
    let starts = null_space(samples.at(3, 0), r, n, 1e-12);
    let mut states: Vec<Vec<f64>> = starts
        .iter()
        .map(|v| vec![0.0; n].into_iter().chain(v.iter().copied()).collect())
        .collect();
    let with_normals = |row: usize, states: &[Vec<f64>]| {
        let mut rows = positions(states, n);
        rows.extend(samples.at(3, row));
        rows
    };
    followed(&samples, (n, r), (&rate, &with_normals), &mut states).map(|(found, _)| found)
}

/// An n × n matrix of variations at a row, which is singular at conjugate times.
type Rows<'a> = dyn Fn(usize, &[Vec<f64>]) -> Vec<f64> + 'a;

/// Variations followed along the motion: conjugate times, and the sum of the Gram matrices of what they move. F_vv is the group 0 of the
/// samples, f_v the group 3.
fn followed(
    samples: &Samples,
    (n, r): (usize, usize),
    (rate, matrix): (&Rate<'_>, &Rows<'_>),
    states: &mut [Vec<f64>],
) -> Result<(Conjugate, Vec<f64>), String> {
    let count = samples.intervals(4);
    if count < LEAST {
        return Err("there are too few output times".into());
    }
    let (t0, t1) = (samples.times[0], samples.times[count]);
    let h = 4.0 * (t1 - t0) / count as f64;
    let mut found = Conjugate {
        legendre: Ok(()),
        times: Vec::new(),
        at_end: false,
        interval: (t0, t1),
        determinants: Vec::new(),
        abnormal: 0,
        given: Vec::new(),
    };
    let mut determinants: Vec<(f64, f64)> = Vec::new();
    let k = states.len();
    let mut grams = vec![0.0; k * k];
    for row in (0..count).step_by(4) {
        let fails = |row: &usize| !is_positive(samples, (n, r), *row);
        if found.legendre.is_ok() {
            if let Some(failing) = [row, row + 2].into_iter().find(fails) {
                found.legendre = Err(samples.times[failing]);
            }
        }
        for y in states.iter_mut() {
            *y = extrapolated(rate, row, h, y)
                .ok_or("the linearized extremum is singular at a row")?;
        }
        let rows = matrix(row + 4, states);
        determinants.push((samples.times[row + 4], determinant(n, &rows)));
        let moved = gram(&positions(states, n), k, n);
        grams.iter_mut().zip(moved).for_each(|(sum, x)| *sum += x);
    }
    // Near the start all η are small, and the sign of their determinant is rounding.
    let later = &determinants[EARLY.min(determinants.len())..];
    found.times = zeros(later, n);
    found.at_end = ends_at_zero(later);
    if found.at_end {
        found.times.retain(|t| t1 - t > h / 2.0);
    }
    found.determinants = determinants;
    Ok((found, grams))
}

fn linearized(
    samples: &Samples,
    (n, r): (usize, usize),
    row: usize,
    y: &[f64],
) -> Option<Vec<f64>> {
    use super::algebra::{times, transposed_times};
    let (eta, zeta) = y.split_at(n);
    let of = |group: usize| samples.at(group, row);
    let size = n + r;
    let mut matrix = vec![0.0; size * size];
    for i in 0..n {
        for j in 0..n {
            matrix[i * size + j] = of(0)[i * n + j];
        }
        for l in 0..r {
            matrix[i * size + n + l] = of(3)[l * n + i];
            matrix[(n + l) * size + i] = of(3)[l * n + i];
        }
    }
    let mixed = times(of(1), n, eta);
    let right = zeta.iter().zip(mixed).map(|(a, b)| a - b);
    let right = right.chain(times(of(4), n, eta).into_iter().map(|x| -x));
    let solution = solved(size, &matrix, &right.collect::<Vec<f64>>())?;
    let (rates, kappa) = solution.split_at(n);
    let moved = transposed_times(of(1), n, rates)
        .into_iter()
        .zip(times(of(2), n, eta))
        .zip(transposed_times(of(4), n, kappa))
        .map(|((a, b), c)| a + b + c);
    Some(rates.iter().copied().chain(moved).collect())
}

/// Whether F_vv is positive on the null space of f_v at a row.
fn is_positive(samples: &Samples, (n, r): (usize, usize), row: usize) -> bool {
    let directions = null_space(samples.at(3, row), r, n, 1e-12);
    let products: Vec<Vec<f64>> = directions
        .iter()
        .map(|b| super::algebra::times(samples.at(0, row), n, b))
        .collect();
    let k = directions.len();
    let form: Vec<f64> = directions
        .iter()
        .flat_map(|a| {
            products
                .iter()
                .map(move |b| a.iter().zip(b).map(|(x, y)| x * y).sum())
        })
        .collect();
    (1..=k).all(|size| {
        let minor: Vec<f64> = (0..size)
            .flat_map(|i| form[i * k..i * k + size].to_vec())
            .collect();
        determinant(size, &minor) > 0.0
    })
}
