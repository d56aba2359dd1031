//! Random moving frames, by forms or by fields, whose determinants are nowhere zero.

use super::draw::Draw;
use chetaev_mechanics::system::FrameFields;
use chetaev_symbolic::matrix::inverse;
use chetaev_symbolic::Expr;

/// Quasi-velocities as (name, definition), and the fields where they are stated by these.
pub(super) struct Stated {
    pub(super) quasi_velocities: Vec<(String, Expr)>,
    pub(super) frame: Option<FrameFields>,
}

/// `n` forms of determinant one whose inverse is polynomial in what occurs; the first is never the rate of a coordinate.
pub(super) fn unimodular(draw: &mut Draw<'_>) -> Vec<(String, Expr)> {
    let g = draw.g;
    let order = draw.shuffled();
    let mut forms = Vec::new();
    for (s, &i) in order.iter().enumerate() {
        let mut parts = vec![draw.v(i)];
        if s == 0 || s + 1 < order.len() && draw.one_in(2) {
            let j = order[s + 1 + draw.index(order.len() - s - 1)];
            let slope = draw.function(1);
            parts.push(g.mul(&[slope, draw.v(j)]));
        }
        forms.push((name(s), g.add(&parts)));
    }
    forms
}

/// `n` forms, `k` forms, or `n` fields with a drift; for `k` forms the velocities `dependent` are left to the constraints.
pub(super) fn frame(draw: &mut Draw<'_>, dependent: &[usize]) -> Stated {
    match draw.between(0, 2) {
        0 => forms(draw, &[]),
        1 => forms(draw, dependent),
        _ => fields(draw),
    }
}

fn name(s: usize) -> String {
    format!("u_{}", s + 1)
}

/// Entries of a triangular matrix along `order`, with a diagonal that is nowhere zero.
fn triangular(draw: &mut Draw<'_>, order: &[usize]) -> Vec<Vec<Expr>> {
    let g = draw.g;
    let mut rows = Vec::new();
    for (s, &i) in order.iter().enumerate() {
        let mut row = vec![g.zero(); draw.n()];
        row[i] = if draw.one_in(2) {
            g.one()
        } else {
            draw.nowhere_zero()
        };
        for &j in &order[s + 1..] {
            if draw.one_in(2) {
                row[j] = entry(draw);
            }
        }
        rows.push(row);
    }
    rows
}

/// A function of the coordinates, sometimes of the time too.
fn entry(draw: &mut Draw<'_>) -> Expr {
    let (g, t) = (draw.g, draw.t());
    let e = draw.function(1);
    match draw.between(0, 4) {
        0 => g.add(&[e, t]),
        1 => g.mul(&[e, g.cos(t)]),
        _ => e,
    }
}

/// `η^s = a^s_u v^u + a^s_0`, one for each velocity that is not in `without`.
fn forms(draw: &mut Draw<'_>, without: &[usize]) -> Stated {
    let g = draw.g;
    let mut order = draw.shuffled();
    order.retain(|i| !without.contains(i));
    let rows = triangular(draw, &order);
    let quasi_velocities = rows
        .iter()
        .enumerate()
        .map(|(s, row)| {
            let mut parts: Vec<Expr> = (0..draw.n()).map(|i| g.mul(&[row[i], draw.v(i)])).collect();
            if draw.one_in(3) {
                parts.push(entry(draw));
            }
            (name(s), g.add(&parts))
        })
        .collect();
    Stated {
        quasi_velocities,
        frame: None,
    }
}

/// `v = X_0 + η^s X_s`; the quasi-velocities follow.
fn fields(draw: &mut Draw<'_>) -> Stated {
    let (g, n) = (draw.g, draw.n());
    let order = draw.shuffled();
    let fields = triangular(draw, &order);
    let drift: Vec<Expr> = (0..n)
        .map(|_| match draw.one_in(2) {
            true => entry(draw),
            false => g.zero(),
        })
        .collect();
    let matrix: Vec<Vec<Expr>> = (0..n)
        .map(|i| fields.iter().map(|field| field[i]).collect())
        .collect();
    let relative: Vec<Expr> = (0..n).map(|i| g.sub(draw.v(i), drift[i])).collect();
    let along = |row: &Vec<Expr>| {
        let pairs = row.iter().zip(&relative);
        let parts: Vec<Expr> = pairs.map(|(&e, &v)| g.mul(&[e, v])).collect();
        g.add(&parts)
    };
    // Triangular with a diagonal that is nowhere zero: it has an inverse.
    let speeds: Vec<Expr> = match inverse(g, &matrix) {
        Ok(rows) => rows.iter().map(along).collect(),
        Err(_) => relative.clone(),
    };
    Stated {
        quasi_velocities: speeds
            .into_iter()
            .enumerate()
            .map(|(s, speed)| (name(s), speed))
            .collect(),
        frame: Some(FrameFields { fields, drift }),
    }
}
