//! Euler equations and natural conditions in one notation: what `derive` prints of a functional.

use super::equations::{boundary, euler, indexed_euler, indexed_natural, options, Indexed, Shown};
use super::substitution::substituted;
use super::typesetting::{in_print, variation_name};
use crate::written::latex::{escaped, BEGIN};
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
    parts.extend(put_in(functional));
    Ok(match format {
        Format::Sympy => as_module(functional, &parts),
        Format::Json => as_json(functional, &parts),
        Format::Latex => as_latex(functional, &parts),
        _ => parts
            .iter()
            .map(|part| part.text(functional, format))
            .collect(),
    })
}

/// What is put in because it is imposed, with what follows then.
fn put_in(functional: &Functional) -> Vec<Part> {
    let Some(own) = substituted(functional) else {
        return Vec::new();
    };
    let part = |title: String, shown: Vec<Shown>| Part {
        title,
        indexed: Vec::new(),
        shown,
    };
    let mut parts = vec![part(
        "what is imposed, to be put in".to_owned(),
        own.shown(),
    )];
    parts.push(part("Euler equations with that".to_owned(), own.euler));
    let on_pieces = own.boundary.into_iter();
    parts.extend(
        on_pieces.map(|(piece, shown)| part(format!("conditions on {piece} with that"), shown)),
    );
    parts
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
            if let Some(only_where) = &own.only_where {
                out.push_str(&marked(only_where, format));
            }
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
        Format::Mathml => format!("<!-- {} -->\n", line.replace("--", "‐‐")),
        _ => format!("{line}\n"),
    }
}

fn labelled(of: &str, line: &str, format: Format) -> String {
    match format {
        Format::Mathml => format!("<!-- {of} -->\n{line}\n"),
        _ => format!("  {of:<12} {line}\n"),
    }
}

/// A whole document.
fn as_latex(functional: &Functional, parts: &[Part]) -> String {
    let mut out = format!("{BEGIN}\n\\section*{{{}}}\n", escaped(&functional.name));
    for part in parts {
        out.push_str(&format!("\\paragraph{{{}}}\n", heading(&part.title)));
        if part.indexed.is_empty() && part.shown.is_empty() {
            out.push_str("Nothing is free, or every coefficient vanishes identically.\n");
        }
        let own = part.indexed.iter();
        let own = own.map(|own| (own.of.as_str(), latex_of(functional, own)));
        out.push_str(&aligned(functional, own));
        if !part.indexed.is_empty() && !part.shown.is_empty() {
            out.push_str("In components:\n");
        }
        let own = part.shown.iter();
        let own = own.map(|own| (own.of.as_str(), latex_shown(functional, own)));
        out.push_str(&aligned(functional, own));
    }
    out.push_str("\\end{document}\n");
    out
}

/// A heading that begins with a capital, with names of pieces as formulas: `Conditions on $S_{u}$`.
fn heading(words: &str) -> String {
    let words = in_print(words);
    let each = words.split(' ').map(|word| {
        if word.contains("_{") {
            format!("${word}$")
        } else {
            escaped(word)
        }
    });
    let whole = each.collect::<Vec<_>>().join(" ");
    let mut letters = whole.chars();
    let first = letters.next().map(|c| c.to_uppercase().collect::<String>());
    first.unwrap_or_default() + letters.as_str()
}

fn latex_of(functional: &Functional, own: &Indexed) -> String {
    written_equation(&own.value, &functional.scope, Format::Latex)
}

fn latex_shown(functional: &Functional, own: &Shown) -> String {
    let g = &functional.space.graph;
    let document = Document::equations(g, &[(own.value, g.zero())], &options(functional));
    document.render(Format::Latex).trim().to_owned()
}

/// Equations below each other, each with the variation that it belongs to, in lines that fit a page.
fn aligned<'e>(
    functional: &Functional,
    equations: impl Iterator<Item = (&'e str, String)>,
) -> String {
    let mut rows: Vec<String> = Vec::new();
    for (of, latex) in equations {
        let name = variation_name(functional, of).and_then(|own| own.latex);
        let name = name.unwrap_or_else(|| format!("\\text{{{}}}", escaped(of)));
        if latex.len() > PAGE {
            let what = "\\text{an expression too long for a page, which the other notations print}";
            rows.push(format!("{name}:\\quad & {what}"));
            continue;
        }
        for (place, line) in lines_of(&latex).into_iter().enumerate() {
            rows.push(match place {
                0 => format!("{name}:\\quad & {line}"),
                _ => format!("&\\qquad {line}"),
            });
        }
    }
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        rows.join(" \\\\\n")
    )
}

/// Signs of a line of a page, counted as in LaTeX, where commands are longer than what they print.
const LINE: usize = 120;

/// Signs of an equation that is printed.
const PAGE: usize = 900;

/// A sum broken before signs that stand in no braces or parentheses.
fn lines_of(latex: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut depth = 0_i32;
    for word in latex.split_whitespace() {
        let is_sign = depth == 0 && matches!(word.chars().next(), Some('+' | '-' | '='));
        let last = lines.len() - 1;
        if is_sign && lines[last].len() > LINE {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        if !lines[last].is_empty() {
            lines[last].push(' ');
        }
        lines[last].push_str(word);
        for sign in word.chars() {
            depth += match sign {
                '{' | '(' => 1,
                '}' | ')' => -1,
                _ => 0,
            };
        }
    }
    lines
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
                    let latex = latex_of(functional, own);
                    serde_json::json!({"of": own.of, "equation": text, "latex": latex, "where": own.only_where})
                })
                .collect();
            let shown: Vec<_> = part
                .shown
                .iter()
                .map(|own| {
                    let tree: serde_json::Value =
                        serde_json::from_str(&g.json(own.value)).unwrap_or_default();
                    let equation = format!("{} = 0", g.text(own.value));
                    let latex = latex_shown(functional, own);
                    serde_json::json!({"of": own.of, "equation": equation, "latex": latex, "zero": tree})
                })
                .collect();
            serde_json::json!({"title": part.title, "indexed": indexed, "components": shown})
        })
        .collect();
    let whole = serde_json::json!({"functional": functional.name, "parts": all});
    serde_json::to_string_pretty(&whole).unwrap_or_default() + "\n"
}
