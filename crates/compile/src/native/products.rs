//! Sums of products of series, all of one order at once.
//!
//! ```text
//! Σ_{i=1..j−1} a_i b_{j−i}
//! ```
//!
//! These terms are known before any coefficient of order j is, so no sum waits for another; what else order j needs is
//! straight-line code. Four sums share the additions across a register at their ends.
#![allow(unsafe_code)] // Vectors are loaded through pointers, whose bounds are compared once for all sums.

use super::machine::Four;
use std::arch::x86_64::{
    __m256d, _mm256_add_pd, _mm256_blend_pd, _mm256_fmadd_pd, _mm256_hadd_pd, _mm256_loadu_pd,
    _mm256_permute2f128_pd, _mm256_permute4x64_pd, _mm256_setzero_pd, _mm256_storeu_pd,
};
use std::collections::BTreeMap;

/// Numbers from one series to the next.
pub(crate) const STRIDE: usize = 48;
/// The coefficient of order 0 would be here. It and those before it are zero, so that vectors may begin too early; those
/// beyond the order reached meet them, so that vectors may end too late.
pub(crate) const ZERO: usize = 3;
/// The highest order that has room: vectors reach three orders beyond.
pub(crate) const MOST: usize = STRIDE - ZERO - 4;

/// The series that are multiplied, as their numbers; four products at a time, those together that have a factor in common: it is
/// loaded and reversed once for all of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Products {
    /// Of the two series of a product the second is the one that is reversed.
    list: Vec<[[u32; 2]; 4]>,
    /// So many fours come first whose second series is one.
    fans: usize,
    /// So many come then whose first two have one second series, and whose last two.
    twins: usize,
    /// By product: the number of its sum.
    places: Vec<usize>,
    /// How many series there have to be.
    series: usize,
}

/// Fewer products stay in their order: there it takes as long to wait for the coefficients stored last as to load the others.
const FEW: usize = 64;

impl Products {
    /// Products of pairs of series, with products of series 0 where a four is not full.
    pub(crate) fn of(pairs: &[[u32; 2]]) -> Products {
        let mut groups = Groups::of(pairs);
        let (fans, twins) = match pairs.len() < FEW {
            true => Default::default(),
            false => (groups.take(4), groups.take(2)),
        };
        let singles: Vec<(usize, [u32; 2])> = (pairs.iter().copied().enumerate())
            .filter(|&(number, _)| !groups.is_taken[number])
            .collect();
        let mut products = Products {
            fans: fans.len(),
            twins: twins.len().div_ceil(2),
            places: vec![0; pairs.len()],
            ..Products::default()
        };
        fans.iter().for_each(|fan| products.push(fan));
        let twins = twins.chunks(2).map(<[_]>::concat);
        twins.for_each(|both| products.push(&both));
        singles.chunks(4).for_each(|four| products.push(four));
        let most = pairs.iter().flatten().max();
        products.series = most.map_or(0, |&series| series as usize + 1);
        products
    }

    /// Adds up to four products, with their numbers.
    fn push(&mut self, products: &[(usize, [u32; 2])]) {
        // What fills a four shares the series of the last.
        let last = products.last().map_or(0, |&(_, [_, second])| second);
        let mut four = [[0, last]; 4];
        for (i, &(number, pair)) in products.iter().enumerate() {
            self.places[number] = self.len() + i;
            four[i] = pair;
        }
        let first = four.map(|pair| pair.map(|series| series * STRIDE as u32));
        self.list.push(first);
    }

    /// By product: the number of its sum.
    pub(crate) fn places(&self) -> &[usize] {
        &self.places
    }

    /// How many sums there are.
    pub(crate) fn len(&self) -> usize {
        4 * self.list.len()
    }

    /// The sums of order j. Does nothing where a slice is too short or the order has no room, or where the processor
    /// lacks the instructions.
    pub(crate) fn sum(&self, j: usize, series: &[f64], sums: &mut [f64]) {
        let fits = series.len() >= self.series * STRIDE
            && series.len() >= STRIDE
            && sums.len() >= self.len()
            && (1..=MOST).contains(&j)
            && super::is_available();
        if !fits {
            return;
        }
        // SAFETY: the processor has the instructions; every series begins at a multiple of the stride below the length
        // of the slice, and of each the numbers from 1 + j − 4 C + ZERO − 1 ≥ 0 to ZERO + 4 C ≤ ZERO + j + 2 < STRIDE are
        // read, where C is the number of vectors; as many sums are written as there are.
        unsafe {
            match (j + 2) / 4 {
                0 => sums[..self.len()].fill(0.0),
                1 => self.run_all::<1>(j, series, sums),
                2 => self.run_all::<2>(j, series, sums),
                3 => self.run_all::<3>(j, series, sums),
                4 => self.run_all::<4>(j, series, sums),
                5 => self.run_all::<5>(j, series, sums),
                6 => self.run_all::<6>(j, series, sums),
                7 => self.run_all::<7>(j, series, sums),
                8 => self.run_all::<8>(j, series, sums),
                9 => self.run_all::<9>(j, series, sums),
                _ => self.run_all::<10>(j, series, sums),
            }
        }
    }

    /// The same for four states side by side; each has the bits that it has alone.
    pub(crate) fn sum_four(&self, j: usize, series: &[Four], sums: &mut [Four]) {
        let fits = series.len() >= self.series * STRIDE
            && series.len() >= STRIDE
            && sums.len() >= self.len()
            && (1..=MOST).contains(&j)
            && super::is_available();
        if fits {
            // SAFETY: the processor has the instructions; every series begins at a multiple of the stride below the length
            // of the slice, and of each the numbers from ZERO + 1 to ZERO + j − 1 < STRIDE are read; as many sums are written
            // as there are.
            unsafe {
                match j {
                    2 => self.run_four::<1>(series, sums),
                    3 => self.run_four::<2>(series, sums),
                    4 => self.run_four::<3>(series, sums),
                    5 => self.run_four::<4>(series, sums),
                    6 => self.run_four::<5>(series, sums),
                    7 => self.run_four::<6>(series, sums),
                    8 => self.run_four::<7>(series, sums),
                    9 => self.run_four::<8>(series, sums),
                    10 => self.run_four::<9>(series, sums),
                    11 => self.run_four::<10>(series, sums),
                    12 => self.run_four::<11>(series, sums),
                    13 => self.run_four::<12>(series, sums),
                    14 => self.run_four::<13>(series, sums),
                    15 => self.run_four::<14>(series, sums),
                    16 => self.run_four::<15>(series, sums),
                    17 => self.run_four::<16>(series, sums),
                    18 => self.run_four::<17>(series, sums),
                    19 => self.run_four::<18>(series, sums),
                    20 => self.run_four::<19>(series, sums),
                    21 => self.run_four::<20>(series, sums),
                    22 => self.run_four::<21>(series, sums),
                    23 => self.run_four::<22>(series, sums),
                    24 => self.run_four::<23>(series, sums),
                    _ => self.run_four_terms(j - 1, series, sums),
                }
            }
        }
    }

    /// Sums of T products.
    ///
    /// # Safety
    /// As in [`Products::sum_four`], for order T + 1.
    #[target_feature(enable = "avx2,fma")]
    unsafe fn run_four<const T: usize>(&self, series: &[Four], sums: &mut [Four]) {
        // SAFETY: as the caller says.
        unsafe { self.run_four_terms(T, series, sums) }
    }

    /// The sums in four parts as those of a single state: part k has the terms of orders 1 + k + 4 v. Where the number of terms is
    /// known when this is compiled, nothing is left of the loops over them.
    ///
    /// # Safety
    /// As in [`Products::sum_four`], for one order more than there are terms.
    #[target_feature(enable = "avx2,fma")]
    #[inline]
    #[allow(clippy::needless_range_loop)]
    unsafe fn run_four_terms(&self, terms: usize, series: &[Four], sums: &mut [Four]) {
        let (from, mut to) = (
            series.as_ptr().cast::<f64>(),
            sums.as_mut_ptr().cast::<f64>(),
        );
        let (shared, singles) = self.list.split_at(self.fans + self.twins);
        // Both products of a pair of them have the same second series.
        for [first, second] in shared.as_flattened().as_chunks::<2>().0 {
            let mut parts = [[_mm256_setzero_pd(); 4]; 2];
            // SAFETY: within the series and the sums, as `sum_four` says; four numbers each.
            unsafe {
                let a = from.add(4 * (first[0] as usize + ZERO + 1));
                let other = from.add(4 * (second[0] as usize + ZERO + 1));
                let b = from.add(4 * (first[1] as usize + ZERO + terms));
                for i in 0..terms {
                    let y = _mm256_loadu_pd(b.sub(4 * i));
                    let (x, z) = (
                        _mm256_loadu_pd(a.add(4 * i)),
                        _mm256_loadu_pd(other.add(4 * i)),
                    );
                    parts[0][i % 4] = _mm256_fmadd_pd(x, y, parts[0][i % 4]);
                    parts[1][i % 4] = _mm256_fmadd_pd(z, y, parts[1][i % 4]);
                }
                for k in 0..2 {
                    _mm256_storeu_pd(to, total(parts[k]));
                    to = to.add(4);
                }
            }
        }
        for pair in singles.as_flattened() {
            let [a, b] = *pair;
            let mut parts = [_mm256_setzero_pd(); 4];
            // SAFETY: as above.
            unsafe {
                let a = from.add(4 * (a as usize + ZERO + 1));
                let b = from.add(4 * (b as usize + ZERO + terms));
                for i in 0..terms {
                    let (x, y) = (_mm256_loadu_pd(a.add(4 * i)), _mm256_loadu_pd(b.sub(4 * i)));
                    parts[i % 4] = _mm256_fmadd_pd(x, y, parts[i % 4]);
                }
                _mm256_storeu_pd(to, total(parts));
                to = to.add(4);
            }
        }
    }

    /// The sums over C vectors.
    ///
    /// # Safety
    /// As in [`Products::sum`].
    #[target_feature(enable = "avx2,fma")]
    unsafe fn run_all<const C: usize>(&self, j: usize, series: &[f64], sums: &mut [f64]) {
        let (fans, rest) = self.list.split_at(self.fans);
        let (twins, singles) = rest.split_at(self.twins);
        let (of_fans, sums) = sums.split_at_mut(4 * fans.len());
        let (of_twins, of_singles) = sums.split_at_mut(4 * twins.len());
        // SAFETY: as the caller says; the slices have been cut to the numbers of sums.
        unsafe {
            run::<C, 1>(fans, j, series, of_fans);
            run::<C, 2>(twins, j, series, of_twins);
            run::<C, 4>(singles, j, series, of_singles);
        }
    }
}

/// Four parts of a sum of each of four states.
#[target_feature(enable = "avx2")]
#[inline]
fn total(parts: [__m256d; 4]) -> __m256d {
    let (low, high) = (
        _mm256_add_pd(parts[0], parts[1]),
        _mm256_add_pd(parts[2], parts[3]),
    );
    _mm256_add_pd(low, high)
}

/// The sums over C vectors of fours with B second series, each shared by 4/B neighbours.
///
/// # Safety
/// As in [`Products::sum`]; there are as many sums as products.
#[target_feature(enable = "avx2,fma")]
#[inline]
#[allow(clippy::needless_range_loop)]
unsafe fn run<const C: usize, const B: usize>(
    list: &[[[u32; 2]; 4]],
    j: usize,
    series: &[f64],
    sums: &mut [f64],
) {
    let (from, mut to) = (series.as_ptr(), sums.as_mut_ptr());
    for four in list {
        let mut totals = [_mm256_setzero_pd(); 4];
        // Over indices: iterators of the standard library are not always inlined here.
        for v in 0..C {
            let mut reversed = [_mm256_setzero_pd(); B];
            for g in 0..B {
                let second = four[g * 4 / B][1] as usize;
                // SAFETY: within the series, as `sum` says.
                let own = unsafe { _mm256_loadu_pd(from.add(second + ZERO + j).sub(4 * v + 4)) };
                reversed[g] = _mm256_permute4x64_pd::<0b00_01_10_11>(own);
            }
            for k in 0..4 {
                let first = four[k][0] as usize;
                // SAFETY: as above.
                let forward = unsafe { _mm256_loadu_pd(from.add(first + ZERO + 1).add(4 * v)) };
                totals[k] = _mm256_fmadd_pd(forward, reversed[k * B / 4], totals[k]);
            }
        }
        let [a, b, c, d] = totals;
        let (low, high) = (_mm256_hadd_pd(a, b), _mm256_hadd_pd(c, d));
        let crossed = _mm256_permute2f128_pd::<0x21>(low, high);
        let straight = _mm256_blend_pd::<0b1100>(low, high);
        // SAFETY: there are as many sums.
        unsafe {
            _mm256_storeu_pd(to, _mm256_add_pd(crossed, straight));
            to = to.add(4);
        }
    }
}

/// Pairs of series, to be taken in groups with a series in common.
struct Groups<'p> {
    pairs: &'p [[u32; 2]],
    is_taken: Vec<bool>,
    /// By series, those in the most pairs first: its number, and the pairs that it is in.
    members: Vec<(u32, Vec<usize>)>,
}

impl Groups<'_> {
    fn of(pairs: &[[u32; 2]]) -> Groups<'_> {
        let mut members: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (number, &[a, b]) in pairs.iter().enumerate() {
            members.entry(a).or_default().push(number);
            if a != b {
                members.entry(b).or_default().push(number);
            }
        }
        let mut members: Vec<(u32, Vec<usize>)> = members.into_iter().collect();
        members.sort_by_key(|(_, own)| std::cmp::Reverse(own.len()));
        Groups {
            is_taken: vec![false; pairs.len()],
            members,
            pairs,
        }
    }

    /// As many groups of `size` pairs as are found, with their numbers; the second series of the pairs is the common one.
    fn take(&mut self, size: usize) -> Vec<Vec<(usize, [u32; 2])>> {
        let mut groups = Vec::new();
        for (series, members) in &self.members {
            let left = members.iter().filter(|&&number| !self.is_taken[number]);
            let left: Vec<usize> = left.copied().collect();
            for own in left.chunks_exact(size) {
                own.iter().for_each(|&number| self.is_taken[number] = true);
                let turned = |&number: &usize| match self.pairs[number] {
                    [a, b] if a == *series => (number, [b, a]),
                    pair => (number, pair),
                };
                groups.push(own.iter().map(turned).collect());
            }
        }
        groups
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_every_order() {
        if !super::super::is_available() {
            return;
        }
        // Small integers: sums are exact in every order of addition.
        let count = 5;
        let coefficient = |s: usize, i: usize| ((7 * s + 3 * i + 5 * i * i) % 11) as f64 - 4.0;
        let mut series = vec![0.0; count * STRIDE];
        let pairs = [[0, 1], [2, 2], [3, 0], [1, 4], [4, 3]];
        let products = Products::of(&pairs);
        assert_eq!(products.len(), 8);
        for j in 1..=MOST {
            for s in 0..count {
                for i in 1..j {
                    series[s * STRIDE + ZERO + i] = coefficient(s, i);
                }
            }
            let mut sums = [f64::NAN; 8];
            products.sum(j, &series, &mut sums);
            for (&[a, b], &place) in pairs.iter().zip(products.places()) {
                let found = sums[place];
                let term = |i| coefficient(a as usize, i) * coefficient(b as usize, j - i);
                let expected: f64 = (1..j).map(term).sum();
                assert_eq!(found, expected, "order {j}, series {a} and {b}");
            }
        }
    }

    #[test]
    fn four_states_have_the_bits_of_each() {
        if !super::super::is_available() {
            return;
        }
        let count = 3;
        let products = Products::of(&[[0, 1], [1, 1], [2, 0]]);
        let value = |k: usize| (0.37 * k as f64).sin() * 10f64.powi((k % 7) as i32 - 3);
        for j in 1..=MOST {
            let mut side_by_side = vec![Four::default(); count * STRIDE];
            let mut sums = [Four([f64::NAN; 4]); 4];
            let mut alone = vec![vec![0.0; count * STRIDE]; 4];
            for (l, alone) in alone.iter_mut().enumerate() {
                for s in 0..count {
                    for i in 1..j {
                        let place = s * STRIDE + ZERO + i;
                        alone[place] = value(7 * l + 131 * s + 17 * i);
                        side_by_side[place].0[l] = alone[place];
                    }
                }
            }
            products.sum_four(j, &side_by_side, &mut sums);
            for (l, alone) in alone.iter().enumerate() {
                let mut expected = [f64::NAN; 4];
                products.sum(j, alone, &mut expected);
                let found = sums.map(|sum| sum.0[l].to_bits());
                assert_eq!(found, expected.map(f64::to_bits), "order {j}, state {l}");
            }
        }
    }

    /// Enough products for groups, with one series in many, others in two, and the rest in one.
    #[test]
    fn groups_have_the_sums_of_their_products() {
        if !super::super::is_available() {
            return;
        }
        let fan = (1..40).map(|s| [s, 50]);
        let twins = (60..80).step_by(2).flat_map(|s| [[s, s + 1], [s, s]]);
        let singles = (80..101).step_by(2).map(|s| [s, s + 1]);
        let pairs: Vec<[u32; 2]> = fan.chain(twins).chain(singles).collect();
        let products = Products::of(&pairs);
        assert_eq!((products.fans, products.twins), (9, 5 + 1));
        let mut places = products.places().to_vec();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), pairs.len());
        let value = |s: usize, i: usize| ((5 * s + 3 * i * i) % 13) as f64 - 6.0;
        for j in 1..=MOST {
            let mut series = vec![0.0; 102 * STRIDE];
            for (s, own) in series.chunks_exact_mut(STRIDE).enumerate() {
                for i in 1..j {
                    own[ZERO + i] = if s == 0 { 0.0 } else { value(s, i) };
                }
            }
            let fours: Vec<Four> = series
                .iter()
                .map(|&x| Four([x, -x, 2.0 * x, 0.0]))
                .collect();
            let mut sums = vec![f64::NAN; products.len()];
            let mut of_four = vec![Four([f64::NAN; 4]); products.len()];
            products.sum(j, &series, &mut sums);
            products.sum_four(j, &fours, &mut of_four);
            for (&[a, b], &place) in pairs.iter().zip(products.places()) {
                let term = |i| value(a as usize, i) * value(b as usize, j - i);
                let expected: f64 = (1..j).map(term).sum();
                assert_eq!(sums[place], expected, "order {j}, series {a} and {b}");
                let all = [expected, expected, 4.0 * expected, 0.0];
                assert_eq!(of_four[place].0, all, "order {j}, series {a} and {b}");
            }
        }
    }

    #[test]
    fn what_lies_beyond_the_order_does_not_count() {
        let mut series = vec![0.0; STRIDE];
        series[ZERO + 1..].fill(3.0);
        let products = Products::of(&[[0, 0]]);
        for j in 1..=MOST {
            let mut sums = [0.0; 4];
            products.sum(j, &series, &mut sums);
            if super::super::is_available() {
                assert_eq!(sums[0], 9.0 * (j as f64 - 1.0), "order {j}");
            }
        }
    }

    #[test]
    fn slices_that_are_too_short_are_left_alone() {
        let products = Products::of(&[[0, 1]]);
        let mut sums = [1.0; 4];
        products.sum(5, &[0.0; STRIDE], &mut sums);
        products.sum(MOST + 1, &[0.0; 2 * STRIDE], &mut sums);
        products.sum(5, &[0.0; 2 * STRIDE], &mut sums[..3]);
        assert_eq!(sums, [1.0; 4]);
    }
}
