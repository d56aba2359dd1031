//! The polynomials among which Ritz's method looks: products of one polynomial for each variable, Legendre's on the interval times what
//! vanishes where the field is given.
//!
//! Integrals over a box are products of integrals over intervals, which are computed once; as Legendre's polynomials are orthogonal, most
//! of them vanish, and the equations have few entries and short numbers.

use crate::functional::{Functional, Side};
use crate::polynomial::{Domain, Polynomial};
use crate::space::Jet;
use chetaev_symbolic::{meter, rational, Rational};

/// Coefficients of the powers of one variable.
type Line = Vec<Rational>;

/// The base functions of all components.
pub(crate) struct Base {
    /// Variables in the order of the coordinates, each with the ends of its interval.
    intervals: Vec<(usize, Rational, Rational)>,
    /// Components that are varied.
    components: Vec<usize>,
    /// For each component and variable the polynomials of one variable.
    lines: Vec<Vec<Vec<Line>>>,
    /// How many of them.
    count: usize,
}

/// Integrals of one variable by two of its polynomials: those that are not zero.
type Table = Vec<(usize, usize, Rational)>;

impl Base {
    /// Polynomials that satisfy what is given on the faces: of a degree, and of one more for every condition.
    pub(crate) fn new(functional: &Functional, domain: &Domain, degree: usize) -> Base {
        let components: Vec<usize> = functional
            .interior()
            .flat_map(|field| field.components.clone())
            .collect();
        let legendre: Vec<Vec<Line>> = domain
            .intervals
            .iter()
            .map(|(_, lower, upper)| legendre(lower, upper, degree + 2))
            .collect();
        let lines = components
            .iter()
            .map(|&component| {
                let axes = domain.intervals.iter().zip(&legendre);
                axes.map(|((axis, lower, upper), free)| {
                    let held = Held::of(functional, component, *axis, (lower, upper));
                    held.lines(free, degree + 1)
                })
                .collect()
            })
            .collect();
        Base {
            intervals: domain.intervals.clone(),
            components,
            lines,
            count: degree + 1,
        }
    }

    /// The number of unknowns.
    pub(crate) fn unknowns(&self) -> usize {
        let each = self.intervals.iter().map(|_| self.count);
        each.product::<usize>()
            .saturating_mul(self.components.len())
    }

    /// The polynomials with coefficients put before the base functions.
    pub(crate) fn fields(&self, values: &[Rational]) -> Vec<(usize, Polynomial)> {
        let mut found: Vec<(usize, Polynomial)> = (self.components.iter())
            .map(|&component| (component, Polynomial::default()))
            .collect();
        for (at, value) in values.iter().enumerate() {
            let own = at % self.components.len();
            let mut rest = at / self.components.len();
            let mut product = Polynomial::constant(value.clone());
            for (place, (axis, ..)) in self.intervals.iter().enumerate().rev() {
                let line = &self.lines[own][place][rest % self.count];
                rest /= self.count;
                product = product.times(&on_axis(line, *axis));
            }
            meter::spend(STEP * (self.count * self.count) as u64);
            found[own].1.add(&product, &rational::integer(1));
        }
        found
    }

    /// The place of a base function among the unknowns: components of the same function stand together, so that few equations are far apart.
    fn place(&self, functions: usize, component: usize) -> usize {
        functions * self.components.len() + component
    }

    /// Integrals of a coefficient times a jet of each base function.
    pub(crate) fn linear(
        &self,
        jet: &Jet,
        coefficient: &Polynomial,
        domain: &Domain,
    ) -> Vec<(usize, Rational)> {
        let Some(own) = self.component(jet) else {
            return Vec::new();
        };
        let one = vec![rational::integer(1)];
        let mut found = Vec::new();
        for (exponents, number) in coefficient.terms() {
            let mut all = vec![(0, number.clone())];
            for place in 0..self.intervals.len() {
                let lines = self.derived(own, place, jet);
                let values: Vec<Rational> = lines
                    .iter()
                    .map(|line| self.integral(line, &one, place, exponents, domain))
                    .collect();
                all = all
                    .iter()
                    .flat_map(|(at, so_far): &(usize, Rational)| {
                        let each = values.iter().enumerate();
                        let each = each.filter(|(_, value)| **value != Rational::ZERO);
                        each.map(move |(k, value)| {
                            (at * self.count + k, rational::product(so_far, value))
                        })
                    })
                    .collect();
                meter::spend(STEP * all.len() as u64);
            }
            found.extend(all.into_iter().map(|(at, v)| (self.place(at, own), v)));
        }
        found
    }

    /// Integrals of a coefficient times jets of two base functions.
    pub(crate) fn bilinear(
        &self,
        a: &Jet,
        b: &Jet,
        coefficient: &Polynomial,
        domain: &Domain,
    ) -> Vec<((usize, usize), Rational)> {
        let (Some(first), Some(second)) = (self.component(a), self.component(b)) else {
            return Vec::new();
        };
        let mut found = Vec::new();
        for (exponents, number) in coefficient.terms() {
            let mut all = vec![((0, 0), number.clone())];
            for place in 0..self.intervals.len() {
                let left = self.derived(first, place, a);
                let right = self.derived(second, place, b);
                let table = self.table(&left, &right, place, exponents, domain);
                all = all
                    .iter()
                    .flat_map(|((i, j), so_far): &((usize, usize), Rational)| {
                        table.iter().map(move |(k, l, value)| {
                            let at = (i * self.count + k, j * self.count + l);
                            (at, rational::product(so_far, value))
                        })
                    })
                    .collect();
                meter::spend(STEP * all.len() as u64);
            }
            let own = all.into_iter();
            found.extend(
                own.map(|((i, j), value)| ((self.place(i, first), self.place(j, second)), value)),
            );
        }
        found
    }

    fn component(&self, jet: &Jet) -> Option<usize> {
        self.components.iter().position(|own| *own == jet.component)
    }

    /// The polynomials of a variable, differentiated as the jet says.
    fn derived(&self, component: usize, place: usize, jet: &Jet) -> Vec<Line> {
        let axis = self.intervals[place].0;
        let order = jet.by.iter().filter(|by| **by == axis).count();
        let own = self.lines[component][place].iter();
        own.map(|line| (0..order).fold(line.clone(), |line, _| slope(&line)))
            .collect()
    }

    fn table(
        &self,
        left: &[Line],
        right: &[Line],
        place: usize,
        exponents: &[u32],
        domain: &Domain,
    ) -> Table {
        let mut found = Vec::new();
        for (k, a) in left.iter().enumerate() {
            for (l, b) in right.iter().enumerate() {
                let value = self.integral(a, b, place, exponents, domain);
                if value != Rational::ZERO {
                    found.push((k, l, value));
                }
            }
        }
        found
    }

    /// The integral of a product and a power over the interval, or its value where the variable has one on the domain.
    fn integral(
        &self,
        a: &Line,
        b: &Line,
        place: usize,
        exponents: &[u32],
        domain: &Domain,
    ) -> Rational {
        let (axis, lower, upper) = &self.intervals[place];
        let power = exponents.get(*axis).copied().unwrap_or(0);
        let product = times(a, b);
        meter::spend(STEP * (product.len() * product.len()) as u64);
        let held = domain.at.as_ref().filter(|(own, _)| own == axis);
        match held {
            Some((_, at)) => {
                let raised = rational::powi(at, i64::from(power));
                let raised = raised.unwrap_or_else(|| rational::integer(i64::from(power == 0)));
                rational::product(&value(&product, at), &raised)
            }
            None => {
                let mut whole = vec![Rational::ZERO; power as usize + 1];
                let share = |(n, own): (usize, &Rational)| {
                    own / rational::integer(i64::from(power) + n as i64 + 1)
                };
                whole.extend(product.iter().enumerate().map(share));
                value(&whole, upper) - value(&whole, lower)
            }
        }
    }
}

/// Units of work of a step with rational numbers.
pub(crate) const STEP: u64 = 30;

/// Legendre's polynomials on an interval, by the recurrence (n + 1) P_{n+1} = (2 n + 1) s P_n − n P_{n−1} (A.-M. Legendre 1785).
fn legendre(lower: &Rational, upper: &Rational, degree: usize) -> Vec<Line> {
    let width = upper - lower;
    let s = vec![-(lower + upper) / &width, rational::integer(2) / &width];
    let mut found = vec![vec![rational::integer(1)]];
    for n in 0..degree {
        let below = rational::integer(n as i64 + 1);
        let step = rational::integer(2 * n as i64 + 1) / &below;
        let mut next: Line = times(&found[n], &s).iter().map(|c| c * &step).collect();
        if let Some(before) = n.checked_sub(1) {
            let back = rational::integer(n as i64) / &below;
            for (own, other) in next.iter_mut().zip(&found[before]) {
                *own = &*own - other * &back;
            }
        }
        found.push(next);
    }
    found
}

/// What is held of a component on the two faces across an axis.
struct Held {
    /// What vanishes where the component is given: to the second order where its slope across the face is given too.
    factor: Line,
    /// Places at which the slope alone is given.
    slopes: Vec<Rational>,
}

impl Held {
    fn of(
        functional: &Functional,
        component: usize,
        axis: usize,
        (lower, upper): (&Rational, &Rational),
    ) -> Held {
        let mut found = Held {
            factor: vec![rational::integer(1)],
            slopes: Vec::new(),
        };
        for piece in &functional.pieces {
            let Side::Flat {
                axis: own,
                is_upper,
                ..
            } = piece.side
            else {
                continue;
            };
            if own != axis {
                continue;
            }
            let at = if is_upper { upper } else { lower };
            let has = |is_normal| piece.fixed.contains(&(component, is_normal));
            let orders = usize::from(has(false)) * (1 + usize::from(has(true)));
            for _ in 0..orders {
                found.factor = times(&found.factor, &vec![-at.clone(), rational::integer(1)]);
            }
            if has(true) && !has(false) {
                found.slopes.push(at.clone());
            }
        }
        found
    }

    /// So many polynomials that satisfy what is held, of the lowest degrees: each whose slope does not vanish where it has to is made to by the
    /// last one before it of the same kind.
    fn lines(&self, free: &[Line], count: usize) -> Vec<Line> {
        let mut found: Vec<Line> = free.iter().map(|own| times(own, &self.factor)).collect();
        for place in &self.slopes {
            let mut before: Option<(Line, Rational)> = None;
            let mut kept = Vec::new();
            for line in found {
                let own = value(&slope(&line), place);
                if own == Rational::ZERO {
                    kept.push(line);
                    continue;
                }
                if let Some((last, other)) = &before {
                    let share = rational::product(&rational::integer(-1), &(&own / other));
                    kept.push(sum(&line, last, &share));
                }
                before = Some((line, own));
            }
            found = kept;
        }
        found.truncate(count);
        found
    }
}

/// `a + factor b`.
fn sum(a: &Line, b: &Line, factor: &Rational) -> Line {
    let zero = Rational::ZERO;
    (0..a.len().max(b.len()))
        .map(|n| {
            let other = b.get(n).unwrap_or(&zero);
            a.get(n).unwrap_or(&zero) + rational::product(factor, other)
        })
        .collect()
}

fn times(a: &Line, b: &Line) -> Line {
    let mut found = vec![Rational::ZERO; (a.len() + b.len()).saturating_sub(1)];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            found[i + j] = rational::sum(&found[i + j], &rational::product(x, y));
        }
    }
    found
}

fn slope(line: &Line) -> Line {
    let own = line.iter().enumerate().skip(1);
    own.map(|(n, c)| c * rational::integer(n as i64)).collect()
}

fn value(line: &Line, at: &Rational) -> Rational {
    let zero = Rational::ZERO;
    line.iter().rev().fold(zero, |sum, c| sum * at + c)
}

fn on_axis(line: &Line, axis: usize) -> Polynomial {
    let mut found = Polynomial::default();
    for (n, c) in line.iter().enumerate() {
        let mut exponents = vec![0; axis + 1];
        exponents[axis] = n as u32;
        found.add(
            &Polynomial::monomial(exponents, c.clone()),
            &rational::integer(1),
        );
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legendres_polynomials_are_orthogonal_on_their_interval() {
        let number = |n| rational::integer(n);
        let (lower, upper) = (number(-1), number(3));
        let own = legendre(&lower, &upper, 5);
        for (i, a) in own.iter().enumerate() {
            for (j, b) in own.iter().enumerate() {
                let product = times(a, b);
                let mut whole = vec![Rational::ZERO];
                let each = product.iter().enumerate();
                whole.extend(each.map(|(n, c)| c / number(n as i64 + 1)));
                let integral = value(&whole, &upper) - value(&whole, &lower);
                // 2 h / (2 n + 1) with the half width h = 2.
                let wanted = number(4 * i64::from(i == j)) / number(2 * i as i64 + 1);
                assert_eq!(integral, wanted, "{i} {j}");
            }
        }
    }
}
