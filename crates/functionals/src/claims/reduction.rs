//! What is imposed without a multiplier restricts the variations: fields that it gives are put in, those of the boundary too, and what it holds
//! on a piece is given.
//!
//! Where an equation that is imposed cannot be solved for a field, its multiplier has to be stated; it may be left out where all Euler
//! equations and natural conditions of the fields in it hold because of what is imposed, since then it is zero.

use super::given::{given_by, is_given, is_regular, Given};
use crate::elimination::{Group, Solved};
use crate::functional::{names_in, Equation, Functional, Piece, Role};
use crate::space::Jet;
use crate::variation::{variation, Corner, Variation, VariationError};
use chetaev_symbolic::Expr;

/// A functional in which what is imposed is put in.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The functional of the fields that are left.
    pub functional: Functional,
    /// The components that were put in, and what stands for them.
    pub put_in: Vec<(usize, Expr)>,
}

/// The functional in which fields that are imposed to be something are that, in the interior and on the pieces on which they live.
pub fn reduced(functional: &Functional) -> Reduced {
    let mut own = Reduced {
        functional: functional.clone(),
        put_in: Vec::new(),
    };
    let places = functional
        .pieces
        .iter()
        .map(|piece| Some(piece.name.as_str()));
    for place in std::iter::once(None).chain(places) {
        while let Some(found) = solved(&own.functional, place) {
            own.put_in(found);
        }
    }
    while given(&mut own.functional) {}
    own
}

/// A component that is put in.
struct Found {
    component: usize,
    value: Expr,
    /// What is given on each piece instead of it.
    given: Vec<Given>,
}

/// The components that are varied in the interior, or on a piece alone.
fn varied(functional: &Functional, on: Option<&str>) -> Vec<usize> {
    let fields = functional
        .fields
        .iter()
        .filter(|field| field.on.as_deref() == on);
    fields.flat_map(|field| field.components.clone()).collect()
}

/// A component with the value that an equation imposed at its place gives it, where it occurs in it once, without derivatives and with a
/// coefficient that does not vanish.
fn solved(functional: &Functional, on: Option<&str>) -> Option<Found> {
    let space = &*functional.space;
    let g = &space.graph;
    let varied = varied(functional, on);
    let here = functional.restricting().filter(|e| e.on.as_deref() == on);
    let mut residuals = here.flat_map(|e| e.residuals.iter().copied());
    residuals.find_map(|e| {
        let jets = space.jets_in(&[e]);
        // The last field first: definitions name what is defined behind what defines it as often as not, and any will do.
        varied.iter().rev().find_map(|&component| {
            let own: Vec<&Jet> = jets
                .iter()
                .filter(|jet| jet.component == component)
                .collect();
            let [jet] = own[..] else { return None };
            if !jet.by.is_empty() || !is_regular(space, e, jet) {
                return None;
            }
            let symbol = g.as_symbol(space.jet(component, &[]));
            let rest = space.replace(e, &|s| (Some(s) == symbol).then(|| g.zero()));
            let value = g.neg(g.div(rest, space.partial(e, jet)));
            let pieces = functional.pieces.iter();
            let given = pieces.map(|piece| given_instead(functional, piece, component, value));
            let given = given.collect::<Option<Vec<Given>>>()?;
            Some(Found {
                component,
                value,
                given,
            })
        })
    })
}

/// What is given on a piece where a component, or its slope, is given there and a value stands for it; `None` where that is another condition.
fn given_instead(
    functional: &Functional,
    piece: &Piece,
    component: usize,
    value: Expr,
) -> Option<Given> {
    let space = &*functional.space;
    let mut found: Given = piece
        .fixed
        .iter()
        .copied()
        .filter(|own| own.0 != component)
        .collect();
    let is_varied = |component: usize| functional.varies(component);
    for is_slope in [false, true] {
        if !piece.fixed.contains(&(component, is_slope)) {
            continue;
        }
        let value = (value, is_slope);
        found.extend(given_by(space, piece, value, &found, &is_varied)?);
    }
    Some(found)
}

impl Reduced {
    fn put_in(&mut self, found: Found) {
        let functional = &mut self.functional;
        let space = functional.space.clone();
        let stands = |symbol| {
            let jet = space.as_jet(symbol)?;
            (jet.component == found.component).then(|| space.totals(found.value, &jet.by))
        };
        functional.put(&stands);
        for (_, value) in &mut self.put_in {
            *value = space.replace(*value, &stands);
        }
        for (piece, given) in functional.pieces.iter_mut().zip(&found.given) {
            piece.fixed = given.iter().copied().collect();
        }
        for field in &mut functional.fields {
            field.components.retain(|own| *own != found.component);
        }
        functional
            .fields
            .retain(|field| !field.components.is_empty());
        self.put_in.push((found.component, found.value));
    }
}

/// What imposed equations give on a piece, or where pieces meet, is not varied there; whether anything new is given.
fn given(functional: &mut Functional) -> bool {
    let space = functional.space.clone();
    let is_varied = |component: usize| functional.varies(component);
    let mut found: Vec<(String, Given)> = Vec::new();
    for equation in functional.restricting() {
        let Some(piece) = equation.on.as_deref().and_then(|on| functional.piece(on)) else {
            continue;
        };
        let known: Given = piece.fixed.iter().copied().collect();
        for &e in &equation.residuals {
            let new = given_by(&space, piece, (e, false), &known, &is_varied);
            found.extend(
                new.filter(|new| !new.is_empty())
                    .map(|new| (piece.name.clone(), new)),
            );
        }
    }
    for (on, new) in &found {
        let piece = functional.pieces.iter_mut().find(|piece| piece.name == *on);
        let fixed = piece.map(|piece| &mut piece.fixed);
        for own in fixed.into_iter() {
            own.extend(
                new.iter()
                    .filter(|new| !own.contains(new))
                    .copied()
                    .collect::<Vec<_>>(),
            );
        }
    }
    !found.is_empty()
}

/// The first variation without the conditions of what is imposed where pieces meet, as it is not varied there.
///
/// # Errors
/// Orders that are not treated.
pub(super) fn admitted(functional: &Functional) -> Result<Variation, VariationError> {
    let mut own = variation(functional)?;
    let given: Vec<(&Equation, Vec<usize>)> = functional
        .restricting()
        .filter_map(|equation| Some((equation, given_where_meeting(functional, equation)?)))
        .collect();
    let is_given = |corner: &Corner| {
        let pieces = [corner.pieces.0.as_str(), corner.pieces.1.as_str()];
        given.iter().any(|(equation, components)| {
            let names = names_in(equation.on.as_deref().unwrap_or_default());
            let is_here = names.len() == 2 && pieces.iter().all(|piece| names.contains(piece));
            is_here && components.contains(&corner.component)
        })
    };
    own.corners.retain(|corner| !is_given(corner));
    Ok(own)
}

/// The components that an equation imposed where pieces meet gives there, each in an equation of its own; `None` where it is imposed elsewhere
/// or is another condition.
fn given_where_meeting(functional: &Functional, equation: &Equation) -> Option<Vec<usize>> {
    let space = &*functional.space;
    functional.meeting(equation.on.as_deref()?)?;
    let given = |&e: &Expr| {
        let jets = space.jets_in(&[e]).into_iter();
        let open: Vec<Jet> = jets
            .filter(|jet| functional.varies(jet.component))
            .collect();
        match &open[..] {
            [jet] if jet.by.is_empty() && is_regular(space, e, jet) => Some(jet.component),
            _ => None,
        }
    };
    equation.residuals.iter().map(given).collect()
}

/// Why the variations are restricted in a way that the Euler equations do not know.
pub(super) fn restricted(functional: &Functional, variation: &Variation) -> Option<String> {
    let space = &*functional.space;
    let group = |e: &Equation| Group {
        label: format!("({})", e.label),
        equations: e.residuals.clone(),
    };
    let inside: Vec<Group> = functional
        .with_role(Role::Imposed)
        .filter(|e| e.on.is_none())
        .map(group)
        .collect();
    let imposed = Solved::new(space).with(&inside);
    let components = |e: &Equation| -> Vec<usize> {
        let jets = space.jets_in(&e.residuals);
        jets.into_iter().map(|jet| jet.component).collect()
    };
    let mut open = functional
        .restricting()
        .filter(|equation| !is_of_given(functional, equation))
        .filter(|equation| given_where_meeting(functional, equation).is_none());
    open.find_map(|equation| {
        let own = components(equation);
        let values: Vec<Expr> = match &equation.on {
            None => {
                let euler = variation.euler.iter();
                euler.filter(|(c, _)| own.contains(c)).map(|(_, e)| *e).collect()
            }
            Some(on) => acting(variation, on, &own),
        };
        let holds = match equation.on.as_deref().and_then(|on| functional.piece(on)) {
            Some(piece) => {
                let here = functional.with_role(Role::Imposed);
                let here: Vec<Group> = here
                    .filter(|e| e.on.as_deref() == Some(piece.name.as_str()))
                    .map(group)
                    .collect();
                imposed.with_on(&piece.side, &here).follows(&values)
            }
            None => imposed.follows(&values),
        };
        (!holds).then(|| {
            format!(
                "({}) restricts the variations, and has no multiplier: state it under [multipliers], or solve the equation for a field",
                equation.label
            )
        })
    })
}

/// The conditions on variations of components at a place, a piece or where pieces meet, with those where its pieces meet others.
fn acting(variation: &Variation, on: &str, components: &[usize]) -> Vec<Expr> {
    let names = names_in(on);
    let here = variation.pieces.iter().filter(|piece| piece.piece == on);
    let conditions = here.flat_map(|piece| &piece.conditions);
    let of_pieces = conditions.map(|own| (own.component, own.value));
    let is_here = |name: &String| names.contains(&name.as_str());
    let meeting = variation.corners.iter().filter(|own| {
        let (one, other) = &own.pieces;
        if names.len() == 1 {
            is_here(one) || is_here(other)
        } else {
            is_here(one) && is_here(other)
        }
    });
    let all = of_pieces.chain(meeting.map(|own| (own.component, own.value)));
    let own = all.filter(|(component, _)| components.contains(component));
    own.map(|(_, value)| value).collect()
}

/// Whether an equation on a piece speaks only of what is given there.
fn is_of_given(functional: &Functional, equation: &Equation) -> bool {
    let Some(piece) = equation.on.as_deref().and_then(|on| functional.piece(on)) else {
        return false;
    };
    let given: Given = piece.fixed.iter().copied().collect();
    let jets = functional.space.jets_in(&equation.residuals);
    let mut own = jets.iter().filter(|jet| functional.varies(jet.component));
    own.all(|jet| is_given(&functional.space, piece, &given, jet))
}
