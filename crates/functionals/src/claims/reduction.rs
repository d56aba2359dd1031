//! What is imposed without a multiplier restricts the variations: fields that it gives are put in, and what it holds on a piece is given.
//!
//! Where an equation that is imposed cannot be solved for a field, its multiplier has to be stated; it may be left out where all Euler
//! equations and natural conditions of the fields in it hold because of what is imposed, since then it is zero.

use crate::elimination::{Group, Solved};
use crate::functional::{Equation, Functional, Role, Side};
use crate::space::Jet;
use crate::variation::Variation;
use chetaev_symbolic::Expr;

/// The functional in which fields that are imposed to be something are that.
pub(super) fn reduced(functional: &Functional) -> Functional {
    let mut own = functional.clone();
    while let Some((component, value)) = solved(&own) {
        put_in(&mut own, component, value);
    }
    given(&mut own);
    own
}

/// The components that are varied in the interior.
fn varied(functional: &Functional) -> Vec<usize> {
    let fields = functional.interior();
    fields.flat_map(|field| field.components.clone()).collect()
}

/// A component with the value that an imposed equation gives it, where it occurs in it once, without derivatives and with a number before it.
fn solved(functional: &Functional) -> Option<(usize, Expr)> {
    let space = &*functional.space;
    let g = &space.graph;
    let varied = varied(functional);
    let inside = functional.restricting().filter(|e| e.on.is_none());
    let mut residuals = inside.flat_map(|e| e.residuals.iter().copied());
    residuals.find_map(|e| {
        let jets = space.jets_in(&[e]);
        // The last field first: definitions name what is defined behind what defines it as often as not, and any will do.
        varied.iter().rev().find_map(|&component| {
            let own: Vec<&Jet> = jets
                .iter()
                .filter(|jet| jet.component == component)
                .collect();
            let [jet] = own[..] else { return None };
            let slope = space.partial(e, jet);
            let is_number = g.as_number(slope).is_some_and(|n| !n.is_zero());
            if !jet.by.is_empty() || !is_number || !can_leave(functional, component, e) {
                return None;
            }
            let symbol = g.as_symbol(space.jet(component, &[]));
            let rest = space.replace(e, &|s| (Some(s) == symbol).then(|| g.zero()));
            Some((component, g.neg(g.div(rest, slope))))
        })
    })
}

/// Whether a component may be put in: where it is given, what gives it must be given too.
fn can_leave(functional: &Functional, component: usize, e: Expr) -> bool {
    let varied = varied(functional);
    let jets = functional.space.jets_in(&[e]);
    let others = || {
        jets.iter()
            .filter(|jet| jet.component != component && varied.contains(&jet.component))
    };
    functional.pieces.iter().all(|piece| {
        let is_given = piece.fixed.iter().any(|(own, _)| *own == component);
        !is_given
            || others()
                .all(|jet| jet.by.is_empty() && piece.fixed.contains(&(jet.component, false)))
    })
}

fn put_in(functional: &mut Functional, component: usize, value: Expr) {
    let space = functional.space.clone();
    functional.put(&|symbol| {
        let jet = space.as_jet(symbol)?;
        (jet.component == component).then(|| space.totals(value, &jet.by))
    });
    for piece in &mut functional.pieces {
        piece.fixed.retain(|(own, _)| *own != component);
    }
    for field in &mut functional.fields {
        field.components.retain(|own| *own != component);
    }
    functional
        .fields
        .retain(|field| !field.components.is_empty());
}

/// A component that an imposed equation gives on a piece is not varied there.
fn given(functional: &mut Functional) {
    let space = functional.space.clone();
    let varied = varied(functional);
    let mut found: Vec<(String, usize)> = Vec::new();
    for equation in functional.restricting() {
        let Some(on) = &equation.on else { continue };
        for &e in &equation.residuals {
            let jets = space.jets_in(&[e]);
            let own: Vec<&Jet> = jets
                .iter()
                .filter(|jet| varied.contains(&jet.component))
                .collect();
            if let [jet] = own[..] {
                let slope = space.partial(e, jet);
                let is_number = space.graph.as_number(slope).is_some_and(|n| !n.is_zero());
                if jet.by.is_empty() && is_number {
                    found.push((on.clone(), jet.component));
                }
            }
        }
    }
    for piece in &mut functional.pieces {
        let here = found.iter().filter(|(on, _)| *on == piece.name);
        for (_, component) in here {
            if !piece.fixed.contains(&(*component, false)) {
                piece.fixed.push((*component, false));
            }
        }
    }
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
        .filter(|equation| !is_of_given(functional, equation));
    open.find_map(|equation| {
        let own = components(equation);
        let values: Vec<Expr> = match &equation.on {
            None => {
                let euler = variation.euler.iter();
                euler.filter(|(c, _)| own.contains(c)).map(|(_, e)| *e).collect()
            }
            Some(on) => {
                let here = variation.pieces.iter().filter(|piece| piece.piece == *on);
                let all = here.flat_map(|piece| &piece.conditions);
                all.filter(|c| own.contains(&c.component)).map(|c| c.value).collect()
            }
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

/// Whether an equation on a piece speaks only of components that are given there, and of their derivatives along it.
fn is_of_given(functional: &Functional, equation: &Equation) -> bool {
    let Some(piece) = equation.on.as_deref().and_then(|on| functional.piece(on)) else {
        return false;
    };
    let varied = varied(functional);
    let jets = functional.space.jets_in(&equation.residuals);
    let mut own = jets.iter().filter(|jet| varied.contains(&jet.component));
    own.all(|jet| {
        let is_along = match &piece.side {
            Side::Flat { axis, .. } => !jet.by.contains(axis),
            Side::Curved => jet.by.is_empty(),
        };
        is_along && piece.fixed.contains(&(jet.component, false))
    })
}
