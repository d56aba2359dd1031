//! `chetaev derive`.

use super::{error, with_progress};
use crate::arguments::Derive as Arguments;
use crate::progress::ProgressLine;
use crate::{files, terminal, DONE, INPUT};
use chetaev::mechanics::card::Relation;
use chetaev::mechanics::{formulation, Context, Formulation, Prover, System, FORMULATIONS};
use chetaev::model::Model;
use chetaev::study::board;
use chetaev::study::derivation::claim_of;
use chetaev::study::registry;
use chetaev::study::written::{comparison, counts, equations, prepared, NotWritten, Notation};
use std::time::Instant;

/// What is derived when nothing is asked for.
const DEFAULT: [&str; 2] = ["routh", "maggi"];

pub(crate) fn run(arguments: &Arguments) -> u8 {
    if let Some(loaded) = files::functional(&arguments.model) {
        if arguments.steps {
            error("steps are written of mechanical systems; this model is a functional of fields");
            return INPUT;
        }
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
    let (prepared, notes) = match with_progress(|line| {
        line.show("deriving", None);
        prepared(&read.model, &system)
    }) {
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
        [a, b] => with_progress(|line| {
            let show = |what: &str| line.show(what, None);
            comparison(&cx, (a, b), &show)
        }),
        _ if arguments.steps => {
            let names = asked(arguments, &system);
            with_progress(|line| {
                line.show("deriving step by step", None);
                board::written(&cx, &names, (arguments.notation.into(), arguments.all))
            })
        }
        _ if arguments.count => {
            let names = asked(arguments, &system);
            with_progress(|line| {
                line.show("deriving and simplifying", None);
                counts(&cx, &names, arguments.all)
            })
        }
        _ => {
            let names = asked(arguments, &system);
            with_progress(|line| all((&read.model, &cx), &names, arguments, line))
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

/// The formulations that are asked for. Of functions of arrays one is enough, and of equations to be counted the shortest.
fn asked(arguments: &Arguments, system: &System) -> Vec<&'static dyn Formulation> {
    if arguments.all {
        return FORMULATIONS.to_vec();
    }
    let named = |names: &mut dyn Iterator<Item = &str>| names.filter_map(formulation).collect();
    let is_single =
        arguments.count || arguments.steps || Notation::from(arguments.notation).is_of_arrays();
    match arguments.formulation.is_empty() {
        true if is_single && system.order() == 1 => named(&mut ["reduced"].into_iter()),
        true if is_single => named(&mut ["routh"].into_iter()),
        true => named(&mut DEFAULT.into_iter()),
        false => named(&mut arguments.formulation.iter().map(String::as_str)),
    }
}

/// Everything that is printed.
fn all(
    (model, cx): (&Model, &Context<'_>),
    asked: &[&'static dyn Formulation],
    arguments: &Arguments,
    line: &ProgressLine,
) -> Result<String, NotWritten> {
    let mut began = Instant::now();
    let mut told = |formulation: &'static dyn Formulation, found: Option<&Result<_, _>>| {
        let name = formulation.card().name;
        match found {
            None => {
                line.show(&format!("deriving and simplifying {name}"), None);
                began = Instant::now();
            }
            Some(found) => {
                let derived = began.elapsed().as_secs_f64();
                if let (true, Ok(_)) = (arguments.time, found) {
                    line.show(&format!("proving {name}"), None);
                    time(cx, formulation, derived);
                }
            }
        }
    };
    let notation = Notation::from(arguments.notation);
    equations(model, cx, asked, (notation, arguments.all), &mut told)
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
