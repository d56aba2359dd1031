//! Euler equations and natural conditions in index notation.
//!
//! They are derived from the densities as they are written, by the rules of index notation alone, and shown only where their components are
//! proved to be those of the first variation. A definition on the boundary that contains the normal, such as the traction, is varied as
//! a whole: the conditions then are the coefficients of δP_k and δu_k (T4 §4). The gradient of an energy, `s_ij = A'_ij(D)`, is varied as a
//! whole where its coefficient vanishes identically. Multipliers of imposed equations are varied by nothing, and put in at the end.

use super::by_parts::{coefficient, components, free_of};
use super::densities::Densities;
use super::freedom::{Freedom, Varied};
use super::terms::{names, times, Calculus, Linear};
use super::traction::{normal, through, Through};
use super::{Index, Node};
use crate::functional::{Field, Functional, Piece};
use crate::read::on_side;
use crate::space::Jet;
use crate::tensors::{Scope, Shape};
use crate::variation::{piece_form, vanishes_on, Form, Variation};
use chetaev_symbolic::Expr;
use std::collections::{BTreeMap, BTreeSet};

/// A coefficient in index notation; it vanishes.
#[derive(Clone, Debug)]
pub struct Indexed {
    /// What it is the coefficient of: `u_k`.
    pub of: String,
    /// The coefficient.
    pub value: Node,
    /// Whether it is known to vanish only where its variation takes all values, as that of a traction of which a matrix of moduli decides.
    pub is_in_general: bool,
}

/// The Euler equations of all fields, `None` in the place of one that index notation has no short form for.
pub fn euler(functional: &Functional, variation: &Variation) -> Vec<Option<Indexed>> {
    let fields = functional.interior();
    let Some(densities) = Densities::of(functional) else {
        return fields.map(|_| None).collect();
    };
    let mut kept = densities.settled();
    kept.extend(densities.multipliers.iter().cloned());
    fields
        .map(|field| equation(functional, variation, field, (&densities, &kept)))
        .collect()
}

fn equation(
    functional: &Functional,
    variation: &Variation,
    field: &Field,
    (densities, kept): (&Densities, &BTreeSet<String>),
) -> Option<Indexed> {
    let scope = &densities.scope;
    let calculus = Calculus::new(scope, kept);
    let terms = calculus.terms(&densities.about(&[&field.name]))?;
    let linear = calculus.linear(&terms, &field.name)?;
    let linear = densities.put_in(&calculus, linear)?;
    let free = free_of(field.shape, scope)?;
    let value = coefficient(&calculus, linear, field.shape, (&free, scope))?;
    let own = components(scope, &value, field.shape, &free);
    let all = field.components.iter().zip(own).all(|(component, value)| {
        let known = variation.euler.iter().find(|(c, _)| c == component);
        known.is_some_and(|(_, known)| agree(functional, value, *known))
    });
    all.then(|| Indexed {
        of: name_of(&field.name, &free),
        value,
        is_in_general: false,
    })
}

fn agree(functional: &Functional, a: Expr, b: Expr) -> bool {
    let space = &*functional.space;
    let difference = space.graph.sub(a, b);
    space.graph.is_zero(difference) || space.vanish(&[difference])
}

fn name_of(name: &str, free: &[char]) -> String {
    match free {
        [] => name.to_owned(),
        _ => format!("{name}_{}", free.iter().collect::<String>()),
    }
}

/// The natural conditions on a piece; `None` where the densities have no short form there.
pub fn natural(functional: &Functional, piece: &Piece) -> Option<Vec<Indexed>> {
    let densities = Densities::of(functional)?;
    let settled = densities.settled();
    conditions_on(functional, piece, &densities, settled)
        .or_else(|| conditions_on(functional, piece, &densities, BTreeSet::new()))
}

fn conditions_on(
    functional: &Functional,
    piece: &Piece,
    densities: &Densities,
    mut whole: BTreeSet<String>,
) -> Option<Vec<Indexed>> {
    let scope = &densities.scope;
    whole.extend(densities.multipliers.iter().cloned());
    let mut kept = varied_as_a_whole(functional, densities.pieces.get(&piece.name), scope);
    let through: Vec<Through> = kept
        .iter()
        .filter_map(|name| through(scope, name))
        .collect();
    let tractions = kept.clone();
    kept.extend(through.iter().map(|own| own.stress.clone()));
    kept.extend(whole.iter().cloned());
    let calculus = Calculus::new(scope, &kept);
    let inside_about = |name: &str| {
        let stresses = through.iter().map(|own| own.stress.as_str());
        let names: Vec<&str> = stresses.chain([name]).collect();
        calculus.terms(&densities.about(&names))
    };
    let outside = match densities.pieces.get(&piece.name) {
        Some(tree) => calculus.terms(tree)?,
        None => Vec::new(),
    };
    let mut found = Vec::new();
    // What is shown, and has to be varied independently.
    let (mut wholes, mut shown) = (Vec::new(), Vec::new());
    let mut coefficients: Vec<(String, Shape, Vec<Expr>)> = Vec::new();
    for name in &tractions {
        let (letters, _) = scope.definitions.get(name)?;
        let shape = match letters.len() {
            0 => Shape::Scalar,
            1 => Shape::Vector,
            _ => Shape::Matrix,
        };
        let mut linear = calculus.linear(&outside, name)?;
        let inside = inside_about(name)?;
        for own in through.iter().filter(|own| own.traction == *name) {
            linear.extend(own.flux(&calculus, &inside)?);
        }
        let linear = densities.put_in(&calculus, linear)?;
        let (indexed, own) = condition(&calculus, linear, name, shape, scope)?;
        let vanishes = own.iter().all(|&e| {
            let e = on_side(scope, &piece.side, e);
            scope.space.graph.is_zero(e) || scope.space.vanish(&[e])
        });
        if !vanishes {
            wholes.extend(&scope.tensors.get(name)?.components);
            found.extend(indexed);
        }
        coefficients.push((name.clone(), shape, own));
    }
    let tractions = found.len();
    let here = functional
        .fields
        .iter()
        .filter(|f| f.on.as_ref().is_none_or(|on| *on == piece.name));
    for field in here {
        let mut linear = Linear::new();
        if field.on.is_none() {
            let inside = inside_about(&field.name)?;
            let mut all = calculus.linear(&inside, &field.name)?;
            for own in &through {
                all.extend(own.rest(&calculus, &inside, (scope, &whole), &field.name)?);
            }
            for (term, mut occurrence) in all {
                match occurrence.derivatives[..] {
                    [] => continue,
                    [Index::Place(at)] if at >= scope.space.dimensions() => continue,
                    [by] => {
                        occurrence.derivatives.clear();
                        linear.push((times(&normal(by), &term), occurrence));
                    }
                    _ => return None,
                }
            }
        }
        linear.extend(calculus.linear(&outside, &field.name)?);
        let linear = densities.put_in(&calculus, linear)?;
        let (indexed, own) = condition(&calculus, linear, &field.name, field.shape, scope)?;
        let is_fixed = field
            .components
            .iter()
            .any(|&c| piece.fixed.contains(&(c, false)));
        let vanishes = own.iter().all(|&e| {
            let e = on_side(scope, &piece.side, e);
            scope.space.graph.is_zero(e) || scope.space.vanish(&[e])
        });
        if !is_fixed && !vanishes {
            shown.extend(field.components.iter().filter(|_| field.on.is_none()));
            found.extend(indexed);
        }
        coefficients.push((field.name.clone(), field.shape, own));
    }
    if !is_first_variation(functional, piece, scope, &coefficients) {
        return None;
    }
    match Varied::new(functional, piece, &wholes, shown).freedom() {
        Freedom::Everywhere => {}
        Freedom::InGeneral => found[..tractions]
            .iter_mut()
            .for_each(|own| own.is_in_general = true),
        Freedom::Unknown => return None,
    }
    Some(found)
}

/// The coefficient with its components; derivatives of the variation have no place here.
fn condition(
    calculus: &Calculus<'_>,
    linear: Linear,
    name: &str,
    shape: Shape,
    scope: &Scope,
) -> Option<(Option<Indexed>, Vec<Expr>)> {
    if linear
        .iter()
        .any(|(_, occurrence)| !occurrence.derivatives.is_empty())
    {
        return None;
    }
    let free = free_of(shape, scope)?;
    let is_empty = linear.is_empty();
    let value = coefficient(calculus, linear, shape, (&free, scope))?;
    let own = components(scope, &value, shape, &free);
    let of = name_of(name, &free);
    let indexed = Indexed {
        of,
        value,
        is_in_general: false,
    };
    Some(((!is_empty).then_some(indexed), own))
}

/// Definitions in the density of a piece that contain the normal and a field that is varied.
fn varied_as_a_whole(
    functional: &Functional,
    density: Option<&Node>,
    scope: &Scope,
) -> BTreeSet<String> {
    let mut named = Vec::new();
    if let Some(tree) = density {
        names(tree, &mut named);
    }
    let varied: BTreeSet<usize> = functional
        .interior()
        .flat_map(|f| f.components.clone())
        .collect();
    let normal = scope.space.normals();
    let own = named.into_iter().filter(|name| {
        let Some(tensor) = scope
            .tensors
            .get(name)
            .filter(|_| scope.definitions.contains_key(name))
        else {
            return false;
        };
        let symbols = scope.space.symbols_in(&tensor.components);
        let jets = scope.space.jets_in(&tensor.components);
        symbols.iter().any(|s| normal.contains(s))
            && jets.iter().any(|j| varied.contains(&j.component))
    });
    own.collect()
}

/// Whether `Σ c δ(…)` has the coefficients of the first variation on the piece.
fn is_first_variation(
    functional: &Functional,
    piece: &Piece,
    scope: &Scope,
    coefficients: &[(String, Shape, Vec<Expr>)],
) -> bool {
    let space = &*functional.space;
    let g = &space.graph;
    let Some(form) = piece_form(functional, &piece.name) else {
        return false;
    };
    let d = space.dimensions();
    let mut wanted: BTreeMap<Jet, Vec<Expr>> = form
        .into_iter()
        .map(|(jet, value)| (jet, vec![g.neg(value)]))
        .collect();
    for (name, shape, values) in coefficients {
        let Some(tensor) = scope.tensors.get(name) else {
            return false;
        };
        for ((indices, multiplicity), &value) in shape.components(d).iter().zip(values) {
            let Some(own) = tensor.at(indices, d) else {
                return false;
            };
            let own = on_side(scope, &piece.side, own);
            for jet in space.jets_in(&[own]) {
                let slope = space.partial(own, &jet);
                let term = g.mul(&[
                    g.integer(*multiplicity),
                    on_side(scope, &piece.side, value),
                    slope,
                ]);
                let is_varied = functional
                    .fields
                    .iter()
                    .any(|f| f.components.contains(&jet.component));
                if is_varied {
                    wanted.entry(jet).or_default().push(term);
                }
            }
        }
    }
    let sums = wanted.into_iter().map(|(jet, terms)| (jet, g.add(&terms)));
    let rest: Form = sums
        .filter(|(_, e)| !g.is_zero(*e) && !space.vanish(&[*e]))
        .collect();
    // Terms with second derivatives can be moved off the variation in two ways, which differ by a divergence along the piece.
    rest.is_empty() || vanishes_on(functional, piece, &rest)
}
