//! Polynomials in unknowns, as the ring in which constraints are run: what is algebraic over the unknowns becomes an unknown of its own,
//! with its equation: a reciprocal w of a with a w = 1, a root with its power, the solution of a linear system.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::super::ring::{NoSquareRoot, Ring};
use super::basis::{add_scaled, product, Power, Terms, MOST_UNKNOWNS};
use crate::number::prime_field::{PrimeField, Residue};

/// Longer polynomials are not handled.
const MOST_TERMS: usize = 4_000;

/// The ring.
pub(super) struct Unknowns<'a> {
    field: PrimeField,
    /// Signs of the roots of scalars.
    negative: &'a [bool],
    /// Roots that are adjoined even where the radicand is a scalar.
    adjoined: &'a [bool],
    state: RefCell<State>,
}

#[derive(Default)]
struct State {
    count: usize,
    equations: Vec<Terms>,
    roots: BTreeMap<u32, Terms>,
    reciprocals: BTreeMap<Vec<(Power, u64)>, Terms>,
    is_unsupported: bool,
}

impl<'a> Unknowns<'a> {
    pub(super) fn new(field: PrimeField, negative: &'a [bool], adjoined: &'a [bool]) -> Self {
        Self {
            field,
            negative,
            adjoined,
            state: RefCell::default(),
        }
    }

    /// A new unknown.
    pub(super) fn unknown(&self) -> Terms {
        let mut state = self.state.borrow_mut();
        if state.count == MOST_UNKNOWNS {
            state.is_unsupported = true;
            return Vec::new();
        }
        state.count += 1;
        vec![(Power::unknown(state.count - 1), self.field.one())]
    }

    /// A point of a circle.
    pub(super) fn circle(&self) -> (Terms, Terms) {
        let (cos, sin) = (self.unknown(), self.unknown());
        let one = self.field.one();
        let squares = add_scaled(
            &self.field,
            &self.mul(&cos, &cos),
            &self.mul(&sin, &sin),
            one,
        );
        self.vanishes(self.minus_one(&squares));
        (cos, sin)
    }

    /// States that a polynomial vanishes.
    pub(super) fn vanishes(&self, terms: Terms) {
        self.state.borrow_mut().equations.push(terms);
    }

    /// Was something met that has no equations?
    pub(super) fn is_unsupported(&self) -> bool {
        self.state.borrow().is_unsupported
    }

    /// The number of unknowns, their equations, and the roots among them.
    pub(super) fn finished(self) -> (usize, Vec<Terms>, BTreeMap<u32, Terms>) {
        let state = self.state.into_inner();
        (state.count, state.equations, state.roots)
    }

    fn minus_one(&self, terms: &Terms) -> Terms {
        let one = self.scalar(self.field.one());
        add_scaled(&self.field, terms, &one, self.field.neg(self.field.one()))
    }

    fn unsupported(&self) {
        self.state.borrow_mut().is_unsupported = true;
    }
}

/// The value of what contains no unknown.
pub(super) fn as_scalar(terms: &Terms) -> Option<Residue> {
    match terms.as_slice() {
        [] => Some(Residue::ZERO),
        [(power, c)] if *power == Power::ONE => Some(*c),
        _ => None,
    }
}

impl Ring for Unknowns<'_> {
    type Element = Terms;
    /// The size, and the matrix row by row.
    type Factors = (usize, Vec<Terms>);

    fn field(&self) -> &PrimeField {
        &self.field
    }

    fn scalar(&self, value: Residue) -> Terms {
        if value.is_zero() {
            Vec::new()
        } else {
            vec![(Power::ONE, value)]
        }
    }

    fn add_scaled(&self, sum: &mut Terms, x: &Terms, factor: Residue) {
        *sum = add_scaled(&self.field, sum, x, factor);
    }

    fn mul(&self, a: &Terms, b: &Terms) -> Terms {
        if a.len() * b.len() > MOST_TERMS || self.is_unsupported() {
            self.unsupported();
            return Vec::new();
        }
        product(&self.field, a, b)
    }

    fn invert(&self, a: &Terms) -> Option<Terms> {
        if let Some(scalar) = as_scalar(a) {
            return Some(self.scalar(self.field.inv(scalar)?));
        }
        let key: Vec<(Power, u64)> = a.iter().map(|&(p, c)| (p, self.field.to_u64(c))).collect();
        if let Some(known) = self.state.borrow().reciprocals.get(&key) {
            return Some(known.clone());
        }
        let reciprocal = self.unknown();
        self.vanishes(self.minus_one(&self.mul(a, &reciprocal)));
        self.state
            .borrow_mut()
            .reciprocals
            .insert(key, reciprocal.clone());
        Some(reciprocal)
    }

    fn is_zero(&self, a: &Terms) -> bool {
        a.is_empty()
    }

    fn square_root(&self, a: &Terms, radical: u32) -> Result<Terms, NoSquareRoot> {
        if let Some(root) = self.state.borrow().roots.get(&radical) {
            return Ok(root.clone());
        }
        let is_adjoined = self.adjoined.get(radical as usize).is_some_and(|&own| own);
        match as_scalar(a) {
            Some(scalar) if scalar.is_zero() => return Err(NoSquareRoot::Exceptional),
            Some(scalar) if !is_adjoined => {
                let root = self.field.sqrt(scalar).ok_or(NoSquareRoot::NonSquare)?;
                let is_negative = self.negative.get(radical as usize).is_some_and(|&own| own);
                let signed = if is_negative {
                    self.field.neg(root)
                } else {
                    root
                };
                return Ok(self.scalar(signed));
            }
            _ => {}
        }
        let root = self.unknown();
        let minus_one = self.field.neg(self.field.one());
        self.vanishes(add_scaled(
            &self.field,
            &self.mul(&root, &root),
            a,
            minus_one,
        ));
        self.state.borrow_mut().roots.insert(radical, root.clone());
        Ok(root)
    }

    fn odd_root(&self, a: &Terms, degree: u64) -> Option<Terms> {
        match as_scalar(a) {
            Some(scalar) => Some(self.scalar(self.field.unique_root(scalar, degree)?)),
            None => {
                self.unsupported();
                None
            }
        }
    }

    fn factorize(&self, size: usize, matrix: Vec<Terms>) -> Option<Self::Factors> {
        Some((size, matrix))
    }

    /// Unknowns with the linear system as their equations.
    fn solve(&self, (size, matrix): &Self::Factors, rhs: &[Terms]) -> Vec<Terms> {
        let solution: Vec<Terms> = (0..*size).map(|_| self.unknown()).collect();
        let minus_one = self.field.neg(self.field.one());
        for (row, right) in matrix.chunks(*size).zip(rhs) {
            let mut sum = Vec::new();
            for (entry, x) in row.iter().zip(&solution) {
                self.add_scaled(&mut sum, &self.mul(entry, x), self.field.one());
            }
            self.add_scaled(&mut sum, right, minus_one);
            self.vanishes(sum);
        }
        solution
    }
}
