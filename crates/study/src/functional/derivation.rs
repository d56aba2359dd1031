//! Euler equations and natural conditions in one notation: what `derive` prints of a functional.

use super::{boundary, euler, indexed_euler, indexed_natural, options, Indexed, Shown};
use chetaev_functionals::functional::Functional;
use chetaev_functionals::notation::written_equation;
use chetaev_functionals::variation::{variation, VariationError};
use chetaev_symbolic::print::{sympy_module, Document, Format, PythonSection};

/// The equations of a functional: in index notation, where it has a short form, and in components.
///
/// # Errors
/// Orders of derivatives for which no conditions on the boundary are derived.
pub fn derivation(functional: &Functional, format: Format) -> Result<String, VariationError> {
    let found = variation(functional)?;
    let inside = Part {
        title: "Euler equations".to_owned(),
        indexed: indexed_euler(functional, &found),
        shown: euler(functional, &found),
    };
    let mut parts = vec![inside];
    for (piece, shown) in boundary(functional, &found) {
        parts.push(Part {
            title: format!("conditions on {piece}"),
            indexed: indexed_natural(functional, &piece).unwrap_or_default(),
            shown,
        });
    }
    Ok(match format {
        Format::Sympy => as_module(functional, &parts),
        Format::Json => as_json(functional, &parts),
        _ => parts
            .iter()
            .map(|part| part.text(functional, format))
            .collect(),
    })
}

struct Part {
    title: String,
    indexed: Vec<Indexed>,
    shown: Vec<Shown>,
}

impl Part {
    fn text(&self, functional: &Functional, format: Format) -> String {
        let mut out = marked(&self.title, format);
        if self.indexed.is_empty() && self.shown.is_empty() {
            out.push_str(&marked(
                "nothing is free here, or every coefficient vanishes identically",
                format,
            ));
        }
        for own in &self.indexed {
            let line = written_equation(&own.value, &functional.scope, format);
            out.push_str(&labelled(&own.of, &line, format));
        }
        if !self.indexed.is_empty() && !self.shown.is_empty() {
            out.push_str(&marked("in components", format));
        }
        let g = &functional.space.graph;
        for own in &self.shown {
            let document = Document::equations(g, &[(own.value, g.zero())], &options(functional));
            out.push_str(&labelled(&own.of, &document.render(format), format));
        }
        out.push('\n');
        out
    }
}

fn marked(line: &str, format: Format) -> String {
    match format {
        Format::Latex => format!("% {line}\n"),
        Format::Mathml => format!("<!-- {} -->\n", line.replace("--", "‐‐")),
        _ => format!("{line}\n"),
    }
}

fn labelled(of: &str, line: &str, format: Format) -> String {
    match format {
        Format::Latex => format!("% {of}\n\\[ {line} \\]\n"),
        Format::Mathml => format!("<!-- {of} -->\n{line}\n"),
        _ => format!("  {of:<12} {line}\n"),
    }
}

fn as_module(functional: &Functional, parts: &[Part]) -> String {
    let g = &functional.space.graph;
    let documents: Vec<Vec<(String, Document)>> = parts
        .iter()
        .map(|part| {
            let own = part.shown.iter().map(|own| {
                let pair = [(own.value, g.zero())];
                (
                    own.of.clone(),
                    Document::equations(g, &pair, &options(functional)),
                )
            });
            own.collect()
        })
        .collect();
    let names: Vec<String> = (1..=parts.len()).map(|k| format!("part_{k}")).collect();
    let sections: Vec<PythonSection<'_>> = parts
        .iter()
        .zip(&documents)
        .zip(&names)
        .map(|((part, own), name)| PythonSection {
            name,
            title: &part.title,
            groups: own
                .iter()
                .map(|(of, document)| (of.as_str(), document))
                .collect(),
        })
        .collect();
    sympy_module(&sections, &[])
}

fn as_json(functional: &Functional, parts: &[Part]) -> String {
    let g = &functional.space.graph;
    let all: Vec<serde_json::Value> = parts
        .iter()
        .map(|part| {
            let indexed: Vec<_> = part
                .indexed
                .iter()
                .map(|own| {
                    let text = written_equation(&own.value, &functional.scope, Format::Text);
                    serde_json::json!({"of": own.of, "equation": text})
                })
                .collect();
            let shown: Vec<_> = part
                .shown
                .iter()
                .map(|own| {
                    let tree: serde_json::Value =
                        serde_json::from_str(&g.json(own.value)).unwrap_or_default();
                    serde_json::json!({"of": own.of, "zero": tree})
                })
                .collect();
            serde_json::json!({"title": part.title, "indexed": indexed, "components": shown})
        })
        .collect();
    let whole = serde_json::json!({"functional": functional.name, "parts": all});
    serde_json::to_string_pretty(&whole).unwrap_or_default() + "\n"
}
