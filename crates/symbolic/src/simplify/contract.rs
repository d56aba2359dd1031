//! Addition theorems used backwards: `cos α cos β + sin α sin β` is `cos(α - β)`.

use std::collections::BTreeMap;

use dashu_int::IBig;

use crate::polynomial::normal_form::Field;
use crate::polynomial::{Monomial, Polynomial};
use crate::{Expr, Function, Graph, Node};

/// The generators of the sine and the cosine of an angle.
#[derive(Clone, Copy, Debug)]
struct Angle {
    value: Expr,
    sine: usize,
    cosine: usize,
}

/// Angles whose sines and cosines are generators, sums and differences among them, and the expressions of all generators.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    angles: Vec<Angle>,
    generators: Vec<Expr>,
}

/// Which two products are put together into which function of `α ± β`.
struct Match {
    first: Monomial,
    second: Monomial,
    /// What both have in common.
    rest: Monomial,
    generator: usize,
    negative: bool,
}

impl Angles {
    /// The base angles of a field; `generators` are its generators and perhaps more.
    pub(super) fn new(field: &Field<'_>, generators: Vec<Expr>) -> Angles {
        let mut angles: Vec<Angle> = field
            .pythagoras()
            .into_iter()
            .filter(|pair| pair.circular)
            .filter_map(|pair| {
                Some(Angle {
                    value: field.argument_of(pair.cosine)?,
                    sine: pair.sine,
                    cosine: pair.cosine,
                })
            })
            .collect();
        // The order must not depend on how the angles were met.
        angles.sort_by(|a, b| field.graph().compare(a.value, b.value));
        Angles { angles, generators }
    }

    /// The expression of a generator.
    pub(super) fn expression(&self, generator: usize) -> Expr {
        self.generators[generator]
    }

    /// All expressions of generators, by index.
    pub(super) fn expressions(&self) -> &[Expr] {
        &self.generators
    }

    /// The polynomial with every pair of terms that an addition theorem joins joined; `None` when there is none. Each
    /// step takes one term away, so the cost is bounded by the square of their number.
    pub(super) fn contracted(&mut self, g: &Graph, p: &Polynomial) -> Option<Polynomial> {
        if self.angles.len() < 2 || p.len() < 2 {
            return None;
        }
        let mut terms: BTreeMap<Monomial, IBig> = p.terms().iter().cloned().collect();
        let before = terms.len();
        loop {
            let known = terms.len();
            let monomials: Vec<Monomial> = terms.keys().rev().cloned().collect();
            for monomial in monomials {
                while let Some(found) = self.partner(g, &terms, &monomial) {
                    join(&mut terms, found);
                }
            }
            if terms.len() == known {
                break;
            }
        }
        (terms.len() < before).then(|| Polynomial::from_terms(terms.into_iter().collect()))
    }

    /// A term that an addition theorem joins with the term of `monomial`.
    fn partner(
        &mut self,
        g: &Graph,
        terms: &BTreeMap<Monomial, IBig>,
        monomial: &Monomial,
    ) -> Option<Match> {
        let coefficient = terms.get(monomial)?;
        let inside: Vec<Angle> = self
            .angles
            .iter()
            .filter(|a| monomial.exponent(a.sine) + monomial.exponent(a.cosine) > 0)
            .copied()
            .collect();
        for (k, a) in inside.iter().enumerate() {
            for b in &inside[k + 1..] {
                // cos α cos β ± sin α sin β,  sin α cos β ± cos α sin β.
                for (x, y, u, v) in [
                    (a.cosine, b.cosine, a.sine, b.sine),
                    (a.sine, b.cosine, a.cosine, b.sine),
                ] {
                    let Some(rest) = without(monomial, x, y) else {
                        continue;
                    };
                    let second = with(&with(&rest, u), v);
                    let Some(other) = terms.get(&second) else {
                        continue;
                    };
                    let even = u == a.sine;
                    let equal = other == coefficient;
                    if !equal && *other != -coefficient {
                        continue;
                    }
                    // cos(α - β) and sin(α + β) have equal signs inside.
                    let minus = equal == even;
                    let (generator, negative) = self.function(g, a, b, minus, even)?;
                    return Some(Match {
                        first: monomial.clone(),
                        second,
                        rest,
                        generator,
                        negative,
                    });
                }
            }
        }
        None
    }

    /// The generator of the cosine (`even`) or the sine of `α ± β`, and whether its sign is opposite.
    fn function(
        &mut self,
        g: &Graph,
        a: &Angle,
        b: &Angle,
        minus: bool,
        even: bool,
    ) -> Option<(usize, bool)> {
        let plain = if minus {
            g.sub(a.value, b.value)
        } else {
            g.add(&[a.value, b.value])
        };
        // sin(β - α) is written -sin(α - β), whichever of both the graph takes for canonical.
        let turned = !is_application(g, g.sin(plain));
        let value = if turned { g.neg(plain) } else { plain };
        let (sine, cosine) = (g.sin(value), g.cos(value));
        if !is_application(g, sine) || !is_application(g, cosine) {
            return None;
        }
        let known = self.angles.iter().find(|known| known.value == value);
        let angle = match known {
            Some(&known) => known,
            None => {
                let angle = Angle {
                    value,
                    sine: self.generators.len(),
                    cosine: self.generators.len() + 1,
                };
                self.generators.extend([sine, cosine]);
                self.angles.push(angle);
                angle
            }
        };
        Some(if even {
            (angle.cosine, false)
        } else {
            (angle.sine, turned)
        })
    }
}

fn is_application(g: &Graph, e: Expr) -> bool {
    matches!(
        g.node(e),
        Node::Apply {
            function: Function::Sin | Function::Cos,
            ..
        }
    )
}

fn without(m: &Monomial, x: usize, y: usize) -> Option<Monomial> {
    let (i, j) = (m.exponent(x), m.exponent(y));
    (i > 0 && j > 0).then(|| m.with_exponent(x, i - 1).with_exponent(y, j - 1))
}

fn with(m: &Monomial, x: usize) -> Monomial {
    m.with_exponent(x, m.exponent(x) + 1)
}

fn join(terms: &mut BTreeMap<Monomial, IBig>, found: Match) {
    let coefficient = terms.remove(&found.first).unwrap_or(IBig::ZERO);
    terms.remove(&found.second);
    let joined = with(&found.rest, found.generator);
    let change = if found.negative {
        -coefficient
    } else {
        coefficient
    };
    let sum = terms.remove(&joined).unwrap_or(IBig::ZERO) + change;
    if !sum.is_zero() {
        terms.insert(joined, sum);
    }
}
