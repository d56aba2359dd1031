//! Primes of one machine word: a deterministic test and random choice.

use super::random::Random;

/// Bits of the primes used by modular proofs: every such prime lies in `2^61 .. 2^62`.
pub const PRIME_BITS: u32 = 62;

/// A lower bound for log2 of the number of primes in `2^61 .. 2^62`.
///
/// π(2x) − π(x) > 3x / (5 ln x) for x ≥ 20.5 (Rosser and Schoenfeld, Illinois J. Math. 6, 1962, Corollary 3);
/// for x = 2^61 the right side exceeds 2^54.8.
pub const LOG2_PRIME_COUNT: f64 = 54.8;

/// Is `n` prime? Miller–Rabin with the first twelve primes as bases, which is exact below 3.18·10^23
/// (Sorenson and Webster, Math. Comp. 86, 2017), hence for every `u64`.
pub fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 {
        return false;
    }
    for base in BASES {
        if n.is_multiple_of(base) {
            return n == base;
        }
    }
    let twos = (n - 1).trailing_zeros();
    let odd = (n - 1) >> twos;
    BASES.iter().all(|&base| passes(n, base, odd, twos))
}

/// Does `n` pass the strong test to `base`, where n − 1 = odd·2^twos?
fn passes(n: u64, base: u64, odd: u64, twos: u32) -> bool {
    let mut power = pow_mod(base, odd, n);
    if power == 1 || power == n - 1 {
        return true;
    }
    for _ in 1..twos {
        power = mul_mod(power, power, n);
        if power == n - 1 {
            return true;
        }
    }
    false
}

fn mul_mod(a: u64, b: u64, n: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(n)) as u64
}

fn pow_mod(mut base: u64, mut exponent: u64, n: u64) -> u64 {
    let mut result = 1 % n;
    base %= n;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul_mod(result, base, n);
        }
        base = mul_mod(base, base, n);
        exponent >>= 1;
    }
    result
}

/// A prime uniform among the primes of 62 bits that are 1 modulo `order` and accepted by `wanted`.
///
/// `order` ≥ 1 asks for roots of unity of that order; `wanted` for further conditions (numbers that must be
/// squares, roots that must be unique). `None` if `attempts` candidates in the progression brought none.
pub fn random_prime(
    random: &mut Random,
    order: u64,
    attempts: u32,
    wanted: impl Fn(u64) -> bool,
) -> Option<u64> {
    let low = 1_u64 << (PRIME_BITS - 1);
    let order = order.max(1);
    // Candidates are odd: with an even order they are odd anyway.
    let step = if order.is_multiple_of(2) {
        order
    } else {
        order.checked_mul(2)?
    };
    let first = low / step * step + step + 1;
    let count = (low - step).checked_div(step)?.saturating_sub(1);
    for _ in 0..attempts {
        let candidate = first + random.below(count) * step;
        if is_prime(candidate) && wanted(candidate) {
            return Some(candidate);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_primes_by_trial_division() {
        let naive = |n: u64| {
            n >= 2
                && (2..n)
                    .take_while(|d| d * d <= n)
                    .all(|d| !n.is_multiple_of(d))
        };
        for n in 0..5000 {
            assert_eq!(is_prime(n), naive(n), "{n}");
        }
    }

    #[test]
    fn pseudoprimes_and_large_primes() {
        // Carmichael numbers, and strong pseudoprimes to several first bases (OEIS A014233).
        for n in [
            561,
            1729,
            2047,
            1_373_653,
            25_326_001,
            3_215_031_751,
            3_825_123_056_546_413_051,
        ] {
            assert!(!is_prime(n), "{n}");
        }
        // 2^61 − 1 (Mersenne) and the largest prime below 2^64.
        assert!(is_prime((1 << 61) - 1));
        assert!(is_prime(18_446_744_073_709_551_557));
        assert!(!is_prime(u64::MAX));
    }

    #[test]
    fn random_primes_have_the_stated_size_and_class() {
        let mut random = Random::new(3);
        for order in [1, 3, 4, 24, 60] {
            let p = random_prime(&mut random, order, 100_000, |_| true).unwrap();
            assert!(is_prime(p) && p >> 61 == 1 && p % order == 1 % order);
        }
    }
}
