//! The numbers that the script of the page draws, as JSON inside the page.

use std::borrow::Cow;

use serde::Serialize;

use crate::data::{Animation, Report, Series, SeriesGroup, Trajectory};
use crate::html::Safe;
use crate::words::{fill, look_up, Words};

/// What the script gets.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Payload<'a> {
    words: &'a crate::words::ScriptWords,
    #[serde(skip_serializing_if = "Option::is_none")]
    trajectory: Option<Motion<'a>>,
    plots: Vec<Plot<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    animation: Option<&'a Animation>,
    /// Numbers per frame of each element of the animation.
    strides: Vec<usize>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Motion<'a> {
    #[serde(with = "crate::number::vector")]
    times: &'a Vec<f64>,
    time_unit: Option<&'a str>,
    series: Vec<Curve<'a>>,
    #[serde(with = "crate::number::vector")]
    switches: Vec<f64>,
}

/// One drawing; the page has an element for each, found by its position in the list.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Plot<'a> {
    pub(crate) title: Cow<'a, str>,
    pub(crate) kind: PlotKind,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'a str>,
    log: bool,
    log_horizontal: bool,
    marks: bool,
    equal: bool,
    /// Positions in the series of the trajectory; for a portrait, horizontal then vertical.
    series: Vec<usize>,
    /// A figure brings its own abscissae and curves.
    #[serde(skip_serializing_if = "Option::is_none")]
    own: Option<Own<'a>>,
}

#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum PlotKind {
    Time,
    Portrait,
    Figure,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Own<'a> {
    name: &'a str,
    unit: Option<&'a str>,
    #[serde(with = "crate::number::vector")]
    abscissae: &'a Vec<f64>,
    curves: Vec<Curve<'a>>,
}

#[derive(Serialize)]
struct Curve<'a> {
    label: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    description: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(with = "crate::number::vector")]
    values: &'a Vec<f64>,
}

impl<'a> Curve<'a> {
    fn new(series: &'a Series) -> Self {
        Self {
            label: label(series),
            unit: series.unit.as_deref(),
            description: series.description.as_deref(),
            tolerance: series.tolerance,
            values: &series.values,
        }
    }
}

/// How a series is called on the page.
pub(crate) fn label(series: &Series) -> &str {
    series.label.as_deref().unwrap_or(&series.name)
}

impl<'a> Payload<'a> {
    pub(crate) fn new(report: &'a Report, words: &'a Words) -> Self {
        let trajectory = report.trajectory.as_ref();
        let mut plots = Vec::new();
        if let Some(trajectory) = trajectory {
            plots.extend(time_plots(trajectory, words));
            plots.extend(portraits(trajectory, words));
        }
        plots.extend(report.figures.iter().map(figure));
        Self {
            words: &words.script,
            trajectory: trajectory.map(|t| Motion {
                times: &t.times,
                time_unit: t.time_unit.as_deref(),
                series: t.series.iter().map(Curve::new).collect(),
                switches: t.chart_switches.iter().map(|switch| switch.time).collect(),
            }),
            plots,
            strides: report.animation.iter().flat_map(strides).collect(),
            animation: report.animation.as_ref(),
        }
    }

    /// The drawings of one kind with their positions.
    pub(crate) fn plots(&self, kind: PlotKind) -> impl Iterator<Item = (usize, &Plot<'a>)> {
        self.plots
            .iter()
            .enumerate()
            .filter(move |(_, plot)| plot.kind == kind)
    }

    /// The JSON text; `<`, `>` and `&` occur in it only within strings, where they are written as
    /// escapes, so that nothing in it can end the element that holds it.
    pub(crate) fn json(&self) -> Safe {
        let text = serde_json::to_string(self).unwrap_or_else(|_| "{}".to_owned());
        Safe(
            text.replace('<', "\\u003c")
                .replace('>', "\\u003e")
                .replace('&', "\\u0026"),
        )
    }
}

fn strides(animation: &Animation) -> impl Iterator<Item = usize> + '_ {
    animation
        .elements
        .iter()
        .map(|element| element.shape.stride(animation.spatial))
}

/// One plot for each group and unit, in the order of the groups, then of first appearance.
fn time_plots<'a>(trajectory: &'a Trajectory, words: &'a Words) -> Vec<Plot<'a>> {
    let mut plots: Vec<(SeriesGroup, Plot<'a>)> = Vec::new();
    for (index, series) in trajectory.series.iter().enumerate() {
        let unit = series.unit.as_deref();
        let found = plots
            .iter_mut()
            .find(|(group, plot)| *group == series.group && plot.unit == unit);
        match found {
            Some((_, plot)) => plot.series.push(index),
            None => plots.push((
                series.group,
                Plot {
                    title: look_up(&words.series_groups, &series.group)
                        .unwrap_or_default()
                        .into(),
                    kind: PlotKind::Time,
                    unit,
                    log: matches!(series.group, SeriesGroup::Drifts | SeriesGroup::Errors),
                    log_horizontal: false,
                    marks: false,
                    equal: false,
                    series: vec![index],
                    own: None,
                },
            )),
        }
    }
    plots.sort_by_key(|(group, _)| *group);
    plots.into_iter().map(|(_, plot)| plot).collect()
}

/// Portraits whose two series exist.
fn portraits<'a>(trajectory: &'a Trajectory, words: &'a Words) -> Vec<Plot<'a>> {
    let find = |name: &str| trajectory.series.iter().position(|s| s.name == name);
    trajectory
        .portraits
        .iter()
        .filter_map(|portrait| {
            let horizontal = find(&portrait.horizontal)?;
            let vertical = find(&portrait.vertical)?;
            let labels = [vertical, horizontal].map(|i| label(&trajectory.series[i]));
            Some(Plot {
                title: match &portrait.title {
                    Some(title) => title.into(),
                    None => fill(words.portrait, &labels).into(),
                },
                kind: PlotKind::Portrait,
                unit: None,
                log: false,
                log_horizontal: false,
                marks: false,
                equal: portrait.equal,
                series: vec![horizontal, vertical],
                own: None,
            })
        })
        .collect()
}

fn figure(figure: &crate::data::Figure) -> Plot<'_> {
    Plot {
        title: figure.title.as_str().into(),
        kind: PlotKind::Figure,
        unit: figure.series.first().and_then(|s| s.unit.as_deref()),
        log: figure.logarithmic_vertical,
        log_horizontal: figure.logarithmic_horizontal,
        marks: figure.marks,
        equal: false,
        series: (0..figure.series.len()).collect(),
        own: Some(Own {
            name: &figure.horizontal,
            unit: figure.horizontal_unit.as_deref(),
            abscissae: &figure.abscissae,
            curves: figure.series.iter().map(Curve::new).collect(),
        }),
    }
}
