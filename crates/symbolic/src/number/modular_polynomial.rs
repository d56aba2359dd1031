//! Polynomials in one variable over a prime field, lists of coefficients from the constant on without zeros at the end: roots,
//! and rational functions from their values.

use super::prime_field::{PrimeField, Residue};
use super::random::Random;

/// A random root of the monic polynomial with these lower coefficients, if it has one in the prime field: the part that
/// splits into linear factors is gcd(x^p − x, f), and (x + a)^((p−1)/2) − 1 takes it apart (Cantor and Zassenhaus, Math. Comp.
/// 36, 1981).
pub fn random_root(field: &PrimeField, lower: &[Residue], random: &mut Random) -> Option<Residue> {
    if let &[c, b] = lower {
        return quadratic_root(field, [c, b], random);
    }
    let mut f = lower.to_vec();
    f.push(field.one());
    let x = vec![Residue::ZERO, field.one()];
    let mut power = power_modulo(field, &x, field.modulus(), &f);
    power.resize(power.len().max(2), Residue::ZERO);
    power[1] = field.sub(power[1], field.one());
    let mut linear = gcd(field, f, power);
    for _ in 0..200 {
        match linear.len() {
            0 | 1 => return None,
            2 => return Some(field.neg(linear[0])),
            _ => {}
        }
        let shifted = vec![field.random(random), field.one()];
        let mut half = power_modulo(field, &shifted, (field.modulus() - 1) / 2, &linear);
        half.resize(half.len().max(1), Residue::ZERO);
        half[0] = field.sub(half[0], field.one());
        let part = gcd(field, linear.clone(), half);
        if part.len() > 1 && part.len() < linear.len() {
            linear = part;
        }
    }
    None
}

/// A random root of x² + b x + c.
fn quadratic_root(
    field: &PrimeField,
    [c, b]: [Residue; 2],
    random: &mut Random,
) -> Option<Residue> {
    let half = field.inv(field.from_u64(2))?;
    let middle = field.mul(b, half);
    let root = field.sqrt(field.sub(field.mul(middle, middle), c))?;
    let is_first = random.next_u64() & 1 == 0;
    let root = if is_first { root } else { field.neg(root) };
    Some(field.sub(root, middle))
}

/// a^n modulo the monic f.
fn power_modulo(field: &PrimeField, a: &[Residue], n: u64, f: &[Residue]) -> Vec<Residue> {
    let mut result = vec![field.one()];
    for bit in (0..64 - n.leading_zeros()).rev() {
        result = remainder(field, product(field, &result, &result), f);
        if n >> bit & 1 == 1 {
            result = remainder(field, product(field, &result, a), f);
        }
    }
    result
}

/// The product.
pub fn product(field: &PrimeField, a: &[Residue], b: &[Residue]) -> Vec<Residue> {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let mut product = vec![Residue::ZERO; a.len() + b.len() - 1];
    for (i, &x) in a.iter().enumerate() {
        for (j, &y) in b.iter().enumerate() {
            product[i + j] = field.add(product[i + j], field.mul(x, y));
        }
    }
    product
}

/// The remainder by a monic polynomial.
fn remainder(field: &PrimeField, mut a: Vec<Residue>, monic: &[Residue]) -> Vec<Residue> {
    let degree = monic.len().saturating_sub(1);
    while a.len() > degree {
        let Some(leading) = a.pop() else { break };
        let shift = a.len() - degree;
        for (i, &c) in monic[..degree].iter().enumerate() {
            a[shift + i] = field.sub(a[shift + i], field.mul(leading, c));
        }
    }
    trim(&mut a);
    a
}

fn trim(a: &mut Vec<Residue>) {
    while a.last().is_some_and(|c| c.is_zero()) {
        a.pop();
    }
}

/// The monic greatest common divisor.
pub fn gcd(field: &PrimeField, mut a: Vec<Residue>, mut b: Vec<Residue>) -> Vec<Residue> {
    loop {
        trim(&mut b);
        let Some(reciprocal) = b.last().and_then(|&leading| field.inv(leading)) else {
            return a;
        };
        let monic: Vec<Residue> = b.iter().map(|&c| field.mul(c, reciprocal)).collect();
        let rest = remainder(field, a, &monic);
        a = monic;
        b = rest;
    }
}

/// The inverse of a modulo another polynomial; `None` where they have a common factor.
pub fn inverse_modulo(
    field: &PrimeField,
    a: &[Residue],
    modulus: &[Residue],
) -> Option<Vec<Residue>> {
    let (mut r, mut next) = (modulus.to_vec(), a.to_vec());
    let (mut t, mut next_t) = (Vec::new(), vec![field.one()]);
    trim(&mut next);
    while !next.is_empty() {
        let (quotient, rest) = quotient_and_remainder(field, r, &next)?;
        let step = product(field, &quotient, &next_t);
        let after = difference(field, t, &step);
        (r, next) = (next, rest);
        (t, next_t) = (next_t, after);
    }
    let &[unit] = r.as_slice() else {
        return None;
    };
    let scale = field.inv(unit)?;
    let scaled = t.iter().map(|&c| field.mul(c, scale)).collect();
    quotient_and_remainder(field, scaled, modulus).map(|(_, rest)| rest)
}

fn difference(field: &PrimeField, mut a: Vec<Residue>, b: &[Residue]) -> Vec<Residue> {
    if a.len() < b.len() {
        a.resize(b.len(), Residue::ZERO);
    }
    for (x, &y) in a.iter_mut().zip(b) {
        *x = field.sub(*x, y);
    }
    trim(&mut a);
    a
}

/// The monic irreducible factors of a polynomial without multiple ones; `None` where it has multiple ones, or is a constant. Those of one
/// degree d are the greatest common divisor with x^(p^d) − x, which random polynomials take apart (Cantor and Zassenhaus, Math. Comp. 36, 1981).
pub fn factors(
    field: &PrimeField,
    f: &[Residue],
    random: &mut Random,
) -> Option<Vec<Vec<Residue>>> {
    let mut f = f.to_vec();
    trim(&mut f);
    let reciprocal = field.inv(*f.last()?)?;
    f.iter_mut().for_each(|c| *c = field.mul(*c, reciprocal));
    let slopes = f.iter().zip(0_u64..).skip(1);
    let slopes = slopes.map(|(&c, n)| field.mul(field.from_u64(n), c));
    if f.len() < 2 || gcd(field, f.clone(), slopes.collect()).len() != 1 {
        return None;
    }
    let x = [Residue::ZERO, field.one()];
    let (mut found, mut rest, mut power) = (Vec::new(), f, x.to_vec());
    for degree in 1.. {
        if rest.len() <= 2 * degree {
            break;
        }
        power = power_modulo(field, &power, field.modulus(), &rest);
        let part = gcd(field, rest.clone(), difference(field, power.clone(), &x));
        if part.len() > 1 {
            rest = quotient_and_remainder(field, rest, &part)?.0;
            found.extend(of_equal_degree(field, part, degree, random));
            power = quotient_and_remainder(field, power, &rest)?.1;
        }
    }
    if rest.len() > 1 {
        found.push(rest);
    }
    Some(found)
}

/// The factors of a product of monic irreducible polynomials of one degree.
fn of_equal_degree(
    field: &PrimeField,
    f: Vec<Residue>,
    degree: usize,
    random: &mut Random,
) -> Vec<Vec<Residue>> {
    let (mut open, mut found) = (vec![f], Vec::new());
    while let Some(f) = open.pop() {
        if f.len() <= degree + 1 {
            found.push(f);
            continue;
        }
        let any: Vec<Residue> = (1..f.len()).map(|_| field.random(random)).collect();
        // The norm, a^(1 + p + … + p^(d − 1)), is a number modulo each factor, a square in half of all cases.
        let (mut norm, mut conjugate) = (any.clone(), any);
        for _ in 1..degree {
            conjugate = power_modulo(field, &conjugate, field.modulus(), &f);
            norm = remainder(field, product(field, &norm, &conjugate), &f);
        }
        let half = power_modulo(field, &norm, (field.modulus() - 1) / 2, &f);
        let part = gcd(field, f.clone(), difference(field, half, &[field.one()]));
        if part.len() > 1 && part.len() < f.len() {
            if let Some((other, _)) = quotient_and_remainder(field, f.clone(), &part) {
                open.extend([part, other]);
                continue;
            }
        }
        open.push(f);
    }
    found
}

/// All roots in the field, each once.
pub fn roots(field: &PrimeField, f: &[Residue], random: &mut Random) -> Vec<Residue> {
    let mut f = f.to_vec();
    trim(&mut f);
    let mut found = Vec::new();
    while f.len() > 1 {
        let Some(reciprocal) = f.last().and_then(|&leading| field.inv(leading)) else {
            break;
        };
        let lower: Vec<Residue> = f[..f.len() - 1]
            .iter()
            .map(|&c| field.mul(c, reciprocal))
            .collect();
        let Some(root) = random_root(field, &lower, random) else {
            break;
        };
        found.push(root);
        while f.len() > 1 && value(field, &f, root).is_zero() {
            f = without_root(field, &f, root);
        }
    }
    found
}

/// The value at a place.
pub fn value(field: &PrimeField, f: &[Residue], x: Residue) -> Residue {
    let terms = f.iter().rev();
    terms.fold(Residue::ZERO, |sum, &c| field.add(field.mul(sum, x), c))
}

/// f/(x - root), where that is a polynomial.
fn without_root(field: &PrimeField, f: &[Residue], root: Residue) -> Vec<Residue> {
    let mut quotient = vec![Residue::ZERO; f.len() - 1];
    let mut carry = Residue::ZERO;
    for (place, &c) in f.iter().enumerate().rev() {
        carry = field.add(c, field.mul(carry, root));
        if place > 0 {
            quotient[place - 1] = carry;
        }
    }
    quotient
}

/// How many more values than unknowns a rational function needs to be believed.
const SPARE: usize = 3;

/// The numerator and the denominator of the rational function of least degree with these values, as (place, value), places
/// different; `None` where no function of so low a degree has them that values are left over. (Monagan, "Maximal quotient
/// rational reconstruction", 2004.)
pub fn fraction(
    field: &PrimeField,
    values: &[(Residue, Residue)],
) -> Option<(Vec<Residue>, Vec<Residue>)> {
    let (mut r, mut next_r) = interpolated(field, values);
    let (mut t, mut next_t) = (Vec::new(), vec![field.one()]);
    let mut best: Option<(usize, Vec<Residue>, Vec<Residue>)> = None;
    while !next_r.is_empty() {
        let degrees = next_r.len() + next_t.len();
        if best.as_ref().is_none_or(|(least, _, _)| degrees < *least) {
            best = Some((degrees, next_r.clone(), next_t.clone()));
        }
        let (quotient, rest) = quotient_and_remainder(field, r, &next_r)?;
        let mut new_t = product(field, &quotient, &next_t);
        new_t.resize(new_t.len().max(t.len()), Residue::ZERO);
        for (c, new) in new_t.iter_mut().enumerate() {
            *new = field.sub(t.get(c).copied().unwrap_or(Residue::ZERO), *new);
        }
        trim(&mut new_t);
        (r, next_r) = (next_r, rest);
        (t, next_t) = (next_t, new_t);
    }
    let (degrees, above, below) = best?;
    (degrees + SPARE <= values.len() + 1).then_some((above, below))
}

/// ∏ (x - x_i), and the polynomial of degree below their number that has these values at x_i.
pub fn interpolated(
    field: &PrimeField,
    values: &[(Residue, Residue)],
) -> (Vec<Residue>, Vec<Residue>) {
    let (mut all, mut f) = (vec![field.one()], Vec::new());
    for &(x, y) in values {
        let slope = field.inv(value(field, &all, x)).unwrap_or(Residue::ZERO);
        let slope = field.mul(field.sub(y, value(field, &f, x)), slope);
        f.resize(all.len(), Residue::ZERO);
        for (c, &own) in f.iter_mut().zip(&all) {
            *c = field.add(*c, field.mul(slope, own));
        }
        all = product(field, &all, &[field.neg(x), field.one()]);
    }
    trim(&mut f);
    (all, f)
}

/// Quotient and remainder; `None` by zero.
pub fn quotient_and_remainder(
    field: &PrimeField,
    mut a: Vec<Residue>,
    by: &[Residue],
) -> Option<(Vec<Residue>, Vec<Residue>)> {
    let reciprocal = field.inv(*by.last()?)?;
    let degree = by.len() - 1;
    let mut quotient = vec![Residue::ZERO; a.len().saturating_sub(degree)];
    while a.len() > degree {
        let Some(leading) = a.pop() else { break };
        let shift = a.len() - degree;
        let factor = field.mul(leading, reciprocal);
        quotient[shift] = factor;
        for (i, &c) in by[..degree].iter().enumerate() {
            a[shift + i] = field.sub(a[shift + i], field.mul(factor, c));
        }
    }
    trim(&mut a);
    Some((quotient, a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_products_of_linear_and_irreducible_factors() {
        let field = PrimeField::new((1 << 61) - 1).unwrap();
        let mut random = Random::new(5);
        let number = |n: i64| field.from_i64(n);
        // (x − 2)(x + 7) and x² − 3 times x − 1; 3 is no square modulo 2^61 − 1 or it is: any root must be one.
        for coefficients in [vec![-14, 5], vec![3, -3, -1], vec![-5]] {
            let lower: Vec<Residue> = coefficients.iter().map(|&n| number(n)).collect();
            let root = random_root(&field, &lower, &mut random).unwrap();
            let mut value = field.one();
            for &c in lower.iter().rev() {
                value = field.add(field.mul(value, root), c);
            }
            assert!(value.is_zero());
        }
        let nonsquare = (2..).find(|&n| field.legendre(field.from_u64(n)) == -1);
        let lower = [field.neg(field.from_u64(nonsquare.unwrap())), Residue::ZERO];
        assert!(random_root(&field, &lower, &mut random).is_none());
    }

    #[test]
    fn factors_multiply_back_and_are_irreducible() {
        let field = PrimeField::new((1 << 61) - 1).unwrap();
        let mut random = Random::new(9);
        for degree in 2..9 {
            let f: Vec<Residue> = (0..=degree).map(|_| field.random(&mut random)).collect();
            let found = factors(&field, &f, &mut random).unwrap();
            let all = found
                .iter()
                .fold(vec![f[degree]], |all, own| product(&field, &all, own));
            assert_eq!(all, f);
            // x^(p^d) = x modulo a factor of degree d, and for no smaller exponent.
            for own in &found {
                let x = vec![Residue::ZERO, field.one()];
                let (_, x) = quotient_and_remainder(&field, x, own).unwrap();
                let mut power = x.clone();
                for d in 1..own.len() {
                    power = power_modulo(&field, &power, field.modulus(), own);
                    assert_eq!(power == x, d == own.len() - 1, "{d} of {}", own.len() - 1);
                }
            }
        }
        // (x - 1)² has no list of different factors, and 1/a modulo b times a is 1.
        let square = [1, -2, 1].map(|n| field.from_i64(n));
        assert!(factors(&field, &square, &mut random).is_none());
        let (a, b) = (
            [3, 1, 2].map(|n| field.from_i64(n)),
            [1, 0, 0, 1].map(|n| field.from_i64(n)),
        );
        let inverse = inverse_modulo(&field, &a, &b).unwrap();
        let (_, one) = quotient_and_remainder(&field, product(&field, &a, &inverse), &b).unwrap();
        assert_eq!(one, [field.one()]);
        assert!(inverse_modulo(&field, &square, &square).is_none());
    }

    /// 3 (x - 2)² (x + 5) (x² + 1)/((x - 7) (x + 1)), from its values.
    #[test]
    fn rational_functions_come_back_with_their_roots() {
        // -1 is no square.
        let field = PrimeField::new((1 << 61) - 1).unwrap();
        let number = |n: i64| field.from_i64(n);
        let at = |x: i64| {
            let (above, below) = (
                3 * (x - 2).pow(2) * (x + 5) * (x * x + 1),
                (x - 7) * (x + 1),
            );
            let below = field.inv(number(below)).unwrap();
            (number(x), field.mul(number(above), below))
        };
        let values: Vec<_> = (10..21).map(at).collect();
        let (above, below) = fraction(&field, &values).unwrap();
        assert_eq!((above.len(), below.len()), (6, 3));
        let mut random = Random::new(3);
        let found = |f: &[Residue], random: &mut Random| {
            let mut found: Vec<u64> = roots(&field, f, random)
                .into_iter()
                .map(|r| field.to_u64(r))
                .collect();
            found.sort_unstable();
            found
        };
        let sorted = |list: &[i64]| {
            let mut list: Vec<u64> = list.iter().map(|&n| field.to_u64(number(n))).collect();
            list.sort_unstable();
            list
        };
        assert_eq!(found(&above, &mut random), sorted(&[2, -5]));
        assert_eq!(found(&below, &mut random), sorted(&[7, -1]));
        // Too few values for these degrees.
        assert!(fraction(&field, &values[..9]).is_none());
    }
}
