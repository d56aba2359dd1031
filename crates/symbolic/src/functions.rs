//! Canonical function applications and linear solves.

use crate::graph::Graph;
use crate::node::{Expr, Function, Node};
use crate::rational::{self, Rational};

impl Graph {
    /// `function(arguments)`, with parity, inverse pairs and exact values applied.
    ///
    /// Arguments beyond or short of the arity are the caller's mistake; the node is then stored as given.
    pub fn apply(&self, function: Function, arguments: &[Expr]) -> Expr {
        let stored = |g: &Graph, args: &[Expr]| {
            g.intern(Node::Apply {
                function,
                arguments: args.into(),
            })
        };
        let [x] = *arguments else {
            return stored(self, arguments);
        };
        if let Some(value) = self.exact_value(function, x) {
            return value;
        }
        if self.leads_negative(x) {
            match parity(function) {
                Parity::Odd => return self.neg(self.apply(function, &[self.neg(x)])),
                Parity::Even => return self.apply(function, &[self.neg(x)]),
                Parity::None => {}
            }
        }
        stored(self, &[x])
    }

    /// `sin x`.
    pub fn sin(&self, x: Expr) -> Expr {
        self.apply(Function::Sin, &[x])
    }

    /// `cos x`.
    pub fn cos(&self, x: Expr) -> Expr {
        self.apply(Function::Cos, &[x])
    }

    /// `|x|`.
    pub fn abs(&self, x: Expr) -> Expr {
        self.apply(Function::Abs, &[x])
    }

    fn exact_value(&self, function: Function, x: Expr) -> Option<Expr> {
        use Function::*;
        if self.is_zero(x) {
            return match function {
                Sin | Tan | Asin | Atan | Sinh | Tanh | Asinh | Atanh | Abs | Sign => {
                    Some(self.zero())
                }
                Cos | Sec | Cosh | Exp => Some(self.one()),
                Acos => Some(self.scale(&half(), self.pi())),
                _ => None,
            };
        }
        if let Some(value) = self.as_number(x) {
            return match function {
                Abs => Some(self.number(rational::abs(value))),
                Sign => Some(self.integer(if rational::is_negative(value) { -1 } else { 1 })),
                Log if value.is_one() => Some(self.zero()),
                _ => self.angle_of(function, x),
            };
        }
        if function == Log {
            // Roots of positive numbers are stored as powers.
            let (base, exponent) = self.base_exponent(x);
            if let (Some(b), Some(power)) = (self.as_number(base), self.as_number(exponent)) {
                if !power.is_int() && *b > Rational::ZERO {
                    return Some(self.scale(power, self.apply(Log, &[base])));
                }
            }
        }
        if let Some(multiple) = self.multiple_of_pi(x) {
            if let Some(value) = self.trigonometric_value(function, &multiple) {
                return Some(value);
            }
        }
        self.angle_of(function, x)
            .or_else(|| self.inverse_pair(function, x))
    }

    /// `r π` where an inverse function of an angle has this value, r being a multiple of 1/6 or 1/4: acos(√3/2) is π/6.
    fn angle_of(&self, function: Function, x: Expr) -> Option<Expr> {
        use Function::*;
        let (inverse, mut twelfths) = match function {
            Asin => (Sin, -6..=6),
            Acos => (Cos, 0..=12),
            Atan => (Tan, -6..=6),
            _ => return None,
        };
        let turn = |k: i64| rational::integer(k) / rational::integer(12);
        let found = twelfths.find(|&k| self.trigonometric_value(inverse, &turn(k)) == Some(x))?;
        Some(self.scale(&turn(found), self.pi()))
    }

    fn inverse_pair(&self, function: Function, x: Expr) -> Option<Expr> {
        use Function::*;
        let Node::Apply {
            function: inner,
            arguments,
        } = self.node(x)
        else {
            return None;
        };
        let y = *arguments.first()?;
        match (function, inner) {
            (Exp, Log)
            | (Log, Exp)
            | (Sin, Asin)
            | (Cos, Acos)
            | (Tan, Atan)
            | (Sinh, Asinh)
            | (Asinh, Sinh)
            | (Cosh, Acosh)
            | (Tanh, Atanh)
            | (Atanh, Tanh) => Some(y),
            (Abs, Abs) | (Abs, Cosh) | (Abs, Exp) => Some(x),
            // Angles between −π/2 and π/2, or between 0 and π, whose cosines and sines are not negative.
            (Cos, Asin) | (Sin, Acos) => Some(self.sqrt(self.sub(self.one(), self.powi(y, 2)))),
            (Cos, Atan) => Some(self.powi(self.hypotenuse(y), -1)),
            (Sin, Atan) => Some(self.div(y, self.hypotenuse(y))),
            _ => None,
        }
    }

    /// `√(1 + y²)`.
    fn hypotenuse(&self, y: Expr) -> Expr {
        self.sqrt(self.add(&[self.one(), self.powi(y, 2)]))
    }

    /// `r` when `x = r π`.
    pub fn multiple_of_pi(&self, x: Expr) -> Option<Rational> {
        match self.node(x) {
            Node::Pi => Some(Rational::ONE),
            Node::Product {
                coefficient,
                factors,
            } if factors.len() == 1 && matches!(self.node(factors[0]), Node::Pi) => {
                Some(coefficient.clone())
            }
            _ => None,
        }
    }

    fn trigonometric_value(&self, function: Function, multiple: &Rational) -> Option<Expr> {
        use Function::*;
        match function {
            Sin => self.sine_of_turns(multiple),
            Cos => self.sine_of_turns(&(multiple + half())),
            Tan | Cot | Sec | Csc => {
                let s = self.sine_of_turns(multiple)?;
                let c = self.sine_of_turns(&(multiple + half()))?;
                let (top, bottom) = match function {
                    Tan => (s, c),
                    Cot => (c, s),
                    Sec => (self.one(), c),
                    _ => (self.one(), s),
                };
                if self.is_zero(bottom) {
                    None
                } else {
                    Some(self.div(top, bottom))
                }
            }
            _ => None,
        }
    }

    /// `sin(r π)` for r a multiple of 1/6 or 1/4.
    fn sine_of_turns(&self, r: &Rational) -> Option<Expr> {
        let twelfths = rational::to_i64(&(r * rational::integer(12)))?.rem_euclid(24);
        let (steps, negative) = if twelfths >= 12 {
            (twelfths - 12, true)
        } else {
            (twelfths, false)
        };
        let steps = if steps > 6 { 12 - steps } else { steps };
        let halves = match steps {
            0 => return Some(self.zero()),
            2 => 1,
            3 => 2,
            4 => 3,
            6 => 4,
            _ => return None,
        };
        let value = self.scale(&half(), self.sqrt(self.integer(halves)));
        Some(if negative { self.neg(value) } else { value })
    }

    /// A matrix node of `rows × columns`, row by row; `None` when the number of entries is wrong.
    pub fn matrix(&self, rows: usize, columns: usize, entries: &[Expr]) -> Option<Expr> {
        if rows * columns != entries.len() {
            return None;
        }
        Some(self.intern(Node::Matrix {
            rows: u32::try_from(rows).ok()?,
            columns: u32::try_from(columns).ok()?,
            entries: entries.into(),
        }))
    }

    /// Interns `Entry(index)` of the solve `A⁻¹ b` as it stands.
    pub(crate) fn solve_entries(&self, matrix: Expr, rhs: &[Expr]) -> Vec<Expr> {
        let of = self.intern(Node::Solve {
            matrix,
            rhs: rhs.into(),
        });
        (0..rhs.len() as u32)
            .map(|index| self.intern(Node::Entry { of, index }))
            .collect()
    }
}

enum Parity {
    Even,
    Odd,
    None,
}

fn parity(function: Function) -> Parity {
    use Function::*;
    match function {
        Sin | Tan | Cot | Csc | Asin | Atan | Sinh | Tanh | Asinh | Atanh | Sign => Parity::Odd,
        Cos | Sec | Cosh | Abs => Parity::Even,
        Acos | Atan2 | Acosh | Exp | Log => Parity::None,
    }
}

fn half() -> Rational {
    Rational::from_parts(dashu_int::IBig::ONE, 2u8.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    #[test]
    fn parity_is_normalised() {
        let g = Graph::new();
        let (x, y) = (g.symbol("x", 0), g.symbol("y", 0));
        assert_eq!(g.sin(g.sub(y, x)), g.neg(g.sin(g.sub(x, y))));
        assert_eq!(g.cos(g.sub(y, x)), g.cos(g.sub(x, y)));
    }

    #[test]
    fn values_at_multiples_of_pi() {
        let g = Graph::new();
        let at = |n, d| g.scale(&ratio(n, d).unwrap(), g.pi());
        assert_eq!(g.sin(at(1, 6)), g.number(ratio(1, 2).unwrap()));
        assert_eq!(g.cos(at(2, 3)), g.number(ratio(-1, 2).unwrap()));
        assert_eq!(
            g.sin(at(7, 4)),
            g.neg(g.scale(&ratio(1, 2).unwrap(), g.sqrt(g.integer(2))))
        );
        assert_eq!(g.apply(Function::Tan, &[at(1, 4)]), g.one());
        assert_eq!(g.cos(g.pi()), g.integer(-1));
    }

    /// π/6, π/4 and their multiples are found again from their sines, cosines and tangents, in the ranges of the inverse functions.
    #[test]
    fn angles_of_known_values() {
        let g = Graph::new();
        let at = |n: i64| g.scale(&ratio(n, 12).unwrap(), g.pi());
        let inverse = |function, of, n| g.apply(function, &[g.apply(of, &[at(n)])]);
        for n in [-6, -4, -3, -2, 0, 2, 3, 4, 6] {
            assert_eq!(inverse(Function::Asin, Function::Sin, n), at(n));
            assert_eq!(inverse(Function::Acos, Function::Cos, n + 6), at(n + 6));
        }
        for n in [-4, -3, -2, 0, 2, 3, 4] {
            assert_eq!(inverse(Function::Atan, Function::Tan, n), at(n));
        }
        assert_eq!(inverse(Function::Asin, Function::Sin, 8), at(4));
        assert_eq!(inverse(Function::Acos, Function::Cos, -4), at(4));
    }

    #[test]
    fn logarithms_of_roots_of_numbers() {
        let g = Graph::new();
        let log = |e: Expr| g.apply(Function::Log, &[e]);
        let (two, root) = (g.integer(2), g.sqrt(g.integer(2)));
        assert_eq!(g.scale(&Rational::from(2), log(root)), log(two));
        // A root of what may be negative stays.
        let x = g.symbol("x", 0);
        assert_eq!(g.text(log(g.sqrt(x))), "log(sqrt(x))");
    }
}
