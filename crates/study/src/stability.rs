//! Linear equations about a steady motion and their stability, for a terminal and as JSON: `chetaev linearize`, `chetaev stability`.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

use crate::state_space::{latex, Matrices};
use chetaev_mechanics::characteristics::CharacteristicsError;
use chetaev_mechanics::system::QuasiVelocity;
use chetaev_mechanics::{Prepared, Selection, SteadyMotion, System, SystemError};
use chetaev_model::{Diagnostics, Model};
use chetaev_stability::eigenvalues::{eigenvalues, mode, Complex};
use chetaev_stability::expansion::Expansion;
use chetaev_stability::hurwitz::{Boundary, Crossing, Ranges};
use chetaev_stability::linearization::LinearizationError;
use chetaev_stability::multiplicity::defects;
use chetaev_stability::parts::Parts;
use chetaev_stability::question::{parameter_of_motion, values_but, Place, Question};
use chetaev_stability::real_roots::decimal;
use chetaev_stability::reduction::Speeds;
use chetaev_stability::spectrum::expression;
use chetaev_stability::state_space::{StateSpace, StateSpaceError};
use chetaev_symbolic::factors::coefficients;
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};
use serde_json::{json, Value};
use std::fmt::Write as _;

/// Eigenvalues that differ by less, in parts of the largest, are one for the table of modes.
const SAME: f64 = 1e-9;

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
    /// Speeds that are no choice of independent ones.
    #[error("{text}: name {needed} speeds, velocities or functions linear in them, as in --speeds \"{example}\"")]
    Speeds {
        /// As it was given.
        text: String,
        /// k.
        needed: usize,
        /// Velocities that could be named.
        example: String,
    },
    /// An expression that could not be read.
    #[error("{0}")]
    Expression(Diagnostics),
    /// The motion is not steady, or not admissible.
    #[error(transparent)]
    Linearization(#[from] LinearizationError),
    /// The mass matrix is singular, or an output is no function of the variables.
    #[error(transparent)]
    StateSpace(#[from] StateSpaceError),
}

/// What is asked of a model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// A motion that the model names, `rest` or `start` (positions and velocities of the initial data); the only one, or the start, where
    /// that is steady, without it.
    pub about: Option<&'a str>,
    /// `NAME=FROM:TO`.
    pub over: Option<&'a str>,
    /// Independent speeds, separated by commas: velocities, or functions linear in them.
    pub speeds: Option<&'a str>,
    /// Outputs, separated by commas: functions of coordinates, velocities and controls.
    pub outputs: Option<&'a str>,
    /// Whether all parameters stay symbols.
    pub symbolic: bool,
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

/// An eigenvalue with its vector, complex numbers as pairs of real and imaginary parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// λ.
    pub eigenvalue: (f64, f64),
    /// z, of length 1, its largest entry real and positive.
    pub vector: Vec<(f64, f64)>,
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
    /// The equations in state space.
    pub space: StateSpace,
    /// Their parts of second order, where there are such.
    pub parts: Option<Parts>,
}

/// The linear equations about a steady motion of a model, and their stability over a range of a parameter.
///
/// # Errors
/// [`StabilityError`].
pub fn stability(model: &Model, wanted: &Wanted<'_>) -> Result<Stability, StabilityError> {
    let mut system = System::from_model(model)?;
    let prepared = Prepared::new(&system)?;
    let (terms, mut selection) = (&prepared.terms, prepared.selection.clone());
    let speeds = match wanted.speeds {
        Some(text) => in_speeds(model, &mut system, &mut selection, text)?,
        None => Speeds::Suitable,
    };
    let outputs = match wanted.outputs {
        Some(text) => list(model, text)?,
        None => Vec::new(),
    };
    let range = wanted
        .over
        .map(|text| range(model, &system, text))
        .transpose()?;
    let motions = motions(model, &system, wanted.about)?;
    let mut problem = None;
    for motion in &motions {
        let free = match &range {
            Some(range) => Some(range.symbol),
            None if wanted.symbolic => None,
            None => parameter_of_motion(&system, motion),
        };
        let values = if wanted.symbolic && range.is_none() {
            Vec::new()
        } else {
            values_but(&system, free)
        };
        match Expansion::in_speeds(&system, terms, &selection, motion, (&values, speeds)) {
            Ok(about) => {
                let question = Question::about(&about, free);
                let space = about.state_space(&question.linear, &outputs)?;
                let ranges = range
                    .as_ref()
                    .and_then(|r| question.ranges(&system.graph, &r.low, &r.high))
                    .map(|found| found.joined());
                return Ok(Stability {
                    motion: motion.clone(),
                    parts: Parts::of(&system.graph, &question.linear),
                    question,
                    range,
                    ranges,
                    space,
                    system,
                });
            }
            Err(own) => problem = Some(own),
        }
    }
    match problem {
        Some(own) if wanted.about.is_some() || !system.steady.is_empty() => Err(own.into()),
        _ => Err(StabilityError::NoMotion {
            example: example(&system, " = 0", "\n"),
        }),
    }
}

/// Coordinates with something behind each.
fn example(system: &System, behind: &str, between: &str) -> String {
    let coordinates = system.coordinates.iter();
    let all: Vec<String> = coordinates.map(|c| format!("{}{behind}", c.name)).collect();
    all.join(between)
}

/// Expressions separated by commas, each with its text.
fn list(model: &Model, text: &str) -> Result<Vec<(String, Expr)>, StabilityError> {
    let read = |part: &str| {
        let e = model.expression(part).map_err(StabilityError::Expression)?;
        Ok((part.trim().to_owned(), e))
    };
    text.split(',').map(read).collect()
}

/// Makes the speeds of choice independent: velocities by the selection, others as quasi-velocities of the system.
fn in_speeds(
    model: &Model,
    system: &mut System,
    selection: &mut Selection,
    text: &str,
) -> Result<Speeds, StabilityError> {
    let all = list(model, text)?;
    let needed = system.n() - selection.rows.len();
    if all.len() != needed {
        let independent = selection.independent(system.n());
        let names: Vec<String> = independent
            .iter()
            .map(|&j| format!("{}'", system.coordinates[j].name))
            .collect();
        return Err(StabilityError::Speeds {
            text: format!("`{text}` names {} speeds", all.len()),
            needed,
            example: names.join(", "),
        });
    }
    let place = |(_, e): &(String, Expr)| system.coordinates.iter().position(|c| c.v == *e);
    if let Some(velocities) = all.iter().map(place).collect::<Option<Vec<usize>>>() {
        let others = (0..system.n()).filter(|j| !velocities.contains(j));
        selection.dependent = others.collect();
        return Ok(Speeds::Independent);
    }
    let own = all.into_iter();
    system.quasi_velocities = own
        .map(|(name, definition)| QuasiVelocity { name, definition })
        .collect();
    system.frame = None;
    Ok(Speeds::Suitable)
}

/// The motions that are looked at, the first one that is steady being taken.
fn motions(
    model: &Model,
    system: &System,
    about: Option<&str>,
) -> Result<Vec<SteadyMotion>, StabilityError> {
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
    let start = || SteadyMotion {
        name: "start".into(),
        positions: of_start(0),
        velocities: of_start(1),
    };
    if let Some(stated) = system
        .steady
        .iter()
        .find(|s| Some(s.name.as_str()) == about)
    {
        return Ok(vec![stated.clone()]);
    }
    match (about, system.steady.as_slice()) {
        (Some("start"), _) | (None, []) => Ok(vec![start()]),
        (Some("rest"), _) => Ok(vec![chetaev_stability::steady::rest(
            system,
            "rest",
            of_start(0),
        )]),
        (Some(name), _) => Err(StabilityError::UnknownMotion {
            name: name.into(),
            known: names
                .into_iter()
                .chain(["rest".into(), "start".into()])
                .collect(),
        }),
        (None, [only]) => Ok(vec![only.clone()]),
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
        let stated = self.system.parameter_values();
        let stated: Vec<(Symbol, f64)> = stated
            .into_iter()
            .filter_map(|(s, e)| Some((g.as_symbol(s)?, g.evaluate_f64(&[e], &|_| None).ok()?[0])))
            .collect();
        let value = |s: Symbol| {
            if Some(s) == self.question.over {
                free
            } else {
                stated
                    .iter()
                    .find(|(own, _)| *own == s)
                    .map(|(_, value)| *value)
            }
        };
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
        text.push_str(&self.space_text());
        text.push_str(&self.parts_text());
        text.push_str(&self.polynomial_text());
        text.push_str(&self.modes_text());
        text
    }

    /// A, B, C, D as text, with what inputs reach and outputs show, and the transfer functions.
    fn space_text(&self) -> String {
        let (g, space) = (self.graph(), &self.space);
        let mut text = String::from("\nz' = A z + B u, y = C z + D u");
        let _ = writeln!(
            text,
            " with u = ({}), y = ({}):\n",
            space.inputs.join(", "),
            space.outputs.join(", ")
        );
        text.push_str(&matrix(g, "A", &space.a));
        if space.inputs.is_empty() && space.outputs == space.states {
            return text;
        }
        for (name, rows) in [("B", &space.b), ("C", &space.c), ("D", &space.d)] {
            if rows.iter().any(|row| !row.is_empty()) {
                text.push_str(&matrix(g, name, rows));
            }
        }
        let n = space.states.len();
        let (reached, seen) = space.ranks(g);
        if !space.inputs.is_empty() {
            let _ = writeln!(
                text,
                "\nThe inputs reach {reached} of {n} dimensions, the outputs show {seen}"
            );
        }
        for (output, row) in space
            .outputs
            .iter()
            .zip(space.transfer(g).unwrap_or_default())
        {
            for (input, e) in space.inputs.iter().zip(row) {
                let _ = writeln!(text, "  {output}/{input} = {}", shown(g, e));
            }
        }
        text
    }

    /// The parts of second order that do not vanish.
    fn parts_text(&self) -> String {
        let Some(parts) = &self.parts else {
            return String::new();
        };
        let g = self.graph();
        let mut text = format!(
            "\nM q'' + (D + G) q' + (K + N) q = 0 with q = ({}); mass, damping, gyroscopic, stiffness, circulatory:\n\n",
            parts.names.join(", ")
        );
        for (name, rows) in named_parts(parts) {
            if rows.iter().flatten().any(|&e| !g.is_zero(e)) {
                text.push_str(&matrix(g, name, rows));
            }
        }
        text
    }

    /// Eigenvalues, each with its mode, and the chains of those on the axis that are not semisimple.
    fn modes_text(&self) -> String {
        let mut text = self.eigenvalues_text();
        let list = defects(self.graph(), &self.question, None).unwrap_or_default();
        for own in &list {
            let what = if own.factor.is_some() {
                "an imaginary pair"
            } else {
                "zero"
            };
            let _ = writeln!(
                text,
                "A Jordan block: {what} has multiplicity {} and {} eigenvectors",
                own.multiplicity, own.chains
            );
        }
        let modes = self.modes();
        if !modes.is_empty() {
            let _ = writeln!(text, "\nModes ({}):", self.question.linear.names.join(", "));
        }
        for Mode { eigenvalue, vector } in modes {
            let vector: Vec<String> = vector.into_iter().map(complex).collect();
            let _ = writeln!(text, "  {}: ({})", complex(eigenvalue), vector.join(", "));
        }
        text
    }

    /// Eigenvalues with imaginary part zero or positive, each with its mode; none where a parameter has no value.
    pub fn modes(&self) -> Vec<Mode> {
        let (at, linear) = (self.stated(), &self.question.linear);
        let (left, right) = (
            self.numbers(&linear.left, at),
            self.numbers(&linear.right, at),
        );
        let found = eigenvalues(&left, &right).unwrap_or_default();
        let mut found: Vec<Complex<f64>> = found.into_iter().filter(|l| l.im >= 0.0).collect();
        // Of eigenvalues that are the same to rounding one is shown.
        let size = found
            .iter()
            .map(|l| l.norm())
            .fold(f64::MIN_POSITIVE, f64::max);
        found.dedup_by(|a, b| (*a - *b).norm() <= SAME * size);
        let pair = |l: &Complex<f64>| (l.re, l.im);
        let with_mode = |l: Complex<f64>| {
            let mode = mode(&left, &right, l)?;
            Some(Mode {
                eigenvalue: pair(&l),
                vector: mode.iter().map(pair).collect(),
            })
        };
        found.into_iter().filter_map(with_mode).collect()
    }

    /// All matrices in numbers, for other programs.
    pub fn matrices(&self) -> Matrices {
        let (space, at) = (&self.space, self.stated());
        let (n, m) = (space.states.len(), space.inputs.len());
        let mut matrices: Vec<(String, Vec<Vec<f64>>, usize)> = [
            ("A", &space.a, n),
            ("B", &space.b, m),
            ("C", &space.c, n),
            ("D", &space.d, m),
        ]
        .into_iter()
        .map(|(name, rows, columns)| (name.to_owned(), self.numbers(rows, at), columns))
        .collect();
        for (name, rows) in self.parts.iter().flat_map(named_parts) {
            matrices.push((format!("{name}_second"), self.numbers(rows, at), rows.len()));
        }
        Matrices {
            matrices,
            names: vec![
                ("states".into(), space.states.clone()),
                ("inputs".into(), space.inputs.clone()),
                ("outputs".into(), space.outputs.clone()),
            ],
            title: format!(
                "{}, linear equations about the steady motion {}",
                self.system.name, self.motion.name
            ),
        }
    }

    /// The exact matrices as LaTeX.
    pub fn latex(&self) -> String {
        let (linear, space) = (&self.question.linear, &self.space);
        let mut all: Vec<(&str, &[Vec<Expr>])> = vec![
            ("E", &linear.left),
            ("F", &linear.right),
            ("A", &space.a),
            ("B", &space.b),
            ("C", &space.c),
            ("D", &space.d),
        ];
        all.extend(self.parts.iter().flat_map(named_parts));
        latex(self.graph(), &all)
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
        let factors = &self.question.spectrum.factors;
        if factors.len() > 1 || factors.iter().any(|(_, power)| *power > 1) {
            let factor = |(f, power): &(Vec<Expr>, u32)| {
                let symbol = g.intern_symbol("λ", 0);
                let written = g.text(expression(g, symbol, f));
                match power {
                    1 => format!("({written})"),
                    power => format!("({written})^{power}"),
                }
            };
            let list: Vec<String> = factors.iter().map(factor).collect();
            let _ = writeln!(text, "  its factors: {}", list.join(" "));
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
                    let place = match self.question.place(region.is_left) {
                        Place::Left => "stable: all eigenvalues but the zeros of the family are left of the axis",
                        Place::OnAxis => "all eigenvalues on the axis and simple: linear motions stay bounded",
                        Place::Right | Place::NotLeft => "unstable: an eigenvalue is right of the axis",
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
        match boundary.crossing {
            Crossing::Zero => "an eigenvalue passes through zero",
            Crossing::Pair => "a pair of eigenvalues passes the imaginary axis",
            Crossing::Collision => "two pairs of eigenvalues meet",
            Crossing::Infinity => "an eigenvalue goes to infinity",
            Crossing::Touching => {
                "two eigenvalues are opposite, and the stability is the same on both sides"
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
                "factors": self.question.spectrum.factors.iter().map(|(f, power)| json!({
                    "coefficients": f.iter().map(|&e| g.text(e)).collect::<Vec<_>>(),
                    "multiplicity": power,
                })).collect::<Vec<_>>(),
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
            "speeds": linear.speeds.iter().map(|(name, e)| json!({"name": name, "definition": g.text(*e)})).collect::<Vec<_>>(),
            "E": exact(&linear.left),
            "F": exact(&linear.right),
            "inputs": self.space.inputs,
            "outputs": self.space.outputs,
            "A": exact(&self.space.a),
            "B": exact(&self.space.b),
            "C": exact(&self.space.c),
            "D": exact(&self.space.d),
            "second_order": self.parts.as_ref().map(|parts| {
                let parts = named_parts(parts).into_iter();
                parts.map(|(name, rows)| (name.to_owned(), exact(rows))).collect::<serde_json::Map<_, _>>()
            }),
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
                        let place = match self.question.place(r.is_left) {
                            Place::Left => "asymptotic",
                            Place::OnAxis => "spectral",
                            Place::Right | Place::NotLeft => "unstable",
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
        let kind = match boundary.crossing {
            Crossing::Zero => "zero",
            Crossing::Pair => "pair",
            Crossing::Collision => "collision",
            Crossing::Infinity => "infinity",
            Crossing::Touching => "touching",
        };
        let middle = (&boundary.root.low + &boundary.root.high) / Rational::from(2);
        json!({"parameter": name, "value": middle.to_f64().value(), "enclosure": [low, high], "kind": kind})
    }
}

/// The parts by the letters of the books.
fn named_parts(parts: &Parts) -> [(&'static str, &[Vec<Expr>]); 5] {
    [
        ("M", &parts.mass),
        ("D", &parts.damping),
        ("G", &parts.gyroscopic),
        ("K", &parts.stiffness),
        ("N", &parts.circulatory),
    ]
}

fn complex((re, im): (f64, f64)) -> String {
    // No minus before what is zero as it is printed.
    let plain = |x: f64| if x.abs() < 5e-7 { 0.0 } else { x };
    let (re, im) = (plain(re), plain(im));
    if im == 0.0 {
        format!("{re:.6}")
    } else {
        format!("{re:.6}{im:+.6}i")
    }
}

/// The longest exact entry that is shown as it is.
const LONGEST: usize = 24;

/// An exact entry; where it is long, in decimal numbers, as a polynomial in the only symbol that occurs.
fn shown(g: &Graph, e: Expr) -> String {
    let exact = g.text(e);
    if exact.len() <= LONGEST {
        return exact;
    }
    match g.symbols_in(&[e]).as_slice() {
        [] => g
            .evaluate_f64(&[e], &|_| None)
            .map_or(exact, |value| format!("{}", value[0])),
        [only] => decimal_polynomial(g, e, *only).unwrap_or(exact),
        _ => exact,
    }
}

/// A polynomial in a symbol with decimal coefficients; `None` where it is none.
fn decimal_polynomial(g: &Graph, e: Expr, symbol: Symbol) -> Option<String> {
    let degree = coefficients(g, e, symbol)?.len() - 1;
    let mut derivative = e;
    let (mut terms, mut factorial) = (Vec::new(), 1.0);
    for power in 0..=degree {
        let at_zero = g.substitute(derivative, &[(g.symbol_expr(symbol), g.zero())]);
        let value = g.evaluate_f64(&[at_zero], &|_| None).ok()?[0] / factorial;
        if value != 0.0 {
            terms.push((power, value));
        }
        derivative = g.diff(derivative, symbol);
        factorial *= (power + 1) as f64;
    }
    // What is left of a quotient is no polynomial.
    let rest = g.evaluate_f64(&[derivative], &|_| Some(1.0)).ok()?[0];
    if rest != 0.0 {
        return None;
    }
    let name = g.symbol_text(symbol);
    let term = |(power, value): &(usize, f64)| match power {
        0 => format!("{value:.8}"),
        1 => format!("{value:.8} {name}"),
        power => format!("{value:.8} {name}^{power}"),
    };
    let terms: Vec<String> = terms.iter().rev().map(term).collect();
    Some(terms.join(" + ").replace("+ -", "- "))
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
