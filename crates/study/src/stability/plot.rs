//! Pictures of stability as SVG: eigenvalues over one parameter, regions over two.

use super::map::{Kind, StabilityMap};
use super::{Range, Stability};
use chetaev_report::escaped;
use chetaev_stability::question::Place;
use std::fmt::Write as _;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 70.0;
const BELOW: f64 = 50.0;
const BORDER: f64 = 20.0;
/// Values of the parameter at which eigenvalues are drawn.
const SAMPLES: usize = 600;
/// Parts of an axis between marks, about.
const MARKS: f64 = 6.0;

/// A frame with its axes: what is left, right, below and above.
struct Axes {
    x: (f64, f64),
    y: (f64, f64),
}

impl Axes {
    fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let part = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let width = WIDTH - LEFT - BORDER;
        let height = HEIGHT - BELOW - BORDER;
        (
            LEFT + part(x, self.x) * width,
            HEIGHT - BELOW - part(y, self.y) * height,
        )
    }

    /// The picture around what is drawn in it.
    fn framed(&self, (title, names): (&str, [&str; 2]), inside: &str) -> String {
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"13\" role=\"img\"><title>{}</title><rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>{inside}",
            escaped(title)
        );
        let (x0, y0) = self.at(self.x.0, self.y.0);
        let (x1, y1) = self.at(self.x.1, self.y.1);
        let _ = write!(
            text,
            "<path d=\"M{x0:.1} {y1:.1}V{y0:.1}H{x1:.1}\" fill=\"none\" stroke=\"#444\"/>"
        );
        for x in marks(self.x) {
            let (at, _) = self.at(x, self.y.0);
            let _ = write!(text, "<path d=\"M{at:.1} {y0:.1}v5\" stroke=\"#444\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{x}</text>", y0 + 20.0);
        }
        for y in marks(self.y) {
            let (_, at) = self.at(self.x.0, y);
            let _ = write!(text, "<path d=\"M{x0:.1} {at:.1}h-5\" stroke=\"#444\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{y}</text>", x0 - 9.0, at + 4.0);
        }
        let _ = write!(
            text,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            0.5 * (x0 + x1),
            HEIGHT - 10.0,
            escaped(names[0])
        );
        let _ = writeln!(text, "<text transform=\"translate(16 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text></svg>", 0.5 * (y0 + y1), escaped(names[1]));
        text
    }
}

/// Round values on an axis: 1, 2 or 5 times a power of ten apart.
fn marks((low, high): (f64, f64)) -> Vec<f64> {
    let rough = (high - low) / MARKS;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|own| own * power);
    let step = step.into_iter().find(|own| *own >= rough).unwrap_or(rough);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    // Decimal as they are printed.
    let decimal = |i: i64| format!("{:.10}", i as f64 * step).parse().unwrap_or(0.0);
    (first..=last).map(decimal).collect()
}

impl Stability {
    /// Real and imaginary parts of the eigenvalues over the range, with the ranges of stability shaded; `None` without a range.
    pub fn picture(&self) -> Option<String> {
        let range = self.range.as_ref()?;
        let (low, high) = ends(range);
        let at = |i: usize| low + (high - low) * i as f64 / SAMPLES as f64;
        let rows: Vec<(f64, Vec<(f64, f64)>)> = (0..=SAMPLES)
            .filter_map(|i| Some((at(i), self.eigenvalues(Some(at(i)))?)))
            .collect();
        let parts = rows
            .iter()
            .flat_map(|(_, list)| list.iter().flat_map(|l| [l.0, l.1]));
        let (least, most) = parts.fold((0.0_f64, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
        let margin = 0.05 * (most - least).max(1e-9);
        let axes = Axes {
            x: (low, high),
            y: (least - margin, most + margin),
        };
        let mut inside = String::new();
        let regions = self.ranges.iter().flat_map(|own| &own.regions);
        for (region, is_absent) in regions.zip(&self.absent) {
            if *is_absent || self.question.place(region.is_left) == Place::Right {
                continue;
            }
            let (a, above) = axes.at(region.low.to_f64().value().max(low), axes.y.1);
            let (b, below) = axes.at(region.high.to_f64().value().min(high), axes.y.0);
            let _ = write!(inside, "<rect x=\"{a:.1}\" y=\"{above:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#cfe8cf\"/>", b - a, below - above);
        }
        let (x0, zero) = axes.at(low, 0.0);
        let (x1, _) = axes.at(high, 0.0);
        let _ = write!(
            inside,
            "<path d=\"M{x0:.1} {zero:.1}H{x1:.1}\" stroke=\"#999\"/>"
        );
        for (is_real, color) in [(false, "#d98a2b"), (true, "#1f5fa8")] {
            let mut path = String::new();
            for (x, list) in &rows {
                for l in list.iter().filter(|l| is_real || l.1 > 0.0) {
                    let (x, y) = axes.at(*x, if is_real { l.0 } else { l.1 });
                    let _ = write!(path, "M{x:.1} {y:.1}h0");
                }
            }
            let _ = write!(inside, "<path d=\"{path}\" stroke=\"{color}\" stroke-width=\"2\" stroke-linecap=\"round\" fill=\"none\"/>");
        }
        let title = format!(
            "Eigenvalues of {}, motion {}",
            self.system.name, self.motion.name
        );
        let names = [
            &range.name[..],
            "real parts (blue), imaginary parts (orange)",
        ];
        Some(axes.framed((&title, names), &inside))
    }
}

fn ends(range: &Range) -> (f64, f64) {
    (range.low.to_f64().value(), range.high.to_f64().value())
}

impl StabilityMap {
    /// The regions of stability with their boundaries.
    pub fn picture(&self) -> String {
        let side = self.side;
        let axes = Axes {
            x: ends(&self.ranges[0]),
            y: ends(&self.ranges[1]),
        };
        let place = |column: f64, row: f64| {
            let part = |(low, high): (f64, f64), at: f64| low + (high - low) * at / side as f64;
            axes.at(part(axes.x, column), part(axes.y, row))
        };
        let mut inside = String::new();
        for row in 0..side {
            let mut column = 0;
            while column < side {
                let from = column;
                let kind = self.kind_at(column, row);
                while column < side && self.kind_at(column, row) == kind {
                    column += 1;
                }
                let fill = match kind {
                    Kind::Stable => "#cfe8cf",
                    Kind::Unstable => continue,
                    Kind::NoMotion => "#dddddd",
                };
                let (a, below) = place(from as f64, row as f64);
                let (b, above) = place(column as f64, (row + 1) as f64);
                let _ = write!(inside, "<path d=\"M{a:.1} {above:.2}H{b:.1}V{below:.2}H{a:.1}z\" fill=\"{fill}\" shape-rendering=\"crispEdges\"/>");
            }
        }
        for curve in &self.curves {
            let color = match curve.kind {
                "pair" | "collision" => "#b3261e",
                "end" => "#777777",
                _ => "#1f5fa8",
            };
            let points: Vec<String> = curve
                .points
                .iter()
                .map(|&(x, y)| axes.at(x, y))
                .map(|(x, y)| format!("{x:.1},{y:.1}"))
                .collect();
            let _ = write!(
                inside,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>",
                points.join(" ")
            );
        }
        let title = format!("Stability of {}, motion {}", self.name, self.motion);
        let names = [&self.ranges[0].name[..], &self.ranges[1].name[..]];
        axes.framed((&title, names), &inside)
    }
}
