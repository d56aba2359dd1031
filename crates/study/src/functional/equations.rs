//! What people are shown of a functional: its equations with the variations that they belong to, in order, in words.

use chetaev_functionals::functional::{Definition, Equation, Field, Functional, Role, Side};
use chetaev_functionals::notation::{equations, Index, Kind, Node};
use chetaev_functionals::tensors::Shape;
use chetaev_functionals::variation::{Condition, Trace, Variation};
use chetaev_symbolic::print::{Document, Options};
use chetaev_symbolic::simplify;
use chetaev_symbolic::{Expr, Rational};

/// An equation to be shown: what it is the coefficient of, and what vanishes.
pub(super) struct Shown {
    /// `δu_1`.
    pub(super) of: String,
    /// The expression.
    pub(super) value: Expr,
}

/// An equation in index notation.
pub(super) struct Indexed {
    /// `δu_k`.
    pub(super) of: String,
    /// What vanishes.
    pub(super) value: Node,
    /// Where it is known to.
    pub(super) only_where: Option<String>,
}

/// The Euler equations in index notation, of the fields for which there is a form; without those that vanish identically.
pub(super) fn indexed_euler(functional: &Functional, variation: &Variation) -> Vec<Indexed> {
    let own = equations::euler(functional, variation)
        .into_iter()
        .flatten();
    let absent = absent(functional, variation);
    let is_shown = |own: &Indexed| {
        let field = head(own.of.trim_start_matches('δ'));
        !matches!(&own.value.kind, Kind::Number(n) if *n == Rational::ZERO)
            && absent.iter().all(|name| name != field)
    };
    with_indices(own.map(shown_indexed).filter(is_shown).collect())
}

/// What is said of equations that are printed in components alone.
pub(super) const NO_INDICES: &str = "in components only: no short form in index notation was found";

/// Fields whose Euler equations have no short form in index notation, though others have one; those that vanish identically need none.
pub(super) fn without_indices(functional: &Functional, variation: &Variation) -> Vec<String> {
    if indexed_euler(functional, variation).is_empty() {
        return Vec::new();
    }
    let absent = absent(functional, variation);
    let all = equations::euler(functional, variation);
    let all = functional.interior().zip(all);
    let open = all.filter(|(field, own)| own.is_none() && !absent.contains(&field.name));
    open.map(|(field, _)| format!("δ{}", field.name)).collect()
}

/// Whether conditions on a piece have no short form in index notation, though tensors are varied there.
pub(super) fn is_without_indices(functional: &Functional, piece: &str, shown: &[Shown]) -> bool {
    let of_tensor = |own: &Shown| own.of.contains('_');
    shown.iter().any(of_tensor) && indexed_natural(functional, piece).is_none()
}

/// Fields of the interior whose Euler equations vanish identically.
pub(super) fn absent(functional: &Functional, variation: &Variation) -> Vec<String> {
    let space = &functional.space;
    let vanishes = |component: &usize| {
        let own = variation.euler.iter().find(|(c, _)| c == component);
        own.is_some_and(|&(_, value)| {
            space.graph.is_zero(value) || space.graph.is_zero(readable(functional, value))
        })
    };
    let fields = functional.interior();
    let absent = fields.filter(|field| field.components.iter().all(vanishes));
    absent.map(|field| field.name.clone()).collect()
}

/// What is imposed in the interior without a multiplier and restricts varied fields there, by its labels; empty where nothing does.
pub(super) fn restricting(functional: &Functional) -> String {
    let space = &functional.space;
    let varied: Vec<usize> = functional
        .interior()
        .flat_map(|field| field.components.clone())
        .collect();
    let restricts = |residual: &[Expr]| {
        space
            .jets_in(residual)
            .iter()
            .any(|jet| varied.contains(&jet.component))
    };
    let own = functional
        .restricting()
        .filter(|own| own.on.is_none() && restricts(&own.residuals));
    own.map(|own| format!("({})", own.label))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Equations in index notation; none where no index occurs, as they are those in components then.
fn with_indices(all: Vec<Indexed>) -> Vec<Indexed> {
    if all.iter().any(|own| has_index(&own.value)) {
        all
    } else {
        Vec::new()
    }
}

fn has_index(node: &Node) -> bool {
    let is_letter = |all: &[Index]| all.iter().any(|own| matches!(own, Index::Letter(_)));
    match &node.kind {
        Kind::Number(_) => false,
        Kind::Atom(own) => {
            let argument = own.argument.as_deref();
            is_letter(&own.indices)
                || is_letter(&own.derivatives)
                || argument.is_some_and(has_index)
        }
        Kind::Sum(own) | Kind::Product(own) => own.iter().any(|(_, part)| has_index(part)),
        Kind::Power(base, exponent) => has_index(base) || has_index(exponent),
        Kind::Apply(_, own) => own.iter().any(has_index),
        Kind::Root(own) => has_index(own),
        Kind::Derivative(own, by) => is_letter(by) || has_index(own),
    }
}

/// The conditions on a piece in index notation; `None` where they have no short form.
pub(super) fn indexed_natural(functional: &Functional, piece: &str) -> Option<Vec<Indexed>> {
    let piece = functional.piece(piece)?;
    let own = equations::natural(functional, piece)?;
    let own = with_indices(own.into_iter().map(shown_indexed).collect());
    // On a face the normal is known, and conditions on scalars have no other index.
    let is_face = matches!(piece.side, Side::Flat { .. });
    let is_scalar = own.iter().all(|own| !own.of.contains('_'));
    Some(if is_face && is_scalar {
        Vec::new()
    } else {
        own
    })
}

fn shown_indexed(own: equations::Indexed) -> Indexed {
    let only_where = format!("where δ{} takes all values", own.of);
    Indexed {
        of: format!("δ{}", own.of),
        value: own.value,
        only_where: own.is_in_general.then_some(only_where),
    }
}

/// The Euler equations, simplified for reading.
pub(super) fn euler(functional: &Functional, variation: &Variation) -> Vec<Shown> {
    let own = variation.euler.iter().map(|&(component, value)| Shown {
        of: format!("δ{}", functional.space.component_at(component).name),
        value: readable(functional, value),
    });
    own.filter(|shown| !functional.space.graph.is_zero(shown.value))
        .collect()
}

/// Pieces of the boundary on which nothing is left to vanish and the same is given are named together; the others stand alone.
pub(super) fn joined(
    functional: &Functional,
    all: Vec<(String, Vec<Shown>)>,
) -> Vec<(Vec<String>, Vec<Shown>)> {
    let mut found: Vec<(Vec<String>, Vec<Shown>)> = Vec::new();
    for (piece, shown) in all {
        let same = found.iter_mut().find(|(pieces, other)| {
            let first = pieces.first().map_or("", String::as_str);
            shown.is_empty()
                && other.is_empty()
                && given(functional, first) == given(functional, &piece)
        });
        match same {
            Some((pieces, _)) => pieces.push(piece),
            None => found.push((vec![piece], shown)),
        }
    }
    found
}

/// What is given on a piece: `w`, `w,n`.
pub(super) fn given(functional: &Functional, piece: &str) -> Vec<String> {
    let own = functional.piece(piece).map_or(&[][..], |own| &own.fixed);
    let name = |&(component, is_normal): &(usize, bool)| {
        let name = functional.space.component_at(component).name;
        format!("{name}{}", if is_normal { ",n" } else { "" })
    };
    own.iter().map(name).collect()
}

/// Stated equations with a role in the order of their numbers, and those with names in the order of the file.
pub(super) fn in_order(functional: &Functional, role: Role) -> Vec<&Equation> {
    let mut own: Vec<&Equation> = functional.with_role(role).collect();
    own.sort_by_key(|equation| number(&equation.label));
    own
}

/// The number of a label; names come after all numbers.
pub(super) fn number(label: &str) -> u64 {
    label.parse().unwrap_or(u64::MAX)
}

/// Definitions that the densities, the stated equations, or other such definitions speak of.
pub(super) fn used(functional: &Functional) -> Vec<&Definition> {
    let pieces = functional.pieces.iter().map(|own| own.written.as_str());
    let stated = functional
        .equations
        .iter()
        .filter(|own| own.role != Role::Other);
    let stated = stated.map(|own| own.written.as_str());
    let mut texts: Vec<&str> = vec![functional.written.as_str()];
    texts.extend(pieces.chain(stated));
    let mut found: Vec<&Definition> = Vec::new();
    let mut at = 0;
    while at < texts.len() {
        for own in &functional.definitions {
            let is_new = found.iter().all(|known| known.name != own.name);
            if is_new && mentions(texts[at], head(&own.name)) {
                found.push(own);
                texts.push(&own.written);
            }
        }
        at += 1;
    }
    let own = functional.definitions.iter();
    own.filter(|own| found.iter().any(|known| known.name == own.name))
        .collect()
}

/// The kind of a tensor in words.
pub(super) fn kind(shape: Shape) -> &'static str {
    match shape {
        Shape::Symmetric => "symmetric tensor",
        Shape::Matrix => "tensor",
        other => other.word(),
    }
}

/// On what data depend, where that is not every variable: ` of x`, or that they are constant.
pub(super) fn dependence(functional: &Functional, field: &Field) -> String {
    match functional.variables_of(field).as_deref() {
        None => String::new(),
        Some([]) => ", constant".to_owned(),
        Some(all) => format!(" of {} only", all.join(", ")),
    }
}

/// The name without indices: `D` of `D_ij`.
pub(super) fn head(name: &str) -> &str {
    name.rsplit_once('_').map_or(name, |(head, _)| head)
}

fn mentions(text: &str, name: &str) -> bool {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    words
        .into_iter()
        .any(|word| word == name || head(word) == name)
}

/// Pieces of the boundary with their natural conditions, and corners.
pub(super) fn boundary(
    functional: &Functional,
    variation: &Variation,
) -> Vec<(String, Vec<Shown>)> {
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
        (Trace::Normal, Some(Side::Flat { axis, .. })) => {
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
pub(super) fn options(functional: &Functional) -> Options {
    Options {
        display: functional.space.display(),
        ..Options::default()
    }
}

/// The expression set equal to zero.
pub(super) fn document(functional: &Functional, e: Expr) -> Document {
    let g = &functional.space.graph;
    Document::equations(g, &[(e, g.zero())], &options(functional))
}

/// Labels of equations with a role: `(1), (2)`.
pub(super) fn labels(functional: &Functional, role: Role) -> String {
    let own: Vec<String> = in_order(functional, role)
        .into_iter()
        .map(|e| format!("({})", e.label))
        .collect();
    own.join(", ")
}
