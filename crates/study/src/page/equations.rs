//! Lagrangian, constraints and the equations of motion, typeset.

use crate::board;
use crate::derivation::{check_applies, claim_of};
use crate::study::Study;
use crate::typeset::{length_in_words, Typesetter};
use chetaev_mechanics::card::{Card, Relation};
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::equations::NamedExpr;
use chetaev_mechanics::{Context, Equations, Prover, FORMULATIONS};
use chetaev_report::data::{Equation, EquationSection};
use chetaev_symbolic::Expr;

/// Where Routh's equations have more signs than this, those of other formulations are not derived for the page: nobody reads them
/// there, and to derive them all takes many times as long as what was asked for.
const DERIVED: u64 = 400_000;

/// Lagrangian, constraints and the equations of motion: the form that is shortest to read stands open, the others are folded.
pub(super) fn sections(study: &Study, set: &Typesetter<'_>) -> Vec<EquationSection> {
    let mut sections = vec![lagrangian(study, set)];
    if !study.system.constraints.is_empty() {
        sections.push(constraints(study, set));
    }
    let known = crate::registry::registry();
    let prepared = &study.prepared;
    if prepared.degenerate.is_some() {
        return sections;
    }
    let cx = Context::of(&study.system, prepared, &known, Prover::default());
    let mut forms = Vec::new();
    let mut signs = 0;
    if let Ok(routh) = derive(&cx, "routh") {
        signs = signs_of(&routh, set);
        forms.extend(with_multipliers(study, &routh, set));
    }
    let is_free = study.system.constraints.is_empty();
    for form in FORMULATIONS {
        let card = form.card();
        if card.relation == Relation::Reference || check_applies(&cx, card).is_err() {
            continue;
        }
        // Without constraints and quasi-velocities Maggi's equations are Lagrange's again.
        let is_again = card.name == "maggi" && is_free && study.model.quasi_velocities.is_empty();
        if is_again {
            continue;
        }
        if signs > DERIVED {
            forms.push(not_derived(card, signs));
            continue;
        }
        if let Ok(derived) = derive(&cx, card.name) {
            forms.push(other_formulation(card, &derived, set));
        }
    }
    let forms = shortest_first(forms);
    let open = forms.first().filter(|form| !form.collapsed);
    let steps = open.and_then(|form| board::section(&cx, &form.id, set));
    let mut forms = forms.into_iter();
    sections.extend(forms.next());
    sections.extend(steps);
    sections.extend(forms);
    sections
}

/// Routh's equations, and the reactions that they contain.
fn with_multipliers(
    study: &Study,
    routh: &Equations,
    set: &Typesetter<'_>,
) -> Vec<EquationSection> {
    let (title, explanation) = if study.system.constraints.is_empty() {
        ("Lagrange's equations", "One equation for each coordinate.")
    } else if study.prepared.terms.order > 1 {
        ("Routh's equations with multipliers", "Lagrange's equations of all coordinates; the reaction of each constraint f = left − right is λ times its gradient by the derivatives of highest order.")
    } else {
        ("Routh's equations with multipliers", "Lagrange's equations of all coordinates; the reaction of each constraint f = left − right is λ ∂f/∂q′.")
    };
    let mut sections = vec![formulation(routh, set, title, explanation)];
    if !routh.multipliers.is_empty() {
        sections.push(multipliers(study, routh, set));
    }
    sections
}

/// The forms that are compared for what stands open: the first two unless they are longer by more than half, as in the overview of a terminal.
const CHOSEN: [(&str, usize); 3] = [("reduced", 2), ("maggi", 2), ("routh", 3)];

/// Characters of equations up to which they stand open.
const OPEN: usize = 6_000;

/// The shorter of the forms to choose from first and open, everything else folded.
fn shortest_first(mut forms: Vec<EquationSection>) -> Vec<EquationSection> {
    for form in &mut forms {
        form.collapsed = true;
    }
    let length = |form: &EquationSection| -> usize {
        let shown = form
            .equations
            .iter()
            .map(|e| e.formula.text.chars().count());
        let shared = form.definitions.iter();
        let own = form.equations.iter().flat_map(|e| &e.definitions);
        let defined = own.chain(shared).map(|d| d.formula.text.chars().count());
        shown.chain(defined).sum()
    };
    let candidates = forms.iter().enumerate().filter_map(|(place, form)| {
        let (_, weight) = CHOSEN.iter().find(|(id, _)| *id == form.id)?;
        (!form.equations.is_empty()).then(|| (weight * length(form), place))
    });
    if let Some((_, place)) = candidates.min() {
        let mut first = forms.remove(place);
        first.collapsed = length(&first) > OPEN;
        forms.insert(0, first);
    }
    forms
}

/// The length of all equations.
fn signs_of(derived: &Equations, set: &Typesetter<'_>) -> u64 {
    let equations = derived.groups.iter().flat_map(|group| &group.equations);
    let sides: Vec<Expr> = equations.flat_map(|e| [e.left, e.right]).collect();
    set.signs(&sides)
}

/// A formulation of a system whose equations nobody reads: what it is, and where its equations are to be had.
fn not_derived(card: &Card, signs: u64) -> EquationSection {
    let why = format!(
        "Not derived for this page, since Routh's equations of this system have {}. `chetaev derive MODEL --formulation {}` derives and prints them.",
        length_in_words(signs),
        card.name
    );
    EquationSection {
        id: card.name.into(),
        title: card.title.into(),
        explanation: vec![card.statement.into(), why],
        claim: claim_of(card),
        collapsed: true,
        ..EquationSection::default()
    }
}

/// A formulation beside Routh's: what it is, its general form, its equations and intermediate objects.
fn other_formulation(card: &Card, derived: &Equations, set: &Typesetter<'_>) -> EquationSection {
    let mut section = formulation(derived, set, card.title, card.statement);
    let schemas = derived.groups.iter().filter_map(|group| group.schema);
    section
        .explanation
        .extend(schemas.map(|schema| format!("General form: {}.", schema.text)));
    section.claim = claim_of(card);
    if card.name == "maggi" {
        return section;
    }
    let values: Vec<Expr> = derived.objects.iter().map(|o| o.value).collect();
    let stated: Vec<(&NamedExpr, Expr)> = derived
        .objects
        .iter()
        .zip(set.simplified(&values))
        .filter(|(_, value)| set.is_legible(*value))
        .collect();
    for (object, value) in stated {
        section.equations.push(Equation {
            caption: Some(object.meaning.clone()),
            ..set.object(object, value)
        });
    }
    section
}

fn lagrangian(study: &Study, set: &Typesetter<'_>) -> EquationSection {
    let g = &study.model.graph;
    let mut equations = Vec::new();
    let parts = [("T", study.model.kinetic), ("V", study.model.potential)];
    for (name, value) in parts {
        if let Some(value) = value {
            equations.push(set.equation(g.symbol(name, 0), value));
        }
    }
    if study.model.kinetic.is_none() {
        equations.push(set.equation(g.symbol("L", 0), study.model.lagrangian));
    }
    let system = &study.system;
    for (letter, forces) in [
        ("Q", system.applied_forces()),
        ("Psi", system.reactive_forces.clone()),
    ] {
        for (c, force) in system.coordinates.iter().zip(forces) {
            if !g.is_zero(force) {
                equations.push(set.equation(g.symbol(&format!("{letter}_{}", c.name), 0), force));
            }
        }
    }
    for mass in &system.masses {
        equations.push(set.equation(g.symbol(&mass.name, 1), mass.rate));
    }
    for d in &study.model.defines {
        let mut equation = set.equation(g.symbol(&d.name, 0), d.value);
        equation.caption = (!d.description.is_empty()).then(|| d.description.clone());
        equations.push(equation);
    }
    // What is long is read when somebody asks for it.
    let characters: usize = (equations.iter())
        .map(|e| e.formula.text.chars().count())
        .sum();
    EquationSection {
        id: "lagrangian".into(),
        title: "Lagrangian".into(),
        collapsed: characters > OPEN,
        equations,
        ..EquationSection::default()
    }
}

fn constraints(study: &Study, set: &Typesetter<'_>) -> EquationSection {
    let equations = study
        .model
        .constraints
        .iter()
        .map(|c| Equation {
            label: Some(c.name.clone()),
            caption: (!c.description.is_empty()).then(|| c.description.clone()),
            ..set.equation(c.left, c.right)
        })
        .collect();
    EquationSection {
        id: "constraints".into(),
        title: "Constraints".into(),
        equations,
        claim: Some("model.constraints-independent".into()),
        ..EquationSection::default()
    }
}

fn formulation(
    derived: &Equations,
    set: &Typesetter<'_>,
    title: &str,
    explanation: &str,
) -> EquationSection {
    let groups = derived.groups.iter();
    let groups =
        groups.filter(|group| derived.formulation != "routh" || group.title != "constraints");
    let mut stated = Vec::new();
    let mut pairs = Vec::new();
    for group in groups {
        pairs.extend(set.readable(derived, &group.equations));
        stated.extend(&group.equations);
    }
    let mut section = EquationSection {
        id: derived.formulation.into(),
        title: title.into(),
        explanation: vec![explanation.into()],
        ..EquationSection::default()
    };
    let printed = match pairs
        .iter()
        .all(|&(l, r)| set.is_legible(l) && set.is_legible(r))
    {
        true => pairs.iter().map(|&(l, r)| set.equation(l, r)).collect(),
        // Long equations share most of their parts, which are named once.
        false => match set.shared(&pairs) {
            Some((printed, definitions)) => {
                section.definitions = definitions;
                printed
            }
            None => {
                let command = format!(
                    "`chetaev derive MODEL --formulation {}`",
                    derived.formulation
                );
                section.explanation.push(format!(
                    "These equations have {}; {command} prints them.",
                    length_in_words(signs_of(derived, set))
                ));
                Vec::new()
            }
        },
    };
    section.equations = printed
        .into_iter()
        .zip(stated)
        .map(|(printed, stated)| Equation {
            label: Some(stated.label.clone()),
            name: (stated.label != "constraint").then(|| set.name(&stated.label)),
            ..printed
        })
        .collect();
    section
}

fn multipliers(study: &Study, routh: &Equations, set: &Typesetter<'_>) -> EquationSection {
    let g = &study.model.graph;
    let values: Vec<Expr> = routh.multipliers.iter().map(|(_, value)| *value).collect();
    let short = set.simplified(&values);
    let closed = short.iter().all(|&value| set.is_legible(value));
    let (objects, stated): (Vec<_>, Vec<_>) = routh
        .objects
        .iter()
        .zip(short)
        .filter(|(_, value)| set.is_legible(*value))
        .map(|(object, value)| (object, (g.symbol(&object.name, 0), value)))
        .unzip();
    let (equations, definitions) = set.equations(&stated);
    let equations = objects
        .into_iter()
        .zip(equations)
        .map(|(object, equation)| Equation {
            caption: Some(object.meaning.clone()),
            ..equation
        })
        .collect();
    EquationSection {
        id: "reactions".into(),
        title: "Reactions".into(),
        explanation: vec![if closed {
            "The multipliers as functions of coordinates and velocities, from the equations of motion and the constraints differentiated once.".into()
        } else {
            "Multipliers that are too long to read as formulas are the solution of a linear system: Routh's equations above together with the constraints differentiated once.".into()
        }],
        equations,
        definitions,
        ..EquationSection::default()
    }
}
