//! The numbers that the script of the page draws, as JSON inside the page.

use std::borrow::Cow;

use serde::Serialize;

use crate::data::{Album, Animation, Report, Series, SeriesGroup, Shape, Tint, Trajectory};
use crate::html::Safe;
use crate::thinning::{even, pick, rows};
use crate::words::{fill, look_up, Words};

/// A drawing with more curves than these cannot be read.
const CURVES: usize = 16;
/// Moments marked in each drawing.
const MARKS: usize = 256;
/// Samples of one curve, or frames of the animation.
const SAMPLES: usize = 1_500;
/// Numbers in all curves, and as many in the animation: about a megabyte each.
const NUMBERS: usize = 100_000;
/// A motion of fewer frames is not seen.
const FRAMES: usize = 40;
/// Drawn elements of the animation.
const ELEMENTS: usize = 300;

/// What the script gets.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Payload<'a> {
    words: &'a crate::words::ScriptWords,
    #[serde(skip_serializing_if = "Option::is_none")]
    trajectory: Option<Motion<'a>>,
    plots: Vec<Plot<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    animation: Option<Frames<'a>>,
    /// Numbers per frame of each element of the animation.
    strides: Vec<usize>,
    /// The moving pictures of each album.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    albums: Vec<Vec<Pictured<'a>>>,
}

/// A moving picture of an album.
#[derive(Serialize)]
struct Pictured<'a> {
    name: &'a str,
    explanation: &'a str,
    animation: Frames<'a>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Motion<'a> {
    #[serde(serialize_with = "crate::number::rounded::fine")]
    times: Vec<f64>,
    time_unit: Option<&'a str>,
    series: Vec<Curve<'a>>,
    #[serde(serialize_with = "crate::number::rounded::fine")]
    switches: Vec<f64>,
    events: Vec<Dated<'a>>,
}

/// A moment with what happened then.
#[derive(Serialize)]
struct Dated<'a> {
    time: f64,
    detail: &'a str,
}

/// The moving picture with the frames that are shown.
#[derive(Serialize)]
struct Frames<'a> {
    spatial: bool,
    #[serde(serialize_with = "crate::number::rounded::fine")]
    times: Vec<f64>,
    elements: Vec<Drawn<'a>>,
    /// Numbers per frame of each element, in an album.
    #[serde(skip_serializing_if = "Option::is_none")]
    strides: Option<Vec<usize>>,
    bounds: &'a Option<Vec<[f64; 2]>>,
    ground: bool,
    camera: &'a Option<[f64; 2]>,
    unit: Option<&'a str>,
    description: Option<&'a str>,
}

#[derive(Serialize)]
struct Drawn<'a> {
    name: &'a str,
    shape: &'a Shape,
    tint: Tint,
    #[serde(serialize_with = "crate::number::rounded::coarse")]
    values: Vec<f64>,
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
    /// Positions in the list of curves; for a portrait, horizontal then vertical, and the same of a curve beside it.
    series: Vec<usize>,
    /// How many curves the group has; only the first are drawn.
    #[serde(skip)]
    pub(crate) of: usize,
    /// A portrait of a long record has its own samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<Path>,
    /// A figure brings its own abscissae and curves.
    #[serde(skip_serializing_if = "Option::is_none")]
    own: Option<Own<'a>>,
}

impl Plot<'_> {
    /// How many curves are drawn.
    pub(crate) fn shown(&self) -> usize {
        self.series.len()
    }
}

#[derive(Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum PlotKind {
    Time,
    Portrait,
    Figure,
    /// A figure of the comparison.
    Comparison,
    /// A figure under a table.
    Table,
}

/// Samples of a portrait.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Path {
    #[serde(serialize_with = "crate::number::rounded::fine")]
    times: Vec<f64>,
    #[serde(serialize_with = "crate::number::rounded::fine")]
    x: Vec<f64>,
    #[serde(serialize_with = "crate::number::rounded::fine")]
    y: Vec<f64>,
    /// Those of the curve beside it; empty where there is none.
    #[serde(serialize_with = "crate::number::rounded::fine")]
    beside_x: Vec<f64>,
    #[serde(serialize_with = "crate::number::rounded::fine")]
    beside_y: Vec<f64>,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Own<'a> {
    name: &'a str,
    unit: Option<&'a str>,
    #[serde(with = "crate::number::vector")]
    abscissae: &'a Vec<f64>,
    curves: Vec<Curve<'a>>,
    /// The axes of a plane, where the curves are drawn in one.
    #[serde(skip_serializing_if = "Option::is_none")]
    plane: Option<[&'a str; 2]>,
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
    /// Times of the values where they are not those of the trajectory.
    #[serde(skip_serializing_if = "Option::is_none")]
    times: Option<Times>,
    #[serde(serialize_with = "crate::number::rounded::fine")]
    values: Vec<f64>,
}

#[derive(Serialize)]
#[serde(transparent)]
struct Times(#[serde(serialize_with = "crate::number::rounded::fine")] Vec<f64>);

impl<'a> Curve<'a> {
    fn new(series: &'a Series) -> Self {
        Self {
            label: label(series),
            unit: series.unit.as_deref(),
            description: series.description.as_deref(),
            tolerance: series.tolerance,
            times: None,
            values: series.values.clone(),
        }
    }

    /// With the samples that a drawing can show.
    fn thinned(series: &'a Series, times: &[f64], limit: usize) -> Self {
        let whole = Self::new(series);
        match rows(&[&series.values], limit) {
            None => whole,
            Some(kept) => Self {
                times: Some(Times(pick(times, &kept))),
                values: pick(&series.values, &kept),
                ..whole
            },
        }
    }
}

/// How a series is called on the page.
pub(crate) fn label(series: &Series) -> &str {
    series.label.as_deref().unwrap_or(&series.name)
}

impl<'a> Payload<'a> {
    pub(crate) fn new(report: &'a Report, words: &'a Words) -> Self {
        let mut plots = Vec::new();
        let mut motion = None;
        if let Some(trajectory) = report.trajectory.as_ref() {
            plots.extend(time_plots(trajectory, words));
            plots.extend(portraits(trajectory, words));
            motion = Some(drawn_motion(trajectory, &mut plots));
        }
        plots.extend(report.figures.iter().map(|f| figure(f, PlotKind::Figure)));
        let compared = report.comparison.iter().flat_map(|c| &c.figures);
        plots.extend(compared.map(|f| figure(f, PlotKind::Comparison)));
        let of_tables = report.tables.iter().flat_map(|table| &table.figures);
        plots.extend(of_tables.map(|f| figure(f, PlotKind::Table)));
        let albums = report
            .tables
            .iter()
            .filter_map(|table| table.album.as_ref());
        let (animation, strides) = report
            .animation
            .as_ref()
            .map(|animation| frames(animation, NUMBERS))
            .map_or((None, Vec::new()), |(f, s)| (Some(f), s));
        Self {
            words: &words.script,
            trajectory: motion,
            plots,
            strides,
            animation,
            albums: albums.map(pictured).collect(),
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

/// The curves that some plot shows, in the order of the trajectory, thinned; the plots then name them by their place in
/// this list.
fn drawn_motion<'a>(trajectory: &'a Trajectory, plots: &mut [Plot<'a>]) -> Motion<'a> {
    let mut used: Vec<usize> = plots.iter().flat_map(|plot| plot.series.clone()).collect();
    used.sort_unstable();
    used.dedup();
    let limit = (NUMBERS / used.len().max(1)).clamp(100, SAMPLES);
    let times = &trajectory.times;
    for plot in plots.iter_mut() {
        if plot.kind == PlotKind::Portrait {
            let values = |i: usize| trajectory.series[i].values.as_slice();
            let curves: Vec<&[f64]> = plot.series.iter().map(|&i| values(i)).collect();
            plot.path = rows(&curves, limit).map(|kept| {
                let at = |k: usize| curves.get(k).map_or(Vec::new(), |c| pick(c, &kept));
                Path {
                    times: pick(times, &kept),
                    x: at(0),
                    y: at(1),
                    beside_x: at(2),
                    beside_y: at(3),
                }
            });
        }
        for place in &mut plot.series {
            *place = used.partition_point(|known| known < place);
        }
    }
    Motion {
        times: pick(times, &even(times.len(), limit)),
        time_unit: trajectory.time_unit.as_deref(),
        series: used
            .iter()
            .map(|&i| Curve::thinned(&trajectory.series[i], times, limit))
            .collect(),
        switches: trajectory
            .chart_switches
            .iter()
            .map(|switch| switch.time)
            .take(MARKS)
            .collect(),
        events: (trajectory.events.iter())
            .filter(|event| event.time.is_finite())
            .map(|event| Dated {
                time: event.time,
                detail: &event.detail,
            })
            .take(MARKS)
            .collect(),
    }
}

/// The pictures of an album, which have together as many numbers as the animation may have.
fn pictured(album: &Album) -> Vec<Pictured<'_>> {
    let own = NUMBERS / album.pictures.len().max(1);
    let shown = album.pictures.iter().map(|picture| {
        let (frames, strides) = frames(&picture.animation, own);
        Pictured {
            name: &picture.name,
            explanation: &picture.explanation,
            animation: Frames {
                strides: Some(strides),
                ..frames
            },
        }
    });
    shown.collect()
}

/// The frames that are shown, with about so many numbers, and the numbers that each element has in one of them.
fn frames(animation: &Animation, numbers: usize) -> (Frames<'_>, Vec<usize>) {
    let mut total = 0;
    let drawn: Vec<_> = animation
        .elements
        .iter()
        .take(ELEMENTS)
        .map(|element| (element, element.shape.stride(animation.spatial)))
        .take_while(|(_, stride)| {
            total += stride;
            total <= NUMBERS / 40
        })
        .collect();
    let width: usize = drawn.iter().map(|(_, stride)| stride).sum();
    let limit = (numbers / width.max(1)).clamp(FRAMES, SAMPLES);
    let kept = even(animation.times.len(), limit);
    let elements = drawn.iter().map(|(element, stride)| Drawn {
        name: &element.name,
        shape: &element.shape,
        tint: element.tint,
        values: kept
            .iter()
            .flat_map(|frame| {
                let numbers = element.values.iter().skip(frame * stride).take(*stride);
                numbers.copied()
            })
            .collect(),
    });
    let frames = Frames {
        spatial: animation.spatial,
        elements: elements.collect(),
        times: pick(&animation.times, &kept),
        strides: None,
        bounds: &animation.bounds,
        ground: animation.ground,
        camera: &animation.camera,
        unit: animation.unit.as_deref(),
        description: animation.description.as_deref(),
    };
    (frames, drawn.iter().map(|(_, stride)| *stride).collect())
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
            Some((_, plot)) => {
                plot.of += 1;
                if plot.series.len() < CURVES {
                    plot.series.push(index);
                }
            }
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
                    of: 1,
                    path: None,
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
            let beside = portrait.beside.as_ref();
            let beside = beside.and_then(|(h, v)| Some([find(h)?, find(v)?]));
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
                series: [horizontal, vertical]
                    .into_iter()
                    .chain(beside.into_iter().flatten())
                    .collect(),
                of: 2,
                path: None,
                own: None,
            })
        })
        .collect()
}

fn figure(figure: &crate::data::Figure, kind: PlotKind) -> Plot<'_> {
    Plot {
        title: figure.title.as_str().into(),
        kind,
        unit: figure.series.first().and_then(|s| s.unit.as_deref()),
        log: figure.logarithmic_vertical,
        log_horizontal: figure.logarithmic_horizontal,
        marks: figure.marks,
        equal: false,
        series: (0..figure.series.len()).collect(),
        of: figure.series.len(),
        path: None,
        own: Some(Own {
            name: &figure.horizontal,
            unit: figure.horizontal_unit.as_deref(),
            abscissae: &figure.abscissae,
            curves: figure.series.iter().map(Curve::new).collect(),
            plane: figure.plane.as_ref().map(|(x, y)| [x.as_str(), y]),
        }),
    }
}
