//! What products are made of: the real Darboux functions of a system's motion.
//!
//! A pair `A ± √Δ B` is real where Δ > 0. Where Δ < 0 it is complex, and real are its product `A² - Δ B²` and its argument,
//! `atan2(√-Δ B, A)`, whose rates are the real and the imaginary part of the cofactor.

use crate::darboux::{pairs, Darboux, Family, Pairs, Work};
use crate::flow::Flow;
use crate::motion::Motion;
use chetaev_mechanics::claims::formulation::basis;
use chetaev_mechanics::prover::assumptions;
use chetaev_mechanics::Context;
use chetaev_symbolic::simplify::{simplify, Options};
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Expr, Function, Graph};
use std::sync::Arc;

/// Functions of the state whose logarithms, or which themselves, have rates that are rational in what occurs.
#[derive(Clone, Debug, Default)]
pub struct Factors {
    /// Functions with cofactors that are not zero.
    pub bases: Vec<Expr>,
    /// Arguments of pairs of complex functions.
    pub arguments: Vec<Expr>,
    /// Functions with cofactor zero: first integrals.
    pub integrals: Vec<Expr>,
    /// The families that were searched.
    pub families: Vec<Family>,
    /// How many functions were seen whose coefficients were not found.
    pub open: usize,
}

/// The Darboux functions of the context's system as functions of (t, q, v), searched once for all claims; none where the motion is
/// not rational in the functions that occur.
pub fn factors(cx: &Context<'_>, motion: &Motion<'_>) -> Arc<Factors> {
    cx.shared(|cx| search(cx, motion).unwrap_or_default())
}

fn search(cx: &Context<'_>, motion: &Motion<'_>) -> Option<Factors> {
    let g = &cx.system.graph;
    let flow = Flow::of(cx, motion).ok()?;
    let work = Work {
        products: (Work::default().products as f64 * cx.work()) as u64,
        ..Work::default()
    };
    let found = pairs(&flow, work, cx.prover.points_seed());
    let chart = basis(cx).characteristics().ok()?;
    let speeds = chart.parameters.iter();
    let speeds: Vec<(Expr, Expr)> = speeds.map(|p| (p.value, p.definition)).collect();
    let mut factors = Factors {
        families: found.families.clone(),
        open: found.open,
        ..Factors::default()
    };
    factors.fill(cx, &found);
    for list in [
        &mut factors.bases,
        &mut factors.arguments,
        &mut factors.integrals,
    ] {
        *list = g.substitute_all(list, &speeds);
    }
    Some(factors)
}

impl Factors {
    /// Where Darboux polynomials were searched, in words, the largest degree of each set of letters; `None` where nowhere.
    #[must_use]
    pub fn exhausted(&self, g: &Graph) -> Option<String> {
        let mut sets: Vec<(&[Expr], u32, bool)> = Vec::new();
        // With one letter alone nothing is said.
        for family in self
            .families
            .iter()
            .filter(|family| family.letters.len() > 1)
        {
            match sets.last_mut() {
                Some((letters, degree, all)) if *letters == family.letters => {
                    *degree = family.degree;
                    *all &= family.exhausted;
                }
                _ => sets.push((&family.letters, family.degree, family.exhausted)),
            }
        }
        let each = sets.iter().map(|(letters, degree, all)| {
            let names: Vec<String> = letters.iter().map(|&e| g.text(e)).collect();
            let open = if *all {
                ""
            } else {
                " (zeros were left unexplained)"
            };
            format!("of degree up to {degree} in {}{open}", names.join(", "))
        });
        let each: Vec<String> = each.collect();
        (!each.is_empty()).then(|| {
            format!(
                "Darboux polynomials, for which X P = K P, by the zeros of the extactic polynomial at random constants of a prime field: {}",
                each.join(", ")
            )
        })
    }

    fn fill(&mut self, cx: &Context<'_>, found: &Pairs) {
        let g = &cx.system.graph;
        self.integrals.extend(&found.integrals);
        for own in &found.found {
            match own {
                Darboux::One(e) => self.bases.push(*e),
                Darboux::Conjugate {
                    first,
                    second,
                    square,
                } => self.conjugate(cx, [*first, *second, *square]),
            }
        }
        let mut seen: Vec<Expr> = Vec::new();
        self.bases.retain(|&e| {
            let is_new = !seen.contains(&e) && !seen.contains(&g.neg(e));
            seen.push(e);
            is_new
        });
    }

    fn conjugate(&mut self, cx: &Context<'_>, [first, second, square]: [Expr; 3]) {
        let g = &cx.system.graph;
        let squares = [g.powi(first, 2), g.neg(g.mul(&[square, g.powi(second, 2)]))];
        match is_negative(cx, square) {
            Some(true) => {
                self.bases.push(readable(g, g.add(&squares)));
                let height = g.mul(&[g.sqrt(readable(g, g.neg(square))), second]);
                self.arguments
                    .push(g.apply(Function::Atan2, &[height, first]));
            }
            Some(false) => {
                let root = g.mul(&[g.sqrt(readable(g, square)), second]);
                self.bases
                    .extend([g.add(&[first, root]), g.sub(first, root)]);
            }
            None => self.bases.push(readable(g, g.add(&squares))),
        }
    }
}

/// The sign of a constant under the assumptions, or else for the values that the model states.
fn is_negative(cx: &Context<'_>, e: Expr) -> Option<bool> {
    let g = &cx.system.graph;
    let sign = known_sign(g, e, &assumptions(cx.system));
    if sign.is_positive() {
        return Some(false);
    }
    if known_sign(g, g.neg(e), &assumptions(cx.system)).is_positive() {
        return Some(true);
    }
    let valued = g.substitute(e, &cx.system.parameter_values());
    let value = g.evaluate_f64(&[valued], &|_| None).ok()?;
    let value = value
        .first()
        .copied()
        .filter(|x| x.is_finite() && *x != 0.0);
    value.map(|x| x < 0.0)
}

fn readable(g: &Graph, e: Expr) -> Expr {
    simplify(g, e, &Options::default())
}
