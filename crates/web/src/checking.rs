//! Everything wrong or doubtful in a text, with fixes that were tried, and what the page offers to move.

use crate::reading::{read, Read};
use chetaev::mechanics::System;
use chetaev::model::model::{Model, Parameter};
use chetaev::model::units::Unit;
use chetaev::model::{Diagnostic, Diagnostics};
use chetaev::stability::question::parameter_of_motion;
use chetaev::study::{check, diagnostics, Hooks};
use chetaev::symbolic::Expr;
use serde::Serialize;
use serde_json::{json, Value};
use toml_edit::{Document, Item, TableLike};

/// Fixes that are tried for one text.
const TRIED: usize = 12;

/// What is found, as JSON: `diagnostics`, `names`, `sliders`, `offered`, `title`, `isFunctional`. Places count UTF-16 units.
pub(crate) fn checked(path: &str, text: &str, hooks: &mut Hooks<'_>) -> Value {
    let (model, found, is_functional) = match read(path, text) {
        Read::Functional(loaded) => (None, loaded.diagnostics, true),
        Read::Motion(loaded) => {
            let mut found = loaded.diagnostics;
            if let Some(model) = &loaded.model {
                found.list.extend(model.unused.iter().cloned());
                if let Err(problem) = check(model, hooks) {
                    found.list.extend(diagnostics(&problem, model));
                }
            }
            (loaded.model, found, false)
        }
    };
    json!({
        "diagnostics": told(path, text, &found),
        "hasErrors": found.has_errors(),
        "isFunctional": is_functional,
        "title": model.as_ref().map(|model| model.name.clone()),
        "names": model.as_ref().map(names),
        "sliders": model.as_ref().map(|model| sliders(text, model)),
        "offered": model.as_ref().map(offered),
    })
}

/// The place of bytes of a text in UTF-16 units, as editors in a browser count.
fn units(text: &str, byte: usize) -> usize {
    let byte = byte.min(text.len());
    let before = text.get(..byte).unwrap_or(text);
    before.encode_utf16().count()
}

fn told(path: &str, text: &str, found: &Diagnostics) -> Vec<Value> {
    let errors = found.list.iter().filter(|d| is_error(d)).count();
    let mut tried = 0;
    let data = found.to_data().into_iter().zip(&found.list);
    data.map(|(data, own)| {
        let is_here = data.at.file == path;
        let fix = data.suggestion.as_ref().filter(|fix| fix.at.file == path);
        let fix = fix.filter(|fix| {
            tried += 1;
            tried <= TRIED
                && helps(
                    path,
                    text,
                    (fix.at.start, fix.at.end, &fix.replacement),
                    (errors, own),
                )
        });
        json!({
            "severity": data.severity,
            "code": data.code,
            "message": data.message,
            "label": data.label,
            "hints": data.hints,
            "file": data.at.file,
            "line": data.at.line,
            "from": if is_here { units(text, data.at.start) } else { 0 },
            "to": if is_here { units(text, data.at.end) } else { 0 },
            "fix": fix.map(|fix| json!({
                "from": units(text, fix.at.start),
                "to": units(text, fix.at.end),
                "replacement": fix.replacement,
            })),
        })
    })
    .collect()
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    Diagnostics {
        list: vec![diagnostic.clone()],
        ..Diagnostics::default()
    }
    .has_errors()
}

/// Whether a replacement leaves fewer errors, or of a warning no more errors and not this one.
fn helps(
    path: &str,
    text: &str,
    (start, end, replacement): (usize, usize, &str),
    (errors, own): (usize, &Diagnostic),
) -> bool {
    let (Some(before), Some(after)) = (text.get(..start), text.get(end..)) else {
        return false;
    };
    let mended = format!("{before}{replacement}{after}");
    let found = match read(path, &mended) {
        Read::Functional(loaded) => loaded.diagnostics,
        Read::Motion(loaded) => loaded.diagnostics,
    };
    let left = found.list.iter().filter(|d| is_error(d)).count();
    let remains =
        |d: &Diagnostic| d.code == own.code && d.message == own.message && d.place == own.place;
    left < errors || (left == errors && !found.list.iter().any(remains))
}

/// Names of a model with what there is to say of them.
fn names(model: &Model) -> Vec<Value> {
    let unit = |unit: &Option<Unit>| match unit {
        Some(unit) => format!(" in {}", unit.text),
        None => String::new(),
    };
    let row = |name: &str, kind: &str, said: String, about: &str| json!({"name": name, "kind": kind, "said": said, "about": about});
    let coordinates = model.coordinates.iter();
    let coordinates = coordinates.map(|c| {
        row(
            &c.name,
            "coordinate",
            format!("coordinate{}", unit(&c.unit)),
            &c.description,
        )
    });
    let parameters = model.parameters.iter().map(|p| {
        let value = p.definition.map_or("without a value".to_owned(), |e| {
            format!("= {}", model.graph.text(e))
        });
        row(
            &p.name,
            "parameter",
            format!("parameter {value}{}", unit(&p.unit)),
            &p.description,
        )
    });
    let defined = model.defines.iter();
    let defined = defined.map(|d| {
        row(
            &d.name,
            "definition",
            format!("= {}", d.text),
            &d.description,
        )
    });
    let quasi = model.quasi_velocities.iter();
    let quasi = quasi.map(|d| {
        row(
            &d.name,
            "quasi-velocity",
            format!("quasi-velocity {}", d.text),
            &d.description,
        )
    });
    coordinates
        .chain(parameters)
        .chain(defined)
        .chain(quasi)
        .collect()
}

/// A number of the text that may be moved.
#[derive(Serialize)]
struct Slider {
    /// `parameter` or `initial`.
    kind: &'static str,
    name: String,
    about: String,
    unit: Option<String>,
    value: f64,
    low: f64,
    high: f64,
    /// Where the number stands.
    from: usize,
    to: usize,
    /// Whether the number stands in quotes.
    quoted: bool,
}

/// The parameters and initial values that are stated as numbers.
fn sliders(text: &str, model: &Model) -> Vec<Slider> {
    let Ok(document) = Document::parse(text) else {
        return Vec::new();
    };
    let table = |name: &str| document.get(name).and_then(Item::as_table_like);
    let mut found = Vec::new();
    if let Some(stated) = table("parameters") {
        for parameter in &model.parameters {
            let Some(number) = number(stated, &parameter.name) else {
                continue;
            };
            let (low, high) = range(model, parameter, number.value);
            found.push(Slider {
                kind: "parameter",
                name: parameter.name.clone(),
                about: parameter.description.clone(),
                unit: parameter.unit.as_ref().map(|unit| unit.text.clone()),
                ..number.slider(text, low, high)
            });
        }
    }
    if let Some(stated) = table("initial") {
        for &(i, order) in model.initial.values.keys() {
            let Some(coordinate) = model.coordinates.get(i) else {
                continue;
            };
            let name = format!("{}{}", coordinate.name, "'".repeat(order as usize));
            let Some(number) = number(stated, &name) else {
                continue;
            };
            let reach = (2.0 * number.value.abs()).max(3.0);
            found.push(Slider {
                kind: "initial",
                name,
                about: coordinate.description.clone(),
                unit: None,
                ..number.slider(text, -reach, reach)
            });
        }
    }
    found
}

/// A number as it stands in the text.
struct Number {
    value: f64,
    start: usize,
    end: usize,
    quoted: bool,
}

impl Number {
    fn slider(&self, text: &str, low: f64, high: f64) -> Slider {
        Slider {
            kind: "",
            name: String::new(),
            about: String::new(),
            unit: None,
            value: self.value,
            low: low.min(self.value),
            high: high.max(self.value),
            from: units(text, self.start),
            to: units(text, self.end),
            quoted: self.quoted,
        }
    }
}

fn number(table: &dyn TableLike, name: &str) -> Option<Number> {
    let item = table.get(name)?;
    let item = match item.as_table_like() {
        Some(inner) => inner.get("value")?,
        None => item,
    };
    let text = item.as_str();
    let value = item
        .as_float()
        .or_else(|| item.as_integer().map(|i| i as f64))
        .or_else(|| text?.trim().parse().ok())?;
    let span = item.span()?;
    value.is_finite().then_some(Number {
        value,
        start: span.start,
        end: span.end,
        quoted: text.is_some(),
    })
}

/// What there is to ask about: the motions that a model names, and its parameters that have a value, each with a range: first the one that
/// names the members of the family of the first motion, then those with a stated range.
fn offered(model: &Model) -> Value {
    let system = System::from_model(model).ok();
    let first = system.and_then(|system| {
        let symbol = parameter_of_motion(&system, system.steady.first()?)?;
        Some(system.graph.symbol_text(symbol))
    });
    let value = |p: &Parameter| {
        let found = model.graph.evaluate_f64(&[p.definition?], &|_| None);
        found.ok()?.first().copied()
    };
    let valued = model.parameters.iter();
    let mut valued: Vec<(&Parameter, f64)> = valued.filter_map(|p| Some((p, value(p)?))).collect();
    valued.sort_by_key(|(p, _)| (first.as_ref() != Some(&p.name), p.range.is_none()));
    let parameter = |&(p, value): &(&Parameter, f64)| {
        let (low, high) = range(model, p, value);
        json!({"name": p.name, "low": low, "high": high})
    };
    json!({
        "motions": model.steady.iter().map(|own| own.name.clone()).collect::<Vec<_>>(),
        "parameters": valued.iter().map(parameter).collect::<Vec<_>>(),
    })
}

/// What is stated as the range of a parameter; otherwise as far again as its value, and never across zero where it is assumed positive.
fn range(model: &Model, parameter: &Parameter, value: f64) -> (f64, f64) {
    let number = |e: Expr| {
        let values = model.graph.evaluate_f64(&[e], &|_| None).ok()?;
        values.first().copied()
    };
    if let Some((low, high)) = parameter.range {
        if let (Some(low), Some(high)) = (number(low), number(high)) {
            return (low, high);
        }
    }
    let is_positive = model.assumptions.iter().any(|a| {
        let stated: String = a.text.split_whitespace().collect();
        stated == format!("{}>0", parameter.name)
    });
    match value {
        0.0 => (-1.0, 1.0),
        v if is_positive => (0.05 * v, 4.0 * v),
        v => (-2.0 * v.abs(), 2.0 * v.abs()),
    }
}
