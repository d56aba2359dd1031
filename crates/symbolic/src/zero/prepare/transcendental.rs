//! Exponentials and logarithms.

use dashu_int::IBig;

use super::super::program::{Generator, Operation, Value};
use super::{half, is_even, Builder, Missing};
use crate::node::{Expr, Function, Node};
use crate::rational::{self, Rational};

impl Builder<'_> {
    /// e^x as a product of powers of generators e^(monomial/parts).
    pub(super) fn exponential(&mut self, x: Expr) -> Result<Value, Missing> {
        let form = self.form(x);
        let mut parts: Vec<(Expr, Rational)> = form.terms.into_iter().collect();
        if !form.constant.is_zero() {
            parts.push((self.graph.one(), form.constant));
        }
        let powers: Vec<Expr> = parts
            .iter()
            .filter_map(|(m, r)| self.power_of_logarithm(*m, r))
            .collect();
        let mut factors = self.values(powers.into_iter())?;
        for (monomial, coefficient) in parts {
            if self.power_of_logarithm(monomial, &coefficient).is_none() {
                factors.push(self.exponential_part(monomial, &coefficient));
            }
        }
        Ok(self.product(Rational::ONE, factors))
    }

    /// e^(r log y) = y^r.
    fn power_of_logarithm(&self, monomial: Expr, coefficient: &Rational) -> Option<Expr> {
        match self.graph.node(monomial) {
            Node::Apply {
                function: Function::Log,
                arguments,
            } => Some(
                self.graph
                    .pow(arguments[0], self.graph.number(coefficient.clone())),
            ),
            _ => None,
        }
    }

    fn exponential_part(&mut self, monomial: Expr, coefficient: &Rational) -> Value {
        let parts = self.exponent_parts.get(&monomial).copied().unwrap_or(1);
        let scaled = coefficient * Rational::from(IBig::from(parts));
        if !scaled.is_int() {
            let own = self.graph.scale(coefficient, monomial);
            return self.exponential_unit(own, 1);
        }
        let unit = self.exponential_unit(monomial, parts);
        self.power_of(unit, scaled.numerator().clone())
    }

    fn exponential_unit(&mut self, monomial: Expr, parts: u64) -> Value {
        if let Some(&value) = self.exponentials.get(&(monomial, parts)) {
            return value;
        }
        let independent = self.is_monomial_in_symbols(monomial);
        self.program.faithful &= independent;
        let value = self.generator(Generator::Transcendental {
            text: "exp".to_owned(),
            independent,
            of: monomial,
        });
        self.exponentials.insert((monomial, parts), value);
        value
    }

    /// sinh, cosh, tanh by e^x and e^(−x).
    pub(super) fn hyperbolic(&mut self, function: Function, x: Expr) -> Result<Value, Missing> {
        let up = self.value(self.graph.exp(x))?;
        let down = self.power_of(up, IBig::from(-1));
        let mut combine = |second: Rational| {
            self.sum(&Rational::ZERO, vec![(up, half()), (down, second * half())])
        };
        Ok(match function {
            Function::Sinh => combine(Rational::NEG_ONE),
            Function::Cosh => combine(Rational::ONE),
            _ => {
                let (sinh, cosh) = (combine(Rational::NEG_ONE), combine(Rational::ONE));
                let reciprocal = self.power_of(cosh, IBig::from(-1));
                self.product(Rational::ONE, vec![sinh, reciprocal])
            }
        })
    }

    /// log x as Σ exponent·log|base|, as far as signs allow.
    pub(super) fn logarithm(&mut self, x: Expr) -> Result<Value, Missing> {
        let (coefficient, factors) = self.factors(x);
        // log of e^y is y.
        let exponents: Vec<Expr> = factors
            .iter()
            .filter_map(|(base, _)| self.exponent_of(*base))
            .collect();
        self.values(exponents.into_iter())?;
        let mut terms = Vec::new();
        let mut flip = rational::is_negative(&coefficient);
        let mut rest: Vec<(Expr, Rational)> = Vec::new();
        self.logarithm_of_number(&rational::abs(&coefficient), &mut terms);
        for (base, exponent) in factors {
            if let Some(y) = self.exponent_of(base) {
                terms.push((self.value(y)?, exponent));
                continue;
            }
            let sign = self.sign_of_power(base, &exponent);
            if sign.is_nonnegative() || sign.is_nonpositive() {
                flip ^= !sign.is_nonnegative();
                terms.push((self.logarithm_generator(base), exponent));
            } else {
                rest.push((base, exponent));
            }
        }
        match &rest[..] {
            [] if flip => return Ok(self.nowhere()),
            [] => {}
            // One factor of unknown sign: the logarithm exists only where the sign fits.
            [(base, exponent)] if exponent.is_int() && !is_even(exponent) => {
                terms.push((self.logarithm_generator(*base), exponent.clone()));
            }
            _ => {
                let powers: Vec<Expr> = rest
                    .iter()
                    .map(|(base, r)| self.graph.pow(*base, self.graph.number(r.clone())))
                    .collect();
                let product = self.graph.mul(&powers);
                terms.push((self.logarithm_generator(product), Rational::ONE));
            }
        }
        Ok(self.sum(&Rational::ZERO, terms))
    }

    fn exponent_of(&self, base: Expr) -> Option<Expr> {
        match self.graph.node(base) {
            Node::Apply {
                function: Function::Exp,
                arguments,
            } => Some(arguments[0]),
            _ => None,
        }
    }

    /// log of a positive number by its small prime factors.
    fn logarithm_of_number(&mut self, number: &Rational, terms: &mut Vec<(Value, Rational)>) {
        let (numerator, denominator) = number.clone().into_parts();
        for (natural, sign) in [
            (numerator.into_parts().1, Rational::ONE),
            (denominator, Rational::NEG_ONE),
        ] {
            let (primes, rest) = rational::small_factors(&natural);
            let mut factors: Vec<(IBig, u32)> = primes
                .into_iter()
                .map(|(p, e)| (IBig::from(p), e))
                .collect();
            if !rest.is_one() && !rest.is_zero() {
                factors.push((IBig::from(rest), 1));
            }
            for (prime, exponent) in factors {
                let generator = self.logarithm_generator(self.graph.number(Rational::from(prime)));
                terms.push((generator, &sign * Rational::from(IBig::from(exponent))));
            }
        }
    }

    /// The generator log|base|.
    fn logarithm_generator(&mut self, base: Expr) -> Value {
        let base = if self.graph.leads_negative(base) {
            self.graph.neg(base)
        } else {
            base
        };
        if let Some(&value) = self.logarithms.get(&base) {
            return value;
        }
        self.program.faithful = false;
        let value = self.generator(Generator::Transcendental {
            text: "log".to_owned(),
            independent: false,
            of: base,
        });
        self.logarithms.insert(base, value);
        value
    }

    /// |x| = |coefficient|·Π |base|^exponent.
    pub(super) fn absolute(&mut self, x: Expr) -> Result<Value, Missing> {
        let (coefficient, factors) = self.factors(x);
        self.values(factors.iter().map(|(base, _)| *base))?;
        let mut flip = false;
        let mut values = Vec::new();
        for (base, exponent) in factors {
            let sign = self.sign_of_power(base, &exponent);
            flip ^= sign.is_nonpositive() && !sign.is_nonnegative();
            values.push(if sign.is_nonnegative() || sign.is_nonpositive() {
                self.value_power(base, &exponent)?
            } else {
                let modulus = self.modulus(base)?;
                self.power_of(modulus, exponent.numerator().clone())
            });
        }
        let magnitude = rational::abs(&coefficient);
        Ok(self.product(if flip { -magnitude } else { magnitude }, values))
    }

    /// sign x = x/|x|, where x ≠ 0.
    pub(super) fn sign(&mut self, x: Expr) -> Result<Value, Missing> {
        let known = self.signs.sign(x);
        if !known.is_nonzero() {
            self.exclude_zero(x);
        }
        if known.is_nonnegative() || known.is_nonpositive() {
            let one = if known.is_nonnegative() {
                Rational::ONE
            } else {
                Rational::NEG_ONE
            };
            return Ok(self.number(one));
        }
        let magnitude = self.graph.abs(x);
        let values = self.values([x, magnitude].into_iter())?;
        let reciprocal = self.power_of(values[1], IBig::from(-1));
        Ok(self.product(Rational::ONE, vec![values[0], reciprocal]))
    }

    /// The value of base^exponent, itself an expression.
    fn value_power(&mut self, base: Expr, exponent: &Rational) -> Result<Value, Missing> {
        if exponent.is_int() {
            let base = self.value(base)?;
            return Ok(self.power_of(base, exponent.numerator().clone()));
        }
        self.rational_power(base, exponent)
    }

    /// |base| for a base of unknown sign: a root of base², never base itself.
    pub(super) fn modulus(&mut self, base: Expr) -> Result<Value, Missing> {
        let key = if self.graph.leads_negative(base) {
            self.graph.neg(base)
        } else {
            base
        };
        if let Some(&value) = self.moduli.get(&key) {
            return Ok(value);
        }
        let value = self.value(base)?;
        let radicand = self.power_of(value, IBig::from(2));
        let radical = self.new_radical();
        let modulus = self.push(Operation::SquareRoot { radicand, radical });
        self.moduli.insert(key, modulus);
        Ok(modulus)
    }
}
