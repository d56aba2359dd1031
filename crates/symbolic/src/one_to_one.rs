//! Functions that take no value twice: where `F(u) = c` or `F(u) = F(w)` with such a function, `u = F⁻¹(c)` or `u = w`.

use crate::{Expr, Function, Graph, Node, Rational};

/// What vanishes where a function does, as the functions around it take no value twice: `u` of `exp(u) − 1`.
pub fn innermost(g: &Graph, f: Expr) -> Expr {
    let mut e = f;
    // Each argument is a smaller expression.
    while let Some(inner) = argument(g, e) {
        e = inner;
    }
    e
}

/// `u − F⁻¹(c)` of `F(u) − c`, and `u − w` of `F(u) − F(w)`.
fn argument(g: &Graph, e: Expr) -> Option<Expr> {
    let zero = Rational::from(0);
    let (constant, terms) = match g.node(e) {
        Node::Sum { constant, terms } => (constant.clone(), terms.to_vec()),
        _ => (zero.clone(), vec![(e, Rational::from(1))]),
    };
    match terms.as_slice() {
        [(term, c)] => {
            let (of, argument) = one_to_one(g, *term)?;
            let value = g.scale(&(-constant / c.clone()), g.one());
            Some(g.sub(argument, of.inverse(g, value)?))
        }
        [(a, c), (b, d)] if constant == zero && *c == -d.clone() => {
            let ((of, u), (other, w)) = (one_to_one(g, *a)?, one_to_one(g, *b)?);
            (of == other).then(|| g.sub(u, w))
        }
        _ => None,
    }
}

/// A function that takes no value twice, where it is real.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OneToOne {
    Named(Function),
    /// A power of what is not negative.
    Power(Expr),
}

fn one_to_one(g: &Graph, e: Expr) -> Option<(OneToOne, Expr)> {
    use Function::{Asin, Asinh, Atan, Atanh, Exp, Log, Sinh, Tanh};
    match g.node(e) {
        Node::Apply {
            function,
            arguments,
        } => {
            let known = [Asin, Asinh, Atan, Atanh, Exp, Log, Sinh, Tanh].contains(function);
            known.then(|| (OneToOne::Named(*function), arguments[0]))
        }
        Node::Power { base, exponent } => {
            let is_root = g.as_number(*exponent).is_some() && g.as_integer(*exponent).is_none();
            is_root.then_some((OneToOne::Power(*exponent), *base))
        }
        _ => None,
    }
}

impl OneToOne {
    /// The argument at which the function takes a value; `None` where it does not, or where its gradient may vanish.
    fn inverse(self, g: &Graph, value: Expr) -> Option<Expr> {
        use Function::{Asin, Asinh, Atan, Atanh, Exp, Log, Sinh, Tanh};
        let number = g.evaluate_f64(&[value], &|_| None).ok()?[0];
        match self {
            OneToOne::Named(function) => {
                let inverse = match function {
                    Exp if number > 0.0 => Log,
                    Log => Exp,
                    Sinh => Asinh,
                    Asinh => Sinh,
                    Tanh if number.abs() < 1.0 => Atanh,
                    Atanh => Tanh,
                    Atan if number.abs() < std::f64::consts::FRAC_PI_2 => {
                        return Some(g.apply(Function::Tan, &[value]))
                    }
                    Asin if number.abs() < std::f64::consts::FRAC_PI_2 => {
                        return Some(g.sin(value))
                    }
                    _ => return None,
                };
                Some(g.apply(inverse, &[value]))
            }
            OneToOne::Power(exponent) => {
                (number > 0.0).then(|| g.pow(value, g.div(g.one(), exponent)))
            }
        }
    }
}
