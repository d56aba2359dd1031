//! Linear equations about a steady motion and their stability: `chetaev linearize`, `chetaev stability`.
//!
//! Here stands what is asked and how it is answered; `text` has the answer in words for a terminal, `data` as matrices in numbers, LaTeX and JSON.
#![allow(
    clippy::result_large_err,
    reason = "an error is made once, and told at once"
)]

mod data;
mod decimal;
pub(crate) mod error;
mod hopf;
pub mod map;
mod plot;
mod text;

pub use error::StabilityError;

use crate::start;
use chetaev_mechanics::system::QuasiVelocity;
use chetaev_mechanics::{MotionTerms, Selection, SteadyMotion, System};
use chetaev_model::Model;
use chetaev_stability::descriptor::Descriptor;
use chetaev_stability::eigenvalues::{as_known, distinct, modes, Complex, Known};
use chetaev_stability::expansion::Expansion;
use chetaev_stability::guess::near;
use chetaev_stability::hurwitz::{Ranges, Region};
use chetaev_stability::linearization::LinearizationError;
use chetaev_stability::parts::Parts;
use chetaev_stability::question::{parameter_of_motion, values_at, values_but, Question};
use chetaev_stability::reduction::{may_be_speeds, Speeds};
use chetaev_stability::state_space::StateSpace;
use chetaev_stability::steady_set::{steady_set, SteadySet, SteadySetError};
use chetaev_symbolic::meter::{within, Work};
use chetaev_symbolic::{Expr, Graph, Rational, Symbol};

/// Eigenvalues that differ by less, in parts of the largest, are one for the table of modes; which of them are multiple is known exactly.
const SAME: f64 = 1e-9;

/// Rows of the table of eigenvalues over a range.
const ROWS: usize = 11;

/// What is asked of a model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// A motion that the model names, `rest` or `start` (positions and velocities of the initial data); the only one, or the start, where
    /// that is steady, without it.
    pub about: Option<&'a str>,
    /// `NAME=FROM:TO`.
    pub over: Option<&'a str>,
    /// Values of controls without a law and of parameters of a family, `NAME=VALUE` separated by commas.
    pub at: Option<&'a str>,
    /// Independent speeds, separated by commas: velocities, or functions linear in them.
    pub speeds: Option<&'a str>,
    /// Outputs, separated by commas: functions of coordinates, velocities and controls.
    pub outputs: Option<&'a str>,
    /// Whether all parameters stay symbols.
    pub symbolic: bool,
    /// Whether all parameters have their values from the beginning.
    pub numbers: bool,
    /// Whether the equations are wanted in all variables too: coordinates, velocities and multipliers.
    pub all: bool,
    /// Work for the linear equations in symbols, counted as seconds, before they are made in numbers; [`WORK`] where it is left out.
    pub work: Option<f64>,
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

impl Range {
    /// The values of the parameter in the table, exact, so that -1/5 is written as -0.2.
    fn rows(&self) -> impl Iterator<Item = Rational> + '_ {
        (0..ROWS).map(|row| {
            let part = Rational::from(row) / Rational::from(ROWS - 1);
            &self.low + (&self.high - &self.low) * part
        })
    }
}

/// Eigenvalues as pairs of real and imaginary parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigenvalues {
    /// Ascending by real and then by imaginary part.
    pub values: Vec<(f64, f64)>,
    /// Whether all were enclosed and then rounded: each part has all digits, and is zero where it is printed so.
    pub are_enclosed: bool,
}

/// An eigenvalue with its vector, complex numbers as pairs of real and imaginary parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// λ.
    pub eigenvalue: (f64, f64),
    /// How often it is one: with fewer modes it has a Jordan block.
    pub multiplicity: usize,
    /// Whether λ was enclosed and then rounded.
    pub is_enclosed: bool,
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
    /// For each region, whether the motion is not real there.
    pub absent: Vec<bool>,
    /// The same for the rows of the table.
    absent_rows: Vec<bool>,
    /// The equations in state space.
    pub space: StateSpace,
    /// The equations in all variables, where they were asked for.
    pub all: Option<Descriptor>,
    /// Their parts of second order, where there are such.
    pub parts: Option<Parts>,
    /// Coordinates that run uniformly, with their rates.
    pub running: Vec<(String, Expr)>,
    /// Positions that are known, and velocities, with their values along the motion.
    pub along: Vec<(String, Expr)>,
    /// Why all parameters have their values.
    pub numbers: Option<Numbers>,
}

/// Why all parameters have their values, and none is left in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// That was asked for.
    Asked,
    /// The equations in symbols took more work than they may.
    TooLarge,
    /// The motion is steady at these values alone.
    SteadyThere,
}

/// Work for the linear equations in symbols, counted as seconds; a chain of 32 links takes a third of it. With numbers alone it is not limited.
pub const WORK: f64 = 3.0;

/// The linear equations about a steady motion of a model, and their stability over a range of a parameter.
///
/// # Errors
/// [`StabilityError`].
pub fn stability(model: &Model, wanted: &Wanted<'_>) -> Result<Stability, StabilityError> {
    let system = System::from_model(model)?;
    if wanted.numbers {
        return in_numbers(model, system, wanted, Numbers::Asked);
    }
    if wanted.symbolic || wanted.over.is_some() {
        return in_symbols(model, system, wanted);
    }
    let symbolic = || in_symbols(model, system.clone(), wanted);
    match within(&Work::of_seconds(wanted.work.unwrap_or(WORK)), symbolic) {
        // It may be steady at the values of the model alone.
        Ok(Err(StabilityError::Linearization(
            problem @ (LinearizationError::NotSteady { .. }
            | LinearizationError::Open { .. }
            | LinearizationError::NotAdmissible { .. }),
        ))) => in_numbers(model, system, wanted, Numbers::SteadyThere).map_err(|_| problem.into()),
        Ok(found) => found,
        Err(_) => in_numbers(model, system, wanted, Numbers::TooLarge),
    }
}

/// The same with the values of all parameters put in before anything is derived, so that all arithmetic is that of numbers, and exact.
fn in_numbers(
    model: &Model,
    system: System,
    wanted: &Wanted<'_>,
    why: Numbers,
) -> Result<Stability, StabilityError> {
    let values = values_but(&system, None);
    let put_in = system.with_parameters(&values).unwrap_or(system);
    let wanted = Wanted {
        numbers: true,
        ..*wanted
    };
    let found = in_symbols(model, put_in, &wanted)?;
    Ok(Stability {
        numbers: Some(why),
        ..found
    })
}

/// The linear equations of a system about the motion that is wanted, with the parameters that it has.
fn in_symbols(
    model: &Model,
    mut system: System,
    wanted: &Wanted<'_>,
) -> Result<Stability, StabilityError> {
    let prepared = start::prepared(model, &system)?;
    let (terms, mut selection) = (&prepared.terms, prepared.selection.clone());
    let speeds = match wanted.speeds {
        Some(text) => in_speeds((model, terms), &mut system, &mut selection, text)?,
        None => Speeds::Suitable,
    };
    let outputs = match wanted.outputs {
        Some(text) => list(model, text)?,
        None => Vec::new(),
    };
    let range = wanted.over.map(|text| range(model, text)).transpose()?;
    let at = wanted.at.map(|text| at(model, text)).transpose()?;
    let at = at.unwrap_or_default();
    let over = range.as_ref().map(|range| range.symbol);
    let wanted_values = if wanted.symbolic && range.is_none() {
        Vec::new()
    } else {
        values_but(&system, over)
    };
    let found = || steady_set(&system, terms, &prepared.selection, &wanted_values);
    let mut motions = motions(model, &system, wanted.about, &found)?;
    if let Some(range) = &range {
        check_parameter(&system, &motions, range)?;
    }
    let unknown = with_values(&mut system, &mut motions, &at);
    if let Some(name) = unknown {
        let text = wanted.at.unwrap_or_default().into();
        let why = format!("`{name}` is neither a control nor a parameter of the motion; values of parameters of the model are set by --set");
        return Err(StabilityError::At { text, why });
    }
    let mut problem = None;
    for motion in &motions {
        let free = match &range {
            Some(range) => Some(range.symbol),
            None if wanted.symbolic || wanted.numbers => None,
            None => parameter_of_motion(&system, motion),
        };
        let values = if over.is_none() && wanted.symbolic {
            Vec::new()
        } else {
            values_but(&system, free)
        };
        let motion = match near(&system, terms, &selection, (motion, &values)) {
            Ok(found) => found,
            Err(own) => {
                problem = Some(own);
                continue;
            }
        };
        let motion = &*motion;
        match Expansion::in_speeds(&system, terms, &selection, motion, (&values, speeds)) {
            Ok(about) => {
                let question = Question::about(&about, free);
                let all = wanted.all.then(|| about.descriptor(&outputs)).transpose()?;
                // Outputs of all variables need not be functions of the independent ones.
                let of_independent = if wanted.all { &[] } else { outputs.as_slice() };
                let space = about.state_space(&question.linear, of_independent)?;
                let ranges = range
                    .as_ref()
                    .and_then(|r| question.ranges(&system.graph, &r.low, &r.high))
                    .map(|found| found.joined(&|root| question.is_unstable_at(&system.graph, root)))
                    .zip(range.as_ref())
                    .map(|(found, r)| {
                        found.cut_at(&question.ends_of_motion(&about, &r.low, &r.high))
                    })
                    .map(|found| found.without(&|root| question.is_absent_in(&about, root)));
                let is_absent = |own: &Region| question.is_absent(&about, &own.sample);
                let (ranges, absent) = match ranges.map(|own| with_absence(own, &is_absent)) {
                    Some((ranges, absent)) => (Some(ranges), absent),
                    None => (None, Vec::new()),
                };
                let rows = range.iter().flat_map(Range::rows);
                let absent_rows = rows.map(|at| question.is_absent(&about, &at)).collect();
                return Ok(Stability {
                    motion: motion.clone(),
                    parts: Parts::of(&system.graph, &question.linear),
                    question,
                    range,
                    ranges,
                    absent,
                    absent_rows,
                    space,
                    all,
                    along: about.values_of_motion(),
                    running: about.running(),
                    system,
                    numbers: None,
                });
            }
            // What was found is steady: its values are not simple enough to show it.
            Err(LinearizationError::NotSteady { motion: name, .. }) if is_found(&system, &name) => {
                return Err(StabilityError::NoClosedForm { name });
            }
            Err(own) => problem = Some(own),
        }
    }
    let is_of_system = matches!(
        problem,
        Some(
            LinearizationError::NotAutonomous
                | LinearizationError::MassesMove
                | LinearizationError::OrderTooHigh { .. }
        )
    );
    match problem {
        Some(own) if is_of_system || wanted.about.is_some() || !system.steady.is_empty() => {
            Err(own.into())
        }
        _ => {
            let found = steady_set(&system, terms, &prepared.selection, &wanted_values);
            Err(StabilityError::NoMotion {
                example: example(&system, " = 0", "\n"),
                found: found_text(&system, &found),
            })
        }
    }
}

/// Ranges with whether there is no motion in each region, those without one in one where they follow each other.
fn with_absence(mut own: Ranges, is_absent: &dyn Fn(&Region) -> bool) -> (Ranges, Vec<bool>) {
    let mut regions: Vec<Region> = Vec::new();
    let mut absent: Vec<bool> = Vec::new();
    for region in std::mem::take(&mut own.regions) {
        let is_absent = is_absent(&region);
        match regions.last_mut() {
            Some(last) if is_absent && absent.last() == Some(&true) => last.high = region.high,
            _ => {
                regions.push(region);
                absent.push(is_absent);
            }
        }
    }
    own.regions = regions;
    (own, absent)
}

/// Whether a motion has a number as its name, as those that were found, and none that the model states.
fn is_found(system: &System, name: &str) -> bool {
    let is_number = name.chars().all(|c| c.is_ascii_digit());
    is_number && !system.steady.iter().any(|own| own.name == name)
}

/// What was found, as the end of a sentence that says what was missed.
fn found_text(system: &System, found: &Result<SteadySet, SteadySetError>) -> String {
    match found {
        Ok(set) if set.found.is_empty() => "; there is no steady motion".into(),
        Ok(set) => format!(
            ", or by its number one of those that were found:\n\n{}",
            crate::steady::words::lines(&system.graph, set)
        ),
        Err(_) => String::new(),
    }
}

/// Values that were given for names.
fn at(model: &Model, text: &str) -> Result<Vec<(String, Expr)>, StabilityError> {
    let wrong = |why: &str| StabilityError::At {
        text: text.into(),
        why: why.into(),
    };
    let pair = |part: &str| {
        let (name, value) = part
            .split_once('=')
            .ok_or_else(|| wrong("write NAME=VALUE, as in u=1/2"))?;
        let (value, _) = model
            .constant("--at", value)
            .map_err(StabilityError::Expression)?;
        Ok((name.trim().to_owned(), value))
    };
    text.split(',').map(pair).collect()
}

/// Puts in values of controls and of parameters of families; the first name that is neither.
fn with_values(
    system: &mut System,
    motions: &mut [SteadyMotion],
    at: &[(String, Expr)],
) -> Option<String> {
    let g = system.graph.clone();
    for (name, value) in at {
        if let Some(control) = system.controls.iter_mut().find(|c| c.name == *name) {
            control.law = Some(*value);
            continue;
        }
        let symbol = g.symbol(name, 0);
        let mut is_used = false;
        for motion in motions.iter_mut() {
            let places = motion.positions.iter_mut().chain(&mut motion.velocities);
            for place in places.flatten() {
                let own = g.substitute(*place, &[(symbol, *value)]);
                is_used |= own != *place;
                *place = own;
            }
        }
        let is_parameter = system.parameters.iter().any(|p| p.name == *name);
        if !is_used || is_parameter {
            return Some(name.clone());
        }
    }
    None
}

/// A range is one of a parameter of the model, or of a family.
fn check_parameter(
    system: &System,
    motions: &[SteadyMotion],
    range: &Range,
) -> Result<(), StabilityError> {
    let g = &system.graph;
    let places = motions
        .iter()
        .flat_map(|motion| motion.positions.iter().chain(&motion.velocities));
    let places: Vec<Expr> = places.flatten().copied().collect();
    let names = system.parameters.iter().map(|p| p.name.clone());
    let mut known: Vec<String> = names.collect();
    let of_motions = g.symbols_in(&places).into_iter();
    for name in of_motions.map(|s| g.symbol_text(s)) {
        if !known.contains(&name) {
            known.push(name);
        }
    }
    if known.contains(&range.name) {
        return Ok(());
    }
    Err(StabilityError::UnknownParameter {
        name: range.name.clone(),
        known,
    })
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
    (model, terms): (&Model, &MotionTerms),
    system: &mut System,
    selection: &mut Selection,
    text: &str,
) -> Result<Speeds, StabilityError> {
    let all = list(model, text)?;
    let needed = system.n() - selection.rows.len();
    let definitions: Vec<Expr> = all.iter().map(|own| own.1).collect();
    let is_choice = all.len() == needed;
    if !is_choice || !may_be_speeds(system, terms, selection, &definitions) {
        let independent = selection.independent(system.n());
        let names: Vec<String> = independent
            .iter()
            .map(|&j| format!("{}'", system.coordinates[j].name))
            .collect();
        return Err(StabilityError::Speeds {
            text: if is_choice {
                format!("`{text}` is no choice of independent speeds")
            } else {
                format!("`{text}` names {} speeds", all.len())
            },
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
pub(crate) fn motions(
    model: &Model,
    system: &System,
    about: Option<&str>,
    found: &dyn Fn() -> Result<SteadySet, SteadySetError>,
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
    let guessed = model.initial.values.iter().filter(|(_, own)| own.is_guess);
    let start = || SteadyMotion {
        name: "start".into(),
        positions: of_start(0),
        velocities: of_start(1),
        over: None,
        guesses: guessed
            .map(|(place, _)| *place)
            .filter(|(_, order)| *order <= 1)
            .collect(),
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
        (Some(name), _) => {
            let found = found();
            let own = found.as_ref().ok().and_then(|set| {
                let mut all = set.found.iter();
                all.find(|own| own.name == name)
            });
            match own.map(|own| own.motion.clone()) {
                Some(Some(motion)) => Ok(vec![motion]),
                Some(None) => Err(StabilityError::NoClosedForm { name: name.into() }),
                None => Err(StabilityError::UnknownMotion {
                    name: name.into(),
                    known: names
                        .into_iter()
                        .chain(["rest".into(), "start".into()])
                        .collect(),
                    found: found_text(system, &found),
                }),
            }
        }
        (None, [only]) => Ok(vec![only.clone()]),
        (None, _) => Err(StabilityError::SeveralMotions { names }),
    }
}

/// The range `NAME=FROM:TO` of a text.
pub(crate) fn range(model: &Model, text: &str) -> Result<Range, StabilityError> {
    let wrong = || StabilityError::Range { text: text.into() };
    let (name, ends) = text.split_once('=').ok_or_else(wrong)?;
    let (low, high) = ends.split_once(':').ok_or_else(wrong)?;
    let name = name.trim();
    let number = |text: &str| -> Option<Rational> {
        let (value, _) = model.constant("--over", text).ok()?;
        model.graph.as_number(value).cloned()
    };
    let (low, high) = (
        number(low).ok_or_else(wrong)?,
        number(high).ok_or_else(wrong)?,
    );
    if low < high {
        Ok(Range {
            symbol: model.graph.intern_symbol(name, 0),
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

    /// The coefficients of the characteristic polynomial, the constant first; those of algebraic numbers over the leading one, as common denominators
    /// have many digits.
    fn coefficients(&self) -> Option<Vec<Expr>> {
        let g = self.graph();
        let own = &self.question.polynomial.as_ref()?.coefficients;
        let leading = *own.last()?;
        if !own.iter().any(|&e| g.holds_algebraic(e)) {
            return Some(own.clone());
        }
        Some(own.iter().map(|&e| g.div(e, leading)).collect())
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
        let number = |e: &Expr| decimal::value(g, *e, &value).unwrap_or(f64::NAN);
        rows.iter()
            .map(|row| row.iter().map(number).collect())
            .collect()
    }

    /// The eigenvalues as pairs of real and imaginary parts, at a value of the parameter that was left in; those that are zero whatever it is are so
    /// exactly.
    pub fn eigenvalues(&self, free: Option<f64>) -> Option<Vec<(f64, f64)>> {
        let polynomial = self.question.polynomial.as_ref();
        let known = Known {
            zeros: polynomial.map_or(self.question.linear.family, |_| self.question.zeros()),
            others: Vec::new(),
        };
        let found = self.complex_eigenvalues(free, &known)?;
        Some(found.iter().map(|l| (l.re, l.im)).collect())
    }

    /// The same at an exact value, where all that is known of them is used: which are zero there, and which are enclosed.
    pub fn eigenvalues_at(&self, at: Option<Expr>) -> Option<Eigenvalues> {
        let known = self.known(at);
        let found = self.complex_eigenvalues(self.number(at), &known)?;
        Some(Eigenvalues {
            values: found.iter().map(|l| (l.re, l.im)).collect(),
            are_enclosed: known.is_all_of(self.question.linear.variables.len()),
        })
    }

    fn complex_eigenvalues(&self, free: Option<f64>, known: &Known) -> Option<Vec<Complex<f64>>> {
        let linear = &self.question.linear;
        let [left, right] = [&linear.left, &linear.right].map(|rows| self.numbers(rows, free));
        as_known(&left, &right, known)
    }

    /// What is known exactly of the eigenvalues at a value of the parameter that was left in.
    fn known(&self, at: Option<Expr>) -> Known {
        let values = match self.question.over.zip(at) {
            Some((over, at)) => values_at(&self.system, over, at),
            None => self.system.parameter_values(),
        };
        self.question.known(self.graph(), &values)
    }

    fn number(&self, at: Option<Expr>) -> Option<f64> {
        let found = self.graph().evaluate_f64(&[at?], &|_| None).ok()?;
        found.first().copied()
    }

    /// The value that the model states for the parameter that was left in.
    pub(crate) fn stated(&self) -> Option<f64> {
        self.number(self.stated_exactly())
    }

    /// The same, exact.
    pub(crate) fn stated_exactly(&self) -> Option<Expr> {
        let over = self.question.over?;
        let mut all = self.system.parameters.iter();
        let own = all.find(|p| self.graph().as_symbol(p.expr) == Some(over))?;
        own.value
    }

    /// Eigenvalues with imaginary part zero or positive, each with its modes; none where a parameter has no value.
    pub fn modes(&self) -> Vec<Mode> {
        let (at, linear) = (self.stated_exactly(), &self.question.linear);
        let stated = self.number(at);
        let [left, right] = [&linear.left, &linear.right].map(|rows| self.numbers(rows, stated));
        let known = self.known(at);
        let is_enclosed = known.is_all_of(linear.variables.len());
        let found = as_known(&left, &right, &known).unwrap_or_default();
        let found: Vec<Complex<f64>> = found.into_iter().filter(|l| l.im >= 0.0).collect();
        let sizes = found.iter().map(|l| l.norm());
        let size = sizes.fold(f64::MIN_POSITIVE, f64::max);
        let pair = |l: &Complex<f64>| (l.re, l.im);
        let with_modes = |(l, multiplicity): (Complex<f64>, usize)| {
            let vectors = modes(&left, &right, (l, multiplicity)).unwrap_or_default();
            let mode = move |vector: Vec<Complex<f64>>| Mode {
                eigenvalue: pair(&l),
                multiplicity,
                is_enclosed,
                vector: vector.iter().map(pair).collect(),
            };
            vectors.into_iter().map(mode)
        };
        // Eigenvalues that are the same to rounding are one; enclosed ones have none.
        let rounding = if is_enclosed { 0.0 } else { SAME * size };
        let found = distinct(&found, rounding).into_iter();
        found.flat_map(with_modes).collect()
    }

    /// Eigenvalues at equally spaced values of the parameter; none where the motion is not real.
    fn table(&self, range: &Range) -> Vec<(f64, Option<Eigenvalues>)> {
        let row = |(row, at): (usize, Rational)| {
            let value = at.to_f64().value();
            if self.absent_rows.get(row) == Some(&true) {
                return Some((value, None));
            }
            let list = self.eigenvalues_at(Some(self.graph().number(at)))?;
            Some((value, Some(list)))
        };
        range.rows().enumerate().filter_map(row).collect()
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
