//! Lyapunov functions from integrals: Chetaev's bundle (Routh 1877, Lyapunov 1892, Chetaev 1946).
//!
//! With integrals Fᵢ and numbers κᵢ such that `Σ κᵢ dFᵢ = 0` at the motion, `V = Σ κᵢ (Fᵢ − Fᵢ⁰) + N Σ (Fᵢ − Fᵢ⁰)²` is definite for large N, and the
//! motion stable, where the second variation of `Σ κᵢ Fᵢ` is definite on the directions in which no integral changes. That is so
//! where its leading minors there are all positive, or alternate (Sylvester). A function that never grows, as the energy under dissipation, takes part with a
//! positive weight and without its square; the form must then be positive (Thomson and Tait 1879, Chetaev 1946).

use crate::integrals::Jet;
use crate::multiplicity::product;
use crate::real_roots::sign_of;
use crate::steady::{closed, kernel};
use chetaev_symbolic::factors::{coefficients, factors};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Graph, Symbol};
use std::cmp::Ordering;

/// More combinations are not looked at.
const COMBINATIONS: usize = 4;

/// One combination of integrals with the minors of its second variation.
#[derive(Clone, Debug)]
pub struct Bundle {
    /// The combination as it is read.
    pub text: String,
    /// What must not vanish.
    pub nonzero: Vec<Expr>,
    /// The leading minors.
    pub minors: Vec<Expr>,
    /// Whether a function that falls is among them: then the form must be positive.
    pub falls: bool,
    /// κ, one number for each integral.
    pub weights: Vec<Expr>,
    /// The second variation on the directions in which no integral changes.
    pub form: Vec<Vec<Expr>>,
}

impl Bundle {
    /// Whether it is definite, given the signs of its functions.
    pub fn is_definite(&self, sign: &dyn Fn(Expr) -> Option<Ordering>) -> bool {
        let is_apart = |&e: &Expr| sign(e).is_some_and(|s| s != Ordering::Equal);
        if !self.nonzero.iter().all(is_apart) {
            return false;
        }
        let signs: Option<Vec<Ordering>> = self.minors.iter().map(|&e| sign(e)).collect();
        signs.is_some_and(|signs| is_positive(&signs) || !self.falls && is_negative(&signs))
    }

    /// It with a value for a symbol.
    pub(crate) fn at(&self, g: &Graph, value: (Expr, Expr)) -> Bundle {
        let put = |es: &[Expr]| -> Vec<Expr> {
            let found = g.substitute_all(es, &[value]);
            found.into_iter().map(|e| closed(g, e)).collect()
        };
        Bundle {
            text: self.text.clone(),
            nonzero: put(&self.nonzero),
            minors: put(&self.minors),
            falls: self.falls,
            weights: put(&self.weights),
            form: self.form.iter().map(|row| put(row)).collect(),
        }
    }

    /// What must keep its sign.
    pub fn functions(&self) -> impl Iterator<Item = Expr> + '_ {
        self.nonzero.iter().chain(&self.minors).copied()
    }
}

/// Whether a form with minors of these signs is positive.
pub(crate) fn is_positive(minors: &[Ordering]) -> bool {
    minors.iter().all(|s| *s == Ordering::Greater)
}

/// Whether a form with minors of these signs is negative.
pub(crate) fn is_negative(minors: &[Ordering]) -> bool {
    let mut all = minors.iter().enumerate();
    all.all(|(at, s)| match at % 2 {
        0 => *s == Ordering::Less,
        _ => *s == Ordering::Greater,
    })
}

/// The bundles of these integrals of n variables.
pub fn bundles(g: &Graph, jets: &[Jet], n: usize) -> Vec<Bundle> {
    let gradients: Vec<Vec<Expr>> = jets.iter().map(|jet| jet.gradient.clone()).collect();
    // Only what is constant restricts the motions.
    let constant = jets.iter().filter(|jet| !jet.falls);
    let constant: Vec<Vec<Expr>> = constant.map(|jet| jet.gradient.clone()).collect();
    let (directions, nonzero) = kernel(g, &constant, n);
    let transposed: Vec<Vec<Expr>> = (0..n)
        .map(|c| gradients.iter().map(|row| row[c]).collect())
        .collect();
    let (combinations, further) = kernel(g, &transposed, jets.len());
    let nonzero = [nonzero, further].concat();
    if directions.is_empty() {
        return vec![Bundle {
            text: "the integrals determine the variables near the motion".into(),
            nonzero,
            minors: Vec::new(),
            falls: false,
            weights: Vec::new(),
            form: Vec::new(),
        }];
    }
    let forms: Vec<Combination> = combinations
        .into_iter()
        .take(COMBINATIONS)
        .filter_map(|weights| weighted(g, jets, weights))
        .map(|weights| Combination {
            form: restricted(g, jets, &weights, &directions),
            falls: falling(g, jets, &weights),
            weights,
        })
        .collect();
    let mut found: Vec<Bundle> = forms
        .iter()
        .map(|own| own.bundle(g, jets, &nonzero))
        .collect();
    for (at, one) in forms.iter().enumerate() {
        for other in forms
            .iter()
            .enumerate()
            .filter(|(place, other)| *place != at && !other.falls && (one.falls || *place < at))
            .map(|(_, other)| other)
        {
            found.extend(pencils(g, jets, [one, other], &nonzero));
        }
    }
    found
}

/// Whether a function that falls has a weight.
fn falling(g: &Graph, jets: &[Jet], weights: &[Expr]) -> bool {
    let mut own = jets.iter().zip(weights);
    own.any(|(jet, &w)| jet.falls && !g.is_zero(w))
}

/// Weights of which those of the functions that fall are positive, being numbers; `None` where these have different signs.
fn weighted(g: &Graph, jets: &[Jet], weights: Vec<Expr>) -> Option<Vec<Expr>> {
    if !falling(g, jets, &weights) {
        return Some(weights);
    }
    let own = jets.iter().zip(&weights).filter(|(jet, _)| jet.falls);
    let signs: Option<Vec<Ordering>> = own
        .map(|(_, &w)| sign_of(g, w))
        .filter(|sign| *sign != Some(Ordering::Equal))
        .collect();
    let signs = signs?;
    let first = *signs.first()?;
    if signs.iter().any(|sign| *sign != first) {
        return None;
    }
    Some(match first {
        Ordering::Less => weights.iter().map(|&w| g.neg(w)).collect(),
        _ => weights,
    })
}

/// Numbers κ with `Σ κ dF = 0`, and the second variation on the directions in which no integral changes.
struct Combination {
    weights: Vec<Expr>,
    form: Vec<Vec<Expr>>,
    /// Whether a function that falls has a weight, which is positive.
    falls: bool,
}

impl Combination {
    fn bundle(&self, g: &Graph, jets: &[Jet], nonzero: &[Expr]) -> Bundle {
        let terms = jets
            .iter()
            .zip(&self.weights)
            .filter(|(_, &w)| !g.is_zero(w));
        let terms = terms.map(|(jet, &w)| {
            if g.is_one(w) {
                jet.name.clone()
            } else {
                format!("({}) times {}", g.text(w), jet.name)
            }
        });
        Bundle {
            text: terms.collect::<Vec<_>>().join(" + "),
            nonzero: nonzero.to_vec(),
            minors: minors(g, &self.form),
            falls: self.falls,
            weights: self.weights.clone(),
            form: self.form.clone(),
        }
    }

    /// This one and t times another.
    fn plus(&self, g: &Graph, t: Expr, other: &Combination) -> Combination {
        let sum = |(&a, &b): (&Expr, &Expr)| closed(g, g.add(&[a, g.mul(&[t, b])]));
        let rows = self.form.iter().zip(&other.form);
        Combination {
            falls: self.falls,
            weights: self.weights.iter().zip(&other.weights).map(sum).collect(),
            form: rows
                .map(|(a, b)| a.iter().zip(b).map(sum).collect())
                .collect(),
        }
    }
}

/// Bundles `one + t other` at the values of t, rational in the parameters, at which a factor of a minor is stationary: where a form of a
/// pencil is definite for some t, its minors are positive about their stationary values.
fn pencils(
    g: &Graph,
    jets: &[Jet],
    [one, other]: [&Combination; 2],
    nonzero: &[Expr],
) -> Vec<Bundle> {
    let symbol = g.intern_symbol("multiplier", 0);
    let general = one.plus(g, g.symbol_expr(symbol), other);
    let mut values: Vec<(Expr, Expr)> = Vec::new();
    for minor in minors(g, &general.form) {
        let parts = factors(g, minor, &[symbol]).unwrap_or_default();
        for (part, _) in parts {
            for own in linear_zeros(g, g.diff(part, symbol), symbol) {
                if !values.contains(&own) {
                    values.push(own);
                }
            }
        }
    }
    let bundle = |(below, t): (Expr, Expr)| {
        let nonzero = [nonzero, &[below]].concat();
        one.plus(g, t, other).bundle(g, jets, &nonzero)
    };
    values.into_iter().map(bundle).collect()
}

/// The zeros of the factors that are linear in a symbol, each with the coefficient by which was divided.
fn linear_zeros(g: &Graph, e: Expr, symbol: Symbol) -> Vec<(Expr, Expr)> {
    let parts = factors(g, e, &[symbol]).unwrap_or_default();
    let zero = |(part, _): (Expr, u32)| match coefficients(g, part, symbol)?.as_slice() {
        &[constant, slope] => Some((slope, closed(g, g.neg(g.div(constant, slope))))),
        _ => None,
    };
    parts.into_iter().filter_map(zero).collect()
}

/// `Nᵀ (Σ κ F'') N`.
fn restricted(
    g: &Graph,
    jets: &[Jet],
    weights: &[Expr],
    directions: &[Vec<Expr>],
) -> Vec<Vec<Expr>> {
    let n = directions.first().map_or(0, Vec::len);
    let entry = |r: usize, c: usize| {
        let terms = jets
            .iter()
            .zip(weights)
            .map(|(jet, &w)| g.mul(&[w, jet.hessian[r][c]]));
        g.add(&terms.collect::<Vec<_>>())
    };
    let whole: Vec<Vec<Expr>> = (0..n)
        .map(|r| (0..n).map(|c| entry(r, c)).collect())
        .collect();
    let columns: Vec<Vec<Expr>> = (0..n)
        .map(|r| directions.iter().map(|own| own[r]).collect())
        .collect();
    product(g, directions, &product(g, &whole, &columns))
}

pub(crate) fn minors(g: &Graph, form: &[Vec<Expr>]) -> Vec<Expr> {
    let leading = |size: usize| -> Vec<Vec<Expr>> {
        form[..size]
            .iter()
            .map(|row| row[..size].to_vec())
            .collect()
    };
    (1..=form.len())
        .map(|size| closed(g, determinant(g, &leading(size))))
        .collect()
}
