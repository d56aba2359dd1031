//! All zeros of a polynomial without multiple ones, enclosed and then rounded: parts that are zero are so exactly, however large the others are.
//!
//! Approximations repel each other while each takes Newton's steps (L. W. Ehrlich, Comm. ACM 10, 1967; O. Aberth, Math. Comp. 27, 1973). About
//! each the disc of radius `n |p(z)| / (|a_n| Π |z − z_j|)` is computed with balls: where no two of these meet, each holds one zero (B. T. Smith,
//! J. ACM 17, 1970). A disc that meets no mirror image but its own holds a zero that is its own mirror image.

use crate::eigenvalues::zeros_of;
use crate::spectrum::is_even;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Graph};
use std::cmp::Ordering;

/// Bits of the enclosures, one after the other until all zeros are known.
const BITS: [usize; 5] = [128, 256, 512, 1024, 2048];
/// Steps at each of these.
const STEPS: usize = 60;
/// A part is known when its error is below this part of it, as a power of two.
const KNOWN: i64 = -56;

/// A complex number with enclosed parts.
#[derive(Clone, Debug)]
pub(crate) struct Complex {
    pub(crate) re: Ball,
    pub(crate) im: Ball,
}

/// Arithmetic of complex numbers; `None` where something is not defined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arithmetic<'p>(pub(crate) &'p Precision);

impl Arithmetic<'_> {
    pub(crate) fn sum(self, a: &Complex, b: &Complex) -> Option<Complex> {
        Some(Complex {
            re: self.0.add(&a.re, &b.re).ok()?,
            im: self.0.add(&a.im, &b.im).ok()?,
        })
    }

    pub(crate) fn difference(self, a: &Complex, b: &Complex) -> Option<Complex> {
        Some(Complex {
            re: self.0.sub(&a.re, &b.re).ok()?,
            im: self.0.sub(&a.im, &b.im).ok()?,
        })
    }

    pub(crate) fn product(self, a: &Complex, b: &Complex) -> Option<Complex> {
        let times = |x: &Ball, y: &Ball| self.0.mul(x, y).ok();
        let re = (times(&a.re, &b.re)?, times(&a.im, &b.im)?);
        let im = (times(&a.re, &b.im)?, times(&a.im, &b.re)?);
        Some(Complex {
            re: self.0.sub(&re.0, &re.1).ok()?,
            im: self.0.add(&im.0, &im.1).ok()?,
        })
    }

    pub(crate) fn quotient(self, a: &Complex, b: &Complex) -> Option<Complex> {
        let conjugate = b.conjugate();
        let above = self.product(a, &conjugate)?;
        let below = self.product(b, &conjugate)?.re;
        Some(Complex {
            re: self.0.div(&above.re, &below).ok()?,
            im: self.0.div(&above.im, &below).ok()?,
        })
    }

    pub(crate) fn size(self, a: &Complex) -> Option<Ball> {
        let square = |x: &Ball| self.0.mul(x, x).ok();
        let sum = self.0.add(&square(&a.re)?, &square(&a.im)?).ok()?;
        // What rounds below zero is zero.
        self.0.sqrt(&self.0.abs(&sum)).ok()
    }

    /// Value and derivative of a polynomial with these coefficients, the constant first.
    pub(crate) fn at(self, polynomial: &[Ball], z: &Complex) -> Option<(Complex, Complex)> {
        let (mut value, mut slope) = (Complex::zero(), Complex::zero());
        for coefficient in polynomial.iter().rev() {
            slope = self.sum(&self.product(&slope, z)?, &value)?;
            value = self.product(&value, z)?;
            value.re = self.0.add(&value.re, coefficient).ok()?;
        }
        Some((value, slope))
    }
}

impl Complex {
    pub(crate) fn zero() -> Complex {
        Complex {
            re: Ball::zero(),
            im: Ball::zero(),
        }
    }

    pub(crate) fn from_f64((re, im): (f64, f64)) -> Option<Complex> {
        Some(Complex {
            re: Ball::from_f64(re)?,
            im: Ball::from_f64(im)?,
        })
    }

    pub(crate) fn midpoint(&self) -> Complex {
        Complex {
            re: self.re.midpoint(),
            im: self.im.midpoint(),
        }
    }

    fn conjugate(&self) -> Complex {
        Complex {
            re: self.re.clone(),
            im: self.im.neg(),
        }
    }
}

/// The zeros of a polynomial with numbers as coefficients, the constant first, each rounded to double precision; real and imaginary ones exactly
/// so. `None` where it has multiple ones, or zeros so close that 2,048 bits do not tell them apart.
pub(crate) fn zeros(g: &Graph, polynomial: &[Expr]) -> Option<Vec<(f64, f64)>> {
    let is_even = is_even(g, polynomial);
    let mut open: Option<Vec<Complex>> = None;
    for bits in BITS {
        let precision = Precision::new(bits);
        let coefficients = g.enclose(polynomial, &precision, &|_| None).ok()?;
        // Of large parts that cancel more bits are needed.
        let is_open = |own: &Ball| !own.is_exact() && !own.excludes_zero();
        if coefficients.iter().any(is_open) {
            continue;
        }
        let zeros = Zeros {
            arithmetic: Arithmetic(&precision),
            coefficients,
            is_even,
        };
        let Some(begin) = open.take().or_else(|| zeros.approximate()) else {
            continue;
        };
        let found = zeros.refined(begin)?;
        if let Some(rounded) = zeros.rounded(&found) {
            return Some(rounded);
        }
        open = Some(found);
    }
    None
}

/// A polynomial with enclosed coefficients.
struct Zeros<'p> {
    arithmetic: Arithmetic<'p>,
    coefficients: Vec<Ball>,
    is_even: bool,
}

/// A disc with exactly one zero.
struct Disc {
    center: Complex,
    radius: Ball,
}

impl Zeros<'_> {
    /// All zeros in double precision, those that are the same there moved apart.
    fn approximate(&self) -> Option<Vec<Complex>> {
        let list: Vec<f64> = self.coefficients.iter().map(Ball::to_f64).collect();
        let found = zeros_of(&list)?.into_iter().enumerate();
        let apart = |(i, z): (usize, nalgebra::Complex<f64>)| {
            let angle = 1.0 + 2.4 * i as f64;
            let turn = z.norm().max(f64::MIN_POSITIVE) * 1e-12;
            Complex::from_f64((z.re + turn * angle.cos(), z.im + turn * angle.sin()))
        };
        found.map(apart).collect()
    }

    /// The steps of Ehrlich and Aberth until none moves any more.
    fn refined(&self, mut all: Vec<Complex>) -> Option<Vec<Complex>> {
        let still = -(self.arithmetic.0.bits() as i64) + 16;
        for _ in 0..STEPS {
            let mut is_moving = false;
            for i in 0..all.len() {
                let Some(step) = self.step(&all, i) else {
                    continue;
                };
                let sizes = [self.size_log2(&step), self.size_log2(&all[i])];
                is_moving |= sizes[0].zip(sizes[1]).is_some_and(|(s, z)| s - z > still);
                all[i] = self.arithmetic.difference(&all[i], &step)?.midpoint();
            }
            if !is_moving {
                break;
            }
        }
        Some(all)
    }

    fn size_log2(&self, z: &Complex) -> Option<i64> {
        self.arithmetic.size(z)?.magnitude().log2_ceil()
    }

    /// `w / (1 − w Σ 1/(z − z_j))` with `w = p/p'`; `None` at a zero, and where it is not defined.
    fn step(&self, all: &[Complex], i: usize) -> Option<Complex> {
        let (own, z) = (self.arithmetic, &all[i]);
        let (value, slope) = own.at(&self.coefficients, z)?;
        let newton = own
            .quotient(&value.midpoint(), &slope.midpoint())?
            .midpoint();
        let one = Complex {
            re: Ball::integer(1),
            im: Ball::zero(),
        };
        let mut repelled = Complex::zero();
        for (_, other) in all.iter().enumerate().filter(|(j, _)| *j != i) {
            let away = own.difference(z, other)?.midpoint();
            repelled = own.sum(&repelled, &own.quotient(&one, &away)?)?.midpoint();
        }
        let below = own.difference(&one, &own.product(&newton, &repelled)?)?;
        Some(own.quotient(&newton, &below.midpoint())?.midpoint())
    }

    /// Smith's discs where no two meet.
    fn discs(&self, all: &[Complex]) -> Option<Vec<Disc>> {
        let own = self.arithmetic;
        let degree = Ball::integer(all.len() as i64);
        let leading = own.0.abs(self.coefficients.last()?);
        let disc = |(i, z): (usize, &Complex)| {
            let (value, _) = own.at(&self.coefficients, z)?;
            let mut below = leading.clone();
            for (_, other) in all.iter().enumerate().filter(|(j, _)| *j != i) {
                let distance = own.size(&own.difference(z, other)?)?;
                below = own.0.mul(&below, &distance).ok()?;
            }
            let above = own.0.mul(&own.size(&value)?, &degree).ok()?;
            Some(Disc {
                center: z.clone(),
                radius: own.0.div(&above, &below).ok()?,
            })
        };
        let discs: Option<Vec<Disc>> = all.iter().enumerate().map(disc).collect();
        let discs = discs?;
        let pairs = (0..discs.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let mut apart = pairs.map(|(i, j)| self.is_apart(&discs[i], &discs[j]));
        apart.all(|apart| apart).then_some(discs)
    }

    fn is_apart(&self, a: &Disc, b: &Disc) -> bool {
        let own = self.arithmetic;
        let room = || {
            let distance = own.size(&own.difference(&a.center, &b.center)?)?;
            let radii = own.0.add(&a.radius, &b.radius).ok()?;
            own.0.sub(&distance, &radii).ok()
        };
        room().is_some_and(|room| room.sign() == Some(Ordering::Greater))
    }

    /// Whether the zero in a disc is its own mirror image: none but its own disc meets the image of the disc.
    fn is_own_image(&self, discs: &[Disc], i: usize, image: Complex) -> bool {
        let image = Disc {
            center: image,
            radius: discs[i].radius.clone(),
        };
        let mut others = discs.iter().enumerate().filter(|(j, _)| *j != i);
        others.all(|(_, other)| self.is_apart(&image, other))
    }

    /// All zeros rounded, if their discs tell each part.
    fn rounded(&self, all: &[Complex]) -> Option<Vec<(f64, f64)>> {
        let discs = self.discs(all)?;
        let rounded = |i: usize| {
            let (z, radius) = (&discs[i].center, &discs[i].radius);
            let part = |x: &Ball, is_zero: bool| {
                if is_zero {
                    Some(0.0)
                } else {
                    self.is_known(x, radius).then(|| x.to_f64())
                }
            };
            let is_real = self.is_own_image(&discs, i, z.conjugate());
            let turned = Complex {
                re: z.re.neg(),
                im: z.im.clone(),
            };
            let is_imaginary = self.is_even && self.is_own_image(&discs, i, turned);
            Some((part(&z.re, is_imaginary)?, part(&z.im, is_real)?))
        };
        (0..discs.len()).map(rounded).collect()
    }

    /// Whether the radius is a small part of a number.
    fn is_known(&self, x: &Ball, radius: &Ball) -> bool {
        let Some(error) = radius.magnitude().log2_ceil() else {
            return true;
        };
        let size = x.magnitude().log2_ceil();
        size.is_some_and(|size| error - size < KNOWN)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "test code fails where it stands")]
mod tests {
    use super::*;

    /// A polynomial with these integers as coefficients, the constant first.
    fn of(g: &Graph, list: &[i64]) -> Vec<Expr> {
        list.iter().map(|&c| g.integer(c)).collect()
    }

    /// (λ + 10⁸)(10⁹ λ + 1): −10⁸ and −10⁻⁹; a matrix has the second one to 1e-8 alone.
    #[test]
    fn small_zeros_beside_large_ones_have_all_digits() {
        let g = Graph::new();
        let ten = |n: i64| g.powi(g.integer(10), n);
        let sum = g.add(&[ten(17), g.one()]);
        let found = zeros(&g, &[ten(8), sum, ten(9)]).unwrap();
        assert_eq!(found.len(), 2);
        for expected in [-1e8, -1e-9] {
            assert!(found.contains(&(expected, 0.0)), "{found:?}");
        }
    }

    /// Real and imaginary zeros are so exactly, and others keep their small parts: λ⁴ + 3 λ² + 1, λ³ − 2, and λ² + 10⁻³⁰ λ + 1.
    #[test]
    fn parts_that_are_zero_are_so_exactly() {
        let g = Graph::new();
        let even = zeros(&g, &of(&g, &[1, 0, 3, 0, 1])).unwrap();
        assert!(even.iter().all(|z| z.0 == 0.0 && z.1 != 0.0), "{even:?}");
        let cubic = zeros(&g, &of(&g, &[-2, 0, 0, 1])).unwrap();
        assert!(cubic.contains(&(2_f64.cbrt(), 0.0)), "{cubic:?}");
        let small = g.powi(g.integer(10), -30);
        let damped = zeros(&g, &[g.one(), small, g.one()]).unwrap();
        assert!(damped.iter().all(|z| z.0 == -5e-31), "{damped:?}");
    }

    /// Wilkinson's polynomial, (λ − 1) ⋯ (λ − 20): a companion matrix in doubles has complex zeros.
    #[test]
    fn wilkinsons_zeros_are_whole_numbers() {
        let g = Graph::new();
        let mut list = vec![g.one()];
        for k in 1..=20 {
            let below = |i: usize| i.checked_sub(1).map_or(g.zero(), |i| list[i]);
            let own = |i: usize| list.get(i).copied().unwrap_or(g.zero());
            let next = (0..=list.len()).map(|i| g.sub(below(i), g.mul(&[g.integer(k), own(i)])));
            list = next.collect();
        }
        let mut found = zeros(&g, &list).unwrap();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let expected: Vec<(f64, f64)> = (1..=20).map(|k| (f64::from(k), 0.0)).collect();
        assert_eq!(found, expected);
        assert!(zeros(&g, &of(&g, &[1, 2, 1])).is_none());
    }
}
