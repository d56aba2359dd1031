//! Ritz's method: the stationary polynomial of a quadratic functional, with exact integrals (W. Ritz 1909).

use crate::functional::{Functional, Side};
use crate::polynomial::{solution, Domain, Polynomial};
use crate::space::Jet;
use chetaev_symbolic::{rational, Expr, Rational};
use std::collections::BTreeMap;

pub use crate::functional::{Asked, Point};

/// A stationary polynomial.
#[derive(Clone, Debug)]
pub struct Approximation {
    /// The degree by each variable.
    pub degree: u32,
    /// The number of unknowns.
    pub unknowns: usize,
    /// Component with polynomial.
    pub fields: Vec<(usize, Polynomial)>,
    /// The value of the functional.
    pub value: Rational,
    /// Whether all pivots are positive: then the second variation is positive for these polynomials.
    pub is_minimum: bool,
}

/// Why there is no approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RitzError {
    /// The box has no rational ends.
    Box,
    /// The functional is not quadratic with polynomial coefficients.
    NotQuadratic,
    /// The equations have no unique solution.
    Singular,
}

impl std::fmt::Display for RitzError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            RitzError::Box => "Ritz's method needs a box, with numbers for its ends",
            RitzError::NotQuadratic => {
                "Ritz's method with exact integrals needs a quadratic functional whose coefficients are polynomials with numbers"
            }
            RitzError::Singular => "the linear equations of Ritz's method have no unique solution",
        })
    }
}

impl std::error::Error for RitzError {}

/// A base function of a component.
struct Base {
    component: usize,
    polynomial: Polynomial,
}

/// A quadratic density on a domain: second and first derivatives by jets, and the value at zero.
struct Quadratic {
    domain: Domain,
    second: BTreeMap<(Jet, Jet), Polynomial>,
    first: BTreeMap<Jet, Polynomial>,
    constant: Polynomial,
}

/// The stationary polynomials of one degree.
///
/// # Errors
/// [`RitzError`].
pub fn approximation(
    functional: &Functional,
    asked: &Asked,
    degree: u32,
) -> Result<Approximation, RitzError> {
    let space = &*functional.space;
    let at = |e: Expr| with_values(functional, asked, e);
    let domain = Domain::of(space, &functional.intervals, &at).ok_or(RitzError::Box)?;
    if domain.intervals.len() != space.coordinates.len() {
        return Err(RitzError::Box);
    }
    let base = base(functional, &domain, degree);
    let mut parts = Vec::new();
    for piece in &functional.pieces {
        let face = domain.face(&piece.side).ok_or(RitzError::Box)?;
        parts.push(quadratic(functional, at(piece.density), face)?);
    }
    parts.push(quadratic(functional, at(functional.density), domain)?);
    let n = base.len();
    let mut matrix = vec![vec![Rational::ZERO; n]; n];
    let mut right = vec![Rational::ZERO; n];
    for part in &parts {
        part.assemble(&base, &mut matrix, &mut right);
    }
    let (x, pivots) = solution(matrix, right.clone()).ok_or(RitzError::Singular)?;
    let mut fields: BTreeMap<usize, Polynomial> = BTreeMap::new();
    // At a stationary point of a quadratic function: the constant and half of the linear part.
    let mut value = Rational::ZERO;
    for part in &parts {
        value = rational::sum(&value, &part.constant.integral(&part.domain));
    }
    for ((own, coefficient), right) in base.iter().zip(&x).zip(&right) {
        fields
            .entry(own.component)
            .or_default()
            .add(&own.polynomial, coefficient);
        let half = rational::product(coefficient, right) / rational::integer(2);
        value -= half;
    }
    Ok(Approximation {
        degree,
        unknowns: n,
        fields: fields.into_iter().collect(),
        value,
        is_minimum: pivots.iter().all(|p| !rational::is_negative(p)),
    })
}

/// Values of parameters and data put in.
pub fn with_values(functional: &Functional, asked: &Asked, e: Expr) -> Expr {
    let space = &*functional.space;
    let known = functional.values();
    space.replace(space.explicit(e), &|symbol| {
        let own = space.graph.symbol_expr(symbol);
        let find = |e: Expr| {
            let mut all = asked.values.iter().chain(&known);
            all.find(|(l, _)| *l == e).map(|(_, r)| *r)
        };
        match space.as_jet(symbol) {
            Some(jet) => Some(space.totals(find(space.jet(jet.component, &[]))?, &jet.by)),
            None => find(own),
        }
    })
}

/// Polynomials that satisfy what is given on the faces: a factor for a value, two for a value with its slope.
fn base(functional: &Functional, domain: &Domain, degree: u32) -> Vec<Base> {
    let mut found = Vec::new();
    for field in functional.interior() {
        for &component in &field.components {
            let mut factor = Polynomial::constant(rational::integer(1));
            for piece in &functional.pieces {
                let Side::Flat { axis, is_upper, .. } = piece.side else {
                    continue;
                };
                let Some((_, lower, upper)) =
                    domain.intervals.iter().find(|(own, _, _)| *own == axis)
                else {
                    continue;
                };
                let mut exponents = vec![0; axis + 1];
                exponents[axis] = 1;
                let mut line = Polynomial::monomial(exponents, rational::integer(1));
                let at = if is_upper { upper } else { lower };
                line.add(&Polynomial::constant(at.clone()), &rational::integer(-1));
                for is_normal in [false, true] {
                    if piece.fixed.contains(&(component, is_normal)) {
                        factor = factor.times(&line);
                    }
                }
            }
            for exponents in tuples(domain.intervals.len(), degree) {
                let own = Polynomial::monomial(exponents, rational::integer(1));
                found.push(Base {
                    component,
                    polynomial: factor.times(&own),
                });
            }
        }
    }
    found
}

/// All exponents up to a degree by each variable.
fn tuples(count: usize, degree: u32) -> Vec<Vec<u32>> {
    let mut all = vec![Vec::new()];
    for _ in 0..count {
        all = all
            .into_iter()
            .flat_map(|own: Vec<u32>| {
                (0..=degree).map(move |n| {
                    let mut longer = own.clone();
                    longer.push(n);
                    longer
                })
            })
            .collect();
    }
    all
}

fn quadratic(functional: &Functional, e: Expr, domain: Domain) -> Result<Quadratic, RitzError> {
    let space = &*functional.space;
    let g = &space.graph;
    let jets: Vec<Jet> = space.jets_in(&[e]).into_iter().collect();
    let zero = |e: Expr| space.replace(e, &|symbol| space.as_jet(symbol).map(|_| g.zero()));
    let polynomial = |e: Expr| Polynomial::of(space, e).ok_or(RitzError::NotQuadratic);
    let mut own = Quadratic {
        domain,
        second: BTreeMap::new(),
        first: BTreeMap::new(),
        constant: polynomial(zero(e))?,
    };
    for a in &jets {
        let slope = space.partial(e, a);
        own.first.insert(a.clone(), polynomial(zero(slope))?);
        for b in &jets {
            let second = space.partial(slope, b);
            if g.is_zero(second) {
                continue;
            }
            if !space.jets_in(&[second]).is_empty() {
                return Err(RitzError::NotQuadratic);
            }
            own.second
                .insert((a.clone(), b.clone()), polynomial(second)?);
        }
    }
    Ok(own)
}

impl Quadratic {
    fn assemble(&self, base: &[Base], matrix: &mut [Vec<Rational>], right: &mut [Rational]) {
        for (jet, coefficient) in &self.first {
            for (i, own) in base
                .iter()
                .enumerate()
                .filter(|(_, b)| b.component == jet.component)
            {
                let term = own
                    .polynomial
                    .slopes(&jet.by)
                    .times(coefficient)
                    .integral(&self.domain);
                right[i] -= term;
            }
        }
        for ((a, b), coefficient) in &self.second {
            let columns: Vec<(usize, Polynomial)> = of(base, b).collect();
            for (i, row) in of(base, a) {
                let row = row.times(coefficient);
                for (j, column) in &columns {
                    matrix[i][*j] += row.times(column).integral(&self.domain);
                }
            }
        }
    }
}

fn of<'b>(base: &'b [Base], jet: &'b Jet) -> impl Iterator<Item = (usize, Polynomial)> + 'b {
    let own = base
        .iter()
        .enumerate()
        .filter(|(_, b)| b.component == jet.component);
    own.map(|(i, b)| (i, b.polynomial.slopes(&jet.by)))
}
