//! Sentences and names of the data as they are set on the page: numbers as in print, names in
//! code, subscripts below the line.

use crate::html::Html;
use crate::number::{printed_powers, raised};

/// A sentence: `1e-11` becomes 10⁻¹¹, `2^-104` becomes 2⁻¹⁰⁴, and what stands between backticks is
/// set as code.
pub(crate) fn sentence(html: &mut Html, text: &str) {
    let parts: Vec<&str> = text.split('`').collect();
    let is_paired = parts.len() % 2 == 1;
    for (place, part) in parts.iter().enumerate() {
        match (place % 2, is_paired) {
            (1, true) => html.wrap("<code>", part, "</code>"),
            (_, true) => lowered(html, &raised(&printed_powers(part))),
            // A single backtick is an apostrophe or a slip, not a quotation.
            (0, false) => lowered(html, &raised(&printed_powers(part))),
            _ => lowered(html.text("`"), &raised(&printed_powers(part))),
        };
    }
}

/// Words with what `_{…}` holds as a subscript.
fn lowered<'a>(html: &'a mut Html, text: &str) -> &'a mut Html {
    let mut rest = text;
    while let Some((head, (below, after))) = rest
        .split_once("_{")
        .and_then(|(head, tail)| Some((head, tail.split_once('}')?)))
    {
        html.text(head).wrap("<sub>", below, "</sub>");
        rest = after;
    }
    html.text(rest)
}

/// A sentence that stands by itself begins with a capital, unless it begins with a symbol.
pub(crate) fn capitalized(html: &mut Html, text: &str) {
    let first = text.split(' ').next().unwrap_or_default();
    let is_word =
        first.len() > 1 && first != "det" && first.bytes().all(|b| b.is_ascii_lowercase());
    if is_word || first == "a" && text.len() > 1 {
        sentence(html, &(text[..1].to_ascii_uppercase() + &text[1..]));
    } else {
        sentence(html, text);
    }
}

/// One `<p>` for each paragraph of sentences.
pub(crate) fn paragraphs(html: &mut Html, paragraphs: &[String]) {
    for paragraph in paragraphs {
        html.raw("<p>");
        capitalized(html, paragraph);
        html.raw("</p>\n");
    }
}

/// A name such as `λ_{blade}`: a single letter in italics, what `_{…}` holds as a subscript.
pub(crate) fn name(html: &mut Html, text: &str) {
    let mut rest = text;
    while let Some((head, (below, after))) = rest
        .split_once("_{")
        .and_then(|(head, tail)| Some((head, tail.split_once('}')?)))
    {
        letters(html, head);
        html.wrap("<sub>", below, "</sub>");
        rest = after;
    }
    letters(html, rest);
}

fn letters(html: &mut Html, text: &str) {
    if is_letter(text) {
        html.wrap("<i>", text, "</i>");
    } else {
        html.text(text);
    }
}

/// One letter with its accents.
fn is_letter(text: &str) -> bool {
    let mut signs = text.chars();
    signs.next().is_some_and(char::is_alphabetic)
        && signs.all(|c| ('\u{300}'..='\u{36f}').contains(&c))
}

#[cfg(test)]
mod tests {
    use super::{capitalized, name, sentence};
    use crate::html::Html;

    fn set(write: fn(&mut Html, &str), text: &str) -> String {
        let mut html = Html::default();
        write(&mut html, text);
        html.finish()
    }

    #[test]
    fn names_are_set_with_subscripts() {
        assert_eq!(set(name, "λ_{blade}"), "<i>λ</i><sub>blade</sub>");
        assert_eq!(set(name, "φ\u{307}"), "<i>φ\u{307}</i>");
        assert_eq!(set(name, "energy"), "energy");
        assert_eq!(set(name, "a_{<b"), "a_{&lt;b");
    }

    #[test]
    fn a_sentence_begins_with_a_capital() {
        assert_eq!(set(capitalized, "the end"), "The end");
        for text in ["det W", "x' = 1", "∂L/∂t = 0", "", "Done"] {
            assert_eq!(set(capitalized, text), text.replace('\'', "&#39;"));
        }
    }

    #[test]
    fn sentences_are_set_as_in_print() {
        assert_eq!(
            set(
                sentence,
                "drift of `a<1e-3`: 1.07e-10, bound 1e-8, below 2^-105"
            ),
            "drift of <code>a&lt;1e-3</code>: 1.07 × 10⁻¹⁰, bound 10⁻⁸, below 2⁻¹⁰⁵"
        );
        assert_eq!(set(sentence, "a ` b"), "a ` b");
    }
}
