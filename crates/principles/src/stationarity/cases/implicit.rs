//! Equations of a case that are not solved: polynomials in a symbol of the state.
//!
//! Others are reduced modulo these by pseudo-division (Ritt; W.-T. Wu, Basic principles of mechanical theorem proving in elementary
//! geometries, 1984): the remainder vanishes where both do, as long as the leading coefficient does not, which is a case of its own.

use super::constants::Root;
use super::{Case, Found, Search};
use chetaev_mechanics::prover::assumptions;
use chetaev_symbolic::factors::{coefficients, factored, remainder};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Symbol};

/// Equations of higher degree are not followed.
const DEGREE: usize = 6;

impl Search<'_, '_> {
    /// What an expression leaves modulo the equations that are not solved, up to factors that do not vanish.
    pub(super) fn remainder(&self, case: &Case, e: Expr) -> Expr {
        let g = self.g;
        let mut rest = e;
        for &(polynomial, symbol) in &case.implicit {
            if !g.is_zero(rest) && g.contains_any(rest, &[symbol]) {
                rest = remainder(g, rest, polynomial, symbol).unwrap_or(rest);
            }
        }
        rest
    }

    /// What vanishes where an equation that is not solved loses its degree. What was found by division by it holds elsewhere, and where
    /// this is zero in the limit only.
    pub(super) fn leading(&self, case: &Case) -> Vec<Expr> {
        let nowhere = Case::default();
        let of = |&(polynomial, symbol): &(Expr, Symbol)| {
            let list = coefficients(self.g, polynomial, symbol)?;
            self.vanishing_factors(&nowhere, self.on(case, *list.last()?))
        };
        let mut all: Vec<Expr> = case.implicit.iter().filter_map(of).flatten().collect();
        all.sort();
        all.dedup();
        all
    }

    /// The cases that an equation gives which is not solved, where one of its symbols has got a value since; `None` where none has.
    pub(super) fn made_explicit(&self, found: &mut Found, case: &Case) -> Option<Vec<Case>> {
        let symbols: Vec<Symbol> = case
            .solved
            .iter()
            .filter_map(|(symbol, _)| self.g.as_symbol(*symbol))
            .collect();
        let is_old = |(e, _): &(Expr, Symbol)| self.g.contains_any(*e, &symbols);
        let place = case.implicit.iter().position(is_old)?;
        let mut case = case.clone();
        let (polynomial, _) = case.implicit.remove(place);
        let rest = self.on(&case, polynomial);
        if self.g.is_zero(rest) {
            return Some(vec![case]);
        }
        let mut cases = self.require(found, &case, rest);
        // It has been stated already, if it is one factor.
        let known = case.stated.len() + 1;
        let is_one = self.vanishing_factors(&case, self.remainder(&case, rest));
        if is_one.is_some_and(|list| list.len() == 1) {
            for case in cases.iter_mut().filter(|c| c.stated.len() == known) {
                case.stated.pop();
            }
        }
        Some(cases)
    }

    /// The cases in which a polynomial of degree two and more vanishes.
    pub(super) fn where_implicit(
        &self,
        found: &mut Found,
        case: &Case,
        factor: Expr,
    ) -> Option<Vec<Case>> {
        let (symbol, list) = self.main_symbol(case, factor)?;
        let lead = *list.last()?;
        self.take_as_regular(lead);
        let mut cases = Vec::new();
        let vanishing = self.vanishing_factors(case, lead)?;
        if !vanishing.is_empty() {
            cases.extend(self.require_all(found, case.clone(), &[lead, factor]));
        }
        let mut off = case.clone();
        off.nonzero.extend(vanishing);
        if let &[c, b, a] = list.as_slice() {
            match self.root_of_discriminant(a, b, c) {
                Root::Imaginary(real) if self.g.contains_any(real, &self.state) => {
                    cases.extend(self.require_all(found, off, &[real, factor]));
                    return Some(cases);
                }
                Root::Imaginary(_) => return Some(cases),
                Root::Both(root) => {
                    let values = self.both(a, b, root).into_iter();
                    let at = self.g.symbol_expr(symbol);
                    cases.extend(values.filter_map(|value| self.with(&off, at, value)));
                    return Some(cases);
                }
                Root::Unknown if self.is_never_real(a, b, c) => return Some(cases),
                Root::Unknown => {}
            }
        }
        // The former equation for the same symbol has the higher degree: it is divided by the new one.
        let former = off.implicit.iter().position(|(_, s)| *s == symbol);
        let former = former.map(|place| off.implicit.remove(place).0);
        off.implicit.push((factor, symbol));
        off.stated.push(factor);
        if off
            .nonzero
            .iter()
            .any(|&e| self.g.is_zero(self.on(&off, e)))
        {
            return Some(cases);
        }
        match former.map(|e| self.remainder(&off, e)) {
            Some(rest) if !self.g.is_zero(rest) => cases.extend(self.require(found, &off, rest)),
            _ => cases.push(off),
        }
        Some(cases)
    }

    /// The symbol in which a polynomial is divided, with its coefficients: one that has an equation already, else a speed, else
    /// that of the least degree.
    fn main_symbol(&self, case: &Case, factor: Expr) -> Option<(Symbol, Vec<Expr>)> {
        let g = self.g;
        let occurring = g.symbols_in(&[factor]);
        let state = self.state.iter().filter(|s| occurring.contains(s));
        let polynomials = state.filter_map(|&s| Some((s, coefficients(g, factor, s)?)));
        let fit = polynomials.filter(|(_, list)| (3..=DEGREE + 1).contains(&list.len()));
        fit.min_by_key(|(s, list)| {
            let has_equation = case.implicit.iter().any(|(_, known)| known == s);
            let is_speed = self.motion.speeds.contains(s);
            (!has_equation, list.len(), !is_speed)
        })
    }

    /// Whether the discriminant of `a s² + b s + c` is negative wherever it has a sign that is known.
    fn is_never_real(&self, a: Expr, b: Expr, c: Expr) -> bool {
        let g = self.g;
        let known = assumptions(self.cx.system);
        let four = g.mul(&[g.integer(4), a, c]);
        let discriminant = g.sub(g.powi(b, 2), four);
        let negative = |e: Expr| {
            let sign = known_sign(g, e, &known);
            sign.is_nonpositive() && sign.is_nonzero()
        };
        let product = factored(g, discriminant).map(|parts| {
            let factors = parts.factors.iter().map(|&(f, n)| g.powi(f, n));
            let factors: Vec<Expr> = factors.collect();
            g.scale(&parts.coefficient, g.mul(&factors))
        });
        negative(discriminant) || product.is_some_and(negative)
    }
}
