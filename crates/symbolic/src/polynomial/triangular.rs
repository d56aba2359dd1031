//! The common zeros of polynomials as a union of triangular systems: elimination by pseudo-division, split where an initial may vanish
//! and where a polynomial has factors.
//!
//! Source: Wu Wen-tsün, J. Automated Reasoning 2 (1986) 221-252; D. Wang, J. Symb. Comp. 16 (1993) 83-114.

use super::budget::{Meter, TooLarge};
use super::monomial::Monomial;
use super::sparse::Polynomial;
use dashu_int::IBig;

/// More branches than this are not followed: a system of mechanics has some tens.
const BRANCHES: u64 = 2_000;

/// Equations, of which each determines one generator by those before it, together with what does not vanish.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TriangularSystem {
    /// The generator that an equation determines, and the polynomial that vanishes; ascending in the order of elimination.
    pub equations: Vec<(usize, Polynomial)>,
    /// Irreducible polynomials that do not vanish, among them all factors of the initials.
    pub nonzero: Vec<Polynomial>,
}

/// Triangular systems whose zeros are together the common zeros of `polynomials` at which no polynomial of `nonzero` vanishes. None of them
/// contains another whose equations can be solved everywhere. `order` has the generators to be determined, those that are eliminated last first; all others are parameters in general
/// position, of which no polynomial but 0 vanishes, or numbers: of a polynomial in numbers alone `vanish` says whether it is zero.
///
/// # Errors
/// [`TooLarge`] when the work exceeds the budget, or more than some thousand branches are needed.
pub fn triangular_systems(
    polynomials: &[Polynomial],
    nonzero: &[Polynomial],
    order: &[usize],
    (vanish, meter): (Vanish<'_>, &Meter),
) -> Result<Vec<TriangularSystem>, TooLarge> {
    let elimination = Elimination {
        order,
        vanish,
        meter,
    };
    let mut start = vec![Branch {
        nonzero: nonzero_factors(nonzero, meter)?,
        ..Branch::default()
    }];
    for p in polynomials {
        let mut next = Vec::new();
        for branch in start {
            next.extend(elimination.with(branch, p)?);
        }
        start = next;
    }
    let (mut open, mut found, mut count) = (start, Vec::new(), 0);
    while let Some(branch) = open.pop() {
        count += 1;
        if count > BRANCHES {
            return Err(TooLarge::Work { limit: BRANCHES });
        }
        match elimination.step(branch)? {
            Step::Further(branches) => open.extend(branches),
            Step::Done(system) => found.push(system),
        }
    }
    let given = &nonzero_factors(nonzero, meter)?;
    elimination.without_contained(found, given)
}

/// Whether a polynomial in numbers alone is zero; `None` where other generators occur in it, or that is not known.
pub type Vanish<'a> = &'a dyn Fn(&Polynomial) -> Option<bool>;

fn nonzero_factors(nonzero: &[Polynomial], meter: &Meter) -> Result<Vec<Polynomial>, TooLarge> {
    let mut all = Vec::new();
    for p in nonzero {
        all.extend(factors(p, meter)?);
    }
    Ok(all)
}

/// Irreducible factors; where a polynomial is too large for them those that greatest common divisors show.
fn factors(p: &Polynomial, meter: &Meter) -> Result<Vec<Polynomial>, TooLarge> {
    let found = match p.irreducible_factors(meter) {
        Ok(found) => found,
        Err(_) => p.factorize(meter)?.factors,
    };
    Ok(found.into_iter().map(|(factor, _)| factor).collect())
}

/// A part of the zeros while it is brought to triangular form.
#[derive(Clone, Debug, Default)]
struct Branch {
    /// Irreducible polynomials that vanish and may be divided by others.
    open: Vec<Polynomial>,
    /// Those that already determine their generator.
    done: Vec<(usize, Polynomial)>,
    nonzero: Vec<Polynomial>,
}

enum Step {
    Further(Vec<Branch>),
    Done(TriangularSystem),
}

struct Elimination<'a> {
    order: &'a [usize],
    vanish: Vanish<'a>,
    meter: &'a Meter,
}

impl Elimination<'_> {
    /// The highest generator of a polynomial in the order; `None` where only parameters occur.
    fn class(&self, p: &Polynomial) -> Option<usize> {
        let own = p.generators();
        self.order.iter().rev().copied().find(|g| own.contains(g))
    }

    /// The branch where a polynomial vanishes as well: one branch for each factor, the factors before it not vanishing.
    fn with(&self, branch: Branch, p: &Polynomial) -> Result<Vec<Branch>, TooLarge> {
        if p.is_zero() {
            return Ok(vec![branch]);
        }
        if p.is_constant() {
            return Ok(Vec::new());
        }
        let all_factors = factors(p, self.meter)?;
        let opened = |mut own: Branch, factor: &Polynomial| {
            if self.class(factor).is_some() && !own.open.contains(factor) {
                own.open.push(factor.clone());
            }
            own
        };
        let is_zero = |factor: &&Polynomial| (self.vanish)(factor) == Some(true);
        if let Some(zero) = all_factors.iter().find(is_zero) {
            return Ok(vec![opened(branch, zero)]);
        }
        let (mut rest, mut all) = (branch, Vec::new());
        for factor in all_factors {
            if rest.nonzero.contains(&factor) {
                continue;
            }
            let is_number = (self.vanish)(&factor).is_some();
            if self.class(&factor).is_some() && !is_number {
                all.push(opened(rest.clone(), &factor));
            }
            rest.nonzero.push(factor);
        }
        Ok(all)
    }

    fn step(&self, mut branch: Branch) -> Result<Step, TooLarge> {
        let classes: Vec<Option<usize>> = branch.open.iter().map(|p| self.class(p)).collect();
        let highest = self.order.iter().rev().copied();
        let Some(main) = highest
            .into_iter()
            .find(|own| classes.contains(&Some(*own)))
        else {
            return self.finished(branch);
        };
        let own = (0..classes.len()).filter(|&at| classes[at] == Some(main));
        let cost = |&at: &usize| {
            let p: &Polynomial = &branch.open[at];
            let initial = p.leading_coefficient_in(main);
            (p.degree_in(main), initial.degree(), p.len())
        };
        let Some(least) = own.min_by_key(cost) else {
            return self.finished(branch);
        };
        let divisor = branch.open.remove(least);
        let initial = divisor.leading_coefficient_in(main);
        let undecided: Vec<Polynomial> = factors(&initial, self.meter)?
            .into_iter()
            .filter(|factor| !branch.nonzero.contains(factor))
            .collect();
        if !undecided.is_empty() {
            return self.split(branch, divisor, main, undecided);
        }
        let other = branch.open.iter().position(|p| self.class(p) == Some(main));
        match other {
            Some(other) => {
                let dividend = branch.open.remove(other);
                let rest = dividend.pseudo_remainder(&divisor, main, self.meter)?;
                branch.open.push(divisor);
                Ok(Step::Further(self.with(branch, &rest)?))
            }
            None => {
                branch.done.push((main, divisor));
                Ok(Step::Further(vec![branch]))
            }
        }
    }

    /// The branch in which no factor of the initial vanishes, and those in which the first that vanishes is this one.
    fn split(
        &self,
        branch: Branch,
        divisor: Polynomial,
        main: usize,
        factors: Vec<Polynomial>,
    ) -> Result<Step, TooLarge> {
        let degree = divisor.degree_in(main);
        let initial = divisor.leading_coefficient_in(main);
        let power = Polynomial::term(Monomial::power(main, degree), IBig::ONE);
        let below = divisor.sub(&initial.mul(&power, self.meter)?);
        let (mut rest, mut all) = (branch, Vec::new());
        for factor in factors {
            for own in self.with(rest.clone(), &factor)? {
                all.extend(self.with(own, &below)?);
            }
            if (self.vanish)(&factor) == Some(true) {
                return Ok(Step::Further(all));
            }
            rest.nonzero.push(factor);
        }
        rest.open.push(divisor);
        all.push(rest);
        Ok(Step::Further(all))
    }

    /// A triangular system with every equation reduced by those before it; further branches where that shows factors.
    fn finished(&self, branch: Branch) -> Result<Step, TooLarge> {
        let mut equations: Vec<(usize, Polynomial)> = Vec::new();
        for (main, p) in branch.done.iter().rev() {
            let reduced = self.reduced(p, &equations)?;
            let mut factors = factors(&reduced, self.meter)?
                .into_iter()
                .filter(|factor| !branch.nonzero.contains(factor));
            match (factors.next(), factors.next()) {
                (Some(only), None) if self.class(&only) == Some(*main) => {
                    equations.push((*main, only));
                }
                _ => {
                    let others = branch.done.iter().filter(|(own, _)| own != main);
                    let rest = Branch {
                        open: others.map(|(_, p)| p.clone()).collect(),
                        done: Vec::new(),
                        nonzero: branch.nonzero.clone(),
                    };
                    return Ok(Step::Further(self.with(rest, &reduced)?));
                }
            }
        }
        for p in &branch.nonzero {
            if self.reduced(p, &equations)?.is_zero() {
                return Ok(Step::Further(Vec::new()));
            }
        }
        Ok(Step::Done(TriangularSystem {
            equations,
            nonzero: branch.nonzero,
        }))
    }

    /// Systems that lie in others are left out.
    ///
    /// Where the zeros of the equations of a system at which its initials do not vanish are irreducible, another polynomial that does not vanish
    /// in some of them vanishes in a thin part only, and that part too consists of common zeros.
    fn without_contained(
        &self,
        mut found: Vec<TriangularSystem>,
        given: &[Polynomial],
    ) -> Result<Vec<TriangularSystem>, TooLarge> {
        let mut whole = Vec::new();
        for system in &found {
            let mut initials = Vec::new();
            for (main, p) in &system.equations {
                initials.extend(factors(&p.leading_coefficient_in(*main), self.meter)?);
            }
            whole.push(self.is_irreducible(system)?.then_some(initials));
        }
        let mut at = 0;
        while at < found.len() {
            let mut is_contained = false;
            for (other, initials) in whole.iter().enumerate() {
                if let Some(initials) = initials.as_ref().filter(|_| other != at && !is_contained) {
                    is_contained = self.contains((&found[other], initials), &found[at])?;
                }
            }
            if is_contained {
                found.remove(at);
                whole.remove(at);
            } else {
                at += 1;
            }
        }
        for (system, initials) in found.iter_mut().zip(whole) {
            if let Some(initials) = initials {
                system.nonzero = [given.to_vec(), initials].concat();
            }
        }
        Ok(found)
    }

    /// Whether the zeros of a system are irreducible over the rational numbers: no equation but one is bent, and that is irreducible; or all those
    /// that are bent are irreducible whatever numbers are adjoined, and have no generators in common.
    fn is_irreducible(&self, system: &TriangularSystem) -> Result<bool, TooLarge> {
        let bent = system.equations.iter();
        let bent = bent.filter(|(main, p)| p.degree_in(*main) > 1);
        let bent: Vec<&(usize, Polynomial)> = bent.collect();
        for (main, p) in &bent {
            let is_one = matches!(p.irreducible_factors(self.meter), Ok(own) if own.len() == 1);
            if !is_one || (bent.len() > 1 && !self.is_absolutely_irreducible(p, *main)?) {
                return Ok(false);
            }
        }
        let mut used: Vec<usize> = Vec::new();
        for (_, p) in bent {
            let own = p.generators();
            if own.iter().any(|g| used.contains(g)) {
                return Ok(false);
            }
            used.extend(own);
        }
        Ok(true)
    }

    /// A quadratic polynomial whose discriminant is no square, even of functions with algebraic numbers as coefficients: a factor that is not a
    /// number occurs in it to an odd power.
    fn is_absolutely_irreducible(&self, p: &Polynomial, main: usize) -> Result<bool, TooLarge> {
        if p.degree_in(main) != 2 {
            return Ok(false);
        }
        let [c, b, a] = [0, 1, 2].map(|n| p.coefficient_in(main, n));
        let four = Polynomial::constant(4);
        let product = four.mul(&a, self.meter)?.mul(&c, self.meter)?;
        let discriminant = b.mul(&b, self.meter)?.sub(&product);
        let factors = discriminant.factorize(self.meter)?.factors;
        let is_odd =
            |(factor, power): &(Polynomial, u32)| power % 2 == 1 && self.class(factor).is_some();
        Ok(factors.iter().any(is_odd))
    }

    /// Whether the equations of a system hold on another, and its initials vanish nowhere there.
    fn contains(
        &self,
        (system, initials): (&TriangularSystem, &[Polynomial]),
        other: &TriangularSystem,
    ) -> Result<bool, TooLarge> {
        for p in initials {
            let rest = self.reduced(p, &other.equations)?;
            let is_number = rest.is_constant() && !rest.is_zero();
            if !is_number && !other.nonzero.contains(p) {
                return Ok(false);
            }
        }
        self.vanish_on(system, other)
    }

    /// Whether the equations of one system hold on another.
    fn vanish_on(
        &self,
        system: &TriangularSystem,
        on: &TriangularSystem,
    ) -> Result<bool, TooLarge> {
        for (_, p) in &system.equations {
            if !self.reduced(p, &on.equations)?.is_zero() {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The remainder of a polynomial in the division by equations, the highest first: it vanishes with them exactly where the polynomial does.
    fn reduced(
        &self,
        p: &Polynomial,
        equations: &[(usize, Polynomial)],
    ) -> Result<Polynomial, TooLarge> {
        let mut rest = p.clone();
        for (main, divisor) in equations.iter().rev() {
            rest = rest.pseudo_remainder(divisor, *main, self.meter)?;
        }
        Ok(rest.primitive_part())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::polynomial::Budget;

    fn generators() -> [Polynomial; 3] {
        [0, 1, 2].map(Polynomial::generator)
    }

    /// No generator stands for a number.
    fn none(_: &Polynomial) -> Option<bool> {
        None
    }

    fn number(value: i64) -> Polynomial {
        Polynomial::constant(value)
    }

    /// The circle x² + y² = 2 and the hyperbola x y = 1 touch at (1, 1) and (−1, −1) only.
    #[test]
    fn a_circle_and_a_hyperbola_touch_at_two_points() {
        let meter = Meter::new(Budget::PROOF);
        let [x, y, _] = generators();
        let square = |p: &Polynomial| p.mul(p, &meter).unwrap();
        let circle = square(&x).add(&square(&y)).sub(&number(2));
        let hyperbola = x.mul(&y, &meter).unwrap().sub(&number(1));
        let found =
            triangular_systems(&[circle, hyperbola], &[], &[0, 1], (&none, &meter)).unwrap();
        let mut points: Vec<Vec<Polynomial>> = found
            .into_iter()
            .map(|system| system.equations.into_iter().map(|(_, p)| p).collect())
            .collect();
        points.sort_by_key(|point| point[0].leading_term().map(|_| point[0].len()));
        assert_eq!(points.len(), 2, "{points:?}");
        for sign in [1, -1] {
            let at = vec![x.sub(&number(sign)), y.sub(&number(sign))];
            assert!(points.contains(&at), "{points:?}");
        }
    }

    /// x y = 0 and x z = 0 are the plane x = 0 and the line y = z = 0, neither of which contains the other (Cox, Little, O'Shea, Ideals, varieties,
    /// and algorithms, sec. 1.2).
    #[test]
    fn a_plane_and_a_line_are_two_systems() {
        let meter = Meter::new(Budget::PROOF);
        let [x, y, z] = generators();
        let times = |a: &Polynomial, b: &Polynomial| a.mul(b, &meter).unwrap();
        let polynomials = [times(&x, &y), times(&x, &z)];
        let found = triangular_systems(&polynomials, &[], &[0, 1, 2], (&none, &meter)).unwrap();
        let mut equations: Vec<Vec<Polynomial>> = found
            .iter()
            .map(|system| system.equations.iter().map(|(_, p)| p.clone()).collect())
            .collect();
        equations.sort_by_key(Vec::len);
        assert_eq!(equations, [vec![x], vec![y, z]]);
    }

    /// x² y = x is x = 0 and x y = 1; z = 0 with x (z + 1) = 0 and x y = 0 is the line x = z = 0, which contains every other part.
    #[test]
    fn what_lies_in_another_part_is_left_out() {
        let meter = Meter::new(Budget::PROOF);
        let [x, y, z] = generators();
        let times = |a: &Polynomial, b: &Polynomial| a.mul(b, &meter).unwrap();
        let curve = times(&times(&x, &x), &y).sub(&x);
        assert_eq!(
            triangular_systems(&[curve], &[], &[0, 1], (&none, &meter))
                .unwrap()
                .len(),
            2
        );
        let polynomials = [z.clone(), times(&x, &z.add(&number(1))), times(&x, &y)];
        let found = triangular_systems(&polynomials, &[], &[1, 0, 2], (&none, &meter)).unwrap();
        assert_eq!(found.len(), 1, "{found:?}");
    }

    /// a x = 1 is solved for every a but 0, and parameters are in general position.
    #[test]
    fn a_parameter_is_in_general_position() {
        let meter = Meter::new(Budget::PROOF);
        let [a, x, _] = generators();
        let line = a.mul(&x, &meter).unwrap().sub(&number(1));
        let found =
            triangular_systems(std::slice::from_ref(&line), &[], &[1], (&none, &meter)).unwrap();
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].equations, [(1, line)]);
        assert_eq!(found[0].nonzero, [a]);
    }

    /// Of numbers a and b with a = b the equation (a − b) x = 0 says nothing, and (a − b) x = 1 has no zero.
    #[test]
    fn numbers_that_are_zero_vanish() {
        let meter = Meter::new(Budget::PROOF);
        let [a, b, x] = generators();
        let difference = a.sub(&b);
        let is_known = |p: &Polynomial| {
            let is_of_numbers = p.degree_in(2) == 0;
            is_of_numbers.then(|| *p == difference || *p == difference.neg())
        };
        let line = difference.mul(&x, &meter).unwrap();
        let solved = |p: &Polynomial| {
            triangular_systems(std::slice::from_ref(p), &[], &[2], (&is_known, &meter)).unwrap()
        };
        let whole = solved(&line);
        assert_eq!(whole.len(), 1);
        assert!(whole[0].equations.is_empty(), "{whole:?}");
        assert!(solved(&line.sub(&number(1))).is_empty());
        assert_eq!(solved(&a.mul(&x, &meter).unwrap())[0].equations, [(2, x)]);
    }
}
