//! `chetaev derive`.

use super::{error, with_progress};
use crate::arguments::{Derive as Arguments, Notation};
use crate::progress::ProgressLine;
use crate::{files, terminal, DONE, INPUT};
use chetaev::mechanics::choice;
use chetaev::mechanics::claims::formulation::derive;
use chetaev::mechanics::{formulation, Context, Equations, Prepared, Prover, System, FORMULATIONS};
use chetaev::study::{registry, typeset};
use chetaev::symbolic::print::{sympy_module, Document, Format, PythonSection};
use chetaev::symbolic::Expr;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let names = match formulations(arguments.formulation.as_deref()) {
        Ok(names) => names,
        Err(problem) => {
            error(problem);
            return INPUT;
        }
    };
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let system = match System::from_model(&read.model) {
        Ok(system) => system,
        Err(problem) => {
            read.refuse(problem);
            return INPUT;
        }
    };
    let (prepared, notes) = match with_progress(|line| prepare(&system, line)) {
        Ok(prepared) => prepared,
        Err(problem) => {
            read.refuse(problem);
            return INPUT;
        }
    };
    for note in notes {
        terminal::err(&format!("note: {note}"));
    }
    match with_progress(|line| all(&system, &prepared, &names, arguments.notation, line)) {
        Ok(text) => {
            terminal::out(&text);
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

/// The formulation of a name, or all.
fn formulations(name: Option<&str>) -> Result<Vec<&'static str>, String> {
    let known: Vec<&'static str> = FORMULATIONS.iter().map(|f| f.card().name).collect();
    let Some(name) = name else { return Ok(known) };
    match known.iter().find(|own| **own == name) {
        Some(own) => Ok(vec![own]),
        None => Err(format!(
            "there is no formulation `{name}`; known are {}",
            known.join(", ")
        )),
    }
}

/// Terms and selection, with what a reader of the equations must know about them.
fn prepare(
    system: &System,
    line: &ProgressLine,
) -> Result<(Prepared, Vec<String>), chetaev::mechanics::characteristics::CharacteristicsError> {
    line.show("deriving", None);
    let prepared = Prepared::new(system)?;
    let mut notes = Vec::new();
    if let Some(left_out) = prepared.left_out(system)? {
        notes.push(format!(
            "redundant constraints: {} left out, the others imply what they say",
            left_out.quoted()
        ));
    }
    notes.extend(choice::unheeded(
        system,
        &prepared.terms,
        &prepared.selection,
    ));
    Ok((prepared, notes))
}

/// One formulation with its equations under their headings.
struct Derived {
    name: &'static str,
    title: &'static str,
    groups: Vec<(String, Vec<(Expr, Expr)>)>,
}

/// Everything that is printed.
fn all(
    system: &System,
    prepared: &Prepared,
    names: &[&'static str],
    notation: Notation,
    line: &ProgressLine,
) -> Result<String, String> {
    let known = registry();
    let cx = Context::new(
        system,
        &prepared.terms,
        &prepared.selection,
        &known,
        Prover::default(),
    );
    let mut derived = Vec::new();
    for &name in names {
        line.show(&format!("deriving {name}"), None);
        let equations = derive(&cx, name).map_err(|problem| format!("{name}: {problem}"))?;
        line.show(&format!("writing {name}"), None);
        derived.push(Derived {
            name,
            title: formulation(name).map_or(name, |f| f.card().title),
            groups: statements(system, &equations),
        });
    }
    Ok(match notation {
        Notation::Json => as_json(system, &derived),
        Notation::Sympy => as_module(system, &derived),
        _ => derived
            .iter()
            .map(|one| printed(system, one, notation))
            .collect(),
    })
}

/// Equations of each group, then the multipliers in closed form where they are short.
fn statements(system: &System, equations: &Equations) -> Vec<(String, Vec<(Expr, Expr)>)> {
    let mut groups: Vec<(String, Vec<(Expr, Expr)>)> = equations
        .groups
        .iter()
        .map(|group| {
            (
                group.title.clone(),
                typeset::readable(system, equations, &group.equations),
            )
        })
        .collect();
    if !equations.multipliers.is_empty() {
        let g = &system.graph;
        let values: Vec<Expr> = equations
            .multipliers
            .iter()
            .map(|(_, value)| *value)
            .collect();
        let short = typeset::simplified(system, &values);
        let pairs = equations
            .objects
            .iter()
            .zip(short)
            .map(|(object, value)| (g.symbol(&object.name, 0), value))
            .collect();
        groups.push(("multipliers".into(), pairs));
    }
    groups
}

fn printed(system: &System, derived: &Derived, notation: Notation) -> String {
    let options = typeset::print_options(system);
    let (format, before, after) = match notation {
        Notation::Latex => (Format::Latex, "% ", ""),
        Notation::Mathml => (Format::Mathml, "<!-- ", " -->"),
        _ => (Format::Text, "", ""),
    };
    let colon = if notation == Notation::Mathml {
        ""
    } else {
        ":"
    };
    let mut text = format!("{before}{}{after}\n", derived.title);
    for (heading, pairs) in &derived.groups {
        if pairs.is_empty() {
            continue;
        }
        text.push_str(&format!("{before}{heading}{colon}{after}\n"));
        let document = Document::equations(&system.graph, pairs, &options);
        text.push_str(document.render(format).trim_end());
        text.push('\n');
    }
    text.push('\n');
    text
}

/// One Python module with a dictionary for each formulation: the equations by their headings.
fn as_module(system: &System, derived: &[Derived]) -> String {
    let options = typeset::print_options(system);
    let documents: Vec<Vec<Document>> = derived
        .iter()
        .map(|one| {
            one.groups
                .iter()
                .map(|(_, pairs)| Document::equations(&system.graph, pairs, &options))
                .collect()
        })
        .collect();
    let sections: Vec<PythonSection<'_>> = derived
        .iter()
        .zip(&documents)
        .map(|(one, documents)| PythonSection {
            name: one.name,
            title: one.title,
            groups: one
                .groups
                .iter()
                .map(|(heading, _)| heading.as_str())
                .zip(documents)
                .collect(),
        })
        .collect();
    let controls = system.controls.iter().map(|u| u.name.clone());
    let quasi = system.quasi_velocities.iter().map(|u| u.name.clone());
    let moving: Vec<String> = controls.chain(quasi).collect();
    sympy_module(&sections, &moving)
}

fn as_json(system: &System, derived: &[Derived]) -> String {
    let g = &system.graph;
    let list: Vec<serde_json::Value> = derived
        .iter()
        .map(|one| {
            let groups: Vec<serde_json::Value> = one
                .groups
                .iter()
                .map(|(title, pairs)| {
                    let list: Vec<serde_json::Value> = pairs
                        .iter()
                        .map(|&(l, r)| serde_json::json!({"left": g.text(l), "right": g.text(r), "latex": format!("{} = {}", g.latex(l), g.latex(r))}))
                        .collect();
                    serde_json::json!({"title": title, "equations": list})
                })
                .collect();
            serde_json::json!({"formulation": one.name, "groups": groups})
        })
        .collect();
    format!(
        "{}\n",
        serde_json::to_string_pretty(&list).unwrap_or_default()
    )
}
