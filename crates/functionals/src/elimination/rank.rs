//! Whether equations can be solved for tensors at every place: the rank of matrices in which fields, data or the normal stand.
//!
//! A determinant that is no number may vanish somewhere, and there the equations say less: of `v a + w b = 0`, `−w a + v b = 0` follows a = 0
//! only where v² + w² ≠ 0. Columns are independent at every place where the minors of their rows have no common zero, which is seen by their
//! factors: those that are known not to vanish are left out, and the components of the normal do not vanish all at once. Else each factor
//! of the determinant that vanishes is a case, in which the equations are solved anew ([`Solved::singular_cases`]): so systems of
//! differential equations are taken apart into simple ones (J. M. Thomas 1937; Bächler, Gerdt, Lange-Hegermann and Robertz 2012).

use super::{Entries, Open, Pivot, Solved, LONGEST_NAMED, MOST_SINGULAR};
use chetaev_symbolic::matrix::determinant;
use chetaev_symbolic::verdict::Counterexample;
use chetaev_symbolic::zero::assumptions::Relation;
use chetaev_symbolic::{Expr, Symbol, Verdict};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Minors of more rows are not written out.
const LARGEST: usize = 3;

/// Minors that are looked at.
const MOST_MINORS: usize = 100;

impl Solved<'_> {
    /// Whether the columns of a matrix of fields and data are proved to be independent wherever what is assumed holds. Where parameters alone, the
    /// normal or derivatives of functions without a formula decide, as the moduli of a material, they are taken in general position, and
    /// that is named elsewhere.
    pub(super) fn has_full_rank(&self, matrix: &[Vec<Expr>]) -> bool {
        if let Some(&known) = self.ranks.borrow().get(matrix) {
            return known;
        }
        let found = self.finds_full_rank(matrix);
        self.ranks.borrow_mut().insert(matrix.to_vec(), found);
        found
    }

    fn finds_full_rank(&self, matrix: &[Vec<Expr>]) -> bool {
        let entries = matrix.concat();
        let columns = matrix.first().map_or(0, Vec::len);
        if self.has_functions(&entries) || !self.has_fields(&entries) {
            return true;
        }
        if columns > LARGEST {
            return false;
        }
        let explicit = |row: &Vec<Expr>| -> Vec<Expr> {
            let of = |&e: &Expr| self.space.on_sphere(self.space.explicit(e));
            row.iter().map(of).collect()
        };
        let matrix: Vec<Vec<Expr>> = matrix.iter().map(explicit).collect();
        let normals: BTreeSet<Symbol> = self.space.normals().iter().copied().collect();
        // Components of the normal of which a power is a minor: they vanish where the columns depend on each other.
        let mut covered = BTreeSet::new();
        for rows in choices(matrix.len(), columns).into_iter().take(MOST_MINORS) {
            let minor: Vec<Vec<Expr>> = rows.iter().map(|&row| matrix[row].clone()).collect();
            match self.deciding(determinant(&self.space.graph, &minor), &normals) {
                Some(own) if own.is_empty() => return true,
                Some(own) if own.len() == 1 => covered.extend(own),
                _ => {}
            }
        }
        !normals.is_empty() && covered == normals
    }

    /// The factors of a determinant whose zeros are cases of their own: fields or data occur in them, and no functions without a formula.
    pub(super) fn singular_factors(&self, divisor: Expr) -> Vec<Expr> {
        let explicit = self.space.explicit(divisor);
        let mut found = self.factors(explicit);
        found.retain(|&factor| {
            self.has_fields(&[factor])
                && !self.has_functions(&[factor])
                && !self.space.sign(factor).is_nonzero()
                && !self.is_assumed(factor)
        });
        found
    }

    /// Whether expressions vanish where the equations hold: in each case where an equation that is left is a product, or something vanishes that
    /// was divided by.
    pub fn follows(&self, es: &[Expr]) -> bool {
        self.follows_in_cases(es, MOST_SINGULAR)
    }

    fn follows_in_cases(&self, es: &[Expr], depth: usize) -> bool {
        let is_so = |own: &Self| {
            let singular = || own.singular_cases().into_iter().map(|(_, case)| case);
            es.iter().all(|&e| own.space.vanishes(own.here(e)))
                && singular().all(|case| depth > 0 && case.follows_in_cases(es, depth - 1))
        };
        is_so(self) || self.cases().is_some_and(|all| all.iter().all(is_so))
    }

    /// Of expressions that vanish where nothing does that was divided by: what must not vanish, as far as it is not known that they vanish
    /// there too, or a counterexample.
    ///
    /// # Errors
    /// The counterexample.
    pub fn where_singular(&self, es: &[Expr]) -> Result<Vec<Pivot>, Box<Counterexample>> {
        let mut open: Vec<Pivot> = Vec::new();
        if !self.has_singular_cases() || self.follows(es) {
            return Ok(open);
        }
        let all = std::iter::once(self.clone()).chain(self.cases().into_iter().flatten());
        for (pivot, case) in all.flat_map(|own| own.singular_cases()) {
            if case.follows(es) {
                continue;
            }
            for &e in es {
                if let Verdict::Refuted(found) = case.verdict_in_general(e) {
                    return Err(Box::new(case.with_case(found)));
                }
            }
            if !open.contains(&pivot) {
                open.push(pivot);
            }
        }
        Ok(open)
    }

    /// The cases in which something vanishes that was divided by, without those in which nothing holds: with the equations that were solved
    /// before it.
    fn singular_cases(&self) -> Vec<(Pivot, Self)> {
        let mut found = Vec::new();
        for (at, own) in self.adopted.iter().enumerate() {
            for &factor in &own.singular {
                let text = self.space.graph.text(factor);
                let pivot = Pivot {
                    tensor: own.tensor.clone(),
                    entries: Entries::Fields,
                    divisor: (text.len() <= LONGEST_NAMED).then_some(text),
                };
                found.push((pivot, self.where_vanishing(at, factor)));
            }
        }
        found.retain(|(_, case)| !case.is_impossible());
        found
    }

    /// Whether there are such cases, in a case of a product that is left too.
    fn has_singular_cases(&self) -> bool {
        let has_own = |solved: &Self| solved.adopted.iter().any(|own| !own.singular.is_empty());
        has_own(self) || self.cases().is_some_and(|all| all.iter().any(has_own))
    }

    fn where_vanishing(&self, at: usize, factor: Expr) -> Self {
        let mut case = self.clone();
        let stratum = case.adopted[at].equations.stratum;
        case.take_back_from(at);
        case.left.push(Open {
            label: String::from("a coefficient that vanishes"),
            equations: vec![factor],
            stratum,
        });
        case.case.push(factor);
        case.prolonged = RefCell::default();
        case.solve();
        case.take_back();
        case
    }

    /// Whether something that is assumed not to vanish is, at the place that is looked at, a multiple of an expression.
    fn is_assumed(&self, e: Expr) -> bool {
        let g = &self.space.graph;
        let assumptions = self.space.assumptions();
        let mut strict = assumptions.list().iter().filter(|own| {
            !matches!(
                own.relation,
                Relation::LessOrEqual | Relation::GreaterOrEqual
            )
        });
        strict.any(|own| {
            let difference = self.normal(g.sub(own.left, own.right));
            let difference = self.space.on_sphere(self.space.explicit(difference));
            matches!(self.factors(difference)[..], [only] if only == e || only == g.neg(e))
        })
    }

    /// The factors of an expression that may vanish, as far as is known.
    pub(crate) fn open_factors(&self, e: Expr) -> Vec<Expr> {
        let g = &self.space.graph;
        let mut found = self.factors(e);
        found.retain(|&factor| {
            g.as_number(factor).is_none()
                && !self.space.sign(factor).is_nonzero()
                && !self.is_assumed(factor)
        });
        found
    }

    /// Whether functions of fields without a formula occur.
    pub(super) fn has_functions(&self, es: &[Expr]) -> bool {
        let explicit: Vec<Expr> = es.iter().map(|&e| self.space.explicit(e)).collect();
        let symbols = self.space.graph.symbols_in(&explicit);
        symbols.into_iter().any(|s| self.space.is_application(s))
    }

    /// The components of the normal that are factors of a minor whose other factors are known not to vanish, or contain parameters only; `None`
    /// where others are left.
    fn deciding(&self, minor: Expr, normals: &BTreeSet<Symbol>) -> Option<BTreeSet<Symbol>> {
        let (space, g) = (self.space, &self.space.graph);
        if space.vanishes(minor) {
            return None;
        }
        let mut found = BTreeSet::new();
        for factor in self.factors(minor) {
            let is_open = g.as_number(factor).is_none()
                && !space.sign(factor).is_nonzero()
                && !self.is_assumed(factor)
                && (self.has_fields(&[factor]) || !self.is_free(&[factor]));
            if is_open {
                found.insert(g.as_symbol(factor).filter(|s| normals.contains(s))?);
            }
        }
        Some(found)
    }
}

/// All ways to take so many of n rows, in order.
pub(crate) fn choices(n: usize, count: usize) -> Vec<Vec<usize>> {
    let mut found = vec![Vec::new()];
    for _ in 0..count {
        let longer = |own: &Vec<usize>| {
            let first = own.last().map_or(0, |&last| last + 1);
            let own = own.clone();
            (first..n).map(move |next| [own.clone(), vec![next]].concat())
        };
        found = found.iter().flat_map(longer).collect();
    }
    found
}
