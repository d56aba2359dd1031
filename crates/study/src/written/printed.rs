//! Equations in the notations for reading, and as data.

use super::latex;
use super::Notation;
use crate::derivation::{options_of, Derivation, NotDerived};
use crate::typeset;
use chetaev_mechanics::equations::Schema;
use chetaev_mechanics::{Context, System};
use chetaev_symbolic::print::{sympy_module, Document, Format, PythonSection};
use chetaev_symbolic::Expr;

/// Equations under a heading, with their general form.
pub(super) struct Section {
    pub(super) heading: String,
    pub(super) schema: Option<Schema>,
    pub(super) pairs: Vec<(Expr, Expr)>,
}

/// What is printed of all formulations.
pub(super) fn text(
    cx: &Context<'_>,
    found: &[Result<Derivation, NotDerived>],
    notation: Notation,
) -> String {
    let system = cx.system;
    match notation {
        Notation::Json => as_json(system, found),
        Notation::Sympy => as_module(system, found),
        _ => {
            let parts = found.iter().map(|one| match (one, notation) {
                (Ok(derivation), Notation::Latex) => latex::section(system, derivation),
                (Ok(derivation), _) => printed(system, derivation, notation),
                (Err(problem), _) => marked(&problem.to_string(), notation) + "\n",
            });
            in_one_document(system, &parts.collect::<String>(), notation)
        }
    }
}

/// Markup has one root, however many formulas there are, and a text of LaTeX a beginning and an end.
fn in_one_document(system: &System, text: &str, notation: Notation) -> String {
    match notation {
        Notation::Latex => latex::document(system, text),
        Notation::Mathml => {
            format!("<div xmlns=\"http://www.w3.org/1999/xhtml\">\n{text}</div>\n")
        }
        _ => text.to_owned(),
    }
}

/// A line that is no formula, in the notation's way of saying so.
fn marked(line: &str, notation: Notation) -> String {
    match notation {
        Notation::Latex => format!("% {line}\n"),
        Notation::Mathml => format!("<!-- {} -->\n", line.replace("--", "‐‐")),
        _ => format!("{line}\n"),
    }
}

/// Equations of each group, then the intermediate objects.
pub(super) fn sections(system: &System, derivation: &Derivation) -> Vec<Section> {
    let g = &system.graph;
    let mut sections: Vec<Section> = derivation
        .groups
        .iter()
        .filter(|group| !group.pairs.is_empty())
        .map(|group| Section {
            heading: group.title.clone(),
            schema: group.schema,
            pairs: group.pairs.clone(),
        })
        .collect();
    let (multipliers, others): (Vec<_>, Vec<_>) = derivation
        .objects
        .iter()
        .map(|object| (g.symbol(&object.name, 0), object.value))
        .partition(|(name, _)| {
            g.as_symbol(*name)
                .is_some_and(|s| g.symbol_name(s).starts_with("lambda_"))
        });
    for (heading, pairs) in [("multipliers", multipliers), ("objects", others)] {
        if !pairs.is_empty() {
            sections.push(Section {
                heading: heading.into(),
                schema: None,
                pairs,
            });
        }
    }
    sections
}

fn printed(system: &System, derivation: &Derivation, notation: Notation) -> String {
    let options = options_of(system, derivation);
    let format = match notation {
        Notation::Mathml => Format::Mathml,
        _ => Format::Text,
    };
    let colon = match notation {
        Notation::Mathml => "",
        _ => ":",
    };
    let mut text = marked(derivation.card.title, notation);
    for section in sections(system, derivation) {
        text.push_str(&marked(&format!("{}{colon}", section.heading), notation));
        if let Some(schema) = section.schema {
            text.push_str(&marked(&format!("[{}]", schema.text), notation));
        }
        let document = Document::equations(&system.graph, &section.pairs, &options);
        text.push_str(document.render(format).trim_end());
        text.push('\n');
    }
    text.push('\n');
    text
}

/// One Python module with a dictionary for each formulation: the equations by their headings.
fn as_module(system: &System, found: &[Result<Derivation, NotDerived>]) -> String {
    let options = typeset::print_options(system);
    let derived: Vec<&Derivation> = found.iter().flatten().collect();
    let parts: Vec<Vec<(String, Document)>> = derived
        .iter()
        .map(|one| {
            sections(system, one)
                .into_iter()
                .map(|s| {
                    (
                        s.heading,
                        Document::equations(&system.graph, &s.pairs, &options),
                    )
                })
                .collect()
        })
        .collect();
    let names: Vec<String> = derived
        .iter()
        .map(|d| d.card.name.replace('-', "_"))
        .collect();
    let modules: Vec<PythonSection<'_>> = derived
        .iter()
        .zip(&parts)
        .zip(&names)
        .map(|((one, documents), name)| PythonSection {
            name,
            title: one.card.title,
            groups: documents.iter().map(|(h, d)| (h.as_str(), d)).collect(),
        })
        .collect();
    sympy_module(&modules, &moving(system, &derived))
}

/// Names that vary with the time beside the coordinates: controls, masses, quasi-velocities, momenta and other variables of a state.
fn moving(system: &System, derived: &[&Derivation]) -> Vec<String> {
    let controls = system.controls.iter().map(|u| u.name.clone());
    let quasi = system.quasi_velocities.iter().map(|u| u.name.clone());
    let masses = system.masses.iter().map(|m| m.name.clone());
    let mut names: Vec<String> = controls.chain(masses).chain(quasi).collect();
    for variable in derived.iter().flat_map(|d| &d.equations.variables) {
        let name = system.graph.symbol_name(variable.symbol);
        if system.coordinate_index(name).is_none() && !names.iter().any(|n| n == name) {
            names.push(name.to_string());
        }
    }
    names
}

fn as_json(system: &System, found: &[Result<Derivation, NotDerived>]) -> String {
    let list: Vec<serde_json::Value> = found
        .iter()
        .map(|one| match one {
            Ok(derivation) => derivation_json(system, derivation),
            Err(problem) => {
                let (NotDerived::NotApplicable { name, .. } | NotDerived::Failed { name, .. }) =
                    problem;
                serde_json::json!({"formulation": name, "not_derived": problem.to_string()})
            }
        })
        .collect();
    format!(
        "{}\n",
        serde_json::to_string_pretty(&list).unwrap_or_default()
    )
}

fn derivation_json(system: &System, derivation: &Derivation) -> serde_json::Value {
    let g = &system.graph;
    let card = derivation.card;
    let options = options_of(system, derivation);
    let latex = |e| {
        let document = Document::expressions(g, &[e], &options);
        document.render(Format::Latex).trim().to_owned()
    };
    let groups: Vec<serde_json::Value> = derivation
        .groups
        .iter()
        .filter(|group| !group.pairs.is_empty())
        .map(|group| {
            let equations: Vec<serde_json::Value> = group
                .pairs
                .iter()
                .zip(&group.labels)
                .map(|(&(l, r), label)| {
                    serde_json::json!({"label": label, "left": g.text(l), "right": g.text(r), "latex": format!("{} = {}", latex(l), latex(r))})
                })
                .collect();
            serde_json::json!({"title": group.title, "general_form": group.schema.map(|s| s.text), "equations": equations})
        })
        .collect();
    let objects: Vec<serde_json::Value> = derivation
        .objects
        .iter()
        .map(|o| {
            let symbol = g.symbol(&o.name, 0);
            serde_json::json!({"name": o.name, "name_latex": latex(symbol), "value": g.text(o.value), "latex": latex(o.value), "meaning": o.meaning})
        })
        .collect();
    let sources: Vec<serde_json::Value> = card
        .sources
        .iter()
        .map(|s| serde_json::json!({"key": s.key, "place": s.place}))
        .collect();
    let state: Vec<&str> = derivation
        .equations
        .variables
        .iter()
        .map(|x| x.name.as_str())
        .collect();
    let masses: Vec<&str> = system.masses.iter().map(|m| m.name.as_str()).collect();
    let mut json = serde_json::json!({
        "formulation": card.name, "title": card.title, "statement": card.statement, "principle": card.principle.words(), "requires": card.requires,
        "unknowns": card.unknowns, "sources": sources, "state": state, "groups": groups, "objects": objects,
    });
    if !masses.is_empty() {
        json["masses"] = serde_json::json!(masses);
    }
    json
}
