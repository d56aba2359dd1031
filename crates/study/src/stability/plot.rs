//! Pictures of stability as SVG: eigenvalues over one parameter, regions over two.

use super::map::{Kind, StabilityMap};
use super::{Range, Stability};
use crate::axes::{document, Axes};
use crate::decimals::real;
use chetaev_stability::question::Place;
use chetaev_symbolic::Rational;
use std::fmt::Write as _;

/// Values of the parameter at which eigenvalues are drawn.
const SAMPLES: usize = 600;

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
            let place = self.question.place_in(region);
            if *is_absent || matches!(place, Place::Right | Place::NotLeft) {
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
        inside.push_str(&axes.lines(&self.changes()));
        Some(document(&title, &[axes.panel(names, &inside)]))
    }

    /// The values within the range at which stability changes, in print.
    fn changes(&self) -> Vec<(f64, String)> {
        let boundaries = self.ranges.iter().flat_map(|own| &own.boundaries);
        let middles = boundaries.map(|own| (&own.root.low + &own.root.high) / Rational::from(2));
        let values = middles.map(|own| own.to_f64().value());
        values.map(|at| (at, real(at, 6))).collect()
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
        document(&title, &[axes.panel(names, &inside)])
    }
}
