//! Gröbner bases over a prime field, in graded reverse lexicographic order (B. Buchberger, 1965; criteria of R. Gebauer and H. M. Möller,
//! J. Symbolic Computation 6, 1988).

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::meter;
use crate::number::prime_field::{PrimeField, Residue};

/// More unknowns than this are not handled.
pub(super) const MOST_UNKNOWNS: usize = 40;
/// Products of terms in all; beyond it the equations are too large.
const MOST_WORK: u64 = 60_000_000;

/// A product of powers of unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Power {
    degree: u16,
    exponents: [u8; MOST_UNKNOWNS],
}

impl Power {
    /// The product of no unknowns.
    pub(super) const ONE: Power = Power {
        degree: 0,
        exponents: [0; MOST_UNKNOWNS],
    };

    /// One unknown; the caller has checked that its number is small enough.
    pub(super) fn unknown(index: usize) -> Power {
        let mut power = Power::ONE;
        power.exponents[index] = 1;
        power.degree = 1;
        power
    }

    fn combine(self, other: Power, op: impl Fn(u8, u8) -> u8) -> Power {
        let mut power = Power::ONE;
        for (k, exponent) in power.exponents.iter_mut().enumerate() {
            *exponent = op(self.exponents[k], other.exponents[k]);
            power.degree += u16::from(*exponent);
        }
        power
    }

    /// The product; exponents stay below 256 because degrees are bounded by the work.
    pub(super) fn times(self, other: Power) -> Power {
        self.combine(other, u8::saturating_add)
    }

    pub(super) fn divides(self, other: Power) -> bool {
        self.degree <= other.degree
            && self
                .exponents
                .iter()
                .zip(&other.exponents)
                .all(|(a, b)| a <= b)
    }

    /// The quotient by what divides it.
    fn over(self, divisor: Power) -> Power {
        self.combine(divisor, u8::saturating_sub)
    }

    fn least_common_multiple(self, other: Power) -> Power {
        self.combine(other, u8::max)
    }

    fn is_coprime_to(self, other: Power) -> bool {
        let mut pairs = self.exponents.iter().zip(&other.exponents);
        pairs.all(|(&a, &b)| a == 0 || b == 0)
    }

    /// Whether it is a power of this unknown alone, and not 1.
    pub(super) fn is_power_of(self, index: usize) -> bool {
        self.degree > 0 && u16::from(self.exponents[index]) == self.degree
    }
}

impl Ord for Power {
    fn cmp(&self, other: &Power) -> Ordering {
        self.degree.cmp(&other.degree).then_with(|| {
            let own = self.exponents.iter().rev();
            let pairs = own.zip(other.exponents.iter().rev());
            // The one with less of the last unknown in which they differ is larger.
            pairs
                .map(|(a, b)| b.cmp(a))
                .find(|order| order.is_ne())
                .unwrap_or(Ordering::Equal)
        })
    }
}

impl PartialOrd for Power {
    fn partial_cmp(&self, other: &Power) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A polynomial: terms by decreasing power, none of them zero.
pub(super) type Terms = Vec<(Power, Residue)>;

/// a + factor·b.
pub(super) fn add_scaled(field: &PrimeField, a: &Terms, b: &Terms, factor: Residue) -> Terms {
    add_shifted(field, a, b, factor, Power::ONE)
}

/// a + factor·power·b.
fn add_shifted(field: &PrimeField, a: &Terms, b: &Terms, factor: Residue, power: Power) -> Terms {
    let mut sum = Vec::with_capacity(a.len() + b.len());
    let mut left = a.iter().copied().peekable();
    let mut right = b
        .iter()
        .map(|&(p, c)| (p.times(power), field.mul(c, factor)))
        .peekable();
    loop {
        let order = match (left.peek(), right.peek()) {
            (Some((p, _)), Some((q, _))) => p.cmp(q),
            (Some(_), None) => Ordering::Greater,
            (None, Some(_)) => Ordering::Less,
            (None, None) => return sum,
        };
        let first = order.is_ge().then(|| left.next()).flatten();
        let second = order.is_le().then(|| right.next()).flatten();
        let term = match (first, second) {
            (Some((p, a)), Some((_, b))) => Some((p, field.add(a, b))),
            (one, other) => one.or(other),
        };
        sum.extend(term.filter(|(_, c)| !c.is_zero()));
    }
}

/// a·b.
pub(super) fn product(field: &PrimeField, a: &Terms, b: &Terms) -> Terms {
    meter::spend((a.len() * b.len()) as u64);
    let mut sums: BTreeMap<Power, Residue> = BTreeMap::new();
    for &(p, x) in a {
        for &(q, y) in b {
            let sum = sums.entry(p.times(q)).or_insert(Residue::ZERO);
            *sum = field.add(*sum, field.mul(x, y));
        }
    }
    let terms = sums.into_iter().rev();
    terms.filter(|(_, c)| !c.is_zero()).collect()
}

/// ∂a/∂x for one unknown.
pub(super) fn derivative(field: &PrimeField, a: &Terms, index: usize) -> Terms {
    let term = |&(power, c): &(Power, Residue)| {
        let exponent = power.exponents[index];
        let c = field.mul(c, field.from_u64(u64::from(exponent)));
        (exponent > 0).then(|| (power.over(Power::unknown(index)), c))
    };
    let mut terms: Terms = a.iter().filter_map(term).collect();
    terms.sort_by(|(p, _), (q, _)| q.cmp(p));
    terms
}

/// Two elements whose leading powers are to be cancelled.
#[derive(Clone, Copy, Debug)]
struct Pair {
    first: usize,
    second: usize,
    multiple: Power,
}

/// A Gröbner basis: monic polynomials.
#[derive(Clone, Debug)]
pub(super) struct Basis {
    field: PrimeField,
    elements: Vec<Terms>,
    /// Which of them have a leading power that no later one divides.
    is_needed: Vec<bool>,
    spent: u64,
}

/// The equations are too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TooLarge;

impl Basis {
    /// The basis of the ideal that the equations generate.
    pub(super) fn of(field: &PrimeField, equations: &[Terms]) -> Result<Basis, TooLarge> {
        let mut basis = Basis {
            field: *field,
            elements: Vec::new(),
            is_needed: Vec::new(),
            spent: 0,
        };
        let mut pairs: Vec<Pair> = Vec::new();
        let mut equations = equations.to_vec();
        equations.sort_by_key(|e| e.first().map(|(p, _)| *p));
        for equation in equations {
            basis.insert(equation, &mut pairs)?;
        }
        while let Some(next) = (0..pairs.len()).min_by_key(|&k| pairs[k].multiple) {
            let pair = pairs.swap_remove(next);
            let difference = basis.difference(pair);
            basis.insert(difference, &mut pairs)?;
            if basis.is_whole_ring() {
                break;
            }
        }
        Ok(basis)
    }

    /// Whether there are no solutions.
    pub(super) fn is_whole_ring(&self) -> bool {
        self.needed()
            .any(|e| e.first().is_some_and(|(p, _)| *p == Power::ONE))
    }

    /// The elements of a minimal basis.
    pub(super) fn needed(&self) -> impl Iterator<Item = &Terms> {
        let own = self.elements.iter().zip(&self.is_needed);
        own.filter(|(_, is_needed)| **is_needed).map(|(e, _)| e)
    }

    /// The leading powers of a minimal basis.
    pub(super) fn leading(&self) -> Vec<Power> {
        self.needed()
            .filter_map(|e| e.first().map(|(p, _)| *p))
            .collect()
    }

    /// The remainder of a polynomial: no term of it is divisible by a leading power.
    pub(super) fn remainder(&mut self, mut terms: Terms) -> Result<Terms, TooLarge> {
        let mut done: Terms = Vec::new();
        while let Some(&(power, coefficient)) = terms.first() {
            let mut needed = self.elements.iter().zip(&self.is_needed);
            let divisor = needed.find_map(|(e, &is_needed)| {
                let (lead, _) = e.first()?;
                (is_needed && lead.divides(power)).then_some((e, *lead))
            });
            match divisor {
                None => done.push(terms.remove(0)),
                Some((e, lead)) => {
                    let work = (terms.len() + e.len()) as u64;
                    self.spent += work;
                    meter::spend(work);
                    if self.spent > MOST_WORK {
                        return Err(TooLarge);
                    }
                    let factor = self.field.neg(coefficient);
                    terms = add_shifted(&self.field, &terms, e, factor, power.over(lead));
                }
            }
        }
        Ok(done)
    }

    /// The remainder of the determinant of a square matrix, row by row: of the minors of the first rows only remainders are kept.
    pub(super) fn determinant(&mut self, rows: &[Vec<Terms>]) -> Result<Terms, TooLarge> {
        let field = self.field;
        let mut minors = BTreeMap::from([(0_u64, vec![(Power::ONE, field.one())])]);
        for row in rows {
            let mut next: BTreeMap<u64, Terms> = BTreeMap::new();
            for (columns, minor) in &minors {
                for (column, entry) in row.iter().enumerate() {
                    if columns >> column & 1 == 1 || entry.is_empty() {
                        continue;
                    }
                    let is_odd = (columns >> column).count_ones() % 2 == 1;
                    let sign = if is_odd {
                        field.neg(field.one())
                    } else {
                        field.one()
                    };
                    let product = product(&field, entry, minor);
                    let sum = next.entry(columns | 1 << column).or_default();
                    *sum = add_scaled(&field, sum, &product, sign);
                }
            }
            for minor in next.values_mut() {
                *minor = self.remainder(std::mem::take(minor))?;
            }
            next.retain(|_, minor| !minor.is_empty());
            minors = next;
        }
        Ok(minors.into_values().next().unwrap_or_default())
    }

    fn difference(&self, pair: Pair) -> Terms {
        let shifted = |index: usize| {
            let e = &self.elements[index];
            let lead = e.first().map_or(Power::ONE, |(p, _)| *p);
            (e, pair.multiple.over(lead))
        };
        let ((a, p), (b, q)) = (shifted(pair.first), shifted(pair.second));
        let one = self.field.one();
        let left = add_shifted(&self.field, &Vec::new(), a, one, p);
        add_shifted(&self.field, &left, b, self.field.neg(one), q)
    }

    fn insert(&mut self, terms: Terms, pairs: &mut Vec<Pair>) -> Result<(), TooLarge> {
        let rest = self.remainder(terms)?;
        let Some(&(lead, coefficient)) = rest.first() else {
            return Ok(());
        };
        let Some(reciprocal) = self.field.inv(coefficient) else {
            return Ok(());
        };
        let monic = rest
            .iter()
            .map(|&(p, c)| (p, self.field.mul(c, reciprocal)));
        let monic: Terms = monic.collect();
        self.update(pairs, lead);
        self.elements.push(monic);
        self.is_needed.push(true);
        Ok(())
    }

    /// The pairs that remain to be looked at when an element with this leading power is added.
    fn update(&mut self, pairs: &mut Vec<Pair>, lead: Power) {
        let own = self.elements.len();
        let leading = |index: usize| self.elements[index].first().map_or(Power::ONE, |(p, _)| *p);
        let multiple = |index: usize| leading(index).least_common_multiple(lead);
        pairs.retain(|pair| {
            !lead.divides(pair.multiple)
                || multiple(pair.first) == pair.multiple
                || multiple(pair.second) == pair.multiple
        });
        let candidates: Vec<usize> = (0..own).filter(|&k| self.is_needed[k]).collect();
        for (place, &index) in candidates.iter().enumerate() {
            let is_coprime = |k: usize| leading(k).is_coprime_to(lead);
            if is_coprime(index) {
                continue;
            }
            let covers = |(other_place, &other): (usize, &usize)| {
                let (mine, its) = (multiple(index), multiple(other));
                other_place != place
                    && its.divides(mine)
                    && (its != mine || other_place < place || is_coprime(other))
            };
            if candidates.iter().enumerate().any(covers) {
                continue;
            }
            pairs.push(Pair {
                first: index,
                second: own,
                multiple: multiple(index),
            });
        }
        let replaced: Vec<usize> = candidates
            .into_iter()
            .filter(|&k| lead.divides(leading(k)))
            .collect();
        for index in replaced {
            self.is_needed[index] = false;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field() -> PrimeField {
        PrimeField::new((1 << 61) - 1).unwrap()
    }

    fn poly(field: &PrimeField, terms: &[(&[usize], i64)]) -> Terms {
        terms.iter().fold(Vec::new(), |sum, (unknowns, c)| {
            let power = unknowns
                .iter()
                .fold(Power::ONE, |p, &k| p.times(Power::unknown(k)));
            add_scaled(field, &sum, &vec![(power, field.from_i64(*c))], field.one())
        })
    }

    /// x² + y² = 1, x y = 1/2: the circle touches the hyperbola; (x − y)² is in the ideal and x − y is not.
    #[test]
    fn a_touching_circle() {
        let field = field();
        let equations = [
            poly(&field, &[(&[0, 0], 1), (&[1, 1], 1), (&[], -1)]),
            poly(&field, &[(&[0, 1], 2), (&[], -1)]),
        ];
        let mut basis = Basis::of(&field, &equations).unwrap();
        let square = poly(&field, &[(&[0, 0], 1), (&[0, 1], -2), (&[1, 1], 1)]);
        assert!(basis.remainder(square).unwrap().is_empty());
        let root = poly(&field, &[(&[0], 1), (&[1], -1)]);
        assert!(!basis.remainder(root).unwrap().is_empty());
    }

    /// x + y cannot be 0 and 1.
    #[test]
    fn no_solutions_at_all() {
        let field = field();
        let equations = [
            poly(&field, &[(&[0], 1), (&[1], 1)]),
            poly(&field, &[(&[0], 1), (&[1], 1), (&[], -1)]),
        ];
        assert!(Basis::of(&field, &equations).unwrap().is_whole_ring());
    }
}
