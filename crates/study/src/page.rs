//! The report of a study: plain data for the report crate.

mod claims;
mod comparison;
mod default_drawing;
mod drawing;
mod equations;
mod modes;
mod motion;
mod steady;

pub(crate) use claims::{evidence, word};
pub use drawing::scene;

use crate::overview::found::{found, Found};
use crate::study::Study;
use crate::typeset::{in_line, Typesetter};
use chetaev_mechanics::words::counted;
use chetaev_mechanics::Prover;
use chetaev_model::model::{Assumption as Stated, ModelText};
use chetaev_model::Relation;
use chetaev_report::data::{
    Assumption, Fact, Formula, Found as Sentences, InitialValue, ModelSource, Origin, Parameter,
    Report, Reproducibility, Source, SourceFile,
};

/// The HTML page of a study.
pub fn page(study: &Study, command: Option<String>, files: &[String]) -> String {
    chetaev_report::render(&report(study, command, files))
}

/// The report as data.
pub fn report(study: &Study, command: Option<String>, files: &[String]) -> Report {
    let model = &study.model;
    let set = Typesetter::new(&study.system);
    let of_motion = study.motion.as_ref().map(motion::figures);
    Report {
        title: title(&model.name),
        subtitle: Some(subtitle(study)),
        description: paragraphs(&model.description),
        history: paragraphs(&model.history),
        sources: model
            .source
            .iter()
            .map(|text| Source {
                text: text.clone(),
                link: None,
            })
            .collect(),
        found: found(study).into_iter().map(set_found).collect(),
        facts: facts(study, &set),
        parameters: parameters(study, &set),
        assumptions: assumptions(study, &set),
        initial: initial(study, &set),
        tables: steady::section(study).into_iter().collect(),
        maps: Vec::new(),
        sections: equations::sections(study, &set),
        claims: study
            .verdicts
            .iter()
            .map(|d| claims::claim(d, &set))
            .collect(),
        trajectory: study
            .motion
            .as_ref()
            .map(|m| motion::trajectory(study, m, &set, files)),
        figures: of_motion.unwrap_or_default(),
        comparison: study
            .motion
            .as_ref()
            .and_then(|m| comparison::comparison(study, m)),
        animation: scene(study),
        model: Some(source(&study.model.text)),
        notices: study.notices.clone(),
        reproducibility: Reproducibility {
            version: env!("CARGO_PKG_VERSION").into(),
            seed: Some(Prover::default().seed),
            command,
            details: Vec::new(),
        },
    }
}

/// What was found, its formulas as they are read.
fn set_found(found: Found) -> Sentences {
    let begun = |text: &String| {
        let mut letters = text.chars();
        letters.next().map_or_else(String::new, |first| {
            first.to_uppercase().chain(letters).collect::<String>()
        })
    };
    let subject = found.subject.to_owned();
    Sentences {
        subject: begun(&subject),
        sentences: found.sentences.iter().map(|said| in_line(said)).collect(),
        claims: found.claims,
    }
}

/// `chaplygin-sleigh` becomes "Chaplygin sleigh"; a name with spaces stays.
fn title(name: &str) -> String {
    let spaced = if name.contains(' ') {
        name.to_string()
    } else {
        name.replace('-', " ")
    };
    let mut letters = spaced.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => spaced,
    }
}

fn subtitle(study: &Study) -> String {
    let n = study.system.n();
    [
        counted(n, "coordinate", "coordinates"),
        counted(study.system.constraints.len(), "constraint", "constraints"),
        independent(study),
    ]
    .join(", ")
}

/// "2 independent velocities", and "1 independent derivative of order 3" where the constraints are of that order.
pub(crate) fn independent(study: &Study) -> String {
    if let Some(degenerate) = &study.prepared.degenerate {
        return format!("gradients of rank {}", degenerate.rank);
    }
    let k = study.system.n() - study.prepared.selection.rows.len();
    match study.prepared.terms.order {
        1 => counted(k, "independent velocity", "independent velocities"),
        order => {
            let counted = counted(k, "independent derivative", "independent derivatives");
            format!("{counted} of order {order}")
        }
    }
}

fn paragraphs(text: &str) -> Vec<String> {
    text.split("\n\n")
        .map(|p| p.trim().replace('\n', " "))
        .filter(|p| !p.is_empty())
        .collect()
}

fn fact(label: &str, value: String, symbol: Option<&str>, claim: Option<&str>) -> Fact {
    Fact {
        label: label.into(),
        value,
        symbol: symbol.map(String::from),
        claim: claim.map(String::from),
        ..Fact::default()
    }
}

/// More names than these are not listed in a line.
const LISTED: usize = 24;

fn facts(study: &Study, set: &Typesetter<'_>) -> Vec<Fact> {
    let system = &study.system;
    let n = system.n();
    let degenerate = study.prepared.degenerate.as_ref();
    let r = degenerate.map_or(study.prepared.selection.rows.len(), |own| own.rank);
    let mut coordinates = fact("Coordinates", n.to_string(), Some("n"), None);
    coordinates.formulas = system
        .coordinates
        .iter()
        .take(LISTED)
        .map(|c| set.name(&c.name))
        .collect();
    if n > LISTED {
        coordinates.note = Some(format!("and {} more", n - LISTED));
    }
    let mut facts = vec![
        coordinates,
        fact(
            match degenerate {
                Some(_) => "Rank of the gradients",
                None => "Independent constraints",
            },
            r.to_string(),
            Some("r"),
            Some("model.constraints-independent"),
        ),
    ];
    if degenerate.is_none() {
        facts.push(fact(
            match study.prepared.terms.order {
                1 => "Independent velocities",
                _ => "Independent derivatives",
            },
            (n - r).to_string(),
            Some("k"),
            Some("model.accelerations-unique"),
        ));
    }
    facts.extend(classes(study));
    facts
}

/// One fact for each class of constraints, in the order of first appearance.
fn classes(study: &Study) -> Vec<Fact> {
    let mut classes: Vec<(String, Vec<&str>)> = Vec::new();
    for c in &study.system.constraints {
        let time = if c.rheonomic {
            "rheonomic"
        } else {
            "scleronomic"
        };
        let class = format!("{}, {time}", c.kind.word());
        match classes.iter_mut().find(|(known, _)| *known == class) {
            Some((_, names)) => names.push(&c.name),
            None => classes.push((class, vec![&c.name])),
        }
    }
    classes
        .into_iter()
        .map(|(class, names)| {
            let label = match &names[..] {
                [only] => format!("Constraint {only}"),
                [some @ .., last] if names.len() <= 4 => {
                    format!("Constraints {} and {last}", some.join(", "))
                }
                _ => format!("{} constraints", names.len()),
            };
            fact(&label, class, None, Some("model.constraints-linear"))
        })
        .collect()
}

fn parameters(study: &Study, set: &Typesetter<'_>) -> Vec<Parameter> {
    let g = &study.model.graph;
    study
        .model
        .parameters
        .iter()
        .map(|p| {
            let number = p
                .value
                .and_then(|v| g.evaluate_f64(&[v], &|_| None).ok())
                .map(|v| v[0]);
            let value = p.value.map(|v| match (g.as_number(v), number) {
                (Some(exact), _) if exact.is_int() => exact.to_string().replace('-', "−"),
                (_, Some(number)) => significant(number),
                _ => g.text(v),
            });
            let stated = p.definition.filter(|&d| g.as_number(d).is_none());
            Parameter {
                name: set.name(&p.name),
                value,
                stated: stated.map(|d| set.inline(d)),
                unit: p.unit.as_ref().map(|u| u.text.clone()).filter(|u| u != "1"),
                range: p.range.map(|(low, high)| {
                    let [low, high] =
                        [low, high].map(|end| match g.evaluate_f64(&[end], &|_| None) {
                            Ok(value) => significant(value[0]),
                            Err(_) => g.text(end),
                        });
                    format!("{low} to {high}")
                }),
                description: (!p.description.is_empty()).then(|| p.description.clone()),
            }
        })
        .collect()
}

/// Ten significant digits without trailing zeros.
fn significant(x: f64) -> String {
    let magnitude = if x == 0.0 {
        0
    } else {
        x.abs().log10().floor() as i32
    };
    if !(-4..12).contains(&magnitude) {
        return format!("{x:.6e}");
    }
    let decimals = (9 - magnitude).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0')
            .trim_end_matches('.')
            .replace('-', "−")
    } else {
        text.replace('-', "−")
    }
}

/// Each statement once: a chain `0 < a < b` is stored as two relations with the same text.
fn assumptions(study: &Study, set: &Typesetter<'_>) -> Vec<Assumption> {
    let mut chains: Vec<Vec<&Stated>> = Vec::new();
    for a in &study.model.assumptions {
        match chains.last_mut() {
            Some(chain)
                if chain
                    .last()
                    .is_some_and(|b| b.text == a.text && b.right == a.left) =>
            {
                chain.push(a);
            }
            _ => chains.push(vec![a]),
        }
    }
    chains
        .iter()
        .map(|chain| Assumption {
            formula: relations(chain, set),
            note: None,
        })
        .collect()
}

/// `a < b < c` in every notation.
fn relations(chain: &[&Stated], set: &Typesetter<'_>) -> Formula {
    let Some(first) = chain.first() else {
        return Formula::default();
    };
    let mut whole = set.inline(first.left);
    for link in chain {
        let (sign, latex) = match link.relation {
            Relation::Equal => ("=", "="),
            Relation::NotEqual => ("≠", "\\ne"),
            Relation::Less => ("&lt;", "<"),
            Relation::LessOrEqual => ("≤", "\\le"),
            Relation::Greater => ("&gt;", ">"),
            Relation::GreaterOrEqual => ("≥", "\\ge"),
        };
        let right = set.inline(link.right);
        whole.mathml = whole
            .mathml
            .zip(right.mathml)
            .map(|(a, b)| format!("{a}<mo>{sign}</mo>{b}"));
        whole.latex = whole
            .latex
            .zip(right.latex)
            .map(|(a, b)| format!("{a} {latex} {b}"));
    }
    whole.text.clone_from(&first.text);
    whole
}

fn initial(study: &Study, set: &Typesetter<'_>) -> Vec<InitialValue> {
    let Some(motion) = &study.motion else {
        return Vec::new();
    };
    let model = &study.model;
    let n = study.system.n();
    motion
        .evidence
        .start
        .iter()
        .enumerate()
        .map(|(place, (name, value))| {
            let given = model.initial.values.get(&(place % n, (place / n) as u32));
            let is_projected = motion
                .start
                .completed
                .iter()
                .any(|(changed, _)| changed == name);
            InitialValue {
                name: set.name(name),
                value: *value,
                // A decimal is the value itself and is not written twice.
                stated: given
                    .filter(|g| g.text.trim().parse() != Ok(*value))
                    .map(|g| set.inline(g.value)),
                unit: unit(study, place % n, place / n),
                origin: match (given, is_projected) {
                    (_, true) => Origin::Projected,
                    (Some(_), _) => Origin::Given,
                    _ => Origin::Default,
                },
            }
        })
        .collect()
}

/// The unit of a coordinate, of its velocity (order 1) or acceleration.
pub(crate) fn unit(study: &Study, coordinate: usize, order: usize) -> Option<String> {
    let unit = &study.model.coordinates.get(coordinate)?.unit.as_ref()?.text;
    let time = match order {
        0 => return (unit != "1").then(|| unit.clone()),
        1 => "s",
        _ => "s²",
    };
    Some(if unit.contains(['/', ' ']) {
        format!("({unit})/{time}")
    } else {
        format!("{unit}/{time}")
    })
}

/// The texts of a model with what was overridden.
pub(crate) fn source(text: &ModelText) -> ModelSource {
    let mut files = vec![SourceFile {
        name: text.path.clone(),
        text: text.text.clone(),
    }];
    files.extend(text.includes.iter().map(|(name, text)| SourceFile {
        name: name.clone(),
        text: text.clone(),
    }));
    ModelSource {
        files,
        overrides: text
            .overrides
            .iter()
            .map(|(name, value)| format!("{name} = {value}"))
            .collect(),
    }
}
