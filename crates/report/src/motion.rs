//! The computed motion: places for the plots, statistics and drifts in tables.

use crate::claims;
use crate::data::{Figure, Report, Series, SeriesGroup, Trajectory};
use crate::html::{fragment, Html};
use crate::number::{brief, readable};
use crate::payload::{label, Payload, PlotKind};
use crate::prose::{capitalized, name, paragraphs, sentence};
use crate::system::{facts, more, ROWS};
use crate::words::{fill, Words};

/// The section of the motion.
pub(crate) fn section(html: &mut Html, report: &Report, payload: &Payload<'_>, words: &Words) {
    let Some(trajectory) = &report.trajectory else {
        return;
    };
    html.raw("<section id=\"motion\" aria-labelledby=\"motion-title\">\n")
        .wrap("<h2 id=\"motion-title\">", words.motion, "</h2>\n");
    stop(html, trajectory, words);
    if payload.plots(PlotKind::Time).next().is_some() {
        html.wrap("<p class=\"hint\">", words.plots_hint, "</p>\n")
            .wrap("<noscript><p>", words.no_script, "</p></noscript>\n");
    }
    plots(html, payload, PlotKind::Time, words);
    if payload.plots(PlotKind::Portrait).next().is_some() {
        html.wrap("<h3 id=\"portraits\">", words.portraits, "</h3>\n");
        plots(html, payload, PlotKind::Portrait, words);
    }
    drifts(html, trajectory, report, words);
    if !trajectory.statistics.is_empty() {
        html.wrap("<div><h3>", words.statistics, "</h3>\n");
        facts(html, &trajectory.statistics, report, words);
        html.raw("</div>\n");
    }
    events(html, trajectory, words);
    switches(html, trajectory, words);
    if !trajectory.files.is_empty() {
        html.wrap("<p>", words.full_data, ":");
        for file in &trajectory.files {
            html.wrap(" <code>", file, "</code>");
        }
        html.raw("</p>\n");
    }
    html.raw("</section>\n");
}

/// The section of the further figures.
pub(crate) fn figures(html: &mut Html, report: &Report, payload: &Payload<'_>, words: &Words) {
    if report.figures.is_empty() {
        return;
    }
    html.raw("<section id=\"figures\" aria-labelledby=\"figures-title\">\n")
        .wrap(
            "<h2 id=\"figures-title\">",
            words.figures,
            "</h2>\n<div class=\"plots\">\n",
        );
    let places = payload.plots(PlotKind::Figure);
    for (figure, (index, _)) in report.figures.iter().zip(places) {
        drawn(html, figure, index, report, words);
    }
    html.raw("</div>\n</section>\n");
}

/// A figure with its words; the script draws into it.
fn drawn(html: &mut Html, figure: &Figure, index: usize, report: &Report, words: &Words) {
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

/// The section of the comparison: the story, what chose the other curve, both paths, the distance.
pub(crate) fn comparison(html: &mut Html, report: &Report, payload: &Payload<'_>, words: &Words) {
    let Some(compared) = &report.comparison else {
        return;
    };
    html.raw("<section id=\"comparison\" aria-labelledby=\"comparison-title\">\n")
        .wrap("<h2 id=\"comparison-title\">", &compared.title, "</h2>\n");
    paragraphs(html, &compared.paragraphs);
    facts(html, &compared.facts, report, words);
    if !compared.claims.is_empty() {
        html.wrap("<p class=\"evidence-line\">", words.proved_by, ":");
        for claim in &compared.claims {
            html.raw(" ");
            claims::reference(html, claim, report, words);
        }
        html.raw("</p>\n");
    }
    html.raw("<div class=\"plots\">\n");
    let path = payload.plots(PlotKind::Portrait).next();
    if let Some((index, plot)) = path.filter(|_| compared.has_path) {
        html.raw("<figure class=\"plot\"")
            .attribute("data-plot", index)
            .raw("><figcaption><h4>");
        name(html, &plot.title);
        html.wrap(
            "</h4><p>",
            words.both_curves,
            "</p></figcaption></figure>\n",
        );
    }
    let places = payload.plots(PlotKind::Comparison);
    for (figure, (index, _)) in compared.figures.iter().zip(places) {
        drawn(html, figure, index, report, words);
    }
    html.raw("</div>\n</section>\n");
}

fn stop(html: &mut Html, trajectory: &Trajectory, words: &Words) {
    let stop = &trajectory.stop;
    match (stop.early, stop.expected) {
        (true, false) => html.wrap(
            "<p class=\"notice\"><strong>",
            words.stopped_early,
            ".</strong> ",
        ),
        (true, true) => html.wrap(
            "<p class=\"stop\"><strong>",
            words.stopped_expected,
            ".</strong> ",
        ),
        (false, _) => html.raw("<p class=\"stop\">"),
    };
    capitalized(html, &stop.reason);
    html.raw("</p>\n");
}

/// A figure for each plot of a kind; the script draws into it.
fn plots(html: &mut Html, payload: &Payload<'_>, kind: PlotKind, words: &Words) {
    let open = match kind {
        PlotKind::Portrait => "<div class=\"plots portraits\">\n",
        _ => "<div class=\"plots\">\n",
    };
    html.raw(open);
    for (index, plot) in payload.plots(kind) {
        html.raw("<figure class=\"plot\"")
            .attribute("data-plot", index)
            .raw("><figcaption><h4>");
        name(html, &plot.title);
        html.raw("</h4>");
        let shown = plot.shown();
        if shown < plot.of {
            let [shown, of] = [shown, plot.of].map(|n| n.to_string());
            html.wrap("<p>", fill(words.some_curves, &[&shown, &of]), "</p>");
        }
        html.raw("</figcaption></figure>\n");
    }
    html.raw("</div>\n");
}

/// The largest drift of each recorded one against its tolerance.
fn drifts(html: &mut Html, trajectory: &Trajectory, report: &Report, words: &Words) {
    let mut drifts = trajectory
        .series
        .iter()
        .filter(|series| series.group == SeriesGroup::Drifts)
        .peekable();
    if drifts.peek().is_none() {
        return;
    }
    html.wrap(
        "<div><h3>",
        words.drift_table,
        "</h3>\n<div class=\"scroll\"><table>",
    )
    .wrap("<thead><tr><th>", words.quantity, "</th>")
    .wrap("<th class=\"numeric\">", words.largest, "</th>")
    .wrap(
        "<th class=\"numeric\">",
        words.tolerance,
        "</th><th></th></tr></thead>\n<tbody>\n",
    );
    let count = trajectory
        .series
        .iter()
        .filter(|series| series.group == SeriesGroup::Drifts)
        .count();
    for series in drifts.take(ROWS) {
        drift(html, series, report, words);
    }
    more(
        html,
        count,
        "<tr><td class=\"quiet\" colspan=\"4\">",
        "</td></tr>\n",
        words,
    );
    html.raw("</tbody></table></div></div>\n");
}

/// One row: how far a quantity went, the bound, and the verdict of the claim about it.
fn drift(html: &mut Html, series: &Series, report: &Report, words: &Words) {
    let magnitudes = series
        .values
        .iter()
        .filter(|v| v.is_finite())
        .map(|v| v.abs());
    let largest = magnitudes.fold(0.0, f64::max);
    html.raw("<tr><td>");
    name(html, label(series));
    html.wrap("</td><td class=\"numeric\">", brief(largest), "</td>")
        .raw("<td class=\"numeric\">");
    if let Some(bound) = series.tolerance {
        html.text(brief(bound));
    }
    html.raw("</td>");
    let decided = series
        .claim
        .as_ref()
        .and_then(|id| report.claims.iter().find(|claim| claim.id() == *id));
    match (decided, series.tolerance) {
        (Some(claim), _) => {
            html.raw("<td><a class=\"verdict\"")
                .attribute("href", fragment(&claim.id()))
                .raw(">");
            claims::chip(html, claim.verdict, words);
            html.raw("</a></td></tr>\n");
        }
        (None, Some(bound)) if largest <= bound => {
            html.wrap("<td class=\"within\">", words.within, "</td></tr>\n");
        }
        (None, Some(_)) => {
            html.wrap("<td class=\"exceeded\">", words.exceeded, "</td></tr>\n");
        }
        (None, None) => {
            html.raw("<td></td></tr>\n");
        }
    }
}

fn events(html: &mut Html, trajectory: &Trajectory, words: &Words) {
    let met = trajectory.events.iter();
    let listed = met.map(|event| (event.time, &event.detail));
    dated(html, trajectory, (words.events, listed.collect()), words);
}

fn switches(html: &mut Html, trajectory: &Trajectory, words: &Words) {
    let switches = trajectory.chart_switches.iter();
    let listed = switches.map(|switch| (switch.time, &switch.detail));
    dated(
        html,
        trajectory,
        (words.chart_switches, listed.collect()),
        words,
    );
}

/// Sentences with their times, under a heading.
fn dated(
    html: &mut Html,
    trajectory: &Trajectory,
    (heading, listed): (&'static str, Vec<(f64, &String)>),
    words: &Words,
) {
    if listed.is_empty() {
        return;
    }
    html.wrap("<h3>", heading, "</h3>\n<ol class=\"switches\">\n");
    for (time, detail) in listed.iter().take(ROWS) {
        html.wrap("<li><span class=\"when\">t = ", readable(*time), "");
        if let Some(unit) = &trajectory.time_unit {
            html.wrap(" ", unit, "");
        }
        html.raw("</span> ");
        sentence(html, detail);
        html.raw("</li>\n");
    }
    more(html, listed.len(), "<li class=\"quiet\">", "</li>\n", words);
    html.raw("</ol>\n");
}
