//! A functional in one model file: includes, overrides and the functionals it is related to written into it.
//!
//! Whoever checks a record needs to read no more than this text. Expressions stand in index notation as the model states them.

use crate::flat::{array, line, quoted, table};
use chetaev_functionals::functional::{
    Equation, Field, Functional, Interval, Parameter, Piece, Relation, Role, Side, Solution,
    Special,
};
use chetaev_functionals::notation::written;
use chetaev_functionals::tensors::Shape;
use chetaev_functionals::Problem;
use chetaev_symbolic::print::Format;
use std::collections::BTreeSet;

/// The functional with those that it is related to under `[others.NAME]`, as a model file.
pub(super) fn flat(problem: &Problem) -> String {
    let own = &problem.functional;
    let mut text = String::new();
    line(&mut text, "kind", &quoted("functional"));
    functional(&mut text, "", own);
    let mut known = BTreeSet::new();
    for relation in &problem.relations {
        let Some(other) = other_of(relation) else {
            continue;
        };
        if known.insert(&other.name) {
            functional(
                &mut text,
                &format!("others.{}.", quoted(&other.name)),
                other,
            );
        }
    }
    relations(&mut text, &problem.relations);
    for solution in &problem.solutions {
        stated_solution(&mut text, own, solution);
    }
    text
}

fn other_of(relation: &Relation) -> Option<&Functional> {
    match relation {
        Relation::Duality { other, .. }
        | Relation::Descent { other, .. }
        | Relation::Degeneration { other, .. } => Some(other),
        Relation::Without(_) => None,
    }
}

fn functional(text: &mut String, prefix: &str, own: &Functional) {
    if let Some(heading) = prefix.strip_suffix('.') {
        text.push_str(&format!("\n[{heading}]\n"));
    }
    line(text, "name", &quoted(&own.name));
    line(text, "density", &quoted(&own.written));
    for (key, role) in [("imposed", Role::Imposed), ("yields", Role::Yielded)] {
        line(
            text,
            key,
            &array(own.with_role(role).map(|e| quoted(&e.label))),
        );
    }
    let solvable = own.equations.iter().filter(|e| e.is_solvable);
    let solvable = array(solvable.map(|e| quoted(&e.label)));
    line(text, "solvable", &solvable);
    line(
        text,
        "assumptions",
        &array(own.assumptions.iter().map(|s| quoted(s))),
    );
    line(
        text,
        "symmetries",
        &array(own.symmetries.iter().map(|s| quoted(s))),
    );
    let mut section = |name: &str, entries: Vec<(String, String)>| {
        table(text, &format!("{prefix}{name}"), entries.into_iter());
    };
    section("domain", domain(own));
    let sizes = own.scope.sizes.iter();
    section(
        "sizes",
        sizes
            .map(|(name, n)| (name.clone(), n.to_string()))
            .collect(),
    );
    let field = |of: &Field| field(own, of);
    section("fields", own.fields.iter().map(field).collect());
    section("data", own.data.iter().map(field).collect());
    section(
        "parameters",
        own.parameters.iter().map(|p| parameter(own, p)).collect(),
    );
    section("functions", functions(own));
    let definitions = own.definitions.iter();
    section(
        "define",
        definitions
            .map(|d| (d.name.clone(), quoted(&d.written)))
            .collect(),
    );
    section(
        "boundary",
        own.pieces.iter().map(|p| piece(own, p)).collect(),
    );
    section("equations", own.equations.iter().map(equation).collect());
    let held = own.equations.iter().filter_map(|e| {
        let (stated, _) = e.multiplier.as_ref()?;
        Some((e.label.clone(), quoted(stated)))
    });
    section("multipliers", held.collect());
}

fn domain(own: &Functional) -> Vec<(String, String)> {
    let all = own.space.coordinates.iter();
    let spatial: Vec<_> = all.clone().filter(|c| !c.is_time).collect();
    // Coordinates that are numbered are one name with an index.
    let numbered = spatial.iter().all(|c| c.name != c.suffix);
    let letter = spatial.first().and_then(|c| c.name.strip_suffix("_1"));
    let coordinates = match letter.filter(|_| numbered) {
        Some(letter) => quoted(&format!("{letter}_i")),
        None => array(spatial.iter().map(|c| quoted(&c.name))),
    };
    let mut found = vec![("coordinates".to_owned(), coordinates)];
    if let Some(time) = all.clone().find(|c| c.is_time) {
        found.push(("time".to_owned(), quoted(&time.name)));
    }
    let curved = own.pieces.iter().filter(|p| p.side == Side::Curved);
    found.push((
        "boundary".to_owned(),
        array(curved.map(|p| quoted(&p.name))),
    ));
    found.push(("intervals".to_owned(), intervals(own, &own.intervals)));
    found
}

fn intervals(own: &Functional, all: &[Interval]) -> String {
    let g = &own.space.graph;
    inline(all.iter().map(|i| {
        let ends = [i.lower, i.upper].map(|end| quoted(&g.text(end)));
        (own.space.coordinates[i.axis].name.clone(), array(ends))
    }))
}

fn inline(entries: impl Iterator<Item = (String, String)>) -> String {
    let all: Vec<String> = entries
        .map(|(key, value)| format!("{} = {value}", quoted(&key)))
        .collect();
    format!("{{ {} }}", all.join(", "))
}

/// An inline table of texts that are stated, in order.
fn stated(entries: &[(&str, Option<&str>)]) -> String {
    let own = entries
        .iter()
        .filter_map(|(key, text)| Some(((*key).to_owned(), quoted((*text)?))));
    inline(own)
}

fn field(of: &Functional, own: &Field) -> (String, String) {
    let kind = Some(("kind", quoted(own.shape.word())));
    let on = own.on.as_deref().map(|on| ("on", quoted(on)));
    let variables = of.variables_of(own);
    let variables = variables.map(|all| ("of", array(all.into_iter().map(quoted))));
    let entries = [kind, on, variables].into_iter().flatten();
    let entries = entries.map(|(key, value)| (key.to_owned(), value));
    (own.name.clone(), inline(entries))
}

fn parameter(own: &Functional, p: &Parameter) -> (String, String) {
    let value = p.value.map(|e| own.space.graph.text(e));
    let kind = (p.shape != Shape::Scalar).then(|| p.shape.word());
    (
        p.name.clone(),
        stated(&[("kind", kind), ("value", value.as_deref())]),
    )
}

fn functions(own: &Functional) -> Vec<(String, String)> {
    let entries = own.functions.iter().map(|f| {
        let of = match own.space.function_at(f.function).rank {
            0 => Shape::Scalar,
            1 => Shape::Vector,
            _ => Shape::Symmetric,
        };
        let entry = stated(&[
            ("of", Some(of.word())),
            ("conjugate", f.conjugate.as_deref()),
            ("value", f.value.as_deref()),
            ("gradient", f.gradient.as_deref()),
        ]);
        (f.name.clone(), entry)
    });
    entries.collect()
}

fn piece(own: &Functional, p: &Piece) -> (String, String) {
    let at = side(own, &p.side);
    let density = [("density", Some(p.written.as_str())), ("at", at.as_deref())];
    let fixed = p.fixed.iter().map(|(component, is_normal)| {
        let name = own.space.component_at(*component).name;
        quoted(&if *is_normal {
            format!("{name},n")
        } else {
            name
        })
    });
    let texts = density
        .iter()
        .filter_map(|(key, text)| Some(((*key).to_owned(), quoted((*text)?))));
    let fixed = std::iter::once(("fixed".to_owned(), array(fixed)));
    (p.name.clone(), inline(texts.chain(fixed)))
}

/// `x = a` for a face of a box.
fn side(own: &Functional, side: &Side) -> Option<String> {
    let Side::Flat { axis, at, .. } = side else {
        return None;
    };
    let name = &own.space.coordinates[*axis].name;
    Some(format!("{name} = {}", own.space.graph.text(*at)))
}

fn equation(e: &Equation) -> (String, String) {
    (
        e.label.clone(),
        stated(&[("equation", Some(&e.written)), ("on", e.on.as_deref())]),
    )
}

fn relations(text: &mut String, all: &[Relation]) {
    for relation in all {
        let Some(other) = other_of(relation).map(|other| quoted(&other.name)) else {
            continue;
        };
        match relation {
            Relation::Duality { flux, .. } => {
                let flux = flux
                    .iter()
                    .map(|(stated, _)| ("flux".to_owned(), quoted(stated)));
                let with = std::iter::once(("with".to_owned(), other));
                table(text, "duality", with.chain(flux));
            }
            Relation::Descent {
                other: above,
                imposed,
                release,
                ..
            } => {
                let mut entries = vec![("from".to_owned(), other)];
                entries.push((
                    "imposing".to_owned(),
                    array(imposed.iter().map(|l| quoted(l))),
                ));
                if let Some(release) = release {
                    let tree = release.tree.as_ref();
                    let density = tree.map(|t| quoted(&written(t, &above.scope, Format::Text)));
                    entries.extend(density.map(|d| ("released".to_owned(), d)));
                    entries.push(("multiplier".to_owned(), quoted(&release.written)));
                }
                table(text, "descent", entries.into_iter());
            }
            Relation::Degeneration { name, values, .. } => {
                let entries = [
                    ("becomes".to_owned(), other),
                    ("at".to_owned(), special(values)),
                ];
                table(
                    text,
                    &format!("degenerations.{}", quoted(name)),
                    entries.into_iter(),
                );
            }
            Relation::Without(_) => {}
        }
    }
}

fn special(values: &[Special]) -> String {
    let own = values.iter().filter_map(|v| v.written.split_once(" = "));
    inline(own.map(|(left, right)| (left.to_owned(), quoted(right))))
}

fn stated_solution(text: &mut String, own: &Functional, solution: &Solution) {
    let pieces = own.pieces.iter().filter_map(|piece| {
        let mut here = solution
            .pieces
            .iter()
            .filter(|(name, _)| *name == piece.name);
        let faces: Vec<String> = here
            .by_ref()
            .filter_map(|(_, at)| Some(quoted(&side(own, at)?)))
            .collect();
        let is_known = solution.has_pieces || !faces.is_empty();
        let value = match &faces[..] {
            [one] => one.clone(),
            all => array(all.iter().cloned()),
        };
        is_known.then(|| (piece.name.clone(), value))
    });
    let mut entries = vec![
        (
            "parameters".to_owned(),
            array(solution.parameters.iter().map(|p| quoted(p))),
        ),
        ("intervals".to_owned(), intervals(own, &solution.intervals)),
        ("pieces".to_owned(), inline(pieces)),
        ("fields".to_owned(), special(&solution.values)),
    ];
    let value = solution.value.as_ref();
    entries.extend(value.map(|(stated, _)| ("value".to_owned(), quoted(stated))));
    table(
        text,
        &format!("solutions.{}", quoted(&solution.name)),
        entries.into_iter(),
    );
}
