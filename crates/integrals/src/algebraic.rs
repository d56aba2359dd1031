//! Numbers such as `(1 + 2 √3)/5` from their classes modulo a prime: a combination of given algebraic numbers with small rational
//! coefficients is a short vector of a lattice.
//!
//! `(d, n_1, …, n_k)` with `d c ≡ n_0 + Σ n_i b_i` modulo p form a lattice of determinant p; its shortest vector has entries of about
//! `p^(1/(k + 2))` for a class c without such a meaning, much shorter ones for one with it. The reduction is that of A. K. Lenstra,
//! H. W. Lenstra and L. Lovász (1982).

use chetaev_symbolic::number::prime_field::{PrimeField, Residue};
use chetaev_symbolic::Rational;

/// More numbers leave too little room for their coefficients.
const NUMBERS: usize = 4;

/// How many bits shorter than by chance a vector has to be.
const MARGIN: f64 = 3.0;

/// At most so many steps; a lattice of five dimensions needs a few hundred.
const STEPS: usize = 20_000;

/// The rational coefficients of a class as a combination of numbers with these classes, the first of which is 1.
pub(crate) fn combination(
    field: &PrimeField,
    class: Residue,
    numbers: &[Residue],
) -> Option<Vec<Rational>> {
    if numbers.len() > NUMBERS {
        return None;
    }
    let dimension = numbers.len() + 1;
    let p = i128::from(field.modulus());
    let balanced = |r: Residue| {
        let value = i128::from(field.to_u64(r));
        if value > p / 2 {
            value - p
        } else {
            value
        }
    };
    let unit = |place: usize, first: i128| {
        let mut row = vec![0_i128; dimension];
        row[1] = first;
        row[place] = if place == 1 { first } else { 1 };
        row
    };
    let mut basis = vec![unit(0, balanced(class)), unit(1, p)];
    for (i, &number) in numbers.iter().enumerate().skip(1) {
        basis.push(unit(i + 1, -balanced(number)));
    }
    let reduced = reduced(basis)?;
    let size = |row: &Vec<i128>| row.iter().map(|x| x.unsigned_abs()).max().unwrap_or(0);
    let shortest = reduced.iter().min_by_key(|row| size(row))?;
    let by_chance = (p as f64).log2() / dimension as f64;
    let denominator = shortest[0];
    let is_short = (size(shortest) as f64).log2() < by_chance - MARGIN;
    (is_short && denominator != 0).then(|| {
        let over = Rational::from(denominator);
        let parts = shortest[1..].iter();
        parts.map(|&n| Rational::from(n) / &over).collect()
    })
}

/// The square lengths of the orthogonalized rows, and the coefficients of the rows before each.
fn orthogonalized(basis: &[Vec<i128>]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let mut coefficients: Vec<Vec<f64>> = Vec::new();
    for row in basis {
        let own: Vec<f64> = row.iter().map(|&x| x as f64).collect();
        let mut rest = own.clone();
        let mut before = Vec::new();
        for other in &rows {
            let mu = dot(&own, other) / dot(other, other);
            rest.iter_mut().zip(other).for_each(|(x, y)| *x -= mu * y);
            before.push(mu);
        }
        rows.push(rest);
        coefficients.push(before);
    }
    (rows.iter().map(|r| dot(r, r)).collect(), coefficients)
}

/// A reduced basis of the lattice; `None` where rounding keeps it from being reached.
fn reduced(mut basis: Vec<Vec<i128>>) -> Option<Vec<Vec<i128>>> {
    const ENOUGH: f64 = 0.75;
    let mut k = 1;
    for _ in 0..STEPS {
        if k == basis.len() {
            return Some(basis);
        }
        for j in (0..k).rev() {
            let (_, coefficients) = orthogonalized(&basis);
            let times = coefficients[k][j].round();
            if !times.is_finite() || times.abs() > 1e30 {
                return None;
            }
            let times = times as i128;
            let other = basis[j].clone();
            for (x, y) in basis[k].iter_mut().zip(other) {
                *x = x.checked_sub(times.checked_mul(y)?)?;
            }
        }
        let (lengths, coefficients) = orthogonalized(&basis);
        let mu = coefficients[k][k - 1];
        match lengths[k] >= (ENOUGH - mu * mu) * lengths[k - 1] {
            true => k += 1,
            false => {
                basis.swap(k, k - 1);
                k = (k - 1).max(1);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use chetaev_symbolic::number::random::Random;

    /// `(1 + 2 √3)/5` where 3 has a root modulo p, and a class by chance.
    #[test]
    fn numbers_come_back_from_their_classes() {
        let field = PrimeField::new((1 << 61) - 1).expect("a prime");
        let mut random = Random::new(3);
        // Whatever the second number is, small coefficients are found.
        let root = field.random(&mut random);
        let ratio = |n: i64, d: i64| Rational::from(n) / Rational::from(d);
        for wanted in [
            [ratio(1, 5), ratio(2, 5)],
            [ratio(0, 1), ratio(-7, 3)],
            [ratio(22, 7), ratio(0, 1)],
        ] {
            let parts = wanted
                .each_ref()
                .map(|c| field.from_rational(c).expect("no multiple"));
            let class = field.add(parts[0], field.mul(parts[1], root));
            let found = combination(&field, class, &[field.one(), root]);
            assert_eq!(found.as_deref(), Some(&wanted[..]));
        }
        let class = field.random(&mut random);
        assert_eq!(combination(&field, class, &[field.one(), root]), None);
    }
}
