//! Monomials as exponent vectors without trailing zeros.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

/// Words of the exponents that are stored in place.
const INLINE: usize = 4;
/// Exponents in one word.
const LANES: usize = 4;
const LANE_BITS: usize = 16;
/// Every other exponent of a word.
const ALTERNATE: u64 = 0x0000_FFFF_0000_FFFF;
/// The bit above each of these.
const GUARD: u64 = 0x0001_0000_0001_0000;

/// A product of powers of generators, ordered by total degree and then lexicographically (generator 0 counts most).
///
/// The vector of exponents has no trailing zeros, so a monomial does not change when generators are added. Four exponents
/// stand in one word, the first in the highest bits, so that words are compared, added and subtracted at once: comparison
/// and multiplication of monomials are most of the work of large polynomials.
#[derive(Clone, PartialEq, Eq)]
pub struct Monomial {
    degree: u32,
    exponents: Words,
}

// Invariants: the last word is not zero; `Inline` exactly when there are at most `INLINE`, the unused ones are zero.
#[derive(Clone, PartialEq, Eq)]
enum Words {
    Inline { len: u8, values: [u64; INLINE] },
    Heap(Box<[u64]>),
}

impl Words {
    fn new(words: &[u64]) -> Words {
        let len = words.iter().rposition(|&w| w != 0).map_or(0, |k| k + 1);
        if len > INLINE {
            return Words::Heap(words[..len].into());
        }
        let mut values = [0; INLINE];
        values[..len].copy_from_slice(&words[..len]);
        Words::Inline {
            len: len as u8,
            values,
        }
    }

    fn as_slice(&self) -> &[u64] {
        match self {
            Words::Inline { len, values } => &values[..usize::from(*len)],
            Words::Heap(values) => values,
        }
    }

    /// Word by word; a missing one is zero.
    fn combine(&self, other: &Words, op: impl Fn(u64, u64) -> u64) -> Words {
        if let (Words::Inline { len: m, values: a }, Words::Inline { len: n, values: b }) =
            (self, other)
        {
            let mut values = [0; INLINE];
            for (value, (a, b)) in values.iter_mut().zip(a.iter().zip(b)) {
                *value = op(*a, *b);
            }
            let mut len = *m.max(n);
            while len > 0 && values[usize::from(len) - 1] == 0 {
                len -= 1;
            }
            return Words::Inline { len, values };
        }
        let (a, b) = (self.as_slice(), other.as_slice());
        let at = |values: &[u64], k: usize| values.get(k).copied().unwrap_or(0);
        let words: Vec<u64> = (0..a.len().max(b.len()))
            .map(|k| op(at(a, k), at(b, k)))
            .collect();
        Words::new(&words)
    }
}

/// The word and the shift of a generator.
fn place(generator: usize) -> (usize, usize) {
    let lane = generator % LANES;
    (generator / LANES, (LANES - 1 - lane) * LANE_BITS)
}

/// Whether each exponent of `a` is at least that of `b`.
fn covers(a: u64, b: u64) -> bool {
    // A borrow takes the guard bit away.
    let half = |a: u64, b: u64| ((a & ALTERNATE) | GUARD) - (b & ALTERNATE);
    half(a, b) & half(a >> LANE_BITS, b >> LANE_BITS) & GUARD == GUARD
}

/// The smaller of each two exponents.
fn least(a: u64, b: u64) -> u64 {
    (0..LANES).fold(0, |word, lane| {
        let mask = u64::from(u16::MAX) << (lane * LANE_BITS);
        word | (a & mask).min(b & mask)
    })
}

impl Monomial {
    /// The monomial 1.
    pub fn one() -> Monomial {
        Monomial {
            degree: 0,
            exponents: Words::new(&[]),
        }
    }

    /// `generator^exponent`.
    pub fn power(generator: usize, exponent: u16) -> Monomial {
        Monomial::one().with_exponent(generator, exponent)
    }

    /// The monomial with these exponents; trailing zeros are allowed.
    pub fn from_exponents(exponents: &[u16]) -> Monomial {
        let mut words = vec![0; exponents.len().div_ceil(LANES)];
        for (generator, &exponent) in exponents.iter().enumerate() {
            let (word, shift) = place(generator);
            words[word] |= u64::from(exponent) << shift;
        }
        Monomial {
            degree: exponents.iter().map(|&e| u32::from(e)).sum(),
            exponents: Words::new(&words),
        }
    }

    /// The exponents, without trailing zeros.
    pub fn exponents(&self) -> Vec<u16> {
        (0..self.extent()).map(|k| self.exponent(k)).collect()
    }

    /// One more than the last generator that occurs; 0 for the monomial 1.
    pub fn extent(&self) -> usize {
        let words = self.exponents.as_slice();
        let empty = |last: &u64| last.trailing_zeros() as usize / LANE_BITS;
        words
            .last()
            .map_or(0, |last| words.len() * LANES - empty(last))
    }

    /// The exponent of one generator.
    pub fn exponent(&self, generator: usize) -> u16 {
        let (word, shift) = place(generator);
        let word = self.exponents.as_slice().get(word).copied();
        (word.unwrap_or(0) >> shift) as u16
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
        let words = self.exponents.as_slice().iter().enumerate();
        words.filter(|(_, &word)| word != 0).flat_map(|(k, &word)| {
            (0..LANES)
                .map(move |lane| (k * LANES + lane, (word >> place(lane).1) as u16))
                .filter(|&(_, e)| e != 0)
        })
    }

    /// The product. The caller has checked that no exponent exceeds 65535 (see [`Meter`](super::Meter)).
    pub(super) fn product(&self, other: &Monomial) -> Monomial {
        Monomial {
            degree: self.degree + other.degree,
            exponents: self.exponents.combine(&other.exponents, |a, b| a + b),
        }
    }

    /// The quotient, when `other` divides `self`.
    pub fn quotient(&self, other: &Monomial) -> Option<Monomial> {
        let (a, b) = (self.exponents.as_slice(), other.exponents.as_slice());
        if other.degree > self.degree || b.len() > a.len() {
            return None;
        }
        let divides = a.iter().zip(b).all(|(&a, &b)| covers(a, b));
        divides.then(|| Monomial {
            degree: self.degree - other.degree,
            exponents: self.exponents.combine(&other.exponents, |a, b| a - b),
        })
    }

    /// The greatest common divisor.
    pub fn gcd(&self, other: &Monomial) -> Monomial {
        let exponents = self.exponents.combine(&other.exponents, least);
        let mut common = Monomial {
            degree: 0,
            exponents,
        };
        common.degree = common.iter().map(|(_, e)| u32::from(e)).sum();
        common
    }

    /// The same monomial with the exponent of one generator replaced.
    pub fn with_exponent(&self, generator: usize, exponent: u16) -> Monomial {
        let (word, shift) = place(generator);
        let present = self.exponents.as_slice();
        let mut words = [0; INLINE];
        let mut more = Vec::new();
        let size = present.len().max(word + 1);
        let words = match size <= INLINE {
            true => &mut words[..size],
            false => {
                more.resize(size, 0);
                &mut more[..]
            }
        };
        words[..present.len()].copy_from_slice(present);
        words[word] &= !(u64::from(u16::MAX) << shift);
        words[word] |= u64::from(exponent) << shift;
        Monomial {
            degree: self.degree - u32::from(self.exponent(generator)) + u32::from(exponent),
            exponents: Words::new(words),
        }
    }
}

impl Hash for Monomial {
    fn hash<H: Hasher>(&self, state: &mut H) {
        for &word in self.exponents.as_slice() {
            state.write_u64(word);
        }
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Monomial) -> Ordering {
        self.degree.cmp(&other.degree).then_with(|| {
            match (&self.exponents, &other.exponents) {
                // Unused words are zero.
                (Words::Inline { values: a, .. }, Words::Inline { values: b, .. }) => a.cmp(b),
                (a, b) => a.as_slice().cmp(b.as_slice()),
            }
        })
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
