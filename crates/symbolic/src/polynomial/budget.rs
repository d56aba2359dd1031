//! How large an exact computation may become before it is given up.

use crate::meter;
use std::cell::{Cell, RefCell};

use thiserror::Error;

use crate::number::prime::is_prime;
use crate::number::prime_field::PrimeField;

/// Limits of an exact computation. All limits are inclusive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Budget {
    /// Terms of any single polynomial.
    pub terms: usize,
    /// Total degree of any single polynomial; never effective above 65535, the largest exponent a monomial stores.
    pub degree: u32,
    /// Bits of any coefficient.
    pub bits: usize,
    /// Elementary steps in all: products of two terms, comparisons in divisions, modular evaluations of a term.
    pub work: u64,
}

impl Budget {
    /// Room for what a person would still call a formula: decided in well under a second.
    pub const DISPLAY: Budget = Budget {
        terms: 1_000,
        degree: 200,
        bits: 4_000,
        work: 1_000_000,
    };
    /// Room for proofs of moderately large identities: a few seconds at most.
    pub const PROOF: Budget = Budget {
        terms: 100_000,
        degree: 2_000,
        bits: 40_000,
        work: 200_000_000,
    };
}

/// An exact computation exceeded its [`Budget`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum TooLarge {
    /// A polynomial with more terms than allowed.
    #[error("more than {limit} terms")]
    Terms {
        /// The limit that was exceeded.
        limit: usize,
    },
    /// A polynomial of higher degree than allowed.
    #[error("degree above {limit}")]
    Degree {
        /// The limit that was exceeded.
        limit: u32,
    },
    /// A coefficient longer than allowed.
    #[error("a coefficient of more than {limit} bits")]
    Bits {
        /// The limit that was exceeded.
        limit: usize,
    },
    /// More elementary steps than allowed.
    #[error("more than {limit} elementary steps")]
    Work {
        /// The limit that was exceeded.
        limit: u64,
    },
}

/// A [`Budget`] together with the work already done on it.
#[derive(Clone, Debug)]
pub struct Meter {
    budget: Budget,
    spent: Cell<u64>,
    /// The prime fields of the modular algorithms, found once.
    fields: RefCell<Vec<PrimeField>>,
}

impl Meter {
    /// A meter with nothing spent.
    pub fn new(budget: Budget) -> Meter {
        Meter {
            budget,
            spent: Cell::new(0),
            fields: RefCell::default(),
        }
    }

    /// The limits.
    pub fn budget(&self) -> &Budget {
        &self.budget
    }

    /// Elementary steps counted so far.
    pub fn spent(&self) -> u64 {
        self.spent.get()
    }

    /// Counts `steps` elementary steps.
    ///
    /// # Errors
    /// [`TooLarge::Work`] when the total exceeds the budget.
    pub fn spend(&self, steps: u64) -> Result<(), TooLarge> {
        meter::spend(steps);
        let total = self.spent.get().saturating_add(steps);
        self.spent.set(total);
        if total > self.budget.work {
            return Err(TooLarge::Work {
                limit: self.budget.work,
            });
        }
        Ok(())
    }

    /// The field of the k-th largest prime below 2^62, counted from 0.
    pub(super) fn field(&self, k: usize) -> Option<PrimeField> {
        let mut fields = self.fields.borrow_mut();
        while fields.len() <= k {
            let start = fields.last().map_or(1 << 62, PrimeField::modulus);
            let prime = (3..start).rev().find(|&n| is_prime(n))?;
            fields.push(PrimeField::new(prime)?);
        }
        fields.get(k).copied()
    }

    /// The largest total degree allowed; fits an exponent of a monomial.
    pub(super) fn degree_limit(&self) -> u32 {
        self.budget.degree.min(u32::from(u16::MAX))
    }

    pub(super) fn check_degree(&self, degree: u32) -> Result<(), TooLarge> {
        let limit = self.degree_limit();
        if degree > limit {
            return Err(TooLarge::Degree { limit });
        }
        Ok(())
    }

    pub(super) fn check_terms(&self, terms: usize) -> Result<(), TooLarge> {
        if terms > self.budget.terms {
            return Err(TooLarge::Terms {
                limit: self.budget.terms,
            });
        }
        Ok(())
    }

    pub(super) fn check_bits(&self, bits: usize) -> Result<(), TooLarge> {
        if bits > self.budget.bits {
            return Err(TooLarge::Bits {
                limit: self.budget.bits,
            });
        }
        Ok(())
    }
}
