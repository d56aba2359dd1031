//! What solved equations say besides: that nothing satisfies them, what they ask of data, which cases there are, and what they leave free.

use super::solver::base;
use super::strata::Stratum;
use super::Solved;
use crate::space::{Jet, Space};
use chetaev_symbolic::factors::factors_within;
use chetaev_symbolic::polynomial::Budget;
use chetaev_symbolic::zero::assumptions::{is_contradicted, Assumptions};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Node, Verdict};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// So many products one after the other are taken apart.
const MOST_PRODUCTS: usize = 4;

/// Room to see that an equation is a product: hundreds are asked, and those that are have some tens of terms.
const BUDGET: Budget = Budget {
    terms: 500,
    degree: 60,
    bits: 2_000,
    work: 100_000,
};

/// The factors of an expression, without numbers and powers: it vanishes where one of them does. As it is where they take too much work.
pub(crate) fn factors_of(space: &Space, e: Expr) -> Vec<Expr> {
    let g = &space.graph;
    match g.node(e) {
        Node::Product { factors, .. } => factors.iter().map(|&f| base(g, f)).collect(),
        _ => {
            let symbols = g.symbols_in(&[e]);
            let own = factors_within(g, e, &symbols, BUDGET);
            own.map_or(vec![e], |all| all.into_iter().map(|(f, _)| f).collect())
        }
    }
}

impl<'s> Solved<'s> {
    /// What cannot be where all equations hold: an equation that is left although it never holds, with its label.
    ///
    /// Where was divided by fields or data nothing is said: what contradicts itself where they do not vanish may hold where they do.
    pub fn contradiction(&self) -> Option<(String, Expr)> {
        if self.is_divided_by_jets() {
            return None;
        }
        self.contradiction_as_solved().or_else(|| {
            let (group, at, _) = self.product()?;
            let left = &self.left[group];
            let own = (left.label.clone(), left.equations[at]);
            self.cases()?.is_empty().then_some(own)
        })
    }

    fn contradiction_as_solved(&self) -> Option<(String, Expr)> {
        let own = self.impossible();
        if own.is_some() || !self.is_cut || self.is_circular() {
            return own;
        }
        self.prolonged()?.impossible()
    }

    fn impossible(&self) -> Option<(String, Expr)> {
        self.left.iter().find_map(|group| {
            let mut own = group.equations.iter().copied();
            let found = own.find(|&e| self.never_holds(e, group.stratum))?;
            Some((group.label.clone(), found))
        })
    }

    /// Whether an expression is known to vanish nowhere, or not to vanish identically although nothing but the place occurs in it.
    fn never_holds(&self, e: Expr, stratum: Stratum) -> bool {
        let space = self.space;
        let g = &space.graph;
        let e = self.placed(space.explicit(e), stratum);
        if space.sign(e).is_nonzero() || self.has_no_zero_factor(e) {
            return true;
        }
        let is_place = |symbol| {
            space
                .coordinates
                .iter()
                .any(|c| g.as_symbol(c.expr) == Some(symbol))
        };
        let is_curved = self.is_curved(stratum);
        let is_of_place = g.symbols_in(&[e]).into_iter().all(is_place);
        !is_curved && is_of_place && matches!(space.vanishing(&[e], true), Verdict::Refuted(_))
    }

    /// Whether no factor of an expression over its common denominator vanishes: √(1 + p²) − p²/√(1 + p²) has the sign of one.
    fn has_no_zero_factor(&self, e: Expr) -> bool {
        let g = &self.space.graph;
        let is_sum = matches!(g.node(e), Node::Sum { .. });
        let factored = is_sum.then(|| chetaev_symbolic::factors::factored(g, e));
        factored.flatten().is_some_and(|own| {
            let mut factors = own.factors.iter();
            let is_nonzero = |(factor, _): &(Expr, i64)| self.space.sign(*factor).is_nonzero();
            !own.coefficient.is_zero() && factors.all(is_nonzero)
        })
    }

    /// On a face the variable across it has its value.
    pub(super) fn placed(&self, e: Expr, stratum: Stratum) -> Expr {
        let g = &self.space.graph;
        self.space.replace(e, &|symbol| {
            let is_own = |(axis, _): &(usize, Expr)| {
                let own = self.space.coordinates.get(*axis);
                own.is_some_and(|c| g.as_symbol(c.expr) == Some(symbol))
            };
            self.constant_on(stratum).find(is_own).map(|(_, at)| at)
        })
    }

    /// What the equations ask of what is given, so that there are fields for some of it only: relations between data and parameters,
    /// which vanish.
    pub fn restrictions(&self) -> Vec<Expr> {
        let space = self.space;
        let is_given = |component: usize| {
            let own = space.component_at(component);
            !own.is_varied && !own.is_of_boundary
        };
        let of_rules = self
            .rules
            .iter()
            .filter(|rule| is_given(rule.jet.component));
        let of_rules = of_rules.map(|rule| {
            let own = space.jet(rule.jet.component, &rule.jet.by);
            space.graph.sub(own, self.normal(rule.value))
        });
        let left = self
            .left
            .iter()
            .flat_map(|group| group.equations.iter().copied());
        let is_of_given = |e: &Expr| {
            let jets = space.jets_in(&[*e]);
            jets.iter().all(|jet| is_given(jet.component)) && !space.symbols_in(&[*e]).is_empty()
        };
        of_rules.chain(left).filter(is_of_given).collect()
    }

    /// The cases of which one holds wherever the equations do: one for each factor of an equation that is left and is a product, without
    /// those in which nothing holds; `None` where no equation that is left is a product.
    pub fn cases(&self) -> Option<Vec<Solved<'s>>> {
        self.product()?;
        let mut found = Vec::new();
        let mut open = vec![(self.clone(), 0)];
        while let Some((own, depth)) = open.pop() {
            let product = (depth < MOST_PRODUCTS).then(|| own.product()).flatten();
            let Some((group, at, factors)) = product else {
                found.push(own);
                continue;
            };
            for factor in factors {
                let mut case = own.clone();
                case.left[group].equations[at] = factor;
                case.case.push(factor);
                case.prolonged = RefCell::default();
                case.known.borrow_mut().clear();
                case.solve();
                case.take_back();
                open.push((case, depth + 1));
            }
        }
        found.retain(|case| !case.is_impossible());
        Some(found)
    }

    /// Whether nothing is seen to satisfy the equations and what is assumed.
    pub(super) fn is_impossible(&self) -> bool {
        self.contradiction_as_solved().is_some() || self.is_excluded()
    }

    /// Whether something that is assumed is false wherever the equations hold.
    fn is_excluded(&self) -> bool {
        let g = &self.space.graph;
        let here = self.assumed_here();
        let mut all = here.list().iter();
        all.any(|own| {
            let difference = g.sub(own.left, own.right);
            is_contradicted(own.relation, known_sign(g, difference, &Assumptions::new()))
        })
    }

    /// The first equation that is left and is a product of several factors with jets.
    fn product(&self) -> Option<(usize, usize, Vec<Expr>)> {
        let groups = self.left.iter().enumerate();
        let mut all = groups.flat_map(|(k, group)| {
            let own = group.equations.iter().enumerate();
            own.map(move |(at, &e)| (k, at, e))
        });
        all.find_map(|(group, at, e)| {
            let found = self.factors_with_jets(e);
            (found.len() > 1).then_some((group, at, found))
        })
    }

    /// The factors of an expression in which jets occur, without those that are known to vanish nowhere.
    fn factors_with_jets(&self, e: Expr) -> Vec<Expr> {
        let space = self.space;
        let has_jets = |&factor: &Expr| {
            let mut jets = space.jets_in(&[factor]).into_iter();
            jets.any(|jet| !space.is_curvature(jet.component)) && !space.sign(factor).is_nonzero()
        };
        let mut own = self.factors(e);
        own.retain(has_jets);
        own
    }

    /// The same of all, kept.
    pub(super) fn factors(&self, e: Expr) -> Vec<Expr> {
        if let Some(known) = self.factors.borrow().get(&e) {
            return known.clone();
        }
        let found = factors_of(self.space, e);
        self.factors.borrow_mut().insert(e, found.clone());
        found
    }

    /// Whether an equation is a product, so that it is no equation for what stands in one of the factors.
    pub(super) fn is_product(&self, e: Expr) -> bool {
        // A jet with a coefficient without jets stands in no product with another.
        !self.space.is_linear_in_a_jet(e) && self.factors_with_jets(e).len() > 1
    }

    /// How many components of a tensor may be changed by any functions, all else being kept, so that expressions keep their values
    /// where the equations hold: the components less the rank of the slopes by all their jets. `None` where the rank is not known.
    pub fn free_components(&self, components: &[usize], es: &[Expr]) -> Option<usize> {
        let space = self.space;
        // What the others determine is not free, though slopes vanish where an equation has a multiple zero.
        let is_determined = |&component: &usize| {
            let by = Vec::new();
            let own = Jet { component, by };
            let value = self.normal(space.jet(component, &[]));
            let mut others = space.jets_in(&[value]).into_iter();
            self.rule(&own, self.everywhere()).is_some()
                && others.all(|jet| !components.contains(&jet.component))
        };
        let components: Vec<usize> = components
            .iter()
            .copied()
            .filter(|c| !is_determined(c))
            .collect();
        let components = &components[..];
        // Of a power what it is of: its slopes vanish where it does.
        let es: Vec<Expr> = es.iter().map(|&e| self.stripped(e)).collect();
        let jets = space.jets_in(&es);
        let own: BTreeSet<Vec<usize>> = jets
            .into_iter()
            .filter(|jet| components.contains(&jet.component))
            .map(|jet| jet.by)
            .collect();
        let mut matrix = Vec::new();
        for &e in &es {
            for by in &own {
                let slope = |&component: &usize| {
                    let by = by.clone();
                    self.normal(space.partial(e, &Jet { component, by }))
                };
                matrix.push(components.iter().map(slope).collect::<Vec<Expr>>());
            }
        }
        if matrix.is_empty() {
            return Some(components.len());
        }
        Some(components.len() - self.pivots_of(&matrix)?.columns.len())
    }
}
