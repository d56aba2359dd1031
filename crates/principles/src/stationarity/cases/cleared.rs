//! Sets whose solved equations have poles, `x = −y sin φ/cos φ`, written with the pole cleared, `x cos φ + y sin φ = 0`.
//!
//! A motion of such a set may pass through the pole. By continuity it stays stationary there, as long as κ has no pole itself. What
//! has to be shown is that the cleared equations hold nowhere but on the set and its limits: that they describe, where the
//! denominator D vanishes, a smooth set in which D = 0 is of lower dimension.

use super::{Case, Found, Leaf, Search};
use chetaev_symbolic::factors::{coefficients, factored};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::{Expr, Symbol};

/// More minors than this are not looked at.
const MINORS: usize = 40;

/// Equations in the place of those with poles, and of those that are not solved.
#[derive(Clone, Debug)]
pub(super) struct Cleared {
    /// What vanishes.
    pub(super) equations: Vec<Expr>,
    /// The symbols whose values have poles.
    pub(super) symbols: Vec<Expr>,
}

/// What is known of the states of a set at which a denominator vanishes.
enum Limit {
    /// The equations without the denominator hold at none.
    None,
    /// All of them are limits of the set.
    All,
    /// It is not known which of them are.
    Open,
}

impl Search<'_, '_> {
    /// Clears the poles of a set that are none of κ, where nothing is added by that; what stays open where it is not known.
    pub(super) fn clear(&self, leaf: &mut Leaf, case: &Case) -> Vec<String> {
        let poles: Vec<Expr> = leaf.nonzero.clone();
        let of_kappa = self.poles_of_kappa(leaf);
        let poles = poles.into_iter().filter(|e| !of_kappa.contains(e));
        let mut poles: Vec<Expr> = poles.collect();
        if poles.is_empty() {
            return Vec::new();
        }
        let (regular, symbols, forms) = match case.roots.is_empty() {
            true => self.without_poles(leaf, case, &poles),
            false => (Case::default(), Vec::new(), Vec::new()),
        };
        for form in &forms {
            let limits = poles.iter().map(|&pole| self.limit(&regular, form, pole));
            let limits: Vec<Limit> = limits.collect();
            if limits.iter().any(|limit| matches!(limit, Limit::Open)) {
                continue;
            }
            let mut limits = limits.iter();
            poles.retain(|_| matches!(limits.next(), Some(Limit::All)));
            if !poles.is_empty() {
                leaf.cleared = Some(Cleared {
                    equations: form.clone(),
                    symbols,
                });
                leaf.nonzero.retain(|e| !poles.contains(e));
            }
            return Vec::new();
        }
        let place = self.place(case);
        let text = |e: &Expr| format!("{} = 0 in the limit of {place}", self.g.text(*e));
        poles.iter().map(text).collect()
    }

    /// Denominators of the conditions on κ.
    fn poles_of_kappa(&self, leaf: &Leaf) -> Vec<Expr> {
        let rows = leaf.rows.iter().flatten();
        let all = rows.flat_map(|(_, row)| row.coefficients.iter().chain([&row.right]));
        let of = |e: &Expr| factored(self.g, *e).map(|parts| parts.factors);
        let factors = all.filter_map(of).flatten();
        factors.filter(|(_, n)| *n < 0).map(|(f, _)| f).collect()
    }

    /// The equations of a set without poles as a case, the symbols of the others, and what vanishes instead, in up to two forms: the equations with poles multiplied
    /// by these, and the equations as they were first found.
    fn without_poles(
        &self,
        leaf: &Leaf,
        case: &Case,
        poles: &[Expr],
    ) -> (Case, Vec<Expr>, Vec<Vec<Expr>>) {
        let g = self.g;
        let has_pole = |value: Expr| {
            let parts = factored(g, value);
            parts.is_none_or(|parts| {
                let mut factors = parts.factors.iter();
                factors.any(|(f, n)| *n < 0 && poles.contains(f))
            })
        };
        let (with, without): (Vec<(Expr, Expr)>, Vec<_>) = leaf
            .solved
            .iter()
            .copied()
            .partition(|(_, value)| has_pole(*value));
        let count = with.len() + leaf.implicit.len();
        let regular = Case {
            solved: without,
            ..Case::default()
        };
        let mut forms = Vec::new();
        let cleared = with.iter().map(|&(symbol, value)| {
            let list = coefficients(g, g.sub(symbol, value), g.as_symbol(symbol)?)?;
            let &[c, b] = list.as_slice() else {
                return None;
            };
            Some(g.add(&[g.mul(&[b, symbol]), c]))
        });
        let cleared: Option<Vec<Expr>> = cleared.collect();
        if let Some(mut cleared) = cleared {
            cleared.extend(leaf.implicit.iter().map(|&(e, _)| e));
            forms.push(cleared);
        }
        let stated = case.stated.iter().map(|&e| self.on(&regular, e));
        let stated = stated.filter(|&e| !g.is_zero(e));
        let numerator = |e: Expr| Some(g.mul(&self.split_factors(e)?));
        let stated: Option<Vec<Expr>> = stated.map(numerator).collect();
        forms.extend(stated.filter(|stated| stated.len() == count));
        (regular, with.iter().map(|(s, _)| *s).collect(), forms)
    }

    /// Which states with D = 0 on which the equations of a form hold are limits of those with D ≠ 0.
    fn limit(&self, regular: &Case, form: &[Expr], pole: Expr) -> Limit {
        let at_pole = [&[pole], form].concat();
        if self.is_empty(regular, &at_pole) {
            return Limit::None;
        }
        let all_limits = match form {
            [equation] => {
                self.is_smooth(regular, *equation, pole) || self.is_regular(regular, &at_pole)
            }
            _ => self.is_regular(regular, &at_pole),
        };
        match all_limits {
            true => Limit::All,
            false => Limit::Open,
        }
    }

    /// Whether `D s + N = 0` is smooth, for almost every s, wherever D and N vanish: as they have no factor in common, that is of lower
    /// dimension than the set.
    fn is_smooth(&self, regular: &Case, equation: Expr, pole: Expr) -> bool {
        let g = self.g;
        let symbols = self.moving(&[equation]);
        symbols.iter().any(|&s| {
            let Some(list) = coefficients(g, equation, s) else {
                return false;
            };
            let &[c, b] = list.as_slice() else {
                return false;
            };
            if !self
                .split_factors(b)
                .is_some_and(|list| list.contains(&pole))
            {
                return false;
            }
            let slopes = [b, c].map(|e| g.gradient(e, &symbols)).concat();
            let slopes = slopes.into_iter().filter(|&e| !g.is_zero(e));
            let vanishing: Vec<Expr> = [pole, c].into_iter().chain(slopes).collect();
            self.is_empty(regular, &vanishing)
        })
    }

    /// Whether functions are independent wherever they vanish together.
    fn is_regular(&self, regular: &Case, functions: &[Expr]) -> bool {
        let g = self.g;
        let symbols = self.moving(functions);
        let size = functions.len();
        if symbols.len() < size || symbols.len() > usize::BITS as usize / 4 {
            return false;
        }
        let matrix = g.jacobian(functions, &symbols);
        let columns = (0..1_usize << symbols.len()).filter(|set| set.count_ones() as usize == size);
        let minors = columns.map(|set| {
            let entries = |row: &Vec<Expr>| {
                let chosen = row.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1);
                chosen.map(|(_, &e)| e).collect::<Vec<Expr>>()
            };
            let block: Vec<Vec<Expr>> = matrix.iter().map(entries).collect();
            self.on(regular, determinant(g, &block))
        });
        let minors: Vec<Expr> = minors.filter(|&e| !g.is_zero(e)).take(MINORS).collect();
        self.is_empty(regular, &[functions, &minors].concat())
    }

    /// The symbols of the state, and the time, that occur.
    fn moving(&self, es: &[Expr]) -> Vec<Symbol> {
        let time = self.g.intern_symbol("t", 0);
        let mut symbols = self.g.symbols_in(es);
        symbols.retain(|s| self.state.contains(s) || *s == time);
        symbols
    }

    /// Whether functions vanish together at no state.
    fn is_empty(&self, case: &Case, functions: &[Expr]) -> bool {
        let mut found = Found::default();
        let before = self.left.borrow().len();
        let cases = self.require_all(&mut found, case.clone(), functions);
        self.left.borrow_mut().truncate(before);
        cases.is_empty() && found.open.is_empty()
    }
}
