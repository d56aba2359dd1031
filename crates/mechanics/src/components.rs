//! Components of constraints that are products: `(z' - x') (y' - 1) = 0` holds where one of the factors vanishes.
//!
//! A chart that gives a dependent velocity by the others covers the components in whose factor that velocity occurs; where
//! another factor vanishes, the equation says nothing of it.

use crate::constraint::{Constraint, ConstraintKind};
use crate::selection::Selection;
use crate::system::System;
use crate::terms::MotionTerms;
use chetaev_symbolic::factors::factors;
use chetaev_symbolic::{Expr, Function, Graph, Node, Rational, Symbol};

/// The factors of a constraint function in which velocities of the highest order occur, where there are several.
pub(crate) fn factors_of(system: &System, terms: &MotionTerms, row: usize) -> Vec<Expr> {
    let velocities: Vec<Symbol> = terms.jets.iter().map(|c| c.v_symbol).collect();
    let g = &system.graph;
    let gradient = &terms.jacobian[row];
    // What is affine in them has one such factor.
    if !g.any_contains_any(gradient, &velocities) {
        return Vec::new();
    }
    let list = factors(g, terms.constraints[row], &velocities).unwrap_or_default();
    match list.len() {
        0 | 1 => Vec::new(),
        _ => list.into_iter().map(|(factor, _)| factor).collect(),
    }
}

/// The components that the independent velocities of a selection describe, as equations, where they leave others out:
/// `y' = z' + x` of `(y' - z' - x) z' = 0` solved for y'.
pub fn covered(system: &System, terms: &MotionTerms, selection: &Selection) -> Option<String> {
    let g = &system.graph;
    let rows = selection.rows.iter().zip(&selection.dependent);
    let covered: Vec<String> = rows
        .filter_map(|(&row, &dependent)| {
            let all = factors_of(system, terms, row);
            let own = terms.jets.get(dependent)?.v_symbol;
            let with = all.iter().filter(|&&f| g.contains_any(f, &[own]));
            let with: Vec<String> = with.map(|&f| format!("{} = 0", g.text(f))).collect();
            (with.len() < all.len()).then(|| with.join(" or "))
        })
        .collect();
    (!covered.is_empty()).then(|| covered.join(", "))
}

/// A system for which claims are decided in the place of one whose constraints are products, or functions of simpler ones.
#[derive(Clone, Debug)]
pub struct OnComponent {
    /// The system with each such constraint replaced by the factor chosen.
    pub system: System,
    /// What was replaced, in words.
    pub sentence: String,
    /// The equations of the component, where the constraints have others.
    pub condition: Option<String>,
}

/// A factor that is at most so large in units of the model vanishes at the start.
const VANISHES: f64 = 1e-8;

impl System {
    /// The system on one component of constraints nonlinear in the velocities that are products, `z'² = y² x'²`: that with the only factor
    /// that vanishes at the start, by the values of factors there where they are known, else with the first. Constraints `F(u) = c`
    /// and `F(u) = F(w)` with a function F that takes no value twice, `exp(z' − y x') = 1`, are `u = F⁻¹(c)` and `u = w`.
    /// `None` where there are none.
    ///
    /// What is said of motions depends on the set of admissible states, not on the function that vanishes on it, as long as its
    /// gradient does not vanish there; on the factor it is the gradient of the product but for a multiplier.
    pub fn on_component(
        &self,
        at_start: impl Fn(&[Expr]) -> Option<Vec<f64>>,
    ) -> Option<OnComponent> {
        let g = &self.graph;
        let (mut system, mut sentences, mut conditions) = (self.clone(), Vec::new(), Vec::new());
        for constraint in &mut system.constraints {
            if constraint.kind != ConstraintKind::Nonlinear {
                continue;
            }
            let simple = unwrapped(g, constraint.f);
            let list = factors(g, simple, &self.velocity_symbols()).unwrap_or_default();
            let list: Vec<Expr> = list.into_iter().map(|(factor, _)| factor).collect();
            let factor = match list.as_slice() {
                [] | [_] if simple == constraint.f => continue,
                [] | [_] => simple,
                list => chosen(list, at_start(list)),
            };
            let name = constraint.name.clone();
            let text = format!("{} = 0", g.text(factor));
            sentences.push(match list.len() {
                0 | 1 => format!("with `{name}` written as {text}"),
                _ => format!("on the component {text} of `{name}`, the others apart"),
            });
            *constraint = Constraint::classify(self, name, factor).ok()?;
            conditions.extend((list.len() > 1).then_some(text));
        }
        (!sentences.is_empty()).then(|| OnComponent {
            system,
            sentence: sentences.join(" and "),
            condition: (!conditions.is_empty()).then(|| conditions.join(" and ")),
        })
    }
}

/// The factor that vanishes at the start, where only one does, else the first.
fn chosen(list: &[Expr], values: Option<Vec<f64>>) -> Expr {
    let values = values.unwrap_or_default();
    let vanishes = |place: &usize| values.get(*place).is_some_and(|x| x.abs() <= VANISHES);
    let own: Vec<usize> = (0..list.len()).filter(vanishes).collect();
    match own.as_slice() {
        &[place] => list[place],
        _ => list[0],
    }
}

/// A function that vanishes where another does and its gradient does not: arguments of functions that take no value twice.
fn unwrapped(g: &Graph, f: Expr) -> Expr {
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
