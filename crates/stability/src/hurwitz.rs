//! Whether all zeros of a polynomial lie left of the imaginary axis: Hurwitz's determinants (Hurwitz 1895; Liénard and Chipart 1914).
//!
//! With a positive leading coefficient, all zeros lie left of the axis exactly where all determinants Δ₁ … Δ_m are positive. Over a range of
//! one parameter their zeros cut the range into intervals on each of which stability is the same; a boundary where the constant
//! coefficient vanishes is passed by a real eigenvalue, one where Δ_{m−1} does by a pair (Orlando 1911).

use crate::real_roots::{real_roots, sign_at, Root};
use crate::steady::closed;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Hurwitz's determinants Δ₁ … Δ_m of a polynomial, its coefficients given with the constant first, all of them multiplied by the sign that
/// makes the leading coefficient positive where that sign is `leading`.
pub fn determinants(g: &Graph, coefficients: &[Expr], leading: Ordering) -> Vec<Expr> {
    let m = coefficients.len().saturating_sub(1);
    let signed = |e: Expr| {
        if leading == Ordering::Less {
            g.neg(e)
        } else {
            e
        }
    };
    // a₀ is the leading coefficient in Hurwitz's matrix.
    let a = |i: i64| match usize::try_from(i) {
        Ok(i) if i <= m => signed(coefficients[m - i]),
        _ => g.zero(),
    };
    let entry = |row: usize, column: usize| a(2 * (column as i64 + 1) - (row as i64 + 1));
    let minor = |size: usize| -> Vec<Vec<Expr>> {
        let row = |r: usize| (0..size).map(|c| entry(r, c)).collect();
        (0..size).map(row).collect()
    };
    (1..=m)
        .map(|size| closed(g, determinant(g, &minor(size))))
        .collect()
}

/// What becomes of the eigenvalues at a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// A real eigenvalue passes through zero.
    Zero,
    /// A pair of eigenvalues passes the imaginary axis.
    Pair,
    /// The leading coefficient vanishes: an eigenvalue goes to infinity.
    Infinity,
    /// A determinant vanishes, and the stability does not change by that: two eigenvalues are opposite.
    Touching,
}

/// A value of the parameter where stability may change.
#[derive(Clone, Debug)]
pub struct Boundary {
    /// Where.
    pub root: Root,
    /// How.
    pub crossing: Crossing,
}

/// An open interval of a parameter with the same stability throughout.
#[derive(Clone, Debug)]
pub struct Region {
    /// The lower end.
    pub low: RBig,
    /// The upper end.
    pub high: RBig,
    /// Whether all eigenvalues that were not split off lie left of the axis.
    pub is_asymptotic: bool,
    /// A value inside, at which the signs were decided.
    pub sample: RBig,
}

/// Stability over a range of one parameter.
#[derive(Clone, Debug)]
pub struct Ranges {
    /// Boundaries, ascending.
    pub boundaries: Vec<Boundary>,
    /// Regions between them, ascending.
    pub regions: Vec<Region>,
}

/// Where in the interval from `low` to `high` of `symbol` all zeros of the polynomial lie left of the axis. `None` where that was not decided.
pub fn ranges(
    g: &Graph,
    coefficients: &[Expr],
    symbol: Symbol,
    low: &RBig,
    high: &RBig,
) -> Option<Ranges> {
    let leading = *coefficients.last()?;
    let sample = (low + high) / RBig::from(2);
    let sign = sign_at(g, leading, symbol, &sample)?;
    let list = determinants(g, coefficients, sign);
    let m = list.len();
    let of = |e: Expr, crossing: Crossing| -> Option<Vec<Boundary>> {
        if g.as_number(e).is_some_and(|_| !g.is_zero(e)) {
            return Some(Vec::new());
        }
        let roots = real_roots(g, e, symbol, low, high)?;
        Some(
            roots
                .into_iter()
                .map(|root| Boundary { root, crossing })
                .collect(),
        )
    };
    let mut all = of(leading, Crossing::Infinity)?;
    all.extend(of(*coefficients.first()?, Crossing::Zero)?);
    if let Some(&last) = m.checked_sub(2).and_then(|at| list.get(at)) {
        all.extend(of(last, Crossing::Pair)?);
    }
    for &e in list.iter().rev().skip(2) {
        all.extend(of(e, Crossing::Touching)?);
    }
    let mut boundaries = distinct(all)?;
    let mut regions = Vec::new();
    let lows = std::iter::once(low).chain(boundaries.iter().map(|b| &b.root.high));
    let highs = boundaries.iter().map(|b| &b.root.low).chain([high]);
    for (a, b) in lows.zip(highs).filter(|(a, b)| a < b) {
        let sample = (a + b) / RBig::from(2);
        let mut is_asymptotic = sign_at(g, leading, symbol, &sample)? == sign;
        for &e in &list {
            is_asymptotic &= sign_at(g, e, symbol, &sample)? == Ordering::Greater;
        }
        regions.push(Region {
            low: a.clone(),
            high: b.clone(),
            is_asymptotic,
            sample,
        });
    }
    name_pairs(&mut boundaries, &regions);
    joined(&mut boundaries, &mut regions);
    Some(Ranges {
        boundaries,
        regions,
    })
}

/// Boundaries in order, those at the same place once; `None` where two that overlap may be different.
fn distinct(mut all: Vec<Boundary>) -> Option<Vec<Boundary>> {
    // Where several determinants vanish together the first of the list names the crossing.
    all.sort_by(|a, b| a.root.low.cmp(&b.root.low));
    let mut kept: Vec<Boundary> = Vec::new();
    for own in all {
        match kept.last_mut() {
            Some(last) if own.root.low <= last.root.high => {
                // Enclosures that overlap hold the same zero as far as this can tell; the hull of both is left out of all regions.
                if own.root.high > last.root.high {
                    last.root.high = own.root.high;
                }
                if last.crossing == Crossing::Touching {
                    last.crossing = own.crossing;
                }
            }
            _ => kept.push(own),
        }
    }
    Some(kept)
}

/// Where Δ_{m−1} vanishes two eigenvalues are opposite (Orlando 1911): a pair on the axis where the stability changes, and otherwise perhaps λ and
/// −λ, as those of a bicycle at rest.
fn name_pairs(boundaries: &mut [Boundary], regions: &[Region]) {
    for boundary in boundaries
        .iter_mut()
        .filter(|b| b.crossing == Crossing::Pair)
    {
        let before = regions.iter().rfind(|r| r.high <= boundary.root.low);
        let after = regions.iter().find(|r| r.low >= boundary.root.high);
        let changes = before
            .zip(after)
            .is_some_and(|(a, b)| a.is_asymptotic != b.is_asymptotic);
        if !changes {
            boundary.crossing = Crossing::Touching;
        }
    }
}

/// Takes out boundaries where no determinant that matters vanishes and unstable regions meet.
fn joined(boundaries: &mut Vec<Boundary>, regions: &mut Vec<Region>) {
    let mut at = 0;
    while at + 1 < regions.len() {
        let is_same = !regions[at].is_asymptotic && !regions[at + 1].is_asymptotic;
        let between = boundaries
            .iter()
            .position(|b| b.root.low >= regions[at].high && b.root.high <= regions[at + 1].low);
        match between {
            Some(place) if is_same && boundaries[place].crossing == Crossing::Touching => {
                boundaries.remove(place);
                let next = regions.remove(at + 1);
                regions[at].high = next.high;
            }
            _ => at += 1,
        }
    }
}
