//! Functionals that are sums of squares, or of other things that are not negative: stationary fields make each of them vanish.
//!
//! Of a functional Π = Σ Π_k whose terms are homogeneous of the degrees k in some of its fields `δΠ(u; u) = Σ k Π_k(u)` (Euler), for these fields u as
//! the variation, so that where u is stationary and a variation itself this is zero; where each density is not negative and each k is positive, each
//! vanishes wherever it is integrated. So −u'' + u³ = 0 with free ends has the solution 0 alone.

use crate::elimination::Group;
use crate::functional::{Functional, Piece, Role};
use chetaev_symbolic::{Expr, Node};
use std::collections::{BTreeMap, BTreeSet};

/// Higher degrees are not looked for.
const HIGHEST: u32 = 8;

/// Components of fields that are varied together.
type Moved = BTreeSet<usize>;

/// The terms of the density of the interior as equations, where they vanish for stationary fields.
pub(super) fn inside(functional: &Functional) -> Vec<Group> {
    vanishing(functional, functional.density)
}

/// The same on a piece of the boundary.
pub(super) fn on_piece(functional: &Functional, piece: &Piece) -> Vec<Group> {
    vanishing(functional, piece.density)
}

fn vanishing(functional: &Functional, density: Expr) -> Vec<Group> {
    let all = choices(functional).into_iter();
    let all = all.filter_map(|moved| {
        let equations = terms(functional, &moved, density)?;
        (!equations.is_empty()).then(|| Group {
            label: "the density, a sum of squares".into(),
            equations,
        })
    });
    all.collect()
}

/// Fields in which all densities are sums of what is not negative, all of them or one alone. They have to be free: what is given on the boundary or
/// imposed may be no variation, nor is what is there at the ends of the time.
fn choices(functional: &Functional) -> Vec<Moved> {
    let is_timed = functional.space.coordinates.iter().any(|own| own.is_time);
    if is_timed || functional.with_role(Role::Imposed).next().is_some() {
        return Vec::new();
    }
    let densities = functional.pieces.iter().map(|piece| piece.density);
    let densities: Vec<Expr> = densities.chain([functional.density]).collect();
    let is_free = |moved: &Moved| {
        let mut pieces = functional.pieces.iter();
        pieces.all(|piece| !piece.fixed.iter().any(|(own, _)| moved.contains(own)))
    };
    let is_sum = |moved: &Moved| {
        let mut all = densities.iter();
        is_free(moved) && all.all(|&e| terms(functional, moved, e).is_some())
    };
    let fields = functional.fields.iter().map(|own| own.components.clone());
    let fields: Vec<Vec<usize>> = fields.collect();
    let together: Moved = fields.iter().flatten().copied().collect();
    if is_sum(&together) {
        return vec![together];
    }
    let alone = fields.into_iter().map(|own| own.into_iter().collect());
    alone.filter(is_sum).collect()
}

/// The terms of a density in which some fields occur, those of one degree together; `None` where one is not homogeneous of a positive degree, or may be
/// negative.
fn terms(functional: &Functional, moved: &Moved, density: Expr) -> Option<Vec<Expr>> {
    let space = &*functional.space;
    let g = &space.graph;
    let density = space.explicit(density);
    let occur = |e: Expr| {
        let jets = space.jets_in(&[e]);
        jets.iter().any(|jet| moved.contains(&jet.component))
    };
    let mut by_degree: BTreeMap<u32, Vec<Expr>> = BTreeMap::new();
    for e in summands(functional, moved, density) {
        if occur(e) {
            let degree = degree(functional, moved, e)?;
            by_degree.entry(degree).or_default().push(e);
        }
    }
    let sums = by_degree.into_values().map(|own| g.add(&own));
    let found: Vec<Expr> = sums.collect();
    let mut all = found.iter();
    all.all(|&e| space.sign(e).is_nonnegative())
        .then_some(found)
}

/// What is homogeneous in one piece, or its terms.
fn summands(functional: &Functional, moved: &Moved, e: Expr) -> Vec<Expr> {
    let g = &functional.space.graph;
    match g.node(e) {
        Node::Sum { terms, .. } if degree(functional, moved, e).is_none() => {
            let own = terms.iter();
            own.map(|(term, factor)| g.mul(&[g.number(factor.clone()), *term]))
                .collect()
        }
        _ => vec![e],
    }
}

/// The positive degree k in which an expression is homogeneous in some fields: with these for their own variation it changes by k times itself.
fn degree(functional: &Functional, moved: &Moved, e: Expr) -> Option<u32> {
    let space = &*functional.space;
    let g = &space.graph;
    let change = space.derive(e, &|symbol| {
        let jet = space.as_jet(symbol)?;
        let is_moved = moved.contains(&jet.component);
        is_moved.then(|| g.symbol_expr(symbol))
    });
    (1..=HIGHEST).find(|&degree| {
        let times = g.integer(i64::from(degree));
        let difference = g.sub(change, g.mul(&[times, e]));
        space.seems_to_vanish(difference) && space.vanish(&[difference])
    })
}
