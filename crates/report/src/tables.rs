//! Tables with a heading of their own, and pictures of functions of two variables.

use crate::data::{Map, Report, Table};
use crate::html::Html;
use crate::number::readable;
use crate::prose::{paragraphs, sentence};

/// One section for each table.
pub(crate) fn sections(html: &mut Html, report: &Report) {
    for table in &report.tables {
        section(html, table);
    }
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
            sentence(html, cell);
            html.raw("</td>");
        }
        html.raw("</tr>\n");
    }
    html.raw("</tbody></table></div>\n</section>\n");
}

/// Shades from the smallest to the largest value; both are written beside the picture.
const SHADES: [&str; 12] = [
    "#fdf6e3", "#f6e3b8", "#edcb8c", "#e2af68", "#d49150", "#c27344", "#ab573f", "#904040",
    "#733041", "#562540", "#3a1b38", "#21122a",
];

/// Width of a picture in its own units; the height follows from the sides of the rectangle.
const WIDTH: f64 = 480.0;

/// The pictures, in the order of the report.
pub(crate) fn maps(html: &mut Html, report: &Report) {
    for map in &report.maps {
        picture(html, map);
    }
}

fn picture(html: &mut Html, map: &Map) {
    let rows = map.values.len() / map.columns.max(1);
    if rows == 0 || map.columns == 0 {
        return;
    }
    let (low, high) = map
        .values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| {
            (l.min(v), h.max(v))
        });
    let sides = ((map.vertical.2 - map.vertical.1) / (map.horizontal.2 - map.horizontal.1)).abs();
    let height = (WIDTH * sides.clamp(0.15, 2.0)).round();
    html.raw("<figure class=\"map\"><figcaption><h4>")
        .text(&map.title)
        .raw("</h4>");
    paragraphs(html, &map.explanation);
    let range = format!(
        "{} from {} to {} to the right, {} from {} to {} upwards; values from {} (light) to {} (dark)",
        map.horizontal.0, readable(map.horizontal.1), readable(map.horizontal.2),
        map.vertical.0, readable(map.vertical.1), readable(map.vertical.2),
        readable(low), readable(high),
    );
    html.wrap("<p>", &range, "</p></figcaption>\n<svg")
        .attribute("viewBox", format!("0 0 {WIDTH} {height}"))
        .attribute("role", "img")
        .attribute("aria-label", format!("{}: {range}", map.title))
        .attribute("shape-rendering", "crispEdges")
        .raw(">\n");
    for (r, row) in map.values.chunks(map.columns).enumerate() {
        let shades: Vec<usize> = row.iter().map(|&v| shade(v, low, high)).collect();
        let mut start = 0;
        while start < shades.len() {
            let same = shades[start..]
                .iter()
                .take_while(|&&s| s == shades[start])
                .count();
            let cell = (WIDTH / map.columns as f64, height / rows as f64);
            html.raw("<rect")
                .attribute("x", start as f64 * cell.0)
                .attribute("y", height - (r + 1) as f64 * cell.1)
                .attribute("width", same as f64 * cell.0)
                .attribute("height", cell.1)
                .attribute("fill", SHADES[shades[start]])
                .raw("></rect>");
            start += same;
        }
        html.raw("\n");
    }
    html.raw("</svg></figure>\n");
}

fn shade(value: f64, low: f64, high: f64) -> usize {
    let last = SHADES.len() - 1;
    if high <= low || !value.is_finite() {
        return last / 2;
    }
    let at = (value - low) / (high - low) * SHADES.len() as f64;
    (at as usize).min(last)
}
