//! Whether all zeros of polynomials lie left of the imaginary axis: Hurwitz's determinants (Hurwitz 1895; Liénard and Chipart 1914).
//!
//! With a positive leading coefficient, all zeros lie left of the axis exactly where all determinants Δ₁ … Δ_m are positive. Over a range of
//! one parameter the zeros of the determinants cut the range into intervals on each of which stability is the same; a boundary where the constant
//! coefficient vanishes is passed by a real eigenvalue, one where Δ_{m−1} does by a pair (Orlando 1911).

use crate::isolation::{joined, Root};
use crate::real_roots::{overlap, sign_at, sign_over, zeros_of_factors, Zero, FINE, USUAL};
use crate::real_values::{conditions, Condition};
use crate::steady::closed;
use chetaev_mechanics::system::Relation;
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::meter;
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_int::ops::BitTest;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// Hurwitz's determinants Δ₁ … Δ_m of a polynomial, its coefficients given with the constant first.
pub fn determinants(g: &Graph, coefficients: &[Expr]) -> Vec<Expr> {
    let m = coefficients.len().saturating_sub(1);
    let leading_first: Vec<Expr> = coefficients.iter().rev().copied().collect();
    if let Some(found) = of_numbers(g, &leading_first) {
        return found;
    }
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

/// The determinants where all coefficients are rational numbers, the leading one first; `None` where one is none.
fn of_numbers(g: &Graph, coefficients: &[Expr]) -> Option<Vec<Expr>> {
    let numbers = coefficients.iter().map(|&e| g.as_number(e).cloned());
    let numbers: Vec<RBig> = numbers.collect::<Option<_>>()?;
    let m = numbers.len().saturating_sub(1);
    let mut found = products_of_routh(&numbers);
    for size in found.len() + 1..=m {
        found.push(determinant_of_numbers(hurwitz_matrix(&numbers, size)));
    }
    Some(found.into_iter().map(|own| g.number(own)).collect())
}

/// The determinants up to the first that vanishes: the products of the first column of Routh's array (Routh 1877), which takes m² operations.
fn products_of_routh(coefficients: &[RBig]) -> Vec<RBig> {
    let every_second = |from: usize| -> Vec<RBig> {
        coefficients[from.min(coefficients.len())..]
            .iter()
            .step_by(2)
            .cloned()
            .collect()
    };
    let (mut above, mut row) = (every_second(0), every_second(1));
    let (mut found, mut product) = (Vec::new(), RBig::ONE);
    while let Some(first) = row.first() {
        product *= first;
        found.push(product.clone());
        if first.is_zero() {
            break;
        }
        let factor = &above[0] / first;
        let entry = |j: usize| match row.get(j) {
            Some(own) => &above[j] - &factor * own,
            None => above[j].clone(),
        };
        meter::spend((above.len() * (1 + length(&factor))) as u64);
        let next = (1..above.len()).map(entry).collect();
        (above, row) = (row, next);
    }
    found
}

/// Hurwitz's matrix, of coefficients with the leading one first.
fn hurwitz_matrix(coefficients: &[RBig], size: usize) -> Vec<Vec<RBig>> {
    let entry = |row: usize, column: usize| {
        let place = (2 * (column + 1)).checked_sub(row + 1);
        let own = place.and_then(|at| coefficients.get(at));
        own.cloned().unwrap_or(RBig::ZERO)
    };
    let row = |r: usize| (0..size).map(|c| entry(r, c)).collect();
    (0..size).map(row).collect()
}

fn determinant_of_numbers(mut rows: Vec<Vec<RBig>>) -> RBig {
    let mut product = RBig::ONE;
    for at in 0..rows.len() {
        let Some(pivot) = (at..rows.len()).find(|&r| !rows[r][at].is_zero()) else {
            return RBig::ZERO;
        };
        if pivot != at {
            rows.swap(pivot, at);
            product = -product;
        }
        product *= &rows[at][at];
        let (above, below) = rows.split_at_mut(at + 1);
        let own = &above[at];
        for row in below.iter_mut().filter(|row| !row[at].is_zero()) {
            let factor = &row[at] / &own[at];
            meter::spend((row.len() * (1 + length(&factor))) as u64);
            for (entry, by) in row[at..].iter_mut().zip(&own[at..]) {
                *entry -= &factor * by;
            }
        }
    }
    product
}

/// The length of a number in words.
fn length(number: &RBig) -> usize {
    (number.numerator().bit_len() + number.denominator().bit_len()) / 64
}

/// What becomes of the eigenvalues at a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// A real eigenvalue passes through zero.
    Zero,
    /// An eigenvalue is zero, on both sides of that value the stability is the same, and the product of all has one sign: none passes, or several do at once.
    ZeroTouching,
    /// A pair of eigenvalues passes the imaginary axis.
    Pair,
    /// Several pairs of eigenvalues are on the imaginary axis at once.
    Pairs,
    /// The leading coefficient vanishes: an eigenvalue goes to infinity.
    Infinity,
    /// The equations determine no accelerations there, though no eigenvalue goes to infinity.
    Singular,
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
    /// Whether all deciding polynomials have all their zeros left of the axis.
    pub is_left: bool,
    /// Whether, where they have not, one of them has a zero right of it, or is not real: where two zeros are opposite for all values, both may lie on
    /// the axis.
    pub is_decided: bool,
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
    /// Whether no enclosure holds boundaries of two functions that may be different ones.
    pub are_apart: bool,
    /// The zeros that are the boundaries.
    pub(crate) zeros: Vec<Zero>,
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
    let found = ranges_within(g, (polynomials, leading), symbol, (low, high), USUAL)?;
    if found.are_apart {
        return Some(found);
    }
    ranges_within(g, (polynomials, leading), symbol, (low, high), FINE)
}

/// The same with boundaries enclosed to a power of two.
pub(crate) fn ranges_within(
    g: &Graph,
    (polynomials, leading): (&[Deciding], Expr),
    symbol: Symbol,
    (low, high): (&RBig, &RBig),
    halvings: usize,
) -> Option<Ranges> {
    let range = Over {
        g,
        symbol,
        low,
        high,
        halvings,
    };
    let mut lists = Vec::new();
    let mut all = Boundaries::new();
    for own in polynomials {
        let (list, boundaries) = range.of(own)?;
        all.extend(boundaries);
        lists.push(list);
    }
    let mut of_masses = range.boundaries(leading, Crossing::Singular)?;
    for (boundary, zero) in &mut of_masses {
        let goes_off = |own: &(Boundary, Zero)| {
            own.0.crossing == Crossing::Infinity
                && own.1.root.low <= zero.root.high
                && zero.root.low <= own.1.root.high
        };
        if all.iter().any(goes_off) {
            boundary.crossing = Crossing::Infinity;
        }
    }
    all.splice(0..0, of_masses);
    let zeros: Vec<Zero> = all.iter().map(|(_, zero)| zero.clone()).collect();
    let are_apart = !overlap(&zeros);
    name_several(&mut all);
    let mut boundaries = distinct(all.into_iter().map(|own| own.0).collect());
    let mut regions: Vec<Region> = Vec::new();
    let domain = Domain::of(g, &lists.concat(), symbol);
    let roots = boundaries.iter().map(|own| own.root.clone());
    let cuts = joined(roots.chain(domain.ends(&range)?));
    let lows = std::iter::once(low).chain(cuts.iter().map(|root| &root.high));
    let highs = cuts.iter().map(|root| &root.low).chain([high]);
    for (a, b) in lows.zip(highs).filter(|(a, b)| a < b) {
        let sample = (a + b) / RBig::from(2);
        let is_real = domain.holds(g, symbol, &sample)?;
        let side = if is_real {
            range.side(&lists, &sample)?
        } else {
            Side::Right
        };
        regions.push(Region {
            low: a.clone(),
            high: b.clone(),
            is_left: side == Side::Left,
            is_decided: side != Side::Opposite,
            sample,
        });
    }
    name_pairs(&mut boundaries, &regions);
    range.name_zeros(polynomials, &mut boundaries, &regions);
    Some(Ranges {
        boundaries,
        regions,
        are_apart,
        zeros,
    })
}

/// Where the functions of a range are real.
struct Domain {
    conditions: Vec<Condition>,
}

impl Domain {
    fn of(g: &Graph, functions: &[Expr], symbol: Symbol) -> Domain {
        let all = conditions(g, functions).into_iter();
        // Poles are no ends: on both sides of one the functions are real.
        let of_symbol = |own: &Condition| {
            own.relation != Relation::NotEqual && g.contains_any(own.function, &[symbol])
        };
        Domain {
            conditions: all.filter(of_symbol).collect(),
        }
    }

    /// Where it begins or ends.
    fn ends(&self, range: &Over<'_>) -> Option<Vec<Root>> {
        let (g, span) = (range.g, (range.low, range.high));
        let of = |own: &Condition| {
            let zeros = zeros_of_factors(g, own.function, range.symbol, span, range.halvings)?;
            Some(zeros.into_iter().map(|own| own.root))
        };
        let all: Option<Vec<_>> = self.conditions.iter().map(of).collect();
        Some(all?.into_iter().flatten().collect())
    }

    fn holds(&self, g: &Graph, symbol: Symbol, at: &RBig) -> Option<bool> {
        let holds = |own: &Condition| Some(own.holds(sign_at(g, own.function, symbol, at)?));
        let all: Option<Vec<bool>> = self.conditions.iter().map(holds).collect();
        Some(all?.into_iter().all(|own| own))
    }
}

/// Boundaries, each with the zero that it is.
type Boundaries = Vec<(Boundary, Zero)>;

/// A range of one parameter.
struct Over<'a> {
    g: &'a Graph,
    symbol: Symbol,
    low: &'a RBig,
    high: &'a RBig,
    halvings: usize,
}

impl Over<'_> {
    /// The zeros of a function as boundaries.
    fn boundaries(&self, e: Expr, crossing: Crossing) -> Option<Boundaries> {
        if self.g.as_number(e).is_some_and(|_| !self.g.is_zero(e)) {
            return Some(Vec::new());
        }
        let zeros = zeros_of_factors(self.g, e, self.symbol, (self.low, self.high), self.halvings)?;
        let boundary = |zero: Zero| {
            let root = zero.root.clone();
            (Boundary { root, crossing }, zero)
        };
        Some(zeros.into_iter().map(boundary).collect())
    }

    /// Leading coefficient and determinants of a polynomial, and where the numbers of zeros on both sides of the axis may change: where a zero
    /// is at infinity or at 0, or two are opposite, as Δ_{m−1} says (Orlando 1911).
    fn of(&self, own: &Deciding) -> Option<(Vec<Expr>, Boundaries)> {
        let leading = *own.coefficients.last()?;
        let list = determinants(self.g, &own.coefficients);
        let pair = if own.is_paired {
            Crossing::Collision
        } else {
            Crossing::Pair
        };
        let mut all = self.boundaries(leading, Crossing::Infinity)?;
        // Where all coefficients vanish, as those of b λ² + sin b do at b = 0, no zero needs to go to infinity.
        let stays_finite = |zero: &Zero| {
            let mut others = own.coefficients.iter().rev().skip(1);
            let sign = |&e: &Expr| sign_over(self.g, e, self.symbol, &zero.root);
            !others.any(|e| matches!(sign(e), Some(Ordering::Less | Ordering::Greater)))
        };
        for (boundary, zero) in &mut all {
            if stays_finite(zero) {
                boundary.crossing = Crossing::Singular;
            }
        }
        all.extend(self.boundaries(*own.coefficients.first()?, Crossing::Zero)?);
        let from_end = |k: usize| list.len().checked_sub(k).and_then(|at| list.get(at));
        if let Some(&last) = from_end(2) {
            let mut pairs = self.boundaries(last, pair)?;
            // Where Δ_{m−3} vanishes too there are two of them, as zeros of the even and the odd part have two squares in common.
            let before = from_end(4).filter(|_| !pairs.is_empty() && !own.is_paired);
            let before = before
                .and_then(|&e| self.boundaries(e, pair))
                .unwrap_or_default();
            for (boundary, zero) in &mut pairs {
                if before.iter().any(|(_, other)| other == zero) {
                    boundary.crossing = Crossing::Pairs;
                }
            }
            all.extend(pairs);
        }
        Some(([vec![leading], list].concat(), all))
    }

    /// Where the constant coefficient vanishes without a change of its sign, nor of the stability, as at a double zero of it, nothing needs to pass.
    fn name_zeros(&self, polynomials: &[Deciding], all: &mut [Boundary], regions: &[Region]) {
        for boundary in all.iter_mut().filter(|b| b.crossing == Crossing::Zero) {
            let Some([before, after]) = beside(boundary, regions) else {
                continue;
            };
            let is_same = |own: &Deciding| {
                let sign = |region: &Region| {
                    let constant = *own.coefficients.first()?;
                    sign_at(self.g, constant, self.symbol, &region.sample)
                };
                sign(before).is_some_and(|own| Some(own) == sign(after))
            };
            if before.is_left == after.is_left && polynomials.iter().all(is_same) {
                boundary.crossing = Crossing::ZeroTouching;
            }
        }
    }

    /// Where the zeros of some polynomials lie, each given by its leading coefficient and its determinants.
    fn side(&self, lists: &[Vec<Expr>], at: &RBig) -> Option<Side> {
        let signs = |list: &Vec<Expr>| -> Option<Vec<Ordering>> {
            let signs = list.iter().map(|&e| sign_at(self.g, e, self.symbol, at));
            signs.collect()
        };
        let all: Option<Vec<Vec<Ordering>>> = lists.iter().map(signs).collect();
        let sides = all?.into_iter().map(|signs| Side::of(&signs));
        Some(sides.max().unwrap_or(Side::Left))
    }
}

/// Where the zeros of a polynomial lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Side {
    /// All left of the axis.
    Left,
    /// Not all left of it; two are opposite, or one is zero, and nothing else is known.
    Opposite,
    /// One is right of it.
    Right,
}

impl Side {
    /// By the signs of the leading coefficient and of the determinants of the polynomial as it stands.
    pub(crate) fn of(signs: &[Ordering]) -> Side {
        if are_positive(signs) {
            return Side::Left;
        }
        // Without two opposite zeros none lies on the axis (Orlando 1911).
        let list = signs.get(1..).unwrap_or_default();
        let mut last = list.iter().rev().take(2);
        if last.any(|sign| *sign == Ordering::Equal) {
            Side::Opposite
        } else {
            Side::Right
        }
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

/// Pairs of several polynomials at one value.
fn name_several(all: &mut Boundaries) {
    let is_pair = |own: &Boundary| own.crossing == Crossing::Pair;
    let pairs: Vec<Zero> = all
        .iter()
        .filter(|own| is_pair(&own.0))
        .map(|own| own.1.clone())
        .collect();
    for (boundary, zero) in all.iter_mut().filter(|own| is_pair(&own.0)) {
        if pairs.iter().filter(|own| *own == zero).count() > 1 {
            boundary.crossing = Crossing::Pairs;
        }
    }
}

/// Where Δ_{m−1} vanishes two eigenvalues are opposite (Orlando 1911): a pair on the axis where the stability changes, and otherwise perhaps λ and
/// −λ, as those of a bicycle at rest.
fn name_pairs(boundaries: &mut [Boundary], regions: &[Region]) {
    for boundary in boundaries.iter_mut().filter(|b| {
        matches!(
            b.crossing,
            Crossing::Pair | Crossing::Pairs | Crossing::Collision
        )
    }) {
        let changes = beside(boundary, regions).is_some_and(|[a, b]| a.is_left != b.is_left);
        if !changes {
            boundary.crossing = Crossing::Touching;
        }
    }
}

/// The regions on both sides of a boundary.
fn beside<'r>(boundary: &Boundary, regions: &'r [Region]) -> Option<[&'r Region; 2]> {
    let before = regions.iter().rfind(|r| r.high <= boundary.root.low)?;
    let after = regions.iter().find(|r| r.low >= boundary.root.high)?;
    Some([before, after])
}

impl Ranges {
    /// The same with regions that end at these values too.
    #[must_use]
    pub fn cut_at(&self, ends: &[Root]) -> Ranges {
        let mut regions: Vec<Region> = Vec::new();
        for own in &self.regions {
            let mut rest = own.clone();
            let is_inside = |end: &&Root| own.low < end.low && end.high < own.high;
            let mut inside: Vec<&Root> = ends.iter().filter(is_inside).collect();
            inside.sort_by(|a, b| a.low.cmp(&b.low));
            for end in inside.into_iter().filter(|end| end.low >= own.low) {
                let mut below = rest.clone();
                below.high = end.low.clone();
                below.sample = (&below.low + &below.high) / RBig::from(2);
                regions.push(below);
                rest.low = end.high.clone();
                rest.sample = (&rest.low + &rest.high) / RBig::from(2);
            }
            regions.push(rest);
        }
        Ranges {
            regions,
            ..self.clone()
        }
    }

    /// The same without the boundaries at which there is no motion.
    #[must_use]
    pub fn without(self, is_absent: &dyn Fn(&Root) -> bool) -> Ranges {
        let mut boundaries = self.boundaries;
        boundaries.retain(|own| !is_absent(&own.root));
        Ranges { boundaries, ..self }
    }

    /// The same for a person: without the boundaries at which two eigenvalues are opposite while others stay right of the axis, on both sides
    /// and, as is said of each, there.
    #[must_use]
    pub fn joined(&self, is_unstable_at: &dyn Fn(&Root) -> bool) -> Ranges {
        let (mut boundaries, mut regions) = (self.boundaries.clone(), self.regions.clone());
        let mut at = 0;
        while at + 1 < regions.len() {
            let is_unstable = |own: &Region| !own.is_left && own.is_decided;
            let is_same = is_unstable(&regions[at]) && is_unstable(&regions[at + 1]);
            let between = boundaries
                .iter()
                .position(|b| b.root.low >= regions[at].high && b.root.high <= regions[at + 1].low);
            match between {
                Some(place)
                    if is_same
                        && boundaries[place].crossing == Crossing::Touching
                        && is_unstable_at(&boundaries[place].root) =>
                {
                    boundaries.remove(place);
                    let next = regions.remove(at + 1);
                    regions[at].high = next.high;
                }
                _ => at += 1,
            }
        }
        boundaries.retain(|own| own.crossing != Crossing::Touching || !is_unstable_at(&own.root));
        Ranges {
            boundaries,
            regions,
            are_apart: self.are_apart,
            zeros: self.zeros.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(list: &[i64]) -> Vec<RBig> {
        list.iter().map(|&x| RBig::from(x)).collect()
    }

    /// Of 1 + 2 λ + 2 λ² + λ³ they are 2, 2·2 − 1·1 = 3 and 3, and the same with entries that the elimination meets as zeros.
    #[test]
    fn minors_of_numbers_are_those_of_expressions() {
        let g = Graph::new();
        let polynomials: [&[i64]; 5] = [
            &[1, 2, 2, 1],
            &[1, 0, 1],
            &[1, 1, 1, 1],
            &[3, 0, 0, 5, 2],
            &[-4, 7, 1, 0, 2, 3],
        ];
        let known = |list: &[i64]| {
            determinants(
                &g,
                &numbers(list)
                    .into_iter()
                    .map(|x| g.number(x))
                    .collect::<Vec<_>>(),
            )
        };
        let texts: Vec<String> = known(polynomials[0]).iter().map(|&e| g.text(e)).collect();
        assert_eq!(texts, ["2", "3", "3"]);
        for list in polynomials {
            // With a symbol in the place of a coefficient there is no number, and the minors are expanded.
            let symbol = g.symbol("c", 0);
            let mut own: Vec<Expr> = numbers(list).into_iter().map(|x| g.number(x)).collect();
            let value = std::mem::replace(&mut own[0], symbol);
            let expected = g.substitute_all(&determinants(&g, &own), &[(symbol, value)]);
            let expected: Vec<Expr> = expected.into_iter().map(|e| closed(&g, e)).collect();
            assert_eq!(known(list), expected, "{list:?}");
        }
    }
}
