//! Towers of simple extensions of a prime field: the ring of all points of a constraint at once.
//!
//! A level adjoins one element x with a monic equation x^d = −Σ c_i x^i over the levels below: a dependent
//! symbol with its constraint, or a root whose radicand is not a scalar. The tower is a ring, not nearly always a field: when a
//! division meets a zero divisor, the tower falls apart into two, and both are followed (dynamic evaluation;
//! J. Della Dora, C. Dicrescenzo and D. Duval, EUROCAL '85). So nothing needs to be factored, no point over the prime
//! field needs to exist, and an identity is tested on every component.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::ring::{NoSquareRoot, Ring};
use crate::number::modular_matrix;
use crate::number::prime_field::{PrimeField, Residue};

/// Coordinates in the products of powers of the adjoined elements, the lowest level varying fastest. Missing coordinates are 0.
pub(super) type Element = Vec<Residue>;

/// Towers of a larger dimension are not used.
const LARGEST_DIMENSION: usize = 64;

/// One adjoined element: x^d = −Σ equation[i] x^i.
#[derive(Clone, Debug, PartialEq)]
struct Level {
    equation: Vec<Element>,
    /// Dimension of the ring below.
    below: usize,
}

/// Where a tower falls apart: at this level the equation is the product of two.
#[derive(Clone, Debug)]
pub(super) struct Split {
    pub(super) level: usize,
    pub(super) factors: [Vec<Element>; 2],
}

/// The tower; it grows while a program is run in it.
#[derive(Debug)]
pub(super) struct Tower<'a> {
    field: PrimeField,
    /// Signs of the roots of scalars.
    negative: &'a [bool],
    /// Roots that are adjoined even where the radicand is a scalar.
    adjoined: &'a [bool],
    levels: RefCell<Vec<Level>>,
    /// Equations prescribed for the first levels, found by splitting.
    prescribed: &'a [Option<Vec<Element>>],
    /// Roots already adjoined.
    roots: RefCell<BTreeMap<u32, Element>>,
    /// The zero divisor met last.
    zero_divisor: RefCell<Option<Element>>,
    too_large: RefCell<bool>,
}

impl<'a> Tower<'a> {
    pub(super) fn new(
        field: PrimeField,
        negative: &'a [bool],
        prescribed: &'a [Option<Vec<Element>>],
    ) -> Self {
        Self {
            field,
            negative,
            adjoined: &[],
            levels: RefCell::default(),
            prescribed,
            roots: RefCell::default(),
            zero_divisor: RefCell::default(),
            too_large: RefCell::default(),
        }
    }

    /// The same where these roots are adjoined whatever their radicand is at a point, so that both signs are followed: √(x² + y²) over
    /// a solution of z² = x² + y² for x is z or −z, and a claim may be true of one of them.
    pub(super) fn adjoining(self, adjoined: &'a [bool]) -> Self {
        Self { adjoined, ..self }
    }

    /// The value of a root that is known already.
    pub(super) fn set_root(&self, radical: u32, root: Element) {
        self.roots.borrow_mut().insert(radical, root);
    }

    /// Dimension over the prime field.
    pub(super) fn dimension(&self) -> usize {
        dimension(&self.levels.borrow())
    }

    /// Was a larger dimension asked for than allowed?
    pub(super) fn is_too_large(&self) -> bool {
        *self.too_large.borrow()
    }

    /// Adjoins x with Σ equation[i] x^i = 0 (not monic, leading coefficient last); returns x. `None` if the leading coefficient is no unit
    /// (see [`Tower::split`]) or the tower would become too large.
    pub(super) fn adjoin(&self, equation: &[Element]) -> Option<Element> {
        let index = self.levels.borrow().len();
        let monic = match self.prescribed.get(index).cloned().flatten() {
            Some(prescribed) => prescribed,
            None => {
                let (leading, rest) = equation.split_last()?;
                let reciprocal = self.invert(leading)?;
                rest.iter().map(|c| self.mul(c, &reciprocal)).collect()
            }
        };
        let below = self.dimension();
        if below * monic.len() > LARGEST_DIMENSION {
            *self.too_large.borrow_mut() = true;
            return None;
        }
        // A linear equation adjoins nothing: x is its root.
        let x = match &monic[..] {
            [] => return None,
            [constant] => self.negate(constant),
            _ => {
                let mut x = vec![Residue::ZERO; below];
                x.push(self.field.one());
                x
            }
        };
        self.levels.borrow_mut().push(Level {
            equation: monic,
            below,
        });
        Some(x)
    }

    /// The first level that adjoins something, with its monic equation without the leading one.
    pub(super) fn first_extension(&self) -> Option<(usize, Vec<Element>)> {
        let levels = self.levels.borrow();
        let index = levels.iter().position(|level| level.equation.len() > 1)?;
        Some((index, levels[index].equation.clone()))
    }

    /// The equations of the first `count` levels.
    pub(super) fn equations(&self, count: usize) -> Vec<Option<Vec<Element>>> {
        self.levels
            .borrow()
            .iter()
            .take(count)
            .map(|level| Some(level.equation.clone()))
            .collect()
    }

    /// Where the zero divisor met last takes the tower apart.
    pub(super) fn split(&self) -> Option<Split> {
        let divisor = self.zero_divisor.borrow_mut().take()?;
        self.split_by(divisor)
    }

    /// Where this zero divisor takes the tower apart.
    pub(super) fn split_by(&self, mut divisor: Element) -> Option<Split> {
        let levels = self.levels.borrow().clone();
        // Each round goes down at least one level.
        for _ in 0..=levels.len() {
            trim(&mut divisor);
            let top = levels
                .iter()
                .rposition(|level| level.equation.len() > 1 && level.below < divisor.len())?;
            let below = &levels[..top];
            let mut modulus = levels[top].equation.clone();
            modulus.push(vec![self.field.one()]);
            let polynomial: Vec<Element> = divisor
                .chunks(levels[top].below)
                .map(<[Residue]>::to_vec)
                .collect();
            match self.gcd(below, &modulus, &polynomial) {
                Ok(factor) if factor.len() > 1 && factor.len() < modulus.len() => {
                    let (quotient, _) = self.divide(below, &modulus, &factor);
                    let strip = |mut equation: Vec<Element>| {
                        equation.pop();
                        equation
                    };
                    return Some(Split {
                        level: top,
                        factors: [strip(factor), strip(quotient)],
                    });
                }
                Ok(_) => return None,
                Err(lower) => divisor = lower,
            }
        }
        None
    }

    /// The monic greatest common divisor of polynomials over the lower levels; `Err` with a zero divisor of those.
    fn gcd(&self, below: &[Level], a: &[Element], b: &[Element]) -> Result<Vec<Element>, Element> {
        let (mut a, mut b) = (a.to_vec(), b.to_vec());
        loop {
            trim_polynomial(&mut b);
            let Some(leading) = b.last() else {
                return Ok(a);
            };
            let reciprocal = self
                .invert_in(below, leading)
                .ok_or_else(|| leading.clone())?;
            let monic: Vec<Element> = b
                .iter()
                .map(|c| self.mul_in(below, c, &reciprocal))
                .collect();
            let (_, rest) = self.divide(below, &a, &monic);
            a = monic;
            b = rest;
        }
    }

    /// Quotient and remainder by a monic polynomial.
    fn divide(
        &self,
        below: &[Level],
        a: &[Element],
        monic: &[Element],
    ) -> (Vec<Element>, Vec<Element>) {
        let mut rest = a.to_vec();
        let degree = monic.len() - 1;
        let mut quotient = vec![Vec::new(); a.len().saturating_sub(degree)];
        while rest.len() > degree {
            let Some(leading) = rest.pop() else { break };
            let shift = rest.len() - degree;
            for (i, c) in monic[..degree].iter().enumerate() {
                let product = self.mul_in(below, &leading, c);
                self.subtract(&mut rest[shift + i], &product);
            }
            quotient[shift] = leading;
        }
        (quotient, rest)
    }

    fn subtract(&self, a: &mut Element, b: &[Residue]) {
        if a.len() < b.len() {
            a.resize(b.len(), Residue::ZERO);
        }
        for (x, y) in a.iter_mut().zip(b) {
            *x = self.field.sub(*x, *y);
        }
    }

    fn negate(&self, a: &[Residue]) -> Element {
        a.iter().map(|x| self.field.neg(*x)).collect()
    }

    /// a·b over these levels. Recursion goes down the levels, of which there are few.
    fn mul_in(&self, levels: &[Level], a: &[Residue], b: &[Residue]) -> Element {
        let levels = needed(levels, a.len().max(b.len()));
        let Some((top, below)) = levels.split_last() else {
            return match (a, b) {
                ([x, ..], [y, ..]) => vec![self.field.mul(*x, *y)],
                _ => Vec::new(),
            };
        };
        if a.is_empty() || b.is_empty() {
            return Vec::new();
        }
        let width = top.below;
        crate::meter::spend((a.len() * b.len()) as u64);
        let (blocks_a, blocks_b): (Vec<_>, Vec<_>) =
            (a.chunks(width).collect(), b.chunks(width).collect());
        let mut product: Vec<Element> = vec![Vec::new(); blocks_a.len() + blocks_b.len() - 1];
        for (i, x) in blocks_a.iter().enumerate() {
            for (j, y) in blocks_b.iter().enumerate() {
                let part = self.mul_in(below, x, y);
                self.accumulate(&mut product[i + j], &part);
            }
        }
        let degree = top.equation.len();
        while product.len() > degree {
            let Some(leading) = product.pop() else { break };
            let shift = product.len() - degree;
            for (i, c) in top.equation.iter().enumerate() {
                let part = self.mul_in(below, &leading, c);
                self.subtract(&mut product[shift + i], &part);
            }
        }
        join(product, width)
    }

    fn accumulate(&self, a: &mut Element, b: &[Residue]) {
        if a.len() < b.len() {
            a.resize(b.len(), Residue::ZERO);
        }
        for (x, y) in a.iter_mut().zip(b) {
            *x = self.field.add(*x, *y);
        }
    }

    /// 1/a over these levels, by the matrix of the multiplication by a.
    fn invert_in(&self, levels: &[Level], a: &[Residue]) -> Option<Element> {
        if let [scalar] = a {
            return Some(vec![self.field.inv(*scalar)?]);
        }
        let levels = needed(levels, a.len());
        let size = dimension(levels);
        let mut matrix = vec![Residue::ZERO; size * size];
        for column in 0..size {
            let mut unit = vec![Residue::ZERO; column];
            unit.push(self.field.one());
            for (row, entry) in self.mul_in(levels, a, &unit).into_iter().enumerate() {
                matrix[row * size + column] = entry;
            }
        }
        let mut one = vec![Residue::ZERO; size];
        one[0] = self.field.one();
        let mut inverse =
            modular_matrix::factorize(&self.field, size, matrix)?.solve(&self.field, &one);
        trim(&mut inverse);
        Some(inverse)
    }
}

fn dimension(levels: &[Level]) -> usize {
    levels.iter().map(|level| level.equation.len()).product()
}

/// The levels that an element of this length reaches.
fn needed(levels: &[Level], length: usize) -> &[Level] {
    let count = levels
        .iter()
        .rposition(|level| level.equation.len() > 1 && level.below < length)
        .map_or(0, |top| top + 1);
    &levels[..count]
}

fn join(blocks: Vec<Element>, width: usize) -> Element {
    let mut joined = Vec::with_capacity(blocks.len() * width);
    for (i, block) in blocks.into_iter().enumerate() {
        joined.resize(i * width, Residue::ZERO);
        joined.extend(block);
    }
    trim(&mut joined);
    joined
}

fn trim(a: &mut Element) {
    while a.last().is_some_and(|x| x.is_zero()) {
        a.pop();
    }
}

fn trim_polynomial(a: &mut Vec<Element>) {
    while a.last().is_some_and(|c| c.iter().all(|x| x.is_zero())) {
        a.pop();
    }
}

impl Ring for Tower<'_> {
    type Element = Element;
    /// The matrix, reduced to triangular form with the same operations applied to the unit matrix would cost more
    /// than it saves in these small rings: the matrix itself.
    type Factors = (usize, Vec<Element>);

    fn field(&self) -> &PrimeField {
        &self.field
    }

    fn scalar(&self, value: Residue) -> Element {
        if value.is_zero() {
            Vec::new()
        } else {
            vec![value]
        }
    }

    fn add_scaled(&self, sum: &mut Element, x: &Element, factor: Residue) {
        if sum.len() < x.len() {
            sum.resize(x.len(), Residue::ZERO);
        }
        for (s, x) in sum.iter_mut().zip(x) {
            *s = self.field.add(*s, self.field.mul(*x, factor));
        }
        trim(sum);
    }

    fn mul(&self, a: &Element, b: &Element) -> Element {
        if let ([x], [y]) = (&a[..], &b[..]) {
            return vec![self.field.mul(*x, *y)];
        }
        self.mul_in(&self.levels.borrow(), a, b)
    }

    fn invert(&self, a: &Element) -> Option<Element> {
        let inverse = match &a[..] {
            [] => return None,
            _ => self.invert_in(&self.levels.borrow(), a),
        };
        if inverse.is_none() {
            *self.zero_divisor.borrow_mut() = Some(a.clone());
        }
        inverse
    }

    fn is_zero(&self, a: &Element) -> bool {
        a.iter().all(|x| x.is_zero())
    }

    fn square_root(&self, a: &Element, radical: u32) -> Result<Element, NoSquareRoot> {
        if let Some(root) = self.roots.borrow().get(&radical) {
            return Ok(root.clone());
        }
        let root = match &a[..] {
            [] => return Err(NoSquareRoot::Exceptional),
            [scalar] if !self.adjoined.get(radical as usize).is_some_and(|&own| own) => {
                let root = self.field.sqrt(*scalar).ok_or(NoSquareRoot::NonSquare)?;
                let negative = self
                    .negative
                    .get(radical as usize)
                    .copied()
                    .unwrap_or(false);
                vec![if negative { self.field.neg(root) } else { root }]
            }
            _ => {
                let equation = [self.negate(a), Vec::new(), vec![self.field.one()]];
                self.adjoin(&equation).ok_or(NoSquareRoot::Exceptional)?
            }
        };
        self.roots.borrow_mut().insert(radical, root.clone());
        Ok(root)
    }

    fn odd_root(&self, a: &Element, degree: u64) -> Option<Element> {
        match &a[..] {
            [] => Some(Vec::new()),
            [scalar] => self
                .field
                .unique_root(*scalar, degree)
                .map(|root| vec![root]),
            // The other roots are complex; a proof for them too is more than is needed.
            _ if degree <= 7 => {
                let mut equation = vec![Vec::new(); degree as usize];
                equation[0] = self.negate(a);
                equation.push(vec![self.field.one()]);
                self.adjoin(&equation)
            }
            _ => None,
        }
    }

    fn factorize(&self, size: usize, matrix: Vec<Element>) -> Option<Self::Factors> {
        // Regularity is found out here, so that a singular matrix refuses the point before any right-hand side.
        self.eliminate(size, matrix.clone(), vec![Vec::new(); size])?;
        Some((size, matrix))
    }

    fn solve(&self, (size, matrix): &Self::Factors, rhs: &[Element]) -> Vec<Element> {
        self.eliminate(*size, matrix.clone(), rhs.to_vec())
            .unwrap_or_else(|| vec![Vec::new(); *size])
    }
}

impl Tower<'_> {
    /// Gauss–Jordan with unit pivots; `None` if a column has none (a zero divisor among its entries is remembered).
    fn eliminate(
        &self,
        size: usize,
        mut matrix: Vec<Element>,
        mut rhs: Vec<Element>,
    ) -> Option<Vec<Element>> {
        let minus_one = self.field.neg(self.field.one());
        for column in 0..size {
            let (pivot, reciprocal) = (column..size).find_map(|row| {
                let inverse = self.invert(&matrix[row * size + column])?;
                Some((row, inverse))
            })?;
            for k in 0..size {
                matrix.swap(pivot * size + k, column * size + k);
            }
            rhs.swap(pivot, column);
            for k in column..size {
                matrix[column * size + k] = self.mul(&matrix[column * size + k], &reciprocal);
            }
            rhs[column] = self.mul(&rhs[column], &reciprocal);
            for row in (0..size).filter(|&row| row != column) {
                let factor = matrix[row * size + column].clone();
                if self.is_zero(&factor) {
                    continue;
                }
                for k in column..size {
                    let product = self.mul(&factor, &matrix[column * size + k]);
                    self.add_scaled(&mut matrix[row * size + k], &product, minus_one);
                }
                let product = self.mul(&factor, &rhs[column]);
                self.add_scaled(&mut rhs[row], &product, minus_one);
            }
        }
        Some(rhs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::random::Random;

    fn number(field: &PrimeField, n: i64) -> Element {
        vec![field.from_i64(n)]
    }

    #[test]
    fn two_square_roots_multiply_and_invert() {
        let field = PrimeField::new((1 << 61) - 1).unwrap();
        let tower = Tower::new(field, &[], &[]);
        let x = tower
            .adjoin(&[number(&field, -3), Vec::new(), number(&field, 1)])
            .unwrap();
        let y = tower
            .adjoin(&[
                tower.mul(&number(&field, -1), &x),
                Vec::new(),
                number(&field, 1),
            ])
            .unwrap();
        assert_eq!(tower.mul(&x, &x), number(&field, 3));
        assert_eq!(tower.mul(&y, &y), x, "y = 3^(1/4)");
        assert_eq!(tower.dimension(), 4);
        let mut random = Random::new(3);
        for _ in 0..20 {
            let a: Element = (0..4).map(|_| field.random(&mut random)).collect();
            let b: Element = (0..4).map(|_| field.random(&mut random)).collect();
            assert_eq!(tower.mul(&a, &b), tower.mul(&b, &a));
            let inverse = tower.invert(&a).unwrap();
            assert_eq!(tower.mul(&a, &inverse), number(&field, 1));
        }
    }

    #[test]
    fn a_zero_divisor_takes_the_tower_apart() {
        // x² = 4: x − 2 is a zero divisor; the factors are x − 2 and x + 2.
        let field = PrimeField::new((1 << 61) - 1).unwrap();
        let tower = Tower::new(field, &[], &[]);
        let x = tower
            .adjoin(&[number(&field, -4), Vec::new(), number(&field, 1)])
            .unwrap();
        let mut divisor = x.clone();
        tower.add_scaled(&mut divisor, &number(&field, 1), field.from_i64(-2));
        assert!(tower.invert(&divisor).is_none());
        let split = tower.split().unwrap();
        assert_eq!(split.level, 0);
        assert_eq!(
            split.factors,
            [vec![number(&field, -2)], vec![number(&field, 2)]]
        );
        let prescribed = [Some(split.factors[0].clone())];
        let part = Tower::new(field, &[], &prescribed);
        assert_eq!(part.adjoin(&[]).unwrap(), number(&field, 2));
    }
}
