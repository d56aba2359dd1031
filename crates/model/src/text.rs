//! Strings of the model file that remember where each of their letters stands.

use chetaev_symbolic::syntax::Span;

use crate::source::{Place, SourceId};

/// A piece of text as a person meant it, escapes undone, with the way back to the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// The text itself.
    pub content: String,
    /// The whole value in the file, quotation marks included.
    pub place: Place,
    /// Pairs of a byte of the content and the byte of the file where it comes from, at every break of the sequence.
    map: Vec<(usize, usize)>,
}

impl Text {
    /// The same text with other content of the same length in bytes.
    pub(crate) fn with_content(&self, content: String) -> Text {
        Text {
            content,
            ..self.clone()
        }
    }

    /// A text that stands in its source exactly as it is meant, from byte `start` on.
    pub(crate) fn verbatim(content: impl Into<String>, source: SourceId, start: usize) -> Text {
        let content = content.into();
        let span = Span::new(start, start + content.len());
        Text {
            content,
            place: Place { source, span },
            map: vec![(0, start)],
        }
    }

    /// The text of a TOML string or key: `raw` is the file under `place`, `content` what it means.
    pub(crate) fn of_toml(content: &str, raw: &str, place: Place) -> Text {
        let start = place.span.start;
        let map = match decode(raw) {
            Some((decoded, map)) if decoded == content => map
                .into_iter()
                .map(|(to, from)| (to, from + start))
                .collect(),
            // A form this reader does not know: point at the whole value.
            _ => Vec::new(),
        };
        Text {
            content: content.to_owned(),
            place,
            map,
        }
    }

    /// The place of a part of the content.
    pub fn place_of(&self, span: Span) -> Place {
        if self.map.is_empty() {
            return self.place;
        }
        let (start, mut end) = (self.byte(span.start), self.byte(span.end));
        if span.end > span.start {
            // The end is one past the last letter, not the beginning of the next one, which may stand lines below.
            end = self.byte(span.end - 1) + 1;
        }
        Place {
            source: self.place.source,
            span: Span::new(start, end),
        }
    }

    /// A part of the text as a text of its own, beginning at byte `at` of the content.
    pub(crate) fn part(&self, at: usize, content: impl Into<String>) -> Text {
        let content = content.into();
        let place = self.place_of(Span::new(at, at + content.len()));
        let start = (0, self.byte(at));
        let later = self
            .map
            .iter()
            .filter(|(to, _)| *to > at)
            .map(|(to, from)| (to - at, *from));
        let map = if self.map.is_empty() {
            Vec::new()
        } else {
            std::iter::once(start).chain(later).collect()
        };
        Text {
            content,
            place,
            map,
        }
    }

    fn byte(&self, at: usize) -> usize {
        let after = self.map.partition_point(|(to, _)| *to <= at);
        match after.checked_sub(1).and_then(|before| self.map.get(before)) {
            Some((to, from)) => (from + (at - to)).min(self.place.span.end),
            None => self.place.span.start,
        }
    }
}

type Decoded = (String, Vec<(usize, usize)>);

/// Undoes the quotation of a TOML string or key, with the place of each piece.
fn decode(raw: &str) -> Option<Decoded> {
    for (quote, escapes) in [("\"\"\"", true), ("'''", false)] {
        if let Some(inner) = raw
            .strip_prefix(quote)
            .and_then(|rest| rest.strip_suffix(quote))
        {
            let newline = if inner.starts_with("\r\n") {
                2
            } else {
                usize::from(inner.starts_with('\n'))
            };
            return pieces(&inner[newline..], quote.len() + newline, escapes);
        }
    }
    if let Some(inner) = raw
        .strip_prefix('"')
        .and_then(|rest| rest.strip_suffix('"'))
    {
        return pieces(inner, 1, true);
    }
    if let Some(inner) = raw
        .strip_prefix('\'')
        .and_then(|rest| rest.strip_suffix('\''))
    {
        return pieces(inner, 1, false);
    }
    pieces(raw, 0, false)
}

fn pieces(inner: &str, start: usize, escapes: bool) -> Option<Decoded> {
    let mut content = String::with_capacity(inner.len());
    let mut map = vec![(0, start)];
    let mut at = 0;
    while let Some(sign) = inner[at..].chars().next() {
        if sign == '\r' && inner[at..].starts_with("\r\n") {
            at += 1;
            map.push((content.len(), start + at));
        } else if sign == '\\' && escapes {
            at += escape(&inner[at..], &mut content)?;
            map.push((content.len(), start + at));
        } else {
            content.push(sign);
            at += sign.len_utf8();
        }
    }
    Some((content, map))
}

/// Undoes one escape at the beginning of `rest`; its length.
fn escape(rest: &str, content: &mut String) -> Option<usize> {
    let letter = rest.chars().nth(1)?;
    let simple = match letter {
        'b' => Some('\u{8}'),
        't' => Some('\t'),
        'n' => Some('\n'),
        'f' => Some('\u{c}'),
        'r' => Some('\r'),
        'e' => Some('\u{1b}'),
        '"' => Some('"'),
        '\\' => Some('\\'),
        _ => None,
    };
    if let Some(sign) = simple {
        content.push(sign);
        return Some(2);
    }
    let digits = match letter {
        'x' => 2,
        'u' => 4,
        'U' => 8,
        _ if letter.is_whitespace() => {
            // A backslash at the end of a line joins it with the next one.
            return Some(1 + rest[1..].len() - rest[1..].trim_start().len());
        }
        _ => return None,
    };
    let code = u32::from_str_radix(rest.get(2..2 + digits)?, 16).ok()?;
    content.push(char::from_u32(code)?);
    Some(2 + digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(raw: &str, content: &str, part: &str, expected: &str) {
        let place = Place {
            source: SourceId(0),
            span: Span::new(7, 7 + raw.len()),
        };
        let text = Text::of_toml(content, raw, place);
        let at = content.find(part).unwrap();
        let found = text.place_of(Span::new(at, at + part.len())).span;
        assert_eq!(&raw[found.start - 7..found.end - 7], expected, "{raw}");
    }

    #[test]
    fn parts_are_found_again_in_the_file() {
        check(r#""a + thta""#, "a + thta", "thta", "thta");
        check("'a + thta'", "a + thta", "thta", "thta");
        check(r#""\u03b8 + thta""#, "θ + thta", "thta", "thta");
        check(r#""a\t+ b""#, "a\t+ b", "b", "b");
        check("\"\"\"\na + \\\n   thta\"\"\"", "a + thta", "thta", "thta");
        check("'''\na\n+ thta'''", "a\n+ thta", "thta", "thta");
        check("bare_key", "bare_key", "key", "key");
    }

    #[test]
    fn a_part_at_the_end_of_a_joined_line_stays_on_its_line() {
        check("\"\"\"a \\\n   b\"\"\"", "a b", "a", "a");
    }
}
