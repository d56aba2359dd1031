//! Writing HTML so that text of a user cannot become markup.
//!
//! Markup enters only as `&'static str`, that is from this crate's source; whatever is computed or
//! comes from a user enters through [`Html::text`] or [`Html::attribute`], which escape it.

use std::fmt::{Display, Write};

/// A page under construction.
#[derive(Default)]
pub(crate) struct Html(String);

impl Html {
    /// Markup written in the source of this crate.
    pub(crate) fn raw(&mut self, markup: &'static str) -> &mut Self {
        self.0.push_str(markup);
        self
    }

    /// Text between tags, or within a quoted attribute.
    pub(crate) fn text(&mut self, text: impl Display) -> &mut Self {
        // Writing to a `String` cannot fail, and a `Display` that does leaves the text shorter.
        let _ = write!(Escaping(&mut self.0), "{text}");
        self
    }

    /// ` name="value"`, the value escaped.
    pub(crate) fn attribute(&mut self, name: &'static str, value: impl Display) -> &mut Self {
        self.raw(" ").raw(name).raw("=\"").text(value).raw("\"")
    }

    /// `<open>text</close>`, for example `("<p class=\"note\">", text, "</p>")`.
    pub(crate) fn wrap(
        &mut self,
        open: &'static str,
        text: impl Display,
        close: &'static str,
    ) -> &mut Self {
        self.raw(open).text(text).raw(close)
    }

    /// One `<p>` for each paragraph.
    pub(crate) fn paragraphs(&mut self, paragraphs: &[String]) -> &mut Self {
        for paragraph in paragraphs {
            self.wrap("<p>", paragraph, "</p>\n");
        }
        self
    }

    /// Markup that another module of this crate has made safe.
    pub(crate) fn safe(&mut self, markup: &Safe) -> &mut Self {
        self.0.push_str(&markup.0);
        self
    }

    pub(crate) fn finish(self) -> String {
        self.0
    }
}

/// Markup known to be harmless: made by the MathML filter or the JSON writer only.
pub(crate) struct Safe(pub(crate) String);

struct Escaping<'a>(&'a mut String);

impl Write for Escaping<'_> {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        for c in text.chars() {
            match c {
                '&' => self.0.push_str("&amp;"),
                '<' => self.0.push_str("&lt;"),
                '>' => self.0.push_str("&gt;"),
                '"' => self.0.push_str("&quot;"),
                '\'' => self.0.push_str("&#39;"),
                // Not allowed in HTML, and a parser would replace it anyway.
                '\0' => self.0.push('\u{fffd}'),
                c => self.0.push(c),
            }
        }
        Ok(())
    }
}

/// Text escaped for use between tags.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let _ = Escaping(&mut out).write_str(text);
    out
}

/// A fragment identifier as it is written in a link (RFC 3986, section 3.5).
pub(crate) fn fragment(id: &str) -> String {
    let mut out = String::with_capacity(id.len() + 1);
    out.push('#');
    for byte in id.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
                out.push(char::from(byte));
            }
            _ => {
                let _ = write!(out, "%{byte:02X}");
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_attributes_cannot_open_a_tag_or_close_a_quote() {
        let mut html = Html::default();
        html.raw("<p")
            .attribute("title", "\" onclick='x'")
            .raw(">")
            .text("<script>&</script>");
        assert_eq!(
            html.finish(),
            "<p title=\"&quot; onclick=&#39;x&#39;\">&lt;script&gt;&amp;&lt;/script&gt;"
        );
    }

    #[test]
    fn fragments_are_percent_encoded() {
        assert_eq!(
            fragment("formulation.equivalent#maggi θ"),
            "#formulation.equivalent%23maggi%20%CE%B8"
        );
    }
}
