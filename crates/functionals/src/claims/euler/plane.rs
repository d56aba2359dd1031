//! A curved piece of the boundary where it is plane.
//!
//! What is claimed of a functional is claimed of every domain, also of one that has a plane part of its boundary. There the normal is
//! constant and the curvature vanishes, so that all is short, and what is false there is false.

use super::super::on_box::{equation_on, piece_on};
use super::comparison::{refuted, Comparison, Plane, System};
use crate::functional::{Functional, Piece, Side};
use crate::variation::{variation, OnPiece, Variation};
use chetaev_symbolic::Verdict;

/// The curved pieces with second derivatives, each where it is plane: on others nothing becomes long.
pub(super) fn planes(functional: &Functional, variation: &Variation) -> Vec<Plane> {
    let is_bent = |on: &&OnPiece| !on.slopes.is_empty();
    let bent = variation.pieces.iter().filter(is_bent);
    let found = bent.filter_map(|on| {
        let functional = with_plane(functional, functional.piece(&on.piece)?)?;
        let variation = self::variation(&functional).ok()?;
        Some(Plane {
            functional,
            variation,
        })
    });
    found.collect()
}

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
    let name = Some(piece.name.as_str());
    let mut own = functional.clone();
    let pieces = functional.pieces.iter().filter(|p| p.name == piece.name);
    own.pieces = pieces.map(|piece| piece_on(scope, piece, &side)).collect();
    let equations = functional.equations.iter();
    let here = equations.filter(|e| e.on.is_none() || e.on.as_deref() == name);
    let placed = here.map(|e| match &e.on {
        Some(_) => equation_on(scope, e, &side),
        None => e.clone(),
    });
    own.equations = placed.collect();
    own.fields
        .retain(|field| field.on.is_none() || field.on.as_deref() == name);
    Some(own)
}

impl<'f> Comparison<'f> {
    /// The comparison of a piece where it is plane; the interior is the same.
    pub(super) fn where_plane(&self, plane: &'f Plane) -> Comparison<'f> {
        self.of_another(&plane.functional, &plane.variation)
    }

    /// A refutation on a piece where it is plane: there no derivative of the curvature makes equations long.
    pub(super) fn refuted_where_plane(&self) -> Option<Verdict> {
        let first = &self.functional.space.coordinates.first()?.name;
        let all = [System::Derived, System::Stated];
        if self.planes.is_empty() || !all.iter().all(|own| self.extends(&[], *own, None)) {
            return None;
        }
        self.planes.iter().find_map(|plane| {
            let on = plane.variation.pieces.first()?;
            let mut judged = Vec::new();
            self.where_plane(plane).piece(on, &mut judged);
            judged.into_iter().find_map(|own| match own.verdict {
                Verdict::Refuted(found) if own.open.is_empty() => {
                    let place = format!("where {} lies in a plane {first} = constant", on.piece);
                    Some(refuted(&format!("{place}, {}", own.what), found))
                }
                _ => None,
            })
        })
    }

    /// Whether the Euler equations and natural conditions contradict each other on a piece where it is plane; `None` where that is not known.
    pub(super) fn is_contradictory_where_plane(&self, piece: &str) -> Option<bool> {
        let mut planes = self.planes.iter();
        planes.find_map(|plane| {
            let on = plane.variation.pieces.first()?;
            (on.piece == piece).then(|| self.where_plane(plane).is_contradictory_on(on))
        })
    }
}
