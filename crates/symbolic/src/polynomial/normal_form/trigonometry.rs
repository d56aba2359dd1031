//! Sines, cosines, their hyperbolic relatives and exponentials of sums and multiples of arguments.

use dashu_base::{Gcd, Sign};
use dashu_int::IBig;

use super::super::monomial::Monomial;
use super::super::rational_function::RationalFunction;
use super::super::sparse::Polynomial;
use super::field::{BaseArgument, Field, Kind};
use super::Stop;
use crate::rational::{self, Rational};
use crate::{Expr, Function, Node};

/// Which pair of functions: the sign is that in `s² = ±(1 - c²)`.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Pair {
    Circular,
    Hyperbolic,
}

impl Field<'_> {
    /// Sine and cosine (or their hyperbolic relatives) of an argument given by form and expression.
    pub(super) fn pair(
        &mut self,
        which: Pair,
        form: &RationalFunction,
        expr: Expr,
    ) -> Result<(RationalFunction, RationalFunction), Stop> {
        if which == Pair::Hyperbolic && self.options.expand_hyperbolic {
            return self.hyperbolic_by_exponentials(form, expr);
        }
        let (form, turn) = match which {
            Pair::Circular => self.split_turn(form)?,
            Pair::Hyperbolic => (form.clone(), None),
        };
        let (mut s, mut c) = self.pair_of_combination(which, &form, expr, turn.as_ref())?;
        if let Some(turn) = turn {
            let (sin, cos) = self.pair_of_turn(&turn)?;
            let sum = |f: &Self,
                       a: (&RationalFunction, &RationalFunction),
                       b: (&RationalFunction, &RationalFunction)| {
                f.add(&f.mul(a.0, a.1)?, &f.mul(b.0, b.1)?)
            };
            (s, c) = (
                sum(self, (&s, &cos), (&c, &sin))?,
                sum(self, (&c, &cos), (&s.neg(), &sin))?,
            );
        }
        Ok((s, c))
    }

    fn hyperbolic_by_exponentials(
        &mut self,
        form: &RationalFunction,
        expr: Expr,
    ) -> Result<(RationalFunction, RationalFunction), Stop> {
        let e = self.exponential(form, expr)?;
        let inverse = e.reciprocal().ok_or(Stop::Undefined)?;
        let half = RationalFunction::constant(&half());
        let s = self.mul(&half, &self.sub(&e, &inverse)?)?;
        let c = self.mul(&half, &self.add(&e, &inverse)?)?;
        Ok((s, c))
    }

    /// Splits off `r π` when the sine of `r π` is known exactly.
    fn split_turn(
        &self,
        form: &RationalFunction,
    ) -> Result<(RationalFunction, Option<Rational>), Stop> {
        let Some(pi) = self.generator_of(self.g.pi()) else {
            return Ok((form.clone(), None));
        };
        let Some(denominator) = form.denominator().as_constant() else {
            return Ok((form.clone(), None));
        };
        let monomial = Monomial::power(pi, 1);
        let term = form
            .numerator()
            .terms()
            .iter()
            .find(|(m, _)| *m == monomial);
        let Some((_, coefficient)) = term else {
            return Ok((form.clone(), None));
        };
        let turn = Rational::from_parts_signed(coefficient.clone(), denominator.clone());
        if !self.is_known_turn(&turn) {
            return Ok((form.clone(), None));
        }
        let part = Polynomial::term(monomial, coefficient.clone());
        let rest = self.fraction(form.numerator().sub(&part), form.denominator().clone())?;
        Ok((rest, Some(turn)))
    }

    fn is_known_turn(&self, turn: &Rational) -> bool {
        let twelfths = turn * rational::integer(12);
        twelfths.is_int() && {
            let angle = self.g.scale(turn, self.g.pi());
            let is_sine = |e: Expr| {
                matches!(
                    self.g.node(e),
                    Node::Apply {
                        function: Function::Sin | Function::Cos,
                        ..
                    }
                )
            };
            let sign_free = |e: Expr| match self.g.node(e) {
                Node::Product { factors, .. } => factors.iter().any(|&f| is_sine(f)),
                _ => is_sine(e),
            };
            !sign_free(self.g.sin(angle)) && !sign_free(self.g.cos(angle))
        }
    }

    fn pair_of_turn(
        &mut self,
        turn: &Rational,
    ) -> Result<(RationalFunction, RationalFunction), Stop> {
        let angle = self.g.scale(turn, self.g.pi());
        let (sin, cos) = (self.g.sin(angle), self.g.cos(angle));
        Ok((self.algebraic_number(sin)?, self.algebraic_number(cos)?))
    }

    fn pair_of_combination(
        &mut self,
        which: Pair,
        form: &RationalFunction,
        expr: Expr,
        turn: Option<&Rational>,
    ) -> Result<(RationalFunction, RationalFunction), Stop> {
        let mut s = RationalFunction::zero();
        let mut c = RationalFunction::one();
        if form.is_zero() {
            return Ok((s, c));
        }
        let expr = match turn {
            Some(turn) => self.g.sub(expr, self.g.scale(turn, self.g.pi())),
            None => expr,
        };
        for (base, multiple) in self.multiples(which, form, expr)? {
            let table = if which == Pair::Circular {
                &self.angles
            } else {
                &self.hyperbolic
            };
            let (sine, cosine) = table[base].generators;
            let (sn, cn) = self.multiple_angle(which, sine, cosine, multiple)?;
            let sign = if which == Pair::Circular {
                sn.neg()
            } else {
                sn.clone()
            };
            let next = self.add(&self.mul(&s, &cn)?, &self.mul(&c, &sn)?)?;
            c = self.add(&self.mul(&c, &cn)?, &self.mul(&s, &sign)?)?;
            s = next;
        }
        Ok((s, c))
    }

    /// The argument as a sum of integer multiples of base arguments; a new base argument if necessary.
    fn multiples(
        &mut self,
        which: Pair,
        form: &RationalFunction,
        expr: Expr,
    ) -> Result<Vec<(usize, i64)>, Stop> {
        let table = if which == Pair::Circular {
            &self.angles
        } else {
            &self.hyperbolic
        };
        let is_number = |own: &RationalFunction| {
            own.numerator().is_constant() && own.denominator().is_constant()
        };
        let is_kept = |own: &RationalFunction| !self.options.expand_numbers && is_number(own);
        if !self.options.expand_angles || is_kept(form) {
            for (i, base) in table.iter().enumerate() {
                if self.equal(&base.form, form)? {
                    return Ok(vec![(i, 1)]);
                }
                if self.equal(&base.form, &form.neg())? {
                    return Ok(vec![(i, -1)]);
                }
            }
            let base = self.add_pair(which, form, expr);
            return Ok(vec![base]);
        }
        let places: Vec<usize> = (0..table.len())
            .filter(|&i| !is_kept(&table[i].form))
            .collect();
        let basis: Vec<RationalFunction> = places.iter().map(|&i| table[i].form.clone()).collect();
        if let Some(found) = self.combination(form, &basis)? {
            let mut weights = vec![Rational::ZERO; table.len()];
            for (place, weight) in places.into_iter().zip(found) {
                weights[place] = weight;
            }
            let subdivisions: Vec<i64> = table.iter().map(|a| a.subdivision).collect();
            let hints = match which {
                Pair::Circular => &mut self.hints.angles,
                Pair::Hyperbolic => &mut self.hints.hyperbolic,
            };
            return integer_multiples(&weights, &subdivisions, hints);
        }
        let base = self.add_pair(which, form, expr);
        Ok(vec![base])
    }

    /// A new base argument; the new expression is its multiple.
    fn add_pair(&mut self, which: Pair, form: &RationalFunction, expr: Expr) -> (usize, i64) {
        let g = self.g;
        let (table, hints) = match which {
            Pair::Circular => (&self.angles, &self.hints.angles),
            Pair::Hyperbolic => (&self.hyperbolic, &self.hints.hyperbolic),
        };
        let base = table.len();
        let subdivision = hints.get(base).copied().unwrap_or(1).max(1);
        // Functions of x and -x share one node, so the sign is that of the graph's normal form.
        let negative = g.leads_negative(expr);
        let (form, expr) = if negative {
            (form.neg(), g.neg(expr))
        } else {
            (form.clone(), expr)
        };
        let unit = g.scale(&(Rational::ONE / rational::integer(subdivision)), expr);
        let (sin, cos) = match which {
            Pair::Circular => (Function::Sin, Function::Cos),
            Pair::Hyperbolic => (Function::Sinh, Function::Cosh),
        };
        let (sin, cos) = (g.apply(sin, &[unit]), g.apply(cos, &[unit]));
        let sine = self.generators.len();
        self.add_generator(sin, Kind::Sine { partner: sine + 1 });
        let cosine = self.add_generator(cos, Kind::Cosine { partner: sine });
        let square = Polynomial::term(Monomial::power(cosine, 2), IBig::ONE);
        let value = match which {
            Pair::Circular => Polynomial::one().sub(&square),
            Pair::Hyperbolic => square.sub(&Polynomial::one()),
        };
        self.relate(sine, 2, value);
        let argument = BaseArgument {
            form,
            subdivision,
            generators: (sine, cosine),
        };
        match which {
            Pair::Circular => self.angles.push(argument),
            Pair::Hyperbolic => self.hyperbolic.push(argument),
        }
        (base, if negative { -subdivision } else { subdivision })
    }

    /// Sine and cosine of n β by repeated doubling of (c + i s)^n.
    fn multiple_angle(
        &self,
        which: Pair,
        sine: usize,
        cosine: usize,
        n: i64,
    ) -> Result<(RationalFunction, RationalFunction), Stop> {
        let product =
            |a: &(Polynomial, Polynomial), b: &(Polynomial, Polynomial)| -> Result<_, Stop> {
                let m = &self.meter;
                let ss = a.0.mul(&b.0, m)?;
                let ss = if which == Pair::Circular {
                    ss.neg()
                } else {
                    ss
                };
                let s = a.0.mul(&b.1, m)?.add(&a.1.mul(&b.0, m)?);
                let c = a.1.mul(&b.1, m)?.add(&ss);
                Ok((self.reduce(s)?, self.reduce(c)?))
            };
        let mut result = (Polynomial::zero(), Polynomial::one());
        let mut power = (Polynomial::generator(sine), Polynomial::generator(cosine));
        let mut rest = n.unsigned_abs();
        loop {
            if rest & 1 == 1 {
                result = product(&result, &power)?;
            }
            rest >>= 1;
            if rest == 0 {
                break;
            }
            power = product(&power, &power)?;
        }
        let s = if n < 0 { result.0.neg() } else { result.0 };
        Ok((s.into(), result.1.into()))
    }

    /// `exp` of an argument given by form and expression.
    pub(super) fn exponential(
        &mut self,
        form: &RationalFunction,
        expr: Expr,
    ) -> Result<RationalFunction, Stop> {
        let (form, mut result) = self.split_logarithms(form)?;
        if form.is_zero() {
            return Ok(result);
        }
        let basis: Vec<RationalFunction> =
            self.exponentials.iter().map(|a| a.form.clone()).collect();
        let multiples = match self.combination(&form, &basis)? {
            Some(weights) => {
                let subdivisions: Vec<i64> =
                    self.exponentials.iter().map(|a| a.subdivision).collect();
                integer_multiples(&weights, &subdivisions, &mut self.hints.exponentials)?
            }
            None => vec![self.add_exponential(&form, expr)],
        };
        for (base, multiple) in multiples {
            let generator = self.generator(self.exponentials[base].generators.0);
            let power = self.pow(&generator, multiple)?;
            result = self.mul(&result, &power)?;
        }
        Ok(result)
    }

    fn add_exponential(&mut self, form: &RationalFunction, expr: Expr) -> (usize, i64) {
        let g = self.g;
        let base = self.exponentials.len();
        let subdivision = self
            .hints
            .exponentials
            .get(base)
            .copied()
            .unwrap_or(1)
            .max(1);
        let negative = form.is_negative();
        // What `split_logarithms` took away must not reappear in the expression of the generator.
        let expr = self.expression_or(form, expr);
        let (form, expr) = if negative {
            (form.neg(), g.neg(expr))
        } else {
            (form.clone(), expr)
        };
        let unit = g.scale(&(Rational::ONE / rational::integer(subdivision)), expr);
        let generator = self.add_generator(g.exp(unit), Kind::Exponential);
        self.exponentials.push(BaseArgument {
            form,
            subdivision,
            generators: (generator, generator),
        });
        (base, if negative { -subdivision } else { subdivision })
    }

    fn expression_or(&self, form: &RationalFunction, expr: Expr) -> Expr {
        let log = |g: &super::field::Generator| {
            matches!(
                self.g.node(g.expr),
                Node::Apply {
                    function: Function::Log,
                    ..
                }
            )
        };
        if self.generators.iter().any(log) {
            self.expression(form)
        } else {
            expr
        }
    }

    /// `exp(r log B) = B^r` for every summand `r log B` with rational r.
    fn split_logarithms(
        &mut self,
        form: &RationalFunction,
    ) -> Result<(RationalFunction, RationalFunction), Stop> {
        let mut powers = RationalFunction::one();
        let Some(denominator) = form.denominator().as_constant().cloned() else {
            return Ok((form.clone(), powers));
        };
        let logs: Vec<(RationalFunction, usize)> = self
            .opaque
            .iter()
            .filter(|(function, _, _)| *function == Function::Log)
            .map(|(_, arguments, generator)| (arguments[0].clone(), *generator))
            .collect();
        let mut rest = form.numerator().clone();
        for (base, generator) in logs {
            let monomial = Monomial::power(generator, 1);
            let Some((_, c)) = rest.terms().iter().find(|(m, _)| *m == monomial).cloned() else {
                continue;
            };
            rest = rest.sub(&Polynomial::term(monomial, c.clone()));
            let exponent = Rational::from_parts_signed(c, denominator.clone());
            let power = self.rational_power(&base, &exponent, None)?;
            powers = self.mul(&powers, &power)?;
        }
        let rest = self.fraction(rest, Polynomial::constant(denominator))?;
        Ok((rest, powers))
    }
}

fn half() -> Rational {
    Rational::from_parts(IBig::ONE, 2u8.into())
}

/// Integer multiples of the subdivided base arguments; asks for finer subdivisions where these are not integers.
fn integer_multiples(
    weights: &[Rational],
    subdivisions: &[i64],
    hints: &mut Vec<i64>,
) -> Result<Vec<(usize, i64)>, Stop> {
    let mut multiples = Vec::new();
    let mut refine = false;
    for (i, (weight, &subdivision)) in weights.iter().zip(subdivisions).enumerate() {
        if weight.is_zero() {
            continue;
        }
        let multiple = weight * rational::integer(subdivision);
        match rational::to_i64(&multiple) {
            Some(n) => multiples.push((i, n)),
            None => {
                let finer = finer(weight, subdivision)?;
                if hints.len() <= i {
                    hints.resize(i + 1, 1);
                }
                hints[i] = finer;
                refine = true;
            }
        }
    }
    if refine {
        return Err(Stop::Refine);
    }
    Ok(multiples)
}

/// The least common multiple of a subdivision and the denominator of a weight.
fn finer(weight: &Rational, subdivision: i64) -> Result<i64, Stop> {
    const LIMIT: i64 = 4096;
    let too_fine = Stop::TooLarge(super::super::budget::TooLarge::Degree {
        limit: LIMIT as u32,
    });
    let denominator = i64::try_from(IBig::from_parts(
        Sign::Positive,
        weight.denominator().clone(),
    ));
    let Ok(denominator) = denominator else {
        return Err(too_fine);
    };
    if denominator > LIMIT {
        return Err(too_fine);
    }
    let common = (denominator.unsigned_abs()).gcd(subdivision.unsigned_abs()) as i64;
    let lcm = denominator / common * subdivision;
    if lcm > LIMIT || lcm <= subdivision {
        return Err(too_fine);
    }
    Ok(lcm)
}
