//! Whether the hypotheses of a formulation hold, seen in double precision at sampled states.
//!
//! Nothing here is taken from the claims: ranks are those of evaluated matrices, the form of L and of the constraints is
//! seen from differences of their values.

use super::numbers::{moved, rank, values, Rank, Size};
use super::Sampled;
use chetaev_mechanics::sample::Point;
use chetaev_mechanics::{mass, Characteristics, Selection, System};
use chetaev_symbolic::{Expr, Graph, Symbol};

/// What double precision says of a hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// It holds.
    Holds,
    /// It fails.
    Fails,
    /// Neither can be told, or the hypothesis is not known here.
    Unclear,
}

/// Whether the hypothesis with this claim id holds.
pub(super) fn seen(subject: &Sampled<'_>, id: &str) -> Seen {
    match id {
        "model.accelerations-unique" => regular(subject, &bordered(subject), &subject.states),
        "model.hessian-regular" => {
            regular(subject, &subject.cx.terms.mass_matrix, &subject.free_states)
        }
        "model.restricted-hessian-regular" => restricted_hessian_by_any(subject),
        "model.frame-regular" => regular(subject, &frame(subject), &subject.states),
        "model.forces-absent" => vanish(
            subject,
            &subject.cx.system.all_forces(),
            &subject.free_states,
        ),
        "model.lagrangian-autonomous" => without_time(subject, &[subject.cx.system.lagrangian]),
        "model.lagrangian-quadratic" => quadratic(subject),
        "model.lagrangian-even" => even(subject),
        "model.constraints-homogeneous" => homogeneous(subject),
        "model.constraints-scleronomic" => {
            let constraints = subject.cx.system.constraints.iter();
            let stated: Vec<Expr> = constraints.map(|c| c.stated).collect();
            without_time(subject, &stated)
        }
        "model.chaplygin" => chaplygin(subject),
        "model.masses-free-of-velocity" => {
            masses_of(subject, &velocities(subject.cx.system), false)
        }
        "model.masses-of-time" => {
            let mut symbols = velocities(subject.cx.system);
            symbols.extend(subject.cx.system.coordinate_symbols());
            masses_of(subject, &symbols, true)
        }
        "model.particles" => particles(subject),
        "model.bodies" if subject.cx.system.mechanism.is_none() => Seen::Fails,
        "model.cartesian-coordinates" => cartesian(subject.cx.system),
        _ => Seen::Unclear,
    }
}

fn zero(size: Size) -> Seen {
    match size {
        Size::Zero => Seen::Holds,
        Size::NotZero => Seen::Fails,
        Size::Unclear => Seen::Unclear,
    }
}

fn vanish(subject: &Sampled<'_>, es: &[Expr], states: &[Point]) -> Seen {
    let all = values(subject, es, states);
    zero(Size::of(all.iter().flatten().map(|&x| (x, 1.0))))
}

/// A matrix that is singular at every state is singular; one state where it is not is enough for the contrary.
pub(super) fn regular(subject: &Sampled<'_>, matrix: &[Vec<Expr>], states: &[Point]) -> Seen {
    let n = matrix.len();
    regular_values(&values(subject, &matrix.concat(), states), n)
}

fn regular_values(matrices: &[Vec<f64>], n: usize) -> Seen {
    let mut seen = Seen::Unclear;
    for matrix in matrices {
        match rank(matrix.clone(), n) {
            Rank::Full => return Seen::Holds,
            Rank::Short => seen = Seen::Fails,
            Rank::Unclear => return Seen::Unclear,
        }
    }
    seen
}

/// `[[W, Jᵀ], [J, 0]]`.
fn bordered(subject: &Sampled<'_>) -> Vec<Vec<Expr>> {
    let (terms, rows) = (subject.cx.terms, &subject.cx.selection.rows);
    let g = &subject.cx.system.graph;
    let mut matrix = terms.mass_matrix.clone();
    for (i, line) in matrix.iter_mut().enumerate() {
        line.extend(rows.iter().map(|&row| terms.jacobian[row][i]));
    }
    for &row in rows {
        let mut line = terms.jacobian[row].clone();
        line.resize(line.len() + rows.len(), g.zero());
        matrix.push(line);
    }
    matrix
}

/// Whether ∂²L̄/∂v∂v is regular by some choice of independent velocities.
fn restricted_hessian_by_any(subject: &Sampled<'_>) -> Seen {
    let (cx, usual) = (subject.cx, &subject.natural);
    let mut found = restricted_hessian(subject, usual);
    for bits in 0..1_u32 << cx.system.n().min(16) {
        if found == Seen::Holds || bits.count_ones() as usize != usual.dependent.len() {
            continue;
        }
        let other = Selection {
            rows: usual.rows.clone(),
            dependent: (0..cx.system.n()).filter(|i| bits >> i & 1 == 1).collect(),
        };
        let chart = Characteristics::independent_velocities(cx.system, cx.terms, &other);
        // Velocities that cannot be solved for are no choice.
        found = match chart.map(|chart| restricted_hessian(subject, &chart)) {
            Ok(Seen::Holds) => Seen::Holds,
            Ok(Seen::Unclear) => Seen::Unclear,
            Ok(Seen::Fails) | Err(_) => found,
        };
    }
    found
}

/// The second derivatives of L(q, v_s, φ(q, v_s, t), t) by v_s: `Bᵀ (W - Σ_l μ_l ∂²f^l/∂v∂v) B` with
/// `Σ_l μ_l ∂f^l/∂v_d = ∂L/∂v_d`, as `∂²φ` follows from f = 0 differentiated twice.
pub(super) fn restricted_hessian(subject: &Sampled<'_>, chart: &Characteristics) -> Seen {
    let (system, terms) = (subject.cx.system, subject.cx.terms);
    let g = &system.graph;
    let velocities = system.velocity_symbols();
    let (n, k) = (system.n(), chart.k());
    let p = g.gradient(system.lagrangian, &velocities);
    let columns: Vec<Expr> = chart
        .dependent
        .iter()
        .flat_map(|&d| chart.rows.iter().map(move |&row| terms.jacobian[row][d]))
        .collect();
    let right: Vec<Expr> = chart.dependent.iter().map(|&d| p[d]).collect();
    let mu = match right.is_empty() {
        true => Vec::new(),
        false => match g.solve(&columns, &right) {
            Ok(mu) => mu,
            Err(_) => return Seen::Unclear,
        },
    };
    let mut all = terms.mass_matrix.concat();
    let mut curvature = vec![Vec::new(); n * n];
    for (&row, &mu) in chart.rows.iter().zip(&mu) {
        let second = g.jacobian(&terms.jacobian[row], &velocities).concat();
        for (parts, e) in curvature.iter_mut().zip(second) {
            parts.push(g.mul(&[mu, e]));
        }
    }
    all.extend(curvature.iter().map(|parts| g.neg(g.add(parts))));
    all.extend(chart.basis.concat());
    let matrices: Vec<Vec<f64>> = values(subject, &all, &subject.states)
        .iter()
        .map(|values| {
            let (summands, basis) = values.split_at(2 * n * n);
            congruent(summands.split_at(n * n), basis, n, k)
        })
        .collect();
    regular_values(&matrices, k)
}

/// `Bᵀ (M + N) B`, entries that cancel to rounding set to zero.
fn congruent((m, other): (&[f64], &[f64]), b: &[f64], n: usize, k: usize) -> Vec<f64> {
    const CANCELLED: f64 = 1e-11;
    let mut product = vec![0.0; k * k];
    for (place, entry) in product.iter_mut().enumerate() {
        let (s, u) = (place / k, place % k);
        let mut size = 0.0;
        for i in 0..n {
            for j in 0..n {
                let weight = b[i * k + s] * b[j * k + u];
                *entry += weight * (m[i * n + j] + other[i * n + j]);
                size += weight.abs() * (m[i * n + j].abs() + other[i * n + j].abs());
            }
        }
        if entry.abs() < CANCELLED * size {
            *entry = 0.0;
        }
    }
    product
}

/// The matrix whose determinant decides whether the quasi-velocities are coordinates of the velocities.
fn frame(subject: &Sampled<'_>) -> Vec<Vec<Expr>> {
    let (system, terms, selection) = (subject.cx.system, subject.cx.terms, subject.cx.selection);
    let g = &system.graph;
    if let Some(frame) = &system.frame {
        return frame.fields.clone();
    }
    let unit = |i: usize| -> Vec<Expr> {
        let entry = |j| if i == j { g.one() } else { g.zero() };
        (0..system.n()).map(entry).collect()
    };
    let stated: Vec<Expr> = system
        .quasi_velocities
        .iter()
        .map(|q| q.definition)
        .collect();
    let (n, r) = (system.n(), selection.rows.len());
    let mut matrix = g.jacobian(&stated, &system.velocity_symbols());
    if stated.len() == n {
        return matrix;
    }
    if stated.len() + r != n {
        matrix = selection.independent(n).into_iter().map(unit).collect();
    }
    let affine = selection
        .rows
        .iter()
        .all(|&row| system.constraints[terms.constraint_index[row]].is_affine_in_velocities());
    if affine {
        matrix.extend(
            selection
                .rows
                .iter()
                .map(|&row| terms.jacobian[row].clone()),
        );
    } else if stated.len() + r == n {
        // Some velocities complete k forms to a frame if and only if the forms are independent.
        return gram(g, &matrix);
    } else {
        matrix.extend(selection.dependent.iter().map(|&d| unit(d)));
    }
    matrix
}

/// The products of the rows with each other: nonsingular where the rows are independent.
fn gram(g: &Graph, rows: &[Vec<Expr>]) -> Vec<Vec<Expr>> {
    let product = |a: &[Expr], b: &[Expr]| {
        let parts: Vec<Expr> = a.iter().zip(b).map(|(&x, &y)| g.mul(&[x, y])).collect();
        g.add(&parts)
    };
    rows.iter()
        .map(|a| rows.iter().map(|b| product(a, b)).collect())
        .collect()
}

/// Central differences by the time.
fn without_time(subject: &Sampled<'_>, es: &[Expr]) -> Seen {
    const STEP: f64 = 1e-2;
    let time = subject.cx.system.graph.intern_symbol("t", 0);
    let at = |shift: f64| {
        let states: Vec<Point> = subject
            .free_states
            .iter()
            .map(|state| moved(state, &[(time, shift)]))
            .collect();
        values(subject, es, &states)
    };
    let (before, after) = (at(-STEP), at(STEP));
    zero(Size::of(
        before
            .iter()
            .flatten()
            .zip(after.iter().flatten())
            .map(|(a, b)| ((a - b) / STEP, 1.0 + a.abs())),
    ))
}

/// L at opposite velocities.
fn even(subject: &Sampled<'_>) -> Seen {
    let system = subject.cx.system;
    let opposite: Vec<Point> = subject
        .free_states
        .iter()
        .map(|state| {
            let mut state = state.clone();
            for c in &system.coordinates {
                state.entry(c.v_symbol).and_modify(|v| *v = -*v);
            }
            state
        })
        .collect();
    let (there, back) = (
        values(subject, &[system.lagrangian], &subject.free_states),
        values(subject, &[system.lagrangian], &opposite),
    );
    let pairs = there.iter().flatten().zip(back.iter().flatten());
    zero(Size::of(pairs.map(|(a, b)| (a - b, a.abs() + b.abs()))))
}

/// Third differences of L along straight lines in the velocities.
fn quadratic(subject: &Sampled<'_>) -> Seen {
    const STEP: f64 = 0.25;
    let system = subject.cx.system;
    let mut found = Vec::new();
    for (seed, state) in subject.free_states.iter().enumerate() {
        for (shift, _) in system.coordinates.iter().enumerate() {
            let line = |s: f64| -> Vec<(Symbol, f64)> {
                system
                    .coordinates
                    .iter()
                    .enumerate()
                    .map(|(i, c)| {
                        let sign = if (i * 7 + shift * 5 + seed) % 3 == 0 {
                            -1.0
                        } else {
                            1.0
                        };
                        let weight = if i == shift { 1.0 } else { 0.5 * sign };
                        (c.v_symbol, s * STEP * weight)
                    })
                    .collect()
            };
            let states: Vec<Point> = [0.0, 1.0, 2.0, 3.0]
                .iter()
                .map(|&s| moved(state, &line(s)))
                .collect();
            let along = values(subject, &[system.lagrangian], &states);
            if let [a, b, c, d] = &along[..] {
                let size = along.iter().flatten().fold(1.0_f64, |m, x| m.max(x.abs()));
                found.push((d[0] - 3.0 * c[0] + 3.0 * b[0] - a[0], size));
            }
        }
    }
    zero(Size::of(found))
}

/// Euler's identity: `v·∂f/∂v` is the same multiple of f everywhere.
fn homogeneous(subject: &Sampled<'_>) -> Seen {
    let (system, terms) = (subject.cx.system, subject.cx.terms);
    let mut seen = Seen::Holds;
    for (row, &f) in terms.constraints.iter().enumerate() {
        let mut es = vec![f];
        es.extend(&terms.jacobian[row]);
        es.extend(system.coordinates.iter().map(|c| c.v));
        let n = system.n();
        let degrees: Vec<(f64, f64)> = values(subject, &es, &subject.free_states)
            .iter()
            .filter(|x| x[0].abs() > 1e-3)
            .map(|x| {
                let products = (0..n).map(|i| x[1 + i] * x[1 + n + i]);
                let size = products.clone().map(f64::abs).sum::<f64>();
                (products.sum::<f64>() / x[0], 1.0 + size / x[0].abs())
            })
            .collect();
        let Some(&(degree, _)) = degrees.first() else {
            return Seen::Unclear;
        };
        let differences = degrees.iter().map(|(d, size)| (d - degree, *size));
        match Size::of(differences) {
            Size::Zero => {}
            Size::NotZero => return Seen::Fails,
            Size::Unclear => seen = Seen::Unclear,
        }
    }
    seen
}

/// Coordinates of which neither L nor the constraints depend, enough of them to solve the constraints for their
/// velocities.
fn chaplygin(subject: &Sampled<'_>) -> Seen {
    let (system, terms, rows) = (
        subject.cx.system,
        subject.cx.terms,
        &subject.cx.selection.rows,
    );
    let g = &system.graph;
    if rows.is_empty() {
        return Seen::Holds;
    }
    let mut absent = Vec::new();
    for (i, c) in system.coordinates.iter().enumerate() {
        let mut slopes = vec![g.diff(system.lagrangian, c.q_symbol)];
        slopes.extend(
            rows.iter()
                .map(|&row| g.diff(terms.constraints[row], c.q_symbol)),
        );
        match vanish(subject, &slopes, &subject.states) {
            Seen::Holds => absent.push(i),
            Seen::Fails => {}
            Seen::Unclear => return Seen::Unclear,
        }
    }
    if absent.len() < rows.len() {
        return Seen::Fails;
    }
    let mut entries = Vec::new();
    for &row in rows {
        entries.extend(absent.iter().map(|&d| terms.jacobian[row][d]));
    }
    // J Jᵀ has the rank of J.
    let (r, m) = (rows.len(), absent.len());
    let gram: Vec<Vec<f64>> = values(subject, &entries, &subject.states)
        .iter()
        .map(|j| {
            let dot = |a: usize, b: usize| (0..m).map(|c| j[a * m + c] * j[b * m + c]).sum();
            (0..r * r).map(|place| dot(place / r, place % r)).collect()
        })
        .collect();
    regular_values(&gram, r)
}

fn velocities(system: &System) -> Vec<Symbol> {
    system.velocity_symbols()
}

/// Whether masses, and rates of masses where asked for, keep their values where each of the symbols is shifted.
fn masses_of(subject: &Sampled<'_>, symbols: &[Symbol], rates: bool) -> Seen {
    const STEP: f64 = 0.21;
    let system = subject.cx.system;
    let mut all: Vec<Expr> = system.particles.iter().map(|p| p.mass).collect();
    if rates {
        all.extend(system.masses.iter().map(|m| m.rate));
    }
    let before = values(subject, &all, &subject.free_states);
    let mut changes = vec![(0.0, 1.0)];
    for &symbol in symbols {
        let states: Vec<Point> = subject
            .free_states
            .iter()
            .map(|state| moved(state, &[(symbol, STEP)]))
            .collect();
        let after = values(subject, &all, &states);
        let pairs = before.iter().flatten().zip(after.iter().flatten());
        changes.extend(pairs.map(|(a, b)| ((a - b) / STEP, 1.0 + a.abs())));
    }
    zero(Size::of(changes))
}

/// W is `Σ m (∂r/∂q)ᵀ ∂r/∂q`.
fn particles(subject: &Sampled<'_>) -> Seen {
    let system = subject.cx.system;
    let (g, n) = (&system.graph, system.n());
    if system.particles.is_empty() {
        return Seen::Fails;
    }
    if mass::with_velocity(system).is_some() {
        // The matrix of the terms is then not that of the kinetic energy.
        return Seen::Unclear;
    }
    let mut inertia = vec![Vec::new(); n * n];
    for particle in &system.particles {
        for slope in g.jacobian(&particle.position, &system.coordinate_symbols()) {
            for (place, parts) in inertia.iter_mut().enumerate() {
                parts.push(g.mul(&[particle.mass, slope[place / n], slope[place % n]]));
            }
        }
    }
    let mass = subject.cx.terms.mass_matrix.concat();
    let differences: Vec<Expr> = inertia
        .iter()
        .zip(mass)
        .map(|(parts, w)| g.sub(g.add(parts), w))
        .collect();
    vanish(subject, &differences, &subject.free_states)
}

/// The components of the positions are the coordinates, each once.
fn cartesian(system: &System) -> Seen {
    let mut components: Vec<Expr> = system
        .particles
        .iter()
        .flat_map(|particle| particle.position.iter().copied())
        .collect();
    let mut coordinates: Vec<Expr> = system.coordinates.iter().map(|c| c.q).collect();
    components.sort_unstable();
    coordinates.sort_unstable();
    if components == coordinates {
        Seen::Holds
    } else {
        Seen::Fails
    }
}
