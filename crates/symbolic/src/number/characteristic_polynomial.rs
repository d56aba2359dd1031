//! The characteristic polynomial det(λE − F) of two matrices of rational numbers.
//!
//! Modulo a prime `E⁻¹F` is brought to Hessenberg form, whose polynomial follows by a recursion (H. Cohen, *A Course in Computational Algebraic
//! Number Theory*, 1993, algorithm 2.2.9). The numbers follow from their classes by the Chinese remainder theorem: they are integers once each
//! row is multiplied by its denominators, and no larger than the product over the rows of the sums of absolute values. So n³ operations for
//! each of so many primes as the bound has words take the place of the 2ⁿ minors of a determinant of expressions.

use super::modular_matrix::{determinant, factorize};
use super::prime::PRIME_BITS;
use super::prime_field::{PrimeField, Residue};
use crate::meter;
use dashu_base::UnsignedAbs;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// The coefficients of det(λE − F), the constant first; `None` where E is singular, or the rows do not form two square matrices of one size.
pub fn characteristic_polynomial(left: &[Vec<RBig>], right: &[Vec<RBig>]) -> Option<Vec<RBig>> {
    let n = left.len();
    if right.len() != n || left.iter().chain(right).any(|row| row.len() != n) {
        return None;
    }
    let pencil = Pencil::new(left, right);
    let (mut known, mut singular) = (Lifted::new(n + 1), UBig::ONE);
    let mut candidate = 1_u64 << PRIME_BITS;
    while known.modulus <= pencil.bound {
        let field = next_field(&mut candidate);
        match pencil.modulo(&field) {
            Some(classes) => known.add(&field, &classes)?,
            None => singular *= UBig::from(candidate),
        }
        // The determinant of E is divided by more than it has room for: it is zero.
        if singular > pencil.bound {
            return None;
        }
    }
    let whole = known.centred();
    let field = next_field(&mut candidate);
    if !pencil.has_value(&whole, &field) {
        return None;
    }
    let whole = whole.into_iter();
    let scale = RBig::from(pencil.scale);
    Some(whole.map(|own| RBig::from(own) / &scale).collect())
}

/// The field of the next smaller prime.
fn next_field(candidate: &mut u64) -> PrimeField {
    loop {
        *candidate -= 1;
        if let Some(field) = PrimeField::new(*candidate) {
            return field;
        }
    }
}

/// λE − F with integers as entries.
struct Pencil {
    size: usize,
    /// E, row by row.
    left: Vec<IBig>,
    /// F, row by row.
    right: Vec<IBig>,
    /// What the determinant was multiplied by.
    scale: UBig,
    /// Twice a bound of the absolute values of the coefficients, and of the determinant of E.
    bound: UBig,
}

impl Pencil {
    fn new(left: &[Vec<RBig>], right: &[Vec<RBig>]) -> Pencil {
        let mut own = Pencil {
            size: left.len(),
            left: Vec::new(),
            right: Vec::new(),
            scale: UBig::ONE,
            bound: UBig::from(2_u8),
        };
        for (e, f) in left.iter().zip(right) {
            let both = || e.iter().chain(f);
            let common = both().fold(UBig::ONE, |all, x| lcm(&all, x.denominator()));
            let whole = |x: &RBig| x.numerator() * IBig::from(&common / x.denominator());
            let sum = both().fold(UBig::ZERO, |sum, x| sum + whole(x).unsigned_abs());
            own.left.extend(e.iter().map(whole));
            own.right.extend(f.iter().map(whole));
            own.bound *= sum;
            own.scale *= common;
        }
        own
    }

    /// The coefficients in a prime field; `None` where E is singular there.
    fn modulo(&self, field: &PrimeField) -> Option<Vec<Residue>> {
        let n = self.size;
        let classes =
            |own: &[IBig]| -> Vec<Residue> { own.iter().map(|x| field.from_integer(x)).collect() };
        let (left, right) = (classes(&self.left), classes(&self.right));
        meter::spend(4 * (n * n * n) as u64);
        let factors = factorize(field, n, left.clone())?;
        let mut rows = vec![vec![Residue::ZERO; n]; n];
        for column in 0..n {
            let own: Vec<Residue> = (0..n).map(|row| right[row * n + column]).collect();
            for (row, x) in factors.solve(field, &own).into_iter().enumerate() {
                rows[row][column] = x;
            }
        }
        hessenberg(field, &mut rows);
        let scale = determinant(field, n, left);
        let monic = of_hessenberg(field, &rows);
        Some(monic.into_iter().map(|c| field.mul(c, scale)).collect())
    }
}

impl Pencil {
    /// Whether a polynomial has the value of the determinant at one place of a field, by elimination: a second way to what the Hessenberg
    /// form says. Two polynomials of degree n agree at no more than n places of it.
    fn has_value(&self, polynomial: &[IBig], field: &PrimeField) -> bool {
        let place = field.from_integer(&IBig::from(0x9e37_79b9_7f4a_u64));
        let entry = |(e, f): (&IBig, &IBig)| {
            let (e, f) = (field.from_integer(e), field.from_integer(f));
            field.sub(field.mul(place, e), f)
        };
        let matrix: Vec<Residue> = self.left.iter().zip(&self.right).map(entry).collect();
        let value = polynomial.iter().rev().fold(Residue::ZERO, |sum, c| {
            field.add(field.mul(sum, place), field.from_integer(c))
        });
        field
            .sub(determinant(field, self.size, matrix), value)
            .is_zero()
    }
}

/// Brings a matrix to Hessenberg form by similarities.
fn hessenberg(field: &PrimeField, a: &mut [Vec<Residue>]) {
    let n = a.len();
    for m in 1..n.saturating_sub(1) {
        let found = (m..n).find(|&i| !a[i][m - 1].is_zero());
        let Some((pivot, reciprocal)) = found.and_then(|i| Some((i, field.inv(a[i][m - 1])?)))
        else {
            continue;
        };
        a.swap(pivot, m);
        a.iter_mut().for_each(|row| row.swap(pivot, m));
        // All rows are changed by the row m as it is now; the inverse of that changes the column m, and with it the row m, afterwards.
        let own = a[m].clone();
        let mut factors = vec![Residue::ZERO; n];
        for i in m + 1..n {
            factors[i] = field.mul(a[i][m - 1], reciprocal);
            for (entry, &by) in a[i].iter_mut().zip(&own) {
                *entry = field.sub(*entry, field.mul(factors[i], by));
            }
        }
        for row in a.iter_mut() {
            let terms = factors.iter().zip(row.iter());
            let sum = terms.fold(row[m], |sum, (&f, &x)| field.add(sum, field.mul(f, x)));
            row[m] = sum;
        }
    }
}

/// The monic characteristic polynomial of a matrix in Hessenberg form.
fn of_hessenberg(field: &PrimeField, h: &[Vec<Residue>]) -> Vec<Residue> {
    let mut all: Vec<Vec<Residue>> = vec![vec![field.one()]];
    for m in 0..h.len() {
        // (λ − h_mm) p_m, then what the entries above the diagonal take from it.
        let last = &all[m];
        let mut next = vec![Residue::ZERO; m + 2];
        for (power, &c) in last.iter().enumerate() {
            next[power + 1] = field.add(next[power + 1], c);
            next[power] = field.sub(next[power], field.mul(h[m][m], c));
        }
        let mut below = field.one();
        for i in (0..m).rev() {
            below = field.mul(below, h[i + 1][i]);
            let factor = field.mul(below, h[i][m]);
            for (entry, &c) in next.iter_mut().zip(&all[i]) {
                *entry = field.sub(*entry, field.mul(factor, c));
            }
        }
        all.push(next);
    }
    all.pop().unwrap_or_default()
}

/// Integers modulo a product of primes.
struct Lifted {
    modulus: UBig,
    values: Vec<IBig>,
}

impl Lifted {
    fn new(count: usize) -> Lifted {
        Lifted {
            modulus: UBig::ONE,
            values: vec![IBig::ZERO; count],
        }
    }

    /// What the classes modulo a further prime say.
    fn add(&mut self, field: &PrimeField, classes: &[Residue]) -> Option<()> {
        let modulus = IBig::from(self.modulus.clone());
        let reciprocal = field.inv(field.from_integer(&modulus))?;
        for (value, &class) in self.values.iter_mut().zip(classes) {
            let missing = field.sub(class, field.from_integer(value));
            let digit = field.to_u64(field.mul(missing, reciprocal));
            *value += &modulus * IBig::from(digit);
        }
        self.modulus *= UBig::from(field.modulus());
        Some(())
    }

    /// The integers of these classes that are smallest in absolute value.
    fn centred(self) -> Vec<IBig> {
        let modulus = IBig::from(self.modulus);
        let half = &modulus / IBig::from(2);
        let values = self.values.into_iter();
        values
            .map(|x| if x > half { x - &modulus } else { x })
            .collect()
    }
}

fn lcm(a: &UBig, b: &UBig) -> UBig {
    use dashu_base::Gcd;
    a / a.gcd(b) * b
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn matrix(rows: &[&[(i64, i64)]]) -> Vec<Vec<RBig>> {
        let row = |row: &&[(i64, i64)]| row.iter().map(|&(n, d)| ratio(n, d).unwrap()).collect();
        rows.iter().map(row).collect()
    }

    /// det(λE − F) of two rows is written out.
    #[test]
    fn two_rows() {
        let e = matrix(&[&[(1, 2), (0, 1)], &[(1, 3), (2, 1)]]);
        let f = matrix(&[&[(1, 1), (-3, 4)], &[(5, 7), (0, 1)]]);
        let found = characteristic_polynomial(&e, &f).unwrap();
        // (λ/2 − 1)(2λ) − (3/4)(λ/3 − 5/7) = λ² − 9/4 λ + 15/28
        let expected = [(15, 28), (-9, 4), (1, 1)].map(|(n, d)| ratio(n, d).unwrap());
        assert_eq!(found, expected);
    }

    /// det(λE − F) = λ² − 5 λ − 2, and no other polynomial passes.
    #[test]
    fn a_wrong_polynomial_is_seen_at_a_place() {
        let e = matrix(&[&[(1, 1), (0, 1)], &[(0, 1), (1, 1)]]);
        let f = matrix(&[&[(1, 1), (2, 1)], &[(3, 1), (4, 1)]]);
        let pencil = Pencil::new(&e, &f);
        let field = next_field(&mut (1_u64 << PRIME_BITS));
        let has = |own: [i64; 3]| pencil.has_value(&own.map(IBig::from), &field);
        assert!(has([-2, -5, 1]));
        assert!(!has([-2, -4, 1]));
        assert!(!has([-1, -5, 1]));
    }

    /// The companion matrix of a polynomial has it as its own, with rows and columns in any order and any scale of the rows.
    #[test]
    fn companion_matrices() {
        let n = 40;
        let coefficient = |i: usize| ratio(i as i64 * 37 % 23 - 11, i as i64 % 7 + 1).unwrap();
        let place = |i: usize| i * 17 % n;
        let (zero, one) = (ratio(0, 1).unwrap(), ratio(1, 1).unwrap());
        let mut e = vec![vec![zero.clone(); n]; n];
        let mut f = e.clone();
        for i in 0..n {
            let scale = ratio(i as i64 % 5 + 1, 3).unwrap();
            e[place(i)][place(i)] = scale.clone();
            if i + 1 < n {
                f[place(i)][place(i + 1)] = scale;
            } else {
                for j in 0..n {
                    f[place(i)][place(j)] = -coefficient(j) * &scale;
                }
            }
        }
        let found = characteristic_polynomial(&e, &f).unwrap();
        let leading = found[n].clone();
        let monic: Vec<RBig> = found.into_iter().map(|c| c / &leading).collect();
        let expected: Vec<RBig> = (0..n).map(coefficient).chain([one]).collect();
        assert_eq!(monic, expected);
    }

    /// A dense matrix T D T⁻¹ with the eigenvalues in D, where T and T⁻¹ are products of triangular matrices of ones, and any regular E from
    /// the left: det(λE − E T D T⁻¹) = det E ∏(λ − d).
    #[test]
    fn dense_matrices_with_known_eigenvalues() {
        for n in 1..9 {
            let number = |x: i64| ratio(x, 1).unwrap();
            let product = |a: &[Vec<RBig>], b: &[Vec<RBig>]| -> Vec<Vec<RBig>> {
                let entry =
                    |i: usize, j: usize| (0..n).fold(number(0), |sum, k| sum + &a[i][k] * &b[k][j]);
                let row = |i: usize| (0..n).map(|j| entry(i, j)).collect();
                (0..n).map(row).collect()
            };
            let made = |entry: &dyn Fn(usize, usize) -> i64| -> Vec<Vec<RBig>> {
                let row = |i: usize| (0..n).map(|j| number(entry(i, j))).collect();
                (0..n).map(row).collect()
            };
            let lower = made(&|i, j| i64::from(i >= j));
            let upper = made(&|i, j| i64::from(i <= j));
            let back_lower = made(&|i, j| i64::from(i == j) - i64::from(i == j + 1));
            let back_upper = made(&|i, j| i64::from(i == j) - i64::from(i + 1 == j));
            let own = |i: usize| [2, -1, 3, 0, 3, -7, 5, 1][i];
            let diagonal = made(&|i, j| if i == j { own(i) } else { 0 });
            let there = product(&lower, &upper);
            let back = product(&back_upper, &back_lower);
            let dense = product(&product(&there, &diagonal), &back);
            let left = made(&|i, j| {
                if i == j {
                    3
                } else {
                    i64::from(i < j) * (j as i64)
                }
            });
            let found = characteristic_polynomial(&left, &product(&left, &dense)).unwrap();
            let mut expected = vec![number(3_i64.pow(n as u32))];
            for i in 0..n {
                let times_root = expected.iter().map(|c| -c * number(own(i)));
                let times_root: Vec<RBig> = times_root.chain([number(0)]).collect();
                let shifted = std::iter::once(number(0)).chain(expected);
                expected = shifted.zip(times_root).map(|(a, b)| a + b).collect();
            }
            assert_eq!(found, expected, "{n}");
        }
    }

    #[test]
    fn a_singular_left_matrix_has_none() {
        let e = matrix(&[&[(1, 1), (2, 1)], &[(2, 1), (4, 1)]]);
        assert_eq!(characteristic_polynomial(&e, &e), None);
        assert_eq!(
            characteristic_polynomial(&[], &[]),
            Some(vec![ratio(1, 1).unwrap()])
        );
    }
}
