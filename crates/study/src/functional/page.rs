//! The report of a functional.

use super::{
    boundary, document, euler, indexed_euler, indexed_natural, labels, options, pictures, table,
    Indexed, Shown,
};
use crate::page::{evidence, source};
use chetaev_functionals::functional::{Functional, Role};
use chetaev_functionals::notation::{parse_sides, written, written_equation, Node};
use chetaev_functionals::study::Decided;
use chetaev_functionals::Study;
use chetaev_report::data::{
    Claim, Equation, EquationSection, Fact, Formula, Parameter, Report, Reproducibility, Source,
};
use chetaev_symbolic::print::{Document, Format};
use chetaev_symbolic::simplify;
use chetaev_symbolic::Expr;

/// Longer equations are announced, not printed.
const LEGIBLE: u64 = 2_500;

/// The HTML page of a study.
pub fn page(study: &Study, command: Option<String>) -> String {
    chetaev_report::render(&report(study, command))
}

fn report(study: &Study, command: Option<String>) -> Report {
    let f = &study.problem.functional;
    Report {
        title: f.name.clone(),
        subtitle: Some(subtitle(f)),
        description: paragraphs(&f.description),
        sources: f
            .sources
            .iter()
            .map(|text| Source {
                text: text.clone(),
                link: None,
            })
            .collect(),
        facts: facts(f),
        parameters: f.parameters.iter().map(|p| parameter(f, p)).collect(),
        tables: vec![table::table(&study.problem)],
        sections: sections(study),
        figures: pictures::figures(study),
        maps: pictures::maps(study),
        claims: study.verdicts.iter().map(|d| claim(f, d)).collect(),
        model: Some(source(&study.problem.text)),
        notices: study.notices.clone(),
        reproducibility: Reproducibility {
            version: env!("CARGO_PKG_VERSION").into(),
            seed: None,
            command,
            details: Vec::new(),
        },
        ..Report::default()
    }
}

fn paragraphs(text: &str) -> Vec<String> {
    let own = text.split("\n\n").map(str::trim);
    own.filter(|p| !p.is_empty()).map(str::to_owned).collect()
}

fn subtitle(f: &Functional) -> String {
    let level = f
        .level
        .as_ref()
        .map_or(String::new(), |level| format!(" of level {level}"));
    format!("A functional{level} in {} dimensions", f.space.dimensions())
}

fn facts(f: &Functional) -> Vec<Fact> {
    let fact = |label: &str, value: String| Fact {
        label: label.into(),
        value,
        ..Fact::default()
    };
    let mut found = Vec::new();
    found.extend(f.level.clone().map(|level| fact("Level", level)));
    for field in &f.fields {
        let on = field
            .on
            .as_ref()
            .map_or(String::new(), |on| format!(" on {on}"));
        found.push(Fact {
            note: Some(field.description.clone()).filter(|d| !d.is_empty()),
            ..fact(
                "Varied",
                format!("{}, {}{on}", field.name, field.shape.word()),
            )
        });
    }
    found.push(fact("Density", f.written.clone()));
    for piece in &f.pieces {
        found.push(fact(&format!("On {}", piece.name), piece.written.clone()));
    }
    for (role, label) in [
        (Role::Imposed, "Imposed"),
        (Role::Yielded, "Stated to follow"),
    ] {
        let own = labels(f, role);
        if !own.is_empty() {
            found.push(fact(label, own));
        }
    }
    found
}

fn parameter(f: &Functional, p: &chetaev_functionals::functional::Parameter) -> Parameter {
    let g = &f.space.graph;
    Parameter {
        name: formula(f, g.symbol(&p.name, 0)),
        value: p.value.map(|value| g.text(value)),
        description: Some(p.description.clone()).filter(|d| !d.is_empty()),
        ..Parameter::default()
    }
}

fn formula(f: &Functional, e: Expr) -> Formula {
    of_document(&Document::expressions(&f.space.graph, &[e], &options(f)))
}

fn of_document(document: &Document) -> Formula {
    Formula {
        mathml: Some(document.render(Format::Mathml)),
        text: document.render(Format::Text),
        latex: Some(document.render(Format::Latex)),
    }
}

fn equation(f: &Functional, label: String, e: Expr) -> Equation {
    let signs = simplify::length(&f.space.graph, e);
    if signs > LEGIBLE {
        return Equation {
            label: Some(label),
            omitted: Some(format!(
                "An expression of {signs} signs; `study.json` has it."
            )),
            ..Equation::default()
        };
    }
    Equation {
        label: Some(label),
        formula: of_document(&document(f, e)),
        ..Equation::default()
    }
}

fn section(
    f: &Functional,
    id: &str,
    title: &str,
    explanation: &str,
    all: &[Shown],
) -> EquationSection {
    EquationSection {
        id: id.into(),
        title: title.into(),
        explanation: vec![explanation.into()],
        equations: all
            .iter()
            .map(|s| equation(f, s.of.clone(), s.value))
            .collect(),
        ..EquationSection::default()
    }
}

fn in_indices(
    f: &Functional,
    id: &str,
    title: &str,
    explanation: &str,
    all: &[Indexed],
) -> EquationSection {
    let write = |own: &Indexed, format| written_equation(&own.value, &f.scope, format);
    let equations = all.iter().map(|own| Equation {
        label: Some(own.of.clone()),
        formula: Formula {
            mathml: Some(write(own, Format::Mathml)),
            text: write(own, Format::Text),
            latex: Some(write(own, Format::Latex)),
        },
        ..Equation::default()
    });
    EquationSection {
        id: id.into(),
        title: title.into(),
        explanation: vec![explanation.into()],
        equations: equations.collect(),
        ..EquationSection::default()
    }
}

fn sections(study: &Study) -> Vec<EquationSection> {
    let f = &study.problem.functional;
    let mut found = vec![stated(f)];
    let Ok(variation) = &study.variation else {
        return found;
    };
    let indexed = indexed_euler(f, variation);
    let claim = Some(format!("functional.euler#{}", f.name));
    let in_words = "The coefficient of each variation in the interior vanishes.";
    let in_components = "A component off the diagonal of a symmetric tensor is one unknown; its equation is divided by two.";
    if indexed.is_empty() {
        let words = format!("{in_words} {in_components}");
        found.push(EquationSection {
            claim,
            ..section(f, "euler", "Euler equations", &words, &euler(f, variation))
        });
    } else {
        found.push(EquationSection {
            claim,
            ..in_indices(f, "euler", "Euler equations", in_words, &indexed)
        });
        found.push(EquationSection {
            collapsed: true,
            ..section(
                f,
                "euler-components",
                "Euler equations in components",
                in_components,
                &euler(f, variation),
            )
        });
    }
    for (piece, conditions) in boundary(f, variation) {
        if let Some(indexed) = indexed_natural(f, &piece).filter(|own| !own.is_empty()) {
            found.push(in_indices(
                f,
                &format!("on-{piece}"),
                &format!("Conditions on {piece}"),
                "The coefficient of each variation that is free here vanishes. A traction is varied as a whole.",
                &indexed,
            ));
            found.push(EquationSection {
                collapsed: true,
                ..section(
                    f,
                    &format!("on-{piece}-components"),
                    &format!("Conditions on {piece} in components"),
                    "By the fields and their derivatives across the boundary.",
                    &conditions,
                )
            });
            continue;
        }
        let explanation = if conditions.is_empty() {
            "Nothing is free here, or every coefficient vanishes."
        } else {
            "The coefficient of each variation that is free here vanishes."
        };
        let title = format!("Conditions on {piece}");
        found.push(section(
            f,
            &format!("on-{piece}"),
            &title,
            explanation,
            &conditions,
        ));
    }
    found.retain(|s| !s.equations.is_empty() || s.id.starts_with("on-"));
    found
}

/// The equations that the model states, as written.
fn stated(f: &Functional) -> EquationSection {
    let equations = f
        .equations
        .iter()
        .filter(|e| e.role != Role::Other)
        .map(|e| {
            let on =
                e.on.as_ref()
                    .map_or(String::new(), |on| format!(" on {on}"));
            let role = match e.role {
                Role::Imposed => "imposed",
                _ => "stated to follow",
            };
            Equation {
                label: Some(format!("({})", e.label)),
                formula: as_stated(f, e),
                caption: Some(format!("{}{on}; {role}", e.title)),
                ..Equation::default()
            }
        });
    EquationSection {
        id: "stated".into(),
        title: "Field equations".into(),
        explanation: vec!["As the model states them.".into()],
        equations: equations.collect(),
        ..EquationSection::default()
    }
}

/// A stated equation, typeset as it is written.
fn as_stated(f: &Functional, e: &chetaev_functionals::functional::Equation) -> Formula {
    let sides = parse_sides(&e.written, &f.scope, &mut Vec::new());
    let Some((left, right)) = sides else {
        return Formula {
            text: e.written.clone(),
            ..Formula::default()
        };
    };
    let zero = Node::number(0, left.span);
    let right = right.unwrap_or(zero);
    let side = |node: &Node, format| written(node, &f.scope, format);
    let inner = |node: &Node| {
        let own = side(node, Format::Mathml);
        let own = own.strip_prefix("<math>").unwrap_or(&own);
        own.strip_suffix("</math>").unwrap_or(own).to_owned()
    };
    Formula {
        mathml: Some(format!(
            "<math>{}<mo>=</mo>{}</math>",
            inner(&left),
            inner(&right)
        )),
        text: e.written.clone(),
        latex: Some(format!(
            "{} = {}",
            side(&left, Format::Latex),
            side(&right, Format::Latex)
        )),
    }
}

/// A formula of a verdict: in index notation, where it has such a form.
fn step(f: &Functional, shown: &chetaev_functionals::claims::Formula) -> Equation {
    match &shown.indexed {
        Some(own) => Equation {
            formula: Formula {
                mathml: Some(own.mathml.clone()),
                text: own.text.clone(),
                latex: Some(own.latex.clone()),
            },
            ..Equation::default()
        },
        None => equation(f, String::new(), shown.value),
    }
}

fn claim(f: &Functional, decided: &Decided) -> Claim {
    let verdict = &decided.finding.verdict;
    let mut claim = Claim {
        claim: decided.claim.into(),
        subject: decided.subject.clone(),
        title: Some(decided.title.into()),
        verdict: crate::page::word(verdict.word()),
        detail: verdict.detail().into(),
        expected: match decided.expected.first() {
            Some(_) if decided.is_as_expected() => Some(crate::page::word(verdict.word())),
            first => first.map(|w| crate::page::word(w)),
        },
        seconds: Some(decided.seconds),
        formulas: decided
            .finding
            .formulas
            .iter()
            .map(|shown| Equation {
                caption: Some(shown.caption.clone()),
                label: None,
                ..step(f, shown)
            })
            .collect(),
        ..Claim::default()
    };
    evidence(&mut claim, verdict);
    claim
}
