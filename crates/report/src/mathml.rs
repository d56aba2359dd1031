//! Lets presentation MathML through and nothing else.
//!
//! Formulas arrive as MathML text. A printer that forgot to escape a name must not turn into a
//! script on the page, so everything but the elements and attributes listed here (MathML Core,
//! W3C 2025) is shown as text, and elements left open are closed.

use crate::breaking::pieces;
use crate::html::{escaped, Safe};

const ELEMENTS: [&str; 29] = [
    "math",
    "mrow",
    "mi",
    "mn",
    "mo",
    "ms",
    "mtext",
    "mspace",
    "mfrac",
    "msqrt",
    "mroot",
    "msub",
    "msup",
    "msubsup",
    "mover",
    "munder",
    "munderover",
    "mtable",
    "mtr",
    "mtd",
    "mpadded",
    "mphantom",
    "mstyle",
    "merror",
    "mmultiscripts",
    "mprescripts",
    "none",
    "mfenced",
    "menclose",
];

const ATTRIBUTES: [&str; 30] = [
    "accent",
    "accentunder",
    "align",
    "close",
    "columnalign",
    "columnspacing",
    "columnspan",
    "depth",
    "dir",
    "display",
    "displaystyle",
    "fence",
    "form",
    "height",
    "largeop",
    "linethickness",
    "lspace",
    "mathvariant",
    "maxsize",
    "minsize",
    "movablelimits",
    "notation",
    "open",
    "rowspacing",
    "rowspan",
    "rspace",
    "scriptlevel",
    "separator",
    "stretchy",
    "width",
];

/// A `<math>` element, in its own line (`block`) or within text.
///
/// The input is a `<math>` element or its content; the attributes of an outer `<math>` are
/// replaced. A long formula is written in several elements, between which lines may break.
pub(crate) fn math(source: &str, block: bool) -> Safe {
    let mut content = String::with_capacity(source.len());
    filter(source, &mut content);
    let (whole, piece) = if block {
        ("<math display=\"block\">", "<math displaystyle=\"true\">")
    } else {
        ("<math>", "<math>")
    };
    let pieces = pieces(&content);
    let open = if pieces.len() > 1 { piece } else { whole };
    let mut out = String::with_capacity(content.len() + 64);
    for (place, piece) in pieces.iter().enumerate() {
        if place > 0 {
            out.push_str("<wbr>");
        }
        out.push_str(open);
        out.push_str(piece);
        out.push_str("</math>");
    }
    if pieces.is_empty() {
        out.push_str("<math></math>");
    }
    Safe(out)
}

fn filter(source: &str, out: &mut String) {
    let mut open: Vec<&'static str> = Vec::new();
    let mut rest = source;
    while let Some(at) = rest.find('<') {
        text(&rest[..at], out);
        rest = &rest[at..];
        match tag(rest) {
            Some((tag, length)) => {
                rest = &rest[length..];
                write_tag(tag, &mut open, out);
            }
            None => {
                out.push_str("&lt;");
                rest = &rest[1..];
            }
        }
    }
    text(rest, out);
    while let Some(name) = open.pop() {
        close(name, out);
    }
}

fn write_tag(tag: Tag, open: &mut Vec<&'static str>, out: &mut String) {
    // The outer element is written by `math`.
    if tag.name == "math" {
        return;
    }
    match tag.kind {
        Kind::Close => {
            // A closing tag without its partner is dropped.
            if let Some(depth) = open.iter().rposition(|name| *name == tag.name) {
                while open.len() > depth {
                    if let Some(name) = open.pop() {
                        close(name, out);
                    }
                }
            }
        }
        Kind::Open | Kind::Empty => {
            out.push('<');
            out.push_str(tag.name);
            for (name, value) in tag.attributes {
                out.push(' ');
                out.push_str(name);
                out.push_str("=\"");
                text(value, out);
                out.push('"');
            }
            out.push('>');
            if tag.kind == Kind::Empty {
                close(tag.name, out);
            } else {
                open.push(tag.name);
            }
        }
    }
}

fn close(name: &str, out: &mut String) {
    out.push_str("</");
    out.push_str(name);
    out.push('>');
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Open,
    Close,
    Empty,
}

struct Tag<'a> {
    name: &'static str,
    kind: Kind,
    attributes: Vec<(&'static str, &'a str)>,
}

/// The allowed tag at the start of `source` and its length in bytes.
fn tag(source: &str) -> Option<(Tag<'_>, usize)> {
    let body_end = source.find('>')?;
    let mut body = &source[1..body_end];
    let mut kind = Kind::Open;
    if let Some(inner) = body.strip_prefix('/') {
        (body, kind) = (inner, Kind::Close);
    } else if let Some(inner) = body.strip_suffix('/') {
        (body, kind) = (inner, Kind::Empty);
    }
    let name_end = body
        .find(|c: char| c.is_ascii_whitespace())
        .unwrap_or(body.len());
    let name = listed(&ELEMENTS, &body[..name_end])?;
    let attributes = attributes(&body[name_end..])?;
    Some((
        Tag {
            name,
            kind,
            attributes,
        },
        body_end + 1,
    ))
}

/// Allowed attributes; others are dropped, and a list that cannot be read makes no tag.
fn attributes(mut rest: &str) -> Option<Vec<(&'static str, &str)>> {
    let mut found = Vec::new();
    loop {
        rest = rest.trim_start();
        if rest.is_empty() {
            return Some(found);
        }
        let (name, after) = rest.split_once('=')?;
        let after = after.trim_start();
        let quote = after.chars().next().filter(|c| matches!(c, '"' | '\''))?;
        let (value, after) = after[1..].split_once(quote)?;
        if let Some(name) = listed(&ATTRIBUTES, name.trim_end()) {
            found.push((name, value));
        }
        rest = after;
    }
}

fn listed<const N: usize>(list: &[&'static str; N], name: &str) -> Option<&'static str> {
    list.iter().find(|entry| **entry == name).copied()
}

/// Text or an attribute's value; character references stay, whatever else is special is escaped.
fn text(mut source: &str, out: &mut String) {
    while let Some(at) = source.find('&') {
        out.push_str(&escaped(&source[..at]));
        source = &source[at..];
        let length = reference_length(source);
        if length > 0 {
            out.push_str(&source[..length]);
            source = &source[length..];
        } else {
            out.push_str("&amp;");
            source = &source[1..];
        }
    }
    out.push_str(&escaped(source));
}

/// Length of the character reference (`&amp;`, `&#8242;`, `&#x3b1;`) at the start, or 0.
fn reference_length(source: &str) -> usize {
    let Some(end) = source.find(';').filter(|end| (2..=32).contains(end)) else {
        return 0;
    };
    let body = &source[1..end];
    let is_reference = match body.strip_prefix('#') {
        Some(number) => match number.strip_prefix(['x', 'X']) {
            Some(hex) => !hex.is_empty() && hex.bytes().all(|b| b.is_ascii_hexdigit()),
            None => !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()),
        },
        None => body.bytes().all(|b| b.is_ascii_alphanumeric()),
    };
    if is_reference {
        end + 1
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::math;

    #[test]
    fn presentation_mathml_passes_unchanged() {
        let source = "<mfrac><mi>a</mi><mrow><mn>2</mn><mo lspace=\"0em\">&#8290;</mo><msup><mi>b</mi><mo>&prime;</mo></msup></mrow></mfrac>";
        assert_eq!(math(source, false).0, format!("<math>{source}</math>"));
    }

    #[test]
    fn an_outer_math_element_is_replaced() {
        let source = "<math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mi>x</mi></math>";
        assert_eq!(
            math(source, true).0,
            "<math display=\"block\"><mi>x</mi></math>"
        );
    }

    #[test]
    fn anything_else_becomes_text() {
        for attack in [
            "<script>alert(1)</script>",
            "<mi><img src=x onerror=alert(1)></mi>",
            "<annotation-xml encoding=\"text/html\"><b>x</b></annotation-xml>",
            "<!-- <mi>x</mi>",
            "<maction actiontype=\"statusline#http://x\">",
            "<mi",
            "<mi x>",
        ] {
            let out = math(attack, false).0;
            for opened in out.split('<').skip(1) {
                let name = opened.trim_start_matches('/');
                assert!(
                    ["math>", "mi>"].iter().any(|ok| name.starts_with(ok)),
                    "{attack} gave {out}"
                );
            }
        }
    }

    #[test]
    fn attributes_that_act_are_dropped_and_values_stay_inside_their_quotes() {
        let out = math(
            "<mi onclick=\"alert(1)\" href='x' style=\"color:red\" mathvariant='a\"b'>x</mi>",
            false,
        );
        assert_eq!(out.0, "<math><mi mathvariant=\"a&quot;b\">x</mi></math>");
    }

    #[test]
    fn elements_are_balanced() {
        assert_eq!(
            math("<mrow><mi>x</mrow></mfrac></math><mn>2", false).0,
            "<math><mrow><mi>x</mi></mrow><mn>2</mn></math>"
        );
    }
}
