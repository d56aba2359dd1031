//! Marks as an SVG document, in the colors of the page, light or dark as the reader prefers.

use super::marks::Mark;
use crate::html::escaped;
use crate::scene::Tint;
use std::fmt::Write as _;

/// Names of colors with their light and dark values.
pub(super) const COLORS: [(Tint, &str, &str, &str); 8] = [
    (Tint::Ink, "ink", "#22201c", "#e4e1da"),
    (Tint::Muted, "muted", "#605a50", "#a6a297"),
    (Tint::Blue, "blue", "#1f5f99", "#6cabe6"),
    (Tint::Red, "red", "#b03a2e", "#ee8273"),
    (Tint::Green, "green", "#2f7d43", "#74c088"),
    (Tint::Amber, "amber", "#a86a00", "#e0aa4f"),
    (Tint::Violet, "violet", "#6d4aa0", "#b699e8"),
    (Tint::Teal, "teal", "#157a7d", "#5bc0c0"),
];

fn name(tint: Tint) -> &'static str {
    let found = COLORS.iter().find(|(own, ..)| *own == tint);
    found.map_or("ink", |(_, name, ..)| name)
}

/// The document.
pub(super) fn document(marks: &[Mark], [width, height]: [u32; 2], title: Option<&str>) -> String {
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n"
    );
    if let Some(title) = title {
        let _ = writeln!(text, "<title>{}</title>", escaped(title));
    }
    text.push_str("<style>");
    for (_, name, light, _) in COLORS {
        let _ = write!(text, ".{name}{{color:{light}}}");
    }
    text.push_str("@media(prefers-color-scheme:dark){");
    for (_, name, _, dark) in COLORS {
        let _ = write!(text, ".{name}{{color:{dark}}}");
    }
    text.push_str("}</style>\n<g stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
    for mark in marks {
        one(&mut text, mark);
    }
    text.push_str("</g>\n</svg>\n");
    text
}

fn one(text: &mut String, mark: &Mark) {
    let _ = match mark {
        Mark::Line {
            points,
            close,
            fill,
            width,
            alpha,
            tint,
        } => {
            let mut path = String::new();
            for (place, [x, y]) in points.iter().enumerate() {
                let letter = if place == 0 { 'M' } else { 'L' };
                let _ = write!(path, "{letter}{x:.1} {y:.1}");
            }
            if *close {
                path.push('Z');
            }
            let inside = if *fill > 0.0 {
format!("currentColor\" fill-opacity=\"{fill:.2}")
} else {
"none".into()
};
            writeln!(
                text,
                "<path class=\"{}\" d=\"{path}\" fill=\"{inside}\" stroke=\"currentColor\" stroke-width=\"{width}\" stroke-opacity=\"{alpha:.2}\"/>",
                name(*tint)
            )
        }
        Mark::Disc {
            at: [x, y],
            radius,
            alpha,
            tint,
        } => writeln!(
            text,
            "<circle class=\"{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\" fill=\"currentColor\" fill-opacity=\"{alpha:.2}\"/>",
            name(*tint)
        ),
        Mark::Words {
            at: [x, y],
            text: words,
            tint,
        } => writeln!(
            text,
            "<text class=\"{}\" x=\"{x:.1}\" y=\"{y:.1}\" fill=\"currentColor\" font-family=\"sans-serif\" font-size=\"13\">{}</text>",
            name(*tint),
            escaped(words)
        ),
    };
}
