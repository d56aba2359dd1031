//! The claims: a tally by verdict, then every claim with its evidence.

use std::borrow::Cow;

use crate::data::{Claim, Report, Verdict};
use crate::equations::{definitions, equation_body};
use crate::html::{fragment, Html};
use crate::number::{printed_powers, raised, readable};
use crate::prose::{capitalized, sentence};
use crate::system::ROWS;
use crate::words::{fill, look_up, Words};

/// The section of all claims.
pub(crate) fn section(html: &mut Html, report: &Report, words: &Words) {
    if report.claims.is_empty() {
        return;
    }
    html.raw("<section id=\"claims\" aria-labelledby=\"claims-title\">\n")
        .wrap("<h2 id=\"claims-title\">", words.claims, "</h2>\n")
        .wrap("<p class=\"lead\">", words.claims_lead, "</p>\n");
    tally(html, &report.claims, words);
    for (prefix, claims) in grouped(&report.claims) {
        group(html, prefix, &claims, report, words);
    }
    html.raw("</section>\n");
}

/// The anchor of a group.
pub(crate) fn anchor(prefix: &str) -> String {
    format!("claims-{prefix}")
}

/// A group, closed: its title with the number of each verdict, what its claims share, then the claims.
fn group(html: &mut Html, prefix: &str, claims: &[&Claim], report: &Report, words: &Words) {
    html.raw("<details class=\"claim-group\"")
        .attribute("id", anchor(prefix))
        .raw(">\n<summary><h3>")
        .text(look_up(words.groups, &prefix).unwrap_or(prefix))
        .raw("</h3>");
    for (verdict, count) in counts(claims.iter().copied()) {
        html.wrap(" <span class=\"count\"><b>", count, "</b> ");
        chip(html, verdict, words);
        html.raw("</span>");
    }
    html.raw("</summary>\n");
    if let Some(lead) = look_up(words.leads, &prefix) {
        html.wrap("<p class=\"lead\">", lead, "</p>\n");
    }
    let shared = shared(claims);
    for (detail, count) in &shared {
        html.raw("<p class=\"lead\">");
        let told = detail.trim_end_matches('.');
        sentence(html, &fill(words.shared, &[&count.to_string(), told]));
        html.raw("</p>\n");
    }
    for claim in claims {
        let is_shared = shared.iter().any(|(detail, _)| *detail == claim.detail);
        one(html, claim, is_shared, report, words);
    }
    html.raw("</details>\n");
}

/// Claims of one sentence from which on it is said once for all.
const SHARED: usize = 3;

/// The sentences that several claims share, with their numbers.
fn shared<'a>(claims: &[&'a Claim]) -> Vec<(&'a str, usize)> {
    let mut all: Vec<(&str, usize)> = Vec::new();
    for claim in claims.iter().filter(|claim| !claim.detail.is_empty()) {
        match all.iter_mut().find(|(detail, _)| *detail == claim.detail) {
            Some((_, count)) => *count += 1,
            None => all.push((&claim.detail, 1)),
        }
    }
    all.retain(|(_, count)| *count >= SHARED);
    all
}

/// Claims by the part of the id before the first dot, in the order of first appearance.
pub(crate) fn grouped(claims: &[Claim]) -> Vec<(&str, Vec<&Claim>)> {
    let mut groups: Vec<(&str, Vec<&Claim>)> = Vec::new();
    for claim in claims {
        let prefix = claim.claim.split('.').next().unwrap_or_default();
        match groups.iter_mut().find(|(known, _)| *known == prefix) {
            Some((_, members)) => members.push(claim),
            None => groups.push((prefix, vec![claim])),
        }
    }
    groups
}

/// How many claims have which verdict; with the script, buttons that filter.
fn tally(html: &mut Html, claims: &[Claim], words: &Words) {
    html.raw("<div class=\"tally\" role=\"group\"")
        .attribute("aria-label", words.filter)
        .raw(">\n<button type=\"button\" data-filter=\"\" aria-pressed=\"true\">")
        .text(words.show_all)
        .wrap(" <b>", claims.len(), "</b></button>\n");
    for (verdict, count) in counts(claims) {
        let Some(name) = look_up(&words.verdicts, &verdict) else {
            continue;
        };
        html.raw("<button type=\"button\" aria-pressed=\"false\"")
            .attribute("class", verdict.key())
            .attribute("data-filter", verdict.key())
            .attribute("title", name.meaning)
            .wrap("><i aria-hidden=\"true\">", glyph(verdict), "</i>")
            .text(name.name)
            .wrap(" <b>", count, "</b></button>\n");
    }
    html.raw("<input type=\"search\" id=\"search\"")
        .attribute("placeholder", words.search)
        .attribute("aria-label", words.search)
        .raw(">\n");
    html.wrap(
        "<button type=\"button\" class=\"plain\" id=\"expand-claims\" aria-pressed=\"false\">",
        words.expand,
        "</button>\n</div>\n",
    );
}

/// The verdicts that occur with their numbers, in the order of the legend.
pub(crate) fn counts<'a>(
    claims: impl IntoIterator<Item = &'a Claim> + Clone,
) -> Vec<(Verdict, usize)> {
    Verdict::ALL
        .into_iter()
        .map(|verdict| {
            let all = claims.clone().into_iter();
            let count = all.filter(|c| c.verdict == verdict).count();
            (verdict, count)
        })
        .filter(|(_, count)| *count > 0)
        .collect()
}

/// A sign that tells the verdicts apart without color.
fn glyph(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proved => "✓",
        Verdict::Numerical => "≈",
        Verdict::Refuted => "✗",
        Verdict::Conditional => "◐",
        Verdict::NotApplicable => "–",
        Verdict::Undecided => "?",
    }
}

/// The verdict as a word with its sign.
pub(crate) fn chip(html: &mut Html, verdict: Verdict, words: &Words) {
    let Some(name) = look_up(&words.verdicts, &verdict) else {
        return;
    };
    html.raw("<span")
        .raw(" class=\"chip ")
        .raw(verdict.key())
        .raw("\"")
        .attribute("title", name.meaning)
        .wrap("><i aria-hidden=\"true\">", glyph(verdict), "</i>")
        .wrap("<span>", name.name, "</span></span>");
}

/// A claim's id as a link to its place, with its verdict if it is on the page.
pub(crate) fn reference(html: &mut Html, id: &str, report: &Report, words: &Words) {
    match report.claims.iter().find(|claim| claim.id() == id) {
        Some(claim) => {
            html.raw("<a class=\"claim-reference\"")
                .attribute("href", fragment(id))
                .wrap("><code>", id, "</code></a> ");
            chip(html, claim.verdict, words);
        }
        None => {
            html.wrap("<code>", id, "</code>");
        }
    }
}

/// A claim: its statement in a line, its evidence below it when it is opened. What the script unfolds is no part of the page before.
fn one(html: &mut Html, claim: &Claim, is_shared: bool, report: &Report, words: &Words) {
    let id = claim.id();
    html.raw("<details class=\"claim\"")
        .attribute("id", &id)
        .attribute("data-verdict", claim.verdict.key())
        .raw(">\n<summary>");
    chip(html, claim.verdict, words);
    html.raw("<span class=\"statement\">");
    if let Some(title) = &claim.title {
        html.wrap("<strong>", title, "</strong> ");
    }
    html.wrap("<code class=\"id\">", &id, "</code>");
    if claim
        .expected
        .is_some_and(|expected| expected != claim.verdict)
    {
        html.raw(" <span class=\"unexpected\">")
            .text("!")
            .raw("</span>");
    }
    if !is_shared {
        html.raw("<span class=\"detail\">");
        capitalized(html, &shortened(&claim.detail));
        html.raw("</span>");
    }
    html.raw("</span></summary>\n<template><div class=\"evidence\">\n");
    for equation in claim.formulas.iter().take(ROWS) {
        html.raw("<div class=\"equation\">");
        equation_body(html, equation, None, words);
        html.raw("</div>\n");
        definitions(html, &equation.definitions, words);
    }
    if !claim.lines.is_empty() {
        html.raw("<ul>\n");
        for line in &claim.lines {
            html.raw("<li>");
            capitalized(html, &shortened(line));
            html.raw("</li>\n");
        }
        html.raw("</ul>\n");
    }
    html.raw("<dl>\n");
    evidence(html, claim, report, words);
    html.raw("</dl>\n<p class=\"permalink\"><a")
        .attribute("href", fragment(&id))
        .wrap(
            ">",
            words.link_to_claim,
            "</a></p>\n</div></template>\n</details>\n",
        );
}

/// Signs of one sentence or counterexample; `study.json` has all of them.
const SIGNS: usize = 3_000;

/// The text, or its beginning where nobody would read to its end.
fn shortened(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(SIGNS) {
        Some((end, _)) => format!("{} …", &text[..end]).into(),
        None => text.into(),
    }
}

/// The rows of the evidence that are there.
fn evidence(html: &mut Html, claim: &Claim, report: &Report, words: &Words) {
    let seconds = claim
        .seconds
        .map(|seconds| fill(words.seconds, &[&readable(seconds)]));
    let rows = [
        (words.method, claim.method.clone()),
        (words.computed, claim.computed.clone()),
        (words.on, claim.on.clone()),
        (words.error_bound, claim.error_bound.as_deref().map(raised)),
        (words.samples, claim.samples.map(|n| n.to_string())),
        (words.seed, claim.seed.map(|n| n.to_string())),
        (
            words.residual,
            claim.residual.as_deref().map(printed_powers),
        ),
        (words.expected, expectation(claim, words)),
        (words.time_spent, seconds),
    ];
    for (label, value) in rows {
        if let Some(value) = value {
            html.wrap("<div><dt>", label, "</dt>")
                .wrap("<dd>", value, "</dd></div>\n");
        }
    }
    if let Some(condition) = &claim.condition {
        let label = match claim.verdict {
            Verdict::NotApplicable => words.failing_hypothesis,
            _ => words.condition,
        };
        html.wrap("<div class=\"wide\"><dt>", label, "</dt><dd>");
        if report.claims.iter().any(|other| other.id() == *condition) {
            reference(html, condition, report, words);
        } else {
            html.text(condition);
        }
        html.raw("</dd></div>\n");
    }
    if let Some(counterexample) = &claim.counterexample {
        html.wrap("<div class=\"wide\"><dt>", words.counterexample, "</dt>")
            .wrap(
                "<dd><pre>",
                shortened(counterexample),
                "</pre></dd></div>\n",
            );
    }
    if !claim.requires.is_empty() {
        html.wrap("<div class=\"wide\"><dt>", words.requires, "</dt><dd><ul>");
        for id in &claim.requires {
            html.raw("<li>");
            reference(html, id, report, words);
            html.raw("</li>");
        }
        html.raw("</ul></dd></div>\n");
    }
}

fn expectation(claim: &Claim, words: &Words) -> Option<String> {
    let expected = claim.expected?;
    let template = if expected == claim.verdict {
        words.as_expected
    } else {
        words.not_as_expected
    };
    let name = look_up(&words.verdicts, &expected)?.name;
    Some(fill(template, &[name]))
}
