//! What is given on a piece of the boundary, and so not varied there: components, their slopes across it, and what follows from these.

use crate::functional::{Piece, Side};
use crate::space::{Coordinate, Jet, Space};
use chetaev_symbolic::Expr;
use std::collections::BTreeSet;

/// Components, and whether their slopes across the piece.
pub(super) type Given = BTreeSet<(usize, bool)>;

/// Whether a jet is known on a piece where something is given there: values with their derivatives along the piece, slopes likewise. The
/// time runs along every piece.
pub(super) fn is_given(space: &Space, piece: &Piece, given: &Given, jet: &Jet) -> bool {
    let has = |is_slope: bool| given.contains(&(jet.component, is_slope));
    let is_place = |by: &&usize| !space.coordinates[**by].is_time;
    match &piece.side {
        Side::Flat { axis, .. } => match jet.by.iter().filter(|by| *by == axis).count() {
            0 => has(false),
            1 => has(true),
            _ => false,
        },
        Side::Curved => match jet.by.iter().filter(is_place).count() {
            0 => has(false),
            1 => has(false) && has(true),
            _ => false,
        },
    }
}

/// What is given where a function of fields is, or its slope across the piece: nothing new where all its jets are known, else what its only other
/// jet is. `None` where that is another condition.
pub(super) fn given_by(
    space: &Space,
    piece: &Piece,
    (value, is_slope): (Expr, bool),
    given: &Given,
    is_varied: &dyn Fn(usize) -> bool,
) -> Option<Given> {
    let is_line = space.dimensions() == 1;
    let value = match (is_slope, &piece.side) {
        (false, _) => value,
        (true, Side::Flat { axis, .. }) => space.totals(value, &[*axis]),
        (true, Side::Curved) if is_line => space.totals(value, &[0]),
        (true, Side::Curved) => value,
    };
    // The slope along the normal is that of one field whose multiple the value is, and what is known of values is of no help.
    let is_across = is_slope && piece.side == Side::Curved && !is_line;
    let none = Given::new();
    let known = if is_across { &none } else { given };
    let jets = space.jets_in(&[value]).into_iter();
    let open = jets.filter(|jet| is_varied(jet.component) && !is_given(space, piece, known, jet));
    let open: Vec<Jet> = open.collect();
    let jet = match &open[..] {
        [] => return Some(none),
        [jet] => jet,
        _ => return None,
    };
    if !is_regular(space, value, jet) {
        return None;
    }
    let is_slope = match (&jet.by[..], &piece.side) {
        ([], _) => is_across,
        ([by], Side::Flat { axis, .. }) if by == axis => true,
        // On a line every derivative by the place is one across.
        ([0], Side::Curved) if is_line => true,
        _ => return None,
    };
    Some(Given::from([(jet.component, is_slope)]))
}

/// Whether an expression is linear in a jet, with a coefficient that is known to vanish nowhere on the body and its boundary.
pub(super) fn is_regular(space: &Space, e: Expr, jet: &Jet) -> bool {
    let slope = space.partial(e, jet);
    let symbols = space.symbols_in(&[slope]);
    // What is known of the place holds inside only.
    let of_place = |own: &Coordinate| space.graph.as_symbol(own.expr);
    let mut places = space.coordinates.iter().filter_map(of_place);
    space.jets_in(&[slope]).is_empty()
        && !places.any(|place| symbols.contains(&place))
        && space.sign(slope).is_nonzero()
}
