//! Deterministic sample states in double precision, for heuristic choices only: never evidence of a claim.

mod on_motion;
mod positions;

pub use on_motion::on_motion;

use crate::system::{Coordinate, Relation, System};
use crate::terms::MotionTerms;
use chetaev_symbolic::{Expr, Graph, Node, Symbol};
use positions::Finite;
use std::collections::BTreeMap;

/// A tiny deterministic generator (splitmix64; Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub struct Generator(u64);

impl Generator {
    /// A generator with the given seed.
    pub fn new(seed: u64) -> Generator {
        Generator(seed)
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        low + unit * (high - low)
    }
}

/// A state with values for every symbol of a system.
pub type Point = BTreeMap<Symbol, f64>;

/// The seed of the state at which independent constraints and dependent coordinates are chosen: where one is found once it is found again.
pub const SEED: u64 = 0x0c4e_7ae5;

/// Draws a regular state that satisfies the constraints to rounding, finite ones included, within simple bounds of the assumptions;
/// `None` when two hundred draws fail, and as many with more patience. Later draws reach further in the velocities and less
/// far in the positions, as some constraints need. A state at which the gradient of a constraint vanishes, as that of x'^2 + y'^2 = 0 does wherever it
/// holds, or one of its roots, which then has no slope, is not regular.
pub fn admissible_point(system: &System, terms: &MotionTerms, seed: u64) -> Option<Point> {
    [STEPS, PATIENT_STEPS]
        .into_iter()
        .find_map(|steps| drawn(system, terms, seed, steps))
}

/// Whether a state is found at which all constraints hold, those of positions themselves and not only their derivatives.
pub fn is_regular(system: &System, terms: &MotionTerms) -> bool {
    let Some(mut point) = admissible_point(system, terms, SEED) else {
        return false;
    };
    Finite::of(system, terms).is_none_or(|set| set.reach(system, &mut point))
}

/// Newton steps that nearly every search needs.
const STEPS: usize = 60;

/// The ridge of a root of squares is climbed in many small steps.
const PATIENT_STEPS: usize = 400;

fn drawn(system: &System, terms: &MotionTerms, seed: u64, steps: usize) -> Option<Point> {
    let mut generator = Generator::new(seed);
    let roots = radicands(&system.graph, &terms.constraints);
    let mut finite = Finite::of(system, terms);
    let mut missed = 0;
    (0..200).find_map(|attempt| {
        let (place, reach) = match attempt {
            0..10 => (1.0, 1.0),
            _ => (0.5_f64.powi(attempt / 5 % 4), 2.0_f64.powi(attempt % 5)),
        };
        let mut point = free_point(system, terms, place, &mut generator)?;
        for c in &terms.jets {
            point.entry(c.v_symbol).and_modify(|v| *v *= reach);
        }
        if let Some(set) = &finite {
            if !set.reach(system, &mut point) {
                missed += 1;
                // Nothing seems to lie on the set within reach; velocities are looked at all the same.
                if missed == MOST_MISSED {
                    finite = None;
                }
                return None;
            }
        }
        let usual = usual_gradients(system, terms, &point, seed.wrapping_add(attempt as u64))?;
        let sizes = values(system, &roots, &point)?;
        if !project_velocities(system, terms, &mut point, steps) {
            return None;
        }
        let after = gradient_norms(system, terms, &point)?;
        let left = values(system, &roots, &point)?;
        let is_regular = usual.iter().zip(&after).all(|(u, a)| *a > 1e-4 * u);
        let has_slopes = sizes
            .iter()
            .zip(&left)
            .all(|(u, a)| a.abs() > 1e-8 * u.abs());
        (is_regular && has_slopes).then_some(point)
    })
}

/// The set of positions is given up after so many draws from which it was not reached.
const MOST_MISSED: usize = 30;

/// The rank that the gradients of the constraints by the velocities have at almost all states of the set of positions near the position
/// q: the largest at some neighbours. `None` where nothing is found out.
pub fn rank_near(system: &System, terms: &MotionTerms, state: &Point) -> Option<usize> {
    let finite = Finite::of(system, terms)?;
    let mut generator = Generator::new(0x6e65_6172);
    let (n, r) = (system.n(), terms.constraints.len());
    let ranks = (0..NEIGHBOURS).filter_map(|_| {
        let next = finite.neighbour(system, state, 1e-2, &mut generator)?;
        let entries = values(system, &terms.jacobian.concat(), &next)?;
        let cost = vec![vec![0; n]; r];
        Some(crate::selection::eliminate(entries, cost, n).rows.len())
    });
    ranks.max()
}

/// Neighbours that are looked at.
const NEIGHBOURS: usize = 5;

/// The largest residuals of the constraints that `rows` leave out at states that satisfy those of `rows`, where all finite constraints hold: relative
/// to their gradients and velocities, at how many states. `None` where no state is found.
pub fn left_out_residual(
    system: &System,
    terms: &MotionTerms,
    rows: &[usize],
) -> Option<(f64, u32)> {
    let keep = |row: &usize| rows.contains(row);
    let mut own = terms.clone();
    let of = |list: &[Expr]| -> Vec<Expr> { rows.iter().map(|&row| list[row]).collect() };
    own.constraints = of(&terms.constraints);
    own.constraint_rate = of(&terms.constraint_rate);
    own.jacobian = rows
        .iter()
        .map(|&row| terms.jacobian[row].clone())
        .collect();
    let others: Vec<usize> = (0..terms.constraints.len())
        .filter(|row| !keep(row))
        .collect();
    let residuals: Vec<Expr> = others.iter().map(|&row| terms.constraints[row]).collect();
    let (mut largest, mut count) = (0.0_f64, 0);
    for seed in 0..8 {
        let Some(mut point) = admissible_point(system, terms, 0x1ef7 + seed) else {
            continue;
        };
        let mut generator = Generator::new(seed ^ 0x0a11);
        for c in &terms.jets {
            let v = generator.between(-1.3, 1.3);
            point.entry(c.v_symbol).and_modify(|own| *own = v);
        }
        if !project_velocities(system, &own, &mut point, STEPS) {
            continue;
        }
        let Some(found) = values(system, &residuals, &point) else {
            continue;
        };
        let Some(norms) = gradient_norms(system, terms, &point) else {
            continue;
        };
        let speeds = terms.jets.iter().filter_map(|c| point.get(&c.v_symbol));
        let speed = speeds.fold(1.0, |m: f64, v| m.max(v.abs()));
        for (&row, f) in others.iter().zip(&found) {
            largest = largest.max(f.abs() / (norms[row].max(1e-300) * speed));
        }
        count += 1;
    }
    (count > 0).then_some((largest, count))
}

fn values(system: &System, es: &[Expr], point: &Point) -> Option<Vec<f64>> {
    let values = system.graph.evaluate_f64(es, &|s| point.get(&s).copied());
    values.ok()
}

/// The bases of powers with exponents that are no whole numbers.
pub fn radicands(g: &Graph, es: &[Expr]) -> Vec<Expr> {
    let mut found = Vec::new();
    for e in g.reachable(es) {
        if let Node::Power { base, exponent } = g.node(e) {
            let is_root = g.as_number(*exponent).is_some() && g.as_integer(*exponent).is_none();
            if is_root && g.as_number(*base).is_none() && !found.contains(base) {
                found.push(*base);
            }
        }
    }
    found
}

/// The largest lengths of gradients at several velocities at the position of a point; from place to place they may differ by
/// any factor.
fn usual_gradients(
    system: &System,
    terms: &MotionTerms,
    point: &Point,
    seed: u64,
) -> Option<Vec<f64>> {
    let mut usual = gradient_norms(system, terms, point)?;
    let mut generator = Generator::new(seed ^ 0x6772_6164);
    let mut other = point.clone();
    for _ in 0..VELOCITIES {
        for c in &terms.jets {
            let v = generator.between(-1.3, 1.3);
            other.entry(c.v_symbol).and_modify(|own| *own = v);
        }
        let norms = gradient_norms(system, terms, &other).unwrap_or_default();
        for (usual, norm) in usual.iter_mut().zip(norms) {
            if norm.is_finite() {
                *usual = norm.max(*usual);
            }
        }
    }
    Some(usual)
}

/// Velocities at which the size of gradients is looked at.
const VELOCITIES: usize = 6;

/// The lengths of the gradients ∂f/∂v, one per constraint.
fn gradient_norms(system: &System, terms: &MotionTerms, point: &Point) -> Option<Vec<f64>> {
    let entries = terms.jacobian.concat();
    let values = values(system, &entries, point)?;
    let norm = |row: &[f64]| row.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(values.chunks(system.n().max(1)).map(norm).collect())
}

/// A state whose positions lie within `place` of the half-width of their bounds.
fn free_point(
    system: &System,
    terms: &MotionTerms,
    place: f64,
    generator: &mut Generator,
) -> Option<Point> {
    let g = &system.graph;
    let mut point = Point::new();
    let known: BTreeMap<Symbol, f64> = system
        .parameters
        .iter()
        .filter_map(|p| {
            let value = g.evaluate_f64(&[p.value?], &|_| None).ok()?;
            Some((g.as_symbol(p.expr)?, value[0]))
        })
        .collect();
    let mut roots: Vec<Expr> = terms.mass_matrix.concat();
    roots.extend(terms.jacobian.concat());
    roots.extend(&terms.force);
    roots.extend(&terms.constraint_rate);
    roots.extend(&terms.constraints);
    roots.extend(
        system
            .coordinates
            .iter()
            .chain(&terms.jets)
            .flat_map(|c| [c.q, c.v]),
    );
    // A finite constraint may contain a parameter that its derivative does not, and a frame the time or parameters that nothing else contains.
    roots.extend(system.constraints.iter().map(|own| own.stated));
    roots.extend(system.quasi_velocities.iter().map(|quasi| quasi.definition));
    if let Some(frame) = &system.frame {
        roots.extend(frame.fields.concat());
        roots.extend(&frame.drift);
    }
    for symbol in g.symbols_in(&roots) {
        let value = match known.get(&symbol) {
            Some(&value) => value,
            None => {
                // Masses are positive, as most parameters are.
                let is_parameter = system.masses.iter().any(|m| m.symbol == symbol)
                    || system
                        .parameters
                        .iter()
                        .any(|p| g.as_symbol(p.expr) == Some(symbol));
                let (low, high) = bounds(
                    system,
                    symbol,
                    if is_parameter {
                        (0.5, 2.0)
                    } else {
                        (-1.3, 1.3)
                    },
                );
                let value = generator.between(low, high);
                let is_position = system.coordinates.iter().any(|c| c.q_symbol == symbol);
                let middle = 0.5 * (low + high);
                match is_position && place < 1.0 {
                    true => middle + place * (value - middle),
                    false => value,
                }
            }
        };
        point.insert(symbol, value);
    }
    Some(point)
}

/// A row over its largest entry.
pub fn scaled(row: &[f64]) -> Vec<f64> {
    let scale = row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    row.iter().map(|x| x / scale).collect()
}

/// The smallest pivot of Gauss's elimination with the largest entry of what is left as pivot; 0 for a matrix without finite entries.
pub fn least_pivot(mut rows: Vec<Vec<f64>>) -> f64 {
    let largest = |row: &[f64]| row.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    let mut least = f64::INFINITY;
    while !rows.is_empty() {
        let sizes = rows.iter().map(|row| largest(row)).enumerate();
        let Some((i, pivot)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else {
            break;
        };
        if pivot.is_nan() || pivot <= 0.0 {
            return 0.0;
        }
        least = least.min(pivot);
        let own = rows.swap_remove(i);
        let column = own.iter().position(|x| x.abs() == pivot).unwrap_or(0);
        for row in &mut rows {
            let factor = row[column] / own[column];
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
        }
    }
    least
}

/// Bounds of a symbol that assumptions of the form `number < symbol < number` state.
fn bounds(system: &System, symbol: Symbol, default: (f64, f64)) -> (f64, f64) {
    let g = &system.graph;
    let (mut low, mut high): (Option<f64>, Option<f64>) = (None, None);
    let value = |e: Expr| g.evaluate_f64(&[e], &|_| None).ok().map(|v| v[0]);
    for assumption in &system.assumptions {
        if assumption.relation == Relation::NotEqual {
            continue;
        }
        if g.as_symbol(assumption.right) == Some(symbol) {
            low = match (low, value(assumption.left)) {
                (Some(a), Some(b)) => Some(a.max(b)),
                (a, b) => a.or(b),
            };
        }
        if g.as_symbol(assumption.left) == Some(symbol) {
            high = match (high, value(assumption.right)) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
        }
    }
    match (low, high) {
        (None, None) => default,
        (Some(low), None) => (low + 0.1, low + 0.1 + default.1.abs()),
        (None, Some(high)) => (high - 0.1 - default.1.abs(), high - 0.1),
        (Some(low), Some(high)) => (low + 0.05 * (high - low), high - 0.05 * (high - low)),
    }
}

/// Newton steps of least kinetic norm on the velocities, halved until they help, until every constraint is satisfied.
fn project_velocities(
    system: &System,
    terms: &MotionTerms,
    point: &mut Point,
    steps: usize,
) -> bool {
    if terms.constraints.is_empty() {
        return true;
    }
    let (n, r) = (system.n(), terms.constraints.len());
    let mut roots = terms.constraints.clone();
    roots.extend(terms.jacobian.concat());
    let values_at = |point: &Point| {
        let values = system
            .graph
            .evaluate_f64(&roots, &|s| point.get(&s).copied())
            .ok()?;
        values.iter().all(|v| v.is_finite()).then_some(values)
    };
    let size = |values: &[f64]| values[..r].iter().map(|x| x * x).sum::<f64>();
    let Some(mut values) = values_at(point) else {
        return false;
    };
    let mut w = kinetic_matrix(system, terms, point);
    let mut metric = w.as_deref().and_then(|w| KineticMetric::of(w, n));
    for _ in 0..steps {
        let (f, jacobian) = values.split_at(r);
        let speed = |c: &Coordinate| point.get(&c.v_symbol).copied().unwrap_or(0.0);
        let speeds: Vec<f64> = terms.jets.iter().map(speed).collect();
        if is_satisfied(f, jacobian, &speeds) {
            return true;
        }
        let step = match &metric {
            Some(metric) => metric.least_step(jacobian, f, n),
            None => least_norm_step(jacobian, f, n),
        };
        let next = (0..6).find_map(|halving| {
            let mut next = point.clone();
            for (c, dv) in terms.jets.iter().zip(&step) {
                if let Some(v) = next.get_mut(&c.v_symbol) {
                    *v -= dv * 0.5_f64.powi(halving);
                }
            }
            let found = values_at(&next)?;
            (size(&found) < size(&values)).then_some((next, found))
        });
        let Some((next, found)) = next else {
            return false;
        };
        if let (true, Some(w)) = (steps > STEPS, &mut w) {
            add_weights(w, &found[r..], &values[r..], n);
            metric = KineticMetric::of(w, n);
        }
        (*point, values) = (next, found);
    }
    false
}

/// Whether constraints vanish beside what the largest velocity changes in them, each in its own units.
fn is_satisfied(f: &[f64], jacobian: &[f64], speeds: &[f64]) -> bool {
    let rows = jacobian.chunks(speeds.len().max(1));
    let fastest = speeds.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    f.iter().zip(rows).all(|(f, row)| {
        let slopes: f64 = row.iter().map(|j| j.abs()).sum();
        f.abs() <= 1e-11 * slopes * fastest
    })
}

/// Directions in which gradients are seen to change count ten times as heavy from then on.
fn add_weights(w: &mut [f64], new: &[f64], old: &[f64], n: usize) {
    let weight = 10.0 * w.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if weight > HEAVIEST {
        return;
    }
    for (new, old) in new.chunks(n).zip(old.chunks(n)) {
        add_weight(w, new, old, weight);
    }
}

/// Adds `weight d dᵀ` to a metric, d the unit vector of the change of a gradient: steps of least length then follow the ridge
/// of a root of squares instead of crossing it to and fro.
pub fn add_weight(metric: &mut [f64], new: &[f64], old: &[f64], weight: f64) {
    let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
    let change: Vec<f64> = new.iter().zip(old).map(|(a, b)| a - b).collect();
    let length = norm(&change);
    if length <= 1e-6 * norm(old) || !length.is_finite() {
        return;
    }
    for (row, &a) in metric.chunks_mut(change.len()).zip(&change) {
        for (entry, &b) in row.iter_mut().zip(&change) {
            *entry += weight * (a / length) * (b / length);
        }
    }
}

/// Beyond this a metric is no longer factored well.
const HEAVIEST: f64 = 1e8;

/// The entries of W at a state.
fn kinetic_matrix(system: &System, terms: &MotionTerms, point: &Point) -> Option<Vec<f64>> {
    values(system, &terms.mass_matrix.concat(), point)
}

/// W = L Lᵀ at a state: lengths measured by it do not depend on the choice of coordinates, so that a search which ends
/// in one choice ends in all.
struct KineticMetric {
    /// L, row by row.
    factor: Vec<Vec<f64>>,
}

impl KineticMetric {
    /// `None` where W is not positive definite.
    fn of(w: &[f64], n: usize) -> Option<KineticMetric> {
        let mut factor = vec![vec![0.0; n]; n];
        for i in 0..n {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let rest = w[i * n + j] - known;
                if i == j {
                    (rest > 1e-12 * w[i * n + i].abs()).then_some(())?;
                    factor[i][i] = rest.sqrt();
                } else {
                    factor[i][j] = rest / factor[j][j];
                }
            }
        }
        Some(KineticMetric { factor })
    }

    /// The solution of `J x = f` for which xᵀ W x is least: x = L⁻ᵀ y with the least-norm solution y of `J L⁻ᵀ y = f`.
    fn least_step(&self, jacobian: &[f64], f: &[f64], n: usize) -> Vec<f64> {
        // A row of J L⁻ᵀ solves L z = Jᵀ by forward substitution.
        let mut rows = Vec::with_capacity(jacobian.len());
        for row in jacobian.chunks(n) {
            let mut z = row.to_vec();
            for i in 0..n {
                let known: f64 = (0..i).map(|k| self.factor[i][k] * z[k]).sum();
                z[i] = (z[i] - known) / self.factor[i][i];
            }
            rows.extend(z);
        }
        let mut x = least_norm_step(&rows, f, n);
        for i in (0..n).rev() {
            let known: f64 = (i + 1..n).map(|k| self.factor[k][i] * x[k]).sum();
            x[i] = (x[i] - known) / self.factor[i][i];
        }
        x
    }
}

/// The least-norm solution of `J x = f` by modified Gram–Schmidt on the rows of J, dependent rows skipped.
fn least_norm_step(jacobian: &[f64], f: &[f64], n: usize) -> Vec<f64> {
    let mut basis: Vec<(Vec<f64>, f64)> = Vec::new();
    for (row, &target) in jacobian.chunks(n).zip(f) {
        let norm = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut direction = row.to_vec();
        let mut value = target;
        for (unit, component) in &basis {
            let along: f64 = direction.iter().zip(unit).map(|(a, b)| a * b).sum();
            direction
                .iter_mut()
                .zip(unit)
                .for_each(|(a, b)| *a -= along * b);
            value -= along * component;
        }
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 1e-10 * norm.max(1e-300) {
            direction.iter_mut().for_each(|x| *x /= length);
            basis.push((direction, value / length));
        }
    }
    let mut step = vec![0.0; n];
    for (unit, component) in basis {
        step.iter_mut()
            .zip(unit)
            .for_each(|(x, u)| *x += component * u);
    }
    step
}
