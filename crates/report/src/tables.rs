//! Tables with a heading of their own, with the figures, maps and moving pictures that belong to them.

use crate::data::{Album, Report, Table};
use crate::equations::inline;
use crate::figure::drawn;
use crate::html::Html;
use crate::maps::maps;
use crate::payload::{Payload, PlotKind};
use crate::prose::{paragraphs, sentence};
use crate::words::Words;

/// One section for each table.
pub(crate) fn sections(html: &mut Html, report: &Report, payload: &Payload<'_>, words: &Words) {
    let mut places = payload.plots(PlotKind::Table).map(|(index, _)| index);
    let mut albums = 0;
    for table in &report.tables {
        section(html, table);
        if !table.figures.is_empty() {
            html.raw("<div class=\"plots\">\n");
            for (figure, index) in table.figures.iter().zip(&mut places) {
                drawn(html, figure, index, report, words);
            }
            html.raw("</div>\n");
        }
        maps(html, &table.maps);
        if let Some(own) = &table.album {
            album(html, own, albums);
            albums += 1;
        }
        html.raw("</section>\n");
    }
}

/// The place of moving pictures; the script draws into it.
fn album(html: &mut Html, own: &Album, index: usize) {
    html.wrap("<h3>", &own.title, "</h3>\n");
    paragraphs(html, &own.explanation);
    html.raw("<figure class=\"album\"")
        .attribute("data-album", index)
        .attribute("data-choice", &own.choice)
        .attribute("aria-label", &own.title)
        .raw("></figure>\n");
}

fn section(html: &mut Html, table: &Table) {
    html.raw("<section")
        .attribute("id", &table.id)
        .wrap(">\n<h2>", &table.title, "</h2>\n");
    paragraphs(html, &table.explanation);
    html.raw("<div class=\"scroll\"><table class=\"levels\">\n<thead><tr>");
    for heading in &table.headings {
        html.wrap("<th>", heading, "</th>");
    }
    html.raw("</tr></thead>\n<tbody>\n");
    for row in &table.rows {
        html.raw(if row.is_marked {
            "<tr class=\"own\" aria-current=\"true\">"
        } else {
            "<tr>"
        });
        for cell in &row.cells {
            html.raw("<td>");
            sentence(html, &cell.text);
            for (place, formula) in cell.formulas.iter().enumerate() {
                html.raw(if place == 0 { "" } else { ", " });
                inline(html, formula);
            }
            html.raw("</td>");
        }
        html.raw("</tr>\n");
    }
    html.raw("</tbody></table></div>\n");
}
