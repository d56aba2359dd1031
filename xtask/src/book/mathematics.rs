//! Mathematics of the book, `$…$` and `$$…$$`, as MathML.

use pulldown_latex::config::DisplayMode;
use pulldown_latex::{push_mathml, Parser, ParserError, RenderConfig, Storage};
use std::fmt::{Display, Formatter};

/// A text with its formulas typeset, and what could not be.
pub(crate) fn typeset(text: &str) -> (String, Vec<String>) {
    let (mut out, mut problems) = (String::with_capacity(2 * text.len()), Vec::new());
    let mut rest = text;
    let mut is_line_begin = true;
    while let Some(first) = rest.chars().next() {
        let part = match first {
            '`' if is_line_begin && rest.starts_with("```") => fenced(rest),
            '`' => code(rest),
            '\\' => &rest[..rest.char_indices().nth(2).map_or(rest.len(), |(at, _)| at)],
            '$' => match formula(rest) {
                Some((length, source, mode)) => {
                    match mathml(source, mode) {
                        Ok(own) => out.push_str(&own),
                        Err(problem) => problems.push(format!("`{source}`: {problem}")),
                    }
                    rest = &rest[length..];
                    is_line_begin = false;
                    continue;
                }
                None => "$",
            },
            other => &rest[..other.len_utf8()],
        };
        out.push_str(part);
        is_line_begin = part.ends_with('\n') || (is_line_begin && part == " ");
        rest = &rest[part.len()..];
    }
    (out, problems)
}

/// A block of code between lines of three backticks.
fn fenced(text: &str) -> &str {
    let fence: usize = text.bytes().take_while(|byte| *byte == b'`').count();
    let close = format!("\n{}", &text[..fence]);
    match text.find(&close) {
        Some(at) => &text[..at + close.len()],
        None => text,
    }
}

/// Code within a line: as many backticks close it as open it.
fn code(text: &str) -> &str {
    let count = text.bytes().take_while(|byte| *byte == b'`').count();
    let (open, inside) = text.split_at(count);
    let mut from = 0;
    while let Some(at) = inside[from..].find(open) {
        let begin = from + at;
        let run = inside[begin..].bytes().take_while(|b| *b == b'`').count();
        if run == count {
            return &text[..count + begin + count];
        }
        from = begin + run;
    }
    open
}

/// The length of a formula at the beginning of a text, its source and how it is shown; none where the sign is money.
fn formula(text: &str) -> Option<(usize, &str, DisplayMode)> {
    if let Some(inside) = text.strip_prefix("$$") {
        let end = inside.find("$$")?;
        return Some((end + 4, &inside[..end], DisplayMode::Block));
    }
    let inside = text.strip_prefix('$')?;
    let end = inside.find('$')?;
    let source = &inside[..end];
    let is_closed = !source.ends_with([' ', '\\']);
    let is_formula =
        !source.is_empty() && !source.starts_with(' ') && !source.contains("\n\n") && is_closed;
    is_formula.then_some((end + 2, source, DisplayMode::Inline))
}

/// Why a formula has no MathML.
enum NotTypeset {
    /// It is no formula of LaTeX that is read.
    Unread(ParserError),
    /// It could not be written.
    Unwritten(std::io::Error),
}

impl Display for NotTypeset {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        match self {
            NotTypeset::Unread(problem) => f.write_str(&one_line(&problem.to_string())),
            NotTypeset::Unwritten(problem) => problem.fmt(f),
        }
    }
}

/// MathML in one line, as what stands in several would be read as several paragraphs.
fn mathml(source: &str, display_mode: DisplayMode) -> Result<String, NotTypeset> {
    let storage = Storage::new();
    let events: Result<Vec<_>, _> = Parser::new(source, &storage).collect();
    let events = events.map_err(NotTypeset::Unread)?;
    let config = RenderConfig {
        display_mode,
        ..RenderConfig::default()
    };
    let mut out = String::new();
    let events = events.into_iter().map(Ok::<_, std::convert::Infallible>);
    push_mathml(&mut out, events, config).map_err(NotTypeset::Unwritten)?;
    // The library forgets a space between these attributes.
    let out = one_line(&out).replace("\"minsize=", "\" minsize=");
    Ok(unread(&out))
}

/// Signs that Markdown would read inside of the elements, by their numbers.
fn unread(markup: &str) -> String {
    let mut out = String::with_capacity(markup.len());
    let mut is_tag = false;
    for sign in markup.chars() {
        match sign {
            '<' => is_tag = true,
            '>' => is_tag = false,
            _ => {}
        }
        match sign {
            '*' | '_' | '[' | ']' | '|' | '\\' | '`' | '~' | '$' if !is_tag => {
                out.push_str(&format!("&#{};", u32::from(sign)));
            }
            _ => out.push(sign),
        }
    }
    out
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::typeset;

    #[test]
    fn formulas_are_typeset_and_code_is_left() {
        let (text, problems) = typeset(
            "Let $x$ be.\n\n$$y^2 = 1$$\n\n`$a$` and ``b`$c$``\n```\n$d$\n```\n$5 and \\$6",
        );
        assert_eq!(problems, Vec::<String>::new());
        assert_eq!(text.matches("<math").count(), 2, "{text}");
        assert!(text.contains("`$a$`") && text.contains("``b`$c$``") && text.contains("\n$d$\n"));
        assert!(text.ends_with("$5 and \\$6"));
        assert!(
            text.contains("<mi>x</mi>") && text.contains("display=\"block\""),
            "{text}"
        );
    }

    #[test]
    fn markdown_reads_nothing_in_a_formula() {
        let (text, _) = typeset("$a^* [b]_c |d|$");
        assert!(!text.contains(['*', '[', ']', '|']), "{text}");
        let (text, _) = typeset("$\\Bigl( a \\Bigr)$");
        assert!(text.contains(" minsize="), "{text}");
    }

    #[test]
    fn what_is_no_formula_is_said() {
        let (_, problems) = typeset("$\\frac{1$");
        assert_eq!(problems.len(), 1, "{problems:?}");
    }
}
