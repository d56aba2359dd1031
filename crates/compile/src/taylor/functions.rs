//! How each function becomes recurrences, with the values it needs beside its argument.

use super::build::Builder;
use super::recurrence::Kind;
use crate::evaluate::EvaluateFailure;
use crate::scalar::Scalar;
use chetaev_symbolic::Function;

/// A value that no instruction computes but a recurrence needs: its order 0.
#[derive(Clone, Copy, Debug)]
pub(super) enum Auxiliary {
    /// sin a, cos a, sinh a, cosh a
    Partner(Function),
    /// 1 + a²
    OnePlusSquare,
    /// (1 − a)(1 + a)
    OneMinusSquare,
    /// (a − 1)(a + 1)
    SquareMinusOne,
    /// a² + b²
    SumOfSquares,
    /// a²
    Square,
    /// √a
    Root,
    /// log a
    Logarithm,
    /// a b
    Product,
    /// A value of which only higher orders matter.
    Nothing,
}

impl Auxiliary {
    pub(super) fn value<S: Scalar>(self, a: S, b: S) -> S {
        let one = S::of(1.0);
        match self {
            Auxiliary::Partner(function) => S::apply(function, a),
            Auxiliary::OnePlusSquare => one + a * a,
            Auxiliary::OneMinusSquare => (one - a) * (one + a),
            Auxiliary::SquareMinusOne => (a - one) * (a + one),
            Auxiliary::SumOfSquares => a * a + b * b,
            Auxiliary::Square => a * a,
            Auxiliary::Root => a.sqrt(),
            Auxiliary::Logarithm => S::apply(Function::Log, a),
            Auxiliary::Product => a * b,
            Auxiliary::Nothing => S::ZERO,
        }
    }
}

/// Where an operation has no Taylor series: its argument at order 0 is what the condition excludes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Condition {
    pub(super) register: u32,
    pub(super) operation: &'static str,
    pub(super) demands: Demand,
}

/// What is demanded of an argument.
#[derive(Clone, Copy, Debug)]
pub(super) enum Demand {
    NotZero,
    Positive,
}

impl Condition {
    pub(super) fn check(self, argument: f64) -> Result<(), EvaluateFailure> {
        let holds = match self.demands {
            Demand::NotZero => argument != 0.0,
            Demand::Positive => argument > 0.0,
        };
        // What is not a number is reported as such by whoever reads the outputs.
        if holds || argument.is_nan() {
            return Ok(());
        }
        Err(EvaluateFailure::NotAnalytic {
            operation: self.operation,
            argument,
        })
    }
}

impl Builder<'_> {
    /// `out = function(a)`.
    pub(super) fn function(&mut self, function: Function, out: u32, a: u32) {
        match function {
            Function::Sin => {
                let cos = self.auxiliary(Auxiliary::Partner(Function::Cos), a, a);
                self.pair((out, cos), a, Kind::NegIntegral);
            }
            Function::Cos => {
                let sin = self.auxiliary(Auxiliary::Partner(Function::Sin), a, a);
                self.pair((sin, out), a, Kind::NegIntegral);
            }
            Function::Sinh => {
                let cosh = self.auxiliary(Auxiliary::Partner(Function::Cosh), a, a);
                self.pair((out, cosh), a, Kind::Integral);
            }
            Function::Cosh => {
                let sinh = self.auxiliary(Auxiliary::Partner(Function::Sinh), a, a);
                self.pair((sinh, out), a, Kind::Integral);
            }
            Function::Exp => self.exp(out, a),
            Function::Tanh => self.tanh(out, a),
            Function::Log => {
                self.demand(a, "log", Demand::Positive);
                self.quotient(out, a, a);
            }
            Function::Abs => {
                self.demand(a, "abs", Demand::NotZero);
                self.push(Kind::Signed, out, [a, a, 0, 0, 0], &[a]);
            }
            Function::Sign => {
                self.demand(a, "sign", Demand::NotZero);
                self.push(Kind::Clear, out, [0; 5], &[]);
            }
            _ => self.inverse(function, out, a),
        }
    }

    /// asin, acos, atan, asinh, acosh, atanh: w' = x'/d.
    fn inverse(&mut self, function: Function, out: u32, a: u32) {
        let name = function.name();
        let (square, is_root, sign) = match function {
            Function::Asin | Function::Acos => (Auxiliary::OneMinusSquare, true, Kind::Neg),
            Function::Atanh => (Auxiliary::OneMinusSquare, false, Kind::Neg),
            Function::Acosh => (Auxiliary::SquareMinusOne, true, Kind::Add),
            Function::Asinh => (Auxiliary::OnePlusSquare, true, Kind::Add),
            _ => (Auxiliary::OnePlusSquare, false, Kind::Add),
        };
        let plain = self.auxiliary(Auxiliary::Square, a, a);
        self.square(plain, a);
        let under = self.auxiliary(square, a, a);
        let none = self.zero;
        self.push(sign, under, [plain, none, 0, 0, 0], &[plain]);
        self.demand(under, name, Demand::Positive);
        let slope = match is_root {
            true => {
                let root = self.auxiliary(Auxiliary::Root, under, under);
                self.root(root, under);
                root
            }
            false => under,
        };
        if function == Function::Acos {
            let complement = self.auxiliary(Auxiliary::Nothing, a, a);
            self.quotient(complement, a, slope);
            self.push(Kind::Neg, out, [complement, 0, 0, 0, 0], &[complement]);
        } else {
            self.quotient(out, a, slope);
        }
    }

    /// Two functions of one argument, each the derivative of the other up to sign: first' = second, second' = ±first.
    pub(super) fn pair(&mut self, (first, second): (u32, u32), a: u32, second_by: Kind) {
        let argument = self.weighted(a);
        let (of_first, of_second) = (self.reverse(first), self.reverse(second));
        let reads = [a];
        let operands = [argument, of_second, 0, 0, 0];
        self.push(Kind::Integral, first, operands, &reads);
        self.push(second_by, second, [argument, of_first, 0, 0, 0], &reads);
    }

    fn exp(&mut self, out: u32, a: u32) {
        let operands = [self.weighted(a), self.reverse(out), 0, 0, 0];
        self.push(Kind::Integral, out, operands, &[a]);
    }

    fn tanh(&mut self, out: u32, a: u32) {
        let square = self.auxiliary(Auxiliary::Square, out, out);
        let operands = [self.weighted(a), self.reverse(square), a, 0, 0];
        self.push(Kind::Complement, out, operands, &[a]);
        self.square(square, out);
    }

    /// w' = a'/d.
    fn quotient(&mut self, out: u32, a: u32, d: u32) {
        let slope = self.reverse(d);
        self.weighted(out);
        self.push(Kind::Quotient, out, [a, 0, slope, d, 0], &[a, d]);
    }

    pub(super) fn root(&mut self, out: u32, a: u32) {
        self.forward(out);
        self.reverse(out);
        self.push(Kind::Root, out, [a, 0, 0, out, 0], &[a]);
    }

    pub(super) fn square(&mut self, out: u32, a: u32) {
        let operands = [self.forward(a), self.reverse(a), 0, 0, 0];
        self.push(Kind::Square, out, operands, &[a]);
    }

    /// The angle of the point (x, y): w' = (x y' − y x')/(x² + y²).
    pub(super) fn angle(&mut self, out: u32, y: u32, x: u32) {
        let (xx, yy) = (
            self.auxiliary(Auxiliary::Square, x, x),
            self.auxiliary(Auxiliary::Square, y, y),
        );
        self.square(xx, x);
        self.square(yy, y);
        let distance = self.auxiliary(Auxiliary::SumOfSquares, x, y);
        self.push(Kind::Add, distance, [xx, yy, 0, 0, 0], &[xx, yy]);
        self.demand(distance, "atan2", Demand::Positive);
        let turning = self.auxiliary(Auxiliary::Nothing, x, y);
        let operands = [
            self.weighted(y),
            self.reverse(x),
            self.weighted(x),
            self.reverse(y),
            0,
        ];
        self.push(Kind::Rotation, turning, operands, &[x, y]);
        self.quotient(out, turning, distance);
    }

    /// a^b: with a constant exponent by its own recurrence, else as exp(b log a).
    pub(super) fn power(&mut self, out: u32, a: u32, b: u32) {
        if self.is_constant(b) {
            self.demand(a, "a power with this exponent", Demand::NotZero);
            let operands = [self.weighted(a), self.reverse(a), a, 0, b];
            self.reverse(out);
            self.weighted(out);
            self.push(Kind::Power, out, operands, &[a]);
            return;
        }
        self.demand(a, "a power with a moving exponent", Demand::Positive);
        let logarithm = self.auxiliary(Auxiliary::Logarithm, a, a);
        let product = self.auxiliary(Auxiliary::Product, logarithm, b);
        if self.is_constant(a) {
            let operands = [b, logarithm, 0, 0, 0];
            self.push(Kind::Scale, product, operands, &[b]);
        } else {
            self.quotient(logarithm, a, a);
            let operands = [self.forward(logarithm), self.reverse(b), 0, 0, 0];
            self.push(Kind::Convolve, product, operands, &[logarithm, b]);
        }
        self.exp(out, product);
    }
}
