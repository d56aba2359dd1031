//! Sums and products arranged as short as a few natural moves make them.

use std::cell::{Cell, RefCell};
use std::cmp::Reverse;

use dashu_int::IBig;
use rustc_hash::FxHashMap;

use super::contract::Angles;
use super::direction::{by_tangent, fractions, shortened};
use super::measure::Lengths;
use super::Written;
use crate::polynomial::normal_form::Field;
use crate::polynomial::{Monomial, Polynomial, RationalFunction};
use crate::rational::Rational;
use crate::{Expr, Function, Graph};

/// Sums with more terms than this are only factored, not regrouped.
const MOST_TERMS: usize = 48;
/// How many generators are tried as a common factor of part of a sum, by depth of nesting from the inside out.
const TRIALS: [usize; 3] = [2, 3, 6];
/// Polynomials with more terms than this are searched for no factors but generators and numbers.
const MOST_FACTORED: usize = 200;
/// How many parts of one polynomial are factored before the rest is written as it is.
const MOST_FACTORIZATIONS: u32 = 150;
/// How many terms one arranger regroups before sums stay as they are: what needs more is no formula for a reader.
const MOST_REGROUPED: usize = 1_500;
/// The place of the depth of what is not nested at all.
const EXPANDED: usize = usize::MAX;
/// How many arrangements of a numerator or denominator are tried against each other.
const MOST_CANDIDATES: usize = 3;

/// Arranges elements of one field.
pub(super) struct Arranger<'a, 'g> {
    field: &'a Field<'g>,
    g: &'g Graph,
    written: Written,
    lengths: RefCell<Lengths>,
    /// What polynomials were arranged as at a depth of nesting, or at [`EXPANDED`].
    known: RefCell<FxHashMap<(Polynomial, usize), Expr>>,
    monomials: RefCell<FxHashMap<Monomial, Expr>>,
    factorizations: Cell<u32>,
    regrouped: Cell<usize>,
    contracts: bool,
    /// Expressions of the generators, with tangents and functions of sums of angles appended where they are in use.
    angles: RefCell<Angles>,
}

impl<'a, 'g> Arranger<'a, 'g> {
    /// Without addition theorems.
    pub(super) fn new(field: &'a Field<'g>, written: Written) -> Arranger<'a, 'g> {
        let generators = field.generators().iter().map(|g| g.expr).collect();
        Arranger::with_generators(field, written, generators)
    }

    /// With sums of products of sines and cosines of two angles written as functions of their sum or difference.
    pub(super) fn contracting(field: &'a Field<'g>, written: Written) -> Arranger<'a, 'g> {
        Arranger {
            contracts: true,
            ..Arranger::new(field, written)
        }
    }

    fn with_generators(
        field: &'a Field<'g>,
        written: Written,
        generators: Vec<Expr>,
    ) -> Arranger<'a, 'g> {
        Arranger {
            field,
            g: field.graph(),
            written,
            lengths: RefCell::new(Lengths::written()),
            known: RefCell::default(),
            monomials: RefCell::default(),
            factorizations: Cell::new(0),
            regrouped: Cell::new(0),
            contracts: false,
            angles: RefCell::new(Angles::new(field, generators)),
        }
    }

    fn length(&self, e: Expr) -> u64 {
        self.lengths.borrow_mut().of(self.g, e)
    }

    fn shortest(&self, candidates: impl IntoIterator<Item = Expr>) -> Option<Expr> {
        candidates.into_iter().min_by_key(|&e| self.length(e))
    }

    /// The shortest arrangement of a fraction.
    pub(super) fn fraction(&self, f: &RationalFunction) -> Option<Expr> {
        self.fraction_times(f, self.g.one())
    }

    /// The shortest arrangement of a fraction times a factor that stays outside.
    pub(super) fn fraction_times(&self, f: &RationalFunction, factor: Expr) -> Option<Expr> {
        let fractions = fractions(self.field, f);
        let mut candidates: Vec<Expr> = fractions
            .iter()
            .filter_map(|f| self.quotient(f, factor))
            .collect();
        candidates.extend(
            fractions
                .iter()
                .filter_map(|f| self.term_by_term(f, factor)),
        );
        if self.written.tangent || self.written.secant {
            candidates.extend(
                fractions
                    .iter()
                    .filter_map(|f| self.with_tangents(f, factor)),
            );
        }
        self.shortest(candidates)
    }

    fn quotient(&self, f: &RationalFunction, factor: Expr) -> Option<Expr> {
        let bottoms = self.candidates(f.denominator());
        let tops = self.candidates(f.numerator());
        let pairs = tops
            .iter()
            .flat_map(|&top| bottoms.iter().map(move |&bottom| (top, bottom)));
        let quotients = pairs.map(|(top, bottom)| self.g.div(self.g.mul(&[top, factor]), bottom));
        // Of two equally long forms the one with a common factor outside has fewer nodes.
        quotients.min_by_key(|&e| (self.length(e), self.g.tree_size(e)))
    }

    /// A sum of fractions with different denominators, where the common one has powers of generators that not every
    /// term needs.
    fn term_by_term(&self, f: &RationalFunction, factor: Expr) -> Option<Expr> {
        let (n, d) = (f.numerator(), f.denominator());
        let below = d.monomial_content();
        if below.is_one() || n.len() < 2 || n.len() > MOST_TERMS || !self.g.is_one(factor) {
            return None;
        }
        let rest = d.quotient_by_monomial(&below)?;
        let mut groups: Vec<(Monomial, Vec<_>)> = Vec::new();
        for (monomial, coefficient) in n.terms() {
            let needed = below.quotient(&monomial.gcd(&below))?;
            match groups.iter_mut().find(|(m, _)| *m == needed) {
                Some((_, terms)) => terms.push((monomial.clone(), coefficient.clone())),
                None => groups.push((needed, vec![(monomial.clone(), coefficient.clone())])),
            }
        }
        if groups.len() < 2 {
            return None;
        }
        let meter = self.field.meter();
        let mut parts = Vec::new();
        for (_, terms) in groups {
            let whole = rest
                .mul(&Polynomial::term(below.clone(), 1.into()), meter)
                .ok()?;
            let part =
                RationalFunction::new(Polynomial::from_terms(terms), whole, meter).ok()??;
            parts.push(self.quotient(&part, factor)?);
        }
        Some(self.g.add(&parts))
    }

    /// With `sin = tan cos` for every circular pair, and secants for reciprocal cosines where the user wrote them.
    fn with_tangents(&self, f: &RationalFunction, factor: Expr) -> Option<Expr> {
        let mut current = f.clone();
        let mut generators = self.angles.borrow().expressions().to_vec();
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
            contracts: self.contracts,
            ..Arranger::with_generators(self.field, Written::default(), generators)
        };
        let plain = inner.quotient(&current, factor)?;
        if !self.written.secant {
            return Some(plain);
        }
        // A power of the cosine below becomes a power of the secant above.
        let mut denominator = current.denominator().clone();
        let mut above = vec![factor];
        for (cosine, angle) in secants {
            let power = denominator.monomial_content().exponent(cosine);
            if power > 0 {
                denominator = denominator.quotient_by_monomial(&Monomial::power(cosine, power))?;
                let secant = self.g.apply(Function::Sec, &[angle]);
                above.push(self.g.powi(secant, i64::from(power)));
            }
        }
        let rest =
            RationalFunction::new(current.numerator().clone(), denominator, self.field.meter())
                .ok()??;
        let with_secants = inner.quotient(&rest, self.g.mul(&above))?;
        self.shortest([plain, with_secants])
    }

    /// The shortest few arrangements of a polynomial: which of them is best may depend on what stands beside it.
    fn candidates(&self, p: &Polynomial) -> Vec<Expr> {
        self.factorizations.set(0);
        let depth = TRIALS.len();
        if p.len() > MOST_FACTORED {
            // Nothing but generators and numbers comes out of it: other ways of writing squares only change the terms.
            return vec![self.factored(&shortened(self.field, p), depth)];
        }
        let mut candidates = vec![self.factored(p, depth)];
        if p.len() > 1 {
            let short = shortened(self.field, p);
            candidates.push(self.factored(&short, depth));
            for pair in self
                .field
                .pythagoras()
                .iter()
                .filter(|pair| p.degree_in(pair.cosine) >= 2)
            {
                if let Ok(other) = self.field.by_sine(p, pair) {
                    candidates.push(self.factored(&other, depth));
                }
            }
            candidates.push(self.expanded(&short));
        }
        candidates.sort_by_key(|&e| self.length(e));
        candidates.dedup();
        candidates.truncate(MOST_CANDIDATES);
        candidates
    }

    /// The shortest arrangement found for part of a polynomial.
    fn part(&self, p: &Polynomial, depth: usize) -> Expr {
        let short = shortened(self.field, p);
        let factored = self.factored(&short, depth);
        let plain = self.expanded(&short);
        self.shortest([factored, plain]).unwrap_or(plain)
    }

    fn factored(&self, p: &Polynomial, depth: usize) -> Expr {
        if p.len() <= 1 {
            return self.expanded(p);
        }
        if let Some(&known) = self.known.borrow().get(&(p.clone(), depth)) {
            return known;
        }
        if let Some(contracted) = self.contracted(p) {
            let result = self.factored(&contracted, depth);
            self.known.borrow_mut().insert((p.clone(), depth), result);
            return result;
        }
        if p.len() > MOST_FACTORED || is_linear_somewhere(p) {
            let result = self.without_monomial(p, depth);
            self.known.borrow_mut().insert((p.clone(), depth), result);
            return result;
        }
        let count = self.factorizations.get();
        self.factorizations.set(count + 1);
        let affordable = count < MOST_FACTORIZATIONS || depth == TRIALS.len();
        let factorization = if affordable {
            p.factorize(self.field.meter()).ok()
        } else {
            None
        };
        let result = match factorization {
            None => self.expanded(p),
            Some(factorization) => {
                let factor = |(f, multiplicity): &(Polynomial, u32)| {
                    self.g.powi(self.sum(f, depth), i64::from(*multiplicity))
                };
                let factors: Vec<Expr> = factorization.factors.iter().map(factor).collect();
                let content = Rational::from(factorization.content);
                self.g.scale(&content, self.g.mul(&factors))
            }
        };
        self.known.borrow_mut().insert((p.clone(), depth), result);
        result
    }

    /// The polynomial with its factors that are generators or numbers outside.
    fn without_monomial(&self, p: &Polynomial, depth: usize) -> Expr {
        let common = p.monomial_content();
        let content = IBig::from(p.integer_content());
        let content = if p.is_negative() { -content } else { content };
        let terms = p
            .terms()
            .iter()
            .filter_map(|(m, c)| Some((m.quotient(&common)?, c / &content)));
        let rest = Polynomial::from_terms(terms.collect());
        let product = self
            .g
            .mul(&[self.monomial(&common), self.sum(&rest, depth)]);
        self.g.scale(&Rational::from(content), product)
    }

    fn contracted(&self, p: &Polynomial) -> Option<Polynomial> {
        self.contracts
            .then(|| self.angles.borrow_mut().contracted(self.g, p))
            .flatten()
    }

    /// A sum without common factor: terms that share a generator are put together where this is shorter.
    fn sum(&self, p: &Polynomial, depth: usize) -> Expr {
        let plain = self.expanded(p);
        if p.len() <= 2 || depth == 0 || p.len() > MOST_TERMS {
            return plain;
        }
        let regrouped = self.regrouped.get() + p.len();
        self.regrouped.set(regrouped);
        if regrouped > MOST_REGROUPED {
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
            .filter(|&(count, _)| count >= 2 && count < p.len())
            .collect();
        // Among equally short arrangements the one with velocities outside is what a person writes.
        let order = |g: usize| {
            self.g
                .as_symbol(self.expression(g))
                .map_or(0, |s| self.g.symbol_order(s))
        };
        shared.sort_by_key(|&(count, g)| (Reverse(count), Reverse(order(g)), g));
        shared.truncate(TRIALS[depth - 1]);
        let mut candidates = vec![plain];
        for (_, generator) in shared {
            let (with, without): (Vec<_>, Vec<_>) = p
                .terms()
                .iter()
                .cloned()
                .partition(|(m, _)| m.exponent(generator) > 0);
            let with = self.factored(&Polynomial::from_terms(with), depth - 1);
            let without = self.part(&Polynomial::from_terms(without), depth - 1);
            candidates.push(self.g.add(&[with, without]));
        }
        self.shortest(candidates).unwrap_or(plain)
    }

    fn expression(&self, generator: usize) -> Expr {
        self.angles.borrow().expression(generator)
    }

    fn expanded(&self, p: &Polynomial) -> Expr {
        if let Some(&known) = self.known.borrow().get(&(p.clone(), EXPANDED)) {
            return known;
        }
        let result = match self.contracted(p) {
            Some(contracted) => self.expanded(&contracted),
            None => {
                let term = |(m, c): &(Monomial, IBig)| {
                    self.g.scale(&Rational::from(c.clone()), self.monomial(m))
                };
                let terms: Vec<Expr> = p.terms().iter().map(term).collect();
                self.g.add(&terms)
            }
        };
        self.known
            .borrow_mut()
            .insert((p.clone(), EXPANDED), result);
        result
    }

    fn monomial(&self, m: &Monomial) -> Expr {
        if let Some(&known) = self.monomials.borrow().get(m) {
            return known;
        }
        let powers: Vec<Expr> = m
            .iter()
            .map(|(g, e)| self.g.powi(self.expression(g), i64::from(e)))
            .collect();
        let result = self.g.mul(&powers);
        self.monomials.borrow_mut().insert(m.clone(), result);
        result
    }
}

/// Whether some generator occurs in one term only, and there to the first power: `m x + R`, where R is free of x, has no
/// factors but those of m, which are generators.
fn is_linear_somewhere(p: &Polynomial) -> bool {
    let mut uses: Vec<(u32, u16)> = Vec::new();
    for (monomial, _) in p.terms() {
        for (generator, exponent) in monomial.iter() {
            if uses.len() <= generator {
                uses.resize(generator + 1, (0, 0));
            }
            let (count, power) = &mut uses[generator];
            *count += 1;
            *power = (*power).max(exponent);
        }
    }
    uses.contains(&(1, 1))
}
