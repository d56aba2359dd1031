//! What a model asks for as parameters of the admissible velocities, and what becomes of it.

use crate::characteristics::{Characteristics, Selection};
use crate::system::System;
use crate::terms::MotionTerms;
use crate::words::quoted;
use chetaev_symbolic::Symbol;

/// Sentences on every independent velocity and quasi-velocity of the model that cannot be used as asked: which, why, and
/// what is used instead. Empty where everything is as asked.
pub fn unheeded(system: &System, terms: &MotionTerms, selection: &Selection) -> Vec<String> {
    let k = system.n() - selection.rows.len();
    let quasi_are_used = matches!(
        Characteristics::quasi_velocities(system, terms, selection),
        Some(Ok(_))
    );
    let mut sentences = Vec::new();
    if !system.quasi_velocities.is_empty() && !quasi_are_used {
        let asked: Vec<String> = system
            .quasi_velocities
            .iter()
            .map(|quasi| quasi.name.clone())
            .collect();
        sentences.push(format!(
            "the {} {} not used: {}; {}",
            named("quasi-velocity", "quasi-velocities", &asked),
            are(asked.len()),
            why_not_quasi(system, k),
            instead(system, selection),
        ));
    }
    sentences.extend(independent(system, terms, selection, k));
    sentences
}

/// What is said of independent velocities: those not used, and those that had to be added.
fn independent(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    k: usize,
) -> Option<String> {
    let used = selection.independent(system.n());
    let (kept, refused): (Vec<usize>, Vec<usize>) = system
        .independent
        .iter()
        .partition(|&&asked| used.contains(&asked));
    if !refused.is_empty() {
        let names = velocities(system, &refused);
        return Some(format!(
            "the {} asked for as independent {} not used as such: {}; {}",
            named("velocity", "velocities", &names),
            are(names.len()),
            why_not_independent(system, terms, selection, &kept, &refused, k),
            instead(system, selection),
        ));
    }
    let added: Vec<usize> = used.into_iter().filter(|i| !kept.contains(i)).collect();
    (!kept.is_empty() && !added.is_empty()).then(|| {
        let names = velocities(system, &added);
        format!(
            "{k} independent velocities are needed, and the model asks for {}: {} {} chosen beside {}",
            kept.len(),
            quoted(&names),
            are(names.len()),
            quoted(velocities(system, &kept)),
        )
    })
}

fn why_not_independent(
    system: &System,
    terms: &MotionTerms,
    selection: &Selection,
    kept: &[usize],
    refused: &[usize],
    k: usize,
) -> String {
    if system.independent.len() > k {
        return format!(
            "{} are asked for, and the constraints leave {k} independent",
            system.independent.len()
        );
    }
    let g = &system.graph;
    let characteristics = Characteristics::independent_velocities(system, terms, selection);
    let is_determined = characteristics.is_ok_and(|characteristics| {
        refused
            .iter()
            .all(|&i| characteristics.basis[i].iter().all(|&e| g.is_zero(e)))
    });
    let them = if refused.len() == 1 { "it" } else { "them" };
    match (is_determined, kept.is_empty()) {
        (true, _) => format!("the constraints determine {them}"),
        (false, true) => "the constraints make them depend on each other".to_owned(),
        (false, false) => format!(
            "the constraints make {them} depend on {}",
            quoted(velocities(system, kept))
        ),
    }
}

fn why_not_quasi(system: &System, k: usize) -> String {
    let (count, n) = (system.quasi_velocities.len(), system.n());
    if count != k && count != n {
        let or_all = match k == n {
            true => String::new(),
            false => format!(", or all {n} of a frame"),
        };
        return format!(
            "the model states {count}, and {k} independent {} needed{or_all}",
            if k == 1 { "one is" } else { "ones are" }
        );
    }
    let bent = nonlinear_definitions(system);
    if !bent.is_empty() {
        return format!(
            "{} {} not linear in the velocities",
            quoted(&bent),
            are(bent.len())
        );
    }
    "together with the constraints they do not determine all velocities, so they depend on each other"
        .to_owned()
}

/// Quasi-velocities whose gradient by the velocities contains velocities.
fn nonlinear_definitions(system: &System) -> Vec<String> {
    let g = &system.graph;
    let symbols: Vec<Symbol> = system.velocity_symbols();
    system
        .quasi_velocities
        .iter()
        .filter(|quasi| {
            g.gradient(quasi.definition, &symbols)
                .iter()
                .any(|&slope| g.contains_any(slope, &symbols))
        })
        .map(|quasi| quasi.name.clone())
        .collect()
}

/// What is used instead.
fn instead(system: &System, selection: &Selection) -> String {
    let names = velocities(system, &selection.independent(system.n()));
    match names.len() {
        0 => "no velocity is independent".to_owned(),
        1 => format!("the independent velocity is {}", quoted(&names)),
        _ => format!("the independent velocities are {}", quoted(&names)),
    }
}

fn velocities(system: &System, indices: &[usize]) -> Vec<String> {
    indices
        .iter()
        .map(|&i| format!("{}'", system.coordinates[i].name))
        .collect()
}

/// "velocity `x'`", "velocities `x'`, `y'`".
fn named(one: &str, many: &str, names: &[String]) -> String {
    let word = if names.len() == 1 { one } else { many };
    format!("{word} {}", quoted(names))
}

fn are(count: usize) -> &'static str {
    if count == 1 {
        "is"
    } else {
        "are"
    }
}
