//! A function of one symbol alone vanishes along a motion only where the symbol stays constant.

use super::angles::{period, Angle, VALUES};
use super::{Case, Found, Search};
use crate::stationarity::closed_form::short;
use chetaev_mechanics::equations::unused_name;
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::{coefficients, factored};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{rational, simplify, Expr, Function, Node, Symbol};

/// Longer roots of parameters are not written.
const LONGEST_ROOT: u64 = 30;

/// The values of the square root in the solutions of a quadratic equation.
pub(super) enum Root {
    /// Real only where this vanishes, if parameters are not particular ones.
    Imaginary(Expr),
    /// ± this root.
    Both(Expr),
    /// It has no closed form with polynomials in the state.
    Unknown,
}

impl Search<'_, '_> {
    /// The cases in which a function of one symbol of the state vanishes: the symbol is constant, so its rate vanishes. Where it
    /// does already, the values. `None` for a function of others, and where the values have no closed form.
    pub(super) fn where_constant(
        &self,
        found: &mut Found,
        case: &Case,
        factor: Expr,
    ) -> Option<Vec<Case>> {
        let g = self.g;
        let mut moving = g.symbols_in(&[factor]);
        moving.retain(|s| self.state.contains(s) || *s == g.intern_symbol("t", 0));
        let &[symbol] = moving.as_slice() else {
            return None;
        };
        if !self.state.contains(&symbol) {
            // A function of the time vanishes at single times.
            return Some(Vec::new());
        }
        // Where the values are complicated the rate tells more at first.
        if !self.is_analytic(factor, symbol) {
            return None;
        }
        let rate = self.on(case, self.motion.rate(g, symbol));
        let is_simple = || {
            period(self.cx.system, self.motion, symbol).is_some()
                && self
                    .as_circular(factor, symbol)
                    .is_some_and(|(_, _, degree)| degree == 1)
        };
        if !g.is_zero(rate) && !case.constant.contains(&symbol) && !is_simple() {
            let mut case = case.clone();
            case.constant.push(symbol);
            return Some(self.require(found, &case, rate));
        }
        match coefficients(g, factor, symbol) {
            Some(_) => {
                let values = self.zeros(factor, symbol)?;
                let cases = values.into_iter();
                Some(
                    cases
                        .filter_map(|value| self.with(case, g.symbol_expr(symbol), value))
                        .collect(),
                )
            }
            None => self.at_angles(found, case, factor, symbol),
        }
    }

    /// Whether the zeros of a function of one symbol are isolated, as far as its form tells: no roots, no absolute values.
    fn is_analytic(&self, e: Expr, symbol: Symbol) -> bool {
        let g = self.g;
        g.reachable(&[e]).into_iter().all(|e| {
            let is_entire = match g.node(e) {
                Node::Apply { function, .. } => matches!(
                    function,
                    Function::Sin | Function::Cos | Function::Tan | Function::Exp
                ),
                Node::Power { exponent, .. } => g.as_integer(*exponent).is_some(),
                _ => true,
            };
            is_entire || !g.contains_any(e, &[symbol])
        })
    }

    /// The values of an angle at which a polynomial in its sine, or in its cosine, vanishes.
    fn at_angles(
        &self,
        found: &mut Found,
        case: &Case,
        factor: Expr,
        symbol: Symbol,
    ) -> Option<Vec<Case>> {
        let g = self.g;
        let (circular, values, degree) = self.as_circular(factor, symbol)?;
        let values = values?;
        let Node::Apply {
            function,
            arguments,
        } = g.node(circular)
        else {
            return None;
        };
        let slope = g.diff(arguments[0], symbol);
        let number = g.as_number(slope)?;
        let period = period(self.cx.system, self.motion, symbol);
        let turns = period.and_then(|period| {
            rational::to_i64(&(rational::abs(number) * rational::integer(period)))
        });
        let turns = turns.filter(|turns| 2 * turns <= VALUES);
        let at = g.symbol_expr(symbol);
        let rest = g.sub(arguments[0], g.mul(&[slope, at]));
        let mut cases = Vec::new();
        for value in values {
            if !self.is_cosine(value) {
                continue;
            }
            if simplify::length(g, value) > LONGEST_ROOT {
                return None;
            }
            let inverse = |function| match g.is_zero(g.add(&[value, g.one()])) {
                true if function == Function::Acos => g.pi(),
                _ => g.apply(function, &[value]),
            };
            let first = match function {
                Function::Sin => [
                    inverse(Function::Asin),
                    g.sub(g.pi(), inverse(Function::Asin)),
                ],
                _ => [inverse(Function::Acos), g.neg(inverse(Function::Acos))],
            };
            // At the ends of the range both are the same.
            let is_end = g.is_zero(g.sub(g.powi(value, 2), g.one()));
            let first = &first[..2 - usize::from(is_end)];
            let angle = Angle {
                symbol: at,
                factor: match degree {
                    1 => factor,
                    _ => g.sub(circular, value),
                },
                period: turns.and(period),
                of: first.len() * turns.unwrap_or(1) as usize,
                whole: false,
            };
            if turns.is_none() {
                let (text, symbol, and) = (g.text(factor), g.text(at), self.place(case));
                self.leave(found, case, format!("{text} = 0 at other {symbol}, {and}"));
            }
            for turn in 0..turns.unwrap_or(1) {
                for &first in first {
                    let more = g.mul(&[g.integer(2 * turn), g.pi()]);
                    let angle_value = short(g, g.div(g.sub(g.add(&[first, more]), rest), slope));
                    let Some(mut case) = self.with(case, at, angle_value) else {
                        continue;
                    };
                    case.angles.push(angle.clone());
                    cases.push(case);
                }
            }
        }
        Some(cases)
    }

    /// A sine or cosine in which a factor is a polynomial, its values where that vanishes, as far as they have a closed form,
    /// and the degree.
    fn as_circular(
        &self,
        factor: Expr,
        symbol: Symbol,
    ) -> Option<(Expr, Option<Vec<Expr>>, usize)> {
        let g = self.g;
        let name = unused_name(self.cx.system, "value");
        let (place, own) = (g.symbol(&name, 0), g.intern_symbol(&name, 0));
        g.reachable(&[factor]).into_iter().find_map(|e| {
            let circular = matches!(
                g.node(e),
                Node::Apply {
                    function: Function::Sin | Function::Cos,
                    ..
                }
            );
            let written = circular.then(|| g.substitute(factor, &[(e, place)]))?;
            if g.contains_any(written, &[symbol]) {
                return None;
            }
            let degree = coefficients(g, written, own)?.len() - 1;
            Some((e, self.zeros(written, own), degree))
        })
    }

    /// Whether a value may be between −1 and 1.
    fn is_cosine(&self, value: Expr) -> bool {
        let g = self.g;
        let rest = g.sub(g.one(), g.powi(value, 2));
        let known = |e: Expr| known_sign(g, e, &assumptions(self.cx.system));
        let product = factored(g, rest).map_or(rest, |parts| {
            let factors = parts.factors.iter().map(|&(f, n)| g.powi(f, n));
            let factors: Vec<Expr> = factors.collect();
            g.scale(&parts.coefficient, g.mul(&factors))
        });
        g.is_zero(rest) || !known(rest).is_nonpositive() && !known(product).is_nonpositive()
    }

    /// The zeros of a polynomial of degree one or two whose coefficients do not move.
    fn zeros(&self, polynomial: Expr, symbol: Symbol) -> Option<Vec<Expr>> {
        let g = self.g;
        let list = coefficients(g, polynomial, symbol)?;
        match *list.as_slice() {
            [c, b] => Some(vec![short(g, g.neg(g.div(c, b)))]),
            [c, b, a] => match self.root_of_discriminant(a, b, c) {
                Root::Imaginary(_) => Some(Vec::new()),
                Root::Both(root) => Some(self.both(a, b, root)),
                Root::Unknown => None,
            },
            _ => None,
        }
    }

    /// `(−b ± root)/(2 a)`.
    pub(super) fn both(&self, a: Expr, b: Expr, root: Expr) -> Vec<Expr> {
        let g = self.g;
        let twice = g.scale(&rational::integer(2), a);
        let value = |root: Expr| short(g, g.div(g.sub(root, b), twice));
        match g.is_zero(root) {
            true => vec![value(root)],
            false => vec![value(root), value(g.neg(root))],
        }
    }

    /// `√(b² − 4 a c)` as a root of parameters times a rational function of the state.
    pub(super) fn root_of_discriminant(&self, a: Expr, b: Expr, c: Expr) -> Root {
        let g = self.g;
        let four = g.scale(&rational::integer(4), g.mul(&[a, c]));
        let discriminant = g.sub(g.powi(b, 2), four);
        let Some(parts) = factored(g, discriminant) else {
            return Root::Unknown;
        };
        let (mut outside, mut inside) = (Vec::new(), vec![g.number(parts.coefficient)]);
        for (factor, power) in parts.factors {
            if power % 2 != 0 && g.contains_any(factor, &self.state) {
                return Root::Unknown;
            }
            match power % 2 {
                0 => outside.push(g.powi(factor, power / 2)),
                _ => inside.push(g.powi(factor, power)),
            }
        }
        let inside = g.mul(&inside);
        if simplify::length(g, inside) > LONGEST_ROOT {
            return Root::Unknown;
        }
        let known = known_sign(g, inside, &assumptions(self.cx.system));
        if g.is_zero(inside) {
            return Root::Both(g.zero());
        }
        if known.is_nonpositive() {
            return Root::Imaginary(g.mul(&outside));
        }
        outside.push(g.sqrt(inside));
        Root::Both(g.mul(&outside))
    }
}
