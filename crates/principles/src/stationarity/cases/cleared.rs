//! Sets whose solved equations have poles, `x = −y sin φ/cos φ`, written with the pole cleared, `x cos φ + y sin φ = 0`.
//!
//! A motion of such a set may pass through the pole. By continuity it stays stationary there, as long as κ has no pole itself. What
//! has to be shown is that the cleared equations hold nowhere but on the set and its limits: that they describe, where the
//! denominator D vanishes, a smooth set in which D = 0 is of lower dimension. The same is shown of polynomials that are not solved, `a s² + b s + c = 0`,
//! where a vanishes, since others are reduced modulo them where it does not.

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
    /// Clears the poles of a set that are none of κ, where nothing is added by that; what stays open where it is not known. `leading` are those
    /// of them that are no poles, but leading coefficients of equations that are not solved.
    pub(super) fn clear(&self, leaf: &mut Leaf, case: &Case, leading: &[Expr]) -> Vec<String> {
        // The equations themselves say that a leading coefficient does not vanish, where that is so.
        let implicit: Vec<Expr> = leaf.implicit.iter().map(|&(e, _)| e).collect();
        let is_stated = |pole: &Expr| {
            leading.contains(pole)
                && self.is_empty(&Case::default(), &[&[*pole], &implicit[..]].concat())
        };
        leaf.nonzero.retain(|pole| !is_stated(pole));
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
        let is_smooth = match form {
            [equation] => self.is_smooth(regular, *equation, pole),
            _ => false,
        };
        let all_limits = is_smooth
            || self.is_regular(regular, &at_pole, &[])
            || (self.is_regular(regular, form, &[pole]) && self.is_thin(regular, form, pole));
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

    /// Whether the equations of a form and D = 0 hold on a set of lower dimension than that of a smooth set given by the form: every case has
    /// an equation more, each for a symbol of its own.
    fn is_thin(&self, regular: &Case, form: &[Expr], pole: Expr) -> bool {
        let at_pole = [form, &[pole]].concat();
        let Some(cases) = self.all_cases(regular, &at_pole) else {
            return false;
        };
        let count = |case: &Case| case.solved.len() + case.implicit.len();
        let least = count(regular) + form.len() + 1;
        cases.iter().all(|case| count(case) >= least)
    }

    /// Whether functions are independent wherever they vanish together with others.
    fn is_regular(&self, regular: &Case, functions: &[Expr], others: &[Expr]) -> bool {
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
        self.is_empty(regular, &[others, functions, &minors].concat())
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
        let cases = self.all_cases(case, functions);
        cases.is_some_and(|cases| cases.is_empty())
    }

    /// The cases in which functions vanish together, where all of them are followed.
    fn all_cases(&self, case: &Case, functions: &[Expr]) -> Option<Vec<Case>> {
        let mut found = Found::default();
        let before = self.left.borrow().len();
        let cases = self.require_all(&mut found, case.clone(), functions);
        self.left.borrow_mut().truncate(before);
        let waits = |case: &Case| !case.pending.is_empty();
        (found.open.is_empty() && !cases.iter().any(waits)).then_some(cases)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // a panic is how a test fails

    use super::super::{Case, Found, Search};
    use super::Limit;
    use crate::stationarity::motion::Motion;
    use chetaev_mechanics::claims::Context;
    use chetaev_mechanics::{Prepared, Prover, Registry, System, SystemParts};
    use chetaev_symbolic::{Expr, Graph};
    use std::sync::Arc;

    /// The coordinates x, y, z, w with w' = y x', so that x' = s is free.
    fn with_search(look: impl FnOnce(&Search<'_, '_>, [Expr; 4])) {
        let g = Arc::new(Graph::new());
        let v = |name: &str| g.symbol(name, 1);
        let names = ["x", "y", "z", "w"];
        let squares = names.map(|name| g.powi(v(name), 2));
        let product = g.mul(&[g.symbol("y", 0), v("x")]);
        let parts = SystemParts {
            coordinates: names.map(String::from).to_vec(),
            lagrangian: Some(g.add(&squares)),
            constraints: vec![("c".into(), g.sub(v("w"), product))],
            ..SystemParts::default()
        };
        let system = System::new(Arc::clone(&g), parts).unwrap();
        let prepared = Prepared::new(&system).unwrap();
        let registry = Registry::new(&[chetaev_mechanics::claims::CLAIMS, crate::CLAIMS]);
        let (terms, selection) = (&prepared.terms, &prepared.selection);
        let cx = Context::new(&system, terms, selection, &registry, Prover::default());
        let motion = Motion::of(&cx);
        let motion = motion.as_ref().as_ref().unwrap();
        let symbols = [v("x"), g.symbol("x", 0), g.symbol("y", 0), g.symbol("z", 0)];
        look(&Search::new(&cx, motion, false), symbols);
    }

    /// y s² + x = 0 is smooth where y = 0, its states are limits of those with y ≠ 0, and y s² + 1 = 0 has none there. x s² + y² = 0 holds for every s where
    /// x = y = 0, and the same of x³ s² + y² is not known to be a limit.
    #[test]
    fn limits_where_an_equation_loses_its_degree() {
        with_search(|search, [s, x, y, _]| {
            let g = search.g;
            let symbol = g.as_symbol(s).unwrap();
            let square = |a: Expr, c: Expr| g.add(&[g.mul(&[a, g.powi(s, 2)]), c]);
            for (equation, stays) in [
                (square(y, x), None),
                (square(y, g.one()), None),
                (square(x, g.powi(y, 2)), Some(x)),
            ] {
                let case = Case {
                    implicit: vec![(equation, symbol)],
                    stated: vec![equation],
                    ..Case::default()
                };
                let mut found = Found::default();
                let leaf = search.leaf(&mut found, case, &[]);
                assert_eq!(leaf.nonzero, Vec::from_iter(stays), "{}", g.text(equation));
                assert_eq!(found.open.len(), usize::from(stays.is_some()));
            }
        });
    }

    /// s = −x/y and p = −w/z have poles of their own, which may vanish together. s y + x = 0 and p z + y = 0 touch y = 0 where x = z = p = 0: the set is
    /// smooth there too. With p y + x = 0 beside s y + x = 0 every s and p is left where x = y = 0, and s = p elsewhere.
    #[test]
    fn two_poles_at_once() {
        with_search(|search, [s, x, y, z]| {
            let g = search.g;
            let (p, w) = (g.symbol("y", 1), g.symbol("w", 0));
            let line = |s: Expr, y: Expr, x: Expr| g.add(&[g.mul(&[s, y]), x]);
            let nowhere = Case::default();
            let first = line(s, y, x);
            let apart = [first, line(p, z, w)];
            let touching = [first, line(p, z, y)];
            for pole in [y, z] {
                for form in [&apart, &touching] {
                    assert!(matches!(search.limit(&nowhere, form, pole), Limit::All));
                }
            }
            let tied = [first, line(p, y, x)];
            assert!(matches!(search.limit(&nowhere, &tied, y), Limit::Open));
        });
    }

    /// s = −N/y at y = 0. With N = x it is s y + x = 0, smooth with x = 0 there. With N = 1 there is no such state. With N = x³ and y² for y
    /// the surface is singular where x = y = 0. On the cone y² = x z, s y + x = 0 is s = −y/z, which is zero where x = y = 0 and z is not: the
    /// equations hold there for every s, which is no limit.
    #[test]
    fn limits_of_a_set_at_its_poles() {
        with_search(|search, [s, x, y, z]| {
            let g = search.g;
            let nowhere = Case::default();
            let limit = |form: &[Expr]| search.limit(&nowhere, form, y);
            let line = g.add(&[g.mul(&[s, y]), x]);
            assert!(matches!(limit(&[line]), Limit::All));
            let hyperbola = g.add(&[g.mul(&[s, y]), g.one()]);
            assert!(matches!(limit(&[hyperbola]), Limit::None));
            let cusp = g.add(&[g.mul(&[s, g.powi(y, 2)]), g.powi(x, 3)]);
            assert!(matches!(limit(&[cusp]), Limit::Open));
            let cone = g.sub(g.powi(y, 2), g.mul(&[x, z]));
            assert!(matches!(limit(&[cone, line]), Limit::Open));
            // The plane z = x meets the line in a smooth set.
            let plane = g.sub(z, x);
            assert!(matches!(limit(&[plane, line]), Limit::All));
        });
    }
}
