//! Vectors with three components.

use super::shown::readable;
use chetaev_symbolic::rational::content;
use chetaev_symbolic::{Expr, Graph};

/// Three components.
pub(super) type Vector = [Expr; 3];

pub(super) fn padded(g: &Graph, components: &[Expr]) -> Vector {
    [0, 1, 2].map(|i| components.get(i).copied().unwrap_or(g.zero()))
}

pub(super) fn dot(g: &Graph, a: &Vector, b: &Vector) -> Expr {
    let parts: Vec<Expr> = (0..3).map(|i| g.mul(&[a[i], b[i]])).collect();
    g.add(&parts)
}

pub(super) fn cross(g: &Graph, a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| g.sub(g.mul(&[a[i], b[j]]), g.mul(&[a[j], b[i]])))
}

pub(super) fn difference(g: &Graph, a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| g.sub(a[i], b[i]))
}

/// The components times a factor, as a person writes them.
pub(super) fn times(g: &Graph, a: &Vector, factor: Expr) -> Vector {
    a.map(|x| readable(g, g.mul(&[x, factor])))
}

pub(super) fn is_zero(g: &Graph, a: &Vector) -> bool {
    a.iter().all(|&x| g.is_zero(x))
}

/// Which axis a vector of length one lies along.
pub(super) fn axis_of(g: &Graph, a: &Vector) -> Option<usize> {
    let axis = a.iter().position(|&x| g.is_one(x))?;
    let others = (0..3).filter(|&i| i != axis);
    others.into_iter().all(|i| g.is_zero(a[i])).then_some(axis)
}

/// By what a vector is divided to be written as a person writes a direction: (4, -3) for (-8 k, 6 k). The first component that is not zero
/// has no minus in front, and components in the ratio of numbers are small integers.
pub(super) fn scale(g: &Graph, a: &Vector) -> Expr {
    let Some(&first) = a.iter().find(|&&x| !g.is_zero(x)) else {
        return g.one();
    };
    let ratios = a.map(|x| readable(g, g.div(x, first)));
    let numbers: Option<Vec<_>> = ratios.iter().map(|&x| g.as_number(x)).collect();
    match numbers {
        Some(numbers) => g.mul(&[first, g.number(content(numbers.into_iter()))]),
        None if g.text(first).starts_with('-') => g.integer(-1),
        None => g.one(),
    }
}

/// As many components as the space has.
pub(super) fn text(g: &Graph, a: &Vector, dimension: usize) -> String {
    let texts: Vec<String> = a[..dimension].iter().map(|&x| g.text(x)).collect();
    format!("({})", texts.join(", "))
}
