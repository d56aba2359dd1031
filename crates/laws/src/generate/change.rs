//! Changes of coordinates that are invertible everywhere.

use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::{Expr, Graph};

/// Φ(s, t): a linear mixing `uᵢ = sᵢ + c sⱼ` with earlier s, then `uᵢ` plus a polynomial in later u and, where it is given, t;
/// with `straight` the polynomial is linear, and mostly zero. All in another order.
pub(crate) fn change(
    g: &Graph,
    random: &mut Random,
    s: &[Expr],
    t: Option<Expr>,
    straight: bool,
) -> Vec<Expr> {
    let n = s.len();
    let u: Vec<Expr> = (0..n)
        .map(|i| g.add(&[s[i], mixing(g, random, &s[..i])]))
        .collect();
    let mut q: Vec<Expr> = (0..n)
        .map(|i| g.add(&[u[i], shift(g, random, &u[i + 1..], t, straight)]))
        .collect();
    for last in (1..n).rev() {
        q.swap(last, random.below(last as u64 + 1) as usize);
    }
    q
}

/// A multiple of an earlier coordinate, or nothing.
fn mixing(g: &Graph, random: &mut Random, earlier: &[Expr]) -> Expr {
    if earlier.is_empty() || random.below(2) == 0 {
        return g.zero();
    }
    let one = earlier[random.below(earlier.len() as u64) as usize];
    let factor = match random.below(3) {
        0 => -1,
        1 => 1,
        _ => 2,
    };
    g.mul(&[g.integer(factor), one])
}

/// A polynomial of degree at most two in the later coordinates, or a linear one.
fn shift(g: &Graph, random: &mut Random, later: &[Expr], t: Option<Expr>, straight: bool) -> Expr {
    let mut parts = Vec::new();
    if let Some(t) = t.filter(|_| random.below(3) == 0) {
        parts.push(g.powi(t, random.between(1, 2)));
    }
    if !later.is_empty() {
        let mut pick = || later[random.below(later.len() as u64) as usize];
        let (a, b) = (pick(), pick());
        let scale = g.integer(random.between(1, 3));
        let is_linear = random.below(2) == 0;
        if straight && is_linear {
            parts.push(a);
        } else if !straight {
            let term = if is_linear { a } else { g.mul(&[a, b]) };
            parts.push(g.mul(&[scale, term]));
        }
    }
    g.add(&parts)
}
