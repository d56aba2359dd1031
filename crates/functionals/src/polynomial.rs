//! Polynomials in the independent variables with rational coefficients.

use crate::functional::{Interval, Side};
use crate::space::Space;
use chetaev_symbolic::{meter, rational, Expr, Node, Rational};
use std::collections::BTreeMap;

/// Units of work for a product of two terms.
const STEP: u64 = 20;

/// Exponents with coefficients; none is zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial(BTreeMap<Vec<u32>, Rational>);

/// A box, or a face of it, with rational ends.
pub struct Domain {
    /// Axis, smaller and larger end of every variable that runs.
    pub intervals: Vec<(usize, Rational, Rational)>,
    /// Axis and value of a variable that is constant.
    pub at: Option<(usize, Rational)>,
}

impl Domain {
    /// The box; `None` where an end is no number.
    pub fn of(
        space: &Space,
        intervals: &[Interval],
        values: &dyn Fn(Expr) -> Expr,
    ) -> Option<Domain> {
        let end = |e: Expr| space.graph.as_number(values(e)).cloned();
        let own = intervals
            .iter()
            .map(|i| Some((i.axis, end(i.lower)?, end(i.upper)?)));
        Some(Domain {
            intervals: own.collect::<Option<Vec<_>>>()?,
            at: None,
        })
    }

    /// A face of it.
    pub fn face(&self, side: &Side) -> Option<Domain> {
        let Side::Flat { axis, is_upper, .. } = side else {
            return None;
        };
        let (_, lower, upper) = self.intervals.iter().find(|(own, _, _)| own == axis)?;
        let at = if *is_upper { upper } else { lower };
        let rest = self.intervals.iter().filter(|(own, _, _)| own != axis);
        Some(Domain {
            intervals: rest.cloned().collect(),
            at: Some((*axis, at.clone())),
        })
    }
}

impl Polynomial {
    /// A number.
    pub fn constant(value: Rational) -> Polynomial {
        Polynomial::monomial(Vec::new(), value)
    }

    /// A coefficient with exponents by axis.
    pub fn monomial(mut exponents: Vec<u32>, coefficient: Rational) -> Polynomial {
        while exponents.last() == Some(&0) {
            exponents.pop();
        }
        let mut own = BTreeMap::new();
        if coefficient != Rational::ZERO {
            own.insert(exponents, coefficient);
        }
        Polynomial(own)
    }

    /// An expression of the independent variables; `None` where it is none.
    pub fn of(space: &Space, e: Expr) -> Option<Polynomial> {
        let g = &space.graph;
        Some(match g.node(e) {
            Node::Number(value) => Polynomial::constant(value.clone()),
            Node::Symbol(symbol) => {
                let own = g.symbol_expr(*symbol);
                let axis = space.coordinates.iter().position(|c| c.expr == own)?;
                let mut exponents = vec![0; axis + 1];
                exponents[axis] = 1;
                Polynomial::monomial(exponents, rational::integer(1))
            }
            Node::Sum { constant, terms } => {
                let mut sum = Polynomial::constant(constant.clone());
                for (term, coefficient) in terms.iter() {
                    sum.add(&Polynomial::of(space, *term)?, coefficient);
                }
                sum
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let mut product = Polynomial::constant(coefficient.clone());
                for factor in factors.iter() {
                    product = product.times(&Polynomial::of(space, *factor)?);
                }
                product
            }
            Node::Power { base, exponent } => {
                let n = rational::to_i64(g.as_number(*exponent)?)?;
                let n = u32::try_from(n).ok().filter(|n| *n <= 64)?;
                let base = Polynomial::of(space, *base)?;
                let one = Polynomial::constant(rational::integer(1));
                (0..n).fold(one, |own, _| own.times(&base))
            }
            _ => return None,
        })
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The coefficients by ascending powers of the first variable; `None` where another one occurs.
    pub fn in_one_variable(&self) -> Option<Vec<Rational>> {
        let mut found = Vec::new();
        for (exponents, value) in &self.0 {
            let n = match exponents[..] {
                [] => 0,
                [n] => n as usize,
                _ => return None,
            };
            if found.len() <= n {
                found.resize(n + 1, Rational::ZERO);
            }
            found[n] = value.clone();
        }
        Some(found)
    }

    /// Exponents by axis with their coefficients.
    pub fn terms(&self) -> impl Iterator<Item = (&[u32], &Rational)> {
        self.0
            .iter()
            .map(|(exponents, value)| (&exponents[..], value))
    }

    /// The function of which this is the derivative by a variable, and which vanishes where that does.
    #[must_use]
    pub fn primitive(&self, axis: usize) -> Polynomial {
        let mut found = Polynomial::default();
        for (exponents, value) in self.terms() {
            let mut own = exponents.to_vec();
            own.resize(own.len().max(axis + 1), 0);
            own[axis] += 1;
            let share = value / rational::integer(i64::from(own[axis]));
            found.add(&Polynomial::monomial(own, share), &rational::integer(1));
        }
        found
    }

    /// Adds a multiple of another one.
    pub fn add(&mut self, other: &Polynomial, factor: &Rational) {
        for (exponents, value) in &other.0 {
            let term = rational::product(value, factor);
            let own = self.0.entry(exponents.clone()).or_insert(Rational::ZERO);
            *own = rational::sum(own, &term);
        }
        self.0.retain(|_, value| *value != Rational::ZERO);
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Polynomial) -> Polynomial {
        meter::spend(STEP * (self.0.len() * other.0.len()) as u64);
        let mut found = BTreeMap::new();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                let n = a.len().max(b.len());
                let at = |own: &[u32], i: usize| own.get(i).copied().unwrap_or(0);
                let exponents: Vec<u32> = (0..n).map(|i| at(a, i) + at(b, i)).collect();
                let own = found.entry(exponents).or_insert(Rational::ZERO);
                *own = rational::sum(own, &rational::product(x, y));
            }
        }
        found.retain(|_, value| *value != Rational::ZERO);
        Polynomial(found)
    }

    /// The derivative by an axis.
    #[must_use]
    pub fn slope(&self, axis: usize) -> Polynomial {
        let mut sum = Polynomial::default();
        for (exponents, value) in &self.0 {
            let Some(&n) = exponents.get(axis).filter(|n| **n > 0) else {
                continue;
            };
            let mut own = exponents.clone();
            own[axis] -= 1;
            let value = rational::product(value, &rational::integer(i64::from(n)));
            sum.add(&Polynomial::monomial(own, value), &rational::integer(1));
        }
        sum
    }

    /// Where some variables are constant.
    #[must_use]
    pub fn at(&self, values: &[(usize, Rational)]) -> Polynomial {
        let mut sum = Polynomial::default();
        for (exponents, value) in &self.0 {
            let (mut own, mut value) = (exponents.clone(), value.clone());
            for (axis, x) in values {
                let n = std::mem::take(own.get_mut(*axis).unwrap_or(&mut 0));
                let power = rational::powi(x, i64::from(n));
                let power = power.filter(|_| n > 0).unwrap_or(rational::integer(1));
                value = rational::product(&value, &power);
            }
            sum.add(&Polynomial::monomial(own, value), &rational::integer(1));
        }
        sum
    }

    /// Several derivatives.
    #[must_use]
    pub fn slopes(&self, by: &[usize]) -> Polynomial {
        by.iter().fold(self.clone(), |own, &axis| own.slope(axis))
    }

    /// Numbers between which it lies on a box, the sums of those of its terms; `None` where a variable in it has no interval.
    pub fn bounds(
        &self,
        intervals: &[(usize, Rational, Rational)],
    ) -> Option<(Rational, Rational)> {
        let mut sums = (Rational::ZERO, Rational::ZERO);
        for (exponents, value) in &self.0 {
            let mut own = (value.clone(), value.clone());
            for (axis, &n) in exponents.iter().enumerate().filter(|(_, n)| **n > 0) {
                let (_, lower, upper) = intervals.iter().find(|(own, _, _)| *own == axis)?;
                let n = i64::from(n);
                let mut ends = vec![rational::powi(lower, n)?, rational::powi(upper, n)?];
                if n % 2 == 0 && *lower < Rational::ZERO && *upper > Rational::ZERO {
                    ends.push(Rational::ZERO);
                }
                let products = ends
                    .iter()
                    .flat_map(|end| [&own.0, &own.1].map(|factor| rational::product(factor, end)));
                let products: Vec<Rational> = products.collect();
                own = (
                    products.iter().min()?.clone(),
                    products.iter().max()?.clone(),
                );
            }
            sums = (
                rational::sum(&sums.0, &own.0),
                rational::sum(&sums.1, &own.1),
            );
        }
        Some(sums)
    }

    /// The integral over a box or a face; variables that do not run are zero.
    pub fn integral(&self, domain: &Domain) -> Rational {
        meter::spend(STEP * (self.0.len() * (1 + domain.intervals.len())) as u64);
        let mut sum = Rational::ZERO;
        for (exponents, value) in &self.0 {
            let mut own = value.clone();
            let at = |axis: usize| i64::from(exponents.get(axis).copied().unwrap_or(0));
            for (axis, lower, upper) in &domain.intervals {
                let n = at(*axis) + 1;
                let power = |x: &Rational| rational::powi(x, n).unwrap_or(Rational::ZERO);
                let difference = power(upper) - power(lower);
                let share = rational::ratio(1, n).unwrap_or(Rational::ZERO);
                own = rational::product(&own, &rational::product(&difference, &share));
            }
            if let Some((axis, place)) = &domain.at {
                let power = match at(*axis) {
                    0 => rational::integer(1),
                    n => rational::powi(place, n).unwrap_or(Rational::ZERO),
                };
                own = rational::product(&own, &power);
            }
            sum = rational::sum(&sum, &own);
        }
        sum
    }

    /// The value at a point.
    pub fn value(&self, point: &[f64]) -> f64 {
        let terms = self.0.iter().map(|(exponents, value)| {
            let powers = exponents.iter().zip(point).map(|(&n, &x)| x.powi(n as i32));
            rational::to_f64(value) * powers.product::<f64>()
        });
        terms.sum()
    }

    /// The exact value at a rational point.
    pub fn exact(&self, point: &[Rational]) -> Rational {
        let mut sum = Rational::ZERO;
        for (exponents, value) in &self.0 {
            let mut own = value.clone();
            for (&n, x) in exponents.iter().zip(point).filter(|(n, _)| **n > 0) {
                let power = rational::powi(x, i64::from(n)).unwrap_or(Rational::ZERO);
                own = rational::product(&own, &power);
            }
            sum = rational::sum(&sum, &own);
        }
        sum
    }

    /// As an expression.
    pub fn expr(&self, space: &Space) -> Expr {
        let g = &space.graph;
        let terms = self.0.iter().map(|(exponents, value)| {
            let mut factors = vec![g.number(value.clone())];
            for (axis, &n) in exponents.iter().enumerate().filter(|(_, n)| **n > 0) {
                factors.extend(
                    space
                        .coordinates
                        .get(axis)
                        .map(|c| g.powi(c.expr, i64::from(n))),
                );
            }
            g.mul(&factors)
        });
        g.add(&terms.collect::<Vec<_>>())
    }
}
