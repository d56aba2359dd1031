//! Rational powers and absolute values.
//!
//! A root of order q is taken of a polynomial that is square-free up to powers below q; what comes out of the root comes
//! out with its absolute value when q is even. Square roots are kept independent: when the product of a new radicand
//! with some old ones is a square S², the new root is `|S|` over the old roots (T6 §6.2).

use dashu_base::{Gcd, Sign};
use dashu_int::{IBig, UBig};

use super::super::monomial::Monomial;
use super::super::rational_function::RationalFunction;
use super::super::sparse::Polynomial;
use super::field::{Field, Kind, Radical};
use super::Stop;
use crate::number::algebraic::AlgebraicInteger;
use crate::rational::{self, Rational};
use crate::{Expr, Node};

/// Roots of higher order stay functions about which nothing is known.
const LARGEST_ORDER: u16 = 64;

impl Field<'_> {
    /// `base ^ exponent`; `whole` is the expression of the power where there is one.
    pub(super) fn rational_power(
        &mut self,
        base: &RationalFunction,
        exponent: &Rational,
        whole: Option<Expr>,
    ) -> Result<RationalFunction, Stop> {
        if let Some(n) = rational::to_i64(exponent) {
            return self.pow(base, n);
        }
        if base.is_zero() {
            return if rational::is_negative(exponent) {
                Err(Stop::Undefined)
            } else {
                Ok(base.clone())
            };
        }
        let order = u16::try_from(exponent.denominator())
            .ok()
            .filter(|&q| q <= LARGEST_ORDER);
        let numerator = i64::try_from(exponent.numerator()).ok();
        let (Some(order), Some(numerator)) = (order, numerator) else {
            let whole = whole.unwrap_or_else(|| {
                self.g
                    .pow(self.expression(base), self.g.number(exponent.clone()))
            });
            return Ok(self.free(whole));
        };
        if !self.options.split_roots && base.denominator().as_constant().is_none() {
            if let Some(whole) = whole {
                return Ok(self.free(whole));
            }
        }
        let written = whole.map(|w| self.g.base_exponent(w).0);
        let root = self.root(base, order, written)?;
        self.pow(&root, numerator)
    }

    /// The root of order q of a non-zero form: `(n/d)^(1/q) = (n d^(q-1))^(1/q) / d`, with `|d|` for even q.
    fn root(
        &mut self,
        base: &RationalFunction,
        q: u16,
        written: Option<Expr>,
    ) -> Result<RationalFunction, Stop> {
        let (n, d) = (base.numerator().clone(), base.denominator().clone());
        let power = d.pow(u32::from(q) - 1, &self.meter)?;
        let radicand = self.reduce(n.mul(&power, &self.meter)?)?;
        let top = self.root_of_polynomial(&radicand, q, written.filter(|_| d.is_one()))?;
        let bottom = if q.is_multiple_of(2) {
            self.absolute_of_polynomial(&d)?
        } else {
            d.into()
        };
        self.div(&top, &bottom)
    }

    fn root_of_polynomial(
        &mut self,
        p: &Polynomial,
        q: u16,
        written: Option<Expr>,
    ) -> Result<RationalFunction, Stop> {
        if !self.options.split_roots {
            let content = p.integer_content();
            let kernel = p.divide_by_integer(&IBig::from(content.clone()));
            let number = self.root_of_natural(&content, q)?;
            let root = self.radical(&kernel, q, written.filter(|_| content.is_one()))?;
            return self.mul(&number, &root);
        }
        let p = self.best_radicand(p, q)?;
        let factorization = p.factorize(&self.meter)?;
        let (sign, magnitude) = factorization.content.into_parts();
        let mut outside = self.root_of_natural(&magnitude, q)?;
        let mut inside: Vec<(Polynomial, u32)> = Vec::new();
        for (factor, exponent) in factorization.factors {
            let (whole, rest) = (exponent / u32::from(q), exponent % u32::from(q));
            if whole > 0 {
                let bare = if q.is_multiple_of(2) {
                    self.absolute_of_polynomial(&factor)?
                } else {
                    factor.clone().into()
                };
                outside = self.mul(&outside, &self.pow(&bare, i64::from(whole))?)?;
            }
            if rest > 0 {
                inside.push((factor, rest));
            }
        }
        let common = inside.iter().fold(u32::from(q), |h, (_, e)| h.gcd(*e)) as u16;
        let common = if sign == Sign::Negative || inside.is_empty() {
            1
        } else {
            common
        };
        let mut kernel = Polynomial::constant(if sign == Sign::Negative { -1 } else { 1 });
        for (factor, exponent) in &inside {
            kernel = kernel.mul(
                &factor.pow(exponent / u32::from(common), &self.meter)?,
                &self.meter,
            )?;
        }
        let kernel = self.reduce(kernel)?;
        if kernel.is_one() {
            return Ok(outside);
        }
        let root = if common == 1 {
            self.radical(&kernel, q, None)?
        } else {
            // (K^h)^(1/q) = |K|^(h/q) for even h; the order falls, so this ends.
            let bare = if common.is_multiple_of(2) {
                self.absolute_of_polynomial(&kernel)?
            } else {
                kernel.into()
            };
            if q == common {
                bare
            } else {
                self.root(&bare, q / common, None)?
            }
        };
        self.mul(&outside, &root)
    }

    /// The radicand written with sines or with cosines, whichever leaves less under the root.
    fn best_radicand(&self, p: &Polynomial, q: u16) -> Result<Polynomial, Stop> {
        let mut best = p.clone();
        let mut size = self.kernel_degree(&best, q)?;
        for pair in self.pythagoras() {
            if size == 0 || best.degree_in(pair.cosine) < 2 {
                continue;
            }
            let other = self.by_sine(&best, &pair)?;
            let other_size = self.kernel_degree(&other, q)?;
            if other_size < size {
                (best, size) = (other, other_size);
            }
        }
        Ok(best)
    }

    fn kernel_degree(&self, p: &Polynomial, q: u16) -> Result<u32, Stop> {
        let factors = p.factorize(&self.meter)?.factors;
        Ok(factors
            .iter()
            .map(|(f, e)| f.degree() * (e % u32::from(q)))
            .sum())
    }

    /// The root of a square-free (up to powers below q), primitive polynomial; `written` is how the user wrote it.
    fn radical(
        &mut self,
        kernel: &Polynomial,
        q: u16,
        written: Option<Expr>,
    ) -> Result<RationalFunction, Stop> {
        if kernel.is_one() {
            return Ok(RationalFunction::one());
        }
        if let Some(i) = self.radicals.iter().position(|r| r.radicand == *kernel) {
            let order = self.radicals[i].order;
            if !order.is_multiple_of(q) {
                if self.hints.radicals.len() <= i {
                    self.hints.radicals.resize(i + 1, 1);
                }
                let wanted = order / order.gcd(q) * q;
                if wanted > LARGEST_ORDER {
                    let limit = u32::from(LARGEST_ORDER);
                    return Err(super::super::budget::TooLarge::Degree { limit }.into());
                }
                self.hints.radicals[i] = wanted;
                return Err(Stop::Refine);
            }
            let generator = self.generator(self.radicals[i].generator);
            return self.pow(&generator, i64::from(order / q));
        }
        if q.is_multiple_of(2) {
            // Where the expression is defined over the reals, the radicand is not negative.
            self.nonnegative.push(kernel.clone());
        }
        if q == 2 && self.options.split_roots {
            if let Some(root) = self.dependent_root(kernel)? {
                return Ok(root);
            }
        }
        let hint = self
            .hints
            .radicals
            .get(self.radicals.len())
            .copied()
            .unwrap_or(1);
        let order = hint / hint.gcd(q) * q;
        let exponent = Rational::from_parts(IBig::ONE, UBig::from(order));
        let radicand = match written.filter(|_| !self.options.split_roots) {
            Some(written) => written,
            None => self.polynomial_expression(kernel),
        };
        let expr = self.g.pow(radicand, self.g.number(exponent));
        let generator = self.add_generator(expr, Kind::Radical { order });
        self.relate(generator, order, kernel.clone());
        self.radicals.push(Radical {
            radicand: kernel.clone(),
            order,
            generator,
        });
        self.pow(&self.generator(generator), i64::from(order / q))
    }

    /// The root of `kernel` through existing roots, when the product of the radicands is a square.
    fn dependent_root(&mut self, kernel: &Polynomial) -> Result<Option<RationalFunction>, Stop> {
        let others: Vec<Radical> = self
            .radicals
            .iter()
            .filter(|r| r.order.is_multiple_of(2) && !r.radicand.is_constant())
            .cloned()
            .collect();
        let mut kernels: Vec<Polynomial> = others.iter().map(|r| r.radicand.clone()).collect();
        kernels.push(kernel.clone());
        let Some(subset) = self.square_relation(&kernels)? else {
            return Ok(None);
        };
        let mut product = kernel.clone();
        let (mut roots, mut radicands) = (RationalFunction::one(), Polynomial::one());
        for i in subset {
            product = product.mul(&others[i].radicand, &self.meter)?;
            radicands = radicands.mul(&others[i].radicand, &self.meter)?;
            let root = self.pow(
                &self.generator(others[i].generator),
                i64::from(others[i].order / 2),
            )?;
            roots = self.mul(&roots, &root)?;
        }
        let Some(square_root) = product.square_root(&self.meter)? else {
            return Ok(None);
        };
        let bare = self.absolute_of_polynomial(&square_root)?;
        let top = self.mul(&bare, &roots)?;
        Ok(Some(self.div(&top, &radicands.into())?))
    }

    /// Indices of the kernels before the last whose product with the last is a square; they are square-free.
    fn square_relation(&self, kernels: &[Polynomial]) -> Result<Option<Vec<usize>>, Stop> {
        let mut base: Vec<Polynomial> = Vec::new();
        for kernel in kernels {
            let mut rest = kernel.primitive_part();
            let mut refined = Vec::new();
            for b in base {
                let common = b.gcd(&rest, &self.meter)?;
                if common.is_constant() {
                    refined.push(b);
                    continue;
                }
                rest = rest.exact_quotient(&common, &self.meter)?.unwrap_or(rest);
                let left = b.exact_quotient(&common, &self.meter)?.unwrap_or(b);
                refined.push(common);
                if !left.is_constant() {
                    refined.push(left);
                }
            }
            if !rest.is_constant() {
                refined.push(rest);
            }
            base = refined;
        }
        if base.len() > 120 || kernels.len() > 120 {
            return Ok(None);
        }
        // Rows over GF(2): which base elements divide, with the sign as one more; and the kernels combined so far.
        let mut rows: Vec<(u128, u128)> = Vec::new();
        for (i, kernel) in kernels.iter().enumerate() {
            let mut bits = u128::from(kernel.is_negative());
            for (j, b) in base.iter().enumerate() {
                if kernel.exact_quotient(b, &self.meter)?.is_some() {
                    bits |= 1 << (j + 1);
                }
            }
            let mut row = (bits, 1u128 << i);
            for other in &rows {
                if row.0 & lowest_bit(other.0) != 0 {
                    row = (row.0 ^ other.0, row.1 ^ other.1);
                }
            }
            if row.0 != 0 {
                rows.push(row);
            } else if i + 1 == kernels.len() {
                return Ok(Some((0..i).filter(|k| row.1 >> k & 1 == 1).collect()));
            }
        }
        Ok(None)
    }

    /// The root of a positive integer by roots of its primes.
    fn root_of_natural(&mut self, value: &UBig, q: u16) -> Result<RationalFunction, Stop> {
        let (primes, cofactor) = rational::small_factors(value);
        let mut parts: Vec<(UBig, u32)> = primes
            .into_iter()
            .map(|(p, e)| (UBig::from(p), e))
            .collect();
        if !cofactor.is_one() {
            let cofactor = Rational::from_parts(IBig::from(cofactor), UBig::ONE);
            match rational::exact_root(&cofactor, u32::from(q)) {
                Some(root) => parts.push((root.numerator().clone().into_parts().1, u32::from(q))),
                None => parts.push((cofactor.into_parts().0.into_parts().1, 1)),
            }
        }
        let mut result = RationalFunction::one();
        for (base, exponent) in parts {
            let common = exponent.gcd(u32::from(q)) as u16;
            let (exponent, order) = (exponent / u32::from(common), q / common);
            let base = Polynomial::constant(IBig::from(base));
            let root = if order == 1 {
                base.into()
            } else {
                self.radical(&base, order, None)?
            };
            result = self.mul(&result, &self.pow(&root, i64::from(exponent))?)?;
        }
        Ok(result)
    }

    /// `|n/d| = |n| / |d|`.
    pub(super) fn absolute(&mut self, f: &RationalFunction) -> Result<RationalFunction, Stop> {
        let top = self.absolute_of_polynomial(f.numerator())?;
        let bottom = self.absolute_of_polynomial(f.denominator())?;
        self.div(&top, &bottom)
    }

    fn absolute_of_polynomial(&mut self, p: &Polynomial) -> Result<RationalFunction, Stop> {
        if p.is_zero() || self.is_nonnegative(p) {
            return Ok(p.clone().into());
        }
        if self.is_nonnegative(&p.neg()) {
            return Ok(p.neg().into());
        }
        let (content, factors) = if self.options.split_roots {
            let factorization = p.factorize(&self.meter)?;
            (factorization.content.into_parts().1, factorization.factors)
        } else {
            (p.integer_content(), vec![(p.primitive_part(), 1)])
        };
        let mut result: RationalFunction = Polynomial::constant(IBig::from(content)).into();
        for (factor, multiplicity) in factors {
            let bare: RationalFunction = factor.clone().into();
            let even = self.pow(&bare, i64::from(multiplicity / 2 * 2))?;
            result = self.mul(&result, &even)?;
            if multiplicity % 2 == 1 {
                let once = self.absolute_generator(&factor)?;
                result = self.mul(&result, &once)?;
            }
        }
        Ok(result)
    }

    fn absolute_generator(&mut self, factor: &Polynomial) -> Result<RationalFunction, Stop> {
        if self.is_nonnegative(factor) {
            return Ok(factor.clone().into());
        }
        if self.is_nonnegative(&factor.neg()) {
            return Ok(factor.neg().into());
        }
        if let Some((_, generator)) = self.absolutes.iter().find(|(p, _)| p == factor) {
            return Ok(self.generator(*generator));
        }
        let square = self.reduce(factor.mul(factor, &self.meter)?)?;
        let expr = self.g.abs(self.polynomial_expression(factor));
        let generator = self.add_generator(expr, Kind::Absolute);
        self.relate(generator, 2, square);
        self.absolutes.push((factor.clone(), generator));
        Ok(self.generator(generator))
    }

    /// The form of a product of rational powers of numbers, such as `√3/2`.
    pub(super) fn algebraic_number(&mut self, e: Expr) -> Result<RationalFunction, Stop> {
        let g = self.g;
        match g.node(e) {
            Node::Number(value) => Ok(RationalFunction::constant(value)),
            Node::Product {
                coefficient,
                factors,
            } => {
                let mut result = RationalFunction::constant(coefficient);
                for &factor in factors.iter() {
                    let (base, exponent) = g.base_exponent(factor);
                    let part = match (g.as_number(base), g.as_number(exponent)) {
                        (Some(b), Some(n)) => {
                            self.rational_power(&RationalFunction::constant(b), n, Some(factor))?
                        }
                        _ => self.free(factor),
                    };
                    result = self.mul(&result, &part)?;
                }
                Ok(result)
            }
            Node::Power { base, exponent } => match (g.as_number(*base), g.as_number(*exponent)) {
                (Some(b), Some(n)) => {
                    self.rational_power(&RationalFunction::constant(b), n, Some(e))
                }
                _ => Ok(self.free(e)),
            },
            _ => Ok(self.free(e)),
        }
    }

    /// The generator of an algebraic integer, with its equation.
    pub(super) fn algebraic(&mut self, e: Expr, own: &AlgebraicInteger) -> RationalFunction {
        if let Some(generator) = self.generator_of(e) {
            return self.generator(generator);
        }
        let generator = self.add_generator(e, Kind::Algebraic);
        let mut list = own.polynomial();
        list.truncate(own.degree());
        let terms = list.into_iter().enumerate();
        let terms = terms.map(|(n, c)| (Monomial::power(generator, n as u16), -c));
        let value = Polynomial::from_terms(terms.collect());
        self.relate(generator, own.degree() as u16, value);
        self.generator(generator)
    }

    /// A free generator for an expression.
    pub(super) fn free(&mut self, e: Expr) -> RationalFunction {
        let generator = match self.generator_of(e) {
            Some(generator) => generator,
            None => self.add_generator(e, Kind::Free),
        };
        self.generator(generator)
    }
}

fn lowest_bit(bits: u128) -> u128 {
    bits & bits.wrapping_neg()
}
