//! The model file: its text, with comments, tables, keys, strings and numbers told apart.

use crate::data::ModelSource;
use crate::html::Html;
use crate::words::{fill, Words};

/// The section of the model file.
pub(crate) fn section(html: &mut Html, model: &ModelSource, words: &Words) {
    html.raw("<section id=\"model\" aria-labelledby=\"model-title\">\n")
        .wrap("<h2 id=\"model-title\">", words.model, "</h2>\n")
        .wrap("<p class=\"lead\">", words.model_lead, "</p>\n");
    if !model.overrides.is_empty() {
        html.wrap("<p>", words.overrides, ":");
        for change in &model.overrides {
            html.wrap(" <code>", change, "</code>");
        }
        html.raw("</p>\n");
    }
    for file in &model.files {
        let lines = file.text.lines().count().to_string();
        html.raw("<details class=\"source\"><summary>")
            .wrap("<code>", &file.name, "</code> ")
            .wrap(
                "<small>",
                fill(words.lines, &[&lines]),
                "</small></summary>\n",
            )
            .raw("<button type=\"button\" class=\"copy\"")
            .attribute("data-copy", &file.text)
            .wrap(">", words.copy_file, "</button>\n<pre class=\"listing\">");
        listing(html, &file.text);
        html.raw("</pre></details>\n");
    }
    html.raw("</section>\n");
}

/// What a piece of TOML is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Piece {
    Plain,
    Comment,
    Table,
    Key,
    Text,
    Number,
}

fn listing(html: &mut Html, text: &str) {
    let mut fence = None;
    for line in text.lines() {
        html.raw("<span class=\"line\">");
        for (piece, part) in pieces(line, &mut fence) {
            match piece {
                Piece::Plain => html.text(part),
                Piece::Comment => html.wrap("<span class=\"comment\">", part, "</span>"),
                Piece::Table => html.wrap("<span class=\"table\">", part, "</span>"),
                Piece::Key => html.wrap("<span class=\"key\">", part, "</span>"),
                Piece::Text => html.wrap("<span class=\"string\">", part, "</span>"),
                Piece::Number => html.wrap("<span class=\"digits\">", part, "</span>"),
            };
        }
        html.raw("\n</span>");
    }
}

/// The pieces of one line. `fence` is the delimiter of a string that runs over several lines.
fn pieces<'a>(line: &'a str, fence: &mut Option<&'static str>) -> Vec<(Piece, &'a str)> {
    let mut found = Vec::new();
    let mut rest = line;
    if fence.is_none() {
        let indent = rest.len() - rest.trim_start().len();
        let (space, after) = rest.split_at(indent);
        found.push((Piece::Plain, space));
        rest = after;
        if rest.starts_with('[') && !rest.contains('=') {
            let end = rest.find('#').unwrap_or(rest.len());
            found.push((Piece::Table, &rest[..end]));
            rest = &rest[end..];
        } else if let Some(end) = key_length(rest) {
            found.push((Piece::Key, &rest[..end]));
            rest = &rest[end..];
        }
    }
    while !rest.is_empty() {
        let (piece, length) = next(rest, fence);
        found.push((piece, &rest[..length]));
        rest = &rest[length..];
    }
    found
}

/// Length of the key at the start of `name = value`.
fn key_length(line: &str) -> Option<usize> {
    let end = line.find('=')?;
    let name = &line[..end];
    let is_key = !name.is_empty() && !name.contains(['#', '[', '{', '(', ',']);
    is_key.then_some(end)
}

/// The piece at the start of `rest` and its length.
fn next(rest: &str, fence: &mut Option<&'static str>) -> (Piece, usize) {
    if let Some(delimiter) = *fence {
        let end = rest.find(delimiter).map(|at| at + delimiter.len());
        if end.is_some() {
            *fence = None;
        }
        return (Piece::Text, end.unwrap_or(rest.len()));
    }
    for delimiter in ["\"\"\"", "'''"] {
        if let Some(after) = rest.strip_prefix(delimiter) {
            let end = after.find(delimiter).map(|at| at + 2 * delimiter.len());
            if end.is_none() {
                *fence = Some(delimiter);
            }
            return (Piece::Text, end.unwrap_or(rest.len()));
        }
    }
    match rest.chars().next() {
        Some('#') => (Piece::Comment, rest.len()),
        Some(quote @ ('"' | '\'')) => (Piece::Text, string_length(rest, quote)),
        Some(c) if c.is_ascii_digit() => (Piece::Number, number_length(rest)),
        Some(c) if c.is_alphabetic() => {
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '-'));
            (Piece::Plain, end.unwrap_or(rest.len()))
        }
        Some(c) => (Piece::Plain, c.len_utf8()),
        None => (Piece::Plain, 0),
    }
}

/// Length of the string at the start; an unfinished one takes the line.
fn string_length(rest: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            c if c == quote && !is_escaped => return at + 1,
            '\\' if quote == '"' => is_escaped = !is_escaped,
            _ => is_escaped = false,
        }
    }
    rest.len()
}

fn number_length(rest: &str) -> usize {
    rest.find(|c: char| !(c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '+' | '-')))
        .unwrap_or(rest.len())
}

#[cfg(test)]
mod tests {
    use super::{pieces, Piece};

    fn kinds(line: &str) -> Vec<(Piece, &str)> {
        pieces(line, &mut None)
            .into_iter()
            .filter(|(piece, _)| *piece != Piece::Plain)
            .collect()
    }

    #[test]
    fn a_line_is_told_apart() {
        assert_eq!(
            kinds("a = \"x' # \\\" y\" # note"),
            [
                (Piece::Key, "a "),
                (Piece::Text, "\"x' # \\\" y\""),
                (Piece::Comment, "# note")
            ]
        );
        assert_eq!(kinds("[[draw]]"), [(Piece::Table, "[[draw]]")]);
        assert_eq!(
            kinds("k = [1e-3, 20]"),
            [
                (Piece::Key, "k "),
                (Piece::Number, "1e-3"),
                (Piece::Number, "20")
            ]
        );
    }

    #[test]
    fn a_string_may_run_over_lines() {
        let mut fence = None;
        pieces("a = '''one", &mut fence);
        assert_eq!(fence, Some("'''"));
        let second = pieces("two''' # end", &mut fence);
        assert_eq!(second[0], (Piece::Text, "two'''"));
        assert_eq!(fence, None);
    }

    #[test]
    fn nothing_is_lost_whatever_the_text() {
        for line in [
            "",
            "'",
            "\"\\",
            "= [",
            "θ' = 'x",
            "[a] # b = c",
            "1θ",
            "  \t\"\"\"x\"\"\"y",
        ] {
            let joined: String = pieces(line, &mut None)
                .iter()
                .map(|(_, part)| *part)
                .collect();
            assert_eq!(joined, line);
        }
    }
}
