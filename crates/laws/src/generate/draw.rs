//! Random numbers and functions of the coordinates.

use chetaev_symbolic::number::random::Random;
use chetaev_symbolic::rational::ratio;
use chetaev_symbolic::{Expr, Graph, Rational};

/// Which functions of the coordinates occur.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Polynomials.
    Polynomial,
    /// Sines and cosines of combinations of coordinates, with polynomial factors now and then.
    Trigonometric,
}

/// Draws the pieces of a system with n coordinates.
pub(super) struct Draw<'g> {
    pub(super) g: &'g Graph,
    pub(super) random: Random,
    pub(super) kind: Kind,
    /// Names of the coordinates.
    pub(super) names: Vec<String>,
    /// The coordinates that functions may contain.
    pub(super) visible: Vec<usize>,
}

impl Draw<'_> {
    pub(super) fn n(&self) -> usize {
        self.names.len()
    }

    pub(super) fn q(&self, i: usize) -> Expr {
        self.g.symbol(&self.names[i], 0)
    }

    pub(super) fn v(&self, i: usize) -> Expr {
        self.g.symbol(&self.names[i], 1)
    }

    pub(super) fn t(&self) -> Expr {
        self.g.symbol("t", 0)
    }

    /// A whole number in `low..=high`.
    pub(super) fn between(&mut self, low: i64, high: i64) -> i64 {
        self.random.between(low, high)
    }

    /// An index in `0..bound`.
    pub(super) fn index(&mut self, bound: usize) -> usize {
        self.random.below(bound as u64) as usize
    }

    /// True once in `times`.
    pub(super) fn one_in(&mut self, times: u64) -> bool {
        self.random.below(times) == 0
    }

    /// A positive rational with small terms.
    pub(super) fn positive(&mut self) -> Rational {
        let (numerator, denominator) = (self.between(1, 6), self.between(1, 4));
        ratio(numerator, denominator).unwrap_or(Rational::ONE)
    }

    /// A rational with small terms, not zero.
    pub(super) fn coefficient(&mut self) -> Rational {
        let magnitude = self.positive();
        if self.one_in(2) {
            -magnitude
        } else {
            magnitude
        }
    }

    /// A coordinate other than `avoid`, where there is one.
    pub(super) fn other(&mut self, avoid: &[usize]) -> usize {
        let all: Vec<usize> = (0..self.n()).collect();
        self.other_of(&all, avoid)
    }

    fn other_of(&mut self, all: &[usize], avoid: &[usize]) -> usize {
        let open: Vec<usize> = all.iter().copied().filter(|i| !avoid.contains(i)).collect();
        match open.len() {
            0 => all[self.index(all.len())],
            count => open[self.index(count)],
        }
    }

    /// A coordinate that functions may contain.
    fn seen(&mut self) -> usize {
        let place = self.index(self.visible.len());
        self.visible[place]
    }

    /// A random order of the coordinates.
    pub(super) fn shuffled(&mut self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.n()).collect();
        for i in (1..order.len()).rev() {
            order.swap(i, self.index(i + 1));
        }
        order
    }

    /// A function of the coordinates with at most `terms` terms, one of them not constant.
    pub(super) fn function(&mut self, terms: u64) -> Expr {
        let count = 1 + self.random.below(terms);
        let mut parts: Vec<Expr> = (0..count).map(|_| self.term()).collect();
        if self.one_in(2) {
            let constant = self.coefficient();
            parts.push(self.g.number(constant));
        }
        self.g.add(&parts)
    }

    fn term(&mut self) -> Expr {
        let scale = self.coefficient();
        let e = match self.kind {
            Kind::Polynomial => self.monomial(),
            Kind::Trigonometric => self.oscillation(),
        };
        self.g.scale(&scale, e)
    }

    fn monomial(&mut self) -> Expr {
        let (i, j) = (self.seen(), self.seen());
        match self.between(0, 3) {
            0 | 1 => self.q(i),
            2 => self.g.mul(&[self.q(i), self.q(j)]),
            _ => {
                let power = self.between(2, 3);
                self.g.powi(self.q(i), power)
            }
        }
    }

    fn oscillation(&mut self) -> Expr {
        let wave = self.wave();
        match self.between(0, 5) {
            0 => {
                let second = self.wave();
                self.g.mul(&[wave, second])
            }
            1 => {
                let i = self.seen();
                self.g.mul(&[wave, self.q(i)])
            }
            _ => wave,
        }
    }

    fn wave(&mut self) -> Expr {
        let argument = self.angle();
        if self.one_in(2) {
            self.g.sin(argument)
        } else {
            self.g.cos(argument)
        }
    }

    /// Mostly a coordinate; sums, differences, doubles and halves too.
    fn angle(&mut self) -> Expr {
        let i = self.seen();
        let j = self.other_of(&self.visible.clone(), &[i]);
        let (g, q) = (self.g, self.q(i));
        match self.between(0, 9) {
            0 => g.scale(&ratio(2, 1).unwrap_or(Rational::ONE), q),
            1 => g.scale(&ratio(1, 2).unwrap_or(Rational::ONE), q),
            2 => g.add(&[q, self.q(j)]),
            3 => g.sub(q, self.q(j)),
            _ => q,
        }
    }

    /// A function that is nowhere zero: 1 + f², or 3 + sin, with a positive scale.
    pub(super) fn nowhere_zero(&mut self) -> Expr {
        let scale = self.positive();
        let e = match self.kind {
            Kind::Polynomial => {
                let f = self.term();
                self.g.add(&[self.g.one(), self.g.powi(f, 2)])
            }
            Kind::Trigonometric => {
                let wave = self.wave();
                let shift = self.between(2, 4);
                self.g.add(&[self.g.integer(shift), wave])
            }
        };
        self.g.scale(&scale, e)
    }
}
