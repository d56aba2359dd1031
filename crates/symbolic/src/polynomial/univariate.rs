//! Dense polynomials in one variable over a prime field: gcd and interpolation.
//!
//! Coefficients ascend; the last one is not zero.

use crate::number::prime_field::{PrimeField, Residue};
use crate::number::random::Random;

/// A random non-zero element.
pub(super) fn random_unit(field: &PrimeField, random: &mut Random) -> Residue {
    field.from_u64(1 + random.below(field.modulus() - 1))
}

/// The inverse of an element known not to be zero; 0 for 0.
pub(super) fn inverse(field: &PrimeField, a: Residue) -> Residue {
    field.inv(a).unwrap_or(Residue::ZERO)
}

/// Removes leading zeros.
pub(super) fn trim(a: &mut Vec<Residue>) {
    while a.last() == Some(&Residue::ZERO) {
        a.pop();
    }
}

/// The monic greatest common divisor; empty when both arguments are.
pub(super) fn gcd(field: &PrimeField, mut a: Vec<Residue>, mut b: Vec<Residue>) -> Vec<Residue> {
    trim(&mut a);
    trim(&mut b);
    while !b.is_empty() {
        remainder(field, &mut a, &b);
        std::mem::swap(&mut a, &mut b);
    }
    if let Some(&lead) = a.last() {
        let scale = inverse(field, lead);
        for c in &mut a {
            *c = field.mul(*c, scale);
        }
    }
    a
}

/// Replaces `a` by its remainder modulo the non-zero `b`.
fn remainder(field: &PrimeField, a: &mut Vec<Residue>, b: &[Residue]) {
    let Some(&lead) = b.last() else { return };
    let scale = inverse(field, lead);
    while a.len() >= b.len() {
        let Some(&top) = a.last() else { break };
        let factor = field.mul(top, scale);
        let shift = a.len() - b.len();
        for (i, &c) in b.iter().enumerate() {
            a[shift + i] = field.sub(a[shift + i], field.mul(factor, c));
        }
        trim(a);
    }
}

/// The polynomial of degree below the number of points through them (Newton's divided differences); `None` when two
/// abscissas coincide.
pub(super) fn interpolate(
    field: &PrimeField,
    xs: &[Residue],
    ys: &[Residue],
) -> Option<Vec<Residue>> {
    let n = xs.len();
    let mut table = ys.to_vec();
    for level in 1..n {
        for i in (level..n).rev() {
            let run = field.sub(xs[i], xs[i - level]);
            if run.is_zero() {
                return None;
            }
            table[i] = field.mul(field.sub(table[i], table[i - 1]), inverse(field, run));
        }
    }
    let mut result: Vec<Residue> = Vec::with_capacity(n);
    for i in (0..n).rev() {
        // result = result * (x - xs[i]) + table[i]
        result.insert(0, Residue::ZERO);
        for j in 0..result.len() - 1 {
            let lower = field.mul(result[j + 1], xs[i]);
            result[j] = field.sub(result[j], lower);
        }
        result[0] = field.add(result[0], table[i]);
    }
    Some(result)
}

/// Solves Σ_j c_j m_j^s = v_s for s = 1, …, n, with distinct non-zero nodes m_j; `None` when nodes coincide.
pub(super) fn solve_transposed_vandermonde(
    field: &PrimeField,
    nodes: &[Residue],
    values: &[Residue],
) -> Option<Vec<Residue>> {
    let n = nodes.len();
    // master = Π (x - m_j), ascending coefficients.
    let mut master = vec![field.one()];
    for &node in nodes {
        master.insert(0, Residue::ZERO);
        for j in 0..master.len() - 1 {
            let lower = field.mul(master[j + 1], node);
            master[j] = field.sub(master[j], lower);
        }
    }
    let mut solution = Vec::with_capacity(n);
    for &node in nodes {
        // quotient = master / (x - node) by Horner; its value at the node is the Lagrange denominator.
        let (mut carry, mut sum, mut denominator) = (Residue::ZERO, Residue::ZERO, Residue::ZERO);
        for k in (0..n).rev() {
            carry = field.add(master[k + 1], field.mul(carry, node));
            sum = field.add(sum, field.mul(carry, values[k]));
            denominator = field.add(field.mul(denominator, node), carry);
        }
        if denominator.is_zero() || node.is_zero() {
            return None;
        }
        // The equations start at the first power, hence one more division by the node.
        solution.push(field.mul(sum, inverse(field, field.mul(denominator, node))));
    }
    Some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lift(field: &PrimeField, values: &[u64]) -> Vec<Residue> {
        values.iter().map(|&v| field.from_u64(v)).collect()
    }

    #[test]
    fn gcd_finds_the_common_root() {
        let field = PrimeField::new(10007).unwrap();
        // (x-1)(x-2) and (x-1)(x-3)
        let a = lift(&field, &[2, 10004, 1]);
        let b = lift(&field, &[3, 10003, 1]);
        assert_eq!(gcd(&field, a, b), lift(&field, &[10006, 1]));
    }

    #[test]
    fn interpolation_recovers_a_cubic() {
        let field = PrimeField::new(10007).unwrap();
        let value = |x: u64| 5 + 3 * x + x * x * x;
        let xs = [1, 2, 5, 9];
        let ys = xs.map(value);
        let found = interpolate(&field, &lift(&field, &xs), &lift(&field, &ys)).unwrap();
        assert_eq!(found, lift(&field, &[5, 3, 0, 1]));
    }

    #[test]
    fn vandermonde_is_solved() {
        let field = PrimeField::new(10007).unwrap();
        let nodes = lift(&field, &[2, 3, 7]);
        // 4·2^s + 5·3^s + 6·7^s for s = 1, 2, 3
        let values = lift(&field, &[65, 355, 2225]);
        assert_eq!(
            solve_transposed_vandermonde(&field, &nodes, &values).unwrap(),
            lift(&field, &[4, 5, 6])
        );
    }
}
