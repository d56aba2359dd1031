//! Studies of functionals for people and programs: the summary, the record and the report.

mod derivation;
mod page;
mod pictures;
mod record;
mod summary;
mod table;
mod verification;

pub use derivation::derivation;
pub use page::page;
pub use record::record;
pub use summary::summary;
pub use verification::verify;

use chetaev_functionals::functional::{Functional, Role};
use chetaev_functionals::notation::{equations, Kind, Node};
use chetaev_functionals::variation::{Condition, Trace, Variation};
use chetaev_symbolic::print::{Document, Options};
use chetaev_symbolic::simplify;
use chetaev_symbolic::{Expr, Rational};

/// An equation to be shown: what it is the coefficient of, and what vanishes.
struct Shown {
    /// `δu_1`.
    of: String,
    /// The expression.
    value: Expr,
}

/// An equation in index notation.
struct Indexed {
    /// `δu_k`.
    of: String,
    /// What vanishes.
    value: Node,
}

/// The Euler equations in index notation, of the fields for which there is a form; without those that vanish identically.
fn indexed_euler(functional: &Functional, variation: &Variation) -> Vec<Indexed> {
    let own = equations::euler(functional, variation)
        .into_iter()
        .flatten();
    own.map(shown_indexed)
        .filter(|own| !matches!(&own.value.kind, Kind::Number(n) if *n == Rational::ZERO))
        .collect()
}

/// The conditions on a piece in index notation; `None` where they have no short form.
fn indexed_natural(functional: &Functional, piece: &str) -> Option<Vec<Indexed>> {
    let own = equations::natural(functional, functional.piece(piece)?)?;
    Some(own.into_iter().map(shown_indexed).collect())
}

fn shown_indexed(own: equations::Indexed) -> Indexed {
    Indexed {
        of: format!("δ{}", own.of),
        value: own.value,
    }
}

/// The Euler equations, simplified for reading.
fn euler(functional: &Functional, variation: &Variation) -> Vec<Shown> {
    let own = variation.euler.iter().map(|&(component, value)| Shown {
        of: format!("δ{}", functional.space.component_at(component).name),
        value: readable(functional, value),
    });
    own.filter(|shown| !functional.space.graph.is_zero(shown.value))
        .collect()
}

/// Pieces of the boundary with their natural conditions, and corners.
fn boundary(functional: &Functional, variation: &Variation) -> Vec<(String, Vec<Shown>)> {
    let mut found: Vec<(String, Vec<Shown>)> = Vec::new();
    for on in &variation.pieces {
        let own = on.conditions.iter().map(|condition| Shown {
            of: varied(functional, on.piece.as_str(), condition),
            value: readable(functional, condition.value),
        });
        let own = own.filter(|shown| !functional.space.graph.is_zero(shown.value));
        found.push((on.piece.clone(), own.collect()));
    }
    for corner in &variation.corners {
        let place = format!("{} and {}", corner.pieces.0, corner.pieces.1);
        let shown = Shown {
            of: format!("δ{}", functional.space.component_at(corner.component).name),
            value: readable(functional, corner.value),
        };
        match found.iter_mut().find(|(own, _)| *own == place) {
            Some((_, all)) => all.push(shown),
            None => found.push((place, vec![shown])),
        }
    }
    found
}

fn varied(functional: &Functional, piece: &str, condition: &Condition) -> String {
    let name = functional.space.component_at(condition.component).name;
    let side = functional.piece(piece).map(|own| &own.side);
    match (&condition.trace, side) {
        (Trace::Value, _) => format!("δ{name}"),
        (Trace::Normal, Some(chetaev_functionals::functional::Side::Flat { axis, .. })) => {
            format!("δ{name},{}", functional.space.coordinates[*axis].suffix)
        }
        (Trace::Normal, _) => format!("∂δ{name}/∂n"),
    }
}

/// Longer expressions are shown as they were derived.
const LONGEST: u64 = 3_000;

fn readable(functional: &Functional, e: Expr) -> Expr {
    let g = &functional.space.graph;
    if simplify::length(g, e) > LONGEST {
        e
    } else {
        simplify::simplify(g, e, &simplify::Options::default())
    }
}

/// How names are typeset.
fn options(functional: &Functional) -> Options {
    Options {
        display: functional.space.display(),
        ..Options::default()
    }
}

/// The expression set equal to zero.
fn document(functional: &Functional, e: Expr) -> Document {
    let g = &functional.space.graph;
    Document::equations(g, &[(e, g.zero())], &options(functional))
}

/// Labels of equations with a role: `(1), (2)`.
fn labels(functional: &Functional, role: Role) -> String {
    let own: Vec<String> = functional
        .with_role(role)
        .map(|e| format!("({})", e.label))
        .collect();
    own.join(", ")
}
