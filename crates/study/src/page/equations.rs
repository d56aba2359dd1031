//! Lagrangian, constraints and the equations of motion, typeset.

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

/// Lagrangian, constraints and the equations of motion.
pub(super) fn sections(study: &Study, set: &Typesetter<'_>) -> Vec<EquationSection> {
    let mut sections = vec![lagrangian(study, set)];
    if !study.system.constraints.is_empty() {
        sections.push(constraints(study, set));
    }
    let known = crate::registry::registry();
    let prepared = &study.prepared;
    let cx = Context::new(
        &study.system,
        &prepared.terms,
        &prepared.selection,
        &known,
        Prover::default(),
    );
    let is_free = study.system.constraints.is_empty();
    let mut signs = 0;
    if let Ok(routh) = derive(&cx, "routh") {
        signs = signs_of(&routh, set);
        let (title, explanation) = if is_free {
            ("Lagrange's equations", "One equation for each coordinate.")
        } else if prepared.terms.order > 1 {
            ("Routh's equations with multipliers", "Lagrange's equations of all coordinates; the reaction of each constraint f = left − right is λ times its gradient by the derivatives of highest order.")
        } else {
            ("Routh's equations with multipliers", "Lagrange's equations of all coordinates; the reaction of each constraint f = left − right is λ ∂f/∂q′.")
        };
        sections.push(formulation(&routh, set, title, explanation));
        if !routh.multipliers.is_empty() {
            sections.push(multipliers(study, &routh, set));
        }
    }
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
            sections.push(not_derived(card, signs));
            continue;
        }
        if let Ok(derived) = derive(&cx, card.name) {
            sections.push(other_formulation(card, &derived, set));
        }
    }
    sections
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

/// A formulation beside Routh's: what it is, its general form, its equations and intermediate objects. Maggi's stand open.
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
    section.collapsed = true;
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
    EquationSection {
        id: "lagrangian".into(),
        title: "Lagrangian".into(),
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
    let mut equations = Vec::new();
    for group in &derived.groups {
        if derived.formulation == "routh" && group.title == "constraints" {
            continue;
        }
        let readable = set.readable(derived, &group.equations);
        for ((left, right), stated) in readable.into_iter().zip(&group.equations) {
            equations.push(Equation {
                label: Some(stated.label.clone()),
                name: (stated.label != "constraint").then(|| set.name(&stated.label)),
                ..set.equation(left, right)
            });
        }
    }
    EquationSection {
        id: derived.formulation.into(),
        title: title.into(),
        explanation: vec![explanation.into()],
        collapsed: equations.len() > 16,
        equations,
        ..EquationSection::default()
    }
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
