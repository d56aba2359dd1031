//! Ritz's method: the stationary polynomial of a quadratic functional, with exact integrals (W. Ritz 1909).

use crate::functional::{Functional, Piece, Role, Side};
use crate::linear::System;
use crate::polynomial::{Domain, Polynomial};
use crate::ritz_base::Base;
use crate::space::{Jet, Space};
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
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RitzError {
    /// The box has no rational ends.
    Box,
    /// The functional is not quadratic with polynomial coefficients.
    NotQuadratic,
    /// One of the variables is the time.
    Time,
    /// Data without values, or a field of the boundary.
    Unknown(String),
    /// A field is given by a condition that no polynomial of the base satisfies.
    Given(String),
    /// What is added to the fields at no cost, as it is written.
    Singular {
        /// The degree of the polynomials.
        degree: u32,
        /// The fields that may be added: `u = 1`.
        added: String,
        /// Whether the functional does not change with them; else it changes in proportion, and nothing is stationary.
        is_idle: bool,
    },
}

impl std::fmt::Display for RitzError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RitzError::Time => f.write_str("Ritz's method is for fields over space: one of the variables is the time"),
            RitzError::Box => f.write_str("Ritz's method needs a box, with numbers for its ends"),
            RitzError::NotQuadratic => f.write_str(
                "Ritz's method with exact integrals needs a quadratic functional whose coefficients are polynomials with numbers",
            ),
            RitzError::Unknown(name) => write!(
                f,
                "`{name}` has no value: [ritz] values states those of data, and fields of the boundary have none"
            ),
            RitzError::Given(label) => write!(
                f,
                "({label}) is imposed, and the polynomials of Ritz's method do not satisfy it: they vanish where a field is given"
            ),
            RitzError::Singular {
                degree,
                added,
                is_idle: true,
            } => write!(
                f,
                "no polynomial of degree {degree} is the only stationary one: the functional of these does not change when {added} is added"
            ),
            RitzError::Singular { degree, added, is_idle: false } => write!(
                f,
                "no polynomial of degree {degree} is stationary: the functional of these changes in proportion to c when c times {added} is added"
            ),
        }
    }
}

impl std::error::Error for RitzError {}

/// A quadratic density on a domain: second and first derivatives by jets, and the value at zero.
struct Quadratic {
    domain: Domain,
    second: BTreeMap<(Jet, Jet), Polynomial>,
    first: BTreeMap<Jet, Polynomial>,
    constant: Polynomial,
}

/// The stationary polynomials of one degree. Work is counted: products and sums of rational numbers.
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
    if space.coordinates.iter().any(|own| own.is_time) {
        return Err(RitzError::Time);
    }
    let domain = Domain::of(space, &functional.intervals, &at).ok_or(RitzError::Box)?;
    let is_flat = |(_, lower, upper): &(usize, Rational, Rational)| lower == upper;
    if domain.intervals.len() != space.coordinates.len() || domain.intervals.iter().any(is_flat) {
        return Err(RitzError::Box);
    }
    if let Some(label) = unsatisfied(functional, asked) {
        return Err(RitzError::Given(label));
    }
    let base = Base::new(functional, &domain, degree as usize);
    let mut parts = Vec::new();
    for piece in &functional.pieces {
        let face = domain.face(&piece.side).ok_or(RitzError::Box)?;
        parts.push(quadratic(functional, at(piece.density), face)?);
    }
    parts.push(quadratic(functional, at(functional.density), domain)?);
    let mut system = System::new(base.unknowns());
    for part in &parts {
        part.assemble(&base, &mut system);
    }
    let right = system.right.clone();
    let solved = system
        .solution()
        .map_err(|added| singular((space, degree), &base.fields(&added), (&added, &right)))?;
    // At a stationary point of a quadratic function: the constant and half of the linear part.
    let mut value = Rational::ZERO;
    for part in &parts {
        value = rational::sum(&value, &part.constant.integral(&part.domain));
    }
    for (coefficient, right) in solved.values.iter().zip(&right) {
        value -= rational::product(coefficient, right) / rational::integer(2);
    }
    Ok(Approximation {
        degree,
        unknowns: base.unknowns(),
        fields: base.fields(&solved.values),
        value,
        is_minimum: solved.is_definite,
    })
}

/// What may be added; the quadratic part has none of it.
fn singular(
    (space, degree): (&Space, u32),
    fields: &[(usize, Polynomial)],
    (added, right): (&[Rational], &[Rational]),
) -> RitzError {
    let products = added
        .iter()
        .zip(right)
        .map(|(a, b)| rational::product(a, b));
    let change = products.fold(Rational::ZERO, |sum, own| rational::sum(&sum, &own));
    let written = fields.iter().filter_map(|(component, polynomial)| {
        let e = polynomial.expr(space);
        let name = space.component_at(*component).name;
        (!space.graph.is_zero(e)).then(|| format!("{name} = {}", space.graph.text(e)))
    });
    RitzError::Singular {
        degree,
        added: written.collect::<Vec<_>>().join(", "),
        is_idle: change == Rational::ZERO,
    }
}

/// Values of parameters and data put in.
pub fn with_values(functional: &Functional, asked: &Asked, e: Expr) -> Expr {
    let space = &*functional.space;
    let pairs = [asked.values.clone(), functional.values()].concat();
    space.put(space.explicit(e), &pairs)
}

/// The components that are varied.
fn components(functional: &Functional) -> Vec<usize> {
    let fields = functional.interior();
    fields.flat_map(|field| field.components.clone()).collect()
}

/// What is imposed and does not hold for all polynomials of the base: any but that a field, or its slope across a face, vanishes there.
fn unsatisfied(functional: &Functional, asked: &Asked) -> Option<String> {
    let space = &*functional.space;
    let mut imposed = functional.with_role(Role::Imposed);
    let own = imposed.find(|equation| {
        let piece = equation.on.as_deref().and_then(|on| functional.piece(on));
        let zero = |symbol| {
            let jet = space.as_jet(symbol)?;
            is_given(piece?, &jet).then(|| space.graph.zero())
        };
        let mut residuals = equation.residuals.iter();
        residuals
            .any(|&e| !space.vanish(&[space.replace(with_values(functional, asked, e), &zero)]))
    })?;
    Some(own.label.clone())
}

/// Whether a derivative is zero on a face because the field, or its slope across the face, is given there.
fn is_given(piece: &Piece, jet: &Jet) -> bool {
    let Side::Flat { axis, .. } = piece.side else {
        return false;
    };
    let across = jet.by.iter().filter(|by| **by == axis).count();
    across < 2 && piece.fixed.contains(&(jet.component, across == 1))
}

fn quadratic(functional: &Functional, e: Expr, domain: Domain) -> Result<Quadratic, RitzError> {
    let space = &*functional.space;
    let g = &space.graph;
    let jets: Vec<Jet> = space.jets_in(&[e]).into_iter().collect();
    let varied = components(functional);
    if let Some(jet) = jets.iter().find(|jet| !varied.contains(&jet.component)) {
        let name = space.component_at(jet.component).name;
        return Err(RitzError::Unknown(name));
    }
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
    fn assemble(&self, base: &Base, system: &mut System) {
        for (jet, coefficient) in &self.first {
            for (i, value) in base.linear(jet, coefficient, &self.domain) {
                system.add_right(i, &-value);
            }
        }
        for ((a, b), coefficient) in &self.second {
            for ((i, j), value) in base.bilinear(a, b, coefficient, &self.domain) {
                system.add(i, j, &value);
            }
        }
    }
}
