//! `chetaev derive`.

use super::error;
use crate::arguments::{Derive as Arguments, Notation};
use crate::{files, terminal, DONE, INPUT};
use chetaev::mechanics::claims::formulation::derive;
use chetaev::mechanics::{formulation, Context, Equations, Prepared, Prover, System, FORMULATIONS};
use chetaev::study::{registry, typeset};
use chetaev::symbolic::print::{Document, Format};
use chetaev::symbolic::Expr;

pub(crate) fn run(arguments: &Arguments) -> u8 {
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let names: Vec<&str> = match &arguments.formulation {
        Some(name) if formulation(name).is_some() => vec![name],
        Some(name) => {
            let known: Vec<&str> = FORMULATIONS.iter().map(|f| f.card().name).collect();
            error(format!(
                "there is no formulation `{name}`; known are {}",
                known.join(", ")
            ));
            return INPUT;
        }
        None => FORMULATIONS.iter().map(|f| f.card().name).collect(),
    };
    let system = match System::from_model(&read.model) {
        Ok(system) => system,
        Err(problem) => {
            read.refuse(problem);
            return INPUT;
        }
    };
    let prepared = Prepared::new(&system).and_then(|prepared| {
        prepared
            .left_out(&system)
            .map(|left_out| (prepared, left_out))
    });
    let prepared = match prepared {
        Ok((prepared, None)) => prepared,
        Ok((prepared, Some(left_out))) => {
            terminal::err(&format!(
                "note: redundant constraints: {} left out, the others imply what they say\n",
                left_out.quoted()
            ));
            prepared
        }
        Err(problem) => {
            read.refuse(problem);
            return INPUT;
        }
    };
    let known = registry();
    let cx = Context::new(
        &system,
        &prepared.terms,
        &prepared.selection,
        &known,
        Prover::default(),
    );
    let mut json = Vec::new();
    for name in names {
        match derive(&cx, name) {
            Ok(equations) if arguments.notation == Notation::Json => {
                json.push(as_json(&system, &equations))
            }
            Ok(equations) => terminal::out(&printed(&system, &equations, arguments.notation)),
            Err(problem) => {
                error(format!("{name}: {problem}"));
                return INPUT;
            }
        }
    }
    if arguments.notation == Notation::Json {
        terminal::out(&format!(
            "{}\n",
            serde_json::to_string_pretty(&json).unwrap_or_default()
        ));
    }
    DONE
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

fn printed(system: &System, equations: &Equations, notation: Notation) -> String {
    let options = typeset::print_options(system);
    let (format, comment) = match notation {
        Notation::Latex => (Format::Latex, "% "),
        Notation::Mathml => (Format::Mathml, ""),
        Notation::Sympy => (Format::Sympy, "# "),
        _ => (Format::Text, ""),
    };
    let card = formulation(equations.formulation).map(|f| f.card());
    let title = card.map_or(equations.formulation, |c| c.title);
    let mut text = match notation {
        Notation::Mathml => format!("<!-- {title} -->\n"),
        _ => format!("{comment}{title}\n"),
    };
    for (heading, pairs) in statements(system, equations) {
        if pairs.is_empty() {
            continue;
        }
        text.push_str(&match notation {
            Notation::Mathml => format!("<!-- {heading} -->\n"),
            _ => format!("{comment}{heading}:\n"),
        });
        let document = Document::equations(&system.graph, &pairs, &options);
        text.push_str(document.render(format).trim_end());
        text.push('\n');
    }
    text.push('\n');
    text
}

fn as_json(system: &System, equations: &Equations) -> serde_json::Value {
    let g = &system.graph;
    let groups: Vec<serde_json::Value> = statements(system, equations)
        .into_iter()
        .map(|(title, pairs)| {
            let list: Vec<serde_json::Value> = pairs
                .iter()
                .map(|&(l, r)| serde_json::json!({"left": g.text(l), "right": g.text(r), "latex": format!("{} = {}", g.latex(l), g.latex(r))}))
                .collect();
            serde_json::json!({"title": title, "equations": list})
        })
        .collect();
    serde_json::json!({"formulation": equations.formulation, "groups": groups})
}
