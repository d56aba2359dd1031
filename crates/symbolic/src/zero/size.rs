//! Degrees and heights of every value of a program: what the error bound of a modular proof is made of (T6 §6.3).
//!
//! A value is v = A / Π d_j^(k_j): A is a polynomial over ℤ in the generators and algebraic elements, the *poles* d_j are
//! the expressions (and integers) divided by. `degree` bounds the total degree of A, `height` the base-2 logarithm of
//! the sum of its absolute coefficients; both are additive in products. In a sum the common denominator is the least
//! common multiple of the poles, not their product, which keeps nested expressions small.
//!
//! Algebraic elements carry weights that make the norm submultiplicative: a root ρ^q = R weighs deg R/q and h(R)/q; the
//! coordinates of a circle weigh degree 1 and, because of c² = 1 − s², height ½; a dependent symbol weighs as much as the
//! coefficients of its constraint.
//!
//! Numbers are `f64` of up to 2^1023: enough for logarithms of anything that could be decided. Rounding is covered by [`SLACK`].

use std::rc::Rc;

use dashu_base::BitTest;
use dashu_int::IBig;

use super::program::{Generator, Operation, Program, Value};
use crate::rational::Rational;

/// Relative slack of the final bounds; the accumulated rounding of 10^6 operations stays far below.
pub(super) const SLACK: f64 = 1.001;
/// More poles than this in one value are merged into one.
const MOST_POLES: usize = 64;

/// Bounds of the numerator of one value.
#[derive(Clone, Debug, Default)]
pub(super) struct Size {
    /// Total degree.
    pub(super) degree: f64,
    /// log2 of the sum of absolute coefficients.
    pub(super) height: f64,
    /// Exponents of the poles, by increasing number.
    poles: Rc<Vec<(u32, f64)>>,
}

/// What a dependent symbol weighs: degree and height of the coefficients of its constraint.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Weight {
    pub(super) degree: f64,
    pub(super) height: f64,
}

/// Sizes of all values, in the order of the program.
#[derive(Debug, Default)]
pub(super) struct Sizes {
    sizes: Vec<Size>,
    /// Degree and height of each pole.
    poles: Vec<Weight>,
    integers: std::collections::BTreeMap<IBig, u32>,
    leading: Vec<Option<u32>>,
    solves: rustc_hash::FxHashMap<Value, (Size, u32)>,
    /// Values taken as fresh generators because they would be too large.
    pub(super) cuts: Vec<Value>,
}

impl Sizes {
    /// Bounds for every value; `dependent` gives the weights of the dependent symbols. A value whose degree or height would exceed
    /// 2^`cut` is treated as a free generator and noted in `cuts`.
    pub(super) fn of(program: &Program, dependent: &[Weight], cut: Option<f64>) -> Self {
        let mut sizes = Self {
            leading: vec![None; dependent.len()],
            ..Self::default()
        };
        for (value, operation) in program.operations.iter().enumerate() {
            let mut size = sizes.operation(program, operation, value as Value, dependent);
            let scalar = !matches!(
                operation,
                Operation::Matrix { .. } | Operation::Solve { .. }
            );
            let large = cut.is_some_and(|cut| size.degree.max(size.height) > cut.exp2());
            if large
                && scalar
                && !program.outputs.contains(&(value as Value))
                && !program.constraints.contains(&(value as Value))
            {
                sizes.cuts.push(value as Value);
                size = Size {
                    degree: 1.0,
                    ..Size::default()
                };
            }
            sizes.sizes.push(size);
        }
        sizes
    }

    /// Bounds of one value.
    pub(super) fn get(&self, value: Value) -> &Size {
        &self.sizes[value as usize]
    }

    /// Bounds of everything the value was divided by.
    pub(super) fn denominator(&self, value: Value) -> Weight {
        self.clear(
            &self.get(value).poles.iter().copied().collect::<Vec<_>>(),
            &[],
        )
    }

    fn operation(
        &mut self,
        program: &Program,
        operation: &Operation,
        value: Value,
        dependent: &[Weight],
    ) -> Size {
        let free = Size {
            degree: 1.0,
            ..Size::default()
        };
        match operation {
            Operation::Number(constant) => {
                let number = &program.constants[*constant as usize];
                Size {
                    height: log2(number.numerator()),
                    poles: self.integer_pole(number),
                    ..Size::default()
                }
            }
            Operation::Generator(index) => match &program.generators[*index as usize] {
                Generator::Dependent(constraint) => self.dependent(*constraint as usize, dependent),
                _ => free,
            },
            Operation::CircleCos(_) | Operation::CircleSin(_) => Size {
                height: 0.5,
                ..free
            },
            Operation::UnityCos(_) | Operation::UnitySin(_) => {
                // (ζ + ζ^(−1))/2 and i^(−1)(ζ − ζ^(−1))/2
                let half = Rational::from_parts(IBig::ONE, 2_u8.into());
                Size {
                    height: 1.0,
                    poles: self.integer_pole(&half),
                    ..Size::default()
                }
            }
            Operation::Sum { constant, terms } => {
                let mut parts = vec![(Size::default(), &program.constants[*constant as usize])];
                parts.extend(
                    terms
                        .iter()
                        .map(|(v, c)| (self.get(*v).clone(), &program.constants[*c as usize])),
                );
                self.sum(parts)
            }
            Operation::Product {
                coefficient,
                factors,
            } => {
                let number = &program.constants[*coefficient as usize];
                let start = Size {
                    height: log2(number.numerator()),
                    poles: self.integer_pole(number),
                    ..Size::default()
                };
                let sizes: Vec<Size> = factors.iter().map(|v| self.get(*v).clone()).collect();
                sizes
                    .iter()
                    .fold(start, |product, factor| self.product(&product, factor))
            }
            Operation::Power { base, exponent } => self.power(*base, exponent),
            Operation::SquareRoot { radicand, .. } => self.root(*radicand, 2.0),
            Operation::OddRoot { radicand, degree } => self.root(*radicand, *degree as f64),
            Operation::Matrix { .. } => Size::default(),
            Operation::Solve { matrix, rhs } => self.solve(program, value, *matrix, rhs),
            Operation::Entry { of, .. } => self
                .solves
                .get(of)
                .map(|(size, _)| size.clone())
                .unwrap_or_default(),
        }
    }

    /// v = v'/lc, where v' is integral of the weight of the constraint's coefficients.
    fn dependent(&mut self, constraint: usize, weights: &[Weight]) -> Size {
        let weight = weights.get(constraint).copied().unwrap_or_default();
        let pole = match self.leading.get(constraint).copied().flatten() {
            Some(pole) => pole,
            None => {
                let pole = self.new_pole(weight);
                if let Some(slot) = self.leading.get_mut(constraint) {
                    *slot = Some(pole);
                }
                pole
            }
        };
        Size {
            degree: weight.degree.max(1.0),
            height: weight.height,
            poles: Rc::new(vec![(pole, 1.0)]),
        }
    }

    fn new_pole(&mut self, weight: Weight) -> u32 {
        self.poles.push(weight);
        (self.poles.len() - 1) as u32
    }

    fn integer_pole(&mut self, number: &Rational) -> Rc<Vec<(u32, f64)>> {
        if number.is_int() {
            return Rc::default();
        }
        let denominator = number.denominator().as_ibig();
        let pole = match self.integers.get(denominator) {
            Some(&pole) => pole,
            None => {
                let pole = self.new_pole(Weight {
                    degree: 0.0,
                    height: log2(denominator),
                });
                self.integers.insert(denominator.clone(), pole);
                pole
            }
        };
        Rc::new(vec![(pole, 1.0)])
    }

    fn sum(&mut self, parts: Vec<(Size, &Rational)>) -> Size {
        let parts: Vec<Size> = parts
            .into_iter()
            .filter(|(_, coefficient)| !coefficient.is_zero())
            .map(|(size, coefficient)| {
                let factor = Size {
                    height: log2(coefficient.numerator()),
                    poles: self.integer_pole(coefficient),
                    ..Size::default()
                };
                self.product(&size, &factor)
            })
            .collect();
        let common = parts
            .iter()
            .fold(Rc::default(), |common: Rc<Vec<(u32, f64)>>, part| {
                merge(&common, &part.poles, f64::max)
            });
        let (mut degree, mut height) = (0.0_f64, 0.0_f64);
        for part in &parts {
            let missing = self.clear(&common, &part.poles);
            degree = degree.max(part.degree + missing.degree);
            height = height.max(part.height + missing.height);
        }
        self.capped(Size {
            degree,
            height: height + (parts.len().max(1) as f64).log2(),
            poles: common,
        })
    }

    fn product(&mut self, a: &Size, b: &Size) -> Size {
        let poles = merge(&a.poles, &b.poles, |x, y| x + y);
        self.capped(Size {
            degree: a.degree + b.degree,
            height: a.height + b.height,
            poles,
        })
    }

    fn power(&mut self, base: Value, exponent: &IBig) -> Size {
        let size = self.get(base).clone();
        let times = magnitude(exponent);
        if exponent.sign() == dashu_base::Sign::Positive {
            let poles = size
                .poles
                .iter()
                .map(|(pole, k)| (*pole, k * times))
                .collect();
            return Size {
                degree: size.degree * times,
                height: size.height * times,
                poles: Rc::new(poles),
            };
        }
        // 1/(A/D)^n = D^n/A^n
        let numerator = self.clear(&size.poles, &[]);
        let pole = self.new_pole(Weight {
            degree: size.degree,
            height: size.height,
        });
        Size {
            degree: numerator.degree * times,
            height: numerator.height * times,
            poles: Rc::new(vec![(pole, times)]),
        }
    }

    /// (A/Π d^k)^(1/q) = (A·Π d^r)^(1/q) / Π d^⌈k/q⌉ with r = q⌈k/q⌉ − k.
    fn root(&mut self, radicand: Value, q: f64) -> Size {
        let size = self.get(radicand).clone();
        let poles: Vec<(u32, f64)> = size
            .poles
            .iter()
            .map(|(pole, k)| (*pole, (k / q).ceil()))
            .collect();
        let full: Vec<(u32, f64)> = poles.iter().map(|(pole, k)| (*pole, k * q)).collect();
        let missing = self.clear(&full, &size.poles);
        Size {
            degree: (size.degree + missing.degree) / q,
            height: (size.height + missing.height) / q,
            poles: Rc::new(poles),
        }
    }

    /// Cramer's rule and Hadamard's bound in the sum norm: rows are cleared of their poles together with the right-hand side.
    fn solve(&mut self, program: &Program, value: Value, matrix: Value, rhs: &[Value]) -> Size {
        let Operation::Matrix { size: n, entries } = &program.operations[matrix as usize] else {
            return Size::default();
        };
        let n = *n as usize;
        let mut total = Weight::default();
        for (row, b) in entries.chunks(n.max(1)).zip(rhs) {
            let sizes: Vec<&Size> = row
                .iter()
                .chain(std::iter::once(b))
                .map(|v| self.get(*v))
                .collect();
            let common = sizes
                .iter()
                .fold(Rc::default(), |c: Rc<Vec<(u32, f64)>>, size| {
                    merge(&c, &size.poles, f64::max)
                });
            let mut worst = Weight::default();
            for size in &sizes {
                let missing = self.clear(&common, &size.poles);
                worst.degree = worst.degree.max(size.degree + missing.degree);
                worst.height = worst.height.max(size.height + missing.height);
            }
            total.degree += worst.degree;
            total.height += worst.height + ((n + 1) as f64).log2();
        }
        let pole = self.new_pole(total);
        let size = Size {
            degree: total.degree,
            height: total.height,
            poles: Rc::new(vec![(pole, 1.0)]),
        };
        self.solves.insert(value, (size.clone(), pole));
        size
    }

    /// Degree and height of Π d^(wanted − present).
    fn clear(&self, wanted: &[(u32, f64)], present: &[(u32, f64)]) -> Weight {
        let mut result = Weight::default();
        let mut rest = present.iter().peekable();
        for &(pole, exponent) in wanted {
            while rest.next_if(|(other, _)| *other < pole).is_some() {}
            let already = rest
                .next_if(|(other, _)| *other == pole)
                .map_or(0.0, |(_, k)| *k);
            let weight = self.poles[pole as usize];
            // An exponent of 0 must not meet an infinite weight.
            if exponent > already {
                result.degree += (exponent - already) * weight.degree;
                result.height += (exponent - already) * weight.height;
            }
        }
        result
    }

    /// Merges the poles into one if there are too many.
    fn capped(&mut self, size: Size) -> Size {
        if size.poles.len() <= MOST_POLES {
            return size;
        }
        let weight = self.clear(&size.poles, &[]);
        let pole = self.new_pole(weight);
        Size {
            poles: Rc::new(vec![(pole, 1.0)]),
            ..size
        }
    }
}

/// Both lists in one, exponents of common poles combined.
fn merge(
    a: &Rc<Vec<(u32, f64)>>,
    b: &Rc<Vec<(u32, f64)>>,
    combine: impl Fn(f64, f64) -> f64,
) -> Rc<Vec<(u32, f64)>> {
    if b.is_empty() {
        return a.clone();
    }
    if a.is_empty() {
        return b.clone();
    }
    let mut merged = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        match (a.get(i), b.get(j)) {
            (Some(x), Some(y)) if x.0 == y.0 => {
                merged.push((x.0, combine(x.1, y.1)));
                i += 1;
                j += 1;
            }
            (Some(x), Some(y)) if x.0 < y.0 => {
                merged.push(*x);
                i += 1;
            }
            (_, Some(y)) => {
                merged.push(*y);
                j += 1;
            }
            (Some(x), None) => {
                merged.push(*x);
                i += 1;
            }
            (None, None) => break,
        }
    }
    Rc::new(merged)
}

/// An upper bound of log2|n|; 0 for 0 and ±1.
fn log2(n: &IBig) -> f64 {
    let bits = n.clone().into_parts().1.bit_len();
    match i64::try_from(n) {
        Ok(-1..=1) => 0.0,
        _ => bits as f64,
    }
}

/// |n| as a float, rounded up.
fn magnitude(n: &IBig) -> f64 {
    let natural = n.clone().into_parts().1;
    if natural.bit_len() <= 50 {
        u64::try_from(&natural).map_or(f64::INFINITY, |small| small as f64)
    } else {
        (natural.bit_len() as f64).exp2()
    }
}
