//! Real zeros of polynomials that nowhere change their sign, as `x² + y²` or `(x − y)² + (1 − cos θ)²`.
//!
//! Such a polynomial has an extremum at each of its real zeros, so that there all of its derivatives vanish too: over the complex numbers its zeros
//! are a family, over the real ones points of it at most (Bochnak, Coste, Roy 1998, *Real algebraic geometry*, § 4.5). That a polynomial does not
//! change its sign is proved by squares: terms of even powers with coefficients of one sign, no real zero in one variable, or a leading coefficient
//! and a discriminant of opposite signs in one of degree two. Angles are put in by the tangents of their halves.

use crate::real_zeros::real_zeros;
use crate::steady_value::{precision, Generators, Unknown};
use chetaev_symbolic::number::ball::Ball;
use chetaev_symbolic::polynomial::{
    triangular_systems, Budget, Meter, Monomial, Polynomial, TooLarge, TriangularSystem, Vanish,
};
use dashu_int::IBig;
use dashu_ratio::RBig;

/// Triangular systems with what their real zeros have besides.
pub(crate) struct RealParts<'a> {
    /// What vanishes in all of them.
    pub(crate) vanishing: &'a [Polynomial],
    pub(crate) unknowns: &'a [Unknown],
    /// The generators that are determined, in this order.
    pub(crate) order: &'a [usize],
    /// Which polynomials in numbers alone are zero.
    pub(crate) vanish: Vanish<'a>,
}

impl RealParts<'_> {
    /// Triangular systems with the same real zeros: a family of complex ones whose real ones are points of it is replaced by these. Where that
    /// is too much work the family stays as it is, which has the same real zeros too.
    pub(crate) fn of(&self, systems: Vec<TriangularSystem>) -> Vec<TriangularSystem> {
        let meter = Meter::new(Budget::DISPLAY);
        let (mut open, mut found) = (systems, Vec::new());
        while let Some(system) = open.pop() {
            let Ok(Some(parts)) = self.parts(&system, &meter) else {
                found.push(system);
                continue;
            };
            // Of `1 − cos θ` the derivative vanishes wherever it does itself.
            let (same, other): (Vec<_>, Vec<_>) = parts
                .into_iter()
                .partition(|part| part.equations == system.equations);
            found.extend(same);
            open.extend(other);
        }
        found.reverse();
        found
    }

    /// The parts of a family with real zeros; `None` where nothing besides its equations is known to vanish at these.
    fn parts(
        &self,
        system: &TriangularSystem,
        meter: &Meter,
    ) -> Result<Option<Vec<TriangularSystem>>, TooLarge> {
        let further = self.vanishing_with(system, meter)?;
        if further.is_empty() {
            return Ok(None);
        }
        let equations = system.equations.iter().map(|(_, p)| p.clone());
        let own = self.vanishing.iter().cloned();
        let all: Vec<Polynomial> = own.chain(equations).chain(further).collect();
        triangular_systems(&all, &system.nonzero, self.order, (self.vanish, meter)).map(Some)
    }

    /// What vanishes at the real zeros of a family besides its equations.
    fn vanishing_with(
        &self,
        system: &TriangularSystem,
        meter: &Meter,
    ) -> Result<Vec<Polynomial>, TooLarge> {
        let is_determined = |at: &usize| system.equations.iter().any(|(own, _)| own == at);
        let mut known: Vec<usize> = Vec::new();
        let mut is_family = false;
        for unknown in self.unknowns {
            let own = match unknown.by {
                Generators::None => continue,
                Generators::Own(at) => vec![at],
                Generators::Angle { cosine, sine, .. } => vec![cosine, sine],
            };
            is_family |= !own.iter().all(is_determined);
            known.extend(own);
        }
        if !is_family {
            return Ok(Vec::new());
        }
        // What else is determined is a root, which moves with what is under it.
        let is_plain = |p: &Polynomial| {
            let mut own = p.generators().into_iter();
            own.all(|at| known.contains(&at) || !self.order.contains(&at))
        };
        let mut equations = system.equations.iter().filter(|(_, p)| is_plain(p));
        equations.try_fold(Vec::new(), |mut found, (_, p)| {
            found.extend(vanishing_with(p, self.unknowns, meter)?);
            Ok(found)
        })
    }
}

/// What vanishes with a polynomial at real zeros because it nowhere changes its sign: its derivatives by the unknowns; none where it is not known
/// that it does not.
pub(crate) fn vanishing_with(
    p: &Polynomial,
    unknowns: &[Unknown],
    meter: &Meter,
) -> Result<Vec<Polynomial>, TooLarge> {
    let mut own = p.clone();
    for unknown in unknowns {
        if let Generators::Angle { cosine, sine, .. } = unknown.by {
            own = by_half_tangent(&own, (cosine, sine), meter)?;
        }
    }
    if !is_semidefinite(&own, meter)? {
        return Ok(Vec::new());
    }
    let mut found = Vec::new();
    for unknown in unknowns {
        found.push(match unknown.by {
            Generators::None => continue,
            Generators::Own(at) => p.derivative(at),
            Generators::Angle { cosine, sine, .. } => by_angle(p, (cosine, sine), meter)?,
        });
    }
    found.retain(|own| !own.is_zero());
    Ok(found)
}

/// The derivative by an angle, in what of its cosine and its sine occurs, but for a factor that vanishes with it.
fn by_angle(
    p: &Polynomial,
    (cosine, sine): (usize, usize),
    meter: &Meter,
) -> Result<Polynomial, TooLarge> {
    let (by_cosine, by_sine) = (p.derivative(cosine), p.derivative(sine));
    let other = |at: usize| {
        let square = Polynomial::generator(at).pow(2, meter)?;
        Ok::<Polynomial, TooLarge>(Polynomial::one().sub(&square))
    };
    if by_sine.is_zero() {
        return by_cosine.mul(&other(cosine)?, meter);
    }
    if by_cosine.is_zero() {
        return by_sine.mul(&other(sine)?, meter);
    }
    let first = by_sine.mul(&Polynomial::generator(cosine), meter)?;
    Ok(first.sub(&by_cosine.mul(&Polynomial::generator(sine), meter)?))
}

/// A polynomial in cosine and sine as one in t, the tangent of half the angle, which takes the place of the cosine: `(1 − t²)/(1 + t²)` and
/// `2 t/(1 + t²)`, times a power of `1 + t²`, which is positive.
fn by_half_tangent(
    p: &Polynomial,
    (cosine, sine): (usize, usize),
    meter: &Meter,
) -> Result<Polynomial, TooLarge> {
    let of = |monomial: &Monomial| [monomial.exponent(cosine), monomial.exponent(sine)];
    let degree = p.terms().iter().map(|(m, _)| of(m).into_iter().sum()).max();
    let Some(degree) = degree.filter(|&d: &u16| d > 0) else {
        return Ok(p.clone());
    };
    let t = Polynomial::generator(cosine);
    let square = t.pow(2, meter)?;
    let sum = Polynomial::one().add(&square);
    let (above_cosine, above_sine) = (Polynomial::one().sub(&square), t.scale(&IBig::from(2)));
    let mut found = Polynomial::zero();
    for (monomial, coefficient) in p.terms() {
        let [i, j] = of(monomial);
        let rest = monomial.with_exponent(cosine, 0).with_exponent(sine, 0);
        let mut term = Polynomial::term(rest, coefficient.clone());
        for (base, n) in [(&above_cosine, i), (&above_sine, j), (&sum, degree - i - j)] {
            term = term.mul(&base.pow(u32::from(n), meter)?, meter)?;
        }
        found = found.add(&term);
    }
    Ok(found)
}

/// Whether a polynomial is proved to take no values of opposite signs.
fn is_semidefinite(p: &Polynomial, meter: &Meter) -> Result<bool, TooLarge> {
    Ok(is_nowhere_negative(p, meter)? || is_nowhere_negative(&p.neg(), meter)?)
}

/// Whether a polynomial is proved to be nowhere negative for real values of its generators.
fn is_nowhere_negative(p: &Polynomial, meter: &Meter) -> Result<bool, TooLarge> {
    let own = p.factorize(meter)?;
    let mut odd = Polynomial::constant(own.content);
    for (factor, _) in own.factors.iter().filter(|(_, n)| n % 2 == 1) {
        odd = odd.mul(factor, meter)?;
    }
    let generators = odd.generators();
    if generators.iter().any(|&at| odd.degree_in(at) % 2 == 1) {
        return Ok(false);
    }
    let is_even = |m: &Monomial| m.iter().all(|(_, n)| n % 2 == 0);
    let mut terms = odd.terms().iter();
    if terms.all(|(m, c)| *c >= IBig::ZERO && is_even(m)) {
        return Ok(true);
    }
    if let [only] = generators[..] {
        return Ok(is_positive_in(&odd, only));
    }
    for &at in generators.iter().filter(|&&at| odd.degree_in(at) == 2) {
        let [c, b, a] = [0, 1, 2].map(|n| odd.coefficient_in(at, n));
        let products = a.mul(&c, meter)?.scale(&IBig::from(4));
        let below = products.sub(&b.mul(&b, meter)?);
        if is_nowhere_negative(&a, meter)? && is_nowhere_negative(&below, meter)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether a polynomial of one generator without multiple factors has no real zero and a positive leading coefficient.
fn is_positive_in(p: &Polynomial, generator: usize) -> bool {
    let coefficient = |n: u16| {
        let own = p.coefficient_in(generator, n);
        if own.is_zero() {
            return Some(Ball::zero());
        }
        let own = own.as_constant()?;
        Some(precision().rational(&RBig::from(own.clone())))
    };
    let all: Option<Vec<Ball>> = (0..=p.degree_in(generator)).map(coefficient).collect();
    let zeros = all.and_then(|all| real_zeros(&precision(), &all));
    !p.is_negative() && zeros.is_some_and(|all| all.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial(terms: &[(&[u16], i64)]) -> Polynomial {
        let of = |(n, c): &(&[u16], i64)| (Monomial::from_exponents(n), IBig::from(*c));
        Polynomial::from_terms(terms.iter().map(of).collect())
    }

    /// x² + y², x² + x y + y², (x − y)², x⁴ − x + 1, x² y² + 1, Robinson's kind (x² + y² + z²) and their negatives do not change their signs; x² − y²,
    /// x² + 3 x y + y², x² y + 1 and x⁴ − x do.
    #[test]
    fn signs_are_proved_by_squares() {
        let meter = Meter::new(Budget::PROOF);
        let definite: &[&[(&[u16], i64)]] = &[
            &[(&[2], 1), (&[0, 2], 1)],
            &[(&[2], 1), (&[1, 1], 1), (&[0, 2], 1)],
            &[(&[2], 1), (&[1, 1], -2), (&[0, 2], 1)],
            &[(&[4], 1), (&[1], -1), (&[], 1)],
            &[(&[2, 2], 1), (&[], 1)],
            &[
                (&[2], 2),
                (&[1, 1], 2),
                (&[0, 2], 2),
                (&[0, 1, 1], 2),
                (&[0, 0, 2], 1),
            ],
        ];
        for terms in definite {
            let p = polynomial(terms);
            assert!(is_semidefinite(&p, &meter).unwrap_or(false), "{terms:?}");
            assert!(
                is_semidefinite(&p.neg(), &meter).unwrap_or(false),
                "{terms:?}"
            );
        }
        let others: &[&[(&[u16], i64)]] = &[
            &[(&[2], 1), (&[0, 2], -1)],
            &[(&[2], 1), (&[1, 1], 3), (&[0, 2], 1)],
            &[(&[2, 1], 1), (&[], 1)],
            &[(&[4], 1), (&[1], -1)],
        ];
        for terms in others {
            assert!(
                !is_semidefinite(&polynomial(terms), &meter).unwrap_or(true),
                "{terms:?}"
            );
        }
    }
}
