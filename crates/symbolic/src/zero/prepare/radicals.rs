//! Rational powers: radicals of independent radicands, as far as factors and known signs allow.
//!
//! √(x y) = √x √y needs signs, √(x²) = |x| and never x without one. A root is taken of each factor known to be
//! non-negative; at most one factor of unknown sign is non-negative because the root exists; several stay together.

use dashu_int::IBig;

use super::super::program::{Operation, Value};
use super::{is_even, Builder, Missing};
use crate::factors::factored_within;
use crate::node::{Expr, Function, Node};
use crate::polynomial::Budget;
use crate::rational::{self, Rational};

/// Room for factoring one radicand.
const RADICAND: Budget = Budget {
    terms: 200,
    degree: 24,
    bits: 400,
    work: 50_000,
};

impl Builder<'_> {
    /// base^r for a rational r that is not an integer; defined for base ≥ 0.
    pub(super) fn rational_power(&mut self, base: Expr, r: &Rational) -> Result<Value, Missing> {
        let (coefficient, factors) = self.factors_of_radicand(base);
        if coefficient.is_zero() {
            return Ok(if rational::is_negative(r) {
                self.nowhere()
            } else {
                self.number(Rational::ZERO)
            });
        }
        let mut roots: Vec<(Expr, Rational)> = Vec::new();
        let mut flip = rational::is_negative(&coefficient);
        let mut rest: Vec<Expr> = Vec::new();
        let magnitude = rational::abs(&coefficient);
        if !magnitude.is_one() {
            roots.push((self.graph.number(magnitude), r.clone()));
        }
        for (factor, exponent) in factors {
            let sign = self.sign_of_power(factor, &exponent);
            let total = &exponent * r;
            if sign.is_nonnegative() {
                roots.push(self.root_of_nonnegative(factor, &exponent, total));
            } else if sign.is_nonpositive() {
                flip = !flip;
                roots.push((self.graph.neg(factor), total));
            } else {
                rest.push(self.graph.pow(factor, self.graph.number(exponent)));
            }
        }
        if rest.is_empty() && flip {
            return Ok(self.nowhere());
        }
        if !rest.is_empty() {
            let product = self.graph.mul(&rest);
            let (radicand, exponent) = self.single_power(
                if flip {
                    self.graph.neg(product)
                } else {
                    product
                },
                r,
            );
            roots.push((radicand, exponent));
        }
        self.values(
            roots
                .iter()
                .filter_map(|(radicand, _)| self.radicand_needed(*radicand)),
        )?;
        let mut values = Vec::with_capacity(roots.len());
        for (radicand, exponent) in roots {
            values.push(self.root(radicand, &exponent)?);
        }
        Ok(self.product(Rational::ONE, values))
    }

    /// The factors of a radicand, those of a sum included: on `z' = a √(x'² + y'²)` the radicand `x'² + y'² + z'²` is
    /// `(1 + a²) (x'² + y'²)`, and its root is tied to that of `x'² + y'²`.
    fn factors_of_radicand(&self, base: Expr) -> (Rational, Vec<(Expr, Rational)>) {
        let structural = || self.factors(base);
        if !matches!(self.graph.node(base), Node::Sum { .. }) {
            return structural();
        }
        match factored_within(self.graph, base, RADICAND) {
            Some(found) if found.factors.len() > 1 => {
                let powers = found.factors.into_iter();
                let powers = powers.map(|(f, n)| (f, Rational::from(n)));
                (found.coefficient, powers.collect())
            }
            _ => structural(),
        }
    }

    /// (factor^exponent)^r for factor^exponent ≥ 0: an even power is a power of |factor|.
    fn root_of_nonnegative(
        &mut self,
        factor: Expr,
        exponent: &Rational,
        total: Rational,
    ) -> (Expr, Rational) {
        if !exponent.is_int() || !is_even(exponent) {
            return (factor, total);
        }
        let sign = self.signs.sign(factor);
        if sign.is_nonnegative() || (total.is_int() && is_even(&total)) {
            (factor, total)
        } else if sign.is_nonpositive() {
            (self.graph.neg(factor), total)
        } else {
            (self.graph.abs(factor), total)
        }
    }

    /// x^3 to the power r is x to the power 3r where x ≥ 0, which holds where the root exists.
    fn single_power(&self, e: Expr, r: &Rational) -> (Expr, Rational) {
        let (coefficient, factors) = self.factors(e);
        match &factors[..] {
            [(base, exponent)] if exponent.is_int() && !exponent.is_one() && !is_even(exponent) => {
                let base = if rational::is_negative(&coefficient) {
                    self.graph.neg(*base)
                } else {
                    *base
                };
                (base, exponent * r)
            }
            _ => (e, r.clone()),
        }
    }

    fn radicand_needed(&self, radicand: Expr) -> Option<Expr> {
        match self.graph.node(radicand) {
            Node::Apply {
                function: Function::Exp,
                ..
            } => None,
            _ => Some(radicand),
        }
    }

    /// radicand^r for radicand ≥ 0.
    fn root(&mut self, radicand: Expr, r: &Rational) -> Result<Value, Missing> {
        if let Node::Apply {
            function: Function::Exp,
            arguments,
        } = self.graph.node(radicand)
        {
            let power = self.graph.exp(self.graph.scale(r, arguments[0]));
            return self.value(power);
        }
        let value = self.value(radicand)?;
        if r.is_int() {
            return Ok(self.power_of(value, r.numerator().clone()));
        }
        let Ok(degree) = u64::try_from(r.denominator()) else {
            return Ok(self.opaque_power(radicand, r));
        };
        let twos = degree.trailing_zeros();
        let odd = degree >> twos;
        if odd > 1 << 16 || twos > 16 {
            return Ok(self.opaque_power(radicand, r));
        }
        // p/(2^k m) = α/2^k + β/m with α m + β 2^k = p.
        let (alpha, beta) = partial_fractions(r.numerator(), twos, odd);
        let mut factors = Vec::new();
        if twos > 0 {
            let root = self.square_roots(radicand, value, twos);
            factors.push(self.power_of(root, alpha));
        } else if alpha != IBig::ZERO {
            factors.push(self.power_of(value, alpha));
        }
        if odd > 1 {
            let root = self.odd_root(radicand, value, odd);
            factors.push(self.power_of(root, beta));
        }
        Ok(self.product(Rational::ONE, factors))
    }

    fn opaque_power(&mut self, radicand: Expr, r: &Rational) -> Value {
        let power = self.graph.pow(radicand, self.graph.number(r.clone()));
        self.opaque(power)
    }

    /// The 2^count-th root, by repeated square roots.
    fn square_roots(&mut self, radicand: Expr, value: Value, count: u32) -> Value {
        let mut root = value;
        for depth in 1..=count {
            root = match self.roots.get(&(radicand, depth)) {
                Some(&root) => root,
                None => {
                    let gauss = if depth == 1 {
                        self.gauss_sum(radicand)
                    } else {
                        None
                    };
                    let next = match gauss {
                        Some(sum) => sum,
                        None => {
                            let radical = self.new_radical();
                            self.push(Operation::SquareRoot {
                                radicand: root,
                                radical,
                            })
                        }
                    };
                    self.roots.insert((radicand, depth), next);
                    next
                }
            };
        }
        root
    }

    fn odd_root(&mut self, radicand: Expr, value: Value, degree: u64) -> Value {
        if let Some(&root) = self.odd_roots.get(&(radicand, degree)) {
            return root;
        }
        let mut rest = degree;
        let mut divisor = 3;
        while rest > 1 {
            if rest.is_multiple_of(divisor) {
                rest /= divisor;
                if !self.program.odd_roots.contains(&divisor) {
                    self.program.odd_roots.push(divisor);
                }
            } else {
                divisor += 2;
            }
        }
        let root = self.push(Operation::OddRoot {
            radicand: value,
            degree,
        });
        self.odd_roots.insert((radicand, degree), root);
        root
    }

    pub(super) fn new_radical(&mut self) -> u32 {
        self.program.radicals += 1;
        self.program.radicals - 1
    }

    /// √q for a prime q that is already in the cyclotomic field used: √2 = 2 cos(π/4), otherwise Gauss's sum
    /// Σ (a/q) e^(2πia/q) = √q for q ≡ 1 (mod 4), i√q for q ≡ 3 (mod 4).
    fn gauss_sum(&mut self, radicand: Expr) -> Option<Value> {
        let order = self.program.order_of_unity;
        let q = u64::try_from(rational::to_i64(self.graph.as_number(radicand)?)?).ok()?;
        if q == 2 && order.is_multiple_of(8) {
            let cosine = self.push(Operation::UnityCos(order / 8));
            return Some(self.sum(&Rational::ZERO, vec![(cosine, rational::integer(2))]));
        }
        if q < 3 || !order.is_multiple_of(q) || !crate::number::prime::is_prime(q) {
            return None;
        }
        let mut terms = Vec::new();
        for a in 1..q {
            let index = order / q * a;
            let part = if q % 4 == 1 {
                Operation::UnityCos(index)
            } else {
                Operation::UnitySin(index)
            };
            let value = self.push(part);
            terms.push((
                value,
                if is_square_modulo(a, q) {
                    Rational::ONE
                } else {
                    Rational::NEG_ONE
                },
            ));
        }
        Some(self.sum(&Rational::ZERO, terms))
    }
}

fn is_square_modulo(a: u64, q: u64) -> bool {
    (1..q).any(|x| x * x % q == a)
}

/// α, β with α·odd + β·2^twos = p and 0 ≤ β < odd.
fn partial_fractions(p: &IBig, twos: u32, odd: u64) -> (IBig, IBig) {
    let power = IBig::from(1) << twos as usize;
    let m = IBig::from(odd);
    let residue = ((p % &m) + &m) % &m;
    // β ≡ p·2^(−twos) (mod odd), found by halving.
    let mut beta = residue;
    for _ in 0..twos {
        if beta.trailing_zeros() == Some(0) {
            beta += &m;
        }
        beta = &beta >> 1_usize;
    }
    let alpha = (p - &beta * &power) / &m;
    (alpha, beta)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partial_fractions_add_up() {
        for p in -20..20 {
            for twos in 0..5 {
                for odd in [1_u64, 3, 5, 9, 15] {
                    let (alpha, beta) = partial_fractions(&IBig::from(p), twos, odd);
                    assert_eq!(
                        alpha * IBig::from(odd) + &beta * (IBig::from(1) << twos as usize),
                        IBig::from(p)
                    );
                }
            }
        }
    }
}
