//! The computed motion: places for the plots, statistics, integrals and drifts in tables.

use crate::claims;
use crate::data::{Conserved, Report, Series, SeriesGroup, Trajectory};
use crate::equations::inline;
use crate::figure::drawn;
use crate::html::{fragment, Html};
use crate::maps::maps;
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
    conserved(html, trajectory, report, words);
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
    if report.figures.is_empty() && report.maps.is_empty() {
        return;
    }
    html.raw("<section id=\"figures\" aria-labelledby=\"figures-title\">\n")
        .wrap(
            "<details class=\"folded\"><summary><h2 id=\"figures-title\">",
            words.figures,
            "</h2></summary>\n<div class=\"plots\">\n",
        );
    let places = payload.plots(PlotKind::Figure);
    for (figure, (index, _)) in report.figures.iter().zip(places) {
        drawn(html, figure, index, report, words);
    }
    html.raw("</div>\n");
    maps(html, &report.maps);
    html.raw("</details>\n</section>\n");
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

/// What should keep its value, each with its value at the start and its drift.
fn conserved(html: &mut Html, trajectory: &Trajectory, report: &Report, words: &Words) {
    let all = &trajectory.conserved;
    if all.is_empty() {
        return;
    }
    html.wrap(
        "<div><h3 id=\"integrals\">",
        words.conserved,
        "</h3>\n<div class=\"scroll\"><table class=\"conserved\">",
    )
    .wrap(
        "<thead><tr><th></th><th>",
        words.conserved_quantity,
        "</th>",
    )
    .wrap("<th class=\"numeric\">", words.at_start, "</th>")
    .wrap("<th class=\"numeric\">", words.largest_drift, "</th>")
    .wrap(
        "<th class=\"numeric\">",
        words.tolerance,
        "</th><th></th></tr></thead>\n<tbody>\n",
    );
    for own in all.iter().take(ROWS) {
        conserved_row(html, own, (trajectory, report), words);
    }
    more(
        html,
        all.len(),
        "<tr><td class=\"quiet\" colspan=\"6\">",
        "</td></tr>\n",
        words,
    );
    html.raw("</tbody></table></div></div>\n");
}

/// One row: the name, the formula with what it belongs to, the value at the start, and the cells of its drift.
fn conserved_row(
    html: &mut Html,
    own: &Conserved,
    (trajectory, report): (&Trajectory, &Report),
    words: &Words,
) {
    html.raw("<tr><td>");
    match &own.claim {
        Some(claim) => html
            .raw("<a")
            .attribute("href", fragment(claim))
            .wrap(">", &own.name, "</a>"),
        None => html.text(&own.name),
    };
    html.raw("</td><td class=\"formula\"><div>");
    match own.omitted {
        true => {
            html.wrap("<span class=\"quiet\">", words.unprinted, "</span>");
        }
        false => inline(html, &own.formula),
    }
    html.raw("</div>");
    if let Some(origin) = &own.origin {
        html.raw("<small>");
        capitalized(html, origin);
        html.raw("</small>");
    }
    html.wrap("</td><td class=\"numeric\">", readable(own.start), "</td>");
    let named = |series: &&Series| Some(&series.name) == own.drift.as_ref();
    match trajectory.series.iter().find(named) {
        Some(series) => {
            drift_cells(html, series, report, words);
            if own.is_enforced {
                html.wrap("<small>", words.enforced, "</small>");
            }
        }
        None => {
            html.raw("<td></td><td></td><td>");
        }
    }
    html.raw("</td></tr>\n");
}

/// The drifts that stand in no other table.
fn other_drifts(trajectory: &Trajectory) -> Vec<&Series> {
    let shown = |series: &Series| {
        let mut all = trajectory.conserved.iter();
        all.any(|own| own.drift.as_ref() == Some(&series.name))
    };
    let all = trajectory.series.iter();
    all.filter(|series| series.group == SeriesGroup::Drifts && !shown(series))
        .collect()
}

/// The largest drift of each recorded one against its tolerance.
fn drifts(html: &mut Html, trajectory: &Trajectory, report: &Report, words: &Words) {
    let drifts = other_drifts(trajectory);
    if drifts.is_empty() {
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
    for series in drifts.iter().take(ROWS) {
        html.raw("<tr><td>");
        name(html, label(series));
        html.raw("</td>");
        drift_cells(html, series, report, words);
        html.raw("</td></tr>\n");
    }
    more(
        html,
        drifts.len(),
        "<tr><td class=\"quiet\" colspan=\"4\">",
        "</td></tr>\n",
        words,
    );
    html.raw("</tbody></table></div></div>\n");
}

/// How far a quantity went, the bound, and the verdict of the claim about it; the last cell stays open.
fn drift_cells(html: &mut Html, series: &Series, report: &Report, words: &Words) {
    let magnitudes = series
        .values
        .iter()
        .filter(|v| v.is_finite())
        .map(|v| v.abs());
    let largest = magnitudes.fold(0.0, f64::max);
    html.wrap("<td class=\"numeric\">", brief(largest), "</td>")
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
            html.raw("</a>");
        }
        (None, Some(bound)) if largest <= bound => {
            html.wrap("<td class=\"within\">", words.within, "");
        }
        (None, Some(_)) => {
            html.wrap("<td class=\"exceeded\">", words.exceeded, "");
        }
        (None, None) => {
            html.raw("<td>");
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

#[cfg(test)]
mod tests {
    use super::section;
    use crate::data::{Conserved, Formula, Report, Series, SeriesGroup, Trajectory};
    use crate::html::Html;
    use crate::payload::Payload;
    use crate::words::Language;

    fn drift(name: &str) -> Series {
        Series {
            name: format!("drift of {name}"),
            label: Some(name.into()),
            group: SeriesGroup::Drifts,
            values: vec![0.0, 2e-9, 1e-9],
            tolerance: Some(1e-8),
            ..Series::default()
        }
    }

    /// What should keep its value stands in one table, with its formula, its origin, its start and its drift; other drifts in another.
    #[test]
    fn what_is_conserved_stands_in_a_table_of_its_own() {
        let own = |name: &str, is_enforced| Conserved {
            name: name.into(),
            formula: Formula {
                text: "x y' < 3".into(),
                ..Formula::default()
            },
            origin: Some("the symmetry under turns".into()),
            start: 1.25,
            drift: Some(format!("drift of {name}")),
            is_enforced,
            ..Conserved::default()
        };
        let report = Report {
            trajectory: Some(Trajectory {
                times: vec![0.0, 1.0, 2.0],
                series: vec![drift("1"), drift("2"), drift("blade")],
                conserved: vec![own("1", false), own("2", true)],
                ..Trajectory::default()
            }),
            ..Report::default()
        };
        let words = Language::English.words();
        let mut html = Html::default();
        section(&mut html, &report, &Payload::new(&report, words), words);
        let page = html.finish();
        let (_, tables) = page.split_once("id=\"integrals\"").unwrap();
        let heading = format!("<h3>{}", words.drift_table);
        let (integrals, others) = tables.split_once(&heading).unwrap();
        for part in [
            "x y&#39; &lt; 3",
            "The symmetry under turns",
            "1.25",
            "2 × 10⁻⁹",
            "class=\"within\"",
        ] {
            assert_eq!(integrals.matches(part).count(), 2, "{part}: {integrals}");
        }
        assert_eq!(integrals.matches(words.enforced).count(), 1);
        assert_eq!(others.matches("<tr><td>").count(), 1, "{others}");
        assert!(others.contains("<tr><td>blade</td>"));
    }
}
