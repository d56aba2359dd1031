//! The linear equations in second order, `M q'' + (D + G) q' + (K + N) q = 0`: mass, damping, gyroscopic, stiffness and circulatory parts.

use crate::linearization::{Linearization, Variable};
use crate::steady::closed;
use chetaev_symbolic::{Expr, Graph};

/// The parts, each a square matrix by the coordinates.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The coordinates.
    pub names: Vec<String>,
    /// M.
    pub mass: Vec<Vec<Expr>>,
    /// D, symmetric.
    pub damping: Vec<Vec<Expr>>,
    /// G, skew.
    pub gyroscopic: Vec<Vec<Expr>>,
    /// K, symmetric.
    pub stiffness: Vec<Vec<Expr>>,
    /// N, skew.
    pub circulatory: Vec<Vec<Expr>>,
}

impl Parts {
    /// The parts, where each coordinate has its velocity among the variables, and all other quasi-velocities move by themselves.
    pub fn of(g: &Graph, linear: &Linearization) -> Option<Parts> {
        let count = linear
            .variables
            .iter()
            .filter(|v| matches!(v, Variable::Coordinate(_)))
            .count();
        let size = linear.variables.len();
        let speed = |row: usize| -> Option<usize> {
            let mut moved = (0..size).filter(|&c| !g.is_zero(linear.right[row][c]));
            let own = moved
                .next()
                .filter(|&c| c >= count && g.is_one(linear.right[row][c]))?;
            moved.next().is_none().then_some(own)
        };
        let speeds: Vec<usize> = (0..count).map(speed).collect::<Option<_>>()?;
        let others: Vec<usize> = (count..size).filter(|c| !speeds.contains(c)).collect();
        let is_apart = |&r: &usize| {
            let zero = |&c: &usize| g.is_zero(linear.left[r][c]) && g.is_zero(linear.right[r][c]);
            others.iter().all(zero)
        };
        if count == 0 || !speeds.iter().all(is_apart) {
            return None;
        }
        let block = |m: &[Vec<Expr>], columns: &[usize], sign: i64| -> Vec<Vec<Expr>> {
            let entry = |r: usize, c: usize| g.mul(&[g.integer(sign), m[r][c]]);
            speeds
                .iter()
                .map(|&r| columns.iter().map(|&c| entry(r, c)).collect())
                .collect()
        };
        let coordinates: Vec<usize> = (0..count).collect();
        let by_velocity = block(&linear.right, &speeds, -1);
        let by_place = block(&linear.right, &coordinates, -1);
        Some(Parts {
            names: linear.names[..count].to_vec(),
            mass: block(&linear.left, &speeds, 1),
            damping: half(g, &by_velocity, 1),
            gyroscopic: half(g, &by_velocity, -1),
            stiffness: half(g, &by_place, 1),
            circulatory: half(g, &by_place, -1),
        })
    }
}

/// The symmetric (1) or the skew (−1) part.
fn half(g: &Graph, m: &[Vec<Expr>], sign: i64) -> Vec<Vec<Expr>> {
    let entry = |r: usize, c: usize| {
        let sum = g.add(&[m[r][c], g.mul(&[g.integer(sign), m[c][r]])]);
        closed(g, g.div(sum, g.integer(2)))
    };
    let size = m.len();
    (0..size)
        .map(|r| (0..size).map(|c| entry(r, c)).collect())
        .collect()
}
