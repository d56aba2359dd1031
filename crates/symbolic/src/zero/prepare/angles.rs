//! Sines and cosines: every argument is a rational combination of base angles, of π and of a number; each base angle,
//! divided by the common denominator of its multiples, is a point of a circle of its own.

use dashu_int::IBig;

use super::super::expand::LinearForm;
use super::super::program::{Operation, Value};
use super::{half, Builder, Missing};
use crate::node::{Expr, Function, Node};
use crate::rational::{self, Rational};

/// (cosine, sine).
type Point = (Value, Value);

impl Builder<'_> {
    /// cos x and sin x.
    pub(super) fn angle(&mut self, x: Expr) -> Result<Point, Missing> {
        if let Some(&point) = self.angles.get(&x) {
            return Ok(point);
        }
        let LinearForm { terms, constant } = self.form(x);
        let mut point: Option<Point> = None;
        let mut parts: Vec<(Expr, Rational)> = terms.into_iter().collect();
        if !constant.is_zero() {
            parts.push((self.graph.one(), constant));
        }
        for (monomial, coefficient) in parts {
            let next = if monomial == self.graph.pi() {
                self.turn(&coefficient)
            } else {
                self.multiple(monomial, &coefficient)?
            };
            point = Some(match point {
                Some(sum) => self.rotate(sum, next),
                None => next,
            });
        }
        let point = match point {
            Some(point) => point,
            None => (self.number(Rational::ONE), self.number(Rational::ZERO)),
        };
        self.angles.insert(x, point);
        Ok(point)
    }

    pub(super) fn ratio_of_angle(
        &mut self,
        x: Expr,
        parts: impl Fn(Point) -> (Option<Value>, Value),
    ) -> Result<Value, Missing> {
        let (numerator, denominator) = parts(self.angle(x)?);
        let reciprocal = self.power_of(denominator, IBig::from(-1));
        Ok(match numerator {
            Some(numerator) => self.product(Rational::ONE, vec![numerator, reciprocal]),
            None => reciprocal,
        })
    }

    /// The point of coefficient·monomial.
    fn multiple(&mut self, monomial: Expr, coefficient: &Rational) -> Result<Point, Missing> {
        let parts = self.angle_parts.get(&monomial).copied().unwrap_or(1);
        let scaled = coefficient * Rational::from(IBig::from(parts));
        let (times, parts) = match (scaled.is_int(), rational::to_i64(&scaled)) {
            (true, Some(times)) => (times, parts),
            // A multiple outside of the common denominator is an angle of its own.
            _ => {
                let own = self.graph.scale(coefficient, monomial);
                return self.circle(own, 1);
            }
        };
        let unit = self.circle(monomial, parts)?;
        Ok(self.turn_times(unit, times))
    }

    /// The point of monomial/parts.
    fn circle(&mut self, monomial: Expr, parts: u64) -> Result<Point, Missing> {
        if let Some(&point) = self.circles.get(&(monomial, parts)) {
            return Ok(point);
        }
        let point = match self.known_angle(monomial, parts)? {
            Some(point) => point,
            None => {
                let symbol = self.graph.as_symbol(monomial);
                let constraint = symbol.and_then(|s| self.dependent.get(&s).copied());
                self.program.faithful &=
                    constraint.is_some() || self.is_monomial_in_symbols(monomial);
                let index = self.program.circles;
                self.program.circles += 1;
                self.program.circle_angles.push(monomial);
                self.program.dependent_circles.push(constraint);
                (
                    self.push(Operation::CircleCos(index)),
                    self.push(Operation::CircleSin(index)),
                )
            }
        };
        self.circles.insert((monomial, parts), point);
        Ok(point)
    }

    /// Inverse functions have algebraic sines and cosines; halves of them too, since none of
    /// them leaves [−π, π].
    fn known_angle(&mut self, monomial: Expr, parts: u64) -> Result<Option<Point>, Missing> {
        let graph = self.graph;
        let Node::Apply {
            function,
            arguments,
        } = graph.node(monomial)
        else {
            return Ok(None);
        };
        if !matches!(
            function,
            Function::Atan | Function::Asin | Function::Acos | Function::Atan2
        ) || !parts.is_power_of_two()
            || parts > 4
        {
            return Ok(None);
        }
        let (one, square) = (graph.one(), |x: Expr| graph.powi(x, 2));
        let (mut cosine, mut sine) = match (function, &**arguments) {
            (Function::Atan, &[x]) => {
                let root = graph.sqrt(graph.add(&[one, square(x)]));
                (graph.powi(root, -1), graph.div(x, root))
            }
            (Function::Asin, &[x]) => (graph.sqrt(graph.sub(one, square(x))), x),
            (Function::Acos, &[x]) => (x, graph.sqrt(graph.sub(one, square(x)))),
            (Function::Atan2, &[y, x]) => {
                let root = graph.sqrt(graph.add(&[square(x), square(y)]));
                (graph.div(x, root), graph.div(y, root))
            }
            _ => return Ok(None),
        };
        let mut rest = parts;
        while rest > 1 {
            let root = graph.sqrt(graph.scale(&half(), graph.add(&[one, cosine])));
            sine = graph.div(sine, graph.scale(&rational::integer(2), root));
            cosine = root;
            rest /= 2;
        }
        let values = self.values([cosine, sine].into_iter())?;
        Ok(Some((values[0], values[1])))
    }

    /// The point of r·π.
    fn turn(&mut self, multiple: &Rational) -> Point {
        let quarters = multiple * rational::integer(2);
        if let Some(quarters) = quarters
            .is_int()
            .then(|| quarters.numerator() % IBig::from(4))
        {
            let quarter = i64::try_from(&quarters).unwrap_or(0).rem_euclid(4);
            let (cosine, sine) = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter as usize];
            return (
                self.number(rational::integer(cosine)),
                self.number(rational::integer(sine)),
            );
        }
        let order = self.program.order_of_unity;
        let index = multiple * half() * Rational::from(IBig::from(order));
        if !index.is_int() {
            // The order would have been too large: the angle is a generator of its own.
            let own = self.graph.scale(multiple, self.graph.pi());
            return self
                .circle(own, 1)
                .unwrap_or_else(|_| (self.nowhere(), self.nowhere()));
        }
        let order_big = IBig::from(order);
        let index = ((index.numerator() % &order_big) + &order_big) % &order_big;
        let index = u64::try_from(&index).unwrap_or(0);
        (
            self.push(Operation::UnityCos(index)),
            self.push(Operation::UnitySin(index)),
        )
    }

    /// The point of the sum of two angles.
    fn rotate(&mut self, (c, s): Point, (d, t): Point) -> Point {
        let mut product = |a, b| self.product(Rational::ONE, vec![a, b]);
        let (cd, st, ct, sd) = (product(c, d), product(s, t), product(c, t), product(s, d));
        let cosine = self.sum(
            &Rational::ZERO,
            vec![(cd, Rational::ONE), (st, Rational::NEG_ONE)],
        );
        let sine = self.sum(
            &Rational::ZERO,
            vec![(ct, Rational::ONE), (sd, Rational::ONE)],
        );
        (cosine, sine)
    }

    /// The point of n times the angle, by doubling.
    fn turn_times(&mut self, (cosine, sine): Point, times: i64) -> Point {
        let unit = if times < 0 {
            (cosine, self.product(Rational::NEG_ONE, vec![sine]))
        } else {
            (cosine, sine)
        };
        let count = times.unsigned_abs();
        let mut result: Option<Point> = None;
        for bit in (0..64 - count.leading_zeros()).rev() {
            if let Some(point) = result {
                result = Some(self.rotate(point, point));
            }
            if count >> bit & 1 == 1 {
                result = Some(match result {
                    Some(point) => self.rotate(point, unit),
                    None => unit,
                });
            }
        }
        result.unwrap_or_else(|| (self.number(Rational::ONE), self.number(Rational::ZERO)))
    }

    /// Is it a product of positive powers of symbols? Such monomials are linearly independent and not constant, so
    /// their exponentials and sines are algebraically independent (J. Ax, Annals of Math. 93, 1971).
    pub(super) fn is_monomial_in_symbols(&self, monomial: Expr) -> bool {
        let (_, factors) = self.factors(monomial);
        !factors.is_empty()
            && factors.iter().all(|(base, exponent)| {
                let symbol = self
                    .graph
                    .as_symbol(*base)
                    .is_some_and(|s| !self.dependent.contains_key(&s));
                symbol && exponent.is_int() && !rational::is_negative(exponent)
            })
    }
}
