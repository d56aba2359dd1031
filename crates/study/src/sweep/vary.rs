//! What varies over a sweep: parameters and initial values, each over a range or by rows of a file.

use chetaev_mechanics::sample::Generator;
use chetaev_model::model::Model;
use chetaev_model::{Diagnostic, Diagnostics, Place, Sources};
use chetaev_symbolic::rational::{integer, to_f64};
use chetaev_symbolic::syntax::{names, Span};
use chetaev_symbolic::Rational;

/// What a variation changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The parameter of this number; what the model makes of it changes with it.
    Parameter(usize),
    /// The initial value of a coordinate, differentiated so often.
    Initial(usize, u32),
}

/// The values of one variation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Values {
    /// `from + (to − from) j/(count − 1)`, exactly and then rounded.
    Linear(f64, f64),
    /// `from (to/from)^(j/(count − 1))`.
    Logarithmic(f64, f64),
    /// These.
    List(Vec<f64>),
    /// Uniform in [from, to) by a generator of its own.
    Random(f64, f64),
}

/// One variation, as it was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// What it changes.
    pub target: Target,
    /// Its name: that of the parameter, or of the coordinate with primes.
    pub name: String,
    pub(crate) values: Values,
    pub(crate) count: u64,
}

impl Variation {
    /// In words, with all digits.
    pub(crate) fn describe(&self) -> String {
        let kind = match self.target {
            Target::Parameter(_) => "",
            Target::Initial(..) => "initial ",
        };
        let (name, count) = (&self.name, self.count);
        match &self.values {
            Values::Linear(from, to) => format!("{kind}{name} from {from} to {to}, {count} values"),
            Values::Logarithmic(from, to) => {
                format!("{kind}{name} from {from} to {to} by equal ratios, {count} values")
            }
            Values::List(list) => {
                let list: Vec<String> = list.iter().map(f64::to_string).collect();
                format!("{kind}{name} = {}", list.join(", "))
            }
            Values::Random(from, to) => {
                format!("{kind}{name} random from {from} to {to}, {count} values")
            }
        }
    }
}

/// A text of the command line or a file, for messages.
struct Said<'a> {
    label: &'a str,
    text: &'a str,
}

impl Said<'_> {
    fn problem(&self, span: Span, message: String) -> (Sources, Diagnostic) {
        let mut sources = Sources::default();
        let source = sources.add(self.label, self.text);
        let place = Place { source, span };
        (sources, Diagnostic::error("sweep", place, message))
    }

    fn refuse(&self, span: Span, message: String, hint: &str) -> Diagnostics {
        let (sources, diagnostic) = self.problem(span, message);
        let diagnostic = match hint.is_empty() {
            true => diagnostic,
            false => diagnostic.hint(hint),
        };
        Diagnostics {
            sources,
            list: vec![diagnostic],
        }
    }

    /// A number of numbers and parameters, at its place.
    fn number(&self, model: &Model, span: Span) -> Result<f64, Diagnostics> {
        let part = span.text(self.text);
        if part.trim().is_empty() {
            return Err(self.refuse(span, "a number is missing here".into(), FORMS));
        }
        model.constant_value(self.label, part).map_err(|found| {
            let moved = |place: Place| Place {
                span: Span::new(place.span.start + span.start, place.span.end + span.start),
                ..place
            };
            let mut sources = Sources::default();
            sources.add(self.label, self.text);
            let list = found.list.into_iter().map(|mut diagnostic| {
                diagnostic.place = moved(diagnostic.place);
                if let Some(suggestion) = &mut diagnostic.suggestion {
                    suggestion.place = moved(suggestion.place);
                }
                diagnostic
            });
            Diagnostics {
                sources,
                list: list.collect(),
            }
        })
    }
}

const FORMS: &str = "write NAME=FROM:TO:COUNT, NAME=FROM:TO:log:COUNT, NAME=FROM:TO:uniform (with --count), NAME=V1,V2,V3 or NAME=V";

/// The parts of a text between separators, with their places.
fn parts(text: &str, from: usize, separator: char) -> Vec<Span> {
    let mut spans = Vec::new();
    let mut start = from;
    for (at, c) in text[from..].char_indices() {
        if c == separator {
            spans.push(Span::new(start, from + at));
            start = from + at + 1;
        }
    }
    spans.push(Span::new(start, text.len()));
    spans
}

impl Variation {
    /// Reads `NAME=FROM:TO:COUNT` and the like; `label` says where it stands, such as `--vary`. `initial` says that NAME is a
    /// coordinate or a velocity.
    ///
    /// # Errors
    /// What is wrong, at its place in the text.
    pub fn parse(
        model: &Model,
        (label, text): (&str, &str),
        initial: bool,
    ) -> Result<Variation, Diagnostics> {
        let said = Said { label, text };
        let Some(equals) = text.find('=') else {
            let whole = Span::new(0, text.len());
            return Err(said.refuse(whole, "there is no `=` here".into(), FORMS));
        };
        let before = &text[..equals];
        let name = before.trim();
        let start = equals - before.trim_start().len();
        let span = Span::new(start, start + name.len());
        let target = target(model, &said, (name, span), Some(initial))?;
        let (values, count) = range(model, &said, equals + 1)?;
        Ok(Variation {
            target,
            name: full_name(model, target),
            values,
            count,
        })
    }

    /// The value of row `row` of `count`.
    pub(crate) fn value(&self, row: u64, count: u64, seed: u64) -> f64 {
        match &self.values {
            Values::List(list) => list[row as usize],
            Values::Linear(from, _) | Values::Logarithmic(from, _) if row == 0 => *from,
            Values::Linear(_, to) | Values::Logarithmic(_, to) if row + 1 == count => *to,
            Values::Linear(from, to) => between(*from, *to, row, count),
            Values::Logarithmic(from, to) => geometric(*from, *to, row as f64 / (count - 1) as f64),
            Values::Random(from, to) => {
                // The generator of a name and a seed, set to the row: any row can be had without those before it.
                let own = self.name.bytes().fold(seed, |hash, byte| {
                    Generator::new(hash ^ u64::from(byte)).next_u64()
                });
                let mut generator = Generator::new(own ^ row.wrapping_mul(0xd6e8_feb8_6659_fd93));
                generator.next_u64();
                generator.between(*from, *to)
            }
        }
    }
}

/// `from (to/from)^share` of two numbers of one sign, also where their quotient is out of range: then by the powers of each,
/// which lie between 1 and the number.
fn geometric(from: f64, to: f64, share: f64) -> f64 {
    let quotient = to / from;
    if quotient.is_normal() {
        return from * quotient.powf(share);
    }
    from.signum() * from.abs().powf(1.0 - share) * to.abs().powf(share)
}

/// Whether two numbers are not zero and have one sign; their product may be out of range.
fn one_sign(a: f64, b: f64) -> bool {
    a > 0.0 && b > 0.0 || a < 0.0 && b < 0.0
}

/// `from + (to − from) row/(count − 1)` of the shortest decimals that read as these numbers, rounded once: the third of five
/// values between 0.1 and 0.5 is 0.3.
fn between(from: f64, to: f64, row: u64, count: u64) -> f64 {
    let (Some(low), Some(high)) = (decimal(from), decimal(to)) else {
        return from + (to - from) * (row as f64 / (count - 1) as f64);
    };
    let share = integer(row as i64) / integer((count - 1) as i64);
    to_f64(&(&low + (high - &low) * share))
}

/// The shortest decimal that reads as `value`, exactly: what a person would write for it.
pub(crate) fn decimal(value: f64) -> Option<Rational> {
    let text = value.is_finite().then(|| format!("{value}"))?;
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let digits: Rational = format!("{whole}{fraction}").parse().ok()?;
    let scale: Rational = format!("1{}", "0".repeat(fraction.len())).parse().ok()?;
    Some(digits / scale)
}

fn full_name(model: &Model, target: Target) -> String {
    match target {
        Target::Parameter(at) => model.parameters[at].name.clone(),
        Target::Initial(at, order) => {
            format!(
                "{}{}",
                model.coordinates[at].name,
                "'".repeat(order as usize)
            )
        }
    }
}

/// The quantity of a name; `initial` says which kind is wanted, `None` for either.
fn target(
    model: &Model,
    said: &Said<'_>,
    (name, span): (&str, Span),
    initial: Option<bool>,
) -> Result<Target, Diagnostics> {
    let base = name.trim_end_matches('\'');
    let order = (name.len() - base.len()) as u32;
    let normal = names::normalized(base);
    let parameter = model.parameters.iter().position(|p| p.name == normal);
    let coordinate = model.coordinate(base);
    match (parameter, coordinate) {
        (Some(at), _) if order == 0 && initial != Some(true) => return Ok(Target::Parameter(at)),
        (_, Some(at)) if initial != Some(false) => return Ok(Target::Initial(at, order)),
        (Some(_), _) if order == 0 => {
            let message = format!("`{name}` is a parameter, no coordinate or velocity");
            let hint = format!("write --vary {}", said.text);
            return Err(said.refuse(span, message, &hint));
        }
        (_, Some(_)) => {
            let message = format!("`{name}` is a coordinate or velocity, no parameter");
            let hint = format!("write --initial \"{}\"", said.text);
            return Err(said.refuse(span, message, &hint));
        }
        _ => {}
    }
    let is_size = model.sizes.iter().any(|(size, _)| *size == normal);
    if is_size {
        let message = format!("`{name}` is a size: another value of it makes another system");
        return Err(said.refuse(span, message, "sweep over each size by itself, with --set"));
    }
    let kind = match initial {
        Some(true) => "coordinate or velocity",
        Some(false) => "parameter",
        None => "parameter, coordinate or velocity",
    };
    let message = format!("the model has no {kind} `{name}`");
    let (sources, mut diagnostic) = said.problem(span, message);
    let parameters = model.parameters.iter().map(|p| p.name.as_str());
    let coordinates = model.coordinates.iter().map(|c| c.name.as_str());
    let known: Vec<&str> = match initial {
        Some(true) => coordinates.collect(),
        Some(false) => parameters.collect(),
        None => parameters.chain(coordinates).collect(),
    };
    if let Some(near) = names::closest(base, known.iter().copied()) {
        let near = format!("{near}{}", "'".repeat(order as usize));
        let place = diagnostic.place;
        diagnostic = diagnostic.suggest(place, near);
    } else if !known.is_empty() {
        diagnostic = diagnostic.hint(format!("there are: {}", known.join(", ")));
    }
    Err(Diagnostics {
        sources,
        list: vec![diagnostic],
    })
}

/// What stands behind `=`.
fn range(model: &Model, said: &Said<'_>, from: usize) -> Result<(Values, u64), Diagnostics> {
    let spans = parts(said.text, from, ':');
    let whole = Span::new(from, said.text.len());
    let word = |span: &Span| span.text(said.text).trim();
    match &spans[..] {
        [_] => {
            let values: Result<Vec<f64>, _> = parts(said.text, from, ',')
                .into_iter()
                .map(|span| said.number(model, span))
                .collect();
            let values = values?;
            let count = values.len() as u64;
            Ok((Values::List(values), count))
        }
        [low, high, kind] if matches!(word(kind), "uniform" | "random") => {
            let (low, high) = (said.number(model, *low)?, said.number(model, *high)?);
            Ok((Values::Random(low, high), 0))
        }
        [low, high, count] => {
            let values = Values::Linear(said.number(model, *low)?, said.number(model, *high)?);
            Ok((values, counted(said, *count)?))
        }
        [low, high, kind, count] => {
            let (from, to) = (said.number(model, *low)?, said.number(model, *high)?);
            let values = match word(kind) {
                "log" if one_sign(from, to) => Values::Logarithmic(from, to),
                "log" => {
                    let message = "a logarithmic range needs two ends of one sign, and not zero";
                    let ends = Span::new(low.start, high.end);
                    return Err(said.refuse(ends, message.into(), ""));
                }
                "lin" | "linear" => Values::Linear(from, to),
                other => {
                    let message = format!("there is no kind of range `{other}`");
                    return Err(said.refuse(*kind, message, FORMS));
                }
            };
            Ok((values, counted(said, *count)?))
        }
        _ => Err(said.refuse(whole, "this is no range".into(), FORMS)),
    }
}

/// The most values of one range, and the most trajectories.
pub(crate) const MOST: u64 = 1_000_000_000;

fn counted(said: &Said<'_>, span: Span) -> Result<u64, Diagnostics> {
    let word = span.text(said.text).trim();
    match word.parse::<u64>() {
        Ok(count) if (1..=MOST).contains(&count) => Ok(count),
        _ => {
            let message =
                format!("how many values: a whole number from 1 to {MOST} is needed here");
            Err(said.refuse(span, message, FORMS))
        }
    }
}

/// Reads rows of values: a line of names, then a line of numbers for each trajectory, separated by commas.
///
/// # Errors
/// What is wrong, at its line and column.
pub fn rows(model: &Model, label: &str, text: &str) -> Result<Vec<Variation>, Diagnostics> {
    // Some editors and spreadsheets put a byte order mark before the first line.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let said = Said { label, text };
    let mut lines = lines(text).into_iter();
    let Some(head) = lines.next() else {
        let hint = "write a line of names, then a line of numbers for each trajectory";
        return Err(said.refuse(Span::new(0, 0), "there are no rows here".into(), hint));
    };
    let mut list: Vec<Variation> = Vec::new();
    for span in cells(text, head) {
        let target = target(model, &said, (span.text(text), span), None)?;
        list.push(Variation {
            target,
            name: full_name(model, target),
            values: Values::List(Vec::new()),
            count: 0,
        });
    }
    for line in lines {
        let cells = cells(text, line);
        if cells.len() != list.len() {
            let message = format!(
                "{} values stand here, for {} names",
                cells.len(),
                list.len()
            );
            return Err(said.refuse(line, message, ""));
        }
        for (variation, span) in list.iter_mut().zip(cells) {
            let word = span.text(text);
            match (word.parse::<f64>(), &mut variation.values) {
                (Ok(value), Values::List(values)) if value.is_finite() => values.push(value),
                _ => {
                    let message = format!("`{word}` is no finite number");
                    return Err(said.refuse(span, message, ""));
                }
            }
            variation.count += 1;
        }
    }
    Ok(list)
}

/// The lines that are not empty and no comments.
fn lines(text: &str) -> Vec<Span> {
    let mut start = 0;
    let mut spans = Vec::new();
    for line in text.split_inclusive('\n') {
        let said = line.trim();
        if !said.is_empty() && !said.starts_with('#') {
            let from = start + line.len() - line.trim_start().len();
            spans.push(Span::new(from, from + said.len()));
        }
        start += line.len();
    }
    spans
}

/// The cells of a line without the blanks and quotation marks around them.
fn cells(text: &str, line: Span) -> Vec<Span> {
    let end = &text[..line.end];
    let trimmed = |span: Span| {
        let word = span.text(text);
        let mut from = span.start + (word.len() - word.trim_start().len());
        let mut to = from + word.trim().len();
        if to - from >= 2 && text[from..to].starts_with('"') && text[from..to].ends_with('"') {
            (from, to) = (from + 1, to - 1);
        }
        Span::new(from, to)
    };
    parts(end, line.start, ',')
        .into_iter()
        .map(trimmed)
        .collect()
}
