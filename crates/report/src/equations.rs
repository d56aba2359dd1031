//! Formulas, equations and the sections they stand in.

use crate::claims;
use crate::data::{Definition, Equation, EquationSection, Formula, Report};
use crate::html::Html;
use crate::mathml::math;
use crate::prose::{name, paragraphs, sentence};
use crate::system::{more, ROWS};
use crate::words::{fill, Words};

/// A formula within a line of text.
pub(crate) fn inline(html: &mut Html, formula: &Formula) {
    match formula.mathml.as_deref().filter(|m| !m.trim().is_empty()) {
        Some(source) => html.safe(&math(source, false)),
        None => html.wrap("<code>", &formula.text, "</code>"),
    };
}

/// An equation in its own line: label, formula, number and copy button.
pub(crate) fn equation_body(
    html: &mut Html,
    equation: &Equation,
    number: Option<usize>,
    words: &Words,
) {
    html.raw("<span class=\"label\">");
    match (&equation.name, &equation.label) {
        (Some(formula), _) => inline(html, formula),
        (None, Some(label)) => name(html, label),
        (None, None) => {}
    }
    html.raw("</span><div class=\"formula\">");
    let mathml = equation.formula.mathml.as_deref();
    match (&equation.omitted, mathml.filter(|m| !m.trim().is_empty())) {
        (Some(omitted), _) => {
            html.raw("<p class=\"quiet\">");
            sentence(html, omitted);
            html.raw("</p>");
        }
        (None, Some(source)) => {
            html.safe(&math(source, true));
        }
        (None, None) => {
            html.wrap("<pre>", &equation.formula.text, "</pre>");
        }
    }
    html.raw("</div><span class=\"margin\">");
    let shown = number.map(|n| n.to_string()).unwrap_or_default();
    if let Some(latex) = &equation.formula.latex {
        html.raw("<button type=\"button\" class=\"copy\"")
            .attribute("data-copy", latex)
            .attribute("aria-label", fill(words.equation_number, &[&shown]))
            .wrap(">", words.copy_latex, "</button>");
    }
    if number.is_some() {
        html.wrap("<span class=\"number\">(", shown, ")</span>");
    }
    html.raw("</span>");
    if let Some(caption) = &equation.caption {
        html.raw("<p class=\"caption\">");
        sentence(html, caption);
        html.raw("</p>");
    }
}

/// A "where" list.
pub(crate) fn definitions(html: &mut Html, list: &[Definition], words: &Words) {
    if list.is_empty() {
        return;
    }
    html.wrap("<div class=\"where\"><span>", words.where_, "</span><ul>");
    for definition in list {
        html.raw("<li><span class=\"term\">");
        inline(html, &definition.formula);
        html.raw("</span>");
        if let Some(text) = &definition.text {
            html.wrap(" <span>", text, "</span>");
        }
        html.raw("</li>");
    }
    html.raw("</ul></div>\n");
}

/// The anchor of a section.
pub(crate) fn anchor(section: &EquationSection, index: usize) -> String {
    let source = if section.id.is_empty() {
        &section.title
    } else {
        &section.id
    };
    let name: String = source
        .chars()
        .map(|c| match c {
            c if c.is_alphanumeric() || c == '.' => c.to_ascii_lowercase(),
            _ => '-',
        })
        .collect();
    format!("equations-{}-{name}", index + 1)
}

/// All sections of equations, the equations numbered through.
pub(crate) fn sections(html: &mut Html, report: &Report, words: &Words) {
    if report.sections.is_empty() {
        return;
    }
    html.raw("<section id=\"equations\" aria-labelledby=\"equations-title\">\n")
        .wrap("<h2 id=\"equations-title\">", words.equations, "</h2>\n");
    let mut number = 0;
    for (index, section) in report.sections.iter().enumerate() {
        let anchor = anchor(section, index);
        if let Some(exercise) = &section.exercise {
            html.raw("<p class=\"exercise\">");
            sentence(html, exercise);
            html.raw("</p>\n");
        }
        let close = if section.collapsed {
            html.raw("<details class=\"equations\"")
                .attribute("id", anchor)
                .raw("><summary><h3>");
            sentence(html, &section.title);
            html.raw("</h3></summary>\n<template>");
            "</template></details>\n"
        } else {
            html.raw("<div class=\"equations\"")
                .attribute("id", anchor)
                .raw("><h3>");
            sentence(html, &section.title);
            html.raw("</h3>\n");
            "</div>\n"
        };
        body(html, section, &mut number, report, words);
        html.raw(close);
    }
    html.raw("</section>\n");
}

fn body(
    html: &mut Html,
    section: &EquationSection,
    number: &mut usize,
    report: &Report,
    words: &Words,
) {
    let latex = section.equations.iter();
    let latex = latex.filter(|e| e.formula.latex.is_some()).count();
    if section.formulation.is_some() || section.claim.is_some() || latex > 1 {
        html.raw("<p class=\"byline\">");
        if let Some(formulation) = &section.formulation {
            html.wrap("<span>", words.formulation, ": ").wrap(
                "<strong>",
                formulation,
                "</strong></span> ",
            );
        }
        if let Some(claim) = &section.claim {
            html.wrap("<span>", words.proved_by, ": ");
            claims::reference(html, claim, report, words);
            html.raw("</span>");
        }
        if latex > 1 {
            html.wrap(
                "<button type=\"button\" class=\"copy-all\" data-copy-all=\"\">",
                words.copy_all_latex,
                "</button>",
            );
        }
        html.raw("</p>\n");
    }
    paragraphs(html, &section.explanation);
    for equation in section.equations.iter().take(ROWS) {
        if let Some(heading) = &equation.heading {
            html.raw("<h4 class=\"step\">");
            sentence(html, heading);
            html.raw("</h4>\n");
        }
        *number += 1;
        html.raw("<div class=\"equation\"")
            .attribute("id", format!("equation-{number}"))
            .raw(">");
        let shown = (!section.is_unnumbered).then_some(*number);
        equation_body(html, equation, shown, words);
        html.raw("</div>\n");
        definitions(html, &equation.definitions, words);
    }
    more(
        html,
        section.equations.len(),
        "<p class=\"quiet\">",
        "</p>\n",
        words,
    );
    definitions(html, &section.definitions, words);
}
