//! Pictures of functions of two variables.

use crate::data::{Map, Tint};
use crate::html::Html;
use crate::number::readable;
use crate::prose::sentence;

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

/// The pictures, in their order.
pub(crate) fn maps(html: &mut Html, all: &[Map]) {
    for map in all {
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
    let own = ((map.vertical.2 - map.vertical.1) / (map.horizontal.2 - map.horizontal.1)).abs();
    let sides = if map.is_unscaled { 0.625 } else { own };
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
    outlines(html, map, height);
    axes(html, map, height);
    html.raw("</svg>\n");
    legend(html, (low, high));
    names(html, map);
    html.raw("</figure>\n");
}

/// Rectangles, one for each run of the same shade in a row.
fn cells(html: &mut Html, map: &Map, (low, high): (f64, f64), tall: f64, height: f64) {
    let wide = WIDTH / map.columns as f64;
    for (r, row) in map.values.chunks(map.columns).enumerate() {
        let shades: Vec<&str> = row.iter().map(|&v| shade(v, low, high)).collect();
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
                .attribute("fill", shades[start])
                .raw("></rect>");
            start += same;
        }
        html.raw("\n");
    }
}

/// Colors of curves, on light and dark shades alike.
fn color(tint: Tint) -> &'static str {
    match tint {
        Tint::Ink => "#22201c",
        Tint::Muted => "#888178",
        Tint::Blue => "#3f86c4",
        Tint::Red => "#d8483a",
        Tint::Green => "#3f9a57",
        Tint::Amber => "#d28a1a",
        Tint::Violet => "#8f6ac4",
        Tint::Teal => "#2b9da0",
    }
}

/// The curves over the picture.
fn outlines(html: &mut Html, map: &Map, height: f64) {
    let part = |value: f64, low: f64, high: f64| (value - low) / (high - low);
    let place = |&(x, y): &(f64, f64)| {
        let right = part(x, map.horizontal.1, map.horizontal.2) * WIDTH;
        let up = part(y, map.vertical.1, map.vertical.2) * height;
        format!("{:.1},{:.1}", MARGIN.0 + right, 4.0 + height - up)
    };
    for own in &map.outlines {
        let points: Vec<String> = own.points.iter().map(place).collect();
        html.raw("<polyline")
            .attribute("points", points.join(" "))
            .attribute("fill", "none")
            .attribute("stroke", color(own.tint))
            .attribute("stroke-width", "2.5")
            .raw("></polyline>\n");
    }
}

/// What the curves are, each name once, and what the cells without a value.
fn names(html: &mut Html, map: &Map) {
    let curves = map.outlines.iter().map(|own| (&own.name, color(own.tint)));
    let absent = map.absent.iter().map(|name| (name, ABSENT));
    let mut known: Vec<(&String, &str)> = Vec::new();
    for (name, color) in absent.chain(curves) {
        if !name.is_empty() && !known.iter().any(|(first, _)| *first == name) {
            known.push((name, color));
        }
    }
    if known.is_empty() {
        return;
    }
    html.raw("<ul class=\"outlines\">");
    for (name, color) in known {
        let is_area = color == ABSENT;
        html.raw("<li><svg")
            .attribute("viewBox", "0 0 26 12")
            .attribute("width", "26")
            .attribute("height", "12")
            .attribute("aria-hidden", "true")
            .raw("><path")
            .attribute("d", "M1 6H25")
            .attribute("stroke", color)
            .attribute("stroke-width", if is_area { "12" } else { "2.5" })
            .raw("></path></svg>");
        sentence(html, name);
        html.raw("</li>");
    }
    html.raw("</ul>\n");
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

/// Where there is no value.
const ABSENT: &str = "#cfe8cf";

fn shade(value: f64, low: f64, high: f64) -> &'static str {
    let last = SHADES.len() - 1;
    if !value.is_finite() {
        return ABSENT;
    }
    if high <= low {
        return SHADES[last / 2];
    }
    let at = (value - low) / (high - low) * SHADES.len() as f64;
    SHADES[(at as usize).min(last)]
}
