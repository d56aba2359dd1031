//! The system in words: description, facts, parameters, assumptions, initial state, sources.

use crate::claims;
use crate::data::{Fact, Origin, Parameter, Report};
use crate::equations::inline;
use crate::html::Html;
use crate::number::{printed_powers, raised, readable};
use crate::prose::sentence;
use crate::words::{fill, look_up, Words};

/// The section that introduces the system.
pub(crate) fn section(html: &mut Html, report: &Report, words: &Words) {
    html.raw("<section id=\"system\" aria-labelledby=\"system-title\">\n")
        .wrap("<h2 id=\"system-title\">", words.system, "</h2>\n");
    facts(html, &report.facts, report, words);
    parameters(html, report, words);
    html.raw("<div class=\"columns\">\n");
    initial(html, report, words);
    assumptions(html, report, words);
    html.raw("</div>\n");
    if !report.history.is_empty() {
        html.wrap("<h3>", words.history, "</h3>\n")
            .paragraphs(&report.history);
    }
    sources(html, report, words);
    html.raw("</section>\n");
}

/// Whether the section has anything to say.
pub(crate) fn is_present(report: &Report) -> bool {
    !(report.facts.is_empty()
        && report.parameters.is_empty()
        && report.initial.is_empty()
        && report.assumptions.is_empty()
        && report.history.is_empty()
        && report.sources.is_empty())
}

/// Rows of a table or items of a list; a page with more is no easier to read.
pub(crate) const ROWS: usize = 60;

/// The line that stands for the rows left out.
pub(crate) fn more(
    html: &mut Html,
    count: usize,
    open: &'static str,
    close: &'static str,
    words: &Words,
) {
    if count > ROWS {
        let rest = (count - ROWS).to_string();
        html.wrap(open, fill(words.more_rows, &[&rest]), close);
    }
}

/// Labelled values in a grid.
pub(crate) fn facts(html: &mut Html, facts: &[Fact], report: &Report, words: &Words) {
    if facts.is_empty() {
        return;
    }
    html.raw("<dl class=\"facts\">\n");
    for fact in facts {
        html.wrap("<div><dt>", &fact.label, "");
        if let Some(symbol) = &fact.symbol {
            html.wrap(" <var>", symbol, "</var>");
        }
        html.raw("</dt><dd>");
        sentence(html, &fact.value);
        for (place, formula) in fact.formulas.iter().enumerate() {
            html.raw(if place == 0 { ": " } else { ", " });
            inline(html, formula);
        }
        if let Some(note) = &fact.note {
            html.raw(" <small>");
            sentence(html, note);
            html.raw("</small>");
        }
        if let Some(claim) = &fact.claim {
            html.raw(" <small>");
            claims::reference(html, claim, report, words);
            html.raw("</small>");
        }
        html.raw("</dd></div>\n");
    }
    html.raw("</dl>\n");
}

/// The table of parameters; a column appears where some parameter fills it.
fn parameters(html: &mut Html, report: &Report, words: &Words) {
    let rows = &report.parameters;
    if rows.is_empty() {
        return;
    }
    let has_range = rows.iter().any(|row| row.range.is_some());
    let has_meaning = rows.iter().any(|row| row.description.is_some());
    html.wrap(
        "<h3>",
        words.parameters,
        "</h3>\n<div class=\"scroll\"><table>",
    )
    .wrap("<thead><tr><th>", words.parameter, "</th>")
    .wrap("<th>", words.value, "</th>");
    if has_range {
        html.wrap("<th>", words.range, "</th>");
    }
    if has_meaning {
        html.wrap("<th>", words.meaning, "</th>");
    }
    html.raw("</tr></thead>\n<tbody>\n");
    for row in rows.iter().take(ROWS) {
        html.raw("<tr><td>");
        inline(html, &row.name);
        html.raw("</td><td>");
        parameter_value(html, row);
        html.raw("</td>");
        if has_range {
            html.wrap("<td>", row.range.as_deref().unwrap_or_default(), "</td>");
        }
        if has_meaning {
            let meaning = row.description.as_deref().unwrap_or_default();
            html.wrap("<td>", meaning, "</td>");
        }
        html.raw("</tr>\n");
    }
    more(
        html,
        rows.len(),
        "<tr><td class=\"quiet\" colspan=\"4\">",
        "</td></tr>\n",
        words,
    );
    html.raw("</tbody></table></div>\n");
}

/// The value with its unit, then the expression it is the value of.
fn parameter_value(html: &mut Html, row: &Parameter) {
    let value = row.value.as_deref();
    if value.is_some() || row.stated.is_none() {
        html.text(raised(&printed_powers(value.unwrap_or("—"))));
        unit(html, row.unit.as_deref());
    }
    if let Some(stated) = &row.stated {
        html.raw(if value.is_some() { " = " } else { "" });
        inline(html, stated);
    }
}

fn unit(html: &mut Html, unit: Option<&str>) {
    if let Some(unit) = unit {
        html.wrap(" <span class=\"unit\">", raised(unit), "</span>");
    }
}

fn initial(html: &mut Html, report: &Report, words: &Words) {
    if report.initial.is_empty() {
        return;
    }
    html.wrap(
        "<div><h3>",
        words.initial,
        "</h3>\n<div class=\"scroll\"><table>",
    )
    .wrap("<thead><tr><th>", words.quantity, "</th>")
    .wrap("<th>", words.value, "</th>")
    .wrap("<th>", words.origin, "</th></tr></thead>\n<tbody>\n");
    for row in report.initial.iter().take(ROWS) {
        html.raw("<tr><td>");
        inline(html, &row.name);
        html.raw("</td><td>");
        if let Some(stated) = &row.stated {
            inline(html, stated);
            html.raw(" = ");
        }
        html.text(readable(row.value));
        unit(html, row.unit.as_deref());
        let class = match row.origin {
            Origin::Given => "</td><td>",
            Origin::Default => "</td><td class=\"quiet\">",
            Origin::Projected => "</td><td class=\"projected\">",
        };
        let origin = look_up(&words.origins, &row.origin).unwrap_or_default();
        html.wrap(class, origin, "</td></tr>\n");
    }
    more(
        html,
        report.initial.len(),
        "<tr><td class=\"quiet\" colspan=\"3\">",
        "</td></tr>\n",
        words,
    );
    html.raw("</tbody></table></div></div>\n");
}

fn assumptions(html: &mut Html, report: &Report, words: &Words) {
    if report.assumptions.is_empty() {
        return;
    }
    html.wrap(
        "<div><h3>",
        words.assumptions,
        "</h3>\n<ul class=\"assumptions\">\n",
    );
    for assumption in report.assumptions.iter().take(ROWS) {
        html.raw("<li>");
        inline(html, &assumption.formula);
        if let Some(note) = &assumption.note {
            html.wrap(" <small>", note, "</small>");
        }
        html.raw("</li>\n");
    }
    more(
        html,
        report.assumptions.len(),
        "<li class=\"quiet\">",
        "</li>\n",
        words,
    );
    html.raw("</ul></div>\n");
}

fn sources(html: &mut Html, report: &Report, words: &Words) {
    if report.sources.is_empty() {
        return;
    }
    html.wrap("<h3>", words.sources, "</h3>\n<ul class=\"sources\">\n");
    for source in &report.sources {
        html.wrap("<li>", &source.text, "");
        if let Some(link) = &source.link {
            let is_web = ["https://", "http://"]
                .iter()
                .any(|scheme| link.starts_with(scheme));
            if is_web {
                html.raw(" <a rel=\"noopener noreferrer\"")
                    .attribute("href", link)
                    .wrap(">", link, "</a>");
            } else {
                html.wrap(" <span>", link, "</span>");
            }
        }
        html.raw("</li>\n");
    }
    html.raw("</ul>\n");
}
