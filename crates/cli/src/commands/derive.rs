//! `chetaev derive`.

mod code;
mod compare;
mod latex;
mod printed;

use super::{error, with_progress};
use crate::arguments::{Derive as Arguments, Notation};
use crate::progress::ProgressLine;
use crate::{files, terminal, DONE, INPUT};
use chetaev::mechanics::card::Relation;
use chetaev::mechanics::characteristics::CharacteristicsError;
use chetaev::mechanics::{
    choice, formulation, Context, Formulation, Prepared, Prover, System, FORMULATIONS,
};
use chetaev::study::derivation::{claim_of, derivation, Derivation, NotDerived, Readings};
use chetaev::study::registry;
use std::time::Instant;

/// What is derived when nothing is asked for.
const DEFAULT: [&str; 2] = ["routh", "maggi"];

pub(crate) fn run(arguments: &Arguments) -> u8 {
    if let Some(loaded) = files::functional(&arguments.model) {
        return super::functional::derive(arguments.notation, loaded);
    }
    let Some(read) = files::model(&arguments.model) else {
        return INPUT;
    };
    let system = match System::from_model(&read.model) {
        Ok(system) => system,
        Err(problem) => {
            read.refuse(problem);
            return INPUT;
        }
    };
    let (prepared, notes) = match with_progress(|line| prepare(&system, line)) {
        Ok(prepared) => prepared,
        Err(problem) => {
            read.refuse(problem);
            return INPUT;
        }
    };
    for note in notes {
        terminal::err(&format!("note: {note}"));
    }
    let known = registry();
    let (terms, selection) = (&prepared.terms, &prepared.selection);
    let cx = Context::new(&system, terms, selection, &known, Prover::default());
    let written = match arguments.compare.as_slice() {
        [a, b] => with_progress(|line| compare::text(&cx, a, b, line)),
        _ => {
            let names = asked(arguments);
            with_progress(|line| all(&cx, &names, arguments, line))
        }
    };
    match written {
        Ok(text) => {
            terminal::out(&text);
            DONE
        }
        Err(problem) => {
            error(problem);
            INPUT
        }
    }
}

/// The formulations that are asked for.
fn asked(arguments: &Arguments) -> Vec<&'static dyn Formulation> {
    if arguments.all {
        return FORMULATIONS.to_vec();
    }
    let named = |names: &mut dyn Iterator<Item = &str>| names.filter_map(formulation).collect();
    match arguments.formulation.is_empty() {
        true => named(&mut DEFAULT.into_iter()),
        false => named(&mut arguments.formulation.iter().map(String::as_str)),
    }
}

/// Terms and selection, with what a reader of the equations must know about them.
fn prepare(
    system: &System,
    line: &ProgressLine,
) -> Result<(Prepared, Vec<String>), CharacteristicsError> {
    line.show("deriving", None);
    let prepared = Prepared::new(system)?;
    let mut notes = Vec::new();
    if let Some(left_out) = prepared.left_out(system)? {
        notes.push(format!(
            "redundant constraints: {} left out, the others imply what they say",
            left_out.quoted()
        ));
    }
    notes.extend(choice::unheeded(
        system,
        &prepared.terms,
        &prepared.selection,
    ));
    Ok((prepared, notes))
}

/// Everything that is printed.
fn all(
    cx: &Context<'_>,
    asked: &[&'static dyn Formulation],
    arguments: &Arguments,
    line: &ProgressLine,
) -> Result<String, String> {
    let is_code = matches!(arguments.notation, Notation::Rust | Notation::C);
    let readings = Readings::default();
    let mut found: Vec<Result<Derivation, NotDerived>> = Vec::new();
    for formulation in asked {
        let name = formulation.card().name;
        line.show(&format!("deriving and simplifying {name}"), None);
        let began = Instant::now();
        let one = derivation(cx, *formulation, (!is_code).then_some(&readings));
        let derived = began.elapsed().as_secs_f64();
        if let (true, Ok(_)) = (arguments.time, &one) {
            line.show(&format!("proving {name}"), None);
            time(cx, *formulation, derived);
        }
        match one {
            // Among all formulations one that does not apply is an answer.
            Err(problem) if !arguments.all => return Err(problem.to_string()),
            one => found.push(one),
        }
    }
    line.show("writing", None);
    match arguments.notation {
        Notation::Rust | Notation::C => code::source(cx.system, &found, arguments.notation),
        notation => Ok(printed::text(cx, &found, notation)),
    }
}

/// Says on standard error how long it took to derive the equations and to decide what is claimed of them.
fn time(cx: &Context<'_>, formulation: &dyn Formulation, derived: f64) {
    let card = formulation.card();
    let claim = claim_of(card).filter(|_| card.relation == Relation::Equivalent);
    let proof = claim.map_or(String::new(), |claim| {
        let began = Instant::now();
        let finding = cx.finding(&claim);
        let seconds = began.elapsed().as_secs_f64();
        format!(", `{claim}` {} in {seconds:.3} s", finding.verdict.word())
    });
    terminal::err(&format!(
        "{}: derived and simplified in {derived:.3} s{proof}",
        card.name
    ));
}
