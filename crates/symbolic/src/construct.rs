//! Canonical sums, products and powers.
//!
//! What the constructors do, and no more: flatten, merge equal terms and equal bases, fold numbers, distribute a
//! number over a sum, and normalise signs and contents of sums inside products and powers. Products of sums are
//! never expanded.

use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::rational::{self, Rational};
use dashu_base::UnsignedAbs;
use dashu_int::IBig;

impl Graph {
    /// The sum of all.
    pub fn add(&self, summands: &[Expr]) -> Expr {
        let mut constant = Rational::ZERO;
        let mut terms: Vec<(Expr, Rational)> = Vec::with_capacity(summands.len());
        for &e in summands {
            self.collect_terms(e, &Rational::ONE, &mut constant, &mut terms);
        }
        self.sum_of(constant, terms)
    }

    fn collect_terms(
        &self,
        e: Expr,
        scale: &Rational,
        constant: &mut Rational,
        terms: &mut Vec<(Expr, Rational)>,
    ) {
        match self.node(e) {
            Node::Number(value) => {
                *constant = rational::sum(constant, &rational::product(value, scale));
            }
            Node::Sum {
                constant: inner,
                terms: inner_terms,
            } => {
                *constant = rational::sum(constant, &rational::product(inner, scale));
                let scaled = |(t, c): &(Expr, Rational)| (*t, rational::product(c, scale));
                terms.extend(inner_terms.iter().map(scaled));
            }
            Node::Product {
                coefficient,
                factors,
            } if !coefficient.is_one() => {
                // The factors are in order and their bases differ.
                let bare = match factors[..] {
                    [only] => only,
                    _ => self.intern(Node::Product {
                        coefficient: Rational::ONE,
                        factors: factors.clone(),
                    }),
                };
                terms.push((bare, rational::product(coefficient, scale)));
            }
            _ => terms.push((e, scale.clone())),
        }
    }

    fn sum_of(&self, constant: Rational, mut terms: Vec<(Expr, Rational)>) -> Expr {
        terms.sort_by(|a, b| self.compare(a.0, b.0));
        let mut merged: Vec<(Expr, Rational)> = Vec::with_capacity(terms.len());
        for (term, coefficient) in terms {
            match merged.last_mut() {
                Some(last) if last.0 == term => last.1 = rational::sum(&last.1, &coefficient),
                _ => merged.push((term, coefficient)),
            }
        }
        merged.retain(|(_, coefficient)| !coefficient.is_zero());
        match (merged.len(), constant.is_zero()) {
            (0, _) => self.number(constant),
            (1, true) => {
                let (term, coefficient) = merged.swap_remove(0);
                self.scale(&coefficient, term)
            }
            _ => self.intern(Node::Sum {
                constant,
                terms: merged.into(),
            }),
        }
    }

    /// `factor · e` for a number.
    pub fn scale(&self, factor: &Rational, e: Expr) -> Expr {
        if factor.is_one() {
            return e;
        }
        if factor.is_zero() {
            return if self.is_undefined(e) { e } else { self.zero() };
        }
        match self.node(e) {
            Node::Number(value) => self.number(rational::product(value, factor)),
            Node::Sum { constant, terms } => {
                let scaled = |(t, c): &(Expr, Rational)| (*t, rational::product(c, factor));
                let terms = terms.iter().map(scaled).collect();
                self.sum_of(rational::product(constant, factor), terms)
            }
            Node::Product {
                coefficient,
                factors,
            } => self.product_of(rational::product(coefficient, factor), factors.to_vec()),
            _ => self.product_of(factor.clone(), vec![e]),
        }
    }

    /// `a - b`.
    pub fn sub(&self, a: Expr, b: Expr) -> Expr {
        self.add(&[a, self.neg(b)])
    }

    /// `-a`.
    pub fn neg(&self, a: Expr) -> Expr {
        self.scale(&Rational::NEG_ONE, a)
    }

    /// `a / b`; division by the number zero stays visible as `0^(-1)`.
    pub fn div(&self, a: Expr, b: Expr) -> Expr {
        self.mul(&[a, self.powi(b, -1)])
    }

    /// The product of all.
    pub fn mul(&self, factors: &[Expr]) -> Expr {
        match factors {
            [] => return self.one(),
            [only] => return *only,
            [a, b] => {
                if let Some(value) = self.as_number(*a) {
                    return self.scale(&value.clone(), *b);
                }
                if let Some(value) = self.as_number(*b) {
                    return self.scale(&value.clone(), *a);
                }
            }
            _ => {}
        }
        let mut coefficient = Rational::ONE;
        let mut powers: Vec<(Expr, Expr)> = Vec::with_capacity(factors.len());
        let mut exponentials: Vec<Expr> = Vec::new();
        for &factor in factors {
            self.collect_factors(factor, &mut coefficient, &mut powers, &mut exponentials);
        }
        if coefficient.is_zero() {
            let undefined = powers.iter().find(|(base, _)| self.is_zero(*base));
            return match undefined {
                Some((base, exponent)) => self.power_node(*base, *exponent),
                None => self.zero(),
            };
        }
        if !exponentials.is_empty() {
            let exponent = self.add(&exponentials);
            let exponential = self.apply(Function::Exp, &[exponent]);
            let mut merged = Vec::new();
            self.collect_factors(exponential, &mut coefficient, &mut powers, &mut merged);
            if !merged.is_empty() {
                powers.push((exponential, self.one()));
            }
        }
        self.merge_powers(coefficient, powers)
    }

    fn collect_factors(
        &self,
        e: Expr,
        coefficient: &mut Rational,
        powers: &mut Vec<(Expr, Expr)>,
        exponentials: &mut Vec<Expr>,
    ) {
        match self.node(e) {
            Node::Number(value) => *coefficient = rational::product(coefficient, value),
            Node::Product {
                coefficient: inner,
                factors,
            } => {
                *coefficient = rational::product(coefficient, inner);
                for &factor in factors.iter() {
                    self.collect_one(factor, powers, exponentials);
                }
            }
            _ => self.collect_one(e, powers, exponentials),
        }
    }

    fn collect_one(&self, e: Expr, powers: &mut Vec<(Expr, Expr)>, exponentials: &mut Vec<Expr>) {
        match self.node(e) {
            Node::Power { base, exponent } => powers.push((*base, *exponent)),
            Node::Apply {
                function: Function::Exp,
                arguments,
            } => exponentials.push(arguments[0]),
            _ => powers.push((e, self.one())),
        }
    }

    fn merge_powers(&self, mut coefficient: Rational, mut powers: Vec<(Expr, Expr)>) -> Expr {
        // A sum and its primitive part must meet as one base.
        for (base, exponent) in powers.iter_mut() {
            if self.is_one(*exponent) {
                if let Some((content, primitive)) = self.primitive_sum(*base) {
                    coefficient = rational::product(&coefficient, &content);
                    *base = primitive;
                }
            }
        }
        powers.sort_by(|a, b| self.compare(a.0, b.0));
        let mut factors = Vec::with_capacity(powers.len());
        let mut i = 0;
        let mut again = false;
        while i < powers.len() {
            let base = powers[i].0;
            let end = powers[i..].partition_point(|p| p.0 == base) + i;
            let power = if end == i + 1 {
                self.pow(base, powers[i].1)
            } else {
                let exponents: Vec<Expr> = powers[i..end].iter().map(|p| p.1).collect();
                self.pow(base, self.add(&exponents))
            };
            match self.node(power) {
                Node::Number(value) => coefficient = rational::product(&coefficient, value),
                Node::Product {
                    coefficient: inner,
                    factors: inner_factors,
                } => {
                    coefficient = rational::product(&coefficient, inner);
                    factors.extend(inner_factors.iter().copied());
                    again = true;
                }
                _ => factors.push(power),
            }
            i = end;
        }
        if coefficient.is_zero() {
            return self.zero();
        }
        if again {
            // Splitting a power may have produced a base that occurs elsewhere; merging is idempotent otherwise.
            let expanded: Vec<(Expr, Expr)> =
                factors.iter().map(|&f| self.base_exponent(f)).collect();
            let mut bases: Vec<Expr> = expanded.iter().map(|p| p.0).collect();
            bases.sort_unstable();
            if bases.windows(2).any(|pair| pair[0] == pair[1]) {
                return self.merge_powers(coefficient, expanded);
            }
        }
        self.product_of(coefficient, factors)
    }

    /// Splits `e = base ^ exponent`, with exponent 1 where `e` is no power.
    pub fn base_exponent(&self, e: Expr) -> (Expr, Expr) {
        match self.node(e) {
            Node::Power { base, exponent } => (*base, *exponent),
            _ => (e, self.one()),
        }
    }

    /// A product of factors with pairwise different bases.
    fn product_of(&self, coefficient: Rational, mut factors: Vec<Expr>) -> Expr {
        if coefficient.is_zero() {
            return self.zero();
        }
        if let [only] = factors[..] {
            if coefficient.is_one() {
                return only;
            }
            if let Node::Sum { .. } = self.node(only) {
                return self.scale(&coefficient, only);
            }
        }
        if factors.is_empty() {
            return self.number(coefficient);
        }
        factors.sort_by(|&a, &b| self.compare(a, b));
        self.intern(Node::Product {
            coefficient,
            factors: factors.into(),
        })
    }

    /// Content and primitive part of a sum, the leading coefficient of the primitive part positive;
    /// `None` when `e` is no sum or primitive already.
    pub(crate) fn primitive_sum(&self, e: Expr) -> Option<(Rational, Expr)> {
        let Node::Sum { constant, terms } = self.node(e) else {
            return None;
        };
        let mut content = None;
        let primitive = self.primitive(e, || {
            let own = self.signed_content(e, constant, terms);
            content.insert(own).is_one()
        });
        if primitive {
            return None;
        }
        let content = content.unwrap_or_else(|| self.signed_content(e, constant, terms));
        let inverse = Rational::ONE / &content;
        Some((content, self.scale(&inverse, e)))
    }

    /// The content of a sum with the sign of its leading coefficient.
    fn signed_content(&self, e: Expr, constant: &Rational, terms: &[(Expr, Rational)]) -> Rational {
        let coefficients = terms.iter().map(|(_, c)| c);
        let content = rational::content(coefficients.chain([constant]));
        match self.leads_negative(e) {
            true => -content,
            false => content,
        }
    }

    /// Whether the leading coefficient is negative; exactly one of `e` and `-e` leads negative unless `e = 0`.
    ///
    /// A person's order decides where it can: the alphabetically first bare symbol leads, then canonical order.
    pub(crate) fn leads_negative(&self, e: Expr) -> bool {
        match self.node(e) {
            Node::Number(value) => rational::is_negative(value),
            Node::Product { coefficient, .. } => rational::is_negative(coefficient),
            Node::Sum { terms, .. } => {
                let key = |term: Expr| {
                    self.as_symbol(term)
                        .map(|s| (self.symbol_name(s), self.symbol_order(s)))
                };
                let leading = terms.iter().min_by(|a, b| match (key(a.0), key(b.0)) {
                    (Some(x), Some(y)) => x.cmp(&y),
                    (Some(_), None) => std::cmp::Ordering::Less,
                    (None, Some(_)) => std::cmp::Ordering::Greater,
                    (None, None) => self.compare(a.0, b.0),
                });
                leading.is_some_and(|(_, c)| rational::is_negative(c))
            }
            _ => false,
        }
    }

    fn is_undefined(&self, e: Expr) -> bool {
        let zero_base =
            |f: Expr| matches!(self.node(f), Node::Power { base, .. } if self.is_zero(*base));
        match self.node(e) {
            Node::Product { factors, .. } => factors.iter().any(|&f| zero_base(f)),
            _ => zero_base(e),
        }
    }

    fn power_node(&self, base: Expr, exponent: Expr) -> Expr {
        self.intern(Node::Power { base, exponent })
    }

    /// `base ^ n`.
    pub fn powi(&self, base: Expr, n: i64) -> Expr {
        self.pow(base, self.integer(n))
    }

    /// The principal square root.
    pub fn sqrt(&self, e: Expr) -> Expr {
        let half = Rational::from_parts(IBig::ONE, 2u8.into());
        self.pow(e, self.number(half))
    }

    /// `base ^ exponent`. Rules used are valid wherever both sides are defined over the reals.
    pub fn pow(&self, base: Expr, exponent: Expr) -> Expr {
        let Some(n) = self.as_number(exponent) else {
            return if self.is_one(base) {
                base
            } else {
                self.power_node(base, exponent)
            };
        };
        if n.is_zero() {
            return self.one();
        }
        if n.is_one() {
            return base;
        }
        let n = n.clone();
        match self.node(base) {
            Node::Number(value) => self.pow_number(value.clone(), &n),
            Node::Power {
                base: inner,
                exponent: inner_exponent,
            } => {
                let merges = n.is_int()
                    || self
                        .as_number(*inner_exponent)
                        .is_some_and(|m| !m.is_int() && has_even_denominator(m));
                if merges {
                    let product = self.mul(&[*inner_exponent, exponent]);
                    self.pow(*inner, product)
                } else {
                    self.power_node(base, exponent)
                }
            }
            Node::Product {
                coefficient,
                factors,
            } => self.pow_product(coefficient.clone(), factors, &n, exponent),
            Node::Sum { .. } => self.pow_sum(base, &n, exponent),
            Node::Apply {
                function: Function::Exp,
                arguments,
            } => {
                let argument = self.scale(&n, arguments[0]);
                self.apply(Function::Exp, &[argument])
            }
            Node::Apply {
                function: Function::Abs,
                arguments,
            } if n.is_int() && rational::to_i64(&n).is_some_and(|k| k % 2 == 0) => {
                self.pow(arguments[0], exponent)
            }
            _ => self.power_node(base, exponent),
        }
    }

    fn pow_product(
        &self,
        coefficient: Rational,
        factors: &[Expr],
        n: &Rational,
        exponent: Expr,
    ) -> Expr {
        if n.is_int() {
            let mut powers: Vec<Expr> = factors.iter().map(|&f| self.pow(f, exponent)).collect();
            powers.push(self.pow_number(coefficient, n));
            return self.mul(&powers);
        }
        let magnitude = rational::abs(&coefficient);
        if magnitude.is_one() {
            let base = self.product_of(coefficient, factors.to_vec());
            return self.power_node(base, exponent);
        }
        let sign = if rational::is_negative(&coefficient) {
            Rational::NEG_ONE
        } else {
            Rational::ONE
        };
        let rest = self.product_of(sign, factors.to_vec());
        let number = self.pow_number(magnitude, n);
        self.mul(&[number, self.pow(rest, exponent)])
    }

    fn pow_sum(&self, base: Expr, n: &Rational, exponent: Expr) -> Expr {
        let Some((content, primitive)) = self.primitive_sum(base) else {
            return self.power_node(base, exponent);
        };
        if n.is_int() {
            let number = self.pow_number(content, n);
            return self.mul(&[number, self.power_node(primitive, exponent)]);
        }
        let magnitude = rational::abs(&content);
        if magnitude.is_one() {
            return self.power_node(base, exponent);
        }
        let inverse = Rational::ONE / &magnitude;
        let rest = self.power_node(self.scale(&inverse, base), exponent);
        self.mul(&[self.pow_number(magnitude, n), rest])
    }

    /// `value ^ n`; a radical is reduced to square-free prime radicands: `8^(1/2) = 2·2^(1/2)`.
    fn pow_number(&self, value: Rational, n: &Rational) -> Expr {
        let keep = |g: &Graph| g.power_node(g.number(value.clone()), g.number(n.clone()));
        if let Some(k) = rational::to_i64(n) {
            return match rational::powi(&value, k) {
                Some(power) => self.number(power),
                None => keep(self),
            };
        }
        if value.is_zero() {
            return if rational::is_negative(n) {
                keep(self)
            } else {
                self.zero()
            };
        }
        if value.is_one() {
            return self.one();
        }
        let (Ok(q), Ok(p)) = (u32::try_from(n.denominator()), i64::try_from(n.numerator())) else {
            return keep(self);
        };
        if rational::is_negative(&value) || q > 64 || p.unsigned_abs() > 4096 {
            return keep(self);
        }
        self.pow_radical(value, p, q)
    }

    fn pow_radical(&self, value: Rational, p: i64, q: u32) -> Expr {
        let (numerator, denominator) = value.into_parts();
        let (mut primes, top) = rational::small_factors(&numerator.unsigned_abs());
        let (below, bottom) = rational::small_factors(&denominator);
        let mut exponents: Vec<(Rational, i64)> = primes
            .drain(..)
            .map(|(b, e)| (Rational::from(b), i64::from(e)))
            .collect();
        exponents.extend(
            below
                .into_iter()
                .map(|(b, e)| (Rational::from(b), -i64::from(e))),
        );
        exponents.push((Rational::from(top), 1));
        exponents.push((Rational::from(bottom), -1));
        let mut coefficient = Rational::ONE;
        let mut factors = Vec::new();
        for (base, exponent) in exponents {
            if base.is_one() {
                continue;
            }
            let (base, exponent) = match rational::exact_root(&base, q) {
                Some(root) => (root, exponent * i64::from(q)),
                None => (base, exponent),
            };
            let total = exponent * p;
            let whole = total.div_euclid(i64::from(q));
            let rest = total.rem_euclid(i64::from(q));
            if let Some(power) = rational::powi(&base, whole) {
                coefficient *= power;
            }
            if rest != 0 {
                let exponent = Rational::from_parts(IBig::from(rest), q.into());
                factors.push(self.power_node(self.number(base), self.number(exponent)));
            }
        }
        self.product_of(coefficient, factors)
    }
}

fn has_even_denominator(r: &Rational) -> bool {
    (r.denominator() % 2u8) == 0u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn xyz(g: &Graph) -> (Expr, Expr, Expr) {
        (g.symbol("x", 0), g.symbol("y", 0), g.symbol("z", 0))
    }

    #[test]
    fn sums_merge_and_cancel() {
        let g = Graph::new();
        let (x, y, _) = xyz(&g);
        assert_eq!(g.add(&[x, y, x]), g.add(&[y, g.mul(&[g.integer(2), x])]));
        assert_eq!(g.sub(g.add(&[x, y]), g.add(&[y, x])), g.zero());
        assert_eq!(g.scale(&integer(2), g.add(&[x, y])), g.add(&[x, x, y, y]));
    }

    fn integer(n: i64) -> Rational {
        crate::rational::integer(n)
    }

    #[test]
    fn products_merge_powers() {
        let g = Graph::new();
        let (x, y, _) = xyz(&g);
        assert_eq!(g.mul(&[x, g.powi(x, -1)]), g.one());
        assert_eq!(g.mul(&[g.sqrt(x), g.sqrt(x)]), x);
        assert_eq!(g.mul(&[x, y, x]), g.mul(&[g.powi(x, 2), y]));
        let difference = g.sub(x, y);
        let opposite = g.sub(y, x);
        assert_eq!(g.div(difference, opposite), g.integer(-1));
        assert_eq!(g.powi(opposite, 2), g.powi(difference, 2));
    }

    #[test]
    fn radicals_of_numbers_are_reduced() {
        let g = Graph::new();
        let two = g.integer(2);
        assert_eq!(g.sqrt(g.integer(8)), g.mul(&[two, g.sqrt(two)]));
        assert_eq!(g.mul(&[g.sqrt(two), g.sqrt(two)]), two);
        assert_eq!(
            g.sqrt(g.integer(6)),
            g.mul(&[g.sqrt(two), g.sqrt(g.integer(3))])
        );
        let quarter = g.number(ratio(1, 4).unwrap());
        assert_eq!(g.sqrt(quarter), g.number(ratio(1, 2).unwrap()));
        assert_eq!(g.div(two, g.sqrt(two)), g.sqrt(two),);
    }

    #[test]
    fn exponentials_merge() {
        let g = Graph::new();
        let (x, y, _) = xyz(&g);
        let product = g.mul(&[g.exp(x), y, g.exp(y)]);
        assert_eq!(product, g.mul(&[y, g.exp(g.add(&[x, y]))]));
        assert_eq!(g.mul(&[g.exp(x), g.exp(g.neg(x))]), g.one());
    }

    #[test]
    fn a_square_root_of_a_square_needs_a_sign() {
        let g = Graph::new();
        let (x, _, _) = xyz(&g);
        assert_ne!(g.sqrt(g.powi(x, 2)), x);
        assert_eq!(g.powi(g.sqrt(x), 2), x);
    }

    #[test]
    fn division_by_zero_stays_visible() {
        let g = Graph::new();
        let bad = g.div(g.zero(), g.zero());
        assert!(!g.is_zero(bad));
        assert_eq!(bad, g.powi(g.zero(), -1));
    }

    #[test]
    fn deep_graphs_do_not_overflow_the_stack() {
        let g = Graph::new();
        let (x, y, _) = xyz(&g);
        let mut e = x;
        for _ in 0..200_000 {
            e = g.add(&[g.powi(e, 2), y]);
        }
        assert!(g.reachable(&[e]).len() > 200_000);
    }
}
