//! A curved piece of the boundary where it is plane.
//!
//! What is claimed of a functional is claimed of every domain, also of one that has a plane part of its boundary. There the normal is
//! constant and the curvature vanishes, so that all is short, and what is false there is false.

use super::comparison::{refuted, Comparison};
use crate::functional::{Functional, Piece, Side};
use crate::read::on_side;
use crate::variation::variation;
use chetaev_symbolic::{Expr, Verdict};

/// The functional of a domain whose boundary has only the one piece, which lies across the first independent variable; `None` where the
/// piece is a face already.
fn with_plane(functional: &Functional, piece: &Piece) -> Option<Functional> {
    let first = functional.space.coordinates.first()?;
    if piece.side != Side::Curved || first.is_time {
        return None;
    }
    let side = Side::Flat {
        axis: 0,
        is_upper: true,
        // Any place: the variable keeps its own name as its value.
        at: first.expr,
    };
    let scope = &functional.scope;
    let mut own = functional.clone();
    own.pieces.retain(|other| other.name == piece.name);
    for plane in &mut own.pieces {
        plane.density = on_side(scope, &side, plane.density);
        plane.side = side.clone();
    }
    let name = Some(piece.name.as_str());
    own.equations
        .retain(|e| e.on.is_none() || e.on.as_deref() == name);
    let here = own.equations.iter_mut().filter(|e| e.on.is_some());
    for equation in here {
        let of_multiplier = equation.multiplier.iter_mut().flat_map(|own| &mut own.1);
        for e in equation.residuals.iter_mut().chain(of_multiplier) {
            *e = on_side(scope, &side, *e);
        }
    }
    own.fields
        .retain(|field| field.on.is_none() || field.on.as_deref() == name);
    Some(own)
}

/// A refutation on a piece where it is plane: there no derivative of the curvature makes equations long.
pub(super) fn refuted_where_plane(
    functional: &Functional,
    piece: &Piece,
    nonnegative: &[Expr],
) -> Option<Verdict> {
    let plane = with_plane(functional, piece)?;
    let own = variation(&plane).ok()?;
    let comparison = Comparison::new(&plane, &own, nonnegative);
    let mut judged = Vec::new();
    comparison.piece(own.pieces.first()?, &mut judged);
    judged.into_iter().find_map(|own| match own.verdict {
        Verdict::Refuted(found) if own.open.is_empty() => {
            let first = &functional.space.coordinates.first()?.name;
            let what = format!(
                "where {} lies in a plane {first} = constant, {}",
                piece.name, own.what
            );
            Some(refuted(&what, found))
        }
        _ => None,
    })
}

/// Whether the Euler equations and natural conditions contradict each other on a piece where it is plane; true where that is not known.
pub(super) fn is_contradictory_where_plane(functional: &Functional, piece: &Piece) -> bool {
    let Some(plane) = with_plane(functional, piece) else {
        return true;
    };
    let Ok(own) = variation(&plane) else {
        return true;
    };
    let comparison = Comparison::new(&plane, &own, &[]);
    let mut pieces = own.pieces.iter();
    pieces.any(|on| comparison.is_contradictory_on(on))
}
