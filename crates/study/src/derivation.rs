//! One formulation of the equations of a system as a person reads it: requirements, equations, objects, what is claimed.

use crate::typeset;
use chetaev_mechanics::card::{Card, Relation};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::claims::full_id;
use chetaev_mechanics::equations::{Equation, NamedExpr, Schema};
use chetaev_mechanics::formulations::reduced_form::DEFINITIONS;
use chetaev_mechanics::formulations::DeriveError;
use chetaev_mechanics::{Context, Equations, Formulation, System};
use chetaev_symbolic::print::Options;
use chetaev_symbolic::simplify;
use chetaev_symbolic::{Expr, Verdict};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// A formulation derived for a system, simplified for reading.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// What it is.
    pub card: &'static Card,
    /// As it was derived.
    pub equations: Equations,
    /// The equations under their headings, simplified; what is printed is proved equal to what was derived.
    pub groups: Vec<ReadableGroup>,
    /// Intermediate objects with simplified values.
    pub objects: Vec<NamedExpr>,
}

/// Equations under a heading.
#[derive(Clone, Debug)]
pub struct ReadableGroup {
    /// Heading.
    pub title: String,
    /// General form.
    pub schema: Option<Schema>,
    /// What each belongs to.
    pub labels: Vec<String>,
    /// Left and right sides.
    pub pairs: Vec<(Expr, Expr)>,
}

/// Why there are no equations.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NotDerived {
    /// A requirement fails.
    #[error("`{name}` does not apply: {}", verdict.detail())]
    NotApplicable {
        /// The formulation.
        name: &'static str,
        /// `not-applicable`, with the hypothesis and its evidence.
        verdict: Box<Verdict>,
    },
    /// The rule gives nothing.
    #[error("`{name}`: {problem}")]
    Failed {
        /// The formulation.
        name: &'static str,
        /// Why.
        problem: DeriveError,
    },
}

/// Expressions of more signs than this in one group are printed as they were derived: simplifying them takes longer than
/// deriving them, and nobody reads them.
const READABLE: u64 = 60_000;

/// The claim of a formulation, `id#subject`; `None` for the reference.
pub fn claim_of(card: &Card) -> Option<String> {
    match card.relation {
        Relation::Reference => None,
        Relation::Equivalent => Some(full_id("formulation.equivalent", Some(card.name))),
        Relation::Coincidence => Some(full_id("formulation.vakonomic-coincides", Some("system"))),
    }
}

/// What has been simplified already: several formulations contain the same multipliers and left sides.
#[derive(Debug, Default)]
pub struct Readings {
    equations: RefCell<BTreeMap<(Expr, Expr), (Expr, Expr)>>,
    objects: RefCell<BTreeMap<Expr, Expr>>,
}

/// Checks the requirements of a formulation and derives it; with `readings` the result is simplified for reading.
///
/// # Errors
/// [`NotDerived`].
pub fn derivation(
    cx: &Context<'_>,
    formulation: &dyn Formulation,
    readings: Option<&Readings>,
) -> Result<Derivation, NotDerived> {
    let card = formulation.card();
    check_applies(cx, card)?;
    let equations = derive(cx, card.name).map_err(|problem| NotDerived::Failed {
        name: card.name,
        problem,
    })?;
    let system = cx.system;
    let laws = equations.laws_of_masses(system);
    let groups = equations
        .groups
        .iter()
        .chain(&laws)
        .map(|group| ReadableGroup {
            title: group.title.clone(),
            schema: group.schema,
            labels: group.equations.iter().map(|e| e.label.clone()).collect(),
            pairs: match readings {
                Some(known) => readable(system, &equations, &group.equations, known),
                None => group.equations.iter().map(|e| (e.left, e.right)).collect(),
            },
        })
        .collect();
    let objects = match readings {
        Some(known) => readable_objects(system, &equations.objects, known),
        None => equations.objects.clone(),
    };
    Ok(Derivation {
        card,
        equations,
        groups,
        objects,
    })
}

/// Whether the requirements of a formulation are met, as far as they can be decided.
///
/// # Errors
/// [`NotDerived::NotApplicable`].
pub fn check_applies(cx: &Context<'_>, card: &'static Card) -> Result<(), NotDerived> {
    match cx.obstacle_of(card) {
        None => Ok(()),
        Some(verdict) => Err(NotDerived::NotApplicable {
            name: card.name,
            verdict: Box::new(verdict),
        }),
    }
}

fn readable(
    system: &System,
    derived: &Equations,
    group: &[Equation],
    known: &Readings,
) -> Vec<(Expr, Expr)> {
    let g = &system.graph;
    let signs: u64 = group
        .iter()
        .map(|e| simplify::length(g, e.left).saturating_add(simplify::length(g, e.right)))
        .fold(0, u64::saturating_add);
    if signs > READABLE {
        return group.iter().map(|e| (e.left, e.right)).collect();
    }
    let read = |e: &Equation| {
        let key = (e.left, e.right);
        if let Some(&pair) = known.equations.borrow().get(&key) {
            return Some(pair);
        }
        let pair = typeset::readable(system, derived, std::slice::from_ref(e)).pop()?;
        known.equations.borrow_mut().insert(key, pair);
        Some(pair)
    };
    group
        .iter()
        .map(|e| read(e).unwrap_or((e.left, e.right)))
        .collect()
}

fn readable_objects(system: &System, objects: &[NamedExpr], known: &Readings) -> Vec<NamedExpr> {
    let g = &system.graph;
    let mut room = READABLE;
    let mut read = |e: Expr| {
        if let Some(&value) = known.objects.borrow().get(&e) {
            return value;
        }
        let signs = simplify::length(g, e);
        let value = match signs > room {
            true => e,
            false => typeset::simplified(system, &[e])[0],
        };
        room -= signs.min(room);
        known.objects.borrow_mut().insert(e, value);
        value
    };
    objects
        .iter()
        .map(|object| NamedExpr {
            value: read(object.value),
            ..object.clone()
        })
        .filter(|object| !(object.is_component && g.is_zero(object.value)))
        .collect()
}

/// How names are printed in what is derived: quasi-velocities that were chosen stand before the velocities.
pub fn options_of(system: &System, derived: &Derivation) -> Options {
    let mut options = typeset::print_options_with(system, &derived.objects);
    let chosen = derived
        .groups
        .iter()
        .filter(|group| group.title == DEFINITIONS);
    let chosen = chosen.flat_map(|group| group.labels.iter().filter(|l| !l.ends_with('\'')));
    options.coordinates.splice(0..0, chosen.cloned());
    options
}
