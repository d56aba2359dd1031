//! Axes with marks for pictures as SVG.

use chetaev_report::escaped;
use std::fmt::Write as _;

pub(crate) const WIDTH: f64 = 720.0;
pub(crate) const HEIGHT: f64 = 440.0;
const LEFT: f64 = 70.0;
const BELOW: f64 = 50.0;
const BORDER: f64 = 20.0;
/// Parts of an axis between marks, about.
const MARKS: f64 = 6.0;
/// Labels of lines nearer than this stand below each other.
const APART: f64 = 120.0;

/// A frame with its axes: what is left, right, below and above.
pub(crate) struct Axes {
    pub(crate) x: (f64, f64),
    pub(crate) y: (f64, f64),
}

impl Axes {
    pub(crate) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        let part = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
        let width = WIDTH - LEFT - BORDER;
        let height = HEIGHT - BELOW - BORDER;
        (
            LEFT + part(x, self.x) * width,
            HEIGHT - BELOW - part(y, self.y) * height,
        )
    }

    /// What is drawn in the frame, with its axes.
    pub(crate) fn panel(&self, names: [&str; 2], inside: &str) -> String {
        let mut text = inside.to_owned();
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
        let _ = write!(
            text,
            "<text transform=\"translate(16 {:.1}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
            0.5 * (y0 + y1),
            escaped(names[1])
        );
        text
    }

    /// Lines across the frame at values of the horizontal axis, each with its label.
    pub(crate) fn lines(&self, all: &[(f64, String)]) -> String {
        let mut text = String::new();
        let (_, below) = self.at(self.x.0, self.y.0);
        let (right, above) = self.at(self.x.1, self.y.1);
        let mut last = (f64::NEG_INFINITY, 0.0);
        for (x, label) in all {
            let (at, _) = self.at(*x, self.y.0);
            last = (
                at,
                if at - last.0 < APART {
                    last.1 + 16.0
                } else {
                    0.0
                },
            );
            let (anchor, beside) = if right - at < APART {
                ("end", at - 5.0)
            } else {
                ("start", at + 5.0)
            };
            let _ = write!(text, "<path d=\"M{at:.1} {above:.1}V{below:.1}\" stroke=\"#444\" stroke-dasharray=\"3 4\"/><text x=\"{beside:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>", above + 12.0 + last.1, escaped(label));
        }
        text
    }
}

/// Panels below each other as one document.
pub(crate) fn document(title: &str, panels: &[String]) -> String {
    let height = HEIGHT * panels.len() as f64;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" font-size=\"13\" role=\"img\"><title>{}</title><rect width=\"{WIDTH}\" height=\"{height}\" fill=\"white\"/>",
        escaped(title)
    );
    for (i, panel) in panels.iter().enumerate() {
        if i == 0 {
            text.push_str(panel);
        } else {
            let down = HEIGHT * i as f64;
            let _ = write!(text, "<g transform=\"translate(0 {down})\">{panel}</g>");
        }
    }
    text.push_str("</svg>\n");
    text
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
