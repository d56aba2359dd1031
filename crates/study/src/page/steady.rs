//! The section on steady motions: their eigenvalues, what is stated on their stability, how the eigenvalues move with a parameter, regions of
//! stability over two, and the modes.

use super::modes;
use crate::decimals::Decimals;
use crate::overview::found::rounded;
use crate::stability::map::{Asked, Course, Kind, StabilityMap};
use crate::stability::{stability, Range, Stability, Wanted};
use crate::study::Study;
use chetaev_mechanics::prover::assumptions;
use chetaev_report::data::{
    Cell, Figure, Map, Outline, Series, SeriesGroup, Table, TableRow, Tint,
};
use chetaev_stability::hurwitz::Region;
use chetaev_stability::isolation::Root;
use chetaev_stability::question::parameter_of_motion;
use chetaev_symbolic::zero::known_sign;
use chetaev_symbolic::{Rational, Verdict};

/// The table with its figures, maps and modes.
pub(super) fn section(study: &Study) -> Option<Table> {
    let names = study.system.steady.iter().map(|own| own.name.clone());
    let found: Vec<(String, Stability)> = names
        .filter_map(|name| Some((name.clone(), about(study, &name)?)))
        .collect();
    if found.is_empty() {
        return None;
    }
    let rows = found.iter().map(|(name, own)| row(study, name, own));
    Some(Table {
        id: "steady".into(),
        title: "Steady motions and stability".into(),
        explanation: vec![
            "Along a steady motion everything that the equations depend on is constant. The eigenvalues are those of the exact linear equations, at the values of the model; zeros of the family of steady motions are among them.".into(),
        ],
        headings: ["Motion", "Eigenvalues", "Stated", "Stability changes"]
            .map(String::from)
            .to_vec(),
        rows: rows.collect(),
        figures: found
            .iter()
            .flat_map(|(name, own)| figures(name, own))
            .collect(),
        maps: found
            .iter()
            .filter_map(|(name, own)| regions(study, name, own))
            .collect(),
        album: modes::album(study, &found),
    })
}

/// The linear equations about a motion, over a range around the stated value where a parameter names the members of its family.
fn about(study: &Study, name: &str) -> Option<Stability> {
    let motion = study.system.steady.iter().find(|own| own.name == name)?;
    let range = parameter_of_motion(&study.system, motion)
        .and_then(|symbol| range(study, &study.system.graph.symbol_text(symbol)));
    let wanted = |over| Wanted {
        about: Some(name),
        over,
        ..Wanted::default()
    };
    let over = range.as_deref();
    let found = stability(&study.model, &wanted(over)).ok();
    found.or_else(|| stability(&study.model, &wanted(None)).ok())
}

/// The range of a parameter that the model states; else from minus twice its value to twice it, in short decimals, of one sign where that is
/// assumed.
fn range(study: &Study, name: &str) -> Option<String> {
    if let Some(text) = stated_range(study, name) {
        return Some(text);
    }
    let system = &study.system;
    let parameter = system.parameters.iter().find(|p| p.name == name)?;
    let value = system.graph.evaluate_f64(&[parameter.value?], &|_| None);
    let size = match value.ok()?[0].abs() {
        x if x > 0.0 && x.is_finite() => x,
        _ => 1.0,
    };
    let end: f64 = format!("{:.3e}", 2.0 * size).parse().ok()?;
    let sign = known_sign(&system.graph, parameter.expr, &assumptions(system));
    Some(if sign.is_nonnegative() {
        format!("{name}=0:{end}")
    } else if sign.is_nonpositive() {
        format!("{name}=-{end}:0")
    } else {
        format!("{name}=-{end}:{end}")
    })
}

/// The range that the model states of a parameter, where its ends are numbers.
fn stated_range(study: &Study, name: &str) -> Option<String> {
    let parameter = study.model.parameters.iter().find(|p| p.name == name)?;
    let g = &study.model.graph;
    let (low, high) = parameter.range?;
    (g.as_number(low)? < g.as_number(high)?)
        .then(|| format!("{name}={}:{}", g.text(low), g.text(high)))
}

/// Parameters that are tried for a map.
const TRIED: usize = 4;

/// Intervals on each side of a map.
const SIDE: usize = 80;

/// Where the motion is stable over two parameters: the one that names the members of its family, and the first further one for which the model
/// states a range and on which the linear equations depend; else the first two for which it states a range.
fn regions(study: &Study, name: &str, own: &Stability) -> Option<Map> {
    let first = own.range.as_ref().map(|range| range.name.clone());
    let others = study.model.parameters.iter().map(|p| p.name.clone());
    let others = others.filter(|other| first.as_ref() != Some(other));
    let others = others.filter_map(|other| stated_range(study, &other));
    let ranges: Vec<String> = first
        .iter()
        .filter_map(|first| range(study, first))
        .chain(others)
        .take(TRIED)
        .collect();
    let pairs = (0..ranges.len()).flat_map(|i| (i + 1..ranges.len()).map(move |j| (i, j)));
    let asked = pairs.filter_map(|(i, j)| {
        let over = format!("{},{}", ranges[i], ranges[j]);
        let wanted = Wanted {
            about: Some(name),
            over: Some(&over),
            ..Wanted::default()
        };
        Asked::new(&study.model, &wanted).ok()
    });
    let asked = asked.into_iter().find(Asked::depends_on_both)?;
    Some(map_of(&asked.map(Course {
        side: SIDE,
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        tell: &mut |_| {},
    })))
}

/// The map as a picture: how fast neighbours depart, and the boundaries of stability.
fn map_of(own: &StabilityMap) -> Map {
    // The mean of the corners of each cell; none where all are stable.
    let cell = |column: usize, row: usize| {
        let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
        let corners = corners.map(|(x, y)| (row + y) * (own.side + 1) + column + x);
        let is_unstable = |at: &usize| own.kinds[*at] == Kind::Unstable;
        if !corners.iter().any(is_unstable) {
            return f64::NAN;
        }
        corners
            .iter()
            .map(|&at| own.growth[at].max(0.0))
            .sum::<f64>()
            / 4.0
    };
    let cells = (0..own.side).flat_map(|row| (0..own.side).map(move |column| (column, row)));
    let ends = |range: &crate::stability::Range| {
        let (low, high) = (range.low.to_f64().value(), range.high.to_f64().value());
        (range.name.clone(), low, high)
    };
    let outlines = own.curves.iter().map(|curve| Outline {
        name: curve.what().into(),
        tint: match curve.kind {
            "pair" | "collision" => Tint::Red,
            "end" => Tint::Muted,
            _ => Tint::Blue,
        },
        points: curve.points.clone(),
    });
    Map {
        title: format!("Regions of stability of the motion {}", own.motion),
        explanation: vec![
            "The largest real part of an eigenvalue where one lies right of the axis, by eigenvalues on a grid, and the boundaries of these regions."
                .into(),
        ],
        horizontal: ends(&own.ranges[0]),
        vertical: ends(&own.ranges[1]),
        columns: own.side,
        values: cells.map(|(column, row)| cell(column, row)).collect(),
        absent: Some(if own.kinds.contains(&Kind::NoMotion) {
            "no eigenvalue right of the axis, or no such motion".into()
        } else {
            "no eigenvalue right of the axis".into()
        }),
        outlines: outlines.collect(),
        is_unscaled: true,
    }
}

fn row(study: &Study, name: &str, own: &Stability) -> TableRow {
    let found = own.eigenvalues_at(own.stated_exactly());
    let (list, are_enclosed) =
        found.map_or((Vec::new(), false), |own| (own.values, own.are_enclosed));
    let decimals = Decimals::of(list.iter().copied());
    let decimals = decimals.with_places(4).exact_if(are_enclosed);
    let eigenvalues: Vec<String> = list.iter().map(|&l| decimals.typeset(l)).collect();
    let stated = |id: &str, word: &str| {
        let full = format!("{id}#{name}");
        let decided = study.verdicts.iter().find(|d| d.full_id() == full)?;
        Some(match &decided.finding.verdict {
            Verdict::Conditional { condition, .. } => {
                format!("{word} where {}", rounded(condition))
            }
            other => format!("{word}: {}", other.word()),
        })
    };
    let all = [
        stated("stability.asymptotic", "asymptotically stable"),
        stated("stability.nonlinear", "stable"),
        stated("stability.linear", "linear motions bounded"),
    ];
    let all: Vec<String> = all.into_iter().flatten().collect();
    let cells = [
        name.to_owned(),
        eigenvalues.join(", "),
        all.join("; "),
        changes(own).join("; "),
    ];
    TableRow {
        cells: cells.iter().map(|text| Cell::from(text.as_str())).collect(),
        is_marked: false,
    }
}

/// Where the stability changes within the range.
fn changes(own: &Stability) -> Vec<String> {
    let (Some(range), Some(ranges)) = (&own.range, &own.ranges) else {
        return Vec::new();
    };
    let kind = |region: Option<&Region>| region.map(|own| (own.is_left, own.is_decided));
    let text = |root: &Root| {
        let before = kind(ranges.regions.iter().rfind(|own| own.high <= root.low));
        let after = kind(ranges.regions.iter().find(|own| own.low >= root.high));
        let middle = (&root.low + &root.high) / Rational::from(2);
        let name = &range.name;
        (before != after).then(|| format!("{name} = {:.12}", middle.to_f64().value()))
    };
    let boundaries = ranges.boundaries.iter();
    boundaries.filter_map(|own| text(&own.root)).collect()
}

/// Values of the parameter in the figure.
const SAMPLES: usize = 240;

/// The eigenvalues over the parameter of a motion: their parts over it, and their places in the complex plane.
fn figures(name: &str, own: &Stability) -> Vec<Figure> {
    let Some(range) = own.range.as_ref() else {
        return Vec::new();
    };
    let (abscissae, curves) = curves(own, range);
    let of = |figure: Figure| Figure {
        horizontal: range.name.clone(),
        abscissae: abscissae.clone(),
        claim: Some(format!("stability.spectral#{name}")),
        ..figure
    };
    let parts = of(Figure {
        title: format!("Eigenvalues of the motion {name}"),
        explanation: vec![format!(
            "Real and imaginary parts over {}: the motion is unstable where a real part is positive.",
            range.name
        )],
        series: series(&curves, &|part, i| (format!("{part} λ {i}"), format!("{part} λ_{{{i}}}"))),
        ..Figure::default()
    });
    let locus = of(Figure {
        title: format!("Root locus of the motion {name}"),
        explanation: vec![format!(
            "The paths of the eigenvalues in the complex plane from {} to {} (a dot marks where each begins): the motion is unstable where one lies right of the imaginary axis.",
            at_end(range, range.low.to_f64().value()),
            at_end(range, range.high.to_f64().value())
        )],
        plane: Some(("Re λ".into(), "Im λ".into())),
        series: series(&curves, &|_, i| (format!("λ {i}"), format!("λ_{{{i}}}"))),
        ..Figure::default()
    });
    vec![parts, locus]
}

/// Values of the parameter, and over them the real and imaginary part of each eigenvalue.
fn curves(own: &Stability, range: &Range) -> (Vec<f64>, Vec<Vec<(f64, f64)>>) {
    let (low, high) = (range.low.to_f64().value(), range.high.to_f64().value());
    let mut abscissae = Vec::new();
    let mut curves: Vec<Vec<(f64, f64)>> = Vec::new();
    for i in 0..=SAMPLES {
        let at = low + (high - low) * i as f64 / SAMPLES as f64;
        let Some(list) = own.eigenvalues(Some(at)) else {
            continue;
        };
        if curves.is_empty() {
            curves = list.iter().map(|&l| vec![l]).collect();
        } else {
            continued(&mut curves, list);
        }
        abscissae.push(at);
    }
    (abscissae, curves)
}

/// The two parts of each curve, with the name and the label of a part (`Re` or `Im`) of the eigenvalue of a number.
fn series(
    curves: &[Vec<(f64, f64)>],
    named: &dyn Fn(&str, usize) -> (String, String),
) -> Vec<Series> {
    let of = |(place, curve): (usize, &Vec<(f64, f64)>)| {
        let part = |what: &str, values: Vec<f64>| {
            let (name, label) = named(what, place + 1);
            Series {
                name,
                label: Some(label),
                group: SeriesGroup::Other,
                values,
                ..Series::default()
            }
        };
        [
            part("Re", curve.iter().map(|l| l.0).collect()),
            part("Im", curve.iter().map(|l| l.1).collect()),
        ]
    };
    curves.iter().enumerate().flat_map(of).collect()
}

/// An end of a range, as it is printed.
fn at_end(range: &Range, value: f64) -> String {
    format!("{} = {value}", range.name)
}

/// Each curve goes on to the eigenvalue nearest to its last one that no other has taken.
fn continued(curves: &mut [Vec<(f64, f64)>], mut list: Vec<(f64, f64)>) {
    for curve in curves {
        let Some(&last) = curve.last() else {
            continue;
        };
        let distance = |l: &(f64, f64)| (l.0 - last.0).hypot(l.1 - last.1);
        let nearest =
            (0..list.len()).min_by(|&a, &b| distance(&list[a]).total_cmp(&distance(&list[b])));
        curve.push(nearest.map_or(last, |place| list.swap_remove(place)));
    }
}
