//! One zero eigenvalue, all others left of the axis: Lyapunov's first critical case (Lyapunov 1892, §§ 28–32; Malkin 1952, ch. IV).
//!
//! All equations but the critical one are solved along a curve; on the centre manifold the motion is `x' = c xᵐ + …`, with the first term of what is
//! left. It is unstable where m is even or c positive, and asymptotically stable where m is odd and c negative. Integrals with independent gradients
//! take their zeros out of the question: the theorem speaks of their levels, and what is asymptotically stable on one level stays stable beside it
//! (Malkin 1952, § 70, on perturbations that act constantly).

use crate::branching::{Branching, Leading, HIGHEST};
use crate::decision::About;
use crate::levels::Levels;
use crate::question::Place;
use crate::real_roots::bounds_at;
use crate::steady::{closed, kernel};
use crate::theorem::{Answer, Instability, Method};
use chetaev_symbolic::Expr;
use dashu_ratio::RBig;
use std::cmp::Ordering;

/// One eigenvalue is zero, beside those of the levels of integrals.
pub(crate) struct ZeroEigenvalue;

/// `x' = c xᵐ + …`; no term where all that were looked at vanish.
struct Critical {
    levels: String,
    term: Option<Leading>,
    rate: Expr,
    nonzero: Vec<Expr>,
}

impl Method for ZeroEigenvalue {
    fn functions(&self, about: &About<'_>) -> Vec<Expr> {
        let critical = about.once(|| critical(about));
        let own = (*critical).as_ref();
        own.map_or_else(Vec::new, |own| {
            [own.nonzero.clone(), vec![own.rate]].concat()
        })
    }

    fn answer(&self, about: &About<'_>, place: Place, at: Option<&RBig>) -> Answer {
        if place != Place::OnAxis {
            return Answer::NotApplicable;
        }
        let critical = about.once(|| critical(about));
        let Some(own) = (*critical).as_ref() else {
            return Answer::NotApplicable;
        };
        let g = about.graph();
        let sign = |e: Expr| about.question.sign(g, e, at);
        let is_apart = |&e: &Expr| sign(e).is_some_and(|s| s != Ordering::Equal);
        let Some(term) = own
            .term
            .as_ref()
            .filter(|_| own.nonzero.iter().all(is_apart))
        else {
            return Answer::Open(format!(
                "one eigenvalue is zero{}, and on the centre manifold the motion has no term up to the order {HIGHEST}",
                own.levels
            ));
        };
        let m = term.order;
        let theorem = format!(
            "by Lyapunov's theorem on one zero eigenvalue: all others lie left of the axis{}, and on the centre manifold the motion is x' = c x^{m} + ...",
            own.levels
        );
        let unstable = |why: &str| {
            Answer::Unstable(Instability {
                quantity: format!("c in x' = c x^{m} + ... on the centre manifold"),
                bounds: bounds_at(g, own.rate, about.question.over.zip(at)).unwrap_or_default(),
                why: format!("{theorem} with {why}: the motion is unstable"),
            })
        };
        match sign(own.rate) {
            Some(Ordering::Equal) | None => {
                Answer::Open("the first term on the centre manifold has no sign".into())
            }
            Some(_) if m % 2 == 0 => unstable("an even power"),
            Some(Ordering::Greater) => unstable("a positive c"),
            Some(Ordering::Less) => Answer::Stable(format!(
                "{theorem} with a negative c and an odd power, so that the motion is asymptotically stable{}",
                if own.levels.is_empty() { "" } else { " there, and stable" }
            )),
        }
    }
}

fn critical(about: &About<'_>) -> Option<Critical> {
    let (g, own, question) = (about.graph(), &about.expansion, &about.question);
    let zeros = question.zeros();
    let is_alone = question.spectrum.paired.is_none() && zeros > 0;
    let is_explicit = own.own.characteristics.manifold.implicit.is_empty();
    if !is_alone || !is_explicit || !own.is_smooth() {
        return None;
    }
    let levels = Levels::of(own, about.integrals());
    if levels.jets.len() != zeros - 1 + own.reduction().dependent.len() {
        return None;
    }
    let slopes = own.slopes();
    let jacobian = [slopes.clone(), levels.gradients()].concat();
    let n = slopes.len();
    let (vectors, mut nonzero) = kernel(g, &jacobian, n);
    let [direction] = vectors.as_slice() else {
        return None;
    };
    let transposed: Vec<Vec<Expr>> = (0..n)
        .map(|c| slopes.iter().map(|row| row[c]).collect())
        .collect();
    let (left, further) = kernel(g, &transposed, n);
    nonzero.extend(further);
    let masses = own.masses();
    let inertia = |w: &Vec<Expr>| {
        let of_row = |(&w, row): (&Expr, &Vec<Expr>)| {
            let terms = row.iter().zip(direction).map(|(&m, &x)| g.mul(&[w, m, x]));
            g.add(&terms.collect::<Vec<_>>())
        };
        let rows: Vec<Expr> = w.iter().zip(&masses).map(of_row).collect();
        closed(g, g.add(&rows))
    };
    let (weights, inertia) = left
        .iter()
        .map(|w| (w, inertia(w)))
        .find(|(_, inertia)| !g.is_zero(*inertia))?;
    nonzero.push(inertia);
    let moving = own.moving();
    let of_levels: Option<Vec<Expr>> = levels.jets.iter().map(|jet| jet.value).collect();
    let of_levels = of_levels?;
    let start = own.at(&of_levels);
    let equations = |deviations: &[Expr]| {
        let found = own.beside(&[moving.clone(), of_levels.clone()].concat(), deviations);
        let constant = std::iter::repeat_n(g.zero(), n).chain(start.iter().copied());
        let pairs = found.into_iter().zip(constant);
        pairs.map(|(a, b)| g.sub(a, b)).collect()
    };
    let silent = std::iter::repeat_n(g.zero(), levels.jets.len());
    let weights: Vec<Expr> = weights.iter().copied().chain(silent).collect();
    let branching = Branching {
        graph: g,
        equations: &equations,
        jacobian: &jacobian,
        direction,
        weights: &weights,
    };
    let term = branching.leading();
    let rate = term
        .as_ref()
        .map_or(g.zero(), |term| closed(g, g.div(term.coefficient, inertia)));
    nonzero.extend(term.iter().flat_map(|term| term.nonzero.clone()));
    Some(Critical {
        levels: levels.text(),
        term,
        rate,
        nonzero,
    })
}
