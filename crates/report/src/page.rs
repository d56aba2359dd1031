//! The page as a whole: head, navigation, the order of the sections, footer.

use crate::claims::{self, chip, counts};
use crate::data::Report;
use crate::digest::source_expression;
use crate::html::{fragment, Html};
use crate::payload::{Payload, PlotKind};
use crate::prose::{paragraphs, sentence};
use crate::words::{fill, look_up, Words};
use crate::{equations, motion, source, system, tables};

const STYLE: &str = include_str!("../assets/page.css");
const SCRIPT: &str = concat!(
    "\"use strict\";\n",
    include_str!("../assets/page.js"),
    include_str!("../assets/plot.js"),
    include_str!("../assets/scene.js"),
    include_str!("../assets/animate.js"),
    "start();\n",
);

/// The whole page.
pub(crate) fn page(report: &Report, words: &'static Words) -> String {
    let payload = Payload::new(report, words);
    let mut html = Html::default();
    html.raw("<!DOCTYPE html>\n<html")
        .attribute("lang", words.language)
        .raw(">\n");
    head(&mut html, report);
    html.raw("<body>\n")
        .wrap("<a class=\"skip\" href=\"#main\">", words.skip, "</a>\n");
    navigation(&mut html, report, &payload, words);
    html.raw("<main id=\"main\">\n");
    title(&mut html, report, words);
    animation(&mut html, report, words);
    found(&mut html, report, words);
    motion::comparison(&mut html, report, &payload, words);
    motion::section(&mut html, report, &payload, words);
    equations::sections(&mut html, report, words);
    if system::is_present(report) {
        system::section(&mut html, report, words);
    }
    tables::sections(&mut html, report, &payload, words);
    claims::section(&mut html, report, words);
    motion::figures(&mut html, report, &payload, words);
    if let Some(model) = &report.model {
        source::section(&mut html, model, words);
    }
    footer(&mut html, report, words);
    html.raw("</main>\n<script type=\"application/json\" id=\"data\">")
        .safe(&payload.json())
        .raw("</script>\n<script>")
        .raw(SCRIPT)
        .raw("</script>\n</body>\n</html>\n");
    html.finish()
}

fn head(html: &mut Html, report: &Report) {
    html.raw("<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\"")
        .attribute(
            "content",
            format!(
                "default-src 'none'; style-src {}; script-src {}; img-src data:; base-uri 'none'; form-action 'none'",
                source_expression(STYLE),
                source_expression(SCRIPT)
            ),
        )
        .raw(">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n")
        .raw("<meta name=\"color-scheme\" content=\"light dark\">\n")
        .raw("<meta name=\"generator\"")
        .attribute("content", format!("Chetaev {}", report.reproducibility.version))
        .raw(">\n<link rel=\"icon\" href=\"data:,\">\n")
        .wrap("<title>", &report.title, "</title>\n<style>")
        .raw(STYLE)
        .raw("</style>\n</head>\n");
}

fn navigation(html: &mut Html, report: &Report, payload: &Payload<'_>, words: &Words) {
    html.raw("<nav")
        .attribute("aria-label", words.contents)
        .raw(">\n<div class=\"tools\"><a class=\"home\" href=\"#main\">")
        .text(&report.title)
        .raw("</a><button type=\"button\" id=\"theme\"")
        .attribute("aria-label", words.theme)
        .attribute("title", words.theme)
        .raw("><span aria-hidden=\"true\">◐</span></button></div>\n<ol>\n");
    let mut entry = |present: bool, target: &str, label: &str, level: &'static str| {
        if present {
            html.raw(level)
                .raw("<a")
                .attribute("href", fragment(target))
                .raw(">");
            sentence(html, label);
            html.raw("</a></li>\n");
        }
    };
    let (top, below) = ("<li>", "<li class=\"below\">");
    entry(!report.found.is_empty(), "found", words.found, top);
    if let Some(compared) = &report.comparison {
        entry(true, "comparison", &compared.title, top);
    }
    entry(report.trajectory.is_some(), "motion", words.motion, top);
    let has_portraits = payload.plots(PlotKind::Portrait).next().is_some();
    entry(has_portraits, "portraits", words.portraits, below);
    entry(
        !report.sections.is_empty(),
        "equations",
        words.equations,
        top,
    );
    for (index, section) in report.sections.iter().enumerate() {
        entry(
            true,
            &equations::anchor(section, index),
            &section.title,
            below,
        );
    }
    entry(system::is_present(report), "system", words.system, top);
    for table in &report.tables {
        entry(true, &table.id, &table.title, top);
    }
    entry(!report.claims.is_empty(), "claims", words.claims, top);
    for (prefix, _) in claims::grouped(&report.claims) {
        let title = look_up(words.groups, &prefix).unwrap_or(prefix);
        entry(true, &claims::anchor(prefix), title, below);
    }
    let has_figures = !(report.figures.is_empty() && report.maps.is_empty());
    entry(has_figures, "figures", words.figures, top);
    entry(report.model.is_some(), "model", words.model, top);
    entry(true, "reproduce", words.reproduce, top);
    html.raw("</ol>\n</nav>\n");
}

fn title(html: &mut Html, report: &Report, words: &Words) {
    html.raw("<header>\n")
        .wrap("<h1>", &report.title, "</h1>\n");
    if let Some(subtitle) = &report.subtitle {
        html.wrap("<p class=\"subtitle\">", subtitle, "</p>\n");
    }
    paragraphs(html, &report.description);
    if !report.claims.is_empty() {
        html.raw("<p class=\"summary\"><a href=\"#claims\">")
            .text(fill(words.claim_count, &[&report.claims.len().to_string()]))
            .raw("</a>");
        for (verdict, count) in counts(&report.claims) {
            html.wrap(" <span class=\"count\"><b>", count, "</b> ");
            chip(html, verdict, words);
            html.raw("</span>");
        }
        html.raw("</p>\n");
    }
    if !report.notices.is_empty() {
        html.raw("<aside class=\"notice\"")
            .attribute("aria-label", words.notices)
            .raw(">\n");
        paragraphs(html, &report.notices);
        html.raw("</aside>\n");
    }
    html.raw("</header>\n");
}

/// What was found, subject by subject, each with links to the claims that say more.
fn found(html: &mut Html, report: &Report, words: &Words) {
    if report.found.is_empty() {
        return;
    }
    html.raw("<section id=\"found\" aria-labelledby=\"found-title\">\n")
        .wrap("<h2 id=\"found-title\">", words.found, "</h2>\n")
        .raw("<dl class=\"found\">\n");
    for one in &report.found {
        html.raw("<div><dt>");
        let known = |id: &&String| report.claims.iter().any(|claim| claim.id() == **id);
        match one.claims.iter().find(known) {
            Some(id) => {
                html.raw("<a")
                    .attribute("href", fragment(id))
                    .wrap(">", &one.subject, "</a>")
            }
            None => html.text(&one.subject),
        };
        html.raw("</dt>");
        for said in &one.sentences {
            html.raw("<dd>");
            sentence(html, said);
            html.raw("</dd>");
        }
        html.raw("</div>\n");
    }
    html.raw("</dl>\n</section>\n");
}

fn animation(html: &mut Html, report: &Report, words: &Words) {
    let Some(animation) = report.animation.as_ref().filter(|a| !a.times.is_empty()) else {
        return;
    };
    html.raw("<figure id=\"animation\"")
        .attribute("aria-label", words.animation)
        .raw(">");
    if let Some(description) = &animation.description {
        html.wrap("<figcaption>", description, "</figcaption>");
    }
    html.raw("</figure>\n");
}

fn footer(html: &mut Html, report: &Report, words: &Words) {
    let again = &report.reproducibility;
    html.raw("<footer id=\"reproduce\">\n")
        .wrap("<h2>", words.reproduce, "</h2>\n");
    if let Some(command) = &again.command {
        html.wrap("<pre class=\"command\"><code>", command, "</code></pre>")
            .raw("<button type=\"button\" class=\"copy\"")
            .attribute("data-copy", command)
            .wrap(">", words.copy_command, "</button>\n");
    }
    html.raw("<dl class=\"facts\">\n");
    let mut row = |label: &str, value: &str| {
        html.wrap("<div><dt>", label, "</dt>")
            .wrap("<dd>", value, "</dd></div>\n");
    };
    if !again.version.is_empty() {
        row(words.version, &again.version);
    }
    if let Some(seed) = again.seed {
        row(words.seed, &seed.to_string());
    }
    for fact in &again.details {
        row(&fact.label, &fact.value);
    }
    html.raw("</dl>\n")
        .wrap("<p class=\"colophon\">", words.made_by, "</p>\n</footer>\n");
}
