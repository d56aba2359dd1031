//! Whether all zeros of polynomials lie left of the imaginary axis: Hurwitz's determinants (Hurwitz 1895; Liénard and Chipart 1914).
//!
//! With a positive leading coefficient, all zeros lie left of the axis exactly where all determinants Δ₁ … Δ_m are positive. Over a range of
//! one parameter the zeros of the determinants cut the range into intervals on each of which stability is the same; a boundary where the constant
//! coefficient vanishes is passed by a real eigenvalue, one where Δ_{m−1} does by a pair (Orlando 1911).

use crate::isolation::Root;
use crate::real_roots::{real_roots, sign_at};
use crate::steady::closed;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Hurwitz's determinants Δ₁ … Δ_m of a polynomial, its coefficients given with the constant first.
pub fn determinants(g: &Graph, coefficients: &[Expr]) -> Vec<Expr> {
    let m = coefficients.len().saturating_sub(1);
    // a₀ is the leading coefficient in Hurwitz's matrix.
    let a = |i: i64| match usize::try_from(i) {
        Ok(i) if i <= m => coefficients[m - i],
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
    /// Two imaginary pairs of a spectrum that is its own mirror image meet.
    Collision,
    /// Two eigenvalues are opposite, and on both sides of that value the stability is the same.
    Touching,
}

/// A polynomial that has all its zeros left of the axis exactly where a part of the spectrum is as it should be.
#[derive(Clone, Debug)]
pub struct Deciding {
    /// Its coefficients, the constant first.
    pub coefficients: Vec<Expr>,
    /// Whether it stands for an even polynomial, whose zeros are then imaginary and simple.
    pub is_paired: bool,
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
    /// Whether all deciding polynomials have all their zeros left of the axis; if not, one of them has a zero right of it.
    pub is_left: bool,
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

/// Where in the interval from `low` to `high` of `symbol` all zeros of the polynomials lie left of the axis. `leading` vanishes where an
/// eigenvalue is at infinity. `None` where that was not decided.
pub fn ranges(
    g: &Graph,
    polynomials: &[Deciding],
    leading: Expr,
    symbol: Symbol,
    low: &RBig,
    high: &RBig,
) -> Option<Ranges> {
    let range = Over {
        g,
        symbol,
        low,
        high,
    };
    let mut lists = Vec::new();
    let mut all = range.boundaries(leading, Crossing::Infinity)?;
    for own in polynomials {
        let (list, boundaries) = range.of(own)?;
        all.extend(boundaries);
        lists.push(list);
    }
    let mut boundaries = distinct(all);
    let mut regions: Vec<Region> = Vec::new();
    let lows = std::iter::once(low).chain(boundaries.iter().map(|b| &b.root.high));
    let highs = boundaries.iter().map(|b| &b.root.low).chain([high]);
    for (a, b) in lows.zip(highs).filter(|(a, b)| a < b) {
        let sample = (a + b) / RBig::from(2);
        let mut is_left = true;
        for list in &lists {
            is_left &= range.is_left(list, &sample)?;
        }
        regions.push(Region {
            low: a.clone(),
            high: b.clone(),
            is_left,
            sample,
        });
    }
    name_pairs(&mut boundaries, &regions);
    Some(Ranges {
        boundaries,
        regions,
    })
}

/// A range of one parameter.
struct Over<'a> {
    g: &'a Graph,
    symbol: Symbol,
    low: &'a RBig,
    high: &'a RBig,
}

impl Over<'_> {
    /// The zeros of a function as boundaries.
    fn boundaries(&self, e: Expr, crossing: Crossing) -> Option<Vec<Boundary>> {
        if self.g.as_number(e).is_some_and(|_| !self.g.is_zero(e)) {
            return Some(Vec::new());
        }
        let roots = real_roots(self.g, e, self.symbol, self.low, self.high)?;
        let roots = roots.into_iter();
        Some(roots.map(|root| Boundary { root, crossing }).collect())
    }

    /// Leading coefficient and determinants of a polynomial, and where the numbers of zeros on both sides of the axis may change: where a zero
    /// is at infinity or at 0, or two are opposite, as Δ_{m−1} says (Orlando 1911).
    fn of(&self, own: &Deciding) -> Option<(Vec<Expr>, Vec<Boundary>)> {
        let leading = *own.coefficients.last()?;
        let list = determinants(self.g, &own.coefficients);
        let pair = if own.is_paired {
            Crossing::Collision
        } else {
            Crossing::Pair
        };
        let mut all = self.boundaries(leading, Crossing::Infinity)?;
        all.extend(self.boundaries(*own.coefficients.first()?, Crossing::Zero)?);
        if let Some(&last) = list.len().checked_sub(2).and_then(|at| list.get(at)) {
            all.extend(self.boundaries(last, pair)?);
        }
        Some(([vec![leading], list].concat(), all))
    }

    /// Whether a polynomial, given by its leading coefficient and its determinants, has all zeros left of the axis. Where the leading
    /// coefficient is negative determinants of odd size change their signs.
    fn is_left(&self, list: &[Expr], at: &RBig) -> Option<bool> {
        let signs: Option<Vec<Ordering>> = list
            .iter()
            .map(|&e| sign_at(self.g, e, self.symbol, at))
            .collect();
        Some(are_positive(&signs?))
    }
}

/// Whether Hurwitz's determinants are positive, given the sign of the leading coefficient and then those of the determinants of the polynomial
/// as it stands: with a negative leading coefficient those of odd size change.
pub fn are_positive(signs: &[Ordering]) -> bool {
    let Some((leading, list)) = signs.split_first() else {
        return true;
    };
    let mut list = list.iter().enumerate();
    *leading != Ordering::Equal
        && list.all(|(at, &sign)| match at % 2 {
            0 => sign == *leading,
            _ => sign == Ordering::Greater,
        })
}

/// Boundaries in order, those at the same place once.
fn distinct(mut all: Vec<Boundary>) -> Vec<Boundary> {
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
    kept
}

/// Where Δ_{m−1} vanishes two eigenvalues are opposite (Orlando 1911): a pair on the axis where the stability changes, and otherwise perhaps λ and
/// −λ, as those of a bicycle at rest.
fn name_pairs(boundaries: &mut [Boundary], regions: &[Region]) {
    for boundary in boundaries
        .iter_mut()
        .filter(|b| matches!(b.crossing, Crossing::Pair | Crossing::Collision))
    {
        let before = regions.iter().rfind(|r| r.high <= boundary.root.low);
        let after = regions.iter().find(|r| r.low >= boundary.root.high);
        let changes = before
            .zip(after)
            .is_some_and(|(a, b)| a.is_left != b.is_left);
        if !changes {
            boundary.crossing = Crossing::Touching;
        }
    }
}

impl Ranges {
    /// The same for a person: without the boundaries at which two eigenvalues are opposite while others stay right of the axis on both sides.
    #[must_use]
    pub fn joined(&self) -> Ranges {
        let (mut boundaries, mut regions) = (self.boundaries.clone(), self.regions.clone());
        let mut at = 0;
        while at + 1 < regions.len() {
            let is_same = !regions[at].is_left && !regions[at + 1].is_left;
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
        Ranges {
            boundaries,
            regions,
        }
    }
}
