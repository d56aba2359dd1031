//! Equations as a whole document of LaTeX: numbered and aligned, with the general forms, the objects, and a table of symbols.

use super::printed::sections;
use crate::derivation::{options_of, Derivation};
use crate::typeset;
use chetaev_mechanics::System;
use chetaev_symbolic::print::{Document, Format};

/// What stands before the first formulation.
pub(crate) const BEGIN: &str = r"\documentclass{article}
\usepackage[T1]{fontenc}
\usepackage{amsmath,amssymb}
\allowdisplaybreaks
\begin{document}
";

/// The document around its sections, with the table of symbols.
pub(super) fn document(system: &System, sections: &str) -> String {
    format!(
        "{BEGIN}\n{}\n{sections}\\end{{document}}\n",
        symbols(system)
    )
}

/// One formulation.
pub(super) fn section(system: &System, derivation: &Derivation) -> String {
    let options = options_of(system, derivation);
    let mut text = format!("\\section*{{{}}}\n", escaped(derivation.card.title));
    for section in sections(system, derivation) {
        text.push_str(&format!("\\paragraph{{{}}}\n", begun(&section.heading)));
        if let Some(schema) = section.schema {
            text.push_str(&format!("General form:\n\\[ {} \\]\n", schema.latex));
        }
        let document = Document::equations(&system.graph, &section.pairs, &options);
        text.push_str(&numbered(document.render(Format::Latex).trim_end()));
    }
    text.push('\n');
    text
}

/// Aligned equations with numbers, where the printer aligns them without.
fn numbered(printed: &str) -> String {
    let inside = printed
        .strip_prefix("\\begin{aligned}\n")
        .and_then(|rest| rest.strip_suffix("\n\\end{aligned}"));
    match inside {
        Some(lines) => format!("\\begin{{align}}\n{lines}\n\\end{{align}}\n"),
        None => format!("\\begin{{equation}}\n{printed}\n\\end{{equation}}\n"),
    }
}

/// Coordinates, quasi-velocities and parameters in the letters of the equations, beside the names of the model.
fn symbols(system: &System) -> String {
    let options = typeset::print_options(system);
    let g = &system.graph;
    let letter = |name: &str| {
        let symbol = g.symbol(name, 0);
        let text = Document::expressions(g, &[symbol], &options).render(Format::Latex);
        text.trim().to_owned()
    };
    let mut text = String::from("\\section*{Symbols}\n\\begin{tabular}{lll}\n");
    let mut rows = |kind: &str, names: &mut dyn Iterator<Item = &str>| {
        for name in names {
            text.push_str(&format!(
                "${}$ & \\texttt{{{}}} & {kind} \\\\\n",
                letter(name),
                escaped(name)
            ));
        }
    };
    rows(
        "coordinate",
        &mut system.coordinates.iter().map(|c| c.name.as_str()),
    );
    rows(
        "quasi-velocity",
        &mut system.quasi_velocities.iter().map(|u| u.name.as_str()),
    );
    rows(
        "parameter",
        &mut system.parameters.iter().map(|p| p.name.as_str()),
    );
    text.push_str("\\end{tabular}\n");
    text
}

/// A heading that begins with a capital.
fn begun(heading: &str) -> String {
    let mut letters = heading.chars();
    let first = letters.next().map(|c| c.to_uppercase().collect::<String>());
    escaped(&(first.unwrap_or_default() + letters.as_str()))
}

/// Words as LaTeX reads them.
pub(crate) fn escaped(words: &str) -> String {
    let mut text = String::new();
    for sign in words.chars() {
        match sign {
            '\\' => text.push_str("\\textbackslash{}"),
            '_' | '%' | '&' | '#' | '$' | '{' | '}' => {
                text.push('\\');
                text.push(sign);
            }
            '^' => text.push_str("\\^{}"),
            '~' => text.push_str("\\~{}"),
            '–' => text.push_str("--"),
            '’' => text.push('\''),
            '″' => text.push_str("$''$"),
            '′' => text.push_str("$'$"),
            sign if sign.is_ascii() => text.push(sign),
            sign => text.push_str(&letter(sign)),
        }
    }
    text
}

/// A sign that is no word: Greek letters and signs of formulas by their commands.
fn letter(sign: char) -> String {
    let command = match sign {
        'λ' => "\\lambda",
        'κ' => "\\kappa",
        'μ' => "\\mu",
        'τ' => "\\tau",
        'θ' => "\\theta",
        'π' => "\\pi",
        'η' => "\\eta",
        'Λ' => "\\Lambda",
        'Θ' => "\\Theta",
        'σ' => "\\sigma",
        'δ' => "\\delta",
        'Σ' => "\\Sigma",
        'Ψ' => "\\Psi",
        'Π' => "\\Pi",
        'Γ' => "\\Gamma",
        '∂' => "\\partial",
        '−' => "-",
        '≥' => "\\ge",
        '≤' => "\\le",
        '≠' => "\\ne",
        '½' => "\\tfrac12",
        '₀' => "{}_0",
        '₁' => "{}_1",
        _ => return sign.to_string(),
    };
    format!("${command}$")
}

#[cfg(test)]
mod tests {
    use super::{escaped, numbered};

    #[test]
    fn equations_are_numbered_and_words_escaped() {
        let aligned = "\\begin{aligned}\na &= b \\\\\nc &= d\n\\end{aligned}";
        assert_eq!(
            numbered(aligned),
            "\\begin{align}\na &= b \\\\\nc &= d\n\\end{align}\n"
        );
        assert_eq!(
            numbered("a = b"),
            "\\begin{equation}\na = b\n\\end{equation}\n"
        );
        assert_eq!(escaped("x_1 & 50% – λ"), "x\\_1 \\& 50\\% -- $\\lambda$");
    }
}
