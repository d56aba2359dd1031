//! An eigenvalue right of the imaginary axis, enclosed: a disc that holds a zero of the characteristic polynomial.
//!
//! Within the distance `m |p(z)/p'(z)|` of any z a polynomial of degree m has a zero (Laguerre 1880); Newton's method makes it small, and
//! both values are computed with balls.

use crate::complex_zeros::{Arithmetic, Complex};
use crate::eigenvalues::zeros_of;
use crate::isolation::Root;
use crate::real_roots::ball;
use crate::spectrum::Polynomial;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Graph, Symbol};
use dashu_ratio::RBig;

/// Bits of the enclosures.
const BITS: usize = 256;
/// Newton's steps from double precision on.
const STEPS: usize = 6;

/// Bounds of the real and of the imaginary part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enclosed {
    /// Of the real part, decimal, rounded outwards.
    pub real: (String, String),
    /// Of the imaginary part; `None` where that may be zero.
    pub imaginary: Option<(String, String)>,
}

/// An eigenvalue that is proved to lie right of the axis, of polynomials with numbers as coefficients once the parameter has its value.
pub fn right_of_axis(
    g: &Graph,
    polynomials: &[Polynomial],
    at: Option<(Symbol, &RBig)>,
) -> Option<Enclosed> {
    let found = polynomials.iter().filter_map(|own| {
        let numbers = Numbers::new(g, own, at)?;
        numbers.right()
    });
    found
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, own)| own)
}

/// Whether an eigenvalue is proved to lie right of the axis at the value of a parameter that an interval encloses.
pub fn is_right_of_axis_at(
    g: &Graph,
    polynomials: &[Polynomial],
    (symbol, root): (Symbol, &Root),
) -> bool {
    let over = ball(&root.low, &root.high);
    let value = |s: Symbol| (s == symbol).then(|| over.clone());
    let precision = Precision::new(BITS);
    polynomials.iter().any(|own| {
        let coefficients = g.enclose(own, &precision, &value).ok();
        let numbers = coefficients.map(|coefficients| Numbers {
            precision: Precision::new(BITS),
            coefficients,
        });
        numbers.and_then(|own| own.right()).is_some()
    })
}

/// A polynomial with enclosed coefficients.
struct Numbers {
    precision: Precision,
    /// The constant first.
    coefficients: Vec<Ball>,
}

impl Numbers {
    fn new(g: &Graph, own: &[Expr], at: Option<(Symbol, &RBig)>) -> Option<Numbers> {
        let precision = Precision::new(BITS);
        let values = at.map(|(symbol, at)| (symbol, precision.rational(at)));
        let value = |s: Symbol| {
            let own = values.as_ref().filter(|(symbol, _)| *symbol == s);
            own.map(|(_, ball)| ball.clone())
        };
        let coefficients = g.enclose(own, &precision, &value).ok()?;
        Some(Numbers {
            precision,
            coefficients,
        })
    }

    /// The zero with the largest real part, with that part, where it is enclosed right of the axis.
    fn right(&self) -> Option<(f64, Enclosed)> {
        let start = self.approximate()?;
        if start.0 <= 0.0 {
            return None;
        }
        let own = Arithmetic(&self.precision);
        let mut z = Complex::from_f64(start)?;
        for _ in 0..STEPS {
            let (value, slope) = own.at(&self.coefficients, &z)?;
            let step = own.quotient(&value, &slope)?;
            z = own.difference(&z, &step)?.midpoint();
        }
        let (value, slope) = own.at(&self.coefficients, &z)?;
        let step = own.quotient(&value, &slope)?;
        let degree = Ball::integer(self.coefficients.len() as i64 - 1);
        let radius = self.precision.mul(&own.size(&step)?, &degree).ok()?;
        let about = |x: &Ball| x.clone().widened(radius.magnitude());
        let (re, im) = (about(&z.re), about(&z.im));
        let is_right = re.sign() == Some(std::cmp::Ordering::Greater);
        is_right.then(|| {
            let enclosed = Enclosed {
                real: re.to_decimal_interval(20),
                imaginary: im.excludes_zero().then(|| im.to_decimal_interval(20)),
            };
            (start.0, enclosed)
        })
    }

    /// The zero with the largest real part in double precision, from the companion matrix.
    fn approximate(&self) -> Option<(f64, f64)> {
        let list: Vec<f64> = self.coefficients.iter().map(Ball::to_f64).collect();
        let found = zeros_of(&list)?;
        let largest = found.iter().max_by(|a, b| a.re.total_cmp(&b.re))?;
        Some((largest.re, largest.im))
    }
}
