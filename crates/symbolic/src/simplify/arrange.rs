//! Sums and products arranged as short as a few natural moves make them.

use std::cell::RefCell;
use std::cmp::Reverse;

use rustc_hash::FxHashMap;

use super::direction::{by_tangent, fractions, shortened};
use super::measure::length;
use super::Written;
use crate::polynomial::normal_form::Field;
use crate::polynomial::{Monomial, Polynomial, RationalFunction};
use crate::rational::Rational;
use crate::{Expr, Function, Graph};

/// Sums with more terms than this are only factored, not regrouped.
const MOST_TERMS: usize = 48;
/// How many generators are tried as a common factor of part of a sum.
const MOST_TRIALS: usize = 8;
/// How deep regrouping nests.
const DEPTH: u32 = 3;

/// Arranges elements of one field.
pub(super) struct Arranger<'a, 'g> {
    field: &'a Field<'g>,
    g: &'g Graph,
    written: Written,
    lengths: RefCell<FxHashMap<Expr, u64>>,
    /// Expressions of the generators, with tangents appended where they are in use.
    generators: Vec<Expr>,
}

impl<'a, 'g> Arranger<'a, 'g> {
    pub(super) fn new(field: &'a Field<'g>, written: Written) -> Arranger<'a, 'g> {
        let generators = field.generators().iter().map(|g| g.expr).collect();
        Arranger {
            field,
            g: field.graph(),
            written,
            lengths: RefCell::default(),
            generators,
        }
    }

    fn length(&self, e: Expr) -> u64 {
        if let Some(&known) = self.lengths.borrow().get(&e) {
            return known;
        }
        let value = length(self.g, e);
        self.lengths.borrow_mut().insert(e, value);
        value
    }

    fn shortest(&self, candidates: impl IntoIterator<Item = Expr>) -> Option<Expr> {
        candidates.into_iter().min_by_key(|&e| self.length(e))
    }

    /// The shortest arrangement of a fraction.
    pub(super) fn fraction(&self, f: &RationalFunction) -> Option<Expr> {
        let fractions = fractions(self.field, f);
        let mut candidates: Vec<Expr> = fractions.iter().map(|f| self.quotient(f)).collect();
        if self.written.tangent || self.written.secant {
            candidates.extend(fractions.iter().filter_map(|f| self.with_tangents(f)));
        }
        self.shortest(candidates)
    }

    fn quotient(&self, f: &RationalFunction) -> Expr {
        let (n, d) = (f.numerator(), f.denominator());
        let top = self.polynomial(n, DEPTH);
        if d.is_one() {
            return top;
        }
        self.g.div(top, self.polynomial(d, DEPTH))
    }

    /// With `sin = tan cos` for every circular pair, and secants for reciprocal cosines where the user wrote them.
    fn with_tangents(&self, f: &RationalFunction) -> Option<Expr> {
        let mut current = f.clone();
        let mut generators = self.generators.clone();
        let mut secants = Vec::new();
        for pair in self
            .field
            .pythagoras()
            .into_iter()
            .filter(|pair| pair.circular)
        {
            let angle = self.field.argument_of(pair.cosine)?;
            let used = |p: &Polynomial| p.degree_in(pair.sine) + p.degree_in(pair.cosine) > 0;
            if !used(current.numerator()) && !used(current.denominator()) {
                continue;
            }
            let tangent = generators.len();
            generators.push(self.g.apply(Function::Tan, &[angle]));
            current = by_tangent(self.field, &current, &pair, tangent)?;
            secants.push((pair.cosine, angle));
        }
        let inner = Arranger {
            field: self.field,
            g: self.g,
            written: Written::default(),
            lengths: RefCell::default(),
            generators,
        };
        let plain = inner.quotient(&current);
        if !self.written.secant {
            return Some(plain);
        }
        // A power of the cosine below becomes a power of the secant above.
        let mut denominator = current.denominator().clone();
        let mut above = Vec::new();
        for (cosine, angle) in secants {
            let power = denominator.monomial_content().exponent(cosine);
            if power > 0 {
                denominator = denominator.quotient_by_monomial(&Monomial::power(cosine, power))?;
                let secant = self.g.apply(Function::Sec, &[angle]);
                above.push(self.g.powi(secant, i64::from(power)));
            }
        }
        above.push(inner.polynomial(current.numerator(), DEPTH));
        let with_secants = self
            .g
            .div(self.g.mul(&above), inner.polynomial(&denominator, DEPTH));
        self.shortest([plain, with_secants])
    }

    /// The shortest arrangement found for a polynomial.
    pub(super) fn polynomial(&self, p: &Polynomial, depth: u32) -> Expr {
        if p.len() <= 1 {
            return self.expanded(p);
        }
        let mut candidates = vec![self.factored(p, depth)];
        let short = shortened(self.field, p);
        if short != *p {
            candidates.push(self.factored(&short, depth));
        }
        for pair in self.field.pythagoras() {
            if p.degree_in(pair.cosine) >= 2 {
                if let Ok(other) = self.field.by_sine(p, &pair) {
                    candidates.push(self.factored(&other, depth));
                }
            }
        }
        candidates.push(self.expanded(&short));
        self.shortest(candidates)
            .unwrap_or_else(|| self.expanded(p))
    }

    fn factored(&self, p: &Polynomial, depth: u32) -> Expr {
        let Ok(factorization) = p.factorize(self.field.meter()) else {
            return self.expanded(p);
        };
        let factor = |(f, multiplicity): &(Polynomial, u32)| {
            self.g.powi(self.sum(f, depth), i64::from(*multiplicity))
        };
        let factors: Vec<Expr> = factorization.factors.iter().map(factor).collect();
        let content = Rational::from(factorization.content);
        self.g.scale(&content, self.g.mul(&factors))
    }

    /// A sum without common factor: terms that share a generator are put together where this is shorter.
    fn sum(&self, p: &Polynomial, depth: u32) -> Expr {
        let plain = self.expanded(p);
        if p.len() <= 2 || depth == 0 || p.len() > MOST_TERMS {
            return plain;
        }
        let mut shared: Vec<(usize, usize)> = p
            .generators()
            .into_iter()
            .map(|g| {
                (
                    p.terms().iter().filter(|(m, _)| m.exponent(g) > 0).count(),
                    g,
                )
            })
            .filter(|&(count, _)| count >= 2)
            .collect();
        // Among equally short arrangements the one with velocities outside is what a person writes.
        let order = |g: usize| {
            self.g
                .as_symbol(self.generators[g])
                .map_or(0, |s| self.g.symbol_order(s))
        };
        shared.sort_by_key(|&(count, g)| (Reverse(count), Reverse(order(g)), g));
        shared.truncate(MOST_TRIALS);
        let mut candidates = vec![plain];
        for (_, generator) in shared {
            let (with, without): (Vec<_>, Vec<_>) = p
                .terms()
                .iter()
                .cloned()
                .partition(|(m, _)| m.exponent(generator) > 0);
            let with = self.factored(&Polynomial::from_terms(with), depth - 1);
            if without.is_empty() {
                candidates.push(with);
                continue;
            }
            let without = self.polynomial(&Polynomial::from_terms(without), depth - 1);
            candidates.push(self.g.add(&[with, without]));
        }
        self.shortest(candidates).unwrap_or(plain)
    }

    fn expanded(&self, p: &Polynomial) -> Expr {
        let terms: Vec<Expr> = p
            .terms()
            .iter()
            .map(|(m, c)| self.g.scale(&Rational::from(c.clone()), self.monomial(m)))
            .collect();
        self.g.add(&terms)
    }

    fn monomial(&self, m: &Monomial) -> Expr {
        let powers: Vec<Expr> = m
            .iter()
            .map(|(g, e)| self.g.powi(self.generators[g], i64::from(e)))
            .collect();
        self.g.mul(&powers)
    }
}
