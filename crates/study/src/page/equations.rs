//! Lagrangian, constraints and the equations of motion, typeset.

use crate::study::Study;
use crate::typeset::Typesetter;
use chetaev_mechanics::claims::formulation::derive;
use chetaev_mechanics::{Context, Equations, Prover};
use chetaev_report::data::{Equation, EquationSection};
use chetaev_symbolic::Expr;

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
    if let Ok(routh) = derive(&cx, "routh") {
        let (title, explanation) = if is_free {
            ("Lagrange's equations", "One equation for each coordinate.")
        } else {
            ("Routh's equations with multipliers", "Lagrange's equations of all coordinates; the reaction of each constraint f = left − right is λ ∂f/∂q′.")
        };
        sections.push(formulation(&routh, set, title, explanation));
        if !routh.multipliers.is_empty() {
            sections.push(multipliers(study, &routh, set));
        }
    }
    // Without constraints and quasi-velocities Maggi's equations are Lagrange's again.
    if is_free && study.model.quasi_velocities.is_empty() {
        return sections;
    }
    if let Ok(maggi) = derive(&cx, "maggi") {
        let explanation = "Lagrange's left sides contracted with a basis of virtual displacements: one equation for each independent velocity or quasi-velocity, no multipliers.";
        let mut section = formulation(&maggi, set, "Maggi's equations", explanation);
        section.claim = Some("formulation.equivalent#maggi".into());
        sections.push(section);
    }
    sections
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
    for (c, &force) in study.system.coordinates.iter().zip(&study.system.forces) {
        if !g.is_zero(force) {
            equations.push(set.equation(g.symbol(&format!("Q_{}", c.name), 0), force));
        }
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
