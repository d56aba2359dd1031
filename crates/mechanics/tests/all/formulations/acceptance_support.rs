//! Calculus on symbols for the acceptance tests of the theory: derivatives by name, total derivatives, variations.
//!
//! An arbitrary function is replaced by a polynomial of degree two with a free coefficient for every monomial. Its value and
//! its derivatives up to the second order at a point are then arbitrary numbers, independent of each other, so an identity in
//! these that is linear or polynomial holds for every function exactly when it holds for this one.

use crate::formulations::common::{read, Case};
use chetaev_mechanics::{Characteristics, Selection};
use chetaev_symbolic::zero::assumptions::Assumptions;
use chetaev_symbolic::zero::{decide_zero, ZeroTest};
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::sync::Arc;

/// A graph whose symbols are called by name.
pub struct Sheet {
    pub g: Arc<Graph>,
    /// What is known of the symbols.
    pub known: Assumptions,
}

impl Sheet {
    pub fn new() -> Sheet {
        Sheet {
            g: Arc::new(Graph::new()),
            known: Assumptions::new(),
        }
    }

    /// The graph of a system.
    pub fn of(case: &Case) -> Sheet {
        Sheet {
            g: case.system.graph.clone(),
            known: Assumptions::new(),
        }
    }

    /// With symbols that are positive.
    pub fn positive(mut self, names: &[&str]) -> Sheet {
        for name in names {
            let e = self.read(name);
            self.known.positive(&self.g, e);
        }
        self
    }

    pub fn read(&self, text: &str) -> Expr {
        read(&self.g, text)
    }

    pub fn all(&self, texts: &[&str]) -> Vec<Expr> {
        texts.iter().map(|t| self.read(t)).collect()
    }

    pub fn symbol(&self, text: &str) -> Symbol {
        self.g.as_symbol(self.read(text)).unwrap()
    }

    pub fn sum(&self, parts: &[Expr]) -> Expr {
        self.g.add(parts)
    }

    pub fn sub(&self, a: Expr, b: Expr) -> Expr {
        self.g.sub(a, b)
    }

    pub fn mul(&self, a: Expr, b: Expr) -> Expr {
        self.g.mul(&[a, b])
    }

    pub fn dot(&self, a: &[Expr], b: &[Expr]) -> Expr {
        assert_eq!(a.len(), b.len());
        let parts: Vec<Expr> = a.iter().zip(b).map(|(&a, &b)| self.mul(a, b)).collect();
        self.sum(&parts)
    }

    /// ∂e/∂name.
    pub fn by(&self, e: Expr, name: &str) -> Expr {
        self.g.diff(e, self.symbol(name))
    }

    pub fn gradient(&self, e: Expr, names: &[&str]) -> Vec<Expr> {
        names.iter().map(|n| self.by(e, n)).collect()
    }

    /// The derivative with each symbol changing at its rate, all others constant.
    pub fn along(&self, e: Expr, rates: &[(&str, Expr)]) -> Expr {
        let rates: Vec<(Symbol, Expr)> = rates
            .iter()
            .map(|&(name, rate)| (self.symbol(name), rate))
            .collect();
        let value = |s: Symbol| rates.iter().find(|(of, _)| *of == s).map(|&(_, rate)| rate);
        self.g.derive(&[e], &value)[0]
    }

    /// The total time derivative when the symbols of these names move.
    pub fn rate(&self, e: Expr, moving: &[&str]) -> Expr {
        self.g.total_derivative(e, &|name| moving.contains(&name))
    }

    /// E[F] of T1 for coordinates by name: `∂F/∂q - D(∂F/∂q')`.
    pub fn euler(&self, e: Expr, names: &[&str]) -> Vec<Expr> {
        names
            .iter()
            .map(|q| {
                let momentum = self.by(e, &format!("{q}'"));
                self.sub(self.by(e, q), self.rate(momentum, names))
            })
            .collect()
    }

    pub fn put(&self, e: Expr, pairs: &[(&str, &str)]) -> Expr {
        let pairs: Vec<(Expr, Expr)> = pairs
            .iter()
            .map(|(a, b)| (self.read(a), self.read(b)))
            .collect();
        self.g.substitute(e, &pairs)
    }

    pub fn put_all(&self, e: Expr, pairs: &[(&str, Expr)]) -> Expr {
        let pairs: Vec<(Expr, Expr)> = pairs.iter().map(|&(a, b)| (self.read(a), b)).collect();
        self.g.substitute(e, &pairs)
    }

    /// An arbitrary function of these symbols, as far as its derivatives up to the second order.
    pub fn arbitrary(&self, prefix: &str, names: &[&str]) -> Expr {
        let mut parts = vec![self.read(&format!("{prefix}_0"))];
        for (i, &a) in names.iter().enumerate() {
            parts.push(self.mul(self.read(&format!("{prefix}_{}", i + 1)), self.read(a)));
            for (j, &b) in names.iter().enumerate().skip(i) {
                let coefficient = self.read(&format!("{prefix}_{}_{}", i + 1, j + 1));
                parts.push(self.g.mul(&[coefficient, self.read(a), self.read(b)]));
            }
        }
        self.sum(&parts)
    }

    pub fn word(&self, e: Expr) -> &'static str {
        decide_zero(&self.g, &ZeroTest::everywhere(&[e], &self.known)).word()
    }

    #[track_caller]
    pub fn vanishes(&self, e: Expr) {
        assert_eq!(self.word(e), "proved");
    }

    #[track_caller]
    pub fn fails(&self, e: Expr) {
        assert_eq!(self.word(e), "refuted");
    }

    #[track_caller]
    pub fn same(&self, a: Expr, b: Expr) {
        self.vanishes(self.sub(a, b));
    }

    #[track_caller]
    pub fn equal(&self, a: Expr, text: &str) {
        assert_eq!(self.word(self.sub(a, self.read(text))), "proved", "{text}");
    }

    #[track_caller]
    pub fn differ(&self, a: Expr, b: Expr) {
        self.fails(self.sub(a, b));
    }
}

/// Independent velocities for dependent ones given by their places.
pub fn chart(case: &Case, dependent: &[usize]) -> Characteristics {
    let cx = case.context();
    let selection = Selection {
        rows: (0..dependent.len()).collect(),
        dependent: dependent.to_vec(),
    };
    Characteristics::independent_velocities(cx.system, cx.terms, &selection).unwrap()
}

/// Pairs of q'' and the acceleration of the motion, by Routh's equations.
pub fn motion(case: &Case) -> Vec<(Expr, Expr)> {
    let accelerations = case.equations("routh").accelerations;
    let coordinates = case.system.coordinates.iter();
    coordinates
        .zip(accelerations)
        .map(|(c, a)| (c.a, a))
        .collect()
}
