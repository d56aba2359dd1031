//! Derivatives of the explicit equations `z' = f(z)` along straight lines through a motion, enclosed, and what they polarize to.
//!
//! The derivatives along a line stay small where those by all variables do not (Kuznetsov 2004, § 10.2).

use crate::expansion::Expansion;
use chetaev_symbolic::number::ball::{Ball, Precision};
use chetaev_symbolic::{Expr, Symbol};

/// A complex vector.
#[derive(Clone, Debug)]
pub(crate) struct Vector {
    pub(crate) re: Vec<Ball>,
    pub(crate) im: Vec<Ball>,
}

impl Vector {
    pub(crate) fn conjugate(&self) -> Vector {
        Vector {
            re: self.re.clone(),
            im: self.im.iter().map(Ball::neg).collect(),
        }
    }

    pub(crate) fn plus(&self, p: &Precision, other: &Vector) -> Option<Vector> {
        Some(Vector {
            re: sums(p, &self.re, &other.re)?,
            im: sums(p, &self.im, &other.im)?,
        })
    }

    /// `Σ ā b`, real and imaginary part.
    pub(crate) fn product(&self, p: &Precision, other: &Vector) -> Option<(Ball, Ball)> {
        let dot = |a: &[Ball], b: &[Ball]| {
            let mut pairs = a.iter().zip(b);
            pairs.try_fold(Ball::zero(), |sum, (a, b)| {
                p.add(&sum, &p.mul(a, b).ok()?).ok()
            })
        };
        let re = p.add(&dot(&self.re, &other.re)?, &dot(&self.im, &other.im)?);
        let im = p.sub(&dot(&self.re, &other.im)?, &dot(&self.im, &other.re)?);
        Some((re.ok()?, im.ok()?))
    }
}

fn sums(p: &Precision, a: &[Ball], b: &[Ball]) -> Option<Vec<Ball>> {
    let all = a.iter().zip(b);
    all.map(|(a, b)| p.add(a, b).ok()).collect()
}

fn differences(p: &Precision, a: &[Ball], b: &[Ball]) -> Option<Vec<Ball>> {
    let all = a.iter().zip(b);
    all.map(|(a, b)| p.sub(a, b).ok()).collect()
}

/// f's derivatives along lines.
pub(crate) struct Lines<'a> {
    about: &'a Expansion<'a>,
    precision: &'a Precision,
    directions: Vec<Symbol>,
    derivatives: [Vec<Expr>; 3],
    point: Vec<(Symbol, Ball)>,
}

impl<'a> Lines<'a> {
    /// Lines through the motion, `over` a parameter with its value; `None` where there are no explicit equations or a number is not enclosed.
    pub(crate) fn new(
        about: &'a Expansion<'a>,
        precision: &'a Precision,
        over: Option<(Symbol, Ball)>,
    ) -> Option<Lines<'a>> {
        let g = about.graph();
        let rates = [about.own.rates.clone(), about.own.equations.rates(g)?].concat();
        let rates = g.substitute_all(&rates, &about.controls(&rates));
        let rates = g.substitute_all(&rates, &about.values);
        let variables = about.variables();
        // No name of a model contains a space.
        let symbol = |i: usize| g.intern_symbol(&format!("along line {i}"), 0);
        let directions: Vec<Symbol> = (0..variables.len()).map(symbol).collect();
        let moved = |s: Symbol| {
            let place = variables.iter().position(|own| *own == s)?;
            Some(g.symbol_expr(directions[place]))
        };
        let first = g.derive(&rates, &moved);
        let second = g.derive(&first, &moved);
        let third = g.derive(&second, &moved);
        let value = |s: Symbol| {
            let own = over.as_ref().filter(|(symbol, _)| *symbol == s);
            own.map(|(_, ball)| ball.clone())
        };
        let values = g
            .enclose(&about.values_of_variables(), precision, &value)
            .ok()?;
        let mut point: Vec<(Symbol, Ball)> = variables.into_iter().zip(values).collect();
        point.extend(over);
        Some(Lines {
            about,
            precision,
            directions,
            derivatives: [first, second, third],
            point,
        })
    }

    fn along(&self, order: usize, direction: &[Ball]) -> Option<Vec<Ball>> {
        let value = |s: Symbol| {
            let place = self.directions.iter().position(|own| *own == s);
            let known = || self.point.iter().find(|(own, _)| *own == s);
            match place {
                Some(i) => Some(direction[i].clone()),
                None => known().map(|(_, ball)| ball.clone()),
            }
        };
        let g = self.about.graph();
        g.enclose(&self.derivatives[order - 1], self.precision, &value)
            .ok()
    }

    /// ∂f/∂z, row by row.
    pub(crate) fn slopes(&self) -> Option<Vec<Vec<Ball>>> {
        let n = self.directions.len();
        let column = |c: usize| {
            let mut direction = vec![Ball::zero(); n];
            direction[c] = Ball::integer(1);
            self.along(1, &direction)
        };
        let columns: Vec<Vec<Ball>> = (0..n).map(column).collect::<Option<_>>()?;
        let row = |r: usize| columns.iter().map(|column| column[r].clone()).collect();
        Some((0..n).map(row).collect())
    }

    /// B(a, b) by `4 B(a, b) = B(a + b, a + b) − B(a − b, a − b)`.
    fn twice(&self, a: &[Ball], b: &[Ball]) -> Option<Vec<Ball>> {
        let p = self.precision;
        let sum = self.along(2, &sums(p, a, b)?)?;
        let difference = self.along(2, &differences(p, a, b)?)?;
        let found = differences(p, &sum, &difference)?;
        Some(found.iter().map(|ball| ball.shift(-2)).collect())
    }

    /// C(a, a, b) by `6 C(a, a, b) = C(a + b)³ − C(a − b)³ − 2 C(b)³`.
    fn thrice(&self, a: &[Ball], b: &[Ball]) -> Option<Vec<Ball>> {
        let p = self.precision;
        let sum = self.along(3, &sums(p, a, b)?)?;
        let difference = self.along(3, &differences(p, a, b)?)?;
        let both = differences(p, &sum, &difference)?;
        let own: Vec<Ball> = self.along(3, b)?.iter().map(|ball| ball.shift(1)).collect();
        let six = Ball::integer(6);
        let found = differences(p, &both, &own)?;
        found.iter().map(|ball| p.div(ball, &six).ok()).collect()
    }

    /// B of complex vectors.
    pub(crate) fn second(&self, u: &Vector, w: &Vector) -> Option<Vector> {
        let p = self.precision;
        Some(Vector {
            re: differences(p, &self.twice(&u.re, &w.re)?, &self.twice(&u.im, &w.im)?)?,
            im: sums(p, &self.twice(&u.re, &w.im)?, &self.twice(&u.im, &w.re)?)?,
        })
    }

    /// `C(q, q, q̄)`.
    pub(crate) fn third(&self, q: &Vector) -> Option<Vector> {
        let p = self.precision;
        Some(Vector {
            re: sums(p, &self.along(3, &q.re)?, &self.thrice(&q.im, &q.re)?)?,
            im: sums(p, &self.thrice(&q.re, &q.im)?, &self.along(3, &q.im)?)?,
        })
    }
}
