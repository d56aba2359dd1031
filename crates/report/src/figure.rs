//! Places for figures: what the script draws into.

use crate::claims;
use crate::data::{Figure, Report};
use crate::html::Html;
use crate::prose::paragraphs;
use crate::words::Words;

/// A figure with its words; the script draws into it.
pub(crate) fn drawn(
    html: &mut Html,
    figure: &Figure,
    index: usize,
    report: &Report,
    words: &Words,
) {
    html.raw("<figure class=\"plot\"")
        .attribute("data-plot", index)
        .wrap("><figcaption><h4>", &figure.title, "</h4>");
    paragraphs(html, &figure.explanation);
    if let Some(claim) = &figure.claim {
        html.wrap("<p>", words.proved_by, ": ");
        claims::reference(html, claim, report, words);
        html.raw("</p>");
    }
    html.raw("</figcaption></figure>\n");
}
