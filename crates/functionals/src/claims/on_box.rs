//! A functional on a body of any shape, put on a box: each piece of its boundary is the faces that a solution says it is.
//!
//! The faces have edges and corners, with conditions of their own, which a piece without a shape has not.

use crate::functional::{names_in, place_of, Equation, Field, Functional, Piece, Side, Solution};
use crate::read::on_side;
use crate::space::Space;
use crate::tensors::Scope;

/// A face of the box, and the piece that it belongs to.
struct Face {
    piece: String,
    name: String,
    side: Side,
}

/// The functional with a piece for each face, and the solution on these; nothing where all pieces are faces already, or where some are none.
pub(super) fn on_box(
    functional: &Functional,
    solution: &Solution,
) -> Option<(Functional, Solution)> {
    let is_curved = |side: &Side| *side == Side::Curved;
    let has_faces = functional.pieces.iter().all(|own| !is_curved(&own.side));
    let is_placed = solution.has_pieces && solution.pieces.iter().all(|(_, own)| !is_curved(own));
    if has_faces || !is_placed {
        return None;
    }
    let space = &*functional.space;
    let face = |(piece, side): &(String, Side)| Face {
        piece: piece.clone(),
        name: format!("{piece} at {}", written(space, side)),
        side: side.clone(),
    };
    let faces: Vec<Face> = solution.pieces.iter().map(face).collect();
    let mut placed = functional.clone();
    let pieces = functional.pieces.iter();
    placed.pieces = pieces
        .flat_map(|own| pieces_of(functional, own, &faces))
        .collect();
    let equations = functional.equations.iter();
    placed.equations = equations
        .flat_map(|own| equations_of(functional, own, &faces))
        .collect();
    let fields = functional.fields.iter();
    placed.fields = fields.flat_map(|own| fields_of(own, &faces)).collect();
    let mut on_faces = solution.clone();
    on_faces.pieces = faces.into_iter().map(|own| (own.name, own.side)).collect();
    Some((placed, on_faces))
}

/// `x = 0`.
fn written(space: &Space, side: &Side) -> String {
    match side {
        Side::Flat { axis, at, .. } => {
            format!(
                "{} = {}",
                space.coordinates[*axis].name,
                space.graph.text(*at)
            )
        }
        Side::Curved => String::new(),
    }
}

fn of_piece<'f>(faces: &'f [Face], name: &'f str) -> impl Iterator<Item = &'f Face> {
    faces.iter().filter(move |own| own.piece == name)
}

/// A piece as a face of a box.
pub(super) fn piece_on(scope: &Scope, own: &Piece, side: &Side) -> Piece {
    Piece {
        side: side.clone(),
        density: on_side(scope, side, own.density),
        ..own.clone()
    }
}

/// An equation on a face of a box.
pub(super) fn equation_on(scope: &Scope, own: &Equation, side: &Side) -> Equation {
    let mut here = own.clone();
    let of_multiplier = here.multiplier.iter_mut().flat_map(|own| &mut own.1);
    for e in here.residuals.iter_mut().chain(of_multiplier) {
        *e = on_side(scope, side, *e);
    }
    here
}

fn pieces_of(functional: &Functional, own: &Piece, faces: &[Face]) -> Vec<Piece> {
    let on = |face: &Face| Piece {
        name: face.name.clone(),
        ..piece_on(&functional.scope, own, &face.side)
    };
    of_piece(faces, &own.name).map(on).collect()
}

/// An equation on a piece holds on all its faces, one on several pieces wherever faces of all of them meet.
fn equations_of(functional: &Functional, own: &Equation, faces: &[Face]) -> Vec<Equation> {
    let scope = &functional.scope;
    let Some(on) = &own.on else {
        return vec![own.clone()];
    };
    let mut places: Vec<Vec<&Face>> = vec![Vec::new()];
    for name in names_in(on) {
        let mut longer = Vec::new();
        for place in &places {
            let meets = |face: &&Face| place.iter().all(|own| own.side.meets(&face.side));
            let own = of_piece(faces, name).filter(meets);
            longer.extend(own.map(|face| [place.as_slice(), &[face]].concat()));
        }
        places = longer;
    }
    let at = |place: Vec<&Face>| {
        let names: Vec<&str> = place.iter().map(|face| face.name.as_str()).collect();
        let restricted =
            |equation: Equation, face: &&Face| equation_on(scope, &equation, &face.side);
        Equation {
            on: Some(place_of(&names)),
            ..place.iter().fold(own.clone(), restricted)
        }
    };
    places.into_iter().map(at).collect()
}

fn fields_of(own: &Field, faces: &[Face]) -> Vec<Field> {
    match &own.on {
        None => vec![own.clone()],
        Some(piece) => of_piece(faces, piece)
            .map(|face| Field {
                on: Some(face.name.clone()),
                ..own.clone()
            })
            .collect(),
    }
}
