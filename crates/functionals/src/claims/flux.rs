//! A vector whose divergence a density is that has no Euler expressions.
//!
//! On the way `λ u` from zero to the fields such a density changes by `∂L/∂λ = D_i w_i`, where w comes by parts from the slopes of L by all jets, so
//! that `L[u] − L[0] = D_i ∫₀¹ w_i dλ` (the lemma of Poincaré; P. J. Olver, Applications of Lie Groups to Differential Equations, 1986, ch. 5).
//! The integral is a sum over five places, exact for polynomials up to the fifth degree (G. Boole 1860); whether it is right is
//! decided by the divergence itself.

use crate::functional::Side;
use crate::polynomial::Polynomial;
use crate::space::{Jet, Space};
use chetaev_symbolic::{rational, Expr, Node};
use std::collections::BTreeSet;

/// Boole's rule: places and weights, in quarters and in ninetieths.
const BOOLE: [(i64, i64); 5] = [(0, 7), (1, 32), (2, 12), (3, 32), (4, 7)];

/// A flux of a density; `None` where none was found.
pub(super) fn of(space: &Space, density: Expr) -> Option<Vec<Expr>> {
    let g = &space.graph;
    let mut flux = vec![Vec::new(); space.coordinates.len()];
    for (place, weight) in BOOLE {
        let factor = g.number(rational::ratio(place, 4)?);
        let weight = g.number(rational::ratio(weight, 90)?);
        for jet in space.jets_in(&[density]) {
            let slope = g.mul(&[weight, scaled(space, space.partial(density, &jet), factor)]);
            by_parts(space, (jet.component, &jet.by), slope, &mut flux);
        }
    }
    let rest = scaled(space, density, g.zero());
    if let Some(first) = flux.first_mut().filter(|_| !g.is_zero(rest)) {
        first.push(Polynomial::of(space, rest)?.primitive(0).expr(space));
    }
    let found: Vec<Expr> = flux.iter().map(|terms| g.add(terms)).collect();
    let slopes = found.iter().enumerate();
    let divergence: Vec<Expr> = slopes.map(|(axis, &w)| space.total(w, axis)).collect();
    let difference = g.sub(density, g.add(&divergence));
    space.vanish(&[difference]).then_some(found)
}

/// A flux without its terms in which no fields or data occur, where these have no divergence: through the whole boundary they add up to nothing.
pub(super) fn without_constants(space: &Space, flux: &[Expr]) -> Vec<Expr> {
    let g = &space.graph;
    let constant = |&w: &Expr| match g.node(w) {
        Node::Sum { constant, terms } => {
            let own = terms
                .iter()
                .filter(|(e, _)| space.jets_in(&[*e]).is_empty());
            let own = own.map(|(e, factor)| g.mul(&[g.number(factor.clone()), *e]));
            g.add(&own.chain([g.number(constant.clone())]).collect::<Vec<_>>())
        }
        _ if space.jets_in(&[w]).is_empty() => w,
        _ => g.zero(),
    };
    let constants: Vec<Expr> = flux.iter().map(constant).collect();
    let slopes = constants.iter().enumerate();
    let divergence: Vec<Expr> = slopes.map(|(axis, &w)| space.total(w, axis)).collect();
    if !space.vanish(&[g.add(&divergence)]) {
        return flux.to_vec();
    }
    let both = flux.iter().zip(constants);
    both.map(|(&w, constant)| g.sub(w, constant)).collect()
}

/// Whether a density on a face is a divergence along it, so that its integral is one over the edges: what it says of every field and of each
/// derivative of one across the face has no Euler expression. On a curved piece that is so wherever derivatives occur, as far as is known here.
pub(super) fn leaves_edges_only(space: &Space, side: &Side, density: Expr) -> bool {
    let jets = space.jets_in(&[density]);
    let Side::Flat { axis, .. } = side else {
        return jets.iter().any(|jet| !jet.by.is_empty());
    };
    let (is_across, g) = (|by: &&usize| *by == axis, &space.graph);
    let across = |jet: &Jet| (jet.component, jet.by.iter().filter(is_across).count());
    let fields: BTreeSet<(usize, usize)> = jets.iter().map(across).collect();
    let has_derivatives = |jet: &Jet| jet.by.iter().any(|by| by != axis);
    let euler = fields.iter().map(|&field| {
        let own = jets.iter().filter(|jet| across(jet) == field);
        let terms = own.map(|jet| {
            let along: Vec<usize> = jet.by.iter().copied().filter(|by| by != axis).collect();
            let term = space.totals(space.partial(density, jet), &along);
            if along.len().is_multiple_of(2) {
                term
            } else {
                g.neg(term)
            }
        });
        g.add(&terms.collect::<Vec<_>>())
    });
    jets.iter().any(has_derivatives) && space.vanish(&euler.collect::<Vec<_>>())
}

/// All jets times a factor.
fn scaled(space: &Space, e: Expr, factor: Expr) -> Expr {
    let g = &space.graph;
    space.replace(space.explicit(e), &|symbol| {
        let own = space.as_jet(symbol)?;
        Some(g.mul(&[factor, space.jet(own.component, &own.by)]))
    })
}

/// What goes to the boundary where a jet times a coefficient is integrated by parts.
fn by_parts(
    space: &Space,
    (component, by): (usize, &[usize]),
    coefficient: Expr,
    flux: &mut [Vec<Expr>],
) {
    let Some((&axis, rest)) = by.split_first() else {
        return;
    };
    let g = &space.graph;
    if let Some(terms) = flux.get_mut(axis) {
        terms.push(g.mul(&[space.jet(component, rest), coefficient]));
    }
    let next = g.neg(space.total(coefficient, axis));
    by_parts(space, (component, rest), next, flux);
}
