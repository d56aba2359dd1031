//! Equations as a whole document of LaTeX: numbered and aligned, with the general forms, the objects, and a table of symbols.

use super::printed::sections;
use crate::derivation::{options_of, Derivation};
use crate::typeset;
use chetaev_mechanics::System;
use chetaev_symbolic::print::{Document, Format, Options};
use chetaev_symbolic::Expr;

/// What stands before the first formulation.
pub(crate) const BEGIN: &str = r"\documentclass{article}
\usepackage[T1]{fontenc}
\IfFileExists{lmodern.sty}{\usepackage{lmodern}}{}
\usepackage[a4paper,margin=25mm]{geometry}
\usepackage{amsmath,amssymb,longtable}
\allowdisplaybreaks
\begin{document}
";

/// The document around its sections, with the table of symbols.
pub(crate) fn document(system: &System, sections: &str) -> String {
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
        text.push_str(&document.latex_display());
    }
    text.push('\n');
    text
}

/// Definitions of quasi-velocities, and of parameters by others; then a table of all symbols.
fn symbols(system: &System) -> String {
    let options = typeset::print_options(system);
    let g = &system.graph;
    let quasi_velocities = system.quasi_velocities.iter();
    let defined: Vec<(Expr, Expr)> = quasi_velocities
        .map(|u| (g.symbol(&u.name, 0), u.definition))
        .chain(system.definitions.iter().copied())
        .collect();
    let mut text = String::new();
    if !defined.is_empty() {
        let document = Document::equations(g, &defined, &options);
        let equations = document.latex_display();
        text.push_str(&format!("\\section*{{Definitions}}\n{equations}\n"));
    }
    text.push_str("\\section*{Symbols}\n\\begin{longtable}{llp{0.5\\textwidth}l}\n");
    let coordinates = system.coordinates.iter().map(|c| ("coordinate", &c.name));
    let quasi_velocities = (system.quasi_velocities.iter()).map(|u| ("quasi-velocity", &u.name));
    let controls = (system.controls.iter()).map(|u| ("control", &u.name));
    let masses = (system.masses.iter()).map(|m| ("mass that varies", &m.name));
    let parameters = (system.parameters.iter()).map(|p| ("parameter", &p.name));
    let multipliers: Vec<String> = (system.constraints.iter())
        .map(|c| format!("lambda_{}", c.name))
        .collect();
    let multipliers = multipliers.iter().map(|name| ("multiplier", name));
    let named = coordinates.chain(quasi_velocities).chain(controls);
    for (kind, name) in named.chain(masses).chain(parameters).chain(multipliers) {
        text.push_str(&row(system, &options, kind, name));
    }
    text.push_str("\\end{longtable}\n");
    text
}

/// A line of the table: the symbol, its name in the model, what it is, its unit.
fn row(system: &System, options: &Options, kind: &str, name: &str) -> String {
    let symbol = system.graph.symbol(name, 0);
    let letter = Document::expressions(&system.graph, &[symbol], options).render(Format::Latex);
    let note = system.notes.get(name).cloned().unwrap_or_default();
    let meaning = match note.description.as_str() {
        "" => kind.to_owned(),
        description => format!("{kind}: {description}"),
    };
    format!(
        "${}$ & \\texttt{{{}}} & {} & {} \\\\\n",
        letter.trim(),
        escaped(name),
        escaped(&meaning),
        unit(&note.unit)
    )
}

/// A unit as it is typeset, upright, with its powers.
fn unit(text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let mut typeset = String::new();
    let mut signs = text.chars().peekable();
    while let Some(sign) = signs.next() {
        match sign {
            ' ' => typeset.push_str("\\,"),
            '^' => {
                let is_power = |sign: &char| sign.is_ascii_digit() || *sign == '-';
                let power: String = std::iter::from_fn(|| signs.next_if(is_power)).collect();
                typeset.push_str(&format!("^{{{power}}}"));
            }
            sign => typeset.push_str(&escaped(&sign.to_string()).replace('$', "")),
        }
    }
    format!("$\\mathrm{{{typeset}}}$")
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
        '²' => "{}^2",
        '³' => "{}^3",
        '·' => "\\cdot",
        '°' => "{}^\\circ",
        '×' => "\\times",
        'φ' => "\\varphi",
        'ω' => "\\omega",
        '→' => "\\to",
        '∈' => "\\in",
        '∞' => "\\infty",
        '₀' => "{}_0",
        '₁' => "{}_1",
        _ => return sign.to_string(),
    };
    format!("${command}$")
}

#[cfg(test)]
mod tests {
    use super::{escaped, unit};

    #[test]
    fn words_are_escaped() {
        assert_eq!(escaped("x_1 & 50% – λ"), "x\\_1 \\& 50\\% -- $\\lambda$");
        assert_eq!(unit("kg m^2/s^2"), "$\\mathrm{kg\\,m^{2}/s^{2}}$");
    }
}
