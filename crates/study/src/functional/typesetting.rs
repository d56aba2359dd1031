//! Names, expressions and stated equations of a functional as formulas.

use super::equations::{document, options};
use chetaev_functionals::functional::{Functional, Role};
use chetaev_functionals::notation::{parse, parse_sides, written, Node};
use chetaev_report::data::Formula;
use chetaev_symbolic::print::{Document, Format};
use chetaev_symbolic::Expr;

/// An expression.
pub(super) fn formula(f: &Functional, e: Expr) -> Formula {
    of_document(&Document::expressions(&f.space.graph, &[e], &options(f)))
}

/// An expression set equal to zero.
pub(super) fn vanishing(f: &Functional, e: Expr) -> Formula {
    of_document(&document(f, e))
}

fn of_document(document: &Document) -> Formula {
    Formula {
        mathml: Some(document.render(Format::Mathml)),
        text: document.render(Format::Text),
        latex: Some(document.render(Format::Latex)),
    }
}

/// An expression in index notation.
pub(super) fn in_indices(f: &Functional, node: &Node) -> Formula {
    Formula {
        mathml: Some(written(node, &f.scope, Format::Mathml)),
        text: written(node, &f.scope, Format::Text),
        latex: Some(written(node, &f.scope, Format::Latex)),
    }
}

/// The name of a field, which may live on a piece of the boundary only: `u`, `P on S_u`.
pub(super) fn field_name(f: &Functional, field: &str) -> Formula {
    let g = &f.space.graph;
    let name = |name: &str| formula(f, g.symbol(name, 0));
    let Some((field, piece)) = field.split_once(" on ") else {
        return name(field);
    };
    let (field, piece) = (name(field), name(piece));
    let inner = |own: &Formula| inside(own.mathml.as_deref().unwrap_or_default()).to_owned();
    let latex = |own: &Formula| own.latex.clone().unwrap_or_default();
    Formula {
        mathml: Some(format!(
            "<math>{}<mtext> on </mtext>{}</math>",
            inner(&field),
            inner(&piece)
        )),
        text: format!("{} on {}", field.text, piece.text),
        latex: Some(format!(
            "{} \\text{{ on }} {}",
            latex(&field),
            latex(&piece)
        )),
    }
}

/// The variation that an equation belongs to, `δu_k`; `None` where it has no short name.
pub(super) fn variation_name(f: &Functional, of: &str) -> Option<Formula> {
    if let Some(name) = of
        .strip_prefix("∂δ")
        .and_then(|own| own.strip_suffix("/∂n"))
    {
        let own = in_indices(f, &parse(name, &f.scope, &mut Vec::new())?);
        let (mathml, latex) = (
            own.mathml.unwrap_or_default(),
            own.latex.unwrap_or_default(),
        );
        return Some(Formula {
            mathml: Some(format!(
                "<math><mfrac><mrow><mo>∂</mo><mi>δ</mi>{}</mrow><mrow><mo>∂</mo><mi>n</mi></mrow></mfrac></math>",
                inside(&mathml)
            )),
            text: of.to_owned(),
            latex: Some(format!("\\partial \\delta {latex}/\\partial n")),
        });
    }
    let name = of.strip_prefix('δ')?;
    let node = parse(name, &f.scope, &mut Vec::new())?;
    let own = in_indices(f, &node);
    Some(Formula {
        mathml: own
            .mathml
            .map(|own| format!("<math><mi>δ</mi>{}</math>", inside(&own))),
        text: of.to_owned(),
        latex: own.latex.map(|own| format!("\\delta {own}")),
    })
}

/// An equation, typeset as it is written.
pub(super) fn as_written(f: &Functional, text: &str) -> Formula {
    let Some((left, right)) = parse_sides(text, &f.scope, &mut Vec::new()) else {
        return Formula {
            text: text.to_owned(),
            ..Formula::default()
        };
    };
    let right = right.unwrap_or_else(|| Node::number(0, left.span));
    let side = |node: &Node, format| written(node, &f.scope, format);
    let (left_mathml, right_mathml) = (side(&left, Format::Mathml), side(&right, Format::Mathml));
    Formula {
        mathml: Some(format!(
            "<math>{}<mo>=</mo>{}</math>",
            inside(&left_mathml),
            inside(&right_mathml)
        )),
        text: text.to_owned(),
        latex: Some(format!(
            "{} = {}",
            side(&left, Format::Latex),
            side(&right, Format::Latex)
        )),
    }
}

/// What stands in a `<math>` element.
fn inside(math: &str) -> &str {
    let start = math.find('>').map_or(0, |at| at + 1);
    let end = math.rfind("</math>").unwrap_or(math.len());
    math.get(start..end).unwrap_or(math)
}

/// Words in which names have their indices below: `S_{u}`; what stands in backticks stays.
pub(super) fn in_print(words: &str) -> String {
    let mut parts = words.split('`').map(str::to_owned).collect::<Vec<_>>();
    for part in parts.iter_mut().step_by(2) {
        let words: Vec<String> = part.split(' ').map(lowered).collect();
        *part = words.join(" ");
    }
    parts.join("`")
}

/// `(u_k,` as `(u_{k},`.
fn lowered(word: &str) -> String {
    let Some((head, tail)) = word
        .split_once('_')
        .filter(|(_, tail)| !tail.starts_with('{'))
    else {
        return word.to_owned();
    };
    let is_name = head.chars().any(char::is_alphabetic);
    let mut end = 0;
    for (at, sign) in tail.char_indices() {
        let is_derivative = sign == ',' && tail[at + 1..].starts_with(char::is_alphanumeric);
        if !sign.is_alphanumeric() && !is_derivative {
            break;
        }
        end = at + sign.len_utf8();
    }
    if is_name && end > 0 && end <= 4 {
        format!("{head}_{{{}}}{}", &tail[..end], lowered(&tail[end..]))
    } else {
        word.to_owned()
    }
}

/// The label of a stated equation with the piece on which it holds, and what it is for the functional.
pub(super) fn caption(e: &chetaev_functionals::functional::Equation) -> String {
    let on = e.on.as_ref().map(|on| format!("on {on}"));
    let title = Some(e.title.clone()).filter(|title| !title.is_empty());
    let place: Vec<String> = title.into_iter().chain(on).collect();
    let role = match e.role {
        Role::Imposed => "imposed before the variation",
        _ => "stated to follow",
    };
    let words = if place.is_empty() {
        role.to_owned()
    } else {
        format!("{}; {role}", place.join(" "))
    };
    in_print(&words)
}

#[cfg(test)]
mod tests {
    use super::in_print;

    #[test]
    fn indices_of_names_stand_below() {
        assert_eq!(in_print("given on S_u; imposed"), "given on S_{u}; imposed");
        assert_eq!(
            in_print("the divergence of t_ik u_k, and"),
            "the divergence of t_{ik} u_{k}, and"
        );
        assert_eq!(in_print("what `s_ij` is"), "what `s_ij` is");
        assert_eq!(in_print("x_1 and u_k,i"), "x_{1} and u_{k,i}");
        assert_eq!(in_print("S_{u}"), "S_{u}");
    }
}
