//! A curve of steady motions or orbits in words and as JSON.

use super::Followed;
use crate::decimals::{of_state, real, Decimals};
use chetaev_orbits::branch::{End, Kind, Point, Special};
use chetaev_orbits::multipliers::Spectrum;
use serde_json::{json, Value};
use std::fmt::Write as _;

/// Rows of the table.
const ROWS: usize = 12;
/// Multipliers nearer to the circle may be on it.
pub(super) const ON_CIRCLE: f64 = 1e-7;

impl Followed {
    /// What was found in words.
    pub fn text(&self) -> String {
        let what = if self.is_orbit {
            "periodic orbits"
        } else {
            "steady motions"
        };
        let mut text = format!("{}, {what} from `{}`", self.name, self.about);
        if let Some(range) = &self.range {
            let _ = write!(
                text,
                " over {} = {} to {}",
                range.name,
                range.low.to_f64().value(),
                range.high.to_f64().value()
            );
        }
        text.push_str(", in numbers: nothing here is proved\n");
        if !self.ignorable.is_empty() {
            let _ = writeln!(
                text,
                "Ignorable, nothing depends on them: {}",
                self.ignorable.join(", ")
            );
        }
        for defined in &self.defined {
            let _ = writeln!(text, "{defined}");
        }
        self.structure(&mut text);
        for special in &self.branch.special {
            let _ = writeln!(text, "{}", self.special_text(special));
        }
        text.push('\n');
        let count = self.branch.points.len();
        let step = count.div_ceil(ROWS).max(1);
        let last = count.saturating_sub(1);
        for (at, point) in self.branch.points.iter().enumerate() {
            if at % step == 0 || at == last {
                let _ = writeln!(text, "{}", self.row(at, point));
            }
        }
        if let (Some(range), [a, b]) = (&self.range, self.branch.ends) {
            let both = if a == End::Closed {
                vec![a]
            } else {
                vec![a, b]
            };
            for end in both.into_iter().filter(|end| *end != End::Range) {
                let _ = writeln!(text, "{}", ending(end, &range.name));
            }
        }
        text
    }

    /// The eigenvalues that structure gives.
    fn structure(&self, text: &mut String) {
        let Some(first) = self.branch.points.first() else {
            return;
        };
        let trivial = &first.spectrum.trivial;
        let (word, value) = if self.is_orbit {
            ("multiplier", 1)
        } else {
            ("eigenvalue", 0)
        };
        match trivial.len() {
            0 => {}
            1 => {
                let _ = writeln!(
                    text,
                    "One {word} is {value} by structure, of {}",
                    trivial[0]
                );
            }
            n => {
                // A family of several dimensions is named once.
                let mut names = trivial.clone();
                names.dedup();
                let _ = writeln!(
                    text,
                    "{n} {word}s are {value} by structure: of {}",
                    names.join(", ")
                );
            }
        }
        if self.branch.family > 0 && self.range.is_some() {
            let _ = writeln!(
                text,
                "The family at one value has dimension {}; it is cut across",
                self.branch.family
            );
        }
        text.push('\n');
    }

    fn special_text(&self, special: &Special) -> String {
        let name = self.range.as_ref().map_or("", |range| &range.name);
        let (at, first) = (
            special.point.parameter,
            if self.is_orbit {
                "a multiplier passes 1"
            } else {
                "an eigenvalue passes through zero"
            },
        );
        let what = match special.kind {
            Kind::Fold => format!("fold: the curve turns back, {first}"),
            Kind::Pitchfork => {
                "branch point: the curve turns back where another one crosses it, as at a pitchfork"
                    .into()
            }
            Kind::Infinity => {
                "an eigenvalue goes to infinity and comes back from its other side".into()
            }
            Kind::BranchPoint => format!("branch point: {first}, and the curve goes on"),
            Kind::Hopf {
                frequency,
                first_lyapunov: Ok(own),
            } => hopf(frequency, own),
            Kind::Hopf {
                frequency,
                first_lyapunov: Err(why),
            } => format!(
                "Hopf point: a pair passes the imaginary axis with frequency {}; {why}",
                real(frequency, 9)
            ),
            Kind::PeriodDoubling => "period doubling: a multiplier passes -1".into(),
            Kind::Torus { angle } => {
                format!("a pair of multipliers passes the unit circle at the angle {angle:.9}")
            }
        };
        format!("{name} = {at:.12}: {what}")
    }

    fn row(&self, at: usize, point: &Point) -> String {
        let head = self.range.as_ref().map_or(String::new(), |range| {
            format!("{} = {:<10}", range.name, real(point.parameter, 6))
        });
        let values = self.variables.iter().zip(&point.unknowns);
        let values: Vec<String> = values
            .map(|(name, x)| format!("{name} = {}", of_state(*x, 6)))
            .collect();
        let period = self
            .periods
            .get(at)
            .map_or(String::new(), |t| format!("  period {}", real(*t, 9)));
        let own = point.spectrum.values.iter();
        let own: Vec<(f64, f64)> = own.map(|l| (l.re, l.im)).collect();
        let decimals = Decimals::of(own.iter().copied());
        // A multiplier that is smaller than its error has no digit.
        let known = own.into_iter().zip(&point.spectrum.errors);
        let own: Vec<String> = known
            .map(|(l, &error)| {
                if self.is_orbit && l.0.hypot(l.1) < error {
                    format!("below {error:.0e}")
                } else {
                    decimals.known(l, error)
                }
            })
            .collect();
        let word = if self.is_orbit {
            "multipliers"
        } else {
            "eigenvalues"
        };
        let list = if own.is_empty() {
            String::new()
        } else {
            format!("  {word} {}", own.join("  "))
        };
        format!(
            "{head}  {}{period}{list}  {}",
            values.join("  "),
            self.stability(point)
        )
    }

    /// Where the eigenvalues lie that structure does not give.
    pub(super) fn stability(&self, point: &Point) -> &'static str {
        let values = &point.spectrum.values;
        if values.is_empty() {
            "all by structure"
        } else if self.is_orbit {
            let beyond = values.iter().map(|l| (l.norm() - 1.0, ON_CIRCLE));
            border(&beyond.collect::<Vec<_>>())
        } else {
            where_eigenvalues_lie(&point.spectrum)
        }
    }

    /// What was found as JSON.
    pub fn json(&self) -> Value {
        let point = |own: &Point| {
            let pairs = own.spectrum.values.iter().map(|l| json!([l.re, l.im]));
            json!({
                "value": own.parameter,
                "state": own.unknowns[..self.variables.len()],
                "eigenvalues": pairs.collect::<Vec<_>>(),
                "errors": own.spectrum.errors,
                "stability": self.stability(own),
            })
        };
        let points = self.branch.points.iter().enumerate().map(|(at, own)| {
            let mut value = point(own);
            if let Some(period) = self.periods.get(at) {
                value["period"] = json!(period);
            }
            value
        });
        let special = self.branch.special.iter().map(|own| {
            let mut value = point(&own.point);
            value["kind"] = json!(word(own.kind));
            match own.kind {
                Kind::Hopf {
                    frequency,
                    first_lyapunov,
                } => {
                    value["frequency"] = json!(frequency);
                    value["first_lyapunov"] = json!(first_lyapunov.ok());
                    if let Err(why) = first_lyapunov {
                        value["undecided"] = json!(why.to_string());
                    }
                }
                Kind::Torus { angle } => value["angle"] = json!(angle),
                _ => {}
            }
            value
        });
        let first = self.branch.points.first();
        json!({
            "system": self.name,
            "motion": self.about,
            "kind": if self.is_orbit { "orbits" } else { "steady" },
            "method": if self.is_orbit { "shooting by Taylor series, pseudo-arclength" } else { "pseudo-arclength" },
            "evidence": "numerical",
            "parameter": self.range.as_ref().map(|range| range.name.clone()),
            "variables": self.variables,
            "ignorable": self.ignorable,
            "defined": self.defined,
            "family": self.branch.family,
            "trivial": first.map(|own| own.spectrum.trivial.clone()),
            "points": points.collect::<Vec<_>>(),
            "special": special.collect::<Vec<_>>(),
            "ends": self.branch.ends.map(|end| match end {
                End::Range => "range",
                End::Points => "points",
                End::Lost => "lost",
                End::Closed => "closed",
                End::Steady => "steady",
            }),
        })
    }
}

/// What eigenvalues say that structure does not give: on which side of the axis they lie for certain.
pub(crate) fn where_eigenvalues_lie(spectrum: &Spectrum) -> &'static str {
    let all = spectrum.values.iter().zip(&spectrum.errors);
    border(&all.map(|(l, &error)| (l.re, error)).collect::<Vec<_>>())
}

/// By how far values are beyond a border, each with its error.
fn border(all: &[(f64, f64)]) -> &'static str {
    if all.iter().any(|(beyond, error)| beyond > error) {
        "unstable"
    } else if all.iter().all(|(beyond, error)| *beyond < -error) {
        "stable"
    } else {
        "linearly on the border"
    }
}

/// A Hopf point with what is born there.
pub(crate) fn hopf(frequency: f64, coefficient: f64) -> String {
    if coefficient == 0.0 {
        return format!("Hopf point: a pair passes the imaginary axis with frequency {}; the first Lyapunov coefficient vanishes to rounding, and decides nothing of orbits", real(frequency, 9));
    }
    let kind = if coefficient < 0.0 {
        "supercritical"
    } else {
        "subcritical"
    };
    format!("Hopf point: a pair passes the imaginary axis with frequency {}; the first Lyapunov coefficient is {}: {kind}", real(frequency, 9), real(coefficient, 9))
}

pub(super) fn word(kind: Kind) -> &'static str {
    match kind {
        Kind::Fold => "fold",
        Kind::BranchPoint => "branch point",
        Kind::Pitchfork => "pitchfork",
        Kind::Infinity => "infinity",
        Kind::Hopf { .. } => "Hopf",
        Kind::PeriodDoubling => "period doubling",
        Kind::Torus { .. } => "torus",
    }
}

fn ending(end: End, name: &str) -> String {
    match end {
        End::Range => String::new(),
        End::Points => format!("The curve goes on: more points by --points, or a narrower range of {name}."),
        End::Closed => "The curve is closed: it comes back to its start.".into(),
        End::Steady => "The curve ends where the orbit shrinks to a steady motion, as at a Hopf point.".into(),
        End::Lost => "The curve ends where no next point was found: the equations have no value beyond, it branches, or an orbit shrinks to a steady motion.".into(),
    }
}
