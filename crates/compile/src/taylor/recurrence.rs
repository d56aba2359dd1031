//! The recurrences, one kind each, and the loop over them.
//!
//! With w the result, x and y what it is computed from, and all sums over orders below j known (Moore 1966; Griewank &
//! Walther 2008, ch. 13):
//!
//! ```text
//! w = x y          w_j = Σ_{i=0..j} x_i y_{j−i}
//! w = x/y          w_j = (x_j − Σ_{i=1..j} y_i w_{j−i}) / y_0
//! w = √x           w_j = (x_j − Σ_{i=1..j−1} w_i w_{j−i}) / (2 w_0)
//! w' = g x'        w_j = (1/j) Σ_{i=1..j} i x_i g_{j−i}                                sin, cos, exp, sinh, cosh
//! w' = x'/d        w_j = (x_j − (1/j) Σ_{i=1..j−1} i w_i d_{j−i}) / d_0                log, asin, atan, …
//! w' = x' − u x'   w_j = x_j − (1/j) Σ_{i=1..j} i x_i u_{j−i}                          tanh, u = w²
//! w = x^c          w_j = (c Σ_{i=1..j} i x_i w_{j−i} − Σ_{i=1..j−1} i w_i x_{j−i}) / (j x_0)
//! ```

use super::Series;
use crate::scalar::Scalar;

/// What a recurrence does with its operands `[a, b, c, d, e]`; registers are read at the present order (or at order 0
/// where said), `→x` is a series stored forward, `←x` one stored in reverse, `·x` one multiplied by its orders.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// −a
    Neg,
    /// a b_0
    Scale,
    /// a b_0 + c
    ScaleAdd,
    /// a b_0 − c
    ScaleSub,
    /// c − a b_0
    NegScaleAdd,
    /// →a ←b
    Convolve,
    /// →a ←b + c
    ConvolveAdd,
    /// →a ←b − c
    ConvolveSub,
    /// c − →a ←b
    NegConvolveAdd,
    /// →a ←b of one series
    Square,
    /// (a − →b ←w)/d_0
    Divide,
    /// a/b_0
    DivideConstant,
    /// (a − →w ←w)/(2 d_0)
    Root,
    /// ·a ←b /j
    Integral,
    /// − ·a ←b /j
    NegIntegral,
    /// c − ·a ←b /j
    Complement,
    /// (a − ·w ←c /j)/d_0
    Quotient,
    /// (·a ←b − ·c ←d)/j
    Rotation,
    /// (e_0 ·a ←w − ·w ←b)/(j c_0)
    Power,
    /// a with the sign of b_0
    Signed,
    /// 0
    Clear,
    /// The system number a.
    Solve,
}

impl Kind {
    /// Whether it costs no dot product.
    pub(super) fn is_linear(self) -> bool {
        use Kind::{Add, Clear, DivideConstant, Neg, NegScaleAdd, Scale, ScaleAdd, ScaleSub, Sub};
        matches!(
            self,
            Add | Sub | Neg | Scale | ScaleAdd | ScaleSub | NegScaleAdd | DivideConstant | Clear
        ) || self == Kind::Signed
    }
}

/// How many kinds there are.
pub(super) const KINDS: usize = Kind::Solve as usize + 1;

/// One recurrence: the register of the result, its operands, and the slots of its series; slot 0 is nobody's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recurrence {
    pub(super) out: u32,
    pub(super) operands: [u32; 5],
    pub(super) keep: Keep,
}

/// Where the series of a value is stored: forward, in reverse, multiplied by the orders.
#[derive(Clone, Copy, Default, Debug)]
pub(super) struct Keep {
    pub(super) forward: u32,
    pub(super) reverse: u32,
    pub(super) weighted: u32,
}

impl Keep {
    /// Stores the coefficient of order j.
    #[inline(always)]
    pub(super) fn store<S: Scalar>(self, series: &mut Series<S>, j: usize, value: S) {
        let stride = series.stride;
        series.values[self.forward as usize * stride + j] = value;
        series.values[(self.reverse as usize + 1) * stride - 1 - j] = value;
        series.values[self.weighted as usize * stride + j] = S::of(j as f64) * value;
    }
}

/// Σ a_i b_i, in four interleaved sums.
#[inline(always)]
pub(super) fn dot<S: Scalar>(a: &[S], b: &[S]) -> S {
    let (a4, a_rest) = a.as_chunks::<4>();
    let (b4, b_rest) = b.as_chunks::<4>();
    let mut sums = [S::ZERO; 4];
    for (a, b) in a4.iter().zip(b4) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    let mut rest = S::ZERO;
    for (&a, &b) in a_rest.iter().zip(b_rest) {
        rest += a * b;
    }
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}

/// Σ_{i=from..j−from} x_i x_{j−i} from its half: →x ←x are the same series.
#[inline(always)]
fn half<S: Scalar>(series: &Series<S>, (forward, reverse): (u32, u32), j: usize, from: usize) -> S {
    // Pairs i < j − i; the middle one stands alone.
    let end = j.div_ceil(2);
    let mut sum = S::ZERO;
    if end > from {
        let a = series.forward(forward, from, end);
        let b = series.reverse(reverse, j - from, j + 1 - end);
        sum = S::of(2.0) * dot(a, b);
    }
    if j.is_multiple_of(2) && j / 2 >= from {
        let middle = series.forward(forward, j / 2, j / 2 + 1)[0];
        sum += middle * middle;
    }
    sum
}

/// What the recurrences of one order read and write.
pub(super) struct Order<'w, S = f64> {
    pub(super) j: usize,
    /// Values of order 0, by register.
    pub(super) zero: &'w [S],
    /// Coefficients of order j, by register.
    pub(super) now: &'w mut [S],
    pub(super) series: &'w mut Series<S>,
}

impl<S: Scalar> Order<'_, S> {
    /// Computes recurrences of one kind, one after the other.
    pub(super) fn run(&mut self, kind: Kind, list: &[Recurrence]) {
        match kind {
            Kind::Add => self.each(list, |o, [a, b, ..], _| o.now(a) + o.now(b)),
            Kind::Sub => self.each(list, |o, [a, b, ..], _| o.now(a) - o.now(b)),
            Kind::Neg => self.each(list, |o, [a, ..], _| -o.now(a)),
            Kind::Scale => self.each(list, |o, [a, b, ..], _| o.now(a) * o.zero(b)),
            Kind::ScaleAdd => {
                self.each(list, |o, [a, b, c, ..], _| o.now(a) * o.zero(b) + o.now(c))
            }
            Kind::ScaleSub => {
                self.each(list, |o, [a, b, c, ..], _| o.now(a) * o.zero(b) - o.now(c))
            }
            Kind::NegScaleAdd => {
                self.each(list, |o, [a, b, c, ..], _| o.now(c) - o.now(a) * o.zero(b))
            }
            Kind::Convolve => self.each(list, |o, [a, b, ..], _| o.product(a, b)),
            Kind::ConvolveAdd => {
                self.each(list, |o, [a, b, c, ..], _| o.product(a, b) + o.now(c));
            }
            Kind::ConvolveSub => {
                self.each(list, |o, [a, b, c, ..], _| o.product(a, b) - o.now(c));
            }
            Kind::NegConvolveAdd => {
                self.each(list, |o, [a, b, c, ..], _| o.now(c) - o.product(a, b));
            }
            Kind::Square => self.each(list, |o, [a, b, ..], _| half(o.series, (a, b), o.j, 0)),
            Kind::DivideConstant => self.each(list, |o, [a, b, ..], _| o.now(a) / o.zero(b)),
            Kind::Signed => self.each(list, |o, [a, b, ..], _| o.now(a) * o.zero(b).signum()),
            Kind::Clear => self.each(list, |_, _, _| S::ZERO),
            _ => self.run_function(kind, list),
        }
    }

    /// Those that read lower orders of their own result.
    fn run_function(&mut self, kind: Kind, list: &[Recurrence]) {
        let per_order = S::of(1.0) / S::of(self.j as f64);
        match kind {
            Kind::Divide => self.each(list, |o, [a, b, _, d, _], keep| {
                (o.now(a) - o.below(b, keep.reverse)) / o.zero(d)
            }),
            Kind::Root => self.each(list, |o, [a, _, _, d, _], keep| {
                let sum = half(o.series, (keep.forward, keep.reverse), o.j, 1);
                (o.now(a) - sum) / (S::of(2.0) * o.zero(d))
            }),
            Kind::Integral => self.each(list, |o, [a, b, ..], _| o.below(a, b) * per_order),
            Kind::NegIntegral => self.each(list, |o, [a, b, ..], _| -o.below(a, b) * per_order),
            Kind::Complement => self.each(list, |o, [a, b, c, ..], _| {
                o.now(c) - o.below(a, b) * per_order
            }),
            Kind::Quotient => self.each(list, |o, [a, _, c, d, _], keep| {
                (o.now(a) - o.inside(keep.weighted, c) * per_order) / o.zero(d)
            }),
            Kind::Rotation => self.each(list, |o, [a, b, c, d, _], _| {
                (o.below(a, b) - o.below(c, d)) * per_order
            }),
            Kind::Power => self.each(list, |o, [a, b, c, _, e], keep| {
                let sum = o.zero(e) * o.below(a, keep.reverse) - o.inside(keep.weighted, b);
                sum * per_order / o.zero(c)
            }),
            _ => {}
        }
    }

    #[inline(always)]
    fn each(&mut self, list: &[Recurrence], f: impl Fn(&Self, [u32; 5], Keep) -> S) {
        for recurrence in list {
            let value = f(self, recurrence.operands, recurrence.keep);
            self.now[recurrence.out as usize] = value;
            recurrence.keep.store(self.series, self.j, value);
        }
    }

    #[inline(always)]
    fn now(&self, register: u32) -> S {
        self.now[register as usize]
    }

    #[inline(always)]
    fn zero(&self, register: u32) -> S {
        self.zero[register as usize]
    }

    /// Σ_{i=0..j} x_i y_{j−i}
    #[inline(always)]
    fn product(&self, x: u32, y: u32) -> S {
        let j = self.j;
        dot(
            self.series.forward(x, 0, j + 1),
            self.series.reverse(y, j, 0),
        )
    }

    /// Σ_{i=1..j} x_i y_{j−i}
    #[inline(always)]
    pub(super) fn below(&self, x: u32, y: u32) -> S {
        let j = self.j;
        dot(
            self.series.forward(x, 1, j + 1),
            self.series.reverse(y, j - 1, 0),
        )
    }

    /// Σ_{i=1..j−1} x_i y_{j−i}
    #[inline(always)]
    fn inside(&self, x: u32, y: u32) -> S {
        let j = self.j;
        if j < 2 {
            return S::ZERO;
        }
        dot(
            self.series.forward(x, 1, j),
            self.series.reverse(y, j - 1, 1),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_square_is_the_whole_of_it() {
        let x = [0.5, -1.25, 2.0, 0.75, 3.0, -0.5, 1.5];
        let stride = x.len();
        let reversed = x.iter().rev();
        let series = Series {
            values: x.iter().chain(reversed).copied().collect(),
            stride,
        };
        for j in 0..stride {
            for from in 0..=1.min(j) {
                let whole: f64 = (from..=j - from).map(|i| x[i] * x[j - i]).sum();
                assert_eq!(half(&series, (0, 1), j, from), whole, "{j} {from}");
            }
        }
    }

    #[test]
    fn dot_products_of_every_length() {
        let a: Vec<f64> = (0..23).map(f64::from).collect();
        for n in 0..23 {
            let whole: f64 = (0..n).map(|i| (i * i) as f64).sum();
            assert_eq!(dot(&a[..n], &a[..n]), whole);
        }
    }
}
