//! A curve of steady motions or orbits as a picture: the variables over the parameter, and how fast neighbours depart.

use super::text::{word, ON_CIRCLE};
use super::Followed;
use crate::axes::{document, Axes};
use crate::decimals::{real, KNOWN};
use chetaev_orbits::branch::Point;
use chetaev_report::escaped;
use std::fmt::Write as _;

/// Lines that are told apart by their colors.
const COLORS: [&str; 6] = [
    "#1f5fa8", "#d98a2b", "#2a7039", "#b3261e", "#6d4aa0", "#777777",
];
/// Parts of an axis beyond what is drawn.
const MARGIN: f64 = 0.06;
/// A curve that is as flat, in parts of the largest value, is drawn where all values are.
const FLAT: f64 = 1e-9;

impl Followed {
    /// Variables, or periods of orbits, over the parameter, below them the eigenvalues, or the moduli of the multipliers, with
    /// the special points named; unstable motions are drawn broken. `None` without a range.
    pub fn picture(&self) -> Option<String> {
        let range = self.range.as_ref()?;
        let x = (range.low.to_f64().value(), range.high.to_f64().value());
        let mut special: Vec<(f64, String)> = self
            .branch
            .special
            .iter()
            .map(|own| (own.point.parameter, word(own.kind)))
            .map(|(at, kind)| (at, format!("{kind} {}", real(at, 6))))
            .collect();
        special.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut states: Vec<(String, Vec<f64>)> = self
            .variables
            .iter()
            .enumerate()
            .map(|(i, name)| {
                let own = self.branch.points.iter().map(|own| own.unknowns[i]);
                let own = own.map(|x| if x.abs() < KNOWN { 0.0 } else { x });
                (name.clone(), own.collect())
            })
            .collect();
        if self.is_orbit {
            states = vec![("period".into(), self.periods.clone())];
        }
        let title = format!(
            "{} of {} from {} over {}",
            if self.is_orbit {
                "Periodic orbits"
            } else {
                "Steady motions"
            },
            self.name,
            self.about,
            range.name
        );
        let upper = self.curves(x, &states, &special, &range.name);
        let lower = self.spectra(x, &special, &range.name);
        Some(document(&title, &[upper, lower]))
    }

    /// Curves over the parameter.
    fn curves(
        &self,
        x: (f64, f64),
        states: &[(String, Vec<f64>)],
        special: &[(f64, String)],
        name: &str,
    ) -> String {
        let points = &self.branch.points;
        let axes = Axes {
            x,
            y: ends(states.iter().flat_map(|own| own.1.iter().copied())),
        };
        let mut inside = String::new();
        for (i, (_, values)) in states.iter().enumerate() {
            let color = COLORS[i % COLORS.len()];
            let places = points.iter().zip(values);
            let places: Vec<(bool, (f64, f64))> = places
                .map(|(own, y)| (self.is_unstable(own), axes.at(own.parameter, *y)))
                .collect();
            // A piece has the kind of the point at which it ends.
            for piece in pieces(&places) {
                let broken = if piece.0 {
                    " stroke-dasharray=\"7 5\""
                } else {
                    ""
                };
                let line: Vec<String> = piece
                    .1
                    .iter()
                    .map(|(x, y)| format!("{x:.1},{y:.1}"))
                    .collect();
                let _ = write!(inside, "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"{broken}/>", line.join(" "));
            }
        }
        inside.push_str(&axes.lines(special));
        for own in &self.branch.special {
            for (i, (_, values)) in states.iter().enumerate() {
                let y = if self.is_orbit {
                    nearest(points, values, own.point.parameter)
                } else {
                    own.point.unknowns.get(i).copied()
                };
                let Some((x, y)) = y.map(|y| axes.at(own.point.parameter, y)) else {
                    continue;
                };
                let _ = write!(
                    inside,
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{}\"/>",
                    COLORS[i % COLORS.len()]
                );
            }
        }
        let (left, _) = axes.at(x.0, axes.y.0);
        let (_, above) = axes.at(x.0, axes.y.1);
        let mut at = left + 8.0;
        for (i, (own, _)) in states.iter().enumerate() {
            let color = COLORS[i % COLORS.len()];
            let _ = write!(inside, "<path d=\"M{at:.1} {:.1}h18\" stroke=\"{color}\" stroke-width=\"2\"/><text x=\"{:.1}\" y=\"{:.1}\">{}</text>", above - 8.0, at + 23.0, above - 4.0, escaped(own));
            at += 42.0 + 9.0 * own.chars().count() as f64;
        }
        let what = if self.is_orbit {
            "period (unstable broken)"
        } else {
            "motion (unstable broken)"
        };
        axes.panel([name, what], &inside)
    }

    /// Real and imaginary parts of eigenvalues, or moduli of multipliers, over the parameter.
    fn spectra(&self, x: (f64, f64), special: &[(f64, String)], name: &str) -> String {
        let (border, what) = if self.is_orbit {
            (1.0, "moduli of the multipliers")
        } else {
            (0.0, "real parts (blue), imaginary parts (orange)")
        };
        let real_parts = self.ordered(|own, i| {
            let l = own.spectrum.values[i];
            let (value, error) = if self.is_orbit {
                (l.norm(), ON_CIRCLE)
            } else {
                (l.re, own.spectrum.errors.get(i).copied().unwrap_or(0.0))
            };
            // What is on the border to its error is drawn there.
            if (value - border).abs() <= error {
                border
            } else {
                value
            }
        });
        let imaginary = if self.is_orbit {
            Vec::new()
        } else {
            self.ordered(|own, i| own.spectrum.values[i].im.max(0.0))
        };
        let values = real_parts.iter().chain(&imaginary).flat_map(|own| &own.1);
        let axes = Axes {
            x,
            y: ends(values.copied().chain([border])),
        };
        let (x0, y0) = axes.at(x.0, border);
        let (x1, _) = axes.at(x.1, border);
        let mut inside = format!("<path d=\"M{x0:.1} {y0:.1}H{x1:.1}\" stroke=\"#999\"/>");
        // Of real eigenvalues there are no imaginary parts to draw.
        for (places, is_drawn_at_zero, color) in [
            (&imaginary, false, COLORS[1]),
            (&real_parts, true, COLORS[0]),
        ] {
            let most = places.iter().map(|own| own.1.len()).max().unwrap_or(0);
            let mut path = String::new();
            for i in 0..most {
                let line = places
                    .iter()
                    .filter_map(|own| Some((own.0, *own.1.get(i)?)));
                let line: Vec<(f64, f64)> = line.collect();
                let mut is_open = false;
                for pair in line.windows(2) {
                    let [a, b] = [pair[0], pair[1]];
                    let is_drawn = is_drawn_at_zero || a.1 != 0.0 || b.1 != 0.0;
                    if is_drawn {
                        let (from, to) = (axes.at(a.0, a.1), axes.at(b.0, b.1));
                        if !is_open {
                            let _ = write!(path, "M{:.1} {:.1}", from.0, from.1);
                        }
                        let _ = write!(path, "L{:.1} {:.1}", to.0, to.1);
                    }
                    is_open = is_drawn;
                }
            }
            let _ = write!(
                inside,
                "<path d=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>"
            );
        }
        inside.push_str(&axes.lines(special));
        axes.panel([name, what], &inside)
    }

    /// Numbers of the eigenvalues at each point, ascending: one curve for each place in the order, as they pass each other where they meet.
    fn ordered(&self, number: impl Fn(&Point, usize) -> f64) -> Vec<(f64, Vec<f64>)> {
        let of_point = |own: &Point| {
            let mut all: Vec<f64> = (0..own.spectrum.values.len())
                .map(|i| number(own, i))
                .collect();
            all.sort_by(f64::total_cmp);
            (own.parameter, all)
        };
        self.branch.points.iter().map(of_point).collect()
    }

    fn is_unstable(&self, own: &Point) -> bool {
        self.stability(own) == "unstable"
    }
}

/// The ends of an axis around values.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let finite = values.filter(|own| own.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), own| {
        (a.min(own), b.max(own))
    });
    if low > high {
        return (-1.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    let margin = if high - low > FLAT * size {
        MARGIN * (high - low)
    } else {
        size.max(1.0) / 2.0
    };
    (low - margin, high + margin)
}

/// What is drawn alike, in one piece each; pieces hang together.
fn pieces(places: &[(bool, (f64, f64))]) -> Vec<(bool, Vec<(f64, f64)>)> {
    let mut found: Vec<(bool, Vec<(f64, f64)>)> = Vec::new();
    for &(kind, place) in places {
        match found.last_mut() {
            Some(last) if last.0 == kind => last.1.push(place),
            Some(last) => {
                last.1.push(place);
                found.push((kind, vec![place]));
            }
            None => found.push((kind, vec![place])),
        }
    }
    found
}

/// The value at the point whose parameter is nearest.
fn nearest(points: &[Point], values: &[f64], at: f64) -> Option<f64> {
    let distance = |own: &Point| (own.parameter - at).abs();
    let both = points.iter().zip(values);
    let nearest = both.min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)));
    nearest.map(|own| *own.1)
}
