//! Plots with two logarithmic axes, as SVG.

use std::fmt::Write;

/// A line with its name.
pub(crate) struct Line {
    /// What the legend says.
    pub(crate) name: String,
    /// Points; what is not positive is left out.
    pub(crate) points: Vec<(f64, f64)>,
    /// Whether it is ours: thick.
    pub(crate) is_ours: bool,
}

/// A plot.
pub(crate) struct Plot {
    /// Heading.
    pub(crate) title: String,
    /// Names of the axes.
    pub(crate) axes: [String; 2],
    /// The lines.
    pub(crate) lines: Vec<Line>,
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 250.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 50.0;

/// Colours that differ in lightness too (Okabe, Ito 2008).
const COLOURS: &[&str] = &[
    "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#7f7f7f",
];

/// Decades that hold all values.
fn decades(values: impl Iterator<Item = f64>) -> Option<(i32, i32)> {
    let logs = values.filter(|x| *x > 0.0 && x.is_finite()).map(f64::log10);
    let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let (low, high) = (low.floor(), high.ceil());
    (low.is_finite() && high.is_finite()).then(|| {
        (
            low as i32,
            if high > low {
                high as i32
            } else {
                low as i32 + 1
            },
        )
    })
}

impl Plot {
    /// The picture; `None` where nothing can be drawn.
    pub(crate) fn svg(&self) -> Option<String> {
        let all = || self.lines.iter().flat_map(|line| line.points.iter());
        let (x0, x1) = decades(all().map(|p| p.0))?;
        let (y0, y1) = decades(all().map(|p| p.1))?;
        let across = (WIDTH - LEFT - RIGHT) / f64::from(x1 - x0);
        let up = (HEIGHT - TOP - BOTTOM) / f64::from(y1 - y0);
        let x = |value: f64| LEFT + (value.log10() - f64::from(x0)) * across;
        let y = |value: f64| HEIGHT - BOTTOM - (value.log10() - f64::from(y0)) * up;
        let mut text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <title>{}</title>\n<rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n",
            escape(&self.title)
        );
        let mut label = |x: f64, y: f64, more: &str, words: &str| {
            let _ = writeln!(
                text,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" {more}>{}</text>",
                escape(words)
            );
        };
        label(LEFT, 20.0, "font-size=\"14\"", &self.title);
        let middle = LEFT + (WIDTH - LEFT - RIGHT) / 2.0;
        label(
            middle,
            HEIGHT - 10.0,
            "text-anchor=\"middle\"",
            &self.axes[0],
        );
        label(
            -HEIGHT / 2.0,
            16.0,
            "transform=\"rotate(-90)\" text-anchor=\"middle\"",
            &self.axes[1],
        );
        for (k, step) in ticks(x0, x1) {
            label(
                LEFT + step * across,
                HEIGHT - BOTTOM + 16.0,
                "text-anchor=\"middle\"",
                &format!("1e{k}"),
            );
        }
        for (k, step) in ticks(y0, y1) {
            label(
                LEFT - 6.0,
                HEIGHT - BOTTOM - step * up + 4.0,
                "text-anchor=\"end\"",
                &format!("1e{k}"),
            );
        }
        for (_, step) in ticks(x0, x1) {
            let at = LEFT + step * across;
            let _ = writeln!(
                text,
                "<path d=\"M{at:.1} {TOP}V{:.1}\" stroke=\"#ddd\"/>",
                HEIGHT - BOTTOM
            );
        }
        for (_, step) in ticks(y0, y1) {
            let at = HEIGHT - BOTTOM - step * up;
            let _ = writeln!(
                text,
                "<path d=\"M{LEFT} {at:.1}H{:.1}\" stroke=\"#ddd\"/>",
                WIDTH - RIGHT
            );
        }
        for (number, line) in self.lines.iter().enumerate() {
            draw(&mut text, number, line, &x, &y);
        }
        text.push_str("</svg>\n");
        Some(text)
    }
}

/// Decades to be named, with their distance from the first: at most ten of them.
fn ticks(low: i32, high: i32) -> impl Iterator<Item = (i32, f64)> {
    let every = ((high - low) / 10 + 1) as usize;
    (low..=high)
        .step_by(every)
        .map(move |k| (k, f64::from(k - low)))
}

fn draw(
    text: &mut String,
    number: usize,
    line: &Line,
    x: &impl Fn(f64) -> f64,
    y: &impl Fn(f64) -> f64,
) {
    let colour = COLOURS[number % COLOURS.len()];
    let (width, dash) = match (line.is_ours, number / COLOURS.len()) {
        (true, _) => (3.0, ""),
        (false, 0) => (1.5, ""),
        (false, _) => (1.5, " stroke-dasharray=\"5 3\""),
    };
    let places: Vec<(f64, f64)> = line
        .points
        .iter()
        .filter(|p| p.0 > 0.0 && p.1 > 0.0 && p.0.is_finite() && p.1.is_finite())
        .map(|p| (x(p.0), y(p.1)))
        .collect();
    let path: Vec<String> = places
        .iter()
        .map(|(x, y)| format!("{x:.1} {y:.1}"))
        .collect();
    let _ = writeln!(
        text,
        "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash}/>",
        path.join("L")
    );
    if places.len() <= 24 {
        for (x, y) in &places {
            let _ = writeln!(
                text,
                "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>"
            );
        }
    }
    let row = TOP + 10.0 + 18.0 * number as f64;
    let start = WIDTH - RIGHT + 12.0;
    let _ = writeln!(
        text,
        "<path d=\"M{start} {row}h18\" stroke=\"{colour}\" stroke-width=\"{width}\"{dash}/>\
         <text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
        start + 24.0,
        row + 4.0,
        escape(&line.name)
    );
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_on_logarithmic_axes() {
        let line = Line {
            name: "a < b".into(),
            points: vec![(1e-3, 1.0), (1e-1, 100.0), (-1.0, 5.0)],
            is_ours: true,
        };
        let plot = Plot {
            title: "t".into(),
            axes: ["x".into(), "y".into()],
            lines: vec![line],
        };
        let svg = plot.svg().unwrap_or_default();
        // The corners of the field; the third point cannot be drawn.
        assert!(svg.contains("d=\"M70.0 370.0L510.0 34.0\""), "{svg}");
        assert!(svg.contains("a &lt; b"));
    }

    #[test]
    fn nothing_gives_no_picture() {
        let plot = Plot {
            title: String::new(),
            axes: [String::new(), String::new()],
            lines: Vec::new(),
        };
        assert!(plot.svg().is_none());
    }
}
