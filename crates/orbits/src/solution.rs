//! Solutions near a guess, and the dimension of the family to which one belongs.

use crate::branch::{scaled, Equations, Point};
use crate::error::OrbitError;
use crate::subspace::{damped, kernel, least_squares};
use nalgebra::{DMatrix, DVector};

/// Steps below this part of the state are rounding.
const ROUNDING: f64 = 1e-13;
/// A residual below this part of what a change of the state by its own size makes is one of a solution.
const SOLVED: f64 = 1e-7;
/// Steps to a start, which may be far.
const STEPS_OF_START: usize = 60;
/// The damping of Levenberg and Marquardt in parts of the residual.
const DAMPING: f64 = 0.1;

/// A solution at a value of the parameter near a guess, with the dimension of the family of solutions to which it belongs.
///
/// Solutions that are not isolated are found by the method of Levenberg and Marquardt with a damping that is proportional to the residual, which
/// converges quadratically to one of them (Fan and Yuan 2005, Computing 74); Newton's method would run along the family.
///
/// # Errors
/// [`OrbitError::NotConverged`].
pub fn solution(
    equations: &mut dyn Equations,
    guess: &[f64],
    p: f64,
) -> Result<(Point, usize), OrbitError> {
    let scale = scale(guess);
    let mut x = DVector::from_iterator(guess.len(), guess.iter().zip(&scale).map(|(x, s)| x / s));
    let mut last = f64::INFINITY;
    for step in 0..=STEPS_OF_START {
        let unscaled = unscaled(&x, &scale);
        let own = equations.evaluate(&unscaled, p)?;
        let matrix = scaled(&own.by_unknowns, &scale);
        let residual = own.residual.amax();
        let damping = DAMPING * own.residual.norm();
        let change = damped(&matrix, &-own.residual, damping).ok_or(OrbitError::NoEigenvalues)?;
        let size = change.norm();
        let is_at_end = is_done(size, last, x.norm());
        if is_at_end && is_solved(residual, &matrix, x.norm()) {
            let family = family_of(equations, (&x, p), &scale, &own.by_unknowns)?;
            equations.accepted(&unscaled, p)?;
            let spectrum = equations.spectrum(&unscaled, p, family)?;
            let point = Point {
                parameter: p,
                unknowns: unscaled,
                spectrum,
            };
            return Ok((point, family));
        }
        // What is smallest without being zero has no direction to go on.
        if is_at_end || step == STEPS_OF_START || !size.is_finite() {
            return Err(OrbitError::NotConverged {
                what: equations.what(),
                steps: step,
                residual,
            });
        }
        // Far from a solution no step is longer than the state is large.
        let longest = 0.5 * (1.0 + x.norm());
        x += &change * (longest / size.max(longest));
        last = size;
    }
    Err(OrbitError::NotConverged {
        what: equations.what(),
        steps: STEPS_OF_START,
        residual: f64::NAN,
    })
}

/// Whether Newton's method has come to its end: steps are of the size of rounding, or small and no longer smaller.
pub(crate) fn is_done(size: f64, last: f64, state: f64) -> bool {
    size <= ROUNDING * (1.0 + state) || (size <= 1e-9 * (1.0 + state) && size > 0.25 * last)
}

/// Whether equations hold: a residual is what rounding of the state, to [`SOLVED`], makes of it. Where it is not, it has a minimum there that is no zero.
pub(crate) fn is_solved(residual: f64, matrix: &DMatrix<f64>, state: f64) -> bool {
    residual <= SOLVED * matrix.norm() * (1.0 + state)
}

pub(crate) fn scale(x: &[f64]) -> Vec<f64> {
    x.iter().map(|x| 1.0 + x.abs()).collect()
}

pub(crate) fn unscaled(x: &DVector<f64>, scale: &[f64]) -> Vec<f64> {
    x.iter().zip(scale).map(|(x, s)| x * s).collect()
}

/// How far from a solution another one of its family is looked for, in parts of the size of the unknowns.
const MEMBER: f64 = 1e-2;
/// Steps to it.
const STEPS_TO_MEMBER: usize = 40;

/// The dimension of the family of solutions at the same p: the nullity at another solution, at a distance. Where there is none the solution is
/// isolated, and a zero eigenvalue is one of its own.
fn family_of(
    equations: &mut dyn Equations,
    (x, p): (&DVector<f64>, f64),
    scale: &[f64],
    by_unknowns: &DMatrix<f64>,
) -> Result<usize, OrbitError> {
    let most = equations.family(by_unknowns, scale);
    if most == 0 {
        return Ok(0);
    }
    let directions = kernel(&scaled(by_unknowns, scale), most).ok_or(OrbitError::NoEigenvalues)?;
    let distance = MEMBER * (1.0 + x.norm());
    let mut found = 0;
    for direction in directions.column_iter() {
        for sign in [1.0, -1.0] {
            let guess = x + direction * (sign * distance);
            let other = at_distance(equations, (x, guess), p, (scale, distance));
            found = found.max(other.unwrap_or(0).min(most));
        }
        if found == most {
            break;
        }
    }
    Ok(found)
}

/// The nullity at a solution on the sphere about another one, by damped steps from a guess; nothing where none is reached.
fn at_distance(
    equations: &mut dyn Equations,
    (centre, guess): (&DVector<f64>, DVector<f64>),
    p: f64,
    (scale, distance): (&[f64], f64),
) -> Option<usize> {
    let mut x = guess;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS_TO_MEMBER {
        let own = equations.evaluate(&unscaled(&x, scale), p).ok()?;
        let offset = &x - centre;
        let rows = own.residual.len();
        let residual = own.residual.amax();
        let matrix = scaled(&own.by_unknowns, scale);
        let mut right = (-own.residual).resize_vertically(rows + 1, 0.0);
        right[rows] = (distance * distance - offset.norm_squared()) / (2.0 * distance);
        let mut whole = matrix.clone().resize_vertically(rows + 1, 0.0);
        whole
            .row_mut(rows)
            .copy_from(&(offset.transpose() / distance));
        let change = least_squares(&whole, &right, f64::EPSILON)?;
        let size = change.norm();
        if !size.is_finite() || size > distance {
            return None;
        }
        if is_done(size, last, x.norm()) {
            let is_member = right[rows].abs() < 1e-3 * distance
                && residual <= ROUNDING * matrix.norm() * (1.0 + x.norm());
            return is_member.then(|| equations.family(&own.by_unknowns, scale));
        }
        x += change;
        last = size;
    }
    None
}

/// How far beside a start its family is looked at, in parts of the range.
const ASIDE: f64 = 1e-3;

/// Values of the parameter on both sides of a start, in the range.
pub(crate) fn aside(p: f64, range: (f64, f64)) -> Vec<f64> {
    let aside = ASIDE * (range.1 - range.0);
    let mut all = vec![p + aside, p - aside];
    all.retain(|q| *q >= range.0 && *q <= range.1);
    all
}

/// A solution near a guess from which a curve can begin, with the dimension of the family at general values of the parameter.
///
/// The rank of ∂F/∂x is the largest at general points, and falls at those where something happens: a family that exists at one value of the
/// parameter alone is a branch that crosses there. The curve begins beside such a point.
pub(crate) fn ordinary(
    equations: &mut dyn Equations,
    (guess, p): (&[f64], f64),
    range: (f64, f64),
) -> Result<(Point, usize), OrbitError> {
    let mut found = solution(equations, guess, p)?;
    let guess = found.0.unknowns.clone();
    for q in aside(p, range) {
        if found.1 == 0 {
            continue;
        }
        let beside = solution(equations, &guess, q).ok();
        found = beside.filter(|own| own.1 < found.1).unwrap_or(found);
    }
    Ok(found)
}
