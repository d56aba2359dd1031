//! The real zeros of a triangular system: unknown by unknown, as numbers where none is free before, else as functions of the free ones.

use crate::exact_zeros::{closed_forms, ExactZeros};
use crate::real_zeros::real_zeros;
use crate::steady::closed;
use crate::steady_value::{fraction, precision, Generators, SteadySetError, Unknown, Value};
use chetaev_mechanics::System;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::polynomial::normal_form::{Field, Kind};
use chetaev_symbolic::polynomial::{Polynomial, TriangularSystem};
use chetaev_symbolic::{Expr, Function, Graph, Symbol};
use dashu_int::IBig;
use dashu_ratio::RBig;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Places at which a family is looked at for a real point.
const SAMPLES: usize = 120;
/// The sizes of these places, in turn, as powers of ten: a family may be bounded, in units of atoms or of orbits.
const SCALES: [i64; 12] = [0, -1, 0, -2, 1, -4, 0, 4, -8, 8, -12, 12];

/// A triangular system with what its generators mean.
pub(crate) struct Chain<'a, 'g> {
    pub(crate) system: &'a System,
    pub(crate) field: &'a Field<'g>,
    pub(crate) unknowns: &'a [Unknown],
    /// The generators that are determined, in this order.
    pub(crate) order: &'a [usize],
    /// What holds for sines and roots whatever the equations.
    pub(crate) relations: &'a [Polynomial],
    pub(crate) equations: &'a TriangularSystem,
}

/// One choice of a zero for each generator.
#[derive(Clone, Debug, Default)]
pub(crate) struct Branch {
    exact: BTreeMap<usize, Expr>,
    balls: BTreeMap<usize, Ball>,
    /// The symbols of free unknowns, with the places of these.
    pub(crate) free: Vec<(Expr, usize)>,
    /// What is under square roots.
    pub(crate) conditions: Vec<Expr>,
}

/// Numbers for parameters and free unknowns.
struct Sample {
    parameters: Vec<(Symbol, Ball)>,
    free: BTreeMap<usize, Ball>,
}

impl Chain<'_, '_> {
    /// All branches with real zeros.
    pub(crate) fn branches(&self) -> Result<Vec<Branch>, SteadySetError> {
        let mut found = self.followed(None)?;
        for branch in &mut found {
            for (at, own) in self.unknowns.iter().enumerate() {
                if matches!(own.by, Generators::None) {
                    branch.free.push((self.free_symbol(at), at));
                }
            }
        }
        Ok(found)
    }

    /// Whether a zero with real values of all unknowns is known.
    pub(crate) fn has_real_point(&self) -> bool {
        let g = self.field.graph();
        let precision = precision();
        let stated = self.system.parameter_values().into_iter();
        let parameters: Vec<(Symbol, Ball)> = stated
            .filter_map(|(symbol, value)| {
                let ball = g.enclose(&[value], &precision, &|_| None).ok()?.pop()?;
                Some((g.as_symbol(symbol)?, ball))
            })
            .collect();
        let mut random = Random::new(0x57ea_d1e5);
        let scales = SCALES.iter().cycle();
        scales.take(SAMPLES).any(|&scale| {
            let free = self.order.iter().map(|&generator| {
                let value = random.between(-1_000, 1_000);
                (generator, self.placed(generator, value, scale))
            });
            let sample = Sample {
                free: free.collect(),
                parameters: parameters.clone(),
            };
            let found = self.followed(Some(&sample));
            found.is_ok_and(|found| !found.is_empty())
        })
    }

    /// A place of a free generator, of the size of a power of ten; cosines by the tangent of half the angle.
    fn placed(&self, generator: usize, value: i64, scale: i64) -> Ball {
        let p = precision();
        let ratio = |a: i64, b: i64| p.div(&Ball::integer(a), &Ball::integer(b));
        let power = p.rational(&RBig::from(
            IBig::from(10).pow(scale.unsigned_abs() as usize),
        ));
        let place = match self.field.generators()[generator].kind {
            Kind::Cosine { .. } => ratio(250_000 - value * value, 250_000 + value * value),
            _ if scale < 0 => ratio(value, 50).and_then(|own| p.div(&own, &power)),
            _ => ratio(value, 50).and_then(|own| p.mul(&own, &power)),
        };
        place.unwrap_or_else(|_| Ball::zero())
    }

    fn followed(&self, sample: Option<&Sample>) -> Result<Vec<Branch>, SteadySetError> {
        let mut all = vec![Branch::default()];
        for &generator in self.order {
            let mut next = Vec::new();
            for branch in all {
                next.extend(self.extended(branch, generator, sample)?);
            }
            all = next;
        }
        let g = self.field.graph();
        let vanishes = |branch: &Branch, p: &Polynomial| {
            let ball = self.ball(p, branch, sample);
            let is_near = ball.is_some_and(|ball| !ball.excludes_zero());
            is_near
                && match self.exact(p, branch) {
                    Some(e) => g.is_zero(closed(g, e)),
                    None => false,
                }
        };
        all.retain(|branch| {
            let mut all = self.equations.nonzero.iter();
            !all.any(|p| vanishes(branch, p))
        });
        Ok(all)
    }

    /// The branches with a value for one more generator.
    fn extended(
        &self,
        mut branch: Branch,
        generator: usize,
        sample: Option<&Sample>,
    ) -> Result<Vec<Branch>, SteadySetError> {
        if self.is_number(generator) {
            return Ok(vec![branch]);
        }
        let mut equations = self.equations.equations.iter();
        match equations.find(|(own, _)| *own == generator) {
            None => {
                match sample {
                    Some(sample) => {
                        let place = sample.free.get(&generator).cloned();
                        branch.balls.extend(place.map(|ball| (generator, ball)));
                    }
                    None => self.set_free(&mut branch, generator),
                }
                Ok(vec![branch])
            }
            Some((_, p)) => self.solved(branch, (generator, p), sample),
        }
    }

    /// A free generator is a function of a parameter of the family.
    fn set_free(&self, branch: &mut Branch, generator: usize) {
        let g = self.field.graph();
        let is_own = |own: &Unknown| match own.by {
            Generators::Own(at) | Generators::Angle { cosine: at, .. } => at == generator,
            Generators::None => false,
        };
        let Some(at) = self.unknowns.iter().position(is_own) else {
            return;
        };
        let symbol = self.free_symbol(at);
        branch.free.push((symbol, at));
        match self.unknowns[at].by {
            Generators::Angle {
                cosine,
                sine,
                times,
            } => {
                let angle = g.mul(&[fraction(g, times), symbol]);
                branch.exact.insert(cosine, g.cos(angle));
                branch.exact.insert(sine, g.sin(angle));
            }
            _ => {
                branch.exact.insert(generator, symbol);
            }
        }
    }

    /// A name for the value of an unknown, one that the system does not have.
    fn free_symbol(&self, at: usize) -> Expr {
        let g = self.field.graph();
        let own = self.unknowns[at].name.replace('\'', "_rate");
        let is_plain = own.chars().all(|c| c.is_alphanumeric() || c == '_');
        let mut name = if is_plain {
            format!("{own}_0")
        } else {
            format!("speed_{at}")
        };
        let (system, field) = (self.system, self.field.graph());
        let coordinates = system.coordinates.iter().map(|c| c.name.clone());
        let parameters = system.parameters.iter().map(|p| p.name.clone());
        let definitions = system.definitions.iter().map(|(e, _)| field.text(*e));
        let controls = system.controls.iter().map(|c| c.name.clone());
        let named = parameters.chain(definitions).chain(controls);
        let taken: Vec<String> = coordinates.chain(named).collect();
        while taken.contains(&name) {
            name.push('0');
        }
        g.symbol(&name, 0)
    }

    /// The zeros of a polynomial in one generator.
    fn solved(
        &self,
        branch: Branch,
        (generator, p): (usize, &Polynomial),
        sample: Option<&Sample>,
    ) -> Result<Vec<Branch>, SteadySetError> {
        if branch.exact.contains_key(&generator) {
            // The sine of a free angle.
            return Ok(vec![branch]);
        }
        let coefficients: Vec<Polynomial> = (0..=p.degree_in(generator))
            .map(|n| p.coefficient_in(generator, n))
            .collect();
        let balls = coefficients.iter().map(|c| self.ball(c, &branch, sample));
        let exact = coefficients.iter().map(|c| self.exact(c, &branch));
        let exact: Option<Vec<Expr>> = exact.collect();
        match balls.collect::<Option<Vec<Ball>>>() {
            Some(balls) => self.numbers(branch, generator, (&balls, exact.as_deref())),
            None => {
                // Of its own square a root is the positive one.
                let is_own = self.is_root(generator) && self.relations.contains(p);
                Ok(self.functions(branch, (generator, is_own), exact.as_deref()))
            }
        }
    }

    fn numbers(
        &self,
        branch: Branch,
        generator: usize,
        (balls, exact): (&[Ball], Option<&[Expr]>),
    ) -> Result<Vec<Branch>, SteadySetError> {
        let g = self.field.graph();
        let found = real_zeros(&precision(), balls).ok_or_else(|| {
            let own = self.field.generators()[generator].expr;
            SteadySetError::NotEnclosed {
                polynomial: format!("a polynomial in {}", g.text(own)),
            }
        })?;
        let exact = ExactZeros::of(g, exact.unwrap_or_default());
        let mut all = Vec::new();
        for ball in found {
            match ball.sign() {
                Some(Ordering::Less) if self.is_root(generator) => continue,
                // Whether it is negative was not decided.
                None if self.is_root(generator) => {
                    let own = self.field.generators()[generator].expr;
                    return Err(SteadySetError::NotEnclosed {
                        polynomial: format!("an equation for {}", g.text(own)),
                    });
                }
                _ => {}
            }
            let mut own = branch.clone();
            own.exact.extend(exact.at(g, &ball).map(|e| (generator, e)));
            own.balls.insert(generator, ball);
            all.push(own);
        }
        Ok(all)
    }

    /// Closed forms by free unknowns and parameters; the branch as it is where there are none.
    fn functions(
        &self,
        branch: Branch,
        (generator, is_own): (usize, bool),
        exact: Option<&[Expr]>,
    ) -> Vec<Branch> {
        let g = self.field.graph();
        let forms = exact.map(|own| closed_forms(g, own)).unwrap_or_default();
        if forms.is_empty() {
            return vec![branch];
        }
        let is_positive = is_own && forms.len() == 2;
        // By another equation a root is what must not be negative.
        let is_restricted = self.is_root(generator) && !is_positive;
        let with = |(form, condition): (Expr, Option<Expr>)| {
            let mut own = branch.clone();
            own.exact.insert(generator, form);
            own.conditions.extend(condition);
            if is_restricted {
                own.conditions.push(form);
            }
            own
        };
        let count = if is_positive { 1 } else { 2 };
        forms.into_iter().take(count).map(with).collect()
    }

    /// Whether a generator is a root or an absolute value, and so not negative: odd roots too are those of numbers that are not negative.
    fn is_root(&self, generator: usize) -> bool {
        let kind = &self.field.generators()[generator].kind;
        matches!(kind, Kind::Absolute | Kind::Radical { .. })
    }

    /// Whether no unknown occurs in a generator.
    fn is_number(&self, generator: usize) -> bool {
        let g = self.field.graph();
        let symbols: Vec<Symbol> = self.unknowns.iter().map(|u| u.symbol).collect();
        !g.contains_any(self.field.generators()[generator].expr, &symbols)
    }

    /// The value of a polynomial, where all of its generators have numbers.
    fn ball(&self, p: &Polynomial, branch: &Branch, sample: Option<&Sample>) -> Option<Ball> {
        let precision = precision();
        let g = self.field.graph();
        let parameter = |s: Symbol| {
            let mut own = sample.iter().flat_map(|sample| &sample.parameters);
            own.find(|(own, _)| *own == s).map(|(_, ball)| ball.clone())
        };
        let value = |generator: usize| -> Option<Ball> {
            if let Some(ball) = branch.balls.get(&generator) {
                return Some(ball.clone());
            }
            if !self.is_number(generator) {
                return None;
            }
            let own = self.field.generators()[generator].expr;
            g.enclose(&[own], &precision, &parameter).ok()?.pop()
        };
        let mut sum = Ball::zero();
        for (monomial, coefficient) in p.terms() {
            let mut term = precision.rational(&coefficient.clone().into());
            for (generator, exponent) in monomial.iter() {
                let power = precision
                    .powi(&value(generator)?, &IBig::from(exponent))
                    .ok()?;
                term = precision.mul(&term, &power).ok()?;
            }
            sum = precision.add(&sum, &term).ok()?;
        }
        Some(sum)
    }

    /// A polynomial with the closed forms of its generators.
    fn exact(&self, p: &Polynomial, branch: &Branch) -> Option<Expr> {
        let g = self.field.graph();
        let value = |generator: usize| {
            let known = branch.exact.get(&generator).copied();
            let own = self.field.generators()[generator].expr;
            known.or_else(|| self.is_number(generator).then_some(own))
        };
        let mut terms = Vec::new();
        for (monomial, coefficient) in p.terms() {
            let mut factors = vec![g.number(coefficient.clone().into())];
            for (generator, exponent) in monomial.iter() {
                factors.push(g.powi(value(generator)?, i64::from(exponent)));
            }
            terms.push(g.mul(&factors));
        }
        Some(g.add(&terms))
    }

    /// The values of the unknowns.
    pub(crate) fn values(&self, branch: &Branch) -> Vec<Value> {
        let all = self.unknowns.iter().enumerate();
        all.map(|(at, own)| self.value(branch, at, own)).collect()
    }

    fn value(&self, branch: &Branch, at: usize, own: &Unknown) -> Value {
        if let Some((symbol, _)) = branch.free.iter().find(|(_, free)| *free == at) {
            return Value::Function(*symbol);
        }
        let (ball, exact) = match own.by {
            Generators::Own(generator) => (
                branch.balls.get(&generator).cloned(),
                branch.exact.get(&generator).copied(),
            ),
            Generators::Angle {
                cosine,
                sine,
                times,
            } => {
                let exact = self.angle(branch, (cosine, sine), times);
                let balls = branch.balls.get(&cosine).zip(branch.balls.get(&sine));
                let ball = balls.and_then(|balls| angle_ball(&precision(), balls, times));
                (ball, exact)
            }
            Generators::None => (None, None),
        };
        match (ball, exact) {
            (Some(ball), exact) => Value::Number { exact, ball },
            (None, Some(e)) => Value::Function(e),
            (None, None) => Value::Tied,
        }
    }

    /// An angle by the closed forms of its cosine and sine.
    fn angle(
        &self,
        branch: &Branch,
        (cosine, sine): (usize, usize),
        times: (i64, i64),
    ) -> Option<Expr> {
        let g = self.field.graph();
        let (c, s) = (*branch.exact.get(&cosine)?, *branch.exact.get(&sine)?);
        let is = |e: Expr, value: i64| e == g.integer(value);
        let same = |a: Expr, b: Expr| g.is_zero(closed(g, g.sub(a, b)));
        let root = sine_of(g, c);
        let sign = match branch.balls.get(&sine) {
            Some(ball) => Some(ball.sign()?),
            None if same(s, root) => Some(Ordering::Greater),
            None if same(s, g.neg(root)) => Some(Ordering::Less),
            // Its sign changes along the family.
            None => None,
        };
        let turn = |part: i64| g.mul(&[fraction(g, (part, 2)), g.pi()]);
        let angle = match sign {
            None => self.angle_of(branch, (c, s)),
            Some(Ordering::Equal) if is(c, 1) => g.zero(),
            Some(Ordering::Equal) => turn(2),
            Some(Ordering::Greater) if is(c, 0) => turn(1),
            Some(Ordering::Less) if is(c, 0) => turn(-1),
            Some(Ordering::Greater) => g.apply(Function::Acos, &[c]),
            Some(Ordering::Less) => g.neg(g.apply(Function::Acos, &[c])),
        };
        Some(g.mul(&[fraction(g, (times.1, times.0)), angle]))
    }

    /// The angle of a point of the unit circle given by functions: that of a free angle, the same half a turn further, or its opposite, where it is
    /// one of these.
    fn angle_of(&self, branch: &Branch, (c, s): (Expr, Expr)) -> Expr {
        let g = self.field.graph();
        let same = |a: Expr, b: Expr| g.is_zero(closed(g, g.sub(a, b)));
        let mut known = branch.free.iter().flat_map(|&(symbol, _)| {
            let further = g.add(&[symbol, g.pi()]);
            [symbol, further, g.neg(symbol), g.sub(g.pi(), symbol)]
        });
        known
            .find(|&angle| same(c, g.cos(angle)) && same(s, g.sin(angle)))
            .unwrap_or_else(|| g.apply(Function::Atan2, &[s, c]))
    }

    /// Equations whose generators have no value, without those that always hold.
    pub(crate) fn open_equations(&self, branch: &Branch) -> Vec<Expr> {
        let all = self.equations.equations.iter();
        let is_known = |generator: &usize| {
            branch.exact.contains_key(generator) || branch.balls.contains_key(generator)
        };
        let open = all.filter(|(generator, p)| {
            !is_known(generator) && !self.is_number(*generator) && !self.relations.contains(p)
        });
        open.map(|(_, p)| self.field.polynomial_expression(p))
            .collect()
    }
}

/// √(1 − c²).
fn sine_of(g: &Graph, c: Expr) -> Expr {
    g.sqrt(g.sub(g.one(), g.powi(c, 2)))
}

/// The angle of a point of the unit circle, divided.
fn angle_ball(p: &Precision, (c, s): (&Ball, &Ball), (above, below): (i64, i64)) -> Option<Ball> {
    let angle = p.atan2(s, c).ok()?;
    let scaled = p.mul(&angle, &Ball::integer(below)).ok()?;
    p.div(&scaled, &Ball::integer(above)).ok()
}
