//! Random constraints that have rank r almost everywhere and real states everywhere.

use super::draw::Draw;
use chetaev_symbolic::Expr;

/// What the rows of linear constraints contain besides velocities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// `A(q) v`.
    Linear,
    /// `A(q, t) v + b(q, t)`.
    Rheonomic,
}

/// `r` rows, triangular in r distinct velocities with factors that are nowhere zero, then mixed: rank r everywhere.
pub(super) fn linear(draw: &mut Draw<'_>, r: usize, form: Form) -> Vec<Expr> {
    let g = draw.g;
    let order = draw.shuffled();
    let mut rows: Vec<Expr> = (0..r).map(|l| row(draw, &order, l, r, form)).collect();
    for l in 1..r {
        if draw.one_in(3) {
            let factor = draw.function(1);
            rows[l - 1] = g.add(&[rows[l - 1], g.mul(&[factor, rows[l]])]);
        }
    }
    rows
}

/// Velocity `order[l]` by those after it, at least one of them independent.
fn row(draw: &mut Draw<'_>, order: &[usize], l: usize, r: usize, form: Form) -> Expr {
    let g = draw.g;
    let pivot = if draw.one_in(2) {
        g.one()
    } else {
        draw.nowhere_zero()
    };
    let mut parts = vec![g.mul(&[pivot, draw.v(order[l])])];
    let sure = r + draw.index(order.len() - r);
    for &i in &order[l + 1..] {
        if i == order[sure] || draw.one_in(3) {
            let slope = draw.function(2);
            let slope = match form {
                Form::Rheonomic if draw.one_in(3) => g.add(&[slope, draw.t()]),
                _ => slope,
            };
            parts.push(g.neg(g.mul(&[slope, draw.v(i)])));
        }
    }
    if form == Form::Rheonomic && !draw.one_in(4) {
        parts.push(drift(draw));
    }
    g.add(&parts)
}

/// Derivatives of functions `g^l = q_l + h^l(others, t)`, each with a factor that is nowhere zero, then mixed: rank r
/// everywhere, and completely integrable.
pub(super) fn integrable(draw: &mut Draw<'_>) -> Vec<Expr> {
    let g = draw.g;
    let order = draw.shuffled();
    let r = 1 + draw.index((draw.n() - 1).min(2));
    let visible = std::mem::replace(&mut draw.visible, order[r..].to_vec());
    let functions: Vec<(Expr, bool)> = (0..r).map(|_| (draw.function(2), draw.one_in(4))).collect();
    draw.visible = visible;
    let mut rows = Vec::new();
    for (l, (function, moves)) in functions.into_iter().enumerate() {
        let function = match moves {
            true => g.mul(&[function, draw.t()]),
            false => function,
        };
        let mut parts = vec![draw.v(order[l])];
        for &i in &order[r..] {
            let slope = g.diff(function, g.intern_symbol(&draw.names[i], 0));
            parts.push(g.mul(&[slope, draw.v(i)]));
        }
        parts.push(g.diff(function, g.intern_symbol("t", 0)));
        let factor = match draw.one_in(2) {
            true => g.one(),
            false => draw.nowhere_zero(),
        };
        rows.push(g.mul(&[factor, g.add(&parts)]));
    }
    for l in 1..r {
        let factor = draw.function(1);
        rows[l - 1] = g.add(&[rows[l - 1], g.mul(&[factor, rows[l]])]);
    }
    rows
}

/// b(q, t).
fn drift(draw: &mut Draw<'_>) -> Expr {
    let (g, t) = (draw.g, draw.t());
    match draw.between(0, 3) {
        0 => {
            let value = draw.coefficient();
            g.number(value)
        }
        1 => g.sin(t),
        2 => {
            let factor = draw.function(1);
            g.mul(&[t, factor])
        }
        _ => draw.function(2),
    }
}

/// One nonlinear constraint, and where there is room a linear one with it.
pub(super) fn nonlinear(draw: &mut Draw<'_>) -> Vec<Expr> {
    let order = draw.shuffled();
    let mut rows = vec![one_nonlinear(draw, &order)];
    if order.len() >= 4 && draw.one_in(3) {
        // Free of the velocities of the first, except as what it is solved by: both stay independent.
        let (last, before) = (order[order.len() - 1], order[order.len() - 2]);
        let slope = draw.function(2);
        let g = draw.g;
        rows.push(g.sub(draw.v(last), g.mul(&[slope, draw.v(before)])));
    }
    rows
}

/// The forms of the literature: Appell's cone, a prescribed speed, parallel velocities (Benenti), a parabola, a cubic.
fn one_nonlinear(draw: &mut Draw<'_>, order: &[usize]) -> Expr {
    let g = draw.g;
    let n = order.len();
    let v: Vec<Expr> = order.iter().map(|&i| draw.v(i)).collect();
    let second = v[1];
    let third = if n > 2 { v[2] } else { v[1] };
    match draw.between(0, if n > 2 { 6 } else { 3 }) {
        0 => {
            let (a, b) = (draw.function(1), draw.function(1));
            g.sub(
                v[0],
                g.add(&[g.mul(&[a, g.powi(second, 2)]), g.mul(&[b, third])]),
            )
        }
        1 => {
            let (a, b) = (draw.function(1), draw.function(1));
            let steep = g.add(&[g.one(), g.powi(second, 2)]);
            g.add(&[
                g.powi(v[0], 3),
                g.mul(&[steep, v[0]]),
                g.neg(g.mul(&[a, third])),
                b,
            ])
        }
        2 => {
            let square = draw.nowhere_zero();
            let squares: Vec<Expr> = v.iter().take(3).map(|&v| g.powi(v, 2)).collect();
            g.sub(g.add(&squares), square)
        }
        3 => cone(draw, v[0], &[second]),
        4 => cone(draw, v[0], &[second, third]),
        5 => {
            let weight = draw.nowhere_zero();
            let squares = g.add(&[g.powi(second, 2), g.powi(third, 2)]);
            g.sub(g.powi(v[0], 2), g.mul(&[weight, squares]))
        }
        _ => match v.get(3) {
            Some(&fourth) => g.sub(g.mul(&[v[0], second]), g.mul(&[third, fourth])),
            None => {
                let factor = draw.function(1);
                g.sub(g.mul(&[v[0], second]), g.mul(&[factor, g.powi(third, 2)]))
            }
        },
    }
}

/// Appell and Hamel: `v = a √(Σ v²)`, with a root that is not a square.
fn cone(draw: &mut Draw<'_>, v: Expr, others: &[Expr]) -> Expr {
    let g = draw.g;
    let mut squares: Vec<Expr> = others.iter().map(|&v| g.powi(v, 2)).collect();
    if others.len() < 2 || draw.one_in(4) {
        let shift = draw.nowhere_zero();
        squares.push(shift);
    }
    let slope = if draw.one_in(2) {
        let value = draw.coefficient();
        g.number(value)
    } else {
        draw.function(1)
    };
    g.sub(v, g.mul(&[slope, g.sqrt(g.add(&squares))]))
}

/// A velocity as a function of others under a root: `v_d = a √(w·A w) + b·w + c` with A(q) positive definite; where there is
/// room, sometimes two of them.
pub(super) fn radicals(draw: &mut Draw<'_>) -> Vec<Expr> {
    let order = draw.shuffled();
    let count = if order.len() >= 4 && draw.one_in(3) {
        2
    } else {
        1
    };
    (0..count)
        .map(|l| radical(draw, order[l], &order[count..]))
        .collect()
}

fn radical(draw: &mut Draw<'_>, dependent: usize, others: &[usize]) -> Expr {
    let g = draw.g;
    let mut square = Vec::new();
    for &i in others.iter().take(3) {
        let weight = if draw.one_in(3) {
            draw.nowhere_zero()
        } else {
            let value = draw.positive();
            g.number(value)
        };
        square.push(g.mul(&[weight, g.powi(draw.v(i), 2)]));
    }
    if others.len() > 1 && draw.one_in(2) {
        let slope = draw.function(1);
        let mixed = g.add(&[draw.v(others[0]), g.mul(&[slope, draw.v(others[1])])]);
        square.push(g.powi(mixed, 2));
    }
    // The root of a single square is no root.
    if others.len() < 2 || draw.one_in(4) {
        square.push(draw.nowhere_zero());
    }
    let steep = if draw.one_in(2) {
        let value = draw.coefficient();
        g.number(value)
    } else {
        draw.nowhere_zero()
    };
    let mut parts = vec![draw.v(dependent)];
    parts.push(g.neg(g.mul(&[steep, g.sqrt(g.add(&square))])));
    if draw.one_in(2) {
        let slope = draw.function(1);
        parts.push(g.neg(g.mul(&[slope, draw.v(others[0])])));
    }
    if draw.one_in(4) {
        let drift = draw.function(1);
        parts.push(drift);
    }
    g.add(&parts)
}

/// Constraints on derivatives of higher order: those in the place of velocities, and derivatives of orders up to `lower` in
/// the place of some coordinates.
pub(super) fn raised(draw: &mut Draw<'_>, rows: &[Expr], order: u32, lower: u32) -> Vec<Expr> {
    let g = draw.g;
    let mut pairs = Vec::new();
    for i in 0..draw.n() {
        let own = draw.index(lower as usize + 1) as u32;
        pairs.push((draw.v(i), g.symbol(&draw.names[i], order)));
        pairs.push((draw.q(i), g.symbol(&draw.names[i], own)));
    }
    g.substitute_all(rows, &pairs)
}
