//! Fractions of polynomials in one dependent symbol over a tower: in this ring a constraint becomes the equation of that
//! symbol.
//!
//! Roots whose radicands contain the symbol are kept formally, ρ² = R; the equation is then the norm of the constraint, the product
//! over all signs. It has more solutions than the constraint, which are sorted out when the constraint is evaluated.

use std::cell::RefCell;

use super::ring::{NoSquareRoot, Ring};
use super::tower::{Element, Tower};
use crate::number::prime_field::{PrimeField, Residue};

/// Coefficients of the powers of the symbol, lowest first, without leading zeros.
type Poly = Vec<Element>;

/// More roots than this over the symbol are not handled.
const MOST_ROOTS: usize = 3;
/// Equations of higher degree are not handled.
const HIGHEST_DEGREE: usize = 48;

/// Σ numerator[mask]·Π ρ_i / denominator, the product over the bits i of mask.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fraction {
    numerator: Vec<Poly>,
    denominator: Poly,
}

/// The ring of fractions over a tower.
pub(super) struct Polynomials<'t, 'a> {
    tower: &'t Tower<'a>,
    /// The radicals adjoined formally, with the polynomials ρ².
    roots: RefCell<Vec<(u32, Poly, Fraction)>>,
    unsupported: RefCell<bool>,
}

impl<'t, 'a> Polynomials<'t, 'a> {
    pub(super) fn new(tower: &'t Tower<'a>) -> Self {
        Self {
            tower,
            roots: RefCell::default(),
            unsupported: RefCell::default(),
        }
    }

    /// The symbol itself.
    pub(super) fn symbol(&self) -> Fraction {
        self.fraction(vec![
            Vec::new(),
            self.tower.scalar(self.tower.field().one()),
        ])
    }

    /// An element of the tower.
    pub(super) fn constant(&self, element: Element) -> Fraction {
        self.fraction(if element.is_empty() {
            Vec::new()
        } else {
            vec![element]
        })
    }

    /// Did something occur that has no polynomial equation here?
    pub(super) fn is_unsupported(&self) -> bool {
        *self.unsupported.borrow()
    }

    /// The equation of the symbol that `constraint = 0` implies.
    pub(super) fn equation(&self, constraint: &Fraction) -> Poly {
        let conjugates = self.conjugates(&constraint.numerator);
        let norm = self.mul_masked(&constraint.numerator, &conjugates);
        norm.into_iter().next().unwrap_or_default()
    }

    fn fraction(&self, numerator: Poly) -> Fraction {
        Fraction {
            numerator: vec![numerator],
            denominator: self.one(),
        }
    }

    fn one(&self) -> Poly {
        vec![self.tower.scalar(self.tower.field().one())]
    }

    fn add_poly(&self, a: &mut Poly, b: &Poly, factor: Residue) {
        if a.len() < b.len() {
            a.resize(b.len(), Vec::new());
        }
        for (x, y) in a.iter_mut().zip(b) {
            self.tower.add_scaled(x, y, factor);
        }
        while a.last().is_some_and(Vec::is_empty) {
            a.pop();
        }
    }

    fn mul_poly(&self, a: &Poly, b: &Poly) -> Poly {
        if a.is_empty() || b.is_empty() {
            return Vec::new();
        }
        if a.len() + b.len() > 2 * HIGHEST_DEGREE {
            *self.unsupported.borrow_mut() = true;
            return Vec::new();
        }
        // Most are numbers.
        if let ([x], [y]) = (&a[..], &b[..]) {
            let product = self.tower.mul(x, y);
            return match product.is_empty() {
                true => Vec::new(),
                false => vec![product],
            };
        }
        let one = self.tower.field().one();
        let mut product: Poly = vec![Vec::new(); a.len() + b.len() - 1];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                self.tower
                    .add_scaled(&mut product[i + j], &self.tower.mul(x, y), one);
            }
        }
        while product.last().is_some_and(Vec::is_empty) {
            product.pop();
        }
        product
    }

    fn mul_masked(&self, a: &[Poly], b: &[Poly]) -> Vec<Poly> {
        let one = self.tower.field().one();
        let roots = self.roots.borrow();
        if let ([x], [y], true) = (a, b, roots.is_empty()) {
            return vec![self.mul_poly(x, y)];
        }
        let mut product: Vec<Poly> = vec![Vec::new(); 1 << roots.len()];
        for (i, x) in a.iter().enumerate() {
            for (j, y) in b.iter().enumerate() {
                let mut part = self.mul_poly(x, y);
                for (bit, (_, square, _)) in roots.iter().enumerate() {
                    if i & j >> bit & 1 == 1 {
                        part = self.mul_poly(&part, square);
                    }
                }
                self.add_poly(&mut product[i ^ j], &part, one);
            }
        }
        product
    }

    /// The product of all conjugates but the element itself.
    fn conjugates(&self, a: &[Poly]) -> Vec<Poly> {
        let count = self.roots.borrow().len();
        let minus_one = self.tower.field().neg(self.tower.field().one());
        let mut product = vec![self.one()];
        for signs in 1..1_usize << count {
            let conjugate: Vec<Poly> = a
                .iter()
                .enumerate()
                .map(|(mask, poly)| {
                    if (mask & signs).count_ones() % 2 == 0 {
                        return poly.clone();
                    }
                    let mut negated = Vec::new();
                    self.add_poly(&mut negated, poly, minus_one);
                    negated
                })
                .collect();
            product = self.mul_masked(&product, &conjugate);
        }
        product
    }
}

impl Ring for Polynomials<'_, '_> {
    type Element = Fraction;
    type Factors = (usize, Vec<Fraction>);

    fn field(&self) -> &PrimeField {
        self.tower.field()
    }

    fn scalar(&self, value: Residue) -> Fraction {
        self.constant(self.tower.scalar(value))
    }

    fn add_scaled(&self, sum: &mut Fraction, x: &Fraction, factor: Residue) {
        let scale = |numerator: &[Poly], by: &Poly| {
            numerator
                .iter()
                .map(|p| self.mul_poly(p, by))
                .collect::<Vec<_>>()
        };
        let mut added = x.numerator.clone();
        if sum.denominator != x.denominator {
            added = scale(&added, &sum.denominator);
            sum.numerator = scale(&sum.numerator, &x.denominator);
            sum.denominator = self.mul_poly(&sum.denominator, &x.denominator);
        }
        if sum.numerator.len() < added.len() {
            sum.numerator.resize(added.len(), Vec::new());
        }
        for (a, b) in sum.numerator.iter_mut().zip(&added) {
            self.add_poly(a, b, factor);
        }
    }

    fn mul(&self, a: &Fraction, b: &Fraction) -> Fraction {
        Fraction {
            numerator: self.mul_masked(&a.numerator, &b.numerator),
            denominator: self.mul_poly(&a.denominator, &b.denominator),
        }
    }

    fn invert(&self, a: &Fraction) -> Option<Fraction> {
        if self.is_zero(a) {
            return None;
        }
        let conjugates = self.conjugates(&a.numerator);
        let norm = self
            .mul_masked(&a.numerator, &conjugates)
            .into_iter()
            .next()?;
        if norm.is_empty() {
            return None;
        }
        let numerator = conjugates
            .iter()
            .map(|p| self.mul_poly(p, &a.denominator))
            .collect();
        Some(Fraction {
            numerator,
            denominator: norm,
        })
    }

    fn is_zero(&self, a: &Fraction) -> bool {
        a.numerator.iter().all(Vec::is_empty)
    }

    fn square_root(&self, a: &Fraction, radical: u32) -> Result<Fraction, NoSquareRoot> {
        if let Some((_, _, root)) = self.roots.borrow().iter().find(|(r, _, _)| *r == radical) {
            return Ok(root.clone());
        }
        if a.numerator.iter().skip(1).any(|p| !p.is_empty()) {
            *self.unsupported.borrow_mut() = true;
            return Err(NoSquareRoot::Exceptional);
        }
        let radicand = a.numerator.first().cloned().unwrap_or_default();
        if radicand.len() <= 1 && a.denominator.len() == 1 {
            // Free of the symbol: a root in the tower.
            let element = radicand.into_iter().next().unwrap_or_default();
            let quotient = self
                .tower
                .invert(&a.denominator[0])
                .map(|inverse| self.tower.mul(&element, &inverse));
            let quotient = quotient.ok_or(NoSquareRoot::Exceptional)?;
            return self
                .tower
                .square_root(&quotient, radical)
                .map(|root| self.constant(root));
        }
        let index = self.roots.borrow().len();
        if index >= MOST_ROOTS {
            *self.unsupported.borrow_mut() = true;
            return Err(NoSquareRoot::Exceptional);
        }
        // √(N/D) = √(N D)/D
        let square = self.mul_poly(&radicand, &a.denominator);
        let mut numerator = vec![Vec::new(); (1 << index) + 1];
        numerator[1 << index] = self.one();
        let root = Fraction {
            numerator,
            denominator: a.denominator.clone(),
        };
        self.roots
            .borrow_mut()
            .push((radical, square, root.clone()));
        Ok(root)
    }

    fn odd_root(&self, a: &Fraction, degree: u64) -> Option<Fraction> {
        let free = a.numerator.iter().skip(1).all(Vec::is_empty) && a.denominator.len() == 1;
        let element = match a.numerator.first() {
            Some(poly) if free && poly.len() <= 1 => poly.first().cloned().unwrap_or_default(),
            _ => {
                *self.unsupported.borrow_mut() = true;
                return None;
            }
        };
        let quotient = self
            .tower
            .mul(&element, &self.tower.invert(&a.denominator[0])?);
        self.tower
            .odd_root(&quotient, degree)
            .map(|root| self.constant(root))
    }

    fn factorize(&self, size: usize, matrix: Vec<Fraction>) -> Option<Self::Factors> {
        self.eliminate(size, matrix.clone(), vec![self.scalar(Residue::ZERO); size])?;
        Some((size, matrix))
    }

    fn solve(&self, (size, matrix): &Self::Factors, rhs: &[Fraction]) -> Vec<Fraction> {
        let zero = || vec![self.scalar(Residue::ZERO); *size];
        self.eliminate(*size, matrix.clone(), rhs.to_vec())
            .unwrap_or_else(zero)
    }
}

impl Polynomials<'_, '_> {
    fn eliminate(
        &self,
        size: usize,
        mut matrix: Vec<Fraction>,
        mut rhs: Vec<Fraction>,
    ) -> Option<Vec<Fraction>> {
        let minus_one = self.field().neg(self.field().one());
        for column in 0..size {
            let pivot = (column..size).find(|row| !self.is_zero(&matrix[row * size + column]))?;
            let reciprocal = self.invert(&matrix[pivot * size + column])?;
            for k in 0..size {
                matrix.swap(pivot * size + k, column * size + k);
            }
            rhs.swap(pivot, column);
            for row in (0..size).filter(|&row| row != column) {
                let factor = self.mul(&matrix[row * size + column], &reciprocal);
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
        (0..size)
            .map(|row| Some(self.mul(&rhs[row], &self.invert(&matrix[row * size + row])?)))
            .collect()
    }
}
