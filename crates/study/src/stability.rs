//! Linear equations about a steady motion and their stability, for a terminal and as JSON: `chetaev linearize`, `chetaev stability`.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::{Prepared, SteadyMotion, System, SystemError};
use chetaev_model::Model;
use chetaev_stability::claims::parameter_of_motion;
use chetaev_stability::eigenvalues::eigenvalues;
use chetaev_stability::hurwitz::{Boundary, Crossing, Ranges};
use chetaev_stability::linearization::LinearizationError;
use chetaev_stability::question::{Place, Question};
use chetaev_stability::real_roots::decimal;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};
use serde_json::{json, Value};
use std::fmt::Write as _;

/// Rows of the table of eigenvalues over a range.
const ROWS: usize = 11;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// The model is no system.
    #[error(transparent)]
    System(#[from] SystemError),
    /// No admissible state.
    #[error(transparent)]
    Characteristics(#[from] CharacteristicsError),
    /// No motion was named.
    #[error("the model names no steady motion: state one, as in\n\n[steady.upright]\n{example}\n\nor say --about rest or --about start")]
    NoMotion {
        /// Lines of an example with the coordinates of the model.
        example: String,
    },
    /// Several motions, and none was asked for.
    #[error("which steady motion? --about {}", names.join(" or --about "))]
    SeveralMotions {
        /// Their names.
        names: Vec<String>,
    },
    /// A name that the model does not have.
    #[error("the model names no steady motion `{name}`; known are {}", known.join(", "))]
    UnknownMotion {
        /// The name asked for.
        name: String,
        /// Those that exist.
        known: Vec<String>,
    },
    /// A parameter that the model does not have.
    #[error("`{name}` is no parameter of the model; its parameters are {}", known.join(", "))]
    UnknownParameter {
        /// The name asked for.
        name: String,
        /// Those that exist.
        known: Vec<String>,
    },
    /// A range that is none.
    #[error("`{text}` is no range: write NAME=FROM:TO with FROM below TO, as in v=0:10")]
    Range {
        /// As it was given.
        text: String,
    },
    /// The motion is not steady, or not admissible.
    #[error(transparent)]
    Linearization(#[from] LinearizationError),
}

/// A range of a parameter.
#[derive(Clone, Debug)]
pub struct Range {
    /// The parameter.
    pub symbol: Symbol,
    /// Its name.
    pub name: String,
    /// The lower end.
    pub low: Rational,
    /// The upper end.
    pub high: Rational,
}

/// What was asked, with the answer.
#[derive(Debug)]
pub struct Stability {
    /// The system.
    pub system: System,
    /// The motion.
    pub motion: SteadyMotion,
    /// Linear equations and characteristic polynomial.
    pub question: Question,
    /// The range, where one was asked for.
    pub range: Option<Range>,
    /// Stability over it; `None` where none was asked for or it was not decided.
    pub ranges: Option<Ranges>,
}

/// The linear equations about a steady motion of a model, and their stability over a range of a parameter.
///
/// `about` is the name of a motion that the model states, `rest` or `start` (positions and velocities of the initial data); `over` is
/// `NAME=FROM:TO`.
///
/// # Errors
/// [`StabilityError`].
pub fn stability(
    model: &Model,
    about: Option<&str>,
    over: Option<&str>,
) -> Result<Stability, StabilityError> {
    let system = System::from_model(model)?;
    let prepared = Prepared::new(&system)?;
    let motion = motion(model, &system, about)?;
    let range = over.map(|text| range(model, &system, text)).transpose()?;
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let free = match &range {
        Some(range) => Some(range.symbol),
        None => parameter_of_motion(&system, &motion),
    };
    let question = Question::new(&system, terms, selection, &motion, free)?;
    let ranges = range
        .as_ref()
        .and_then(|r| question.ranges(&system.graph, &r.low, &r.high));
    Ok(Stability {
        system,
        motion,
        question,
        range,
        ranges,
    })
}

fn motion(
    model: &Model,
    system: &System,
    about: Option<&str>,
) -> Result<SteadyMotion, StabilityError> {
    let names: Vec<String> = system.steady.iter().map(|s| s.name.clone()).collect();
    let of_start = |order: u32| -> Vec<Option<Expr>> {
        let value = |i: usize| {
            model
                .initial
                .values
                .get(&(i, order))
                .map(|given| given.value)
        };
        (0..system.n()).map(value).collect()
    };
    if let Some(stated) = system
        .steady
        .iter()
        .find(|s| Some(s.name.as_str()) == about)
    {
        return Ok(stated.clone());
    }
    match (about, system.steady.as_slice()) {
        (Some("start"), _) => Ok(SteadyMotion {
            name: "start".into(),
            positions: of_start(0),
            velocities: of_start(1),
        }),
        (Some("rest"), _) => Ok(chetaev_stability::steady::rest(system, "rest", of_start(0))),
        (Some(name), _) => Err(StabilityError::UnknownMotion {
            name: name.into(),
            known: names
                .into_iter()
                .chain(["rest".into(), "start".into()])
                .collect(),
        }),
        (None, [only]) => Ok(only.clone()),
        (None, []) => Err(StabilityError::NoMotion {
            example: system
                .coordinates
                .iter()
                .map(|c| format!("{} = 0", c.name))
                .collect::<Vec<_>>()
                .join("\n"),
        }),
        (None, _) => Err(StabilityError::SeveralMotions { names }),
    }
}

fn range(model: &Model, system: &System, text: &str) -> Result<Range, StabilityError> {
    let wrong = || StabilityError::Range { text: text.into() };
    let (name, ends) = text.split_once('=').ok_or_else(wrong)?;
    let (low, high) = ends.split_once(':').ok_or_else(wrong)?;
    let name = name.trim();
    if !system.parameters.iter().any(|p| p.name == name) {
        return Err(StabilityError::UnknownParameter {
            name: name.into(),
            known: system.parameters.iter().map(|p| p.name.clone()).collect(),
        });
    }
    let number = |text: &str| -> Option<Rational> {
        let (value, _) = model.constant("--over", text).ok()?;
        system.graph.as_number(value).cloned()
    };
    let (low, high) = (
        number(low).ok_or_else(wrong)?,
        number(high).ok_or_else(wrong)?,
    );
    if low < high {
        Ok(Range {
            symbol: system.graph.intern_symbol(name, 0),
            name: name.into(),
            low,
            high,
        })
    } else {
        Err(wrong())
    }
}

impl Stability {
    fn graph(&self) -> &Graph {
        &self.system.graph
    }

    /// Entries in numbers, with a value for the parameter that was left in; not a number where one has no value.
    fn numbers(&self, rows: &[Vec<Expr>], free: Option<f64>) -> Vec<Vec<f64>> {
        let g = self.graph();
        let value = |s: Symbol| free.filter(|_| Some(s) == self.question.over);
        let number = |e: &Expr| {
            g.evaluate_f64(&[*e], &value)
                .map_or(f64::NAN, |found| found[0])
        };
        rows.iter()
            .map(|row| row.iter().map(number).collect())
            .collect()
    }

    /// The eigenvalues as pairs of real and imaginary parts, at a value of the parameter that was left in.
    pub fn eigenvalues(&self, free: Option<f64>) -> Option<Vec<(f64, f64)>> {
        let linear = &self.question.linear;
        let (left, right) = (
            self.numbers(&linear.left, free),
            self.numbers(&linear.right, free),
        );
        Some(
            eigenvalues(&left, &right)?
                .iter()
                .map(|l| (l.re, l.im))
                .collect(),
        )
    }

    /// The value that the model states for the parameter that was left in.
    fn stated(&self) -> Option<f64> {
        let g = self.graph();
        let over = self.question.over?;
        let own = self
            .system
            .parameters
            .iter()
            .find(|p| g.as_symbol(p.expr) == Some(over))?;
        g.evaluate_f64(&[own.value?], &|_| None)
            .ok()
            .map(|found| found[0])
    }

    /// Linear equations, polynomial and eigenvalues as text.
    pub fn linear_text(&self) -> String {
        let g = self.graph();
        let linear = &self.question.linear;
        let mut text = self.heading();
        let _ = writeln!(
            text,
            "\nE z' = F z with z = ({}), deviations from the motion:\n",
            linear.names.join(", ")
        );
        for (name, rows) in [("E", &linear.left), ("F", &linear.right)] {
            text.push_str(&matrix(g, name, rows));
        }
        for (name, slopes) in &linear.dependent {
            let terms = linear
                .names
                .iter()
                .zip(slopes)
                .filter(|(_, e)| !g.is_zero(**e));
            let terms: Vec<String> = terms
                .map(|(own, e)| format!("({}) {own}", g.text(*e)))
                .collect();
            let sum = if terms.is_empty() {
                "0".into()
            } else {
                terms.join(" + ")
            };
            let _ = writeln!(
                text,
                "\nThe finite constraints give the deviation of {name}: {sum}"
            );
        }
        text.push_str(&self.polynomial_text());
        text.push_str(&self.eigenvalues_text());
        text
    }

    fn heading(&self) -> String {
        let linear = &self.question.linear;
        let mut text = format!(
            "{}, steady motion `{}`\n",
            self.system.name, self.motion.name
        );
        if !linear.ignorable.is_empty() {
            let _ = writeln!(
                text,
                "Ignorable, nothing depends on them: {}",
                linear.ignorable.join(", ")
            );
        }
        if linear.family > 0 {
            let _ = writeln!(
                text,
                "The motion belongs to a family of steady motions of dimension {}, proved",
                linear.family
            );
        }
        for (name, definition) in &linear.speeds {
            let written = self.graph().text(*definition);
            if *name != written {
                let _ = writeln!(text, "{name} = {written}");
            }
        }
        text
    }

    fn polynomial_text(&self) -> String {
        let g = self.graph();
        let Some(polynomial) = &self.question.polynomial else {
            return "\nThe system is too large for an exact characteristic polynomial.\n".into();
        };
        let mut text = String::from("\nCharacteristic polynomial");
        match polynomial.zeros {
            0 => {}
            1 => text.push_str(", without the zero of the family of steady motions"),
            n => {
                let _ = write!(
                    text,
                    ", without the {n} zeros of the family of steady motions"
                );
            }
        }
        text.push_str(":\n");
        let shifted = polynomial.further_zeros;
        for (power, &e) in polynomial.coefficients.iter().enumerate().rev() {
            let _ = writeln!(text, "  λ^{}: {}", power + shifted, shown(g, e));
        }
        text
    }

    fn eigenvalues_text(&self) -> String {
        let at = self.stated();
        let mut text = match (self.question.over, at) {
            (Some(symbol), Some(value)) => format!(
                "\nEigenvalues at {} = {value}:\n",
                self.graph().symbol_text(symbol)
            ),
            _ => "\nEigenvalues:\n".into(),
        };
        match self.eigenvalues(at) {
            Some(list) => list.iter().for_each(|l| {
                let _ = writeln!(text, "  {}", complex(*l));
            }),
            None => text.push_str("  not computed: a parameter has no value, or E is singular\n"),
        }
        text
    }

    /// Stability over the range as text, with a table of eigenvalues.
    pub fn ranges_text(&self) -> String {
        let mut text = self.heading();
        let Some(range) = &self.range else {
            text.push_str(&self.polynomial_text());
            text.push_str(&self.eigenvalues_text());
            return text;
        };
        let g = self.graph();
        let name = &range.name;
        text.push('\n');
        match &self.ranges {
            None => {
                let _ = writeln!(
                    text,
                    "The boundaries of stability in {name} were not enclosed."
                );
            }
            Some(ranges) => {
                for region in &ranges.regions {
                    let place = match self.question.place(g, region.is_asymptotic) {
                        Place::Left => "stable: all eigenvalues but the zeros of the family are left of the axis",
                        Place::OnAxis => "all eigenvalues on the axis and simple: linear motions stay bounded",
                        Place::Right => "unstable: an eigenvalue is right of the axis",
                    };
                    let _ = writeln!(
                        text,
                        "{} < {name} < {}: {place}",
                        decimal(&region.low),
                        decimal(&region.high)
                    );
                }
                for boundary in &ranges.boundaries {
                    let _ = writeln!(
                        text,
                        "{name} in {}: {}",
                        boundary.root.text(),
                        self.crossing(boundary)
                    );
                }
            }
        }
        let _ = writeln!(text, "\nEigenvalues");
        for (value, list) in self.table(range) {
            let list: Vec<String> = list.iter().map(|l| complex(*l)).collect();
            let _ = writeln!(text, "  {name} = {value:<8}  {}", list.join("  "));
        }
        text
    }

    fn crossing(&self, boundary: &Boundary) -> &'static str {
        match (boundary.crossing, self.question.is_even(self.graph())) {
            (Crossing::Zero, _) => "an eigenvalue passes through zero",
            (Crossing::Pair, false) => "a pair of eigenvalues passes the imaginary axis",
            (Crossing::Pair | Crossing::Touching, true) => "two pairs of eigenvalues meet",
            (Crossing::Infinity, _) => "an eigenvalue goes to infinity",
            (Crossing::Touching, false) => {
                "a determinant of Hurwitz vanishes, and the stability does not change by it"
            }
        }
    }

    fn table(&self, range: &Range) -> Vec<(f64, Vec<(f64, f64)>)> {
        let low = range.low.to_f64().value();
        let high = range.high.to_f64().value();
        let at = |row: usize| low + (high - low) * row as f64 / (ROWS - 1) as f64;
        let rows = (0..ROWS).map(|row| (at(row), self.eigenvalues(Some(at(row)))));
        rows.filter_map(|(value, list)| Some((value, list?)))
            .collect()
    }

    /// The answer as JSON: variables, matrices as exact text, polynomial, eigenvalues, and over a range `critical` and `regions`.
    pub fn json(&self) -> Value {
        let g = self.graph();
        let linear = &self.question.linear;
        let exact = |rows: &[Vec<Expr>]| -> Value {
            let row = |row: &Vec<Expr>| row.iter().map(|&e| g.text(e)).collect::<Vec<_>>();
            json!(rows.iter().map(row).collect::<Vec<_>>())
        };
        let pairs = |list: Vec<(f64, f64)>| {
            list.iter()
                .map(|(re, im)| json!([re, im]))
                .collect::<Vec<_>>()
        };
        let polynomial = self.question.polynomial.as_ref().map(|p| {
            json!({
                "coefficients": p.coefficients.iter().map(|&e| g.text(e)).collect::<Vec<_>>(),
                "zeros_of_family": p.zeros,
                "further_zeros": p.further_zeros,
            })
        });
        let mut value = json!({
            "system": self.system.name,
            "motion": self.motion.name,
            "variables": linear.names,
            "ignorable": linear.ignorable,
            "family": linear.family,
            "E": exact(&linear.left),
            "F": exact(&linear.right),
            "characteristic_polynomial": polynomial,
            "eigenvalues": self.eigenvalues(self.stated()).map(pairs),
        });
        if let Some(range) = &self.range {
            value["parameter"] = json!(range.name);
            value["critical"] = match &self.ranges {
                None => Value::Null,
                Some(ranges) => ranges
                    .boundaries
                    .iter()
                    .map(|b| self.critical(&range.name, b))
                    .collect(),
            };
            value["regions"] = match &self.ranges {
                None => Value::Null,
                Some(ranges) => {
                    let region = |r: &chetaev_stability::hurwitz::Region| {
                        let place = match self.question.place(g, r.is_asymptotic) {
                            Place::Left => "asymptotic",
                            Place::OnAxis => "spectral",
                            Place::Right => "unstable",
                        };
                        json!({"from": r.low.to_f64().value(), "to": r.high.to_f64().value(), "stability": place})
                    };
                    ranges.regions.iter().map(region).collect()
                }
            };
            let table = self.table(range).into_iter();
            value["table"] = table
                .map(|(at, list)| json!({"value": at, "eigenvalues": pairs(list)}))
                .collect();
        }
        value
    }

    fn critical(&self, name: &str, boundary: &Boundary) -> Value {
        let (low, high) = boundary.root.decimal_bounds();
        let kind = match (boundary.crossing, self.question.is_even(self.graph())) {
            (Crossing::Zero, _) => "zero",
            (Crossing::Pair, false) => "pair",
            (Crossing::Pair | Crossing::Touching, true) => "collision",
            (Crossing::Infinity, _) => "infinity",
            (Crossing::Touching, false) => "touching",
        };
        let middle = (&boundary.root.low + &boundary.root.high) / Rational::from(2);
        json!({"parameter": name, "value": middle.to_f64().value(), "enclosure": [low, high], "kind": kind})
    }
}

fn complex((re, im): (f64, f64)) -> String {
    let re = if re == 0.0 { 0.0 } else { re };
    if im == 0.0 {
        format!("{re:.6}")
    } else {
        format!("{re:.6}{im:+.6}i")
    }
}

/// An exact entry, with its value behind it where it is a long number.
fn shown(g: &Graph, e: Expr) -> String {
    let exact = g.text(e);
    let is_plain = exact.len() <= 24 || !g.symbols_in(&[e]).is_empty();
    match g.evaluate_f64(&[e], &|_| None) {
        Ok(value) if !is_plain => format!("{}", value[0]),
        _ => exact,
    }
}

/// A matrix in columns.
fn matrix(g: &Graph, name: &str, rows: &[Vec<Expr>]) -> String {
    let entries: Vec<Vec<String>> = rows
        .iter()
        .map(|row| row.iter().map(|&e| shown(g, e)).collect())
        .collect();
    let columns = entries.first().map_or(0, Vec::len);
    let width = |c: usize| {
        entries
            .iter()
            .map(|row| row[c].chars().count())
            .max()
            .unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for (r, row) in entries.iter().enumerate() {
        let head = if r == 0 {
            format!("  {name} = ")
        } else {
            " ".repeat(name.len() + 5)
        };
        let cells: Vec<String> = row
            .iter()
            .zip(&widths)
            .map(|(cell, w)| format!("{cell:>w$}", w = *w))
            .collect();
        let _ = writeln!(text, "{head}[{}]", cells.join("  "));
    }
    text
}
