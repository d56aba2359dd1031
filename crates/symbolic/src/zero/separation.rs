//! Numbers built by arithmetic and roots that vanish though no form shows it: a separation bound decides.
//!
//! Such a number is U/L with algebraic integers U and L. Where u and l bound the absolute values of all their conjugates and D is the
//! product of the degrees of all roots, a number that is not zero is at least `1/(l u^(D−1))` in absolute value (C. Burnikel,
//! S. Funke, K. Mehlhorn, S. Schirra, S. Schmitt, A Separation Bound for Real Algebraic Expressions, Algorithmica 55, 2009). An
//! enclosure below that bound is zero.

use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::number::algebraic::AlgebraicInteger;
use crate::number::ball::Precision;
use crate::rational::{self, Rational};
use dashu_base::EstimatedLog2;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// A bound of more bits is not reached.
const MOST_BITS: f64 = 40_000.0;

/// The first enclosure has so many bits; each further one has twice as many.
const FIRST_BITS: usize = 128;

/// Bits of an enclosure beyond those of the bound.
const GUARD: usize = 64;

/// Is this number zero? `None` where it is not built of rational numbers, roots, algebraic numbers and sines of rational parts of π by
/// arithmetic, where it has no value, or where its bound has more than 40,000 bits.
pub fn vanishes(graph: &Graph, e: Expr) -> Option<bool> {
    if let Some(number) = graph.as_number(e) {
        return Some(number.is_zero());
    }
    let bits = separation_bits(graph, e)?;
    let most = (bits as usize) + GUARD;
    let mut precision = FIRST_BITS.min(2 * most);
    loop {
        let at = Precision::new(precision);
        if let Ok(found) = graph.enclose(&[e], &at, &|_| None) {
            if found[0].excludes_zero() {
                return Some(false);
            }
            let size = found[0].magnitude().log2_ceil();
            if size.is_none_or(|size| (size as f64) < -bits) {
                return Some(true);
            }
        }
        // What is subtracted may be larger than one: twice the bits of the bound are enough, or the number has no value.
        if precision >= 2 * most {
            return None;
        }
        precision = (2 * precision).min(2 * most);
    }
}

/// A number that is not zero is at least 2 to the minus so many; `None` where nothing is known or there are too many.
fn separation_bits(graph: &Graph, e: Expr) -> Option<f64> {
    let mut sizes: FxHashMap<Expr, Size> = FxHashMap::default();
    let mut roots = Roots {
        graph,
        known: BTreeSet::new(),
        degree: 1.0,
    };
    for e in graph.reachable(&[e]) {
        // The argument of a sine is no algebraic number, and has no size.
        if let Some(size) = roots.size(e, &sizes) {
            sizes.insert(e, size);
        }
    }
    let size = sizes.get(&e)?;
    let bits = size.below + (roots.degree - 1.0) * size.above.max(0.0);
    // Rounded logarithms of some hundred operations.
    let bits = (bits * (1.0 + 1e-6) + 1.0).ceil();
    (bits < MOST_BITS).then_some(bits)
}

/// Bounds of all conjugates of the numerator and denominator of a number, as logarithms of base 2. Numerators of zero have −∞.
#[derive(Clone, Copy, Debug)]
struct Size {
    above: f64,
    below: f64,
}

impl Size {
    fn rational(number: &Rational) -> Size {
        let above = if number.is_zero() {
            f64::NEG_INFINITY
        } else {
            f64::from(number.numerator().log2_bounds().1)
        };
        Size {
            above,
            below: f64::from(number.denominator().log2_bounds().1),
        }
    }

    fn plus(self, other: Size) -> Size {
        let (a, b) = (self.above + other.below, other.above + self.below);
        let (large, small) = (a.max(b), a.min(b));
        let sum = if small == f64::NEG_INFINITY {
            large
        } else {
            large + (small - large).exp2().ln_1p() / std::f64::consts::LN_2
        };
        Size {
            above: sum,
            below: self.below + other.below,
        }
    }

    fn times(self, other: Size) -> Size {
        Size {
            above: self.above + other.above,
            below: self.below + other.below,
        }
    }

    fn inverse(self) -> Size {
        Size {
            above: self.below,
            below: self.above,
        }
    }

    /// U/L as `(U Lᵏ⁻¹)^(1/k) / L` or `U / (Uᵏ⁻¹ L)^(1/k)`, the one with the smaller bounds.
    fn root(self, k: f64) -> Size {
        let Size { above, below } = self;
        if above >= below {
            let above = (above + (k - 1.0) * below) / k;
            return Size { above, below };
        }
        let below = ((k - 1.0) * above + below) / k;
        Size { above, below }
    }
}

/// The roots met so far, each once, and the product of their degrees.
struct Roots<'g> {
    graph: &'g Graph,
    known: BTreeSet<(Expr, u64)>,
    degree: f64,
}

impl Roots<'_> {
    fn meet(&mut self, of: Expr, degree: u64) {
        if self.known.insert((of, degree)) {
            self.degree *= degree as f64;
        }
    }

    fn size(&mut self, e: Expr, sizes: &FxHashMap<Expr, Size>) -> Option<Size> {
        match self.graph.node(e) {
            Node::Number(value) => Some(Size::rational(value)),
            Node::Algebraic(own) => {
                self.meet(e, own.degree() as u64);
                Some(Size {
                    above: largest_conjugate(own),
                    below: 0.0,
                })
            }
            Node::Sum { constant, terms } => {
                terms
                    .iter()
                    .try_fold(Size::rational(constant), |sum, (term, coefficient)| {
                        Some(sum.plus(sizes.get(term)?.times(Size::rational(coefficient))))
                    })
            }
            Node::Product {
                coefficient,
                factors,
            } => factors
                .iter()
                .try_fold(Size::rational(coefficient), |product, factor| {
                    Some(product.times(*sizes.get(factor)?))
                }),
            Node::Power { base, exponent } => {
                let own = *sizes.get(base)?;
                self.power((*base, own), self.graph.as_number(*exponent)?)
            }
            Node::Apply {
                function: Function::Abs,
                arguments,
            } => sizes.get(arguments.first()?).copied(),
            Node::Apply {
                function: Function::Sin | Function::Cos,
                arguments,
            } => self.sine(*arguments.first()?),
            _ => None,
        }
    }

    fn power(&mut self, (base, own): (Expr, Size), exponent: &Rational) -> Option<Size> {
        let own = if rational::is_negative(exponent) {
            own.inverse()
        } else {
            own
        };
        let times = exponent.numerator().to_f64().value().abs();
        let own = Size {
            above: own.above * times,
            below: own.below * times,
        };
        let degree = u64::try_from(exponent.denominator().clone()).ok()?;
        if degree == 1 {
            return Some(own);
        }
        self.meet(base, degree);
        Some(own.root(degree as f64))
    }

    /// 2 sin(π p/q) and 2 cos(π p/q) are algebraic integers in the field of the roots of unity of order 4q; no conjugate is larger than 2.
    fn sine(&mut self, argument: Expr) -> Option<Size> {
        let part = self
            .graph
            .as_number(self.graph.div(argument, self.graph.pi()))?;
        let order = u64::try_from(part.denominator().clone()).ok()?;
        self.meet(self.graph.pi(), order.checked_mul(2)?);
        Some(Size {
            above: 1.0,
            below: 1.0,
        })
    }
}

/// The logarithm of a bound of all zeros of `xⁿ + a₁ xⁿ⁻¹ + … + aₙ`: 2 max |a_k|^(1/k) (M. Fujiwara, Tôhoku Math. J. 10, 1916).
fn largest_conjugate(own: &AlgebraicInteger) -> f64 {
    let polynomial = own.polynomial();
    let degree = polynomial.len() - 1;
    let of = |k: usize| {
        let a = &polynomial[degree - k];
        let size = (!a.is_zero()).then(|| f64::from(a.log2_bounds().1) / k as f64);
        size.unwrap_or(0.0)
    };
    (1..=degree).map(of).fold(0.0, f64::max) + 1.0
}
