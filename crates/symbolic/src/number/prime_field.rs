//! Arithmetic modulo a prime of at most 62 bits, in Montgomery form.
//!
//! P. L. Montgomery, "Modular multiplication without trial division", Math. Comp. 44 (1985).

use dashu_base::Sign;
use dashu_int::IBig;
use dashu_ratio::RBig;

use super::prime::is_prime;
use super::random::Random;

/// The field of integers modulo an odd prime below 2^62. Its elements are [`Residue`]s and mean nothing without it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PrimeField {
    modulus: u64,
    /// −p^{−1} modulo 2^64.
    negated_inverse: u64,
    /// 2^64 modulo p: the element 1.
    one: u64,
    /// 2^128 modulo p.
    radix_squared: u64,
}

/// An element of a [`PrimeField`], in Montgomery form; equality is equality in the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub struct Residue(u64);

impl Residue {
    /// The element 0 of every field.
    pub const ZERO: Self = Self(0);

    /// Is this 0?
    pub fn is_zero(self) -> bool {
        self.0 == 0
    }
}

impl PrimeField {
    /// The field of `modulus` elements; `None` unless `modulus` is an odd prime below 2^62.
    pub fn new(modulus: u64) -> Option<Self> {
        if modulus < 3 || modulus >> 62 != 0 || !is_prime(modulus) {
            return None;
        }
        // Newton's iteration doubles the correct bits of p^{-1} modulo 2^64, starting from 3 of them.
        let mut inverse = modulus;
        for _ in 0..5 {
            inverse = inverse.wrapping_mul(2_u64.wrapping_sub(modulus.wrapping_mul(inverse)));
        }
        let one = ((1_u128 << 64) % u128::from(modulus)) as u64;
        let radix_squared = (u128::from(one) * u128::from(one) % u128::from(modulus)) as u64;
        Some(Self {
            modulus,
            negated_inverse: inverse.wrapping_neg(),
            one,
            radix_squared,
        })
    }

    /// The prime p.
    pub fn modulus(&self) -> u64 {
        self.modulus
    }

    /// The element 1.
    pub fn one(&self) -> Residue {
        Residue(self.one)
    }

    /// The class of `n`.
    pub fn from_u64(&self, n: u64) -> Residue {
        Residue(self.reduce(u128::from(n % self.modulus) * u128::from(self.radix_squared)))
    }

    /// The class of `n`.
    pub fn from_i64(&self, n: i64) -> Residue {
        let magnitude = self.from_u64(n.unsigned_abs());
        if n < 0 {
            self.neg(magnitude)
        } else {
            magnitude
        }
    }

    /// The class of a big integer.
    pub fn from_integer(&self, n: &IBig) -> Residue {
        if let Ok(small) = i64::try_from(n) {
            return self.from_i64(small);
        }
        // Chunks of 32 bits, the same on machines of any word size.
        let radix = self.from_u64(1 << 32);
        let (sign, magnitude) = n.clone().into_parts();
        let chunks = magnitude.to_chunks(32);
        let residue = chunks.iter().rev().fold(Residue::ZERO, |sum, chunk| {
            let digit = u64::try_from(chunk).unwrap_or_default();
            self.add(self.mul(sum, radix), self.from_u64(digit))
        });
        match sign {
            Sign::Positive => residue,
            Sign::Negative => self.neg(residue),
        }
    }

    /// The class of a rational number; `None` if p divides its denominator.
    pub fn from_rational(&self, number: &RBig) -> Option<Residue> {
        let numerator = self.from_integer(number.numerator());
        if number.is_int() {
            return Some(numerator);
        }
        let denominator = self.from_integer(number.denominator().as_ibig());
        Some(self.mul(numerator, self.inv(denominator)?))
    }

    /// The representative in `0..p`.
    pub fn to_u64(&self, a: Residue) -> u64 {
        self.reduce(u128::from(a.0))
    }

    /// A uniformly random element.
    pub fn random(&self, random: &mut Random) -> Residue {
        Residue(random.below(self.modulus))
    }

    /// a + b.
    pub fn add(&self, a: Residue, b: Residue) -> Residue {
        Residue(self.subtract_once(a.0 + b.0))
    }

    /// a − b.
    pub fn sub(&self, a: Residue, b: Residue) -> Residue {
        Residue(self.subtract_once(a.0 + self.modulus - b.0))
    }

    /// −a.
    pub fn neg(&self, a: Residue) -> Residue {
        self.sub(Residue::ZERO, a)
    }

    /// a·b.
    pub fn mul(&self, a: Residue, b: Residue) -> Residue {
        Residue(self.reduce(u128::from(a.0) * u128::from(b.0)))
    }

    /// Σ aᵢ bᵢ with one reduction: four products are below 4 p² < 2^64 p.
    pub fn sum_of_products(&self, a: [Residue; 4], b: [Residue; 4]) -> Residue {
        let product = |i: usize| u128::from(a[i].0) * u128::from(b[i].0);
        Residue(self.reduce(product(0) + product(1) + product(2) + product(3)))
    }

    /// a^exponent; 0^0 = 1.
    pub fn pow(&self, a: Residue, exponent: u64) -> Residue {
        let mut result = self.one();
        let mut square = a;
        let mut rest = exponent;
        while rest > 0 {
            if rest & 1 == 1 {
                result = self.mul(result, square);
            }
            square = self.mul(square, square);
            rest >>= 1;
        }
        result
    }

    /// a^exponent for a big exponent of either sign; `None` for a negative power of 0.
    pub fn pow_integer(&self, a: Residue, exponent: &IBig) -> Option<Residue> {
        if a.is_zero() {
            return match (exponent.is_zero(), exponent.sign()) {
                (true, _) => Some(self.one()),
                (false, Sign::Positive) => Some(Residue::ZERO),
                (false, Sign::Negative) => None,
            };
        }
        // a ≠ 0, so exponents count modulo p − 1 (Fermat).
        let order = IBig::from(self.modulus - 1);
        let mut reduced = exponent % &order;
        if reduced.sign() == Sign::Negative {
            reduced += &order;
        }
        u64::try_from(&reduced).ok().map(|small| self.pow(a, small))
    }

    /// 1/a; `None` for 0.
    pub fn inv(&self, a: Residue) -> Option<Residue> {
        if a.is_zero() {
            return None;
        }
        // Extended Euclid on signed 128-bit-free 64-bit numbers: |t| stays at most p < 2^62.
        let (mut r, mut next_r) = (self.modulus as i64, self.to_u64(a) as i64);
        let (mut t, mut next_t) = (0_i64, 1_i64);
        while next_r != 0 {
            let quotient = r / next_r;
            (r, next_r) = (next_r, r - quotient * next_r);
            (t, next_t) = (next_t, t - quotient * next_t);
        }
        Some(self.from_i64(t))
    }

    /// The Legendre symbol: 1 for a non-zero square, −1 for a non-square, 0 for 0.
    pub fn legendre(&self, a: Residue) -> i8 {
        if a.is_zero() {
            0
        } else if self.pow(a, (self.modulus - 1) / 2) == self.one() {
            1
        } else {
            -1
        }
    }

    /// A square root, if there is one; which of the two is unspecified (but always the same).
    ///
    /// Tonelli–Shanks; for p ≡ 3 (mod 4) a single power.
    pub fn sqrt(&self, a: Residue) -> Option<Residue> {
        match self.legendre(a) {
            0 => return Some(Residue::ZERO),
            1 => {}
            _ => return None,
        }
        let twos = (self.modulus - 1).trailing_zeros();
        let odd = (self.modulus - 1) >> twos;
        let mut root = self.pow(a, odd.div_ceil(2));
        let mut rest = self.pow(a, odd);
        let mut generator = self.pow(self.non_square(), odd);
        let mut level = twos;
        // Invariant: root² = a·rest, and the order of rest divides 2^(level − 1).
        while rest != self.one() {
            let mut order = 0;
            let mut square = rest;
            while square != self.one() {
                square = self.mul(square, square);
                order += 1;
            }
            let mut factor = generator;
            for _ in 0..level - order - 1 {
                factor = self.mul(factor, factor);
            }
            generator = self.mul(factor, factor);
            rest = self.mul(rest, generator);
            root = self.mul(root, factor);
            level = order;
        }
        Some(root)
    }

    /// The smallest positive non-square.
    fn non_square(&self) -> Residue {
        (2..self.modulus)
            .map(|n| self.from_u64(n))
            .find(|&a| self.legendre(a) == -1)
            .unwrap_or(Residue::ZERO)
    }

    /// The q-th root for q prime to p − 1, where it exists and is unique; `None` if q is not prime to p − 1.
    pub fn unique_root(&self, a: Residue, q: u64) -> Option<Residue> {
        let exponent = inverse_modulo(q, self.modulus - 1)?;
        Some(self.pow(a, exponent))
    }

    /// A root of unity of exact order `order`, random among them; `None` unless `order` divides p − 1.
    pub fn root_of_unity(&self, order: u64, random: &mut Random) -> Option<Residue> {
        if order == 0 || !(self.modulus - 1).is_multiple_of(order) {
            return None;
        }
        let factors = prime_factors(order);
        loop {
            let candidate = self.random(random);
            if candidate.is_zero() {
                continue;
            }
            let root = self.pow(candidate, (self.modulus - 1) / order);
            if factors
                .iter()
                .all(|q| self.pow(root, order / q) != self.one())
            {
                return Some(root);
            }
        }
    }

    /// t·2^{−64} modulo p for t < p·2^64 (Montgomery reduction).
    fn reduce(&self, t: u128) -> u64 {
        let m = (t as u64).wrapping_mul(self.negated_inverse);
        // t + m·p < p·2^64 + 2^64·p < 2^127 for p < 2^62.
        self.subtract_once(((t + u128::from(m) * u128::from(self.modulus)) >> 64) as u64)
    }

    fn subtract_once(&self, a: u64) -> u64 {
        if a >= self.modulus {
            a - self.modulus
        } else {
            a
        }
    }
}

/// a^{−1} modulo n, if gcd(a, n) = 1.
fn inverse_modulo(a: u64, n: u64) -> Option<u64> {
    let (mut r, mut next_r) = (i128::from(n), i128::from(a % n));
    let (mut t, mut next_t) = (0_i128, 1_i128);
    while next_r != 0 {
        let quotient = r / next_r;
        (r, next_r) = (next_r, r - quotient * next_r);
        (t, next_t) = (next_t, t - quotient * next_t);
    }
    (r == 1).then(|| t.rem_euclid(i128::from(n)) as u64)
}

/// The distinct primes dividing a small number, by trial division.
fn prime_factors(mut n: u64) -> Vec<u64> {
    let mut factors = Vec::new();
    let mut divisor = 2;
    while divisor * divisor <= n {
        if n.is_multiple_of(divisor) {
            factors.push(divisor);
            while n.is_multiple_of(divisor) {
                n /= divisor;
            }
        }
        divisor += 1;
    }
    if n > 1 {
        factors.push(n);
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::prime::random_prime;

    const MERSENNE: u64 = (1 << 61) - 1;

    fn fields() -> Vec<PrimeField> {
        let mut random = Random::new(11);
        let mut primes = vec![3, 5, 7, 17, 97, 65537, MERSENNE];
        for order in [1, 4, 16, 24] {
            primes.push(random_prime(&mut random, order, 100_000, |_| true).unwrap());
        }
        primes
            .into_iter()
            .map(|p| PrimeField::new(p).unwrap())
            .collect()
    }

    #[test]
    fn refuses_what_is_not_a_prime_of_its_range() {
        for n in [0, 1, 2, 4, 561, u64::MAX, 18_446_744_073_709_551_557] {
            assert_eq!(PrimeField::new(n), None);
        }
    }

    #[test]
    fn arithmetic_agrees_with_128_bit_integers() {
        let mut random = Random::new(5);
        for field in fields() {
            let p = u128::from(field.modulus());
            for _ in 0..200 {
                let (x, y) = (random.below(field.modulus()), random.below(field.modulus()));
                let (a, b) = (field.from_u64(x), field.from_u64(y));
                let (x, y) = (u128::from(x), u128::from(y));
                assert_eq!(u128::from(field.to_u64(field.add(a, b))), (x + y) % p);
                assert_eq!(u128::from(field.to_u64(field.sub(a, b))), (x + p - y) % p);
                assert_eq!(u128::from(field.to_u64(field.mul(a, b))), x * y % p);
                if !a.is_zero() {
                    assert_eq!(field.mul(a, field.inv(a).unwrap()), field.one());
                }
            }
            assert_eq!(field.inv(Residue::ZERO), None);
        }
    }

    #[test]
    fn square_roots_exist_exactly_for_squares() {
        let mut random = Random::new(9);
        for field in fields() {
            for _ in 0..50 {
                let a = field.random(&mut random);
                match field.sqrt(a) {
                    Some(root) => assert_eq!(field.mul(root, root), a),
                    None => assert_eq!(field.legendre(a), -1),
                }
                let square = field.mul(a, a);
                assert!(field.sqrt(square).is_some());
            }
        }
    }

    #[test]
    fn big_rationals_reduce_and_poles_are_noticed() {
        let field = PrimeField::new(MERSENNE).unwrap();
        // 2^61 ≡ 1, so 2^200 ≡ 2^(200 − 183) = 2^17.
        let power = IBig::from(1) << 200_usize;
        assert_eq!(field.from_integer(&power), field.from_u64(1 << 17));
        assert_eq!(
            field.from_integer(&-&power),
            field.neg(field.from_u64(1 << 17))
        );
        let third = RBig::from_parts_signed(IBig::from(-1), IBig::from(3));
        let value = field.from_rational(&third).unwrap();
        assert_eq!(field.mul(value, field.from_u64(3)), field.from_i64(-1));
        let pole = RBig::from_parts_signed(IBig::from(1), IBig::from(MERSENNE));
        assert_eq!(field.from_rational(&pole), None);
    }

    #[test]
    fn powers_by_big_and_negative_exponents() {
        let field = PrimeField::new(97).unwrap();
        let five = field.from_u64(5);
        // 5^96 ≡ 1 (mod 97): the exponent 96·10^30 + 2 acts as 2.
        let huge = IBig::from(96) * IBig::from(10).pow(30) + IBig::from(2);
        assert_eq!(field.pow_integer(five, &huge), Some(field.from_u64(25)));
        assert_eq!(field.pow_integer(five, &IBig::from(-1)), field.inv(five));
        assert_eq!(field.pow_integer(Residue::ZERO, &IBig::from(-1)), None);
        assert_eq!(
            field.pow_integer(Residue::ZERO, &IBig::from(0)),
            Some(field.one())
        );
    }

    #[test]
    fn roots_of_unity_and_unique_roots() {
        let mut random = Random::new(2);
        let field = PrimeField::new(97).unwrap();
        let zeta = field.root_of_unity(12, &mut random).unwrap();
        assert_eq!(field.pow(zeta, 12), field.one());
        assert!([1, 2, 3, 4, 6]
            .iter()
            .all(|&k| field.pow(zeta, k) != field.one()));
        assert_eq!(field.root_of_unity(5, &mut random), None);
        let root = field.unique_root(field.from_u64(40), 5).unwrap();
        assert_eq!(field.pow(root, 5), field.from_u64(40));
        assert_eq!(field.unique_root(root, 3), None, "3 divides 96");
    }
}
