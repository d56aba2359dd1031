//! The report of a functional.

use super::equations::{
    absent, boundary, dependence, euler, given, head, in_order, indexed_euler, indexed_natural,
    is_without_indices, joined, kind, labels, number, restricting, used, without_indices, Indexed,
    Shown, NO_INDICES,
};
use super::substitution::substituted;
use super::typesetting::{
    as_written, caption, field_name, formula, in_indices, in_print, vanishing, variation_name,
};
use super::{pictures, table};
use crate::page::{evidence, source};
use chetaev_functionals::functional::{Field, Functional, Role};
use chetaev_functionals::notation::written_equation;
use chetaev_functionals::study::Decided;
use chetaev_functionals::tensors::Shape;
use chetaev_functionals::variation::Variation;
use chetaev_functionals::Study;
use chetaev_report::data::{
    Claim, Definition, Equation, EquationSection, Fact, Formula, Parameter, Report,
    Reproducibility, Source,
};
use chetaev_symbolic::print::Format;
use chetaev_symbolic::simplify;
use chetaev_symbolic::Expr;

/// Longer equations are announced, not printed.
pub(super) const LEGIBLE: u64 = 2_500;

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
        tables: table::table(&study.problem)
            .into_iter()
            .chain(pictures::table(study))
            .collect(),
        sections: sections(study),
        figures: pictures::figures(study),
        maps: pictures::maps(study),
        claims: claims(study),
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
    own.filter(|p| !p.is_empty()).map(in_print).collect()
}

fn subtitle(f: &Functional) -> String {
    let level = f
        .level
        .as_ref()
        .map_or(String::new(), |level| format!(" of level {level}"));
    match f.space.dimensions() {
        1 => format!("A functional{level} in one dimension"),
        2 => format!("A functional{level} in two dimensions"),
        _ => format!("A functional{level} in three dimensions"),
    }
}

fn facts(f: &Functional) -> Vec<Fact> {
    let fact = |label: &str, value: String| Fact {
        label: label.into(),
        value,
        ..Fact::default()
    };
    let tensor = |label: &str, field: &Field| {
        let name = match &field.on {
            Some(on) => format!("{} on {on}", field.name),
            None => field.name.clone(),
        };
        Fact {
            note: Some(in_print(&field.description)).filter(|d| !d.is_empty()),
            formulas: vec![field_name(f, &name)],
            ..fact(
                label,
                format!("{}{}", kind(field.shape), dependence(f, field)),
            )
        }
    };
    let mut found = Vec::new();
    found.extend(f.level.clone().map(|level| fact("Level", level)));
    found.extend(f.fields.iter().map(|field| tensor("Varied", field)));
    found.extend(f.data.iter().map(|field| tensor("Given", field)));
    found.extend(f.functions.iter().map(|own| Fact {
        formulas: vec![formula(f, f.space.graph.symbol(&own.name, 0))],
        ..fact("Function", in_print(&own.description))
    }));
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
        name: variation_name(f, &label),
        label: Some(label),
        formula: vanishing(f, e),
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
        is_unnumbered: true,
        equations: all
            .iter()
            .map(|s| equation(f, s.of.clone(), s.value))
            .collect(),
        ..EquationSection::default()
    }
}

fn indexed(
    f: &Functional,
    id: &str,
    title: &str,
    explanation: &str,
    all: &[Indexed],
) -> EquationSection {
    let write = |own: &Indexed, format| written_equation(&own.value, &f.scope, format);
    let equations = all.iter().map(|own| Equation {
        name: variation_name(f, &own.of),
        label: Some(own.of.clone()),
        formula: Formula {
            mathml: Some(write(own, Format::Mathml)),
            text: write(own, Format::Text),
            latex: Some(write(own, Format::Latex)),
        },
        ..Equation::default()
    });
    let only_where = all.iter().filter_map(|own| own.only_where.as_ref());
    let only_where = only_where.map(|text| format!("The equation of it holds {text}."));
    EquationSection {
        id: id.into(),
        title: title.into(),
        explanation: std::iter::once(explanation.into())
            .chain(only_where)
            .collect(),
        equations: equations.collect(),
        is_unnumbered: true,
        ..EquationSection::default()
    }
}

fn sections(study: &Study) -> Vec<EquationSection> {
    let f = &study.problem.functional;
    let mut found = vec![densities(f), stated(f)];
    if let Ok(variation) = &study.variation {
        found.extend(inside(f, variation));
        let all = joined(f, boundary(f, variation));
        found.extend(
            all.iter()
                .flat_map(|(pieces, own)| on_pieces(f, pieces, own)),
        );
    }
    found.extend(with_imposed(f));
    found.retain(|s| !s.equations.is_empty() || s.id.starts_with("on-"));
    found
}

/// What follows where what is imposed is put in.
fn with_imposed(f: &Functional) -> Option<EquationSection> {
    let own = substituted(f)?;
    let said = format!(
        "With {} the fields that are left are varied freely; what follows stands here as far as it is short, with the place where it is not the interior.",
        own.texts().iter().map(|own| format!("`{own}`")).collect::<Vec<_>>().join(", ")
    );
    let on = own.boundary.into_iter().flat_map(|(piece, all)| {
        all.into_iter().map(move |shown| Shown {
            of: format!("{} on {piece}", shown.of),
            ..shown
        })
    });
    let mut all: Vec<Shown> = own.euler.into_iter().chain(on).collect();
    all.retain(|shown| simplify::length(&f.space.graph, shown.value) <= LEGIBLE);
    Some(EquationSection {
        collapsed: true,
        ..section(f, "put-in", "With what is imposed put in", &said, &all)
    })
}

/// What is to be stationary.
fn densities(f: &Functional) -> EquationSection {
    let whole = Equation {
        label: Some("over the body".into()),
        formula: in_indices(f, &f.tree),
        ..Equation::default()
    };
    let pieces = f.pieces.iter().filter(|own| own.written != "0");
    let pieces = pieces.filter_map(|own| {
        Some(Equation {
            label: Some(in_print(&format!("on {}", own.name))),
            formula: in_indices(f, own.tree.as_ref()?),
            ..Equation::default()
        })
    });
    let definitions = used(f).into_iter().map(|own| Definition {
        formula: as_written(f, &format!("{} = {}", own.name, own.written)),
        text: Some(in_print(&own.description)).filter(|words| !words.is_empty()),
    });
    EquationSection {
        id: "densities".into(),
        title: "The functional".into(),
        explanation: [
            "The sum of the integrals of these densities is to be stationary; an index that occurs twice is summed over.".into(),
        ]
        .into_iter()
        .chain(assumed(f))
        .collect(),
        equations: [whole].into_iter().chain(pieces).collect(),
        definitions: definitions.collect(),
        is_unnumbered: true,
        ..EquationSection::default()
    }
}

/// What is assumed, in a sentence.
fn assumed(f: &Functional) -> Option<String> {
    let own: Vec<String> = f.assumptions.iter().map(|own| format!("`{own}`")).collect();
    (!own.is_empty()).then(|| format!("Assumed is {}.", own.join(" and ")))
}

/// Euler equations, in index notation and in components.
fn inside(f: &Functional, variation: &Variation) -> Vec<EquationSection> {
    let own = indexed_euler(f, variation);
    let claim = Some(format!("functional.euler#{}", f.name));
    let mut in_words = "The coefficient of each variation in the interior vanishes.".to_owned();
    for name in absent(f, variation) {
        in_words.push_str(&format!(" That of δ{name} vanishes identically."));
    }
    let restricting = restricting(f);
    if !restricting.is_empty() {
        in_words.push_str(&format!(" That is so where all fields are varied freely; {restricting} restricts that, and only what the variations that are left ask has to hold."));
    }
    let open = without_indices(f, variation);
    if !open.is_empty() {
        in_words.push_str(&format!(" {}: {NO_INDICES}.", in_print(&open.join(", "))));
    }
    let has_pairs = f.interior().any(|field| field.shape == Shape::Symmetric);
    let in_components = if has_pairs && f.space.dimensions() > 1 {
        "A component off the diagonal of a symmetric tensor is one unknown; its equation is divided by two."
    } else {
        "The same equations, carried out."
    };
    let shown = euler(f, variation);
    if own.is_empty() {
        return vec![EquationSection {
            claim,
            ..section(f, "euler", "Euler equations", &in_words, &shown)
        }];
    }
    vec![
        EquationSection {
            claim,
            ..indexed(f, "euler", "Euler equations", &in_words, &own)
        },
        EquationSection {
            collapsed: true,
            ..section(
                f,
                "euler-components",
                "Euler equations in components",
                in_components,
                &shown,
            )
        },
    ]
}

/// The conditions on pieces that share them.
fn on_pieces(f: &Functional, pieces: &[String], conditions: &[Shown]) -> Vec<EquationSection> {
    let piece = pieces.first().map_or("", String::as_str);
    let names = in_print(&pieces.join(", "));
    let (id, title) = (format!("on-{piece}"), format!("Conditions on {names}"));
    let fixed = given(f, piece);
    let known = if fixed.is_empty() {
        String::new()
    } else {
        format!("Given here: {}. ", in_print(&fixed.join(", ")))
    };
    let own = indexed_natural(f, piece).unwrap_or_default();
    if own.is_empty() {
        let mut free = match (conditions.is_empty(), fixed.is_empty()) {
            (true, true) => "Nothing is free here, or every coefficient vanishes.",
            (true, false) => "Nothing else is free.",
            _ => "The coefficient of each variation that is free here vanishes.",
        }
        .to_owned();
        if is_without_indices(f, piece, conditions) {
            free.push_str(&format!(" They stand {NO_INDICES}."));
        }
        return vec![section(
            f,
            &id,
            &title,
            &format!("{known}{free}"),
            conditions,
        )];
    }
    let is_field = |of: &str| {
        f.fields
            .iter()
            .any(|field| head(of.trim_start_matches('δ')) == field.name)
    };
    let has_traction = own.iter().any(|own| !is_field(&own.of));
    let whole = if has_traction {
        " A traction is varied as a whole."
    } else {
        ""
    };
    let free =
        format!("{known}The coefficient of each variation that is free here vanishes.{whole}");
    vec![
        indexed(f, &id, &title, &free, &own),
        EquationSection {
            collapsed: true,
            ..section(
                f,
                &format!("{id}-components"),
                &format!("{title} in components"),
                "By the fields and their derivatives across the boundary.",
                conditions,
            )
        },
    ]
}

/// The equations that the model states, as written.
fn stated(f: &Functional) -> EquationSection {
    let roles = [Role::Imposed, Role::Yielded].into_iter();
    let mut all: Vec<_> = roles.flat_map(|role| in_order(f, role)).collect();
    all.sort_by_key(|own| number(&own.label));
    let equations = all.into_iter().map(|own| Equation {
        label: Some(format!("({})", own.label)),
        formula: as_written(f, &own.written),
        caption: Some(caption(own)),
        ..Equation::default()
    });
    EquationSection {
        id: "stated".into(),
        title: "Field equations".into(),
        explanation: vec!["As the model states them.".into()],
        equations: equations.collect(),
        is_unnumbered: true,
        ..EquationSection::default()
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
        None => Equation {
            name: None,
            ..equation(f, String::new(), shown.value)
        },
    }
}

/// Claims with the formulas of what they are decided of.
fn claims(study: &Study) -> Vec<Claim> {
    let f = &study.problem.of_claims().functional;
    study.verdicts.iter().map(|d| claim(f, d)).collect()
}

fn claim(f: &Functional, decided: &Decided) -> Claim {
    let verdict = &decided.finding.verdict;
    let mut claim = Claim {
        claim: decided.claim.into(),
        subject: decided.subject.clone(),
        title: Some(decided.title.into()),
        verdict: crate::page::word(verdict.word()),
        detail: in_print(verdict.detail()),
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
                caption: Some(in_print(&shown.caption)),
                label: None,
                ..step(f, shown)
            })
            .collect(),
        ..Claim::default()
    };
    evidence(&mut claim, verdict);
    claim.on = claim.on.map(|on| in_print(&on));
    claim
}
