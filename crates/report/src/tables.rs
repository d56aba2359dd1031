//! Tables with a heading of their own, and pictures of functions of two variables.

use crate::data::{Map, Report, Table};
use crate::equations::inline;
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
            sentence(html, &cell.text);
            for (place, formula) in cell.formulas.iter().enumerate() {
                html.raw(if place == 0 { "" } else { ", " });
                inline(html, formula);
            }
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
/// Room for what is written at the axes, and the size of its signs.
const MARGIN: (f64, f64) = (52.0, 26.0);
const LETTERS: f64 = 14.0;

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
    html.raw("<figure class=\"map\"><figcaption><h4>");
    sentence(html, &map.title);
    html.raw("</h4>");
    for paragraph in &map.explanation {
        html.raw("<small>");
        sentence(html, paragraph);
        html.raw("</small>");
    }
    let range = format!(
        "{} from {} to {} to the right, {} from {} to {} upwards; values from {} (light) to {} (dark)",
        map.horizontal.0, readable(map.horizontal.1), readable(map.horizontal.2),
        map.vertical.0, readable(map.vertical.1), readable(map.vertical.2),
        readable(low), readable(high),
    );
    let size = (WIDTH + MARGIN.0 + 4.0, height + MARGIN.1 + 4.0);
    html.raw("</figcaption>\n<svg")
        .attribute("viewBox", format!("0 0 {} {}", size.0, size.1))
        .attribute("role", "img")
        .attribute("aria-label", format!("{}: {range}", map.title))
        .raw("><g")
        .attribute("transform", format!("translate({} 4)", MARGIN.0))
        .attribute("shape-rendering", "crispEdges")
        .raw(">\n");
    cells(html, map, (low, high), height / rows as f64, height);
    html.raw("</g>\n");
    axes(html, map, height);
    html.raw("</svg>\n");
    legend(html, (low, high));
    html.raw("</figure>\n");
}

/// Rectangles, one for each run of the same shade in a row.
fn cells(html: &mut Html, map: &Map, (low, high): (f64, f64), tall: f64, height: f64) {
    let wide = WIDTH / map.columns as f64;
    for (r, row) in map.values.chunks(map.columns).enumerate() {
        let shades: Vec<usize> = row.iter().map(|&v| shade(v, low, high)).collect();
        let mut start = 0;
        while start < shades.len() {
            let same = shades[start..]
                .iter()
                .take_while(|&&s| s == shades[start])
                .count();
            html.raw("<rect")
                .attribute("x", start as f64 * wide)
                .attribute("y", height - (r + 1) as f64 * tall)
                .attribute("width", same as f64 * wide)
                .attribute("height", tall)
                .attribute("fill", SHADES[shades[start]])
                .raw("></rect>");
            start += same;
        }
        html.raw("\n");
    }
}

/// The names of both variables, and the numbers at their ends.
fn axes(html: &mut Html, map: &Map, height: f64) {
    let (left, below) = (MARGIN.0, height + 4.0 + LETTERS + 3.0);
    let mut write = |text: &str, x: f64, y: f64, anchor: &str| {
        html.raw("<text")
            .attribute("x", x)
            .attribute("y", y)
            .attribute("text-anchor", anchor)
            .attribute("font-size", LETTERS)
            .attribute("fill", "currentColor")
            .wrap(">", text, "</text>");
    };
    write(&readable(map.horizontal.1), left, below, "start");
    write(&map.horizontal.0, left + WIDTH / 2.0, below, "middle");
    write(&readable(map.horizontal.2), left + WIDTH, below, "end");
    write(&readable(map.vertical.1), left - 6.0, height + 4.0, "end");
    write(&map.vertical.0, left - 6.0, 4.0 + height / 2.0, "end");
    write(
        &readable(map.vertical.2),
        left - 6.0,
        4.0 + LETTERS * 0.8,
        "end",
    );
}

/// All shades between the smallest and the largest value.
fn legend(html: &mut Html, (low, high): (f64, f64)) {
    html.wrap("<p class=\"scale\"><span>", readable(low), "</span><svg")
        .attribute("viewBox", format!("0 0 {} 1", SHADES.len()))
        .attribute("width", "180")
        .attribute("height", "14")
        .attribute("preserveAspectRatio", "none")
        .attribute("shape-rendering", "crispEdges")
        .attribute("aria-hidden", "true")
        .raw(">");
    for (place, shade) in SHADES.iter().enumerate() {
        html.raw("<rect")
            .attribute("x", place)
            .attribute("y", 0)
            .attribute("width", 1)
            .attribute("height", 1)
            .attribute("fill", *shade)
            .raw("></rect>");
    }
    html.wrap("</svg><span>", readable(high), "</span></p>\n");
}

fn shade(value: f64, low: f64, high: f64) -> usize {
    let last = SHADES.len() - 1;
    if high <= low || !value.is_finite() {
        return last / 2;
    }
    let at = (value - low) / (high - low) * SHADES.len() as f64;
    (at as usize).min(last)
}
