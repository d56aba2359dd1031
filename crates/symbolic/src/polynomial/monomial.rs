//! Monomials as exponent vectors without trailing zeros.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

const INLINE: usize = 13;

/// A product of powers of generators, ordered by total degree and then lexicographically (generator 0 counts most).
///
/// The vector of exponents has no trailing zeros, so a monomial does not change when generators are added.
#[derive(Clone, PartialEq, Eq)]
pub struct Monomial {
    degree: u32,
    exponents: Exponents,
}

// Invariant: `Inline` exactly when the length is at most `INLINE`; unused places of `values` are zero.
#[derive(Clone, PartialEq, Eq)]
enum Exponents {
    Inline { len: u8, values: [u16; INLINE] },
    Heap(Box<[u16]>),
}

impl Monomial {
    /// The monomial 1.
    pub fn one() -> Monomial {
        Monomial {
            degree: 0,
            exponents: Exponents::Inline {
                len: 0,
                values: [0; INLINE],
            },
        }
    }

    /// `generator^exponent`.
    pub fn power(generator: usize, exponent: u16) -> Monomial {
        let mut exponents = vec![0; generator + 1];
        exponents[generator] = exponent;
        Monomial::from_exponents(&exponents)
    }

    /// The monomial with these exponents; trailing zeros are allowed.
    pub fn from_exponents(exponents: &[u16]) -> Monomial {
        let len = exponents
            .iter()
            .rposition(|&e| e != 0)
            .map_or(0, |last| last + 1);
        let exponents = &exponents[..len];
        let degree = exponents.iter().map(|&e| u32::from(e)).sum();
        let exponents = if len <= INLINE {
            let mut values = [0; INLINE];
            values[..len].copy_from_slice(exponents);
            Exponents::Inline {
                len: len as u8,
                values,
            }
        } else {
            Exponents::Heap(exponents.into())
        };
        Monomial { degree, exponents }
    }

    /// The exponents, without trailing zeros.
    pub fn exponents(&self) -> &[u16] {
        match &self.exponents {
            Exponents::Inline { len, values } => &values[..usize::from(*len)],
            Exponents::Heap(values) => values,
        }
    }

    /// The exponent of one generator.
    pub fn exponent(&self, generator: usize) -> u16 {
        self.exponents().get(generator).copied().unwrap_or(0)
    }

    /// The total degree.
    pub fn degree(&self) -> u32 {
        self.degree
    }

    /// Whether this is the monomial 1.
    pub fn is_one(&self) -> bool {
        self.degree == 0
    }

    /// The generators that occur, with their exponents.
    pub fn iter(&self) -> impl Iterator<Item = (usize, u16)> + '_ {
        self.exponents()
            .iter()
            .copied()
            .enumerate()
            .filter(|&(_, e)| e != 0)
    }

    /// The product. The caller has checked that no exponent exceeds 65535 (see [`Meter`](super::Meter)).
    pub(super) fn product(&self, other: &Monomial) -> Monomial {
        self.combine(other, |a, b| a + b)
    }

    /// The quotient, when `other` divides `self`.
    pub fn quotient(&self, other: &Monomial) -> Option<Monomial> {
        if other.degree > self.degree || other.exponents().len() > self.exponents().len() {
            return None;
        }
        let divides = other
            .exponents()
            .iter()
            .zip(self.exponents())
            .all(|(b, a)| b <= a);
        divides.then(|| self.combine(other, |a, b| a - b))
    }

    /// The greatest common divisor.
    pub fn gcd(&self, other: &Monomial) -> Monomial {
        self.combine(other, u16::min)
    }

    /// The same monomial with the exponent of one generator replaced.
    pub fn with_exponent(&self, generator: usize, exponent: u16) -> Monomial {
        let mut exponents = self.exponents().to_vec();
        if generator >= exponents.len() {
            exponents.resize(generator + 1, 0);
        }
        exponents[generator] = exponent;
        Monomial::from_exponents(&exponents)
    }

    fn combine(&self, other: &Monomial, op: impl Fn(u16, u16) -> u16) -> Monomial {
        let (a, b) = (self.exponents(), other.exponents());
        let len = a.len().max(b.len());
        let at = |values: &[u16], i: usize| values.get(i).copied().unwrap_or(0);
        if len <= INLINE {
            let mut values = [0; INLINE];
            for (i, value) in values[..len].iter_mut().enumerate() {
                *value = op(at(a, i), at(b, i));
            }
            Monomial::from_exponents(&values[..len])
        } else {
            let values: Vec<u16> = (0..len).map(|i| op(at(a, i), at(b, i))).collect();
            Monomial::from_exponents(&values)
        }
    }
}

impl Hash for Monomial {
    // Four exponents at a time: hashing dominates the multiplication of large polynomials.
    fn hash<H: Hasher>(&self, state: &mut H) {
        for chunk in self.exponents().chunks(4) {
            let word = chunk
                .iter()
                .fold(0u64, |word, &e| (word << 16) | u64::from(e));
            state.write_u64(word);
        }
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Monomial) -> Ordering {
        self.degree
            .cmp(&other.degree)
            .then_with(|| self.exponents().cmp(other.exponents()))
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Monomial) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Debug for Monomial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_one() {
            return f.write_str("1");
        }
        let mut first = true;
        for (generator, exponent) in self.iter() {
            f.write_str(if first { "" } else { "*" })?;
            first = false;
            write!(f, "x{generator}")?;
            if exponent != 1 {
                write!(f, "^{exponent}")?;
            }
        }
        Ok(())
    }
}
