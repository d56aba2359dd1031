//! Power series in the time, coefficient by coefficient, with as many digits as are asked for (Moore 1966; Jorba and Zou 2005).
//!
//! Expressions become rules on slots; each rule gives the coefficient of order k from those of its arguments up to k. Numbers are
//! midpoints of balls: what is computed is no enclosure, but rounding is far below every digit that is looked at.

use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::rational::{ratio, to_i64};
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};
use std::collections::BTreeMap;

/// How a slot follows from others.
enum Rule {
    /// Does not move.
    Constant(Ball),
    /// A symbol whose coefficients are given, by its place.
    Given(usize),
    Sum(Ball, Vec<(usize, Ball)>),
    Product(usize, usize),
    /// base^exponent, for a base that does not vanish.
    Power(usize, Ball),
    /// The sine of a slot; its cosine is the next slot.
    Sine(usize),
    /// The cosine that belongs to the sine in the slot before.
    Cosine,
    Exponential(usize),
    /// The logarithm or arctangent of the first slot, whose slope, as a function of it, is the second.
    Primitive(Function, usize, usize),
}

/// Expressions as series in the time.
pub(super) struct Series {
    precision: Precision,
    rules: Vec<Rule>,
    coefficients: Vec<Vec<Ball>>,
    outputs: Vec<usize>,
}

/// Rules while they are collected.
struct Rules<'a> {
    g: &'a Graph,
    precision: &'a Precision,
    rules: Vec<Rule>,
    slots: BTreeMap<Expr, usize>,
    turned: BTreeMap<usize, usize>,
}

impl Rules<'_> {
    fn push(&mut self, rule: Rule) -> usize {
        self.rules.push(rule);
        self.rules.len() - 1
    }

    fn constant(&mut self, number: &Rational) -> usize {
        let ball = self.precision.rational(number).midpoint();
        self.push(Rule::Constant(ball))
    }

    /// Sine and cosine of a slot.
    fn turning(&mut self, angle: usize) -> (usize, usize) {
        if let Some(&sine) = self.turned.get(&angle) {
            return (sine, sine + 1);
        }
        let sine = self.push(Rule::Sine(angle));
        self.push(Rule::Cosine);
        self.turned.insert(angle, sine);
        (sine, sine + 1)
    }

    fn power(&mut self, base: usize, exponent: &Rational) -> usize {
        match to_i64(exponent) {
            Some(n) if (1..=12).contains(&n) => {
                (1..n).fold(base, |all, _| self.push(Rule::Product(all, base)))
            }
            // The rule of other powers takes a logarithm, which a negative base lacks.
            Some(n) if (-12..0).contains(&n) => {
                let inverse = self.inverse(base);
                (1..-n).fold(inverse, |all, _| self.push(Rule::Product(all, inverse)))
            }
            _ => {
                let exponent = self.precision.rational(exponent).midpoint();
                self.push(Rule::Power(base, exponent))
            }
        }
    }

    fn inverse(&mut self, slot: usize) -> usize {
        self.push(Rule::Power(slot, Ball::integer(-1)))
    }

    fn apply(&mut self, function: Function, x: usize) -> Option<usize> {
        if function == Function::Exp {
            return Some(self.push(Rule::Exponential(x)));
        }
        if function == Function::Log {
            let slope = self.inverse(x);
            return Some(self.push(Rule::Primitive(function, x, slope)));
        }
        if function == Function::Atan {
            let square = self.push(Rule::Product(x, x));
            let below = self.push(Rule::Sum(
                Ball::integer(1),
                vec![(square, Ball::integer(1))],
            ));
            let slope = self.inverse(below);
            return Some(self.push(Rule::Primitive(function, x, slope)));
        }
        let (sine, cosine) = self.turning(x);
        Some(match function {
            Function::Sin => sine,
            Function::Cos => cosine,
            Function::Sec => self.inverse(cosine),
            Function::Csc => self.inverse(sine),
            Function::Tan => {
                let below = self.inverse(cosine);
                self.push(Rule::Product(sine, below))
            }
            Function::Cot => {
                let below = self.inverse(sine);
                self.push(Rule::Product(cosine, below))
            }
            _ => return None,
        })
    }

    /// The slot of a node whose children have theirs.
    fn node(
        &mut self,
        node: &Node,
        place: &dyn Fn(Symbol) -> Option<usize>,
        fixed: &dyn Fn(Symbol) -> Option<Ball>,
    ) -> Option<usize> {
        Some(match node {
            Node::Number(number) => self.constant(number),
            Node::Pi => {
                let pi = self.precision.pi().ok()?.midpoint();
                self.push(Rule::Constant(pi))
            }
            Node::Algebraic(own) => {
                let own = own.enclose(self.precision).ok()?.midpoint();
                self.push(Rule::Constant(own))
            }
            Node::Symbol(symbol) => match place(*symbol) {
                Some(place) => self.push(Rule::Given(place)),
                None => self.push(Rule::Constant(fixed(*symbol)?)),
            },
            Node::Sum { constant, terms } => {
                let number = |r: &Rational| self.precision.rational(r).midpoint();
                let parts = terms.iter().map(|(e, c)| (self.slots[e], number(c)));
                let (constant, parts) = (number(constant), parts.collect());
                self.push(Rule::Sum(constant, parts))
            }
            Node::Product {
                coefficient,
                factors,
            } => {
                let mut slots = factors.iter().map(|e| self.slots[e]);
                let first = slots.next()?;
                let rest: Vec<usize> = slots.collect();
                let product = rest
                    .into_iter()
                    .fold(first, |all, next| self.push(Rule::Product(all, next)));
                let scale = self.precision.rational(coefficient).midpoint();
                self.push(Rule::Sum(Ball::zero(), vec![(product, scale)]))
            }
            Node::Power { base, exponent } => {
                let exponent = self.g.as_number(*exponent)?.clone();
                self.power(self.slots[base], &exponent)
            }
            Node::Apply {
                function,
                arguments,
            } => match &**arguments {
                &[x] => self.apply(*function, self.slots[&x])?,
                _ => return None,
            },
            Node::Matrix { .. } | Node::Solve { .. } | Node::Entry { .. } => return None,
        })
    }
}

impl Series {
    /// Expressions in symbols that move, by their place, and in others that do not; `None` where one contains something that has
    /// no rule here.
    pub(super) fn of(
        g: &Graph,
        outputs: &[Expr],
        precision: &Precision,
        place: &dyn Fn(Symbol) -> Option<usize>,
        fixed: &dyn Fn(Symbol) -> Option<Ball>,
    ) -> Option<Series> {
        let mut rules = Rules {
            g,
            precision,
            rules: Vec::new(),
            slots: BTreeMap::new(),
            turned: BTreeMap::new(),
        };
        for e in g.reachable(outputs) {
            let slot = rules.node(g.node(e), place, fixed)?;
            rules.slots.insert(e, slot);
        }
        Some(Series {
            outputs: outputs.iter().map(|e| rules.slots[e]).collect(),
            coefficients: vec![Vec::new(); rules.rules.len()],
            rules: rules.rules,
            precision: precision.clone(),
        })
    }

    /// Forgets all coefficients.
    pub(super) fn clear(&mut self) {
        self.coefficients.iter_mut().for_each(Vec::clear);
    }

    /// The coefficients of the outputs of the next order, from those of the symbols up to it; `None` where a function is not
    /// defined.
    pub(super) fn next(&mut self, given: &[Vec<Ball>]) -> Option<Vec<Ball>> {
        for slot in 0..self.rules.len() {
            // A pair of sine and cosine is computed together.
            let next = match &self.rules[slot] {
                Rule::Cosine => continue,
                Rule::Sine(x) => {
                    let (sine, cosine) = self.turned(slot, *x)?;
                    self.coefficients[slot + 1].push(cosine);
                    sine
                }
                rule => self.coefficient(slot, rule, given)?,
            };
            self.coefficients[slot].push(next);
        }
        let last = |&slot: &usize| self.coefficients[slot].last().cloned();
        self.outputs.iter().map(last).collect()
    }

    fn coefficient(&self, slot: usize, rule: &Rule, given: &[Vec<Ball>]) -> Option<Ball> {
        let of = |slot: usize| &self.coefficients[slot];
        let order = of(slot).len();
        let p = &self.precision;
        Some(match rule {
            Rule::Constant(value) if order == 0 => value.clone(),
            Rule::Constant(_) => Ball::zero(),
            Rule::Given(place) => given[*place][order].clone(),
            Rule::Sum(constant, terms) => {
                let mut sum = match order {
                    0 => constant.clone(),
                    _ => Ball::zero(),
                };
                for (term, scale) in terms {
                    sum = p.add(&sum, &p.mul(scale, &of(*term)[order]).ok()?).ok()?;
                }
                sum.midpoint()
            }
            Rule::Product(a, b) => convolution(p, &of(*a)[..=order], &of(*b)[..=order])?,
            Rule::Power(base, exponent) => self.power(of(*base), of(slot), exponent)?,
            Rule::Exponential(x) => match order {
                0 => p.exp(&of(*x)[0]).ok()?.midpoint(),
                _ => over(p, &convolution(p, &rates(p, of(*x))?, of(slot))?, order)?,
            },
            // k u_k = Σ j x_j s_{k-j}.
            Rule::Primitive(function, x, slope) => match (order, function) {
                (0, Function::Log) => p.log(&of(*x)[0]).ok()?.midpoint(),
                (0, _) => p.atan(&of(*x)[0]).ok()?.midpoint(),
                _ => over(
                    p,
                    &convolution(p, &rates(p, of(*x))?, &of(*slope)[..order])?,
                    order,
                )?,
            },
            Rule::Sine(_) | Rule::Cosine => return None,
        })
    }

    /// b^r: k b₀ p_k = Σ_{j=1}^{k} ((r + 1) j - k) b_j p_{k-j}.
    fn power(&self, base: &[Ball], own: &[Ball], exponent: &Ball) -> Option<Ball> {
        let (p, k) = (&self.precision, own.len());
        let first = &base[0];
        if first.contains_zero() {
            return None;
        }
        if k == 0 {
            return match *exponent == Ball::integer(-1) {
                true => Some(p.div(&Ball::integer(1), first).ok()?.midpoint()),
                false => Some(p.pow(first, exponent).ok()?.midpoint()),
            };
        }
        let more = p.add(exponent, &Ball::integer(1)).ok()?;
        let mut sum = Ball::zero();
        for j in 1..=k {
            let scale = p.mul(&more, &Ball::integer(j as i64)).ok()?;
            let scale = p.sub(&scale, &Ball::integer(k as i64)).ok()?;
            let product = p.mul(&base[j], &own[k - j]).ok()?.midpoint();
            sum = p.add(&sum, &p.mul(&scale, &product).ok()?).ok()?.midpoint();
        }
        over(p, &p.div(&sum, first).ok()?.midpoint(), k)
    }

    /// Sine and cosine: k s_k = Σ j x_j c_{k-j}, k c_k = -Σ j x_j s_{k-j}.
    fn turned(&self, slot: usize, x: usize) -> Option<(Ball, Ball)> {
        let p = &self.precision;
        let (x, sine, cosine) = (
            &self.coefficients[x],
            &self.coefficients[slot],
            &self.coefficients[slot + 1],
        );
        if sine.is_empty() {
            let (sine, cosine) = p.sin_cos(&x[0]).ok()?;
            return Some((sine.midpoint(), cosine.midpoint()));
        }
        let rates = rates(p, x)?;
        let order = sine.len();
        let grows = over(p, &convolution(p, &rates, cosine)?, order)?;
        let falls = over(p, &convolution(p, &rates, sine)?, order)?;
        Some((grows, falls.neg()))
    }
}

/// The coefficients j x_j, j = 1.., of the derivative.
fn rates(p: &Precision, x: &[Ball]) -> Option<Vec<Ball>> {
    let numbered = x.iter().enumerate().skip(1);
    numbered
        .map(|(j, c)| Some(p.mul(c, &Ball::integer(j as i64)).ok()?.midpoint()))
        .collect()
}

/// `Σ a_i b_{m-i}` over two rows of equal length m + 1.
fn convolution(p: &Precision, a: &[Ball], b: &[Ball]) -> Option<Ball> {
    let mut sum = Ball::zero();
    for (x, y) in a.iter().zip(b.iter().rev()) {
        sum = p.add(&sum, &p.mul(x, y).ok()?.midpoint()).ok()?.midpoint();
    }
    Some(sum)
}

/// x/n.
pub(super) fn over(p: &Precision, x: &Ball, n: usize) -> Option<Ball> {
    let inverse = p.rational(&ratio(1, n as i64)?);
    Some(p.mul(x, &inverse).ok()?.midpoint())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (x - 1)^(-2) = Σ (k + 1) x^k and (x - 1)^(-3) = -Σ (k + 1) (k + 2)/2 x^k: the base is negative.
    #[test]
    fn inverse_powers_of_a_negative_base() {
        let g = Graph::new();
        let (x, p) = (g.symbol("x", 0), Precision::new(160));
        let symbol = g.as_symbol(x).unwrap();
        let base = g.add(&[x, g.integer(-1)]);
        let outputs = [g.powi(base, -2), g.powi(base, -3)];
        let place = |s: Symbol| (s == symbol).then_some(0);
        let mut series = Series::of(&g, &outputs, &p, &place, &|_| None).unwrap();
        let mut given = vec![Ball::zero(); 6];
        given[1] = Ball::integer(1);
        let given = [given];
        for k in 0..6_i32 {
            let found = series.next(&given).unwrap();
            let expected = [k + 1, -(k + 1) * (k + 2) / 2];
            for (found, expected) in found.iter().zip(expected) {
                assert_eq!(found.to_f64(), f64::from(expected), "order {k}");
            }
        }
    }

    /// Coefficients of sin(x) e^x, (1 + x²)^(-1/2), tan(x), log(1 + x) and atan(x), for x = t, from their known expansions.
    #[test]
    fn coefficients_of_known_functions() {
        let g = Graph::new();
        let (x, p) = (g.symbol("x", 0), Precision::new(160));
        let symbol = g.as_symbol(x).unwrap();
        let outputs = [
            g.mul(&[g.sin(x), g.exp(x)]),
            g.pow(
                g.add(&[g.one(), g.powi(x, 2)]),
                g.number(ratio(-1, 2).unwrap()),
            ),
            g.apply(Function::Tan, &[x]),
            g.apply(Function::Log, &[g.add(&[g.one(), x])]),
            g.apply(Function::Atan, &[x]),
        ];
        let place = |s: Symbol| (s == symbol).then_some(0);
        let mut series = Series::of(&g, &outputs, &p, &place, &|_| None).unwrap();
        let mut given = vec![Ball::zero(); 8];
        given[1] = Ball::integer(1);
        let given = [given];
        let found: Vec<Vec<Ball>> = (0..6).map(|_| series.next(&given).unwrap()).collect();
        // sin t e^t = t + t² + t³/3 - t⁵/30; (1 + t²)^(-1/2) = 1 - t²/2 + 3 t⁴/8; tan t = t + t³/3 + 2 t⁵/15;
        // log(1 + t) = t - t²/2 + …, atan t = t - t³/3 + ….
        let expected = [
            [(0, 1), (1, 1), (1, 1), (1, 3), (0, 1), (-1, 30)],
            [(1, 1), (0, 1), (-1, 2), (0, 1), (3, 8), (0, 1)],
            [(0, 1), (1, 1), (0, 1), (1, 3), (0, 1), (2, 15)],
            [(0, 1), (1, 1), (-1, 2), (1, 3), (-1, 4), (1, 5)],
            [(0, 1), (1, 1), (0, 1), (-1, 3), (0, 1), (1, 5)],
        ];
        for (place, row) in expected.iter().enumerate() {
            for (order, &(above, below)) in row.iter().enumerate() {
                let wanted = p.rational(&ratio(above, below).unwrap());
                let error = p.sub(&found[order][place], &wanted).unwrap();
                assert!(
                    error.log2_ceil().is_none_or(|e| e < -140),
                    "{place} {order}"
                );
            }
        }
    }
}
