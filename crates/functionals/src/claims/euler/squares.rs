//! Functionals that are sums of squares: stationary fields make each of them vanish.
//!
//! Of a functional Π that is homogeneous of the second degree `δΠ(u; u) = 2 Π(u)` (Euler), so that a stationary u that is a variation itself has
//! Π(u) = 0; where no density is negative, each vanishes wherever it is integrated. So −u'' + u = 0 with free ends has the solution 0 alone.

use crate::elimination::Group;
use crate::functional::{Functional, Piece, Role};
use chetaev_symbolic::Expr;

/// The density of the interior as an equation, where it vanishes for stationary fields.
pub(super) fn inside(functional: &Functional) -> Vec<Group> {
    if is_sum_of_squares(functional) {
        vec![vanishing(functional.density)]
    } else {
        Vec::new()
    }
}

/// The same on a piece of the boundary.
pub(super) fn on_piece(functional: &Functional, piece: &Piece) -> Vec<Group> {
    if is_sum_of_squares(functional) {
        vec![vanishing(piece.density)]
    } else {
        Vec::new()
    }
}

fn vanishing(density: Expr) -> Group {
    Group {
        label: "the density, a sum of squares".into(),
        equations: vec![density],
    }
}

/// Whether the functional is a homogeneous one of the second degree without negative densities, of fields that are free: what is given on the boundary or
/// imposed may be no variation, nor is what is there at the ends of the time.
fn is_sum_of_squares(functional: &Functional) -> bool {
    let space = &*functional.space;
    let pieces = functional.pieces.iter();
    let densities = pieces.clone().map(|piece| piece.density);
    let mut densities = densities.chain([functional.density]);
    let is_free = functional.with_role(Role::Imposed).next().is_none()
        && pieces.clone().all(|piece| piece.fixed.is_empty())
        && !space.coordinates.iter().any(|own| own.is_time);
    is_free
        && densities.all(|e| space.sign(e).is_nonnegative() && is_of_second_degree(functional, e))
}

/// Whether an expression of varied fields becomes four times itself where all of them are doubled.
fn is_of_second_degree(functional: &Functional, e: Expr) -> bool {
    let space = &*functional.space;
    let g = &space.graph;
    let e = space.explicit(e);
    let doubled = space.replace(e, &|symbol| {
        space.as_jet(symbol)?;
        Some(g.mul(&[g.integer(2), g.symbol_expr(symbol)]))
    });
    let difference = g.sub(doubled, g.mul(&[g.integer(4), e]));
    space
        .jets_in(&[e])
        .iter()
        .all(|jet| functional.varies(jet.component))
        && space.vanish(&[difference])
}
