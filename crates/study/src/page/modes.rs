//! Modes to play: the steady motion and `Re(s e^{λt} v)`, drawn by the drawing of the model.

use super::drawing::{drawn, of_study, pictured};
use crate::decimals::real;
use crate::stability::{Mode, Stability};
use crate::study::Study;
use chetaev_mechanics::SteadyMotion;
use chetaev_model::drawing::Drawing;
use chetaev_motion::observe::Observer;
use chetaev_motion::Binding;
use chetaev_orbits::mode::{Deviation, LinearMotion};
use chetaev_report::data::{Album, Element, Shape, Shown};
use chetaev_symbolic::Expr;

/// Modes of one motion, the fastest growing first.
const MOST: usize = 8;
/// Eigenvalues below this part of the largest are zeros, whose modes do not move.
const ZERO: f64 = 1e-6;
/// Real parts below this part of an eigenvalue are rounding.
const ON_AXIS: f64 = 1e-9;
/// Periods that are shown.
const PERIODS: f64 = 3.0;
/// Times in which a mode changes by e that are shown at most: what is smaller is not seen.
const FOLDS: f64 = 4.0;
/// Frames of a picture.
const FRAMES: usize = 120;
/// Frames of a picture in which something turns fast, and the turn from one frame to the next, in radians.
const MOST_FRAMES: usize = 480;
const TURN: f64 = 0.35;
/// The largest deviation of an angle, in radians.
const ANGLE: f64 = 0.35;
/// The largest deviation of a point, in parts of the picture.
const PART: f64 = 0.25;
/// A deviation that is small beside every motion.
const SMALL: f64 = 1e-5;

/// The modes of steady motions; `None` where there is nothing to be drawn.
pub(super) fn album(study: &Study, found: &[(String, Stability)]) -> Option<Album> {
    let drawing = of_study(study)?;
    let of_motion = |(name, own): &(String, Stability)| pictures(study, &drawing, name, own);
    let pictures: Vec<Shown> = found.iter().filter_map(of_motion).flatten().collect();
    (!pictures.is_empty()).then(|| Album {
        title: "Modes".into(),
        explanation: vec![
            "A mode is a motion of the linear equations, the real part of exp(λt) times a vector, beside the steady motion. Deviations are drawn \
             large, so that they are seen: angles by up to 20°, points by up to a quarter of the picture; a mode that grows reaches this at its \
             end. Coordinates on which nothing depends follow by their rates."
                .into(),
        ],
        choice: "Mode".into(),
        pictures,
    })
}

/// The pictures of one motion.
fn pictures(study: &Study, drawing: &Drawing, name: &str, own: &Stability) -> Option<Vec<Shown>> {
    let (system, prepared) = (&study.system, &study.prepared);
    let given = |j: usize| study.model.initial.values.get(&(j, 0)).map(|own| own.value);
    let positions = own.motion.positions.iter().enumerate();
    let motion = SteadyMotion {
        positions: positions.map(|(j, own)| own.or_else(|| given(j))).collect(),
        ..own.motion.clone()
    };
    let about = (&motion, &own.question.linear);
    let beside = LinearMotion::new(system, &prepared.terms, &prepared.selection, about).ok()?;
    let expressions: Vec<Expr> = drawing
        .elements
        .iter()
        .flat_map(|e| e.shape.expressions())
        .collect();
    let binding = Binding::new(system).ok()?;
    let observer = Observer::new(system, &prepared.terms, &binding, &expressions).ok()?;
    let mut stage = Stage {
        drawing,
        beside,
        observer,
        expressions: expressions.len(),
        unknown: system.n() + prepared.terms.constraint_index.len(),
    };
    let unit = if study.model.has_units { " s" } else { "" };
    let mut modes = own.modes();
    let largest = modes.iter().map(|m| size(m.eigenvalue)).fold(0.0, f64::max);
    modes.retain(|m| size(m.eigenvalue) > ZERO * largest);
    modes.sort_by(|a, b| b.eigenvalue.0.total_cmp(&a.eigenvalue.0));
    let shown = modes.iter().take(MOST).filter_map(|mode| {
        let (times, elements) = stage.played(mode)?;
        Some(Shown {
            name: format!("{name}: λ = {}", written(mode.eigenvalue)),
            explanation: described(mode.eigenvalue, unit),
            animation: pictured(drawing, times, elements),
        })
    });
    Some(shown.collect())
}

fn size((re, im): (f64, f64)) -> f64 {
    re.hypot(im)
}

/// Parts of an eigenvalue, the real one zero where it is rounding.
fn plain((re, im): (f64, f64)) -> (f64, f64) {
    let is_rounding = re.abs() < ON_AXIS * size((re, im));
    (if is_rounding { 0.0 } else { re }, im)
}

/// `−0.33 ± 2.1 i`.
fn written(eigenvalue: (f64, f64)) -> String {
    let (re, im) = plain(eigenvalue);
    let text = |x: f64| real(x, 4).replace('-', "−");
    match (re == 0.0, im == 0.0) {
        (_, true) => text(re),
        (true, _) => format!("± {} i", text(im)),
        _ => format!("{} ± {} i", text(re), text(im)),
    }
}

/// What a mode does, in a sentence.
fn described(eigenvalue: (f64, f64), unit: &str) -> String {
    let (re, im) = plain(eigenvalue);
    let number = |x: f64| format!("{}{unit}", real(x, 3));
    let changes = || number(std::f64::consts::LN_2 / re.abs());
    let period = || number(std::f64::consts::TAU / im.abs());
    match (re == 0.0, im == 0.0) {
        (true, _) => format!("It oscillates with the period {}.", period()),
        (_, true) if re > 0.0 => format!("It grows, twofold in {}.", changes()),
        (_, true) => format!("It dies away, by half in {}.", changes()),
        _ if re > 0.0 => format!(
            "It oscillates with the period {} and grows, twofold in {}.",
            period(),
            changes()
        ),
        _ => format!(
            "It oscillates with the period {} and dies away, by half in {}.",
            period(),
            changes()
        ),
    }
}

/// How long a mode is shown.
fn duration(eigenvalue: (f64, f64)) -> f64 {
    let (re, im) = plain(eigenvalue);
    let folds = FOLDS / re.abs();
    let periods = PERIODS * std::f64::consts::TAU / im.abs();
    folds.min(periods)
}

/// What draws the motions beside one steady motion.
struct Stage<'a> {
    drawing: &'a Drawing,
    beside: LinearMotion,
    observer: Observer,
    expressions: usize,
    /// Entries of a row behind coordinates and velocities: they have no values here.
    unknown: usize,
}

impl Stage<'_> {
    /// The times and elements of a mode; `None` where it moves nothing that is drawn.
    fn played(&mut self, mode: &Mode) -> Option<(Vec<f64>, Vec<Element>)> {
        let times = self.times(mode)?;
        let end = times.last().copied()?;
        let of = |size: f64| Deviation {
            eigenvalue: plain(mode.eigenvalue),
            vector: mode.vector.clone(),
            size,
            // The largest deviation is that of the last frame where the mode grows, else that of the first.
            from: if plain(mode.eigenvalue).0 > 0.0 {
                end
            } else {
                0.0
            },
        };
        let steady = self.beside.rows(&times, None).ok()?;
        let moved = self.beside.rows(&times, Some(&of(SMALL))).ok()?;
        let angle = self.turned(&steady, &moved) / SMALL;
        let (before, after) = (self.elements(&steady), self.elements(&moved));
        let spatial = self.drawing.spatial;
        let (part, extent) = departed(&before, &after, times.len(), spatial)?;
        let part = part / SMALL;
        let size = (ANGLE / angle).min(PART * extent / part);
        if !(part > 1e-6 * extent * angle && size.is_finite()) {
            return None;
        }
        let rows = self.beside.rows(&times, Some(&of(size))).ok()?;
        Some((times, self.elements(&rows)))
    }

    /// The times of the frames: so many that what turns is seen to turn.
    fn times(&mut self, mode: &Mode) -> Option<Vec<f64>> {
        let end = duration(mode.eigenvalue);
        if !(end.is_finite() && end > 0.0) {
            return None;
        }
        let row = self.beside.rows(&[0.0], None).ok()?.pop()?;
        let n = row.len() / 2;
        let angles = (0..n).filter(|&j| self.beside.is_angle(j));
        let rate = angles.map(|j| row[n + j].abs()).fold(0.0, f64::max);
        let frames = ((end * rate / TURN) as usize).clamp(FRAMES, MOST_FRAMES);
        let end = if rate > 0.0 {
            end.min(TURN * frames as f64 / rate)
        } else {
            end
        };
        Some(
            (0..=frames)
                .map(|i| end * i as f64 / frames as f64)
                .collect(),
        )
    }

    /// The largest difference in an angle.
    fn turned(&self, steady: &[Vec<f64>], moved: &[Vec<f64>]) -> f64 {
        let n = steady.first().map_or(0, |row| row.len() / 2);
        let angles: Vec<usize> = (0..n).filter(|&j| self.beside.is_angle(j)).collect();
        let pairs = steady.iter().zip(moved);
        let differences = pairs.flat_map(|(a, b)| angles.iter().map(|&j| (a[j] - b[j]).abs()));
        differences.fold(0.0, f64::max)
    }

    fn elements(&mut self, rows: &[Vec<f64>]) -> Vec<Element> {
        let mut series = vec![Vec::with_capacity(rows.len()); self.expressions];
        for row in rows {
            let mut row = row.clone();
            row.resize(row.len() + self.unknown, f64::NAN);
            for (values, value) in series.iter_mut().zip(self.observer.at(0.0, &row)) {
                values.push(value);
            }
        }
        drawn(&self.drawing.elements, &series, rows.len())
    }
}

/// The largest distance between points of the same element at the same time, and the extent of the picture before.
fn departed(
    before: &[Element],
    after: &[Element],
    rows: usize,
    spatial: bool,
) -> Option<(f64, f64)> {
    let d = if spatial { 3 } else { 2 };
    let mut part: f64 = 0.0;
    let mut bounds = vec![(f64::INFINITY, f64::NEG_INFINITY); d];
    let is_body = |own: &&Element| !matches!(own.shape, Shape::Label { .. });
    for (a, b) in before
        .iter()
        .filter(is_body)
        .zip(after.iter().filter(is_body))
    {
        let stride = a.shape.stride(spatial);
        let points = match a.shape {
            Shape::Segment | Shape::Arrow => 2,
            Shape::Polyline { points, .. } => points,
            _ => 1,
        };
        for row in 0..rows {
            for point in 0..points {
                let from = row * stride + point * d;
                let (p, q) = (a.values.get(from..from + d)?, b.values.get(from..from + d)?);
                if !p.iter().chain(q).all(|x| x.is_finite()) {
                    continue;
                }
                let squares = p.iter().zip(q).map(|(x, y)| (x - y) * (x - y));
                part = part.max(squares.sum::<f64>().sqrt());
                for ((low, high), x) in bounds.iter_mut().zip(p) {
                    (*low, *high) = (low.min(*x), high.max(*x));
                }
            }
        }
    }
    let sides = bounds.iter().map(|(low, high)| high - low);
    let extent = sides.fold(0.0, f64::max);
    (extent > 0.0).then_some((part, extent))
}

#[cfg(test)]
mod tests {
    use super::{described, duration, written};

    #[test]
    fn modes_are_described() {
        assert_eq!(written((-0.5, 2.0)), "−0.5000 ± 2.0000 i");
        assert_eq!(written((1e-14, 2.0)), "± 2.0000 i");
        assert_eq!(
            described((std::f64::consts::LN_2, 0.0), " s"),
            "It grows, twofold in 1.000 s."
        );
        // Three periods, unless the mode changes by e⁴ before.
        assert_eq!(duration((0.0, std::f64::consts::TAU)), 3.0);
        assert_eq!(duration((-8.0, std::f64::consts::TAU)), 0.5);
    }
}
